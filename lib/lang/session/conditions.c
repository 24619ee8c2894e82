/* conditions.c -- the conditions (scene, values, start, limits) under which a run is made, and the studies made under them. */
#include "lang/session/conditions.h"

#include <string.h>

enum { MOST_STUDIES = 8 };

/* Append the n items at `from` to a list unless `status` is a failure. */
#define APPEND(list, from, n)                                                            \
    for (size_t i = 0; i < (n) && status == QDOT_OK; i++)                                \
    status = qdot_vec_push(&(list), (from)[i])

qdot_status
qdot_conditions_take(const qdot_scene *scene, const qdot_run_request *request,
                     qdot_conditions *c)
{
    const size_t n = scene->coordinates.n;
    qdot_status status = QDOT_OK;

    c->version = scene->version;
    c->exactly = request->exactly;
    c->t0 = request->t0;
    c->t1 = request->t1;
    memcpy(c->said, request->said, sizeof c->said);
    APPEND(c->symbols, request->symbols, request->n_values);
    APPEND(c->values, request->values, request->n_values);
    APPEND(c->q0, request->q0, n);
    APPEND(c->v0, request->v0, n);
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        status = qdot_vec_push(&c->q_named, !request->q_named || request->q_named[i]);
        if (status == QDOT_OK)
            status = qdot_vec_push(&c->v_named, !request->v_named || request->v_named[i]);
    }
    return status;
}

void
qdot_conditions_clear(qdot_conditions *c)
{
    qdot_free(c->symbols.at);
    qdot_free(c->values.at);
    qdot_free(c->q0.at);
    qdot_free(c->v0.at);
    qdot_free(c->q_named.at);
    qdot_free(c->v_named.at);
    *c = (qdot_conditions){0};
}

qdot_run_request
qdot_conditions_request(const qdot_conditions *c)
{
    return (qdot_run_request){.n_values = c->symbols.n,
                              .symbols = c->symbols.at,
                              .values = c->values.at,
                              .q0 = c->q0.at,
                              .v0 = c->v0.at,
                              .q_named = c->q_named.at,
                              .v_named = c->v_named.at,
                              .exactly = c->exactly,
                              .t0 = c->t0,
                              .t1 = c->t1,
                              .said = {c->said[0], c->said[1]},
                              .tol = 1e-12,
                              .method = "auto"};
}

static bool
have_same_items(const void *a, size_t n, const void *b, size_t m, size_t size)
{
    return n == m && (n == 0 || memcmp(a, b, n * size) == 0);
}

#define SAME(list) have_same_items(a->list.at, a->list.n, b->list.at, b->list.n, sizeof *a->list.at)

bool
qdot_conditions_same(const qdot_conditions *a, const qdot_conditions *b)
{
    return a->version == b->version && a->exactly == b->exactly && a->t0 == b->t0 &&
           a->t1 == b->t1 && SAME(symbols) && SAME(values) && SAME(q0) && SAME(v0) &&
           SAME(q_named) && SAME(v_named);
}

/* --- work-precision studies kept for reports ---------------------------------------- */

const qdot_workprecision *
qdot_studies_find(const qdot_kept_studies *studies, const qdot_conditions *conditions)
{
    for (size_t i = studies->n; i-- > 0;)
        if (qdot_conditions_same(&studies->at[i].conditions, conditions))
            return &studies->at[i].measured;
    return NULL;
}

static void
clear_study(qdot_kept_study *study)
{
    qdot_conditions_clear(&study->conditions);
    qdot_workprecision_clear(&study->measured);
}

qdot_status
qdot_studies_keep(qdot_kept_studies *studies, qdot_conditions *conditions,
                  qdot_workprecision *measured)
{
    qdot_kept_study study = {*conditions, *measured};
    qdot_status status;

    *conditions = (qdot_conditions){0};
    *measured = (qdot_workprecision){0};
    if (studies->n == MOST_STUDIES) {
        clear_study(&studies->at[0]);
        memmove(studies->at, studies->at + 1, --studies->n * sizeof *studies->at);
    }
    status = qdot_vec_push(studies, study);
    if (status != QDOT_OK)
        clear_study(&study);
    return status;
}

void
qdot_studies_clear(qdot_kept_studies *studies)
{
    for (size_t i = 0; i < studies->n; i++)
        clear_study(&studies->at[i]);
    qdot_free(studies->at);
    *studies = (qdot_kept_studies){0};
}
