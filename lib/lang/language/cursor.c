/* cursor.c -- steps over the tokens of a statement, with messages for unexpected ones. */
#include "lang/language/cursor.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/spelling.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/session/names.h"
#include "lang/source/letters.h"
#include "mech/scene/scene.h"

bool
qdot_cursor_is_op(const qdot_cursor *c, const char *op)
{
    return qdot_token_is(c->at, op);
}

bool
qdot_cursor_is_word(const qdot_cursor *c, const char *word)
{
    return qdot_token_is_word(c->at, word);
}

bool
qdot_cursor_accept_op(qdot_cursor *c, const char *op)
{
    bool is = qdot_cursor_is_op(c, op);

    c->at += is;
    return is;
}

bool
qdot_cursor_accept_word(qdot_cursor *c, const char *word)
{
    bool is = qdot_cursor_is_word(c, word);

    c->at += is;
    return is;
}

bool
qdot_cursor_is_end(const qdot_cursor *c)
{
    return c->at->kind == QDOT_TOKEN_END;
}

/* --- tokens ------------------------------------------------------------------------- */

static bool
is_one_of(const qdot_token *t, const char *const *list)
{
    for (; *list != NULL; list++)
        if (strcmp(t->text, *list) == 0)
            return true;
    return false;
}

static bool
may_end_operand(const qdot_token *t)
{
    static const char *const closers[] = {")", "]", "'", NULL};

    return t->kind == QDOT_TOKEN_NUMBER ||
           (t->kind == QDOT_TOKEN_NAME && !qdot_is_connective(t->text)) ||
           (t->kind == QDOT_TOKEN_OPERATOR && is_one_of(t, closers));
}

static bool
token_begins_operand(const qdot_token *t)
{
    return t->kind == QDOT_TOKEN_NUMBER || t->kind == QDOT_TOKEN_NAME ||
           (t->kind == QDOT_TOKEN_OPERATOR &&
            (strcmp(t->text, "(") == 0 || strcmp(t->text, "sqrt") == 0));
}

bool
qdot_cursor_knows(const qdot_session *s, const char *name)
{
    return qdot_names_find(s->names, name) != NULL ||
           qdot_names_is_family(s->names, name) || qdot_builtin_find(name) != NULL ||
           qdot_quantity_find(name) != NULL || qdot_scene_has_label(s->scene, name) ||
           strcmp(name, "pi") == 0 || strcmp(name, "t") == 0;
}

/* --- products as the screen shows them ------------------------------------------------ */

/* Whether the name is declared as something that is not a function. */
static bool
is_declared_value(const qdot_session *s, const char *name)
{
    const qdot_name *n = qdot_names_find(s->names, name);

    return n != NULL ? n->kind != QDOT_NAME_FUNCTION && n->kind != QDOT_NAME_UFUN
                     : strcmp(name, "pi") == 0 || strcmp(name, "t") == 0;
}

/* Whether the name may be a factor: declared, also as a differential, du or δs, or as the member that a subscript denotes,
 * l₃; one that nobody knows within brackets, such as the index of a sum, or in a text that is being typed. A word of the
 * language, as `tol` or `size`, is none. */
static bool
may_be_factor(const qdot_cursor *c, const char *name, bool inside)
{
    const qdot_session *s = c->session;
    const bool joins = qdot_is_connective(name) || strcmp(name, "in") == 0; /* `x > 0 and y > 0`, `x in [m]` */
    const bool typed = c->is_word != NULL && !c->is_word(c->usage, name) && !joins;
    const bool unknown = (inside || typed) && !qdot_cursor_knows(s, name);
    qdot_text member = {0};
    bool known = unknown || is_declared_value(s, name) || (name[0] == 'd' && is_declared_value(s, name + 1)) ||
                 (strncmp(name, "delta", 5) == 0 && is_declared_value(s, name + 5));

    for (unsigned form = 0; !known && qdot_subscript_means(name, form, &member); form++)
        known = is_declared_value(s, qdot_text_str(&member));
    qdot_text_clear(&member);
    return known;
}

bool
qdot_cursor_is_shown_product(const qdot_cursor *c, const qdot_token *t, bool inside)
{
    if (!t->shown || t->glued || !may_end_operand(t - 1) ||
        (t[-1].kind == QDOT_TOKEN_NAME && !may_be_factor(c, t[-1].text, inside)))
        return false;
    if (t->kind != QDOT_TOKEN_NAME)
        return t->kind != QDOT_TOKEN_NUMBER && token_begins_operand(t);
    return may_be_factor(c, t->text, inside) ||
           (qdot_cursor_knows(c->session, t->text) && t[1].glued &&
            (qdot_token_bracket(t + 1) > 0 || qdot_token_is(t + 1, "^")));
}

/* --- errors ------------------------------------------------------------------------- */

/* Give a hint if the syntax of another system, such as `&&`, stands at this place. */
static qdot_status
hint_at_foreign_syntax(const qdot_token *t)
{
    static const struct {
        const char *text, *hint;
    } foreign[] = {
        {"&&", "write `and`"},
        {"&", "write `and`"},
        {"||", "write `or`"},
        {"|", "the absolute value is abs(x), or is written `or`"},
        {"!=", "`not (1 = 2)` is a condition, `check not 1 == 2` a claim"},
        {"!", "write `not`"},
        {"%", "the remainder is mod(a, b)"},
    };

    if (qdot_token_is(t, ":") && qdot_token_is(t + 1, "=") && t[1].glued)
        return qdot_hint("write `=`");
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++)
        if (t->kind == QDOT_TOKEN_OPERATOR && strcmp(t->text, foreign[i].text) == 0)
            return qdot_hint("%s", foreign[i].hint);
    return QDOT_ESYNTAX;
}

/* The token with which the operand begins that ends with `last`: of brackets the opening one, with
 * the name before it. */
static const qdot_token *
find_operand_start(const qdot_cursor *c, const qdot_token *last)
{
    const qdot_token *t = last, *first = c->source->tokens.at;
    int64_t depth = 0;

    while (t > first + 1 && t->kind == QDOT_TOKEN_NUMBER && qdot_token_is(t - 1, "^") && t->start == t[-1].start)
        t -= 2; /* skip an exponent that was written as a superscript: x² */
    while (t > first && qdot_token_is(t, "'"))
        t--;
    for (; t > first; t--) {
        depth += qdot_token_bracket(t);
        if (depth >= 0)
            break;
    }
    if (qdot_token_bracket(t) > 0 && t > first && t->glued && t[-1].kind == QDOT_TOKEN_NAME)
        t--;
    return t;
}

size_t
qdot_cursor_operand_end(const qdot_cursor *c, const qdot_token *t)
{
    const qdot_token *last = c->source->tokens.at + c->source->tokens.n - 1;
    int64_t depth = 0;

    if (t->kind == QDOT_TOKEN_NAME && t[1].glued && qdot_token_bracket(t + 1) > 0)
        t++;
    for (; t < last; t++) {
        depth += qdot_token_bracket(t);
        if (depth <= 0)
            break;
    }
    while (t < last && t[1].glued && qdot_token_is(t + 1, "'"))
        t++;
    return t->start + t->length;
}

/* Whether the token names a function of the language and nothing that was declared. */
static bool
is_function(const qdot_cursor *c, const qdot_token *t)
{
    return t->kind == QDOT_TOKEN_NAME && qdot_builtin_find(t->text) != NULL && qdot_names_find(c->session->names, t->text) == NULL;
}

/* Whether the operand [from, last] is no single word without a meaning, as `of` is. */
static bool
is_factor(const qdot_cursor *c, const qdot_token *from, const qdot_token *last)
{
    return from != last || from->kind != QDOT_TOKEN_NAME || qdot_cursor_knows(c->session, from->text);
}

/* Report that `*` is missing between the token `before` and the next one. */
static qdot_status
report_missing_times(qdot_cursor *c, const qdot_token *before)
{
    const qdot_token *t = c->at, *from;
    size_t to;
    int left;

    c->error_at = t->glued ? t->start : before->start + before->length;
    qdot_fail(QDOT_ESYNTAX, "a `*` is missing");
    from = find_operand_start(c, before);
    to = qdot_cursor_operand_end(c, t);
    left = (int)(before->start + before->length - from->start);
    if (to - from->start <= 100 && qdot_token_is(t, "(") && from - c->source->tokens.at >= 2 && qdot_token_is(from - 1, "^") && is_function(c, from - 2)) {
        c->error_at = from[-2].start; /* sin^2(x) */
        qdot_fail(QDOT_ESYNTAX, "`%s` is a function: its argument goes in ( )", from[-2].text);
        return qdot_hint("write %s%.*s^%.*s", from[-2].text, (int)(to - t->start), c->source->text + t->start, left,
                         c->source->text + from->start);
    }
    if (to - from->start > 100 || !is_factor(c, from, before) || (t->kind == QDOT_TOKEN_NAME && is_function(c, t) && !qdot_token_is(t + 1, "(")))
        return qdot_hint("a product is written with `*`");
    if (from == before && is_function(c, from) && qdot_builtin_find(from->text)->least <= 1) /* momentum bob: also a value by itself */
        return qdot_hint("write %s(%.*s)", from->text, (int)(to - t->start), c->source->text + t->start);
    return qdot_hint("write %.*s*%.*s", left, c->source->text + from->start,
                     (int)(to - t->start), c->source->text + t->start);
}

bool
qdot_cursor_is_call(const qdot_cursor *c, const qdot_token *t)
{
    return t->kind == QDOT_TOKEN_NAME && t[1].glued && qdot_token_is(t + 1, "(") && qdot_cursor_knows(c->session, t->text);
}

/* Whether the word begins another part of a statement, as `on` in `force 2 on bob`, so that no `*` is missing before it. */
static bool
begins_next_part(const qdot_cursor *c, const qdot_token *t)
{
    static const char *const words[] = {"on", "at", "from", "to", "between", "of", "with", "when", "then", "in", NULL};

    return t->kind == QDOT_TOKEN_NAME && !t->glued && is_one_of(t, words) && !qdot_cursor_knows(c->session, t->text);
}

static qdot_status
report_unexpected_token(const char *what, const qdot_token *t)
{
    if (t->kind == QDOT_TOKEN_END)
        return qdot_fail(QDOT_ESYNTAX, "expected %s, found the end of the statement",
                         what);
    if (t->kind == QDOT_TOKEN_STRING)
        return qdot_fail(QDOT_ESYNTAX, "expected %s, found a text in quotes", what);
    return qdot_fail(QDOT_ESYNTAX, "expected %s, found `%.*s`", what, 100, t->text);
}

/* Give a hint at the nearest of the words that `what` lists in backquotes. */
static qdot_status
hint_at_nearest_word(const char *what, const char *name)
{
    enum { WORDS = 16, LENGTH = 24 };
    char words[WORDS][LENGTH];
    const char *list[WORDS], *nearest;
    size_t n = 0;

    for (const char *c = strchr(what, '`'); c != NULL && n < WORDS; c = strchr(c, '`')) {
        size_t length = strcspn(c + 1, "`");

        if (c[1 + length] == '\0')
            break;
        if (length < LENGTH) {
            snprintf(words[n], LENGTH, "%.*s", (int)length, c + 1);
            list[n] = words[n];
            n++;
        }
        c += length + 2;
    }
    nearest = qdot_spelling_nearest(name, n, list);
    if (nearest != NULL && strcmp(nearest, name) == 0)
        qdot_hint("only one of such words may stand there");
    else if (nearest != NULL)
        qdot_hint("did you mean `%s`?", nearest);
    return QDOT_ESYNTAX;
}

qdot_status
qdot_cursor_expected(qdot_cursor *c, const char *what)
{
    const qdot_token *t = c->at;
    const qdot_token *before = t > c->source->tokens.at ? t - 1 : NULL;
    bool word = what[0] == '`' && what[1] >= 'a' && what[1] <= 'z';

    c->error_at = t->start;
    if (qdot_cursor_is_word(c, "for") && t[1].kind == QDOT_TOKEN_NAME) {
        report_unexpected_token(what, t);
        return qdot_hint("one `for` ends a statement: for k = 1..3, j = 1..2");
    }
    if (qdot_cursor_is_word(c, "to") && t[1].kind == QDOT_TOKEN_END && before != NULL &&
        may_end_operand(before)) {
        report_unexpected_token(what, t);
        return qdot_hint("behind `to` stands the name of a file in quotes: to \"a.txt\"");
    }
    if (before == NULL || before->kind == QDOT_TOKEN_END) {
        report_unexpected_token(what, t);
        return hint_at_foreign_syntax(t);
    }
    if (t->kind == QDOT_TOKEN_END)
        c->error_at = before->start + before->length;
    if (before->kind == QDOT_TOKEN_NUMBER && t->glued && strcmp(t->text, ".") == 0) {
        qdot_fail(QDOT_ESYNTAX, "a decimal point needs a digit after it");
        return qdot_hint("write %.80s.0", before->text);
    }
    if (!may_end_operand(before) || !token_begins_operand(t)) {
        report_unexpected_token(what, t);
        return hint_at_foreign_syntax(t);
    }
    if (strncmp(what, "a name", 6) == 0 || strncmp(what, "the name", 8) == 0 ||
        strncmp(what, "a text", 6) == 0)
        return report_unexpected_token(what, t); /* after an option word, such as `as`, not after an operand */
    if (word && t->kind == QDOT_TOKEN_NAME && !t->glued &&
        !qdot_cursor_knows(c->session, t->text)) {
        report_unexpected_token(what, t); /* among option words, as in `2 tol`, it is not a `*` that is missing */
        return hint_at_nearest_word(what, t->text);
    }
    if (begins_next_part(c, t)) {
        report_unexpected_token(what, t);
        return hint_at_foreign_syntax(t);
    }
    if (t->glued || before->kind == QDOT_TOKEN_NUMBER || qdot_cursor_is_call(c, t) ||
        (!word && (t->kind != QDOT_TOKEN_NAME || qdot_cursor_knows(c->session, t->text))))
        return report_missing_times(c, before);
    report_unexpected_token(what, t);
    if (word)
        return hint_at_nearest_word(what, t->text);
    return what[0] == '`' ? QDOT_ESYNTAX : qdot_hint("a product is written with `*`");
}

qdot_status
qdot_cursor_expect_op(qdot_cursor *c, const char *op)
{
    char what[16];

    if (qdot_cursor_accept_op(c, op))
        return QDOT_OK;
    snprintf(what, sizeof what, "`%s`", op);
    return qdot_cursor_expected(c, what);
}

qdot_status
qdot_cursor_expect_end(qdot_cursor *c)
{
    if (qdot_cursor_is_end(c))
        return QDOT_OK;
    return qdot_cursor_expected(c, "the end of the statement");
}
