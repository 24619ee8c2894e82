/* mixture.c -- evaluates an expression that combines several runs, at given times. */
#include "lang/session/mixture.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"
#include "tape/tape.h"

struct qdot_mixture {
    qdot_expr e;                       /* the expression, with parameter values inserted */
    qdot_vec(qdot_run *) runs;         /* the runs in the expression, each once */
    qdot_vec(qdot_run_member) members; /* values along runs (a.x ...); a symbol without a run: of the latest */
    qdot_vec(qdot_expr) symbols;       /* the symbols that stand for the members */
    qdot_tape *tape;                   /* the tape (list of operations) that computes e from the symbols */
    size_t room;                 /* allocated length of values and errors */
    double *values, *errors;     /* [symbols x times] values of the symbols and their errors */
    double *in;                  /* [symbols] inputs, then work space of the tape */
};

void
qdot_mixture_free(qdot_mixture *x)
{
    if (x == NULL)
        return;
    qdot_free(x->runs.at);
    qdot_free(x->members.at);
    qdot_free(x->symbols.at);
    qdot_tape_free(x->tape);
    qdot_free(x->values);
    qdot_free(x->errors);
    qdot_free(x->in);
    qdot_free(x);
}

/* Find the index of a run in the list; it is appended if new. */
static qdot_status
find_or_add_run(qdot_mixture *x, qdot_run *run, size_t *k)
{
    for (*k = 0; *k < x->runs.n; ++*k)
        if (x->runs.at[*k] == run)
            return QDOT_OK;
    return qdot_vec_push(&x->runs, run);
}

/* A symbol for an atom of the expression: itself, or, of x(t - tau), one of its own, which takes its place in *e. */
static qdot_expr
symbol_for_atom(qdot_pool *pool, qdot_expr atom, qdot_expr *e)
{
    char name[32];
    qdot_expr symbol;

    if (qdot_expr_kind(pool, atom) == QDOT_SYM)
        return atom;
    snprintf(name, sizeof name, "#%" PRIu64, (uint64_t)atom);
    symbol = qdot_symbol_get(pool, QDOT_FORMAL, name);
    *e = qdot_subs(pool, *e, 1, &atom, &symbol);
    return symbol;
}

static qdot_status
find_run_values(qdot_session *session, const char *run, qdot_expr *e, qdot_mixture *x)
{
    qdot_pool *pool = session->pool;
    const qdot_expr atoms = qdot_expr_atoms(pool, *e, qdot_has_delayed(pool, *e));

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        const qdot_expr atom = qdot_expr_arg(pool, atoms, i);
        const qdot_member *m = qdot_member_find(session, atom);
        qdot_run_member own = {.value = m != NULL ? m->value : atom};
        qdot_named_run *named;

        if (m == NULL &&
            !(qdot_expr_node(session->pool, atom)->holds & QDOT_MEMBER_MOTION))
            continue;
        QDOT_TRY(qdot_runs_read(session, m != NULL ? m->run : run, &named));
        QDOT_TRY(find_or_add_run(x, named->run, &own.run));
        own.symbol = symbol_for_atom(pool, atom, e);
        QDOT_TRY(qdot_vec_push(&x->symbols, own.symbol));
        QDOT_TRY(qdot_vec_push(&x->members, own));
    }
    return QDOT_OK;
}

static qdot_status
prepare_mixture(qdot_session *session, const char *run, qdot_expr e, qdot_mixture *x)
{
    QDOT_TRY(find_run_values(session, run, &e, x));
    x->e = e = qdot_session_bind(session, e);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_tape_new(session->pool, x->symbols.n, x->symbols.at, 1, &e, &x->tape));
    x->in = qdot_calloc(x->symbols.n + qdot_tape_work(x->tape) + 1, sizeof *x->in);
    return x->in != NULL ? QDOT_OK : QDOT_ENOMEM;
}

qdot_status
qdot_mixture_new(qdot_session *session, const char *run, qdot_expr e, qdot_mixture **out)
{
    qdot_mixture *x = qdot_calloc(1, sizeof *x);
    qdot_status status = x != NULL ? prepare_mixture(session, run, e, x) : QDOT_ENOMEM;

    if (status != QDOT_OK) {
        qdot_mixture_free(x);
        x = NULL;
    }
    *out = x;
    return status;
}

static qdot_status
allocate_for_times(qdot_mixture *x, size_t times)
{
    const size_t n = x->symbols.n * times + 1;

    if (n <= x->room)
        return QDOT_OK;
    qdot_free(x->values);
    qdot_free(x->errors);
    x->values = qdot_calloc(n, sizeof *x->values);
    x->errors = qdot_calloc(n, sizeof *x->errors);
    x->room = x->values != NULL && x->errors != NULL ? n : 0;
    return x->room > 0 ? QDOT_OK : QDOT_ENOMEM;
}

/* Evaluate the expression at time j, and its error: the sum of its changes when each symbol is shifted by its error. */
static void
evaluate_at_time(const qdot_mixture *x, const qdot_samples *at, size_t j)
{
    const size_t k = at->n;
    double *in = x->in, *work = in + x->symbols.n, *value = at->values + j, sum, moved;

    for (size_t i = 0; i < x->symbols.n; i++)
        in[i] = x->values[i * k + j];
    qdot_tape_eval(x->tape, in, value, work);
    if (at->errors == NULL)
        return;
    sum = DBL_EPSILON * fabs(*value);
    for (size_t i = 0; i < x->symbols.n; i++) {
        in[i] += x->errors[i * k + j];
        qdot_tape_eval(x->tape, in, &moved, work);
        sum += fabs(moved - *value);
        in[i] = x->values[i * k + j];
    }
    at->errors[j] = sum;
}

qdot_status
qdot_mixture_values(qdot_mixture *x, const qdot_samples *at)
{
    const qdot_exact_times times = {at->n, at->times, at->lows};

    QDOT_TRY(allocate_for_times(x, at->n));
    for (size_t i = 0; i < x->symbols.n; i++)
        QDOT_TRY(qdot_run_values_beyond(
            x->runs.at[x->members.at[i].run], 1, &x->members.at[i].value, &times,
            x->values + i * at->n,
            at->errors != NULL ? x->errors + i * at->n : NULL));
    for (size_t j = 0; j < at->n; j++)
        evaluate_at_time(x, at, j);
    return QDOT_OK;
}

qdot_status
qdot_mixture_range(const qdot_mixture *x, qdot_range_kind kind, const double *range,
                   double *value, double *error)
{
    const qdot_run_expression along = {
        x->e, x->runs.n, x->members.n, x->runs.at, x->members.at};

    return qdot_run_range_along(&along, kind, range, value, error);
}

/* --- several times at once ----------------------------------------------------------- */

qdot_status
qdot_member_values(qdot_session *session, const char *run, qdot_expr e,
                   const qdot_samples *at)
{
    qdot_mixture *x;
    qdot_status status = qdot_mixture_new(session, run, e, &x);

    if (status == QDOT_OK)
        status = qdot_mixture_values(x, at);
    qdot_mixture_free(x);
    return status;
}

qdot_status
qdot_member_exactly(qdot_session *session, const char *run, qdot_expr e, qdot_expr time,
                    qdot_expr *value)
{
    qdot_mixture *x;
    bool exact = true;
    qdot_status status = qdot_mixture_new(session, run, e, &x);

    *value = QDOT_NIL;
    for (size_t k = 0; status == QDOT_OK && k < x->runs.n; k++)
        exact = exact && qdot_run_get_report(x->runs.at[k])->digits > 0;
    for (size_t i = 0; status == QDOT_OK && exact && i < x->symbols.n; i++) {
        const qdot_member *m = qdot_member_find(session, x->symbols.at[i]);
        qdot_measured number;
        qdot_expr by;

        status = qdot_runs_measure_one(session, m != NULL ? m->run : run,
                                       x->members.at[i].value, time, &number);
        if (status != QDOT_OK)
            break;
        by = qdot_measured_add(session, number);
        e = qdot_subs(session->pool, e, 1, &x->symbols.at[i], &by);
    }
    if (status == QDOT_OK && exact) {
        *value = e;
        status = qdot_pool_check(session->pool);
    }
    qdot_mixture_free(x);
    return status;
}

qdot_status
qdot_member_span(qdot_session *session, qdot_expr e, double *from, double *to)
{
    for (size_t i = 0; i < session->members->n; i++) {
        const qdot_run_report *report;
        qdot_named_run *named;

        if (!qdot_expr_contains(session->pool, e, session->members->at[i].symbol))
            continue;
        QDOT_TRY(qdot_runs_find(session, session->members->at[i].run, &named));
        report = qdot_run_get_report(named->run);
        *from = fmax(*from, fmin(report->t0, report->t1));
        *to = fmin(*to, fmax(report->t0, report->t1));
    }
    return QDOT_OK;
}
