/* shown.c -- what a person reads of an answer: as text, as a part of a page, typeset. */
#include "lang/answer/shown.h"

#include <string.h>

#include "lang/answer/write.h"

qdot_status
qdot_shown_print(qdot_session *session, qdot_shown_writer write, const void *answer)
{
    qdot_sheet s = qdot_sheet_begin(session);
    const qdot_status status = write(&s, answer);

    return qdot_sheet_end(&s, "", status);
}

/* Append the answer as text in this style, or for QDOT_SHEET_PAGE as a part of a page. */
static qdot_status
write_in_form(qdot_session *session, qdot_shown_writer write, const void *answer, qdot_sheet_form form, qdot_style style,
              qdot_text *out)
{
    qdot_sheet s = form == QDOT_SHEET_PAGE ? qdot_sheet_begin_html(session) : qdot_sheet_begin_text(session, style);
    const qdot_status status = write(&s, answer);

    return form == QDOT_SHEET_PAGE ? qdot_sheet_html(&s, status, out) : qdot_sheet_text(&s, status, out);
}

qdot_status
qdot_shown_formula(qdot_session *session, qdot_shown_writer write, const void *answer, qdot_text *object)
{
    static const struct {
        qdot_sheet_form form;
        qdot_style style;
    } forms[] = {
        {QDOT_SHEET_LINES, QDOT_UNICODE}, {QDOT_SHEET_PAGE, QDOT_MATHML}, {QDOT_SHEET_LINES, QDOT_LATEX}, {QDOT_SHEET_LINES, QDOT_MATHML}};
    static const struct {
        const char *before;
        size_t form;
    } fields[] = {
        {",\"text\":", 0}, {",\"html\":", 1}, {",\"typeset\":{\"latex\":", 2}, {",\"mathml\":", 3}, {",\"unicode\":", 0}};
    qdot_text parts[sizeof forms / sizeof *forms] = {{0}};
    qdot_status status = QDOT_OK;

    if (!qdot_write_displays(session))
        return QDOT_OK;
    for (size_t i = 0; i < sizeof forms / sizeof *forms && status == QDOT_OK; i++)
        status = write_in_form(session, write, answer, forms[i].form, forms[i].style, &parts[i]);
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        qdot_write_field(object, fields[i].before, qdot_text_str(&parts[fields[i].form]));
    qdot_text_char(object, '}');
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        object->failed = object->failed || parts[i].failed;
        qdot_text_clear(&parts[i]);
    }
    return status;
}

qdot_status
qdot_shown_words(qdot_session *session, qdot_shown_writer write, const void *answer, const char *class, const char *after,
                 qdot_text *object)
{
    qdot_text text = {0}, page = {0}, html = {0};
    qdot_status status;

    if (!qdot_write_displays(session))
        return QDOT_OK;
    status = write_in_form(session, write, answer, QDOT_SHEET_LINES, QDOT_UNICODE, &text);
    if (status == QDOT_OK)
        status = write_in_form(session, write, answer, QDOT_SHEET_PAGE, QDOT_MATHML, &page);
    qdot_text_format(&html, "<div class=\"%s\">", class);
    qdot_text_add(&html, qdot_text_str(&page));
    qdot_text_add(&html, after);
    qdot_text_add(&html, "</div>\n");
    qdot_shown_fields(qdot_text_str(&text), qdot_text_str(&html), object);
    object->failed = object->failed || text.failed || page.failed || html.failed;
    qdot_text_clear(&text);
    qdot_text_clear(&page);
    qdot_text_clear(&html);
    return status;
}
