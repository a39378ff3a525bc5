/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Run a program as a child without a shell, its three standard files in memory: the parent never
 * waits for a pipe, and nothing is left behind whatever happens.
 */
#ifndef KR_CHILD_H
#define KR_CHILD_H

#include <stdio.h>
#include <sys/types.h>

struct kr_child {
    pid_t pid;
    FILE *in, *out, *said; /* its standard input, output and error, seen from here */
    double started;        /* s */
};

/** The three files, to write the input; the child is not yet running. Stops (exit 6) without
 *  memory for them. */
void kr_child_prepare(struct kr_child *child);

/** Start `program` on what was written, from a copy in memory, in the folder / and with no environment but
 * LD_LIBRARY_PATH: gmsh's cells hang on where it allocates, and so on the lengths of its own path and of its folder.
 * After `seconds` of processor time, or twenty times as many by the clock, the system ends it; it also ends with its
 * parent. Stops (exit 5) where no process can be made. */
void kr_child_start(struct kr_child *child, const char *program, unsigned seconds);

/** The same for a program that reads the file `from` on its standard input: `argument` ends with NULL, and `folder`,
 * where it is not NULL, is what the program may write into as KR_CHILD_FOLDER. So no path of a user's reaches it.
 * Stops (exit 2) where the file cannot be read, (exit 3) where there is no folder. */
#define KR_CHILD_FOLDER "/proc/self/fd/4"
void kr_child_start_on(struct kr_child *child, const char *program, char *const *argument, const char *from,
                       const char *folder, unsigned seconds);

/** The same with arguments, from where the program lies and in the folder of the caller: `word` is the program, its
 * arguments, NULL. */
void kr_child_start_words(struct kr_child *child, char *const *word, unsigned seconds);

/** The same in an environment of the caller's choice, "NAME=value" and NULL at the end. With 0
 *  seconds there is no limit. */
void kr_child_start_in(struct kr_child *child, char *const *word, char *const *environment,
                       unsigned seconds);

/** Wait for any child; returns its pid and its status as of waitpid. */
pid_t kr_child_wait(int *status);

/** What a status other than success means, in words owned by the caller; NULL for success. */
char *kr_child_trouble(int status, unsigned seconds);

/** First line of what the child said that holds `word`, owned by the caller; NULL if none. */
char *kr_child_line(struct kr_child *child, const char *word);

/** Close the files. */
void kr_child_close(struct kr_child *child);

/** Path of a program in the same folder as this one, owned by the caller. Stops (exit 5) where
 *  there is none. */
char *kr_child_beside(const char *name);

/** Path of a script, owned by the caller: beside this program (in the build) or in ../share/kirsch
 *  (installed). Stops (exit 5) where there is none. */
char *kr_child_script(const char *name);

/** Monotonic time [s]. */
double kr_child_clock(void);

#endif
