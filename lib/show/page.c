/* page.c -- answers as parts of a page: headings and formulas. */
#include "show/page.h"
#include "show/formulas.h"
#include "show/scripts.h"

#include <ctype.h>
#include <string.h>

#include "show/animation.h"

static const char style[] = {
#include "show/page-css.inc"
};

void
qdot_page_begin(qdot_text *out, const char *title)
{
    qdot_text_add(
        out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
             "<meta name=\"viewport\" content=\"width=device-width\">\n"
             "<meta name=\"color-scheme\" content=\"light dark\">\n<title>");
    qdot_animation_escape(out, title);
    qdot_text_add(out, "</title>\n<style>\n");
    qdot_text_add(out, style);
    qdot_text_add(out, "</style>\n");
    qdot_animation_head(out);
    qdot_text_add(out, "</head>\n<body>\n<main>\n<h1>");
    qdot_animation_escape(out, title);
    qdot_text_add(out, "</h1>\n");
}

void
qdot_page_end(qdot_text *out)
{
    qdot_text_add(out, "</main>\n");
    qdot_formulas_foot(out);
    qdot_animation_foot(out);
    qdot_text_add(out, "</body>\n</html>\n");
}

/* --- formulas ----------------------------------------------------------------------- */

static void
escape_n(qdot_text *out, const char *text, size_t n)
{
    char one[2] = {0};

    for (size_t i = 0; i < n; i++) {
        one[0] = text[i];
        qdot_animation_escape(out, one);
    }
}

static bool
text_begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

/* The operator before which a formula may be divided; its length, 0: none. */
static size_t
break_before(const char *at)
{
    static const char *const operators[] = {"<mo>=</mo>", "<mo>+</mo>",
                                            "<mo>\u2212</mo>"};

    for (size_t i = 0; i < sizeof operators / sizeof *operators; i++)
        if (text_begins(at, operators[i]))
            return strlen(operators[i]);
    return 0;
}

/* What stands between <math ...> and </math>, [n]. */
static void
add_formula(qdot_text *out, const char *at, size_t n)
{
    qdot_text formula = {0};
    const char *end;
    bool operand = false; /* something stands before that an operator may follow */
    int depth = 0;

    qdot_page_add_mathml(&formula, at, n);
    at = qdot_text_str(&formula);
    end = at + formula.n;
    qdot_text_add(out, "<math>");
    while (at < end) {
        const char *close = memchr(at, '>', (size_t)(end - at));
        size_t mark = depth == 0 && operand ? break_before(at) : 0;

        if (mark > 0) {
            /* the blank is the room before it */
            qdot_text_add(out, "</math> <math><mo form=\"infix\" lspace=\"0\">");
            qdot_text_add_n(out, at + 4, mark - 4);
            at += mark;
            operand = false;
            continue;
        }
        if (*at != '<' || close == NULL) {
            qdot_text_char(out, *at++);
            continue;
        }
        depth += at[1] == '/' ? -1 : close[-1] == '/' ? 0 : 1;
        qdot_text_add_n(out, at, (size_t)(close + 1 - at));
        operand = operand || depth == 0;
        at = close + 1;
    }
    qdot_text_add(out, "</math>");
    out->failed = out->failed || formula.failed;
    qdot_text_clear(&formula);
}

/* A text in which MathML may stand. */
static void
add_mixed(qdot_text *out, const char *at, const char *end)
{
    static const char close[] = "</math>";

    while (at < end) {
        const char *open = strstr(at, "<math"), *inside, *behind;

        if (open == NULL || open >= end) {
            escape_n(out, at, (size_t)(end - at));
            return;
        }
        escape_n(out, at, (size_t)(open - at));
        inside = memchr(open, '>', (size_t)(end - open));
        behind = inside != NULL ? strstr(inside, close) : NULL;
        if (behind == NULL || behind >= end) {
            escape_n(out, open, (size_t)(end - open));
            return;
        }
        add_formula(out, inside + 1, (size_t)(behind - inside - 1));
        at = behind + sizeof close - 1;
    }
}

/* `12. Title` */
static bool
is_heading(const char *at, const char *end)
{
    const char *c = at;

    while (c < end && isdigit((unsigned char)*c))
        c++;
    return c > at && end - c > 2 && c[0] == '.' && c[1] == ' ';
}

void
qdot_page_lines(qdot_text *out, const char *lines)
{
    while (*lines != '\0') {
        const char *end = strchr(lines, '\n'), *at = lines, *tag;
        bool set_in = *lines == ' ';

        if (end == NULL)
            end = lines + strlen(lines);
        lines = *end == '\n' ? end + 1 : end;
        while (at < end && *at == ' ')
            at++;
        if (at == end)
            continue;
        tag = is_heading(at, end)    ? "h3>"
              : set_in || *at == '<' ? "p class=\"formula\">"
                                     : "p>";
        qdot_text_char(out, '<');
        qdot_text_add(out, tag);
        add_mixed(out, at, end);
        qdot_text_add(out, tag[0] == 'h' ? "</h3>\n" : "</p>\n");
    }
}

void
qdot_page_verbatim(qdot_text *out, const char *text)
{
    qdot_text_add(out, "<pre>");
    qdot_animation_escape(out, text);
    qdot_text_add(out, "</pre>\n");
}
