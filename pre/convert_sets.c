/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Sets of nodes by place: in a box, or within a distance of a named boundary.
 */
#include "convert.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

struct segment {
    double from[2], to[2];
};

/* A named boundary: its edges, its length and its bounding box. */
struct curve {
    size_t count;
    struct segment *edge;
    double length, lower[2], upper[2];
};

static struct curve curve_of(const struct kr_mesh *mesh, const struct kr_mesh_group *group) {
    struct curve c = {.count = group->count,
                      .edge = KR_NEW(struct segment, group->count),
                      .lower = {INFINITY, INFINITY},
                      .upper = {-INFINITY, -INFINITY}};
    for (size_t k = 0; k < group->count; k++) {
        const double *p = mesh->point + 3 * mesh->edge[2 * group->member[k]];
        const double *q = mesh->point + 3 * mesh->edge[2 * group->member[k] + 1];
        c.edge[k] = (struct segment){{p[0], p[1]}, {q[0], q[1]}};
        c.length += hypot(q[0] - p[0], q[1] - p[1]);
        for (int d = 0; d < 2; d++) {
            c.lower[d] = fmin(c.lower[d], fmin(p[d], q[d]));
            c.upper[d] = fmax(c.upper[d], fmax(p[d], q[d]));
        }
    }
    return c;
}

static double distance(const struct segment *s, const double *x) {
    double along[2] = {s->to[0] - s->from[0], s->to[1] - s->from[1]};
    double off[2] = {x[0] - s->from[0], x[1] - s->from[1]};
    double square = along[0] * along[0] + along[1] * along[1];
    double t = square > 0 ? (off[0] * along[0] + off[1] * along[1]) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(off[0] - t * along[0], off[1] - t * along[1]);
}

static int is_in_box(int dim, const double *x, const double *lower, const double *upper,
                     double margin) {
    for (int d = 0; d < dim; d++)
        if (x[d] < lower[d] - margin || x[d] > upper[d] + margin)
            return 0;
    return 1;
}

static int is_near(const struct curve *curve, const double *x, double within) {
    if (!is_in_box(2, x, curve->lower, curve->upper, within))
        return 0;
    for (size_t k = 0; k < curve->count; k++)
        if (distance(&curve->edge[k], x) <= within)
            return 1;
    return 0;
}

/* Takes the place of a set of the same name. */
static void put_set(struct kr_nodes *nodes, const char *name, size_t count, int64_t *node,
                    double measure) {
    for (size_t s = 0; s < nodes->n_sets; s++)
        if (!strcmp(nodes->set[s].name, name)) {
            kr_free(nodes->set[s].node);
            nodes->set[s].node = node;
            nodes->set[s].count = count;
            nodes->set[s].measure = measure;
            return;
        }
    kr_nodes_add_set(nodes, name, count, node, measure);
}

static void make_set(struct kr_deck *deck, const struct kr_case_set *set,
                     const struct kr_mesh *mesh, struct kr_nodes *nodes) {
    struct curve curve = {0};
    const struct kr_mesh_group *group = NULL;
    if (set->of) {
        group = mesh ? kr_mesh_group(mesh, set->of, 1) : NULL;
        if (!group) {
            kr_deck_fault(deck, &set->of, "the mesh has no boundary '%s'", set->of);
            return;
        }
        curve = curve_of(mesh, group);
    }
    int64_t *node = KR_NEW(int64_t, nodes->n);
    size_t count = 0;
    for (size_t i = 0; i < nodes->n; i++) {
        const double *x = nodes->position + (size_t)nodes->dim * i;
        if (group ? is_near(&curve, x, set->within)
                  : is_in_box(nodes->dim, x, set->lower, set->upper, 0))
            node[count++] = (int64_t)i;
    }
    if (!count)
        kr_deck_fault(deck, set, "set '%s' has no node in it; the spacing is %g m", set->name,
                      nodes->spacing);
    put_set(nodes, set->name, count, kr_realloc(node, count, sizeof *node), curve.length);
    kr_free(curve.edge);
}

void kr_convert_sets(struct kr_deck *deck, const struct kr_case *c, const struct kr_mesh *mesh,
                     struct kr_nodes *nodes) {
    const struct kr_case_set *set = c->sets.item;
    for (size_t k = 0; k < c->sets.count; k++)
        make_set(deck, &set[k], mesh, nodes);
}
