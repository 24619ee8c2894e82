/* lyapunov.c -- the work of what is applied beside a potential: none, never positive, or not
 * known. */
#include "mech/study/lyapunov.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/energy.h"
#include "mech/dynamics/integrated.h"
#include "mech/dynamics/virtual-work.h"
#include "mech/scene/access.h"
#include "normal/inequality/less.h"
#include "normal/simplify/simplify.h"

enum { MOST_DECIDED = 300 }; /* largest number of operations of a power whose sign is determined */

/* The expression e with all velocities set to 0. */
static qdot_expr
set_velocities_to_zero(qdot_scene *s, qdot_expr e)
{
    for (size_t i = 0; i < s->coordinates.n && e != QDOT_NIL; i++) {
        qdot_expr v = qdot_mech_jet(s, i, 1), zero = QDOT_ZERO;

        e = qdot_subs(s->pool, e, 1, &v, &zero);
    }
    return e;
}

/* Write each sign(u) in *e as |u|/u, so that u sign(u) becomes |u|. */
static qdot_status
replace_signs_by_quotients(qdot_scene *s, qdot_expr *e)
{
    qdot_walk w;
    qdot_status status = QDOT_OK;

    QDOT_TRY(qdot_walk_begin(s->pool, *e, &w));
    for (size_t i = w.n; i-- > 0 && status == QDOT_OK;) {
        qdot_expr u, to;

        if (qdot_expr_kind(s->pool, w.at[i]) != QDOT_FUN ||
            qdot_expr_node(s->pool, w.at[i])->op != QDOT_SIGN)
            continue;
        u = qdot_expr_arg(s->pool, w.at[i], 0);
        to = qdot_div(s->pool, qdot_fun1(s->pool, QDOT_ABS, u), u);
        *e = qdot_subs(s->pool, *e, 1, &w.at[i], &to);
        status = qdot_pool_check(s->pool);
    }
    qdot_walk_end(&w);
    return status;
}

/* Whether e >= 0 is proved wherever it is defined. */
static qdot_status
is_never_negative(qdot_scene *s, qdot_expr e, const qdot_facts *facts, bool *yes)
{
    qdot_decision d;

    QDOT_TRY(replace_signs_by_quotients(s, &e));
    e = qdot_simplify(s->pool, e, facts);
    QDOT_TRY(qdot_pool_check(s->pool));
    *yes = (qdot_expr_node(s->pool, e)->sign & QDOT_GE0) != 0;
    if (*yes || qdot_expr_size(s->pool, e) > MOST_DECIDED)
        return QDOT_OK;
    QDOT_TRY(qdot_decide_less(s->pool, QDOT_ZERO, e, false, facts, &d));
    *yes = d.verdict == QDOT_PROVED;
    return QDOT_OK;
}

/* Nothing of the scene changes with time by itself, and constraints bind coordinates alone, be it
 * in disguise. */
static qdot_status
is_time_independent(qdot_scene *s, bool *yes)
{
    bool holonomic;

    QDOT_TRY(qdot_mech_is_holonomic(s, &holonomic));
    *yes = s->states.n == 0 && holonomic && qdot_lagrangian_is_still(s, QDOT_T);
    for (size_t k = 0; k < s->constraints.n; k++)
        *yes = *yes && (qdot_mech_holds(s, s->constraints.at[k].f) & QDOT_HAS_TIME) == 0;
    return qdot_pool_check(s->pool);
}

/* Judge dampers and Rayleigh's function: *used if there are any, *yes if all dissipate energy. */
static qdot_status
judge_damping(qdot_scene *s, const qdot_facts *facts, bool *yes, bool *used)
{
    *yes = true;
    for (size_t k = 0; k < s->dampers.n && *yes; k++) {
        *used = true;
        QDOT_TRY(is_never_negative(s, s->dampers.at[k].stiffness, facts, yes));
    }
    for (size_t k = 0; k < s->dissipations.n && *yes; k++) {
        qdot_expr power = QDOT_ZERO;

        for (size_t i = 0; i < s->coordinates.n; i++) {
            qdot_expr v = qdot_mech_jet(s, i, 1);

            power = qdot_add(s->pool, power,
                             qdot_mul(s->pool, v,
                                      qdot_diff(s->pool, s->dissipations.at[k].e, v)));
        }
        *used = true;
        QDOT_TRY(is_never_negative(s, power, facts, yes));
    }
    return QDOT_OK;
}

/* Judge forces and torques: *yes if at rest they have a potential and their remainder dissipates energy. */
static qdot_status
declared_forces_dissipate(qdot_scene *s, const qdot_facts *facts, bool *yes, bool *used)
{
    qdot_pool *pool = s->pool;
    size_t n = s->coordinates.n;
    qdot_expr *F = qdot_calloc(n + 1, sizeof *F), power = QDOT_ZERO;
    qdot_status status = F == NULL ? QDOT_ENOMEM : QDOT_OK;

    *yes = status == QDOT_OK;
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        qdot_expr Q = qdot_force_declared(s, i);

        F[i] = set_velocities_to_zero(s, Q);
        power = qdot_sub(pool, power,
                         qdot_mul(pool, qdot_mech_jet(s, i, 1), qdot_sub(pool, Q, F[i])));
        status = qdot_pool_check(pool);
        if (status == QDOT_EDOMAIN) { /* the force is along x'/|x'|, which is undefined at rest */
            qdot_free(F);
            *yes = false;
            return QDOT_OK;
        }
        *yes = *yes && status == QDOT_OK && (qdot_mech_holds(s, Q) & QDOT_HAS_TIME) == 0;
    }
    for (size_t i = 0; i < n && *yes; i++)
        for (size_t k = 0; k < i && *yes; k++) {
            qdot_expr curl = qdot_sub(pool, qdot_diff(pool, F[i], s->coordinates.at[k]),
                                      qdot_diff(pool, F[k], s->coordinates.at[i]));

            *yes = curl != QDOT_NIL && qdot_is_zero(pool, curl, facts);
        }
    qdot_free(F);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status != QDOT_OK || !*yes || qdot_is_zero(pool, power, facts))
        return status;
    *used = true;
    return is_never_negative(s, power, facts, yes);
}

qdot_status
qdot_energy_law_of(qdot_scene *s, qdot_energy_law *law)
{
    const qdot_facts facts = qdot_scene_facts(s);
    bool yes, used = false;

    *law = QDOT_ENERGY_UNKNOWN;
    QDOT_TRY(is_time_independent(s, &yes));
    if (yes)
        QDOT_TRY(judge_damping(s, &facts, &yes, &used));
    if (yes)
        QDOT_TRY(declared_forces_dissipate(s, &facts, &yes, &used));
    if (yes)
        *law = used ? QDOT_ENERGY_USED : QDOT_ENERGY_KEPT;
    return QDOT_OK;
}
