#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# kirsch-study on tiny plates: one table, a failing row named, killed and resumed to the same table,
# nothing run twice, a Slurm script.
prefix=study
. tests/cli/steps
cat >"$work/case.yaml" <<'END'
geometry: {width: 24 mm, height: 16 mm, pores: {count: 2, radius: [1 mm, 1.5 mm], seed: 1}}
mesh: {grid: near-boundary, spacing: 0.5 mm}
nodes: {horizon: 1.5 mm}
material: {model: plane-stress, youngs_modulus: 3.24 GPa, density: 1190 kg/m3, fracture_energy: 50 J/m2}
cracks: {precracks: [{from: [0 mm, 8 mm], to: [4 mm, 8 mm]}]}
loads:
  - {set: top, traction: [free, 4 MPa]}
  - {set: bottom, traction: [free, -4 MPa]}
no_fail: [top, bottom]
solver: {end_time: 40 us}
output: {every: 20 us, history_every: 5 us}
END
cat >"$work/table.csv" <<'END'
# seeds and radii
geometry.pores.seed, geometry.pores.count, geometry.pores.radius
1,2,
2,500,
3,1,"[0.8 mm, 1.2 mm]"
END
study() { "$build/kirsch-study" "$work/table.csv" "$work/case.yaml" --output "$@"; }

# All columns but the wall time, the last but one.
results() { /usr/bin/python3 -c "import csv, sys
for row in csv.reader(open(sys.argv[1])): print(row[:-2] + row[-1:])" "$1"; }

whole() {
    [ -d "$work/whole" ] && return
    study "$work/whole" >"$work/whole.log" 2>&1
    [ $? -eq 2 ] # the code of the run that fails
}
names_the_failed() {
    whole && cat "$work/whole.log" && grep -q '^3 runs: 2 done, 1 failed' "$work/whole.log" &&
        grep -q 'run 2, seed-2_count-500, failed: .*geometry.pores.count: 500 pores' "$work/whole.log" &&
        results "$work/whole/study.csv" | grep -c "'done'" | grep -qx 2
}
runs_none_twice() {
    whole && before=$(stat -c %y "$work/whole/seed-1_count-2/run.h5") || return
    study "$work/whole" >"$work/again" 2>&1
    cat "$work/again"
    [ "$(grep -c 'was done before' "$work/again")" -eq 2 ] &&
        [ "$before" = "$(stat -c %y "$work/whole/seed-1_count-2/run.h5")" ]
}
# Four plates, killed when the first is done and another under way: the same command goes on to the table of a
# study that nobody disturbed, byte by byte but for the wall time, and does not run again what was done.
killed() {
    printf 'geometry.pores.seed, geometry.pores.count\n1,1\n3,1\n4,2\n5,2\n' >"$work/four.csv"
    four() { "$build/kirsch-study" "$work/four.csv" "$work/case.yaml" --at-once 1 --output "$@"; }
    four "$work/calm" >"$work/calm.log" 2>&1 || return
    four "$work/now" >/dev/null 2>&1 &
    child=$!
    until [ -e "$work/now/seed-1_count-1/summary.csv" ] && [ -e "$work/now/seed-3_count-1/plate.msh" ]; do
        kill -0 $child || return
        sleep 0.02
    done
    kill -9 $child || return
    wait $child 2>/dev/null
    [ ! -e "$work/now/seed-4_count-2/summary.csv" ] || { echo "was over before it was killed"; return 1; }
    before=$(stat -c %y "$work/now/seed-1_count-1/run.h5")
    four "$work/now" >"$work/now.log" 2>&1
    cat "$work/now.log"
    results "$work/now/study.csv" >"$work/a"
    results "$work/calm/study.csv" >"$work/b"
    [ "$(grep -c "'done'" "$work/b")" -eq 4 ] && diff "$work/a" "$work/b" &&
        [ "$before" = "$(stat -c %y "$work/now/seed-1_count-1/run.h5")" ] &&
        for run in seed-1_count-1 seed-3_count-1 seed-5_count-2; do
            for file in history.csv tips.csv damage.csv; do
                cmp "$work/now/$run/$file" "$work/calm/$run/$file" || return
            done
        done
}
draws() {
    whole && /usr/bin/python3 - "$work/whole/pictures/contact.png" <<'PY'
import sys, numpy as np
from PIL import Image
picture = Image.open(sys.argv[1])
assert abs(picture.info["dpi"][0] - 300) < 1 and picture.size[0] == 2100, (picture.info, picture.size)
assert np.asarray(picture.convert("L")).std() > 10, "blank"
PY
}
slurm() { # each task is one row of the table
    study "$work/slurm" --slurm >"$work/slurm.sh" && cat "$work/slurm.sh" && sh -n "$work/slurm.sh" &&
        grep -q '^#SBATCH --array=1-3$' "$work/slurm.sh" && [ ! -e "$work/slurm" ] || return
    SLURM_ARRAY_TASK_ID=3 sh "$work/slurm.sh" && study "$work/slurm" --gather || return
    results "$work/slurm/study.csv" | tail -n 1 >"$work/a"
    whole && results "$work/whole/study.csv" | tail -n 1 | diff "$work/a" - &&
        [ ! -e "$work/slurm/seed-1_count-2" ]
}
combines() {
    printf 'deck: case.yaml\nvary:\n  - {key: geometry.pores.seed, values: [1, 2]}\n  - {key: loads.0.ramp, values: [0 us, 3 us, 5 us]}\n' >"$work/study.yaml"
    "$build/kirsch-study" "$work/study.yaml" --explain >"$work/commands"
    [ "$(wc -l <"$work/commands")" -eq 6 ] &&
        grep -q "seed=2 --set 'loads.0.ramp=3 us' --output .*/seed-2_ramp-3us" "$work/commands"
}
same_name() {
    printf 'geometry.pores.seed\n1\n1\n' >"$work/twice.csv"
    stops 2 "runs 1 and 2 are both named 'seed-1'" "$build/kirsch-study" "$work/twice.csv" "$work/case.yaml"
}
compares() { # a run with itself, and with another
    whole && "$build/kirsch-plot" compare "$work/whole/seed-1_count-2" "$work/whole/seed-1_count-2" |
        grep -qx 'largest difference of damage: 0' &&
        "$build/kirsch-plot" compare "$work/whole/seed-1_count-2" \
            "$work/whole/seed-3_count-1_radius-0.8mm-1.2mm" | grep -q 'damage: 0\.[1-9]'
}

check names_the_failed_run names_the_failed
check runs_none_twice runs_none_twice
check after_a_kill_is_equal killed
check draws_a_sheet draws
check prints_a_slurm_script slurm
check combines_values combines
check refuses_two_runs_of_one_name same_name
check compares_two_runs compares
echo "1..$count"
