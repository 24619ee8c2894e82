/* equilibrium-corners.c -- rests where a force jumps: at the corner of a potential, and under dry friction.
 *
 * Where u = 0, sign u may take any value s of -1 <= s <= 1 that makes the forces vanish (Filippov's convex
 * combination of the forces on both sides), provided that the jump pushes back:
 *
 *     G(q, s) = 0,   u(q) = 0,   sum_i dG_i/ds du/dq_i < 0,
 *
 * G the generalized forces at rest. Under friction u holds velocities, which are 0 at rest: s is an unknown
 * like a multiplier, and du/dq_i' takes the place of du/dq_i.
 *
 * Source  Filippov, Differential Equations with Discontinuous Righthand Sides, 2.4.
 */
#include <stdio.h>

#include "expr/build.h"
#include "expr/elementary.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/scene/access.h"
#include "mech/study/equilibrium-search.h"
#include "mech/linear/linear-motion.h"
#include "normal/inequality/less.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solve.h"

enum { MOST_CORNERS = 4 };

/* The k-th symbol s in -1 <= s <= 1 that stands for the sign of an expression where this is 0. */
static qdot_expr
sign_symbol(qdot_pool *pool, size_t k)
{
    char name[24];
    qdot_expr side;

    snprintf(name, sizeof name, "(side %zu)", k + 1);
    side = qdot_symbol_get(pool, QDOT_FORMAL, name);
    qdot_symbol_domain(pool, side, QDOT_MINUS_ONE, false, QDOT_ONE, false);
    return side;
}

/* The next argument u of a sign in e after `skip` [n]: one that holds velocities and is 0 at rest, or (moving
 * false, e a LIST) one of coordinates alone by which a member jumps; nil: there is none. */
static qdot_expr
next_sign_argument(const qdot_rest *r, qdot_expr e, bool moving, size_t n, const qdot_expr *skip)
{
    qdot_pool *pool = r->pool;
    qdot_expr nowhere = qdot_list(pool, 0, NULL), found = QDOT_NIL;
    qdot_status status = QDOT_OK;
    bool jumps = false;
    qdot_walk w;

    if (e == QDOT_NIL)
        return QDOT_NIL;
    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n && found == QDOT_NIL && status == QDOT_OK; i++) {
        uint32_t holds;
        qdot_expr u;

        if (qdot_expr_kind(pool, w.at[i]) != QDOT_FUN ||
            qdot_expr_node(pool, w.at[i])->op != QDOT_SIGN)
            continue;
        u = qdot_expr_arg(pool, w.at[i], 0);
        holds = qdot_mech_holds(r->s, u);
        if (qdot_expr_place(n, skip, u) < n || ((holds & QDOT_HAS_VELOCITY) != 0) != moving ||
            (!moving && (holds & QDOT_HAS_COORD) == 0))
            continue;
        if (!moving)
            status = qdot_rest_jumps(r, e, u, &jumps);
        if (status == QDOT_OK && (moving ? qdot_rest_value(r->s, nowhere, u) == QDOT_ZERO : jumps))
            found = u;
    }
    qdot_walk_end(&w);
    return status == QDOT_OK ? found : qdot_pool_fail(pool);
}

/* sum_i -dG_i/ds du/dx_i over the coordinates (order 0) or velocities (1): positive where the jump pushes back;
 * equations [n]: G with s in place of sign u. */
static qdot_expr
restoring_slope(const qdot_rest *r, size_t n, const qdot_expr *G, qdot_expr side, qdot_expr u,
                uint32_t order)
{
    qdot_pool *pool = r->pool;
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < r->s->coordinates.n && i < n; i++) {
        qdot_expr slope = qdot_diff(pool, u, qdot_mech_jet(r->s, i, order));

        sum = qdot_sub(pool, sum, qdot_mul(pool, qdot_diff(pool, G[i], side), slope));
    }
    return sum;
}

/* --- dry friction at rest ---------------------------------------------------------------- */

qdot_status
qdot_rest_sides(qdot_rest *r, size_t n, qdot_expr *G)
{
    qdot_pool *pool = r->pool;
    qdot_expr seen[MOST_CORNERS], nowhere = qdot_list(pool, 0, NULL);
    size_t count = 0;

    for (size_t i = 0; i < n; i++)
        G[i] = qdot_rest_slips_by_signs(r, G[i]);
    QDOT_TRY(qdot_pool_check(pool));
    for (size_t i = 0; i < n; i++)
        for (;;) {
            qdot_expr u = next_sign_argument(r, G[i], true, count, seen), from, side, when, room[1];
            qdot_expr *with;

            if (u == QDOT_NIL)
                break;
            if (count == MOST_CORNERS) {
                r->system.complete = false;
                break;
            }
            with = qdot_malloc(n * sizeof *with);
            if (with == NULL)
                return QDOT_ENOMEM;
            seen[count] = u;
            side = sign_symbol(pool, count++);
            from = qdot_fun1(pool, QDOT_SIGN, u);
            for (size_t k = 0; k < n; k++)
                with[k] = qdot_subs(pool, G[k], 1, &from, &side);
            when = qdot_rest_value(r->s, nowhere, restoring_slope(r, n, with, side, u, 1));
            /* where `when` is 0 there is no friction and the symbol s may have any value */
            when = qdot_condition(pool, when, false, &r->facts);
            if (when != QDOT_FALSE && when != QDOT_NIL) { /* other forces drive the motion and are 0 at rest: keep sign(u) */
                room[0] = side;
                for (size_t k = 0; k < n; k++)
                    G[k] = with[k];
                r->friction = qdot_list_appended(pool, r->friction, 1, room);
                r->slips = qdot_list_appended(pool, r->slips, 1, &u);
                r->sliding = qdot_conditions_and(pool, r->sliding, when);
            }
            qdot_free(with);
            QDOT_TRY(qdot_pool_check(pool));
        }
    return QDOT_OK;
}

/* --- points at which forces jump ---------------------------------------------------------- */

/* The branch in which the jumps of the bits of `which` are at 0, where nothing in their LISTs in `apart` is: there two
 * sides depend on each other. */
static qdot_status
add_corner_branch(qdot_rest *r, qdot_expr equations, qdot_expr forces, const qdot_expr *u, size_t n, unsigned which,
                  const qdot_expr *apart)
{
    qdot_pool *pool = r->pool;
    uint32_t count = qdot_expr_count(pool, forces);
    qdot_simultaneous_branch b = {.equations = equations, .known = qdot_list(pool, 0, NULL),
                          .conditions = r->sliding};
    qdot_expr *G = qdot_malloc((count + 1) * sizeof *G);
    qdot_status status = QDOT_OK;

    if (G == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < n; k++) {
        qdot_expr from = qdot_fun1(pool, QDOT_SIGN, u[k]),
                  side = sign_symbol(pool, MOST_CORNERS + k);

        if ((which >> k & 1) == 0)
            continue;
        b.equations = qdot_subs(pool, b.equations, 1, &from, &side);
        forces = qdot_subs(pool, forces, 1, &from, &side);
    }
    status = qdot_pool_check(pool);
    for (uint32_t i = 0; i < count && status == QDOT_OK; i++)
        G[i] = qdot_expr_arg(pool, forces, i);
    for (size_t k = 0; k < n && status == QDOT_OK; k++) {
        qdot_expr back;

        if ((which >> k & 1) == 0)
            continue;
        back = restoring_slope(r, count, G, sign_symbol(pool, MOST_CORNERS + k), u[k], 0);
        b.equations = qdot_list_appended(pool, b.equations, 1, &u[k]);
        for (uint32_t j = 0; j < qdot_expr_count(pool, apart[k]) && b.conditions != QDOT_FALSE; j++)
            b.conditions = qdot_conditions_and_nonzero(pool, b.conditions, qdot_expr_arg(pool, apart[k], j));
        if (b.conditions != QDOT_FALSE && back != QDOT_NIL)
            b.conditions = qdot_conditions_and(pool, b.conditions,
                                               qdot_rel(pool, QDOT_LT, QDOT_ZERO, back));
        status = qdot_pool_check(pool);
    }
    qdot_free(G);
    b.whole = b.equations;
    if (status == QDOT_OK && b.conditions != QDOT_FALSE)
        status = qdot_vec_push(&r->system.todo, b);
    return status;
}

/* Whether the function u of the coordinates has kinks itself. */
static bool
has_kinks(const qdot_rest *r, qdot_expr u)
{
    static const qdot_fun_id kinked[] = {QDOT_ABS, QDOT_SIGN, QDOT_MAX, QDOT_MIN, QDOT_IF};
    bool yes = false;
    qdot_walk w;

    if (qdot_walk_begin(r->pool, u, &w) != QDOT_OK)
        return true;
    for (size_t i = 0; i < w.n && !yes; i++)
        for (size_t f = 0; f < sizeof kinked / sizeof *kinked && !yes; f++)
            yes = qdot_expr_is_function(r->pool, w.at[i], kinked[f]) &&
                  (qdot_mech_holds(r->s, w.at[i]) & QDOT_HAS_COORD) != 0;
    qdot_walk_end(&w);
    return yes;
}

/* Whether the jumps of two kinks simply add where both are at q = at: no product of both signs is in the forces, and
 * each is proved to push back. Then any two sides give a force between those left and right of the place. */
static bool
jumps_add_up(const qdot_rest *r, qdot_expr forces, const qdot_expr u[2], qdot_expr q, qdot_expr at)
{
    qdot_pool *pool = r->pool;
    const qdot_expr side[2] = {sign_symbol(pool, MOST_CORNERS), sign_symbol(pool, MOST_CORNERS + 1)},
                    sign[2] = {qdot_fun1(pool, QDOT_SIGN, u[0]), qdot_fun1(pool, QDOT_SIGN, u[1])};
    qdot_expr G = qdot_subs(pool, qdot_expr_arg(pool, forces, 0), 2, sign, side);

    if (qdot_expr_count(pool, forces) != 1 || has_kinks(r, u[0]) || has_kinks(r, u[1]) || G == QDOT_NIL ||
        qdot_expand(pool, qdot_diff(pool, qdot_diff(pool, G, side[0]), side[1])) != QDOT_ZERO)
        return false;
    for (size_t k = 0; k < 2; k++) {
        qdot_expr back = qdot_subs(pool, restoring_slope(r, 1, &G, side[k], u[k], 0), 1, &q, &at);
        qdot_decision d;

        if (back == QDOT_NIL || qdot_decide_less(pool, QDOT_ZERO, qdot_simplify(pool, back, &r->facts), true, &r->facts,
                                                 &d) != QDOT_OK ||
            d.verdict != QDOT_PROVED)
            return false;
    }
    return true;
}

/* Whether u and v vanish at the same value of a coordinate for all parameters, and their jumps do
 * not simply add. */
static qdot_status
kinks_coincide(const qdot_rest *r, qdot_expr forces, qdot_expr u, qdot_expr v, bool *yes)
{
    qdot_pool *pool = r->pool;
    const qdot_expr pair[2] = {u, v};

    *yes = false;
    for (size_t c = 0; c < r->s->coordinates.n && !*yes; c++) {
        qdot_expr q = r->s->coordinates.at[c];
        qdot_solutions zero = {0};
        qdot_status status;

        if (!qdot_expr_contains(pool, v, q))
            continue;
        status = qdot_solve(pool, v, q, &r->facts, &zero);
        for (size_t k = 0; k < zero.root.n && status == QDOT_OK && !*yes; k++) {
            qdot_expr at = zero.root.at[k].value, gap = qdot_subs(pool, u, 1, &q, &at);

            *yes = gap != QDOT_NIL && qdot_is_zero(pool, gap, &r->facts) && !jumps_add_up(r, forces, pair, q, at);
            status = qdot_pool_check(pool);
            if (status == QDOT_EDOMAIN)
                status = QDOT_OK;
        }
        qdot_solutions_clear(&zero);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

/* To the LISTs apart [n] for each of the u [n] what is 0 where it is, whatever the parameters are, with a jump that does
 * not simply add: others of the u, and what its own kinks lie at. Such places are not searched. */
static qdot_status
find_coinciding_kinks(qdot_rest *r, qdot_expr forces, size_t n, const qdot_expr *u, qdot_expr *apart)
{
    qdot_pool *pool = r->pool;
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < n; i++)
        apart[i] = qdot_list(pool, 0, NULL);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            bool yes = false;

            if (j != i)
                QDOT_TRY(kinks_coincide(r, forces, u[i], u[j], &yes));
            if (!yes)
                continue;
            apart[i] = qdot_list_appended(pool, apart[i], 1, &u[j]);
            apart[j] = qdot_list_appended(pool, apart[j], 1, &u[i]);
            r->unresolved = true;
        }
    for (size_t i = 0; i < n; i++) {
        qdot_walk w;

        QDOT_TRY(qdot_walk_begin(pool, u[i], &w));
        for (size_t k = 0; k < w.n && status == QDOT_OK; k++) {
            bool yes = false;
            qdot_expr v;

            if (!qdot_expr_is_function(pool, w.at[k], QDOT_ABS) && !qdot_expr_is_function(pool, w.at[k], QDOT_SIGN))
                continue;
            v = qdot_expr_arg(pool, w.at[k], 0);
            status = kinks_coincide(r, forces, u[i], v, &yes);
            if (yes) {
                apart[i] = qdot_list_appended(pool, apart[i], 1, &v);
                r->unresolved = true;
            }
        }
        qdot_walk_end(&w);
        QDOT_TRY(status);
    }
    return qdot_pool_check(pool);
}

/* Add what is 0 where the u [n] of two kinks of the only coordinate q are 0 at one place: for other values of parameters
 * these are solved for one by one. */
static qdot_status
add_coinciding_kinks(qdot_rest *r, qdot_expr q, size_t n, const qdot_expr *u)
{
    qdot_pool *pool = r->pool;

    for (size_t i = 0; i + 1 < n; i++) {
        qdot_solutions zero = {0};
        qdot_status status = qdot_solve(pool, u[i], q, &r->facts, &zero);

        for (size_t k = 0; k < zero.root.n && status == QDOT_OK; k++)
            for (size_t j = i + 1; j < n && status == QDOT_OK; j++) {
                qdot_expr at = zero.root.at[k].value, gap = qdot_subs(pool, u[j], 1, &q, &at), factors;

                factors = gap == QDOT_NIL ? QDOT_NIL : qdot_solve_factors(pool, qdot_simplify(pool, gap, &r->facts));
                for (uint32_t f = 0; factors != QDOT_NIL && f < qdot_expr_count(pool, factors); f++) {
                    const qdot_expr pair[2] = {qdot_expr_arg(pool, factors, f), at};
                    qdot_expr meeting = qdot_list(pool, 2, pair);

                    if (qdot_is_generic(pool, pair[0]) && !qdot_expr_is_constant(pool, pair[0]) &&
                        (qdot_expr_node(pool, pair[0])->sign & QDOT_NE0) == 0)
                        r->meeting = qdot_list_appended(pool, r->meeting, 1, &meeting);
                }
                status = qdot_pool_check(pool);
                if (status == QDOT_EDOMAIN)
                    status = QDOT_OK;
            }
        qdot_solutions_clear(&zero);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

qdot_status
qdot_rest_corners(qdot_rest *r, qdot_expr equations)
{
    qdot_pool *pool = r->pool;
    qdot_expr u[MOST_CORNERS + 1], forces;
    qdot_expr apart[MOST_CORNERS];
    size_t n = 0;

    QDOT_TRY(qdot_rest_by_signs(r, equations, &equations));
    QDOT_TRY(qdot_rest_by_signs(r, r->forces, &forces));
    while (n <= MOST_CORNERS && (u[n] = next_sign_argument(r, equations, false, n, u)) != QDOT_NIL)
        n++;
    QDOT_TRY(qdot_pool_check(pool));
    if (n > MOST_CORNERS) {
        r->system.complete = false;
        return QDOT_OK;
    }
    if (r->s->coordinates.n == 1)
        QDOT_TRY(add_coinciding_kinks(r, r->s->coordinates.at[0], n, u));
    QDOT_TRY(find_coinciding_kinks(r, forces, n, u, apart));
    for (size_t k = 0; k < n; k++)
        QDOT_TRY(qdot_vec_push(&r->system.unknowns, sign_symbol(pool, MOST_CORNERS + k)));
    for (unsigned which = 1; which < 1u << n; which++)
        QDOT_TRY(add_corner_branch(r, equations, forces, u, n, which, apart));
    return QDOT_OK;
}

qdot_status
qdot_rest_corner(qdot_rest *r, qdot_expr *u)
{
    qdot_expr equations;

    QDOT_TRY(qdot_rest_by_signs(r, r->system.equations, &equations));
    *u = next_sign_argument(r, equations, false, 0, NULL);
    return qdot_pool_check(r->pool);
}

qdot_status
qdot_rest_is_corner(qdot_rest *r, qdot_expr place, bool *yes)
{
    qdot_expr equations, u[MOST_CORNERS], there;

    *yes = false;
    QDOT_TRY(qdot_rest_by_signs(r, r->system.equations, &equations));
    for (size_t n = 0; n < MOST_CORNERS && !*yes; n++) {
        u[n] = next_sign_argument(r, equations, false, n, u);
        if (u[n] == QDOT_NIL)
            break;
        there = qdot_simultaneous_put(r->pool, u[n], place);
        *yes = there != QDOT_NIL && qdot_is_zero(r->pool, there, &r->facts);
    }
    return qdot_pool_check(r->pool);
}

/* The force beside a place at a kink, on the upper side or the lower one: signs of what is 0 at the place as they are
 * there. Nil: it is not known. */
static qdot_expr
force_beside_kink(const qdot_rest *r, qdot_expr force, qdot_expr q, qdot_expr at, bool upper, const qdot_facts *facts)
{
    qdot_pool *pool = r->pool;
    qdot_expr there = force;
    qdot_walk w;

    if (qdot_walk_begin(pool, force, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n && there != QDOT_NIL; i++) {
        qdot_expr u, slope, side;

        if (!qdot_expr_is_function(pool, w.at[i], QDOT_SIGN))
            continue;
        u = qdot_expr_arg(pool, w.at[i], 0);
        if (!qdot_expr_contains(pool, u, q) || !qdot_is_zero(pool, qdot_subs(pool, u, 1, &q, &at), facts))
            continue;
        slope = qdot_simplify(pool, qdot_subs(pool, qdot_diff(pool, u, q), 1, &q, &at), facts);
        side = slope == QDOT_ZERO ? QDOT_NIL : qdot_div(pool, qdot_fun1(pool, QDOT_ABS, slope), slope);
        side = upper ? side : qdot_neg(pool, side);
        there = side == QDOT_NIL ? QDOT_NIL : qdot_subs(pool, there, 1, &w.at[i], &side);
    }
    qdot_walk_end(&w);
    return there == QDOT_NIL ? QDOT_NIL : qdot_simplify(pool, qdot_subs(pool, there, 1, &q, &at), facts);
}

qdot_status
qdot_rest_is_held(qdot_rest *r, qdot_expr values, qdot_expr p, qdot_expr value, const qdot_facts *facts, qdot_held *held)
{
    qdot_pool *pool = r->pool;
    qdot_expr forces, q, at, upper, lower, there;
    qdot_status status;

    *held = QDOT_HELD_UNKNOWN;
    if (r->s->coordinates.n != 1 || r->s->constraints.n > 0 || r->friction != QDOT_NIL ||
        qdot_expr_count(pool, values) != 1)
        return QDOT_OK;
    q = r->s->coordinates.at[0];
    at = qdot_expr_arg(pool, qdot_expr_arg(pool, values, 0), 1);
    QDOT_TRY(qdot_rest_by_signs(r, r->forces, &forces));
    forces = qdot_subs(pool, qdot_expr_arg(pool, forces, 0), 1, &p, &value);
    upper = forces == QDOT_NIL ? QDOT_NIL : force_beside_kink(r, forces, q, at, true, facts);
    lower = upper == QDOT_NIL ? QDOT_NIL : force_beside_kink(r, forces, q, at, false, facts);
    there = lower == QDOT_NIL ? QDOT_NIL : qdot_subs(pool, forces, 1, &q, &at);
    if (there != QDOT_NIL) {
        const qdot_expr down = qdot_condition(pool, qdot_neg(pool, upper), false, facts),
                        up = qdot_condition(pool, lower, false, facts);

        if (down == QDOT_TRUE && up == QDOT_TRUE)
            *held = QDOT_HELD;
        else if ((down == QDOT_FALSE || up == QDOT_FALSE) &&
                 qdot_condition(pool, qdot_fun1(pool, QDOT_ABS, there), true, facts) == QDOT_TRUE)
            *held = QDOT_NOT_HELD;
    }
    status = qdot_pool_check(pool);
    if (status != QDOT_OK)
        *held = QDOT_HELD_UNKNOWN;
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}
