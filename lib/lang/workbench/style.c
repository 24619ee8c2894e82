/* style.c -- the statement `style`: chooses how expressions are written. */
#include "expr/print-name.h"
#include "lang/session/output.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_style(qdot_record *r);

QDOT_STATEMENT(style) = {
    .word = "style",
    .group = QDOT_WORKBENCH,
    .usage = "style plain | unicode | flat | latex | mathml",
    .summary = "how expressions are written",
    .example = "style latex",
    .handler = carry_out_style,
};

static qdot_status
carry_out_style(qdot_record *r)
{
    static const struct {
        const char *word;
        qdot_style style;
    } styles[] = {{"plain", QDOT_PLAIN},
                  {"unicode", QDOT_UNICODE},
                  {"latex", QDOT_LATEX},
                  {"mathml", QDOT_MATHML}};
    qdot_session *session = r->cursor.session;

    /* the word `flat` alone only puts formulas on one line and leaves the style; every other word undoes that */
    session->output->flat = qdot_record_word(r, "flat") != NULL;
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++)
        if (qdot_record_word(r, styles[i].word) != NULL)
            session->output->style = styles[i].style;
    return QDOT_OK;
}
