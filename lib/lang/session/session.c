/* session.c -- creates and frees a session; stores the values it is given. */
#include "lang/session/session.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "show/formula-page.h"

qdot_session *
qdot_session_new(FILE *out, FILE *err)
{
    qdot_session *s = qdot_calloc(1, sizeof *s);

    if (s == NULL)
        return NULL;
    s->out = out;
    s->err = err;
    s->pool = qdot_pool_new();
    s->names = qdot_names_new();
    if (s->pool != NULL)
        s->scene = qdot_scene_new(s->pool);
    if (s->pool == NULL || s->names == NULL || s->scene == NULL) {
        qdot_session_free(s);
        return NULL;
    }
    return s;
}

void
qdot_named_run_release(qdot_named_run *run)
{
    if (--*run->uses > 0)
        return;
    qdot_free(run->name);
    qdot_free(run->text);
    qdot_run_free(run->run);
    if (run->conditions != NULL)
        qdot_conditions_clear(run->conditions);
    qdot_free(run->conditions);
    qdot_free(run->uses);
}

void
qdot_session_free(qdot_session *session)
{
    if (session == NULL)
        return;
    if (session->undo != NULL)
        session->undo_free(session->undo);
    for (size_t i = 0; i < session->runs.n; i++)
        qdot_named_run_release(&session->runs.at[i]);
    qdot_free(session->runs.at);
    for (size_t i = 0; i < session->tables.n; i++)
        qdot_row_table_release(session->tables.at[i]);
    qdot_free(session->tables.at);
    qdot_studies_clear(&session->studies);
    qdot_free(session->partial_sums.at);
    qdot_free(session->history.at);
    qdot_free(session->history_over.at);
    qdot_free(session->measured.at);
    for (size_t i = 0; i < session->members.n; i++)
        qdot_free(session->members.at[i].run);
    qdot_free(session->members.at);
    qdot_free(session->set_symbols.at);
    qdot_free(session->set_values.at);
    qdot_free(session->start_symbols.at);
    qdot_free(session->start_open.at);
    qdot_free(session->start_values.at);
    qdot_free(session->start_errors.at);
    qdot_free(session->held.at);
    qdot_free(session->scale_symbols.at);
    qdot_free(session->scale_values.at);
    for (size_t i = 0; i < session->told.n; i++)
        qdot_free(session->told.at[i]);
    qdot_free(session->told.at);
    for (size_t i = 0; i < session->remarks.n; i++)
        qdot_free(session->remarks.at[i]);
    qdot_free(session->remarks.at);
    for (size_t i = 0; i < session->including.n; i++)
        qdot_free(session->including.at[i]);
    qdot_free(session->including.at);
    qdot_text_clear(&session->typed.all);
    if (session->block != NULL)
        qdot_formula_page_clear(session->block);
    qdot_free(session->block);
    if (session->scene != NULL)
        qdot_scene_free(session->scene);
    if (session->names != NULL)
        qdot_names_free(session->names);
    if (session->pool != NULL)
        qdot_pool_free(session->pool);
    qdot_free(session);
}

void
qdot_session_exchange(qdot_session *session, qdot_session *other)
{
    const qdot_session swap = *session;

    *session = *other;
    *other = swap;
#define STAYS(field)                                                                     \
    other->field = session->field;                                                       \
    session->field = swap.field;
    STAYS(out)
    STAYS(err)
    STAYS(style)
    STAYS(flat)
    STAYS(page)
    STAYS(block)
    STAYS(json)
    STAYS(timing)
    STAYS(interactive)
    STAYS(console)
    STAYS(console_json)
    STAYS(pages)
    STAYS(screen)
    STAYS(colours)
    STAYS(failed)
    STAYS(refuted)
    STAYS(quit)
    STAYS(typed)
    STAYS(undo)
    STAYS(undo_free)
#undef STAYS
    memcpy(session->verdicts, swap.verdicts, sizeof swap.verdicts);
    memcpy(&other->including, &session->including, sizeof session->including);
    memcpy(&session->including, &swap.including, sizeof session->including);
}

qdot_status
qdot_session_remember(qdot_session *session, qdot_expr value, qdot_expr over)
{
    QDOT_TRY(qdot_vec_push(&session->history, value));
    while (session->history_over.n < session->history.n)
        QDOT_TRY(qdot_vec_push(&session->history_over, QDOT_NIL));
    session->history_over.at[session->history.n - 1] = over;
    return QDOT_OK;
}

void
qdot_session_set(qdot_session *session, qdot_expr symbol, qdot_expr value,
                 qdot_status *status)
{
    for (size_t i = 0; i < session->set_symbols.n; i++)
        if (session->set_symbols.at[i] == symbol ||
            (qdot_expr_kind(session->pool, symbol) == QDOT_UFUN &&
             qdot_expr_kind(session->pool, session->set_symbols.at[i]) == QDOT_UFUN &&
             qdot_expr_node(session->pool, symbol)->op ==
                 qdot_expr_node(session->pool, session->set_symbols.at[i])->op)) {
            session->set_symbols.at[i] = symbol;
            session->set_values.at[i] = value;
            return;
        }
    if (*status == QDOT_OK)
        *status = qdot_vec_push(&session->set_symbols, symbol);
    if (*status == QDOT_OK) {
        *status = qdot_vec_push(&session->set_values, value);
        if (*status != QDOT_OK)
            session->set_symbols.n--;
    }
}

qdot_status
qdot_session_start(qdot_session *session, qdot_expr jet, qdot_expr value)
{
    for (size_t i = 0; i < session->start_symbols.n; i++)
        if (session->start_symbols.at[i] == jet) {
            session->start_values.at[i] = value;
            return QDOT_OK;
        }
    QDOT_TRY(qdot_vec_push(&session->start_symbols, jet));
    if (qdot_vec_push(&session->start_values, value) != QDOT_OK) {
        session->start_symbols.n--;
        return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

qdot_status
qdot_session_put(qdot_session *session, qdot_expr symbol, qdot_expr value)
{
    qdot_status status = QDOT_OK;

    if (qdot_expr_is_class(session->pool, symbol, QDOT_COORD))
        return qdot_session_start(session, symbol, value);
    qdot_session_set(session, symbol, value, &status);
    return status;
}

#define EACH_LIST(X) X(set_symbols) X(set_values) X(start_symbols) X(start_values)

qdot_status
qdot_session_keep_values(const qdot_session *session, qdot_kept_values *kept)
{
    qdot_status status = QDOT_OK;

    *kept = (qdot_kept_values){0};
#define X(list)                                                                          \
    for (size_t i = 0; i < session->list.n && status == QDOT_OK; i++)                    \
        status = qdot_vec_push(&kept->list, session->list.at[i]);
    EACH_LIST(X)
#undef X
#define X(list) qdot_free(kept->list.at);
    if (status != QDOT_OK) {
        EACH_LIST(X)
    }
#undef X
    return status;
}

void
qdot_session_restore_values(qdot_session *session, qdot_kept_values *kept)
{
#define X(list)                                                                          \
    qdot_free(session->list.at);                                                         \
    memcpy(&session->list, &kept->list, sizeof kept->list);
    EACH_LIST(X)
#undef X
}

void
qdot_session_path(const qdot_session *session, const char *name, qdot_text *path)
{
    const char *own =
        session->including.n > 0 ? session->including.at[session->including.n - 1] : "";
    const char *slash = strrchr(own, '/');

    if (name[0] != '/' && slash != NULL)
        qdot_text_add_n(path, own, (size_t)(slash + 1 - own));
    qdot_text_add(path, name);
}
