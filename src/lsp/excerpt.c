/* excerpt.c -- the statements of a document that a command wants to be carried out. */
#include <string.h>

#include "lang/analysis/analysis.h"
#include "lang/source/source.h"
#include "lang/syntax/form.h"
#include "lang/syntax/outline.h"
#include "tasks.h"

/* Whether the statement that begins at `first` is left out for the kind of command. *found: it is one that is to be shown. */
static bool
is_left_out(const qdot_analysis *a, const qdot_token *first, const char *kind, bool here, bool *found)
{
    static const char *const outputs[] = {"plot", "animate", "report", "export", "save", "table", "print", "help", "show"};
    const qdot_form form = qdot_statement_form(a->session, first);
    const qdot_statement *row = form == QDOT_FORM_WORD ? qdot_statement_row(first) : NULL;

    if (form == QDOT_FORM_DEFINITION)
        return false;
    if (row == NULL || qdot_statement_asks(row))
        return true;
    if (strcmp(row->word, kind) == 0) {
        *found = *found || here;
        return !here;
    }
    if (strcmp(kind, "equations") == 0)
        return !qdot_statement_declares(row) && strcmp(row->word, "include") != 0 && strcmp(row->word, "set") != 0;
    for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++)
        if (strcmp(row->word, outputs[i]) == 0)
            return true;
    return false;
}

/* Replace the bytes from ... to - 1 by blanks; ends of lines stay. */
static void
blank(char *text, size_t from, size_t to)
{
    for (; from < to; from++)
        if (text[from] != '\n')
            text[from] = ' ';
}

char *
qdot_task_statements(const qdot_analysis *a, const char *kind, int64_t line)
{
    char *text = qdot_strndup(a->text, a->length), *whole;
    const qdot_token *tokens = a->source->tokens.at;
    bool found = false;
    qdot_text behind = {0};
    uint32_t at_line, column;

    if (text == NULL || strcmp(kind, "run") == 0)
        return text;
    for (size_t i = 0; i < a->source->tokens.n;) {
        const qdot_token *first = &tokens[i], *end = qdot_outline_end(first), *to;

        if (first->kind == QDOT_TOKEN_END || qdot_token_is(first, "{")) {
            i++;
            continue;
        }
        i = (size_t)(end - tokens);
        if (qdot_token_is(first, "}"))
            continue;
        qdot_source_locate(a->source, first->start, &at_line, &column);
        to = qdot_outline_file(first);
        if (is_left_out(a, first, kind, line < 0 || at_line == (uint32_t)line + 1, &found))
            blank(text, first->start, end[-1].start + end[-1].length);
        else if (to != NULL && qdot_statement_form(a->session, first) != QDOT_FORM_DEFINITION)
            blank(text, to->start, end[-1].start + end[-1].length); /* it is shown, not written to its file */
        if (line >= 0 && found) { /* what follows is no matter */
            blank(text, end[-1].start + end[-1].length, a->length);
            break;
        }
    }
    qdot_text_add(&behind, text);
    if (strcmp(kind, "equations") == 0)
        qdot_text_add(&behind, "\neom\n");
    else if (!found && strcmp(kind, "plot") != 0)
        qdot_text_format(&behind, "\n%s\n", kind);
    qdot_free(text);
    whole = behind.failed ? NULL : qdot_strdup(qdot_text_str(&behind));
    qdot_text_clear(&behind);
    return whole;
}
