/* hint-check.c -- whether the text of a hint `write TEXT` can be typed. */
#include "lang/workbench/hint-check.h"

#include <string.h>

#include "base/text.h"
#include "lang/language/hint-place.h"
#include "lang/source/source.h"
#include "lang/syntax/form.h"

enum { TRIES = 4 /* faults of a statement that one hint mends */ };

/* The text that the hint says to write; NULL: it says something else, or names in words what to write, as "write `a` or `b`",
 * "write sin(...)". */
static const char *
text_of_hint(const qdot_error *error)
{
    const size_t n = strlen(QDOT_HINT_WRITE);

    if (strncmp(error->hint, QDOT_HINT_WRITE, n) != 0 || strchr(error->hint, '`') != NULL || strstr(error->hint, "...") != NULL)
        return NULL;
    return error->hint + n;
}

/* The length of the first statement of the text: later ones may need what it declares. */
static size_t
length_of_first(const char *text)
{
    int depth = 0;
    size_t n = 0;

    for (; text[n] != '\0' && (text[n] != ';' || depth > 0); n++)
        depth += (strchr("([{", text[n]) != NULL) - (strchr(")]}", text[n]) != NULL);
    return n;
}

/* Whether both texts begin with the same word. */
static bool
begin_with_the_same_word(const char *a, const char *b)
{
    const size_t n = strcspn(a, " ");

    return n > 0 && n == strcspn(b, " ") && strncmp(a, b, n) == 0;
}

void
qdot_hint_check(qdot_session *session, qdot_hint_parser *find_fault)
{
    qdot_error error = *qdot_last_error();

    for (int tries = 0; text_of_hint(&error) != NULL; tries++) {
        const char *text = text_of_hint(&error), *next;
        const size_t fault = find_fault(session, text, length_of_first(text));

        if (fault == SIZE_MAX || (fault == 0 && strcspn(text, " ") > 1)) /* no statement begins with this word: the text is a part of one */
            break;
        next = text_of_hint(qdot_last_error()); /* a second fault of the same kind, as in `run 0..1 tol = 1e-9 method = taylor` */
        if (tries == TRIES || next == NULL || !begin_with_the_same_word(text, next))
            error.hint[0] = '\0';
        else
            memcpy(error.hint, qdot_last_error()->hint, sizeof error.hint);
    }
    (void)qdot_fail_again(&error);
}

/* Whether the statement [first, end) parses up to the end of the text, if that stands in this place. */
static bool
parses_in_place(qdot_session *session, qdot_hint_parser *find_fault, const qdot_source *source, const qdot_token *first,
                const qdot_token *end, const qdot_hint_place *place, const char *text)
{
    const size_t from = place->from->start, to = place->to[-1].start + place->to[-1].length;
    const size_t stop = end[-1].start + end[-1].length;
    qdot_text all = {0};
    size_t behind;
    bool parses;

    qdot_text_add_n(&all, source->text + first->start, from - first->start);
    qdot_text_add(&all, text);
    behind = all.n;
    qdot_text_add_n(&all, source->text + to, stop - to);
    parses = !all.failed && find_fault(session, qdot_text_str(&all), all.n) >= behind;
    qdot_text_clear(&all);
    return parses;
}

/* Whether the text is a part of a statement that begins with a word: an expression. */
static bool
is_part(const qdot_session *session, const qdot_source *text, const qdot_token *first)
{
    return qdot_statement_row(first) != NULL && text->tokens.n > 0 && qdot_statement_form(session, text->tokens.at) == QDOT_FORM_VALUE;
}

void
qdot_hint_check_in_place(qdot_session *session, qdot_hint_parser *find_fault, const qdot_source *source, const qdot_token *first,
                         const qdot_token *end, size_t at)
{
    qdot_error error = *qdot_last_error();
    const char *text = text_of_hint(&error);
    const qdot_token *fault = first;
    qdot_hint_place places[2];
    qdot_source *tokens = NULL;
    size_t wrong, n = 0;
    bool parses = true;

    if (text == NULL)
        return;
    while (fault + 1 < end && fault[1].start <= at)
        fault++;
    if (fault > first && qdot_source_new("", text, strlen(text), &tokens, &wrong) == QDOT_OK && is_part(session, tokens, first))
        n = qdot_hint_places(first, end, fault, tokens, places);
    for (size_t i = 0; i < n; i++) {
        parses = parses_in_place(session, find_fault, source, first, end, &places[i], text);
        if (parses)
            break;
    }
    if (!parses)
        error.hint[0] = '\0';
    qdot_source_free(tokens);
    (void)qdot_fail_again(&error);
}
