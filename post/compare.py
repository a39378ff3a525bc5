# SPDX-License-Identifier: BSD-3-Clause
"""Two runs side by side and their difference: kirsch-plot compare FOLDER FOLDER [--field NAME] [--at US]."""
import os

import numpy as np

from maps import Field, outline_material, paint, panels, save, show
from results import Case, Fault, warn
from shape import frame
from style import SIGNED


def options(words):
    """Folders, field, time [us] (None: the last output)."""
    folders, wanted, words = [], {"--field": "Damage", "--at": None}, list(words)
    while words:
        word = words.pop(0)
        if word in wanted and words:
            wanted[word] = words.pop(0)
        else:
            folders.append(word)
    try:
        return folders, wanted["--field"], wanted["--at"] and float(wanted["--at"])
    except ValueError:
        raise Fault("compare: --at: found `%s`, expected a time in us" % wanted["--at"])


def nearest(case, at):
    """Name and time [us] of the output nearest to a time; None: of the last."""
    names, times = case.steps()
    k = len(times) - 1 if at is None else int(np.abs(times - at).argmin())
    return names[k], times[k]


def draw(words):
    folders, name, at = options(words)
    if len(folders) != 2:
        raise Fault("compare: expected the folders of two runs, found %d" % len(folders))
    a, b = (Case(folder.rstrip("/"), []) for folder in folders)
    if np.abs(np.subtract(a.box(), b.box())).max() > max(a.cells()[4], b.cells()[4]):
        raise Fault("compare: %s and %s are plates of different size" % tuple(folders))
    corners = [frame(case) for case in (a, b)]  # of cells that move they differ
    a.rasters["frame"] = b.rasters["frame"] = (np.min([c[0] for c in corners], axis=0),
                                               np.max([c[1] for c in corners], axis=0))
    figure, axes, bar, wide = panels(a, 3)
    field = Field(a, name)
    steps, times = zip(*(nearest(case, at) for case in (a, b)))
    values = [Field(case, name).values(case, step) for case, step in zip((a, b), steps)]
    painted = [paint(case, some, wide, step) for case, some, step in zip((a, b), values, steps)]
    colours, least, most = field.colours(values)
    for some, case, pixels, time in zip(axes, (a, b), painted, times):
        image = show(some, case, pixels, colours, most, least)
        outline_material(some, case, pixels)
        some.set_title("%s, %.4g µs" % (os.path.basename(case.folder), time), pad=3)
    figure.colorbar(image, cax=bar, label=field.label)
    difference = painted[0] - painted[1]
    most = float(np.ma.abs(difference).max())
    limit = most or 1
    image = show(axes[2], a, difference, SIGNED, limit)
    outline_material(axes[2], a, difference)
    image.set_clim(-limit, limit)
    axes[2].set_title("difference, at most %.3g" % most, pad=3)
    place = axes[2].get_position()
    beside = figure.add_axes([place.x1 + 0.015, place.y0, 0.015, place.height])
    figure.colorbar(image, cax=beside, label="first less second")
    if abs(times[0] - times[1]) > 1e-6 * times[0]:
        warn("compare: the outputs are of %.4g and %.4g µs" % times)
    os.makedirs(a.path("pictures"), exist_ok=True)
    print("largest difference of %s: %.9g" % (field.label, most))
    print(save(a, figure, "compare" if name == "Damage" else "compare-" + field.file), flush=True)
