/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The near-boundary grid (section 3 of the plates paper), with one change: the boxes around holes
 * are snapped outward to the lattice and united where they touch, so that no cut line makes
 * slivers and all that lies between them is exact squares.
 *
 * gmsh gets each region in spacings from its own origin, where the lattice's points are small whole
 * numbers and its absolute tolerances mean the same for every plate.
 */
#include "near_boundary.h"

#include "base/error.h"
#include "base/memory.h"
#include "boxes.h"
#include "builder.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/** A region with its request; lattice point (i0, j0) is the request's origin. */
struct part {
    const struct kr_region *region;
    size_t i0, j0;
    size_t *hole_from; /* (n_holes) where the points of a hole begin among those on the loops */
};

static void ask_perimeter(const struct part *part, struct kr_gmsh_region *ask) {
    for (size_t l = 0; l < part->region->n_loops; l++) {
        const struct kr_region_loop *loop = &part->region->loop[l];
        for (size_t k = 0; k < loop->n_corners; k++) {
            size_t at = ask->first[l] + k;
            ask->corner[2 * at] = (double)loop->corner[k].i - (double)part->i0;
            ask->corner[2 * at + 1] = (double)loop->corner[k].j - (double)part->j0;
            ask->segments[at] = loop->corner[k].run;
        }
        ask->first[l + 1] = ask->first[l] + loop->n_corners;
    }
}

/** A hole's polygon, clockwise: the region lies on its left. */
static void ask_hole(const struct kr_plate *plate, const struct part *part, size_t hole,
                     size_t loop, struct kr_gmsh_region *ask) {
    const struct kr_case_hole *of = &plate->hole[hole];
    size_t sides = kr_plate_sides(of->radius, plate->spacing);
    double r = kr_plate_corner_radius(of->radius, sides) / plate->spacing;
    double x = of->centre[0] / plate->spacing - (double)part->i0;
    double y = of->centre[1] / plate->spacing - (double)part->j0;
    for (size_t k = 0; k < sides; k++) {
        double angle = -2 * PI * (double)k / (double)sides;
        size_t at = ask->first[loop] + k;
        ask->corner[2 * at] = x + r * cos(angle);
        ask->corner[2 * at + 1] = y + r * sin(angle);
        ask->segments[at] = 1;
    }
    ask->first[loop + 1] = ask->first[loop] + sides;
}

static size_t count_corners(const struct kr_plate *plate, const struct kr_region *region) {
    size_t n = 0;
    for (size_t l = 0; l < region->n_loops; l++)
        n += region->loop[l].n_corners;
    for (size_t h = 0; h < region->n_holes; h++)
        n += kr_plate_sides(plate->hole[region->hole[h]].radius, plate->spacing);
    return n;
}

static char *name_of(const struct kr_region *region) {
    char *name =
        kr_text(region->n_holes > 1 ? "around holes %zu" : "around hole_%zu", region->hole[0] + 1);
    for (size_t h = 1; h < region->n_holes; h++) {
        char *longer = kr_text("%s, %zu", name, region->hole[h] + 1);
        kr_free(name);
        name = longer;
    }
    return name;
}

static void ask(const struct kr_plate *plate, const struct kr_region *region, struct part *part,
                struct kr_gmsh_region *out) {
    size_t corners = count_corners(plate, region), on_loops = 0;
    *part = (struct part){region, region->loop[0].corner[0].i, region->loop[0].corner[0].j,
                          KR_NEW(size_t, region->n_holes)};
    *out = (struct kr_gmsh_region){.n_loops = region->n_loops + region->n_holes};
    out->first = KR_NEW(size_t, out->n_loops + 1);
    out->corner = KR_NEW(double, 2 * corners);
    out->segments = KR_NEW(size_t, corners);
    ask_perimeter(part, out);
    for (size_t k = 0; k < out->first[region->n_loops]; k++)
        on_loops += out->segments[k];
    for (size_t h = 0; h < region->n_holes; h++) {
        size_t loop = region->n_loops + h;
        ask_hole(plate, part, region->hole[h], loop, out);
        part->hole_from[h] = on_loops;
        on_loops += out->first[loop + 1] - out->first[loop];
    }
}

/** Take a filled region into the mesh; `number` gets the place in the mesh of its points. */
static size_t *take_cells(struct kr_builder *builder, const struct part *part,
                          const struct kr_gmsh_region *got) {
    size_t *number = KR_NEW(size_t, got->n_points);
    size_t on_perimeter = part->region->n_holes ? part->hole_from[0] : got->n_on_loops;
    double dx = builder->lattice.spacing;
    for (size_t p = 0; p < got->n_points; p++) {
        double i = got->point[2 * p] + (double)part->i0;
        double j = got->point[2 * p + 1] + (double)part->j0;
        number[p] = p < on_perimeter ? kr_builder_lattice_point(builder, (size_t)i, (size_t)j)
                                     : kr_builder_point(builder, i * dx, j * dx);
    }
    for (size_t c = 0; c < got->n_cells; c++) {
        size_t n = got->cell_first[c + 1] - got->cell_first[c], point[4];
        for (size_t k = 0; k < n; k++)
            point[k] = number[got->vertex[got->cell_first[c] + k]];
        kr_builder_cell(builder, n, point);
    }
    return number;
}

/** The edges of a hole, in the sense of its request. */
static void take_hole(struct kr_builder *builder, const size_t *number, size_t from, size_t sides) {
    for (size_t k = 0; k < sides; k++)
        kr_builder_edge(builder, number[from + k], number[from + (k + 1) % sides]);
}

static void report_region(const struct kr_gmsh_region *got, struct kr_plate_region *out) {
    *out = (struct kr_plate_region){kr_text_copy(got->name), got->method, got->n_cells, 0,
                                    got->seconds};
    for (size_t c = 0; c < got->n_cells; c++)
        out->n_triangles += got->cell_first[c + 1] - got->cell_first[c] == 3;
}

/** Put lattice and regions together. */
static struct kr_mesh *assemble(const struct kr_plate *plate, const struct kr_lattice *lattice,
                                const struct kr_regions *regions, const struct part *part,
                                const struct kr_gmsh_region *got) {
    struct kr_builder builder = kr_builder_begin(lattice);
    size_t **number = KR_NEW(size_t *, regions->count);
    size_t *region_of = KR_NEW(size_t, plate->n_holes), *place_of = KR_NEW(size_t, plate->n_holes);
    for (size_t c = 0; c < lattice->columns * lattice->rows; c++)
        if (regions->of_cell[c] < 0)
            kr_builder_square(&builder, c % lattice->columns, c / lattice->columns);
    for (size_t r = 0; r < regions->count; r++) {
        number[r] = take_cells(&builder, &part[r], &got[r]);
        for (size_t h = 0; h < regions->region[r].n_holes; h++) {
            region_of[regions->region[r].hole[h]] = r;
            place_of[regions->region[r].hole[h]] = part[r].hole_from[h];
        }
    }
    kr_builder_outline(&builder, NULL);
    for (size_t h = 0; h < plate->n_holes; h++) {
        char *name = kr_text("hole_%zu", h + 1);
        take_hole(&builder, number[region_of[h]], place_of[h],
                  kr_plate_sides(plate->hole[h].radius, plate->spacing));
        kr_builder_group_edges(&builder, name);
        kr_free(name);
    }
    for (size_t r = 0; r < regions->count; r++)
        kr_free(number[r]);
    kr_free(number);
    kr_free(region_of);
    kr_free(place_of);
    return kr_builder_end(&builder);
}

/** Area of the plate less the holes' polygons. */
static double polygonal_area(const struct kr_plate *plate, const struct kr_lattice *lattice) {
    double area =
        (double)lattice->columns * lattice->spacing * (double)lattice->rows * lattice->spacing;
    for (size_t h = 0; h < plate->n_holes; h++) {
        size_t sides = kr_plate_sides(plate->hole[h].radius, plate->spacing);
        double r = kr_plate_corner_radius(plate->hole[h].radius, sides);
        area -= (double)sides / 2 * r * r * sin(2 * PI / (double)sides);
    }
    return area;
}

struct kr_mesh *kr_near_boundary_mesh(const struct kr_plate *plate,
                                      const struct kr_lattice *lattice,
                                      struct kr_plate_report *report) {
    if (plate->n_holes && !(plate->padding >= plate->spacing * (1 - 1e-9)))
        kr_stop(KR_EXIT_INPUT,
                "a padding of %.9g mm is below the spacing of %.9g mm: quadrilaterals need room "
                "between a hole and its box; the horizon is a good padding",
                1e3 * plate->padding, 1e3 * plate->spacing);
    struct kr_regions *regions =
        kr_regions_create(lattice, plate->n_holes, plate->hole, plate->padding);
    struct part *part = KR_NEW(struct part, regions->count);
    struct kr_gmsh_region *region = KR_NEW(struct kr_gmsh_region, regions->count);
    char **name = KR_NEW(char *, regions->count);
    for (size_t r = 0; r < regions->count; r++) {
        ask(plate, &regions->region[r], &part[r], &region[r]);
        region[r].name = name[r] = name_of(&regions->region[r]);
    }
    kr_gmsh_fill(regions->count, region, &plate->gmsh);
    struct kr_mesh *mesh = assemble(plate, lattice, regions, part, region);

    report->n_lattice = mesh->n_cells;
    report->n_regions = regions->count;
    report->region = KR_NEW(struct kr_plate_region, regions->count);
    report->polygonal_area = polygonal_area(plate, lattice);
    for (size_t r = 0; r < regions->count; r++) {
        report_region(&region[r], &report->region[r]);
        report->n_lattice -= region[r].n_cells;
        kr_gmsh_region_free(&region[r]);
        kr_free(part[r].hole_from);
        kr_free(name[r]);
    }
    kr_free(name);
    kr_free(part);
    kr_free(region);
    kr_regions_free(regions);
    return mesh;
}
