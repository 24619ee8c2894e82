/* past.h -- what the unknowns of a run were, for equations that read them a time earlier.
 *
 *     y_i(u) = sum_k c_ik w^k,   w = (u - t_j)/h_j,   t_j <= u < t_{j+1},   k <= QDOT_PAST_ORDER
 *
 * one polynomial for each step of the run, from t_j on, as its Taylor series gave it; before the start the values of the
 * start. It is a table that grows with the run, read by the same operation as tables of data, lookup(handle, u)
 * (num/samples.h): the handle says of which unknown, and what of its piece. A tape has no place for which run it is
 * evaluated for, and a run and its companions have the same tape, so each thread has one history that is read.
 *
 * Breaking points. At the start, and where an event, a switch or a table of data breaks the motion, a derivative of the unknowns
 * jumps: let the k-th be the lowest one that does. Equations that read y(t - tau) hand that on to tau later, where a higher
 * one jumps, the (k + gain)-th. A step ends there, unless the jump is beyond the order of the series or below rounding. All other ends of
 * steps are no breaking points: a step may read the series of one earlier step beyond the end of that, to the time `valid` to
 * which it holds, or that of a later one before its begin. Therefore ends of steps do not multiply.
 *
 * Source  Bellen & Zennaro, Numerical Methods for Delay Differential Equations (2003), chapters 2 to 4.
 * Tests   tests/num/test_past.c
 */
#ifndef QDOT_NUM_PAST_H
#define QDOT_NUM_PAST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

enum { QDOT_PAST_ORDER = 32, QDOT_PAST_SMOOTH = 1000 }; /* SMOOTH: as the order of a breaking point, that there is none */

typedef struct qdot_past qdot_past;

/* For n unknowns, of which the i-th is called by the number called[i]; both copied. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_past_new(size_t n, const uint32_t *called, qdot_past **out);
void qdot_past_free(qdot_past *h);

/* The equations read a time tau > 0 ago, and a breaking point of order k there is one of order k + gain now. SMOOTH: nothing that
 * is integrated depends on what is read, but on its sign, so steps end before and behind each breaking point. Known delays stay known. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_past_delay(qdot_past *h, double tau, int gain);

/* The run starts at t with y [n]: nothing is known but these values, which were the same before. */
QDOT_MUST_CHECK qdot_status qdot_past_begin(qdot_past *h, double t, const double *y);
/* A step that begins at t begins with a breaking point, whatever was before; NULL as history: nothing. */
void qdot_past_restart(qdot_past *h, double t);
/* From t on, which is not before the start, the unknowns are x_ik s^k with s = (u - t)/unit, x_ik = x[i stride + k],
 * k <= p <= QDOT_PAST_ORDER; by its coefficients the series holds up to the time `holds`, which may be infinite. What was known
 * from t on is forgotten, and a piece before t that has hardly any length. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_past_add(qdot_past *h, double t, double unit, int p, double holds, const double *x, size_t stride);

/* The run has come to t: that is where the last piece ends so far. */
void qdot_past_reach(qdot_past *h, double t);

/* The time at which a step from t has to end: by a breaking point that it reads, or because no series of an earlier step
 * that holds at its begin holds longer. Where an unknown that is read jumps, the last time before that, then the first one
 * behind it. */
double qdot_past_next(const qdot_past *h, double t);

/* From now on, each time is read in the series that holds longest of those that hold there and were begun before t: for the
 * series of a step from t. -INFINITY: in the one of the step that was taken there, for values. */
void qdot_past_expand(qdot_past *h, double t);

/* The history that this thread reads from now on, until it is freed; NULL: none, everything read is NaN. */
void qdot_past_read(qdot_past *h);
/* Several histories, each with the numbers by which handles call its unknowns; borrowed until others are read. A NULL history: none. */
typedef struct {
    const qdot_past *history;
    const uint32_t *called;
} qdot_past_reading;
void qdot_past_read_several(size_t n, const qdot_past_reading *of);

/* Handles of the unknown called by a number: of the piece that holds a time; of the piece's t_j, 1/h_j and c_k by its
 * number. Whether a handle is one of a history, and that of a piece. */
long long qdot_past_piece(uint32_t called);
long long qdot_past_knot(uint32_t called);
long long qdot_past_rate(uint32_t called);
long long qdot_past_coefficient(uint32_t called, int k);
bool qdot_past_has(double handle);
bool qdot_past_finds(double handle);
/* Whether it is that of c_0, and of which unknown. The same of another unknown. */
bool qdot_past_is_value(double handle, uint32_t *called);
long long qdot_past_rename(double handle, uint32_t called);

/* lookup(handle, x), of the histories that are read; NaN for a time behind the end. */
double qdot_past_lookup(double handle, double x);
/* The end of the piece that holds the time x, in the history that has the unknown of the handle; infinite: it is the last. */
double qdot_past_piece_end(double handle, double x);
/* Whether there the piece that holds x is what is read from x - r to x + r, without a breaking point between. A disc about x in the complex
 * plane, over whose real part up to `real` only the history is asked for, may be larger: a piece is a polynomial. INFINITY: as large. */
bool qdot_past_is_smooth(double handle, double x, double r);
void qdot_past_ask_within(double real);

#endif
