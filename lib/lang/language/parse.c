/* parse.c -- an expression to postfix code: precedence with an explicit stack.
 *
 * Sums and products are gathered whole (a + b - c is three terms and one SUM), so that a
 * long one is built once and not again for every term.
 */
#include <string.h>

#include "base/interrupt.h"
#include "lang/functions/builtin.h"
#include "lang/language/evaluator.h"
#include "lang/language/hints.h"
#include "lang/language/parse-stack.h"
#include "lang/language/units.h"
#include "lang/session/range.h"
#include "lang/session/runs.h"
#include "lang/source/lex.h"

static const struct {
    const char *text;
    uint8_t kind;
} binaries[] = {
    {"+", QDOT_OP_SUM},       {"-", QDOT_OP_SUM},      {"*", QDOT_OP_PRODUCT},   {"/", QDOT_OP_PRODUCT},
    {"^", QDOT_OP_POWER},     {"=", QDOT_OP_RELATION}, {"==", QDOT_OP_RELATION}, {"<", QDOT_OP_RELATION},
    {"<=", QDOT_OP_RELATION}, {">", QDOT_OP_RELATION}, {">=", QDOT_OP_RELATION}, {"and", QDOT_OP_AND},
    {"or", QDOT_OP_OR},
};

static qdot_status
fail_at_token(qdot_parser *p, const qdot_token *token, qdot_status status)
{
    p->c->error_at = token->start;
    return status;
}

/* --- operators ---------------------------------------------------------------------- */

static qdot_status
parse_chained_relation(qdot_parser *p, qdot_waiting *w, const qdot_token *token)
{
    if (token->text[0] == '=' || w->token->text[0] == '=') {
        qdot_fail(QDOT_ESYNTAX, "two relations in one: `%s` after `%s`", token->text, w->token->text);
        qdot_hint("an equation within another stands in brackets, as in (1 = 2) = 3; or in a statement of its own");
        return fail_at_token(p, token, QDOT_ESYNTAX);
    }
    w->count++;
    const qdot_token *first = w->token;
    w->token = token;
    return qdot_parser_append(p, QDOT_POSTFIX_CHAIN, first, 2, 0, 0);
}

static qdot_status
parse_binary_operator(qdot_parser *p, qdot_waiting_kind kind, const qdot_token *token)
{
    qdot_waiting *w;

    QDOT_TRY(qdot_parser_emit_tighter(p, kind));
    p->operand = true;
    w = qdot_parser_top(p);
    if (w != NULL && w->kind == kind && kind != QDOT_OP_POWER) {
        if (kind == QDOT_OP_RELATION)
            return parse_chained_relation(p, w, token);
        if (kind == QDOT_OP_SUM || kind == QDOT_OP_PRODUCT)
            QDOT_TRY(qdot_parser_append(p, QDOT_POSTFIX_TERM, w->token, 1, 0, 0));
        w->count++;
        w->token = token;
        return QDOT_OK;
    }
    QDOT_TRY(qdot_parser_push(p, kind, token));
    qdot_parser_top(p)->count = 1;
    return QDOT_OK;
}

/* --- parsing operands --------------------------------------------------------------- */

/* Skip the primes at the cursor; returns their number. */
static unsigned
skip_primes(qdot_parser *p)
{
    unsigned n = 0;

    while (n < QDOT_LEX_PRIMES && p->c->at->glued && qdot_token_is(p->c->at, "'")) {
        p->c->at++;
        n++;
    }
    return n;
}

/* Parse an argument that is a label: NAME or NAME[...]. */
static qdot_status
parse_label(qdot_parser *p, const char *what)
{
    const qdot_token *name = p->c->at;

    if (name->kind != QDOT_TOKEN_NAME)
        return qdot_cursor_expected(p->c, what);
    p->c->at++;
    if (p->c->at->glued && qdot_token_is(p->c->at, "[")) {
        p->c->at++;
        return qdot_parser_push(p, QDOT_IN_LABEL, name);
    }
    p->operand = false;
    return qdot_parser_append(p, QDOT_POSTFIX_LABEL, name, 0, 0, 0);
}

/* Parse the new name of an argument NAME = EXPR, where the call `name` takes such; any other argument as usual. */
static qdot_status
parse_new_name(qdot_parser *p, const qdot_token *name)
{
    const qdot_builtin *row = qdot_builtin_find(name->text);
    const qdot_token *at = p->c->at;
    const bool pair = at->kind == QDOT_TOKEN_NAME && qdot_token_is(at + 1, "=");

    return row != NULL && (row->flags & QDOT_BUILTIN_NAMES) && pair &&
                   qdot_names_find(p->c->session->names, at->text) == NULL ? parse_label(p, "a name") : QDOT_OK;
}

/* Parse a call; the cursor is after `name` (and [indices] and primes), at `(`. */
static qdot_status
parse_call(qdot_parser *p, const qdot_token *name, unsigned n_primes, uint32_t indices)
{
    qdot_session *s = p->c->session;
    const qdot_builtin *row = indices > 0 || qdot_resolve_is_function(s, name->text)
                                  ? NULL
                                  : qdot_builtin_find(name->text);
    unsigned flags = row != NULL ? row->flags : 0;

    if (indices == 0 && qdot_hints_is_foreign(s, name->text)) {
        (void)qdot_hints_unknown_function(p->c, name);
        return fail_at_token(p, name, QDOT_ENAME);
    }
    p->c->at++;
    if (flags & QDOT_BUILTIN_FORM) {
        bool sum = strcmp(name->text, "sum") == 0;

        QDOT_TRY(qdot_parser_push(p, sum ? QDOT_IN_SUM : QDOT_IN_IF, name));
        if (sum) {
            qdot_parser_top(p)->at = (uint32_t)p->program->list.n;
            return qdot_parser_append(p, QDOT_POSTFIX_JUMP, name, 0, 0, 0);
        }
        return QDOT_OK;
    }
    QDOT_TRY(qdot_parser_push(p, QDOT_IN_CALL, name));
    qdot_parser_top(p)->primes = (uint8_t)n_primes;
    qdot_parser_top(p)->indices = indices;
    if (qdot_token_is(p->c->at, ")")) { /* a call without arguments */
        p->c->at++;
        p->stack.n--;
        p->depth--;
        p->operand = false;
        return qdot_parser_append(p, QDOT_POSTFIX_CALL, name, 0, indices, n_primes);
    }
    if (flags & QDOT_BUILTIN_PASSED) {
        qdot_parser_top(p)->passed = true;
        return qdot_parser_append(p, QDOT_POSTFIX_PASS_BEGIN, name, 0, 0, 0);
    }
    return flags & QDOT_BUILTIN_LABEL ? parse_label(p, "the name of a body or particle") : parse_new_name(p, name);
}

/* Whether a superscript number follows without a blank, as in x². */
static bool
superscript_follows(const qdot_parser *p, const qdot_token *t)
{
    return qdot_token_is(t, "^") && t->glued && (p->c->source->text[t->start] & 0x80) != 0;
}

/* Parse sin²(x), which means sin(x)^2; the cursor is after `sin`. */
static qdot_status
parse_superscript_call(qdot_parser *p, const qdot_token *name)
{
    const qdot_token *power = p->c->at + 1;

    if (qdot_token_is(power, "-")) {
        qdot_fail(QDOT_ESYNTAX, "`%s` with a negative power: its inverse, or 1 over it?",
                  name->text);
        qdot_hint("write `a%s(x)`, or `1/%s(x)`", name->text, name->text);
        return fail_at_token(p, power, QDOT_ESYNTAX);
    }
    p->c->at += 2;
    QDOT_TRY(parse_call(p, name, 0, 0));
    if (qdot_parser_top(p) != NULL && qdot_parser_top(p)->token == name)
        qdot_parser_top(p)->power = power;
    return QDOT_OK;
}

static bool
is_function(const qdot_parser *p, const char *name)
{
    const qdot_session *s = p->c->session;

    return qdot_names_find(s->names, name) == NULL
               ? qdot_builtin_find(name) != NULL &&
                     !(qdot_builtin_find(name)->flags & QDOT_BUILTIN_FORM)
               : qdot_resolve_is_function(s, name);
}

/* Whether the name before ` (` may be a function's; in text copied from the screen, where products look so, if it is one. */
static bool
may_be_called(const qdot_parser *p, const qdot_token *name)
{
    if (name->shown)
        return is_function(p, name->text);
    return qdot_names_find(p->c->session->names, name->text) == NULL ||
           qdot_resolve_is_function(p->c->session, name->text);
}

static qdot_status
parse_name(qdot_parser *p)
{
    const qdot_token *t = p->c->at++;
    const qdot_token *next = p->c->at;
    unsigned n;

    if (qdot_token_is(next, ".") && next->glued && next[1].glued &&
        (next[1].kind == QDOT_TOKEN_NAME || qdot_token_is(next + 1, "("))) {
        p->c->at++;
        return qdot_parser_push(p, QDOT_OP_MEMBER, t);
    }
    if (qdot_token_is(next, "[") && next->glued && qdot_runs_is_family(p->c->session, t->text)) {
        const qdot_token *run;

        p->c->at = t;
        QDOT_TRY(qdot_cursor_accept_run(p->c, &run));
        if (run != NULL)
            return qdot_parser_push(p, QDOT_OP_MEMBER, run);
        p->c->at = t + 1;
    }
    n = skip_primes(p);
    next = p->c->at;
    if (qdot_token_is(next, "(") && (n == 0 || next->glued) && (next->glued || may_be_called(p, t)))
        return parse_call(p, t, n, 0);
    if (n == 0 && superscript_follows(p, next) && is_function(p, t->text) &&
        (qdot_token_is(next + 1, "-") || qdot_token_is(next + 2, "(")))
        return parse_superscript_call(p, t);
    if (qdot_token_is(next, "[") && next->glued && n == 0) {
        const bool multiplier = strcmp(t->text, "lambda") == 0, linear = strcmp(t->text, "linearize") == 0;

        if (qdot_hints_is_foreign(p->c->session, t->text)) {
            (void)qdot_hints_unknown(p->c, t, NULL);
            return fail_at_token(p, t, QDOT_ENAME);
        }
        p->c->at++;
        QDOT_TRY(qdot_parser_push(p, QDOT_IN_INDEX_NAME, t));
        return (multiplier || linear) && p->c->at->kind == QDOT_TOKEN_NAME
                   ? parse_label(p, multiplier ? "the label of a constraint" : "A, B, C, D, states, inputs or outputs")
                   : QDOT_OK;
    }
    p->operand = false;
    return qdot_parser_append(p, QDOT_POSTFIX_NAME, t, 0, 0, n);
}

/* Parse `%` or `%3`, which stand for the latest or an earlier answer. */
static qdot_status
parse_earlier_answer(qdot_parser *p)
{
    const qdot_token *t = p->c->at++;
    uint32_t n = 0;

    p->operand = false;
    if (p->c->at->kind == QDOT_TOKEN_NUMBER && p->c->at->glued) {
        const char *digits = p->c->at->text;

        if (strlen(digits) > 9 || strspn(digits, "0123456789") != strlen(digits))
            return qdot_cursor_expected(p->c, "a whole number after `%`");
        for (; *digits != '\0'; digits++)
            n = 10 * n + (uint32_t)(*digits - '0');
        if (n == 0)
            return qdot_cursor_expected(p->c, "a number from 1 after `%`");
        p->c->at++;
    }
    return qdot_parser_append(p, QDOT_POSTFIX_HISTORY, t, n, 0, 0);
}

/* Parse a unit that follows a number, `pi` or a bracket. */
static qdot_status
parse_unit(qdot_parser *p)
{
    const qdot_waiting *w = qdot_parser_top(p);

    return qdot_unit_parse(p->c, w != NULL && (w->kind == QDOT_OP_POWER || (w->kind == QDOT_OP_PRODUCT && w->token->text[0] == '/')),
                           p->program);
}

static qdot_status
parse_operand(qdot_parser *p)
{
    const qdot_token *t = p->c->at;

    if (t->kind == QDOT_TOKEN_NUMBER) {
        p->c->at++;
        p->operand = false;
        QDOT_TRY(qdot_parser_append(p, QDOT_POSTFIX_NUMBER, t, 0, 0, 0));
        return qdot_token_is(p->c->at, "[") ? parse_unit(p) : QDOT_OK;
    }
    if (t->kind == QDOT_TOKEN_NAME && strcmp(t->text, "not") == 0) {
        p->c->at++;
        return qdot_parser_push(p, QDOT_OP_NOT, t);
    }
    if (t->kind == QDOT_TOKEN_NAME && strcmp(t->text, "and") != 0 &&
        strcmp(t->text, "or") != 0)
        return parse_name(p);
    if (qdot_token_is(t, "%"))
        return parse_earlier_answer(p);
    if (qdot_token_is(t, "sqrt")) {
        p->c->at++;
        return qdot_parser_push(p, QDOT_OP_ROOT, t);
    }
    if (qdot_token_is(t, "-") || qdot_token_is(t, "+")) {
        p->c->at++;
        return t->text[0] == '-' ? qdot_parser_push(p, QDOT_OP_NEGATE, t) : QDOT_OK;
    }
    if (qdot_token_is(t, "(")) {
        p->c->at++;
        return qdot_parser_push(p, QDOT_IN_GROUP, t);
    }
    if (qdot_token_is(t, "[")) {
        p->c->at++;
        if (qdot_token_is(p->c->at, "]")) {
            p->c->at++;
            p->operand = false;
            return qdot_parser_append(p, QDOT_POSTFIX_LIST, t, 0, 0, 0);
        }
        return qdot_parser_push(p, QDOT_IN_LIST, t);
    }
    return qdot_cursor_expected(p->c, "an expression");
}

/* --- parsing brackets --------------------------------------------------------------- */

static qdot_status
report_usage(qdot_parser *p, const qdot_waiting *w)
{
    qdot_fail(QDOT_ESYNTAX, w->kind == QDOT_IN_SUM ? "a sum is sum(EXPR, k, a, b)"
                                              : "a choice is if(CONDITION, A, B)");
    qdot_hint(w->kind == QDOT_IN_SUM ? "as in sum(k^2, k, 1, 3); a plain sum is a + b"
                                : "as in if(x > 0, x, -x)");
    return fail_at_token(p, w->token, QDOT_ESYNTAX);
}

/* Parse the index k of sum(EXPR, k, a, b), after the first comma. */
static qdot_status
parse_sum_index(qdot_parser *p, qdot_waiting *w)
{
    w->name = p->c->at;
    if (w->name->kind != QDOT_TOKEN_NAME || !qdot_token_is(w->name + 1, ","))
        return report_usage(p, w);
    p->c->at += 2;
    QDOT_TRY(qdot_parser_append(p, QDOT_POSTFIX_SUM_NEXT, w->token, 0, 0, 0));
    p->program->list.at[w->at].to = (uint32_t)p->program->list.n;
    return QDOT_OK;
}

static qdot_status
parse_comma(qdot_parser *p)
{
    qdot_waiting *w;

    QDOT_TRY(qdot_parser_emit_to_bracket(p));
    w = qdot_parser_top(p);
    if (w->kind == QDOT_IN_CALL && w->ranged)
        return qdot_cursor_expected(p->c, "`)`: a range comes last");
    p->c->at++;
    p->operand = true;
    w->count++;
    w->last = (uint32_t)p->program->list.n;
    if (w->kind == QDOT_IN_SUM) {
        if (w->count == 1)
            return parse_sum_index(p, w);
        return w->count > 2 ? report_usage(p, w) : QDOT_OK;
    }
    if (w->kind == QDOT_IN_IF) {
        uint32_t here = (uint32_t)p->program->list.n;

        if (w->count > 2)
            return report_usage(p, w);
        QDOT_TRY(qdot_parser_append(p, w->count == 1 ? QDOT_POSTFIX_IF_TEST : QDOT_POSTFIX_IF_ELSE, w->token,
                                    0, 0, 0));
        if (w->count == 2)
            p->program->list.at[w->at].to = here + 1;
        w->at = here;
    }
    return w->kind == QDOT_IN_CALL && w->indices == 0 ? parse_new_name(p, w->token) : QDOT_OK;
}

/* Parse `;` in [a, b; c, d]: a row of the matrix is complete. */
static qdot_status
row(qdot_parser *p)
{
    qdot_waiting *w;

    QDOT_TRY(qdot_parser_emit_to_bracket(p));
    w = qdot_parser_top(p);
    if (w->kind != QDOT_IN_LIST)
        return qdot_cursor_expected(
            p->c, w->kind == QDOT_IN_INDEX || w->kind == QDOT_IN_INDEX_NAME || w->kind == QDOT_IN_LABEL ? "`]`" : "`)`");
    w->count++;
    if (w->columns == 0)
        w->columns = w->count;
    if (w->count % w->columns != 0) {
        qdot_fail(QDOT_ETYPE, "the rows of a matrix are of one length");
        return fail_at_token(p, p->c->at, QDOT_ETYPE);
    }
    p->c->at++;
    if (qdot_token_is(p->c->at, "]")) { /* [a, b;] is a matrix with a single row */
        qdot_waiting whole = *w;

        p->c->at++;
        p->stack.n--;
        p->depth--;
        return qdot_parser_append(p, QDOT_POSTFIX_MATRIX, whole.token, whole.count, whole.columns, 0);
    }
    p->operand = true;
    return QDOT_OK;
}

static qdot_status
close_list(qdot_parser *p, const qdot_waiting *w)
{
    if (w->columns == 0)
        return qdot_parser_append(p, QDOT_POSTFIX_LIST, w->token, w->count + 1, 0, 0);
    if ((w->count + 1) % w->columns != 0) {
        qdot_fail(QDOT_ETYPE, "the rows of a matrix are of one length");
        return fail_at_token(p, p->c->at - 1, QDOT_ETYPE);
    }
    return qdot_parser_append(p, QDOT_POSTFIX_MATRIX, w->token, w->count + 1, w->columns, 0);
}

static qdot_status
close_bracket(qdot_parser *p)
{
    qdot_waiting w;
    unsigned n;

    QDOT_TRY(qdot_parser_emit_to_bracket(p));
    w = *qdot_parser_top(p);
    p->c->at++;
    p->stack.n--;
    p->depth--;
    switch ((qdot_waiting_kind)w.kind) {
    case QDOT_IN_GROUP:
        return w.count > 0 ? qdot_parser_append(p, QDOT_POSTFIX_VECTOR, w.token, w.count + 1, 0, 0)
                           : QDOT_OK;
    case QDOT_IN_LIST: return close_list(p, &w);
    case QDOT_IN_LABEL: return qdot_parser_append(p, QDOT_POSTFIX_LABEL, w.token, w.count + 1, 0, 0);
    case QDOT_IN_INDEX_NAME:
        n = skip_primes(p);
        if (qdot_token_is(p->c->at, "(") && p->c->at->glued)
            return parse_call(p, w.token, n, w.count + 1);
        return qdot_parser_append(p, QDOT_POSTFIX_INDEX_NAME, w.token, w.count + 1, 0, n);
    case QDOT_IN_INDEX: return qdot_parser_append(p, QDOT_POSTFIX_INDEX, w.token, w.count + 1, 0, 0);
    case QDOT_IN_SUM:
        if (w.count != 2)
            return report_usage(p, &w);
        return qdot_parser_append(p, QDOT_POSTFIX_SUM_BEGIN, w.token,
                                  (uint32_t)(w.name - p->c->source->tokens.at), w.at + 1, 0);
    case QDOT_IN_IF:
        if (w.count != 2)
            return report_usage(p, &w);
        QDOT_TRY(qdot_parser_append(p, QDOT_POSTFIX_IF_END, w.token, 0, 0, 0));
        p->program->list.at[w.at].to = (uint32_t)p->program->list.n;
        return QDOT_OK;
    default:
        if (w.ranged)
            QDOT_TRY(qdot_parser_append(p, QDOT_POSTFIX_RANGE, w.token, w.count + 1, 0, 0));
        else
            QDOT_TRY(qdot_parser_append(p, QDOT_POSTFIX_CALL, w.token, w.count + 1, w.indices, w.primes));
        p->program->list.at[p->program->list.n - 1].last = w.last;
        if (w.passed)
            QDOT_TRY(qdot_parser_append(p, QDOT_POSTFIX_PASS_END, w.token, 0, 0, 0));
        if (w.power == NULL)
            return QDOT_OK;
        QDOT_TRY(qdot_parser_append(p, QDOT_POSTFIX_NUMBER, w.power, 0, 0, 0));
        return qdot_parser_append(p, QDOT_POSTFIX_POWER, w.power, 2, 0, 0);
    }
}

static bool
may_take_range(const char *word)
{
    const qdot_builtin *row = qdot_builtin_find(word);

    return qdot_range_is_word(word) || (row != NULL && (row->flags & QDOT_BUILTIN_RANGE));
}

/* Parse `a..b` among the arguments of a call: a range of numbers, for some functions of times of a run. */
static qdot_status
parse_argument_range(qdot_parser *p)
{
    qdot_waiting *w;

    QDOT_TRY(qdot_parser_emit_to_bracket(p));
    w = qdot_parser_top(p);
    if (w->kind != QDOT_IN_CALL || w->ranged || w->count == 0 || w->indices > 0 ||
        w->primes > 0 || !may_take_range(w->token->text) ||
        qdot_resolve_is_function(p->c->session, w->token->text))
        return qdot_cursor_expected(p->c, w->kind == QDOT_IN_CALL ? "`,` or `)`" : "`)`");
    w->ranged = true;
    w->count++;
    w->last = (uint32_t)p->program->list.n;
    p->c->at++;
    p->operand = true;
    return QDOT_OK;
}

/* --- after an operand --------------------------------------------------------------- */

static qdot_status
report_stray_prime(qdot_parser *p)
{
    qdot_fail(QDOT_ESYNTAX, "a prime goes directly after a name");
    qdot_hint("the time derivative of an expression is ddt(...)");
    return fail_at_token(p, p->c->at, QDOT_ESYNTAX);
}

static qdot_status
parse_after_operand(qdot_parser *p)
{
    const qdot_token *t = p->c->at;

    if (t->glued && qdot_token_is(t, "'"))
        return report_stray_prime(p);
    if (qdot_unit_follows(t))
        return parse_unit(p);
    if (t->glued && qdot_token_is(t, "[")) {
        p->c->at++;
        return qdot_parser_push(p, QDOT_IN_INDEX, t);
    }
    if (qdot_parser_top(p) != NULL && qdot_parser_top(p)->kind == QDOT_OP_ROOT && qdot_token_is(t, "^") &&
        !qdot_token_is(t - 1, ")")) {
        qdot_fail(QDOT_ESYNTAX, "a root and a power: which comes first?");
        qdot_hint("write `√(x^2)` or `√(x)^2`");
        return fail_at_token(p, t, QDOT_ESYNTAX);
    }
    QDOT_TRY(qdot_parser_emit_tighter(p, QDOT_OP_POWER)); /* a root, the run of a member */

    if (t->kind == QDOT_TOKEN_OPERATOR || t->kind == QDOT_TOKEN_NAME)
        for (size_t i = 0; i < sizeof binaries / sizeof *binaries; i++) {
            qdot_waiting_kind kind = binaries[i].kind;

            if (strcmp(t->text, binaries[i].text) != 0)
                continue;
            if (p->depth == 0 && p->extent == QDOT_PARSE_SIDE && kind <= QDOT_OP_RELATION)
                break;
            p->c->at++;
            return parse_binary_operator(p, kind, t);
        }
    if (qdot_cursor_is_shown_product(p->c, t, p->depth > 0))
        return parse_binary_operator(p, QDOT_OP_PRODUCT, t);
    if (p->depth == 0) {
        p->done = true;
        QDOT_TRY(qdot_parser_emit_to_bracket(p));
        return qdot_unit_parse_in(p->c, p->program);
    }
    if (qdot_token_is(t, ","))
        return parse_comma(p);
    if (qdot_token_is(t, ";"))
        return row(p);
    if (qdot_token_is(t, ")") || qdot_token_is(t, "]"))
        return close_bracket(p);
    if (qdot_token_is(t, ".."))
        return parse_argument_range(p);
    QDOT_TRY(qdot_parser_emit_to_bracket(p));
    return qdot_cursor_expected(
        p->c, qdot_parser_top(p)->kind == QDOT_IN_LIST || qdot_parser_top(p)->kind == QDOT_IN_INDEX ||
                      qdot_parser_top(p)->kind == QDOT_IN_INDEX_NAME || qdot_parser_top(p)->kind == QDOT_IN_LABEL
                  ? "`]`"
                  : "`)`");
}

static qdot_status
parse_expression(qdot_parser *p)
{
    for (size_t i = 0; !p->done; i++) {
        if ((i & 0xFFFF) == 0xFFFF)
            QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(p->operand ? parse_operand(p) : parse_after_operand(p));
    }
    return QDOT_OK;
}

qdot_status
qdot_parse(qdot_cursor *c, qdot_parse_extent extent, qdot_postfix_list *program)
{
    qdot_parser p = {.c = c, .program = program, .extent = extent, .operand = true};
    qdot_status status;

    c->error_at = c->at->start;
    status = parse_expression(&p);
    qdot_free(p.stack.at);
    return status;
}
