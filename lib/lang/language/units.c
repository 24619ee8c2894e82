/* units.c -- units in expressions: their values, and what sums, relations and functions say of dimensions. */
#include "lang/language/units.h"

#include "base/text.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "expr/unit.h"
#include "lang/session/measured.h"
#include "lang/session/units.h"

/* The token of which the byte `at` of the joined texts is one. */
static const qdot_token *
token_at(const qdot_token *first, const qdot_token *end, size_t at)
{
    for (; first + 1 < end && at >= strlen(first->text); first++)
        at -= strlen(first->text);
    return first;
}

qdot_status
qdot_read_unit(qdot_session *session, const qdot_token *open, qdot_expr *value, bool *angle, const qdot_token **blame)
{
    const qdot_token *end = qdot_token_behind_bracket(open) - 1;
    qdot_pool *pool = session->pool;
    qdot_text text = {0};
    qdot_expr factor;
    qdot_unit unit;
    qdot_status status;
    size_t at = 0;

    for (const qdot_token *t = open + 1; t < end; t++)
        if (t > open + 1 && !t->glued && t->kind != QDOT_TOKEN_OPERATOR && t[-1].kind != QDOT_TOKEN_OPERATOR)
            qdot_text_format(&text, " %s", t->text); /* two names side by side are no unit */
        else
            qdot_text_add(&text, t->text);
    qdot_unit_init(&unit);
    status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = qdot_unit_read(qdot_text_str(&text), &unit, &at);
    *blame = token_at(open + 1, end, at);
    if (status == QDOT_OK)
        status = qdot_units_base(session, unit.dimension, value);
    if (status == QDOT_OK) {
        factor = qdot_mul(pool, qdot_expr_fmpq(pool, unit.factor), qdot_pow(pool, QDOT_PI, qdot_expr_int(pool, unit.pi)));
        *value = qdot_mul(pool, factor, *value);
        *angle = unit.angle;
        status = qdot_pool_check(pool);
    }
    qdot_unit_clear(&unit);
    qdot_text_clear(&text);
    return status;
}

/* --- parsing ---------------------------------------------------------------------------- */

static qdot_status
append_unit(qdot_cursor *c, qdot_postfix_kind op, uint32_t n, qdot_postfix_list *program)
{
    const qdot_token *open = c->at;

    c->at = qdot_token_behind_bracket(open);
    if (c->at == open)
        return qdot_cursor_expected(c, "a unit in brackets, as in [m/s^2]");
    return qdot_vec_push(&program->list, ((qdot_postfix){.op = (uint8_t)op, .n = n, .token = open}));
}

bool
qdot_unit_follows(const qdot_token *t)
{
    return !t->glued && qdot_token_is(t, "[") && (qdot_token_is(t - 1, ")") || qdot_token_is_word(t - 1, "pi"));
}

qdot_status
qdot_unit_parse(qdot_cursor *c, bool below, qdot_postfix_list *program)
{
    const qdot_token *number = c->at - 1;

    if (below && number->kind == QDOT_TOKEN_NUMBER) {
        qdot_fail(QDOT_ESYNTAX, "the unit belongs to %.40s alone: is that meant?", number->text);
        c->error_at = c->at->start;
        return qdot_hint("brackets say it: `(1/2) [m]` or `1/(2 [m])`");
    }
    QDOT_TRY(append_unit(c, QDOT_POSTFIX_UNIT, 1, program));
    if (!qdot_token_is(c->at, "^"))
        return QDOT_OK;
    qdot_fail(QDOT_ESYNTAX, "a power behind a unit: of the unit alone, or of the number too?");
    c->error_at = c->at->start;
    return qdot_hint("brackets say it: `2 [m^2]` or `(2 [m])^2`");
}

qdot_status
qdot_unit_parse_alone(qdot_cursor *c, qdot_postfix_list *program)
{
    return append_unit(c, QDOT_POSTFIX_UNIT, 0, program);
}

qdot_status
qdot_unit_parse_in(qdot_cursor *c, qdot_postfix_list *program)
{
    if (!qdot_token_is_word(c->at, "in") || !qdot_token_is(c->at + 1, "["))
        return QDOT_OK;
    c->at++;
    return append_unit(c, QDOT_POSTFIX_IN, 1, program);
}

/* --- evaluating ------------------------------------------------------------------------- */

qdot_status
qdot_machine_unit(qdot_machine *m, const qdot_postfix *code)
{
    qdot_slot *top = code->n == 0 ? NULL : qdot_machine_top(m, 1);
    const bool in = code->op == QDOT_POSTFIX_IN;
    qdot_expr unit;
    bool angle;

    QDOT_TRY(qdot_read_unit(m->session, code->token, &unit, &angle, &m->blame));
    if (top == NULL)
        return qdot_machine_push(m, unit);
    if (in) {
        m->blame = code->token;
        QDOT_TRY(qdot_units_join(m->session, top->value, unit, "%s is asked for in the unit of %s"));
    }
    top->value = (in ? qdot_value_div : qdot_value_mul)(m->pool, top->value, unit);
    return qdot_value_kind_check(m->pool, top->value);
}

qdot_status
qdot_machine_units_sum(qdot_machine *m, size_t n)
{
    size_t left = n; /* the first summand that is not 0 */

    for (size_t i = n - 1; i > 0; i--) {
        const qdot_slot *s = qdot_machine_top(m, i);
        const bool minus = s->sign->text[0] == '-';

        m->blame = s->sign;
        QDOT_TRY(qdot_units_join(m->session, qdot_machine_top(m, left)->value, s->value,
                                 minus ? "from %s %s is subtracted" : "%s is added to %s"));
        if (qdot_machine_top(m, left)->value == QDOT_ZERO)
            left = i;
    }
    return QDOT_OK;
}

qdot_status
qdot_machine_units_terms(qdot_machine *m)
{
    size_t left = 0; /* the first term that is not 0 */

    for (size_t i = 1; i < m->args.n; i++) {
        if (m->args.at[left] == QDOT_ZERO)
            left = i;
        QDOT_TRY(qdot_units_join(m->session, m->args.at[left], m->args.at[i], "%s and %s are terms of one sum"));
    }
    return QDOT_OK;
}

qdot_status
qdot_machine_units_relation(qdot_machine *m, const qdot_token *relation)
{
    m->blame = relation;
    return qdot_units_join(m->session, qdot_machine_top(m, 2)->value, qdot_machine_top(m, 1)->value,
                           relation->text[0] == '=' ? "%s is set equal to %s" : "%s is compared with %s");
}

/* The number *value of the expression `of` has the unit of that. */
static qdot_status
give_unit(qdot_session *session, qdot_expr of, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    qdot_dimension is;
    qdot_expr unit;

    if (!qdot_measured_occurs(session, *value) || qdot_expr_has_units(pool, *value))
        return QDOT_OK;
    if (qdot_units_of(session, of, &is) != QDOT_DIMENSION_KNOWN)
        return QDOT_OK;
    QDOT_TRY(qdot_units_base(session, is, &unit));
    *value = qdot_mul(pool, *value, unit);
    return qdot_pool_check(pool);
}

/* The k-th of the expressions args [n], in which vectors and lists count by their entries; nil: there are not so many. */
static qdot_expr
entry_of_arguments(const qdot_pool *pool, uint32_t n, const qdot_expr *args, uint32_t k)
{
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t count = qdot_expr_is_scalar(pool, args[i]) ? 1 : qdot_expr_count(pool, args[i]);

        if (k < count)
            return qdot_expr_is_scalar(pool, args[i]) ? args[i] : qdot_expr_arg(pool, args[i], k);
        k -= count;
    }
    return QDOT_NIL;
}

/* x, or the left side of x = guess. */
static qdot_expr
unknown_of(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_REL ? qdot_expr_arg(pool, e, 0) : e;
}

/* The numbers of *value, one or the entries of a vector or list, have the units of those of args [n], from the first again
 * where these are fewer. */
static qdot_status
give_units(qdot_session *session, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    const bool scalar = qdot_expr_is_scalar(pool, *value);
    uint32_t count = 0;
    qdot_vec(qdot_expr) entries = {0};
    qdot_status status = QDOT_OK;

    while (entry_of_arguments(pool, n, args, count) != QDOT_NIL)
        count++;
    for (uint32_t i = 0; i < (scalar ? 1 : qdot_expr_count(pool, *value)) && count > 0 && status == QDOT_OK; i++) {
        qdot_expr one = scalar ? *value : qdot_expr_arg(pool, *value, i);

        if (qdot_expr_is_scalar(pool, one))
            status = give_unit(session, unknown_of(pool, entry_of_arguments(pool, n, args, i % count)), &one);
        if (status == QDOT_OK)
            status = qdot_vec_push(&entries, one);
    }
    if (status != QDOT_OK || entries.n == 0)
        ;
    else if (scalar)
        *value = entries.at[0];
    else if (qdot_expr_kind(pool, *value) == QDOT_VEC)
        *value = qdot_vector(pool, (uint32_t)entries.n, entries.at);
    else if (qdot_expr_kind(pool, *value) == QDOT_LIST)
        *value = qdot_list(pool, (uint32_t)entries.n, entries.at);
    qdot_free(entries.at);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* The zeros of solve(A = B, x, a..b) or solve(A = B, x = guess) have the unit of x, and so have a and b; a bare time is in s. */
static qdot_status
units_of_zeros(qdot_session *session, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    for (uint32_t i = 2; i < n; i++)
        if (args[1] != QDOT_T || !qdot_expr_is_constant(session->pool, args[i]))
            QDOT_TRY(qdot_units_join(session, args[1], args[i], "the range of %s has an end that is %s"));
    return n > 1 ? give_units(session, 1, args + 1, value) : QDOT_OK;
}

/* The action of a coordinate q has the unit of p q, its energy that of p q'. */
static qdot_status
unit_of_action(qdot_session *session, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    const qdot_expr q = args[0], p = qdot_symbol_of(pool, QDOT_MOMENTUM, q), action = qdot_mul(pool, p, q);

    if (n == 2)
        QDOT_TRY(qdot_units_join(session, qdot_mul(pool, p, qdot_symbol_jet(pool, q, 1)), args[1], "%s belongs here, not %s"));
    return give_units(session, 1, &action, value);
}

qdot_status
qdot_units_of_call(qdot_session *session, const char *name, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    static const char *const circular[] = {"sin", "cos", "tan"};
    static const char *const numbers[] = {"value", "numeric", "N", "mean", "min", "max"};
    size_t k = 0;

    for (size_t i = 0; i < sizeof circular / sizeof *circular && n == 1; i++)
        if (strcmp(circular[i], name) == 0)
            return qdot_units_angles_in(session, args[0]);
    if (strcmp(name, "solve") == 0)
        return units_of_zeros(session, n, args, value);
    if (strcmp(name, "action") == 0 && n > 0 && qdot_expr_is_coordinate(session->pool, args[0]))
        return unit_of_action(session, n, args, value);
    while (k < sizeof numbers / sizeof *numbers && strcmp(numbers[k], name) != 0)
        k++;
    if (k == sizeof numbers / sizeof *numbers || n == 0)
        return QDOT_OK;
    if (k == 0 && n > 1)
        QDOT_TRY(qdot_units_time(session, args[n - 1]));
    n = k == 0 && n > 1 ? n - 1 : k == 0 ? n : 1; /* the last argument of `value` is the time */
    return give_units(session, n, args, value);
}

qdot_status
qdot_machine_units_value(qdot_machine *m)
{
    return qdot_units_visit(m->session, qdot_machine_top(m, 1)->value);
}

const qdot_token *
qdot_compiled_unit(const qdot_compiled *program, bool in)
{
    const size_t n = program->code.list.n;
    const qdot_postfix *last = n > 0 ? &program->code.list.at[n - 1] : NULL;

    return last != NULL && last->op == (in ? QDOT_POSTFIX_IN : QDOT_POSTFIX_UNIT) ? last->token : NULL;
}
