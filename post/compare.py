# SPDX-License-Identifier: BSD-3-Clause
"""Two runs side by side and their difference: kirsch-plot compare FOLDER FOLDER."""
import os

import numpy as np

from maps import outline_material, paint, panels, save, show
from results import Case, Fault, warn
from style import DAMAGE, plt


def draw(*folders):
    if len(folders) != 2:
        raise Fault("compare: expected the folders of two runs, found %d" % len(folders))
    a, b = (Case(folder.rstrip("/"), []) for folder in folders)
    if np.abs(np.subtract(a.box(), b.box())).max() > max(a.cells()[4], b.cells()[4]):
        raise Fault("compare: %s and %s are plates of different size" % folders)
    figure, axes, bar, wide = panels(a, 3)
    steps = [case.steps() for case in (a, b)]
    painted = [paint(case, case.field(names[-1], "Damage"), wide)
               for case, (names, _) in zip((a, b), steps)]
    for some, case, pixels, (_, times) in zip(axes, (a, b), painted, steps):
        image = show(some, case, pixels, DAMAGE, 1)
        outline_material(some, case, pixels)
        some.set_title("%s, %.4g µs" % (os.path.basename(case.folder), times[-1]), pad=3)
    figure.colorbar(image, cax=bar, label="damage")
    difference = painted[0] - painted[1]
    most = float(np.ma.abs(difference).max())
    limit = most or 1
    image = show(axes[2], a, difference, plt.get_cmap("PuOr"), limit)
    outline_material(axes[2], a, difference)
    image.set_clim(-limit, limit)
    axes[2].set_title("difference, at most %.3g" % most, pad=3)
    place = axes[2].get_position()
    beside = figure.add_axes([place.x1 + 0.015, place.y0, 0.015, place.height])
    figure.colorbar(image, cax=beside, label="first less second")
    if abs(steps[0][1][-1] - steps[1][1][-1]) > 1e-6 * steps[0][1][-1]:
        warn("compare: the last outputs are of %.4g and %.4g µs" % (steps[0][1][-1], steps[1][1][-1]))
    os.makedirs(a.path("pictures"), exist_ok=True)
    print("largest difference of damage: %.9g" % most)
    print(save(a, figure, "compare"), flush=True)
