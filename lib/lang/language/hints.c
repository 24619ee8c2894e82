/* hints.c -- what a person may have meant: the nearest name, our form of another. */
#include "lang/language/hints.h"

#include <stdio.h>
#include <string.h>

#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/language/foreign-words.h"
#include "lang/session/labels.h"

/* --- the nearest of everything known ------------------------------------------------ */

const char *
qdot_hints_nearest(qdot_session *session, const char *name)
{
    qdot_words list = {0};
    const char *nearest;

    qdot_labels_add(session->scene, &list);
    for (size_t i = 0; qdot_quantity_at(i) != NULL; i++)
        (void)qdot_vec_push(&list, qdot_quantity_at(i)->name); /* a hint less without memory */
    for (size_t i = 0; qdot_builtin_at(i) != NULL; i++)
        if (!(qdot_builtin_at(i)->flags & QDOT_BUILTIN_SHORT))
            (void)qdot_vec_push(&list, qdot_builtin_at(i)->name);
    nearest = qdot_names_nearest(session->names, name, list.n, list.at);
    qdot_free(list.at);
    return nearest;
}

/* --- other systems' forms ----------------------------------------------------------- */

bool
qdot_hints_is_foreign(const qdot_session *session, const char *name)
{
    return !qdot_cursor_knows(session, name) && qdot_foreign_word(name) != NULL;
}

/* The text inside the bracket that `open` opens, "..." where it is long. */
static void
bracket_text(const qdot_cursor *c, const qdot_token *open, char *text, size_t size)
{
    const qdot_token *last = c->source->tokens.at + c->source->tokens.n - 1, *t = open;
    size_t from = open->start + open->length;
    long depth = 0;

    for (; t < last && t < open + 64; t++) {
        const int step = qdot_token_bracket(t);

        depth += step;
        if (step < 0 && depth == 0)
            break;
    }
    if (depth > 0 || t == last || t->start - from >= size ||
        memchr(c->source->text + from, '\n', t->start - from) != NULL)
        snprintf(text, size, "...");
    else
        snprintf(text, size, "%.*s", (int)(t->start - from), c->source->text + from);
}

/* thetadot, thetaddot, theta_dot of a coordinate theta: its primes. */
static bool
hint_dot(qdot_cursor *c, const char *name)
{
    static const struct {
        const char *ending, *primes;
    } endings[] = {{"_ddot", "''"}, {"_dot", "'"}, {"ddot", "''"}, {"dot", "'"}};
    size_t n = strlen(name);
    char base[64];

    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        size_t m = strlen(endings[i].ending);
        const qdot_name *found;

        if (!qdot_ends_in(name, endings[i].ending) || n - m >= sizeof base)
            continue;
        snprintf(base, sizeof base, "%.*s", (int)(n - m), name);
        found = qdot_names_find(c->session->names, base);
        if (found != NULL || qdot_names_is_family(c->session->names, base)) {
            qdot_hint("write %s%s%s", base, found == NULL ? "[k]" : "",
                      endings[i].primes);
            return true;
        }
    }
    return false;
}

/* --- the errors --------------------------------------------------------------------- */

qdot_status
qdot_hints_unknown(qdot_cursor *c, const qdot_token *token, const char *member)
{
    const char *name = token->text, *nearest, *ours;
    char text[100];

    qdot_fail(QDOT_ENAME, "unknown name `%.200s`", member != NULL ? member : name);
    if (qdot_token_is(token + 1, "[") && token[1].glued) {
        ours = qdot_foreign_word(name);
        if (ours != NULL) {
            bracket_text(c, token + 1, text, sizeof text);
            return qdot_hint("write %s(%s)", ours, text);
        }
    }
    if (hint_dot(c, name))
        return QDOT_ENAME;
    if (strcmp(name, "e") == 0 && qdot_token_is(token + 1, "^"))
        return qdot_hint("the exponential function is exp(x)");
    if (strcmp(name, "Pi") == 0 || strcmp(name, "PI") == 0)
        return qdot_hint("write pi");
    if (member == NULL && (strcmp(name, "p") == 0 || strcmp(name, "Q") == 0 ||
                           strcmp(name, "delta") == 0 || strcmp(name, "lambda") == 0))
        return qdot_hint("write %s[NAME], or declare `%s`", name, name);
    nearest = qdot_hints_nearest(c->session, member != NULL ? member : name);
    if (nearest != NULL)
        return qdot_hint("did you mean `%s`?", nearest);
    if (member == NULL && name[0] == 'd' && name[1] != '\0' && qdot_token_is(token + 1, "^"))
        return qdot_hint("`coord %s` declares %s and its differential %s", name + 1, name + 1, name);
    return QDOT_ENAME;
}

qdot_status
qdot_hints_unknown_function(qdot_cursor *c, const qdot_token *token)
{
    const char *name = token->text, *ours = qdot_foreign_word(name), *nearest;
    char text[100];

    qdot_fail(QDOT_ENAME, "unknown function `%.200s`", name);
    if (ours != NULL && qdot_token_is(token + 1, "(")) {
        bracket_text(c, token + 1, text, sizeof text);
        return qdot_hint("write %s(%s)", ours, text);
    }
    if (strcmp(name, "pow") == 0)
        return qdot_hint("a power is written a^b");
    nearest = qdot_hints_nearest(c->session, name);
    if (nearest != NULL)
        return qdot_hint("did you mean `%s`?", nearest);
    return QDOT_ENAME;
}

qdot_status
qdot_hints_bare_function(qdot_cursor *c, const qdot_token *token)
{
    const qdot_token *next = token + 1;
    const char *name = token->text;
    char text[100];

    qdot_fail(QDOT_ESYNTAX, "`%s` is a function: its argument goes in ( )", name);
    if (qdot_token_is(next, "^") && next[1].kind != QDOT_TOKEN_END &&
        qdot_token_is(next + 2, "(")) {
        bracket_text(c, next + 2, text, sizeof text);
        return qdot_hint("write %s(%s)^%.40s", name, text, next[1].text);
    }
    if (qdot_token_is(next, "[")) {
        bracket_text(c, next, text, sizeof text);
        return qdot_hint("write %s(%s)", name, text);
    }
    if (next->kind == QDOT_TOKEN_NAME || next->kind == QDOT_TOKEN_NUMBER)
        return qdot_hint("write %s(%.80s)", name, next->text);
    return qdot_hint("as in %s", qdot_builtin_find(name)->usage);
}
