/* fit.c -- the statement `fit NAME, ... to "FILE" : t, EXPR, ...`. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/commands/handlers.h"
#include "lang/language/read.h"
#include "lang/language/token-text.h"
#include "lang/unknowns/fit-parts.h"
#include "lang/slopes/trial.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/momenta.h"

static void
fit_free(qdot_fit *f)
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

/* --- columns ------------------------------------------------------------------------------- */

/* Whether the word stands by itself, as a column. */
static bool
is_alone(const qdot_cursor *c, const char *word)
{
    const qdot_name *known = qdot_names_find(c->session->names, word);

    return qdot_cursor_is_word(c, word)
           && (c->at[1].kind == QDOT_TOKEN_END || qdot_token_is(c->at + 1, ",")
               || c->at[1].kind == QDOT_TOKEN_NAME)
           && !(known != NULL && known->kind == QDOT_NAME_COORD);
}

/* Standard errors of the column before. */
static qdot_status
read_sigma_column(qdot_cursor *c, qdot_fit *f, qdot_fit_column *x)
{
    qdot_fit_column *before = f->columns.n > 0 ? &f->columns.at[f->columns.n - 1] : NULL;

    if (before == NULL || before->kind != QDOT_FIT_VALUE) {
        c->error_at = c->at->start;
        (void)qdot_fail(QDOT_EINVAL, "a column `sigma` holds the standard errors of the column before "
                                     "it, which has to be a value");
        return qdot_hint("fit m to \"data.csv\" : t, x, sigma");
    }
    before->weighted = true;
    x->kind = QDOT_FIT_SIGMA;
    c->at++;
    if (qdot_names_find(c->session->names, "sigma") == NULL)
        return QDOT_OK;
    return qdot_answer_notice(c->session, "the column `sigma` holds standard errors here; `(sigma)` is "
                                          "what you call so");
}

static qdot_status
read_expression(qdot_cursor *c, qdot_fit *f, qdot_fit_column *x)
{
    qdot_session *session = c->session;
    const qdot_token *start = c->at;
    const size_t measured = session->measured.n;
    qdot_text text = {0};

    QDOT_TRY(qdot_read_motion(c, &x->e));
    qdot_token_text(session, start, c->at, &text);
    x->label = text.at;
    QDOT_TRY(qdot_text_status(&text));
    c->error_at = start->start;
    if (f->columns.n == 0) {
        x->kind = QDOT_FIT_TIME;
        if (x->e == QDOT_T)
            return QDOT_OK;
        (void)qdot_fail(QDOT_EINVAL, "the first column is the time, `t`, not %.100s", x->label);
        return qdot_hint("fit m to \"data.csv\" : t, %.100s", x->label);
    }
    x->kind = QDOT_FIT_VALUE;
    if (!qdot_expr_is_scalar(session->pool, x->e))
        return qdot_fail(QDOT_ETYPE, "a column is one number a row");
    if (session->measured.n > measured || qdot_member_any(session, x->e)) {
        (void)qdot_fail(QDOT_EINVAL, "a column is what the scene has at each time, not a number of a run");
        return qdot_hint("theta, x + L*sin(theta), energy");
    }
    if (qdot_expr_node(session->pool, x->e)->holds & QDOT_HAS_MULTIPLIER)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes of multipliers");
    if (x->e == QDOT_T)
        return qdot_fail(QDOT_EINVAL, "the time is the first column alone");
    x->e = qdot_momenta_to_velocities(session, qdot_measured_as_rationals(session, x->e));
    f->m++;
    return qdot_pool_check(session->pool);
}

static qdot_status
read_columns(qdot_cursor *c, qdot_fit *f)
{
    do {
        qdot_fit_column x = {.place = c->at};
        qdot_status status;

        if (qdot_cursor_is_end(c))
            return qdot_cursor_expected(c, "what a column of the file holds: `t, theta, x`");
        if (is_alone(c, "sigma")) {
            status = read_sigma_column(c, f, &x);
        } else if (is_alone(c, "skip") && f->columns.n > 0) {
            x.kind = QDOT_FIT_SKIP;
            c->at++;
            status = QDOT_OK;
        } else {
            status = read_expression(c, f, &x);
        }
        if (status == QDOT_OK)
            status = qdot_vec_push(&f->columns, x);
        if (status != QDOT_OK) {
            qdot_free(x.label);
            return status;
        }
    } while (qdot_cursor_accept_op(c, ","));
    if (f->m > 0)
        return QDOT_OK;
    return qdot_cursor_expected(c, "`,` and what was measured: `t, theta`");
}

/* --- options ------------------------------------------------------------------------------------ */

/* The k-th value among the columns. */
static qdot_fit_column *
value_column(const qdot_fit *f, size_t k)
{
    for (size_t i = 0; i < f->columns.n; i++)
        if (f->columns.at[i].kind == QDOT_FIT_VALUE && k-- == 0)
            return &f->columns.at[i];
    return NULL;
}

/* `sigma S`, or one for each value. */
static qdot_status
read_sigma(qdot_cursor *c, qdot_fit *f)
{
    const qdot_token *start = c->at;
    size_t n = 0;
    double x = 0;

    QDOT_TRY(qdot_cursor_once(c, "sigma", f->weighted));
    f->weighted = true;
    do {
        const qdot_token *own = c->at;
        qdot_fit_column *column = value_column(f, n++);

        QDOT_TRY(qdot_read_number(c, &x));
        c->error_at = own->start;
        if (!(x > 0) || !isfinite(x))
            return qdot_fail(QDOT_EINVAL, "a standard error is positive, not %.6g", x);
        if (column == NULL)
            return qdot_fail(QDOT_EINVAL, "%zu standard errors for %zu value%s", n, f->m,
                             f->m == 1 ? "" : "s");
        if (column->weighted)
            return qdot_fail(QDOT_EINVAL, "%.100s has a column of standard errors already",
                             column->label);
        column->sigma = x;
    } while (qdot_cursor_accept_op(c, ","));
    c->error_at = start->start;
    if (n > 1 && n < f->m)
        return qdot_fail(QDOT_EINVAL, "%zu standard errors for %zu values: one, or one for each", n,
                         f->m);
    for (size_t i = n; i < f->m; i++) {
        if (value_column(f, i)->weighted)
            return qdot_fail(QDOT_EINVAL, "%.100s has a column of standard errors already",
                             value_column(f, i)->label);
        value_column(f, i)->sigma = x;
    }
    return QDOT_OK;
}

static qdot_status
read_tolerance(qdot_cursor *c, qdot_fit *f)
{
    const qdot_token *start = c->at;

    QDOT_TRY(qdot_cursor_once(c, "tol", f->tol > 0));
    QDOT_TRY(qdot_read_number(c, &f->tol));
    c->error_at = start->start;
    return f->tol >= 1e-16 && f->tol < 1
               ? QDOT_OK
               : qdot_fail(QDOT_EINVAL, "a tolerance lies between 1e-16 and 1");
}

static qdot_status
read_options(qdot_cursor *c, qdot_fit *f)
{
    while (!qdot_cursor_is_end(c)) {
        if (qdot_cursor_accept_word(c, "sigma")) {
            QDOT_TRY(read_sigma(c, f));
        } else if (qdot_cursor_accept_word(c, "from")) {
            QDOT_TRY(qdot_cursor_once(c, "from", f->from != QDOT_NIL));
            QDOT_TRY(qdot_read_scalar(c, &f->from));
        } else if (qdot_cursor_accept_word(c, "tol")) {
            QDOT_TRY(read_tolerance(c, f));
        } else if (qdot_cursor_accept_word(c, "method")) {
            QDOT_TRY(qdot_cursor_once(c, "method", f->method != NULL));
            if (!qdot_cursor_is_word(c, "auto") && !qdot_cursor_is_word(c, "radau"))
                return qdot_cursor_expected(c, "`auto` or `radau`, which slopes can be had by");
            f->method_at = c->at;
            f->method = c->at++->text;
        } else if (qdot_cursor_accept_word(c, "as")) {
            QDOT_TRY(qdot_cursor_once(c, "as", f->name != NULL));
            QDOT_TRY(qdot_read_name(c, &f->name));
        } else {
            return qdot_cursor_expected(c, "`,`, `sigma`, `from`, `tol`, `method`, `as` or the end of the "
                                           "statement");
        }
    }
    return QDOT_OK;
}

/* Of several values some are weighted, or none. */
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
read_fit(qdot_cursor *c, qdot_fit *f)
{
    QDOT_TRY(qdot_slopes_read(c, &f->unknowns));
    if (!qdot_cursor_accept_word(c, "to"))
        return qdot_cursor_expected(c, "`,` or `to \"FILE\"`, the data");
    f->path_at = c->at;
    if (c->at->kind != QDOT_TOKEN_STRING)
        return qdot_cursor_expected(c, "the name of a file in quotes");
    QDOT_TRY(qdot_read_string(c, &f->path));
    if (!qdot_cursor_accept_op(c, ":"))
        return qdot_cursor_expected(c, "`:` and what the columns of the file are: `: t, theta`");
    QDOT_TRY(read_columns(c, f));
    QDOT_TRY(read_options(c, f));
    QDOT_TRY(check_weights(c, f));
    if (f->name == NULL || qdot_names_find(c->session->names, f->name) == NULL)
        return QDOT_OK;
    c->error_at = c->at[-1].start;
    return qdot_fail(QDOT_ENAME, "`%s` means something else already", f->name);
}

/* --- what is set ------------------------------------------------------------------------------------ */

/* x as a decimal, to 1/1000 of its error. */
static qdot_expr
decimal(qdot_pool *pool, double x, double error)
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
        values[k] = decimal(f->session->pool, f->u[k], isnan(f->error[k]) ? 0 : f->error[k]);
        if (qdot_session_in_domain(f->session, f->unknowns.names.at[k].symbol, values[k])
            != QDOT_OK) /* rounded out of it */
            values[k] = decimal(f->session->pool, f->u[k], 0);
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(f->session->pool);
    if (status == QDOT_OK)
        status = qdot_trial_put(f->session, n, f->unknowns.names.at, values);
    qdot_free(values);
    return status;
}

/* --- the statement ------------------------------------------------------------------------------------ */

static qdot_status
fit_carry_out(qdot_cursor *c, qdot_fit *f)
{
    const size_t measured = c->session->measured.n;
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
    c->session->measured.n = measured;
    QDOT_TRY(status);
    QDOT_TRY(qdot_fit_set(f));
    return qdot_fit_tell(f);
}

qdot_status
qdot_fit_statement(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    qdot_fit f = {.session = c->session};
    qdot_status status = read_fit(c, &f);

    if (status == QDOT_OK) {
        c->error_at = start->start;
        status = fit_carry_out(c, &f);
    }
    if ((status == QDOT_ENAME || status == QDOT_ENOTBUILT) && f.method_at != NULL)
        c->error_at = f.method_at->start;
    fit_free(&f);
    return status;
}
