/* speeds.c -- equations of motion in quasi-velocities. */
#include "mech/dynamics/speeds.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/dynamics/freedom.h"
#include "mech/dynamics/lagrange.h"
#include "mech/dynamics/mass-matrix.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/linear.h"

/* e with every velocity q' set to 0. */
static qdot_expr
without_velocities(qdot_scene *s, qdot_expr e)
{
    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr from = qdot_mech_jet(s, i, 1), to = QDOT_ZERO;

        e = qdot_subs(s->pool, e, 1, &from, &to);
    }
    return e;
}

/* --- q' of the speeds ------------------------------------------------------------------ */

/* Fill a row of A q' = b from e = right, where e is linear in the velocities; `what` says what e is in an error. */
static qdot_status
fill_velocity_row(qdot_scene *s, qdot_expr e, qdot_expr right, const char *what, const char *name, qdot_expr *A, qdot_expr *b)
{
    for (size_t i = 0; i < s->coordinates.n; i++) {
        A[i] = qdot_mech_tidy(s, qdot_diff(s->pool, e, qdot_mech_jet(s, i, 1)));
        QDOT_TRY(qdot_pool_check(s->pool));
        if (qdot_mech_holds(s, A[i]) & (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION))
            return qdot_fail(QDOT_EINVAL, "%s `%.200s` is not linear in the velocities", what, name);
    }
    *b = qdot_mech_tidy(s, qdot_sub(s->pool, right, without_velocities(s, e)));
    return qdot_pool_check(s->pool);
}

static qdot_status
fill_rows(qdot_scene *s, const qdot_speeds *speeds, qdot_expr *A, qdot_expr *b)
{
    const size_t n = s->coordinates.n;
    const bool *independent = qdot_derived_get(s)->independent;
    size_t row = 0;

    for (size_t k = 0; k < speeds->n; k++, row++)
        QDOT_TRY(fill_velocity_row(s, speeds->value[k], speeds->symbol[k], "the speed",
                                   qdot_expr_symbol(s->pool, speeds->symbol[k])->name, A + row * n, b + row));
    for (size_t k = 0; k < s->constraints.n; k++) {
        const qdot_constraint *c = &s->constraints.at[k];

        if (!independent[k])
            continue;
        if (c->kind == QDOT_ACCELERATION)
            return qdot_fail(QDOT_EINVAL, "constraint %.200s is one of accelerations: it leaves no choice of speeds", c->name);
        QDOT_TRY(fill_velocity_row(s, c->kind == QDOT_HOLONOMIC ? qdot_ddt(s->pool, c->f) : c->f, QDOT_ZERO, "constraint",
                                   c->name, A + row * n, b + row));
        row++;
    }
    return QDOT_OK;
}

qdot_status
qdot_speeds_kinematics(qdot_scene *s, const qdot_speeds *speeds, qdot_expr *velocity)
{
    const size_t n = s->coordinates.n;
    const qdot_facts facts = qdot_scene_facts(s);
    size_t independent = 0;
    uint32_t pivot = 0;
    qdot_expr *A;
    qdot_status status;

    if (!qdot_freedom_independent(s))
        return qdot_pool_check(s->pool);
    for (size_t k = 0; k < s->constraints.n; k++)
        independent += s->derived->independent[k];
    if (speeds->n + independent != n)
        return qdot_fail(QDOT_EINVAL, "the speeds are %zu, and %zu are needed: %zu coordinates less %zu independent "
                         "constraints", speeds->n, n - independent, n, independent);
    A = qdot_calloc(n * n + n, sizeof *A);
    if (A == NULL)
        return QDOT_ENOMEM;
    status = fill_rows(s, speeds, A, A + n * n);
    if (status == QDOT_OK)
        status = qdot_solve_linear(s->pool, (uint32_t)n, A, A + n * n, velocity, &pivot, &facts);
    if (status == QDOT_ESINGULAR)
        status = qdot_fail(QDOT_EINVAL, "the speeds do not determine %.200s'",
                           qdot_expr_symbol(s->pool, s->coordinates.at[pivot])->name);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        velocity[i] = qdot_simplify(s->pool, velocity[i], &facts);
        status = qdot_pool_check(s->pool);
    }
    qdot_free(A);
    return status;
}

/* --- u' of the speeds ------------------------------------------------------------------ */

typedef struct {
    qdot_scene *s;
    const qdot_speeds *speeds;
    const qdot_expr *velocity;
    size_t n;
    qdot_expr *jets;  /* [n] the symbols q' */
    qdot_expr *slope; /* [n * speeds] dq_i'/du_j */
    qdot_expr *drift; /* [n] q_i'' at u' = 0 */
    qdot_expr *mass;  /* [n * n] M in q, u, t */
    qdot_expr *force; /* [n] f in q, u, t */
} projection;

static qdot_expr
in_speeds(const projection *p, qdot_expr e)
{
    return qdot_subs(p->s->pool, e, p->n, p->jets, p->velocity);
}

static qdot_status
fill_projection(projection *p)
{
    qdot_scene *s = p->s;
    qdot_pool *pool = s->pool;

    for (size_t i = 0; i < p->n; i++)
        p->jets[i] = qdot_mech_jet(s, i, 1);
    for (size_t i = 0; i < p->n; i++) {
        qdot_expr drift = qdot_ddt(pool, p->velocity[i]);

        for (size_t j = 0; j < p->speeds->n; j++) {
            const qdot_expr from = qdot_symbol_jet(pool, p->speeds->symbol[j], 1), to = QDOT_ZERO;

            p->slope[i * p->speeds->n + j] = qdot_diff(pool, p->velocity[i], p->speeds->symbol[j]);
            drift = qdot_subs(pool, drift, 1, &from, &to);
        }
        p->drift[i] = qdot_mech_tidy(s, in_speeds(p, drift));
        p->force[i] = in_speeds(p, qdot_lagrange_people_forcing(s, i));
        for (size_t l = i; l < p->n; l++)
            p->mass[i * p->n + l] = p->mass[l * p->n + i] = in_speeds(p, qdot_mass_of_lagrangian(s, i, l));
    }
    return qdot_pool_check(pool);
}

/* sum_il b_ij M_il a_l for a column a [n], of stride `stride`. */
static qdot_expr
project(const projection *p, size_t j, const qdot_expr *a, size_t stride)
{
    qdot_pool *pool = p->s->pool;
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < p->n; i++)
        for (size_t l = 0; l < p->n; l++) {
            const qdot_expr factors[] = {p->slope[i * p->speeds->n + j], p->mass[i * p->n + l], a[l * stride]};

            sum = qdot_add(pool, sum, qdot_product(pool, 3, factors));
        }
    return sum;
}

static qdot_expr
equation_of_speed(const projection *p, size_t j)
{
    qdot_pool *pool = p->s->pool;
    const qdot_facts facts = qdot_scene_facts(p->s);
    qdot_expr left = QDOT_ZERO, right = qdot_neg(pool, project(p, j, p->drift, 1));

    for (size_t k = 0; k < p->speeds->n; k++) {
        const qdot_expr m = qdot_simplify(pool, project(p, j, p->slope + k, p->speeds->n), &facts);

        left = qdot_add(pool, left, qdot_mul(pool, m, qdot_symbol_jet(pool, p->speeds->symbol[k], 1)));
    }
    for (size_t i = 0; i < p->n; i++)
        right = qdot_add(pool, right, qdot_mul(pool, p->slope[i * p->speeds->n + j], p->force[i]));
    return qdot_pool_failed(pool) ? QDOT_NIL : qdot_rel(pool, QDOT_EQ, left, qdot_simplify(pool, right, &facts));
}

qdot_status
qdot_speeds_equations(qdot_scene *s, const qdot_speeds *speeds, const qdot_expr *velocity, qdot_expr *equation)
{
    const size_t n = s->coordinates.n, m = speeds->n;
    projection p = {.s = s, .speeds = speeds, .velocity = velocity, .n = n};
    qdot_status status;

    p.jets = qdot_calloc(3 * n + n * m + n * n + 1, sizeof *p.jets);
    if (p.jets == NULL)
        return QDOT_ENOMEM;
    p.drift = p.jets + n;
    p.force = p.drift + n;
    p.slope = p.force + n;
    p.mass = p.slope + n * m;
    status = fill_projection(&p);
    for (size_t j = 0; j < m && status == QDOT_OK; j++) {
        equation[j] = equation_of_speed(&p, j);
        status = qdot_pool_check(s->pool);
    }
    qdot_free(p.jets);
    return status;
}
