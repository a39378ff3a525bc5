#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What kirsch-solve cannot do it says, with the exit code of its kind (docs/formats.md).
prefix=errors
. tests/cli/steps
write_case

# The nodes are made once; then one thing is wrong.
solve() { # option...
    [ -f "$work/plate/plate.nodes.h5" ] || steps "$work/plate" "mesh nodes" || return
    "$build/kirsch-solve" --output "$work/plate" "$@" "$work/case.yaml"
}

no_nodes() {
    stops 2 "plate.nodes.h5" "$build/kirsch-solve" --output "$work/empty" "$work/case.yaml"
}

cut_nodes() { # bytes kept
    solve --set solver.end_time='5 us' || return
    mkdir -p "$work/cut"
    head -c "$1" "$work/plate/plate.nodes.h5" >"$work/cut/plate.nodes.h5"
    stops 2 "plate.nodes.h5" "$build/kirsch-solve" --output "$work/cut" "$work/case.yaml"
}

# A results file in the place of the nodes.
other_file() {
    solve --set solver.end_time='5 us' || return
    mkdir -p "$work/other"
    cp "$work/plate/run.h5" "$work/other/plate.nodes.h5"
    stops 2 "kirsch run" "$build/kirsch-solve" --output "$work/other" "$work/case.yaml"
}

# One array of the node file replaced by what Python makes of it.
changed_nodes() { # words, Python statement about `file`
    solve --set solver.end_time='5 us' || return
    mkdir -p "$work/changed"
    cp "$work/plate/plate.nodes.h5" "$work/changed/"
    /usr/bin/python3 -c "import h5py, sys; file = h5py.File(sys.argv[1], 'r+'); $2" "$work/changed/plate.nodes.h5" || return
    stops 2 "$1" "$build/kirsch-solve" --output "$work/changed" "$work/case.yaml"
}

# A bit changed where a file says in which place its kind stands: HDF5 reads from there, whatever is there or not.
place_of_a_text() {
    [ -f "$work/plate/plate.nodes.h5" ] || steps "$work/plate" "mesh nodes" || return
    file=$work/place/plate.nodes.h5
    mkdir -p "$work/place" && cp "$work/plate/plate.nodes.h5" "$file" || return
    begins=$(grep -abo 'format' "$file" | head -n 1 | cut -d: -f1)
    refused=0
    for at in $(seq $((begins + 40)) $((begins + 55))); do # length, address and number of the text
        byte=$(od -An -tu1 -j "$at" -N 1 "$work/plate/plate.nodes.h5")
        cp "$work/plate/plate.nodes.h5" "$file"
        printf "\\$(printf %03o $((byte ^ 32)))" | dd of="$file" bs=1 seek="$at" conv=notrunc 2>/dev/null
        "$build/kirsch-solve" --explain --output "$work/place" "$work/case.yaml" >"$work/stop" 2>&1
        code=$?
        [ $code -eq 0 ] && continue
        refused=$((refused + 1))
        grep plate.nodes.h5 "$work/stop" && [ $code -eq 2 ] || { echo "ended with $code, byte $at"; return 1; }
    done
    [ $refused -gt 4 ]
}

# A solid for kirsch, which is told before the mesh is made what no mesh can mend.
solid() { # depth or nothing, option...
    mkdir -p "$work/solid"
    cat >"$work/solid/case.yaml" <<END
geometry: {width: 4 mm, height: 3 mm$1}
mesh: {spacing: 0.5 mm}
nodes: {horizon: 1.5 mm}
material: {model: solid, youngs_modulus: 3 GPa, density: 1200 kg/m3}
loads: [{set: top, traction: [free, 1 MPa, free]}]
solver: {end_time: 1 us}
END
    shift
    "$build/kirsch" --output "$work/solid" "$@" "$work/solid/case.yaml"
}
tells_its_size() { solid ', depth: 2 mm' --explain | grep -q '^at most about 192 nodes'; }

check solid_without_depth stops 2 "geometry.depth: missing; material.model is solid" solid ''
check table_that_is_not_there stops 2 "loads.0.table.file: .*/none.csv cannot be read" \
    solid ', depth: 2 mm' --set loads.0.table.file=none.csv
check solid_tells_its_size tells_its_size
check no_node_file no_nodes
check empty_node_file cut_nodes 0
check node_file_cut_in_its_head cut_nodes 700
check node_file_cut_in_its_data cut_nodes 20000
# Both found by the fuzzer: a place far beyond the end between good ones, and an array of a million millions.
check cell_that_begins_beyond_the_end changed_nodes "expected ascending places" "file['cells/first'][7] = 2**39"
check array_larger_than_the_file changed_nodes "more numbers than the file can hold" \
    "del file['sets/top']; file.create_dataset('sets/top', shape=(10**12,), dtype='i8', chunks=(1000,))"
check results_as_node_file other_file
check place_of_a_text_that_is_damaged place_of_a_text
check nodes_of_another_horizon stops 2 "made for 0.0015 m; run kirsch-nodes again" \
    solve --set nodes.horizon='1.6 mm'
check nodes_of_another_model stops 2 "made for 'plane-stress'" solve --set material.model=plane-strain
check nodes_of_another_weight stops 2 "made for 'exact-centroid'" solve --set nodes.partial_volume=none
check nodes_of_another_deformation stops 2 "made for 'mean-over-axes'" \
    solve --set nodes.surface_deformation=isotropic
# Where the mesh follows from the deck, a name that it cannot have is told before it is made.
early() { # words, option of the deck, program, option...
    words=$1
    set_to=$2
    program=$3
    shift 3
    stops 2 "$words" "$build/$program" "$@" --output "$work/early" --set "$set_to" "$work/case.yaml" &&
        [ ! -e "$work/early/plate.msh" ]
}
near="command line: loads.0.set: no set is called 'tpo'; did you mean 'top'? There are top, left, right, bottom"
misfit="mesh.spacing: found 0.37 mm, .* the nearest that fit are 0.3636"
check unknown_set_in_a_check early "$near" loads.0.set=tpo kirsch --check
check unknown_set_before_all_steps early "$near" loads.0.set=tpo kirsch
check unknown_set_before_the_mesh early "$near" loads.0.set=tpo kirsch-mesh
check squares_that_do_not_fit_in_a_check early "$misfit" mesh.spacing='0.37 mm' kirsch --check
check squares_that_do_not_fit_before_the_mesh early "$misfit" mesh.spacing='0.37 mm' kirsch-mesh
check unknown_set stops 2 "no set is called 'upper'; there are" solve --set loads.0.set=upper
check unknown_no_fail_set stops 2 "no set is called 'rim'" solve --set no_fail.0=rim
check traction_on_an_area stops 2 "belongs to no boundary" solve --set loads.0.set=plate
check time_step_above_the_stable_one stops 2 "are unstable" solve --set solver.time_step='0.9 us'
check load_not_a_number stops 4 "the load on set 'top' is" \
    solve --set loads.0.traction='[free, 1e6*sqrt(-1-t) Pa]'
check load_infinite_in_one_place stops 4 "the load on set 'top' is" \
    solve --set loads.0.traction='[free, 1e6/(x-x) Pa]'
check folder_that_is_a_file stops 3 "no folder" \
    "$build/kirsch-solve" --output "$work/case.yaml" "$work/case.yaml"
# kirsch tells a warning of the deck, and no step tells it again; a step alone does.
warns() { # times, program, option...
    times=$1
    program=$2
    shift 2
    "$build/$program" --output "$work/warned" --set nodes.horizon='1.2 mm' --set solver.end_time='5 us' \
        "$@" "$work/case.yaml" >"$work/told" 2>&1 || return
    grep 'nodes.horizon: 2.4 spacings' "$work/told"
    [ "$(grep -c 'nodes.horizon: 2.4 spacings' "$work/told")" -eq "$times" ]
}
warned_once() {
    warns 1 kirsch && grep -q '^kirsch-track$' "$work/told" && warns 1 kirsch && warns 1 kirsch --explain &&
        warns 1 kirsch-track && KIRSCH_WARNED=1 warns 1 kirsch-track
}
check a_warning_of_the_deck_once_a_run warned_once
echo "1..$count"
