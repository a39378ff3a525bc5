/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Stamps of steps. See step.h.
 */
#include "step.h"

#include "base/file.h"
#include "base/memory.h"
#include "base/provenance.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const struct kr_step kr_steps[KR_STEPS] = {
    {"kirsch-pores", "geometry", {NULL}, {"pores.txt"}},
    {"kirsch-mesh", "geometry mesh nodes", {"pores.txt"}, {"plate.msh"}},
    {"kirsch-nodes", "nodes material loads stages no_fail", {"plate.msh"}, {"plate.nodes.h5"}},
    {"kirsch-solve",
     "title nodes material cracks initial loads no_fail stages solver output",
     {"plate.nodes.h5"},
     {"run.h5", "run/crack.h5", "history.csv"}},
    {"kirsch-track",
     "track",
     {"plate.nodes.h5", "run.h5", "run/crack.h5"},
     {"tips.csv", "branches.csv", "summary.csv"}},
    {"kirsch-plot",
     "title geometry",
     {"run.h5", "run/crack.h5", "tips.csv", "pores.txt"},
     {"pictures/damage.png"}},
};

static uint64_t hash_text(uint64_t hash, const char *text) {
    return kr_hash(hash, text, strlen(text) + 1);
}

/* Size and time of a file; a missing one is as good an answer. */
static uint64_t hash_path(uint64_t hash, const char *path) {
    struct stat state;
    int64_t what[3] = {-1, 0, 0};
    if (stat(path, &state) == 0) {
        what[0] = state.st_size;
        what[1] = state.st_mtim.tv_sec;
        what[2] = state.st_mtim.tv_nsec;
    }
    return kr_hash(hash, what, sizeof what);
}

static uint64_t hash_file(uint64_t hash, const struct kr_case *c, const char *name) {
    char *path = kr_case_file(c, name);
    hash = hash_path(hash, path);
    kr_free(path);
    return hash;
}

static void add_path(void *hash, const char *const *field, const char *path) {
    (void)field;
    *(uint64_t *)hash = hash_path(*(uint64_t *)hash, path);
}

static uint64_t stamp_of(const struct kr_job *job, const struct kr_step *step) {
    char *sections = kr_deck_resolved(job->deck, step->sections);
    uint64_t hash = hash_text(hash_text(KR_HASH_BEGIN, kr_version()), sections);
    if (step == &kr_steps[KR_STEP_NODES])
        kr_case_visit_files(job->deck, &job->c, KR_CASE_MESH, add_path, &hash);
    if (step == &kr_steps[KR_STEP_SOLVE])
        kr_case_visit_files(job->deck, &job->c, KR_CASE_MECHANICS, add_path, &hash);
    for (int k = 0; k < 4 && step->inputs[k]; k++)
        hash = hash_file(hash, &job->c, step->inputs[k]);
    if (step == &kr_steps[KR_STEP_PORES] || step == &kr_steps[KR_STEP_MESH])
        kr_case_visit_files(job->deck, &job->c, KR_CASE_GEOMETRY, add_path, &hash);
    kr_free(sections);
    return hash;
}

static char *stamp_path(const struct kr_job *job, const struct kr_step *step, const char *suffix) {
    char *name = kr_text(".steps/%s%s", step->program, suffix);
    char *path = kr_case_file(&job->c, name);
    kr_free(name);
    return path;
}

/* The stamp that was left; 0 if there is none. */
static uint64_t read_stamp(const struct kr_job *job, const struct kr_step *step, const char *suffix) {
    uint64_t stamp = 0;
    char *path = stamp_path(job, step, suffix);
    FILE *file = fopen(path, "r");
    if (file && fscanf(file, "%" SCNx64, &stamp) != 1)
        stamp = 0;
    if (file)
        fclose(file);
    kr_free(path);
    return stamp;
}

int kr_step_is_up_to_date(const struct kr_job *job, const struct kr_step *step) {
    int there = read_stamp(job, step, "") == stamp_of(job, step);
    for (int k = 0; k < 4 && step->outputs[k] && there; k++) {
        char *output = kr_case_file(&job->c, step->outputs[k]);
        there = access(output, R_OK) == 0;
        kr_free(output);
    }
    return there;
}

static void write_stamp(const struct kr_job *job, const struct kr_step *step, const char *suffix) {
    char *path = stamp_path(job, step, suffix);
    struct kr_file file = kr_file_begin(path);
    fprintf(file.to, "%016" PRIx64 "\n", stamp_of(job, step));
    kr_file_end(&file);
}

int kr_step_was_begun(const struct kr_job *job, const struct kr_step *step) {
    return read_stamp(job, step, ".begun") == stamp_of(job, step);
}

void kr_step_note_begun(const struct kr_job *job, const struct kr_step *step) {
    write_stamp(job, step, ".begun");
}

void kr_step_note_done(const struct kr_job *job, const struct kr_step *step) {
    write_stamp(job, step, "");
}
