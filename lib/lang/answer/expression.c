/* expression.c -- prints the values of a session, expressions, as formulas and as text. */
#include "lang/answer/expression.h"

#include <inttypes.h>

#include "expr/node.h"
#include "expr/print-formula.h"
#include "expr/print.h"
#include "expr/walk.h"
#include "lang/answer/print-tree.h"
#include "lang/session/history.h"

/* Whether e is the series computed last, or one member of a list of such series. */
static bool
is_series(const qdot_session *session, qdot_expr e)
{
    qdot_expr all = session->history->series;

    if (all == QDOT_NIL || e == all)
        return e == all && all != QDOT_NIL;
    for (uint32_t i = 0; qdot_expr_kind(session->pool, all) == QDOT_LIST &&
                         i < qdot_expr_count(session->pool, all);
         i++)
        if (qdot_expr_arg(session->pool, all, i) == e)
            return true;
    return false;
}

/* Whether e is small enough to be printed. */
static qdot_status
check_size(const qdot_session *session, qdot_expr e)
{
    const uint64_t size = qdot_expr_size(session->pool, e);

    if (size <= QDOT_EXPRESSION_OPERATIONS)
        return QDOT_OK;
    (void)qdot_fail(QDOT_ELIMIT, "%s%" PRIu64 " operations are too many to print: more than %u",
                    size == UINT64_MAX ? "more than " : "", size, QDOT_EXPRESSION_OPERATIONS);
    return qdot_hint("size(...) tells the size; the expression can still be used");
}

qdot_status
qdot_expression_add(qdot_session *session, qdot_expr e, qdot_notation_kind notation, qdot_formula *f,
                    qdot_formula_id parent)
{
    QDOT_TRY(check_size(session, e));
    return qdot_print_formula(session->pool, e, is_series(session, e) ? session->history->series_in : QDOT_NIL, notation, f,
                              parent);
}

qdot_status
qdot_expression_print(qdot_session *session, qdot_expr e, qdot_style style, qdot_text *out)
{
    QDOT_TRY(check_size(session, e));
    return is_series(session, e) ? qdot_print_series(session->pool, e, session->history->series_in, style, out)
                                 : qdot_print(session->pool, e, style, out);
}

qdot_status
qdot_expression_tree(qdot_session *session, qdot_expr e, qdot_text *out)
{
    QDOT_TRY(check_size(session, e));
    return qdot_print_tree(session->pool, e, out);
}
