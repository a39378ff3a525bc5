#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""to_msh.py FROM TO.msh: a mesh that meshio can read becomes MSH 4.1 with all its named sets.

kirsch-nodes runs it. meshio reads the cells; the named sets are taken from wherever the format
keeps them, also where meshio itself loses them:

  Abaqus .inp     *NSET, *ELSET, ELSET= of *ELEMENT, *SURFACE, *INSTANCE with its move and turn,
                  read here: meshio mixes up sets of several blocks and leaves instances unmoved
  ANSYS .cdb      NBLOCK, EBLOCK and CMBLOCK, read here by the widths of their formats
  Exodus          blocks, node sets and side sets, read here by netCDF4; SPHERE elements become
                  points with volumes, and TO.msh a table of them, x,y,z,volume,block_id,sets
  UNV             groups of nodes and elements and the unit of length, read here: gmsh 4.8 crashes
                  on groups of nodes and passes over the unit
  MED             families: cell_tags and point_tags
  all others      cell_sets, point_sets, and whole-numbered cell data, one set a value

A set of points is written as a physical group of points (dimension 0).
"""
import os
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
# Faces of solids in Exodus's side sets, by its side numbers; corners count from 0.
SIDES = {
    "triangle": [(0, 1), (1, 2), (2, 0)], "quad": [(0, 1), (1, 2), (2, 3), (3, 0)],
    "tetra": [(0, 1, 3), (1, 2, 3), (0, 3, 2), (0, 2, 1)],
    "hexahedron": [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (0, 4, 7, 3), (0, 3, 2, 1), (4, 5, 6, 7)],
    "wedge": [(0, 1, 4, 3), (1, 2, 5, 4), (0, 3, 5, 2), (0, 2, 1), (3, 4, 5)],
    "pyramid": [(0, 1, 4), (1, 2, 4), (2, 3, 4), (0, 4, 3), (0, 3, 2, 1)],
}


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


# ---- Abaqus ---------------------------------------------------------------------------------
def abaqus_kind(word, count):
    """Kind of an element by its name and number of nodes, which stands at the name's end."""
    solid = {4: "tetra", 10: "tetra10", 8: "hexahedron", 20: "hexahedron20", 6: "wedge",
             15: "wedge15", 5: "pyramid", 13: "pyramid13", 27: "hexahedron27"}
    plane = {3: "triangle", 4: "quad", 6: "triangle6", 8: "quad8", 9: "quad9"}
    if re.match(r"(C3D|DC3D|AC3D|CIN3D|COH3D|SC[68])", word):
        return solid.get(count)
    if re.match(r"(CPS|CPE|CGPE|CAX|S\d|STRI|M3D|R3D|SFM3D|DC2D|AC2D|WARP|CGAX)", word):
        return plane.get(count)
    if re.match(r"(T2D|T3D|B2|B3|R2D|M2D|SAX|MAX)", word):
        return {2: "line", 3: "line3"}.get(count)
    return "vertex" if count == 1 else None


def abaqus_count(word):
    """Nodes of an element, from its name."""
    named = {"STRI65": 6, "B21": 2, "B31": 2, "B33": 2, "B23": 2, "B22": 3, "B32": 3, "MASS": 1}
    base = re.sub(r"[HRTIMP]+$", "", word)
    if base in named:
        return named[base]
    found = re.match(r"(?:[ACD]*C3D|CIN3D|COH3D|CAX|CGAX|CPS|CPEG?|CGPE|[AD]C2D|M3D|R[23]D|SFM3D|SC|"
                     r"STRI|S|T[23]D)(\d+)", word)
    return int(found.group(1)) if found else 0


def inp_lines(path, depth=0):
    """Lines of a file and of those that it includes, without comments."""
    if depth > 20:
        stop(f"{path}: more than 20 files include each other")
    with open(path, errors="replace") as file:
        for line in file:
            if not line.endswith("\n"):
                note(f"{os.path.basename(path)} does not end with a whole line: it may be cut")
            if line.startswith("**") or not line.strip():
                continue
            if re.match(r"\*INCLUDE", line, re.I):
                name = line.split("=", 1)[-1].strip().strip('"')
                yield from inp_lines(os.path.join(os.path.dirname(path), name), depth + 1)
            else:
                yield line


def inp_sections(path):
    """Keyword, its options and its data lines."""
    keyword, options, data = None, {}, []
    for line in inp_lines(path):
        if not line.startswith("*"):
            data.append(line)
            continue
        if keyword:
            yield keyword, options, data
        words = [w.strip() for w in line.strip().lstrip("*").split(",")]
        keyword, data = " ".join(words[0].upper().split()), []
        options = {w.split("=", 1)[0].strip().upper(): w.split("=", 1)[-1].strip().strip('"')
                   for w in words[1:] if w}
    if keyword:
        yield keyword, options, data


class Named:
    """Sets of numbers and of names of other sets, resolved at the end.

    An item is (instance, number) or (instance, name); the instance is None within a part.
    """

    def __init__(self):
        self.sets, self.names = {}, {}

    def add(self, name, options, data):
        key = name.upper()
        self.names.setdefault(key, name)
        items = self.sets.setdefault(key, [])
        where = options.get("INSTANCE", "").upper() or None
        for line in data:
            words = [w.strip() for w in line.split(",") if w.strip()]
            if "GENERATE" in options:
                low, high = int(words[0]), int(words[1])
                step = int(words[2]) if len(words) > 2 else 1
                items += [(where, k) for k in range(low, high + 1, step)]
                continue
            for word in words:
                place, _, last = word.strip('"').upper().rpartition(".")
                items.append((place or where, int(last) if last.isdigit() else last))


class Part:
    """What stands between *PART and *END PART, or outside of all parts."""

    def __init__(self):
        self.nodes, self.elements = {}, []
        self.node_sets, self.cell_sets = Named(), Named()
        self.surfaces = {}

    def resolve(self, model, kind, key, inside=None, seen=()):
        """Members (instance, number) of a set; `inside`: the instance of this part that is meant."""
        named = getattr(self, kind)
        if key in seen or key not in named.sets:
            stop(f"the set '{key}' is named in another one, but is nowhere defined")
        out = []
        for instance, item in named.sets[key]:
            if instance is not None and instance not in model:
                stop(f"the set '{key}' names the instance '{instance}', which is nowhere placed")
            place = instance if instance is not None else inside
            if not isinstance(item, str):
                out.append((place, item))
            elif instance is not None and item in getattr(model[instance][0], kind).sets:
                out += model[instance][0].resolve(model, kind, item, instance)
            else:
                out += self.resolve(model, kind, item, place, seen + (key,))
        return out


def numbers(data):
    return [int(w) for line in data for w in line.split(",") if w.strip()]


def turned(points, words):
    """Points after an instance's second line: turned about the axis from a to b by an angle in degrees."""
    a, b, angle = np.array(words[:3]), np.array(words[3:6]), np.radians(words[6])
    axis = (b - a) / np.linalg.norm(b - a)
    off = points - a
    along = np.outer(off @ axis, axis)
    return a + along + np.cos(angle) * (off - along) + np.sin(angle) * np.cross(axis, off)


def placed(points, data):
    """Points of an instance: moved by its first line, then turned by its second."""
    lines = [[float(w) for w in line.split(",") if w.strip()] for line in data]
    if len(lines) > 2 or (lines and len(lines[0]) != 3) or (len(lines) > 1 and len(lines[1]) != 7):
        stop("an *Instance has lines of other than 3 numbers (its move) and 7 (its turn)")
    if lines:
        points = points + lines[0]
    return turned(points, lines[1]) if len(lines) > 1 else points


def inp_elements(part, options, data):
    word = options.get("TYPE", "").upper()
    count = abaqus_count(word)
    kind = abaqus_kind(word, count)
    if not kind:
        stop(f"elements of type {word or '(none)'} are not read")
    table = np.array(numbers(data), dtype=np.int64)
    if len(table) % (count + 1):
        stop(f"the elements of type {word} have not {count} nodes each")
    table = table.reshape(-1, count + 1)
    part.elements.append((kind, table))
    if "ELSET" in options:
        part.cell_sets.add(options["ELSET"], {}, [str(t) for t in table[:, 0]])


def inp_keyword(part, keyword, options, data):
    """One section that belongs to a part."""
    if keyword == "NODE":
        for line in data:
            words = line.split(",")
            part.nodes[int(words[0])] = [float(w) if w.strip() else 0.0
                                         for w in (words[1:4] + ["", ""])[:3]]
        if "NSET" in options:
            part.node_sets.add(options["NSET"], {}, [line.split(",")[0] for line in data])
    elif keyword == "ELEMENT":
        inp_elements(part, options, data)
    elif keyword == "NSET" and "NSET" in options:
        if "ELSET" in options:
            note(f"*NSET {options['NSET']} is made from an element set; it is left out")
        else:
            part.node_sets.add(options["NSET"], options, data)
    elif keyword == "ELSET" and "ELSET" in options:
        part.cell_sets.add(options["ELSET"], options, data)
    elif keyword == "SURFACE" and "NAME" in options:
        if options.get("TYPE", "ELEMENT").upper() == "NODE":
            part.node_sets.add(options["NAME"], {}, [line.split(",")[0] for line in data])
        else:
            part.surfaces[options["NAME"]] = [[w.strip() for w in line.split(",")] for line in data]


def read_inp(path):
    root = Part()
    parts, model, called_as, part = {}, {}, {}, root
    for keyword, options, data in inp_sections(path):
        if keyword == "PART":
            part = parts.setdefault(options.get("NAME", "").upper(), Part())
        elif keyword in ("END PART", "END INSTANCE"):
            part = root
        elif keyword == "INSTANCE":
            name = options.get("PART", "").upper()
            if name not in parts:
                stop(f"*Instance names the part '{name}', which is nowhere defined")
            called = options.get("NAME", name)
            model[called.upper()] = (parts[name], data)
            called_as[called.upper()] = called
        else:
            inp_keyword(part, keyword, options, data)
    if not model:
        model = {name: (one, []) for name, one in parts.items()}
        called_as = {name: name for name in parts}
    if root.elements or not model:
        model[""] = (root, [])
    return inp_body(root, model, called_as)


def inp_body(root, model, called_as):
    """All instances as one body; where there are several, `INSTANCE_SET` are their parts' sets."""
    nodes, points, place, where = [], [], {}, {}
    for name, (part, data) in model.items():
        for tag in part.nodes:
            place[(name, tag)] = len(place)
        nodes += list(part.nodes)
        if part.nodes:
            points.append(placed(np.array(list(part.nodes.values())), data))
    if not points or not any(part.elements for part, _ in model.values()):
        stop("the file holds no *NODE or no *ELEMENT")
    body = Body(np.concatenate(points))
    if len(set(nodes)) == len(nodes):
        body.point_tags = np.array(nodes, dtype=np.int64)
    for name, (part, _) in model.items():
        for kind, table in part.elements:
            try:
                rows = np.array([[place[(name, int(t))] for t in row] for row in table[:, 1:]])
            except KeyError as error:
                stop(f"an element has the node {error.args[0][1]}, which *NODE does not hold")
            block = body.add_block(kind, rows, table[:, 0])
            where.update(((name, int(tag)), (block, row)) for row, tag in enumerate(table[:, 0]))
    alone = len([1 for part, _ in model.values() if part.elements]) == 1
    for name, (part, _) in model.items():
        inp_sets(body, model, part, name, "" if alone or not name else called_as[name] + "_", place, where)
    if "" not in model:
        inp_sets(body, model, root, "", "", place, where)
    return body


def inp_sets(body, model, part, instance, prefix, place, where):
    for key, name in part.cell_sets.names.items():
        by_block = {}
        for member in part.resolve(model, "cell_sets", key, instance):
            if member not in where:
                stop(f"the set '{name}' has the element {member[1]}, which *ELEMENT does not hold")
            by_block.setdefault(where[member][0], []).append(where[member][1])
        for block, rows in by_block.items():
            body.add_cells(prefix + name, block, rows)
    for key, name in part.node_sets.names.items():
        try:
            # Nodes of the assembly itself are reference points, of no element.
            body.point_sets[prefix + name] = [
                place[member] for member in part.resolve(model, "node_sets", key, instance)
                if member[0] in model]
        except KeyError as error:
            stop(f"the set '{name}' has the node {error.args[0][1]}, which *NODE does not hold")
    for name, lines in part.surfaces.items():
        inp_surface(body, model, part, instance, prefix + name, lines, where)


# Faces S1, S2, ... of Abaqus; corners count from 0.
ABAQUS_SIDES = {
    "triangle": [(0, 1), (1, 2), (2, 0)], "quad": [(0, 1), (1, 2), (2, 3), (3, 0)],
    "tetra": [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)],
    "hexahedron": [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)],
    "wedge": [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)],
    "pyramid": [(0, 1, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0)],
}


def inp_surface(body, model, part, instance, name, lines, where):
    """Lines of an element or element set and the face, S1 to S6."""
    out = []
    for words in lines:
        face = words[1].upper() if len(words) > 1 else ""
        if not re.fullmatch(r"S[1-6]", face):
            note(f"the surface '{name}' has the face '{face}', which is not read; it is left out")
            return
        spot, _, last = words[0].strip('"').upper().rpartition(".")
        owner, home = (model[spot][0], spot) if spot in model else (part, instance)
        members = [(home, int(last))] if last.isdigit() else owner.resolve(model, "cell_sets", last, home)
        for member in members:
            if member not in where:
                stop(f"the surface '{name}' has the element {member[1]}, which *ELEMENT does not hold")
            block, row = where[member]
            kind, rows = body.blocks[block]
            sides = ABAQUS_SIDES.get(re.sub(r"\d+$", "", kind), [])
            if int(face[1]) > len(sides):
                stop(f"the surface '{name}' has the face {face} of element {member[1]}, a {kind}")
            corners = sides[int(face[1]) - 1]
            out.append([rows[row][c] for c in corners] + middles(kind, rows[row], corners))
    body.sides.setdefault(name, []).extend(out)


# ---- Exodus ---------------------------------------------------------------------------------
def exodus_kind(word, count):
    for begin, kind in (("TRI", "triangle"), ("QUAD", "quad"), ("SHELL", "quad"), ("TET", "tetra"),
                        ("HEX", "hexahedron"), ("WEDGE", "wedge"), ("PYRAMID", "pyramid"),
                        ("BAR", "line"), ("BEAM", "line"), ("TRUSS", "line"), ("EDGE", "line")):
        if word.upper().startswith(begin):
            if kind == "quad" and count in (3, 6):
                kind = "triangle"
            first = {"triangle": 3, "quad": 4, "tetra": 4, "hexahedron": 8, "wedge": 6,
                     "pyramid": 5, "line": 2}[kind]
            return kind if count == first else kind + str(count)
    stop(f"blocks of {word} are not read")


def texts(nc, name, count, fallback):
    """Names of blocks or sets; the empty ones are called after their number."""
    prop = {"eb_names": "eb_prop1", "ns_names": "ns_prop1", "ss_names": "ss_prop1"}[name]
    ids = nc.variables[prop][:] if prop in nc.variables else range(1, count + 1)
    out = [f"{fallback}_{ids[k]}" for k in range(count)]
    if name in nc.variables:
        nc.variables[name].set_auto_mask(False)
        for k, row in enumerate(nc.variables[name][:]):
            text = b"".join(row).split(b"\0")[0].decode("utf-8", "replace").strip()
            out[k] = text or out[k]
    return out


def exodus_order(kind, rows):
    """Exodus has the middles of a hexahedron's upright edges before those of its lid."""
    if kind in ("hexahedron20", "hexahedron27"):
        return rows[:, list(range(12)) + [16, 17, 18, 19, 12, 13, 14, 15] + list(range(20, rows.shape[1]))]
    if kind == "wedge15":
        return rows[:, list(range(9)) + [12, 13, 14, 9, 10, 11]]
    return rows


def read_exodus(path):
    import netCDF4

    with netCDF4.Dataset(path) as nc:
        nc.set_auto_mask(False)
        size = lambda name: len(nc.dimensions[name]) if name in nc.dimensions else 0
        if "coord" in nc.variables:
            points = nc.variables["coord"][:].T
        else:
            axes = [a for a in ("coordx", "coordy", "coordz") if a in nc.variables]
            points = np.stack([nc.variables[a][:] for a in axes], axis=1)
        spheres = [k for k in range(size("num_el_blk")) if f"connect{k + 1}" in nc.variables and
                   nc.variables[f"connect{k + 1}"].elem_type.upper().startswith("SPHERE")]
        if spheres and len(spheres) == size("num_el_blk"):
            return exodus_spheres(nc, points, size)
        body = Body(points)
        where = []
        for k, name in enumerate(texts(nc, "eb_names", size("num_el_blk"), "block")):
            if f"connect{k + 1}" not in nc.variables:
                continue
            variable = nc.variables[f"connect{k + 1}"]
            rows = np.asarray(variable[:]) - 1
            kind = exodus_kind(variable.elem_type, rows.shape[1])
            block = body.add_block(kind, exodus_order(kind, rows))
            body.add_cells(name, block, np.arange(len(rows)))
            where += [(block, r) for r in range(len(rows))]
        for k, name in enumerate(texts(nc, "ns_names", size("num_node_sets"), "nodeset")):
            if f"node_ns{k + 1}" in nc.variables:
                body.point_sets[name] = np.asarray(nc.variables[f"node_ns{k + 1}"][:]) - 1
        for k, name in enumerate(texts(nc, "ss_names", size("num_side_sets"), "sideset")):
            if f"elem_ss{k + 1}" in nc.variables:
                add_sides(body, name, where, np.asarray(nc.variables[f"elem_ss{k + 1}"][:]) - 1,
                          np.asarray(nc.variables[f"side_ss{k + 1}"][:]) - 1)
    return body


class Points:
    """Points with volumes instead of cells: columns of a table that kirsch-nodes reads."""

    def __init__(self, columns):
        self.columns = columns

    def write(self, path):
        with open(path, "w") as file:
            file.write(",".join(self.columns) + "\n")
            for row in zip(*(column.tolist() for column in self.columns.values())):
                file.write(",".join(map(repr, row)) + "\n")


def exodus_spheres(nc, points, size):
    """SPHERE elements, as Peridigm and PeriLab keep their nodes: attributes are radius and volume."""
    rows, volumes, blocks, sets = [], [], [], {}
    for k, name in enumerate(texts(nc, "eb_names", size("num_el_blk"), "block")):
        node = np.asarray(nc.variables[f"connect{k + 1}"][:])[:, 0] - 1
        if f"attrib{k + 1}" not in nc.variables or nc.variables[f"attrib{k + 1}"].shape[1] < 2:
            stop(f"the SPHERE elements of the block '{name}' have no attributes radius and volume")
        rows.append(node)
        volumes.append(np.asarray(nc.variables[f"attrib{k + 1}"][:])[:, 1])
        blocks.append(np.full(len(node), int(nc.variables["eb_prop1"][k]) if "eb_prop1" in nc.variables
                              else k + 1))
        sets[name] = node
    node = np.concatenate(rows)
    xyz = np.zeros((len(points), 3))
    xyz[:, : points.shape[1]] = points
    columns = {"x": xyz[node, 0], "y": xyz[node, 1], "z": xyz[node, 2],
               "volume": np.concatenate(volumes), "block_id": np.concatenate(blocks)}
    for k, name in enumerate(texts(nc, "ns_names", size("num_node_sets"), "nodeset")):
        if f"node_ns{k + 1}" in nc.variables:
            sets[name] = np.asarray(nc.variables[f"node_ns{k + 1}"][:]) - 1
    for name, members in sets.items():
        if not re.fullmatch(r"block_\d+", name):
            columns[re.sub(r"[^A-Za-z0-9_-]", "_", name)] = np.isin(node, members).astype(int)
    return Points(columns)


def add_sides(body, name, where, cells, sides):
    """A side set: the corners of each side; middles of edges are found among the cell's nodes."""
    out = body.sides.setdefault(name, [])
    for cell, side in zip(cells, sides):
        block, row = where[cell]
        kind, rows = body.blocks[block]
        first = re.sub(r"\d+$", "", kind)
        corners = SIDES[first][side]
        nodes = rows[row]
        out.append([nodes[c] for c in corners] + middles(kind, nodes, corners))


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


# ---- UNV (I-DEAS universal files; Salome, Code_Aster) ----------------------------------------
UNV_KINDS = {11: "line", 21: "line", 22: "line3", 24: "line3", 41: "triangle", 51: "triangle",
             61: "triangle", 81: "triangle", 91: "triangle", 42: "triangle6", 52: "triangle6",
             62: "triangle6", 82: "triangle6", 92: "triangle6", 44: "quad", 54: "quad", 64: "quad",
             84: "quad", 94: "quad", 45: "quad8", 55: "quad8", 65: "quad8", 85: "quad8",
             95: "quad8", 111: "tetra", 118: "tetra10", 112: "wedge", 113: "wedge15",
             115: "hexahedron", 116: "hexahedron20"}
UNV_BEAMS = (11, 21, 22, 23, 24)  # with a line more
# UNV walks round a face, middles of edges between its corners: places of VTK's nodes in it.
UNV_ORDER = {"line3": [0, 2, 1], "triangle6": [0, 2, 4, 1, 3, 5], "quad8": [0, 2, 4, 6, 1, 3, 5, 7],
             "tetra10": [0, 2, 4, 9, 1, 3, 5, 6, 7, 8],
             "wedge15": [0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8],
             "hexahedron20": [0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11]}
UNV_GROUPS = ("2429", "2430", "2432", "2435", "2452", "2467", "2477")


def unv_datasets(path):
    """Number and lines of each dataset; they stand between lines of -1."""
    with open(path, errors="replace") as file:
        lines = iter(file.read().splitlines())
    for line in lines:
        if line.strip() != "-1":
            continue
        number, data = next(lines, "").strip(), []
        for line in lines:
            if line.strip() == "-1":
                break
            data.append(line)
        else:
            stop(f"dataset {number} does not end: the file is cut")
        yield number, data


def read_unv(path):
    scale, nodes, elements, groups = 1.0, {}, {}, []
    for number, data in unv_datasets(path):
        if number == "164":
            # Factor from SI to the file's unit, for lengths.
            scale = 1 / float(data[1].split()[0].replace("D", "e"))
        elif number in ("2411", "781"):
            for head, line in zip(data[::2], data[1::2]):
                nodes[int(head.split()[0])] = [float(w) for w in line.replace("D", "e").split()]
        elif number == "2412":
            unv_elements(data, elements)
        elif number in UNV_GROUPS:
            unv_groups(number, data, groups)
    if not nodes or not elements:
        stop("the file holds no nodes (dataset 2411) or no elements (dataset 2412)")
    if scale != 1:
        note(f"the file's unit of length is {scale:g} m")
    return unv_body(np.array(list(nodes.values())) * scale, list(nodes), elements, groups)


def unv_elements(data, elements):
    k = 0
    while k < len(data):
        words = [int(w) for w in data[k].split()]
        tag, number, count = words[0], words[1], words[5]
        k += 2 if number in UNV_BEAMS else 1
        rows = (count + 7) // 8
        if number not in UNV_KINDS:
            stop(f"UNV elements of type {number} are not read")
        table = elements.setdefault(UNV_KINDS[number], [])
        table.append([tag] + [int(w) for line in data[k:k + rows] for w in line.split()])
        if len(table[-1]) != count + 1 or len(table[-1]) != len(table[0]):
            stop(f"element {tag} has not {count} nodes")
        k += rows


def unv_groups(number, data, groups):
    """A group: its head, its name, and items of 2 or 4 words, two on a line."""
    k, words = 0, 4 if number in ("2435", "2452", "2467", "2477") else 2
    while k < len(data):
        count, name = int(data[k].split()[-1]), data[k + 1].strip()
        rows = (count + 1) // 2
        flat = [int(w) for line in data[k + 2:k + 2 + rows] for w in line.split()]
        items = [flat[i:i + 2] for i in range(0, len(flat), words)]
        if len(items) != count:
            stop(f"the group '{name}' has {len(items)} items, and {count} were announced")
        groups.append((name, items))
        k += 2 + rows


def unv_body(points, tags, elements, groups):
    place = {tag: k for k, tag in enumerate(tags)}
    body, where = Body(points), {}
    body.point_tags = np.array(tags, dtype=np.int64)
    for kind, table in elements.items():
        table = np.array(table, dtype=np.int64)
        try:
            rows = np.vectorize(place.__getitem__, otypes=[np.int64])(table[:, 1:])
        except KeyError as error:
            stop(f"an element has the node {error.args[0]}, which dataset 2411 does not hold")
        block = body.add_block(kind, rows[:, UNV_ORDER[kind]] if kind in UNV_ORDER else rows, table[:, 0])
        where.update((int(tag), (block, row)) for row, tag in enumerate(table[:, 0]))
    for name, items in groups:
        by_block, missing = {}, 0
        for code, tag in items:
            if code == 7 and tag in place:
                body.point_sets.setdefault(name, []).append(place[tag])
            elif code == 8 and tag in where:
                by_block.setdefault(where[tag][0], []).append(where[tag][1])
            else:
                missing += 1  # gmsh writes groups of points whose elements it leaves out
        if missing:
            note(f"the group '{name}' has {missing} items that the file does not hold")
        for block, rows in by_block.items():
            body.add_cells(name, block, rows)
    return body


# ---- all others -----------------------------------------------------------------------------
# ---- ANSYS .cdb -----------------------------------------------------------------------------
# Elements of ANSYS in a plane or a shell; others that end up here are solids by their nodes.
CDB_PLANES = {2, 25, 28, 35, 41, 42, 43, 55, 63, 77, 78, 82, 83, 93, 131, 132, 143, 145, 146, 150, 157,
              181, 182, 183, 208, 209, 281}
CDB_TETRAHEDRA = {72, 87, 92, 98, 123, 127, 148, 168, 187, 227, 232, 237, 285, 291}
CDB_BRICKS = {5, 45, 46, 62, 64, 65, 69, 70, 73, 90, 95, 96, 97, 122, 128, 147, 164, 185, 186, 190, 226,
              231, 236, 278, 279}
# Kinds by which corners coincide, and where in the list of 8 (20) the nodes of each kind stand.
CDB_CUTS = [
    ("tetra", lambda n: n[2] == n[3] and n[4] == n[5] == n[6] == n[7], [0, 1, 2, 4],
     [8, 9, 11, 16, 17, 18]),
    ("wedge", lambda n: n[2] == n[3] and n[6] == n[7], [0, 1, 2, 4, 5, 6],
     [8, 9, 11, 12, 13, 15, 16, 17, 18]),
    ("pyramid", lambda n: n[4] == n[5] == n[6] == n[7], [0, 1, 2, 3, 4],
     [8, 9, 10, 11, 16, 17, 18, 19]),
    ("hexahedron", lambda n: True, list(range(8)), list(range(8, 20))),
]


def cdb_widths(line):
    """Widths of the fields of a Fortran format such as (3i9,6e21.13e3), with their letters."""
    out = []
    for count, letter, width in re.findall(r"(\d*)([ieEIfFgG])(\d+)", line.split(")")[0]):
        out += [(letter.lower(), int(width))] * int(count or 1)
    if not line.lstrip().startswith("(") or not out:
        stop(f"expected a format such as (3i9,6e21.13e3), found '{line.strip()[:40]}'")
    return out


def cdb_fields(line, widths):
    """The fields of a line; empty ones at its end are left out."""
    at, out = 0, []
    for letter, width in widths:
        word = line[at:at + width].strip()
        if at >= len(line.rstrip()):
            break
        out.append((int if letter == "i" else float)(word.replace("D", "e") or 0))
        at += width
    return out


def cdb_nodes(lines, words, nodes):
    widths = cdb_widths(next(lines, ""))
    skip = sum(letter == "i" for letter, _ in widths)
    for line in lines:
        if line.startswith(("N,", "-1")) or line.strip() == "-1":
            return
        row = cdb_fields(line, widths)
        nodes[row[0]] = (row[skip:skip + 3] + [0.0, 0.0, 0.0])[:3]
    stop("the nodes (NBLOCK) do not end: the file is cut")


def cdb_elements(lines, words, elements):
    if len(words) < 3 or words[2].upper() != "SOLID":
        stop("an EBLOCK is not of the kind SOLID; write the file with CDWRITE,DB")
    widths = cdb_widths(next(lines, ""))
    row, wanted = [], 0
    for line in lines:
        if line.strip() == "-1":
            if wanted:
                stop("an element of EBLOCK has fewer nodes than it says")
            return
        row += cdb_fields(line, widths)
        wanted = row[8] if len(row) > 8 else 0
        if len(row) >= 11 + wanted:
            elements.append((row[10], row[1], row[0], row[11:11 + wanted]))
            row, wanted = [], 0
    stop("the elements (EBLOCK) do not end: the file is cut")


def cdb_component(lines, words, components):
    """CMBLOCK,NAME,NODE,n: numbers, a negative one ends a range that the one before begins."""
    name, kind, count = words[1].strip(), words[2].upper()[:4], int(words[3].split("!")[0])
    widths, members, got = cdb_widths(next(lines, "")), [], 0
    while got < count:
        row = cdb_fields(next(lines, ""), widths)
        if not row:
            stop(f"the component '{name}' ends before its {count} numbers: the file is cut")
        got += len(row)
        for number in row:
            members += range(members[-1] + 1, -number + 1) if number < 0 else [number]
    components.append((name, kind, members))


def cdb_kind(tag, number, nodes):
    """Kind of an element, and its nodes in the order of VTK."""
    n = list(nodes)
    if number in CDB_PLANES:
        tri = len(n) in (3, 6) or n[2] == n[3]
        first = n[:3] if tri else n[:4]
        second = n[4:8] if len(n) >= 8 else n[3:6] if len(n) == 6 else []
        second = [second[0], second[1], second[3]] if tri and len(second) == 4 else second
    elif number in CDB_TETRAHEDRA and len(n) in (4, 10):
        tri, first, second = None, n[:4], n[4:]
    elif number in CDB_BRICKS and len(n) in (8, 20):
        kind, _, corner, middle = next(cut for cut in CDB_CUTS if cut[1](n))
        first, second = [n[k] for k in corner], [n[k] for k in middle] if len(n) == 20 else []
        return cdb_order(tag, kind, first, second)
    else:
        stop(f"element {tag} is of ANSYS's type {number} with {len(n)} nodes, which is not read")
    return cdb_order(tag, {True: "triangle", False: "quad", None: "tetra"}[tri], first, second)


def cdb_order(tag, kind, first, second):
    """Without the middles of edges where one of them is missing (number 0)."""
    if not second or 0 in second:
        if any(second):
            note(f"element {tag} lacks the middle of an edge; its edges count as straight")
        return kind, first
    return f"{kind}{len(first) + len(second)}", first + second


def read_cdb(path):
    nodes, elements, components, types = {}, [], [], {}
    with open(path, errors="replace") as file:
        lines = iter(file.read().splitlines())
    for line in lines:
        words = [w.strip() for w in line.split(",")]
        key = words[0].upper()
        if key == "NBLOCK":
            cdb_nodes(lines, words, nodes)
        elif key == "EBLOCK":
            cdb_elements(lines, words, elements)
        elif key == "CMBLOCK":
            cdb_component(lines, words, components)
        elif key == "ET" and len(words) > 2 and words[1].isdigit() and words[2].isdigit():
            types[int(words[1])] = int(words[2])
    if not nodes or not elements:
        stop("the file holds no NBLOCK or no EBLOCK; write it with CDWRITE,DB")
    return cdb_body(nodes, elements, components, types)


def cdb_body(nodes, elements, components, types):
    place = {tag: k for k, tag in enumerate(nodes)}
    body = Body(np.array(list(nodes.values())))
    body.point_tags = np.array(list(nodes), dtype=np.int64)
    kinds, where, materials = {}, {}, {}
    for tag, kind, material, members in elements:
        if kind not in types:
            stop(f"element {tag} is of type {kind}, which no ET command defines")
        name, row = cdb_kind(tag, types[kind], members)
        for node in row:
            if node not in place:
                stop(f"element {tag} has the node {node}, which NBLOCK does not hold")
        rows = kinds.setdefault(name, ([], []))
        where[tag] = (name, len(rows[0]))
        rows[0].append(tag)
        rows[1].append([place[node] for node in row])
        materials.setdefault(material, []).append(tag)
    number = {name: body.add_block(name, rows, np.array(tags)) for name, (tags, rows) in kinds.items()}
    sets = [(name, members) for name, kind, members in components if kind == "ELEM"]
    if len(materials) > 1:
        sets += [(f"material_{k}", members) for k, members in sorted(materials.items())]
    for name, members in sets:
        by_block = {}
        for tag in members:
            if tag not in where:
                stop(f"the component '{name}' has the element {tag}, which EBLOCK does not hold")
            by_block.setdefault(number[where[tag][0]], []).append(where[tag][1])
        for block, rows in by_block.items():
            body.add_cells(name, block, rows)
    for name, kind, members in components:
        if kind == "NODE":
            body.point_sets[name] = [place[tag] for tag in members if tag in place]
    return body


def check_fluent(path):
    """Fluent's .msh as meshio reads it: cells by their corners. Names of zones are passed over, and
    Fluent itself writes faces with the cells on their two sides, which meshio takes for cells."""
    with open(path, "rb") as file:
        text = file.read()
    # (39 (4 wall left)()) or (45 (4 wall left)()): number, kind and name of a zone
    names = re.findall(rb"\(\s*(?:39|45)\s*\(\s*\w+\s+\S+\s+([^\s()]+)", text)
    kept = [n.decode(errors="replace") for n in dict.fromkeys(names)]
    if re.search(rb"\(\s*(?:20|30)?13\s*\(\s*[1-9a-f]", text):
        stop("the mesh is given by its faces, as Fluent writes it, and only Fluent meshes whose cells are "
             "given by their corners are read (meshio's); write it as Abaqus, Exodus or .cdb")
    if kept:
        note(f"the zones {', '.join(kept[:8])} of a Fluent mesh make no sets; name sets by place in the deck")


def read_meshio(path):
    import meshio

    with open(path, "rb") as file:
        if path.lower().endswith(".msh") and file.read(1) in (b"(", b"\n"):
            check_fluent(path)

    try:
        mesh = meshio.read(path)
    except SystemExit:
        stop("meshio cannot read the file")
    body = Body(mesh.points)
    for number, block in enumerate(mesh.cells):
        body.add_block(block.type, block.data, own_tags(mesh, number))
    for name, parts in mesh.cell_sets.items():
        if name.startswith("gmsh:"):
            continue
        for block, rows in enumerate(parts):
            if rows is not None:
                body.add_cells(name, block, rows)
    for name, rows in mesh.point_sets.items():
        body.point_sets[name] = np.asarray(rows)
    families(body, mesh)
    for name, parts in mesh.cell_data.items():
        data_sets(body, mesh, name, parts)
    return body


# What kirsch-nodes --write vtu notes of a cell beside its sets.
OWN_DATA = ("Tag", "Volume", "Surface_Correction_Factor")


def own_tags(mesh, block):
    """Numbers of cells in our own VTU."""
    if not all(name in mesh.cell_data for name in OWN_DATA):
        return None
    return np.asarray(mesh.cell_data["Tag"][block], dtype=np.int64).ravel()


def families(body, mesh):
    """MED keeps for each cell and point the number of a family, and for each family its groups."""
    for number, names in getattr(mesh, "cell_tags", {}).items():
        for name in names:
            for block, values in enumerate(mesh.cell_data.get("cell_tags", [])):
                body.add_cells(name, block, np.flatnonzero(np.asarray(values) == number))
    for number, names in getattr(mesh, "point_tags", {}).items():
        for name in names:
            rows = np.flatnonzero(np.asarray(mesh.point_data["point_tags"]) == number)
            body.point_sets[name] = np.union1d(body.point_sets.get(name, []), rows).astype(np.int64)


def data_sets(body, mesh, name, parts):
    """Whole-numbered cell data, such as Material or gmsh:physical: a set for each value; bytes of 0 and 1,
    as in our own VTU, are one set."""
    if name == "gmsh:geometrical" or (name == "cell_tags" and getattr(mesh, "cell_tags", {})):
        return
    if name in OWN_DATA and all(own in mesh.cell_data for own in OWN_DATA):
        return
    values = [np.asarray(p) for p in parts]
    values = [v[:, 0] if v.ndim == 2 and v.shape[1] == 1 else v for v in values]
    if values and all(v.dtype.itemsize == 1 and v.ndim == 1 and v.max(initial=0) <= 1 for v in values):
        for block, v in enumerate(values):  # 0 and 1 in a byte: in the set or not
            body.add_cells(name, block, np.flatnonzero(v == 1))
        return
    if any(v.ndim != 1 or not np.issubdtype(v.dtype, np.number) for v in values):
        return
    if any(np.any(v != np.round(v)) for v in values):
        return
    different = np.unique(np.concatenate(values)) if values else []
    if len(different) > 1000:
        note(f"the cell data '{name}' has {len(different)} values; no sets are made of it")
        return
    names = {int(v[0]): key for key, v in mesh.field_data.items()}
    for value in different:
        base = re.sub(r"^\w+:", "", name)
        title = names.get(int(value)) if name == "gmsh:physical" else None
        for block, v in enumerate(values):
            if name == "gmsh:physical" and value == 0:
                continue
            body.add_cells(title or f"{base}_{int(value)}", block, np.flatnonzero(v == value))


# ---- MSH 4.1 --------------------------------------------------------------------------------
def add_side_blocks(body):
    """The facets of side sets become cells of one dimension less, in sets of their own."""
    kinds = {2: "line", 3: "line3"}
    for name, sides in body.sides.items():
        by_count = {}
        for side in sides:
            by_count.setdefault(len(side), []).append(side)
        solid = max(KINDS[kind][1] for kind, _ in body.blocks) == 3
        for count, rows in by_count.items():
            kind = {3: "triangle", 4: "quad", 6: "triangle6", 8: "quad8"}[count] if solid else kinds[count]
            block = body.add_block(kind, rows)
            body.add_cells(name, block, np.arange(len(rows)))
    for name, rows in body.point_sets.items():
        rows = np.unique(np.asarray(rows, np.int64))
        block = body.add_block("vertex", rows.reshape(-1, 1))
        body.add_cells(name, block, np.arange(len(rows)))


def classes(body):
    """Pieces of blocks whose cells are in the same groups: (block, rows, groups)."""
    groups = {}  # (dim, name) -> tag
    keys = [np.zeros(len(rows), dtype=np.int64) for _, rows in body.blocks]
    combos = {(): 0}
    for name, parts in body.cells.items():
        for block, rows in parts:
            group = groups.setdefault((KINDS[body.blocks[block][0]][1], name), len(groups) + 1)
            back = {v: k for k, v in combos.items()}
            for key in np.unique(keys[block][rows]):
                combo = tuple(sorted(set(back[int(key)]) | {group}))
                hit = rows[keys[block][rows] == key]
                keys[block][hit] = combos.setdefault(combo, len(combos))
                back[combos[combo]] = combo
    back = {v: k for k, v in combos.items()}
    pieces = [(b, np.flatnonzero(key == value), back[int(value)])
              for b, key in enumerate(keys) for value in np.unique(key)]
    return groups, pieces


def unique_tags(body):
    """Numbers of the cells: the file's where all have one and none stands twice."""
    counts = [len(rows) for _, rows in body.blocks]
    ends = np.cumsum([0] + counts)
    plain = [np.arange(ends[k], ends[k + 1]) + 1 for k in range(len(counts))]
    given = [t for t in body.tags if t is not None]
    if not given or len(np.unique(np.concatenate(given))) < sum(map(len, given)):
        return plain
    last = max(int(t.max()) for t in given)
    return [t if t is not None else plain[k] + last for k, t in enumerate(body.tags)]


def write_msh(path, body):
    add_side_blocks(body)
    groups, pieces = classes(body)
    tags = unique_tags(body)
    point_tags = body.point_tags if body.point_tags is not None else np.arange(len(body.points)) + 1
    with open(path, "wb") as file:
        int4 = lambda *v: file.write(np.array(v, "<i4").tobytes())
        int8 = lambda *v: file.write(np.array(v, "<i8").tobytes())
        real = lambda *v: file.write(np.array(v, "<f8").tobytes())
        file.write(b"$MeshFormat\n4.1 1 8\n")
        int4(1)
        file.write(b"\n$EndMeshFormat\n$PhysicalNames\n%d\n" % len(groups))
        for (dim, name), tag in groups.items():
            text = name.replace('"', "'").replace("\n", " ").encode()
            file.write(b'%d %d "%s"\n' % (dim, tag, text))
        file.write(b"$EndPhysicalNames\n$Entities\n")
        dims = [KINDS[body.blocks[b][0]][1] for b, _, _ in pieces]
        int8(*[dims.count(d) for d in range(4)])
        for dim in range(4):
            for k, (block, rows, members) in enumerate(pieces):
                if dims[k] != dim:
                    continue
                int4(k + 1)
                real(*([0.0] * (3 if dim == 0 else 6)))
                int8(len(members))
                int4(*members)
                if dim:
                    int8(0)
        file.write(b"\n$EndEntities\n$Nodes\n")
        int8(1, len(body.points), int(point_tags.min()), int(point_tags.max()))
        int4(dims[0], 1, 0)
        int8(len(body.points))
        file.write(point_tags.astype("<i8").tobytes())
        file.write(body.points.astype("<f8").tobytes())
        file.write(b"\n$EndNodes\n$Elements\n")
        total = sum(len(rows) for _, rows in body.blocks)
        int8(len(pieces), total, 1, int(max(t.max() for t in tags if len(t))))
        for k, (block, rows, _) in enumerate(pieces):
            kind, table = body.blocks[block]
            number, dim, order = KINDS[kind]
            table = table[rows][:, order] if order else table[rows]
            int4(dim, k + 1, number)
            int8(len(rows))
            out = np.column_stack([np.asarray(tags[block])[rows], point_tags[table]])
            file.write(out.astype("<i8").tobytes())
        file.write(b"\n$EndElements\n")


def main():
    if len(sys.argv) != 3:
        stop("expected two names of files")
    source, target = sys.argv[1:]
    end = os.path.splitext(source)[1].lower()
    try:
        if end == ".inp":
            body = read_inp(source)
        elif end == ".cdb":
            body = read_cdb(source)
        elif end == ".unv":
            body = read_unv(source)
        elif end in (".e", ".ex2", ".exo", ".g", ".gen"):
            body = read_exodus(source)
        else:
            body = read_meshio(source)
        if isinstance(body, Points):
            body.write(target)
        elif not body.blocks:
            stop("the file holds no cells")
        else:
            write_msh(target, body)
    except (ImportError, MemoryError, KeyboardInterrupt):
        raise  # kirsch-nodes tells what a failed import says, and what to install
    except Exception as error:  # whatever a broken file provokes in meshio, in one sentence
        words = " ".join(str(error).split())[:200]
        stop(f"the file cannot be read: {type(error).__name__}: {words}")


main()
