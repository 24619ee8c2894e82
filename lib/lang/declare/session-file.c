/* session-file.c -- writes the runs of a session, and names that hold their results, as statements. */
#include "lang/declare/session-file.h"

#include <string.h>

#include "base/number-text.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/declare/session-remarks.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/names.h"
#include "lang/session/phase.h"
#include "lang/session/runs.h"
#include "lang/session/speeds.h"
#include "lang/session/trial.h"
#include "lang/session/values.h"
#include "lang/syntax/mention.h"

/* The start values that the lines written so far would set when the file is read. */
typedef struct {
    qdot_session *s;
    qdot_text *out, *lost;
    qdot_vec(qdot_expr) symbols, values;
    bool exactly;
    bool runs; /* whether the runs are written, too */
    size_t all; /* the number of runs, including those of an earlier scene, which come last */
} writer;

static qdot_status
append_expression(qdot_session *s, const char *before, qdot_expr e, qdot_text *out)
{
    qdot_text_add(out, before);
    return qdot_print(s->pool, e, QDOT_PLAIN, out);
}

/* --- the start of a run ------------------------------------------------------------------ */

/* The value of q or q' in the start written so far; nil if none, or if it is the end of a run
 * without its error. */
static qdot_expr
get_written_start_value(const writer *w, qdot_expr jet)
{
    for (size_t i = 0; i < w->symbols.n; i++)
        if (w->symbols.at[i] == jet && w->values.at[i] != QDOT_NIL)
            return qdot_session_bind(w->s, w->values.at[i]);
    return QDOT_NIL;
}

static bool
is_start_written(const writer *w, qdot_expr jet)
{
    for (size_t i = 0; i < w->symbols.n; i++)
        if (w->symbols.at[i] == jet)
            return true;
    return false;
}

/* How the start of a run differs from the start that the lines written so far set. */
typedef enum { SAME, VALUES, NAMES } difference;

static difference
compare_start_conditions(const writer *w, const qdot_conditions *c)
{
    difference d = c->exactly == w->exactly ? SAME : NAMES;

    for (size_t i = 0; i < c->q0.n; i++)
        for (int order = 0; order < 2; order++) {
            const qdot_expr jet =
                qdot_symbol_jet(w->s->pool, w->s->scene->coordinates.at[i], (unsigned)order);
            const qdot_expr value = order == 0 ? c->q0.at[i] : c->v0.at[i];
            const bool named = order == 0 ? c->q_named.at[i] : c->v_named.at[i];
            const qdot_expr there = get_written_start_value(w, jet);

            if (named != is_start_written(w, jet) || (named && there == QDOT_NIL))
                return NAMES;
            if (named && there != value && d == SAME)
                d = VALUES;
        }
    return d;
}

/* Record the start values of a run as those set by the lines written so far. */
static qdot_status
record_written_start(writer *w, const qdot_conditions *c)
{
    w->symbols.n = w->values.n = 0;
    w->exactly = c->exactly;
    for (size_t i = 0; i < 2 * c->q0.n; i++) {
        const qdot_expr q = w->s->scene->coordinates.at[i / 2];

        if (!(i % 2 == 0 ? c->q_named.at[i / 2] : c->v_named.at[i / 2]))
            continue;
        QDOT_TRY(qdot_vec_push(&w->symbols, qdot_symbol_jet(w->s->pool, q, i % 2)));
        QDOT_TRY(qdot_vec_push(&w->values, i % 2 == 0 ? c->q0.at[i / 2] : c->v0.at[i / 2]));
    }
    return QDOT_OK;
}

/* Whether the conditions begin where run k ended: all of it; or, of a start that is wholly said, some numbers that nobody
 * types, which carry the error of that end; `anew`: only what is not written yet counts. */
static bool
starts_at_end_of_run(const writer *w, const qdot_conditions *c, size_t k, bool anew)
{
    qdot_session *s = w->s;
    const qdot_run_report *report = qdot_run_get_report(s->runs->at[k].run);
    bool all = true, some = false;

    if (report->n - report->n_states != c->q0.n || report->exact != NULL)
        return false;
    for (size_t i = 0; i < 2 * c->q0.n; i++) {
        const qdot_expr q = s->scene->coordinates.at[i / 2];
        const qdot_expr value = i % 2 == 0 ? c->q0.at[i / 2] : c->v0.at[i / 2];
        const bool alike =
            value == qdot_expr_of_double(s->pool, (i % 2 == 0 ? report->q : report->v)[i / 2]);

        if (!c->q_named.at[i / 2] || !c->v_named.at[i / 2] || report->coordinates[i / 2] != q)
            return false;
        all = all && alike;
        some = some || (alike && qdot_session_file_is_long(s, value)
                        && !(anew && get_written_start_value(w, qdot_symbol_jet(s->pool, q, i % 2)) == value));
    }
    return all || some;
}

/* Write the statements that set the start values of a run, when `before` other runs were written before it. */
static qdot_status
write_start_statements(writer *w, const qdot_conditions *c, size_t before)
{
    const qdot_run_report *end = NULL;
    size_t last = SIZE_MAX;

    for (size_t k = before; k-- > 0 && !end;)
        if (starts_at_end_of_run(w, c, k, false)) {
            end = qdot_run_get_report(w->s->runs->at[k].run);
            qdot_text_format(w->out, "start %s", w->s->runs->at[k].name);
        }
    QDOT_TRY(record_written_start(w, c));
    if (!end)
        qdot_text_add(w->out, "reset start");
    for (size_t i = 0; i < w->symbols.n; i++)
        if (!end || w->values.at[i] != qdot_expr_of_double(w->s->pool, (i % 2 == 0 ? end->q : end->v)[i / 2]))
            last = i;
    qdot_text_add(w->out, end && w->exactly && last == SIZE_MAX ? " exactly\n" : "\n");
    for (size_t i = 0; i < w->symbols.n; i++) {
        const size_t from = w->out->n;

        if (end && w->values.at[i] == qdot_expr_of_double(w->s->pool, (i % 2 == 0 ? end->q : end->v)[i / 2]))
            continue;
        QDOT_TRY(append_expression(w->s, "start ", w->symbols.at[i], w->out));
        QDOT_TRY(append_expression(w->s, " = ", w->values.at[i], w->out));
        qdot_text_add(w->out, w->exactly && i == last ? " exactly" : "");
        qdot_session_remarks_end_line(w->s, w->values.at[i], w->all, from, w->out);
    }
    return QDOT_OK;
}

/* --- writing one run --------------------------------------------------------------------- */

/* Append the options of a run's text, such as " tol 1e-9 method radau", without `with`. */
static void
append_run_options(const char *text, qdot_text *out)
{
    static const char *const kept[] = {"tol", "digits", "method", "constraints"};
    bool keeps = false;
    int depth = 0;

    while (*text != '\0') {
        const size_t n = strcspn(text, " ");

        if (depth == 0 && n == 4 && strncmp(text, "with", n) == 0)
            keeps = false;
        for (size_t i = 0; i < sizeof kept / sizeof *kept; i++)
            keeps |= depth == 0 && strlen(kept[i]) == n && strncmp(text, kept[i], n) == 0;
        if (keeps) {
            qdot_text_char(out, ' ');
            qdot_text_add_n(out, text, n);
        }
        for (size_t i = 0; i < n; i++)
            depth += (strchr("([", text[i]) != NULL) - (strchr(")]", text[i]) != NULL);
        text += n + (text[n] == ' ');
    }
}

/* The values that differ from those of the file, and are put in force for the while: those without
 * parameters first, which others may follow from. */
static qdot_status
append_with_option(writer *w, const qdot_conditions *c, bool start, qdot_text *out)
{
    qdot_session *s = w->s;
    const char *before = " with ";

    for (int follows = 0; follows < 2; follows++)
        for (size_t i = 0; i < c->symbols.n; i++) {
            const qdot_expr symbol = c->symbols.at[i];
            const qdot_expr now = qdot_session_value_set(s, symbol);
            qdot_status status = QDOT_OK;

            if (!qdot_expr_is_class(s->pool, symbol, QDOT_PARAM) ||
                (now != QDOT_NIL && qdot_session_bind(s, now) == c->values.at[i]) ||
                (follows == 0 && now != QDOT_NIL && qdot_expr_kind(s->pool, now) != QDOT_NUM))
                continue;
            QDOT_TRY(append_expression(s, before, symbol, out));
            QDOT_TRY(append_expression(s, " = ", c->values.at[i], out));
            before = ", ";
            qdot_session_set(s, symbol, c->values.at[i], &status);
            QDOT_TRY(status);
        }
    for (size_t i = 0; i < 2 * c->q0.n && start; i++) {
        const qdot_expr jet = qdot_symbol_jet(s->pool, s->scene->coordinates.at[i / 2], i % 2);
        const qdot_expr value = i % 2 == 0 ? c->q0.at[i / 2] : c->v0.at[i / 2];
        const qdot_expr there = get_written_start_value(w, jet);

        if (there == QDOT_NIL || there == value)
            continue;
        QDOT_TRY(append_expression(s, before, jet, out));
        QDOT_TRY(append_expression(s, " = ", value, out));
        before = ", ";
    }
    return QDOT_OK;
}

/* Whether the run can be repeated: it belongs to this scene, with these functions and momenta. */
static bool
is_repeatable(const qdot_session *s, const qdot_named_run *run)
{
    const qdot_conditions *c = run->conditions;

    if (c == NULL || c->version != s->scene->version || c->q0.n != s->scene->coordinates.n)
        return false;
    for (size_t i = 0; i < c->symbols.n; i++)
        if (!qdot_expr_is_class(s->pool, c->symbols.at[i], QDOT_PARAM) && qdot_session_value_set(s, c->symbols.at[i]) != c->values.at[i])
            return false;
    return true;
}

static qdot_status
write_run_statement(writer *w, size_t k)
{
    qdot_session *s = w->s;
    const qdot_named_run *run = &s->runs->at[k];
    const qdot_conditions *c = run->conditions;
    qdot_trial trial;
    qdot_status status;
    difference start;

    start = compare_start_conditions(w, c);
    if (start == NAMES)
        QDOT_TRY(write_start_statements(w, c, k));
    else if (start == VALUES)
        for (size_t i = k; i-- > 0;)
            if (starts_at_end_of_run(w, c, i, true)) {
                QDOT_TRY(write_start_statements(w, c, k));
                start = SAME;
                break;
            }
    QDOT_TRY(append_expression(s, "run ", c->t0, w->out));
    QDOT_TRY(append_expression(s, "..", c->t1, w->out));
    append_run_options(run->text, w->out);
    QDOT_TRY(qdot_trial_begin(&trial, s));
    status = append_with_option(w, c, start == VALUES, w->out);
    qdot_trial_end(&trial);
    qdot_text_format(w->out, " as %s\n", run->name);
    return status;
}

/* --- names that hold numbers of runs ------------------------------------------------------ */

/* Move run k to the end of the list, as the latest run, or back to its place. */
static void
move_run_to_end(qdot_session *s, size_t k)
{
    const qdot_named_run run = s->runs->at[k];

    memmove(&s->runs->at[k], &s->runs->at[k + 1], (s->runs->n - k - 1) * sizeof run);
    s->runs->at[s->runs->n - 1] = run;
}

static void
move_run_back(qdot_session *s, size_t k)
{
    const qdot_named_run run = s->runs->at[s->runs->n - 1];

    memmove(&s->runs->at[k + 1], &s->runs->at[k], (s->runs->n - k - 1) * sizeof run);
    s->runs->at[k] = run;
}

/* Whether the text that defined the name gives the same numbers again if run k is the latest run. */
static qdot_status
text_gives_same_numbers(qdot_session *s, const qdot_name *name, size_t k, bool *is)
{
    qdot_cursor c = {.session = s, .source = name->body->source, .at = name->body->from};
    qdot_expr read = QDOT_NIL, over;
    qdot_status status;

    move_run_to_end(s, k);
    status = qdot_read_named(&c, &read, &over);
    move_run_back(s, k);
    *is = status == QDOT_OK && c.at == name->body->to && qdot_measured_occurs(s, read) &&
          qdot_measured_as_rationals(s, read) == qdot_measured_as_rationals(s, name->value);
    (void)!qdot_pool_check(s->pool);
    return qdot_grave(status);
}

/* Find the latest run k >= first such that the name's definition, read again with run k as the latest, gives the same
 * numbers; else runs.n. */
static qdot_status
find_run_for_name(qdot_session *s, const qdot_name *name, size_t first, size_t *k)
{
    bool is = false;

    for (*k = s->runs->n; *k > first && name->body != NULL && !is;) {
        --*k;
        QDOT_TRY(text_gives_same_numbers(s, name, *k, &is));
    }
    if (!is)
        *k = s->runs->n;
    return QDOT_OK;
}

/* Write a comment such as `# B: a number of a run, 0.54 +- 3e-13`; write nothing for a scene without runs. */
static qdot_status
write_lost_name_as_comment(writer *w, const qdot_name *name)
{
    qdot_session *s = w->s;
    qdot_text *out = w->lost;
    double value, error;

    if (!w->runs)
        return qdot_answer_notice(s, "`%.200s` is not written: it holds a number of a run, and a scene "
                                     "has none; `save session` has", name->name);
    qdot_text_format(out, "# %s: a number of a run", name->name);
    if (qdot_expr_is_scalar(s->pool, name->value) &&
        qdot_session_number(s, name->value, &value, &error) == QDOT_OK) {
        qdot_text_add(out, ", ");
        qdot_number_text(out, value, error);
        qdot_text_add(out, " +- ");
        if (error == error)
            qdot_number_text_bound(out, error);
        else
            qdot_text_add(out, "unknown");
    }
    (void)!qdot_pool_check(s->pool);
    qdot_text_char(out, '\n');
    return qdot_answer_notice(s, "`%.200s` is not written: it holds a number of a run, which is not in "
                                 "the file", name->name);
}

/* A name, and the run after which it is written. */
typedef struct {
    const qdot_name *name;
    size_t behind;
} placed;

typedef qdot_vec(placed) placements;

/* The earliest run after which all names to which the text of `name` refers have been written. */
static size_t
find_earliest_run_needed(const placements *list, const qdot_name *name)
{
    size_t first = 0;

    for (size_t i = 0; i < list->n && name->body != NULL; i++)
        if (list->at[i].behind > first && qdot_mention_is_in(name->body->from, name->body->to, list->at[i].name->name))
            first = list->at[i].behind;
    return first;
}

static qdot_status
find_runs_for_names(qdot_session *s, bool runs, placements *list)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(s->names, i)) != NULL; i++) {
        placed one = {name, s->runs->n};

        if (name->kind != QDOT_NAME_VALUE || !qdot_measured_occurs(s, name->value))
            continue;
        if (runs)
            QDOT_TRY(find_run_for_name(s, name, find_earliest_run_needed(list, name), &one.behind));
        QDOT_TRY(qdot_vec_push(list, one));
    }
    return QDOT_OK;
}

static qdot_status
write_names_after_run(writer *w, const placements *list, size_t behind)
{
    for (size_t i = 0; i < list->n; i++) {
        const qdot_name *name = list->at[i].name;

        if (list->at[i].behind != behind)
            continue;
        if (behind == w->s->runs->n) {
            QDOT_TRY(write_lost_name_as_comment(w, name));
            continue;
        }
        qdot_text_format(w->out, "%s = ", name->name);
        qdot_token_text(w->s, name->body->from, name->body->to, w->out);
        qdot_text_char(w->out, '\n');
    }
    return QDOT_OK;
}

/* --- all runs and names ------------------------------------------------------------------- */

qdot_status
qdot_session_file_present_start(const qdot_session *s, qdot_conditions *c)
{
    c->exactly = s->values->start_exactly;
    for (size_t i = 0; i < 2 * s->scene->coordinates.n; i++) {
        const qdot_expr jet = qdot_symbol_jet(s->pool, s->scene->coordinates.at[i / 2], i % 2);
        const qdot_expr given = qdot_session_value_started(s, jet), value = given == QDOT_NIL ? QDOT_ZERO : given;

        if (i % 2 == 0) {
            QDOT_TRY(qdot_vec_push(&c->q0, value));
            QDOT_TRY(qdot_vec_push(&c->q_named, given != QDOT_NIL));
        } else {
            QDOT_TRY(qdot_vec_push(&c->v0, value));
            QDOT_TRY(qdot_vec_push(&c->v_named, given != QDOT_NIL));
        }
    }
    return QDOT_OK;
}

/* Forget starts written as the end of a run without its error: a run that began there with the
 * error needs them again. */
static void
forget_starts_at_run_ends(writer *w)
{
    for (size_t i = 0; i < w->values.n; i++)
        for (size_t k = 0; k < w->s->runs->n && w->values.at[i] != QDOT_NIL
                           && qdot_session_file_is_long(w->s, w->values.at[i]); k++) {
            const qdot_run_report *report = qdot_run_get_report(w->s->runs->at[k].run);

            for (size_t j = 0; j < report->n && w->values.at[i] != QDOT_NIL; j++)
                if (w->values.at[i] == qdot_expr_of_double(w->s->pool, report->q[j])
                    || w->values.at[i] == qdot_expr_of_double(w->s->pool, report->v[j]))
                    w->values.at[i] = QDOT_NIL;
        }
}

/* Write the momenta and speeds of the start, of which runs have the velocities. */
static qdot_status
write_start_momenta(const writer *w)
{
    const qdot_values *values = w->s->values;

    for (size_t i = 0; i < values->start_symbols.n; i++) {
        if (!qdot_expr_is_class(w->s->pool, values->start_symbols.at[i], QDOT_MOMENTUM) &&
            !qdot_session_is_speed(w->s, values->start_symbols.at[i]))
            continue;
        QDOT_TRY(append_expression(w->s, "start ", values->start_symbols.at[i], w->out));
        QDOT_TRY(append_expression(w->s, " = ", values->start_values.at[i], w->out));
        qdot_text_add(w->out, values->start_exactly ? " exactly\n" : "\n");
    }
    return QDOT_OK;
}

static qdot_status
write_runs_and_names(writer *w, const placements *list)
{
    qdot_session *s = w->s;
    qdot_conditions start = {0};
    qdot_status status = qdot_session_file_present_start(s, &start);

    if (status == QDOT_OK)
        status = record_written_start(w, &start);
    forget_starts_at_run_ends(w);
    for (size_t k = 0; k < s->runs->n && status == QDOT_OK; k++) {
        status = write_run_statement(w, k);
        if (status == QDOT_OK)
            status = write_names_after_run(w, list, k);
    }
    if (status == QDOT_OK && compare_start_conditions(w, &start) != SAME)
        status = write_start_statements(w, &start, s->runs->n);
    if (status == QDOT_OK && s->runs->n > 0)
        status = write_start_momenta(w);
    qdot_conditions_clear(&start);
    return status;
}

/* Move the runs that can be repeated to the front, in their order; returns their number. */
static size_t
move_repeatable_runs_first(qdot_session *s, const qdot_named_run *all)
{
    const size_t n = s->runs->n;
    size_t kept = 0, lost = 0;

    for (size_t k = 0; k < n; k++)
        kept += is_repeatable(s, &all[k]);
    for (size_t k = 0, i = 0; k < n; k++)
        if (is_repeatable(s, &all[k]))
            s->runs->at[i++] = all[k];
        else
            s->runs->at[kept + lost++] = all[k];
    return kept;
}

/* Write the runs that cannot be repeated as comments. */
static qdot_status
write_lost_runs_as_comments(qdot_session *s, size_t n, const qdot_named_run *runs, qdot_text *lost)
{
    for (size_t k = 0; k < n; k++) {
        qdot_text_format(lost, "# run %s as %s: of an earlier scene\n", runs[k].text, runs[k].name);
        QDOT_TRY(qdot_answer_notice(
            s, "the run `%.100s` is not written: it was made of an earlier scene", runs[k].name));
    }
    return QDOT_OK;
}

/* Write the runs and names of the session, considering only the runs in the list. */
static qdot_status
write_session_runs(qdot_session *s, bool runs, size_t all, qdot_text *lost, qdot_text *out)
{
    writer w = {.s = s, .out = out, .lost = lost, .runs = runs, .all = all};
    placements list = {0};
    qdot_status status = find_runs_for_names(s, runs, &list);

    if (status == QDOT_OK && runs)
        status = write_runs_and_names(&w, &list);
    if (status == QDOT_OK)
        status = write_names_after_run(&w, &list, s->runs->n);
    qdot_free(w.symbols.at);
    qdot_free(w.values.at);
    qdot_free(list.at);
    return status;
}

static qdot_status
write_runs_in_order(qdot_session *s, bool runs, qdot_text *lost, qdot_text *out)
{
    const size_t n = s->runs->n;
    qdot_named_run *all = qdot_malloc((n + 1) * sizeof *all);
    qdot_status status;

    if (all == NULL)
        return QDOT_ENOMEM;
    if (n > 0)
        memcpy(all, s->runs->at, n * sizeof *all);
    s->runs->n = move_repeatable_runs_first(s, all);
    status = write_session_runs(s, runs, n, lost, out);
    if (status == QDOT_OK && runs)
        status = write_lost_runs_as_comments(s, n - s->runs->n, s->runs->at + s->runs->n, lost);
    s->runs->n = n;
    if (n > 0)
        memcpy(s->runs->at, all, n * sizeof *all);
    qdot_free(all);
    return status;
}

qdot_status
qdot_session_file_runs(qdot_session *s, bool runs, qdot_text *lost, qdot_text *out)
{
    qdot_status status = qdot_phase_begin(s, false);

    if (status == QDOT_OK)
        status = write_runs_in_order(s, runs, lost, out);
    qdot_phase_end(s);
    return status;
}
