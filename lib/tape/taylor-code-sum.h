/* taylor-code-sum.h -- sums of known coefficients as code: what a recurrence is written with.
 * Internal to tape/: for the files that write recurrences (taylor-code.h).
 *
 * Of a product sum_{j=0..k} x_j y_{k-j} the terms without orders 0, 1, k - 1 and k are in
 * a vector by now (taylor-code.c). The others are added one by one, in the order in which
 * they come to be known: from the newest to the result it is one operation.
 */
#ifndef QDOT_TAPE_TAYLOR_CODE_SUM_H
#define QDOT_TAPE_TAYLOR_CODE_SUM_H

#include "tape/taylor-generator.h"

enum {
    QDOT_CODE_TERMS = 8,
    behind_scalars = QDOT_CODE_FIRST_SCALAR + QDOT_CODE_SCALARS,
    latency = 4,
    latency_of_division = 14
};

/* --- registers ---------------------------------------------------------------------- */

static inline int
touch(qdot_generator *g, int reg)
{
    const int first = g->behind[g->latest];

    if (reg == g->latest || reg < QDOT_CODE_FIRST_SCALAR || reg >= behind_scalars)
        return reg;
    if (reg != first) { /* the ring is opened for it */
        g->behind[g->ahead[reg]] = g->behind[reg];
        g->ahead[g->behind[reg]] = g->ahead[reg];
        g->behind[reg] = first;
        g->ahead[reg] = g->latest;
        g->ahead[first] = g->behind[g->latest] = reg;
    }
    g->latest = reg;
    return reg;
}

static inline int
fresh(qdot_generator *g)
{
    const int reg = g->behind[g->latest];

    g->held[reg] = QDOT_CODE_NONE;
    return touch(g, reg);
}

static inline void
hold(qdot_generator *g, int reg, uint32_t row, int k)
{
    g->held[reg] = row;
    g->held_order[reg] = k;
    g->where[4 * row + (uint32_t)(k & 3)] = (unsigned char)reg;
}

/* The register with coefficient k of a row that moves. */
static inline int
coefficient(qdot_generator *g, uint32_t row, int k)
{
    unsigned char *where = &g->where[4 * row + (uint32_t)(k & 3)];
    int reg = *where;

    if (g->held[reg] == row && g->held_order[reg] == k)
        return touch(g, reg);
    reg = fresh(g);
    qdot_x86_emit(&g->x, QDOT_X86_LOAD, reg, 0, qdot_code_coefficient(g, row, k));
    hold(g, reg, row, k);
    return reg;
}

static inline int *
ready(qdot_generator *g, uint32_t row, int k)
{
    return &g->ready[4 * row + (uint32_t)(k & 3)];
}

/* --- sums --------------------------------------------------------------------------- */

/* A number in a register, or less it. */
typedef struct {
    int reg; /* -1: 0 */
    bool own, negative;
    int ready;
} value;

/* +- factor times coefficient k of a row; without a factor: as it is. */
typedef struct {
    bool minus, plain;
    qdot_x86_rm factor;
    uint32_t row;
    int k;
} term;

typedef struct {
    value v; /* what there is of it */
    int n;
    term terms[QDOT_CODE_TERMS];
} sum;

static inline qdot_x86_rm
at(const qdot_generator *g, const double *row, int k)
{
    return qdot_code_coefficient(g, qdot_code_row(g, row), k);
}

static inline void
add(qdot_generator *g, sum *s, bool minus, const double *x)
{
    const uint32_t row = qdot_code_row(g, x);

    if (g->moving[row])
        s->terms[s->n++] = (term){.minus = minus, .plain = true, .row = row, .k = g->k};
}

static inline void
times(qdot_generator *g, sum *s, bool minus, qdot_x86_rm factor, const double *x, int k)
{
    const uint32_t row = qdot_code_row(g, x);

    if (g->moving[row] && k > 0)
        s->terms[s->n++] = (term){minus, false, factor, row, k};
}

static inline void
add_value(qdot_generator *g, value *v, bool minus, int b)
{
    const int a = v->reg;

    touch(g, a);
    v->reg = fresh(g);
    if (v->negative && !minus)
        qdot_x86_emit(&g->x, QDOT_X86_SUB, v->reg, b, qdot_x86_reg(a));
    else if (v->negative != minus)
        qdot_x86_emit(&g->x, QDOT_X86_SUB, v->reg, a, qdot_x86_reg(b));
    else
        qdot_x86_emit(&g->x, QDOT_X86_ADD, v->reg, a, qdot_x86_reg(b));
    v->negative = v->negative && minus;
    v->own = true;
}

static inline void
add_product(qdot_generator *g, value *v, bool minus, qdot_x86_rm factor, int b)
{
    static const qdot_x86_name in_place[2][2] = {{QDOT_X86_MADD, QDOT_X86_NMADD},
                                                 {QDOT_X86_MSUB, QDOT_X86_NMSUB}};
    static const qdot_x86_name over[2][2] = {{QDOT_X86_MADD_OVER, QDOT_X86_NMADD_OVER},
                                             {QDOT_X86_MSUB_OVER, QDOT_X86_NMSUB_OVER}};
    const int a = v->reg;

    if (a < 0) {
        v->reg = fresh(g);
        qdot_x86_emit(&g->x, QDOT_X86_MUL, v->reg, b, factor);
        v->negative = minus;
    } else if (v->own) {
        qdot_x86_emit(&g->x, in_place[v->negative][minus], touch(g, a), b, factor);
        v->negative = false;
    } else {
        touch(g, a);
        v->reg = fresh(g);
        qdot_x86_emit(&g->x, factor.memory ? QDOT_X86_LOAD : QDOT_X86_LOAD_ALL, v->reg, 0,
                      factor);
        qdot_x86_emit(&g->x, over[v->negative][minus], v->reg, b, qdot_x86_reg(a));
        v->negative = false;
    }
    v->own = true;
}

/* What is known last is added last. */
static inline void
sort(qdot_generator *g, sum *s)
{
    for (int i = 1; i < s->n; i++) {
        const term now = s->terms[i];
        const int when = *ready(g, now.row, now.k);
        int j = i;

        for (; j > 0 && *ready(g, s->terms[j - 1].row, s->terms[j - 1].k) > when; j--)
            s->terms[j] = s->terms[j - 1];
        s->terms[j] = now;
    }
}

static inline value
total(qdot_generator *g, sum *s)
{
    value v = s->v;

    sort(g, s);
    for (int i = 0; i < s->n; i++) {
        const term *t = s->terms + i;
        const int when = *ready(g, t->row, t->k), b = coefficient(g, t->row, t->k);

        if (t->plain && v.reg < 0) {
            v = (value){.reg = b, .negative = t->minus, .ready = when};
            continue;
        }
        if (t->plain)
            add_value(g, &v, t->minus, b);
        else
            add_product(g, &v, t->minus, t->factor, b);
        v.ready = (v.ready > when ? v.ready : when) + latency;
    }
    return v;
}

/* MUL or DIV, by `factor`. */
static inline void
scale_by(qdot_generator *g, qdot_x86_name name, value *v, qdot_x86_rm factor)
{
    const int a = v->reg;

    if (a < 0)
        return;
    touch(g, a);
    v->reg = fresh(g);
    qdot_x86_emit(&g->x, name, v->reg, a, factor);
    v->own = true;
    v->ready += name == QDOT_X86_DIV ? latency_of_division : latency;
}

static inline void
scale(qdot_generator *g, value *v, qdot_x86_rm factor)
{
    scale_by(g, QDOT_X86_MUL, v, factor);
}

/* The sum so far, times a factor. */
static inline void
scale_sum(qdot_generator *g, sum *s, qdot_x86_rm factor)
{
    s->v = total(g, s);
    s->n = 0;
    scale(g, &s->v, factor);
}

/* Coefficient k of a row. */
static inline void
finish(qdot_generator *g, value v, const double *to, int k)
{
    const uint32_t row = qdot_code_row(g, to);

    if (v.reg < 0) {
        v.reg = fresh(g);
        v.own = true;
        qdot_x86_emit(&g->x, QDOT_X86_LOAD, v.reg, 0, qdot_code_work(QDOT_CODE_ORDERS));
    }
    if (v.negative)
        scale(g, &v, qdot_code_work(QDOT_CODE_INVERSES));
    qdot_x86_emit(&g->x, QDOT_X86_STORE, v.reg, 0, qdot_code_coefficient(g, row, k));
    *ready(g, row, k) = v.ready;
    if (v.own)
        hold(g, v.reg, row, k);
}

static inline void
finish_sum(qdot_generator *g, sum *s, const double *to)
{
    finish(g, total(g, s), to, g->k);
}

/* --- products of lower orders ------------------------------------------------------- */

/* Sum number n, of the terms with orders from 2 on. */
static inline sum
past_of(qdot_generator *g, uint32_t n)
{
    const qdot_code_vector *v;
    sum sum = {.v = {.reg = -1}};

    if (n == QDOT_CODE_NONE || g->k < 2 * g->lag)
        return sum;
    v = &g->sums.at[n].v;
    sum.v.reg = v->reg[0];
    if (v->reg[0] < 0) {
        sum.v.reg = fresh(g);
        sum.v.own = true;
        qdot_x86_emit(&g->x, QDOT_X86_LOAD, sum.v.reg, 0, qdot_code_work(v->at));
    }
    return sum;
}

/* Product i of a step but for the terms with orders 0, 1, k - 1 and k. */
static inline sum
past(qdot_generator *g, const qdot_taylor_step *s, int i)
{
    return past_of(g, g->step_sums[3 * (size_t)(s - g->t->steps) + (size_t)i]);
}

static inline void
negate(sum *s)
{
    s->v.negative = !s->v.negative;
}

/* Of one with orders 1 and k - 1, where the vectors do not have it: x_1 and y. */
static inline void
late(qdot_generator *g, sum *s, bool minus, qdot_x86_rm x1, const double *y)
{
    if (g->lag > 1)
        times(g, s, minus, x1, y, g->k - 1);
}

/* Both, x_1 and y_1 given where they are found, perhaps with a factor. */
static inline void
lately(qdot_generator *g, sum *s, bool minus, qdot_x86_rm x1, const double *y,
       qdot_x86_rm y1, const double *x)
{
    if (!g->moving[qdot_code_row(g, x)] || !g->moving[qdot_code_row(g, y)])
        return;
    late(g, s, minus, x1, y);
    if (g->k > 2)
        late(g, s, minus, y1, x);
}

#endif
