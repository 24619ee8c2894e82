/* settings.c -- include, style, timing, quit. */
#include <string.h>

#include "lang/workbench/script.h"
#include "lang/commands/statement.h"
#include "lang/language/read.h"

qdot_status
qdot_settings_include(qdot_cursor *c)
{
    const qdot_token *start = c->at;
    qdot_text path = {0};
    qdot_status status;
    const char *name;
    bool opened;

    if (c->at->kind != QDOT_TOKEN_STRING)
        return qdot_cursor_expected(c, "the name of a script in quotes");
    QDOT_TRY(qdot_read_string(c, &name));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start->start;
    qdot_session_path(c->session, name, &path);
    status = qdot_text_status(&path);
    if (status == QDOT_OK) {
        status = qdot_script_carry_out_file(c->session, qdot_text_str(&path), &opened);
        if (status != QDOT_OK && opened)
            c->error_at = QDOT_SCRIPT_REPORTED;
    }
    qdot_text_clear(&path);
    return status;
}

qdot_status
qdot_settings_style(qdot_cursor *c)
{
    static const struct {
        const char *word;
        qdot_style style;
    } styles[] = {
        {"plain", QDOT_PLAIN}, {"unicode", QDOT_UNICODE}, {"latex", QDOT_LATEX},
               {"mathml", QDOT_MATHML}};

    if (qdot_cursor_accept_word(c, "flat")) {
        QDOT_TRY(qdot_cursor_expect_end(c));
        c->session->flat = true;
        return QDOT_OK;
    }
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++) {
        if (!qdot_cursor_accept_word(c, styles[i].word))
            continue;
        QDOT_TRY(qdot_cursor_expect_end(c));
        c->session->style = styles[i].style;
        c->session->flat = false;
        return QDOT_OK;
    }
    return qdot_cursor_expected(c, "`plain`, `unicode`, `flat`, `latex` or `mathml`");
}

qdot_status
qdot_settings_timing(qdot_cursor *c)
{
    bool on = qdot_cursor_accept_word(c, "on");

    if (!on && !qdot_cursor_accept_word(c, "off"))
        return qdot_cursor_expected(c, "`on` or `off`");
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->session->timing = on;
    return QDOT_OK;
}

qdot_status
qdot_settings_quit(qdot_cursor *c)
{
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->session->quit = true;
    return QDOT_OK;
}
