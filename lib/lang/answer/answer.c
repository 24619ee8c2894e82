/* answer.c -- writes every kind of answer of the program, as text and as JSON. */
#include "lang/answer/answer.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/number-text.h"
#include "base/sink.h"
#include "base/terminal.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/expression.h"
#include "lang/answer/sheet.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "lang/session/measured.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/session/typed.h"
#include "lang/session/units.h"
#include "lang/source/source.h"

/* The terminal code of a colour; "" if answers are shown without colours. */
static const char *
get_colour_code(const qdot_session *session, const char *code)
{
    return qdot_write_colours(session) ? code : "";
}

/* End a JSON object: write it if `status` is QDOT_OK; free its text in any case. */
static qdot_status
finish_json_object(qdot_session *session, qdot_status status, qdot_text *line)
{
    if (status == QDOT_OK)
        status = qdot_write_object(session, session->output->out, line);
    qdot_text_clear(line);
    return status;
}

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

/* Append the unit of the present answer, as ` [m/s]`. */
static void
append_unit(qdot_sheet *s)
{
    const char *unit = s->session->output->unit;

    if (unit != NULL)
        qdot_sheet_format(s, " [%s]", unit);
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

/* Append `name = value`, `name: left = right`, or the value alone where the name says nothing. */
static qdot_status
append_named_value(qdot_sheet *s, const char *name, qdot_expr value)
{
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
    append_unit(s);
    return status;
}

static qdot_status
answer_expression_as_text(qdot_session *session, const char *name, qdot_expr value)
{
    qdot_sheet s = qdot_sheet_begin(session);
    const qdot_status status = append_named_value(&s, name, value);

    return qdot_sheet_end(&s, "", status);
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

/* Append the field in which the whole answer stands in this style, as `name = value`. */
static qdot_status
write_named_value(qdot_session *session, const char *field, const char *name, qdot_expr value, qdot_style style,
                  qdot_text *line)
{
    qdot_sheet s = qdot_sheet_begin_text(session, style);
    qdot_text part = {0};
    qdot_status status = append_named_value(&s, name, value);

    status = qdot_sheet_text(&s, status, &part);
    qdot_write_field(line, field, qdot_text_str(&part));
    line->failed = line->failed || part.failed;
    qdot_text_clear(&part);
    return status;
}

/* Append what a program that typesets answers needs besides: the value in MathML, the whole answer in two notations. */
static qdot_status
write_typeset(qdot_session *session, const char *name, qdot_expr value, qdot_text *line)
{
    if (!qdot_write_displays(session))
        return QDOT_OK;
    QDOT_TRY(write_value(session, ",\"mathml\":", value, QDOT_MATHML, line));
    QDOT_TRY(write_named_value(session, ",\"typeset\":{\"latex\":", name, value, QDOT_LATEX, line));
    QDOT_TRY(write_named_value(session, ",\"mathml\":", name, value, QDOT_MATHML, line));
    qdot_text_char(line, '}');
    return QDOT_OK;
}

static qdot_status
answer_expression_as_json(qdot_session *session, const char *name, qdot_expr value)
{
    qdot_text line = {0};
    qdot_status status;

    qdot_write_field(&line, "{\"kind\":\"expr\",\"name\":", name == NULL ? "" : name);
    status = write_value(session, ",\"plain\":", value, QDOT_PLAIN, &line);
    if (status == QDOT_OK)
        status = write_value(session, ",\"latex\":", value, QDOT_LATEX, &line);
    if (status == QDOT_OK)
        status = write_typeset(session, name, value, &line);
    qdot_text_format(&line, ",\"ops\":%" PRIu64, qdot_expr_size(session->pool, value));
    write_unit(session, &line);
    qdot_text_add(&line, "}\n");
    return finish_json_object(session, status, &line);
}

qdot_status
qdot_answer_expr(qdot_session *session, const char *name, qdot_expr value)
{
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
    return session->output->json ? answer_expression_as_json(session, name, value)
                         : answer_expression_as_text(session, name, value);
}

qdot_status
qdot_answer_solved(qdot_session *session, const char *name, qdot_expr symbol,
                   qdot_expr value)
{
    qdot_formula_id all;
    qdot_status status;
    qdot_sheet s;

    if (session->output->json)
        return answer_expression_as_json(session, name, value);
    s = qdot_sheet_begin(session);
    qdot_sheet_open(&s);
    all = s.at;
    s.at = qdot_formula_add(&s.formula, all, QDOT_FORMULA_SPAN, 0, QDOT_FORMULA_LABEL);
    status = qdot_sheet_expr(&s, symbol);
    s.at = all;
    qdot_sheet_sign(&s, QDOT_SIGN_EQUALS);
    if (status == QDOT_OK)
        status = qdot_sheet_expr(&s, value);
    return qdot_sheet_end(&s, "", status);
}

/* Append the text to the formula as a node with this role, and free it. */
static void
add_part(qdot_sheet *s, qdot_formula_role role, qdot_text *text)
{
    qdot_formula_add_text(&s->formula, s->at, role, qdot_text_str(text), text->n);
    s->formula.failed = s->formula.failed || text->failed;
    qdot_text_clear(text);
}

/* Append a number with its error, such as 1.25 ± 3e-13. */
static void
append_number_with_error(qdot_sheet *s, double value, double error)
{
    qdot_text number = {0};

    qdot_number_text_known(&number, value, error);
    add_part(s, QDOT_TEXT_NUMBER, &number);
    if (isnan(error)) {
        qdot_text_add(&number, " (error unknown)");
        add_part(s, QDOT_TEXT_WORDS, &number);
    } else if (error > 0) {
        qdot_sheet_sign(s, QDOT_SIGN_PLUS_MINUS);
        qdot_number_text_bound(&number, error);
        add_part(s, QDOT_TEXT_NUMBER, &number);
    }
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

static qdot_status
answer_numbers_as_text(qdot_session *session, const char *name, size_t n, const double *values,
                       const double *errors)
{
    qdot_sheet s = qdot_sheet_begin(session);
    const qdot_status status = begin_named_formula(&s, name);

    for (size_t i = 0; i < n; i++) {
        if (i > 0)
            qdot_sheet_sign(&s, QDOT_SIGN_COMMA);
        append_number_with_error(&s, values[i], errors[i]);
        if (session->output->units != NULL && session->output->units[i] != NULL)
            qdot_sheet_format(&s, " [%s]", session->output->units[i]);
    }
    append_unit(&s);
    return qdot_sheet_end(&s, "", status);
}

/* Write {"kind":"number"}, or {"kind":"numbers"} if there are several; values and errors are JSON,
 * with commas. */
static qdot_status
answer_numbers_as_json(qdot_session *session, const char *name, bool several, size_t n,
                       const qdot_text *values, const qdot_text *errors)
{
    qdot_text line = {0};

    qdot_text_format(&line, "{\"kind\":\"number%s\"", several ? "s" : "");
    qdot_write_field(&line, ",\"name\":", name);
    qdot_text_add(&line, several ? ",\"values\":[" : ",\"value\":");
    qdot_text_add(&line, qdot_text_str(values));
    qdot_text_add(&line, several ? "],\"errors\":[" : ",\"error\":");
    qdot_text_add(&line, qdot_text_str(errors));
    qdot_text_add(&line, several ? "]" : "");
    write_unit(session, &line);
    write_units(session, n, &line);
    qdot_text_add(&line, "}\n");
    line.failed = line.failed || values->failed || errors->failed;
    return qdot_write_object(session, session->output->out, &line);
}

static qdot_status
answer_numbers(qdot_session *session, const char *name, bool several, size_t n,
               const double *values, const double *errors)
{
    qdot_text list[2] = {{0}};
    qdot_status status;

    if (!session->output->json)
        return answer_numbers_as_text(session, name, n, values, errors);
    for (size_t i = 0; i < 2 * n; i++) {
        qdot_text_add(&list[i % 2], i > 1 ? "," : "");
        qdot_number_text_json(&list[i % 2], i % 2 == 0 ? values[i / 2] : errors[i / 2]);
    }
    status = answer_numbers_as_json(session, name, several, n, &list[0], &list[1]);
    qdot_text_clear(&list[0]);
    qdot_text_clear(&list[1]);
    return status;
}

qdot_status
qdot_answer_number(qdot_session *session, const char *name, double value, double error)
{
    return answer_numbers(session, name, false, 1, &value, &error);
}

qdot_status
qdot_answer_quantity(qdot_session *session, const char *name, qdot_expr e, double value, double error)
{
    qdot_text unit = {0};
    qdot_status status;

    qdot_units_label(session, e, &unit);
    status = qdot_text_status(&unit);
    if (status == QDOT_OK && unit.n > 0)
        session->output->unit = qdot_text_str(&unit);
    if (status == QDOT_OK)
        status = qdot_answer_number(session, name, value, error);
    session->output->unit = NULL;
    qdot_text_clear(&unit);
    return status;
}

qdot_status
qdot_answer_numbers(qdot_session *session, const char *name, size_t n,
                    const double *values, const double *errors)
{
    return answer_numbers(session, name, true, n, values, errors);
}

qdot_status
qdot_answer_numerals(qdot_session *session, const char *name, bool several,
                     const qdot_text *values, const qdot_text *errors)
{
    qdot_status status;
    qdot_sheet s;

    if (session->output->json)
        return answer_numbers_as_json(session, name, several, 0, values, errors);
    s = qdot_sheet_begin(session);
    status = begin_named_formula(&s, name);
    qdot_sheet_words(&s, qdot_text_str(values));
    append_unit(&s);
    return qdot_sheet_end(&s, "", status);
}

/* --- answers to checks -------------------------------------------------------------- */

static const char *const verdicts[] = {
    [QDOT_PROVED] = "proved", [QDOT_REFUTED] = "refuted", [QDOT_UNDECIDED] = "undecided"};

static const char *const verdict_colours[] = {
    [QDOT_PROVED] = QDOT_GREEN, [QDOT_REFUTED] = QDOT_RED, [QDOT_UNDECIDED] = QDOT_YELLOW};

/* Append ` at x = 1, y = 2: left = 3, right = 4`, a point at which the two sides differ. */
static qdot_status
append_counterexample(qdot_sheet *s, const qdot_decision *decision)
{
    const qdot_pool *pool = s->session->pool;
    const uint32_t n = decision->at == QDOT_NIL ? 0 : qdot_expr_count(pool, decision->at);
    double apart;
    int digits;

    for (uint32_t i = 0; i < n; i++) {
        qdot_sheet_words(s, i == 0 ? " at " : ", ");
        QDOT_TRY(qdot_sheet_formula(s, qdot_expr_arg(pool, decision->at, i)));
    }
    if (!isfinite(decision->left) || !isfinite(decision->right))
        return QDOT_OK;
    apart = fabs(decision->left - decision->right);
    digits = apart == 0 || apart > 1e-11 * fabs(decision->left) ? 12 : 17;
    qdot_sheet_words(s, ": left = ");
    qdot_sheet_double(s, decision->left, digits);
    qdot_sheet_words(s, ", right = ");
    qdot_sheet_double(s, decision->right, digits);
    return QDOT_OK;
}

static qdot_status
answer_check_as_text(qdot_session *session, const qdot_decision *decision)
{
    qdot_sheet s = qdot_sheet_begin_words(session);
    qdot_status status = QDOT_OK;

    qdot_sheet_format(&s, "%s%s%s", get_colour_code(session, verdict_colours[decision->verdict]),
                      verdicts[decision->verdict], get_colour_code(session, QDOT_COLOUR_END));
    if (decision->verdict == QDOT_REFUTED)
        status = append_counterexample(&s, decision);
    else if (decision->verdict == QDOT_UNDECIDED && decision->points > 0 && decision->digits > 0)
        qdot_sheet_format(&s, ": equal at %d random points to %d digits, but not proved", decision->points,
                          decision->digits);
    else if (decision->verdict == QDOT_UNDECIDED && decision->points > 0)
        qdot_sheet_format(&s, ": true at %d random points, but not proved", decision->points);
    else if (decision->verdict == QDOT_UNDECIDED)
        qdot_sheet_words(&s, ": neither proved nor refuted");
    return qdot_sheet_end(&s, "check", status);
}

/* Append {"x":1.5,...} for a LIST of equations symbol = number. */
static qdot_status
append_point_as_json(qdot_session *session, qdot_expr at, qdot_text *line)
{
    qdot_pool *pool = session->pool;
    uint32_t n = at == QDOT_NIL ? 0 : qdot_expr_count(pool, at);

    qdot_text_char(line, '{');
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr equation = qdot_expr_arg(pool, at, i);
        qdot_text name = {0};
        double value = NAN;
        qdot_status status =
            qdot_print(pool, qdot_expr_arg(pool, equation, 0), QDOT_PLAIN, &name);

        if (status == QDOT_OK)
            status = qdot_session_number(session, qdot_expr_arg(pool, equation, 1),
                                         &value, NULL);
        qdot_text_add(line, i > 0 ? "," : "");
        qdot_text_json(line, qdot_text_str(&name));
        qdot_text_char(line, ':');
        qdot_number_text_json(line, value);
        qdot_text_clear(&name);
        QDOT_TRY(status);
    }
    qdot_text_char(line, '}');
    return QDOT_OK;
}

/* Print one side of a check: results of runs as numbers; of a very large expression only its size. */
static qdot_status
print_side(qdot_session *session, qdot_expr side, qdot_text *out)
{
    uint64_t size = qdot_expr_size(session->pool, side);
    double number;

    if (qdot_expr_is_scalar(session->pool, side) && qdot_measured_occurs(session, side)) {
        QDOT_TRY(qdot_session_number(session, side, &number, NULL));
        qdot_text_double(out, number, 17);
        return QDOT_OK;
    }
    if (size <= QDOT_EXPRESSION_OPERATIONS)
        return qdot_print(session->pool, side, QDOT_PLAIN, out);
    qdot_text_format(out, "(%" PRIu64 " operations)", size);
    return QDOT_OK;
}

static qdot_status
answer_check_as_json(qdot_session *session, qdot_expr left, qdot_expr right,
                     const qdot_decision *decision)
{
    qdot_text line = {0}, part = {0};
    qdot_status status;

    qdot_text_format(&line, "{\"kind\":\"check\",\"verdict\":\"%s\"", verdicts[decision->verdict]);
    if (session->evaluation->claim != NULL)
        qdot_write_field(&line, ",\"claim\":", session->evaluation->claim);
    qdot_text_add(&line, ",\"left\":");
    status = print_side(session, left, &part);
    qdot_text_json(&line, qdot_text_str(&part));
    qdot_text_truncate(&part, 0);
    if (status == QDOT_OK)
        status = print_side(session, right, &part);
    qdot_write_field(&line, ",\"right\":", qdot_text_str(&part));
    if (decision->verdict == QDOT_REFUTED) {
        qdot_text_add(&line, ",\"at\":");
        if (status == QDOT_OK)
            status = append_point_as_json(session, decision->at, &line);
        qdot_text_add(&line, ",\"values\":[");
        qdot_number_text_json(&line, decision->left);
        qdot_text_char(&line, ',');
        qdot_number_text_json(&line, decision->right);
        qdot_text_char(&line, ']');
    } else if (decision->verdict == QDOT_UNDECIDED) {
        qdot_text_format(&line, ",\"digits\":%d", decision->digits);
    }
    qdot_text_add(&line, "}\n");
    line.failed = line.failed || part.failed;
    qdot_text_clear(&part);
    return finish_json_object(session, status, &line);
}

qdot_status
qdot_answer_check(qdot_session *session, qdot_expr left, qdot_expr right,
                  const qdot_decision *decision)
{
    session->outcome->verdicts[decision->verdict]++;
    return session->output->json ? answer_check_as_json(session, left, right, decision)
                         : answer_check_as_text(session, decision);
}

/* --- files, errors ------------------------------------------------------------------ */

qdot_status
qdot_answer_file(qdot_session *session, const char *path)
{
    qdot_text line = {0};

    if (session->output->json) {
        qdot_write_field(&line, "{\"kind\":\"file\",\"path\":", path);
        qdot_text_add(&line, "}\n");
    } else {
        qdot_text_add(&line, "wrote ");
        qdot_text_add(&line, path);
        qdot_text_char(&line, '\n');
        return qdot_write(session, session->output->out, &line);
    }
    return qdot_write_object(session, session->output->out, &line);
}

qdot_status
qdot_answer_in_file(qdot_session *session, const char *path, const qdot_text *text)
{
    QDOT_TRY(qdot_text_status(text));
    QDOT_TRY(qdot_sink_write(path, qdot_text_str(text), text->n));
    return qdot_answer_file(session, path);
}

static void
write_error_as_json(qdot_session *session, const qdot_source *source, size_t at,
                    const qdot_error *error)
{
    qdot_text line = {0};
    uint32_t number = 0, column = 0;

    qdot_text_add(&line, "{\"kind\":\"error\",\"file\":");
    if (source != NULL) {
        qdot_source_locate(source, at, &number, &column);
        qdot_text_json(&line, source->name);
        qdot_text_format(&line, ",\"line\":%u,\"column\":%u", number, column);
    } else {
        qdot_text_add(&line, "null,\"line\":null,\"column\":null");
    }
    qdot_write_field(&line, ",\"message\":", error->message);
    qdot_text_add(&line, ",\"hint\":");
    if (error->hint[0] != '\0')
        qdot_text_json(&line, error->hint);
    else
        qdot_text_add(&line, "null");
    if (session->typed->under_way)
        qdot_text_format(&line, ",\"statement\":%zu", session->typed->number);
    qdot_text_add(&line, "}\n");
    (void)!qdot_write(session, session->output->out, &line);
}

void
qdot_answer_error(qdot_session *session, const qdot_source *source, size_t at)
{
    qdot_error error = *qdot_last_error(); /* copied, since the statements below may fail too */
    const bool colours = (session->output->colours & QDOT_COLOURS_ERRORS) != 0;
    qdot_text text = {0};

    if (source != NULL) {
        qdot_source_report(source, at, &error, colours, qdot_write_width(session, session->output->err),
                           &text);
    } else {
        qdot_text_format(&text, "%serror:%s %s\n", colours ? QDOT_RED : "",
                         colours ? QDOT_COLOUR_END : "", error.message);
        if (error.hint[0] != '\0')
            qdot_text_format(&text, "%shint:%s %s\n", colours ? QDOT_CYAN : "",
                             colours ? QDOT_COLOUR_END : "", error.hint);
    }
    fflush(session->output->out);
    if (qdot_write(session, session->output->err, &text) != QDOT_OK)
        fprintf(session->output->err, "error: %s\n", error.message); /* out of memory: print at least the message */
    if (session->output->json)
        write_error_as_json(session, source, at, &error);
    (void)qdot_fail_again(&error);
}
