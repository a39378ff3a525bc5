/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Presets: many choices in one word. A key that the deck gives itself wins over the preset.
 */
#include "case_check.h"

/* Section 2 and 3 of the plates paper: the grid fitted near boundaries, eq. 13 with the size of the far
 * node alone, and the energy method under uniaxial strain. */
static void plates_paper(const struct kr_deck *deck, struct kr_case *c) {
    const struct {
        int *field, value;
    } choices[] = {
        {&c->grid, KR_GRID_NEAR_BOUNDARY},
        {&c->partial_volume, KR_PARTIAL_VOLUME_HHB_ONE_SIDED},
        {&c->surface_correction, KR_SURFACE_ENERGY},
        {&c->surface_deformation, KR_UNIAXIAL_Y},
    };
    for (size_t k = 0; k < sizeof choices / sizeof choices[0]; k++)
        if (!kr_deck_given(deck, choices[k].field))
            *choices[k].field = choices[k].value;
}

void kr_case_preset(const struct kr_deck *deck, struct kr_case *c) {
    if (c->preset == KR_PRESET_PLATES_PAPER)
        plates_paper(deck, c);
}
