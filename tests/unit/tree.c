/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The crack tree of damage drawn by hand (tests/drawn.h): every test on a lattice and on shaken nodes,
 * each also turned by 37 degrees.
 */
#include "drawn.h"

#include "tree.h"

static const struct drawn_kind kinds[] = {{0, 0}, {1, 0}, {0, 37 * 0.017453292519943295},
                                          {1, 37 * 0.017453292519943295}};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static const struct drawn_crack notch = {2, {{-1e-3, 10e-3}, {2e-3, 10e-3}}, 0, 0, 0};

/** What a test expects of a branch: the crack it was drawn as, and how it hangs in the tree. */
struct wanted {
    const struct drawn_crack *crack;
    size_t parent;
    int start, end;
};

/** The branch whose way lies on the drawn crack. */
static const struct kr_branch *branch_of(const struct kr_tree *tree, struct drawn_kind kind,
                                         const struct drawn_crack *crack, size_t *number) {
    double middle[2];
    size_t best = 0;
    double least = INFINITY;
    drawn_point(crack, drawn_length(crack) / 2, middle);
    for (size_t b = 0; b < tree->count; b++)
        for (size_t k = 0; k < tree->branch[b].n_legs; k++) {
            const struct kr_path *path = &tree->legs.item[tree->branch[b].leg[k]].path;
            for (size_t m = 0; m < path->count; m++) {
                double x[2];
                drawn_back(path->move[m].x, kind.angle, x);
                if (hypot(x[0] - middle[0], x[1] - middle[1]) < least) {
                    least = hypot(x[0] - middle[0], x[1] - middle[1]);
                    best = b;
                }
            }
        }
    assert_true(least < 2 * DRAWN_SPACING);
    *number = best + 1;
    return tree->branch + best;
}

/** Every move stands within a spacing of where the crack was drawn at its time, and its speed is
 *  within 1 %. Within the window of an end or fork, where the fit sees one side only and damage of
 *  several cracks, it is within 5 %. Moves within a horizon of a rim or of another crack's damage
 *  have none: a sixth of all at most. */
static void check_moves(const struct kr_tree *tree, struct drawn_kind kind,
                        const struct drawn_crack *crack) {
    size_t number, checked = 0, without = 0;
    const struct kr_branch *branch = branch_of(tree, kind, crack, &number);
    for (size_t k = 0; k < branch->n_legs; k++) {
        const struct kr_path *path = &tree->legs.item[branch->leg[k]].path;
        for (size_t m = 0; m < path->count; m++) {
            const struct kr_move *move = path->move + m;
            double x[2], on[2], away, s, speed, rest;
            drawn_back(move->x, kind.angle, x);
            s = drawn_place(crack, x, &away);
            if (s <= 0 || s >= drawn_length(crack))
                continue; /* the leg of another crack, or the round end of this one */
            speed = drawn_speed(crack, s);
            if (fabs(move->time - drawn_time(crack, s)) * speed > 20 * DRAWN_SPACING)
                continue;
            drawn_point(crack, s + (move->time - drawn_time(crack, s)) * speed, on);
            kr_check_near(hypot(x[0] - on[0], x[1] - on[1]), 0, DRAWN_SPACING);
            rest = fmin(s, drawn_length(crack) - s) / (4 * DRAWN_SPACING); /* in horizons */
            assert_int_equal(isnan(move->speed), !move->is_alone);
            if (move->is_alone)
                kr_check_near(move->speed, speed, (rest < 3 ? 0.05 : 0.01) * speed);
            checked++;
            without += !move->is_alone;
        }
    }
    assert_true(checked > 50);
    assert_in_range(without, 0, checked / 6);
}

static void check_branch(const struct kr_tree *tree, struct drawn_kind kind,
                         const struct wanted *wanted) {
    size_t number;
    const struct drawn_crack *crack = wanted->crack;
    const struct kr_branch *branch = branch_of(tree, kind, crack, &number);
    double last = drawn_time(crack, drawn_length(crack));
    assert_int_equal(branch->parent, wanted->parent);
    assert_string_equal(kr_tree_start(branch->start), kr_tree_start(wanted->start));
    assert_string_equal(kr_tree_end(branch->end), kr_tree_end(wanted->end));
    kr_check_near(branch->last_time, last, 2.5 * DRAWN_SPACING / crack->speed);
    kr_check_near(branch->first_time, crack->start, 2.5 * DRAWN_SPACING / crack->speed);
}

/* What a test holds: freed behind it also where it fails, lest the next one finds arrays left. */
static struct kr_record *held_record;
static struct kr_tree *held_tree;

static struct kr_record *plate(struct drawn_kind kind, double hole_x, double hole_y,
                               double radius) {
    assert_null(held_record);
    return held_record = drawn_plate(kind, hole_x, hole_y, radius);
}

static int let_go(void **state) {
    (void)state;
    kr_tree_free(held_tree);
    kr_record_free(held_record);
    held_tree = NULL;
    held_record = NULL;
    return kr_memory_outstanding() > 0;
}

static struct kr_tree *grow(struct kr_record *r, struct drawn_kind kind) {
    drawn_turn(r, kind.angle);
    return held_tree = kr_tree_grow(r);
}

/** Every damaged node but the pre-crack's is of one branch or of one speck that the tree has, and
 * specks have as many nodes as they say. */
static void check_owners(const struct kr_tree *tree) {
    const struct kr_owners *owners = &tree->owners;
    size_t of_specks = 0, counted = 0;
    for (size_t i = 0; i < tree->front->n; i++) {
        size_t branch = owners->branch[i], speck = owners->speck[i];
        assert_int_equal((branch > 0) + (speck > 0), tree->front->time[i] >= 0);
        assert_true(branch <= tree->count && speck <= owners->n_specks);
        of_specks += speck > 0;
    }
    for (size_t k = 0; k < owners->n_specks; k++)
        counted += owners->item[k].count;
    assert_int_equal(counted, of_specks);
}

/** The path of an arm begins where and when that of its parent ends, which is at its branch's end. */
static void check_forks(const struct kr_tree *tree) {
    for (size_t c = 0; c < tree->legs.count; c++) {
        const struct kr_leg *leg = tree->legs.item + c, *parent;
        const struct kr_move *first = leg->path.move, *last;
        for (size_t m = 1; m < leg->path.count; m++)
            assert_true(first[m].s >= first[m - 1].s && first[m].time >= first[m - 1].time);
        if (leg->parent == KR_FRONT_NONE)
            continue;
        parent = tree->legs.item + leg->parent;
        last = parent->path.move + parent->path.count - 1;
        kr_check_near(first->time, last->time, 0);
        kr_check_near(first->x[0], last->x[0], 0);
        kr_check_near(first->x[1], last->x[1], 0);
        kr_check_near(first->s, 0, 0);
        kr_check_near(last->s, parent->end_s, 0);
    }
}

static void done(struct kr_record *r, struct kr_tree *tree) {
    assert_true(r == held_record && tree == held_tree);
    if (tree->countable) {
        check_owners(tree);
        check_forks(tree);
    }
    assert_int_equal(let_go(NULL), 0);
}

/** The kinds of all events in their order, with blanks between. */
static void check_events(const struct kr_tree *tree, const char *wanted) {
    char got[1024] = "";
    for (size_t k = 0; k < tree->n_events; k++) {
        strcat(got, k ? ", " : "");
        strcat(got, kr_tree_event(tree->event[k].kind));
    }
    assert_string_equal(got, wanted);
}

/** Draw cracks into a notched plate and check the whole tree. */
static void check_tree(struct drawn_kind kind, const struct wanted *wanted, size_t count,
                       const char *events) {
    struct kr_record *r = plate(kind, 0, 0, 0);
    struct kr_tree *tree;
    double length = 0;
    drawn_add(r, &notch);
    for (size_t k = 0; k < count; k++)
        drawn_add(r, wanted[k].crack);
    tree = grow(r, kind);
    assert_int_equal(tree->count, count);
    for (size_t k = 0; k < count; k++) {
        check_branch(tree, kind, wanted + k);
        check_moves(tree, kind, wanted[k].crack);
        length += drawn_length(wanted[k].crack);
    }
    for (size_t b = 0; b < tree->count; b++)
        length -= tree->branch[b].length;
    kr_check_near(length, 0, 2 * (double)count * DRAWN_SPACING);
    check_events(tree, events);
    done(r, tree);
}

static void tree_straight(void **state) {
    const struct drawn_crack crack = {2, {{2e-3, 10e-3}, {41e-3, 10e-3}}, 10e-6, 437.3, 0};
    const struct drawn_crack slant = {2, {{2e-3, 10e-3}, {37.1e-3, 17.3e-3}}, 10e-6, 437.3, 0};
    const struct wanted over = {&slant, 0, KR_START_PRECRACK, KR_END_ARREST};
    (void)state;
    for (int k = 0; k < KINDS; k++) {
        struct kr_record *r = plate(kinds[k], 0, 0, 0);
        struct kr_tree *tree;
        drawn_add(r, &notch);
        drawn_add(r, &crack);
        r->steps = 100000;
        tree = grow(r, kinds[k]);
        assert_int_equal(tree->count, 1);
        assert_int_equal(tree->branch[0].end, KR_END_BOUNDARY);
        check_moves(tree, kinds[k], &crack);
        kr_check_near(tree->branch[0].mean_speed, 437.3, 4.4);
        kr_check_near(tree->branch[0].top_speed, 437.3, 4.4);
        check_events(tree, "birth, reach boundary");
        done(r, tree);
        check_tree(kinds[k], &over, 1, "birth, arrest");
    }
}

static void tree_curved(void **state) {
    struct drawn_crack arc = {60, {{0}}, 5e-6, 400, 0};
    const struct wanted wanted = {&arc, 0, KR_START_PRECRACK, KR_END_ARREST};
    (void)state;
    for (int k = 0; k < 60; k++) { /* radius 8 mm, over 92 degrees */
        arc.at[k][0] = 2e-3 + 8e-3 * sin(1.6 * k / 59);
        arc.at[k][1] = 18e-3 - 8e-3 * cos(1.6 * k / 59);
    }
    for (int k = 0; k < KINDS; k++)
        check_tree(kinds[k], &wanted, 1, "birth, arrest");
}

static void tree_accelerating(void **state) {
    const struct drawn_crack crack = {2, {{2e-3, 10e-3}, {36e-3, 15e-3}}, 1e-6, 150, 2.6e6};
    const struct wanted wanted = {&crack, 0, KR_START_PRECRACK, KR_END_RUNNING};
    (void)state;
    for (int k = 0; k < KINDS; k++)
        check_tree(kinds[k], &wanted, 1, "birth");
}

static void tree_one_branch(void **state) {
    const struct drawn_crack trunk = {2, {{2e-3, 10e-3}, {12e-3, 10e-3}}, 5e-6, 500, 0};
    const struct drawn_crack up = {2, {{12e-3, 10e-3}, {34e-3, 17e-3}}, 25e-6, 450, 0};
    const struct drawn_crack down = {2, {{12e-3, 10e-3}, {34e-3, 3e-3}}, 25e-6, 500, 0};
    const struct wanted wanted[] = {{&trunk, 0, KR_START_PRECRACK, KR_END_FORK},
                                    {&up, 1, KR_START_FORK, KR_END_ARREST},
                                    {&down, 1, KR_START_FORK, KR_END_ARREST}};
    (void)state;
    for (int k = 0; k < KINDS; k++)
        check_tree(kinds[k], wanted, 3, "birth, branch, branch, arrest, arrest");
}

/** Two forks at one time, and a third after them. */
static void tree_two_branches_at_once(void **state) {
    const struct drawn_crack trunk = {2, {{2e-3, 10e-3}, {8e-3, 10e-3}}, 5e-6, 500, 0};
    const struct drawn_crack up = {2, {{8e-3, 10e-3}, {16e-3, 14e-3}}, 17e-6, 500, 0};
    const struct drawn_crack down = {2, {{8e-3, 10e-3}, {16e-3, 6e-3}}, 17e-6, 500, 0};
    const double fork = drawn_time(&up, drawn_length(&up));
    const struct drawn_crack uu = {2, {{16e-3, 14e-3}, {30e-3, 19e-3}}, fork, 400, 0};
    const struct drawn_crack ud = {2, {{16e-3, 14e-3}, {30e-3, 11e-3}}, fork, 400, 0};
    const struct drawn_crack du = {2, {{16e-3, 6e-3}, {30e-3, 8.6e-3}}, fork, 400, 0};
    const struct drawn_crack dd = {2, {{16e-3, 6e-3}, {30e-3, 1.2e-3}}, fork, 400, 0};
    (void)state;
    for (int k = 0; k < KINDS; k++) {
        struct kr_record *r = plate(kinds[k], 0, 0, 0);
        const struct drawn_crack *all[] = {&notch, &trunk, &up, &down, &uu, &ud, &du, &dd};
        struct kr_tree *tree;
        size_t number[8];
        for (int c = 0; c < 8; c++)
            drawn_add(r, all[c]);
        tree = grow(r, kinds[k]);
        assert_int_equal(tree->count, 7);
        assert_int_equal(kr_tree_tips(tree), 4);
        assert_int_equal(kr_tree_cracks(tree), 1);
        for (int c = 1; c < 8; c++)
            branch_of(tree, kinds[k], all[c], number + c);
        for (int c = 2; c < 8; c++)
            assert_int_equal(tree->branch[number[c] - 1].parent,
                             number[c < 4 ? 1 : c < 6 ? 2 : 3]);
        check_events(tree, "birth, branch, branch, branch, branch, branch, branch, arrest, "
                           "arrest, arrest, arrest");
        done(r, tree);
    }
}

/** A crack from the lower edge runs into the flank of one that has passed. */
static void tree_merge(void **state) {
    const struct drawn_crack first = {2, {{2e-3, 10e-3}, {38e-3, 12e-3}}, 2e-6, 500, 0};
    const struct drawn_crack second = {2, {{30e-3, 0}, {22e-3, 11.11e-3}}, 48e-6, 400, 0};
    const struct wanted wanted[] = {{&first, 0, KR_START_PRECRACK, KR_END_ARREST},
                                    {&second, 0, KR_START_BOUNDARY, KR_END_MERGE}};
    (void)state;
    for (int k = 0; k < KINDS; k++) {
        struct kr_record *r = plate(kinds[k], 0, 0, 0);
        struct kr_tree *tree;
        size_t number;
        drawn_add(r, &notch);
        drawn_add(r, &first);
        drawn_add(r, &second);
        tree = grow(r, kinds[k]);
        assert_int_equal(tree->count, 2);
        check_moves(tree, kinds[k], &first);
        check_moves(tree, kinds[k], &second);
        assert_int_equal(branch_of(tree, kinds[k], &first, &number)->end, KR_END_ARREST);
        assert_int_equal(branch_of(tree, kinds[k], &second, &number)->end, KR_END_MERGE);
        assert_int_equal(tree->branch[number - 1].start, KR_START_BOUNDARY);
        check_events(tree, wanted[0].parent ? "" : "birth, birth, arrest, merge");
        assert_int_equal(tree->event[3].other, 1);
        done(r, tree);
    }
}

/** Two cracks from two sides meet in the middle: each runs into the other. */
static void tree_two_cracks_meet(void **state) {
    const struct drawn_crack from_left = {2, {{2e-3, 10e-3}, {22e-3, 10.5e-3}}, 5e-6, 500, 0};
    struct drawn_crack from_right = {2, {{40e-3, 9.5e-3}, {22e-3, 10.5e-3}}, 1e-6, 432, 0};
    (void)state;
    from_right.start = drawn_time(&from_left, drawn_length(&from_left)) -
                       drawn_length(&from_right) / from_right.speed; /* they meet in time as well */
    for (int k = 0; k < KINDS; k++) {
        struct kr_record *r = plate(kinds[k], 0, 0, 0);
        struct kr_tree *tree;
        double x[2];
        drawn_add(r, &notch);
        drawn_add(r, &from_left);
        drawn_add(r, &from_right);
        tree = grow(r, kinds[k]);
        assert_int_equal(tree->count, 2);
        check_moves(tree, kinds[k], &from_left);
        check_moves(tree, kinds[k], &from_right);
        for (int b = 0; b < 2; b++) {
            drawn_back(tree->branch[b].to, kinds[k].angle, x);
            kr_check_near(hypot(x[0] - 22e-3, x[1] - 10.5e-3), 0, 3 * DRAWN_SPACING);
            assert_int_equal(tree->branch[b].parent, 0);
            assert_int_equal(tree->branch[b].end, KR_END_MERGE);
        }
        assert_int_equal(tree->branch[0].start, KR_START_BOUNDARY);
        assert_int_equal(tree->branch[1].start, KR_START_PRECRACK);
        check_events(tree, "birth, birth, merge, merge");
        done(r, tree);
    }
}

static void tree_arrest(void **state) {
    const struct drawn_crack crack = {2, {{2e-3, 10e-3}, {15e-3, 12e-3}}, 5e-6, 300, 0};
    const struct wanted wanted = {&crack, 0, KR_START_PRECRACK, KR_END_ARREST};
    (void)state;
    for (int k = 0; k < KINDS; k++) {
        struct kr_record *r;
        struct kr_tree *tree;
        check_tree(kinds[k], &wanted, 1, "birth, arrest");
        r = plate(kinds[k], 0, 0, 0);
        drawn_add(r, &notch);
        drawn_add(r, &crack);
        r->steps = 2500; /* 1 us after the last move: at its speed it would have gone 0.3 mm */
        tree = grow(r, kinds[k]);
        assert_int_equal(tree->branch[0].end, KR_END_RUNNING);
        done(r, tree);
    }
}

/** Into a hole of 3 mm, trapped for 6 us, and out on the other side in another direction; later a
 *  second crack out of the same hole. */
static void tree_hole(void **state) {
    const struct drawn_crack in = {2, {{2e-3, 10e-3}, {18.5e-3, 10e-3}}, 5e-6, 500, 0};
    const struct drawn_crack out = {2, {{21.3e-3, 10.75e-3}, {38e-3, 17e-3}}, 44e-6, 500, 0};
    const struct drawn_crack other = {2, {{21.2e-3, 9.1e-3}, {35e-3, 2e-3}}, 55e-6, 400, 0};
    (void)state;
    for (int k = 0; k < KINDS; k++) {
        struct kr_record *r = plate(kinds[k], 20e-3, 10e-3, 1.5e-3);
        struct kr_tree *tree;
        drawn_add(r, &notch);
        drawn_add(r, &in);
        drawn_add(r, &out);
        drawn_add(r, &other);
        tree = grow(r, kinds[k]);
        assert_int_equal(tree->count, 2);
        assert_int_equal(kr_tree_cracks(tree), 1);
        check_moves(tree, kinds[k], &in);
        check_moves(tree, kinds[k], &out);
        check_moves(tree, kinds[k], &other);
        check_events(tree, "birth, enter hole, leave hole, leave hole, arrest, arrest");
        assert_int_equal(tree->event[1].hole, 1);
        kr_check_near(tree->branch[0].trapped, 6e-6, 1.5 * DRAWN_SPACING / 500);
        kr_check_near(tree->branch[0].length, drawn_length(&in) + drawn_length(&out),
                      3 * DRAWN_SPACING);
        kr_check_near(tree->branch[0].mean_speed, 500, 5);
        assert_int_equal(tree->branch[0].n_holes, 1);
        assert_int_equal(tree->branch[1].parent, 1);
        assert_int_equal(tree->branch[1].start, KR_START_HOLE);
        done(r, tree);
    }
}

/** Shaken times, and a crack beside the way: fits that see one side only are the fastest here, and the least certain. The
 *  top speed is that of which a standard error takes least away. */
static void tree_top_speed(void **state) {
    const struct drawn_crack crack = {2, {{2e-3, 10e-3}, {30e-3, 10e-3}}, 9e-6, 500, 0};
    const struct drawn_crack beside = {2, {{14e-3, 10.5e-3}, {16e-3, 10.5e-3}}, 1e-6, 500, 0};
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        struct kr_record *r = plate(kinds[kind], 0, 0, 0);
        drawn_add(r, &notch);
        drawn_add(r, &crack);
        drawn_add(r, &beside);
        for (size_t i = 0; i < r->n; i++)
            if (isfinite(r->damage_time[i]) && r->damage_time[i] > 0)
                r->damage_time[i] += 5e-7 * rand() / RAND_MAX;
        r->steps = 100000;
        struct kr_tree *tree = grow(r, kinds[kind]);
        const struct kr_branch *branch = &tree->branch[1];
        const struct kr_path *path = &tree->legs.item[branch->leg[0]].path;
        const double window = kr_path_window(r), end = path->move[path->count - 1].s - window;
        int faster = 0;
        assert_int_equal(tree->count, 2);
        for (size_t m = 0; m < path->count; m++)
            if (!isnan(path->move[m].speed) && path->move[m].s > window + 1e-3 && path->move[m].s < end) {
                assert_true(path->move[m].speed - path->move[m].error <= branch->top_speed - branch->top_error);
                faster += path->move[m].speed > branch->top_speed;
            }
        assert_true(faster > 0);
        kr_check_near(branch->top_speed, 500, 2 * branch->top_error);
        kr_check_near(branch->top_error, 15, 3);
        done(r, tree);
    }
}

/** The last ligament breaks at once, before a hole and between two cracks: no tip was fast, and speeds
 *  are right within three of the errors that they state. */
static void tree_snap(void **state) {
    const struct drawn_crack in = {2, {{2e-3, 10e-3}, {18.5e-3, 10e-3}}, 5e-6, 500, 0};
    const struct drawn_crack right = {2, {{40e-3, 10e-3}, {32e-3, 10e-3}}, 5e-6, 500, 0};
    const struct drawn_crack left = {2, {{21.5e-3, 10e-3}, {32e-3, 10e-3}}, 5e-6, 500, 0};
    const struct drawn_crack *const all[] = {&in, &left, &right};
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        struct kr_record *r = plate(kinds[kind], 20e-3, 10e-3, 1.5e-3);
        struct kr_tree *tree;
        drawn_add(r, &notch);
        for (int k = 0; k < 3; k++) {
            double snap = drawn_time(all[k], drawn_length(all[k]) - 3.5e-4);
            drawn_add(r, all[k]);
            for (size_t i = 0; i < r->n; i++) {
                double away, s = drawn_place(all[k], r->position + 2 * i, &away);
                if (away <= DRAWN_SPACING && s > drawn_length(all[k]) - 3.5e-4)
                    r->damage_time[i] = fmin(r->damage_time[i], ceil(snap / 2e-8) * 2e-8);
            }
        }
        tree = grow(r, kinds[kind]);
        assert_int_equal(tree->count, 3);
        for (size_t b = 0; b < tree->count; b++) {
            const struct kr_path *path = &tree->legs.item[tree->branch[b].leg[0]].path;
            kr_check_near(tree->branch[b].top_speed, 500, 5);
            for (size_t m = 0; m < path->count; m++)
                if (path->move[m].is_alone)
                    kr_check_near(path->move[m].speed, 500, fmax(5, 3 * path->move[m].error));
        }
        done(r, tree);
    }
}

/** Branches that go round an island and meet: one goes on, the other has run into it. */
static void tree_loop(void **state) {
    const struct drawn_crack trunk = {2, {{2e-3, 10e-3}, {10e-3, 10e-3}}, 1e-6, 500, 0};
    const struct drawn_crack up = {3, {{10e-3, 10e-3}, {17e-3, 14e-3}, {25e-3, 10e-3}}, 17e-6,
                                   500, 0};
    const struct drawn_crack down = {3, {{10e-3, 10e-3}, {17e-3, 6e-3}, {25e-3, 10e-3}}, 17e-6,
                                     480, 0};
    const struct drawn_crack on = {2, {{25e-3, 10e-3}, {38e-3, 9e-3}}, 51e-6, 500, 0};
    (void)state;
    for (int k = 0; k < KINDS; k++) {
        struct kr_record *r = plate(kinds[k], 0, 0, 0);
        struct kr_tree *tree;
        size_t number;
        drawn_add(r, &notch);
        drawn_add(r, &trunk);
        drawn_add(r, &up);
        drawn_add(r, &down);
        drawn_add(r, &on);
        tree = grow(r, kinds[k]);
        assert_int_equal(tree->count, 3);
        assert_int_equal(branch_of(tree, kinds[k], &down, &number)->end, KR_END_MERGE);
        assert_int_equal(branch_of(tree, kinds[k], &up, &number)->end, KR_END_ARREST);
        done(r, tree);
    }
}

/** Specks of one to four nodes and twigs shorter than three horizons are no cracks. */
static void tree_noise(void **state) {
    const struct drawn_crack crack = {2, {{2e-3, 10e-3}, {41e-3, 10e-3}}, 1e-6, 500, 0};
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        struct kr_record *r = plate(kinds[kind], 0, 0, 0);
        struct kr_tree *tree;
        size_t specks = 0;
        drawn_add(r, &notch);
        drawn_add(r, &crack);
        for (size_t k = 0; k < 25; k++) {
            size_t i = 37 + 3163 * k;
            if (fabs(r->position[2 * i + 1] - 10e-3) < 2e-3)
                continue;
            specks++;
            for (size_t j = 0; j <= k % 4; j++)
                r->damage_time[i + j] = 10e-6 + 1e-6 * (double)k;
        }
        for (int k = 1; k < 12; k++) { /* twigs of 0.8 mm, below 3 horizons = 1.2 mm */
            double side = k % 2 ? 1 : -1;
            struct drawn_crack twig = {2,
                                       {{3e-3 * k + 1e-3, 10e-3},
                                        {3e-3 * k + 1.5e-3, 10e-3 + side * 0.65e-3}},
                                       6e-6 * k + 1e-6, 500, 0};
            drawn_add(r, &twig);
        }
        tree = grow(r, kinds[kind]);
        assert_int_equal(tree->count, 1);
        assert_int_equal(tree->owners.n_specks, specks);
        kr_check_near(tree->branch[0].length, 38e-3, 3 * DRAWN_SPACING);
        kr_check_near(tree->branch[0].mean_speed, 500, 5);
        done(r, tree);
    }
}

/** Patches of 0.6 mm ahead of the tip break 3 us before it comes: no cracks of their own. */
static void tree_damage_ahead(void **state) {
    const struct drawn_crack crack = {2, {{2e-3, 10e-3}, {36e-3, 12e-3}}, 1e-6, 500, 0};
    (void)state;
    for (int k = 0; k < KINDS; k++) {
        struct kr_record *r = plate(kinds[k], 0, 0, 0);
        struct kr_tree *tree;
        drawn_add(r, &notch);
        drawn_add(r, &crack);
        for (double s = 3e-3; s < 30e-3; s += 4e-3) {
            struct drawn_crack patch = {2, {{0}}, drawn_time(&crack, s) - 3e-6, 500, 0};
            drawn_point(&crack, s, patch.at[0]);
            drawn_point(&crack, s + 0.6e-3, patch.at[1]);
            drawn_add(r, &patch);
        }
        tree = grow(r, kinds[k]);
        assert_int_equal(tree->count, 1);
        assert_int_equal(tree->owners.n_specks, 0);
        check_events(tree, "birth, arrest");
        done(r, tree);
    }
}

/** A crack born inside has two tips. */
static void tree_born_inside(void **state) {
    const struct drawn_crack there = {2, {{20e-3, 10e-3}, {35e-3, 13e-3}}, 5e-6, 300, 0};
    const struct drawn_crack back = {2, {{20e-3, 10e-3}, {5e-3, 7e-3}}, 5e-6, 300, 0};
    (void)state;
    for (int k = 0; k < KINDS; k++) {
        struct kr_record *r = plate(kinds[k], 0, 0, 0);
        struct kr_tree *tree;
        drawn_add(r, &there);
        drawn_add(r, &back);
        tree = grow(r, kinds[k]);
        assert_int_equal(tree->count, 2);
        check_moves(tree, kinds[k], &there);
        check_moves(tree, kinds[k], &back);
        check_events(tree, "birth, birth, arrest, arrest");
        assert_int_equal(tree->branch[0].start, KR_START_INSIDE);
        done(r, tree);
    }
}

static void tree_nothing(void **state) {
    struct kr_record *r = plate(kinds[0], 0, 0, 0);
    struct kr_tree *tree = grow(r, kinds[0]);
    (void)state;
    assert_true(tree->countable && tree->count == 0 && tree->n_events == 0);
    done(r, tree);
    r = plate(kinds[0], 0, 0, 0);
    drawn_add(r, &notch); /* a pre-crack that never grew */
    tree = grow(r, kinds[0]);
    assert_true(tree->countable && tree->count == 0 && tree->damaged > 0 && tree->n_events == 0);
    done(r, tree);
    r = plate(kinds[0], 0, 0, 0);
    for (size_t i = 0; i < r->n; i++)
        r->damage_time[i] = 40 * DRAWN_STEP;
    tree = grow(r, kinds[0]);
    assert_true(!tree->countable && tree->count == 0);
    done(r, tree);
}

/** Growth by less than three horizons from a pre-crack is no branch, but is listed. */
static void tree_short_growth(void **state) {
    const struct drawn_crack crack = {2, {{2e-3, 10e-3}, {2.8e-3, 10.2e-3}}, 5e-6, 300, 0};
    (void)state;
    for (int k = 0; k < KINDS; k++) {
        struct kr_record *r = plate(kinds[k], 0, 0, 0);
        struct kr_tree *tree;
        double x[2];
        drawn_add(r, &notch);
        drawn_add(r, &crack);
        tree = grow(r, kinds[k]);
        assert_int_equal(tree->count, 0);
        check_events(tree, "speck");
        drawn_back(tree->event[0].x, kinds[k].angle, x);
        kr_check_near(hypot(x[0] - 2e-3, x[1] - 10e-3), 0, 2 * DRAWN_SPACING);
        kr_check_near(tree->event[0].time, 5e-6, 2 * DRAWN_SPACING / 300);
        assert_int_equal(tree->event[0].other, 1);
        done(r, tree);
    }
}

/** The energy of broken bonds goes to the branch beside them and to no other. */
static void tree_energy(void **state) {
    const struct drawn_crack trunk = {2, {{2e-3, 10e-3}, {12e-3, 10e-3}}, 5e-6, 500, 0};
    const struct drawn_crack up = {2, {{12e-3, 10e-3}, {34e-3, 17e-3}}, 25e-6, 450, 0};
    const struct drawn_crack down = {2, {{12e-3, 10e-3}, {34e-3, 3e-3}}, 25e-6, 500, 0};
    const struct drawn_crack *all[] = {&notch, &trunk, &up, &down};
    struct kr_record *r = plate(kinds[1], 0, 0, 0);
    struct kr_tree *tree;
    double sum = 0;
    size_t room = 0;
    (void)state;
    for (int c = 0; c < 4; c++)
        drawn_add(r, all[c]);
    /* a bond for each damaged node, to the next in its row; 100 J/m^2 times a spacing a column */
    for (size_t i = 0; i + 1 < r->n; i++)
        if (r->damage_time[i] >= 0 && !isinf(r->damage_time[i])) {
            double away, least = INFINITY;
            for (int c = 1; c < 4; c++) {
                drawn_place(all[c], r->position + 2 * i, &away);
                least = fmin(least, away);
            }
            if (r->broken == room) {
                room = room ? 2 * room : 64;
                r->bond = kr_realloc(r->bond, 2 * room, sizeof *r->bond);
                r->bond_energy = kr_realloc(r->bond_energy, room, sizeof *r->bond_energy);
            }
            r->bond[2 * r->broken] = (int32_t)i;
            r->bond[2 * r->broken + 1] = (int32_t)i + 1;
            /* two rows of a spacing each lie within a spacing: half of 100 J/m^2 a node */
            r->bond_energy[r->broken] = 50 * DRAWN_SPACING;
            sum += r->bond_energy[r->broken++];
        }
    r->bond[0] = 0; /* far from all damage */
    r->bond[1] = 1;
    tree = grow(r, (struct drawn_kind){1, 0});
    assert_int_equal(tree->count, 3);
    kr_check_near(tree->legs.scattered, 50 * DRAWN_SPACING, 1e-12);
    for (size_t b = 0; b < 3; b++) {
        sum -= tree->branch[b].energy;
        /* nodes at random places: each branch has some hundreds, the arms at a slope */
        kr_check_near(tree->branch[b].energy / tree->branch[b].length, 100, 10);
    }
    kr_check_near(sum, 50 * DRAWN_SPACING, 1e-9 * fabs(50 * DRAWN_SPACING) + 1e-12);
    done(r, tree);
}

int main(void) {
#define TEST(name) cmocka_unit_test_teardown(name, let_go)
    const struct CMUnitTest tests[] = {
        TEST(tree_straight), TEST(tree_curved), TEST(tree_accelerating), TEST(tree_one_branch),
        TEST(tree_two_branches_at_once), TEST(tree_merge), TEST(tree_two_cracks_meet),
        TEST(tree_arrest), TEST(tree_hole), TEST(tree_snap), TEST(tree_top_speed), TEST(tree_loop),
        TEST(tree_noise),
        TEST(tree_damage_ahead), TEST(tree_born_inside), TEST(tree_nothing),
        TEST(tree_short_growth), TEST(tree_energy),
    };
    kr_run_tests(tests);
}
