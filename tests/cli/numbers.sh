#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Numbers that cannot be meant: a unit mistaken by a thousand, NaN and infinity, counts beyond any machine,
# areas of nothing, nodes at one place. Each is stopped at once, by name and with a cure.
prefix=numbers
. tests/cli/steps
write_case

deck() { # words, setting...
    words=$1
    shift
    for setting in "$@"; do set -- "$@" --set "$setting" && shift; done
    stops 2 "$words" "$build/kirsch-solve" --check "$@" "$work/case.yaml"
}

# A file of these lines, converted.
file() { # ending, words, lines
    printf '%b' "$3" >"$work/given.$1"
    stops 2 "$2" "$build/kirsch-nodes" --convert "$work/given.$1" --output "$work/into"
}

check stiffer_by_a_thousand deck 'faster than in any solid' material.youngs_modulus='3240 GPa'
check lighter_by_a_thousand deck 'faster than in any solid' material.density='1.19 kg/m3'
check softer_by_a_thousand deck 'look at the units' material.youngs_modulus='3.24 MPa'
check tougher_by_a_thousand deck 'look at the units' material.fracture_energy='50 kJ/m2'
check horizon_below_the_spacing deck 'it must be at least 2' nodes.horizon='0.4 mm'
check horizon_in_metres deck "more than the plate's narrower side" nodes.horizon='1.5 m'
check absurd_spacing deck 'take a coarser spacing' mesh.spacing='1e-12 mm' nodes.horizon='4e-12 mm'
check spacing_that_underflows deck 'take a coarser spacing' mesh.spacing='1e-300 mm' nodes.horizon='1e-299 mm'
check endless_outputs deck 'at most a million' solver.end_time='1e9 s'
check a_count_beyond_64_bits deck 'it is too large' geometry.pores.count=99999999999999999999

# NaN and infinity in every number of the reference of keys that has a unit or is plain.
not_numbers() {
    tried=0
    for key in geometry.width geometry.height mesh.spacing mesh.padding nodes.horizon material.youngs_modulus \
        material.density material.fracture_energy material.poissons_ratio solver.end_time solver.time_step \
        solver.safety_factor solver.checkpoint_every output.every output.history_every output.damage_threshold \
        geometry.holes.0.radius geometry.pores.porosity geometry.pores.edge_diameters loads.0.ramp; do
        for word in nan inf -inf 1e999; do
            for value in "$word" "$word mm" "$word s" "$word Pa"; do
                "$build/kirsch-solve" --check --set "$key=$value" "$work/case.yaml" >"$work/said.one" 2>&1
                code=$?
                [ $code -eq 2 ] && grep -q "$key: found '$value', .*expected" "$work/said.one" ||
                    { echo "$key = $value: exit $code"; cat "$work/said.one"; return 1; }
                tried=$((tried + 1))
            done
        done
    done
    echo "# figure $tried values that are no numbers, all refused"
}
check no_numbers_are_refused not_numbers

check volume_of_nothing file csv ':3: the volume is 0; expected a positive' 'x,y,volume\n0,0,1\n1,0,0\n'
check negative_volume file csv ':3: the volume is -1; expected a positive' 'x,y,volume\n0,0,1\n1,0,-1\n'
check volume_not_a_number file csv ":3: expected a volume, found 'nan'" 'x,y,volume\n0,0,1\n1,0,nan\n'
check place_at_infinity file csv ":3: expected y, found 'inf'" 'x,y,volume\n0,0,1\n1,inf,1\n'
check place_beyond_squares file csv 'stands at -1e+308 m; expected at most' 'x,y,volume\n0,0,1\n1e308,0,1\n-1e308,0,1\n'
check two_nodes_at_one_place file csv 'stand at one place' 'x,y,volume\n0,0,1\n1,0,1\n0,0,1\n'
check more_nodes_than_bytes file msh 'more than the rest of the file can hold' \
    '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1000000000000000000\n1 0 0 0\n$EndNodes\n'
check a_count_of_all_bits file msh "found '18446744073709551615'" \
    '$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 18446744073709551615 1 18446744073709551615\n'
check coordinate_not_a_number file msh ':6: a coordinate of a node is not finite' \
    '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 nan 0\n$EndNodes\n'
check a_number_beyond_dat file dat ":1: found '99999999999999999999'" '99999999999999999999\n'
echo "1..$count"
