/* state-values.c -- expressions at a state of a scene, in symbols or in numbers. */
#include "mech/linear/state-values.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/refute/ball.h"

enum {
    BITS = 192,      /* precision of the balls */
    MOST_WORK = 12000 /* operations in expressions simplified for one linear motion */
};

void
qdot_state_values_begin(qdot_state_values *v, qdot_scene *s, bool numbers, qdot_binder bind, void *user)
{
    *v = (qdot_state_values){.s = s, .facts = qdot_scene_facts(s), .bind = bind, .user = user};
    v->x = (qdot_elimination){.pool = s->pool, .numbers = numbers, .facts = &v->facts, .most = MOST_WORK};
}

void
qdot_state_values_end(qdot_state_values *v)
{
    qdot_free(v->symbols.at);
    qdot_free(v->values.at);
}

qdot_status
qdot_state_values_put(qdot_state_values *v, qdot_expr symbol, qdot_expr value)
{
    for (size_t i = 0; i < v->symbols.n; i++)
        if (v->symbols.at[i] == symbol)
            return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&v->symbols, symbol));
    return qdot_vec_push(&v->values, value);
}

/* --- in numbers ------------------------------------------------------------------------- */

/* Fail because a symbol in e has no value. */
static qdot_status
report_symbol_without_value(qdot_pool *pool, qdot_expr e)
{
    const qdot_expr atoms = qdot_expr_atoms(pool, e, true);

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        const qdot_expr x = qdot_expr_arg(pool, atoms, i);
        const qdot_symbol *symbol = qdot_expr_symbol(pool, x);
        const char *name = symbol != NULL ? symbol->name : qdot_ufun_get(pool, qdot_expr_node(pool, x)->op)->name;

        if (symbol != NULL && symbol->class == QDOT_CONST)
            continue;
        (void)qdot_fail(QDOT_EUNSET, "the linear motion is found in numbers only, which need a value of `%.100s`", name);
        return symbol != NULL && (symbol->class == QDOT_COORD || symbol->class == QDOT_TIME)
                   ? qdot_hint("at [%.100s = ..., ...]", name)
                   : qdot_hint("set %.100s%s = ...", name, symbol != NULL ? "" : "(...)");
    }
    return qdot_fail(QDOT_EDOMAIN, "the equations of motion have no linear part there");
}

/* The middle of a ball as a rational; 0 where it cannot be told from 0. */
static qdot_expr
middle_of_ball(qdot_pool *pool, arb_srcptr ball)
{
    qdot_expr value;
    fmpq_t x;

    if (arb_contains_zero(ball))
        return QDOT_ZERO;
    fmpq_init(x);
    arf_get_fmpq(x, arb_midref(ball));
    value = qdot_expr_fmpq(pool, x);
    fmpq_clear(x);
    return value;
}

static qdot_status
evaluate_constants(qdot_pool *pool, size_t n, qdot_expr *e)
{
    qdot_ball ball;
    qdot_status status = QDOT_OK;
    size_t unknown = n;

    QDOT_TRY(qdot_ball_begin(&ball, pool, n, e));
    qdot_ball_eval(&ball, BITS, NULL, NULL);
    for (size_t i = 0; i < n && unknown == n; i++) {
        arb_srcptr value = qdot_ball_get(&ball, e[i]);

        if (qdot_expr_kind(pool, e[i]) == QDOT_NUM)
            continue;
        if (value == NULL || !arb_is_finite(value))
            unknown = i;
        else
            e[i] = middle_of_ball(pool, value);
    }
    qdot_ball_end(&ball);
    if (unknown < n)
        status = report_symbol_without_value(pool, e[unknown]);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* --- values --------------------------------------------------------------------------------- */

/* The value of e, in symbols or bound. */
static qdot_expr
value_at_state(qdot_state_values *v, qdot_expr e)
{
    e = qdot_subs(v->s->pool, e, v->symbols.n, v->symbols.at, v->values.at);
    return v->x.numbers && e != QDOT_NIL ? v->bind(v->user, e) : e;
}

/* Parts of an expression that switch where a surface u = 0 passes through the state, and what each is where u < 0 and where
 * u > 0. */
typedef struct {
    qdot_expr node, side[2];
    size_t surface; /* index of the surface */
} switching_part;

enum { MOST_SURFACES = 5 };

typedef struct {
    qdot_vec(switching_part) parts;
    qdot_expr surface[MOST_SURFACES];
    size_t surfaces;
} switching;

/* What switches where: sign(u) and a relation u < v at the end, floor(u) at an integer, mod(u, m) at a multiple of m. nil: the
 * node never does. */
static qdot_expr
switching_surface(qdot_state_values *v, qdot_expr node, qdot_expr side[2])
{
    qdot_pool *pool = v->s->pool;
    const uint16_t op = qdot_expr_node(pool, node)->op;
    qdot_expr value;

    if (qdot_expr_kind(pool, node) == QDOT_REL) {
        side[0] = QDOT_TRUE;
        side[1] = QDOT_FALSE;
        return qdot_sub(pool, qdot_expr_arg(pool, node, 0), qdot_expr_arg(pool, node, 1));
    }
    if (qdot_expr_kind(pool, node) != QDOT_FUN || (op != QDOT_SIGN && op != QDOT_FLOOR && op != QDOT_MOD))
        return QDOT_NIL;
    side[0] = QDOT_MINUS_ONE;
    side[1] = QDOT_ONE;
    if (op == QDOT_SIGN)
        return qdot_expr_arg(pool, node, 0);
    value = value_at_state(v, node);
    side[1] = value;
    side[0] = op == QDOT_FLOOR ? qdot_sub(pool, value, QDOT_ONE) : qdot_expr_arg(pool, node, 1);
    return op == QDOT_FLOOR ? qdot_sub(pool, qdot_expr_arg(pool, node, 0), value) : node;
}

/* Add a node if it switches at the state; a surface that is the negative of one before is that one. */
static qdot_status
add_switching_part(qdot_state_values *v, qdot_expr node, switching *x)
{
    switching_part part = {.node = node};
    const qdot_expr u = switching_surface(v, node, part.side), minus = u == QDOT_NIL ? QDOT_NIL : qdot_neg(v->s->pool, u);
    size_t k = 0;

    if (u == QDOT_NIL || !qdot_is_zero(v->s->pool, value_at_state(v, u), &v->facts))
        return qdot_pool_check(v->s->pool);
    while (k < x->surfaces && x->surface[k] != u && x->surface[k] != minus)
        k++;
    if (k == MOST_SURFACES)
        return QDOT_OK;
    if (k < x->surfaces && x->surface[k] == minus)
        part = (switching_part){node, {part.side[1], part.side[0]}, 0};
    if (k == x->surfaces)
        x->surface[x->surfaces++] = u;
    part.surface = k;
    return qdot_vec_push(&x->parts, part);
}

/* The value of e on the sides of the surfaces that are the bits of `which`. */
static qdot_expr
value_on_sides(qdot_state_values *v, qdot_expr e, const switching *x, unsigned which, qdot_expr *from, qdot_expr *to)
{
    for (size_t i = 0; i < x->parts.n; i++) {
        from[i] = x->parts.at[i].node;
        to[i] = x->parts.at[i].side[which >> x->parts.at[i].surface & 1];
    }
    return value_at_state(v, qdot_subs(v->s->pool, e, x->parts.n, from, to));
}

static qdot_status
report_jump(const qdot_state_values *v, qdot_expr surface)
{
    const qdot_pool *pool = v->s->pool;
    const qdot_expr minus = qdot_neg(v->s->pool, surface);
    const bool shorter = minus != QDOT_NIL && qdot_expr_node(pool, minus)->size < qdot_expr_node(pool, surface)->size;
    qdot_text text = {0};
    qdot_status status = qdot_print(pool, shorter ? minus : surface, QDOT_PLAIN, &text);

    if (status == QDOT_OK) {
        status = qdot_fail(QDOT_EDOMAIN, "nothing is linear there: a jump or a kink where %.200s = 0", qdot_text_str(&text));
        (void)qdot_hint("each side has its own linear motion: at a state beside it");
    }
    qdot_text_clear(&text);
    return status;
}

/* Replace e by its value beside the state, which must be the same on all sides of the surfaces there: else it jumps, or that
 * of which it is a slope has a kink. At the state alone a slope may have no meaning, as sign(0). */
static qdot_status
evaluate_beside_surfaces(qdot_state_values *v, qdot_expr *e)
{
    qdot_pool *pool = v->s->pool;
    switching x = {0};
    qdot_expr *from = NULL, first;
    qdot_status status;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, *e, &w));
    status = QDOT_OK;
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++)
        status = add_switching_part(v, w.at[i], &x);
    qdot_walk_end(&w);
    if (status == QDOT_OK && x.parts.n > 0) {
        from = qdot_calloc(2 * x.parts.n, sizeof *from);
        status = from == NULL ? QDOT_ENOMEM : QDOT_OK;
    }
    first = from == NULL ? value_at_state(v, *e) : value_on_sides(v, *e, &x, 0, from, from + x.parts.n);
    for (unsigned which = 1; which < 1u << x.surfaces && status == QDOT_OK && from != NULL; which++) {
        const qdot_expr other = value_on_sides(v, *e, &x, which, from, from + x.parts.n);

        status = qdot_pool_check(pool);
        if (status == QDOT_OK && !qdot_is_zero(pool, qdot_sub(pool, first, other), &v->facts))
            status = report_jump(v, x.surface[__builtin_ctz(which)]);
    }
    *e = first;
    qdot_free(from);
    qdot_free(x.parts.at);
    return status;
}

qdot_status
qdot_state_values_of(qdot_state_values *v, size_t n, qdot_expr *e)
{
    qdot_pool *pool = v->s->pool;

    QDOT_TRY(qdot_pool_check(pool));
    for (size_t i = 0; i < n; i++) {
        QDOT_TRY(evaluate_beside_surfaces(v, &e[i]));
        if (!v->x.numbers)
            e[i] = qdot_elimination_short(&v->x, e[i]);
    }
    QDOT_TRY(qdot_pool_check(pool));
    return v->x.numbers && n > 0 ? evaluate_constants(pool, n, e) : QDOT_OK;
}
