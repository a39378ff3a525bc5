/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Runs as children. A free place is filled by the next run; its threads are what the others leave.
 */
#include "study_run.h"

#include <errno.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/child.h"
#include "base/error.h"
#include "base/memory.h"

extern char **environ;

/* One of the runs that are under way. */
struct place {
    struct kr_child child;
    size_t run;
    size_t threads; /* 0: the place is free */
};

struct work {
    struct kr_study *study;
    const struct kr_study_plan *plan;
    size_t processors, n_places;
    struct place *place;
    size_t next, ended; /* run to be started; how many have ended */
};

static volatile sig_atomic_t interrupted;

static void note(int signal) {
    (void)signal;
    interrupted = 1;
}

size_t kr_study_processors(void) {
    const char *wanted = getenv("OMP_NUM_THREADS");
    long threads = wanted ? strtol(wanted, NULL, 10) : 0;
    cpu_set_t set;
    if (threads > 0)
        return (size_t)threads;
    return sched_getaffinity(0, sizeof set, &set) ? 1 : (size_t)CPU_COUNT(&set);
}

/* ---- wall time ----------------------------------------------------------------------------- */

static char *time_path(const struct kr_study_run *run) {
    return kr_text("%s/.steps/wall-time", run->folder);
}

double kr_study_wall_time(const struct kr_study_run *run) {
    char *path = time_path(run);
    double seconds = 0;
    FILE *file = fopen(path, "r");
    if (file && fscanf(file, "%lf", &seconds) != 1)
        seconds = 0;
    if (file)
        fclose(file);
    kr_free(path);
    return seconds;
}

/* Kept beside the stamps, of which there are none where the deck was refused; where it fails, the
   table is short of a time and nothing else. */
static void add_wall_time(const struct kr_study_run *run, double seconds) {
    char *path = time_path(run), *beside = kr_text("%s.tmp", path);
    seconds += kr_study_wall_time(run);
    FILE *file = fopen(beside, "w");
    int no_stamps = !file && errno == ENOENT;
    if (!no_stamps &&
        (!file || fprintf(file, "%.3f\n", seconds) < 0 || fclose(file) || rename(beside, path)))
        kr_warn("the wall time of %s cannot be kept: %s", run->name, strerror(errno));
    kr_free(beside);
    kr_free(path);
}

/* ---- children ------------------------------------------------------------------------------ */

/* The environment of this program with another OMP_NUM_THREADS; `threads` keeps the text. */
static char **environment_of(char *threads) {
    size_t n = 0, count = 0;
    while (environ[count])
        count++;
    char **environment = KR_NEW(char *, count + 2);
    for (size_t k = 0; k < count; k++)
        if (strncmp(environ[k], "OMP_NUM_THREADS=", 16))
            environment[n++] = environ[k];
    environment[n] = threads;
    return environment;
}

/* The command up to tracking, or to check: pictures are drawn of the study as a whole. */
static char **command_of(const struct work *work, const struct kr_study_run *run) {
    char **some = kr_study_command(work->study, run);
    size_t n = 0;
    while (some[n])
        n++;
    char **word = kr_realloc(some, n + 3, sizeof *word);
    if (work->plan->check) {
        word[n] = kr_text_copy("--check");
    } else {
        word[n++] = kr_text_copy("--until");
        word[n] = kr_text_copy("track");
    }
    return word;
}

static void start(struct work *work, struct place *place, size_t threads) {
    const struct kr_study_run *run = &work->study->run[work->next];
    char *text = kr_text("OMP_NUM_THREADS=%zu", threads);
    char **environment = environment_of(text), **word = command_of(work, run);
    place->run = work->next++;
    place->threads = threads;
    kr_child_prepare(&place->child);
    kr_child_start_in(&place->child, word, environment, 0);
    kr_study_command_free(word);
    kr_free(environment);
    kr_free(text);
}

/* Whether a line of the child's report has these words. */
static int has_said(FILE *file, const char *words) {
    char *line = NULL;
    size_t room = 0;
    int found = 0;
    rewind(file);
    while (!found && getline(&line, &room, file) >= 0)
        found = strstr(line, words) != NULL;
    free(line);
    return found;
}

/* The first line that is no warning: what went wrong, in the words of the step. */
static char *sentence_of(FILE *said, int status) {
    char *line = NULL, *found = NULL;
    size_t room = 0;
    rewind(said);
    while (!found && getline(&line, &room, said) >= 0) {
        line[strcspn(line, "\n")] = 0;
        if (*line && !strstr(line, ": warning: "))
            found = kr_text_copy(line);
    }
    free(line);
    return found ? found : kr_child_trouble(status, 0);
}

static void tell(const struct work *work, const struct kr_study_run *run, const char *what) {
    kr_say("[%zu/%zu] %s: %s", work->ended, work->plan->only ? 1 : work->study->n_runs, run->name,
           what);
}

/* What a child that ended means for its run. */
static void settle(struct work *work, struct place *place, int status) {
    struct kr_study_run *run = &work->study->run[place->run];
    double seconds = kr_child_clock() - place->child.started;
    int before = has_said(place->child.out, "kirsch-solve is up to date"), code = 0;
    if (WIFEXITED(status))
        code = WEXITSTATUS(status);
    work->ended++;
    if (!before && !work->plan->check)
        add_wall_time(run, seconds);
    char *text;
    if (WIFEXITED(status) && code == KR_EXIT_OK) {
        run->state = KR_STUDY_DONE;
        text = work->plan->check ? kr_text("no faults")
               : before          ? kr_text("was done before")
                                 : kr_text("done in %.1f s", seconds);
    } else if (code == KR_EXIT_SIGNAL || (interrupted && WIFSIGNALED(status))) {
        run->state = KR_STUDY_INTERRUPTED;
        text = kr_text("interrupted; it will go on from its checkpoint");
    } else {
        run->state = KR_STUDY_FAILED;
        run->code = code ? code : KR_EXIT_LIBRARY;
        run->fault = sentence_of(place->child.said, status);
        text = kr_text("FAILED: %s", run->fault);
    }
    tell(work, run, text);
    kr_free(text);
    kr_child_close(&place->child);
    place->threads = 0;
}

/* ---- all of them --------------------------------------------------------------------------- */

static size_t threads_in_use(const struct work *work, size_t *free_places) {
    size_t used = 0;
    *free_places = 0;
    for (size_t k = 0; k < work->n_places; k++) {
        used += work->place[k].threads;
        *free_places += !work->place[k].threads;
    }
    return used;
}

static void fill_places(struct work *work, size_t end) {
    for (size_t k = 0; k < work->n_places && work->next < end && !interrupted; k++) {
        if (work->place[k].threads)
            continue;
        size_t places, used = threads_in_use(work, &places), left = end - work->next;
        size_t share = (work->processors - used) / (left < places ? left : places);
        start(work, &work->place[k], share ? share : 1);
    }
}

static struct place *place_of(const struct work *work, pid_t pid) {
    for (size_t k = 0; k < work->n_places; k++)
        if (work->place[k].threads && work->place[k].child.pid == pid)
            return &work->place[k];
    return NULL;
}

void kr_study_run_all(struct kr_study *study, const struct kr_study_plan *plan) {
    struct work work = {.study = study, .plan = plan, .processors = kr_study_processors()};
    struct sigaction action = {.sa_handler = note, .sa_flags = SA_RESTART}, old;
    size_t end = plan->only ? plan->only : study->n_runs, places;
    work.next = plan->only ? plan->only - 1 : 0;
    work.n_places = plan->at_once ? plan->at_once : work.processors;
    if (work.processors < work.n_places)
        work.processors = work.n_places;
    work.place = KR_NEW(struct place, work.n_places);
    sigaction(SIGINT, &action, &old);
    fill_places(&work, end);
    while (threads_in_use(&work, &places)) {
        int status;
        struct place *place = place_of(&work, kr_child_wait(&status));
        if (place)
            settle(&work, place, status);
        fill_places(&work, end);
    }
    sigaction(SIGINT, &old, NULL);
    kr_free(work.place);
}

void kr_study_look(struct kr_study *study) {
    for (size_t r = 0; r < study->n_runs; r++) {
        struct kr_study_run *run = &study->run[r];
        char *stamp = kr_text("%s/.steps/kirsch-track", run->folder);
        if (run->state == KR_STUDY_OPEN && access(stamp, R_OK) == 0)
            run->state = KR_STUDY_DONE;
        kr_free(stamp);
    }
}
