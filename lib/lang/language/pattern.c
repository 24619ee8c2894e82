/* pattern.c -- matches statements with patterns that have placeholders, and fills lines with the
 * matched texts. */
#include "lang/language/pattern.h"

#include <string.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/language/foreign-words.h"
#include "lang/session/names.h"
#include "lang/session/runs.h"
#include "mech/scene/things.h"

typedef struct {
    const qdot_session *session;
    const qdot_token *to; /* end of the statement */
    bool whole;
    qdot_pattern_match *m;
} matcher;

/* --- what one placeholder may hold ---------------------------------------------------- */

static const char *const units[] = {
    "kg",     "g",       "mg",    "m",    "cm",      "mm",     "km",     "um",
    "nm",     "s",       "ms",    "us",   "ns",      "min",    "h",      "N",
    "kN",     "J",       "kJ",    "W",    "kW",      "Hz",     "kHz",    "Pa",
    "K",      "A",       "C",     "V",    "T",       "rad",    "sec",    "Nm",
    "eV",     "lb",      "ft",    "inch", "meter",   "meters", "second", "seconds",
    "newton", "newtons", "joule", "gram", "kilogram"};

static bool
is_unit_of_measure(const char *name)
{
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strcmp(units[i], name) == 0)
            return true;
    return false;
}

/* The token behind the units at t, `m/s^2`; t itself if none are there. One name at least means
 * nothing else, and `letters` of them must stand there. */
static const qdot_token *
token_after_units(const matcher *x, const qdot_token *t, size_t letters)
{
    const qdot_token *k = t;
    bool unknown = false;
    size_t n = 0;

    for (; k < x->to && k->kind == QDOT_TOKEN_NAME && is_unit_of_measure(k->text); k++) {
        unknown = unknown || !qdot_cursor_knows(x->session, k->text);
        n += strlen(k->text);
        if (k + 1 < x->to && qdot_token_is(k + 1, "^"))
            k += k + 2 < x->to && qdot_token_is(k + 2, "-") ? 3 : 2;
        if (k + 1 < x->to && (qdot_token_is(k + 1, "/") || qdot_token_is(k + 1, "*")))
            k++;
    }
    if (k > x->to)
        k = x->to;
    return unknown && n >= letters ? k : t;
}

/* The token behind the coordinate at t: theta, theta[2], with primes theta'; t itself if there is
 * none. */
static const qdot_token *
token_after_coordinate(const matcher *x, const qdot_token *t, bool primes)
{
    const qdot_name *name =
        t->kind == QDOT_TOKEN_NAME ? qdot_names_find(x->session->names, t->text) : NULL;
    const qdot_token *k = t + 1;

    if (name == NULL || name->kind != QDOT_NAME_COORD) {
        if (t->kind != QDOT_TOKEN_NAME ||
            !qdot_names_is_family(x->session->names, t->text) || !qdot_token_is(k, "["))
            return t;
        while (k < x->to && !qdot_token_is(k, "]"))
            k++;
        k += k < x->to;
    }
    while (primes && k < x->to && qdot_token_is(k, "'"))
        k++;
    return k;
}

/* The coordinate of a momentum that is written p_theta or ptheta; NULL if the name is none. */
static const char *
coordinate_of_momentum(const qdot_session *s, const char *name)
{
    const qdot_name *found;

    if (name[0] != 'p')
        return NULL;
    name += name[1] == '_' ? 2 : 1;
    found = qdot_names_find(s->names, name);
    return found != NULL && found->kind == QDOT_NAME_COORD ? name : NULL;
}

/* Whether a token fits a placeholder of that kind in a pattern. */
static bool
fits_placeholder(const matcher *x, char kind, const qdot_token *t)
{
    const qdot_session *s = x->session;
    const qdot_name *name;
    const qdot_quantity *row;

    if (kind == 'T')
        return t->kind == QDOT_TOKEN_NUMBER && t->length == 3 && t->text[0] != '.' &&
               t->text[1] != '.';
    if (kind == '#' || kind == 's')
        return t->kind == (kind == '#' ? QDOT_TOKEN_NUMBER : QDOT_TOKEN_STRING);
    if (t->kind != QDOT_TOKEN_NAME)
        return false;
    name = qdot_names_find(s->names, t->text);
    switch (kind) {
    case 'n': return true;
    case 'u': return !qdot_cursor_knows(s, t->text);
    case 'p': return name != NULL && name->kind == QDOT_NAME_PARAM;
    case 'D': return name != NULL && name->kind == QDOT_NAME_VALUE && s->runs->n == 0;
    case 'l': return qdot_scene_has_label(s->scene, t->text);
    case 'd':
        name = t->text[0] == 'd' ? qdot_names_find(s->names, t->text + 1) : NULL;
        return name != NULL && name->kind == QDOT_NAME_COORD;
    case 'm': return name == NULL && coordinate_of_momentum(s, t->text) != NULL;
    case 'f': return name == NULL && qdot_foreign_word(t->text) != NULL;
    default: /* placeholders of the kinds v, V and i */
        row = name == NULL ? qdot_quantity_find(t->text) : NULL;
        if (kind == 'V')
            return row != NULL && row->most == 0 && qdot_builtin_find(t->text) == NULL;
        return row != NULL && (kind == 'v') == (row->most == 0);
    }
}

/* Whether a token may occur in an expression outside of brackets: a name, a number, an operator. */
static bool
may_be_in_expression(const qdot_token *t)
{
    static const char *const outer[] = {",", ";", "=", "==", ":", ".."};

    for (size_t i = 0; i < sizeof outer / sizeof *outer; i++)
        if (qdot_token_is(t, outer[i]))
            return false;
    return t->kind != QDOT_TOKEN_STRING;
}

/* Whether an operator is missing between the token at k and the token before it. */
static bool
is_operator_missing(const qdot_token *k)
{
    bool ends = k[-1].kind == QDOT_TOKEN_NAME || k[-1].kind == QDOT_TOKEN_NUMBER ||
                qdot_token_is(k - 1, ")") || qdot_token_is(k - 1, "]") ||
                qdot_token_is(k - 1, "'");

    if (!ends || (k->kind != QDOT_TOKEN_NAME && k->kind != QDOT_TOKEN_NUMBER))
        return false;
    return !qdot_is_connective(k->text) && !qdot_is_connective(k[-1].text); /* other tokens are never written so */
}

/* --- matching a pattern --------------------------------------------------------------- */

static bool match_pattern(matcher *x, const char *pattern, const qdot_token *t);

/* Let the placeholder match the tokens [from, to), and try to match the rest of the pattern after them. */
static bool
match_placeholder_and_rest(matcher *x, char kind, const qdot_token *from, const qdot_token *to,
                           const char *rest)
{
    size_t n = x->m->n;

    if (n == QDOT_PATTERN_HELD)
        return false;
    x->m->held[n].kind = kind;
    x->m->held[n].from = from;
    x->m->held[n].to = to;
    x->m->n++;
    if (match_pattern(x, rest, to))
        return true;
    x->m->n = n;
    return false;
}

/* The shortest run of tokens that lets the rest match: $e, $., $+; the longest expression where
 * nothing has to follow. */
static bool
match_token_sequence(matcher *x, char kind, const qdot_token *t, const char *rest)
{
    const bool longest = kind == 'e' && !x->whole && *rest == '\0';
    const qdot_token *last = t;
    int64_t depth = 0;

    if (kind == '.' && match_placeholder_and_rest(x, kind, t, t, rest))
        return true;
    for (const qdot_token *k = t; k < x->to; k++) {
        depth += qdot_token_bracket(k);
        if (kind == 'e' &&
            (depth < 0 || (depth == 0 && (!may_be_in_expression(k) || (k > t && is_operator_missing(k))))))
            break;
        if (depth != 0 && kind == 'e')
            continue;
        if (longest)
            last = k + 1;
        else if (match_placeholder_and_rest(x, kind, t, k + 1, rest))
            return true;
    }
    return longest && last > t && match_placeholder_and_rest(x, kind, t, last, rest);
}

static bool
match_placeholder(matcher *x, char kind, const qdot_token *t, const char *rest)
{
    const qdot_token *k = t;

    if (strchr("e.+", kind) != NULL)
        return match_token_sequence(x, kind, t, rest);
    if (t >= x->to)
        return false;
    switch (kind) {
    case 'U': k = token_after_units(x, t, 1); break;
    case 'M': k = token_after_units(x, t, 2); break;
    case 'q': k = token_after_coordinate(x, t, true); break;
    case 'c': k = token_after_coordinate(x, t, false); break;
    case 'w':
        while (k < x->to && k->kind == QDOT_TOKEN_NAME)
            k++;
        break;
    default: k += fits_placeholder(x, kind, t);
    }
    return k > t && match_placeholder_and_rest(x, kind, t, k, rest);
}

/* Whether the token is written exactly as the n letters at `text`. */
static bool
is_literal(const qdot_token *t, const char *text, size_t n)
{
    return (t->kind == QDOT_TOKEN_NAME || t->kind == QDOT_TOKEN_OPERATOR ||
            t->kind == QDOT_TOKEN_NUMBER) &&
           strlen(t->text) == n && strncmp(t->text, text, n) == 0;
}

/* Whether the token is one of a|b|c, given by n characters of `text`. */
static bool
is_one_of(const qdot_token *t, const char *text, size_t n)
{
    const char *end = text + n;

    while (text < end) {
        size_t length = strcspn(text, "|");

        if (length > (size_t)(end - text))
            length = (size_t)(end - text);
        if (is_literal(t, text, length))
            return true;
        text += length + 1;
    }
    return false;
}

static bool
match_pattern(matcher *x, const char *pattern, const qdot_token *t)
{
    const qdot_token *place = x->m->place;
    size_t n;
    const char *rest;
    bool found;

    pattern += strspn(pattern, " ");
    if (*pattern == '\0') {
        x->m->to = t;
        return !x->whole || t == x->to;
    }
    if (*pattern == '@') {
        x->m->place = t;
        pattern++;
    }
    n = strcspn(pattern, " ");
    rest = pattern + n;
    if (*pattern == '$' && n > 1)
        found = match_placeholder(x, pattern[1], t, rest);
    else if (t >= x->to)
        found = false;
    else if (*pattern == '(' && n > 1)
        found = is_one_of(t, pattern + 1, n - 2) && match_placeholder_and_rest(x, '(', t, t + 1, rest);
    else
        found = is_literal(t, pattern, n) && match_pattern(x, rest, t + 1);
    if (!found)
        x->m->place = place;
    return found;
}

bool
qdot_pattern_matches(const qdot_session *session, const char *pattern,
                     const qdot_token *from, const qdot_token *to, bool whole,
                     qdot_pattern_match *m)
{
    matcher x = {.session = session, .to = to, .whole = whole, .m = m};
    bool word = pattern[0] != '$' && from->kind == QDOT_TOKEN_NAME;

    *m = (qdot_pattern_match){.from = from, .to = from, .place = from};
    return match_pattern(&x, pattern, from) &&
           !(word && (qdot_names_find(session->names, from->text) != NULL || qdot_names_is_family(session->names, from->text)));
}

/* --- suggested lines ------------------------------------------------------------------ */

/* Whether the tokens contain + or - between operands, outside of brackets. */
static bool
contains_sum(const qdot_token *from, const qdot_token *to)
{
    int64_t depth = 0;

    for (const qdot_token *k = from; k < to; k++) {
        depth += qdot_token_bracket(k);
        if (depth == 0 && (qdot_token_is(k, "+") || qdot_token_is(k, "-")))
            return true;
    }
    return false;
}

static void
add_matched_text(const qdot_cursor *c, const qdot_pattern_match *m, size_t i, bool stripped,
                 qdot_text *out)
{
    const qdot_token *from = m->held[i].from, *to = m->held[i].to;
    const char *text = c->source->text + from->start;
    size_t length = to > from ? to[-1].start + to[-1].length - from->start : 0;

    if (m->held[i].kind == 'f') {
        qdot_text_add(out, qdot_foreign_word(from->text));
        return;
    }
    if (m->held[i].kind == 'm') {
        qdot_text_add(out, coordinate_of_momentum(c->session, from->text));
        return;
    }
    if (m->held[i].kind == 'd') {
        qdot_text_add(out, from->text + 1);
        return;
    }
    while (stripped && length > 0 && text[length - 1] == '_')
        length--;
    qdot_text_add_n(out, text, length);
}

/* Append a gravity field such as (0, -9.81), along the last axis of the scene's space. */
static void
add_field_vector(const qdot_cursor *c, const qdot_pattern_match *m, size_t i, qdot_text *out)
{
    const qdot_scene *s = c->session->scene;
    qdot_expr at = s->particles.n > 0 ? s->particles.at[0].position
                   : s->bodies.n > 0  ? s->bodies.at[0].position
                                      : QDOT_NIL;
    uint32_t n = at == QDOT_NIL ? 2
                 : qdot_expr_is_scalar(c->session->pool, at)
                     ? 1
                     : qdot_expr_count(c->session->pool, at);

    qdot_text_add(out, n == 1 ? "-" : n == 2 ? "(0, -" : "(0, 0, -");
    if (i < m->n)
        add_matched_text(c, m, i, false, out);
    else
        qdot_text_add(out,
                      qdot_names_find(c->session->names, "g") != NULL ? "g" : "9.81");
    qdot_text_add(out, n == 1 ? "" : ")");
}

/* The name of the coordinate that was declared first. */
static const char *
find_first_coordinate(const qdot_session *s)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(s->names, i)) != NULL; i++)
        if (name->kind == QDOT_NAME_COORD)
            return name->name;
    return "x";
}

/* The label of the particle, else of the body, that was declared first; bob where there is none. */
static const char *
find_first_label(const qdot_scene *scene)
{
    return scene->particles.n > 0 ? scene->particles.at[0].name : scene->bodies.n > 0 ? scene->bodies.at[0].name : "bob";
}

/* The first name of that kind among the matched tokens; NULL if there is none. */
static const char *
find_matched_name(const qdot_session *s, const qdot_pattern_match *m, qdot_name_kind kind)
{
    for (const qdot_token *k = m->from; k < m->to; k++) {
        const qdot_name *known = k->kind == QDOT_TOKEN_NAME ? qdot_names_find(s->names, k->text) : NULL;

        if (known != NULL && known->kind == kind)
            return known->name;
    }
    return NULL;
}

/* A coordinate in the definition of a matched name; NULL if there is none. */
static const char *
coordinate_in_definition(const qdot_session *s, const qdot_pattern_match *m)
{
    for (const qdot_token *k = m->from; k < m->to; k++) {
        const qdot_name *known = k->kind == QDOT_TOKEN_NAME ? qdot_names_find(s->names, k->text) : NULL;

        if (known == NULL || known->kind != QDOT_NAME_VALUE)
            continue;
        for (size_t i = 0; i < s->scene->coordinates.n; i++)
            if (qdot_expr_contains(s->pool, known->value, s->scene->coordinates.at[i]))
                return qdot_expr_symbol(s->pool, s->scene->coordinates.at[i])->name;
    }
    return NULL;
}

/* The unknown of a matched equation: a coordinate in it, else a parameter, else the first coordinate. */
static const char *
unknown_of_equation(const qdot_session *s, const qdot_pattern_match *m)
{
    const char *name = find_matched_name(s, m, QDOT_NAME_COORD);

    if (name == NULL)
        name = coordinate_in_definition(s, m);
    if (name == NULL)
        name = find_matched_name(s, m, QDOT_NAME_PARAM);
    return name != NULL ? name : find_first_coordinate(s);
}

/* Append the text of the placeholder `$...` at `line`; returns the position after it. */
static const char *
add_placeholder(const qdot_cursor *c, const char *line, const qdot_pattern_match *m,
                qdot_text *out)
{
    bool factor = line[1] == '(', stripped = line[1] == '-', declared = line[1] == '$';
    size_t skip = factor || stripped || declared;
    size_t i = (size_t)(line[1 + skip] - '1');
    const qdot_name *name;

    if (line[1] == 'q' || line[1] == 'x') {
        qdot_text_add(out, line[1] == 'x' ? unknown_of_equation(c->session, m) : find_first_coordinate(c->session));
        return line + 2;
    }
    if (line[1] == 'b') {
        qdot_text_add(out, find_first_label(c->session->scene));
        return line + 2;
    }
    if (line[1] == 'g') {
        skip = line[2] >= '1' && line[2] <= '9';
        add_field_vector(c, m, skip ? (size_t)(line[2] - '1') : QDOT_PATTERN_HELD, out);
        return line + 2 + skip;
    }
    if (line[1] == 'r') {
        const qdot_session *s = c->session;

        qdot_text_add(out, s->runs->n > 0 ? s->runs->at[s->runs->n - 1].name : "run1");
        return line + 2;
    }
    if (i >= m->n)
        return line + 2 + skip + factor;
    factor = factor && contains_sum(m->held[i].from, m->held[i].to);
    name = declared ? qdot_names_find(c->session->names, m->held[i].from->text) : NULL;
    if (declared)
        qdot_text_add(out,
                      name != NULL && name->kind == QDOT_NAME_PARAM ? "set " : "param ");
    qdot_text_add(out, factor ? "(" : "");
    add_matched_text(c, m, i, stripped, out);
    qdot_text_add(out, factor ? ")" : "");
    return line + 2 + skip + (line[1] == '(');
}

void
qdot_pattern_write(const qdot_cursor *c, const char *line, const qdot_pattern_match *m,
                   qdot_text *out)
{
    while (*line != '\0') {
        if (*line == '$')
            line = add_placeholder(c, line, m, out);
        else if (*line == ' ' &&
                 (line[1] == '\0' || (out->n > 0 && out->at[out->n - 1] == ' ')))
            line++; /* skip the blank beside a placeholder whose text is empty */
        else
            qdot_text_char(out, *line++);
    }
    while (out->n > 0 && out->at[out->n - 1] == ' ')
        qdot_text_truncate(out, out->n - 1);
}
