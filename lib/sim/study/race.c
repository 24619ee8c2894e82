/* race.c -- runs several formulations of a scene and a reference run, and compares their end states. */
#include "sim/study/race.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/progress.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "mech/coordinates/minimal.h"
#include "sim/course/run-state.h"
#include "sim/model/substitute.h"

static const double reference_tol = 1e-15;
static const double ladder[QDOT_RACE_TOLERANCES] = {1e-4,  1e-6,  1e-8,
                                                    1e-10, 1e-12, 1e-14};

/* Measured CPU times (s) shorter than this are measured again. */
static const double long_enough = 5e-3;
enum { MOST_REPEATS = 5, MINIMAL = 3 };

static const char *const names[QDOT_RACE_FORMULATIONS] = {
    "as given, projected", "as given, baumgarte", "as given, none",
    "minimal coordinates"};

typedef struct {
    qdot_scene *scene;
    const qdot_run_request *request; /* the request for the given coordinates */
    qdot_run *reference;
    size_t n;
    double *end; /* [2n] end state of the reference run */
    double *values; /* [2n] values in the coordinates of a formulation */
    qdot_race *race;
} race;

void
qdot_race_clear(qdot_race *r)
{
    for (int i = 0; i < QDOT_RACE_FORMULATIONS; i++)
        qdot_free(r->lane[i].reason);
    qdot_free(r->notice);
    *r = (qdot_race){0};
}

/* --- running one formulation -------------------------------------------------------- */

/* The largest error of the values [2n] against the end state of the reference run. */
static double
largest_error(const race *r)
{
    double worst = 0;

    for (size_t i = 0; i < 2 * r->n; i++) {
        double e = fabs(r->values[i] - r->end[i]) / fmax(1, fabs(r->end[i]));

        worst = !(e <= worst) ? e : worst;
    }
    return worst;
}

/* Run one formulation; state [2n]: q and q' of the given scene, as expressions in coordinates of `scene`. */
static qdot_status
run_formulation(race *r, qdot_scene *scene, const qdot_run_request *request,
                const qdot_expr *state, qdot_race_entry *entry)
{
    double spent = 0;

    entry->tol = request->tol;
    entry->error = NAN;
    entry->cpu = INFINITY;
    for (int k = 0; k < MOST_REPEATS && spent < long_enough; k++) {
        const qdot_run_report *report;
        qdot_run *run = NULL;
        qdot_status status = qdot_run_new(scene, request, &run);

        if (status != QDOT_OK) {
            qdot_run_free(run);
            return status;
        }
        report = qdot_run_get_report(run);
        entry->method = report->method;
        entry->energy = report->energy_drift;
        entry->constraint = scene == r->scene ? report->constraint_drift : NAN;
        entry->cpu = fmin(entry->cpu, report->cpu);
        spent += report->cpu;
        if (report->status == QDOT_RUN_DONE && k == 0) {
            status = qdot_run_values(run, 2 * r->n, state, 1, &report->t1, r->values,
                                     NULL);
            if (status == QDOT_OK)
                entry->error = largest_error(r);
        }
        if (report->status != QDOT_RUN_DONE)
            spent = INFINITY;
        qdot_run_free(run);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

/* Whether a failure concerns one formulation only, so that the others are still run. */
static bool
is_failure_of_formulation(qdot_status status)
{
    return status == QDOT_EINVAL || status == QDOT_EDOMAIN || status == QDOT_ESINGULAR ||
           status == QDOT_ENOTBUILT || status == QDOT_EFAILED || status == QDOT_ELIMIT;
}

static qdot_status
set_reason(qdot_race_lane *lane, const char *reason)
{
    lane->name = NULL;
    lane->reason = qdot_strdup(reason);
    return lane->reason ? QDOT_OK : QDOT_ENOMEM;
}

static qdot_status
run_at_all_tolerances(race *r, int which, qdot_scene *scene, qdot_run_request request,
                      const qdot_expr *state)
{
    qdot_race_lane *lane = &r->race->lane[which];

    lane->name = r->scene->constraints.n > 0 ? names[which] : "as given";
    for (int k = 0; k < QDOT_RACE_TOLERANCES; k++) {
        qdot_status status = qdot_interrupt_check();

        request.tol = ladder[k];
        qdot_progress_within("%s, tol %.0e", lane->name, request.tol);
        if (status == QDOT_OK)
            status = run_formulation(r, scene, &request, state, &lane->entry[k]);
        if (is_failure_of_formulation(status))
            return set_reason(lane, qdot_last_error()->message);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

/* --- the formulation in minimal coordinates ----------------------------------------- */

/* The value at the start, projected onto the constraints, of an expression in the given coordinates. */
static qdot_expr
value_on_constraints(const race *r, qdot_expr e)
{
    qdot_pool *pool = r->scene->pool;
    const qdot_run *run = r->reference;
    qdot_expr t = QDOT_T;

    for (size_t i = 2 * r->n; i-- > 0;) {
        qdot_expr x = qdot_symbol_jet(pool, r->scene->coordinates.at[i % r->n],
                                      i < r->n ? 0 : 1);
        qdot_expr value = qdot_add(pool, qdot_expr_of_double(pool, run->start[i]),
                                   qdot_expr_of_double(pool, run->start_low[i]));

        e = qdot_subs(pool, e, 1, &x, &value);
    }
    return qdot_subs(pool, e, 1, &t, &r->request->t0);
}

static qdot_status
find_minimal_start(const race *r, const qdot_minimal *m, qdot_expr *q0, qdot_expr *v0)
{
    qdot_pool *pool = r->scene->pool;
    size_t n = m->scene->coordinates.n, kept = n - m->fresh;

    for (size_t i = 0; i < n; i++) {
        qdot_expr e = i < kept ? m->scene->coordinates.at[i] : m->angle[i - kept];

        q0[i] = value_on_constraints(r, e);
        v0[i] = value_on_constraints(r, qdot_ddt(pool, e));
    }
    return qdot_pool_check(pool);
}

static qdot_status
run_in_minimal_coordinates(race *r, const qdot_minimal *m)
{
    size_t n = m->scene->coordinates.n;
    qdot_expr *state = qdot_calloc(2 * r->n + 2 * n + 1, sizeof *state), *q0, *v0;
    qdot_run_request request = *r->request;
    qdot_status status;

    if (!state)
        return QDOT_ENOMEM;
    q0 = state + 2 * r->n;
    v0 = q0 + n;
    status = find_minimal_start(r, m, q0, v0);
    for (size_t i = 0; i < r->n; i++) {
        state[i] = m->given[i];
        state[r->n + i] = qdot_ddt(r->scene->pool, m->given[i]);
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(r->scene->pool);
    request.q0 = q0;
    request.v0 = v0;
    request.q_named = request.v_named = NULL;
    if (status == QDOT_OK)
        status = run_at_all_tolerances(r, MINIMAL, m->scene, request, state);
    r->race->minimal = n;
    qdot_free(state);
    return status;
}

/* The size of e at the start, for qdot_minimal_start (minimal.h); 0 unless e has only coordinates and numbers. */
static double
size_at_start(qdot_expr e, void *user)
{
    const race *r = user;
    double x = 0;
    int side;

    e = qdot_substitute(r->scene->pool, value_on_constraints(r, e), r->request->n_values,
                        r->request->symbols, r->request->values);
    return e != QDOT_NIL && qdot_expr_is_constant(r->scene->pool, e) &&
                   qdot_constant_round(r->scene->pool, e, &x, &side) == QDOT_OK
               ? x
               : 0;
}

static qdot_expr
value_at_start(qdot_expr e, void *user)
{
    return value_on_constraints(user, e);
}

static qdot_status
try_minimal_coordinates(race *r)
{
    const qdot_minimal_start start = {size_at_start, value_at_start, r};
    qdot_minimal m;
    qdot_status status;

    if (qdot_scene_acting_event(r->scene))
        return set_reason(&r->race->lane[MINIMAL],
                          "events are met in the coordinates as given only");
    status = qdot_minimal_make(r->scene, &start, &m);
    if (is_failure_of_formulation(status))
        return set_reason(&r->race->lane[MINIMAL], qdot_last_error()->message);
    QDOT_TRY(status);
    if (!m.scene)
        status = set_reason(&r->race->lane[MINIMAL], m.reason);
    else if (m.scene->coordinates.n == 0)
        status = set_reason(&r->race->lane[MINIMAL],
                            "the constraints leave no freedom");
    else
        status = run_in_minimal_coordinates(r, &m);
    qdot_minimal_clear(&m);
    return status;
}

/* --- running all formulations ------------------------------------------------------- */

static qdot_status
run_reference(race *r)
{
    qdot_run_request request = *r->request;
    const qdot_run_report *report;

    request.tol = reference_tol;
    request.treatment = QDOT_RUN_PROJECT;
    QDOT_TRY(qdot_run_new(r->scene, &request, &r->reference));
    report = qdot_run_get_report(r->reference);
    if (report->status == QDOT_RUN_STOPPED) {
        (void)qdot_fail(QDOT_EINVAL, "the run ends early: %s", report->reason);
        return qdot_hint("a race goes to the end: remove what stops it");
    }
    if (report->status != QDOT_RUN_DONE)
        return qdot_fail(QDOT_EFAILED, "the reference of the race failed: %s",
                         report->reason ? report->reason : "no reason is known");
    r->race->reference_tol = reference_tol;
    r->race->reference_error = report->error;
    memcpy(r->end, report->q, r->n * sizeof *r->end);
    memcpy(r->end + r->n, report->v, r->n * sizeof *r->end);
    if (!report->notice)
        return QDOT_OK;
    r->race->notice = qdot_strdup(report->notice);
    return r->race->notice ? QDOT_OK : QDOT_ENOMEM;
}

static qdot_status
run_all_formulations(race *r)
{
    qdot_expr *state = qdot_calloc(2 * r->n + 1, sizeof *state);
    qdot_run_request request = *r->request;
    qdot_status status = state ? run_reference(r) : QDOT_ENOMEM;
    int lanes = r->scene->constraints.n > 0 ? MINIMAL : 1;

    for (size_t i = 0; i < r->n && status == QDOT_OK; i++) {
        state[i] = r->scene->coordinates.at[i];
        state[r->n + i] = qdot_symbol_jet(r->scene->pool, state[i], 1);
        status = qdot_pool_check(r->scene->pool);
    }
    for (int k = 0; k < lanes && status == QDOT_OK; k++) {
        request.treatment = (qdot_run_treatment)k;
        status = run_at_all_tolerances(r, k, r->scene, request, state);
    }
    if (status == QDOT_OK && lanes > 1)
        status = try_minimal_coordinates(r);
    qdot_free(state);
    return status;
}

qdot_status
qdot_race_hold(qdot_scene *scene, const qdot_run_request *request, qdot_race *result)
{
    race r = {.scene = scene,
              .request = request,
              .n = scene->coordinates.n,
              .race = result};
    qdot_status status;

    *result = (qdot_race){.coordinates = r.n};
    r.end = qdot_calloc(4 * r.n + 1, sizeof *r.end);
    r.values = r.end ? r.end + 2 * r.n : NULL;
    status = r.end ? run_all_formulations(&r) : QDOT_ENOMEM;
    qdot_run_free(r.reference);
    qdot_free(r.end);
    result->interrupted = status == QDOT_EINTR && result->lane[0].entry[0].method != NULL;
    if (result->interrupted)
        return QDOT_OK;
    if (status != QDOT_OK)
        qdot_race_clear(result);
    return status;
}
