/* typing.c -- calls for a text that is being typed: completion, colours, whether it is finished. */
#include <string.h>

#include "api/system.h"
#include "base/memory.h"
#include "base/text.h"
#include "lang/workbench/complete.h"
#include "lang/workbench/explain.h"
#include "lang/workbench/highlight.h"
#include "lang/workbench/script.h"

#define SAME(lexeme) _Static_assert((int)QDOT_LEXEME_##lexeme == (int)QDOT_HIGHLIGHT_##lexeme, #lexeme)
SAME(PLAIN);
SAME(WORD);
SAME(NAME);
SAME(NUMBER);
SAME(STRING);
SAME(COMMENT);
SAME(WRONG);

/* Append the words, one a line, and free them. */
static void
join_and_free_words(char **words, size_t n, qdot_text *text)
{
    for (size_t i = 0; i < n; i++) {
        qdot_text_add(text, i > 0 ? "\n" : "");
        qdot_text_add(text, words[i]);
        qdot_free(words[i]);
    }
    qdot_text_add(text, ""); /* no words give the empty text, not NULL */
    qdot_free(words);
}

qdot_result
qdot_system_complete(qdot_system *system, const char *text, size_t cursor, size_t *start, char **words)
{
    qdot_text joined = {0};
    qdot_status status;
    char **found = NULL;
    size_t n = 0;

    if (words != NULL)
        *words = NULL;
    if (system == NULL)
        return QDOT_RESULT_INVALID;
    if (text == NULL || start == NULL || words == NULL)
        return qdot_api_refuse(system, "complete: the %s NULL",
                               text == NULL    ? "text is"
                               : start == NULL ? "start is"
                                               : "words are");
    if (cursor > strlen(text))
        return qdot_api_refuse(system, "complete: the text has no byte %zu", cursor);
    status = qdot_api_begin(system);
    if (status == QDOT_OK)
        status = qdot_complete_at(system->session, text, cursor, start, &found, &n);
    if (status == QDOT_OK) {
        join_and_free_words(found, n, &joined);
        status = qdot_text_status(&joined);
    }
    return qdot_api_end_with_text(system, status, &joined, words);
}

qdot_result
qdot_system_explain(qdot_system *system, const char *text, size_t cursor, qdot_notation notation,
                    char **explanation)
{
    const bool json = notation == QDOT_NOTATION_JSON;
    qdot_explained explained = {0};
    qdot_text out = {0};
    qdot_status status;

    if (explanation != NULL)
        *explanation = NULL;
    if (system == NULL)
        return QDOT_RESULT_INVALID;
    if (text == NULL || explanation == NULL)
        return qdot_api_refuse(system, "explain: the %s is NULL", text == NULL ? "text" : "explanation");
    if (cursor > strlen(text))
        return qdot_api_refuse(system, "explain: the text has no byte %zu", cursor);
    if ((unsigned)notation > QDOT_NOTATION_JSON || notation == QDOT_NOTATION_MATHML)
        return qdot_api_refuse(system, "explain: there is no notation %d", (int)notation);
    status = qdot_api_begin(system);
    if (status == QDOT_OK)
        status = qdot_explain(system->session, text, strlen(text), cursor, json ? QDOT_LATEX : (qdot_style)notation,
                              &explained);
    if (status == QDOT_OK && json && explained.kind != QDOT_EXPLAINED_NOTHING)
        qdot_explained_json(&explained, &out);
    else if (status == QDOT_OK)
        qdot_explained_print(&explained, &out);
    qdot_text_add(&out, ""); /* nothing gives the empty text, not NULL */
    if (status == QDOT_OK)
        status = qdot_text_status(&out);
    qdot_explained_clear(&explained);
    return qdot_api_end_with_text(system, status, &out, explanation);
}

int
qdot_text_unfinished(const char *text)
{
    return text != NULL && qdot_script_is_incomplete(text, strlen(text));
}

qdot_result
qdot_system_highlight(qdot_system *system, const char *text, size_t length, unsigned char *kinds)
{
    qdot_status status;

    if (system == NULL)
        return QDOT_RESULT_INVALID;
    if (text == NULL || kinds == NULL)
        return qdot_api_refuse(system, "highlight: the %s NULL", text == NULL ? "text is" : "kinds are");
    status = qdot_api_begin(system);
    if (status == QDOT_OK)
        status = qdot_highlight_text(system->session, text, length, kinds);
    return qdot_api_end(system, status);
}
