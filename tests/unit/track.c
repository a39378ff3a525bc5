/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tip and speed in boxes, of cracks drawn by hand on a lattice: 40 mm x 20 mm, spacing 0.1 mm,
 * horizon 0.4 mm, steps of 0.02 us, a pre-crack of 2 mm at mid height.
 */
#include "test.h"

#include "base/error.h"
#include "base/h5.h"
#include "track.h"

enum { COLUMNS = 400, ROWS = 200, WINDOW = 30 };
static const double spacing = 1e-4, step = 2e-8;

/* What a test holds: freed behind it also where it fails, lest the next one finds arrays left. */
static struct kr_record *held_record;
static struct kr_track held_track;

static int let_go(void **state) {
    (void)state;
    kr_track_clear(&held_track);
    kr_record_free(held_record);
    held_record = NULL;
    return kr_memory_outstanding() > 0;
}

/** A lattice without damage; nodes in the hole (centre, radius) are left out. */
static struct kr_record *plate(double hole_x, double hole_y, double radius) {
    struct kr_record *r = held_record = KR_NEW(struct kr_record, 1);
    r->position = KR_NEW(double, 2 * COLUMNS * ROWS);
    r->damage_time = KR_NEW(double, COLUMNS *ROWS);
    r->volume = KR_NEW(double, COLUMNS *ROWS);
    for (int k = 0; k < COLUMNS * ROWS; k++) {
        double x = (k % COLUMNS + 0.5) * spacing, y = (k / COLUMNS + 0.5) * spacing;
        if (hypot(x - hole_x, y - hole_y) < radius)
            continue;
        r->position[2 * r->n] = x;
        r->position[2 * r->n + 1] = y;
        r->volume[r->n] = spacing * spacing;
        r->damage_time[r->n++] = INFINITY;
    }
    r->time_step = step;
    r->steps = 5000;
    r->spacing = spacing;
    r->dim = 2;
    r->horizon = 4 * spacing;
    r->rayleigh_speed = 929;
    r->first_break = INFINITY;
    return r;
}

/** A crack from a to b that begins at `start` and runs at speed + acceleration * time; it damages
 *  the nodes within 0.8 spacings, each at a whole step. speed 0: a pre-crack. */
static void crack(struct kr_record *r, const double a[2], const double b[2], double start,
                  double speed, double acceleration) {
    double length = hypot(b[0] - a[0], b[1] - a[1]);
    double e[2] = {(b[0] - a[0]) / length, (b[1] - a[1]) / length};
    for (size_t i = 0; i < r->n; i++) {
        double d[2] = {r->position[2 * i] - a[0], r->position[2 * i + 1] - a[1]}, time = -1;
        double s = d[0] * e[0] + d[1] * e[1];
        if (s < 0 || s > length || fabs(d[0] * e[1] - d[1] * e[0]) > 0.8 * spacing)
            continue;
        if (acceleration > 0)
            time = start + (sqrt(speed * speed + 2 * acceleration * s) - speed) / acceleration;
        else if (speed > 0)
            time = start + s / speed;
        if (time >= 0) {
            time = step * ceil(time / step);
            r->first_break = fmin(r->first_break, time);
        }
        r->damage_time[i] = fmin(r->damage_time[i], time);
    }
}

static const double left[2] = {0, 10e-3}, notch[2] = {2e-3, 10e-3}, right[2] = {40e-3, 10e-3};

static struct kr_record *notched(void) {
    struct kr_record *r = plate(-1, 0, 0);
    crack(r, left, notch, 0, 0, 0);
    return r;
}

static struct kr_track follow_box(const struct kr_record *r, const struct kr_case_box *box,
                                  int64_t window) {
    kr_track_follow(r, box, window, &held_track);
    return held_track;
}

static struct kr_track follow(const struct kr_record *r) {
    struct kr_case_box box = kr_track_whole(r);
    return follow_box(r, &box, WINDOW);
}

static void finish(struct kr_record *r, struct kr_track *track) {
    assert_true(r == held_record && track->tip == held_track.tip);
    assert_int_equal(let_go(NULL), 0);
}

/* ---- tip and speed ------------------------------------------------------------------------- */

static void test_straight_crack(void **state) {
    const double start = 20e-6, speed = 437.3;
    struct kr_record *r = notched();
    struct kr_track track;
    (void)state;
    crack(r, notch, right, start, speed, 0);
    track = follow(r);
    kr_check_near(track.mean_speed, speed, 0.01 * speed);
    /* a window of 0.6 us holds 2.6 spacings: it sees one more or one less */
    kr_check_near(track.top_speed, speed, spacing / (WINDOW * step));
    for (size_t k = 1; k < track.count; k++) {
        double x = notch[0] + speed * ((double)track.tip[k].step * step - start);
        kr_check_near(r->position[2 * track.tip[k].node], x, spacing);
        assert_false(track.tip[k].jumped);
    }
    assert_int_equal(track.tip[0].step, 0);
    kr_check_near(track.tip[0].speed, 0, 0); /* waits for longer than the window */
    finish(r, &track);
}

/** The speed over a wide window follows a crack that speeds up from 100 m/s to 500 m/s. */
static void test_accelerating_crack(void **state) {
    const double start = 5e-6, from = 100, a = (500. * 500 - 100. * 100) / (2 * 38e-3);
    const int64_t window = 500;
    struct kr_record *r = notched();
    struct kr_case_box box = kr_track_whole(r);
    struct kr_track track;
    (void)state;
    crack(r, notch, right, start, from, a);
    track = follow_box(r, &box, window);
    for (size_t k = 5; k < track.count; k++) {
        double middle = ((double)track.tip[k].step + (double)window / 2) * step;
        if (track.tip[k].step + window > track.arrival)
            break;
        kr_check_near(track.tip[k].speed, from + a * (middle - start),
                      spacing / ((double)window * step));
    }
    kr_check_near(track.mean_speed, 300, 0.01 * 300);
    finish(r, &track);
}

static void test_each_direction(void **state) {
    const double ends[4][2] = {{30e-3, 10e-3}, {10e-3, 10e-3}, {20e-3, 18e-3}, {20e-3, 2e-3}};
    const double middle[2] = {20e-3, 10e-3};
    (void)state;
    for (int d = 0; d < 4; d++) {
        struct kr_record *r = plate(-1, 0, 0);
        struct kr_case_box box = kr_track_whole(r);
        struct kr_track track;
        box.direction = d;
        for (int k = 0; k < 4; k++)
            crack(r, middle, ends[k], 1e-6, 100 * (k + 1), 0);
        track = follow_box(r, &box, WINDOW);
        kr_check_near(track.mean_speed, 100 * (d + 1), 3 * (d + 1));
        kr_check_near(r->position[2 * track.tip[track.count - 1].node + (size_t)d / 2],
                      ends[d][d / 2], spacing);
        finish(r, &track);
    }
}

static void test_box_sees_its_branch_alone(void **state) {
    const double fork[2] = {10e-3, 10e-3}, up[2] = {38e-3, 18e-3}, down[2] = {20e-3, 6e-3};
    struct kr_record *r = notched();
    struct kr_case_box box = {{10e-3, 0}, {40e-3, 9.9e-3}, 0};
    struct kr_track track;
    (void)state;
    crack(r, notch, fork, 1e-6, 400, 0);
    crack(r, fork, up, 21e-6, 500, 0);
    crack(r, fork, down, 21e-6, 300, 0);
    track = follow_box(r, &box, WINDOW);
    kr_check_near(track.mean_speed, 300, 3);
    kr_check_near(r->position[2 * track.tip[track.count - 1].node + 1], down[1], spacing);
    finish(r, &track);
}

/** Two equal branches take the lead in turns; the tip stays on one of them. */
static void test_tip_stays_on_its_branch(void **state) {
    const double fork[2] = {10e-3, 10e-3}, up[2] = {38e-3, 17.03e-3}, down[2] = {38e-3, 3e-3};
    struct kr_record *r = notched();
    struct kr_track track;
    (void)state;
    crack(r, notch, fork, 1e-6, 500, 0);
    crack(r, fork, up, 17e-6, 500, 0);
    crack(r, fork, down, 17e-6, 500, 0);
    track = follow(r);
    for (size_t k = 1; k < track.count; k++) {
        double dy =
            r->position[2 * track.tip[k].node + 1] - r->position[2 * track.tip[k - 1].node + 1];
        /* at the fork, as long as both are within a horizon, it may hop across */
        assert_false(track.tip[k].jumped && r->position[2 * track.tip[k].node] > 12e-3);
        assert_true(fabs(dy) <= r->horizon);
    }
    kr_check_near(track.top_speed, 500, 1.5 * spacing / (WINDOW * step));
    finish(r, &track);
}

/** Sideways by three cells in no time is a hop, though within the horizon: no speed comes of it. */
static void test_hop_is_no_speed(void **state) {
    const double end[2] = {20e-3, 10e-3}, from[2] = {20.05e-3, 10.3e-3}, to[2] = {38e-3, 10.3e-3};
    struct kr_record *r = notched();
    struct kr_track track;
    (void)state;
    crack(r, notch, end, 1e-6, 400, 0);
    crack(r, from, to, 46.1e-6, 400, 0);
    track = follow(r);
    kr_check_near(track.top_speed, 400, 1.1 * spacing / (WINDOW * step));
    finish(r, &track);
}

static void test_no_damage(void **state) {
    struct kr_record *r = plate(-1, 0, 0);
    struct kr_track track = follow(r);
    (void)state;
    assert_int_equal(track.count, 0);
    assert_int_equal(track.arrival, -1);
    assert_true(isnan(track.mean_speed) && isnan(track.top_speed));
    finish(r, &track);
}

static void test_precrack_that_never_grew(void **state) {
    struct kr_record *r = notched();
    struct kr_track track = follow(r);
    (void)state;
    assert_int_equal(track.count, 1);
    assert_true(isnan(track.mean_speed) && isnan(track.top_speed));
    kr_check_near(r->position[2 * track.tip[0].node], notch[0], spacing);
    finish(r, &track);
}

static void test_everything_at_once(void **state) {
    struct kr_record *r = plate(-1, 0, 0);
    struct kr_track track;
    (void)state;
    for (size_t i = 0; i < r->n; i++)
        r->damage_time[i] = 40 * step;
    r->first_break = 40 * step;
    track = follow(r);
    assert_int_equal(track.count, 1);
    assert_true(isnan(track.mean_speed));
    finish(r, &track);
}

/** The crack stops in a hole of 3 mm, and begins anew 6 us later behind it: one crack, a jump in no
 *  speed, and a mean as if it had run through. */
static void test_hole_is_jumped(void **state) {
    const double rim[2] = {18.45e-3, 10e-3}, behind[2] = {21.55e-3, 10e-3};
    struct kr_record *r = plate(20e-3, 10e-3, 1.5e-3);
    struct kr_track track;
    int jumps = 0;
    (void)state;
    crack(r, left, notch, 0, 0, 0);
    crack(r, notch, rim, 10e-6, 500, 0);
    crack(r, behind, right, 10e-6 + 16.45e-3 / 500 + 6e-6, 500, 0);
    track = follow(r);
    for (size_t k = 0; k < track.count; k++)
        jumps += track.tip[k].jumped;
    assert_int_equal(jumps, 1);
    kr_check_near(track.top_speed, 500, spacing / (WINDOW * step));
    kr_check_near(track.mean_speed, 38e-3 / (16.45e-3 / 500 + 6e-6 + 18.45e-3 / 500), 3);
    finish(r, &track);
}

/* ---- files ------------- ------------------------------------------------------------------ */

static char path[] = "/tmp/kirsch-track-XXXXXX";

/** Write what kr_record_read reads, with one fault of choice. */
static void write_record(const struct kr_record *r, const char *fault) {
    struct kr_h5 *file = kr_h5_create(path, "kirsch run", 1);
    double time[2] = {r->first_break, r->first_break + step}, energy[2] = {1e-6, 2e-6};
    int32_t bond[4] = {0, 1, 5, strcmp(fault, "bond") ? 6 : (int32_t)r->n};
    kr_h5_set_int64(file, "/", "dim", strcmp(fault, "dim") ? 2 : 4);
    kr_h5_set_double(file, "/", "time_step", strcmp(fault, "time_step") ? r->time_step : 0);
    kr_h5_set_double(file, "/", "horizon", r->horizon);
    kr_h5_set_double(file, "/", "spacing", r->spacing);
    kr_h5_set_double(file, "/", "rayleigh_speed", r->rayleigh_speed);
    kr_h5_set_double(file, "/", "fracture_energy", 200);
    kr_h5_set_double(file, "/", "density", 1190);
    kr_h5_set_int64(file, "/", "bonds", 77);
    kr_h5_group(file, "/crack");
    kr_h5_set_int64(file, "/crack", "steps", r->steps);
    kr_h5_set_int64(file, "/crack", "finished", 1);
    kr_h5_set_double(file, "/crack", "external_work", 4);
    kr_h5_set_double(file, "/crack", "kinetic_energy", 1);
    kr_h5_set_double(file, "/crack", "strain_energy", 2.5);
    kr_h5_set_double(file, "/crack", "fracture_work", 0.49);
    kr_h5_write_double(file, "/nodes/position", r->n, 2, r->position);
    if (strcmp(fault, "nan") == 0)
        r->damage_time[5] = NAN;
    if (strcmp(fault, "missing") != 0)
        kr_h5_write_double(file, "/crack/Damage_Time", r->n, 0, r->damage_time);
    kr_h5_write_double(file, "/nodes/volume", r->n, 0, r->volume);
    kr_h5_write_double(file, "/crack/bond_time", 2, 0, time);
    kr_h5_write_double(file, "/crack/bond_energy", 2, 0, energy);
    kr_h5_write_int32(file, "/crack/bond", 2, 2, bond);
    kr_h5_close(file);
}

static void read_record(void *unused) {
    (void)unused;
    kr_record_free(kr_record_read(path));
}

static void test_reads_a_run(void **state) {
    struct kr_record *r = notched(), *got;
    int handle = mkstemp(path);
    (void)state;
    close(handle);
    crack(r, notch, right, 20e-6, 400, 0);
    write_record(r, "");
    got = kr_record_read(path);
    assert_int_equal(got->n, r->n);
    assert_memory_equal(got->position, r->position, 2 * r->n * sizeof(double));
    assert_memory_equal(got->damage_time, r->damage_time, r->n * sizeof(double));
    assert_int_equal(got->broken, 2);
    assert_int_equal(got->bonds, 77);
    assert_true(got->finished && got->first_break == r->first_break);
    kr_record_free(got);
    write_record(r, "dim");
    kr_check_stops(read_record, NULL, KR_EXIT_INPUT, "`dim` is 4");
    write_record(r, "time_step");
    kr_check_stops(read_record, NULL, KR_EXIT_INPUT, "`time_step` is 0");
    write_record(r, "missing");
    kr_check_stops(read_record, NULL, KR_EXIT_INPUT, "/crack/Damage_Time: there is no such array");
    write_record(r, "nan");
    kr_check_stops(read_record, NULL, KR_EXIT_INPUT, "node 5 at");
    r->damage_time[5] = INFINITY;
    write_record(r, "bond");
    kr_check_stops(read_record, NULL, KR_EXIT_INPUT, "broken bond 1 joins the nodes 5 and");
    unlink(path);
    assert_int_equal(let_go(NULL), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_straight_crack, let_go),
        cmocka_unit_test_teardown(test_accelerating_crack, let_go),
        cmocka_unit_test_teardown(test_each_direction, let_go),
        cmocka_unit_test_teardown(test_box_sees_its_branch_alone, let_go),
        cmocka_unit_test_teardown(test_tip_stays_on_its_branch, let_go),
        cmocka_unit_test_teardown(test_hop_is_no_speed, let_go),
        cmocka_unit_test_teardown(test_no_damage, let_go),
        cmocka_unit_test_teardown(test_precrack_that_never_grew, let_go),
        cmocka_unit_test_teardown(test_everything_at_once, let_go),
        cmocka_unit_test_teardown(test_hole_is_jumped, let_go),
        cmocka_unit_test_teardown(test_reads_a_run, let_go),
    };
    kr_run_tests(tests);
}
