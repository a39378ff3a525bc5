/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Children that fill regions, several at once: each region by one method after the other until a reply passes every
 * check. Nothing that a child says is believed. What is asked and what a reply must be, the callers know (gmsh.c in
 * the plane, gmsh_solid.c in space).
 */
#ifndef KR_CREW_H
#define KR_CREW_H

#include <stdio.h>

/** A region, as far as the crew knows it. */
struct kr_crew_job {
    const char *name; /* for messages: "around hole_3" */
    size_t method;    /* got: the one whose reply was taken */
    double seconds;   /* got: all attempts together */
};

struct kr_crew {
    const char *program;  /* path of the child */
    int children;         /* at once; 0: as many as there are processors */
    unsigned seconds;     /* longest processor time of one attempt; 0: 300 */
    const char *harmless; /* part of a line of the child's that is no failure; NULL: none */
    size_t n_methods, first;
    const char *(*method_words)(size_t method);
    void *regions; /* passed on to these two */
    void (*ask)(void *regions, size_t region, size_t method, FILE *to);
    /** Take a reply that passes every check; else what is wrong, owned by the caller of it. */
    char *(*take)(void *regions, size_t region, FILE *from);
};

/** Do all jobs; the child of order[0] starts first (NULL: of job 0). Where an attempt fails, a warning says why and the
 *  next method is tried, the first one after the last; where all have failed, it stops (exit 5) and names the region. */
void kr_crew_work(const struct kr_crew *crew, size_t n_jobs, struct kr_crew_job *job, const size_t *order);

#endif
