# SPDX-License-Identifier: BSD-3-Clause
"""What the cases' drivers share: run kirsch, read what it wrote, judge and write the table.

A case is a folder cases/NAME with case.yaml, README.md and a driver `run`, called by
`make cases/NAME` (FULL=1: the published size). Each comparison is one row of
build/validation/NAME.csv (NAME-full.csv) and of the table in the README, which the driver writes itself.
"""
import csv
import math
import os
import subprocess
import sys
import time

import numpy

import matplotlib
matplotlib.use("Agg")

BUILD = os.environ.get("BUILD") or "build"
FULL = bool(os.environ.get("FULL"))
COLUMNS = ["case", "size", "quantity", "value", "reference", "tolerance", "verdict", "source"]


def table_of(path):
    """Columns of a CSV by name: numbers as arrays, all else as lists of words."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        names = rows[0].keys() if rows else []
    def column(name):
        words = [row[name] for row in rows]
        try:
            return numpy.array([float(word) if word else math.nan for word in words])
        except ValueError:
            return words
    return {name: column(name) for name in names}


class Case:
    """A case of this name: its runs, and the rows of its table."""

    def __init__(self, name):
        self.name = name
        self.folder = os.path.join("cases", name)
        self.size = "full" if FULL else "small"
        self.rows, self.hidden = [], []
        self.seconds, self.megabytes = 0.0, 0.0  # wall time of all runs, most memory of one

    def path(self, label, *file):
        """Path of a file of a run. The label `CASE:RUN` is a run of another case, shared with it."""
        owner, _, run = label.rpartition(":")
        return os.path.join("out", "cases", owner or self.name, self.size, run, *file)

    def kirsch(self, label, settings=None, until="solve", deck="case.yaml"):
        """Run the steps of the deck that are out of date, with settings {key: value} over it."""
        folder = self.path(label)
        os.makedirs(folder, exist_ok=True)
        command = [os.path.join(BUILD, "kirsch"), "--until", until, "--output", folder]
        for key, value in (settings or {}).items():
            command += ["--set", f"{key}={value}"]
        if FULL:
            command += ["--variant", "full"]
        log = os.path.join(folder, "log.txt")
        began = time.monotonic()
        with open(log, "w") as to:
            child = subprocess.Popen(command + [os.path.join(self.folder, deck)], stdout=to,
                                     stderr=subprocess.STDOUT)
            _, status, used = os.wait4(child.pid, 0)
            child.returncode = code = os.waitstatus_to_exitcode(status)
        self.count_cost(folder, log, time.monotonic() - began, used.ru_maxrss / 1024)
        if code:
            with open(log) as said:
                sys.exit(f"{self.name}: {' '.join(command)} ended with {code}:\n{said.read()[-2000:]}")
        print(f"  {self.name}: {label} is there", flush=True)
        return folder

    def count_cost(self, folder, log, seconds, megabytes):
        """Add what a run took; what took it earlier where all was up to date by now."""
        kept = os.path.join(folder, "cost.txt")
        with open(log) as said:
            anew = "kirsch-solve is up to date" not in said.read()
        if anew or not os.path.exists(kept):
            with open(kept, "w") as file:
                file.write(f"{seconds:.1f} {megabytes:.0f}\n")
        with open(kept) as file:
            seconds, megabytes = map(float, file.read().split())
        self.seconds += seconds
        self.megabytes = max(self.megabytes, megabytes)

    def row(self, quantity, value, reference=None, tolerance=None, source="", verdict=None,
            is_in_readme=True):
        """One comparison. Numbers: within `tolerance` (absolute) of `reference`; else a verdict that
        the driver gives (True or False); with neither the row only tells. Rows may stay out of the
        README, for what a table of the driver's own (`finish`) tells better."""
        if verdict is None and reference is not None and tolerance is not None:
            verdict = abs(value - reference) <= tolerance
        word = "" if verdict is None else "agrees" if verdict else "differs"
        self.hidden += [] if is_in_readme else [len(self.rows)]
        self.rows.append(dict(zip(COLUMNS, [self.name, self.size, quantity, text_of(value),
                                            text_of(reference), text_of(tolerance), word, source])))

    def finish(self, notes=""):
        """Write the CSV and the table between the marks of the README, and print it."""
        self.row("wall time of all runs [s]", self.seconds)
        self.row("most memory of a program [MB]", self.megabytes)
        path = os.path.join(BUILD, "validation", self.name + ("-full" if FULL else "") + ".csv")
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path + ".new", "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            writer.writeheader()
            writer.writerows(self.rows)
        os.replace(path + ".new", path)
        text = self.table() + ("\n" + notes.strip() + "\n" if notes else "")
        self.write_between(text)
        print(text + f"\nwrote {path}")

    def table(self):
        head = COLUMNS[2:]
        return table_text(head, [[row[name] for name in head] for k, row in enumerate(self.rows)
                                 if k not in self.hidden])

    def write_between(self, text):
        """Replace what stands between the marks of this size in the README."""
        path = os.path.join(self.folder, "README.md")
        begin, end = f"<!-- measured: {self.size} -->", f"<!-- end: {self.size} -->"
        with open(path) as file:
            old = file.read()
        if begin not in old or end not in old:
            sys.exit(f"{path}: the marks '{begin}' and '{end}' are missing; the table goes between them")
        head, rest = old.split(begin, 1)
        new = f"{head}{begin}\n{text}{end}{rest.split(end, 1)[1]}"
        with open(path + ".new", "w") as file:
            file.write(new)
        os.replace(path + ".new", path)

    def save(self, figure, name):
        """A picture of the case, in its folder of results."""
        path = os.path.join("out", "cases", self.name, self.size, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        figure.savefig(path, dpi=110, bbox_inches="tight", metadata={"Software": None})
        print(f"  wrote {path}")


def table_text(head, rows):
    """A table in Markdown."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(text_of(value) for value in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def text_of(value):
    """A number to five digits; words as they are."""
    if value is None:
        return ""
    return f"{value:.5g}" if isinstance(value, (float, numpy.floating)) else str(value)
