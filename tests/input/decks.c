/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Wrong decks and the exact words that the user gets. Each row changes one thing in a right deck;
 * the text ends with the count of faults, so that a second, needless one fails the test too.
 */
#include "test.h"

#include "base/error.h"
#include "base/unit.h"
#include "case.h"

static const char right[] =
    "title: a plate\n"
    "geometry:\n"
    "  width: 50 mm\n"
    "  height: 25 mm\n"
    "  holes:\n"
    "    - {centre: [10 mm, 12.5 mm], radius: 2 mm}\n"
    "  pores: {count: 3, radius: [0.2 mm, 0.5 mm]}\n"
    "mesh:\n"
    "  grid: uniform\n"
    "  spacing: 0.1 mm\n"
    "nodes:\n"
    "  horizon: 0.31 mm\n"
    "  sets:\n"
    "    top: {within: 0.3 mm, of: top}\n"
    "    bottom: {within: 0.3 mm, of: bottom}\n"
    "material:\n"
    "  model: plane-stress\n"
    "  youngs_modulus: 3.2 GPa\n"
    "  density: 1190 kg/m3\n"
    "cracks:\n"
    "  count_precrack: true\n"
    "  precracks: [{from: [0 mm, 12 mm], to: [3 mm, 12 mm]}]\n"
    "loads:\n"
    "  - {set: top, traction: [free, 6 MPa]}\n"
    "  - {set: bottom, velocity: [free, -0.3 m/s], ramp: 10 us}\n"
    "no_fail: [top]\n"
    "solver: {end_time: 50 us}\n"
    "output: {every: 1 us, at: [2 us, 3.5 us]}\n"
    "track:\n"
    "  boxes: [{lower: [0 mm, 0 mm], upper: [50 mm, 25 mm], direction: +x}]\n"
    "variants:\n"
    "  full: {mesh.spacing: 0.04 mm}\n";

static const struct row {
    const char *name, *find, *replace, *variant, *set, *said;
    int meshes; /* as a program that makes the mesh reads it */
} rows[] = {
    {"deck_unknown_key_near", "  horizon: 0.31 mm", "  horizn: 0.31 mm", NULL, NULL,
     "case.yaml:12:3: nodes.horizn: unknown key; did you mean 'horizon'?\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_unknown_key_with_letters_exchanged", "  width: 50 mm", "  wdith: 50 mm", NULL, NULL,
     "case.yaml:3:3: geometry.wdith: unknown key; did you mean 'width'?\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_unknown_key_in_other_case", "  horizon: 0.31 mm", "  Horizon: 0.31 mm", NULL, NULL,
     "case.yaml:12:3: nodes.Horizon: unknown key; did you mean 'horizon'?\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_unknown_key_with_underscore", "end_time", "end-time", NULL, NULL,
     "case.yaml:27:10: solver.end-time: unknown key; did you mean 'end_time'?\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_unknown_key_of_another_section", "  grid: uniform", "  grid: uniform\n  horizon: 1 mm",
     NULL, NULL,
     "case.yaml:10:3: mesh.horizon: unknown key; 'horizon' belongs to section 'nodes'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_unknown_key_near_one_of_another_section", "  grid: uniform",
     "  grid: uniform\n  denstiy: 1 kg/m3", NULL, NULL,
     "case.yaml:10:3: mesh.denstiy: unknown key; did you mean 'material.density'?\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_unknown_key_far_from_all", "  grid: uniform", "  wibble: 3", NULL, NULL,
     "case.yaml:9:3: mesh.wibble: unknown key; known here: file, grid, spacing, padding, lloyd_steps\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_unknown_section", "track:", "tracks:", NULL, NULL,
     "case.yaml:29:1: tracks: unknown key; did you mean 'track'?\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_unknown_key_in_a_list", "radius: 2 mm", "radius: 2 mm, radiuss: 2 mm", NULL, NULL,
     "case.yaml:6:48: geometry.holes.0.radiuss: unknown key; did you mean 'radius'?\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_missing_key", "  density: 1190 kg/m3\n", "", NULL, NULL,
     "case.yaml:17:3: material.density: missing; expected a density in kg/m^3\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_missing_section", "solver: {end_time: 50 us}\n", "", NULL, NULL,
     "case.yaml:1:1: solver.end_time: missing; expected a time in us, or `stages`\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_missing_key_of_an_empty_section", "solver: {end_time: 50 us}", "solver:", NULL, NULL,
     "case.yaml:27:1: solver.end_time: missing; expected a time in us, or `stages`\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_missing_value", "  density: 1190 kg/m3", "  density:", NULL, NULL,
     "case.yaml:19:3: material.density: found nothing, expected a density in kg/m^3\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_key_given_twice", "  horizon: 0.31 mm", "  horizon: 0.31 mm\n  horizon: 0.4 mm", NULL,
     NULL,
     "case.yaml:13:3: nodes.horizon: given twice; the first is in line 12\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_section_given_twice", "title: a plate", "title: a plate\nmesh: {spacing: 1 mm}", NULL,
     NULL,
     "case.yaml:9:1: mesh: given twice; the first is in line 2\n"
     "case.yaml:13:12: nodes.horizon: 0.00031 m is 0.31 spacings; it must be at least 2, and 3 to "
     "6 are usual\n"
     "kirsch: 2 faults in case.yaml; nothing was done\n"},
    {"deck_length_without_unit", "  horizon: 0.31 mm", "  horizon: 0.31", NULL, NULL,
     "case.yaml:12:12: nodes.horizon: found '0.31', expected a length with its unit, such as '0.31 "
     "mm'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_length_with_a_mass_unit", "  horizon: 0.31 mm", "  horizon: 0.31 kg", NULL, NULL,
     "case.yaml:12:12: nodes.horizon: found '0.31 kg', whose unit 'kg' is of another kind; "
     "expected a length, such as '0.31 mm'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_length_with_an_unknown_unit", "  horizon: 0.31 mm", "  horizon: 0.31 mmm", NULL, NULL,
     "case.yaml:12:12: nodes.horizon: found '0.31 mmm', whose unit 'mmm' is unknown; expected a "
     "length, such as '0.31 mm'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_length_of_words", "  horizon: 0.31 mm", "  horizon: three spacings", NULL, NULL,
     "case.yaml:12:12: nodes.horizon: found 'three spacings', expected a length with its unit, "
     "such as '1 mm'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_length_not_a_number", "  horizon: 0.31 mm", "  horizon: .nan", NULL, NULL,
     "case.yaml:12:12: nodes.horizon: found '.nan', expected a length with its unit, such as '1 "
     "mm'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_length_as_a_list", "  horizon: 0.31 mm", "  horizon: [0.31 mm]", NULL, NULL,
     "case.yaml:12:13: nodes.horizon: found a list of 1, expected a length in mm\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_pure_number_with_unit", "end_time: 50 us", "end_time: 50 us, safety_factor: 80 %", NULL,
     NULL,
     "case.yaml:27:42: solver.safety_factor: found '80 %', expected a pure number, without a unit\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_number_out_of_range", "end_time: 50 us", "end_time: 50 us, safety_factor: 1.2", NULL,
     NULL,
     "case.yaml:27:42: solver.safety_factor: found '1.2', expected at most 1\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_number_at_an_open_bound", "width: 50 mm", "width: 0 mm", NULL, NULL,
     "case.yaml:3:10: geometry.width: found '0 mm', expected more than 0 m\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_integer_with_a_fraction", "track:", "track:\n  window: 3.5", NULL, NULL,
     "case.yaml:30:11: track.window: found '3.5', expected a whole number\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_integer_too_large", "track:", "track:\n  window: 99999999999999999999", NULL, NULL,
     "case.yaml:30:11: track.window: found '99999999999999999999', expected a whole number; it is "
     "too large\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_integer_as_a_list", "track:", "track:\n  window: [3]", NULL, NULL,
     "case.yaml:30:12: track.window: found a list of 1, expected a whole number\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_integer_left_empty", "track:", "track:\n  window:", NULL, NULL,
     "case.yaml:30:3: track.window: found nothing, expected a whole number\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_faults_in_the_order_of_lines", "10 us}\nno_fail: [top]", "10}\nno_fail: top", NULL, NULL,
     "case.yaml:25:53: loads.1.ramp: found '10', expected a time with its unit, such as '10 us'\n"
     "case.yaml:26:10: no_fail: found 'top', expected a list of texts\n"
     "kirsch: 2 faults in case.yaml; nothing was done\n"},
    {"deck_integer_out_of_range", "track:", "track:\n  window: 0", NULL, NULL,
     "case.yaml:30:11: track.window: found '0', expected at least 1\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_boolean_of_yaml_1_1", "  count_precrack: true", "  count_precrack: yes", NULL, NULL,
     "case.yaml:21:19: cracks.count_precrack: found 'yes', expected true or false\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_word_near", "model: plane-stress", "model: plane-strss", NULL, NULL,
     "case.yaml:17:10: material.model: found 'plane-strss', expected one of plane-stress, "
     "plane-strain, solid; did you mean 'plane-stress'?\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_word_far", "model: plane-stress", "model: thick", NULL, NULL,
     "case.yaml:17:10: material.model: found 'thick', expected one of plane-stress, plane-strain, "
     "solid\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_vector_too_short", "centre: [10 mm, 12.5 mm]", "centre: [10 mm]", NULL, NULL,
     "case.yaml:6:17: geometry.holes.0.centre: found a list of 1, expected a list of 2, each a "
     "length in mm\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_vector_as_one_number", "centre: [10 mm, 12.5 mm]", "centre: 10 mm", NULL, NULL,
     "case.yaml:6:16: geometry.holes.0.centre: found '10 mm', expected a list of 2, each a length "
     "in mm\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_vector_with_a_bare_number", "centre: [10 mm, 12.5 mm]", "centre: [10 mm, 12.5]", NULL,
     NULL,
     "case.yaml:6:24: geometry.holes.0.centre.1: found '12.5', expected a length with its unit, "
     "such as '12.5 mm'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_list_as_a_section", "    - {centre: [10 mm, 12.5 mm], radius: 2 mm}",
     "    centre: [10 mm, 12.5 mm]", NULL, NULL,
     "case.yaml:6:5: geometry.holes: found a section, expected a list ('- ...') of items with "
     "centre, radius, shape, radii, size, length, width, points, corner_radius, angle\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_item_as_a_text", "    - {centre: [10 mm, 12.5 mm], radius: 2 mm}", "    - big", NULL,
     NULL,
     "case.yaml:6:7: geometry.holes.0: found 'big', expected keys and values, such as 'centre: "
     "...'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_section_as_a_text", "solver: {end_time: 50 us}", "solver: fast", NULL, NULL,
     "case.yaml:27:9: solver: found 'fast', expected a section with end_time, time_step, "
     "precision, safety_factor, checkpoint_every, checkpoint_steps\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_map_as_a_list",
     "  sets:\n    top: {within: 0.3 mm, of: top}\n    bottom: {within: 0.3 mm, of: bottom}",
     "  sets: [top, bottom]", NULL, NULL,
     "case.yaml:13:10: nodes.sets: found a list of 2, expected names, each with within, of, lower, "
     "upper, centre, radius, through, normal, points, union, intersection, difference, not\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_text_as_a_section", "title: a plate", "title: {a: plate}", NULL, NULL,
     "case.yaml:1:9: title: found a section, expected a text\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_texts_as_a_text", "no_fail: [top]", "no_fail: top", NULL, NULL,
     "case.yaml:26:10: no_fail: found 'top', expected a list of texts\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_time_of_a_list_without_unit", "at: [2 us, 3.5 us]", "at: [2 us, 3.5]", NULL, NULL,
     "case.yaml:28:34: output.at.1: found '3.5', expected a time with its unit, such as '3.5 us'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_alias", "  density: 1190 kg/m3", "  density: &d 1190 kg/m3\n  fracture_energy: *d", NULL,
     NULL,
     "case.yaml:20:21: material.fracture_energy: an alias ('*name'); write the value out\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_tag", "title: a plate", "title: !important a plate", NULL, NULL,
     "case.yaml:1:19: title: a YAML tag ('!name'), which decks do not use\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_formula_without_unit", "[free, 6 MPa]", "[free, 6]", NULL, NULL,
     "case.yaml:24:33: loads.0.traction.1: found '6', expected a stress with its unit at the end, "
     "such as '6 MPa'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_formula_with_another_unit", "[free, 6 MPa]", "[free, 6 kg]", NULL, NULL,
     "case.yaml:24:33: loads.0.traction.1: found '6 kg', whose unit 'kg' is of another kind; "
     "expected a stress, such as '6 MPa'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_formula_with_an_unknown_name", "[free, 6 MPa]", "[free, 6*sin(q) MPa]", NULL, NULL,
     "case.yaml:24:33: loads.0.traction.1: found '6*sin(q) MPa': unexpected token \"q\" found at "
     "position 6; expected numbers, x, y, z [m], t [s] and functions such as sin and min\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_formula_with_a_comma_unquoted", "[free, 6 MPa]", "[free, 6*min(t, 1) MPa]", NULL, NULL,
     "case.yaml:24:27: loads.0.traction: found a list of 3, expected a list of at most 3, each an "
     "expression in x, y, z, t and then a stress in MPa, or 'free'; put an expression with commas "
     "in quotes\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_formula_not_finite", "[free, 6 MPa]", "[free, 6/0 MPa]", NULL, NULL,
     "case.yaml:24:33: loads.0.traction.1: found '6/0 MPa': its value is not finite\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_formula_not_finite_in_si", "[free, 6 MPa]", "[free, 3e302*2 MPa]", NULL, NULL,
     "case.yaml:24:33: loads.0.traction.1: found '3e302*2 MPa': its value is not finite\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_formula_with_a_number_too_small", "[free, 6 MPa]", "[free, 6*x/1e-400 MPa]", NULL, NULL,
     "case.yaml:24:33: loads.0.traction.1: found '6*x/1e-400 MPa', expected a stress between 2.2e-308 and "
     "1.8e308 in SI units, such as '1 MPa'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_number_too_large", "density: 1190 kg/m3", "density: 1e400 kg/m3", NULL, NULL,
     "case.yaml:19:12: material.density: found '1e400 kg/m3', expected a density between 2.2e-308 and 1.8e308 in "
     "SI units, such as '1 kg/m^3'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_formula_with_assignment", "[free, 6 MPa]", "[free, \"x=6 MPa\"]", NULL, NULL,
     "case.yaml:24:33: loads.0.traction.1: found 'x=6 MPa': '=' assigns, which an expression may "
     "not; '==' compares; expected numbers, x, y, z [m], t [s] and functions such as sin and min\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_formula_in_no_list", "[free, 6 MPa]", "6 MPa", NULL, NULL,
     "case.yaml:24:26: loads.0.traction: found '6 MPa', expected a list of at most 3, each an "
     "expression in x, y, z, t and then a stress in MPa, or 'free'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_solid_load_on_a_plate", "[free, 6 MPa]", "[free, 6 MPa, 0 MPa]", NULL, NULL,
     "case.yaml:24:27: loads.0.traction: found 3 components, expected 2: the model is a plate; "
     "material.model: solid has three\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_load_of_one_component", "[free, 6 MPa]", "[6 MPa]", NULL, NULL,
     "case.yaml:24:27: loads.0.traction: found 1 component, expected 2: the model is a plate; "
     "material.model: solid has three\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_solid_with_loads_of_a_plate", "model: plane-stress", "model: solid", NULL,
     "cracks.precracks=[]",
     "case.yaml:24:27: loads.0.traction: found 2 components, expected 3: the model is solid\n"
     "case.yaml:25:30: loads.1.velocity: found 2 components, expected 3: the model is solid\n"
     "kirsch: 2 faults in case.yaml; nothing was done\n"},
    {"deck_solid_box_on_a_plate", "{within: 0.3 mm, of: top}",
     "{lower: [0 mm, 0 mm, 0 mm], upper: [1 mm, 1 mm, 1 mm]}", NULL, NULL,
     "case.yaml:14:19: nodes.sets.top.lower: found 3 components, expected 2: the model is a plate; "
     "material.model: solid has three\n"
     "case.yaml:14:46: nodes.sets.top.upper: found 3 components, expected 2: the model is a plate; "
     "material.model: solid has three\n"
     "kirsch: 2 faults in case.yaml; nothing was done\n"},
    {"deck_load_of_two_kinds", "traction: [free, 6 MPa]",
     "traction: [free, 6 MPa], velocity: [free, 3 m/s]", NULL, NULL,
     "case.yaml:24:27: loads.0.traction: a load has just one of displacement, velocity, traction "
     "and body_force; make it a load of its own\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_load_of_no_kind", ", traction: [free, 6 MPa]", "", NULL, NULL,
     "case.yaml:24:11: loads.0.set: the load does nothing; expected one of displacement, velocity, "
     "traction and body_force\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_load_free_altogether", "[free, 6 MPa]", "[free, free]", NULL, NULL,
     "case.yaml:24:27: loads.0.traction: all components are free; the load does nothing\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_with_a_bad_name", "    top: {within", "    \"top edge\": {within", NULL, NULL,
     "case.yaml:14:18: nodes.sets.top edge: a set's name may have letters, digits, '_' and '-', no "
     "others\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_of_two_kinds", "of: top}", "of: top, lower: [0 mm, 0 mm], upper: [1 mm, 1 mm]}",
     NULL, NULL,
     "case.yaml:14:11: nodes.sets.top: both a boundary (within, of) and a box (lower, upper); a "
     "set is one of them\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_of_a_polygon_of_two", "{within: 0.3 mm, of: top}",
     "{points: [[0 mm, 0 mm], [1 mm, 1 mm]]}", NULL, NULL,
     "case.yaml:14:21: nodes.sets.top.points: found 2 corners, expected 3 or more\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_of_no_direction", "{within: 0.3 mm, of: top}",
     "{through: [0 mm, 0 mm], normal: [0, 0]}", NULL, NULL,
     "case.yaml:14:43: nodes.sets.top.normal: all components are 0; expected a direction\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_uniaxial_z_of_a_plate", "  sets:", "  surface_deformation: uniaxial-z\n  sets:", NULL, NULL,
     "case.yaml:13:24: nodes.surface_deformation: uniaxial-z is for bodies in 3D; a plate has x and y\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_of_no_kind", "{within: 0.3 mm, of: top}", "{}", NULL, NULL,
     "case.yaml:14:5: nodes.sets.top: empty; expected 'within' and 'of', 'lower' and 'upper', 'centre' "
     "and 'radius', 'through' and 'normal', 'points', 'union', 'intersection', 'difference' or 'not'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_half_given", "{within: 0.3 mm, of: top}", "{within: 0.3 mm}", NULL, NULL,
     "case.yaml:14:11: nodes.sets.top: 'within' goes with 'of', which is missing\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_with_a_box_inside_out", "{within: 0.3 mm, of: top}",
     "{lower: [0 mm, 2 mm], upper: [1 mm, 1 mm]}", NULL, NULL,
     "case.yaml:14:40: nodes.sets.top.upper: y = 0.001 m is not above that of `lower`, 0.002 m\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_given_twice", "    bottom: {within", "    top: {within", NULL, NULL,
     "case.yaml:15:5: nodes.sets.top: given twice; the first is in line 14\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_horizon_below_two_spacings", "  horizon: 0.31 mm", "  horizon: 0.19 mm", NULL, NULL,
     "case.yaml:12:12: nodes.horizon: 0.00019 m is 1.9 spacings; it must be at least 2, and 3 to 6 "
     "are usual\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_horizon_above_the_plate", "  horizon: 0.31 mm", "  horizon: 31 mm", NULL, NULL,
     "case.yaml:12:12: nodes.horizon: 0.031 m is more than the plate's narrower side of 0.025 m\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_spacing_above_the_plate", "  spacing: 0.1 mm", "  spacing: 20 mm", NULL, NULL,
     "case.yaml:10:12: mesh.spacing: 0.02 m is more than half of the plate's narrower side of "
     "0.025 m; a plate needs many cells across\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_spacing_gives_too_many_nodes", "  spacing: 0.1 mm", "  spacing: 1 nm", NULL, NULL,
     "case.yaml:10:12: mesh.spacing: 1e-09 m gives 1.2e+15 nodes on this plate, more than 2e+09; "
     "take a coarser spacing\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_hole_outside_the_plate", "centre: [10 mm, 12.5 mm]", "centre: [53 mm, 12.5 mm]", NULL,
     NULL,
     "case.yaml:6:17: geometry.holes.0.centre: the hole lies outside the plate of 0.05 m x 0.025 "
     "m, 0.001 m from it\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_polygon_whose_sides_cross", "radius: 2 mm",
     "shape: polygon, points: [[0 mm, 0 mm], [2 mm, 2 mm], [2 mm, 0 mm], [0 mm, 2.5 mm]]", NULL, NULL,
     "case.yaml:6:88: geometry.holes.0.points.2.0: the side from here to the next corner meets the one behind "
     "corner 0, expected corners in turn around the shape, the first is 0\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_polygon_that_touches_itself", "radius: 2 mm",
     "shape: polygon, points: [[0 mm, 0 mm], [2 mm, 0 mm], [2 mm, 2 mm], [1 mm, 0 mm], [0 mm, 2 mm]]", NULL,
     NULL,
     "case.yaml:6:88: geometry.holes.0.points.2.0: the side from here to the next corner meets the one behind "
     "corner 0, expected corners in turn around the shape, the first is 0\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_polygon_with_a_corner_twice", "radius: 2 mm",
     "shape: polygon, points: [[0 mm, 0 mm], [2 mm, 0 mm], [1 mm, 2 mm], [0 mm, 0 mm]]", NULL, NULL,
     "case.yaml:6:102: geometry.holes.0.points.3.0: found corner 0 again, expected another; the shape closes by "
     "itself\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_hole_larger_than_the_plate", "radius: 2 mm", "radius: 26 mm", NULL, NULL,
     "case.yaml:6:42: geometry.holes.0.radius: the hole's diameter of 0.052 m is more than the "
     "plate's longer side\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_voids_without_depth", "  height: 25 mm\n",
     "  height: 25 mm\n  voids: [{centre: [5 mm, 5 mm, 1 mm], radius: 1 mm}]\n", NULL, NULL,
     "case.yaml:5:12: geometry.voids: voids need a solid; expected geometry.depth: 10 mm\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_depth_of_no_layers", "  height: 25 mm\n", "  height: 25 mm\n  depth: 1.04 mm\n", NULL, NULL,
     "case.yaml:5:10: geometry.depth: 0.00104 m is no whole number of spacings of 0.0001 m; the "
     "nearest that is: 0.001 m\n"
     "case.yaml:5:10: geometry.depth: makes a solid, and material.model is for plates; take solid, or leave the depth "
     "out\n"
     "kirsch: 2 faults in case.yaml; nothing was done\n"},
    {"deck_void_of_another_shape", "  height: 25 mm\n",
     "  height: 25 mm\n  depth: 2 mm\n  voids: [{shape: cylinder, centre: [5 mm, 5 mm, 1 mm], radius: 1 mm}]\n",
     NULL, NULL,
     "case.yaml:5:10: geometry.depth: makes a solid, and material.model is for plates; take solid, or leave the depth "
     "out\n"
     "case.yaml:6:12: geometry.voids.0.length: missing; expected length: 4 mm for shape cylinder\n"
     "kirsch: 2 faults in case.yaml; nothing was done\n"},
    {"deck_void_outside", "  height: 25 mm\n",
     "  height: 25 mm\n  depth: 2 mm\n  voids: [{centre: [5 mm, 5 mm, 4 mm], radius: 1 mm}]\n", NULL, NULL,
     "case.yaml:5:10: geometry.depth: makes a solid, and material.model is for plates; take solid, or leave the depth "
     "out\n"
     "case.yaml:6:21: geometry.voids.0.centre: the void lies outside the body of 0.05 m x 0.025 m x "
     "0.002 m, 0.001 m from it\n"
     "kirsch: 2 faults in case.yaml; nothing was done\n"},
    {"deck_pores_by_two_words", "count: 3,", "count: 3, porosity: 0.1,", NULL, NULL,
     "case.yaml:7:31: geometry.pores.porosity: pores are given by just one of count, porosity and "
     "file\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_pores_normal_without_mean", "count: 3,", "count: 3, distribution: normal, mean: 0.3 mm,",
     NULL, NULL,
     "case.yaml:7:11: geometry.pores.deviation: missing; expected deviation of the radius, such as "
     "'0.3 mm', for distribution normal\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_pores_round_with_aspect", "count: 3,", "count: 3, aspect: [1, 2],", NULL, NULL,
     "case.yaml:7:30: geometry.pores.aspect: shape circle has no aspect\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_outline_beginning_with_a_difference", "  pores:",
     "  outline: {parts: [{operation: difference}]}\n  pores:", NULL, NULL,
     "case.yaml:7:33: geometry.outline.parts.0.operation: before the first part there is nothing to "
     "take it from; begin with a union\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_outline_of_shape_and_parts", "  pores:",
     "  outline: {radius: 1 mm, parts: [{shape: rectangle}]}\n  pores:", NULL, NULL,
     "case.yaml:7:36: geometry.outline.parts: an outline of parts has no shape of its own; make it "
     "the first part\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_outline_part_named_as_a_side", "  pores:",
     "  outline: {parts: [{shape: rectangle, name: left}]}\n  pores:", NULL, NULL,
     "case.yaml:7:46: geometry.outline.parts.0.name: 'left' is the name of another boundary; take "
     "one of its own\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_outline_part_beyond_the_frame", "  pores:",
     "  outline: {parts: [{shape: rectangle, size: [60 mm, 2 mm]}]}\n  pores:", NULL, NULL,
     "case.yaml:7:47: geometry.outline.parts.0.size: the corner at (-0.005, 0.0115) m lies outside "
     "width by height, 0.05 m x 0.025 m\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_outline_of_cad_without_file", "  pores:", "  outline: {shape: cad}\n  pores:", NULL, NULL,
     "case.yaml:7:13: geometry.outline.file: missing; expected file: plate.step for shape cad\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_pores_without_radius", "pores: {count: 3, radius: [0.2 mm, 0.5 mm]}",
     "pores: {count: 3}", NULL, NULL,
     "case.yaml:7:11: geometry.pores.radius: missing; expected least and largest radius, such as "
     "[0.2 mm, 0.5 mm]\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_pores_of_no_order", "radius: [0.2 mm, 0.5 mm]", "radius: [0.5 mm, 0.2 mm]", NULL, NULL,
     "case.yaml:7:30: geometry.pores.radius: the least, 0.0005 m, is more than the largest, 0.0002 "
     "m\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_pores_too_many", "count: 3,", "count: 20000,", NULL, NULL,
     "case.yaml:7:18: geometry.pores.count: 20000 pores of 0.0002 m in radius have more area than "
     "the plate\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_pores_too_large", "radius: [0.2 mm, 0.5 mm]", "radius: [0.2 mm, 20 mm]", NULL, NULL,
     "case.yaml:7:38: geometry.pores.radius.1: a pore of 0.04 m in diameter does not fit into the "
     "plate\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_precrack_without_length", "to: [3 mm, 12 mm]", "to: [0 mm, 12 mm]", NULL, NULL,
     "case.yaml:22:42: cracks.precracks.0.to: the crack ends where it begins, (0, 0.012) m\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_precrack_outside_the_plate", "to: [3 mm, 12 mm]", "to: [-3 mm, 12 mm]", NULL, NULL,
     "case.yaml:22:23: cracks.precracks.0.from: the crack lies outside the plate of 0.05 m x 0.025 "
     "m\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_initial_field_left_free", "no_fail: [top]",
     "no_fail: [top]\ninitial: {velocity: [free, 3 m/s, 0 m/s]}", NULL, NULL,
     "case.yaml:27:22: initial.velocity: found 3 components, expected 2: the model is a plate; "
     "material.model: solid has three\n"
     "case.yaml:27:22: initial.velocity: found 'free', expected an expression or 0; nothing is free at "
     "time 0\n"
     "kirsch: 2 faults in case.yaml; nothing was done\n"},
    {"deck_precrack_half_given", ", to: [3 mm, 12 mm]", "", NULL, NULL,
     "case.yaml:22:16: cracks.precracks.0.to: missing; expected to: [2 mm, 5 mm]\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_precrack_of_two_kinds", "to: [3 mm, 12 mm]",
     "to: [3 mm, 12 mm], points: [[1 mm, 1 mm], [2 mm, 2 mm]]", NULL, NULL,
     "case.yaml:22:66: cracks.precracks.0.points: points beside from and to; make it a crack of its "
     "own\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_precrack_of_one_point", "from: [0 mm, 12 mm], to: [3 mm, 12 mm]",
     "points: [[1 mm, 1 mm]]", NULL, NULL,
     "case.yaml:22:26: cracks.precracks.0.points: found 1 corners, expected two or more\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_precrack_of_a_solid_in_a_plate", "from: [0 mm, 12 mm], to: [3 mm, 12 mm]",
     "disc: {centre: [1 mm, 1 mm, 1 mm], normal: [0, 0, 1], radius: 1 mm}", NULL, NULL,
     "case.yaml:22:32: cracks.precracks.0.disc.centre: a surface cuts a solid, and the model is a "
     "plate; take from and to, or points\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_precrack_of_no_kind", "{from: [0 mm, 12 mm], to: [3 mm, 12 mm]}", "{}", NULL, NULL,
     "cracks.precracks.0.from: empty; expected from and to, points, polygon, disc or file\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_time_step_above_end_time", "end_time: 50 us", "end_time: 50 us, time_step: 1 ms", NULL,
     NULL,
     "case.yaml:27:38: solver.time_step: 0.001 s is more than end_time, 5e-05 s\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_time_step_far_too_small", "end_time: 50 us", "end_time: 50 us, time_step: 1e-20 s", NULL,
     NULL,
     "case.yaml:27:38: solver.time_step: 1e-20 s makes 5e+15 steps until end_time; is a unit "
     "wrong?\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_output_after_the_end", "at: [2 us, 3.5 us]", "at: [2 us, 3.5 ms]", NULL, NULL,
     "case.yaml:28:34: output.at.1: 0.0035 s is after end_time, 5e-05 s\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_output_rarer_than_the_run", "every: 1 us", "every: 1 s", NULL, NULL,
     "case.yaml:28:17: output.every: 1 s is more than end_time, 5e-05 s\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_box_inside_out", "upper: [50 mm, 25 mm]", "upper: [50 mm, -25 mm]", NULL, NULL,
     "case.yaml:30:41: track.boxes.0.upper: y = -0.025 m is not above that of `lower`, 0 m\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_unknown_law", "model: plane-stress", "law: pdb\n  model: plane-stress", NULL, NULL,
     "case.yaml:17:8: material.law: unknown law 'pdb'; there is pmb\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_unknown_key_of_a_variant_not_chosen", "{mesh.spacing: 0.04 mm}",
     "{mesh.spacin: 0.04 mm}", NULL, NULL,
     "case.yaml:32:10: variants.full: mesh.spacin: unknown key; did you mean 'spacing'?\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_unknown_key_of_a_variant_chosen", "{mesh.spacing: 0.04 mm}", "{mesh.spacin: 0.04 mm}",
     "full", NULL,
     "case.yaml:32:10: mesh.spacin: unknown key; did you mean 'spacing'?\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_variant_reaches_into_a_value", "{mesh.spacing: 0.04 mm}", "{mesh.spacing.x: 0.04 mm}",
     NULL, NULL,
     "case.yaml:32:10: variants.full: mesh.spacing.x: 'spacing' holds no keys\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_variant_that_is_a_text", "{mesh.spacing: 0.04 mm}", "fine", NULL, NULL,
     "case.yaml:32:3: variants.full: expected keys and values, such as '{mesh.spacing: 0.04 mm}'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_variant_with_a_wrong_value", "{mesh.spacing: 0.04 mm}", "{mesh.spacing: 0.04}", "full",
     NULL,
     "case.yaml:32:24: mesh.spacing: found '0.04', expected a length with its unit, such as '0.04 "
     "mm'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_variant_unknown", "", "", "fll", NULL,
     "command line: unknown variant 'fll'; the deck has 'full'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_option_without_value", "", "", NULL, "mesh.spacing",
     "command line: --set 'mesh.spacing': expected a key and its value, such as '--set "
     "mesh.spacing=\"0.1 mm\"'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_option_of_an_unknown_key", "", "", NULL, "mesh.spacin=3 mm",
     "command line: mesh.spacin: unknown key; did you mean 'spacing'?\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_option_with_a_wrong_value", "", "", NULL, "mesh.spacing=3",
     "command line: mesh.spacing: found '3', expected a length with its unit, such as '3 mm'\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_option_past_a_list", "", "", NULL, "loads.3.ramp=3 us",
     "command line: loads.3.ramp: '3' is no item of a list of 2; they are counted from 0 to 1\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_option_through_a_value", "", "", NULL, "title.short=x",
     "command line: title.short: 'short' lies within 'a plate', which is a value and no section\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_set_option_of_no_yaml", "", "", NULL, "title=[x",
     "command line: title: '[x' is no YAML: flow sequence without a closing bracket\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_fault_that_would_spread_over_lines", "title: a plate",
     "title: a plate\n\"two\\nlines\": 3", NULL, NULL,
     "case.yaml:2:1: two lines: unknown key; known here: title, preset, no_fail, geometry, mesh, "
      "nodes, material, cracks, initial, loads, stages, solver, output, track\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n"},
    {"deck_no_yaml", "mesh:", "mesh: {", NULL, NULL,
     "kirsch: case.yaml:10:10: not a YAML file: missing comma in flow mapping\n"},
    {"deck_no_text", "title: a plate", "title: \x01", NULL, NULL,
     "kirsch: case.yaml:1:8: not a YAML file: a byte that is no UTF-8 text\n"},
    {"deck_two_documents", "title: a plate", "title: a plate\n---", NULL, NULL,
     "kirsch: case.yaml:3:1: not a YAML file: a second document begins here, after '---'; a deck "
     "is one\n"},
    {"deck_spacing_that_does_not_fit", "  spacing: 0.1 mm", "  spacing: 0.103 mm", NULL, NULL,
     "case.yaml:10:12: mesh.spacing: found 0.103 mm, expected a length that cuts the plate of 50 mm by "
     "25 mm into whole squares, and this makes 485.437 by 242.718: the nearest that fit are "
     "0.102880658436 mm and 0.103305785124 mm; or keep it with geometry.width: 49.955 mm and "
     "geometry.height: 25.029 mm\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n", 1},
    {"deck_spacing_that_fits_one_side", "  height: 25 mm", "  height: 25.0123 mm", NULL, NULL,
     "case.yaml:10:12: mesh.spacing: found 0.1 mm, expected a length that cuts the plate of 50 mm by "
     "25.0123 mm into whole squares, and this makes 500 by 250.123: no spacing near it fits both "
     "sides; keep it with geometry.height: 25 mm\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n", 1},
    {"deck_spacing_of_a_foreign_mesh_need_not_fit", "  spacing: 0.1 mm",
     "  spacing: 0.103 mm\n  file: my.msh\n  colour: red", NULL, NULL,
     "case.yaml:12:3: mesh.colour: unknown key; known here: file, grid, spacing, padding, lloyd_steps\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n", 1},
    {"deck_unknown_boundary_near", "of: top}", "of: tpo}", NULL, NULL,
     "case.yaml:14:31: nodes.sets.top.of: no boundary is called 'tpo'; did you mean 'top'? There are "
     "top, left, right, bottom, hole_1, hole_2, hole_3, hole_4\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n", 1},
    {"deck_unknown_boundary_far", "of: top}", "of: lid}", NULL, NULL,
     "case.yaml:14:31: nodes.sets.top.of: no boundary is called 'lid'; there are left, right, bottom, "
     "top, hole_1, hole_2, hole_3, hole_4\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n", 1},
    {"deck_one_hole_too_many", "of: top}", "of: hole_5}", NULL, NULL,
     "case.yaml:14:31: nodes.sets.top.of: no boundary is called 'hole_5'; did you mean 'hole_1'? There "
     "are hole_1, hole_2, hole_3, hole_4, left, right, bottom, top\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n", 1},
    {"deck_holes_by_porosity_are_not_counted", "pores: {count: 3, radius: [0.2 mm, 0.5 mm]}",
     "pores: {porosity: 0.01, radius: [0.2 mm, 0.5 mm]}", NULL, "loads=[{set: hole_77, traction: "
     "[free, 1 Pa]}, {set: hole_0, traction: [free, 1 Pa]}]",
     "command line: loads.1.set: no set is called 'hole_0'; there are left, right, bottom, top, hole_1 "
     "and on, plate\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n", 1},
    {"deck_unknown_sets", "no_fail: [top]\nsolver: {end_time: 50 us}\n",
     "no_fail: [top, plaet]\n"
     "stages:\n"
     "  - {kind: dynamic, end_time: 1 us, loads: [{set: upper, traction: [free, 1 Pa]}]}\n", NULL,
     "output.probes=[{name: a, quantity: stress, set: front}]",
     "case.yaml:26:16: no_fail.1: no set is called 'plaet'; did you mean 'plate'? There are plate, left, "
     "right, bottom, top, hole_1, hole_2, hole_3, hole_4\n"
     "case.yaml:28:51: stages.0.loads.0.set: no set is called 'upper'; there are left, right, bottom, "
     "top, hole_1, hole_2, hole_3, hole_4, plate\n"
     "command line: output.probes.0.set: no set is called 'front'; there are left, right, bottom, top, "
     "hole_1, hole_2, hole_3, hole_4, plate\n"
     "kirsch: 3 faults in case.yaml; nothing was done\n", 1},
    {"deck_unknown_set_of_sets", "    bottom: {within: 0.3 mm, of: bottom}",
     "    both: {union: [bottom, low]}\n    low: {within: 0.3 mm, of: plate}", NULL, NULL,
     "case.yaml:15:28: nodes.sets.both.union.1: no set is called 'low'; there are left, right, bottom, top, "
     "hole_1, hole_2, hole_3, hole_4, plate\n"
     "case.yaml:16:31: nodes.sets.low.of: no boundary is called 'plate'; there are left, right, bottom, top, "
     "hole_1, hole_2, hole_3, hole_4\n"
     "kirsch: 2 faults in case.yaml; nothing was done\n", 1},
    {"deck_names_of_parts_and_solids", "  holes:\n",
     "  outline: {parts: [{shape: rectangle}, {shape: disc, centre: [9 mm, 9 mm], radius: 3 mm, name: "
     "notch, operation: difference}]}\n  holes:\n", NULL, "loads=[{set: notch, traction: [free, 1 Pa]}, "
     "{set: outline, traction: [free, 1 Pa]}]",
     "command line: loads.1.set: no set is called 'outline'; there are left, right, bottom, top, notch, "
     "hole_1, hole_2, hole_3, hole_4, plate\n"
     "kirsch: 1 fault in case.yaml; nothing was done\n", 1},
};

enum { ROWS = sizeof rows / sizeof *rows };

static void write_deck(const char *find, const char *replace) {
    const char *at = strstr(right, find);
    FILE *file = fopen("case.yaml", "w");
    assert_non_null(at);
    assert_non_null(file);
    fprintf(file, "%.*s%s%s", (int)(at - right), right, replace, at + strlen(find));
    assert_int_equal(fclose(file), 0);
}

static void open_row(void *argument) {
    const struct row *row = argument;
    struct kr_case_arguments arguments = {
        .deck = "case.yaml", .variant = row->variant, .meshes = row->meshes};
    const char *set[] = {row->set};
    struct kr_case c;
    arguments.set = set;
    arguments.n_set = row->set ? 1 : 0;
    kr_error_program("kirsch");
    kr_deck_close(kr_case_open(&arguments, &c));
}

static void check_row(void **state) {
    struct row *row = *state;
    write_deck(row->find, row->replace);
    kr_check_stops(open_row, row, KR_EXIT_INPUT, row->said);
    assert_int_equal(kr_memory_outstanding(), 0);
}

/* ---- solids ---- */

/* Pre-cracks of a solid: what each row puts in the place of X, and the only fault. */
static void solid_faults_of_precracks_are_named(void **state) {
    static const struct row wrong[] = {
        {"", "polygon: [[0 mm, 0 mm, 0 mm], [1 mm, 0 mm, 0 mm]]", "", NULL, NULL,
         "cracks.precracks.0.polygon: found 2 corners, expected three or more\n"},
        {"", "polygon: [[0 mm, 0 mm], [1 mm, 0 mm, 0 mm], [1 mm, 1 mm, 0 mm]]", "", NULL, NULL,
         "cracks.precracks.0.polygon.0: found a list of 2, expected a list of lists of 3, each a length "
         "in mm\n"},
        {"", "polygon: [[0 mm, 0 mm, 0 mm], [1 mm, 1 mm, 1 mm], [2 mm, 2 mm, 2 mm]]", "", NULL, NULL,
         "cracks.precracks.0.polygon: the polygon has no area\n"},
        {"", "polygon: [[0 mm, 0 mm, 0 mm], [1 mm, 0 mm, 0 mm], [1 mm, 1 mm, 0 mm], [0 mm, 1 mm, 1 mm]]",
         "", NULL, NULL, "off the plane of the polygon; a bent surface comes from a file\n"},
        {"", "disc: {centre: [1 mm, 1 mm, 1 mm], normal: [0, 0, 0], radius: 1 mm}", "", NULL, NULL,
         "cracks.precracks.0.disc.normal: the normal has no length; expected one such as [0, 0, 1]\n"},
        {"", "disc: {centre: [1 mm, 1 mm, 1 mm], radius: 1 mm}", "", NULL, NULL,
         "cracks.precracks.0.disc.normal: missing; expected normal: [0, 0, 1]\n"},
        {"", "file: crack.stl", "", NULL, NULL,
         "cracks.precracks.0.unit: missing; expected unit: 1 mm, what 1 in the file stands for\n"},
        {"", "from: [0 mm, 0 mm], to: [1 mm, 1 mm]", "", NULL, NULL,
         "cracks.precracks.0.to: a line cuts a plate, and the model is solid; take polygon, disc or "
         "file\n"},
    };
    (void)state;
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        char said[512], text[512];
        struct row row = {.set = text, .said = said};
        snprintf(text, sizeof text, "cracks.precracks=[{%s}]", wrong[k].find);
        snprintf(said, sizeof said, "%skirsch: 3 faults in case.yaml; nothing was done\n",
                 wrong[k].said);
        /* The two loads of the plate's deck have two components: two faults beside the one. */
        write_deck("model: plane-stress", "model: solid");
        kr_check_stops(open_row, &row, KR_EXIT_INPUT, said);
    }
}

/* ---- what is right ---- */

static void open_right(struct kr_deck **deck, struct kr_case *c) {
    struct kr_case_arguments arguments = {.deck = "case.yaml", .explain = 1};
    write_deck("", "");
    *deck = kr_case_open(&arguments, c);
}

static void case_is_read_in_si(void **state) {
    (void)state;
    struct kr_deck *deck;
    struct kr_case c;
    open_right(&deck, &c);
    const struct kr_case_load *loads = c.loads.item;
    const struct kr_case_set *sets = c.sets.item;
    const struct kr_case_box *boxes = c.boxes.item;
    const struct kr_case_crack *cracks = c.cracks.item;
    kr_check_near(c.width, 0.05, 0);
    kr_check_near(c.horizon, 0.00031, 0);
    assert_int_equal(c.grid, KR_GRID_UNIFORM);
    assert_int_equal(c.model, KR_PLANE_STRESS);
    assert_int_equal(c.surface_deformation, KR_MEAN_OVER_AXES);
    kr_check_near(c.density, 1190, 0);
    kr_check_near(c.fracture_energy, 0, 0);
    assert_string_equal(c.law, "pmb");
    assert_string_equal(sets[1].name, "bottom");
    assert_string_equal(sets[1].of, "bottom");
    assert_true(loads[0].traction[0].is_free);
    kr_check_near(loads[0].traction[1].factor, 1e6, 0);
    kr_check_near(loads[1].ramp, 1e-5, 0);
    kr_check_near(cracks[0].to[0], 0.003, 0);
    kr_check_near(boxes[0].upper[1], 0.025, 0);
    assert_int_equal(boxes[0].direction, 0);
    assert_int_equal(c.window, 30);
    assert_int_equal(c.pores.attempts, 100000);
    assert_string_equal(c.folder, "out/case");
    kr_deck_close(deck);
    kr_unit_close();
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void check_only(void *argument) {
    struct kr_case_arguments arguments = {.deck = argument, .check = 1};
    struct kr_case c;
    kr_case_open(&arguments, &c);
}

static void case_check_says_so_and_makes_nothing(void **state) {
    (void)state;
    write_deck("", "");
    kr_check_stops(check_only, "case.yaml", 0, "case.yaml: no faults\n");
    assert_int_equal(access("out", F_OK), -1);
    kr_check_stops(check_only, "none.yaml", 2, "none.yaml cannot be read: No such file");
}

/* Asked to check, it looks for them; a program that needs none of them works without. */
static void case_check_looks_for_files(void **state) {
    static const char *const row[][3] = {
        {"  grid: uniform", "  grid: uniform\n  file: a.msh", "case.yaml:10:9: mesh.file: ./a.msh cannot be read: No such file"},
        {"count: 3, radius: [0.2 mm, 0.5 mm]", "file: a.txt", "case.yaml:7:17: geometry.pores.file: ./a.txt cannot be read"},
        {"ramp: 10 us", "table: {file: a.csv}", "case.yaml:25:61: loads.1.table.file: ./a.csv cannot be read"},
    };
    (void)state;
    for (size_t k = 0; k < sizeof row / sizeof row[0]; k++) {
        struct kr_case_arguments arguments = {.deck = "case.yaml", .explain = 1};
        struct kr_case c;
        write_deck(row[k][0], row[k][1]);
        kr_check_stops(check_only, "case.yaml", 2, row[k][2]);
        kr_deck_close(kr_case_open(&arguments, &c));
        kr_unit_close();
        assert_int_equal(kr_memory_outstanding(), 0);
    }
}

static void case_makes_its_folder_with_parents(void **state) {
    (void)state;
    struct kr_case c;
    write_deck("", "");
    struct kr_case_arguments arguments = {.deck = "case.yaml", .folder = "a/b//c"};
    struct kr_deck *deck = kr_case_open(&arguments, &c);
    assert_int_equal(access("a/b/c", W_OK), 0);
    char *path = kr_case_file(&c, "plate.msh");
    assert_string_equal(path, "a/b//c/plate.msh");
    kr_free(path);
    kr_deck_close(deck);
    kr_unit_close();
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void case_warns_of_a_small_horizon(void **state) {
    (void)state;
    write_deck("horizon: 0.31 mm", "horizon: 0.25 mm");
    kr_check_stops(check_only, "case.yaml", 0,
                   "warning: case.yaml:12:12: nodes.horizon: 2.5 spacings; below 3");
}

/* ---- pores ---- */

static void write_pores(const char *text) {
    FILE *file = fopen("pores.txt", "w");
    fputs(text, file);
    fclose(file);
}

static void read_holes(void *argument) {
    struct kr_case *c = argument;
    size_t count;
    kr_free(kr_case_holes(c, &count));
}

static void pores_follow_the_holes_of_the_deck(void **state) {
    (void)state;
    struct kr_deck *deck;
    struct kr_case c;
    size_t count = 0;
    open_right(&deck, &c);
    c.folder = ".";
    write_pores("# seed 1\n0.02 0.01 2.5e-4\r\n\n  0.03\t0.011 0.0003 # second\n0.04 0.012 3e-4");
    struct kr_case_hole *holes = kr_case_holes(&c, &count);
    assert_int_equal(count, 4);
    kr_check_near(holes[0].radius, 0.002, 0);
    kr_check_near(holes[1].radius, 2.5e-4, 0);
    kr_check_near(holes[2].centre[1], 0.011, 0);
    kr_check_near(holes[3].centre[0], 0.04, 0);
    kr_free(holes);
    kr_deck_close(deck);
    kr_unit_close();
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void pores_wrong_lines_are_named(void **state) {
    static const struct {
        const char *text, *said;
    } wrong[] = {
        {"0.02 0.01\n", "./pores.txt:1: found '0.02 0.01', expected 'x y radius' in metres"},
        {"# x\n0.02 0.01 2e-4 7\n", "./pores.txt:2: found '0.02 0.01 2e-4 7', expected"},
        {"0.02 0.01 2e-4mm\n", "./pores.txt:1: found '0.02 0.01 2e-4mm', expected"},
        {"0.02 nan 2e-4\n", "./pores.txt:1: found '0.02 nan 2e-4', expected"},
        {"0.02 0.01 0\n", "./pores.txt:1: found a radius of 0 m"},
        {"0.02 0.01 3\n", "./pores.txt:1: found a radius of 3 m"},
        {"0.02 0.03 2e-4\n", "./pores.txt:1: the pore at (0.02, 0.03) m lies outside the plate"},
        {NULL, "./pores.txt cannot be read: No such file or directory; kirsch-pores makes it"},
    };
    (void)state;
    struct kr_deck *deck;
    struct kr_case c;
    open_right(&deck, &c);
    c.folder = ".";
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        unlink("pores.txt");
        if (wrong[i].text)
            write_pores(wrong[i].text);
        kr_check_stops(read_holes, &c, KR_EXIT_INPUT, wrong[i].said);
    }
    kr_deck_close(deck);
    kr_unit_close();
}

/* ---- arguments ---- */

static void arguments_are_sorted(void **state) {
    char *argv[] = {"/usr/bin/kirsch-x",
                    "--steps",
                    "5",
                    "--variant",
                    "full",
                    "--set",
                    "a.b=3 mm",
                    "--fast",
                    "a/case.yaml",
                    "--set=c=4",
                    "--check",
                    "--output=o/p",
                    NULL};
    struct kr_case_arguments got;
    (void)state;
    kr_case_arguments(12, argv, "usage\n", &got);
    assert_string_equal(got.deck, "a/case.yaml");
    assert_string_equal(got.variant, "full");
    assert_string_equal(got.folder, "o/p");
    assert_int_equal(got.n_set, 2);
    assert_string_equal(got.set[0], "a.b=3 mm");
    assert_string_equal(got.set[1], "c=4");
    assert_true(got.check && !got.explain);
    assert_int_equal(got.n_left, 3);
    assert_string_equal(got.left[0], "--steps");
    assert_string_equal(got.left[1], "5");
    assert_string_equal(got.left[2], "--fast");
    kr_free(got.set);
    kr_free(got.left);
    assert_int_equal(kr_memory_outstanding(), 0);
}

static void give_argument(void *argument) {
    char *argv[] = {"kirsch-x", argument, NULL};
    struct kr_case_arguments got;
    kr_case_arguments(2, argv, "usage: kirsch-x case.yaml\n", &got);
}

static void arguments_help_and_stop(void **state) {
    (void)state;
    kr_check_stops(give_argument, "--help", 0, "usage: kirsch-x case.yaml\n");
    kr_check_stops(give_argument, "--version", 0, "kirsch-x ");
    kr_check_stops(give_argument, "--check", 2,
                   "kirsch-x: the deck is missing\nusage: kirsch-x case.yaml\n");
    kr_check_stops(give_argument, "--set", 2, "kirsch-x: --set needs a value behind it\n");
}

int main(void) {
    const struct CMUnitTest single[] = {
        cmocka_unit_test(solid_faults_of_precracks_are_named),
        cmocka_unit_test(case_is_read_in_si),
        cmocka_unit_test(case_check_says_so_and_makes_nothing),
        cmocka_unit_test(case_check_looks_for_files),
        cmocka_unit_test(case_makes_its_folder_with_parents),
        cmocka_unit_test(case_warns_of_a_small_horizon),
        cmocka_unit_test(pores_follow_the_holes_of_the_deck),
        cmocka_unit_test(pores_wrong_lines_are_named),
        cmocka_unit_test(arguments_are_sorted),
        cmocka_unit_test(arguments_help_and_stop),
    };
    enum { SINGLE = sizeof single / sizeof single[0] };
    struct CMUnitTest tests[SINGLE + ROWS];
    char folder[] = "/tmp/kirsch-decks-XXXXXX", filter[256];
    memcpy(tests, single, sizeof single);
    for (size_t i = 0; i < ROWS; i++)
        tests[SINGLE + i] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, (void *)&rows[i]};
    if (!mkdtemp(folder) || chdir(folder))
        return 1;
    snprintf(filter, sizeof filter, "*%s*", getenv("ONLY") ? getenv("ONLY") : "");
    cmocka_set_test_filter(filter);
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    unlink("case.yaml");
    unlink("pores.txt");
    (void)!(rmdir("a/b/c") || rmdir("a/b") || rmdir("a"));
    rmdir(folder);
    return failed;
}
