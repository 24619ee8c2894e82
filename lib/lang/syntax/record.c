/* record.c -- a parsed statement: its words and placeholders ("holes"), and the values of the placeholders. */
#include "lang/syntax/record.h"

#include <inttypes.h>
#include <string.h>

#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/language/read.h"
#include "lang/language/units.h"
#include "lang/session/bind.h"
#include "lang/session/names.h"
#include "lang/session/units.h"
#include "lang/syntax/dimension.h"
#include "lang/syntax/mention.h"

void
qdot_record_free(qdot_record *r)
{
    for (size_t i = 0; i < r->compiled.n; i++)
        qdot_compiled_free(&r->compiled.at[i]);
    qdot_free(r->compiled.at);
    qdot_free(r->parts.at);
    qdot_free(r->usage);
    *r = (qdot_record){0};
}

qdot_record
qdot_record_alone(const qdot_cursor *c, const qdot_statement *row)
{
    qdot_record r = {.row = row, .cursor = *c};

    while (r.cursor.at->kind != QDOT_TOKEN_END)
        r.cursor.at++;
    r.start = r.cursor.at;
    return r;
}

/* --- parts of the statement ---------------------------------------------------------- */

bool
qdot_filled_is(const qdot_filled *part, const char *text)
{
    return strcmp(part->node->text, text) == 0;
}

bool
qdot_filled_is_word(const qdot_filled *part, const char *word)
{
    return part->to == part->from + 1 && qdot_token_is_word(part->from, word);
}

bool
qdot_filled_is_member(const qdot_filled *part, const char *family)
{
    return part->name != NULL && part->n > 0 && strcmp(part->name->text, family) == 0;
}

bool
qdot_record_mentions_besides(const qdot_record *r, const qdot_filled *part, const char *name)
{
    return qdot_mention_is_in(r->start, part->from, name) || qdot_mention_is_in(part->to, r->cursor.at, name);
}

const qdot_token *
qdot_record_own_name(const qdot_record *r, const qdot_filled *part)
{
    const qdot_token *first = NULL;

    for (const qdot_token *at = part->from; at < part->to; at++) {
        if (at->kind != QDOT_TOKEN_NAME)
            continue;
        first = first ? first : at;
        if (strcmp(at->text, "pi") != 0 && qdot_names_find(r->cursor.session->names, at->text) == NULL)
            return at;
    }
    return first;
}

bool
qdot_filled_is_text(const qdot_filled *part)
{
    return part->from->kind == QDOT_TOKEN_STRING;
}

bool
qdot_filled_holds_sign(const qdot_filled *part, char sign)
{
    int64_t depth = 0;

    for (const qdot_token *t = part->from; t < part->to; t++) {
        depth += qdot_token_bracket(t);
        if (depth == 0 && t->kind == QDOT_TOKEN_OPERATOR && t->text[0] == sign)
            return true;
    }
    return false;
}

const qdot_filled *
qdot_record_word(const qdot_record *r, const char *word)
{
    for (size_t i = 0; i < r->parts.n; i++)
        if (r->parts.at[i].node->kind == QDOT_USAGE_WORD && qdot_filled_is(&r->parts.at[i], word))
            return &r->parts.at[i];
    return NULL;
}

const qdot_filled *
qdot_record_hole(const qdot_record *r, const char *before, const char *text)
{
    for (size_t i = 0; i < r->parts.n; i++) {
        const qdot_filled *part = &r->parts.at[i];

        if (part->node->kind == QDOT_USAGE_HOLE &&
            (before == NULL || strcmp(part->node->before, before) == 0) &&
            (text == NULL || qdot_filled_is(part, text)))
            return part;
    }
    return NULL;
}

const qdot_filled *
qdot_record_next(const qdot_record *r, const qdot_filled *part, const char *text)
{
    for (part++; part < r->parts.at + r->parts.n; part++)
        if (part->node->kind == QDOT_USAGE_HOLE && qdot_filled_is(part, text))
            return part;
    return NULL;
}

/* --- dimensions ------------------------------------------------------------------------ */

/* The coordinate behind `on`; nil: there is none. */
static qdot_status
find_coordinate_acted_on(qdot_record *r, qdot_expr *q)
{
    const qdot_filled *on = qdot_record_hole(r, "on", NULL);
    const qdot_name *known;
    const char *name;

    *q = QDOT_NIL;
    if (on == NULL || on->name == NULL)
        return QDOT_OK;
    QDOT_TRY(qdot_record_name(r, on, &name));
    known = qdot_names_find(r->cursor.session->names, name);
    if (known != NULL && known->kind == QDOT_NAME_COORD)
        *q = known->value;
    return QDOT_OK;
}

/* The value of the compiled expression `of` of this part has the dimension that belongs there. */
static qdot_status
check_dimension(qdot_record *r, const qdot_filled *part, size_t of, qdot_expr value)
{
    qdot_session *session = r->cursor.session;
    qdot_expr on;

    if (!qdot_units_on(session) || value == QDOT_NIL)
        return QDOT_OK;
    QDOT_TRY(find_coordinate_acted_on(r, &on));
    r->cursor.error_at = r->compiled.at[of].from->start;
    return qdot_hole_dimension(session, r->row->word, part->node, on, value);
}

/* --- evaluating parts ---------------------------------------------------------------- */

qdot_status
qdot_record_value(qdot_record *r, const qdot_filled *part, qdot_expr *value)
{
    QDOT_TRY(qdot_compiled_value(&r->cursor, &r->compiled.at[part->first], value));
    return check_dimension(r, part, part->first, *value);
}

qdot_status
qdot_record_named(qdot_record *r, const qdot_filled *part, qdot_expr *value, qdot_expr *over)
{
    return qdot_compiled_named(&r->cursor, &r->compiled.at[part->first], value, over);
}

qdot_status
qdot_record_scalar(qdot_record *r, const qdot_filled *part, qdot_expr *value)
{
    QDOT_TRY(qdot_compiled_scalar(&r->cursor, &r->compiled.at[part->first], value));
    return check_dimension(r, part, part->first, *value);
}

qdot_status
qdot_record_point(qdot_record *r, const qdot_filled *part, qdot_expr *value)
{
    QDOT_TRY(qdot_compiled_point(&r->cursor, &r->compiled.at[part->first], value));
    return check_dimension(r, part, part->first, *value);
}

qdot_status
qdot_record_number(qdot_record *r, const qdot_filled *part, double *value)
{
    return qdot_compiled_number(&r->cursor, &r->compiled.at[part->first], value);
}

qdot_status
qdot_record_range(qdot_record *r, const qdot_filled *part, qdot_expr *from, qdot_expr *to)
{
    const qdot_token *unit = qdot_compiled_unit(&r->compiled.at[part->first + 1], false);
    qdot_expr factor;

    QDOT_TRY(qdot_record_item(r, part, 0, from));
    QDOT_TRY(qdot_record_item(r, part, 1, to));
    if (unit == NULL || !qdot_expr_is_constant(r->cursor.session->pool, *from))
        return QDOT_OK;
    /* 5..20 [min]: the unit of the upper end is that of a bare lower one, too */
    bool angle;

    QDOT_TRY(qdot_read_unit(r->cursor.session, unit, &factor, &angle, &unit));
    *from = qdot_mul(r->cursor.session->pool, *from, factor);
    return qdot_pool_check(r->cursor.session->pool);
}

qdot_status
qdot_record_integer(qdot_record *r, const qdot_filled *part, int64_t *value)
{
    return qdot_compiled_integer(&r->cursor, &r->compiled.at[part->first], value);
}

qdot_status
qdot_record_item(qdot_record *r, const qdot_filled *part, size_t k, qdot_expr *value)
{
    QDOT_TRY(qdot_compiled_scalar(&r->cursor, &r->compiled.at[part->first + k], value));
    return check_dimension(r, part, part->first + k, *value);
}

qdot_status
qdot_record_side(qdot_record *r, const qdot_filled *part, size_t k, qdot_expr *value)
{
    return qdot_compiled_value(&r->cursor, &r->compiled.at[part->first + k], value);
}

qdot_status
qdot_record_equation(qdot_record *r, const qdot_filled *part, bool motion, qdot_expr *left,
                     qdot_expr *right)
{
    qdot_status (*const evaluate)(qdot_cursor *, const qdot_compiled *, qdot_expr *) =
        motion ? qdot_compiled_motion : qdot_compiled_value;
    const qdot_compiled *sides = &r->compiled.at[part->first];
    const qdot_pool *pool = r->cursor.session->pool;
    qdot_expr equation;

    QDOT_TRY(evaluate(&r->cursor, &sides[0], left));
    if (part->n == 2) {
        QDOT_TRY(evaluate(&r->cursor, &sides[1], right));
        r->cursor.error_at = sides[0].to->start;
        return qdot_units_join(r->cursor.session, *left, *right, "%s is set equal to %s");
    }
    equation = *left;
    if (qdot_expr_kind(pool, equation) != QDOT_REL || qdot_expr_node(pool, equation)->op != QDOT_EQ)
        return qdot_record_expected(r, part->to, "`=` and the other side");
    *left = qdot_expr_arg(pool, equation, 0);
    *right = qdot_expr_arg(pool, equation, 1);
    return QDOT_OK;
}

/* Write name[i,j] with evaluated indices, as a text in the arena of the source. */
static qdot_status
write_indexed_name(const qdot_record *r, const char *name, size_t n, const int64_t *index, const char **spelled)
{
    qdot_text text = {0};
    qdot_status status;

    qdot_text_add(&text, name);
    for (size_t i = 0; i < n; i++)
        qdot_text_format(&text, "%c%" PRId64, i == 0 ? '[' : ',', index[i]);
    qdot_text_char(&text, ']');
    status = qdot_text_status(&text);
    *spelled = status == QDOT_OK ? qdot_arena_strndup(r->cursor.source->arena, text.at, text.n) : NULL;
    qdot_text_clear(&text);
    return *spelled == NULL && status == QDOT_OK ? QDOT_ENOMEM : status;
}

qdot_status
qdot_record_name(qdot_record *r, const qdot_filled *part, const char **name)
{
    qdot_vec(int64_t) index = {0};
    qdot_status status = QDOT_OK;

    *name = part->name->text;
    for (size_t i = 0; i < part->n && status == QDOT_OK; i++) {
        const qdot_compiled *one = &r->compiled.at[part->first + i];
        int64_t value = 0;

        if (one->from < part->name || one->from >= part->primes)
            continue; /* these tokens belong to a bound, not to the name */
        status = qdot_compiled_integer(&r->cursor, one, &value);
        if (status == QDOT_OK)
            status = qdot_vec_push(&index, value);
    }
    if (status == QDOT_OK && index.n > 0)
        status = write_indexed_name(r, *name, index.n, index.at, name);
    qdot_free(index.at);
    return status;
}

qdot_status
qdot_record_new_name(qdot_record *r, const qdot_filled *part, const char **name)
{
    QDOT_TRY(qdot_record_name(r, part, name));
    if (qdot_names_find(r->cursor.session->names, *name) == NULL)
        return QDOT_OK;
    qdot_record_blame(r, part);
    return qdot_fail(QDOT_ENAME, "`%s` means something else already", *name);
}

/* Whether it is the unit of a declared name, as in `coord x [m]`. */
static bool
is_unit_alone(const qdot_compiled *one)
{
    return one->code.list.n == 1 && one->code.list.at[0].op == QDOT_POSTFIX_UNIT;
}

qdot_status
qdot_record_unit(qdot_record *r, const qdot_filled *part, const qdot_filled *value, qdot_expr *unit, bool *angle)
{
    const qdot_token *open = NULL, *blame;

    for (size_t i = 0; i < part->n; i++) {
        const qdot_compiled *one = &r->compiled.at[part->first + i];

        if ((one->from < part->name || one->from >= part->primes) && qdot_compiled_unit(one, false) != NULL)
            open = qdot_compiled_unit(one, false);
    }
    if (value != NULL && open == NULL)
        open = qdot_compiled_unit(&r->compiled.at[value->first], false);
    *unit = QDOT_NIL;
    *angle = false;
    if (open == NULL)
        return QDOT_OK;
    blame = open;
    const qdot_status status = qdot_read_unit(r->cursor.session, open, unit, angle, &blame);

    r->cursor.error_at = status != QDOT_OK ? blame->start : r->cursor.error_at;
    return status;
}

qdot_status
qdot_record_bound(qdot_record *r, const qdot_filled *part, size_t k, qdot_bound *bound, bool *is)
{
    for (size_t i = 0; i < part->n; i++) {
        const qdot_compiled *one = &r->compiled.at[part->first + i];
        const bool before = one->from < part->name;
        const char *relation = before ? one->to->text : one->from[-1].text;

        if ((!before && one->from < part->primes) || is_unit_alone(one) || k-- > 0)
            continue;
        *is = true;
        *bound = (qdot_bound){.at = one->from, .upper = (relation[0] == '<') != before, .strict = relation[1] == '\0'};
        return qdot_compiled_value(&r->cursor, one, &bound->value);
    }
    *is = false;
    return QDOT_OK;
}

/* Evaluate the instructions [0, at), which leave n values on the stack, as a list. */
static qdot_status
evaluate_as_list(qdot_record *r, const qdot_compiled *whole, size_t at, uint32_t n, qdot_expr *list)
{
    const qdot_token *token = whole->code.list.at[at].token;
    qdot_compiled part = {.from = whole->from, .to = whole->to};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < at && status == QDOT_OK; i++)
        status = qdot_vec_push(&part.code.list, whole->code.list.at[i]);
    if (status == QDOT_OK)
        status = qdot_vec_push(&part.code.list, ((qdot_postfix){.op = QDOT_POSTFIX_LIST, .n = n, .token = token}));
    if (status == QDOT_OK)
        status = qdot_compiled_value(&r->cursor, &part, list);
    qdot_compiled_free(&part);
    return status;
}

/* Write the name for which the instructions [0, at] stand; its indices come before the name. */
static qdot_status
write_name_of_code(qdot_record *r, const qdot_compiled *whole, size_t at, const char **name)
{
    const qdot_postfix *last = &whole->code.list.at[at];
    qdot_session *session = r->cursor.session;
    int64_t index[QDOT_RECORD_INDICES];
    qdot_expr list = QDOT_NIL;

    *name = last->token->text;
    if (last->n == 0 || last->n > QDOT_RECORD_INDICES) {
        *name = last->n == 0 ? *name : NULL;
        return QDOT_OK;
    }
    QDOT_TRY(evaluate_as_list(r, whole, at, last->n, &list));
    for (uint32_t i = 0; i < last->n; i++)
        QDOT_TRY(qdot_session_integer(session, qdot_expr_arg(session->pool, list, i), &index[i]));
    return write_indexed_name(r, *name, last->n, index, name);
}

qdot_status
qdot_record_bare_name(qdot_record *r, const qdot_filled *part, size_t k, const char **name)
{
    const qdot_compiled *whole = &r->compiled.at[part->first + k];
    const size_t last = whole->code.list.n - 1;
    const qdot_postfix *code = &whole->code.list.at[last];

    *name = NULL;
    return (code->op == QDOT_POSTFIX_NAME || code->op == QDOT_POSTFIX_INDEX_NAME) &&
                   code->token == whole->from && code->primes == 0
               ? write_name_of_code(r, whole, last, name)
               : QDOT_OK;
}

qdot_status
qdot_record_label_in(qdot_record *r, const qdot_filled *part, const char *function, const char **label)
{
    const qdot_compiled *whole = &r->compiled.at[part->first];
    const qdot_postfix *call = &whole->code.list.at[whole->code.list.n - 1];

    *label = NULL;
    if (call->op != QDOT_POSTFIX_CALL || call->token != whole->from || call->to > 0 ||
        strcmp(call->token->text, function) != 0)
        return QDOT_OK;
    for (size_t i = 0; i + 1 < whole->code.list.n; i++)
        if (whole->code.list.at[i].op == QDOT_POSTFIX_LABEL)
            return write_name_of_code(r, whole, i, label);
    return QDOT_OK;
}

qdot_status
qdot_record_formals(qdot_record *r, const qdot_filled *call, qdot_formals *f)
{
    qdot_cursor c = r->cursor;

    c.at = call->primes;
    *f = (qdot_formals){0};
    return qdot_formals_read(&c, &f->list, &f->names, &f->n);
}

qdot_status
qdot_record_body(qdot_record *r, const qdot_filled *part, qdot_formals *f, qdot_expr *body)
{
    QDOT_TRY(qdot_formals_enter(r->cursor.session, f));
    return qdot_record_value(r, part, body);
}

qdot_status
qdot_record_call_of_two(qdot_record *r, const qdot_filled *part, const char *function, qdot_expr *values,
                        bool *is)
{
    const qdot_compiled *whole = &r->compiled.at[part->first];
    const size_t last = whole->code.list.n - 1;
    const qdot_postfix *call = &whole->code.list.at[last];
    qdot_expr list = QDOT_NIL;

    *is = call->op == QDOT_POSTFIX_CALL && call->token == whole->from && call->to == 0 && call->n == 2 &&
          strcmp(call->token->text, function) == 0;
    if (!*is)
        return QDOT_OK;
    QDOT_TRY(evaluate_as_list(r, whole, last, 2, &list));
    for (uint32_t i = 0; i < 2; i++)
        values[i] = qdot_expr_arg(r->cursor.session->pool, list, i);
    return QDOT_OK;
}

qdot_status
qdot_record_coordinate(qdot_record *r, const qdot_filled *part, qdot_expr *jet)
{
    const char *name;

    QDOT_TRY(qdot_record_name(r, part, &name));
    return qdot_read_jet_of(&r->cursor, part->from, name, (uint32_t)(part->to - part->primes), jet);
}

const char *
qdot_record_text(const qdot_filled *part)
{
    return part->from->text;
}

/* --- reporting errors ---------------------------------------------------------------- */

void
qdot_record_blame(qdot_record *r, const qdot_filled *part)
{
    r->cursor.error_at = part->from->start;
}

qdot_status
qdot_record_expected(qdot_record *r, const qdot_token *at, const char *what)
{
    qdot_cursor c = r->cursor;
    qdot_status status;

    c.at = at;
    status = qdot_cursor_expected(&c, what);
    r->cursor.error_at = c.error_at;
    return status;
}

qdot_status
qdot_record_no_prime(qdot_record *r, const qdot_filled *part, const char *what)
{
    return part->primes < part->to ? qdot_record_expected(r, part->primes, what) : QDOT_OK;
}
