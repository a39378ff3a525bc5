# SPDX-License-Identifier: BSD-3-Clause
"""Exodus for to_msh.py: blocks, node sets and side sets are sets; SPHERE elements become points with volumes.
"""
import re

import numpy as np

from body import Body, Points, middles, stop

# Faces of solids in Exodus's side sets, by its side numbers; corners count from 0.
SIDES = {
    "triangle": [(0, 1), (1, 2), (2, 0)], "quad": [(0, 1), (1, 2), (2, 3), (3, 0)],
    "tetra": [(0, 1, 3), (1, 2, 3), (0, 3, 2), (0, 2, 1)],
    "hexahedron": [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (0, 4, 7, 3), (0, 3, 2, 1), (4, 5, 6, 7)],
    "wedge": [(0, 1, 4, 3), (1, 2, 5, 4), (0, 3, 5, 2), (0, 2, 1), (3, 4, 5)],
    "pyramid": [(0, 1, 4), (1, 2, 4), (2, 3, 4), (0, 4, 3), (0, 3, 2, 1)],
}


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
