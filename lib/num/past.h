/* past.h -- what the unknowns of a run were, for equations that read them a time earlier.
 *
 *     y_i(u) = sum_k c_ik w^k,   w = (u - t_j)/h_j,   t_j <= u < t_{j+1},   k <= QDOT_PAST_ORDER
 *
 * one polynomial for each step of the run, from t_j on, as its Taylor series gave it; before the start the values of the
 * start. It is a table that grows with the run, read by the same operation as tables of data, lookup(handle, u)
 * (num/samples.h): the handle says of which unknown, and what of its piece. A tape has no place for which run it is
 * evaluated for, and a run and its companions have the same tape, so each thread has one history that is read.
 *
 * The knots t_j + tau are where a step of an equation with y(t - tau) ends. Among them are the breaking points: at
 * start + tau the derivative of y' jumps, at start + 2 tau the next one, and so on.
 *
 * Source  Bellen & Zennaro, Numerical Methods for Delay Differential Equations (2003), chapters 2 and 3.
 * Tests   tests/num/test_past.c
 */
#ifndef QDOT_NUM_PAST_H
#define QDOT_NUM_PAST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

enum { QDOT_PAST_ORDER = 32 };

typedef struct qdot_past qdot_past;

/* For n unknowns, of which the i-th is called by the number called[i]; both copied. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_past_new(size_t n, const uint32_t *called, qdot_past **out);
void qdot_past_free(qdot_past *h);

/* The run starts at t with y [n]: nothing is known but these values, which were the same before. */
QDOT_MUST_CHECK qdot_status qdot_past_begin(qdot_past *h, double t, const double *y);
/* From t on, which is not before the start, the unknowns are x_ik s^k with s = (u - t)/unit, x_ik = x[i stride + k],
 * k <= p <= QDOT_PAST_ORDER. What was known from t on is forgotten, and a
 * piece before t that has hardly any length. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_past_add(qdot_past *h, double t, double unit, int p, const double *x, size_t stride);

/* The run has come to t: that is where the last piece ends so far. */
void qdot_past_reach(qdot_past *h, double t);

/* The history that this thread reads from now on, until it is freed; NULL: none, everything read is NaN. */
void qdot_past_read(qdot_past *h);

/* Handles of the unknown called by a number: of the piece that holds a time; of the piece's t_j, 1/h_j and c_k by its
 * number. Whether a handle is one of a history, and that of a piece. */
long long qdot_past_piece(uint32_t called);
long long qdot_past_knot(uint32_t called);
long long qdot_past_rate(uint32_t called);
long long qdot_past_coefficient(uint32_t called, int k);
bool qdot_past_has(double handle);
bool qdot_past_finds(double handle);
/* Whether it is that of c_0, and of which unknown. */
bool qdot_past_is_value(double handle, uint32_t *called);

/* lookup(handle, x), NaN for a time behind the end, and the piece [*lo, *hi) that holds x, of the history that is read. */
double qdot_past_lookup(double handle, double x);
void qdot_past_bounds(double x, double *lo, double *hi);
/* Whether an unknown jumps where that piece ends. */
bool qdot_past_jumps(double x);

#endif
