# SPDX-License-Identifier: BSD-3-Clause
"""What the three cases of PMMA plates with rows of pores share: section 5 of the plates paper."""
import os

import h5py
import matplotlib.pyplot as pyplot
import numpy
from matplotlib.collections import LineCollection

from common import FULL, Case, table_of

RADIUS, PITCH, ROWS = 0.75e-3, 50e-3 / 9, 8
MIDDLE = 12.5e-3
OFFSETS = {"pmma-a": (0.0,), "pmma-b": (0.5,), "pmma-c": (-0.5, 0.5)}  # of the rows from the middle, in pitches
NOTCH = {"long": 2e-3, "short": 0.75e-3}
# The short notch holds longer: the run goes on until the crack is through.
END = {"long": "400 us", "short": "460 us"}


def mean_speed(tips, low, high):
    """Mean speed over Rayleigh's of the tips between two x."""
    inside = (tips["x [m]"] >= low) & (tips["x [m]"] <= high)
    speed = tips["speed_over_rayleigh"][inside]
    return numpy.nanmean(speed) if numpy.isfinite(speed).any() else numpy.nan


def valleys(tips):
    """How many pores lie in a valley of the speed, and of how many: slower beside the pore than the
    mean of both middles between pores."""
    low, seen = 0, 0
    for k in range(1, ROWS + 1):
        x = k * PITCH
        beside = mean_speed(tips, x - RADIUS, x + RADIUS)
        between = (mean_speed(tips, x - PITCH / 2 - RADIUS, x - PITCH / 2 + RADIUS) +
                   mean_speed(tips, x + PITCH / 2 - RADIUS, x + PITCH / 2 + RADIUS)) / 2
        if numpy.isfinite(beside) and numpy.isfinite(between):
            seen += 1
            low += bool(beside < between)
    return low, seen


def times_at(folder, places):
    """When the tip comes to each x of `places` [m], NaN where it does not; [s]. The tip is the foremost node with a
    damage of 0.35, as in the paper's appendix 2."""
    with h5py.File(os.path.join(folder, "run.h5")) as file:
        x, time = file["nodes/position"][:, 0], file["crack/Damage_Time"][:]
    order = numpy.argsort(time, kind="stable")  # nodes without damage have no time, and come last
    order = order[numpy.isfinite(time[order])]
    return numpy.append(time[order], numpy.nan)[numpy.searchsorted(numpy.maximum.accumulate(x[order]), places)]


def at_first_pore(folder):
    """Speed over Rayleigh's at the edge of the first pore: the mean over two horizons that end half a horizon before it.
    A speed fitted to fewer and fewer places of the tip as they come to an end says less the nearer it is to the edge."""
    with h5py.File(os.path.join(folder, "run.h5")) as file:
        horizon = file.attrs["horizon"]
    end = PITCH - RADIUS - horizon / 2
    begins, ends = times_at(folder, [end - 2 * horizon, end])
    return 2 * horizon / (ends - begins) / summary_of(os.path.join(folder, "summary.csv"))["rayleigh_speed"]


def times_at_pores(folder):
    """When the tip arrives at each pore of a row on the crack's line, and when it leaves it [s], and the way between
    [m]: it is at an edge of a pore when it is half a horizon away."""
    with h5py.File(os.path.join(folder, "run.h5")) as file:
        way = 2 * RADIUS + file.attrs["horizon"]
    centre = PITCH * numpy.arange(1, ROWS + 1)
    return times_at(folder, centre - way / 2), times_at(folder, centre + way / 2), way


def trapped(folder):
    """For each pore but the first, where the crack may wait for the load: time in it over the time that the crack takes
    for as long a way before it (Fig. 16 of the paper)."""
    arrives, leaves, way = times_at_pores(folder)
    share = (leaves - arrives)[1:] / (arrives[1:] - leaves[:-1]) * (PITCH - way) / way
    return share[numpy.isfinite(share)]


def dispersed(folder):
    """How many nodes with a broken bond lie more than a horizon away from every cracked node (damage above 0.35 at any
    time, as the paper's appendix 2 has it), at the end."""
    last = sorted(name for name in os.listdir(os.path.join(folder, "run")) if name[0] == "0")[-1]
    with h5py.File(os.path.join(folder, "run", last)) as file:
        damaged = file["Damage"][:] > 0
    with h5py.File(os.path.join(folder, "run.h5")) as file:
        place, horizon = file["nodes/position"][:, :2], file.attrs["horizon"]
        cracked = numpy.isfinite(file["crack/Damage_Time"][:])
    away = 0
    crack, rest = place[cracked], place[damaged & ~cracked]
    for part in numpy.array_split(rest, len(rest) // 200 + 1):
        apart = numpy.hypot(*(part[:, None, :] - crack[None, :, :]).T)
        away += int((apart.min(axis=0) > horizon).sum())
    return away


def summary_of(path):
    table = table_of(path)
    return dict(zip(table["name"], table["value"]))


def look(case, label):
    """Tables of one run, and the rows that all cases have."""
    tips = table_of(case.path(label, "tips.csv"))
    events = table_of(case.path(label, "events.csv"))
    branches = table_of(case.path(label, "branches.csv"))
    summary = summary_of(case.path(label, "summary.csv"))
    end = list(branches["end"])
    case.row(f"{label}: first growth [us]", 1e6 * summary["first_growth"])
    case.row(f"{label}: crack through [us]", 1e6 * summary["arrival"])
    case.row(f"{label}: pores passed through", events["kind"].count("leave hole"))
    case.row(f"{label}: branches", int(summary["branches"]))
    case.row(f"{label}: branches that end inside", end.count("arrest"))
    case.row(f"{label}: greatest speed over Rayleigh's", summary["top_speed_over_rayleigh"],
             verdict=bool(summary["top_speed_over_rayleigh"] < 1), source="below 1: theory")
    case.row(f"{label}: energy balance over work", abs(summary["energy_balance"]),
             reference=0.0, tolerance=0.03, source="ours")
    return tips


def run(case, notch, grid=None, deck="case.yaml", owner="", padding=None):
    """Run a deck with this notch on this grid (None: the deck's), as a run of the case `owner`; with this padding [mm]
    around pores (None: the deck's)."""
    label = owner + "-".join([notch] + [str(word) for word in (grid, padding) if word])
    settings = {"cracks.precracks.0.to": f"[{1e3 * NOTCH[notch]} mm, 12.5 mm]",
                "solver.end_time": END[notch]}
    if grid:
        settings["mesh.grid"] = grid
    if padding:
        settings["mesh.padding"] = f"{padding} mm"
    if grid == "voronoi":
        settings["nodes.partial_volume"] = "exact-centroid"
    case.kirsch(label, settings, until="track", deck=deck)
    return label


def draw_path(case, label, axis, plate):
    """The tips of each branch, coloured by their speed over Rayleigh's, and the pores."""
    tips = table_of(case.path(label, "tips.csv"))
    for branch in sorted(set(tips["branch"])):
        of = tips["branch"] == branch
        points = 1e3 * numpy.column_stack([tips["x [m]"][of], tips["y [m]"][of]])
        pieces = numpy.stack([points[:-1], points[1:]], axis=1)
        lines = axis.add_collection(LineCollection(pieces, cmap="viridis", linewidths=1.6))
        lines.set(array=tips["speed_over_rayleigh"][of][1:], clim=(0, 1))
    for k in range(1, ROWS + 1):
        for offset in OFFSETS[plate]:
            centre = 1e3 * k * PITCH, 1e3 * (MIDDLE + offset * PITCH)
            axis.add_patch(pyplot.Circle(centre, 1e3 * RADIUS, fill=False, lw=0.6))
    axis.set(xlim=(0, 50), ylim=(5, 20), aspect="equal", title=label)
    return lines


def draw(case, labels, plate):
    """All runs of a case on one plate (a key of OFFSETS) in one picture."""
    rows = (len(labels) + 1) // 2
    figure, axes = pyplot.subplots(rows, 2, figsize=(11, 0.8 + 1.9 * rows), layout="constrained",
                                  sharex=True, sharey=True)
    for axis in axes.flat[len(labels):]:
        axis.set_visible(False)
    for axis, label in zip(axes.flat, labels):
        lines = draw_path(case, label, axis, plate)
    figure.colorbar(lines, ax=axes, label="crack speed / Rayleigh speed")
    figure.supxlabel("x [mm]")
    figure.supylabel("y [mm]")
    case.save(figure, "paths.png")


def compare(name, first_pore):
    """Run one arrangement with both notches on the paper's grid, and on ours (full: the long one alone).

    first_pore  {notch: test of the speed over Rayleigh's at the edge of the first pore, its words}
    """
    case, labels = Case(name), []
    for grid, notch in ((None, "long"), (None, "short"), ("voronoi", "long"), ("voronoi", "short")):
        if FULL and grid and notch == "short":
            continue
        label = run(case, notch, grid)
        labels.append(label)
        tips = look(case, label)
        speed = at_first_pore(case.path(label))
        test, words = first_pore[notch]
        case.row(f"{label}: speed over Rayleigh's at the first pore", speed,
                 verdict=bool(test(speed)), source=words)
        low, seen = valleys(tips)
        if name != "pmma-a":
            case.row(f"{label}: pores beside a valley of the speed", f"{low} of {seen}",
                     verdict=bool(seen and low > seen / 2), source="paper, Fig. 15: valleys at the pores")
        share = trapped(case.path(label)) if name == "pmma-a" else []
        if len(share):
            case.row(f"{label}: time in a pore over that for as long a way before it, median of {len(share)}",
                     float(numpy.median(share)), reference=1.0, tolerance=0.25,
                     source="paper, Fig. 16: the same; read off a curve")
    draw(case, labels, name)
    case.finish()
