/* numeric.c -- M(q, t) q'' = f(q, q', t) for the tape, by d'Alembert's principle:
 *
 *     f_i = Q_i - sum w dy/dq_i x'' at q'' = 0
 *         - sum (w' dy/dq_i x' - 1/2 dw/dq_i x' y')     where a mass varies
 *
 * from the same groups as M, so a chain of N links takes work N^2 and holds N sines and
 * cosines. A small scene may be shorter in its simplified form: both are made and the
 * cheaper is taken.
 */
#include "base/interrupt.h"
#include "expr/calculus.h"
#include "expr/walk.h"
#include "mech/derived.h"
#include "normal/simplify.h"

/* Both forms are made while the raw one has so few coordinates and operations that simplifying
 * takes milliseconds; a rotation in space is long but simplifies well. */
static const struct {
    size_t coordinates;
    uint64_t operations;
} both_forms = {4, 300}, both_forms_in_space = {12, 4000};

static qdot_expr
raw_mass(qdot_scene *s, size_t i, size_t j, qdot_expr V)
{
    qdot_pool *pool = s->pool;
    qdot_expr F = qdot_mech_stated(s) ? s->lagrangian : V, second = QDOT_ZERO;
    qdot_kinematics *k;

    if (F != QDOT_ZERO)
        second = qdot_diff(pool, qdot_diff(pool, F, qdot_mech_jet(s, i, 1)),
                           qdot_mech_jet(s, j, 1));
    if (qdot_mech_stated(s))
        return second;
    k = qdot_kinematics_get(s);
    if (!k)
        return QDOT_NIL;
    return qdot_sub(pool, qdot_kinematics_pair(s, k, &k->dx[i], &k->dy[j], false),
                    second);
}

/* sum (w' dy/dq_i x' - 1/2 dw/dq_i x' y') over the terms whose weight moves. */
static qdot_expr
varying_masses(qdot_scene *s, const qdot_kinematics *k, size_t i)
{
    qdot_pool *pool = s->pool;
    qdot_expr sum = QDOT_ZERO, q = s->coordinates.at[i];

    for (size_t p = 0; p < k->terms.n; p++) {
        qdot_inertial m = k->terms.at[p];
        qdot_expr xdot, a, b;

        if (!(qdot_mech_holds(s, m.w) & (QDOT_HAS_COORD | QDOT_HAS_TIME)))
            continue;
        xdot = qdot_ddt(pool, m.x);
        a = qdot_mul(pool, qdot_ddt(pool, m.w), qdot_diff(pool, m.y, q));
        b = qdot_mul(pool, qdot_diff(pool, m.w, q), qdot_ddt(pool, m.y));
        a = qdot_sub(pool, a, qdot_mul(pool, QDOT_HALF, b));
        sum = qdot_add(pool, sum, qdot_mul(pool, xdot, a));
    }
    return sum;
}

static qdot_expr
raw_forcing(qdot_scene *s, size_t i)
{
    qdot_pool *pool = s->pool;
    qdot_expr Q = qdot_mech_at_rest(s, qdot_force_total(s, i, false, false)), inertia;
    qdot_kinematics *k;

    if (qdot_mech_stated(s))
        return qdot_add(pool, Q, qdot_lagrange_forcing(s, s->lagrangian, i));
    k = qdot_kinematics_get(s);
    if (!k)
        return QDOT_NIL;
    inertia = qdot_kinematics_pair(s, k, &k->dy[i], &k->rest, false);
    inertia = qdot_add(pool, inertia, varying_masses(s, k, i));
    return qdot_sub(pool, Q, inertia);
}

/* What an evaluation costs, common parts once: about a nanosecond a unit. */
static bool
cost(const qdot_scene *s, size_t n, const qdot_expr *e, uint64_t *units)
{
    qdot_walk w;

    *units = 0;
    if (qdot_walk_begin_n(s->pool, n, e, &w) != QDOT_OK) {
        qdot_pool_fail(s->pool);
        return false;
    }
    for (size_t i = 0; i < w.n; i++) {
        const qdot_node *node = qdot_expr_node(s->pool, w.at[i]);

        if (node->kind == QDOT_SUM) {
            *units += node->n / 2;
        } else if (node->kind == QDOT_PROD) {
            *units += node->n / 2;
            for (uint32_t k = 2; k < node->n; k += 2) {
                long power;
                qdot_expr x = qdot_expr_args(s->pool, w.at[i])[k];

                *units += !qdot_expr_to_int(s->pool, x, &power) ? 15 : power < 0 ? 4 : 0;
            }
        } else if (node->kind == QDOT_FUN) {
            *units += 15;
        }
    }
    qdot_walk_end(&w);
    return true;
}

static bool
wants_both(const qdot_scene *s, const qdot_expr *raw, size_t size)
{
    uint64_t operations = 0, most = both_forms.operations;
    size_t n = both_forms.coordinates;

    for (size_t i = 0; i < s->bodies.n; i++)
        if (s->bodies.at[i].angle == QDOT_NIL) {
            n = both_forms_in_space.coordinates;
            most = both_forms_in_space.operations;
        }
    if (s->coordinates.n > n)
        return false;
    for (size_t i = 0; i < size && operations <= most; i++)
        operations += qdot_expr_size(s->pool, raw[i]);
    return operations <= most;
}

static bool
numeric_get(qdot_scene *s)
{
    qdot_pool *pool = s->pool;
    qdot_derived *d = qdot_derived_get(s);
    size_t n = d->n, size = n * n + n;
    qdot_expr *e, *people, V;

    if (d->numeric_mass != QDOT_NIL)
        return true;
    if (n == 0) {
        qdot_mech_fail(s, QDOT_EINVAL, "the scene has no coordinates");
        return false;
    }
    e = qdot_calloc(2 * size, sizeof *e);
    if (!e) {
        qdot_pool_fail(pool);
        return false;
    }
    people = e + size;
    V = qdot_potential_with_velocities(s);
    for (size_t i = 0; i < n && !qdot_pool_failed(pool); i++) {
        if (qdot_interrupt_check() != QDOT_OK) {
            qdot_pool_fail(pool);
            break;
        }
        for (size_t j = i; j < n; j++)
            e[i * n + j] = e[j * n + i] = raw_mass(s, i, j, V);
        e[n * n + i] = raw_forcing(s, i);
    }
    if (!qdot_pool_failed(pool) && wants_both(s, e, size)) {
        uint64_t raw = 0, short_form = 0;

        for (size_t i = 0; i < n; i++) {
            for (size_t j = i; j < n; j++)
                people[i * n + j] = people[j * n + i] = qdot_mass_of_lagrangian(s, i, j);
            people[n * n + i] = qdot_lagrange_people_forcing(s, i);
        }
        if (!qdot_pool_failed(pool) && cost(s, size, e, &raw) &&
            cost(s, size, people, &short_form) && short_form < raw)
            for (size_t i = 0; i < size; i++)
                e[i] = people[i];
    }
    if (!qdot_pool_failed(pool)) {
        d->numeric_mass = qdot_matrix(pool, (uint32_t)n, (uint32_t)n, e);
        d->numeric_forcing = n > 1 ? qdot_vector(pool, (uint32_t)n, e + n * n)
                                   : qdot_list(pool, 1, e + n * n);
    }
    qdot_free(e);
    if (!qdot_pool_failed(pool))
        return true;
    d->numeric_mass = d->numeric_forcing = QDOT_NIL;
    return false;
}

qdot_expr
qdot_mech_numeric_mass(qdot_scene *s)
{
    return numeric_get(s) ? s->derived->numeric_mass : QDOT_NIL;
}

qdot_expr
qdot_mech_numeric_forcing(qdot_scene *s)
{
    return numeric_get(s) ? s->derived->numeric_forcing : QDOT_NIL;
}
