/* solve-conditions.c -- conditions of solutions in words; parameters at which the solutions are others. */
#include "lang/functions/solve-conditions.h"

#include "base/text.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/session/value-kind.h"
#include "normal/prove/decide.h"
#include "normal/solve/solve.h"

/* Divisors of more operations, and more special values than these, are not looked at. */
enum { LONGEST = 40, MOST_SPECIALS = 6 };

/* --- conditions in words ------------------------------------------------------------------------------ */

/* `u != 0` for 0 < |u|, else the relation. */
static qdot_status
print_condition(qdot_pool *pool, qdot_expr relation, qdot_text *text)
{
    qdot_expr u = qdot_conditions_nonzero(pool, relation);

    QDOT_TRY(qdot_print(pool, u != QDOT_NIL ? u : relation, QDOT_PLAIN, text));
    if (u != QDOT_NIL)
        qdot_text_add(text, " != 0");
    return qdot_text_status(text);
}

/* Whether the root is undefined where the parameter has its special value, though its conditions hold there. */
static qdot_status
is_undefined_at(qdot_session *session, const qdot_root *root, const qdot_special *special,
                bool *undefined)
{
    qdot_pool *pool = session->pool;
    qdot_facts facts = qdot_scene_facts(session->scene);
    qdot_status status;

    (void)qdot_subs(pool, root->value, 1, &special->parameter, &special->value);
    status = qdot_pool_check(pool);
    *undefined = status == QDOT_EDOMAIN;
    if (!*undefined || root->condition == QDOT_NIL)
        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    *undefined = qdot_conditions_at(pool, root->condition, 1, &special->parameter,
                                    &special->value, &facts) != QDOT_FALSE;
    return qdot_pool_check(pool);
}

/* Add ` and C`, the first time ` exists when C`. */
static qdot_status
add_reason(unsigned *n, qdot_text *text)
{
    qdot_text_add(text, (*n)++ == 0 ? " exists when " : " and ");
    return qdot_text_status(text);
}

/* `x = V exists when C and D`, of a root that has conditions. */
static qdot_status
notice_conditions(qdot_session *session, qdot_expr x, const qdot_root *root,
                  const qdot_specials *specials)
{
    qdot_pool *pool = session->pool;
    uint32_t n = root->condition == QDOT_NIL ? 0 : qdot_expr_count(pool, root->condition);
    qdot_text text = {0};
    unsigned said = 0;
    qdot_status status =
        qdot_print(pool, qdot_rel(pool, QDOT_EQ, x, root->value), QDOT_PLAIN, &text);

    for (uint32_t i = 0; i < n && status == QDOT_OK; i++) {
        status = add_reason(&said, &text);
        if (status == QDOT_OK)
            status =
                print_condition(pool, qdot_expr_arg(pool, root->condition, i), &text);
    }
    for (size_t i = 0; i < specials->at.n && status == QDOT_OK; i++) {
        const qdot_special *special = &specials->at.at[i];
        bool undefined;

        status = is_undefined_at(session, root, special, &undefined);
        if (status != QDOT_OK || !undefined)
            continue;
        status = add_reason(&said, &text);
        if (status == QDOT_OK)
            status = qdot_print(pool, special->parameter, QDOT_PLAIN, &text);
        qdot_text_add(&text, " != ");
        if (status == QDOT_OK)
            status = qdot_print(pool, special->value, QDOT_PLAIN, &text);
    }
    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK && said > 0)
        status = qdot_answer_notice_once(session, "%s", qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

/* u != 0 for 0 < |u|. */
static qdot_expr
relation_value(qdot_pool *pool, qdot_expr relation)
{
    qdot_expr u = qdot_conditions_nonzero(pool, relation), equal;

    if (u == QDOT_NIL)
        return relation;
    equal = qdot_rel(pool, QDOT_EQ, u, QDOT_ZERO);
    return qdot_logic(pool, QDOT_NOT, 1, &equal);
}

qdot_status
qdot_solve_root_value(qdot_session *session, qdot_expr x, const qdot_root *root,
                      const qdot_specials *specials, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    uint32_t n = root->condition == QDOT_NIL ? 0 : qdot_expr_count(pool, root->condition);
    qdot_expr all[QDOT_CONDITIONS_MOST];

    *value = root->value;
    if (root->value != x)
        return notice_conditions(session, x, root, specials);
    if (n == 0)
        return qdot_fail(QDOT_EDOMAIN, "the equation holds for every value");
    if (n > QDOT_CONDITIONS_MOST)
        return qdot_fail(QDOT_ELIMIT, "the solutions fulfil more than %d conditions",
                         QDOT_CONDITIONS_MOST);
    for (uint32_t i = 0; i < n; i++)
        all[i] = relation_value(pool, qdot_expr_arg(pool, root->condition, i));
    *value = n == 1 ? all[0] : qdot_logic(pool, QDOT_AND, n, all);
    return qdot_pool_check(pool);
}

/* --- special values ----------------------------------------------------------------------------------- */

void
qdot_specials_clear(qdot_specials *s)
{
    qdot_free(s->at.at);
    *s = (qdot_specials){0};
}

/* The values of one parameter at which the factor d of a divisor is 0: those that are values whatever the
 * other parameters are, by a parameter in which d is linear or that stands alone in d. */
static qdot_status
zeros_of_divisor(qdot_pool *pool, qdot_expr d, const qdot_facts *facts,
                 qdot_specials *out)
{
    qdot_expr atoms = qdot_expr_atoms(pool, d, false);

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr p = qdot_expr_arg(pool, atoms, i), slope, zero;
        qdot_solutions found = {0};
        qdot_status status;

        if (!qdot_expr_is_class(pool, p, QDOT_PARAM))
            continue;
        slope = qdot_diff(pool, d, p);
        QDOT_TRY(qdot_pool_check(pool));
        if (qdot_expr_rational(pool, slope) == NULL &&
            qdot_expr_count(pool, atoms) > 1)
            continue;
        status = qdot_solve_inside(pool, d, p, QDOT_NIL, facts, &found);
        for (size_t k = 0; k < found.root.n && status == QDOT_OK; k++) {
            zero = found.root.at[k].value;
            if (found.root.at[k].condition == QDOT_NIL && out->at.n < MOST_SPECIALS)
                status = qdot_vec_push(&out->at, ((qdot_special){p, zero}));
        }
        qdot_solutions_clear(&found);
        return status;
    }
    return QDOT_OK;
}

/* Whether the value is among those of the generic roots that are defined at the special value. */
static bool
is_generic_root(qdot_pool *pool, const qdot_solutions *found, const qdot_special *special,
                qdot_expr value, const qdot_facts *facts)
{
    for (size_t i = 0; i < found->root.n; i++) {
        qdot_expr there = qdot_subs(pool, found->root.at[i].value, 1, &special->parameter,
                                    &special->value);

        if (there == QDOT_NIL) {
            if (qdot_pool_check(pool) != QDOT_EDOMAIN)
                (void)qdot_pool_fail(pool);
        } else if (there == value ||
                   qdot_is_zero(pool, qdot_sub(pool, there, value), facts)) {
            return true;
        }
    }
    return false;
}

/* `for a = 0: x = V, x = W`, the solutions there, where one of them is not among the generic ones. */
static qdot_status
notice_special(qdot_session *session, qdot_expr x, const qdot_special *special,
               const qdot_solutions *there, const qdot_solutions *found,
               const qdot_facts *facts)
{
    qdot_pool *pool = session->pool;
    qdot_text text = {0};
    qdot_status status;
    bool other = false;

    for (size_t i = 0; i < there->root.n; i++)
        other = other ||
                !is_generic_root(pool, found, special, there->root.at[i].value, facts);
    QDOT_TRY(qdot_pool_check(pool));
    if (!other)
        return QDOT_OK;
    qdot_text_add(&text, "for ");
    status = qdot_print(pool, qdot_rel(pool, QDOT_EQ, special->parameter, special->value),
                        QDOT_PLAIN, &text);
    for (size_t i = 0; i < there->root.n && status == QDOT_OK; i++) {
        const qdot_root *root = &there->root.at[i];
        uint32_t n =
            root->condition == QDOT_NIL ? 0 : qdot_expr_count(pool, root->condition);

        qdot_text_add(&text, i == 0 ? ": " : ", ");
        if (root->value != x)
            status = qdot_print(pool, qdot_rel(pool, QDOT_EQ, x, root->value), QDOT_PLAIN,
                                &text);
        else if (n == 0)
            qdot_text_add(&text, "every value is a solution");
        for (uint32_t k = 0; k < n && status == QDOT_OK; k++) {
            qdot_text_add(&text, k > 0 ? " and " : root->value != x ? " when " : "");
            status =
                print_condition(pool, qdot_expr_arg(pool, root->condition, k), &text);
        }
    }
    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = qdot_answer_notice(session, "%s", qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

/* The solutions at one special value. */
static qdot_status
solve_special(qdot_session *session, qdot_expr f, qdot_expr x, qdot_expr domain,
              const qdot_special *special, const qdot_solutions *found)
{
    qdot_pool *pool = session->pool;
    qdot_facts facts = qdot_scene_facts(session->scene);
    qdot_expr there = qdot_subs(pool, f, 1, &special->parameter, &special->value);
    qdot_root every = {x, QDOT_NIL, QDOT_NIL, QDOT_NIL};
    qdot_solutions set = {0};
    qdot_status status = qdot_pool_check(pool);

    if (status == QDOT_EDOMAIN) /* the equation is not defined there */
        return QDOT_OK;
    QDOT_TRY(status);
    if (qdot_is_zero(pool, there, &facts)) {
        QDOT_TRY(qdot_vec_push(&set.root, every));
        set.complete = true;
    } else {
        status =
            qdot_solve_inside(pool, there, x,
                              qdot_conditions_at(pool, domain, 1, &special->parameter,
                                                 &special->value, &facts),
                              &facts, &set);
    }
    if (status == QDOT_OK && set.complete)
        status = notice_special(session, x, special, &set, found, &facts);
    qdot_solutions_clear(&set);
    return status;
}

qdot_status
qdot_solve_specials(qdot_session *session, qdot_expr f, qdot_expr x, qdot_expr domain,
                    const qdot_solutions *found, qdot_specials *specials)
{
    qdot_pool *pool = session->pool;
    qdot_facts facts = qdot_scene_facts(session->scene);

    for (size_t i = 0; i < found->special.n; i++) {
        qdot_expr d = found->special.at[i], factors;

        if (!qdot_expr_is_scalar(pool, d) || qdot_expr_size(pool, d) > LONGEST)
            continue;
        factors = qdot_solve_factors(pool, d);
        QDOT_TRY(qdot_pool_check(pool));
        for (uint32_t k = 0; k < qdot_expr_count(pool, factors); k++)
            QDOT_TRY(zeros_of_divisor(pool, qdot_expr_arg(pool, factors, k), &facts,
                                      specials));
    }
    for (size_t i = 0; i < specials->at.n; i++)
        QDOT_TRY(solve_special(session, f, x, domain, &specials->at.at[i], found));
    return QDOT_OK;
}
