/* taylor-order.c -- the recurrences evaluated, order by order. */
#include <math.h>
#include <string.h>

#include "tape/taylor-steps.h"

/* Bits without a pattern: the finalizer of MurmurHash3. */
static uint64_t
mix(uint64_t x)
{
    x = (x ^ x >> 33) * UINT64_C(0xff51afd7ed558ccd);
    x = (x ^ x >> 33) * UINT64_C(0xc4ceb9fe1a85ec53);
    return x ^ x >> 33;
}

double
qdot_taylor_chance(double time, size_t i)
{
    uint64_t bits;

    memcpy(&bits, &time, sizeof bits);
    return (double)(mix(bits + (i + 1) * UINT64_C(0x9e3779b97f4a7c15)) >> 11) * 0x1p-53;
}

void
qdot_taylor_draw(qdot_taylor *t, double time)
{
    for (size_t i = 0; i < t->n_drawn; i++) {
        struct qdot_taylor_drawn *d = t->drawn + i;

        d->row[0] = qdot_taylor_chance(time, i) < d->chance ? d->far : d->near;
    }
}

/* --- evaluation --------------------------------------------------------------------- */

static void
value_of_zero(qdot_taylor_step *i)
{
    double a = i->x[0], b = i->y[0], c = i->z[0], d = 0, e = 0;

    switch (i->zero) {
#define X(ID, name, operands, operations, calls, statement)                              \
    case QDOT_OP_##ID:                                                                   \
        statement;                                                                       \
        break;
#include "tape/operation.def"
#undef X
    case QDOT_ZERO_SINHCOSH:
        d = sinh(a);
        e = cosh(a);
        break;
    case QDOT_ZERO_POWER: d = pow(b, c); break;
    }
    i->to[0] = d;
    switch (i->op) {
    case QDOT_T_SINCOS:
    case QDOT_T_SINHCOSH: i->second[0] = e; break;
    case QDOT_T_TANH: i->second[0] = (1 - d) * (1 + d); break;
    case QDOT_T_DIV:
    case QDOT_T_RATIO: i->c = 1 / b; break;
    case QDOT_T_SQRT: i->c = 0.5 / d; break;
    case QDOT_T_POW: i->c = 1 / a; break;
    case QDOT_T_ATAN2: i->c = 1 / c; break;
    }
}

/* sum_{j=from..k-from} x_j x_{k-j} */
static inline double
square(const qdot_series_kernels *kernels, const double *x, int k, int from)
{
    int n = (k + 1) / 2 - from;
    double sum = 2 * kernels->dot[n](x + from, x + k - from);

    return k % 2 ? sum : sum + x[k / 2] * x[k / 2];
}

static void
arctangent_order(const qdot_series_kernels *kernels, const qdot_taylor_step *i, int k)
{
    qdot_series_dot *dot = kernels->dot[k];
    double numerator;

    i->second[k] = k * i->x[k];
    i->third[k] = k * i->y[k];
    numerator = dot(i->second + 1, i->y + k - 1) - dot(i->third + 1, i->x + k - 1);
    i->d[k] = (numerator - kernels->dot[k - 1](i->d + 1, i->z + k - 1)) * i->c;
}

void
qdot_taylor_order(qdot_taylor *t, int k)
{
    static const void *const row_of[QDOT_T_COUNT] = {
        [QDOT_T_END] = &&do_end,           [QDOT_T_NEG] = &&do_neg,
        [QDOT_T_ADD] = &&do_add,           [QDOT_T_SUB] = &&do_sub,
        [QDOT_T_SCALE] = &&do_scale,       [QDOT_T_SCALEADD] = &&do_scaleadd,
        [QDOT_T_SCALESUB] = &&do_scalesub, [QDOT_T_SCALEOFF] = &&do_scaleoff,
        [QDOT_T_MUL] = &&do_mul,           [QDOT_T_SQUARE] = &&do_square,
        [QDOT_T_MADD] = &&do_madd,         [QDOT_T_MSUB] = &&do_msub,
        [QDOT_T_NMADD] = &&do_nmadd,       [QDOT_T_DIV] = &&do_div,
        [QDOT_T_SQRT] = &&do_sqrt,         [QDOT_T_SINCOS] = &&do_sincos,
        [QDOT_T_SINHCOSH] = &&do_sinhcosh, [QDOT_T_EXP] = &&do_exp,
        [QDOT_T_POW] = &&do_pow,           [QDOT_T_RATIO] = &&do_ratio,
        [QDOT_T_TANH] = &&do_tanh,         [QDOT_T_ATAN2] = &&do_atan2,
    };
    const qdot_series_kernels *const kernels = t->kernels;
    const qdot_taylor_step *i = t->steps;
    const double inverse = t->inverse[k];
    qdot_series_dot *below, *upto; /* k terms, k + 1 terms */
    qdot_series_two both;
    double u, v;

    if (k == 0) {
        for (qdot_taylor_step *s = t->steps; s->op != QDOT_T_END; s++)
            value_of_zero(s);
        return;
    }
    below = kernels->dot[k];
    upto = kernels->dot[k + 1];
#define NEXT goto *row_of[(++i)->op]
    goto *row_of[i->op];
do_neg:
    i->to[k] = -i->x[k];
    NEXT;
do_add:
    i->to[k] = i->x[k] + i->y[k];
    NEXT;
do_sub:
    i->to[k] = i->x[k] - i->y[k];
    NEXT;
do_scale:
    i->to[k] = i->x[0] * i->y[k];
    NEXT;
do_scaleadd:
    i->to[k] = i->x[0] * i->y[k] + i->z[k];
    NEXT;
do_scalesub:
    i->to[k] = i->x[0] * i->y[k] - i->z[k];
    NEXT;
do_scaleoff:
    i->to[k] = i->z[k] - i->x[0] * i->y[k];
    NEXT;
do_mul:
    i->to[k] = upto(i->x, i->y + k);
    NEXT;
do_square:
    i->to[k] = square(kernels, i->x, k, 0);
    NEXT;
do_madd:
    i->to[k] = upto(i->x, i->y + k) + i->z[k];
    NEXT;
do_msub:
    i->to[k] = upto(i->x, i->y + k) - i->z[k];
    NEXT;
do_nmadd:
    i->to[k] = i->z[k] - upto(i->x, i->y + k);
    NEXT;
do_div:
    i->to[k] = (i->x[k] - below(i->y + 1, i->to + k - 1)) * i->c;
    NEXT;
do_sqrt:
    i->to[k] = (i->x[k] - square(kernels, i->to, k, 1)) * i->c;
    NEXT;
do_sincos:
    i->d[k] = k * i->x[k];
    both = kernels->pair[k](i->d + 1, i->second + k - 1, i->to + k - 1);
    i->to[k] = inverse * both.b;
    i->second[k] = -inverse * both.c;
    NEXT;
do_sinhcosh:
    i->d[k] = k * i->x[k];
    both = kernels->pair[k](i->d + 1, i->second + k - 1, i->to + k - 1);
    i->to[k] = inverse * both.b;
    i->second[k] = inverse * both.c;
    NEXT;
do_exp:
    i->d[k] = k * i->x[k];
    i->to[k] = inverse * below(i->d + 1, i->to + k - 1);
    NEXT;
do_pow:
    i->d[k] = k * i->x[k];
    u = below(i->d + 1, i->to + k - 1);
    v = below(i->x + 1, i->to + k - 1);
    i->to[k] = ((i->z[0] + 1) * inverse * u - v) * i->c;
    NEXT;
do_ratio:
    u = i->sign * k * i->x[k];
    i->d[k] = (u - kernels->dot[k - 1](i->d + 1, i->y + k - 1)) * i->c;
    i->to[k] = i->d[k] * inverse;
    NEXT;
do_tanh:
    i->d[k] = k * i->x[k];
    i->to[k] = inverse * below(i->d + 1, i->second + k - 1);
    i->second[k] = -square(kernels, i->to, k, 0);
    NEXT;
do_atan2:
    arctangent_order(kernels, i, k);
    i->to[k] = i->d[k] * inverse;
    NEXT;
do_end:
    return;
#undef NEXT
}

/* --- correction --------------------------------------------------------------------- */

/* What changes by d: coefficient k of a row, and its note of it. */
static inline void
change(const qdot_taylor *t, double *row, int k, double d)
{
    row[k] += d;
    row[t->stride - 1] = d;
}

void
qdot_taylor_correct(qdot_taylor *t, int k, size_t n, const double *newest)
{
    const size_t note = t->stride - 1;

    for (size_t i = 0; i < n; i++)
        change(t, t->coefficients + i * t->stride, k, newest[i]);
    for (const qdot_taylor_step *i = t->steps; i->op != QDOT_T_END; i++) {
        const double x = i->x[note], y = i->y[note], z = i->z[note];
        double d = 0;

        switch (i->op) {
        case QDOT_T_NEG: d = -x; break;
        case QDOT_T_ADD: d = x + y; break;
        case QDOT_T_SUB: d = x - y; break;
        case QDOT_T_SCALE: d = i->x[0] * y; break;
        case QDOT_T_SCALEADD: d = i->x[0] * y + z; break;
        case QDOT_T_SCALESUB: d = i->x[0] * y - z; break;
        case QDOT_T_SCALEOFF: d = z - i->x[0] * y; break;
        case QDOT_T_MUL: d = i->x[0] * y + i->y[0] * x; break;
        case QDOT_T_SQUARE: d = 2 * i->x[0] * x; break;
        case QDOT_T_MADD: d = i->x[0] * y + i->y[0] * x + z; break;
        case QDOT_T_MSUB: d = i->x[0] * y + i->y[0] * x - z; break;
        case QDOT_T_NMADD: d = z - i->x[0] * y - i->y[0] * x; break;
        case QDOT_T_DIV: d = (x - i->to[0] * y) * i->c; break;
        case QDOT_T_SQRT: d = x * i->c; break;
        case QDOT_T_SINCOS:
            d = i->second[0] * x;
            change(t, i->second, k, -i->to[0] * x);
            change(t, i->d, k, k * x);
            break;
        case QDOT_T_SINHCOSH:
            d = i->second[0] * x;
            change(t, i->second, k, i->to[0] * x);
            change(t, i->d, k, k * x);
            break;
        case QDOT_T_EXP:
            d = i->to[0] * x;
            change(t, i->d, k, k * x);
            break;
        case QDOT_T_POW:
            d = i->z[0] * i->to[0] * x * i->c;
            change(t, i->d, k, k * x);
            break;
        case QDOT_T_RATIO:
            d = i->sign * x * i->c;
            change(t, i->d, k, k * d);
            break;
        case QDOT_T_TANH:
            d = i->second[0] * x;
            change(t, i->second, k, -2 * i->to[0] * d);
            change(t, i->d, k, k * x);
            break;
        case QDOT_T_ATAN2:
            d = (i->y[0] * x - i->x[0] * y) * i->c;
            change(t, i->second, k, k * x);
            change(t, i->third, k, k * y);
            change(t, i->d, k, k * d);
            break;
        }
        change(t, i->to, k, d);
    }
}
