/* ensemble.c -- a scene lowered with some parameters left open; members and companions. */
#include "sim/study/ensemble.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include "base/memory.h"
#include "expr/walk.h"
#include "ode/companion.h"
#include "sim/form/ensemble-series.h"
#include "sim/model/constrained.h"
#include "sim/model/parameter-states.h"
#include "sim/plan/plan.h"
#include "sim/study/ensemble-momenta.h"
#include "sim/study/ensemble-steps.h"
#include "tape/constant.h"
#include "tape/disc.h"
#include "tape/shake.h"

/* One pass over all members, the runs themselves or their companions. */
typedef struct {
    qdot_ensemble_series *series; /* of companions: made when first asked for */
    qdot_ensemble_steps *steps;   /* NULL: nobody looks */
    size_t number;                /* 0: the runs; 1, 2: their companions */
    qdot_batch_run run;
    double *memory;
    double *t1;       /* [members] as run.t1 */
    double *momenta;  /* [n_kept] */
    double *replaced; /* [members x n_kept] velocities that momenta stand in place of */
    qdot_status status;
    qdot_error error; /* of a pass on another thread */
} pass;

struct qdot_ensemble {
    qdot_plan *plan;                /* parameters that vary are further coordinates of it */
    qdot_ensemble_momenta *momenta; /* of a plan that is reduced */
    size_t n, varied;               /* a state is q [n], q' [n], parameters [varied] */
    char **reasons;                 /* [n_reasons] why a start cannot be one; NULL: it can */
    size_t n_reasons;
    size_t companions; /* 1 or 2 */
    pass passes[QDOT_ENSEMBLE_PASSES];
    const qdot_ensemble_watching *watching; /* NULL: nobody looks */
    double *times; /* [n_times] at which states are kept */
    size_t n_times;
    uint64_t most_steps;
    double t0, t1, t1_low, tol;
    int t1_side;
    int order;
};

static void
pass_clear(pass *p)
{
    qdot_free(p->memory);
    qdot_free(p->run.results);
    p->memory = NULL;
    p->run = (qdot_batch_run){0};
}

static const qdot_plan *
equations(const qdot_ensemble *e)
{
    return e->plan->reduced ? e->plan->reduced : e->plan;
}

static void
forget_reasons(qdot_ensemble *e)
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
    forget_reasons(e);
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

/* --- the scene ---------------------------------------------------------------------- */

static qdot_status
check(const qdot_scene *scene, const qdot_run_request *request, size_t n_varied,
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
make_plan(qdot_ensemble *e, qdot_scene *scene, const qdot_run_request *request,
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
make(qdot_ensemble *e, qdot_scene *scene, const qdot_run_request *request,
     const qdot_expr *varied)
{
    qdot_pool *pool = scene->pool;
    double low;
    int side;

    QDOT_TRY(qdot_constant_split(pool, request->t0, &e->t0, &side, &low));
    QDOT_TRY(qdot_constant_split(pool, request->t1, &e->t1, &e->t1_side, &e->t1_low));
    QDOT_TRY(make_plan(e, scene, request, varied));
    if (e->plan->reduced)
        QDOT_TRY(qdot_ensemble_momenta_new(e->plan->reduced, &e->momenta));
    return qdot_ensemble_series_new(equations(e), false, e->tol, &e->order,
                                    &e->passes[0].series);
}

qdot_status
qdot_ensemble_new(qdot_scene *scene, const qdot_run_request *request, size_t n_varied,
                  const qdot_expr *varied, qdot_ensemble **ensemble)
{
    qdot_ensemble *e;
    qdot_status status;

    *ensemble = NULL;
    QDOT_TRY(check(scene, request, n_varied, varied));
    e = qdot_calloc(1, sizeof *e);
    if (!e)
        return QDOT_ENOMEM;
    e->n = scene->coordinates.n;
    e->varied = n_varied;
    e->tol = request->tol;
    e->companions = QDOT_ENSEMBLE_PASSES - 1;
    status = make(e, scene, request, varied);
    if (status != QDOT_OK) {
        qdot_ensemble_free(e);
        return status;
    }
    *ensemble = e;
    return QDOT_OK;
}

/* --- runs --------------------------------------------------------------------------- */

static size_t
width(const qdot_ensemble *e)
{
    return 2 * e->n + e->varied;
}

static size_t
n_kept(const qdot_ensemble *e)
{
    return equations(e)->n_kept;
}

/* x [n], or as companion 1 or 2 begins beside them. */
static void
put(size_t n, const double *x, size_t companion, double *to)
{
    for (size_t i = 0; i < n; i++)
        to[i] = companion ? qdot_companion_moved(x[i], 1, i, companion - 1,
                                                 companion == 1 ? 1 : QDOT_COMPANION_FAR)
                          : x[i];
}

/* From {.run.order, .run.tol}. */
static qdot_status
pass_init(pass *p, const qdot_ensemble *e, size_t members, const double *y,
          const double *parameters)
{
    const size_t n = 2 * e->n, kept = n_kept(e);
    const double t1 = p->number == 1 ? qdot_shake_double(e->t1, e->t1_side) : e->t1;
    double *t0, *t1s;

    p->run.t1_low = p->number == 1 ? 0 : e->t1_low;
    p->run.most_steps = e->most_steps;
    p->memory = qdot_calloc(members * (2 + width(e)) + (members + 1) * kept + 1,
                            sizeof *p->memory);
    p->run.results = qdot_calloc(members + 1, sizeof *p->run.results);
    if (!p->memory || !p->run.results)
        return QDOT_ENOMEM;
    t0 = p->memory;
    t1s = p->t1 = t0 + members;
    p->run.y = t1s + members;
    p->momenta = p->run.y + members * width(e);
    p->replaced = p->momenta + kept;
    for (size_t m = 0; m < members; m++) {
        double *to = p->run.y + m * width(e);

        t0[m] = e->t0;
        t1s[m] = t1;
        put(n, y + m * n, p->number, to);
        if (e->varied > 0)
            put(e->varied, parameters + m * e->varied, p->number, to + n);
    }
    p->run.members = members;
    p->run.t0 = t0;
    p->run.t1 = t1s;
    return p->steps ? qdot_ensemble_steps_begin(p->steps, members) : QDOT_OK;
}

static void *
pass_run(void *user)
{
    pass *p = user;
    qdot_ode_batch system = qdot_ensemble_series_system(p->series);

    if (p->steps)
        qdot_ensemble_steps_look(p->steps, &system);
    p->status = qdot_ode_batch_run(&system, &p->run);
    if (p->status != QDOT_OK)
        p->error = *qdot_last_error();
    return NULL;
}

/* The order and the tolerance of a pass. */
static void
pass_options(const qdot_ensemble *e, pass *p)
{
    const qdot_ode_method *taylor = qdot_ode_method_find("taylor");

    pass_clear(p);
    p->run.order = e->order;
    p->run.tol = e->tol;
    if (p->number == 0)
        return;
    p->run.order += qdot_companion_orders(p->number - 1);
    p->run.tol = fmax(taylor->companion_ratio * e->tol, taylor->companion_tol);
}

/* The series of a companion, shaken or not. */
static qdot_status
make_series(const qdot_ensemble *e, pass *p)
{
    int order = p->run.order;

    return p->series ? QDOT_OK
                     : qdot_ensemble_series_new(equations(e), p->number == 1, e->tol, &order,
                                                &p->series);
}

/* Replace velocities that follow from kept momenta by these. A member whose momenta are undefined
 * does not run. */
static void
enter(const qdot_ensemble *e, pass *p)
{
    const size_t n = e->n, kept = n_kept(e);

    for (size_t m = 0; e->momenta && m < p->run.members; m++) {
        double *y = p->run.y + m * width(e);
        const bool finite = qdot_ensemble_momenta_enter(e->momenta, e->t0, y, p->momenta);

        if (!finite)
            p->t1[m] = e->t0;
        for (size_t c = 0; c < kept; c++) {
            double *v = y + n + equations(e)->kept[c];

            p->replaced[m * kept + c] = *v;
            if (finite)
                *v = p->momenta[c];
        }
    }
}

/* Replace the momenta by velocities again. */
static void
come_back(const qdot_ensemble *e, pass *p)
{
    const size_t n = e->n, kept = n_kept(e);

    for (size_t m = 0; e->momenta && m < p->run.members; m++) {
        qdot_batch_result *r = p->run.results + m;
        double *y = p->run.y + m * width(e);

        for (size_t c = 0; c < kept; c++) {
            double *v = y + n + equations(e)->kept[c];

            p->momenta[c] = *v;
            *v = p->replaced[m * kept + c];
        }
        if (r->steps > 0)
            qdot_ensemble_momenta_derive(e->momenta, r->t, p->momenta, y);
        else if (p->t1[m] == e->t0 && e->t1 != e->t0)
            r->outcome = QDOT_BATCH_UNDEFINED;
    }
}

/* --- constraints -------------------------------------------------------------------- */

/* Whether a member may start at y, which is brought to its constraints; as of a single run, whose
 * states are `whole` [2 (n + varied)]. */
static qdot_status
start(const qdot_ensemble *e, bool shaken, double *whole, double *y)
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

/* Members that cannot start do not run; `reasons` [members], NULL: not wanted. */
static qdot_status
start_all(const qdot_ensemble *e, pass *p, char **reasons, double *whole)
{
    for (size_t m = 0; m < p->run.members; m++) {
        const qdot_status status = start(e, p->number == 1, whole, p->run.y + m * width(e));

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

/* Of the runs, then of their companions, which are not looked at where there is no run. */
static qdot_status
start_passes(qdot_ensemble *e, size_t passes)
{
    pass *runs = e->passes;
    double *whole;
    qdot_status status = QDOT_OK;

    forget_reasons(e);
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
        status = start_all(e, e->passes + k, k == 0 ? e->reasons : NULL, whole);
    qdot_free(whole);
    return status;
}

/* --- all passes --------------------------------------------------------------------------- */

/* The first pass here; its companions beside it, or after it where somebody looks: beside no member
 * that was left. */
static qdot_status
run_passes(qdot_ensemble *e, size_t passes)
{
    pthread_t thread[QDOT_ENSEMBLE_PASSES];
    bool threaded[QDOT_ENSEMBLE_PASSES] = {false};

    for (size_t k = 1; k < passes && !e->watching; k++)
        threaded[k] = pthread_create(&thread[k], NULL, pass_run, e->passes + k) == 0;
    pass_run(e->passes);
    for (size_t m = 0; m < e->passes->run.members && e->watching; m++)
        for (size_t k = 1; k < passes && qdot_ensemble_left(e, m); k++)
            e->passes[k].t1[m] = e->t0;
    for (size_t k = 1; k < passes; k++)
        if (threaded[k])
            pthread_join(thread[k], NULL);
        else if (e->passes->status == QDOT_OK)
            pass_run(e->passes + k);
    for (size_t k = 0; k < passes; k++)
        if (e->passes[k].status != QDOT_OK)
            return qdot_fail(e->passes[k].status, "%s", e->passes[k].error.message);
    return QDOT_OK;
}

/* Whether a companion has gone as far as its run. */
static bool
arrived(const qdot_ensemble *e, const pass *companions, size_t m)
{
    return companions->run.results[m].outcome == QDOT_BATCH_DONE &&
           (companions->t1[m] != e->t0 || e->t1 == e->t0);
}

/* The error of a member's end, by both companions. */
static double
end_error(const qdot_ensemble *e, size_t m)
{
    const double *y[QDOT_ENSEMBLE_PASSES], share = qdot_ensemble_share(e, m);
    double error = 0x1p-53;

    for (size_t k = 0; k <= e->companions; k++) {
        if (k > 0 && !arrived(e, e->passes + k, m))
            return NAN;
        y[k] = e->passes[k].run.y + m * width(e);
    }
    for (size_t i = 0; i < 2 * e->n; i++) {
        const double theirs[] = {y[1][i], e->companions == 2 ? y[2][i] : 0};

        error = fmax(error, qdot_companion_bound_of(y[0][i], e->companions, theirs, share) /
                                fmax(1, fabs(y[0][i])));
    }
    return error;
}

static void
report(const qdot_ensemble *e, bool errors, double *y, qdot_ensemble_result *results)
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
    const pass *runs = e->passes;
    size_t n = 2 * e->n;

    for (size_t m = 0; m < runs->run.members; m++) {
        const qdot_batch_result *r = runs->run.results + m;
        const double *mine = runs->run.y + m * width(e);
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
            .error = errors && !why ? end_error(e, m) : NAN};
    }
}

/* What looks at the steps of a pass. */
static qdot_status
follow_pass(const qdot_ensemble *e, pass *p)
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
        pass *p = e->passes + k;

        p->number = k;
        pass_options(e, p);
        status = make_series(e, p);
        if (status == QDOT_OK && e->watching && !p->steps)
            status = follow_pass(e, p);
        if (status == QDOT_OK)
            status = pass_init(p, e, members, y, parameters);
    }
    if (status == QDOT_OK)
        status = start_passes(e, passes);
    for (size_t k = 0; k < passes && status == QDOT_OK; k++)
        enter(e, e->passes + k);
    if (status == QDOT_OK)
        status = run_passes(e, passes);
    for (size_t k = 0; k < passes && status == QDOT_OK; k++)
        come_back(e, e->passes + k);
    if (status == QDOT_OK)
        report(e, errors, y, results);
    return status;
}

/* --- what is seen on the way ---------------------------------------------------------- */

/* Whether an event reads what is no part of the state that is integrated. */
static bool
reads_kept(const qdot_ensemble *e, qdot_expr g)
{
    for (size_t c = 0; c < n_kept(e); c++)
        if (qdot_expr_contains(e->plan->pool, g, e->plan->inputs[e->plan->n + equations(e)->kept[c]]))
            return true;
    return false;
}

qdot_status
qdot_ensemble_follow(qdot_ensemble *e, const qdot_ensemble_watching *watching,
                     uint64_t most_steps)
{
    size_t places;
    const double *part = qdot_companion_places(&places);

    for (size_t i = 0; i < watching->n_events; i++)
        if (reads_kept(e, watching->events[i].function))
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: ensembles with an event that reads a "
                                             "velocity whose momentum is kept");
    if (n_kept(e) > 0 && e->plan->tape
        && qdot_disc_may_hide(e->plan->tape, QDOT_HIDES_EXPONENTIALS))
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: ensembles that keep momenta and look for "
                                         "forces which act for less than a step");
    e->watching = watching;
    e->most_steps = most_steps;
    e->n_times = (places + 1) / 2;
    e->times = qdot_calloc(e->n_times + 1, sizeof *e->times);
    if (!e->times)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < e->n_times; k++) /* half of them */
        e->times[k] = e->t0 + part[2 * k] * (e->t1 - e->t0);
    return QDOT_OK;
}

void
qdot_ensemble_companions(qdot_ensemble *e, size_t companions)
{
    e->companions = companions;
}

bool
qdot_ensemble_left(const qdot_ensemble *e, size_t m)
{
    const pass *p = e->passes;
    const qdot_batch_outcome outcome = p->run.results[m].outcome;

    return e->reasons[m] || qdot_ensemble_steps_doubtful(p->steps, m) ||
           (outcome != QDOT_BATCH_DONE && outcome != QDOT_BATCH_LEFT);
}

/* The batch's state y, with momenta where the way was not over, as q, parameters, q', 0. */
static void
write_whole(const qdot_ensemble *e, double t, double *y, bool raw, double *whole)
{
    const size_t n = e->n, kept = n_kept(e), bytes = sizeof *y;

    memcpy(whole, y, n * bytes);
    memcpy(whole + n, y + 2 * n, e->varied * bytes);
    memcpy(whole + n + e->varied, y + n, n * bytes);
    memset(whole + 2 * n + e->varied, 0, e->varied * bytes);
    if (!raw || kept == 0)
        return;
    for (size_t c = 0; c < kept; c++)
        e->passes[0].momenta[c] = y[n + equations(e)->kept[c]];
    qdot_ensemble_momenta_derive(e->momenta, t, e->passes[0].momenta, y);
    memcpy(whole + n + e->varied, y + n, n * bytes);
    for (size_t c = 0; c < kept; c++) /* as it was */
        y[n + equations(e)->kept[c]] = e->passes[0].momenta[c];
}

bool
qdot_ensemble_state(const qdot_ensemble *e, size_t k, size_t m, size_t place, double *whole)
{
    const pass *p = e->passes + k;

    if (place < e->n_times) {
        if (qdot_ensemble_steps_passed(p->steps, m) <= place)
            return false;
        write_whole(e, e->times[place], qdot_ensemble_steps_state(p->steps, m, place), true, whole);
        return true;
    }
    if (p->run.results[m].outcome != QDOT_BATCH_DONE || p->t1[m] == e->t0)
        return false;
    write_whole(e, e->t1, p->run.y + m * width(e), false, whole);
    return true;
}

double
qdot_ensemble_event_time(const qdot_ensemble *e, size_t k, size_t m, size_t event, size_t which)
{
    return qdot_ensemble_steps_event(e->passes[k].steps, m, event, which);
}

size_t
qdot_ensemble_event_count(const qdot_ensemble *e, size_t m, size_t event)
{
    return qdot_ensemble_steps_count(e->passes[0].steps, m, event);
}

size_t
qdot_ensemble_places(const qdot_ensemble *e)
{
    return e->n_times;
}

double
qdot_ensemble_time(const qdot_ensemble *e, size_t place)
{
    return place < e->n_times ? e->times[place] : e->t1;
}

const double *
qdot_ensemble_sizes(const qdot_ensemble *e, size_t m)
{
    return qdot_ensemble_steps_sizes(e->passes[0].steps, m);
}

const qdot_plan *
qdot_ensemble_plan(const qdot_ensemble *e)
{
    return e->plan;
}

bool
qdot_ensemble_reads(const qdot_ensemble *e, size_t k)
{
    const qdot_plan *p = e->plan;
    const qdot_expr of = p->inputs[e->n + k];
    bool reads = p->constraints || !p->M;

    for (size_t i = 0; i < p->n && !reads; i++) {
        reads = qdot_expr_contains(p->pool, p->f[i], of);
        for (size_t j = 0; j < p->n && !reads; j++)
            reads = qdot_expr_contains(p->pool, p->M[i * p->n + j], of);
    }
    return reads;
}

double
qdot_ensemble_share(const qdot_ensemble *e, size_t m)
{
    return fmin(1, sqrt((double)e->passes[0].run.results[m].steps) / QDOT_COMPANION_FAR);
}
