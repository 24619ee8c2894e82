/* taylor-code-order.c -- the recurrences as code: an order of a step. */
#include "series/taylor-code-sum.h"

static qdot_operand
inverse(const qdot_generator *g)
{
    return qdot_code_entry(QDOT_CODE_INVERSES, g->k);
}

static qdot_operand
slot(const qdot_generator *g, const qdot_taylor_step *s, size_t i)
{
    return qdot_code_work(g->step_slots[s - g->t->steps] + i);
}

/* slot <- a b */
static void
keep(qdot_generator *g, qdot_operand a, qdot_operand b, qdot_operand to)
{
    const int reg = fresh(g);

    do_one(g, QDOT_ASM_LOAD, reg, 0, a);
    do_one(g, QDOT_ASM_MUL, reg, reg, b);
    do_one(g, QDOT_ASM_STORE, reg, 0, to);
}

static void
keep_twice(qdot_generator *g, qdot_operand a, qdot_operand to)
{
    keep(g, a, qdot_code_work(QDOT_CODE_ORDERS + 2), to);
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

/* +- sum_{j=0..k} x_j x_{k-j}, of which `sum` is the rest. Slots: 2 x_0, 2 x_1 */
static void
finish_square(qdot_generator *g, const qdot_taylor_step *s, sum *sum, bool minus,
              const double *x, const double *to)
{
    late(g, sum, minus, g->k == 2 ? at(g, x, 1) : slot(g, s, 1), x);
    times(g, sum, minus, slot(g, s, 0), x, g->k);
    finish_sum(g, sum, to);
}

static void
square(qdot_generator *g, const qdot_taylor_step *s)
{
    sum sum = {.v = {.reg = -1}};

    add_past(g, &sum, false, NULL, s, 0);
    finish_square(g, s, &sum, false, s->x, s->to);
}

static void
square_zero(qdot_generator *g, const qdot_taylor_step *s)
{
    keep_twice(g, at(g, s->x, 0), slot(g, s, 0));
}

static void
square_one(qdot_generator *g, const qdot_taylor_step *s)
{
    keep_twice(g, at(g, s->x, 1), slot(g, s, 1));
}

/* Slots, over y_0: c_0, c_1, y_1 */
static void
quotient(qdot_generator *g, const qdot_taylor_step *s)
{
    const qdot_operand c = qdot_code_c(g, s);
    sum sum = {.v = {.reg = -1}};

    add_past(g, &sum, true, &c, s, 0);
    lately(g, &sum, true, slot(g, s, 1), s->y, slot(g, s, 2), s->to);
    add_scaled(g, &sum, false, &c, s->x);
    times(g, &sum, true, slot(g, s, 0), s->y, g->k);
    finish_sum(g, &sum, s->to);
}

static void
quotient_zero(qdot_generator *g, const qdot_taylor_step *s)
{
    keep(g, at(g, s->to, 0), qdot_code_c(g, s), slot(g, s, 0));
}

static void
quotient_one(qdot_generator *g, const qdot_taylor_step *s)
{
    keep(g, at(g, s->to, 1), qdot_code_c(g, s), slot(g, s, 1));
    keep(g, at(g, s->y, 1), qdot_code_c(g, s), slot(g, s, 2));
}

/* Slots: c_1/(2 c_0), c_1/c_0 */
static void
root(qdot_generator *g, const qdot_taylor_step *s)
{
    const qdot_operand c = qdot_code_c(g, s);
    sum sum = {.v = {.reg = -1}};

    add_past(g, &sum, true, &c, s, 0);
    late(g, &sum, true, slot(g, s, g->k > 2), s->to);
    add_scaled(g, &sum, false, &c, s->x);
    finish_sum(g, &sum, s->to);
}

static void
root_one(qdot_generator *g, const qdot_taylor_step *s)
{
    keep(g, at(g, s->to, 1), qdot_code_c(g, s), slot(g, s, 0));
    keep_twice(g, slot(g, s, 0), slot(g, s, 1));
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

/* Slots: (r + 1)/x_0, r p_0/x_0; p_1/x_0, x_1/x_0 */
static void
power(qdot_generator *g, const qdot_taylor_step *s)
{
    sum sum = past(g, s, 0), other = past(g, s, 1);

    weighted(g, s->x, s->d);
    lately(g, &sum, false, at(g, s->d, 1), s->to, at(g, s->to, 1), s->d);
    scale_sum(g, &sum, inverse(g));
    scale_sum(g, &sum, slot(g, s, 0));
    if (other.v.reg >= 0)
        add_product(g, &sum.v, true, qdot_code_c(g, s), other.v.reg);
    lately(g, &sum, true, slot(g, s, 3), s->to, slot(g, s, 2), s->x);
    times(g, &sum, false, slot(g, s, 1), s->x, g->k);
    finish_sum(g, &sum, s->to);
}

static void
power_zero(qdot_generator *g, const qdot_taylor_step *s)
{
    const int a = fresh(g), b = fresh(g);

    do_one(g, QDOT_ASM_LOAD, a, 0, at(g, s->z, 0));
    do_one(g, QDOT_ASM_ADD, b, a, qdot_code_work(QDOT_CODE_ORDERS + 1));
    do_one(g, QDOT_ASM_MUL, b, b, qdot_code_c(g, s));
    do_one(g, QDOT_ASM_STORE, b, 0, slot(g, s, 0));
    do_one(g, QDOT_ASM_MUL, a, a, at(g, s->to, 0));
    do_one(g, QDOT_ASM_MUL, a, a, qdot_code_c(g, s));
    do_one(g, QDOT_ASM_STORE, a, 0, slot(g, s, 1));
}

static void
power_one(qdot_generator *g, const qdot_taylor_step *s)
{
    keep(g, at(g, s->to, 1), qdot_code_c(g, s), slot(g, s, 2));
    keep(g, at(g, s->x, 1), qdot_code_c(g, s), slot(g, s, 3));
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

/* Slots: k/y_0; d_1/y_0, y_1/y_0 */
static void
ratio(qdot_generator *g, const qdot_taylor_step *s)
{
    const qdot_operand k = qdot_code_entry(QDOT_CODE_ORDERS, g->k);
    sum d = past(g, s, 0);

    scale_sum(g, &d, qdot_code_c(g, s));
    negate(&d);
    lately(g, &d, true, slot(g, s, 1), s->y, slot(g, s, 2), s->d);
    keep(g, k, qdot_code_c(g, s), slot(g, s, 0));
    times(g, &d, s->sign < 0, slot(g, s, 0), s->x, g->k);
    finish_weighted(g, total(g, &d), s);
}

static void
ratio_one(qdot_generator *g, const qdot_taylor_step *s)
{
    keep(g, at(g, s->d, 1), qdot_code_c(g, s), slot(g, s, 1));
    keep(g, at(g, s->y, 1), qdot_code_c(g, s), slot(g, s, 2));
}

/* Slots: 2 to_0, 2 to_1 */
static void
hyperbolic_tangent(qdot_generator *g, const qdot_taylor_step *s)
{
    sum other;

    weighted(g, s->x, s->d);
    integrated(g, s, 0, false, s->second, s->to);
    other = past(g, s, 1);
    negate(&other);
    finish_square(g, s, &other, true, s->to, s->second);
}

static void
tangent_zero(qdot_generator *g, const qdot_taylor_step *s)
{
    keep_twice(g, at(g, s->to, 0), slot(g, s, 0));
}

static void
tangent_one(qdot_generator *g, const qdot_taylor_step *s)
{
    keep_twice(g, at(g, s->to, 1), slot(g, s, 1));
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

enum { TO, SECOND, THIRD, D, X, Y, Z };

const qdot_code_recurrence qdot_code_recurrences[QDOT_T_COUNT] = {
    [QDOT_T_NEG] = {0, {{0}}, direct, NULL, NULL, 0},
    [QDOT_T_ADD] = {0, {{0}}, direct, NULL, NULL, 0},
    [QDOT_T_SUB] = {0, {{0}}, direct, NULL, NULL, 0},
    [QDOT_T_SCALE] = {0, {{0}}, direct, NULL, NULL, 0},
    [QDOT_T_SCALEADD] = {0, {{0}}, direct, NULL, NULL, 0},
    [QDOT_T_SCALESUB] = {0, {{0}}, direct, NULL, NULL, 0},
    [QDOT_T_SCALEOFF] = {0, {{0}}, direct, NULL, NULL, 0},
    [QDOT_T_MUL] = {1, {{X, Y}}, direct, NULL, NULL, 0},
    [QDOT_T_SQUARE] = {1, {{X, X}}, square, square_zero, square_one, 2},
    [QDOT_T_MADD] = {1, {{X, Y}}, direct, NULL, NULL, 0},
    [QDOT_T_MSUB] = {1, {{X, Y}}, direct, NULL, NULL, 0},
    [QDOT_T_NMADD] = {1, {{X, Y}}, direct, NULL, NULL, 0},
    [QDOT_T_DIV] = {1, {{TO, Y}}, quotient, quotient_zero, quotient_one, 3},
    [QDOT_T_SQRT] = {1, {{TO, TO}}, root, NULL, root_one, 2},
    [QDOT_T_SINCOS] = {2, {{D, SECOND}, {D, TO}}, wave, NULL, NULL, 0},
    [QDOT_T_SINHCOSH] = {2, {{D, SECOND}, {D, TO}}, wave, NULL, NULL, 0},
    [QDOT_T_EXP] = {1, {{D, TO}}, exponential, NULL, NULL, 0},
    [QDOT_T_ALONG] = {1, {{D, Y}}, along, NULL, NULL, 0},
    [QDOT_T_POW] = {2, {{D, TO}, {X, TO}}, power, power_zero, power_one, 4},
    [QDOT_T_RATIO] = {1, {{D, Y}}, ratio, NULL, ratio_one, 3},
    [QDOT_T_TANH] = {2,
                     {{D, SECOND}, {TO, TO}},
                     hyperbolic_tangent,
                     tangent_zero,
                     tangent_one,
                     2},
    [QDOT_T_LINK] = {0, {{0}}, integral, NULL, NULL, 0},
    [QDOT_T_ATAN2] = {3, {{SECOND, Y}, {THIRD, X}, {D, Z}}, arctangent, NULL, NULL, 0},
};

const double *
qdot_code_factor(const qdot_taylor_step *s, unsigned char name)
{
    const double *const rows[] = {[TO] = s->to, [SECOND] = s->second, [THIRD] = s->third,
                                  [D] = s->d,   [X] = s->x,           [Y] = s->y,
                                  [Z] = s->z};

    return rows[name];
}
