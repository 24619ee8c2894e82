/* report.c -- prints the report of a run, as text or as JSON. */
#include "lang/answer/report.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/number-text.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "formula/write.h"
#include "lang/answer/digits.h"
#include "lang/answer/shown-text.h"
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

/* The forms in which the numbers of an end state are written: for programs; with the digits that the error leaves; and
 * with the error behind it. */
typedef enum { FORM_JSON, FORM_DIGITS, FORM_ERROR } number_form;

/* Append number i of the end state with as many digits as are known, in quotes for JSON. *error: its absolute error,
 * raised to that of the digits. */
static qdot_status
append_exact_number(qdot_session *session, const qdot_run_report *r, size_t i, number_form form, double *error,
                    qdot_text *number)
{
    qdot_text digits = {0};
    const qdot_status status = qdot_digits_number(session, r->exact[i], r->digits, error, &digits);

    qdot_text_format(number, form == FORM_JSON ? "\"%s\"" : "%s", qdot_text_str(&digits));
    qdot_text_clear(&digits);
    return status;
}

/* Append a number whose absolute error is `error`, NaN where that is unknown. */
static void
append_double(double value, double error, number_form form, qdot_text *number)
{
    if (form == FORM_JSON)
        qdot_number_text_json(number, value);
    else if (!isfinite(value))
        qdot_text_add(number, "unknown"); /* undetermined: the multiplier of a constraint whose gradient vanishes */
    else
        qdot_number_text(number, value, error);
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

/* Append a number of the end state. */
static qdot_status
append_end_number(qdot_session *session, const qdot_run_report *report, const end_number *x, number_form form,
                  qdot_text *number)
{
    const bool exact = report->exact != NULL && report->exact[x->exact] != QDOT_NIL;
    double error = x->error * x->size;

    if (exact)
        QDOT_TRY(append_exact_number(session, report, x->exact, form, &error, number));
    else
        append_double(x->value, error = isfinite(x->error) ? fmax(x->error, 2e-16) * x->size : NAN, form, number);
    if (form == FORM_ERROR && isfinite(x->value) && error > 0)
        qdot_number_text_error(number, error);
    return qdot_text_status(number);
}

/* Call `each` for every number of the end state. */
static qdot_status
for_each_end_number(qdot_session *session, const qdot_run_report *report, qdot_style style, number_form form,
                    void (*each)(qdot_text *line, size_t k, bool first, const char *name, const char *number),
                    qdot_text *line)
{
    const size_t numbers = 2 * report->n - report->n_states + report->m;

    for (size_t k = 0; k < numbers; k++) {
        const end_number x = get_end_number(session, report, k);
        qdot_text name = {0}, number = {0};
        qdot_status status = qdot_pool_check(session->pool);

        if (status == QDOT_OK)
            status = qdot_print(session->pool, x.symbol, style, &name);
        if (status == QDOT_OK)
            status = append_end_number(session, report, &x, form, &number);
        if (status == QDOT_OK)
            each(line, k, x.first, qdot_text_str(&name), qdot_text_str(&number));
        qdot_text_clear(&name);
        qdot_text_clear(&number);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

/* --- the report in words ------------------------------------------------------------------ */

/* What the report says of one thing; `told`: also in lines the head stands before the words, with a colon. */
typedef struct {
    const char *head;
    bool told;
    qdot_text words;
} fact;

enum { MOST_FACTS = 10 };

/* The report, of which lines of text and a table of HTML are made. */
typedef struct {
    qdot_text title;
    fact facts[MOST_FACTS];
    size_t n;
} run_words;

static void
clear_run_words(run_words *w)
{
    qdot_text_clear(&w->title);
    for (size_t i = 0; i < w->n; i++)
        qdot_text_clear(&w->facts[i].words);
}

/* Begin the next fact; returns its words, to be appended. */
static qdot_text *
begin_fact(run_words *w, const char *head, bool told)
{
    w->facts[w->n] = (fact){.head = head, .told = told};
    return &w->facts[w->n++].words;
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

static void
add_name(qdot_session *session, const char *name, qdot_text *words)
{
    if (strcmp(name, "energy") == 0)
        qdot_text_add(words, name);
    else
        qdot_print_name(session->pool, name, session->output->style, words);
}

static void
add_run_title(const char *name, const qdot_run_report *r, qdot_text *title)
{
    qdot_text_format(title, "%s: t = ", name);
    qdot_number_text(title, r->t0, 0);
    qdot_text_add(title, "..");
    qdot_number_text(title, r->t1, 0);
    qdot_text_format(title, ", method %s, ", r->method);
    if (r->digits > 0) {
        qdot_text_format(title, "digits %d, tol ", r->digits);
        qdot_number_text_bound(title, r->tol);
    } else {
        qdot_text_add(title, "tol ");
        qdot_number_text(title, r->tol, 0);
    }
    qdot_text_format(title, ", %s", word_for_run_status(r->status));
    if (r->reason != NULL)
        qdot_text_format(title, ": %s", r->reason);
}

/* Tell the work: steps and evaluations, and the time that they took. */
static void
add_work(const qdot_run_report *r, run_words *w)
{
    qdot_text *words = begin_fact(w, "work", false);

    add_count(words, r->steps, "step");
    qdot_text_format(words, ", %" PRIu64 " rejected; ", r->rejected);
    add_count(words, r->evals, "evaluation");
    qdot_text_add(words, " of ");
    add_count(words, r->operations, "operation");
    if (r->jacobians > 0) {
        qdot_text_add(words, "; ");
        add_count(words, r->jacobians, "Jacobian");
    }
    if (r->n_parts > 0)
        words = begin_fact(w, "apart", true);
    for (size_t i = 0; i < r->n_parts; i++) {
        qdot_text_format(words, "%s%s ", i == 0 ? "" : "; ", r->parts[i].coordinates);
        add_count(words, r->parts[i].steps, "step");
    }
    words = begin_fact(w, "time", false);
    qdot_text_add(words, "cpu ");
    add_seconds(words, r->cpu);
    qdot_text_add(words, ", total cpu ");
    add_seconds(words, r->cpu_total);
}

/* Tell how much the conserved quantities drifted. */
static void
add_drifts(qdot_session *session, const qdot_run_report *r, run_words *w)
{
    qdot_text *words = begin_fact(w, "drift", true);

    for (size_t i = 0; i < r->n_drifts; i++) {
        const qdot_drift *d = &r->drifts[i];

        qdot_text_add(words, i == 0 ? "" : ", ");
        add_name(session, d->name, words);
        qdot_text_char(words, ' ');
        if (d->kept)
            qdot_text_add(words, "kept");
        else if (isfinite(d->drift))
            qdot_number_text_bound(words, d->drift);
        else
            qdot_text_add(words, "unknown");
    }
    if (r->n_drifts == 0)
        qdot_text_add(words, r->interrupted ? "not measured" : "no conserved quantity is known");
}

/* Tell how far the state drifted off the constraints, and the method that kept it on them. */
static void
add_constraints(const qdot_run_report *r, run_words *w)
{
    static const char *const done[] = {
        [QDOT_RUN_PROJECT] = "projected after",
        [QDOT_RUN_BAUMGARTE] = "damped (Baumgarte)",
        [QDOT_RUN_NONE] = "drift left alone",
    };
    qdot_text *words;

    if (r->m == 0)
        return;
    words = begin_fact(w, "constraints", true);
    if (isfinite(r->constraint_drift)) {
        qdot_text_add(words, "error ");
        qdot_number_text_bound(words, r->constraint_drift);
        if (isfinite(r->velocity_drift) && r->velocity_drift != r->constraint_drift) {
            qdot_text_add(words, ", of velocities ");
            qdot_number_text_bound(words, r->velocity_drift);
        }
        qdot_text_add(words, "; ");
    }
    qdot_text_add(words, r->digits > 0 ? "covered by guard digits" : done[r->treatment]);
    if (r->treatment == QDOT_RUN_PROJECT && r->digits == 0) {
        qdot_text_char(words, ' ');
        add_count(words, r->projections, "step");
    }
    if (r->independent < r->m)
        qdot_text_format(begin_fact(w, "", false),
                         "%zu of the %zu constraints are independent: the motion is "
                         "unique, the multipliers are those of least norm",
                         r->independent, r->m);
}

static void
add_error(const qdot_run_report *r, run_words *w)
{
    qdot_text *words = begin_fact(w, "error of the end state", true);

    if (!isfinite(r->scaled_error)) {
        qdot_text_add(words, "unknown");
        return;
    }
    qdot_text_add(words, "at most ");
    qdot_number_text_bound(words, r->scaled_error);
    if (r->scales)
        qdot_text_add(words, " of max(scale, |value|)");
}

/* A quantity counts as conserved if its drift is below this. */
static const double drifts_little = 1e-3;

/* Only for a tolerance above this a hint says that a smaller one would give correct digits for longer. */
static const double of_method = 1e-11;

/* Tell the time from which on the state is dominated by error, and which quantities are still accurate after it. */
static void
add_horizon(qdot_session *session, const qdot_run_report *r, run_words *w)
{
    qdot_text *words = begin_fact(w, "horizon", true);
    bool some = false;

    qdot_text_add(words, "t = ");
    qdot_number_text(words, r->horizon, 0.005 * fabs(r->horizon));
    qdot_text_add(words, r->tol > of_method ? "; no digit of the state beyond it is right under this tol"
                                            : ", where doubles are exhausted: no digit of the state "
                                              "beyond it is right; `digits 6` goes further");
    words = begin_fact(w, "", false);
    qdot_text_add(words, "beyond it ");
    for (size_t i = 0; i < r->n_drifts; i++) {
        const qdot_drift *d = &r->drifts[i];

        if (d->changed || (!d->kept && !(d->drift < drifts_little)))
            continue;
        qdot_text_add(words, some ? ", " : "what is conserved holds (");
        add_name(session, d->name, words);
        some = true;
    }
    qdot_text_add(words, some ? "); " : "");
    if (isfinite(r->standstill)) {
        qdot_text_add(words, "about t = ");
        qdot_number_text(words, r->standstill, 0.005 * fabs(r->standstill));
        qdot_text_add(words, " the motion nearly comes to rest, and the side to which it leaves that "
                             "place is undecided");
    } else {
        qdot_text_add(words, "the states are a sample of what neighbouring motions do: means over "
                             "long times describe these");
    }
}

static qdot_status
write_run_words(qdot_session *session, const char *name, const qdot_run_report *r, run_words *w)
{
    add_run_title(name, r, &w->title);
    add_work(r, w);
    add_drifts(session, r, w);
    add_constraints(r, w);
    add_error(r, w);
    if (!isnan(r->horizon))
        add_horizon(session, r, w);
    for (size_t i = 0; i < w->n; i++)
        QDOT_TRY(qdot_text_status(&w->facts[i].words));
    return qdot_text_status(&w->title);
}

/* --- the words in lines -------------------------------------------------------------------- */

static void
append_end_number_as_text(qdot_text *line, size_t k, bool first, const char *name, const char *number)
{
    (void)k;
    qdot_text_add(line, first ? "\n    " : ", ");
    qdot_text_add(line, name);
    qdot_text_add(line, " = ");
    qdot_text_add(line, number);
}

static qdot_status
append_run_as_text(qdot_session *session, const run_words *w, const qdot_run_report *r, qdot_text *line)
{
    qdot_text_add(line, qdot_text_str(&w->title));
    for (size_t i = 0; i < w->n; i++) {
        qdot_text_format(line, "\n  %s%s", w->facts[i].told ? w->facts[i].head : "", w->facts[i].told ? ": " : "");
        qdot_text_add(line, qdot_text_str(&w->facts[i].words));
    }
    if (isnan(r->horizon)) {
        qdot_text_add(line, "\n  end state:");
        QDOT_TRY(for_each_end_number(session, r, session->output->style, FORM_DIGITS, append_end_number_as_text, line));
    }
    qdot_text_char(line, '\n');
    return QDOT_OK;
}

static qdot_status
write_run_as_text(qdot_session *session, const char *name, const qdot_run_report *r, qdot_text *line)
{
    run_words w = {0};
    qdot_status status = write_run_words(session, name, r, &w);

    if (status == QDOT_OK)
        status = append_run_as_text(session, &w, r, line);
    clear_run_words(&w);
    return status;
}

/* --- the words in a table of HTML ------------------------------------------------------------ */

static void
append_html(qdot_text *line, const char *tag, const char *text)
{
    qdot_text_format(line, "<%s>", tag);
    qdot_text_html(line, text, strlen(text), false);
    qdot_text_format(line, "</%s>", tag);
}

static void
append_end_number_as_html(qdot_text *line, size_t k, bool first, const char *name, const char *number)
{
    (void)k;
    (void)first;
    qdot_text_format(line, "<tr><th>%s%s%s</th>", QDOT_FORMULA_MATH, name, QDOT_FORMULA_MATH_END);
    append_html(line, "td", number);
    qdot_text_add(line, "</tr>\n");
}

/* Append the report as a table: the end state, then what is to be known of the run. */
static qdot_status
append_run_as_html(qdot_session *session, const run_words *w, const qdot_run_report *r, qdot_text *html)
{
    qdot_text_add(html, "<table class=\"run\">\n");
    append_html(html, "caption", qdot_text_str(&w->title));
    qdot_text_char(html, '\n');
    if (isnan(r->horizon))
        QDOT_TRY(for_each_end_number(session, r, QDOT_MATHML, FORM_ERROR, append_end_number_as_html, html));
    for (size_t i = 0; i < w->n; i++) {
        qdot_text_add(html, "<tr>");
        append_html(html, "th", w->facts[i].head);
        append_html(html, "td", qdot_text_str(&w->facts[i].words));
        qdot_text_add(html, "</tr>\n");
    }
    qdot_text_add(html, "</table>\n");
    return qdot_text_status(html);
}

/* Append what a person reads of the run to its object. */
static qdot_status
append_shown_run(qdot_session *session, const char *name, const qdot_run_report *r, qdot_text *object)
{
    qdot_text text = {0}, html = {0};
    run_words w = {0};
    qdot_status status = write_run_words(session, name, r, &w);

    if (status == QDOT_OK)
        status = append_run_as_text(session, &w, r, &text);
    if (status == QDOT_OK)
        status = append_run_as_html(session, &w, r, &html);
    qdot_shown_fields(qdot_text_str(&text), qdot_text_str(&html), object);
    object->failed = object->failed || text.failed || html.failed;
    clear_run_words(&w);
    qdot_text_clear(&text);
    qdot_text_clear(&html);
    return status;
}

/* --- the report as JSON ---------------------------------------------------------------------- */

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
    QDOT_TRY(for_each_end_number(session, r, QDOT_PLAIN, FORM_JSON, append_end_number_as_json, line));
    qdot_text_format(line, "},\"status\":\"%s\",\"reason\":", word_for_run_status(r->status));
    if (r->reason != NULL)
        qdot_text_json(line, r->reason);
    else
        qdot_text_add(line, "null");
    if (r->n_parts > 0)
        append_groups_as_json(line, r);
    if (r->m > 0)
        QDOT_TRY(append_constraints_as_json(session, r, line));
    if (qdot_write_displays(session))
        QDOT_TRY(append_shown_run(session, name, r, line));
    qdot_text_add(line, "}\n");
    return QDOT_OK;
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
