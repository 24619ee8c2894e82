/* derive-lines.c -- the lines of `derive`. */
#include <string.h>

#include "lang/ask/derive-lines.h"

#include "expr/print.h"
#include "expr/symbol.h"
#include "lang/answer/notation.h"
#include "lang/session/session.h"
#include "mech/scene/scene.h"

/* Whether symbols are written in one line, v[bob]^2, rather than with raised and lowered parts. */
static bool
is_written_in_one_line(const qdot_sheet *s)
{
    return s->form == QDOT_SHEET_DRAWN || s->notation != QDOT_NOTATION_DRAWN;
}

/* The notation in which the formulas within a line are written. */
static qdot_notation_kind
notation_within_line(const qdot_sheet *s)
{
    return s->notation == QDOT_NOTATION_SCRIPT ? QDOT_NOTATION_SCRIPT : QDOT_NOTATION_LINE;
}

/* Append the formula in the title of a step. */
static qdot_status
append_formula_of_step(qdot_sheet *s, void *data)
{
    const char *formula = *(const char **)data;
    qdot_text line = {0};

    if (is_written_in_one_line(s)) {
        qdot_notation_print(formula, notation_within_line(s), &line);
        qdot_sheet_words(s, qdot_text_str(&line));
    } else {
        qdot_sheet_open(s);
        qdot_notation_add(&s->formula, s->at, formula, QDOT_NOTATION_DRAWN);
        qdot_sheet_close(s);
    }
    s->formula.failed = s->formula.failed || line.failed;
    qdot_text_clear(&line);
    return QDOT_OK;
}

void
qdot_derive_step(qdot_derivation *d, const char *title, const char *formula)
{
    qdot_sheet *s = &d->sheet;

    qdot_sheet_format(s, "%s%d. %s%s", d->step > 0 ? "\n" : "", d->step + 1, title, formula != NULL ? ": " : "");
    d->step++;
    if (formula != NULL)
        (void)!qdot_sheet_each(s, append_formula_of_step, &formula); /* its failure is kept by the sheet */
    qdot_sheet_words(s, "\n");
}

void
qdot_derive_label(qdot_derivation *d, const char *what, const char *of, const char *joined, const char *name)
{
    qdot_sheet_format(&d->sheet, "    %s%s%s%s%s: ", what, of != NULL ? " of " : "", of != NULL ? of : "",
                      name != NULL ? joined : "", name != NULL ? name : "");
}

/* Append ` = value`, and end the formula and its line. */
static qdot_status
write_equal_to(qdot_derivation *d, qdot_expr value)
{
    qdot_sheet_sign(&d->sheet, QDOT_SIGN_EQUALS);
    QDOT_TRY(qdot_sheet_expr(&d->sheet, value));
    qdot_sheet_close(&d->sheet);
    qdot_sheet_words(&d->sheet, "\n");
    return QDOT_OK;
}

/* Add a symbol, squared or not, in one line of text: letter, index in brackets, square. */
static qdot_status
append_symbol_in_line(qdot_sheet *s, const qdot_derived_symbol *x)
{
    const bool script = notation_within_line(s) == QDOT_NOTATION_SCRIPT;
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    qdot_notation_print(x->letter, notation_within_line(s), &text);
    if (x->of != NULL) {
        qdot_text_char(&text, '[');
        if (x->coordinate != QDOT_NIL)
            status = qdot_print(s->session->pool, x->coordinate, script ? QDOT_PLAIN : QDOT_UNICODE, &text);
        else
            qdot_text_add(&text, x->of);
        qdot_text_char(&text, ']');
    }
    qdot_text_add(&text, !x->square ? "" : script ? "^2" : "²");
    if (status == QDOT_OK)
        qdot_formula_add_text(&s->formula, s->at, QDOT_TEXT_WORDS, qdot_text_str(&text), text.n);
    s->formula.failed = s->formula.failed || text.failed;
    qdot_text_clear(&text);
    return status;
}

/* Add a symbol, squared or not, to a drawn formula: index below, square above. */
static qdot_status
append_drawn_symbol(qdot_sheet *s, const qdot_derived_symbol *x)
{
    qdot_formula *f = &s->formula;
    const qdot_formula_id outer = s->at,
                          power = x->square ? qdot_formula_add(f, outer, QDOT_FORMULA_POWER, 0, 0) : outer;
    qdot_formula_id index, row;
    qdot_status status = QDOT_OK;

    if (x->of == NULL) {
        qdot_notation_add(f, power, x->letter, QDOT_NOTATION_DRAWN);
    } else {
        index = qdot_formula_add(f, power, QDOT_FORMULA_INDEX, 0, 0);
        row = qdot_formula_add(f, index, QDOT_FORMULA_ROW, 0, 0);
        qdot_notation_add(f, row, x->letter, QDOT_NOTATION_DRAWN);
        s->at = qdot_formula_add(f, index, QDOT_FORMULA_ROW, 0, 0);
        if (x->coordinate != QDOT_NIL)
            status = qdot_sheet_expr(s, x->coordinate);
        else
            qdot_formula_add_text(f, s->at, QDOT_TEXT_LABEL, x->of, strlen(x->of));
    }
    if (x->square)
        qdot_formula_add_text(f, power, QDOT_TEXT_NUMBER, "2", 1);
    s->at = outer;
    return status;
}

static qdot_status
append_symbol(qdot_sheet *s, void *data)
{
    const qdot_derived_symbol *x = data;

    return is_written_in_one_line(s) ? append_symbol_in_line(s, x) : append_drawn_symbol(s, x);
}

/* Indent the line if it is still empty. */
static void
indent_empty_line(qdot_derivation *d)
{
    if (qdot_sheet_at_begin(&d->sheet))
        qdot_sheet_words(&d->sheet, "    ");
}

qdot_status
qdot_derive_equation(qdot_derivation *d, qdot_derived_symbol x, qdot_expr value)
{
    QDOT_TRY(qdot_pool_check(d->session->pool));
    indent_empty_line(d);
    qdot_sheet_open(&d->sheet);
    QDOT_TRY(qdot_sheet_each(&d->sheet, append_symbol, &x));
    return write_equal_to(d, value);
}

/* dF/dq, with d/dt before it. */
typedef struct {
    char F;
    bool total;
    qdot_expr q;
} derivative;

static qdot_status
append_derivative(qdot_sheet *sheet, void *data)
{
    const derivative *x = data;
    qdot_formula *f = &sheet->formula;
    const qdot_formula_id outer = sheet->at;
    qdot_formula_id fraction;

    if (x->total) {
        qdot_notation_add(f, outer, "d/dt", sheet->notation);
        qdot_sheet_sign(sheet, QDOT_SIGN_BESIDE);
    }
    fraction = qdot_formula_add(f, outer, QDOT_FORMULA_FRACTION, 0, 0);
    for (int side = 0; side < 2; side++) {
        sheet->at = qdot_formula_add(f, fraction, QDOT_FORMULA_ROW, 0, 0);
        qdot_sheet_sign(sheet, QDOT_SIGN_PARTIAL);
        qdot_sheet_sign(sheet, QDOT_SIGN_BLANK);
        if (side == 0)
            qdot_formula_add_text(f, sheet->at, QDOT_TEXT_NAME, &x->F, 1);
        else
            QDOT_TRY(qdot_sheet_expr(sheet, x->q));
    }
    sheet->at = outer;
    return QDOT_OK;
}

qdot_status
qdot_derive_derivative(qdot_derivation *d, char F, bool total, bool fast, size_t i, qdot_expr value)
{
    qdot_session *s = d->session;
    derivative x = {F, total, qdot_symbol_jet(s->pool, s->scene->coordinates.at[i], fast)};

    QDOT_TRY(qdot_pool_check(s->pool));
    qdot_sheet_words(&d->sheet, "    ");
    qdot_sheet_open(&d->sheet);
    QDOT_TRY(qdot_sheet_each(&d->sheet, append_derivative, &x));
    return write_equal_to(d, value);
}

qdot_status
qdot_derive_relation(qdot_derivation *d, qdot_expr e)
{
    QDOT_TRY(qdot_pool_check(d->session->pool));
    indent_empty_line(d);
    QDOT_TRY(qdot_sheet_formula(&d->sheet, e));
    qdot_sheet_words(&d->sheet, "\n");
    return QDOT_OK;
}
