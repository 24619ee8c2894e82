/* report-page.c -- the statement `report`: scene, derivation, runs and script on one page. */
#include <string.h>

#include "expr/node.h"
#include "lang/answer/answer.h"
#include "lang/declare/scene-file.h"
#include "lang/files/report-answer.h"
#include "lang/files/report-run.h"
#include "lang/files/report-work.h"
#include "lang/session/phase.h"
#include "lang/session/runs.h"
#include "lang/session/text-list.h"
#include "lang/syntax/record.h"
#include "lang/syntax/statement.h"
#include "mech/study/noether.h"
#include "show/page.h"
#include "show/pdf.h"

static qdot_status carry_out_report(qdot_record *r);

#define OPTIONS "report [RUN, ...] [title TEXT] [workprecision] "
#define FILES "to \"FILE.html\"|\"FILE.pdf\""

QDOT_STATEMENT(report) = {
    .word = "report",
    .group = QDOT_WORKBENCH,
    .usage = OPTIONS FILES,
    .displayed = OPTIONS "[" FILES "]",
    .summary = "everything as one page: scene, derivation, conserved quantities, equilibria, run with its "
               "error, curves, moving picture, script; several runs are compared",
    .example = "report to \"x.html\"",
    .form = "report to \"x.html\"",
    .handler = carry_out_report,
};

enum { LONGEST = 4000000 };

typedef struct {
    qdot_cursor *c;
    qdot_session *session;
    size_t n; /* number of runs on the page; 0: no run was made */
    const qdot_named_run *runs[QDOT_REPORT_RUNS];
    bool work; /* include a work-precision table for the methods */
    qdot_text page;
} page;

/* --- sections of the page ----------------------------------------------------------- */

static qdot_status
add_answer(page *p, const char *title, const qdot_statement *statement)
{
    qdot_text text = {0};
    qdot_status status = qdot_report_answer_of(p->c, statement, &text);

    qdot_report_heading(&p->page, title);
    if (text.n > LONGEST)
        qdot_text_format(&p->page, "<p>Left out: %zu characters.</p>\n", text.n);
    else
        qdot_text_add_n(&p->page, qdot_text_str(&text), text.n);
    p->page.failed = p->page.failed || text.failed;
    qdot_text_clear(&text);
    return status;
}

static qdot_status
add_scene(page *p)
{
    qdot_text text = {0};
    qdot_status status = qdot_scene_file_list(p->session, &text);

    qdot_report_heading(&p->page, "The system");
    if (status == QDOT_OK)
        qdot_page_verbatim(&p->page, qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

static qdot_status
add_conserved(page *p)
{
    qdot_session *s = p->session;
    qdot_expr list = QDOT_NIL;
    qdot_report_answer k;
    qdot_status status = qdot_phase_begin(s, false);

    if (status == QDOT_OK) {
        list = qdot_noether_conserved(s->scene);
        status = qdot_pool_check(s->pool);
    }
    qdot_phase_end(s);
    QDOT_TRY(qdot_grave(status));
    qdot_report_heading(&p->page, "Conserved quantities");
    if (status != QDOT_OK)
        return qdot_report_not_found(&p->page);
    if (qdot_expr_count(s->pool, list) == 0)
        return qdot_report_line(&p->page, "None was found.");
    QDOT_TRY(qdot_report_answer_begin(s, QDOT_MATHML, &k));
    for (uint32_t i = 0; i < qdot_expr_count(s->pool, list) && status == QDOT_OK; i++)
        status = qdot_answer_expr(s, NULL, qdot_expr_arg(s->pool, list, i));
    return qdot_report_answer_end(s, &k, status, &p->page);
}

/* Add the script as it was read; for statements typed at the prompt, statements with the same effect. */
static qdot_status
add_script(page *p)
{
    const qdot_session *s = p->session;
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    qdot_report_heading(&p->page, "The script");
    if (s->including->n > 0 && strcmp(s->including->at[s->including->n - 1], "-") != 0) {
        qdot_page_verbatim(&p->page, p->c->source->text);
        return QDOT_OK;
    }
    status = qdot_scene_file_text(p->session, QDOT_FILE_SESSION, &text);
    if (status == QDOT_OK)
        qdot_page_verbatim(&p->page, qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

/* The runs, each in the scene of the runs: the phase space where H alone is stated. */
static qdot_status
add_runs(page *p)
{
    qdot_status status = qdot_phase_begin(p->session, false);

    if (status == QDOT_OK)
        status = qdot_report_runs(p->session, p->n, p->runs, &p->page);
    qdot_phase_end(p->session);
    return status;
}

static qdot_status
write_sections(page *p)
{
    QDOT_TRY(add_scene(p));
    QDOT_TRY(add_answer(p, "Equations of motion, step by step", qdot_statement_find("derive")));
    QDOT_TRY(add_conserved(p));
    QDOT_TRY(add_answer(p, "Equilibria and their stability", qdot_statement_find("equilibria")));
    if (p->n > 0) {
        QDOT_TRY(add_runs(p));
        if (p->work)
            QDOT_TRY(qdot_report_work(p->session, p->n, p->runs, &p->page));
    } else {
        qdot_report_heading(&p->page, "The motion");
        qdot_text_add(&p->page, "<p>No run was made.</p>\n");
    }
    return add_script(p);
}

/* --- the statement `report` --------------------------------------------------------- */

/* Fail if the statement `report` names more runs than one page can compare. */
static qdot_status
check_number_of_runs(qdot_record *r)
{
    size_t n = 0;

    for (const qdot_filled *part = qdot_record_hole(r, NULL, "RUN"); part != NULL;
         part = qdot_record_next(r, part, "RUN")) {
        qdot_record_blame(r, part);
        if (++n > QDOT_REPORT_RUNS)
            return qdot_fail(QDOT_EINVAL, "a report compares %d runs at most", QDOT_REPORT_RUNS);
    }
    return QDOT_OK;
}

/* Find the runs named in the statement, otherwise the latest run; it is no failure if there is none. */
static qdot_status
find_runs(qdot_record *r, page *p)
{
    QDOT_TRY(check_number_of_runs(r));
    for (const qdot_filled *part = qdot_record_hole(r, NULL, "RUN"); part != NULL;
         part = qdot_record_next(r, part, "RUN")) {
        qdot_named_run *run;
        const char *name;

        QDOT_TRY(qdot_record_name(r, part, &name));
        QDOT_TRY(qdot_record_no_prime(r, part, "`,` or `to`"));
        qdot_record_blame(r, part);
        QDOT_TRY(qdot_runs_find(p->session, name, &run));
        for (size_t i = 0; i < p->n; i++)
            if (p->runs[i] == run)
                return qdot_fail(QDOT_EINVAL, "run `%s` is named twice", name);
        p->runs[p->n++] = run;
    }
    if (p->n == 0 && p->session->runs->n > 0) {
        qdot_named_run *run;

        QDOT_TRY(qdot_runs_find(p->session, NULL, &run));
        p->runs[p->n++] = run;
    }
    return QDOT_OK;
}

/* Add the script's name without its folder and ending. */
static void
add_title(const qdot_session *s, qdot_text *title)
{
    const char *script = s->including->n > 0 ? s->including->at[s->including->n - 1] : "-";
    const char *slash = strrchr(script, '/'), *name = slash != NULL ? slash + 1 : script;
    size_t n = strlen(name);

    if (strcmp(name, "-") == 0)
        qdot_text_add(title, "Report");
    else
        qdot_text_add_n(title, name, qdot_ends_in(name, ".lag") ? n - 4 : n);
}

static qdot_status
make_page(page *p, const char *given)
{
    qdot_text title = {0};
    qdot_status status;

    if (given != NULL)
        qdot_text_add(&title, given);
    else
        add_title(p->session, &title);
    qdot_page_begin(&p->page, qdot_text_str(&title));
    status = qdot_text_status(&title);
    qdot_text_clear(&title);
    if (status == QDOT_OK)
        status = write_sections(p);
    qdot_page_end(&p->page);
    return status == QDOT_OK ? qdot_text_status(&p->page) : status;
}

static qdot_status
carry_out_report(qdot_record *r)
{
    const qdot_filled *title = qdot_record_hole(r, "title", NULL);
    const qdot_filled *file = qdot_record_hole(r, "to", NULL);
    const char *path = file != NULL ? qdot_record_text(file) : NULL;
    const bool pdf = path != NULL && qdot_ends_in(path, ".pdf");
    page p = {.c = &r->cursor, .session = r->cursor.session, .work = qdot_record_word(r, "workprecision") != NULL};
    qdot_status status;

    r->cursor.error_at = r->start->start;
    if (path != NULL && !pdf && !qdot_ends_in(path, ".html")) {
        (void)qdot_fail(QDOT_EINVAL, "`%.200s` does not say which kind of page to write", path);
        return qdot_hint("end its name in .html or .pdf");
    }
    if (p.session->scene->coordinates.n == 0) {
        (void)qdot_fail(QDOT_EINVAL,
                        "there is nothing to report: no coordinate is declared");
        return qdot_hint("coord theta");
    }
    QDOT_TRY(find_runs(r, &p));
    r->cursor.error_at = r->start->start;
    if (p.work && p.n == 0)
        return qdot_fail(QDOT_EINVAL,
                         "`workprecision` measures the time of a run: there is none");
    status = make_page(&p, title != NULL ? qdot_record_text(title) : NULL);
    if (status == QDOT_OK && pdf) {
        status = qdot_pdf_print(qdot_text_str(&p.page), p.page.n, path);
        if (status == QDOT_OK)
            status = qdot_answer_file(p.session, path);
    } else if (path == NULL) {
        status = qdot_answer_shown(p.session, "page", "text/html", "report", status, &p.page);
    } else if (status == QDOT_OK) {
        status = qdot_answer_in_file(p.session, path, &p.page);
    }
    qdot_text_clear(&p.page);
    return status;
}
