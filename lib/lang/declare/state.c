/* state.c -- the statement `state`: declares first-order unknowns with their rates. */
#include "expr/symbol.h"
#include "lang/commands/set.h"
#include "lang/declare/declare.h"
#include "lang/session/measured.h"
#include "lang/session/units.h"
#include "mech/scene/scene.h"

static qdot_status declare_states(qdot_record *r);
static qdot_status declare_names(qdot_record *r);

QDOT_STATEMENT(state) = {
    .word = "state",
    .group = QDOT_DECLARING,
    .usage = "state Z' = EXPR, ...",
    .summary = "unknowns of first order, such as those of a filter, a motor, a controller: forces, events and columns may "
               "read them, nothing pulls on them",
    .example = "state z' = x - z",
    .nameable = true,
    .handler = declare_states,
    .names = declare_names,
};

/* Declare the name of a state whose equation begins at this part; *fresh: it was not declared before. */
static qdot_status
declare_name(qdot_record *r, const qdot_filled *part, bool *fresh)
{
    qdot_session *session = r->cursor.session;
    qdot_name entry = {.kind = QDOT_NAME_COORD};
    const qdot_name *old;
    const char *name;

    *fresh = false;
    QDOT_TRY(qdot_record_name(r, part, &name));
    if (part->to != part->primes + 1)
        return qdot_record_expected(r, part->to > part->primes ? part->primes + 1 : part->primes, "one prime, as in z' = ...");
    old = qdot_names_find(session->names, name);
    if (old != NULL && old->kind == QDOT_NAME_COORD && qdot_scene_state_of(session->scene, old->value) != NULL
        && qdot_scene_state_of(session->scene, old->value)->rate == QDOT_NIL)
        return QDOT_OK;
    r->cursor.error_at = part->name->start;
    if (old != NULL)
        return qdot_fail(QDOT_ENAME, "`%s` was declared before, at %s:%u", name, old->file, old->line);
    entry.name = (char *)name;
    entry.value = qdot_symbol_get(session->pool, QDOT_COORD, name);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_declare_name(&r->cursor, part->name, NULL, &entry));
    *fresh = true;
    qdot_symbol_domain(session->pool, entry.value, QDOT_NIL, false, QDOT_NIL, false);
    QDOT_TRY(qdot_declare_meet_functions(session, name, entry.value));
    return qdot_scene_state(session->scene, entry.value, QDOT_NIL);
}

static qdot_status
declare_names(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_scene *scene = session->scene;
    const size_t coordinates = scene->coordinates.n, states = scene->states.n;
    qdot_vec(const char *) fresh = {0};
    qdot_status status = QDOT_OK;

    for (const qdot_filled *part = qdot_record_hole(r, NULL, "Z'"); part != NULL && status == QDOT_OK;
         part = qdot_record_next(r, part, "Z'")) {
        const char *name;
        bool is_fresh;

        status = declare_name(r, part, &is_fresh);
        if (is_fresh && (qdot_record_name(r, part, &name) != QDOT_OK || qdot_vec_push(&fresh, name) != QDOT_OK))
            status = QDOT_ENOMEM;
    }
    if (status != QDOT_OK) {
        while (fresh.n > 0)
            qdot_names_remove(session->names, fresh.at[--fresh.n]);
        scene->coordinates.n = coordinates;
        scene->states.n = states;
        qdot_scene_changed(scene);
    }
    qdot_free(fresh.at);
    return status;
}

static qdot_status
read_rates(qdot_record *r)
{
    qdot_session *session = r->cursor.session;

    for (const qdot_filled *part = qdot_record_hole(r, NULL, "Z'"); part != NULL; part = qdot_record_next(r, part, "Z'")) {
        const qdot_filled *right = qdot_record_next(r, part, "EXPR");
        const char *name;
        qdot_expr rate, z;

        QDOT_TRY(qdot_record_name(r, part, &name));
        QDOT_TRY(qdot_record_scalar(r, right, &rate));
        rate = qdot_measured_as_rationals(session, rate);
        QDOT_TRY(qdot_pool_check(session->pool));
        qdot_record_blame(r, right);
        z = qdot_names_find(session->names, name)->value;
        if (!qdot_expr_is_constant(session->pool, rate)) /* a bare number is one in SI units */
            QDOT_TRY(qdot_units_join(session, qdot_symbol_jet(session->pool, z, 1), rate, "the rate of the state is %s, its right side %s"));
        QDOT_TRY(qdot_scene_state(session->scene, z, rate));
    }
    return QDOT_OK;
}

static qdot_status
declare_states(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_scene *scene = session->scene;
    const size_t coordinates = scene->coordinates.n, states = scene->states.n;
    qdot_status status = declare_names(r);

    if (status != QDOT_OK)
        return status;
    status = read_rates(r);
    if (status != QDOT_OK) { /* the names go again, but those that a loop has declared */
        while (scene->coordinates.n > coordinates)
            qdot_names_remove(session->names, qdot_expr_symbol(session->pool, scene->coordinates.at[--scene->coordinates.n])->name);
        scene->states.n = states;
        qdot_scene_changed(scene);
    }
    return status;
}
