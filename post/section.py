# SPDX-License-Identifier: BSD-3-Clause
"""What a plane cuts of the cells of a solid: each cell is taken apart into tetrahedra."""
import numpy as np

from results import Fault

# Solids of few corners as tetrahedra, and their faces; the order is VTK's.
TETRAHEDRA = {
    "tetrahedron": [[0, 1, 2, 3]],
    "pyramid": [[0, 1, 2, 4], [0, 2, 3, 4]],
    "wedge": [[0, 1, 2, 3], [1, 2, 3, 4], [2, 3, 4, 5]],
    "hexahedron": [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]],
}
FACES = {
    "tetrahedron": [[0, 1, 2], [0, 1, 3], [1, 2, 3], [0, 2, 3]],
    "pyramid": [[0, 1, 2, 3], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
    "wedge": [[0, 1, 2], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]],
    "hexahedron": [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]],
}
KINDS = {4: "tetrahedron", 10: "tetrahedron", 5: "pyramid", 13: "pyramid", 6: "wedge", 15: "wedge",
         8: "hexahedron", 20: "hexahedron"}


def cut_cells(cells, plane, middle, reach):
    """What a plane (axis, level) cuts of all cells (Case.cells) within the reach of the middle: polygons (corners
    x 2), the cell that each is of, lines in which it cuts faces, and how many cells."""
    point, first, vertex, _, spacing = cells
    axis, level = plane
    shown = [d for d in range(3) if d != axis]
    height = point[:, axis] - level - 1e-6 * spacing  # no corner lies in the plane itself
    seen = cells_across(point, first, vertex, height, middle, reach, shown)
    if not len(seen):
        raise Fault("the plane %s = %.4g mm cuts no cell there" % ("xyz"[axis], level))
    solids, owners, faces = pieces(first, vertex, seen)
    polygons, of = cut_tetrahedra(point, height, solids, owners, shown)
    return polygons, of, cut_faces(point, height, faces, shown), len(seen)


def cells_across(point, first, vertex, height, middle, reach, shown):
    """Cells in the picture with corners on both sides of the plane."""
    start = first[:-1]
    tops = np.maximum.reduceat(height[vertex], start)
    bottoms = np.minimum.reduceat(height[vertex], start)
    corner = point[vertex[start]]
    near = (np.abs(corner[:, shown] - middle[shown]) < reach).all(axis=1)
    return np.flatnonzero((tops > 0) & (bottoms < 0) & near)


def pieces(first, vertex, seen):
    """Tetrahedra of cells, their cells, and the faces of each cell as lists of corners."""
    solids, owners, faces = [], [], []
    for k in seen:
        corner = vertex[first[k]:first[k + 1]]
        kind = KINDS.get(len(corner))
        if kind:
            parts = corner[TETRAHEDRA[kind]]
            faces += [corner[f] for f in FACES[kind]]
        else:
            parts = corner.reshape(-1, 4)
            sides = np.concatenate([parts[:, f] for f in FACES["tetrahedron"]])
            _, where, count = np.unique(np.sort(sides, axis=1), axis=0, return_index=True,
                                        return_counts=True)
            faces += list(sides[where[count == 1]])  # those between two of the pieces lie inside
        solids.append(parts)
        owners.append(np.full(len(parts), k))
    return np.concatenate(solids), np.concatenate(owners), faces


def crossing(point, height, p, q, shown):
    """Where the edges from p to q go through the plane."""
    t = (height[p] / (height[p] - height[q]))[..., None]
    return (point[p] + t * (point[q] - point[p]))[..., shown]


def cut_tetrahedra(point, height, solids, owners, shown):
    """Triangles and quadrilaterals that a plane cuts out of tetrahedra, and the cells they are of."""
    order = np.argsort(height[solids] > 0, axis=1, kind="stable")  # those below come first
    solids = np.take_along_axis(solids, order, axis=1)
    below = (height[solids] < 0).sum(axis=1)
    polygons, of = [], []
    for count, edges in ((1, [(0, 1), (0, 2), (0, 3)]), (3, [(3, 0), (3, 1), (3, 2)]),
                         (2, [(0, 2), (0, 3), (1, 3), (1, 2)])):
        some = solids[below == count]
        corners = [crossing(point, height, some[:, a], some[:, b], shown) for a, b in edges]
        polygons += list(np.stack(corners, axis=1))
        of.append(owners[below == count])
    return polygons, np.concatenate(of)


def cut_faces(point, height, faces, shown):
    """Lines in which a plane cuts faces of three and of four corners."""
    lines = []
    for n in (3, 4):
        some = np.array([f for f in faces if len(f) == n]).reshape(-1, n)
        if not len(some):
            continue
        after = np.roll(some, -1, axis=1)
        cut = (height[some] > 0) != (height[after] > 0)
        twice = cut.sum(axis=1) == 2  # a bent face may be met four times: left out
        p, q = some[twice][cut[twice]], after[twice][cut[twice]]
        lines += list(crossing(point, height, p, q, shown).reshape(-1, 2, 2))
    return lines
