/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The Voronoi grid. Seeds stand at the centres of the lattice's cells; those near an edge that does
 * not fit the lattice move. Two cells further the seeds stay where they are and the cells are
 * squares again, which the lattice continues. So the Voronoi cells are needed in a band only.
 *
 * A cell that an edge cuts may fall into pieces. The seed's own piece is its cell; a large other
 * piece gets a seed of its own, a small one is joined to a neighbour in the end. Where a cell
 * reaches as far as is looked for neighbours (in the tip of a wedge), a seed is set there, too.
 */
#include "voronoi.h"

#include "base/error.h"
#include "base/memory.h"
#include "boxes.h"
#include "cell.h"
#include "seeds.h"
#include "weld_mesh.h"

#include <math.h>
#include <string.h>

/* A piece of this area (spacings squared) or more gets a seed. */
static const double LARGE = 0.4;
/* Passes after Lloyd's in which seeds may still be set. */
enum { MOST_PASSES = 60 };

struct voronoi {
    const struct kr_plate *plate;
    const struct kr_plate_body *body;
    struct kr_polygon polygon;
    unsigned char *zone; /* (lattice cells) 0: stays a square; 1: Voronoi cell; 2: its seed moves */
    struct kr_seeds seeds;
    struct kr_clip clip;
    struct kr_ring cell, spare;
};

/** Distance of a place from a side of the polygon. */
static double distance(const struct kr_polygon *polygon, size_t side, double x, double y) {
    const double *p = polygon->point + 2 * side, *q = polygon->point + 2 * polygon->next[side];
    double u = q[0] - p[0], v = q[1] - p[1];
    double t = ((x - p[0]) * u + (y - p[1]) * v) / (u * u + v * v);
    t = fmin(fmax(t, 0), 1);
    return hypot(x - p[0] - t * u, y - p[1] - t * v);
}

/** Mark by 2 the cells whose centres lie within `reach` of an edge that does not fit the lattice. */
static void mark_moving(struct voronoi *v, double reach) {
    const struct kr_lattice *lattice = &v->body->lattice;
    for (size_t s = 0; s < v->polygon.n; s++) {
        const double *p = v->polygon.point + 2 * s, *q = v->polygon.point + 2 * v->polygon.next[s];
        if (v->polygon.on_line[s])
            continue;
        double left = fmax(floor(fmin(p[0], q[0]) - reach), 0), right = fmax(p[0], q[0]) + reach;
        double low = fmax(floor(fmin(p[1], q[1]) - reach), 0), high = fmax(p[1], q[1]) + reach;
        for (double j = low; j <= high && j < (double)lattice->rows; j++)
            for (double i = left; i <= right && i < (double)lattice->columns; i++) {
                unsigned char *zone = &v->zone[kr_lattice_cell(lattice, (size_t)i, (size_t)j)];
                if (*zone != 2 && distance(&v->polygon, s, i + 0.5, j + 0.5) <= reach)
                    *zone = 2;
            }
    }
}

/** Give `value` to the cells still 0 beside one that is not, corners included. */
static void widen(const struct kr_lattice *lattice, unsigned char *zone, unsigned char value) {
    size_t cells = lattice->columns * lattice->rows;
    unsigned char *before = KR_NEW(unsigned char, cells);
    memcpy(before, zone, cells);
    for (size_t c = 0; c < cells; c++) {
        if (!before[c])
            continue;
        size_t i = c % lattice->columns, j = c / lattice->columns;
        for (size_t l = j ? j - 1 : 0; l <= j + 1 && l < lattice->rows; l++)
            for (size_t k = i ? i - 1 : 0; k <= i + 1 && k < lattice->columns; k++) {
                size_t n = kr_lattice_cell(lattice, k, l);
                zone[n] = zone[n] ? zone[n] : value;
            }
    }
    kr_free(before);
}

static void set_seeds(struct voronoi *v) {
    const struct kr_lattice *lattice = &v->body->lattice;
    size_t cells = lattice->columns * lattice->rows;
    unsigned char *seen = KR_NEW(unsigned char, cells);
    memcpy(seen, v->zone, cells);
    for (int k = 0; k < 3; k++) /* squares whose seeds bound the outermost Voronoi cells */
        widen(lattice, seen, 3);
    v->seeds = kr_seeds_begin(lattice);
    for (size_t c = 0; c < cells; c++)
        if (seen[c] && !v->body->holder[c])
            kr_seeds_add(&v->seeds, (double)(c % lattice->columns) + 0.5,
                         (double)(c / lattice->columns) + 0.5,
                         seen[c] == 3   ? KR_SEED_BOUNDS
                         : seen[c] == 2 ? KR_SEED_MOVES
                                        : KR_SEED_STAYS,
                         c);
    kr_seeds_sort(&v->seeds);
    kr_free(seen);
}

static int ring_holds(const struct kr_ring *ring, const double at[2]) {
    int inside = 0;
    for (size_t k = 0; k < ring->n; k++) {
        const double *p = ring->point[k], *q = ring->point[k + 1 < ring->n ? k + 1 : 0];
        if ((p[1] > at[1]) != (q[1] > at[1]) &&
            p[0] + (q[0] - p[0]) * (at[1] - p[1]) / (q[1] - p[1]) > at[0])
            inside = !inside;
    }
    return inside;
}

/** Number of the part that is a seed's own: the one it stands in, else the largest. */
static size_t own_part(const struct kr_clip *clip, const double seed[2]) {
    double most = -1, centroid[2];
    size_t best = 0;
    for (size_t k = 0; k < clip->n_parts; k++) {
        const struct kr_ring *part = &clip->part[k];
        if (clip->n_parts == 1 || ring_holds(part, seed))
            return k;
        double area = kr_cell_polygon(part->n, part->point[0], centroid);
        if (area > most) {
            most = area;
            best = k;
        }
    }
    return best;
}

/** Clip the cell of a seed; its parts are then in v->clip. */
static void find_cell(struct voronoi *v, size_t seed) {
    kr_seeds_cell(&v->seeds, seed, &v->cell, &v->spare);
    kr_clip_cell(&v->clip, &v->cell);
}

/** Set seeds where a seed's cell leaves too much or reaches too far; returns how many. */
static size_t set_more(struct voronoi *v, size_t own, int pass) {
    size_t set = 0;
    for (size_t k = 0; k < v->clip.n_parts; k++) {
        const struct kr_ring *part = &v->clip.part[k];
        double centroid[2], area = kr_cell_polygon(part->n, part->point[0], centroid);
        for (size_t c = 0; c < part->n; c++) {
            const double *p = part->point[c], *q = part->point[c + 1 < part->n ? c + 1 : 0];
            if (part->side[c] != KR_SIDE_FAR || hypot(q[0] - p[0], q[1] - p[1]) < 1e-6)
                continue;
            kr_seeds_add(&v->seeds, (p[0] + q[0]) / 2, (p[1] + q[1]) / 2, KR_SEED_MOVES,
                         KR_NO_HOME);
            return set + 1;
        }
        if (k != own && area >= LARGE && pass < MOST_PASSES / 2 && ring_holds(part, centroid)) {
            kr_seeds_add(&v->seeds, centroid[0], centroid[1], KR_SEED_MOVES, KR_NO_HOME);
            set++;
        }
    }
    return set;
}

/** One pass over all cells: Lloyd's step where asked for. Returns how many seeds were set. */
static size_t step(struct voronoi *v, int moves, int pass) {
    size_t n = v->seeds.n, set = 0;
    if (!n)
        return 0; /* all edges lie on the lattice */
    double(*to)[2] = kr_alloc(n, sizeof *to);
    memcpy(to, v->seeds.place, n * sizeof *to);
    for (size_t s = 0; s < n; s++) {
        double centroid[2];
        if (v->seeds.kind[s] != KR_SEED_MOVES)
            continue;
        find_cell(v, s);
        size_t own = own_part(&v->clip, v->seeds.place[s]);
        const struct kr_ring *part = &v->clip.part[own];
        kr_cell_polygon(part->n, part->point[0], centroid);
        if (moves && ring_holds(part, centroid))
            memcpy(to[s], centroid, sizeof *to);
        set += set_more(v, own, pass);
    }
    memcpy(v->seeds.place, to, n * sizeof *to);
    kr_free(to);
    kr_seeds_sort(&v->seeds);
    return set;
}

static void relax(struct voronoi *v) {
    int64_t steps = v->plate->lloyd_steps;
    for (int pass = 0; pass < steps + MOST_PASSES; pass++)
        if (step(v, pass < steps, pass < steps ? 0 : pass - (int)steps) == 0 && pass >= steps)
            return;
    kr_stop(KR_EXIT_LIBRARY, "the Voronoi cells do not cover the plate after %d passes; try another "
                             "spacing or grid",
            MOST_PASSES);
}

/** Whether a tile is just the square of a lattice cell. */
static int is_square(const struct kr_lattice *lattice, const struct kr_tile *tile, size_t home) {
    size_t i = home % lattice->columns, j = home / lattice->columns, wide = lattice->columns + 1;
    size_t low = kr_lattice_point(lattice, i, j);
    if (home == KR_NO_HOME || tile->n != 4)
        return 0;
    for (size_t k = 0; k < 4; k++)
        if (tile->point[k] == low)
            return tile->point[(k + 1) % 4] == low + 1 &&
                   tile->point[(k + 2) % 4] == low + 1 + wide &&
                   tile->point[(k + 3) % 4] == low + wide;
    return 0;
}

/** Final cells, welded; zone cells that are squares after all become 0. */
static struct kr_weld make_tiles(struct voronoi *v) {
    struct kr_weld weld = kr_weld_begin(&v->polygon, &v->body->lattice);
    size_t *home = NULL, room = 0;
    for (size_t s = 0; s < v->seeds.n; s++) {
        if (v->seeds.kind[s] == KR_SEED_BOUNDS)
            continue;
        find_cell(v, s);
        size_t own = own_part(&v->clip, v->seeds.place[s]);
        for (size_t k = 0; k < v->clip.n_parts; k++) {
            double centroid[2];
            const struct kr_ring *part = &v->clip.part[k];
            int is_scrap =
                k != own && kr_cell_polygon(part->n, part->point[0], centroid) < LARGE;
            size_t before = weld.n_tiles;
            kr_weld_add(&weld, part, is_scrap);
            if (weld.n_tiles > before) {
                KR_GROW(home, before, room);
                home[before] = v->clip.n_parts == 1 ? v->seeds.home[s] : KR_NO_HOME;
            }
        }
    }
    kr_weld_close(&weld);
    for (size_t t = 0; t < weld.n_tiles; t++)
        if (is_square(&weld.lattice, &weld.tile[t], home[t])) {
            v->zone[home[t]] = 0;
            weld.tile[t].n = 0;
        }
    kr_free(home);
    return weld;
}

struct kr_mesh *kr_voronoi_mesh(const struct kr_plate *plate, const struct kr_plate_body *body,
                                struct kr_plate_report *report) {
    struct voronoi v = {.plate = plate, .body = body};
    const struct kr_lattice *lattice = &body->lattice;
    double reach = plate->padding / lattice->spacing;
    if (!(reach >= 1 - 1e-9))
        kr_stop(KR_EXIT_INPUT,
                "a padding of %.9g mm is below the spacing of %.9g mm: cells need room to even out; "
                "the horizon is a good padding",
                1e3 * plate->padding, 1e3 * plate->spacing);
    v.polygon = kr_polygon_of(&body->exact, lattice);
    v.zone = KR_NEW(unsigned char, lattice->columns * lattice->rows);
    mark_moving(&v, reach);
    for (int k = 0; k < 2; k++)
        widen(lattice, v.zone, 1);
    set_seeds(&v);
    v.clip = kr_clip_begin(&v.polygon, lattice);
    relax(&v);
    report->polygonal_area = v.polygon.area * lattice->spacing * lattice->spacing;
    struct kr_weld weld = make_tiles(&v);
    struct kr_mesh *mesh = kr_weld_mesh(&weld, body, v.zone, &report->n_lattice);
    kr_weld_end(&weld);
    kr_clip_end(&v.clip);
    kr_seeds_end(&v.seeds);
    kr_ring_free(&v.cell);
    kr_ring_free(&v.spare);
    kr_polygon_free(&v.polygon);
    kr_free(v.zone);
    return mesh;
}
