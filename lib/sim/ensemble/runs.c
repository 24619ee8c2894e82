/* runs.c -- compiles a scene with some parameters left open; runs the members and their companion runs. */
#include "expr/symbol.h"
#include "sim/ensemble/ensemble.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include "base/memory.h"
#include "base/process.h"
#include "expr/constant.h"
#include "ode/companion.h"
#include "sim/ensemble/parts.h"
#include "sim/model/constrained.h"
#include "sim/model/parameter-states.h"
#include "tape/shake.h"

static void
pass_clear(qdot_ensemble_pass *p)
{
    qdot_free(p->memory);
    qdot_free(p->run.results);
    p->memory = NULL;
    p->run = (qdot_batch_run){0};
}

static void
free_reasons(qdot_ensemble *e)
{
    for (size_t m = 0; m < e->n_reasons; m++)
        qdot_free(e->reasons[m]);
    qdot_free(e->reasons);
    e->reasons = NULL;
    e->n_reasons = 0;
}

void
qdot_ensemble_free(qdot_ensemble *e)
{
    if (!e)
        return;
    free_reasons(e);
    for (size_t k = 0; k < QDOT_ENSEMBLE_PASSES; k++) {
        pass_clear(e->passes + k);
        qdot_ensemble_series_free(e->passes[k].series);
        qdot_ensemble_steps_free(e->passes[k].steps);
    }
    qdot_free(e->times);
    qdot_ensemble_momenta_free(e->momenta);
    qdot_plan_free(e->plan);
    qdot_free(e);
}

/* --- making the ensemble ------------------------------------------------------------ */

static qdot_status
check_request(const qdot_scene *scene, const qdot_run_request *request, size_t n_varied,
              const qdot_expr *varied)
{
    const qdot_event *acting = qdot_scene_acting_event(scene);

    if (scene->coordinates.n == 0)
        return qdot_fail(QDOT_EINVAL, "the scene has no coordinates");
    if (scene->constraints.n > 0 && request->treatment != QDOT_RUN_PROJECT)
        return qdot_fail(QDOT_ENOTBUILT,
                         "not built yet: ensembles with constraints by another treatment than "
                         "projection");
    if (acting)
        return qdot_fail(QDOT_ENOTBUILT,
                         "not built yet: ensembles with the event %.100s, which %s",
                         acting->name, acting->stop ? "stops a run" : "changes it");
    if (request->method && strcmp(request->method, "auto") != 0 &&
        strcmp(request->method, "taylor") != 0)
        return qdot_fail(QDOT_EINVAL, "an ensemble runs by taylor, not by %.50s",
                         request->method);
    if (request->q0 || request->v0)
        return qdot_fail(QDOT_EINVAL, "the members of an ensemble bring their own starts");
    for (size_t i = 0; i < n_varied; i++) {
        for (size_t k = 0; k < i; k++)
            if (varied[k] == varied[i])
                return qdot_fail(QDOT_EINVAL, "%s is given twice",
                                 qdot_expr_symbol(scene->pool, varied[i])->name);
        for (size_t k = 0; k < request->n_values; k++)
            if (request->symbols[k] == varied[i])
                return qdot_fail(QDOT_EINVAL, "%s is given to all members and to each",
                                 qdot_expr_symbol(scene->pool, varied[i])->name);
    }
    return QDOT_OK;
}

static qdot_status
make_open_plan(qdot_ensemble *e, qdot_scene *scene, const qdot_run_request *request,
               const qdot_expr *varied)
{
    qdot_parameter_states states;
    qdot_status status = qdot_parameter_states_open(&states, scene, request, e->varied, varied);

    states.request.method = "taylor";
    states.request.lanes = true;
    if (status == QDOT_OK)
        status = qdot_plan_new(scene, &states.request, &e->plan);
    qdot_parameter_states_clear(&states);
    return status;
}

static qdot_status
make_ensemble(qdot_ensemble *e, qdot_scene *scene, const qdot_run_request *request,
              const qdot_expr *varied)
{
    qdot_pool *pool = scene->pool;
    double low;
    int side;

    QDOT_TRY(qdot_constant_split(pool, request->t0, &e->t0, &side, &low));
    QDOT_TRY(qdot_constant_split(pool, request->t1, &e->t1, &e->t1_side, &e->t1_low));
    QDOT_TRY(make_open_plan(e, scene, request, varied));
    if (e->plan->reduced)
        QDOT_TRY(qdot_ensemble_momenta_new(e->plan->reduced, &e->momenta));
    return qdot_ensemble_series_new(qdot_ensemble_equations(e), false, e->tol, &e->order,
                                    &e->passes[0].series);
}

qdot_status
qdot_ensemble_new(qdot_scene *scene, const qdot_run_request *request, size_t n_varied,
                  const qdot_expr *varied, qdot_ensemble **ensemble)
{
    qdot_ensemble *e;
    qdot_status status;

    *ensemble = NULL;
    QDOT_TRY(check_request(scene, request, n_varied, varied));
    e = qdot_calloc(1, sizeof *e);
    if (!e)
        return QDOT_ENOMEM;
    e->n = scene->coordinates.n;
    e->varied = n_varied;
    e->tol = request->tol;
    e->companions = QDOT_ENSEMBLE_PASSES - 1;
    status = make_ensemble(e, scene, request, varied);
    if (status != QDOT_OK) {
        qdot_ensemble_free(e);
        return status;
    }
    *ensemble = e;
    return QDOT_OK;
}

/* --- running one pass --------------------------------------------------------------- */

/* Write a state y [n] and parameters [varied] to `to`; for companion run 1 or 2 slightly shifted. */
static void
write_member(size_t n, const double *y, size_t varied, const double *parameters, size_t companion, double *to)
{
    if (companion)
        qdot_companion_beside(NULL, n, y, companion - 1, false, 0, to, NULL);
    else
        memcpy(to, y, n * sizeof *to);
    for (size_t i = 0; i < varied; i++)
        to[n + i] = companion ? qdot_companion_moved(parameters[i], 1, i, companion - 1)
                              : parameters[i];
}

/* Initialise a pass over all members; p starts as {.run.order, .run.tol}. */
static qdot_status
begin_pass(qdot_ensemble_pass *p, const qdot_ensemble *e, size_t members, const double *y,
           const double *parameters)
{
    const size_t n = 2 * e->n, kept = qdot_ensemble_kept(e);
    const double t1 = p->number == 1 ? qdot_shake_double(e->t1, e->t1_side) : e->t1;
    double *t0, *t1s;

    p->run.t1_low = p->number == 1 ? 0 : e->t1_low;
    p->run.most_steps = e->most_steps;
    p->memory = qdot_calloc(members * (2 + qdot_ensemble_width(e)) + (members + 1) * kept + 1,
                            sizeof *p->memory);
    p->run.results = qdot_calloc(members + 1, sizeof *p->run.results);
    if (!p->memory || !p->run.results)
        return QDOT_ENOMEM;
    t0 = p->memory;
    t1s = p->t1 = t0 + members;
    p->run.y = t1s + members;
    p->momenta = p->run.y + members * qdot_ensemble_width(e);
    p->replaced = p->momenta + kept;
    for (size_t m = 0; m < members; m++) {
        double *to = p->run.y + m * qdot_ensemble_width(e);

        t0[m] = e->t0;
        t1s[m] = t1;
        write_member(n, y + m * n, e->varied, e->varied > 0 ? parameters + m * e->varied : NULL, p->number, to);
    }
    p->run.members = members;
    p->run.t0 = t0;
    p->run.t1 = t1s;
    return p->steps ? qdot_ensemble_steps_begin(p->steps, members) : QDOT_OK;
}

static void
run_pass(qdot_ensemble_pass *p)
{
    qdot_ode_batch system = qdot_ensemble_series_system(p->series);

    if (p->steps)
        qdot_ensemble_steps_look(p->steps, &system);
    p->status = qdot_ode_batch_run(&system, &p->run);
    if (p->status != QDOT_OK)
        p->error = *qdot_last_error();
}

static void *
pass_thread(void *user)
{
    qdot_ensemble_pass *p = user;

    qdot_interrupt_own = p->interrupt;
    run_pass(p);
    return NULL;
}

/* Set the order of the Taylor series and the tolerance of a pass over all members. */
static void
set_pass_options(const qdot_ensemble *e, qdot_ensemble_pass *p)
{
    const qdot_ode_method *taylor = qdot_ode_method_find("taylor");

    pass_clear(p);
    p->run.order = e->order;
    p->run.tol = e->tol;
    if (p->number == 0)
        return;
    p->run.order += qdot_companion_orders(p->number - 1);
    p->run.tol = fmax(taylor->companion_ratio * e->tol, taylor->companion_tol);
    p->run.term_tol = qdot_companion_term_tol(e->tol, p->number - 1);
}

/* Make the Taylor series of a pass, unless made; the first companion run's has slightly perturbed constants. */
static qdot_status
make_pass_series(const qdot_ensemble *e, qdot_ensemble_pass *p)
{
    int order = p->run.order;

    return p->series ? QDOT_OK
                     : qdot_ensemble_series_new(qdot_ensemble_equations(e), p->number == 1, e->tol, &order,
                                                &p->series);
}

/* Replace velocities that follow from kept momenta by these. A member whose momenta are undefined
 * does not run. */
static void
replace_velocities_by_momenta(const qdot_ensemble *e, qdot_ensemble_pass *p)
{
    const size_t n = e->n, kept = qdot_ensemble_kept(e);

    for (size_t m = 0; e->momenta && m < p->run.members; m++) {
        double *y = p->run.y + m * qdot_ensemble_width(e);
        const bool finite = qdot_ensemble_momenta_enter(e->momenta, e->t0, y, p->momenta);

        if (!finite)
            p->t1[m] = e->t0;
        for (size_t c = 0; c < kept; c++) {
            double *v = y + n + qdot_ensemble_equations(e)->kept[c];

            p->replaced[m * kept + c] = *v;
            if (finite)
                *v = p->momenta[c];
        }
    }
}

/* Convert the conserved momenta in all end states of a pass back to velocities. */
static void
restore_velocities(const qdot_ensemble *e, qdot_ensemble_pass *p)
{
    const size_t n = e->n, kept = qdot_ensemble_kept(e);

    for (size_t m = 0; e->momenta && m < p->run.members; m++) {
        qdot_batch_result *r = p->run.results + m;
        double *y = p->run.y + m * qdot_ensemble_width(e);

        for (size_t c = 0; c < kept; c++) {
            double *v = y + n + qdot_ensemble_equations(e)->kept[c];

            p->momenta[c] = *v;
            *v = p->replaced[m * kept + c];
        }
        if (r->steps > 0)
            qdot_ensemble_momenta_derive(e->momenta, r->t, p->momenta, y);
        else if (p->t1[m] == e->t0 && e->t1 != e->t0)
            r->outcome = QDOT_BATCH_UNDEFINED;
    }
}

/* --- starts that satisfy the constraints -------------------------------------------- */

/* Whether a member may start at y, which is brought to its constraints; as of a single run, whose
 * states are `whole` [2 (n + varied)]. */
static qdot_status
project_start_state(const qdot_ensemble *e, bool shaken, double *whole, double *y)
{
    const size_t n = e->n, all = n + e->varied, bytes = sizeof *y;
    qdot_constrained *held;
    qdot_status status;

    QDOT_TRY(qdot_constrained_new(e->plan, shaken, &held));
    memcpy(whole, y, n * bytes);
    memcpy(whole + n, y + 2 * n, e->varied * bytes);
    memcpy(whole + all, y + n, n * bytes);
    status = qdot_constrained_start(held, e->t0, whole, NULL);
    memcpy(y, whole, n * bytes);
    memcpy(y + n, whole + all, n * bytes);
    if (status == QDOT_OK && qdot_constrained_rank(held) < e->plan->m)
        status = qdot_fail(QDOT_ENOTBUILT,
                           "not built yet: ensembles whose constraints are not independent: "
                           "%zu of %zu are",
                           qdot_constrained_rank(held), e->plan->m);
    qdot_constrained_free(held);
    return status;
}

/* Prepare the start of every member. Those that cannot start do not run, and `reasons` [members]
 * (may be NULL) says why. */
static qdot_status
project_start_states(const qdot_ensemble *e, qdot_ensemble_pass *p, char **reasons, double *whole)
{
    for (size_t m = 0; m < p->run.members; m++) {
        const qdot_status status = project_start_state(e, p->number == 1, whole, p->run.y + m * qdot_ensemble_width(e));

        if (qdot_grave(status) != QDOT_OK)
            return status;
        if (status == QDOT_OK)
            continue;
        p->t1[m] = e->t0;
        if (!reasons)
            continue;
        reasons[m] = qdot_strdup(qdot_last_error()->message);
        if (!reasons[m])
            return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

/* Prepare the starts of the runs, then those of the companion runs of members whose run could start. */
static qdot_status
start_passes(qdot_ensemble *e, size_t passes)
{
    qdot_ensemble_pass *runs = e->passes;
    double *whole;
    qdot_status status = QDOT_OK;

    free_reasons(e);
    e->reasons = qdot_calloc(runs->run.members + 1, sizeof *e->reasons);
    if (!e->reasons)
        return QDOT_ENOMEM;
    e->n_reasons = runs->run.members;
    if (!e->plan->constraints)
        return QDOT_OK;
    whole = qdot_calloc(2 * (e->n + e->varied), sizeof *whole);
    if (!whole)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < passes && status == QDOT_OK; k++)
        status = project_start_states(e, e->passes + k, k == 0 ? e->reasons : NULL, whole);
    qdot_free(whole);
    return status;
}

/* --- running all passes ------------------------------------------------------------------- */

/* The first pass here; its companions beside it, or after it where somebody looks: beside no member
 * that was left. */
static qdot_status
run_passes_in_threads(qdot_ensemble *e, size_t passes)
{
    pthread_t thread[QDOT_ENSEMBLE_PASSES] = {0};
    bool threaded[QDOT_ENSEMBLE_PASSES] = {false};

    for (size_t k = 1; k < passes; k++)
        e->passes[k].interrupt = qdot_interrupt_own;
    for (size_t k = 1; k < passes && !e->watching; k++)
        threaded[k] = QDOT_MAY_THREAD && pthread_create(&thread[k], NULL, pass_thread, e->passes + k) == 0;
    run_pass(e->passes);
    for (size_t m = 0; m < e->passes->run.members && e->watching; m++)
        for (size_t k = 1; k < passes && qdot_ensemble_left(e, m); k++)
            e->passes[k].t1[m] = e->t0;
    for (size_t k = 1; k < passes; k++)
        if (threaded[k])
            pthread_join(thread[k], NULL);
        else if (e->passes->status == QDOT_OK)
            run_pass(e->passes + k);
    for (size_t k = 0; k < passes; k++)
        if (e->passes[k].status != QDOT_OK)
            return qdot_fail(e->passes[k].status, "%s", e->passes[k].error.message);
    return QDOT_OK;
}

/* Whether the companion run of member m has reached the end time of the member's run. */
static bool
has_reached_end(const qdot_ensemble *e, const qdot_ensemble_pass *companions, size_t m)
{
    return companions->run.results[m].outcome == QDOT_BATCH_DONE &&
           (companions->t1[m] != e->t0 || e->t1 == e->t0);
}

/* Estimate the error of member m's end state from its companion runs. */
static double
estimate_end_error(const qdot_ensemble *e, size_t m)
{
    const double *y[QDOT_ENSEMBLE_PASSES];
    double error = 0x1p-53;

    for (size_t k = 0; k <= e->companions; k++) {
        if (k > 0 && !has_reached_end(e, e->passes + k, m))
            return NAN;
        y[k] = e->passes[k].run.y + m * qdot_ensemble_width(e);
    }
    for (size_t i = 0; i < 2 * e->n; i++) {
        const double theirs[] = {y[1][i], e->companions == 2 ? y[2][i] : 0};

        error = fmax(error, qdot_ensemble_error_of(y[0][i], e->companions, theirs) /
                                fmax(1, fabs(y[0][i])));
    }
    return error;
}

static void
fill_results(const qdot_ensemble *e, bool errors, double *y, qdot_ensemble_result *results)
{
    static const char *const reasons[] = {
        [QDOT_BATCH_DONE] = NULL,
        [QDOT_BATCH_UNDEFINED] = "an acceleration is undefined at the start",
        [QDOT_BATCH_STUCK] = "no step is small enough: a singularity",
        [QDOT_BATCH_LIMIT] = "too many steps",
        [QDOT_BATCH_LEFT] = NULL,
    };
    static const char *const constrained =
        "no step is small enough: the constraints cannot be held, are not independent or no mass "
        "moves along them there, or it is a singularity";
    const qdot_ensemble_pass *runs = e->passes;
    size_t n = 2 * e->n;

    for (size_t m = 0; m < runs->run.members; m++) {
        const qdot_batch_result *r = runs->run.results + m;
        const double *mine = runs->run.y + m * qdot_ensemble_width(e);
        const char *why = e->reasons[m] ? e->reasons[m] : reasons[r->outcome];

        if (r->outcome == QDOT_BATCH_STUCK && e->plan->constraints)
            why = constrained;
        if (!e->reasons[m])
            memcpy(y + m * n, mine, n * sizeof *y);
        results[m] = (qdot_ensemble_result){
            .status = why ? QDOT_RUN_FAILED : QDOT_RUN_DONE,
            .reason = why,
            .t = r->t,
            .steps = r->steps,
            .rejected = r->rejected,
            .error = errors && !why ? estimate_end_error(e, m) : NAN};
    }
}

/* Begin to inspect the steps of a pass: for events, states at given times, and doubts (sim/ensemble/doubts.h). */
static qdot_status
begin_inspection(const qdot_ensemble *e, qdot_ensemble_pass *p)
{
    const qdot_ensemble_steps_of of = {.plan = e->plan,
                                       .watching = e->watching,
                                       .n_times = e->n_times,
                                       .times = e->times,
                                       .tol = e->tol,
                                       .shaken = p->number == 1,
                                       .moved = p->number > 0,
                                       .backward = e->t1 < e->t0};

    return qdot_ensemble_steps_new(&of, &p->steps);
}

qdot_status
qdot_ensemble_run(qdot_ensemble *e, size_t members, double *y, const double *parameters,
                  bool errors, qdot_ensemble_result *results)
{
    const size_t passes = errors ? 1 + e->companions : 1;
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < passes && status == QDOT_OK; k++) {
        qdot_ensemble_pass *p = e->passes + k;

        p->number = k;
        set_pass_options(e, p);
        status = make_pass_series(e, p);
        if (status == QDOT_OK && e->watching && !p->steps)
            status = begin_inspection(e, p);
        if (status == QDOT_OK)
            status = begin_pass(p, e, members, y, parameters);
    }
    if (status == QDOT_OK)
        status = start_passes(e, passes);
    for (size_t k = 0; k < passes && status == QDOT_OK; k++)
        replace_velocities_by_momenta(e, e->passes + k);
    if (status == QDOT_OK)
        status = run_passes_in_threads(e, passes);
    for (size_t k = 0; k < passes && status == QDOT_OK; k++)
        restore_velocities(e, e->passes + k);
    if (status == QDOT_OK)
        fill_results(e, errors, y, results);
    return status;
}
