/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Signals that ask a run for a checkpoint: SIGUSR1 to write one and go on, SIGTERM and SIGINT to write
 * one and stop. A limit of wall time stops like SIGTERM.
 */
#ifndef KR_INTERRUPT_H
#define KR_INTERRUPT_H

enum kr_interrupt { KR_INTERRUPT_NONE, KR_INTERRUPT_CHECKPOINT, KR_INTERRUPT_STOP };

/** Listen from now on. */
void kr_interrupt_begin(void);

/** Ask for a checkpoint and a stop when so many seconds of wall time (> 0) have passed. */
void kr_interrupt_after(unsigned seconds);

/** What was asked for since the last call; a stop stays asked for. */
enum kr_interrupt kr_interrupt_asked(void);

/** Whether a stop was asked for, and nothing else: long work between two looks ends early. */
enum kr_interrupt kr_interrupt_pending(void);

#endif
