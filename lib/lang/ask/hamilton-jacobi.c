/* hamilton-jacobi.c -- the statement `hamilton_jacobi`: the equation, its separated parts, the complete integral. */
#include "base/text.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/functions/separation.h"
#include "lang/session/history.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_hamilton_jacobi(qdot_record *r);

QDOT_STATEMENT(hamilton_jacobi) = {
    .word = "hamilton_jacobi",
    .group = QDOT_ASKING,
    .usage = "hamilton_jacobi",
    .summary = "the equation H(q, dS/dq, t) = -dS/dt, separated where it separates in these coordinates, p[q] = dS/dq, with "
               "its complete integral S",
    .example = "hamilton_jacobi",
    .alone = true,
    .handler = carry_out_hamilton_jacobi,
};

/* What the constants are: the energy, cyclic momenta, separation constants. */
static qdot_status
answer_constants(qdot_session *session, const qdot_separation *x)
{
    qdot_text text = {0};
    const char *before = "separated; constants: ";

    for (size_t i = 0; i <= x->n; i++) {
        const qdot_expr c = i == 0 ? x->energy : x->of[i - 1].cyclic ? x->of[i - 1].p : x->of[i - 1].constant;

        if (c == QDOT_NIL || qdot_expr_symbol(session->pool, c) == NULL || (i == 0 && qdot_separation_is_free(x)))
            continue;
        qdot_text_format(&text, "%s%s", before, qdot_expr_symbol(session->pool, c)->name);
        before = ", ";
    }
    return qdot_answer_written(session, "hamilton_jacobi", QDOT_OK, &text);
}

static qdot_status
answer_parts(qdot_session *session, const qdot_separation *x)
{
    qdot_text name = {0};
    qdot_status status = answer_constants(session, x);

    for (size_t i = 0; i < x->n && status == QDOT_OK; i++) {
        if (x->of[i].cyclic || x->of[i].q == QDOT_T)
            continue;
        qdot_text_clear(&name);
        qdot_text_format(&name, "hamilton_jacobi[%s]", qdot_expr_symbol(session->pool, x->of[i].q)->name);
        status = qdot_text_status(&name);
        if (status == QDOT_OK)
            status = qdot_answer_expr(session, qdot_text_str(&name), qdot_separated_equation(session->pool, &x->of[i]));
    }
    qdot_text_clear(&name);
    return status;
}

static qdot_status
answer_separation(qdot_session *session, const qdot_separation *x)
{
    qdot_expr equation, S;

    QDOT_TRY(qdot_session_jacobi_equation(session, x->H, &equation));
    QDOT_TRY(qdot_vec_push(&session->history->values, equation));
    QDOT_TRY(qdot_answer_expr(session, "hamilton_jacobi", equation));
    if (x->verdict == QDOT_SEPARATES)
        QDOT_TRY(answer_parts(session, x));
    S = qdot_separation_integral(session->scene, x);
    QDOT_TRY(qdot_pool_check(session->pool));
    if (S != QDOT_NIL)
        return qdot_answer_expr(session, "complete_integral", S);
    if (x->verdict == QDOT_SEPARATES)
        return QDOT_OK;
    return qdot_answer_text(session, "hamilton_jacobi",
                            x->verdict == QDOT_SEPARATES_NOT       ? "it does not separate in these coordinates: Levi-Civita's condition is not met"
                            : x->verdict == QDOT_SEPARATION_NOT_FOUND ? "it separates in these coordinates, for Levi-Civita's condition is met; the "
                                                                        "separated equations were not found"
                                                                      : "no separation was found, and none is excluded");
}

static qdot_status
carry_out_hamilton_jacobi(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_separation x = {0};
    qdot_status status = qdot_session_separate(session, QDOT_NIL, &x);

    if (status == QDOT_OK)
        status = answer_separation(session, &x);
    qdot_separation_clear(&x);
    return status;
}
