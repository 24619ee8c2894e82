/* solve-system.c -- solves several equations in several unknowns: finds the set of solutions, and gives notices. */
#include "lang/functions/solve-system.h"

#include <math.h>

#include "base/memory.h"
#include "base/text.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/print-name.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/functions/solve-conditions.h"
#include "lang/functions/solve-numbers.h"
#include "mech/scene/things.h"
#include "normal/prove/decide.h"
#include "normal/refute/ball.h"
#include "normal/solve/assumptions.h"
#include "normal/solve/simultaneous.h"
#include "normal/solve/solve.h"
#include "normal/solve/special-values.h"
#include "normal/solve/zeros.h"

enum { MOST = QDOT_ZEROS_MOST_UNKNOWNS };

/* --- reading equations and unknowns ------------------------------------------------------------------ */

typedef struct {
    qdot_session *session;
    qdot_pool *pool;
    qdot_facts facts;
    size_t n;
    qdot_expr f[MOST], u[MOST];
    qdot_expr domain;
} question;

static qdot_status
read_question(question *q, qdot_expr equations, qdot_expr unknowns)
{
    qdot_pool *pool = q->pool;
    uint32_t n = qdot_expr_count(pool, unknowns);

    if (n == 0 || n > MOST || qdot_expr_kind(pool, equations) != QDOT_LIST ||
        qdot_expr_count(pool, equations) != n) {
        (void)qdot_fail(QDOT_ETYPE, "solve takes as many equations as unknowns, up to %d",
                        MOST);
        return qdot_hint("as in solve([x + y = 3, x*y = 2], [x, y])");
    }
    q->n = n;
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr e = qdot_expr_arg(pool, equations, i);

        q->u[i] = qdot_expr_arg(pool, unknowns, i);
        QDOT_TRY(qdot_value_kind_need_symbol(pool, q->u[i],
                                             "solve takes symbols as unknowns, not %s"));
        if (qdot_expr_place(i, q->u, q->u[i]) < i)
            return qdot_fail(QDOT_EINVAL, "`%.200s` is named twice",
                             qdot_expr_symbol(pool, q->u[i])->name);
        q->f[i] = qdot_value_kind_difference(pool, e);
        QDOT_TRY(qdot_value_kind_check(pool, q->f[i]));
        if (!qdot_expr_is_scalar(pool, q->f[i]))
            return qdot_fail(QDOT_ETYPE, "solve takes equations between numbers, not %s",
                             qdot_value_kind_words(pool, e));
    }
    return QDOT_OK;
}

/* --- special values of parameters ---------------------------------------------------------------------- */

enum { MOST_SPECIALS = 6 };

/* Add to the conditions of each solution that its values are defined, at special values of parameters too; leave out
 * those that follow from others. */
static qdot_status
add_domain_conditions(const question *q, qdot_simultaneous *set)
{
    size_t kept = 0;

    for (size_t k = 0; k < set->found.n; k++) {
        qdot_simultaneous_solution one = set->found.at[k];
        qdot_expr more = qdot_conditions_all(q->pool,
                                             qdot_conditions_of_domain(q->pool, one.values, QDOT_NIL),
                                             qdot_conditions_of_divisors(q->pool, one.values, QDOT_NIL));

        more = qdot_conditions_at(q->pool, more, 0, NULL, NULL, &q->facts);
        one.conditions = qdot_conditions_all(q->pool, one.conditions, more);
        if (one.conditions != QDOT_NIL && one.conditions != QDOT_FALSE)
            one.conditions = qdot_conditions_reduce(q->pool, one.conditions, &q->facts);
        QDOT_TRY(qdot_pool_check(q->pool));
        if (one.conditions != QDOT_FALSE)
            set->found.at[kept++] = one;
    }
    set->found.n = kept;
    return QDOT_OK;
}

/* Whether solution k at special parameter values is the limit of a solution for general values. */
static bool
is_limit_of_general_solution(const question *q, const qdot_simultaneous *generic, qdot_expr where,
                             const qdot_simultaneous *there, size_t k)
{
    qdot_expr from[QDOT_SPECIAL_TOGETHER], to[QDOT_SPECIAL_TOGETHER];
    size_t n = qdot_special_sides(q->pool, where, from, to);

    for (size_t i = 0; i < generic->found.n; i++) {
        qdot_simultaneous_solution all = generic->found.at[i];
        qdot_status status;

        all.values = qdot_subs(q->pool, all.values, n, from, to);
        if (all.values != QDOT_NIL && all.conditions != QDOT_NIL)
            all.conditions = qdot_conditions_at(q->pool, all.conditions, n, from, to, &q->facts);
        status = qdot_pool_check(q->pool);
        if (status != QDOT_OK && status != QDOT_EDOMAIN)
            (void)qdot_pool_fail(q->pool);
        if (status == QDOT_OK && all.conditions != QDOT_FALSE &&
            qdot_simultaneous_lies_in(there, &there->found.at[k], &all))
            return true;
    }
    return false;
}

/* Give the notice `for a = 0: [x = 1, y = 2], ...`, if a solution there is not among those for general values. */
static qdot_status
give_notice_of_special(const question *q, qdot_expr where, const qdot_simultaneous *there,
                       const qdot_simultaneous *generic)
{
    qdot_text text = {0};
    bool other = !there->complete;
    qdot_status status;

    for (size_t k = 0; k < there->found.n && !other; k++)
        other = !is_limit_of_general_solution(q, generic, where, there, k);
    QDOT_TRY(qdot_pool_check(q->pool));
    if (!other)
        return QDOT_OK;
    status = qdot_solve_print_conditions(q->pool, "for ", where, &text);
    if (!there->complete)
        qdot_text_add(&text, " the solutions may be others");
    for (size_t k = 0; k < there->found.n && there->complete && status == QDOT_OK; k++) {
        qdot_text_add(&text, k == 0 ? ": " : ", ");
        if (qdot_expr_count(q->pool, there->found.at[k].values) == 0)
            qdot_text_add(&text, "all values are solutions");
        else
            status = qdot_print(q->pool, there->found.at[k].values, QDOT_PLAIN, &text);
        if (status == QDOT_OK)
            status = qdot_solve_print_conditions(q->pool, " when ", there->found.at[k].conditions, &text);
    }
    return qdot_answer_notice_text(q->session, status, &text);
}

static qdot_status solve_specials(const question *q, const qdot_simultaneous *set, qdot_expr where, size_t *told);

/* Solve at parameter values at which a divisor in the general solution vanishes. */
static qdot_status
solve_special(const question *q, qdot_expr where, const qdot_simultaneous *generic, size_t *told)
{
    qdot_simultaneous there = {0};
    qdot_expr f[MOST], domain, from[QDOT_SPECIAL_TOGETHER], to[QDOT_SPECIAL_TOGETHER];
    size_t n = qdot_special_sides(q->pool, where, from, to);
    qdot_status status;

    for (size_t i = 0; i < q->n; i++)
        f[i] = qdot_subs(q->pool, q->f[i], n, from, to);
    status = qdot_pool_check(q->pool);
    if (status == QDOT_EDOMAIN) /* the equations are undefined at these parameter values */
        return QDOT_OK;
    QDOT_TRY(status);
    domain = qdot_conditions_at(q->pool, q->domain, n, from, to, &q->facts);
    QDOT_TRY(qdot_pool_check(q->pool));
    if (domain == QDOT_FALSE)
        return QDOT_OK;
    status = qdot_simultaneous_all(q->pool, q->n, f, q->u, domain, &q->facts, &there);
    if (status == QDOT_OK)
        status = add_domain_conditions(q, &there);
    if (status == QDOT_OK)
        status = give_notice_of_special(q, where, &there, generic);
    if (status == QDOT_OK && there.complete)
        status = solve_specials(q, &there, where, told);
    qdot_simultaneous_clear(&there);
    return status;
}

/* Tell the solutions at special values, those of a set at `where` (nil: at all values); of those past the bound, and of
 * divisors that are not solved, that the solutions there may be others. */
static qdot_status
solve_specials(const question *q, const qdot_simultaneous *set, qdot_expr where, size_t *told)
{
    qdot_special_values values = {0};
    qdot_status status = qdot_special_values_add(q->pool, set->special.n, set->special.at, where,
                                                 &q->facts, &values);

    for (size_t i = 0; i < values.at.n && status == QDOT_OK; i++)
        status = (*told)++ < MOST_SPECIALS ? solve_special(q, values.at.at[i], set, told)
                                           : qdot_solve_notice_open(q->session, values.at.at[i]);
    for (size_t i = 0; i < values.open.n && status == QDOT_OK; i++)
        status = qdot_solve_notice_open(q->session, qdot_list(q->pool, 1, &values.open.at[i]));
    qdot_special_values_clear(&values);
    return status;
}

/* --- the answer of solve -------------------------------------------------------------------------------- */

/* Notice `y may have any value of its domain in [x = y]`, for an unknown absent from the solution
 * and its conditions. */
static qdot_status
give_notice_of_free_unknowns(const question *q, const qdot_simultaneous_solution *one)
{
    qdot_expr values = one->values;
    qdot_text text = {0};
    size_t free = 0;
    qdot_status status = QDOT_OK;

    for (size_t j = 0; j < q->n && status == QDOT_OK; j++) {
        bool determined = false;

        for (uint32_t i = 0; i < qdot_expr_count(q->pool, values) && !determined; i++)
            determined = qdot_expr_arg(q->pool, qdot_expr_arg(q->pool, values, i), 0) == q->u[j];
        if (determined ||
            (one->conditions != QDOT_NIL && qdot_expr_contains(q->pool, one->conditions, q->u[j])))
            continue;
        qdot_text_add(&text, free++ == 0 ? "" : " and ");
        status = qdot_print(q->pool, q->u[j], QDOT_PLAIN, &text);
    }
    if (free == 0)
        return status;
    qdot_text_format(&text, " may have any value of %s in ", free == 1 ? "its domain" : "their domains");
    if (status == QDOT_OK)
        status = qdot_print(q->pool, values, QDOT_PLAIN, &text);
    return qdot_answer_condition_text(q->session, status, &text);
}

static qdot_status
give_notice_of_periodicity(const question *q)
{
    return qdot_answer_condition(q->session, "these are the solutions of one turn: within the declared domains each "
                                             "recurs after every whole turn");
}

static qdot_status
answer_exactly(const question *q, const qdot_simultaneous *set, qdot_expr *value)
{
    size_t told = 0;
    qdot_status status = solve_specials(q, set, QDOT_NIL, &told);

    *value = qdot_list(q->pool, 0, NULL);
    for (size_t k = 0; k < set->found.n && status == QDOT_OK; k++) {
        const qdot_simultaneous_solution *one = &set->found.at[k];

        if (qdot_expr_count(q->pool, one->values) == 0)
            status = qdot_fail(QDOT_EDOMAIN, "the equations hold for all values%s",
                               one->conditions == QDOT_NIL ? "" : " at which they are defined");
        if (status == QDOT_OK)
            status = give_notice_of_free_unknowns(q, one);
        if (status == QDOT_OK)
            status = qdot_solve_notice_conditions(q->session, one->values, one->conditions);
        *value = qdot_list_appended(q->pool, *value, 1, &one->values);
    }
    if (status == QDOT_OK && set->recurs && set->found.n > 0)
        status = give_notice_of_periodicity(q);
    return status == QDOT_OK ? qdot_pool_check(q->pool) : status;
}

/* The exact solution that agrees with a numerical zero within its error; nil if there is none. */
static qdot_expr
exact_solution_near(const question *q, const qdot_simultaneous *set, const double *at, const double *radius)
{
    for (size_t k = 0; k < set->found.n; k++) {
        qdot_expr values = set->found.at[k].values;
        bool same = qdot_expr_count(q->pool, values) == q->n;

        for (uint32_t j = 0; j < q->n && same; j++) {
            double x;

            same = qdot_ball_double(q->pool, qdot_expr_arg(q->pool, qdot_expr_arg(q->pool, values, j), 1),
                                    NULL, NULL, &x) &&
                   fabs(x - at[j]) <= 4 * radius[j] + 1e-15 * fabs(x);
        }
        if (same)
            return values;
    }
    return QDOT_NIL;
}

/* Solve numerically, if it is proved that all zeros are found; else set *known to false. */
static qdot_status
solve_numerically(const question *q, const qdot_simultaneous *set, qdot_expr *value, bool *known)
{
    qdot_pool *pool = q->pool;
    qdot_expr list = QDOT_NIL, all = qdot_list(pool, (uint32_t)q->n, q->f), domain = q->domain;
    qdot_window window[MOST];
    double *at = NULL;
    size_t count = 0, exact = 0;
    bool recurs = false;
    qdot_status status;

    for (size_t i = 0; i < q->n; i++)
        domain = qdot_conditions_all(pool, domain, qdot_conditions_of_domain(pool, q->f[i], QDOT_NIL));
    for (size_t j = 0; j < q->n; j++) {
        window[j] = qdot_solve_window(pool, q->u[j], qdot_is_angle(pool, all, q->u[j], &q->facts));
        recurs = recurs || window[j].recurs;
    }
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_solve_box(q->session, q->n, q->f, q->u, domain, window, &list, &at, &count, known);
    *value = qdot_list(pool, 0, NULL);
    for (uint32_t k = 0; status == QDOT_OK && *known && k < qdot_expr_count(pool, list); k++) {
        qdot_expr one = exact_solution_near(q, set, at + k * q->n, at + (count + k) * q->n);

        exact += one != QDOT_NIL;
        one = one != QDOT_NIL ? one : qdot_expr_arg(pool, list, k);
        *value = qdot_list_appended(pool, *value, 1, &one);
    }
    qdot_free(at);
    if (status == QDOT_OK && *known && (exact < count || count == 0))
        status = qdot_answer_notice(q->session, "no formula gives %s: found in numbers, proved to be all",
                                    count == exact + 1 ? "this solution" : "these solutions");
    if (status == QDOT_OK && *known && recurs && count > 0)
        status = give_notice_of_periodicity(q);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

qdot_status
qdot_solve_system(qdot_session *session, qdot_expr equations, qdot_expr unknowns, qdot_expr domain,
                  qdot_expr *value)
{
    question q = {.session = session, .pool = session->pool};
    const qdot_facts scene = qdot_scene_facts(session->scene);
    qdot_assumptions assumed = {0};
    qdot_simultaneous set = {0};
    qdot_status status;
    bool known = true;

    QDOT_TRY(qdot_pool_check(q.pool));
    QDOT_TRY(read_question(&q, equations, unknowns));
    status = qdot_assumptions_read(q.pool, &scene, unknowns, &assumed);
    for (size_t i = 0; i < q.n; i++)
        q.f[i] = qdot_assumptions_put(q.pool, &assumed, q.f[i]);
    q.domain = qdot_conditions_all(q.pool, qdot_assumptions_put(q.pool, &assumed, domain), assumed.domain);
    q.facts = assumed.facts;
    q.facts.exact = true;
    if (status == QDOT_OK)
        status = qdot_pool_check(q.pool);
    if (status == QDOT_OK)
        status = qdot_simultaneous_all(q.pool, q.n, q.f, q.u, q.domain, &q.facts, &set);
    if (status == QDOT_OK)
        status = add_domain_conditions(&q, &set);
    if (status == QDOT_OK && set.complete)
        status = answer_exactly(&q, &set, value);
    else if (status == QDOT_OK)
        status = solve_numerically(&q, &set, value, &known);
    if (status == QDOT_OK && known)
        status = qdot_solve_notice_powers(session, q.n, q.f, q.n, q.u, false, &q.facts);
    if (status == QDOT_OK && !known) {
        (void)qdot_fail(QDOT_EFAILED, "these equations cannot be solved exactly%s",
                        set.found.n > 0 ? " for all their solutions" : "");
        status = qdot_hint("in numbers, from a guess: solve([...], [x = 1, y = 2])");
    }
    qdot_simultaneous_clear(&set);
    qdot_assumptions_clear(&assumed);
    return status;
}

/* --- solutions near a guess ----------------------------------------------------------------------------------------- */

qdot_status
qdot_solve_system_near(qdot_session *session, qdot_expr equations, qdot_expr guesses,
                       qdot_expr domain, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    uint32_t n = qdot_expr_count(pool, guesses);
    qdot_expr f[MOST], u[MOST];

    if (qdot_expr_kind(pool, equations) != QDOT_LIST ||
        qdot_expr_count(pool, equations) != n) {
        (void)qdot_fail(QDOT_ETYPE, "solve takes as many equations as unknowns");
        return qdot_hint("as in solve([x + y = 3, x*y = 2], [x = 1, y = 1])");
    }
    if (n > MOST)
        return qdot_fail(QDOT_ELIMIT, "solve takes up to %d unknowns", MOST);
    for (uint32_t i = 0; i < n; i++) {
        f[i] = qdot_expr_arg(pool, equations, i);
        u[i] = qdot_expr_arg(pool, guesses, i);
    }
    return qdot_solve_near(session, n, f, u, domain, true, value);
}
