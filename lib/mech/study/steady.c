/* steady.c -- steady motions of a scene, as the equilibria of a scene whose cyclic coordinates turn along. */
#include "mech/study/steady.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/list.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/quantity.h"
#include "mech/study/equilibrium-search.h"
#include "mech/study/steady-momenta.h"
#include "mech/study/steady-reduced.h"
#include "normal/prove/decide.h"

/* The value that `place` gives the rate; nil: none. */
static qdot_expr
rate_of_place(const qdot_pool *pool, qdot_expr place, qdot_expr rate)
{
    for (uint32_t i = 0; i < qdot_expr_count(pool, place); i++) {
        const qdot_expr one = qdot_expr_arg(pool, place, i);

        if (qdot_expr_arg(pool, one, 0) == rate)
            return qdot_expr_arg(pool, one, 1);
    }
    return QDOT_NIL;
}

qdot_expr
qdot_steady_rate(qdot_pool *pool, qdot_expr rate)
{
    return qdot_symbol_get(pool, QDOT_PARAM, qdot_expr_symbol(pool, rate)->name);
}

/* The rates as constants: what the place gives for the coordinates and other rates in them. */
static qdot_status
insert_place(qdot_expr place, qdot_turning *x)
{
    const uint32_t n = qdot_expr_count(x->pool, place);

    for (size_t i = 0; i < x->n; i++) {
        for (uint32_t k = 0; k < n * n; k++) { /* as values hold others */
            const qdot_expr one = qdot_expr_arg(x->pool, place, k % n), symbol = qdot_expr_arg(x->pool, one, 0),
                            value = qdot_expr_arg(x->pool, one, 1);

            x->w[i] = qdot_subs(x->pool, x->w[i], 1, &symbol, &value);
        }
        x->w[i] = qdot_subs(x->pool, x->w[i], x->n, x->rate, x->w);
        QDOT_TRY(qdot_pool_check(x->pool));
        if (!(qdot_expr_node(x->pool, x->w[i])->holds & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY)))
            continue;
        (void)qdot_fail(QDOT_ENOTBUILT, "not built yet: modes about a steady motion whose rate %.100s depends on a free coordinate",
                        qdot_expr_symbol(x->pool, x->rate[i])->name);
        return qdot_hint("give coordinates and rates values, modes at [theta = 1, phi' = 2, psi' = 3], or linearize at steady[1]");
    }
    return QDOT_OK;
}

/* Whether e is the same after a small rotation of coordinates a, b: -b de/da + a de/db, with their velocities too, is 0. */
static bool
rotation_leaves(qdot_scene *s, qdot_expr a, qdot_expr b, qdot_expr e)
{
    const qdot_facts facts = qdot_scene_facts(s);
    qdot_expr sum = QDOT_ZERO;

    for (uint32_t order = 0; order < 2; order++) {
        const qdot_expr x = qdot_symbol_jet(s->pool, a, order), y = qdot_symbol_jet(s->pool, b, order);

        sum = qdot_add(s->pool, sum, qdot_sub(s->pool, qdot_mul(s->pool, x, qdot_diff(s->pool, e, y)),
                                              qdot_mul(s->pool, y, qdot_diff(s->pool, e, x))));
    }
    return sum != QDOT_NIL && qdot_is_zero(s->pool, sum, &facts);
}

/* Two coordinates that can be rotated: L and the constraints hold them and stay the same; false: there are none. */
static bool
find_rotation(qdot_scene *s, qdot_expr *a, qdot_expr *b)
{
    const qdot_expr L = qdot_mech_lagrangian(s);

    for (size_t i = 0; i < s->coordinates.n && L != QDOT_NIL; i++)
        for (size_t k = i + 1; k < s->coordinates.n; k++) {
            bool same;

            *a = s->coordinates.at[i];
            *b = s->coordinates.at[k];
            same = rotation_leaves(s, *a, *b, L);
            for (size_t c = 0; c < s->constraints.n && same; c++)
                same = rotation_leaves(s, *a, *b, s->constraints.at[c].f);
            if (same)
                return true;
        }
    return false;
}

/* Fail; where a rotation is a symmetry the hint has the coordinates whose angle is cyclic. */
static qdot_status
report_nothing_cyclic(qdot_scene *s)
{
    qdot_expr a, b;
    const bool rotates = find_rotation(s, &a, &b);

    QDOT_TRY(qdot_pool_check(s->pool));
    if (!rotates) {
        (void)qdot_fail(QDOT_EINVAL, "no coordinate is cyclic with a conserved momentum: steady motions are the equilibria");
        return qdot_hint("equilibria");
    }
    const char *x = qdot_expr_symbol(s->pool, a)->name, *y = qdot_expr_symbol(s->pool, b)->name;

    (void)qdot_fail(QDOT_EINVAL, "no coordinate is cyclic with a conserved momentum, but a rotation of `%.50s` and `%.50s` leaves the "
                                 "scene as it is: its angle is cyclic if it is a coordinate", x, y);
    return qdot_hint("reset scene; coord r > 0, phi; %.50s = r*cos(phi); %.50s = r*sin(phi)", x, y);
}

/* The cyclic coordinates whose momentum is conserved; of a place those whose rates it names. */
static qdot_status
find_turning(qdot_scene *s, qdot_expr place, qdot_turning *x)
{
    qdot_cyclic *list = NULL;
    size_t n = 0;

    *x = (qdot_turning){.pool = s->pool};
    QDOT_TRY(qdot_mech_cyclic(s, &list, &n));
    x->q = qdot_calloc(3 * n + 1, sizeof *x->q);
    if (x->q == NULL) {
        qdot_free(list);
        return QDOT_ENOMEM;
    }
    x->rate = x->q + n;
    x->w = x->rate + n;
    for (size_t i = 0; i < n; i++) {
        const qdot_expr rate = qdot_symbol_jet(s->pool, list[i].coordinate, 1);
        const qdot_expr value = place == QDOT_NIL ? rate : rate_of_place(s->pool, place, rate);

        if (list[i].rate != QDOT_NIL || value == QDOT_NIL)
            continue;
        x->q[x->n] = list[i].coordinate;
        x->rate[x->n] = rate;
        x->w[x->n] = value == rate ? qdot_steady_rate(s->pool, rate) : value;
        x->n++;
    }
    qdot_free(list);
    QDOT_TRY(qdot_pool_check(s->pool));
    if (place != QDOT_NIL)
        QDOT_TRY(insert_place(place, x));
    if (x->n > 0 || place != QDOT_NIL)
        return QDOT_OK;
    return report_nothing_cyclic(s);
}

static bool
has_holonomic_constraints_alone(const qdot_scene *s)
{
    for (size_t k = 0; k < s->constraints.n; k++)
        if (s->constraints.at[k].kind != QDOT_HOLONOMIC)
            return false;
    return true;
}

/* Whether rates may be constant of which no conserved momentum tells: there are velocity constraints, or a coordinate is
 * cyclic and its momentum not conserved. */
static qdot_status
has_other_rates(qdot_scene *s, bool *yes)
{
    qdot_cyclic *list = NULL;
    size_t n = 0;

    *yes = !has_holonomic_constraints_alone(s);
    if (*yes)
        return QDOT_OK;
    QDOT_TRY(qdot_mech_cyclic(s, &list, &n));
    for (size_t i = 0; i < n; i++)
        *yes = *yes || list[i].rate != QDOT_NIL;
    qdot_free(list);
    return QDOT_OK;
}

static qdot_status
turn_along(qdot_scene *s, const qdot_turning *x)
{
    for (size_t i = 0; i < x->n; i++) {
        QDOT_TRY(qdot_scene_replace(s, x->rate[i], qdot_add(s->pool, x->rate[i], x->w[i])));
        QDOT_TRY(qdot_scene_replace(s, x->q[i], qdot_add(s->pool, x->q[i], qdot_mul(s->pool, x->w[i], QDOT_T))));
    }
    return QDOT_OK;
}

static bool
is_velocity(const qdot_pool *pool, qdot_expr x)
{
    return qdot_expr_is_class(pool, x, QDOT_COORD) && qdot_expr_symbol(pool, x)->order == 1;
}

/* The equations of the place that are none of rates, in the coordinates that turn along. */
static qdot_status
place_of_turning(const qdot_turning *x, qdot_expr place, qdot_expr *at)
{
    qdot_pool *pool = x->pool;

    *at = qdot_list(pool, 0, NULL);
    for (uint32_t i = 0; i < qdot_expr_count(pool, place); i++) {
        qdot_expr one = qdot_expr_arg(pool, place, i);
        const qdot_expr symbol = qdot_expr_arg(pool, one, 0);
        bool turns = false;

        for (size_t k = 0; k < x->n; k++)
            turns = turns || symbol == x->rate[k];
        if (turns)
            continue;
        if (is_velocity(pool, symbol) && qdot_expr_arg(pool, one, 1) == QDOT_ZERO)
            continue;
        if (is_velocity(pool, symbol)) {
            (void)qdot_fail(QDOT_EINVAL, "%.100s is not constant in a steady motion: its coordinate is not cyclic with a "
                                         "conserved momentum", qdot_expr_symbol(pool, symbol)->name);
            return qdot_hint("steady");
        }
        one = qdot_rel(pool, QDOT_EQ, symbol, qdot_subs(pool, qdot_expr_arg(pool, one, 1), x->n, x->rate, x->w));
        *at = qdot_list_appended(pool, *at, 1, &one);
    }
    return qdot_pool_check(pool);
}

qdot_status
qdot_turning_begin(qdot_scene *s, qdot_expr place, qdot_turning *x, qdot_expr *at)
{
    QDOT_TRY(find_turning(s, place, x));
    if (place != QDOT_NIL)
        QDOT_TRY(place_of_turning(x, place, at));
    QDOT_TRY(qdot_scene_save(s, &x->saved));
    return turn_along(s, x);
}

void
qdot_turning_end(qdot_scene *s, qdot_turning *x)
{
    qdot_scene_restore(s, &x->saved);
}

void
qdot_turning_clear(qdot_turning *x)
{
    qdot_free(x->q);
    *x = (qdot_turning){0};
}

qdot_expr
qdot_turning_with_rates(const qdot_turning *x, qdot_expr e)
{
    for (size_t k = 0; k < x->n && e != QDOT_NIL; k++)
        if (x->w[k] == qdot_steady_rate(x->pool, x->rate[k]))
            e = qdot_subs(x->pool, e, 1, &x->w[k], &x->rate[k]);
    return e;
}

static qdot_status
write_rates(const qdot_turning *x, qdot_binder bind, void *user, qdot_equilibria *all)
{
    for (size_t i = 0; i < all->n; i++) {
        qdot_equilibrium *one = &all->at[i];

        one->equations = qdot_turning_with_rates(x, one->equations);
        one->exists = qdot_turning_with_rates(x, one->exists);
        one->range = qdot_turning_with_rates(x, one->range);
        one->stable_when = qdot_turning_with_rates(x, one->stable_when);
        one->otherwise_to_first_order = qdot_turning_with_rates(x, one->otherwise_to_first_order);
        for (size_t k = 0; k < x->n; k++) {
            const qdot_expr constant =
                qdot_rel(x->pool, QDOT_EQ, x->rate[k], one->numeric ? bind(user, x->w[k]) : x->rate[k]);

            one->equations = qdot_list_appended(x->pool, one->equations, 1, &constant);
        }
    }
    all->special = qdot_turning_with_rates(x, all->special);
    all->undefined = qdot_turning_with_rates(x, all->undefined);
    all->meeting = qdot_turning_with_rates(x, all->meeting);
    all->jump = qdot_turning_with_rates(x, all->jump);
    return qdot_pool_check(x->pool);
}

/* Of those that the turning scene's energy does not decide, the stability by their linear motion and at fixed momenta. */
static qdot_status
judge_undecided(qdot_scene *s, const qdot_turning *x, qdot_equilibria *all)
{
    bool conservative, open = false;

    for (size_t i = 0; i < all->n; i++)
        open = open || qdot_steady_is_open(&all->at[i]);
    if (!open)
        return QDOT_OK;
    QDOT_TRY(qdot_steady_judge_linear(s, all));
    QDOT_TRY(qdot_steady_is_conservative(s, &conservative));
    for (size_t i = 0; i < all->n && conservative; i++)
        if (qdot_steady_is_open(&all->at[i]))
            QDOT_TRY(qdot_steady_at_momenta(s, x->n, x->q, &all->at[i]));
    return QDOT_OK;
}

/* Numbers need a value of a rate, which is one of the start. */
static qdot_status
suggest_rate(const qdot_turning *x, qdot_binder bind, void *user, qdot_status status)
{
    for (size_t k = 0; k < x->n && status == QDOT_EUNSET; k++)
        if (bind(user, x->w[k]) == x->w[k])
            return qdot_hint("start %.100s = ...", qdot_expr_symbol(x->pool, x->w[k])->name);
    return status;
}

/* Where generic rates have no steady motion, single ones may, as in m r (w^2 - k/m) = 0: *out is replaced if some are found. */
static qdot_status
find_at_single_rates(qdot_scene *s, qdot_equilibria *out)
{
    qdot_equilibria found;
    const qdot_status status = qdot_steady_reduced(s, QDOT_NIL, &found);

    if (status == QDOT_EFAILED || status == QDOT_ENOTBUILT || status == QDOT_ELIMIT || status == QDOT_EINVAL)
        return QDOT_OK;
    QDOT_TRY(status);
    qdot_equilibria_clear(out);
    *out = found;
    return QDOT_OK;
}

qdot_status
qdot_steady_find(qdot_scene *s, qdot_expr unknown, qdot_binder bind, void *user, qdot_equilibria *out)
{
    qdot_turning x;
    bool reduced = unknown != QDOT_NIL;
    qdot_status status;

    *out = (qdot_equilibria){0};
    if (!reduced)
        QDOT_TRY(has_other_rates(s, &reduced));
    if (reduced) {
        status = qdot_steady_reduced(s, unknown, out);
        if (unknown != QDOT_NIL || !has_holonomic_constraints_alone(s) || (status != QDOT_EINVAL && status != QDOT_ENOTBUILT))
            return status;
    }
    status = qdot_turning_begin(s, QDOT_NIL, &x, NULL);
    if (status == QDOT_OK)
        status = suggest_rate(&x, bind, user, qdot_equilibrium_find(s, bind, user, out));
    qdot_turning_end(s, &x);
    if (status == QDOT_OK && out->pole == NULL) /* coordinates that turn along hide it */
        status = qdot_rest_pole(&(qdot_rest){.s = s, .pool = s->pool}, &out->pole);
    if (status == QDOT_OK)
        status = write_rates(&x, bind, user, out);
    if (status == QDOT_OK)
        status = judge_undecided(s, &x, out);
    qdot_turning_clear(&x);
    if (status == QDOT_OK && reduced && out->n == 0) /* its failure stands */
        return qdot_steady_reduced(s, QDOT_NIL, out);
    out->complete = out->complete && !reduced;
    return status == QDOT_OK && out->n == 0 ? find_at_single_rates(s, out) : status;
}
