/* hints.c -- suggestions for mistyped input: the nearest name, or the notation of this language. */
#include "lang/language/hints.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/spelling.h"
#include "expr/symbol.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/language/foreign-words.h"
#include "lang/session/labels.h"
#include "lang/session/names.h"
#include "mech/scene/scene.h"

/* --- the nearest of all known names ------------------------------------------------- */

/* Whether a value of the scene is one by its bare name: `p` alone, without [ ], is none. */
static bool
is_value_alone(const qdot_quantity *row)
{
    return row->least == 0;
}

const char *
qdot_hints_nearest(qdot_session *session, const char *name)
{
    qdot_words list = {0};
    const char *nearest;

    qdot_labels_add(session->scene, &list);
    for (size_t i = 0; qdot_quantity_at(i) != NULL; i++)
        if (is_value_alone(qdot_quantity_at(i)) || strchr(name, '[') != NULL)
            (void)qdot_vec_push(&list, qdot_quantity_at(i)->name); /* if memory runs out the hint lacks this word */
    for (size_t i = 0; qdot_builtin_at(i) != NULL; i++)
        if (!(qdot_builtin_at(i)->flags & QDOT_BUILTIN_SHORT))
            (void)qdot_vec_push(&list, qdot_builtin_at(i)->name);
    nearest = qdot_names_nearest(session->names, name, list.n, list.at);
    qdot_free(list.at);
    return nearest;
}

/* The nearest name of a function that takes n arguments (0: any number); NULL: there is none. */
static const char *
find_nearest_function(const qdot_session *session, const char *name, size_t n)
{
    const qdot_name *declared;
    qdot_spelling s;

    qdot_spelling_begin(&s, name);
    for (size_t i = 0; (declared = qdot_names_at(session->names, i)) != NULL; i++)
        if (declared->kind == QDOT_NAME_UFUN || declared->kind == QDOT_NAME_FUNCTION)
            qdot_spelling_offer(&s, declared->name);
    for (size_t i = 0; qdot_builtin_at(i) != NULL; i++) {
        const qdot_builtin *row = qdot_builtin_at(i);

        if (!(row->flags & QDOT_BUILTIN_SHORT) && (n == 0 || (n >= (size_t)row->least && (row->most < 0 || n <= (size_t)row->most))))
            qdot_spelling_offer(&s, row->name);
    }
    return s.best;
}

/* --- syntax of other systems -------------------------------------------------------- */

bool
qdot_hints_is_foreign(const qdot_session *session, const char *name)
{
    return !qdot_cursor_knows(session, name) && qdot_foreign_word(name) != NULL;
}

/* Copy the text inside the bracket that `open` begins; "..." if it is long. */
static void
copy_bracket_text(const qdot_cursor *c, const qdot_token *open, char *text, size_t size)
{
    const qdot_token *last = c->source->tokens.at + c->source->tokens.n - 1, *t = open;
    size_t from = open->start + open->length;
    int64_t depth = 0;

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

/* --- names of velocities -------------------------------------------------------------- */

/* Prefixes and endings by which users of other systems denote derivatives of a coordinate; longer
 * ones first. */
static const struct {
    const char *prefix, *ending, *primes;
    bool sure; /* such a name is almost always meant as a derivative */
} derivatives[] = {{"", "_ddot", "''", true}, {"", "_dot", "'", true}, {"", "ddot", "''", true},
                   {"", "dot", "'", true},    {"d", "_dt", "'", true}, {"d", "dt", "'", true},
                   {"", "_prime", "'", true}, {"", "prime", "'", true}, {"v_", "", "'", false},
                   {"v", "", "'", false},     {"", "_d", "'", false},  {"d", "", "'", false}};

bool
qdot_hints_derivative(const qdot_session *session, const char *name, bool sure, qdot_derivative_name *found)
{
    const qdot_names *names = session->names;

    for (size_t i = 0; i < sizeof derivatives / sizeof *derivatives; i++) {
        const size_t before = strlen(derivatives[i].prefix);
        const size_t around = before + strlen(derivatives[i].ending), n = strlen(name);
        const qdot_name *known;

        if (derivatives[i].sure != sure || n <= around || n - around >= sizeof found->base ||
            strncmp(name, derivatives[i].prefix, before) != 0 || !qdot_ends_in(name, derivatives[i].ending))
            continue;
        snprintf(found->base, sizeof found->base, "%.*s", (int)(n - around), name + before);
        found->primes = derivatives[i].primes;
        known = qdot_names_find(names, found->base);
        found->family = known == NULL;
        if (known != NULL ? sure || known->kind == QDOT_NAME_COORD : qdot_names_is_family(names, found->base))
            return true;
    }
    return false;
}

/* Give a hint for thetadot, thetaddot, v_theta if theta is a coordinate: write the derivative with primes. */
static bool
hint_at_primes(const qdot_cursor *c, const char *name, bool sure)
{
    qdot_derivative_name meant;

    if (!qdot_hints_derivative(c->session, name, sure, &meant))
        return false;
    (void)qdot_hint("write %s%s%s", meant.base, meant.family ? "[k]" : "", meant.primes);
    return true;
}

/* --- how it is declared --------------------------------------------------------------- */

enum { LONGEST_NAME = 60, MOST_ARGUMENTS = 4, CLEAR = 5 /* letters */ };

/* Give the hint `param NAME` or `coord NAME`; for a member x[3] with a loop over all members up to it. */
static qdot_status
hint_at_declaration(const qdot_token *token, const char *member, bool coordinate)
{
    const char *name = token->text, *open = member != NULL ? strchr(member, '[') : NULL;
    const int64_t k = open != NULL ? strtoll(open + 1, NULL, 10) : 0;

    if (strlen(name) > LONGEST_NAME)
        return QDOT_ENAME;
    if (open != NULL && strchr(open, ',') == NULL && coordinate)
        return qdot_hint("`coord %s[k] for k = %d..%" PRId64 "` declares coordinates", name, k > 0,
                         k > 0 ? k : 3);
    if (open != NULL && strchr(open, ',') == NULL)
        return qdot_hint("`param %s[k] for k = %d..%" PRId64 "` declares parameters, "
                         "`coord %s[k] for k = %d..%" PRId64 "` coordinates",
                         name, k > 0, k > 0 ? k : 3, name, k > 0, k > 0 ? k : 3);
    if (open != NULL)
        return qdot_hint("`%s %s` declares it", coordinate ? "coord" : "param", member);
    if (coordinate || (qdot_token_is(token + 1, "'") && token[1].glued))
        return qdot_hint("`coord %s` declares it", name);
    return qdot_hint("`param %s` declares a parameter, `coord %s` a coordinate", name, name);
}

/* The number of arguments of the call that `open` begins; 0 if they cannot be counted. */
static size_t
count_arguments(const qdot_token *open)
{
    size_t n = 1;
    int64_t depth = 0;

    for (const qdot_token *t = open; t->kind != QDOT_TOKEN_END; t++) {
        depth += qdot_token_bracket(t);
        n += depth == 1 && qdot_token_is(t, ",");
        if (depth == 0)
            return t == open + 1 ? 0 : n;
    }
    return 0;
}

/* Give the hint to declare `function NAME(s, u)`, or to define the function. */
static qdot_status
hint_at_function(const qdot_token *token)
{
    static const char *const formals[MOST_ARGUMENTS] = {"s", "s, u", "s, u, v", "s, u, v, w"};
    static const char *const bodies[MOST_ARGUMENTS] = {"s^2", "s*u", "s*u*v", "s*u*v*w"};
    const char *name = token->text;
    const size_t n = count_arguments(token + 1);

    if (strlen(name) > LONGEST_NAME || n < 1 || n > MOST_ARGUMENTS)
        return QDOT_ENAME;
    return qdot_hint("define it, as in `%s(%s) = %s`; `function %s(%s)` declares an undefined one",
                     name, formals[n - 1], bodies[n - 1], name, formals[n - 1]);
}

/* --- errors for unknown names ------------------------------------------------------- */

/* Give the hint for p, Q, delta, lambda without [ ]: a member that the scene has, else how the name is declared. */
static qdot_status
hint_at_member(const qdot_session *session, const char *name)
{
    const qdot_scene *scene = session->scene;

    if (strcmp(name, "lambda") == 0) {
        if (scene->constraints.n > 0)
            return qdot_hint("write lambda[%.60s]", scene->constraints.at[0].name);
    } else if (scene->coordinates.n > 0) {
        return qdot_hint("write %s[%.60s]", name, qdot_expr_symbol(session->pool, scene->coordinates.at[0])->name);
    }
    return qdot_hint("`param %s` declares a parameter", name);
}

/* Whether the statement of the token holds a value whose answer has names of its own: S, the constant E and others. */
static bool
is_beside_separation(const qdot_cursor *c, const qdot_token *token)
{
    static const char *const words[] = {"hamilton_jacobi", "complete_integral", "action"};
    const qdot_token *t = token;

    while (t > c->source->tokens.at && t[-1].kind != QDOT_TOKEN_END && !qdot_token_is(t - 1, ";"))
        t--;
    for (; t->kind != QDOT_TOKEN_END && !qdot_token_is(t, ";"); t++)
        for (size_t i = 0; i < sizeof words / sizeof *words; i++)
            if (qdot_token_is_word(t, words[i]))
                return true;
    return false;
}

static qdot_status
hint_unknown_name(qdot_cursor *c, const qdot_token *token, const char *member, bool coordinate)
{
    const char *name = token->text, *nearest, *ours;
    const qdot_builtin *row;
    char text[100];

    qdot_fail(QDOT_ENAME, "unknown name `%.200s`", member != NULL ? member : name);
    if (qdot_token_is(token + 1, "[") && token[1].glued) {
        ours = qdot_foreign_word(name);
        if (ours != NULL) {
            copy_bracket_text(c, token + 1, text, sizeof text);
            return qdot_hint("write %s(%s)", ours, text);
        }
    }
    if (hint_at_primes(c, name, true))
        return QDOT_ENAME;
    if (strcmp(name, "e") == 0 && qdot_token_is(token + 1, "^"))
        return qdot_hint("the exponential function is exp(x)");
    if (strcmp(name, "Pi") == 0 || strcmp(name, "PI") == 0)
        return qdot_hint("write pi");
    if (member == NULL && (strcmp(name, "p") == 0 || strcmp(name, "Q") == 0 ||
                           strcmp(name, "delta") == 0 || strcmp(name, "lambda") == 0))
        return hint_at_member(c->session, name);
    row = member == NULL && !coordinate ? qdot_builtin_find(name) : NULL;
    if (row != NULL && name[1] != '\0') /* a function whose name may be taken, as `rate` */
        return qdot_hints_bare_function(c, token);
    if (member == NULL && !coordinate && is_beside_separation(c, token))
        return qdot_hint("`param %.60s` declares it", name);
    nearest = coordinate ? qdot_names_nearest(c->session->names, member != NULL ? member : name, 0, NULL)
                         : qdot_hints_nearest(c->session, member != NULL ? member : name);
    if (nearest != NULL && strlen(name) < CLEAR && qdot_builtin_find(nearest) != NULL &&
        qdot_names_find(c->session->names, nearest) == NULL)
        nearest = NULL; /* a short name is rarely a misspelt function */
    if ((nearest == NULL || strstr(name, nearest) != NULL) && hint_at_primes(c, name, false))
        return QDOT_ENAME;
    if (nearest != NULL)
        return qdot_hint("did you mean `%s`?", nearest);
    if (member == NULL && name[0] == 'd' && name[1] != '\0' && qdot_token_is(token + 1, "^"))
        return qdot_hint("`coord %s` declares %s and its differential %s", name + 1, name + 1, name);
    return hint_at_declaration(token, member, coordinate);
}

qdot_status
qdot_hints_unknown(qdot_cursor *c, const qdot_token *token, const char *member)
{
    return hint_unknown_name(c, token, member, false);
}

qdot_status
qdot_hints_unknown_coordinate(qdot_cursor *c, const qdot_token *token, const char *member)
{
    return hint_unknown_name(c, token, member, true);
}

qdot_status
qdot_hints_unknown_run(const char *name)
{
    (void)qdot_fail(QDOT_ENAME, "there is no run `%s`", name);
    return qdot_hint("`a.theta` is theta along the run a; a product is written a*theta");
}

qdot_status
qdot_hints_unknown_function(qdot_cursor *c, const qdot_token *token)
{
    const char *name = token->text, *ours = qdot_foreign_word(name), *nearest;
    char text[100];

    qdot_fail(QDOT_ENAME, "unknown function `%.200s`", name);
    if (ours != NULL && qdot_token_is(token + 1, "(")) {
        const qdot_builtin *row = qdot_builtin_find(ours);
        const int n = (int)count_arguments(token + 1);

        if (row != NULL && n > 0 && (n < row->least || (row->most >= 0 && n > row->most)))
            return qdot_hint("as in %s", row->usage);
        copy_bracket_text(c, token + 1, text, sizeof text);
        return qdot_hint("write %s(%s)", ours, text);
    }
    if (strcmp(name, "pow") == 0)
        return qdot_hint("a power is written a^b");
    if (strcmp(name, "S") == 0 && is_beside_separation(c, token)) {
        copy_bracket_text(c, token + 1, text, sizeof text);
        return qdot_hint("`function S(%s)` declares it", text);
    }
    nearest = find_nearest_function(c->session, name, count_arguments(token + 1));
    if (nearest != NULL)
        return qdot_hint("did you mean `%s`?", nearest);
    return hint_at_function(token);
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
        copy_bracket_text(c, next + 2, text, sizeof text);
        return qdot_hint("write %s(%s)^%.40s", name, text, next[1].text);
    }
    if (qdot_token_is(next, "[")) {
        copy_bracket_text(c, next, text, sizeof text);
        return qdot_hint("write %s(%s)", name, text);
    }
    if (qdot_builtin_find(name)->least <= 1 &&
        (next->kind == QDOT_TOKEN_NUMBER ||
         (next->kind == QDOT_TOKEN_NAME && qdot_cursor_knows(c->session, next->text)))) {
        const size_t to = qdot_cursor_operand_end(c, next);

        if (to == next->start + next->length) /* for one token take its text, in which a Greek letter is spelled: theta for θ */
            return qdot_hint("write %s(%.80s)", name, next->text);
        if (to - next->start <= 80)
            return qdot_hint("write %s(%.*s)", name, (int)(to - next->start), c->source->text + next->start);
    }
    return qdot_hint("as in %s", qdot_builtin_find(name)->usage);
}
