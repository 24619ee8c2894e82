/* solver.c -- factors an equation and solves each factor by the functions of x in it. */
#include "normal/solve/solver.h"

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "expr/symbol.h"
#include "expr/elementary.h"
#include "normal/field/prepare.h"
#include "normal/inequality/less.h"
#include "normal/prove/decide.h"
#include "normal/refute/sample.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/sides.h"

enum { WORK = 2000000, MOST_DEPTH = 8, POINTS = 30 };

qdot_expr
qdot_solver_tidy(const qdot_solver *s, qdot_expr e)
{
    return qdot_simplify(s->pool, e, s->facts);
}

qdot_expr
qdot_solver_positive(const qdot_solver *s, qdot_expr gap)
{
    bool strict = gap != QDOT_NIL && qdot_is_taken_generic(s->pool, gap, s->facts) &&
                  !qdot_expr_is_constant(s->pool, gap);

    return gap == QDOT_NIL ? QDOT_NIL : qdot_condition(s->pool, gap, strict, s->facts);
}

static bool
list_contains(size_t n, const qdot_expr *list, qdot_expr e)
{
    return qdot_expr_place(n, list, e) < n;
}

qdot_status
qdot_solver_divide(qdot_solver *s, qdot_expr d)
{
    if (d == QDOT_NIL)
        return qdot_pool_check(s->pool);
    if ((qdot_expr_node(s->pool, d)->sign & QDOT_NE0) != 0)
        return QDOT_OK;
    if (qdot_is_generic(s->pool, d))
        return list_contains(s->out->special.n, s->out->special.at, d)
                   ? QDOT_OK
                   : qdot_vec_push(&s->out->special, d);
    return list_contains(s->out->divisor.n, s->out->divisor.at, d)
               ? QDOT_OK
               : qdot_vec_push(&s->out->divisor, d);
}

/* --- roots and whether they satisfy the equation ----------------------------------- */

/* Whether e is 0 at some points of the parameters' domains, as far as can be seen. */
static qdot_status
vanishes_somewhere(const qdot_solver *s, qdot_expr e, const qdot_facts *facts, bool *yes)
{
    qdot_sample sample;

    *yes = false;
    QDOT_TRY(qdot_sample_begin(&sample, s->pool, 1, &e, facts));
    for (int k = 0; sample.possible && k < POINTS && !*yes; k++) {
        arb_srcptr v;

        qdot_sample_point(&sample, k);
        *yes = qdot_sample_eval(&sample, 96) &&
               (v = qdot_ball_get(&sample.ball, e)) != NULL && arb_contains_zero(v);
    }
    qdot_sample_end(&sample);
    return qdot_pool_check(s->pool);
}

/* Take note that f has no value at a place, with what it does not choose there: if(...) may choose otherwise for some
 * parameters. */
static qdot_status
note_possible_branches(qdot_solver *s)
{
    if (qdot_expr_find_function(s->pool, s->f, 1, (qdot_fun_id[]){QDOT_IF}, QDOT_NIL) != QDOT_NIL)
        s->out->complete = false;
    return qdot_pool_check(s->pool);
}

/* Whether f is 0 and defined at x = value: refuted ones are not. Where it is 0 for some
 * parameters only, no condition says for which: then these are not all. */
static qdot_status
decide_is_root(qdot_solver *s, qdot_expr value, const qdot_facts *facts, bool *yes)
{
    qdot_expr at = qdot_subs(s->pool, s->f, 1, &s->x, &value);
    qdot_decision d;
    bool sometimes;

    *yes = false;
    if (at == QDOT_NIL) { /* the value is not defined */
        qdot_status status = qdot_pool_check(s->pool);

        return status == QDOT_EDOMAIN ? note_possible_branches(s) : status;
    }
    QDOT_TRY(qdot_decide_equal(s->pool, at, QDOT_ZERO, facts, &d));
    *yes = d.verdict != QDOT_REFUTED;
    if (*yes)
        return QDOT_OK;
    QDOT_TRY(vanishes_somewhere(s, at, facts, &sometimes));
    s->out->complete = s->out->complete && !sometimes;
    return QDOT_OK;
}

bool
qdot_solver_is_member(const qdot_solver *s, const qdot_root *family, qdot_expr value)
{
    qdot_pool *pool = s->pool;
    qdot_expr periods = qdot_solver_tidy(
        s, qdot_div(pool, qdot_sub(pool, value, family->value), family->period));
    const fmpq *number = periods == QDOT_NIL ? NULL : qdot_expr_rational(pool, periods);

    return number != NULL && fmpz_is_one(fmpq_denref(number));
}

/* Whether two values are the same root; for families with the same period: differ by a multiple of it. */
static bool
is_same_root(const qdot_solver *s, const qdot_root *a, qdot_expr value, qdot_expr period)
{
    qdot_expr apart;

    if (a->period != period)
        return false;
    if (a->value == value || period != QDOT_NIL)
        return a->value == value || qdot_solver_is_member(s, a, value);
    apart = qdot_sub(s->pool, a->value, value);
    return apart != QDOT_NIL && qdot_is_zero(s->pool, apart, s->facts);
}

/* Those conditions that are the same for all members of a family; *each gets the others, which contain x. */
static qdot_expr
split_off_member_conditions(const qdot_solver *s, qdot_expr when, qdot_expr period, qdot_expr *each)
{
    qdot_pool *pool = s->pool;
    uint32_t n = when == QDOT_NIL ? 0 : qdot_expr_count(pool, when);
    qdot_expr all = QDOT_NIL;

    *each = QDOT_NIL;
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr one = qdot_expr_arg(pool, when, i),
                  gap = qdot_sub(pool, qdot_expr_arg(pool, one, 1), qdot_expr_arg(pool, one, 0));

        if (qdot_is_period(pool, gap, s->x, period, s->facts))
            all = qdot_conditions_and(pool, all, one);
        else
            *each = qdot_conditions_and(pool, *each, one);
    }
    return all;
}

/* Where f divides by 0 at the value of a family, but not at all of its members, as sin(x)/x does at 0 of n pi: *each, the
 * conditions that tell these apart; else nil. */
static qdot_status
find_conditions_of_poles(const qdot_solver *s, qdot_expr value, qdot_expr period, qdot_expr *each)
{
    qdot_expr at = qdot_subs(s->pool, s->f, 1, &s->x, &value), all;
    qdot_status status = qdot_pool_check(s->pool);

    *each = QDOT_NIL;
    if (at != QDOT_NIL || status != QDOT_EDOMAIN)
        return status;
    all = split_off_member_conditions(s, qdot_conditions_of_divisors(s->pool, s->f, s->x), period, each);
    if (*each != QDOT_NIL && qdot_conditions_at(s->pool, all, 1, &s->x, &value, s->facts) == QDOT_FALSE)
        *each = QDOT_NIL;
    return qdot_pool_check(s->pool);
}

qdot_status
qdot_solver_add(qdot_solver *s, qdot_expr value, qdot_expr period, qdot_expr when)
{
    qdot_root root = {qdot_solver_tidy(s, value), QDOT_NIL, period, QDOT_NIL};
    qdot_expr room[QDOT_CONDITIONS_MOST];
    qdot_status status = qdot_pool_check(s->pool);
    qdot_facts facts;
    bool yes, lifted = false;

    if (status == QDOT_EDOMAIN || when == QDOT_FALSE) /* the value is undefined for all parameters */
        return QDOT_OK;
    QDOT_TRY(status);
    if (period != QDOT_NIL)
        when = split_off_member_conditions(s, when, period, &root.members);
    root.condition = qdot_conditions_at(s->pool, when, 1, &s->x, &root.value, s->facts);
    QDOT_TRY(qdot_pool_check(s->pool));
    if (root.condition != QDOT_NIL)
        QDOT_TRY(qdot_written_lifts(s->pool, &s->written, s->f, s->x, root.value, s->facts, &lifted));
    if (lifted) {
        QDOT_TRY(qdot_written_conditions(s->pool, &s->written, s->x, root.value, &when));
        root.condition = qdot_conditions_at(s->pool, when, 1, &s->x, &root.value, s->facts);
        QDOT_TRY(qdot_pool_check(s->pool));
    }
    if (root.condition == QDOT_FALSE)
        return QDOT_OK;
    for (size_t i = 0; i < s->out->root.n; i++)
        if (s->out->root.at[i].members == root.members &&
            is_same_root(s, &s->out->root.at[i], root.value, period) &&
            qdot_conditions_join(s->pool, &s->out->root.at[i].condition, root.condition,
                                 s->facts))
            return qdot_pool_check(s->pool);
    if (period != QDOT_NIL && root.members == QDOT_NIL && !lifted)
        QDOT_TRY(find_conditions_of_poles(s, root.value, period, &root.members));
    if (root.members != QDOT_NIL || lifted) /* this member may be no root; or it has been proved to be one */
        return qdot_vec_push(&s->out->root, root);
    facts = qdot_facts_and(s->pool, s->facts, root.condition, room);
    QDOT_TRY(decide_is_root(s, root.value, &facts, &yes));
    return yes ? qdot_vec_push(&s->out->root, root) : QDOT_OK;
}

qdot_status
qdot_solver_add_where(qdot_solver *s, qdot_expr value, qdot_expr e, qdot_expr when)
{
    qdot_sides sides = {0};
    qdot_expr choice;
    qdot_status status;

    QDOT_TRY(qdot_pool_check(s->pool));
    if (when == QDOT_FALSE)
        return QDOT_OK;
    if (qdot_is_zero(s->pool, e, s->facts))
        return qdot_solver_add(s, value, QDOT_NIL, when);
    choice = qdot_sides_choice(s->pool, e, QDOT_NIL); /* a whole region: |a| - a = 0 for all a >= 0 */
    if (!qdot_is_generic(s->pool, e) || choice == QDOT_NIL)
        return qdot_solver_divide(s, e);
    status = qdot_sides_of(s->pool, e, choice, &sides);
    s->out->complete = s->out->complete && sides.n > 0;
    for (size_t i = 0; i < sides.n && status == QDOT_OK; i++)
        status = qdot_solver_add_where(s, value, qdot_sides_put(&sides, i, e),
                                       qdot_conditions_all(s->pool, when, sides.relations[i]));
    if (status == QDOT_OK && sides.jump != QDOT_NIL)
        status = qdot_solver_divide(s, sides.jump);
    qdot_sides_clear(&sides);
    return status;
}

/* --- one factor -------------------------------------------------------------------- */

/* The functions of x (generators) in one factor of an equation, and the factor as a polynomial in these. */
typedef struct {
    slong var[3];
    size_t n;
    int64_t degree[3];
    qdot_groups groups;
} shape;

static qdot_status
read_factor(qdot_solver *s, qdot_field *f, const fmpz_mpoly_t p, shape *out)
{
    bool *by = qdot_calloc((size_t)f->n + 1, sizeof *by);
    qdot_status status;

    *out = (shape){0};
    if (by == NULL)
        return QDOT_ENOMEM;
    for (slong v = 0; v < f->n; v++) {
        if (fmpz_mpoly_degree_si(p, v, f->ctx) == 0 ||
            !qdot_expr_contains(s->pool, f->gen[v].expr, s->x))
            continue;
        by[v] = true;
        if (out->n < 3) {
            out->var[out->n] = v;
            out->degree[out->n] = fmpz_mpoly_degree_si(p, v, f->ctx);
        }
        out->n++;
    }
    status = qdot_factor_group(f, &out->groups, p, by);
    qdot_free(by);
    return status;
}

/* The coefficient of var0^i (and of var1^j, if there are two variables) in the polynomial. */
static qdot_expr
coefficient(qdot_field *f, const shape *sh, ulong i, ulong j)
{
    for (slong k = 0; k < sh->groups.n; k++) {
        const ulong *key = sh->groups.key + k * f->n;

        if (key[sh->var[0]] == i && (sh->n < 2 || key[sh->var[1]] == j))
            return qdot_field_expr(f, sh->groups.poly + k);
    }
    return QDOT_ZERO;
}

/* The coefficient of var1^j in the polynomial, a sum over powers of var0, as an expression. */
static qdot_expr
coefficient_of_second_variable(qdot_field *f, const shape *sh, ulong j)
{
    qdot_pool *pool = f->pool;
    qdot_expr sum = QDOT_ZERO;

    for (int64_t i = 0; i <= sh->degree[0]; i++)
        sum = qdot_add(pool, sum,
                       qdot_mul(pool, coefficient(f, sh, (ulong)i, j),
                                qdot_pow_int(pool, f->gen[sh->var[0]].expr, i)));
    return sum;
}

static void
exchange_variables(shape *sh)
{
    slong var = sh->var[0];
    int64_t degree = sh->degree[0];

    sh->var[0] = sh->var[1];
    sh->degree[0] = sh->degree[1];
    sh->var[1] = var;
    sh->degree[1] = degree;
}

/* Solve an equation that is a polynomial in sin u and cos u with the same u. */
static qdot_status
solve_sine_and_cosine(qdot_solver *s, qdot_field *f, shape *sh, qdot_expr when)
{
    qdot_pool *pool = s->pool;
    qdot_expr u = f->gen[sh->var[0]].of, A, B, c;

    if (f->gen[sh->var[0]].kind == QDOT_GEN_SIN) /* exchange the variables, since var[0] must be the cosine */
        exchange_variables(sh);
    if (sh->degree[0] == 1 && sh->degree[1] == 1 && coefficient(f, sh, 1, 1) == QDOT_ZERO)
        return qdot_solver_mixed(s, u, coefficient(f, sh, 0, 1), coefficient(f, sh, 1, 0),
                                 coefficient(f, sh, 0, 0), when);
    if (sh->degree[1] != 1) {
        s->out->complete = false;
        return QDOT_OK;
    }
    if (sh->degree[0] == 2 && coefficient(f, sh, 0, 1) == QDOT_ZERO && coefficient(f, sh, 1, 0) == QDOT_ZERO &&
        coefficient(f, sh, 2, 1) == QDOT_ZERO) { /* A cos^2 u + B sin u cos u + C is linear in sin 2u, cos 2u */
        A = qdot_mul(pool, QDOT_HALF, coefficient(f, sh, 2, 0));
        B = qdot_mul(pool, QDOT_HALF, coefficient(f, sh, 1, 1));
        return qdot_solver_mixed(s, qdot_mul(pool, qdot_expr_int(pool, 2), u), B, A,
                                 qdot_add(pool, A, coefficient(f, sh, 0, 0)), when);
    }
    A = coefficient_of_second_variable(f, sh, 0);
    B = coefficient_of_second_variable(f, sh, 1);
    c = f->gen[sh->var[0]].expr;
    /* of the two angles with this cosine take that with the right sign of the sine, sin u = -A/B */
    when = qdot_conditions_and(
        pool, when,
        qdot_rel(pool, QDOT_LE, QDOT_ZERO,
                 qdot_neg(pool, qdot_product(pool, 3,
                                             (qdot_expr[]){A, B, qdot_fun1(pool, QDOT_SIN, u)}))));
    A = qdot_sub(pool, qdot_mul(pool, A, A),
                 qdot_mul(pool, qdot_mul(pool, B, B),
                          qdot_sub(pool, QDOT_ONE, qdot_mul(pool, c, c))));
    return qdot_solver_equation(s, A, when);
}

/* Solve an equation in sinh u and cosh u as a polynomial equation in E = exp u > 0. */
static qdot_status
solve_hyperbolic(qdot_solver *s, qdot_field *f, const fmpz_mpoly_t p, const shape *sh, qdot_expr when)
{
    qdot_pool *pool = s->pool;
    qdot_expr u = f->gen[sh->var[0]].of, E = qdot_symbol_get(pool, QDOT_FORMAL, "(exp u)"), e,
              from[2], to[2];
    qdot_solutions found = {.complete = true};
    qdot_solver inner = {.pool = pool, .x = E, .facts = s->facts, .out = &found,
                         .depth = s->depth};
    qdot_status status;

    qdot_symbol_domain(pool, E, QDOT_ZERO, true, QDOT_NIL, false);
    for (int i = 0; i < 2; i++) {
        qdot_expr one = qdot_div(pool, QDOT_ONE, E);

        from[i] = f->gen[sh->var[i]].expr;
        to[i] = f->gen[sh->var[i]].kind == QDOT_GEN_COSH ? qdot_add(pool, E, one)
                                                         : qdot_sub(pool, E, one);
        to[i] = qdot_mul(pool, QDOT_HALF, to[i]);
    }
    e = qdot_subs(pool, qdot_field_expr(f, p), 2, from, to);
    inner.f = e;
    status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = qdot_solver_equation(&inner, e, QDOT_NIL);
    for (size_t i = 0; i < found.root.n && status == QDOT_OK; i++)
        status = qdot_solver_equation(
            s, qdot_sub(pool, u, qdot_fun1(pool, QDOT_LOG, found.root.at[i].value)),
            qdot_conditions_and(
                pool, qdot_conditions_all(pool, when, found.root.at[i].condition),
                qdot_condition(pool, found.root.at[i].value, true, s->facts)));
    for (size_t i = 0; i < found.divisor.n && status == QDOT_OK; i++)
        status = qdot_solver_divide(s, found.divisor.at[i]);
    for (size_t i = 0; i < found.special.n && status == QDOT_OK; i++)
        status = qdot_solver_divide(s, found.special.at[i]);
    s->out->complete = s->out->complete && found.complete;
    qdot_solutions_clear(&found);
    return status;
}

/* Solve A + B r = 0, where r is a root of b, r^q = b: A^q = (-B)^q b, where r = -A/B must not be negative. */
static qdot_status
solve_equation_with_root(qdot_solver *s, qdot_field *f, shape *sh, qdot_expr when)
{
    qdot_pool *pool = s->pool;
    size_t at = f->gen[sh->var[0]].kind == QDOT_GEN_ROOT ? 1 : 0;
    const qdot_gen *root;
    qdot_expr A, B;

    if (at == 1) /* exchange the variables, since var[1] must be the root */
        exchange_variables(sh);
    root = &f->gen[sh->var[1]];
    if (root->kind != QDOT_GEN_ROOT || sh->degree[1] != 1) {
        s->out->complete = false;
        return QDOT_OK;
    }
    A = coefficient_of_second_variable(f, sh, 0);
    B = qdot_neg(pool, coefficient_of_second_variable(f, sh, 1));
    when = qdot_conditions_and(pool, when,
                               qdot_rel(pool, QDOT_LE, QDOT_ZERO, qdot_mul(pool, A, B)));
    A = qdot_sub(pool, qdot_pow_int(pool, A, root->order),
                 qdot_mul(pool, qdot_pow_int(pool, B, root->order), root->of));
    return qdot_solver_equation(s, A, when);
}

/* Solve g(x) = v for a function or root g (generator of the field), or x itself. */
static qdot_status
solve_generator_equals(qdot_solver *s, const qdot_gen *gen, qdot_expr v, qdot_expr when)
{
    qdot_pool *pool = s->pool;

    if (gen->expr == s->x)
        return qdot_solver_add(s, v, QDOT_NIL, when);
    if (gen->kind == QDOT_GEN_ROOT) {
        when = qdot_conditions_and(pool, when, qdot_condition(pool, v, false, s->facts));
        return qdot_solver_equation(
            s, qdot_sub(pool, gen->of, qdot_pow_int(pool, v, gen->order)), when);
    }
    if (qdot_expr_kind(pool, gen->expr) == QDOT_FUN && qdot_expr_count(pool, gen->expr) == 1)
        return qdot_solver_invert(s, gen->expr, v, when);
    s->out->complete = false;
    return QDOT_OK;
}

/* Solve an equation in one function g of x: find the values of g, then solve g(x) = value. */
static qdot_status
solve_in_one_generator(qdot_solver *s, qdot_field *f, const shape *sh, qdot_expr when)
{
    const qdot_gen gen = f->gen[sh->var[0]];
    qdot_expr *c = qdot_calloc((size_t)sh->degree[0] + 1, sizeof *c);
    qdot_arguments values = {0};
    qdot_status status = c == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (int64_t k = 0; k <= sh->degree[0] && status == QDOT_OK; k++)
        c[k] = coefficient(f, sh, (ulong)k, 0);
    if (status == QDOT_OK)
        status = qdot_solver_polynomial(s, c, sh->degree[0], when, &values);
    for (size_t i = 0; i < values.n && status == QDOT_OK; i++)
        if (values.at[i].when != QDOT_FALSE)
            status = solve_generator_equals(s, &gen, values.at[i].value, values.at[i].when);
    qdot_free(c);
    qdot_free(values.at);
    return status;
}

/* Whether the two functions are sine and cosine of the same argument, circular or hyperbolic. */
static bool
is_sine_cosine_pair(const qdot_field *f, const shape *sh, qdot_gen_kind sine, qdot_gen_kind cosine)
{
    const qdot_gen *a = &f->gen[sh->var[0]], *b = &f->gen[sh->var[1]];

    return a->kind != QDOT_GEN_ROOT && b->kind != QDOT_GEN_ROOT &&
           a->pair == (uint32_t)sh->var[1] && (a->kind == sine || a->kind == cosine);
}

/* Whether functions of x in p are exponentials, which join in products: exp(x - a) exp(x) is exp(2 x - a). */
static bool
contains_exponential(const qdot_field *f, const shape *sh)
{
    for (size_t i = 0; i < sh->n && i < 2; i++)
        if (qdot_expr_kind(f->pool, f->gen[sh->var[i]].expr) == QDOT_FUN &&
            qdot_expr_node(f->pool, f->gen[sh->var[i]].expr)->op == QDOT_EXP)
            return true;
    return false;
}

/* Solve one factor p of the numerator of the equation `whole`. */
static qdot_status
solve_one_factor(qdot_solver *s, qdot_field *f, const fmpz_mpoly_t p, qdot_expr whole, qdot_expr when)
{
    qdot_status status;
    qdot_expr e;
    shape sh;

    QDOT_TRY(qdot_interrupt_check());
    status = read_factor(s, f, p, &sh);
    if (status != QDOT_OK)
        ;
    else if (sh.n == 0) /* the factor does not contain x: where it is 0, every x is a root */
        status = qdot_solver_add_where(s, s->x, qdot_field_expr(f, p), when);
    else if (sh.n == 1)
        status = solve_in_one_generator(s, f, &sh, when);
    else if (contains_exponential(f, &sh) && (e = qdot_field_expr(f, p)) != whole)
        status = qdot_solver_equation(s, e, when);
    else if (sh.n > 2)
        s->out->complete = false;
    else if (is_sine_cosine_pair(f, &sh, QDOT_GEN_SIN, QDOT_GEN_COS))
        status = solve_sine_and_cosine(s, f, &sh, when);
    else if (is_sine_cosine_pair(f, &sh, QDOT_GEN_SINH, QDOT_GEN_COSH))
        status = solve_hyperbolic(s, f, p, &sh, when);
    else
        status = solve_equation_with_root(s, f, &sh, when);
    qdot_factor_ungroup(f, &sh.groups);
    return status;
}

/* Solve every factor of the numerator of e; if e is 0 identically, every x is a root. */
static qdot_status
solve_by_factors(qdot_solver *s, qdot_expr e, qdot_expr when)
{
    qdot_expr prepared = qdot_prepare(s->pool, e);
    qdot_factors factors;
    qdot_status status = qdot_pool_check(s->pool);
    qdot_field f;

    QDOT_TRY(status);
    qdot_field_begin(&f, s->pool, 1, &prepared, WORK);
    if (qdot_field_goes(&f)) {
        qdot_ratio r;

        qdot_field_cancelled(&f, &r, prepared);
        if (qdot_field_goes(&f) && fmpz_mpoly_is_zero(r.n, f.ctx)) {
            status = qdot_solver_add(s, s->x, QDOT_NIL, when);
        } else if (qdot_field_goes(&f)) {
            status = qdot_factor(&f, &factors, r.n);
            for (slong i = 0; i < factors.n && status == QDOT_OK; i++)
                status = solve_one_factor(s, &f, factors.poly + i, e, when);
            qdot_factor_clear(&f, &factors);
        }
        qdot_ratio_clear(&f, &r);
    }
    if (f.state == QDOT_FIELD_FAILED && status == QDOT_OK)
        status = f.status;
    if (!qdot_field_goes(&f))
        s->out->complete = false;
    qdot_field_end(&f);
    return status == QDOT_OK ? qdot_pool_check(s->pool) : status;
}

/* How many factors with x a product of their integer powers has, one whose denominators do not contain x; else 0.
 * *repeated: one of them has a power above 1. */
static uint32_t
count_factors_with_x(const qdot_solver *s, qdot_expr e, bool *repeated)
{
    uint32_t n = qdot_expr_kind(s->pool, e) == QDOT_PROD ? qdot_expr_count(s->pool, e) : 0, with = 0;

    *repeated = false;
    for (uint32_t i = 1; i + 1 < n; i += 2) {
        int64_t power;

        if (!qdot_expr_contains(s->pool, qdot_expr_arg(s->pool, e, i), s->x))
            continue;
        if (!qdot_expr_to_int(s->pool, qdot_expr_arg(s->pool, e, i + 1), &power) || power < 0)
            return *repeated = false;
        *repeated |= power > 1;
        with++;
    }
    return with;
}

/* Find the zeros of each factor of a product; factors with switches come last, so that they do not
 * affect the others. */
static qdot_status
solve_product(qdot_solver *s, qdot_expr e, qdot_expr when)
{
    qdot_expr rest = qdot_expr_arg(s->pool, e, 0);

    for (int choices = 0; choices < 2; choices++)
        for (uint32_t i = 1; i + 1 < qdot_expr_count(s->pool, e); i += 2) {
            qdot_expr base = qdot_expr_arg(s->pool, e, i);

            if ((qdot_sides_choice(s->pool, base, s->x) != QDOT_NIL) != (choices == 1))
                continue;
            if (qdot_expr_contains(s->pool, base, s->x))
                QDOT_TRY(qdot_solver_equation(s, base, when));
            else
                rest = qdot_mul(s->pool, rest, qdot_pow(s->pool, base, qdot_expr_arg(s->pool, e, i + 1)));
        }
    QDOT_TRY(qdot_pool_check(s->pool));
    return qdot_expr_is_constant(s->pool, rest) ? QDOT_OK : qdot_solver_add_where(s, s->x, rest, when);
}

qdot_status
qdot_solver_equation(qdot_solver *s, qdot_expr e, qdot_expr when)
{
    uint32_t factors;
    bool repeated, done;
    qdot_expr choice;
    qdot_status status = qdot_pool_check(s->pool);

    if (status == QDOT_EDOMAIN || when == QDOT_FALSE) /* the value is undefined for all parameters */
        return QDOT_OK;
    QDOT_TRY(status);
    if (s->depth >= MOST_DEPTH) {
        s->out->complete = false;
        return QDOT_OK;
    }
    s->depth++;
    status = qdot_solver_power(s, e, when, &done);
    if (status != QDOT_OK || done) {
        s->depth--;
        return status;
    }
    choice = qdot_sides_choice(s->pool, e, s->x);
    factors = count_factors_with_x(s, e, &repeated);
    /* leave a product with a power as it is: multiplied out it may not factor again */
    if (repeated || (choice != QDOT_NIL && factors > 1))
        status = solve_product(s, e, when);
    else
        status = choice == QDOT_NIL ? solve_by_factors(s, e, when) : qdot_solver_cases(s, e, choice, when);
    s->depth--;
    return status;
}
