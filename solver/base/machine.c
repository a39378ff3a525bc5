/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The machine's memory. See machine.h.
 */
#include "base/machine.h"

#include "base/error.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

/* The number that a file begins with; infinity where there is no such file or it says "max". */
static double number_in(const char *path) {
    double value = INFINITY;
    FILE *file = fopen(path, "r");
    if (file && fscanf(file, "%lf", &value) != 1)
        value = INFINITY;
    if (file)
        fclose(file);
    return value;
}

double kr_machine_memory(void) {
    double bytes = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    const char *wish = getenv("KIRSCH_MEMORY");
    struct rlimit limit;
    if (wish && atof(wish) > 0)
        bytes = fmin(bytes, 1048576 * atof(wish));
    if (!getrlimit(RLIMIT_AS, &limit) && limit.rlim_cur != RLIM_INFINITY)
        bytes = fmin(bytes, (double)limit.rlim_cur);
    return fmin(bytes, number_in("/sys/fs/cgroup/memory.max"));
}

double kr_machine_peak(void) {
    char line[256];
    double kib = 0;
    FILE *file = fopen("/proc/self/status", "r");
    while (file && fgets(line, sizeof line, file) && sscanf(line, "VmHWM: %lf", &kib) != 1)
        ;
    if (file)
        fclose(file);
    return 1024 * kib;
}

double kr_machine_peak_of_children(void) {
    struct rusage used;
    return getrusage(RUSAGE_CHILDREN, &used) ? 0 : 1024.0 * (double)used.ru_maxrss;
}

void kr_machine_need(double bytes, const char *what) {
    const double gib = 1073741824, there = kr_machine_memory();
    if (bytes > there)
        kr_stop(KR_EXIT_MEMORY, "%s need %.3g GiB of memory at the least, and there are %.3g GiB for this program; take a "
                                "coarser spacing or a larger machine", what, bytes / gib, there / gib);
}
