/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The front of a crack in a solid as curves, and the files about it; see sheet.h.
 */
#include <math.h>

#include "base/memory.h"
#include "csv_write.h"
#include "sheet.h"

enum { MOST_LINES = 200, MOST_FRONTS = 60 };

/* Points nearer than this many spacings are one point of a curve; those farther than that are of
 * two. */
static const double NEAR = 0.9, FAR = 3;

static double apart(const double *a, const double *b) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

/** Whether the front was less than 0.6 spacings from a patch at a time, and where. */
static int is_at(const struct kr_sheet *sheet, const struct kr_patch *patch, double time,
                 double x[3]) {
    double moved = (time - patch->time) * patch->speed;
    if (!(fabs(moved) <= 0.6 * sheet->front->record->spacing))
        return 0;
    for (int a = 0; a < 3; a++)
        x[a] = patch->x[a] + moved * patch->along[a];
    return 1;
}

/** All that patches say about a time; of those near to each other the mean. */
static struct kr_sheet_point *gather(const struct kr_sheet *sheet, double time, size_t *count) {
    const double near = NEAR * sheet->front->record->spacing;
    struct kr_sheet_point *point = NULL;
    double *merged = NULL;
    size_t room = 0, counts_room = 0, n = 0;
    for (size_t i = 0; i < sheet->front->n; i++) {
        double x[3];
        size_t k = 0;
        if (!is_at(sheet, sheet->patch + i, time, x))
            continue;
        while (k < n && apart(point[k].x, x) > near)
            k++;
        if (k == n) {
            KR_GROW(point, n, room);
            KR_GROW(merged, n, counts_room);
            point[n] = (struct kr_sheet_point){0, i, {x[0], x[1], x[2]}};
            merged[n++] = 1;
            continue;
        }
        merged[k]++;
        for (int a = 0; a < 3; a++)
            point[k].x[a] += (x[a] - point[k].x[a]) / merged[k];
    }
    kr_free(merged);
    *count = n;
    return point;
}

/** How far a point is from the mean of its neighbours among the rest: most at the end of a curve.
 */
static double lean(const struct kr_sheet_point *point, size_t from, size_t count, size_t k,
                   double far) {
    double mean[3] = {0}, near = 0;
    for (size_t j = from; j < count; j++)
        if (apart(point[j].x, point[k].x) <= far) {
            near++;
            for (int a = 0; a < 3; a++)
                mean[a] += point[j].x[a];
        }
    for (int a = 0; a < 3; a++)
        mean[a] /= near;
    return apart(mean, point[k].x);
}

static void swap(struct kr_sheet_point *a, struct kr_sheet_point *b) {
    struct kr_sheet_point keep = *a;
    *a = *b;
    *b = keep;
}

/** Go from an end to the nearest that is left, and so on; where none is near, another curve begins.
 */
static void put_in_order(struct kr_sheet_point *point, size_t count, double far) {
    size_t curve = 0;
    for (size_t k = 0; k < count; k++) {
        size_t next = k;
        double least = INFINITY, most = -1;
        for (size_t j = k; k && j < count; j++) {
            double away = apart(point[j].x, point[k - 1].x);
            if (away <= far && away < least) {
                least = away;
                next = j;
            }
        }
        for (size_t j = k; isinf(least) && j < count; j++) {
            double off = lean(point, k, count, j, far);
            if (off > most) {
                most = off;
                next = j;
            }
        }
        curve += isinf(least);
        point[next].curve = curve;
        swap(point + k, point + next);
    }
}

struct kr_sheet_point *kr_sheet_front(const struct kr_sheet *sheet, double time, size_t *count) {
    struct kr_sheet_point *point = gather(sheet, time, count);
    put_in_order(point, *count, FAR * sheet->front->record->spacing);
    return point;
}

/* ---- files ------------------------------------------------------------------------------- */

static void put_front(struct kr_csv_writer *table, const struct kr_sheet *sheet, double time) {
    const double rayleigh = sheet->front->record->rayleigh_speed;
    size_t count;
    struct kr_sheet_point *point = kr_sheet_front(sheet, time, &count);
    for (size_t k = 0; k < count; k++) {
        const struct kr_patch *patch = sheet->patch + point[k].patch;
        fprintf(table->file, "%.9g,%zu", time, point[k].curve);
        for (int a = 0; a < 3; a++)
            kr_csv_put(table, point[k].x[a]);
        kr_csv_put(table, patch->speed);
        kr_csv_put(table, patch->error);
        kr_csv_put(table, patch->speed / rayleigh);
        for (int a = 0; a < 3; a++)
            kr_csv_put(table, patch->along[a]);
        fprintf(table->file, "\n");
    }
    kr_free(point);
}

void kr_sheet_write_front(const struct kr_sheet *sheet, const char *path) {
    const struct kr_front *front = sheet->front;
    struct kr_csv_writer table = kr_csv_begin(
        path, "time [s],curve,x [m],y [m],z [m],speed [m/s],speed_error [m/s],speed_over_rayleigh,"
              "along_x,along_y,along_z");
    const double step = front->record->time_step;
    double first = INFINITY, last = 0, every;
    for (size_t i = 0; i < front->n; i++)
        if (!isnan(sheet->patch[i].time)) {
            first = fmin(first, kr_sheet_when(sheet, i));
            last = fmax(last, kr_sheet_when(sheet, i));
        }
    every = step * fmax(1, ceil((last - first) / step / MOST_FRONTS));
    for (int k = 0; first + k * every <= last; k++)
        put_front(&table, sheet, first + k * every);
    kr_csv_finish(&table);
}

double kr_sheet_area(const struct kr_sheet *sheet, double time) {
    double area = 0;
    for (size_t i = 0; i < sheet->front->n; i++)
        if (kr_sheet_when(sheet, i) <= time)
            area += sheet->patch[i].area;
    return area;
}

double kr_sheet_mean_speed(const struct kr_sheet *sheet) {
    double area = 0, slowness = 0;
    for (size_t i = 0; i < sheet->front->n; i++) {
        const struct kr_patch *patch = sheet->patch + i;
        if (isnan(patch->speed))
            continue;
        area += patch->area;
        slowness += patch->area / patch->speed;
    }
    return area > 0 ? area / slowness : NAN;
}

void kr_sheet_write_area(const struct kr_sheet *sheet, const char *path) {
    const struct kr_record *record = sheet->front->record;
    struct kr_csv_writer table =
        kr_csv_begin(path, "time [s],broken_bonds,area [m^2],energy_area [m^2]");
    double energy = 0, begin = record->first_break;
    double every =
        record->broken ? (record->bond_time[record->broken - 1] - begin) / MOST_LINES : 0;
    double due = begin;
    for (size_t k = 0; k < record->broken; k++) {
        energy += record->bond_energy[k];
        int ends = k + 1 == record->broken;
        if (!ends &&
            (record->bond_time[k + 1] == record->bond_time[k] || record->bond_time[k] < due))
            continue;
        due = record->bond_time[k] + every;
        fprintf(table.file, "%.9g,%zu,%.9g,%.9g\n", record->bond_time[k], k + 1,
                kr_sheet_area(sheet, record->bond_time[k]), energy / record->fracture_energy);
    }
    kr_csv_finish(&table);
}
