# SPDX-License-Identifier: BSD-3-Clause
"""A mesh on its way to MSH: points, blocks of cells by meshio's kinds, and named sets; for to_msh.py.
The readers from_*.py fill it, write_msh.py writes it.
"""
import re
import sys

import numpy as np

# meshio's names: gmsh's number, dimension, and the order of gmsh in terms of meshio's (VTK's).
KINDS = {
    "vertex": (15, 0, None), "line": (1, 1, None), "line3": (8, 1, None),
    "triangle": (2, 2, None), "triangle6": (9, 2, None), "quad": (3, 2, None),
    "quad8": (16, 2, None), "quad9": (10, 2, None), "tetra": (4, 3, None),
    "tetra10": (11, 3, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]), "hexahedron": (5, 3, None),
    "hexahedron20": (17, 3, [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14]),
    "hexahedron27": (12, 3, [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14,
                             24, 22, 20, 21, 23, 25, 26]),
    "wedge": (6, 3, None),
    "wedge15": (18, 3, [0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10]),
    "pyramid": (7, 3, None),
    "pyramid13": (19, 3, [0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12]),
}
NODES = {"vertex": 1, "line": 2, "line3": 3, "triangle": 3, "triangle6": 6, "quad": 4, "quad8": 8,
         "quad9": 9, "tetra": 4, "tetra10": 10, "hexahedron": 8, "hexahedron20": 20,
         "hexahedron27": 27, "wedge": 6, "wedge15": 15, "pyramid": 5, "pyramid13": 13}


def stop(sentence):
    """An end that the user can cure: kirsch-nodes shows the line that begins so."""
    print("Error: " + sentence, file=sys.stderr)
    sys.exit(1)


def note(sentence):
    print("Note: " + sentence, file=sys.stderr)


class Body:
    """Points, blocks of cells (kind, connectivity), and sets.

    cells: name -> list of (block, rows);  points: name -> numbers;  sides: name -> corner lists
    """

    def __init__(self, points):
        self.points = np.zeros((len(points), 3))
        self.points[:, : np.shape(points)[1]] = points
        self.point_tags = None
        self.blocks, self.tags = [], []
        self.cells, self.point_sets, self.sides = {}, {}, {}

    def add_block(self, kind, rows, tags=None):
        rows = np.asarray(rows, dtype=np.int64)
        if re.fullmatch(r"polygon\d*", kind) and rows.ndim == 2 and rows.shape[1] in (3, 4):
            kind = "triangle" if rows.shape[1] == 3 else "quad"
        if kind not in KINDS:
            stop(f"elements of kind '{kind}' are not read; expected lines, triangles, "
                 "quadrilaterals, tetrahedra, hexahedra, wedges and pyramids of order 1 or 2")
        wanted = NODES[kind]
        if rows.ndim != 2 or rows.shape[1] != wanted:
            stop(f"elements of kind '{kind}' have {rows.shape[-1]} nodes; expected {wanted}")
        if rows.size and (rows.min() < 0 or rows.max() >= len(self.points)):
            stop(f"an element has the node {rows.max()}, and there are {len(self.points)}")
        self.blocks.append((kind, rows))
        self.tags.append(tags)
        return len(self.blocks) - 1

    def add_cells(self, name, block, rows):
        if len(rows):
            self.cells.setdefault(name, []).append((block, np.unique(np.asarray(rows, np.int64))))


class Points:
    """Points with volumes instead of cells: columns of a table that kirsch-nodes reads."""

    def __init__(self, columns):
        self.columns = columns

    def write(self, path):
        with open(path, "w") as file:
            file.write(",".join(self.columns) + "\n")
            for row in zip(*(column.tolist() for column in self.columns.values())):
                file.write(",".join(map(repr, row)) + "\n")


# Ends of the edges on whose middles the nodes behind the corners stand, in the order of VTK.
EDGES = {
    "triangle6": [(0, 1), (1, 2), (2, 0)], "quad8": [(0, 1), (1, 2), (2, 3), (3, 0)],
    "quad9": [(0, 1), (1, 2), (2, 3), (3, 0)],
    "tetra10": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    "hexahedron20": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5),
                     (2, 6), (3, 7)],
    "wedge15": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    "pyramid13": [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)],
}
EDGES["hexahedron27"] = EDGES["hexahedron20"]
CORNERS = {"triangle6": 3, "quad8": 4, "quad9": 4, "tetra10": 4, "hexahedron20": 8,
           "hexahedron27": 8, "wedge15": 6, "pyramid13": 5}


def middles(kind, nodes, corners):
    if kind not in EDGES:
        return []
    ends = corners[:1] + corners[1:]
    pairs = [(ends[k], ends[(k + 1) % len(ends)]) for k in range(len(ends))]
    if len(corners) == 2:
        pairs = pairs[:1]
    edge = {frozenset(e): nodes[CORNERS[kind] + k] for k, e in enumerate(EDGES[kind])}
    return [edge[frozenset(p)] for p in pairs]
