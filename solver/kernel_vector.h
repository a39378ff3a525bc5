/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Vectors of the loop over bonds (kernel.c), by the compiler's vector types: as many numbers as the
 * target's registers hold. Knows nothing of bonds.
 */
#ifndef KR_KERNEL_VECTOR_H
#define KR_KERNEL_VECTOR_H

#include <stddef.h>
#include <stdint.h>

#if defined(__AVX512F__)
enum { VECTOR_BYTES = 64 };
#elif defined(__AVX__)
enum { VECTOR_BYTES = 32 };
#else
enum { VECTOR_BYTES = 16 };
#endif

#ifdef KR_FLOAT
typedef float number;
typedef int32_t integer;
#else
typedef double number;
typedef int64_t integer;
#endif

enum { WIDTH = VECTOR_BYTES / (int)sizeof(number) };

typedef number vector __attribute__((vector_size(VECTOR_BYTES)));
typedef integer mask __attribute__((vector_size(VECTOR_BYTES)));
typedef number vector_anywhere
    __attribute__((vector_size(VECTOR_BYTES), aligned(sizeof(number)), may_alias));

#define INLINE static inline __attribute__((always_inline))

/* Where a vector's numbers stand in an array: from `at` on and, in vectors wider than a slice, the
 * upper half from `upper` on. */
struct place {
    size_t at, upper;
};

INLINE vector same(double value) {
    return (number)value - (vector){0};
}

/* ---- halves: what a vector of floats is made of when it comes from doubles, or from two places ---- */

#ifdef KR_FLOAT
enum { HALF = WIDTH / 2 };
typedef float half __attribute__((vector_size(VECTOR_BYTES / 2)));
typedef float half_anywhere
    __attribute__((vector_size(VECTOR_BYTES / 2), aligned(4), may_alias));
typedef double doubles __attribute__((vector_size(VECTOR_BYTES)));
typedef double doubles_anywhere
    __attribute__((vector_size(VECTOR_BYTES), aligned(8), may_alias));

INLINE vector join(half low, half high) {
#if defined(__AVX512F__)
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#elif defined(__AVX__)
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
    return __builtin_shufflevector(low, high, 0, 1, 2, 3);
#endif
}

INLINE half low_half(vector v) {
#if defined(__AVX512F__)
    return __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7);
#elif defined(__AVX__)
    return __builtin_shufflevector(v, v, 0, 1, 2, 3);
#else
    return __builtin_shufflevector(v, v, 0, 1);
#endif
}

INLINE half high_half(vector v) {
#if defined(__AVX512F__)
    return __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
#elif defined(__AVX__)
    return __builtin_shufflevector(v, v, 4, 5, 6, 7);
#else
    return __builtin_shufflevector(v, v, 2, 3);
#endif
}

INLINE half load_half(const float *from) {
    return *(const half_anywhere *)from;
}

INLINE half round_half(doubles value) {
    return __builtin_convertvector(value, half);
}

INLINE doubles load_doubles(const double *from) {
    return *(const doubles_anywhere *)from;
}
#endif

/* Where the upper half of a vector stands. `apart`: it may not follow the lower one; a constant. */
INLINE size_t upper_of(struct place p, int apart) {
    return apart ? p.upper : p.at + (size_t)WIDTH / 2;
}

/* ---- loading and storing ---- */

INLINE vector load_floats(const float *array, struct place p, int apart) {
#ifdef KR_FLOAT
    if (apart)
        return join(load_half(array + p.at), load_half(array + p.upper));
    return *(const vector_anywhere *)(array + p.at);
#else
    typedef float floats __attribute__((vector_size(WIDTH * 4), aligned(4), may_alias));
    (void)apart;
    return __builtin_convertvector(*(const floats *)(array + p.at), vector);
#endif
}

#ifndef KR_FLOAT
INLINE vector load(const double *array, struct place p) {
    return *(const vector_anywhere *)(array + p.at);
}
#endif

/* Differences of doubles, rounded where the loop is of floats. */
INLINE vector load_difference(const double *array, struct place to, struct place from, int apart) {
#ifdef KR_FLOAT
    return join(round_half(load_doubles(array + to.at) - load_doubles(array + from.at)),
                round_half(load_doubles(array + upper_of(to, apart)) -
                           load_doubles(array + upper_of(from, apart))));
#else
    (void)apart;
    return load(array, to) - load(array, from);
#endif
}

#ifdef KR_FLOAT
/* Differences of whole numbers modulo 2^32. */
INLINE vector load_steps(const int32_t *array, struct place to, struct place from, int apart) {
    typedef uint32_t modular __attribute__((vector_size(VECTOR_BYTES)));
    const float *bits = (const float *)array;
    modular steps = (modular)load_floats(bits, to, apart) - (modular)load_floats(bits, from, apart);
    return __builtin_convertvector((mask)steps, vector);
}
#endif

/* factor * value into consecutive doubles. */
INLINE void store(double *to, vector value, double factor) {
#ifdef KR_FLOAT
    *(doubles_anywhere *)to = __builtin_convertvector(low_half(value), doubles) * factor;
    *(doubles_anywhere *)(to + HALF) = __builtin_convertvector(high_half(value), doubles) * factor;
#else
    *(vector_anywhere *)to = value * factor;
#endif
}

/* factor * (lower + upper half) into consecutive doubles; of floats only. */
INLINE void store_folded(double *to, vector value, double factor) {
#ifdef KR_FLOAT
    half sum = low_half(value) + high_half(value);
    *(doubles_anywhere *)to = __builtin_convertvector(sum, doubles) * factor;
#else
    (void)to, (void)value, (void)factor;
#endif
}

/* ---- masks ---- */

/* All bits set in the lanes of a vector whose bit in `bits` is set. */
INLINE mask mask_of(unsigned bits) {
    mask lane;
    for (int k = 0; k < WIDTH; k++)
        lane[k] = (integer)1 << k;
    return (((mask){0} + (integer)bits) & lane) != 0;
}

INLINE vector only(vector value, mask keep) {
    return (vector)((mask)value & keep);
}

INLINE integer any_bit(mask m) {
    integer all = 0;
    for (int k = 0; k < WIDTH; k++)
        all |= m[k];
    return all;
}

#endif
