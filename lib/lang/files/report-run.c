/* report-run.c -- the runs on the page of a report: their facts, curves and animations. */
#include "lang/files/report-run.h"

#include <math.h>

#include "lang/answer/report.h"
#include "lang/figures/animated.h"
#include "lang/files/report-answer.h"
#include "show/page-curves.h"
#include "show/page.h"
#include "table/html.h"

enum { CURVES = 12 };

/* The runs of a page, each with its animation. */
typedef struct {
    qdot_session *session;
    size_t n;
    const qdot_named_run *const *runs;
    qdot_animation *pictures; /* [n] animation of each run */
    qdot_text *page;
} sections;

/* Add the name of run i to the page, if the page has several runs. */
static void
add_run_name(const sections *s, size_t i)
{
    if (s->n == 1)
        return;
    qdot_text_add(s->page, "<h3>");
    qdot_animation_escape(s->page, s->runs[i]->name);
    qdot_text_add(s->page, "</h3>\n");
}

/* Add the facts of a run, the lines otherwise shown below an animation, and how the run ended. */
static qdot_status
add_run(const sections *s, size_t i)
{
    const qdot_animation *a = &s->pictures[i];
    qdot_text text = {0};
    qdot_report_answer k;
    qdot_status status;

    add_run_name(s, i);
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

/* The relative error attached to a number so that three digits are shown. */
static const double shown = 0.0005;

static void
add_finite_number(qdot_dataset *t, double x)
{
    qdot_table_add_number(t, isfinite(x) ? x : NAN, shown * fabs(x));
}

static qdot_status
add_table_of_runs(const sections *s)
{
    static const char *const ends[] = {[QDOT_RUN_DONE] = "done",
                                       [QDOT_RUN_STOPPED] = "stopped",
                                       [QDOT_RUN_FAILED] = "failed"};
    static const qdot_table_column columns[] = {
        {.name = "run", .kind = QDOT_CELL_TEXT},
        {.name = "method", .kind = QDOT_CELL_TEXT},
        {.name = "tol", .form = QDOT_NUMBER_MEASURED},
        {.name = "end", .form = QDOT_NUMBER_MEASURED},
        {.name = "steps", .form = QDOT_NUMBER_FIXED},
        {.name = "evaluations", .form = QDOT_NUMBER_FIXED},
        {.name = "time, s", .digits = 2},
        {.name = "error at the end", .form = QDOT_NUMBER_BOUND},
        {.name = "drift of the energy", .form = QDOT_NUMBER_BOUND},
        {.name = "", .kind = QDOT_CELL_TEXT}};
    qdot_dataset t = {0};
    qdot_status status = qdot_table_begin(&t, sizeof columns / sizeof *columns, columns);

    for (size_t i = 0; i < s->n && status == QDOT_OK; i++) {
        const qdot_run_report *r = qdot_run_get_report(s->runs[i]->run);

        qdot_table_add_text(&t, s->runs[i]->name);
        qdot_table_add_text(&t, r->method);
        add_finite_number(&t, r->tol);
        add_finite_number(&t, r->t1);
        qdot_table_add_number(&t, (double)r->steps, 0);
        qdot_table_add_number(&t, (double)r->evals, 0);
        add_finite_number(&t, r->cpu);
        add_finite_number(&t, r->error);
        add_finite_number(&t, r->energy_drift);
        qdot_table_add_text(&t, ends[r->status]);
    }
    qdot_text_add(s->page, "<h3>Side by side</h3>\n");
    if (status == QDOT_OK)
        status = qdot_table_html_part(&t, s->page);
    qdot_table_clear(&t);
    return status;
}

/* --- curves and pictures ---------------------------------------------------------------- */

static void
add_figure_of_curves(const sections *s)
{
    const qdot_animation *first = &s->pictures[0];
    const size_t all = s->session->scene->coordinates.n;

    qdot_report_heading(s->page, "Coordinates against time");
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
add_animations(const sections *s)
{
    qdot_report_heading(s->page, s->n > 1 ? "Moving pictures" : "Moving picture");
    for (size_t i = 0; i < s->n; i++) {
        qdot_animation *a = &s->pictures[i];

        add_run_name(s, i);
        for (size_t f = 0; f < a->facts.n; f++)
            qdot_free(a->facts.at[f].text);
        a->facts.n = 0; /* the facts are already printed above the animation */
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
        qdot_report_heading(page, n > 1 ? "The motions" : "The motion");
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        status = add_run(&s, i);
    if (status == QDOT_OK) {
        if (n > 1)
            status = add_table_of_runs(&s);
        add_figure_of_curves(&s);
        if (!bare)
            add_animations(&s);
    }
    for (size_t i = 0; i < n; i++)
        qdot_animation_clear(&pictures[i]);
    return status;
}
