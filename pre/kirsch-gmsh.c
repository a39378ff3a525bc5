/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-gmsh: fill one region with quadrilaterals by gmsh. kirsch-mesh runs it, once a region and
 * in a process of its own, because gmsh 4.8 may abort, hang or return a wrong mesh without a word.
 *
 * It reads a request on standard input, writes the mesh on standard output and all that gmsh says
 * on standard error; both are text and documented in gmsh.h. Every boundary line is transfinite:
 * gmsh may put no point of its own on the boundary. It exits 0 when it has written a mesh; whether
 * the mesh is right, kirsch-mesh finds out for itself.
 *
 * With `--body FORMAT SIZE` standard input is a body of CAD (step, iges, brep; lengths are turned into metres), which
 * it meshes with cells of that size and writes as KR_GMSH_BODY, MSH 4.1. The body becomes the group `body`, each
 * curve (2D) or surface (3D) of its boundary a group `side_N`, N as gmsh shows it.
 *
 * With `--curves FORMAT` it tells the curves around each plane face of such a file (cad.h).
 */
#include "called.h"
#include "foreign.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/** What a request asks for, its loops aside. */
struct order {
    int algorithm;     /* Mesh.Algorithm */
    int recombination; /* Mesh.RecombinationAlgorithm */
    double size;       /* length of a side, in spacings */
    int n_loops;
};

static void set_options(const struct order *order) {
    set("General.Terminal", 1);
    set("General.Verbosity", 2);    /* errors and warnings only */
    set("General.NumThreads", 1);   /* more differ from run to run */
    set("General.AbortOnError", 0); /* the log then says what was wrong */
    set("Mesh.Algorithm", order->algorithm);
    set("Mesh.RecombinationAlgorithm", order->recombination);
    set("Mesh.RecombineAll", 1);
    set("Mesh.CharacteristicLengthMin", order->size);
    set("Mesh.CharacteristicLengthMax", order->size);
}

/** Read one closed loop of points and make its lines, each with its number of segments. Points
 *  and lines share the numbers that follow `*last`. */
static int read_loop(int *last) {
    int n, segments, first = *last + 1;
    double x, y;
    if (scanf(" loop %d", &n) != 1 || n < 3)
        fail("bad loop");
    int *line = room((size_t)n, sizeof *line), *count = room((size_t)n, sizeof *count);
    for (int k = 0; k < n; k++) {
        if (scanf("%lf %lf %d", &x, &y, &segments) != 3 || segments < 1)
            fail("bad point");
        gmshModelGeoAddPoint(x, y, 0, 0, first + k, &trouble);
        called("a point");
        line[k] = first + k;
        count[k] = segments;
    }
    for (int k = 0; k < n; k++) {
        gmshModelGeoAddLine(first + k, first + (k + 1) % n, first + k, &trouble);
        called("a line");
        gmshModelGeoMeshSetTransfiniteCurve(first + k, count[k] + 1, "Progression", 1, &trouble);
        called("the cells of a line");
    }
    *last += n;
    int loop = gmshModelGeoAddCurveLoop(line, (size_t)n, -1, 0, &trouble);
    called("a loop");
    free(line);
    free(count);
    return loop;
}

/** Nodes in the order in which they are written, and the place of each by gmsh's number. */
struct nodes {
    size_t count, room;
    double *place; /* (count x 2) */
    size_t most, *number;
};

static void count_nodes(struct nodes *nodes) {
    size_t *tag, n_coordinates, n_parameters;
    double *coordinate, *parameter;
    gmshModelMeshGetNodes(&tag, &nodes->room, &coordinate, &n_coordinates, &parameter,
                          &n_parameters, -1, -1, 0, 0, &trouble);
    called("counting the nodes");
    for (size_t i = 0; i < nodes->room; i++)
        nodes->most = tag[i] > nodes->most ? tag[i] : nodes->most;
    gmshFree(tag);
    gmshFree(coordinate);
    gmshFree(parameter);
}

/** Add the nodes of one point (dim 0), inner nodes of one line (1) or of the surface (2). */
static void add_nodes(struct nodes *nodes, int dim, int which) {
    size_t *tag, n, n_coordinates, n_parameters;
    double *coordinate, *parameter;
    gmshModelMeshGetNodes(&tag, &n, &coordinate, &n_coordinates, &parameter, &n_parameters, dim,
                          which, 0, 0, &trouble);
    called("reading the nodes");
    for (size_t i = 0; i < n; i++) {
        if (nodes->count == nodes->room || tag[i] > nodes->most)
            fail("there are more nodes than gmsh said");
        nodes->place[2 * nodes->count] = coordinate[3 * i];
        nodes->place[2 * nodes->count + 1] = coordinate[3 * i + 1];
        nodes->number[tag[i]] = nodes->count++;
    }
    gmshFree(tag);
    gmshFree(coordinate);
    gmshFree(parameter);
}

/** Write the mesh; the nodes of the loops come first, each line's in the order of its sense. */
static void write_mesh(FILE *file, int n_lines) {
    struct nodes nodes = {0, 0, NULL, 0, NULL};
    count_nodes(&nodes);
    nodes.place = room(2 * nodes.room, sizeof *nodes.place);
    nodes.number = room(nodes.most + 1, sizeof *nodes.number);
    for (int k = 1; k <= n_lines; k++) {
        add_nodes(&nodes, 0, k);
        add_nodes(&nodes, 1, k);
    }
    add_nodes(&nodes, 2, 1);
    fprintf(file, "nodes %zu\n", nodes.count);
    for (size_t i = 0; i < nodes.count; i++)
        fprintf(file, "%.17g %.17g\n", nodes.place[2 * i], nodes.place[2 * i + 1]);
    for (int corners = 3; corners <= 4; corners++) {
        size_t *cell, *vertex, n_cells, n_vertices;
        gmshModelMeshGetElementsByType(corners == 3 ? 2 : 3, &cell, &n_cells, &vertex, &n_vertices,
                                       -1, 0, 1, &trouble);
        called("reading the cells");
        fprintf(file, "cells %zu\n", n_cells);
        for (size_t c = 0; c < n_cells; c++) {
            fprintf(file, "%d", corners);
            for (int k = 0; k < corners; k++)
                fprintf(file, " %zu", nodes.number[vertex[(size_t)corners * c + (size_t)k]]);
            fputc('\n', file);
        }
        gmshFree(cell);
        gmshFree(vertex);
    }
    fprintf(file, "end\n");
    free(nodes.place);
    free(nodes.number);
}

/** All entities of a dimension into groups: one for all, or one each. */
static void group_entities(int dim, const char *all) {
    int *pair;
    size_t n;
    gmshModelGetEntities(&pair, &n, dim, &trouble);
    called("the parts of the body");
    int *tag = room(n, sizeof *tag);
    for (size_t k = 0; k < n / 2; k++) {
        char name[40];
        tag[k] = pair[2 * k + 1];
        snprintf(name, sizeof name, "side_%d", tag[k]);
        if (all)
            continue;
        int group = gmshModelAddPhysicalGroup(dim, &tag[k], 1, -1, &trouble);
        gmshModelSetPhysicalName(dim, group, name, &trouble);
    }
    if (all) {
        int group = gmshModelAddPhysicalGroup(dim, tag, n / 2, -1, &trouble);
        gmshModelSetPhysicalName(dim, group, all, &trouble);
    }
    called("the groups");
    free(tag);
    gmshFree(pair);
}

/** The body on standard input: by its descriptor, for a file's own name would move what gmsh allocates. */
static void read_body(const char *format) {
    int *shape;
    size_t n;
    gmshModelOccImportShapes("/proc/self/fd/0", &shape, &n, 0, format, &trouble);
    called("reading the file");
    gmshModelOccSynchronize(&trouble);
    called("reading the file");
    gmshFree(shape);
}

static void mesh_body(const char *format, double size) {
    set("General.Terminal", 1);
    set("General.Verbosity", 2);
    set("General.NumThreads", 1);
    set("General.AbortOnError", 0);
    gmshOptionSetString("Geometry.OCCTargetUnit", "M", &trouble);
    called("the unit");
    read_body(format);
    int dim = gmshModelGetDimension(&trouble);
    called("the dimension");
    if (dim < 2)
        fail("the file holds neither a plane face nor a solid");
    group_entities(dim, "body");
    group_entities(dim - 1, NULL);
    set("Mesh.CharacteristicLengthMin", size);
    set("Mesh.CharacteristicLengthMax", size);
    set("Mesh.RecombineAll", dim == 2);
    gmshModelMeshGenerate(dim, &trouble);
    called("meshing");
    set("Mesh.MshFileVersion", 4.1);
    set("Mesh.Binary", 1);
    gmshWrite(KR_GMSH_BODY, &trouble);
    called("writing the mesh");
}

/** One curve: points evenly in its parameter, and derivatives. Millimetres become metres. */
static void tell_curve(FILE *file, int tag, const char *kind, int points, double *low_z,
                       double *high_z) {
    double *least, *most, *at, *along, *parameter = room((size_t)points, sizeof *parameter);
    size_t n;
    gmshModelGetParametrizationBounds(1, tag, &least, &n, &most, &n, &trouble);
    called("the range of a curve");
    for (int k = 0; k < points; k++)
        parameter[k] = least[0] + (most[0] - least[0]) * k / (points - 1);
    gmshModelGetValue(1, tag, parameter, (size_t)points, &at, &n, &trouble);
    called("points of a curve");
    gmshModelGetDerivative(1, tag, parameter, (size_t)points, &along, &n, &trouble);
    called("directions of a curve");
    fprintf(file, "curve %s %d %.17g\n", kind, points, most[0] - least[0]);
    for (int k = 0; k < points; k++) {
        *low_z = fmin(*low_z, at[3 * k + 2]);
        *high_z = fmax(*high_z, at[3 * k + 2]);
        fprintf(file, "%.17g %.17g %.17g %.17g\n", at[3 * k] / 1e3, at[3 * k + 1] / 1e3,
                along[3 * k] / 1e3, along[3 * k + 1] / 1e3);
    }
    gmshFree(least);
    gmshFree(most);
    gmshFree(at);
    gmshFree(along);
    free(parameter);
}

static void tell_face(FILE *file, int face, double *low_z, double *high_z) {
    int pair[2] = {2, face}, *edge;
    size_t n;
    gmshModelGetBoundary(pair, 2, &edge, &n, 0, 0, 0, &trouble);
    called("the edges of a face");
    fprintf(file, "face %zu\n", n / 2);
    for (size_t k = 0; k < n / 2; k++) {
        char *kind;
        gmshModelGetType(1, edge[2 * k + 1], &kind, &trouble);
        called("the kind of a curve");
        if (!strcmp(kind, "Line"))
            tell_curve(file, edge[2 * k + 1], "line", 2, low_z, high_z);
        else if (!strcmp(kind, "Circle") || !strcmp(kind, "Ellipse"))
            tell_curve(file, edge[2 * k + 1], "round", 3, low_z, high_z);
        else
            tell_curve(file, edge[2 * k + 1], "other", 257, low_z, high_z);
        gmshFree(kind);
    }
    gmshFree(edge);
}

/** The curves around the faces of a file of CAD; see cad.h. */
static void tell_curves(const char *format, FILE *file) {
    int *face, *solid;
    size_t n, n_solids;
    double low_z = INFINITY, high_z = -INFINITY, size = 0;
    set("General.Terminal", 1);
    set("General.Verbosity", 2);
    set("General.AbortOnError", 0);
    gmshOptionSetString("Geometry.OCCTargetUnit", "MM", &trouble);
    called("the unit");
    read_body(format);
    gmshModelGetEntities(&solid, &n_solids, 3, &trouble);
    gmshModelGetEntities(&face, &n, 2, &trouble);
    called("the faces");
    if (n_solids)
        fail("the file holds a solid, where an outline is a plane face in a plane of constant z; "
             "export the face alone");
    if (!n)
        fail("the file holds no face, where an outline is a plane face in a plane of constant z; a "
             "closed line alone is none");
    fprintf(file, "faces %zu\n", n / 2);
    for (size_t k = 0; k < n / 2; k++) {
        double box[6];
        gmshModelGetBoundingBox(2, face[2 * k + 1], &box[0], &box[1], &box[2], &box[3], &box[4],
                                &box[5], &trouble);
        called("the size of a face");
        size = fmax(size, fmax(box[3] - box[0], box[4] - box[1]));
        tell_face(file, face[2 * k + 1], &low_z, &high_z);
    }
    if (!(high_z - low_z <= 1e-6 * size))
        fail("the face does not lie in a plane of constant z; turn it into the plane of x and y");
    fprintf(file, "end\n");
    gmshFree(face);
    gmshFree(solid);
}

int main(int argc, char **argv) {
    struct order order;
    if (argc == 3 && !strcmp(argv[1], "--curves")) {
        FILE *file = fdopen(dup(1), "w");
        if (!file || dup2(2, 1) < 0)
            fail("no standard output");
        gmshInitialize(0, NULL, 0, &trouble);
        called("starting gmsh");
        tell_curves(argv[2], file);
        if (fclose(file))
            fail("the curves cannot be written");
        fflush(NULL);
        _exit(0);
    }
    if (argc == 4 && !strcmp(argv[1], "--body")) {
        gmshInitialize(0, NULL, 0, &trouble);
        called("starting gmsh");
        mesh_body(argv[2], strtod(argv[3], NULL));
        gmshFinalize(&trouble);
        return 0;
    }
    if (scanf(" region algorithm %d recombination %d size %lf loops %d", &order.algorithm,
              &order.recombination, &order.size, &order.n_loops) != 4 ||
        order.n_loops < 1)
        fail("this program is run by kirsch-mesh; its request is bad");
    /* gmsh writes what it likes to standard output: the mesh leaves by another way. */
    FILE *out = fdopen(dup(1), "w");
    if (!out || dup2(2, 1) < 0)
        fail("no standard output");

    gmshInitialize(0, NULL, 0, &trouble);
    called("starting gmsh");
    set_options(&order);
    int *loop = room((size_t)order.n_loops, sizeof *loop), last = 0;
    for (int k = 0; k < order.n_loops; k++)
        loop[k] = read_loop(&last);
    gmshModelGeoAddPlaneSurface(loop, (size_t)order.n_loops, 1, &trouble);
    called("the surface");
    gmshModelGeoSynchronize(&trouble);
    called("synchronising");
    gmshModelMeshGenerate(2, &trouble);
    called("meshing");
    write_mesh(out, last);
    if (fclose(out))
        fail("the mesh cannot be written");
    fflush(NULL);
    _exit(0); /* what gmsh holds or forgot goes with the process, without its tidying up */
}
