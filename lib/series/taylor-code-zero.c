/* taylor-code-zero.c -- order 0 as code: sums, products, quotients and roots; a call for what is
 * none of these. */
#include <math.h>

#include "series/taylor-code-sum.h"

static int
zero(qdot_generator *g, const double *row)
{
    return code_coefficient_register(g, qdot_code_row(g, row), 0);
}

static void
is(qdot_generator *g, int reg, const double *to, int k)
{
    value_finish(g, (value){.reg = reg, .own = true}, to, k);
}

/* Write the code for a row's order 0: x op y. */
static void
write_operation(qdot_generator *g, qdot_asm_operation name, int x, qdot_operand y,
                const double *to)
{
    const int reg = code_fresh_register(g);

    do_one(g, name, reg, x, y);
    is(g, reg, to, 0);
}

static void
write_operation_on_rows(qdot_generator *g, const qdot_taylor_step *s, qdot_asm_operation name)
{
    const int x = zero(g, s->x);

    write_operation(g, name, x, qdot_asm_in(zero(g, s->y)), s->to);
}

/* Write the code for x y + z, x y - z or z - x y, as `name` says, formed in a copy of z, which is overwritten. */
static void
write_product_with_summand(qdot_generator *g, const qdot_taylor_step *s, qdot_asm_operation name)
{
    const int x = zero(g, s->x), y = zero(g, s->y), z = zero(g, s->z), reg = code_fresh_register(g);

    do_one(g, QDOT_ASM_LOAD, reg, 0, qdot_asm_in(z));
    do_one(g, name, reg, x, qdot_asm_in(y));
    is(g, reg, s->to, 0);
}

/* Write code that stores a/b as the step's factor c, by which later orders multiply instead of dividing. */
static void
store_inverse(qdot_generator *g, const qdot_taylor_step *s, qdot_operand a, int b)
{
    const int reg = code_fresh_register(g);

    do_one(g, QDOT_ASM_LOAD, reg, 0, a);
    do_one(g, QDOT_ASM_DIV, reg, reg, qdot_asm_in(b));
    do_one(g, QDOT_ASM_STORE, reg, 0, qdot_code_c(g, s));
}

static void
write_quotient(qdot_generator *g, const qdot_taylor_step *s)
{
    write_operation_on_rows(g, s, QDOT_ASM_DIV);
    store_inverse(g, s, qdot_code_work(QDOT_CODE_ORDERS + 1), zero(g, s->y));
}

static void
write_root(qdot_generator *g, const qdot_taylor_step *s)
{
    const int x = zero(g, s->x);

    write_operation(g, QDOT_ASM_ROOT, x, qdot_asm_in(x), s->to);
    store_inverse(g, s, qdot_code_work(QDOT_CODE_INVERSES + 2), zero(g, s->to));
}

static void
compute_sine_and_cosine(double x, double *sine, double *cosine)
{
    sincos(x, sine, cosine);
}

static void
write_call(qdot_generator *g, void (*function)(void))
{
    qdot_asm_call(&g->m, function);
    qdot_code_forget(g);
}

static void
write_sine_and_cosine(qdot_generator *g, const qdot_taylor_step *s)
{
    do_one(g, QDOT_ASM_LOAD, 0, 0, code_at(g, s->x, 0));
    qdot_asm_set(&g->m, QDOT_ASM_CONSTANTS, QDOT_ASM_ROWS, code_at(g, s->second, 0).offset);
    qdot_asm_set(&g->m, QDOT_ASM_ROWS, QDOT_ASM_ROWS, code_at(g, s->to, 0).offset);
    write_call(g, (void (*)(void))compute_sine_and_cosine);
}

static void
write_call_of_step(qdot_generator *g, const qdot_taylor_step *s)
{
    qdot_asm_set(&g->m, QDOT_ASM_ROWS, QDOT_ASM_CONSTANTS,
                 (int32_t)((size_t)(s - g->t->steps) * sizeof *s));
    write_call(g, (void (*)(void))qdot_taylor_value);
}

static void
write_step_order_zero(qdot_generator *g, const qdot_taylor_step *s)
{
    switch (s->zero) {
    case QDOT_OP_NEG:
        write_operation(g, QDOT_ASM_MUL, zero(g, s->x), qdot_code_work(QDOT_CODE_INVERSES), s->to);
        break;
    case QDOT_OP_ADD: write_operation_on_rows(g, s, QDOT_ASM_ADD); break;
    case QDOT_OP_SUB: write_operation_on_rows(g, s, QDOT_ASM_SUB); break;
    case QDOT_OP_MUL: write_operation_on_rows(g, s, QDOT_ASM_MUL); break;
    case QDOT_OP_DIV: write_quotient(g, s); break;
    case QDOT_OP_MADD: write_product_with_summand(g, s, QDOT_ASM_MADD); break;
    case QDOT_OP_MSUB: write_product_with_summand(g, s, QDOT_ASM_MSUB); break;
    case QDOT_OP_NMADD: write_product_with_summand(g, s, QDOT_ASM_NMADD); break;
    case QDOT_OP_SQRT: write_root(g, s); break;
    case QDOT_OP_SINCOS: write_sine_and_cosine(g, s); break;
    default: write_call_of_step(g, s);
    }
}

/* Write code for the coefficients that follow from order 0 of a row by integration (a link). */
static void
write_integral_of_order_zero(qdot_generator *g, const qdot_taylor_step *s)
{
    const int x = zero(g, s->x), y = s->second ? zero(g, s->to) : 0;
    int reg = code_fresh_register(g);

    do_one(g, QDOT_ASM_MUL, reg, x, qdot_code_work(QDOT_CODE_ONCE));
    is(g, reg, s->to, 1);
    if (!s->second)
        return;
    reg = code_fresh_register(g);
    do_one(g, QDOT_ASM_MUL, reg, y, qdot_code_work(QDOT_CODE_ONCE));
    is(g, reg, s->second, 1);
    reg = code_fresh_register(g);
    do_one(g, QDOT_ASM_MUL, reg, x, qdot_code_work(QDOT_CODE_TWICE));
    is(g, reg, s->second, 2);
}

void
qdot_code_zero(qdot_generator *g)
{
    const qdot_taylor *t = g->t;

    qdot_code_forget(g);
    qdot_asm_frame(&g->m);
    for (size_t i = 0; i < t->length; i++)
        write_step_order_zero(g, t->steps + i);
    for (size_t i = 0; i < t->n_links && t->n_blocks == 0; i++)
        write_integral_of_order_zero(g, t->steps + t->length + i);
    qdot_asm_unframe(&g->m);
    qdot_asm_return(&g->m);
}
