/* poincare.c -- the statement `poincare`: the section of a run, or of the runs of a sweep. */
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "lang/answer/answer.h"
#include "lang/answer/row-answer.h"
#include "lang/commands/handlers.h"
#include "lang/language/read.h"
#include "lang/runs/own-run.h"
#include "lang/sweeps/columns.h"
#include "lang/sweeps/members.h"
#include "lang/runs/run.h"
#include "lang/session/measured.h"
#include "lang/session/momenta.h"
#include "lang/session/row-tables.h"
#include "lang/session/runs.h"
#include "sim/read/section.h"

typedef struct {
    qdot_expr g; /* left - right */
    int way;
    qdot_columns columns;
    const qdot_token *run_at; /* the word `run`; NULL: none was said */
    qdot_run_options run;
    bool limited;
    double limits[2]; /* of the times, if so */
    const qdot_row_table *sweep; /* whose runs; NULL: one run */
    const char *name;
    qdot_members members; /* of the sweep */
    qdot_row_table *table;
    size_t beyond;    /* points past the horizon of their run */
    size_t failed;
    size_t n_lost; /* runs whose crossings are not known from a time on, */
    double lost;   /* the last such time */
} poincare;

/* --- reading ---------------------------------------------------------------------------- */

static qdot_status
read_surface(qdot_cursor *c, poincare *p)
{
    qdot_pool *pool = c->session->pool;
    const qdot_token *start = c->at;
    qdot_expr left, right;

    QDOT_TRY(qdot_read_motion(c, &left));
    if (qdot_cursor_accept_op(c, "=") || qdot_cursor_accept_op(c, "==")) {
        QDOT_TRY(qdot_read_motion(c, &right));
    } else if (qdot_expr_kind(pool, left) == QDOT_REL
               && qdot_expr_node(pool, left)->op == QDOT_EQ) {
        right = qdot_expr_arg(pool, left, 1); /* a named equation */
        left = qdot_expr_arg(pool, left, 0);
    } else {
        return qdot_cursor_expected(c, "`=` and the other side");
    }
    if (!qdot_expr_is_scalar(pool, left) || !qdot_expr_is_scalar(pool, right)) {
        c->error_at = start->start;
        return qdot_fail(QDOT_ETYPE, "a section is where two numbers become equal");
    }
    p->g = qdot_momenta_to_velocities(
        c->session, qdot_measured_as_rationals(c->session, qdot_sub(pool, left, right)));
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_cursor_accept_word(c, "rising"))
        p->way = 1;
    else if (qdot_cursor_accept_word(c, "falling"))
        p->way = -1;
    return QDOT_OK;
}

/* `of NAME`, a sweep. */
static qdot_status
read_sweep(qdot_cursor *c, poincare *p)
{
    const qdot_token *start = c->at;
    const char *name;

    QDOT_TRY(qdot_read_name(c, &name));
    p->sweep = qdot_row_tables_find(c->session, name);
    if (p->sweep != NULL && p->sweep->members != NULL)
        return QDOT_OK;
    c->error_at = start->start;
    (void)qdot_fail(QDOT_ENAME, "there is no sweep `%s`", name);
    return qdot_hint("sweep omega = 0..5 step 0.1 run 0..20 : max(theta) as %s", name);
}

/* Whose section it is, before the colon or behind the columns. */
static qdot_status
read_whose(qdot_cursor *c, poincare *p, bool behind)
{
    const qdot_token *start = c->at;
    const bool said = p->run_at != NULL || p->sweep != NULL;

    if (qdot_cursor_accept_word(c, "of")) {
        QDOT_TRY(qdot_cursor_once(c, "of", said));
        return read_sweep(c, p);
    }
    if (!qdot_cursor_accept_word(c, "run"))
        return QDOT_OK;
    QDOT_TRY(qdot_cursor_once(c, "run", said));
    p->run_at = start;
    if (!behind)
        return qdot_run_options_read_to_colon(c, start, &p->run);
    QDOT_TRY(qdot_read_range(c, &p->run.from, &p->run.to));
    QDOT_TRY(qdot_run_options_read(c, start, &p->run));
    p->name = p->run.name;
    p->run.name = NULL;
    return QDOT_OK;
}

/* `from A to B`, times. */
static qdot_status
read_limits(qdot_cursor *c, poincare *p)
{
    QDOT_TRY(qdot_cursor_once(c, "from", p->limited));
    p->limited = true;
    QDOT_TRY(qdot_read_number(c, &p->limits[0]));
    if (!qdot_cursor_accept_word(c, "to"))
        return qdot_cursor_expected(c, "`to`, as in from 100 to 200");
    return qdot_read_number(c, &p->limits[1]);
}

/* What stands behind the columns. */
static qdot_status
read_behind(qdot_cursor *c, poincare *p)
{
    while (!qdot_cursor_is_end(c)) {
        const qdot_token *start = c->at;

        if (qdot_cursor_accept_word(c, "from")) {
            QDOT_TRY(read_limits(c, p));
        } else if (qdot_cursor_accept_word(c, "as")) {
            QDOT_TRY(qdot_cursor_once(c, "as", p->name != NULL));
            QDOT_TRY(qdot_read_name(c, &p->name));
        } else {
            QDOT_TRY(read_whose(c, p, true));
        }
        if (c->at == start)
            return qdot_cursor_expected(c, "`run T0..T1`, `of SWEEP`, `from A to B`, `as NAME` or "
                                           "the end of the statement");
    }
    return QDOT_OK;
}

static qdot_status
read_poincare(qdot_cursor *c, poincare *p)
{
    const qdot_token *behind;

    QDOT_TRY(read_surface(c, p));
    QDOT_TRY(read_whose(c, p, false));
    if (p->run_at == NULL && !qdot_cursor_accept_op(c, ":"))
        return qdot_cursor_expected(c, "`:` and what is asked at each crossing");
    QDOT_TRY(qdot_columns_find(c, &p->columns));
    behind = c->at;
    QDOT_TRY(read_behind(c, p));
    if (p->name == NULL || qdot_names_find(c->session->names, p->name) == NULL)
        return QDOT_OK;
    c->error_at = behind->start;
    return qdot_fail(QDOT_ENAME, "`%s` means something else already", p->name);
}

/* --- the points ------------------------------------------------------------------------- */

/* A row for each point: what was swept [n_swept - 1], the time, the numbers. */
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

/* The section of a run, the latest; swept: the values that it was made with. */
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
    const char **before = qdot_calloc(n + 1, sizeof *before);
    qdot_status status;

    if (before == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        before[i] = p->sweep->labels[i];
    before[n] = "t";
    status = qdot_columns_table(session, &p->columns, p->name != NULL ? p->name : "poincare",
                                n + 1, before, &p->table);
    if (p->table != NULL)
        p->table->scattered = true;
    qdot_free(before);
    return status;
}

/* --- of a sweep ------------------------------------------------------------------------- */

typedef struct {
    poincare *p;
    const double *swept;
} member;

static qdot_status
use_member(qdot_cursor *c, qdot_run *run, qdot_expr end, void *user)
{
    const member *m = user;

    (void)end;
    return find_points(c, m->p, run, m->swept);
}

/* A row that says why a member has no points. */
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

/* The sections of all members; *interrupted: some are left. */
static qdot_status
go_over_members(qdot_cursor *c, poincare *p, bool *interrupted)
{
    const size_t start = c->error_at;
    double *swept = qdot_calloc(p->members.axes.at.n + 1, sizeof *swept);
    member m = {p, swept};
    qdot_status status = swept ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < p->members.axes.members && status == QDOT_OK; k++) {
        status = qdot_members_run(c, &p->members, k, swept, use_member, &m);
        if (status == QDOT_EINTR && p->table->rows > 0) {
            qdot_interrupt_clear(); /* heard: the points that are found are kept */
            *interrupted = true;
            status = QDOT_OK;
            break;
        }
        if (status != QDOT_OK && !qdot_own_run_all_fail(status))
            status = add_failure(p, swept);
    }
    if (status == QDOT_OK)
        c->error_at = start;
    qdot_free(swept);
    return status;
}

static qdot_status
find_of_sweep(qdot_cursor *c, poincare *p, bool *interrupted)
{
    qdot_function_body *body = qdot_function_body_keep(p->sweep->members);
    qdot_cursor own = *c;
    qdot_status status;

    own.source = body->source;
    own.at = body->from;
    status = qdot_members_read(&own, &p->members);
    if (status == QDOT_OK)
        status = make_table(c->session, p);
    if (status == QDOT_OK)
        status = go_over_members(c, p, interrupted);
    qdot_function_body_release(body);
    return status;
}

/* --- what is told ----------------------------------------------------------------------- */

static qdot_status
poincare_tell(qdot_session *session, const poincare *p, const qdot_row_table *t)
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
                                    "from t = %.4g on crossings cannot be told from rounding: they are not known",
                                    p->lost));
    else if (p->n_lost > 0)
        QDOT_TRY(qdot_answer_notice(session,
                                    "in %zu of the runs crossings cannot be told from rounding from some time on: "
                                    "they are not known",
                                    p->n_lost));
    if (!session->json) {
        qdot_text_format(&text, "%s: %zu point%s", t->name, t->rows - p->failed,
                         t->rows - p->failed == 1 ? "" : "s");
        if (p->failed > 0)
            qdot_text_format(&text, ", %zu failed", p->failed);
        qdot_text_char(&text, '\n');
        QDOT_TRY(qdot_answer_written(session, t->name, QDOT_OK, &text));
    }
    return session->json || (t->rows > 0 && t->rows <= QDOT_ROWS_PRINTED)
               ? qdot_row_answer(session, t)
               : QDOT_OK;
}

/* A notice where the run does not cover the times asked for. */
static qdot_status
tell_limits(qdot_session *session, const poincare *p, const qdot_run *run)
{
    const qdot_run_report *r = qdot_run_get_report(run);
    const double first = fmin(r->t0, r->t1), last = fmax(r->t0, r->t1);

    if (!p->limited || (fmin(p->limits[0], p->limits[1]) >= first && fmax(p->limits[0], p->limits[1]) <= last))
        return QDOT_OK;
    return qdot_answer_notice(session, "the run covers %.10g to %.10g, not all of %.10g to %.10g", r->t0, r->t1,
                              p->limits[0], p->limits[1]);
}

static qdot_status
find_of_run(qdot_cursor *c, poincare *p)
{
    qdot_named_run *run;

    if (p->run_at != NULL)
        QDOT_TRY(qdot_run_carry_out(c, p->run_at, &p->run));
    QDOT_TRY(qdot_runs_find(c->session, NULL, &run));
    QDOT_TRY(tell_limits(c->session, p, run->run));
    QDOT_TRY(make_table(c->session, p));
    return find_points(c, p, run->run, NULL);
}

qdot_status
qdot_poincare_statement(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    poincare p = {.run.tol = 1e-12, .members.run.tol = 1e-12};
    bool interrupted = false;
    qdot_status status = read_poincare(c, &p);

    if (status == QDOT_OK) {
        c->error_at = start->start;
        status = p.sweep != NULL ? find_of_sweep(c, &p, &interrupted) : find_of_run(c, &p);
    }
    if (status == QDOT_OK) {
        qdot_row_table *table = p.table;

        p.table = NULL; /* the session's from now on */
        status = qdot_row_tables_keep(c->session, table);
        if (status == QDOT_OK)
            status = poincare_tell(c->session, &p, table);
        if (status == QDOT_OK && interrupted)
            status = qdot_fail(QDOT_EINTR, "interrupted: %s has the points of the first runs alone",
                               table->name);
    }
    qdot_row_table_release(p.table);
    qdot_members_free(&p.members);
    qdot_run_options_free(&p.run);
    qdot_columns_free(&p.columns);
    return status;
}
