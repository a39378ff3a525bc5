/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Forces and energies of a body: the fast loop in blocks of slices, one a thread, the exact loop
 * where it is flagged, and what follows from bonds that broke.
 */
#include "body.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* As kr_bonds_padded, of float or int32_t. */
static void *padded(size_t n) {
    return KR_NEW(float, n + 2 * KR_PAIR + KR_LANES) + KR_PAIR;
}

static void free_padded(void *array) {
    kr_free((float *)array - KR_PAIR);
}

static void free_rounded(struct kr_body *body) {
    struct kr_rounded *rounded = body->rounded;
    if (!rounded)
        return;
    for (int d = 0; d < body->dim; d++) {
        free_padded(rounded->high[d]);
        free_padded(rounded->low[d]);
        free_padded(rounded->place[d]);
    }
    free_padded(rounded->factor);
    free_padded(rounded->volume);
    kr_free(rounded);
}

struct kr_body *kr_body_create(struct kr_bonds *bonds) {
    struct kr_body *body = KR_NEW(struct kr_body, 1);
    *body = (struct kr_body){
        .bonds = bonds, .kernel = kr_kernel_best(), .dim = bonds->dim, .n = bonds->n};
    for (int d = 0; d < body->dim; d++) {
        body->u[d] = kr_bonds_padded(body->n);
        body->v[d] = kr_bonds_padded(body->n);
        body->force[d] = kr_bonds_padded(body->n);
    }
    body->energy = kr_bonds_padded(body->n);
    body->flag = KR_NEW(unsigned char, bonds->n_slices);
    body->by_block = KR_NEW(struct kr_broken_list, (size_t)bonds->n_blocks);
    return body;
}

void kr_body_free(struct kr_body *body) {
    for (int d = 0; d < body->dim; d++) {
        kr_bonds_padded_free(body->u[d]);
        kr_bonds_padded_free(body->v[d]);
        kr_bonds_padded_free(body->force[d]);
    }
    kr_bonds_padded_free(body->energy);
    free_rounded(body);
    kr_free(body->flag);
    for (int k = 0; k < body->bonds->n_blocks; k++)
        kr_free(body->by_block[k].item);
    kr_free(body->by_block);
    kr_free(body->broken.item);
    kr_free(body);
}

void kr_body_mix(struct kr_body *body) {
    const struct kr_bonds *b = body->bonds;
    body->kernel = kr_kernel_mixed();
    struct kr_rounded *rounded = body->rounded = KR_NEW(struct kr_rounded, 1);
    rounded->unit = ldexp(b->material.horizon, -30);
    for (int d = 0; d < body->dim; d++) {
        rounded->high[d] = padded(body->n);
        rounded->low[d] = padded(body->n);
        rounded->place[d] = padded(body->n);
        for (size_t i = 0; i < body->n; i++)
            rounded->place[d][i] = (int32_t)(uint32_t)llround(b->x[d][i] / rounded->unit);
    }
    rounded->factor = padded(body->n);
    rounded->volume = padded(body->n);
    for (size_t i = 0; i < body->n; i++) {
        rounded->factor[i] = (float)b->factor[i];
        rounded->volume[i] = (float)b->volume[i];
    }
}

/* Bring `rounded` up to date where u may have been changed by anyone since the last time. */
static void round_displacements(struct kr_body *body) {
    struct kr_rounded *rounded = body->rounded;
    if (!rounded)
        return;
    for (int d = 0; d < body->dim && !rounded->current; d++) {
        const double *restrict u = body->u[d];
        float *restrict high = rounded->high[d], *restrict low = rounded->low[d];
#pragma omp parallel for simd schedule(static)
        for (size_t i = 0; i < body->n; i++) {
            high[i] = (float)u[i];
            low[i] = (float)(u[i] - (double)high[i]);
        }
    }
    rounded->current = 0;
}

static struct kr_kernel_work work_of(struct kr_body *body) {
    struct kr_kernel_work work = {.bonds = body->bonds,
                                  .rounded = body->rounded,
                                  .energy = body->energy,
                                  .flag = body->flag};
    round_displacements(body);
    for (int d = 0; d < body->dim; d++) {
        work.u[d] = body->u[d];
        work.force[d] = body->force[d];
    }
    return work;
}

static void force_of_block(struct kr_body *body, const struct kr_kernel_work *work, int block,
                           int may_break) {
    struct kr_bonds *b = body->bonds;
    struct kr_broken_list *list = &body->by_block[block];
    list->count = 0;
    body->kernel->force(work, b->block[block], b->block[block + 1]);
    for (size_t slice = b->block[block]; slice < b->block[block + 1]; slice++) {
        if (!body->flag[slice])
            continue;
        kr_exact_force(work, slice);
        if (may_break)
            kr_exact_break(b, work, slice, list);
    }
}

/* By the lower, then the higher node; of the two ends of a pair that of the lower node first. */
static int by_pair(const void *p, const void *q) {
    const struct kr_broken *a = p, *b = q;
    int a_low = a->i < a->j ? a->i : a->j, b_low = b->i < b->j ? b->i : b->j;
    int a_high = a->i + a->j - a_low, b_high = b->i + b->j - b_low;
    if (a_low != b_low)
        return a_low < b_low ? -1 : 1;
    return a_high != b_high ? (a_high < b_high ? -1 : 1) : (a->i > b->i) - (a->i < b->i);
}

/* Bring the ends found by all blocks into one list, in order. Each counts in the damage of its own
 * node, with the weight seen from there (hhb-one-sided has two). */
static void gather_broken(struct kr_body *body) {
    struct kr_broken_list *all = &body->broken;
    struct kr_bonds *b = body->bonds;
    all->count = 0;
    for (int k = 0; k < b->n_blocks; k++)
        for (size_t m = 0; m < body->by_block[k].count; m++) {
            const struct kr_broken *one = &body->by_block[k].item[m];
            b->lost_volume[one->i] += one->weight * b->volume[one->j];
            KR_GROW(all->item, all->count, all->room);
            all->item[all->count++] = *one;
        }
    if (all->count)
        qsort(all->item, all->count, sizeof *all->item, by_pair);
}

/* Break the other end of a bond, too, where rounding let only one end see it, or where only one end
 * is bonded at all (hhb-one-sided). */
static void break_other_end(struct kr_bonds *b, struct kr_broken *one) {
    double weight = kr_bonds_clear(b, (size_t)one->j, (size_t)one->i);
    b->lost_volume[one->j] += weight * b->volume[one->i];
    one->energy += one->energy * weight / one->weight;
}

/* Make one entry a pair of what was found at both ends. */
static void settle_broken(struct kr_body *body) {
    struct kr_broken *item = body->broken.item;
    size_t kept = 0, count = body->broken.count;
    for (size_t k = 0; k < count; k++) {
        struct kr_broken one = item[k];
        if (k + 1 < count && item[k + 1].i == one.j && item[k + 1].j == one.i)
            one.energy += item[++k].energy;
        else
            break_other_end(body->bonds, &one);
        if (one.i > one.j)
            one = (struct kr_broken){one.j, one.i, one.weight, one.energy};
        item[kept++] = one;
    }
    body->broken.count = kept;
}

void kr_body_force(struct kr_body *body, int may_break) {
    const struct kr_kernel_work work = work_of(body);
#pragma omp parallel for schedule(static, 1)
    for (int block = 0; block < body->bonds->n_blocks; block++)
        force_of_block(body, &work, block, may_break);
    if (may_break) {
        gather_broken(body);
        settle_broken(body);
    }
}

static double energy_of_node(const void *context, size_t i) {
    const struct kr_body *body = context;
    return body->energy[i] * body->bonds->volume[i];
}

double kr_body_energy(struct kr_body *body) {
    const struct kr_bonds *b = body->bonds;
    const struct kr_kernel_work work = work_of(body);
#pragma omp parallel for schedule(static, 1)
    for (int block = 0; block < b->n_blocks; block++) {
        body->kernel->energy(&work, b->block[block], b->block[block + 1]);
        for (size_t slice = b->block[block]; slice < b->block[block + 1]; slice++)
            if (body->flag[slice])
                kr_exact_energy(&work, slice);
    }
    return kr_body_sum(body->n, energy_of_node, body);
}

void kr_body_product(struct kr_body *body, double *const v[], double *const product[]) {
    const struct kr_bonds *b = body->bonds;
    struct kr_kernel_work work = work_of(body);
    for (int d = 0; d < body->dim; d++) {
        work.v[d] = v[d];
        work.product[d] = product[d];
    }
#pragma omp parallel for schedule(static, 1)
    for (int block = 0; block < b->n_blocks; block++) {
        body->kernel->product(&work, b->block[block], b->block[block + 1]);
        for (size_t slice = b->block[block]; slice < b->block[block + 1]; slice++)
            if (body->flag[slice])
                kr_exact_product(&work, slice);
    }
}

/* As kr_body_advance, and the rounding of what is at hand: a pass over the nodes is spared. */
static void advance_and_round(struct kr_body *body, double push, double drift) {
    for (int d = 0; d < body->dim; d++) {
        double *restrict u = body->u[d], *restrict v = body->v[d];
        const double *restrict force = body->force[d];
        float *restrict high = body->rounded->high[d], *restrict low = body->rounded->low[d];
#pragma omp parallel for simd schedule(static)
        for (size_t i = 0; i < body->n; i++) {
            v[i] += push * force[i];
            u[i] += drift * v[i];
            high[i] = (float)u[i];
            low[i] = (float)(u[i] - (double)high[i]);
        }
    }
    body->rounded->current = 1;
}

void kr_body_advance(struct kr_body *body, double kick, double drift) {
    const double push = kick / body->bonds->material.density;
    if (body->rounded) {
        advance_and_round(body, push, drift);
        return;
    }
    for (int d = 0; d < body->dim; d++) {
        double *restrict u = body->u[d], *restrict v = body->v[d];
        const double *restrict force = body->force[d];
#pragma omp parallel for simd schedule(static)
        for (size_t i = 0; i < body->n; i++) {
            v[i] += push * force[i];
            u[i] += drift * v[i];
        }
    }
}

void kr_body_damp(struct kr_body *body, double damping) {
    const double pull = damping * body->bonds->material.density;
    for (int d = 0; d < body->dim; d++) {
        double *restrict force = body->force[d];
        const double *restrict v = body->v[d];
#pragma omp parallel for simd schedule(static)
        for (size_t i = 0; i < body->n; i++)
            force[i] -= pull * v[i];
    }
}

int kr_body_overstretched(const struct kr_body *body) {
    const struct kr_bonds *b = body->bonds;
    const double *const u[3] = {body->u[0], body->u[1], body->u[2]};
    struct kr_bond bond;
    for (size_t slice = 0; slice < b->n_slices; slice++) {
        if (!body->flag[slice])
            continue;
        struct kr_bond_walk walk = kr_bonds_walk(b, slice);
        while (kr_bonds_next(b, &walk, &bond))
            if (kr_exact_stretch(b, &bond, u) > b->material.critical_stretch &&
                !b->no_fail[bond.i] && !b->no_fail[bond.j])
                return 1;
    }
    return 0;
}

double kr_body_sum(size_t n, double (*term)(const void *context, size_t i), const void *context) {
    enum { CHUNK = 4096 };
    size_t chunks = (n + CHUNK - 1) / CHUNK;
    double *part = KR_NEW(double, chunks), total = 0;
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < chunks; k++) {
        size_t end = (k + 1) * CHUNK < n ? (k + 1) * CHUNK : n;
        for (size_t i = k * CHUNK; i < end; i++)
            part[k] += term(context, i);
    }
    for (size_t k = 0; k < chunks; k++)
        total += part[k];
    kr_free(part);
    return total;
}
