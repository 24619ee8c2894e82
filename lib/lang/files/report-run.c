/* report-run.c -- runs on the page of a report: how they went, their curves and moving pictures. */
#include "lang/files/report-run.h"

#include <math.h>

#include "base/number-text.h"
#include "lang/answer/report.h"
#include "lang/figures/animated.h"
#include "lang/files/report-answer.h"
#include "show/page-curves.h"
#include "show/page.h"

enum { CURVES = 12 };

/* The runs of a page, each with its moving picture. */
typedef struct {
    qdot_session *session;
    size_t n;
    const qdot_named_run *const *runs;
    qdot_animation *pictures; /* [n] */
    qdot_text *page;
} sections;

/* Which run this is, where there are several. */
static void
add_name(const sections *s, size_t i)
{
    if (s->n == 1)
        return;
    qdot_text_add(s->page, "<h3>");
    qdot_animation_escape(s->page, s->runs[i]->name);
    qdot_text_add(s->page, "</h3>\n");
}

/* The facts of a run, as below a moving picture, and how it ended. */
static qdot_status
add_run(const sections *s, size_t i)
{
    const qdot_animation *a = &s->pictures[i];
    qdot_text text = {0};
    qdot_report_answer k;
    qdot_status status;

    add_name(s, i);
    qdot_text_add(s->page, "<dl class=\"run\">\n");
    for (size_t f = 0; f < a->facts.n; f++) {
        qdot_text_add(s->page, "<dt>");
        qdot_animation_escape(s->page, a->facts.at[f].name);
        qdot_text_add(s->page, "</dt><dd>");
        qdot_animation_escape(s->page, a->facts.at[f].text);
        qdot_text_add(s->page, "</dd>\n");
    }
    qdot_text_add(s->page, "</dl>\n");
    QDOT_TRY(qdot_report_answer_begin(s->session, QDOT_UNICODE, &k));
    status = qdot_report_answer_end(s->session, &k,
                                    qdot_report_run(s->session, s->runs[i]->name,
                                                    qdot_run_get_report(s->runs[i]->run)),
                                    &text);
    if (status == QDOT_OK)
        qdot_page_verbatim(s->page, qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

/* --- the table of several ------------------------------------------------------------- */

static void
run_add_cell(qdot_text *page, double x, bool bound)
{
    qdot_text_add(page, "<td>");
    if (!isfinite(x))
        qdot_text_add(page, "\u2013");
    else if (bound)
        qdot_number_text_bound(page, x);
    else
        qdot_number_text(page, x, 0.0005 * fabs(x));
    qdot_text_add(page, "</td>");
}

static void
add_table(const sections *s)
{
    static const char *const ends[] = {[QDOT_RUN_DONE] = "done",
                                       [QDOT_RUN_STOPPED] = "stopped",
                                       [QDOT_RUN_FAILED] = "failed"};

    qdot_text_add(s->page,
                  "<h3>Side by side</h3>\n<table>\n<tr><th>run</th><th>method</th>"
                  "<th>tol</th><th>end</th><th>steps</th><th>evaluations</th><th>time, "
                  "s</th><th>error at the end</th><th>drift of the energy</th><th></th>"
                  "</tr>\n");
    for (size_t i = 0; i < s->n; i++) {
        const qdot_run_report *r = qdot_run_get_report(s->runs[i]->run);

        qdot_text_add(s->page, "<tr><td>");
        qdot_animation_escape(s->page, s->runs[i]->name);
        qdot_text_format(s->page, "</td><td>%s</td>", r->method);
        run_add_cell(s->page, r->tol, false);
        run_add_cell(s->page, r->t1, false);
        qdot_text_format(s->page, "<td>%zu</td><td>%zu</td>", r->steps, r->evals);
        qdot_text_add(s->page, "<td>");
        qdot_text_double(s->page, r->cpu, 2);
        qdot_text_add(s->page, "</td>");
        run_add_cell(s->page, r->error, true);
        run_add_cell(s->page, r->energy_drift, true);
        qdot_text_format(s->page, "<td>%s</td></tr>\n", ends[r->status]);
    }
    qdot_text_add(s->page, "</table>\n");
}

/* --- curves and pictures ---------------------------------------------------------------- */

static void
add_curves(const sections *s)
{
    const qdot_animation *first = &s->pictures[0];
    const size_t all = s->session->scene->coordinates.n;

    qdot_report_heading(s->page, "Course");
    for (size_t k = 0; k < first->states.n && k < CURVES; k++) {
        qdot_page_course list[QDOT_REPORT_RUNS];

        for (size_t i = 0; i < s->n; i++) {
            const qdot_animation *a = &s->pictures[i];

            list[i] = (qdot_page_course){s->runs[i]->name, a->t0, a->t1, a->frames,
                                         a->values + a->states.at[k].q * a->frames};
        }
        qdot_page_courses(s->page, first->states.at[k].name, s->n, list);
    }
    if (all > CURVES)
        qdot_text_format(s->page, "<p>The other %zu coordinates are left out.</p>\n",
                         all - CURVES);
}

static void
add_pictures(const sections *s)
{
    qdot_report_heading(s->page, s->n > 1 ? "Moving pictures" : "Moving picture");
    for (size_t i = 0; i < s->n; i++) {
        qdot_animation *a = &s->pictures[i];

        add_name(s, i);
        for (size_t f = 0; f < a->facts.n; f++)
            qdot_free(a->facts.at[f].text);
        a->facts.n = 0; /* they stand above */
        qdot_animation_section(a, s->page);
    }
}

qdot_status
qdot_report_runs(qdot_session *session, size_t n, const qdot_named_run *const *runs,
                 qdot_text *page)
{
    const bool bare = session->scene->particles.n + session->scene->bodies.n == 0;
    const qdot_animated_options all = {NAN, NAN, NULL, NAN, NAN, bare};
    qdot_animation pictures[QDOT_REPORT_RUNS] = {{0}};
    const sections s = {session, n, runs, pictures, page};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        status = qdot_animated_make(session, runs[i], &all, &pictures[i]);
    if (status == QDOT_OK)
        qdot_report_heading(page, n > 1 ? "Runs" : "Run");
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        status = add_run(&s, i);
    if (status == QDOT_OK) {
        if (n > 1)
            add_table(&s);
        add_curves(&s);
        if (!bare)
            add_pictures(&s);
    }
    for (size_t i = 0; i < n; i++)
        qdot_animation_clear(&pictures[i]);
    return status;
}
