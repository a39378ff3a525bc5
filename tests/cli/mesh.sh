#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# kirsch-pores and kirsch-mesh as a user runs them: files, report, and what stops them.
prefix=mesh
. tests/cli/steps

cat >"$work/case.yaml" <<'DECK'
title: a small porous plate
geometry:
  width: 10 mm
  height: 6 mm
  holes:
    - {centre: [2 mm, 3 mm], radius: 0.8 mm}
  pores: {count: 4, radius: [0.4 mm, 0.6 mm], gap: 0.3 mm, seed: 5}
mesh: {grid: near-boundary, spacing: 0.1 mm}
nodes: {horizon: 0.4 mm}
material: {law: pmb, model: plane-stress, youngs_modulus: 3 GPa, density: 1190 kg/m3}
loads:
  - {set: top, traction: [free, 1 MPa]}
solver: {end_time: 1 us}
output: {every: 1 us}
DECK
run() { # program, folder, option...
    run=$build/kirsch-$1
    into=$work/$2
    shift 2
    "$run" --output "$into" "$work/case.yaml" "$@"
}
pores() { run pores "$@"; }
mesh() { run mesh "$@"; }

pores_are_written() {
    pores one && [ "$(grep -vc '^#' "$work/one/pores.txt")" = 4 ] &&
        sed -n 1p "$work/one/pores.txt" | grep -q '^# .*seed 5'
}
the_same_seed_writes_the_same_bytes() {
    pores one && pores two && cmp "$work/one/pores.txt" "$work/two/pores.txt" &&
        pores two --set geometry.pores.seed=6 && ! cmp -s "$work/one/pores.txt" "$work/two/pores.txt"
}
too_many_pores_stop() {
    stops 2 "geometry.pores.count: only " pores three --set geometry.pores.count=60 &&
        grep -q 'of 60 pores found a place in 100000 throws (porosity [0-9.]* %)' "$work/stop" &&
        grep -q 'a smaller gap' "$work/stop" && [ ! -e "$work/three/pores.txt" ]
}
the_mesh_is_written_with_its_report() {
    pores one && mesh one && [ -s "$work/one/plate.msh" ] && ! ls "$work/one" | grep part &&
        mesh one | grep -q '5 holes, spacing 0.1 mm, near-boundary grid' &&
        mesh one | grep -q 'region around hole.*1.*: [0-9]* cells, [0-9]* triangles, .* blossom' &&
        grep -qa '"hole_5"' "$work/one/plate.msh" && ! grep -qa '"hole_6"' "$work/one/plate.msh"
}
two_meshings_are_equal() {
    pores one && pores two && mesh one && mesh two && cmp "$work/one/plate.msh" "$work/two/plate.msh"
}
missing_pores_stop() {
    stops 2 "pores.txt" mesh four
}
a_spacing_that_does_not_fit_stops() {
    pores one && stops 2 "mesh.spacing: found 0.0903 mm" mesh one --set mesh.spacing='0.0903 mm'
}
explain_writes_nothing() {
    pores one && rm -f "$work/one/plate.msh" && mesh one --explain && [ ! -e "$work/one/plate.msh" ]
}
a_missing_kirsch_gmsh_is_told() {
    pores one && cp "$build/kirsch-mesh" "$work/kirsch-mesh" &&
        stops 5 "the program kirsch-gmsh is missing: it should stand at $work/kirsch-gmsh" \
            "$work/kirsch-mesh" --output "$work/one" "$work/case.yaml"
}
kirsch_gmsh_alone_says_what_it_is() {
    stops 1 "this program is run by kirsch-mesh" "$build/kirsch-gmsh" </dev/null
}

# gmsh's cells must not hang on where the programs lie, nor on the folder in which they are started.
wherever_the_programs_lie() {
    for folder in a build a/folder/with/a/much/longer/name; do
        mkdir -p "$work/bin/$folder" "$work/cells" &&
            cp "$build/kirsch-mesh" "$build/kirsch-gmsh" "$work/bin/$folder/" || return
        deck=$PWD/cases/hole-failure/case.yaml
        (cd "$work/bin/$folder" && ./kirsch-mesh --output "$work/cells" "$deck") || return
        [ -e "$work/first.msh" ] || cp "$work/cells/plate.msh" "$work/first.msh"
        cmp "$work/cells/plate.msh" "$work/first.msh" || return
    done
}

for name in pores_are_written the_same_seed_writes_the_same_bytes too_many_pores_stop \
    the_mesh_is_written_with_its_report two_meshings_are_equal wherever_the_programs_lie missing_pores_stop \
    a_spacing_that_does_not_fit_stops explain_writes_nothing a_missing_kirsch_gmsh_is_told \
    kirsch_gmsh_alone_says_what_it_is; do
    check $name $name
done
echo "1..$count"
