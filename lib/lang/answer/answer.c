/* answer.c -- every kind of answer, as text and as JSON. */
#include "lang/answer/answer.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "base/number-text.h"
#include "base/sink.h"
#include "base/terminal.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/formula.h"
#include "lang/answer/sheet.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/source/source.h"

/* A code for a colour of answers, "" where none is shown. */
static const char *
paint(const qdot_session *session, const char *code)
{
    return qdot_write_colours(session) ? code : "";
}

/* The end of an answer that went well or not: a line written, its text let go of. */
static qdot_status
end_line(qdot_session *session, qdot_status status, qdot_text *line)
{
    if (status == QDOT_OK)
        status = qdot_write(session, session->out, line);
    qdot_text_clear(line);
    return status;
}

/* Likewise of a formula in a sheet, which qdot_formula_bracket began. */
static qdot_status
end_formula(qdot_session *session, const qdot_sheet *s, qdot_status status, qdot_text *line)
{
    qdot_formula_bracket(session, false, line);
    return qdot_sheet_end(session, s, "", status, line);
}

/* --- expressions -------------------------------------------------------------------- */

/* A condition, or a vector of equations. */
static bool
holds_relations(const qdot_pool *pool, qdot_expr e)
{
    qdot_kind kind = qdot_expr_kind(pool, e);

    return kind == QDOT_LOGIC ||
           (kind == QDOT_VEC &&
            qdot_value_kind_is_equation(pool, qdot_expr_arg(pool, e, 0)));
}

/* As typed it may stand with other spaces: A[1, 2] and A[1,2]. */
static bool
same_but_spaces(const char *a, const char *b)
{
    for (;; a++, b++) {
        a += strspn(a, " ");
        b += strspn(b, " ");
        if (*a != *b || *a == '\0')
            return *a == *b;
    }
}

/* The name of an answer, in colour where it is not laid out (which colours it then). */
static qdot_status
answer_add_name(qdot_session *session, const qdot_sheet *s, const char *name, qdot_text *line)
{
    qdot_text_add(line, s->laid_out ? "" : paint(session, QDOT_NAME_COLOUR));
    QDOT_TRY(qdot_formula_name(session, name, line));
    qdot_text_add(line, s->laid_out ? "" : paint(session, QDOT_COLOUR_END));
    return QDOT_OK;
}

/* Whether a value is printed as its name is. One of more operations than the name has characters is not. */
static qdot_status
says_the_same(qdot_session *session, const char *name, qdot_expr value, bool *same)
{
    qdot_text plain = {0};
    qdot_status status;

    *same = false;
    if (qdot_expr_size(session->pool, value) > strlen(name))
        return QDOT_OK;
    status = qdot_formula_print(session, value, QDOT_PLAIN, &plain);
    if (status == QDOT_OK)
        status = qdot_text_status(&plain);
    *same = status == QDOT_OK && same_but_spaces(name, qdot_text_str(&plain));
    qdot_text_clear(&plain);
    return status;
}

static qdot_status
expr_text(qdot_session *session, const char *name, qdot_expr value)
{
    qdot_sheet s = qdot_sheet_begin(session);
    const bool relation = qdot_value_kind_is_equation(session->pool, value) ||
                          holds_relations(session->pool, value);
    bool bare = name == NULL || strlen(name) > 200 ||
                (relation && strpbrk(name, "=<>") != NULL);
    qdot_status status = QDOT_OK;
    qdot_text line = {0};

    s.operations = qdot_expr_size(session->pool, value);
    if (!bare)
        status = says_the_same(session, name, value, &bare);
    qdot_formula_bracket(session, true, &line);
    if (status == QDOT_OK && !bare) {
        status = answer_add_name(session, &s, name, &line);
        if (!relation && value != QDOT_TRUE && value != QDOT_FALSE)
            qdot_text_add(&line, qdot_formula_equals(session));
        else
            qdot_text_add(&line, session->style == QDOT_MATHML ? "<mo>:</mo>" : ": ");
    }
    if (status == QDOT_OK)
        status = qdot_formula_print(session, value, session->style, &line);
    return end_formula(session, &s, status, &line);
}

static qdot_status
expr_json(qdot_session *session, const char *name, qdot_expr value)
{
    qdot_text line = {0}, part = {0};
    qdot_status status;

    qdot_write_field(&line, "{\"kind\":\"expr\",\"name\":", name == NULL ? "" : name);
    status = qdot_formula_print(session, value, QDOT_PLAIN, &part);
    qdot_write_field(&line, ",\"plain\":", qdot_text_str(&part));
    qdot_text_truncate(&part, 0);
    if (status == QDOT_OK)
        status = qdot_formula_print(session, value, QDOT_LATEX, &part);
    qdot_write_field(&line, ",\"latex\":", qdot_text_str(&part));
    qdot_text_format(&line, ",\"ops\":%" PRIu64 "}\n",
                     qdot_expr_size(session->pool, value));
    line.failed = line.failed || part.failed;
    qdot_text_clear(&part);
    return end_line(session, status, &line);
}

qdot_status
qdot_answer_expr(qdot_session *session, const char *name, qdot_expr value)
{
    if (qdot_expr_is_class(session->pool, value, QDOT_WORDS)) {
        const char *words = qdot_expr_symbol(session->pool, value)->name;
        qdot_text line = {0};

        if (!session->marked || session->style != QDOT_LATEX)
            return qdot_answer_text(session, name, words);
        qdot_formula_bracket(session, true, &line); /* of latex(...) */
        qdot_text_add(&line, words);
        qdot_formula_bracket(session, false, &line);
        return qdot_answer_written(session, name, QDOT_OK, &line);
    }
    return session->json ? expr_json(session, name, value)
                         : expr_text(session, name, value);
}

qdot_status
qdot_answer_solved(qdot_session *session, const char *name, qdot_expr symbol,
                   qdot_expr value)
{
    qdot_text line = {0};
    qdot_status status;
    qdot_sheet s;

    if (session->json)
        return expr_json(session, name, value);
    s = qdot_sheet_begin(session);
    qdot_formula_bracket(session, true, &line);
    qdot_text_add(&line, s.laid_out ? "<mrow class=\"name\">" : paint(session, QDOT_NAME_COLOUR));
    status = qdot_print(session->pool, symbol, session->style, &line);
    qdot_text_add(&line, s.laid_out ? "</mrow>" : paint(session, QDOT_COLOUR_END));
    qdot_text_add(&line, qdot_formula_equals(session));
    if (status == QDOT_OK)
        status = qdot_formula_print(session, value, session->style, &line);
    return end_formula(session, &s, status, &line);
}

/* 1.25 ± 3e-13, marked up where the style is. */
static void
measured(const qdot_session *session, double value, double error, qdot_text *line)
{
    bool tags = session->style == QDOT_MATHML;

    qdot_text_add(line, tags ? "<mn>" : "");
    qdot_number_text_known(line, value, error);
    qdot_text_add(line, tags ? "</mn>" : "");
    if (isnan(error)) {
        qdot_text_add(line,
                      tags ? "<mtext> (error unknown)</mtext>" : " (error unknown)");
    } else if (error > 0) {
        qdot_text_add(line, tags ? "<mo>±</mo><mn>" : " ± ");
        qdot_number_text_bound(line, error);
        qdot_text_add(line, tags ? "</mn>" : "");
    }
}

static qdot_status
numbers_text(qdot_session *session, const char *name, size_t n, const double *values,
             const double *errors)
{
    const qdot_sheet s = qdot_sheet_begin(session);
    qdot_text line = {0};
    qdot_status status;

    qdot_formula_bracket(session, true, &line);
    status = answer_add_name(session, &s, name, &line);
    qdot_text_add(&line, qdot_formula_equals(session));
    for (size_t i = 0; i < n; i++) {
        if (i > 0)
            qdot_text_add(&line, session->style == QDOT_MATHML ? "<mo>,</mo>" : ", ");
        measured(session, values[i], errors[i], &line);
    }
    return end_formula(session, &s, status, &line);
}

/* {"kind":"number"}, {"kind":"numbers"} of JSON values and errors with their commas. */
static qdot_status
numbers_json(qdot_session *session, const char *name, bool several,
             const qdot_text *values, const qdot_text *errors)
{
    qdot_text line = {0};

    qdot_text_format(&line, "{\"kind\":\"number%s\"", several ? "s" : "");
    qdot_write_field(&line, ",\"name\":", name);
    qdot_text_add(&line, several ? ",\"values\":[" : ",\"value\":");
    qdot_text_add(&line, qdot_text_str(values));
    qdot_text_add(&line, several ? "],\"errors\":[" : ",\"error\":");
    qdot_text_add(&line, qdot_text_str(errors));
    qdot_text_add(&line, several ? "]}\n" : "}\n");
    line.failed = line.failed || values->failed || errors->failed;
    return qdot_write(session, session->out, &line);
}

static qdot_status
numbers(qdot_session *session, const char *name, bool several, size_t n,
        const double *values, const double *errors)
{
    qdot_text list[2] = {{0}};
    qdot_status status;

    if (!session->json)
        return numbers_text(session, name, n, values, errors);
    for (size_t i = 0; i < 2 * n; i++) {
        qdot_text_add(&list[i % 2], i > 1 ? "," : "");
        qdot_number_text_json(&list[i % 2], i % 2 == 0 ? values[i / 2] : errors[i / 2]);
    }
    status = numbers_json(session, name, several, &list[0], &list[1]);
    qdot_text_clear(&list[0]);
    qdot_text_clear(&list[1]);
    return status;
}

qdot_status
qdot_answer_number(qdot_session *session, const char *name, double value, double error)
{
    return numbers(session, name, false, 1, &value, &error);
}

qdot_status
qdot_answer_numbers(qdot_session *session, const char *name, size_t n,
                    const double *values, const double *errors)
{
    return numbers(session, name, true, n, values, errors);
}

qdot_status
qdot_answer_numerals(qdot_session *session, const char *name, bool several,
                     const qdot_text *values, const qdot_text *errors)
{
    qdot_text line = {0};
    qdot_status status;
    qdot_sheet s;

    if (session->json)
        return numbers_json(session, name, several, values, errors);
    s = qdot_sheet_begin(session);
    qdot_formula_bracket(session, true, &line);
    status = answer_add_name(session, &s, name, &line);
    qdot_text_add(&line, qdot_formula_equals(session));
    if (s.laid_out)
        qdot_sheet_words(qdot_text_str(values), values->n, &line);
    else
        qdot_text_format(&line, session->style == QDOT_MATHML ? "<mtext>%s</mtext>" : "%s",
                         qdot_text_str(values));
    return end_formula(session, &s, status, &line);
}

/* --- checks ------------------------------------------------------------------------- */

static const char *const verdicts[] = {
    [QDOT_PROVED] = "proved", [QDOT_REFUTED] = "refuted", [QDOT_UNDECIDED] = "undecided"};

static const char *const verdict_colours[] = {
    [QDOT_PROVED] = QDOT_GREEN, [QDOT_REFUTED] = QDOT_RED, [QDOT_UNDECIDED] = QDOT_YELLOW};

static qdot_status
check_text(qdot_session *session, const qdot_decision *decision)
{
    qdot_pool *pool = session->pool;
    qdot_text line = {0};
    qdot_status status = QDOT_OK;

    qdot_text_format(&line, "%s%s%s", paint(session, verdict_colours[decision->verdict]),
                     verdicts[decision->verdict], paint(session, QDOT_COLOUR_END));
    if (decision->verdict == QDOT_REFUTED) {
        uint32_t n = decision->at == QDOT_NIL ? 0 : qdot_expr_count(pool, decision->at);

        for (uint32_t i = 0; i < n && status == QDOT_OK; i++) {
            qdot_text_add(&line, i == 0 ? " at " : ", ");
            status =
                qdot_formula_marked(session, qdot_expr_arg(pool, decision->at, i), &line);
        }
        if (isfinite(decision->left) && isfinite(decision->right)) {
            double apart = fabs(decision->left - decision->right);
            int digits = apart == 0 || apart > 1e-11 * fabs(decision->left) ? 12 : 17;

            qdot_text_add(&line, ": left = ");
            qdot_text_double(&line, decision->left, digits);
            qdot_text_add(&line, ", right = ");
            qdot_text_double(&line, decision->right, digits);
        }
    } else if (decision->verdict == QDOT_UNDECIDED) {
        if (decision->points > 0 && decision->digits > 0)
            qdot_text_format(&line,
                             ": equal at %d random points to %d digits, but not proved",
                             decision->points, decision->digits);
        else if (decision->points > 0)
            qdot_text_format(&line, ": true at %d random points, but not proved",
                             decision->points);
        else
            qdot_text_add(&line, ": neither proved nor refuted");
    }
    qdot_text_char(&line, '\n');
    return end_line(session, status, &line);
}

/* {"x":1.5,...} from a LIST of equations symbol = number. */
static qdot_status
point_json(qdot_session *session, qdot_expr at, qdot_text *line)
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

/* A side of a check; numbers of runs as they are; how large it is where it is too large. */
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
    if (size <= QDOT_FORMULA_OPERATIONS)
        return qdot_print(session->pool, side, QDOT_PLAIN, out);
    qdot_text_format(out, "(%" PRIu64 " operations)", size);
    return QDOT_OK;
}

static qdot_status
check_json(qdot_session *session, qdot_expr left, qdot_expr right,
           const qdot_decision *decision)
{
    qdot_text line = {0}, part = {0};
    qdot_status status;

    qdot_text_format(&line, "{\"kind\":\"check\",\"verdict\":\"%s\",\"left\":",
                     verdicts[decision->verdict]);
    status = print_side(session, left, &part);
    qdot_text_json(&line, qdot_text_str(&part));
    qdot_text_truncate(&part, 0);
    if (status == QDOT_OK)
        status = print_side(session, right, &part);
    qdot_write_field(&line, ",\"right\":", qdot_text_str(&part));
    if (decision->verdict == QDOT_REFUTED) {
        qdot_text_add(&line, ",\"at\":");
        if (status == QDOT_OK)
            status = point_json(session, decision->at, &line);
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
    return end_line(session, status, &line);
}

qdot_status
qdot_answer_check(qdot_session *session, qdot_expr left, qdot_expr right,
                  const qdot_decision *decision)
{
    session->verdicts[decision->verdict]++;
    return session->json ? check_json(session, left, right, decision)
                         : check_text(session, decision);
}

/* --- texts, files, notices, errors -------------------------------------------------- */

qdot_status
qdot_answer_file(qdot_session *session, const char *path)
{
    qdot_text line = {0};

    if (session->json) {
        qdot_write_field(&line, "{\"kind\":\"file\",\"path\":", path);
        qdot_text_add(&line, "}\n");
    } else {
        qdot_text_add(&line, "wrote ");
        qdot_text_add(&line, path);
        qdot_text_char(&line, '\n');
    }
    return qdot_write(session, session->out, &line);
}

qdot_status
qdot_answer_in_file(qdot_session *session, const char *path, const qdot_text *text)
{
    QDOT_TRY(qdot_text_status(text));
    QDOT_TRY(qdot_sink_write(path, qdot_text_str(text), text->n));
    return qdot_answer_file(session, path);
}

enum { NOTICE = 4096 };

static qdot_status
put_notice(qdot_session *session, const char *message)
{
    qdot_text line = {0};

    if (session->console != NULL ? session->console_json : session->json) {
        qdot_write_field(&line, "{\"kind\":\"notice\",\"message\":", message);
        qdot_text_add(&line, "}\n");
    } else {
        qdot_text_format(&line, "%snotice:%s %s\n", paint(session, QDOT_YELLOW),
                         paint(session, QDOT_COLOUR_END), message);
    }
    return qdot_write(session, session->console != NULL ? session->console : session->out,
                      &line);
}

qdot_status
qdot_answer_notice(qdot_session *session, const char *format, ...)
{
    char message[NOTICE];
    va_list ap;

    va_start(ap, format);
    vsnprintf(message, sizeof message, format, ap);
    va_end(ap);
    return put_notice(session, message);
}

qdot_status
qdot_answer_notice_of(qdot_session *session, const char *format, qdot_expr e)
{
    qdot_text text = {0};
    qdot_status status = qdot_print(session->pool, e, QDOT_PLAIN, &text);

    if (status == QDOT_OK)
        status = qdot_answer_notice(session, format, qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

qdot_status
qdot_answer_notice_text(qdot_session *session, qdot_status status, qdot_text *text)
{
    if (status == QDOT_OK)
        status = qdot_text_status(text);
    if (status == QDOT_OK)
        status = qdot_answer_notice(session, "%s", qdot_text_str(text));
    qdot_text_clear(text);
    return status;
}

qdot_status
qdot_answer_notice_once(qdot_session *session, const char *format, ...)
{
    char message[NOTICE], *copy;
    va_list ap;

    va_start(ap, format);
    vsnprintf(message, sizeof message, format, ap);
    va_end(ap);
    for (size_t i = 0; i < session->told.n; i++)
        if (strcmp(session->told.at[i], message) == 0)
            return QDOT_OK;
    copy = qdot_strdup(message);
    if (copy == NULL)
        return QDOT_ENOMEM;
    if (qdot_vec_push(&session->told, copy) != QDOT_OK) {
        qdot_free(copy);
        return QDOT_ENOMEM;
    }
    return put_notice(session, message);
}

static void
error_json(qdot_session *session, const qdot_source *source, size_t at,
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
    qdot_text_add(&line, "}\n");
    (void)!qdot_write(session, session->out, &line);
}

void
qdot_answer_error(qdot_session *session, const qdot_source *source, size_t at)
{
    qdot_error error = *qdot_last_error(); /* what follows may fail in its turn */
    const bool colours = (session->colours & QDOT_COLOURS_ERRORS) != 0;
    qdot_text text = {0};

    if (source != NULL) {
        qdot_source_report(source, at, &error, colours, qdot_write_width(session, session->err),
                           &text);
    } else {
        qdot_text_format(&text, "%serror:%s %s\n", colours ? QDOT_RED : "",
                         colours ? QDOT_COLOUR_END : "", error.message);
        if (error.hint[0] != '\0')
            qdot_text_format(&text, "%shint:%s %s\n", colours ? QDOT_CYAN : "",
                             colours ? QDOT_COLOUR_END : "", error.hint);
    }
    fflush(session->out);
    if (qdot_write(session, session->err, &text) != QDOT_OK)
        fprintf(session->err, "error: %s\n", error.message); /* no memory for more */
    if (session->json)
        error_json(session, source, at, &error);
    (void)qdot_fail_again(&error);
}
