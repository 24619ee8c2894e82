/* page.c -- writes answers as parts of an HTML page: headings and formulas. */
#include "show/page.h"

#include <string.h>

#include "base/paper.h"
#include "formula/write.h"
#include "show/animation.h"
#include "show/formulas.h"

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
    qdot_text_format(out, "@page{size:%s}\n", qdot_paper_name());
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

/* --- writing lines ------------------------------------------------------------------- */

static void
escape_html(qdot_text *out, const char *text, size_t n)
{
    char one[2] = {0};

    for (size_t i = 0; i < n; i++) {
        one[0] = text[i];
        qdot_animation_escape(out, one);
    }
}

/* Whether a formula may be broken into two lines before this sign (=, + or -). */
static bool
is_line_break(const qdot_formula_node *node)
{
    return node->kind == QDOT_FORMULA_SIGN &&
           (node->what == QDOT_SIGN_EQUALS || node->what == QDOT_SIGN_PLUS ||
            node->what == QDOT_SIGN_MINUS);
}

static qdot_status
write_mathml_parts(qdot_text *out, const qdot_formula *f, const qdot_formula_parts *parts)
{
    static const char tag[] = "<mo>";

    qdot_text_add(out, "<math>");
    for (size_t i = 0; i < parts->part.n; i++) {
        const bool apart = i > 0 && is_line_break(qdot_formula_at(f, parts->part.at[i]));
        qdot_text sign = {0};

        if (!apart) {
            QDOT_TRY(qdot_formula_write_page(f, parts->part.at[i], qdot_formula_before_part(parts, i), out));
            continue;
        }
        /* divide the formula here: the blank between the two elements is the space before the sign */
        qdot_text_add(out, "</math> <math><mo form=\"infix\" lspace=\"0\">");
        if (qdot_formula_write_page(f, parts->part.at[i], (qdot_formula_before){0}, &sign) == QDOT_OK)
            qdot_text_add(out, qdot_text_str(&sign) + strlen(tag));
        out->failed = out->failed || sign.failed;
        qdot_text_clear(&sign);
    }
    qdot_text_add(out, "</math>");
    return qdot_text_status(out);
}

static qdot_status
page_write_formula(qdot_text *out, const qdot_formula *f, qdot_formula_id formula)
{
    qdot_formula_parts parts = {0};
    qdot_status status = qdot_formula_find_parts(f, formula, &parts);

    if (status == QDOT_OK)
        status = write_mathml_parts(out, f, &parts);
    qdot_formula_parts_clear(&parts);
    return status;
}

bool
qdot_page_is_heading(const char *text, bool more)
{
    const size_t digits = strspn(text, "0123456789");

    return digits > 0 && strncmp(text + digits, ". ", 2) == 0 &&
           (text[digits + 2] != '\0' || more);
}

/* Read the texts before the first formula of a line; *more: whether there is a formula. */
static void
read_leading_texts(const qdot_formula *f, qdot_formula_id line, qdot_text *lead, bool *more)
{
    *more = false;
    for (qdot_formula_id c = 0; !*more && (c = qdot_formula_child(f, line, c)) != 0;) {
        const qdot_formula_node *node = qdot_formula_at(f, c);

        *more = node->kind != QDOT_FORMULA_TEXT;
        if (!*more)
            qdot_text_add_n(lead, f->text.at + node->child, node->n);
    }
}

qdot_status
qdot_page_line(qdot_text *out, const qdot_formula *f, qdot_formula_id line)
{
    qdot_text lead = {0};
    bool more;
    size_t blanks;
    const char *tag, *text;

    read_leading_texts(f, line, &lead, &more);
    text = qdot_text_str(&lead);
    blanks = strspn(text, " ");
    if (text[blanks] == '\0' && !more) {
        qdot_text_clear(&lead);
        return QDOT_OK;
    }
    tag = qdot_page_is_heading(text + blanks, more) ? "h3>"
          : blanks > 0 || text[0] == '\0'           ? "p class=\"formula\">"
                                                    : "p>";
    out->failed = out->failed || lead.failed;
    qdot_text_clear(&lead);
    qdot_text_char(out, '<');
    qdot_text_add(out, tag);
    for (qdot_formula_id c = 0; (c = qdot_formula_child(f, line, c)) != 0;) {
        const qdot_formula_node *node = qdot_formula_at(f, c);
        const size_t skipped =
            node->kind == QDOT_FORMULA_TEXT && blanks < node->n ? blanks : node->n;

        if (node->kind != QDOT_FORMULA_TEXT)
            QDOT_TRY(page_write_formula(out, f, c));
        else
            escape_html(out, f->text.at + node->child + skipped, node->n - skipped);
        blanks -=
            node->kind == QDOT_FORMULA_TEXT ? skipped < blanks ? skipped : blanks : 0;
    }
    qdot_text_add(out, tag[0] == 'h' ? "</h3>\n" : "</p>\n");
    return qdot_text_status(out);
}

void
qdot_page_verbatim(qdot_text *out, const char *text)
{
    qdot_text_add(out, "<pre>");
    qdot_animation_escape(out, text);
    qdot_text_add(out, "</pre>\n");
}
