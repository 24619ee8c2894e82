/* operands.c -- reads the expressions to be evaluated along runs, for tables and curves. */
#include "lang/commands/operands.h"

#include "expr/node.h"
#include "expr/walk.h"
#include "lang/language/outdated.h"
#include "lang/language/token-text.h"
#include "lang/session/member.h"

void
qdot_operand_clear(qdot_operand *o)
{
    qdot_free(o->label);
    qdot_free(o->columns.at);
}

void
qdot_operands_free(qdot_operands *list)
{
    for (size_t i = 0; i < list->n; i++)
        qdot_operand_clear(&list->at[i]);
    qdot_free(list->at);
}

/* Find the run to which an operand refers: the only one named in it, or the first of several. */
static qdot_status
find_run_of_operand(qdot_operand *o, const char **run, qdot_expr *e)
{
    if (!qdot_expr_is_scalar(o->session->pool, *e))
        return QDOT_OK;
    QDOT_TRY(qdot_member_resolve(o->session, run, e, &o->mixed));
    for (size_t i = 0; o->mixed && *run == NULL && i < o->session->members->n; i++)
        if (qdot_expr_contains(o->session->pool, *e, o->session->members->at[i].symbol))
            *run = o->session->members->at[i].run;
    return QDOT_OK;
}

qdot_status
qdot_operand_find(qdot_record *r, const qdot_filled *part, size_t k, qdot_operand *o)
{
    const qdot_compiled *program = &r->compiled.at[part->first + k];
    qdot_cursor *c = &r->cursor;
    qdot_named_run *named = NULL;
    qdot_text label = {0};
    qdot_status status;
    const char *run;
    qdot_expr e;

    QDOT_TRY(qdot_compiled_member(c, program, &e, &run));
    c->error_at = program->from->start;
    o->session = c->session;
    o->from = program->from;
    o->to = program->to;
    QDOT_TRY(find_run_of_operand(o, &run, &e));
    if (run != NULL)
        QDOT_TRY(qdot_runs_read(c->session, run, &named));
    o->run = named != NULL ? named->run : NULL;
    o->vector = qdot_expr_kind(c->session->pool, e) == QDOT_VEC;
    QDOT_TRY(qdot_runs_flatten(c->session, e, &o->columns));
    qdot_token_text(c->session, program->from, program->to, &label);
    status = qdot_text_status(&label);
    if (status == QDOT_OK)
        o->label = label.at;
    else
        qdot_text_clear(&label);
    return status;
}

qdot_status
qdot_operands_find(qdot_record *r, const qdot_filled *first, qdot_operands *list)
{
    for (const qdot_filled *part = first; part != NULL; part = qdot_record_next(r, part, first->node->text)) {
        qdot_operand o = {0};
        qdot_status status = qdot_operand_find(r, part, 0, &o);

        if (status == QDOT_OK)
            status = qdot_vec_push(list, o);
        if (status != QDOT_OK) {
            qdot_operand_clear(&o);
            return status;
        }
    }
    return QDOT_OK;
}

qdot_status
qdot_operands_find_runs(qdot_session *session, qdot_operands *list)
{
    for (size_t i = 0; i < list->n; i++) {
        qdot_named_run *latest;

        if (list->at[i].run != NULL)
            continue;
        QDOT_TRY(qdot_runs_read(session, NULL, &latest));
        QDOT_TRY(qdot_outdated_notice(session, NULL, list->at[i].from, list->at[i].to));
        list->at[i].run = latest->run;
    }
    return QDOT_OK;
}

qdot_status
qdot_operands_values(const qdot_operand *o, size_t rows, const double *times,
                     double *values, double *errors)
{
    size_t m = o->columns.n;

    if (o->mixed)
        return qdot_member_values(o->session, NULL, o->columns.at[0],
                                  &(qdot_samples){rows, times, NULL, values, errors});

    double *by_row = qdot_calloc(2 * rows * m, sizeof *by_row), *error = by_row + rows * m;
    qdot_status status;

    if (by_row == NULL)
        return QDOT_ENOMEM;
    status = qdot_run_values(o->run, m, o->columns.at, rows, times, by_row,
                             errors != NULL ? error : NULL);
    for (size_t k = 0; k < rows && status == QDOT_OK; k++)
        for (size_t i = 0; i < m; i++) {
            values[i * rows + k] = by_row[k * m + i];
            if (errors != NULL)
                errors[i * rows + k] = error[k * m + i];
        }
    qdot_free(by_row);
    return status;
}
