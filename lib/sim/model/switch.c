/* switch.c -- finds the switching functions of the equations and their surfaces. */
#include "sim/model/switch.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/dalembert.h"
#include "mech/dynamics/potential.h"
#include "mech/dynamics/energy.h"
#include "mech/dynamics/quantity.h"
#include "sim/model/layer.h"
#include "sim/model/substitute.h"

void
qdot_switches_clear(qdot_switches *s)
{
    qdot_free(s->surfaces.at);
    qdot_free(s->atoms.at);
    qdot_free(s->pucks.at);
    qdot_free(s->roots.at);
    qdot_gates_clear(&s->gates);
    *s = (qdot_switches){0};
}

static qdot_status collect_switching_functions(qdot_switches *s, qdot_expr e);

/* Add a surface after those inside it, which may be new; a difference is put in canonical order.
 *  */
static qdot_status
add_surface(qdot_switches *s, qdot_expr u, bool steps)
{
    char name[32];
    qdot_expr side;
    bool turned;

    if (!steps)
        u = qdot_gates_upright(s->pool, u, &turned);
    QDOT_TRY(qdot_pool_check(s->pool));
    if (!qdot_gates_moves(s->pool, u)) /* the parts of u that vary along a run may have cancelled */
        return QDOT_OK;
    QDOT_TRY(collect_switching_functions(s, u));
    for (size_t i = 0; i < s->surfaces.n; i++)
        if (s->surfaces.at[i].u == u && s->surfaces.at[i].steps == steps)
            return QDOT_OK;
    /* use a space in the symbol's name, which no user's name contains */
    snprintf(name, sizeof name, "side %zu", s->surfaces.n + 1);
    side = qdot_symbol_get(s->pool, QDOT_FORMAL, name);
    QDOT_TRY(qdot_pool_check(s->pool));
    return qdot_vec_push(&s->surfaces, ((qdot_surface){.u = u, .steps = steps, .side = side}));
}

static qdot_status
append_atom(qdot_switches *s, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr a = qdot_expr_arg(pool, e, 0), b = n > 1 ? qdot_expr_arg(pool, e, 1) : a;

    for (size_t i = 0; i < s->atoms.n; i++)
        if (s->atoms.at[i] == e)
            return QDOT_OK;
    QDOT_TRY(qdot_vec_push(&s->atoms, e));
    if (qdot_expr_kind(pool, e) == QDOT_REL)
        return add_surface(s, qdot_sub(pool, a, b), false);
    if (qdot_expr_is_function(pool, e, QDOT_ABS) || qdot_expr_is_function(pool, e, QDOT_SIGN))
        return add_surface(s, a, false);
    if (qdot_expr_is_function(pool, e, QDOT_FLOOR))
        return add_surface(s, a, true);
    if (qdot_expr_is_function(pool, e, QDOT_MOD))
        return add_surface(s, qdot_div(pool, a, b), true);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = i + 1; j < n; j++)
            QDOT_TRY(add_surface(s,
                                 qdot_sub(pool, qdot_expr_arg(pool, e, i),
                                          qdot_expr_arg(pool, e, j)),
                                 false));
    return QDOT_OK;
}

/* Collect all switching functions that occur in the expression e. */
static qdot_status
collect_switching_functions(qdot_switches *s, qdot_expr e)
{
    qdot_walk walk;
    qdot_status status = qdot_walk_begin(s->pool, e, &walk);

    for (size_t i = 0; status == QDOT_OK && i < walk.n; i++)
        if (qdot_gates_is_switch(s->pool, walk.at[i]))
            status = append_atom(s, walk.at[i]);
    qdot_walk_end(&walk);
    return status;
}

/* Collect the switching functions of an expression of the equations, and the expression itself. */
static qdot_status
collect_from_equation(qdot_switches *s, qdot_expr e)
{
    QDOT_TRY(collect_switching_functions(s, e));
    return qdot_vec_push(&s->roots, e);
}

static bool
has_switching_function(const qdot_switches *s, qdot_expr e, qdot_status *status)
{
    bool found = false;
    qdot_walk walk;

    if (e == QDOT_NIL || *status != QDOT_OK)
        return false;
    *status = qdot_walk_begin(s->pool, e, &walk);
    for (size_t i = 0; *status == QDOT_OK && i < walk.n; i++)
        found = found || qdot_gates_is_switch(s->pool, walk.at[i]);
    qdot_walk_end(&walk);
    return found;
}

/* Make s->level, the energy that must not jump: from T if M switches, and from potentials or a
 * Lagrangian that switch or depend on t. */
static qdot_status
find_level_function(qdot_switches *s, qdot_scene *scene, const qdot_run_request *request, qdot_expr mass)
{
    qdot_pool *pool = s->pool;
    qdot_status status = QDOT_OK;
    qdot_expr sum = scene->lagrangian;
    bool moved = false; /* the kinetic energy T contains terms of first degree in velocities */

    if (sum == QDOT_NIL && (has_switching_function(s, mass, &status) || !qdot_lagrangian_has(scene, QDOT_T, &moved) || moved))
        sum = qdot_mech_numeric_kinetic(scene);
    if (!has_switching_function(s, sum, &status))
        sum = QDOT_ZERO;
    for (size_t i = 0; i < scene->potentials.n; i++)
        if (has_switching_function(s, scene->potentials.at[i].e, &status))
            sum = qdot_sub(pool, sum, scene->potentials.at[i].e);
    if (status == QDOT_OK && sum != QDOT_ZERO) {
        sum = qdot_substitute(pool, sum, request->n_values, request->symbols,
                              request->values);
        s->level = has_switching_function(s, sum, &status) ? sum : QDOT_NIL;
    }
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* Whether a node may switch, or may after differentiation or substitution of values: also a
 * function whose value is set, and a root, which is an absolute value if its base is a square. */
static bool
may_switch(const qdot_pool *pool, qdot_expr e)
{
    if (qdot_expr_kind(pool, e) == QDOT_UFUN || qdot_gates_is_switch(pool, e))
        return true;
    for (uint32_t i = 2; qdot_expr_kind(pool, e) == QDOT_PROD && i < qdot_expr_count(pool, e);
         i += 2) {
        int64_t power;

        if (!qdot_expr_to_int(pool, qdot_expr_arg(pool, e, i), &power))
            return true;
    }
    return false;
}

static qdot_status
check_smoothness(const qdot_pool *pool, size_t n, const qdot_expr *e, bool *smooth)
{
    qdot_walk walk;
    qdot_status status = qdot_walk_begin_n(pool, n, e, &walk);

    for (size_t i = 0; status == QDOT_OK && i < walk.n && *smooth; i++)
        *smooth = !may_switch(pool, walk.at[i]);
    qdot_walk_end(&walk);
    return status;
}

bool
qdot_switches_are_spatial(const qdot_scene *scene)
{
    bool turns = false;

    for (size_t i = 0; i < scene->bodies.n; i++)
        turns |= scene->bodies.at[i].angle == QDOT_NIL;
    return turns && scene->coordinates.n >= QDOT_MANY_TURNING && scene->constraints.n == 0 && scene->states.n == 0;
}

bool
qdot_switches_are_many(const qdot_scene *scene)
{
    return scene->coordinates.n >= QDOT_MANY_COORDINATES || qdot_switches_are_spatial(scene);
}

/* Whether nothing switches in the ingredients of the equations: positions and applied forces. So
 * M and f need not be derived, which takes long for many coordinates. */
static qdot_status
find_whether_smooth(qdot_scene *scene, const qdot_run_request *request, bool *smooth)
{
    qdot_pool *pool = scene->pool;
    qdot_dalembert_term *terms;
    qdot_expr *e, Q;
    size_t n;
    qdot_status status;

    *smooth = false;
    if (qdot_switches_are_spatial(scene)) {
        QDOT_TRY(qdot_mech_dalembert_terms(scene, &terms, &n));
        Q = qdot_list(pool, 2, (qdot_expr[]){qdot_mech_dalembert_applied(scene), qdot_potential_but_gravity(scene)});
    } else {
        QDOT_TRY(qdot_mech_dalembert(scene, &terms, &n, &Q));
    }
    if (n > 0 && scene->constraints.n == 0)
        Q = qdot_substitute(pool, Q, request->n_values, request->symbols, request->values);
    else
        Q = QDOT_NIL;
    e = qdot_calloc(3 * n + scene->potentials.n + 1, sizeof *e);
    status = e ? qdot_pool_check(pool) : QDOT_ENOMEM;
    if (status == QDOT_OK && Q != QDOT_NIL) {
        size_t count = 0;

        for (size_t i = 0; i < n; i++) {
            e[count++] = terms[i].w;
            e[count++] = terms[i].x;
            e[count++] = terms[i].y;
        }
        for (size_t i = 0; i < scene->potentials.n; i++)
            e[count++] = scene->potentials.at[i].e;
        e[count++] = Q;
        *smooth = true;
        status = check_smoothness(pool, count, e, smooth);
    }
    qdot_free(e);
    qdot_free(terms);
    return status;
}

/* Whether `base` is a linear function of t alone that is 0 at some time of the run. */
static bool
vanishes_during_run(qdot_pool *pool, const qdot_run_request *request, qdot_expr base)
{
    const qdot_expr slope = qdot_diff(pool, base, QDOT_T), now = QDOT_T;
    qdot_expr ends[2];
    double at[2];

    if (slope == QDOT_NIL || slope == QDOT_ZERO || qdot_expr_kind(pool, slope) != QDOT_NUM
        || (qdot_expr_node(pool, base)->holds & ~(uint32_t)QDOT_HAS_TIME) != 0)
        return false;
    ends[0] = qdot_subs(pool, base, 1, &now, &request->t0);
    ends[1] = qdot_subs(pool, base, 1, &now, &request->t1);
    for (size_t k = 0; k < 2; k++)
        if (ends[k] == QDOT_NIL || qdot_constant_double(pool, ends[k], &at[k]) != QDOT_OK)
            return false;
    return at[0] * at[1] <= 0;
}

/* Collect non-integer powers of t - a for times a of the run (sim/model/layer.h): each a surface |t - a|. */
static qdot_status
collect_powers_of_time(qdot_switches *s, const qdot_run_request *request, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    qdot_walk walk;
    qdot_status status = qdot_walk_begin(pool, e, &walk);
    qdot_expr distance;
    double p;

    for (size_t i = 0; status == QDOT_OK && i < walk.n; i++)
        for (uint32_t k = 1; qdot_expr_kind(pool, walk.at[i]) == QDOT_PROD && status == QDOT_OK
                             && k + 1 < qdot_expr_count(pool, walk.at[i]);
             k += 2)
            if (qdot_layers_is_broken(pool, walk.at[i], k, &p) && p > 0
                && vanishes_during_run(pool, request, qdot_expr_arg(pool, walk.at[i], k))) {
                distance = qdot_fun1(pool, QDOT_ABS, qdot_expr_arg(pool, walk.at[i], k));
                status = append_atom(s, distance);
                if (status == QDOT_OK)
                    status = qdot_vec_push(&s->roots, distance);
            }
    qdot_walk_end(&walk);
    return status;
}

qdot_status
qdot_switches_find(qdot_scene *scene, const qdot_run_request *request, qdot_switches *s)
{
    qdot_pool *pool = scene->pool;
    bool smooth = false;
    qdot_expr e[2];

    s->pool = pool;
    if (qdot_switches_are_many(scene))
        QDOT_TRY(find_whether_smooth(scene, request, &smooth));
    if (smooth)
        return QDOT_OK;
    e[0] = qdot_mech_numeric_mass(scene);
    e[1] = qdot_mech_numeric_forcing(scene);
    for (size_t i = 0; i < 2; i++) {
        if (e[i] != QDOT_NIL)
            e[i] = qdot_substitute(pool, e[i], request->n_values, request->symbols,
                                   request->values);
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(collect_from_equation(s, e[i]));
        QDOT_TRY(collect_powers_of_time(s, request, e[i]));
    }
    s->mass = e[0];
    s->forcing = e[1];
    QDOT_TRY(qdot_layers_find(pool, s->surfaces.n, s->surfaces.at, 2, e));
    for (size_t k = 0; k < scene->constraints.n; k++) {
        qdot_expr f = qdot_substitute(pool, scene->constraints.at[k].f, request->n_values,
                                      request->symbols, request->values);

        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(collect_from_equation(s, f));
    }
    QDOT_TRY(find_level_function(s, scene, request, e[0]));
    if (s->level != QDOT_NIL)
        QDOT_TRY(collect_from_equation(s, s->level));
    return s->atoms.n == 0 ? QDOT_OK
                           : qdot_gates_find(pool, s->surfaces.n, s->surfaces.at, s->roots.n, s->roots.at, true, &s->gates);
}
