/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Is everything installed and sane?
 */
#ifndef KR_DOCTOR_H
#define KR_DOCTOR_H

/** Check programs, libraries, Python's modules and ffmpeg, a line each, with the cure where one is
 *  missing; and say which loop and how many threads a run would use. Touches nothing.
 *  Returns an exit code: 0, or 5 if something is missing. */
int kr_doctor(void);

#endif
