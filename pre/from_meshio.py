# SPDX-License-Identifier: BSD-3-Clause
"""What meshio reads, for to_msh.py, with its sets: cell_sets, point_sets, MED's families, and whole-numbered
cell data, one set a value.
"""
import re

import numpy as np

from body import Body, note, stop


def note_zones(path):
    """Fluent's .msh as meshio reads and writes it: cells by their corners. It passes over names of zones."""
    with open(path, "rb") as file:
        # (39 (4 wall left)()) or (45 (4 wall left)()): number, kind and name of a zone
        names = re.findall(rb"\(\s*(?:39|45)\s*\(\s*\w+\s+\S+\s+([^\s()]+)", file.read())
    kept = [n.decode(errors="replace") for n in dict.fromkeys(names)]
    if kept:
        note(f"the zones {', '.join(kept[:8])} of a Fluent mesh make no sets; name sets by place in the deck")


def read_meshio(path):
    import meshio

    if path.lower().endswith(".msh"):
        note_zones(path)
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
