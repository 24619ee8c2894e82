/* mention.c -- finds the names that occur in tokens, without parsing these. */
#include "lang/syntax/mention.h"

#include <stdlib.h>

#include "lang/syntax/form.h"

bool
qdot_mention_next(qdot_mention *m)
{
    for (const qdot_token *k = m->next; k < m->to; k++) {
        m->begins = k == m->from || k[-1].kind == QDOT_TOKEN_END || qdot_token_is(k - 1, "{");
        if (m->begins)
            m->row = qdot_statement_row(k);
        if (k->kind != QDOT_TOKEN_NAME && !qdot_token_is(k, "%"))
            continue;
        m->name = k->text;
        m->next = k + 1;
        return true;
    }
    return false;
}

bool
qdot_mention_is_in(const qdot_token *from, const qdot_token *to, const char *name)
{
    for (const qdot_token *k = from; k < to; k++)
        if ((k->kind == QDOT_TOKEN_NAME || qdot_token_is(k, "%")) && strcmp(k->text, name) == 0)
            return true;
    return false;
}

const qdot_token *
qdot_mention_time(const qdot_token *from, const qdot_token *to, double last)
{
    const qdot_token *found = NULL;

    for (const qdot_token *k = from + 1; k + 1 < to; k++) {
        const bool ends_call = k->kind == QDOT_TOKEN_NUMBER && qdot_token_is(k + 1, ")") &&
                               (qdot_token_is(k - 1, ",") || qdot_token_is(k - 1, ".."));

        if (!ends_call || strtod(k->text, NULL) <= last)
            continue;
        last = strtod(k->text, NULL);
        found = k;
    }
    return found;
}
