/* script-file.c -- runs scripts from files, with their exit status. */
#include <string.h>
#include <sys/stat.h>

#include "lang/answer/answer.h"
#include "lang/session/outcome.h"
#include "lang/session/text-list.h"
#include "lang/source/source.h"
#include "lang/syntax/mention.h"
#include "lang/workbench/script.h"
#include "parallel/ranks.h"

enum { FILE_LIMIT = 1 << 28, INCLUDE_LIMIT = 100 };

static int
find_exit_status(qdot_session *session, qdot_status status)
{
    session->outcome->failed = status != QDOT_OK;
    if (status != QDOT_OK)
        return status == QDOT_ESYNTAX ? 2 : 1;
    return session->outcome->refuted ? 1 : 0;
}

int
qdot_script_run_text(qdot_session *session, const char *name, const char *text,
                     size_t length)
{
    return qdot_script_run_part(session, name, 0, text, length);
}

int
qdot_script_run_part(qdot_session *session, const char *name, uint32_t before, const char *text, size_t length)
{
    return find_exit_status(session, qdot_script_carry_out(session, name, before, text, length));
}

static qdot_status
read_script_file(const char *path, qdot_text *text)
{
    bool standard = strcmp(path, "-") == 0;
    FILE *file = standard ? stdin : fopen(path, "rb");
    const qdot_status status = qdot_ranks_read(text, file, path, FILE_LIMIT);

    if (file != NULL && !standard)
        fclose(file);
    return status;
}

/* Whether the file is one of those being read already, so that it would include itself. */
static bool
is_script_being_read(const qdot_session *session, const char *path)
{
    struct stat info, other;

    if (stat(path, &info) != 0)
        return false;
    for (size_t i = 0; i < session->including->n; i++)
        if (stat(session->including->at[i], &other) == 0 && info.st_dev == other.st_dev &&
            info.st_ino == other.st_ino)
            return true;
    return false;
}

qdot_status
qdot_script_carry_out_file(qdot_session *session, const char *path, bool *opened)
{
    bool standard = strcmp(path, "-") == 0;
    qdot_text text = {0};
    qdot_status status;
    char *own;

    *opened = false;
    if (!standard && is_script_being_read(session, path))
        return qdot_fail(QDOT_EINVAL, "`%s` includes itself", path);
    if (session->including->n >= INCLUDE_LIMIT)
        return qdot_fail(QDOT_ELIMIT, "more than %d scripts include one another",
                         INCLUDE_LIMIT);
    own = qdot_strdup(path);
    if (own == NULL)
        return QDOT_ENOMEM;
    status = qdot_vec_push(session->including, own);
    if (status != QDOT_OK) {
        qdot_free(own);
        return status;
    }
    status = read_script_file(path, &text);
    if (status == QDOT_OK) {
        *opened = true;
        status = qdot_script_carry_out(session, standard ? "standard input" : path, 0,
                                       qdot_text_str(&text), text.n);
    }
    qdot_text_clear(&text);
    qdot_free(session->including->at[--session->including->n]);
    return status;
}

int
qdot_script_run_file(qdot_session *session, const char *path)
{
    bool opened;
    qdot_status status = qdot_script_carry_out_file(session, path, &opened);

    if (status != QDOT_OK && !opened)
        qdot_answer_error(session, NULL, 0);
    return find_exit_status(session, status);
}

bool
qdot_script_takes_long(const char *text, size_t length)
{
    qdot_source *source = NULL;
    bool found = false;
    size_t at;

    if (qdot_source_new("", text, length, &source, &at) != QDOT_OK) {
        qdot_source_free(source);
        return false; /* the text cannot be split into tokens, so reading it will report an error */
    }
    for (qdot_mention m = qdot_mention_in(source->tokens.at, source->tokens.at + source->tokens.n);
         !found && qdot_mention_next(&m);)
        found = m.begins && m.row != NULL &&
                (strcmp(m.row->group, "numbers") == 0 || strcmp(m.row->word, "include") == 0);
    qdot_source_free(source);
    return found;
}

bool
qdot_script_is_incomplete(const char *text, size_t length)
{
    int64_t open = 0;
    bool more = false; /* the line ends in a backslash */

    for (size_t i = 0; i < length; i++) {
        char c = text[i];

        if (c == '"') {
            for (i++; i < length && text[i] != '"' && text[i] != '\n'; i++)
                i += text[i] == '\\';
            more = false;
        } else if (c == '#') {
            while (i < length && text[i] != '\n')
                i++;
        } else if (c == '\\') {
            more = true;
        } else if (c != ' ' && c != '\t' && c != '\r' && c != '\n') {
            more = false;
            open += c == '(' || c == '[' || c == '{';
            open -= c == ')' || c == ']' || c == '}';
        }
    }
    return open > 0 || more;
}
