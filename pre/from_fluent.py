# SPDX-License-Identifier: BSD-3-Clause
"""Fluent's .msh and .cas for to_msh.py, given by faces as Fluent, Gambit, ICEM and Pointwise write them; ASCII
and binary. A file is a row of sections in parentheses, each with a decimal number:

  (2 dimension)   (10 (zone first last type dimension)(x y z ...))   (12 (zone first last type kind)(kinds))
  (13 (zone first last boundary kind)(nodes c0 c1 ...))   (39 or 45 (zone what name)(...))

with hexadecimal numbers in 10, 12, 13, and decimal ones of the zones in 39 and 45; 2010 and 3010, 2012 ... are
binary with floats of 4 and 8 bytes and integers of 4. By the right-hand rule the nodes of a face turn about
an axis that points into c0; in 2D TGrid has c0 to the right of the way from the first node to the second, others to the
left: the sign of the area or volume within the boundary tells (is_swapped).
0 is no cell. Cells have no nodes of their own: they are put together from their faces here.

Source: Ansys Fluent User's Guide, appendix B, Case and Data File Formats, sections B.2 and B.3.
"""
import re

import numpy as np

from body import Body, stop
from fluent_cells import Faces, add_cells

INTERIOR, PERIODIC, PARENT_FACES, PARENT_CELLS = 2, (8, 12), 31, 32
MIXED, POLYGONS = 0, 5
ADAPTED = "the mesh was refined with hanging nodes; write it as it was before it was adapted"
PERIODS = ("it is periodic, which kirsch-nodes does not read; make two boundaries of it "
           "(Fluent: mesh/modify-zones/slit-periodic)")


def is_by_faces(path):
    """Whether a file is Fluent's and holds faces: not what meshio writes, which is cells by their corners."""
    with open(path, "rb") as file:
        if file.read(64).lstrip()[:1] != b"(":
            return False
        file.seek(0)
        return re.search(rb"\(\s*(?:20|30)?13\s*\(", file.read()) is not None


class File:
    """The bytes of a file, and a place in them."""

    def __init__(self, text):
        self.text, self.at = text, 0

    def line(self, at=None):
        return self.text.count(b"\n", 0, self.at if at is None else at) + 1

    def stop(self, sentence, at=None):
        stop(f"line {self.line(at)}: {sentence}")

    def take(self, pattern, expected):
        """What a pattern finds here, after blanks."""
        found = re.compile(rb"\s*" + pattern).match(self.text, self.at)
        if not found:
            rest = self.text[self.at:self.at + 60].split()
            here = f"found '{rest[0].decode(errors='replace')[:20]}'" if rest else "the file is cut"
            self.stop(f"expected {expected}, {here}")
        self.at = found.end()
        return found

    def skip(self, start):
        """To the end of the section that begins at `start`, of whatever kind it is."""
        depth = 0
        for found in re.compile(rb'"(?:[^"\\]|\\.)*"|[()]').finditer(self.text, start):
            depth += {b"(": 1, b")": -1}.get(found.group(), 0)
            if depth == 0:
                self.at = found.end()
                return
        self.stop("this section does not end: the file is cut", start)

    def skip_binary(self, index):
        found = re.compile(rb"End of Binary Section\s*%d\s*\)" % index).search(self.text, self.at)
        if not found:
            self.stop(f"the binary section {index} does not end: the file is cut")
        self.at = found.end()


class Mesh:
    """What the sections hold."""

    def __init__(self):
        self.dimension, self.points, self.seen, self.faces = 0, None, None, None
        self.cell_zones, self.names = [], {}


def section_head(file, expected, at_least):
    words = file.take(rb"\(([0-9a-fA-F\s]*)\)", expected).group(1).split()
    if len(words) < at_least:
        file.stop(f"expected {expected}, found {len(words)} numbers")
    numbers = [int(w, 16) for w in words]
    if numbers[2] > len(file.text):
        file.stop(f"{numbers[2]} are announced, and the file has {len(file.text)} bytes")
    return numbers


def section_data(file, index, count, what):
    """The words between the parentheses of a section; if it is binary its numbers, as many as `count` or,
    without it, all to the end of the file."""
    file.take(rb"\(", f"the {what} in parentheses")
    start = file.at
    if index < 2000:
        end = file.text.find(b")", start)
        if end < 0:
            file.stop(f"the {what} do not end: the file is cut")
        file.at = end + 1
        return file.text[start:end].split()
    kind = np.dtype("<i4" if what != "nodes" else "<f4" if index < 3000 else "<f8")
    room = (len(file.text) - start) // kind.itemsize
    if count is not None and room < count:
        file.stop(f"{count} numbers of the {what} were announced, and {room} are there: the file is cut")
    file.at += (count or 0) * kind.itemsize
    return np.frombuffer(file.text, kind, room if count is None else count, start)


def section_end(file, index):
    if index < 2000:
        file.take(rb"\)", "the end of the section, ')'")
    else:
        file.take(rb"\)?\s*End of Binary Section\s*%d\s*\)" % index, f"'End of Binary Section {index})'")


def read_nodes(file, index, mesh):
    zone, first, last, *rest = section_head(file, "(zone first last type dimension) of nodes", 3)
    if zone == 0:
        mesh.points, mesh.seen = np.zeros((last, 3)), np.zeros(last, dtype=bool)
        return file.take(rb"\)", "the end of the section, ')'")
    line = file.line()
    width = rest[1] if len(rest) > 1 else mesh.dimension
    if mesh.points is None or last > len(mesh.points) or first < 1 or width not in (2, 3):
        file.stop(f"the nodes {first} to {last} in {width} dimensions fit no declaration before, "
                  "(10 (0 1 last type dimension))")
    mesh.dimension = mesh.dimension or width
    count = (last - first + 1) * width
    try:
        values = np.array(section_data(file, index, count, "nodes"), dtype=float)
    except ValueError as error:
        stop(f"the nodes that begin on line {line}: {error}")
    if len(values) != count:
        stop(f"the nodes that begin on line {line} are {len(values)} numbers, expected {count}")
    mesh.points[first - 1:last, :width] = values.reshape(-1, width)
    mesh.seen[first - 1:last] = True
    section_end(file, index)


def read_cells(file, index, mesh):
    start = file.at
    zone, first, last, *rest = section_head(file, "(zone first last type kind) of cells", 3)
    if rest and rest[0] == PARENT_CELLS and last:
        file.stop(ADAPTED)
    if zone and last >= first:
        mesh.cell_zones.append((zone, first - 1, last, rest[1] if len(rest) > 1 else MIXED))
    if index > 2000 and re.compile(rb"\s*\(").match(file.text, file.at):
        section_data(file, index, last - first + 1, "kinds of cells")
        section_end(file, index)
    else:
        file.skip(file.text.rfind(b"(", 0, start))


def read_faces(file, index, mesh):
    zone, first, last, *rest = section_head(file, "(zone first last boundary kind) of faces", 3)
    if zone == 0:
        mesh.faces = Faces(last)
        return file.take(rb"\)", "the end of the section, ')'")
    if last < first:
        return file.skip(file.text.rfind(b"(13" if index < 2000 else b"(%d" % index, 0, file.at))
    if len(rest) < 2:
        file.stop("faces need (zone first last boundary kind)")
    if mesh.faces is None or last > len(mesh.faces.count) or first < 1:
        file.stop(f"the faces {first} to {last} fit no declaration (13 (0 1 last 0)) before")
    boundary, kind, head = rest[0], rest[1], file.line()
    if boundary in PERIODIC:
        file.stop(f"of the zone {zone} (hexadecimal {zone:x}): " + PERIODS)
    if boundary == PARENT_FACES:
        file.stop(ADAPTED)
    mixed, start = kind in (MIXED, POLYGONS), re.compile(rb"\s*\(?\s*").match(file.text, file.at).end()
    if not mixed and kind not in (2, 3, 4):
        file.stop(f"faces of kind {kind} are not known; expected 0, 2, 3, 4 or 5")
    count = last - first + 1
    values = section_data(file, index, None if mixed and index > 2000 else count * (kind + 2), "faces")
    try:
        values = values if index > 2000 else np.array([int(w, 16) for w in values], dtype=np.int64)
    except ValueError:
        stop(f"the faces that begin on line {head} hold a word that is no hexadecimal number")
    begin = face_begins(values, count, head) if mixed else None
    if mixed and index > 2000:
        file.at += 4 * int(begin[-1])
        values = values[:begin[-1]]
    if len(values) != (begin[-1] if mixed else count * (kind + 2)):
        stop(f"the faces that begin on line {head} are not the {count} that were announced")
    lines = file.text.count(b"\n", start, file.at) if index < 2000 else 0
    by_line = file.line(start) if index < 2000 and lines in (count, count - 1) else 0
    mesh.faces.sections.append((first - 1, last, zone, boundary, head, by_line))
    keep_faces(mesh.faces, slice(first - 1, last), values, begin, kind)
    section_end(file, index)


def face_begins(values, count, head):
    """Where each face begins among numbers of which the first is how many nodes it has; and the end."""
    begin, values = [0], values.tolist()
    for _ in range(count):
        if begin[-1] >= len(values) or not 0 < values[begin[-1]] < len(values):
            stop(f"the faces that begin on line {head} end before the {count} that were announced")
        begin.append(begin[-1] + values[begin[-1]] + 3)
    return np.array(begin)


def keep_faces(faces, rows, values, begin, kind):
    if begin is None:
        table = values.reshape(-1, kind + 2).astype(np.int64)
        faces.nodes[rows, :kind], faces.cells[rows], faces.count[rows] = table[:, :-2] - 1, table[:, -2:], kind
        return
    count = values[begin[:-1]].astype(np.int64)
    faces.count[rows] = count
    if count.max() > 4:
        row = rows.start + int(count.argmax())
        stop(f"{faces.name(row)} has {count.max()} nodes: polyhedra are not read; write the mesh as it was "
             "before its cells were made polyhedra")
    for k in range(4):
        faces.nodes[rows, k] = np.where(k < count, values[np.minimum(begin[:-1] + 1 + k, len(values) - 1)] - 1, -1)
    faces.cells[rows] = np.stack([values[begin[1:] - 2], values[begin[1:] - 1]], axis=1)


def read_sections(path):
    with open(path, "rb") as stream:
        file = File(stream.read())
    mesh = Mesh()
    readers = {10: read_nodes, 12: read_cells, 13: read_faces}
    while re.compile(rb"\s*\S").match(file.text, file.at):
        start = file.at
        index = int(file.take(rb"\(\s*(\d+)", "a section such as (10 ...").group(1))
        kind = index % 1000 if 2000 < index < 4000 else index
        if kind in readers:
            readers[kind](file, index, mesh)
            continue
        if index in (58, 59):
            file.stop(ADAPTED)
        if index == 18:
            file.stop("of these faces: " + PERIODS)
        if index == 2:
            mesh.dimension = int(file.take(rb"(\d+)", "the dimension").group(1))
        if index in (39, 45):
            words = file.take(rb"\(\s*(\d+)\s+[^\s()]+\s+([^\s()]+)", "(zone what name ...)")
            mesh.names[int(words.group(1))] = words.group(2).decode("utf-8", "replace").strip('"')
        if index > 2000:
            file.skip_binary(index)
        else:
            file.skip(file.text.index(b"(", start))
    return mesh


def check(mesh):
    """What each section by itself could not tell."""
    faces = mesh.faces
    if mesh.points is None or not mesh.seen.all():
        stop("the file does not hold all nodes that it declares (sections 10, 2010, 3010)")
    if not mesh.cell_zones:
        stop("the file holds no cells (section 12), only a mesh of surfaces; write the volume mesh")
    total = max(last for _, _, last, _ in mesh.cell_zones)
    if not faces.count.all():
        stop(f"face {int(faces.count.argmin()) + 1} is declared, but in no section of faces")
    used = np.arange(4) < faces.count[:, None]
    missing = used & ((faces.nodes < 0) | (faces.nodes >= len(mesh.points)))
    wrong = {"a node that is not there": missing.any(axis=1),
             f"a cell that is not there (there are {total})": ((faces.cells < 0) | (faces.cells > total)).any(axis=1),
             "no cell on either side": ~faces.cells.any(axis=1),
             f"too many or too few nodes for {mesh.dimension} dimensions":
                 faces.count != 2 if mesh.dimension == 2 else faces.count < 3}
    for what, rows in wrong.items():
        if rows.any():
            stop(f"{faces.name(int(rows.argmax()))} has {what}")
    return total


def read_fluent(path):
    mesh = read_sections(path)
    if mesh.faces is None:
        stop("the file declares no faces, (13 (0 1 last 0))")
    total = check(mesh)
    body = Body(mesh.points)
    add_cells(body, mesh, total)
    for first, last, zone, boundary, _, _ in mesh.faces.sections:
        if boundary != INTERIOR:
            sides = body.sides.setdefault(mesh.names.get(zone, f"zone_{zone}"), [])
            rows = zip(mesh.faces.nodes[first:last], mesh.faces.count[first:last])
            sides += [row[:k].tolist() for row, k in rows]
    return body
