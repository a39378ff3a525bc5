/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Fronts and areas of cracks in solids; see sheet.h. A layer is a plate of its own to track.c.
 */
#include "sheet.h"

#include <math.h>

#include "base/memory.h"
#include "table.h"
#include "track.h"

enum { MOST_LINES = 200 };

/* Layers of equal depth across z. */
struct layers {
    double bottom, depth; /* m: least z of a node less half a layer; of a layer */
    size_t count;
    struct kr_record *plate; /* (count) the nodes of each, places in 2D */
};

static size_t layer_of(const struct layers *layers, double z) {
    double k = floor((z - layers->bottom) / layers->depth);
    return k < 0 ? 0 : k >= (double)layers->count ? layers->count - 1 : (size_t)k;
}

static struct layers measure(const struct kr_record *record) {
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < record->n; i++) {
        low = fmin(low, record->position[3 * i + 2]);
        high = fmax(high, record->position[3 * i + 2]);
    }
    double steps = nearbyint((high - low) / record->spacing);
    struct layers layers = {.count = 1 + (size_t)steps};
    layers.depth = steps > 0 ? (high - low) / steps : record->spacing;
    layers.bottom = low - 0.5 * layers.depth;
    layers.plate = KR_NEW(struct kr_record, layers.count);
    return layers;
}

static struct layers cut(const struct kr_record *record) {
    struct layers layers = measure(record);
    for (size_t i = 0; i < record->n; i++)
        layers.plate[layer_of(&layers, record->position[3 * i + 2])].n++;
    for (size_t k = 0; k < layers.count; k++) {
        struct kr_record *plate = &layers.plate[k];
        size_t n = plate->n;
        *plate = *record;
        plate->dim = 2;
        plate->n = 0;
        plate->position = KR_NEW(double, 2 * n);
        plate->damage_time = KR_NEW(double, n);
    }
    for (size_t i = 0; i < record->n; i++) {
        const double *x = record->position + 3 * i;
        struct kr_record *plate = &layers.plate[layer_of(&layers, x[2])];
        plate->position[2 * plate->n] = x[0];
        plate->position[2 * plate->n + 1] = x[1];
        plate->damage_time[plate->n++] = record->damage_time[i];
    }
    return layers;
}

static void free_layers(struct layers *layers) {
    for (size_t k = 0; k < layers->count; k++) {
        kr_free(layers->plate[k].position);
        kr_free(layers->plate[k].damage_time);
    }
    kr_free(layers->plate);
}

/* The last move of a tip up to a step; NULL before the first. */
static const struct kr_tip *tip_at(const struct kr_track *track, int64_t step) {
    const struct kr_tip *last = NULL;
    for (size_t k = 0; k < track->count && track->tip[k].step <= step; k++)
        last = &track->tip[k];
    return last;
}

static void put_front(struct kr_table *table, const struct layers *layers,
                      const struct kr_track *track, size_t box, int64_t step, int64_t window) {
    for (size_t k = 0; k < layers->count; k++) {
        const struct kr_record *plate = &layers->plate[k];
        const struct kr_tip *tip = tip_at(&track[k], step);
        if (!tip)
            continue;
        /* What does not move within the window stands still. */
        int moves = tip->step + window > step;
        fprintf(table->file, "%.9g,%zu,%zu", (double)step * plate->time_step, box + 1, k + 1);
        kr_table_put(table, plate->position[2 * tip->node]);
        kr_table_put(table, plate->position[2 * tip->node + 1]);
        kr_table_put(table, layers->bottom + ((double)k + 0.5) * layers->depth);
        kr_table_put(table, moves ? tip->speed : 0);
        kr_table_put(table, (moves ? tip->speed : 0) / plate->rayleigh_speed);
        fprintf(table->file, "\n");
    }
}

static void follow_box(struct kr_table *table, const struct layers *layers,
                       const struct kr_case_box *box, size_t number, int64_t window) {
    struct kr_track *track = KR_NEW(struct kr_track, layers->count);
    int64_t first = INT64_MAX, last = -1;
    for (size_t k = 0; k < layers->count; k++) {
        kr_track_follow(&layers->plate[k], box, window, &track[k]);
        if (!track[k].count)
            continue;
        first = track[k].tip[0].step < first ? track[k].tip[0].step : first;
        last = track[k].arrival > last ? track[k].arrival : last;
    }
    for (int64_t step = first; last >= 0 && step < last + window; step += window)
        put_front(table, layers, track, number, step < last ? step : last, window);
    for (size_t k = 0; k < layers->count; k++)
        kr_track_clear(&track[k]);
    kr_free(track);
}

void kr_sheet_front(const struct kr_record *record, const struct kr_case *c, const char *path) {
    const struct kr_case_box whole = {{-INFINITY, -INFINITY}, {INFINITY, INFINITY}, 0};
    const struct kr_case_box *box = c->boxes.count ? c->boxes.item : &whole;
    struct layers layers = cut(record);
    struct kr_table table = kr_table_begin(
        path, "time [s],box,layer,x [m],y [m],z [m],speed [m/s],speed_over_rayleigh");
    for (size_t k = 0; k < (c->boxes.count ? c->boxes.count : 1); k++)
        follow_box(&table, &layers, &box[k], k, c->window);
    kr_table_finish(&table);
    free_layers(&layers);
}

void kr_sheet_area(const struct kr_record *record, const char *path) {
    struct kr_table table = kr_table_begin(path, "time [s],broken_bonds,area [m^2]");
    double energy = 0, begin = record->first_break;
    double every = record->broken ? (record->bond_time[record->broken - 1] - begin) / MOST_LINES : 0;
    double due = begin;
    for (size_t k = 0; k < record->broken; k++) {
        energy += record->bond_energy[k];
        int ends = k + 1 == record->broken;
        if (!ends && (record->bond_time[k + 1] == record->bond_time[k] || record->bond_time[k] < due))
            continue;
        due = record->bond_time[k] + every;
        fprintf(table.file, "%.9g,%zu,%.9g\n", record->bond_time[k], k + 1,
                energy / record->fracture_energy);
    }
    kr_table_finish(&table);
}
