/* fit-answer.c -- answers a fit: unknowns with standard errors, correlations, chi^2 and residuals. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number-text.h"
#include "base/utf8.h"
#include "lang/answer/answer.h"
#include "lang/answer/table-answer.h"
#include "lang/session/output.h"
#include "lang/session/units.h"
#include "lang/unknowns/fit-parts.h"

/* a numerical error counts as large if it exceeds this fraction of a standard error */
static const double small = 0.1;

/* a probability of such a chi^2 below this is mentioned in the answer */
static const double improbable = 1e-3;

/* --- values and intervals ----------------------------------------------------------------------- */

/* The half width of a 95 % confidence interval, in units of the standard error. */
static double
half_width_of_interval(const qdot_fit *f)
{
    return f->weighted ? gsl_cdf_ugaussian_Pinv(0.975)
                       : gsl_cdf_tdist_Pinv(0.975, (double)f->freedom);
}

/* --- the answer as text ---------------------------------------------------------------------------- */

static void
write_unknowns(const qdot_fit *f, qdot_text *out)
{
    for (size_t k = 0; k < f->unknowns.names.n; k++) {
        qdot_text_format(out, "%s = ", f->unknowns.names.at[k].label);
        qdot_number_text_estimate(out, f->u[k], f->error[k]);
        qdot_units_in_brackets(f->session, f->unknowns.names.at[k].symbol, out);
        qdot_text_char(out, '\n');
    }
}

static double
get_correlation(const qdot_fit *f, size_t i, size_t j)
{
    return f->found.covariance[i * f->unknowns.names.n + j] / (f->error[i] * f->error[j]);
}

/* Fill the lower triangle of the matrix of correlations; all columns have the same width. */
static qdot_status
fill_correlations(const qdot_fit *f, qdot_table_column *columns, qdot_dataset *t)
{
    const size_t k = f->unknowns.names.n;
    size_t width = 6;

    for (size_t i = 0; i < k; i++) {
        const char *label = f->unknowns.names.at[i].label;
        const size_t own = qdot_utf8_columns(label, strlen(label));

        width = own > width ? own : width;
    }
    columns[0] = (qdot_table_column){.name = "correlation", .kind = QDOT_CELL_TEXT, .width = (unsigned)width};
    for (size_t i = 0; i + 1 < k; i++)
        columns[1 + i] = (qdot_table_column){.name = f->unknowns.names.at[i].label,
                                             .form = QDOT_NUMBER_FIXED,
                                             .digits = 3,
                                             .gap = 2,
                                             .width = (unsigned)width};
    QDOT_TRY(qdot_table_begin(t, k, columns));
    for (size_t i = 1; i < k; i++) {
        qdot_table_add_text(t, f->unknowns.names.at[i].label);
        for (size_t j = 0; j < i; j++)
            qdot_table_add_number(t, get_correlation(f, i, j), NAN);
        for (size_t j = i; j + 1 < k; j++)
            qdot_table_add_text(t, "");
    }
    return qdot_table_status(t);
}

static qdot_status
write_correlations(const qdot_fit *f, qdot_text *out)
{
    qdot_table_column *columns = qdot_calloc(f->unknowns.names.n, sizeof *columns);
    qdot_dataset t = {0};
    qdot_status status = columns != NULL ? fill_correlations(f, columns, &t) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_answer_add_table(&t, out);
    qdot_table_clear(&t);
    qdot_free(columns);
    return status;
}

static void
write_residuals(const qdot_fit *f, qdot_text *out)
{
    const char *plural = f->freedom == 1 ? "" : "s";

    if (f->weighted) {
        qdot_text_format(out, "chi^2 = %.4g of %zu degree%s of freedom", f->found.chi2, f->freedom, plural);
        if (f->freedom > 0)
            qdot_text_format(out, ": as large or larger by chance in %.3g %%",
                             100 * gsl_cdf_chisq_Q(f->found.chi2, (double)f->freedom));
    } else {
        qdot_text_format(out, "residuals: %.3g root mean square, %zu degree%s of freedom",
                         sqrt(f->found.chi2 / (double)f->found.n), f->freedom, plural);
    }
    qdot_text_char(out, '\n');
    if (f->freedom > 0 || f->weighted)
        qdot_text_format(out, "± is the standard error: intervals of %.3g times it hold the true value in 95 %% of cases\n",
                         half_width_of_interval(f));
}

static qdot_status
answer_fit_as_text(qdot_fit *f, const char *residuals)
{
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    qdot_text_format(&text, "fit of %zu unknown%s to %zu numbers of %s, %zu step%s\n",
                     f->unknowns.names.n, f->unknowns.names.n == 1 ? "" : "s", f->found.n, f->path,
                     f->found.steps, f->found.steps == 1 ? "" : "s");
    write_unknowns(f, &text);
    if (f->unknowns.names.n > 1 && !isnan(f->error[0]) && f->error[0] > 0)
        status = write_correlations(f, &text);
    write_residuals(f, &text);
    qdot_text_format(&text, "these values are set from now on (undo); %s holds data minus fit\n", residuals);
    return qdot_answer_written(f->session, "fit", status, &text);
}

/* --- the answer as JSON ---------------------------------------------------------------------------- */

static qdot_status
answer_fit_as_json(qdot_fit *f)
{
    const size_t k = f->unknowns.names.n;
    qdot_text name = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < k; i++)
        QDOT_TRY(qdot_answer_estimate(f->session, f->unknowns.names.at[i].label, f->unknowns.names.at[i].symbol, f->u[i],
                                      f->error[i]));
    /* no error is given: the numerical error of chi^2 is due to that of the residuals */
    QDOT_TRY(qdot_answer_statistic(f->session, "chi^2", f->found.chi2));
    QDOT_TRY(qdot_answer_number(f->session, "degrees of freedom", (double)f->freedom, 0));
    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        double *unknown = qdot_calloc(k, sizeof *unknown);

        for (size_t j = 0; j < k && unknown != NULL; j++)
            unknown[j] = NAN;
        qdot_text_truncate(&name, 0);
        qdot_text_format(&name, "covariance[%s]", f->unknowns.names.at[i].label);
        status = unknown ? qdot_text_status(&name) : QDOT_ENOMEM;
        if (status == QDOT_OK)
            status = qdot_answer_statistics(f->session, qdot_text_str(&name), k, f->found.covariance + i * k, unknown);
        qdot_free(unknown);
    }
    qdot_text_clear(&name);
    return status;
}

/* --- notices about the fit ------------------------------------------------------------------------- */

static qdot_status
give_notices(qdot_fit *f)
{
    for (size_t k = 0; k < f->unknowns.names.n; k++) {
        const char *label = f->unknowns.names.at[k].label;

        if (isnan(f->numerical[k])) {
            QDOT_TRY(qdot_answer_notice(f->session,
                                        "the errors of the run are not known at all of these times, so "
                                        "that the errors stated here are those of the data alone"));
            break;
        }
        if (f->numerical[k] > small * f->error[k] && f->error[k] > 0
            && f->numerical[k] > 1e-12 * fabs(f->u[k]))
            QDOT_TRY(qdot_answer_notice(f->session,
                                        "the numerical error of %.100s may be %.1e, not small compared to its "
                                        "standard error %.1e",
                                        label, f->numerical[k], f->error[k]));
    }
    if (f->freedom == 0 && !f->weighted)
        QDOT_TRY(qdot_answer_notice(f->session,
                                    "as many numbers as unknowns: without `sigma` their errors are not "
                                    "known"));
    if (!f->weighted && f->m > 1)
        QDOT_TRY(qdot_answer_notice(f->session,
                                    "without `sigma` all columns count alike, whatever their units"));
    if (f->weighted && f->freedom > 0
        && gsl_cdf_chisq_Q(f->found.chi2, (double)f->freedom) < improbable)
        return qdot_answer_notice(f->session,
                                  "the residuals are larger than sigma allows: the scene, sigma or a point "
                                  "is wrong, or this is not the least sum; the standard errors hold if "
                                  "none is");
    return QDOT_OK;
}

/* --- the table of residuals -------------------------------------------------------------------------- */

static qdot_status
make_residual_table(const qdot_fit *f, const char *name, qdot_row_table **table)
{
    const char **labels = qdot_calloc(1 + f->m, sizeof *labels);
    qdot_text *texts = qdot_calloc(f->m, sizeof *texts);
    size_t j = 0;
    qdot_status status = labels && texts ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < f->columns.n && status == QDOT_OK; i++) {
        if (f->columns.at[i].kind != QDOT_FIT_VALUE)
            continue;
        qdot_text_format(&texts[j], "%s - fit", f->columns.at[i].label);
        status = qdot_text_status(&texts[j]);
        labels[1 + j] = qdot_text_str(&texts[j]);
        j++;
    }
    if (status == QDOT_OK) {
        labels[0] = "t";
        *table = qdot_row_table_new(name, 1, 1 + f->m, labels);
        status = *table ? QDOT_OK : QDOT_ENOMEM;
    }
    for (size_t i = 0; texts && i < f->m; i++)
        qdot_text_clear(&texts[i]);
    qdot_free(texts);
    qdot_free(labels);
    for (size_t i = 0; i < f->rows && status == QDOT_OK; i++) {
        status = qdot_row_table_add(*table);
        if (status != QDOT_OK)
            break;
        (*table)->values[i * (1 + f->m)] = f->t[i];
        (*table)->errors[i * (1 + f->m)] = 0;
        for (size_t l = 0; l < f->m; l++) {
            (*table)->values[i * (1 + f->m) + 1 + l] = f->y[i * f->m + l] - f->fitted[i * f->m + l];
            (*table)->errors[i * (1 + f->m) + 1 + l] = f->weighted ? f->sigma[i * f->m + l] : 0;
        }
    }
    if (status == QDOT_OK)
        (*table)->measured = true;
    return status;
}

qdot_status
qdot_fit_tell(qdot_fit *f)
{
    const char *name = f->name != NULL ? f->name : "residuals";
    qdot_row_table *table = NULL;
    qdot_status status = make_residual_table(f, name, &table);

    if (status != QDOT_OK) {
        qdot_row_table_release(table);
        return status;
    }
    QDOT_TRY(qdot_row_tables_keep(f->session, table));
    QDOT_TRY(f->session->output->json ? answer_fit_as_json(f) : answer_fit_as_text(f, name));
    return give_notices(f);
}
