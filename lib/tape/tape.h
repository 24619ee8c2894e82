/* tape.h -- expressions lowered to a list of operations.
 *
 * Common parts are computed once (the DAG is already shared), unused parts never, integer powers
 * by squaring, sine and cosine of one argument as a pair, sums of angles from base angles if that
 * is cheaper: cos(a - b) = ca cb + sa sb needs no call if sin and cos of a and b are computed
 * anyway. Constants are evaluated exactly, then rounded once. A tape is const and thread-safe;
 * the caller owns the work space.
 *
 * Tests  tests/tape/
 */
#ifndef QDOT_TAPE_TAPE_H
#define QDOT_TAPE_TAPE_H

#include "expr/id.h"

typedef struct qdot_tape qdot_tape;

/* Lower outputs [m] as functions of inputs [n] (SYMs). A symbol or undefined function that is no
 * input: QDOT_EUNSET with its name. Relations and if() are allowed (1.0 and 0.0). */
QDOT_MUST_CHECK qdot_status qdot_tape_new(qdot_pool *pool, size_t n, const qdot_expr *inputs,
                                          size_t m, const qdot_expr *outputs, qdot_tape **tape);
/* Make a tape that is evaluated on series (taylor.h, lanes.h), where the costs of angles
 * differ from those for numbers (tape/angle.h). */
QDOT_MUST_CHECK qdot_status qdot_tape_new_for_series(qdot_pool *pool, size_t n,
                                                     const qdot_expr *inputs, size_t m,
                                                     const qdot_expr *outputs,
                                                     qdot_tape **tape);
void qdot_tape_free(qdot_tape *tape);

size_t qdot_tape_inputs(const qdot_tape *tape);
size_t qdot_tape_outputs(const qdot_tape *tape);
size_t qdot_tape_work(const qdot_tape *tape);       /* number of doubles of work space needed */
size_t qdot_tape_operations(const qdot_tape *tape); /* number of operations of one evaluation */
/* The number of calls of elementary functions in one evaluation (a sine with its cosine counts once). */
size_t qdot_tape_calls(const qdot_tape *tape);

/* QDOT_ENOTBUILT if values on the tape are limits of which a fixed number of steps is made, which is enough for 28 digits. */
QDOT_MUST_CHECK qdot_status qdot_tape_check_digits(const qdot_tape *tape);

/* Evaluate outputs out [m] at inputs in [n]; work [qdot_tape_work]. Never fails; NaN and inf by IEEE 754. */
void qdot_tape_eval(const qdot_tape *tape, const double *in, double *out, double *work);

#endif
