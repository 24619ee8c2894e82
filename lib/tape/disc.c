/* disc.c -- a tape over discs: values at the centres, and a radius for each. */
#include "tape/disc.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "tape/instruction.h"

/* --- bounds -------------------------------------------------------------------------- */

/* x y, with 0 times infinity = 0 */
static double
times(double x, double y)
{
    return x == 0 || y == 0 ? 0 : x * y;
}

static double
of_product(double a, double ra, double b, double rb)
{
    return times(fabs(a), rb) + times(fabs(b), ra) + times(ra, rb);
}

/* (a + u)/(b + v) - d = (u - d v)/(b + v), d = a/b */
static double
of_quotient(double d, double ra, double b, double rb)
{
    return fabs(b) > rb ? (ra + times(fabs(d), rb)) / (fabs(b) - rb) : NAN;
}

/* f(c + w) - f(c) = f'(c) sin w - f(c) (1 - cos w), and the like of hyperbolic ones */
static double
of_wave(double slope, double value, double r)
{
    const double s = sinh(0.5 * r);

    return fabs(slope) * sinh(r) + 2 * fabs(value) * s * s;
}

/* tanh(a + w) - tanh a = sinh w/(cosh a cosh(a + w)), |cosh(x + i y)| >= cosh x cos y; and where x
 * is not 0 throughout, |tanh z -+ 1| <= 2/(e^2|x| - 1) at both. */
static double
of_tanh(double a, double r)
{
    const double x = fabs(a) - r, flat = x > 0 ? 4 / expm1(2 * x) : NAN;

    if (!(r < M_PI_2))
        return flat;
    return fmin(flat, sinh(r) / cosh(a) / (cosh(fmax(0, x)) * cos(r)));
}

/* erf: its slope 2 e^(-z^2)/sqrt(pi) is largest where x^2 - y^2 is least. */
static double
of_normal(double a, double r)
{
    const double x = fabs(a);
    const double least = x < 2 * r ? 0.5 * x * x - r * r : (x - r) * (x - r);

    return fmin(r * M_2_SQRTPI * exp(-least), x > 2 * r ? 2 : INFINITY);
}

/* atan2(y, x) is the imaginary part of log(x + i y): half a difference of two logarithms. */
static double
of_angle(double y, double ry, double x, double rx)
{
    const double far = hypot(x, y);

    if (!(rx + ry < far) || (x - rx <= 0 && fabs(y) <= ry))
        return NAN;
    return -log1p(-(rx + ry) / far);
}

/* a^b, d at the centres. Of a whole number b >= 0 it is a polynomial; else |1 + w|^b for
 * |w| <= ra/a goes farthest on the real line. */
static double
of_power(double a, double ra, double b, double rb, double d)
{
    const double part = ra / fabs(a);

    if (rb == 0 && b >= 0 && b == floor(b))
        return pow(fabs(a) + ra, b) - fabs(d);
    if (!(part < 1) || (a < 0 && (rb > 0 || b != floor(b))))
        return NAN;
    if (rb > 0)
        return fabs(d) * expm1(of_product(log(a), -log1p(-part), b, rb));
    return fabs(d) * fabs(expm1(b * log1p(b >= 1 ? part : -part)));
}

static bool
are_apart(double a, double ra, double b, double rb)
{
    return fabs(a - b) > ra + rb || (ra == 0 && rb == 0);
}

static double
of_remainder(double a, double ra, double b, double rb)
{
    const double q = a / b, rq = of_quotient(q, ra, b, rb);

    return floor(q - rq) == floor(q + rq) ? ra + fabs(floor(q)) * rb : NAN;
}

/* --- a tape -------------------------------------------------------------------------- */

size_t
qdot_disc_work(const qdot_tape *tape)
{
    return 2 * tape->places;
}

/* Add rounding to a radius that is not 0. */
static double
settle(double d, double rd)
{
    return isnan(d) ? NAN : rd != 0 ? rd + DBL_EPSILON * fabs(d) : 0;
}

/* The centre and the radius of the result of an instruction. */
static void
step(const qdot_instruction *i, double *work, double *radius)
{
    const double a = work[i->x], ra = radius[i->x];
    double b = 0, c = 0, d = 0, e = 0, rb = 0, rc = 0, rd = 0, re = 0;

    switch (i->op) {
#define X(ID, name, operands, operations, calls, statement, slopes)                      \
    case QDOT_OP_##ID:                                                                   \
        if (operands > 1) {                                                              \
            b = work[i->y];                                                              \
            rb = radius[i->y];                                                           \
        }                                                                                \
        if (operands > 2) {                                                              \
            c = work[i->z];                                                              \
            rc = radius[i->z];                                                           \
        }                                                                                \
        statement;                                                                       \
        break;
#include "tape/operation.def"
#undef X
    }
    if (ra != 0 || rb != 0 || rc != 0) /* else it is a number */
        switch (i->op) {
#define X(ID, radius_of)                                                                 \
    case QDOT_OP_##ID: radius_of; break;
#include "tape/disc.def"
#undef X
        }
    (void)c;
    work[i->to] = d;
    radius[i->to] = settle(d, rd);
    if (i->op == QDOT_OP_SINCOS) {
        work[i->y] = e;
        radius[i->y] = settle(e, re);
    }
}

static void
load(const qdot_tape *tape, const double *c, const double *r, double *work)
{
    double *radius = work + tape->places;

    if (tape->inputs) {
        memcpy(work, c, tape->inputs * sizeof *work);
        memcpy(radius, r, tape->inputs * sizeof *radius);
    }
    if (tape->constants)
        memcpy(work + tape->inputs, tape->constant, tape->constants * sizeof *work);
    memset(radius + tape->inputs, 0, tape->constants * sizeof *radius);
}

void
qdot_disc_eval(const qdot_tape *tape, const double *c, const double *r, double *C,
               double *R, double *work)
{
    double *radius = work + tape->places;

    load(tape, c, r, work);
    for (size_t k = 0; k < tape->length; k++)
        step(tape->code + k, work, radius);
    for (size_t k = 0; k < tape->outputs; k++) {
        C[k] = work[tape->output[k]];
        R[k] = radius[tape->output[k]];
    }
}

/* Places of inputs may be reused after their last use. */
qdot_status
qdot_disc_reads(const qdot_tape *tape, bool *used)
{
    bool *other = qdot_calloc(tape->inputs + 1, sizeof *other);

    if (!other)
        return QDOT_ENOMEM;
    memset(used, 0, tape->inputs * sizeof *used);
    for (size_t k = 0; k < tape->length; k++) {
        const qdot_instruction *i = tape->code + k;
        const uint32_t read[3] = {i->x, i->y, i->z};
        const int operands = qdot_operations[i->op].operands;

        for (int j = 0; j < operands; j++)
            if (read[j] < tape->inputs && !other[read[j]])
                used[read[j]] = true;
        if (i->to < tape->inputs)
            other[i->to] = true;
        if (i->op == QDOT_OP_SINCOS && i->y < tape->inputs)
            other[i->y] = true;
    }
    for (size_t k = 0; k < tape->outputs; k++)
        if (tape->output[k] < tape->inputs && !other[tape->output[k]])
            used[tape->output[k]] = true;
    qdot_free(other);
    return QDOT_OK;
}

static bool
falls_off(uint32_t op, qdot_disc_hiding by)
{
    return op == QDOT_OP_EXP || op == QDOT_OP_TANH || op == QDOT_OP_SINH ||
           op == QDOT_OP_COSH || op == QDOT_OP_POW ||
           (op == QDOT_OP_DIV && by == QDOT_HIDES_QUOTIENTS);
}

bool
qdot_disc_may_hide(const qdot_tape *tape, qdot_disc_hiding by)
{
    for (size_t k = 0; k < tape->length; k++)
        if (falls_off(tape->code[k].op, by))
            return true;
    return false;
}

/* Beyond it tanh is 1 in doubles. */
static const double saturated = 20;

/* How far the argument of an operation that falls off, or its logarithm, may go; 0 where its value is
 * the same throughout. */
static double
reach_of(const qdot_instruction *i, const double *value, const double *radius)
{
    const double a = fabs(value[i->x]), ra = radius[i->x];

    switch (i->op) {
    case QDOT_OP_POW:
        return times(fabs(value[i->y]), ra / a) + times(fabs(log(a)), radius[i->y]);
    case QDOT_OP_DIV: {
        const double part = radius[i->y] / fabs(value[i->y]);

        return part < 1 ? -log1p(-part) : NAN;
    }
    case QDOT_OP_TANH: return a - ra > saturated ? 0 : ra;
    default: return ra;
    }
}

double
qdot_disc_reach(const qdot_tape *tape, qdot_disc_hiding by, const double *c, const double *r,
                double *work)
{
    double *radius = work + tape->places, reach = 0;

    load(tape, c, r, work);
    for (size_t k = 0; k < tape->length; k++) {
        const qdot_instruction *i = tape->code + k;

        if (falls_off(i->op, by)) {
            const double far = reach_of(i, work, radius);

            reach = far >= 0 ? fmax(reach, far) : INFINITY;
        }
        step(i, work, radius);
    }
    return reach;
}
