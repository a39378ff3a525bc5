#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write cases/README.md: all cases with verdicts, time and memory, from build/validation/*.csv."""
import csv
import glob
import os

BUILD = os.environ.get("BUILD") or "build"
BEGIN, END = "<!-- measured -->\n", "<!-- end -->\n"


def line_of(path):
    """One line of the table."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    by_name = {row["quantity"]: row["value"] for row in rows}
    differs = [row["quantity"] for row in rows if row["verdict"] == "differs"]
    name, agrees = rows[0]["case"], sum(row["verdict"] == "agrees" for row in rows)
    return (f"| [{name}]({name}/README.md) | {rows[0]['size']} | {agrees} | {len(differs)} | "
            f"{'; '.join(differs)} | {by_name.get('wall time of all runs [s]', '')} | "
            f"{by_name.get('most memory of a program [MB]', '')} |\n")


def main():
    """Replace the table between the marks."""
    head = "| case | size | agree | differ | what differs | wall time [s] | memory [MB] |\n|" + 7 * "---|" + "\n"
    table = head + "".join(map(line_of, sorted(glob.glob(os.path.join(BUILD, "validation", "*.csv")))))
    with open("cases/README.md") as file:
        before, rest = file.read().split(BEGIN)
    with open("cases/README.md.new", "w") as file:
        file.write(before + BEGIN + table + END + rest.split(END)[1])
    os.replace("cases/README.md.new", "cases/README.md")
    print("wrote cases/README.md")


main()
