#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a case: plot.py FOLDER [PICTURE...] [--disc X,Y,RADIUS]... [--ball X,Y,Z,RADIUS]...
(metres: the case's holes and voids in their order) [--hole N] [--void N] [--slice 'z=2 mm']

Started by kirsch-plot. It draws and computes nothing mechanical. A picture whose files are missing
is told and left out; the others are drawn all the same.
"""
import os
import sys

try:
    import numpy as np
    from style import WISH
    from results import Case, Fault, Nothing, warn
    import curves
    import grid
    import maps
    import movie
    import study
    import tree
    import compare
    import front
    import shape
except ImportError as missing:
    print("kirsch-plot: %s; pictures need, on Debian: apt-get install python3-numpy "
          "python3-matplotlib python3-h5py" % missing, file=sys.stderr)
    sys.exit(5)

PICTURES = {
    "grid": grid.grid,
    "damage": maps.maps_of("Damage", "damage"),
    "energy": maps.maps_of("Stored_Elastic_Energy_Density", "energy"),
    "speed": curves.speed,
    "tip": curves.tip,
    "tree": tree.tree,
    "history": curves.history,
    "front": front.front,
    "strip": maps.strip,
    "crack": movie.crack,
}
# What is drawn where none is named.
OF_PLATES = ["grid", "damage", "energy", "speed", "tip", "tree", "history", "crack"]
OF_SOLIDS = ["grid", "damage", "energy", "front", "history", "crack"]


def numbers(option, word, count):
    """Finite numbers between commas."""
    try:
        values = [float(x) for x in word.split(",")]
    except ValueError:
        values = []
    if len(values) != count or not np.isfinite(values).all():
        raise Fault("%s: found `%s`, expected %s" % (option, word, ("a number", "lowest,highest")[count - 1]))
    return values


def take_wishes(words):
    """Take what holds for all pictures off the command line; returns the rest."""
    rest, words = [], list(words)
    while words:
        word = words.pop(0)
        if word not in ("--format", "--dpi", "--limits", "--scale") or not words:
            rest.append(word)
            continue
        value = words.pop(0)
        if word == "--format":
            if value not in ("png", "svg", "pdf"):
                raise Fault("--format: found `%s`, expected png, svg or pdf" % value)
            WISH["format"] = value
        elif word == "--dpi":
            WISH["dpi"], = numbers(word, value, 1)
            if not 20 <= WISH["dpi"] <= 2400:
                raise Fault("--dpi: found `%s`, expected 20 to 2400" % value)
        elif word == "--scale":
            WISH["scale"], = numbers(word, value, 1)
        else:
            WISH["limits"] = numbers(word, value, 2)
            if not WISH["limits"][0] < WISH["limits"][1]:
                raise Fault("--limits: found `%s`, expected the lower one first" % value)
    return rest


def arguments(words):
    """Folder, names of pictures, holes, voids, and what of the grid is asked for."""
    folder, names, round_ones, wanted, fields = None, [], {"--disc": [], "--ball": []}, {}, []
    words = list(words)
    while words:
        word = words.pop(0)
        if word in round_ones and words:
            round_ones[word].append(tuple(float(x) for x in words.pop(0).split(",")))
        elif word in ("--hole", "--void", "--slice") and words:
            wanted["cut" if word == "--slice" else word[2:]] = words.pop(0)
            if word == "--slice":
                WISH["plane"] = shape.plane_of(wanted["cut"])
        elif word == "--field" and words:
            fields.append(words.pop(0))
        elif folder is None:
            folder = word
        elif word in PICTURES or word == "film":
            names.append(word)
        else:
            raise Fault("unknown picture `%s`; there are %s" % (word, ", ".join(list(PICTURES) + ["film"])))
    if folder is None:
        raise Fault("the folder of the case is missing")
    of = movie.film_of if "film" in names else maps.maps_of
    names = [name for name in names if name != "film"] + fields
    if of is movie.film_of and not fields:
        raise Fault("film: expected the field to be filmed, as film --field Velocity")
    PICTURES.update({name: of(name) for name in fields})
    if wanted and not names:
        names = ["grid"]
    return folder, names, round_ones["--disc"], round_ones["--ball"], wanted


def draw_all(case, names):
    """Draw; returns whether each asked for could be drawn."""
    complete = True
    os.makedirs(case.path("pictures"), exist_ok=True)
    for name in names:
        try:
            path = PICTURES[name](case)
        except Nothing as reason:
            warn("no picture `%s`: %s" % (name, reason))
            continue
        except Fault as fault:
            print("kirsch-plot: no picture `%s`: %s" % (name, fault), file=sys.stderr)
            complete = False
            continue
        if path:
            print(path, flush=True)
    return complete


def main():
    try:
        words = take_wishes(sys.argv[1:])
        if words[:1] == ["study"]:
            study.draw(words[1])
            return
        if words[:1] == ["compare"]:
            compare.draw(words[1:])
            return
        folder, names, holes, voids, wanted = arguments(words)
        case = Case(folder, holes, voids)
        PICTURES["grid"] = lambda case: grid.grid(case, grid.Choice(case, **wanted))
        if not draw_all(case, names or (OF_SOLIDS if shape.is_solid(case) else OF_PLATES)):
            sys.exit(2)
    except Fault as fault:
        print("kirsch-plot: %s" % fault, file=sys.stderr)
        sys.exit(2)
    except OSError as fault:
        print("kirsch-plot: cannot read or write: %s" % fault, file=sys.stderr)
        sys.exit(3)
    except (KeyError, ValueError) as fault:
        print("kirsch-plot: a file in the case's folder lacks what it should hold: %s" % fault,
              file=sys.stderr)
        sys.exit(2)


main()
