/* outline.c -- finds where the statements and blocks of a source begin and end. */
#include "lang/syntax/outline.h"

#include "lang/session/names.h"

enum { FEW = 5 }; /* the number of first tokens of a statement that are looked at */

qdot_outline_kind
qdot_outline_at(const qdot_token *first)
{
    return qdot_token_is(first, "{")         ? QDOT_OUTLINE_BLOCK
           : first->kind == QDOT_TOKEN_END ? QDOT_OUTLINE_END
                                             : QDOT_OUTLINE_STATEMENT;
}

const qdot_token *
qdot_outline_end(const qdot_token *token)
{
    while (token->kind != QDOT_TOKEN_END)
        token++;
    return token;
}

/* Whether `plot` draws a curve for each value of the index itself: it is a parameter or coordinate, of which the run is
 * made once more. */
static bool
is_index_of_plot(const qdot_session *session, const qdot_token *index)
{
    const qdot_name *known = qdot_names_find(session->names, index->text);

    return known != NULL && (known->kind == QDOT_NAME_PARAM || known->kind == QDOT_NAME_COORD);
}

qdot_outline
qdot_outline_statement(const qdot_session *session, const qdot_token *first)
{
    const bool plot = qdot_token_is_word(first, "plot");
    bool own = false;
    int64_t depth = 0;

    for (const qdot_token *k = first;; k++) {
        if (k->kind == QDOT_TOKEN_END)
            return (qdot_outline){first, NULL, k};
        depth += qdot_token_bracket(k);
        if (depth != 0 || k == first)
            continue;
        if (plot && qdot_token_is_word(k, "vs") && k[1].kind == QDOT_TOKEN_NAME && qdot_token_is(k + 2, "="))
            own = true;
        if (plot && qdot_token_is_word(k, "bode") && (qdot_token_is_word(k - 1, "plot") || qdot_token_is(k - 1, "|")))
            own = true;
        if (!own && qdot_token_is_word(k, "for") && k[1].kind == QDOT_TOKEN_NAME &&
            !(plot && is_index_of_plot(session, k + 1)) &&
            (qdot_token_is(k + 2, "=") || k[2].kind == QDOT_TOKEN_NAME || k[2].kind == QDOT_TOKEN_END))
            return (qdot_outline){first, k, qdot_outline_end(k)};
    }
}

qdot_status
qdot_outline_blocks(const qdot_source *source, uint32_t **close)
{
    qdot_vec(uint32_t) open = {0};
    qdot_status status = QDOT_OK;

    *close = NULL;
    for (size_t i = 0; i < source->tokens.n && status == QDOT_OK; i++) {
        if (qdot_token_is(&source->tokens.at[i], "{")) {
            if (*close == NULL)
                *close = qdot_calloc(source->tokens.n, sizeof **close);
            status = *close != NULL ? qdot_vec_push(&open, (uint32_t)i) : QDOT_ENOMEM;
        } else if (qdot_token_is(&source->tokens.at[i], "}") && open.n > 0) {
            (*close)[open.at[--open.n]] = (uint32_t)i;
        }
    }
    qdot_free(open.at);
    return status;
}

const qdot_token *
qdot_outline_block_loop(const qdot_token *close)
{
    return qdot_token_is_word(close + 1, "for") ? close + 1 : NULL;
}

const qdot_token *
qdot_outline_file(const qdot_token *first)
{
    const qdot_token *end = qdot_outline_end(first);

    return end - first >= 2 && end[-1].kind == QDOT_TOKEN_STRING && qdot_token_is_word(end - 2, "to") ? end - 2 : NULL;
}

qdot_token_kind
qdot_outline_cut(const qdot_token *token)
{
    const qdot_token_kind kind = token->kind;

    ((qdot_token *)token)->kind = QDOT_TOKEN_END;
    return kind;
}

void
qdot_outline_join(const qdot_token *token, qdot_token_kind kind)
{
    ((qdot_token *)token)->kind = kind;
}

bool
qdot_outline_fails_early(const qdot_token *first, const qdot_token *end, size_t at, bool *open)
{
    const size_t few = end - first > FEW ? FEW : (size_t)(end - first);

    *open = at >= end[-1].start + end[-1].length;
    return *open ? end - first <= FEW : at <= first[few - 1].start;
}
