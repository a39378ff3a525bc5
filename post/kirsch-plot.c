/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-plot: pictures of a run. It finds the holes of the case and hands over to plot.py, which
 * draws; the script lies beside this program or in the folder of the installation.
 */
#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/child.h"
#include "base/error.h"
#include "base/memory.h"
#include "case.h"

/* Not the first `python3` on PATH: that may be one which does not see Debian's packages. */
#define PYTHON "/usr/bin/python3"

static const char usage[] =
    "kirsch-plot case.yaml [PICTURE]... [OPTION]...\n"
    "\n"
    "Draws into the folder `pictures` of the case's folder: grid, damage, energy, speed, tip, tree, history\n"
    "(PNG) and crack (MP4, by ffmpeg); of a solid grid, damage, energy, front, history and crack, where a\n"
    "plane cuts it. Without names, all of them; strip (damage at three times) only by name.\n"
    "\n"
    "  --field NAME       any field of the outputs, as Velocity, Velocity.x, Stress.yy\n"
    "  film --field NAME  the same as a film\n"
    "  --scale N          maps and films of moved cells, displacements N times as large\n"
    "  --limits A,B       of the colours of fields, in the unit shown\n"
    "  --format F         png, svg or pdf;  --dpi N   300 unless told\n"
    "  grid --hole N      the grid around hole N; --void N of a solid\n"
    "  --slice 'z=2 mm'   of a solid: the plane of maps and of the grid, across x, y or z\n"
    "\n"
    "kirsch-plot compare FOLDER FOLDER [--field NAME] [--at TIME]\n"
    "                     two runs and their difference, at the output nearest to TIME in us";

/* Words before those for plot.py; -B: no compiled files are left in the installation. */
enum { COMMAND = 3 };

/** Replace this program by plot.py; word has room for COMMAND words before its own. */
static _Noreturn void become_script(char **word) {
    word[0] = PYTHON;
    word[1] = "-B";
    word[2] = kr_child_script("plot.py");
    execv(PYTHON, word);
    kr_stop(KR_EXIT_LIBRARY,
            "cannot start " PYTHON ": %s; pictures need, on Debian: apt-get install python3 python3-numpy "
            "python3-matplotlib python3-h5py",
            strerror(errno));
}

/** plot.py compare FOLDER FOLDER; it needs no deck. */
static _Noreturn void compare(int argc, char **argv) {
    char **word = KR_NEW(char *, COMMAND + (size_t)argc);
    memcpy(word + COMMAND, argv + 1, (size_t)(argc - 1) * sizeof *word);
    become_script(word);
}

/** Radius [m] of a ball around a void; 0 where only its file knows. */
static double void_reach(const struct kr_case_void *hollow) {
    switch ((enum kr_void_shape)hollow->shape) {
    case KR_VOID_SPHERE:
        return hollow->radius;
    case KR_VOID_ELLIPSOID:
        return fmax(fmax(hollow->radii[0], hollow->radii[1]), hollow->radii[2]);
    case KR_VOID_CYLINDER:
        return hypot(hollow->radius, hollow->length / 2);
    case KR_VOID_STL:
        break;
    }
    return 0;
}

/** plot.py FOLDER --disc x,y,radius... --ball x,y,z,radius... (in m) PICTURE... */
static _Noreturn void hand_over(const struct kr_case *c, const struct kr_case_arguments *arguments) {
    size_t n_holes, n_voids, n = COMMAND;
    struct kr_case_hole *hole = kr_case_holes(c, &n_holes);
    struct kr_case_void *hollow = kr_case_voids(c, &n_voids);
    char **word = KR_NEW(char *, COMMAND + 2 + arguments->n_left + 2 * (n_holes + n_voids));
    word[n++] = (char *)c->folder;
    for (size_t k = 0; k < n_holes; k++) {
        double centre[2], radius = kr_case_hole_reach(&hole[k], centre);
        word[n++] = "--disc";
        word[n++] = kr_text("%.17g,%.17g,%.17g", centre[0], centre[1], radius);
    }
    for (size_t k = 0; k < n_voids; k++) {
        const double *centre = hollow[k].centre;
        word[n++] = "--ball";
        word[n++] = kr_text("%.17g,%.17g,%.17g,%.17g", centre[0], centre[1], centre[2],
                            void_reach(&hollow[k]));
    }
    /* Last, so that an option without its value is seen to have none. */
    for (size_t k = 0; k < arguments->n_left; k++)
        word[n++] = (char *)arguments->left[k];
    become_script(word);
}

int main(int argc, char **argv) {
    struct kr_case_arguments arguments;
    struct kr_deck *deck;
    struct kr_case c;
    kr_error_program("kirsch-plot");
    if (argc > 1 && !strcmp(argv[1], "compare"))
        compare(argc, argv);
    kr_case_arguments(argc, argv, usage, &arguments);
    deck = kr_case_open(&arguments, &c);
    if (!arguments.explain)
        hand_over(&c, &arguments);
    kr_say("would draw into %s/pictures", c.folder);
    kr_deck_close(deck);
    kr_free(arguments.set);
    kr_free(arguments.left);
    return KR_EXIT_OK;
}
