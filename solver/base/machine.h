/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The machine's memory: how much there is for this program, and how much it has had.
 */
#ifndef KR_MACHINE_H
#define KR_MACHINE_H

/** Bytes that this program may have: what is built in, or less where a limit of the process (ulimit -v), of its group
 *  (memory.max) or of the user (the environment's KIRSCH_MEMORY, in MiB) is lower. */
double kr_machine_memory(void);

/** The most bytes in memory since the program began, libraries and all (VmHWM of proc(5)); 0 where the system does not
 *  tell. */
double kr_machine_peak(void);

/** The same of the largest child that has ended; 0 if there was none. */
double kr_machine_peak_of_children(void);

/** Stop (exit 6) if `bytes`, which `what` cannot do with less than, are more than kr_machine_memory(). To be asked
 *  before they are allocated. what: such as "12000 nodes". */
void kr_machine_need(double bytes, const char *what);

#endif
