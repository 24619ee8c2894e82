/* match.c -- the tokens of a statement, read by the usage of its row.
 *
 * The usage is followed as a nondeterministic automaton. A place is a node that may come next; each
 * knows the place before it, so the alternative that reaches the end tells which node every part
 * was.
 */
#include "lang/syntax/match.h"

#include <string.h>

#include "lang/functions/builtin.h"
#include "lang/language/formals.h"
#include "lang/syntax/expected.h"
#include "lang/syntax/holes.h"

typedef struct {
    int node;
    uint32_t from;  /* the place of the part before */
    uint64_t taken; /* options */
} place;

typedef struct {
    const qdot_usage *u;
    qdot_record *r;
    qdot_cursor *c;
    qdot_vec(place) places;
    size_t first; /* of those at the present token */
} matcher;

/* --- places -------------------------------------------------------------------------- */

/* Add everything that may come at the node to the current positions. */
static qdot_status
match_add_place(matcher *m, int node, uint32_t from, uint64_t taken)
{
    const qdot_usage_node *at = &m->u->node[node];

    for (size_t i = m->first; i < m->places.n; i++)
        if (m->places.at[i].node == node && m->places.at[i].taken == taken)
            return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&m->places, ((place){node, from, taken})));
    if (at->kind != QDOT_USAGE_FORK)
        return QDOT_OK;
    taken &= ~at->forgets;
    if ((taken & at->enters) == 0)
        QDOT_TRY(match_add_place(m, at->next, from, taken | at->enters));
    return at->other >= 0 ? match_add_place(m, at->other, from, taken) : QDOT_OK;
}

static const qdot_usage_node *
place_node(const matcher *m, size_t i)
{
    return &m->u->node[m->places.at[i].node];
}

static qdot_hole_class
node_class(const qdot_usage_node *node)
{
    return qdot_hole_at(node->hole)->class;
}

/* Whether the token is the word or sign of the node. */
static bool
node_is_token(const qdot_usage_node *node, const qdot_token *token)
{
    return (node->kind == QDOT_USAGE_WORD && qdot_token_is_word(token, node->text)) ||
           (node->kind == QDOT_USAGE_SIGN && qdot_token_is(token, node->text));
}

/* Whether the token is a sign or word that may come at the node. */
static bool
leads_to(const qdot_usage *u, int node, const qdot_token *token)
{
    const qdot_usage_node *at = &u->node[node];

    if (at->kind != QDOT_USAGE_FORK)
        return node_is_token(at, token);
    return leads_to(u, at->next, token) || (at->other >= 0 && leads_to(u, at->other, token));
}

/* The token after the name that begins at t, including its index. */
static const qdot_token *
behind_name(const qdot_token *t)
{
    long depth = 0;

    t++;
    if (!t->glued || !qdot_token_is(t, "["))
        return t;
    for (; t->kind != QDOT_TOKEN_END; t++) {
        depth += qdot_token_bracket(t);
        if (depth == 0)
            return t + 1;
    }
    return t;
}

/* --- one hole ------------------------------------------------------------------------ */

static qdot_status
read_expression(matcher *m, qdot_parse_extent extent, qdot_filled *part)
{
    qdot_compiled one;
    qdot_status status = qdot_compiled_parse(m->c, extent, &one);

    if (status == QDOT_OK)
        status = qdot_vec_push(&m->r->compiled, one);
    if (status != QDOT_OK)
        qdot_compiled_free(&one);
    part->n += status == QDOT_OK;
    return status;
}

/* Read name or name[i, j], with primes if it is a coordinate. */
static qdot_status
read_name(matcher *m, const qdot_hole *hole, qdot_filled *part)
{
    qdot_cursor *c = m->c;

    if (c->at->kind != QDOT_TOKEN_NAME)
        return qdot_cursor_expected(c, hole->expected);
    part->name = c->at++;
    if (c->at->glued && qdot_cursor_accept_op(c, "[")) {
        do
            QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
        while (qdot_cursor_accept_op(c, ","));
        QDOT_TRY(qdot_cursor_expect_op(c, "]"));
    }
    part->primes = c->at;
    if (hole->class == QDOT_HOLE_COORDINATE)
        while (c->at->glued && qdot_cursor_accept_op(c, "'"))
            continue;
    return QDOT_OK;
}

/* --- a new name with its bounds ------------------------------------------------------ */

static bool
is_relation(const qdot_token *t)
{
    return t->kind == QDOT_TOKEN_OPERATOR && strchr("<>", t->text[0]) != NULL;
}

/* Whether the name is declared, or was given earlier in the statement. */
static bool
is_declared(const matcher *m, const char *name)
{
    for (size_t i = 0; i < m->r->parts.n; i++)
        if (m->r->parts.at[i].name != NULL && strcmp(m->r->parts.at[i].name->text, name) == 0)
            return true;
    return qdot_names_find(m->c->session->names, name) != NULL;
}

/* Whether a bound stands before the name: a number, a sign, a bracket, a call, or a name that is
 * declared and followed by one that is not. */
static bool
begins_with_bound(const matcher *m)
{
    const qdot_token *t = m->c->at, *next = behind_name(t);
    const bool more = next->kind != QDOT_TOKEN_END && !qdot_token_is(next, ",") && !qdot_token_is(next, "=");

    if (t->kind != QDOT_TOKEN_NAME)
        return true;
    if (strcmp(t->text, "pi") == 0) /* alone it is a name, which is refused */
        return more && (!is_relation(next) || next[1].kind == QDOT_TOKEN_NAME);
    if (!is_declared(m, t->text))
        return qdot_token_is(t + 1, "(") && qdot_builtin_find(t->text) != NULL;
    if (!is_relation(next))
        return more;
    return next[1].kind == QDOT_TOKEN_NAME && strcmp(next[1].text, "pi") != 0 &&
           !is_declared(m, next[1].text);
}

/* name, LO < name, name > LO, LO < name < HI */
static qdot_status
read_domain(matcher *m, const qdot_hole *hole, qdot_filled *part)
{
    qdot_cursor *c = m->c;
    const qdot_token *first = c->at;

    if (first->kind != QDOT_TOKEN_NAME && first->kind != QDOT_TOKEN_NUMBER &&
        (first->kind != QDOT_TOKEN_OPERATOR ||
         (strchr("-+(", first->text[0]) == NULL && strcmp(first->text, "sqrt") != 0)))
        return qdot_cursor_expected(c, hole->expected);
    if (begins_with_bound(m)) {
        QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
        if (!is_relation(c->at)) {
            c->at = first;
            return qdot_cursor_expected(c, hole->expected);
        }
        c->at++;
    }
    QDOT_TRY(read_name(m, hole, part));
    while (is_relation(c->at)) {
        c->at++;
        QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    }
    return QDOT_OK;
}

/* --- a hole -------------------------------------------------------------------------- */

/* Where what is read of the part so far is a name that means nothing, or that of a function without
 * its argument, that is told. */
static qdot_status
tell_unknown(matcher *m, const qdot_filled *part)
{
    const qdot_token *name = part->from;
    qdot_expr value;

    return m->c->at == name + 1 && name->kind == QDOT_TOKEN_NAME &&
                   (!qdot_cursor_knows(m->c->session, name->text) || qdot_builtin_find(name->text) != NULL)
               ? qdot_compiled_value(m->c, &m->r->compiled.at[part->first], &value)
               : QDOT_OK;
}

/* Read SIDE = SIDE, or the name of an equation; for a comparison any relation. */
static qdot_status
read_equation(matcher *m, const qdot_usage_node *node, qdot_filled *part)
{
    const bool comparison = node_class(node) == QDOT_HOLE_COMPARISON;
    qdot_cursor *c = m->c;

    QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    if (qdot_token_is(c->at, "=") || qdot_token_is(c->at, "==") || (comparison && is_relation(c->at))) {
        c->at++;
        return read_expression(m, QDOT_PARSE_SIDE, part);
    }
    if (qdot_cursor_is_end(c) || leads_to(m->u, node->next, c->at))
        return QDOT_OK;
    if (comparison)
        QDOT_TRY(tell_unknown(m, part));
    return qdot_cursor_expected(c, comparison ? "`==` and the other side" : "`=` and the other side");
}

/* Read SIDE = SIDE, or `returns after SIDE`. */
static qdot_status
read_one_condition(matcher *m, const qdot_hole *hole, qdot_filled *part)
{
    qdot_cursor *c = m->c;

    if (qdot_cursor_is_end(c) || qdot_cursor_is_op(c, ",") || qdot_cursor_is_word(c, "and"))
        return qdot_cursor_expected(c, hole->expected);
    if (qdot_cursor_accept_word(c, "returns")) {
        if (!qdot_cursor_accept_word(c, "after"))
            return qdot_cursor_expected(c, "`after` and a time: `returns after T`");
        return read_expression(m, QDOT_PARSE_SIDE, part);
    }
    QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    if (!qdot_cursor_accept_op(c, "=") && !qdot_cursor_accept_op(c, "=="))
        return qdot_cursor_expected(c, "`=`: a condition is an equation");
    return read_expression(m, QDOT_PARSE_SIDE, part);
}

/* Read (SIDE, SIDE, ...) with as many components as the usage names. */
static qdot_status
read_tuple(matcher *m, const char *names, qdot_filled *part)
{
    QDOT_TRY(qdot_cursor_expect_op(m->c, "("));
    QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    for (const char *k = strchr(names, ','); k != NULL; k = strchr(k + 1, ',')) {
        QDOT_TRY(qdot_cursor_expect_op(m->c, ","));
        QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    }
    return qdot_cursor_expect_op(m->c, ")");
}

/* SIDE..SIDE */
static qdot_status
read_range(matcher *m, const qdot_hole *hole, qdot_filled *part)
{
    QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    if (qdot_cursor_accept_op(m->c, ".."))
        return read_expression(m, QDOT_PARSE_SIDE, part);
    QDOT_TRY(tell_unknown(m, part));
    return qdot_cursor_expected(m->c, hole->expected);
}

static qdot_status
read_call(matcher *m, const qdot_hole *hole, qdot_filled *part)
{
    const qdot_token **names = NULL;
    qdot_status status;
    size_t n;

    QDOT_TRY(read_name(m, hole, part));
    status = qdot_formals_read_names(m->c, &names, &n);
    qdot_free(names);
    return status;
}

/* Read an expression in which the arguments of the call before it hide other names. */
static qdot_status
read_body(matcher *m, qdot_filled *part)
{
    const qdot_filled *call = &m->r->parts.at[m->r->parts.n - 2]; /* before `=` */
    qdot_formals f;
    qdot_status status = qdot_record_formals(m->r, call, &f);

    if (status == QDOT_OK)
        status = qdot_formals_enter(m->c->session, &f);
    if (status == QDOT_OK)
        status = read_expression(m, QDOT_PARSE_VALUE, part);
    qdot_formals_leave(m->c->session, &f);
    return status;
}

static qdot_status
read_text(matcher *m, const qdot_usage_node *node)
{
    if (m->c->at->kind == QDOT_TOKEN_NAME && strcmp(node->before, "title") == 0) { /* title The pendulum */
        m->c->error_at = m->c->at->start;
        return qdot_fail(QDOT_ESYNTAX, "`%s` needs a text in quotes", node->before);
    }
    if (m->c->at->kind != QDOT_TOKEN_STRING)
        return qdot_cursor_expected(m->c, qdot_hole_at(node->hole)->expected);
    m->c->at++;
    return QDOT_OK;
}

static qdot_status
read_token(matcher *m, const qdot_hole *hole, qdot_token_kind kind)
{
    if (m->c->at->kind != kind)
        return qdot_cursor_expected(m->c, hole->expected);
    m->c->at++;
    return QDOT_OK;
}

/* Whether a hole of this class can begin with the token, where several nodes are possible. */
static bool
class_suits(const matcher *m, const qdot_usage_node *node)
{
    const qdot_token *t = m->c->at;

    switch (node_class(node)) {
    case QDOT_HOLE_TEXT: return t->kind == QDOT_TOKEN_STRING;
    case QDOT_HOLE_NAME:
        return t->kind == QDOT_TOKEN_NAME && leads_to(m->u, node->next, behind_name(t));
    case QDOT_HOLE_CALL: return t->kind == QDOT_TOKEN_NAME && qdot_token_is(t + 1, "(");
    case QDOT_HOLE_COORDINATE: return t->kind == QDOT_TOKEN_NAME && !qdot_token_is(t + 1, "(");
    case QDOT_HOLE_WORD: return t->kind == QDOT_TOKEN_NAME;
    case QDOT_HOLE_TOPIC:
        return t->kind == QDOT_TOKEN_NAME || t->kind == QDOT_TOKEN_STRING || qdot_token_is(t, "%");
    default: return t->kind != QDOT_TOKEN_STRING;
    }
}

/* Whether `to "FILE"`, which should follow the value or name of the hole, is in its place. */
static bool
is_file_in_place(const matcher *m, const qdot_usage_node *node)
{
    const qdot_token *t = m->c->at;

    return (node_class(node) == QDOT_HOLE_VALUE || node_class(node) == QDOT_HOLE_COORDINATE) &&
           qdot_token_is_word(t, "to") &&
           t[1].kind == QDOT_TOKEN_STRING && leads_to(m->u, node->next, t);
}

static qdot_status
read_hole(matcher *m, const qdot_usage_node *node, qdot_filled *part)
{
    const qdot_hole *hole = qdot_hole_at(node->hole);

    if (is_file_in_place(m, node) || (qdot_cursor_is_end(m->c) && strcmp(hole->expected, "an expression") != 0))
        return qdot_cursor_expected(m->c, hole->expected);
    switch (hole->class) {
    case QDOT_HOLE_SIDE: return read_expression(m, QDOT_PARSE_SIDE, part);
    case QDOT_HOLE_VALUE: return read_expression(m, QDOT_PARSE_VALUE, part);
    case QDOT_HOLE_CONDITION:
        do
            QDOT_TRY(read_one_condition(m, hole, part));
        while (qdot_cursor_accept_word(m->c, "and"));
        return QDOT_OK;
    case QDOT_HOLE_EQUATION:
    case QDOT_HOLE_COMPARISON: return read_equation(m, node, part);
    case QDOT_HOLE_RANGE: return read_range(m, hole, part);
    case QDOT_HOLE_VALUES:
        QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
        return qdot_cursor_accept_op(m->c, "..") ? read_expression(m, QDOT_PARSE_SIDE, part) : QDOT_OK;
    case QDOT_HOLE_TUPLE: return read_tuple(m, node->text, part);
    case QDOT_HOLE_NAME:
    case QDOT_HOLE_COORDINATE: return read_name(m, hole, part);
    case QDOT_HOLE_DOMAIN: return read_domain(m, hole, part);
    case QDOT_HOLE_CALL: return read_call(m, hole, part);
    case QDOT_HOLE_BODY: return read_body(m, part);
    case QDOT_HOLE_WORD: return read_token(m, hole, QDOT_TOKEN_NAME);
    case QDOT_HOLE_TOPIC:
        return read_token(m, hole, class_suits(m, node) ? m->c->at->kind : QDOT_TOKEN_NAME);
    default: return read_text(m, node);
    }
}

/* --- which hole ---------------------------------------------------------------------- */

/* The hole to be read at the token; NULL: none is possible here. */
static const qdot_usage_node *
hole_choose(const matcher *m)
{
    const qdot_usage_node *found = NULL;
    bool several = false;

    for (size_t i = m->first; i < m->places.n; i++) {
        const qdot_usage_node *node = place_node(m, i);

        if (node->kind != QDOT_USAGE_HOLE)
            continue;
        several = several || (found != NULL && node_class(found) != node_class(node));
        found = node;
    }
    if (!several)
        return found;
    for (size_t i = m->first; i < m->places.n; i++)
        if (place_node(m, i)->kind == QDOT_USAGE_HOLE && class_suits(m, place_node(m, i)))
            return place_node(m, i);
    return found;
}

/* --- the statement ------------------------------------------------------------------- */

/* Record the part, and advance from the positions whose node matches it: the token, or a hole of that class. */
static qdot_status
go_on(matcher *m, const qdot_filled *part, const qdot_usage_node *hole)
{
    const size_t first = m->first, n = m->places.n;

    QDOT_TRY(qdot_vec_push(&m->r->parts, *part));
    m->first = n;
    for (size_t i = first; i < n; i++) {
        const qdot_usage_node *node = place_node(m, i);

        if (hole != NULL ? node->kind != QDOT_USAGE_HOLE || node_class(node) != node_class(hole)
                         : !node_is_token(node, part->from))
            continue;
        m->r->parts.at[m->r->parts.n - 1].node = node; /* till the end tells which */
        QDOT_TRY(match_add_place(m, node->next, (uint32_t)i, m->places.at[i].taken));
    }
    return QDOT_OK;
}

/* Whether the token is a word of the usage and not a name of the session. */
static bool
is_usage_word(const matcher *m, const qdot_token *t)
{
    for (int i = 0; i < m->u->n; i++)
        if (m->u->node[i].kind == QDOT_USAGE_WORD && qdot_token_is_word(t, m->u->node[i].text))
            return !qdot_cursor_knows(m->c->session, t->text);
    return false;
}

/* Whether the token may be a factor whose `*` is missing: a value precedes it, and neither is a
 * word of the usage. */
static bool
may_be_factor(const matcher *m)
{
    const qdot_filled *last = m->r->parts.n > 0 ? &m->r->parts.at[m->r->parts.n - 1] : NULL;

    if (last == NULL || last->node == NULL || last->node->kind != QDOT_USAGE_HOLE ||
        is_usage_word(m, m->c->at) || (last->to == last->from + 1 && is_usage_word(m, last->from)))
        return false;
    switch (node_class(last->node)) {
    case QDOT_HOLE_SIDE:
    case QDOT_HOLE_VALUE:
    case QDOT_HOLE_VALUES:
    case QDOT_HOLE_RANGE:
    case QDOT_HOLE_BODY:
    case QDOT_HOLE_CONDITION:
    case QDOT_HOLE_EQUATION:
    case QDOT_HOLE_COMPARISON: return true;
    default: return false;
    }
}

/* Whether the last error reports a product without `*`. */
static bool
tells_product(void)
{
    return strcmp(qdot_last_error()->message, "a `*` is missing") == 0 ||
           strncmp(qdot_last_error()->hint, "a product ", 10) == 0;
}

/* Fail at the token: nothing in the usage fits it. */
static qdot_status
fail_at_token(matcher *m)
{
    qdot_expected list = {.usage = m->u, .token = m->c->at};
    char what[QDOT_EXPECTED_TEXT];
    const char *hint;
    qdot_status status;

    for (size_t i = m->first; i < m->places.n; i++)
        qdot_expected_add(&list, m->places.at[i].node, m->places.at[i].taken);
    m->c->error_at = m->c->at->start;
    if (list.given && !list.hole && qdot_record_word(m->r, m->c->at->text) != NULL)
        return qdot_fail(QDOT_EINVAL, "`%s` is given twice", m->c->at->text);
    if (qdot_expected_refuses(&list, m->r))
        return qdot_last_error()->status;
    hint = qdot_expected_words(&list, what);
    status = qdot_cursor_expected(m->c, what);
    if (tells_product() && (hint != NULL || !may_be_factor(m))) {
        m->c->error_at = m->c->at->start;
        status = qdot_fail(QDOT_ESYNTAX, "expected %s, found `%.100s`", what, m->c->at->text);
    }
    return hint != NULL && qdot_last_error()->hint[0] == '\0' ? qdot_hint("%s", hint) : status;
}

/* Whether the word has an operand, where a value of that name may stand too: `conserved E` and
 * `conserved[2]`, `help search energy` and `help search`. */
static bool
has_operand(const matcher *m, const qdot_token *word)
{
    const qdot_token *t = word + 1;

    return qdot_names_find(m->c->session->names, word->text) == NULL &&
           (t->kind == QDOT_TOKEN_NAME || t->kind == QDOT_TOKEN_NUMBER || t->kind == QDOT_TOKEN_STRING ||
            qdot_token_is(t, "(") || qdot_token_is(t, "-") || qdot_token_is(t, "sqrt"));
}

/* Whether the token is a word or sign that may come, and no name that the usage goes on behind: a
 * spring may be called `rest`. */
static bool
token_fits(const matcher *m)
{
    bool fits = false, named = false;

    for (size_t i = m->first; i < m->places.n; i++) {
        const qdot_usage_node *node = place_node(m, i);

        if (node->kind == QDOT_USAGE_HOLE && node_class(node) == QDOT_HOLE_NAME && class_suits(m, node))
            return false;
        named = named || (node->kind == QDOT_USAGE_HOLE && (node_class(node) == QDOT_HOLE_COMPARISON ||
                                                            node_class(node) == QDOT_HOLE_TOPIC));
        fits = fits || node_is_token(node, m->c->at);
    }
    return fits && (!named || has_operand(m, m->c->at));
}

static bool
may_end(const matcher *m)
{
    for (size_t i = m->first; i < m->places.n; i++)
        if (place_node(m, i)->kind == QDOT_USAGE_END)
            return true;
    return false;
}

static bool
is_at_end(const matcher *m)
{
    return qdot_cursor_is_end(m->c) && may_end(m);
}

static qdot_status
match_token(matcher *m, bool *end)
{
    qdot_filled part = {.from = m->c->at, .first = m->r->compiled.n};
    const qdot_usage_node *hole = NULL;

    *end = is_at_end(m);
    if (*end)
        return QDOT_OK;
    if (token_fits(m)) {
        m->c->at++;
    } else {
        hole = hole_choose(m);
        if (hole == NULL || (node_class(hole) == QDOT_HOLE_TOPIC && may_end(m) && !class_suits(m, hole)))
            return fail_at_token(m);
        QDOT_TRY(read_hole(m, hole, &part));
    }
    part.to = m->c->at;
    if (part.primes == NULL)
        part.primes = part.to;
    return go_on(m, &part, hole);
}

/* The first required clause that is not among those `taken`; NULL: none is missing. */
static const qdot_usage_node *
clause_missing(const qdot_usage *u, uint64_t taken)
{
    for (int i = 0; i < u->n; i++)
        if (u->node[i].needs != 0 && (u->node[i].needs & taken) == 0)
            return &u->node[u->node[i].next];
    return NULL;
}

/* Assign to the parts the nodes through which the end was reached. */
static qdot_status
trace_back(matcher *m)
{
    const qdot_usage_node *missing;
    uint32_t at = (uint32_t)m->first;

    while (place_node(m, at)->kind != QDOT_USAGE_END)
        at++;
    missing = clause_missing(m->u, m->places.at[at].taken);
    for (size_t k = m->r->parts.n; k-- > 0;) {
        at = m->places.at[at].from;
        m->r->parts.at[k].node = place_node(m, at);
    }
    if (missing == NULL)
        return QDOT_OK;
    if (qdot_expected_clause(m->u->word, missing->text) != NULL)
        return qdot_cursor_expected(m->c, qdot_expected_clause(m->u->word, missing->text));
    m->c->error_at = m->r->start->start;
    (void)qdot_fail(QDOT_ESYNTAX, "a %s needs `%s`", m->u->word, missing->text);
    return qdot_hint("%s", m->r->row->form != NULL ? m->r->row->form : m->r->row->usage);
}

/* Read tokens up to the end of the statement. */
static qdot_status
match_all(matcher *m, qdot_status status)
{
    bool end = false;

    while (status == QDOT_OK && !end)
        status = match_token(m, &end);
    if (status == QDOT_OK)
        status = trace_back(m);
    qdot_free(m->places.at);
    return status;
}

qdot_status
qdot_match(const qdot_cursor *c, const qdot_statement *row, const qdot_usage *u,
           qdot_record *record)
{
    matcher m = {.u = u, .r = record};

    *record = (qdot_record){.row = row, .cursor = *c, .start = c->at + 1};
    m.c = &record->cursor;
    return match_all(&m, match_add_place(&m, 0, 0, 0));
}

qdot_status
qdot_match_operands(const qdot_cursor *c, const qdot_statement *row, qdot_record *record)
{
    static const qdot_token none = {.kind = QDOT_TOKEN_NAME};
    qdot_token word = none;
    matcher m = {.r = record};
    qdot_status status;

    *record = (qdot_record){.row = row, .cursor = *c, .start = c->at};
    m.c = &record->cursor;
    record->usage = qdot_malloc(sizeof *record->usage);
    if (record->usage == NULL || !qdot_usage_compile(record->usage, row->word, row->usage))
        return QDOT_ENOMEM;
    m.u = record->usage;
    word.text = row->word;
    status = match_add_place(&m, 0, 0, 0);
    if (status == QDOT_OK)
        status = go_on(&m, &(qdot_filled){.from = &word, .to = &word, .primes = &word}, NULL);
    if (status == QDOT_OK)
        m.r->parts.at[0].from = m.r->parts.at[0].to = m.r->parts.at[0].primes = c->at;
    return match_all(&m, status);
}

qdot_status
qdot_match_operands_to(const qdot_cursor *c, const qdot_token *end, const qdot_statement *row,
                       qdot_record *record)
{
    qdot_token *const last = (qdot_token *)end;
    const uint8_t kind = last->kind;
    qdot_status status;

    last->kind = QDOT_TOKEN_END; /* meanwhile */
    status = qdot_match_operands(c, row, record);
    last->kind = kind;
    return status;
}

qdot_status
qdot_match_carry_out(qdot_cursor *c, const qdot_statement *row)
{
    qdot_record record;
    qdot_status status = qdot_match_operands(c, row, &record);

    if (status == QDOT_OK)
        status = row->handler(&record);
    c->at = record.cursor.at;
    c->error_at = record.cursor.error_at;
    qdot_record_free(&record);
    return status;
}
