/* equilibria.c -- equilibria and modes of a session's scene, with its values for numbers. */
#include "lang/functions/equilibria.h"

#include "expr/calculus.h"
#include "expr/list.h"
#include "lang/answer/answer.h"
#include "lang/functions/solve-conditions.h"
#include "lang/session/bind.h"
#include "mech/dynamics/quantity.h"
#include "normal/solve/solve.h"

static qdot_expr
bind(void *session, qdot_expr e)
{
    return qdot_session_bind(session, e);
}

static qdot_status
need_coordinates(const qdot_session *session)
{
    if (session->scene->coordinates.n > 0)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "the scene has no coordinates");
    return qdot_hint("declare them: coord theta");
}

qdot_status
qdot_equilibria_find(qdot_session *session, qdot_equilibria *out)
{
    *out = (qdot_equilibria){0};
    QDOT_TRY(need_coordinates(session));
    return qdot_equilibrium_find(session->scene, bind, session, out);
}

qdot_expr
qdot_equilibria_value(qdot_pool *pool, const qdot_equilibrium *e)
{
    return e->range == QDOT_NIL ? e->equations
                                : qdot_list_appended(pool, e->equations, qdot_expr_count(pool, e->range),
                                                     qdot_expr_args(pool, e->range));
}

/* Those of a LIST that are equations: without the range of a band. */
static qdot_expr
equations_of(qdot_pool *pool, qdot_expr list)
{
    qdot_expr equations = qdot_list(pool, 0, NULL);

    for (uint32_t i = 0; i < qdot_expr_count(pool, list); i++) {
        qdot_expr one = qdot_expr_arg(pool, list, i);

        if (qdot_expr_node(pool, one)->op == QDOT_EQ)
            equations = qdot_list_appended(pool, equations, 1, &one);
    }
    return equations;
}

qdot_status
qdot_equilibria_list(qdot_session *session, const qdot_equilibria *all, qdot_expr *value)
{
    qdot_expr *members = qdot_malloc((all->n + 1) * sizeof *members);

    if (members == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < all->n; i++)
        members[i] = qdot_equilibria_value(session->pool, &all->at[i]);
    *value = qdot_list(session->pool, (uint32_t)all->n, members);
    qdot_free(members);
    return qdot_pool_check(session->pool);
}

/* The conditions with the values of the session put in. */
static qdot_expr
exists_now(qdot_session *session, qdot_expr exists)
{
    qdot_expr bound = qdot_session_bind(session, exists);

    return bound == QDOT_NIL ? QDOT_NIL : qdot_conditions_at(session->pool, bound, 0, NULL, NULL, NULL);
}

qdot_status
qdot_equilibria_notice(qdot_session *session, long k, const qdot_equilibrium *e)
{
    qdot_text text = {0};
    qdot_expr now;
    qdot_status status;

    if (e->exists == QDOT_NIL)
        return QDOT_OK;
    now = exists_now(session, e->exists);
    QDOT_TRY(qdot_pool_check(session->pool));
    if (now == QDOT_NIL) /* it does */
        return QDOT_OK;
    qdot_text_format(&text, "equilibria[%ld] exists when ", k);
    status = qdot_solve_print_conditions(session->pool, "", e->exists, &text);
    if (now == QDOT_FALSE)
        qdot_text_add(&text, ": not with the values of `set`");
    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = qdot_answer_notice_once(session, "%s", qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

/* --- the verdict as a value ------------------------------------------------------------------ */

static const char *const verdict_names[] = {
    [QDOT_STABLE] = "stable",
    [QDOT_UNSTABLE] = "unstable",
    [QDOT_STABLE_TO_FIRST_ORDER] = "stable_to_first_order",
    [QDOT_STABILITY_UNDECIDED] = "undecided",
};

qdot_expr
qdot_equilibria_word(qdot_pool *pool, qdot_stability stability)
{
    return qdot_symbol_get(pool, QDOT_FORMAL, verdict_names[stability]);
}

bool
qdot_equilibria_is_word(qdot_pool *pool, qdot_expr e)
{
    for (size_t i = 0; i < sizeof verdict_names / sizeof *verdict_names; i++)
        if (e == qdot_equilibria_word(pool, (qdot_stability)i))
            return true;
    return false;
}

static qdot_expr
as_value(qdot_pool *pool, const qdot_equilibrium *e)
{
    qdot_expr word = qdot_equilibria_word(pool, e->stability), when[3];

    if (e->stable_when == QDOT_NIL)
        return word;
    when[0] = qdot_expr_count(pool, e->stable_when) == 1
                  ? qdot_expr_arg(pool, e->stable_when, 0)
                  : qdot_logic(pool, QDOT_AND, qdot_expr_count(pool, e->stable_when),
                               qdot_expr_args(pool, e->stable_when));
    when[1] = word;
    when[2] = qdot_equilibria_word(pool, QDOT_STABILITY_UNDECIDED);
    return qdot_fun(pool, QDOT_IF, 3, when);
}

qdot_status
qdot_equilibria_stability(qdot_session *session, qdot_expr equations, qdot_expr *value)
{
    qdot_equilibria all;
    size_t at = 0;
    qdot_status status = qdot_equilibria_find(session, &all);

    while (status == QDOT_OK && at < all.n && qdot_equilibria_value(session->pool, &all.at[at]) != equations)
        at++;
    if (status == QDOT_OK && at == all.n) {
        (void)qdot_fail(QDOT_EINVAL, "that is none of the scene's equilibria");
        status = qdot_hint("stability(equilibria[1])");
    }
    if (status == QDOT_OK) {
        *value = as_value(session->pool, &all.at[at]);
        status = qdot_pool_check(session->pool);
    }
    qdot_equilibria_clear(&all);
    return status;
}

/* Whether a value is one that was found in numbers: 15 decimal digits. */
static bool
is_numeric(qdot_session *session, qdot_expr equations)
{
    for (uint32_t i = 0; i < qdot_expr_count(session->pool, equations); i++) {
        qdot_expr one = qdot_expr_arg(session->pool, equations, i);
        const fmpq *value =
            qdot_expr_rational(session->pool, qdot_expr_arg(session->pool, one, 1));

        if (value != NULL && fmpz_bits(fmpq_denref(value)) > 32)
            return true;
    }
    return false;
}

static qdot_status
none_to_swing_about(const qdot_equilibria *all)
{
    if (all->n == 0)
        return qdot_fail(QDOT_EINVAL, all->complete ? "the scene has no equilibrium"
                                                    : "no equilibrium was found");
    (void)qdot_fail(QDOT_EINVAL, "every equilibrium is unstable");
    return qdot_hint("modes at equilibria[1]");
}

qdot_status
qdot_equilibria_modes_at(qdot_session *session, qdot_expr equations, qdot_modes *modes)
{
    qdot_equilibria all;
    size_t at = 0;

    if (equations == QDOT_NIL) { /* the first that is not unstable */
        qdot_status status;

        QDOT_TRY(need_coordinates(session));
        QDOT_TRY(qdot_equilibrium_first(session->scene, bind, session, &all));
        while (at < all.n && all.at[at].stability == QDOT_UNSTABLE)
            at++;
        status = at < all.n ? QDOT_OK : none_to_swing_about(&all);
        if (status == QDOT_OK)
            equations = all.at[at].equations;
        qdot_equilibria_clear(&all);
        QDOT_TRY(status);
    }
    equations = equations_of(session->pool, equations);
    equations = qdot_solve_one_member(session->pool, equations);
    QDOT_TRY(qdot_modes_about(session->scene, equations, is_numeric(session, equations),
                              bind, session, modes));
    return modes->unordered
               ? qdot_answer_notice(session, "the declared signs do not decide the order of "
                                             "the modes: it is that at one choice of the "
                                             "parameters")
               : QDOT_OK;
}
