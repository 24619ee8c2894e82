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
#include "lang/language/units.h"
#include "lang/session/range.h"
#include "lang/session/runs.h"
#include "lang/source/lex.h"

/* Operators (by precedence) and open brackets that wait on the parser's stack. */
typedef enum {
    OP_OR,
    OP_AND,
    OP_NOT,
    OP_RELATION,
    OP_SUM,
    OP_PRODUCT,
    OP_NEGATE,
    OP_POWER,
    OP_ROOT, /* √ before its operand */
    OP_MEMBER, /* the run `a.` before its operand */
    IN_GROUP,  /* brackets ( ) of an operand: a vector if they contain a comma */
    IN_LIST,   /* brackets [ ]: a list, or with `;` a matrix */
    IN_INDEX_NAME,
    IN_INDEX,
    IN_LABEL,
    IN_CALL,
    IN_SUM,
    IN_IF
} waiting_kind;

typedef struct {
    uint8_t kind; /* the operator or bracket, a waiting_kind */
    uint8_t primes;
    bool ranged; /* for IN_CALL: the last argument is a range a..b */
    bool passed; /* for IN_CALL: between the instructions PASS_BEGIN and PASS_END */
    const qdot_token *token; /* the operator's sign, or the opening bracket */
    const qdot_token *name;  /* for IN_SUM: token of the sum's index */
    const qdot_token *power; /* for IN_CALL: exponent of sin²(x), which means sin(x)^2; NULL: none */
    uint32_t count;          /* number of complete operands or arguments */
    uint32_t columns, indices, at;
    uint32_t last; /* of IN_CALL: where the code of the present argument begins, from the second on */
} waiting;

typedef struct {
    qdot_cursor *c;
    qdot_postfix_list *program;
    qdot_parse_extent extent;
    qdot_vec(waiting) stack;
    size_t depth; /* number of open brackets */
    bool operand; /* whether an operand must come next */
    bool done;
} parser;

static const struct {
    const char *text;
    uint8_t kind;
} binaries[] = {
    {"+", OP_SUM},       {"-", OP_SUM},      {"*", OP_PRODUCT},   {"/", OP_PRODUCT},
    {"^", OP_POWER},     {"=", OP_RELATION}, {"==", OP_RELATION}, {"<", OP_RELATION},
    {"<=", OP_RELATION}, {">", OP_RELATION}, {">=", OP_RELATION}, {"and", OP_AND},
    {"or", OP_OR},
};

static qdot_status
fail_at_token(parser *p, const qdot_token *token, qdot_status status)
{
    p->c->error_at = token->start;
    return status;
}

static qdot_status
append_instruction(parser *p, qdot_postfix_kind op, const qdot_token *token, uint32_t n, uint32_t to,
                   unsigned primes)
{
    qdot_postfix code = {.op = (uint8_t)op, .primes = (uint8_t)primes, .n = n, .to = to, .token = token};

    return qdot_vec_push(&p->program->list, code);
}

static waiting *
top_of_stack(parser *p)
{
    return p->stack.n > 0 ? &p->stack.at[p->stack.n - 1] : NULL;
}

static qdot_status
push_on_stack(parser *p, waiting_kind kind, const qdot_token *token)
{
    waiting w = {.kind = (uint8_t)kind, .token = token};

    if (kind >= IN_GROUP) {
        p->depth++;
        p->operand = true;
    }
    return qdot_vec_push(&p->stack, w);
}

/* --- waiting operators -------------------------------------------------------------- */

/* Append the instruction of the operator on top of the parser's stack, whose last operand is complete. */
static qdot_status
emit_top_operator(parser *p)
{
    waiting w = p->stack.at[--p->stack.n];

    switch ((waiting_kind)w.kind) {
    case OP_OR: return append_instruction(p, QDOT_POSTFIX_OR, w.token, w.count + 1, 0, 0);
    case OP_AND: return append_instruction(p, QDOT_POSTFIX_AND, w.token, w.count + 1, 0, 0);
    case OP_NOT: return append_instruction(p, QDOT_POSTFIX_NOT, w.token, 1, 0, 0);
    case OP_RELATION:
        QDOT_TRY(append_instruction(p, QDOT_POSTFIX_RELATION, w.token, 2, 0, 0));
        return w.count > 1 ? append_instruction(p, QDOT_POSTFIX_AND, w.token, w.count, 0, 0) : QDOT_OK;
    case OP_SUM:
        QDOT_TRY(append_instruction(p, QDOT_POSTFIX_TERM, w.token, 1, 0, 0));
        return append_instruction(p, QDOT_POSTFIX_SUM, w.token, w.count + 1, 0, 0);
    case OP_PRODUCT:
        QDOT_TRY(append_instruction(p, QDOT_POSTFIX_TERM, w.token, 1, 0, 0));
        return append_instruction(p, QDOT_POSTFIX_PRODUCT, w.token, w.count + 1, 0, 0);
    case OP_NEGATE: return append_instruction(p, QDOT_POSTFIX_NEGATE, w.token, 1, 0, 0);
    case OP_POWER: return append_instruction(p, QDOT_POSTFIX_POWER, w.token, 2, 0, 0);
    case OP_ROOT: return append_instruction(p, QDOT_POSTFIX_CALL, w.token, 1, 0, 0);
    default: return append_instruction(p, QDOT_POSTFIX_MEMBER, w.token, 1, 0, 0);
    }
}

/* Append the instructions of all operators on the stack that bind tighter than `kind`. */
static qdot_status
emit_tighter_operators(parser *p, waiting_kind kind)
{
    while (top_of_stack(p) != NULL && top_of_stack(p)->kind < IN_GROUP && top_of_stack(p)->kind > kind)
        QDOT_TRY(emit_top_operator(p));
    return QDOT_OK;
}

/* Append the instructions of all operators on the stack down to the last opening bracket. */
static qdot_status
emit_operators_to_bracket(parser *p)
{
    while (top_of_stack(p) != NULL && top_of_stack(p)->kind < IN_GROUP)
        QDOT_TRY(emit_top_operator(p));
    return QDOT_OK;
}

static qdot_status
parse_chained_relation(parser *p, waiting *w, const qdot_token *token)
{
    if (token->text[0] == '=' || w->token->text[0] == '=') {
        qdot_fail(QDOT_ESYNTAX, "two relations in one: `%s` after `%s`", token->text, w->token->text);
        qdot_hint("write (a = b) = c with brackets, or two statements");
        return fail_at_token(p, token, QDOT_ESYNTAX);
    }
    w->count++;
    const qdot_token *first = w->token;
    w->token = token;
    return append_instruction(p, QDOT_POSTFIX_CHAIN, first, 2, 0, 0);
}

static qdot_status
parse_binary_operator(parser *p, waiting_kind kind, const qdot_token *token)
{
    waiting *w;

    QDOT_TRY(emit_tighter_operators(p, kind));
    p->operand = true;
    w = top_of_stack(p);
    if (w != NULL && w->kind == kind && kind != OP_POWER) {
        if (kind == OP_RELATION)
            return parse_chained_relation(p, w, token);
        if (kind == OP_SUM || kind == OP_PRODUCT)
            QDOT_TRY(append_instruction(p, QDOT_POSTFIX_TERM, w->token, 1, 0, 0));
        w->count++;
        w->token = token;
        return QDOT_OK;
    }
    QDOT_TRY(push_on_stack(p, kind, token));
    top_of_stack(p)->count = 1;
    return QDOT_OK;
}

/* --- parsing operands --------------------------------------------------------------- */

/* Skip the primes at the cursor; returns their number. */
static unsigned
skip_primes(parser *p)
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
parse_label(parser *p, const char *what)
{
    const qdot_token *name = p->c->at;

    if (name->kind != QDOT_TOKEN_NAME)
        return qdot_cursor_expected(p->c, what);
    p->c->at++;
    if (p->c->at->glued && qdot_token_is(p->c->at, "[")) {
        p->c->at++;
        return push_on_stack(p, IN_LABEL, name);
    }
    p->operand = false;
    return append_instruction(p, QDOT_POSTFIX_LABEL, name, 0, 0, 0);
}

/* Parse the new name of an argument NAME = EXPR, where the call `name` takes such; any other argument as usual. */
static qdot_status
parse_new_name(parser *p, const qdot_token *name)
{
    const qdot_builtin *row = qdot_builtin_find(name->text);
    const qdot_token *at = p->c->at;
    const bool pair = at->kind == QDOT_TOKEN_NAME && qdot_token_is(at + 1, "=");

    return row != NULL && (row->flags & QDOT_BUILTIN_NAMES) && pair &&
                   qdot_names_find(p->c->session->names, at->text) == NULL ? parse_label(p, "a name") : QDOT_OK;
}

/* Parse a call; the cursor is after `name` (and [indices] and primes), at `(`. */
static qdot_status
parse_call(parser *p, const qdot_token *name, unsigned n_primes, uint32_t indices)
{
    qdot_session *s = p->c->session;
    const qdot_builtin *row = indices > 0 || qdot_resolve_is_function(s, name->text)
                                  ? NULL
                                  : qdot_builtin_find(name->text);
    unsigned flags = row != NULL ? row->flags : 0;

    if (flags & QDOT_BUILTIN_UNBUILT) {
        qdot_fail(QDOT_ENOTBUILT, "not built yet: %s", name->text);
        return fail_at_token(p, name, QDOT_ENOTBUILT);
    }
    if (indices == 0 && qdot_hints_is_foreign(s, name->text)) {
        (void)qdot_hints_unknown_function(p->c, name);
        return fail_at_token(p, name, QDOT_ENAME);
    }
    p->c->at++;
    if (flags & QDOT_BUILTIN_FORM) {
        bool sum = strcmp(name->text, "sum") == 0;

        QDOT_TRY(push_on_stack(p, sum ? IN_SUM : IN_IF, name));
        if (sum) {
            top_of_stack(p)->at = (uint32_t)p->program->list.n;
            return append_instruction(p, QDOT_POSTFIX_JUMP, name, 0, 0, 0);
        }
        return QDOT_OK;
    }
    QDOT_TRY(push_on_stack(p, IN_CALL, name));
    top_of_stack(p)->primes = (uint8_t)n_primes;
    top_of_stack(p)->indices = indices;
    if (qdot_token_is(p->c->at, ")")) { /* a call without arguments */
        p->c->at++;
        p->stack.n--;
        p->depth--;
        p->operand = false;
        return append_instruction(p, QDOT_POSTFIX_CALL, name, 0, indices, n_primes);
    }
    if (flags & QDOT_BUILTIN_PASSED) {
        top_of_stack(p)->passed = true;
        return append_instruction(p, QDOT_POSTFIX_PASS_BEGIN, name, 0, 0, 0);
    }
    return flags & QDOT_BUILTIN_LABEL ? parse_label(p, "the name of a body or particle") : parse_new_name(p, name);
}

/* Whether a superscript number follows without a blank, as in x². */
static bool
superscript_follows(const parser *p, const qdot_token *t)
{
    return qdot_token_is(t, "^") && t->glued && (p->c->source->text[t->start] & 0x80) != 0;
}

/* Parse sin²(x), which means sin(x)^2; the cursor is after `sin`. */
static qdot_status
parse_superscript_call(parser *p, const qdot_token *name)
{
    const qdot_token *power = p->c->at + 1;

    if (qdot_token_is(power, "-")) {
        qdot_fail(QDOT_ESYNTAX, "`%s` with a negative power: its inverse, or 1 over it?",
                  name->text);
        qdot_hint("write a%s(x), or 1/%s(x)", name->text, name->text);
        return fail_at_token(p, power, QDOT_ESYNTAX);
    }
    p->c->at += 2;
    QDOT_TRY(parse_call(p, name, 0, 0));
    if (top_of_stack(p) != NULL && top_of_stack(p)->token == name)
        top_of_stack(p)->power = power;
    return QDOT_OK;
}

static bool
is_function(const parser *p, const char *name)
{
    const qdot_session *s = p->c->session;

    return qdot_names_find(s->names, name) == NULL
               ? qdot_builtin_find(name) != NULL &&
                     !(qdot_builtin_find(name)->flags & QDOT_BUILTIN_FORM)
               : qdot_resolve_is_function(s, name);
}

/* Whether the name before ` (` may be a function's; in text copied from the screen, where products look so, if it is one. */
static bool
may_be_called(const parser *p, const qdot_token *name)
{
    if (name->shown)
        return is_function(p, name->text);
    return qdot_names_find(p->c->session->names, name->text) == NULL ||
           qdot_resolve_is_function(p->c->session, name->text);
}

static qdot_status
parse_name(parser *p)
{
    const qdot_token *t = p->c->at++;
    const qdot_token *next = p->c->at;
    unsigned n;

    if (qdot_token_is(next, ".") && next->glued && next[1].glued &&
        (next[1].kind == QDOT_TOKEN_NAME || qdot_token_is(next + 1, "("))) {
        p->c->at++;
        return push_on_stack(p, OP_MEMBER, t);
    }
    if (qdot_token_is(next, "[") && next->glued && qdot_runs_is_family(p->c->session, t->text)) {
        const qdot_token *run;

        p->c->at = t;
        QDOT_TRY(qdot_cursor_accept_run(p->c, &run));
        if (run != NULL)
            return push_on_stack(p, OP_MEMBER, run);
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
        QDOT_TRY(push_on_stack(p, IN_INDEX_NAME, t));
        return (multiplier || linear) && p->c->at->kind == QDOT_TOKEN_NAME
                   ? parse_label(p, multiplier ? "the label of a constraint" : "A, B, C, D, states, inputs or outputs")
                   : QDOT_OK;
    }
    p->operand = false;
    return append_instruction(p, QDOT_POSTFIX_NAME, t, 0, 0, n);
}

/* Parse `%` or `%3`, which stand for the latest or an earlier answer. */
static qdot_status
parse_earlier_answer(parser *p)
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
    return append_instruction(p, QDOT_POSTFIX_HISTORY, t, n, 0, 0);
}

/* Parse a unit that follows a number, `pi` or a bracket. */
static qdot_status
parse_unit(parser *p)
{
    const waiting *w = top_of_stack(p);

    return qdot_unit_parse(p->c, w != NULL && (w->kind == OP_POWER || (w->kind == OP_PRODUCT && w->token->text[0] == '/')),
                           p->program);
}

static qdot_status
parse_operand(parser *p)
{
    const qdot_token *t = p->c->at;

    if (t->kind == QDOT_TOKEN_NUMBER) {
        p->c->at++;
        p->operand = false;
        QDOT_TRY(append_instruction(p, QDOT_POSTFIX_NUMBER, t, 0, 0, 0));
        return qdot_token_is(p->c->at, "[") ? parse_unit(p) : QDOT_OK;
    }
    if (t->kind == QDOT_TOKEN_NAME && strcmp(t->text, "not") == 0) {
        p->c->at++;
        return push_on_stack(p, OP_NOT, t);
    }
    if (t->kind == QDOT_TOKEN_NAME && strcmp(t->text, "and") != 0 &&
        strcmp(t->text, "or") != 0)
        return parse_name(p);
    if (qdot_token_is(t, "%"))
        return parse_earlier_answer(p);
    if (qdot_token_is(t, "sqrt")) {
        p->c->at++;
        return push_on_stack(p, OP_ROOT, t);
    }
    if (qdot_token_is(t, "-") || qdot_token_is(t, "+")) {
        p->c->at++;
        return t->text[0] == '-' ? push_on_stack(p, OP_NEGATE, t) : QDOT_OK;
    }
    if (qdot_token_is(t, "(")) {
        p->c->at++;
        return push_on_stack(p, IN_GROUP, t);
    }
    if (qdot_token_is(t, "[")) {
        p->c->at++;
        if (qdot_token_is(p->c->at, "]")) {
            p->c->at++;
            p->operand = false;
            return append_instruction(p, QDOT_POSTFIX_LIST, t, 0, 0, 0);
        }
        return push_on_stack(p, IN_LIST, t);
    }
    return qdot_cursor_expected(p->c, "an expression");
}

/* --- parsing brackets --------------------------------------------------------------- */

static qdot_status
report_usage(parser *p, const waiting *w)
{
    qdot_fail(QDOT_ESYNTAX, w->kind == IN_SUM ? "a sum is sum(EXPR, k, a, b)"
                                              : "a choice is if(CONDITION, A, B)");
    qdot_hint(w->kind == IN_SUM ? "as in sum(k^2, k, 1, 3); a plain sum is a + b"
                                : "as in if(x > 0, x, -x)");
    return fail_at_token(p, w->token, QDOT_ESYNTAX);
}

/* Parse the index k of sum(EXPR, k, a, b), after the first comma. */
static qdot_status
parse_sum_index(parser *p, waiting *w)
{
    w->name = p->c->at;
    if (w->name->kind != QDOT_TOKEN_NAME || !qdot_token_is(w->name + 1, ","))
        return report_usage(p, w);
    p->c->at += 2;
    QDOT_TRY(append_instruction(p, QDOT_POSTFIX_SUM_NEXT, w->token, 0, 0, 0));
    p->program->list.at[w->at].to = (uint32_t)p->program->list.n;
    return QDOT_OK;
}

static qdot_status
parse_comma(parser *p)
{
    waiting *w;

    QDOT_TRY(emit_operators_to_bracket(p));
    w = top_of_stack(p);
    if (w->kind == IN_CALL && w->ranged)
        return qdot_cursor_expected(p->c, "`)`: a range comes last");
    p->c->at++;
    p->operand = true;
    w->count++;
    w->last = (uint32_t)p->program->list.n;
    if (w->kind == IN_SUM) {
        if (w->count == 1)
            return parse_sum_index(p, w);
        return w->count > 2 ? report_usage(p, w) : QDOT_OK;
    }
    if (w->kind == IN_IF) {
        uint32_t here = (uint32_t)p->program->list.n;

        if (w->count > 2)
            return report_usage(p, w);
        QDOT_TRY(append_instruction(p, w->count == 1 ? QDOT_POSTFIX_IF_TEST : QDOT_POSTFIX_IF_ELSE, w->token,
                                    0, 0, 0));
        if (w->count == 2)
            p->program->list.at[w->at].to = here + 1;
        w->at = here;
    }
    return w->kind == IN_CALL && w->indices == 0 ? parse_new_name(p, w->token) : QDOT_OK;
}

/* Parse `;` in [a, b; c, d]: a row of the matrix is complete. */
static qdot_status
row(parser *p)
{
    waiting *w;

    QDOT_TRY(emit_operators_to_bracket(p));
    w = top_of_stack(p);
    if (w->kind != IN_LIST)
        return qdot_cursor_expected(
            p->c, w->kind == IN_INDEX || w->kind == IN_INDEX_NAME || w->kind == IN_LABEL ? "`]`" : "`)`");
    w->count++;
    if (w->columns == 0)
        w->columns = w->count;
    if (w->count % w->columns != 0) {
        qdot_fail(QDOT_ETYPE, "the rows of a matrix are of one length");
        return fail_at_token(p, p->c->at, QDOT_ETYPE);
    }
    p->c->at++;
    if (qdot_token_is(p->c->at, "]")) { /* [a, b;] is a matrix with a single row */
        waiting whole = *w;

        p->c->at++;
        p->stack.n--;
        p->depth--;
        return append_instruction(p, QDOT_POSTFIX_MATRIX, whole.token, whole.count, whole.columns, 0);
    }
    p->operand = true;
    return QDOT_OK;
}

static qdot_status
close_list(parser *p, const waiting *w)
{
    if (w->columns == 0)
        return append_instruction(p, QDOT_POSTFIX_LIST, w->token, w->count + 1, 0, 0);
    if ((w->count + 1) % w->columns != 0) {
        qdot_fail(QDOT_ETYPE, "the rows of a matrix are of one length");
        return fail_at_token(p, p->c->at - 1, QDOT_ETYPE);
    }
    return append_instruction(p, QDOT_POSTFIX_MATRIX, w->token, w->count + 1, w->columns, 0);
}

static qdot_status
close_bracket(parser *p)
{
    waiting w;
    unsigned n;

    QDOT_TRY(emit_operators_to_bracket(p));
    w = *top_of_stack(p);
    p->c->at++;
    p->stack.n--;
    p->depth--;
    switch ((waiting_kind)w.kind) {
    case IN_GROUP:
        return w.count > 0 ? append_instruction(p, QDOT_POSTFIX_VECTOR, w.token, w.count + 1, 0, 0)
                           : QDOT_OK;
    case IN_LIST: return close_list(p, &w);
    case IN_LABEL: return append_instruction(p, QDOT_POSTFIX_LABEL, w.token, w.count + 1, 0, 0);
    case IN_INDEX_NAME:
        n = skip_primes(p);
        if (qdot_token_is(p->c->at, "(") && p->c->at->glued)
            return parse_call(p, w.token, n, w.count + 1);
        return append_instruction(p, QDOT_POSTFIX_INDEX_NAME, w.token, w.count + 1, 0, n);
    case IN_INDEX: return append_instruction(p, QDOT_POSTFIX_INDEX, w.token, w.count + 1, 0, 0);
    case IN_SUM:
        if (w.count != 2)
            return report_usage(p, &w);
        return append_instruction(p, QDOT_POSTFIX_SUM_BEGIN, w.token,
                                  (uint32_t)(w.name - p->c->source->tokens.at), w.at + 1, 0);
    case IN_IF:
        if (w.count != 2)
            return report_usage(p, &w);
        QDOT_TRY(append_instruction(p, QDOT_POSTFIX_IF_END, w.token, 0, 0, 0));
        p->program->list.at[w.at].to = (uint32_t)p->program->list.n;
        return QDOT_OK;
    default:
        if (w.ranged)
            QDOT_TRY(append_instruction(p, QDOT_POSTFIX_RANGE, w.token, w.count + 1, 0, 0));
        else
            QDOT_TRY(append_instruction(p, QDOT_POSTFIX_CALL, w.token, w.count + 1, w.indices, w.primes));
        p->program->list.at[p->program->list.n - 1].last = w.last;
        if (w.passed)
            QDOT_TRY(append_instruction(p, QDOT_POSTFIX_PASS_END, w.token, 0, 0, 0));
        if (w.power == NULL)
            return QDOT_OK;
        QDOT_TRY(append_instruction(p, QDOT_POSTFIX_NUMBER, w.power, 0, 0, 0));
        return append_instruction(p, QDOT_POSTFIX_POWER, w.power, 2, 0, 0);
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
parse_argument_range(parser *p)
{
    waiting *w;

    QDOT_TRY(emit_operators_to_bracket(p));
    w = top_of_stack(p);
    if (w->kind != IN_CALL || w->ranged || w->count == 0 || w->indices > 0 ||
        w->primes > 0 || !may_take_range(w->token->text) ||
        qdot_resolve_is_function(p->c->session, w->token->text))
        return qdot_cursor_expected(p->c, w->kind == IN_CALL ? "`,` or `)`" : "`)`");
    w->ranged = true;
    w->count++;
    w->last = (uint32_t)p->program->list.n;
    p->c->at++;
    p->operand = true;
    return QDOT_OK;
}

/* --- after an operand --------------------------------------------------------------- */

static qdot_status
report_stray_prime(parser *p)
{
    qdot_fail(QDOT_ESYNTAX, "a prime goes directly after a name");
    qdot_hint("the time derivative of an expression is ddt(...)");
    return fail_at_token(p, p->c->at, QDOT_ESYNTAX);
}

static qdot_status
parse_after_operand(parser *p)
{
    const qdot_token *t = p->c->at;

    if (t->glued && qdot_token_is(t, "'"))
        return report_stray_prime(p);
    if (qdot_unit_follows(t))
        return parse_unit(p);
    if (t->glued && qdot_token_is(t, "[")) {
        p->c->at++;
        return push_on_stack(p, IN_INDEX, t);
    }
    if (top_of_stack(p) != NULL && top_of_stack(p)->kind == OP_ROOT && qdot_token_is(t, "^") &&
        !qdot_token_is(t - 1, ")")) {
        qdot_fail(QDOT_ESYNTAX, "a root and a power: which comes first?");
        qdot_hint("write √(x^2) or √(x)^2");
        return fail_at_token(p, t, QDOT_ESYNTAX);
    }
    while (top_of_stack(p) != NULL && (top_of_stack(p)->kind == OP_MEMBER || top_of_stack(p)->kind == OP_ROOT))
        QDOT_TRY(emit_top_operator(p));

    if (t->kind == QDOT_TOKEN_OPERATOR || t->kind == QDOT_TOKEN_NAME)
        for (size_t i = 0; i < sizeof binaries / sizeof *binaries; i++) {
            waiting_kind kind = binaries[i].kind;

            if (strcmp(t->text, binaries[i].text) != 0)
                continue;
            if (p->depth == 0 && p->extent == QDOT_PARSE_SIDE && kind <= OP_RELATION)
                break;
            p->c->at++;
            return parse_binary_operator(p, kind, t);
        }
    if (qdot_cursor_is_shown_product(p->c->session, t, p->depth > 0))
        return parse_binary_operator(p, OP_PRODUCT, t);
    if (p->depth == 0) {
        p->done = true;
        QDOT_TRY(emit_operators_to_bracket(p));
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
    QDOT_TRY(emit_operators_to_bracket(p));
    return qdot_cursor_expected(
        p->c, top_of_stack(p)->kind == IN_LIST || top_of_stack(p)->kind == IN_INDEX ||
                      top_of_stack(p)->kind == IN_INDEX_NAME || top_of_stack(p)->kind == IN_LABEL
                  ? "`]`"
                  : "`)`");
}

static qdot_status
parse_expression(parser *p)
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
    parser p = {.c = c, .program = program, .extent = extent, .operand = true};
    qdot_status status;

    c->error_at = c->at->start;
    status = parse_expression(&p);
    qdot_free(p.stack.at);
    return status;
}
