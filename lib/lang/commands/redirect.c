/* redirect.c -- `to FILE` behind a statement that answers: its answers go there.
 *
 * The answers are kept in memory till the statement has ended well; only then is the file
 * written. Notices and errors stay where they always go.
 */
#include "lang/commands/redirect.h"

#include <stdlib.h>
#include <string.h>

#include "base/spelling.h"
#include "lang/answer/answer.h"
#include "lang/commands/scene-file.h"
#include "show/sink.h"

static const struct {
    const char *ending;
    bool json;
} endings[] = {{".txt", false}, {".tex", false}, {".json", true}};

/* Statements of other groups that answer; those not here read a `to` of their own, or
 * have nothing to say. */
static bool
answers(const qdot_statement *row)
{
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
qdot_redirect_find(const qdot_statement *row, const qdot_token *first)
{
    const qdot_token *end = first;

    if (!answers(row))
        return NULL;
    while (end->kind != QDOT_TOKEN_END)
        end++;
    if (end - first < (row == NULL ? 3 : 2) || end[-1].kind != QDOT_TOKEN_STRING ||
        end[-2].kind != QDOT_TOKEN_NAME || strcmp(end[-2].text, "to") != 0 ||
        (row != NULL && strcmp(row->word, "scene") == 0 && qdot_scene_file_is(end - 1)))
        return NULL;
    return end - 2;
}

/* Endings that figures and tables, or answers of a later version, have. */
static bool
is_of_the_language(const char *ending)
{
    static const char *const words[] = {".svg", ".png", ".pdf", ".html", ".csv", ".h5"};

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(ending, words[i]) == 0)
            return true;
    return false;
}

qdot_status
qdot_redirect_begin(qdot_redirect *r, qdot_session *session, const char *path)
{
    const char *dot = strrchr(path, '.');
    const char *ending = dot == NULL || strchr(dot, '/') != NULL ? "" : dot;
    qdot_spelling nearest;

    *r = (qdot_redirect){.session = session, .path = path};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        if (strcmp(ending, endings[i].ending) != 0)
            continue;
        r->file = open_memstream(&r->text, &r->length);
        if (r->file == NULL)
            return qdot_fail(QDOT_ENOMEM, "no memory for what goes to `%s`", path);
        r->out = session->out;
        r->json = session->json;
        r->console = session->console;
        if (r->console == NULL) {
            session->console = r->out;
            session->console_json = r->json;
        }
        session->out = r->file;
        session->json = endings[i].json;
        return QDOT_OK;
    }
    if (!is_of_the_language(ending)) {
        (void)qdot_fail(QDOT_EINVAL, "`%.200s`: the name of a file ends in what it is to be",
                        path);
        qdot_spelling_begin(&nearest, ending);
        for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
            qdot_spelling_offer(&nearest, endings[i].ending);
        return nearest.best != NULL && ending[0] != '\0'
                   ? qdot_hint("did you mean `%s`?", nearest.best)
                   : qdot_hint("as in \"a.txt\", \"a.tex\", \"a.json\"");
    }
    (void)qdot_fail(QDOT_ENOTBUILT, "not built yet: this answer in a file `%s`", ending);
    return qdot_hint(
        "`.txt`, `.tex` and `.json` are built; figures and tables: `help plot`, "
        "`help table`");
}

qdot_status
qdot_redirect_end(qdot_redirect *r, qdot_status status)
{
    qdot_session *session = r->session;
    bool complete = fclose(r->file) == 0;

    session->out = r->out;
    session->json = r->json;
    session->console = r->console;
    if (status == QDOT_OK && !complete)
        status = qdot_fail(QDOT_ENOMEM, "no memory for what goes to `%s`", r->path);
    if (status == QDOT_OK)
        status = qdot_sink_write(r->path, r->text, r->length);
    if (status == QDOT_OK)
        status = qdot_answer_file(session, r->path);
    free(r->text); /* from open_memstream */
    return status;
}
