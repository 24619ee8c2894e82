/* stability-exact.c -- whether a scene stays near a place that is known exactly: by an energy,
 * by the roots of the linear motion, by the force on either side. */
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/dynamics/mass-matrix.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/study/stability-parts.h"
#include "normal/prove/decide.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solutions.h"

enum { LONGEST_SLOPE = 200, MOST_ROOT = 6, MOST_DETERMINANT = 3 }; /* most operations; exponent denominator; coordinates */

/* --- one degree of freedom: the forces on either side ----------------------------------- */

/* *leading: the derivative of lowest order of e by eps that is not 0 at eps = 0; nil if none is found. *sign: 1 or -1
 * where it has that sign for all parameters, else 0. */
static qdot_status
find_leading_term(qdot_judgement *j, qdot_expr e, qdot_expr eps, qdot_expr *leading, int *sign)
{
    qdot_pool *pool = j->s->pool;
    qdot_expr zero = QDOT_ZERO;

    *leading = QDOT_NIL;
    *sign = 0;
    for (int k = 0; k <= 7; k++) {
        qdot_expr value = qdot_simplify(pool, qdot_subs(pool, e, 1, &eps, &zero), &j->facts),
                  up, down;
        qdot_status status = qdot_pool_check(pool);

        if (status != QDOT_OK)
            return status == QDOT_EDOMAIN ? QDOT_OK : status;
        if (!qdot_is_zero(pool, value, &j->facts)) {
            up = qdot_positive(pool, value, &j->facts, j->known.n, j->known.at);
            down = qdot_positive(pool, qdot_neg(pool, value), &j->facts, j->known.n,
                                 j->known.at);
            *sign = up == QDOT_TRUE ? 1 : down == QDOT_TRUE ? -1 : 0;
            *leading = value;
            return qdot_pool_check(pool);
        }
        e = qdot_diff(pool, e, eps);
    }
    return qdot_pool_check(pool);
}

typedef struct {
    qdot_judgement *j;
    qdot_expr eps;
    qdot_status status;
    bool known;
} one_side;

/* a or b, selected by the sign of u for small eps > 0; o->known becomes false if this sign is unknown. */
static qdot_expr
chosen_by_sign(one_side *o, qdot_expr e, qdot_expr u, qdot_expr a, qdot_expr b)
{
    qdot_pool *pool = o->j->s->pool;
    const qdot_expr zero = QDOT_ZERO;
    qdot_expr there, leading;
    int sign;

    if (o->status != QDOT_OK || u == QDOT_NIL || !qdot_expr_contains(pool, u, o->eps))
        return e;
    o->status = find_leading_term(o->j, u, o->eps, &leading, &sign);
    if (sign != 0 || o->status != QDOT_OK)
        return sign > 0 ? a : sign < 0 ? b : e;
    there = qdot_subs(pool, u, 1, &o->eps, &zero);
    if (there == QDOT_NIL)
        o->status = qdot_pool_check(pool);
    else /* the sign is 0, or depends on the parameters */
        o->known = false;
    return e;
}

/* The value of sign u, |u|, max, min or if(0 < u, a, b) for small eps > 0. */
static qdot_expr
value_on_one_side(qdot_pool *pool, qdot_expr e, void *user)
{
    one_side *o = user;
    uint32_t op = qdot_expr_node(pool, e)->op, n = qdot_expr_count(pool, e);
    qdot_expr a = qdot_expr_arg(pool, e, 0), b, u;

    if (op == QDOT_SIGN)
        return chosen_by_sign(o, e, a, QDOT_ONE, QDOT_MINUS_ONE);
    if (op == QDOT_ABS)
        return chosen_by_sign(o, e, a, a, qdot_neg(pool, a));
    if ((op == QDOT_MAX || op == QDOT_MIN) && n == 2) {
        b = qdot_expr_arg(pool, e, 1);
        u = qdot_sub(pool, a, b);
        return op == QDOT_MAX ? chosen_by_sign(o, e, u, a, b) : chosen_by_sign(o, e, u, b, a);
    }
    if (op == QDOT_MAX || op == QDOT_MIN) {
        for (uint32_t i = 1; i < n; i++) {
            b = qdot_fun(pool, op, 2, (qdot_expr[]){a, qdot_expr_arg(pool, e, i)});
            a = b == QDOT_NIL || qdot_expr_kind(pool, b) != QDOT_FUN ||
                        qdot_expr_node(pool, b)->op != op
                    ? b
                    : value_on_one_side(pool, b, user);
        }
        return a;
    }
    if (op != QDOT_IF || qdot_expr_kind(pool, a) != QDOT_REL ||
        qdot_expr_node(pool, a)->op == QDOT_EQ)
        return e;
    u = qdot_sub(pool, qdot_expr_arg(pool, a, 1), qdot_expr_arg(pool, a, 0));
    return chosen_by_sign(o, e, u, qdot_expr_arg(pool, e, 1), qdot_expr_arg(pool, e, 2));
}

qdot_status
qdot_judgement_one_side(qdot_judgement *j, qdot_expr F, qdot_expr eps, qdot_expr *leading, int *sign, bool *known)
{
    one_side o = {j, eps, QDOT_OK, true};

    F = qdot_walk_replace(j->s->pool, F, QDOT_FUN, value_on_one_side, &o);
    *leading = QDOT_NIL;
    *sign = 0;
    if (o.status == QDOT_OK)
        o.status = qdot_pool_check(j->s->pool);
    *known = o.status == QDOT_OK && o.known;
    if (!*known)
        return o.status == QDOT_EDOMAIN ? QDOT_OK : o.status;
    return find_leading_term(j, F, eps, leading, sign);
}

/* The place is stable where both forces back [2] are positive: for all parameters (sign [2] is 1), or under conditions on
 * these, which j collects. Undecided if these depend on more than parameters or cannot both be positive. */
static qdot_status
judge_by_forces_with_conditions(qdot_judgement *j, qdot_equilibrium *e, const qdot_expr *back, const int *sign)
{
    const qdot_judgement_point before = qdot_judgement_mark(j);
    bool possible = (sign[0] > 0 || qdot_is_generic(j->s->pool, back[0])) &&
                    (sign[1] > 0 || qdot_is_generic(j->s->pool, back[1]));

    for (int side = 0; side < 2 && possible; side++) {
        qdot_expr answer;

        QDOT_TRY(qdot_judgement_ask(j, back[side], &answer));
        possible = answer != QDOT_FALSE;
    }
    if (possible)
        e->stability = QDOT_STABLE;
    else
        qdot_judgement_back_to(j, before);
    return QDOT_OK;
}

/* Find the least common denominator of the exponents of powers that contain q; 1 if it exceeds MOST_ROOT. */
static qdot_status
common_exponent_denominator(qdot_pool *pool, qdot_expr e, qdot_expr q, int64_t *root)
{
    qdot_walk w;

    *root = 1;
    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t i = 0; i < w.n; i++) {
        uint32_t n = qdot_expr_kind(pool, w.at[i]) == QDOT_PROD ? qdot_expr_count(pool, w.at[i]) : 0;

        for (uint32_t k = 1; k + 1 < n; k += 2) {
            const fmpq *p = qdot_expr_rational(pool, qdot_expr_arg(pool, w.at[i], k + 1));
            bool known = p != NULL && fmpz_cmp_si(fmpq_denref(p), MOST_ROOT) <= 0;
            int64_t d = known ? fmpz_get_si(fmpq_denref(p)) : 1, all = *root;

            if (!qdot_expr_contains(pool, qdot_expr_arg(pool, w.at[i], k), q))
                continue;
            while (all % d != 0)
                all += *root;
            *root = all <= MOST_ROOT ? all : *root;
        }
    }
    qdot_walk_end(&w);
    return qdot_pool_check(pool);
}

/* Find the leading term in eps of the restoring force at q = place + eps^root, or (below) at place
 * - eps^root. */
static qdot_status
restoring_force_beside(qdot_judgement *j, qdot_expr q, qdot_expr place, bool below, int64_t root, qdot_expr *leading, int *sign,
                       bool *known)
{
    qdot_pool *pool = j->s->pool;
    qdot_expr eps = qdot_symbol_get(pool, QDOT_FORMAL, "epsilon"), at, F;
    qdot_status status;

    *leading = QDOT_NIL;
    *sign = 0;
    *known = true;
    qdot_symbol_domain(pool, eps, QDOT_ZERO, true, QDOT_NIL, false);
    at = qdot_pow_int(pool, eps, root);
    at = below ? qdot_sub(pool, place, at) : qdot_add(pool, place, at);
    F = qdot_subs(pool, qdot_expr_arg(pool, j->judge->at_rest, 0), 1, &q, &at);
    if (F != QDOT_NIL && qdot_solve_integers(pool, place) > 0)
        F = qdot_solve_without_turns(pool, F);
    status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        return qdot_judgement_one_side(j, below ? F : qdot_neg(pool, F), eps, leading, sign, known);
    return status == QDOT_EDOMAIN ? QDOT_OK : status; /* EDOMAIN: no force is defined on this side */
}

/* The potential of one coordinate rises on either side, or falls on one, by the force at q0 +-
 * eps: also where H = 0, where the force jumps, or where it has no value on one side. A force by roots of what is 0 at
 * q0 is looked at as a series of roots of eps. */
static qdot_status
judge_by_forces_beside(qdot_judgement *j, qdot_equilibrium *e)
{
    qdot_scene *s = j->s;
    qdot_pool *pool = s->pool;
    qdot_expr q = s->coordinates.at[0], mass, up, place;
    qdot_expr back[2]; /* leading terms of the force towards the equilibrium: [0] above it, [1] below it */
    int sign[2];
    int64_t root;

    if (qdot_expr_count(pool, e->equations) != 1 || qdot_expr_count(pool, j->judge->at_rest) != 1)
        return QDOT_OK;
    place = qdot_expr_arg(pool, qdot_expr_arg(pool, e->equations, 0), 1);
    mass = qdot_simplify(pool, qdot_rest_value(s, e->equations, qdot_mass_of_lagrangian(s, 0, 0)),
                         &j->facts);
    QDOT_TRY(qdot_pool_check(pool));
    up = qdot_positive(pool, mass, &j->facts, j->known.n, j->known.at);
    QDOT_TRY(qdot_pool_check(pool));
    if (up != QDOT_TRUE)
        return QDOT_OK;
    QDOT_TRY(common_exponent_denominator(pool, j->judge->at_rest, q, &root));
    for (int side = 0; side < 2; side++) {
        bool known;

        QDOT_TRY(restoring_force_beside(j, q, place, side == 1, 1, &back[side], &sign[side], &known));
        if (known && back[side] == QDOT_NIL && root > 1)
            QDOT_TRY(restoring_force_beside(j, q, place, side == 1, root, &back[side], &sign[side], &known));
        if (!known)
            return QDOT_OK;
    }
    if (back[0] != QDOT_NIL && back[1] != QDOT_NIL && sign[0] >= 0 && sign[1] >= 0)
        return judge_by_forces_with_conditions(j, e, back, sign);
    if ((sign[0] < 0 || sign[1] < 0) && !j->judge->velocity_kink)
        e->stability = QDOT_UNSTABLE;
    return QDOT_OK;
}

/* --- the verdict on stability ----------------------------------------------------------- */

static qdot_stability
verdict_if_definite(qdot_definite how, qdot_stability verdict)
{
    return how == QDOT_DEFINITE_POSITIVE || how == QDOT_DEFINITE_CONDITIONAL ? verdict : QDOT_STABILITY_UNDECIDED;
}

/* Prove stability by an energy that has a strict minimum at the equilibrium. */
static qdot_status
prove_stable_by_energy(qdot_judgement *j, qdot_equilibrium *e)
{
    qdot_definite how;
    qdot_judgement_point before = qdot_judgement_mark(j);

    if (j->judge->law == QDOT_ENERGY_UNKNOWN)
        return QDOT_OK;
    QDOT_TRY(qdot_judgement_definiteness(j, j->n, j->H, &how));
    if (how == QDOT_DEFINITE_POSITIVE || how == QDOT_DEFINITE_CONDITIONAL)
        QDOT_TRY(qdot_judgement_definiteness(j, j->m.n, j->m.M, &how));
    if (how == QDOT_DEFINITE_POSITIVE && j->when.n > before.when)
        how = QDOT_DEFINITE_CONDITIONAL;
    e->stability = verdict_if_definite(how, QDOT_STABLE);
    if (e->stability != QDOT_STABLE)
        qdot_judgement_back_to(j, before);
    return QDOT_OK;
}

/* A direction in which the energy falls, no gyroscopic terms: det(M s^2 + Gamma s + H) has a root
 * s > 0. */
static qdot_status
prove_unstable_by_energy(qdot_judgement *j, qdot_equilibrium *e)
{
    qdot_definite how;
    bool mass;
    qdot_judgement_point before = qdot_judgement_mark(j);

    if (!j->regular || !qdot_judgement_is_symmetric(j, j->m.n, j->m.Gamma, 1) ||
        !qdot_judgement_is_symmetric(j, j->n, j->H, 1))
        return QDOT_OK;
    QDOT_TRY(qdot_judgement_definiteness(j, j->n, j->H, &how));
    qdot_judgement_drop_conditions(j, before);
    if (how == QDOT_NEGATIVE_SOMEWHERE)
        QDOT_TRY(qdot_judgement_is_definite(j, j->m.n, j->m.M, &mass));
    if (how == QDOT_NEGATIVE_SOMEWHERE && mass)
        e->stability = QDOT_UNSTABLE;
    else
        qdot_judgement_back_to(j, before);
    return QDOT_OK;
}

/* --- equilibria at kinks -------------------------------------------------------------------- */

/* Whether the equations at rest have no slopes at the place: |u|, sign u where u = 0; of what
 * else jumps it is not looked into where. */
static qdot_status
has_kink_at(const qdot_judgement *j, qdot_expr equations, bool *yes)
{
    qdot_pool *pool = j->s->pool;
    qdot_walk w;
    qdot_status status = QDOT_OK;

    *yes = false;
    QDOT_TRY(qdot_walk_begin(pool, j->judge->at_rest, &w));
    for (size_t i = 0; i < w.n && !*yes && status == QDOT_OK; i++) {
        uint32_t op = qdot_expr_node(pool, w.at[i])->op;
        qdot_expr u;

        if (qdot_expr_kind(pool, w.at[i]) != QDOT_FUN || !qdot_stability_has_kink(op) ||
            (qdot_mech_holds(j->s, w.at[i]) & QDOT_HAS_COORD) == 0)
            continue;
        if (op != QDOT_ABS && op != QDOT_SIGN) {
            *yes = true;
            break;
        }
        u = qdot_rest_value(j->s, equations, qdot_expr_arg(pool, w.at[i], 0));
        status = qdot_pool_check(pool);
        *yes = status == QDOT_OK && qdot_is_zero(pool, u, &j->facts);
    }
    qdot_walk_end(&w);
    return status;
}

/* --- families of equilibria ------------------------------------------------------------ */

qdot_status
qdot_judgement_confirm(qdot_judgement *j, bool *yes)
{
    *yes = true;
    for (size_t i = 0; i < j->claims.n && *yes; i++)
        QDOT_TRY(qdot_judgement_is_sure(j, j->claims.at[i], true, yes));
    for (size_t r = 0; r < j->m.rank && *yes; r++)
        if ((qdot_mech_holds(j->s, j->m.pivot[r]) & QDOT_HAS_COORD) != 0 ||
            qdot_solve_integers(j->s->pool, j->m.pivot[r]) > 0)
            QDOT_TRY(qdot_judgement_is_sure(j, j->m.pivot[r], false, yes));
    return QDOT_OK;
}

/* --- judging one equilibrium ------------------------------------------------------------ */

/* The blocks of those y whose place is told: all but coordinates that stand in no equation at
 * rest, along which a family of rests is alike. */
static qdot_status
copy_determined_coordinates(qdot_judgement *j)
{
    size_t m = j->m.n;
    bool *told = qdot_calloc(m + 1, sizeof *told);

    j->M = qdot_calloc(3 * m * m + 1, sizeof *j->M);
    if (told == NULL || j->M == NULL) {
        qdot_free(told);
        return QDOT_ENOMEM;
    }
    for (size_t a = 0; a < m; a++) {
        told[a] = qdot_stability_is_told(j->judge, j->m.which[a]);
        j->n += told[a];
    }
    j->Gamma = j->M + j->n * j->n;
    j->H = j->Gamma + j->n * j->n;
    for (int k = 0; k < 3; k++) {
        const qdot_expr *from = j->m.M + (size_t)k * m * m;
        size_t at = (size_t)k * j->n * j->n;

        for (size_t a = 0; a < m; a++)
            for (size_t b = 0; b < m; b++)
                if (told[a] && told[b])
                    j->M[at++] = from[a * m + b];
    }
    qdot_free(told);
    return QDOT_OK;
}

/* Whether a derivative of a force is too long for attempts to find the signs of expressions made of them. */
static bool
is_too_long(const qdot_judgement *j)
{
    bool yes = false;

    for (size_t i = 0; i < j->n * j->n && !yes; i++)
        yes = qdot_expr_size(j->s->pool, j->H[i]) > LONGEST_SLOPE;
    return yes;
}

static qdot_status
judge_by_linear_motion(qdot_judgement *j, qdot_equilibrium *e)
{
    const qdot_judgement_point before = qdot_judgement_mark(j);
    qdot_dof dof;
    qdot_status status = qdot_linear_motion_about(j->s, e->equations, e->exists, &j->m);

    if (status == QDOT_EDOMAIN) /* the forces have no derivatives there */
        return QDOT_OK;
    QDOT_TRY(status);
    QDOT_TRY(copy_determined_coordinates(j));
    QDOT_TRY(qdot_mech_dof(j->s, &dof));
    j->regular = j->m.rank == dof.independent;
    if (j->n == 0) { /* no motion is possible except along coordinates that the equations at rest do not contain */
        if (j->m.n == 0 && !j->judge->timed)
            e->stability = QDOT_STABLE;
        return QDOT_OK;
    }
    if (is_too_long(j))
        return QDOT_OK;
    QDOT_TRY(prove_stable_by_energy(j, e));
    if (j->judge->velocity_kink || j->judge->timed || !j->m.damped)
        return QDOT_OK;
    if (e->stability == QDOT_STABLE && j->when.n > before.when && j->m.exact &&
        /* gyroscopic terms may stabilise without a positive energy */
        !qdot_judgement_is_symmetric(j, j->m.n, j->m.Gamma, 1)) {
        qdot_judgement_back_to(j, before);
        e->stability = QDOT_STABILITY_UNDECIDED;
        QDOT_TRY(qdot_stability_by_roots(j, e));
        if (e->stability == QDOT_STABILITY_UNDECIDED)
            QDOT_TRY(prove_stable_by_energy(j, e));
    }
    if (e->stability == QDOT_STABILITY_UNDECIDED)
        QDOT_TRY(prove_unstable_by_energy(j, e));
    if (e->stability == QDOT_STABILITY_UNDECIDED)
        QDOT_TRY(qdot_stability_by_roots(j, e));
    return QDOT_OK;
}

/* Of an undecided place: unstable where det H < 0, a condition on parameters, for then det(M s^2 + Gamma s + H), which is
 * positive for large s, has a root s > 0. */
static qdot_status
find_instability_condition(qdot_judgement *j, qdot_equilibrium *e)
{
    qdot_pool *pool = j->s->pool;
    qdot_expr det, when;
    bool mass;

    if (j->s->constraints.n > 0 || !j->regular || !j->m.damped || j->judge->velocity_kink || j->judge->timed ||
        j->n == 0 || j->n != j->m.n || j->n > MOST_DETERMINANT || is_too_long(j))
        return QDOT_OK;
    QDOT_TRY(qdot_judgement_is_definite(j, j->m.n, j->m.M, &mass));
    det = mass ? qdot_simplify(pool, qdot_det(pool, qdot_matrix(pool, (uint32_t)j->n, (uint32_t)j->n, j->H)), &j->facts)
               : QDOT_ZERO;
    QDOT_TRY(qdot_pool_check(pool));
    if (!mass || !qdot_is_generic(pool, det) || qdot_solve_integers(pool, det) > 0 || qdot_expr_size(pool, det) > LONGEST_SLOPE)
        return QDOT_OK;
    when = qdot_positive(pool, qdot_neg(pool, det), &j->facts, j->known.n, j->known.at);
    QDOT_TRY(qdot_pool_check(pool));
    if (when == QDOT_FALSE)
        return QDOT_OK;
    e->stability = QDOT_UNSTABLE;
    e->stable_when = when == QDOT_TRUE ? QDOT_NIL : qdot_list(pool, 1, &when);
    return qdot_pool_check(pool);
}

static qdot_status
judge_exact_equilibrium(qdot_judgement *j, qdot_equilibrium *e)
{
    qdot_scene *s = j->s;
    qdot_judgement_point before; /* the state before any verdict */
    bool kink, sure;

    for (uint32_t i = 0; e->exists != QDOT_NIL && i < qdot_expr_count(s->pool, e->exists); i++)
        QDOT_TRY(qdot_vec_push(
            &j->known, qdot_positive_of(s->pool, qdot_expr_arg(s->pool, e->exists, i))));
    before = qdot_judgement_mark(j);
    QDOT_TRY(has_kink_at(j, e->equations, &kink));
    if (!kink)
        QDOT_TRY(judge_by_linear_motion(j, e));
    if (e->stability == QDOT_STABILITY_UNDECIDED && s->coordinates.n == 1 &&
        s->constraints.n == 0 && j->judge->law != QDOT_ENERGY_UNKNOWN)
        QDOT_TRY(judge_by_forces_beside(j, e));
    if (e->stability == QDOT_STABILITY_UNDECIDED && !kink && j->judge->law != QDOT_ENERGY_UNKNOWN && !j->judge->timed)
        QDOT_TRY(qdot_stability_by_degenerate_minimum(j, e));
    if (e->stability == QDOT_STABILITY_UNDECIDED && kink && s->coordinates.n > 1 && j->judge->law != QDOT_ENERGY_UNKNOWN)
        QDOT_TRY(qdot_stability_by_corner(j, e));
    if (e->stability != QDOT_STABILITY_UNDECIDED) {
        QDOT_TRY(qdot_judgement_confirm(j, &sure));
        if (!sure)
            e->stability = QDOT_STABILITY_UNDECIDED;
    }
    QDOT_TRY(qdot_judgement_drop_implied(j, before.known));
    if ((e->stability == QDOT_STABLE || e->stability == QDOT_STABLE_TO_FIRST_ORDER) &&
        j->when.n > 0)
        e->stable_when = qdot_list(s->pool, (uint32_t)j->when.n, j->when.at);
    QDOT_TRY(qdot_pool_check(s->pool));
    if (e->stability != QDOT_STABILITY_UNDECIDED || kink)
        return QDOT_OK;
    qdot_judgement_back_to(j, before); /* drop what was taken for positive by a verdict that was not confirmed */
    return find_instability_condition(j, e);
}

qdot_status
qdot_stability_judge_exact(qdot_judge *judge, qdot_equilibrium *e)
{
    qdot_judgement j = {.judge = judge, .s = judge->s};
    qdot_expr *own = NULL;
    qdot_status status = qdot_rest_facts(judge->s, e->exists, &j.facts, &own);

    if (status == QDOT_OK)
        status = judge_exact_equilibrium(&j, e);
    qdot_linear_motion_clear(&j.m);
    qdot_free(j.M);
    qdot_free(own);
    qdot_free(j.known.at);
    qdot_free(j.when.at);
    qdot_free(j.claims.at);
    return status;
}
