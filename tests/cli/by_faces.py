# SPDX-License-Identifier: BSD-3-Clause
"""by_faces.py FROM.msh TO.msh [2|3] [swap]: writes a gmsh mesh as Fluent does, by its faces; for fluent.sh.

2 and 3 write binary sections, with floats of 4 and 8 bytes; `swap` exchanges c0 and c1. The physical groups
become zones of cells and faces, numbered from 9, so that 10 in decimal and a in hexadecimal come up.
"""
import sys

import meshio
import numpy as np

NUMBER = {"triangle": 1, "tetra": 2, "quad": 3, "hexahedron": 4, "pyramid": 5, "wedge": 6}
PLANES = ("triangle", "quad")
# Faces by corners, walked about an axis out of the cell (in 2D: cell to the left).
FACES = {
    "triangle": [(0, 1), (1, 2), (2, 0)], "quad": [(0, 1), (1, 2), (2, 3), (3, 0)],
    "tetra": [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)],
    "hexahedron": [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
    "wedge": [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
    "pyramid": [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
}


def zones_of(mesh, dimension):
    """(kind, corners, zone's name) of every cell of a dimension."""
    kinds = {1: ["line"], 2: ["triangle", "quad"], 3: ["tetra", "hexahedron", "wedge", "pyramid"]}[dimension]
    names = {(int(tag), int(dim)): name for name, (tag, dim) in mesh.field_data.items()}
    for block, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
        for row, tag in zip(block.data, tags) if block.type in kinds else ():
            yield block.type, [int(n) for n in row], names.get((int(tag), dimension), "body")


def turned(kind, corners, points):
    """gmsh's extrusions may be inside out: corners of a cell that lies to the left of its edges, or above its base."""
    x = points[corners]
    if kind in PLANES:
        area = sum(np.cross(x[k, :2] - x[0, :2], x[k + 1, :2] - x[0, :2]) for k in range(1, len(x) - 1))
        return corners if area > 0 else corners[::-1]
    base = 3 if kind in ("tetra", "wedge") else 4
    up = np.dot(np.cross(x[1] - x[0], x[2] - x[0]), x[base:].mean(axis=0) - x[:base].mean(axis=0))
    return corners if up > 0 else corners[:base][::-1] + corners[base:][::-1]


def faces_of(cells, dimension, rim):
    """Zone's name -> rows of (nodes, c0, c1): those of `rim` by name, inner ones `interior`, all others `rest`."""
    first, rows = {}, {}
    for number, (kind, corners, _) in enumerate(cells):
        for face in FACES[kind]:
            nodes = [corners[k] for k in face]
            key = frozenset(nodes)
            if key in first:
                first[key][2] = number + 1
            else:
                first[key] = [nodes if dimension == 2 else nodes[::-1], number + 1, 0]
    for key, (nodes, c0, c1) in first.items():
        rows.setdefault(rim.get(key, "rest") if c1 == 0 else "interior", []).append((nodes, c0, c1))
    return rows


source, target, *options = sys.argv[1:]
prefix = next((int(o) for o in options if o in "23"), 0) * 1000
mesh = meshio.read(source)
dimension = 3 if any(b.type in ("tetra", "hexahedron", "wedge", "pyramid") for b in mesh.cells) else 2
cells = sorted(((kind, turned(kind, corners, mesh.points), zone) for kind, corners, zone in zones_of(mesh, dimension)),
               key=lambda cell: cell[2])
rim = {frozenset(nodes): name for _, nodes, name in zones_of(mesh, dimension - 1)}
faces = faces_of(cells, dimension, rim)

with open(target, "wb") as file:
    def section(number, head, numbers=None, per_row=None, kind="<i4"):
        """A section with a header of hexadecimal numbers; numbers: rows, or None for a declaration."""
        file.write(b"(%d (%s)" % (number + (prefix if numbers is not None else 0), b" ".join(b"%x" % h for h in head)))
        if numbers is None:
            file.write(b")\n")
        elif prefix:
            file.write(b"(" + b"".join(np.array(row, kind).tobytes() for row in numbers))
            file.write(b")\nEnd of Binary Section   %d)\n" % (number + prefix))
        else:
            text = [" ".join(per_row % x for x in row) for row in numbers]
            file.write(("(\n" + "\n".join(text) + "\n))\n").encode())

    file.write(b'(0 "by faces (with one parenthesis, and \\"words\\" :-(")\r\n(1 "a program")\n(2 %d)\n' % dimension)
    section(10, (0, 1, len(mesh.points), 0, dimension))
    section(12, (0, 1, len(cells), 0))
    section(13, (0, 1, sum(map(len, faces.values())), 0))
    section(10, (7, 1, len(mesh.points), 1, dimension), mesh.points[:, :dimension], "%.17g",
            "<f4" if prefix == 2000 else "<f8")
    zone, names, begin = 9, [], 1
    for name in sorted({cell[2] for cell in cells}):
        kinds = [NUMBER[cell[0]] for cell in cells if cell[2] == name]
        alone = len(set(kinds)) == 1
        section(12, (zone, begin, begin + len(kinds) - 1, 1, kinds[0] if alone else 0),
                None if alone else [kinds], "%x")
        names.append((zone, "solid", name))
        zone, begin = zone + 1, begin + len(kinds)
    begin = 1
    for name, rows in sorted(faces.items()):
        sizes = {len(nodes) for nodes, _, _ in rows}
        alone = len(sizes) == 1
        lines = [([] if alone else [len(nodes)]) + [n + 1 for n in nodes] + ([c1, c0] if "swap" in options else [c0, c1])
                 for nodes, c0, c1 in rows]
        section(13, (zone, begin, begin + len(rows) - 1, 2 if name == "interior" else 3, sizes.pop() if alone else 0),
                lines, "%x")
        names.append((zone, "interior" if name == "interior" else "wall", name))
        zone, begin = zone + 1, begin + len(rows)
    for k, (zone, what, name) in enumerate(names):
        file.write(b"(%d (%d %s %s%s)())\n" % (45 - 6 * (k % 2), zone, what.encode(), name.encode(), b" 1" * (k % 2)))
