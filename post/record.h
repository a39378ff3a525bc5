/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What a run left behind, as far as crack tracking needs it (run.h5, layout in docs/formats.md).
 */
#ifndef KR_RECORD_H
#define KR_RECORD_H

#include <stddef.h>
#include <stdint.h>

struct kr_record {
    size_t n;
    double *position;        /* (n x 2) m */
    double *damage_time;     /* (n) s: when Damage passed the threshold; infinite: never; -1: by the
                                pre-crack alone */
    double time_step;        /* s */
    int64_t steps;           /* done */
    int finished;            /* the run reached its end */
    double spacing, horizon; /* m */
    double rayleigh_speed;   /* m/s */
    int64_t bonds;           /* there were, in pairs */
    size_t broken;           /* bonds, without those of the pre-crack */
    double external_work, kinetic_energy, strain_energy, fracture_work; /* J/m, last output */
    double first_break;      /* s; infinite: none broke */
};

/** Read a run's file; stops (exit 2) where it is missing, cut, of another kind or not in 2D, or a
 *  number in it is impossible. */
struct kr_record *kr_record_read(const char *path);
void kr_record_free(struct kr_record *record);

/** The step at which a node's damage passed the threshold (0: before the run); -1: it never did. */
int64_t kr_record_step(const struct kr_record *record, size_t node);

#endif
