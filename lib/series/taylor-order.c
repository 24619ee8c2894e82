/* taylor-order.c -- evaluates the recurrences for Taylor coefficients order by order. */
#include <math.h>
#include <string.h>

#include "num/kinds.h"
#include "num/samples.h"
#include "series/taylor-code.h"
#include "series/taylor.h"
#include "series/taylor-order.h"

/* A hash without visible pattern (the finalizer of MurmurHash3). */
static uint64_t
mix_bits(uint64_t x)
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
    return (double)(mix_bits(bits + (i + 1) * UINT64_C(0x9e3779b97f4a7c15)) >> 11) * 0x1p-53;
}

void
qdot_taylor_draw(qdot_taylor *t, double time)
{
    for (size_t i = 0; i < t->n_drawn; i++) {
        struct qdot_taylor_drawn *d = t->drawn + i;

        d->row[0] = qdot_taylor_chance(time, i) < d->chance ? d->far : d->near;
    }
}

/* --- computing coefficients one order at a time ------------------------------------- */

void
qdot_taylor_value(qdot_taylor_step *i)
{
    double a = i->x[0], b = i->y[0], c = i->z[0], d = 0, e = 0;

    switch (i->zero) {
#define X(ID, name, operands, operations, calls, statement, ...)                         \
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
    case QDOT_ZERO_RATE: d = i->c * i->x[1]; break;
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

#define NAME(x) portable_##x
#define MA(a, b, c) QDOT_MA(a, b, c)
#define TABLE static qdot_taylor_function *const portable
#include "series/taylor-order.def"

void
qdot_taylor_find_functions(qdot_taylor *t)
{
    t->functions = portable;
#ifdef QDOT_X86_KINDS
    if (qdot_kind_is_here(1))
        t->functions = qdot_taylor_order_fma;
#endif
}

static void
compute_order_zero(const qdot_taylor *t)
{
    for (size_t i = 0; i < t->length; i++)
        qdot_taylor_value(t->steps + i);
}

/* Compute order k of the first n steps, except those with constant rows, by the functions for that order. */
static inline void
compute_order(const qdot_taylor *t, size_t n, qdot_taylor_function *const *function)
{
    const qdot_series_kernels *kernels = t->kernels;
    qdot_taylor_step *s = t->steps + t->still, *const end = t->steps + n;

    while (s < end) {
        function[s->op](s, kernels);
        s++;
    }
}

void
qdot_taylor_order(qdot_taylor *t, int k)
{
    if (k > 0) {
        compute_order(t, t->length, t->functions[k]);
        return;
    }
    if (t->code && t->n_blocks > 0)
        qdot_taylor_code_begin(t->code, t);
    else
        compute_order_zero(t);
    qdot_taylor_changes_stale(t, 0);
}

void
qdot_taylor_order_leading(qdot_taylor *t, int k)
{
    qdot_taylor_function *const(*const function)[QDOT_T_COUNT] = t->functions;
    qdot_taylor_step *s = t->steps, *const end = s + t->length;

    for (s += k > -t->motion->program.lead ? t->still : 0; s < end; s++) {
        const int order = s < t->steps + t->still ? 0 : k + s->lead;

        if (order > 0)
            function[order][s->op](s, t->kernels);
        else if (order == 0)
            qdot_taylor_value(s);
    }
    qdot_taylor_changes_stale(t, k);
}

/* Begin the links (inputs that are integrals): set coefficient 1 from order 0, and the unit of time for later
 * orders. */
void
qdot_taylor_begin_links(qdot_taylor *t, double unit)
{
    for (size_t l = 0; l < t->n_links; l++) {
        qdot_taylor_step *link = t->steps + t->length + l;
        const double first = unit * link->x[0];

        link->c = unit;
        link->to[1] = first;
        if (link->second) {
            link->second[1] = unit * link->to[0];
            link->second[2] = 0.5 * unit * first;
        }
    }
    if (t->code)
        qdot_taylor_code_unit(t->code, unit);
}

void
qdot_taylor_order_links(qdot_taylor *t, int k)
{
    qdot_taylor_function *function;

    if (k == 0) {
        qdot_taylor_begin_links(t, t->unit);
        return;
    }
    function = t->functions[k][QDOT_T_LINK];
    for (size_t l = 0; l < t->n_links; l++)
        function(t->steps + t->length + l, t->kernels);
}

void
qdot_taylor_begin(qdot_taylor *t, double unit)
{
    if (t->code && t->n_blocks == 0) {
        for (size_t l = 0; l < t->n_links; l++)
            t->steps[t->length + l].c = unit;
        qdot_taylor_code_unit(t->code, unit);
        qdot_taylor_code_begin(t->code, t);
        return;
    }
    compute_order_zero(t);
    qdot_taylor_begin_links(t, unit);
}

void
qdot_taylor_extend(qdot_taylor *t, int from, int to)
{
    qdot_taylor_function *const (*const function)[QDOT_T_COUNT] = t->functions;
    const size_t n = t->length + t->n_links;

    if (from == 1 && qdot_taylor_is_code(t, to)) {
        qdot_taylor_code_run(t->code, t);
        return;
    }
    for (int k = from; k <= to; k++)
        compute_order(t, n, function[k]);
}
