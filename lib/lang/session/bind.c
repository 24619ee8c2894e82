/* bind.c -- from expressions to numbers: the values of `set`, then those that runs
 * gave. */
#include "lang/session/bind.h"

#include <math.h>

#include "base/interrupt.h"
#include "base/text.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/print-name.h"
#include "expr/print.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/values.h"
#include "tape/tape.h"

/* --- values of parameters and functions --------------------------------------------- */

/* Insert the arguments of an application into the definition f(formals) = body, and take its derivatives. */
static qdot_expr
insert_function_definition(qdot_pool *pool, qdot_expr application, qdot_expr head, qdot_expr body)
{
    uint32_t n = qdot_expr_count(pool, application) / 2;
    qdot_vec(qdot_expr) formals = {0}, actual = {0};
    qdot_expr value = body;

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr formal = qdot_expr_arg(pool, head, i);
        int64_t order = 0;

        if (qdot_vec_push(&formals, formal) != QDOT_OK ||
            qdot_vec_push(&actual, qdot_expr_arg(pool, application, i)) != QDOT_OK) {
            value = qdot_pool_fail(pool);
            break;
        }
        (void)qdot_expr_to_int(pool, qdot_expr_arg(pool, application, n + i), &order);
        for (; order > 0; order--)
            value = qdot_diff(pool, value, formal);
    }
    if (value != QDOT_NIL)
        value = qdot_subs(pool, value, formals.n, formals.at, actual.at);
    qdot_free(formals.at);
    qdot_free(actual.at);
    return value;
}

/* Replace every application of a defined function by its value. */
static qdot_expr
insert_functions(qdot_session *session, qdot_expr e)
{
    qdot_pool *pool = session->pool;
    qdot_expr atoms = qdot_expr_atoms(pool, e, true);
    qdot_vec(qdot_expr) from = {0}, to = {0};

    if (atoms == QDOT_NIL)
        return QDOT_NIL;
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr atom = qdot_expr_arg(pool, atoms, i);

        if (qdot_expr_kind(pool, atom) != QDOT_UFUN)
            continue;
        for (size_t k = 0; k < session->values->set_symbols.n; k++) {
            qdot_expr head = session->values->set_symbols.at[k];

            if (qdot_expr_kind(pool, head) != QDOT_UFUN ||
                qdot_expr_node(pool, head)->op != qdot_expr_node(pool, atom)->op)
                continue;
            if (qdot_vec_push(&from, atom) != QDOT_OK ||
                qdot_vec_push(&to, insert_function_definition(pool, atom, head,
                                                              session->values->set_values.at[k])) != QDOT_OK)
                e = qdot_pool_fail(pool);
            break;
        }
    }
    if (from.n > 0 && from.n == to.n && e != QDOT_NIL)
        e = qdot_subs(pool, e, from.n, from.at, to.at);
    qdot_free(from.at);
    qdot_free(to.at);
    return e;
}

qdot_expr
qdot_session_bind(qdot_session *session, qdot_expr e)
{
    qdot_pool *pool = session->pool;

    /* A value may hold other parameters, these others again: at most as often as there
     * are. */
    for (size_t round = 0; round <= session->values->set_symbols.n + 1; round++) {
        uint32_t holds = e == QDOT_NIL ? 0 : qdot_expr_node(pool, e)->holds;
        qdot_expr before = e;

        if (session->values->set_symbols.n == 0 ||
            !(holds & (QDOT_HAS_PARAM | QDOT_HAS_UFUN | QDOT_HAS_MOMENTUM | QDOT_HAS_FORMAL)))
            return e;
        e = qdot_subs(pool, e, session->values->set_symbols.n, session->values->set_symbols.at,
                      session->values->set_values.at);
        if (e != QDOT_NIL && (qdot_expr_node(pool, e)->holds & QDOT_HAS_UFUN))
            e = insert_functions(session, e);
        if (e == before || e == QDOT_NIL)
            return e;
        if (qdot_interrupt_check() != QDOT_OK)
            return qdot_pool_fail(pool);
    }
    (void)qdot_fail(QDOT_EINVAL,
                    "the values of the parameters refer to each other in a circle");
    return qdot_pool_fail(pool);
}

/* --- expressions as numbers --------------------------------------------------------- */

/* List the symbols in e that stand for results of runs. */
static qdot_status
find_measured(qdot_session *session, qdot_expr e, size_t *n, const qdot_measured ***list)
{
    qdot_vec(const qdot_measured *) found = {0};
    qdot_expr atoms;

    *n = 0;
    *list = NULL;
    if (!(qdot_expr_node(session->pool, e)->holds & QDOT_HAS_FORMAL))
        return QDOT_OK;
    atoms = qdot_expr_atoms(session->pool, e, false);
    QDOT_TRY(qdot_pool_check(session->pool));
    for (uint32_t i = 0; i < qdot_expr_count(session->pool, atoms); i++) {
        qdot_expr atom = qdot_expr_arg(session->pool, atoms, i);

        for (size_t k = 0; k < session->measured->n; k++)
            if (session->measured->at[k].symbol == atom &&
                qdot_vec_push(&found, &session->measured->at[k]) != QDOT_OK) {
                qdot_free(found.at);
                return QDOT_ENOMEM;
            }
    }
    *n = found.n;
    *list = found.at;
    return QDOT_OK;
}

/* Evaluate e with the results of runs as inputs m: its value, and its error, the sum of |de/dm| error(m). */
static qdot_status
evaluate_with_error(qdot_session *session, qdot_expr e, size_t n, const qdot_measured *const *list,
                    double *value, double *error)
{
    qdot_pool *pool = session->pool;
    qdot_vec(qdot_expr) inputs = {0}, outputs = {0};
    qdot_vec(double) in = {0};
    qdot_tape *tape = NULL;
    double *out = NULL;
    bool rounded = false; /* whether some of the results of runs are rounded doubles, not exact numbers */
    qdot_status status = qdot_vec_push(&outputs, e);

    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        status = qdot_vec_push(&inputs, list[i]->symbol);
        if (status == QDOT_OK)
            status = qdot_vec_push(&in, list[i]->value);
        if (status == QDOT_OK)
            status = qdot_vec_push(&outputs, qdot_diff(pool, e, list[i]->symbol));
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = qdot_tape_new(pool, n, inputs.at, outputs.n, outputs.at, &tape);
    if (status == QDOT_OK) {
        out = qdot_calloc(outputs.n + qdot_tape_work(tape), sizeof *out);
        if (out == NULL)
            status = QDOT_ENOMEM;
    }
    if (status == QDOT_OK) {
        qdot_tape_eval(tape, in.at, out, out + outputs.n);
        *value = out[0];
        *error = 0;
        for (size_t i = 0; i < n; i++) {
            *error += fabs(out[i + 1]) * list[i]->error;
            rounded = rounded || list[i]->digits == 0;
        }
        if (rounded)
            *error += 2.3e-16 * fabs(out[0]);
    }
    qdot_tape_free(tape);
    qdot_free(out);
    qdot_free(inputs.at);
    qdot_free(outputs.at);
    qdot_free(in.at);
    return status;
}

/* Fail with QDOT_ETYPE: e is not a scalar. */
static qdot_status
report_not_scalar(qdot_session *session, qdot_expr e)
{
    if (!qdot_expr_is_scalar(session->pool, e))
        return qdot_fail(QDOT_ETYPE, "%s stands where a number belongs",
                         qdot_value_kind_words(session->pool, e));
    return QDOT_OK;
}

qdot_status
qdot_session_number(qdot_session *session, qdot_expr e, double *value, double *error)
{
    const qdot_measured **list = NULL;
    double own_error = 0;
    qdot_status status;
    size_t n;

    e = qdot_session_bind(session, e);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(report_not_scalar(session, e));
    QDOT_TRY(qdot_member_refuse(session, e));
    QDOT_TRY(find_measured(session, e, &n, &list));
    status = n == 0 ? qdot_constant_double(session->pool, e, value)
                    : evaluate_with_error(session, e, n, list, value, &own_error);
    qdot_free(list);
    QDOT_TRY(status);
    if (isnan(*value))
        return qdot_fail(QDOT_EDOMAIN, "not a real number");
    if (error != NULL)
        *error = own_error;
    return QDOT_OK;
}

qdot_status
qdot_session_split(qdot_session *session, qdot_expr e, double *value, double *low)
{
    const qdot_measured **list = NULL;
    int side;
    size_t n;

    *low = 0;
    QDOT_TRY(qdot_session_number(session, e, value, NULL));
    e = qdot_session_bind(session, e);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(find_measured(session, e, &n, &list));
    qdot_free(list);
    return n == 0 ? qdot_constant_split(session->pool, e, value, &side, low) : QDOT_OK;
}

qdot_status
qdot_session_integer(qdot_session *session, qdot_expr e, int64_t *value)
{
    qdot_text text = {0};
    qdot_status status;

    e = qdot_session_bind(session, e);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(report_not_scalar(session, e));
    if (qdot_expr_to_int(session->pool, e, value))
        return QDOT_OK;
    QDOT_TRY(qdot_print(session->pool, e, QDOT_PLAIN, &text));
    status = qdot_fail(QDOT_ETYPE, "`%.*s` stands where an integer belongs", 100,
                       qdot_text_str(&text));
    if (qdot_expr_is_class(session->pool, e, QDOT_PARAM))
        status = qdot_hint("set %.100s = ... gives it a value", qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

/* A value outside the domain of its parameter is an error at once where it is a
 * number. */
qdot_status
qdot_session_in_domain(qdot_session *session, qdot_expr symbol, qdot_expr value)
{
    const qdot_symbol s = *qdot_expr_symbol(session->pool, symbol);
    double x, bound;

    if ((s.lo == QDOT_NIL && s.hi == QDOT_NIL) ||
        qdot_session_number(session, value, &x, NULL) != QDOT_OK)
        return QDOT_OK; /* the expression has no number as its value yet */
    if (s.lo != QDOT_NIL && qdot_session_number(session, s.lo, &bound, NULL) == QDOT_OK &&
        (x < bound || (s.lo_open && x == bound)))
        return qdot_fail(QDOT_EDOMAIN, "%s = %.10g is outside its domain: %s %s %.10g",
                         s.name, x, s.name, s.lo_open ? ">" : ">=", bound);
    if (s.hi != QDOT_NIL && qdot_session_number(session, s.hi, &bound, NULL) == QDOT_OK &&
        (x > bound || (s.hi_open && x == bound)))
        return qdot_fail(QDOT_EDOMAIN, "%s = %.10g is outside its domain: %s %s %.10g",
                         s.name, x, s.name, s.hi_open ? "<" : "<=", bound);
    return QDOT_OK;
}
