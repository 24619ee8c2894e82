/* evaluate.c -- postfix code to a value: a loop over the code, with its own stacks. */
#include <string.h>

#include "base/interrupt.h"
#include "expr/tensor.h"
#include "lang/functions/builtin.h"
#include "lang/functions/entry.h"
#include "lang/functions/quantity.h"
#include "lang/language/closed-sum.h"
#include "lang/language/condition.h"
#include "lang/language/evaluator.h"
#include "lang/language/partial-sum.h"
#include "lang/session/bind.h"
#include "lang/session/event-time.h"
#include "lang/session/member.h"
#include "lang/session/range.h"
#include "lang/session/value-kind.h"
#include "lang/source/lex.h"

/* A value on the stack. */
typedef struct {
    qdot_expr value;
    qdot_expr over;         /* coordinates its entries go by, or nil */
    const char *run;        /* meant along this run, or NULL */
    const char *label;      /* it is the position of this particle or body, or NULL */
    const qdot_token *sign; /* the + - * / before it, or NULL for the first */
} slot;

/* A sum(...) under way. */
typedef struct {
    const char *index;
    const qdot_token *place; /* where it stands */
    bool varies;             /* terms depend on more than the index (lang/language/partial-sum) */
    long first, k, last;
    uint32_t resume; /* code after it */
    size_t terms;    /* where its terms begin */
    bool bound;      /* the index is bound just now */
    qdot_expr symbol; /* what it is bound to for a formula of many terms; nil: to numbers */
} frame;

typedef struct {
    qdot_cursor *c;
    qdot_session *session;
    qdot_pool *pool;
    const qdot_program *program;
    qdot_vec(slot) stack;
    qdot_vec(frame) frames;
    qdot_vec(qdot_expr) terms; /* of all sums under way */
    qdot_vec(qdot_expr) args;  /* scratch */
    qdot_vec(const char *) labels; /* of the arguments of the call under way */
    const qdot_token *blame;   /* where the caret goes if this fails */
    bool belongs;              /* the run that follows as MEMBER has been taken */
} machine;

/* --- the stack ---------------------------------------------------------------------- */

static qdot_status
push(machine *m, qdot_expr value)
{
    slot s = {.value = value};

    QDOT_TRY(qdot_value_kind_check(m->pool, value));
    return qdot_vec_push(&m->stack, s);
}

/* Keep a value that must exist, of a scalar with symbols. */
static qdot_status
pass(machine *m, qdot_expr value)
{
    qdot_passed *p = m->session->passed;

    if (p == NULL || p->spoiled || p->branches > 0 || value == QDOT_NIL || !qdot_expr_is_scalar(m->pool, value) ||
        qdot_expr_kind(m->pool, value) == QDOT_NUM)
        return QDOT_OK;
    return qdot_vec_push(&p->value, value);
}

/* Functions of numbers only: what else is called may take its arguments apart. The body of a
 * user's own function is read in its turn. */
static void
spoil(machine *m, const char *name)
{
    qdot_fun_id id;

    if (m->session->passed != NULL && !qdot_fun_find(name, &id) && strcmp(name, "sqrt") != 0 &&
        qdot_names_find(m->session->names, name) == NULL)
        m->session->passed->spoiled = true;
}

static slot *
from_top(machine *m, size_t n)
{
    return &m->stack.at[m->stack.n - n];
}

static qdot_status
along_runs(void)
{
    qdot_fail(QDOT_ENOTBUILT, "not built yet: comparing runs");
    return qdot_hint("the value along a run is value(a.theta, 20)");
}

/* What is meant along a run and enters an expression: a symbol from now on. */
static qdot_status
enter(machine *m, slot *s)
{
    if (s->run == NULL)
        return QDOT_OK;
    s->value = qdot_member_of(m->session, s->run, s->value);
    s->run = NULL;
    return qdot_value_kind_check(m->pool, s->value);
}

/* The top n values, popped into m->args. */
static qdot_status
take_any(machine *m, size_t n)
{
    QDOT_TRY(qdot_grow(&m->args.at, &m->args.capacity, n, sizeof *m->args.at));
    for (size_t i = 0; i < n; i++) {
        QDOT_TRY(enter(m, from_top(m, n - i)));
        m->args.at[i] = from_top(m, n - i)->value;
    }
    m->args.n = n;
    m->stack.n -= n;
    return QDOT_OK;
}

/* The same where a text, latex(e), has no place. */
static qdot_status
take(machine *m, size_t n)
{
    QDOT_TRY(take_any(m, n));
    for (size_t i = 0; i < n; i++) {
        if (m->args.at[i] == QDOT_NIL ||
            !(qdot_expr_node(m->pool, m->args.at[i])->holds & QDOT_HAS_WORDS))
            continue;
        (void)qdot_fail(QDOT_ETYPE, "a text is no number");
        return qdot_hint("latex(...) stands alone, behind `print`, in a list, by a name");
    }
    return QDOT_OK;
}

static bool
all_scalars(const machine *m)
{
    for (size_t i = 0; i < m->args.n; i++)
        if (!qdot_expr_is_scalar(m->pool, m->args.at[i]))
            return false;
    return true;
}

/* --- sums and products -------------------------------------------------------------- */

/* The operand after `sign`: b of a - b is negated, b of a/b is left for the product. */
static qdot_status
term(machine *m, const qdot_token *sign)
{
    slot *s = from_top(m, 1);

    QDOT_TRY(enter(m, s));
    s->sign = sign;
    if (sign->text[0] == '-') {
        s->value = qdot_value_neg(m->pool, s->value);
        return qdot_value_kind_check(m->pool, s->value);
    }
    if (sign->text[0] == '/' && s->value == QDOT_ZERO)
        return qdot_fail(QDOT_EDOMAIN, "division by zero");
    return QDOT_OK;
}

/* Sums of scalars at once; of other kinds one by one: the caret finds the sign. */
static qdot_status
sum(machine *m, size_t n)
{
    const slot *s = from_top(m, n);
    qdot_expr value = s[0].value;

    QDOT_TRY(take(m, n)); /* the slots above the stack stay readable */
    if (all_scalars(m))
        return push(m, qdot_sum(m->pool, n, m->args.at));
    for (size_t i = 1; i < n; i++) {
        m->blame = s[i].sign;
        value = qdot_value_add(m->pool, value, m->args.at[i]);
        QDOT_TRY(qdot_value_kind_check(m->pool, value));
    }
    return push(m, value);
}

static qdot_status
product(machine *m, size_t n)
{
    enum { LONG = 16 }; /* from here on at once */
    const slot *s = from_top(m, n);
    qdot_expr value = s[0].value;
    bool at_once;

    QDOT_TRY(take(m, n));
    at_once = n > LONG && all_scalars(m);
    for (size_t i = 1; i < n; i++) {
        bool divide = s[i].sign->text[0] == '/';

        m->blame = s[i].sign;
        if (divide && m->session->passed != NULL &&
            qdot_expr_is_scalar(m->pool, m->args.at[i]))
            QDOT_TRY(pass(m, qdot_div(m->pool, QDOT_ONE, m->args.at[i])));
        if (at_once && !divide)
            continue;
        if (at_once)
            m->args.at[i] = qdot_div(m->pool, QDOT_ONE, m->args.at[i]);
        else
            value =
                (divide ? qdot_value_div : qdot_value_mul)(m->pool, value, m->args.at[i]);
        QDOT_TRY(qdot_value_kind_check(m->pool, at_once ? m->args.at[i] : value));
    }
    return push(m, at_once ? qdot_product(m->pool, n, m->args.at) : value);
}

/* --- logic -------------------------------------------------------------------------- */

static qdot_status
logic(machine *m, qdot_logic_op op, size_t n)
{
    static const char *const names[] = {"and", "or", "not"};

    QDOT_TRY(take(m, n));
    for (size_t i = 0; i < n; i++)
        if (!qdot_condition_is(m->pool, m->args.at[i]))
            return qdot_fail(QDOT_ETYPE, "`%s` joins conditions, not %s", names[op],
                             qdot_value_kind_words(m->pool, m->args.at[i]));
    return push(m, qdot_logic(m->pool, op, (uint32_t)n, m->args.at));
}

/* --- sum(EXPR, k, a, b) and if(C, A, B) --------------------------------------------- */

/* Bind the next k, or end the sum. */
static qdot_status
sum_round(machine *m, uint32_t *pc, uint32_t body)
{
    frame *f = &m->frames.at[m->frames.n - 1];
    qdot_expr value;

    QDOT_TRY(qdot_interrupt_check());
    if (f->k <= f->last) {
        value = qdot_expr_int(m->pool, f->k++);
        QDOT_TRY(qdot_value_kind_check(m->pool, value));
        QDOT_TRY(qdot_names_push(m->session->names, f->index, value));
        f->bound = true;
        *pc = body;
        return QDOT_OK;
    }
    m->args.n = 0;
    QDOT_TRY(qdot_grow(&m->args.at, &m->args.capacity, m->terms.n - f->terms + 1,
                       sizeof *m->args.at));
    for (size_t i = f->terms; i < m->terms.n; i++)
        m->args.at[m->args.n++] = m->terms.at[i];
    m->terms.n = f->terms;
    *pc = f->resume;
    m->frames.n--;
    if (all_scalars(m)) {
        const qdot_partial_sum sum = {f->place, f->first, f->last,
                                      qdot_sum(m->pool, m->args.n, m->args.at)};

        QDOT_TRY(push(m, sum.value));
        return f->varies || m->args.n == 0 ? QDOT_OK : qdot_partial_sum_keep(m->session, sum);
    }
    value = m->args.at[0];
    for (size_t i = 1; i < m->args.n; i++) {
        value = qdot_value_add(m->pool, value, m->args.at[i]);
        QDOT_TRY(qdot_value_kind_check(m->pool, value));
    }
    return push(m, value);
}

static qdot_status
sum_begin(machine *m, const qdot_code *code, uint32_t *pc)
{
    const qdot_partial_sum *known;
    frame f = {.place = &m->c->source->tokens.at[code->n],
               .varies = m->session->passed != NULL,
               .resume = *pc,
               .terms = m->terms.n};

    f.index = f.place->text;
    QDOT_TRY(take(m, 2));
    QDOT_TRY(qdot_session_integer(m->session, m->args.at[0], &f.first));
    QDOT_TRY(qdot_session_integer(m->session, m->args.at[1], &f.last));
    f.k = f.first;
    known = f.varies ? NULL : qdot_partial_sum_find(m->session, f.place, f.first, f.last);
    if (known) {
        f.k = known->last + 1;
        QDOT_TRY(qdot_vec_push(&m->terms, known->value));
    }
    if (f.last > f.k && (unsigned long)f.last - (unsigned long)f.k >= QDOT_SUM_TERMS) {
        f.symbol = qdot_symbol_get(m->pool, QDOT_FORMAL, "a summation index");
        QDOT_TRY(qdot_value_kind_check(m->pool, f.symbol));
        QDOT_TRY(qdot_names_push(m->session->names, f.index, f.symbol));
        f.bound = true;
        *pc = code->to;
        return qdot_vec_push(&m->frames, f);
    }
    QDOT_TRY(qdot_vec_push(&m->frames, f));
    return sum_round(m, pc, code->to);
}

/* The summand as a function of the index is there: its sum by formula. */
static qdot_status
sum_by_formula(machine *m, uint32_t *pc)
{
    frame *f = &m->frames.at[m->frames.n - 1];
    qdot_expr value;
    qdot_status status;

    if (!qdot_expr_is_scalar(m->pool, m->args.at[0]))
        return qdot_fail(QDOT_EFAILED, "no formula is known");
    status = qdot_closed_sum(m->pool, m->args.at[0], f->symbol, f->k, f->last, &value);
    if (status != QDOT_OK && status != QDOT_EFAILED)
        f->symbol = QDOT_NIL; /* a formula is known: its error is the one to tell */
    QDOT_TRY(status);
    qdot_names_pop(m->session->names);
    *pc = f->resume;
    m->frames.n--;
    return push(m, value);
}

/* The body's value is there. The SUM_BEGIN that began it stands before frame.resume. */
static qdot_status
sum_next(machine *m, uint32_t *pc)
{
    frame *f = &m->frames.at[m->frames.n - 1];
    uint32_t body = m->program->list.at[f->resume - 1].to;

    QDOT_TRY(take(m, 1));
    if (f->symbol != QDOT_NIL)
        return sum_by_formula(m, pc);
    QDOT_TRY(qdot_vec_push(&m->terms, m->args.at[0]));
    qdot_names_pop(m->session->names);
    f->bound = false;
    return sum_round(m, pc, body);
}

static qdot_status
if_test(machine *m, const qdot_code *code, uint32_t *pc)
{
    slot *s = from_top(m, 1);
    slot none = {0};

    if (m->session->passed != NULL)
        m->session->passed->branches++;
    if (s->run != NULL)
        return along_runs();
    if (!qdot_condition_is(m->pool, s->value))
        return qdot_fail(QDOT_ETYPE, "if(CONDITION, A, B) takes a condition, not %s",
                         qdot_value_kind_words(m->pool, s->value));
    s->value = qdot_condition_decide(m->pool, s->value);
    QDOT_TRY(qdot_value_kind_check(m->pool, s->value));
    if (s->value != QDOT_FALSE)
        return QDOT_OK;
    *pc = code->to;
    return qdot_vec_push(&m->stack, none);
}

static void
if_else(machine *m, const qdot_code *code, uint32_t *pc)
{
    if (from_top(m, 2)->value != QDOT_TRUE)
        return;
    if (m->session->passed != NULL)
        m->session->passed->branches--;
    *from_top(m, 2) = *from_top(m, 1);
    m->stack.n--;
    *pc = code->to;
}

/* Both branches, the condition open; vectors of one size component by component. */
static qdot_status
if_end(machine *m)
{
    qdot_expr value;

    if (m->session->passed != NULL)
        m->session->passed->branches--;
    if (from_top(m, 3)->value == QDOT_FALSE) {
        *from_top(m, 3) = *from_top(m, 1);
        m->stack.n -= 2;
        return QDOT_OK;
    }
    QDOT_TRY(take(m, 3));
    QDOT_TRY(qdot_condition_choose(m->pool, m->args.at[0], m->args.at[1], m->args.at[2], &value));
    return push(m, value);
}

/* --- names, calls, entries ---------------------------------------------------------- */

/* The run that the top n values are meant along, no longer theirs; NULL where there are
 * several. */
static const char *
common_run(machine *m, size_t n)
{
    const char *run = NULL;

    for (size_t i = 1; i <= n; i++) {
        const char *one = from_top(m, i)->run;

        if (one != NULL && run != NULL && strcmp(one, run) != 0)
            return NULL;
        run = one != NULL ? one : run;
    }
    for (size_t i = 1; i <= n; i++)
        from_top(m, i)->run = NULL;
    return run;
}

/* value(...) and its kin look at the run of their arguments. */
static bool
takes_run(const machine *m, const qdot_code *code)
{
    const qdot_builtin *row = qdot_builtin_find(code->token->text);

    return code->to == 0 && row != NULL && (row->flags & QDOT_BUILTIN_RUN) &&
           !qdot_resolve_is_function(m->session, code->token->text);
}

/* max(e, a..b): the ends of the range stand last. */
static qdot_status
range(machine *m, const qdot_code *code)
{
    const char *run = common_run(m, code->n);
    qdot_expr value;

    QDOT_TRY(take(m, code->n));
    QDOT_TRY(qdot_range_value(m->session, run, code->token->text, code->n - 2,
                              m->args.at, m->args.at + code->n - 2, &value));
    return push(m, value);
}

static qdot_status
call(machine *m, const qdot_code *code)
{
    size_t n = code->n + code->to;
    const char *run = NULL;
    qdot_expr value, over = QDOT_NIL;

    if (takes_run(m, code))
        run = common_run(m, n);
    m->labels.n = 0;
    QDOT_TRY(qdot_grow(&m->labels.at, &m->labels.capacity, n, sizeof *m->labels.at));
    for (size_t i = n; i > 0; i--)
        m->labels.at[m->labels.n++] = from_top(m, i)->label;
    QDOT_TRY(take(m, n));
    QDOT_TRY(qdot_resolve_call(m->c, code->token, code->primes, code->to, code->n,
                               m->args.at, m->labels.at, run, &value, &over));
    QDOT_TRY(push(m, value));
    from_top(m, 1)->over = over;
    spoil(m, code->token->text);
    return pass(m, value);
}

static qdot_status
entry(machine *m, const qdot_code *code)
{
    qdot_expr over = from_top(m, code->n + 1)->over, value;

    QDOT_TRY(take_any(m, code->n + 1));
    QDOT_TRY(qdot_entry_of(m->session, m->args.at[0], over, code->n, m->args.at + 1,
                           &value));
    return push(m, value);
}

/* `cross[2]`, `cross`, a.cross[2]: times of an event, where no other name is. */
static qdot_status
event(machine *m, const qdot_code *code, bool *found)
{
    const qdot_code *next = code + 1;
    bool member = next < m->program->list.at + m->program->list.n &&
                  next->op == QDOT_CODE_MEMBER;
    const char *run = member ? next->token->text : NULL, *text = code->token->text;
    bool indexed = code->op == QDOT_CODE_INDEX_NAME;
    qdot_text spelled = {0};
    qdot_status status = QDOT_OK;
    qdot_expr value;
    long k = 0;

    *found = false;
    if (code->primes > 0 || code->n > 1 || qdot_names_find(m->session->names, text) ||
        (!indexed && qdot_quantity_find(text)))
        return QDOT_OK;
    if (indexed && qdot_expr_kind(m->pool, from_top(m, 1)->value) == QDOT_NUM) {
        QDOT_TRY(qdot_session_integer(m->session, from_top(m, 1)->value, &k));
        qdot_text_format(&spelled, "%s[%ld]", text, k);
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
            status = push(m, value);
    }
    qdot_text_clear(&spelled);
    return status;
}

static qdot_status
name(machine *m, const qdot_code *code)
{
    qdot_expr value, over;
    bool found;

    QDOT_TRY(event(m, code, &found));
    if (found)
        return QDOT_OK;
    if (code->op == QDOT_CODE_NAME) {
        QDOT_TRY(qdot_resolve_name(m->c, code->token, code->primes, &value, &over));
        QDOT_TRY(push(m, value));
        from_top(m, 1)->over = over;
    } else {
        QDOT_TRY(take(m, code->n));
        QDOT_TRY(qdot_resolve_index(m->c, code->token, code->primes, code->n, m->args.at,
                                    &value));
        QDOT_TRY(push(m, value));
    }
    return code->primes > 0 ? QDOT_OK
                            : qdot_resolve_label(m->session, code->token->text, code->n,
                                                 m->args.at, &from_top(m, 1)->label);
}

/* A label travels as a symbol of its spelling; a loop's index stands for its value. */
static qdot_status
label(machine *m, const qdot_code *code)
{
    const qdot_name *bound = qdot_names_find(m->session->names, code->token->text);
    qdot_text text = {0};
    qdot_status status;

    if (code->n == 0 && bound != NULL && bound->kind == QDOT_NAME_INDEX &&
        !qdot_scene_has_label(m->session->scene, code->token->text))
        return push(m, bound->value);
    if (code->n == 0 && bound != NULL && bound->label != NULL)
        return push(m, qdot_symbol_get(m->pool, QDOT_FORMAL, bound->label));
    QDOT_TRY(take(m, code->n));
    status =
        qdot_entry_name(m->session, code->token->text, code->n, m->args.at, &text);
    if (status == QDOT_OK)
        status = push(m, qdot_symbol_get(m->pool, QDOT_FORMAL, qdot_text_str(&text)));
    qdot_text_clear(&text);
    return status;
}

static qdot_status
history(machine *m, uint32_t n)
{
    slot s = {0};

    QDOT_TRY(qdot_session_recall(m->session, n, &s.value, &s.over));
    return qdot_vec_push(&m->stack, s);
}

static qdot_status
member(machine *m, const char *run)
{
    if (m->belongs) {
        m->belongs = false;
        return QDOT_OK;
    }
    QDOT_TRY(qdot_member_check(m->session, run));
    if (from_top(m, 1)->run != NULL)
        return along_runs();
    from_top(m, 1)->run = run;
    return QDOT_OK;
}

/* --- the loop ----------------------------------------------------------------------- */

/* What an instruction that was carried out makes the terms of the sums round it depend on. */
static void
note_use(machine *m, const qdot_code *code)
{
    const qdot_name *known;
    size_t i = m->frames.n;

    if (i == 0 || qdot_partial_sum_may_hold(m->session, code, from_top(m, 1)->value))
        return;
    known = code->op == QDOT_CODE_NAME ? qdot_names_find(m->session->names, code->token->text)
                                       : NULL;
    /* of sums round it up to the one whose index it is */
    for (; i > 0 && !(known && known->kind == QDOT_NAME_INDEX
                      && strcmp(m->frames.at[i - 1].index, known->name) == 0);
         i--)
        m->frames.at[i - 1].varies = true;
}

static qdot_status
step(machine *m, const qdot_code *code, uint32_t *pc)
{
    qdot_expr value;

    switch ((qdot_code_op)code->op) {
    case QDOT_CODE_NUMBER: return push(m, qdot_lex_number(m->pool, code->token->text));
    case QDOT_CODE_NAME:
    case QDOT_CODE_INDEX_NAME: return name(m, code);
    case QDOT_CODE_LABEL: return label(m, code);
    case QDOT_CODE_HISTORY: return history(m, code->n);
    case QDOT_CODE_INDEX: return entry(m, code);
    case QDOT_CODE_CALL: return call(m, code);
    case QDOT_CODE_RANGE: return range(m, code);
    case QDOT_CODE_TERM: return term(m, code->token);
    case QDOT_CODE_SUM: return sum(m, code->n);
    case QDOT_CODE_PRODUCT: return product(m, code->n);
    case QDOT_CODE_NEGATE:
        QDOT_TRY(take(m, 1));
        return push(m, qdot_value_neg(m->pool, m->args.at[0]));
    case QDOT_CODE_POWER:
        QDOT_TRY(take(m, 2));
        QDOT_TRY(push(m, qdot_value_pow(m->pool, m->args.at[0], m->args.at[1])));
        return pass(m, from_top(m, 1)->value);
    case QDOT_CODE_RELATION:
        QDOT_TRY(take(m, 2));
        QDOT_TRY(qdot_condition_relation(m->pool, code->token->text, m->args.at[0],
                                         m->args.at[1], &value));
        return push(m, value);
    case QDOT_CODE_CHAIN:
        QDOT_TRY(take(m, 2));
        QDOT_TRY(qdot_condition_relation(m->pool, code->token->text, m->args.at[0],
                                         m->args.at[1], &value));
        QDOT_TRY(push(m, value));
        return push(m, m->args.at[1]);
    case QDOT_CODE_AND: return logic(m, QDOT_AND, code->n);
    case QDOT_CODE_OR: return logic(m, QDOT_OR, code->n);
    case QDOT_CODE_NOT: return logic(m, QDOT_NOT, 1);
    case QDOT_CODE_VECTOR:
        QDOT_TRY(take(m, code->n));
        return push(m, qdot_vector(m->pool, code->n, m->args.at));
    case QDOT_CODE_LIST:
        QDOT_TRY(take_any(m, code->n));
        return push(m, qdot_list(m->pool, code->n, m->args.at));
    case QDOT_CODE_MATRIX:
        QDOT_TRY(take(m, code->n));
        return push(m, qdot_matrix(m->pool, code->n / code->to, code->to, m->args.at));
    case QDOT_CODE_MEMBER: return member(m, code->token->text);
    case QDOT_CODE_JUMP: *pc = code->to; return QDOT_OK;
    case QDOT_CODE_SUM_BEGIN: return sum_begin(m, code, pc);
    case QDOT_CODE_SUM_NEXT: return sum_next(m, pc);
    case QDOT_CODE_IF_TEST: return if_test(m, code, pc);
    case QDOT_CODE_IF_ELSE: if_else(m, code, pc); return QDOT_OK;
    case QDOT_CODE_IF_END: return if_end(m);
    }
    return qdot_fail(QDOT_EFAILED, "the reader lost its way");
}

static qdot_status
run_program(machine *m)
{
    for (uint32_t pc = 0; pc < m->program->list.n;) {
        const qdot_code *code = &m->program->list.at[pc++];

        m->blame = code->token;
        if ((pc & 0x3FFF) == 0)
            QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(step(m, code, &pc));
        if (code->op >= QDOT_CODE_NAME && code->op <= QDOT_CODE_RANGE)
            note_use(m, code);
    }
    return QDOT_OK;
}

qdot_status
qdot_evaluate(qdot_cursor *c, const qdot_program *program, qdot_expr *value,
              qdot_expr *over, const char **run)
{
    machine m = {
        .c = c, .session = c->session, .pool = c->session->pool, .program = program};
    qdot_status status = run_program(&m);
    const frame *f;

    if (status == QDOT_OK) {
        *value = m.stack.at[0].value;
        if (over != NULL)
            *over = m.stack.at[0].over;
        if (run != NULL)
            *run = m.stack.at[0].run;
        else if (m.stack.at[0].run != NULL)
            status = along_runs();
    } else if (m.blame != NULL) {
        c->error_at = m.blame->start;
    }
    f = m.frames.n > 0 ? &m.frames.at[m.frames.n - 1] : NULL;
    if (status != QDOT_OK && f && f->symbol != QDOT_NIL)
        status = qdot_closed_sum_unknown(status, f->index, f->k, f->last);
    for (size_t i = m.frames.n; i > 0; i--) /* only after a failure */
        if (m.frames.at[i - 1].bound)
            qdot_names_pop(m.session->names);
    qdot_free(m.stack.at);
    qdot_free(m.frames.at);
    qdot_free(m.terms.at);
    qdot_free(m.args.at);
    qdot_free(m.labels.at);
    return status;
}
