/* report-page.c -- the statement `report`: scene, derivation, run and script as one page. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/answer/formula.h"
#include "lang/answer/report.h"
#include "lang/figures/animated.h"
#include "lang/figures/figure-file.h"
#include "lang/files/report-work.h"
#include "lang/declare/scene-file.h"
#include "lang/commands/statement.h"
#include "lang/language/read.h"
#include "lang/session/runs.h"
#include "mech/study/noether.h"
#include "show/page.h"
#include "show/pdf.h"
#include "show/sink.h"

enum { LONGEST = 4000000, CURVES = 12 };

typedef struct {
    qdot_cursor *c;
    qdot_session *session;
    const qdot_named_run *run; /* NULL: none was made */
    bool work;                 /* with work and precision */
    qdot_text page;
} page;

/* --- answers ------------------------------------------------------------------------ */

/* What stays of a session while an answer is taken down. */
typedef struct {
    FILE *out, *console, *file;
    bool json, console_json, marked;
    qdot_style style;
    size_t history, history_over;
    char *text;
    size_t length;
} kept;

static qdot_status
begin_answer(qdot_session *s, qdot_style style, kept *k)
{
    *k = (kept){.out = s->out,
                .console = s->console,
                .json = s->json,
                .marked = s->marked,
                .console_json = s->console_json,
                .style = s->style,
                .history = s->history.n,
                .history_over = s->history_over.n};
    k->file = open_memstream(&k->text, &k->length);
    if (k->file == NULL)
        return qdot_fail(QDOT_ENOMEM, "no memory for the report");
    if (s->console == NULL) {
        s->console = s->out;
        s->console_json = s->json;
    }
    s->out = k->file;
    s->json = false;
    s->style = style;
    s->marked = true;
    return QDOT_OK;
}

/* The answer in `text`, the caller's to clear. A failure other than a grave one is its answer. */
static qdot_status
end_answer(qdot_session *s, kept *k, qdot_status status, qdot_text *text)
{
    bool whole = fclose(k->file) == 0;

    s->out = k->out;
    s->console = k->console;
    s->json = k->json;
    s->console_json = k->console_json;
    s->style = k->style;
    s->marked = k->marked;
    s->history.n = k->history;
    if (s->history_over.n > k->history_over)
        s->history_over.n = k->history_over;
    if (status == QDOT_OK && !whole)
        status = qdot_fail(QDOT_ENOMEM, "no memory for the report");
    if (status == QDOT_OK) {
        qdot_text_add_n(text, k->text, k->length);
    } else if (qdot_grave(status) == QDOT_OK) {
        qdot_text_format(text, "Not found: %s\n", qdot_last_error()->message);
        status = QDOT_OK;
    }
    free(k->text); /* from open_memstream */
    return status;
}

/* What a statement without operands answers. */
static qdot_status
answer_of(page *p, qdot_status (*statement)(qdot_cursor *), qdot_text *text)
{
    qdot_cursor c = *p->c;
    kept k;

    while (c.at->kind != QDOT_TOKEN_END)
        c.at++;
    QDOT_TRY(begin_answer(p->session, QDOT_MATHML, &k));
    return end_answer(p->session, &k, statement(&c), text);
}

/* --- sections ----------------------------------------------------------------------- */

static void
heading(page *p, const char *title)
{
    qdot_text_add(&p->page, "<h2>");
    qdot_animation_escape(&p->page, title);
    qdot_text_add(&p->page, "</h2>\n");
}

static qdot_status
add_answer(page *p, const char *title, qdot_status (*statement)(qdot_cursor *))
{
    qdot_text text = {0};
    qdot_status status = answer_of(p, statement, &text);

    heading(p, title);
    if (text.n > LONGEST)
        qdot_text_format(&p->page, "<p>Left out: %zu characters.</p>\n", text.n);
    else
        qdot_page_lines(&p->page, qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

static qdot_status
add_scene(page *p)
{
    qdot_text text = {0};
    qdot_status status = qdot_scene_print(p->session->scene, &text);

    heading(p, "Scene");
    if (status == QDOT_OK)
        qdot_page_verbatim(&p->page, qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

static qdot_status
add_conserved(page *p)
{
    qdot_session *s = p->session;
    qdot_expr list = qdot_noether_conserved(s->scene);
    qdot_text text = {0};
    kept k;
    qdot_status status = qdot_pool_check(s->pool);

    QDOT_TRY(qdot_grave(status));
    heading(p, "Conserved quantities");
    if (status != QDOT_OK) {
        qdot_text_format(&text, "Not found: %s\n", qdot_last_error()->message);
        status = QDOT_OK;
    } else if (qdot_expr_count(s->pool, list) == 0) {
        qdot_text_add(&text, "None was found.\n");
    } else {
        QDOT_TRY(begin_answer(s, QDOT_MATHML, &k));
        for (uint32_t i = 0; i < qdot_expr_count(s->pool, list) && status == QDOT_OK; i++)
            status = qdot_answer_expr(s, NULL, qdot_expr_arg(s->pool, list, i));
        status = end_answer(s, &k, status, &text);
    }
    qdot_page_lines(&p->page, qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

/* The facts of the run, as below a moving picture, and how it ended. */
static qdot_status
add_run(page *p, const qdot_animation *a)
{
    qdot_text text = {0};
    kept k;
    qdot_status status;

    heading(p, "Run");
    qdot_text_add(&p->page, "<dl class=\"run\">\n");
    for (size_t i = 0; i < a->facts.n; i++) {
        qdot_text_add(&p->page, "<dt>");
        qdot_animation_escape(&p->page, a->facts.at[i].name);
        qdot_text_add(&p->page, "</dt><dd>");
        qdot_animation_escape(&p->page, a->facts.at[i].text);
        qdot_text_add(&p->page, "</dd>\n");
    }
    qdot_text_add(&p->page, "</dl>\n");
    QDOT_TRY(begin_answer(p->session, QDOT_UNICODE, &k));
    status = end_answer(
        p->session, &k,
        qdot_report_run(p->session, p->run->name, qdot_run_get_report(p->run->run)),
        &text);
    if (status == QDOT_OK)
        qdot_page_verbatim(&p->page, qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

static void
add_curves(page *p, const qdot_animation *a)
{
    heading(p, "Course");
    for (size_t i = 0; i < a->states.n && i < CURVES; i++)
        qdot_page_curve(&p->page, a->states.at[i].name, a->t0, a->t1,
                        a->values + a->states.at[i].q * a->frames, a->frames);
    if (p->session->scene->coordinates.n > CURVES)
        qdot_text_format(&p->page, "<p>The other %zu coordinates are left out.</p>\n",
                         p->session->scene->coordinates.n - CURVES);
}

/* The run with its curves and, where things have places, its picture. */
static qdot_status
add_motion(page *p)
{
    const qdot_scene *s = p->session->scene;
    const bool bare = s->particles.n + s->bodies.n == 0;
    const qdot_animated_options all = {NAN, NAN, NULL, NAN, NAN, bare};
    qdot_animation a = {0};
    qdot_status status = qdot_animated_make(p->session, p->run, &all, &a);

    if (status == QDOT_OK)
        status = add_run(p, &a);
    if (status == QDOT_OK)
        add_curves(p, &a);
    if (status == QDOT_OK && !bare) {
        heading(p, "Moving picture");
        for (size_t i = 0; i < a.facts.n; i++)
            qdot_free(a.facts.at[i].text);
        a.facts.n = 0; /* they stand above */
        qdot_animation_section(&a, &p->page);
    }
    qdot_animation_clear(&a);
    return status;
}

/* The script as it was read; at the prompt, statements that give the same. */
static qdot_status
add_script(page *p)
{
    const qdot_session *s = p->session;
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    heading(p, "Script");
    if (s->including.n > 0 && strcmp(s->including.at[s->including.n - 1], "-") != 0) {
        qdot_page_verbatim(&p->page, p->c->source->text);
        return QDOT_OK;
    }
    status = qdot_scene_file_text(p->session, true, &text);
    if (status == QDOT_OK)
        qdot_page_verbatim(&p->page, qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

static qdot_status
write_sections(page *p)
{
    QDOT_TRY(add_scene(p));
    QDOT_TRY(add_answer(p, "Derivation", qdot_derive_all));
    QDOT_TRY(add_conserved(p));
    QDOT_TRY(add_answer(p, "Equilibria", qdot_equilibria_all));
    if (p->run != NULL) {
        QDOT_TRY(add_motion(p));
        if (p->work) {
            heading(p, "Work and precision");
            QDOT_TRY(
                qdot_report_work(p->session, qdot_run_get_report(p->run->run), &p->page));
        }
    } else {
        heading(p, "Run");
        qdot_text_add(&p->page, "<p>No run was made.</p>\n");
    }
    return add_script(p);
}

/* --- the statement ------------------------------------------------------------------ */

typedef struct {
    const char *run, *title, *path;
    bool work;
} options;

static qdot_status
read_options(qdot_cursor *c, options *o)
{
    if (c->at->kind == QDOT_TOKEN_NAME && !qdot_cursor_is_word(c, "to") &&
        !qdot_cursor_is_word(c, "title") && !qdot_cursor_is_word(c, "workprecision"))
        QDOT_TRY(qdot_read_name(c, &o->run));
    while (!qdot_cursor_is_end(c)) {
        if (qdot_cursor_accept_word(c, "to")) {
            QDOT_TRY(qdot_figure_file_read(c, &o->path));
        } else if (qdot_cursor_accept_word(c, "workprecision")) {
            QDOT_TRY(qdot_cursor_once(c, "workprecision", o->work));
            o->work = true;
        } else if (qdot_cursor_accept_word(c, "title")) {
            QDOT_TRY(qdot_cursor_once(c, "title", o->title != NULL));
            QDOT_TRY(qdot_figure_title_read(c, &o->title));
        } else {
            return qdot_cursor_expected(
                c, "`title`, `workprecision`, `to` or the end of the statement");
        }
    }
    return o->path != NULL
               ? QDOT_OK
               : qdot_cursor_expected(c, "`to` and the name of a file in quotes");
}

/* The name of the script without its folder and ending. */
static void
add_title(const qdot_session *s, qdot_text *title)
{
    const char *script = s->including.n > 0 ? s->including.at[s->including.n - 1] : "-";
    const char *slash = strrchr(script, '/'), *name = slash != NULL ? slash + 1 : script;
    size_t n = strlen(name);

    if (strcmp(name, "-") == 0)
        qdot_text_add(title, "Report");
    else
        qdot_text_add_n(title, name, qdot_ends_in(name, ".lag") ? n - 4 : n);
}

/* The latest run or the one named; none without a name is no failure. */
static qdot_status
find_run(page *p, const char *name)
{
    qdot_named_run *run;

    if (name == NULL && p->session->runs.n == 0)
        return QDOT_OK;
    QDOT_TRY(qdot_runs_find(p->session, name, &run));
    p->run = run;
    return QDOT_OK;
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

qdot_status
qdot_report_page(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    page p = {.c = c, .session = c->session};
    options o = {0};
    bool pdf;
    qdot_status status;

    QDOT_TRY(read_options(c, &o));
    c->error_at = start->start;
    pdf = qdot_ends_in(o.path, ".pdf");
    if (!pdf && !qdot_ends_in(o.path, ".html")) {
        (void)qdot_fail(QDOT_EINVAL, "`%.200s` does not say what page it is to be",
                        o.path);
        return qdot_hint("end its name in .html or .pdf");
    }
    if (c->session->scene->coordinates.n == 0) {
        (void)qdot_fail(QDOT_EINVAL,
                        "there is nothing to report: no coordinate is declared");
        return qdot_hint("coord theta");
    }
    QDOT_TRY(find_run(&p, o.run));
    p.work = o.work;
    if (p.work && (p.run == NULL || strstr(p.run->text, " with ") != NULL))
        return qdot_fail(QDOT_EINVAL,
                         p.run == NULL
                             ? "`workprecision` measures the time of a run: there is none"
                             : "`workprecision` measures with the values of `set`: not "
                               "a run with values of its own");
    status = make_page(&p, o.title);
    if (status == QDOT_OK && pdf) {
        status = qdot_pdf_print(qdot_text_str(&p.page), p.page.n, o.path);
        if (status == QDOT_OK)
            status = qdot_answer_file(c->session, o.path);
    } else if (status == QDOT_OK) {
        status = qdot_answer_in_file(c->session, o.path, &p.page);
    }
    qdot_text_clear(&p.page);
    return status;
}
