#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""to_msh.py FROM TO.msh: a mesh in the format of another program becomes MSH 4.1 with all its named sets.

kirsch-nodes runs it. meshio reads the cells where it can; the named sets are taken from wherever the format
keeps them, also where meshio itself loses them. A module from_*.py for each family of formats fills a Body
(body.py), and write_msh.py writes it.
"""
import os
import sys

from body import Points, stop
from from_fluent import is_by_faces
from write_msh import write_msh


def reader_of(path):
    """The function that reads a file, by its ending. A module is loaded when its format is there: netCDF4 and
    meshio may be missing."""
    end = os.path.splitext(path)[1].lower()
    if end == ".inp":
        from from_abaqus import read_inp as read
    elif end == ".cdb":
        from from_cdb import read_cdb as read
    elif end == ".unv":
        from from_unv import read_unv as read
    elif end in (".e", ".ex2", ".exo", ".g", ".gen"):
        from from_exodus import read_exodus as read
    elif end in (".msh", ".cas") and is_by_faces(path):
        from from_fluent import read_fluent as read
    else:
        from from_meshio import read_meshio as read
    return read


def main():
    if len(sys.argv) != 3:
        stop("expected two names of files")
    source, target = sys.argv[1:]
    try:
        body = reader_of(source)(source)
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
