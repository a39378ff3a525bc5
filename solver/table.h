/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tables: numbers over time from a CSV file, with straight lines between them.
 */
#ifndef KR_TABLE_H
#define KR_TABLE_H

#include "base/deck.h"

struct kr_table; /* Opaque. Implemented in table.c. */

/** Read a table. The first line names the columns, the first of them the time with its unit:
 *
 *    time [us],factor
 *    0,0
 *    10,1
 *
 *  in  field   of the deck, where faults are told: file missing, no header, unit not one of time, a line
 *              without the column, no number, times that do not ascend, fewer than two lines
 *  in  path    of the file
 *  in  column  its name; NULL: the second one
 *  returns NULL after a fault.
 */
struct kr_table *kr_table_read(struct kr_deck *deck, const void *field, const char *path,
                               const char *column);
void kr_table_free(struct kr_table *table);

/** Value at time t [s]: before the first line that of the first; after the last that of the last, or, with
 *  `repeats`, from the first again. */
double kr_table_value(const struct kr_table *table, double t, int repeats);

#endif
