/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The table of the deck's keys: what they are called, what they hold, in which range, and what they
 * mean. docs/deck.md is printed from it; checks that need more than one key are in case_check.c.
 */
#include "case.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define AT(field) offsetof(struct kr_case, field)
#define POSITIVE .least = 0, .most = INFINITY, .exclusive = 1
#define NOT_NEGATIVE .least = 0, .most = INFINITY
#define VECTOR_OF(where) .type = KR_DECK_VECTOR, .offset = (where), .unit = "m", .count = 2
/* In a plate two components, in a solid three. */
#define PLACE_OF(where)                                                                            \
    .type = KR_DECK_VECTOR, .offset = (where), .unit = "m", .count = 3, .fewest = 2
#define SPACE_OF(where) .type = KR_DECK_VECTOR, .offset = (where), .unit = "m", .count = 3
#define NUMBER_OF(where, si) .type = KR_DECK_NUMBER, .offset = (where), .unit = (si)
#define LIST_OF(what, type_, keys_)                                                                \
    .type = (what), .item_size = sizeof(type_), .keys = (keys_), .fallback = ""

#define HOLE_AT(field) offsetof(struct kr_case_hole, field)
#define LENGTH_OF(where) NUMBER_OF((where), "m"), .fallback = ""
static const struct kr_deck_key hole_keys[] = {
    {"centre", VECTOR_OF(HOLE_AT(centre)), .fallback = "",
     .text = "Centre; it may lie outside the plate, for a notch in its edge. A polygon needs none: "
             "(0, 0) then."},
    {"radius", LENGTH_OF(HOLE_AT(radius)), POSITIVE, .text = "Radius of a circle."},
    {"shape", KR_DECK_CHOICE, HOLE_AT(shape), .words = KR_HOLE_WORDS, .fallback = "circle",
     .text = "Holes may overlap each other, and where they cut the outline they are notches."},
    {"radii", VECTOR_OF(HOLE_AT(radii)), .fallback = "", POSITIVE,
     .text = "Half axes of an ellipse, along x and y before it is turned."},
    {"size", VECTOR_OF(HOLE_AT(size)), .fallback = "", POSITIVE,
     .text = "Sides of a rectangle, along x and y before it is turned."},
    {"length", LENGTH_OF(HOLE_AT(length)), POSITIVE,
     .text = "Length of a slot over its round ends."},
    {"width", LENGTH_OF(HOLE_AT(width)), POSITIVE, .text = "Width of a slot."},
    {"points", KR_DECK_NUMBERS, HOLE_AT(points), .unit = "m", .count = 2, .fallback = "",
     .text = "Corners of a polygon in turn, as seen from the centre."},
    {"corner_radius", LENGTH_OF(HOLE_AT(corner_radius)), NOT_NEGATIVE,
     .text = "Radius that rounds the corners of a rectangle or polygon; not given: sharp."},
    {"angle", NUMBER_OF(HOLE_AT(angle), "rad"), .fallback = "",
     .text = "Turns the hole about its centre, counter-clockwise."},
    {NULL},
};

#define OUTLINE_AT(field) offsetof(struct kr_case_outline, field)
#define OUTLINE_SHAPE_KEYS                                                                         \
    {"shape", KR_DECK_CHOICE, OUTLINE_AT(shape), .words = KR_OUTLINE_WORDS,                        \
     .fallback = "rectangle",                                                                      \
     .text = "`rectangle`: all of width by height, or of a size; `cad`: the plane faces of a "     \
             "file, with their holes."},                                                           \
    {"centre", VECTOR_OF(OUTLINE_AT(centre)), .fallback = "",                                      \
     .text = "Centre of a disc, ring or rectangle; not given: the middle of width by height. Of "  \
             "a polygon or a cad file: where its origin comes to lie; not given: (0, 0)."},        \
    {"radius", LENGTH_OF(OUTLINE_AT(radius)), POSITIVE,                                            \
     .text = "Outer radius of a disc or ring."},                                                   \
    {"inner_radius", LENGTH_OF(OUTLINE_AT(inner_radius)), POSITIVE, .text = "Of a ring."},         \
    {"points", KR_DECK_NUMBERS, OUTLINE_AT(points), .unit = "m", .count = 2, .fallback = "",       \
     .text = "Corners of a polygon in turn."},                                                     \
    {"corner_radius", LENGTH_OF(OUTLINE_AT(corner_radius)), NOT_NEGATIVE,                          \
     .text = "Radius that rounds the corners of a rectangle or polygon; not given: sharp."},       \
    {"size", VECTOR_OF(OUTLINE_AT(size)), .fallback = "", POSITIVE,                                \
     .text = "Sides of a rectangle, along x and y before it is turned; not given: width and "      \
             "height."},                                                                           \
    {"angle", NUMBER_OF(OUTLINE_AT(angle), "rad"), .fallback = "",                                 \
     .text = "Turns the shape about its centre, counter-clockwise."},                              \
    {"file", KR_DECK_TEXT, OUTLINE_AT(file), .fallback = "",                                       \
     .text = "STEP, IGES or BREP file of a `cad` outline; a path from the deck's folder."}

static const struct kr_deck_key part_keys[] = {
    OUTLINE_SHAPE_KEYS,
    {"operation", KR_DECK_CHOICE, OUTLINE_AT(operation), .words = KR_OPERATION_WORDS,
     .fallback = "union", .text = "What the part does to the parts before it."},
    {"name", KR_DECK_TEXT, OUTLINE_AT(name), .fallback = "",
     .text = "Name of its edges as a boundary of the mesh; not given: `outline`."},
    {NULL},
};

static const struct kr_deck_key outline_keys[] = {
    OUTLINE_SHAPE_KEYS,
    {"parts", LIST_OF(KR_DECK_LIST, struct kr_case_outline, part_keys), .offset = OUTLINE_AT(parts),
     .text = "Parts that make the outline in turn, each joined to those before it or taken away "
             "from them; in place of `shape`. Within width by height; straight edges on its sides "
             "are the boundaries `left`, `right`, `bottom` and `top`."},
    {NULL},
};

#define PORES_AT(field) offsetof(struct kr_case_pores, field)
static const struct kr_deck_key pores_keys[] = {
    {"count", KR_DECK_INTEGER, PORES_AT(count), .fallback = "0", .least = 0, .most = 1e6,
     .text = "How many pores kirsch-pores throws at random; 0: none."},
    {"porosity", NUMBER_OF(PORES_AT(porosity), "1"), .fallback = "0", .least = 0, .most = 0.9,
     .text = "In place of a count: area of the pores over that of the outline. Met to a "
             "nanometre of the last radius where the range of radii allows it; the largest pores "
             "are placed first."},
    {"file", KR_DECK_TEXT, PORES_AT(file), .fallback = "",
     .text = "In place of random pores: a file of them, a path from the deck's folder "
             "([formats.md](formats.md#porestxt))."},
    {"shape", KR_DECK_CHOICE, PORES_AT(shape), .words = KR_PORE_WORDS, .fallback = "circle",
     .text = "`ellipse`: at random angles, the radius its long half axis; distances are kept by "
             "the circle around it; `sphere`, in a solid: voids at random places in space, in place of holes "
             "through it; the rules hold for them with front and back among the edges."},
    {"aspect", KR_DECK_VECTOR, PORES_AT(aspect), .unit = "1", .count = 2, .fallback = "",
     .least = 1, .most = 100,
     .text = "Least and largest ratio of an ellipse's half axes, drawn evenly between the two."},
    {"radius", VECTOR_OF(PORES_AT(radius)), .fallback = "", POSITIVE,
     .text = "Least and largest radius. Needed where there are random pores."},
    {"distribution", KR_DECK_CHOICE, PORES_AT(distribution), .words = KR_DISTRIBUTION_WORDS,
     .fallback = "uniform",
     .text = "Of the radius between the two: `uniform`; `normal` and `lognormal`, cut off there; "
             "`by-area`, evenly over the areas of the pores."},
    {"mean", NUMBER_OF(PORES_AT(mean), "m"), .fallback = "", POSITIVE,
     .text = "Mean of a normal or lognormal radius before it is cut off."},
    {"deviation", NUMBER_OF(PORES_AT(deviation), "m"), .fallback = "", POSITIVE,
     .text = "Its standard deviation."},
    {"edge_diameters", NUMBER_OF(PORES_AT(edge_diameters), "1"), .fallback = "1", NOT_NEGATIVE,
     .text = "Least distance of a centre from the edges of the outline, in diameters of the "
             "pore."},
    {"gap", NUMBER_OF(PORES_AT(gap), "m"), .fallback = "0.3 mm", NOT_NEGATIVE,
     .text = "Least distance between the rims of two holes."},
    {"seed", KR_DECK_INTEGER, PORES_AT(seed), .fallback = "1", .least = 0, .most = 9e15,
     .text = "Equal seeds give equal pores on every machine."},
    {"attempts", KR_DECK_INTEGER, PORES_AT(attempts), .fallback = "100000", .least = 1,
     .most = 1e12, .text = "Throws before kirsch-pores gives up, all pores together."},
    {NULL},
};

#define VOID_AT(field) offsetof(struct kr_case_void, field)
static const struct kr_deck_key void_keys[] = {
    {"centre", SPACE_OF(VOID_AT(centre)), .fallback = "",
     .text = "Centre `[x, y, z]`; it may lie outside, and voids may overlap each other. An STL file "
             "needs none: its origin comes to lie there."},
    {"radius", LENGTH_OF(VOID_AT(radius)), POSITIVE, .text = "Of a sphere or cylinder."},
    {"shape", KR_DECK_CHOICE, VOID_AT(shape), .words = KR_VOID_WORDS, .fallback = "sphere",
     .text = "`stl`: what the closed surface in a file bounds."},
    {"radii", SPACE_OF(VOID_AT(radii)), .fallback = "", POSITIVE,
     .text = "Half axes of an ellipsoid, along x, y and z."},
    {"length", LENGTH_OF(VOID_AT(length)), POSITIVE, .text = "Of a cylinder between its flat ends."},
    {"axis", .type = KR_DECK_VECTOR, .offset = VOID_AT(axis), .unit = "1", .count = 3, .fallback = "",
     .text = "Direction of a cylinder; not given: along z."},
    {"file", KR_DECK_TEXT, VOID_AT(file), .fallback = "",
     .text = "STL file, binary or ASCII; a path from the deck's folder."},
    {"unit", LENGTH_OF(VOID_AT(unit)), POSITIVE, .text = "What 1 in the STL file stands for, `1 mm`."},
    {NULL},
};

#define BODY_AT(field) offsetof(struct kr_case, body.field)
static const struct kr_deck_key body_keys[] = {
    {"file", KR_DECK_TEXT, BODY_AT(file), .fallback = "",
     .text = "STL file of a closed surface, binary or ASCII; a path from the deck's folder."},
    {"unit", LENGTH_OF(BODY_AT(unit)), POSITIVE, .text = "What 1 in the file stands for, `1 mm`."},
    {"centre", SPACE_OF(BODY_AT(centre)), .fallback = "",
     .text = "Where the origin of the file comes to lie; not given: at the origin."},
    {NULL},
};

static const struct kr_deck_key geometry_keys[] = {
    {"width", NUMBER_OF(AT(width), "m"), POSITIVE,
     .text = "Width of the plate (x), or of the frame around its outline. Its lower left corner is "
             "the origin."},
    {"height", NUMBER_OF(AT(height), "m"), POSITIVE, .text = "Height of the plate (y)."},
    {"outline", KR_DECK_SECTION, AT(outline), .keys = outline_keys,
     .text = "Shape of the plate where it is no rectangle."},
    {"holes", LIST_OF(KR_DECK_LIST, struct kr_case_hole, hole_keys), .offset = AT(holes),
     .text = "Holes at given places."},
    {"depth", NUMBER_OF(AT(depth), "m"), .fallback = "", POSITIVE,
     .text = "Makes the plate a solid from z = 0 to this depth, its holes going through."},
    {"voids", LIST_OF(KR_DECK_LIST, struct kr_case_void, void_keys), .offset = AT(voids),
     .text = "Voids in a solid; the boundaries `void_1`, ... of the mesh, in this order."},
    {"body", KR_DECK_SECTION, .keys = body_keys,
     .text = "A solid from an STL file, within width by height by depth, in place of outline and "
             "holes."},
    {"pores", KR_DECK_SECTION, AT(pores), .keys = pores_keys,
     .text = "Holes at random places."},
    {NULL},
};

static const struct kr_deck_key mesh_keys[] = {
    {"file", KR_DECK_TEXT, AT(mesh_file), .fallback = "",
     .text = "A mesh from elsewhere, instead of one by kirsch-mesh; a path from the deck's folder. What "
             "can be read: [formats.md](formats.md#meshes-from-elsewhere)."},
    {"grid", KR_DECK_CHOICE, AT(grid), .words = KR_GRID_WORDS,
     .fallback = "near-boundary",
     .text = "`near-boundary`: a square lattice, cut out around each hole and filled there by gmsh "
             "with cells that follow the rim; `uniform`: the lattice alone, with jagged holes; "
             "`free`: gmsh everywhere; `voronoi`: the lattice, near edges Voronoi cells that the "
             "edge cuts ([grids.md](grids.md))."},
    {"spacing", NUMBER_OF(AT(spacing), "m"), POSITIVE, .text = "Spacing of the lattice."},
    {"padding", NUMBER_OF(AT(padding), "m"), .fallback = "", NOT_NEGATIVE,
     .text = "From the rim of a hole to the edge of the box that is meshed around it; not given "
             "or 0: the horizon."},
    {"lloyd_steps", KR_DECK_INTEGER, AT(lloyd_steps), .fallback = "5", .least = 0, .most = 100,
     .text = "`voronoi`: how often the nodes within a padding of an edge move to the centroids of "
             "their cells; each step makes the areas more even and the cells less square."},
    {NULL},
};

#define SET_AT(field) offsetof(struct kr_case_set, field)
static const struct kr_deck_key set_keys[] = {
    {"within", NUMBER_OF(SET_AT(within), "m"), .fallback = "", POSITIVE,
     .text = "Nodes within this distance of a boundary. Goes with `of`."},
    {"of", KR_DECK_TEXT, SET_AT(of), .fallback = "",
     .text = "Name of the boundary in the mesh: `left`, `right`, `top`, `bottom`, `hole_1`, ..."},
    {"lower", PLACE_OF(SET_AT(lower)), .fallback = "",
     .text = "Or nodes in a box: its corner of least coordinates. Goes with `upper`."},
    {"upper", PLACE_OF(SET_AT(upper)), .fallback = "", .text = "Its opposite corner."},
    {"centre", PLACE_OF(SET_AT(centre)), .fallback = "",
     .text = "Or nodes in a disc (ball in 3D): its centre. Goes with `radius`."},
    {"radius", NUMBER_OF(SET_AT(radius), "m"), .fallback = "", POSITIVE, .text = "Its radius."},
    {"through", PLACE_OF(SET_AT(through)), .fallback = "",
     .text = "Or nodes on one side of a line (plane in 3D): a point on it. Goes with `normal`."},
    {"normal", KR_DECK_VECTOR, SET_AT(normal), "1", .fallback = "", .count = 3, .fewest = 2,
     .text = "Direction, of any length, to the side that counts."},
    {"points", KR_DECK_NUMBERS, SET_AT(points), .unit = "m", .count = 2, .fallback = "",
     .text = "Or nodes in a polygon (2D): its corners in turn."},
    {"union", KR_DECK_TEXTS, SET_AT(join), .fallback = "",
     .text = "Or all nodes of these sets, which stand above this one or in the mesh."},
    {"intersection", KR_DECK_TEXTS, SET_AT(meet), .fallback = "",
     .text = "Or the nodes that are in all of these sets."},
    {"difference", KR_DECK_TEXTS, SET_AT(less), .fallback = "",
     .text = "Or the nodes of the first set that are in none of the others."},
    {"not", KR_DECK_TEXTS, SET_AT(without), .fallback = "",
     .text = "Or the nodes that are in none of these sets."},
    {NULL},
};

static const struct kr_deck_key nodes_keys[] = {
    {"horizon", NUMBER_OF(AT(horizon), "m"), POSITIVE,
     .text = "Reach of the bonds; 3 to 6 spacings, at least 2."},
    {"partial_volume", KR_DECK_CHOICE, AT(partial_volume), .words = KR_PARTIAL_VOLUME_WORDS,
     .fallback = "exact-centroid",
     .text = "Share of a cell that counts where the horizon cuts it: `exact`, the area (volume) of the "
             "cell inside the circle (sphere), the mean of both ends of a bond; `exact-centroid`: the same, the bond "
             "reaching to the centroid of that part; `hhb`: linear over the width of the cell, the "
             "mean of both ends, and the default of nodes that came without cells; `none`: all or "
             "nothing; "
             "`hhb-one-sided`: of the far cell alone, as published; on unequal cells momentum then "
             "drifts, so it is for comparison only."},
    {"surface_correction", KR_DECK_CHOICE, AT(surface_correction), .words = KR_SURFACE_WORDS,
     .fallback = "energy",
     .text = "`energy`: bonds near a surface are stiffened until the energy of a homogeneous "
             "deformation is right there too; `volume`: by the part of the family that is lost; "
             "`force-density`: by what a uniaxial strain along each axis pulls; `none`."},
    {"surface_deformation", KR_DECK_CHOICE, AT(surface_deformation),
     .words = KR_DEFORMATION_WORDS, .fallback = "mean-over-axes",
     .text = "The homogeneous deformation of the energy correction. `mean-over-axes`: the mean of "
             "the uniaxial strains along all axes, smooth and safe; `uniaxial-y`, `uniaxial-x`, in 3D "
             "also `uniaxial-z`: the paper's, exact for a load in that direction, but rough at its "
             "edges and impossible between close holes; `stress-x`, `stress-y`, in 3D also `stress-z`: a "
             "uniaxial stress, the body shrinking across it, for bars ([theory.md](theory.md#surface-factors)); "
             "`stress-over-axes`: the mean of these; `isotropic`."},
    {"sets", LIST_OF(KR_DECK_MAP, struct kr_case_set, set_keys), .offset = AT(sets),
     .text = "Named sets of nodes, for loads and no-fail zones: `top: {within: 0.3 mm, of: top}` "
             "or `{lower: [0 mm, 0 mm], upper: [1 mm, 2 mm]}`. A set is one of boundary, box, disc, "
             "half space, polygon and a combination of other sets."},
    {NULL},
};

static const struct kr_deck_key material_keys[] = {
    {"law", KR_DECK_TEXT, AT(law), .fallback = "pmb",
     .text = "Material law; `pmb`: prototype microelastic brittle, with a constant micromodulus."},
    {"model", KR_DECK_CHOICE, AT(model), .words = KR_MODEL_WORDS,
     .text = "Thin plate, thick plate, or a body in three dimensions (`solid`: all vectors of the "
             "deck then have three components). Bonds fix Poisson's ratio: 1/3 in plane stress, 1/4 "
             "otherwise."},
    {"micromodulus", KR_DECK_CHOICE, AT(micromodulus), .words = KR_MICROMODULUS_WORDS,
     .fallback = "constant",
     .text = "Stiffness of bonds over their length: `constant` up to the horizon, or `conical`, "
             "falling evenly to nothing there."},
    {"youngs_modulus", NUMBER_OF(AT(youngs_modulus), "Pa"), POSITIVE, .text = "Young's modulus."},
    {"poissons_ratio", NUMBER_OF(AT(poissons_ratio), "1"), .fallback = "", .least = -1, .most = 0.5,
     .text = "Need not be given: the bonds fix it. If it is, and is not the model's own, the deck is "
             "refused."},
    {"density", NUMBER_OF(AT(density), "kg/m^3"), POSITIVE, .text = "Density."},
    {"fracture_energy", NUMBER_OF(AT(fracture_energy), "J/m^2"), .fallback = "0 J/m^2",
     NOT_NEGATIVE, .text = "Energy of a unit of crack area, G0; 0: the plate does not break."},
    {NULL},
};

#define CRACK_AT(field) offsetof(struct kr_case_crack, field)
#define VECTOR_3(where, si)                                                                        \
    .type = KR_DECK_VECTOR, .offset = (where), .unit = (si), .count = 3, .fallback = ""
static const struct kr_deck_key disc_keys[] = {
    {"centre", VECTOR_3(CRACK_AT(centre), "m"), .text = "Its centre."},
    {"normal", VECTOR_3(CRACK_AT(normal), "1"), .text = "Across it, of any length: `[0, 0, 1]`."},
    {"radius", NUMBER_OF(CRACK_AT(radius), "m"), .fallback = "", POSITIVE, .text = "Its radius."},
    {NULL},
};

static const struct kr_deck_key crack_keys[] = {
    {"from", VECTOR_OF(CRACK_AT(from)), .fallback = "",
     .text = "In a plate: one end of a straight crack. Goes with `to`."},
    {"to", VECTOR_OF(CRACK_AT(to)), .fallback = "", .text = "The other end."},
    {"points", KR_DECK_NUMBERS, CRACK_AT(points), .unit = "m", .count = 2, .fallback = "",
     .text = "In a plate: the corners of a crack with bends, from end to end."},
    {"polygon", KR_DECK_NUMBERS, CRACK_AT(polygon), .unit = "m", .count = 3, .fallback = "",
     .text = "In a solid: the corners of a plane polygon in turn."},
    {"disc", KR_DECK_SECTION, .keys = disc_keys, .text = "In a solid: a round crack (penny)."},
    {"file", KR_DECK_TEXT, CRACK_AT(file), .fallback = "",
     .text = "In a solid: a surface of triangles, open or closed; an STL file, binary or ASCII; a path "
             "from the deck's folder."},
    {"unit", NUMBER_OF(CRACK_AT(unit), "m"), .fallback = "", POSITIVE,
     .text = "What 1 in the STL file stands for, `1 mm`. Goes with `file`."},
    {NULL},
};

static const struct kr_deck_key cracks_keys[] = {
    {"precracks", LIST_OF(KR_DECK_LIST, struct kr_case_crack, crack_keys), .offset = AT(cracks),
     .text = "Cracks that are there from the beginning: they cut every bond that crosses or touches "
             "them. In a plate straight or bent lines, in a solid polygons, discs and surfaces."},
    {"count_precrack", KR_DECK_BOOLEAN, AT(count_precrack), .fallback = "true",
     .text = "Whether the bonds cut by them count as broken in Damage."},
    {NULL},
};

#define LOAD_AT(field) offsetof(struct kr_case_load, field)
#define LOAD_OF(where, si)                                                                         \
    .type = KR_DECK_FORMULAS, .offset = (where), .unit = (si), .count = 3, .fallback = ""
static const struct kr_deck_key table_keys[] = {
    {"file", KR_DECK_TEXT, LOAD_AT(table_file), .fallback = "",
     .text = "CSV file, a path from the deck's folder: a line of names, the first `time [us]` in any "
             "unit of time, then lines of numbers. Between them the factor goes in straight lines, after the "
             "last it stays."},
    {"column", KR_DECK_TEXT, LOAD_AT(table_column), .fallback = "",
     .text = "Name of the column with the factor; not given: the second."},
    {"repeat", KR_DECK_BOOLEAN, LOAD_AT(table_repeats), .fallback = "false",
     .text = "After the last line begin with the first again (cyclic loads)."},
    {NULL},
};

static const struct kr_deck_key load_keys[] = {
    {"set", KR_DECK_TEXT, LOAD_AT(set), .text = "Name of a set under `nodes.sets`."},
    {"displacement", LOAD_OF(LOAD_AT(displacement), "m"),
     .text = "Prescribed displacement `[x, y]`, in a solid `[x, y, z]`; `free` leaves a component "
             "out."},
    {"velocity", LOAD_OF(LOAD_AT(velocity), "m/s"),
     .text = "Prescribed velocity, with `free` likewise."},
    {"traction", LOAD_OF(LOAD_AT(traction), "Pa"),
     .text = "Force per area of the boundary that the set belongs to, spread over its nodes."},
    {"body_force", LOAD_OF(LOAD_AT(body_force), "N/m^3"), .text = "Force per volume."},
    {"ramp", NUMBER_OF(LOAD_AT(ramp), "s"), .fallback = "0 s", NOT_NEGATIVE,
     .text = "The load grows evenly from 0 to its full value in this time; 0: at once."},
    {"table", KR_DECK_SECTION, .keys = table_keys,
     .text = "The load is what stands here times a factor from a table of measured or planned times: "
             "`{set: top, displacement: [free, 1 mm], table: {file: cycles.csv}}`."},
    {NULL},
};

static const struct kr_deck_key initial_keys[] = {
    {"displacement", LOAD_OF(AT(initial_displacement), "m"),
     .text = "Displacement of every node at time 0, an expression in x, y, z a component."},
    {"velocity", LOAD_OF(AT(initial_velocity), "m/s"),
     .text = "Velocity of every node at time 0, such as `[100*x m/s, 100*y m/s]` of a ring that flies "
             "apart."},
    {NULL},
};

#define STEPS_AT(field) offsetof(struct kr_case_steps, field)
static const struct kr_deck_key steps_keys[] = {
    {"count", KR_DECK_INTEGER, STEPS_AT(count), .fallback = "1", .least = 1, .most = 1e9,
     .text = "How many."},
    {"size", NUMBER_OF(STEPS_AT(size), "s"), POSITIVE,
     .text = "How far each moves the stage's clock, and with it the loads."},
    {NULL},
};

#define STAGE_AT(field) offsetof(struct kr_case_stage, field)
static const struct kr_deck_key stage_keys[] = {
    {"kind", KR_DECK_CHOICE, STAGE_AT(kind), .words = KR_STAGE_WORDS,
     .text = "`dynamic`: motion in time; `static`: load step by load step to equilibrium, breaking "
             "bonds until none is past its limit; `relaxation`: motion that is damped "
             "until it rests."},
    {"loads", LIST_OF(KR_DECK_LIST, struct kr_case_load, load_keys), .offset = STAGE_AT(loads),
     .text = "Loads of this stage alone, in place of the deck's. In all loads `t` is the stage's "
             "clock, which begins at 0."},
    {"end_time", NUMBER_OF(STAGE_AT(end_time), "s"), .fallback = "", POSITIVE,
     .text = "Dynamic: how long it lasts. Relaxation: how long at the most."},
    {"damping", NUMBER_OF(STAGE_AT(damping), "s^-1"), .fallback = "0 s^-1", NOT_NEGATIVE,
     .text = "Dynamic: a force density of this times density and velocity holds against the motion "
             "(Rayleigh's mass-proportional damping)."},
    {"steps", LIST_OF(KR_DECK_LIST, struct kr_case_steps, steps_keys), .offset = STAGE_AT(steps),
     .text = "Static: load steps, in turn: `[{count: 8, size: 1 s}, {count: 100, size: 0.01 s}]`. Not "
             "given: one of 1 s. The clock is one of the load alone: nothing moves in it."},
    {"least_step", NUMBER_OF(STAGE_AT(least_step), "s"), .fallback = "0 s", NOT_NEGATIVE,
     .text = "Static: a load step that would break the first bond is halved until it is no larger than "
             "this; 0: load steps are taken as they are."},
    {"end_below", NUMBER_OF(STAGE_AT(end_below), "1"), .fallback = "0.01", .least = 0, .most = 1,
     .text = "Static: once bonds broke, the run ends where what holds the body is less than this share of "
             "the most it was. It also ends where no bond joins two supports any more."},
    {"tolerance", NUMBER_OF(STAGE_AT(tolerance), "1"), .fallback = "1e-6", .least = 0, .most = 0.1,
     .exclusive = 1,
     .text = "Static and relaxation: forces left on free nodes, over the forces that hold the body."},
    {"breaks", KR_DECK_BOOLEAN, STAGE_AT(breaks), .fallback = "true",
     .text = "Whether bonds may break in this stage."},
    {NULL},
};

static const struct kr_deck_key solver_keys[] = {
    {"end_time", NUMBER_OF(AT(end_time), "s"), .fallback = "", POSITIVE,
     .text = "Time at which the run ends; needed where there are no `stages`, which have their own."},
    {"time_step", NUMBER_OF(AT(time_step), "s"), .fallback = "0 s", NOT_NEGATIVE,
     .text = "Step of velocity-Verlet; 0: the largest stable step times `safety_factor`."},
    {"precision", KR_DECK_CHOICE, AT(precision), .words = "double mixed", .fallback = "double",
     .text = "`mixed`: what the loop over bonds makes of the differences of displacements is "
             "float32, which is faster ([performance.md](performance.md#mixed-precision))."},
    {"safety_factor", NUMBER_OF(AT(safety_factor), "1"), .fallback = "0.8", .least = 0, .most = 1,
     .exclusive = 1, .text = "Share of the largest stable step that is taken."},
    {"checkpoint_every", NUMBER_OF(AT(checkpoint_every), "s"), .fallback = "600 s", NOT_NEGATIVE,
     .text = "Wall time between checkpoints, from which a stopped run goes on; 0: only when asked by "
             "a signal (SIGUSR1, or SIGTERM and SIGINT, which also stop the run)."},
    {NULL},
};

#define PROBE_AT(field) offsetof(struct kr_case_probe, field)
static const struct kr_deck_key probe_keys[] = {
    {"name", KR_DECK_TEXT, PROBE_AT(name), .text = "Name in the columns."},
    {"quantity", KR_DECK_CHOICE, PROBE_AT(quantity), .words = KR_QUANTITY_WORDS,
     .text = "What is told; each of its components is a column."},
    {"set", KR_DECK_TEXT, PROBE_AT(set), .fallback = "",
     .text = "Mean over the volume of the nodes of this set; or ..."},
    {"at", PLACE_OF(PROBE_AT(at)), .fallback = "",
     .text = "... that of the node nearest to this place."},
    {NULL},
};

static const struct kr_deck_key output_keys[] = {
    {"folder", KR_DECK_TEXT, AT(folder), .fallback = "",
     .text = "Folder of all results, made where it is missing; seen from where the program is "
             "called. Not given: `out/` and the name of the folder of the deck."},
    {"every", NUMBER_OF(AT(output_every), "s"), .fallback = "", POSITIVE,
     .text = "Time between two outputs of the fields. Without it and `at`: beginning and end "
             "alone."},
    {"at", KR_DECK_NUMBERS, AT(output_at), "s", .fallback = "", NOT_NEGATIVE,
     .text = "Further times at which the fields are written."},
    {"every_steps", KR_DECK_INTEGER, AT(every_steps), .fallback = "1", .least = 1, .most = 1e9,
     .text = "Static stages: load steps from one output of the fields to the next; the end of a "
             "stage always has one. history.csv has a line for each load step."},
    {"first_damage", KR_DECK_BOOLEAN, AT(first_damage), .fallback = "false",
     .text = "Write the fields where the first bond breaks, too."},
    {"every_bonds", KR_DECK_INTEGER, AT(every_bonds), .fallback = "0", .least = 0, .most = 1e12,
     .text = "Write the fields each time that so many bonds more have broken, too; 0: do not."},
    {"fields", KR_DECK_TEXTS, AT(fields), .fallback = "",
     .text = "Which fields the outputs hold: `displacement`, `velocity`, `damage`, `energy` (strain "
             "energy density), which are the default, and `stress` and `strain`. kirsch-plot draws "
             "what is there."},
    {"probes", LIST_OF(KR_DECK_LIST, struct kr_case_probe, probe_keys), .offset = AT(probes),
     .text = "Further columns of history.csv: `[{name: rim, quantity: stress, at: [6 mm, 5 mm]}]`. "
             "Reactions of loads are there anyway."},
    {"precision", KR_DECK_CHOICE, AT(double_fields), .words = "single double", .fallback = "single",
     .text = "Of the fields in the outputs: float32 or float64."},
    {"compression", KR_DECK_CHOICE, AT(compression), .words = KR_COMPRESSION_WORDS,
     .fallback = "scalars",
     .text = "Which fields are packed (shuffle and gzip): `scalars`, which shrink, for damage is mostly 0; "
             "`all`; `none`."},
    {"history_every", NUMBER_OF(AT(history_every), "s"), .fallback = "0 s", NOT_NEGATIVE,
     .text = "Time between two lines of history.csv; 0: every 20 steps."},
    {"damage_threshold", NUMBER_OF(AT(damage_threshold), "1"), .fallback = "0.35", .least = 0,
     .most = 1, .exclusive = 1,
     .text = "Damage from which a node counts as cracked: the time at which it passes is "
             "recorded."},
    {NULL},
};

#define BOX_AT(field) offsetof(struct kr_case_box, field)
static const struct kr_deck_key box_keys[] = {
    {"lower", VECTOR_OF(BOX_AT(lower)), .text = "Lower left corner."},
    {"upper", VECTOR_OF(BOX_AT(upper)), .text = "Upper right corner."},
    {"direction", KR_DECK_CHOICE, BOX_AT(direction), .words = "+x -x +y -y",
     .text = "Where the crack runs to: its tip is the cracked node farthest that way."},
    {NULL},
};

static const struct kr_deck_key track_keys[] = {
    {"window", KR_DECK_INTEGER, AT(window), .fallback = "30", .least = 1, .most = 1e9,
     .text = "Steps over which a crack's speed is taken."},
    {"boxes", LIST_OF(KR_DECK_LIST, struct kr_case_box, box_keys), .offset = AT(boxes),
     .text = "Parts of the plate in which one crack tip each is followed."},
    {NULL},
};

const struct kr_deck_key kr_case_keys[] = {
    {"title", KR_DECK_TEXT, AT(title), .fallback = "", .text = "A line for people."},
    {"preset", KR_DECK_CHOICE, AT(preset), .words = KR_PRESET_WORDS, .fallback = "none",
     .text = "Choices in one word, for keys that the deck does not give itself. `plates-paper`: as in "
             "the plates paper, `grid: near-boundary`, `partial_volume: hhb-one-sided`, "
             "`surface_correction: energy`, `surface_deformation: uniaxial-y`."},
    {"no_fail", KR_DECK_TEXTS, AT(no_fail), .fallback = "",
     .text = "Names of sets whose bonds never break, such as those that carry the load."},
    {"geometry", KR_DECK_SECTION, .keys = geometry_keys, .text = "The plate and its holes."},
    {"mesh", KR_DECK_SECTION, .keys = mesh_keys, .text = "How kirsch-mesh cuts it into cells."},
    {"nodes", KR_DECK_SECTION, .keys = nodes_keys,
     .text = "How kirsch-nodes turns cells into peridynamic nodes."},
    {"material", KR_DECK_SECTION, .keys = material_keys, .text = "What the plate is made of."},
    {"cracks", KR_DECK_SECTION, .keys = cracks_keys, .text = "Cracks before the run."},
    {"initial", KR_DECK_SECTION, .keys = initial_keys,
     .text = "How the run begins where it does not begin at rest. Prescribed motions win over it."},
    {"loads", LIST_OF(KR_DECK_LIST, struct kr_case_load, load_keys), .offset = AT(loads),
     .text = "What moves or pulls the plate. Each load has a set and just one of displacement, "
             "velocity, traction and body_force."},
    {"stages", LIST_OF(KR_DECK_LIST, struct kr_case_stage, stage_keys), .offset = AT(stages),
     .text = "Parts of the run, in turn; the body goes from one to the next as it is. Not given: one "
             "dynamic stage until `solver.end_time`."},
    {"solver", KR_DECK_SECTION, .keys = solver_keys, .text = "Time integration."},
    {"output", KR_DECK_SECTION, .keys = output_keys, .text = "What is written, and where."},
    {"track", KR_DECK_SECTION, .keys = track_keys, .text = "How kirsch-track follows cracks."},
    {NULL},
};

void kr_case_word(const char *words, int k, char word[32]) {
    size_t length;
    for (; k > 0; k--)
        words += strcspn(words, " ") + 1;
    length = strcspn(words, " ");
    if (length > 31)
        length = 31;
    memcpy(word, words, length);
    word[length] = 0;
}
