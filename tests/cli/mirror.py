# SPDX-License-Identifier: BSD-3-Clause
"""mirror.py RUN IMAGE HEIGHT: hold the damage times of a run against those of its mirror image."""
import sys

import h5py
import numpy as np

plate, image = (h5py.File(path, "r") for path in sys.argv[1:3])
height, spacing = float(sys.argv[3]), plate.attrs["spacing"]
x = plate["nodes/position"][:]
y = image["nodes/position"][:] * [1, -1] + [0, height]


def order(position):
    """Nodes by rows and columns of the lattice, so that rounded places do not matter."""
    cell = np.round(position / spacing * 2).astype(int)
    return np.lexsort((cell[:, 0], cell[:, 1]))


a, b = order(x), order(y)
assert np.abs(x[a] - y[b]).max() < 1e-9 * height, "the nodes are no mirror image"
time, other = plate["crack/Damage_Time"][:][a], image["crack/Damage_Time"][:][b]
first = np.minimum(time, other)
differ = first[time != other]
until = differ.min() if differ.size else np.inf
cracked = np.isfinite(first) & (first >= 0)
print(f"# figure {cracked.sum()} nodes crack, {(cracked & (first < until)).sum()} of them at the very "
      f"step of their image before the first that does not, at {1e6 * until:.1f} us")
assert cracked.sum() > 100, "hardly anything broke"
assert not differ.size, "damage passes the threshold at another step than in the mirror"
