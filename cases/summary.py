#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bring cases/README.md up to date: a line a case and size with verdicts, time and memory, from
build/validation/*.csv. Lines of what was not run here stay as they are."""
import csv
import glob
import os

BUILD = os.environ.get("BUILD") or "build"
BEGIN, END = "<!-- measured -->\n", "<!-- end -->\n"


def line_of(path):
    """Case and size, and their line of the table."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    by_name = {row["quantity"]: row["value"] for row in rows}
    differs = [row["quantity"] for row in rows if row["verdict"] == "differs"]
    name, agrees = rows[0]["case"], sum(row["verdict"] == "agrees" for row in rows)
    line = (f"| [{name}]({name}/README.md) | {rows[0]['size']} | {agrees} | {len(differs)} | "
            f"{'; '.join(differs)} | {by_name.get('wall time of all runs [s]', '')} | "
            f"{by_name.get('most memory of a program [MB]', '')} |")
    return key_of(line), line


def key_of(line):
    """Case and size of a line of the table."""
    return tuple(line.split(" | ")[:2])


def main():
    """Replace the table between the marks."""
    with open("cases/README.md") as file:
        before, rest = file.read().split(BEGIN)
    old, after = rest.split(END)
    head, lines = old.splitlines()[:2], {key_of(line): line for line in old.splitlines()[2:]}
    lines.update(map(line_of, glob.glob(os.path.join(BUILD, "validation", "*.csv"))))
    table = "\n".join(head + [lines[key] for key in sorted(lines)]) + "\n"
    with open("cases/README.md.new", "w") as file:
        file.write(before + BEGIN + table + END + after)
    os.replace("cases/README.md.new", "cases/README.md")
    print("wrote cases/README.md")


main()
