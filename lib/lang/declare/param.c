/* param.c -- the statement `param`: declares symbols with their domains and values. */
#include "lang/commands/value-check.h"
#include "lang/declare/new-names.h"
#include "lang/session/bind.h"
#include "lang/session/values.h"

static qdot_status declare_parameters(qdot_record *r);

QDOT_STATEMENT(param) = {
    .word = "param",
    .group = QDOT_DECLARING,
    .usage = "param NAME [> 0] [= VALUE], ...",
    .summary = "declare parameters; a sign spreads back over the bare names before it",
    .example = "param m, L > 0, g = 9.81",
    .handler = declare_parameters,
};

/* Check the new values of parameters that have been declared before. */
static qdot_status
check_new_values(qdot_cursor *c, const qdot_new_names *list)
{
    qdot_pairs values = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < list->n && status == QDOT_OK; i++) {
        const qdot_new_name *x = &list->at[i];
        const qdot_name *old = qdot_names_find(c->session->names, x->name);

        if (x->value != QDOT_NIL && old != NULL && old->kind == QDOT_NAME_PARAM)
            status = qdot_pairs_push(&values, x->start, old->value, x->value);
    }
    if (status == QDOT_OK)
        status = qdot_value_check(c, &values);
    qdot_pairs_free(&values);
    return status;
}

/* Declare parameters with their values; if a value is outside its domain undo all. */
static qdot_status
declare_parameter_list(qdot_cursor *c, const qdot_new_names *list)
{
    qdot_session *session = c->session;
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < list->n; i++) {
        const qdot_new_name *x = &list->at[i];
        const qdot_name *old = qdot_names_find(session->names, x->name);
        double number, bound;

        c->error_at = x->start->start;
        if (x->value != QDOT_NIL && old != NULL && old->kind == QDOT_NAME_PARAM)
            QDOT_TRY(qdot_session_in_domain(session, old->value, x->value));
        if (x->value == QDOT_NIL || !x->own ||
            qdot_session_number(session, x->value, &number, NULL) != QDOT_OK)
            continue;
        c->error_at = x->start->start;
        if ((x->lo != QDOT_NIL &&
             qdot_session_number(session, x->lo, &bound, NULL) == QDOT_OK &&
             (number < bound || (x->lo_open && number == bound))) ||
            (x->hi != QDOT_NIL &&
             qdot_session_number(session, x->hi, &bound, NULL) == QDOT_OK &&
             (number > bound || (x->hi_open && number == bound))))
            return qdot_fail(QDOT_EDOMAIN, "%s = %.10g is outside its own domain",
                             x->name, number);
    }
    QDOT_TRY(check_new_values(c, list));
    QDOT_TRY(qdot_new_names_declare(c, QDOT_NAME_PARAM, list));
    for (size_t i = 0; i < list->n && status == QDOT_OK; i++)
        if (list->at[i].value != QDOT_NIL)
            qdot_session_set(session,
                             qdot_names_find(session->names, list->at[i].name)->value,
                             list->at[i].value, &status);
    return status;
}

static qdot_status
declare_parameters(qdot_record *r)
{
    qdot_new_names list = {0};
    qdot_status status = qdot_new_names_read(r, true, &list);

    if (status == QDOT_OK)
        status = declare_parameter_list(&r->cursor, &list);
    qdot_free(list.at);
    return status;
}
