/* scripts.c -- MathML for pages: indices and powers one above the other, brackets, functions. */
#include "show/scripts.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static const char begin[] = "<msup>", end[] = "</msup>", row[] = "<mrow>",
                  end_row[] = "</mrow>", index_begin[] = "<msub>",
                  index_end[] = "</msub>";

static bool
tag_begins(const char *at, const char *stop, const char *with)
{
    const size_t n = strlen(with);

    return (size_t)(stop - at) >= n && memcmp(at, with, n) == 0;
}

/* Behind the element whose begin, a tag such as <msub>, stands before `at`; NULL: it does not end. */
static const char *
behind_element(const char *at, const char *stop, const char *opens, const char *closes)
{
    for (int depth = 1; at < stop; at++) {
        depth += tag_begins(at, stop, opens) ? 1 : tag_begins(at, stop, closes) ? -1 : 0;
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

    if (!tag_begins(at, stop, begin))
        return false;
    at += sizeof begin - 1;
    in_row = tag_begins(at, stop, row);
    at += in_row ? sizeof row - 1 : 0;
    if (!tag_begins(at, stop, index_begin))
        return false;
    r->base = at + sizeof index_begin - 1;
    r->index = behind_element(r->base, stop, index_begin, index_end);
    if (r->index == NULL || (in_row && !tag_begins(r->index, stop, end_row)))
        return false;
    r->power = r->index + (in_row ? sizeof end_row - 1 : 0);
    r->after = behind_element(r->power, stop, begin, end);
    return r->after != NULL;
}

/* --- brackets and functions ------------------------------------------------------------- */

static const char opening[] = "<mo>(</mo>", closing[] = "<mo>)</mo>",
                  times[] = "<mo>&#x2062;</mo>", apply[] = "<mo>&#x2061;</mo>";

/* Whether the bracket at `at` is about nothing higher than a line. */
static bool
bracket_is_flat(const char *at, const char *stop)
{
    static const char *const high[] = {"<mfrac", "<mtable", "<msqrt", "<mroot", "<munder"};
    int depth = 0;

    for (; at < stop; at++) {
        depth += tag_begins(at, stop, opening) ? 1 : tag_begins(at, stop, closing) ? -1 : 0;
        if (depth == 0)
            return true;
        for (size_t i = 0; i < sizeof high / sizeof *high; i++)
            if (tag_begins(at, stop, high[i]))
                return false;
    }
    return false;
}

/* Whether a function of more than one letter is applied at `at`: sin x, sin^2 x. */
static bool
is_applied(const char *at, const char *stop)
{
    static const char power[] = "<msup><mrow><mi>", name[] = "<mi>";
    const bool raised = tag_begins(at, stop, power);
    const char *end_of_name;

    if (!raised && !tag_begins(at, stop, name))
        return false;
    at += raised ? sizeof power - 1 : sizeof name - 1;
    end_of_name = memchr(at, '<', (size_t)(stop - at));
    if (end_of_name == NULL || end_of_name - at < 2 || *at < 'a' || *at > 'z')
        return false;
    if (!raised)
        return tag_begins(end_of_name, stop, "</mi><mo>&#x2061;</mo>");
    at = behind_element(end_of_name, stop, begin, end);
    return at != NULL && tag_begins(at, stop, apply);
}

void
qdot_page_add_mathml(qdot_text *out, const char *mathml, size_t n)
{
    const char *at = mathml, *stop = mathml + n;
    uint64_t flat = 0; /* of the open brackets, the innermost lowest */
    raised r;

    while (at < stop) {
        const bool opens = tag_begins(at, stop, opening);

        if (opens || tag_begins(at, stop, closing)) {
            if (opens)
                flat = flat << 1 | bracket_is_flat(at, stop);
            qdot_text_add(out, flat & 1 ? "<mo stretchy=\"false\">" : "<mo>");
            qdot_text_add(out, opens ? "(</mo>" : ")</mo>");
            if (!opens)
                flat >>= 1;
            at += sizeof opening - 1;
        } else if (tag_begins(at, stop, times) &&
                   is_applied(at + sizeof times - 1, stop)) {
            qdot_text_add(out, times);
            qdot_text_add(out, "<mspace width=\"0.17em\"></mspace>");
            at += sizeof times - 1;
        } else if (find_raised(at, stop, &r)) {
            qdot_text_add(out, "<msubsup>");
            qdot_text_add_n(out, r.base,
                            (size_t)(r.index - r.base) - (sizeof index_end - 1));
            qdot_text_add_n(out, r.power, (size_t)(r.after - r.power) - (sizeof end - 1));
            qdot_text_add(out, "</msubsup>");
            at = r.after;
        } else {
            qdot_text_char(out, *at++);
        }
    }
}
