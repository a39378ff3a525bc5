/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Functions on the lattice. Boxes of points that no surface can reach are filled at once: the rest is
 * halved, so that a surface costs as many evaluations as there are points near it.
 */
#include "block_body.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Points nearer than this to the surface are evaluated: a cell's diagonal and the reach of the second
 * differences, 2 sqrt(3), both within. */
static const double BAND = 4;

/* What counts as on the surface: far above rounding, far below what anybody means. */
static const double ON = 1e-9;

static size_t index_of(const struct kr_field *field, long i, long j, long k) {
    size_t nx = (size_t)(field->high[0] - field->low[0] + 1);
    size_t ny = (size_t)(field->high[1] - field->low[1] + 1);
    return ((size_t)(k - field->low[2]) * ny + (size_t)(j - field->low[1])) * nx +
           (size_t)(i - field->low[0]);
}

double kr_field_at(const struct kr_field *field, long i, long j, long k) {
    if (i < field->low[0] || j < field->low[1] || k < field->low[2] || i > field->high[0] ||
        j > field->high[1] || k > field->high[2])
        return 1e9;
    return field->value[index_of(field, i, j, k)];
}

static void fill_box(const struct kr_field *field, const long low[3], const long high[3],
                     double value) {
    for (long k = low[2]; k <= high[2]; k++)
        for (long j = low[1]; j <= high[1]; j++)
            for (long i = low[0]; i <= high[0]; i++)
                field->value[index_of(field, i, j, k)] = value;
}

static void fill(const struct kr_field *field, const struct kr_cutter *cutter, const long low[3],
                 const long high[3]) {
    double centre[3], reach = 0, least;
    int longest = 0;
    for (int d = 0; d < 3; d++) {
        centre[d] = field->first + 0.5 * (double)(low[d] + high[d]);
        reach = hypot(reach, 0.5 * (double)(high[d] - low[d]));
        longest = high[d] - low[d] > high[longest] - low[longest] ? d : longest;
    }
    double value = kr_cutter_at(cutter, centre, &least);
    if (reach == 0 || least > reach + BAND) {
        fill_box(field, low, high, value);
        return;
    }
    long upper[3] = {high[0], high[1], high[2]}, lower[3] = {low[0], low[1], low[2]};
    upper[longest] = (low[longest] + high[longest]) / 2;
    if (low[longest] + high[longest] < 0 && (low[longest] + high[longest]) % 2)
        upper[longest]--; /* downwards also below 0 */
    lower[longest] = upper[longest] + 1;
    fill(field, cutter, low, upper);
    fill(field, cutter, lower, high);
}

static double second_differences(const struct kr_field *f, long i, long j, long k) {
    static const int step[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    double sum = 0, here = kr_field_at(f, i, j, k);
    for (int s = 0; s < 4; s++)
        sum += kr_field_at(f, i + step[s][0], j + step[s][1], k + step[s][2]) - 2 * here +
               kr_field_at(f, i - step[s][0], j - step[s][1], k - step[s][2]);
    return sum;
}

/** The sharpened field, one point narrower on each side. */
static struct kr_field sharpened(struct kr_field *from) {
    struct kr_field to = *from;
    size_t count = 1;
    for (int d = 0; d < 3; d++) {
        to.low[d]++;
        to.high[d]--;
        count *= (size_t)(to.high[d] - to.low[d] + 1);
    }
    to.value = KR_NEW(double, count);
#pragma omp parallel for schedule(static)
    for (long k = to.low[2]; k <= to.high[2]; k++)
        for (long j = to.low[1]; j <= to.high[1]; j++)
            for (long i = to.low[0]; i <= to.high[0]; i++) {
                double here = kr_field_at(from, i, j, k);
                /* Beyond 2 no edge of a cut tetrahedron, sqrt(3) long, reaches the surface. */
                if (fabs(here) < 2)
                    here -= second_differences(from, i, j, k) / 24;
                to.value[index_of(&to, i, j, k)] = fabs(here) < ON ? 0 : here;
            }
    kr_free(from->value);
    return to;
}

struct kr_field kr_field_of(const struct kr_block_body *body, const struct kr_cutter *cutter,
                            double first, int sharpen) {
    struct kr_field field = {.first = first};
    double box[6];
    size_t count = 1;
    kr_cutter_box(cutter, box);
    for (int d = 0; d < 3; d++) {
        field.low[d] = (long)fmax(floor(box[d]) - 4, -1);
        field.high[d] = (long)fmin(ceil(box[3 + d]) + 4, (double)body->n[d] + 1);
        if (field.high[d] < field.low[d] + 2)
            field.high[d] = field.low[d] + 2; /* a void beyond the frame */
        count *= (size_t)(field.high[d] - field.low[d] + 1);
    }
    field.value = KR_NEW(double, count);
    long slab = 4, slabs = (field.high[2] - field.low[2]) / slab + 1;
#pragma omp parallel for schedule(dynamic)
    for (long s = 0; s < slabs; s++) {
        long low[3] = {field.low[0], field.low[1], field.low[2] + s * slab}, high[3];
        memcpy(high, field.high, sizeof high);
        if (s + 1 < slabs)
            high[2] = low[2] + slab - 1;
        fill(&field, cutter, low, high);
    }
    return sharpen ? sharpened(&field) : field;
}
