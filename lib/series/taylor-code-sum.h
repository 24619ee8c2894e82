/* taylor-code-sum.h -- sums of known coefficients as code: what a recurrence is written with.
 * Internal to series/: for the files that write recurrences (taylor-code.h).
 *
 * Of a product sum_{j=0..k} x_j y_{k-j} the terms without orders 0, 1, k - 1 and k are in
 * a vector by now (taylor-code.c). The others are added one by one, in the order in which
 * they come to be known: from the newest to the result it is one operation.
 */
#ifndef QDOT_SERIES_TAYLOR_CODE_SUM_H
#define QDOT_SERIES_TAYLOR_CODE_SUM_H

#include "series/taylor-generator.h"

enum {
    QDOT_CODE_TERMS = 24,
    latency = 4,
    latency_of_vectors = 12, /* cycles from a newest coefficient to the next sum of which its vector becomes a part */
    latency_of_division = 14
};

/* --- allocation of registers -------------------------------------------------------- */

static inline int
touch(qdot_generator *g, int reg)
{
    qdot_asm_use(&g->m, reg);
    return reg;
}

static inline int
code_fresh_register(qdot_generator *g)
{
    const int reg = qdot_asm_fresh(&g->m, g->first_scalar, g->behind_scalars);

    g->held[reg] = QDOT_CODE_NONE;
    return reg;
}

static inline void
code_hold(qdot_generator *g, int reg, uint32_t row, int k)
{
    g->held[reg] = row;
    g->held_order[reg] = k;
    g->where[4 * row + (uint32_t)(k & 3)] = (unsigned char)reg;
}

/* The register that holds coefficient k of a row that varies; the coefficient is loaded if no register holds it. */
static inline int
code_coefficient_register(qdot_generator *g, uint32_t row, int k)
{
    unsigned char *where = &g->where[4 * row + (uint32_t)(k & 3)];
    int reg = *where;

    if (g->held[reg] == row && g->held_order[reg] == k)
        return touch(g, reg);
    reg = code_fresh_register(g);
    do_one(g, QDOT_ASM_LOAD, reg, 0, qdot_code_coefficient(g, row, k));
    code_hold(g, reg, row, k);
    return reg;
}

/* --- adding terms of sums ----------------------------------------------------------- */

/* A number in a register, or the negative of it. */
typedef struct {
    int reg; /* the register that holds the number; -1: the number is 0 */
    bool own, negative;
    int ready;
} value;

/* A term of a sum: +- factor times coefficient k of a row, or times an earlier sum; `plain`: without factor. */
typedef struct {
    bool minus, plain;
    qdot_operand factor;
    uint32_t row; /* row of the coefficient; QDOT_CODE_NONE: the term is an earlier sum */
    int k;
    uint32_t past; /* index of the earlier sum, if the term is one */
} term;

typedef struct {
    value v; /* the sum of the terms added so far */
    int n;
    term terms[QDOT_CODE_TERMS];
} sum;

static inline qdot_operand
code_at(const qdot_generator *g, const double *row, int k)
{
    return qdot_code_coefficient(g, qdot_code_row(g, row), k);
}

static inline void
sum_add_scaled(qdot_generator *g, sum *s, bool minus, qdot_operand factor, const double *x, int k)
{
    const uint32_t row = qdot_code_row(g, x);

    if (g->moving[row] && k > 0)
        s->terms[s->n++] = (term){minus, false, factor, row, k, 0};
}

static inline void
add_value(qdot_generator *g, value *v, bool minus, int b)
{
    const int a = v->reg;

    touch(g, a);
    v->reg = code_fresh_register(g);
    if (v->negative && !minus)
        do_one(g, QDOT_ASM_SUB, v->reg, b, qdot_asm_in(a));
    else if (v->negative != minus)
        do_one(g, QDOT_ASM_SUB, v->reg, a, qdot_asm_in(b));
    else
        do_one(g, QDOT_ASM_ADD, v->reg, a, qdot_asm_in(b));
    v->negative = v->negative && minus;
    v->own = true;
}

static inline void
value_add_product(qdot_generator *g, value *v, bool minus, qdot_operand factor, int b)
{
    const int a = v->reg;

    if (a < 0) {
        v->reg = code_fresh_register(g);
        do_one(g, QDOT_ASM_MUL, v->reg, b, factor);
        v->negative = minus;
    } else if (v->own) {
        do_one(g, qdot_asm_fused(false, minus, v->negative), touch(g, a), b, factor);
        v->negative = false;
    } else {
        touch(g, a);
        v->reg = code_fresh_register(g);
        do_one(g, QDOT_ASM_LOAD, v->reg, 0, factor);
        do_one(g, qdot_asm_fused(true, minus, v->negative), v->reg, b, qdot_asm_in(a));
        v->negative = false;
    }
    v->own = true;
}

/* The time (in cycles) at which the coefficients that sum n, and the sums continuing it, read become known. */
static inline int
past_ready(qdot_generator *g, uint32_t n)
{
    int when = 0;

    do {
        const qdot_code_sum *s = g->sums.at + n;
        const int x = *qdot_code_ready(g, s->x, g->k - g->lag);
        const int y = *qdot_code_ready(g, s->y, g->k - g->lag);

        when = x > when ? x : when;
        when = y > when ? y : when;
    } while (++n < g->sums.n && g->sums.at[n].further);
    return when + latency_of_vectors;
}

static inline int
term_ready(qdot_generator *g, const term *t)
{
    return t->row != QDOT_CODE_NONE ? *qdot_code_ready(g, t->row, t->k)
                                    : past_ready(g, t->past);
}

/* Sort the terms of a sum by the time at which they become known, so that the latest is added last. */
static inline void
sum_sort_terms(qdot_generator *g, sum *s, int *when)
{
    for (int i = 0; i < s->n; i++) {
        const term now = s->terms[i];
        const int now_ready = term_ready(g, &now);
        int j = i;

        for (; j > 0 && when[j - 1] > now_ready; j--) {
            s->terms[j] = s->terms[j - 1];
            when[j] = when[j - 1];
        }
        s->terms[j] = now;
        when[j] = now_ready;
    }
    if (s->n > 1 && s->v.reg < 0 && s->terms[1].plain && !s->terms[0].plain) {
        const term first = s->terms[0]; /* put a plain term first, so that the product is added to it by one instruction */
        const int first_ready = when[0];

        s->terms[0] = s->terms[1];
        s->terms[1] = first;
        when[0] = when[1];
        when[1] = first_ready;
    }
}

/* The register that holds the first number of sum n, which is loaded if necessary. */
static inline int
past_register(qdot_generator *g, uint32_t n)
{
    const qdot_code_vector *v = &g->sums.at[n].v;
    int reg = v->reg[0];

    if (reg < 0)
        do_one(g, QDOT_ASM_LOAD, reg = code_fresh_register(g), 0, qdot_code_work(v->at));
    return reg;
}

/* Write the value of a sum that consists of one negative product. */
static inline value
less(qdot_generator *g, const term *t, int when)
{
    const int b = code_coefficient_register(g, t->row, t->k), reg = code_fresh_register(g);

    do_one(g, QDOT_ASM_LOAD, reg, 0, t->factor);
    do_one(g, QDOT_ASM_NMADD_OVER, reg, b, qdot_code_work(QDOT_CODE_ORDERS));
    return (value){.reg = reg, .own = true, .ready = when + latency};
}

/* The time at which a sum is known if a term known at `when` is added to a sum known at `before`. */
static inline int
time_behind(int before, int when)
{
    return (before > when ? before : when) + latency;
}

/* Whether terms known at the times `when` are added faster in two partial sums than in one. */
static inline bool
in_two(int first, const int *when, int n)
{
    int one = first, row[2] = {first, 0};

    for (int i = 0; i < n; i++) {
        const int shorter = row[1] < row[0];

        one = time_behind(one, when[i]);
        row[shorter] = time_behind(row[shorter], when[i]);
    }
    return n > 3 && time_behind(row[0], row[1]) + latency < one;
}

static inline void
value_add_term(qdot_generator *g, value *v, const term *t, int when)
{
    const int b = t->row != QDOT_CODE_NONE ? code_coefficient_register(g, t->row, t->k)
                                           : past_register(g, t->past);

    if (t->plain && v->reg < 0) {
        *v = (value){.reg = b, .negative = t->minus, .ready = when};
        return;
    }
    if (t->plain)
        add_value(g, v, t->minus, b);
    else
        value_add_product(g, v, t->minus, t->factor, b);
    v->ready = time_behind(v->ready, when);
}

static inline value
total(qdot_generator *g, sum *s)
{
    int when[QDOT_CODE_TERMS];
    value v[2] = {s->v, {.reg = -1}};
    bool two;

    sum_sort_terms(g, s, when);
    if (s->n == 1 && v->reg < 0 && s->terms->minus && !s->terms->plain &&
        s->terms->factor.memory && s->terms->row != QDOT_CODE_NONE)
        return less(g, s->terms, when[0]);
    two = in_two(v->ready, when, s->n);
    for (int i = 0; i < s->n; i++)
        value_add_term(g, v + (two && v[1].ready < v[0].ready), s->terms + i, when[i]);
    if (v[1].reg >= 0) {
        const int ready = time_behind(v[0].ready, v[1].ready);

        if (v[0].negative && !v[1].negative) {
            const value first = v[0];

            v[0] = v[1];
            v[1] = first;
        }
        add_value(g, v, v[1].negative, v[1].reg);
        v->ready = ready;
    }
    return v[0];
}

/* Multiply or divide the value v by `factor`, depending on the operation `name`. */
static inline void
scale_by(qdot_generator *g, qdot_asm_operation name, value *v, qdot_operand factor)
{
    const int a = v->reg;

    if (a < 0)
        return;
    touch(g, a);
    v->reg = code_fresh_register(g);
    do_one(g, name, v->reg, a, factor);
    v->own = true;
    v->ready += name == QDOT_ASM_DIV ? latency_of_division : latency;
}

static inline void
value_scale(qdot_generator *g, value *v, qdot_operand factor)
{
    scale_by(g, QDOT_ASM_MUL, v, factor);
}

/* Add up the terms of a sum, and multiply by a factor. */
static inline void
scale_sum(qdot_generator *g, sum *s, qdot_operand factor)
{
    s->v = total(g, s);
    s->n = 0;
    value_scale(g, &s->v, factor);
}

/* Store the value v as coefficient k of a row. */
static inline void
value_finish(qdot_generator *g, value v, const double *to, int k)
{
    const uint32_t row = qdot_code_row(g, to);

    if (v.reg < 0) {
        v.reg = code_fresh_register(g);
        v.own = true;
        do_one(g, QDOT_ASM_LOAD, v.reg, 0, qdot_code_work(QDOT_CODE_ORDERS));
    }
    if (v.negative)
        value_scale(g, &v, qdot_code_work(QDOT_CODE_INVERSES));
    do_one(g, QDOT_ASM_STORE, v.reg, 0, qdot_code_coefficient(g, row, k));
    *qdot_code_ready(g, row, k) = v.ready;
    if (v.own)
        code_hold(g, v.reg, row, k);
}

static inline void
finish_sum(qdot_generator *g, sum *s, const double *to)
{
    value_finish(g, total(g, s), to, g->k);
}

/* --- products of lower orders ------------------------------------------------------- */

/* Add to s the term +- sum number n (of products of orders from `lag` on), times a factor; NULL: without factor. */
static inline void
add_past_of(qdot_generator *g, sum *s, bool minus, const qdot_operand *factor, uint32_t n)
{
    term t = {.minus = minus, .plain = !factor, .row = QDOT_CODE_NONE, .past = n};

    if (n == QDOT_CODE_NONE || g->k < 2 * g->lag)
        return;
    if (factor)
        t.factor = *factor;
    s->terms[s->n++] = t;
}

/* Add convolution number i of a step to the sum, except the products with an order below `lag`. */
static inline void
add_past(qdot_generator *g, sum *sum, bool minus, const qdot_operand *factor,
         const qdot_taylor_step *s, int i)
{
    add_past_of(g, sum, minus, factor,
                g->step_sums[3 * (size_t)(s - g->t->steps) + (size_t)i]);
}

static inline sum
past(qdot_generator *g, const qdot_taylor_step *s, int i)
{
    sum sum = {.v = {.reg = -1}};

    add_past(g, &sum, false, NULL, s, i);
    sum.v = total(g, &sum);
    sum.n = 0;
    return sum;
}

/* Add the products of orders 1 and k - 1, which the vectors of sums do not contain: x_1 times y_{k-1}. */
static inline void
late(qdot_generator *g, sum *s, bool minus, qdot_operand x1, const double *y)
{
    if (g->lag > 1)
        sum_add_scaled(g, s, minus, x1, y, g->k - 1);
}

/* Add both products of orders 1 and k - 1, x_1 y_{k-1} and y_1 x_{k-1}, with x_1 and y_1 as operands. */
static inline void
lately(qdot_generator *g, sum *s, bool minus, qdot_operand x1, const double *y,
       qdot_operand y1, const double *x)
{
    if (!g->moving[qdot_code_row(g, x)] || !g->moving[qdot_code_row(g, y)])
        return;
    late(g, s, minus, x1, y);
    if (g->k > 2)
        late(g, s, minus, y1, x);
}

/* --- sums inside other sums --------------------------------------------------------- */

static inline void add_terms(qdot_generator *g, sum *sum, bool minus,
                             const qdot_operand *scale, const qdot_taylor_step *s);

/* Add the term +- coefficient k of a row times a factor (NULL: none); for a folded row the terms of its sum. */
static inline void
add_scaled(qdot_generator *g, sum *s, bool minus, const qdot_operand *scale,
           const double *x)
{
    const uint32_t row = qdot_code_row(g, x);
    term t = {.minus = minus, .plain = !scale, .row = row, .k = g->k};

    if (!g->moving[row])
        return;
    if (g->folded[row]) {
        add_terms(g, s, minus, scale, g->t->steps + g->maker[row]);
        return;
    }
    if (scale)
        t.factor = *scale;
    s->terms[s->n++] = t;
}

static inline void
sum_add_row(qdot_generator *g, sum *s, bool minus, const double *x)
{
    add_scaled(g, s, minus, NULL, x);
}

static inline qdot_operand
composed(qdot_generator *g, const qdot_operand *scale, qdot_operand factor)
{
    return scale ? qdot_code_composed(g, *scale, factor) : factor;
}

/* Add to a sum the terms of the product of a step that its vectors lack: those with the newest and the lowest
 * orders. */
static inline void
add_product_terms(qdot_generator *g, sum *sum, bool minus, const qdot_operand *scale,
                  const qdot_taylor_step *s)
{
    const bool x = g->moving[qdot_code_row(g, s->x)], y = g->moving[qdot_code_row(g, s->y)];

    add_past(g, sum, minus, scale, s, 0);
    if (x && y && g->lag > 1 && g->k > 1) {
        sum_add_scaled(g, sum, minus, composed(g, scale, code_at(g, s->x, 1)), s->y, g->k - 1);
        if (g->k > 2)
            sum_add_scaled(g, sum, minus, composed(g, scale, code_at(g, s->y, 1)), s->x, g->k - 1);
    }
    if (y)
        sum_add_scaled(g, sum, minus, composed(g, scale, code_at(g, s->x, 0)), s->y, g->k);
    if (x)
        sum_add_scaled(g, sum, minus, composed(g, scale, code_at(g, s->y, 0)), s->x, g->k);
}

/* +- a sum or a product times a factor (NULL: none). What is folded stands at most a few
 * deep (taylor-code-fold.c). */
static inline void
add_terms(qdot_generator *g, sum *sum, bool minus, const qdot_operand *scale,
          const qdot_taylor_step *s)
{
    qdot_operand factor;

    switch (s->op) {
    case QDOT_T_NEG: add_scaled(g, sum, !minus, scale, s->x); return;
    case QDOT_T_ADD:
    case QDOT_T_SUB:
        add_scaled(g, sum, minus, scale, s->x);
        add_scaled(g, sum, minus != (s->op == QDOT_T_SUB), scale, s->y);
        return;
    case QDOT_T_SCALE:
    case QDOT_T_SCALEADD:
    case QDOT_T_SCALESUB:
    case QDOT_T_SCALEOFF:
        if (s->op != QDOT_T_SCALE)
            add_scaled(g, sum, minus != (s->op == QDOT_T_SCALESUB), scale, s->z);
        factor = composed(g, scale, code_at(g, s->x, 0));
        add_scaled(g, sum, minus != (s->op == QDOT_T_SCALEOFF), &factor, s->y);
        return;
    default:
        if (s->op != QDOT_T_MUL)
            add_scaled(g, sum, minus != (s->op == QDOT_T_MSUB), scale, s->z);
        add_product_terms(g, sum, minus != (s->op == QDOT_T_NMADD), scale, s);
    }
}

#endif
