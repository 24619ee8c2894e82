/* fix.c -- what would mend an error, from its hint. */
#include "lang/analysis/fix.h"

#include <string.h>

#include "lang/analysis/follow.h"
#include "lang/language/hint-place.h"
#include "lang/source/source.h"
#include "lang/syntax/outline.h"
#include "lang/syntax/statement.h"

enum { TRIALS = 4 /* texts that are analysed for one remark */ };

size_t
qdot_fix_errors(const qdot_analysis *a)
{
    size_t n = 0;
    qdot_remark remark;

    for (size_t i = 0; qdot_analysis_remark(a, i, &remark); i++)
        n += remark.level == QDOT_REMARK_ERROR;
    return n;
}

qdot_status
qdot_fix_errors_with(const qdot_analysis *a, const qdot_edit_list *edits, size_t *errors)
{
    qdot_analysis *other = qdot_analysis_new(a->path, a->quick, &(qdot_analysis_host){.read = a->host.read, .data = a->host.data});
    qdot_text text = {0};
    qdot_status status;
    size_t from = 0;
    bool done;

    for (size_t i = 0; i < edits->n; i++) {
        qdot_text_add_n(&text, a->text + from, edits->at[i].at.from - from);
        qdot_text_add(&text, edits->at[i].text);
        from = edits->at[i].at.to;
    }
    qdot_text_add_n(&text, a->text + from, a->length - from);
    status = other != NULL ? qdot_text_status(&text) : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = qdot_follow_text(other, qdot_text_str(&text), text.n);
    if (status == QDOT_OK)
        status = qdot_follow_on(other, &done);
    if (status == QDOT_OK)
        *errors = qdot_fix_errors(other);
    qdot_text_clear(&text);
    qdot_analysis_free(other);
    return status;
}

/* --- trying --------------------------------------------------------------------------- */

typedef struct {
    const qdot_analysis *a;
    qdot_edit_list *fixes;
    size_t before; /* number of errors */
    int trials;    /* left */
} search;

/* Append the edit, if it leaves fewer errors; *mends tells. */
static qdot_status
try_edit(search *s, qdot_stretch at, const char *text, bool *mends)
{
    qdot_edit edit = {at, qdot_strdup(text)};
    size_t after = 0;
    qdot_status status = edit.text != NULL ? QDOT_OK : QDOT_ENOMEM;

    *mends = false;
    if (status == QDOT_OK && s->trials-- > 0) {
        status = qdot_fix_errors_with(s->a, &(qdot_edit_list){.at = &edit, .n = 1}, &after);
        *mends = status == QDOT_OK && after < s->before;
    }
    if (*mends)
        status = qdot_vec_push(s->fixes, edit);
    if (!*mends || status != QDOT_OK)
        qdot_free(edit.text);
    return status;
}

/* --- a text in place of what it is made of -------------------------------------------- */

/* Try the text in place of tokens from the one at fault, or from the beginning of its statement. */
static qdot_status
try_text(search *s, const qdot_remark *remark, const char *text)
{
    const size_t at = qdot_analysis_token(s->a->source, remark->at.from);
    const qdot_piece *piece = qdot_analysis_piece(s->a, remark->at.from);
    const qdot_token *tokens = s->a->source->tokens.at;
    qdot_hint_place places[2];
    qdot_source *source = NULL;
    size_t wrong, n = 0;
    bool mends = false;
    qdot_status status = QDOT_OK;

    if (at == SIZE_MAX || piece == NULL || piece->block)
        return QDOT_OK;
    if (qdot_source_new("", text, strlen(text), &source, &wrong) == QDOT_OK)
        n = qdot_hint_places(&tokens[piece->first], &tokens[piece->end], &tokens[at], source, places);
    for (size_t i = 0; i < n && status == QDOT_OK && !mends; i++) {
        const qdot_token *from = places[i].from, *to = places[i].to;

        status = try_edit(s, (qdot_stretch){from->start, to[-1].start + to[-1].length}, text, &mends);
        if (status == QDOT_OK && !mends && to > from + 1 && i == 0)
            status = try_edit(s, (qdot_stretch){from->start, from->start + from->length}, text, &mends);
    }
    qdot_source_free(source);
    return status;
}

/* --- a line above --------------------------------------------------------------------- */

/* Try the line above that of the remark, if it is a statement that declares. */
static qdot_status
try_line(search *s, const qdot_remark *remark, const char *line)
{
    const qdot_piece *piece = qdot_analysis_piece(s->a, remark->at.from);
    const size_t word = strcspn(line, " ");
    char *name = qdot_strndup(line, word);
    const qdot_statement *row = name != NULL ? qdot_statement_find(name) : NULL;
    size_t at = piece != NULL ? piece->at.from : 0;
    qdot_text text = {0};
    bool mends;
    qdot_status status = name != NULL ? QDOT_OK : QDOT_ENOMEM;

    qdot_free(name);
    if (status != QDOT_OK || row == NULL || !qdot_statement_declares(row) || line[word] == '\0')
        return status;
    while (at > 0 && s->a->text[at - 1] != '\n')
        at--;
    qdot_text_format(&text, "%s\n", line);
    status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = try_edit(s, (qdot_stretch){at, at}, qdot_text_str(&text), &mends);
    qdot_text_clear(&text);
    return status;
}

/* Try each `text in quotes` of the hint as a line. */
static qdot_status
try_quoted(search *s, const qdot_remark *remark)
{
    qdot_status status = QDOT_OK;

    for (const char *open = strchr(remark->hint, '`'), *close; open != NULL && status == QDOT_OK; open = strchr(close + 1, '`')) {
        char *line;

        close = strchr(open + 1, '`');
        if (close == NULL)
            break;
        line = qdot_strndup(open + 1, (size_t)(close - open - 1));
        status = line != NULL ? try_line(s, remark, line) : QDOT_ENOMEM;
        qdot_free(line);
    }
    return status;
}

qdot_status
qdot_fix_find(const qdot_analysis *a, const qdot_remark *remark, qdot_edit_list *fixes)
{
    search s = {.a = a, .fixes = fixes, .before = qdot_fix_errors(a), .trials = TRIALS};

    if (remark->fix != NULL) { /* a name for a name */
        const qdot_edit edit = {remark->at, qdot_strdup(remark->fix)};

        return edit.text != NULL ? qdot_vec_push(fixes, edit) : QDOT_ENOMEM;
    }
    if (strncmp(remark->hint, QDOT_HINT_WRITE, sizeof QDOT_HINT_WRITE - 1) == 0)
        return try_text(&s, remark, remark->hint + sizeof QDOT_HINT_WRITE - 1);
    return try_quoted(&s, remark);
}
