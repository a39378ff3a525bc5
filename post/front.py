# SPDX-License-Identifier: BSD-3-Clause
"""The front of a crack in a solid (front.csv), curve by curve in time, seen across the crack: over the damage in
the plane of the body that the fronts lie about."""
import numpy as np
from matplotlib.collections import LineCollection

from maps import outline_material, paint, panels, save, show
from results import Nothing, read_csv
from shape import AXES, plane


def curves(table, axes, far):
    """Ways (points, 2) in mm, and the time [us] of each; rings are closed where their ends are near."""
    ways, times = [], []
    key = np.stack([table["time"], table["curve"]], axis=1)
    begins = np.flatnonzero(np.r_[True, (key[1:] != key[:-1]).any(axis=1)])
    for a, b in zip(begins, np.r_[begins[1:], len(key)]):
        way = 1e3 * np.stack([table[AXES[k]][a:b] for k in axes], axis=1)
        if b - a > 4 and np.hypot(*(way[0] - way[-1])) < far:
            way = np.concatenate([way, way[:1]])
        ways.append(way)
        times.append(1e6 * table["time"][a])
    return ways, np.array(times)


def front(case):
    table = read_csv(case.path("front.csv"))
    if not len(table["time"]):
        raise Nothing("there is no crack front in %s" % case.path("front.csv"))
    place = 1e3 * np.stack([table[a] for a in AXES])
    axis = int(np.ptp(place, axis=1).argmin())  # the direction in which the fronts reach least
    return draw(case.seen_in((axis, float(np.median(place[axis])))), table)


def draw(case, table):
    axis, level = plane(case)
    ways, times = curves(table, [a for a in range(3) if a != axis], 3 * case.cells()[4])
    figure, (axes,), bar, pixels = panels(case, 1)
    painted = paint(case, case.field(case.steps()[0][-1], "Damage"), pixels)
    show(axes, case, painted, "Greys", 3)
    outline_material(axes, case, painted)
    lines = LineCollection(ways, array=times, cmap="viridis", linewidth=1.4, capstyle="round")
    axes.add_collection(lines)
    axes.set_title("fronts over the damage in the plane %s = %.4g mm" % (AXES[axis], level), pad=3)
    figure.colorbar(lines, cax=bar, label="time (µs)")
    return save(case, figure, "front")
