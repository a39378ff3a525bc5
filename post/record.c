/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Read what a run left behind; see record.h.
 */
#include "record.h"

#include <math.h>

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
    if (dim != 2)
        kr_stop(KR_EXIT_INPUT, "%s has %lld dimensions; cracks are tracked in 2", kr_h5_path(file),
                (long long)dim);
    record->time_step = positive(file, "time_step");
    record->spacing = positive(file, "spacing");
    record->horizon = positive(file, "horizon");
    record->rayleigh_speed = positive(file, "rayleigh_speed");
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
        const double *x = record->position + 2 * i;
        if (!isfinite(x[0]) || !isfinite(x[1]) || !(t == -1 || t >= 0))
            kr_stop(KR_EXIT_INPUT,
                    "%s: node %zu at (%g, %g) m has the damage time %g s; expected finite places "
                    "and a time of -1, 0 or more",
                    kr_h5_path(file), i, x[0], x[1], t);
    }
}

static void read_bonds(const struct kr_h5 *file, struct kr_record *record) {
    size_t columns;
    double *time;
    kr_h5_shape(file, "/crack/bond_time", &record->broken, &columns);
    time = kr_h5_read_double(file, "/crack/bond_time", record->broken, 0);
    record->first_break = INFINITY;
    for (size_t k = 0; k < record->broken; k++)
        record->first_break = fmin(record->first_break, time[k]);
    kr_free(time);
}

struct kr_record *kr_record_read(const char *path) {
    struct kr_h5 *file = kr_h5_open(path, "kirsch run", 1);
    struct kr_record *record = KR_NEW(struct kr_record, 1);
    size_t columns;
    read_attributes(file, record);
    kr_h5_shape(file, "/crack/Damage_Time", &record->n, &columns);
    record->damage_time = kr_h5_read_double(file, "/crack/Damage_Time", record->n, 0);
    record->position = kr_h5_read_double(file, "/nodes/position", record->n, 2);
    check_nodes(file, record);
    read_bonds(file, record);
    kr_h5_close(file);
    return record;
}

void kr_record_free(struct kr_record *record) {
    if (!record)
        return;
    kr_free(record->position);
    kr_free(record->damage_time);
    kr_free(record);
}

int64_t kr_record_step(const struct kr_record *record, size_t node) {
    double time = record->damage_time[node];
    if (isinf(time))
        return -1;
    return time < 0 ? 0 : llround(time / record->time_step);
}
