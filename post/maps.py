# SPDX-License-Identifier: BSD-3-Clause
"""Maps: damage, strain energy density and any other field at several times."""
import numpy as np
from matplotlib.patches import Circle

from raster import raster
from results import Fault
from style import DAMAGE, DPI, ENERGY, WIDTH, WISH, plt


def rows_of(case, columns):
    """Rows of a picture of the whole plate that is `columns` pixels wide."""
    lower, upper = case.box()
    return max(2, round(columns * (upper[1] - lower[1]) / (upper[0] - lower[0])))


def picture_of(case, columns):
    """The cell at each sample of the whole plate, and the samples along a pixel, of which cells
    smaller than a pixel need several. Kept for the next picture."""
    rasters = case.rasters
    if columns not in rasters:
        lower, upper = case.box()
        point, first, vertex, _, spacing = case.cells()
        pixel = (upper[0] - lower[0]) / columns
        fine = int(np.clip(np.ceil(1.5 * pixel / spacing), 1, 4))
        shape = fine * rows_of(case, columns), fine * columns
        rasters[columns] = raster(point, first, vertex, lower, upper, shape), fine
    return rasters[columns]


def paint(case, values, columns):
    """Pixels of a field: means over their samples, masked where there is no material."""
    cell, fine = picture_of(case, columns)
    there = cell >= 0
    total, count = np.where(there, values[cell], 0), there
    if fine > 1:
        blocks = len(cell) // fine, fine, columns, fine
        total, count = (x.reshape(blocks).sum(axis=(1, 3)) for x in (total, there))
    return np.ma.masked_array(total / np.maximum(count, 1), count == 0)


def show(axes, case, pixels, colours, limit, least=0):
    """Put a map of the whole plate into axes in mm."""
    lower, upper = case.box()
    return axes.imshow(pixels, origin="lower", extent=(lower[0], upper[0], lower[1], upper[1]),
                       cmap=colours, vmin=least, vmax=limit, interpolation="nearest",
                       aspect="auto")


def outline_holes(axes, case, width=0.6, colour="0.35"):
    for x, y, radius in case.holes:
        axes.add_patch(Circle((x, y), radius, fill=False, linewidth=width, edgecolor=colour))


def outline_material(axes, case, pixels):
    """A line around all that is not material, for cases of which only the folder is known."""
    outside = np.ma.getmaskarray(pixels)
    if outside.any():
        lower, upper = case.box()
        axes.contour(outside.astype(float), [0.5], colors="0.35", linewidths=0.5,
                     extent=(lower[0], upper[0], lower[1], upper[1]))


# ---- four times --------------------------------------------------------------------------------

def chosen_steps(case, count=4):
    """Outputs evenly between the first growth and the tip's arrival, which is the last of them."""
    names, times = case.steps()
    begin = 1e6 * case.summary.get("first_growth", times[-1] * 1e-6)
    ends = [v for k, v in case.summary.items() if k.startswith("arrival")]
    end = max([1e6 * e for e in ends] + [begin])
    if end <= begin:
        begin, end = times[0], times[-1]
    wanted = begin + (end - begin) * (np.arange(count) + 1) / count
    after = np.minimum(np.searchsorted(times, wanted - 1e-9), len(times) - 1)
    return [(names[k], times[k]) for k in sorted(set(after))]


def panels(case, count):
    """Figure with `count` equal maps in two columns and a narrow axes for the colour bar.

    All edges lie on whole pixels, so that a pixel of a map is a pixel of the picture.
    """
    columns = 1 if count == 1 else 2
    rows = -(-count // columns)
    left, right, gap, top, bottom, between, all_wide = (
        round(DPI * inches) for inches in (0.5, 0.75, 0.3, 0.22, 0.42, 0.27, WIDTH))
    wide = (all_wide - left - right - gap * (columns - 1)) // columns
    high = rows_of(case, wide)
    total = np.array([all_wide, top + bottom + rows * high + (rows - 1) * between])
    figure = plt.figure(figsize=total / DPI, dpi=DPI)

    def add(x, y, w, h):
        return figure.add_axes([x / total[0], y / total[1], w / total[0], h / total[1]])

    axes = []
    for k in range(count):
        column, row = k % columns, k // columns
        axes.append(add(left + column * (wide + gap),
                        total[1] - top - (row + 1) * high - row * between, wide, high))
        axes[-1].tick_params(labelleft=column == 0, labelbottom=k + columns >= count)
        if column == 0:
            axes[-1].set_ylabel("y (mm)")
        if k + columns >= count:
            axes[-1].set_xlabel("x (mm)")
    bar = add(all_wide - right + 0.12 * DPI, bottom, 0.11 * DPI, total[1] - top - bottom)
    return figure, axes, bar, wide


def lengths(values):
    """Numbers as they are; of vectors their lengths."""
    return values if values.ndim == 1 else np.linalg.norm(values, axis=1)


def four_maps(case, field, colours, label, limit_of, scale=1):
    """Maps of a field with one colour scale; returns the figure."""
    chosen = chosen_steps(case)
    values = [scale * lengths(case.field(step, field)) for step, _ in chosen]
    least, limit = WISH["limits"] or (0, limit_of(values))
    figure, axes, bar, pixels = panels(case, len(chosen))
    for a, v, (_, time) in zip(axes, values, chosen):
        image = show(a, case, paint(case, v, pixels), colours, limit, least)
        outline_holes(a, case)
        a.set_title("t = %.4g µs" % time, pad=3)
    over, under = limit < max(v.max() for v in values), least > min(v.min() for v in values)
    extend = ("both" if under else "max") if over else "min" if under else "neither"
    figure.colorbar(image, cax=bar, label=label, extend=extend)
    return figure


def save(case, figure, name):
    path = case.path("pictures/%s.%s" % (name, WISH["format"]))
    figure.savefig(path, dpi=WISH["dpi"])
    plt.close(figure)
    return path


def damage(case):
    figure = four_maps(case, "Damage", DAMAGE, "damage", lambda values: 1)
    return save(case, figure, "damage")


def energy_limit(values):
    """Colour limit: 99.7 % of all cells lie below, so that a few at the tips do not dim the rest."""
    limit = max(np.percentile(v, 99.7) for v in values)
    return limit if limit > 0 else 1


def energy(case):
    figure = four_maps(case, "Stored_Elastic_Energy_Density", ENERGY,
                       "strain energy density (kJ/m³)", energy_limit, 1e-3)
    return save(case, figure, "energy")


# Unit of a field in pictures, and how many of the file's make one.
UNITS = {"Damage": ("", 1), "Stored_Elastic_Energy_Density": ("kJ/m³", 1e-3),
         "Displacement": ("µm", 1e6), "Velocity": ("m/s", 1)}


def any_field(name):
    """A picture of any field of the outputs; of vectors the length."""
    def picture(case):
        names, _ = case.steps()
        there = list(case.run()["step"][names[-1]])
        if name not in there:
            raise Fault("unknown field `%s`; the run has %s" % (name, ", ".join(there)))
        unit, factor = UNITS.get(name, ("SI", 1))
        label = name.replace("_", " ").lower() + (" (%s)" % unit if unit else "")
        figure = four_maps(case, name, ENERGY, label, energy_limit, factor)
        return save(case, figure, "field-" + name.lower())
    return picture
