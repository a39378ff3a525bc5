# SPDX-License-Identifier: BSD-3-Clause
"""Read what the other programs left in a case's folder (docs/formats.md)."""
import copy
import csv
import os
import sys

import h5py
import numpy as np


class Fault(Exception):
    """What the user can cure: one sentence, then exit 2."""


class Nothing(Exception):
    """There is nothing to draw, and no fault in that: a plate that held has no crack tip."""


def warn(sentence):
    sys.stdout.flush()
    print("kirsch-plot: warning: " + sentence, file=sys.stderr)


def open_h5(path, kind):
    """Open a file of ours, or say in one sentence why not."""
    if not os.path.exists(path):
        raise Fault("%s is missing; run the step that writes it" % path)
    try:
        file = h5py.File(path, "r")
    except OSError:
        raise Fault("cannot open %s: it is no HDF5 file, cut short or damaged" % path)
    found = file.attrs.get("format", "none")
    if found != kind:
        raise Fault("%s is of the kind \"%s\"; expected \"%s\"" % (path, found, kind))
    return file


def read_csv(path):
    """Columns by their names without the unit; empty fields are NaN."""
    if not os.path.exists(path):
        raise Fault("%s is missing; run the step that writes it" % path)
    with open(path, newline="") as file:
        rows = list(csv.reader(file, skipinitialspace=True))
    try:
        values = np.array([[float(x) if x else np.nan for x in row] for row in rows[1:] if row])
        values = values.reshape(-1, len(rows[0]))
    except (ValueError, IndexError):
        raise Fault("%s is no table of numbers" % path)
    return {name.split(" [")[0]: values[:, k] for k, name in enumerate(rows[0])}


def read_summary(path):
    """Values of summary.csv by name; empty where the file is missing."""
    if not os.path.exists(path):
        return {}
    with open(path, newline="") as file:
        return {row["name"]: float(row["value"]) for row in csv.DictReader(file)}


class Case:
    """A case's folder. Lengths are in mm for the pictures, times in us; files are opened when a
    picture asks for them."""

    def __init__(self, folder, holes, voids=()):
        self.folder = folder
        self.holes = [tuple(1e3 * x for x in hole) for hole in holes]
        self.voids = [tuple(1e3 * x for x in void) for void in voids]
        self.summary = read_summary(self.path("summary.csv"))
        self.rasters = {}  # of the whole plate, by their width in pixels
        self.plane = None  # axis and level [mm] of maps of a solid, unless the command line tells
        self._cells = self._run = None

    def path(self, name):
        return os.path.join(self.folder, name)

    def seen_in(self, plane):
        """The same case, its maps in another plane."""
        seen = copy.copy(self)
        seen.plane, seen.rasters = plane, {}
        return seen

    def cells(self):
        """Points [mm], first, vertex, area [mm^2], spacing [mm]."""
        if self._cells is None:
            with open_h5(self.path("plate.nodes.h5"), "kirsch nodes") as file:
                if "cells" not in file or not len(file["cells/vertex"]):
                    raise Fault("%s has no cells to draw: its nodes came without a mesh"
                                % self.path("plate.nodes.h5"))
                self._cells = (1e3 * file["cells/point"][:], file["cells/first"][:],
                               file["cells/vertex"][:], 1e6 * file["nodes/volume"][:],
                               1e3 * file.attrs["spacing"])
        return self._cells

    def box(self):
        """Corners of the plate [mm]."""
        point = self.cells()[0]
        return point.min(axis=0), point.max(axis=0)

    def run(self):
        if self._run is None:
            self._run = open_h5(self.path("run.h5"), "kirsch run")
            nodes = len(self._run["nodes/volume"])
            if nodes != len(self.cells()[3]):
                raise Fault("run.h5 has %d nodes, plate.nodes.h5 has %d: they are not of one case"
                            % (nodes, len(self.cells()[3])))
            if not len(self.written()):
                raise Fault("%s holds no output yet" % self.path("run.h5"))
        return self._run

    def written(self):
        """Names of the outputs that are there: run.h5 links to those still to come, too."""
        group = self._run.get("step", {})
        return sorted(name for name in group if group.get(name) is not None)

    def steps(self):
        """Names of the outputs and their times [us], in order."""
        self.run()
        names = self.written()
        return names, np.array([1e6 * self.run()["step"][n].attrs["time"] for n in names])

    def field(self, step, name):
        return self.run()["step"][step][name][:]
