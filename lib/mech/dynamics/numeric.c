/* numeric.c -- M(q, t) q'' = f(q, q', t) for the tape, by d'Alembert's principle:
 *
 *     f_i = Q_i - sum w dy/dq_i x'' at q'' = 0
 *         - sum (w' dy/dq_i x' - 1/2 dw/dq_i x' y')     where a mass varies
 *
 * in the nested sums of recursive.c where no mass varies, else pair by pair. A small scene
 * may be shorter in its simplified form: both are made, for M and for f, and the cheapest
 * of the four together is taken. Friction along a direction u/|u| is read as sign(u) in f
 * (direction.h).
 */
#include <string.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/direction.h"
#include "mech/dynamics/kinematics.h"
#include "mech/dynamics/lagrange.h"
#include "mech/dynamics/mass-matrix.h"
#include "mech/dynamics/potential.h"
#include "mech/dynamics/quantity.h"
#include "mech/dynamics/recursive.h"
#include "mech/dynamics/virtual-work.h"
#include "mech/scene/access.h"

/* Both forms are made while the raw one has so few coordinates and operations that simplifying
 * takes milliseconds; a rotation in space is long but simplifies well. */
static const struct {
    size_t coordinates;
    uint64_t units; /* a limit of the cost of evaluating expressions, in the units of cost() */
} both_forms = {4, 150}, both_forms_in_space = {12, 600};

/* Matrix entries and forces with at most this many operations are simplified one by one, at little cost. */
enum { SHORT_ENTRY = 60 };

/* M_ij of T: simplified where that leaves fewer operations, as along the diagonal of a
 * chain, where it leaves a number; else in shared products. */
static qdot_expr
mass_matrix_entry(qdot_scene *s, qdot_kinematics *k, size_t i, size_t j)
{
    qdot_pool *pool = s->pool;
    qdot_expr plain = qdot_kinematics_pair(s, k, &k->dx[i], &k->dy[j], false), short_form;

    if (!(qdot_mech_holds(s, plain) & (QDOT_HAS_COORD | QDOT_HAS_TIME)))
        return plain;
    if (i == j && qdot_expr_size(pool, plain) <= SHORT_ENTRY) {
        short_form = qdot_kinematics_pair(s, k, &k->dx[i], &k->dy[j], true);
        if (short_form == QDOT_NIL ||
            qdot_expr_size(pool, short_form) < qdot_expr_size(pool, plain))
            return short_form;
    }
    return qdot_recursive_mass(s, k, i, j);
}

static qdot_expr
unsimplified_mass_entry(qdot_scene *s, size_t i, size_t j, qdot_expr V)
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
    return k ? qdot_sub(pool, mass_matrix_entry(s, k, i, j), second) : QDOT_NIL;
}

/* The terms of equation i from inertial terms w x' y' with variable w: sum (w' dy/dq_i x' - 1/2 dw/dq_i x' y'). */
static qdot_expr
terms_of_variable_masses(qdot_scene *s, const qdot_kinematics *k, size_t i)
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
unsimplified_force(qdot_scene *s, size_t i)
{
    qdot_pool *pool = s->pool;
    qdot_expr Q = qdot_mech_at_rest(s, qdot_force_total(s, i, false, false)), inertia;
    const qdot_groups *rest;
    qdot_kinematics *k;

    if (qdot_scene_state_of(s, s->coordinates.at[i]))
        return Q;
    if (qdot_mech_stated(s))
        return qdot_add(pool, Q, qdot_lagrange_forcing(s, s->lagrangian, i));
    k = qdot_kinematics_get(s);
    rest = k ? qdot_kinematics_rest(s, k) : NULL;
    if (!rest)
        return QDOT_NIL;
    inertia = qdot_kinematics_pair(s, k, &k->dy[i], rest, false);
    inertia = qdot_add(pool, inertia, terms_of_variable_masses(s, k, i));
    return qdot_sub(pool, Q, inertia);
}

/* --- the cheaper form ------------------------------------------------------------------ */

/* What a tape of the expressions would cost, about; a call of an elementary function counts
 * for 15 operations. Parameters will be numbers: what holds nothing else costs nothing. */
typedef struct {
    qdot_scene *s;
    uint64_t units;
    qdot_vec(qdot_expr) angles; /* base angles found so far; for each one sine and cosine are computed */
} bill;

static bool
depends_on_motion(const bill *b, qdot_expr e)
{
    return qdot_mech_holds(b->s, e) & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_TIME |
                                       QDOT_HAS_UFUN);
}

/* Whether e has a numerical factor other than -1, or a parameter as factor. */
static bool
has_constant_factor(const bill *b, qdot_expr e)
{
    const qdot_pool *pool = b->s->pool;
    qdot_expr own;

    if (qdot_expr_kind(pool, e) != QDOT_PROD)
        return false;
    own = qdot_expr_arg(pool, e, 0);
    if (own != QDOT_ONE && own != QDOT_MINUS_ONE)
        return true;
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e); i += 2)
        if (!depends_on_motion(b, qdot_expr_arg(pool, e, i)) &&
            !depends_on_motion(b, qdot_expr_arg(pool, e, i + 1)))
            return true;
    return false;
}

static void
add_cost_of_sum(bill *b, qdot_expr e)
{
    const qdot_pool *pool = b->s->pool;
    uint64_t terms = 0, others = qdot_expr_arg(pool, e, 0) != QDOT_ZERO;

    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e); i += 2) {
        qdot_expr x = qdot_expr_arg(pool, e, i), c = qdot_expr_arg(pool, e, i + 1);

        if (!depends_on_motion(b, x)) {
            others = 1;
            continue;
        }
        terms++;
        b->units += c != QDOT_ONE && c != QDOT_MINUS_ONE && !has_constant_factor(b, x);
    }
    b->units += terms + others - (terms > 0);
}

static void
add_cost_of_product(bill *b, qdot_expr e)
{
    const qdot_pool *pool = b->s->pool;
    uint64_t factors = has_constant_factor(b, e);

    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, e); i += 2) {
        qdot_expr x = qdot_expr_arg(pool, e, i), power = qdot_expr_arg(pool, e, i + 1);
        int64_t n;

        if (!depends_on_motion(b, x) && !depends_on_motion(b, power))
            continue;
        factors++;
        if (!qdot_expr_to_int(pool, power, &n))
            b->units += qdot_expr_rational(pool, power) ? 2 : 15;
        else
            for (int64_t k = n < 0 ? -n : n; k > 1; k /= 2)
                b->units++;
    }
    b->units += factors - (factors > 0);
}

/* Add the cost of a base angle: a call of sine and cosine if it is new, else nothing. False: no memory. */
static bool
add_cost_of_angle(bill *b, qdot_expr term)
{
    qdot_pool *pool = b->s->pool;

    if (qdot_expr_kind(pool, term) == QDOT_PROD)
        term = qdot_div(pool, term, qdot_expr_arg(pool, term, 0));
    for (size_t i = 0; i < b->angles.n; i++)
        if (b->angles.at[i] == term)
            return true;
    b->units += 15;
    return qdot_vec_push(&b->angles, term) == QDOT_OK;
}

static bool
add_cost_of_function(bill *b, qdot_expr e)
{
    const qdot_pool *pool = b->s->pool;
    qdot_expr x = qdot_expr_arg(pool, e, 0);
    uint32_t f = qdot_expr_node(pool, e)->op;

    if (f == QDOT_HOLD)
        return true;
    if (f > QDOT_COT) {
        b->units += 15;
        return true;
    }
    b->units += f > QDOT_COS; /* a quotient such as tan = sin/cos costs a division, too */
    if (qdot_expr_kind(pool, x) != QDOT_SUM)
        return add_cost_of_angle(b, x);
    for (uint32_t i = 1; i + 1 < qdot_expr_count(pool, x); i += 2)
        if (depends_on_motion(b, qdot_expr_arg(pool, x, i))) {
            b->units += i > 1 ? 3 : 0;
            if (!add_cost_of_angle(b, qdot_expr_arg(pool, x, i)))
                return false;
        }
    return true;
}

static bool
evaluation_cost(qdot_scene *s, size_t n, const qdot_expr *e, uint64_t *units)
{
    bill b = {.s = s};
    bool done = true;
    qdot_walk w;

    if (qdot_walk_begin_n(s->pool, n, e, &w) != QDOT_OK) {
        qdot_pool_fail(s->pool);
        return false;
    }
    for (size_t i = 0; i < w.n && done; i++) {
        qdot_kind kind = qdot_expr_kind(s->pool, w.at[i]);

        if (!depends_on_motion(&b, w.at[i]))
            continue;
        if (kind == QDOT_SUM)
            add_cost_of_sum(&b, w.at[i]);
        else if (kind == QDOT_PROD)
            add_cost_of_product(&b, w.at[i]);
        else if (kind == QDOT_FUN)
            done = add_cost_of_function(&b, w.at[i]);
    }
    qdot_walk_end(&w);
    qdot_free(b.angles.at);
    if (!done)
        qdot_pool_fail(s->pool);
    *units = b.units;
    return done;
}

static bool
is_worth_simplifying(qdot_scene *s, const qdot_expr *raw, size_t size)
{
    uint64_t units = 0, most = both_forms.units;
    size_t n = both_forms.coordinates;

    for (size_t i = 0; i < s->bodies.n; i++)
        if (s->bodies.at[i].angle == QDOT_NIL) {
            n = both_forms_in_space.coordinates;
            most = both_forms_in_space.units;
        }
    return s->coordinates.n <= n && evaluation_cost(s, size, raw, &units) && units <= most;
}

/* The cheapest of M for people or not with f for people or not, into e [n n + n]; of equals
 * that for people, whose angles are fewer sums. */
static bool
choose_cheapest_form(qdot_scene *s, size_t n, qdot_expr *e)
{
    size_t masses = n * n, size = masses + n;
    qdot_expr *short_form = qdot_calloc(2 * size, sizeof *short_form);
    qdot_expr *mixed = short_form + size;
    uint64_t least = UINT64_MAX, units;
    int best = 0;

    if (!short_form) {
        qdot_pool_fail(s->pool);
        return false;
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i; j < n; j++)
            short_form[i * n + j] = short_form[j * n + i] =
                qdot_mass_of_lagrangian(s, i, j);
        short_form[masses + i] = qdot_lagrange_people_forcing(s, i);
    }
    for (int form = 0; form < 4 && !qdot_pool_failed(s->pool); form++) {
        memcpy(mixed, form & 1 ? short_form : e, masses * sizeof *mixed);
        memcpy(mixed + masses, (form & 2 ? short_form : e) + masses, n * sizeof *mixed);
        if (evaluation_cost(s, size, mixed, &units) && units <= least) {
            least = units;
            best = form;
        }
    }
    if (best & 1)
        memcpy(e, short_form, masses * sizeof *e);
    if (best & 2)
        memcpy(e + masses, short_form + masses, n * sizeof *e);
    qdot_free(short_form);
    return !qdot_pool_failed(s->pool);
}

/* --- both forms of M and f ------------------------------------------------------------- */

/* Find all f [n] of M q'' = f in one computation if all masses are constant; otherwise one by one. */
static bool
unsimplified_forces(qdot_scene *s, qdot_expr *f)
{
    qdot_kinematics *k = NULL;

    if (!qdot_mech_stated(s)) {
        k = qdot_kinematics_get(s);
        if (!k)
            return false;
        if (qdot_recursive_applies(s, k))
            return qdot_recursive_forcing(s, k, f);
    }
    for (size_t i = 0; i < s->coordinates.n && !qdot_pool_failed(s->pool); i++) {
        if (qdot_interrupt_check() != QDOT_OK)
            qdot_pool_fail(s->pool);
        f[i] = unsimplified_force(s, i);
    }
    return !qdot_pool_failed(s->pool);
}

static bool
compute_numeric_equations(qdot_scene *s)
{
    qdot_pool *pool = s->pool;
    qdot_derived *d = qdot_derived_get(s);
    size_t n = d->n, size = n * n + n;
    qdot_expr *e, V;

    if (d->numeric_mass != QDOT_NIL)
        return true;
    if (n == 0) {
        qdot_mech_fail(s, QDOT_EINVAL, "the scene has no coordinates");
        return false;
    }
    e = qdot_calloc(size, sizeof *e);
    if (!e) {
        qdot_pool_fail(pool);
        return false;
    }
    V = qdot_potential_with_velocities(s);
    for (size_t i = 0; i < n && !qdot_pool_failed(pool); i++) {
        if (qdot_interrupt_check() != QDOT_OK) {
            qdot_pool_fail(pool);
            break;
        }
        for (size_t j = i; j < n; j++)
            e[i * n + j] = e[j * n + i] = unsimplified_mass_entry(s, i, j, V);
    }
    if (!qdot_pool_failed(pool) && unsimplified_forces(s, e + n * n) && is_worth_simplifying(s, e, size))
        choose_cheapest_form(s, n, e);
    qdot_directions_as_signs(pool, n, e + n * n);
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
    return compute_numeric_equations(s) ? s->derived->numeric_mass : QDOT_NIL;
}

qdot_expr
qdot_mech_numeric_forcing(qdot_scene *s)
{
    return compute_numeric_equations(s) ? s->derived->numeric_forcing : QDOT_NIL;
}

static qdot_expr
compute_numeric_energy(qdot_scene *s)
{
    const size_t n = s->coordinates.n;
    qdot_pool *pool = s->pool;
    qdot_kinematics *k;
    qdot_expr M, T = QDOT_ZERO;

    if (qdot_mech_stated(s) || qdot_potential_with_velocities(s) != QDOT_ZERO)
        return qdot_mech_energy(s);
    k = qdot_kinematics_get(s);
    M = k ? qdot_mech_numeric_mass(s) : QDOT_NIL;
    if (M == QDOT_NIL)
        return QDOT_NIL;
    for (size_t p = 0; p < k->terms.n; p++)
        if ((qdot_mech_holds(s, k->terms.at[p].w) & QDOT_HAS_VELOCITY)
            || (qdot_mech_holds(s, k->terms.at[p].w) | qdot_mech_holds(s, k->terms.at[p].x)
                | qdot_mech_holds(s, k->terms.at[p].y)) & QDOT_HAS_TIME)
            return qdot_mech_energy(s);
    for (size_t i = 0; i < n; i++) {
        qdot_expr p = QDOT_ZERO;

        for (size_t j = 0; j < n; j++)
            p = qdot_add(pool, p, qdot_mul(pool, qdot_expr_arg(pool, M, (uint32_t)(i * n + j)),
                                           qdot_mech_jet(s, j, 1)));
        T = qdot_add(pool, T, qdot_mul(pool, qdot_mech_jet(s, i, 1), p));
    }
    return qdot_add(pool, qdot_mul(pool, QDOT_HALF, T), qdot_potential_raw(s));
}

qdot_expr
qdot_mech_numeric_energy(qdot_scene *s)
{
    qdot_derived *d = qdot_derived_get(s);

    if (d->numeric_energy == QDOT_NIL)
        d->numeric_energy = compute_numeric_energy(s);
    return d->numeric_energy;
}
