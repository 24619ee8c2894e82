/* poincare.c -- the statement `poincare`: the Poincaré section of a run, or of the runs of a sweep. */
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/node.h"
#include "lang/answer/answer.h"
#include "lang/answer/row-answer.h"
#include "lang/language/outdated.h"
#include "lang/runs/run.h"
#include "lang/session/measured.h"
#include "lang/session/momenta.h"
#include "lang/session/output.h"
#include "lang/session/row-tables.h"
#include "lang/session/runs.h"
#include "lang/session/trial.h"
#include "lang/sweeps/columns.h"
#include "lang/sweeps/members.h"
#include "lang/syntax/match.h"
#include "lang/syntax/record.h"
#include "lang/syntax/statement.h"
#include "sim/read/section.h"

static qdot_status carry_out_poincare(qdot_record *r);

QDOT_STATEMENT(poincare) = {
    .word = "poincare",
    .group = QDOT_NUMBERS,
    .usage = "poincare A = B [rising|falling] [of SWEEP | run T0..T1 " QDOT_RUN_USAGE " [as NAME]] : EXPR, ... "
             "[from A to B] [of SWEEP | run T0..T1 " QDOT_RUN_USAGE "] [as NAME]",
    .summary = "a section: the values of the expressions each time A = B is crossed in the latest run, in a run made "
               "for it, or in the runs of a sweep, made again; `plot poincare`, `table poincare`, `save poincare "
               "to` show it",
    .example = "poincare theta = 0 rising : theta2, theta2'",
    .handler = carry_out_poincare,
};

typedef struct {
    qdot_expr g; /* left minus right side of the equation of the surface of section */
    int way;
    qdot_columns columns;
    const qdot_token *run_at; /* the word `run`; NULL: not given */
    qdot_run_options run;
    bool limited;
    double limits[2]; /* limits of time, if `limited` */
    const qdot_row_table *sweep; /* the sweep whose runs are used; NULL: one run */
    const char *name;
    qdot_record swept;    /* the statement of that sweep */
    qdot_members members; /* the members of that sweep */
    qdot_row_table *table;
    size_t beyond;    /* number of points later than the time up to which their run is accurate */
    size_t failed;
    size_t n_lost; /* number of runs in which crossings are unknown after some time */
    double lost;   /* the latest such time */
} poincare;

/* --- the operands of the section -------------------------------------------------------- */

static qdot_status
read_surface(qdot_record *r, poincare *p)
{
    const qdot_filled *part = qdot_record_hole(r, "poincare", "A");
    qdot_session *session = r->cursor.session;
    qdot_expr left, right;

    QDOT_TRY(qdot_record_equation(r, part, true, &left, &right));
    if (!qdot_expr_is_scalar(session->pool, left) || !qdot_expr_is_scalar(session->pool, right)) {
        qdot_record_blame(r, part);
        return qdot_fail(QDOT_ETYPE, "a section is where two numbers become equal");
    }
    p->g = qdot_momenta_to_velocities(
        session, qdot_measured_as_rationals(session, qdot_sub(session->pool, left, right)));
    p->way = qdot_record_word(r, "rising") != NULL ? 1 : qdot_record_word(r, "falling") != NULL ? -1 : 0;
    return qdot_pool_check(session->pool);
}

/* Read `of NAME`: the sweep whose runs are used. */
static qdot_status
read_sweep_name(qdot_record *r, const qdot_filled *part, poincare *p)
{
    const char *name;

    QDOT_TRY(qdot_record_name(r, part, &name));
    p->sweep = qdot_row_tables_find(r->cursor.session, name);
    if (p->sweep != NULL && p->sweep->members != NULL)
        return QDOT_OK;
    qdot_record_blame(r, part);
    (void)qdot_fail(QDOT_ENAME, "there is no sweep `%s`", name);
    return qdot_hint("sweep omega = 0..5 step 0.1 run 0..20 : max(theta) as %s", name);
}

/* The end of the options of a run in the statement: the colon, a word of the section, or the statement's end. */
static const qdot_filled *
find_end_of_run_options(const qdot_record *r, const qdot_filled *run, bool behind)
{
    const qdot_filled *part = run + 1, *end = r->parts.at + r->parts.n;

    while (part < end && !qdot_filled_is(part, ":") &&
           !(behind && (qdot_filled_is(part, "from") || qdot_filled_is(part, "as"))))
        part++;
    return part;
}

/* Find the run, or the sweep, of which the section is made, if it is given before the colon or after the columns. */
static qdot_status
find_run_or_sweep(qdot_record *r, poincare *p)
{
    bool behind = false;

    for (const qdot_filled *part = r->parts.at; part < r->parts.at + r->parts.n; part++) {
        behind = behind || qdot_filled_is(part, ":");
        if (part->node->kind != QDOT_USAGE_WORD || (!qdot_filled_is(part, "of") && !qdot_filled_is(part, "run")))
            continue;
        if (p->run_at != NULL || p->sweep != NULL) {
            qdot_record_blame(r, part);
            return qdot_fail(QDOT_EINVAL, "`%s` is given twice", part->node->text);
        }
        if (qdot_filled_is(part, "of")) {
            QDOT_TRY(read_sweep_name(r, part + 1, p));
            continue;
        }
        p->run_at = part->from;
        QDOT_TRY(qdot_run_options_find(r, part + 1, find_end_of_run_options(r, part, behind), &p->run));
    }
    return QDOT_OK;
}

/* Read the time limits `from A to B` of the section. */
static qdot_status
read_time_limits(qdot_record *r, poincare *p)
{
    const qdot_filled *from = qdot_record_hole(r, "from", "A");

    p->limited = from != NULL;
    if (from == NULL)
        return QDOT_OK;
    QDOT_TRY(qdot_record_number(r, from, &p->limits[0]));
    return qdot_record_number(r, qdot_record_next(r, from, "B"), &p->limits[1]);
}

/* Read `as NAME`, the name of the section, after its columns. */
static qdot_status
read_section_name(qdot_record *r, poincare *p)
{
    const qdot_filled *part = qdot_record_next(r, qdot_record_hole(r, NULL, "EXPR"), "NAME");

    while (part != NULL && strcmp(part->node->before, "as") != 0)
        part = qdot_record_next(r, part, "NAME");
    return part != NULL ? qdot_record_new_name(r, part, &p->name) : QDOT_OK;
}

static qdot_status
read_all_options(qdot_record *r, poincare *p)
{
    QDOT_TRY(read_surface(r, p));
    QDOT_TRY(find_run_or_sweep(r, p));
    QDOT_TRY(qdot_columns_find(r, &p->columns));
    QDOT_TRY(read_time_limits(r, p));
    return read_section_name(r, p);
}

/* --- points of the section -------------------------------------------------------------- */

/* Append a row for each point of the section: the swept values [n_swept - 1], the time, the columns. */
static qdot_status
add_points(poincare *p, const qdot_run *run, const double *swept, const qdot_section *s)
{
    const qdot_run_report *report = qdot_run_get_report(run);
    qdot_row_table *t = p->table;
    const size_t before = t->n_swept - 1;

    for (size_t k = 0; k < s->n; k++) {
        double *values, *errors;
        bool whole = true;

        QDOT_TRY(qdot_row_table_add(t));
        values = t->values + (t->rows - 1) * t->n;
        errors = t->errors + (t->rows - 1) * t->n;
        for (size_t i = 0; i < before; i++) {
            values[i] = swept[i];
            errors[i] = 0;
        }
        values[before] = s->t[k];
        errors[before] = s->t_errors[k];
        for (size_t j = 0; j < s->m; j++) {
            values[before + 1 + j] = s->values[k * s->m + j];
            errors[before + 1 + j] = s->errors[k * s->m + j];
            whole = whole && !isnan(s->values[k * s->m + j]);
        }
        if (!whole) {
            p->failed++;
            t->reasons[t->rows - 1] = qdot_strdup("a number is undefined there");
            if (t->reasons[t->rows - 1] == NULL)
                return QDOT_ENOMEM;
        }
        p->beyond += qdot_run_report_is_beyond(report, s->t[k]);
    }
    return QDOT_OK;
}

/* Find the section points of the latest run; swept: its values of the swept parameters. */
static qdot_status
find_points(qdot_cursor *c, poincare *p, qdot_run *run, const double *swept)
{
    const size_t m = p->columns.at.n;
    qdot_expr *exprs = qdot_calloc(m, sizeof *exprs);
    qdot_section s = {.lost = NAN};
    qdot_status status = exprs ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < m && status == QDOT_OK; i++) {
        status = qdot_columns_read(c, &p->columns, i, &exprs[i]);
        if (status == QDOT_OK)
            exprs[i] = qdot_momenta_to_velocities(
                c->session, qdot_measured_as_rationals(c->session, exprs[i]));
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(c->session->pool);
    if (status == QDOT_OK)
        status = qdot_section_find(run,
                                   &(qdot_section_of){p->g, p->way, m, exprs,
                                                      p->limited ? p->limits : NULL},
                                   &s);
    if (status == QDOT_OK)
        status = add_points(p, run, swept, &s);
    if (!isnan(s.lost)) {
        p->n_lost++;
        p->lost = s.lost;
    }
    qdot_section_clear(&s);
    qdot_free(exprs);
    return status;
}

static qdot_status
make_table(qdot_session *session, poincare *p)
{
    const size_t n = p->sweep != NULL ? p->sweep->n_swept : 0;
    qdot_columns_before *before = qdot_calloc(n + 1, sizeof *before);
    qdot_status status;

    if (before == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        before[i].label = p->sweep->labels[i];
    before[n] = (qdot_columns_before){"t", QDOT_T};
    status = qdot_columns_table(session, &p->columns, p->name != NULL ? p->name : "poincare",
                                n + 1, before, &p->table);
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        if (p->sweep->units[i] != NULL)
            status = qdot_row_table_set_unit(p->table, i, p->sweep->units[i]);
    if (p->table != NULL)
        p->table->scattered = true;
    qdot_free(before);
    return status;
}

/* --- the section of a sweep ------------------------------------------------------------- */

typedef struct {
    poincare *p;
    const double *swept;
} member;

static qdot_status
add_points_of_member(qdot_cursor *c, qdot_run *run, qdot_expr end, void *user)
{
    const member *m = user;

    (void)end;
    return find_points(c, m->p, run, m->swept);
}

/* Append a row that says why a run (member) of the sweep has no points. */
static qdot_status
add_failure(poincare *p, const double *swept)
{
    qdot_row_table *t = p->table;

    QDOT_TRY(qdot_row_table_add(t));
    memcpy(t->values + (t->rows - 1) * t->n, swept, (t->n_swept - 1) * sizeof *swept);
    p->failed++;
    t->reasons[t->rows - 1] = qdot_strdup(qdot_last_error()->message);
    return t->reasons[t->rows - 1] != NULL ? QDOT_OK : QDOT_ENOMEM;
}

/* Find the section points of all runs (members) of the sweep; *interrupted: some are missing. */
static qdot_status
find_points_of_members(qdot_cursor *c, poincare *p, bool *interrupted)
{
    const size_t start = c->error_at;
    double *swept = qdot_calloc(p->members.axes.at.n + 1, sizeof *swept);
    member m = {p, swept};
    qdot_status status = swept ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < p->members.axes.members && status == QDOT_OK; k++) {
        status = qdot_members_run(c, &p->members, k, swept, add_points_of_member, &m);
        if (status == QDOT_EINTR && p->table->rows > 0) {
            qdot_interrupt_clear(); /* the interruption is handled here: keep the points found so far */
            *interrupted = true;
            status = QDOT_OK;
            break;
        }
        if (status != QDOT_OK && !qdot_trial_all_fail(status))
            status = add_failure(p, swept);
    }
    if (status == QDOT_OK)
        c->error_at = start;
    qdot_free(swept);
    return status;
}

static qdot_status
make_section_of_sweep(qdot_cursor *c, poincare *p, bool *interrupted)
{
    qdot_function_body *body = qdot_function_body_keep(p->sweep->members);
    const qdot_cursor own = {.session = c->session, .source = body->source, .at = body->from};
    qdot_status status = qdot_match_operands_to(&own, body->to, qdot_statement_find("sweep"), &p->swept);

    if (status == QDOT_OK)
        status = qdot_members_find(&p->swept, &p->members);
    if (status == QDOT_OK)
        status = make_table(c->session, p);
    if (status == QDOT_OK)
        status = find_points_of_members(c, p, interrupted);
    qdot_function_body_release(body);
    return status;
}

/* --- answers and the statement ---------------------------------------------------------- */

static qdot_status
answer_section(qdot_session *session, const poincare *p, const qdot_row_table *t)
{
    qdot_text text = {0};

    if (p->beyond > 0)
        QDOT_TRY(qdot_answer_notice(session,
                                    "%zu of the points lie beyond the horizon of their run: there "
                                    "each is one of a motion near by, and only their distribution "
                                    "is known",
                                    p->beyond));
    if (p->n_lost > 0 && p->sweep == NULL)
        QDOT_TRY(qdot_answer_notice(session,
                                    "from t = %.4g on crossings cannot be distinguished from rounding: they are not known",
                                    p->lost));
    else if (p->n_lost > 0)
        QDOT_TRY(qdot_answer_notice(session,
                                    "in %zu of the runs crossings cannot be distinguished from rounding from some time on: "
                                    "they are not known",
                                    p->n_lost));
    if (!session->output->json) {
        qdot_text_format(&text, "%s: %zu point%s", t->name, t->rows - p->failed,
                         t->rows - p->failed == 1 ? "" : "s");
        if (p->failed > 0)
            qdot_text_format(&text, ", %zu failed", p->failed);
        qdot_text_char(&text, '\n');
        QDOT_TRY(qdot_answer_written(session, t->name, QDOT_OK, &text));
    }
    return session->output->json || (t->rows > 0 && t->rows <= QDOT_ROWS_PRINTED)
               ? qdot_row_answer(session, t)
               : QDOT_OK;
}

/* Give a notice if the run does not cover the times requested for the section. */
static qdot_status
give_notice_of_time_limits(qdot_session *session, const poincare *p, const qdot_run *run)
{
    const qdot_run_report *r = qdot_run_get_report(run);
    const double first = fmin(r->t0, r->t1), last = fmax(r->t0, r->t1);

    if (!p->limited || (fmin(p->limits[0], p->limits[1]) >= first && fmax(p->limits[0], p->limits[1]) <= last))
        return QDOT_OK;
    return qdot_answer_notice(session, "the run covers %.10g to %.10g, not all of %.10g to %.10g", r->t0, r->t1,
                              p->limits[0], p->limits[1]);
}

static qdot_status
make_section_of_run(qdot_record *r, poincare *p)
{
    qdot_cursor *c = &r->cursor;
    qdot_named_run *run;

    if (p->run_at != NULL)
        QDOT_TRY(qdot_run_carry_out(c, p->run_at, &p->run));
    QDOT_TRY(qdot_runs_find(c->session, NULL, &run));
    QDOT_TRY(give_notice_of_time_limits(c->session, p, run->run));
    QDOT_TRY(qdot_outdated_notice(c->session, NULL, r->start, r->parts.at[r->parts.n - 1].to));
    QDOT_TRY(make_table(c->session, p));
    return find_points(c, p, run->run, NULL);
}

static qdot_status
carry_out_poincare(qdot_record *r)
{
    qdot_cursor *c = &r->cursor;
    poincare p = {.run.tol = 1e-12, .members.run.tol = 1e-12};
    bool interrupted = false;
    qdot_status status = read_all_options(r, &p);

    if (status == QDOT_OK) {
        c->error_at = r->start->start;
        status = p.sweep != NULL ? make_section_of_sweep(c, &p, &interrupted) : make_section_of_run(r, &p);
    }
    if (status == QDOT_OK) {
        qdot_row_table *table = p.table;

        p.table = NULL; /* now owned by the session */
        status = qdot_row_tables_keep(c->session, table);
        if (status == QDOT_OK)
            status = answer_section(c->session, &p, table);
        if (status == QDOT_OK && interrupted)
            status = qdot_fail(QDOT_EINTR, "interrupted: %s has the points of the first runs alone",
                               table->name);
    }
    qdot_row_table_release(p.table);
    qdot_members_free(&p.members);
    qdot_record_free(&p.swept);
    qdot_run_options_free(&p.run);
    qdot_columns_free(&p.columns);
    return status;
}
