/* virtual-work.c -- generalized forces.
 *
 *     delta W = sum F . delta r = sum_j Q_j delta q_j,
 *     Q_j = sum F . dr/dq_j = sum F . dv/dq_j'      (Kane's form; both are computed)
 *
 * At the material of a body that is at the place P just then, F . dv/dq_j' with
 * v = r' + omega x (P - r): what rides along is the body, not P.
 *
 * A potential that may hold velocities gives -dV/dq + d/dt dV/dq'; a damper pulls with -c
 * d' along its line: Q_j = -c d' dd/dq_j = -c (u.u') (u.du/dq_j) / u.u, u between the
 * ends.
 */
#include "mech/dynamics/virtual-work.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "mech/dynamics/alike.h"
#include "mech/dynamics/kinematics.h"
#include "mech/dynamics/long-sum.h"
#include "mech/dynamics/multiplier-forces.h"
#include "mech/dynamics/potential.h"
#include "mech/dynamics/ostrogradsky.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/scene/body.h"

/* dr/dq_i of a position r, or, in Kane's form, dv/dq_i' of its velocity. */
static qdot_expr
partial_position(qdot_scene *s, qdot_expr r, size_t i, bool kane)
{
    if (kane)
        return qdot_diff(s->pool, qdot_ddt(s->pool, r), qdot_mech_jet(s, i, 1));
    return qdot_diff(s->pool, r, s->coordinates.at[i]);
}

/* The generalized force of gravity on coordinate i: the sum of m g . dr/dq over all masses. */
static qdot_expr
gravity_force(qdot_scene *s, size_t k, size_t i, bool kane)
{
    qdot_pool *pool = s->pool;
    qdot_kinematics *kin;
    qdot_expr Q;

    (void)k;
    if (kane) {
        Q = QDOT_ZERO;
        for (size_t p = 0; p < s->particles.n + s->bodies.n; p++) {
            const qdot_massive one = qdot_scene_massive(s, p);
            qdot_expr v = partial_position(s, one.position, i, true);

            for (size_t g = 0; g < s->gravities.n; g++)
                Q = qdot_add(
                    pool, Q,
                    qdot_mul(pool, one.mass, qdot_mech_dot(pool, s->gravities.at[g].e, v)));
        }
    } else {
        kin = qdot_kinematics_get(s);
        if (!kin)
            return QDOT_NIL;
        Q = qdot_kinematics_gravity(s, kin, &kin->dx[i]);
    }
    /* if a mass depends on q, V = -m g.r also contributes a force through dm/dq */
    for (size_t p = 0; p < s->particles.n + s->bodies.n; p++) {
        const qdot_massive one = qdot_scene_massive(s, p);
        qdot_expr slope;

        if (!(qdot_mech_holds(s, one.mass) & QDOT_HAS_COORD))
            continue;
        slope = qdot_diff(pool, one.mass, s->coordinates.at[i]);
        for (size_t g = 0; g < s->gravities.n; g++)
            Q = qdot_add(
                pool, Q,
                qdot_mul(pool, slope, qdot_mech_dot(pool, s->gravities.at[g].e, one.position)));
    }
    return Q;
}

static qdot_expr
force_of_potential(qdot_scene *s, qdot_expr V, size_t i, bool kane)
{
    qdot_pool *pool = s->pool;
    qdot_expr v = qdot_mech_jet(s, i, 1);

    if (qdot_mech_holds(s, V) & QDOT_HAS_VELOCITY)
        return qdot_sub(pool, qdot_ddt(pool, qdot_diff(pool, V, v)),
                        qdot_diff(pool, V, s->coordinates.at[i]));
    return qdot_neg(pool, partial_position(s, qdot_long_sum_with(s, V, i), i, kane));
}

static qdot_expr
potential_force(qdot_scene *s, size_t k, size_t i, bool kane)
{
    return force_of_potential(s, s->potentials.at[k].e, i, kane);
}

/* The generalized force on q_i of a spring or damper that pulls along u: -pull u.du/dq_i. */
static qdot_expr
force_along_link(qdot_scene *s, const qdot_link *link, size_t i, bool kane)
{
    qdot_expr u = qdot_value_sub(s->pool, link->at[0], link->at[1]);

    return qdot_mech_dot(s->pool, u, partial_position(s, u, i, kane));
}

static qdot_expr
spring_force(qdot_scene *s, size_t k, size_t i, bool kane)
{
    qdot_pool *pool = s->pool;
    const qdot_link *spring = &s->springs.at[k];
    qdot_expr d, pull = spring->stiffness;

    if ((qdot_mech_holds(s, spring->stiffness) | qdot_mech_holds(s, spring->rest)) &
        QDOT_HAS_COORD)
        return force_of_potential(s, qdot_spring_potential(s, k), i, kane);
    if (!kane)
        return qdot_neg(
            pool, qdot_diff(pool, qdot_spring_potential(s, k), s->coordinates.at[i]));
    if (spring->rest != QDOT_ZERO) {
        d = qdot_sqrt(pool, qdot_link_square(s, false, k));
        pull = qdot_mul(pool, pull,
                        qdot_sub(pool, QDOT_ONE, qdot_div(pool, spring->rest, d)));
    }
    return qdot_neg(pool, qdot_mul(pool, pull, force_along_link(s, spring, i, true)));
}

/* Half of e, for a sum term by term, so that factors 2 from differentiated squares cancel. */
static qdot_expr
halve_terms(qdot_pool *pool, qdot_expr e)
{
    qdot_expr sum;

    if (e == QDOT_NIL || qdot_expr_kind(pool, e) != QDOT_SUM)
        return qdot_mul(pool, QDOT_HALF, e);
    sum = qdot_mul(pool, QDOT_HALF, qdot_expr_arg(pool, e, 0));
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2)
        sum = qdot_add(pool, sum,
                       qdot_mul(pool,
                                qdot_mul(pool, QDOT_HALF, qdot_expr_arg(pool, e, i + 1)),
                                qdot_expr_arg(pool, e, i)));
    return sum;
}

static qdot_expr
damper_force(qdot_scene *s, size_t k, size_t i, bool kane)
{
    qdot_pool *pool = s->pool;
    const qdot_link *damper = &s->dampers.at[k];
    qdot_expr square, u, rate, slope = force_along_link(s, damper, i, kane);

    if (slope == QDOT_ZERO || slope == QDOT_NIL)
        return slope;
    if (qdot_mech_dimension(pool, damper->at[0]) == 1) {
        u = qdot_sub(pool, damper->at[0], damper->at[1]);
        rate = qdot_mul(pool, qdot_ddt(pool, u), partial_position(s, u, i, kane));
        return qdot_neg(pool, qdot_mul(pool, damper->stiffness, rate));
    }
    /* u.u is simplified; u.u' and u.du/dq are half its derivatives */
    square = qdot_link_square(s, true, k);
    rate = halve_terms(pool, qdot_ddt(pool, square));
    if (!kane)
        slope = halve_terms(pool, qdot_diff(pool, square, s->coordinates.at[i]));
    return qdot_neg(pool, qdot_mul(pool, damper->stiffness,
                                   qdot_div(pool, qdot_mul(pool, rate, slope), square)));
}

static qdot_expr
dissipation_force(qdot_scene *s, size_t k, size_t i, bool kane)
{
    (void)kane;
    return qdot_neg(s->pool,
                    qdot_diff(s->pool, s->dissipations.at[k].e, qdot_mech_jet(s, i, 1)));
}

/* The generalized force on q_i of a force; on a material point, dr/dq_i is that of the body's motion only. */
static qdot_expr
applied_force(qdot_scene *s, size_t k, size_t i, bool kane)
{
    const qdot_force *f = &s->forces.at[k];
    qdot_expr v;

    if (!f->material)
        return qdot_mech_dot(s->pool, f->force, partial_position(s, f->point, i, kane));
    v = kane ? qdot_diff(s->pool, qdot_scene_velocity(s, f->on, f->point),
                         qdot_mech_jet(s, i, 1))
             : qdot_body_partial_velocity(s, qdot_scene_find_body(s, f->on), f->point,
                                          s->coordinates.at[i]);
    return qdot_mech_dot(s->pool, f->force, v);
}

static qdot_expr
torque_force(qdot_scene *s, size_t k, size_t i, bool kane)
{
    const qdot_torque *torque = &s->torques.at[k];
    const qdot_body *b;
    qdot_expr slope;

    if (torque->coordinate != QDOT_NIL)
        return torque->coordinate == s->coordinates.at[i] ? torque->torque : QDOT_ZERO;
    b = &s->bodies.at[torque->body];
    slope = kane ? qdot_diff(s->pool, qdot_body_spin(s, b), qdot_mech_jet(s, i, 1))
                 : qdot_body_partial_spin(s, b, s->coordinates.at[i]);
    return qdot_mech_dot(s->pool, torque->torque, slope);
}

/* --- sources of generalized forces, as answers name them ------------------------------ */

static size_t
count_gravity_sources(const qdot_scene *s)
{
    return s->gravities.n && s->particles.n + s->bodies.n;
}

#define COUNT(list)                                                                      \
    static size_t count_##list(const qdot_scene *s)                                      \
    {                                                                                    \
        return s->list.n;                                                                \
    }
COUNT(potentials)
COUNT(springs)
COUNT(dampers)
COUNT(dissipations)
COUNT(forces)
COUNT(torques)

#define NAME(what)                                                                       \
    static const char *what##_name(const qdot_scene *s, size_t k)                        \
    {                                                                                    \
        return s->what##s.at[k].name;                                                    \
    }
NAME(potential)
NAME(dissipation)
NAME(spring)
NAME(damper)

/* The label of gravity if there is a single field; several fields act together as one source. */
static const char *
label_of_gravity(const qdot_scene *s, size_t k)
{
    return s->gravities.n == 1 ? s->gravities.at[k].name : NULL;
}

static const char *
label_of_force(const qdot_scene *s, size_t k)
{
    return s->forces.at[k].name ? s->forces.at[k].name : s->forces.at[k].on;
}

static const char *
label_of_torque(const qdot_scene *s, size_t k)
{
    const qdot_torque *t = &s->torques.at[k];

    return t->name                     ? t->name
           : t->coordinate != QDOT_NIL ? qdot_expr_symbol(s->pool, t->coordinate)->name
                                       : s->bodies.at[t->body].name;
}

/* Define a function that gives the name by which an answer calls the k-th thing of a kind. */
#define CALLED(list, word)                                                               \
    static const char *list##_words(const qdot_scene *s, size_t k)                       \
    {                                                                                    \
        (void)s, (void)k;                                                                \
        return word;                                                                     \
    }
CALLED(gravity, "gravity")
CALLED(potential, "potential")
CALLED(spring, "spring")
CALLED(damper, "damper")
CALLED(dissipation, "dissipation")
CALLED(force, "force")
#undef CALLED

static const char *
words_for_torque(const qdot_scene *s, size_t k)
{
    return s->torques.at[k].force ? "force" : "torque";
}

static const struct {
    const char *(*words)(const qdot_scene *s, size_t k);
    bool conservative; /* the force is contained in L if L = T - V */
    size_t (*count)(const qdot_scene *s);
    qdot_expr (*force)(qdot_scene *s, size_t k, size_t i, bool kane);
    const char *(*name)(const qdot_scene *s, size_t k);
} sources[] = {
    {gravity_words, true, count_gravity_sources, gravity_force, label_of_gravity},
    {potential_words, true, count_potentials, potential_force, potential_name},
    {spring_words, true, count_springs, spring_force, spring_name},
    {damper_words, false, count_dampers, damper_force, damper_name},
    {dissipation_words, false, count_dissipations, dissipation_force, dissipation_name},
    {force_words, false, count_forces, applied_force, label_of_force},
    {words_for_torque, false, count_torques, torque_force, label_of_torque},
};
enum { SOURCES = sizeof sources / sizeof *sources };

/* The generalized force on q_i of the k-th source in row a, with the values of multipliers that it holds put in. */
static qdot_expr
source_force(qdot_scene *s, size_t a, size_t k, size_t i, bool kane)
{
    return qdot_without_multipliers(s, sources[a].force(s, k, i, kane));
}

qdot_expr
qdot_force_of_state(qdot_scene *s, size_t i)
{
    const qdot_state *state = s->states.n ? qdot_scene_state_of(s, s->coordinates.at[i]) : NULL;

    return state ? qdot_sub(s->pool, state->rate, qdot_mech_jet(s, i, 1)) : QDOT_NIL;
}

/* What is given along coordinate i instead of the declared forces: of a state its equation, where the Lagrangian holds higher
 * derivatives theirs. Nil: nothing. */
static qdot_expr
given_force(qdot_scene *s, size_t i)
{
    const qdot_expr Q = qdot_force_of_state(s, i);

    return Q == QDOT_NIL && s->higher.n > 0 ? qdot_ostrogradsky_force(s, i) : Q;
}

/* The sum of all declared sources. */
static qdot_expr
sum_of_sources(qdot_scene *s, size_t i, bool people, bool applied, bool kane)
{
    qdot_pool *pool = s->pool;
    qdot_expr Q = QDOT_ZERO;
    size_t parts = 0;

    for (size_t a = 0; a < SOURCES; a++) {
        if (applied && sources[a].conservative)
            continue;
        for (size_t k = 0; k < sources[a].count(s); k++) {
            qdot_expr part = source_force(s, a, k, i, kane);

            if (part == QDOT_ZERO)
                continue;
            Q = qdot_add(pool, Q, people ? qdot_mech_alike(s, part) : part);
            parts++;
        }
    }
    return people && parts > 1 ? qdot_mech_alike(s, Q) : Q;
}

static qdot_expr
total_force(qdot_scene *s, size_t i, bool people, bool applied, bool kane)
{
    const qdot_expr Q = given_force(s, i);

    return Q != QDOT_NIL || qdot_pool_failed(s->pool) ? Q : sum_of_sources(s, i, people, applied, kane);
}

qdot_expr
qdot_mech_sources(qdot_scene *s, size_t i)
{
    return sum_of_sources(s, i, true, false, false);
}

qdot_expr
qdot_force_total(qdot_scene *s, size_t i, bool people, bool applied)
{
    return total_force(s, i, people, applied, false);
}

qdot_expr
qdot_force_but_gravity(qdot_scene *s, size_t i)
{
    qdot_expr Q = given_force(s, i);

    if (Q != QDOT_NIL || qdot_pool_failed(s->pool))
        return Q;
    Q = QDOT_ZERO;
    for (size_t a = 0; a < SOURCES; a++)
        for (size_t k = 0; sources[a].force != gravity_force && k < sources[a].count(s);
             k++)
            Q = qdot_add(s->pool, Q, source_force(s, a, k, i, false));
    return Q;
}

qdot_expr
qdot_force_declared(qdot_scene *s, size_t i)
{
    qdot_expr Q = QDOT_ZERO;

    for (size_t k = 0; k < s->forces.n; k++)
        Q = qdot_add(s->pool, Q, qdot_without_multipliers(s, applied_force(s, k, i, false)));
    for (size_t k = 0; k < s->torques.n; k++)
        Q = qdot_add(s->pool, Q, qdot_without_multipliers(s, torque_force(s, k, i, false)));
    return Q;
}

/* --- the functions of quantity.h ------------------------------------------------------ */

qdot_expr
qdot_mech_force(qdot_scene *s, qdot_expr q)
{
    qdot_derived *d;
    size_t i;

    if (!qdot_mech_index(s, q, &i))
        return QDOT_NIL;
    d = qdot_derived_get(s);
    if (!qdot_derived_array(s, &d->force, d->n))
        return QDOT_NIL;
    if (d->force[i] != QDOT_NIL)
        return d->force[i];
    if (qdot_scene_state_of(s, q))
        return d->force[i] = QDOT_ZERO;
    return d->force[i] = total_force(s, i, true, false, false);
}

qdot_expr
qdot_mech_force_kane(qdot_scene *s, qdot_expr q)
{
    size_t i;

    if (!qdot_mech_index(s, q, &i))
        return QDOT_NIL;
    return total_force(s, i, true, false, true);
}

qdot_expr
qdot_mech_forces(qdot_scene *s)
{
    return qdot_mech_each(s, s->coordinates.n, qdot_mech_force);
}

bool
qdot_mech_source_at(qdot_scene *s, size_t k, qdot_force_source *source)
{
    for (size_t a = 0; a < SOURCES; a++) {
        const size_t n = sources[a].count(s);

        if (k < n) {
            *source = (qdot_force_source){.kind = sources[a].words(s, k),
                                    .name = sources[a].name(s, k),
                                    .conservative = sources[a].conservative,
                                    .row = a,
                                    .k = k};
            return true;
        }
        k -= n;
    }
    return false;
}

qdot_expr
qdot_mech_source_force(qdot_scene *s, const qdot_force_source *source, qdot_expr q)
{
    size_t i;

    if (!qdot_mech_index(s, q, &i))
        return QDOT_NIL;
    return qdot_mech_tidy(s, source_force(s, source->row, source->k, i, false));
}

qdot_expr
qdot_mech_virtual_work(qdot_scene *s)
{
    qdot_expr W = QDOT_ZERO;

    for (size_t i = 0; i < s->coordinates.n; i++) {
        qdot_expr q = s->coordinates.at[i];

        W = qdot_add(s->pool, W,
                     qdot_mul(s->pool, qdot_mech_force(s, q),
                              qdot_symbol_of(s->pool, QDOT_DELTA, q)));
    }
    return W;
}
