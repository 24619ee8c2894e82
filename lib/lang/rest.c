/* rest.c -- no spring has a negative rest length: told where a value makes it so. */
#include "lang/rest.h"

#include "expr/calculus.h"
#include "expr/walk.h"

qdot_status
qdot_rest_check(qdot_session *session, const char *spring, qdot_expr rest)
{
    const uint32_t open = QDOT_HAS_COORD | QDOT_HAS_TIME | QDOT_HAS_PARAM | QDOT_HAS_UFUN;
    double length;

    rest = qdot_session_bind(session, rest);
    QDOT_TRY(qdot_pool_check(session->pool));
    if ((qdot_expr_node(session->pool, rest)->holds & open) ||
        qdot_session_number(session, rest, &length, NULL) != QDOT_OK || !(length < 0))
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "the rest length of %s%.100s is negative: %.10g",
                    spring != NULL ? "spring " : "a spring", spring != NULL ? spring : "",
                    length);
    return qdot_hint("rest 0, or none, for a spring that pulls from anywhere");
}

/* The last of the values that the rest length holds, else the first of all. */
static const qdot_token *
blame(qdot_session *session, const qdot_number_pairs *values, qdot_expr rest)
{
    for (size_t i = values->symbols.n; i-- > 0;)
        if (qdot_expr_contains(session->pool, rest, values->symbols.at[i]))
            return values->places.at[i];
    return values->places.at[0];
}

qdot_status
qdot_rest_check_values(qdot_cursor *c, const qdot_number_pairs *values)
{
    qdot_session *session = c->session;
    const qdot_scene *scene = session->scene;

    for (size_t i = 0; i < scene->springs.n && values->symbols.n > 0; i++) {
        const qdot_link *spring = &scene->springs.at[i];
        qdot_expr rest = spring->rest;

        /* twice: a value of `set` may hold what these give a value to */
        for (int round = 0; round < 2; round++) {
            rest = qdot_subs(session->pool, rest, values->symbols.n, values->symbols.at,
                             values->values.at);
            if (round == 0)
                rest = qdot_session_bind(session, rest);
            QDOT_TRY(qdot_pool_check(session->pool));
        }
        if (rest == spring->rest)
            continue;
        c->error_at = blame(session, values, spring->rest)->start;
        QDOT_TRY(qdot_rest_check(session, spring->name, rest));
    }
    return QDOT_OK;
}
