/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The generator behind random pores: splitmix64 (G. L. Steele, D. Lea, C. H. Flood, Fast splittable
 * pseudorandom number generators, OOPSLA 2014), a counter and a mix, whole in its 64 bits of state.
 * It is part of the format of decks: a seed means the same pores in years to come.
 */
#ifndef KR_RANDOM_H
#define KR_RANDOM_H

#include <stdint.h>

static inline uint64_t kr_random(uint64_t *state) {
    uint64_t z = *state += UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return z ^ (z >> 31);
}

/** A whole number from least to most, both included. */
static inline int64_t kr_random_between(uint64_t *state, int64_t least, int64_t most) {
    uint64_t span = (uint64_t)(most - least) + 1, highest = UINT64_MAX - UINT64_MAX % span, drawn;
    do /* the last, incomplete span would favour small numbers */
        drawn = kr_random(state);
    while (drawn >= highest);
    return least + (int64_t)(drawn % span);
}

/** A number from 0 up to, not with, 1. */
static inline double kr_random_share(uint64_t *state) {
    return (double)(kr_random(state) >> 11) / 9007199254740992.0; /* 2^53 */
}

#endif
