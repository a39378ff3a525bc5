/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Is everything installed and sane? Each check runs the thing itself, without a shell.
 */
#include "doctor.h"

#include "base/error.h"
#include "base/expression.h"
#include "base/memory.h"
#include "base/provenance.h"
#include "base/unit.h"
#include "kernel.h"

#include <ctype.h>
#include <fcntl.h>
#include <math.h>
#include <omp.h>
#include <sys/wait.h>
#include <unistd.h>

static int report(const char *what, int good, const char *cure) {
    kr_say("  %-28s %s%s", what, good ? "ok" : "MISSING: ", good ? "" : cure);
    return good;
}

/* Whether a command ends well; what it says is thrown away. */
static int runs(char *const command[]) {
    int status = 1;
    pid_t child = fork();
    if (child == 0) {
        int nowhere = open("/dev/null", O_RDWR);
        for (int k = 0; k < 3; k++)
            dup2(nowhere, k);
        execvp(command[0], command);
        _exit(127);
    }
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) &&
           WEXITSTATUS(status) == 0;
}

static int check_programs(void) {
    static const char *const programs[] = {"kirsch-pores", "kirsch-mesh", "kirsch-gmsh",
                                           "kirsch-nodes", "kirsch-solve", "kirsch-track",
                                           "kirsch-plot"};
    int good = 1;
    for (size_t k = 0; k < sizeof programs / sizeof programs[0]; k++) {
        char folder[4096], *path;
        ssize_t length = readlink("/proc/self/exe", folder, sizeof folder - 1);
        folder[length > 0 ? length : 0] = 0;
        while (length > 0 && folder[length] != '/')
            folder[length--] = 0;
        path = kr_text("%s%s", folder, programs[k]);
        good &= report(programs[k], access(path, X_OK) == 0, "run make again");
        kr_free(path);
    }
    return good;
}

static int check_libraries(void) {
    double metres = 0, value = NAN;
    char *why = NULL;
    int good = report("units (udunits2)",
                      kr_unit_read("0.16 mm", "m", &metres, &why) && fabs(metres - 1.6e-4) < 1e-18,
                      "apt-get install libudunits2-0");
    kr_free(why);
    why = NULL;
    struct kr_expression *expression = kr_expression_create("2 * x + t", &why);
    if (expression) {
        value = kr_expression_value(expression, 1.5, 0, 0, 4);
        kr_expression_free(expression);
    }
    kr_free(why);
    return good & report("expressions (muParser)", value == 7, "apt-get install libmuparser2v5");
}

static int check_python(void) {
    static char *const modules[] = {"numpy", "h5py", "matplotlib", "meshio", "netCDF4"};
    int good = 1;
    for (size_t k = 0; k < sizeof modules / sizeof modules[0]; k++) {
        char *import = kr_text("import %s", modules[k]);
        char *what = kr_text("python3: %s", modules[k]);
        char *cure = kr_text("apt-get install python3-%s", modules[k]);
        for (char *c = cure; *c; c++) /* Debian's names are in small letters */
            *c = (char)tolower((unsigned char)*c);
        good &= report(what, runs((char *[]){"/usr/bin/python3", "-c", import, NULL}), cure);
        kr_free(import);
        kr_free(what);
        kr_free(cure);
    }
    return good;
}

int kr_doctor(void) {
    kr_say("kirsch %s", kr_version());
    int good = check_programs();
    good &= check_libraries();
    good &= check_python();
    good &= report("ffmpeg (films only)", runs((char *[]){"ffmpeg", "-version", NULL}),
                   "apt-get install ffmpeg");
    kr_say("  loop over bonds: built for %s; %d threads (OMP_NUM_THREADS) on %d processors, %s",
           kr_kernel_best()->name, omp_get_max_threads(), omp_get_num_procs(),
           omp_get_proc_bind() == omp_proc_bind_false ? "not bound to them (OMP_PROC_BIND)"
                                                      : "bound to them");
    kr_say(good ? "all is well" : "something is missing");
    kr_unit_close();
    return good ? KR_EXIT_OK : KR_EXIT_LIBRARY;
}
