# SPDX-License-Identifier: BSD-3-Clause
"""Finite elements on the cells of a plate, by CalculiX: plane stress, at the Poisson ratio of the bonds."""
import os
import subprocess
import sys

import h5py
import numpy


MM = 1e-3  # m; ccx has lengths in mm, for it takes determinants below 1e-20, as of slivers in m, for 0


class Cells:
    """Nodes and cells of a plate.nodes.h5 whose lengths are in this unit [m]."""

    def __init__(self, folder, unit=1.0):
        with h5py.File(os.path.join(folder, "plate.nodes.h5")) as file:
            self.position = unit * file["nodes/position"][:]
            self.volume = unit**2 * file["nodes/volume"][:]
            self.point = unit * file["cells/point"][:]
            self.first = file["cells/first"][:]
            self.vertex = file["cells/vertex"][:]
            self.sets = {name: file["sets/" + name][:] for name in file["sets"]}

    def mean_over_corners(self, value):
        """What the corners of each cell have in the mean."""
        total = numpy.add.reduceat(value[self.vertex], self.first[:-1], axis=0)
        count = numpy.diff(self.first)
        return total / (count if value.ndim == 1 else count[:, None])

    def corners_of(self, nodes):
        """The corners of these nodes' cells, each once."""
        return numpy.unique(numpy.concatenate([self.vertex[self.first[i]:self.first[i + 1]]
                                               for i in nodes]))


HEAD = """*INCLUDE, INPUT=plate.inp
*MATERIAL, NAME=plate
*ELASTIC
{youngs_modulus:.13g}, {poisson:.13g}
*SOLID SECTION, ELSET=cells, MATERIAL=plate
{thickness:.6g}
*BOUNDARY
{boundary}
*STEP
*STATIC, SOLVER=SPOOLES
*BOUNDARY
{loads}
*NODE FILE, OUTPUT=2D
U
*EL FILE, OUTPUT=2D
S
*END STEP
"""


def thickness_of(cells, share):
    """ccx makes bricks of plane elements, one through the thickness. Where they are much thinner than wide, each can
    become thinner for itself, as plane stress has it; as thick as many cells, the plate is nearly in plane strain.
    In mm."""
    return share * numpy.sqrt(cells.volume.mean()) / MM


def solve(build, folder, holds, youngs_modulus, poisson=1 / 3, thinness=0.05):
    """Solve on the cells of FOLDER/plate.msh, within FOLDER/ccx: the cells, displacements (corners x
    2) and stresses (corners x 3: xx, yy, xy) at their corners.

    holds: a function of the cells that gives {(set or number of a corner, component 1 or 2):
    displacement}; thinness: thickness over the width of a cell. What is newer than its input is not found again.
    """
    work = os.path.join(folder, "ccx")
    os.makedirs(work, exist_ok=True)
    mesh, inp = os.path.join(folder, "plate.msh"), os.path.join(work, "plate.inp")
    if not is_newer(inp, mesh):
        subprocess.check_call([os.path.join(build, "kirsch-nodes"), "--convert", mesh, "--unit", "km",
                               "--output", work, "--write", "inp"], stdout=subprocess.DEVNULL)
    cells = Cells(work, MM)
    lines = [f"{where}, {d}, {d}, {value / MM:.13g}" for (where, d), value in holds(cells).items()]
    text = HEAD.format(youngs_modulus=youngs_modulus, poisson=poisson, loads="\n".join(lines),
                       thickness=thickness_of(cells, thinness), boundary="\n".join(line.rsplit(",", 1)[0] for line in lines))
    run(work, text, inp)
    fields = read_frd(os.path.join(work, "fem.frd"))
    corners = len(cells.point)
    return cells, MM * fields["DISP"][:corners, :2], fields["STRESS"][:corners, [0, 1, 3]]


def is_newer(path, than):
    return os.path.exists(path) and os.path.getmtime(path) >= os.path.getmtime(than)


def run(work, text, inp):
    """ccx on this input, unless its results are there."""
    deck, result = os.path.join(work, "fem.inp"), os.path.join(work, "fem.frd")
    if is_newer(deck, inp) and is_newer(result, deck) and open(deck).read() == text:
        return
    with open(deck, "w") as file:
        file.write(text)
    log = os.path.join(work, "fem.log")
    with open(log, "w") as to:
        code = subprocess.call(["ccx", "fem"], cwd=work, stdout=to, stderr=subprocess.STDOUT)
    if code or "*ERROR" in open(log).read():
        sys.exit(f"ccx failed; see {log}")


def read_frd(path):
    """Fields at nodes of CalculiX's ASCII results {name: (nodes x components)}, in rising numbers."""
    fields, name, lines = {}, None, []
    with open(path) as file:
        for line in file:
            if line.startswith(" -4"):
                name, lines = line.split()[1], []
            elif line.startswith(" -1") and name:
                lines.append(line)
            elif line.startswith(" -3") and name:
                fields[name] = numbers_of(lines)
                name = None
    return fields


def numbers_of(lines):
    count = (len(lines[0].rstrip("\n")) - 13) // 12
    return numpy.array([[float(line[13 + 12 * k:25 + 12 * k]) for k in range(count)]
                        for line in lines])
