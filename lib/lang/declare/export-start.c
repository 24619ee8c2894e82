/* export-start.c -- the start state of an exported motion, its times and its tolerance. */
#include "lang/declare/export-start.h"

#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "lang/session/bind.h"
#include "lang/session/runs.h"
#include "lang/session/start-kind.h"
#include "lang/session/start-speeds.h"
#include "lang/session/values.h"

#define LEAST_TOL 1e-13 /* smallest tolerance that methods in doubles reach over many steps */

typedef qdot_vec(qdot_expr) expressions;

/* Append q, q'. */
static qdot_status
list_state(const qdot_scene *scene, expressions *y)
{
    const size_t n = scene->coordinates.n;

    for (size_t i = 0; i < 2 * n; i++)
        QDOT_TRY(qdot_vec_push(y, qdot_symbol_jet(scene->pool, scene->coordinates.at[i % n], i >= n)));
    return qdot_pool_check(scene->pool);
}

/* Whether the run was made for the coordinates of the scene. */
static bool
is_run_of_scene(const qdot_scene *scene, const qdot_run_report *r)
{
    if (r->n - r->n_states != scene->coordinates.n)
        return false;
    for (size_t i = 0; i < scene->coordinates.n; i++)
        if (r->coordinates[i] != scene->coordinates.at[i])
            return false;
    return true;
}

static qdot_status
start_of_run(qdot_run *run, size_t n, const qdot_expr *y, const qdot_export_started *to)
{
    const qdot_run_report *r = qdot_run_get_report(run);

    QDOT_TRY(qdot_run_values(run, n, y, 1, &r->t0, to->start, NULL));
    for (size_t i = 0; i < to->x->k; i++) { /* values, including those of `run ... with` */
        double value;

        if (qdot_run_values(run, 1, &to->parameters[i], 1, &r->t0, &value, NULL) == QDOT_OK)
            to->values[i].value = value;
    }
    to->x->t0 = r->t0;
    to->x->t1 = qdot_run_requested_end(run);
    to->x->tol = r->digits > 0 ? LEAST_TOL : fmax(r->tol / 10, LEAST_TOL); /* since the exported method has a lower order */
    return QDOT_OK;
}

/* *value: the number of e with the values of `set`; NaN if it holds a parameter to which no value was given. */
static qdot_status
number_or_nan(qdot_session *s, qdot_expr e, double *value)
{
    const qdot_status status = qdot_session_number(s, e, value, NULL);

    if (status != QDOT_EUNSET)
        return status;
    *value = NAN;
    return QDOT_OK;
}

/* Fill in the start that the statements `start` give to y [2n], q and q', and what is not stated: the span of time and the
 * tolerance. stated [2n]: the values as expressions, 0 of those that are not named. The rate of a state follows from the rest. */
static qdot_status
stated_start(qdot_session *s, size_t n, const qdot_expr *y, qdot_expr *stated, const qdot_export_started *to)
{
    const qdot_scene *scene = s->scene;

    for (size_t i = 0; i < 2 * n; i++) {
        const qdot_expr value = qdot_session_value_started(s, y[i]);

        stated[i] = value == QDOT_NIL ? QDOT_ZERO : value;
    }
    if (qdot_session_starts_by_speeds(s))
        QDOT_TRY(qdot_session_start_velocities(s, 0, NULL, NULL, QDOT_ZERO, stated + n));
    to->x->t1 = 10;
    to->x->tol = LEAST_TOL;
    for (size_t i = 0; i < 2 * n; i++) {
        const qdot_state *state = i < n ? NULL : qdot_scene_state_of(scene, y[i - n]);
        qdot_expr e = stated[i];

        if (state != NULL) {
            e = qdot_subs(s->pool, qdot_session_bind(s, state->rate), 2 * n, y, stated);
            e = qdot_subs(s->pool, e, 1, (qdot_expr[]){QDOT_T}, (qdot_expr[]){QDOT_ZERO});
        }
        QDOT_TRY(qdot_pool_check(s->pool));
        QDOT_TRY(number_or_nan(s, e, &to->start[i]));
    }
    return QDOT_OK;
}

static qdot_status
find(qdot_session *s, bool massless, size_t n, const qdot_expr *y, const qdot_export_started *to)
{
    qdot_run *run = s->runs->n > 0 ? s->runs->at[s->runs->n - 1].run : NULL;
    qdot_expr *stated;
    qdot_status status;

    if (run != NULL && is_run_of_scene(s->scene, qdot_run_get_report(run)))
        return start_of_run(run, 2 * n, y, to);
    if (massless) {
        (void)qdot_fail(QDOT_EINVAL, "the start of a coordinate without mass follows from its equation: it is taken from a run");
        return qdot_hint("run 0..10 before");
    }
    if (qdot_session_starts_by_momenta(s)) {
        (void)qdot_fail(QDOT_EINVAL, "the start gives momenta: the velocities are taken from a run");
        return qdot_hint("run 0..10 before");
    }
    stated = qdot_calloc(2 * n + 1, sizeof *stated);
    status = stated != NULL ? stated_start(s, n, y, stated, to) : QDOT_ENOMEM;
    qdot_free(stated);
    return status;
}

qdot_status
qdot_export_start(qdot_session *s, bool massless, const qdot_export_started *to)
{
    expressions y = {0};
    qdot_status status = list_state(s->scene, &y);

    if (status == QDOT_OK)
        status = find(s, massless, y.n / 2, y.at, to);
    qdot_free(y.at);
    return status;
}
