/* evaluate.c -- evaluates an expression, translated to postfix code, in a loop with stacks of its own (no recursion). */
#include <inttypes.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/functions/builtin.h"
#include "lang/functions/entry.h"
#include "lang/functions/quantity.h"
#include "lang/language/condition.h"
#include "lang/language/forms.h"
#include "lang/language/hints.h"
#include "lang/language/outdated.h"
#include "lang/language/partial-sum.h"
#include "lang/language/units.h"
#include "lang/session/bind.h"
#include "lang/session/event-time.h"
#include "lang/session/history.h"
#include "lang/session/range.h"
#include "lang/session/runs.h"
#include "lang/session/units.h"
#include "lang/source/letters.h"
#include "lang/source/lex.h"

/* Take the top n values as operands; infinity is none. */
static qdot_status
take_operands(qdot_machine *m, size_t n)
{
    QDOT_TRY(qdot_machine_take(m, n));
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(qdot_infinity_refuse(m->pool, m->args.at[i]));
    return QDOT_OK;
}

/* --- sums and products -------------------------------------------------------------- */

/* Prepare the right operand of `sign`, on top of the stack: b of a - b is negated; b of a/b stays as it is. */
static qdot_status
prepare_right_operand(qdot_machine *m, const qdot_token *sign)
{
    qdot_slot *s = qdot_machine_top(m, 1);

    QDOT_TRY(qdot_machine_enter(m, s));
    s->sign = sign;
    if (sign->text[0] == '-') {
        s->value = qdot_value_neg(m->pool, s->value);
        return qdot_value_kind_check(m->pool, s->value);
    }
    if (sign->text[0] == '/' && s->value == QDOT_ZERO)
        return qdot_fail(QDOT_EDOMAIN, "division by zero");
    return QDOT_OK;
}

/* Add the top n values of the stack: all at once if scalars, else one by one, so that an error points to its sign. */
static qdot_status
add_top_values(qdot_machine *m, size_t n)
{
    const qdot_slot *s = qdot_machine_top(m, n);
    qdot_expr value;

    QDOT_TRY(take_operands(m, n)); /* the removed entries above the stack remain readable */
    value = m->args.at[0];
    if (qdot_machine_all_scalars(m))
        return qdot_machine_push(m, qdot_sum(m->pool, n, m->args.at));
    for (size_t i = 1; i < n; i++) {
        m->blame = s[i].sign;
        value = qdot_value_add(m->pool, value, m->args.at[i]);
        QDOT_TRY(qdot_value_kind_check(m->pool, value));
    }
    return qdot_machine_push(m, value);
}

static qdot_status
multiply_top_values(qdot_machine *m, size_t n)
{
    enum { LONG = 16 }; /* number of factors from which on they are multiplied in one step */
    const qdot_slot *s = qdot_machine_top(m, n);
    qdot_expr value;
    bool at_once;

    QDOT_TRY(take_operands(m, n));
    value = m->args.at[0];
    at_once = n > LONG && qdot_machine_all_scalars(m);
    for (size_t i = 1; i < n; i++) {
        bool divide = s[i].sign->text[0] == '/';

        m->blame = s[i].sign;
        if (divide && m->session->evaluation->passed != NULL &&
            qdot_expr_is_scalar(m->pool, m->args.at[i]))
            QDOT_TRY(qdot_machine_pass(m, qdot_div(m->pool, QDOT_ONE, m->args.at[i])));
        if (at_once && !divide)
            continue;
        if (at_once)
            m->args.at[i] = qdot_div(m->pool, QDOT_ONE, m->args.at[i]);
        else
            value =
                (divide ? qdot_value_div : qdot_value_mul)(m->pool, value, m->args.at[i]);
        QDOT_TRY(qdot_value_kind_check(m->pool, at_once ? m->args.at[i] : value));
    }
    return qdot_machine_push(m, at_once ? qdot_product(m->pool, n, m->args.at) : value);
}

/* --- and, or, not ------------------------------------------------------------------- */

static qdot_status
combine_conditions(qdot_machine *m, qdot_logic_op op, size_t n)
{
    static const char *const names[] = {"and", "or", "not"};

    QDOT_TRY(qdot_machine_take(m, n));
    for (size_t i = 0; i < n; i++)
        if (!qdot_condition_is(m->pool, m->args.at[i]))
            return qdot_fail(QDOT_ETYPE, "`%s` joins conditions, not %s", names[op],
                             qdot_value_kind_words(m->pool, m->args.at[i]));
    return qdot_machine_push(m, qdot_logic(m->pool, op, (uint32_t)n, m->args.at));
}

/* --- names, calls, entries ---------------------------------------------------------- */

/* The run that the top n values are meant along, no longer theirs; NULL where there are
 * several. */
static const char *
take_common_run(qdot_machine *m, size_t n)
{
    const char *run = NULL;

    for (size_t i = 1; i <= n; i++) {
        const char *one = qdot_machine_top(m, i)->run;

        if (one != NULL && run != NULL && strcmp(one, run) != 0)
            return NULL;
        run = one != NULL ? one : run;
    }
    for (size_t i = 1; i <= n; i++)
        qdot_machine_top(m, i)->run = NULL;
    return run;
}

/* Whether a function such as value(...) reads its arguments along a run. */
static bool
reads_arguments_along_run(const qdot_machine *m, const qdot_postfix *code)
{
    const qdot_builtin *row = qdot_builtin_find(code->token->text);

    return code->to == 0 && row != NULL && (row->flags & QDOT_BUILTIN_RUN) &&
           !qdot_resolve_is_function(m->session, code->token->text);
}

/* The run `a` if this instruction belongs to the parenthesis of a.( ... ); else NULL. */
static const char *
run_before_parenthesis(const qdot_machine *m, const qdot_postfix *code)
{
    const qdot_postfix *next = code + 1;

    return next < m->program->list.at + m->program->list.n && next->op == QDOT_POSTFIX_MEMBER ? next->token->text
                                                                                              : NULL;
}

static qdot_status
check_run_exists(const qdot_machine *m, const char *name)
{
    return qdot_runs_index(m->session, name) < m->session->runs->n ? QDOT_OK : qdot_hints_unknown_run(name);
}

/* Mark the value on top of the stack as one along a run; an error if it belongs to another run already. */
static qdot_status
mark_along_run(qdot_machine *m, const char *run)
{
    qdot_slot *top = qdot_machine_top(m, 1);

    QDOT_TRY(check_run_exists(m, run));
    if (top->run != NULL)
        return qdot_machine_along_two(top->run, run);
    top->run = run;
    return QDOT_OK;
}

/* Find the run along which the top n values are read: the one they name, or `a` in a.value(x, 2),
 * a.max(x, 0..1). */
static qdot_status
find_run_to_read(qdot_machine *m, const qdot_postfix *code, size_t n, const char **run)
{
    const char *around = run_before_parenthesis(m, code);

    *run = take_common_run(m, n);
    if (around == NULL)
        return QDOT_OK;
    if (*run != NULL)
        return qdot_machine_along_two(*run, around);
    QDOT_TRY(check_run_exists(m, around));
    *run = around;
    m->belongs = true;
    return QDOT_OK;
}

/* Evaluate a function of a range such as max(e, a..b); the two ends of the range are its last arguments. */
static qdot_status
evaluate_range_function(qdot_machine *m, const qdot_postfix *code)
{
    const bool along = qdot_range_is_word(code->token->text);
    const char *run = NULL;
    qdot_expr value;

    if (along) {
        QDOT_TRY(find_run_to_read(m, code, code->n, &run));
        QDOT_TRY(qdot_outdated_notice_call(m->session, run, code->token));
    }
    QDOT_TRY(qdot_machine_take(m, code->n));
    if (along)
        QDOT_TRY(qdot_range_value(m->session, run, code->token->text, code->n - 2,
                                  m->args.at, m->args.at + code->n - 2, &value));
    else
        QDOT_TRY(qdot_resolve_over_range(m->session, code->token->text, code->n, m->args.at,
                                         &value));
    for (size_t i = code->n - 2; i < code->n && along; i++)
        QDOT_TRY(qdot_units_time(m->session, m->args.at[i]));
    if (qdot_units_on(m->session))
        QDOT_TRY(qdot_units_of_call(m->session, code->token->text, along ? code->n - 2 : code->n, m->args.at, &value));
    return qdot_machine_push(m, value);
}

/* Whether a call is a.max(x) for a run a and an x that moves: the largest value along the run. */
static bool
is_extremum(qdot_machine *m, const qdot_postfix *code)
{
    const uint32_t moves = QDOT_HAS_COORD | QDOT_HAS_VELOCITY;

    return code->to == 0 && code->n == 1 && qdot_range_is_word(code->token->text) &&
           qdot_expr_node(m->pool, qdot_machine_top(m, 1)->value)->holds & moves &&
           !qdot_resolve_is_function(m->session, code->token->text);
}

/* Give the argument of a call such as a.max(x) the run a that stands before the call. */
static qdot_status
put_run_on_argument(qdot_machine *m, const qdot_postfix *code)
{
    const char *around = run_before_parenthesis(m, code);

    if (around == NULL)
        return QDOT_OK;
    QDOT_TRY(mark_along_run(m, around));
    m->belongs = true;
    return QDOT_OK;
}

static qdot_status
evaluate_call(qdot_machine *m, const qdot_postfix *code)
{
    size_t n = code->n + code->to;
    const char *run = NULL;
    qdot_expr value, first, over = QDOT_NIL;

    if (reads_arguments_along_run(m, code)) {
        QDOT_TRY(find_run_to_read(m, code, n, &run));
        QDOT_TRY(qdot_outdated_notice_call(m->session, run, code->token));
    } else if (is_extremum(m, code)) {
        QDOT_TRY(put_run_on_argument(m, code));
        QDOT_TRY(qdot_outdated_notice_call(m->session, qdot_machine_top(m, 1)->run, code->token));
    }
    m->labels.n = 0;
    QDOT_TRY(qdot_grow(&m->labels.at, &m->labels.capacity, n, sizeof *m->labels.at));
    for (size_t i = n; i > 0; i--)
        m->labels.at[m->labels.n++] = qdot_machine_top(m, i)->label;
    QDOT_TRY(qdot_machine_take(m, n));
    first = n == 0 ? QDOT_NIL : m->args.at[0];
    QDOT_TRY(qdot_resolve_call(m->c,
                               &(qdot_call){code->token, code->primes, code->to, code->n,
                                            m->args.at, m->labels.at, run},
                               &value, &over));
    if (qdot_units_on(m->session))
        QDOT_TRY(qdot_units_of_call(m->session, code->token->text, code->n, m->args.at + code->to, &value));
    QDOT_TRY(qdot_machine_push(m, value));
    qdot_machine_top(m, 1)->over = over;
    qdot_machine_spoil(m, code->token->text);
    if (n == 1 && code->primes == 0 && strcmp(code->token->text, "sqrt") == 0)
        return qdot_machine_pass_power(m, first, QDOT_HALF, value);
    return qdot_machine_pass(m, value);
}

static qdot_status
evaluate_entry(qdot_machine *m, const qdot_postfix *code)
{
    qdot_expr over = qdot_machine_top(m, code->n + 1)->over, value;

    QDOT_TRY(qdot_machine_take_any(m, code->n + 1));
    QDOT_TRY(qdot_entry_of(m->session, m->args.at[0], over, code->n, m->args.at + 1,
                           &value));
    return qdot_machine_push(m, value);
}

/* Evaluate the times of an event in a run: `cross[2]`, `cross` or a.cross[2]; *found: the name means an event. */
static qdot_status
evaluate_event_times(qdot_machine *m, const qdot_postfix *code, bool *found)
{
    const qdot_postfix *next = code + 1;
    bool member = next < m->program->list.at + m->program->list.n &&
                  next->op == QDOT_POSTFIX_MEMBER;
    const char *run = member ? next->token->text : NULL, *text = code->token->text;
    bool indexed = code->op == QDOT_POSTFIX_INDEX_NAME;
    qdot_text spelled = {0};
    qdot_status status = QDOT_OK;
    qdot_expr value;
    int64_t k = 0;

    *found = false;
    if (code->primes > 0 || code->n > 1 || qdot_names_find(m->session->names, text) ||
        (!indexed && qdot_quantity_find(text)))
        return QDOT_OK;
    if (indexed && qdot_expr_kind(m->pool, qdot_machine_top(m, 1)->value) == QDOT_NUM) {
        QDOT_TRY(qdot_session_integer(m->session, qdot_machine_top(m, 1)->value, &k));
        qdot_text_format(&spelled, "%s[%" PRId64 "]", text, k);
        if (qdot_event_is(m->session, run, qdot_text_str(&spelled))) {
            text = qdot_text_str(&spelled);
            k = 0;
        }
    }
    *found = qdot_event_is(m->session, run, text) && (!indexed || k != 0 || spelled.n > 0);
    if (*found) {
        status = qdot_event_time(m->session, run, text, k, &value);
        m->stack.n -= status == QDOT_OK ? code->n : 0;
        m->belongs = member;
        if (status == QDOT_OK)
            status = qdot_machine_push(m, value);
    }
    qdot_text_clear(&spelled);
    return status;
}

static qdot_status
name(qdot_machine *m, const qdot_postfix *code)
{
    qdot_expr value, over;
    bool found;

    QDOT_TRY(evaluate_event_times(m, code, &found));
    if (found)
        return QDOT_OK;
    if (code->op == QDOT_POSTFIX_NAME) {
        QDOT_TRY(qdot_resolve_name(m->c, code->token, code->primes, &value, &over));
        QDOT_TRY(qdot_machine_push(m, value));
        qdot_machine_top(m, 1)->over = over;
    } else {
        QDOT_TRY(qdot_machine_take(m, code->n));
        QDOT_TRY(qdot_resolve_index(m->c, code->token, code->primes, code->n, m->args.at,
                                    &value));
        QDOT_TRY(qdot_machine_push(m, value));
    }
    return code->primes > 0
               ? QDOT_OK
               : qdot_resolve_label(m->session, code->token->text, code->n, m->args.at,
                                    &qdot_machine_top(m, 1)->label);
}

/* The label that `rod₁` means, rod_1 or rod[1], if nothing is called rod1; false: it is written otherwise, or there is
 * none. */
static bool
label_from_subscript(const qdot_scene *scene, const qdot_token *token, qdot_text *spelled)
{
    if (token->length == strlen(token->text) || qdot_scene_has_label(scene, token->text))
        return false;
    for (unsigned form = 0; qdot_subscript_means(token->text, form, spelled); form++)
        if (qdot_scene_has_label(scene, qdot_text_str(spelled)))
            return true;
    qdot_text_truncate(spelled, 0);
    return false;
}

/* Push a label (a name of a particle, body ...) as a symbol; a loop index in it is replaced by its value. */
static qdot_status
push_label(qdot_machine *m, const qdot_postfix *code)
{
    const qdot_name *bound = qdot_names_find(m->session->names, code->token->text);
    qdot_text text = {0};
    qdot_status status;

    if (code->n == 0 && bound != NULL && bound->kind == QDOT_NAME_INDEX &&
        !qdot_scene_has_label(m->session->scene, code->token->text))
        return qdot_machine_push(m, bound->value);
    if (code->n == 0 && bound != NULL && bound->label != NULL)
        return qdot_machine_push(m, qdot_symbol_get(m->pool, QDOT_FORMAL, bound->label));
    QDOT_TRY(qdot_machine_take(m, code->n));
    status = code->n == 0 && label_from_subscript(m->session->scene, code->token, &text)
                 ? qdot_text_status(&text)
                 : qdot_entry_name(m->session, code->token->text, code->n, m->args.at, &text);
    if (status == QDOT_OK)
        status = qdot_machine_push(
            m, qdot_symbol_get(m->pool, QDOT_FORMAL, qdot_text_str(&text)));
    qdot_text_clear(&text);
    return status;
}

static qdot_status
push_earlier_answer(qdot_machine *m, uint32_t n)
{
    size_t count = m->session->history->values.n;

    if (count == 0)
        return qdot_fail(QDOT_EINVAL, "there is no value yet for `%%`");
    if (n > count)
        return qdot_fail(QDOT_EINVAL, "there are only %zu values so far", count);
    count = n == 0 ? count : n;
    QDOT_TRY(qdot_machine_push(m, m->session->history->values.at[count - 1]));
    if (count <= m->session->history->over.n)
        qdot_machine_top(m, 1)->over = m->session->history->over.at[count - 1];
    return QDOT_OK;
}

static qdot_status
member(qdot_machine *m, const qdot_token *token)
{
    QDOT_TRY(qdot_outdated_notice_member(m->session, token));
    if (m->belongs) {
        m->belongs = false;
        return QDOT_OK;
    }
    return mark_along_run(m, token->text);
}

/* --- running a program -------------------------------------------------------------- */

static qdot_status
execute_instruction(qdot_machine *m, const qdot_postfix *code, uint32_t *pc)
{
    qdot_expr value;

    switch ((qdot_postfix_kind)code->op) {
    case QDOT_POSTFIX_NUMBER:
        return qdot_machine_push(m, qdot_lex_number(m->pool, code->token->text));
    case QDOT_POSTFIX_NAME:
    case QDOT_POSTFIX_INDEX_NAME: return name(m, code);
    case QDOT_POSTFIX_LABEL: return push_label(m, code);
    case QDOT_POSTFIX_HISTORY: return push_earlier_answer(m, code->n);
    case QDOT_POSTFIX_INDEX: return evaluate_entry(m, code);
    case QDOT_POSTFIX_CALL: return evaluate_call(m, code);
    case QDOT_POSTFIX_RANGE: return evaluate_range_function(m, code);
    case QDOT_POSTFIX_TERM: return prepare_right_operand(m, code->token);
    case QDOT_POSTFIX_UNIT:
    case QDOT_POSTFIX_IN: return qdot_machine_unit(m, code);
    case QDOT_POSTFIX_SUM:
        if (qdot_units_on(m->session))
            QDOT_TRY(qdot_machine_units_sum(m, code->n));
        return add_top_values(m, code->n);
    case QDOT_POSTFIX_PRODUCT: return multiply_top_values(m, code->n);
    case QDOT_POSTFIX_NEGATE:
        QDOT_TRY(qdot_machine_take(m, 1));
        return qdot_machine_push(m, qdot_value_neg(m->pool, m->args.at[0]));
    case QDOT_POSTFIX_POWER:
        QDOT_TRY(take_operands(m, 2));
        QDOT_TRY(
            qdot_machine_push(m, qdot_value_pow(m->pool, m->args.at[0], m->args.at[1])));
        return qdot_machine_pass_power(m, m->args.at[0], m->args.at[1], qdot_machine_top(m, 1)->value);
    case QDOT_POSTFIX_RELATION:
        if (qdot_units_on(m->session))
            QDOT_TRY(qdot_machine_units_relation(m, code->token));
        QDOT_TRY(qdot_machine_take(m, 2));
        QDOT_TRY(qdot_condition_relation(m->pool, code->token->text, m->args.at[0],
                                         m->args.at[1], &value));
        return qdot_machine_push(m, value);
    case QDOT_POSTFIX_CHAIN:
        QDOT_TRY(qdot_machine_take(m, 2));
        QDOT_TRY(qdot_condition_relation(m->pool, code->token->text, m->args.at[0],
                                         m->args.at[1], &value));
        QDOT_TRY(qdot_machine_push(m, value));
        return qdot_machine_push(m, m->args.at[1]);
    case QDOT_POSTFIX_AND: return combine_conditions(m, QDOT_AND, code->n);
    case QDOT_POSTFIX_OR: return combine_conditions(m, QDOT_OR, code->n);
    case QDOT_POSTFIX_NOT: return combine_conditions(m, QDOT_NOT, 1);
    case QDOT_POSTFIX_VECTOR:
        QDOT_TRY(qdot_machine_take(m, code->n));
        return qdot_machine_push(m, qdot_vector(m->pool, code->n, m->args.at));
    case QDOT_POSTFIX_LIST:
        QDOT_TRY(qdot_machine_take_any(m, code->n));
        return qdot_machine_push(m, qdot_list(m->pool, code->n, m->args.at));
    case QDOT_POSTFIX_MATRIX:
        QDOT_TRY(qdot_machine_take(m, code->n));
        return qdot_machine_push(
            m, qdot_matrix(m->pool, code->n / code->to, code->to, m->args.at));
    case QDOT_POSTFIX_MEMBER: return member(m, code->token);
    case QDOT_POSTFIX_JUMP: *pc = code->to; return QDOT_OK;
    case QDOT_POSTFIX_SUM_BEGIN: return qdot_forms_sum(m, code, pc);
    case QDOT_POSTFIX_SUM_NEXT: return qdot_forms_sum_next(m, pc);
    case QDOT_POSTFIX_IF_TEST: return qdot_forms_if(m, code, pc);
    case QDOT_POSTFIX_IF_ELSE: qdot_forms_else(m, code, pc); return QDOT_OK;
    case QDOT_POSTFIX_IF_END: return qdot_forms_end(m);
    case QDOT_POSTFIX_PASS_BEGIN: return qdot_machine_pass_begin(m);
    case QDOT_POSTFIX_PASS_END: qdot_machine_pass_end(m); return QDOT_OK;
    }
    return qdot_fail(QDOT_EFAILED, "the reader lost its way");
}

/* Whether the value of the instruction may hold sums or functions that were not written: a sum written in place adds by
 * QDOT_POSTFIX_SUM, which names its summands. */
static bool
joins_summands(const qdot_postfix *code)
{
    switch ((qdot_postfix_kind)code->op) {
    case QDOT_POSTFIX_CALL:
    case QDOT_POSTFIX_RANGE:
    case QDOT_POSTFIX_POWER:
    case QDOT_POSTFIX_PRODUCT: /* of matrices and vectors */
    case QDOT_POSTFIX_IF_END: return true;
    default: return false;
    }
}

static qdot_status
execute_program(qdot_machine *m, uint32_t first, uint32_t end)
{
    for (uint32_t pc = first; pc < end;) {
        const qdot_postfix *code = &m->program->list.at[pc++];

        m->blame = code->token;
        if ((pc & 0x3FFF) == 0)
            QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(execute_instruction(m, code, &pc));
        if (qdot_units_on(m->session) && joins_summands(code))
            QDOT_TRY(qdot_machine_units_value(m));
        if (m->frames.n > 0 && code->op >= QDOT_POSTFIX_NAME && code->op <= QDOT_POSTFIX_MEMBER)
            qdot_partial_sum_note(m, code);
    }
    return QDOT_OK;
}

static qdot_status
evaluate_codes(qdot_cursor *c, const qdot_postfix_list *program, uint32_t first, uint32_t end, qdot_expr *value,
               qdot_expr *over, const char **run)
{
    qdot_machine m = {
        .c = c, .session = c->session, .pool = c->session->pool, .program = program};
    qdot_status status = execute_program(&m, first, end);

    if (status == QDOT_OK && m.stack.at[0].value != QDOT_NIL && qdot_expr_is_scalar(m.pool, m.stack.at[0].value) &&
        qdot_infinite(m.pool, m.stack.at[0].value) == 0)
        status = qdot_infinity_refuse(m.pool, m.stack.at[0].value);
    if (status == QDOT_OK) {
        if (over != NULL)
            *over = m.stack.at[0].over;
        if (run != NULL)
            *run = m.stack.at[0].run;
        else
            status = qdot_machine_enter(&m, &m.stack.at[0]);
        *value = m.stack.at[0].value;
    } else if (m.blame != NULL) {
        c->error_at = m.blame->start;
    }
    if (status != QDOT_OK && m.frames.n > 0)
        status = qdot_forms_too_many_terms(&m.frames.at[m.frames.n - 1], status);
    for (size_t i = m.frames.n; i > 0; i--) /* left over only after a failure */
        if (m.frames.at[i - 1].bound)
            qdot_names_pop(m.session->names);
    while (m.passed != NULL) /* left over only after a failure */
        qdot_machine_pass_end(&m);
    qdot_free(m.stack.at);
    qdot_free(m.frames.at);
    qdot_free(m.terms.at);
    qdot_free(m.args.at);
    qdot_free(m.labels.at);
    return status;
}

qdot_status
qdot_evaluate(qdot_cursor *c, const qdot_postfix_list *program, qdot_expr *value,
              qdot_expr *over, const char **run)
{
    return evaluate_codes(c, program, 0, (uint32_t)program->list.n, value, over, run);
}

qdot_status
qdot_evaluate_part(qdot_cursor *c, const qdot_postfix_list *program, uint32_t first, uint32_t end, qdot_expr *value)
{
    return evaluate_codes(c, program, first, end, value, NULL, NULL);
}
