/* ostrogradsky.c -- momenta, energy and equations of Lagrangians with second and higher derivatives. */
#include "mech/dynamics/ostrogradsky.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "mech/scene/scene.h"
#include "normal/prove/decide.h"
#include "normal/solve/linear.h"

/* The stated Lagrangian in q'', q''' ... */
static qdot_expr
lagrangian_in_jets(qdot_scene *s)
{
    return qdot_higher_in_jets(s, s->higher_lagrangian);
}

/* The number of coordinates that stand for themselves; they come first. */
static size_t
count_own(const qdot_scene *s)
{
    return s->coordinates.n - s->higher.n;
}

/* p_k of q, in q'', q''' ...: of k = 0 the left side of its equation, with the opposite sign. */
static qdot_expr
momentum_in_jets(qdot_scene *s, qdot_expr q, uint32_t k)
{
    qdot_pool *pool = s->pool;
    const qdot_expr L = lagrangian_in_jets(s);
    qdot_expr sum = QDOT_ZERO;

    for (uint32_t j = qdot_higher_order(s, q); j + 1 > k && L != QDOT_NIL; j--) {
        /* Horner's form: p_k = dL/dq^(k) - d/dt p_(k+1) */
        sum = qdot_sub(pool, qdot_diff(pool, L, qdot_symbol_jet(pool, q, j)), qdot_ddt(pool, sum));
        if (j == 0)
            break;
    }
    return sum;
}

/* An expression in q'', q''' ... for people. */
static qdot_expr
finished(qdot_scene *s, qdot_expr e)
{
    return qdot_mech_tidy(s, qdot_higher_in_motion(s, e));
}

/* --- momenta and energy ---------------------------------------------------------------------------------- */

/* The coordinate and the order of the derivative that q, a coordinate of the scene or a derivative, stands for. */
static qdot_expr
base_of(const qdot_scene *s, qdot_expr q, uint32_t *order)
{
    const qdot_symbol *symbol = qdot_expr_symbol(s->pool, q);
    const qdot_expr own = symbol->order > 0 ? symbol->base : q;
    const qdot_higher *h = qdot_higher_find(s, own);

    *order = symbol->order + (h ? h->order : 0);
    return h ? h->base : own;
}

qdot_expr
qdot_ostrogradsky_momentum(qdot_scene *s, qdot_expr q)
{
    uint32_t order;
    const qdot_expr base = base_of(s, q, &order);
    size_t i;

    if (!qdot_mech_index(s, base, &i))
        return QDOT_NIL;
    if (order >= qdot_higher_order(s, base))
        return qdot_mech_fail(s, QDOT_EINVAL, "no momentum goes with %s: the Lagrangian holds no higher derivative",
                              qdot_expr_symbol(s->pool, q)->name);
    return finished(s, momentum_in_jets(s, base, order + 1));
}

/* The derivative whose momentum goes with coordinate q in lists: p_1 with q, p_2 with q'', p_3 with q''''. */
static qdot_expr
place_of_momentum(qdot_scene *s, qdot_expr q)
{
    const qdot_higher *h = qdot_higher_find(s, q);

    return h ? qdot_symbol_jet(s->pool, h->base, h->order / 2) : q;
}

qdot_expr
qdot_ostrogradsky_symbol(qdot_scene *s, qdot_expr q)
{
    return qdot_symbol_of(s->pool, QDOT_MOMENTUM, place_of_momentum(s, q));
}

/* The momentum that goes with coordinate q in lists. */
static qdot_expr
momentum_of(qdot_scene *s, qdot_expr q)
{
    return qdot_ostrogradsky_momentum(s, place_of_momentum(s, q));
}

qdot_expr
qdot_ostrogradsky_momenta(qdot_scene *s)
{
    return qdot_mech_each(s, s->coordinates.n, momentum_of);
}

bool
qdot_ostrogradsky_is_canonical(qdot_scene *s, qdot_expr e)
{
    const qdot_expr jets = qdot_higher_in_jets(s, e);

    for (size_t i = 0; i < count_own(s) && jets != QDOT_NIL; i++) {
        const uint32_t order = qdot_higher_order(s, s->coordinates.at[i]);

        for (uint32_t k = order; k <= 2 * order; k++)
            if (qdot_expr_contains(s->pool, jets, qdot_mech_jet(s, i, k)))
                return false;
    }
    return jets != QDOT_NIL;
}

qdot_expr
qdot_ostrogradsky_energy(qdot_scene *s)
{
    qdot_pool *pool = s->pool;
    qdot_expr h = qdot_neg(pool, lagrangian_in_jets(s));

    for (size_t i = 0; i < count_own(s); i++) {
        const qdot_expr q = s->coordinates.at[i];

        for (uint32_t k = 1; k <= qdot_higher_order(s, q); k++)
            h = qdot_add(pool, h, qdot_mul(pool, momentum_in_jets(s, q, k), qdot_symbol_jet(pool, q, k)));
    }
    return finished(s, h);
}

/* --- equations --------------------------------------------------------------------------------------------- */

/* The left side of the equation of q, sum (-1)^(k + 1) (d/dt)^k dL/dq^(k), in q'', q''' ... */
static qdot_expr
left_in_jets(qdot_scene *s, qdot_expr q)
{
    return qdot_neg(s->pool, momentum_in_jets(s, q, 0));
}

bool
qdot_ostrogradsky_conserves(qdot_scene *s)
{
    const qdot_facts facts = qdot_scene_facts(s);

    for (size_t i = 0; i < count_own(s); i++)
        if (qdot_mech_sources(s, i) != QDOT_ZERO)
            return false;
    return qdot_is_zero(s->pool, qdot_diff(s->pool, s->higher_lagrangian, QDOT_T), &facts);
}

qdot_expr
qdot_ostrogradsky_equation(qdot_scene *s, qdot_expr q)
{
    const qdot_state *state = qdot_scene_state_of(s, q);
    size_t i;

    if (!qdot_mech_index(s, q, &i))
        return QDOT_NIL;
    if (state)
        return qdot_rel(s->pool, QDOT_EQ, qdot_mech_jet(s, i, 1), qdot_mech_tidy(s, state->rate));
    return qdot_rel(s->pool, QDOT_EQ, finished(s, left_in_jets(s, q)), qdot_mech_tidy(s, qdot_mech_sources(s, i)));
}

qdot_expr
qdot_ostrogradsky_equations(qdot_scene *s)
{
    return qdot_mech_each(s, count_own(s), qdot_ostrogradsky_equation);
}

/* --- solved for the highest derivatives ---------------------------------------------------------------------- */

/* The coordinate whose acceleration is the highest derivative of q. */
static size_t
last_of(qdot_scene *s, size_t i)
{
    for (size_t k = count_own(s); k < s->coordinates.n; k++) {
        const qdot_higher *h = qdot_higher_find(s, s->coordinates.at[k]);

        if (h->base == s->coordinates.at[i] && h->order + 2 == 2 * qdot_higher_order(s, h->base))
            return k;
    }
    return i;
}

/* Row i of A x = b for the highest derivatives x. */
static bool
fill_row(qdot_scene *s, size_t i, const size_t *last, qdot_expr *A, qdot_expr *b)
{
    qdot_pool *pool = s->pool;
    const size_t n = count_own(s);
    const qdot_expr q = s->coordinates.at[i], zero = QDOT_ZERO;
    qdot_expr rest;

    if (qdot_scene_state_of(s, q)) { /* z' = g is the equation of a state, not one of z'' */
        for (size_t j = 0; j < n; j++)
            A[j] = j == i ? QDOT_ONE : QDOT_ZERO;
        *b = QDOT_ZERO;
        return true;
    }
    rest = qdot_higher_in_motion(s, qdot_sub(pool, left_in_jets(s, q), qdot_mech_sources(s, i)));
    rest = qdot_scene_with_rates(s, rest);
    for (size_t j = 0; j < n; j++) {
        const qdot_expr top = qdot_mech_jet(s, last[j], 2);

        A[j] = qdot_mech_tidy(s, qdot_diff(pool, rest, top));
        if (qdot_mech_holds(s, A[j]) & QDOT_HAS_ACCELERATION)
            break;
        if (A[j] != QDOT_ZERO)
            rest = qdot_subs(pool, rest, 1, &top, &zero);
    }
    *b = qdot_neg(pool, rest);
    if (!qdot_pool_failed(pool) && (qdot_mech_holds(s, rest) & QDOT_HAS_ACCELERATION))
        qdot_mech_fail(s, QDOT_ENOTBUILT,
                       "not built yet: motion where the equation of %s holds higher derivatives of another coordinate than that "
                       "one's own equation",
                       qdot_expr_symbol(pool, q)->name);
    return !qdot_pool_failed(pool);
}

static qdot_status
solve_rows(qdot_scene *s, const size_t *last, qdot_expr *A, qdot_expr *b, qdot_expr *x)
{
    const qdot_facts facts = qdot_scene_facts(s);
    const size_t n = count_own(s);
    uint32_t pivot = 0;
    qdot_status status;

    for (size_t i = 0; i < n; i++)
        if (!fill_row(s, i, last, A + i * n, b + i))
            return qdot_pool_check(s->pool);
    status = qdot_solve_linear(s->pool, (uint32_t)n, A, b, x, &pivot, &facts);
    if (status == QDOT_ESINGULAR)
        return qdot_fail(status, "%s is not determined: the Lagrangian is degenerate in the highest derivatives",
                         qdot_expr_symbol(s->pool, qdot_mech_jet(s, last[pivot], 2))->name);
    return status;
}

/* Find what is applied to every coordinate, once for this version of the scene. */
static bool
find_forces(qdot_scene *s)
{
    qdot_derived *d = qdot_derived_get(s);
    const size_t n = count_own(s);
    size_t *last;
    qdot_expr *room;
    bool found = false;

    if (d->higher)
        return true;
    last = qdot_calloc(n + 1, sizeof *last);
    room = qdot_calloc(n * n + 2 * n + 1, sizeof *room);
    for (size_t i = 0; last && i < n; i++)
        last[i] = last_of(s, i);
    if (last && room && solve_rows(s, last, room, room + n * n, room + n * n + n) == QDOT_OK &&
        qdot_derived_array(s, &d->higher, s->coordinates.n)) {
        for (size_t i = 0; i < n; i++)
            d->higher[last[i]] = qdot_mech_tidy(s, room[n * n + n + i]);
        for (size_t k = 0; k < s->higher.n; k++) { /* q'' = u_2, u_2'' = u_4 ... */
            const qdot_higher *h = &s->higher.at[k], *below = k > 0 ? h - 1 : NULL;
            const qdot_expr under = below && below->base == h->base ? below->u : h->base;
            size_t i;

            if (qdot_mech_index(s, under, &i))
                d->higher[i] = h->u;
        }
        found = true;
    }
    if (!found)
        qdot_pool_fail(s->pool);
    qdot_free(last);
    qdot_free(room);
    return found && !qdot_pool_failed(s->pool);
}

qdot_expr
qdot_ostrogradsky_force(qdot_scene *s, size_t i)
{
    return find_forces(s) ? s->derived->higher[i] : QDOT_NIL;
}

qdot_expr
qdot_ostrogradsky_accel(qdot_scene *s, qdot_expr q)
{
    size_t i;

    return qdot_mech_index(s, q, &i) ? qdot_ostrogradsky_force(s, last_of(s, i)) : QDOT_NIL;
}

qdot_expr
qdot_ostrogradsky_accels(qdot_scene *s)
{
    return qdot_mech_each(s, count_own(s), qdot_ostrogradsky_accel);
}
