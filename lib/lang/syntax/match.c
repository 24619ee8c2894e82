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
#include "lang/language/hints.h"
#include "lang/session/phase.h"
#include "lang/session/row-tables.h"
#include "lang/session/runs.h"
#include "lang/syntax/expected.h"
#include "lang/syntax/hole-read.h"
#include "lang/syntax/outline.h"

typedef struct {
    int node;
    uint32_t from;  /* index in `places` of the position before the previous part of the statement */
    uint64_t taken; /* bits of the options already given */
} place;

typedef struct {
    const qdot_usage *u;
    qdot_record *r;
    qdot_cursor *c;
    qdot_vec(place) places;
    size_t first; /* index of the first of the positions in the usage that are possible at the present token */
    bool begun;   /* the statement is being typed: its operands may be missing */
} matcher;

/* --- positions in the usage ---------------------------------------------------------- */

/* Add all that may come at the node of the usage automaton to the current positions. */
static qdot_status
add_position(matcher *m, int node, uint32_t from, uint64_t taken)
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
        QDOT_TRY(add_position(m, at->next, from, taken | at->enters));
    return at->other >= 0 ? add_position(m, at->other, from, taken) : QDOT_OK;
}

static const qdot_usage_node *
node_at_position(const matcher *m, size_t i)
{
    return &m->u->node[m->places.at[i].node];
}

static qdot_hole_class
placeholder_class(const qdot_usage_node *node)
{
    return qdot_hole_at(node->hole)->class;
}

/* --- choosing the hole at a token ---------------------------------------------------- */

/* Choose the kind of placeholder to be read at the token, preferring a name to an expression; NULL: none is possible. */
static const qdot_usage_node *
choose_placeholder(const matcher *m)
{
    const qdot_usage_node *found = NULL, *suits = NULL;

    for (size_t i = m->first; i < m->places.n; i++) {
        const qdot_usage_node *node = node_at_position(m, i);

        if (node->kind != QDOT_USAGE_HOLE)
            continue;
        found = found == NULL || qdot_hole_is_expression(node) || !qdot_hole_is_expression(found) ? node : found;
        if (qdot_hole_suits(m->u, m->r, node) && (suits == NULL || (qdot_hole_is_expression(suits) && !qdot_hole_is_expression(node))))
            suits = node;
    }
    return suits != NULL ? suits : found;
}

/* --- matching a statement ------------------------------------------------------------ */

/* Record a part of the statement, and advance all positions in the usage that it fits: its word, or its placeholder. */
static qdot_status
advance_positions(matcher *m, const qdot_filled *part, const qdot_usage_node *hole)
{
    const size_t first = m->first, n = m->places.n;

    QDOT_TRY(qdot_vec_push(&m->r->parts, *part));
    m->first = n;
    for (size_t i = first; i < n; i++) {
        const qdot_usage_node *node = node_at_position(m, i);

        if (hole != NULL ? node->kind != QDOT_USAGE_HOLE || placeholder_class(node) != placeholder_class(hole)
                         : !qdot_usage_node_is(node, part->from))
            continue;
        m->r->parts.at[m->r->parts.n - 1].node = node; /* one of the nodes that fit; which one is decided at the end */
        QDOT_TRY(add_position(m, node->next, (uint32_t)i, m->places.at[i].taken));
    }
    return QDOT_OK;
}

static bool
is_word_in_usage(const matcher *m, const qdot_token *t)
{
    return t->kind == QDOT_TOKEN_NAME && qdot_usage_has_word(m->u, t->text);
}

/* Whether the token is a word of the usage and not a name of the session. */
static bool
is_usage_word(const matcher *m, const qdot_token *t)
{
    return is_word_in_usage(m, t) && !qdot_cursor_knows(m->c->session, t->text);
}

/* Whether the token may be a factor whose `*` is missing: a value precedes it, and neither is a
 * word of the usage. */
static bool
may_be_unmarked_factor(const matcher *m)
{
    const qdot_filled *last = m->r->parts.n > 0 ? &m->r->parts.at[m->r->parts.n - 1] : NULL;

    if (last == NULL || last->node == NULL || last->node->kind != QDOT_USAGE_HOLE ||
        is_usage_word(m, m->c->at) || (last->to == last->from + 1 && is_usage_word(m, last->from)))
        return false;
    switch (placeholder_class(last->node)) {
    case QDOT_HOLE_SIDE:
    case QDOT_HOLE_VALUE:
    case QDOT_HOLE_VALUES:
    case QDOT_HOLE_RANGE:
    case QDOT_HOLE_CURVE:
    case QDOT_HOLE_BODY:
    case QDOT_HOLE_CONDITION:
    case QDOT_HOLE_PERIOD:
    case QDOT_HOLE_EQUATION:
    case QDOT_HOLE_COMPARISON: return true;
    default: return false;
    }
}

/* Whether the last error reports a product without `*`. */
static bool
reports_missing_times(void)
{
    return strcmp(qdot_last_error()->message, "a `*` is missing") == 0 ||
           strncmp(qdot_last_error()->hint, "a product ", 10) == 0;
}

/* Fail at the token because nothing in the usage of the statement fits it. */
static qdot_status
report_unfitting_token(matcher *m)
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
    if (reports_missing_times() && (!may_be_unmarked_factor(m) || (hint != NULL && !qdot_cursor_is_call(m->c, m->c->at)))) {
        m->c->error_at = m->c->at->start;
        status = qdot_fail(QDOT_ESYNTAX, "expected %s, found `%.100s`", what, m->c->at->text);
    }
    return hint != NULL && qdot_last_error()->hint[0] == '\0' ? qdot_hint("%s", hint) : status;
}

/* Whether the word has an operand, where a value of that name may stand too: `conserved E` and
 * `conserved[2]`, `help search energy` and `help search`. */
static bool
is_word_with_operand(const matcher *m, const qdot_token *word)
{
    const qdot_token *t = word + 1;

    return qdot_names_find(m->c->session->names, word->text) == NULL &&
           ((m->begun && t->kind == QDOT_TOKEN_END) || t->kind == QDOT_TOKEN_NAME || t->kind == QDOT_TOKEN_NUMBER || t->kind == QDOT_TOKEN_STRING ||
            qdot_token_is(t, "(") || (qdot_token_is(t, "[") && !t->glued) || qdot_token_is(t, "-") || qdot_token_is(t, "%") ||
            qdot_token_is(t, "sqrt"));
}

/* Whether the word is a value, where one may stand: a function before its argument, as in `plot log(x)`, or a name of
 * the session before an operator, a word of the usage or the end, as in `plot range vs range = 0..1`. */
static bool
is_word_used_as_value(const matcher *m, const qdot_token *word)
{
    const qdot_token *next = word + 1;

    if (next->glued && qdot_token_is(next, "("))
        return qdot_cursor_is_call(m->c, word);
    return qdot_names_find(m->c->session->names, word->text) != NULL &&
           (next->kind == QDOT_TOKEN_OPERATOR || next->kind == QDOT_TOKEN_END || is_word_in_usage(m, next));
}

static bool
is_hole_of_run(const qdot_usage_node *node)
{
    return node->kind == QDOT_USAGE_HOLE && strcmp(node->text, "RUN") == 0;
}

static bool
is_name_of_run(const matcher *m, const qdot_token *name)
{
    const qdot_run_list *runs = m->c->session->runs;

    for (size_t i = 0; i < runs->n; i++)
        if (qdot_token_is_word(name, runs->at[i].name))
            return true;
    return false;
}

/* Whether the token is a word or sign that may come, and no name that the usage goes on behind: a
 * spring may be called `rest`, a run `session` where there is one. */
static bool
is_token_expected(const matcher *m)
{
    bool fits = false, named = false, value = false;

    for (size_t i = m->first; i < m->places.n; i++) {
        const qdot_usage_node *node = node_at_position(m, i);

        if (node->kind == QDOT_USAGE_HOLE && placeholder_class(node) == QDOT_HOLE_NAME && qdot_hole_suits(m->u, m->r, node) &&
            (!is_hole_of_run(node) || is_name_of_run(m, m->c->at)))
            return false;
        named = named || (node->kind == QDOT_USAGE_HOLE && (placeholder_class(node) == QDOT_HOLE_COMPARISON ||
                                                            placeholder_class(node) == QDOT_HOLE_TOPIC));
        value = value || (node->kind == QDOT_USAGE_HOLE && qdot_hole_is_expression(node));
        fits = fits || qdot_usage_node_is(node, m->c->at);
    }
    if (named)
        return fits && is_word_with_operand(m, m->c->at);
    return fits && !(value && m->c->at->kind == QDOT_TOKEN_NAME && is_word_used_as_value(m, m->c->at));
}

static bool
may_end(const matcher *m)
{
    for (size_t i = m->first; i < m->places.n; i++)
        if (node_at_position(m, i)->kind == QDOT_USAGE_END)
            return true;
    return false;
}

static bool
is_at_end(const matcher *m)
{
    return qdot_cursor_is_end(m->c) && may_end(m);
}

static qdot_status
read_next_part(matcher *m, bool *end)
{
    qdot_filled part = {.from = m->c->at, .first = m->r->compiled.n};
    const qdot_usage_node *hole = NULL;

    *end = is_at_end(m);
    if (*end)
        return QDOT_OK;
    if (is_token_expected(m)) {
        m->c->at++;
    } else {
        hole = choose_placeholder(m);
        if (hole == NULL || (placeholder_class(hole) == QDOT_HOLE_TOPIC && may_end(m) && !qdot_hole_suits(m->u, m->r, hole)))
            return report_unfitting_token(m);
        QDOT_TRY(qdot_hole_read(m->u, m->r, hole, &part));
    }
    part.to = m->c->at;
    if (part.primes == NULL)
        part.primes = part.to;
    return advance_positions(m, &part, hole);
}

/* The first required clause of this form of the statement that is not among `taken`; NULL: none is missing. */
static const qdot_usage_node *
find_missing_clause(const qdot_usage *u, int alternative, uint64_t taken)
{
    for (int i = 0; i < u->n; i++)
        if (u->node[i].needs != 0 && (u->node[i].needs & taken) == 0 && u->node[i].alternative == alternative)
            return &u->node[u->node[i].next];
    return NULL;
}

/* The first name in what was read for expressions that means nothing; NULL: each is known, or its meaning depends on
 * what follows. */
static const qdot_token *
find_unknown_name(const matcher *m)
{
    for (size_t k = 0; k < m->r->parts.n; k++) {
        const qdot_filled *part = &m->r->parts.at[k];
        int depth = 0; /* bracket depth, as an index of a sum has a meaning only within its brackets */

        if (part->node->kind != QDOT_USAGE_HOLE || !qdot_hole_is_expression(part->node))
            continue;
        for (const qdot_token *t = part->from; t < part->to; t++) {
            depth += qdot_token_bracket(t);
            if (depth == 0 && t->kind == QDOT_TOKEN_NAME && !qdot_token_is(t - 1, ".") && !qdot_token_is(t + 1, ".") &&
                !qdot_token_is(t + 1, "[") && !qdot_token_is(t + 1, "(") && !qdot_cursor_knows(m->c->session, t->text))
                return t;
        }
    }
    return NULL;
}

/* Assign to each part of the statement the node of the usage through which its end was reached. */
static qdot_status
assign_nodes_to_parts(matcher *m)
{
    const qdot_usage_node *missing;
    const qdot_token *unknown;
    uint32_t at = (uint32_t)m->first;
    uint64_t taken;

    while (node_at_position(m, at)->kind != QDOT_USAGE_END)
        at++;
    taken = m->places.at[at].taken;
    for (size_t k = m->r->parts.n; k-- > 0;) {
        at = m->places.at[at].from;
        m->r->parts.at[k].node = node_at_position(m, at);
    }
    missing = find_missing_clause(m->u, m->r->parts.at[m->r->parts.n - 1].node->alternative, taken);
    if (missing == NULL)
        return QDOT_OK;
    unknown = find_unknown_name(m); /* an unknown name explains the error better than a missing clause */
    if (unknown != NULL) {
        m->c->error_at = unknown->start;
        return qdot_hints_unknown(m->c, unknown, NULL);
    }
    if (qdot_expected_clause(m->u->word, missing->text) != NULL)
        return qdot_cursor_expected(m->c, qdot_expected_clause(m->u->word, missing->text));
    m->c->error_at = m->r->start->start;
    (void)qdot_fail(QDOT_ESYNTAX, "a %s needs `%s`", m->u->word, missing->text);
    return qdot_hint("%s", m->r->row->form != NULL ? m->r->row->form : m->r->row->usage);
}

/* Read tokens up to the end of the statement. */
static qdot_status
read_to_end(matcher *m, qdot_status status)
{
    bool end = false;

    while (status == QDOT_OK && !end)
        status = read_next_part(m, &end);
    if (status == QDOT_OK)
        status = assign_nodes_to_parts(m);
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
    return read_to_end(&m, add_position(&m, 0, 0, 0));
}

/* Take the first position to that behind the statement's word, which is not among the tokens. */
static qdot_status
begin_behind_word(matcher *m)
{
    const qdot_token word = {.kind = QDOT_TOKEN_NAME, .text = m->r->row->word};
    qdot_filled *part;

    QDOT_TRY(add_position(m, 0, 0, 0));
    QDOT_TRY(advance_positions(m, &(qdot_filled){.from = &word, .to = &word, .primes = &word}, NULL));
    part = &m->r->parts.at[0];
    part->from = part->to = part->primes = m->c->at;
    return QDOT_OK;
}

qdot_status
qdot_match_operands(const qdot_cursor *c, const qdot_statement *row, qdot_record *record)
{
    matcher m = {.r = record, .c = &record->cursor};

    *record = (qdot_record){.row = row, .cursor = *c, .start = c->at};
    record->usage = qdot_malloc(sizeof *record->usage);
    if (record->usage == NULL || !qdot_usage_compile(record->usage, row->word, row->usage))
        return QDOT_ENOMEM;
    m.u = record->usage;
    return read_to_end(&m, begin_behind_word(&m));
}

/* --- statements that are being typed --------------------------------------------------- */

/* Add what may come at the node; missing: a required clause before it in the usage has not been given. */
static void
add_next(const qdot_usage *u, int node, uint64_t taken, bool missing, qdot_next *next)
{
    const qdot_usage_node *at = &u->node[node];

    if (missing && at->enters == 0)
        return; /* behind the clauses */
    for (int i = 0; i < next->n; i++)
        if (next->at[i].node == at && next->at[i].taken == taken)
            return;
    if (next->n >= QDOT_NEXT)
        return; /* beyond this number of places some possible continuations are not told */
    next->at[next->n].node = at;
    next->at[next->n++].taken = taken;
    if (at->kind != QDOT_USAGE_FORK)
        return;
    taken &= ~at->forgets;
    if ((taken & (at->enters | at->needs | (next->ordered ? at->later : 0))) == 0)
        add_next(u, at->next, taken | at->enters, false, next);
    if (at->other < 0)
        return;
    missing = missing || (at->needs != 0 && (taken & at->needs) == 0);
    if (!(missing && next->ordered && u->node[at->other].needs != at->needs))
        add_next(u, at->other, taken, missing, next);
}

/* Whether the last part may be what this node stands for: a declared name that is no run's does not stand for RUN, as
 * `start x` goes on with `=`. */
static bool
is_what_node_stands_for(const matcher *m, const qdot_usage_node *node)
{
    const qdot_names *names = m->c->session->names;
    const qdot_token *name = m->r->parts.at[m->r->parts.n - 1].from;

    return !is_hole_of_run(node) || is_name_of_run(m, name) ||
           (qdot_names_find(names, name->text) == NULL && !qdot_names_is_family(names, name->text));
}

static void
find_next(const matcher *m, qdot_next *next)
{
    for (size_t i = m->first; i < m->places.n; i++) {
        const place *here = &m->places.at[i], *before = &m->places.at[here->from];
        const bool begins = m->r->parts.n == 0;

        /* the places that follow the last part at once, not those that others lead to */
        if (begins ? here->node == 0
                   : here->node == m->u->node[before->node].next && here->taken == before->taken &&
                         is_what_node_stands_for(m, &m->u->node[before->node]))
            add_next(m->u, here->node, here->taken, false, next);
    }
}

static bool
is_word_of_usage(const void *usage, const char *name)
{
    return qdot_usage_has_word(usage, name);
}

qdot_status
qdot_match_begun(const qdot_cursor *c, const qdot_statement *row, const qdot_usage *u, bool word, qdot_next *next,
                 qdot_record *record)
{
    matcher m = {.u = u, .r = record, .c = &record->cursor, .begun = true};
    qdot_status status;
    bool end = false;

    *record = (qdot_record){.row = row, .cursor = *c, .start = word ? c->at + 1 : c->at};
    record->cursor.is_word = is_word_of_usage;
    record->cursor.usage = u;
    status = u->word[0] != '\0' && !word ? begin_behind_word(&m) : add_position(&m, 0, 0, 0);
    while (status == QDOT_OK && !qdot_cursor_is_end(m.c))
        status = read_next_part(&m, &end);
    if (next != NULL) {
        next->n = 0;
        next->inside = status != QDOT_OK && qdot_cursor_is_end(m.c);
        if (status == QDOT_OK)
            find_next(&m, next);
    }
    qdot_free(m.places.at);
    return qdot_grave(status);
}

/* --- carrying out ------------------------------------------------------------------------ */

qdot_status
qdot_match_operands_to(const qdot_cursor *c, const qdot_token *end, const qdot_statement *row,
                       qdot_record *record)
{
    const qdot_token_kind kind = qdot_outline_cut(end);
    const qdot_status status = qdot_match_operands(c, row, record);

    qdot_outline_join(end, kind);
    return status;
}

qdot_status
qdot_match_handle(const qdot_statement *row, qdot_record *record)
{
    qdot_session *session = record->cursor.session;
    qdot_status status;

    if (strcmp(row->group, QDOT_NUMBERS) != 0 && !row->linear)
        return row->handler(record);
    status = qdot_phase_begin(session, row->linear);
    if (status == QDOT_OK)
        status = row->handler(record);
    else
        record->cursor.error_at = record->start->start;
    qdot_phase_end(session);
    return status;
}

qdot_status
qdot_match_carry_out(qdot_cursor *c, const qdot_statement *row)
{
    qdot_record record;
    qdot_status status = qdot_match_operands(c, row, &record);

    if (status == QDOT_OK)
        status = qdot_match_handle(row, &record);
    c->at = record.cursor.at;
    c->error_at = record.cursor.error_at;
    qdot_record_free(&record);
    return status;
}
