#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The same bits for any number of threads and for every run; other builds of the loop agree until
# rounding has grown.
prefix=threads
. tests/cli/steps
write_case

# Runs with one thread and twice with two, each made when it is first asked for; in one folder after
# the other, for its name is in the files.
make_run() { # one, two or again
    [ -d "$work/$1" ] && return
    threads=2
    [ "$1" = one ] && threads=1
    OMP_NUM_THREADS=$threads steps "$work/now" "mesh nodes solve" && mv "$work/now" "$work/$1"
}

same_files() { # run, run
    make_run "$1" && make_run "$2" || return
    for file in plate.msh plate.nodes.h5 history.csv run.h5; do
        cmp "$work/$1/$file" "$work/$2/$file" || return
    done
    diff -r "$work/$1/run" "$work/$2/run" || return
    broken=$(tail -n 1 "$work/$1/history.csv" | cut -d, -f8)
    echo "# figure $broken bonds broke; plate.msh, plate.nodes.h5, history.csv, run.h5 and run/ equal byte by byte"
    [ "$broken" -gt 500 ]
}

# Builds round differently: sums of some 30 terms by 1e-16, and a plate that has not broken yet does
# not let that grow. The files hold 12 digits of the energies, 6 of their balance.
same_history() { # build
    make_run two && with_build "$1" || return
    awk -F, 'FNR == 1 { next }
        NR == FNR { for (k = 1; k <= NF; k++) first[FNR, k] = $k; next }
        { if ($8 > 0) next
          for (k = 3; k <= 6; k++) { off = $k - first[FNR, k]; if (off < 0) off = -off
              if (first[FNR, 6] > 0 && off / first[FNR, 6] > worst) worst = off / first[FNR, 6] }
          lines++ }
        END { printf "# figure %d records before the first bond breaks, off by %.1e\n", lines, worst
              exit !(lines > 3 && worst < 1e-10) }' "$work/two/history.csv" "$work/$1/history.csv"
}

with_build() { # build
    mkdir -p "$work/$1" && cp "$work/two/plate.nodes.h5" "$work/$1/" &&
        KIRSCH_KERNEL=$1 steps "$work/$1" solve
}

runs_here() { # build
    [ "$1" = baseline ] || grep -qw "$1" /proc/cpuinfo
}

check one_and_two_are_equal same_files one two
check two_runs_are_equal same_files two again
for kind in baseline avx2; do
    runs_here $kind && check "builds_agree_$kind" same_history $kind
done
echo "1..$count"
