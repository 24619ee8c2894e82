/* session.c -- creates and frees a session. */
#include "lang/session/session.h"

#include <string.h>

#include "lang/session/conditions.h"
#include "lang/session/evaluation.h"
#include "lang/session/history.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/names.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/session/row-tables.h"
#include "lang/session/runs.h"
#include "lang/session/text-list.h"
#include "lang/session/typed.h"
#include "lang/session/units.h"
#include "lang/session/values.h"
#include "mech/scene/scene.h"
#include "show/formula-page.h"

/* The parts that are not begun and freed by functions of their own, by whether `reset` forgets
 * them. */
#define FORGOTTEN(X)                                                                     \
    X(qdot_values, values)                                                               \
    X(qdot_history, history)                                                             \
    X(qdot_run_list, runs)                                                               \
    X(qdot_row_table_list, tables)                                                       \
    X(qdot_kept_studies, studies)                                                        \
    X(qdot_measured_list, measured)                                                      \
    X(qdot_member_list, members)                                                         \
    X(qdot_units, units)                                                                 \
    X(qdot_evaluation, evaluation)                                                       \
    X(qdot_text_list, told)                                                              \
    X(qdot_text_list, remarks)
#define KEPT(X)                                                                          \
    X(qdot_output, output)                                                               \
    X(qdot_outcome, outcome)                                                             \
    X(qdot_typed, typed)                                                                 \
    X(qdot_text_list, including)

/* A session and its parts in one block. */
typedef struct {
    qdot_session session;
#define X(type, part) type part;
    FORGOTTEN(X)
    KEPT(X)
#undef X
} session_block;

qdot_session *
qdot_session_new(FILE *out, FILE *err)
{
    session_block *block = qdot_calloc(1, sizeof *block);
    qdot_session *s;

    if (block == NULL)
        return NULL;
    s = &block->session;
#define X(type, part) s->part = &block->part;
    FORGOTTEN(X)
    KEPT(X)
#undef X
    s->output->out = out;
    s->output->err = err;
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

static void
free_values(qdot_values *values)
{
    qdot_free(values->set_symbols.at);
    qdot_free(values->set_values.at);
    qdot_free(values->start_symbols.at);
    qdot_free(values->start_values.at);
    qdot_free(values->start_open.at);
    qdot_free(values->start_errors.at);
    qdot_free(values->scale_symbols.at);
    qdot_free(values->scale_values.at);
}

void
qdot_session_free(qdot_session *session)
{
    if (session == NULL)
        return;
    if (session->undo != NULL)
        session->undo_free(session->undo);
    for (size_t i = 0; i < session->runs->n; i++)
        qdot_named_run_release(&session->runs->at[i]);
    qdot_free(session->runs->at);
    for (size_t i = 0; i < session->tables->n; i++)
        qdot_row_table_release(session->tables->at[i]);
    qdot_free(session->tables->at);
    qdot_studies_clear(session->studies);
    free_values(session->values);
    qdot_units_clear(session->units);
    qdot_free(session->history->values.at);
    qdot_free(session->history->over.at);
    qdot_free(session->measured->at);
    for (size_t i = 0; i < session->members->n; i++)
        qdot_free(session->members->at[i].run);
    qdot_free(session->members->at);
    qdot_free(session->evaluation->held.at);
    qdot_free(session->evaluation->partial_sums.at);
    qdot_phase_space_clear(&session->evaluation->phase_space);
    qdot_text_list_clear(session->told);
    qdot_text_list_clear(&session->evaluation->told);
    qdot_text_list_clear(session->remarks);
    qdot_text_list_clear(session->including);
    qdot_text_clear(&session->typed->all);
    if (session->output->block != NULL)
        qdot_formula_page_clear(session->output->block);
    qdot_free(session->output->block);
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
#define EXCHANGE(type, a, b)                                                             \
    do {                                                                                 \
        type swap = a;                                                             \
        a = b;                                                                           \
        b = swap;                                                                        \
    } while (0);
    EXCHANGE(qdot_pool *, session->pool, other->pool)
    EXCHANGE(struct qdot_scene *, session->scene, other->scene)
    EXCHANGE(struct qdot_names *, session->names, other->names)
#define X(type, part) EXCHANGE(type, *session->part, *other->part)
    FORGOTTEN(X)
#undef X
#undef EXCHANGE
    /* solvers of dimensions ask the session that made them: each makes a new one when it needs it */
    qdot_units_back_to(session, session->units->facts.n);
    qdot_units_back_to(other, other->units->facts.n);
}

void
qdot_session_path(const qdot_session *session, const char *name, qdot_text *path)
{
    const qdot_text_list *including = session->including;
    const char *own = including->n > 0 ? including->at[including->n - 1] : "";
    const char *slash = strrchr(own, '/');

    if (name[0] != '/' && slash != NULL)
        qdot_text_add_n(path, own, (size_t)(slash + 1 - own));
    qdot_text_add(path, name);
}

qdot_status
qdot_session_read_csv(const qdot_session *session, const char *name, qdot_csv *csv)
{
    qdot_text path = {0};
    qdot_status status;

    qdot_session_path(session, name, &path);
    status = qdot_text_status(&path);
    if (status == QDOT_OK)
        status = qdot_csv_read(qdot_text_str(&path), csv);
    qdot_text_clear(&path);
    return status;
}
