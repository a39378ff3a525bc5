/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cracks of a solid as sheets: the front of each as a curve through the thickness, and the area of all.
 */
#ifndef KR_SHEET_H
#define KR_SHEET_H

#include "case.h"
#include "record.h"

/** Follow the front and write it. The body is cut into layers of about a spacing across z; in each the
 *  tip is followed as in a plate (track.h), within each box of the deck, or in all of the body towards
 *  +x. Every `window` steps, from the first tip on, a line a layer: where its tip is and how fast, over the
 *  window. A layer without a tip yet has no line. Stops (exit 3) where it cannot be written.
 *
 *  in  record  3D
 */
void kr_sheet_front(const struct kr_record *record, const struct kr_case *c, const char *path);

/** Write how the area grew: at most 200 lines, each at a time at which bonds broke. The area is what the bonds
 *  that broke until then held, over G0: what a smooth crack takes per area. Where damage spreads to the
 *  sides of a crack that is faster than smooth, it is larger than that of the crack's faces. */
void kr_sheet_area(const struct kr_record *record, const char *path);

#endif
