# SPDX-License-Identifier: BSD-3-Clause
"""Maps: damage, strain energy density and any other field at several times."""
import numpy as np
from matplotlib.patches import Circle

from raster import raster
from results import Fault
from shape import AXES, frame, is_moved, is_solid, shape_of, shown
from style import DAMAGE, DPI, ENERGY, SIGNED, WIDTH, WISH, plt, write


def rows_of(case, columns):
    """Rows of a map that is `columns` pixels wide."""
    lower, upper = frame(case)
    return max(2, round(columns * (upper[1] - lower[1]) / (upper[0] - lower[0])))


def picture_of(case, columns, step):
    """The cell at each sample of the map, and the samples along a pixel, of which cells smaller than a
    pixel need several. Kept for the next picture, unless the cells move."""
    still = step is None or not is_moved(case)
    if still and columns in case.rasters:
        return case.rasters[columns]
    lower, upper = frame(case)
    point, first, vertex, owner = shape_of(case, step)
    pixel = (upper[0] - lower[0]) / columns
    fine = int(np.clip(np.ceil(1.5 * pixel / case.cells()[4]), 1, 4))
    cell = raster(point, first, vertex, lower, upper, (fine * rows_of(case, columns), fine * columns))
    found = np.where(cell >= 0, owner[cell], -1), fine
    if still:
        case.rasters[columns] = found
    return found


def paint(case, values, columns, step=None):
    """Pixels of a field: means over their samples, masked where there is no material. With a step the cells
    are where they were then, if that is wished."""
    cell, fine = picture_of(case, columns, step)
    there = cell >= 0
    total, count = np.where(there, values[cell], 0), there
    if fine > 1:
        blocks = len(cell) // fine, fine, columns, fine
        total, count = (x.reshape(blocks).sum(axis=(1, 3)) for x in (total, there))
    return np.ma.masked_array(total / np.maximum(count, 1), count == 0)


def show(axes, case, pixels, colours, limit, least=0):
    """Put a map of the whole plate into axes in mm."""
    lower, upper = frame(case)
    return axes.imshow(pixels, origin="lower", extent=(lower[0], upper[0], lower[1], upper[1]),
                       cmap=colours, vmin=least, vmax=limit, interpolation="nearest",
                       aspect="auto")


def outline_holes(axes, case, pixels, width=0.6, colour="0.35"):
    """Circles where they lie in the picture as they are; else a line around all that is not material."""
    if WISH["scale"] or is_solid(case):
        outline_material(axes, case, pixels)
        return
    for x, y, radius in case.holes:
        axes.add_patch(Circle((x, y), radius, fill=False, linewidth=width, edgecolor=colour))


def outline_material(axes, case, pixels):
    """A line around all that is not material, for cases of which only the folder is known."""
    outside = np.ma.getmaskarray(pixels)
    if outside.any():
        lower, upper = frame(case)
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


def panels(case, count, columns=None):
    """Figure with `count` equal maps in columns, two unless told, and a narrow axes for the colour bar.

    All edges lie on whole pixels, so that a pixel of a map is a pixel of the picture.
    """
    columns = columns or (1 if count == 1 else 2)
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
            axes[-1].set_ylabel(AXES[shown(case)[1]] + " (mm)")
        if k + columns >= count:
            axes[-1].set_xlabel(AXES[shown(case)[0]] + " (mm)")
    bar = add(all_wide - right + 0.12 * DPI, bottom, 0.11 * DPI, total[1] - top - bottom)
    return figure, axes, bar, wide


def lengths(values):
    """Numbers as they are; of vectors their lengths."""
    return values if values.ndim == 1 else np.linalg.norm(values, axis=1)


# Unit of a field in pictures, and how many of the file's make one.
UNITS = {"Damage": ("", 1), "Stored_Elastic_Energy_Density": ("kJ/m³", 1e-3), "Strain": ("", 1),
         "Displacement": ("µm", 1e6), "Velocity": ("m/s", 1), "Stress": ("MPa", 1e-6)}
COMPONENTS = {3: ["x", "y", "z"], 6: ["xx", "xy", "xz", "yy", "yz", "zz"]}


class Field:
    """A field of the outputs by its name, as `Damage`, `Velocity` (its length), `Velocity.x` or `Stress.yy`."""

    def __init__(self, case, name):
        self.name, _, self.part = name.partition(".")
        step = case.steps()[0][-1]
        there = list(case.run()["step"][step])
        if self.name not in there:
            raise Fault("unknown field `%s`; the run has %s, as output.fields of the deck tells"
                        % (name, ", ".join(there)))
        shape = case.run()["step"][step][self.name].shape
        self.parts = COMPONENTS.get(shape[1], []) if len(shape) > 1 else []
        if self.part not in [""] + self.parts or (len(self.parts) == 6 and not self.part):
            raise Fault("`%s`: expected a component, as %s.%s; there are %s" % (
                name, self.name, (self.parts or ["-"])[-1], ", ".join(self.parts) or "none"))
        unit, self.factor = UNITS.get(self.name, ("SI", 1))
        self.label = (self.name.replace("_", " ").lower() + " " + self.part).strip()
        self.label += " (%s)" % unit if unit else ""
        self.file = name.lower().replace(".", "-")

    def values(self, case, step):
        values = case.field(step, self.name)
        return self.factor * (values[:, self.parts.index(self.part)] if self.part else lengths(values))

    def colours(self, values):
        """Colour map and its ends for these values of some times: the wish, or of one sign from 0 on, of two
        signs as far to both sides."""
        if self.name == "Damage":
            least, most = 0, 1
        elif self.part:
            most = energy_limit([np.abs(v) for v in values])
            least = -most
        else:
            least, most = 0, energy_limit(values)
        least, most = WISH["limits"] or (least, most)
        return DAMAGE if self.name == "Damage" else SIGNED if self.part else ENERGY, least, most


def map_times(case, field, chosen, columns=None):
    """Maps of a field at some outputs with one colour scale; returns the figure."""
    values = [field.values(case, step) for step, _ in chosen]
    colours, least, most = field.colours(values)
    figure, axes, bar, pixels = panels(case, len(chosen), columns)
    for a, v, (step, time) in zip(axes, values, chosen):
        painted = paint(case, v, pixels, step)
        image = show(a, case, painted, colours, most, least)
        outline_holes(a, case, painted)
        a.set_title("t = %.4g µs" % time, pad=3)
    over, under = most < max(v.max() for v in values), least > min(v.min() for v in values)
    extend = ("both" if under else "max") if over else "min" if under else "neither"
    figure.colorbar(image, cax=bar, label=field.label, extend=extend)
    return figure


def save(case, figure, name):
    path = case.path("pictures/%s.%s" % (name, WISH["format"]))
    write(figure, path)
    return path


def energy_limit(values):
    """Colour limit: 99.7 % of all cells lie below, so that a few at the tips do not dim the rest."""
    limit = max(np.percentile(v, 99.7) for v in values)
    return limit if limit > 0 else 1


def maps_of(name, file=None):
    """A picture of any field at four times."""
    def picture(case):
        field = Field(case, name)
        return save(case, map_times(case, field, chosen_steps(case)), file or "field-" + field.file)
    return picture


def strip(case):
    """Damage at three times in a row: a page's width."""
    return save(case, map_times(case, Field(case, "Damage"), chosen_steps(case, 3), 3), "strip")
