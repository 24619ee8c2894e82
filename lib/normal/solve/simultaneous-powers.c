/* simultaneous-powers.c -- equations that are coupled by roots alone, and linear in these, are solved for the roots.
 *
 * Forces of two centres, -a (r - r1)/|r - r1|^3 - b (r - r2)/|r - r2|^3 beside others, are linear in A = 1/|r - r1|^3 and
 * B = 1/|r - r2|^3. Where Cramer's rule gives A and B without unknowns, each is an equation of one distance; the
 * determinant's zeros are a branch of their own. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/cramer.h"
#include "normal/solve/powers.h"
#include "normal/solve/simultaneous.h"

enum { MOST = QDOT_POWERS_MOST, MOST_EQUATIONS = 5, LARGEST = 200 };

/* The equations with symbols in place of their powers; those without powers apart. */
typedef struct {
    qdot_powers powers;
    qdot_expr with[MOST_EQUATIONS], others; /* [n]; a LIST */
    uint32_t n;
} power_system;

/* Read a LIST of equations; false: there are fewer than powers, too many, or a power stands within another one. */
static bool
read_system(const qdot_simultaneous *s, qdot_expr equations, power_system *out)
{
    qdot_pool *pool = s->pool;
    qdot_powers *p = &out->powers;
    bool apart = true;

    *out = (power_system){.powers = {.unknowns = s->unknowns.n, .unknown = s->unknowns.at},
                          .others = qdot_list(pool, 0, NULL)};
    for (uint32_t i = 0; i < qdot_expr_count(pool, equations); i++) {
        const qdot_expr one = qdot_expr_arg(pool, equations, i), with = qdot_powers_replace(pool, p, one);

        if (with == one)
            out->others = qdot_list_appended(pool, out->others, 1, &one);
        else if (out->n++ < MOST_EQUATIONS)
            out->with[out->n - 1] = with;
    }
    if (qdot_pool_failed(pool) || p->n < 2 || p->n > MOST || out->n < p->n || out->n > MOST_EQUATIONS)
        return false;
    for (uint32_t i = 0; i < p->n && apart; i++)
        apart = !qdot_expr_contains(pool, qdot_list(pool, p->n, p->power), p->symbol[i]);
    return apart;
}

/* Solve the equations whose bits are set in `which`, as many as powers, for the symbols of these: value [n]. *determinant:
 * nil where they are not linear or not coupled, and where a value contains unknowns. */
static qdot_status
solve_for_powers(const qdot_simultaneous *s, const power_system *system, unsigned which, qdot_expr *value,
                 qdot_expr *determinant)
{
    qdot_pool *pool = s->pool;
    const qdot_powers *p = &system->powers;
    qdot_expr A[MOST * MOST], b[MOST];
    uint32_t row = 0;
    bool coupled = false;

    *determinant = QDOT_NIL;
    for (uint32_t i = 0; i < system->n; i++) {
        uint32_t held = 0;

        if ((which >> i & 1) == 0)
            continue;
        if (!qdot_is_linear_in(pool, system->with[i], p->n, p->symbol, A + row * p->n, &b[row]))
            return qdot_pool_check(pool);
        for (uint32_t k = 0; k < p->n; k++)
            held += A[row * p->n + k] != QDOT_ZERO;
        b[row] = qdot_neg(pool, b[row]);
        coupled = coupled || held > 1;
        row++;
    }
    *determinant = coupled ? qdot_simplify(pool, qdot_cramer_determinant(pool, p->n, A), &s->facts) : QDOT_NIL;
    if (*determinant == QDOT_ZERO)
        *determinant = QDOT_NIL;
    if (*determinant == QDOT_NIL)
        return qdot_pool_check(pool);
    QDOT_TRY(qdot_cramer(pool, p->n, A, b, value));
    for (uint32_t i = 0; i < p->n; i++) {
        value[i] = qdot_simplify(pool, value[i], &s->facts);
        if (value[i] == QDOT_NIL || qdot_simultaneous_unknowns_in(s, value[i]) > 0)
            *determinant = QDOT_NIL;
    }
    return qdot_pool_check(pool);
}

/* Continue the branch with the values of the powers: an equation for each, and those equations that did not give them. */
static qdot_status
continue_with_powers(qdot_simultaneous *s, const qdot_simultaneous_branch *b, const power_system *system, unsigned which,
                     const qdot_expr *value)
{
    qdot_pool *pool = s->pool;
    const qdot_powers *p = &system->powers;
    qdot_simultaneous_branch next = *b;

    next.equations = system->others;
    for (uint32_t i = 0; i < system->n; i++) {
        const qdot_expr there = which >> i & 1 ? QDOT_NIL : qdot_subs(pool, system->with[i], p->n, p->symbol, value);

        if (there != QDOT_NIL)
            next.equations = qdot_list_appended(pool, next.equations, 1, &there);
    }
    for (uint32_t i = 0; i < p->n; i++) {
        qdot_expr one, condition = QDOT_NIL;

        if (!qdot_powers_invert(pool, p, i, value[i], &s->facts, &one, &condition))
            one = qdot_sub(pool, p->power[i], value[i]);
        next.conditions = qdot_conditions_and(pool, next.conditions, condition);
        if (one != QDOT_NIL)
            next.equations = qdot_list_appended(pool, next.equations, 1, &one);
    }
    QDOT_TRY(qdot_pool_check(pool));
    return next.conditions == QDOT_FALSE ? QDOT_OK : qdot_vec_push(&s->todo, next);
}

qdot_status
qdot_simultaneous_by_powers(qdot_simultaneous *s, const qdot_simultaneous_branch *b, qdot_expr equations, bool *done)
{
    qdot_simultaneous_branch singular = *b;
    qdot_expr value[MOST], determinant = QDOT_NIL;
    power_system system;
    unsigned which = 0;

    *done = false;
    if (qdot_expr_count(s->pool, equations) < 2 || qdot_expr_size(s->pool, equations) > LARGEST ||
        !read_system(s, equations, &system))
        return qdot_pool_check(s->pool);
    while (determinant == QDOT_NIL && ++which < 1u << system.n)
        if ((uint32_t)__builtin_popcount(which) == system.powers.n)
            QDOT_TRY(solve_for_powers(s, &system, which, value, &determinant));
    if (determinant == QDOT_NIL)
        return QDOT_OK;
    *done = true;
    singular.equations = equations;
    singular.first = determinant;
    QDOT_TRY(qdot_simultaneous_unknowns_in(s, determinant) > 0 ? qdot_vec_push(&s->todo, singular)
                                                               : qdot_simultaneous_add_special(s, determinant));
    return continue_with_powers(s, b, &system, which, value);
}
