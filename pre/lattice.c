/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Fitting the lattice to the plate.
 */
#include "lattice.h"

#include "base/error.h"
#include "case.h"

#include <math.h>

struct kr_lattice kr_lattice_fit(double width, double height, double spacing) {
    char *cure = kr_case_misfit(width, height, spacing);
    if (cure)
        kr_stop(KR_EXIT_INPUT,
                "a plate of %.9g mm by %.9g mm cannot be cut into whole squares of %.9g mm: %s",
                1e3 * width, 1e3 * height, 1e3 * spacing, cure);
    return (struct kr_lattice){(size_t)nearbyint(width / spacing),
                               (size_t)nearbyint(height / spacing), spacing};
}
