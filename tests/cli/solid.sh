#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A body in three dimensions from a mesh of gmsh, by all programs: the same bits for any number of
# threads and after a stop, a pre-crack in each form, and what does not fit is refused.
prefix=solid
. tests/cli/steps

cat >"$work/block.geo" <<'END'
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 10, 7, 6};
Transfinite Curve {9, 10, 11, 12} = 21;
Transfinite Curve {2, 4, 6, 8} = 15;
Transfinite Curve {1, 3, 5, 7} = 13;
Transfinite Surface "*"; Recombine Surface "*"; Transfinite Volume "*";
Physical Volume("body") = {1};
Physical Surface("left") = {1}; Physical Surface("right") = {2};
END

cat >"$work/case.yaml" <<'END'
title: a block with a crack inside
geometry: {width: 10 mm, height: 7 mm}
mesh: {file: block.msh, spacing: 0.5 mm}
nodes:
  horizon: 1.3 mm
  surface_correction: none
  sets: {corner: {lower: [0 mm, 0 mm, 0 mm], upper: [10 mm, 1 mm, 1 mm]}}
material: {model: solid, youngs_modulus: 3.24 GPa, density: 1190 kg/m3, fracture_energy: 20 J/m2}
cracks:
  precracks:
    - polygon: [[5 mm, 2 mm, 1.9 mm], [5 mm, 5.2 mm, 1.9 mm], [5 mm, 5.2 mm, 4.1 mm], [5 mm, 2 mm, 4.1 mm]]
loads:
  - {set: left, traction: [-12 MPa, 0 MPa, 0 MPa]}
  - {set: right, velocity: [4 m/s, free, free], ramp: 1 us}
  - {set: corner, body_force: [0 N/m^3, 0 N/m^3, 2e9*x N/m^3]}
no_fail: [left, right]
solver: {end_time: 8 us, checkpoint_every: 20 ms}
output: {every: 2 us, history_every: 0.5 us}
END

# The same rectangle as triangles, in millimetres.
cat >"$work/crack.stl" <<'END'
solid rectangle
facet normal 1 0 0
 outer loop
  vertex 5 2 1.9
  vertex 5 5.2 1.9
  vertex 5 5.2 4.1
 endloop
endfacet
facet normal 1 0 0
 outer loop
  vertex 5 2 1.9
  vertex 5 5.2 4.1
  vertex 5 2 4.1
 endloop
endfacet
endsolid rectangle
END

mesh() {
    [ -e "$work/block.msh" ] || gmsh -3 "$work/block.geo" -format msh41 -o "$work/block.msh"
}

# The programs on the mesh; its unit is the millimetre.
whole() { # threads, folder
    [ -d "$work/$2" ] && return
    mesh || return
    OMP_NUM_THREADS=$1 "$build/kirsch-nodes" "$work/block.msh" --unit mm --output "$work/now" "$work/case.yaml" &&
        OMP_NUM_THREADS=$1 "$build/kirsch-solve" --output "$work/now" "$work/case.yaml" &&
        mv "$work/now" "$work/$2"
}

equal() { # folder
    for file in history.csv run.h5 run.xdmf; do
        cmp "$work/$1/$file" "$work/two/$file" || return
    done
    diff -r "$work/$1/run" "$work/two/run"
}

threads() {
    whole 1 one && whole 2 two && equal one || return
    broken=$(tail -n 1 "$work/two/history.csv" | cut -d, -f8)
    echo "# figure $broken bonds broke; the results of one and two threads are equal byte by byte"
    [ "$broken" -gt 1000 ]
}

# Stopped by a signal and resumed, with other threads.
stopped() {
    whole 2 two && mkdir "$work/now" && cp "$work/two/plate.nodes.h5" "$work/now/" || return
    OMP_NUM_THREADS=1 "$build/kirsch-solve" --output "$work/now" "$work/case.yaml" >"$work/solve.log" 2>&1 &
    child=$!
    until [ -e "$work/now/checkpoint.h5" ] || ! kill -0 $child; do sleep 0.02; done
    kill -TERM $child
    wait $child
    code=$?
    cat "$work/solve.log"
    [ $code -eq 7 ] || return
    OMP_NUM_THREADS=2 "$build/kirsch-solve" --resume --output "$work/now" "$work/case.yaml" &&
        mv "$work/now" "$work/stopped" && equal stopped
}

# As triangles the rectangle cuts the same bonds, and all that follows is the same; only the deck in
# the files differs.
triangles() {
    whole 2 two && mkdir "$work/stl" && cp "$work/two/plate.nodes.h5" "$work/stl/" &&
        "$build/kirsch-solve" --set 'cracks.precracks=[{file: crack.stl, unit: 1 mm}]' --output "$work/stl" \
            "$work/case.yaml" && cmp "$work/stl/history.csv" "$work/two/history.csv" &&
        diff -r "$work/stl/run" "$work/two/run"
}

# A mesh of solids is no plate, and nodes of a plate are no solid.
models() {
    sed -e '/ sets:/d' -e '/^cracks/,/^no_fail/d' -e 's/model: solid/model: plane-strain/' "$work/case.yaml" \
        >"$work/plate.yaml"
    whole 2 two && stops 2 "is a mesh of solids, and this model is for plates; take solid" "$build/kirsch-nodes" \
        "$work/block.msh" --output "$work/other" "$work/plate.yaml" &&
        stops 2 "this model is for plates, but the node file holds a body in three dimensions" \
            "$build/kirsch-solve" --output "$work/two" "$work/plate.yaml"
}

beside() {
    whole 2 two && mkdir -p "$work/off" && cp "$work/two/plate.nodes.h5" "$work/off/" &&
        "$build/kirsch-solve" --output "$work/off" --set 'solver.end_time=1 us' --set 'output.every=1 us' \
            --set 'cracks.precracks=[{disc: {centre: [5 mm, 3 mm, 19 mm], normal: [0, 0, 1], radius: 2 mm}}]' \
            "$work/case.yaml" >"$work/off.log" 2>&1
    cat "$work/off.log"
    grep -q "the pre-crack crosses no bond" "$work/off.log"
}

# A tetrahedron's faces [mm], its foot at z = 3 mm and its top at this height.
tetrahedron() { # height
    awk -v top="$1" 'BEGIN {
        split("3 3 3|7 3 3|5 7 3|5 4 " top, p, "|")
        split("1 3 2|1 2 4|2 3 4|3 1 4", face, "|")
        print "solid pore"
        for (k = 1; k <= 4; k++) {
            split(face[k], c, " ")
            print "facet normal 0 0 0\nouter loop"
            for (m = 1; m <= 3; m++) print "vertex", p[c[m]]
            print "endloop\nendfacet"
        }
        print "endsolid pore"
    }'
}

# A file of triangles that has changed makes the mesh out of date, one that has not does not.
edited() { # key that names the file
    into=$work/edited
    rm -rf "$into" && mkdir "$into" && cat >"$into/case.yaml" <<END || return
geometry: {width: 10 mm, height: 10 mm, depth: 10 mm, $1}
mesh: {grid: uniform, spacing: 0.5 mm}
nodes: {horizon: 1.5 mm}
material: {model: solid, youngs_modulus: 3.24 GPa, density: 1190 kg/m3, fracture_energy: 200 J/m2}
solver: {end_time: 1 us}
END
    tetrahedron 7 >"$into/pore.stl"
    "$build/kirsch" --until mesh --output "$into" "$into/case.yaml" && cp "$into/plate.msh" "$into/first.msh" &&
        "$build/kirsch" --until mesh --output "$into" "$into/case.yaml" | grep -q "kirsch-mesh is up to date" &&
        tetrahedron 5 >"$into/pore.stl" || return
    "$build/kirsch" --until mesh --output "$into" "$into/case.yaml" || return
    ! cmp "$into/first.msh" "$into/plate.msh"
}

check one_and_two_threads_are_equal threads
check after_a_stop_is_equal stopped
check crack_of_triangles_is_that_of_a_polygon triangles
check mesh_and_model_must_agree models
check crack_beside_the_body_is_told beside
check void_that_is_edited_is_meshed_again edited 'voids: [{shape: stl, file: pore.stl, unit: 1 mm}]'
check body_that_is_edited_is_meshed_again edited 'body: {file: pore.stl, unit: 1 mm}'
echo "1..$count"
