/* report.c -- prints the report of a run, as text or as JSON. */
#include "lang/answer/report.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/number-text.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "lang/answer/digits.h"
#include "lang/answer/write.h"
#include "lang/session/output.h"
#include "ode/scale.h"

static const char *
word_for_run_status(qdot_run_status status)
{
    static const char *const words[] = {[QDOT_RUN_DONE] = "done",
                                        [QDOT_RUN_STOPPED] = "stopped",
                                        [QDOT_RUN_FAILED] = "failed"};

    return words[status];
}

/* Append number i of the end state with as many digits as are known, in quotes for JSON; error: its absolute error. */
static qdot_status
append_exact_number(qdot_session *session, const qdot_run_report *r, size_t i, double error,
                    qdot_text *number)
{
    qdot_status status;

    qdot_text_add(number, session->output->json ? "\"" : "");
    status = qdot_digits_text(session, r->exact[i], r->digits, error, number);
    qdot_text_add(number, session->output->json ? "\"" : "");
    return status;
}

static void
append_double_with_error(qdot_session *session, double value, double error, double size,
                         qdot_text *number)
{
    if (session->output->json)
        qdot_number_text_json(number, value);
    else if (!isfinite(value))
        qdot_text_add(number, "unknown"); /* undetermined: the multiplier of a constraint whose gradient vanishes */
    else
        qdot_number_text(number, value,
                         isfinite(error) ? fmax(error, 2e-16) * size : NAN);
}

/* A number of the end state: coordinate, velocity, parameter that events set, or multiplier. */
typedef struct {
    qdot_expr symbol;
    double value, error; /* value and its error, relative to `size` */
    double size;         /* max(scale, |value|) */
    size_t exact;        /* the index of its exact value in report->exact */
    bool first;          /* the number begins a new line of text */
} end_number;

/* Number k of the end state, which lists q_0, q_0', q_1 ..., then the parameters, then the multipliers. */
static end_number
get_end_number(qdot_session *session, const qdot_run_report *r, size_t k)
{
    const size_t n = r->n - r->n_states;
    const bool velocity = k < 2 * n && k % 2 != 0;
    const size_t i = velocity ? r->n + k / 2 : k >= 2 * n ? k - n : k / 2;

    if (k >= 2 * n + r->n_states) {
        const size_t j = k - 2 * n - r->n_states;
        const double size = fmax(1, fabs(r->lambda[j]));

        return (end_number){r->multipliers[j], r->lambda[j], r->lambda_error[j] / size, size,
                            2 * r->n + j, j % 2 == 0};
    }
    return (end_number){velocity ? qdot_symbol_jet(session->pool, r->coordinates[k / 2], 1)
                                 : r->coordinates[i],
                        r->q[i], r->scaled_error, qdot_ode_size(r->scales, i, r->q[i]), i,
                        !velocity};
}

/* Call `each` for every number of the end state. */
static qdot_status
for_each_end_number(qdot_session *session, const qdot_run_report *report, qdot_style style,
                    void (*each)(qdot_text *line, size_t k, bool first, const char *name,
                                 const char *number),
                    qdot_text *line)
{
    const size_t numbers = 2 * report->n - report->n_states + report->m;

    for (size_t k = 0; k < numbers; k++) {
        const end_number x = get_end_number(session, report, k);
        const bool exact = report->exact != NULL && report->exact[x.exact] != QDOT_NIL;
        qdot_text name = {0}, number = {0};
        qdot_status status = qdot_pool_check(session->pool);

        if (status == QDOT_OK)
            status = qdot_print(session->pool, x.symbol, style, &name);
        if (status == QDOT_OK && exact)
            status = append_exact_number(session, report, x.exact, x.error * x.size, &number);
        else if (status == QDOT_OK)
            append_double_with_error(session, x.value, x.error, x.size, &number);
        if (status == QDOT_OK)
            each(line, k, x.first, qdot_text_str(&name), qdot_text_str(&number));
        qdot_text_clear(&name);
        qdot_text_clear(&number);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

static void
append_end_number_as_json(qdot_text *line, size_t k, bool first, const char *name, const char *number)
{
    (void)first;
    if (k > 0)
        qdot_text_char(line, ',');
    qdot_text_json(line, name);
    qdot_text_char(line, ':');
    qdot_text_add(line, number);
}

static void
append_end_number_as_text(qdot_text *line, size_t k, bool first, const char *name, const char *number)
{
    (void)k;
    qdot_text_add(line, first ? "\n    " : ", ");
    qdot_text_add(line, name);
    qdot_text_add(line, " = ");
    qdot_text_add(line, number);
}

static void
append_json_number(qdot_text *line, const char *name, double value)
{
    qdot_text_format(line, ",\"%s\":", name);
    qdot_number_text_json(line, value);
}

/* Write, for each quantity that should be constant, its name and its drift. */
static void
append_drifts_as_json(qdot_text *line, const qdot_run_report *r)
{
    qdot_text_add(line, ",\"drifts\":{");
    for (size_t i = 0; i < r->n_drifts; i++) {
        qdot_text_add(line, i > 0 ? "," : "");
        qdot_text_json(line, r->drifts[i].name);
        qdot_text_char(line, ':');
        qdot_number_text_json(line, r->drifts[i].drift);
    }
    qdot_text_char(line, '}');
}

/* Write which groups of coordinates, independent of each other, were integrated separately. */
static void
append_groups_as_json(qdot_text *line, const qdot_run_report *r)
{
    qdot_text_add(line, ",\"parts\":[");
    for (size_t i = 0; i < r->n_parts; i++) {
        qdot_text_add(line, i > 0 ? ",{\"coordinates\":" : "{\"coordinates\":");
        qdot_text_json(line, r->parts[i].coordinates);
        qdot_text_format(line, ",\"steps\":%" PRIu64 ",\"rejected\":%" PRIu64 "}", r->parts[i].steps,
                         r->parts[i].rejected);
    }
    qdot_text_char(line, ']');
}

/* Write how the constraints were satisfied, and whether the multipliers in "state" are unique. */
static qdot_status
append_constraints_as_json(qdot_session *session, const qdot_run_report *r, qdot_text *line)
{
    static const char *const treatments[] = {[QDOT_RUN_PROJECT] = "project",
                                             [QDOT_RUN_BAUMGARTE] = "baumgarte",
                                             [QDOT_RUN_NONE] = "none"};

    qdot_text_format(line,
                     ",\"constraints\":{\"count\":%zu,\"independent\":%zu,"
                     "\"treatment\":\"%s\",\"projections\":%" PRIu64,
                     r->m, r->independent,
                     r->digits > 0 ? "digits" : treatments[r->treatment], r->projections);
    append_json_number(line, "velocity_drift", r->velocity_drift);
    qdot_text_add(line, ",\"errors\":{");
    for (size_t k = 0; k < r->m; k++) {
        qdot_text name = {0};
        qdot_status status = qdot_print(session->pool, r->multipliers[k], QDOT_PLAIN, &name);

        qdot_text_add(line, k > 0 ? "," : "");
        qdot_text_json(line, qdot_text_str(&name));
        qdot_text_char(line, ':');
        qdot_number_text_json(line, r->lambda_error[k]);
        qdot_text_clear(&name);
        QDOT_TRY(status);
    }
    qdot_text_add(line, "}}");
    return QDOT_OK;
}

static qdot_status
write_run_as_json(qdot_session *session, const char *name, const qdot_run_report *r,
                  qdot_text *line)
{
    qdot_text_add(line, "{\"kind\":\"run\",\"name\":");
    qdot_text_json(line, name);
    qdot_text_add(line, ",\"method\":");
    qdot_text_json(line, r->method);
    qdot_text_add(line, ",\"t\":[");
    qdot_number_text_json(line, r->t0);
    qdot_text_char(line, ',');
    qdot_number_text_json(line, r->t1);
    qdot_text_char(line, ']');
    append_json_number(line, "tol", r->tol);
    qdot_text_format(line,
                     ",\"steps\":%" PRIu64 ",\"rejected\":%" PRIu64 ",\"evals\":%" PRIu64
                     ",\"jacobians\":%" PRIu64 ",\"factorizations\":%" PRIu64,
                     r->steps, r->rejected, r->evals, r->jacobians, r->factorizations);
    append_json_number(line, "cpu", r->cpu);
    append_json_number(line, "cpu_total", r->cpu_total);
    append_json_number(line, "error", r->error);
    if (r->scales)
        append_json_number(line, "scaled_error", r->scaled_error);
    append_json_number(line, "horizon", r->horizon);
    append_json_number(line, "energy_drift", r->energy_drift);
    append_drifts_as_json(line, r);
    append_json_number(line, "constraint_drift", r->m > 0 ? r->constraint_drift : NAN);
    qdot_text_add(line, ",\"state\":{");
    QDOT_TRY(for_each_end_number(session, r, QDOT_PLAIN, append_end_number_as_json, line));
    qdot_text_format(line, "},\"status\":\"%s\",\"reason\":", word_for_run_status(r->status));
    if (r->reason != NULL)
        qdot_text_json(line, r->reason);
    else
        qdot_text_add(line, "null");
    if (r->n_parts > 0)
        append_groups_as_json(line, r);
    if (r->m > 0)
        QDOT_TRY(append_constraints_as_json(session, r, line));
    qdot_text_add(line, "}\n");
    return QDOT_OK;
}

/* Write a number with a noun in the right form: 1 step, 12 steps. */
static void
add_count(qdot_text *line, uint64_t n, const char *noun)
{
    qdot_text_format(line, "%" PRIu64 " %s%s", n, noun, n == 1 ? "" : "s");
}

static void
add_seconds(qdot_text *line, double s)
{
    qdot_text_double(line, s < 1 ? s * 1e3 : s, 3);
    qdot_text_add(line, s < 1 ? " ms" : " s");
}

/* Write how far the state drifted off the constraints, and the method that kept it on them. */
static void
append_constraints_as_text(qdot_text *line, const qdot_run_report *r)
{
    static const char *const done[] = {
        [QDOT_RUN_PROJECT] = "projected after",
        [QDOT_RUN_BAUMGARTE] = "damped (Baumgarte)",
        [QDOT_RUN_NONE] = "drift left alone",
    };

    if (r->m == 0)
        return;
    qdot_text_add(line, "\n  constraints: ");
    if (isfinite(r->constraint_drift)) {
        qdot_text_add(line, "error ");
        qdot_number_text_bound(line, r->constraint_drift);
        if (isfinite(r->velocity_drift) && r->velocity_drift != r->constraint_drift) {
            qdot_text_add(line, ", of velocities ");
            qdot_number_text_bound(line, r->velocity_drift);
        }
        qdot_text_add(line, "; ");
    }
    qdot_text_add(line, r->digits > 0 ? "covered by guard digits" : done[r->treatment]);
    if (r->treatment == QDOT_RUN_PROJECT && r->digits == 0) {
        qdot_text_char(line, ' ');
        add_count(line, r->projections, "step");
    }
    if (r->independent < r->m)
        qdot_text_format(line,
                         "\n  %zu of the %zu constraints are independent: the motion is "
                         "unique, the multipliers are those of least norm",
                         r->independent, r->m);
}

/* A quantity counts as conserved if its drift is below this. */
static const double drifts_little = 1e-3;

/* Only for a tolerance above this a hint says that a smaller one would give correct digits for longer. */
static const double of_method = 1e-11;

/* Write which quantities are still accurate after the time from which on the state is not. */
static void
append_quantities_still_known(qdot_session *session, const qdot_run_report *r, qdot_text *line)
{
    bool some = false;

    qdot_text_add(line, "\n  beyond it ");
    for (size_t i = 0; i < r->n_drifts; i++) {
        const qdot_drift *d = &r->drifts[i];

        if (d->changed || (!d->kept && !(d->drift < drifts_little)))
            continue;
        qdot_text_add(line, some ? ", " : "what is conserved holds (");
        if (strcmp(d->name, "energy") == 0)
            qdot_text_add(line, d->name);
        else
            qdot_print_name(session->pool, d->name, session->output->style, line);
        some = true;
    }
    qdot_text_add(line, some ? "); " : "");
    if (isfinite(r->standstill)) {
        qdot_text_add(line, "about t = ");
        qdot_number_text(line, r->standstill, 0.005 * fabs(r->standstill));
        qdot_text_add(line, " the motion nearly comes to rest, and the side to which it leaves that "
                            "place is undecided");
    } else {
        qdot_text_add(line, "the states are a sample of what neighbouring motions do: means over "
                            "long times describe these");
    }
}

/* Write the end state, or the time since which it is dominated by error. */
static qdot_status
append_end_state_as_text(qdot_session *session, const qdot_run_report *r, qdot_text *line)
{
    if (isnan(r->horizon)) {
        qdot_text_add(line, "\n  end state:");
        QDOT_TRY(for_each_end_number(session, r, session->output->style, append_end_number_as_text, line));
    } else {
        qdot_text_add(line, "\n  horizon: t = ");
        qdot_number_text(line, r->horizon, 0.005 * fabs(r->horizon));
        qdot_text_add(line, r->tol > of_method
                                ? "; no digit of the state beyond it is right under this tol"
                                : ", where doubles are exhausted: no digit of the state "
                                  "beyond it is right; `digits 6` goes further");
        append_quantities_still_known(session, r, line);
    }
    qdot_text_char(line, '\n');
    return QDOT_OK;
}

static qdot_status
write_run_as_text(qdot_session *session, const char *name, const qdot_run_report *r,
                  qdot_text *line)
{
    qdot_text_format(line, "%s: t = ", name);
    qdot_number_text(line, r->t0, 0);
    qdot_text_add(line, "..");
    qdot_number_text(line, r->t1, 0);
    qdot_text_format(line, ", method %s, ", r->method);
    if (r->digits > 0) {
        qdot_text_format(line, "digits %d, tol ", r->digits);
        qdot_number_text_bound(line, r->tol);
    } else {
        qdot_text_add(line, "tol ");
        qdot_number_text(line, r->tol, 0);
    }
    qdot_text_format(line, ", %s", word_for_run_status(r->status));
    if (r->reason != NULL)
        qdot_text_format(line, ": %s", r->reason);
    qdot_text_add(line, "\n  ");
    add_count(line, r->steps, "step");
    qdot_text_format(line, ", %" PRIu64 " rejected; ", r->rejected);
    add_count(line, r->evals, "evaluation");
    qdot_text_add(line, " of ");
    add_count(line, r->operations, "operation");
    if (r->jacobians > 0) {
        qdot_text_add(line, "; ");
        add_count(line, r->jacobians, "Jacobian");
    }
    for (size_t i = 0; i < r->n_parts; i++) {
        qdot_text_format(line, "%s%s ", i == 0 ? "\n  apart: " : "; ",
                         r->parts[i].coordinates);
        add_count(line, r->parts[i].steps, "step");
    }
    qdot_text_add(line, "\n  cpu ");
    add_seconds(line, r->cpu);
    qdot_text_add(line, ", total cpu ");
    add_seconds(line, r->cpu_total);
    for (size_t i = 0; i < r->n_drifts; i++) {
        const qdot_drift *d = &r->drifts[i];

        qdot_text_add(line, i == 0 ? "\n  drift: " : ", ");
        if (strcmp(d->name, "energy") == 0)
            qdot_text_add(line, d->name);
        else
            qdot_print_name(session->pool, d->name, session->output->style, line);
        qdot_text_char(line, ' ');
        if (d->kept)
            qdot_text_add(line, "kept");
        else if (isfinite(d->drift))
            qdot_number_text_bound(line, d->drift);
        else
            qdot_text_add(line, "unknown");
    }
    if (r->n_drifts == 0)
        qdot_text_add(line, r->interrupted ? "\n  drift: not measured"
                                           : "\n  drift: no conserved quantity is known");
    append_constraints_as_text(line, r);
    qdot_text_add(line, "\n  error of the end state: ");
    if (isfinite(r->scaled_error)) {
        qdot_text_add(line, "at most ");
        qdot_number_text_bound(line, r->scaled_error);
        if (r->scales)
            qdot_text_add(line, " of max(scale, |value|)");
    } else {
        qdot_text_add(line, "unknown");
    }
    return append_end_state_as_text(session, r, line);
}

qdot_status
qdot_report_run(qdot_session *session, const char *name, const qdot_run_report *report)
{
    qdot_text line = {0};
    qdot_status status = session->output->json ? write_run_as_json(session, name, report, &line)
                                       : write_run_as_text(session, name, report, &line);

    if (status == QDOT_OK)
        return session->output->json ? qdot_write_object(session, session->output->out, &line)
                             : qdot_write(session, session->output->out, &line);
    qdot_text_clear(&line);
    return status;
}
