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
#define X(ID, name, operands, operations, calls, statement, slopes)                      \
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

#define ORDERS(X)                                                                        \
    X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12) X(13) X(14) X(15)     \
        X(16) X(17) X(18) X(19) X(20) X(21) X(22) X(23) X(24) X(25) X(26) X(27) X(28)    \
            X(29) X(30) X(31) X(32) X(33) X(34) X(35) X(36) X(37) X(38) X(39) X(40)      \
                X(41) X(42) X(43) X(44) X(45) X(46) X(47) X(48)

/* Order k of a program, k known to the compiler. */
typedef void order_function(const qdot_taylor *t);

#define NAME(x) portable_##x
#define MA(a, b, c) ((a) * (b) + (c))
#include "tape/taylor-order.def"
#undef NAME
#undef MA

#if defined __x86_64__ && defined __GNUC__ && !defined __clang__
#define X86_KINDS
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#define NAME(x) fma_##x
#define MA(a, b, c) __builtin_fma(a, b, c)
#include "tape/taylor-order.def"
#undef NAME
#undef MA
#pragma GCC pop_options
#endif

static order_function *const *
orders(void)
{
#ifdef X86_KINDS
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return fma_orders;
#endif
    return portable_orders;
}

static void
order_zero(const qdot_taylor *t)
{
    for (qdot_taylor_step *s = t->steps; s->op != QDOT_T_END; s++)
        value_of_zero(s);
}

void
qdot_taylor_order(qdot_taylor *t, int k)
{
    if (k > 0) {
        orders()[k](t);
        return;
    }
    order_zero(t);
    qdot_taylor_changes_stale(t);
}

void
qdot_taylor_integrate(qdot_taylor *t, double unit, int from, int to)
{
    order_function *const *order = orders();

    if (unit != t->unit) {
        t->unit = unit;
        for (int k = 1; k <= QDOT_SERIES_MOST; k++)
            t->factor[k] = unit * t->inverse[k];
    }
    for (int k = from; k <= to; k++) {
        const double factor = t->factor[k + 1];

        if (k == 0)
            order_zero(t);
        else
            order[k](t);
        for (size_t l = 0; l < t->n_links; l++)
            t->links[l].to[k + 1] = factor * t->links[l].from[k];
    }
}
