# SPDX-License-Identifier: BSD-3-Clause
"""Scan conversion of cells: which cell does each pixel of a picture show?

Found once for a picture size, then every field of every time is one indexing operation. Cells are
convex polygons of any number of corners, counter-clockwise. They are taken in groups of equal
corner count and swept together over the pixels of their bounding boxes, so that the work is in
numpy: some 780 000 cells take about a second.
"""
import numpy as np


def raster(point, first, vertex, lower, upper, shape):
    """Index of the cell at each pixel's centre, -1 where there is none (holes, outside).

    lower, upper  corners of the picture in the unit of `point`
    shape         (rows, columns); row 0 is the lowest
    """
    rows, columns = shape
    scale = np.array([columns, rows]) / (np.asarray(upper) - lower)
    pixel = (point - lower) * scale - 0.5  # centres of pixels at whole numbers
    image = np.full(rows * columns, -1, dtype=np.int32)
    corners = np.diff(first)
    for count in np.unique(corners[corners >= 3]):
        cell = np.flatnonzero(corners == count)
        sweep(pixel[vertex[first[cell][:, None] + np.arange(count)]], cell, image, shape)
    return image.reshape(shape)


def sweep(polygon, cell, image, shape):
    """Mark the pixels of polygons (cells, corners, 2) in the flat image."""
    rows, columns = shape
    low = np.ceil(polygon.min(axis=1) - 1e-6).astype(np.int32)
    high = np.floor(polygon.max(axis=1) + 1e-6).astype(np.int32)
    low, high = np.maximum(low, 0), np.minimum(high, [columns - 1, rows - 1])
    keep = (low <= high).all(axis=1)
    polygon, cell, low, high = polygon[keep], cell[keep], low[keep], high[keep]
    if not len(cell):
        return
    size = high - low + 1
    normal, offset = half_planes(polygon)
    for dy in range(size[:, 1].max()):
        tall = np.flatnonzero(size[:, 1] > dy)
        for dx in range(size[tall, 0].max()):
            some = tall[size[tall, 0] > dx]
            x, y = low[some, 0] + dx, low[some, 1] + dy
            inside = np.ones(len(some), dtype=bool)
            for edge in range(polygon.shape[1]):
                a, b = normal[some, edge].T
                inside &= a * x + b * y >= offset[some, edge]
            image[y[inside] * columns + x[inside]] = cell[some[inside]]


def half_planes(polygon):
    """Inside is where normal . x >= offset for every edge.

    Edges give way by a millionth of a pixel, lest a pixel fall between two cells by rounding.
    """
    edge = np.roll(polygon, -1, axis=1) - polygon
    normal = np.stack([-edge[..., 1], edge[..., 0]], axis=-1)
    offset = (normal * polygon).sum(axis=-1)
    return normal, offset - 1e-6 * np.hypot(edge[..., 0], edge[..., 1])
