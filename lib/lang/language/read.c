/* read.c -- reads operands of statements: parses an expression and evaluates it, at once or later. */
#include "lang/language/read.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/value-kind.h"
#include "lang/language/compiled.h"
#include "lang/language/hints.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "lang/session/held.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/momenta.h"
#include "lang/session/range.h"
#include "mech/scene/scene.h"

/* --- parsed expressions, evaluated later --------------------------------------------- */

qdot_status
qdot_compiled_parse(qdot_cursor *c, qdot_parse_extent extent, qdot_compiled *program)
{
    qdot_status status;

    *program = (qdot_compiled){.from = c->at};
    status = qdot_parse(c, extent, &program->code);
    program->to = c->at;
    return status;
}

void
qdot_compiled_free(qdot_compiled *program)
{
    qdot_free(program->code.list.at);
    *program = (qdot_compiled){0};
}

/* --- what a parsed expression holds --------------------------------------------------- */

const char *
qdot_compiled_next_name(const qdot_compiled *program, uint32_t *k)
{
    while (*k < program->code.list.n) {
        const qdot_token *token = program->code.list.at[(*k)++].token;

        if (token != NULL && token->kind == QDOT_TOKEN_NAME)
            return token->text;
    }
    return NULL;
}

bool
qdot_compiled_is_list(const qdot_compiled *program)
{
    const size_t n = program->code.list.n;
    const qdot_postfix *at = program->code.list.at;

    return n > 0 && (at[n - 1].op == QDOT_POSTFIX_LIST || at[n - 1].op == QDOT_POSTFIX_MATRIX);
}

const char *
qdot_compiled_member_of(const qdot_compiled *program, int64_t *k)
{
    const qdot_postfix *code = program->code.list.at;
    char *rest;

    if (program->code.list.n != 2 || code[0].op != QDOT_POSTFIX_NUMBER || code[1].op != QDOT_POSTFIX_INDEX_NAME ||
        code[1].primes > 0)
        return NULL;
    *k = strtoll(code[0].token->text, &rest, 10);
    return *rest == '\0' ? code[1].token->text : NULL;
}

bool
qdot_postfix_reads_way(const qdot_postfix *code)
{
    return (code->op == QDOT_POSTFIX_CALL || code->op == QDOT_POSTFIX_RANGE) && qdot_range_is_of_way(code->token->text);
}

bool
qdot_compiled_reads_way(const qdot_compiled *program)
{
    for (size_t i = 0; i < program->code.list.n; i++)
        if (qdot_postfix_reads_way(&program->code.list.at[i]))
            return true;
    return false;
}

/* Whether an expression that is being read may depend on the motion, that is on coordinates or time. */
typedef enum { NOTHING, MOTION } course;

/* Evaluate; along a motion a coordinate that a loop sets is still a variable, as the loop only sets
 * its start. */
static qdot_status
evaluate_program(qdot_cursor *c, const qdot_compiled *program, course along, qdot_expr *value,
                 qdot_expr *over, const char **run)
{
    c->error_at = program->from->start;
    QDOT_TRY(qdot_evaluate(c, &program->code, value, over, run));
    if (c->session->evaluation->declares) { /* in declarations momenta are replaced by velocities, and numbers are exact */
        *value = qdot_momenta_to_velocities(c->session, qdot_measured_as_rationals(c->session, *value));
        return qdot_value_kind_check(c->session->pool, *value);
    }
    if (c->session->evaluation->held.n == 0)
        return QDOT_OK;
    *value = along == MOTION ? qdot_held_parameters(c->session, *value)
                             : qdot_held_apply(c->session, *value);
    return qdot_value_kind_check(c->session->pool, *value);
}

qdot_status
qdot_compiled_value(qdot_cursor *c, const qdot_compiled *program, qdot_expr *value)
{
    return evaluate_program(c, program, NOTHING, value, NULL, NULL);
}

qdot_status
qdot_compiled_named(qdot_cursor *c, const qdot_compiled *program, qdot_expr *value, qdot_expr *over)
{
    return evaluate_program(c, program, NOTHING, value, over, NULL);
}

qdot_status
qdot_compiled_motion(qdot_cursor *c, const qdot_compiled *program, qdot_expr *value)
{
    return evaluate_program(c, program, MOTION, value, NULL, NULL);
}

qdot_status
qdot_compiled_member(qdot_cursor *c, const qdot_compiled *program, qdot_expr *value, const char **run)
{
    *run = NULL;
    return evaluate_program(c, program, MOTION, value, NULL, run);
}

/* Fail at the token `at` because the value is not of the kind that is wanted. */
static qdot_status
report_wrong_kind(qdot_cursor *c, const qdot_token *at, const char *wanted, qdot_expr value)
{
    c->error_at = at->start;
    return qdot_fail(QDOT_ETYPE, "%s belongs here, not %s", wanted,
                     qdot_value_kind_words(c->session->pool, value));
}

static bool
is_number(const qdot_pool *pool, qdot_expr value)
{
    return qdot_expr_is_scalar(pool, value) && value != QDOT_TRUE && value != QDOT_FALSE;
}

/* Refuse a.x, a value along a run, where a number is needed. */
static qdot_status
refuse_value_along_run(qdot_cursor *c, const qdot_token *start, qdot_expr value)
{
    const qdot_status status = qdot_member_refuse(c->session, value);

    if (status != QDOT_OK)
        c->error_at = start->start;
    return status;
}

qdot_status
qdot_compiled_scalar(qdot_cursor *c, const qdot_compiled *program, qdot_expr *value)
{
    QDOT_TRY(qdot_compiled_value(c, program, value));
    if (!is_number(c->session->pool, *value))
        return report_wrong_kind(c, program->from, "a number", *value);
    c->error_at = program->from->start;
    QDOT_TRY(qdot_infinity_refuse(c->session->pool, *value));
    return refuse_value_along_run(c, program->from, *value);
}

qdot_status
qdot_compiled_point(qdot_cursor *c, const qdot_compiled *program, qdot_expr *value)
{
    const qdot_token *start = program->from;
    const qdot_pool *pool = c->session->pool;

    QDOT_TRY(qdot_compiled_value(c, program, value));
    c->error_at = start->start;
    QDOT_TRY(qdot_infinity_refuse(pool, *value));
    QDOT_TRY(refuse_value_along_run(c, start, *value));
    if (qdot_expr_kind(pool, *value) == QDOT_VEC) {
        if (qdot_expr_count(pool, *value) <= 3)
            return QDOT_OK;
        c->error_at = start->start;
        return qdot_fail(QDOT_ETYPE, "a place has 1, 2 or 3 components, not %u",
                         qdot_expr_count(pool, *value));
    }
    if (!is_number(pool, *value))
        return report_wrong_kind(c, start, "a place or a vector", *value);
    return QDOT_OK;
}

qdot_status
qdot_compiled_number(qdot_cursor *c, const qdot_compiled *program, double *value)
{
    qdot_expr e;

    QDOT_TRY(qdot_compiled_scalar(c, program, &e));
    c->error_at = program->from->start;
    return qdot_session_number(c->session, e, value, NULL);
}

qdot_status
qdot_compiled_integer(qdot_cursor *c, const qdot_compiled *program, int64_t *value)
{
    qdot_expr e;

    QDOT_TRY(qdot_compiled_scalar(c, program, &e));
    c->error_at = program->from->start;
    return qdot_session_integer(c->session, e, value);
}

/* --- parsed and evaluated at once ------------------------------------------------------ */

typedef qdot_status (*compiled_reader)(qdot_cursor *c, const qdot_compiled *program, qdot_expr *value);

static qdot_status
read_and_evaluate(qdot_cursor *c, qdot_parse_extent extent, compiled_reader reader, qdot_expr *value)
{
    qdot_compiled program;
    qdot_status status = qdot_compiled_parse(c, extent, &program);

    if (status == QDOT_OK)
        status = reader(c, &program, value);
    qdot_compiled_free(&program);
    return status;
}

qdot_status
qdot_read_value(qdot_cursor *c, qdot_expr *value)
{
    return read_and_evaluate(c, QDOT_PARSE_VALUE, qdot_compiled_value, value);
}

qdot_status
qdot_read_named(qdot_cursor *c, qdot_expr *value, qdot_expr *over)
{
    qdot_compiled program;
    qdot_status status = qdot_compiled_parse(c, QDOT_PARSE_VALUE, &program);

    if (status == QDOT_OK)
        status = qdot_compiled_named(c, &program, value, over);
    qdot_compiled_free(&program);
    return status;
}

qdot_status
qdot_read_scalar(qdot_cursor *c, qdot_expr *value)
{
    return read_and_evaluate(c, QDOT_PARSE_SIDE, qdot_compiled_scalar, value);
}

/* Read an index of a name and evaluate it with the values of parameters. */
static qdot_status
read_name_index(qdot_cursor *c, int64_t *value)
{
    qdot_compiled program;
    qdot_status status = qdot_compiled_parse(c, QDOT_PARSE_SIDE, &program);

    if (status == QDOT_OK)
        status = qdot_compiled_integer(c, &program, value);
    qdot_compiled_free(&program);
    return status;
}

/* --- names -------------------------------------------------------------------------- */

/* Read the indices [i, j] after a name; the cursor is past `[`. */
static qdot_status
read_indices(qdot_cursor *c, qdot_text *name)
{
    char separator = '[';

    do {
        int64_t k;

        QDOT_TRY(read_name_index(c, &k));
        qdot_text_format(name, "%c%" PRId64, separator, k);
        separator = ',';
    } while (qdot_cursor_accept_op(c, ","));
    qdot_text_char(name, ']');
    return qdot_cursor_expect_op(c, "]");
}

qdot_status
qdot_read_name(qdot_cursor *c, const char **name)
{
    qdot_text spelled = {0};
    qdot_status status;

    if (c->at->kind != QDOT_TOKEN_NAME)
        return qdot_cursor_expected(c, "a name");
    *name = c->at->text;
    c->at++;
    if (!c->at->glued || !qdot_cursor_accept_op(c, "["))
        return QDOT_OK;
    qdot_text_add(&spelled, *name);
    status = read_indices(c, &spelled);
    if (status == QDOT_OK)
        status = qdot_text_status(&spelled);
    if (status == QDOT_OK) {
        *name = qdot_arena_strndup(c->source->arena, spelled.at, spelled.n);
        status = *name != NULL ? QDOT_OK : QDOT_ENOMEM;
    }
    qdot_text_clear(&spelled);
    return status;
}

qdot_status
qdot_read_jet_of(qdot_cursor *c, const qdot_token *start, const char *name, uint32_t order,
                 qdot_expr *jet)
{
    qdot_pool *pool = c->session->pool;
    const qdot_name *entry = qdot_names_find(c->session->names, name);

    c->error_at = start->start;
    if (entry != NULL && entry->kind == QDOT_NAME_SPEED) {
        (void)qdot_fail(QDOT_ENAME, "`%.200s` is a speed, not a coordinate", name);
        return qdot_hint("give the velocities of coordinates");
    }
    if (entry == NULL || !qdot_expr_is_coordinate(pool, entry->value)) {
        const char *near = entry == NULL ? qdot_hints_nearest(c->session, name) : name;

        if (near == NULL || strcmp(near, name) != 0)
            return qdot_hints_unknown_coordinate(c, start, name);
        (void)qdot_fail(QDOT_ENAME, "`%.200s` is not a coordinate", name);
        return entry != NULL && entry->kind == QDOT_NAME_PARAM
                   ? qdot_hint("set %.200s = ...", name)
                   : QDOT_ENAME;
    }
    *jet = order > 0 ? qdot_symbol_jet(pool, entry->value, order) : entry->value;
    *jet = qdot_higher_in_motion(c->session->scene, *jet);
    return qdot_value_kind_check(pool, *jet);
}

qdot_status
qdot_cursor_accept_run(qdot_cursor *c, const qdot_token **run)
{
    qdot_cursor look = *c;
    const qdot_token *behind = c->at + 1;
    qdot_token *spelled;
    const char *name;
    int64_t depth = 0;

    *run = NULL;
    for (;; behind++) {
        if (behind->kind == QDOT_TOKEN_END)
            return QDOT_OK;
        depth += qdot_token_is(behind, "[");
        depth -= qdot_token_is(behind, "]");
        if (depth == 0)
            break;
    }
    if (!qdot_token_is(behind + 1, ".") || !behind[1].glued || !behind[2].glued ||
        (behind[2].kind != QDOT_TOKEN_NAME && !qdot_token_is(behind + 2, "(")))
        return QDOT_OK;
    QDOT_TRY(qdot_read_name(&look, &name));
    spelled = qdot_arena_take(c->source->arena, sizeof *spelled);
    if (spelled == NULL)
        return QDOT_ENOMEM;
    *spelled = *c->at;
    spelled->text = name;
    *run = spelled;
    c->at = behind + 2;
    return QDOT_OK;
}
