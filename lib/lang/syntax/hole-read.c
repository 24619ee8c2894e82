/* hole-read.c -- parses the tokens of a hole (a placeholder of a usage text) as its class says. */
#include "lang/syntax/hole-read.h"

#include <string.h>

#include "lang/functions/builtin.h"
#include "lang/language/units.h"
#include "lang/session/row-tables.h"
#include "lang/syntax/holes.h"

typedef struct {
    const qdot_usage *u;
    qdot_record *r;
    qdot_cursor *c;
} reader;

static qdot_hole_class
placeholder_class(const qdot_usage_node *node)
{
    return qdot_hole_at(node->hole)->class;
}

bool
qdot_usage_node_is(const qdot_usage_node *node, const qdot_token *token)
{
    return (node->kind == QDOT_USAGE_WORD && qdot_token_is_word(token, node->text)) ||
           (node->kind == QDOT_USAGE_SIGN && qdot_token_is(token, node->text));
}

/* Whether the token is a sign or word that may come after this node of the usage automaton. */
static bool
may_be_followed_by(const qdot_usage *u, int node, const qdot_token *token)
{
    const qdot_usage_node *at = &u->node[node];

    if (at->kind != QDOT_USAGE_FORK)
        return qdot_usage_node_is(at, token);
    return may_be_followed_by(u, at->next, token) || (at->other >= 0 && may_be_followed_by(u, at->other, token));
}

/* --- parsing one hole ---------------------------------------------------------------- */

/* If it was parsed with QDOT_OK, keep it as the next expression of the part; else free it. */
static qdot_status
keep_compiled(const reader *m, qdot_status status, qdot_compiled *one, qdot_filled *part)
{
    if (status == QDOT_OK)
        status = qdot_vec_push(&m->r->compiled, *one);
    if (status != QDOT_OK)
        qdot_compiled_free(one);
    part->n += status == QDOT_OK;
    return status;
}

static qdot_status
read_expression(const reader *m, qdot_parse_extent extent, qdot_filled *part)
{
    qdot_compiled one;
    const qdot_status status = qdot_compiled_parse(m->c, extent, &one);

    return keep_compiled(m, status, &one, part);
}

/* Parse name or name[i, j], with primes if it is a coordinate. */
static qdot_status
read_name(const reader *m, const qdot_hole *hole, qdot_filled *part)
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

/* Whether the name is declared, or occurs earlier in the statement. */
static bool
is_declared(const reader *m, const char *name)
{
    for (size_t i = 0; i < m->r->parts.n; i++)
        if (m->r->parts.at[i].name != NULL && strcmp(m->r->parts.at[i].name->text, name) == 0)
            return true;
    return qdot_names_find(m->c->session->names, name) != NULL;
}

/* Whether a bound stands before the name: a number, a sign, a bracket, a call, or a name that is
 * declared and followed by one that is not. */
static bool
begins_with_bound(const reader *m)
{
    const qdot_token *t = m->c->at, *next = qdot_token_behind_index(t);
    const bool more = next->kind != QDOT_TOKEN_END && !qdot_token_is(next, ",") && !qdot_token_is(next, "=") &&
                      !qdot_token_is(next, "["); /* a unit */

    if (t->kind != QDOT_TOKEN_NAME)
        return true;
    if (strcmp(t->text, "pi") == 0) /* `pi` alone is read as a name and refused later */
        return more && (!is_relation(next) || next[1].kind == QDOT_TOKEN_NAME);
    if (!is_declared(m, t->text))
        return qdot_token_is(t + 1, "(") && qdot_builtin_find(t->text) != NULL;
    if (!is_relation(next))
        return more;
    return next[1].kind == QDOT_TOKEN_NAME && strcmp(next[1].text, "pi") != 0 &&
           !is_declared(m, next[1].text);
}

/* Parse a unit behind a new name. */
static qdot_status
read_unit(const reader *m, qdot_filled *part)
{
    qdot_compiled one = {.from = m->c->at};
    const qdot_status status = qdot_unit_parse_alone(m->c, &one.code);

    one.to = m->c->at;
    return keep_compiled(m, status, &one, part);
}

/* Parse a new name with bounds: name, LO < name, name > LO, LO < name < HI. */
static qdot_status
read_domain(const reader *m, const qdot_hole *hole, qdot_filled *part)
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
    return qdot_token_is(c->at, "[") ? read_unit(m, part) : QDOT_OK;
}

/* --- parsing a hole by its class ----------------------------------------------------- */

/* Where what is read of the part so far is a name that means nothing, or that of a function without
 * its argument, that is told. */
static qdot_status
report_unknown_name(const reader *m, const qdot_filled *part)
{
    const qdot_token *name = part->from;
    qdot_expr value;

    return m->c->at == name + 1 && name->kind == QDOT_TOKEN_NAME &&
                   (!qdot_cursor_knows(m->c->session, name->text) || qdot_builtin_find(name->text) != NULL)
               ? qdot_compiled_value(m->c, &m->r->compiled.at[part->first], &value)
               : QDOT_OK;
}

/* Parse SIDE = SIDE, or an equation given by name; for a comparison any relation, also `~`. */
static qdot_status
read_equation(const reader *m, const qdot_usage_node *node, qdot_filled *part)
{
    const bool comparison = placeholder_class(node) == QDOT_HOLE_COMPARISON;
    qdot_cursor *c = m->c;

    QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    if (qdot_token_is(c->at, "=") || qdot_token_is(c->at, "==") ||
        (comparison && (is_relation(c->at) || qdot_token_is(c->at, "~")))) {
        c->at++;
        return read_expression(m, QDOT_PARSE_SIDE, part);
    }
    if (qdot_cursor_is_end(c) || may_be_followed_by(m->u, node->next, c->at))
        return QDOT_OK;
    if (comparison)
        QDOT_TRY(report_unknown_name(m, part));
    return qdot_cursor_expected(c, comparison ? "`==` and the other side" : "`=` and the other side");
}

/* Parse SIDE behind `returns after`. */
static qdot_status
read_period(const reader *m, qdot_filled *part)
{
    QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    m->r->compiled.at[m->r->compiled.n - 1].is_period = true;
    return QDOT_OK;
}

/* Parse one condition: SIDE = SIDE, or `returns after SIDE`. */
static qdot_status
read_one_condition(const reader *m, const qdot_hole *hole, qdot_filled *part)
{
    qdot_cursor *c = m->c;

    if (qdot_cursor_is_end(c) || qdot_cursor_is_op(c, ",") || qdot_cursor_is_word(c, "and"))
        return qdot_cursor_expected(c, hole->expected);
    if (qdot_cursor_accept_word(c, "returns")) {
        if (!qdot_cursor_accept_word(c, "after"))
            return qdot_cursor_expected(c, "`after` and a time: `returns after T`");
        return read_period(m, part);
    }
    QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    if (!qdot_cursor_accept_op(c, "=") && !qdot_cursor_accept_op(c, "=="))
        return qdot_cursor_expected(c, "`=`: a condition is an equation");
    return read_expression(m, QDOT_PARSE_SIDE, part);
}

/* Parse conditions joined by `and`; period: the first one begins behind `returns after`. */
static qdot_status
read_condition_list(const reader *m, const qdot_hole *hole, bool period, qdot_filled *part)
{
    QDOT_TRY(period ? read_period(m, part) : read_one_condition(m, hole, part));
    while (qdot_cursor_accept_word(m->c, "and"))
        QDOT_TRY(read_one_condition(m, hole, part));
    return QDOT_OK;
}

/* Parse a tuple (SIDE, SIDE) with as many components as the usage names. */
static qdot_status
read_tuple(const reader *m, const char *names, qdot_filled *part)
{
    QDOT_TRY(qdot_cursor_expect_op(m->c, "("));
    QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    for (const char *k = strchr(names, ','); k != NULL; k = strchr(k + 1, ',')) {
        QDOT_TRY(qdot_cursor_expect_op(m->c, ","));
        QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    }
    return qdot_cursor_expect_op(m->c, ")");
}

/* Parse a range SIDE..SIDE. */
static qdot_status
read_range(const reader *m, const qdot_hole *hole, qdot_filled *part)
{
    QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    if (qdot_cursor_accept_op(m->c, ".."))
        return read_expression(m, QDOT_PARSE_SIDE, part);
    QDOT_TRY(report_unknown_name(m, part));
    return qdot_cursor_expected(m->c, hole->expected);
}

static qdot_status
read_call(const reader *m, const qdot_hole *hole, qdot_filled *part)
{
    const qdot_token **names = NULL;
    qdot_status status;
    size_t n;

    QDOT_TRY(read_name(m, hole, part));
    status = qdot_formals_read_names(m->c, &names, &n);
    qdot_free(names);
    return status;
}

/* Parse an expression in which the arguments of the preceding call NAME(u, v) hide other names. */
static qdot_status
read_body(const reader *m, qdot_filled *part)
{
    const qdot_filled *call = &m->r->parts.at[m->r->parts.n - 2]; /* the part before `=`: NAME(arguments) */
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
read_text(const reader *m, const qdot_usage_node *node)
{
    /* a title without quotes: title The pendulum */
    if (m->c->at->kind == QDOT_TOKEN_NAME && strcmp(node->before, "title") == 0) {
        m->c->error_at = m->c->at->start;
        return qdot_fail(QDOT_ESYNTAX, "`%s` needs a text in quotes", node->before);
    }
    if (m->c->at->kind != QDOT_TOKEN_STRING)
        return qdot_cursor_expected(m->c, qdot_hole_at(node->hole)->expected);
    m->c->at++;
    return QDOT_OK;
}

/* Parse SIDE; if it is just drift(SIDE, ...), record each of these sides, too. */
static qdot_status
read_curve(const reader *m, qdot_filled *part)
{
    qdot_cursor *c = m->c;
    const qdot_token *start = c->at;
    const qdot_postfix_list *code;

    QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    code = &m->r->compiled.at[part->first].code;
    if (!qdot_token_is_word(start, "drift") || !qdot_token_is(start + 1, "(") ||
        code->list.at[code->list.n - 1].token != start)
        return QDOT_OK;
    c->at = start + 2;
    do
        QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
    while (qdot_cursor_accept_op(c, ","));
    return qdot_cursor_expect_op(c, ")");
}

static qdot_status
read_single_token(const reader *m, const qdot_hole *hole, qdot_token_kind kind)
{
    if (m->c->at->kind != kind)
        return qdot_cursor_expected(m->c, hole->expected);
    m->c->at++;
    return QDOT_OK;
}

bool
qdot_hole_is_expression(const qdot_usage_node *node)
{
    switch (placeholder_class(node)) {
    case QDOT_HOLE_NAME:
    case QDOT_HOLE_ROWS:
    case QDOT_HOLE_COORDINATE:
    case QDOT_HOLE_CALL:
    case QDOT_HOLE_WORD:
    case QDOT_HOLE_TOPIC:
    case QDOT_HOLE_TEXT: return false;
    default: return true;
    }
}

bool
qdot_hole_suits(const qdot_usage *u, const qdot_record *r, const qdot_usage_node *node)
{
    const qdot_token *t = r->cursor.at;

    switch (placeholder_class(node)) {
    case QDOT_HOLE_TEXT: return t->kind == QDOT_TOKEN_STRING;
    case QDOT_HOLE_NAME:
        return t->kind == QDOT_TOKEN_NAME && may_be_followed_by(u, node->next, qdot_token_behind_index(t));
    case QDOT_HOLE_CALL: return t->kind == QDOT_TOKEN_NAME && qdot_token_is(t + 1, "(");
    case QDOT_HOLE_COORDINATE: return t->kind == QDOT_TOKEN_NAME && !qdot_token_is(t + 1, "(");
    case QDOT_HOLE_WORD: return t->kind == QDOT_TOKEN_NAME;
    case QDOT_HOLE_ROWS:
        return t->kind == QDOT_TOKEN_NAME && qdot_row_tables_find(r->cursor.session, t->text) != NULL &&
               (t[1].kind == QDOT_TOKEN_END || may_be_followed_by(u, node->next, t + 1));
    case QDOT_HOLE_TOPIC:
        return t->kind == QDOT_TOKEN_NAME || t->kind == QDOT_TOKEN_STRING || qdot_token_is(t, "%");
    default: return t->kind != QDOT_TOKEN_STRING;
    }
}

/* Whether `to "FILE"` stands where an expression or name is expected. */
static bool
is_file_in_place(const reader *m, const qdot_usage_node *node)
{
    const qdot_token *t = m->c->at;

    return (qdot_hole_is_expression(node) || placeholder_class(node) == QDOT_HOLE_COORDINATE) && qdot_token_is_word(t, "to") &&
           t[1].kind == QDOT_TOKEN_STRING && may_be_followed_by(m->u, node->next, t);
}

qdot_status
qdot_hole_read(const qdot_usage *u, qdot_record *r, const qdot_usage_node *node, qdot_filled *part)
{
    const reader of = {u, r, &r->cursor}, *m = &of;
    const qdot_hole *hole = qdot_hole_at(node->hole);

    if (is_file_in_place(m, node) || (qdot_cursor_is_end(m->c) && strcmp(hole->expected, "an expression") != 0))
        return qdot_cursor_expected(m->c, hole->expected);
    switch (hole->class) {
    case QDOT_HOLE_SIDE: return read_expression(m, QDOT_PARSE_SIDE, part);
    case QDOT_HOLE_VALUE: return read_expression(m, QDOT_PARSE_VALUE, part);
    case QDOT_HOLE_CONDITION:
    case QDOT_HOLE_PERIOD: return read_condition_list(m, hole, hole->class == QDOT_HOLE_PERIOD, part);
    case QDOT_HOLE_EQUATION:
    case QDOT_HOLE_COMPARISON: return read_equation(m, node, part);
    case QDOT_HOLE_RANGE: return read_range(m, hole, part);
    case QDOT_HOLE_VALUES:
        QDOT_TRY(read_expression(m, QDOT_PARSE_SIDE, part));
        return qdot_cursor_accept_op(m->c, "..") ? read_expression(m, QDOT_PARSE_SIDE, part) : QDOT_OK;
    case QDOT_HOLE_CURVE: return read_curve(m, part);
    case QDOT_HOLE_TUPLE: return read_tuple(m, node->text, part);
    case QDOT_HOLE_NAME:
    case QDOT_HOLE_COORDINATE: return read_name(m, hole, part);
    case QDOT_HOLE_DOMAIN: return read_domain(m, hole, part);
    case QDOT_HOLE_CALL: return read_call(m, hole, part);
    case QDOT_HOLE_BODY: return read_body(m, part);
    case QDOT_HOLE_ROWS:
    case QDOT_HOLE_WORD: return read_single_token(m, hole, QDOT_TOKEN_NAME);
    case QDOT_HOLE_TOPIC:
        return read_single_token(m, hole, qdot_hole_suits(u, r, node) ? m->c->at->kind : QDOT_TOKEN_NAME);
    default: return read_text(m, node);
    }
}
