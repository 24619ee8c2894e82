/* taylor.h -- a tape over truncated power series: Taylor coefficients of its outputs from
 * those of its inputs.
 *
 * Every value v of the tape is a series v(s) = sum_k v_k s^k. One order is evaluated at
 * a time, so that coefficient k + 1 of an input may be made from coefficient k of an
 * output, as a differential equation asks. The recurrences are those of recurrence.def, what
 * an expansion does those of program.h.
 *
 * Operations that switch (abs, sign, min, max, mod, floor, relations, if) have no series
 * at the point where they switch: a tape that has one has no program (program.h).
 *
 * Tests   tests/series/test_taylor.c
 */
#ifndef QDOT_SERIES_TAYLOR_H
#define QDOT_SERIES_TAYLOR_H

#include "series/program.h"

/* The program for Taylor series with its coefficients; each thread needs its own. */
typedef struct qdot_taylor qdot_taylor;

/* For orders 0 ... most (at most QDOT_SERIES_MOST) of a program, which is read, not kept;
 * `shaken`: with the other neighbours of its constants (tape/shake.h). Errors: QDOT_EINVAL (most),
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_of_program(const qdot_program *program, bool shaken,
                                                   int most, qdot_taylor **taylor);
void qdot_taylor_free(qdot_taylor *taylor);

/* Coefficients by order of input i, to be written by the caller before each order. The
 * rows of the inputs follow each other at a distance of qdot_taylor_stride doubles. */
double *qdot_taylor_input(qdot_taylor *taylor, size_t i);
size_t qdot_taylor_stride(const qdot_taylor *taylor);

/* The Taylor coefficients of output i, by order. */
const double *qdot_taylor_output(const qdot_taylor *taylor, size_t i);
/* Whether output i is constant in time for any values of the inputs that vary. */
bool qdot_taylor_is_constant(const qdot_taylor *taylor, size_t i);

/* Constants that are no doubles, for a stretch of time that begins at t: each becomes
 * one of its two neighbours, drawn with the chances that make the exact value their
 * mean. Over many steps what rounding such a constant does averages out, where always
 * the same side would be a drift. The draw is a function of t alone. Of a shaken tape
 * nothing is drawn. */
void qdot_taylor_draw(qdot_taylor *taylor, double t);

/* The chances themselves: a number in [0, 1) for draw i of the stretch that begins at t,
 * always the same one. */
double qdot_taylor_chance(double t, size_t i);

/* Order k of all that is computed, orders below k being there: 0 first. Never fails; NaN
 * and inf as IEEE 754 has them. */
void qdot_taylor_order(qdot_taylor *taylor, int k);

/* Input i is the integral of `from`, a row of coefficients, over time: its order k + 1 is
 * unit/(k + 1) times order k of that. Input `twice` (SIZE_MAX: none) is the integral of
 * input i; its order k + 2 is there with k + 1 of that, an order before it is wanted. */
QDOT_MUST_CHECK qdot_status qdot_taylor_link(qdot_taylor *taylor, size_t i, size_t twice,
                                             const double *from);

/* Order 0 of all that is computed, and what is linked. Then orders `from` to `to`, each
 * followed by what is linked to it in the order in which it was; `to` below the program's
 * highest but one. */
void qdot_taylor_begin(qdot_taylor *taylor, double unit);
/* Compute only the integrals that qdot_taylor_begin computes; order 0 of all rows must be known. */
void qdot_taylor_begin_links(qdot_taylor *taylor, double unit);
void qdot_taylor_extend(qdot_taylor *taylor, int from, int to);

/* Orders 1 ... to are going to be evaluated again and again, by qdot_taylor_begin and then
 * qdot_taylor_extend(1, to): as machine code, where that can be made (taylor-code.h). All
 * links are there by now. Whatever else is evaluated is so by the kernels, as everything is
 * without this call. The code is shared with programs of the same shape, to orders up to `most` at
 * least if vectors are narrow (below `to`: as `to`). Errors: QDOT_EINVAL (to), QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_prepare(qdot_taylor *taylor, int to, int most);
/* Take such code if it is kept from an earlier run, without writing any. This is tried
 * once, and not if there is other code. False: nothing has changed. */
bool qdot_taylor_take_kept(qdot_taylor *taylor, int to, int most);
/* From now on evaluate all orders by compiled functions again, without generated machine code. */
void qdot_taylor_drop_code(qdot_taylor *taylor);
/* Evaluate all orders by compiled functions and generate no code from now on, for the (borrowed) reason `why`. */
void qdot_taylor_refuse_code(qdot_taylor *taylor, const char *why);
/* Whether generated machine code computes orders 1 ... `to`. */
bool qdot_taylor_is_code(const qdot_taylor *taylor, int to);
/* Whether machine code can be generated on this processor; the next function names what that needs. */
bool qdot_taylor_may_be_code(void);
const char *qdot_taylor_code_kind(void);
/* The length of the machine code; 0 if there is none, and *why is the reason, NULL if none was requested. */
size_t qdot_taylor_code_bytes(const qdot_taylor *taylor, const char **why);

/* The longest step, at most s (INFINITY: any), of the expansion that is there to order p which
 * carries no argument of an exponential and no divisor too far (near.h, also for `least`), in
 * units of time. Whether there are any. */
double qdot_taylor_near(const qdot_taylor *taylor, int p, double s, double least);
bool qdot_taylor_may_hide(const qdot_taylor *taylor);

/* The number of convolution sums that an order costs (a square counts half); qdot_taylor_length: of steps. */
double qdot_taylor_convolutions(const qdot_taylor *taylor);
size_t qdot_taylor_length(const qdot_taylor *taylor);

#endif
