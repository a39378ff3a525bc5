/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Prototype microelastic brittle material. See pmb.c.
 */
#ifndef KR_PMB_H
#define KR_PMB_H

#include "material/material.h"

extern const struct kr_law kr_law_pmb;

#endif
