/* value-check.c -- refuses values that contradict a spring or an assumption, where they are given. */
#include "lang/commands/value-check.h"

#include <string.h>

#include "base/text.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/print-name.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/session/bind.h"
#include "lang/session/trial.h"
#include "lang/session/values.h"
#include "normal/inequality/less.h"
#include "normal/prove/decide.h"

static const uint32_t unknown = QDOT_HAS_PARAM | QDOT_HAS_UFUN | QDOT_HAS_MOMENTUM;

/* --- one value at a time -------------------------------------------------------------- */

qdot_status
qdot_value_check_rest(qdot_session *session, const char *spring, qdot_expr rest)
{
    double length;

    rest = qdot_session_bind(session, rest);
    QDOT_TRY(qdot_pool_check(session->pool));
    if ((qdot_expr_node(session->pool, rest)->holds &
         (unknown | QDOT_HAS_COORD | QDOT_HAS_TIME)) ||
        qdot_session_number(session, rest, &length, NULL) != QDOT_OK || !(length < 0))
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "the rest length of %s%.100s is negative: %.10g",
                    spring != NULL ? "spring " : "a spring", spring != NULL ? spring : "",
                    length);
    return qdot_hint("`rest 0`, or none, makes a spring that pulls at any length");
}

/* Fail with a message such as "b > a is assumed, and 1 > 2 does not hold", which states values that violate an assumption. */
static qdot_status
report_violated_assumption(qdot_session *session, const qdot_assumption *said, const qdot_expr *side)
{
    static const char *const signs[2][2] = {{"<=", "<"}, {">=", ">"}};
    qdot_pool *pool = session->pool;
    qdot_rel_op op = (qdot_rel_op)qdot_expr_node(pool, said->relation)->op;
    const char *sign = op == QDOT_EQ ? "=" : signs[said->turned][op == QDOT_LT];
    double number[2];
    bool numbers = qdot_session_number(session, side[0], &number[0], NULL) == QDOT_OK &&
                   qdot_session_number(session, side[1], &number[1], NULL) == QDOT_OK;
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    for (int k = 0; k < 2 && status == QDOT_OK; k++) {
        if (k > 0)
            qdot_text_format(&text, " %s ", sign);
        status = qdot_print(pool, qdot_expr_arg(pool, said->relation, k ^ said->turned),
                            QDOT_PLAIN, &text);
    }
    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK && numbers)
        status = qdot_fail(QDOT_EINVAL, "%.200s is assumed, and %.10g %s %.10g does not hold",
                           qdot_text_str(&text), number[said->turned], sign,
                           number[!said->turned]);
    else if (status == QDOT_OK)
        status = qdot_fail(QDOT_EINVAL, "%.200s is assumed, and these values exclude it",
                           qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

qdot_status
qdot_value_check_assumption(qdot_session *session, const qdot_assumption *said)
{
    const uint32_t moving = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION |
                            QDOT_HAS_TIME | QDOT_HAS_MULTIPLIER;
    qdot_pool *pool = session->pool;
    qdot_rel_op op = (qdot_rel_op)qdot_expr_node(pool, said->relation)->op;
    qdot_decision seen = {.verdict = QDOT_UNDECIDED};
    qdot_expr side[2];
    uint32_t holds = 0;
    bool bound = false;

    for (int k = 0; k < 2; k++) {
        qdot_expr given = qdot_expr_arg(pool, said->relation, (uint32_t)k);

        side[k] = qdot_session_bind(session, given);
        QDOT_TRY(qdot_pool_check(pool));
        holds |= qdot_expr_node(pool, side[k])->holds;
        bound = bound || side[k] != given;
    }
    if (!bound || (holds & unknown))
        return QDOT_OK;
    if (op == QDOT_EQ)
        QDOT_TRY(qdot_decide_equal(pool, side[0], side[1], NULL, &seen));
    else if (!(holds & moving) && (op == QDOT_LT || op == QDOT_LE))
        QDOT_TRY(qdot_decide_less(pool, side[0], side[1], op == QDOT_LT, NULL, &seen));
    return seen.verdict == QDOT_REFUTED ? report_violated_assumption(session, said, side) : QDOT_OK;
}

qdot_status
qdot_value_check_assumed(qdot_session *session)
{
    for (size_t i = 0; i < session->scene->assumed.n; i++)
        QDOT_TRY(qdot_value_check_assumption(session, &session->scene->assumed.at[i]));
    return QDOT_OK;
}

/* --- all springs and assumptions of the scene ----------------------------------------- */

/* The place of the last given value whose symbol occurs in e; if none does, of the first value. */
static const qdot_token *
find_violating_value(qdot_session *session, const qdot_pairs *values, qdot_expr e)
{
    for (size_t i = values->symbols.n; i-- > 0;)
        if (qdot_expr_contains(session->pool, e, values->symbols.at[i]))
            return values->places.at[i];
    return values->places.at[0];
}

/* Whether e contains more than one parameter. */
static bool
has_several_parameters(qdot_session *session, qdot_expr e)
{
    qdot_pool *pool = session->pool;
    qdot_expr atoms = qdot_expr_atoms(pool, e, false);
    uint32_t found = 0;

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++)
        found += qdot_expr_is_class(pool, qdot_expr_arg(pool, atoms, i), QDOT_PARAM);
    return found > 1;
}

static qdot_status
check_all_values(qdot_cursor *c, const qdot_pairs *values)
{
    qdot_session *session = c->session;
    const qdot_scene *scene = session->scene;

    for (size_t i = 0; i < scene->springs.n; i++) {
        const qdot_link *spring = &scene->springs.at[i];

        if (!(qdot_expr_node(session->pool, spring->rest)->holds & unknown))
            continue;
        c->error_at = find_violating_value(session, values, spring->rest)->start;
        QDOT_TRY(qdot_value_check_rest(session, spring->name, spring->rest));
    }
    for (size_t i = 0; i < scene->assumed.n; i++) {
        const qdot_assumption *said = &scene->assumed.at[i];
        qdot_status status;

        c->error_at = find_violating_value(session, values, said->relation)->start;
        status = qdot_value_check_assumption(session, said);
        if (status == QDOT_EINVAL && values->symbols.n == 1 && has_several_parameters(session, said->relation))
            status = qdot_hint("set values that depend on each other in one statement: a = 2, b = 3");
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

qdot_status
qdot_value_check(qdot_cursor *c, const qdot_pairs *values)
{
    qdot_session *session = c->session;
    qdot_trial trial;
    qdot_status status = QDOT_OK;

    if (values->symbols.n == 0 || session->scene->springs.n + session->scene->assumed.n == 0)
        return QDOT_OK;
    QDOT_TRY(qdot_trial_begin(&trial, session));
    for (size_t i = 0; i < values->symbols.n && status == QDOT_OK; i++)
        if (qdot_expr_node(session->pool, values->symbols.at[i])->holds & unknown)
            qdot_session_set(session, values->symbols.at[i], values->values.at[i],
                             &status);
    if (status == QDOT_OK)
        status = check_all_values(c, values);
    qdot_trial_end(&trial);
    return status;
}
