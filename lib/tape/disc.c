/* disc.c -- evaluates a tape over complex discs: each value is a centre and a bound on the distance from it. */
#include "tape/disc.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "num/past.h"
#include "num/samples.h"
#include "tape/instruction.h"

/* --- bounds of single operations ----------------------------------------------------- */

/* The product x y of two radii, with 0 times infinity defined as 0. */
static double
radius_times(double x, double y)
{
    return x == 0 || y == 0 ? 0 : x * y;
}

static double
radius_of_product(double a, double ra, double b, double rb)
{
    return radius_times(fabs(a), rb) + radius_times(fabs(b), ra) + radius_times(ra, rb);
}

/* Radius of a quotient with centre d = a/b and deviations u, v: (a + u)/(b + v) - d = (u - d v)/(b + v). */
static double
radius_of_quotient(double d, double ra, double b, double rb)
{
    return fabs(b) > rb ? (ra + radius_times(fabs(d), rb)) / (fabs(b) - rb) : NAN;
}

/* Radius of a number of a table of data: 0 if the disc is within one piece; of a history, if the piece holds there. */
static double
radius_of_lookup(double a, double ra, double handle)
{
    if (qdot_past_finds(handle))
        return qdot_past_is_smooth(handle, a, ra) ? 0 : NAN;
    return ra == 0 || qdot_samples_lookup(handle, a - ra) == qdot_samples_lookup(handle, a + ra) ? 0 : NAN;
}

/* |f(c + w) - f(c)| for sine or cosine, from f(c + w) - f(c) = f'(c) sin w - f(c) (1 - cos w); also
 * hyperbolic. */
static double
radius_of_wave(double slope, double value, double r)
{
    const double s = sinh(0.5 * r);

    return fabs(slope) * sinh(r) + 2 * fabs(value) * s * s;
}

/* tanh(a + w) - tanh a = sinh w/(cosh a cosh(a + w)), |cosh(x + i y)| >= cosh x cos y; and where x
 * is not 0 throughout, |tanh z -+ 1| <= 2/(e^2|x| - 1) at both. */
static double
radius_of_tanh(double a, double r)
{
    const double x = fabs(a) - r, flat = x > 0 ? 4 / expm1(2 * x) : NAN;

    if (!(r < M_PI_2))
        return flat;
    return fmin(flat, sinh(r) / cosh(a) / (cosh(fmax(0, x)) * cos(r)));
}

/* log(1 + e^z): its slope e^z/(1 + e^z) has poles at +-pi i; left of them it is at most of e^x/(1 - e^x),
 * x < 0. */
static double
radius_of_softplus(double a, double r)
{
    const double x = a + r, small = x < 0 ? exp(x) / -expm1(x) : INFINITY;

    if (!(r < M_PI))
        return x < 0 ? r * small : NAN;
    return r * fmin(small, r <= M_PI_2 ? 1 : 1 / sin(r));
}

/* Radius of erf: its derivative 2 e^(-z^2)/sqrt(pi) is largest, at z = x + i y, where x^2 - y^2 is smallest. */
static double
radius_of_normal(double a, double r)
{
    const double x = fabs(a);
    const double least = x < 2 * r ? 0.5 * x * x - r * r : (x - r) * (x - r);

    return fmin(r * M_2_SQRTPI * exp(-least), x > 2 * r ? 2 : INFINITY);
}

/* Radius of atan2(y, x), the imaginary part of log(x + i y): half the difference of two logarithms. */
static double
radius_of_angle(double y, double ry, double x, double rx)
{
    const double far = hypot(x, y);

    if (!(rx + ry < far) || (x - rx <= 0 && fabs(y) <= ry))
        return NAN;
    return -log1p(-(rx + ry) / far);
}

/* a^b, d at the centres. Of a whole number b >= 0 it is a polynomial; else |1 + w|^b for
 * |w| <= ra/a goes farthest on the real line. */
static double
disc_power_radius(double a, double ra, double b, double rb, double d)
{
    const double part = ra / fabs(a);

    if (rb == 0 && b >= 0 && b == floor(b))
        return pow(fabs(a) + ra, b) - fabs(d);
    if (!(part < 1) || (a < 0 && (rb > 0 || b != floor(b))))
        return NAN;
    if (rb > 0)
        return fabs(d) * expm1(radius_of_product(log(a), -log1p(-part), b, rb));
    return fabs(d) * fabs(expm1(b * log1p(b >= 1 ? part : -part)));
}

static bool
are_disjoint(double a, double ra, double b, double rb)
{
    return fabs(a - b) > ra + rb || (ra == 0 && rb == 0);
}

static double
radius_of_remainder(double a, double ra, double b, double rb)
{
    const double q = a / b, rq = radius_of_quotient(q, ra, b, rb);

    return floor(q - rq) == floor(q + rq) ? ra + fabs(floor(q)) * rb : NAN;
}

/* --- evaluating a tape --------------------------------------------------------------- */

size_t
qdot_disc_work(const qdot_tape *tape)
{
    return 4 * tape->places;
}

/* Add the rounding error of the result d to its radius, unless the radius is 0. */
static double
radius_add_rounding(double d, double rd)
{
    return isnan(d) ? NAN : rd != 0 ? rd + DBL_EPSILON * fabs(d) : 0;
}

/* Compute the centre and the radius of the disc that results from an instruction. */
static void
disc_execute(const qdot_instruction *i, double *work, double *radius)
{
    const double a = work[i->x], ra = radius[i->x];
    double b = 0, c = 0, d = 0, e = 0, rb = 0, rc = 0, rd = 0, re = 0;

    switch (i->op) {
#define X(ID, name, operands, operations, calls, statement, ...)                         \
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
    if (ra != 0 || rb != 0 || rc != 0) /* if all radii are 0, the result is a plain number without radius */
        switch (i->op) {
#define X(ID, name, operands, operations, calls, statement, slopes, interval, disc, ...) \
    case QDOT_OP_##ID: disc; break;
#include "tape/operation.def"
#undef X
        }
    (void)c;
    work[i->to] = d;
    radius[i->to] = radius_add_rounding(d, rd);
    if (i->op == QDOT_OP_SINCOS) {
        work[i->y] = e;
        radius[i->y] = radius_add_rounding(e, re);
    }
}

/* Set the discs of the inputs to centres c and radii r; r NULL: all radii are 0. */
static void
disc_load(const qdot_tape *tape, const double *c, const double *r, double *work)
{
    double *radius = work + tape->places;

    if (tape->inputs) {
        memcpy(work, c, tape->inputs * sizeof *work);
        if (r)
            memcpy(radius, r, tape->inputs * sizeof *radius);
        else
            memset(radius, 0, tape->inputs * sizeof *radius);
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

    disc_load(tape, c, r, work);
    for (size_t k = 0; k < tape->length; k++)
        disc_execute(tape->code + k, work, radius);
    for (size_t k = 0; k < tape->outputs; k++) {
        C[k] = work[tape->output[k]];
        R[k] = radius[tape->output[k]];
    }
}

/* Find the inputs that the tape reads before their memory is reused. */
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
may_become_negligible(uint32_t op, qdot_disc_hiding by)
{
    return op == QDOT_OP_EXP || op == QDOT_OP_TANH || op == QDOT_OP_SINH ||
           op == QDOT_OP_COSH || op == QDOT_OP_POW ||
           (op == QDOT_OP_DIV && by == QDOT_HIDES_QUOTIENTS);
}

bool
qdot_disc_may_hide(const qdot_tape *tape, qdot_disc_hiding by)
{
    for (size_t k = 0; k < tape->length; k++)
        if (may_become_negligible(tape->code[k].op, by))
            return true;
    return false;
}

/* For arguments larger than this, tanh is exactly 1 in double precision. */
static const double saturated = 20;

/* How far the argument of an operation that falls off, or its logarithm, may go where its value
 * changes. */
static double
relative_reach(const qdot_instruction *i, const double *value, const double *radius)
{
    const double a = fabs(value[i->x]), ra = radius[i->x];

    switch (i->op) {
    case QDOT_OP_POW:
        return radius_times(fabs(value[i->y]), ra / a) + radius_times(fabs(log(a)), radius[i->y]);
    case QDOT_OP_DIV: {
        const double part = radius[i->y] / fabs(value[i->y]);

        return part < 1 ? -log1p(-part) : NAN;
    }
    case QDOT_OP_TANH: return fmin(ra, fmax(0, saturated - (a - ra)));
    default: return ra;
    }
}

size_t
qdot_disc_hiders(const qdot_tape *tape, qdot_disc_hiding by, const double *c, const double *r,
                 double most, size_t *last, double *work)
{
    double *radius = work + tape->places;
    size_t found = 0;

    disc_load(tape, c, r, work);
    for (size_t k = 0; k < tape->length; k++) {
        const qdot_instruction *i = tape->code + k;

        if (may_become_negligible(i->op, by) && !(relative_reach(i, work, radius) <= most)) {
            *last = k;
            found++;
        }
        disc_execute(i, work, radius);
    }
    return found;
}

typedef struct {
    double c, r;
} disc;

static disc
disc_product(disc a, disc b)
{
    return (disc){a.c * b.c, radius_of_product(a.c, a.r, b.c, b.r)};
}

static disc
disc_sum(disc a, disc b)
{
    return (disc){a.c + b.c, a.r + b.r};
}

static disc
negate_disc(disc a)
{
    return (disc){-a.c, a.r};
}

static bool
disc_is_zero(disc a)
{
    return a.c == 0 && a.r == 0;
}

/* The multiple of f in the result of an operation, from those B in its operands, whose values are x;
 * false if it is none. */
static bool
find_multiple_in_result(uint32_t op, const disc *B, const disc *x, disc *of)
{
    const bool a = !disc_is_zero(B[0]), b = !disc_is_zero(B[1]), c = !disc_is_zero(B[2]);
    const disc ab = a ? disc_product(B[0], x[1]) : b ? disc_product(B[1], x[0]) : (disc){0};

    *of = (disc){0};
    if (!a && !b && !c)
        return true;
    switch (op) {
    case QDOT_OP_NEG: *of = negate_disc(B[0]); return true;
    case QDOT_OP_ADD: *of = disc_sum(B[0], B[1]); return true;
    case QDOT_OP_SUB: *of = disc_sum(B[0], negate_disc(B[1])); return true;
    case QDOT_OP_MUL: *of = ab; return !(a && b);
    case QDOT_OP_MADD: *of = disc_sum(ab, B[2]); return !(a && b);
    case QDOT_OP_MSUB: *of = disc_sum(ab, negate_disc(B[2])); return !(a && b);
    case QDOT_OP_NMADD: *of = disc_sum(B[2], negate_disc(ab)); return !(a && b);
    case QDOT_OP_DIV:
        of->c = B[0].c / x[1].c;
        of->r = radius_of_quotient(of->c, B[0].r, x[1].c, x[1].r);
        return !b;
    default: return false;
    }
}

/* The disc B is far from 0 if its magnitudes differ by less than a factor of 5. */
static const double far = 1.5;

bool
qdot_disc_is_plain(const qdot_tape *tape, size_t k, const double *c, const double *r,
                   double *most, double *work)
{
    const uint32_t f = tape->code[k].op;
    double *radius = work + tape->places, *B = radius + tape->places, *RB = B + tape->places;

    if (f != QDOT_OP_TANH && f != QDOT_OP_EXP && f != QDOT_OP_SINH)
        return false;
    disc_load(tape, c, r, work);
    memset(B, 0, 2 * tape->places * sizeof *B);
    for (size_t j = 0; j < tape->length; j++) {
        const qdot_instruction *i = tape->code + j;
        const uint32_t from[3] = {i->x, i->y, i->z};
        disc of = {1, 0}, multiples[3] = {{0}}, x[3] = {{0}};

        for (int l = 0; l < qdot_operations[i->op].operands; l++) {
            x[l] = (disc){work[from[l]], radius[from[l]]};
            multiples[l] = (disc){B[from[l]], RB[from[l]]};
        }
        if (j != k && !find_multiple_in_result(i->op, multiples, x, &of))
            return false;
        disc_execute(i, work, radius);
        B[i->to] = of.c;
        RB[i->to] = of.r;
        if (i->op == QDOT_OP_SINCOS)
            B[i->y] = RB[i->y] = 0;
    }
    *most = 0;
    for (size_t j = 0; j < tape->outputs; j++) {
        const disc of = {B[tape->output[j]], RB[tape->output[j]]};

        if (!disc_is_zero(of) && !(fabs(of.c) > far * of.r))
            return false;
        *most = fmax(*most, fabs(of.c) + of.r);
    }
    return true;
}

double
qdot_disc_argument(const qdot_tape *tape, size_t k, const double *x, double *result, double *work)
{
    double argument;

    disc_load(tape, x, NULL, work);
    for (size_t j = 0; j < k; j++)
        disc_execute(tape->code + j, work, work + tape->places);
    argument = work[tape->code[k].x];
    disc_execute(tape->code + k, work, work + tape->places);
    *result = work[tape->code[k].to];
    return argument;
}
