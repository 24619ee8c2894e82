/* speed.c -- the statement `speed`: names combinations of velocities in which the equations of motion are written. */
#include "expr/build.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "lang/declare/declare.h"
#include "lang/session/speeds.h"
#include "lang/syntax/record.h"

static qdot_status declare_speeds(qdot_record *r);

QDOT_STATEMENT(speed) = {
    .word = "speed",
    .group = QDOT_DECLARING,
    .usage = "speed NAME = EXPR, ...",
    .summary = "name combinations of velocities, linear in them: eom then has a first-order equation for each, without "
               "multipliers, and the kinematic ones",
    .example = "speed v = x'*cos(phi) + y'*sin(phi), w = phi'",
    .nameable = true,
    .handler = declare_speeds,
};

static qdot_status
declare_speed(qdot_record *r, const qdot_filled *part)
{
    qdot_session *s = r->cursor.session;
    qdot_pool *pool = s->pool;
    qdot_name entry = {.kind = QDOT_NAME_SPEED};
    const char *name;
    qdot_expr E;

    QDOT_TRY(qdot_record_new_name(r, part, &name));
    QDOT_TRY(qdot_record_scalar(r, part + 1, &E));
    qdot_record_blame(r, part + 1);
    E = qdot_session_speeds_replaced(s, E);
    QDOT_TRY(qdot_pool_check(pool));
    if (!(qdot_expr_node(pool, E)->holds & QDOT_HAS_VELOCITY) || (qdot_expr_node(pool, E)->holds & QDOT_HAS_ACCELERATION)) {
        (void)qdot_fail(QDOT_EINVAL, "a speed is a combination of velocities");
        return qdot_hint("as in speed v = x'*cos(phi) + y'*sin(phi)");
    }
    QDOT_TRY(qdot_speeds_check_linear(s->scene, E, name));
    entry.name = (char *)name;
    entry.value = qdot_symbol_get(pool, QDOT_COORD, name);
    entry.formals = qdot_list(pool, 1, &E);
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_declare_name(&r->cursor, part->name, NULL, &entry);
}

static qdot_status
declare_speeds(qdot_record *r)
{
    for (size_t i = 1; i < r->parts.n; i++)
        if (r->parts.at[i].node->kind == QDOT_USAGE_HOLE && r->parts.at[i].name != NULL)
            QDOT_TRY(declare_speed(r, &r->parts.at[i]));
    return QDOT_OK;
}
