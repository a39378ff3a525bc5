#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write the table of cases/README.md: all cases with verdicts, time and memory, from the tables of their READMEs."""
import glob
import os
import re

BEGIN, END = "<!-- measured -->\n", "<!-- end -->\n"
HEAD = "| case | size | agree | differ | what differs | wall time [s] | memory [MB] |\n|" + 7 * "---|" + "\n"


def rows_of(text):
    """Quantity, value and verdict of each row of the first table in a text."""
    lines = text.strip().split("\n\n")[0].splitlines()[2:]  # below its head
    cells = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines]
    return [(cell[0], cell[1], cell[4]) for cell in cells]


def line_of(name, size, rows):
    """One line of the table."""
    values = {quantity: value for quantity, value, _ in rows}
    differs = [quantity for quantity, _, verdict in rows if verdict == "differs"]
    agrees = sum(verdict == "agrees" for _, _, verdict in rows)
    return (f"| [{name}]({name}/README.md) | {size} | {agrees} | {len(differs)} | {'; '.join(differs)} | "
            f"{values.get('wall time of all runs [s]', '')} | {values.get('most memory of a program [MB]', '')} |\n")


def main():
    """Replace the table between the marks."""
    table = HEAD
    for path in sorted(glob.glob("cases/*/README.md")):
        with open(path) as file:
            measured = re.findall(r"<!-- measured: (small|full) -->\n(.*?)<!-- end: \1 -->", file.read(), re.S)
        for size, text in measured:
            if text.strip():
                table += line_of(os.path.basename(os.path.dirname(path)), size, rows_of(text))
    with open("cases/README.md") as file:
        before, rest = file.read().split(BEGIN)
    with open("cases/README.md.new", "w") as file:
        file.write(before + BEGIN + table + END + rest.split(END)[1])
    os.replace("cases/README.md.new", "cases/README.md")
    print("wrote cases/README.md")


main()
