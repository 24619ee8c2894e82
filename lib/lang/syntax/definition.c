/* definition.c -- splits a definition LEFT = RIGHT into its parts. */
#include "lang/syntax/definition.h"

#include "lang/language/token-text.h"
#include "lang/syntax/form.h"

/* Find where the right side of a definition ends, and what it contains. */
static void
read_right(qdot_definition *d, const qdot_token *end)
{
    const qdot_token *from = d->equals + 1;
    const bool bracket = qdot_token_is(from, "(");
    size_t commas = 0;
    int64_t depth = 0;

    for (d->behind = from; d->behind < end; d->behind++) {
        const qdot_token *k = d->behind;

        depth += qdot_token_bracket(k);
        if (depth == 0 && k > from &&
            (qdot_token_is_word(k, "for") || (qdot_token_is_word(k, "to") && k[1].kind == QDOT_TOKEN_STRING)))
            break;
        d->chained |= depth == 0 && qdot_token_is(k, "=");
        d->sum |= depth == 0 && (qdot_token_is(k, "+") || qdot_token_is(k, "-"));
        d->on |= depth == 0 && k > from && qdot_token_is_word(k, "on");
        d->equation |= qdot_token_is(k, "=");
        d->comparison |= qdot_token_is(k, "=") || qdot_token_is(k, "==");
        d->primed |= qdot_token_is(k, "'");
        d->accelerations |= qdot_token_is(k, "'") && qdot_token_is(k + 1, "'");
        d->range |= qdot_token_is(k, "..");
        d->colon |= qdot_token_is(k, ":");
        d->text |= k->kind == QDOT_TOKEN_STRING;
        commas += depth == 1 && qdot_token_is(k, ",");
    }
    d->loop = qdot_token_is_word(d->behind, "for");
    d->components = bracket && qdot_token_behind_bracket(from) == d->behind ? commas + 1 : 1;
}

bool
qdot_definition_find(const qdot_token *first, const qdot_token *end, qdot_definition *d)
{
    const qdot_token *k = first + 1;

    *d = (qdot_definition){.name = first};
    if (first->kind != QDOT_TOKEN_NAME)
        return false;
    d->member = qdot_token_is(k, "[");
    d->call = qdot_token_is(k, "(");
    d->apart = (d->member || d->call) && !k->glued;
    if (d->member || d->call)
        k = qdot_token_behind_bracket(k);
    for (; qdot_token_is(k, "'") && k->glued; k++)
        d->primes++;
    if (!qdot_token_is(k, "="))
        return false;
    d->equals = k;
    read_right(d, end);
    return true;
}

void
qdot_definition_component(qdot_session *session, const qdot_definition *d, size_t i, qdot_text *out)
{
    const bool vector = d->components > 1;
    const qdot_token *k = d->equals + 1 + vector, *const end = d->behind - vector, *from = k;
    int64_t depth = 0;

    for (; k < end; k++) {
        if (depth == 0 && qdot_token_is(k, ",")) {
            if (i-- == 0)
                break;
            from = k + 1;
        }
        depth += qdot_token_bracket(k);
    }
    qdot_token_text_written(session, from, k, out);
}

void
qdot_definition_member(const qdot_definition *d, qdot_text *out)
{
    const qdot_token *k = d->name + 2;

    while (d->member && (k->kind == QDOT_TOKEN_NUMBER || qdot_token_is(k, ",")))
        k++;
    if (!d->member || k == d->name + 2 || !qdot_token_is(k, "]"))
        return;
    for (const qdot_token *part = d->name; part <= k; part++)
        qdot_text_add(out, part->text);
}

const qdot_token *
qdot_definition_argument(const qdot_definition *d, size_t i)
{
    const qdot_token *k = d->name + 2, *found = NULL;

    for (size_t n = 0; d->call; k += 2, n++) {
        if (k->kind != QDOT_TOKEN_NAME || !(qdot_token_is(k + 1, ",") || qdot_token_is(k + 1, ")")))
            return NULL;
        found = n == i ? k : found;
        if (qdot_token_is(k + 1, ")"))
            break;
    }
    return found;
}

const char *
qdot_definition_word(const qdot_definition *d)
{
    const qdot_token *right = d->equals + 1;

    return right->kind == QDOT_TOKEN_NAME && right + 1 == d->behind ? right->text : NULL;
}

const char *
qdot_definition_applied(const qdot_definition *d)
{
    const qdot_token *right = d->equals + 1;

    return right->kind == QDOT_TOKEN_NAME && (qdot_token_is(right + 1, "(") || qdot_token_is(right + 1, "."))
               ? right->text
               : NULL;
}

qdot_mention
qdot_definition_right(const qdot_definition *d)
{
    return qdot_mention_in(d->equals + 1, d->behind);
}

const char *
qdot_definition_next_term(const qdot_definition *d, const qdot_token **at)
{
    const qdot_token *k = *at != NULL ? *at : d->equals + 1;

    for (; k < d->behind; k++) {
        if (k->kind != QDOT_TOKEN_NAME)
            continue;
        if (qdot_token_is(k + 1, "(")) {
            k = qdot_token_behind_bracket(k + 1) - 1; /* step over the arguments */
        } else if (!qdot_token_is(k + 1, "[")) {
            *at = k + 1;
            return k->text;
        }
    }
    return NULL;
}

bool
qdot_definition_recurs_at(const qdot_definition *d, size_t at, bool *family)
{
    for (qdot_mention m = qdot_mention_in(d->name + 1, d->behind); qdot_mention_next(&m);)
        if (m.next[-1].start == at && strcmp(m.name, d->name->text) == 0) {
            *family = qdot_token_is(m.next, "[");
            return true;
        }
    return false;
}
