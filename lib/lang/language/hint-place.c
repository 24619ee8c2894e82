/* hint-place.c -- which tokens of a statement the text of a hint `write TEXT` is to replace. */
#include "lang/language/hint-place.h"

#include <string.h>

#include "lang/source/source.h"

static bool
is_operand(const qdot_token *k)
{
    return k->kind == QDOT_TOKEN_NAME || k->kind == QDOT_TOKEN_NUMBER;
}

/* How often the token stands among from ... to - 1. */
static size_t
count_token(const qdot_token *from, const qdot_token *to, const qdot_token *token)
{
    size_t n = 0;

    for (; from < to; from++)
        n += from->kind == token->kind && strcmp(from->text, token->text) == 0;
    return n;
}

/* Whether all names and numbers from ... to - 1 but the first are in the source as often. */
static bool
keeps_operands(const qdot_token *from, const qdot_token *to, const qdot_source *source)
{
    const qdot_token *own = source->tokens.at, *end = own + source->tokens.n;

    for (const qdot_token *k = from + 1; k < to; k++)
        if (is_operand(k) && count_token(own, end, k) < count_token(from + 1, to, k))
            return false;
    return true;
}

/* The end of the longest run of tokens from `first` on that the source keeps, with whole brackets, behind an operand. */
static const qdot_token *
end_of_kept(const qdot_token *first, const qdot_token *end, const qdot_source *source)
{
    const qdot_token *last = first;
    int depth = 0;

    for (const qdot_token *k = first; k < end && depth >= 0 && keeps_operands(first, k + 1, source); k++) {
        depth += qdot_token_bracket(k);
        if (depth == 0 && (is_operand(k) || qdot_token_bracket(k) < 0 || qdot_token_is(k, "'")))
            last = k;
    }
    return last + 1;
}

static bool
tokens_are_equal(const qdot_token *a, const qdot_token *b, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (a[i].kind != b[i].kind || strcmp(a[i].text, b[i].text) != 0)
            return false;
    return true;
}

/* Where the text begins: before the token at fault, if it begins with the tokens there. */
static const qdot_token *
begin_of_text(const qdot_token *first, const qdot_token *at, const qdot_source *source)
{
    size_t n = (size_t)(at - first) < source->tokens.n ? (size_t)(at - first) : source->tokens.n;

    while (n > 0 && !tokens_are_equal(at - n, source->tokens.at, n))
        n--;
    return at - n;
}

size_t
qdot_hint_places(const qdot_token *first, const qdot_token *end, const qdot_token *at, const qdot_source *text,
                 qdot_hint_place places[2])
{
    const qdot_token *from = begin_of_text(first, at, text);

    places[0] = (qdot_hint_place){from, end_of_kept(from, end, text)};
    places[1] = (qdot_hint_place){first, end_of_kept(first, end, text)};
    return from != first && places[1].to > from ? 2 : 1; /* the fault is to be a part of what is replaced */
}
