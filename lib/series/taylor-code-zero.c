/* taylor-code-zero.c -- order 0 as code: sums, products, quotients and roots; a call for what is
 * none of these. */
#include <math.h>

#include "series/taylor-code-sum.h"

static int
zero(qdot_generator *g, const double *row)
{
    return coefficient(g, qdot_code_row(g, row), 0);
}

static void
is(qdot_generator *g, int reg, const double *to, int k)
{
    finish(g, (value){.reg = reg, .own = true}, to, k);
}

/* to <- x op y */
static void
simple(qdot_generator *g, qdot_x86_name name, int x, qdot_x86_rm y, const double *to)
{
    const int reg = fresh(g);

    qdot_x86_emit(&g->x, name, reg, x, y);
    is(g, reg, to, 0);
}

static void
simple_of_rows(qdot_generator *g, const qdot_taylor_step *s, qdot_x86_name name)
{
    const int x = zero(g, s->x);

    simple(g, name, x, qdot_x86_reg(zero(g, s->y)), s->to);
}

/* to <- x y and z, by an instruction that writes over z */
static void
with_third(qdot_generator *g, const qdot_taylor_step *s, qdot_x86_name name)
{
    const int x = zero(g, s->x), y = zero(g, s->y), z = zero(g, s->z), reg = fresh(g);

    qdot_x86_emit(&g->x, QDOT_X86_LOAD, reg, z, qdot_x86_reg(z));
    qdot_x86_emit(&g->x, name, reg, x, qdot_x86_reg(y));
    is(g, reg, s->to, 0);
}

/* What orders divide by: c <- a/b */
static void
keep_inverse(qdot_generator *g, const qdot_taylor_step *s, qdot_x86_rm a, int b)
{
    const int reg = fresh(g);

    qdot_x86_emit(&g->x, QDOT_X86_LOAD, reg, 0, a);
    qdot_x86_emit(&g->x, QDOT_X86_DIV, reg, reg, qdot_x86_reg(b));
    qdot_x86_emit(&g->x, QDOT_X86_STORE, reg, 0, qdot_code_c(g, s));
}

static void
quotient(qdot_generator *g, const qdot_taylor_step *s)
{
    simple_of_rows(g, s, QDOT_X86_DIV);
    keep_inverse(g, s, qdot_code_work(QDOT_CODE_ORDERS + 1), zero(g, s->y));
}

static void
root(qdot_generator *g, const qdot_taylor_step *s)
{
    const int x = zero(g, s->x);

    simple(g, QDOT_X86_ROOT, x, qdot_x86_reg(x), s->to);
    keep_inverse(g, s, qdot_code_work(QDOT_CODE_INVERSES + 2), zero(g, s->to));
}

static void
waves(double x, double *sine, double *cosine)
{
    sincos(x, sine, cosine);
}

static void
call(qdot_generator *g, void (*function)(void))
{
    qdot_x86_call(&g->x, function);
    for (int i = 0; i < QDOT_CODE_REGISTERS; i++)
        g->held[i] = QDOT_CODE_NONE;
}

static void
sine_and_cosine(qdot_generator *g, const qdot_taylor_step *s)
{
    qdot_x86_emit(&g->x, QDOT_X86_LOAD, 0, 0, at(g, s->x, 0));
    qdot_x86_address(&g->x, QDOT_X86_RSI, QDOT_X86_RDI, at(g, s->second, 0).offset);
    qdot_x86_address(&g->x, QDOT_X86_RDI, QDOT_X86_RDI, at(g, s->to, 0).offset);
    call(g, (void (*)(void))waves);
}

static void
any_other(qdot_generator *g, const qdot_taylor_step *s)
{
    qdot_x86_address(&g->x, QDOT_X86_RDI, QDOT_X86_RSI,
                     (int32_t)((size_t)(s - g->t->steps) * sizeof *s));
    call(g, (void (*)(void))qdot_taylor_value);
}

static void
value_of(qdot_generator *g, const qdot_taylor_step *s)
{
    switch (s->zero) {
    case QDOT_OP_NEG:
        simple(g, QDOT_X86_MUL, zero(g, s->x), qdot_code_work(QDOT_CODE_INVERSES), s->to);
        break;
    case QDOT_OP_ADD: simple_of_rows(g, s, QDOT_X86_ADD); break;
    case QDOT_OP_SUB: simple_of_rows(g, s, QDOT_X86_SUB); break;
    case QDOT_OP_MUL: simple_of_rows(g, s, QDOT_X86_MUL); break;
    case QDOT_OP_DIV: quotient(g, s); break;
    case QDOT_OP_MADD: with_third(g, s, QDOT_X86_MADD); break;
    case QDOT_OP_MSUB: with_third(g, s, QDOT_X86_MSUB); break;
    case QDOT_OP_NMADD: with_third(g, s, QDOT_X86_NMADD); break;
    case QDOT_OP_SQRT: root(g, s); break;
    case QDOT_OP_SINCOS: sine_and_cosine(g, s); break;
    default: any_other(g, s);
    }
}

/* What is linked to order 0. */
static void
link_zero(qdot_generator *g, const qdot_taylor_step *s)
{
    const int x = zero(g, s->x), y = s->second ? zero(g, s->to) : 0;
    int reg = fresh(g);

    qdot_x86_emit(&g->x, QDOT_X86_MUL, reg, x, qdot_code_work(QDOT_CODE_ONCE));
    is(g, reg, s->to, 1);
    if (!s->second)
        return;
    reg = fresh(g);
    qdot_x86_emit(&g->x, QDOT_X86_MUL, reg, y, qdot_code_work(QDOT_CODE_ONCE));
    is(g, reg, s->second, 1);
    reg = fresh(g);
    qdot_x86_emit(&g->x, QDOT_X86_MUL, reg, x, qdot_code_work(QDOT_CODE_TWICE));
    is(g, reg, s->second, 2);
}

void
qdot_code_zero(qdot_generator *g)
{
    const qdot_taylor *t = g->t;

    for (int i = 0; i < QDOT_CODE_REGISTERS; i++)
        g->held[i] = QDOT_CODE_NONE;
    qdot_x86_frame(&g->x);
    for (size_t i = 0; i < t->length; i++)
        value_of(g, t->steps + i);
    for (size_t i = 0; i < t->n_links && t->n_blocks == 0; i++)
        link_zero(g, t->steps + t->length + i);
    qdot_x86_unframe(&g->x);
    qdot_x86_return(&g->x);
}
