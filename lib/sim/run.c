/* run.c -- from a request to a run with its report. */
#include "sim/run.h"

#include <math.h>
#include <string.h>
#include <time.h>

#include "ode/companion.h"
#include "sim/bonds.h"
#include "sim/digits.h"
#include "sim/domain.h"
#include "sim/integrated.h"
#include "sim/precise.h"
#include "sim/start.h"
#include "tape/constant.h"
#include "tape/shake.h"

/* The spacing of doubles is 2.2e-16 of their size: no step can be held to less. */
static const double least_tol = 2.3e-16;

static double
process_clock(void)
{
    struct timespec now;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void
qdot_run_free(qdot_run *run)
{
    if (!run)
        return;
    qdot_trajectory_clear(&run->tr);
    qdot_trajectory_clear(&run->companion);
    qdot_drifts_clear(&run->drifts);
    qdot_bind_free(run->bind);
    qdot_bind_free(run->shaken);
    qdot_bind_free(run->twin);
    qdot_precise_pair_free(run->precise);
    qdot_free(run->exact);
    qdot_plan_free(run->plan);
    qdot_free(run->start);
    qdot_free(run->start_low);
    qdot_free(run->reason);
    qdot_text_clear(&run->notice);
    qdot_bonds_clear(&run->bonds);
    qdot_free(run);
}

const qdot_run_report *
qdot_run_get_report(const qdot_run *run)
{
    return &run->report;
}

const double *
qdot_run_times(const qdot_run *run, size_t *n)
{
    *n = run->tr.count;
    return run->tr.t;
}

static qdot_status
check_tolerance(double tol)
{
    if (!(tol > 0))
        return qdot_fail(QDOT_EINVAL, "the tolerance must be positive");
    if (tol < least_tol) {
        qdot_fail(QDOT_EINVAL, "the tolerance %.3g is below what a double can hold", tol);
        return qdot_hint("tol 1e-15");
    }
    if (tol > 1)
        return qdot_fail(QDOT_EINVAL, "the tolerance %.3g is too large: at most 1", tol);
    return QDOT_OK;
}

/* --- the start ---------------------------------------------------------------------- */

static qdot_status
constant(const qdot_run *run, qdot_expr e, double *value, int *side, double *low)
{
    e = qdot_plan_substitute(run->plan, e);
    QDOT_TRY(qdot_pool_check(run->plan->pool));
    return qdot_constant_split(run->plan->pool, e, value, side, low);
}

static qdot_status
read_start(qdot_run *run, const qdot_run_request *request)
{
    size_t n = run->plan->n;
    double low;
    int side;

    run->start_low = qdot_calloc(2 * n, sizeof *run->start_low);
    run->start = qdot_calloc(2 * n, sizeof *run->start);
    if (!run->start || !run->start_low)
        return QDOT_ENOMEM;
    QDOT_TRY(constant(run, request->t0, &run->t0, &run->t0_side, &low));
    QDOT_TRY(constant(run, request->t1, &run->t1, &run->t1_side, &run->t1_low));
    for (size_t i = 0; i < n; i++) {
        QDOT_TRY(constant(run, request->q0[i], &run->start[i], &side,
                          &run->start_low[i]));
        QDOT_TRY(constant(run, request->v0[i], &run->start[n + i], &side,
                          &run->start_low[n + i]));
    }
    return QDOT_OK;
}

static qdot_status
check_start(qdot_run *run, const qdot_domains *domains)
{
    const qdot_domain *d = qdot_domains_outside(domains, run->start);

    if (d) {
        const char *name = run->plan->names[d->coordinate];

        qdot_fail(QDOT_EDOMAIN, "the start %s = %.15g is outside its domain %.200s", name,
                  run->start[d->coordinate], d->text);
        return qdot_hint("start %s = ...", name);
    }
    return qdot_bind_check(run->bind, run->t0, run->start, run->start_low);
}

static qdot_status
check_springs(const qdot_run *run, const qdot_scene *scene)
{
    for (size_t i = 0; i < scene->springs.n; i++) {
        const qdot_link *spring = &scene->springs.at[i];
        qdot_expr rest = qdot_plan_substitute(run->plan, spring->rest);

        QDOT_TRY(qdot_pool_check(run->plan->pool));
        if ((qdot_expr_node(run->plan->pool, rest)->sign & QDOT_NEG) == QDOT_NEG)
            return qdot_fail(QDOT_EINVAL, "the rest length of %s%.100s is negative",
                             spring->name ? "spring " : "a spring",
                             spring->name ? spring->name : "");
    }
    return QDOT_OK;
}

/* The constraints that the run found redundant, by name. */
static qdot_status
name_redundant(qdot_run *run, qdot_scene *scene, const qdot_run_request *request)
{
    if (run->report.independent >= run->report.m)
        return QDOT_OK;
    QDOT_TRY(qdot_start_redundant(scene, run->plan, request, run->start, &run->notice));
    if (run->notice.n > 0)
        run->report.notice = qdot_text_str(&run->notice);
    return QDOT_OK;
}

/* Onto the constraints. */
static qdot_status
settle_start(qdot_run *run, qdot_scene *scene, const qdot_run_request *request,
             const qdot_domains *domains)
{
    if (scene->constraints.n == 0)
        return QDOT_OK;
    QDOT_TRY(qdot_start_settle(scene, run->plan, request, domains, run->start,
                               run->start_low, &run->notice));
    if (run->notice.n > 0)
        run->report.notice = qdot_text_str(&run->notice);
    return QDOT_OK;
}

/* --- the run ------------------------------------------------------------------------ */

/* What ends a run without taking back what was integrated. */
static bool
is_kept(qdot_status status)
{
    return status == QDOT_OK || status == QDOT_EFAILED || status == QDOT_ELIMIT
           || status == QDOT_EDOMAIN || status == QDOT_ESINGULAR || status == QDOT_EINTR;
}

static qdot_status
say_why(qdot_run *run, const char *reason)
{
    run->report.status = QDOT_RUN_FAILED;
    run->reason = qdot_strdup(reason);
    run->report.reason = run->reason;
    return run->reason ? QDOT_OK : QDOT_ENOMEM;
}

static qdot_status
left_domain(qdot_run *run, const qdot_domains *domains)
{
    qdot_ode_system system = qdot_bind_system(run->bind);
    char reason[400];

    QDOT_TRY(qdot_domains_locate(domains, &system, &run->tr));
    snprintf(reason, sizeof reason, "%.100s left its domain %.200s at t = %.15g",
             run->plan->names[domains->left->coordinate], domains->left->text,
             run->tr.result.t);
    return say_why(run, reason);
}

/* Integrate; QDOT_OK whenever there is a run to keep, *interrupted by Ctrl-C. */
static qdot_status
integrate(qdot_run *run, qdot_domains *domains, double tol, bool *interrupted)
{
    qdot_ode_system system = qdot_bind_system(run->bind);
    qdot_ode_options options = {
        .tol = tol, .carry = run->start_low, .t1_low = run->t1_low};
    qdot_status status;

    if (domains->n > 0) {
        options.accepted = qdot_domains_watch;
        options.user = domains;
    }
    status = qdot_trajectory_run(&run->tr, &system, run->plan->method, &options, run->t0,
                                 run->t1, run->start);
    *interrupted = status == QDOT_EINTR;
    if (!is_kept(status))
        return status;
    if (status != QDOT_OK)
        return say_why(run, run->tr.result.reason);
    if (domains->left)
        return left_domain(run, domains);
    return QDOT_OK;
}

/* --- the report --------------------------------------------------------------------- */

static const double *
last_state(const qdot_run *run)
{
    return run->tr.y + (run->tr.count - 1) * run->tr.n;
}

static void
fill_report(qdot_run *run, double tol)
{
    qdot_run_report *r = &run->report;
    const qdot_ode_stats *stats = &run->tr.result.stats;
    const qdot_plan *p = run->plan;

    r->method = p->method->name;
    r->tol = tol;
    r->t0 = run->t0;
    r->t1 = run->tr.t[run->tr.count - 1];
    r->steps = stats->steps;
    r->rejected = stats->rejected;
    r->evals = stats->evaluations;
    r->jacobians = stats->jacobians;
    r->factorizations = stats->factorisations + qdot_bind_factored(run->bind);
    r->cpu = stats->cpu;
    r->n = p->n;
    r->coordinates = p->inputs;
    r->q = last_state(run);
    r->v = r->q + p->n;
    r->operations = qdot_tape_operations(p->tape);
    r->energy_drift = run->drifts.energy ? run->drifts.at[0].drift : NAN;
    r->n_drifts = run->drifts.n;
    r->drifts = run->drifts.at;
    r->projections = stats->projections;
    qdot_bonds_report(&run->bonds, p, r);
}

/* The states of the run at the times that the companion wants them. */
static qdot_status
show_states(qdot_run *run, qdot_companion *companion)
{
    qdot_ode_system system = qdot_bind_system(run->bind);
    qdot_trajectory_cursor *cursor;
    size_t count;
    const double *times = qdot_companion_times(companion, &count);
    double *y;
    qdot_status status;

    if (count == 0)
        return QDOT_OK;
    QDOT_TRY(qdot_trajectory_open(&run->tr, &system, &cursor));
    y = qdot_malloc(system.n * sizeof *y);
    status = y ? QDOT_OK : QDOT_ENOMEM;
    for (size_t k = 0; k < count && status == QDOT_OK; k++) {
        status = qdot_trajectory_read(cursor, times[k], y);
        if (status == QDOT_OK)
            qdot_companion_show(companion, k, y);
    }
    qdot_free(y);
    qdot_trajectory_close(cursor);
    /* without them the error is that of the end alone */
    return status == QDOT_ENOMEM || status == QDOT_EINTR ? status : QDOT_OK;
}

static qdot_status
start_companion(qdot_run *run, double tol, qdot_companion **companion)
{
    qdot_ode_system system, twin;
    qdot_companion_request request = {.system = &system,
                                      .method = run->plan->method,
                                      .tol = tol,
                                      .t0 = qdot_shake_double(run->t0, run->t0_side),
                                      .t1 = run->t1,
                                      .t1_low = run->t1_low,
                                      .y0 = run->start,
                                      .carry = run->start_low,
                                      .threaded = true};

    QDOT_TRY(qdot_bind_new(run->plan, true, &run->shaken));
    system = qdot_bind_system(run->shaken);
    if (!system.series)
        request.t1 = qdot_shake_double(run->t1, run->t1_side);
    if (tol <= QDOT_COMPANION_TWIN_TOL) {
        QDOT_TRY(qdot_bind_new(run->plan, false, &run->twin));
        twin = qdot_bind_system(run->twin);
        request.twin = &twin;
    }
    return qdot_companion_start(&request, companion);
}

/* The run, its companion beside it, and what should have been kept. */
static qdot_status
carry_out(qdot_run *run, qdot_scene *scene, qdot_domains *domains, double tol,
          bool *interrupted)
{
    qdot_companion_estimate estimate = {.error = 0};
    qdot_companion *companion = NULL;
    qdot_status status = QDOT_OK;

    *interrupted = false;
    if (run->t0 != run->t1) {
        /* Where the shaken constants have no inverse the error stays unknown. */
        estimate.error = NAN;
        status = start_companion(run, tol, &companion);
        if (status == QDOT_ESINGULAR || status == QDOT_EDOMAIN)
            status = QDOT_OK;
    }
    if (status == QDOT_OK)
        status = integrate(run, domains, tol, interrupted);
    if (status == QDOT_OK && !*interrupted)
        status = qdot_drifts_measure(scene, run->plan, &run->tr, &run->drifts);
    if (status == QDOT_OK && !*interrupted)
        status = qdot_bonds_measure(run->bind, &run->tr, &run->bonds);
    if (status == QDOT_EINTR) {
        *interrupted = true;
        status = QDOT_OK;
    }
    if (companion && status == QDOT_OK && !*interrupted
        && run->tr.result.outcome == QDOT_ODE_DONE)
        status = show_states(run, companion);
    if (companion) {
        bool there = run->tr.count > 0;
        qdot_error failure = *qdot_last_error();

        double *difference = qdot_calloc(2 * run->plan->n, sizeof *difference);

        qdot_companion_finish(companion, there ? run->tr.result.t : run->t1,
                              there ? last_state(run) : run->start, difference,
                              &estimate);
        if (!difference)
            status = QDOT_ENOMEM;
        else if (status == QDOT_OK && !*interrupted)
            status = qdot_bonds_errors(run->bind, &run->tr, difference, &run->bonds);
        qdot_free(difference);
        if (status != QDOT_OK || *interrupted)
            qdot_fail_again(&failure);
    }
    run->report.error = estimate.error;
    return status;
}

qdot_status
qdot_run_new(qdot_scene *scene, const qdot_run_request *asked, qdot_run **out)
{
    const qdot_run_request precise = qdot_precise_request(asked);
    const qdot_run_request *request = asked->digits ? &precise : asked;
    double clock = process_clock();
    qdot_domains domains = {0};
    bool interrupted = false;
    qdot_run *run;
    qdot_status status;

    *out = NULL;
    QDOT_TRY(asked->digits ? qdot_precise_check(scene, asked) : check_tolerance(asked->tol));
    run = qdot_calloc(1, sizeof *run);
    if (!run)
        return QDOT_ENOMEM;
    status = qdot_plan_new(scene, request, &run->plan);
    if (status == QDOT_OK)
        status = read_start(run, request);
    if (status == QDOT_OK)
        status = qdot_domains_find(run->plan, &domains);
    if (status == QDOT_OK)
        status = check_springs(run, scene);
    if (status == QDOT_OK)
        status = settle_start(run, scene, request, &domains);
    if (status == QDOT_OK)
        status = qdot_bind_new(run->plan, false, &run->bind);
    if (status == QDOT_OK)
        status = check_start(run, &domains);
    if (status == QDOT_OK)
        status = request->digits
                     ? qdot_digits_carry_out(run, scene, request, &domains, &interrupted)
                     : carry_out(run, scene, &domains, request->tol, &interrupted);
    qdot_domains_clear(&domains);
    if (status != QDOT_OK) {
        qdot_run_free(run);
        return status;
    }
    fill_report(run, request->tol);
    status = name_redundant(run, scene, request);
    if (status != QDOT_OK) {
        qdot_run_free(run);
        return status;
    }
    if (request->digits)
        qdot_digits_fill_report(run);
    run->report.cpu_total = process_clock() - clock;
    *out = run;
    return interrupted ? QDOT_EINTR : QDOT_OK;
}
