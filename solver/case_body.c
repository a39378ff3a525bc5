/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The deck's keys that say what the body is: its geometry, how it is cut into cells, and how these become
 * nodes with sets. The other sections are in case.c.
 */
#include "case_keys.h"

#define HOLE_AT(field) offsetof(struct kr_case_hole, field)
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

const struct kr_deck_key kr_case_geometry_keys[] = {
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

const struct kr_deck_key kr_case_mesh_keys[] = {
    {"file", KR_DECK_TEXT, AT(mesh_file), .fallback = "",
     .text = "A mesh from elsewhere, instead of one by kirsch-mesh; a path from the deck's folder. What "
             "can be read: [formats.md](formats.md#meshes-from-elsewhere)."},
    {"grid", KR_DECK_CHOICE, AT(grid), .words = KR_GRID_WORDS,
     .fallback = "voronoi",
     .text = "`voronoi`: a square lattice, near edges Voronoi cells that the edge cuts exactly; "
             "`near-boundary`: the plates paper's, the lattice cut out around each hole and filled "
             "there by gmsh with cells that follow the rim; `uniform`: the lattice alone, with "
             "jagged holes; `free`: gmsh everywhere ([grids.md](grids.md))."},
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

const struct kr_deck_key kr_case_nodes_keys[] = {
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
