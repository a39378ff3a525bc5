# SPDX-License-Identifier: BSD-3-Clause
"""How all pictures look: sizes, colours, colour maps that the colour-blind can read."""
import os

import matplotlib

matplotlib.use("Agg")  # no display is needed
import matplotlib.pyplot as plt
from matplotlib.colors import LinearSegmentedColormap

DPI = 300
# What the command line asks of all pictures; `limits` (lowest, highest) of the colours of a field, `scale` of
# displacements, `plane` (axis, level in mm) of maps of solids.
WISH = {"format": "png", "dpi": DPI, "limits": None, "scale": 0, "plane": None}
WIDTH = 7.0  # inches: a page's text

# Okabe and Ito's colours: told apart with any kind of colour vision.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]

# White to nearly black; lightness falls all the way, so that it also prints in grey. It falls
# fastest up to 0.5, the damage on the faces of a crack.
DAMAGE = LinearSegmentedColormap.from_list("damage", [
    (0, "#ffffff"), (0.12, "#fddbb0"), (0.28, "#f08a4b"), (0.42, "#c03a2b"), (0.6, "#6b0f1a"),
    (1, "#1d0408")])
ENERGY = matplotlib.colormaps["viridis"].copy()
SIGNED = matplotlib.colormaps["PuOr"].copy()
DAMAGE.set_bad("white")
ENERGY.set_bad("white")
SIGNED.set_bad("white")

plt.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 8, "axes.titlesize": 8, "axes.labelsize": 8,
    "xtick.labelsize": 7, "ytick.labelsize": 7, "legend.fontsize": 7, "legend.frameon": False,
    "axes.linewidth": 0.6, "xtick.major.width": 0.6, "ytick.major.width": 0.6,
    "lines.linewidth": 1.1, "axes.prop_cycle": plt.cycler(color=COLOURS), "savefig.dpi": DPI,
})


def write(figure, path):
    """The picture appears whole or not at all; the figure is done with."""
    figure.savefig(path + ".tmp", format=WISH["format"], dpi=WISH["dpi"])
    os.replace(path + ".tmp", path)
    plt.close(figure)


def open_axes(axes):
    """Leave out the frame's upper and right side."""
    axes.spines["top"].set_visible(False)
    axes.spines["right"].set_visible(False)


def box_label(box, boxes):
    return "branch %d" % box if len(boxes) > 1 else None
