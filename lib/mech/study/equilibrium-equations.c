/* equilibrium-equations.c -- Lagrange's equations and the constraints at rest; and, where they hold
 * the time, what follows of a place at which they hold for all times.
 *
 * G(q, t) = 0 for all t makes every derivative by t vanish at one time: a few of them, at t = 0 (or
 * 1, where they have no value at 0), are equations without t. They are necessary; whether what
 * solves them solves G for all t is looked at afterwards. Multipliers may depend on t: of an
 * equation that holds some, its value at that time alone is taken. */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/study/equilibrium-search.h"
#include "mech/linear/linear-motion.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

enum { DERIVATIVES = 4 };

static qdot_expr
equation_residual(qdot_pool *pool, qdot_expr equation)
{
    if (equation == QDOT_NIL)
        return QDOT_NIL;
    return qdot_sub(pool, qdot_expr_arg(pool, equation, 1),
                    qdot_expr_arg(pool, equation, 0));
}

qdot_status
qdot_rest_equations(qdot_rest *r, qdot_expr *list)
{
    qdot_scene *s = r->s;
    size_t n = s->coordinates.n, m = n + s->constraints.n, count = 0;
    qdot_expr *e = qdot_calloc(m + 1, sizeof *e);
    qdot_expr nowhere = qdot_list(r->pool, 0, NULL);
    qdot_status status = QDOT_OK;

    if (e == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < m; i++)
        e[i] = i < n ? equation_residual(r->pool, qdot_mech_equation(s, s->coordinates.at[i]))
                     : s->constraints.at[i - n].f;
    status = qdot_pool_check(r->pool);
    if (status == QDOT_OK)
        status = qdot_rest_sides(r, n, e);
    for (size_t i = 0; i < m && status == QDOT_OK; i++) {
        e[i] = qdot_simplify(r->pool, qdot_rest_value(s, nowhere, e[i]), &r->facts);
        status = qdot_pool_check(r->pool);
        if (status == QDOT_EDOMAIN && i < n) { /* undefined at rest, usually because of a force along v/|v| */
            const char *q = qdot_expr_symbol(r->pool, s->coordinates.at[i])->name;

            (void)qdot_fail(QDOT_EDOMAIN, "the force along %.60s has no value at rest: division by zero", q);
            (void)qdot_hint("dry friction of one coordinate is -mu*sign(%.60s'); along v/|v| of several it has no "
                            "equilibria that could be listed",
                            q);
            break;
        }
    }
    if (status == QDOT_OK)
        r->forces = qdot_list(r->pool, (uint32_t)n, e);
    for (size_t i = 0; i < m && status == QDOT_OK; i++)
        if (e[i] != QDOT_ZERO && !qdot_is_zero(r->pool, e[i], &r->facts))
            e[count++] = e[i];
    *list = qdot_list(r->pool, (uint32_t)count, e);
    qdot_free(e);
    return status == QDOT_OK ? qdot_pool_check(r->pool) : status;
}

static bool
contains_multiplier(const qdot_rest *r, qdot_expr e)
{
    for (size_t k = 0; k < r->s->constraints.n; k++)
        if (qdot_expr_contains(r->pool, e, r->s->constraints.at[k].multiplier))
            return true;
    return false;
}

/* Append the equations that e implies at t = `time`; QDOT_EDOMAIN if undefined. */
static qdot_status
append_equations_at_time(qdot_rest *r, qdot_expr e, qdot_expr time, qdot_expr *list)
{
    int most = contains_multiplier(r, e) ? 0 : DERIVATIVES;
    const qdot_expr t = QDOT_T;

    for (int k = 0; k <= most; k++) {
        qdot_expr one = qdot_subs(r->pool, e, 1, &t, &time);

        one = qdot_simplify(r->pool, one, &r->facts);
        if (one != QDOT_NIL && one != QDOT_ZERO && !qdot_is_zero(r->pool, one, &r->facts))
            *list = qdot_list_appended(r->pool, *list, 1, &one);
        e = qdot_diff(r->pool, e, QDOT_T);
        QDOT_TRY(qdot_pool_check(r->pool));
    }
    return QDOT_OK;
}

qdot_status
qdot_rest_at_all_times(qdot_rest *r, qdot_expr equations, qdot_expr *list)
{
    *list = qdot_list(r->pool, 0, NULL);
    for (uint32_t i = 0; i < qdot_expr_count(r->pool, equations); i++) {
        qdot_expr e = qdot_expr_arg(r->pool, equations, i), with = *list;
        qdot_status status;

        if ((qdot_mech_holds(r->s, e) & QDOT_HAS_TIME) == 0) {
            *list = qdot_list_appended(r->pool, *list, 1, &e);
            continue;
        }
        status = append_equations_at_time(r, e, QDOT_ZERO, &with);
        if (status == QDOT_EDOMAIN) {
            with = *list;
            status = append_equations_at_time(r, e, QDOT_ONE, &with);
        }
        QDOT_TRY(status);
        *list = with;
    }
    return qdot_pool_check(r->pool);
}
