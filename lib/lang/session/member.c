/* member.c -- `a.x` inside a larger expression: values along several runs at once.
 *
 * Where a.EXPR meets an operator it becomes a symbol of its own, spelled "a.EXPR", that
 * the session remembers. An expression of such symbols is evaluated run by run, and then
 * itself; what is along no run named is along the latest.
 */
#include "lang/session/member.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/runs.h"
#include "tape/tape.h"

static const uint32_t motion = QDOT_HAS_TIME | QDOT_HAS_COORD | QDOT_HAS_VELOCITY |
                               QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER;

static const qdot_member *
find(const qdot_session *session, qdot_expr symbol)
{
    for (size_t i = 0; i < session->members.n; i++)
        if (session->members.at[i].symbol == symbol)
            return &session->members.at[i];
    return NULL;
}

/* The symbol of the scalar e along the run. */
static qdot_expr
make(qdot_session *session, const char *run, qdot_expr e)
{
    qdot_pool *pool = session->pool;
    bool plain = qdot_expr_kind(pool, e) == QDOT_SYM;
    qdot_member m = {.value = e};
    qdot_text name = {0}, text = {0};
    qdot_status status;

    for (size_t i = 0; i < session->members.n; i++)
        if (session->members.at[i].value == e &&
            strcmp(session->members.at[i].run, run) == 0)
            return session->members.at[i].symbol;
    status = qdot_print(pool, e, QDOT_PLAIN, &text);
    qdot_text_format(&name, plain ? "%s.%s" : "%s.(%s)", run, qdot_text_str(&text));
    if (status == QDOT_OK)
        status = qdot_text_status(&name);
    if (status == QDOT_OK)
        m.symbol = qdot_symbol_get(pool, QDOT_FORMAL, qdot_text_str(&name));
    m.run = status == QDOT_OK && m.symbol != QDOT_NIL ? qdot_strdup(run) : NULL;
    if (m.run == NULL || qdot_vec_push(&session->members, m) != QDOT_OK) {
        qdot_free(m.run);
        m.symbol = QDOT_NIL;
    }
    qdot_text_clear(&name);
    qdot_text_clear(&text);
    return m.symbol != QDOT_NIL ? m.symbol : qdot_pool_fail(pool);
}

typedef struct {
    qdot_session *session;
    const char *run;
} naming;

static qdot_expr
name_one(qdot_pool *pool, qdot_expr scalar, void *user)
{
    const naming *n = user;

    (void)pool;
    return make(n->session, n->run, scalar);
}

qdot_expr
qdot_member_of(qdot_session *session, const char *run, qdot_expr e)
{
    naming n = {session, run};

    return qdot_expr_is_scalar(session->pool, e)
               ? make(session, run, e)
               : qdot_value_map(session->pool, e, name_one, &n);
}

bool
qdot_member_any(const qdot_session *session, qdot_expr e)
{
    if (!(qdot_expr_node(session->pool, e)->holds & QDOT_HAS_FORMAL))
        return false;
    for (size_t i = 0; i < session->members.n; i++)
        if (qdot_expr_contains(session->pool, e, session->members.at[i].symbol))
            return true;
    return false;
}

/* --- one run ------------------------------------------------------------------------- */

/* Whether e is along one run only; *run its name, NULL where no run is named. */
static bool
along_one(const qdot_session *session, qdot_expr e, const char **run)
{
    const char *only = NULL;
    bool one = true;

    for (size_t i = 0; i < session->members.n; i++) {
        const qdot_member *m = &session->members.at[i];

        if (!qdot_expr_contains(session->pool, e, m->symbol))
            continue;
        one = one && (only == NULL || strcmp(only, m->run) == 0);
        only = m->run;
    }
    if (only != NULL && (qdot_expr_node(session->pool, e)->holds & motion))
        one = false;
    *run = only;
    return one;
}

static qdot_expr
put_back(qdot_session *session, qdot_expr e)
{
    for (size_t i = session->members.n; i-- > 0 && e != QDOT_NIL;) {
        qdot_expr from = session->members.at[i].symbol, to = session->members.at[i].value;

        e = qdot_subs(session->pool, e, 1, &from, &to);
    }
    return e;
}

qdot_status
qdot_member_resolve(qdot_session *session, const char **run, qdot_expr *e, bool *mixed)
{
    const char *own;

    *mixed = false;
    if (!qdot_member_any(session, *e))
        return QDOT_OK;
    if (!along_one(session, *e, &own) || (*run != NULL && strcmp(*run, own) != 0)) {
        *mixed = true;
        return QDOT_OK;
    }
    *run = own;
    *e = put_back(session, *e);
    return qdot_pool_check(session->pool);
}

/* --- several ------------------------------------------------------------------------- */

typedef struct {
    qdot_vec(qdot_expr) symbols; /* members, and what moves beside them */
    double *values, *errors;     /* [symbols x times] */
    qdot_tape *tape;
} mixture;

static void
clear(mixture *x)
{
    qdot_free(x->symbols.at);
    qdot_free(x->values);
    qdot_free(x->errors);
    qdot_tape_free(x->tape);
}

static qdot_status
find_symbols(qdot_session *session, qdot_expr e, mixture *x)
{
    qdot_expr atoms = qdot_expr_atoms(session->pool, e, false);

    QDOT_TRY(qdot_pool_check(session->pool));
    for (uint32_t i = 0; i < qdot_expr_count(session->pool, atoms); i++) {
        qdot_expr atom = qdot_expr_arg(session->pool, atoms, i);

        if (find(session, atom) != NULL ||
            (qdot_expr_node(session->pool, atom)->holds & motion))
            QDOT_TRY(qdot_vec_push(&x->symbols, atom));
    }
    return QDOT_OK;
}

/* Every symbol along its run. */
static qdot_status
read_symbols(qdot_session *session, const char *run, const qdot_samples *at, mixture *x)
{
    const size_t k = at->n;

    x->values = qdot_calloc(x->symbols.n * k + 1, sizeof *x->values);
    x->errors = qdot_calloc(x->symbols.n * k + 1, sizeof *x->errors);
    if (x->values == NULL || x->errors == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < x->symbols.n; i++) {
        const qdot_member *m = find(session, x->symbols.at[i]);
        qdot_expr e = m != NULL ? m->value : x->symbols.at[i];
        qdot_named_run *named;

        QDOT_TRY(qdot_runs_find(session, m != NULL ? m->run : run, &named));
        QDOT_TRY(qdot_run_values_beyond(named->run, 1, &e,
                                        &(qdot_exact_times){k, at->times, at->lows},
                                        x->values + i * k, x->errors + i * k));
    }
    return QDOT_OK;
}

/* The value at time j and its error, by moving each symbol by its own. */
static void
combine(const mixture *x, const qdot_samples *at, size_t j, double *in, double *work)
{
    const size_t k = at->n;
    double sum, moved, *value = at->values + j;

    for (size_t i = 0; i < x->symbols.n; i++)
        in[i] = x->values[i * k + j];
    qdot_tape_eval(x->tape, in, value, work);
    sum = DBL_EPSILON * fabs(*value);
    for (size_t i = 0; i < x->symbols.n; i++) {
        in[i] += x->errors[i * k + j];
        qdot_tape_eval(x->tape, in, &moved, work);
        sum += fabs(moved - *value);
        in[i] = x->values[i * k + j];
    }
    if (at->errors != NULL)
        at->errors[j] = sum;
}

qdot_status
qdot_member_values(qdot_session *session, const char *run, qdot_expr e,
                   const qdot_samples *at)
{
    mixture x = {0};
    double *in = NULL;
    qdot_status status = find_symbols(session, e, &x);

    if (status == QDOT_OK)
        status = read_symbols(session, run, at, &x);
    if (status == QDOT_OK) {
        e = qdot_session_bind(session, e);
        status = qdot_pool_check(session->pool);
    }
    if (status == QDOT_OK)
        status = qdot_tape_new(session->pool, x.symbols.n, x.symbols.at, 1, &e, &x.tape);
    if (status == QDOT_OK) {
        in = qdot_calloc(x.symbols.n + qdot_tape_work(x.tape) + 1, sizeof *in);
        status = in == NULL ? QDOT_ENOMEM : QDOT_OK;
    }
    for (size_t j = 0; j < at->n && status == QDOT_OK; j++)
        combine(&x, at, j, in, in + x.symbols.n);
    qdot_free(in);
    clear(&x);
    return status;
}

qdot_status
qdot_member_exactly(qdot_session *session, const char *run, qdot_expr e, qdot_expr time,
                    qdot_expr *value)
{
    mixture x = {0};
    bool exact = true;
    qdot_status status = find_symbols(session, e, &x);

    *value = QDOT_NIL;
    for (size_t i = 0; i < x.symbols.n && status == QDOT_OK && exact; i++) {
        const qdot_member *m = find(session, x.symbols.at[i]);
        qdot_named_run *named;

        status = qdot_runs_find(session, m != NULL ? m->run : run, &named);
        exact = status == QDOT_OK && qdot_run_get_report(named->run)->digits > 0;
    }
    for (size_t i = 0; i < x.symbols.n && status == QDOT_OK && exact; i++) {
        const qdot_member *m = find(session, x.symbols.at[i]);
        qdot_measured number;
        qdot_expr by;

        status =
            m != NULL
                ? qdot_runs_measure_one(session, m->run, m->value, time, &number)
                : qdot_runs_measure_one(session, run, x.symbols.at[i], time, &number);
        if (status != QDOT_OK)
            break;
        by = qdot_measured_add(session, number);
        e = qdot_subs(session->pool, e, 1, &x.symbols.at[i], &by);
    }
    if (status == QDOT_OK && exact) {
        *value = e;
        status = qdot_pool_check(session->pool);
    }
    clear(&x);
    return status;
}

qdot_status
qdot_member_span(qdot_session *session, qdot_expr e, double *from, double *to)
{
    for (size_t i = 0; i < session->members.n; i++) {
        const qdot_run_report *report;
        qdot_named_run *named;

        if (!qdot_expr_contains(session->pool, e, session->members.at[i].symbol))
            continue;
        QDOT_TRY(qdot_runs_find(session, session->members.at[i].run, &named));
        report = qdot_run_get_report(named->run);
        *from = fmax(*from, fmin(report->t0, report->t1));
        *to = fmin(*to, fmax(report->t0, report->t1));
    }
    return QDOT_OK;
}
