/* report-work.c -- work and precision on the page of a report: a figure and a table. */
#include "lang/files/report-work.h"

#include <math.h>
#include <string.h>

#include "lang/answer/number-text.h"
#include "lang/runs/request.h"
#include "lang/session/measured.h"
#include "show/animation.h"
#include "show/page.h"
#include "sim/study/workprecision.h"

static void
add_cell(qdot_text *page, double x)
{
    qdot_text_add(page, "<td>");
    if (isfinite(x))
        qdot_text_double(page, x, 3);
    else
        qdot_text_add(page, "\xe2\x80\x93");
    qdot_text_add(page, "</td>");
}

static void
add_table(const qdot_workprecision *w, qdot_text *page)
{
    qdot_text_add(page, "<table>\n<tr><th>method</th><th>tol</th><th>error</th>"
                        "<th>median time, s</th><th>evaluations</th><th></th></tr>\n");
    for (size_t i = 0; i < w->n; i++) {
        const qdot_workprecision_row *r = &w->rows[i];

        qdot_text_add(page, "<tr><td>");
        qdot_animation_escape(page, r->method);
        qdot_text_add(page, "</td>");
        add_cell(page, r->tol);
        add_cell(page, r->err);
        add_cell(page, r->time_median);
        add_cell(page, (double)r->evals);
        qdot_text_add(page, "<td>");
        qdot_animation_escape(page, strcmp(r->status, "done") == 0 ? "" : r->status);
        qdot_text_add(page, "</td></tr>\n");
    }
    qdot_text_add(page, "</table>\n<p>Errors against a reference whose own error is ");
    qdot_number_text_bound(page, w->ref_err);
    qdot_text_add(page, ".</p>\n");
}

/* A curve for each method; its rows are together. */
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
        qdot_page_log_log(page, "error against CPU time in s, both by powers of ten",
                          list.n, list.at);
    qdot_free(list.at);
    qdot_free(x);
    qdot_free(y);
    return status;
}

qdot_status
qdot_report_work(qdot_session *session, const qdot_run_report *report, qdot_text *page)
{
    qdot_request order = {0};
    qdot_workprecision w = {0};
    qdot_status status = qdot_request_fill(session, &order);

    if (status == QDOT_OK) {
        order.request.t0 = qdot_measured_rational(session->pool, report->t0);
        order.request.t1 = qdot_measured_rational(session->pool, report->t1);
        status = qdot_pool_check(session->pool);
    }
    if (status == QDOT_OK)
        status = qdot_workprecision_measure(session->scene, &order.request, &w);
    if (status == QDOT_OK)
        status = add_figure(&w, page);
    if (status == QDOT_OK)
        add_table(&w, page);
    qdot_workprecision_clear(&w);
    qdot_request_free(&order);
    return status;
}
