/* SPDX-License-Identifier: BSD-3-Clause
 *
 * When, how fast and which way the front of a crack passed each of its nodes; the fit stands in
 * sheet.h.
 */
#include "sheet.h"

#include <math.h>

#include "base/memory.h"
#include "least.h"
#include "search.h"

static const double WINDOW = 2; /* horizons */
enum { TERMS = 6 };

/** Two directions in the plane of a patch. */
static void span(const struct kr_patch *patch, double e[2][3]) {
    const double *n = patch->normal;
    int least = fabs(n[0]) < fabs(n[1]) ? 0 : 1;
    double length = 0;
    least = fabs(n[2]) < fabs(n[least]) ? 2 : least;
    for (int a = 0; a < 3; a++) {
        e[0][a] = (a == least) - n[least] * n[a];
        length += e[0][a] * e[0][a];
    }
    for (int a = 0; a < 3; a++)
        e[0][a] /= sqrt(length);
    for (int a = 0; a < 3; a++)
        e[1][a] = n[(a + 1) % 3] * e[0][(a + 2) % 3] - n[(a + 2) % 3] * e[0][(a + 1) % 3];
}

/** Add a node to the fit; returns its share of the window's area over a horizon's square. */
static double add(const struct kr_sheet *sheet, const struct kr_patch *patch, double e[2][3],
                  double begin, size_t j, struct kr_least *fit) {
    const struct kr_front *front = sheet->front;
    const double horizon = front->record->horizon, window = WINDOW * horizon;
    double d[3], u = 0, v = 0, across = 0, part;
    for (int a = 0; a < 3; a++) {
        d[a] = front->x[3 * j + (size_t)a] - patch->x[a];
        u += d[a] * e[0][a] / window;
        v += d[a] * e[1][a] / window;
        across += d[a] * patch->normal[a];
    }
    part = 1 - u * u - v * v; /* the root of the weight */
    if (fabs(across) > horizon || part <= 0)
        return 0;
    kr_least_add(
        fit, (double[TERMS]){part, part * u, part * v, part * u * u, part * u * v, part * v * v},
        part * (kr_sheet_when(sheet, j) - begin));
    return part * part * sheet->patch[j].area / (horizon * horizon);
}

static void time_patch(const struct kr_sheet *sheet, size_t i, const int *near, size_t count,
                       struct kr_patch *patch) {
    const struct kr_front *front = sheet->front;
    const double window = WINDOW * front->record->horizon;
    struct kr_least fit = {.terms = TERMS};
    double e[2][3], x[KR_LEAST_MOST], inverse[KR_LEAST_MOST][KR_LEAST_MOST], left, slope, variance;
    span(patch, e);
    const double begin = kr_sheet_when(sheet, i);
    double independent = add(sheet, patch, e, begin, i, &fit);
    for (size_t k = 0; k < count; k++) {
        size_t j = (size_t)near[k];
        if (front->time[j] >= 0 && front->source_of[j] == front->source_of[i])
            independent += add(sheet, patch, e, begin, j, &fit);
    }
    if (!kr_least_solve(&fit, x, inverse, &left))
        return;
    patch->time = begin + x[0];
    slope = hypot(x[1], x[2]);
    if (!(slope > 0))
        return;
    for (int a = 0; a < 3; a++)
        patch->along[a] = (x[1] * e[0][a] + x[2] * e[1][a]) / slope;
    variance = (x[1] * x[1] * inverse[1][1] + 2 * x[1] * x[2] * inverse[1][2] +
                x[2] * x[2] * inverse[2][2]) /
               (slope * slope) * left / fmax(fmin(independent, fit.count) - TERMS, 1);
    patch->speed = window / slope;
    patch->error = window * sqrt(variance) / (slope * slope);
}

void kr_sheet_time(struct kr_sheet *sheet) {
    const struct kr_front *front = sheet->front;
    struct kr_search *search =
        kr_search_create(3, front->n, front->x, WINDOW * front->record->horizon);
    struct kr_found found = {0};
    for (size_t i = 0; i < front->n; i++) {
        struct kr_patch *patch = sheet->patch + i;
        patch->time = patch->speed = patch->error = NAN;
        if (front->time[i] < 0)
            continue;
        kr_search_find(search, i, &found);
        time_patch(sheet, i, found.near, found.count, patch);
    }
    kr_free(found.near);
    kr_search_free(search);
}
