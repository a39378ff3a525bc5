/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What lies between a deck that was read and a case that can be used: completed and checked. kr_case_open does all
 * of it; the parts stand in case_*.c.
 */
#ifndef KR_CASE_CHECK_H
#define KR_CASE_CHECK_H

#include "case.h"

/** Fill in what the case's preset chooses and the deck does not give itself. `c` must be the struct
 *  that the deck was read into. */
void kr_case_preset(const struct kr_deck *deck, struct kr_case *c);

/** Complete outline and pores: which centres were given, and files from the deck's folder. `c` must
 *  be the struct that the deck was read into. */
void kr_case_complete_geometry(struct kr_deck *deck, struct kr_case *c);

/** Check what no single key can tell: horizon against spacing, loads against sets. Faults are
 *  collected in the deck. `c` must be the struct that the deck was read into. */
void kr_case_check(struct kr_deck *deck, const struct kr_case *c);

/** Warn of what is doubtful in a case without faults. */
void kr_case_warn(struct kr_deck *deck, const struct kr_case *c);

/* ---- parts of kr_case_check ---- */

/** The material: its law, and whether there is such a solid. */
void kr_case_check_material(struct kr_deck *deck, const struct kr_case *c);

/** Outline and holes. */
void kr_case_check_geometry(struct kr_deck *deck, const struct kr_case *c);

/** A polygon's corners, pairs of x and y: three or more, in turn; whether they are sound. */
int kr_case_check_corners(struct kr_deck *deck, const struct kr_deck_list *points);

/** Depth, voids and the body of an STL file. */
void kr_case_check_solid(struct kr_deck *deck, const struct kr_case *c);

/** Random pores. */
void kr_case_check_pores(struct kr_deck *deck, const struct kr_case *c);

/** Pre-cracks. */
void kr_case_check_cracks(struct kr_deck *deck, const struct kr_case *c);

/** Stages and the end of the run. */
void kr_case_check_stages(struct kr_deck *deck, const struct kr_case *c);

/** The spacing against the sides of the plate. Not for meshes from elsewhere. */
void kr_case_check_fit(struct kr_deck *deck, const struct kr_case *c);

/** Boundaries and sets that sets, loads, probes and no_fail name. Not for meshes from elsewhere. */
void kr_case_check_names(struct kr_deck *deck, const struct kr_case *c);

/** One set of nodes. */
void kr_case_check_set(struct kr_deck *deck, const struct kr_case *c,
                       const struct kr_case_set *set);

/** Whether the deck gives components for a vector, and as many as the model has dimensions; a fault
 *  where it gives others. */
int kr_case_check_count(struct kr_deck *deck, const struct kr_case *c, const void *vector);

/** Fault a box whose upper corner is not above the lower one. */
void kr_case_check_box(struct kr_deck *deck, const double *lower, const double *upper, int dim);

/** Letters, digits, _ and -: a name becomes a dataset of HDF5 and a column of CSV. */
int kr_case_is_name(const char *text);

#endif
