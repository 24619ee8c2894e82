/* outdated.c -- quantities of the scene, such as energy, along a run that was made before the scene changed. */
#include "lang/language/outdated.h"

#include "lang/answer/answer.h"
#include "lang/functions/quantity.h"
#include "lang/session/held.h"
#include "lang/session/names.h"
#include "lang/session/runs.h"

enum { DEEPEST = 8 /* functions whose bodies call functions */ };

/* Whether the token is a quantity of the scene: energy, p[theta]; not a name declared otherwise. */
static bool
is_quantity(const qdot_session *session, const qdot_token *token)
{
    const qdot_quantity *row = token->kind == QDOT_TOKEN_NAME ? qdot_quantity_find(token->text) : NULL;

    if (row == NULL || (row->least > 0 && !qdot_token_is(token + 1, "[")))
        return false;
    return qdot_names_find(session->names, token->text) == NULL;
}

/* Give the notice for each quantity in the tokens, and in the bodies of functions that they call. */
static qdot_status
give_notices(qdot_session *session, const qdot_named_run *run, const qdot_token *from, const qdot_token *to, int depth)
{
    for (const qdot_token *k = from; k < to; k++) {
        const qdot_name *name = k->kind == QDOT_TOKEN_NAME ? qdot_names_find(session->names, k->text) : NULL;

        if (k > from && qdot_token_is(k - 1, "."))
            continue;
        if (is_quantity(session, k))
            QDOT_TRY(qdot_answer_condition(session, "the scene has changed since the run %s was made: %s is that of the scene as it is now",
                                           run->name, k->text));
        else if (name != NULL && name->kind == QDOT_NAME_FUNCTION && name->body != NULL && depth < DEEPEST)
            QDOT_TRY(give_notices(session, run, name->body->from, name->body->to, depth + 1));
    }
    return QDOT_OK;
}

qdot_status
qdot_outdated_notice(qdot_session *session, const char *run, const qdot_token *from, const qdot_token *to)
{
    const qdot_run_list *runs = session->runs;
    const size_t i = run != NULL ? qdot_runs_index(session, run) : runs->n - 1;

    if (i >= runs->n || runs->at[i].version == qdot_held_version(session))
        return QDOT_OK;
    return give_notices(session, &runs->at[i], from, to, 0);
}

qdot_status
qdot_outdated_notice_call(qdot_session *session, const char *run, const qdot_token *call)
{
    return qdot_outdated_notice(session, run, call + 1, qdot_token_behind_bracket(call + 1));
}

qdot_status
qdot_outdated_notice_member(qdot_session *session, const qdot_token *run)
{
    const qdot_token *from = run + 2;

    return qdot_outdated_notice(session, run->text, from, qdot_token_is(from, "(") ? qdot_token_behind_bracket(from) : from + 1);
}
