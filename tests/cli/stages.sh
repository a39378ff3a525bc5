#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Static, relaxing and dynamic stages in one run: the same bytes for any number of threads, and after
# kills and signals at any moment; a staged dynamic run is the plain one; what cannot be is refused.
prefix=stages
. tests/cli/steps

# A plate with a hole that is stretched until it tears, then pulled on in time.
write_stages() {
    cat >"$work/case.yaml" <<'END'
geometry:
  width: 24 mm
  height: 16 mm
  holes:
    - {centre: [9 mm, 7 mm], radius: 2 mm}
mesh: {grid: near-boundary, spacing: 0.5 mm}
nodes: {horizon: 1.5 mm, sets: {up: {within: 1.5 mm, of: top}, down: {within: 1.5 mm, of: bottom}}}
material: {model: plane-stress, youngs_modulus: 3.24 GPa, density: 1190 kg/m3, fracture_energy: 50 J/m2}
cracks: {precracks: [{from: [0 mm, 8 mm], to: [4 mm, 8 mm]}]}
no_fail: [up, down]
solver: {checkpoint_every: 50 ms}
output: {every: 5 us, history_every: 1 us}
stages:
  - kind: static
    loads:
      - {set: up, displacement: [0 mm, 0.01*t mm]}
      - {set: down, displacement: [0 mm, 0 mm]}
    steps: [{count: 3, size: 1 s}, {count: 4, size: 0.25 s}]
    end_below: 0
  - kind: relaxation
    loads:
      - {set: up, displacement: [0 mm, 0.04 mm]}
      - {set: down, displacement: [0 mm, 0 mm]}
    end_time: 30 us
    tolerance: 0.05
  - kind: dynamic
    loads:
      - {set: up, velocity: [0 m/s, 5 m/s]}
      - {set: down, velocity: [0 m/s, 0 m/s]}
    end_time: 20 us
END
}
write_stages

whole() {
    [ -d "$work/whole" ] && return
    OMP_NUM_THREADS=1 steps "$work/now" "mesh nodes solve" && mv "$work/now" "$work/whole"
}

begin() {
    whole && rm -rf "$work/now" && mkdir "$work/now" && cp "$work/whole/plate.nodes.h5" "$work/now/"
}

go_on() {
    resume=
    [ -e "$work/now/checkpoint.h5" ] && resume=--resume
    threads=$((3 - ${threads:-1}))
    OMP_NUM_THREADS=$threads "$build/kirsch-solve" $resume --output "$work/now" "$work/case.yaml" \
        >"$work/solve.log" 2>&1 &
    child=$!
}

equal() {
    for file in history.csv sites.csv run.h5 run.xdmf; do
        cmp "$work/now/$file" "$work/whole/$file" || return
    done
    diff -r "$work/now/run" "$work/whole/run"
}

two_threads() {
    begin && OMP_NUM_THREADS=2 steps "$work/now" solve && equal || return
    broken=$(tail -n 1 "$work/whole/history.csv" | cut -d, -f8)
    echo "# figure $broken bonds broke in three stages"
    [ "$broken" -gt 50 ]
}

# kill -9 at moments that no seed repeats; what is tested is that none of them matters.
killed() {
    begin || return
    kills=0
    while [ $kills -lt 12 ]; do
        go_on
        sleep "0.$(od -An -N1 -tu1 /dev/urandom | awk '{ printf "%03d", 100 + $1 * 2 }')"
        kill -9 $child 2>/dev/null || break
        wait $child 2>/dev/null
        kills=$((kills + 1))
    done
    go_on
    wait $child || { cat "$work/solve.log"; return 1; }
    echo "# figure killed $kills times, then equal byte by byte"
    [ $kills -gt 2 ] && equal
}

# SIGINT in the middle of an equilibrium leaves a checkpoint and ends with 7.
interrupted() {
    begin || return
    go_on
    sleep 0.3
    kill -INT $child
    wait $child
    code=$?
    cat "$work/solve.log"
    [ $code -eq 7 ] && [ -e "$work/now/checkpoint.h5" ] || return
    go_on
    wait $child && equal
}

# Two dynamic stages one after the other under the same loads are the one run, but for rounding: the
# velocities change from half steps to whole ones and back.
split() {
    begin || return
    common="--set output.history_every=1us --set output.every=100us"
    cat >"$work/loads" <<'END'
loads:
  - {set: up, velocity: [0 m/s, 5 m/s]}
  - {set: down, velocity: [0 m/s, 0 m/s]}
END
    sed '/^stages:/,$d; /^output:/d' "$work/case.yaml" | sed '/^solver/d' | cat - "$work/loads" >"$work/base"
    { cat "$work/base"; echo 'solver: {end_time: 20 us, time_step: 0.1 us}'; } >"$work/one.yaml"
    { cat "$work/base"; echo 'solver: {time_step: 0.1 us}'
      echo 'stages: [{kind: dynamic, end_time: 8 us}, {kind: dynamic, end_time: 12 us}]'; } >"$work/two.yaml"
    for deck in one two; do
        mkdir -p "$work/$deck" && cp "$work/whole/plate.nodes.h5" "$work/$deck/"
        "$build/kirsch-solve" --output "$work/$deck" "$work/$deck.yaml" || return
    done
    tail -n 1 "$work/one/history.csv" >"$work/a"
    tail -n 1 "$work/two/history.csv" >"$work/b"
    # 200 steps and cracks between: rounding of 1e-16 has grown by less than a million.
    paste -d, "$work/a" "$work/b" | awk -F, -v n="$(head -n 1 "$work/a" | awk -F, '{print NF}')" '
        { for (k = 3; k <= 6; k++) { off = ($k - $(n + k)) / ($6 + 1e-300); if (off < 0) off = -off
              if (off > worst) worst = off }
          printf "# figure energies off by %.1e, broken bonds %d and %d\n", worst, $8, $(n + 8)
          exit !(worst < 1e-10 && $8 == $(n + 8) && $1 == $(n + 1)) }'
}

# The pictures of the deck's faults.
refused() { # words, sed command
    sed "$2" "$work/case.yaml" >"$work/wrong.yaml"
    mkdir -p "$work/wrong" && whole && cp "$work/whole/plate.nodes.h5" "$work/wrong/"
    stops 2 "$1" "$build/kirsch-solve" --output "$work/wrong" "$work/wrong.yaml"
}

check one_and_two_threads_are_equal two_threads
check after_kills_is_equal killed
check after_an_interrupt_is_equal interrupted
check split_dynamics_is_whole_dynamics split
check names_a_free_slide refused 'moving along x' 's/\[0 mm, 0.01\*t mm\]/[free, 0.01*t mm]/; s/displacement: \[0 mm, 0 mm\]/displacement: [free, 0 mm]/'
check static_has_no_end_time refused 'ends with its load steps' 's/end_below: 0/end_time: 1 s/'
check nothing_holds refused 'nothing holds the body' '/stages:/,/steps/ { s/set: up, displacement: \[0 mm, 0.01\*t mm\]/set: top, traction: [free, 1 MPa]/; /set: down/d }'
check ends_are_the_stages_own refused 'each has an end of its own' 's/^solver: {/solver: {end_time: 1 us, /'
echo "1..$count"
