#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Memory: what --explain tells is what a run takes; too much is refused beforehand; each allocation that fails is told.
# ALLOCATIONS=0 makes every one of them fail in turn (minutes); else about so many for each program.
prefix=memory
. tests/cli/steps

# A plate (or, with `solid`, a block) large enough that its arrays outweigh the libraries.
write_large() { # plate or solid, dynamic or static
    if [ "$1" = solid ]; then
        shape='{width: 10 mm, height: 8 mm, depth: 6 mm, voids: [{centre: [5 mm, 4 mm, 3 mm], radius: 1.5 mm}]}'
        grid='{grid: near-boundary, spacing: 0.25 mm}' horizon=0.75 model=solid up='[free, 4 MPa, free]' down='[free, -4 MPa, free]'
        hold='[0 mm, 0 mm, 0 mm]' pull='[0 mm, 1 um, 0 mm]'
    else
        shape='{width: 60 mm, height: 40 mm, holes: [{centre: [20 mm, 20 mm], radius: 5 mm}]}'
        grid="{grid: $1, spacing: 0.2 mm}" horizon=0.6
        [ "$1" = voronoi ] && grid="{grid: voronoi, spacing: 0.1 mm}" # the least a node of all grids
        [ "$1" = free ] && grid="{grid: free, spacing: 0.5 mm}" horizon=1.5 # all of it by gmsh, whose process is the larger one
        model=plane-stress up='[free, 4 MPa]' down='[free, -4 MPa]'
        hold='[0 mm, 0 mm]' pull='[0 mm, 1 um]'
    fi
    cat >"$work/case.yaml" <<END
geometry: $shape
mesh: $grid
nodes: {horizon: $horizon mm}
material: {model: $model, youngs_modulus: 3.24 GPa, density: 1190 kg/m3, fracture_energy: 50 J/m2}
END
    if [ "$2" = static ]; then
        cat >>"$work/case.yaml" <<END
loads: [{set: top, displacement: $pull}, {set: bottom, displacement: $hold}]
stages: [{kind: static, tolerance: 1e-3}]
END
    else
        cat >>"$work/case.yaml" <<END
loads: [{set: top, traction: $up}, {set: bottom, traction: $down}]
solver: {end_time: 0.5 us}
output: {every: 0.25 us, history_every: 0.1 us}
END
    fi
}

# The peak that the system measured, in MiB.
peak_of() { # command...
    /usr/bin/python3 -c 'import os, subprocess, sys
child = subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL)
_, status, used = os.wait4(child.pid, 0)
print(used.ru_maxrss // 1024)
sys.exit(os.waitstatus_to_exitcode(status))' "$@"
}

estimate() { # shape, kind, programs
    write_large "$1" "$2" && into="$work/$1" && mkdir -p "$into" || return
    [ "$3" = mesh ] || [ -e "$into/plate.nodes.h5" ] || steps "$into" "mesh nodes" || return
    for program in ${3:-nodes solve}; do
        told=$("$build/kirsch-$program" --explain --output "$into" "$work/case.yaml" | sed -n 's/.*memory \([0-9]*\) MiB at.*/\1/p')
        taken=$(peak_of "$build/kirsch-$program" --output "$into" "$work/case.yaml") || return
        echo "# figure kirsch-$program, $1, $2: $told MiB told, $taken MiB taken"
        [ -n "$told" ] && [ "$taken" -gt 40 ] && [ $((10 * (told - taken))) -le "$taken" ] &&
            [ $((10 * (taken - told))) -le "$taken" ] || return
    done
}

# A mesh, and then nodes, that do not fit: told before they are there, so at once.
too_large() {
    write_large uniform dynamic
    for program in mesh nodes solve; do
        KIRSCH_MEMORY=2000 stops 6 'need .* GiB of memory at the least' "$build/kirsch-$program" \
            --set mesh.spacing='5 um' --set nodes.horizon='15 um' --output "$work/huge" "$work/case.yaml" || return
    done
    ! [ -e "$work/huge" ]
}

too_many_nodes() {
    write_large near-boundary dynamic && into="$work/near-boundary" && mkdir -p "$into" || return
    [ -e "$into/plate.nodes.h5" ] || steps "$into" "mesh nodes" || return
    KIRSCH_MEMORY=12 stops 6 'nodes need .* GiB of memory at the least' "$build/kirsch-solve" --output "$into" "$work/case.yaml"
}

# A small case for failing allocations: every N is a run of its own.
small() {
    [ -d "$work/small" ] && return
    cat >"$work/small.yaml" <<'END'
geometry: {width: 4 mm, height: 3 mm, holes: [{centre: [2 mm, 1.5 mm], radius: 0.6 mm}], pores: {count: 1, radius: [0.2 mm, 0.2 mm], edge_diameters: 1, seed: 1}}
mesh: {grid: near-boundary, spacing: 0.25 mm}
nodes: {horizon: 0.75 mm}
material: {law: pmb, model: plane-stress, youngs_modulus: 3 GPa, density: 1200 kg/m3, fracture_energy: 20 J/m2}
cracks: {precracks: [{from: [0 mm, 1.5 mm], to: [1 mm, 1.5 mm]}]}
stages:
  - {kind: static, loads: [{set: top, displacement: [0 mm, 0.1 um]}, {set: bottom, displacement: [0 mm, 0 mm]}]}
  - {kind: dynamic, end_time: 2 us, loads: [{set: top, velocity: [free, 20 m/s]}, {set: bottom, velocity: [free, -20 m/s]}]}
output: {every: 1 us, probes: [{name: p, quantity: stress, at: [1 mm, 1 mm]}]}
END
    mkdir -p "$work/small/pores"
    for pair in pores:mesh mesh:nodes nodes:solve solve:track; do
        cp -r "$work/small/${pair%:*}" "$work/small/${pair#*:}" &&
            "$build/kirsch-${pair%:*}" --output "$work/small/${pair#*:}" "$work/small.yaml" || return
    done
}

failing() { # program
    small >"$work/small.log" 2>&1 || { cat "$work/small.log"; return 1; }
    /usr/bin/python3 tests/cli/allocations.py "${ALLOCATIONS:-25}" "$work/small/$1" "$build/kirsch-$1" --output '{}' "$work/small.yaml"
}

check estimate_of_a_plate estimate near-boundary dynamic
check estimate_at_rest estimate near-boundary static
check estimate_of_a_block estimate solid dynamic
check estimate_of_a_block_at_rest estimate solid static
check estimate_of_a_mesh estimate near-boundary dynamic mesh
check estimate_of_a_mesh_by_voronoi estimate voronoi dynamic mesh
check estimate_of_a_mesh_of_a_block estimate solid dynamic mesh
check estimate_of_a_mesh_by_gmsh estimate free dynamic mesh
check too_large_is_refused too_large
check too_many_nodes_are_refused too_many_nodes
for program in pores mesh nodes solve track; do check "each_allocation_fails_in_$program" failing $program; done
echo "1..$count"
