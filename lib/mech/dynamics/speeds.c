/* speeds.c -- equations of motion in quasi-velocities. */
#include "mech/dynamics/speeds.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/freedom.h"
#include "mech/dynamics/lagrange.h"
#include "mech/dynamics/mass-matrix.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "normal/field/normal-form.h"
#include "normal/simplify/relative.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/linear.h"

/* With a coordinate-free right side the sums on the left sides of holonomic constraints are known: x^2 + y^2 is l^2. */
static qdot_expr
insert_constraints(qdot_scene *s, qdot_expr e)
{
    for (size_t k = 0; k < s->constraints.n && e != QDOT_NIL; k++) {
        const qdot_constraint *c = &s->constraints.at[k];

        if (c->kind == QDOT_HOLONOMIC && qdot_expr_kind(s->pool, c->left) == QDOT_SUM &&
            !(qdot_mech_holds(s, c->right) & (QDOT_HAS_COORD | QDOT_HAS_TIME)))
            e = qdot_subs(s->pool, e, 1, &c->left, &c->right);
    }
    return e;
}

/* The normal form of e modulo the constraints of positions, simplified: (q.q)^2 is 1 for a unit quaternion. Nil: there are none,
 * or it cannot be found. */
static qdot_expr
reduce_by_constraints(qdot_scene *s, qdot_expr e, const qdot_facts *facts)
{
    qdot_facts known = *facts;
    qdot_expr *f = qdot_calloc(facts->n_relations + s->constraints.n + 1, sizeof *f);
    qdot_expr reduced = QDOT_NIL;

    if (f == NULL)
        return qdot_pool_fail(s->pool);
    known.n_relations = 0;
    for (size_t k = 0; k < s->constraints.n; k++)
        if (s->constraints.at[k].kind == QDOT_HOLONOMIC)
            f[known.n_relations++] = s->constraints.at[k].f;
    if (known.n_relations > 0 && e != QDOT_NIL) {
        for (size_t k = 0; k < facts->n_relations; k++)
            f[known.n_relations++] = facts->relations[k];
        known.relations = f;
        reduced = qdot_normal(s->pool, e, &known);
        reduced = reduced == QDOT_NIL ? reduced : qdot_simplify(s->pool, reduced, facts);
    }
    qdot_free(f);
    return reduced;
}

static qdot_expr
shorter_of(const qdot_scene *s, qdot_expr a, qdot_expr b)
{
    return a == QDOT_NIL || (b != QDOT_NIL && qdot_expr_size(s->pool, b) < qdot_expr_size(s->pool, a)) ? b : a;
}

/* e as a person would write it, in differences of angles where that is shorter. */
static qdot_expr
write_short(qdot_scene *s, qdot_expr e)
{
    const qdot_facts facts = qdot_scene_facts(s);
    const qdot_expr relative = qdot_simplify_relative(s->pool, e, &facts);
    qdot_expr shortest = relative;

    if (relative == QDOT_NIL || qdot_expr_size(s->pool, e) < 2 * qdot_expr_size(s->pool, relative))
        shortest = qdot_simplify(s->pool, e, &facts);
    if (relative != QDOT_NIL && shortest != QDOT_NIL)
        shortest = shorter_of(s, shortest, relative);
    e = insert_constraints(s, shortest);
    if (e != shortest)
        e = qdot_simplify(s->pool, e, &facts);
    return shorter_of(s, e, reduce_by_constraints(s, e, &facts));
}

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

/* *factor = de/dq_i', where e is linear in the velocities; `what` says what e is in an error. */
static qdot_status
find_velocity_factor(qdot_scene *s, qdot_expr e, size_t i, const char *what, const char *name, qdot_expr *factor)
{
    *factor = qdot_diff(s->pool, e, qdot_mech_jet(s, i, 1));
    QDOT_TRY(qdot_pool_check(s->pool));
    if (qdot_mech_holds(s, *factor) & (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION))
        *factor = qdot_mech_tidy(s, *factor);
    QDOT_TRY(qdot_pool_check(s->pool));
    if (qdot_mech_holds(s, *factor) & (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION))
        return qdot_fail(QDOT_EINVAL, "%s `%.200s` is not linear in the velocities", what, name);
    return QDOT_OK;
}

qdot_status
qdot_speeds_check_linear(qdot_scene *s, qdot_expr e, const char *name)
{
    qdot_expr factor;

    for (size_t i = 0; i < s->coordinates.n; i++)
        QDOT_TRY(find_velocity_factor(s, e, i, "the speed", name, &factor));
    return QDOT_OK;
}

/* Fill a row of A q' = b from e = right. */
static qdot_status
fill_velocity_row(qdot_scene *s, qdot_expr e, qdot_expr right, const char *what, const char *name, qdot_expr *A, qdot_expr *b)
{
    for (size_t i = 0; i < s->coordinates.n; i++)
        QDOT_TRY(find_velocity_factor(s, e, i, what, name, &A[i]));
    *b = qdot_sub(s->pool, right, without_velocities(s, e));
    return qdot_pool_check(s->pool);
}

/* How many speeds the scene needs. False on failure: the pool keeps it. */
static bool
count_needed(qdot_scene *s, size_t *independent, size_t *needed)
{
    *independent = 0;
    if (!qdot_freedom_independent(s))
        return false;
    for (size_t k = 0; k < s->constraints.n; k++)
        *independent += s->derived->independent[k];
    *needed = s->coordinates.n - s->states.n - *independent;
    return true;
}

bool
qdot_speeds_suffice(qdot_scene *s, size_t n)
{
    size_t independent, needed;

    for (size_t k = 0; k < s->constraints.n; k++)
        if (s->constraints.at[k].kind == QDOT_ACCELERATION)
            return false;
    return count_needed(s, &independent, &needed) && n == needed;
}

/* QDOT_EINVAL where speeds and constraints are not as many as coordinates. */
static qdot_status
need_number_of_speeds(qdot_scene *s, const qdot_speeds *speeds)
{
    size_t independent, needed;

    if (!count_needed(s, &independent, &needed))
        return qdot_pool_check(s->pool);
    if (speeds->n == needed)
        return QDOT_OK;
    return qdot_fail(QDOT_EINVAL, "the speeds are %zu, and %zu are needed: %zu coordinates less %zu independent "
                     "constraints", speeds->n, needed, needed + independent, independent);
}

qdot_status
qdot_speeds_rows(qdot_scene *s, const qdot_speeds *speeds, qdot_expr *A, qdot_expr *b)
{
    const size_t n = s->coordinates.n;
    const bool *independent;
    size_t row = 0;

    QDOT_TRY(need_number_of_speeds(s, speeds));
    independent = qdot_derived_get(s)->independent;
    for (size_t i = 0; i < n * n; i++)
        A[i] = QDOT_ZERO;
    for (size_t i = 0; i < n; i++)
        if (qdot_scene_state_of(s, s->coordinates.at[i]) != NULL) {
            A[row * n + i] = QDOT_ONE;
            b[row++] = QDOT_ZERO;
        }
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

/* Write z' = rate of the first-order unknowns into velocity [n], in terms of the other velocities. */
static qdot_status
insert_rates_of_states(qdot_scene *s, qdot_expr *velocity)
{
    for (size_t k = 0; k < s->states.n; k++) {
        const qdot_state *state = &s->states.at[k];
        qdot_expr rate = state->rate;
        size_t own = 0;

        for (size_t i = 0; i < s->coordinates.n && rate != QDOT_NIL; i++) {
            const qdot_expr jet = qdot_mech_jet(s, i, 1);

            if (s->coordinates.at[i] == state->z)
                own = i;
            rate = qdot_subs(s->pool, rate, 1, &jet, &velocity[i]);
        }
        velocity[own] = qdot_mech_tidy(s, rate);
        QDOT_TRY(qdot_pool_check(s->pool));
    }
    return QDOT_OK;
}

qdot_status
qdot_speeds_kinematics(qdot_scene *s, const qdot_speeds *speeds, qdot_expr *velocity)
{
    const size_t n = s->coordinates.n;
    const qdot_facts facts = qdot_scene_facts(s);
    uint32_t pivot = 0;
    qdot_expr *A = qdot_calloc(n * n + n, sizeof *A);
    qdot_status status;

    if (A == NULL)
        return QDOT_ENOMEM;
    status = qdot_speeds_rows(s, speeds, A, A + n * n);
    for (size_t i = 0; i < n * n + n && status == QDOT_OK; i++) {
        A[i] = qdot_mech_tidy(s, A[i]);
        status = qdot_pool_check(s->pool);
    }
    if (status == QDOT_OK)
        status = qdot_solve_linear(s->pool, (uint32_t)n, A, A + n * n, velocity, &pivot, &facts);
    if (status == QDOT_ESINGULAR)
        status = qdot_fail(QDOT_EINVAL, "the speeds do not determine %.200s'",
                           qdot_expr_symbol(s->pool, s->coordinates.at[pivot])->name);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        velocity[i] = write_short(s, velocity[i]);
        status = qdot_pool_check(s->pool);
    }
    if (status == QDOT_OK)
        status = insert_rates_of_states(s, velocity);
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
    qdot_expr *slope; /* [n * speeds] dq_i'/du_j; 0 of first-order unknowns, on which no force acts */
    qdot_expr *drift; /* [n] q_i'' at u' = 0 */
    qdot_expr *mass;  /* [n * n] M in q, u, t */
    qdot_expr *force; /* [n] f in q, u, t, without its value at rest */
    qdot_expr *still; /* [n] f at rest, q' = 0: weights, springs */
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

            p->slope[i * p->speeds->n + j] = qdot_scene_state_of(s, s->coordinates.at[i]) != NULL
                                                 ? QDOT_ZERO
                                                 : qdot_diff(pool, p->velocity[i], p->speeds->symbol[j]);
            drift = qdot_subs(pool, drift, 1, &from, &to);
        }
        p->drift[i] = in_speeds(p, drift);
        p->force[i] = qdot_lagrange_people_forcing(s, i);
        p->still[i] = without_velocities(s, p->force[i]);
        p->force[i] = in_speeds(p, qdot_sub(pool, p->force[i], p->still[i]));
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

/* The right side: forces at rest apart from what moves, or both together where that is shorter. */
static qdot_expr
write_right_side(qdot_scene *s, qdot_expr moving, qdot_expr still)
{
    enum { SHORT = 400 };
    const qdot_expr apart = qdot_add(s->pool, write_short(s, moving), write_short(s, still));

    if (still == QDOT_ZERO || apart == QDOT_NIL || qdot_expr_size(s->pool, apart) > SHORT)
        return apart;
    return shorter_of(s, write_short(s, qdot_add(s->pool, moving, still)), apart);
}

static qdot_expr
equation_of_speed(const projection *p, size_t j)
{
    qdot_pool *pool = p->s->pool;
    qdot_expr left = QDOT_ZERO, moving = qdot_neg(pool, project(p, j, p->drift, 1)), still = QDOT_ZERO;

    for (size_t k = 0; k < p->speeds->n; k++) {
        const qdot_expr m = write_short(p->s, project(p, j, p->slope + k, p->speeds->n));

        left = qdot_add(pool, left, qdot_mul(pool, m, qdot_symbol_jet(pool, p->speeds->symbol[k], 1)));
    }
    for (size_t i = 0; i < p->n; i++) {
        const qdot_expr b = p->slope[i * p->speeds->n + j];

        moving = qdot_add(pool, moving, qdot_mul(pool, b, p->force[i]));
        still = qdot_add(pool, still, qdot_mul(pool, b, p->still[i]));
    }
    return qdot_pool_failed(pool) ? QDOT_NIL : qdot_rel(pool, QDOT_EQ, left, write_right_side(p->s, moving, still));
}

qdot_status
qdot_speeds_equations(qdot_scene *s, const qdot_speeds *speeds, const qdot_expr *velocity, qdot_expr *equation)
{
    const size_t n = s->coordinates.n, m = speeds->n;
    projection p = {.s = s, .speeds = speeds, .velocity = velocity, .n = n};
    qdot_status status;

    p.jets = qdot_calloc(4 * n + n * m + n * n + 1, sizeof *p.jets);
    if (p.jets == NULL)
        return QDOT_ENOMEM;
    p.drift = p.jets + n;
    p.force = p.drift + n;
    p.still = p.force + n;
    p.slope = p.still + n;
    p.mass = p.slope + n * m;
    status = fill_projection(&p);
    for (size_t j = 0; j < m && status == QDOT_OK; j++) {
        equation[j] = equation_of_speed(&p, j);
        status = qdot_pool_check(s->pool);
    }
    qdot_free(p.jets);
    return status;
}

qdot_status
qdot_speeds_rates(qdot_scene *s, const qdot_speeds *speeds, const qdot_expr *equation, qdot_expr *rate)
{
    const size_t m = speeds->n;
    const qdot_facts facts = qdot_scene_facts(s);
    uint32_t pivot = 0;
    qdot_expr *A = qdot_calloc(m * m + m + 1, sizeof *A), *b = A == NULL ? NULL : A + m * m;
    qdot_status status = A == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t j = 0; j < m && status == QDOT_OK; j++) {
        const qdot_expr left = qdot_expr_arg(s->pool, equation[j], 0);

        for (size_t k = 0; k < m; k++)
            A[j * m + k] = qdot_diff(s->pool, left, qdot_symbol_jet(s->pool, speeds->symbol[k], 1));
        b[j] = qdot_expr_arg(s->pool, equation[j], 1);
        status = qdot_pool_check(s->pool);
    }
    if (status == QDOT_OK)
        status = qdot_solve_linear(s->pool, (uint32_t)m, A, b, rate, &pivot, &facts);
    if (status == QDOT_ESINGULAR)
        status = qdot_fail(QDOT_ESINGULAR, "no mass moves with the speed %.200s",
                           qdot_expr_symbol(s->pool, speeds->symbol[pivot])->name);
    for (size_t k = 0; k < m && status == QDOT_OK; k++) {
        rate[k] = write_short(s, rate[k]);
        status = qdot_pool_check(s->pool);
    }
    qdot_free(A);
    return status;
}

/* --- kept results ------------------------------------------------------------------------- */

static bool
are_kept(const qdot_derived *d, const qdot_speeds *speeds)
{
    bool same = d->speeds != NULL && d->n_speeds == speeds->n;

    for (size_t k = 0; same && k < speeds->n; k++)
        same = d->speeds[k] == speeds->symbol[k] && d->speeds[speeds->n + k] == speeds->value[k];
    return same;
}

qdot_status
qdot_speeds_motion(qdot_scene *s, const qdot_speeds *speeds, const qdot_expr **velocity, const qdot_expr **equation)
{
    const size_t n = s->coordinates.n, m = speeds->n;
    qdot_derived *d = qdot_derived_get(s);
    qdot_expr *all;
    qdot_status status;

    if (!are_kept(d, speeds)) {
        all = qdot_calloc(3 * m + n + 1, sizeof *all);
        if (all == NULL)
            return QDOT_ENOMEM;
        for (size_t k = 0; k < m; k++) {
            all[k] = speeds->symbol[k];
            all[m + k] = speeds->value[k];
        }
        status = qdot_speeds_kinematics(s, speeds, all + 3 * m);
        if (status == QDOT_OK)
            status = qdot_speeds_equations(s, speeds, all + 3 * m, all + 2 * m);
        if (status != QDOT_OK) {
            qdot_free(all);
            return status;
        }
        qdot_free(d->speeds);
        d->speeds = all;
        d->n_speeds = m;
    }
    *equation = d->speeds + 2 * m;
    *velocity = d->speeds + 3 * m;
    return QDOT_OK;
}

/* --- a scene of states ----------------------------------------------------------------- */

static qdot_status
add_states(const qdot_scene *s, const qdot_speeds *speeds, const qdot_expr *velocity, const qdot_expr *rate, qdot_scene *to)
{
    const size_t n = s->coordinates.n;

    for (size_t i = 0; i < n + speeds->n; i++)
        QDOT_TRY(qdot_scene_state(to, i < n ? s->coordinates.at[i] : speeds->symbol[i - n], QDOT_NIL));
    for (size_t i = 0; i < n + speeds->n; i++)
        QDOT_TRY(i < n ? qdot_scene_state(to, s->coordinates.at[i], velocity[i])
                       : qdot_scene_state(to, speeds->symbol[i - n], rate[i - n]));
    for (size_t i = 0; i < s->inputs.n; i++)
        QDOT_TRY(qdot_scene_input(to, s->inputs.at[i]));
    return QDOT_OK;
}

qdot_status
qdot_speeds_scene(qdot_scene *s, const qdot_speeds *speeds, qdot_scene **states)
{
    const qdot_expr *velocity, *equation;
    qdot_expr *rate = qdot_calloc(speeds->n + 1, sizeof *rate);
    qdot_status status;

    *states = qdot_scene_new(s->pool);
    status = rate == NULL || *states == NULL ? QDOT_ENOMEM : qdot_speeds_motion(s, speeds, &velocity, &equation);
    if (status == QDOT_OK)
        status = qdot_speeds_rates(s, speeds, equation, rate);
    if (status == QDOT_OK)
        status = add_states(s, speeds, velocity, rate, *states);
    if (status != QDOT_OK) {
        qdot_scene_free(*states);
        *states = NULL;
    }
    qdot_free(rate);
    return status;
}
