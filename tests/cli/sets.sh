#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Sets of nodes by place and of other sets, in a plate and in a block: each against its rule, worked out
# anew from the places of the nodes.
prefix=sets
. tests/cli/steps

cat >"$work/plate.geo" <<'GEO'
Point(1)={0,0,0,.005}; l[]=Extrude{.03,0,0}{Point{1}; Layers{30};};
s[]=Extrude{0,.02,0}{Curve{l[1]}; Layers{20}; Recombine;};
Physical Surface("plate")={s[1]}; Physical Curve("left")={s[3]}; Physical Curve("right")={s[2]};
GEO
cat >"$work/block.geo" <<'GEO'
SetFactory("OpenCASCADE");
Box(1)={0,0,0,.03,.02,.01}; Sphere(2)={.015,.01,.005,.003};
BooleanDifference(3)={Volume{1}; Delete;}{Volume{2}; Delete;};
Mesh.CharacteristicLengthMax=.0015;
Physical Volume("body")={3}; Physical Surface("left")={1}; Physical Surface("right")={6};
Physical Surface("void")={7};
GEO
gmsh -2 "$work/plate.geo" -format msh41 -o "$work/plate.msh" >"$work/log" 2>&1
gmsh -3 "$work/block.geo" -format msh41 -o "$work/block.msh" >"$work/log" 2>&1

# deck NAME MODEL Z: a deck with one set of each kind; Z follows each pair of components in 3D.
deck() {
    mid=${3:+, 5 mm} zero=${3:+, 0 mm} high=${3:+, 6 mm} up=${3:+, 0.5}
    cat >"$work/$1.yaml" <<DECK
geometry: {width: 30 mm, height: 20 mm${3:+, depth: 10 mm}}
mesh: {file: $1.msh, spacing: 1 mm}
material: {model: $2, youngs_modulus: 3 GPa, density: 1190 kg/m^3}
solver: {end_time: 1 us}
nodes:
  horizon: 3.1 mm
  partial_volume: hhb
  surface_correction: none
  sets:
    near: {within: 2.2 mm, of: left}
    box: {lower: [3 mm, 4 mm$zero], upper: [11 mm, 12 mm$high]}
    disc: {centre: [9 mm, 9 mm$mid], radius: 5.3 mm}
    half: {through: [12 mm, 7 mm$mid], normal: [1, -2$up]}
    either: {union: [box, disc, right]}
    both: {intersection: [box, disc, half]}
    less: {difference: [disc, box, half]}
    others: {not: [box, half]}
$4
DECK
}
deck plate plane-stress '' '    corner: {points: [[0 mm, 0 mm], [20 mm, 3 mm], [8 mm, 6 mm], [9.3 mm, 18 mm]]}'
deck block solid 3 '    hole: {within: 1.7 mm, of: void}'

# The node file's sets against the rules.
follow() { # NAME
    "$build/kirsch-nodes" --output "$work/out_$1" "$work/$1.msh" "$work/$1.yaml" || return 1
    /usr/bin/python3 - "$work/out_$1/plate.nodes.h5" <<'PY'
import sys
import h5py
import numpy as np
with h5py.File(sys.argv[1]) as f:
    x = f["nodes/position"][:] * 1e3
    got = {name: set(rows[:]) for name, rows in f["sets"].items()}
    measure = f["sets/near"].attrs["measure"]
dim = x.shape[1]
def cut(*values):
    return np.array(values[:dim], float)
def nodes(mask):
    return set(np.nonzero(mask)[0])
want = {"near": nodes(x[:, 0] <= 2.2),
        "box": nodes(((x >= cut(3, 4, 0)) & (x <= cut(11, 12, 6))).all(1)),
        "disc": nodes(((x - cut(9, 9, 5)) ** 2).sum(1) <= 5.3 ** 2),
        "half": nodes((x - cut(12, 7, 5)) @ cut(1, -2, .5) >= 0)}
want["either"] = want["box"] | want["disc"] | got["right"]
want["both"] = want["box"] & want["disc"] & want["half"]
want["less"] = want["disc"] - want["box"] - want["half"]
want["others"] = set(range(len(x))) - want["box"] - want["half"]
if dim == 2:
    # The polygon as the sum of the signed triangles of its fan.
    corners = np.array([[0, 0], [20, 3], [8, 6], [9.3, 18]])
    count = np.zeros(len(x), int)
    for b, c in zip(corners[1:-1], corners[2:]):
        t = np.linalg.solve(np.array([b, c]).T, x.T)
        sign = int(np.sign(b[0] * c[1] - b[1] * c[0]))
        count += sign * ((t[0] > 0) & (t[1] > 0) & (t.sum(0) < 1))
    want["corner"] = nodes(count > 0)
else:
    # Faces of 1.5 mm bulge less than 0.1 mm from the sphere of 3 mm.
    far = np.sqrt(((x - [15, 10, 5]) ** 2).sum(1)) - 3
    assert nodes(far < 1.6) <= got["hole"] <= nodes(far < 1.8) and got["hole"], len(got["hole"])
for name, wanted in want.items():
    assert wanted and got[name] == wanted, f"{name}: {len(got[name])} nodes, wanted {len(wanted)}"
assert abs(measure - .02 * (.01 if dim == 3 else 1)) < 1e-12, measure
print(f"# figure {dim}D:", {name: len(rows) for name, rows in got.items()})
PY
}
check plate follow plate
check block follow block

# Faults: an empty set, one not there, and one that stands below.
nodes_of() { # sets
    sed '/^    near/,$d' "$work/plate.yaml" >"$work/bad.yaml"
    printf '%s\n' "$@" >>"$work/bad.yaml"
    "$build/kirsch-nodes" --output "$work/bad" "$work/plate.msh" "$work/bad.yaml"
}
check empty stops 2 "set 'far' has no node in it" nodes_of \
    '    far: {centre: [80 mm, 0 mm], radius: 1 mm}'
check empty_together stops 2 "set 'none' has no node in it" nodes_of \
    '    all: {lower: [0 mm, 0 mm], upper: [30 mm, 20 mm]}' '    none: {not: [all]}'
check unknown stops 2 "sets.a.union.1: no set above this one is called 'up'; there are left" nodes_of \
    '    a: {union: [left, up]}' '    up: {within: 3 mm, of: left}'
check no_boundary stops 2 "sets.a.of: no boundary of the mesh is called 'nowhere'; there are left" nodes_of \
    '    a: {within: 1 mm, of: nowhere}'
check no_boundary_but_a_near_one stops 2 "is called 'letf'; did you mean 'left'? There are left" nodes_of \
    '    a: {within: 1 mm, of: letf}'
check probe stops 2 "output.probes.0.set: no set is called 'rim'; there are" nodes_of \
    '    a: {within: 1 mm, of: left}' 'output: {probes: [{name: p, quantity: damage, set: rim}]}'
echo "1..$count"
