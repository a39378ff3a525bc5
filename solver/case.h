/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A case: all that a deck says, in SI units. Each program reads the part it needs; all check the
 * whole. The table of keys is in case.c, and docs/deck.md is printed from it.
 */
#ifndef KR_CASE_H
#define KR_CASE_H

#include "base/deck.h"

/* Choices of the deck and their words, in one order. */
#define KR_GRID_WORDS "near-boundary uniform free voronoi"
#define KR_HOLE_WORDS "circle ellipse rectangle polygon slot"
#define KR_OUTLINE_WORDS "rectangle polygon disc ring cad"
#define KR_OPERATION_WORDS "union difference"
#define KR_PORE_WORDS "circle ellipse sphere"
#define KR_DISTRIBUTION_WORDS "uniform normal lognormal by-area"
#define KR_VOID_WORDS "sphere ellipsoid cylinder stl"
#define KR_PARTIAL_VOLUME_WORDS "hhb none hhb-one-sided exact exact-centroid"
#define KR_SURFACE_WORDS "energy none volume force-density"
#define KR_DEFORMATION_WORDS "uniaxial-y uniaxial-x isotropic mean-over-axes uniaxial-z " \
    "stress-x stress-y stress-z stress-over-axes"
#define KR_MODEL_WORDS "plane-stress plane-strain solid"
#define KR_MICROMODULUS_WORDS "constant conical"
#define KR_PRESET_WORDS "none plates-paper"
#define KR_COMPRESSION_WORDS "scalars none all"
#define KR_QUANTITY_WORDS "displacement velocity damage energy stress strain"
enum kr_compression { KR_COMPRESS_SCALARS, KR_COMPRESS_NONE, KR_COMPRESS_ALL };
enum kr_quantity {
    KR_QUANTITY_DISPLACEMENT,
    KR_QUANTITY_VELOCITY,
    KR_QUANTITY_DAMAGE,
    KR_QUANTITY_ENERGY,
    KR_QUANTITY_STRESS,
    KR_QUANTITY_STRAIN,
    KR_QUANTITIES
};
enum kr_preset { KR_PRESET_NONE, KR_PRESET_PLATES_PAPER };
enum kr_grid { KR_GRID_NEAR_BOUNDARY, KR_GRID_UNIFORM, KR_GRID_FREE, KR_GRID_VORONOI };
enum kr_hole_shape {
    KR_HOLE_CIRCLE,
    KR_HOLE_ELLIPSE,
    KR_HOLE_RECTANGLE,
    KR_HOLE_POLYGON,
    KR_HOLE_SLOT
};
enum kr_outline {
    KR_OUTLINE_RECTANGLE,
    KR_OUTLINE_POLYGON,
    KR_OUTLINE_DISC,
    KR_OUTLINE_RING,
    KR_OUTLINE_CAD
};
enum kr_operation { KR_UNION, KR_DIFFERENCE };
enum kr_pore { KR_PORE_CIRCLE, KR_PORE_ELLIPSE, KR_PORE_SPHERE };
enum kr_distribution { KR_UNIFORM, KR_NORMAL, KR_LOGNORMAL, KR_BY_AREA };
enum kr_void_shape { KR_VOID_SPHERE, KR_VOID_ELLIPSOID, KR_VOID_CYLINDER, KR_VOID_STL };
enum kr_partial_volume {
    KR_PARTIAL_VOLUME_HHB,
    KR_PARTIAL_VOLUME_NONE,
    KR_PARTIAL_VOLUME_HHB_ONE_SIDED,
    KR_PARTIAL_VOLUME_EXACT,
    KR_PARTIAL_VOLUME_EXACT_CENTROID,
};
enum kr_surface_correction {
    KR_SURFACE_ENERGY,
    KR_SURFACE_NONE,
    KR_SURFACE_VOLUME,
    KR_SURFACE_FORCE_DENSITY,
};
enum kr_deformation {
    KR_UNIAXIAL_Y, KR_UNIAXIAL_X, KR_ISOTROPIC, KR_MEAN_OVER_AXES, KR_UNIAXIAL_Z,
    KR_STRESS_X, KR_STRESS_Y, KR_STRESS_Z, KR_STRESS_OVER_AXES
};
enum kr_precision { KR_DOUBLE, KR_MIXED };
enum kr_model { KR_PLANE_STRESS, KR_PLANE_STRAIN, KR_SOLID };
enum kr_micromodulus { KR_CONSTANT, KR_CONICAL };

/* A hole; what follows the radius is for other shapes than the circle. */
struct kr_case_hole {
    double centre[2]; /* m */
    double radius;    /* m */
    int shape;        /* enum kr_hole_shape */
    double radii[2];  /* m: half axes of an ellipse */
    double size[2];   /* m: of a rectangle */
    double length, width; /* m: of a slot, over all */
    struct kr_deck_list points; /* double, m: x and y of a polygon's corners, from the centre */
    double corner_radius; /* m: of a rectangle or polygon */
    double angle;         /* rad: turned about the centre, counter-clockwise */
};

/* The outline where it is not the whole rectangle of width by height, or a part of it. */
struct kr_case_outline {
    int shape;                  /* enum kr_outline */
    double centre[2], radius;   /* m: disc and ring; centre of a rectangle; origin of a cad file */
    double inner_radius;        /* m: ring */
    struct kr_deck_list points; /* double, m: polygon */
    double corner_radius;       /* m: rectangle and polygon */
    double size[2];             /* m: of a rectangle; zeros: width by height */
    double angle;               /* rad: turned about the centre, counter-clockwise */
    const char *file;           /* cad */
    int has_centre;             /* the deck gives one; else the middle of width by height */
    int operation;              /* enum kr_operation: what a part does to those before it */
    const char *name;           /* of a part's edges as a boundary; NULL: outline */
    struct kr_deck_list parts;  /* struct kr_case_outline: the outline is made of these, in turn */
};

/* A body given by its closed surface in an STL file. */
struct kr_case_stl {
    const char *file;
    double unit;      /* m: what 1 in the file stands for */
    double centre[3]; /* m: where its origin comes to lie */
};

/* A void in a solid. */
struct kr_case_void {
    double centre[3]; /* m; of an STL file: where its origin comes to lie */
    int shape;        /* enum kr_void_shape */
    double radius;    /* m: sphere and cylinder */
    double radii[3];  /* m: half axes of an ellipsoid */
    double length;    /* m: of a cylinder */
    double axis[3];   /* direction of a cylinder, of any length */
    const char *file; /* stl */
    double unit;      /* m: stl */
};

struct kr_case_pores {
    int64_t count, seed, attempts;
    double porosity;      /* instead of a count: area of the pores over that of the outline */
    const char *file;     /* instead of random ones */
    int shape;            /* enum kr_pore */
    double aspect[2];     /* least and most ratio of an ellipse's half axes, long over short */
    double radius[2];     /* m: least and most */
    int distribution;     /* enum kr_distribution, of the radius */
    double mean, deviation; /* m: of a normal or lognormal one before it is cut off */
    double edge_diameters; /* distance of a centre from the edges, in diameters of the pore */
    double gap;           /* m: least distance between the rims of two pores */
};

struct kr_case_set {
    const char *name;
    double within;    /* m: nodes within this distance ... */
    const char *of;   /* ... of this boundary */
    double lower[3], upper[3]; /* m: or nodes in this box */
    double centre[3], radius;  /* m: or in this disc or ball */
    double through[3], normal[3]; /* m, 1: or on the side of a line or plane that `normal` shows to */
    struct kr_deck_list points;   /* double, m: or in this polygon (2D) */
    struct kr_deck_list join, meet, less, without; /* const char *: or made of other sets */
};

/* A crack before the run: a line in a plate; a polygon, disc or surface of triangles in a solid. */
struct kr_case_crack {
    double from[2], to[2];       /* m: straight, or ... */
    struct kr_deck_list points;  /* double, m: x and y of the corners of a line with bends */
    struct kr_deck_list polygon; /* double, m: x, y, z of the corners of a plane polygon */
    double centre[3], normal[3], radius; /* m, 1, m: disc */
    const char *file; /* STL */
    double unit;      /* m: what 1 in the file stands for */
};

struct kr_case_load {
    const char *set;
    struct kr_deck_formula displacement[3]; /* m */
    struct kr_deck_formula velocity[3];     /* m/s */
    struct kr_deck_formula traction[3];     /* Pa, on the boundary that the set belongs to */
    struct kr_deck_formula body_force[3];   /* N/m^3 */
    double ramp; /* s: from 0 to the full value in this time; 0: at once */
    const char *table_file;   /* CSV of a factor over time; NULL: none */
    const char *table_column; /* NULL: the second */
    int table_repeats;
};

/* A quantity at a place or over a set, in history.csv. */
struct kr_case_probe {
    const char *name;
    int quantity;     /* enum kr_quantity */
    const char *set;  /* NULL: at a place */
    double at[3];     /* m */
};

/* Load steps of equal size. */
struct kr_case_steps {
    int64_t count;
    double size; /* s of the stage's clock */
};

#define KR_STAGE_WORDS "dynamic static relaxation"
enum kr_stage_kind { KR_STAGE_DYNAMIC, KR_STAGE_STATIC, KR_STAGE_RELAXATION };

/* A part of the run. Its clock begins at 0; loads follow it. */
struct kr_case_stage {
    int kind;                  /* enum kr_stage_kind */
    struct kr_deck_list loads; /* struct kr_case_load; not given: those of the deck */
    double end_time;           /* s; dynamic, relaxation */
    double damping;            /* 1/s; dynamic */
    struct kr_deck_list steps; /* struct kr_case_steps; static */
    double least_step;         /* s; static: 0: load steps are taken as they are */
    double end_below;          /* static: of the greatest pull; less ends the run */
    double tolerance;          /* static, relaxation: of the residual */
    int breaks;                /* bonds may break */
};

struct kr_case_box {
    double lower[2], upper[2]; /* m */
    int direction;             /* 0 +x, 1 -x, 2 +y, 3 -y */
};

struct kr_case {
    const char *title;
    int preset; /* enum kr_preset */

    /* geometry */
    double width, height; /* m: plate with its lower left corner at (0, 0) */
    struct kr_case_outline outline;
    struct kr_deck_list holes;  /* struct kr_case_hole */
    double depth;               /* m: of a solid, from z = 0; 0: a plate */
    struct kr_deck_list voids;  /* struct kr_case_void */
    struct kr_case_stl body;    /* instead of outline and holes; no file: none */
    struct kr_case_pores pores; /* count 0: none */

    /* mesh */
    const char *mesh_file; /* a mesh from elsewhere, instead of one by kirsch-mesh; NULL: none */
    int grid; /* enum kr_grid */
    double spacing;    /* m */
    double padding;    /* m: from a hole to the rim of its box; 0: the horizon */
    int64_t lloyd_steps; /* voronoi */

    /* nodes */
    double horizon; /* m */
    int partial_volume, surface_correction, surface_deformation;
    struct kr_deck_list sets; /* struct kr_case_set */

    /* material */
    const char *law;
    int model; /* enum kr_model */
    int micromodulus; /* enum kr_micromodulus */
    double youngs_modulus;  /* Pa */
    double poissons_ratio;  /* 0: not given; the model has its own, and others are refused */
    double density;         /* kg/m^3 */
    double fracture_energy; /* J/m^2; 0: does not break */

    /* cracks */
    struct kr_deck_list cracks; /* struct kr_case_crack */
    int count_precrack;

    /* initial */
    struct kr_deck_formula initial_displacement[3], initial_velocity[3]; /* m, m/s */

    struct kr_deck_list loads;   /* struct kr_case_load */
    struct kr_deck_list no_fail; /* const char * */

    struct kr_deck_list stages; /* struct kr_case_stage; not given: one dynamic stage */

    /* solver */
    double end_time;      /* s; 0: not given, for there are stages */
    double time_step;     /* s; 0: found */
    int precision;        /* enum kr_precision */
    double safety_factor; /* of the largest stable step */
    double checkpoint_every;  /* s of wall time; 0: only on signals */
    int64_t checkpoint_steps; /* 0: none by steps */

    /* output */
    const char *folder;
    double output_every;          /* s */
    struct kr_deck_list output_at; /* double, s */
    int64_t every_steps;           /* load steps of static stages */
    int first_damage;              /* an output where the first bond breaks */
    int64_t every_bonds;           /* and one for so many broken bonds; 0: none */
    struct kr_deck_list fields;    /* const char *: words of KR_QUANTITY_WORDS; not given: the first four */
    struct kr_deck_list probes;    /* struct kr_case_probe */
    int double_fields;             /* fields stand in float64 */
    int compression;               /* enum kr_compression */
    double history_every;         /* s */
    double damage_threshold;

    /* track */
    int64_t window; /* steps */
    struct kr_deck_list boxes; /* struct kr_case_box */
};

/** Keys of the deck, for kr_deck_read and kr_deck_reference. */
extern const struct kr_deck_key kr_case_keys[];

/** Arguments that every program takes, and the case they lead to. */
struct kr_case_arguments {
    const char *deck, *variant, *folder; /* folder: --output, over the deck's */
    size_t n_set;
    const char **set;   /* `set` and `left` are owned by the caller (kr_free) */
    int check, explain; /* --check, --explain */
    int meshes;         /* set by programs that make the mesh, or have it made: what its boundaries
                           and squares tell of the deck is then checked, too */
    size_t n_left;      /* what the program itself must understand: it stops on unknown ones */
    const char **left;
};

/** Read `program [--variant V] [--set key=value]... [--output DIR] [--check] [--explain] [--help]
 *  [--version] case.yaml`. --help prints `usage` and exits 0; faults stop (exit 2). The deck is the
 *  first argument that ends in .yaml or .yml, else the first that is no option. */
void kr_case_arguments(int argc, char **argv, const char *usage, struct kr_case_arguments *out);

/** Dimensions of the body: 3 for a solid, else 2. */
int kr_case_dim(const struct kr_case *c);

/** Normal of a polygon in space (n x 3), as long as twice its area; 0 for one without. */
void kr_case_normal(size_t n, const double *corner, double normal[3]);

/** Loads of a stage: its own, or the deck's (struct kr_case_load). */
const struct kr_deck_list *kr_case_loads(const struct kr_case *c,
                                         const struct kr_case_stage *stage);

/** Files that a deck names, by what they are of. The visitor gets the field that names one, and its path as seen from
 *  where the program runs. */
enum kr_case_part { KR_CASE_MESH, KR_CASE_GEOMETRY, KR_CASE_MECHANICS, KR_CASE_PARTS };
void kr_case_visit_files(struct kr_deck *deck, const struct kr_case *c, enum kr_case_part part,
                         void (*visit)(void *context, const char *const *field, const char *path),
                         void *context);

/** Fault those that cannot be read. Programs that need none of them are not asked for. */
void kr_case_check_files(struct kr_deck *deck, const struct kr_case *c);

/** What does fit where squares of the spacing do not fill the rectangle, each to a billionth: the end
 *  of a sentence, owned by the caller; NULL if they do. All in m. */
char *kr_case_misfit(double width, double height, double spacing);

/** Open the deck, read and check it whole; faults stop (exit 2). With `check` it looks for the files that the deck
 *  names, too, says that there are no faults and exits 0. The folder is made, unless the case is only to be explained. */
struct kr_deck *kr_case_open(const struct kr_case_arguments *arguments, struct kr_case *out);

/** Before exec of a program of Kirsch: the deck's warnings have been told, and kr_case_open there tells them
 *  not again. */
void kr_case_note_warned(void);

/** The k-th of some words, cut to 31 letters: kr_case_word(KR_MODEL_WORDS, c->model, word). */
void kr_case_word(const char *words, int k, char word[32]);

/** Path of a file in the case's folder, owned by the caller: kr_case_file(c, "plate.msh"). */
char *kr_case_file(const struct kr_case *c, const char *name);

/** Radius [m] of a circle around a hole, and that circle's centre. */
double kr_case_hole_reach(const struct kr_case_hole *hole, double centre[2]);

/** The pores of a file, checked; owned by the caller. Lines of `x y radius` in metres (`x y long
 *  short degrees` for ellipses); or, as the plates paper hands them to ANSYS (appendix 4), a first line
 *  with their number and then lengths in millimetres. Stops (exit 2) and names the line. */
struct kr_case_hole *kr_case_read_pores(const struct kr_case *c, const char *path, size_t *count);

/** The field of this word (enum kr_quantity), -1 if there is none. */
int kr_case_quantity(const char *word);

/** Whether the outputs hang on what happens, so that their times are not known beforehand. */
int kr_case_outputs_on_events(const struct kr_case *c);

/** Whether the case has pores, by a count, a porosity or a file. */
int kr_case_has_pores(const struct kr_case *c);

/** Whether the outline is no more than the rectangle of width by height. */
int kr_case_is_rectangle(const struct kr_case_outline *outline);

/** All holes: those of the deck and, where `pores` is given, those that kirsch-pores left in
 *  pores.txt of the folder. Owned by the caller (kr_free). Stops if pores.txt is missing or bad. */
struct kr_case_hole *kr_case_holes(const struct kr_case *c, size_t *count);

/** The voids of a case: those of the deck, then the spheres of pores.txt where its pores are such. Owned by
 *  the caller (kr_free); files of STL voids are the deck's. Stops (exit 2) where pores.txt is bad. */
struct kr_case_void *kr_case_voids(const struct kr_case *c, size_t *count);

#endif
