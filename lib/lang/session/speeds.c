/* speeds.c -- the speeds of a session, and expressions in them. */
#include "lang/session/speeds.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/session/names.h"
#include "mech/scene/scene.h"
#include "normal/simplify/simplify.h"

/* The k-th speed; NULL past the end. */
static const qdot_name *
speed_at(const qdot_session *s, size_t k)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(s->names, i)) != NULL; i++)
        if (name->kind == QDOT_NAME_SPEED && k-- == 0)
            return name;
    return NULL;
}

bool
qdot_session_has_speeds(const qdot_session *s)
{
    return speed_at(s, 0) != NULL;
}

bool
qdot_session_is_speed(const qdot_session *s, qdot_expr symbol)
{
    const qdot_name *speed;

    for (size_t k = 0; (speed = speed_at(s, k)) != NULL; k++)
        if (speed->value == symbol)
            return true;
    return false;
}

qdot_status
qdot_session_speeds(const qdot_session *s, qdot_speeds *speeds)
{
    qdot_expr *both;
    size_t n = 0;

    while (speed_at(s, n) != NULL)
        n++;
    both = qdot_calloc(2 * n + 1, sizeof *both);
    if (both == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < n; k++) {
        both[k] = speed_at(s, k)->value;
        both[n + k] = qdot_expr_arg(s->pool, speed_at(s, k)->formals, 0);
    }
    *speeds = (qdot_speeds){n, both, both + n};
    return QDOT_OK;
}

qdot_expr
qdot_session_speeds_replaced(const qdot_session *s, qdot_expr e)
{
    const qdot_name *speed;

    for (size_t k = 0; e != QDOT_NIL && (speed = speed_at(s, k)) != NULL; k++) {
        const qdot_expr u[] = {speed->value, qdot_symbol_jet(s->pool, speed->value, 1)};
        qdot_expr E[] = {qdot_expr_arg(s->pool, speed->formals, 0), QDOT_NIL};

        if (!qdot_expr_contains(s->pool, e, u[0]) && !qdot_expr_contains(s->pool, e, u[1]))
            continue;
        E[1] = qdot_ddt(s->pool, E[0]);
        e = E[1] == QDOT_NIL ? QDOT_NIL : qdot_subs(s->pool, e, 2, u, E);
    }
    return e;
}

bool
qdot_session_speeds_meet(const qdot_session *s, uint32_t n, const qdot_expr *e)
{
    const qdot_scene *scene = s->scene;
    const qdot_name *speed;
    bool held = false;

    for (size_t k = 0; !held && (speed = speed_at(s, k)) != NULL; k++)
        held = qdot_expr_is_in_any(s->pool, speed->value, n, e) ||
               qdot_expr_is_in_any(s->pool, qdot_symbol_jet(s->pool, speed->value, 1), n, e);
    for (size_t i = 0; held && i < scene->coordinates.n; i++)
        for (unsigned order = 1; order <= 2; order++)
            if (qdot_expr_is_in_any(s->pool, qdot_symbol_jet(s->pool, scene->coordinates.at[i], order), n, e))
                return true;
    return false;
}

/* --- equations of motion ------------------------------------------------------------- */

/* all [speeds + coordinates]: the equations. */
static qdot_status
derive_equations(qdot_session *s, const qdot_speeds *speeds, qdot_expr *all)
{
    qdot_scene *scene = s->scene;
    const qdot_expr *velocity, *equation;

    QDOT_TRY(qdot_speeds_motion(scene, speeds, &velocity, &equation));
    for (size_t k = 0; k < speeds->n; k++)
        all[k] = equation[k];
    for (size_t i = 0; i < scene->coordinates.n; i++)
        all[speeds->n + i] = qdot_rel(s->pool, QDOT_EQ, qdot_symbol_jet(s->pool, scene->coordinates.at[i], 1), velocity[i]);
    return qdot_pool_check(s->pool);
}

qdot_status
qdot_session_speeds_eom(qdot_session *s, qdot_expr for_one, qdot_expr *value)
{
    const qdot_scene *scene = s->scene;
    qdot_speeds speeds;
    qdot_expr *all;
    qdot_status status;
    size_t n;

    QDOT_TRY(qdot_session_speeds(s, &speeds));
    n = speeds.n + scene->coordinates.n;
    all = qdot_calloc(n, sizeof *all);
    status = all == NULL ? QDOT_ENOMEM : derive_equations(s, &speeds, all);
    if (status == QDOT_OK && for_one == QDOT_NIL)
        status = qdot_value_kind_give(s->pool, qdot_list(s->pool, (uint32_t)n, all), value);
    else if (status == QDOT_OK) {
        *value = QDOT_NIL;
        for (size_t k = 0; k < n; k++)
            if (for_one == (k < speeds.n ? speeds.symbol[k] : scene->coordinates.at[k - speeds.n]))
                *value = all[k];
        if (*value == QDOT_NIL)
            status = qdot_fail(QDOT_ETYPE, "eom[ ] takes a speed or a coordinate");
    }
    qdot_free(all);
    qdot_free((void *)speeds.symbol);
    return status;
}

bool
qdot_session_in_speeds(qdot_session *s, qdot_expr e)
{
    const uint32_t others = QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MOMENTUM | QDOT_HAS_MULTIPLIER;
    const qdot_name *speed;
    bool held = false;
    size_t n = 0;

    for (; (speed = speed_at(s, n)) != NULL; n++)
        held |= qdot_expr_contains(s->pool, e, speed->value);
    return held && !(qdot_expr_node(s->pool, e)->holds & others) && qdot_speeds_suffice(s->scene, n);
}

qdot_expr
qdot_session_speeds_rate(qdot_session *s, qdot_expr e)
{
    const qdot_facts facts = qdot_scene_facts(s->scene);
    qdot_scene *states = NULL;
    qdot_speeds speeds;
    qdot_status status = qdot_session_speeds(s, &speeds);

    if (status == QDOT_OK)
        status = qdot_speeds_scene(s->scene, &speeds, &states);
    if (status == QDOT_OK)
        e = qdot_simplify(s->pool, qdot_scene_with_rates(states, qdot_ddt(s->pool, e)), &facts);
    qdot_scene_free(states);
    if (status == QDOT_OK)
        qdot_free((void *)speeds.symbol);
    return status == QDOT_OK ? e : qdot_pool_fail(s->pool);
}

qdot_status
qdot_session_speeds_members(qdot_session *s, qdot_expr *over)
{
    const size_t n = s->scene->coordinates.n;
    qdot_vec(qdot_expr) all = {0};
    const qdot_name *speed;
    qdot_status status = QDOT_OK;

    for (size_t k = 0; status == QDOT_OK && (speed = speed_at(s, k)) != NULL; k++)
        status = qdot_vec_push(&all, speed->value);
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        status = qdot_vec_push(&all, s->scene->coordinates.at[i]);
    if (status == QDOT_OK)
        status = qdot_value_kind_give(s->pool, qdot_list(s->pool, (uint32_t)all.n, all.at), over);
    qdot_free(all.at);
    return status;
}
