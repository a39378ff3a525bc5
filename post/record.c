/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Read what a run left behind; see record.h.
 */
#include "record.h"

#include <math.h>
#include <stdio.h>

#include "base/error.h"
#include "base/h5.h"
#include "base/memory.h"

static double positive(const struct kr_h5 *file, const char *name) {
    double value = kr_h5_get_double(file, "/", name);
    if (!(value > 0) || isinf(value))
        kr_stop(KR_EXIT_INPUT, "%s: attribute `%s` is %g; expected a positive number",
                kr_h5_path(file), name, value);
    return value;
}

static void read_attributes(const struct kr_h5 *file, struct kr_record *record) {
    int64_t dim = kr_h5_get_int64(file, "/", "dim");
    if (dim != 2 && dim != 3)
        kr_stop(KR_EXIT_INPUT, "%s: attribute `dim` is %lld; expected 2 or 3", kr_h5_path(file),
                (long long)dim);
    record->dim = (int)dim;
    record->time_step = positive(file, "time_step");
    record->spacing = positive(file, "spacing");
    record->horizon = positive(file, "horizon");
    record->rayleigh_speed = positive(file, "rayleigh_speed");
    record->fracture_energy = kr_h5_get_double(file, "/", "fracture_energy");
    record->density = positive(file, "density");
    record->steps = kr_h5_get_int64(file, "/crack", "steps");
    record->finished = kr_h5_get_int64(file, "/crack", "finished") != 0;
    record->bonds = kr_h5_get_int64(file, "/", "bonds");
    record->external_work = kr_h5_get_double(file, "/crack", "external_work");
    record->kinetic_energy = kr_h5_get_double(file, "/crack", "kinetic_energy");
    record->strain_energy = kr_h5_get_double(file, "/crack", "strain_energy");
    record->fracture_work = kr_h5_get_double(file, "/crack", "fracture_work");
}

/** Places are finite; times are -1, within the run or infinite. */
static void check_nodes(const struct kr_h5 *file, const struct kr_record *record) {
    for (size_t i = 0; i < record->n; i++) {
        double t = record->damage_time[i];
        const double *x = record->position + (size_t)record->dim * i;
        int finite = isfinite(x[0]) && isfinite(x[1]) && isfinite(x[record->dim - 1]);
        if (!finite || !(t == -1 || t >= 0) || !(record->volume[i] > 0))
            kr_stop(KR_EXIT_INPUT,
                    "%s: node %zu at (%g, %g) m has the damage time %g s and the volume %g; "
                    "expected finite places, a time of -1, 0 or more, and a positive volume",
                    kr_h5_path(file), i, x[0], x[1], t, record->volume[i]);
    }
}

static void check_bonds(const struct kr_h5 *file, const struct kr_record *record) {
    for (size_t k = 0; k < record->broken; k++) {
        const int32_t *pair = record->bond + 2 * k;
        if (pair[0] < 0 || pair[1] < 0 || (size_t)pair[0] >= record->n ||
            (size_t)pair[1] >= record->n || !(record->bond_energy[k] >= 0) ||
            !isfinite(record->bond_energy[k]))
            kr_stop(KR_EXIT_INPUT,
                    "%s: broken bond %zu joins the nodes %d and %d of %zu with the energy %g; "
                    "expected nodes of the run and an energy of 0 or more",
                    kr_h5_path(file), k, pair[0], pair[1], record->n, record->bond_energy[k]);
    }
}

static void read_bonds(const struct kr_h5 *file, struct kr_record *record) {
    size_t columns;
    kr_h5_shape(file, "/crack/bond_time", &record->broken, &columns);
    record->bond_time = kr_h5_read_double(file, "/crack/bond_time", record->broken, 0);
    record->bond_energy = kr_h5_read_double(file, "/crack/bond_energy", record->broken, 0);
    record->bond = kr_h5_read_int32(file, "/crack/bond", record->broken, 2);
    record->first_break = INFINITY;
    for (size_t k = 0; k < record->broken; k++)
        record->first_break = fmin(record->first_break, record->bond_time[k]);
    check_bonds(file, record);
}

struct kr_record *kr_record_read(const char *path) {
    struct kr_h5 *file = kr_h5_open(path, "kirsch run", 1);
    struct kr_record *record = KR_NEW(struct kr_record, 1);
    size_t columns;
    read_attributes(file, record);
    kr_h5_shape(file, "/crack/Damage_Time", &record->n, &columns);
    record->damage_time = kr_h5_read_double(file, "/crack/Damage_Time", record->n, 0);
    record->position = kr_h5_read_double(file, "/nodes/position", record->n,
                                         (size_t)record->dim);
    record->volume = kr_h5_read_double(file, "/nodes/volume", record->n, 0);
    check_nodes(file, record);
    read_bonds(file, record);
    kr_h5_close(file);
    return record;
}

void kr_record_free(struct kr_record *record) {
    if (!record)
        return;
    kr_free(record->position);
    kr_free(record->volume);
    kr_free(record->damage_time);
    kr_free(record->rim);
    kr_free(record->bond);
    kr_free(record->bond_time);
    kr_free(record->bond_energy);
    kr_free(record);
}

/** The rim that a set stands for. Only boundaries have a measure. */
static int rim_of(const struct kr_h5 *file, const char *path, const char *name) {
    int hole = 0;
    if (!kr_h5_has_attribute(file, path, "measure") ||
        !(kr_h5_get_double(file, path, "measure") > 0))
        return KR_RIM_NONE;
    if (sscanf(name, "hole_%d", &hole) == 1 || sscanf(name, "void_%d", &hole) == 1)
        return hole > 0 ? hole : KR_RIM_NONE;
    return KR_RIM_BOUNDARY;
}

static void mark_set(const struct kr_h5 *file, const char *path, int rim,
                     struct kr_record *record) {
    size_t count, columns;
    int64_t *node;
    kr_h5_shape(file, path, &count, &columns);
    node = kr_h5_read_int64(file, path, count, 0);
    for (size_t k = 0; k < count; k++) {
        if (node[k] < 0 || (size_t)node[k] >= record->n)
            kr_stop(KR_EXIT_INPUT, "%s: %s names node %lld of %zu", kr_h5_path(file), path,
                    (long long)node[k], record->n);
        if (record->rim[node[k]] <= 0) /* a hole that cuts the boundary is met as a hole */
            record->rim[node[k]] = rim;
    }
    kr_free(node);
}

void kr_record_read_rims(struct kr_record *record, const char *path) {
    struct kr_h5 *file = kr_h5_open(path, "kirsch nodes", 1);
    size_t count, n, columns;
    char **name = kr_h5_list(file, "/sets", &count);
    kr_h5_shape(file, "/nodes/volume", &n, &columns);
    if (n != record->n)
        kr_stop(KR_EXIT_INPUT, "%s has %zu nodes, the run has %zu: they are not of one case", path,
                n, record->n);
    record->rim = KR_NEW(int, n);
    for (size_t k = 0; k < count; k++) {
        char *set = kr_text("/sets/%s", name[k]);
        int rim = rim_of(file, set, name[k]);
        if (rim != KR_RIM_NONE)
            mark_set(file, set, rim, record);
        kr_free(set);
        kr_free(name[k]);
    }
    kr_free(name);
    kr_h5_close(file);
}

int64_t kr_record_step(const struct kr_record *record, size_t node) {
    double time = record->damage_time[node];
    if (isinf(time))
        return -1;
    return time < 0 ? 0 : llround(time / record->time_step);
}
