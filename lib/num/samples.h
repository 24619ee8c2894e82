/* samples.h -- functions given by tables: piecewise polynomials between knots.
 *
 * Of one argument, with knots x_0 < x_1 < ... and values f_i: steps (f_i from x_i on), straight lines, or the cubic spline
 * with continuous second derivatives,
 *
 *     f(x) = c_0 + c_1 w + c_2 w^2 + c_3 w^3,   w = x - x_i,   x_i <= x < x_{i+1}
 *
 * whose third derivative does not jump at the second and the last but one knot (not-a-knot); three points give a parabola,
 * two a line. Of two arguments on a grid: the tensor product of these.
 *
 * Beyond the first and the last knot: nothing (NaN), the value at the end (`hold`), or the same again (`periodic`; a
 * spline is then periodic too).
 *
 * Expressions and tapes have one operation for this, lookup(number, handle), which is constant in pieces: it finds the
 * number of the piece that holds x, then the knot and the coefficients of a piece by its number. The polynomial itself is
 * made of ordinary sums and products, which have derivatives and series. A handle is a whole number: which table, and
 * what of it. Tables stay until the process ends, since expressions hold their numbers; equal tables are one.
 *
 * Source  de Boor, A Practical Guide to Splines (1978), chapter IV.
 * Tests   tests/num/test_samples.c
 */
#ifndef QDOT_NUM_SAMPLES_H
#define QDOT_NUM_SAMPLES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

typedef enum { QDOT_SAMPLES_END, QDOT_SAMPLES_HOLD, QDOT_SAMPLES_PERIODIC } qdot_samples_beyond;

/* A table that is to be made. The arrays belong to the caller; they are copied. */
typedef struct {
    int axes;               /* number of arguments, 1 or 2 */
    size_t n[2];            /* numbers of knots, at least 2 each */
    const double *knots[2]; /* ascending */
    const double *values;   /* [n[0] x n[1]]; of one argument [n[0]] */
    int degree;             /* 0: steps, 1: lines, 3: splines; steps have one argument */
    qdot_samples_beyond beyond; /* with two arguments: not periodic */
} qdot_samples_given;

/* The number of the table with these values: a new one, or an equal one that is there. Errors: QDOT_ENOMEM; QDOT_ELIMIT, more
 * than 4096 tables. */
QDOT_MUST_CHECK qdot_status qdot_samples_add(const qdot_samples_given *given, int *number);

/* Handles of table `number`: of the piece along an axis that holds a place; of its knot, by the number of the piece; of a
 * coefficient of w^i v^j, by the number of the piece, or of two arguments by (piece of x) * qdot_samples_width + (piece of y). */
int64_t qdot_samples_piece(int number, int axis);
int64_t qdot_samples_knot(int number, int axis);
int64_t qdot_samples_coefficient(int number, int i, int j);
int64_t qdot_samples_width(int number);

/* lookup(x, handle). Of the handle of an axis' pieces, x is a place on the axis, and the result is the number of the piece that
 * holds it. Of a handle of knots or coefficients, x is the number of a piece, and the result is its knot or its coefficient.
 * NaN if a place is outside a table that has no values there, if x is NaN, and if there is no such handle. */
double qdot_samples_lookup(double handle, double x);

/* What the items of a table that a handle names are made of, for who reads them elsewhere. */
typedef struct {
    enum { QDOT_SAMPLES_PIECE, QDOT_SAMPLES_KNOT, QDOT_SAMPLES_COEFFICIENT } item;
    const double *at; /* of pieces and knots the axis' knots; of a coefficient its values, by the number of a stored piece */
    size_t n;         /* how many these are */
    size_t period;    /* pieces in a period; 0: the table is not periodic */
    qdot_samples_beyond beyond;
    bool jumps;
} qdot_samples_view;

/* Of a handle; false: there is no such handle, or the coefficient is 0 in all pieces. The values stay with the table. */
bool qdot_samples_look(double handle, qdot_samples_view *view);

/* Whether a handle is that of an axis' pieces. */
bool qdot_samples_finds(double handle);
/* Of such a handle of a table, the piece *lo <= x < *hi that holds the place x. With `hold` the pieces outside the table are infinite on
 * one side. NaN if no piece holds x. */
void qdot_samples_bounds(double handle, double x, double *lo, double *hi);
/* |first knot| + |last knot| of a periodic table: whole periods are subtracted from a place, and the rounding error of that is
 * some DBL_EPSILON times this. 0 for other tables, where places are taken as they are. */
double qdot_samples_blur(double handle);
/* Whether two handles are of one table. */
bool qdot_samples_is_same(double a, double b);
/* Whether the functions of the table jump at knots. */
bool qdot_samples_jumps(double handle);
/* Of the handle of an axis' pieces, the first and the last knot along the axis. Whether there are no values outside. */
bool qdot_samples_range(double handle, double *lo, double *hi);

#endif
