/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The skeleton of the damage; the steps stand in chains.h.
 */
#include "chains.h"

#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/memory.h"

#define NONE KR_FRONT_NONE

struct piece {
    size_t source, band;
    size_t before;  /* piece it follows; NONE at a source */
    size_t first;   /* earliest node reached from another piece */
    double reaches; /* m: greatest length of it and of all that follows */
    size_t longest; /* the follower that reaches farthest; NONE at an end */
    size_t kept;    /* followers that go on */
    size_t chain;
    double centre[3]; /* m: mean of its nodes */
    size_t count;
};

struct skeleton {
    const struct kr_front *front;
    double width;   /* m: of a band */
    size_t *piece;  /* (n) of a node; NONE in a speck */
    size_t n_pieces, room;
    struct piece *list;
    size_t *order;  /* (n_pieces) by band */
};

static size_t band_of(const struct skeleton *s, size_t i) {
    return (size_t)(s->front->length[i] / s->width + KR_FRONT_SLACK);
}

/* ---- 1: pieces --------------------------------------------------------------------------- */

static void flood(struct skeleton *s, size_t start, size_t *queue) {
    const struct kr_front *front = s->front;
    struct piece *piece = s->list + s->n_pieces;
    size_t end = 1;
    queue[0] = start;
    s->piece[start] = s->n_pieces;
    for (size_t k = 0; k < end; k++) {
        size_t i = queue[k];
        piece->reaches = fmax(piece->reaches, front->length[i]);
        for (size_t a = 0; a < 3; a++)
            piece->centre[a] += front->x[3 * i + a];
        for (size_t f = front->first[i]; f < front->first[i + 1]; f++) {
            size_t j = (size_t)front->near[f];
            if (s->piece[j] != NONE || front->source_of[j] != piece->source ||
                band_of(s, j) != piece->band)
                continue;
            s->piece[j] = s->n_pieces;
            queue[end++] = j;
        }
    }
    piece->count = end;
    for (size_t a = 0; a < 3; a++)
        piece->centre[a] /= (double)end;
    s->n_pieces++;
}

static void find_pieces(struct skeleton *s) {
    const struct kr_front *front = s->front;
    size_t *queue = KR_NEW(size_t, front->n);
    for (size_t i = 0; i < front->n; i++)
        s->piece[i] = NONE;
    for (size_t i = 0; i < front->n; i++) {
        if (s->piece[i] != NONE || front->source_of[i] == NONE)
            continue;
        KR_GROW(s->list, s->n_pieces, s->room);
        s->list[s->n_pieces] = (struct piece){front->source_of[i], band_of(s, i), NONE, NONE, 0,
                                              NONE, 0, NONE, {0}, 0};
        flood(s, i, queue);
    }
    kr_free(queue);
}

/* ---- 2, 3: the tree of pieces ------------------------------------------------------------ */

static int earlier(const struct kr_front *front, size_t i, size_t j) {
    if (front->arrival[i] != front->arrival[j])
        return front->arrival[i] < front->arrival[j];
    if (front->length[i] != front->length[j])
        return front->length[i] < front->length[j];
    return front->rank[i] < front->rank[j];
}

static void find_before(struct skeleton *s) {
    const struct kr_front *front = s->front;
    for (size_t i = 0; i < front->n; i++) {
        size_t p = s->piece[i], from = front->parent[i];
        if (p == NONE || from == NONE || s->piece[from] == p)
            continue;
        if (s->list[p].first == NONE || earlier(front, i, s->list[p].first)) {
            s->list[p].first = i;
            s->list[p].before = s->piece[from];
        }
    }
}

/** Counting sort of the pieces by band, so that forerunners come first. */
static void sort_pieces(struct skeleton *s) {
    size_t bands = 0, *begin;
    for (size_t p = 0; p < s->n_pieces; p++)
        bands = s->list[p].band >= bands ? s->list[p].band + 1 : bands;
    begin = KR_NEW(size_t, bands + 1);
    s->order = KR_NEW(size_t, s->n_pieces);
    for (size_t p = 0; p < s->n_pieces; p++)
        begin[s->list[p].band + 1]++;
    for (size_t b = 1; b <= bands; b++)
        begin[b] += begin[b - 1];
    for (size_t p = 0; p < s->n_pieces; p++)
        s->order[begin[s->list[p].band]++] = p;
    kr_free(begin);
}

static int goes_on(const struct skeleton *s, size_t p) {
    const struct piece *piece = s->list + p, *before = s->list + piece->before;
    double grown = piece->reaches - (double)piece->band * s->width;
    int far = grown >= KR_FRONT_SHORTEST * s->front->record->horizon * (1 - KR_FRONT_SLACK);
    /* the arm of a source must be a crack by itself; elsewhere the longest arm is the crack */
    if (before->before == NONE && s->front->source[piece->source].is_precrack)
        return far;
    return far || before->longest == p;
}

static void find_followers(struct skeleton *s) {
    for (size_t k = s->n_pieces; k-- > 0;) {
        size_t p = s->order[k];
        struct piece *piece = s->list + p, *before;
        if (piece->before == NONE)
            continue;
        before = s->list + piece->before;
        kr_assert(before->band < piece->band);
        if (before->longest == NONE || piece->reaches > s->list[before->longest].reaches)
            before->longest = p;
        before->reaches = fmax(before->reaches, piece->reaches);
    }
    for (size_t p = 0; p < s->n_pieces; p++)
        if (s->list[p].before != NONE && goes_on(s, p))
            s->list[s->list[p].before].kept++;
}

/* ---- 4: chains --------------------------------------------------------------------------- */

static void begin_chain(struct kr_chains *chains, size_t source, size_t parent) {
    KR_GROW(chains->item, chains->count, chains->room);
    chains->item[chains->count++] = (struct kr_chain){source, parent};
    if (parent != NONE)
        chains->item[parent].n_children++;
}

static void name_chains(struct skeleton *s, struct kr_chains *chains) {
    for (size_t k = 0; k < s->n_pieces; k++) {
        struct piece *piece = s->list + s->order[k];
        const struct piece *before;
        if (piece->before == NONE)
            continue;
        before = s->list + piece->before;
        piece->chain = before->chain;
        if (goes_on(s, s->order[k]) && (before->before == NONE || before->kept > 1)) {
            piece->chain = chains->count;
            begin_chain(chains, piece->source, before->chain);
        }
    }
}

static double square(double x) {
    return x * x;
}

/** Of the chains that begin at a source, the one whose first piece is nearest to a node. */
static size_t nearest_arm(const struct skeleton *s, const size_t *first, size_t n_first, size_t i) {
    size_t best = NONE;
    double least = INFINITY;
    for (size_t k = 0; k < n_first; k++) {
        const struct piece *piece = s->list + first[k];
        double away = 0;
        if (piece->source != s->front->source_of[i])
            continue;
        for (int a = 0; a < 3; a++)
            away += square(piece->centre[a] - s->front->x[3 * i + (size_t)a]);
        if (away < least) {
            least = away;
            best = piece->chain;
        }
    }
    return best;
}

/** Chain of every node; the nodes of a pre-crack itself belong to none. */
static void label_nodes(const struct skeleton *s, struct kr_chains *chains) {
    const struct kr_front *front = s->front;
    size_t *first = KR_NEW(size_t, s->n_pieces), n_first = 0;
    for (size_t p = 0; p < s->n_pieces; p++)
        if (s->list[p].before != NONE && s->list[s->list[p].before].before == NONE &&
            s->list[p].chain != NONE)
            first[n_first++] = p;
    chains->of = KR_NEW(size_t, front->n);
    for (size_t i = 0; i < front->n; i++) {
        const struct piece *piece = s->piece[i] == NONE ? NULL : s->list + s->piece[i];
        chains->of[i] = NONE;
        if (!piece || front->time[i] < 0)
            continue;
        chains->of[i] = piece->chain != NONE ? piece->chain : nearest_arm(s, first, n_first, i);
    }
    kr_free(first);
}

static const double *sort_length;

static int shorter(const void *left, const void *right) {
    size_t a = *(const size_t *)left, b = *(const size_t *)right;
    if (sort_length[a] != sort_length[b])
        return sort_length[a] < sort_length[b] ? -1 : 1;
    return a < b ? -1 : a > b;
}

/** The nodes of a band's width at the end of a chain. */
static void find_end(const struct skeleton *s, struct kr_chain *chain) {
    const double *length = s->front->length;
    size_t from = chain->count;
    while (from && length[chain->node[from - 1]] >=
                       length[chain->node[chain->count - 1]] - s->width)
        from--;
    chain->end_count = chain->count - from;
    chain->end = chain->node + from;
}

static void collect_nodes(const struct skeleton *s, struct kr_chains *chains) {
    for (size_t i = 0; i < s->front->n; i++)
        if (chains->of[i] != NONE)
            chains->item[chains->of[i]].count++;
    for (size_t c = 0; c < chains->count; c++) {
        chains->item[c].node = KR_NEW(size_t, chains->item[c].count);
        chains->item[c].count = 0;
    }
    for (size_t i = 0; i < s->front->n; i++)
        if (chains->of[i] != NONE) {
            struct kr_chain *chain = chains->item + chains->of[i];
            chain->node[chain->count++] = i;
        }
    sort_length = s->front->length;
    for (size_t c = 0; c < chains->count; c++) {
        struct kr_chain *chain = chains->item + c;
        if (chain->count)
            qsort(chain->node, chain->count, sizeof *chain->node, shorter);
        find_end(s, chain);
    }
}

void kr_chains_find(const struct kr_front *front, struct kr_chains *chains) {
    struct skeleton s = {front, fmax(front->record->horizon, front->reach)};
    *chains = (struct kr_chains){0};
    s.piece = KR_NEW(size_t, front->n);
    find_pieces(&s);
    find_before(&s);
    sort_pieces(&s);
    find_followers(&s);
    name_chains(&s, chains);
    label_nodes(&s, chains);
    collect_nodes(&s, chains);
    kr_free(s.piece);
    kr_free(s.list);
    kr_free(s.order);
}

void kr_chains_clear(struct kr_chains *chains) {
    for (size_t c = 0; c < chains->count; c++)
        kr_free(chains->item[c].node);
    kr_free(chains->item);
    kr_free(chains->of);
    *chains = (struct kr_chains){0};
}
