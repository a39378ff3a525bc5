#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The crack tree of real runs: what it leaves out, lengths against energy, mirrored plates, broken files.
prefix=tree
. tests/cli/steps

deck() { # folder, y of the hole, y of the notch
    mkdir -p "$1"
    cat >"$1/case.yaml" <<END
geometry: {width: 20 mm, height: 10 mm, holes: [{centre: [9 mm, $2 mm], radius: 1 mm}]}
mesh: {grid: uniform, spacing: 0.2 mm}
nodes: {horizon: 0.8 mm}
material: {model: plane-stress, youngs_modulus: 3.24 GPa, density: 1190 kg/m3, fracture_energy: 50 J/m2}
cracks: {precracks: [{from: [0 mm, $3 mm], to: [2 mm, $3 mm]}]}
loads:
  - {set: top, traction: [free, 6 MPa]}
  - {set: bottom, traction: [free, -6 MPa]}
solver: {end_time: 50 us}
output: {every: 50 us, folder: $1}
END
    for program in mesh nodes solve track; do
        "$build/kirsch-$program" "$1/case.yaml" || return
    done
}
value() { awk -F, -v name="$2" '$1 == name { print $2 }' "$work/$1/summary.csv"; }

runs() { deck "$work/up" 6.1 5.1 && [ "$(wc -l <"$work/up/branches.csv")" -gt 2 ]; }
# All that the broken bonds held is beside a branch or scattered, and the latter is little.
energy_is_shared() {
    awk -v a="$(value up crack_energy)" -v b="$(value up scattered_energy)" -v w="$(value up fracture_work)" \
        'BEGIN { off = (a + b) / w - 1; print a, b, w; exit !(off < 1e-6 && off > -1e-6 && b < 0.05 * w) }'
}
# Energy over G0 is the length of a crack of the classical theory. Rough, fast cracks break more than one layer
# of bonds: at five cells a millimetre more than at the paper's 25 (there 2.0). Within a factor of 4.
length_fits_energy() {
    awk -v l="$(value up crack_length)" -v a="$(value up crack_energy)" \
        'BEGIN { ratio = a / 50 / l; print "# figure energy over G0 and length: " ratio; exit !(ratio > 1 && ratio < 4) }'
}
# The same run with all nodes mirrored about the middle line and counted backwards.
mirror() {
    mkdir -p "$work/down" && cp -r "$work/up/." "$work/down" &&
        sed "s#$work/up#$work/down#" "$work/up/case.yaml" >"$work/down/case.yaml" &&
        /usr/bin/python3 -B - "$work/down" <<'END' &&
import sys, h5py
def turn(path, rows, indices=(), flip=None):
    with h5py.File(path, "a") as f:
        for name in rows:
            f[name][...] = f[name][:][::-1]
        for name in indices:
            f[name][...] = n - 1 - f[name][:]
        if flip:
            f[flip][:, 1] = 10e-3 - f[flip][:, 1]
with h5py.File(sys.argv[1] + "/plate.nodes.h5") as f:
    n, sets = len(f["nodes/volume"]), ["sets/" + s for s in f["sets"]]
turn(sys.argv[1] + "/plate.nodes.h5", [], sets)
turn(sys.argv[1] + "/run.h5", ["nodes/position", "nodes/volume"], flip="nodes/position")
turn(sys.argv[1] + "/run/crack.h5", ["Damage_Time"], ["bond"])
END
        "$build/kirsch-track" "$work/down/case.yaml"
}
# Kinds, times and places alike, y about the middle line; equal arms may have swapped their numbers.
mirrored() {
    mirror || return
    for side in up down; do
        awk -F, -v side=$side 'NR > 1 {
            y0 = $8 * 1e3; y1 = $10 * 1e3; if (side == "down") { y0 = 10 - y0; y1 = 10 - y1 }
            printf "%s %s %.3f %.3f %.3f %.3f %.3f %s\n", $3, $4, $5 * 1e6, $7 * 1e3, y0, y1, $11 * 1e3, $16 }' \
            "$work/$side/branches.csv" | sort >"$work/$side.txt"
    done
    cat "$work/up.txt"
    diff "$work/up.txt" "$work/down.txt"
}
track() { "$build/kirsch-track" "$work/up/case.yaml"; }
without_rims() {
    mv "$work/up/plate.nodes.h5" "$work/nodes"
    stops 0 'plate.nodes.h5 is missing: cracks that meet a hole' track
    result=$?
    mv "$work/nodes" "$work/up/plate.nodes.h5"
    return $result
}
cut_crack() {
    cp "$work/up/run/crack.h5" "$work/crack.h5"
    truncate -s 3000 "$work/up/run/crack.h5"
    stops 2 'crack' track
    result=$?
    cp "$work/crack.h5" "$work/up/run/crack.h5"
    return $result
}
one_snapshot() {
    rm -f "$work"/up/run/0*[1-9]*.h5
    stops 0 'branches' track
}

check runs_a_plate runs
check shares_the_energy energy_is_shared
check lengths_fit_the_energy length_fits_energy
check of_a_mirrored_plate_is_mirrored mirrored
check warns_without_rims without_rims
check tells_a_cut_crack_record cut_crack
check needs_no_snapshots one_snapshot
echo "1..$count"
