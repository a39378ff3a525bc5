/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The table of the deck's keys is written in two files: case_body.c, what the body is made of before any
 * mechanics, and case.c. This is what they share; nobody else reads it.
 */
#ifndef KR_CASE_KEYS_H
#define KR_CASE_KEYS_H

#include "case.h"

#include <math.h>
#include <stddef.h>

#define AT(field) offsetof(struct kr_case, field)
#define POSITIVE .least = 0, .most = INFINITY, .exclusive = 1
#define NOT_NEGATIVE .least = 0, .most = INFINITY
#define VECTOR_OF(where) .type = KR_DECK_VECTOR, .offset = (where), .unit = "m", .count = 2
/* In a plate two components, in a solid three. */
#define PLACE_OF(where)                                                                            \
    .type = KR_DECK_VECTOR, .offset = (where), .unit = "m", .count = 3, .fewest = 2
#define SPACE_OF(where) .type = KR_DECK_VECTOR, .offset = (where), .unit = "m", .count = 3
#define NUMBER_OF(where, si) .type = KR_DECK_NUMBER, .offset = (where), .unit = (si)
#define LIST_OF(what, type_, keys_)                                                                \
    .type = (what), .item_size = sizeof(type_), .keys = (keys_), .fallback = ""
#define LENGTH_OF(where) NUMBER_OF((where), "m"), .fallback = ""

extern const struct kr_deck_key kr_case_geometry_keys[], kr_case_mesh_keys[], kr_case_nodes_keys[];

#endif
