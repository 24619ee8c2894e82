/* enclosing.c -- where a token stands: in which statement, in the brackets of which calls. */
#include "lang/language/enclosing.h"

#include "lang/session/evaluation.h"
#include "lang/session/range.h"

const qdot_token *
qdot_enclosing_statement(const qdot_cursor *c, const qdot_token *token)
{
    while (token > c->source->tokens.at && token[-1].kind != QDOT_TOKEN_END && !qdot_token_is(token - 1, "{"))
        token--;
    return token;
}

const qdot_token *
qdot_enclosing_bracket(const qdot_token *first, const qdot_token *token)
{
    int64_t depth = 0;

    while (token > first) {
        token--;
        depth += qdot_token_bracket(token);
        if (depth > 0)
            return token;
    }
    return NULL;
}

const qdot_builtin *
qdot_enclosing_call(const qdot_token *first, const qdot_token *open)
{
    return open != NULL && open > first && open[-1].kind == QDOT_TOKEN_NAME ? qdot_builtin_find(open[-1].text) : NULL;
}

bool
qdot_enclosing_is_variable(const qdot_token *first, const qdot_token *token)
{
    const qdot_builtin *call = qdot_enclosing_call(first, qdot_enclosing_bracket(first, token));

    return call != NULL && (call->flags & QDOT_BUILTIN_VARIABLE) && qdot_token_is(token - 1, ",");
}

/* The second argument of the call whose bracket this is; NULL: it has none. */
static const qdot_token *
second_argument(const qdot_token *open)
{
    int64_t depth = 1;

    for (const qdot_token *k = open + 1; k->kind != QDOT_TOKEN_END && depth > 0; k++) {
        if (depth == 1 && qdot_token_is(k, ","))
            return k + 1;
        depth += qdot_token_bracket(k);
    }
    return NULL;
}

bool
qdot_enclosing_binds(const qdot_cursor *c, const qdot_token *token)
{
    const qdot_token *first = qdot_enclosing_statement(c, token), *open = token;

    while ((open = qdot_enclosing_bracket(first, open)) != NULL) {
        const qdot_token *variable = second_argument(open);

        if (variable != NULL && open > first && (qdot_token_is_word(open - 1, "integral") || qdot_token_is_word(open - 1, "limit")) &&
            qdot_token_is_word(variable, token->text) &&
            (qdot_token_is(variable + 1, ",") || qdot_token_is(variable + 1, ")") || qdot_token_is(variable + 1, "=")))
            return true;
    }
    return false;
}

/* Whether the token begins what multipliers stand beside as symbols: an equation of motion, a reaction, an acceleration,
 * or a multiplier that is itself a variable. */
static bool
keeps_multipliers(const qdot_token *first, const qdot_token *k)
{
    static const char *const words[] = {"eom", "reactions", "accel"};

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (qdot_token_is_word(k, words[i]))
            return true;
    if (qdot_token_is(k, "'") && qdot_token_is(k + 1, "'"))
        return true;
    return qdot_token_is_word(k, "lambda") && qdot_enclosing_is_variable(first, k);
}

bool
qdot_enclosing_asks_multipliers(const qdot_cursor *c, const qdot_token *token)
{
    const qdot_token *first = qdot_enclosing_statement(c, token), *open = token;
    bool asks = c->session->evaluation->asks;

    if (c->session->evaluation->declares || (token > first && qdot_token_is(token - 1, ".")))
        return false;
    for (const qdot_token *k = first; k->kind != QDOT_TOKEN_END; k++)
        if (keeps_multipliers(first, k))
            return false;
    while ((open = qdot_enclosing_bracket(first, open)) != NULL) {
        const qdot_builtin *call = qdot_enclosing_call(first, open);

        if (call == NULL)
            continue;
        if ((call->flags & QDOT_BUILTIN_RUN) || qdot_range_is_word(call->name))
            return false;
        asks = asks || (call->flags & QDOT_BUILTIN_CALCULUS);
    }
    return asks;
}
