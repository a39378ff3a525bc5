# SPDX-License-Identifier: BSD-3-Clause
"""Let the N-th allocation of a program fail, for one N after the other, until the program succeeds: each failure must
end with exit 6 and a sentence, and leave no file under its own name that is not whole.

    allocations.py RUNS FOLDER PROGRAM ARGUMENT...

FOLDER holds what the program reads, and is copied anew each time; {} in an argument stands for the copy. RUNS: about so
many N, spread evenly, from a random one on, and the last ones; 0: every N. Prints how many were tried."""
import os
import random
import shutil
import subprocess
import sys
import tempfile

import h5py

runs, folder, command = int(sys.argv[1]), sys.argv[2], sys.argv[3:]
WHOLE = tempfile.mkdtemp()
LAST = 15  # results are written towards the end: these are always tried


def run(n, to):
    """Into a fresh copy of the folder. Gives the exit code and the last line that was said."""
    shutil.rmtree(to, ignore_errors=True)
    shutil.copytree(folder, to)
    environment = dict(os.environ, KIRSCH_FAIL_ALLOCATION=str(n), OMP_NUM_THREADS="1")
    done = subprocess.run([word.replace("{}", to) for word in command], env=environment, capture_output=True, text=True)
    return done.returncode, (done.stderr.strip().splitlines() or [""])[-1]


def fits(n):
    return run(n, WHOLE)[0] == 0


def last_site():
    """The greatest N that fails: from there on the program does not allocate so often."""
    low, high = 0, 64
    while not fits(high):
        low, high = high, 2 * high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if fits(middle) else (middle, high)
    return low


def is_whole(path):
    """HDF5 reads all of it. Meshes and pores are those of the run that had all memory; tables may have fewer lines."""
    if path.endswith(".h5"):
        with h5py.File(path) as file:
            file.visititems(lambda name, item: item[()] if isinstance(item, h5py.Dataset) else None)
        return True
    with open(path, "rb") as ours, open(os.path.join(WHOLE, os.path.relpath(path, WHOLE + "-now")), "rb") as theirs:
        mine, whole = ours.read(), theirs.read()
    return mine == whole if not path.endswith((".csv", ".xdmf")) else not mine or mine.endswith(b"\n")


def check(n):
    code, said = run(n, WHOLE + "-now")
    if code != 6 or "out of memory" not in said:
        sys.exit(f"allocation {n} of {' '.join(command)}: exit {code}, and it said: {said}")
    for where, _, names in os.walk(WHOLE + "-now"):
        for name in names:
            path = os.path.join(where, name)
            if not name.endswith(".tmp") and os.path.islink(path) is False and not is_whole(path):
                sys.exit(f"allocation {n} left {path} half written")


last = last_site()
run(0, WHOLE)
step = max(1, last // runs) if runs else 1
tried = sorted({*range(random.randint(1, step), last + 1, step), *range(max(1, last - LAST), last + 1)})
for n in tried:
    check(n)
program = os.path.basename(next(word for word in command if os.path.basename(word).startswith("kirsch-")))
print(f"# figure {program}: {len(tried)} of its {last} allocations failed in turn, from {tried[0]} on")
shutil.rmtree(WHOLE)
shutil.rmtree(WHOLE + "-now", ignore_errors=True)
