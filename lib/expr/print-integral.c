/* print-integral.c -- prints integrals: as integral(f, x, a, b), drawn with their sign, ends and dx. */
#include <stdio.h>
#include <string.h>

#include "expr/integral.h"
#include "expr/print-parts.h"
#include "expr/walk.h"

static const char *
name_of_binder(const printer *p, uint32_t binder)
{
    const struct binder *b = &p->binders.at[binder];

    return *b->own != '\0' ? b->own : qdot_integral_name(p->pool, b->integral);
}

/* Whether a name means something else within f, printed where p is: a symbol, a function or an outer variable. */
static bool
is_name_taken(const printer *p, qdot_expr f, const char *name)
{
    const qdot_pool *pool = p->pool;
    bool taken = false;
    qdot_walk w;

    for (uint32_t k = p->binder; k != 0 && !taken; k = p->binders.at[k].outer)
        taken = strcmp(name_of_binder(p, k), name) == 0;
    if (taken || qdot_walk_begin(pool, f, &w) != QDOT_OK)
        return taken;
    for (size_t i = 0; i < w.n && !taken; i++) {
        const qdot_symbol *s = qdot_expr_symbol(pool, w.at[i]);

        taken = s != NULL ? strcmp(s->name, name) == 0
                          : NODE(pool, w.at[i])->kind == QDOT_UFUN &&
                                strcmp(pool->ufuns.at[NODE(pool, w.at[i])->op].name, name) == 0;
    }
    qdot_walk_end(&w);
    return taken;
}

/* Begin what stands within the integral e, with a name for its variable that means nothing else there. */
static void
begin_integrand(printer *p, qdot_expr e)
{
    struct binder b = {.outer = p->binder, .integral = e};
    const qdot_expr f = ARGS(p->pool, e)[0];

    if (is_name_taken(p, f, qdot_integral_name(p->pool, e))) {
        static const char *const others[] = {"u", "v", "w", "s"};
        unsigned k = 0;

        for (; k < 4; k++) {
            snprintf(b.own, sizeof b.own, "%s", others[k]);
            if (!is_name_taken(p, f, b.own))
                break;
        }
        for (unsigned number = 1; k == 4 && number < 10000; number++) {
            snprintf(b.own, sizeof b.own, "u%u", number % 10000);
            k += !is_name_taken(p, f, b.own);
        }
    }
    if (qdot_vec_push(&p->binders, b) != QDOT_OK)
        p->status = QDOT_ENOMEM;
    else
        p->binder = (uint32_t)p->binders.n - 1;
}

static void
print_variable(printer *p, qdot_expr e)
{
    if (qdot_integral_is_definite(p->pool, e))
        qdot_print_spelled(p, name_of_binder(p, p->binder));
    else
        child(p, ARGS(p->pool, e)[1], TOP);
}

/* Print the sign of the integral, with its ends. */
static void
print_integral_sign(printer *p, qdot_expr e, bool definite)
{
    const qdot_formula_id outer = p->at;
    qdot_formula_id power;

    if (!definite) {
        print_sign(p, QDOT_SIGN_INTEGRAL);
        print_sign(p, QDOT_SIGN_BLANK);
        return;
    }
    print_begin(p, QDOT_FORMULA_POWER, 0, 0);
    power = print_begin(p, QDOT_FORMULA_INDEX, 0, 0);
    print_sign(p, QDOT_SIGN_INTEGRAL);
    child(p, ARGS(p->pool, e)[1], TOP);
    p->at = power;
    child(p, ARGS(p->pool, e)[2], TOP);
    p->at = outer;
}

void
qdot_print_integral(printer *p, qdot_expr e, int context)
{
    const bool definite = qdot_integral_is_definite(p->pool, e);
    const qdot_formula_id outer = p->at;
    const uint32_t binder = p->binder;

    if (is_drawn(p)) {
        print_begin_bracket(p, context >= FACTOR);
        print_integral_sign(p, e, definite);
        if (definite)
            begin_integrand(p, e);
        child(p, ARGS(p->pool, e)[0], NODE(p->pool, ARGS(p->pool, e)[0])->kind == QDOT_SUM ? FACTOR : TERM);
        print_sign(p, QDOT_SIGN_MEASURE);
        qdot_print_text(p, "d");
        print_variable(p, e);
        p->binder = binder;
        p->at = outer;
        return;
    }
    print_begin(p, QDOT_FORMULA_APPLY, 0, 0);
    qdot_formula_add_text(p->out, p->at, QDOT_TEXT_FUNCTION, "integral", 8);
    print_begin_bracket(p, true);
    if (definite)
        begin_integrand(p, e);
    child(p, ARGS(p->pool, e)[0], TOP);
    print_sign(p, QDOT_SIGN_COMMA);
    print_variable(p, e);
    p->binder = binder;
    for (int end = 1; definite && end <= 2; end++) {
        print_sign(p, QDOT_SIGN_COMMA);
        child(p, ARGS(p->pool, e)[end], TOP);
    }
    p->at = outer;
}

void
qdot_print_bound(printer *p, qdot_expr e)
{
    uint32_t number = qdot_bound_number(p->pool, e), k = p->binder;

    while (number > 1 && k != 0) {
        k = p->binders.at[k].outer;
        number--;
    }
    qdot_print_spelled(p, k != 0 ? name_of_binder(p, k) : qdot_expr_symbol(p->pool, e)->name);
}
