/* digits.c -- presents a run in MPFR with its companion run as a qdot_run: report, end state, events. */
#include "sim/digits/digits.h"

#include <math.h>
#include <stdio.h>

#include "sim/digits/precise-course.h"
#include "sim/digits/precise.h"
#include "sim/error/companion.h"
#include "sim/error/failure.h"
#include "sim/form/tables.h"

enum { MOST_NAMES = 8 };

/* Record the failure of a run with `digits` as a run in doubles would, with the end state rounded
 * to doubles. */
static qdot_status
record_failure(qdot_run *run, const qdot_ode_result *result)
{
    const qdot_trajectory *tr = &run->course.tr;
    qdot_text reason = {0};
    qdot_status status;

    qdot_text_add(&reason, result->reason);
    status = qdot_failure_explain(run->plan, qdot_course_systems(&run->course), result->t,
                                  tr->y + (tr->count - 1) * tr->n, run->t1 - run->t0,
                                  &reason);
    if (status == QDOT_OK)
        status = qdot_run_say_why(run, qdot_text_str(&reason));
    qdot_text_clear(&reason);
    return status;
}

static qdot_status
record_reason_of_end(qdot_run *run, const qdot_domains *domains)
{
    const qdot_ode_result *result = qdot_precise_pair_result(run->precise);
    char reason[400];

    if (result->outcome == QDOT_ODE_FAILED)
        return record_failure(run, result);
    if (run->course.stopped_by != SIZE_MAX || run->course.reason[0] != '\0')
        return qdot_run_say_course(run);
    if (!domains->left)
        return QDOT_OK;
    snprintf(reason, sizeof reason, "%.100s left its domain %.200s at t = %.15g",
             run->plan->names[domains->left->coordinate], domains->left->text, result->t);
    return qdot_run_say_why(run, reason);
}

/* The largest |f| over the points of the run, of the holonomic rows or of those of
 * velocities. */
static qdot_status
find_largest_residual(qdot_run *run, const qdot_scene *scene, qdot_constraint_kind kind, double *most)
{
    const qdot_constraints *c = run->plan->constraints;

    for (size_t k = 0; k < c->m; k++) {
        /* take f from the scene, as the row's own f holds for one side only if the equations switch */
        /* an equation of a massless coordinate; only rates of states may switch, and pieces begin with these as they are */
        const bool massless = c->rows[k].multiplier == QDOT_NIL;
        qdot_drift f = {
            .quantity = massless ? c->rows[k].f : qdot_plan_substitute(run->plan, scene->constraints.at[k].f)};
        qdot_drifts one = {.n = 1, .at = &f};

        if (c->rows[k].kind != kind || (massless && run->stage.switches.surfaces.n > 0))
            continue;
        QDOT_TRY(qdot_precise_pair_drifts(run->precise, &one));
        *most = fmax(*most, f.drift); /* fmax also replaces the NaN that *most is at first */
    }
    return QDOT_OK;
}

/* Multipliers of the end state as doubles have it; how far the constraints were left in
 * all digits. */
static qdot_status
measure_constraint_drift(qdot_run *run, const qdot_scene *scene)
{
    const size_t n = 2 * run->plan->n;
    const qdot_trajectory *tr = &run->course.tr;
    const double *y = tr->y + (tr->count - 1) * tr->n;
    double *difference = qdot_calloc(n, sizeof *difference);
    qdot_status status;

    if (!difference)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        difference[i] = 0x1p-53 * fmax(1, fabs(y[i]));
    status = qdot_multipliers_measure(run->course.binds.at, tr, &run->multipliers);
    if (status == QDOT_OK)
        status = qdot_multipliers_errors(run->course.binds.at, tr, difference,
                                         &run->multipliers);
    qdot_free(difference);
    QDOT_TRY(status);
    run->multipliers.position = run->multipliers.velocity = NAN;
    QDOT_TRY(find_largest_residual(run, scene, QDOT_HOLONOMIC, &run->multipliers.position));
    return find_largest_residual(run, scene, QDOT_VELOCITY, &run->multipliers.velocity);
}

static qdot_status
keep_end_state(qdot_run *run)
{
    const qdot_plan *p = run->plan;
    const size_t n = 2 * p->n, m = p->m;
    qdot_status status;

    run->exact = qdot_calloc(n + m, sizeof *run->exact);
    if (!run->exact)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        run->exact[i] = qdot_precise_pair_end(run->precise, i);
    QDOT_TRY(qdot_pool_check(p->pool));
    if (m == 0 || !run->multipliers.error)
        return QDOT_OK;
    status = qdot_precise_pair_values(run->precise, m, p->multipliers, QDOT_NIL,
                                      run->exact + n, run->multipliers.error);
    for (size_t k = 0; k < m; k++)
        if (!isfinite(run->multipliers.lambda[k])) /* infinite or undefined in doubles: no digits are given */
            run->exact[n + k] = QDOT_NIL;
    return status == QDOT_EDOMAIN ? QDOT_OK : status; /* not a failure: multipliers without a value stay nil */
}

/* Add a notice for each event that a companion of the run in doubles, whose events are followed, met more often than it. */
static qdot_status
note_missed_events(qdot_run *run)
{
    for (size_t i = 0; i < run->stage.events.n; i++) {
        const size_t own = qdot_course_count(&run->course, i), other = qdot_course_count(&run->companion, i),
                     third = qdot_course_count(&run->twin, i), most = other > third ? other : third;

        if (most > own)
            qdot_text_format(qdot_run_next_notice(run),
                             "the event %s may occur more often: doubles, which `digits` follows through events, do not "
                             "tell whether it does so %zu or %zu times",
                             run->stage.events.at[i].name, own, most);
    }
    return qdot_text_status(&run->notice);
}

/* Check that rounding of the start does not change the course of events of the run in doubles. */
static qdot_status
check_guiding_run(qdot_run *run)
{
    double t;

    if (run->course.failed)
        return QDOT_OK;
    QDOT_TRY(qdot_run_twin(run));
    t = qdot_run_time_of_parting(run);
    QDOT_TRY(note_missed_events(run));
    qdot_run_drop_companions(run);
    return isnan(t) ? QDOT_OK : qdot_precise_beyond_doubles(t);
}

/* The guide: a run in doubles that finds the sequence of events and switches and their times. What
 * follows its end is not known: if it did not arrive, its reason becomes that of the run. */
static qdot_status
make_guiding_run(qdot_run *run, const qdot_run_request *request)
{
    qdot_course *c = &run->course;
    qdot_ode_options options = {
        .tol = request->tol, .carry = run->start_low, .t1_low = run->t1_low, .meter = &run->meter};
    const char *why;
    double end;
    qdot_status status;

    run->report.tol = request->tol;
    qdot_ode_meter_begin(&run->meter, run->t0, run->t1);
    status = qdot_course_run(c, run->plan->method, &options, run->t0, run->t1, run->start);
    qdot_ode_meter_end(&run->meter);
    if (status != QDOT_OK
        && (c->tr.count == 0 || (status != QDOT_EFAILED && status != QDOT_ESINGULAR
                                 && status != QDOT_EDOMAIN)))
        return status;
    end = c->tr.t[c->tr.count - 1];
    if (c->reason[0] != '\0' || c->stopped_by != SIZE_MAX || (status == QDOT_OK && end == run->t1))
        return QDOT_OK;
    why = c->tr.result.reason[0] != '\0' ? c->tr.result.reason
          : status != QDOT_OK            ? qdot_last_error()->message
                                         : "it did not reach its end";
    snprintf(c->reason, sizeof c->reason,
             "the run in doubles, which `digits` follows through events and switches, ended at "
             "t = %.15g: %.200s",
             end, qdot_course_cause(why) ? qdot_course_cause(why) : why);
    c->failed = true;
    return QDOT_OK;
}

qdot_status
qdot_digits_say_start(qdot_run *run, const qdot_scene *scene, const qdot_run_request *request)
{
    const size_t n = run->plan->n - run->plan->n_states;
    size_t found = 0;

    for (size_t i = 0; i < 2 * n; i++) {
        const size_t k = i % n;
        const bool *named = i < n ? request->q_named : request->v_named;

        if (i >= n && k < scene->coordinates.n && qdot_scene_state_of(scene, scene->coordinates.at[k]))
            continue;
        if (!named || named[k] || run->start[i < n ? k : run->plan->n + k] == 0)
            continue;
        if (found++ < MOST_NAMES)
            qdot_text_format(found == 1 ? qdot_run_next_notice(run) : &run->notice, "%s%s%s",
                             found == 1 ? "" : ", ", run->plan->names[k], i < n ? "" : "'");
    }
    if (found > MOST_NAMES)
        qdot_text_format(&run->notice, " and %zu more", found - MOST_NAMES);
    if (found > 0)
        qdot_text_format(&run->notice,
                         " at the start: solved for in doubles, then refined to %d digits",
                         request->digits);
    return qdot_text_status(&run->notice);
}

/* Refuse scenes with layers (layer.h), as what is left out in them exceeds the error that `digits` allows. */
static qdot_status
refuse_layers(const qdot_run *run)
{
    for (size_t i = 0; i < run->stage.switches.surfaces.n; i++)
        if (run->stage.switches.surfaces.at[i].layer > 0) {
            qdot_fail(QDOT_EFAILED, "`digits` does not follow a power of %.4g where its base "
                                    "passes 0",
                      run->stage.switches.surfaces.at[i].power);
            return qdot_hint("a run in doubles: `run ... tol 1e-15`");
        }
    return QDOT_OK;
}

qdot_status
qdot_digits_carry_out(qdot_run *run, qdot_scene *scene, const qdot_run_request *request,
                      qdot_domains *domains, bool *interrupted)
{
    const qdot_course *guide = NULL;
    qdot_error failure;
    qdot_status status;

    if (qdot_tables_any(run->plan))
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: digits with functions given by data");
    QDOT_TRY(qdot_tables_check_digits(run->plan));
    QDOT_TRY(refuse_layers(run));
    if (run->stage.events.n > 0 || run->stage.switches.surfaces.n > 0) {
        QDOT_TRY(make_guiding_run(run, request));
        QDOT_TRY(check_guiding_run(run));
        guide = &run->course;
    }
    status = qdot_precise_pair_new(run->plan, request, run->start, domains, guide,
                                   &run->precise);
    failure = *qdot_last_error();
    *interrupted = status == QDOT_EINTR && run->precise;
    if (*interrupted)
        status = QDOT_OK;
    if (status == QDOT_OK)
        status = qdot_precise_pair_sample(run->precise, &run->course.tr);
    if (status == QDOT_OK) {
        const size_t stopped_by = guide ? guide->stopped_by : SIZE_MAX;

        status = qdot_course_prepare(&run->course);
        run->course.stopped_by = stopped_by;
    }
    if (status == QDOT_OK)
        status = record_reason_of_end(run, domains);
    if (status == QDOT_OK && !*interrupted)
        status =
            qdot_drifts_measure(scene, run->plan, &run->course.tr, &run->stage, &run->drifts);
    if (status == QDOT_OK && !*interrupted)
        status = qdot_precise_pair_drifts(run->precise, &run->drifts);
    if (status == QDOT_OK && run->plan->constraints)
        status = *interrupted ? qdot_multipliers_measure(run->course.binds.at, &run->course.tr,
                                                         &run->multipliers)
                              : measure_constraint_drift(run, scene);
    if (status == QDOT_OK)
        status = keep_end_state(run);
    if (status == QDOT_OK && *interrupted)
        qdot_fail_again(&failure);
    run->report.digits = request->digits;
    return status;
}

void
qdot_digits_fill_report(qdot_run *run)
{
    qdot_run_report *r = &run->report;

    r->tol = qdot_precise_pair_tol(run->precise);
    r->error = r->scaled_error = qdot_precise_pair_error(run->precise);
    r->factorizations = qdot_precise_pair_factored(run->precise);
    r->exact = run->exact;
}

qdot_status
qdot_digits_occurrences(qdot_run *run)
{
    const qdot_course *c = &run->course;

    run->occurrences.n = 0;
    for (size_t i = 0; i < c->occurrences.n; i++) {
        const qdot_occurrence *o = &c->occurrences.at[i];
        qdot_run_occurrence out = {
            .event = run->stage.events.at[o->event].name, .t = o->t, .way = o->way};

        out.exact = qdot_precise_pair_time(run->precise, i, &out.error);
        QDOT_TRY(qdot_pool_check(run->plan->pool));
        QDOT_TRY(qdot_vec_push(&run->occurrences, out));
    }
    return QDOT_OK;
}
