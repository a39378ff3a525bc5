# SPDX-License-Identifier: BSD-3-Clause
"""Cells from their faces, for from_fluent.py: a face knows the cells on its two sides, a cell nothing. The nodes of
a face turn about an axis into its first cell, and in 2D it lies to the left of the way from the first node to the
second; or all have it the other way round.
"""
import numpy as np

from body import NODES, stop

# Kind of a cell by its triangles and quadrilaterals (in 2D by its edges), and Fluent's number of the kind.
SOLIDS = {(4, 0): ("tetra", 2), (0, 6): ("hexahedron", 4), (4, 1): ("pyramid", 5), (2, 3): ("wedge", 6)}
PLANES = {3: ("triangle", 1), 4: ("quad", 3)}


class Faces:
    """All faces: rows of nodes (up to 4, then -1; from 0), how many, the cells on both sides, the zone's number."""

    def __init__(self, total):
        self.nodes = np.full((total, 4), -1, dtype=np.int64)
        self.count = np.zeros(total, dtype=np.int64)
        self.cells = np.zeros((total, 2), dtype=np.int64)
        self.sections = []  # (first, last, zone, boundary, line of the section, line of the first face)

    def name(self, row):
        for first, last, _, _, head, line in self.sections:
            if first <= row < last:
                return f"face {row + 1} (line {line + row - first if line else head})"
        return f"face {row + 1}"


class Sides:
    """The faces as their cells see them, cell after cell."""

    def __init__(self, faces, swapped):
        cell, face = faces.cells.T.reshape(-1), np.tile(np.arange(len(faces.count)), 2)
        turned = np.repeat([swapped, not swapped], len(faces.count))
        order = np.argsort(cell, kind="stable")
        order = order[cell[order] > 0]
        self.cell, self.face, self.turned = cell[order] - 1, face[order], turned[order]
        self.faces = faces

    def walks(self, first, many):
        """Nodes of the faces of cells whose sides begin at `first`, (n, many, 4): a walk round each that turns about
        an axis into the cell (in 2D along it, with the cell to the left)."""
        at = first[:, None] + np.arange(many)
        nodes, count = self.faces.nodes[self.face[at]], self.faces.count[self.face[at]][..., None]
        back = np.take_along_axis(nodes, (count - 1 - np.arange(4)) % 4, axis=2)
        back = np.where(np.arange(4) < count, back, -1)
        return np.where(self.turned[at][..., None], back, nodes)


def is_swapped(points, faces):
    """Whether the boundary encloses a negative area or volume: then the file has c0 where c1 should be."""
    rim = np.flatnonzero((faces.cells == 0).any(axis=1))
    sign = np.where(faces.cells[rim, 0] > 0, 1.0, -1.0)
    x = (points - points.mean(axis=0))[faces.nodes[rim]]
    if faces.count.max() == 2:
        return np.dot(sign, x[:, 0, 0] * x[:, 1, 1] - x[:, 0, 1] * x[:, 1, 0]) < 0
    fan, quad = np.cross(x[:, 1], x[:, 2]), faces.count[rim] == 4
    fan[quad] += np.cross(x[quad, 2], x[quad, 3])
    return np.dot(sign, (x[:, 0] * fan).sum(axis=1)) > 0  # the axes point into the body


def polygon(walks):
    """Corners of plane cells by walking along their edges, and whether the walk closes."""
    begin, end, each = walks[..., 0], walks[..., 1], np.arange(len(walks))
    corners, good = [begin[:, 0]], np.ones(len(walks), dtype=bool)
    for _ in range(walks.shape[1]):
        here = begin == corners[-1][:, None]
        good &= here.sum(axis=1) == 1
        corners.append(end[each, here.argmax(axis=1)])
    return np.stack(corners[:-1], axis=1), good & (corners[-1] == corners[0])


def solid(walks, kind):
    """Corners of solid cells: a base, and the other ends of the edges that lead away from it; and whether the faces
    close. The walk round the base is that of a cell's first nodes in VTK: about an axis into the cell."""
    n, size = len(walks), (walks >= 0).sum(axis=2, keepdims=True)
    begin = walks.reshape(n, -1)
    end = np.where(np.arange(4) == size - 1, walks[..., :1], np.roll(walks, -1, axis=2)).reshape(n, -1)
    width = 3 if kind in ("tetra", "wedge") else 4
    first = (size[..., 0] == width).argmax(axis=1)
    base, each = walks[np.arange(n), first, :width], np.arange(n)
    leaves, corners = ~(end[:, :, None] == base[:, None, :]).any(axis=2), list(base.T)
    for corner in base.T:
        corners.append(end[each, ((begin == corner[:, None]) & leaves).argmax(axis=1)])
    corners = np.stack(corners, axis=1)[:, :NODES[kind]]
    # Each edge is walked there and back, and the cell has no more nodes than its kind, all of them corners.
    far = begin.max() + 2
    end = np.where(begin < 0, -1, end)
    there, back = np.sort(begin * far + end, axis=1), np.sort(end * far + begin, axis=1)
    good = (there == back).all(axis=1)
    for nodes in (corners, begin):
        nodes = np.sort(nodes, axis=1)
        good &= (np.diff(nodes, axis=1) > 0).sum(axis=1) + (nodes[:, 0] >= 0) == NODES[kind]
    return corners, good


def add_zones(body, mesh, block, cells):
    """Sets of the cells of a block: where `cells` lie in the zones."""
    for zone, first, last, _ in mesh.cell_zones:
        rows = np.flatnonzero((first <= cells) & (cells < last))
        body.add_cells(mesh.names.get(zone, f"zone_{zone}"), block, rows)


def add_cells(body, mesh, total):
    """All cells, kind by kind, in their order."""
    faces = mesh.faces
    sides = Sides(faces, is_swapped(mesh.points, faces))
    count = np.bincount(sides.cell, minlength=total)
    quads = np.bincount(sides.cell, weights=faces.count[sides.face] == 4, minlength=total).astype(int)
    begin = np.concatenate([[0], np.cumsum(count)])[:-1]
    declared = np.zeros(total, dtype=int)
    for _, first, last, number in mesh.cell_zones:
        declared[first:last] = number
    for many, four in np.unique(np.stack([count, quads], axis=1), axis=0).tolist():
        cells = np.flatnonzero((count == many) & (quads == four))
        kind, number = (PLANES.get(many) if mesh.dimension == 2 else SOLIDS.get((many - four, four))) or (None, 0)
        if not kind:
            stop(f"cell {cells[0] + 1} has {many} faces, {four} of them with four nodes; polygons and polyhedra are "
                 "not read: write the mesh as it was before its cells were made such, or refined with hanging nodes")
        walks = sides.walks(begin[cells], many)
        corners, good = polygon(walks) if mesh.dimension == 2 else solid(walks, kind)
        good &= (declared[cells] == 0) | (declared[cells] == number)
        if not good.all():
            cell = int(cells[good.argmin()])
            stop(f"cell {cell + 1}: its {many} faces, the first of them {faces.name(int(sides.face[begin[cell]]))}, "
                 f"make no {kind}: they do not close, do not turn the same way, or the file says another kind")
        add_zones(body, mesh, body.add_block(kind, corners, cells + 1), cells)
