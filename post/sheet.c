/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Planes, widths and areas of sheets; the equations stand in sheet.h.
 */
#include "sheet.h"

#include <math.h>

#include "base/memory.h"
#include "search.h"

static const double AROUND = 1.5;  /* horizons that a plane is laid through */
static const double CUT_OFF = 0.1; /* horizons */

struct kr_sheet *kr_sheet_create(const struct kr_record *record) {
    struct kr_sheet *sheet = KR_NEW(struct kr_sheet, 1);
    sheet->front = kr_front_create(record);
    sheet->patch = KR_NEW(struct kr_patch, sheet->front->n);
    kr_sheet_lay(sheet);
    kr_sheet_time(sheet);
    return sheet;
}

void kr_sheet_free(struct kr_sheet *sheet) {
    if (!sheet)
        return;
    kr_front_free(sheet->front);
    kr_free(sheet->patch);
    kr_free(sheet);
}

double kr_sheet_when(const struct kr_sheet *sheet, size_t i) {
    return isinf(sheet->front->arrival[i]) ? sheet->front->time[i] : sheet->front->arrival[i];
}

/* ---- planes ------------------------------------------------------------------------------ */

/** One of Jacobi's rotations: makes m[p][q] zero and turns the columns of v alike. */
static void rotate(double m[3][3], double v[3][3], int p, int q) {
    double theta, t, c, s;
    if (fabs(m[p][q]) <= 1e-15 * (fabs(m[p][p]) + fabs(m[q][q])))
        return;
    theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
    c = 1 / sqrt(t * t + 1);
    s = t * c;
    for (int k = 0; k < 3; k++) {
        double a = m[k][p], b = m[k][q];
        m[k][p] = c * a - s * b;
        m[k][q] = s * a + c * b;
    }
    for (int k = 0; k < 3; k++) {
        double a = m[p][k], b = m[q][k];
        m[p][k] = c * a - s * b;
        m[q][k] = s * a + c * b;
        a = v[k][p];
        b = v[k][q];
        v[k][p] = c * a - s * b;
        v[k][q] = s * a + c * b;
    }
}

/** The direction of least scatter. */
static void least_direction(double moment[3][3], double normal[3]) {
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    int least = 0;
    for (int round = 0; round < 12; round++) { /* converges quadratically: a few would do */
        rotate(moment, v, 0, 1);
        rotate(moment, v, 0, 2);
        rotate(moment, v, 1, 2);
    }
    for (int k = 1; k < 3; k++)
        least = moment[k][k] < moment[least][least] ? k : least;
    for (int k = 0; k < 3; k++)
        normal[k] = v[k][least];
}

static void lay_plane(const struct kr_front *front, size_t i, const int *near, size_t count,
                      struct kr_patch *patch) {
    const double *x = front->x + 3 * i, reach = AROUND * front->record->horizon;
    double weight = 1, mean[3] = {0}, moment[3][3] = {{0}}, away = 0;
    for (size_t k = 0; k < count; k++) {
        const double *y = front->x + 3 * (size_t)near[k];
        double d[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
        double part = 1 - (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / (reach * reach);
        double w = fmax(part, 0) * fmax(part, 0);
        weight += w;
        for (int a = 0; a < 3; a++) {
            mean[a] += w * d[a];
            for (int b = 0; b < 3; b++)
                moment[a][b] += w * d[a] * d[b];
        }
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            moment[a][b] -= mean[a] * mean[b] / weight;
    least_direction(moment, patch->normal);
    for (int a = 0; a < 3; a++)
        away += patch->normal[a] * mean[a] / weight;
    for (int a = 0; a < 3; a++)
        patch->x[a] = x[a] + away * patch->normal[a];
}

/* ---- widths ------------------------------------------------------------------------------ */

/** Sums over the disc around a patch. */
enum whose { DAMAGED, BODY, WHOSE };
struct disc {
    double volume[WHOSE], mean[WHOSE][3];
};

static void add_to_disc(struct disc *disc, enum whose whose, const struct kr_patch *patch,
                        const double *x, double volume, double horizon) {
    double d[3] = {x[0] - patch->x[0], x[1] - patch->x[1], x[2] - patch->x[2]}, across, r, w;
    across = d[0] * patch->normal[0] + d[1] * patch->normal[1] + d[2] * patch->normal[2];
    r = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - across * across) / (horizon * horizon);
    if (r >= 1 || fabs(across) >= horizon)
        return;
    w = (1 - r) * (1 - r) * volume * (whose == BODY ? 1 - fabs(across) / horizon : 1);
    disc->volume[whose] += w;
    for (int a = 0; a < 3; a++)
        disc->mean[whose][a] += w * (d[a] - across * patch->normal[a]);
}

/** The width at a patch; returns whether its disc is cut off by the front. */
static int measure_width(const struct kr_record *record, const struct disc *disc,
                         struct kr_patch *patch) {
    double square = 0;
    patch->width = record->horizon * disc->volume[DAMAGED] / disc->volume[BODY];
    for (int a = 0; a < 3; a++) {
        double off = disc->mean[DAMAGED][a] / disc->volume[DAMAGED] -
                     disc->mean[BODY][a] / disc->volume[BODY];
        square += off * off;
    }
    return square > CUT_OFF * CUT_OFF * record->horizon * record->horizon;
}

/** The patch at its own node and what is near it in the body. */
static struct disc look_around(const struct kr_record *record, const struct kr_patch *patch,
                               size_t i, const int *near, size_t count) {
    struct disc disc = {{0}};
    for (size_t k = 0; k <= count; k++) {
        size_t j = k < count ? (size_t)near[k] : i;
        if (!isinf(record->damage_time[j]))
            add_to_disc(&disc, DAMAGED, patch, record->position + 3 * j, record->volume[j],
                        record->horizon);
        add_to_disc(&disc, BODY, patch, record->position + 3 * j, record->volume[j],
                    record->horizon);
    }
    return disc;
}

/** Where the front cuts a disc off, the mean width of patches within reach that are whole. */
static void borrow_widths(struct kr_sheet *sheet, const struct kr_search *damaged,
                          const char *is_cut) {
    const struct kr_front *front = sheet->front;
    struct kr_found found = {0};
    double all = 0, whole = 0;
    for (size_t i = 0; i < front->n; i++)
        if (!is_cut[i]) {
            all += sheet->patch[i].width;
            whole++;
        }
    for (size_t i = 0; i < front->n; i++) {
        double sum = 0, count = 0;
        if (!is_cut[i])
            continue;
        kr_search_find(damaged, i, &found);
        for (size_t k = 0; k < found.count; k++)
            if (!is_cut[found.near[k]]) {
                sum += sheet->patch[found.near[k]].width;
                count++;
            }
        if (count > 0)
            sheet->patch[i].width = sum / count;
        else if (whole > 0)
            sheet->patch[i].width = all / whole;
    }
    kr_free(found.near);
}

void kr_sheet_lay(struct kr_sheet *sheet) {
    const struct kr_front *front = sheet->front;
    const struct kr_record *record = front->record;
    struct kr_search *damaged = kr_search_create(3, front->n, front->x, AROUND * record->horizon);
    struct kr_search *body = kr_search_create(3, record->n, record->position,
                                              sqrt(2) * record->horizon + record->spacing);
    struct kr_found found = {0};
    char *is_cut = KR_NEW(char, front->n);
    for (size_t i = 0; i < front->n; i++) {
        struct kr_patch *patch = sheet->patch + i;
        struct disc disc;
        kr_search_find(damaged, i, &found);
        lay_plane(front, i, found.near, found.count, patch);
        kr_search_find(body, front->node[i], &found);
        disc = look_around(record, patch, front->node[i], found.near, found.count);
        is_cut[i] = (char)measure_width(record, &disc, patch);
    }
    borrow_widths(sheet, damaged, is_cut);
    for (size_t i = 0; i < front->n; i++)
        if (front->time[i] >= 0)
            sheet->patch[i].area =
                record->volume[front->node[i]] /
                fmax(sheet->patch[i].width, cbrt(record->volume[front->node[i]]));
    kr_free(is_cut);
    kr_free(found.near);
    kr_search_free(damaged);
    kr_search_free(body);
}
