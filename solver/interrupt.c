/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Signals. The handler only notes which came; the time loop looks between two steps.
 */
#include "interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <unistd.h>

static volatile sig_atomic_t stop, checkpoint;

static void note(int signal) {
    if (signal == SIGUSR1)
        checkpoint = 1;
    else
        stop = 1;
}

void kr_interrupt_begin(void) {
    struct sigaction action = {.sa_handler = note, .sa_flags = SA_RESTART};
    sigaction(SIGUSR1, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGINT, &action, NULL);
}

void kr_interrupt_after(unsigned seconds) {
    struct sigaction action = {.sa_handler = note, .sa_flags = SA_RESTART};
    sigaction(SIGALRM, &action, NULL);
    alarm(seconds);
}

enum kr_interrupt kr_interrupt_asked(void) {
    if (stop)
        return KR_INTERRUPT_STOP;
    if (!checkpoint)
        return KR_INTERRUPT_NONE;
    checkpoint = 0;
    return KR_INTERRUPT_CHECKPOINT;
}

enum kr_interrupt kr_interrupt_pending(void) {
    return stop ? KR_INTERRUPT_STOP : KR_INTERRUPT_NONE;
}
