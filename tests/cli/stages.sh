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
    until [ -e "$work/now/run/000000.h5" ] || ! kill -0 $child; do sleep 0.02; done
    sleep 0.1
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

# What outputs hold, and when: fields by name, float64, packed; every 3rd load step, and on events.
outputs() {
    begin || return
    "$build/kirsch-solve" --output "$work/now" --set 'output.fields=[stress, damage, strain]' --set output.precision=double \
        --set output.compression=all --set output.every_steps=3 --set output.every_bonds=10 "$work/case.yaml" || return
    for run in now whole; do
        head -n 8 "$work/$run/history.csv" >"$work/$run.csv" # the static stage
    done
    cmp "$work/now.csv" "$work/whole.csv" || return
    /usr/bin/python3 - "$work" <<'END'
import sys, glob, csv, h5py, numpy as np
work = sys.argv[1]
few, all_ = (h5py.File(f"{work}/{k}/run.h5")["step"] for k in ("now", "whole"))
first = sorted(few)[1]
assert list(few[first]) == ["Damage", "Strain", "Stress"], list(few[first])
assert few[first]["Stress"].dtype == "f8" and few[first]["Stress"].compression == "gzip"
assert few[first]["Stress"].shape[1] == 6
rows = [r for r in csv.DictReader(open(f"{work}/whole/history.csv")) if r["stage"] == "1"]
broken = {int(r["step"]): int(r["broken_bonds"]) for r in rows}
wanted = {s for s in broken if s % 3 == 0 or s == max(broken)
          or s and broken[s] // 10 > broken[s - 1] // 10}
got = {int(k) for k in few if int(k) <= max(broken)}
assert got == wanted, (got, wanted)
assert max(broken.values()) > 40 and len(wanted - {0, 3, 6, 7}) and len(wanted) < len(broken) <= len(all_)
for k in few:
    if k in all_:
        assert np.array_equal(few[k]["Damage"][:].astype("f4"), all_[k]["Damage"][:])
assert "Tensor6" in open(f"{work}/now/run.xdmf").read()
print(f"# figure outputs at load steps {sorted(got)} of {len(broken)}")
END
}

# A dynamic run without stages whose outputs hang on events: linked, and the same after an interrupt.
on_events() {
    whole || return
    sed '/^stages:/,$d; /^output:/d; /^solver/d' "$work/case.yaml" >"$work/base.yaml"
    cat >>"$work/base.yaml" <<'END'
loads: [{set: up, velocity: [0 m/s, 5 m/s]}, {set: down, velocity: [0 m/s, 0 m/s]}]
solver: {end_time: 40 us}
output: {first_damage: true, every_bonds: 1000}
END
    for run in once again; do
        mkdir -p "$work/$run" && cp "$work/whole/plate.nodes.h5" "$work/$run/"
    done
    "$build/kirsch-solve" --output "$work/once" "$work/base.yaml" || return
    "$build/kirsch-solve" --output "$work/again" "$work/base.yaml" &
    child=$!
    while [ ! -e "$work/again/run/000000.h5" ]; do sleep 0.05; done
    kill -TERM $child
    wait $child
    [ $? -eq 7 ] && "$build/kirsch-solve" --resume --output "$work/again" "$work/base.yaml" || return
    diff -r "$work/once/run" "$work/again/run" && cmp "$work/once/run.xdmf" "$work/again/run.xdmf" || return
    /usr/bin/python3 - "$work/once" <<'END'
import sys, h5py, numpy as np
file = h5py.File(sys.argv[1] + "/run.h5")
time, first = file["crack/bond_time"][:], []
for k in range(len(time)):
    if k == 0 or (k + 1) % 1000 == 0:
        first.append(time[k])
wanted = sorted(set(first))
got = sorted(file["step"][k].attrs["time"] for k in file["step"])[1:-1]
assert np.allclose(got, [t for t in wanted if t < file["step"][max(file["step"])].attrs["time"]], rtol=1e-9), (got, wanted)
assert len(got) > 2
print(f"# figure {len(got)} outputs on events")
END
}

write_table() {
    printf 'time [ms],other,factor\n0,9,0\n1000,9,1\n\n2000, 9 , 0\r\n' >"$work/cycle.csv"
}

# A table that goes up, down and again, read in two units: the reaction follows it, and probes tell what the
# outputs hold: a place, and the mean over a set.
tables() {
    whole || return
    write_table
    mkdir -p "$work/tabled" && cp "$work/whole/plate.nodes.h5" "$work/tabled/"
    sed '/^stages:/,$d; /^output:/d' "$work/case.yaml" >"$work/cyclic.yaml"
    cat >>"$work/cyclic.yaml" <<'END'
output: {fields: [displacement, stress], precision: double, probes: [{name: spot, quantity: stress, at: [9 mm, 12 mm]}, {name: above, quantity: displacement, set: up}]}
loads:
  - {set: up, displacement: [0 mm, 1e-3 mm], table: {file: cycle.csv, column: factor, repeat: true}}
  - {set: down, displacement: [0 mm, 0 mm]}
stages: [{kind: static, steps: [{count: 7, size: 0.5 s}]}]
END
    "$build/kirsch-solve" --output "$work/tabled" "$work/cyclic.yaml" || return
    /usr/bin/python3 - "$work/tabled" <<'END'
import sys, csv, h5py, numpy as np
folder = sys.argv[1]
rows = list(csv.DictReader(open(folder + "/history.csv")))
file, nodes = h5py.File(folder + "/run.h5"), h5py.File(folder + "/plate.nodes.h5")
x, up, volume = file["nodes/position"][:], nodes["sets/up"][:], file["nodes/volume"][:]
spot = np.argmin(np.hypot(*(x - [9e-3, 12e-3]).T))
wanted, pull = [0, .5, 1, .5, 0, .5, 1, .5], [float(r["reaction_y up [N/m]"]) for r in rows]
assert np.allclose(np.array(pull) / pull[2], wanted, atol=2e-4), pull
for row, k in zip(rows, sorted(file["step"])):
    u, s = file["step"][k]["Displacement"][:], file["step"][k]["Stress"][:]
    for axis in (0, 1):
        mean = np.average(u[up, axis], weights=volume[up])
        assert np.isclose(float(row[f"displacement_{'xy'[axis]} above [m]"]), mean, rtol=1e-8, atol=1e-20)
    for name, m in (("xx", 0), ("xy", 1), ("yy", 3)):
        assert np.isclose(float(row[f"stress_{name} spot [Pa]"]), s[spot, m], rtol=1e-8, atol=1e-20)
assert abs(s[spot, 3]) > 1e4 and len(rows) == 8 and "stress_zz spot [Pa]" not in rows[0]
END
}

# The pictures of the deck's faults.
refused() { # words, sed command
    sed "$2" "$work/case.yaml" >"$work/wrong.yaml"
    write_table
    mkdir -p "$work/wrong" && whole && cp "$work/whole/plate.nodes.h5" "$work/wrong/"
    stops 2 "$1" "$build/kirsch-solve" --output "$work/wrong" "$work/wrong.yaml"
}

check one_and_two_threads_are_equal two_threads
check after_kills_is_equal killed
check after_an_interrupt_is_equal interrupted
check split_dynamics_is_whole_dynamics split
check outputs_are_chosen outputs
check outputs_on_events on_events
check tables_and_probes tables
check wrong_tables_are_named refused "there is no column 'force'" 's/set: up, displacement: \[0 mm, 0.01\*t mm\]/&, table: {file: cycle.csv, column: force}/'
check missing_table refused 'cannot be read; expected a CSV file' 's/set: up, displacement: \[0 mm, 0.01\*t mm\]/&, table: {file: none.csv}/'
check probe_outside refused 'expected a place in the body' 's/^output: {/&probes: [{name: p, quantity: damage, at: [9 mm, 7 mm]}], /'
check probe_of_no_set refused "no set is called 'nowhere'" 's/^output: {/&probes: [{name: p, quantity: damage, set: nowhere}], /'
check unknown_field refused "unknown field 'tension'" 's/^output: {/output: {fields: [damage, tension], /'
check static_has_no_end_time refused 'ends with its load steps' 's/end_below: 0/end_time: 1 s/'
check ends_are_the_stages_own refused 'each has an end of its own' 's/^solver: {/solver: {end_time: 1 us, /'
echo "1..$count"
