/* SPDX-License-Identifier: BSD-3-Clause
 *
 * The list of laws: one line each, KR_LAW(x) for the law kr_law_x of the file x.c.
 */
KR_LAW(pmb)
