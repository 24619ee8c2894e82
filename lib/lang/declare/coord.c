/* coord.c -- the statement `coord`: declares generalized coordinates with their domains. */
#include <string.h>

#include "base/interrupt.h"
#include "lang/declare/new-names.h"
#include "lang/session/evaluation.h"
#include "lang/source/source.h"

static qdot_status declare_coordinates(qdot_record *r);

QDOT_STATEMENT(coord) = {
    .word = "coord",
    .group = QDOT_DECLARING,
    .usage = "coord NAME, LO < NAME < HI, ...",
    .summary = "declare generalized coordinates, each with its own domain",
    .example = "coord r > 0, 0 < theta < pi, phi",
    .handler = declare_coordinates,
};

/* Whether the coordinate was declared by this statement, in an earlier pass of its loop: x in `coord x, q[k] for k = 1..3`. */
static bool
is_of_earlier_pass(const qdot_cursor *c, const qdot_new_name *x)
{
    const qdot_name *old = qdot_names_find(c->session->names, x->name);
    uint32_t line, column;

    if (c->session->evaluation->loops == 0 || old == NULL || old->kind != QDOT_NAME_COORD || strchr(x->name, '[') != NULL)
        return false;
    qdot_source_locate(c->source, x->start->start, &line, &column);
    return old->line == line && strcmp(old->file, c->source->name) == 0;
}

static void
leave_out_earlier_passes(const qdot_cursor *c, qdot_new_names *list)
{
    size_t kept = 0;

    for (size_t i = 0; i < list->n; i++)
        if (!is_of_earlier_pass(c, &list->at[i]))
            list->at[kept++] = list->at[i];
    list->n = kept;
}

/* That every name of a coord statement is free is seen first: a scene keeps its
 * coordinates. */
static qdot_status
check_coordinates(qdot_cursor *c, const qdot_new_names *list)
{
    for (size_t i = 0; i < list->n; i++) {
        const qdot_new_name *x = &list->at[i];
        const qdot_name *old = qdot_names_find(c->session->names, x->name);

        c->error_at = x->start->start;
        QDOT_TRY(qdot_interrupt_check());
        if (old != NULL)
            return qdot_fail(QDOT_ENAME, "`%s` was declared before, at %s:%u", x->name,
                             old->file, old->line);
        for (size_t k = 0; k < i; k++)
            if (strcmp(list->at[k].name, x->name) == 0)
                return qdot_fail(QDOT_ENAME, "`%s` is named twice", x->name);
    }
    return QDOT_OK;
}

static qdot_status
declare_coordinates(qdot_record *r)
{
    qdot_new_names list = {0};
    qdot_status status = qdot_new_names_read(r, false, &list);

    if (status == QDOT_OK)
        leave_out_earlier_passes(&r->cursor, &list);
    if (status == QDOT_OK)
        status = check_coordinates(&r->cursor, &list);
    if (status == QDOT_OK)
        status = qdot_new_names_declare(&r->cursor, QDOT_NAME_COORD, &list);
    qdot_free(list.at);
    return status;
}
