#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What fails beside us: modules of Python, Python itself, files that HDF5 refuses. A sentence names what to install or what
# is wrong; nothing new lies in the folder; and what can do without still works.
prefix=missing
. tests/cli/steps
bin=$work/bin
mkdir -p "$bin"
cp "$build/kirsch-nodes" "$build/kirsch-plot" "$build/kirsch-track" "$build"/*.py "$bin/"

# Modules that cannot be imported: one of the same name lies beside the script, where Python looks first.
without() { # module...
    for module; do
        echo "raise ModuleNotFoundError(\"No module named '$module'\", name='$module')" >"$bin/$module.py"
        missing="$missing $bin/$module.py"
    done
}
again() { rm -f $missing; missing=; }

# Exit 5 and these words, no trace, and no file more than before.
lacks() { # words, folder, command...
    words=$1 folder=$2
    shift 2
    mkdir -p "$folder" && (cd "$folder" && find . | sort) >"$work/before" || return
    stops 5 "$words" "$@" && ! grep -q 'Traceback' "$work/stop" || return
    [ "$(wc -l <"$work/stop")" = 1 ] || { echo "more than one sentence"; return 1; }
    (cd "$folder" && find . | sort) | diff "$work/before" -
}

convert() { # file in the corpus, option...
    file=tests/corpus/$1
    shift
    "$bin/kirsch-nodes" --convert "$file" --output "$work/into" "$@"
}

mesh_without() { # module, file of the corpus
    without "$1"
    lacks "plane.* needs Python's module $1, .*apt-get install python3-$(echo "$1" | tr A-Z a-z)$" "$work/into" convert "$2"
    code=$?
    again
    return $code
}

# A library below a module may be gone: then what Python says of it.
module_that_is_broken() {
    echo 'raise ImportError("libnetcdf.so.19: cannot open shared object file")' >"$bin/netCDF4.py"
    lacks "cannot load .* libnetcdf.so.19: cannot open" "$work/into" convert plane.e
    code=$?
    rm "$bin/netCDF4.py"
    return $code
}

# Exodus is written beside a node file, which stays.
exodus_without() { # module
    rm -rf "$work/into" && mkdir "$work/into" && convert plane-41.msh && mkdir "$work/kept" && mv "$work/into"/*.nodes.h5 "$work/kept" || return
    without "$1"
    stops 5 "apt-get install python3-$(echo "$1" | tr A-Z a-z)$" convert plane-41.msh --write exodus
    code=$?
    again
    diff -r "$work/kept" "$work/into" && rm -rf "$work/kept" && return $code
}

# Formats that we read go on; those in Python need numpy.
ours_go_on() {
    without meshio netCDF4 h5py
    for file in plane.inp plane.cdb plane.unv plane-22.msh plane-41-binary.msh points.csv; do
        convert "$file" --thickness '1 mm' || { again; return 1; }
    done
    again
}

# Python hidden by a file of no use that is mounted over it.
no_python() { # command...
    unshare -rm true 2>/dev/null || { echo "# figure Python cannot be hidden here (unshare -rm)"; return 0; }
    : >"$work/none"
    lacks "apt-get install python3" "$work/into" unshare -rm sh -c \
        'mount --bind "$0" /usr/bin/python3 && exec "$@"' "$work/none" "$@"
}

plate() {
    [ -e "$work/run/plate.nodes.h5" ] && return
    write_case && steps "$work/run" "mesh nodes"
}

plot() { "$bin/kirsch-plot" --output "$work/run" "$work/case.yaml" grid; }

no_python_for_pictures() {
    plate && no_python "$bin/kirsch-plot" --output "$work/run" "$work/case.yaml" grid
}

pictures_without() { # module
    plate || return
    without "$1"
    lacks "No module named '$1'.* python3-matplotlib" "$work/run" plot
    code=$?
    again
    return $code
}

# A node file that HDF5 cannot open, or in which something is not there.
refused() { # words, Python statement about `path`
    plate && rm -rf "$work/odd" && mkdir "$work/odd" && cp "$work/run/plate.nodes.h5" "$work/odd" || return
    /usr/bin/python3 -c "import h5py, sys; path = sys.argv[1]; $2" "$work/odd/plate.nodes.h5" || return
    stops 2 "plate.nodes.h5.*$1" "$build/kirsch-solve" --output "$work/odd" "$work/case.yaml" &&
        [ "$(ls "$work/odd")" = plate.nodes.h5 ]
}

check meshio mesh_without meshio plane.vtu
check netcdf4 mesh_without netCDF4 plane.e
check numpy mesh_without numpy plane.inp
check module_that_is_broken module_that_is_broken
check ours_go_on ours_go_on
check h5py_for_exodus exodus_without h5py
check netcdf4_for_exodus exodus_without netCDF4
check python no_python "$bin/kirsch-nodes" --convert tests/corpus/plane.vtu --output "$work/into"
check matplotlib pictures_without matplotlib
check h5py_for_pictures pictures_without h5py
check python_for_pictures no_python_for_pictures
check python_for_comparing no_python "$bin/kirsch-plot" compare "$work/run" "$work/run"
check not_hdf5 refused "it is no HDF5 file" "open(path, 'w').write('a text\n' * 1000)"
check dataset_that_is_gone refused "nodes/volume: there is no such array" "f = h5py.File(path, 'r+'); del f['nodes/volume']; f.close()"
check dataset_of_text refused "nodes/volume: its numbers are of another type" \
    "f = h5py.File(path, 'r+'); n = len(f['nodes/volume']); del f['nodes/volume']; f['nodes/volume'] = ['x'] * n; f.close()"
check dataset_of_another_length refused "nodes/volume: its shape is" \
    "f = h5py.File(path, 'r+'); v = f['nodes/volume'][:-1]; del f['nodes/volume']; f['nodes/volume'] = v; f.close()"
echo "1..$count"
