/* recursive.c -- M and f with what rows share computed once: d'Alembert's principle with
 * the sums over inertial terms nested.
 *
 *     M_ij = sum w dx/dq_i dy/dq_j,
 *     f_i  = Q_i + sum_e e S(terms where dy/dq_i is e),   S(A) = sum_A w (g - x'')
 *
 * x'' at q'' = 0, itself a nested sum of what the coordinates' motions give. For a tree
 * of N links that is three operations a pair of links that move each other for M, and of
 * the order of N for f.
 *
 * Source  Featherstone, Rigid Body Dynamics Algorithms (2008), chapters 5 and 6, for the
 *         recursions; here they follow from the sets of terms alone.
 */
#include "mech/dynamics/recursive.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/kinematics.h"
#include "mech/dynamics/nested.h"
#include "mech/dynamics/virtual-work.h"
#include "mech/scene/access.h"

bool
qdot_recursive_applies(const qdot_scene *s, const qdot_kinematics *k)
{
    const uint32_t moving = QDOT_HAS_COORD | QDOT_HAS_TIME | QDOT_HAS_VELOCITY;

    for (size_t p = 0; p < k->terms.n; p++)
        if (qdot_mech_holds(s, k->terms.at[p].w) & moving)
            return false;
    return true;
}

/* --- the mass matrix M ---------------------------------------------------------------- */

/* w stays with the factor whose terms are all in the intersection: the product then serves
 * every row or column that moves them. */
static qdot_expr
product_with_weight(qdot_scene *s, qdot_expr w, uint32_t both, const qdot_group *a,
                    const qdot_group *b)
{
    qdot_pool *pool = s->pool;
    qdot_expr x = qdot_hold(pool, a->e), y = qdot_hold(pool, b->e);

    if (both == b->set)
        return qdot_mul(pool, x, qdot_hold(pool, qdot_mul(pool, w, y)));
    if (both == a->set)
        return qdot_mul(pool, qdot_hold(pool, qdot_mul(pool, w, x)), y);
    return qdot_mul(pool, w, qdot_hold(pool, qdot_mul(pool, x, y)));
}

qdot_expr
qdot_recursive_mass(qdot_scene *s, qdot_kinematics *k, size_t i, size_t j)
{
    const qdot_groups *a = &k->dx[i], *b = &k->dy[j];
    qdot_vec(qdot_expr) parts = {0};
    qdot_expr sum = QDOT_NIL;

    for (size_t p = 0; p < a->n; p++)
        for (size_t r = 0; r < b->n; r++) {
            uint32_t both = qdot_kinematics_and(s, k, a->at[p].set, b->at[r].set);
            qdot_expr w;

            if (both == 0)
                continue;
            w = qdot_kinematics_weight(s, k, both);
            if (w == QDOT_NIL ||
                qdot_vec_push(&parts, product_with_weight(s, w, both, &a->at[p], &b->at[r])) !=
                    QDOT_OK) {
                qdot_pool_fail(s->pool);
                goto done;
            }
        }
    sum = qdot_sum(s->pool, parts.n, parts.at);
done:
    qdot_free(parts.at);
    return sum;
}

/* --- the right side f ----------------------------------------------------------------- */

/* A term of x'' as (rest) (velocities): the rest holds no velocity, its sign and rational
 * factor are with the velocities. */
typedef struct {
    qdot_expr rest, motion;
} moving;

static void
split_velocity_factor(qdot_scene *s, qdot_expr term, qdot_expr coefficient, moving *m)
{
    qdot_pool *pool = s->pool;

    *m = (moving){term, coefficient};
    if (qdot_expr_kind(pool, term) == QDOT_PROD) {
        uint32_t n = qdot_expr_count(pool, term);

        m->motion = qdot_mul(pool, coefficient, qdot_expr_arg(pool, term, 0));
        m->rest = QDOT_ONE;
        for (uint32_t i = 1; i + 1 < n; i += 2) {
            qdot_expr x = qdot_pow(pool, qdot_expr_arg(pool, term, i),
                                   qdot_expr_arg(pool, term, i + 1));
            bool moves = qdot_mech_holds(s, x) & QDOT_HAS_VELOCITY;
            qdot_expr *side = moves ? &m->motion : &m->rest;

            *side = qdot_mul(pool, *side, x);
        }
    } else if (qdot_mech_holds(s, term) & QDOT_HAS_VELOCITY) {
        m->motion = qdot_mul(pool, coefficient, term);
        m->rest = QDOT_ONE;
    }
}

/* x'' with the velocities that stand beside one factor collected: both are held, since
 * slopes have the factor too and the other axes the velocities. */
static qdot_expr
collect_velocities(qdot_scene *s, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    bool sum = qdot_expr_kind(pool, e) == QDOT_SUM;
    uint32_t n = sum ? (qdot_expr_count(pool, e) - 1) / 2 : 1, kept = 0;
    moving *at = qdot_calloc(n, sizeof *at);
    qdot_expr total = sum ? qdot_expr_arg(pool, e, 0) : QDOT_ZERO;

    if (!at)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < n && !qdot_pool_failed(pool); i++) {
        moving m;
        uint32_t same = 0;

        split_velocity_factor(s, sum ? qdot_expr_arg(pool, e, 2 * i + 1) : e,
                              sum ? qdot_expr_arg(pool, e, 2 * i + 2) : QDOT_ONE, &m);
        while (same < kept && at[same].rest != m.rest)
            same++;
        if (same == kept)
            at[kept++] = m;
        else
            at[same].motion = qdot_add(pool, at[same].motion, m.motion);
    }
    for (uint32_t i = 0; i < kept && !qdot_pool_failed(pool); i++)
        total = qdot_add(pool, total,
                         qdot_mul(pool, qdot_hold(pool, at[i].rest),
                                  qdot_hold(pool, at[i].motion)));
    qdot_free(at);
    return qdot_pool_failed(pool) ? QDOT_NIL : total;
}

/* Items that the places' accelerations are made of: each group of x'', then gravity along
 * each axis. */
static bool
find_accelerations(qdot_scene *s, const qdot_kinematics *k, qdot_expr *value)
{
    qdot_pool *pool = s->pool;

    for (size_t g = 0; g < k->rest.n; g++)
        value[g] = qdot_neg(pool, collect_velocities(s, k->rest.at[g].e));
    for (uint32_t axis = 0; axis < 3; axis++) {
        qdot_expr field = QDOT_ZERO;

        for (size_t i = 0; i < s->gravities.n; i++)
            if (axis < qdot_mech_dimension(pool, s->gravities.at[i].e))
                field = qdot_add(pool, field,
                                 qdot_mech_component(pool, s->gravities.at[i].e, axis));
        value[k->rest.n + axis] = field;
    }
    return !qdot_pool_failed(pool);
}

/* Find the inertial force w (g - x'') of every inertial term w x' y' of T, where g is gravity. */
static bool
find_inertial_forces(qdot_scene *s, qdot_kinematics *k, qdot_expr *force)
{
    qdot_family f = {.items = k->rest.n + 3, .sets = k->terms.n};
    qdot_expr *value = qdot_calloc(f.items, sizeof *value);
    uint64_t *bits;
    bool done = false;

    f.words = f.items / 64 + 1;
    bits = qdot_calloc(f.sets * f.words + 1, sizeof *bits);
    f.value = value;
    f.bits = bits;
    if (!value || !bits) {
        qdot_pool_fail(s->pool);
    } else if (find_accelerations(s, k, value)) {
        for (size_t item = 0; item < f.items; item++) {
            bool group = item < k->rest.n;
            uint32_t set = group ? k->rest.at[item].set : k->axis_set[item - k->rest.n];

            for (size_t p = 0; p < k->terms.n && value[item] != QDOT_ZERO; p++)
                if (k->bits.at[set * k->words + p / 64] >> p % 64 & 1)
                    bits[p * f.words + item / 64] |= (uint64_t)1 << item % 64;
        }
        done = qdot_nested_sums(s, &f, force);
    }
    for (size_t p = 0; done && p < k->terms.n; p++)
        force[p] = qdot_mul(s->pool, k->terms.at[p].w, force[p]);
    qdot_free(value);
    qdot_free(bits);
    return done && !qdot_pool_failed(s->pool);
}

bool
qdot_recursive_forcing(qdot_scene *s, qdot_kinematics *k, qdot_expr *f)
{
    qdot_pool *pool = s->pool;
    bool ready = qdot_kinematics_rest(s, k) != NULL; /* this call also adds sets of inertial terms to k */
    size_t sets = k->weight.n, n = s->coordinates.n;
    qdot_family family = {.items = k->terms.n, .words = k->words};
    qdot_expr *force = qdot_calloc(k->terms.n + 1, sizeof *force);
    qdot_expr *sum = qdot_calloc(sets + 1, sizeof *sum);
    uint32_t *number = qdot_calloc(sets + 1, sizeof *number); /* [sets] index + 1 of the sum over each set */
    uint64_t *bits = qdot_calloc(sets * k->words + 1, sizeof *bits);

    if (!ready || !force || !sum || !number || !bits) {
        qdot_pool_fail(pool);
        goto done;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t g = 0; g < k->dy[i].n; g++) {
            uint32_t set = k->dy[i].at[g].set;

            if (number[set])
                continue;
            for (size_t w = 0; w < k->words; w++)
                bits[family.sets * k->words + w] = k->bits.at[set * k->words + w];
            number[set] = (uint32_t)++family.sets;
        }
    family.value = force;
    family.bits = bits;
    if (!find_inertial_forces(s, k, force) || !qdot_nested_sums(s, &family, sum))
        goto done;
    for (size_t i = 0; i < n && !qdot_pool_failed(pool); i++) {
        f[i] = qdot_mech_at_rest(s, qdot_force_but_gravity(s, i));
        for (size_t g = 0; g < k->dy[i].n; g++) {
            qdot_group group = k->dy[i].at[g];

            f[i] = qdot_add(pool, f[i],
                            qdot_mul(pool, qdot_hold(pool, group.e),
                                     sum[number[group.set] - 1]));
        }
    }
done:
    qdot_free(force);
    qdot_free(sum);
    qdot_free(number);
    qdot_free(bits);
    return !qdot_pool_failed(pool);
}
