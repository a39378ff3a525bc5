/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch: runs the steps of a case that are out of date, each a program of its own. See step.h.
 */
#include "base/child.h"
#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "doctor.h"
#include "step.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

static const char usage[] =
    "kirsch case.yaml         run the steps of a case that are out of date:\n"
    "                         kirsch-pores, -mesh, -nodes, -solve, -track, -plot\n"
    "kirsch doctor            is everything installed and sane?\n"
    "kirsch --deck-reference  print the reference of the deck's keys (Markdown)\n"
    "\n"
    "  --force            run all steps\n"
    "  --until STEP       stop behind it: pores, mesh, nodes, solve, track or plot";

/* One kirsch at a time works in a folder. The lock is handed down to the steps, so that it is held
   until the last of them has ended, also where this program was killed before. */
static void lock_folder(const struct kr_job *job) {
    char *folder = kr_case_file(&job->c, ".steps"), *path = kr_case_file(&job->c, ".steps/lock");
    kr_folder_make_within(folder);
    int lock = open(path, O_RDWR | O_CREAT | O_NOFOLLOW, 0666);
    if (lock < 0)
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be written: %s", path, strerror(errno));
    if (flock(lock, LOCK_EX | LOCK_NB) && errno == EWOULDBLOCK) {
        kr_say("another kirsch is at work in %s: waiting until it has ended", job->c.folder);
        while (flock(lock, LOCK_EX) && errno == EINTR)
            ;
    } /* a file system without locks has none to wait for */
    kr_free(folder);
    kr_free(path);
}

/* ---- steps ---- */

/* The program with the options that this one was given. */
static const char **command_of(const struct kr_job *job, const char *program) {
    const struct kr_case_arguments *a = &job->arguments;
    const char **word = KR_NEW(const char *, 10 + 2 * a->n_set);
    size_t n = 0;
    word[n++] = program;
    word[n++] = a->deck;
    if (a->variant) {
        word[n++] = "--variant";
        word[n++] = a->variant;
    }
    if (a->folder) {
        word[n++] = "--output";
        word[n++] = a->folder;
    }
    for (size_t k = 0; k < a->n_set; k++) {
        word[n++] = "--set";
        word[n++] = a->set[k];
    }
    return word;
}

static void append(const char **command, const char *word) {
    while (*command)
        command++;
    *command = word;
}

/* Whether the step was begun with just these inputs and left a checkpoint. */
static int can_resume(const struct kr_job *job, const struct kr_step *step) {
    char *path = kr_case_file(&job->c, "checkpoint.h5");
    int can = !job->force && !strcmp(step->program, "kirsch-solve") && access(path, R_OK) == 0 &&
              kr_step_was_begun(job, step);
    kr_free(path);
    return can;
}

/* Run one step and wait; what goes wrong has been said by the step itself. */
static void run_step(const struct kr_job *job, const struct kr_step *step) {
    char *program = kr_child_beside(step->program);
    const char **command = command_of(job, program);
    int status;
    if (can_resume(job, step))
        append(command, "--resume");
    if (job->mesh && step == &kr_steps[KR_STEP_NODES])
        append(command, job->mesh);
    kr_step_note_begun(job, step);
    kr_say("%s", step->program);
    signal(SIGINT, SIG_IGN); /* Ctrl-C is the step's business: it may want to leave a checkpoint */
    pid_t parent = getpid(), child = fork();
    if (child < 0)
        kr_stop(KR_EXIT_LIBRARY, "cannot start %s: %s", program, strerror(errno));
    if (child == 0) {
        signal(SIGINT, SIG_DFL);
        prctl(PR_SET_PDEATHSIG, SIGTERM); /* killed with this program, a solve leaves a checkpoint */
        if (getppid() != parent)
            _exit(127);
        kr_case_note_warned();
        execv(program, (char **)command);
        _exit(127);
    }
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
    signal(SIGINT, SIG_DFL);
    if (WIFEXITED(status) && WEXITSTATUS(status))
        kr_stop(WEXITSTATUS(status), "%s did not finish; the steps behind it were not run",
                step->program);
    if (WIFSIGNALED(status))
        kr_stop(KR_EXIT_LIBRARY, "%s was ended by signal %d (%s)", step->program, WTERMSIG(status),
                strsignal(WTERMSIG(status)));
    kr_free(command);
    kr_free(program);
}

static void run_steps(const struct kr_job *job) {
    int behind = job->force;
    lock_folder(job);
    for (int k = 0; k < job->n_steps; k++) {
        const struct kr_step *step = &kr_steps[k];
        if ((k == KR_STEP_PORES && !kr_case_has_pores(&job->c)) || (k <= KR_STEP_MESH && job->mesh))
            continue;
        if (!behind && kr_step_is_up_to_date(job, step)) {
            kr_say("%s is up to date", step->program);
            continue;
        }
        run_step(job, step);
        kr_step_note_done(job, step);
    }
}

/* ---- the end ---- */

static double summary_value(const char *path, const char *name) {
    char line[512], found[256];
    double value, result = 0;
    FILE *file = fopen(path, "r");
    while (file && fgets(line, sizeof line, file))
        if (sscanf(line, "%255[^,],%lf", found, &value) == 2 && !strcmp(found, name))
            result = value;
    if (file)
        fclose(file);
    return result;
}

static void print_summary(const struct kr_job *job) {
    char *path = kr_case_file(&job->c, "summary.csv");
#define VALUE(name) summary_value(path, name)
    kr_say("\n%s", job->c.title ? job->c.title : job->arguments.deck);
    kr_say("  %.0f nodes, %.0f bonds, %.0f steps of %.4g us", VALUE("nodes"), VALUE("bonds"),
           VALUE("steps"), 1e6 * VALUE("time_step"));
    if (VALUE("broken_bonds") > 0) {
        kr_say("  first growth at %.2f us, %.0f bonds broken, %.0f branches", 1e6 * VALUE("first_growth"),
               VALUE("broken_bonds"), VALUE("branches"));
        if (VALUE("branches") > 0)
            kr_say("  crack speed %.0f m/s in the mean (%.2f of the Rayleigh speed %.0f m/s), %.0f m/s "
                   "at the top (%.2f)", VALUE("mean_speed"), VALUE("mean_speed_over_rayleigh"),
                   VALUE("rayleigh_speed"), VALUE("top_speed"), VALUE("top_speed_over_rayleigh"));
    } else {
        kr_say("  no bond broke");
    }
    kr_say("  energy: %.4g J/m of work = %.4g kinetic + %.4g strain + %.4g fracture; balance %.2g %%",
           VALUE("external_work"), VALUE("kinetic_energy"), VALUE("strain_energy"),
           VALUE("fracture_work"), 100 * VALUE("energy_balance"));
#undef VALUE
    kr_free(path);
}

static void print_paths(const struct kr_job *job) {
    static const char *const made[] = {
        "pictures/grid.png", "pictures/damage.png",  "pictures/energy.png",
        "pictures/tree.png", "pictures/speed.png", "pictures/tip.png", "pictures/front.png",
        "pictures/history.png", "pictures/crack.mp4",
        "tips.csv",          "branches.csv",         "events.csv",
        "damage.csv",        "front.csv",            "area.csv",
        "fragments.csv",     "history.csv",          "summary.csv",
        "run.xdmf"};
    for (size_t k = 0; k < sizeof made / sizeof made[0]; k++) {
        char *path = kr_case_file(&job->c, made[k]);
        if (access(path, R_OK) == 0)
            kr_say("  %s%s", path, strstr(path, ".xdmf") ? "   (open in ParaView)" : "");
        kr_free(path);
    }
}

/* ---- the beginning ---- */

/* Number of the step behind which to stop. */
static int steps_until(const char *name) {
    for (int k = 0; k < KR_STEPS; k++)
        if (!strcmp(kr_steps[k].program + strlen("kirsch-"), name))
            return k + 1;
    kr_stop(KR_EXIT_INPUT,
            "--until: found '%s', expected pores, mesh, nodes, solve, track or plot", name);
}

static void take_own_arguments(struct kr_job *job) {
    const struct kr_case_arguments *a = &job->arguments;
    job->n_steps = KR_STEPS;
    for (size_t k = 0; k < a->n_left; k++)
        if (!strcmp(a->left[k], "--force"))
            job->force = 1;
        else if (!strcmp(a->left[k], "--until"))
            job->n_steps = steps_until(k + 1 < a->n_left ? a->left[++k] : "");
        else
            kr_stop(KR_EXIT_INPUT, "unknown argument '%s'; see kirsch --help", a->left[k]);
}

/* Files that a later step would miss. */
static void look_ahead(const struct kr_job *job) {
    kr_case_check_files(job->deck, &job->c);
    kr_deck_finish(job->deck);
}

/* Without holes; a mesh or body from elsewhere has its own number. */
static void say_size(const struct kr_job *job) {
    const struct kr_case *c = &job->c;
    double layers = kr_case_dim(c) == 3 ? c->depth / c->spacing : 1;
    if (!job->mesh && !(c->body.file && *c->body.file))
        kr_say("at most about %.0f nodes", c->width / c->spacing * (c->height / c->spacing) * layers);
}

/* kirsch-solve knows what follows from the deck, once there are nodes. */
static void explain(const struct kr_job *job) {
    char *nodes = kr_case_file(&job->c, "plate.nodes.h5");
    char *deck_text = kr_deck_resolved(job->deck, NULL);
    printf("%s", deck_text);
    say_size(job);
    if (access(nodes, R_OK) == 0) {
        char *program = kr_child_beside("kirsch-solve");
        const char **command = command_of(job, program);
        append(command, "--explain");
        kr_case_note_warned();
        execv(program, (char **)command);
        kr_stop(KR_EXIT_LIBRARY, "cannot start %s: %s", program, strerror(errno));
    }
    kr_say("there are no nodes yet: bonds, time step, memory and time follow from them; run "
           "kirsch-pores, kirsch-mesh and kirsch-nodes on the deck, then --explain again");
    kr_free(nodes);
    kr_free(deck_text);
}

int main(int argc, char **argv) {
    struct kr_job job = {0};
    kr_error_program("kirsch");
    if (argc == 2 && !strcmp(argv[1], "doctor"))
        return kr_doctor();
    if (argc == 2 && !strcmp(argv[1], "--deck-reference")) {
        kr_deck_reference(stdout, kr_case_keys);
        return KR_EXIT_OK;
    }
    kr_case_arguments(argc, argv, usage, &job.arguments);
    take_own_arguments(&job);
    job.arguments.meshes = 1;
    job.deck = kr_case_open(&job.arguments, &job.c);
    if (job.c.mesh_file && *job.c.mesh_file)
        job.mesh = kr_deck_beside(job.deck, job.c.mesh_file);
    look_ahead(&job);
    if (job.arguments.explain) {
        explain(&job);
    } else {
        run_steps(&job);
        if (job.n_steps > KR_STEP_TRACK && kr_case_dim(&job.c) == 2)
            print_summary(&job);
        print_paths(&job);
    }
    kr_deck_close(job.deck);
    kr_free(job.mesh);
    kr_free(job.arguments.set);
    kr_free(job.arguments.left);
    return KR_EXIT_OK;
}
