# SPDX-License-Identifier: BSD-3-Clause
"""UNV (I-DEAS universal files; Salome, Code_Aster) for to_msh.py, by datasets: 164 units, 2411 and 781 nodes,
2412 elements, 2429 to 2477 groups. gmsh 4.8 crashes on groups of nodes and passes over the unit.
"""
import numpy as np

from body import Body, note, stop

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
