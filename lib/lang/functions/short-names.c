/* short-names.c -- gives hints when a declaration uses L, T or V, which are the scene's Lagrangian and energies. */
#include "lang/functions/short-names.h"

#include <string.h>

#include "lang/answer/answer.h"
#include "lang/session/evaluation.h"

const char *
qdot_short_names_long(const qdot_quantity *row)
{
    const qdot_quantity *other;

    for (size_t i = 0; (other = qdot_quantity_at(i)) != NULL; i++)
        if (other != row && other->get == row->get &&
            strlen(other->name) > strlen(row->name))
            return other->name;
    return NULL;
}

static qdot_status
hint_at_declaration(const qdot_quantity *row)
{
    return qdot_hint("`%s` is the language's %s; `param %s` before it declares your own",
                     row->name, qdot_short_names_long(row), row->name);
}

qdot_status
qdot_short_names_note(qdot_session *session, const qdot_quantity *row, qdot_status status)
{
    if (qdot_short_names_long(row) == NULL)
        return status;
    if (status == QDOT_OK)
        session->evaluation->taken = row->name;
    else if (session->evaluation->declares)
        return hint_at_declaration(row);
    return status;
}

void
qdot_short_names_forget(qdot_session *session)
{
    session->evaluation->taken = NULL;
}

/* If a declaration failed after a name such as L was read as a scene's quantity, explain that in the hint. */
static qdot_status
explain_short_name(const qdot_session *session, qdot_status status)
{
    if (session->evaluation->taken == NULL || qdot_last_error()->status != status ||
        qdot_last_error()->hint[0] != '\0')
        return status;
    return hint_at_declaration(qdot_quantity_find(session->evaluation->taken));
}

qdot_status
qdot_short_names_tell(qdot_session *session, qdot_status status)
{
    const char *name = session->evaluation->taken;

    if (status != QDOT_OK)
        return explain_short_name(session, status);
    if (name == NULL)
        return QDOT_OK;
    return qdot_answer_notice_once(session,
                                   "`%s` is here the language's %s as it was until now; "
                                   "`param %s` before it declares your own",
                                   name, qdot_short_names_long(qdot_quantity_find(name)),
                                   name);
}
