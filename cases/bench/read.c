/* SPDX-License-Identifier: BSD-3-Clause
 *
 * How fast are meshes read? Times the reader of gmsh's files: processor time, best of several.
 */
#include "base/error.h"
#include "mesh.h"

#include <math.h>
#include <time.h>

static double cpu_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int main(int argc, char **argv) {
    for (int k = 1; k < argc; k++) {
        double best = INFINITY;
        size_t cells = 0;
        for (int run = 0; run < 7; run++) {
            double begun = cpu_seconds();
            struct kr_mesh *mesh = kr_mesh_read_msh(argv[k]);
            best = fmin(best, cpu_seconds() - begun);
            cells = mesh->n_cells;
            kr_mesh_free(mesh);
        }
        kr_say("  %-28s %8zu cells in %.3f s", argv[k], cells, best);
    }
    return KR_EXIT_OK;
}
