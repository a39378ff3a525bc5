/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What a run left behind, as far as crack tracking needs it (run.h5, layout in docs/formats.md).
 */
#ifndef KR_RECORD_H
#define KR_RECORD_H

#include <stddef.h>
#include <stdint.h>

/* What a node's cell lies on: kr_record.rim. */
enum { KR_RIM_NONE = 0, KR_RIM_BOUNDARY = -1 }; /* k > 0: the rim of hole k */

struct kr_record {
    int dim;
    size_t n;
    double *position;        /* (n x dim) m */
    double *volume;          /* (n) m^2, in 3D m^3 */
    double *damage_time;     /* (n) s: when Damage passed the threshold; infinite: never; -1: by the
                                pre-crack alone */
    int *rim;                /* (n); NULL where the node file has no sets */
    double time_step;        /* s */
    int64_t steps;           /* done */
    int finished;            /* the run reached its end */
    double spacing, horizon; /* m */
    double rayleigh_speed;   /* m/s */
    double fracture_energy;  /* J/m^2 */
    double density;          /* kg/m^3 */
    int64_t bonds;           /* there were, in pairs */
    size_t broken;           /* bonds, without those of the pre-crack */
    int32_t *bond;           /* (broken x 2) */
    double *bond_time;       /* (broken) s */
    double *bond_energy;     /* (broken) J/m, in 3D J: what each held when it broke */
    double external_work, kinetic_energy, strain_energy, fracture_work; /* J/m, last output */
    double first_break;      /* s; infinite: none broke */
};

/** Read a run's file; stops (exit 2) where it is missing, cut or of another kind, or a number in it
 *  is impossible. */
struct kr_record *kr_record_read(const char *path);
void kr_record_free(struct kr_record *record);

/** Read from a node file which nodes lie on which rim: sets `hole_k` and `void_k` are holes, other
 *  sets with a measure boundaries. Stops (exit 2) where the file is cut or of another body. */
void kr_record_read_rims(struct kr_record *record, const char *path);

/** The step at which a node's damage passed the threshold (0: before the run); -1: it never did. */
int64_t kr_record_step(const struct kr_record *record, size_t node);

#endif
