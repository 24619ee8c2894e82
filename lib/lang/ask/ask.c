/* ask.c -- answers an expression that was entered as a statement. */
#include "lang/ask/ask.h"

#include <string.h>

#include "base/number-text.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/answer/digits.h"
#include "lang/answer/sheet.h"
#include "lang/ask/components.h"
#include "lang/declare/constraints.h"
#include "lang/declare/scene-file.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/language/function.h"
#include "lang/language/compiled.h"
#include "lang/language/units.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "lang/session/history.h"
#include "lang/session/measured.h"
#include "lang/session/output.h"
#include "lang/session/units.h"
#include "lang/syntax/statement.h"

/* --- answering expressions ---------------------------------------------------------- */

/* The units [n] of the entries of a list, where these differ; *units NULL: they do not, or there are none. Free each and all. */
static qdot_status
find_units_of_entries(qdot_session *session, qdot_expr list, char ***units)
{
    const uint32_t n = qdot_expr_count(session->pool, list);
    qdot_status status = QDOT_OK;

    *units = NULL;
    if (!qdot_units_on(session) || session->output->unit != NULL)
        return QDOT_OK;
    *units = qdot_calloc(n + 1, sizeof **units);
    if (*units == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < n && status == QDOT_OK; i++)
        status = qdot_units_label_of(session, qdot_expr_arg(session->pool, list, i), &(*units)[i]);
    return status;
}

static void
free_units(char **units, uint32_t n)
{
    for (uint32_t i = 0; units != NULL && i < n; i++)
        qdot_free(units[i]);
    qdot_free(units);
}

/* Answer a value that contains results of runs: a number, or a list of numbers. */
static qdot_status
answer_run_results(qdot_session *session, const char *name, qdot_expr value)
{
    qdot_vec(double) values = {0}, errors = {0};
    bool several = !qdot_expr_is_scalar(session->pool, value);
    uint32_t n = several ? qdot_expr_count(session->pool, value) : 1;
    qdot_status status = QDOT_OK;
    int digits = qdot_digits_of(session, value);
    char **units = NULL;

    if (digits > 0)
        return qdot_digits_answer(session, name, value, digits);
    if (several)
        status = find_units_of_entries(session, value, &units);
    for (uint32_t i = 0; i < n && status == QDOT_OK; i++) {
        qdot_expr member = several ? qdot_expr_arg(session->pool, value, i) : value;
        double x, error;

        status = qdot_session_number(session, member, &x, &error);
        if (status == QDOT_OK)
            status = qdot_vec_push(&values, x);
        if (status == QDOT_OK)
            status = qdot_vec_push(&errors, error);
    }
    session->output->units = units;
    if (status == QDOT_OK)
        status = several ? qdot_answer_numbers(session, name, n, values.at, errors.at)
                         : qdot_answer_number(session, name, values.at[0], errors.at[0]);
    session->output->units = NULL;
    free_units(units, n);
    qdot_free(values.at);
    qdot_free(errors.at);
    return status;
}

/* Whether an index written behind the text would belong to its last part only, as behind eom/m. */
static bool
is_sum_or_product(const char *text)
{
    int64_t depth = 0;

    for (; *text != '\0'; text++) {
        depth += (strchr("([", *text) != NULL) - (strchr(")]", *text) != NULL);
        if (depth == 0 && strchr("+-*/", *text) != NULL)
            return true;
    }
    return false;
}

/* Append the name of list member i: "eom[theta1]" if it belongs to a coordinate, "eom[theta1][2]" if `each` members do,
 * otherwise (nil) "solve(...)[1]". */
static void
append_member_name(qdot_session *session, const char *name, qdot_expr coordinate, uint32_t i, uint32_t each,
                   qdot_text *out)
{
    qdot_text_format(out, is_sum_or_product(name) ? "(%s)" : "%s", name);
    if (coordinate != QDOT_NIL)
        qdot_text_format(out, "[%s]", qdot_expr_symbol(session->pool, coordinate)->name);
    if (coordinate == QDOT_NIL || each > 1)
        qdot_text_format(out, "[%u]", i + 1);
}

/* The coordinate of the scene whose member is number *i of a quantity that has *each members of a coordinate and one of a
 * state; *i becomes its number among the *each of that coordinate. */
static qdot_expr
coordinate_of_quantity(const qdot_scene *s, uint32_t *i, uint32_t *each)
{
    for (size_t k = 0; k < s->coordinates.n; k++) {
        const qdot_expr q = s->coordinates.at[k];
        const uint32_t members = qdot_scene_state_of(s, q) ? 1 : *each;

        if (*i < members) {
            *each = members;
            return q;
        }
        *i -= members;
    }
    return QDOT_NIL;
}

/* What member *i goes by: a coordinate of the scene for a quantity, which has *each members of it, of `over` (a LIST, or
 * nil) for others (each 0; with --json by its number); nil: by its number. */
static qdot_expr
coordinate_of_member(const qdot_session *session, uint32_t *each, qdot_expr over, uint32_t n, uint32_t *i)
{
    if (*each > 0)
        return over != QDOT_NIL && qdot_expr_count(session->pool, over) == n ? qdot_expr_arg(session->pool, over, *i)
                                                                             : coordinate_of_quantity(session->scene, i, each);
    if (over == QDOT_NIL || session->output->json || qdot_expr_count(session->pool, over) != n)
        return QDOT_NIL;
    return qdot_expr_arg(session->pool, over, *i);
}

/* Whether the name is `equilibria[k]`, a list of equations that belong to one equilibrium. */
static bool
is_one_equilibrium(const char *name)
{
    return strncmp(name, "equilibria[", 11) == 0 && strchr(name + 11, '[') == NULL;
}

/* Answer the equations of a list in one line: `equilibria[1]: x = 0, y = 0`. */
static qdot_status
answer_equations_in_one_line(qdot_session *session, const char *name, qdot_expr list)
{
    qdot_sheet sheet = qdot_sheet_begin(session);
    qdot_status status = QDOT_OK;

    qdot_sheet_format(&sheet, "%s: ", name);
    for (uint32_t i = 0; i < qdot_expr_count(session->pool, list) && status == QDOT_OK; i++) {
        qdot_sheet_words(&sheet, i > 0 ? ", " : "");
        status = qdot_sheet_formula(&sheet, qdot_expr_arg(session->pool, list, i));
    }
    return qdot_sheet_end(&sheet, name, status);
}

qdot_status
qdot_ask_list(qdot_session *session, const char *name, qdot_expr list, qdot_expr over)
{
    uint32_t n = qdot_expr_count(session->pool, list);
    const qdot_quantity *row = qdot_quantity_find(name);
    bool by_coordinate = row != NULL && row->over_coordinates &&
                         qdot_names_find(session->names, name) == NULL;

    const uint32_t all = (uint32_t)session->scene->coordinates.n, higher = (uint32_t)session->scene->higher.n;
    const uint32_t coordinates = n + higher == all ? n : all; /* an equation for each coordinate, none for its derivatives */
    const bool named = over != QDOT_NIL && qdot_expr_count(session->pool, over) == n;
    const uint32_t states = (uint32_t)session->scene->states.n;
    const uint32_t each = !by_coordinate || coordinates == 0 || n < coordinates ? 0
                          : named || coordinates == states ? 1
                                                           : (n - states) / (coordinates - states); /* Hamilton's equations: 2 */

    if (n == 0 || (session->output->json && is_one_equilibrium(name)))
        return qdot_answer_expr(session, name, list);
    if (is_one_equilibrium(name))
        return answer_equations_in_one_line(session, name, list);
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr one = qdot_expr_arg(session->pool, list, i);
        qdot_text member = {0};
        qdot_status status;

        uint32_t number = i, members = each;
        qdot_expr coordinate = coordinate_of_member(session, &members, over, n, &number);

        if (higher > 0 && by_coordinate && coordinate != QDOT_NIL && row->symbol != NULL) /* p[x'] belongs to x' */
            coordinate = qdot_expr_symbol(session->pool, row->symbol(session->scene, coordinate))->base;

        append_member_name(session, name, coordinate, number, members, &member);
        status = qdot_text_status(&member);
        if (status == QDOT_OK && by_coordinate && row->symbol != NULL) {
            qdot_expr q = session->scene->coordinates.at[i];

            status = qdot_answer_solved(session, qdot_text_str(&member),
                                        row->symbol(session->scene, q), one);
        } else if (status == QDOT_OK) {
            status = qdot_answer_expr(session, qdot_text_str(&member), one);
        }
        qdot_text_clear(&member);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

/* Answer a matrix that contains results of runs, row by row, each number with the digits that its error leaves. */
static qdot_status
answer_matrix_of_results(qdot_session *session, const char *name, qdot_expr M)
{
    const uint32_t columns = qdot_expr_node(session->pool, M)->op, n = qdot_expr_count(session->pool, M);
    qdot_numerals x = {0};
    qdot_status status = QDOT_OK;

    for (uint32_t i = 0; i < n && status == QDOT_OK; i++) {
        const char *const before = i % columns != 0 ? "," : i == 0 ? "[[" : "],[";
        double value, error;

        status = qdot_session_number(session, qdot_expr_arg(session->pool, M, i), &value, &error);
        if (status != QDOT_OK)
            break;
        qdot_text_add(&x.values, before);
        qdot_number_text_json(&x.values, value);
        qdot_text_add(&x.errors, before);
        qdot_number_text_json(&x.errors, error);
        qdot_text_add(&x.text, i % columns != 0 ? ", " : i == 0 ? "[" : "; ");
        qdot_number_text(&x.text, value, error);
    }
    qdot_text_add(&x.values, "]]");
    qdot_text_add(&x.errors, "]]");
    qdot_text_char(&x.text, ']');
    return qdot_answer_numerals(session, name, true, status, &x);
}

/* Whether a list contains results of runs and also members that are no such numbers, as sqrt(2), or lists. */
static bool
mixes_results_and_expressions(qdot_session *session, qdot_expr value)
{
    bool mixed = false;

    if (qdot_expr_kind(session->pool, value) != QDOT_LIST)
        return false;
    for (uint32_t i = 0; i < qdot_expr_count(session->pool, value) && !mixed; i++) {
        qdot_expr one = qdot_expr_arg(session->pool, value, i);

        mixed = qdot_expr_kind(session->pool, one) == QDOT_LIST;
        if (mixed)
            break;
        mixed = !qdot_measured_occurs(session, one) &&
                qdot_expr_kind(session->pool, one) != QDOT_NUM &&
                (qdot_expr_is_constant(session->pool, one) ||
                 !qdot_expr_is_constant(session->pool, qdot_session_bind(session, one)));
    }
    return mixed;
}

/* Answer each member of a list with results of runs separately: a number with its error, or an expression. */
static qdot_status
answer_members_separately(qdot_session *session, const char *name, qdot_expr list)
{
    qdot_status status = QDOT_OK;

    for (uint32_t i = 0; i < qdot_expr_count(session->pool, list) && status == QDOT_OK; i++) {
        qdot_expr one = qdot_expr_arg(session->pool, list, i);
        qdot_text member = {0};

        append_member_name(session, name, QDOT_NIL, i, 1, &member);
        status = qdot_text_status(&member);
        if (status == QDOT_OK)
            status = qdot_measured_occurs(session, one)
                         ? answer_run_results(session, qdot_text_str(&member), one)
                         : qdot_answer_expr(session, qdot_text_str(&member), one);
        qdot_text_clear(&member);
    }
    return status;
}

qdot_status
qdot_ask_print_point(qdot_sheet *sheet, qdot_expr equations)
{
    qdot_session *session = sheet->session;
    qdot_pool *pool = session->pool;

    qdot_sheet_words(sheet, "[");
    for (uint32_t i = 0; i < qdot_expr_count(pool, equations); i++) {
        qdot_expr one = qdot_expr_arg(pool, equations, i), value = qdot_expr_arg(pool, one, 1);
        double x, error;

        qdot_sheet_words(sheet, i > 0 ? ", " : "");
        if (!qdot_measured_occurs(session, value)) {
            QDOT_TRY(qdot_sheet_formula(sheet, one));
            continue;
        }
        QDOT_TRY(qdot_sheet_formula(sheet, qdot_expr_arg(pool, one, 0)));
        QDOT_TRY(qdot_session_number(session, value, &x, &error));
        qdot_sheet_words(sheet, " = ");
        qdot_sheet_known(sheet, x, error);
    }
    qdot_sheet_words(sheet, "]");
    return QDOT_OK;
}

/* Whether e is a LIST of points, each a LIST of equations, as qdot_solve_system returns them. */
static bool
is_points(const qdot_pool *pool, qdot_expr e)
{
    bool points = qdot_expr_kind(pool, e) == QDOT_LIST && qdot_expr_count(pool, e) > 0;

    for (uint32_t i = 0; points && i < qdot_expr_count(pool, e); i++)
        points = qdot_value_kind_are_equations(pool, qdot_expr_arg(pool, e, i));
    return points;
}

static qdot_status
answer_point(qdot_session *session, const char *name, qdot_expr equations)
{
    qdot_sheet sheet =
        qdot_sheet_begin_text(session, session->output->style == QDOT_MATHML ? QDOT_UNICODE : session->output->style);
    qdot_numerals point = {0};
    qdot_status status = qdot_sheet_text(&sheet, qdot_ask_print_point(&sheet, equations), &point.text);

    return session->output->json ? qdot_answer_written(session, name, status, &point.text)
                                 : qdot_answer_numerals(session, name, false, status, &point);
}

/* Answer each of several points (solutions) under its number: solve(...)[1], ... */
static qdot_status
answer_points(qdot_session *session, const char *name, qdot_expr list)
{
    qdot_status status = QDOT_OK;

    for (uint32_t i = 0; i < qdot_expr_count(session->pool, list) && status == QDOT_OK; i++) {
        qdot_text member = {0};

        append_member_name(session, name, QDOT_NIL, i, 1, &member);
        status = qdot_text_status(&member);
        if (status == QDOT_OK)
            status = answer_point(session, qdot_text_str(&member),
                                  qdot_expr_arg(session->pool, list, i));
        qdot_text_clear(&member);
    }
    return status;
}

qdot_status
qdot_ask_answer(qdot_session *session, const char *name, qdot_expr value, qdot_expr over)
{
    if (qdot_measured_occurs(session, value) && qdot_value_kind_are_equations(session->pool, value))
        return answer_point(session, name, value);
    if (qdot_measured_occurs(session, value) && is_points(session->pool, value))
        return answer_points(session, name, value);
    if (qdot_measured_occurs(session, value) && mixes_results_and_expressions(session, value))
        return answer_members_separately(session, name, value);
    if (qdot_measured_occurs(session, value) && qdot_expr_kind(session->pool, value) == QDOT_MAT)
        return answer_matrix_of_results(session, name, value);
    if (qdot_measured_occurs(session, value))
        return answer_run_results(session, name, value);
    if (qdot_components_are(session, name, value, over))
        return qdot_components_answer(session, name, value, over);
    if (qdot_expr_kind(session->pool, value) == QDOT_LIST)
        return qdot_ask_list(session, name, value, over);
    return qdot_answer_expr(session, name, value);
}

/* The unit of an answer: that which `in` asks for, else that of a number. */
static void
write_unit_of_answer(qdot_session *session, const qdot_token *asked, qdot_expr value, qdot_text *unit)
{
    qdot_pool *pool = session->pool;
    const bool measured = qdot_measured_occurs(session, value);

    if (asked != NULL && (measured || qdot_expr_is_constant(pool, value)))
        qdot_token_text_written(session, asked + 1, qdot_token_behind_bracket(asked) - 1, unit);
    else if (measured || session->output->json)
        qdot_units_label(session, value, unit);
}

/* Read an expression; behind `in` its number where its symbols have values. *asked: the unit after `in`, or NULL. */
static qdot_status
read_answer(qdot_cursor *c, qdot_expr *value, qdot_expr *over, const qdot_token **asked)
{
    qdot_session *session = c->session;
    qdot_compiled program;
    qdot_status status = qdot_compiled_parse(c, QDOT_PARSE_VALUE, &program);

    if (status == QDOT_OK)
        status = qdot_compiled_named(c, &program, value, over);
    *asked = status == QDOT_OK ? qdot_compiled_unit(&program, true) : NULL;
    qdot_compiled_free(&program);
    if (*asked != NULL && !qdot_expr_is_constant(session->pool, *value) && !qdot_measured_occurs(session, *value))
        return qdot_call_numeric(session, 1, value, value);
    return status;
}

qdot_status
qdot_ask_expression(qdot_cursor *c)
{
    qdot_session *session = c->session;
    const qdot_token *start = c->at, *asked;
    qdot_expr value, over;
    qdot_text name = {0}, unit = {0};
    qdot_status status;

    session->evaluation->asks = true;
    status = read_answer(c, &value, &over, &asked);
    session->evaluation->asks = false;
    QDOT_TRY(status);
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start->start;
    qdot_token_text(c->session, start, c->at, &name);
    if (name.n > 200) { /* too long for a name: use its number in the history */
        qdot_text_truncate(&name, 0);
        qdot_text_format(&name, "%%%zu", session->history->values.n + 1);
    }
    status = qdot_text_status(&name);
    if (status == QDOT_OK)
        status = qdot_session_remember(session, value, over);
    if (status == QDOT_OK && qdot_units_on(session)) {
        write_unit_of_answer(session, asked, value, &unit);
        status = qdot_text_status(&unit);
        session->output->unit = unit.n > 0 ? qdot_text_str(&unit) : NULL;
    }
    if (status == QDOT_OK)
        status = qdot_ask_answer(session, qdot_text_str(&name), value, over);
    session->output->unit = NULL;
    qdot_text_clear(&unit);
    qdot_text_clear(&name);
    return status;
}
