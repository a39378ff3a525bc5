/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The surface of an STL file through CGAL. Predicates are exact, so "closed" and "inside" are never
 * a matter of rounding; no exception leaves this file.
 */
#include "cgal_surface.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <vector>

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Side = CGAL::Side_of_triangle_mesh<Mesh, Kernel>;

struct kr_surface_mesh {
    Mesh mesh;
    Tree tree;
    std::unique_ptr<Side> side;
};

/** What is wrong with the triangles, NULL if nothing; fills in the mesh. */
static const char *make(size_t n, const double *triangle, Mesh &mesh) {
    std::vector<Point> points;
    std::vector<std::array<std::size_t, 3>> faces;
    for (size_t t = 0; t < n; t++) {
        faces.push_back({3 * t, 3 * t + 1, 3 * t + 2});
        for (size_t k = 0; k < 3; k++) {
            const double *p = triangle + 9 * t + 3 * k;
            points.emplace_back(p[0], p[1], p[2]);
        }
    }
    PMP::merge_duplicate_points_in_polygon_soup(points, faces);
    for (const auto &face : faces)
        if (CGAL::collinear(points[face[0]], points[face[1]], points[face[2]]))
            return "a triangle has no area";
    if (!PMP::orient_polygon_soup(points, faces) || !PMP::is_polygon_soup_a_polygon_mesh(faces))
        return "more than two triangles meet at an edge, or the surface has no inside and outside";
    PMP::polygon_soup_to_polygon_mesh(points, faces, mesh);
    if (mesh.is_empty())
        return "it holds no triangles";
    if (!CGAL::is_closed(mesh))
        return "the surface is not closed: at some edge a triangle has no neighbour";
    if (PMP::does_self_intersect(mesh))
        return "the surface passes through itself";
    PMP::orient_to_bound_a_volume(mesh);
    return PMP::does_bound_a_volume(mesh) ? nullptr : "the surface bounds no volume";
}

struct kr_surface_mesh *kr_surface_mesh_create(size_t n, const double *triangle, char *what,
                                               size_t room) {
    try {
        auto surface = std::make_unique<kr_surface_mesh>();
        if (const char *fault = make(n, triangle, surface->mesh)) {
            std::snprintf(what, room, "%s", fault);
            return nullptr;
        }
        surface->tree.insert(faces(surface->mesh).first, faces(surface->mesh).second, surface->mesh);
        surface->tree.build();
        surface->tree.accelerate_distance_queries();
        surface->side = std::make_unique<Side>(surface->tree);
        return surface.release();
    } catch (const std::exception &trouble) {
        std::snprintf(what, room, "CGAL says: %s", trouble.what());
        return nullptr;
    }
}

double kr_surface_mesh_distance(const struct kr_surface_mesh *surface, const double p[3]) {
    const Point place(p[0], p[1], p[2]);
    const double distance = std::sqrt(surface->tree.squared_distance(place));
    return (*surface->side)(place) == CGAL::ON_BOUNDED_SIDE ? -distance : distance;
}

double kr_surface_mesh_volume(const struct kr_surface_mesh *surface) {
    return PMP::volume(surface->mesh);
}

void kr_surface_mesh_box(const struct kr_surface_mesh *surface, double box[6]) {
    const CGAL::Bbox_3 around = PMP::bbox(surface->mesh);
    for (int d = 0; d < 3; d++) {
        box[d] = around.min(d);
        box[3 + d] = around.max(d);
    }
}

void kr_surface_mesh_free(struct kr_surface_mesh *surface) {
    delete surface;
}
