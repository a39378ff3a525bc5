#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Trust: checkpoints that are damaged, a limit of time, storage that gives out, files that are cut, numbers that are mistaken.
prefix=trust
. tests/cli/steps
write_case
often='solver.checkpoint_every=50 ms'
slow='solver.time_step=20 ns'

solve() { # option...
    "$build/kirsch-solve" --output "$work/now" --set "$often" --set "$slow" "$@" "$work/case.yaml"
}

# The same in the background; child is the program itself, so that a kill meets it and no shell before it.
start() {
    "$build/kirsch-solve" --output "$work/now" --set "$often" --set "$slow" "$work/case.yaml" >"$work/log" 2>&1 &
    child=$!
}

nodes() {
    [ -f "$work/plate/plate.nodes.h5" ] || steps "$work/plate" "mesh nodes"
}

# The undisturbed run, and a folder with nodes alone.
begin() {
    nodes || return
    rm -rf "$work/now"
    [ -d "$work/whole" ] || { mkdir "$work/now" && cp "$work/plate/plate.nodes.h5" "$work/now" && solve &&
        mv "$work/now" "$work/whole"; } || return
    mkdir "$work/now" && cp "$work/plate/plate.nodes.h5" "$work/now"
}

# Two checkpoints: run until both are there, then kill.
two_checkpoints() {
    begin || return
    start
    until [ -e "$work/now/checkpoint-before.h5" ] && [ -e "$work/now/checkpoint.h5" ]; do
        kill -0 $child || return
        sleep 0.02
    done
    kill -KILL $child
    wait $child 2>/dev/null
    [ -e "$work/now/checkpoint.h5" ] || mv "$work/now/checkpoint-before.h5" "$work/now/checkpoint.h5"
}

equal() {
    cmp "$work/now/history.csv" "$work/whole/history.csv" && diff -r "$work/now/run" "$work/whole/run"
}

# Write a byte that was not there, or cut: the one before is taken, and the end is the same.
damaged() { # cut|flip
    two_checkpoints || return
    file=$work/now/checkpoint.h5
    size=$(stat -c %s "$file")
    if [ "$1" = cut ]; then
        truncate -s $((size * 2 / 3)) "$file"
    else
        byte=$(od -An -tu1 -j $((size / 2)) -N 1 "$file")
        printf "\\$(printf %03o $((byte ^ 16)))" | dd of="$file" bs=1 seek=$((size / 2)) conv=notrunc 2>/dev/null
    fi
    solve --resume >"$work/log" 2>&1 || { cat "$work/log"; return 1; }
    grep -q "checkpoint.h5 is damaged" "$work/log" && equal
}

both_damaged() {
    two_checkpoints || return
    for file in "$work/now"/checkpoint*.h5; do truncate -s 3000 "$file"; done
    stops 3 "no checkpoint in .* is whole" solve --resume
}

# The limit stops with 7; resumed, the end is that of a run without limit.
walltime() {
    begin || return
    stops 7 "time limit" "$build/kirsch-solve" --output "$work/now" --set 'solver.checkpoint_every=0 s' \
        --set solver.time_step='0.02 ns' --max-walltime 1 "$work/case.yaml" || return
    [ -s "$work/now/checkpoint.h5" ] && ! [ -e "$work/now/checkpoint-new.h5" ]
}

# A second run in the folder of one that is at work is refused, and does not disturb it.
second_run() {
    begin || return
    start
    until [ -e "$work/now/checkpoint.h5" ]; do kill -0 $child || return; sleep 0.02; done
    kill -STOP $child
    stops 3 "another kirsch-solve is at work" solve
    refused=$?
    kill -CONT $child
    wait $child && [ $refused -eq 0 ] && equal
}

# A results file cut anywhere is refused, never worse: at its ends, at tenths, and where no seed repeats.
cut_results() {
    begin && rm -rf "$work/now" && cp -r "$work/whole" "$work/now" || return
    tried=0
    for file in run/crack.h5 run.h5; do
        word=run.h5 # which links to the other as /crack
        [ $file = run.h5 ] || word=/crack
        size=$(stat -c %s "$work/whole/$file")
        for kept in 0 1 7 8 95 $((size - 1)) $((size - 2)) $((size - 8)) $(seq $((size / 10)) $((size / 10)) $((size - 1))) \
            $(od -An -N24 -tu4 /dev/urandom | awk -v n="$size" '{ for (k = 1; k <= NF; k++) print $k % n }'); do
            head -c "$kept" "$work/whole/$file" >"$work/now/$file"
            stops 2 "$word" "$build/kirsch-track" --output "$work/now" "$work/case.yaml" || return
            tried=$((tried + 1))
        done
        cp "$work/whole/$file" "$work/now/$file"
    done
    echo "# figure cut at $tried places, refused at each"
}

# A small disk that is full while a run is at work; freed, the run goes on as if nothing had been.
full_then_freed() {
    begin || return
    unshare -rm true 2>/dev/null || { echo "# figure no disk of its own can be made here (unshare -rm)"; return 0; }
    export build work often slow
    unshare -rm sh <<'END'
mount -t tmpfs -o size=16m none "$work/now" && cp "$work/plate/plate.nodes.h5" "$work/now" || exit
solve() { "$build/kirsch-solve" --output "$work/now" --set "$often" --set "$slow" "$@" "$work/case.yaml"; }
"$build/kirsch-solve" --output "$work/now" --set "$often" --set "$slow" "$work/case.yaml" >"$work/log" 2>&1 &
child=$!
until [ -e "$work/now/checkpoint.h5" ]; do kill -0 $child || exit; sleep 0.02; done
kill -STOP $child
cat /dev/zero >"$work/now/filler" 2>/dev/null
kill -CONT $child
wait $child
code=$?
cat "$work/log"
[ $code -eq 3 ] && grep -q "No space left" "$work/log" || { echo "a full disk ends with $code"; exit 1; }
rm "$work/now/filler"
solve --resume && cmp "$work/now/history.csv" "$work/whole/history.csv" && diff -r "$work/now/run" "$work/whole/run"
END
}

# A checkpoint that was written by someone else: sealed, but with numbers that lead nowhere.
resealed() { # words, Python statement about `file`
    two_checkpoints || return
    rm -f "$work/now/checkpoint-before.h5"
    /usr/bin/python3 - "$work/now/checkpoint.h5" "$2" <<'END' || return
import h5py, sys
path, change = sys.argv[1:]
with h5py.File(path, "r+") as file:
    exec(change)
data = open(path, "rb").read()
hash = 0xcbf29ce484222325
for byte in data:
    hash = (hash ^ byte) * 0x100000001b3 & (1 << 64) - 1
open(path, "ab").write(b"kirsch seal %016x\n" % hash)
END
    stops 2 "$1" solve --resume
}

# A table that was cut or lost since the checkpoint cannot be gone on with.
lost_history() {
    two_checkpoints || return
    : >"$work/now/history.csv"
    stops 3 "bring it back, or run without --resume" solve --resume
}

# No file under its own name may be half written: those that are there can be read whole.
no_halves() { # folder
    for file in "$1"/*.nodes.h5 "$1"/run.h5 "$1"/run/*.h5; do
        [ -e "$file" ] || continue
        /usr/bin/python3 -c 'import h5py, sys; h5py.File(sys.argv[1]).visititems(
            lambda name, item: item[()] if hasattr(item, "shape") else None)' "$file" || return
    done
}

# A disk that is full after so many KiB: exit 3, and nothing half written.
full_disk() { # program KiB
    nodes || return
    rm -rf "$work/full" && mkdir "$work/full" && cp "$work/plate/plate.msh" "$work/full"
    [ "$1" = solve ] && cp "$work/plate/plate.nodes.h5" "$work/full"
    stops 3 "cannot write\|cannot be written" /usr/bin/python3 -c 'import os, resource, signal, sys
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[1]) * 1024,) * 2)
os.execv(sys.argv[2], sys.argv[2:])' "$2" "$build/kirsch-$1" --output "$work/full" "$work/case.yaml" &&
        no_halves "$work/full"
}

# Nothing is written through a link that lies in the folder of results.
links() { # name of what is a link, folder or file that it leads to
    nodes || return
    rm -rf "$work/now" "$work/elsewhere" && mkdir "$work/now" "$work/elsewhere" &&
        cp "$work/plate/plate.nodes.h5" "$work/now" && echo kept >"$work/elsewhere/file" || return
    ln -s "$work/elsewhere/$2" "$work/now/$1"
    stops 3 "not written through links" solve && [ "$(ls "$work/elsewhere")" = file ] &&
        [ "$(cat "$work/elsewhere/file")" = kept ]
}

# What a killed run left beside may be a link, too: it is removed, not followed.
link_beside() {
    begin && mkdir -p "$work/elsewhere" && echo kept >"$work/elsewhere/file" || return
    for file in run.h5 run.xdmf checkpoint.h5; do ln -s "$work/elsewhere/file" "$work/now/$file.tmp"; done
    solve && equal && [ "$(cat "$work/elsewhere/file")" = kept ]
}

# Root may write everywhere, and is nobody for this.
read_only() {
    nodes || return
    rm -rf "$work/now" && mkdir "$work/now" && cp "$work/plate/plate.nodes.h5" "$work/now" &&
        cp "$build/kirsch-solve" "$work" && chmod 755 "$work" && chmod 555 "$work/now" || return
    as=
    [ "$(id -u)" -eq 0 ] && as='setpriv --reuid 65534 --clear-groups'
    stops 3 "Permission denied" $as "$work/kirsch-solve" --output "$work/now" "$work/case.yaml"
    code=$?
    chmod 755 "$work/now"
    return $code
}

# A kirsch-gmsh that crashes, or is not there: said, and no mesh is left. The voronoi grid does without it.
gmsh_that() { # words, what stands in its place
    mkdir -p "$work/bin" && cp "$build/kirsch-mesh" "$work/bin/" && rm -rf "$work/bin/kirsch-gmsh" "$work/without" || return
    [ -z "$2" ] || { printf '#!/bin/sh\n%s\n' "$2" >"$work/bin/kirsch-gmsh" && chmod +x "$work/bin/kirsch-gmsh"; } || return
    stops 5 "$1" "$work/bin/kirsch-mesh" --output "$work/without" "$work/case.yaml" || return
    [ -e "$work/without/plate.msh" ] && return 1
    "$work/bin/kirsch-mesh" --set mesh.grid=voronoi --output "$work/without" "$work/case.yaml"
}

check takes_the_older_checkpoint_if_cut damaged cut
check takes_the_older_checkpoint_if_changed damaged flip
check two_damaged_checkpoints both_damaged
check stops_at_the_time_limit walltime
check time_limit_of_nothing stops 2 "expected seconds" "$build/kirsch-solve" --max-walltime 0 "$work/case.yaml"
check refuses_a_second_run second_run
check folder_that_is_a_link links run .
check history_that_is_a_link links history.csv file
check link_left_beside link_beside
check read_only_folder read_only
check results_cut_anywhere cut_results
check full_disk_that_is_freed full_then_freed
check checkpoint_beyond_the_run resealed "which the run does not have" "file.attrs['step'] = 10**9"
check checkpoint_of_other_stages resealed "which the run does not have" "file.attrs['stage'] = 7"
check checkpoint_with_a_bond_to_nowhere resealed "found node 1000000" \
    "del file['bond'], file['bond_time'], file['bond_energy']; file.create_dataset('bond', data=[[1, 1000000]], dtype='i4'); file['bond_time'] = [0.]; file['bond_energy'] = [0.]"
check checkpoint_with_a_bond_that_never_was resealed "a bond lives that the body does not have" "file['living'][...] = -1"
check history_that_is_lost lost_history
check gmsh_that_crashes gmsh_that "it crashed" 'kill -SEGV $$'
check gmsh_that_is_missing gmsh_that "kirsch-gmsh is missing" ''
check full_disk_in_nodes full_disk nodes 64
check full_disk_in_solve full_disk solve 16
check full_disk_in_checkpoint full_disk solve 40
echo "1..$count"
