/* highlight.c -- classifies each byte of a text that is being typed, for colours. */
#include "lang/workbench/highlight.h"

#include <string.h>

#include "base/utf8.h"
#include "lang/files/redirect.h"
#include "lang/source/source.h"
#include "lang/syntax/form.h"
#include "lang/syntax/match.h"
#include "lang/syntax/outline.h"

/* --- the words of a statement ---------------------------------------------------------- */

/* The token at which the statement ends that begins at `first`, with its loop: its own end, or that of its block. */
static const qdot_token *
find_end(const qdot_token *first)
{
    int64_t depth = 0;

    for (const qdot_token *k = first;; k++) {
        depth += qdot_token_bracket(k);
        if (k->kind == QDOT_TOKEN_END || depth < 0)
            return k;
    }
}

static qdot_form
form_without_loop(const qdot_session *session, const qdot_token *first)
{
    const qdot_outline parts = qdot_outline_statement(session, first);
    const qdot_token *end = parts.loop != NULL ? parts.loop : parts.end;
    const qdot_token_kind kind = qdot_outline_cut(end);
    const qdot_form form = qdot_statement_form(session, first);

    qdot_outline_join(end, kind);
    return form;
}

/* Read the statement that begins at `first`, as far as it goes, into the record: the parts that are words of its usage are
 * its words. A statement without words has no parts. */
static qdot_status
read_statement(qdot_session *session, const qdot_source *source, const qdot_token *first, qdot_usage *u, qdot_record *record)
{
    const qdot_cursor at = {.session = session, .source = source, .at = first};
    const qdot_token *end = find_end(first);
    const qdot_token_kind kind = qdot_outline_cut(end);
    const qdot_form form = form_without_loop(session, first);
    const qdot_statement *row = form == QDOT_FORM_WORD         ? qdot_statement_row(first)
                                : form == QDOT_FORM_COMPARISON ? qdot_statement_find("check")
                                                               : NULL;
    qdot_status status = QDOT_OK;

    *record = (qdot_record){0};
    if (row != NULL && qdot_usage_compile_with_end(u, row->word, row->usage, qdot_redirect_answers(row)))
        status = qdot_match_begun(&at, row, u, form == QDOT_FORM_WORD, NULL, record);
    qdot_outline_join(end, kind);
    return status;
}

/* Whether `for k = ...` or `to "FILE"` begins here, which may end any statement. */
static bool
begins_end_of_statement(const qdot_token *name)
{
    return (qdot_token_is_word(name, "for") && name[1].kind == QDOT_TOKEN_NAME) ||
           (qdot_token_is_word(name, "to") && name[1].kind == QDOT_TOKEN_STRING);
}

static bool
is_word(const qdot_filled *part)
{
    return part->node->kind == QDOT_USAGE_WORD && part->from < part->to;
}

qdot_status
qdot_highlight_is_word(qdot_session *session, const qdot_source *source, const qdot_token *first, const qdot_token *name,
                       bool in_brackets, bool *is)
{
    qdot_record record;
    qdot_usage u;
    const qdot_status status = read_statement(session, source, first, &u, &record);

    *is = !in_brackets && name > first && begins_end_of_statement(name);
    for (size_t i = 0; i < record.parts.n && !*is; i++)
        *is = is_word(&record.parts.at[i]) && record.parts.at[i].from == name;
    qdot_record_free(&record);
    return status;
}

/* --- colouring a text ----------------------------------------------------------------- */

static qdot_highlight
find_kind_of_token(const qdot_session *session, const qdot_token *token)
{
    switch (token->kind) {
    case QDOT_TOKEN_NAME: return qdot_cursor_knows(session, token->text) ? QDOT_HIGHLIGHT_NAME : QDOT_HIGHLIGHT_PLAIN;
    case QDOT_TOKEN_NUMBER: return QDOT_HIGHLIGHT_NUMBER;
    case QDOT_TOKEN_STRING: return QDOT_HIGHLIGHT_STRING;
    default: return QDOT_HIGHLIGHT_PLAIN;
    }
}

/* Mark the words of the statement that begins at `first`. */
static qdot_status
mark_words(qdot_session *session, const qdot_source *source, const qdot_token *first, uint8_t *kinds)
{
    qdot_record record;
    qdot_usage u;
    const qdot_status status = read_statement(session, source, first, &u, &record);

    for (size_t i = 0; i < record.parts.n; i++)
        if (is_word(&record.parts.at[i]))
            memset(kinds + record.parts.at[i].from->start, QDOT_HIGHLIGHT_WORD, record.parts.at[i].from->length);
    qdot_record_free(&record);
    return status;
}

/* Mark the comments between tokens, which begin with #, for colouring. */
static void
mark_comments(const char *text, size_t from, size_t to, uint8_t *kinds)
{
    for (size_t i = from; i < to; i++)
        if (text[i] == '#')
            for (; i < to && text[i] != '\n'; i++)
                kinds[i] = QDOT_HIGHLIGHT_COMMENT;
}

/* Classify the tokens of the text for colouring; *end: the byte up to which they reach. */
static qdot_status
mark_tokens(qdot_session *session, const qdot_source *source, uint8_t *kinds, size_t *end)
{
    const qdot_token *first = source->tokens.at;
    int64_t depth = 0; /* depth of brackets within the statement */

    for (size_t i = 0; i < source->tokens.n; i++) {
        const qdot_token *token = source->tokens.at + i;

        mark_comments(source->text, *end, token->start, kinds);
        if (token->kind == QDOT_TOKEN_END || qdot_token_is(token, "{")) {
            QDOT_TRY(mark_words(session, source, first, kinds));
            first = token + 1;
            depth = 0;
        } else {
            const bool ends = depth <= 0 && token > first && begins_end_of_statement(token);

            if (token->start >= *end) /* skip a dot accent, which belongs to the name before it */
                memset(kinds + token->start, ends ? QDOT_HIGHLIGHT_WORD : find_kind_of_token(session, token), token->length);
            depth += qdot_token_bracket(token);
        }
        if (token->start + token->length > *end)
            *end = token->start + token->length;
    }
    return QDOT_OK;
}

/* The byte that is no token: a text without its quote, or what means nothing. Returns how far
 * that reaches. */
static size_t
mark_invalid_byte(const char *text, size_t length, size_t at, uint8_t *kinds)
{
    const bool quoted = text[at] == '"', goes_on = text[at] == '\\';
    const size_t n = qdot_utf8_length(text + at);
    size_t end = at + (n > 0 ? n : 1);

    while (quoted && end < length && text[end] != '\n')
        end++;
    memset(kinds + at,
           quoted    ? QDOT_HIGHLIGHT_STRING
           : goes_on ? QDOT_HIGHLIGHT_PLAIN /* the word may be incomplete, like the beginning of \theta */
                     : QDOT_HIGHLIGHT_WRONG,
           end - at);
    return end;
}

qdot_status
qdot_highlight_text(qdot_session *session, const char *text, size_t length,
                    uint8_t *kinds)
{
    size_t from = 0;

    memset(kinds, QDOT_HIGHLIGHT_PLAIN, length);
    while (from < length) {
        qdot_source *source;
        size_t at, end = 0;
        qdot_status status =
            qdot_source_new("", text + from, length - from, &source, &at);

        if (source == NULL)
            return status;
        /* the lexer ends a list of tokens with END, except one on which it failed */
        if (status != QDOT_OK)
            status = qdot_vec_push(&source->tokens,
                                   ((qdot_token){.text = "", .start = (uint32_t)at}));
        if (status == QDOT_OK)
            status = mark_tokens(session, source, kinds + from, &end);
        end = status != QDOT_OK || at >= length - from || at < end
                  ? length - from /* everything was read, or only a closing bracket is missing */
                  : mark_invalid_byte(text + from, length - from, at, kinds + from);
        qdot_source_free(source);
        QDOT_TRY(status);
        from += end;
    }
    return QDOT_OK;
}
