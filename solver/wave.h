/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Speeds of elastic waves in a plate or a solid. A crack can hardly outrun the Rayleigh wave, so its speed is
 * told as a share of that.
 */
#ifndef KR_WAVE_H
#define KR_WAVE_H

#include "case.h"

struct kr_wave {
    double longitudinal, shear, rayleigh; /* m/s */
};

/** Wave speeds of an isotropic body in plane stress, plane strain or three dimensions.
 *
 *    c_l^2 = E / (rho (1 - nu^2))                        plane stress
 *    c_l^2 = E (1 - nu) / (rho (1 + nu) (1 - 2 nu))      plane strain, solid
 *    c_s^2 = E / (2 rho (1 + nu))                        all
 *    (2 - x)^2 = 4 sqrt(1 - x) sqrt(1 - x c_s^2 / c_l^2),  x = (c_R / c_s)^2 in (0, 1)
 *
 *  The last is Rayleigh's equation for the surface wave (Proc. London Math. Soc. 17, 1885;
 *  J. D. Achenbach, Wave Propagation in Elastic Solids, 1973, section 5.11). In plane stress the
 *  same equation holds with the c_l of that state: in-plane motion obeys the same two wave
 *  equations and the same free edge.
 *
 *  in  youngs_modulus [Pa], density [kg/m^3], both > 0;  poissons_ratio in (-1, 1) in plane stress,
 *      (-1, 0.5) otherwise: the caller has checked them
 */
struct kr_wave kr_wave_speeds(double youngs_modulus, double poissons_ratio, double density,
                              enum kr_model model);

#endif
