/* event.c -- the statement `event`: declares a condition at which a run stops or changes its state. */
#include "lang/commands/set.h"
#include "lang/session/measured.h"
#include "lang/session/phase.h"

static qdot_status declare_event(qdot_record *r);

QDOT_STATEMENT(event) = {
    .word = "event",
    .group = QDOT_DECLARING,
    .usage = "event NAME: A = B [rising|falling] [stop] [then NAME = VALUE, ...]",
    .summary = "a moment of a run: it is noted, ends the run, or changes coordinates, velocities and, for "
               "the rest of the run, parameters",
    .example = "event cross: theta = 0 rising stop",
    .handler = declare_event,
};

/* Find what `then` sets: a coordinate, a velocity or a parameter. */
static qdot_status
find_target_of_event(qdot_record *r, const qdot_filled *part, qdot_expr *target)
{
    const qdot_session *session = r->cursor.session;
    const qdot_name *known;
    const char *name;

    if (qdot_phase_has(session) && qdot_set_is_momentum(session, part))
        return qdot_set_find_jet(r, part, target);
    QDOT_TRY(qdot_record_name(r, part, &name));
    known = qdot_names_find(session->names, name);
    if (known != NULL && known->kind == QDOT_NAME_PARAM) {
        *target = known->value;
        return qdot_record_no_prime(r, part, "`=`");
    }
    if (known != NULL && known->kind == QDOT_NAME_COORD)
        return qdot_set_find_jet(r, part, target);
    qdot_record_blame(r, part);
    if (known == NULL)
        return qdot_set_unknown(session, "coordinate and no parameter", name);
    (void)qdot_fail(QDOT_ENAME, "`%s` is not a coordinate or a parameter", name);
    return qdot_hint("`then` sets coordinates, velocities and parameters");
}

/* Read `Q = VALUE, Q' = VALUE, PARAMETER = VALUE` after `then`. */
static qdot_status
add_changes_of_event(qdot_record *r, qdot_event *event)
{
    qdot_session *session = r->cursor.session;

    for (const qdot_filled *part = qdot_record_hole(r, "then", "NAME"); part != NULL;
         part = qdot_record_next(r, part, "NAME")) {
        qdot_expr target, value;

        QDOT_TRY(find_target_of_event(r, part, &target));
        QDOT_TRY(qdot_record_scalar(r, qdot_record_next(r, part, "VALUE"), &value));
        QDOT_TRY(qdot_set_check_dimension(r, qdot_record_next(r, part, "VALUE"), target, value));
        value = qdot_measured_as_rationals(session, value);
        QDOT_TRY(qdot_pool_check(session->pool));
        QDOT_TRY(qdot_vec_push(&event->targets, target));
        QDOT_TRY(qdot_vec_push(&event->values, value));
    }
    return QDOT_OK;
}

static qdot_status
read_event(qdot_record *r, qdot_event *event)
{
    qdot_session *session = r->cursor.session;
    const char *name;

    QDOT_TRY(qdot_record_name(r, qdot_record_hole(r, "event", "NAME"), &name));
    event->name = (char *)name;
    QDOT_TRY(qdot_record_equation(r, qdot_record_hole(r, NULL, "A"), true, &event->left, &event->right));
    event->left = qdot_measured_as_rationals(session, event->left);
    event->right = qdot_measured_as_rationals(session, event->right);
    QDOT_TRY(qdot_pool_check(session->pool));
    event->way = (qdot_record_word(r, "rising") != NULL) - (qdot_record_word(r, "falling") != NULL);
    event->stop = qdot_record_word(r, "stop") != NULL;
    return add_changes_of_event(r, event);
}

static qdot_status
declare_event(qdot_record *r)
{
    qdot_event event = {0};
    qdot_status status = read_event(r, &event);

    if (status == QDOT_OK) {
        r->cursor.error_at = r->start->start;
        status = qdot_scene_event(r->cursor.session->scene, &event);
    }
    qdot_free(event.targets.at);
    qdot_free(event.values.at);
    return status;
}
