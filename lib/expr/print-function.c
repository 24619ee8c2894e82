/* print-function.c -- prints elementary and undefined functions, and their derivatives. */
#include <string.h>

#include "expr/elementary.h"
#include "expr/elliptic.h"
#include "expr/exact.h"
#include "expr/print-parts.h"

/* Print if(C, A, if(D, B, E)) as A if C, B if D, E otherwise. */
static void
print_cases(printer *p, qdot_expr e, int context)
{
    const qdot_pool *pool = p->pool;
    const qdot_formula_id outer = print_begin_bracket(p, context >= BASE);

    print_begin(p, QDOT_FORMULA_CASES, 0, 0);
    for (; NODE(pool, e)->kind == QDOT_FUN && NODE(pool, e)->op == QDOT_IF; e = ARGS(pool, e)[2]) {
        child(p, ARGS(pool, e)[1], TOP);
        child(p, ARGS(pool, e)[0], TOP);
    }
    child(p, e, TOP);
    p->at = outer;
}

void
qdot_print_function(printer *p, qdot_expr e, int context)
{
    qdot_fun_id id = NODE(p->pool, e)->op;
    const char *name = qdot_fun_name(id);
    const qdot_formula_id outer = p->at;
    const qdot_expr am = NODE(p->pool, e)->n == 0 ? QDOT_NIL : ARGS(p->pool, e)[0];

    if ((id == QDOT_SIN || id == QDOT_COS) && qdot_expr_is_function(p->pool, am, QDOT_JACOBI_AM)) {
        id = id == QDOT_SIN ? QDOT_JACOBI_SN : QDOT_JACOBI_CN;
        name = qdot_fun_name(id);
        e = am;
    }

    if (is_drawn(p) && id == QDOT_IF) {
        print_cases(p, e, context);
        return;
    }
    if (is_drawn(p) && (id == QDOT_ABS || id == QDOT_FLOOR)) {
        print_begin(p, QDOT_FORMULA_BRACKET, id == QDOT_ABS ? QDOT_BRACKET_BARS : QDOT_BRACKET_FLOOR, 0);
        child(p, ARGS(p->pool, e)[0], TOP);
        p->at = outer;
        return;
    }
    print_begin(p, QDOT_FORMULA_APPLY, 0, 0);
    if (is_drawn(p) && qdot_is_elliptic(id)) /* by what books write: K, E, F, Pi, sn, am */
        qdot_print_spelled(p, strchr(name, '_') + 1);
    else
        qdot_formula_add_text(p->out, p->at, QDOT_TEXT_FUNCTION, name, strlen(name));
    print_begin_bracket(p, true);
    children(p, e, 0, NODE(p->pool, e)->n);
    p->at = outer;
}

/* --- printing undefined functions --------------------------------------------------------------- */

/* Print the arguments (s, t) to which a function is applied, or the arguments with which it was declared. */
static void
print_arguments(printer *p, qdot_expr e, bool declared)
{
    const qdot_ufun *f = &p->pool->ufuns.at[NODE(p->pool, e)->op];
    const qdot_formula_id outer =
        print_begin(p, QDOT_FORMULA_BRACKET, QDOT_BRACKET_ROUND, QDOT_FORMULA_FIXED);

    children(p, declared ? f->formals : e, 0, f->arity);
    p->at = outer;
}

static uint32_t
order_of_derivative(const qdot_pool *pool, qdot_expr e, uint32_t i)
{
    int64_t order = 0;

    qdot_expr_to_int(pool, ARGS(pool, e)[NODE(pool, e)->n / 2 + i], &order);
    return (uint32_t)order;
}

/* Print a derivative as subs(diff(x(s, t), s, 2), s = a), the shortest text that can be read back. */
static void
print_derivative_as_input(printer *p, qdot_expr e, bool moved)
{
    const qdot_pool *pool = p->pool;
    const qdot_ufun *f = &pool->ufuns.at[NODE(pool, e)->op];
    uint32_t n = f->arity;

    if (moved)
        qdot_print_text(p, "subs(");
    for (uint32_t i = 0; i < n; i++)
        if (order_of_derivative(pool, e, i) > 0)
            qdot_print_text(p, "diff(");
    qdot_print_spelled(p, f->name);
    print_arguments(p, e, true);
    for (uint32_t i = 0; i < n; i++) {
        if (order_of_derivative(pool, e, i) == 0)
            continue;
        qdot_print_text(p, ", ");
        child(p, ARGS(pool, f->formals)[i], TOP);
        if (order_of_derivative(pool, e, i) > 1) {
            qdot_print_text(p, ", ");
            child(p, ARGS(pool, e)[n + i], TOP);
        }
        qdot_print_text(p, ")");
    }
    if (!moved)
        return;
    for (uint32_t i = 0; i < n; i++) {
        if (ARGS(pool, e)[i] == ARGS(pool, f->formals)[i])
            continue;
        qdot_print_text(p, ", ");
        child(p, ARGS(pool, f->formals)[i], TOP);
        qdot_print_text(p, " = ");
        child(p, ARGS(pool, e)[i], TOP);
    }
    qdot_print_text(p, ")");
}

/* Print the order of a derivative as a superscript of `sign`, or of e: ∂², s². */
static void
print_with_order(printer *p, qdot_formula_sign sign, qdot_expr e, uint32_t order)
{
    const qdot_formula_id outer = p->at;

    if (order > 1)
        print_begin(p, QDOT_FORMULA_POWER, 0, 0);
    if (e != QDOT_NIL)
        child(p, e, TOP);
    else
        print_sign(p, sign);
    if (order > 1)
        qdot_print_integer(p, order);
    p->at = outer;
}

/* Print a partial derivative ∂²x/∂s ∂t, as a fraction if possible; arguments other than the declared ones follow. */
static void
print_partial_derivative(printer *p, qdot_expr e, uint32_t total, bool moved, int context)
{
    const qdot_pool *pool = p->pool;
    const qdot_ufun *f = &pool->ufuns.at[NODE(pool, e)->op];
    const qdot_formula_id outer = p->at;
    qdot_formula_id apply, bar;
    bool first = true;

    if (moved)
        print_begin(p, QDOT_FORMULA_APPLY, 0, 0);
    print_begin_bracket(p, !moved && context >= BASE);
    apply = print_begin(p, QDOT_FORMULA_FRACTION, 0, 0);
    bar = print_begin_row(p);
    print_with_order(p, QDOT_SIGN_PARTIAL, QDOT_NIL, total);
    print_sign(p, QDOT_SIGN_BLANK);
    qdot_print_spelled(p, f->name);
    p->at = bar;
    print_begin_row(p);
    for (uint32_t i = 0; i < f->arity; i++) {
        if (order_of_derivative(pool, e, i) == 0)
            continue;
        if (!first)
            print_sign(p, QDOT_SIGN_BLANK);
        print_sign(p, QDOT_SIGN_PARTIAL);
        print_sign(p, QDOT_SIGN_BLANK);
        print_with_order(p, QDOT_SIGN_PARTIAL, ARGS(pool, f->formals)[i], order_of_derivative(pool, e, i));
        first = false;
    }
    p->at = apply;
    if (moved)
        print_arguments(p, e, false);
    p->at = outer;
}

void
qdot_print_ufun(printer *p, qdot_expr e, int context)
{
    const qdot_pool *pool = p->pool;
    const qdot_ufun *f = &pool->ufuns.at[NODE(pool, e)->op];
    const qdot_formula_id outer = p->at;
    qdot_formula_id apply;
    uint32_t total = 0;
    bool moved = false;

    for (uint32_t i = 0; i < f->arity; i++) {
        total += order_of_derivative(pool, e, i);
        moved |= ARGS(pool, e)[i] != ARGS(pool, f->formals)[i];
    }
    if (total > 0 && f->arity > 1 && is_drawn(p)) {
        print_partial_derivative(p, e, total, moved, context);
        return;
    }
    if (total > 0 && !is_drawn(p) &&
        (f->arity > 1 || (p->notation == QDOT_NOTATION_SCRIPT && (!moved || total > 3)))) {
        print_derivative_as_input(p, e, moved);
        return;
    }
    print_begin(p, QDOT_FORMULA_APPLY, 0, 0);
    apply = p->at;
    if (total > 0) {
        print_begin(p, QDOT_FORMULA_PRIMES, 0, 0);
        qdot_formula_count(p->out, p->at, total);
    }
    qdot_print_spelled(p, f->name);
    p->at = apply;
    print_arguments(p, e, false);
    p->at = outer;
}
