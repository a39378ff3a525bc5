/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Read a study from a table or from YAML, name its runs, and make their commands.
 */
#include "study.h"

#include <ctype.h>
#include <string.h>

#include "base/child.h"
#include "base/error.h"
#include "base/memory.h"
#include "csv.h"

enum { NAME_MOST = 200 }; /* letters; file systems allow 255 */

/* ---- from a table -------------------------------------------------------------------------- */

static void read_table(struct kr_study *study) {
    struct kr_csv *table = kr_csv_read(study->path);
    size_t named = kr_csv_column(table, "name");
    study->n_runs = table->n_rows;
    study->run = KR_NEW(struct kr_study_run, table->n_rows);
    study->key = KR_NEW(char *, table->n_columns);
    for (size_t k = 0; k < table->n_columns; k++)
        if (k != named)
            study->key[study->n_keys++] = kr_text_copy(table->name[k]);
    for (size_t r = 0; r < study->n_runs; r++) {
        struct kr_study_run *run = &study->run[r];
        size_t n = 0;
        run->value = KR_NEW(char *, study->n_keys);
        for (size_t k = 0; k < table->n_columns; k++) {
            const char *cell = kr_csv_cell(table, r, k);
            if (k == named)
                run->name = *cell ? kr_text_copy(cell) : NULL;
            else
                run->value[n++] = kr_text_copy(cell);
        }
    }
    kr_csv_free(table);
}

/* ---- from YAML ----------------------------------------------------------------------------- */

struct vary {
    const char *key;
    struct kr_deck_list values; /* const char * */
};

struct study_deck {
    const char *deck, *output;
    struct kr_deck_list vary; /* struct vary */
};

#define PLACE(type, field) .offset = offsetof(struct type, field)

static const struct kr_deck_key vary_keys[] = {
    {.name = "key", .type = KR_DECK_TEXT, PLACE(vary, key), .text = "A key of the deck."},
    {.name = "values", .type = KR_DECK_TEXTS, PLACE(vary, values), .text = "What it takes."},
    {.name = NULL}};

static const struct kr_deck_key study_keys[] = {
    {.name = "deck", .type = KR_DECK_TEXT, PLACE(study_deck, deck),
     .text = "The deck that all runs begin with, from the folder of this file."},
    {.name = "output", .type = KR_DECK_TEXT, PLACE(study_deck, output), .fallback = "",
     .text = "Folder of all runs."},
    {.name = "vary", .type = KR_DECK_LIST, PLACE(study_deck, vary), .keys = vary_keys,
     .item_size = sizeof(struct vary), .text = "Keys and their values: all combinations are run."},
    {.name = NULL}};

/* Number of combinations; faults are collected. */
static size_t count_runs(struct kr_deck *file, const struct study_deck *in) {
    const struct vary *vary = in->vary.item;
    size_t count = 1;
    if (!in->vary.count)
        kr_deck_fault(file, &in->vary, "expected at least one key to vary");
    for (size_t k = 0; k < in->vary.count; k++) {
        if (!vary[k].values.count)
            kr_deck_fault(file, &vary[k].values, "expected at least one value");
        if (__builtin_mul_overflow(count, vary[k].values.count, &count) || count > 1000000)
            kr_deck_fault(file, &in->vary, "these are more than a million runs");
    }
    return count;
}

/* Run r takes the values as the hands of a clock, the last key the fastest. */
static void combine(struct kr_study *study, const struct study_deck *in) {
    const struct vary *vary = in->vary.item;
    for (size_t r = 0; r < study->n_runs; r++) {
        char **value = study->run[r].value = KR_NEW(char *, study->n_keys);
        size_t rest = r;
        for (size_t k = study->n_keys; k-- > 0; rest /= vary[k].values.count)
            value[k] = kr_text_copy(
                ((const char *const *)vary[k].values.item)[rest % vary[k].values.count]);
    }
}

static void read_yaml(struct kr_study *study) {
    struct kr_deck *file = kr_deck_open(study->path, NULL, 0, NULL);
    struct study_deck in = {0};
    kr_deck_read(file, study_keys, &in);
    size_t count = count_runs(file, &in);
    kr_deck_finish(file);
    study->deck = *in.deck == '/' ? kr_text_copy(in.deck)
                                  : kr_text("%s/%s", kr_deck_folder(file), in.deck);
    if (in.output && *in.output && !study->folder)
        study->folder = kr_text_copy(in.output);
    study->n_keys = in.vary.count;
    study->key = KR_NEW(char *, study->n_keys);
    for (size_t k = 0; k < study->n_keys; k++)
        study->key[k] = kr_text_copy(((const struct vary *)in.vary.item)[k].key);
    study->n_runs = count;
    study->run = KR_NEW(struct kr_study_run, count);
    combine(study, &in);
    kr_deck_close(file);
}

/* ---- names --------------------------------------------------------------------------------- */

static int is_plain(char c) {
    return isalnum((unsigned char)c) || c == '.' || c == '+' || c == '_';
}

/* Put a text behind a name: blanks go, other marks become one dash. */
static void put_plain(char *name, const char *text) {
    size_t n = strlen(name);
    for (; *text && n < NAME_MOST; text++) {
        if (is_plain(*text))
            name[n++] = *text;
        else if (*text == '-' || (!isspace((unsigned char)*text) && n && name[n - 1] != '-'))
            name[n++] = '-';
    }
    while (n && name[n - 1] == '-')
        n--;
    name[n] = 0;
}

/* The last part of a key, or all of it where another key ends alike. */
static const char *short_key(const struct kr_study *study, size_t k) {
    const char *dot = strrchr(study->key[k], '.'), *end = dot ? dot + 1 : study->key[k];
    for (size_t other = 0; other < study->n_keys; other++) {
        const char *its = strrchr(study->key[other], '.');
        if (other != k && !strcmp(its ? its + 1 : study->key[other], end))
            return study->key[k];
    }
    return end;
}

static char *name_of(const struct kr_study *study, const struct kr_study_run *run) {
    char name[NAME_MOST + 8] = "";
    for (size_t k = 0; k < study->n_keys; k++) {
        if (!*run->value[k])
            continue;
        if (*name)
            strcat(name, "_");
        put_plain(name, short_key(study, k));
        if (strlen(name) < NAME_MOST)
            strcat(name, "-");
        put_plain(name, run->value[k]);
    }
    return kr_text_copy(*name ? name : "as-the-deck");
}

static void check_name(const struct kr_study *study, size_t r) {
    const char *name = study->run[r].name;
    int plain = *name != '.' && strlen(name) <= NAME_MOST;
    for (const char *c = name; *c && plain; c++)
        plain = is_plain(*c) || *c == '-';
    if (!plain)
        kr_stop(KR_EXIT_INPUT,
                "%s: run %zu is named '%s'; expected up to %d letters, digits and . + - _, for a "
                "folder gets this name",
                study->path, r + 1, name, NAME_MOST);
    for (size_t other = 0; other < r; other++)
        if (!strcmp(study->run[other].name, name))
            kr_stop(KR_EXIT_INPUT,
                    "%s: runs %zu and %zu are both named '%s'; take one out, or tell them apart in "
                    "a column `name`",
                    study->path, other + 1, r + 1, name);
}

static void check_keys(const struct kr_study *study) {
    for (size_t k = 0; k < study->n_keys; k++) {
        const char *key = study->key[k];
        if (!*key || !strcmp(key, "output.folder"))
            kr_stop(KR_EXIT_INPUT, "%s: column %zu is '%s'; expected a key of the deck other than "
                                   "output.folder, for each run gets a folder of its own",
                    study->path, k + 1, key);
        for (size_t other = 0; other < k; other++)
            if (!strcmp(study->key[other], key))
                kr_stop(KR_EXIT_INPUT, "%s: the key '%s' stands there twice", study->path, key);
    }
    if (!study->n_runs)
        kr_stop(KR_EXIT_INPUT, "%s has no runs; expected a line for each behind the header",
                study->path);
}

static void name_runs(struct kr_study *study) {
    for (size_t r = 0; r < study->n_runs; r++) {
        struct kr_study_run *run = &study->run[r];
        if (!run->name)
            run->name = name_of(study, run);
        check_name(study, r);
        run->folder = kr_text("%s/%s", study->folder, run->name);
    }
}

/* ---- as a whole ---------------------------------------------------------------------------- */

/* "out/" and the name of the folder of the table, as a case has it; of the table where it lies in
   the present folder. */
static char *default_folder(const char *path) {
    const char *end = strrchr(path, '/'), *begin = end;
    if (!end || end == path) {
        const char *base = end ? end + 1 : path, *dot = strrchr(base, '.');
        return kr_text("out/%.*s", (int)(dot ? dot - base : (long)strlen(base)), base);
    }
    while (begin > path && begin[-1] != '/')
        begin--;
    return kr_text("out/%.*s", (int)(end - begin), begin);
}

struct kr_study *kr_study_open(const struct kr_case_arguments *arguments, const char *table) {
    struct kr_study *study = KR_NEW(struct kr_study, 1);
    study->path = kr_text_copy(table ? table : arguments->deck);
    study->variant = arguments->variant;
    study->n_set = arguments->n_set;
    study->set = arguments->set;
    if (arguments->folder)
        study->folder = kr_text_copy(arguments->folder);
    if (table) {
        study->deck = kr_text_copy(arguments->deck);
        read_table(study);
    } else {
        read_yaml(study);
    }
    if (!study->folder)
        study->folder = default_folder(study->path);
    check_keys(study);
    name_runs(study);
    return study;
}

void kr_study_free(struct kr_study *study) {
    for (size_t r = 0; r < study->n_runs; r++) {
        struct kr_study_run *run = &study->run[r];
        for (size_t k = 0; k < study->n_keys; k++)
            kr_free(run->value[k]);
        kr_free(run->value);
        kr_free(run->name);
        kr_free(run->folder);
        kr_free(run->fault);
    }
    for (size_t k = 0; k < study->n_keys; k++)
        kr_free(study->key[k]);
    kr_free(study->key);
    kr_free(study->run);
    kr_free(study->path);
    kr_free(study->deck);
    kr_free(study->folder);
    kr_free(study);
}

char **kr_study_command(const struct kr_study *study, const struct kr_study_run *run) {
    size_t n = 0, most = 8 + 2 * (study->n_set + study->n_keys);
    char **word = KR_NEW(char *, most);
    word[n++] = kr_child_beside("kirsch");
    word[n++] = kr_text_copy(study->deck);
    if (study->variant) {
        word[n++] = kr_text_copy("--variant");
        word[n++] = kr_text_copy(study->variant);
    }
    for (size_t k = 0; k < study->n_set; k++) {
        word[n++] = kr_text_copy("--set");
        word[n++] = kr_text_copy(study->set[k]);
    }
    for (size_t k = 0; k < study->n_keys; k++)
        if (*run->value[k]) {
            word[n++] = kr_text_copy("--set");
            word[n++] = kr_text("%s=%s", study->key[k], run->value[k]);
        }
    word[n++] = kr_text_copy("--output");
    word[n++] = kr_text_copy(run->folder);
    kr_assert(n < most);
    return word;
}

void kr_study_command_free(char **command) {
    for (size_t k = 0; command[k]; k++)
        kr_free(command[k]);
    kr_free(command);
}
