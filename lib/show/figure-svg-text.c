/* figure-svg-text.c -- labels in SVG: gnuplot's markup, in which labels are, as <text> with raised and lowered parts.
 *
 * The markup is what qdot_formula_write_gnuplot writes: \c is the character c; ^{...} and _{...} an exponent and an index, which may begin with
 * a size, as of 0.97; @ before one of them: it takes no room, so that what follows stands below or above it.
 */
#include <string.h>

#include "base/utf8.h"
#include "show/figure-svg.h"

/* Sizes of letters in exponents and indices, and how far they stand above and below the line, in letters of the line. */
static const double SMALL = 0.7, UP = 0.42, DOWN = 0.26, LETTER = 0.56;

/* Where the writer is: how much the present part is raised above the line, in letters, what takes it back, and how many
 * letters of room the last part was given that it must not take. */
typedef struct {
    qdot_text *out;
    double level, wanted, back;
    bool small, open;
} svg_writer;

/* Begin a part of the text with a level and size of its own, unless the present one has them. */
static void
turn_to(svg_writer *w, double level, bool small)
{
    const double size = small ? SMALL : 1;

    if (w->open && w->level == level && w->small == small && w->back == 0)
        return;
    if (w->open)
        qdot_text_add(w->out, "</tspan>");
    w->open = false;
    if (level == 0 && w->level == 0 && !small && w->back == 0) {
        w->small = small;
        return;
    }
    qdot_text_add(w->out, "<tspan dy=\"");
    qdot_text_double(w->out, (w->level - level) / size, 3);
    qdot_text_add(w->out, "em\"");
    if (w->back > 0) {
        qdot_text_add(w->out, " dx=\"-");
        qdot_text_double(w->out, w->back / size, 3);
        qdot_text_add(w->out, "em\"");
    }
    if (small)
        qdot_text_add(w->out, " font-size=\"70%\"");
    qdot_text_char(w->out, '>');
    w->level = level;
    w->small = small;
    w->back = 0;
    w->open = true;
}

/* Append the n bytes of a character in the part to which it belongs. */
static void
svg_add_letter(svg_writer *w, const char *at, size_t n)
{
    turn_to(w, w->wanted, w->wanted != 0);
    qdot_text_html(w->out, at, n, false);
}

/* The end of a part in braces that begins at `at`, after its brace; the number of letters in it. */
static const char *
end_of_part(const char *at, size_t *letters)
{
    int depth = 1;

    *letters = 0;
    for (; *at != '\0'; at += qdot_utf8_length(at) > 0 ? qdot_utf8_length(at) : 1) {
        if (*at == '\\' && at[1] != '\0')
            at++;
        else if (*at == '{')
            depth++;
        else if (*at == '}' && --depth == 0)
            break;
        ++*letters;
    }
    return at;
}

/* Append a part of the markup, from `at` to `end`; parts in braces within a raised or lowered one stay on its level. */
static void
svg_add_markup(svg_writer *w, const char *at, const char *end)
{
    double room = 0;

    while (at < end) {
        const size_t n = qdot_utf8_length(at) > 0 ? qdot_utf8_length(at) : 1;
        size_t letters;

        if (*at == '\\' && at + 1 < end) {
            svg_add_letter(w, at + 1, 1);
            at += 2;
        } else if (*at == '@') {
            room = 1;
            at++;
        } else if ((*at == '^' || *at == '_') && at[1] == '{') {
            const char *from = at + 2, *to = end_of_part(from, &letters);
            const double outer = w->wanted;

            if (strncmp(from, "/*", 2) == 0)
                from += strcspn(from, " ") + 1;
            w->wanted = outer != 0 ? outer : *at == '^' ? UP : -DOWN;
            svg_add_markup(w, from, to);
            w->wanted = outer;
            w->back = room * LETTER * SMALL * (double)letters;
            room = 0;
            at = to < end ? to + 1 : end;
        } else if (*at == '{' || *at == '}') {
            at++;
        } else {
            svg_add_letter(w, at, n);
            at += n;
        }
    }
}

void
qdot_figure_svg_begin_text(qdot_text *s, double x, double y, const char *anchor)
{
    qdot_text_add(s, "<text x=\"");
    qdot_figure_svg_add(s, x);
    qdot_text_add(s, "\" y=\"");
    qdot_figure_svg_add(s, y);
    qdot_text_format(s, "\" text-anchor=\"%s\"", anchor);
}

void
qdot_figure_svg_end_text(qdot_text *s, const char *markup)
{
    svg_writer w = {.out = s};

    qdot_text_char(s, '>');
    svg_add_markup(&w, markup, markup + strlen(markup));
    qdot_text_add(s, w.open ? "</tspan></text>\n" : "</text>\n");
}

void
qdot_figure_svg_add_text(qdot_text *s, double x, double y, const char *anchor, const char *markup)
{
    qdot_figure_svg_begin_text(s, x, y, anchor);
    qdot_figure_svg_end_text(s, markup);
}
