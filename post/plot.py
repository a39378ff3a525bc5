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
    from results import Case, Fault, Nothing, warn
    import curves
    import grid
    import maps
    import movie
    import study
    import tree
    import compare
except ImportError as missing:
    print("kirsch-plot: %s; pictures need Debian's python3-numpy, python3-matplotlib and "
          "python3-h5py" % missing, file=sys.stderr)
    sys.exit(5)

PICTURES = {
    "grid": grid.grid,
    "damage": maps.damage,
    "energy": maps.energy,
    "speed": curves.speed,
    "tip": curves.tip,
    "tree": tree.tree,
    "history": curves.history,
    "crack": movie.crack,
}


def arguments(words):
    """Folder, names of pictures, holes, voids, and what of the grid is asked for."""
    folder, names, round_ones, wanted = None, [], {"--disc": [], "--ball": []}, {}
    words = list(words)
    while words:
        word = words.pop(0)
        if word in round_ones and words:
            round_ones[word].append(tuple(float(x) for x in words.pop(0).split(",")))
        elif word in ("--hole", "--void", "--slice") and words:
            wanted["cut" if word == "--slice" else word[2:]] = words.pop(0)
        elif word == "--field" and words:
            name = words.pop(0)
            names.append(name)
            PICTURES[name] = maps.any_field(name)
        elif folder is None:
            folder = word
        elif word in PICTURES:
            names.append(word)
        else:
            raise Fault("unknown picture `%s`; there are %s" % (word, ", ".join(PICTURES)))
    if folder is None:
        raise Fault("the folder of the case is missing")
    if wanted and not names:
        names = ["grid"]
    return folder, names or list(PICTURES), round_ones["--disc"], round_ones["--ball"], wanted


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
        if sys.argv[1:2] == ["study"]:
            study.draw(sys.argv[2])
            return
        if sys.argv[1:2] == ["compare"]:
            compare.draw(*sys.argv[2:])
            return
        folder, names, holes, voids, wanted = arguments(sys.argv[1:])
        case = Case(folder, holes, voids)
        PICTURES["grid"] = lambda case: grid.grid(case, grid.Choice(case, **wanted))
        if not draw_all(case, names):
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
