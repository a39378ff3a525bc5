#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A run that is killed, stopped and resumed leaves the bytes of a run that was not, with any number of
# threads, in motion and at rest, in plates and in solids (all three stages: stages.sh); a checkpoint that does not fit
# is refused. Steps are small and many, so that there is time for 20 kills.
prefix=restart
. tests/cli/steps
often='solver.checkpoint_every=20 ms'

# A plate with two holes that cracks, in time.
write_plate() {
    write_case
    slow='solver.time_step=2 ns'
}

# The same, pulled apart in load steps.
write_static() {
    write_case
    sed -i '/^loads:/,$d' "$work/case.yaml"
    cat >>"$work/case.yaml" <<'END'
no_fail: [top, bottom]
stages:
  - kind: static
    loads: [{set: top, displacement: [0 mm, 0.002*t mm]}, {set: bottom, displacement: [0 mm, 0 mm]}]
    steps: [{count: 40, size: 0.4 s}]
    end_below: 0
END
    slow=output.every_steps=5
}

# A block with a void, in time.
write_solid() {
    cat >"$work/case.yaml" <<'END'
geometry: {width: 8 mm, height: 6 mm, depth: 3 mm, voids: [{centre: [5 mm, 3 mm, 1.5 mm], radius: 0.8 mm}]}
mesh: {grid: uniform, spacing: 0.5 mm}
nodes: {horizon: 1.5 mm}
material: {model: solid, youngs_modulus: 3.24 GPa, density: 1190 kg/m3, fracture_energy: 50 J/m2}
cracks: {precracks: [{polygon: [[0 mm, 3 mm, 0 mm], [2 mm, 3 mm, 0 mm], [2 mm, 3 mm, 3 mm], [0 mm, 3 mm, 3 mm]]}]}
no_fail: [top, bottom]
output: {every: 4 us, history_every: 1 us}
END
    cp "$work/case.yaml" "$work/block.yaml"
    cat >>"$work/case.yaml" <<'END'
loads: [{set: top, traction: [free, 12 MPa, free]}, {set: bottom, traction: [free, -12 MPa, free]}]
solver: {end_time: 16 us}
END
    slow='solver.time_step=4 ns'
}

# A block at rest under growing loads, then in time.
write_staged() {
    write_solid
    cp "$work/block.yaml" "$work/case.yaml"
    cat >>"$work/case.yaml" <<'END'
stages:
  - kind: static
    loads: [{set: top, displacement: [0 mm, 0.002*t mm, 0 mm]}, {set: bottom, displacement: [0 mm, 0 mm, 0 mm]}]
    steps: [{count: 20, size: 0.5 s}]
    end_below: 0
  - kind: dynamic
    loads: [{set: top, velocity: [0 m/s, 5 m/s, 0 m/s]}, {set: bottom, velocity: [0 m/s, 0 m/s, 0 m/s]}]
    end_time: 8 us
END
}

# The case of a kind, and its undisturbed run, in the folder that all runs use in turn: its name is in the files.
whole() { # kind
    kind=$1
    write_"$kind"
    [ -d "$work/whole-$kind" ] && return
    rm -rf "$work/now"
    steps "$work/now" "mesh nodes solve" --set "$often" --set "$slow" && mv "$work/now" "$work/whole-$kind"
}

begin() { # kind
    whole "${1:-plate}" && rm -rf "$work/now" && mkdir "$work/now" && cp "$work/whole-$kind/plate.nodes.h5" "$work/now/"
}

# Run kirsch-solve in the background, resumed if there is a checkpoint, with 1 or 2 threads in turn.
go_on() {
    resume=
    [ -e "$work/now/checkpoint.h5" ] && resume=--resume
    threads=$((3 - ${threads:-1}))
    OMP_NUM_THREADS=$threads "$build/kirsch-solve" $resume --set "$often" --set "$slow" --output "$work/now" \
        "$work/case.yaml" >"$work/solve.log" 2>&1 &
    child=$!
}

equal() {
    for file in history.csv run.h5 run.xdmf; do
        cmp "$work/now/$file" "$work/whole-$kind/$file" || return
    done
    diff -r "$work/now/run" "$work/whole-$kind/run"
}

# Wait until the run has left another checkpoint than it began with, or has ended.
moved_on() {
    now=$work/now/checkpoint.h5
    until [ -e "$now" ] && [ "$(stat -c %i "$now")" != "$inode" ]; do
        kill -0 $child 2>/dev/null || return
        sleep 0.02
    done
}

# kill -9 at moments that no seed repeats; what is tested is that none of them matters. Every other run is given the
# time to get on, however slow the machine; the others may die before they have begun.
killed() { # kind
    begin "$1" || return
    kills=0
    resumed=0
    while [ $kills -lt 20 ]; do
        inode=$(stat -c %i "$work/now/checkpoint.h5" 2>/dev/null)
        go_on
        [ "$resume" ] && resumed=$((resumed + 1))
        [ $((kills % 2)) -eq 0 ] && moved_on
        sleep "0.$(od -An -N1 -tu1 /dev/urandom | awk '{ printf "%03d", 40 + $1 % 110 }')"
        kill -9 $child 2>/dev/null || break
        wait $child 2>/dev/null
        kills=$((kills + 1))
    done
    [ $kills -eq 20 ] || { echo "done after $kills kills"; return 1; }
    go_on
    wait $child || { cat "$work/solve.log"; return 1; }
    broken=$(tail -n 1 "$work/now/history.csv" | cut -d, -f8)
    echo "# figure $kind: killed $kills times, $resumed times resumed, $broken bonds broken, then equal byte by byte"
    [ "$broken" -gt 20 ] && [ $resumed -ge 10 ] && equal
}

# SIGTERM leaves a checkpoint, says how to go on and ends with 7.
terminated() {
    begin || return
    go_on
    until [ -e "$work/now/checkpoint.h5" ]; do sleep 0.02; done
    kill -TERM $child
    wait $child
    code=$?
    cat "$work/solve.log"
    [ $code -eq 7 ] && grep -q -- "--resume" "$work/solve.log" || return
    go_on
    wait $child && equal
}

# SIGUSR1 leaves a checkpoint, and the run goes on.
asked() {
    begin || return
    OMP_NUM_THREADS=1 "$build/kirsch-solve" --set 'solver.checkpoint_every=0 s' --set "$slow" --output "$work/now" \
        "$work/case.yaml" >"$work/solve.log" 2>&1 &
    child=$!
    until [ -e "$work/now/run/000000.h5" ]; do sleep 0.02; done
    [ -e "$work/now/checkpoint.h5" ] && return 1
    kill -USR1 $child
    until [ -e "$work/now/checkpoint.h5" ]; do kill -0 $child || return; sleep 0.02; done
    wait $child && cmp "$work/now/history.csv" "$work/whole-plate/history.csv" && diff -r "$work/now/run" "$work/whole-plate/run"
}

# By steps: the one that is left stands at the last multiple, and the run goes on from it to the same bytes.
by_steps() {
    begin || return
    rarely='solver.checkpoint_every=0 s'
    OMP_NUM_THREADS=1 "$build/kirsch-solve" --set "$rarely" --set solver.checkpoint_steps=1700 --set "$slow" --output "$work/now" \
        "$work/case.yaml" >"$work/solve.log" 2>&1 &
    child=$!
    until [ -e "$work/now/checkpoint.h5" ]; do kill -0 $child || return; sleep 0.02; done
    kill -9 $child
    wait $child 2>/dev/null
    step=$(/usr/bin/python3 -c 'import h5py, sys; print(int(h5py.File(sys.argv[1]).attrs["step"]))' "$work/now/checkpoint.h5")
    [ "$((step % 1700))" -eq 0 ] && [ "$step" -gt 0 ] || { echo "stands at step $step"; return 1; }
    "$build/kirsch-solve" --resume --set "$rarely" --set solver.checkpoint_steps=1700 --set "$slow" --output "$work/now" \
        "$work/case.yaml" && cmp "$work/now/history.csv" "$work/whole-plate/history.csv" &&
        diff -r "$work/now/run" "$work/whole-plate/run"
}

# A run that is killed as soon as there is a checkpoint: what went before does not matter.
left_one() {
    write_plate && rm -rf "$work/now" && steps "$work/now" "mesh nodes" || return
    go_on
    until [ -e "$work/now/checkpoint.h5" ]; do kill -0 $child || return; sleep 0.02; done
    kill -9 $child
    wait $child 2>/dev/null || :
}

# A checkpoint of another deck is refused, and the key that differs is named.
other_deck() {
    left_one || return
    stops 2 "material.fracture_energy" "$build/kirsch-solve" --resume --set "$often" --set "$slow" \
        --set "material.fracture_energy=60 J/m2" --output "$work/now" "$work/case.yaml"
}

# Nodes of the same number, one of them elsewhere by a billionth.
other_nodes() {
    left_one || return
    /usr/bin/python3 -c "import h5py, sys; h5py.File(sys.argv[1], 'r+')['nodes/position'][7, 0] *= 1 + 1e-9" \
        "$work/now/plate.nodes.h5" || return
    stops 2 "made with other nodes" "$build/kirsch-solve" --resume --set "$often" --set "$slow" --output "$work/now" "$work/case.yaml"
}

none() {
    begin || return
    stops 2 "no checkpoint" "$build/kirsch-solve" --resume --set "$often" --set "$slow" --output "$work/now" \
        "$work/case.yaml"
}

for kind in plate static solid staged; do check "${kind}_after_kills_is_equal" killed $kind; done
check after_a_signal_is_equal terminated
check leaves_a_checkpoint_when_asked asked
check by_steps by_steps
check refuses_another_deck other_deck
check refuses_other_nodes other_nodes
check needs_a_checkpoint none
echo "1..$count"
