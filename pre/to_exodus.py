#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""to_exodus.py FROM.nodes.h5 TO.e: nodes become an Exodus file that Peridigm and PeriLab read.

kirsch-nodes runs it. Every node is an element of kind SPHERE at its place with two attributes, a
radius (that of the sphere of its volume) and the volume; 2D volumes are those of the node file, for
unit thickness. Sets named block_N are blocks, all other sets node sets; nodes in no block_N make
block 1.
"""
import re
import sys

import h5py
import netCDF4
import numpy as np


def text(nc, name, rows, values):
    variable = nc.createVariable(name, "S1", (rows, "len_name"))
    for k, value in enumerate(values):
        raw = value.encode()[:255]
        variable[k, : len(raw)] = np.frombuffer(raw, "S1")


def main(source, target):
    with h5py.File(source) as file:
        position, volume = file["/nodes/position"][:], file["/nodes/volume"][:]
        sets = {name: file["/sets"][name][:] for name in file.get("/sets", {})}
    n, dim = position.shape
    block = np.full(n, 1)
    for name, rows in sets.items():
        if re.fullmatch(r"block_\d+", name):
            block[rows] = int(name[6:])
    sets = {k: v for k, v in sets.items() if not re.fullmatch(r"block_\d+", k) and len(v)}
    numbers = np.unique(block)
    with netCDF4.Dataset(target, "w", format="NETCDF3_64BIT_OFFSET") as nc:
        nc.setncatts({"title": "nodes of Kirsch", "api_version": np.float32(5.1),
                      "version": np.float32(5.1), "floating_point_word_size": np.int32(8),
                      "file_size": np.int32(1)})
        for name, size in (("len_string", 33), ("len_line", 81), ("len_name", 256), ("four", 4),
                           ("time_step", None), ("num_dim", 3), ("num_nodes", n), ("num_elem", n),
                           ("num_el_blk", len(numbers))):
            nc.createDimension(name, size)
        nc.createVariable("time_whole", "f8", ("time_step",))
        for d, axis in enumerate("xyz"):
            nc.createVariable("coord" + axis, "f8", ("num_nodes",))[:] = (
                position[:, d] if d < dim else 0.0)
        text(nc, "coor_names", "num_dim", "xyz")
        write_blocks(nc, block, numbers, volume)
        if sets:
            nc.createDimension("num_node_sets", len(sets))
            nc.createVariable("ns_status", "i4", ("num_node_sets",))[:] = 1
            ids = nc.createVariable("ns_prop1", "i4", ("num_node_sets",))
            ids.setncattr("name", "ID")
            ids[:] = np.arange(len(sets)) + 1
            text(nc, "ns_names", "num_node_sets", sets)
            for k, rows in enumerate(sets.values(), 1):
                nc.createDimension(f"num_nod_ns{k}", len(rows))
                nc.createVariable(f"node_ns{k}", "i4", (f"num_nod_ns{k}",))[:] = rows + 1


def write_blocks(nc, block, numbers, volume):
    nc.createVariable("eb_status", "i4", ("num_el_blk",))[:] = 1
    ids = nc.createVariable("eb_prop1", "i4", ("num_el_blk",))
    ids.setncattr("name", "ID")
    ids[:] = numbers
    text(nc, "eb_names", "num_el_blk", [f"block_{b}" for b in numbers])
    for k, b in enumerate(numbers, 1):
        rows = np.flatnonzero(block == b)
        nc.createDimension(f"num_el_in_blk{k}", len(rows))
        nc.createDimension(f"num_nod_per_el{k}", 1)
        nc.createDimension(f"num_att_in_blk{k}", 2)
        connect = nc.createVariable(f"connect{k}", "i4", (f"num_el_in_blk{k}", f"num_nod_per_el{k}"))
        connect.setncattr("elem_type", "SPHERE")
        connect[:] = rows[:, None] + 1
        attribute = nc.createVariable(f"attrib{k}", "f8", (f"num_el_in_blk{k}", f"num_att_in_blk{k}"))
        attribute[:, 0] = np.cbrt(3 * volume[rows] / (4 * np.pi))
        attribute[:, 1] = volume[rows]


try:
    main(*sys.argv[1:3])
except OSError as error:
    print(f"Error: {error}", file=sys.stderr)
    sys.exit(1)
