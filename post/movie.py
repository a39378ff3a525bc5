# SPDX-License-Identifier: BSD-3-Clause
"""The crack as a film: damage above strain energy density, through all outputs.

The frame with its axes and colour bars is drawn once; each output only pastes its pixels into it,
so that the time goes into reading and encoding.
"""
import subprocess

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from matplotlib import font_manager

from maps import chosen_steps, energy_limit, paint, rows_of
from results import warn
from style import DAMAGE, ENERGY, plt

DPI = 160
SECONDS = 8  # that a film lasts at most; 25 frames a second at most, 4 at least


def background(case, limit):
    """Pixels of the empty frame (rows, columns, 3), and where the maps go: (x, y, wide, high) in
    pixels from the upper left."""
    lower, upper = case.box()
    left, right, top, bottom, between, wide = (
        round(DPI * inches) for inches in (0.55, 0.85, 0.3, 0.45, 0.12, 6))
    high = rows_of(case, wide)
    total = np.array([left + wide + right, top + 2 * high + between + bottom])
    total += total % 2  # encoders want even numbers of pixels
    figure = plt.figure(figsize=total / DPI, dpi=DPI)
    places = []
    for row, (colours, most, label) in enumerate((
            (DAMAGE, 1, "damage"), (ENERGY, limit, "strain energy density (kJ/m³)"))):
        y = top + row * (high + between)
        axes, bar = (figure.add_axes([x / total[0], 1 - (y + high) / total[1], w / total[0],
                                      high / total[1]])
                     for x, w in ((left, wide), (left + wide + 0.1 * DPI, 0.1 * DPI)))
        axes.set(xlim=(lower[0], upper[0]), ylim=(lower[1], upper[1]), ylabel="y (mm)")
        axes.tick_params(labelbottom=row == 1)
        figure.colorbar(plt.cm.ScalarMappable(plt.Normalize(0, most), colours), cax=bar,
                        label=label)
        places.append((left, y, wide, high))
    axes.set_xlabel("x (mm)")
    figure.canvas.draw()
    frame = np.asarray(figure.canvas.buffer_rgba())[..., :3].copy()
    plt.close(figure)
    return frame, places


def colour(field, colours, limit):
    """Pixels (rows, columns, 3) of a painted field; white where there is no material."""
    table = (255 * colours(np.arange(256))[:, :3]).round().astype(np.uint8)
    hole = np.ma.getmaskarray(field)
    pixels = table[np.clip(field.data * (256 / limit), 0, 255).astype(np.uint8)]
    pixels[hole] = 255
    pixels[rims(hole)] = 90
    return pixels[::-1]


def rims(hole):
    """Pixels of holes that touch material."""
    touch = np.zeros_like(hole)
    touch[1:] |= ~hole[:-1]
    touch[:-1] |= ~hole[1:]
    touch[:, 1:] |= ~hole[:, :-1]
    touch[:, :-1] |= ~hole[:, 1:]
    return hole & touch


def paste(frame, pixels, place):
    """Put a map into the frame, with a line around it."""
    x, y, wide, high = place
    frame[y:y + high, x:x + wide] = pixels
    frame[[y, y + high - 1], x:x + wide] = 0
    frame[y:y + high, [x, x + wide - 1]] = 0


def frames(case, limit):
    """Yield the frames as bytes; the first item is (columns, rows)."""
    frame, places = background(case, limit)
    font = ImageFont.truetype(font_manager.findfont("DejaVu Sans"), round(0.12 * DPI))
    yield frame.shape[1], frame.shape[0]
    for step, time in zip(*case.steps()):
        for place, name, scale, colours, most in (
                (places[0], "Damage", 1, DAMAGE, 1),
                (places[1], "Stored_Elastic_Energy_Density", 1e-3, ENERGY, limit)):
            field = paint(case, scale * case.field(step, name), place[2])
            paste(frame, colour(field, colours, most), place)
        image = Image.fromarray(frame)
        ImageDraw.Draw(image).text((places[0][0], 0.09 * DPI), "t = %.1f µs" % time, (0, 0, 0),
                                   font)
        yield image.tobytes()


def crack(case):
    """Pipe the frames through ffmpeg. A film that fails is told, and no reason to fail."""
    names, _ = case.steps()
    limit = energy_limit([1e-3 * case.field(s, "Stored_Elastic_Energy_Density")
                          for s, _ in chosen_steps(case)])
    stream = frames(case, limit)
    columns, rows = next(stream)
    path = case.path("pictures/crack.mp4")
    rate = min(25, max(4, len(names) / SECONDS))
    command = ["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24",
               "-s", "%dx%d" % (columns, rows), "-r", "%.3f" % rate, "-i", "-", "-an",
               "-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-pix_fmt", "yuv420p",
               "-movflags", "+faststart", path]
    try:
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE)
    except OSError as fault:
        warn("no film: cannot start ffmpeg (%s); Debian's package ffmpeg has it" % fault.strerror)
        return None
    try:
        for frame in stream:
            process.stdin.write(frame)
    except BrokenPipeError:
        pass  # ffmpeg says why below
    said = process.communicate()[1].decode(errors="replace").strip().splitlines()
    if process.returncode != 0:
        warn("no film: ffmpeg failed: %s" % (said[-1] if said else process.returncode))
        return None
    return path
