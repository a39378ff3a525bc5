/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Checkpoints. The forces are not kept: they follow from displacements and living bonds. A seal
 * behind the data tells a damaged file from a good one before anything of it is believed; the one
 * before is then taken.
 */
#include "checkpoint.h"

#include "base/error.h"
#include "base/h5.h"
#include "base/memory.h"
#include "base/provenance.h"
#include "base/seal.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char FORMAT[] = "kirsch checkpoint";
enum { VERSION = 5 };

/* The arrays of doubles, one after the other, and their names. */
struct array {
    const char *name;
    double *data;
    size_t n;
};

enum { ARRAYS = 11 };

static size_t arrays_of(const struct kr_checkpoint *at, struct array array[ARRAYS]) {
    static const char *const u[] = {"/u_x", "/u_y", "/u_z"}, *const v[] = {"/v_x", "/v_y", "/v_z"},
                             *const rest[] = {"/rest_x", "/rest_y", "/rest_z"};
    size_t n = 0;
    for (int d = 0; d < at->body->dim; d++) {
        array[n++] = (struct array){u[d], at->body->u[d], at->body->n};
        array[n++] = (struct array){v[d], at->body->v[d], at->body->n};
        if (at->rest[d])
            array[n++] = (struct array){rest[d], at->rest[d], at->body->n};
    }
    array[n++] = (struct array){"/lost_volume", at->body->bonds->lost_volume, at->body->n};
    array[n++] = (struct array){"/damage_time", at->crack->damage_time, at->body->n};
    return n;
}

/* Living bonds as 32-bit words, a row a byte. */
static size_t words_of(const struct kr_bonds *bonds) {
    return (bonds->n_rows + 3) / 4;
}

/* What a checkpoint belongs to: the nodes as the bonds see them. */
static uint64_t nodes_hash(const struct kr_bonds *bonds) {
    uint64_t hash = KR_HASH_BEGIN;
    for (int d = 0; d < bonds->dim; d++)
        hash = kr_hash(hash, bonds->x[d], bonds->n * sizeof(double));
    hash = kr_hash(hash, bonds->volume, bonds->n * sizeof(double));
    return kr_hash(hash, bonds->factor, bonds->n * sizeof(double));
}

/* ---- writing ---- */

static void set_hash(struct kr_h5 *file, const char *name, uint64_t hash) {
    char text[32];
    snprintf(text, sizeof text, "%016" PRIx64, hash);
    kr_h5_set_text(file, "/", name, text);
}

static void write_living(struct kr_h5 *file, const struct kr_bonds *bonds) {
    size_t words = words_of(bonds);
    int32_t *word = KR_NEW(int32_t, words);
    memcpy(word, bonds->living, bonds->n_rows);
    kr_h5_write_int32(file, "/living", words, 0, word);
    kr_free(word);
}

static void write_all(struct kr_h5 *file, const struct kr_checkpoint *at) {
    struct array array[ARRAYS];
    size_t n = arrays_of(at, array);
    const struct kr_crack *crack = at->crack;
    kr_provenance_write(file, at->deck_text);
    kr_h5_set_int64(file, "/", "step", at->step);
    kr_h5_set_int64(file, "/", "steps", at->steps);
    kr_h5_set_int64(file, "/", "history", at->history);
    kr_h5_set_int64(file, "/", "sites", at->sites);
    kr_h5_set_int64(file, "/", "stage", (int64_t)at->stage);
    kr_h5_set_int64(file, "/", "round", at->round);
    kr_h5_set_int64(file, "/", "event", at->event);
    kr_h5_set_double(file, "/", "most_pull", at->most_pull);
    kr_h5_set_int64(file, "/", "steps_before", at->before);
    kr_h5_set_double(file, "/", "stage_began", at->began);
    kr_h5_set_double(file, "/", "stage_clock", at->clock);
    kr_h5_set_double(file, "/", "rest_clock", at->rest_clock);
    kr_h5_set_double(file, "/", "balance", at->ledger->balance);
    kr_h5_set_double(file, "/", "time_step", at->dt);
    kr_h5_set_double(file, "/", "external_work", at->ledger->external);
    kr_h5_set_double(file, "/", "most_external_work", at->ledger->most_external);
    kr_h5_set_double(file, "/", "power", at->ledger->power);
    kr_h5_set_double(file, "/", "fracture_work", crack->energy);
    set_hash(file, "nodes_hash", nodes_hash(at->body->bonds));
    for (size_t k = 0; k < n; k++)
        kr_h5_write_double(file, array[k].name, array[k].n, 0, array[k].data);
    write_living(file, at->body->bonds);
    kr_h5_write_int32(file, "/bond", crack->count, 2, crack->pair);
    kr_h5_write_double(file, "/bond_time", crack->count, 0, crack->time);
    kr_h5_write_double(file, "/bond_energy", crack->count, 0, crack->held);
}

void kr_checkpoint_write(const struct kr_case *c, const struct kr_checkpoint *at) {
    char *path = kr_case_file(c, "checkpoint.h5");
    char *before = kr_case_file(c, "checkpoint-before.h5");
    char *fresh = kr_case_file(c, "checkpoint-new.h5");
    struct kr_h5 *file = kr_h5_create(fresh, FORMAT, VERSION);
    write_all(file, at);
    kr_h5_close(file);
    kr_seal(fresh);
    if (access(path, F_OK) == 0 && rename(path, before))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be renamed: %s", path, strerror(errno));
    if (rename(fresh, path))
        kr_stop(KR_EXIT_STORAGE, "%s: cannot be renamed: %s", fresh, strerror(errno));
    kr_free(path);
    kr_free(before);
    kr_free(fresh);
}

/* ---- reading ---- */

/* Name the first line in which two resolved decks differ. */
static void refuse_deck(const char *path, const char *theirs, const char *ours) {
    while (*theirs && *ours) {
        size_t a = strcspn(theirs, "\n"), b = strcspn(ours, "\n");
        if (a != b || strncmp(theirs, ours, a))
            kr_stop(KR_EXIT_INPUT,
                    "%s was made by another deck: it has '%.*s', the deck has '%.*s'; undo the change, "
                    "or run without --resume",
                    path, (int)a, theirs, (int)b, ours);
        theirs += a + (theirs[a] == '\n');
        ours += b + (ours[b] == '\n');
    }
    if (*theirs || *ours)
        kr_stop(KR_EXIT_INPUT, "%s was made by a deck with other keys; run without --resume", path);
}

static void check_origin(const struct kr_h5 *file, const struct kr_checkpoint *at) {
    char found[32], *text = kr_h5_get_text(file, "/", "deck");
    refuse_deck(kr_h5_path(file), text, at->deck_text);
    kr_free(text);
    snprintf(found, sizeof found, "%016" PRIx64, nodes_hash(at->body->bonds));
    text = kr_h5_get_text(file, "/", "nodes_hash");
    if (strcmp(text, found))
        kr_stop(KR_EXIT_INPUT, "%s was made with other nodes than plate.nodes.h5 has now; run without "
                               "--resume", kr_h5_path(file));
    kr_free(text);
    if (kr_h5_get_int64(file, "/", "steps") != at->steps ||
        kr_h5_get_double(file, "/", "time_step") != at->dt)
        kr_stop(KR_EXIT_INPUT, "%s was made with another time step; run without --resume",
                kr_h5_path(file));
}

static void read_crack(const struct kr_h5 *file, struct kr_crack *crack) {
    size_t columns;
    kr_free(crack->pair);
    kr_free(crack->time);
    kr_free(crack->held);
    kr_h5_shape(file, "/bond_time", &crack->count, &columns);
    crack->room = crack->count;
    crack->pair = kr_h5_read_int32(file, "/bond", crack->count, 2);
    for (size_t k = 0; k < 2 * crack->count; k++)
        if (crack->pair[k] < 0 || (size_t)crack->pair[k] >= crack->n)
            kr_stop(KR_EXIT_INPUT, "%s, array '/bond': found node %d, expected 0 to %zu; run without --resume",
                    kr_h5_path(file), crack->pair[k], crack->n - 1);
    crack->time = kr_h5_read_double(file, "/bond_time", crack->count, 0);
    crack->held = kr_h5_read_double(file, "/bond_energy", crack->count, 0);
    crack->energy = kr_h5_get_double(file, "/", "fracture_work");
}

/* Bonds only ever break: one that lives now and was not there at the start leads to a node that may not exist. */
static void read_living(const struct kr_h5 *file, struct kr_bonds *bonds) {
    int32_t *word = kr_h5_read_int32(file, "/living", words_of(bonds), 0);
    const uint8_t *mask = (const uint8_t *)word;
    for (size_t row = 0; row < bonds->n_rows; row++)
        if (mask[row] & ~bonds->living[row])
            kr_stop(KR_EXIT_INPUT, "%s, array '/living': a bond lives that the body does not have; run without --resume",
                    kr_h5_path(file));
    memcpy(bonds->living, mask, bonds->n_rows);
    kr_bonds_find_twins(bonds);
    kr_free(word);
}

static void read_all(const struct kr_h5 *file, struct kr_checkpoint *at) {
    struct array array[ARRAYS];
    size_t n = arrays_of(at, array);
    for (size_t k = 0; k < n; k++) {
        double *data = kr_h5_read_double(file, array[k].name, array[k].n, 0);
        memcpy(array[k].data, data, array[k].n * sizeof *data);
        kr_free(data);
    }
    read_living(file, at->body->bonds);
    read_crack(file, at->crack);
    at->step = (long)kr_h5_get_int64(file, "/", "step");
    at->history = (long)kr_h5_get_int64(file, "/", "history");
    at->sites = (long)kr_h5_get_int64(file, "/", "sites");
    at->stage = (size_t)kr_h5_get_int64(file, "/", "stage");
    at->before = (long)kr_h5_get_int64(file, "/", "steps_before");
    at->most_pull = kr_h5_get_double(file, "/", "most_pull");
    at->event = (int)kr_h5_get_int64(file, "/", "event");
    at->round = (long)kr_h5_get_int64(file, "/", "round");
    at->began = kr_h5_get_double(file, "/", "stage_began");
    at->clock = kr_h5_get_double(file, "/", "stage_clock");
    at->rest_clock = kr_h5_get_double(file, "/", "rest_clock");
    at->ledger->balance = kr_h5_get_double(file, "/", "balance");
    at->ledger->external = kr_h5_get_double(file, "/", "external_work");
    at->ledger->most_external = kr_h5_get_double(file, "/", "most_external_work");
    at->ledger->power = kr_h5_get_double(file, "/", "power");
}

/* The newest one whose seal holds; owned by the caller. */
static char *find_whole(const struct kr_case *c) {
    static const char *const names[] = {"checkpoint.h5", "checkpoint-before.h5"};
    int damaged = 0;
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        char *path = kr_case_file(c, names[k]);
        if (access(path, F_OK) == 0) { /* the first is missing if killed between two renames */
            if (kr_seal_holds(path))
                return path;
            kr_warn("%s is damaged or cut short: its seal does not fit; looking for the one before",
                    path);
            damaged++;
        }
        kr_free(path);
    }
    if (damaged)
        kr_stop(KR_EXIT_STORAGE, "no checkpoint in %s is whole; run without --resume", c->folder);
    kr_stop(KR_EXIT_INPUT, "there is no checkpoint in %s; run without --resume", c->folder);
}

void kr_checkpoint_read(const struct kr_case *c, struct kr_checkpoint *at) {
    char *path = find_whole(c);
    struct kr_h5 *file = kr_h5_open(path, FORMAT, VERSION);
    check_origin(file, at);
    read_all(file, at);
    kr_h5_close(file);
    kr_free(path);
}

void kr_checkpoint_remove(const struct kr_case *c) {
    static const char *const names[] = {"checkpoint.h5", "checkpoint-before.h5",
                                        "checkpoint-new.h5"};
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        char *path = kr_case_file(c, names[k]);
        remove(path);
        kr_free(path);
    }
}
