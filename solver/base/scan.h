/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Numbers and words from a mesh file held in memory, ASCII or binary by one set of calls. What is
 * not there stops the program (exit 2) with file, line (ASCII) or byte (binary), found, expected.
 */
#ifndef KR_SCAN_H
#define KR_SCAN_H

#include <stddef.h>
#include <stdint.h>

struct kr_scan {
    const char *path; /* not owned */
    char *data;       /* (size) and a zero */
    size_t size, at;
    int is_binary;
};

/** Read a whole file. Stops (exit 2) where it cannot be read. */
struct kr_scan kr_scan_open(const char *path);

void kr_scan_close(struct kr_scan *scan);

/** Stop, naming the place: "plate.msh:12: expected ..., found ...". */
_Noreturn void kr_scan_bad(const struct kr_scan *scan, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/** The next number; `what` names it in the message where there is none. In a binary file an
 *  integer has 4 bytes, a size and a double have 8. */
int kr_scan_int(struct kr_scan *scan, const char *what);
size_t kr_scan_size(struct kr_scan *scan, const char *what);
double kr_scan_double(struct kr_scan *scan, const char *what);

/** The next n of them into `value`: in a binary file much quicker than one by one. */
void kr_scan_sizes(struct kr_scan *scan, size_t n, size_t *value, const char *what);
void kr_scan_doubles(struct kr_scan *scan, size_t n, double *value, const char *what);

/** A size that counts items still to come, each of `least` numbers or more: stops where the rest
 *  of the file cannot hold them, so that no garbled count is ever allocated. */
size_t kr_scan_count(struct kr_scan *scan, size_t least, const char *what);

/** The next word up to white space, into `word` (cut off at `room`); 0 at the end of the file. */
int kr_scan_word(struct kr_scan *scan, char *word, size_t room);

/** Stop unless the next word is this one. */
void kr_scan_expect(struct kr_scan *scan, const char *word);

#endif
