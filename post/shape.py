# SPDX-License-Identifier: BSD-3-Clause
"""The polygons that a map shows: the cells of a plate, the same moved by their displacements, or what a
plane cuts of the cells of a solid."""
import numpy as np

from results import Fault
from section import cut_cells
from style import WISH

AXES = "xyz"


def plane_of(cut):
    """Axis and level [mm] of `z=2.5 mm`."""
    axis, _, level = cut.partition("=")
    level = level.strip()
    try:
        if axis.strip() not in tuple(AXES) or not level.endswith("mm"):
            raise ValueError
        return AXES.index(axis.strip()), float(level[:-2])
    except ValueError:
        raise Fault("unknown plane `%s`; expected as --slice 'z=2.5 mm'" % cut)


def is_solid(case):
    return case.cells()[0].shape[1] == 3


def plane(case):
    """Axis and level [mm] of the plane that maps of a solid lie in: the wish, the case's, or half the depth."""
    lower, upper = case.box()
    return WISH["plane"] or case.plane or (2, float(lower[2] + upper[2]) / 2)


def shown(case):
    """The two axes of a map."""
    if WISH["plane"] and not is_solid(case):
        raise Fault("a plate has no slices: leave out --slice")
    return [a for a in range(3) if a != plane(case)[0]] if is_solid(case) else [0, 1]


def is_moved(case):
    if WISH["scale"] and is_solid(case):
        raise Fault("--scale: maps of solids are drawn at rest")
    return bool(WISH["scale"])


def frame(case):
    """Corners of the map [mm]; if it is moved, wide enough for the last output."""
    if "frame" not in case.rasters:
        lower, upper = (corner[shown(case)] for corner in case.box())
        if is_moved(case):
            step = case.steps()[0][-1]
            point = shape_of(case, step)[0][~torn_corners(case, step)]  # splinters may fly out of it
            lower, upper = np.minimum(lower, point.min(axis=0)), np.maximum(upper, point.max(axis=0))
        case.rasters["frame"] = lower, upper
    return case.rasters["frame"]


def shape_of(case, step=None):
    """Polygons to draw: points [mm], first, vertex, and the cell that each is of; at rest without a step."""
    point, first, vertex, _, _ = case.cells()
    if is_solid(case):
        return section(case)
    if step is None or not is_moved(case):
        return point, first, vertex, np.arange(len(first) - 1)
    return moved(case, step)


def torn_corners(case, step):
    """Of all corners of all cells, which are of cells damaged past the threshold."""
    first = case.cells()[1]
    torn = case.field(step, "Damage") >= case.run().attrs["damage_threshold"]
    return np.repeat(torn, np.diff(first))


def moved(case, step):
    """Each corner goes with the mean of the cells around it that are whole; what is damaged past the threshold
    goes by itself, so that a crack opens."""
    point, first, vertex, _, _ = case.cells()
    move = 1e3 * WISH["scale"] * case.field(step, "Displacement")[:, :2]
    owner = np.repeat(np.arange(len(first) - 1), np.diff(first))
    whole = ~torn_corners(case, step)
    count = np.bincount(vertex[whole], minlength=len(point))
    mean = np.stack([np.bincount(vertex[whole], move[owner[whole], a], len(point)) for a in (0, 1)], axis=1)
    mean /= np.maximum(count, 1)[:, None]
    return (point[vertex] + np.where(whole[:, None], mean[vertex], move[owner]), first,
            np.arange(len(vertex)), np.arange(len(first) - 1))


def section(case):
    """What the plane cuts of a solid; found once."""
    if "section" not in case.rasters:
        lower, upper = case.box()
        polygons, of, _, _ = cut_cells(case.cells(), plane(case), (lower + upper) / 2, (upper - lower).max())
        corners = np.concatenate([counter_clockwise(p) for p in polygons])
        ends = np.concatenate([[0], np.cumsum([len(p) for p in polygons])])
        case.rasters["section"] = corners, ends, np.arange(len(corners)), of
    return case.rasters["section"]


def counter_clockwise(polygon):
    x, y = polygon.T
    return polygon if x @ np.roll(y, -1) >= y @ np.roll(x, -1) else polygon[::-1]
