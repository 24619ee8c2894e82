/* solve.c -- the function solve(...): exactly, in numbers over a range, in numbers from a guess.
 *
 *     solve(A = B, x)                             every value in the domain of x: exact; where no formula gives them
 *                                                 in numbers, if all are proved to be found
 *     solve([A = B, C = D], [x, y])               the same in several unknowns (solve-system.h)
 *     solve(A = B, x, a..b)                       every zero in a..b, in numbers
 *     solve(A = B, x = guess)                     the one that Newton's steps reach
 *     solve([A = B, C = D], [x = 1, y = 2])       the same in several unknowns
 *
 * Where A and B, as they were written, are not defined there is no solution, though what is left of them after
 * simplification may be: solve(sin(asin(x)) = a, x) asks for -1 <= a <= 1.
 *
 * Tests   tests/script/solve/solve.lag, solution-sets.lag, solve-domains.lag, solve-line.lag, solve-special.lag
 */
#include "lang/functions/builtin.h"

#include <math.h>

#include "base/memory.h"
#include "base/text.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/functions/solve-conditions.h"
#include "lang/functions/solve-numbers.h"
#include "lang/functions/solve-system.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "lang/session/momenta.h"
#include "mech/scene/things.h"
#include "normal/refute/ball.h"
#include "normal/solve/assumptions.h"
#include "normal/solve/solve.h"

/* Conditions for everything that contains x in the equation, as typed, to be defined (x nil: for everything). */
static qdot_expr
domain_of_typed_equation(qdot_session *session, qdot_expr x)
{
    qdot_pool *pool = session->pool;
    const qdot_passed *p = session->evaluation->passed;
    qdot_expr list;

    if (p == NULL || p->spoiled || p->value.n == 0)
        return QDOT_NIL;
    list = qdot_list(pool, (uint32_t)p->value.n, p->value.at);
    return qdot_conditions_all(pool, qdot_conditions_of_domain(pool, list, x),
                               qdot_conditions_of_divisors(pool, list, x));
}

/* Conditions under which the functions among these values [n] are defined, apart from those of
 * their arguments. */
static qdot_expr
function_domain_conditions(qdot_pool *pool, size_t n, const qdot_expr *value)
{
    qdot_expr set = QDOT_NIL;

    for (size_t i = 0; i < n; i++)
        if (qdot_expr_kind(pool, value[i]) == QDOT_FUN)
            set = qdot_conditions_all(pool, set, qdot_conditions_of_function(pool, value[i]));
    return set;
}

/* What the equation that was written asks of all that is in it: of roots what was written, not of the parts that they were
 * taken into. */
static qdot_status
find_conditions_as_written(qdot_session *session, qdot_written *w)
{
    qdot_pool *pool = session->pool;
    const qdot_passed *p = session->evaluation->passed;
    qdot_written of_roots = {QDOT_NIL, QDOT_NIL};
    qdot_expr all = domain_of_typed_equation(session, QDOT_NIL), asked;

    *w = (qdot_written){all, QDOT_NIL};
    QDOT_TRY(qdot_pool_check(pool));
    if (all == QDOT_NIL)
        return QDOT_OK;
    asked = function_domain_conditions(pool, p->value.n, p->value.at);
    for (size_t i = 0; i + 1 < p->root.n; i += 2)
        QDOT_TRY(qdot_written_add(pool, p->root.at[i], p->root.at[i + 1], &of_roots, &asked));
    w->apart = qdot_conditions_less(pool, of_roots.apart, asked);
    w->domain = qdot_conditions_all(pool, qdot_conditions_less(pool, all, w->apart), of_roots.domain);
    return qdot_pool_check(pool);
}

/* --- an equation in one unknown ---------------------------------------------------------------------- */

/* A list of solutions that is being put together. */
typedef struct {
    qdot_vec(qdot_solve_zero) at;
    bool constant; /* all entries are numbers, and are kept in ascending order */
} solve_list;

/* Insert a number into the sorted list, unless the same root is in the list as a formula. */
static qdot_status
solve_list_add(solve_list *l, qdot_solve_zero one)
{
    size_t k = l->at.n;

    for (size_t i = 0; i < l->at.n; i++)
        if (fabs(l->at.at[i].at - one.at) <= 4 * one.radius + 1e-15 * fabs(one.at))
            return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&l->at, one));
    for (; l->constant && k > 0 && l->at.at[k - 1].at > one.at; k--)
        l->at.at[k] = l->at.at[k - 1];
    l->at.at[k] = one;
    return QDOT_OK;
}

/* Whether the equation is satisfied by every x, under a condition on parameters. */
static bool
is_solved_by_every_value(const qdot_pool *pool, qdot_expr x, const qdot_root *root)
{
    return root->value == x && root->condition != QDOT_NIL && !qdot_expr_contains(pool, root->condition, x);
}

/* Give notices of the conditions of the exact roots. */
static qdot_status
give_notice_of_exact_roots(qdot_session *session, qdot_expr x, const qdot_solutions *found)
{
    qdot_pool *pool = session->pool;

    for (size_t i = 0; i < found->root.n; i++) {
        const qdot_root *root = &found->root.at[i];

        if (is_solved_by_every_value(pool, x, root))
            QDOT_TRY(qdot_solve_notice_all(session, "every value is a solution when ", root->condition));
        else if (root->value != x)
            QDOT_TRY(qdot_solve_notice_conditions(session, qdot_rel(pool, QDOT_EQ, x, root->value), root->condition));
    }
    return QDOT_OK;
}

/* Append the exact roots of an equation to the list of its solutions. */
static qdot_status
add_exact_roots(qdot_session *session, qdot_expr x, const qdot_solutions *found,
                solve_list *list)
{
    qdot_pool *pool = session->pool;

    for (size_t i = 0; i < found->root.n; i++) {
        const qdot_root *root = &found->root.at[i];
        qdot_solve_zero one = {.value = root->value, .at = NAN};

        if (is_solved_by_every_value(pool, x, root))
            continue;
        list->constant =
            list->constant && qdot_ball_double(pool, one.value, NULL, NULL, &one.at);
        QDOT_TRY(qdot_pool_check(pool));
        if (!list->constant)
            one.at = NAN;
        QDOT_TRY(qdot_solve_root_value(pool, x, root, &one.value));
        QDOT_TRY(qdot_vec_push(&list->at, one));
    }
    return QDOT_OK;
}

/* Whether e contains a symbol other than x to which no value was given. */
static bool
contains_other_unknowns(qdot_session *session, qdot_expr e, qdot_expr x)
{
    qdot_pool *pool = session->pool;
    qdot_expr atoms = qdot_expr_atoms(pool, qdot_session_bind(session, e), true);
    bool others = false;

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++)
        others = others ||
                 (qdot_expr_arg(pool, atoms, i) != x &&
                  !qdot_expr_is_class(pool, qdot_expr_arg(pool, atoms, i), QDOT_CONST));
    return others;
}

/* Find numerically the roots of the factors of f that no formula solves. *known: these are all roots. */
static qdot_status
add_numerical_roots(qdot_session *session, qdot_expr f, qdot_expr x, const qdot_written *written,
                    const qdot_facts *facts, solve_list *list, bool *recurs, bool *known)
{
    qdot_pool *pool = session->pool;
    qdot_expr factors, rest = QDOT_ONE;
    qdot_solve_zeros zeros = {0};
    qdot_expr domain = written->domain;
    qdot_window window;
    qdot_status status;
    bool whole, all = true;
    size_t exact;

    QDOT_TRY(qdot_solve_unsolved(pool, f, x, facts, &factors, &whole));
    whole = whole && !contains_other_unknowns(session, f, x);
    for (uint32_t i = 0; i < qdot_expr_count(pool, factors) && !whole; i++)
        rest = qdot_mul(pool, rest, qdot_expr_arg(pool, factors, i));
    if (rest == QDOT_ONE) /* either no factor was solved exactly, or every one: take the whole of f */
        rest = f;
    domain = qdot_conditions_all(pool, domain, qdot_conditions_of_domain(pool, f, x));
    window = qdot_solve_tighten(pool, x, domain, qdot_solve_window(pool, x, false), facts);
    if (qdot_is_angle(pool, rest, x, facts))
        window = qdot_window_turn(pool, window);
    QDOT_TRY(qdot_pool_check(pool));
    *recurs = *recurs || window.recurs;
    if (!whole) /* a zero of the factors not yet solved may be a zero of a divisor, where f is undefined */
        domain =
            qdot_conditions_all(pool, domain, qdot_conditions_of_divisors(pool, f, x));
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_solve_line(session, rest, x, domain, &window, &zeros, known, &all);
    all = all && written->apart == QDOT_NIL; /* where a root that was split is 0, its parts may be undefined */
    exact = list->at.n;
    for (size_t i = 0; i < zeros.n && status == QDOT_OK; i++)
        status = solve_list_add(list, zeros.at[i]);
    qdot_free(zeros.at);
    if (status == QDOT_OK && *known && (list->at.n > exact || exact == 0 || !all))
        status = qdot_answer_notice(session, "no formula gives %s: found in numbers%s",
                                    list->at.n == exact + 1 ? "this zero" : "these zeros",
                                    all ? ", proved to be all" : "");
    if (status == QDOT_OK && *known && written->apart != QDOT_NIL)
        status = qdot_answer_notice(session, "there may be others where what stands under a root is 0");
    return status;
}

/* Zeros were found in numbers: tell at which special values of parameters the solutions are others, and under which
 * conditions on parameters they exist. */
static qdot_status
give_notice_of_parameters(qdot_session *session, qdot_expr f, qdot_expr x, const qdot_written *written, const qdot_facts *facts,
                          const qdot_solutions *found)
{
    qdot_pool *pool = session->pool;
    qdot_expr set = qdot_conditions_at(pool, qdot_solve_conditions(pool, written->domain, f, x), 0, NULL, NULL, facts);
    qdot_specials specials = {0};
    qdot_status status;

    set = qdot_conditions_reduce(pool, set, facts);
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_solve_specials(pool, f, x, written, facts, found, &specials);
    if (status == QDOT_OK)
        status = qdot_solve_notice_specials(session, x, &specials);
    if (status == QDOT_OK && set != QDOT_FALSE) /* FALSE: there are solutions at most for single values of parameters */
        status = qdot_solve_notice_all(session, "solutions exist when ", set);
    qdot_specials_clear(&specials);
    return status;
}

/* Evaluate solve(a = b, x), or solve(e, x) for e = 0: the list of values of x. */
static qdot_status
solve_for_one_unknown(qdot_session *session, qdot_expr equation, qdot_expr x, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    const qdot_facts scene = qdot_scene_facts(session->scene);
    qdot_assumptions assumed = {0};
    qdot_expr f = qdot_value_kind_difference(pool, equation), *values;
    qdot_written written;
    qdot_solutions found = {0};
    qdot_specials specials = {0};
    solve_list list = {.constant = true};
    qdot_status status;
    bool known = true, complete;

    QDOT_TRY(qdot_value_kind_need_symbol(pool, x, "solve(a = b, x) takes a symbol for x"));
    if (f != QDOT_NIL)
        f = qdot_momenta_for(session, f, x);
    QDOT_TRY(qdot_value_kind_check(pool, f));
    if (!qdot_expr_is_scalar(pool, f))
        return qdot_fail(QDOT_ETYPE, "solve takes an equation between numbers, not %s",
                         qdot_value_kind_words(pool, equation));
    QDOT_TRY(find_conditions_as_written(session, &written));
    status = qdot_assumptions_read(pool, &scene, qdot_list(pool, 1, &x), &assumed);
    assumed.facts.exact = true;
    f = qdot_assumptions_put(pool, &assumed, f);
    written.domain = qdot_conditions_all(pool, qdot_assumptions_put(pool, &assumed, written.domain), assumed.domain);
    written.apart = qdot_assumptions_put(pool, &assumed, written.apart);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = qdot_written_take_apart(pool, &f, x, &written);
    if (status == QDOT_OK)
        status = qdot_solve_written(pool, f, x, &written, &assumed.facts, &found);
    found.single = found.single && contains_other_unknowns(session, f, x); /* without parameters numbers are searched */
    complete = found.complete || found.single;
    if (status == QDOT_OK)
        status = qdot_solve_parameters(pool, f, x, &written, &assumed.facts, &found);
    if (status == QDOT_OK && complete)
        status = qdot_solve_specials(pool, f, x, &written, &assumed.facts, &found, &specials);
    if (status == QDOT_OK)
        status = qdot_solve_notice_specials(session, x, &specials);
    if (status == QDOT_OK)
        status = add_exact_roots(session, x, &found, &list);
    if (status == QDOT_OK && !complete)
        status = add_numerical_roots(session, f, x, &written, &assumed.facts, &list, &found.recurs, &known);
    if (status == QDOT_OK && known)
        status = give_notice_of_exact_roots(session, x, &found);
    if (status == QDOT_OK && !complete && known)
        status = give_notice_of_parameters(session, f, x, &written, &assumed.facts, &found);
    if (status == QDOT_OK && known)
        status = qdot_solve_notice_powers(session, 1, &f, 1, &x, found.single, &assumed.facts);
    if (status == QDOT_OK && !known) {
        (void)qdot_fail(QDOT_EFAILED, "this equation cannot be solved exactly%s",
                        found.root.n > 0 ? " for every x" : "");
        status = qdot_hint(
            "linear, quadratic, factorable and trigonometric equations can; others in "
            "numbers within a range: solve(A = B, x, 0..1)");
    }
    if (status == QDOT_OK && found.recurs)
        status = qdot_answer_condition(session,
                                       "these are the solutions of one turn: within the domain of %s each recurs after "
                                       "every whole turn",
                                       qdot_expr_symbol(pool, x)->name);

    values = qdot_malloc((list.at.n + 1) * sizeof *values);
    if (status == QDOT_OK && values == NULL)
        status = QDOT_ENOMEM;
    for (size_t i = 0; i < list.at.n && status == QDOT_OK; i++)
        values[i] = list.at.at[i].value;
    if (status == QDOT_OK)
        *value = qdot_list(pool, (uint32_t)list.at.n, values);
    qdot_free(values);
    qdot_free(list.at.at);
    qdot_specials_clear(&specials);
    qdot_solutions_clear(&found);
    qdot_assumptions_clear(&assumed);
    return status == QDOT_OK ? qdot_value_kind_check(pool, *value) : status;
}

/* --- the call of solve ------------------------------------------------------------------------------- */

/* If a range is given, n is 4 and its ends stand last. What stood in args before simplification is in
 * session->passed. */
qdot_status
qdot_call_solve(qdot_session *session, uint32_t n, const qdot_expr *args,
                qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    qdot_expr x;

    if (n != 2 && n != 4) {
        (void)qdot_fail(QDOT_ETYPE,
                        "solve takes one equation and one unknown, then a range");
        return qdot_hint("as in solve(cos(x) = x, x, 0..2)");
    }
    QDOT_TRY(qdot_infinity_refuse(pool, args[0]));
    if (n == 2 && qdot_value_kind_are_equations(pool, args[1]))
        return qdot_solve_system_near(session, args[0], args[1],
                                      domain_of_typed_equation(session, QDOT_NIL), value);
    if (n == 2 && qdot_expr_kind(pool, args[1]) == QDOT_LIST)
        return qdot_solve_system(session, args[0], args[1],
                                 domain_of_typed_equation(session, QDOT_NIL), value);
    if (n == 2 && !qdot_value_kind_is_equation(pool, args[1]))
        return solve_for_one_unknown(session, args[0], args[1], value);
    x = n == 4 ? args[1] : qdot_expr_arg(pool, args[1], 0);
    if (n == 4)
        return qdot_solve_range(session, args[0], x, domain_of_typed_equation(session, x),
                                args + 2, value);
    return qdot_solve_near(session, 1, args, args + 1, domain_of_typed_equation(session, x),
                           false, value);
}
