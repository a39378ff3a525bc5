/* SPDX-License-Identifier: BSD-3-Clause
 *
 * kirsch-gmsh-solid: fill what closed shells of triangles bound with tetrahedra by gmsh. kirsch-mesh
 * runs it, once a region and in a process of its own, for the reasons of kirsch-gmsh.c.
 *
 * Request (standard input) and reply (standard output) are text and documented in fill_solid.h; what
 * gmsh says goes to standard error. The shells are discrete surfaces: gmsh keeps their triangles.
 */
#include "called.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static void set_options(int algorithm, int optimize, double size) {
    set("General.Terminal", 1);
    set("General.Verbosity", 2);
    set("General.NumThreads", 1);
    set("General.AbortOnError", 0);
    set("Mesh.Algorithm3D", algorithm);
    set("Mesh.Optimize", optimize);
    set("Mesh.CharacteristicLengthMin", size);
    set("Mesh.CharacteristicLengthMax", size);
}

/** A shell as a discrete surface with its own points, and the loop around it. */
static int read_shell(int which, size_t *last_node, size_t *last_triangle) {
    size_t n, m;
    if (scanf(" shell points %zu triangles %zu", &n, &m) != 2)
        fail("bad shell");
    double *place = room(3 * n, sizeof *place);
    size_t *node = room(n, sizeof *node), *vertex = room(3 * m, sizeof *vertex);
    size_t *triangle = room(m, sizeof *triangle);
    for (size_t k = 0; k < 3 * n; k++)
        if (scanf("%lf", &place[k]) != 1)
            fail("bad point");
    for (size_t k = 0; k < 3 * m; k++) {
        if (scanf("%zu", &vertex[k]) != 1 || vertex[k] >= n)
            fail("bad triangle");
        vertex[k] += *last_node + 1;
    }
    for (size_t k = 0; k < n; k++)
        node[k] = ++*last_node;
    for (size_t k = 0; k < m; k++)
        triangle[k] = ++*last_triangle;
    gmshModelAddDiscreteEntity(2, which, NULL, 0, &trouble);
    called("a surface");
    gmshModelMeshAddNodes(2, which, node, n, place, 3 * n, NULL, 0, &trouble);
    called("the points of a surface");
    gmshModelMeshAddElementsByType(which, 2, triangle, m, vertex, 3 * m, &trouble);
    called("the triangles of a surface");
    free(place);
    free(node);
    free(vertex);
    free(triangle);
    int loop = gmshModelGeoAddSurfaceLoop(&which, 1, -1, &trouble);
    called("a loop of surfaces");
    return loop;
}

/** New points, and tetrahedra. The points of the shells have kept their numbers. */
static void write_mesh(FILE *file, size_t n_shell_points) {
    size_t *tag, n, n_coordinates, n_parameters, most = 0, *vertex, n_vertices, *cell, n_cells;
    double *place, *parameter;
    gmshModelMeshGetNodes(&tag, &n, &place, &n_coordinates, &parameter, &n_parameters, 3, 1, 0, 0,
                          &trouble);
    called("reading the nodes");
    for (size_t k = 0; k < n; k++)
        most = tag[k] > most ? tag[k] : most;
    most = most > n_shell_points ? most : n_shell_points;
    size_t *number = room(most + 1, sizeof *number);
    for (size_t k = 0; k < n_shell_points; k++)
        number[k + 1] = k + 1;
    fprintf(file, "points %zu\n", n);
    for (size_t k = 0; k < n; k++) {
        number[tag[k]] = n_shell_points + k + 1;
        fprintf(file, "%.17g %.17g %.17g\n", place[3 * k], place[3 * k + 1], place[3 * k + 2]);
    }
    gmshModelMeshGetElementsByType(4, &cell, &n_cells, &vertex, &n_vertices, 1, 0, 1, &trouble);
    called("reading the cells");
    fprintf(file, "cells %zu\n", n_cells);
    for (size_t k = 0; k < 4 * n_cells; k++) {
        if (vertex[k] > most || !number[vertex[k]])
            fail("a cell has a point that is nowhere");
        fprintf(file, "%zu%c", number[vertex[k]] - 1, k % 4 == 3 ? '\n' : ' ');
    }
    fprintf(file, "end\n");
}

int main(void) {
    int algorithm, optimize, n_shells;
    double size;
    if (scanf(" solid algorithm %d optimize %d size %lf shells %d", &algorithm, &optimize, &size,
              &n_shells) != 4 ||
        n_shells < 1)
        fail("this program is run by kirsch-mesh; its request is bad");
    /* gmsh writes what it likes to standard output: the mesh leaves by another way. */
    FILE *out = fdopen(dup(1), "w");
    if (!out || dup2(2, 1) < 0)
        fail("no standard output");
    gmshInitialize(0, NULL, 0, &trouble);
    called("starting gmsh");
    set_options(algorithm, optimize, size);
    int *loop = room((size_t)n_shells, sizeof *loop);
    size_t last_node = 0, last_triangle = 0;
    for (int k = 0; k < n_shells; k++)
        loop[k] = read_shell(k + 1, &last_node, &last_triangle);
    gmshModelGeoAddVolume(loop, (size_t)n_shells, 1, &trouble);
    called("the volume");
    gmshModelGeoSynchronize(&trouble);
    called("synchronising");
    gmshModelMeshGenerate(3, &trouble);
    called("meshing");
    write_mesh(out, last_node);
    if (fclose(out))
        fail("the mesh cannot be written");
    fflush(NULL);
    _exit(0);
}
