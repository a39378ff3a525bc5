#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Pictures of grids: around any hole of a plate and any void of a solid, and in any plane of one.
prefix=grid
. tests/cli/steps

cat >"$work/plate.yaml" <<'DECK'
geometry:
  width: 12 mm
  height: 6 mm
  holes:
    - {centre: [3 mm, 3 mm], radius: 1 mm}
    - {centre: [9 mm, 3 mm], shape: slot, length: 3 mm, width: 1 mm, angle: 40 deg}
mesh: {grid: voronoi, spacing: 0.2 mm}
nodes: {horizon: 0.6 mm, surface_correction: none}
material: {model: plane-stress, youngs_modulus: 3 GPa, density: 1190 kg/m3}
solver: {end_time: 1 us}
DECK
cat >"$work/block.yaml" <<'DECK'
geometry:
  width: 6 mm
  height: 5 mm
  depth: 4 mm
  voids:
    - {centre: [2 mm, 2.5 mm, 2 mm], radius: 1.2 mm}
    - {centre: [4.6 mm, 2.5 mm, 2 mm], shape: ellipsoid, radii: [0.8 mm, 1.1 mm, 1 mm]}
mesh: {grid: voronoi, spacing: 0.25 mm}
nodes: {horizon: 0.75 mm, surface_correction: none}
material: {model: solid, youngs_modulus: 3 GPa, density: 1190 kg/m3}
solver: {end_time: 1 us}
DECK
make_nodes() { # body, option...
    body=$1
    shift
    "$build/kirsch-mesh" --output "$work/$body" "$@" "$work/$body.yaml" &&
        "$build/kirsch-nodes" --output "$work/$body" "$@" "$work/$body.yaml"
}
plot() { body=$1; shift; "$build/kirsch-plot" --output "$work/$body" "$work/$body.yaml" "$@"; }
drawn() { [ "$(head -c 4 "$1" | tail -c 3)" = PNG ] && [ "$(wc -c <"$1")" -gt 10000 ]; }

around_any_hole() {
    make_nodes plate && plot plate grid --hole 1 && plot plate --hole 2 &&
        drawn "$work/plate/pictures/grid_hole_1.png" && drawn "$work/plate/pictures/grid_hole_2.png" &&
        ! cmp -s "$work/plate/pictures/grid_hole_1.png" "$work/plate/pictures/grid_hole_2.png"
}
in_any_plane() {
    make_nodes block && plot block grid --void 2 && plot block grid --slice 'x=2.1 mm' &&
        drawn "$work/block/pictures/grid_void_2.png" && drawn "$work/block/pictures/grid_x.png"
}
what_is_not_there_is_told() {
    stops 2 'there is no hole 3; the case has 2' plot plate --hole 3 &&
        stops 2 'a plate has no slices' plot plate --slice 'z=1 mm' &&
        stops 2 "unknown plane .z=1.; expected as --slice 'z=2.5 mm'" plot block --slice z=1 &&
        stops 2 'the plane z = 9 mm cuts no cell' plot block --slice 'z=9 mm'
}
# What is painted of a plane is the block less the circle of the sphere there and the ellipse. Chords of
# c spacings on a radius of R lose c^2/(6 R^2) of what they bound, here a tenth of the plane: 0.002 and, in
# boxes with c = 2, 0.008. What is drawn around the cells holds the edges of the block.
slices_fill_the_plane() {
    for grid in voronoi near-boundary uniform; do
        make_nodes block --set mesh.grid=$grid >"$work/said" || return
        PYTHONPATH="$build" /usr/bin/python3 -B - "$work/block" $grid <<'PYTHON' || return
import sys, numpy as np
from results import Case
import section
case = Case(sys.argv[1], [], [])
point, first, vertex, volume, spacing = case.cells()
height = point[:, 2] - 2.3 - 1e-9
seen = section.cells_across(point, first, vertex, height, np.zeros(3), 99, [0, 1])
solids, owners, faces = section.pieces(first, vertex, seen)
polygons, of = section.cut_tetrahedra(point, height, solids, owners, [0, 1])
area = sum(abs(np.sum(p[:, 0]*np.roll(p[:, 1], -1) - p[:, 1]*np.roll(p[:, 0], -1)))/2 for p in polygons)
exact = 30 - np.pi*(1.44 - 0.09) - np.pi*0.8*1.1*(1 - 0.09)
lines = np.array(section.cut_faces(point, height, faces, [0, 1]))
length = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1)
rim = length[(np.abs(lines[:, :, 0]) < 1e-9).all(axis=1)].sum()
off = area/exact - 1
allowed = {"uniform": 0.03, "near-boundary": 0.008, "voronoi": 0.002}[sys.argv[2]]
print("# figure %s: painted area of a slice off by %.1e" % (sys.argv[2], off))
assert set(of) == set(seen) and abs(off) < allowed, off
assert abs(rim - 5) < 1e-9, rim
PYTHON
    done
}

for name in around_any_hole in_any_plane what_is_not_there_is_told slices_fill_the_plane; do
    check $name $name
done
echo "1..$count"
