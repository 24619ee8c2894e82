/* print.c -- the statement `print`: writes expressions and texts in one line. */
#include "base/number-text.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "lang/answer/answer.h"
#include "lang/answer/digits.h"
#include "lang/answer/sheet.h"
#include "lang/ask/ask.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/syntax/record.h"

static qdot_status print_line(qdot_record *r);

QDOT_STATEMENT(print) = {
    .word = "print",
    .group = QDOT_WORKBENCH,
    .usage = "print [EXPR, \"text\", ...]",
    .summary = "expressions and texts in one line",
    .example = "print \"T is\", T",
    .handler = print_line,
};

/* Whether e is a list of texts, which are printed on separate lines. */
static bool
is_list_of_texts(const qdot_pool *pool, qdot_expr e)
{
    bool list = qdot_expr_kind(pool, e) == QDOT_LIST;
    uint32_t n = list ? qdot_expr_count(pool, e) : 0;

    for (uint32_t i = 0; i < n && list; i++)
        list = qdot_expr_is_class(pool, qdot_expr_arg(pool, e, i), QDOT_WORDS);
    return list && n > 0;
}

static void
append_texts(qdot_sheet *sheet, qdot_expr list)
{
    const qdot_pool *pool = sheet->session->pool;

    for (uint32_t i = 0; i < qdot_expr_count(pool, list); i++) {
        qdot_sheet_words(sheet, i > 0 ? "\n" : "");
        qdot_sheet_words(sheet, qdot_expr_symbol(pool, qdot_expr_arg(pool, list, i))->name);
    }
}

/* Append a number of a run that was made with the option `digits`, to its known digits. */
static qdot_status
append_known_digits(qdot_sheet *sheet, qdot_expr member, int digits, double error)
{
    qdot_text number = {0};
    qdot_status status = qdot_digits_text(sheet->session, member, digits, error, &number);

    if (status == QDOT_OK)
        status = qdot_text_status(&number);
    if (status == QDOT_OK)
        qdot_sheet_words(sheet, qdot_text_str(&number));
    qdot_text_clear(&number);
    return status;
}

/* Print one argument: a quoted text unchanged, results of runs as numbers. */
static qdot_status
print_argument(qdot_record *r, const qdot_filled *one, qdot_sheet *sheet)
{
    qdot_session *session = r->cursor.session;
    qdot_expr value;
    double x, error;
    int digits;

    if (!qdot_filled_is(one, "EXPR")) {
        qdot_sheet_words(sheet, qdot_record_text(one));
        return QDOT_OK;
    }
    QDOT_TRY(qdot_record_value(r, one, &value));
    if (is_list_of_texts(session->pool, value)) {
        append_texts(sheet, value);
        return QDOT_OK;
    }
    if (!qdot_measured_occurs(session, value))
        return qdot_sheet_formula(sheet, value);
    if (qdot_value_kind_are_equations(session->pool, value))
        return qdot_ask_print_point(sheet, value);
    digits = qdot_digits_of(session, value);
    for (uint32_t i = 0;; i++) {
        bool scalar = qdot_expr_is_scalar(session->pool, value);
        qdot_expr member;

        if (!scalar && i >= qdot_expr_count(session->pool, value))
            return QDOT_OK;
        member = scalar ? value : qdot_expr_arg(session->pool, value, i);
        QDOT_TRY(qdot_session_number(session, member, &x, &error));
        qdot_sheet_words(sheet, i > 0 ? ", " : "");
        if (digits > 0)
            QDOT_TRY(append_known_digits(sheet, member, digits, error));
        else
            qdot_sheet_known(sheet, x, error);
        if (scalar)
            return QDOT_OK;
    }
}

static qdot_status
print_line(qdot_record *r)
{
    qdot_sheet sheet = qdot_sheet_begin_words(r->cursor.session);
    qdot_status status = QDOT_OK;

    for (size_t i = 1; i < r->parts.n && status == QDOT_OK; i++) {
        if (r->parts.at[i].node->kind != QDOT_USAGE_HOLE)
            continue;
        qdot_sheet_words(&sheet, qdot_sheet_is_empty(&sheet) ? "" : " ");
        status = print_argument(r, &r->parts.at[i], &sheet);
    }
    return qdot_sheet_end(&sheet, "print", status);
}
