/* answer.c -- answers that are expressions and numbers, as text and as JSON. */
#include "lang/answer/answer.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/number-text.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/unit.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/expression.h"
#include "lang/answer/shown.h"
#include "lang/session/output.h"
#include "lang/session/units.h"

/* --- answers that are expressions --------------------------------------------------- */

/* Whether e is a logical combination of relations, or a vector of equations. */
static bool
contains_relations(const qdot_pool *pool, qdot_expr e)
{
    qdot_kind kind = qdot_expr_kind(pool, e);

    return kind == QDOT_LOGIC ||
           (kind == QDOT_VEC &&
            qdot_value_kind_is_equation(pool, qdot_expr_arg(pool, e, 0)));
}

/* Whether two texts differ only in spaces, as A[1, 2] and A[1,2]. */
static bool
differ_only_in_spaces(const char *a, const char *b)
{
    for (;; a++, b++) {
        a += strspn(a, " ");
        b += strspn(b, " ");
        if (*a != *b || *a == '\0')
            return *a == *b;
    }
}

/* Whether a value prints exactly as its name, so that `name = value` says nothing. A value with
 * more operations than the name has characters does not. */
static qdot_status
prints_as_its_name(qdot_session *session, const char *name, qdot_expr value, bool *same)
{
    qdot_text plain = {0};
    qdot_status status;

    *same = false;
    if (qdot_expr_size(session->pool, value) > strlen(name))
        return QDOT_OK;
    status = qdot_expression_print(session, value, QDOT_PLAIN, &plain);
    if (status == QDOT_OK)
        status = qdot_text_status(&plain);
    *same = status == QDOT_OK && differ_only_in_spaces(name, qdot_text_str(&plain));
    qdot_text_clear(&plain);
    return status;
}

/* Append a unit as ` [m/s]`; for a program that shows LaTeX in upright letters, with powers. */
static void
append_unit(qdot_sheet *s, const char *unit)
{
    const bool shown = qdot_write_displays(s->session), upright = shown && s->style == QDOT_LATEX;

    if (unit == NULL)
        return;
    if (!upright) { /* at the beginning of an element a page shows no common blank */
        qdot_sheet_format(s, "%s[%s]", shown && s->form == QDOT_SHEET_PAGE ? "\u00a0" : " ", unit);
        return;
    }
    qdot_sheet_words(s, "\\ [\\mathrm{");
    while (*unit != '\0') {
        const size_t n = *unit == '^' ? strspn(unit + 1, "-0123456789") : 0;

        if (n > 0)
            qdot_sheet_format(s, "^{%.*s}", (int)n, unit + 1);
        else
            qdot_sheet_format(s, *unit == '*' ? "\\," : "%c", *unit);
        unit += 1 + n;
    }
    qdot_sheet_words(s, "}]");
}

/* Whether a unit follows a number that is written as a quotient: (1/3) [m], as in 1/3 [m] it would belong to 3 alone. */
static qdot_status
is_quotient_with_unit(const qdot_session *session, qdot_expr value, bool *quotient)
{
    qdot_text text = {0};
    qdot_status status;

    *quotient = false;
    if (session->output->unit == NULL)
        return QDOT_OK;
    status = qdot_print(session->pool, value, QDOT_PLAIN, &text);
    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK)
        *quotient = strchr(text.at, '/') != NULL && strspn(text.at, "-0123456789/") == text.n;
    qdot_text_clear(&text);
    return status;
}

/* An expression with the name under which it is answered; NULL: none. */
typedef struct {
    const char *name;
    qdot_expr symbol, value; /* symbol: what a member of momenta, accel, forces is called; QDOT_NIL: as the name */
} named_value;

/* Append `name = value`, `name: left = right`, or the value alone where the name says nothing. */
static qdot_status
append_named_value(qdot_sheet *s, const void *answer)
{
    const char *const name = ((const named_value *)answer)->name;
    const qdot_expr value = ((const named_value *)answer)->value;
    qdot_session *session = s->session;
    const bool relation = qdot_value_kind_is_equation(session->pool, value) ||
                          contains_relations(session->pool, value);
    bool bare = name == NULL || strlen(name) > 200 ||
                (relation && strpbrk(name, "=<>") != NULL);
    bool quotient = false;
    qdot_status status = QDOT_OK;

    s->operations = qdot_expr_size(session->pool, value);
    if (!bare)
        status = prints_as_its_name(session, name, value, &bare);
    qdot_sheet_open(s);
    if (status == QDOT_OK && !bare) {
        status = qdot_sheet_name(s, name, QDOT_FORMULA_LABEL);
        qdot_sheet_sign(s, !relation && value != QDOT_TRUE && value != QDOT_FALSE ? QDOT_SIGN_EQUALS
                                                                                 : QDOT_SIGN_COLON);
    }
    if (status == QDOT_OK)
        status = is_quotient_with_unit(session, value, &quotient);
    qdot_sheet_format(s, quotient ? "(" : "");
    if (status == QDOT_OK)
        status = qdot_sheet_expr(s, value);
    qdot_sheet_format(s, quotient ? ")" : "");
    append_unit(s, qdot_expr_has_units(session->pool, value) ? NULL : session->output->unit);
    return status;
}

/* Append `symbol = value`. */
static qdot_status
append_solved_value(qdot_sheet *s, const void *answer)
{
    const named_value *x = answer;
    qdot_formula_id all;

    qdot_sheet_open(s);
    all = s->at;
    s->at = qdot_formula_add(&s->formula, all, QDOT_FORMULA_SPAN, 0, QDOT_FORMULA_LABEL);
    QDOT_TRY(qdot_sheet_expr(s, x->symbol));
    s->at = all;
    qdot_sheet_sign(s, QDOT_SIGN_EQUALS);
    return qdot_sheet_expr(s, x->value);
}

/* Append the field of the present answer's unit to a JSON object. */
static void
write_unit(const qdot_session *session, qdot_text *line)
{
    if (session->output->unit != NULL)
        qdot_write_field(line, ",\"unit\":", session->output->unit);
}

/* Append the field of the units of the present answer's numbers, n of them, where these differ. */
static void
write_units(const qdot_session *session, size_t n, qdot_text *line)
{
    char *const *units = session->output->units;

    if (units == NULL)
        return;
    qdot_text_add(line, ",\"units\":[");
    for (size_t i = 0; i < n; i++) {
        qdot_text_add(line, i > 0 ? "," : "");
        if (units[i] != NULL)
            qdot_text_json(line, units[i]);
        else
            qdot_text_add(line, "null");
    }
    qdot_text_char(line, ']');
}

/* Append the field of a JSON object in which a value stands in this style. */
static qdot_status
write_value(qdot_session *session, const char *field, qdot_expr value, qdot_style style, qdot_text *line)
{
    qdot_text part = {0};
    const qdot_status status = qdot_expression_print(session, value, style, &part);

    qdot_write_field(line, field, qdot_text_str(&part));
    line->failed = line->failed || part.failed;
    qdot_text_clear(&part);
    return status;
}

static qdot_status
answer_expression_as_json(qdot_session *session, const named_value *x)
{
    const bool solved = x->symbol != QDOT_NIL;
    qdot_text line = {0};
    qdot_status status;

    qdot_write_field(&line, "{\"kind\":\"expr\",\"name\":", x->name == NULL ? "" : x->name);
    status = write_value(session, ",\"plain\":", x->value, QDOT_PLAIN, &line);
    if (status == QDOT_OK)
        status = write_value(session, ",\"latex\":", x->value, QDOT_LATEX, &line);
    if (status == QDOT_OK && qdot_write_displays(session))
        status = write_value(session, ",\"mathml\":", x->value, QDOT_MATHML, &line);
    if (status == QDOT_OK)
        status = qdot_shown_formula(session, solved ? append_solved_value : append_named_value, x, &line);
    qdot_text_format(&line, ",\"ops\":%" PRIu64, qdot_expr_size(session->pool, x->value));
    write_unit(session, &line);
    qdot_text_add(&line, "}\n");
    return qdot_write_answer(session, status, &line);
}

qdot_status
qdot_answer_expr(qdot_session *session, const char *name, qdot_expr value)
{
    const named_value x = {name, QDOT_NIL, value};

    if (qdot_expr_is_class(session->pool, value, QDOT_WORDS)) {
        const char *words = qdot_expr_symbol(session->pool, value)->name;
        qdot_sheet s;

        if (session->output->page == NULL || session->output->style != QDOT_LATEX)
            return qdot_answer_text(session, name, words);
        s = qdot_sheet_begin(session);
        qdot_sheet_open(&s); /* a formula node to hold the LaTeX text, which latex(...) returned */
        qdot_formula_add_latex(&s.formula, s.at, words, strlen(words));
        return qdot_sheet_end(&s, name, QDOT_OK);
    }
    return session->output->json ? answer_expression_as_json(session, &x) : qdot_shown_print(session, append_named_value, &x);
}

qdot_status
qdot_answer_solved(qdot_session *session, const char *name, qdot_expr symbol,
                   qdot_expr value)
{
    const named_value x = {name, symbol, value};

    return session->output->json ? answer_expression_as_json(session, &x) : qdot_shown_print(session, append_solved_value, &x);
}

/* --- answers that are numbers --------------------------------------------------------- */

/* Append an integer or a decimal number. */
static void
append_decimal(qdot_sheet *s, qdot_formula_id parent, const char *number, size_t n)
{
    const bool negative = n > 0 && *number == '-';

    if (negative)
        qdot_formula_add_sign(&s->formula, parent, QDOT_SIGN_NEGATIVE);
    qdot_formula_add_text(&s->formula, parent, QDOT_TEXT_NUMBER, number + negative, n - negative);
}

/* Whether numbers are typeset: in LaTeX, and where a program shows answers. */
static bool
is_typeset(const qdot_sheet *s)
{
    return s->style == QDOT_LATEX || qdot_write_displays(s->session);
}

/* Whether powers of ten are drawn, 1.5 · 10^(-13), instead of written, 1.5e-13. */
static bool
draws_powers(const qdot_sheet *s)
{
    return s->style == QDOT_LATEX || (s->notation == QDOT_NOTATION_DRAWN && qdot_write_displays(s->session));
}

/* Append a number, such as 1.5e-13. */
static void
append_number(qdot_sheet *s, const char *number, size_t n)
{
    const char *e = memchr(number, 'e', n);
    qdot_formula_id power;

    if (!draws_powers(s)) {
        qdot_formula_add_text(&s->formula, s->at, QDOT_TEXT_NUMBER, number, n);
        return;
    }
    append_decimal(s, s->at, number, e == NULL ? n : (size_t)(e - number));
    if (e == NULL)
        return;
    qdot_formula_add_sign(&s->formula, s->at, QDOT_SIGN_DOT);
    power = qdot_formula_add(&s->formula, s->at, QDOT_FORMULA_POWER, 0, 0);
    append_decimal(s, qdot_formula_add(&s->formula, power, QDOT_FORMULA_ROW, 0, 0), "10", 2);
    e += e[1] == '+' ? 2 : 1;
    append_decimal(s, qdot_formula_add(&s->formula, power, QDOT_FORMULA_ROW, 0, 0), e, (size_t)(number + n - e));
}

/* Append n bytes that are a number, or words: "unknown", " (error unknown)". */
static void
append_part(qdot_sheet *s, const char *text, size_t n)
{
    const bool number = strspn(text + (*text == '-'), "0123456789.") > 0 || (!is_typeset(s) && *text != ' ');

    if (number)
        append_number(s, text, n);
    else if (s->style == QDOT_LATEX)
        qdot_sheet_format(s, "\\text{%.*s}", (int)n, text);
    else
        qdot_formula_add_text(&s->formula, s->at, QDOT_TEXT_WORDS, text, n);
}

/* Append the sign between a number and its error; in LaTeX as a command. */
static void
append_plus_minus(qdot_sheet *s)
{
    if (s->style == QDOT_LATEX)
        qdot_sheet_words(s, " \\pm ");
    else
        qdot_sheet_sign(s, QDOT_SIGN_PLUS_MINUS);
}

/* How the numbers of an answer are written: with the digits that a bound of the error leaves, with two digits of a
 * standard error, or with a few digits without an error. */
typedef enum { BY_BOUND, BY_STANDARD_ERROR, BY_DIGITS } rounding;

enum { FEW_DIGITS = 4 };

/* Append numbers and the signs between them, "1.25 ± 3e-13, 0.5 - 2*i (error unknown)", as parts of a formula. */
static void
append_numerals(qdot_sheet *s, const char *at)
{
    static const struct {
        const char *text;
        qdot_formula_sign sign;
    } signs[] = {{", ", QDOT_SIGN_COMMA}, {" + ", QDOT_SIGN_PLUS}, {" - ", QDOT_SIGN_MINUS}, {"*", QDOT_SIGN_TIMES}};
    static const char error[] = " ± ";

    while (*at != '\0') {
        const size_t minus = *at == '-', digits = strspn(at + minus, "0123456789.");
        size_t n = digits > 0 ? minus + digits : 0;

        if (n > 0) {
            n += at[n] == 'e' ? 1 + strspn(at + n + 1, "+-0123456789") : 0;
            append_number(s, at, n);
        }
        for (size_t i = 0; i < sizeof signs / sizeof *signs && n == 0; i++)
            if (strncmp(at, signs[i].text, strlen(signs[i].text)) == 0) {
                n = strlen(signs[i].text);
                qdot_formula_add_sign(&s->formula, s->at, signs[i].sign);
            }
        if (n == 0 && strncmp(at, error, strlen(error)) == 0) {
            n = strlen(error);
            append_plus_minus(s);
        }
        if (n == 0 && *at == 'i') {
            n = 1;
            qdot_formula_add_text(&s->formula, s->at, QDOT_TEXT_NAME, at, n);
        }
        if (n == 0) {
            n = 1 + strcspn(at + 1, "-0123456789,");
            append_part(s, at, n);
        }
        at += n;
    }
}

/* Append a number with its error, such as 1.25 ± 3e-13. */
static void
append_number_with_error(qdot_sheet *s, double value, double error, rounding by)
{
    qdot_text number = {0};

    if (by == BY_DIGITS)
        qdot_text_double(&number, value, FEW_DIGITS);
    else if (by == BY_STANDARD_ERROR)
        qdot_number_text_estimate(&number, value, error);
    else
        qdot_number_text_with_error(&number, value, error);
    s->formula.failed = s->formula.failed || number.failed;
    append_numerals(s, qdot_text_str(&number));
    qdot_text_clear(&number);
}

/* Begin a formula with `name = `. */
static qdot_status
begin_named_formula(qdot_sheet *s, const char *name)
{
    qdot_status status;

    qdot_sheet_open(s);
    status = qdot_sheet_name(s, name, QDOT_FORMULA_LABEL);
    qdot_sheet_sign(s, QDOT_SIGN_EQUALS);
    return status;
}

/* Numbers with the name under which they are answered. */
typedef struct {
    const char *name;
    size_t n;
    const double *values, *errors;
    rounding by;
} named_numbers;

static qdot_status
append_named_numbers(qdot_sheet *s, const void *answer)
{
    const named_numbers *x = answer;
    const qdot_output *output = s->session->output;
    const qdot_status status = begin_named_formula(s, x->name);

    for (size_t i = 0; i < x->n; i++) {
        if (i > 0)
            qdot_sheet_sign(s, QDOT_SIGN_COMMA);
        append_number_with_error(s, x->values[i], x->errors[i], x->by);
        append_unit(s, output->units != NULL ? output->units[i] : NULL);
    }
    append_unit(s, output->unit);
    return status;
}

/* Numbers in digits, as text, with the name under which they are answered. */
typedef struct {
    const char *name, *text;
} named_numerals;

static qdot_status
append_named_numerals(qdot_sheet *s, const void *answer)
{
    const named_numerals *x = answer;
    const qdot_status status = begin_named_formula(s, x->name);

    if (draws_powers(s))
        append_numerals(s, x->text);
    else
        qdot_sheet_words(s, x->text);
    append_unit(s, s->session->output->unit);
    return status;
}

/* --- numbers as JSON ---------------------------------------------------------------------- */

/* Write {"kind":"number"}, or {"kind":"numbers"} if there are several; values and errors are JSON,
 * with commas; write, answer: what a person reads. */
static qdot_status
answer_numbers_as_json(qdot_session *session, const char *name, bool several, size_t n, const qdot_text *values,
                       const qdot_text *errors, qdot_shown_writer write, const void *answer)
{
    qdot_text line = {0};
    qdot_status status;

    qdot_text_format(&line, "{\"kind\":\"number%s\"", several ? "s" : "");
    qdot_write_field(&line, ",\"name\":", name);
    qdot_text_add(&line, several ? ",\"values\":[" : ",\"value\":");
    qdot_text_add(&line, qdot_text_str(values));
    qdot_text_add(&line, several ? "],\"errors\":[" : ",\"error\":");
    qdot_text_add(&line, qdot_text_str(errors));
    qdot_text_add(&line, several ? "]" : "");
    write_unit(session, &line);
    write_units(session, n, &line);
    status = qdot_shown_formula(session, write, answer, &line);
    qdot_text_add(&line, "}\n");
    line.failed = line.failed || values->failed || errors->failed;
    return qdot_write_answer(session, status, &line);
}

static qdot_status
answer_numbers(qdot_session *session, bool several, const named_numbers *x)
{
    qdot_text list[2] = {{0}};
    qdot_status status;

    if (!session->output->json)
        return qdot_shown_print(session, append_named_numbers, x);
    for (size_t i = 0; i < 2 * x->n; i++) {
        qdot_text_add(&list[i % 2], i > 1 ? "," : "");
        qdot_number_text_json(&list[i % 2], i % 2 == 0 ? x->values[i / 2] : x->errors[i / 2]);
    }
    status = answer_numbers_as_json(session, x->name, several, x->n, &list[0], &list[1], append_named_numbers, x);
    qdot_text_clear(&list[0]);
    qdot_text_clear(&list[1]);
    return status;
}

qdot_status
qdot_answer_number(qdot_session *session, const char *name, double value, double error)
{
    return answer_numbers(session, false, &(named_numbers){name, 1, &value, &error, BY_BOUND});
}

qdot_status
qdot_answer_statistic(qdot_session *session, const char *name, double value)
{
    const double unknown = NAN;

    return answer_numbers(session, false, &(named_numbers){name, 1, &value, &unknown, BY_DIGITS});
}

/* Answer with a number that e is, with its unit. */
static qdot_status
answer_quantity(qdot_session *session, qdot_expr e, const named_numbers *x)
{
    qdot_text unit = {0};
    qdot_status status;

    qdot_units_label(session, e, &unit);
    status = qdot_text_status(&unit);
    if (status == QDOT_OK && unit.n > 0)
        session->output->unit = qdot_text_str(&unit);
    if (status == QDOT_OK)
        status = answer_numbers(session, false, x);
    session->output->unit = NULL;
    qdot_text_clear(&unit);
    return status;
}

qdot_status
qdot_answer_quantity(qdot_session *session, const char *name, qdot_expr e, double value, double error)
{
    return answer_quantity(session, e, &(named_numbers){name, 1, &value, &error, BY_BOUND});
}

qdot_status
qdot_answer_estimate(qdot_session *session, const char *name, qdot_expr e, double value, double error)
{
    return answer_quantity(session, e, &(named_numbers){name, 1, &value, &error, BY_STANDARD_ERROR});
}

qdot_status
qdot_answer_numbers(qdot_session *session, const char *name, size_t n,
                    const double *values, const double *errors)
{
    return answer_numbers(session, true, &(named_numbers){name, n, values, errors, BY_BOUND});
}

qdot_status
qdot_answer_statistics(qdot_session *session, const char *name, size_t n, const double *values, const double *errors)
{
    return answer_numbers(session, true, &(named_numbers){name, n, values, errors, BY_DIGITS});
}

qdot_status
qdot_answer_numerals(qdot_session *session, const char *name, bool several, qdot_status status, qdot_numerals *x)
{
    const named_numerals all = {name, qdot_text_str(&x->text)};

    if (status == QDOT_OK)
        status = qdot_text_status(&x->text);
    if (status == QDOT_OK)
        status = session->output->json
                     ? answer_numbers_as_json(session, name, several, 0, &x->values, &x->errors, append_named_numerals, &all)
                     : qdot_shown_print(session, append_named_numerals, &all);
    qdot_text_clear(&x->values);
    qdot_text_clear(&x->errors);
    qdot_text_clear(&x->text);
    return status;
}
