/* source.c -- a source text with its tokens; prints errors with their line and a caret. */
#include "lang/source/source.h"

#include <string.h>

#include "base/terminal.h"
#include "base/utf8.h"
#include "lang/source/lex.h"

/* Columns of a line that an error shows; on a terminal what is left beside the indent and two
 * "...". */
enum { SHOWN = 90, LEAST_SHOWN = 10, BESIDE = 8 };

/* List where lines begin. */
static qdot_status
list_lines(qdot_source *s)
{
    const char *end;

    for (const char *c = s->text; (end = memchr(c, '\n', (size_t)(s->text + s->length - c))) != NULL; c = end + 1)
        QDOT_TRY(qdot_vec_push(&s->lines, (uint32_t)(end + 1 - s->text)));
    return QDOT_OK;
}

qdot_status
qdot_source_new(const char *name, const char *text, size_t length, qdot_source **source,
                size_t *at)
{
    qdot_source *s;
    qdot_status status;

    *source = NULL;
    *at = 0;
    if (length >= UINT32_MAX)
        return qdot_fail(QDOT_ELIMIT, "a script may hold at most 4 GB");
    s = qdot_calloc(1, sizeof *s);
    if (s == NULL)
        return QDOT_ENOMEM;
    s->uses = 1;
    s->name = qdot_strdup(name);
    s->text = qdot_malloc(length + 1);
    s->arena = qdot_arena_new();
    s->length = length;
    if (s->name == NULL || s->text == NULL || s->arena == NULL) {
        qdot_source_free(s);
        return QDOT_ENOMEM;
    }
    memcpy(s->text, text, length);
    s->text[length] = '\0';

    status = list_lines(s);
    if (status == QDOT_OK)
        status = qdot_lex(s, at);
    if (status == QDOT_ENOMEM) {
        qdot_source_free(s);
        return status;
    }
    *source = s;
    return status;
}

qdot_source *
qdot_source_keep(const qdot_source *source)
{
    qdot_source *own = (qdot_source *)source;

    own->uses++;
    return own;
}

void
qdot_source_free(qdot_source *source)
{
    if (source == NULL || --source->uses > 0)
        return;
    qdot_free(source->name);
    qdot_free(source->text);
    qdot_free(source->tokens.at);
    qdot_free(source->lines.at);
    qdot_arena_free(source->arena);
    qdot_free(source);
}

/* The number of lines before the one that contains byte `at`. */
static size_t
count_lines_before(const qdot_source *source, size_t at)
{
    size_t low = 0, high = source->lines.n;

    while (low < high) { /* lines.at[0 .. low - 1] <= at < lines.at[high ..] */
        const size_t middle = low + (high - low) / 2;

        if (source->lines.at[middle] <= at)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The first byte of the line that contains byte `at`; a byte-order mark belongs to no line. */
static size_t
find_start_of_line(const qdot_source *source, size_t at)
{
    const size_t line = count_lines_before(source, at), start = line > 0 ? source->lines.at[line - 1] : 0;

    if (start == 0 && at >= 3 && strncmp(source->text, "\xEF\xBB\xBF", 3) == 0)
        return 3;
    return start;
}

void
qdot_source_locate(const qdot_source *source, size_t at, uint32_t *line, uint32_t *column)
{
    size_t start;

    if (at > source->length)
        at = source->length;
    start = find_start_of_line(source, at);
    *line = source->lines_before + 1 + (uint32_t)count_lines_before(source, at);
    *column = 1 + (uint32_t)qdot_utf8_columns(source->text + start, at - start);
}

/* Step back by one UTF-8 character, but not before `start`; returns its position. */
static size_t
step_back(const char *text, size_t at, size_t start)
{
    do
        at--;
    while (at > start && ((unsigned char)text[at] & 0xC0) == 0x80);
    return at;
}

static size_t
step_forward(const char *text, size_t at, size_t end)
{
    do
        at++;
    while (at < end && ((unsigned char)text[at] & 0xC0) == 0x80);
    return at;
}

/* Append bytes [from, to) as printable text: unprintable ones become `?`, a tab becomes a blank. */
static void
append_printable(qdot_text *out, const char *text, size_t from, size_t to)
{
    while (from < to) {
        size_t length = qdot_utf8_length(text + from);
        unsigned char c = (unsigned char)text[from];

        if (c == '\t') {
            qdot_text_char(out, ' ');
            from++;
        } else if (length == 0 || c < 0x20 || c == 0x7F || from + length > to) {
            qdot_text_char(out, '?');
            from = step_forward(text, from, to);
        } else {
            qdot_text_add_n(out, text + from, length);
            from += length;
        }
    }
}

static int
columns_of_line_shown(size_t width)
{
    if (width == 0 || width >= SHOWN + BESIDE)
        return SHOWN;
    return width > LEAST_SHOWN + BESIDE ? (int)width - BESIDE : LEAST_SHOWN;
}

/* Append a source line with a caret below it, cut at both ends to the given width. */
static void
append_line_with_caret(const qdot_source *source, size_t at, bool colours, size_t width, qdot_text *out)
{
    const int shown = columns_of_line_shown(width);
    size_t start = find_start_of_line(source, at), end = at, from = at, to = at;
    int columns = 0, before = 0;

    while (end < source->length && source->text[end] != '\n')
        end++;
    if (end > at && source->text[end - 1] == '\r')
        end--;
    while (from > start && before < shown * 2 / 3) {
        from = step_back(source->text, from, start);
        before++;
    }
    for (columns = before; to < end && columns < shown; columns++)
        to = step_forward(source->text, to, end);
    while (from > start && columns < shown) {
        from = step_back(source->text, from, start);
        before++;
        columns++;
    }
    qdot_text_add(out, from > start ? "  ..." : "  ");
    append_printable(out, source->text, from, to);
    qdot_text_add(out, to < end ? "...\n" : "\n");
    qdot_text_format(out, "%*s%s^%s\n", before + (from > start ? 5 : 2), "",
                     colours ? QDOT_RED : "", colours ? QDOT_COLOUR_END : "");
}

void
qdot_source_report(const qdot_source *source, size_t at, const qdot_error *error,
                   bool colours, size_t width, qdot_text *out)
{
    uint32_t line, column;

    if (at > source->length)
        at = source->length;
    qdot_source_locate(source, at, &line, &column);
    qdot_text_add(out, source->name);
    qdot_text_format(out, ":%u:%u: %serror:%s ", line, column, colours ? QDOT_RED : "",
                     colours ? QDOT_COLOUR_END : "");
    qdot_text_add(out, error->message);
    qdot_text_char(out, '\n');
    append_line_with_caret(source, at, colours, width, out);
    if (error->hint[0] != '\0') {
        qdot_text_format(out, "  %shint:%s ", colours ? QDOT_CYAN : "",
                         colours ? QDOT_COLOUR_END : "");
        qdot_text_add(out, error->hint);
        qdot_text_char(out, '\n');
    }
}
