/* SPDX-License-Identifier: BSD-3-Clause
 *
 * history.csv: energies, broken bonds and reactions over time; docs/formats.md.
 */
#ifndef KR_HISTORY_H
#define KR_HISTORY_H

#include "ledger.h"
#include "probe.h"

struct kr_history; /* Opaque: the open history.csv. */

/** Begin history.csv with its header; or, with bytes > 0, go on behind so many bytes of it and forget
 *  the rest. `boundary`: loads of each stage; they and the
 *  probes are not owned. Stops (exit 3) where it cannot be written. */
struct kr_history *kr_history_open(const char *path, struct kr_boundary *const *boundary,
                                   size_t stages, int dim, const struct kr_probes *probes,
                                   long bytes);

/** How long the file is, all of it on the disk. */
long kr_history_bytes(const struct kr_history *history);

/** When a line is from: step and time of the run, stage from 0, time on its clock [s]. */
struct kr_history_time {
    long step;
    double time;
    size_t stage;
    double stage_time;
};
void kr_history_write(struct kr_history *history, const struct kr_body *body,
                      const struct kr_ledger *ledger, const struct kr_crack *crack, struct kr_history_time at);
void kr_history_close(struct kr_history *history);

#endif
