/* SPDX-License-Identifier: BSD-3-Clause
 *
 * From marked cells to loops: gather the directed steps with region on their left, chain them, and
 * put each inner loop into the smallest outer one around it.
 */
#include "region.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

struct step {
    size_t from, to;
};

/** All steps, and where those that leave a point begin when they are sorted by it. */
struct steps {
    const struct kr_lattice *lattice;
    const struct kr_polygon *polygon;
    size_t n, room, n_points;
    struct step *step;
    size_t *first;
};

static size_t lattice_points(const struct kr_lattice *lattice) {
    return (lattice->columns + 1) * (lattice->rows + 1);
}

size_t kr_region_corner(const struct kr_lattice *lattice, const struct kr_polygon *polygon,
                        size_t corner) {
    const double *p = polygon->point + 2 * corner;
    if (p[0] == nearbyint(p[0]) && p[1] == nearbyint(p[1]) && p[0] >= 0 && p[1] >= 0 &&
        p[0] <= (double)lattice->columns && p[1] <= (double)lattice->rows)
        return kr_lattice_point(lattice, (size_t)p[0], (size_t)p[1]);
    return lattice_points(lattice) + corner;
}

void kr_region_place(const struct kr_lattice *lattice, const struct kr_polygon *polygon,
                     size_t point, double place[2]) {
    size_t n = lattice_points(lattice), wide = lattice->columns + 1;
    place[0] = point < n ? (double)(point % wide) : polygon->point[2 * (point - n)];
    place[1] = point < n ? (double)(point / wide) : polygon->point[2 * (point - n) + 1];
}

static void add_step(struct steps *steps, size_t from, size_t to) {
    KR_GROW(steps->step, steps->n, steps->room);
    steps->step[steps->n++] = (struct step){from, to};
}

/** Steps between a marked cell and the squares around it. */
static void steps_of_cell(struct steps *steps, size_t i, size_t j, const int32_t *holder,
                          const unsigned char *marked) {
    static const int to[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}}; /* neighbour over side k */
    static const size_t end[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    const struct kr_lattice *lattice = steps->lattice;
    for (int k = 0; k < 4; k++) {
        size_t ni = i + (size_t)to[k][0], nj = j + (size_t)to[k][1]; /* 0 less one is large */
        if (ni >= lattice->columns || nj >= lattice->rows)
            continue;
        size_t c = kr_lattice_cell(lattice, ni, nj);
        if (!marked[c] && !holder[c])
            add_step(steps, kr_lattice_point(lattice, i + end[k][0], j + end[k][1]),
                     kr_lattice_point(lattice, i + end[k + 1][0], j + end[k + 1][1]));
    }
}

/** Whether the cell just left of a side's middle is marked. */
static int side_is_marked(const struct kr_lattice *lattice, const struct kr_polygon *polygon,
                          size_t side, const unsigned char *marked) {
    const double *p = polygon->point + 2 * side, *q = polygon->point + 2 * polygon->next[side];
    double x = (p[0] + q[0]) / 2 - 1e-6 * (q[1] - p[1]);
    double y = (p[1] + q[1]) / 2 + 1e-6 * (q[0] - p[0]);
    size_t i = x > 0 ? (size_t)x : 0, j = y > 0 ? (size_t)y : 0;
    i = i < lattice->columns ? i : lattice->columns - 1;
    j = j < lattice->rows ? j : lattice->rows - 1;
    return marked[kr_lattice_cell(lattice, i, j)];
}

static void sort_steps(struct steps *steps) {
    struct step *sorted = KR_NEW(struct step, steps->n);
    size_t *filled = KR_NEW(size_t, steps->n_points);
    steps->first = KR_NEW(size_t, steps->n_points + 1);
    for (size_t s = 0; s < steps->n; s++)
        steps->first[steps->step[s].from + 1]++;
    for (size_t p = 0; p < steps->n_points; p++)
        steps->first[p + 1] += steps->first[p];
    for (size_t s = 0; s < steps->n; s++) {
        size_t p = steps->step[s].from;
        sorted[steps->first[p] + filled[p]++] = steps->step[s];
    }
    kr_free(filled);
    kr_free(steps->step);
    steps->step = sorted;
}

/** Turn from the way back to the way on, clockwise, above 0 up to 2 pi. */
static double clockwise(const struct steps *steps, const struct step *in, size_t to) {
    double a[2], b[2], c[2];
    kr_region_place(steps->lattice, steps->polygon, in->from, a);
    kr_region_place(steps->lattice, steps->polygon, in->to, b);
    kr_region_place(steps->lattice, steps->polygon, to, c);
    double turn = atan2(a[1] - b[1], a[0] - b[0]) - atan2(c[1] - b[1], c[0] - b[0]);
    return turn <= 1e-12 ? turn + 2 * M_PI : turn;
}

/** The unwalked step that goes on: where several do, the first clockwise from the way back. */
static size_t next_step(const struct steps *steps, const unsigned char *walked, size_t at) {
    size_t p = steps->step[at].to, best = steps->n;
    double least = INFINITY;
    for (size_t s = steps->first[p]; s < steps->first[p + 1]; s++) {
        double turn = walked[s] ? INFINITY : clockwise(steps, &steps->step[at], steps->step[s].to);
        if (turn < least) {
            least = turn;
            best = s;
        }
    }
    return best;
}

static struct kr_region_loop walk(const struct steps *steps, size_t start,
                                  unsigned char *walked) {
    struct kr_region_loop loop = {0, NULL, 0};
    size_t room = 0, at = start;
    double o[2], p[2], q[2];
    kr_region_place(steps->lattice, steps->polygon, steps->step[start].from, o);
    do {
        const struct step *step = &steps->step[at];
        walked[at] = 1;
        KR_GROW(loop.point, loop.n, room);
        loop.point[loop.n++] = step->from;
        kr_region_place(steps->lattice, steps->polygon, step->from, p);
        kr_region_place(steps->lattice, steps->polygon, step->to, q);
        loop.area += ((p[0] - o[0]) * (q[1] - o[1]) - (q[0] - o[0]) * (p[1] - o[1])) / 2;
        if (step->to == steps->step[start].from)
            break;
        at = next_step(steps, walked, at);
        kr_assert(at < steps->n);
    } while (1);
    return loop;
}

/** Whether a loop goes round a place: crossings of the line to its right. */
static int goes_round(const struct steps *steps, const struct kr_region_loop *loop,
                      const double place[2]) {
    int inside = 0;
    for (size_t k = 0; k < loop->n; k++) {
        double p[2], q[2];
        kr_region_place(steps->lattice, steps->polygon, loop->point[k], p);
        kr_region_place(steps->lattice, steps->polygon, loop->point[k + 1 < loop->n ? k + 1 : 0],
                        q);
        if ((p[1] > place[1]) != (q[1] > place[1]) &&
            p[0] + (q[0] - p[0]) * (place[1] - p[1]) / (q[1] - p[1]) > place[0])
            inside = !inside;
    }
    return inside;
}

static void add_loop(struct kr_region *region, struct kr_region_loop loop) {
    region->loop = kr_realloc(region->loop, region->n_loops + 1, sizeof *region->loop);
    region->loop[region->n_loops++] = loop;
}

/** Outer loops make regions; inner ones go to the smallest region around them. */
static struct kr_regions sort_loops(const struct steps *steps, size_t n,
                                    const struct kr_region_loop *loop) {
    struct kr_regions regions = {0, NULL};
    size_t room = 0;
    for (size_t l = 0; l < n; l++)
        if (loop[l].area > 0) {
            KR_GROW(regions.region, regions.count, room);
            regions.region[regions.count] = (struct kr_region){0, NULL};
            add_loop(&regions.region[regions.count++], loop[l]);
        }
    for (size_t l = 0; l < n; l++) {
        struct kr_region *best = NULL;
        double p[2], q[2], middle[2];
        if (loop[l].area > 0)
            continue;
        kr_region_place(steps->lattice, steps->polygon, loop[l].point[0], p);
        kr_region_place(steps->lattice, steps->polygon, loop[l].point[1], q);
        for (int d = 0; d < 2; d++) /* on the region's side: a corner may be shared */
            middle[d] = (p[d] + q[d]) / 2 + 1e-6 * (d ? q[0] - p[0] : p[1] - q[1]);
        for (size_t r = 0; r < regions.count; r++)
            if ((!best || regions.region[r].loop[0].area < best->loop[0].area) &&
                goes_round(steps, &regions.region[r].loop[0], middle))
                best = &regions.region[r];
        kr_assert(best);
        add_loop(best, loop[l]);
    }
    return regions;
}

struct kr_regions kr_regions_of(const struct kr_lattice *lattice, const struct kr_polygon *polygon,
                                const int32_t *holder, const unsigned char *marked) {
    struct steps steps = {.lattice = lattice, .polygon = polygon};
    struct kr_region_loop *loop = NULL;
    size_t n = 0, room = 0;
    steps.n_points = lattice_points(lattice) + polygon->n;
    for (size_t j = 0; j < lattice->rows; j++)
        for (size_t i = 0; i < lattice->columns; i++) {
            size_t c = kr_lattice_cell(lattice, i, j);
            if (marked[c] && !holder[c])
                steps_of_cell(&steps, i, j, holder, marked);
        }
    for (size_t s = 0; s < polygon->n; s++)
        if (side_is_marked(lattice, polygon, s, marked))
            add_step(&steps, kr_region_corner(lattice, polygon, s),
                     kr_region_corner(lattice, polygon, polygon->next[s]));
    sort_steps(&steps);
    unsigned char *walked = KR_NEW(unsigned char, steps.n);
    for (size_t s = 0; s < steps.n; s++)
        if (!walked[s]) {
            KR_GROW(loop, n, room);
            loop[n++] = walk(&steps, s, walked);
        }
    struct kr_regions regions = sort_loops(&steps, n, loop);
    kr_free(loop);
    kr_free(walked);
    kr_free(steps.first);
    kr_free(steps.step);
    return regions;
}

/** The longest of a region's sides whose middle is no lattice point: its place on a loop. 0 where
 *  there is none. */
static int longest_side(const struct kr_lattice *lattice, const struct kr_polygon *polygon,
                        const struct kr_region *region, size_t *loop, size_t *place) {
    size_t n_lattice = lattice_points(lattice);
    double longest = 0;
    for (size_t l = 0; l < region->n_loops; l++)
        for (size_t k = 0; k < region->loop[l].n; k++) {
            size_t from = region->loop[l].point[k];
            size_t to = region->loop[l].point[k + 1 < region->loop[l].n ? k + 1 : 0];
            double p[2], q[2];
            kr_region_place(lattice, polygon, from, p);
            kr_region_place(lattice, polygon, to, q);
            double length = hypot(q[0] - p[0], q[1] - p[1]);
            int is_side = from >= n_lattice && !polygon->on_line[from - n_lattice];
            double x = (p[0] + q[0]) / 2, y = (p[1] + q[1]) / 2;
            if (!is_side || length <= longest || (x == nearbyint(x) && y == nearbyint(y)))
                continue;
            longest = length;
            *loop = l;
            *place = k;
        }
    return longest > 0;
}

void kr_regions_even(struct kr_regions *regions, const struct kr_lattice *lattice, struct kr_polygon *polygon) {
    size_t n_lattice = lattice_points(lattice);
    for (size_t r = 0; r < regions->count; r++) {
        struct kr_region *region = &regions->region[r];
        size_t sides = 0, l, k = 0;
        for (l = 0; l < region->n_loops; l++)
            sides += region->loop[l].n;
        if (sides % 2 == 0 || !longest_side(lattice, polygon, region, &l, &k))
            continue;
        struct kr_region_loop *loop = &region->loop[l];
        size_t corner = kr_polygon_split(polygon, loop->point[k] - n_lattice);
        loop->point = kr_realloc(loop->point, loop->n + 1, sizeof *loop->point);
        memmove(loop->point + k + 2, loop->point + k + 1, (loop->n - k - 1) * sizeof *loop->point);
        loop->point[k + 1] = n_lattice + corner;
        loop->n++;
    }
}

void kr_regions_free(struct kr_regions *regions) {
    for (size_t r = 0; r < regions->count; r++) {
        for (size_t l = 0; l < regions->region[r].n_loops; l++)
            kr_free(regions->region[r].loop[l].point);
        kr_free(regions->region[r].loop);
    }
    kr_free(regions->region);
    *regions = (struct kr_regions){0, NULL};
}
