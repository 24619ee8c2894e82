/* equilibria.c -- the statement `equilibria`: lists the equilibria of the scene, with their stability. */
#include <math.h>
#include <stdio.h>

#include "base/number-text.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/answer/sheet.h"
#include "lang/ask/equilibria.h"
#include "lang/commands/warnings.h"
#include "lang/session/bind.h"
#include "lang/session/history.h"
#include "lang/session/output.h"
#include "lang/session/units.h"
#include "lang/syntax/record.h"
#include "normal/solve/conditions.h"

static qdot_status carry_out_equilibria(qdot_record *r);

QDOT_STATEMENT(equilibria) = {
    .word = "equilibria",
    .group = QDOT_ASKING,
    .usage = "equilibria",
    .summary = "the equilibria of the scene, with their stability",
    .example = "equilibria",
    .alone = true,
    .linear = true,
    .handler = carry_out_equilibria,
};

enum { MOST_MAGNITUDE = 100 }; /* operations in relations that may be one about |b| */

/* Combine a > b and a + b > 0 into a > |b| for positive a (with >= if both relations are >=); else nil. */
static qdot_expr
combine_to_magnitude(qdot_pool *pool, qdot_expr one, qdot_expr other)
{
    qdot_expr sum, b;
    qdot_rel_op op;

    if (qdot_expr_kind(pool, one) != QDOT_REL || qdot_expr_kind(pool, other) != QDOT_REL ||
        qdot_expr_node(pool, one)->op == QDOT_EQ ||
        qdot_expr_node(pool, other)->op != qdot_expr_node(pool, one)->op ||
        qdot_expr_size(pool, one) + qdot_expr_size(pool, other) > MOST_MAGNITUDE)
        return QDOT_NIL;
    op = qdot_expr_node(pool, one)->op;
    one = qdot_sub(pool, qdot_expr_arg(pool, one, 1), qdot_expr_arg(pool, one, 0));
    other = qdot_sub(pool, qdot_expr_arg(pool, other, 1), qdot_expr_arg(pool, other, 0));
    sum = qdot_expand(pool, qdot_mul(pool, QDOT_HALF, qdot_add(pool, one, other)));
    b = qdot_expand(pool, qdot_mul(pool, QDOT_HALF, qdot_sub(pool, one, other)));
    if (sum == QDOT_NIL || b == QDOT_NIL || qdot_expr_kind(pool, b) == QDOT_SUM ||
        (qdot_expr_node(pool, sum)->sign & QDOT_POS) != QDOT_POS ||
        (qdot_expr_node(pool, b)->sign & (QDOT_GE0 | QDOT_LE0)) != 0)
        return QDOT_NIL;
    return qdot_rel(pool, op, qdot_fun1(pool, QDOT_ABS, b), sum);
}

/* The relation sign of a bound, < or <=; `turned`: > or >=, for exchanged sides. */
static qdot_formula_sign
relation_sign_of_bound(const qdot_pool *pool, qdot_expr relation, bool turned)
{
    const bool or_equal = qdot_expr_node(pool, relation)->op == QDOT_LE;

    return turned ? or_equal ? QDOT_SIGN_AT_LEAST : QDOT_SIGN_GREATER : or_equal ? QDOT_SIGN_AT_MOST : QDOT_SIGN_LESS;
}

static bool
is_inequality(const qdot_pool *pool, qdot_expr relation)
{
    return qdot_expr_kind(pool, relation) == QDOT_REL && qdot_expr_node(pool, relation)->op != QDOT_EQ;
}

static bool
is_coordinate(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_class(pool, e, QDOT_COORD);
}

/* Print lo < u < hi for lo < u and u < hi (other nil: only one of them), u a coordinate; false if
 * it is no such range. */
static bool
print_coordinate_range(qdot_sheet *sheet, qdot_expr one, qdot_expr other, bool *both, qdot_status *status)
{
    qdot_pool *pool = sheet->session->pool;
    qdot_expr left, right;

    *both = false;
    if (!is_inequality(pool, one))
        return false;
    left = qdot_expr_arg(pool, one, 0);
    right = qdot_expr_arg(pool, one, 1);
    if (is_coordinate(pool, right) == is_coordinate(pool, left))
        return false;
    *both = is_coordinate(pool, right) && other != QDOT_NIL && is_inequality(pool, other) &&
            qdot_expr_arg(pool, other, 0) == right &&
            !is_coordinate(pool, qdot_expr_arg(pool, other, 1));
    if (!*both && is_coordinate(pool, right)) /* a lower bound: u > lo */
        return false;
    qdot_sheet_open(sheet);
    *status = qdot_sheet_expr(sheet, left);
    if (*both && *status == QDOT_OK) {
        qdot_sheet_sign(sheet, relation_sign_of_bound(pool, one, false));
        *status = qdot_sheet_expr(sheet, right);
        one = other;
        right = qdot_expr_arg(pool, one, 1);
    }
    qdot_sheet_sign(sheet, relation_sign_of_bound(pool, one, false));
    if (*status == QDOT_OK)
        *status = qdot_sheet_expr(sheet, right);
    qdot_sheet_close(sheet);
    return true;
}

/* Print conditions as `a > b and c > d`; relations in the usual direction, a range of a coordinate as one. */
static qdot_status
print_conditions(qdot_sheet *sheet, qdot_expr list)
{
    qdot_pool *pool = sheet->session->pool;
    uint32_t n = qdot_expr_count(pool, list);

    for (uint32_t i = 0; i < n; i++) {
        qdot_expr one = qdot_expr_arg(pool, list, i),
                  next = i + 1 < n ? qdot_expr_arg(pool, list, i + 1) : QDOT_NIL;
        qdot_status status = QDOT_OK;
        bool both;

        qdot_sheet_words(sheet, i == 0 ? "" : " and ");
        if (print_coordinate_range(sheet, one, next, &both, &status)) {
            QDOT_TRY(status);
            i += both;
            continue;
        }
        if (next != QDOT_NIL) {
            qdot_expr magnitude = combine_to_magnitude(pool, one, next);

            i += magnitude != QDOT_NIL;
            one = magnitude != QDOT_NIL ? magnitude : one;
        }
        if (qdot_conditions_nonzero(pool, one) != QDOT_NIL) {
            const qdot_expr sides = qdot_conditions_unequal(pool, qdot_conditions_nonzero(pool, one));

            qdot_sheet_open(sheet);
            QDOT_TRY(qdot_sheet_expr(sheet, qdot_expr_arg(pool, sides, 0)));
            qdot_sheet_sign(sheet, QDOT_SIGN_UNEQUAL);
            QDOT_TRY(qdot_sheet_expr(sheet, qdot_expr_arg(pool, sides, 1)));
            qdot_sheet_close(sheet);
            continue;
        }
        if (!is_inequality(pool, one) ||
            qdot_expr_rational(pool, qdot_expr_arg(pool, one, 1)) != NULL) {
            QDOT_TRY(qdot_sheet_formula(sheet, one));
            continue;
        }
        qdot_sheet_open(sheet);
        QDOT_TRY(qdot_sheet_expr(sheet, qdot_expr_arg(pool, one, 1)));
        qdot_sheet_sign(sheet, relation_sign_of_bound(pool, one, true));
        QDOT_TRY(qdot_sheet_expr(sheet, qdot_expr_arg(pool, one, 0)));
        qdot_sheet_close(sheet);
    }
    return QDOT_OK;
}

static qdot_status
print_stability(qdot_sheet *sheet, const qdot_equilibrium *e)
{
    static const char *const words[] = {
        [QDOT_STABLE] = "stable",
        [QDOT_UNSTABLE] = "unstable",
        [QDOT_STABLE_TO_FIRST_ORDER] = "stable to first order",
        [QDOT_STABILITY_UNDECIDED] = "stability undecided",
    };

    if (e->numeric || e->numeric_range)
        qdot_sheet_words(sheet, "numeric, ");
    if (e->exists != QDOT_NIL) {
        qdot_sheet_words(sheet, "exists when ");
        QDOT_TRY(print_conditions(sheet, e->exists));
        qdot_sheet_words(sheet, ", ");
    }
    qdot_sheet_words(sheet, words[e->stability]);
    if (e->stable_when != QDOT_NIL) {
        qdot_sheet_words(sheet, " when ");
        QDOT_TRY(print_conditions(sheet, e->stable_when));
    }
    if (e->otherwise_to_first_order == QDOT_NIL)
        return QDOT_OK;
    qdot_sheet_words(sheet, ", otherwise stable to first order");
    if (qdot_expr_count(sheet->session->pool, e->otherwise_to_first_order) == 0)
        return QDOT_OK;
    qdot_sheet_words(sheet, " when ");
    return print_conditions(sheet, e->otherwise_to_first_order);
}

/* Print `theta = 0`; a value found numerically as a decimal. */
static qdot_status
print_equation(qdot_sheet *sheet, const qdot_equilibrium *e, uint32_t k)
{
    qdot_session *session = sheet->session;
    qdot_expr one = qdot_expr_arg(session->pool, e->equations, k);
    qdot_text number = {0};
    double value;
    qdot_status status;

    if (qdot_expr_arg(session->pool, one, 0) == qdot_expr_arg(session->pool, one, 1)) { /* a rate that is free */
        QDOT_TRY(qdot_sheet_formula(sheet, qdot_expr_arg(session->pool, one, 0)));
        qdot_sheet_words(sheet, " constant");
        return QDOT_OK;
    }
    if (!e->numeric)
        return qdot_sheet_formula(sheet, one);
    QDOT_TRY(
        qdot_session_number(session, qdot_expr_arg(session->pool, one, 1), &value, NULL));
    QDOT_TRY(qdot_sheet_formula(sheet, qdot_expr_arg(session->pool, one, 0)));
    qdot_number_text(&number, value, 0);
    qdot_units_in_brackets(session, qdot_expr_arg(session->pool, one, 0), &number);
    qdot_sheet_format(sheet, " = %s", qdot_text_str(&number));
    status = qdot_text_status(&number);
    qdot_text_clear(&number);
    return status;
}

/* Answer one equilibrium as `equilibria[1]: theta = 0, stable when ...`; in JSON the equations, then a text. */
static qdot_status
answer_one_equilibrium(qdot_session *session, const char *word, size_t i, const qdot_equilibrium *e)
{
    char name[60];
    qdot_status status = QDOT_OK;
    uint32_t n = qdot_expr_count(session->pool, e->equations);
    qdot_sheet sheet;

    snprintf(name, sizeof name, "%.20s[%zu]", word, i + 1);
    if (session->output->json)
        QDOT_TRY(qdot_answer_expr(session, name, qdot_equilibria_value(session->pool, e)));
    sheet = qdot_sheet_begin(session);
    if (!session->output->json)
        qdot_sheet_format(&sheet, "%s: ", name);
    for (uint32_t k = 0; k < n && !session->output->json && status == QDOT_OK; k++) {
        status = print_equation(&sheet, e, k);
        qdot_sheet_words(&sheet, ", ");
    }
    if (e->range != QDOT_NIL && !session->output->json && status == QDOT_OK) {
        status = print_conditions(&sheet, e->range);
        qdot_sheet_words(&sheet, ", ");
    }
    if (n == 0 && e->range == QDOT_NIL && !session->output->json)
        qdot_sheet_words(&sheet, "everywhere, "); /* everywhere: each position is an equilibrium, if the conditions hold */
    if (status == QDOT_OK)
        status = print_stability(&sheet, e);
    return qdot_sheet_end(&sheet, name, status);
}

/* Give a notice of parameter values that are special: `where a = 0 the places are others`. */
static qdot_status
give_notice_of_special_values(qdot_session *session, qdot_expr special, const char *words)
{
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    for (uint32_t i = 0; i < qdot_expr_count(session->pool, special) && status == QDOT_OK; i++) {
        qdot_text_add(&text, i == 0 ? "where " : " or ");
        status = qdot_print(session->pool, qdot_expr_arg(session->pool, special, i), QDOT_PLAIN, &text);
        qdot_text_add(&text, " = 0");
    }
    qdot_text_add(&text, words);
    return qdot_answer_notice_text(session, status, &text);
}

/* Add `there may be others where y = 0 and f(x) = 0, or ...` for a LIST of LISTs of equations. */
static qdot_status
add_unsolved(qdot_pool *pool, qdot_expr branches, qdot_text *text)
{
    qdot_text_add(text, "there may be others where ");
    for (uint32_t k = 0; k < qdot_expr_count(pool, branches); k++) {
        const qdot_expr one = qdot_expr_arg(pool, branches, k);

        qdot_text_add(text, k == 0 ? "" : ", or ");
        for (uint32_t i = 0; i < qdot_expr_count(pool, one); i++) {
            qdot_text_add(text, i == 0 ? "" : " and ");
            QDOT_TRY(qdot_print(pool, qdot_expr_arg(pool, one, i), QDOT_PLAIN, text));
        }
    }
    return QDOT_OK;
}

/* Give a notice that there is no equilibrium, or that the list may be incomplete. */
static qdot_status
give_notice_of_incompleteness(qdot_session *session, const char *word, const char *noun, const qdot_equilibria *all)
{
    qdot_text text = {0};
    qdot_status status = QDOT_OK;

    if (all->undefined != QDOT_NIL)
        QDOT_TRY(give_notice_of_special_values(session, all->undefined, " the energy or a force has no value"));
    if (all->special != QDOT_NIL)
        QDOT_TRY(give_notice_of_special_values(session, all->special,
                                               all->n > 0 ? " the places are others" : " there may be equilibria"));
    if (all->meeting != QDOT_NIL)
        QDOT_TRY(give_notice_of_special_values(session, all->meeting, " kinks meet: the places may be others"));
    if (all->recurs)
        QDOT_TRY(qdot_answer_notice(session, "these are the places of one turn: within the declared "
                                             "domain each recurs after every whole turn"));
    if (all->pole != NULL && all->n > 0)
        QDOT_TRY(qdot_answer_notice(session, "where the domain of `%.100s` ends these coordinates are singular: %s there are not "
                                             "searched for", all->pole, noun[0] == 'e' ? "equilibria" : "steady motions"));
    if (all->jump != QDOT_NIL)
        QDOT_TRY(qdot_answer_notice_of(
            session, "the energy jumps with %s: equilibria at the jumps are not searched for", all->jump));
    if (all->complete && all->n > 0)
        return QDOT_OK;
    if (all->complete) {
        qdot_text_format(&text, "there is no %s", noun);
    } else if (all->pole != NULL && all->n == 0 && all->starts == 0 && all->unset == NULL) {
        qdot_text_format(&text, "no %s was found; there may be some: where the domain of `%.100s` ends these "
                                "coordinates are singular, and rests there are not looked for", noun, all->pole);
    } else if (all->unset != NULL && all->unsolved != QDOT_NIL) {
        status = add_unsolved(session->pool, all->unsolved, &text);
        qdot_text_format(&text, ": no formula is found for these, and numbers need a value of `%.100s`", all->unset);
    } else if (all->unset != NULL) {
        qdot_text_format(&text, "there may be others: they cannot be solved for exactly, and numbers "
                                "need a value of `%.100s`", all->unset);
    } else {
        if (all->n == 0)
            qdot_text_format(&text, "no %s was found; there may be some", noun);
        else
            qdot_text_add(&text, "there may be others");
        if (all->starts > 0)
            qdot_text_format(&text, ": %zu starts in numbers, within -%g..%g where no domain is declared", all->starts,
                             all->reach, all->reach);
    }
    if (all->unproved > 0)
        qdot_text_format(&text, "; %zu of them ended where the equations hold to rounding, "
                                "but none is proved to be %s %s", all->unproved,
                         noun[0] == 'e' ? "an" : "a", noun);
    return qdot_answer_written(session, word, status, &text);
}

qdot_status
qdot_equilibria_answer(qdot_record *r, qdot_equilibria_search *find, const char *noun)
{
    qdot_session *session = r->cursor.session;
    const char *word = r->row->word;
    qdot_equilibria all;
    qdot_expr value;
    qdot_status status;

    r->cursor.error_at = r->start[-1].start; /* errors point at the statement's word */
    status = find(session, &all);
    if (status == QDOT_OK)
        status = qdot_warnings_inputs(session, 0, NULL);
    if (status == QDOT_OK)
        status = qdot_equilibria_list(session, &all, &value);
    if (status == QDOT_OK)
        status = qdot_vec_push(&session->history->values, value);
    for (size_t i = 0; i < all.n && status == QDOT_OK; i++)
        status = answer_one_equilibrium(session, word, i, &all.at[i]);
    if (status == QDOT_OK)
        status = give_notice_of_incompleteness(session, word, noun, &all);
    qdot_equilibria_clear(&all);
    return status;
}

static qdot_status
carry_out_equilibria(qdot_record *r)
{
    return qdot_equilibria_answer(r, qdot_equilibria_find, "equilibrium");
}
