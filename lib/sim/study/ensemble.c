/* ensemble.c -- a scene lowered with some parameters left open; members and companions. */
#include "sim/study/ensemble.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include "base/memory.h"
#include "ode/companion.h"
#include "sim/form/ensemble-series.h"
#include "sim/model/constrained.h"
#include "sim/model/parameter-states.h"
#include "sim/plan/plan.h"
#include "sim/study/ensemble-momenta.h"
#include "tape/constant.h"
#include "tape/shake.h"

struct qdot_ensemble {
    qdot_plan *plan;                /* parameters that vary are further coordinates of it */
    qdot_ensemble_momenta *momenta; /* of a plan that is reduced */
    size_t n, varied;               /* a state is q [n], q' [n], parameters [varied] */
    char **reasons;                 /* [n_reasons] why a start cannot be one; NULL: it can */
    size_t n_reasons;
    qdot_ensemble_series *members,
        *companions; /* companions: made when first asked for */
    double t0, t1, t1_low, tol;
    int t1_side;
    int order;
};

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
    qdot_ensemble_series_free(e->members);
    qdot_ensemble_series_free(e->companions);
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
    return qdot_ensemble_series_new(equations(e), false, e->tol, &e->order, &e->members);
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
    status = make(e, scene, request, varied);
    if (status != QDOT_OK) {
        qdot_ensemble_free(e);
        return status;
    }
    *ensemble = e;
    return QDOT_OK;
}

/* --- runs --------------------------------------------------------------------------- */

/* One pass over all members, the runs themselves or their companions. */
typedef struct {
    qdot_ensemble_series *series; /* borrowed */
    bool is_companion;
    qdot_batch_run run;
    double *memory;
    double *t1;       /* [members] as run.t1 */
    double *momenta;  /* [n_kept] */
    double *replaced; /* [members x n_kept] velocities that momenta stand in place of */
    qdot_status status;
    qdot_error error; /* of a pass on another thread */
} pass;

static void
pass_clear(pass *p)
{
    qdot_free(p->memory);
    qdot_free(p->run.results);
}

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

/* x [n], or their neighbours where they are to be moved; the first is number `at` of its kind. */
static void
put(size_t n, const double *x, size_t at, bool moved, double *to)
{
    for (size_t i = 0; i < n; i++)
        to[i] = moved ? qdot_companion_moved(x[at + i], 1, at + i, 0, 1) : x[at + i];
}

/* From {.run.order, .run.tol}. */
static qdot_status
pass_init(pass *p, const qdot_ensemble *e, size_t members, double t1, const double *y,
          const double *parameters)
{
    const size_t n = 2 * e->n, kept = n_kept(e);
    const bool moved = p->is_companion;
    double *t0, *t1s;

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
        put(n, y, m * n, moved, to);
        put(e->varied, parameters, m * e->varied, moved, to + n);
    }
    p->run.members = members;
    p->run.t0 = t0;
    p->run.t1 = t1s;
    return QDOT_OK;
}

static void *
pass_run(void *user)
{
    pass *p = user;
    qdot_ode_batch system = qdot_ensemble_series_system(p->series);

    p->status = qdot_ode_batch_run(&system, &p->run);
    if (p->status != QDOT_OK)
        p->error = *qdot_last_error();
    return NULL;
}

static qdot_status
make_companions(qdot_ensemble *e, int order)
{
    if (e->companions)
        return QDOT_OK;
    return qdot_ensemble_series_new(equations(e), true, e->tol, &order, &e->companions);
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
        const qdot_status status = start(e, p->is_companion, whole, p->run.y + m * width(e));

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
start_both(qdot_ensemble *e, pass *runs, pass *companions)
{
    double *whole;
    qdot_status status;

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
    status = start_all(e, runs, e->reasons, whole);
    if (status == QDOT_OK && companions)
        status = start_all(e, companions, NULL, whole);
    qdot_free(whole);
    return status;
}

/* --- both --------------------------------------------------------------------------- */

static qdot_status
run_both(qdot_ensemble *e, pass *runs, pass *companions)
{
    pthread_t thread;
    bool threaded = pthread_create(&thread, NULL, pass_run, companions) == 0;

    pass_run(runs);
    if (threaded)
        pthread_join(thread, NULL);
    else if (runs->status == QDOT_OK)
        pass_run(companions);
    (void)e;
    if (runs->status == QDOT_OK && companions->status != QDOT_OK)
        return qdot_fail(companions->status, "%s", companions->error.message);
    return runs->status;
}

/* Whether a companion has gone as far as its run. */
static bool
arrived(const qdot_ensemble *e, const pass *companions, size_t m)
{
    return companions->run.results[m].outcome == QDOT_BATCH_DONE &&
           (companions->t1[m] != e->t0 || e->t1 == e->t0);
}

static void
report(const qdot_ensemble *e, const pass *runs, const pass *companions, double *y,
       qdot_ensemble_result *results)
{
    static const char *const reasons[] = {
        [QDOT_BATCH_DONE] = NULL,
        [QDOT_BATCH_UNDEFINED] = "an acceleration is undefined at the start",
        [QDOT_BATCH_STUCK] = "no step is small enough: a singularity",
        [QDOT_BATCH_LIMIT] = "too many steps",
    };
    static const char *const constrained =
        "no step is small enough: the constraints cannot be held, are not independent or no mass "
        "moves along them there, or it is a singularity";
    size_t n = 2 * e->n;

    for (size_t m = 0; m < runs->run.members; m++) {
        const qdot_batch_result *r = runs->run.results + m;
        const double *mine = runs->run.y + m * width(e);
        const char *why = e->reasons[m] ? e->reasons[m] : reasons[r->outcome];
        bool known = companions && !why && arrived(e, companions, m);
        double error = known ? 0x1p-53 : NAN;

        if (r->outcome == QDOT_BATCH_STUCK && e->plan->constraints)
            why = constrained;
        for (size_t i = 0; i < n && known; i++)
            error = fmax(error, qdot_companion_bound(
                                    fabs(mine[i] - companions->run.y[m * width(e) + i]), 0) /
                                    fmax(1, fabs(mine[i])));
        if (!e->reasons[m])
            memcpy(y + m * n, mine, n * sizeof *y);
        results[m] = (qdot_ensemble_result){
            .status = why ? QDOT_RUN_FAILED : QDOT_RUN_DONE,
            .reason = why,
            .t = r->t,
            .steps = r->steps,
            .rejected = r->rejected,
            .error = error};
    }
}

qdot_status
qdot_ensemble_run(qdot_ensemble *e, size_t members, double *y, const double *parameters,
                  bool errors, qdot_ensemble_result *results)
{
    const qdot_ode_method *taylor = qdot_ode_method_find("taylor");
    int more = e->order + QDOT_COMPANION_ORDERS;
    pass runs = {.series = e->members, .run = {.order = e->order, .tol = e->tol}};
    pass companions = {
        .is_companion = true,
        .run = {.order = more,
                .tol = fmax(taylor->companion_ratio * e->tol, taylor->companion_tol)}};
    qdot_status status = pass_init(&runs, e, members, e->t1, y, parameters);

    runs.run.t1_low = e->t1_low;
    if (status == QDOT_OK && errors)
        status = make_companions(e, more);
    if (status == QDOT_OK && errors)
        status = pass_init(&companions, e, members, qdot_shake_double(e->t1, e->t1_side), y,
                           parameters);
    if (status == QDOT_OK && errors) {
        companions.series = e->companions;
        enter(e, &companions);
    }
    if (status == QDOT_OK)
        status = start_both(e, &runs, errors ? &companions : NULL);
    if (status == QDOT_OK)
        enter(e, &runs);
    if (status == QDOT_OK && errors) {
        status = run_both(e, &runs, &companions);
    } else if (status == QDOT_OK) {
        pass_run(&runs);
        status = runs.status;
    }
    if (status == QDOT_OK && errors)
        come_back(e, &companions);
    if (status == QDOT_OK) {
        come_back(e, &runs);
        report(e, &runs, errors ? &companions : NULL, y, results);
    }
    pass_clear(&runs);
    pass_clear(&companions);
    return status;
}
