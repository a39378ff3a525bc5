/* SPDX-License-Identifier: BSD-3-Clause
 *
 * How the programs with gmsh in their names call it: after every call they ask whether it went well,
 * and end with a sentence for kirsch-mesh if it did not.
 */
#ifndef KR_CALLED_H
#define KR_CALLED_H

#include <gmshc.h>

#include <stdio.h>
#include <stdlib.h>

/** Every call of gmsh has `&trouble` as its last argument; `called` follows. */
static int trouble;

_Noreturn static void fail(const char *sentence) {
    fprintf(stderr, "Error   : %s\n", sentence);
    exit(1);
}

static void called(const char *what) {
    if (trouble) {
        fprintf(stderr, "Error   : %s ended with %d\n", what, trouble);
        exit(1);
    }
}

static void *room(size_t count, size_t size) {
    void *array = calloc(count ? count : 1, size);
    if (!array)
        fail("no memory");
    return array;
}

static void set(const char *option, double value) {
    gmshOptionSetNumber(option, value, &trouble);
    called(option);
}

#endif
