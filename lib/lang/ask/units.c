/* units.c -- the statement `units`: the dimensions and units of all names, or of an expression. */
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/answer/shown-text.h"
#include "lang/answer/typed-name.h"
#include "lang/answer/write.h"
#include "lang/language/token-text.h"
#include "lang/session/names.h"
#include "lang/session/output.h"
#include "lang/session/units.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_units(qdot_record *r);

QDOT_STATEMENT(units) = {
    .word = "units",
    .group = QDOT_ASKING,
    .usage = "units [EXPR]",
    .summary = "the dimension and the SI unit of every name, or of an expression; what is not determined is said so",
    .example = "units",
    .nameable = true,
    .handler = carry_out_units,
};

/* Append what is known of the dimension of e. */
static qdot_status
add_dimension(qdot_session *session, qdot_expr e, qdot_text *out)
{
    const bool symbol = qdot_expr_is_class(session->pool, e, QDOT_PARAM) || qdot_expr_is_class(session->pool, e, QDOT_COORD);
    qdot_text words = {0};

    switch (qdot_units_words(session, e, &words)) {
    case QDOT_DIMENSION_KNOWN: qdot_text_add(out, qdot_text_str(&words)); break;
    case QDOT_DIMENSION_ANY: qdot_text_add(out, "0, of any dimension"); break;
    case QDOT_DIMENSION_NONE: qdot_text_add(out, "of several dimensions, or of none"); break;
    case QDOT_DIMENSION_FREE:
        qdot_text_add(out, "not determined");
        if (!symbol)
            qdot_text_format(out, ": %s", qdot_text_str(&words));
    }
    out->failed = out->failed || words.failed;
    qdot_text_clear(&words);
    return qdot_text_status(out);
}

/* Append what a person reads of it, a row of a table: name, dimension, unit. */
static qdot_status
append_shown_unit(qdot_session *session, const char *name, const qdot_text *words, const qdot_text *label, qdot_text *line)
{
    qdot_shown_row row = qdot_shown_row_begin(false);
    qdot_text written = {0};
    const qdot_status status = qdot_typed_name_print(session, name, QDOT_UNICODE, &written);

    qdot_shown_cell(&row, qdot_text_str(&written), true);
    qdot_shown_cell(&row, qdot_text_str(words), true);
    qdot_shown_cell(&row, label->n > 0 ? qdot_text_str(label) : "\u2013", true);
    qdot_shown_row_end(&row, line);
    line->failed = line->failed || written.failed;
    qdot_text_clear(&written);
    return status;
}

/* Answer for one name: a line of the text, or an object of JSON. */
static qdot_status
answer_dimension(qdot_session *session, const char *name, qdot_expr e, qdot_text *out)
{
    qdot_text label = {0}, words = {0}, line = {0};
    qdot_status status;

    qdot_units_label(session, e, &label);
    status = add_dimension(session, e, &words);
    if (status == QDOT_OK && session->output->json) {
        qdot_text_add(&line, "{\"kind\":\"unit\"");
        qdot_write_field(&line, ",\"name\":", name);
        qdot_write_field(&line, ",\"dimension\":", qdot_text_str(&words));
        qdot_write_field(&line, ",\"unit\":", qdot_text_str(&label));
        if (qdot_write_displays(session))
            status = append_shown_unit(session, name, &words, &label, &line);
        qdot_text_add(&line, "}\n");
        status = qdot_write_answer(session, status, &line);
    } else if (status == QDOT_OK) {
        qdot_text_format(out, "%s%s: %s", out->n > 0 ? "\n" : "", name, qdot_text_str(&words));
        if (label.n > 0)
            qdot_text_format(out, " [%s]", qdot_text_str(&label));
    }
    qdot_text_clear(&label);
    qdot_text_clear(&words);
    return status;
}

static qdot_status
answer_all_names(qdot_session *session, qdot_text *out)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(session->names, i)) != NULL; i++)
        if (name->kind != QDOT_NAME_FUNCTION && !(name->kind == QDOT_NAME_VALUE && !qdot_expr_is_scalar(session->pool, name->value) &&
                                                  qdot_expr_kind(session->pool, name->value) != QDOT_VEC))
            QDOT_TRY(answer_dimension(session, name->name, name->value, out));
    return QDOT_OK;
}

/* Answer for an expression: of a list for each of its members, which may have different dimensions. */
static qdot_status
answer_expression(qdot_session *session, const char *name, qdot_expr e, qdot_text *out)
{
    if (qdot_expr_kind(session->pool, e) != QDOT_LIST)
        return answer_dimension(session, name, e, out);
    for (uint32_t k = 0; k < qdot_expr_count(session->pool, e); k++) {
        qdot_text member = {0};
        qdot_status status;

        qdot_text_format(&member, "%s[%u]", name, k + 1);
        status = qdot_text_status(&member);
        if (status == QDOT_OK)
            status = answer_dimension(session, qdot_text_str(&member), qdot_expr_arg(session->pool, e, k), out);
        qdot_text_clear(&member);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

static qdot_status
carry_out_units(qdot_record *r)
{
    const qdot_filled *one = qdot_record_hole(r, NULL, "EXPR");
    qdot_session *session = r->cursor.session;
    qdot_text text = {0}, name = {0};
    qdot_expr value;
    qdot_status status;

    if (one != NULL)
        QDOT_TRY(qdot_record_value(r, one, &value));
    if (!qdot_units_on(session)) {
        r->cursor.error_at = r->start->start;
        (void)qdot_fail(QDOT_EINVAL, "no unit has been written");
        return qdot_hint("declare one, as in `param m > 0 [kg]`: the others follow where they can");
    }
    if (one != NULL) {
        qdot_token_text(session, one->from, one->to, &name);
        status = answer_expression(session, qdot_text_str(&name), value, &text);
    } else {
        status = answer_all_names(session, &text);
    }
    qdot_text_clear(&name);
    if (session->output->json || status != QDOT_OK) {
        qdot_text_clear(&text);
        return status;
    }
    return qdot_answer_written(session, "units", status, &text);
}
