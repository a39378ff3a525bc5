# SPDX-License-Identifier: BSD-3-Clause
"""Curves: crack speed over the final damage, tip position and energies in time."""
import numpy as np

from maps import outline_holes, paint, panels, save, show
from results import Nothing, read_csv
from shape import frame
from style import COLOURS, DAMAGE, box_label, open_axes, plt

STYLES = "-", "--", "-.", ":"  # of the first, second ... seven branches
SMOOTH = 15  # moves of the tip


def tips_by_box(case):
    """List of (branch, columns of tips.csv in mm and us)."""
    tips = read_csv(case.path("tips.csv"))
    if not len(tips["branch"]):
        raise Nothing("there is no crack tip in %s" % case.path("tips.csv"))
    result = []
    for box in np.unique(tips["branch"]):
        rows = tips["branch"] == box
        result.append((int(box), {"x": 1e3 * tips["x"][rows], "y": 1e3 * tips["y"][rows],
                                  "time": 1e6 * tips["time"][rows],
                                  "distance": 1e3 * tips["distance"][rows],
                                  "speed": tips["speed_over_rayleigh"][rows]}))
    return result


def holes_on_path(case, tips):
    """Holes within a radius of which a tip came."""
    def near(hole):
        return any((np.hypot(t["x"] - hole[0], t["y"] - hole[1]) < 2 * hole[2]).any()
                   for _, t in tips)
    return [hole for hole in case.holes if near(hole)]


def smooth(values):
    """Moving mean over the values there are; the tip moves by whole cells, so they scatter."""
    known = np.isfinite(values)
    window, middle = np.ones(SMOOTH), slice(SMOOTH // 2, SMOOTH // 2 + len(values))
    total = np.convolve(np.where(known, values, 0), window)[middle]
    count = np.convolve(known.astype(float), window)[middle]
    return np.where(known, total / np.maximum(count, 1), np.nan)


def pieces(tip, jump):
    """Slices of the tip's way between holes: across one it goes by more than `jump`, its path does not."""
    moved = np.hypot(np.diff(tip["x"]), np.diff(tip["y"])) - np.diff(tip["distance"])
    ends = [0, *(np.flatnonzero(moved > jump) + 1), len(tip["x"])]
    return [slice(a, b) for a, b in zip(ends[:-1], ends[1:])]


def speed(case):
    """Speed of the tip above its place, as in figure 15 of the plates paper."""
    tips = tips_by_box(case)
    names, _ = case.steps()
    figure, (axes,), bar, pixels = panels(case, 1)
    painted = paint(case, case.field(names[-1], "Damage"), pixels)
    show(axes, case, painted, DAMAGE, 1).set_alpha(0.45)
    outline_holes(axes, case, painted)
    bar.remove()
    for x, _, _ in holes_on_path(case, tips):
        axes.axvline(x, linestyle=(0, (4, 3)), linewidth=0.7, color="0.45")
    over = axes.twinx()
    jump = 0.5e3 * case.run().attrs["horizon"]
    highest = 0
    for box, t in tips:
        colour = COLOURS[(box - 1) % len(COLOURS)]
        style = STYLES[(box - 1) // len(COLOURS) % len(STYLES)]
        numbered = len(tips) > 1
        for some in pieces(t, jump):
            x, values, bold = t["x"][some], t["speed"][some], smooth(t["speed"][some])
            there = np.flatnonzero(np.isfinite(bold))
            if numbered and len(there):
                at = there[len(there) // 2]
                over.annotate("%d" % box, (x[at], bold[at]), xytext=(0, 4), textcoords="offset points",
                              ha="center", color=colour, fontsize=8, fontweight="bold")
                numbered = False
            over.plot(x, values, color=colour, linewidth=0.4, alpha=0.45)
            over.plot(x, bold, style, color=colour, linewidth=1.4)
            highest = max(highest, np.nanmax(np.append(bold, 0)))
    over.set_ylim(0, max(1, 1.08 * highest))
    lower, upper = frame(case)
    axes.set_xlim(lower[0], upper[0])
    over.set_ylabel("crack speed / Rayleigh speed")
    over.set_title("bold: mean over %d moves of the tip" % SMOOTH, loc="right", pad=3)
    if len(tips) > 1:
        over.set_title("at the curves: numbers of branches", loc="left", pad=3)
    return save(case, figure, "speed")


def tip(case):
    """Place of the tip in time; holes it meets are grey bands."""
    tips = tips_by_box(case)
    across = np.ptp(np.concatenate([t["x"] for _, t in tips])) >= np.ptp(
        np.concatenate([t["y"] for _, t in tips]))
    key, axis = ("x", 0) if across else ("y", 1)
    figure, axes = plt.subplots(figsize=(4.6, 3.2), constrained_layout=True)
    for hole in holes_on_path(case, tips):
        axes.axhspan(hole[axis] - hole[2], hole[axis] + hole[2], color="0.9", linewidth=0)
    for box, t in tips:
        axes.plot(t["time"], t[key], STYLES[(box - 1) // len(COLOURS) % len(STYLES)],
                  drawstyle="steps-post",
                  color=COLOURS[(box - 1) % len(COLOURS)], label=box_label(box, tips))
    axes.set(xlabel="time (µs)", ylabel="tip position %s (mm)" % key)
    open_axes(axes)
    if len(tips) > 1:
        axes.legend(loc="upper left")
    return save(case, figure, "tip")


def history(case):
    """Energies in time, and how well they balance."""
    h = read_csv(case.path("history.csv"))
    time = 1e6 * h["time"]
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(4.6, 4.0), sharex=True,
                                          constrained_layout=True,
                                          gridspec_kw={"height_ratios": [3, 1]})
    for name, label, line in (("external_work", "external work", "-"), ("strain", "strain", "-"),
                              ("kinetic", "kinetic", "-"), ("fracture", "fracture", "-")):
        upper.plot(time, h[name], line, label=label)
    with open(case.path("history.csv")) as file:
        of = " per m of thickness" if "[J/m]" in file.readline() else ""
    upper.set_ylabel("energy (J%s)" % of)
    upper.legend(loc="upper left")
    lower.plot(time, h["balance"], color=COLOURS[-1], linewidth=0.8)
    lower.axhline(0, color="0.6", linewidth=0.5)
    lower.set(xlabel="time (µs)", ylabel="balance (J%s)" % ("/m" if of else ""))
    for axes in (upper, lower):
        open_axes(axes)
    return save(case, figure, "history")
