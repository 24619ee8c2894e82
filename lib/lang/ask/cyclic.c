/* cyclic.c -- the statement `cyclic`: lists the coordinates absent from L, each with its momentum. */
#include "expr/build.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/answer/sheet.h"
#include "lang/session/output.h"
#include "lang/syntax/record.h"
#include "mech/dynamics/quantity.h"

static qdot_status carry_out_cyclic(qdot_record *r);

QDOT_STATEMENT(cyclic) = {
    .word = "cyclic",
    .group = QDOT_ASKING,
    .usage = "cyclic",
    .summary = "the coordinates absent from L, each with its momentum",
    .example = "cyclic",
    .alone = true,
    .handler = carry_out_cyclic,
};

/* Print `theta: p[theta] = ... is conserved`, or the momentum with its rate. */
static qdot_status
print_cyclic(qdot_sheet *sheet, const qdot_cyclic *one)
{
    qdot_pool *pool = sheet->session->pool;
    qdot_expr p = qdot_symbol_of(pool, QDOT_MOMENTUM, one->coordinate);

    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_sheet_formula(sheet, one->coordinate));
    qdot_sheet_words(sheet, ": ");
    qdot_sheet_open(sheet);
    QDOT_TRY(qdot_sheet_expr(sheet, p));
    qdot_sheet_sign(sheet, QDOT_SIGN_EQUALS);
    QDOT_TRY(qdot_sheet_expr(sheet, one->momentum));
    qdot_sheet_close(sheet);
    if (one->rate == QDOT_NIL) {
        qdot_sheet_words(sheet, " is conserved");
        return QDOT_OK;
    }
    qdot_sheet_words(sheet, " changes at the rate ");
    return qdot_sheet_formula(sheet, one->rate);
}

/* With --json the momenta are values too: `p[theta] = ...` by the name of
 * cyclic[theta]. */
static qdot_status
answer_cyclic(qdot_session *session, const qdot_cyclic *one)
{
    qdot_pool *pool = session->pool;
    qdot_expr p = qdot_symbol_of(pool, QDOT_MOMENTUM, one->coordinate);
    qdot_expr equation = qdot_rel(pool, QDOT_EQ, p, one->momentum);
    qdot_text name = {0};
    qdot_status status;

    QDOT_TRY(qdot_pool_check(pool));
    qdot_text_format(&name, "cyclic[%s]", qdot_expr_symbol(pool, one->coordinate)->name);
    status = qdot_text_status(&name);
    if (status == QDOT_OK)
        status = qdot_answer_expr(session, qdot_text_str(&name), equation);
    qdot_text_clear(&name);
    return status;
}

static qdot_status
carry_out_cyclic(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_status status = QDOT_OK;
    qdot_cyclic *list;
    qdot_sheet sheet;
    size_t n;

    QDOT_TRY(qdot_mech_cyclic(session->scene, &list, &n));
    sheet = qdot_sheet_begin(session);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        qdot_sheet_words(&sheet, i > 0 ? "\n" : "");
        status = print_cyclic(&sheet, &list[i]);
        if (status == QDOT_OK && session->output->json && !session->output->display) /* the lines below say the same */
            status = answer_cyclic(session, &list[i]);
    }
    if (n == 0)
        qdot_sheet_words(&sheet, "no coordinate is cyclic");
    qdot_free(list);
    return qdot_sheet_end(&sheet, "cyclic", status);
}
