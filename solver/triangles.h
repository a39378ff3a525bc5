/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A heap of triangles in space that segments are held against: a tree of boxes, so that many triangles
 * cost little more than few.
 */
#ifndef KR_TRIANGLES_H
#define KR_TRIANGLES_H

#include <stddef.h>

struct kr_triangles; /* Opaque. */

/** Takes over `corner` (n x 9). Triangles without area meet nothing but what touches them. */
struct kr_triangles *kr_triangles_create(size_t n, double *corner);
void kr_triangles_free(struct kr_triangles *triangles);

/** The box around all of them. */
void kr_triangles_box(const struct kr_triangles *triangles, double lower[3], double upper[3]);

/** Whether the segment from p to q meets any triangle; touching counts, and so does what
 *  rounding cannot tell from touching: triangles with an edge in common leave no gap there. Several
 *  threads may ask at once. */
int kr_triangles_meet(const struct kr_triangles *triangles, const double p[3], const double q[3]);

#endif
