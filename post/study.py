# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a study (study.csv): all damage maps on one sheet, and when cracks branched."""
import csv
import os

import numpy as np

from maps import outline_material, paint, show
from shape import frame
from results import Case, Fault, Nothing, warn
from style import DAMAGE, DPI, WIDTH, WISH, open_axes, plt, write

MOST = 40  # maps on the sheet; more are too small to be read


def table_of(folder):
    path = os.path.join(folder, "study.csv")
    if not os.path.exists(path):
        raise Fault("%s is missing; kirsch-study writes it" % path)
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def save(figure, folder, name):
    os.makedirs(os.path.join(folder, "pictures"), exist_ok=True)
    path = os.path.join(folder, "pictures", name + "." + WISH["format"])
    write(figure, path)
    print(path, flush=True)


def contact(folder, rows):
    """The last damage of every run that is done, under its name, with one colour scale."""
    done = [row["run"] for row in rows if row["state"] == "done"]
    if not done:
        raise Nothing("no run is done")
    if len(done) > MOST:
        warn("the sheet shows the first %d of %d runs" % (MOST, len(done)))
        done = done[:MOST]
    columns = min(len(done), 2 if len(done) <= 6 else 4)
    lines = -(-len(done) // columns)
    lower, upper = frame(Case(os.path.join(folder, done[0]), []))
    wide = (WIDTH - 0.9 - 0.1 * columns) / columns
    high = wide * (upper[1] - lower[1]) / (upper[0] - lower[0])
    figure, grid = plt.subplots(lines, columns, squeeze=False, layout="constrained",
                                figsize=(WIDTH, lines * (high + 0.25) + 0.25))
    pixels = max(2, round(wide * DPI))
    for axes in grid.flat[len(done):]:
        axes.set_visible(False)
    for axes, name in zip(grid.flat, done):
        case = Case(os.path.join(folder, name), [])
        steps, times = case.steps()
        map_of = paint(case, case.field(steps[-1], "Damage"), pixels)
        image = show(axes, case, map_of, DAMAGE, 1)
        outline_material(axes, case, map_of)
        axes.set(xticks=[], yticks=[], aspect="equal")
        axes.set_title("%s, %.4g µs" % (name, times[-1]), fontsize=7 if columns == 2 else 5, pad=2)
    figure.colorbar(image, ax=grid, label="damage", fraction=0.03, aspect=30)
    save(figure, folder, "contact")


def branching(folder, rows):
    """Time of the first branch against the distance at which the crack met its first pore."""
    rows = [r for r in rows if r["state"] == "done" and r["first_branch [s]"]]
    if not rows:
        raise Nothing("no crack branched")
    time = 1e6 * np.array([float(r["first_branch [s]"]) for r in rows])
    distance = np.array([1e3 * float(r["first_pore_distance [m]"] or "nan") for r in rows])
    met = np.isfinite(distance)
    figure, (axes, beside) = plt.subplots(1, 2, figsize=(4.6, 3.0), sharey=True, layout="constrained",
                                          gridspec_kw={"width_ratios": [3, 1]})
    axes.plot(distance[met], time[met], "o", markersize=4)
    axes.set(xlabel="start to first pore met (mm)", ylabel="time of first branch (µs)")
    axes.set_title("%d of %d runs met a pore" % (met.sum(), len(rows)))
    bins = np.histogram_bin_edges(time, bins="sturges")
    beside.hist([time[met], time[~met]], bins, orientation="horizontal", stacked=True,
                label=["met a pore", "none"])
    beside.set_xlabel("runs")
    beside.xaxis.get_major_locator().set_params(integer=True)
    if not met.all():
        beside.legend(fontsize=6, loc="lower center", bbox_to_anchor=(0.5, 1))
    for some in (axes, beside):
        open_axes(some)
    save(figure, folder, "branching")


def draw(folder):
    rows = table_of(folder)
    for picture in (contact, branching):
        try:
            picture(folder, rows)
        except Nothing as reason:
            warn("no picture `%s`: %s" % (picture.__name__, reason))
