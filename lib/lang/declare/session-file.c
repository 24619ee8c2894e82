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
#include "lang/session/runs.h"
#include "lang/session/trial.h"
#include "lang/session/values.h"
#include "lang/syntax/mention.h"

/* The start that the lines written so far would give when they are read. */
typedef struct {
    qdot_session *s;
    qdot_text *out, *lost;
    qdot_vec(qdot_expr) symbols, values;
    bool exactly;
    bool runs; /* runs are written, too */
    size_t all; /* the number of runs, including those of an earlier scene, which come last */
} writer;

static qdot_status
put(qdot_session *s, const char *before, qdot_expr e, qdot_text *out)
{
    qdot_text_add(out, before);
    return qdot_print(s->pool, e, QDOT_PLAIN, out);
}

/* --- the start of a run ------------------------------------------------------------------ */

/* The value of q or q' in the start written so far; nil if none, or if it is the end of a run
 * without its error. */
static qdot_expr
start_value_so_far(const writer *w, qdot_expr jet)
{
    for (size_t i = 0; i < w->symbols.n; i++)
        if (w->symbols.at[i] == jet && w->values.at[i] != QDOT_NIL)
            return qdot_session_bind(w->s, w->values.at[i]);
    return QDOT_NIL;
}

static bool
is_written(const writer *w, qdot_expr jet)
{
    for (size_t i = 0; i < w->symbols.n; i++)
        if (w->symbols.at[i] == jet)
            return true;
    return false;
}

/* How a run's start differs from the one written so far. */
typedef enum { SAME, VALUES, NAMES } difference;

static difference
conditions_compare(const writer *w, const qdot_conditions *c)
{
    difference d = c->exactly == w->exactly ? SAME : NAMES;

    for (size_t i = 0; i < c->q0.n; i++)
        for (int order = 0; order < 2; order++) {
            const qdot_expr jet =
                qdot_symbol_jet(w->s->pool, w->s->scene->coordinates.at[i], (unsigned)order);
            const qdot_expr value = order == 0 ? c->q0.at[i] : c->v0.at[i];
            const bool named = order == 0 ? c->q_named.at[i] : c->v_named.at[i];
            const qdot_expr there = start_value_so_far(w, jet);

            if (named != is_written(w, jet) || (named && there == QDOT_NIL))
                return NAMES;
            if (named && there != value && d == SAME)
                d = VALUES;
        }
    return d;
}

/* Record the conditions of a run as the start written so far. */
static qdot_status
keep_start(writer *w, const qdot_conditions *c)
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
goes_on(const writer *w, const qdot_conditions *c, size_t k, bool anew)
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
                        && !(anew && start_value_so_far(w, qdot_symbol_jet(s->pool, q, i % 2)) == value));
    }
    return all || some;
}

/* Write statements that give the start of these conditions, before a run, after `before` other runs. */
static qdot_status
session_put_start(writer *w, const qdot_conditions *c, size_t before)
{
    const qdot_run_report *end = NULL;
    size_t last = SIZE_MAX;

    for (size_t k = before; k-- > 0 && !end;)
        if (goes_on(w, c, k, false)) {
            end = qdot_run_get_report(w->s->runs->at[k].run);
            qdot_text_format(w->out, "start %s", w->s->runs->at[k].name);
        }
    QDOT_TRY(keep_start(w, c));
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
        QDOT_TRY(put(w->s, "start ", w->symbols.at[i], w->out));
        QDOT_TRY(put(w->s, " = ", w->values.at[i], w->out));
        qdot_text_add(w->out, w->exactly && i == last ? " exactly" : "");
        qdot_session_remarks_end_line(w->s, w->values.at[i], w->all, from, w->out);
    }
    return QDOT_OK;
}

/* --- writing one run --------------------------------------------------------------------- */

/* Append the options of a run's text, such as " tol 1e-9 method radau", without `with`. */
static void
put_options(const char *text, qdot_text *out)
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
put_with(writer *w, const qdot_conditions *c, bool start, qdot_text *out)
{
    qdot_session *s = w->s;
    const char *before = " with ";

    for (int follows = 0; follows < 2; follows++)
        for (size_t i = 0; i < c->symbols.n; i++) {
            const qdot_expr symbol = c->symbols.at[i];
            qdot_expr now = QDOT_NIL;
            qdot_status status = QDOT_OK;

            for (size_t k = 0; k < s->values->set_symbols.n; k++)
                if (s->values->set_symbols.at[k] == symbol)
                    now = s->values->set_values.at[k];
            if (!qdot_expr_is_class(s->pool, symbol, QDOT_PARAM) ||
                (now != QDOT_NIL && qdot_session_bind(s, now) == c->values.at[i]) ||
                (follows == 0 && now != QDOT_NIL && qdot_expr_kind(s->pool, now) != QDOT_NUM))
                continue;
            QDOT_TRY(put(s, before, symbol, out));
            QDOT_TRY(put(s, " = ", c->values.at[i], out));
            before = ", ";
            qdot_session_set(s, symbol, c->values.at[i], &status);
            QDOT_TRY(status);
        }
    for (size_t i = 0; i < 2 * c->q0.n && start; i++) {
        const qdot_expr jet = qdot_symbol_jet(s->pool, s->scene->coordinates.at[i / 2], i % 2);
        const qdot_expr value = i % 2 == 0 ? c->q0.at[i / 2] : c->v0.at[i / 2];
        const qdot_expr there = start_value_so_far(w, jet);

        if (there == QDOT_NIL || there == value)
            continue;
        QDOT_TRY(put(s, before, jet, out));
        QDOT_TRY(put(s, " = ", value, out));
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
    for (size_t i = 0; i < c->symbols.n; i++) {
        bool same = qdot_expr_is_class(s->pool, c->symbols.at[i], QDOT_PARAM);

        for (size_t k = 0; k < s->values->set_symbols.n && !same; k++)
            same = s->values->set_symbols.at[k] == c->symbols.at[i] && s->values->set_values.at[k] == c->values.at[i];
        if (!same)
            return false;
    }
    return true;
}

static qdot_status
put_run(writer *w, size_t k)
{
    qdot_session *s = w->s;
    const qdot_named_run *run = &s->runs->at[k];
    const qdot_conditions *c = run->conditions;
    qdot_trial trial;
    qdot_status status;
    difference start;

    start = conditions_compare(w, c);
    if (start == NAMES)
        QDOT_TRY(session_put_start(w, c, k));
    else if (start == VALUES)
        for (size_t i = k; i-- > 0;)
            if (goes_on(w, c, i, true)) {
                QDOT_TRY(session_put_start(w, c, k));
                start = SAME;
                break;
            }
    QDOT_TRY(put(s, "run ", c->t0, w->out));
    QDOT_TRY(put(s, "..", c->t1, w->out));
    put_options(run->text, w->out);
    QDOT_TRY(qdot_trial_begin(&trial, s));
    status = put_with(w, c, start == VALUES, w->out);
    qdot_trial_end(&trial);
    qdot_text_format(w->out, " as %s\n", run->name);
    return status;
}

/* --- names that hold numbers of runs ------------------------------------------------------ */

/* Move run k to the end of the list, as the latest run, or back to its place. */
static void
make_latest(qdot_session *s, size_t k)
{
    const qdot_named_run run = s->runs->at[k];

    memmove(&s->runs->at[k], &s->runs->at[k + 1], (s->runs->n - k - 1) * sizeof run);
    s->runs->at[s->runs->n - 1] = run;
}

static void
put_back(qdot_session *s, size_t k)
{
    const qdot_named_run run = s->runs->at[s->runs->n - 1];

    memmove(&s->runs->at[k + 1], &s->runs->at[k], (s->runs->n - k - 1) * sizeof run);
    s->runs->at[k] = run;
}

/* Whether the text with which the name was defined gives its numbers again if run k is the latest. */
static qdot_status
reads_numbers(qdot_session *s, const qdot_name *name, size_t k, bool *is)
{
    qdot_cursor c = {.session = s, .source = name->body->source, .at = name->body->from};
    qdot_expr read = QDOT_NIL, over;
    qdot_status status;

    make_latest(s, k);
    status = qdot_read_named(&c, &read, &over);
    put_back(s, k);
    *is = status == QDOT_OK && c.at == name->body->to && qdot_measured_occurs(s, read) &&
          qdot_measured_as_rationals(s, read) == qdot_measured_as_rationals(s, name->value);
    (void)!qdot_pool_check(s->pool);
    return qdot_grave(status);
}

/* Find the latest run, from number `first` on, after which the name's text gives its value; runs.n if none. */
static qdot_status
find_run(qdot_session *s, const qdot_name *name, size_t first, size_t *k)
{
    bool is = false;

    for (*k = s->runs->n; *k > first && name->body != NULL && !is;) {
        --*k;
        QDOT_TRY(reads_numbers(s, name, *k, &is));
    }
    if (!is)
        *k = s->runs->n;
    return QDOT_OK;
}

/* Write `# B: a number of a run, 0.54 +- 3e-13` as a comment; nothing for a scene without runs. */
static qdot_status
put_lost(writer *w, const qdot_name *name)
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

/* The earliest run after which all names are written that the text of `name` mentions. */
static size_t
earliest_run_needed(const placements *list, const qdot_name *name)
{
    size_t first = 0;

    for (size_t i = 0; i < list->n && name->body != NULL; i++)
        if (list->at[i].behind > first && qdot_mention_is_in(name->body->from, name->body->to, list->at[i].name->name))
            first = list->at[i].behind;
    return first;
}

static qdot_status
place_names(qdot_session *s, bool runs, placements *list)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(s->names, i)) != NULL; i++) {
        placed one = {name, s->runs->n};

        if (name->kind != QDOT_NAME_VALUE || !qdot_measured_occurs(s, name->value))
            continue;
        if (runs)
            QDOT_TRY(find_run(s, name, earliest_run_needed(list, name), &one.behind));
        QDOT_TRY(qdot_vec_push(list, one));
    }
    return QDOT_OK;
}

static qdot_status
put_names(writer *w, const placements *list, size_t behind)
{
    for (size_t i = 0; i < list->n; i++) {
        const qdot_name *name = list->at[i].name;

        if (list->at[i].behind != behind)
            continue;
        if (behind == w->s->runs->n) {
            QDOT_TRY(put_lost(w, name));
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
        qdot_expr value = QDOT_ZERO;
        bool named = false;

        for (size_t k = 0; k < s->values->start_symbols.n; k++)
            if (s->values->start_symbols.at[k] == jet) {
                value = s->values->start_values.at[k];
                named = true;
            }
        if (i % 2 == 0) {
            QDOT_TRY(qdot_vec_push(&c->q0, value));
            QDOT_TRY(qdot_vec_push(&c->q_named, named));
        } else {
            QDOT_TRY(qdot_vec_push(&c->v0, value));
            QDOT_TRY(qdot_vec_push(&c->v_named, named));
        }
    }
    return QDOT_OK;
}

/* Forget starts written as the end of a run without its error: a run that began there with the
 * error needs them again. */
static void
forget_ends(writer *w)
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

static qdot_status
session_put_all(writer *w, const placements *list)
{
    qdot_session *s = w->s;
    qdot_conditions start = {0};
    qdot_status status = qdot_session_file_present_start(s, &start);

    if (status == QDOT_OK)
        status = keep_start(w, &start);
    forget_ends(w);
    for (size_t k = 0; k < s->runs->n && status == QDOT_OK; k++) {
        status = put_run(w, k);
        if (status == QDOT_OK)
            status = put_names(w, list, k);
    }
    if (status == QDOT_OK && conditions_compare(w, &start) != SAME)
        status = session_put_start(w, &start, s->runs->n);
    qdot_conditions_clear(&start);
    return status;
}

/* Move the runs that can be repeated to the front, in their order; returns their number. */
static size_t
sort_out(qdot_session *s, const qdot_named_run *all)
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
put_lost_runs(qdot_session *s, size_t n, const qdot_named_run *runs, qdot_text *lost)
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
put_runs_and_names(qdot_session *s, bool runs, size_t all, qdot_text *lost, qdot_text *out)
{
    writer w = {.s = s, .out = out, .lost = lost, .runs = runs, .all = all};
    placements list = {0};
    qdot_status status = place_names(s, runs, &list);

    if (status == QDOT_OK && runs)
        status = session_put_all(&w, &list);
    if (status == QDOT_OK)
        status = put_names(&w, &list, s->runs->n);
    qdot_free(w.symbols.at);
    qdot_free(w.values.at);
    qdot_free(list.at);
    return status;
}

qdot_status
qdot_session_file_runs(qdot_session *s, bool runs, qdot_text *lost, qdot_text *out)
{
    const size_t n = s->runs->n;
    qdot_named_run *all = qdot_malloc((n + 1) * sizeof *all);
    qdot_status status;

    if (all == NULL)
        return QDOT_ENOMEM;
    if (n > 0)
        memcpy(all, s->runs->at, n * sizeof *all);
    s->runs->n = sort_out(s, all);
    status = put_runs_and_names(s, runs, n, lost, out);
    if (status == QDOT_OK && runs)
        status = put_lost_runs(s, n - s->runs->n, s->runs->at + s->runs->n, lost);
    s->runs->n = n;
    if (n > 0)
        memcpy(s->runs->at, all, n * sizeof *all);
    qdot_free(all);
    return status;
}
