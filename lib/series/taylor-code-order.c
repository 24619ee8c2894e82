/* taylor-code-order.c -- writes machine code for one order of a step's recurrence. */
#include "series/recurrence-operations.h"
#include "series/taylor-code-sum.h"

static qdot_operand
inverse_of_order(const qdot_generator *g)
{
    return qdot_code_entry(QDOT_CODE_INVERSES, g->k);
}

/* x_i times c of a step, x_i twice: factors that no order changes. Those of order 1 are there from
 * order 2 on. */
static qdot_operand
coefficient_times_c(qdot_generator *g, const qdot_taylor_step *s, const double *x, int i)
{
    return qdot_code_composed(g, qdot_code_c(g, s), code_at(g, x, i));
}

static qdot_operand
twice_operand(qdot_generator *g, qdot_operand a)
{
    return qdot_code_composed(g, a, qdot_code_work(QDOT_CODE_ORDERS + 2));
}

/* Write the code for d_1/k, the coefficient of order 1 of the step's row d divided by the order k > 1. */
static qdot_operand
first_coefficient_over_order(qdot_generator *g, const qdot_taylor_step *s)
{
    const int reg = code_fresh_register(g);

    do_one(g, QDOT_ASM_LOAD, reg, 0, code_at(g, s->d, 1));
    do_one(g, QDOT_ASM_MUL, reg, reg, inverse_of_order(g));
    return qdot_asm_in(reg);
}

/* --- recurrences from the table ----------------------------------------------------- */

/* Add to the sum v the products of convolution number i of a step. */
static void
add_products(qdot_generator *g, const qdot_taylor_step *s, const qdot_recurrence_operation *o,
             int i, sum *v)
{
    const double *a = qdot_code_named(s, o->a), *b = qdot_code_named(s, o->b);

    add_past(g, v, false, NULL, s, i);
    if (o->verb == QDOT_DO_SQUARED) {
        if (g->lag > 1 && g->k > 1)
            late(g, v, false, g->k == 2 ? code_at(g, a, 1) : twice_operand(g, code_at(g, a, 1)), a);
        if (o->from == 0)
            sum_add_scaled(g, v, false, twice_operand(g, code_at(g, a, 0)), a, g->k);
        return;
    }
    lately(g, v, false, code_at(g, a, 1), b, code_at(g, b, 1), a);
    if (o->from == 0)
        sum_add_scaled(g, v, false, code_at(g, a, 0), b, g->k);
    if (o->below == 0)
        sum_add_scaled(g, v, false, code_at(g, b, 0), a, g->k);
}

static void
negate_sum(sum *v)
{
    v->v.negative = !v->v.negative;
    for (int i = 0; i < v->n; i++)
        v->terms[i].minus = !v->terms[i].minus;
}

/* Append the terms of another sum to the sum v. */
static void
append_terms(qdot_generator *g, sum *v, const sum *other)
{
    if (v->v.reg < 0)
        v->v = other->v;
    else if (other->v.reg >= 0)
        add_value(g, &v->v, other->v.negative, other->v.reg);
    for (int i = 0; i < other->n; i++)
        v->terms[v->n++] = other->terms[i];
}

/* The factor of a term of a sum, multiplied by c; if the factor is the order k, the product is computed at each order. */
static qdot_operand
factor_times_c(qdot_generator *g, const qdot_taylor_step *s, const term *t)
{
    const qdot_operand c = qdot_code_c(g, s), order = qdot_code_entry(QDOT_CODE_ORDERS, g->k);
    int reg;

    if (t->plain)
        return c;
    if (t->factor.reg != order.reg || t->factor.offset != order.offset)
        return qdot_code_composed(g, c, t->factor);
    reg = code_fresh_register(g);
    do_one(g, QDOT_ASM_LOAD, reg, 0, order);
    do_one(g, QDOT_ASM_MUL, reg, reg, c);
    do_one(g, QDOT_ASM_STORE, reg, 0, qdot_code_work(QDOT_CODE_MOMENT));
    return qdot_code_work(QDOT_CODE_MOMENT);
}

/* Multiply all terms of the sum v, which has no value in a register yet, by c. */
static void
multiply_sum_by_c(qdot_generator *g, const qdot_taylor_step *s, sum *v)
{
    for (int i = 0; i < v->n; i++) {
        v->terms[i].factor = factor_times_c(g, s, v->terms + i);
        v->terms[i].plain = false;
    }
}

/* The row x if d is the row of j x_j (x multiplied by the order j); otherwise NULL. */
static const double *
row_before_scaling_by_order(const qdot_taylor_step *s)
{
    const qdot_recurrence_operation *o = qdot_recurrence_find(s->op, QDOT_DO_ORDERS);

    return o && o->r == QDOT_OF_d ? qdot_code_named(s, o->p) : NULL;
}

/* v / k: of d_k = k x_k that is x_k, and the factor d_1 is divided, so that what is known last does
 * not wait for a division of the whole. */
static void
divide_sum_by_order(qdot_generator *g, const qdot_taylor_step *s, sum *v)
{
    const double *x = row_before_scaling_by_order(s);
    const uint32_t d = x ? qdot_code_row(g, s->d) : QDOT_CODE_NONE;
    sum early = {.v = v->v}, rest = {.v = {.reg = -1}};

    for (int i = 0; i < v->n; i++) {
        term t = v->terms[i];

        if (x && t.row == d && t.k == g->k)
            t.row = qdot_code_row(g, x);
        else if (x && !t.plain && t.factor.offset == code_at(g, s->d, 1).offset
                 && t.factor.reg == code_at(g, s->d, 1).reg)
            t.factor = first_coefficient_over_order(g, s);
        else {
            early.terms[early.n++] = t;
            continue;
        }
        rest.terms[rest.n++] = t;
    }
    if (early.n == 1 && early.v.reg < 0 && early.terms->plain) {
        early.terms->plain = false;
        early.terms->factor = inverse_of_order(g);
    } else {
        scale_sum(g, &early, inverse_of_order(g));
    }
    append_terms(g, &early, &rest);
    *v = early;
}

/* Whether U1 and U2 are divided in the end. They are times c from the beginning: so all factors
 * that no order changes are known at order 1. */
static bool
step_divides_at_end(const qdot_taylor_step *s)
{
    return qdot_recurrence_find(s->op, QDOT_DO_OVER) ||
           qdot_recurrence_find(s->op, QDOT_DO_OVER_TWICE);
}

/* Add to v coefficient k of a row, times a factor (NULL: none), or U1 or U2, which is then used up,
 * with a sign. */
static void
add_coefficient_to_sum(qdot_generator *g, const qdot_taylor_step *s, const qdot_operand *factor, sum *v,
                       bool minus, unsigned name, sum *u)
{
    sum *other;

    if (name < QDOT_OF_U1) {
        add_scaled(g, v, minus, factor, qdot_code_named(s, name));
        return;
    }
    other = u + (name - QDOT_OF_U1);
    if (minus)
        negate_sum(other);
    append_terms(g, v, other);
    *other = (sum){.v = {.reg = -1}};
}

/* Form the sum that one operation of a recurrence computes; `sums` counts the convolutions of the step. */
static sum
operation_result(qdot_generator *g, const qdot_taylor_step *s, const qdot_recurrence_operation *o,
                 int *sums, sum *u)
{
    const qdot_operand c = qdot_code_c(g, s);
    const qdot_operand *const factor = o->r >= QDOT_OF_U1 && step_divides_at_end(s) ? &c : NULL;
    sum v = {.v = {.reg = -1}};

    switch (o->verb) {
    case QDOT_DO_SUM:
    case QDOT_DO_SQUARED:
    case QDOT_DO_ORDERS:
        if (o->verb == QDOT_DO_ORDERS)
            sum_add_scaled(g, &v, false, qdot_code_entry(QDOT_CODE_ORDERS, g->k),
                           qdot_code_named(s, o->p), g->k);
        else
            add_products(g, s, o, (*sums)++, &v);
        if (factor)
            multiply_sum_by_c(g, s, &v);
        return v;
    default: add_coefficient_to_sum(g, s, factor, &v, false, o->p, u);
    }
    switch (o->verb) {
    case QDOT_DO_ADD: add_coefficient_to_sum(g, s, factor, &v, false, o->q, u); break;
    case QDOT_DO_SUB: add_coefficient_to_sum(g, s, factor, &v, true, o->q, u); break;
    case QDOT_DO_NEG: negate_sum(&v); break;
    case QDOT_DO_SIGNED:
        if (s->sign < 0)
            negate_sum(&v);
        break;
    case QDOT_DO_PER_ORDER: divide_sum_by_order(g, s, &v); break;
    case QDOT_DO_OVER:
    case QDOT_DO_OVER_TWICE: break; /* nothing to do: all factors were multiplied by c from the beginning */
    default: g->m.status = qdot_fail(QDOT_EINVAL, "a recurrence has no code");
    }
    return v;
}

/* Write the code of a step's recurrence, operation by operation, as recurrence.def lists them. */
static void
write_recurrence(qdot_generator *g, const qdot_taylor_step *s)
{
    sum u[] = {{.v = {.reg = -1}}, {.v = {.reg = -1}}};
    int sums = 0;

    for (const qdot_recurrence_operation *o = qdot_recurrence_operations(s->op);
         o->verb != QDOT_DO_END; o++) {
        sum v = operation_result(g, s, o, &sums, u);

        if (o->r < QDOT_OF_U1)
            finish_sum(g, &v, qdot_code_named(s, o->r));
        else
            u[o->r - QDOT_OF_U1] = v;
    }
}

/* --- recurrences with code of their own --------------------------------------------- */

/* Write the code of a step that is a plain sum or product. */
static void
write_plain_step(qdot_generator *g, const qdot_taylor_step *s)
{
    sum sum = {.v = {.reg = -1}};

    add_terms(g, &sum, false, NULL, s);
    finish_sum(g, &sum, s->to);
}

/* Write the code for k x_k, the coefficient of order k times the order. */
static void
write_order_times_coefficient(qdot_generator *g, const double *x, const double *to)
{
    sum d = {.v = {.reg = -1}};

    sum_add_scaled(g, &d, false, qdot_code_entry(QDOT_CODE_ORDERS, g->k), x, g->k);
    finish_sum(g, &d, to);
}

/* Write the code for coefficient k of a power: ((r + 1)/k sum d p - sum x p)/x_0. */
static void
write_power(qdot_generator *g, const qdot_taylor_step *s)
{
    const qdot_operand c = qdot_code_c(g, s), r = coefficient_times_c(g, s, s->z, 0);
    sum sum = past(g, s, 0), other = past(g, s, 1);
    int slopes;

    write_order_times_coefficient(g, s->x, s->d);
    lately(g, &sum, false, code_at(g, s->d, 1), s->to, code_at(g, s->to, 1), s->d);
    scale_sum(g, &sum, inverse_of_order(g));
    slopes = sum.v.reg;
    scale_sum(g, &sum, r);
    if (slopes >= 0)
        value_add_product(g, &sum.v, false, c, slopes);
    if (other.v.reg >= 0)
        value_add_product(g, &sum.v, true, c, other.v.reg);
    if (g->lag > 1 && g->k > 1)
        lately(g, &sum, true, coefficient_times_c(g, s, s->x, 1), s->to, coefficient_times_c(g, s, s->to, 1), s->x);
    sum_add_scaled(g, &sum, false, qdot_code_composed(g, r, code_at(g, s->to, 0)), s->x, g->k);
    finish_sum(g, &sum, s->to);
}

static void
write_integral(qdot_generator *g, const qdot_taylor_step *s)
{
    sum once = {.v = {.reg = -1}}, twice = once;

    if (g->exact) {
        sum_add_scaled(g, &once, false, qdot_code_entry(QDOT_CODE_ONCE_LOW, g->k), s->x, g->k);
        sum_add_scaled(g, &twice, false, qdot_code_entry(QDOT_CODE_TWICE_LOW, g->k), s->x, g->k);
    }
    sum_add_scaled(g, &once, false, qdot_code_entry(QDOT_CODE_ONCE, g->k), s->x, g->k);
    sum_add_scaled(g, &twice, false, qdot_code_entry(QDOT_CODE_TWICE, g->k), s->x, g->k);
    value_finish(g, total(g, &once), s->to, g->k + 1);
    if (s->second)
        value_finish(g, total(g, &twice), s->second, g->k + 2);
}

void
qdot_code_order(qdot_generator *g, const qdot_taylor_step *s)
{
    switch (s->op) {
    case QDOT_T_LINK: write_integral(g, s); break;
    case QDOT_T_POW: write_power(g, s); break;
    case QDOT_T_SQUARE: write_recurrence(g, s); break;
    default:
        if (s->op <= QDOT_T_NMADD)
            write_plain_step(g, s);
        else
            write_recurrence(g, s);
    }
}
