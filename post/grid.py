# SPDX-License-Identifier: BSD-3-Clause
"""The grid around a hole or a void: cells by their size. Of a solid, what a plane cuts of them."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from maps import save
from results import Fault
from section import cut_cells
from shape import AXES, plane_of
from style import plt


def close_up(case, choice):
    """Middle [mm] and half width of the picture: about 3 radii around the hole or void asked for,
    else around the one nearest to the middle; or 40 spacings where there is none."""
    lower, upper = case.box()
    middle, half = (lower + upper) / 2, 20 * case.cells()[4]
    if choice.place is not None:
        round_one = choice.place
    else:
        there = [h for h in case.holes + case.voids if h[-1] > 0]
        if not there:
            return middle, half
        round_one = min(there, key=lambda h: np.linalg.norm(h[:-1] - middle[:len(h) - 1]))
    middle[:len(round_one) - 1] = round_one[:-1]
    return middle, max(1.6 * round_one[-1], round_one[-1] + 4 * case.cells()[4])


class Choice:
    """What `--hole N`, `--void N` and `--slice z=2 mm` ask for."""

    def __init__(self, case, hole=None, void=None, cut=None):
        self.place, self.name, self.axis, self.level = None, "", 2, None
        for kind, number, known in (("hole", hole, case.holes), ("void", void, case.voids)):
            if number is None:
                continue
            if not number.isdigit() or not 1 <= int(number) <= len(known):
                raise Fault("there is no %s %s; the case has %d" % (kind, number, len(known)))
            self.place = known[int(number) - 1]
            self.name += "_%s_%s" % (kind, number)
            if not self.place[-1] > 0:
                raise Fault("void %s comes from a file: give a plane by --slice instead" % number)
        if cut is not None:
            self.axis, self.level = plane_of(cut)
            self.name += "_" + AXES[self.axis]


def grid(case, choice):
    middle, half = close_up(case, choice)
    draw = flat if len(middle) == 2 else section
    if len(middle) == 2 and choice.level is not None:
        raise Fault("a plate has no slices: leave out --slice")
    figure, axes = plt.subplots(figsize=(4.6, 3.9), constrained_layout=True)
    cells, label = draw(case, choice, middle, half, axes)
    figure.colorbar(cells, ax=axes, label=label, shrink=0.9)
    return save(case, figure, "grid" + choice.name)


def colour(cells, sizes):
    cells.set_clim(0, max(1.5, np.percentile(sizes, 99.5)))
    return cells


def flat(case, choice, middle, half, axes):
    point, first, vertex, area, spacing = case.cells()
    centre = point[vertex[first[:-1]]]
    seen = np.flatnonzero((np.abs(centre - middle) < half + 2 * spacing).all(axis=1))
    if not len(seen):
        raise Fault("there are no cells around (%.4g, %.4g) mm" % tuple(middle))
    sizes = area[seen] / spacing**2
    cells = PolyCollection([point[vertex[first[k]:first[k + 1]]] for k in seen], array=sizes,
                           cmap="YlGnBu", edgecolor="0.25", linewidth=0.25)
    axes.add_collection(colour(cells, sizes))
    frame(axes, middle, half, (0, 1))
    axes.set_title("%d cells, %d shown; spacing %.4g mm" % (len(area), len(seen), spacing))
    return cells, "area of a cell / spacing²"


def frame(axes, middle, half, shown):
    a, b = shown
    axes.set(xlim=(middle[a] - half, middle[a] + half), ylim=(middle[b] - half, middle[b] + half),
             xlabel=AXES[a] + " (mm)", ylabel=AXES[b] + " (mm)", aspect="equal")


# ---- solids ------------------------------------------------------------------------------------

def section(case, choice, middle, half, axes):
    volume, spacing = case.cells()[3:]
    axis, level = choice.axis, middle[choice.axis] if choice.level is None else choice.level
    polygons, of, lines, count = cut_cells(case.cells(), (axis, level), middle, half + 2 * spacing)
    sizes = volume[of] * 1e3 / spacing**3  # the file's mm^2 are m^3 times 1e6
    cells = PolyCollection(polygons, array=sizes, cmap="YlGnBu", linewidth=0.6, edgecolor="face")
    axes.add_collection(colour(cells, sizes))
    axes.add_collection(LineCollection(lines, colors="0.25", linewidths=0.3))
    frame(axes, middle, half, [d for d in range(3) if d != axis])
    axes.set_title("%d cells, %d in the plane %s = %.4g mm; spacing %.4g mm"
                   % (len(volume), count, AXES[axis], level, spacing))
    return cells, "volume of a cell / spacing³"
