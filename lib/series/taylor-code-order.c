/* taylor-code-order.c -- the recurrences as code: an order of a step. */
#include "series/taylor-code-sum.h"

static qdot_operand
inverse(const qdot_generator *g)
{
    return qdot_code_entry(QDOT_CODE_INVERSES, g->k);
}

/* x_i times c of a step, x_i twice: factors that no order changes. Those of order 1 are there from
 * order 2 on. */
static qdot_operand
by_c(qdot_generator *g, const qdot_taylor_step *s, const double *x, int i)
{
    return qdot_code_composed(g, qdot_code_c(g, s), at(g, x, i));
}

static qdot_operand
twice(qdot_generator *g, qdot_operand a)
{
    return qdot_code_composed(g, a, qdot_code_work(QDOT_CODE_ORDERS + 2));
}

/* -+ x_1 y_{k-1} and y_1 x_{k-1} times c, as `lately`. */
static void
lately_by_c(qdot_generator *g, sum *sum, bool minus, const qdot_taylor_step *s, const double *x,
            const double *y)
{
    if (g->lag > 1 && g->k > 1)
        lately(g, sum, minus, by_c(g, s, x, 1), y, by_c(g, s, y, 1), x);
}

/* --- the recurrences ---------------------------------------------------------------- */

/* A sum or a product. */
static void
direct(qdot_generator *g, const qdot_taylor_step *s)
{
    sum sum = {.v = {.reg = -1}};

    add_terms(g, &sum, false, NULL, s);
    finish_sum(g, &sum, s->to);
}

/* +- sum_{j=0..k} x_j x_{k-j}, of which `sum` is the rest. */
static void
finish_square(qdot_generator *g, sum *sum, bool minus, const double *x, const double *to)
{
    if (g->lag > 1 && g->k > 1)
        late(g, sum, minus, g->k == 2 ? at(g, x, 1) : twice(g, at(g, x, 1)), x);
    times(g, sum, minus, twice(g, at(g, x, 0)), x, g->k);
    finish_sum(g, sum, to);
}

static void
square(qdot_generator *g, const qdot_taylor_step *s)
{
    sum sum = {.v = {.reg = -1}};

    add_past(g, &sum, false, NULL, s, 0);
    finish_square(g, &sum, false, s->x, s->to);
}

static void
quotient(qdot_generator *g, const qdot_taylor_step *s)
{
    const qdot_operand c = qdot_code_c(g, s);
    sum sum = {.v = {.reg = -1}};

    add_past(g, &sum, true, &c, s, 0);
    lately_by_c(g, &sum, true, s, s->to, s->y);
    add_scaled(g, &sum, false, &c, s->x);
    times(g, &sum, true, by_c(g, s, s->to, 0), s->y, g->k);
    finish_sum(g, &sum, s->to);
}

static void
root(qdot_generator *g, const qdot_taylor_step *s)
{
    const qdot_operand c = qdot_code_c(g, s);
    sum sum = {.v = {.reg = -1}};

    add_past(g, &sum, true, &c, s, 0);
    if (g->lag > 1 && g->k > 1)
        late(g, &sum, true,
             g->k == 2 ? by_c(g, s, s->to, 1) : twice(g, by_c(g, s, s->to, 1)), s->to);
    add_scaled(g, &sum, false, &c, s->x);
    finish_sum(g, &sum, s->to);
}

/* k times coefficient k of x. */
static void
weighted(qdot_generator *g, const double *x, const double *to)
{
    sum d = {.v = {.reg = -1}};

    times(g, &d, false, qdot_code_entry(QDOT_CODE_ORDERS, g->k), x, g->k);
    finish_sum(g, &d, to);
}

/* d_1/k, for a product with d over k; k > 1. */
static qdot_operand
first_over_order(qdot_generator *g, const qdot_taylor_step *s)
{
    const int reg = fresh(g);

    do_one(g, QDOT_ASM_LOAD, reg, 0, at(g, s->d, 1));
    do_one(g, QDOT_ASM_MUL, reg, reg, inverse(g));
    return qdot_asm_in(reg);
}

/* y of y' = x' u: product i of a step is that of d and u. */
static void
integrated(qdot_generator *g, const qdot_taylor_step *s, int i, bool minus,
           const double *u, const double *to)
{
    const qdot_operand over = inverse(g);
    sum sum = {.v = {.reg = -1}};

    if (g->lag > 1) {
        add_past(g, &sum, minus, NULL, s, i);
        if (g->k > 2)
            late(g, &sum, minus, at(g, u, 1), s->d);
        scale_sum(g, &sum, over);
        if (g->k > 1)
            late(g, &sum, minus, first_over_order(g, s), u);
    } else {
        add_past(g, &sum, minus, &over, s, i);
    }
    times(g, &sum, minus, at(g, u, 0), s->x, g->k);
    finish_sum(g, &sum, to);
}

static void
wave(qdot_generator *g, const qdot_taylor_step *s)
{
    weighted(g, s->x, s->d);
    integrated(g, s, 0, false, s->second, s->to);
    integrated(g, s, 1, s->op == QDOT_T_SINCOS, s->to, s->second);
}

static void
exponential(qdot_generator *g, const qdot_taylor_step *s)
{
    weighted(g, s->x, s->d);
    integrated(g, s, 0, false, s->to, s->to);
}

static void
along(qdot_generator *g, const qdot_taylor_step *s)
{
    weighted(g, s->x, s->d);
    integrated(g, s, 0, false, s->y, s->to);
}

/* ((r + 1)/k sum d p - sum x p)/x_0 */
static void
power(qdot_generator *g, const qdot_taylor_step *s)
{
    const qdot_operand c = qdot_code_c(g, s), r = by_c(g, s, s->z, 0);
    sum sum = past(g, s, 0), other = past(g, s, 1);
    int slopes;

    weighted(g, s->x, s->d);
    lately(g, &sum, false, at(g, s->d, 1), s->to, at(g, s->to, 1), s->d);
    scale_sum(g, &sum, inverse(g));
    slopes = sum.v.reg;
    scale_sum(g, &sum, r);
    if (slopes >= 0)
        add_product(g, &sum.v, false, c, slopes);
    if (other.v.reg >= 0)
        add_product(g, &sum.v, true, c, other.v.reg);
    lately_by_c(g, &sum, true, s, s->x, s->to);
    times(g, &sum, false, qdot_code_composed(g, r, at(g, s->to, 0)), s->x, g->k);
    finish_sum(g, &sum, s->to);
}

/* d, then to = d/k */
static void
finish_weighted(qdot_generator *g, value d, const qdot_taylor_step *s)
{
    value l = d;

    finish(g, d, s->d, g->k);
    scale(g, &l, inverse(g));
    finish(g, l, s->to, g->k);
}

static void
ratio(qdot_generator *g, const qdot_taylor_step *s)
{
    const qdot_operand over = qdot_code_work(QDOT_CODE_MOMENT); /* k/y_0 */
    const int reg = fresh(g);
    sum d = past(g, s, 0);

    scale_sum(g, &d, qdot_code_c(g, s));
    negate(&d);
    lately_by_c(g, &d, true, s, s->d, s->y);
    do_one(g, QDOT_ASM_LOAD, reg, 0, qdot_code_entry(QDOT_CODE_ORDERS, g->k));
    do_one(g, QDOT_ASM_MUL, reg, reg, qdot_code_c(g, s));
    do_one(g, QDOT_ASM_STORE, reg, 0, over);
    times(g, &d, s->sign < 0, over, s->x, g->k);
    finish_weighted(g, total(g, &d), s);
}

static void
hyperbolic_tangent(qdot_generator *g, const qdot_taylor_step *s)
{
    sum other;

    weighted(g, s->x, s->d);
    integrated(g, s, 0, false, s->second, s->to);
    other = past(g, s, 1);
    negate(&other);
    finish_square(g, &other, true, s->to, s->second);
}

/* second, third, d: j x_j, j y_j, j to_j */
static void
arctangent(qdot_generator *g, const qdot_taylor_step *s)
{
    sum d = past(g, s, 0);

    weighted(g, s->x, s->second);
    weighted(g, s->y, s->third);
    for (int i = 1; i < 3; i++) {
        const value v = past(g, s, i).v;

        if (v.reg >= 0 && d.v.reg >= 0)
            add_value(g, &d.v, true, v.reg);
        else if (v.reg >= 0)
            d.v = (value){.reg = v.reg, .negative = true};
    }
    lately(g, &d, false, at(g, s->second, 1), s->y, at(g, s->y, 1), s->second);
    lately(g, &d, true, at(g, s->third, 1), s->x, at(g, s->x, 1), s->third);
    lately(g, &d, true, at(g, s->d, 1), s->z, at(g, s->z, 1), s->d);
    times(g, &d, false, at(g, s->y, 0), s->second, g->k);
    times(g, &d, true, at(g, s->x, 0), s->third, g->k);
    scale_sum(g, &d, qdot_code_c(g, s));
    finish_weighted(g, d.v, s);
}

static void
integral(qdot_generator *g, const qdot_taylor_step *s)
{
    sum once = {.v = {.reg = -1}}, twice = once;

    if (g->exact) {
        times(g, &once, false, qdot_code_entry(QDOT_CODE_ONCE_LOW, g->k), s->x, g->k);
        times(g, &twice, false, qdot_code_entry(QDOT_CODE_TWICE_LOW, g->k), s->x, g->k);
    }
    times(g, &once, false, qdot_code_entry(QDOT_CODE_ONCE, g->k), s->x, g->k);
    times(g, &twice, false, qdot_code_entry(QDOT_CODE_TWICE, g->k), s->x, g->k);
    finish(g, total(g, &once), s->to, g->k + 1);
    if (s->second)
        finish(g, total(g, &twice), s->second, g->k + 2);
}

const qdot_code_recurrence qdot_code_recurrences[QDOT_T_COUNT] = {
    [QDOT_T_NEG] = {direct, 0},
    [QDOT_T_ADD] = {direct, 0},
    [QDOT_T_SUB] = {direct, 0},
    [QDOT_T_SCALE] = {direct, 0},
    [QDOT_T_SCALEADD] = {direct, 0},
    [QDOT_T_SCALESUB] = {direct, 0},
    [QDOT_T_SCALEOFF] = {direct, 0},
    [QDOT_T_MUL] = {direct, 0},
    [QDOT_T_SQUARE] = {square, 2},
    [QDOT_T_MADD] = {direct, 0},
    [QDOT_T_MSUB] = {direct, 0},
    [QDOT_T_NMADD] = {direct, 0},
    [QDOT_T_DIV] = {quotient, 3},
    [QDOT_T_SQRT] = {root, 2},
    [QDOT_T_SINCOS] = {wave, 0},
    [QDOT_T_SINHCOSH] = {wave, 0},
    [QDOT_T_EXP] = {exponential, 0},
    [QDOT_T_ALONG] = {along, 0},
    [QDOT_T_POW] = {power, 4},
    [QDOT_T_RATIO] = {ratio, 2},
    [QDOT_T_TANH] = {hyperbolic_tangent, 2},
    [QDOT_T_LINK] = {integral, 0},
    [QDOT_T_ATAN2] = {arctangent, 0},
};
