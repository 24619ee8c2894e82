/* reset.c -- the statement `reset`: forgets everything, or the scene, the initial state, or the scales. */
#include "base/text.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/language/function.h"
#include "lang/session/evaluation.h"
#include "lang/session/measured.h"
#include "lang/session/names.h"
#include "lang/session/output.h"
#include "lang/session/session.h"
#include "lang/session/transfer.h"
#include "lang/session/undo.h"
#include "lang/session/units.h"
#include "lang/session/values.h"
#include "lang/syntax/record.h"
#include "mech/scene/things.h"

static qdot_status carry_out_reset(qdot_record *r);

QDOT_STATEMENT(reset) = {
    .word = "reset",
    .group = QDOT_DECLARING,
    .usage = "reset | reset scene | reset start | reset scale",
    .summary = "forget everything, or the scene, the initial state, the scales",
    .example = "reset scene",
    .handler = carry_out_reset,
};

/* Classes of symbols that belong to a scene. */
enum {
    SCENE = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MOMENTUM |
            QDOT_HAS_MULTIPLIER | QDOT_HAS_DELTA | QDOT_HAS_DIFFERENTIAL
};

/* Whether a name survives `reset scene`: parameters, and values without symbols of the scene. */
static bool
survives_reset_of_scene(const qdot_pool *pool, const qdot_name *name)
{
    return name->kind != QDOT_NAME_COORD &&
           (qdot_expr_node(pool, name->value)->holds & SCENE) == 0;
}

/* Whether a function survives `reset scene`: its body mentions only names that survive. */
static bool
is_function_kept(const qdot_session *session, const qdot_name *function)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(session->names, i)) != NULL; i++)
        if (!survives_reset_of_scene(session->pool, name) &&
            qdot_function_mentions(session->pool, function, name->name))
            return false;
    return true;
}

/* Whether the name is a Routhian: its value holds velocities, and momenta only of coordinates that do not stand in it; or was
 * one when it was kept. */
static bool
is_routhian(const qdot_session *old, const qdot_name *name)
{
    const uint32_t holds = name->kind == QDOT_NAME_VALUE ? qdot_expr_node(old->pool, name->value)->holds : 0;

    if (name->routhian)
        return true;
    if (!(holds & QDOT_HAS_VELOCITY) || !(holds & QDOT_HAS_MOMENTUM) || !qdot_expr_is_scalar(old->pool, name->value))
        return false;
    for (size_t i = 0; i < old->scene->coordinates.n; i++) {
        const qdot_expr q = old->scene->coordinates.at[i];

        if (qdot_expr_contains(old->pool, name->value, qdot_symbol_of(old->pool, QDOT_MOMENTUM, q)) &&
            (qdot_expr_contains(old->pool, name->value, q) ||
             qdot_expr_contains(old->pool, name->value, qdot_symbol_jet(old->pool, q, 1))))
            return false;
    }
    return true;
}

/* Keep a Routhian as a Lagrangian for the coordinates that are left: its momenta p[phi] become parameters p_phi. */
static qdot_status
copy_routhian(qdot_session *old, qdot_session *fresh, const qdot_name *name)
{
    qdot_name copy = *name;

    copy.value = qdot_transfer(old->pool, fresh->pool, name->value);
    for (size_t i = 0; i < old->scene->coordinates.n && copy.value != QDOT_NIL; i++) {
        const qdot_expr q = qdot_transfer(old->pool, fresh->pool, old->scene->coordinates.at[i]),
                        p = qdot_symbol_of(fresh->pool, QDOT_MOMENTUM, q);
        qdot_name parameter = {.kind = QDOT_NAME_PARAM, .file = name->file, .line = name->line, .column = name->column};
        qdot_text spelled = {0};
        qdot_status status = QDOT_OK;

        if (!qdot_expr_contains(fresh->pool, copy.value, p))
            continue;
        qdot_text_format(&spelled, "p_%s", qdot_expr_symbol(fresh->pool, q)->name);
        parameter.name = (char *)qdot_text_str(&spelled);
        parameter.value = qdot_symbol_get(fresh->pool, QDOT_PARAM, parameter.name);
        copy.value = qdot_subs(fresh->pool, copy.value, 1, &p, &parameter.value);
        if (qdot_text_status(&spelled) != QDOT_OK)
            status = QDOT_ENOMEM;
        else if (qdot_names_find(fresh->names, parameter.name) == NULL)
            status = qdot_names_declare(fresh->names, &parameter);
        qdot_text_clear(&spelled);
        QDOT_TRY(status);
    }
    copy.over = QDOT_NIL;
    copy.routhian = true;
    QDOT_TRY(qdot_pool_check(fresh->pool));
    return qdot_names_declare(fresh->names, &copy);
}

/* Carry what is kept of `old` over into `fresh`, which has a pool and names of its
 * own. */
static qdot_status
copy_surviving_names(qdot_session *old, qdot_session *fresh)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(old->names, i)) != NULL; i++) {
        qdot_name copy = *name;

        if (is_routhian(old, name)) {
            QDOT_TRY(copy_routhian(old, fresh, name));
            continue;
        }
        if (!survives_reset_of_scene(old->pool, name) ||
            (name->kind == QDOT_NAME_FUNCTION && !is_function_kept(old, name)))
            continue;
        copy.value = qdot_transfer(old->pool, fresh->pool, name->value);
        copy.formals = qdot_transfer(old->pool, fresh->pool, name->formals);
        copy.over = QDOT_NIL; /* the coordinates are removed with the scene */
        QDOT_TRY(qdot_pool_check(fresh->pool));
        if (name->kind == QDOT_NAME_UFUN)
            copy.ufun = qdot_expr_node(fresh->pool, copy.value)->op;
        QDOT_TRY(qdot_names_declare(fresh->names, &copy));
        if (name->kind == QDOT_NAME_PARAM)
            QDOT_TRY(qdot_units_transfer(old, name->value, fresh, copy.value));
    }
    for (size_t i = 0; i < old->values->set_symbols.n; i++) {
        const qdot_node *symbol = qdot_expr_node(old->pool, old->values->set_symbols.at[i]);

        if (symbol->holds & QDOT_HAS_MOMENTUM)
            continue;
        if (symbol->kind == QDOT_UFUN &&
            qdot_names_find(fresh->names, qdot_ufun_get(old->pool, symbol->op)->name) ==
                NULL)
            continue;
        QDOT_TRY(
            qdot_vec_push(&fresh->values->set_symbols,
                          qdot_transfer(old->pool, fresh->pool, old->values->set_symbols.at[i])));
        QDOT_TRY(qdot_vec_push(&fresh->values->set_values, qdot_transfer(old->pool, fresh->pool,
                                                                 old->values->set_values.at[i])));
    }
    for (size_t i = 0; i < old->scene->assumed.n; i++) {
        const qdot_assumption *said = &old->scene->assumed.at[i];

        if (!(qdot_expr_node(old->pool, said->relation)->holds & SCENE))
            QDOT_TRY(qdot_scene_assume(
                fresh->scene, qdot_transfer(old->pool, fresh->pool, said->relation),
                said->turned));
    }
    for (size_t i = 0; i < old->measured->n; i++) {
        qdot_measured m = old->measured->at[i];

        m.symbol = qdot_transfer(old->pool, fresh->pool, m.symbol);
        if (m.digits > 0)
            m.exact = qdot_transfer(old->pool, fresh->pool, m.exact);
        QDOT_TRY(qdot_vec_push(fresh->measured, m));
    }
    return qdot_pool_check(fresh->pool);
}

/* Clear the scene, or everything in the session. */
static qdot_status
reset_session(qdot_session *session, bool everything)
{
    qdot_session *fresh;
    qdot_status status = QDOT_OK;

    if (session->evaluation->loops > 0)
        return qdot_fail(QDOT_EINVAL, "`reset` has no place inside a loop");
    fresh = qdot_session_new(session->output->out, session->output->err);
    if (fresh == NULL)
        return QDOT_ENOMEM;
    if (!everything)
        status = copy_surviving_names(session, fresh);
    if (status != QDOT_OK) {
        qdot_session_free(fresh);
        return status;
    }
    qdot_session_exchange(session, fresh);
    qdot_undo_reset(session, fresh);
    return QDOT_OK;
}

static qdot_status
carry_out_reset(qdot_record *r)
{
    qdot_session *session = r->cursor.session;

    r->cursor.error_at = r->start->start;
    if (qdot_record_word(r, "start") != NULL) {
        session->values->start_symbols.n = 0;
        session->values->start_exactly = false;
        session->values->start_values.n = session->values->start_errors.n = 0;
        return QDOT_OK;
    }
    if (qdot_record_word(r, "scale") != NULL) {
        session->values->scale_symbols.n = session->values->scale_values.n = 0;
        return QDOT_OK;
    }
    return reset_session(session, qdot_record_word(r, "scene") == NULL);
}
