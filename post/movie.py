# SPDX-License-Identifier: BSD-3-Clause
"""Films through all outputs: of the crack, damage above strain energy density, and of any field.

The frame with its axes and colour bars is drawn once; each output only pastes its pixels into it,
so that the time goes into reading and encoding.
"""
import ctypes
import os
import signal
import subprocess

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from matplotlib import font_manager

from maps import Field, chosen_steps, paint, rows_of
from results import warn
from shape import AXES, frame, shown
from style import plt

DPI = 160
SECONDS = 8  # that a film lasts at most; 25 frames a second at most, 4 at least


def background(case, scales):
    """Pixels of the empty frame (rows, columns, 3), and where the maps go: (x, y, wide, high) in pixels from
    the upper left. scales: (label, colours, least, most) of each map, from the top."""
    lower, upper = frame(case)
    left, right, top, bottom, between, wide = (
        round(DPI * inches) for inches in (0.55, 0.85, 0.3, 0.45, 0.12, 6))
    high = rows_of(case, wide)
    total = np.array([left + wide + right,
                      top + len(scales) * high + (len(scales) - 1) * between + bottom])
    total += total % 2  # encoders want even numbers of pixels
    figure = plt.figure(figsize=total / DPI, dpi=DPI)
    places = []
    for row, (label, colours, least, most) in enumerate(scales):
        y = top + row * (high + between)
        axes, bar = (figure.add_axes([x / total[0], 1 - (y + high) / total[1], w / total[0],
                                      high / total[1]])
                     for x, w in ((left, wide), (left + wide + 0.1 * DPI, 0.1 * DPI)))
        across, up = (AXES[a] + " (mm)" for a in shown(case))
        axes.set(xlim=(lower[0], upper[0]), ylim=(lower[1], upper[1]), ylabel=up)
        axes.tick_params(labelbottom=row == len(scales) - 1)
        figure.colorbar(plt.cm.ScalarMappable(plt.Normalize(least, most), colours), cax=bar, label=label)
        places.append((left, y, wide, high))
    axes.set_xlabel(across)
    figure.canvas.draw()
    pixels = np.asarray(figure.canvas.buffer_rgba())[..., :3].copy()
    plt.close(figure)
    return pixels, places


def colour(field, colours, least, most):
    """Pixels (rows, columns, 3) of a painted field; white where there is no material."""
    table = (255 * colours(np.arange(256))[:, :3]).round().astype(np.uint8)
    hole = np.ma.getmaskarray(field)
    pixels = table[np.clip((field.data - least) * (256 / (most - least)), 0, 255).astype(np.uint8)]
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


def frames(case, fields, scales):
    """Yield the frames as bytes; the first item is (columns, rows)."""
    pixels, places = background(case, scales)
    font = ImageFont.truetype(font_manager.findfont("DejaVu Sans"), round(0.12 * DPI))
    yield pixels.shape[1], pixels.shape[0]
    for step, time in zip(*case.steps()):
        for place, field, (_, colours, least, most) in zip(places, fields, scales):
            painted = paint(case, field.values(case, step), place[2], step)
            paste(pixels, colour(painted, colours, least, most), place)
        image = Image.fromarray(pixels)
        ImageDraw.Draw(image).text((places[0][0], 0.09 * DPI), "t = %.1f µs" % time, (0, 0, 0), font)
        yield image.tobytes()


def end_with_us():
    """In ffmpeg's process, before it is ffmpeg: it is killed when we are."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def film(case, names, file):
    """Pipe the frames through ffmpeg. A film that fails is told, and no reason to fail."""
    fields = [Field(case, name) for name in names]
    chosen = [step for step, _ in chosen_steps(case)]
    scales = [(field.label, *field.colours([field.values(case, step) for step in chosen])) for field in fields]
    stream = frames(case, fields, scales)
    columns, rows = next(stream)
    path = case.path("pictures/%s.mp4" % file)
    rate = min(25, max(4, len(case.steps()[0]) / SECONDS))
    command = ["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24",
               "-s", "%dx%d" % (columns, rows), "-r", "%.3f" % rate, "-i", "-", "-an",
               "-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-pix_fmt", "yuv420p",
               "-movflags", "+faststart", "-f", "mp4", path + ".tmp"]
    try:
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=end_with_us)
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
    os.replace(path + ".tmp", path)  # killed before, ffmpeg would end a shorter film that looks like a whole one
    return path


def crack(case):
    return film(case, ["Damage", "Stored_Elastic_Energy_Density"], "crack")


def film_of(name):
    return lambda case: film(case, [name], "film-" + Field(case, name).file)
