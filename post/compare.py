# SPDX-License-Identifier: BSD-3-Clause
"""Two runs side by side and their difference: kirsch-plot compare FOLDER FOLDER [--field NAME] [--at US]."""
import os

import numpy as np

from maps import Field, outline_material, paint, panels, save, show
from results import Case, Fault, warn
from shape import frame
from style import SIGNED


def nearest(case, at):
    """Name and time [us] of the output nearest to a time; None: of the last."""
    names, times = case.steps()
    k = len(times) - 1 if at is None else int(np.abs(times - at).argmin())
    return names[k], times[k]


def both(folders):
    """The two cases, in one frame: cells that move have each their own."""
    a, b = (Case(folder.rstrip("/"), []) for folder in folders)
    if np.shape(a.box()) != np.shape(b.box()) or \
            np.abs(np.subtract(a.box(), b.box())).max() > max(a.cells()[4], b.cells()[4]):
        raise Fault("compare: %s and %s are bodies of different size" % tuple(folders))
    corners = [frame(case) for case in (a, b)]
    a.rasters["frame"] = b.rasters["frame"] = (np.min([c[0] for c in corners], axis=0),
                                               np.max([c[1] for c in corners], axis=0))
    return a, b


def show_difference(figure, axes, case, difference):
    """The third map, with a colour bar of its own; returns its largest value."""
    most = float(np.ma.abs(difference).max())
    limit = most or 1
    image = show(axes, case, difference, SIGNED, limit, -limit)
    outline_material(axes, case, difference)
    axes.set_title("difference, at most %.3g" % most, pad=3)
    place = axes.get_position()
    beside = figure.add_axes([place.x1 + 0.015, place.y0, 0.015, place.height])
    figure.colorbar(image, cax=beside, label="first less second")
    return most


def draw(folders, name, at):
    """The picture of a field at the outputs nearest to a time [us]; None: at the last."""
    if len(folders) != 2:
        raise Fault("compare: expected the folders of two runs, found %d" % len(folders))
    cases = both(folders)
    figure, axes, bar, wide = panels(cases[0], 3)
    fields = [Field(case, name) for case in cases]
    steps, times = zip(*(nearest(case, at) for case in cases))
    values = [field.values(case, step) for field, case, step in zip(fields, cases, steps)]
    painted = [paint(case, some, wide, step) for case, some, step in zip(cases, values, steps)]
    colours, least, most = fields[0].colours(values)
    for some, case, pixels, time in zip(axes, cases, painted, times):
        image = show(some, case, pixels, colours, most, least)
        outline_material(some, case, pixels)
        some.set_title("%s, %.4g µs" % (os.path.basename(case.folder), time), pad=3)
    figure.colorbar(image, cax=bar, label=fields[0].label)
    largest = show_difference(figure, axes[2], cases[0], painted[0] - painted[1])
    if abs(times[0] - times[1]) > 1e-6 * times[0]:
        warn("compare: the outputs are of %.4g and %.4g µs" % times)
    os.makedirs(cases[0].path("pictures"), exist_ok=True)
    print("largest difference of %s: %.9g" % (fields[0].label, largest))
    print(save(cases[0], figure, "compare" if name == "Damage" else "compare-" + fields[0].file), flush=True)
