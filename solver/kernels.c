/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Which build of the loop this processor can run.
 */
#include "kernel.h"

#include "base/error.h"

#include <stdlib.h>
#include <string.h>

extern const struct kr_kernel kr_kernel_baseline, kr_kernel_baseline_mixed;
#ifdef __x86_64__
extern const struct kr_kernel kr_kernel_avx2, kr_kernel_avx512;
extern const struct kr_kernel kr_kernel_avx2_mixed, kr_kernel_avx512_mixed;

static int has_avx2(void) {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}

static int has_avx512(void) {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
}
#endif

static int has_anything(void) {
    return 1;
}

/* Best first. */
static const struct {
    const struct kr_kernel *kernel, *mixed;
    int (*runs)(void);
} builds[] = {
#ifdef __x86_64__
    {&kr_kernel_avx512, &kr_kernel_avx512_mixed, has_avx512},
    {&kr_kernel_avx2, &kr_kernel_avx2_mixed, has_avx2},
#endif
    {&kr_kernel_baseline, &kr_kernel_baseline_mixed, has_anything},
};

/* Place in `builds`. */
static size_t best(void) {
    const char *wanted = getenv("KIRSCH_KERNEL");
    for (size_t k = 0; k < sizeof builds / sizeof builds[0]; k++)
        if (builds[k].runs() && (!wanted || !strcmp(wanted, builds[k].kernel->name)))
            return k;
    kr_stop(KR_EXIT_INPUT,
            "KIRSCH_KERNEL is '%s', which this processor cannot run; expected baseline, avx2 or "
            "avx512, or leave it unset",
            wanted);
}

const struct kr_kernel *kr_kernel_best(void) {
    return builds[best()].kernel;
}

const struct kr_kernel *kr_kernel_mixed(void) {
    return builds[best()].mixed;
}
