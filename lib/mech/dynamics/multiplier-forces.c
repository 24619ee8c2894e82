/* multiplier-forces.c -- solves for the multipliers that forces hold. */
#include "mech/dynamics/multiplier-forces.h"

#include <stdio.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "normal/solve/linear.h"

enum { MOST = 16 }; /* multipliers in forces */

/* The multipliers that forces hold. */
typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    size_t n;
    size_t of[MOST];           /* index of its constraint */
    qdot_expr symbol[2 * MOST]; /* symbols for lambda_k [n], then for |lambda_k| [n], while they are unknown */
    qdot_expr name[2 * MOST];   /* lambda_k [n], |lambda_k| [n], as forces hold them: absolute values first in `from` */
    qdot_expr L[MOST];          /* what constraint k needs, in these symbols */
    qdot_expr value[2 * MOST];  /* lambda_k [n], |lambda_k| [n], once solved for */
    bool solved[MOST];
    bool bound; /* a value is undefined where the solution is not the only one */
} friction;

static bool
holds_multiplier(const qdot_scene *s, qdot_expr e)
{
    return e != QDOT_NIL && (qdot_mech_holds(s, e) & QDOT_HAS_MULTIPLIER) != 0;
}

/* e with lambda_k and |lambda_k| replaced by `to` [2 n]. */
static qdot_expr
replace(const friction *f, qdot_expr e, const qdot_expr *to)
{
    e = qdot_subs(f->pool, e, f->n, f->name + f->n, to + f->n); /* first the absolute values, which hold the others */
    return qdot_subs(f->pool, e, f->n, f->name, to);
}

/* List the multipliers that forces, torques and dissipation hold. */
static qdot_status
find_held_multipliers(friction *f)
{
    const qdot_scene *s = f->s;

    for (size_t k = 0; k < s->constraints.n; k++) {
        const qdot_expr lambda = s->constraints.at[k].multiplier;
        bool held = false;
        char text[2][40];

        for (size_t i = 0; i < s->forces.n; i++)
            held = held || qdot_expr_contains(f->pool, s->forces.at[i].force, lambda);
        for (size_t i = 0; i < s->torques.n; i++)
            held = held || qdot_expr_contains(f->pool, s->torques.at[i].torque, lambda);
        for (size_t i = 0; i < s->dissipations.n; i++)
            held = held || qdot_expr_contains(f->pool, s->dissipations.at[i].e, lambda);
        if (!held)
            continue;
        if (f->n == MOST)
            return qdot_fail(QDOT_ELIMIT, "forces hold more than %d multipliers", MOST);
        snprintf(text[0], sizeof text[0], "(%zu)", k + 1);
        snprintf(text[1], sizeof text[1], "|%zu|", k + 1);
        f->symbol[f->n] = qdot_symbol_get(f->pool, QDOT_FORMAL, text[0]);
        f->symbol[MOST + f->n] = qdot_symbol_get(f->pool, QDOT_FORMAL, text[1]);
        f->name[f->n] = lambda;
        f->name[MOST + f->n] = qdot_fun1(f->pool, QDOT_ABS, lambda);
        f->of[f->n++] = k;
    }
    for (size_t k = 0; k < f->n; k++) { /* the second halves behind the first */
        f->symbol[f->n + k] = f->symbol[MOST + k];
        f->name[f->n + k] = f->name[MOST + k];
    }
    return qdot_pool_check(f->pool);
}

/* The scene with symbols for the multipliers in its forces: these are then forces like others. */
static qdot_status
make_scene_of_symbols(const friction *f, qdot_scene **out)
{
    const qdot_scene *s = f->s;
    qdot_scene *to = qdot_scene_new(f->pool);

    *out = to;
    if (!to)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < s->coordinates.n; i++)
        QDOT_TRY(qdot_vec_push(&to->coordinates, s->coordinates.at[i]));
    QDOT_TRY(qdot_scene_copy_things(s, to));
    for (size_t i = 0; i < to->forces.n; i++)
        to->forces.at[i].force = replace(f, to->forces.at[i].force, f->symbol);
    for (size_t i = 0; i < to->torques.n; i++)
        to->torques.at[i].torque = replace(f, to->torques.at[i].torque, f->symbol);
    for (size_t i = 0; i < to->dissipations.n; i++)
        to->dissipations.at[i].e = replace(f, to->dissipations.at[i].e, f->symbol);
    for (size_t i = 0; i < s->constraints.n; i++)
        QDOT_TRY(qdot_vec_push(&to->constraints, s->constraints.at[i]));
    for (size_t i = 0; i < s->conditions.n; i++)
        QDOT_TRY(qdot_vec_push(&to->conditions, s->conditions.at[i]));
    for (size_t i = 0; i < s->relations.n; i++)
        QDOT_TRY(qdot_vec_push(&to->relations, s->relations.at[i]));
    for (size_t i = 0; i < s->inputs.n; i++)
        QDOT_TRY(qdot_vec_push(&to->inputs, s->inputs.at[i]));
    qdot_scene_changed(to);
    return qdot_pool_check(f->pool);
}

/* L_k in these symbols, of which it must be linear. */
static qdot_status
find_needs(friction *f)
{
    qdot_scene *of_symbols = NULL;
    qdot_status status = make_scene_of_symbols(f, &of_symbols);

    for (size_t k = 0; k < f->n && status == QDOT_OK; k++) {
        f->L[k] = qdot_mech_multiplier(of_symbols, f->of[k]);
        status = qdot_pool_check(f->pool);
        if (status == QDOT_OK && f->L[k] == QDOT_NIL)
            status = qdot_fail(QDOT_EINVAL, "lambda[%.200s], which a force holds, is not determined: constraints repeat each other",
                               f->s->constraints.at[f->of[k]].name);
        for (size_t j = 0; j < 2 * f->n && status == QDOT_OK; j++) {
            const qdot_expr slope = qdot_diff(f->pool, f->L[k], f->symbol[j]);

            for (size_t i = 0; i < 2 * f->n; i++)
                if (slope != QDOT_NIL && qdot_expr_contains(f->pool, slope, f->symbol[i]))
                    status = qdot_fail(QDOT_ENOTBUILT, "not built yet: a force that is not linear in lambda[%.200s] and its absolute value",
                                       f->s->constraints.at[f->of[j % f->n]].name);
        }
    }
    qdot_scene_free(of_symbols);
    return status;
}

/* dL_k/d symbol j, simplified. */
static qdot_expr
slope(const friction *f, size_t k, size_t j)
{
    return qdot_mech_tidy(f->s, qdot_diff(f->pool, f->L[k], f->symbol[j]));
}

/* Whether constraint k depends on no friction but its own and that of constraints that are solved. */
static bool
can_be_solved(const friction *f, size_t k)
{
    bool can = !f->solved[k];

    for (size_t j = 0; j < f->n && can; j++)
        can = j == k || f->solved[j] || (slope(f, k, j) == QDOT_ZERO && slope(f, k, f->n + j) == QDOT_ZERO);
    return can;
}

/* |h|, or its negative, for its square: h without its sign(u) where h has one sign(u) as a factor and no other; else h, whose
 * magnitude differs with the signs (h = a sign(u) + b sign(v)). */
static qdot_expr
magnitude(const friction *f, qdot_expr h)
{
    qdot_expr side = QDOT_NIL;
    size_t sides = 0;
    qdot_walk walk;

    if (qdot_walk_begin(f->pool, h, &walk) != QDOT_OK)
        return qdot_pool_fail(f->pool);
    for (size_t i = 0; i < walk.n; i++)
        if (qdot_expr_is_function(f->pool, walk.at[i], QDOT_SIGN)) {
            side = walk.at[i];
            sides++;
        }
    qdot_walk_end(&walk);
    if (sides == 1) {
        const qdot_expr plus = qdot_subs(f->pool, h, 1, &side, &(qdot_expr){QDOT_ONE}),
                        minus = qdot_subs(f->pool, h, 1, &side, &(qdot_expr){QDOT_MINUS_ONE});

        if (qdot_mech_tidy(f->s, qdot_add(f->pool, plus, minus)) == QDOT_ZERO)
            return plus;
    }
    return h;
}

/* What constraint k needs while the multipliers that are unknown are 0. */
static qdot_expr
known_need(const friction *f, size_t k)
{
    qdot_expr to[2 * MOST];

    for (size_t j = 0; j < 2 * f->n; j++)
        to[j] = f->solved[j % f->n] ? f->value[j] : QDOT_ZERO;
    return qdot_subs(f->pool, f->L[k], 2 * f->n, f->symbol, to);
}

/* 1 where e > 0, else undefined. */
static qdot_expr
where_positive(const friction *f, qdot_expr e)
{
    return qdot_sqrt(f->pool, qdot_fun1(f->pool, QDOT_SIGN, qdot_mech_tidy(f->s, e)));
}

/* Solve for constraint k, which depends on no other that is unknown. */
static void
solve_alone(friction *f, size_t k)
{
    qdot_pool *pool = f->pool;
    const qdot_expr D = qdot_sub(pool, QDOT_ONE, slope(f, k, k)),
                    h = qdot_mech_tidy(f->s, qdot_div(pool, slope(f, k, f->n + k), D)),
                    l = qdot_mech_tidy(f->s, qdot_div(pool, known_need(f, k), D));
    qdot_expr by = QDOT_ONE;

    if (h != QDOT_ZERO) {
        const qdot_expr m = magnitude(f, h), side = qdot_fun1(pool, QDOT_SIGN, l);

        by = qdot_div(pool, where_positive(f, qdot_sub(pool, QDOT_ONE, qdot_mul(pool, m, m))),
                      qdot_sub(pool, QDOT_ONE, qdot_mul(pool, h, side)));
        f->bound = true;
    }
    f->value[k] = qdot_mul(pool, l, by);
    f->value[f->n + k] = qdot_mul(pool, qdot_fun1(pool, QDOT_ABS, l), by);
    f->solved[k] = true;
}

/* The linear equations of a pair for the signs of their multipliers, [i] negative where bit i of `signs` is set: the
 * solution x [2] and the determinant. */
static qdot_status
solve_for_signs(const friction *f, const size_t *k, unsigned signs, qdot_expr *x, qdot_expr *det)
{
    qdot_pool *pool = f->pool;
    const qdot_facts facts = qdot_scene_facts(f->s);
    qdot_expr A[4], b[2];
    uint32_t pivot;

    for (size_t i = 0; i < 2; i++) {
        b[i] = known_need(f, k[i]);
        for (size_t j = 0; j < 2; j++) {
            const qdot_expr G = slope(f, k[i], k[j]), H = slope(f, k[i], f->n + k[j]);
            const qdot_expr both = signs >> j & 1 ? qdot_sub(pool, G, H) : qdot_add(pool, G, H);

            A[2 * i + j] = qdot_mech_tidy(f->s, qdot_sub(pool, i == j ? QDOT_ONE : QDOT_ZERO, both));
        }
    }
    *det = qdot_sub(pool, qdot_mul(pool, A[0], A[3]), qdot_mul(pool, A[1], A[2]));
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_solve_linear(pool, 2, A, b, x, &pivot, &facts);
}

/* Solve for two constraints whose frictions act on each other. The solution is the only one, whatever they need, if the
 * determinants for all signs are positive (Rohn, Linear Algebra Appl. 126 (1989) 39). */
static qdot_status
solve_pair(friction *f, const size_t *k)
{
    qdot_pool *pool = f->pool;
    qdot_expr by = QDOT_ONE, value[4] = {0}; /* of both multipliers, then of both magnitudes */

    for (unsigned signs = 4; signs-- > 0;) {
        qdot_expr x[2], det, is[2], own[4];

        QDOT_TRY(solve_for_signs(f, k, signs, x, &det));
        by = qdot_mul(pool, by, where_positive(f, det));
        for (size_t i = 0; i < 2; i++) {
            const bool negative = signs >> i & 1;

            is[i] = negative ? qdot_rel(pool, QDOT_LE, x[i], QDOT_ZERO) : qdot_rel(pool, QDOT_LE, QDOT_ZERO, x[i]);
            own[i] = x[i];
            own[2 + i] = negative ? qdot_neg(pool, x[i]) : x[i];
        }
        for (size_t i = 0; i < 4; i++)
            value[i] = signs == 3 ? own[i]
                                  : qdot_fun(pool, QDOT_IF, 3,
                                             (qdot_expr[]){qdot_logic(pool, QDOT_AND, 2, is), own[i], value[i]});
    }
    for (size_t i = 0; i < 2; i++) {
        f->value[k[i]] = qdot_mul(pool, value[i], by);
        f->value[f->n + k[i]] = qdot_mul(pool, value[2 + i], by);
        f->solved[k[i]] = true;
    }
    f->bound = true;
    return qdot_pool_check(pool);
}

/* Solve for the next constraint, or for the two that are left. */
static qdot_status
solve_next(friction *f)
{
    size_t k = 0, left[2], n = 0;

    while (k < f->n && !can_be_solved(f, k))
        k++;
    if (k < f->n) {
        solve_alone(f, k);
        return qdot_pool_check(f->pool);
    }
    for (size_t j = 0; j < f->n; j++)
        if (!f->solved[j] && n++ < 2)
            left[n - 1] = j;
    if (n > 2)
        return qdot_fail(QDOT_ENOTBUILT,
                         "not built yet: friction of more than two constraints that act on each other's, of lambda[%.200s] and others",
                         f->s->constraints.at[f->of[left[0]]].name);
    return n > 0 ? solve_pair(f, left) : QDOT_OK;
}

static qdot_status
solve_all(friction *f)
{
    for (size_t k = 0; k < f->n; k++)
        QDOT_TRY(solve_next(f));
    return qdot_pool_check(f->pool);
}

bool
qdot_multipliers_are_bound(qdot_scene *s)
{
    return qdot_derived_get(s)->friction_bound;
}

qdot_expr
qdot_without_multipliers(qdot_scene *s, qdot_expr e)
{
    qdot_derived *d;
    friction f = {.s = s, .pool = s->pool};

    if (!holds_multiplier(s, e))
        return e;
    if (s->hamiltonian != QDOT_NIL && s->lagrangian == QDOT_NIL)
        return qdot_mech_fail(s, QDOT_ENOTBUILT, "not built yet: forces that hold multipliers beside an H from which no Lagrangian follows");
    if (find_held_multipliers(&f) != QDOT_OK)
        return qdot_pool_fail(s->pool);
    d = qdot_derived_get(s);
    if (!d->friction) {
        if (find_needs(&f) != QDOT_OK || solve_all(&f) != QDOT_OK
            || !qdot_derived_array(s, &d->friction, 2 * f.n))
            return qdot_pool_fail(s->pool);
        for (size_t i = 0; i < 2 * f.n; i++)
            d->friction[i] = f.value[i];
        d->friction_bound = f.bound;
    }
    e = replace(&f, e, d->friction);
    return holds_multiplier(s, e) ? qdot_mech_fail(s, QDOT_EINVAL, "a force holds the multiplier of a constraint that there is no more") : e;
}
