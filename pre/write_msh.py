# SPDX-License-Identifier: BSD-3-Clause
"""A body as MSH 4.1 binary, for to_msh.py: a cell in several groups has all of them, for cells of like groups
make one entity. A set of points is a physical group of points (dimension 0).
"""
import numpy as np

from body import KINDS


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
