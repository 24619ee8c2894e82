/* fit-model.c -- the numbers of a fit as functions of its unknowns; the search; what the run's own error
 * makes of it. */
#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/speeds.h"
#include "lang/slopes/free-request.h"
#include "lang/unknowns/fit-parts.h"
#include "sim/study/response.h"

/* Values by the run with slopes and by an ordinary one that are further apart, relative to max(1, |value|), beside
 * its error: that with slopes goes another way. */
static const double apart = 1e-6;

/* parameters with a smaller share in a direction that the data do not determine are not listed */
static const double least_part = 1e-3;

typedef struct {
    qdot_fit *f;
    qdot_run_request request; /* request of the run with the unknowns as symbols */
    qdot_expr *values, *start; /* [n_values] parameter values, [2n] start, in terms of the unknowns */
    bool *named;               /* [2n] whether the `start` statement gives this value */
    const char **names;        /* [k] names of the unknowns */
    qdot_expr *unknowns;       /* [k] symbols of the unknowns */
    qdot_response *response;
    double *at, *slopes; /* [rows x m] model values; [rows x m x k] their derivatives by the unknowns */
} model;

/* --- the request of the run ----------------------------------------------------------------- */

/* What a speed is at the start of the run; 0 where the start does not name it. */
static qdot_expr
value_of_speed_at_start(qdot_session *session, qdot_expr speed, const qdot_run_request *r)
{
    qdot_expr e = qdot_session_bind(session, qdot_session_speeds_replaced(session, speed));
    const qdot_expr t = QDOT_T;

    for (size_t i = 0; i < session->scene->coordinates.n && e != QDOT_NIL; i++) {
        const qdot_expr q = session->scene->coordinates.at[i], from[] = {q, qdot_symbol_jet(session->pool, q, 1)};

        e = qdot_subs(session->pool, e, 2, from, (qdot_expr[]){r->q0[i], r->v0[i]});
    }
    return e == QDOT_NIL ? e : qdot_subs(session->pool, e, 1, &t, &r->t0);
}

/* Find the guesses for the unknowns: the values by `set`, and start values. */
static qdot_status
find_guesses(qdot_fit *f)
{
    qdot_session *session = f->session;
    const size_t n = session->scene->coordinates.n;

    for (size_t k = 0; k < f->unknowns.names.n; k++) {
        const qdot_slope_name *name = &f->unknowns.names.at[k];
        const qdot_run_request *r = &f->order.request;
        qdot_expr e = QDOT_ZERO;

        if (qdot_slopes_is_parameter(&f->unknowns, k)) {
            const size_t at = qdot_expr_place(r->n_values, r->symbols, name->symbol);

            if (at == r->n_values) {
                (void)qdot_fail(QDOT_EUNSET, "%s has no value to begin with", name->label);
                return qdot_hint("set %s = 1, as a guess", name->label);
            }
            e = r->values[at];
        }
        for (size_t i = 0; i < 2 * n && !qdot_slopes_is_parameter(&f->unknowns, k); i++)
            if (qdot_symbol_jet(session->pool, session->scene->coordinates.at[i % n], i >= n)
                == name->symbol)
                e = (i < n ? r->q0 : r->v0)[i % n];
        if (qdot_session_is_speed(session, name->symbol))
            e = value_of_speed_at_start(session, name->symbol, r);
        QDOT_TRY(qdot_pool_check(session->pool));
        QDOT_TRY(qdot_session_number(f->session, e, &f->guess[k], NULL));
        f->u[k] = f->guess[k];
    }
    return QDOT_OK;
}

static qdot_status
make_request(model *x)
{
    qdot_fit *f = x->f;

    for (size_t k = 0; k < f->unknowns.names.n; k++) {
        x->unknowns[k] = f->unknowns.names.at[k].symbol;
        x->names[k] = f->unknowns.names.at[k].label;
    }
    return qdot_free_request(f->session, f->unknowns.names.n, x->unknowns, &f->order.request, x->values,
                             x->start, x->named, &x->request);
}

/* --- the search for the best fit -------------------------------------------------------------- */

/* Evaluate residuals and derivatives in units of the standard errors. Parameters must stay in their
 * declared domains. */
static qdot_status
evaluate_model(const double *u, double *out, double *J, void *user)
{
    model *x = user;
    const qdot_fit *f = x->f;
    const size_t k = f->unknowns.names.n;

    for (size_t i = 0; i < k; i++)
        QDOT_TRY(qdot_session_in_domain(f->session, x->unknowns[i],
                                        qdot_expr_of_double(f->session->pool, u[i])));
    QDOT_TRY(qdot_response_at(x->response, u, x->at, x->slopes));
    for (size_t i = 0; i < f->rows * f->m; i++) {
        out[i] = (x->at[i] - f->y[i]) / f->sigma[i];
        for (size_t j = 0; j < k; j++)
            J[i * k + j] = x->slopes[i * k + j] / f->sigma[i];
    }
    return QDOT_OK;
}

static qdot_status
search_least_squares(model *x)
{
    qdot_fit *f = x->f;
    const qdot_response_of of = {.scene = f->session->scene,
                                 .request = &x->request,
                                 .k = f->unknowns.names.n,
                                 .unknowns = x->unknowns,
                                 .names = x->names,
                                 .m = f->m,
                                 .exprs = f->exprs,
                                 .n_times = f->rows,
                                 .times = f->t};

    QDOT_TRY(qdot_response_new(&of, &x->response));
    f->found = (qdot_least_squares){.n = f->rows * f->m,
                                    .p = f->unknowns.names.n,
                                    .model = evaluate_model,
                                    .user = x,
                                    .u = f->u};
    return qdot_least_squares_find(&f->found);
}

/* --- when the fit fails ---------------------------------------------------------------------- */

/* Write a combination of unknowns that the data do not determine: "m by 1 % with k by -2 %". */
static void
write_undetermined_direction(const qdot_fit *f, qdot_text *text)
{
    const size_t k = f->unknowns.names.n;
    double first = 0;

    for (size_t i = 0; i < k; i++) {
        double size = 0, step;

        if (!(fabs(f->found.undetermined[i]) > least_part))
            continue;
        for (size_t j = 0; j < f->found.n; j++)
            size = hypot(size, f->found.J[j * k + i]);
        step = f->found.undetermined[i] / (size > 0 ? size : 1)
               / (f->u[i] != 0 ? fabs(f->u[i]) : 1);
        qdot_text_format(text, "%s%s by ", first != 0 ? " with " : "", f->unknowns.names.at[i].label);
        first = first != 0 ? first : fabs(step);
        qdot_text_double(text, step / first, 3);
        qdot_text_add(text, f->u[i] != 0 ? " %" : " hundredths");
    }
}

/* QDOT_EFAILED, with the names of the unknowns, if the data do not determine an unknown. */
static qdot_status
check_determined(const qdot_fit *f)
{
    qdot_text names = {0}, step = {0};
    qdot_status status;
    size_t n = 0;

    for (size_t i = 0; i < f->unknowns.names.n; i++)
        if (fabs(f->found.undetermined[i]) > least_part)
            qdot_text_format(&names, "%s%s", n++ > 0 ? ", " : "", f->unknowns.names.at[i].label);
    if (n == 0)
        return QDOT_OK;
    write_undetermined_direction(f, &step);
    status = qdot_text_status(&names);
    if (status == QDOT_OK)
        status = qdot_text_status(&step);
    if (status == QDOT_OK && n == 1) {
        (void)qdot_fail(QDOT_EFAILED, "the data do not determine %.200s: no number depends on it",
                        names.at);
        status = qdot_hint("leave it out, with the value of `set` or `start`");
    } else if (status == QDOT_OK) {
        (void)qdot_fail(QDOT_EFAILED,
                        "the data do not determine %.150s: no number changes if they change "
                        "together, %.250s",
                        names.at, step.at);
        status = qdot_hint("leave one of them out, with the value of `set` or `start`");
    }
    qdot_text_clear(&names);
    qdot_text_clear(&step);
    return status;
}

static qdot_status
check_converged(const qdot_fit *f)
{
    qdot_text at = {0};
    qdot_status status;

    if (f->found.converged)
        return QDOT_OK;
    for (size_t k = 0; k < f->unknowns.names.n; k++) {
        qdot_text_format(&at, "%s%s = ", k > 0 ? ", " : "", f->unknowns.names.at[k].label);
        qdot_text_double(&at, f->u[k], 5);
    }
    status = qdot_text_status(&at);
    if (status == QDOT_OK) {
        (void)qdot_fail(QDOT_EFAILED, "the fit does not converge: %zu steps, chi^2 = %.5g at %.250s",
                        f->found.steps, f->found.chi2, at.at);
        status = qdot_hint("better guesses by `set` and `start`, or fewer unknowns");
    }
    qdot_text_clear(&at);
    return status;
}

/* --- errors of the fit ------------------------------------------------------------------------ */

/* QDOT_EFAILED if a data point lies beyond the time up to which the run is accurate. */
static qdot_status
check_horizon(const qdot_fit *f, const qdot_run *run)
{
    const qdot_run_report *report = qdot_run_get_report(run);
    size_t known = 0;

    while (known < f->rows && !qdot_run_report_is_beyond(report, f->t[known]))
        known++;
    if (known == f->rows)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EFAILED,
                    "the run is chaotic: beyond its horizon, t = %.6g, it has no digits to compare "
                    "with data",
                    report->horizon);
    return qdot_hint("leave out the rows with t > %.6g", report->horizon);
}

/* Find the model values along an ordinary run with the fitted parameters u, with their errors [rows x m]. */
static qdot_status
evaluate_fitted_run(model *x, double *errors)
{
    qdot_fit *f = x->f;
    qdot_pool *pool = f->session->pool;
    const size_t n = f->session->scene->coordinates.n, n_values = x->request.n_values;
    qdot_run_request request = x->request;
    qdot_expr *all = qdot_calloc(n_values + 2 * n + 1, sizeof *all);
    qdot_run *run = NULL;
    qdot_status status = all ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < n_values + 2 * n && all; i++) {
        all[i] = i < n_values ? x->values[i] : x->start[i - n_values];
        for (size_t k = 0; k < f->unknowns.names.n && all[i] != QDOT_NIL; k++) {
            const qdot_expr u = qdot_expr_of_double(pool, f->u[k]);

            all[i] = qdot_subs(pool, all[i], 1, &x->unknowns[k], &u);
        }
    }
    request.values = all;
    request.q0 = all + n_values;
    request.v0 = request.q0 + n;
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = qdot_run_new(f->session->scene, &request, &run);
    if (status == QDOT_OK && qdot_run_get_report(run)->status == QDOT_RUN_FAILED)
        status = qdot_fail(QDOT_EFAILED, "the run failed: %.300s", qdot_run_get_report(run)->reason);
    if (status == QDOT_OK)
        status = check_horizon(f, run);
    if (status == QDOT_OK)
        status = qdot_run_values(run, f->m, f->exprs, f->rows, f->t, f->fitted, errors);
    qdot_run_free(run);
    qdot_free(all);
    return status;
}

/* Bound the numerical error of the parameters, du = C J^T df; check that the variational and the
 * ordinary run agree. */
static qdot_status
compare_runs(qdot_fit *f, const double *at, const double *errors)
{
    const size_t k = f->unknowns.names.n;

    for (size_t j = 0; j < k; j++)
        f->numerical[j] = fabs(f->found.left[j]);
    for (size_t i = 0; i < f->rows * f->m; i++) {
        const double off = fabs(f->fitted[i] - at[i]);

        if (!(off <= apart * fmax(1, fabs(at[i])) + (isnan(errors[i]) ? 0 : 100 * errors[i])))
            return qdot_fail(QDOT_EFAILED, "the run with slopes goes another way at t = %.6g: %.6g for %.6g",
                             f->t[i / f->m], at[i], f->fitted[i]);
        for (size_t j = 0; j < k; j++) {
            double slope = 0;

            for (size_t l = 0; l < k; l++)
                slope += f->found.covariance[j * k + l] * f->found.J[i * k + l];
            f->numerical[j] += fabs(slope) * (errors[i] + off) / f->sigma[i];
        }
    }
    return QDOT_OK;
}

static qdot_status
find_numerical_errors(model *x)
{
    qdot_fit *f = x->f;
    double *errors = qdot_calloc(f->rows * f->m + 1, sizeof *errors);
    qdot_status status = errors ? evaluate_fitted_run(x, errors) : QDOT_ENOMEM;

    for (size_t i = 0; i < f->found.n && status == QDOT_OK; i++)
        x->at[i] = f->found.f[i] * f->sigma[i] + f->y[i];
    if (status == QDOT_OK)
        status = compare_runs(f, x->at, errors);
    qdot_free(errors);
    return status;
}

/* Find the covariance matrix of the fitted values u, and from it their standard errors. */
static void
find_standard_errors(qdot_fit *f)
{
    const size_t k = f->unknowns.names.n;
    double scale = 1;

    f->freedom = f->found.n - k;
    if (!f->weighted)
        scale = f->freedom > 0 ? f->found.chi2 / (double)f->freedom : NAN;
    for (size_t i = 0; i < k * k; i++)
        f->found.covariance[i] *= scale;
    for (size_t i = 0; i < k; i++)
        f->error[i] = sqrt(f->found.covariance[i * k + i]);
}

/* --- the whole fit ------------------------------------------------------------------------------ */

static qdot_status
allocate_fit(model *x)
{
    qdot_fit *f = x->f;
    const size_t k = f->unknowns.names.n, n = f->session->scene->coordinates.n,
                 numbers = f->rows * f->m;

    x->values = qdot_calloc(f->order.request.n_values + 2 * n + k + 1, sizeof *x->values);
    x->named = qdot_calloc(2 * n + 1, sizeof *x->named);
    x->names = qdot_calloc(k + 1, sizeof *x->names);
    x->at = qdot_calloc(numbers * (1 + k) + 1, sizeof *x->at);
    f->guess = qdot_calloc(4 * k + numbers + 1, sizeof *f->guess);
    if (!x->values || !x->named || !x->names || !x->at || !f->guess)
        return QDOT_ENOMEM;
    x->start = x->values + f->order.request.n_values;
    x->unknowns = x->start + 2 * n;
    x->slopes = x->at + numbers;
    f->u = f->guess + k;
    f->error = f->u + k;
    f->numerical = f->error + k;
    f->fitted = f->numerical + k;
    return QDOT_OK;
}

static qdot_status
find_fit(model *x)
{
    qdot_fit *f = x->f;

    QDOT_TRY(allocate_fit(x));
    QDOT_TRY(find_guesses(f));
    QDOT_TRY(make_request(x));
    QDOT_TRY(search_least_squares(x));
    QDOT_TRY(check_determined(f));
    QDOT_TRY(check_converged(f));
    QDOT_TRY(find_numerical_errors(x));
    find_standard_errors(f);
    return QDOT_OK;
}

qdot_status
qdot_fit_find(qdot_fit *f)
{
    model x = {.f = f};
    qdot_expr last;
    qdot_status status = qdot_request_fill(f->session, &f->order);

    last = qdot_measured_rational(f->session->pool, f->t[f->rows - 1]);
    if (status == QDOT_OK)
        status = qdot_request_limits(f->session, f->from, last, &f->order);
    f->order.request.tol = f->tol;
    f->order.request.method = f->method != NULL ? f->method : "auto";
    if (status == QDOT_OK)
        status = find_fit(&x);
    status = qdot_request_explain(f->session, &f->order, status);
    qdot_response_free(x.response);
    qdot_free(x.values);
    qdot_free(x.named);
    qdot_free(x.names);
    qdot_free(x.at);
    return status;
}
