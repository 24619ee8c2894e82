/* fit.c -- the statement `fit NAME, ... to "FILE" : t, EXPR, ...`: fits unknowns of the model to data. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "lang/answer/answer.h"
#include "lang/language/token-text.h"
#include "lang/runs/error-time.h"
#include "lang/runs/run-options.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/momenta.h"
#include "lang/slopes/slopes.h"
#include "lang/syntax/record.h"
#include "lang/unknowns/fit-parts.h"

static qdot_status carry_out_fit(qdot_record *r);

QDOT_STATEMENT(fit) = {
    .word = "fit",
    .group = QDOT_NUMBERS,
    .usage = "fit NAME, ... to \"FILE\" : T, EXPR, ... [sigma EXPR, ...] [from EXPR] [tol E] "
             "[method auto|radau] [as NAME]",
    .summary = "parameters and initial values (theta, theta') by least squares, each with its standard error; the "
               "values of `set` and `start` are the guesses; columns of the file, in its order or by its names, may be "
               "`sigma`, of the one before, or `skip`; `t*1e-3` scales the time",
    .example = "fit m, k, theta' to \"data.csv\" : t, theta sigma 0.01",
    .handler = carry_out_fit,
};

static void
free_fit(qdot_fit *f)
{
    qdot_slopes_free(&f->unknowns);
    for (size_t i = 0; i < f->columns.n; i++)
        qdot_free(f->columns.at[i].label);
    qdot_free(f->columns.at);
    qdot_free(f->t);
    qdot_request_free(&f->order);
    qdot_free(f->exprs);
    qdot_free(f->guess);
    qdot_least_squares_clear(&f->found);
}

/* --- columns of the file ------------------------------------------------------------------- */

/* Whether the column in the statement consists of just this word, such as sigma or skip. */
static bool
is_single_word(const qdot_record *r, const qdot_filled *part, const char *word)
{
    const qdot_name *known = qdot_names_find(r->cursor.session->names, word);

    return qdot_filled_is_word(part, word)
           && !(known != NULL && known->kind == QDOT_NAME_COORD);
}

/* Read a column that contains the standard errors of the column before it. */
static qdot_status
read_sigma_column(qdot_record *r, const qdot_filled *part, qdot_fit *f, qdot_fit_column *x)
{
    qdot_fit_column *before = f->columns.n > 0 ? &f->columns.at[f->columns.n - 1] : NULL;
    qdot_session *session = r->cursor.session;

    if (before == NULL || before->kind != QDOT_FIT_VALUE) {
        qdot_record_blame(r, part);
        (void)qdot_fail(QDOT_EINVAL, "a column `sigma` holds the standard errors of the column before "
                                     "it, which has to be a value");
        return qdot_hint("fit m to \"data.csv\" : t, x, sigma");
    }
    before->weighted = true;
    x->kind = QDOT_FIT_SIGMA;
    if (qdot_names_find(session->names, "sigma") == NULL)
        return QDOT_OK;
    return qdot_answer_notice(session, "the column `sigma` holds standard errors here; `(sigma)` is "
                                       "what you call so");
}

/* Whether e is t, or t in another unit or from another origin: a t + b. */
static bool
is_of_time(qdot_pool *pool, qdot_expr e)
{
    const uint32_t moving = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_TIME | QDOT_HAS_MOMENTUM
                            | QDOT_HAS_MULTIPLIER | QDOT_HAS_UFUN;
    const qdot_expr slope = qdot_expr_is_scalar(pool, e) ? qdot_diff(pool, e, QDOT_T) : QDOT_NIL;

    return slope != QDOT_NIL && slope != QDOT_ZERO && !(qdot_expr_node(pool, slope)->holds & moving)
           && !(qdot_expr_node(pool, e)->holds & (moving & ~(uint32_t)QDOT_HAS_TIME));
}

/* Fail if no column is the time. */
static qdot_status
check_time_column(qdot_cursor *c, const qdot_fit *f)
{
    for (size_t i = 0; i < f->columns.n; i++)
        if (f->columns.at[i].kind == QDOT_FIT_TIME)
            return QDOT_OK;
    c->error_at = f->columns.at[0].place->start;
    (void)qdot_fail(QDOT_EINVAL, "no column is the time, `t`");
    return qdot_hint("fit m to \"data.csv\" : t, %.100s", f->columns.at[0].label ? f->columns.at[0].label : "x");
}

static qdot_status
read_expression_column(qdot_record *r, const qdot_filled *part, qdot_fit *f, qdot_fit_column *x)
{
    qdot_session *session = r->cursor.session;
    const size_t measured = session->measured->n;
    qdot_text text = {0};

    QDOT_TRY(qdot_compiled_motion(&r->cursor, &r->compiled.at[part->first], &x->e));
    qdot_token_text(session, part->from, part->to, &text);
    x->label = text.at;
    QDOT_TRY(qdot_text_status(&text));
    qdot_record_blame(r, part);
    if (is_of_time(session->pool, x->e)) {
        x->kind = QDOT_FIT_TIME;
        for (size_t i = 0; i < f->columns.n; i++)
            if (f->columns.at[i].kind == QDOT_FIT_TIME)
                return qdot_fail(QDOT_EINVAL, "the time is one column alone");
        return QDOT_OK;
    }
    x->kind = QDOT_FIT_VALUE;
    if (!qdot_expr_is_scalar(session->pool, x->e))
        return qdot_fail(QDOT_ETYPE, "a column is one number a row");
    if (session->measured->n > measured || qdot_member_any(session, x->e)) {
        (void)qdot_fail(QDOT_EINVAL, "a column is what the scene has at each time, not a number of a run");
        return qdot_hint("theta, x + L*sin(theta), energy");
    }
    if (qdot_expr_node(session->pool, x->e)->holds & QDOT_HAS_MULTIPLIER)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes of multipliers");
    x->e = qdot_momenta_to_velocities(session, qdot_measured_as_rationals(session, x->e));
    f->m++;
    return qdot_pool_check(session->pool);
}

static qdot_status
read_column(qdot_record *r, const qdot_filled *part, qdot_fit *f, qdot_fit_column *x)
{
    if (is_single_word(r, part, "sigma"))
        return read_sigma_column(r, part, f, x);
    if (!is_single_word(r, part, "skip"))
        return read_expression_column(r, part, f, x);
    x->kind = QDOT_FIT_SKIP;
    return QDOT_OK;
}

/* Read the columns of the statement after its colon: what each column of the file contains. */
static qdot_status
read_columns(qdot_record *r, qdot_fit *f)
{
    const qdot_filled *last = NULL;

    for (size_t i = 0; i < r->parts.n; i++) {
        const qdot_filled *part = &r->parts.at[i];
        qdot_fit_column x = {.place = part->from};
        qdot_status status;

        if (part->n == 0 || strcmp(part->node->before, "to") != 0)
            continue;
        last = part;
        status = read_column(r, part, f, &x);
        if (status == QDOT_OK)
            status = qdot_vec_push(&f->columns, x);
        if (status != QDOT_OK) {
            qdot_free(x.label);
            return status;
        }
    }
    if (f->m > 0)
        return check_time_column(&r->cursor, f);
    return qdot_record_expected(r, last->to, "`,` and what was measured: `t, theta`");
}

/* --- reading the options ------------------------------------------------------------------------ */

/* The k-th among the columns with values to be fitted. */
static qdot_fit_column *
find_value_column(const qdot_fit *f, size_t k)
{
    for (size_t i = 0; i < f->columns.n; i++)
        if (f->columns.at[i].kind == QDOT_FIT_VALUE && k-- == 0)
            return &f->columns.at[i];
    return NULL;
}

/* Read the option `sigma S`, a standard error for all columns, or one for each column. */
static qdot_status
read_sigma_option(qdot_record *r, qdot_fit *f)
{
    const qdot_filled *first = qdot_record_hole(r, "sigma", "EXPR"), *part = first;
    size_t n = 0;
    double x = 0;

    f->weighted = first != NULL;
    for (; part != NULL && strcmp(part->node->before, "sigma") == 0; part = qdot_record_next(r, part, "EXPR")) {
        qdot_fit_column *column = find_value_column(f, n++);

        QDOT_TRY(qdot_record_number(r, part, &x));
        qdot_record_blame(r, part);
        if (!(x > 0) || !isfinite(x))
            return qdot_fail(QDOT_EINVAL, "a standard error is positive, not %.6g", x);
        if (column == NULL)
            return qdot_fail(QDOT_EINVAL, "%zu standard errors for %zu value%s", n, f->m,
                             f->m == 1 ? "" : "s");
        if (column->weighted)
            return qdot_fail(QDOT_EINVAL, "%.100s has a column of standard errors already",
                             column->label);
        column->sigma = x;
    }
    if (first == NULL)
        return QDOT_OK;
    qdot_record_blame(r, first);
    if (n > 1 && n < f->m)
        return qdot_fail(QDOT_EINVAL, "%zu standard errors for %zu values: one, or one for each", n,
                         f->m);
    for (size_t i = n; i < f->m; i++) {
        if (find_value_column(f, i)->weighted)
            return qdot_fail(QDOT_EINVAL, "%.100s has a column of standard errors already",
                             find_value_column(f, i)->label);
        find_value_column(f, i)->sigma = x;
    }
    return QDOT_OK;
}

static qdot_status
read_fit_options(qdot_record *r, qdot_fit *f)
{
    const qdot_filled *from = qdot_record_hole(r, "from", "EXPR"), *method = qdot_record_word(r, "method");

    QDOT_TRY(read_sigma_option(r, f));
    if (from != NULL)
        QDOT_TRY(qdot_record_scalar(r, from, &f->from));
    QDOT_TRY(qdot_error_time_tolerance(r, &f->tol));
    if (method != NULL) {
        f->method_at = method[1].from;
        f->method = method[1].from->text;
    }
    return QDOT_OK;
}

/* Refuse to fit several values if standard errors are given only for some of them. */
static qdot_status
check_weights(qdot_cursor *c, qdot_fit *f)
{
    const qdot_fit_column *with = NULL, *without = NULL;

    for (size_t i = 0; i < f->columns.n; i++) {
        const qdot_fit_column *x = &f->columns.at[i];

        if (x->kind == QDOT_FIT_VALUE && (x->weighted || x->sigma > 0))
            with = x;
        else if (x->kind == QDOT_FIT_VALUE)
            without = x;
    }
    f->weighted = with != NULL;
    if (with == NULL || without == NULL)
        return QDOT_OK;
    c->error_at = without->place->start;
    (void)qdot_fail(QDOT_EINVAL, "%.100s has standard errors, %.100s has none", with->label,
                    without->label);
    return qdot_hint("`sigma` behind each value, or none at all");
}

static qdot_status
read_fit_operands(qdot_record *r, qdot_fit *f)
{
    const qdot_filled *file = qdot_record_hole(r, "to", "\"FILE\""), *name = qdot_record_hole(r, "as", "NAME");

    QDOT_TRY(qdot_slopes_find(r, "fit", &f->unknowns));
    f->path_at = file->from;
    f->path = qdot_record_text(file);
    QDOT_TRY(read_columns(r, f));
    QDOT_TRY(read_fit_options(r, f));
    QDOT_TRY(check_weights(&r->cursor, f));
    return name != NULL ? qdot_record_new_name(r, name, &f->name) : QDOT_OK;
}

/* --- setting parameters to the result --------------------------------------------------------------- */

/* The number x as an exact decimal, rounded to 1/1000 of its error. */
static qdot_expr
round_to_decimal(qdot_pool *pool, double x, double error)
{
    char text[40];
    qdot_expr e;

    for (int digits = 3; digits <= 17; digits++) {
        double back;

        snprintf(text, sizeof text, "%.*e", digits - 1, fabs(x));
        if (sscanf(text, "%lf", &back) == 1 && fabs(back - fabs(x)) <= error / 1000)
            break;
    }
    e = qdot_expr_decimal(pool, text, strlen(text));
    return x < 0 ? qdot_neg(pool, e) : e;
}

qdot_status
qdot_fit_set(qdot_fit *f)
{
    const size_t n = f->unknowns.names.n;
    qdot_expr *values = qdot_calloc(n, sizeof *values);
    qdot_status status = values ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < n && values; k++) {
        values[k] = round_to_decimal(f->session->pool, f->u[k], isnan(f->error[k]) ? 0 : f->error[k]);
        if (qdot_session_in_domain(f->session, f->unknowns.names.at[k].symbol, values[k])
            != QDOT_OK) /* the rounded value lies outside of the domain of its symbol */
            values[k] = round_to_decimal(f->session->pool, f->u[k], 0);
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(f->session->pool);
    if (status == QDOT_OK)
        status = qdot_slope_names_put(f->session, n, f->unknowns.names.at, values);
    qdot_free(values);
    return status;
}

/* --- the statement `fit` ------------------------------------------------------------------------------ */

static qdot_status
fit_and_answer(qdot_cursor *c, qdot_fit *f)
{
    const size_t measured = c->session->measured->n;
    size_t m = 0;
    qdot_status status;

    if (f->from == QDOT_NIL)
        f->from = QDOT_ZERO;
    f->tol = f->tol > 0 ? f->tol : 1e-12;
    QDOT_TRY(qdot_fit_read_data(c, f));
    c->error_at = f->unknowns.names.at[0].place->start;
    if (f->rows * f->m < f->unknowns.names.n) {
        (void)qdot_fail(QDOT_EINVAL, "%zu number%s do not determine %zu unknowns", f->rows * f->m,
                        f->rows * f->m == 1 ? "" : "s", f->unknowns.names.n);
        return qdot_hint("more data, or fewer unknowns");
    }
    f->exprs = qdot_calloc(f->m, sizeof *f->exprs);
    if (f->exprs == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < f->columns.n; i++)
        if (f->columns.at[i].kind == QDOT_FIT_VALUE)
            f->exprs[m++] = f->columns.at[i].e;
    status = qdot_fit_find(f);
    c->session->measured->n = measured;
    QDOT_TRY(status);
    QDOT_TRY(qdot_fit_set(f));
    return qdot_fit_tell(f);
}

static qdot_status
carry_out_fit(qdot_record *r)
{
    qdot_cursor *c = &r->cursor;
    qdot_fit f = {.session = c->session};
    qdot_status status = read_fit_operands(r, &f);

    if (status == QDOT_OK) {
        c->error_at = r->start->start;
        status = fit_and_answer(c, &f);
    }
    qdot_run_options_place(c, f.method_at, status);
    free_fit(&f);
    return status;
}
