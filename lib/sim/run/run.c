/* run.c -- carries out a request: integrates, estimates the error, fills the report. */
#include "sim/form/derived.h"
#include "sim/run/change-chart.h"
#include "sim/run/change-over.h"
#include "sim/run/chart-run.h"
#include "sim/run/long-run.h"
#include "sim/run/origin.h"
#include "sim/run/run-back.h"
#include "sim/run/run-doubts.h"
#include "sim/run/run-report.h"
#include "sim/run/run-start.h"
#include "sim/run/run.h"
#include "sim/run/scales.h"
#include "sim/run/slides.h"
#include "sim/run/tighter-run.h"

#include <math.h>
#include <string.h>
#include <time.h>

#include "base/process.h"
#include "base/progress.h"
#include "ode/companion.h"
#include "sim/course/multipliers.h"
#include "sim/course/run-time.h"
#include "sim/digits/digits.h"
#include "sim/digits/precise.h"
#include "sim/error/companion.h"
#include "sim/error/failure.h"
#include "sim/error/horizon.h"
#include "sim/error/singular-places.h"
#include "sim/model/parameter-states.h"
#include "sim/model/still.h"
#include "tape/shake.h"

/* `auto` changes to a method for stiff scenes only if at least this much work (ns) is left
 * (ode/stiffness.h). */
static const double worth_changing = 3e6;

/* The spacing of doubles is 2.2e-16 of their size: no step can be more accurate. */
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
    qdot_course_clear(&run->course);
    qdot_course_clear(&run->companion);
    qdot_course_clear(&run->twin);
    qdot_drifts_clear(&run->drifts);
    qdot_precise_pair_free(run->precise);
    qdot_free(run->exact);
    qdot_stage_clear(&run->stage);
    qdot_free(run->occurrences.at);
    qdot_free(run->faded.at);
    qdot_free(run->doubt);
    qdot_free(run->start);
    qdot_free(run->start_low);
    qdot_free(run->units);
    qdot_free(run->apart);
    qdot_free(run->difference);
    qdot_free(run->reason);
    qdot_text_clear(&run->notice);
    qdot_text_clear(&run->part_names);
    qdot_free(run->parts.at);
    qdot_multipliers_clear(&run->multipliers);
    qdot_run_chart_free(run->chart);
    qdot_free(run->times);
    qdot_free(run->told);
    qdot_free(run);
}

static size_t
bytes_of_points(const qdot_trajectory *tr)
{
    size_t bytes = (tr->t_capacity + tr->y_capacity + tr->low_capacity) * sizeof *tr->t;

    for (size_t i = 0; i < tr->n_tracks; i++)
        bytes += bytes_of_points(&tr->tracks[i]);
    return bytes;
}

size_t
qdot_run_bytes(const qdot_run *run)
{
    const size_t points = bytes_of_points(&run->course.tr) + bytes_of_points(&run->companion.tr) +
                          bytes_of_points(&run->twin.tr);

    /* with `digits`, add the points of the run and of its companion run in MPFR */
    return sizeof *run +
           points * (1 + (run->precise ? 8 + (size_t)run->report.digits / 8 : 0));
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

/* --- integration and its error ------------------------------------------------------ */

/* Whether an incomplete run that ended with this status is kept. */
static bool
is_run_kept(qdot_status status)
{
    return status == QDOT_OK || status == QDOT_EFAILED || status == QDOT_ELIMIT
           || status == QDOT_EDOMAIN || status == QDOT_ESINGULAR || status == QDOT_EINTR;
}

/* Add places passed where the constraints depend on each other to the notice. If the search
 * fails, the run does not. */
static qdot_status
add_notice_of_singular_places(qdot_run *run, bool *interrupted)
{
    const qdot_error before = *qdot_last_error();
    qdot_text lines = {0};
    qdot_status status = qdot_singular_places_tell(&run->course, &lines);

    *interrupted = status == QDOT_EINTR;
    if (status == QDOT_OK && lines.n > 0)
        qdot_text_add(qdot_run_next_notice(run), qdot_text_str(&lines));
    qdot_text_clear(&lines);
    if (status == QDOT_ENOMEM)
        return status;
    qdot_fail_again(&before);
    return qdot_text_status(&run->notice);
}

/* Add a notice that the tolerance is below the rounding error of the equations. */
static qdot_status
add_notice_of_tolerance(qdot_run *run, double tol)
{
    const double raised = run->course.tr.result.stats.raised;

    if (!(raised > tol))
        return QDOT_OK;
    qdot_text_format(qdot_run_next_notice(run),
                     "tol %.3g is below the rounding errors of the equations: where these are "
                     "largest, steps were held to %.2g",
                     tol, raised);
    return qdot_text_status(&run->notice);
}

static const double *
last_state(const qdot_run *run)
{
    return run->course.tr.y + (run->course.tr.count - 1) * run->course.tr.n;
}

/* Append to the reason the constraints that are nearly dependent where the run stopped; whether
 * there are any. */
static bool
append_dependent_constraints(const qdot_run *run, qdot_text *reason)
{
    qdot_constrained *held =
        run->course.binds.at[0] ? qdot_bind_held(run->course.binds.at[0]) : NULL;
    bool *rows = held ? qdot_calloc(qdot_constrained_rows(held), sizeof *rows) : NULL;
    const bool found = rows && !strstr(qdot_text_str(reason), "independent")
                       && !strstr(qdot_text_str(reason), "no direction")
                       && qdot_constrained_near(held, run->course.tr.t[run->course.tr.count - 1],
                                                last_state(run), rows);

    if (found) {
        qdot_text_add(reason, "; ");
        qdot_constrained_say_dependent(run->plan->constraints, rows, reason);
        qdot_text_add(reason, " there, which method taylor can go over");
    }
    qdot_free(rows);
    return found;
}

/* Set the run's reason: why the integration failed. */
static qdot_status
record_failure(qdot_run *run, qdot_status status)
{
    const qdot_trajectory *tr = &run->course.tr;
    const qdot_trajectory_piece *piece = tr->pieces.at + tr->pieces.n - 1;
    const char *why = tr->result.reason[0] ? tr->result.reason : qdot_last_error()->message;
    qdot_text reason = {0};

    qdot_text_add(&reason, why);
    if (!append_dependent_constraints(run, &reason) && status == QDOT_EFAILED) {
        const size_t said = reason.n;

        status = qdot_failure_explain(run->plan,
                                      qdot_course_systems(&run->course) + piece->mode,
                                      tr->t[tr->count - 1], last_state(run),
                                      run->t1 - run->t0, &reason);
        run->singular = reason.n > said;
    } else {
        status = qdot_text_status(&reason);
    }
    if (status == QDOT_OK)
        status = qdot_run_say_why(run, qdot_text_str(&reason));
    qdot_text_clear(&reason);
    return status;
}

/* Integrate the run; QDOT_OK if any part of it is kept. *interrupted: Ctrl-C ended it. */
static qdot_status
integrate(qdot_run *run, double tol, bool *interrupted)
{
    qdot_ode_options options = {.tol = tol,
                                .carry = run->start_low,
                                .t0_low = run->t0_low,
                                .t1_low = run->t1_low,
                                .leading = run->leading,
                                .judged = run->leading,
                                .alternates = run->turns,
                                .meter = &run->meter,
                                .stiff_work = run->plan->chosen ? worth_changing : 0};
    qdot_status status;

    run->course.exact = run->apart == NULL;
    qdot_progress_begin(run->t0, run->t1, "run");
    status = qdot_course_run(&run->course, run->plan->method, &options, run->t0, run->t1,
                             run->start);
    qdot_ode_meter_end(&run->meter);
    *interrupted = status == QDOT_EINTR;
    run->factored = 0; /* reset: reading the run factors matrices, too */
    for (size_t i = 0; i < run->course.binds.n; i++)
        if (run->course.binds.at[i])
            run->factored += qdot_bind_factored(run->course.binds.at[i]);
    if (!is_run_kept(status) || run->course.tr.count == 0)
        return status;
    if (!*interrupted)
        QDOT_TRY(add_notice_of_singular_places(run, interrupted));
    if (status != QDOT_OK)
        return record_failure(run, status);
    return qdot_run_say_course(run);
}

/* Give a companion run the states of the run at the times at which it compares the two. */
static qdot_status
give_states_to_companion(qdot_run *run, qdot_companion *companion)
{
    qdot_trajectory_cursor *cursor;
    size_t count, n = run->course.tr.n;
    const double *times = qdot_companion_times(companion, &count);
    double *y;
    qdot_status status;

    if (count == 0)
        return QDOT_OK;
    QDOT_TRY(qdot_trajectory_open(&run->course.tr, qdot_course_systems(&run->course),
                                  &cursor));
    y = qdot_malloc(n * sizeof *y);
    status = y ? QDOT_OK : QDOT_ENOMEM;
    for (size_t k = 0; k < count && status == QDOT_OK; k++) {
        status = qdot_trajectory_read(cursor, times[k], y);
        if (status == QDOT_OK)
            qdot_companion_show(companion, k, y);
    }
    qdot_free(y);
    qdot_trajectory_close(cursor);
    /* without those states, only the error at the end is known */
    return qdot_grave(status);
}

/* Whether the run has an exact start and neither events nor switches divide it. */
static bool
is_undivided(const qdot_run *run)
{
    return !run->plan->delayed && run->apart == NULL && run->stage.events.n == 0 && run->stage.switches.surfaces.n == 0;
}

/* Whether nothing changes the motion suddenly: there are no switches, and no event has an effect. */
static bool
is_undisturbed(const qdot_run *run)
{
    for (size_t i = 0; i < run->stage.events.n; i++)
        if (qdot_staged_event_acts(&run->stage.events.at[i]))
            return false;
    return !run->plan->delayed && run->stage.switches.surfaces.n == 0;
}

static qdot_status
measure_multipliers(qdot_run *run)
{
    return qdot_multipliers_measure(run->course.binds.at, &run->course.tr, &run->multipliers);
}

/* Start the companion runs that run in parallel; their courses record their motion. */
static qdot_status
start_companion(qdot_run *run, double tol, qdot_companion **out)
{
    qdot_companion_request request = {.method = run->plan->method,
                                      .tol = tol,
                                      .t0 = run->leading ? run->t0
                                                         : qdot_shake_double(
                                                             run->t0, run->t0_side),
                                      .t0_low = run->t0_low,
                                      .t1 = run->t1,
                                      .t1_low = run->t1_low,
                                      .y0 = run->start,
                                      .carry = run->start_low,
                                      .units = run->units,
                                      .leading = run->leading,
                                      .alternates = run->turns,
                                      .meter = &run->meter,
                                      .kept = {&run->companion.tr, &run->twin.tr},
                                      .threaded = !qdot_threads_are_taken};

    if (run->plan->method->geometric)
        request.t1 = qdot_shake_double(run->t1, run->t1_side);
    run->companion.shaken = true;
    QDOT_TRY(qdot_course_prepare(&run->companion));
    QDOT_TRY(qdot_course_prepare(&run->twin));
    request.system = qdot_course_systems(&run->companion);
    request.twin = qdot_course_systems(&run->twin);
    QDOT_TRY(qdot_still_find(run->plan, request.system, run->t0, run->start, run->start_low,
                              run->units));
    return qdot_companion_start(&request, out);
}

/* Record the reason why the error of the run is unknown. */
static qdot_status
record_doubt(qdot_run *run, const char *reason)
{
    char text[400];

    snprintf(text, sizeof text,
             "a second run, from a start moved by a rounding error, did not reach the end%s%.300s",
             reason[0] ? ": " : "", reason);
    return qdot_run_say_doubt(run, text);
}

/* Integrate the run, with two companion runs on parallel threads, which estimate its error. */
static qdot_status
integrate_with_parallel_companions(qdot_run *run, double tol, bool *interrupted)
{
    qdot_companion_estimate estimate = {.error = 0, .plain = 0};
    qdot_companion *companion = NULL;
    qdot_status status = QDOT_OK;

    qdot_run_drop_companions(run);
    qdot_ode_meter_begin(&run->meter, run->t0, run->t1);
    if (run->t0 != run->t1) {
        /* if M with slightly perturbed constants has no inverse, the error remains unknown */
        estimate.error = estimate.plain = NAN;
        status = start_companion(run, tol, &companion);
        if (status == QDOT_ESINGULAR || status == QDOT_EDOMAIN)
            status = QDOT_OK;
    }
    if (status == QDOT_OK)
        status = integrate(run, tol, interrupted);
    if (companion)
        qdot_companion_limit(companion, run->course.tr.result.stats.steps);
    if (companion && status == QDOT_OK && !*interrupted
        && run->course.tr.result.outcome == QDOT_ODE_DONE)
        status = give_states_to_companion(run, companion);
    if (status == QDOT_OK)
        status = measure_multipliers(run);
    if (companion) {
        bool there = run->course.tr.count > 0;
        qdot_error failure = *qdot_last_error();

        double *difference = run->difference;

        if (there)
            qdot_companion_show_course(companion, &run->course.tr, qdot_course_systems(&run->course));
        qdot_companion_finish(companion, there ? run->course.tr.result.t : run->t1,
                              there ? last_state(run) : run->start, difference,
                              &estimate);
        if (status == QDOT_OK && !*interrupted && there)
            status = qdot_multipliers_errors(run->course.binds.at, &run->course.tr,
                                       difference, &run->multipliers);
        run->has_companion = estimate.kept[0];
        run->has_twin = estimate.kept[0] && estimate.kept[1];
        run->way = run->has_twin ? estimate.way : QDOT_COMPANION_WAYS;
        run->report.estimate_work += estimate.work;
        run->of_point = estimate.of_point;
        if (status == QDOT_OK && !estimate.known)
            status = record_doubt(run, estimate.result.reason);
        if (status != QDOT_OK || *interrupted)
            qdot_fail_again(&failure);
    }
    run->report.error = estimate.plain;
    run->report.scaled_error = estimate.error;
    return status;
}

/* Integrate the run, then estimate its error by a companion run that finds events by itself. */
static qdot_status
integrate_then_run_companion(qdot_run *run, double tol, bool *interrupted)
{
    qdot_status status;

    qdot_ode_meter_begin(&run->meter, run->t0, run->t1);
    QDOT_TRY(integrate(run, tol, interrupted));
    run->report.error = run->report.scaled_error = NAN;
    run->report.tol = tol;
    QDOT_TRY(measure_multipliers(run));
    if (*interrupted || run->course.tr.result.unfit)
        return QDOT_OK;
    QDOT_TRY(qdot_run_twin(run));
    status = qdot_run_end_error(run, run->difference);
    if (status == QDOT_OK && !isnan(run->report.error))
        status = qdot_multipliers_errors(run->course.binds.at, &run->course.tr, run->difference,
                                         &run->multipliers);
    return status;
}

/* Integrate and estimate the error: by parallel companion runs if possible, else by later ones. */
static qdot_status
integrate_with_error(qdot_run *run, double tol, bool *interrupted)
{
    return is_undivided(run) ? integrate_with_parallel_companions(run, tol, interrupted) : integrate_then_run_companion(run, tol, interrupted);
}

/* Make a run whose first orders in two doubles did not fit once more, without them; of its notice as
 * much stays as was said before it. */
static qdot_status
make_run_in_doubles(qdot_run *run, double tol, size_t notice, bool *interrupted)
{
    qdot_free(run->reason);
    qdot_free(run->doubt);
    run->reason = run->doubt = NULL;
    run->report.reason = NULL;
    run->report.status = QDOT_RUN_DONE;
    qdot_text_truncate(&run->notice, notice);
    run->leading = run->singular = false;
    qdot_run_drop_companions(run);
    return integrate_with_error(run, tol, interrupted);
}

/* Integrate the run, then find its error and the drifts of conserved quantities. */
static qdot_status
integrate_and_measure(qdot_run *run, qdot_scene *scene, double tol, bool *interrupted)
{
    const size_t notice = run->notice.n;
    qdot_status status;

    *interrupted = false;
    run->difference = qdot_calloc(2 * run->plan->n + 1, sizeof *run->difference);
    if (!run->difference)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < 2 * run->plan->n; i++)
        run->difference[i] = NAN;
    /* double-double precision needs undisturbed motion, because the time of an event is a double */
    run->leading = run->plan->leading && is_undisturbed(run);
    status = integrate_with_error(run, tol, interrupted);
    if (status == QDOT_OK && run->course.tr.result.unfit)
        status = make_run_in_doubles(run, tol, notice, interrupted);
    run->report.tol = tol;
    if (status == QDOT_OK && !run->by_clock)
        status = add_notice_of_tolerance(run, tol);
    if (status == QDOT_OK && !*interrupted)
        status = qdot_run_doubt_places(run);
    if (status == QDOT_OK && run->singular)
        status = qdot_run_doubt_end(run);
    if (status == QDOT_OK && !*interrupted && !run->hidden)
        status = qdot_horizon_find(run);
    if (status == QDOT_OK && !*interrupted && !run->no_drifts)
        status = qdot_drifts_measure(scene, run->plan, &run->course.tr, &run->stage, &run->drifts);
    if (status == QDOT_OK && !*interrupted)
        status = qdot_run_doubt_energy(run, tol);
    if (status == QDOT_EINTR && run->course.tr.count > 0) { /* report the part that exists */
        *interrupted = true;
        status = QDOT_OK;
    }
    return status;
}

/* Find a tolerance *better, to be used instead of tol if the run has many steps. */
static qdot_status
choose_tolerance_for_long_run(qdot_scene *scene, const qdot_run *run, double tol, double *better)
{
    const qdot_long_run it = {.plan = run->plan,
                              .system = qdot_course_systems(&run->course),
                              .start = run->start,
                              .low = run->start_low,
                              .t0 = run->t0,
                              .t1 = run->t1,
                              .tol = tol};
    bool conserved = false;

    *better = tol;
    if (!is_undisturbed(run))
        return QDOT_OK;
    QDOT_TRY(qdot_long_run_tolerance(&it, better));
    if (*better != tol)
        QDOT_TRY(qdot_mech_energy_conserved(scene, &conserved));
    if (!conserved) /* energy is not conserved, so it need not be preserved */
        *better = tol;
    return QDOT_OK;
}

/* Add a notice that a tighter tolerance than the default, tol, was used. */
static qdot_status
add_notice_of_tighter_tolerance(qdot_run *run, double tol)
{
    qdot_text_format(qdot_run_next_notice(run),
                     "more than %g steps were foreseen: under tol %.3g, not %.3g, the energy errs by "
                     "rounding alone; method taylor keeps to tol",
                     QDOT_LONG_STEPS, run->report.tol, tol);
    return qdot_text_status(&run->notice);
}

/* touch_tol: of the course; *better: the tolerance that it should have, before anything was
 * integrated. */
static qdot_status
make_run_once(qdot_scene *scene, const qdot_run_request *asked, double touch_tol, double *better,
              qdot_run **out)
{
    const qdot_run_request precise = qdot_precise_request(asked);
    const qdot_run_request *request = asked->digits ? &precise : asked;
    bool interrupted = false;
    qdot_run *run;
    qdot_status status;

    QDOT_TRY(asked->digits ? qdot_precise_check(scene, asked) : check_tolerance(asked->tol));
    run = qdot_calloc(1, sizeof *run);
    if (!run)
        return QDOT_ENOMEM;
    run->report.horizon = run->report.standstill = NAN;
    run->by_clock = request->by_clock;
    run->no_drifts = request->no_drifts, run->meter.most = request->most_work;
    run->turns = request->turns;
    status = qdot_stage_begin(&run->stage, scene, request);
    run->course.stage = run->companion.stage = run->twin.stage = &run->stage;
    run->course.touch_tol = touch_tol;
    if (status == QDOT_OK) {
        run->plan = run->stage.modes.at[0]->plan;
        status = qdot_run_start(run, scene, request);
    }
    if (status == QDOT_OK && run->plan->delayed && run->t1 < run->t0)
        status = qdot_fail(QDOT_ENOTBUILT, "not built yet: runs back in time with delays");
    *better = request->tol;
    qdot_progress_begin(run->t0, run->t1, "run");
    if (status == QDOT_OK && !request->digits)
        status = choose_tolerance_for_long_run(scene, run, request->tol, better);
    if (status == QDOT_OK && *better != request->tol) {
        qdot_run_free(run);
        return QDOT_OK;
    }
    if (status == QDOT_OK)
        status = request->digits
                     ? qdot_digits_carry_out(run, scene, request, &run->stage.domains,
                                             &interrupted)
                     : integrate_and_measure(run, scene, request->tol, &interrupted);
    if (status == QDOT_OK)
        status = qdot_slides_tell(run);
    if (status == QDOT_OK)
        status = qdot_run_back_tell(run);
    if (status != QDOT_OK) {
        qdot_run_free(run);
        return status;
    }
    run->stage.scene = NULL;
    run->stage.request = NULL;
    status = qdot_run_fill_report(run, request->tol);
    if (status == QDOT_OK && !interrupted)
        status = qdot_run_name_redundant(run, scene, request);
    if (status != QDOT_OK) {
        qdot_run_free(run);
        return status;
    }
    if (request->digits)
        qdot_digits_fill_report(run);
    run->report.interrupted = interrupted;
    *out = run;
    return interrupted ? QDOT_EINTR : QDOT_OK;
}

/* Make the run; repeat it if it is long (tighter), or until it is decided whether an event touches. */
static qdot_status
make_run_with_decided_events(qdot_scene *scene, const qdot_run_request *asked, qdot_run **out)
{
    qdot_run_request request = *asked;

    for (double touch_tol = asked->tol;;) {
        const double before = touch_tol;
        double better;

        QDOT_TRY(make_run_once(scene, &request, touch_tol, &better, out));
        if (!*out) {
            request.tol = better;
            continue;
        }
        if (request.tol != asked->tol)
            QDOT_TRY(add_notice_of_tighter_tolerance(*out, asked->tol));
        if (asked->digits)
            return QDOT_OK;
        QDOT_TRY(qdot_run_decide_touches(*out, &touch_tol));
        if (touch_tol == before)
            return QDOT_OK;
        qdot_run_free(*out);
        *out = NULL;
    }
}

/* Make the run; repeat it with a stiff method if `auto` finds it stiff, or with a tighter tolerance. */
static qdot_status
make_best_run(qdot_scene *scene, const qdot_run_request *request, qdot_run **out)
{
    const qdot_run_maker by = {make_run_with_decided_events, qdot_run_values, qdot_run_free};

    QDOT_TRY(make_run_with_decided_events(scene, request, out));
    if (request->digits)
        return QDOT_OK;
    QDOT_TRY(qdot_run_change_over(scene, request, &by, out));
    return qdot_run_tighten(scene, request, &by, out);
}

/* Repeat the run with the scales of its components; keep the first run if that fails. */
static qdot_status
repeat_with_scales(qdot_scene *scene, const qdot_run_request *request, qdot_run **run)
{
    qdot_run_request scaled = *request;
    double *scales = qdot_calloc(2 * (*run)->plan->n, sizeof *scales);
    qdot_run *other = NULL;
    qdot_status status = scales ? QDOT_OK : QDOT_ENOMEM;
    bool found = false;

    scaled.scales = scales;
    if (status == QDOT_OK)
        status = qdot_run_find_scales(*run, request, scales, &found);
    if (status == QDOT_OK && found) {
        status = make_best_run(scene, &scaled, &other);
        if (status == QDOT_OK && other->course.tr.result.outcome != QDOT_ODE_FAILED) {
            qdot_run_free(*run);
            *run = other;
            other = NULL;
            status = qdot_run_say_scales(*run, scales, true);
        } else if (status != QDOT_ENOMEM && status != QDOT_EINTR) {
            status = QDOT_OK;
        }
        qdot_run_free(other);
    }
    qdot_free(scales);
    return status;
}

static const char start_as_exact[] = "the error of this run does not include that of the run from which the start was taken";

/* Make a run in which the parameters that events set are treated as further coordinates. */
static qdot_status
make_run_with_parameter_states(qdot_scene *scene, const qdot_run_request *asked, qdot_run **out)
{
    const qdot_run_maker by = {make_best_run, qdot_run_values, qdot_run_free};
    qdot_parameter_states states = {0};
    qdot_status status;

    QDOT_TRY(qdot_parameter_states_init(&states, scene, asked));
    status = make_best_run(scene, &states.request, out);
    if (status == QDOT_OK && !asked->digits)
        status = repeat_with_scales(scene, &states.request, out);
    if (!asked->digits && !qdot_scene_has_delays(scene)) /* a history is one of the scene's own coordinates */
        status = qdot_run_change_chart(scene, &states.request, &by, status, out);
    qdot_parameter_states_clear(&states);
    return status;
}

qdot_status
qdot_run_new(qdot_scene *scene, const qdot_run_request *asked, qdot_run **out)
{
    const double clock = process_clock();
    qdot_origin origin = {0};
    qdot_status status = qdot_origin_begin(&origin, scene, asked);

    *out = NULL;
    if (status == QDOT_OK)
        status = qdot_run_time_fail(origin.origin, make_run_with_parameter_states(scene, &origin.request, out));
    if (status == QDOT_OK && asked->apart && (!(*out)->apart || asked->digits)) {
        qdot_text_add(qdot_run_next_notice(*out), start_as_exact);
        status = qdot_text_status(&(*out)->notice);
    }
    if (*out && qdot_grave(status) != QDOT_ENOMEM
        && qdot_run_time_begin(*out, origin.origin) == QDOT_ENOMEM)
        status = QDOT_ENOMEM;
    qdot_origin_end(&origin);
    if (status == QDOT_ENOMEM) { /* this includes memory that ran out while the run was repeated */
        qdot_run_free(*out);
        *out = NULL;
    }
    if (*out) {
        (*out)->report.notice = (*out)->notice.n > 0 ? qdot_text_str(&(*out)->notice) : NULL;
        (*out)->report.cpu_total = process_clock() - clock;
    }
    return status;
}
