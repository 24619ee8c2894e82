/* redirect.c -- `to FILE` behind a statement that answers: its answers go there.
 *
 * The answers are kept in memory till the statement has ended well; only then is the file
 * written. Notices and errors stay where they always go.
 */
#include "lang/files/redirect.h"

#include <stdlib.h>
#include <string.h>

#include "base/sink.h"
#include "base/spelling.h"
#include "lang/answer/answer.h"
#include "lang/answer/sheet.h"
#include "lang/declare/scene-file.h"
#include "lang/session/output.h"
#include "show/figure.h"

struct qdot_redirect_type {
    const char *ending;
    enum { AS_PRINTED, JSON, PAGE } kind;
    qdot_style style; /* style in which formulas on the page are written */
};

static const struct qdot_redirect_type endings[] = {{".txt", AS_PRINTED, QDOT_PLAIN},
                                                    {".tex", PAGE, QDOT_LATEX},
                                                    {".html", PAGE, QDOT_MATHML},
                                                    {".json", JSON, QDOT_PLAIN}};

bool
qdot_redirect_answers(const qdot_statement *row)
{
    /* statements of other groups with answers to redirect; one not listed parses `to` itself, or has no answer */
    static const char *const words[] = {"run",  "plan", "events", "help",
                                        "show", "vars", "print"};

    if (row == NULL || strcmp(row->group, "asking") == 0)
        return true;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(row->word, words[i]) == 0)
            return true;
    return false;
}

const qdot_token *
qdot_redirect_find(const qdot_statement *row, const qdot_token *first, const qdot_token *to)
{
    if (to == NULL || !qdot_redirect_answers(row) || (row == NULL && to == first) ||
        (row != NULL && strcmp(row->word, "scene") == 0 && qdot_scene_file_is(to[1].text)))
        return NULL;
    return to;
}

/* Fail if formulas cannot be written to a file with this ending, such as that of a figure or table. */
static qdot_status
refuse_file_ending(const char *path, const char *ending)
{
    static const char *const data[] = {".csv", ".h5"};
    qdot_spelling nearest;

    if (qdot_figure_is_file(path) || strcmp(ending, ".gif") == 0) {
        (void)qdot_fail(QDOT_EINVAL, "`%.200s`: a `%s` file is for figures", path, ending);
        return qdot_hint("formulas: \"x.tex\" (LaTeX) or \"x.html\" (MathML); figures: "
                         "`plot ... to \"x%s\"`", ending);
    }
    for (size_t i = 0; i < sizeof data / sizeof *data; i++)
        if (strcmp(ending, data[i]) == 0) {
            (void)qdot_fail(QDOT_EINVAL, "`%.200s`: a `%s` file is for columns of numbers", path,
                            ending);
            return qdot_hint("answers: .tex, .html, .txt, .json; numbers: `table ... every 0.1 to "
                             "\"x%s\"`, `save to \"x%s\"`", ending, ending);
        }
    (void)qdot_fail(QDOT_EINVAL, "`%.200s`: the ending of a file's name says its format", path);
    qdot_spelling_begin(&nearest, ending);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        qdot_spelling_offer(&nearest, endings[i].ending);
    return nearest.best != NULL && ending[0] != '\0'
               ? qdot_hint("did you mean `%s`?", nearest.best)
               : qdot_hint("as in \"a.tex\", \"a.html\", \"a.txt\", \"a.json\"");
}

qdot_status
qdot_redirect_begin(qdot_redirect *r, qdot_session *session, const char *path)
{
    const char *dot = strrchr(path, '.');
    const char *ending = dot == NULL || strchr(dot, '/') != NULL ? "" : dot;

    *r = (qdot_redirect){.session = session, .path = path};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        if (strcmp(ending, endings[i].ending) != 0)
            continue;
        r->file = open_memstream(&r->text, &r->length);
        if (r->file == NULL)
            return qdot_fail(QDOT_ENOMEM, "no memory for what goes to `%s`", path);
        r->out = session->output->out;
        r->json = session->output->json;
        r->console = session->output->console;
        if (r->console == NULL) {
            session->output->console = r->out;
            session->output->console_json = r->json;
        }
        r->type = &endings[i];
        r->style = session->output->style;
        session->output->out = r->file;
        session->output->json = r->type->kind == JSON;
        if (r->type->kind == PAGE) {
            r->page.kind = r->type->style == QDOT_LATEX ? QDOT_PAGE_LATEX : QDOT_PAGE_MATHML;
            session->output->page = &r->page;
            session->output->style = r->type->style;
        }
        return QDOT_OK;
    }
    return refuse_file_ending(path, ending);
}

/* Make a page of the answers that were collected for a file. */
static qdot_status
make_page(qdot_redirect *r, qdot_text *page)
{
    const char *name = strrchr(r->path, '/');

    return r->type->style == QDOT_LATEX
               ? qdot_formula_page_end(&r->page, page)
               : qdot_formula_page_html(&r->page, name == NULL ? r->path : name + 1, page);
}

qdot_status
qdot_redirect_end(qdot_redirect *r, qdot_status status)
{
    qdot_session *session = r->session;
    bool complete, paged = r->type->kind == PAGE;
    qdot_text page = {0};

    if (status == QDOT_OK)
        status = qdot_sheet_flush(session); /* write the collected equations of styles latex and mathml */
    else
        qdot_sheet_forget(session);
    complete = fclose(r->file) == 0;
    session->output->out = r->out;
    session->output->json = r->json;
    session->output->console = r->console;
    if (paged)
        session->output->style = r->style;
    session->output->page = NULL;
    if (status == QDOT_OK && !complete)
        status = qdot_fail(QDOT_ENOMEM, "no memory for what goes to `%s`", r->path);
    if (status == QDOT_OK && paged)
        status = make_page(r, &page);
    if (status == QDOT_OK)
        status = paged ? qdot_sink_write(r->path, qdot_text_str(&page), page.n)
                       : qdot_sink_write(r->path, r->text, r->length);
    if (status == QDOT_OK)
        status = qdot_answer_file(session, r->path);
    qdot_text_clear(&page);
    qdot_formula_page_clear(&r->page);
    free(r->text); /* allocated by open_memstream */
    return status;
}
