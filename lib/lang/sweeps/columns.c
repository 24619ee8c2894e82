/* columns.c -- the columns of a sweep's table: expressions that are evaluated for each run. */
#include "lang/sweeps/columns.h"

#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/language/token-text.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/momenta.h"
#include "lang/session/runs.h"
#include "lang/session/units.h"
#include "lang/session/values.h"

qdot_status
qdot_columns_find(const qdot_record *r, qdot_columns *x)
{
    for (size_t i = 0; i < r->parts.n; i++) {
        const qdot_filled *part = &r->parts.at[i];

        if (part->node->kind == QDOT_USAGE_HOLE && qdot_filled_is(part, "EXPR"))
            QDOT_TRY(qdot_vec_push(&x->at, &r->compiled.at[part->first]));
    }
    return QDOT_OK;
}

void
qdot_columns_free(qdot_columns *x)
{
    qdot_free(x->at.at);
    *x = (qdot_columns){0};
}

/* Column k of the table is of the dimension of e. */
static qdot_status
set_unit(qdot_session *session, qdot_row_table *table, size_t k, qdot_expr e)
{
    qdot_text unit = {0};
    qdot_status status;

    if (table == NULL || e == QDOT_NIL || !qdot_units_on(session))
        return QDOT_OK;
    qdot_units_label(session, e, &unit);
    status = qdot_text_status(&unit);
    if (status == QDOT_OK)
        status = qdot_row_table_set_unit(table, k, qdot_text_str(&unit));
    qdot_text_clear(&unit);
    return status;
}

qdot_status
qdot_columns_note_unit(qdot_session *session, const qdot_columns *x, size_t i, qdot_expr e)
{
    return set_unit(session, x->table, x->table != NULL ? x->table->n_swept + i : 0, e);
}

qdot_status
qdot_columns_read(qdot_cursor *c, const qdot_columns *x, size_t i, qdot_expr *e)
{
    QDOT_TRY(qdot_compiled_motion(c, x->at.at[i], e));
    c->error_at = x->at.at[i]->from->start;
    return qdot_expr_is_scalar(c->session->pool, *e) ? qdot_columns_note_unit(c->session, x, i, *e)
                                                     : qdot_fail(QDOT_ETYPE, "a column is one number a row");
}

/* Whether e contains a parameter that events set, or one whose value depends on such a parameter. */
static bool
is_set_by_events(const qdot_session *session, qdot_expr e)
{
    const qdot_pool *pool = session->pool;

    for (size_t i = 0; i < session->scene->events.n; i++)
        for (size_t k = 0; k < session->scene->events.at[i].targets.n; k++) {
            const qdot_expr target = session->scene->events.at[i].targets.at[k];
            bool is = qdot_expr_contains(pool, e, target);

            for (size_t j = 0; j < session->values->set_symbols.n && !is; j++)
                is = qdot_expr_contains(pool, e, session->values->set_symbols.at[j])
                     && qdot_expr_contains(pool, session->values->set_values.at[j], target);
            if (is)
                return true;
        }
    return false;
}

/* Evaluate one column of a sweep for a run: a number, or an expression at the end of the run. */
static qdot_status
evaluate_column(qdot_session *session, qdot_expr e, qdot_expr end, double *value, double *error)
{
    const uint32_t moving = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION
                            | QDOT_HAS_TIME | QDOT_HAS_MULTIPLIER;
    qdot_measured m;

    e = qdot_momenta_to_velocities(session, e);
    QDOT_TRY(qdot_pool_check(session->pool));
    if (!(qdot_expr_node(session->pool, e)->holds & moving) && !is_set_by_events(session, e))
        return qdot_session_number(session, e, value, error);
    QDOT_TRY(qdot_runs_measure_one(session, NULL, qdot_measured_as_rationals(session, e), end,
                                   &m));
    *value = m.value;
    *error = m.error;
    return QDOT_OK;
}

qdot_status
qdot_columns_measure(qdot_cursor *c, const qdot_columns *x, size_t i, qdot_expr end, double *value,
                     double *error)
{
    qdot_expr e;

    QDOT_TRY(qdot_columns_read(c, x, i, &e));
    return evaluate_column(c->session, e, end, value, error);
}

bool
qdot_columns_read_way(const qdot_session *session, const qdot_columns *x, size_t i)
{
    uint32_t k = 0;

    for (const char *name; (name = qdot_compiled_next_name(x->at.at[i], &k)) != NULL;)
        if (qdot_scene_find_event(session->scene, name) != NULL)
            return false;
    return qdot_compiled_reads_way(x->at.at[i]);
}

qdot_status
qdot_columns_table(qdot_session *session, qdot_columns *x, const char *name, size_t n,
                   const qdot_columns_before *before, qdot_row_table **table)
{
    const char **labels = qdot_calloc(n + x->at.n, sizeof *labels);
    qdot_text *texts = qdot_calloc(x->at.n, sizeof *texts);
    qdot_status status = labels && texts ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        labels[i] = before[i].label;
    for (size_t i = 0; i < x->at.n && status == QDOT_OK; i++) {
        qdot_token_text(session, x->at.at[i]->from, x->at.at[i]->to, &texts[i]);
        status = qdot_text_status(&texts[i]);
        labels[n + i] = qdot_text_str(&texts[i]);
    }
    if (status == QDOT_OK) {
        *table = qdot_row_table_new(name, n, n + x->at.n, labels);
        status = *table ? QDOT_OK : QDOT_ENOMEM;
        x->table = *table;
    }
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        status = set_unit(session, *table, i, before[i].of);
    for (size_t i = 0; texts && i < x->at.n; i++)
        qdot_text_clear(&texts[i]);
    qdot_free(texts);
    qdot_free(labels);
    return status;
}
