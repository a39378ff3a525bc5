#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a case: plot.py FOLDER [PICTURE...] [--disc X,Y,RADIUS]... [--ball X,Y,Z,RADIUS]...
(metres: the case's holes and voids in their order), and the options that kirsch-plot tells of; plot.py compare
FOLDER FOLDER; plot.py study FOLDER.

Started by kirsch-plot and kirsch-study. It draws and computes nothing mechanical. A picture whose files are missing
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
    "grid": None,  # see prepare()
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


# Options, each with a value behind it as this one.
OPTIONS = {"--format": "svg", "--dpi": "150", "--limits": "0,0.5", "--scale": "20", "--field": "Velocity.x", "--at": "40",
           "--hole": "1", "--void": "1", "--slice": "'z=2 mm'", "--disc": "0,0,0.001", "--ball": "0,0,0,0.001"}


def sort_out(words):
    """The words that are no options, and the values of each option."""
    names, given, words = [], {option: [] for option in OPTIONS}, list(words)
    while words:
        word = words.pop(0)
        if not word.startswith("--"):
            names.append(word)
        elif word not in OPTIONS:
            raise Fault("unknown option `%s`; see kirsch-plot --help" % word)
        elif not words:
            raise Fault("%s: expected a value behind it, as %s %s" % (word, word, OPTIONS[word]))
        else:
            given[word].append(words.pop(0))
    return names, given


def numbers(option, word, expected):
    """Finite numbers between commas, as many as there are words in what is expected."""
    try:
        values = [float(x) for x in word.split(",")]
    except ValueError:
        values = []
    if len(values) != len(expected.split(",")) or not np.isfinite(values).all():
        raise Fault("%s: found `%s`, expected %s, as %s" % (option, word, expected, OPTIONS[option]))
    return values


def take_wishes(given):
    """What holds for all pictures."""
    for word in given["--format"]:
        if word not in ("png", "svg", "pdf"):
            raise Fault("--format: found `%s`, expected png, svg or pdf" % word)
        WISH["format"] = word
    for word in given["--dpi"]:
        WISH["dpi"], = numbers("--dpi", word, "a number")
        if not 20 <= WISH["dpi"] <= 2400:
            raise Fault("--dpi: found `%s`, expected 20 to 2400" % word)
    for word in given["--scale"]:
        WISH["scale"], = numbers("--scale", word, "a number")
    for word in given["--limits"]:
        WISH["limits"] = numbers("--limits", word, "lowest,highest")
        if not WISH["limits"][0] < WISH["limits"][1]:
            raise Fault("--limits: found `%s`, expected the lower one first" % word)
    for word in given["--slice"]:
        WISH["plane"] = shape.plane_of(word)


def case_of(folder, given):
    discs = [numbers("--disc", word, "x,y,radius") for word in given["--disc"]]
    balls = [numbers("--ball", word, "x,y,z,radius") for word in given["--ball"]]
    return Case(folder, discs, balls)


def prepare(names, given):
    """Make the pictures that hang on options drawable by name; returns the names of those asked for."""
    of_grid = {name: given["--" + option][-1] for name, option in (("hole", "hole"), ("void", "void"), ("cut", "slice"))
               if given["--" + option]}
    PICTURES["grid"] = lambda case: grid.grid(case, grid.Choice(case, **of_grid))
    film = "film" in names
    if film and not given["--field"]:
        raise Fault("film: expected the field to be filmed, as film --field Velocity")
    for name in names:
        if name not in PICTURES and name != "film":
            raise Fault("unknown picture `%s`; there are %s" % (name, ", ".join(list(PICTURES) + ["film"])))
    PICTURES.update({name: (movie.film_of if film else maps.maps_of)(name) for name in given["--field"]})
    names = [name for name in names if name != "film"] + given["--field"]
    return names or (["grid"] if of_grid else [])


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
        names, given = sort_out(sys.argv[1:])
        take_wishes(given)
        if names[:1] == ["study"]:
            study.draw(names[1])
        elif names[:1] == ["compare"]:
            compare.draw(names[1:], (given["--field"] or ["Damage"])[-1],
                         numbers("--at", given["--at"][-1], "a time in us")[0] if given["--at"] else None)
        else:
            case, wanted = case_of(names[0], given), prepare(names[1:], given)
            if not draw_all(case, wanted or (OF_SOLIDS if shape.is_solid(case) else OF_PLATES)):
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
