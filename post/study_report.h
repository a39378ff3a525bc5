/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What a study found, as one table (docs/formats.md), and the script that runs it on a cluster.
 */
#ifndef KR_STUDY_REPORT_H
#define KR_STUDY_REPORT_H

#include "study.h"

/** Write study.csv into the study's folder, a line a run; it appears whole or not at all. Stops
 *  (exit 3) where it cannot be written. */
void kr_study_report(const struct kr_study *study);

/** Print a Slurm array script to stdout: one task a run. */
void kr_study_slurm(const struct kr_study *study, const struct kr_case_arguments *arguments);

#endif
