#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What a static run refuses, word by word, with the cure; a solid in stages that is killed; load steps of
# three sizes.
prefix=statics
. tests/cli/steps

cat >"$work/case.yaml" <<'END'
geometry: {width: 12 mm, height: 10 mm}
mesh: {grid: uniform, spacing: 0.5 mm}
nodes: {horizon: 1.5 mm, surface_correction: none, sets: {up: {within: 1.5 mm, of: top}, down: {within: 1.5 mm, of: bottom}}}
material: {model: plane-stress, youngs_modulus: 3.24 GPa, density: 1190 kg/m3, fracture_energy: 50 J/m2}
loads:
  - {set: up, displacement: [0 mm, 0.01*t mm]}
  - {set: down, displacement: [0 mm, 0 mm]}
stages: [{kind: static, tolerance: 1e-6}]
END

# kirsch-solve, on nodes of the wrong deck where these can be made, else on those of the right one.
solve_wrong() { # sed command
    sed "$1" "$work/case.yaml" >"$work/wrong.yaml"
    rm -rf "$work/wrong" && mkdir "$work/wrong"
    "$build/kirsch-mesh" --output "$work/wrong" "$work/case.yaml" >/dev/null 2>&1
    "$build/kirsch-nodes" --output "$work/wrong" "$work/wrong.yaml" >/dev/null 2>&1 ||
        "$build/kirsch-nodes" --output "$work/wrong" "$work/case.yaml" >/dev/null 2>&1
    "$build/kirsch-solve" --output "$work/wrong" "$work/wrong.yaml"
}

# It ends with this code and says just this sentence, after the place in the deck or the program's name.
refused() { # code, sentence, sed command
    solve_wrong "$3" >"$work/stop" 2>&1
    code=$?
    cat "$work/stop"
    [ $code -eq "$1" ] && sed 's/^.*wrong.yaml:[0-9]*:[0-9]*: //; s/^kirsch-solve: //' "$work/stop" | grep -qxF "$2"
}

free='stage 1 is static, but nothing keeps the body (the piece with the node at 0.00025,'
hold='; hold it by a load such as {set: bottom, displacement: [free, 0 mm]}'
check no_constraint refused 2 \
    'stages.0.kind: nothing holds the body in this static stage; prescribe a displacement of some set, such as [free, 0 mm]' \
    's/set: up, displacement: \[0 mm, 0.01\*t mm\]/set: top, traction: [free, 1 MPa]/; /set: down/d'
check slides_along_x refused 2 "$free 0.00025 m) from moving along x$hold" 's/\[0 mm, /[free, /'
check turns refused 2 "$free 0.00025 m) from turning in its plane$hold" \
    '/set: down/d; s/up: {[^}]*}/up: {lower: [0 mm, 9.5 mm], upper: [0.5 mm, 10 mm]}/'
check a_cut_off_piece_slides refused 2 "$free 0.00525 m) from moving along x$hold" \
    '$a cracks: {precracks: [{from: [0 mm, 5 mm], to: [12 mm, 5 mm]}]}
     s/set: up, displacement: \[0 mm, 0.01\*t mm\]/set: top, traction: [free, 1 MPa]/'
check contradictory_constraints refused 2 \
    "loads.1.set: sets 'up' and 'up' share nodes, such as the one at (0.25, 8.75) mm, and both prescribe the same component; leave it 'free' in one of them" \
    's/set: down/set: up/'
check missing_set refused 2 "loads.1.set: no set is called 'none'; there are bottom, down, left, plate, right, top, up" \
    's/set: down/set: none/'
check load_that_is_no_number refused 4 \
    "the load on set 'up' is nan at x = 0, y = 0 m, t = 1 s; expected a finite number: look for a division by zero or a root of a negative number" \
    's/0.01\*t/0.01*sqrt(-t)/'
check constant_that_is_no_number refused 2 "loads.0.displacement.1: found 'log(-1) mm': its value is not finite" \
    's/0.01\*t/log(-1)/'
check critical_stretch_below_zero refused 2 \
    "material.fracture_energy: found '-50 J/m2', expected at least 0 J/m^2" 's/: 50 J/: -50 J/'
check other_poissons_ratio refused 2 \
    'material.poissons_ratio: found 0.35, but bonds make it 0.3333 in this model; leave it out, and compare with others at that value' \
    's/density:/poissons_ratio: 0.35, &/'
check set_that_moves refused 2 \
    "nodes.sets.up.lower.1: found '10 - t mm', a formula; expected a length, such as '10 mm'. Only loads and initial fields may be formulas; sets are fixed when the nodes are made, and no load can move to other nodes" \
    's/up: {[^}]*}/up: {lower: [0 mm, 10 - t mm], upper: [12 mm, 10 mm]}/'

# A set in which no node lies is refused by kirsch-nodes.
no_node() {
    sed 's/sets: {/&none: {lower: [20 mm, 0 mm], upper: [21 mm, 1 mm]}, /; s/set: down/set: none/' \
        "$work/case.yaml" >"$work/wrong.yaml"
    mkdir -p "$work/wrong" && "$build/kirsch-mesh" --output "$work/wrong" "$work/case.yaml" || return
    stops 2 "nodes.sets.none: set 'none' has no node in it; the spacing is 0.0005 m" \
        "$build/kirsch-nodes" --output "$work/wrong" "$work/wrong.yaml"
}
check set_without_a_node no_node

# Nodes that stand on a pre-crack are told; the rest finds its equilibrium.
on_the_crack() {
    solve_wrong '$a cracks: {precracks: [{from: [0 mm, 2.75 mm], to: [3 mm, 2.75 mm]}]}' >"$work/stop" 2>&1 || return
    cat "$work/stop"
    grep -qxF 'kirsch-solve: warning: 6 nodes stand on a pre-crack and have lost all their bonds, such as the one at (0.25, 2.75) mm; put the crack between two rows of nodes, half a spacing beside' "$work/stop" &&
        grep -q 'load step 1, .* 0 bonds broken' "$work/stop"
}
check nodes_on_a_crack on_the_crack

# A notched block is torn in load steps and pulled on in time. Killed at any moment, it ends with the same bytes.
write_solid() {
    cat >"$work/solid.yaml" <<'END'
geometry: {width: 6 mm, height: 5 mm, depth: 4 mm, voids: [{centre: [3.5 mm, 2.5 mm, 2 mm], radius: 0.8 mm}]}
mesh: {grid: voronoi, spacing: 0.5 mm}
nodes: {horizon: 1.25 mm, surface_correction: none, sets: {up: {within: 1 mm, of: top}, down: {within: 1 mm, of: bottom}}}
material: {model: solid, youngs_modulus: 3.24 GPa, density: 1190 kg/m3, fracture_energy: 50 J/m2}
cracks: {precracks: [{polygon: [[-1 mm, 2.6 mm, -1 mm], [1.6 mm, 2.6 mm, -1 mm], [1.6 mm, 2.6 mm, 5 mm], [-1 mm, 2.6 mm, 5 mm]]}]}
no_fail: [up, down]
solver: {checkpoint_every: 20 ms}
output: {every: 2 us, history_every: 0.5 us}
stages:
  - kind: static
    loads:
      - {set: up, displacement: [0 mm, 0.01*t mm, 0 mm]}
      - {set: down, displacement: [0 mm, 0 mm, 0 mm]}
    steps: [{count: 4, size: 1 s}, {count: 3, size: 0.3 s}]
    end_below: 0
  - kind: dynamic
    loads:
      - {set: up, velocity: [0 m/s, 5 m/s, 0 m/s]}
      - {set: down, velocity: [0 m/s, 0 m/s, 0 m/s]}
    end_time: 8 us
END
}

solid_killed() {
    write_solid
    mkdir -p "$work/now"
    for program in mesh nodes solve; do # results tell their folder: so both are made in one
        OMP_NUM_THREADS=1 "$build/kirsch-$program" --output "$work/now" "$work/solid.yaml" || return
    done
    mv "$work/now" "$work/whole" && mkdir "$work/now"
    cp "$work/whole/plate.nodes.h5" "$work/now/"
    kills=0
    while [ $kills -lt 10 ]; do
        resume=
        [ -e "$work/now/checkpoint.h5" ] && resume=--resume
        OMP_NUM_THREADS=2 "$build/kirsch-solve" $resume --output "$work/now" "$work/solid.yaml" >"$work/solve.log" 2>&1 &
        child=$!
        sleep "0.$(od -An -N1 -tu1 /dev/urandom | awk '{ printf "%03d", 150 + $1 * 3 }')"
        kill -9 $child 2>/dev/null || break
        wait $child 2>/dev/null
        kills=$((kills + 1))
    done
    wait $child 2>/dev/null
    resume=
    [ -e "$work/now/checkpoint.h5" ] && resume=--resume
    [ $kills -lt 10 ] || "$build/kirsch-solve" $resume --output "$work/now" "$work/solid.yaml" || return
    broken=$(tail -n 1 "$work/whole/history.csv" | cut -d, -f8)
    echo "# figure a block in two stages: $broken bonds broken, killed $kills times, then equal byte by byte"
    for file in history.csv sites.csv run.h5 run.xdmf; do
        cmp "$work/now/$file" "$work/whole/$file" || return
    done
    diff -r "$work/now/run" "$work/whole/run" && [ $kills -gt 1 ] && [ "$broken" -gt 50 ]
}
check solid_in_stages_after_kills_is_equal solid_killed

# Section 4.2 of the plates paper, coarse: large load steps, then small ones of three sizes. The first bond breaks
# at the same displacement, to one of the largest of these.
first_of() { # size of the small steps [s of the clock, 0.01 mm each]
    mkdir -p "$work/hole" && cat >"$work/hole.yaml" <<END
geometry: {width: 20 mm, height: 20 mm, holes: [{centre: [10 mm, 10 mm], radius: 4 mm}]}
mesh: {grid: near-boundary, spacing: 0.5 mm}
nodes: {horizon: 1.5 mm, sets: {middle: {lower: [0 mm, 10 mm], upper: [0.5 mm, 10.5 mm]}}}
material: {model: plane-stress, youngs_modulus: 3.24 GPa, density: 1190 kg/m3, fracture_energy: 200 J/m2}
no_fail: [left, right]
stages:
  - kind: static
    loads:
      - {set: left, displacement: [-0.01*t mm, free]}
      - {set: right, displacement: [0.01*t mm, free]}
      - {set: middle, displacement: [free, 0 mm]}
    steps: [{count: 8, size: 0.4 s}, {count: 2000, size: $1 s}]
    end_below: 0.9999
END
    for program in mesh nodes; do
        [ -e "$work/hole/plate.nodes.h5" ] || "$build/kirsch-$program" --output "$work/hole" "$work/hole.yaml" >&2 || return
    done
    "$build/kirsch-solve" --output "$work/hole" "$work/hole.yaml" >&2 &&
        /usr/bin/python3 -c 'import csv, sys; print(next(csv.DictReader(open(sys.argv[1])))["stage_time [s]"])' \
            "$work/hole/sites.csv"
}

steps_of_three_sizes() {
    large=$(first_of 0.04) && middle=$(first_of 0.02) && small=$(first_of 0.005) || return
    echo "# figure first bond broken at $large, $middle and $small s of the clock, by steps of 0.04, 0.02 and 0.005 s"
    echo "$large $middle $small" | awk '{ exit !($1 >= $2 && $2 >= $3 && $3 > $1 - 0.0401 && $3 > 3.2) }'
}
check first_crack_is_the_same_for_all_load_steps steps_of_three_sizes

# An intact body goes on as it went in the load step before, so most steps cost nothing; where the load turns round it
# does not, and is found anew in two steps. Either way it ends where one step of the whole load does.
ends_as_at_once() { # load that ends at 5 s where it would in one step, number of steps that may cost products
    rm -rf "$work/slow" && mkdir "$work/slow" && solve_wrong "s/0.01\\*t/0.01*($1)/; s/tolerance: 1e-6/&, breaks: false, steps: [{count: 5, size: 1 s}]/" \
        >"$work/slow.log" 2>&1 && cp -r "$work/wrong/run" "$work/slow/" &&
        solve_wrong "s/0.01\\*t/0.01*($1)/; s/tolerance: 1e-6/&, breaks: false, steps: [{count: 1, size: 5 s}]/" >"$work/once.log" 2>&1
    cat "$work/slow.log" "$work/once.log"
    costly=$(grep -c 'load step.*after [1-9][0-9]* products' "$work/slow.log")
    [ "$costly" -eq "$2" ] || { echo "$costly load steps cost products, expected $2"; return 1; }
    /usr/bin/python3 - "$work" <<'END'
import glob, sys, h5py, numpy
slow, once = (h5py.File(sorted(glob.glob(f"{sys.argv[1]}/{name}/run/0*.h5"))[-1])["Displacement"][:] for name in ("slow", "wrong"))
off = abs(slow - once).max() / abs(once).max()
print(f"# figure five load steps end {off:.1e} of the displacement off one")
sys.exit(not 0 < abs(once).max() or not off < 1e-5)  # residuals of 1e-6, and long waves a little softer
END
}
check load_steps_go_on_as_before ends_as_at_once '0.0001*t' 1
check load_that_turns_round_is_found_anew ends_as_at_once '0.0001*(3 - abs(t - 3))' 3
echo "1..$count"
