/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Results. See output.h for how a killed run leaves nothing half written.
 */
#include "output.h"

#include "base/file.h"
#include "base/h5.h"
#include "base/memory.h"
#include "base/provenance.h"
#include "quantity.h"
#include "schedule.h"
#include "topology.h"
#include "wave.h"
#include "xdmf.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct kr_output {
    const struct kr_case *c;      /* not owned */
    const struct kr_nodes *nodes; /* not owned */
    char *deck_text;
    size_t corners; /* length of the topology */
    double *row;    /* (n x KR_TENSOR) room */
    size_t n_fields;
    int field[KR_QUANTITIES]; /* enum kr_quantity: those that are written, each once */
    int open;       /* outputs are not known beforehand */
    size_t n_due, room;
    struct kr_xdmf_step *due; /* all outputs of the run; `open`: those written */
};

/* ---- run.h5 ---- */

static void write_attributes(struct kr_h5 *file, const struct kr_case *c,
                             const struct kr_nodes *nodes, const struct kr_bonds *bonds,
                             double dt) {
    const struct kr_material *m = &bonds->material;
    struct kr_wave wave =
        kr_wave_speeds(m->youngs_modulus, m->poissons_ratio, m->density, (enum kr_model)m->model);
    kr_h5_set_int64(file, "/", "dim", nodes->dim);
    kr_h5_set_text(file, "/", "nodes_file", "plate.nodes.h5");
    kr_h5_set_int64(file, "/", "n", (int64_t)nodes->n);
    kr_h5_set_int64(file, "/", "bonds", (int64_t)(bonds->count / 2));
    kr_h5_set_double(file, "/", "time_step", dt);
    kr_h5_set_double(file, "/", "horizon", m->horizon);
    kr_h5_set_double(file, "/", "spacing", nodes->spacing);
    kr_h5_set_double(file, "/", "damage_threshold", c->damage_threshold);
    kr_h5_set_double(file, "/", "youngs_modulus", m->youngs_modulus);
    kr_h5_set_double(file, "/", "poissons_ratio", m->poissons_ratio);
    kr_h5_set_double(file, "/", "density", m->density);
    kr_h5_set_double(file, "/", "fracture_energy", m->fracture_energy);
    kr_h5_set_double(file, "/", "critical_stretch", m->critical_stretch);
    kr_h5_set_double(file, "/", "rayleigh_speed", wave.rayleigh);
    kr_h5_set_double(file, "/", "longitudinal_speed", wave.longitudinal);
}

static void write_mesh(struct kr_output *o, struct kr_h5 *file) {
    const struct kr_nodes *nodes = o->nodes;
    if (!nodes->n_points)
        return;
    int64_t *topology = kr_topology_make(nodes, &o->corners);
    kr_h5_write_double(file, "/mesh/point", nodes->n_points, (size_t)nodes->dim, nodes->point);
    kr_h5_write_int64(file, "/mesh/topology", o->corners, 0, topology);
    kr_free(topology);
}

static void write_links(const struct kr_output *o, struct kr_h5 *file, const char *group,
                        const char *folder) {
    for (size_t k = 0; k < o->n_due; k++) {
        char *name = kr_text("%s/%06ld", group, o->due[k].step);
        char *other = kr_text("%s%06ld.h5", folder, o->due[k].step);
        kr_h5_link(file, name, other);
        kr_free(name);
        kr_free(other);
    }
}

/* run/steps.h5: links to the outputs so far, for a run that could not tell them beforehand. */
static void write_steps(const struct kr_output *o) {
    char *path = kr_case_file(o->c, "run/steps.h5");
    struct kr_h5 *file = kr_h5_create(path, "kirsch steps", 1);
    write_links(o, file, "", "");
    kr_h5_close(file);
    kr_free(path);
}

static void write_run(struct kr_output *o, const struct kr_bonds *bonds, double dt) {
    const struct kr_nodes *nodes = o->nodes;
    char *path = kr_case_file(o->c, "run.h5");
    struct kr_h5 *file = kr_h5_create(path, "kirsch run", 1);
    kr_provenance_write(file, o->deck_text);
    write_attributes(file, o->c, nodes, bonds, dt);
    write_mesh(o, file);
    kr_h5_write_double(file, "/nodes/position", nodes->n, (size_t)nodes->dim, nodes->position);
    kr_h5_write_double(file, "/nodes/volume", nodes->n, 0, nodes->volume);
    kr_h5_link(file, "/crack", "run/crack.h5");
    if (o->open)
        kr_h5_link(file, "/step", "run/steps.h5");
    else
        write_links(o, file, "/step", "run/");
    kr_h5_close(file);
    kr_free(path);
}

/* ---- the folder of outputs ---- */

static void add_due(struct kr_output *o, long step, double t) {
    KR_GROW(o->due, o->n_due, o->room);
    o->due[o->n_due++] = (struct kr_xdmf_step){step, t};
}

static void find_due(struct kr_output *o, double dt, long steps) {
    const struct kr_schedule schedule = kr_schedule_of(o->c->output_every, &o->c->output_at);
    for (long step = 0; step <= steps; step++) {
        double t = (double)step * dt;
        if (step && step < steps && !kr_schedule_due(&schedule, t, dt))
            continue;
        add_due(o, step, t);
    }
}

/* Make the folder, and take out what an older run left there: *.h5 and nothing else. */
static void clear_folder(const struct kr_case *c, int keep) {
    char *folder = kr_case_file(c, "run");
    kr_folder_make_within(folder);
    DIR *listing = opendir(folder);
    struct dirent *entry;
    while (listing && !keep && (entry = readdir(listing))) {
        size_t length = strlen(entry->d_name);
        char *path = kr_text("%s/%s", folder, entry->d_name);
        if (length > 3 && !strcmp(entry->d_name + length - 3, ".h5"))
            remove(path);
        kr_free(path);
    }
    if (listing)
        closedir(listing);
    kr_free(folder);
}

/* What an `open` run had written before it was resumed; what came after its checkpoint comes again. */
static void find_written(struct kr_output *o, long done) {
    char *path = kr_case_file(o->c, "run/steps.h5");
    size_t count = 0;
    struct kr_h5 *file = access(path, R_OK) ? NULL : kr_h5_open(path, "kirsch steps", 1);
    char **name = file ? kr_h5_list(file, "/", &count) : NULL;
    for (size_t k = 0; k < count; k++) {
        long step = atol(name[k]);
        if (step < done)
            add_due(o, step, kr_h5_get_double(file, name[k], "time"));
        kr_free(name[k]);
    }
    kr_free(name);
    if (file)
        kr_h5_close(file);
    kr_free(path);
}

/* Those of the deck, in the order of the table. */
static void choose_fields(struct kr_output *o) {
    const char *const *word = o->c->fields.item;
    int chosen[KR_QUANTITIES] = {1, 1, 1, 1};
    for (int k = 0; k < KR_QUANTITIES && o->c->fields.given; k++)
        chosen[k] = 0;
    for (size_t k = 0; k < o->c->fields.count; k++)
        chosen[kr_case_quantity(word[k])] = 1;
    for (int k = 0; k < KR_QUANTITIES; k++)
        if (chosen[k])
            o->field[o->n_fields++] = k;
}

struct kr_output *kr_output_create(const struct kr_case *c, const struct kr_nodes *nodes,
                                   const struct kr_bonds *bonds, struct kr_output_plan plan,
                                   const char *deck_text) {
    struct kr_output *o = KR_NEW(struct kr_output, 1);
    *o = (struct kr_output){
        .c = c, .nodes = nodes, .deck_text = kr_text_copy(deck_text), .open = plan.open};
    o->row = KR_NEW(double, nodes->n * KR_TENSOR);
    choose_fields(o);
    if (!plan.open)
        find_due(o, plan.dt, plan.steps);
    clear_folder(c, plan.resumed);
    if (plan.open && plan.resumed)
        find_written(o, plan.done);
    write_run(o, bonds, plan.dt);
    return o;
}

void kr_output_free(struct kr_output *o) {
    kr_free(o->deck_text);
    kr_free(o->row);
    kr_free(o->due);
    kr_free(o);
}

int kr_output_due(const struct kr_output *o, long step) {
    for (size_t k = 0; k < o->n_due; k++)
        if (o->due[k].step == step)
            return 1;
    return 0;
}

/* ---- one output ---- */

/* Three components of a vector in 2D, too: ParaView warps by nothing less. */
static void write_field(struct kr_output *o, struct kr_h5 *file, int field, const struct kr_body *body,
                        double *const v[3]) {
    const size_t n = body->n, columns = (size_t)kr_quantities[field].components;
    const int packing = o->c->compression;
    char *name = kr_text("/%s", kr_quantities[field].name);
#pragma omp parallel for schedule(static)
    for (size_t slice = 0; slice < body->bonds->n_slices; slice++) {
        double value[KR_LANES][KR_TENSOR];
        kr_quantity_slice(field, body, v, slice, value);
        for (size_t i = slice * KR_LANES; i < n && i < (slice + 1) * KR_LANES; i++)
            for (size_t k = 0; k < columns; k++)
                o->row[columns * i + k] = value[i % KR_LANES][k];
    }
    /* Worth it for damage, which is mostly 0; vectors hardly shrink. */
    kr_h5_pack(file, packing == KR_COMPRESS_ALL || (packing == KR_COMPRESS_SCALARS && columns == 1));
    if (o->c->double_fields)
        kr_h5_write_double(file, name, n, columns > 1 ? columns : 0, o->row);
    else
        kr_h5_write_float(file, name, n, columns > 1 ? columns : 0, o->row);
    kr_free(name);
}

static void write_fields(struct kr_output *o, const struct kr_body *body,
                         const struct kr_ledger *ledger, long step, double t) {
    char *name = kr_text("run/%06ld.h5", step), *path = kr_case_file(o->c, name);
    struct kr_h5 *file = kr_h5_create(path, "kirsch output", 1);
    kr_h5_set_double(file, "/", "time", t);
    kr_h5_set_int64(file, "/", "step", step);
    for (size_t k = 0; k < o->n_fields; k++)
        write_field(o, file, o->field[k], body, ledger->v);
    kr_h5_close(file);
    kr_free(name);
    kr_free(path);
}

static void write_crack(const struct kr_output *o, const struct kr_ledger *ledger,
                        const struct kr_crack *crack, long step, int last) {
    char *path = kr_case_file(o->c, "run/crack.h5");
    struct kr_h5 *file = kr_h5_create(path, "kirsch crack", 1);
    kr_h5_set_int64(file, "/", "steps", step);
    kr_h5_set_int64(file, "/", "finished", last);
    kr_h5_set_double(file, "/", "external_work", ledger->external);
    kr_h5_set_double(file, "/", "kinetic_energy", ledger->kinetic);
    kr_h5_set_double(file, "/", "strain_energy", ledger->strain);
    kr_h5_set_double(file, "/", "fracture_work", ledger->fracture);
    kr_h5_write_double(file, "/Damage_Time", crack->n, 0, crack->damage_time);
    kr_h5_write_int32(file, "/bond", crack->count, 2, crack->pair);
    kr_h5_write_double(file, "/bond_time", crack->count, 0, crack->time);
    kr_h5_write_double(file, "/bond_energy", crack->count, 0, crack->held);
    kr_h5_close(file);
    kr_free(path);
}

static void write_xdmf(const struct kr_output *o, long step) {
    size_t written = 0;
    char *path = kr_case_file(o->c, "run.xdmf");
    while (written < o->n_due && o->due[written].step <= step)
        written++;
    if (o->nodes->n_points)
        kr_xdmf_write(path, o->nodes, o->corners, (struct kr_xdmf_fields){o->n_fields, o->field, o->c->double_fields},
                      written, o->due);
    kr_free(path);
}

void kr_output_write(struct kr_output *o, const struct kr_body *body,
                     const struct kr_ledger *ledger, const struct kr_crack *crack, long step,
                     double t, int last) {
    write_fields(o, body, ledger, step, t);
    if (o->open) {
        add_due(o, step, t);
        write_steps(o);
    }
    write_crack(o, ledger, crack, step, last);
    write_xdmf(o, step);
}
