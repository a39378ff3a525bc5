# SPDX-License-Identifier: BSD-3-Clause
"""What the two cases about a crack below an off-centre hole share: section 4.3 of the plates paper."""
import math

import numpy


def turn_of(tips, tip, height, below):
    """Greatest angle [degree] from the notch's tip (tip, height) to a place of the first branch, from 2 mm behind it until
    it is below the hole, at x = below; all in mm. NaN where no crack ran there."""
    if not tips:
        return math.nan
    x, y = 1e3 * tips["x [m]"], 1e3 * tips["y [m]"]
    first = (tips["branch"] == 1) & (x > tip + 2) & (x < below)
    return math.degrees(numpy.max(numpy.arctan2(y[first] - height, x[first] - tip))) if first.any() else math.nan
