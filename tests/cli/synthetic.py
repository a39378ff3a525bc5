#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Make a case folder as if a run had been there: synthetic.py FOLDER [SPACING_MM [STEPS]].

A plate of 50 mm x 25 mm with one hole. The crack starts at a notch of 2 mm, enters the hole,
leaves it on the other side, runs on and forks at x = 30 mm. The fields are drawn, not computed:
they have the shape of the real ones, for tests of what reads them.
"""
import math
import os
import sys

import h5py
import numpy as np

MM, US = 1e-3, 1e-6
WIDTH, HEIGHT = 50 * MM, 25 * MM
HOLE, RADIUS, BOX = np.array([15 * MM, 12.5 * MM]), 1.5 * MM, 3 * MM
RAYLEIGH, TIME_STEP = 929.0, 0.02 * US
START, SPEED, WAIT = 20 * US, 450.0, 5 * US


def lattice(h):
    """Square cells outside the box around the hole: corners (cells, 4, 2)."""
    x, y = np.meshgrid((np.arange(round(WIDTH / h))) * h, np.arange(round(HEIGHT / h)) * h)
    low = np.stack([x.ravel(), y.ravel()], axis=1)
    low = low[(np.abs(low + h / 2 - HOLE) > BOX).any(axis=1)]
    return low[:, None, :] + np.array([[0, 0], [h, 0], [h, h], [0, h]])


def ring(h):
    """Quadrilaterals between the hole and its box."""
    side = round(2 * BOX / h)
    along = np.arange(side) * h - BOX
    edge = np.full(side, BOX)
    rim = np.concatenate([np.stack([edge, along], 1), np.stack([-along, edge], 1),
                          np.stack([-edge, -along], 1), np.stack([along, -edge], 1)])
    inner = RADIUS * rim / np.hypot(*rim.T)[:, None]
    layers = max(2, round((BOX - RADIUS) / h))
    part = np.linspace(0, 1, layers + 1)[:, None, None]
    grid = HOLE + inner + part * (rim - inner)  # (layers + 1, around, 2)
    nxt = np.roll(grid, -1, axis=1)
    return np.stack([grid[:-1], grid[1:], nxt[1:], nxt[:-1]], axis=2).reshape(-1, 4, 2)


def cells(h):
    """Polygons as points, first, vertex; the innermost of the ring are cut into triangles."""
    quads = np.concatenate([lattice(h), ring(h)])
    at_rim = np.hypot(*(quads - HOLE).transpose(2, 0, 1)).min(axis=1) < RADIUS * 1.0001
    cut = quads[at_rim]
    polygons = [quads[~at_rim], cut[:, [0, 1, 2]], cut[:, [0, 2, 3]]]
    sizes = np.concatenate([np.full(len(p), p.shape[1]) for p in polygons])
    corners = np.concatenate([p.reshape(-1, 2) for p in polygons])
    keys = np.round(corners / (h * 1e-3)).astype(np.int64)
    _, index, vertex = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    first = np.concatenate([[0], np.cumsum(sizes)])
    return corners[index], first, vertex.ravel().astype(np.int64)


def centroids(point, first, vertex):
    """Area and centroid of each cell, by the shoelace formula."""
    owner = np.repeat(np.arange(len(first) - 1), np.diff(first))
    following = np.arange(len(vertex)) + 1
    following[first[1:] - 1] = first[:-1]
    a, b = point[vertex], point[vertex[following]]
    cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    n = len(first) - 1
    area = np.bincount(owner, cross, n) / 2
    centre = np.stack([np.bincount(owner, (a + b)[:, k] * cross, n) for k in (0, 1)], axis=1)
    return area, centre / (6 * area[:, None])


def paths():
    """Pieces of the crack: from, to [m], time at from [s], speed [m/s]; speed 0: the notch."""
    y = HOLE[1]
    to_hole = (HOLE[0] - RADIUS - 2 * MM) / SPEED
    again = START + to_hole + WAIT
    fork = again + (30 * MM - HOLE[0] - RADIUS) / SPEED
    return [((0, y), (2 * MM, y), 0, 0),
            ((2 * MM, y), (HOLE[0] - RADIUS, y), START, SPEED),
            ((HOLE[0] + RADIUS, y), (30 * MM, y), again, SPEED),
            ((30 * MM, y), (50 * MM, 19 * MM), fork, 1.1 * SPEED),
            ((30 * MM, y), (50 * MM, 6.5 * MM), fork, SPEED)]


def along(position, path):
    """Coordinate along a piece, distance across, and its length."""
    a, b = np.array(path[0]), np.array(path[1])
    e = (b - a) / math.dist(a, b)
    d = position - a
    s = d @ e
    over = s - np.clip(s, 0, math.dist(a, b))
    return s, np.hypot(d @ np.array([-e[1], e[0]]), over), math.dist(a, b)


def damage_at(position, time, horizon):
    """Share of the horizon's disk beyond a straight crack that passes at the distance d."""
    damage = np.zeros(len(position))
    for path in paths():
        s, d, _ = along(position, path)
        q = np.clip(d / horizon, 0, 1)
        cut = (np.arccos(q) - q * np.sqrt(1 - q * q)) / np.pi
        reached = s <= (time - path[2]) * path[3] if path[3] else s < np.inf
        damage = np.maximum(damage, np.where(reached, cut, 0))
    return damage


def damage_times(position, horizon, threshold, end):
    """Time at which the damage of each node passes the threshold, in whole steps."""
    result = np.full(len(position), np.inf)
    for path in paths():
        s, d, _ = along(position, path)
        q = np.clip(d / horizon, 0, 1)
        hit = (np.arccos(q) - q * np.sqrt(1 - q * q)) / np.pi > threshold
        when = path[2] + np.maximum(s, 0) / path[3] if path[3] else np.full(len(s), -1.0)
        when = np.where(when > 0, np.ceil(when / TIME_STEP) * TIME_STEP, -1)
        result = np.where(hit, np.minimum(result, when), result)
    return np.where(result <= end, result, np.inf)


def energy_at(position, time, end):
    """Strain energy density: rises with the load, is drawn to the tips and the hole."""
    load = 2e3 * (0.3 + time / end) ** 2
    r = np.hypot(*(position - HOLE).T)
    c2 = ((position[:, 1] - HOLE[1]) / r) ** 2
    result = load * (1 + 1.5 * (RADIUS / r) ** 2 * (1 - 1.6 * c2))
    for path in paths():
        a, b = np.array(path[0]), np.array(path[1])
        length = math.dist(a, b)
        gone = (time - path[2]) * path[3] if path[3] else length
        if not 0 <= gone <= length:
            continue
        tip = a + (b - a) * min(gone / length, 1)
        result += load * 2 * MM / np.maximum(np.hypot(*(position - tip).T), 0.15 * MM)
    return result * (1 - damage_at(position, time, 2 * MM))


def motion_at(position, time, end):
    """Displacements: pulled by 0.5 % in y in the end, and opened along the crack's line; velocities and
    stresses that belong to nothing but have their shapes."""
    u = np.zeros((len(position), 3))
    up = position[:, 1] - HOLE[1]
    u[:, 1] = 0.005 * time / end * (up + 2 * MM * np.sign(up))
    stress = np.stack([up * 1e8, up * 0, up * 0, up * 2e8 + 1e5, up * 0, up * 0], axis=1)
    return {"Displacement": u, "Velocity": u / end, "Stress": stress}


def write_nodes(path, point, first, vertex, area, position, h):
    with h5py.File(path, "w") as f:
        f.attrs.update(format="kirsch nodes", version=1, dim=2, spacing=h, program="synthetic",
                       machine="", deck="", horizon=4 * h, model="plane-stress",
                       partial_volume="hhb", surface_correction="energy",
                       deformation="uniaxial-y")
        f["/nodes/position"], f["/nodes/volume"] = position, area
        f["/nodes/surface_factor"] = np.ones(len(area))
        off = np.hypot(*(position - HOLE).T)
        rims = {"hole_1": np.flatnonzero(off < RADIUS + 0.7 * h),
                "left": np.flatnonzero(position[:, 0] < 0.6 * h),
                "right": np.flatnonzero(position[:, 0] > WIDTH - 0.6 * h)}
        for name, nodes in rims.items():
            f["/sets/" + name] = nodes.astype(np.int64)
            f["/sets/" + name].attrs["measure"] = len(nodes) * h
        f["/nodes/tag"] = np.arange(len(area), dtype=np.int64)
        f["/cells/point"], f["/cells/first"], f["/cells/vertex"] = point, first, vertex


def write_run(path, area, position, h, steps, end):
    horizon, last = 4 * h, round(end / TIME_STEP)
    times = damage_times(position, horizon, 0.35, end)
    broken = np.sort(times[(times > 0) & (times < np.inf)])
    with h5py.File(path, "w") as f:
        f.attrs.update(format="kirsch run", version=1, dim=2, program="synthetic", machine="",
                       deck="", deck_hash="", nodes_file="plate.nodes.h5", n=len(area),
                       time_step=TIME_STEP, horizon=horizon, spacing=h,
                       damage_threshold=0.35, fracture_energy=200.0, density=1190.0, poissons_ratio=1 / 3,
                       rayleigh_speed=RAYLEIGH, bonds=24 * len(area))
        f["/nodes/position"], f["/nodes/volume"] = position, area
        f["/crack/Damage_Time"], f["/crack/bond_time"] = times, broken
        order = np.argsort(times, kind="stable")
        first = order[(times[order] > 0) & (times[order] < np.inf)]
        f["/crack/bond"] = np.stack([first, (first + 1) % len(area)], axis=1).astype(np.int32)
        f["/crack/bond_energy"] = np.full(len(broken), 200.0 * h / 2)
        f["/crack"].attrs.update(steps=last, finished=1, external_work=4.0, kinetic_energy=1.0,
                                 strain_energy=2.5, fracture_work=0.49)
        for k in np.unique(np.linspace(0, last, steps + 1).astype(int)):
            time, group = k * TIME_STEP, f.create_group("/step/%06d" % k)
            group.attrs.update(time=time, step=int(k))
            pack = dict(shuffle=True, compression=1)
            group.create_dataset("Damage", data=damage_at(position, time, horizon).astype("f4"),
                                 **pack)
            group.create_dataset("Stored_Elastic_Energy_Density",
                                 data=energy_at(position, time, end).astype("f4"), **pack)
            for name, values in motion_at(position, time, end).items():
                group.create_dataset(name, data=values.astype("f4"), **pack)


def write_history(path, end):
    t = np.linspace(0, end, 400)
    work = 60 * (t / end) ** 2 * (1.5 - t / end)
    fracture = 9 * np.clip((t - START) / (end - START), 0, 1)
    kinetic = 0.1 * work + 4 * np.clip((t - START) / (end - START), 0, 1) ** 2
    balance = 0.002 * work * np.sin(40 * t / end)
    strain = work - fracture - kinetic - balance
    names = ["kinetic", "strain", "fracture", "external_work", "balance"]
    header = "step, time [s], " + ", ".join(n + " [J/m]" for n in names) + ", broken_bonds"
    rows = np.stack([np.round(t / TIME_STEP), t, kinetic, strain, fracture, work, balance,
                     np.round(fracture * 1e4)], axis=1)
    np.savetxt(path, rows, header=header, comments="", delimiter=", ", fmt="%.9g")


DECK = """title: a drawn crack through one hole
geometry:
  width: 50 mm
  height: 25 mm
  holes: [{{centre: [15 mm, 12.5 mm], radius: 1.5 mm}}]
mesh: {{spacing: {h} mm}}
nodes: {{horizon: {d} mm}}
material: {{model: plane-stress, youngs_modulus: 3.24 GPa, density: 1190 kg/m^3, fracture_energy: 200 J/m^2}}
solver: {{end_time: 120 us}}
output: {{every: 2 us}}
"""


def main():
    folder = sys.argv[1]
    h = float(sys.argv[2]) * MM if len(sys.argv) > 2 else 0.25 * MM
    steps = int(sys.argv[3]) if len(sys.argv) > 3 else 12
    os.makedirs(folder, exist_ok=True)
    point, first, vertex = cells(h)
    area, position = centroids(point, first, vertex)
    end = 120 * US
    write_nodes(folder + "/plate.nodes.h5", point, first, vertex, area, position, h)
    write_run(folder + "/run.h5", area, position, h, steps, end)
    write_history(folder + "/history.csv", end)
    with open(folder + "/case.yaml", "w") as f:
        f.write(DECK.format(h=h / MM, d=4 * h / MM))


main()
