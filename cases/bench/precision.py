# SPDX-License-Identifier: BSD-3-Clause
"""Two runs of one deck side by side, in double and in mixed precision: summary, and when damage parts."""
import csv
import sys

import h5py
import numpy as np

NAMES = ("steps", "broken_bonds", "damaged_nodes", "first_growth", "branches", "cracks", "crack_length",
         "mean_speed", "top_speed", "fracture_work", "energy_balance")


def summary(folder):
    with open(folder + "/summary.csv", newline="") as file:
        return {row["name"]: float(row["value"]) for row in csv.DictReader(file)}


def main(out):
    double, mixed = (summary(f"{out}/{name}") for name in ("double", "mixed"))
    for name in NAMES:
        if name in double and name in mixed:
            print(f"  {name:16} {double[name]:12.6g} {mixed[name]:12.6g}")
    with h5py.File(f"{out}/double/run.h5") as a, h5py.File(f"{out}/mixed/run.h5") as b:
        for step in sorted(set(a["step"]) & set(b["step"])):
            one, other = (np.asarray(file["step"][step]["Damage"]) for file in (a, b))
            if np.any(one != other):
                time = a["step"][step].attrs.get("time", np.nan)
                print(f"  damage first differs at output {step} (t {1e6 * float(time):.4g} us): "
                      f"{np.count_nonzero(one != other)} nodes, by {np.abs(one - other).max():.3g}")
                break
        else:
            print("  damage is the same at all outputs")
        last = sorted(set(a["step"]) & set(b["step"]))[-1]
        one, other = (np.asarray(file["step"][last]["Damage"]) > 0.35 for file in (a, b))
        print(f"  damaged (over 0.35) at the end in one of them only: {np.count_nonzero(one != other)} "
              f"nodes of {np.count_nonzero(one | other)}")


main(sys.argv[1])
