/* solve-conditions.c -- puts the conditions of solutions, and special values of parameters, into words. */
#include "lang/functions/solve-conditions.h"

#include "base/text.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/print-name.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "normal/solve/conditions.h"

/* --- conditions in words ------------------------------------------------------------------------------ */

/* Print `u != 0` for 0 < |u|, with terms moved so that no minus leads; otherwise the relation itself. */
static qdot_status
print_condition(qdot_pool *pool, qdot_expr relation, qdot_text *text)
{
    qdot_expr u = qdot_conditions_nonzero(pool, relation), sides;

    if (u == QDOT_NIL)
        return qdot_print(pool, relation, QDOT_PLAIN, text);
    sides = qdot_conditions_unequal(pool, u);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_print(pool, qdot_expr_arg(pool, sides, 0), QDOT_PLAIN, text));
    qdot_text_add(text, " != ");
    return qdot_print(pool, qdot_expr_arg(pool, sides, 1), QDOT_PLAIN, text);
}

qdot_status
qdot_solve_print_conditions(qdot_pool *pool, const char *word, qdot_expr conditions,
                            qdot_text *text)
{
    uint32_t n = conditions == QDOT_NIL ? 0 : qdot_expr_count(pool, conditions);

    for (uint32_t i = 0; i < n; i++) {
        qdot_text_add(text, i == 0 ? word : " and ");
        QDOT_TRY(print_condition(pool, qdot_expr_arg(pool, conditions, i), text));
    }
    return qdot_text_status(text);
}

qdot_status
qdot_solve_notice_conditions(qdot_session *session, qdot_expr solution, qdot_expr conditions)
{
    qdot_pool *pool = session->pool;
    qdot_text text = {0};
    qdot_status status;

    if (conditions == QDOT_NIL)
        return QDOT_OK;
    status = qdot_print(pool, solution, QDOT_PLAIN, &text);
    if (status == QDOT_OK)
        status = qdot_solve_print_conditions(pool, " exists when ", conditions, &text);
    return qdot_answer_condition_text(session, status, &text);
}

/* The relation u != 0 if the given relation is 0 < |u|, which means the same; otherwise the given relation. */
static qdot_expr
condition_as_relation(qdot_pool *pool, qdot_expr relation)
{
    qdot_expr u = qdot_conditions_nonzero(pool, relation), equal;

    if (u == QDOT_NIL)
        return relation;
    equal = qdot_rel(pool, QDOT_EQ, u, QDOT_ZERO);
    return qdot_logic(pool, QDOT_NOT, 1, &equal);
}

qdot_status
qdot_solve_root_value(qdot_pool *pool, qdot_expr x, const qdot_root *root, qdot_expr *value)
{
    uint32_t n = root->condition == QDOT_NIL ? 0 : qdot_expr_count(pool, root->condition);
    qdot_expr all[QDOT_CONDITIONS_MOST];

    *value = root->value;
    if (root->value != x)
        return QDOT_OK;
    if (n == 0)
        return qdot_fail(QDOT_EDOMAIN, "the equation holds for every value");
    if (n > QDOT_CONDITIONS_MOST)
        return qdot_fail(QDOT_ELIMIT, "the solutions fulfil more than %d conditions",
                         QDOT_CONDITIONS_MOST);
    for (uint32_t i = 0; i < n; i++)
        all[i] = condition_as_relation(pool, qdot_expr_arg(pool, root->condition, i));
    *value = n == 1 ? all[0] : qdot_logic(pool, QDOT_AND, n, all);
    return qdot_pool_check(pool);
}

/* --- special values of parameters --------------------------------------------------------------------- */

/* Give the notice `for a = 0 and b = 1: x = V when C, x = W`: the solutions at special parameter values. */
static qdot_status
give_notice_of_special(qdot_session *session, qdot_expr x, const qdot_special *special)
{
    qdot_pool *pool = session->pool;
    const qdot_solutions *set = &special->set;
    qdot_text text = {0};
    qdot_status status = qdot_solve_print_conditions(pool, "for ", special->where, &text);

    for (size_t i = 0; i < set->root.n && status == QDOT_OK; i++) {
        const qdot_root *root = &set->root.at[i];
        bool every = root->value == x;

        qdot_text_add(&text, i == 0 ? ": " : ", ");
        if (!every)
            status = qdot_print(pool, qdot_rel(pool, QDOT_EQ, x, root->value), QDOT_PLAIN, &text);
        else if (root->condition == QDOT_NIL)
            qdot_text_add(&text, "every value is a solution");
        if (status == QDOT_OK)
            status = qdot_solve_print_conditions(pool, every ? "" : " when ", root->condition, &text);
    }
    return qdot_answer_notice_text(session, status, &text);
}

qdot_status
qdot_solve_notice_open(qdot_session *session, qdot_expr where)
{
    qdot_text text = {0};
    qdot_status status = qdot_solve_print_conditions(session->pool, "where ", where, &text);

    qdot_text_add(&text, " the solutions may be others");
    return qdot_answer_notice_text(session, status, &text);
}

qdot_status
qdot_solve_notice_powers(qdot_session *session, size_t n, const qdot_expr *F, size_t m, const qdot_expr *x, bool single,
                         const qdot_facts *facts)
{
    qdot_pool *pool = session->pool;
    const qdot_expr atoms = qdot_expr_atoms(pool, qdot_list(pool, (uint32_t)n, F), true);
    qdot_expr of = single ? x[0] : QDOT_NIL;

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms) && !single; i++) {
        of = qdot_expr_arg(pool, atoms, i);
        if (qdot_expr_symbol(pool, of) != NULL && qdot_expr_place(m, x, of) == m)
            QDOT_TRY(qdot_has_single_places(pool, n, F, 1, &of, facts, &single));
    }
    QDOT_TRY(qdot_pool_check(pool));
    return single ? qdot_answer_notice(session, "there may be others where the base of a power with %.100s in its exponent is "
                                                "0 or negative",
                                       qdot_expr_symbol(pool, of)->name)
                  : QDOT_OK;
}

qdot_status
qdot_solve_notice_all(qdot_session *session, const char *words, qdot_expr conditions)
{
    qdot_text text = {0};

    return conditions == QDOT_NIL
               ? QDOT_OK
               : qdot_answer_notice_text(
                     session, qdot_solve_print_conditions(session->pool, words, conditions, &text), &text);
}

qdot_status
qdot_solve_notice_specials(qdot_session *session, qdot_expr x, const qdot_specials *specials)
{
    for (size_t i = 0; i < specials->at.n; i++)
        QDOT_TRY(give_notice_of_special(session, x, &specials->at.at[i]));
    for (size_t i = 0; i < specials->open.n; i++)
        QDOT_TRY(qdot_solve_notice_open(session, qdot_list(session->pool, 1, &specials->open.at[i])));
    return QDOT_OK;
}
