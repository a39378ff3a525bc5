/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The record of fracture. See crack.h.
 */
#include "crack.h"

#include "base/memory.h"

#include <math.h>

struct kr_crack *kr_crack_create(const struct kr_bonds *bonds, double threshold) {
    struct kr_crack *crack = KR_NEW(struct kr_crack, 1);
    *crack = (struct kr_crack){.n = bonds->n, .threshold = threshold};
    crack->damage_time = KR_NEW(double, bonds->n);
    for (size_t i = 0; i < bonds->n; i++)
        crack->damage_time[i] = kr_bonds_damage(bonds, i) > threshold ? -1 : INFINITY;
    return crack;
}

void kr_crack_free(struct kr_crack *crack) {
    kr_free(crack->damage_time);
    kr_free(crack->pair);
    kr_free(crack->time);
    kr_free(crack->held);
    kr_free(crack);
}

static void make_room(struct kr_crack *crack, size_t more) {
    if (crack->count + more <= crack->room)
        return;
    crack->room = 2 * (crack->count + more);
    crack->pair = kr_realloc(crack->pair, 2 * crack->room, sizeof *crack->pair);
    crack->time = kr_realloc(crack->time, crack->room, sizeof *crack->time);
    crack->held = kr_realloc(crack->held, crack->room, sizeof *crack->held);
}

static void note_damage(struct kr_crack *crack, const struct kr_bonds *bonds, int i, double t) {
    if (isinf(crack->damage_time[i]) && kr_bonds_damage(bonds, (size_t)i) > crack->threshold)
        crack->damage_time[i] = t;
}

void kr_crack_record(struct kr_crack *crack, const struct kr_body *body, double t) {
    make_room(crack, body->broken.count);
    for (size_t k = 0; k < body->broken.count; k++) {
        const struct kr_broken *one = &body->broken.item[k];
        crack->pair[2 * crack->count] = one->i;
        crack->pair[2 * crack->count + 1] = one->j;
        crack->time[crack->count] = t;
        crack->held[crack->count++] = one->energy;
        crack->energy += one->energy;
        note_damage(crack, body->bonds, one->i, t);
        note_damage(crack, body->bonds, one->j, t);
    }
}
