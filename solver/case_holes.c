/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The holes of a case: those of the deck, and those that kirsch-pores left in the case's folder.
 */
#include "base/error.h"
#include "base/memory.h"
#include "base/unit.h"
#include "case.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int kr_case_has_pores(const struct kr_case *c) {
    return c->pores.count > 0 || c->pores.porosity > 0 || (c->pores.file && *c->pores.file);
}

/* Read a line "x y radius" or, for an ellipse, "x y long short degrees"; returns how many numbers
   there are, 0 for a line without any, -1 if it is bad. */
static int read_hole(const char *line, struct kr_case_hole *hole) {
    const char *blank = " \t\r\n";
    double value[6] = {0};
    int n = 0;
    line += strspn(line, blank);
    for (; *line && *line != '#' && n < 6; n++) {
        const char *end = kr_unit_number(line, &value[n]);
        if (!end || (*end && !strchr(" \t\r\n#", *end)))
            return -1;
        line = end + strspn(end, blank);
    }
    memcpy(hole->centre, value, sizeof hole->centre);
    hole->radius = value[2];
    if (n == 5) {
        hole->shape = KR_HOLE_ELLIPSE;
        memcpy(hole->radii, value + 2, sizeof hole->radii);
        hole->radius = 0;
        hole->angle = value[4] * M_PI / 180;
    }
    return n;
}

/* Whether the first line is that of the plates paper: a whole number alone, of pores in mm. */
static int is_count(int found, const struct kr_case_hole *hole) {
    return found == 1 && hole->centre[0] >= 0 && hole->centre[0] == floor(hole->centre[0]) &&
           hole->centre[0] <= 1e9;
}

static void from_millimetres(struct kr_case_hole *hole) {
    double *length[] = {&hole->centre[0], &hole->centre[1], &hole->radius, &hole->radii[0],
                        &hole->radii[1]};
    for (size_t k = 0; k < sizeof length / sizeof *length; k++)
        *length[k] /= 1e3;
}

/* Stop unless a hole of pores.txt is a hole of this plate. */
static void check_hole(const struct kr_case *c, const struct kr_case_hole *hole, const char *path,
                       size_t line) {
    double x = fmax(fmax(-hole->centre[0], hole->centre[0] - c->width), 0);
    double y = fmax(fmax(-hole->centre[1], hole->centre[1] - c->height), 0);
    int is_circle = hole->shape == KR_HOLE_CIRCLE;
    double radius = is_circle ? hole->radius : fmax(hole->radii[0], hole->radii[1]);
    double least = is_circle ? radius : fmin(hole->radii[0], hole->radii[1]);
    if (!(least > 0) || 2 * radius > fmax(c->width, c->height))
        kr_stop(KR_EXIT_INPUT,
                "%s:%zu: found a radius of %g m, expected one above 0 that fits the plate", path,
                line, least > 0 ? radius : least);
    if (hypot(x, y) >= radius)
        kr_stop(KR_EXIT_INPUT, "%s:%zu: the pore at (%g, %g) m lies outside the plate", path, line,
                hole->centre[0], hole->centre[1]);
}

/* Append the pores of a file to the holes. */
static struct kr_case_hole *read_pores(const struct kr_case *c, const char *path, const char *cure,
                                       struct kr_case_hole *holes, size_t *count) {
    FILE *file = fopen(path, "r");
    char *line = NULL;
    size_t room = *count, line_room = 0, first = *count;
    double said = -1; /* how many pores the first line says there are */
    if (!file)
        kr_stop(KR_EXIT_INPUT, "%s cannot be read: %s; %s", path, strerror(errno), cure);
    for (size_t number = 1; getline(&line, &line_room, file) >= 0; number++) {
        struct kr_case_hole hole = {.radius = 0};
        int found = read_hole(line, &hole);
        if (said < 0 && *count == first && is_count(found, &hole)) {
            said = hole.centre[0];
            continue;
        }
        if (found != 0 && found != 3 && found != 5)
            kr_stop(KR_EXIT_INPUT, "%s:%zu: found '%.*s', expected 'x y radius' in metres", path,
                    number, (int)fmin((double)strcspn(line, "\r\n"), 60), line);
        if (!found)
            continue;
        if (said >= 0)
            from_millimetres(&hole);
        check_hole(c, &hole, path, number);
        KR_GROW(holes, *count, room);
        holes[(*count)++] = hole;
    }
    if (ferror(file))
        kr_stop(KR_EXIT_INPUT, "%s cannot be read to its end: %s", path, strerror(errno));
    if (said >= 0 && said != (double)(*count - first))
        kr_stop(KR_EXIT_INPUT, "%s: its first line says %.0f pores, and %zu follow", path, said,
                *count - first);
    free(line);
    fclose(file);
    return holes;
}

struct kr_case_hole *kr_case_read_pores(const struct kr_case *c, const char *path, size_t *count) {
    *count = 0;
    return read_pores(c, path, "geometry.pores.file names it", NULL, count);
}

struct kr_case_hole *kr_case_holes(const struct kr_case *c, size_t *count) {
    struct kr_case_hole *holes = KR_NEW(struct kr_case_hole, c->holes.count);
    *count = c->holes.count;
    if (*count)
        memcpy(holes, c->holes.item, *count * sizeof *holes);
    if (!kr_case_has_pores(c) || c->pores.shape == KR_PORE_SPHERE)
        return holes;
    char *path = kr_case_file(c, "pores.txt");
    holes = read_pores(c, path, "kirsch-pores makes it", holes, count);
    if (c->pores.count && *count - c->holes.count != (size_t)c->pores.count)
        kr_warn("%s has %zu pores, the deck asks for %lld", path, *count - c->holes.count,
                (long long)c->pores.count);
    kr_free(path);
    return holes;
}

/* Read a line "x y z radius"; returns 1, 0 for a line without numbers, -1 if it is bad. */
static int read_sphere(const char *line, struct kr_case_void *sphere) {
    double value[4];
    char rest = '#';
    int found = sscanf(line, "%lf %lf %lf %lf %c", &value[0], &value[1], &value[2], &value[3], &rest);
    *sphere = (struct kr_case_void){.shape = KR_VOID_SPHERE};
    if (found <= 0)
        return line[strspn(line, " \t\r\n")] == '#' || !line[strspn(line, " \t\r\n")] ? 0 : -1;
    if (found < 4 || rest != '#' || !(value[3] > 0))
        return -1;
    memcpy(sphere->centre, value, sizeof sphere->centre);
    sphere->radius = value[3];
    return 1;
}

static int is_within(const struct kr_case *c, const struct kr_case_void *sphere) {
    const double size[3] = {c->width, c->height, c->depth};
    double away = 0;
    for (int d = 0; d < 3; d++)
        away = hypot(away, fmax(fmax(-sphere->centre[d], sphere->centre[d] - size[d]), 0));
    return away < sphere->radius && 2 * sphere->radius <= fmax(fmax(size[0], size[1]), size[2]);
}

struct kr_case_void *kr_case_voids(const struct kr_case *c, size_t *count) {
    size_t room = c->voids.count, line_room = 0;
    struct kr_case_void *voids = KR_NEW(struct kr_case_void, room), sphere;
    char *line = NULL;
    *count = c->voids.count;
    if (*count)
        memcpy(voids, c->voids.item, *count * sizeof *voids);
    if (!kr_case_has_pores(c) || c->pores.shape != KR_PORE_SPHERE)
        return voids;
    char *path = kr_case_file(c, "pores.txt");
    FILE *file = fopen(path, "r");
    if (!file)
        kr_stop(KR_EXIT_INPUT, "%s cannot be read: %s; kirsch-pores makes it", path, strerror(errno));
    for (size_t number = 1; getline(&line, &line_room, file) >= 0; number++) {
        int found = read_sphere(line, &sphere);
        if (found < 0 || (found && !is_within(c, &sphere)))
            kr_stop(KR_EXIT_INPUT,
                    "%s:%zu: found '%.*s', expected 'x y z radius' in metres of a sphere in the body",
                    path, number, (int)fmin((double)strcspn(line, "\r\n"), 60), line);
        if (!found)
            continue;
        KR_GROW(voids, *count, room);
        voids[(*count)++] = sphere;
    }
    if (ferror(file))
        kr_stop(KR_EXIT_INPUT, "%s cannot be read to its end: %s", path, strerror(errno));
    free(line);
    fclose(file);
    kr_free(path);
    return voids;
}
