/* find-orbit.c -- improves the guess of a periodic orbit by multiple shooting, for the statement `find`. */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/symbol.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/trial.h"
#include "lang/session/values.h"
#include "lang/slopes/free-request.h"
#include "lang/unknowns/find-parts.h"

typedef struct {
    const qdot_find *f;
    size_t k, n;
    qdot_expr *unknowns, *at; /* [k] symbols of the unknowns; their guessed values */
    const char **names;       /* [k] names of the unknowns */
    qdot_expr *values, *start; /* [n_values] parameter values, [2n] start, in terms of the unknowns */
    bool *named;              /* [2n] whether the `start` statement gives this value */
    qdot_request order;       /* request of the run at the guess */
    qdot_run_request free;    /* the same request with the unknowns as symbols */
    qdot_expr period;
} guess;

static qdot_status
begin_guess(guess *x)
{
    qdot_pool *pool = x->f->c->session->pool;

    x->unknowns = qdot_calloc(2 * x->k + 2 * x->n + 1, sizeof *x->unknowns);
    x->names = qdot_calloc(x->k + 1, sizeof *x->names);
    x->named = qdot_calloc(2 * x->n + 1, sizeof *x->named);
    if (!x->unknowns || !x->names || !x->named)
        return QDOT_ENOMEM;
    x->at = x->unknowns + x->k;
    x->start = x->at + x->k;
    for (size_t i = 0; i < x->k; i++) {
        x->unknowns[i] = x->f->unknowns.at[i].symbol;
        x->names[i] = x->f->unknowns.at[i].label;
        x->at[i] = qdot_measured_rational(pool, x->f->guess.at[i]);
    }
    return qdot_pool_check(pool);
}

/* Make the request of a run whose start and period are functions of the unknowns; the guesses are set before. */
static qdot_status
make_request(guess *x)
{
    qdot_session *session = x->f->c->session;
    qdot_expr from, to, last;

    QDOT_TRY(qdot_find_limits(x->f, &from, &to));
    last = qdot_session_bind(session, to);
    from = qdot_session_bind(session, from);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_run_options_fill(session, &x->f->run, from, last, &x->order));
    x->values = qdot_calloc(x->order.request.n_values + 1, sizeof *x->values);
    if (x->values == NULL)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_free_request(session, x->k, x->unknowns, &x->order.request, x->values, x->start, x->named,
                               &x->free));
    for (size_t i = 0; i < x->k; i++) /* in the period, each unknown and parameter stands for itself */
        if (!qdot_expr_is_class(session->pool, x->unknowns[i], QDOT_COORD))
            QDOT_TRY(qdot_session_put(session, x->unknowns[i], x->unknowns[i]));
    x->period = qdot_session_bind(session, qdot_sub(session->pool, to, from));
    return qdot_pool_check(session->pool);
}

static qdot_status
carry_out_shooting(guess *x, qdot_shooting_result *r)
{
    const qdot_find *f = x->f;
    const qdot_shooting_of of = {.scene = f->c->session->scene,
                                 .request = &x->free,
                                 .k = x->k,
                                 .unknowns = x->unknowns,
                                 .names = x->names,
                                 .start = x->start,
                                 .period = x->period,
                                 .low = f->low.at,
                                 .high = f->high.at};

    return qdot_shooting_find(&of, r);
}

qdot_status
qdot_find_shoot(const qdot_find *f, qdot_shooting_result *r)
{
    qdot_session *session = f->c->session;
    guess x = {.f = f, .k = f->unknowns.n, .n = session->scene->coordinates.n};
    qdot_trial trial;
    qdot_status status;

    r->found = false;
    if (f->conditions.n > 1 || session->scene->constraints.n > 0)
        return QDOT_OK;
    QDOT_TRY(qdot_trial_begin(&trial, session));
    status = begin_guess(&x);
    if (status == QDOT_OK)
        status = qdot_slope_names_put(session, x.k, f->unknowns.at, x.at);
    if (status == QDOT_OK)
        status = make_request(&x);
    qdot_trial_end(&trial);
    if (status == QDOT_OK)
        status = carry_out_shooting(&x, r);
    qdot_request_free(&x.order);
    qdot_free(x.unknowns);
    qdot_free(x.names);
    qdot_free(x.named);
    qdot_free(x.values);
    return status;
}
