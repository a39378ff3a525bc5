/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Sets of nodes by place (in a box, disc, half space, polygon, or within a distance of a named
 * boundary) and made of other sets. See convert.h.
 */
#include "convert.h"

#include "base/memory.h"
#include "boundary.h"
#include "vicinity.h"

#include <math.h>
#include <string.h>

/* A set while it is made: which nodes are in it. */
struct making {
    struct kr_deck *deck;
    const struct kr_mesh *mesh; /* NULL: the nodes came without one */
    const struct kr_nodes *nodes;
    const struct kr_case_set *set;
    unsigned char *in; /* (n) */
    double measure;
};

static int is_in_box(int dim, const double *x, const double *lower, const double *upper) {
    for (int d = 0; d < dim; d++)
        if (x[d] < lower[d] || x[d] > upper[d])
            return 0;
    return 1;
}

static int is_in_ball(int dim, const double *x, const double *centre, double radius) {
    double square = 0;
    for (int d = 0; d < dim; d++)
        square += (x[d] - centre[d]) * (x[d] - centre[d]);
    return square <= radius * radius;
}

static int is_beyond(int dim, const double *x, const double *through, const double *normal) {
    double along = 0;
    for (int d = 0; d < dim; d++)
        along += (x[d] - through[d]) * normal[d];
    return along >= 0;
}

/* An odd number of sides to the right of the place. */
static int is_in_polygon(const double *x, const struct kr_deck_list *points) {
    const double *corner = points->item;
    size_t n = points->count / 2;
    int in = 0;
    for (size_t k = 0; k < n; k++) {
        const double *p = corner + 2 * k, *q = corner + 2 * ((k + 1) % n);
        if ((p[1] <= x[1]) != (q[1] <= x[1]))
            in ^= p[0] + (x[1] - p[1]) / (q[1] - p[1]) * (q[0] - p[0]) > x[0];
    }
    return in;
}

static void mark_by_place(struct making *m) {
    const struct kr_case_set *s = m->set;
    int dim = m->nodes->dim, box = kr_deck_given(m->deck, s->lower);
    int ball = kr_deck_given(m->deck, s->centre), half = kr_deck_given(m->deck, s->through);
    for (size_t i = 0; i < m->nodes->n; i++) {
        const double *x = m->nodes->position + (size_t)dim * i;
        m->in[i] = box    ? (unsigned char)is_in_box(dim, x, s->lower, s->upper)
                   : ball ? (unsigned char)is_in_ball(dim, x, s->centre, s->radius)
                   : half ? (unsigned char)is_beyond(dim, x, s->through, s->normal)
                          : (unsigned char)is_in_polygon(x, &s->points);
    }
}

static void unknown_boundary(struct making *m) {
    const struct kr_mesh *mesh = m->mesh;
    const char **known = KR_NEW(const char *, mesh ? mesh->n_groups : 0);
    size_t n = 0;
    for (size_t g = 0; mesh && g < mesh->n_groups; g++)
        if (mesh->group[g].dim == mesh->dim - 1)
            known[n++] = mesh->group[g].name;
    kr_deck_fault_name(m->deck, &m->set->of, "boundary of the mesh", n, known);
    kr_free(known);
}

static void mark_near_boundary(struct making *m) {
    const struct kr_case_set *s = m->set;
    const struct kr_mesh_group *group =
        m->mesh ? kr_mesh_group(m->mesh, s->of, m->mesh->dim - 1) : NULL;
    if (!group) {
        unknown_boundary(m);
        return;
    }
    m->measure = kr_vicinity_mark(m->mesh, group, m->nodes, s->within, m->in);
}

/* ---- sets of sets ---- */

/* Count in how many of the named sets, from the first on, each node is. */
static int count_in(struct making *m, const struct kr_deck_list *names, size_t from, size_t to,
                    unsigned char *count) {
    const char *const *name = names->item;
    for (size_t k = from; k < to; k++) {
        const struct kr_set *of = kr_nodes_set(m->nodes, name[k]);
        if (!of) {
            kr_boundary_unknown_set(m->deck, &name[k], "set above this one", m->nodes);
            return 0;
        }
        for (size_t i = 0; i < of->count; i++)
            count[of->node[i]]++;
    }
    return 1;
}

static void mark_combined(struct making *m) {
    const struct kr_case_set *s = m->set;
    const struct kr_deck_list *names = s->join.given   ? &s->join
                                       : s->meet.given ? &s->meet
                                       : s->less.given ? &s->less
                                                       : &s->without;
    unsigned char *others = KR_NEW(unsigned char, m->nodes->n);
    if (names->count > UINT8_MAX || !names->count)
        kr_deck_fault(m->deck, names, "found %zu names, expected 1 to 255", names->count);
    else if (names != &s->less)
        count_in(m, names, 0, names->count, m->in);
    else if (count_in(m, names, 0, 1, m->in))
        count_in(m, names, 1, names->count, others);
    for (size_t i = 0; i < m->nodes->n; i++)
        m->in[i] = names == &s->join      ? m->in[i] > 0
                   : names == &s->meet    ? m->in[i] == names->count
                   : names == &s->less    ? m->in[i] && !others[i]
                                          : !m->in[i];
    kr_free(others);
}

/* ---- all sets ---- */

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
    struct making m = {deck, mesh, nodes, set, KR_NEW(unsigned char, nodes->n), 0};
    size_t count = 0, before = kr_deck_faults(deck);
    if (set->of)
        mark_near_boundary(&m);
    else if (set->join.given || set->meet.given || set->less.given || set->without.given)
        mark_combined(&m);
    else
        mark_by_place(&m);
    int64_t *node = KR_NEW(int64_t, nodes->n);
    for (size_t i = 0; i < nodes->n; i++)
        if (m.in[i])
            node[count++] = (int64_t)i;
    if (!count && kr_deck_faults(deck) == before)
        kr_deck_fault(deck, set, "set '%s' has no node in it; the spacing is %g m", set->name,
                      nodes->spacing);
    put_set(nodes, set->name, count, kr_realloc(node, count, sizeof *node), m.measure);
    kr_free(m.in);
}

void kr_convert_sets(struct kr_deck *deck, const struct kr_case *c, const struct kr_mesh *mesh,
                     struct kr_nodes *nodes) {
    const struct kr_case_set *set = c->sets.item;
    for (size_t k = 0; k < c->sets.count; k++)
        make_set(deck, &set[k], mesh, nodes);
}
