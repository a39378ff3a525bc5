#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A run that is killed, stopped and resumed leaves the bytes of a run that was not, with any number of
# threads; a checkpoint that does not fit is refused.
prefix=restart
. tests/cli/steps
write_case
often='solver.checkpoint_every=20 ms'
slow='solver.time_step=2 ns' # many steps, so that there is time for 20 kills

# The undisturbed run, in the folder that all runs use in turn: its name is in the files.
whole() {
    [ -d "$work/whole" ] && return
    steps "$work/now" "mesh nodes solve" --set "$often" --set "$slow" && mv "$work/now" "$work/whole"
}

begin() {
    whole && rm -rf "$work/now" && mkdir "$work/now" && cp "$work/whole/plate.nodes.h5" "$work/now/"
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
        cmp "$work/now/$file" "$work/whole/$file" || return
    done
    diff -r "$work/now/run" "$work/whole/run"
}

# kill -9 at moments that no seed repeats; what is tested is that none of them matters.
killed() {
    begin || return
    kills=0
    while [ $kills -lt 20 ]; do
        go_on
        sleep "0.$(od -An -N1 -tu1 /dev/urandom | awk '{ printf "%03d", 40 + $1 % 110 }')"
        kill -9 $child 2>/dev/null || break
        wait $child 2>/dev/null
        kills=$((kills + 1))
    done
    [ $kills -eq 20 ] || { echo "done after $kills kills"; return 1; }
    go_on
    wait $child || { cat "$work/solve.log"; return 1; }
    echo "# figure killed $kills times, then equal byte by byte"
    equal
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

# A checkpoint of another deck is refused, and the key that differs is named.
other_deck() {
    begin || return
    go_on
    until [ -e "$work/now/checkpoint.h5" ]; do sleep 0.02; done
    kill -9 $child
    wait $child 2>/dev/null
    stops 2 "material.fracture_energy" "$build/kirsch-solve" --resume --set "$often" --set "$slow" \
        --set "material.fracture_energy=60 J/m2" --output "$work/now" "$work/case.yaml"
}

none() {
    begin || return
    stops 2 "no checkpoint" "$build/kirsch-solve" --resume --set "$often" --set "$slow" --output "$work/now" \
        "$work/case.yaml"
}

check after_kills_is_equal killed
check after_a_signal_is_equal terminated
check refuses_another_deck other_deck
check needs_a_checkpoint none
echo "1..$count"
