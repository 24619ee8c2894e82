/* report-work.c -- adds a work-precision study of a run to the page of a report: a figure and a table. */
#include "lang/files/report-work.h"

#include <math.h>
#include <string.h>

#include "base/number-text.h"
#include "lang/files/report-answer.h"
#include "lang/session/conditions.h"
#include "lang/session/measured.h"
#include "show/animation.h"
#include "show/page-curves.h"
#include "table/html.h"

/* The relative error attached to a number so that two digits are shown. */
static const double shown = 0.005;

static qdot_status
add_work_table(const qdot_workprecision *w, qdot_text *page)
{
    static const qdot_table_column columns[] = {
        {.name = "method", .kind = QDOT_CELL_TEXT},
        {.name = "tol", .form = QDOT_NUMBER_MEASURED},
        {.name = "error", .form = QDOT_NUMBER_MEASURED},
        {.name = "median time, s", .form = QDOT_NUMBER_MEASURED},
        {.name = "evaluations", .form = QDOT_NUMBER_FIXED},
        {.name = "", .kind = QDOT_CELL_TEXT}};
    qdot_dataset t = {0};
    qdot_status status = qdot_table_begin(&t, sizeof columns / sizeof *columns, columns);

    for (size_t i = 0; i < w->n && status == QDOT_OK; i++) {
        const qdot_workprecision_row *r = &w->rows[i];
        const double numbers[] = {r->tol, r->err, r->time_median};

        qdot_table_add_text(&t, r->method);
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
            qdot_table_add_number(&t, isfinite(numbers[k]) ? numbers[k] : NAN, shown * fabs(numbers[k]));
        qdot_table_add_number(&t, (double)r->evals, 0);
        qdot_table_add_text(&t, strcmp(r->status, "done") == 0 ? "" : r->status);
    }
    if (status == QDOT_OK)
        status = qdot_table_html_part(&t, page);
    qdot_table_clear(&t);
    return status;
}

static void
add_explanation(const qdot_workprecision *w, qdot_text *page)
{
    qdot_text_add(page, "<p>Errors against a reference whose own error is ");
    qdot_number_text_bound(page, w->ref_err);
    qdot_text_add(page, ".");
    for (size_t i = 0; i < w->left_out.n; i++) {
        qdot_text_format(page, " Method %s is left out: ", w->left_out.at[i].method);
        qdot_animation_escape(page, w->left_out.at[i].reason);
        qdot_text_char(page, '.');
    }
    qdot_text_add(page, "</p>\n");
}

/* Add a figure of the work-precision study with one curve for each method, whose rows follow one another. */
static qdot_status
add_figure(const qdot_workprecision *w, qdot_text *page)
{
    double *x = qdot_calloc(w->n + 1, sizeof *x), *y = qdot_calloc(w->n + 1, sizeof *y);
    qdot_vec(qdot_page_points) list = {0};
    qdot_status status = x == NULL || y == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < w->n && status == QDOT_OK; i++) {
        x[i] = w->rows[i].time_median;
        y[i] = w->rows[i].err;
        if (i == 0 || strcmp(w->rows[i].method, w->rows[i - 1].method) != 0)
            status = qdot_vec_push(
                &list, ((qdot_page_points){w->rows[i].method, 0, x + i, y + i}));
        if (status == QDOT_OK)
            list.at[list.n - 1].n++;
    }
    if (status == QDOT_OK)
        qdot_page_log_log(page, "error at the end against the time of the integration",
                          "CPU time in s", "error", list.n, list.at);
    qdot_free(list.at);
    qdot_free(x);
    qdot_free(y);
    return status;
}

/* Copy the conditions of a run; if it failed or was interrupted, only up to the time that it reached. */
static qdot_status
copy_conditions_of_run(qdot_session *session, const qdot_named_run *run, qdot_conditions *c)
{
    const qdot_run_report *r = qdot_run_get_report(run->run);
    const qdot_run_request request = qdot_conditions_request(run->conditions);

    QDOT_TRY(qdot_conditions_take(session->scene, &request, c));
    if (r->status != QDOT_RUN_FAILED && !r->interrupted)
        return QDOT_OK;
    c->t1 = qdot_measured_rational(session->pool, r->t1);
    return qdot_pool_check(session->pool);
}

/* Find or make the work-precision study for these conditions, and take them over; *known: it was made before. */
static qdot_status
find_study(qdot_session *session, qdot_conditions *c, bool *known,
           const qdot_workprecision **study)
{
    const qdot_run_request request = qdot_conditions_request(c);
    qdot_workprecision w = {0};
    qdot_status status;

    *study = qdot_studies_find(session->studies, c);
    *known = *study != NULL;
    if (*known)
        return QDOT_OK;
    status = qdot_workprecision_measure(session->scene, &request, &w);
    if (status == QDOT_OK && w.interrupted)
        status = qdot_fail(QDOT_EINTR, "interrupted: no report is written");
    if (status == QDOT_OK) {
        status = qdot_studies_keep(session->studies, c, &w);
        if (status == QDOT_OK)
            *study = &session->studies->at[session->studies->n - 1].measured;
    }
    qdot_workprecision_clear(&w);
    return status;
}

static qdot_status
add_work_precision_study(qdot_session *session, const qdot_named_run *run, bool named, qdot_text *page)
{
    qdot_conditions c = {0};
    const qdot_workprecision *study = NULL;
    bool known = false;
    qdot_status status = copy_conditions_of_run(session, run, &c);

    if (status == QDOT_OK)
        status = find_study(session, &c, &known, &study);
    qdot_conditions_clear(&c);
    QDOT_TRY(status);
    if (named) {
        qdot_text_add(page, "<h3>As ");
        qdot_animation_escape(page, run->name);
        qdot_text_add(page, "</h3>\n");
    }
    QDOT_TRY(add_figure(study, page));
    QDOT_TRY(add_work_table(study, page));
    add_explanation(study, page);
    if (known)
        qdot_text_add(page, "<p>Measured earlier in this session, with the same values, start "
                            "and limits.</p>\n");
    return QDOT_OK;
}

/* Whether an earlier run of the list has the same conditions as run i, so that its study is on the page already. */
static bool
has_conditions_of_earlier(size_t i, const qdot_named_run *const *runs)
{
    for (size_t k = 0; k < i; k++)
        if (qdot_conditions_same(runs[k]->conditions, runs[i]->conditions))
            return true;
    return false;
}

qdot_status
qdot_report_work(qdot_session *session, size_t n, const qdot_named_run *const *runs,
                 qdot_text *page)
{
    bool differ = false;

    qdot_report_heading(page, "Error against computing time");
    for (size_t i = 1; i < n; i++)
        differ = differ || !has_conditions_of_earlier(i, runs);
    for (size_t i = 0; i < n; i++)
        if (!has_conditions_of_earlier(i, runs))
            QDOT_TRY(add_work_precision_study(session, runs[i], differ, page));
    return QDOT_OK;
}
