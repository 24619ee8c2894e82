/* torn.c -- splits a text into tokens although parts of it are no text of the language. */
#include "lang/analysis/torn.h"

#include <string.h>

#include "base/utf8.h"

enum { MOST = 40 }; /* lines at fault that are told; behind the last the text is not read */

/* Blank the line that contains byte `at`, of which at least one byte is no blank. */
static void
blank_line(char *text, size_t length, size_t at)
{
    size_t from = at, to = at;

    while (from > 0 && text[from - 1] != '\n')
        from--;
    while (to < length && text[to] != '\n')
        to++;
    memset(text + from, ' ', to - from);
}

/* The bytes of the character at `at`, none at the end of a line. */
static size_t
length_of_character(const char *text, size_t length, size_t at)
{
    size_t n;

    if (at >= length || text[at] == '\n')
        return 0;
    n = qdot_utf8_length(text + at);
    return n > 0 ? n : 1;
}

qdot_status
qdot_torn_source(const char *name, const char *text, size_t length, qdot_source **source, qdot_remark_list *remarks)
{
    char *whole = qdot_malloc(length + 1);
    qdot_status status = whole != NULL ? QDOT_OK : QDOT_ENOMEM;

    *source = NULL;
    if (status != QDOT_OK)
        return status;
    memcpy(whole, text, length);
    whole[length] = '\0';
    for (int k = 0;; k++) {
        size_t at;
        const qdot_error *error;

        status = qdot_source_new(name, whole, length, source, &at);
        error = qdot_last_error();
        if (status == QDOT_OK || status == QDOT_ENOMEM || *source == NULL)
            break;
        at = at < length ? at : length;
        status = qdot_remark_add(remarks, (qdot_stretch){at, at + length_of_character(text, length, at)}, QDOT_REMARK_ERROR,
                                 error->message, error->hint);
        qdot_source_free(*source);
        *source = NULL;
        if (status != QDOT_OK)
            break;
        if (k < MOST) {
            blank_line(whole, length, at);
        } else { /* what follows is not looked at any more */
            while (at > 0 && whole[at - 1] != '\n')
                at--;
            memset(whole + at, ' ', length - at);
        }
        if (k > MOST) /* the fault is before: brackets that are open */
            memset(whole, ' ', length);
    }
    qdot_free(whole);
    return status;
}
