/* SPDX-License-Identifier: BSD-3-Clause
 *
 * STL files: a surface as a heap of triangles.
 */
#ifndef KR_STL_H
#define KR_STL_H

#include <stddef.h>

/** Read all triangles of a file, binary (80 bytes, a count, 50 bytes each) or ASCII ("solid ...").
 *
 *  in   unit   what 1 in the file stands for [m]
 *  out  count
 *  returns (count x 9) corners [m], owned by the caller. Normals and colours are left out.
 *  Stops (exit 2) where the file is missing, cut, no STL, without a triangle, or holds a number that is
 *  not finite.
 */
double *kr_stl_read(const char *path, double unit, size_t *count);

#endif
