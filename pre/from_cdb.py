# SPDX-License-Identifier: BSD-3-Clause
"""ANSYS .cdb for to_msh.py: NBLOCK, EBLOCK and CMBLOCK, read by the widths of their formats, and ET.
"""
import re

import numpy as np

from body import Body, note, stop

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
