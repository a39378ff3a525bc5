/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Quantities written by people: "0.16 mm", "6 MPa", "1190 kg/m3". Read by udunits2, SI inside.
 */
#ifndef KR_UNIT_H
#define KR_UNIT_H

/** Read a quantity.
 *
 *  in   text    number and unit, "0.16 mm"
 *  in   unit    SI unit it must convert to, "m"; "1" for a pure number (then no unit may stand)
 *  out  value   in that unit
 *  out  why     where it fails: what was found and what was expected, owned by the caller (kr_free)
 *  returns 1 if read, 0 if not.
 */
int kr_unit_read(const char *text, const char *unit, double *value, char **why);

/** Factor from the unit written in text to the SI unit; 0 where they do not convert. */
double kr_unit_factor(const char *text, const char *unit);

/** What people call a quantity of this SI unit, "a length" for "m", and a unit that it is commonly
 *  written in, "mm"; for messages. Static texts. */
const char *kr_unit_noun(const char *unit);
const char *kr_unit_common(const char *unit);

/** End of the decimal number that begins a text, and its value; NULL where none begins it, and for
 *  hexadecimal, infinite and not-a-number, which no quantity in a deck is. */
const char *kr_unit_number(const char *text, double *value);

/** Whether a decimal number in a text is neither 0 nor of a size for which a double keeps all digits, 2.2e-308
 *  to 1.8e308. */
int kr_unit_beyond(const char *text);

/** Sentence about a text with such a number: what was found, what was expected; owned by the caller. `unit` as in
 *  kr_unit_read. */
char *kr_unit_beyond_said(const char *text, const char *unit);

/** Free what udunits2 keeps. */
void kr_unit_close(void);

#endif
