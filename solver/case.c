/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The table of the deck's keys: what they are called, what they hold, in which range, and what they
 * mean. Geometry, mesh and nodes stand in case_body.c. docs/deck.md is printed from the table; checks that
 * need more than one key are in case_check.c.
 */
#include "case_keys.h"

#include <string.h>

static const struct kr_deck_key material_keys[] = {
    {"law", KR_DECK_TEXT, AT(law), .fallback = "pmb",
     .text = "Material law; `pmb`: prototype microelastic brittle, with a constant micromodulus."},
    {"model", KR_DECK_CHOICE, AT(model), .words = KR_MODEL_WORDS,
     .text = "Thin plate, thick plate, or a body in three dimensions (`solid`: all vectors of the "
             "deck then have three components). Bonds fix Poisson's ratio: 1/3 in plane stress, 1/4 "
             "otherwise."},
    {"micromodulus", KR_DECK_CHOICE, AT(micromodulus), .words = KR_MICROMODULUS_WORDS,
     .fallback = "constant",
     .text = "Stiffness of bonds over their length: `constant` up to the horizon, or `conical`, "
             "falling evenly to nothing there."},
    {"youngs_modulus", NUMBER_OF(AT(youngs_modulus), "Pa"), POSITIVE, .text = "Young's modulus."},
    {"poissons_ratio", NUMBER_OF(AT(poissons_ratio), "1"), .fallback = "", .least = -1, .most = 0.5,
     .text = "Need not be given: the bonds fix it. If it is, and is not the model's own, the deck is "
             "refused."},
    {"density", NUMBER_OF(AT(density), "kg/m^3"), POSITIVE, .text = "Density."},
    {"fracture_energy", NUMBER_OF(AT(fracture_energy), "J/m^2"), .fallback = "0 J/m^2",
     NOT_NEGATIVE, .text = "Energy of a unit of crack area, G0; 0: the plate does not break."},
    {NULL},
};

#define CRACK_AT(field) offsetof(struct kr_case_crack, field)
#define VECTOR_3(where, si)                                                                        \
    .type = KR_DECK_VECTOR, .offset = (where), .unit = (si), .count = 3, .fallback = ""
static const struct kr_deck_key disc_keys[] = {
    {"centre", VECTOR_3(CRACK_AT(centre), "m"), .text = "Its centre."},
    {"normal", VECTOR_3(CRACK_AT(normal), "1"), .text = "Across it, of any length: `[0, 0, 1]`."},
    {"radius", NUMBER_OF(CRACK_AT(radius), "m"), .fallback = "", POSITIVE, .text = "Its radius."},
    {NULL},
};

static const struct kr_deck_key crack_keys[] = {
    {"from", VECTOR_OF(CRACK_AT(from)), .fallback = "",
     .text = "In a plate: one end of a straight crack. Goes with `to`."},
    {"to", VECTOR_OF(CRACK_AT(to)), .fallback = "", .text = "The other end."},
    {"points", KR_DECK_NUMBERS, CRACK_AT(points), .unit = "m", .count = 2, .fallback = "",
     .text = "In a plate: the corners of a crack with bends, from end to end."},
    {"polygon", KR_DECK_NUMBERS, CRACK_AT(polygon), .unit = "m", .count = 3, .fallback = "",
     .text = "In a solid: the corners of a plane polygon in turn."},
    {"disc", KR_DECK_SECTION, .keys = disc_keys, .text = "In a solid: a round crack (penny)."},
    {"file", KR_DECK_TEXT, CRACK_AT(file), .fallback = "",
     .text = "In a solid: a surface of triangles, open or closed; an STL file, binary or ASCII; a path "
             "from the deck's folder."},
    {"unit", NUMBER_OF(CRACK_AT(unit), "m"), .fallback = "", POSITIVE,
     .text = "What 1 in the STL file stands for, `1 mm`. Goes with `file`."},
    {NULL},
};

static const struct kr_deck_key cracks_keys[] = {
    {"precracks", LIST_OF(KR_DECK_LIST, struct kr_case_crack, crack_keys), .offset = AT(cracks),
     .text = "Cracks that are there from the beginning: they cut every bond that crosses or touches "
             "them. In a plate straight or bent lines, in a solid polygons, discs and surfaces."},
    {"count_precrack", KR_DECK_BOOLEAN, AT(count_precrack), .fallback = "true",
     .text = "Whether the bonds cut by them count as broken in Damage."},
    {NULL},
};

#define LOAD_AT(field) offsetof(struct kr_case_load, field)
#define LOAD_OF(where, si)                                                                         \
    .type = KR_DECK_FORMULAS, .offset = (where), .unit = (si), .count = 3, .fallback = ""
static const struct kr_deck_key table_keys[] = {
    {"file", KR_DECK_TEXT, LOAD_AT(table_file), .fallback = "",
     .text = "CSV file, a path from the deck's folder: a line of names, the first `time [us]` in any "
             "unit of time, then lines of numbers. Between them the factor goes in straight lines, after the "
             "last it stays."},
    {"column", KR_DECK_TEXT, LOAD_AT(table_column), .fallback = "",
     .text = "Name of the column with the factor; not given: the second."},
    {"repeat", KR_DECK_BOOLEAN, LOAD_AT(table_repeats), .fallback = "false",
     .text = "After the last line begin with the first again (cyclic loads)."},
    {NULL},
};

static const struct kr_deck_key load_keys[] = {
    {"set", KR_DECK_TEXT, LOAD_AT(set), .text = "Name of a set under `nodes.sets`."},
    {"displacement", LOAD_OF(LOAD_AT(displacement), "m"),
     .text = "Prescribed displacement `[x, y]`, in a solid `[x, y, z]`; `free` leaves a component "
             "out."},
    {"velocity", LOAD_OF(LOAD_AT(velocity), "m/s"),
     .text = "Prescribed velocity, with `free` likewise."},
    {"traction", LOAD_OF(LOAD_AT(traction), "Pa"),
     .text = "Force per area of the boundary that the set belongs to, spread over its nodes."},
    {"body_force", LOAD_OF(LOAD_AT(body_force), "N/m^3"), .text = "Force per volume."},
    {"ramp", NUMBER_OF(LOAD_AT(ramp), "s"), .fallback = "0 s", NOT_NEGATIVE,
     .text = "The load grows evenly from 0 to its full value in this time; 0: at once."},
    {"table", KR_DECK_SECTION, .keys = table_keys,
     .text = "The load is what stands here times a factor from a table of measured or planned times: "
             "`{set: top, displacement: [free, 1 mm], table: {file: cycles.csv}}`."},
    {NULL},
};

static const struct kr_deck_key initial_keys[] = {
    {"displacement", LOAD_OF(AT(initial_displacement), "m"),
     .text = "Displacement of every node at time 0, an expression in x, y, z a component."},
    {"velocity", LOAD_OF(AT(initial_velocity), "m/s"),
     .text = "Velocity of every node at time 0, such as `[100*x m/s, 100*y m/s]` of a ring that flies "
             "apart."},
    {NULL},
};

#define STEPS_AT(field) offsetof(struct kr_case_steps, field)
static const struct kr_deck_key steps_keys[] = {
    {"count", KR_DECK_INTEGER, STEPS_AT(count), .fallback = "1", .least = 1, .most = 1e9,
     .text = "How many."},
    {"size", NUMBER_OF(STEPS_AT(size), "s"), POSITIVE,
     .text = "How far each moves the stage's clock, and with it the loads."},
    {NULL},
};

#define STAGE_AT(field) offsetof(struct kr_case_stage, field)
static const struct kr_deck_key stage_keys[] = {
    {"kind", KR_DECK_CHOICE, STAGE_AT(kind), .words = KR_STAGE_WORDS,
     .text = "`dynamic`: motion in time; `static`: load step by load step to equilibrium, breaking "
             "bonds until none is past its limit; `relaxation`: motion that is damped "
             "until it rests."},
    {"loads", LIST_OF(KR_DECK_LIST, struct kr_case_load, load_keys), .offset = STAGE_AT(loads),
     .text = "Loads of this stage alone, in place of the deck's. In all loads `t` is the stage's "
             "clock, which begins at 0."},
    {"end_time", NUMBER_OF(STAGE_AT(end_time), "s"), .fallback = "", POSITIVE,
     .text = "Dynamic: how long it lasts. Relaxation: how long at the most."},
    {"damping", NUMBER_OF(STAGE_AT(damping), "s^-1"), .fallback = "0 s^-1", NOT_NEGATIVE,
     .text = "Dynamic: a force density of this times density and velocity holds against the motion "
             "(Rayleigh's mass-proportional damping)."},
    {"steps", LIST_OF(KR_DECK_LIST, struct kr_case_steps, steps_keys), .offset = STAGE_AT(steps),
     .text = "Static: load steps, in turn: `[{count: 8, size: 1 s}, {count: 100, size: 0.01 s}]`. Not "
             "given: one of 1 s. The clock is one of the load alone: nothing moves in it."},
    {"least_step", NUMBER_OF(STAGE_AT(least_step), "s"), .fallback = "0 s", NOT_NEGATIVE,
     .text = "Static: a load step that would break the first bond is halved until it is no larger than "
             "this; 0: load steps are taken as they are."},
    {"end_below", NUMBER_OF(STAGE_AT(end_below), "1"), .fallback = "0.01", .least = 0, .most = 1,
     .text = "Static: where bonds broke and equilibrium was found again, the run ends if what holds the body is "
             "less than this share of the most it was. It also ends where no bond joins two supports any more."},
    {"tolerance", NUMBER_OF(STAGE_AT(tolerance), "1"), .fallback = "1e-6", .least = 0, .most = 0.1,
     .exclusive = 1,
     .text = "Static and relaxation: forces left on free nodes, over the forces that hold the body."},
    {"breaks", KR_DECK_BOOLEAN, STAGE_AT(breaks), .fallback = "true",
     .text = "Whether bonds may break in this stage."},
    {NULL},
};

static const struct kr_deck_key solver_keys[] = {
    {"end_time", NUMBER_OF(AT(end_time), "s"), .fallback = "", POSITIVE,
     .text = "Time at which the run ends; needed where there are no `stages`, which have their own."},
    {"time_step", NUMBER_OF(AT(time_step), "s"), .fallback = "0 s", NOT_NEGATIVE,
     .text = "Step of velocity-Verlet; 0: the largest stable step times `safety_factor`."},
    {"precision", KR_DECK_CHOICE, AT(precision), .words = "double mixed", .fallback = "double",
     .text = "`mixed`: what the loop over bonds makes of the differences of displacements is "
             "float32, which is faster ([performance.md](performance.md#mixed-precision))."},
    {"safety_factor", NUMBER_OF(AT(safety_factor), "1"), .fallback = "0.8", .least = 0, .most = 1,
     .exclusive = 1, .text = "Share of the largest stable step that is taken."},
    {"checkpoint_every", NUMBER_OF(AT(checkpoint_every), "s"), .fallback = "600 s", NOT_NEGATIVE,
     .text = "Wall time between checkpoints, from which a stopped run goes on; 0: only when asked by "
             "a signal (SIGUSR1, or SIGTERM and SIGINT, which also stop the run)."},
    {"checkpoint_steps", KR_DECK_INTEGER, AT(checkpoint_steps), .fallback = "0", .least = 0, .most = 1e9,
     .text = "Steps (static: load steps) between checkpoints, besides those by time; 0: none by steps."},
    {NULL},
};

#define PROBE_AT(field) offsetof(struct kr_case_probe, field)
static const struct kr_deck_key probe_keys[] = {
    {"name", KR_DECK_TEXT, PROBE_AT(name), .text = "Name in the columns."},
    {"quantity", KR_DECK_CHOICE, PROBE_AT(quantity), .words = KR_QUANTITY_WORDS,
     .text = "What is told; each of its components is a column."},
    {"set", KR_DECK_TEXT, PROBE_AT(set), .fallback = "",
     .text = "Mean over the volume of the nodes of this set; or ..."},
    {"at", PLACE_OF(PROBE_AT(at)), .fallback = "",
     .text = "... that of the node nearest to this place."},
    {NULL},
};

static const struct kr_deck_key output_keys[] = {
    {"folder", KR_DECK_TEXT, AT(folder), .fallback = "",
     .text = "Folder of all results, made where it is missing; seen from where the program is "
             "called. Not given: `out/` and the name of the folder of the deck."},
    {"every", NUMBER_OF(AT(output_every), "s"), .fallback = "", POSITIVE,
     .text = "Time between two outputs of the fields. Without it and `at`: beginning and end "
             "alone."},
    {"at", KR_DECK_NUMBERS, AT(output_at), "s", .fallback = "", NOT_NEGATIVE,
     .text = "Further times at which the fields are written."},
    {"every_steps", KR_DECK_INTEGER, AT(every_steps), .fallback = "1", .least = 1, .most = 1e9,
     .text = "Static stages: load steps from one output of the fields to the next; the end of a "
             "stage always has one. history.csv has a line for each load step."},
    {"first_damage", KR_DECK_BOOLEAN, AT(first_damage), .fallback = "false",
     .text = "Write the fields where the first bond breaks, too."},
    {"every_bonds", KR_DECK_INTEGER, AT(every_bonds), .fallback = "0", .least = 0, .most = 1e12,
     .text = "Write the fields each time that so many bonds more have broken, too; 0: do not."},
    {"fields", KR_DECK_TEXTS, AT(fields), .fallback = "",
     .text = "Which fields the outputs hold: `displacement`, `velocity`, `damage`, `energy` (strain "
             "energy density), which are the default, and `stress` and `strain`. kirsch-plot draws "
             "what is there."},
    {"probes", LIST_OF(KR_DECK_LIST, struct kr_case_probe, probe_keys), .offset = AT(probes),
     .text = "Further columns of history.csv: `[{name: rim, quantity: stress, at: [6 mm, 5 mm]}]`. "
             "Reactions of loads are there anyway."},
    {"precision", KR_DECK_CHOICE, AT(double_fields), .words = "single double", .fallback = "single",
     .text = "Of the fields in the outputs: float32 or float64."},
    {"compression", KR_DECK_CHOICE, AT(compression), .words = KR_COMPRESSION_WORDS,
     .fallback = "scalars",
     .text = "Which fields are packed (shuffle and gzip): `scalars`, which shrink, for damage is mostly 0; "
             "`all`; `none`."},
    {"history_every", NUMBER_OF(AT(history_every), "s"), .fallback = "0 s", NOT_NEGATIVE,
     .text = "Time between two lines of history.csv; 0: every 20 steps."},
    {"damage_threshold", NUMBER_OF(AT(damage_threshold), "1"), .fallback = "0.35", .least = 0,
     .most = 1, .exclusive = 1,
     .text = "Damage from which a node counts as cracked: the time at which it passes is "
             "recorded."},
    {NULL},
};

#define BOX_AT(field) offsetof(struct kr_case_box, field)
static const struct kr_deck_key box_keys[] = {
    {"lower", VECTOR_OF(BOX_AT(lower)), .text = "Lower left corner."},
    {"upper", VECTOR_OF(BOX_AT(upper)), .text = "Upper right corner."},
    {"direction", KR_DECK_CHOICE, BOX_AT(direction), .words = "+x -x +y -y",
     .text = "Where the crack runs to: its tip is the cracked node farthest that way."},
    {NULL},
};

static const struct kr_deck_key track_keys[] = {
    {"window", KR_DECK_INTEGER, AT(window), .fallback = "30", .least = 1, .most = 1e9,
     .text = "Steps over which a crack's speed is taken."},
    {"boxes", LIST_OF(KR_DECK_LIST, struct kr_case_box, box_keys), .offset = AT(boxes),
     .text = "Parts of the plate in which one crack tip each is followed."},
    {NULL},
};

const struct kr_deck_key kr_case_keys[] = {
    {"title", KR_DECK_TEXT, AT(title), .fallback = "", .text = "A line for people."},
    {"preset", KR_DECK_CHOICE, AT(preset), .words = KR_PRESET_WORDS, .fallback = "none",
     .text = "Choices in one word, for keys that the deck does not give itself. `plates-paper`: as in "
             "the plates paper, `grid: near-boundary`, `partial_volume: hhb-one-sided`, "
             "`surface_correction: energy`, `surface_deformation: uniaxial-y`."},
    {"no_fail", KR_DECK_TEXTS, AT(no_fail), .fallback = "",
     .text = "Names of sets whose bonds never break, such as those that carry the load."},
    {"geometry", KR_DECK_SECTION, .keys = kr_case_geometry_keys, .text = "The plate and its holes."},
    {"mesh", KR_DECK_SECTION, .keys = kr_case_mesh_keys, .text = "How kirsch-mesh cuts it into cells."},
    {"nodes", KR_DECK_SECTION, .keys = kr_case_nodes_keys,
     .text = "How kirsch-nodes turns cells into peridynamic nodes."},
    {"material", KR_DECK_SECTION, .keys = material_keys, .text = "What the plate is made of."},
    {"cracks", KR_DECK_SECTION, .keys = cracks_keys, .text = "Cracks before the run."},
    {"initial", KR_DECK_SECTION, .keys = initial_keys,
     .text = "How the run begins where it does not begin at rest. Prescribed motions win over it."},
    {"loads", LIST_OF(KR_DECK_LIST, struct kr_case_load, load_keys), .offset = AT(loads),
     .text = "What moves or pulls the plate. Each load has a set and just one of displacement, "
             "velocity, traction and body_force."},
    {"stages", LIST_OF(KR_DECK_LIST, struct kr_case_stage, stage_keys), .offset = AT(stages),
     .text = "Parts of the run, in turn; the body goes from one to the next as it is. Not given: one "
             "dynamic stage until `solver.end_time`."},
    {"solver", KR_DECK_SECTION, .keys = solver_keys, .text = "Time integration."},
    {"output", KR_DECK_SECTION, .keys = output_keys, .text = "What is written, and where."},
    {"track", KR_DECK_SECTION, .keys = track_keys, .text = "How kirsch-track follows cracks."},
    {NULL},
};

void kr_case_word(const char *words, int k, char word[32]) {
    size_t length;
    for (; k > 0; k--)
        words += strcspn(words, " ") + 1;
    length = strcspn(words, " ");
    if (length > 31)
        length = 31;
    memcpy(word, words, length);
    word[length] = 0;
}
