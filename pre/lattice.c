/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Fitting the lattice to the plate.
 */
#include "lattice.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>

/* A ratio of two lengths written in decimals is whole to a few roundings; 1e-9 is far above those
 * and far below any misfit that somebody means. */
static const double FITS = 1e-9;

static int is_multiple(double length, double spacing) {
    double ratio = length / spacing, whole = nearbyint(ratio);
    return whole >= 1 && fabs(ratio - whole) <= FITS * whole;
}

/** The spacing nearest to the wanted one, finer (step 1) or coarser (step -1), that fits both
 *  sides; 0 if there is none within a factor of two. */
static double nearest_fit(double width, double height, double spacing, int step) {
    double from = width / spacing, n = step > 0 ? ceil(from) : floor(from);
    for (; n >= 1 && n <= 2 * from + 1 && n >= from / 2 - 1; n += step)
        if (is_multiple(height, width / n))
            return width / n;
    return 0;
}

struct kr_lattice kr_lattice_fit(double width, double height, double spacing) {
    if (is_multiple(width, spacing) && is_multiple(height, spacing))
        return (struct kr_lattice){(size_t)nearbyint(width / spacing),
                                   (size_t)nearbyint(height / spacing), spacing};
    double finer = nearest_fit(width, height, spacing, 1);
    double coarser = nearest_fit(width, height, spacing, -1);
    char *cure =
        finer > 0 && coarser > 0
            ? kr_text("the nearest that fit are %.9g mm and %.9g mm", 1e3 * finer, 1e3 * coarser)
        : finer > 0 || coarser > 0
            ? kr_text("the nearest that fits is %.9g mm", 1e3 * (finer > 0 ? finer : coarser))
            : kr_text("no spacing near it fits both sides; change a side, for instance to %.9g mm "
                      "by %.9g mm",
                      1e3 * spacing * fmax(1, nearbyint(width / spacing)),
                      1e3 * spacing * fmax(1, nearbyint(height / spacing)));
    kr_stop(KR_EXIT_INPUT,
            "a plate of %.9g mm by %.9g mm cannot be cut into whole squares of %.9g mm: %s",
            1e3 * width, 1e3 * height, 1e3 * spacing, cure);
}
