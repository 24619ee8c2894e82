/* highlight.c -- classifies each byte of a text that is being typed, for colours. */
#include "lang/workbench/highlight.h"

#include <string.h>

#include "base/utf8.h"
#include "lang/files/redirect.h"
#include "lang/functions/quantity.h"
#include "lang/source/source.h"
#include "lang/syntax/statement.h"
#include "lang/syntax/usage.h"

/* --- kinds of names ------------------------------------------------------------------- */

/* Whether the word of a statement is used as a name here: `run*2`, `gravity = 9.81`. */
static bool
is_word_used_as_name(const qdot_token *name)
{
    static const char *const binary[] = {
        "=", "*", "/", "^", "'", "==", "<", ">", "<=", ">=", "."};

    for (size_t i = 0; i < sizeof binary / sizeof *binary; i++)
        if (qdot_token_is(name + 1, binary[i]))
            return true;
    return qdot_quantity_find(name->text) != NULL;
}

/* The table row of the statement that begins at this token; NULL: it is an expression or a definition. */
static const qdot_statement *
find_statement(const qdot_token *first)
{
    return first->kind == QDOT_TOKEN_NAME && !is_word_used_as_name(first)
               ? qdot_statement_find(first->text)
               : NULL;
}

/* Whether the name is the word of an option of this statement, at a place where it may stand. */
static bool
is_option(const qdot_statement *row, const qdot_token *first, const qdot_token *name)
{
    qdot_usage u;

    if (row == NULL || strstr(row->usage, name->text) == NULL ||
        !qdot_usage_begin(&u, row->word, row->usage, qdot_redirect_answers(row)))
        return false;
    qdot_usage_read(&u, first, name);
    return qdot_usage_takes(&u, name->text);
}

/* Whether `for k = ...` or `to "FILE"` begins here, which may end any statement. */
static bool
begins_end_of_statement(const qdot_token *name)
{
    return (qdot_token_is_word(name, "for") && name[1].kind == QDOT_TOKEN_NAME) ||
           (qdot_token_is_word(name, "to") && name[1].kind == QDOT_TOKEN_STRING);
}

qdot_highlight
qdot_highlight_name(const qdot_session *session, const qdot_token *first, const qdot_token *name,
                    bool in_brackets)
{
    const qdot_statement *row = find_statement(first);

    if (name == first && row != NULL)
        return QDOT_HIGHLIGHT_WORD;
    if (!in_brackets && name > first &&
        (begins_end_of_statement(name) || is_option(row, first, name)))
        return QDOT_HIGHLIGHT_WORD;
    return qdot_cursor_knows(session, name->text) ? QDOT_HIGHLIGHT_NAME
                                                  : QDOT_HIGHLIGHT_PLAIN;
}

/* --- colouring a text ----------------------------------------------------------------- */

static qdot_highlight
find_kind_of_token(const qdot_session *session, const qdot_token *first, const qdot_token *token,
                   bool in_brackets)
{
    switch (token->kind) {
    case QDOT_TOKEN_NAME: return qdot_highlight_name(session, first, token, in_brackets);
    case QDOT_TOKEN_NUMBER: return QDOT_HIGHLIGHT_NUMBER;
    case QDOT_TOKEN_STRING: return QDOT_HIGHLIGHT_STRING;
    default: return QDOT_HIGHLIGHT_PLAIN;
    }
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
static void
mark_tokens(const qdot_session *session, const qdot_source *source, uint8_t *kinds,
            size_t *end)
{
    const qdot_token *first = source->tokens.at;
    int64_t depth = 0; /* depth of brackets within the statement */

    for (size_t i = 0; i < source->tokens.n; i++) {
        const qdot_token *token = source->tokens.at + i;

        mark_comments(source->text, *end, token->start, kinds);
        if (token->kind == QDOT_TOKEN_END || qdot_token_is(token, "{")) {
            first = token + 1;
            depth = 0;
        } else {
            const uint8_t kind = (uint8_t)find_kind_of_token(session, first, token, depth > 0);

            if (token->start >= *end) /* skip a dot accent, which belongs to the name before it */
                memset(kinds + token->start, kind, token->length);
            depth += qdot_token_bracket(token);
        }
        if (token->start + token->length > *end)
            *end = token->start + token->length;
    }
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
qdot_highlight_text(const qdot_session *session, const char *text, size_t length,
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
            mark_tokens(session, source, kinds + from, &end);
        end = status != QDOT_OK || at >= length - from || at < end
                  ? length - from /* everything was read, or only a closing bracket is missing */
                  : mark_invalid_byte(text + from, length - from, at, kinds + from);
        qdot_source_free(source);
        QDOT_TRY(status);
        from += end;
    }
    return QDOT_OK;
}
