# SPDX-License-Identifier: BSD-3-Clause
"""The crack tree over the damage: paths of all branches, coloured by speed."""
import numpy as np
from matplotlib.collections import LineCollection

from curves import pieces, tips_by_box
from maps import outline_holes, paint, panels, save, show


def tree(case):
    tips = tips_by_box(case)
    names, _ = case.steps()
    figure, (axes,), bar, pixels = panels(case, 1)
    painted = paint(case, case.field(names[-1], "Damage"), pixels)
    show(axes, case, painted, "Greys", 2)
    outline_holes(axes, case, painted)
    jump = 0.5e3 * case.run().attrs["horizon"]
    lines, speeds = [], []
    for _, t in tips:
        for some in pieces(t, jump):
            way = np.stack([t["x"][some], t["y"][some]], axis=1)
            lines.extend(np.stack([way[:-1], way[1:]], axis=1))
            speed = t["speed"][some]
            speeds.extend(np.where(np.isnan(speed[1:]), speed[:-1], speed[1:]))
    paths = LineCollection(lines, array=np.ma.masked_invalid(speeds), cmap="viridis", linewidth=2,
                           capstyle="round")
    paths.cmap.set_bad("0.4")
    # Where two cracks run together, a place is reached faster than any one of them runs: past Rayleigh's
    # speed differences say nothing.
    most = max(0.1, np.nanmax(np.append(speeds, 0)))
    paths.set_clim(0, min(1, most))
    axes.add_collection(paths)
    for branch, t in tips:
        middle = len(t["x"]) // 2
        axes.annotate("%d" % branch, (t["x"][middle], t["y"][middle]), xytext=(0, 5), fontsize=7,
                      textcoords="offset points", ha="center")
    figure.colorbar(paths, cax=bar, extend="max" if most > 1 else "neither",
                    label="crack speed / Rayleigh speed")
    return save(case, figure, "tree")
