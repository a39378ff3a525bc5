# SPDX-License-Identifier: BSD-3-Clause
"""Abaqus .inp for to_msh.py: parts, instances, sets and surfaces. meshio mixes up sets of several blocks and
leaves instances unmoved.
"""
import os
import re

import numpy as np

from body import Body, middles, note, stop


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
