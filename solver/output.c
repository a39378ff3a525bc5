/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Results. The file is flushed after each output, and run.xdmf names only what was flushed, so that
 * a run that is killed leaves all it had written.
 */
#include "output.h"

#include "base/error.h"
#include "base/h5.h"
#include "base/memory.h"
#include "base/provenance.h"
#include "wave.h"
#include "xdmf.h"

struct kr_output {
    struct kr_h5 *file;
    char *xdmf_path;
    const struct kr_nodes *nodes; /* not owned */
    size_t corners;               /* length of the topology */
    double *row;                  /* (n x 3) room */
    size_t n_steps, room, n_broken;
    struct kr_xdmf_step *step;
};

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
    kr_h5_set_int64(file, "/", "steps", 0);
    kr_h5_set_int64(file, "/", "finished", 0);
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

/* The number in XDMF's mixed topology of a cell with so many vertices, and how many of them to name.
 * Solids are shown by their corners, which come first; nodes in the middle of their edges are not. */
static int64_t xdmf_of(int dim, int64_t vertices, int64_t *named) {
    static const struct {
        int64_t corners, with_middles, number;
    } solid[] = {{4, 10, 6}, {5, 13, 7}, {6, 15, 8}, {8, 20, 9}};
    *named = vertices;
    if (dim == 2)
        return vertices == 3 ? 4 : vertices == 4 ? 5 : 3;
    for (size_t k = 0; k < sizeof solid / sizeof *solid; k++)
        if (vertices == solid[k].corners || vertices == solid[k].with_middles) {
            *named = solid[k].corners;
            return solid[k].number;
        }
    kr_assert(!"a solid of so many vertices");
    return 0;
}

/* XDMF's mixed topology: for each cell its number (4 triangle, 5 quadrilateral, 6 tetrahedron, 7
 * pyramid, 8 wedge, 9 hexahedron, else 3, a polygon, and the number of its corners), then the
 * corners. */
static void write_mesh(struct kr_output *o) {
    const struct kr_nodes *nodes = o->nodes;
    if (!nodes->n_points)
        return;
    int64_t *topology = KR_NEW(int64_t, nodes->n * 2 + (size_t)nodes->first[nodes->n]);
    for (size_t i = 0; i < nodes->n; i++) {
        int64_t corners, from = nodes->first[i];
        int64_t number = xdmf_of(nodes->dim, nodes->first[i + 1] - from, &corners);
        topology[o->corners++] = number;
        if (number == 3)
            topology[o->corners++] = corners;
        for (int64_t k = from; k < from + corners; k++)
            topology[o->corners++] = nodes->vertex[k];
    }
    kr_h5_write_double(o->file, "/mesh/point", nodes->n_points, (size_t)nodes->dim, nodes->point);
    kr_h5_write_int64(o->file, "/mesh/topology", o->corners, 0, topology);
    kr_free(topology);
}

struct kr_output *kr_output_create(const struct kr_case *c, const struct kr_nodes *nodes,
                                   const struct kr_bonds *bonds, double dt,
                                   const char *deck_text) {
    struct kr_output *o = KR_NEW(struct kr_output, 1);
    char *path = kr_case_file(c, "run.h5");
    *o = (struct kr_output){.file = kr_h5_start(path, "kirsch run", 1), .nodes = nodes};
    o->xdmf_path = kr_case_file(c, "run.xdmf");
    o->row = KR_NEW(double, nodes->n * 3);
    kr_provenance_write(o->file, deck_text);
    write_attributes(o->file, c, nodes, bonds, dt);
    write_mesh(o);
    kr_h5_write_double(o->file, "/nodes/position", nodes->n, (size_t)nodes->dim, nodes->position);
    kr_h5_write_double(o->file, "/nodes/volume", nodes->n, 0, nodes->volume);
    kr_h5_extend_int32(o->file, "/crack/bond", 0, 2, NULL);
    kr_h5_extend_double(o->file, "/crack/bond_time", 0, 0, NULL);
    kr_h5_extend_double(o->file, "/crack/bond_energy", 0, 0, NULL);
    kr_h5_pack(o->file, 1);
    kr_h5_flush(o->file);
    kr_free(path);
    return o;
}

/* Three components in 2D, too: ParaView warps by nothing less, and packed zeros cost nothing. */
static void write_vectors(struct kr_output *o, const char *group, const char *name,
                          double *const from[3]) {
    char *path = kr_text("%s/%s", group, name);
    for (size_t i = 0; i < o->nodes->n; i++)
        for (size_t d = 0; d < 3; d++)
            o->row[3 * i + d] = (int)d < o->nodes->dim ? from[d][i] : 0;
    kr_h5_write_float(o->file, path, o->nodes->n, 3, o->row);
    kr_free(path);
}

static void write_fields(struct kr_output *o, const struct kr_body *body,
                         const struct kr_ledger *ledger, const char *group) {
    write_vectors(o, group, "Displacement", body->u);
    write_vectors(o, group, "Velocity", ledger->v);
    char *path = kr_text("%s/Damage", group);
    for (size_t i = 0; i < body->n; i++)
        o->row[i] = kr_bonds_damage(body->bonds, i);
    kr_h5_write_float(o->file, path, body->n, 0, o->row);
    kr_free(path);
    path = kr_text("%s/Stored_Elastic_Energy_Density", group);
    kr_h5_write_float(o->file, path, body->n, 0, body->energy);
    kr_free(path);
}

static void write_crack(struct kr_output *o, const struct kr_crack *crack) {
    size_t from = o->n_broken, more = crack->count - from;
    kr_h5_write_double(o->file, "/crack/Damage_Time", crack->n, 0, crack->damage_time);
    kr_h5_extend_int32(o->file, "/crack/bond", more, 2, crack->pair + 2 * from);
    kr_h5_extend_double(o->file, "/crack/bond_time", more, 0, crack->time + from);
    kr_h5_extend_double(o->file, "/crack/bond_energy", more, 0, crack->held + from);
    o->n_broken = crack->count;
}

void kr_output_write(struct kr_output *o, const struct kr_body *body,
                     const struct kr_ledger *ledger, const struct kr_crack *crack, long step,
                     double t) {
    char *group = kr_text("/step/%06ld", step);
    kr_h5_group(o->file, group);
    kr_h5_set_double(o->file, group, "time", t);
    kr_h5_set_int64(o->file, group, "step", step);
    write_fields(o, body, ledger, group);
    write_crack(o, crack);
    kr_h5_set_int64(o->file, "/", "steps", step);
    kr_h5_set_double(o->file, "/", "external_work", ledger->external);
    kr_h5_set_double(o->file, "/", "kinetic_energy", ledger->kinetic);
    kr_h5_set_double(o->file, "/", "strain_energy", ledger->strain);
    kr_h5_set_double(o->file, "/", "fracture_work", ledger->fracture);
    kr_h5_flush(o->file);
    KR_GROW(o->step, o->n_steps, o->room);
    o->step[o->n_steps++] = (struct kr_xdmf_step){step, t};
    if (o->nodes->n_points)
        kr_xdmf_write(o->xdmf_path, "run.h5", o->nodes, o->corners, o->n_steps, o->step);
    kr_free(group);
}

void kr_output_close(struct kr_output *o, long steps) {
    kr_h5_set_int64(o->file, "/", "steps", steps);
    kr_h5_set_int64(o->file, "/", "finished", 1);
    kr_h5_flush(o->file);
    kr_h5_close(o->file);
    kr_free(o->xdmf_path);
    kr_free(o->row);
    kr_free(o->step);
    kr_free(o);
}
