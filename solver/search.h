/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Which nodes are near a place: cell lists, a grid of bins as wide as the reach.
 */
#ifndef KR_SEARCH_H
#define KR_SEARCH_H

#include <stddef.h>

struct kr_search; /* Opaque. Implemented in search.c. */

/** Sort n points into bins.
 *
 *  in  dim       2 or 3
 *  in  position  (n x dim) m; not copied, must outlive the search
 *  in  reach     m: how far kr_search_near looks
 */
struct kr_search *kr_search_create(int dim, size_t n, const double *position, double reach);

/** Points within the reach of point i, itself left out, in ascending order.
 *
 *  out  near  room for `room` indices
 *  returns their number; where it exceeds `room`, only the first found are stored and nothing is
 *  sorted: call again with more.
 */
size_t kr_search_near(const struct kr_search *search, size_t i, int *near, size_t room);

/** What was found: zeros at first, grows as it must; kr_free(found.near) in the end. */
struct kr_found {
    int *near;
    size_t count, room;
};

/** kr_search_near with room for all. */
void kr_search_find(const struct kr_search *search, size_t i, struct kr_found *found);

void kr_search_free(struct kr_search *search);

#endif
