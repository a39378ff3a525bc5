/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checks of the corners of a polygon in the plane.
 */
#include "case_check.h"

#include <math.h>

/* Above 0 where c lies to the left of the way from a to b. */
static double turn(const double *a, const double *b, const double *c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Whether the line from a to b crosses that from c to d, or an end of one lies in the other. */
static int is_crossed(const double *a, const double *b, const double *c, const double *d) {
    for (int k = 0; k < 2; k++)
        if (fmax(a[k], b[k]) < fmin(c[k], d[k]) || fmax(c[k], d[k]) < fmin(a[k], b[k]))
            return 0;
    return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
}

/* Sides of a polygon that are no neighbours must not meet. */
static int check_sides(struct kr_deck *deck, const struct kr_deck_list *points) {
    const double *at = points->item;
    size_t n = points->count / 2;
    for (size_t k = 1; k <= n; k++) {
        size_t here = k < n ? k : n - 1, other = k < n ? k - 1 : 0; /* at last the last and the first */
        if (at[2 * here] != at[2 * other] || at[2 * here + 1] != at[2 * other + 1])
            continue;
        kr_deck_fault(deck, at + 2 * here,
                      "found corner %zu again, expected another; the shape closes by itself",
                      other);
        return 0;
    }
    for (size_t k = 2; k < n; k++)
        for (size_t l = k == n - 1; l + 1 < k; l++)
            if (is_crossed(at + 2 * l, at + 2 * l + 2, at + 2 * k, at + 2 * ((k + 1) % n))) {
                kr_deck_fault(deck, at + 2 * k,
                              "the side from here to the next corner meets the one behind corner "
                              "%zu, expected corners in turn around the shape, the first is 0",
                              l);
                return 0;
            }
    return 1;
}

int kr_case_check_corners(struct kr_deck *deck, const struct kr_deck_list *points) {
    if (!points->given)
        return 1;
    if (points->count >= 6)
        return check_sides(deck, points);
    kr_deck_fault(deck, points, "found %zu corners, expected three or more", points->count / 2);
    return 0;
}
