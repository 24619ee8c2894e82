/* scripts.c -- MathML for pages: indices and powers one above the other. */
#include "show/scripts.h"

#include <stdbool.h>
#include <string.h>

static const char begin[] = "<msup>", end[] = "</msup>", row[] = "<mrow>",
                  end_row[] = "</mrow>", index_begin[] = "<msub>",
                  index_end[] = "</msub>";

static bool
begins(const char *at, const char *stop, const char *with)
{
    const size_t n = strlen(with);

    return (size_t)(stop - at) >= n && memcmp(at, with, n) == 0;
}

/* Behind the element whose begin, a tag such as <msub>, stands before `at`; NULL: it does not end. */
static const char *
behind(const char *at, const char *stop, const char *opens, const char *closes)
{
    for (int depth = 1; at < stop; at++) {
        depth += begins(at, stop, opens) ? 1 : begins(at, stop, closes) ? -1 : 0;
        if (depth == 0)
            return at + strlen(closes);
    }
    return NULL;
}

/* A power at `at` of a name with an index, which may stand in a row: its parts. */
typedef struct {
    const char *base, *index; /* behind <msub>; behind </msub> */
    const char *power, *after;
} raised;

static bool
find_raised(const char *at, const char *stop, raised *r)
{
    bool in_row;

    if (!begins(at, stop, begin))
        return false;
    at += sizeof begin - 1;
    in_row = begins(at, stop, row);
    at += in_row ? sizeof row - 1 : 0;
    if (!begins(at, stop, index_begin))
        return false;
    r->base = at + sizeof index_begin - 1;
    r->index = behind(r->base, stop, index_begin, index_end);
    if (r->index == NULL || (in_row && !begins(r->index, stop, end_row)))
        return false;
    r->power = r->index + (in_row ? sizeof end_row - 1 : 0);
    r->after = behind(r->power, stop, begin, end);
    return r->after != NULL;
}

void
qdot_page_add_mathml(qdot_text *out, const char *mathml, size_t n)
{
    const char *at = mathml, *stop = mathml + n;
    raised r;

    while (at < stop) {
        if (!find_raised(at, stop, &r)) {
            qdot_text_char(out, *at++);
            continue;
        }
        qdot_text_add(out, "<msubsup>");
        qdot_text_add_n(out, r.base, (size_t)(r.index - r.base) - (sizeof index_end - 1));
        qdot_text_add_n(out, r.power, (size_t)(r.after - r.power) - (sizeof end - 1));
        qdot_text_add(out, "</msubsup>");
        at = r.after;
    }
}
