#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Outlines from CAD files and pores of every kind, as a user asks for them. gmsh writes the STEP file.
prefix=geometry
. tests/cli/steps

cat >"$work/case.yaml" <<'DECK'
geometry:
  width: 40 mm
  height: 20 mm
  outline: {shape: cad, file: plate.step}
  holes:
    - {centre: [25 mm, 4 mm], radius: 2 mm}
mesh: {grid: voronoi, spacing: 0.2 mm}
nodes: {horizon: 0.8 mm}
material: {model: plane-stress, youngs_modulus: 3 GPa, density: 1190 kg/m3}
solver: {end_time: 1 us}
DECK
cat >"$work/porous.yaml" <<'DECK'
geometry:
  width: 20 mm
  height: 20 mm
  outline: {shape: ring, radius: 10 mm, inner_radius: 3 mm}
  pores: {radius: [0.3 mm, 1 mm], edge_diameters: 0.7, gap: 0.2 mm, seed: 5}
mesh: {grid: voronoi, spacing: 0.1 mm}
nodes: {horizon: 0.4 mm}
material: {model: plane-stress, youngs_modulus: 3 GPa, density: 1190 kg/m3}
solver: {end_time: 1 us}
DECK
# A plate with a bite of an ellipse in its corner, a round hole and one with a free curve for an edge.
cat >"$work/plate.geo" <<'GEO'
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 40, 20};
Disk(2) = {10, 10, 0, 3};
Disk(3) = {40, 20, 0, 5, 3};
Point(100) = {18, 8, 0}; Point(101) = {24, 9, 0}; Point(102) = {20, 15, 0};
Spline(100) = {100, 101, 102, 100};
Curve Loop(100) = {100};
Plane Surface(100) = {100};
BooleanDifference(200) = { Surface{1}; Delete; }{ Surface{2, 3, 100}; Delete; };
Save "plate.step";
GEO
printf 'SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 40, 20, 3}; Save "solid.step";\n' >"$work/solid.geo"
(cd "$work" && gmsh -0 plate.geo -v 1 && gmsh -0 solid.geo -v 1) >"$work/gmsh.log" 2>&1
mesh() { into=$1; shift; "$build/kirsch-mesh" --output "$work/$into" "$work/case.yaml" "$@"; }
pores() { into=$1; shift; "$build/kirsch-pores" --output "$work/$into" "$@" "$work/porous.yaml"; }

step_faces_are_outlines() {
    mesh step >"$work/report" && cat "$work/report" &&
        grep -aq '"hole_1"' "$work/step/plate.msh" && grep -aq '"hole_2"' "$work/step/plate.msh" &&
        grep -aq '"hole_3"' "$work/step/plate.msh" && ! grep -aq '"hole_4"' "$work/step/plate.msh" &&
        grep -aq '"outline"' "$work/step/plate.msh" && grep -aq '"top"' "$work/step/plate.msh"
}
# All but the free curve in closed form; its area by Simpson's rule on what OpenCASCADE tells, to the
# 1e-4 spacings of the arcs along 25 mm of edge.
step_areas_are_right() {
    mesh step --set geometry.holes=[] >"$work/report" || return
    area=$(sed -n 's/^  area \([0-9.]*\) mm.*/\1/p' "$work/report")
    spline=$(awk "BEGIN { print 800 - 9*3.14159265358979 - 15*3.14159265358979/4 - $area }")
    echo "# figure area of a free curve in a STEP file: $spline mm^2"
    wanted=$(cat "$work/spline")
    awk "BEGIN { exit !(($spline - $wanted)^2 < (25*2e-5)^2) }"
}
# Flat and extruded, on all grids: the cells have the area of the exact curves, or, of staircases, about it.
step_files_on_every_grid() {
    for grid in uniform near-boundary free voronoi; do
        for body in plate solid; do
            set -- --set mesh.grid=$grid --set mesh.spacing='0.5 mm' --set nodes.horizon='1.5 mm'
            [ $body = solid ] && set -- "$@" --set geometry.depth='2 mm' --set material.model=solid
            mesh step "$@" >"$work/report" || return
            cat "$work/report"
            off=$(sed -n 's/.* by \([-0-9.e+]*\) from the \(exact curves\|true surfaces\)$/\1/p' "$work/report")
            awk "BEGIN { exit !(\"$off\" != \"\" && ($off)^2 < (\"$grid\" == \"uniform\" ? 0.01 : 1e-12)^2) }" ||
                { echo "$grid, $body: off by $off"; return 1; }
        done
    done
}
solids_and_missing_files_stop() {
    stops 2 "solid.step: the file holds a solid" mesh bad --set geometry.outline.file=solid.step &&
        stops 2 "none.step cannot be read" mesh bad --set geometry.outline.file=none.step &&
        stops 2 "pores.txt" mesh bad --set geometry.pores.count=1 --set 'geometry.pores.radius=[1mm,2mm]' &&
        stops 2 "beyond the frame" mesh bad --set 'geometry.width=38mm'
}
porosity_is_met() {
    pores porous --set geometry.pores.porosity=0.15 >"$work/report" && cat "$work/report" &&
        grep -q 'porosity 15.00 %' "$work/report" &&
        awk '!/^#/ { sum += 3.14159265358979*$3*$3 }
             END { off = sum/(3.14159265358979*91e-6) - 0.15; exit !(off^2 < 1e-12) }' \
            "$work/porous/pores.txt"
}
pores_stay_in_the_ring() {
    pores ring --set geometry.pores.count=40 &&
        awk '!/^#/ { r = sqrt(($1 - 0.01)^2 + ($2 - 0.01)^2); n++
                     if (r + 1.4*$3 > 0.01 + 2e-7 || r - 1.4*$3 < 0.003 - 2e-7) exit 1 }
             END { exit n != 40 }' "$work/ring/pores.txt" &&
        "$build/kirsch-mesh" --output "$work/ring" --set geometry.pores.count=40 "$work/porous.yaml"
}
ellipses_have_their_aspect() {
    set -- --set geometry.pores.count=20 --set geometry.pores.shape=ellipse \
        --set 'geometry.pores.aspect=[1.5, 3]'
    pores ellipses "$@" &&
        awk '!/^#/ { n++; if (NF != 5 || $3/$4 < 1.499 || $3/$4 > 3.001 || $5 < 0 || $5 >= 180) exit 1 }
             END { exit n != 20 }' "$work/ellipses/pores.txt" &&
        "$build/kirsch-mesh" --output "$work/ellipses" "$@" "$work/porous.yaml"
}
what_cannot_be_met_says_how_far_it_got() {
    stops 2 'of [0-9]* pores found a place in 20000 throws: a porosity of [34][0-9.]* % instead of 60.00 %; ask' \
        pores none --set geometry.pores.porosity=0.6 --set geometry.pores.attempts=20000 &&
        [ ! -e "$work/none/pores.txt" ] &&
        stops 2 'less than half of one pore' pores none --set geometry.pores.porosity=0.0001
}
pores_of_the_papers_file_are_taken() {
    printf '  2\n    3.50000    9.00000    0.80000\n   15.50000   11.00000    0.90000\n' >"$work/paper.txt"
    pores paper --set geometry.pores.file=paper.txt &&
        grep -q '^0.003500000 0.009000000 0.000800000$' "$work/paper/pores.txt" &&
        printf '  3\n 3.5 9 0.8\n' >"$work/paper.txt" &&
        stops 2 'its first line says 3 pores, and 1 follow' pores paper --set geometry.pores.file=paper.txt &&
        printf '  1\n 3.5 9\n' >"$work/paper.txt" &&
        stops 2 "paper.txt:2: found ' 3.5 9', expected" pores paper --set geometry.pores.file=paper.txt
}

# What the loop of the spline holds, by quadrature along gmsh's own curve.
"$build/kirsch-gmsh" --curves step <"$work/plate.step" >"$work/curves" 2>"$work/gmsh.log"
awk '/^curve other/ { free = 1; n = 0; next } /^[a-z]/ { free = 0 }
     free { x[n] = $1; y[n] = $2; u[n] = $3; v[n++] = $4 }
     END { h = 1/(n - 1); for (k = 0; k < n; k++) { w = k == 0 || k == n - 1 ? 1 : k % 2 ? 4 : 2
               sum += w*(x[k]*v[k] - y[k]*u[k])/2 }
           print (sum < 0 ? -sum : sum)*span*h/3*1e6 }' span="$(awk '/^curve other/ { print $4 }' "$work/curves")" \
    "$work/curves" >"$work/spline"

# As tests/cli/nodes.sh has it for bodies.
step_wherever_the_programs_lie() {
    mkdir -p "$work/bin" && cp "$build/kirsch-mesh" "$work/bin" &&
        printf '#!/bin/sh\necho "Error   : called as $0 $* in $PWD" >&2\nexit 1\n' >"$work/bin/kirsch-gmsh" &&
        chmod +x "$work/bin/kirsch-gmsh" &&
        stops 2 'plate.step: called as /proc/self/fd/3 --curves step in /$' \
            "$work/bin/kirsch-mesh" --output "$work/lies" "$work/case.yaml"
}

for name in step_wherever_the_programs_lie step_faces_are_outlines step_areas_are_right step_files_on_every_grid solids_and_missing_files_stop \
    porosity_is_met pores_stay_in_the_ring ellipses_have_their_aspect \
    what_cannot_be_met_says_how_far_it_got pores_of_the_papers_file_are_taken; do
    check $name $name
done
echo "1..$count"
