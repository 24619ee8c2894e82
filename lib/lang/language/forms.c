/* forms.c -- evaluates sum(EXPR, k, a, b) and if(C, A, B), which do not evaluate all arguments first. */
#include "lang/language/forms.h"

#include <inttypes.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/language/condition.h"
#include "lang/language/partial-sum.h"
#include "lang/language/units.h"
#include "lang/session/bind.h"
#include "lang/session/units.h"
#include "normal/calculus/closed-sum.h"

/* Bind the index k of a sum to its next value, or finish the sum. */
static qdot_status
begin_next_summand(qdot_machine *m, uint32_t *pc, uint32_t body)
{
    qdot_sum_frame *f = &m->frames.at[m->frames.n - 1];
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
    if (qdot_units_on(m->session))
        QDOT_TRY(qdot_machine_units_terms(m));
    if (qdot_machine_all_scalars(m)) {
        const qdot_partial_sum sum = {f->place, f->first, f->last,
                                      qdot_sum(m->pool, m->args.n, m->args.at)};

        QDOT_TRY(qdot_machine_push(m, sum.value));
        return f->varies || m->args.n == 0 ? QDOT_OK : qdot_partial_sum_keep(m->session, sum);
    }
    value = m->args.at[0];
    for (size_t i = 1; i < m->args.n; i++) {
        value = qdot_value_add(m->pool, value, m->args.at[i]);
        QDOT_TRY(qdot_value_kind_check(m->pool, value));
    }
    return qdot_machine_push(m, value);
}

qdot_status
qdot_forms_sum(qdot_machine *m, const qdot_postfix *code, uint32_t *pc)
{
    const qdot_token *place = &m->c->source->tokens.at[code->n];
    const qdot_partial_sum *known;
    qdot_sum_frame f = {.index = place->text,
                        .place = place,
                        .varies = m->session->evaluation->passed != NULL,
                        .resume = *pc,
                        .terms = m->terms.n};

    QDOT_TRY(qdot_machine_take(m, 2));
    QDOT_TRY(qdot_session_integer(m->session, m->args.at[0], &f.first));
    QDOT_TRY(qdot_session_integer(m->session, m->args.at[1], &f.last));
    f.k = f.first;
    known = f.varies ? NULL : qdot_partial_sum_find(m->session, place, f.first, f.last);
    if (known != NULL) {
        f.k = known->last + 1;
        QDOT_TRY(qdot_vec_push(&m->terms, known->value));
    }
    if (f.last > f.k && (uint64_t)f.last - (uint64_t)f.k >= QDOT_SUM_TERMS) {
        f.symbol = qdot_symbol_get(m->pool, QDOT_FORMAL, "a summation index");
        QDOT_TRY(qdot_value_kind_check(m->pool, f.symbol));
        QDOT_TRY(qdot_names_push(m->session->names, f.index, f.symbol));
        f.bound = true;
        *pc = code->to;
        return qdot_vec_push(&m->frames, f);
    }
    QDOT_TRY(qdot_vec_push(&m->frames, f));
    return begin_next_summand(m, pc, code->to);
}

/* Add a sum by a formula, after the summand was evaluated as a function of the index. */
static qdot_status
finish_sum_by_formula(qdot_machine *m, uint32_t *pc)
{
    qdot_sum_frame *f = &m->frames.at[m->frames.n - 1];
    qdot_expr value;
    qdot_status status;

    if (!qdot_expr_is_scalar(m->pool, m->args.at[0]))
        return qdot_fail(QDOT_EFAILED, "no formula is known");
    status = qdot_closed_sum(m->pool, m->args.at[0], f->symbol, f->k, f->last, &value);
    if (status != QDOT_OK && status != QDOT_EFAILED)
        f->symbol = QDOT_NIL; /* after a failed formula do not try to add number by number: the formula's error is reported */
    QDOT_TRY(status);
    qdot_names_pop(m->session->names);
    *pc = f->resume;
    m->frames.n--;
    QDOT_TRY(qdot_machine_push(m, value));
    return qdot_units_on(m->session) ? qdot_machine_units_value(m) : QDOT_OK;
}

qdot_status
qdot_forms_too_many_terms(const qdot_sum_frame *f, qdot_status status)
{
    if (f->symbol == QDOT_NIL || qdot_grave(status) != QDOT_OK)
        return status;
    (void)qdot_fail(QDOT_ELIMIT, "a sum of %" PRIu64 " terms, and none is known by a formula",
                    (uint64_t)f->last - (uint64_t)f->k + 1);
    return qdot_hint("more than %d terms must be polynomials in %.40s or powers r^%.40s",
                     QDOT_SUM_TERMS, f->index, f->index);
}

qdot_status
qdot_forms_sum_next(qdot_machine *m, uint32_t *pc)
{
    qdot_sum_frame *f = &m->frames.at[m->frames.n - 1];
    uint32_t body = m->program->list.at[f->resume - 1].to;

    QDOT_TRY(qdot_machine_take(m, 1));
    if (f->symbol != QDOT_NIL)
        return finish_sum_by_formula(m, pc);
    QDOT_TRY(qdot_vec_push(&m->terms, m->args.at[0]));
    qdot_names_pop(m->session->names);
    f->bound = false;
    return begin_next_summand(m, pc, body);
}

qdot_status
qdot_forms_if(qdot_machine *m, const qdot_postfix *code, uint32_t *pc)
{
    qdot_slot *s = qdot_machine_top(m, 1);
    qdot_slot none = {0};

    if (m->session->evaluation->passed != NULL)
        m->session->evaluation->passed->branches++;
    if (s->run != NULL)
        return qdot_machine_along_condition(s->run);
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

void
qdot_forms_else(qdot_machine *m, const qdot_postfix *code, uint32_t *pc)
{
    if (qdot_machine_top(m, 2)->value != QDOT_TRUE)
        return;
    if (m->session->evaluation->passed != NULL)
        m->session->evaluation->passed->branches--;
    *qdot_machine_top(m, 2) = *qdot_machine_top(m, 1);
    m->stack.n--;
    *pc = code->to;
}

/* Finish if(...) with an undecided condition; for vectors of equal size, component by component. */
qdot_status
qdot_forms_end(qdot_machine *m)
{
    qdot_expr c, a, b;
    uint32_t n;

    if (m->session->evaluation->passed != NULL)
        m->session->evaluation->passed->branches--;
    if (qdot_machine_top(m, 3)->value == QDOT_FALSE) {
        *qdot_machine_top(m, 3) = *qdot_machine_top(m, 1);
        m->stack.n -= 2;
        return QDOT_OK;
    }
    QDOT_TRY(qdot_machine_take(m, 3));
    c = m->args.at[0], a = m->args.at[1], b = m->args.at[2];
    if (qdot_expr_is_scalar(m->pool, a) && qdot_expr_is_scalar(m->pool, b))
        return qdot_machine_push(m, qdot_fun(m->pool, QDOT_IF, 3, m->args.at));
    n = qdot_expr_count(m->pool, a);
    if (qdot_expr_kind(m->pool, a) != QDOT_VEC ||
        qdot_expr_kind(m->pool, b) != QDOT_VEC || qdot_expr_count(m->pool, b) != n)
        return qdot_fail(QDOT_ETYPE, "if(CONDITION, A, B) takes A and B of one kind");
    QDOT_TRY(qdot_grow(&m->args.at, &m->args.capacity, n, sizeof *m->args.at));
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr parts[3] = {c, qdot_expr_arg(m->pool, a, i),
                              qdot_expr_arg(m->pool, b, i)};

        m->args.at[i] = qdot_fun(m->pool, QDOT_IF, 3, parts);
    }
    return qdot_machine_push(m, qdot_vector(m->pool, n, m->args.at));
}
