/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The near-boundary grid (section 3 of the plates paper), with one change: the boxes around holes
 * are snapped outward to the lattice and united where they touch, so that no cut line makes
 * slivers and all that lies between them is exact squares. Where the outline does not fit the
 * lattice, it has boxes as holes have. On the free grid the whole body is one box.
 *
 * gmsh gets each region in spacings from its own origin, where the lattice's points are small whole
 * numbers and its absolute tolerances mean the same for every plate.
 */
#include "near_boundary.h"

#include "base/error.h"
#include "base/memory.h"
#include "boxes.h"
#include "builder.h"
#include "fill.h"
#include "region.h"

#include <math.h>
#include <string.h>

/* Area, in spacings squared, up to which the whole plate is filled by the most even method. Blossom
 * pairs all triangles of a region at once: 17 s for 25 000 cells, 120 s for 50 000, while packing
 * alone takes 15 s for those and leaves one cell in a hundred a triangle. */
static const double MOST_PAIRED = 15000;

/* Time for one attempt beyond which gmsh hangs: 300 s, or for large plates ten times what packing
 * takes (0.3 ms a cell). */
static unsigned longest_for(double cells) {
    return (unsigned)fmax(300, 3e-3 * cells);
}

/** What every step below needs. */
struct filling {
    const struct kr_plate *plate;
    const struct kr_plate_body *body;
    struct kr_polygon polygon;
    struct kr_regions regions;
    struct kr_gmsh_region *asked; /* (regions) */
    char **name;                  /* (regions) */
    double (*origin)[2];          /* (regions) lattice point that is a request's origin */
};

static unsigned char *mark_cells(const struct kr_plate *plate, const struct kr_plate_body *body,
                                 const struct kr_polygon *polygon) {
    const struct kr_lattice *lattice = &body->lattice;
    size_t cells = lattice->columns * lattice->rows;
    unsigned char *marked = KR_NEW(unsigned char, cells);
    double box[1][4], padding = plate->padding / lattice->spacing;
    if (plate->grid == KR_GRID_FREE) {
        memset(marked, 1, cells);
        return marked;
    }
    for (size_t h = 0; h < body->n_holes; h++) {
        kr_curve_box(&body->hole[h], box[0]);
        kr_boxes_mark(lattice, 1, (const double(*)[4])box, padding, marked);
    }
    for (size_t s = 0; s < polygon->n; s++) {
        const double *p = polygon->point + 2 * s, *q = polygon->point + 2 * polygon->next[s];
        if (polygon->group[s] >= body->first_hole || polygon->on_line[s])
            continue;
        for (int d = 0; d < 2; d++) {
            box[0][d] = fmin(p[d], q[d]);
            box[0][2 + d] = fmax(p[d], q[d]);
        }
        kr_boxes_mark(lattice, 1, (const double(*)[4])box, padding, marked);
    }
    kr_boxes_join_corners(lattice, marked);
    return marked;
}

/** "around hole_3", "around outline, holes 3, 4": the boundaries that do not fit the lattice. */
static char *name_of(const struct filling *f, const struct kr_region *region) {
    size_t n_lattice = (f->body->lattice.columns + 1) * (f->body->lattice.rows + 1);
    unsigned char *seen = KR_NEW(unsigned char, f->body->n_groups);
    char *name = kr_text("around");
    int named = 0, holes = 0;
    for (size_t l = 0; l < region->n_loops; l++)
        for (size_t k = 0; k < region->loop[l].n; k++)
            if (region->loop[l].point[k] >= n_lattice) {
                size_t corner = region->loop[l].point[k] - n_lattice;
                seen[f->polygon.group[corner]] |= !f->polygon.on_line[corner];
            }
    for (int g = f->body->first_hole; g < (int)f->body->n_groups; g++)
        holes += seen[g];
    for (int g = 0, hole = 0; g < (int)f->body->n_groups; g++) {
        int number = g - f->body->first_hole + 1;
        if (!seen[g])
            continue;
        hole += number > 0;
        char *comma = named++ ? "," : "";
        char *longer = number < 1 || holes == 1
                           ? kr_text("%s%s %s", name, comma, f->body->group[g])
                           : kr_text("%s%s %s%d", name, comma, hole == 1 ? "holes " : "", number);
        kr_free(name);
        name = longer;
    }
    kr_free(seen);
    return name;
}

/** Whether the step after point k of a loop goes on as the step before it, between lattice points:
 *  then gmsh gets both as one line. */
static int goes_on(const struct filling *f, const struct kr_region_loop *loop, size_t k) {
    size_t n_lattice = (f->body->lattice.columns + 1) * (f->body->lattice.rows + 1);
    size_t before = loop->point[(k + loop->n - 1) % loop->n], here = loop->point[k];
    size_t after = loop->point[(k + 1) % loop->n];
    if (before >= n_lattice || here >= n_lattice || after >= n_lattice)
        return 0;
    /* Steps between lattice points all have length 1 but where one was left out near a corner. */
    return after - here == here - before &&
           (here - before == 1 || before - here == 1 ||
            here - before == f->body->lattice.columns + 1 ||
            before - here == f->body->lattice.columns + 1);
}

static void ask_loop(const struct filling *f, const struct kr_region_loop *loop,
                     const double origin[2], size_t l, struct kr_gmsh_region *out) {
    size_t at = out->first[l];
    for (size_t k = 0; k < loop->n; k++) {
        double place[2];
        if (k > 0 && goes_on(f, loop, k)) {
            out->segments[at - 1]++;
            continue;
        }
        kr_region_place(&f->body->lattice, &f->polygon, loop->point[k], place);
        out->corner[2 * at] = place[0] - origin[0];
        out->corner[2 * at + 1] = place[1] - origin[1];
        out->segments[at++] = 1;
    }
    out->first[l + 1] = at;
}

static void ask(struct filling *f, size_t r) {
    const struct kr_region *region = &f->regions.region[r];
    struct kr_gmsh_region *out = &f->asked[r];
    size_t points = 0;
    for (size_t l = 0; l < region->n_loops; l++)
        points += region->loop[l].n;
    *out = (struct kr_gmsh_region){.n_loops = region->n_loops};
    out->first = KR_NEW(size_t, out->n_loops + 1);
    out->corner = KR_NEW(double, 2 * points);
    out->segments = KR_NEW(size_t, points);
    out->name = f->name[r] = name_of(f, region);
    kr_region_place(&f->body->lattice, &f->polygon, region->loop[0].point[0], f->origin[r]);
    for (int d = 0; d < 2; d++)
        f->origin[r][d] = floor(f->origin[r][d]);
    for (size_t l = 0; l < region->n_loops; l++)
        ask_loop(f, &region->loop[l], f->origin[r], l, out);
}

/** Place in the mesh of a point of the perimeters; `known` holds it plus 1 for corners of the
 *  polygon that are in the mesh. */
static size_t take_point(struct kr_builder *builder, const struct filling *f, size_t *known,
                         size_t point) {
    const struct kr_lattice *lattice = &f->body->lattice;
    size_t wide = lattice->columns + 1, n_lattice = wide * (lattice->rows + 1);
    if (point < n_lattice)
        return kr_builder_lattice_point(builder, point % wide, point / wide);
    size_t *number = &known[point - n_lattice];
    if (!*number)
        *number = 1 + kr_builder_point(builder,
                                       f->polygon.point[2 * (point - n_lattice)] * lattice->spacing,
                                       f->polygon.point[2 * (point - n_lattice) + 1] *
                                           lattice->spacing);
    return *number - 1;
}

/** Take a filled region into the mesh. */
static void take_region(struct kr_builder *builder, const struct filling *f, size_t r,
                        size_t *known) {
    const struct kr_region *region = &f->regions.region[r];
    const struct kr_gmsh_region *got = &f->asked[r];
    size_t *number = KR_NEW(size_t, got->n_points), p = 0;
    double dx = builder->lattice.spacing;
    for (size_t l = 0; l < region->n_loops; l++)
        for (size_t k = 0; k < region->loop[l].n; k++)
            number[p++] = take_point(builder, f, known, region->loop[l].point[k]);
    kr_assert(p == got->n_on_loops);
    for (; p < got->n_points; p++)
        number[p] = kr_builder_point(builder, (got->point[2 * p] + f->origin[r][0]) * dx,
                                     (got->point[2 * p + 1] + f->origin[r][1]) * dx);
    for (size_t c = 0; c < got->n_cells; c++) {
        size_t n = got->cell_first[c + 1] - got->cell_first[c], point[4];
        for (size_t k = 0; k < n; k++)
            point[k] = number[got->vertex[got->cell_first[c] + k]];
        kr_builder_cell(builder, n, point);
    }
    kr_free(number);
}

static void take_edges(struct kr_builder *builder, const struct filling *f, size_t *known) {
    const struct kr_lattice *lattice = &f->body->lattice;
    for (size_t g = 0; g < f->body->n_groups; g++) {
        for (size_t s = 0; s < f->polygon.n; s++)
            if (f->polygon.group[s] == (int)g) {
                size_t from = kr_region_corner(lattice, &f->polygon, s);
                size_t to = kr_region_corner(lattice, &f->polygon, f->polygon.next[s]);
                kr_builder_edge(builder, take_point(builder, f, known, from),
                                take_point(builder, f, known, to));
            }
        kr_builder_group_edges(builder, f->body->group[g]);
    }
}

static void report_region(const struct kr_gmsh_region *got, struct kr_plate_region *out) {
    *out = (struct kr_plate_region){kr_text_copy(got->name), got->method, got->n_cells, 0,
                                    got->seconds};
    for (size_t c = 0; c < got->n_cells; c++)
        out->n_triangles += got->cell_first[c + 1] - got->cell_first[c] == 3;
}

/** Put lattice and regions together. */
static struct kr_mesh *assemble(const struct filling *f, const unsigned char *marked,
                                struct kr_plate_report *report) {
    const struct kr_lattice *lattice = &f->body->lattice;
    struct kr_builder builder = kr_builder_begin(lattice);
    size_t *known = KR_NEW(size_t, f->polygon.n);
    for (size_t c = 0; c < lattice->columns * lattice->rows; c++)
        if (!marked[c] && !f->body->holder[c])
            kr_builder_square(&builder, c % lattice->columns, c / lattice->columns);
    report->n_lattice = builder.mesh->n_cells;
    report->n_regions = f->regions.count;
    report->region = KR_NEW(struct kr_plate_region, f->regions.count);
    for (size_t r = 0; r < f->regions.count; r++) {
        take_region(&builder, f, r, known);
        report_region(&f->asked[r], &report->region[r]);
    }
    take_edges(&builder, f, known);
    kr_free(known);
    return kr_builder_end(&builder);
}

struct kr_mesh *kr_near_boundary_mesh(const struct kr_plate *plate,
                                      const struct kr_plate_body *body,
                                      struct kr_plate_report *report) {
    struct filling f = {.plate = plate, .body = body};
    f.polygon = kr_polygon_of(&body->exact, &body->lattice);
    size_t rough = body->n_holes; /* edges that do not fit the lattice */
    for (size_t s = 0; s < f.polygon.n; s++)
        rough += !f.polygon.on_line[s];
    if (rough && plate->grid != KR_GRID_FREE && !(plate->padding >= plate->spacing * (1 - 1e-9)))
        kr_stop(KR_EXIT_INPUT,
                "a padding of %.9g mm is below the spacing of %.9g mm: quadrilaterals need room "
                "between a hole and its box; the horizon is a good padding",
                1e3 * plate->padding, 1e3 * plate->spacing);
    unsigned char *marked = mark_cells(plate, body, &f.polygon);
    f.regions = kr_regions_of(&body->lattice, &f.polygon, body->holder, marked);
    kr_regions_even(&f.regions, &body->lattice, &f.polygon);
    f.asked = KR_NEW(struct kr_gmsh_region, f.regions.count);
    f.name = KR_NEW(char *, f.regions.count);
    f.origin = kr_alloc(f.regions.count, sizeof *f.origin);
    for (size_t r = 0; r < f.regions.count; r++)
        ask(&f, r);
    struct kr_gmsh_options options = plate->gmsh;
    if (plate->grid == KR_GRID_FREE && f.polygon.area > MOST_PAIRED) {
        options.first = KR_FILL_LINEAR;
        options.seconds = options.seconds ? options.seconds : longest_for(f.polygon.area);
    }
    kr_gmsh_fill(f.regions.count, f.asked, &options);
    report->polygonal_area = f.polygon.area * body->lattice.spacing * body->lattice.spacing;
    struct kr_mesh *mesh = assemble(&f, marked, report);

    for (size_t r = 0; r < f.regions.count; r++) {
        kr_gmsh_region_free(&f.asked[r]);
        kr_free(f.name[r]);
    }
    kr_free(f.name);
    kr_free(f.asked);
    kr_free(f.origin);
    kr_free(marked);
    kr_regions_free(&f.regions);
    kr_polygon_free(&f.polygon);
    return mesh;
}
