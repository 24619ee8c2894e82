/* assumed.c -- the facts that a check may use: those of the scene, and the conditions after `when`. */
#include "lang/declare/assumed.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/session/held.h"
#include "lang/session/momenta.h"
#include "mech/hamilton/phase-symbols.h"
#include "mech/dynamics/quantity.h"

void
qdot_assumed_free(qdot_assumed *f)
{
    qdot_free(f->relations.at);
    qdot_free(f->conditions.at);
    qdot_free(f->from.at);
    qdot_free(f->to.at);
}

qdot_status
qdot_assumed_begin(qdot_session *session, qdot_assumed *f)
{
    qdot_facts own = qdot_scene_facts(session->scene);

    f->stated = own.n_relations > 0;
    for (size_t i = 0; i < own.n_relations; i++)
        QDOT_TRY(qdot_vec_push(&f->relations, own.relations[i]));
    for (size_t i = 0; i < own.n_conditions; i++)
        QDOT_TRY(qdot_vec_push(&f->conditions, own.conditions[i]));
    return QDOT_OK;
}

qdot_expr
qdot_assumed_replace(qdot_session *session, const qdot_assumed *f, qdot_expr e)
{
    return f->from.n == 0 ? e
                          : qdot_subs(session->pool, e, f->from.n, f->from.at, f->to.at);
}

/* Add a replacement symbol = expression, and make it in the values of all earlier replacements. */
static qdot_status
add_replacement(qdot_session *session, qdot_assumed *f, qdot_expr symbol, qdot_expr value)
{
    value = qdot_assumed_replace(session, f, value);
    for (size_t i = 0; i < f->to.n; i++)
        f->to.at[i] = qdot_subs(session->pool, f->to.at[i], 1, &symbol, &value);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_vec_push(&f->from, symbol));
    return qdot_vec_push(&f->to, value);
}

static bool
is_replaceable(const qdot_pool *pool, qdot_expr symbol, qdot_expr value)
{
    return qdot_expr_kind(pool, symbol) == QDOT_SYM &&
           !qdot_expr_is_class(pool, symbol, QDOT_CONST) &&
           !qdot_expr_contains(pool, value, symbol);
}

static qdot_status
add_equation(qdot_session *session, qdot_assumed *f, qdot_expr left, qdot_expr right)
{
    f->stated = true;
    left = qdot_assumed_replace(session, f, left);
    right = qdot_assumed_replace(session, f, right);
    QDOT_TRY(qdot_pool_check(session->pool));
    if (is_replaceable(session->pool, left, right))
        return add_replacement(session, f, left, right);
    if (is_replaceable(session->pool, right, left))
        return add_replacement(session, f, right, left);
    left = qdot_sub(session->pool, left, right);
    QDOT_TRY(qdot_pool_check(session->pool));
    return qdot_vec_push(&f->relations, left);
}

/* Add a condition: an equation, an inequality, or several of them. */
static qdot_status
add_condition(qdot_session *session, qdot_assumed *f, qdot_expr e)
{
    qdot_pool *pool = session->pool;
    qdot_kind kind = qdot_expr_kind(pool, e);

    if (kind == QDOT_VEC || kind == QDOT_LIST ||
        (kind == QDOT_LOGIC && qdot_expr_node(pool, e)->op == QDOT_AND)) {
        for (uint32_t i = 0; i < qdot_expr_count(pool, e); i++) {
            qdot_expr part = qdot_expr_arg(pool, e, i);

            if (qdot_expr_kind(pool, part) != QDOT_REL)
                return qdot_fail(QDOT_ETYPE,
                                 "a condition is an equation or an inequality");
            QDOT_TRY(add_condition(session, f, part));
        }
        return QDOT_OK;
    }
    if (e == QDOT_TRUE)
        return QDOT_OK;
    if (e == QDOT_FALSE)
        return qdot_fail(QDOT_EINVAL, "this condition is never true");
    if (kind != QDOT_REL)
        return qdot_fail(QDOT_ETYPE, "a condition is an equation or an inequality");
    if (qdot_expr_node(pool, e)->op == QDOT_EQ)
        return add_equation(session, f, qdot_expr_arg(pool, e, 0),
                            qdot_expr_arg(pool, e, 1));
    return qdot_vec_push(&f->conditions, e);
}

qdot_status
qdot_assumed_constraint(qdot_session *session, qdot_assumed *f, size_t i, bool accelerations)
{
    static const unsigned orders[] = {
        [QDOT_HOLONOMIC] = 2, [QDOT_VELOCITY] = 1, [QDOT_ACCELERATION] = 0};
    unsigned most = orders[session->scene->constraints.at[i].kind];

    for (unsigned order = 0; order <= most; order++) {
        qdot_expr relation;

        if (order == most && !accelerations)
            return QDOT_OK;
        relation = qdot_mech_constraint_derivative(session->scene, i, order);
        if (qdot_phase_space_needed(session->scene))
            relation = qdot_momenta_unify(session, relation);
        relation = qdot_assumed_replace(session, f, relation);
        QDOT_TRY(qdot_pool_check(session->pool));
        QDOT_TRY(qdot_vec_push(&f->relations, relation));
    }
    return QDOT_OK;
}

qdot_status
qdot_assumed_motion(qdot_session *session, qdot_assumed *f)
{
    qdot_pool *pool = session->pool;
    qdot_expr accels = qdot_mech_accels(session->scene);
    bool unique = true; /* the multipliers are unique; otherwise their equations are kept */

    f->motion = true;
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, accels); i++) {
        qdot_expr q = session->scene->coordinates.at[i];

        QDOT_TRY(add_replacement(session, f, qdot_symbol_jet(pool, q, 2),
                                 qdot_expr_arg(pool, accels, i)));
    }
    for (size_t i = 0; i < session->scene->states.n; i++) {
        const qdot_state *state = &session->scene->states.at[i];

        QDOT_TRY(add_replacement(session, f, qdot_symbol_jet(pool, state->z, 1), state->rate));
    }
    for (size_t i = 0; i < session->scene->constraints.n; i++) {
        qdot_expr value = qdot_mech_multiplier(session->scene, i);

        unique &= value != QDOT_NIL;
        if (value != QDOT_NIL)
            QDOT_TRY(add_replacement(
                session, f, session->scene->constraints.at[i].multiplier, value));
        QDOT_TRY(qdot_assumed_constraint(session, f, i, false));
    }
    for (size_t i = 0; i < session->scene->coordinates.n && !unique; i++) {
        qdot_expr equation =
            qdot_mech_equation(session->scene, session->scene->coordinates.at[i]);

        QDOT_TRY(qdot_pool_check(pool));
        equation = qdot_assumed_replace(session, f, qdot_sub(pool, qdot_expr_arg(pool, equation, 0),
                                                             qdot_expr_arg(pool, equation, 1)));
        QDOT_TRY(qdot_pool_check(pool));
        if (equation != QDOT_ZERO)
            QDOT_TRY(qdot_vec_push(&f->relations, equation));
    }
    return QDOT_OK;
}

qdot_status
qdot_assumed_in_velocities(qdot_session *session, qdot_assumed *f)
{
    qdot_pool *pool = session->pool;
    size_t kept = 0;

    for (size_t i = 0; i < f->from.n; i++) {
        qdot_expr to = qdot_momenta_unify(session, f->to.at[i]);

        if (qdot_expr_is_class(pool, f->from.at[i], QDOT_MOMENTUM)) {
            qdot_expr p = qdot_momenta_unify(session, f->from.at[i]);

            QDOT_TRY(qdot_vec_push(&f->relations, qdot_sub(pool, p, to)));
        } else {
            f->from.at[kept] = f->from.at[i];
            f->to.at[kept++] = to;
        }
    }
    f->from.n = f->to.n = kept;
    for (size_t i = 0; i < f->relations.n; i++)
        f->relations.at[i] = qdot_momenta_unify(session, f->relations.at[i]);
    for (size_t i = 0; i < f->conditions.n; i++)
        f->conditions.at[i] = qdot_momenta_unify(session, f->conditions.at[i]);
    return qdot_pool_check(pool);
}

qdot_status
qdot_assumed_hold(qdot_session *session, qdot_assumed *f)
{
    for (size_t i = 0; i < f->relations.n; i++)
        f->relations.at[i] = qdot_held_apply(session, f->relations.at[i]);
    for (size_t i = 0; i < f->conditions.n; i++)
        f->conditions.at[i] = qdot_held_apply(session, f->conditions.at[i]);
    for (size_t i = 0; i < f->to.n; i++)
        f->to.at[i] = qdot_held_apply(session, f->to.at[i]);
    return qdot_pool_check(session->pool);
}

qdot_status
qdot_assumed_add(qdot_record *r, const qdot_filled *part, qdot_assumed *f)
{
    qdot_session *session = r->cursor.session;
    const char *label;
    qdot_expr e;
    const qdot_status named = qdot_record_bare_name(r, part, 0, &label);

    if (named != QDOT_OK && named != QDOT_ETYPE) /* eom[x] with an index that is no integer: not a label */
        return named;
    if (named == QDOT_OK && label != NULL && qdot_names_find(session->names, label) == NULL) {
        bool found = strcmp(label, "eom") == 0;

        qdot_record_blame(r, part);
        if (found)
            QDOT_TRY(qdot_assumed_motion(session, f));
        for (size_t i = 0; i < session->scene->constraints.n; i++) {
            const qdot_constraint *one = &session->scene->constraints.at[i];

            if (one->label == NULL || strcmp(one->label, label) != 0)
                continue;
            found = true;
            QDOT_TRY(qdot_assumed_constraint(session, f, i, true));
        }
        if (found)
            return QDOT_OK;
    }
    QDOT_TRY(qdot_record_value(r, part, &e));
    qdot_record_blame(r, part);
    return add_condition(session, f, e);
}
