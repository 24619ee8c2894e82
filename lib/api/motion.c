/* motion.c -- makes runs, and answers questions about a run as a whole. */
#include "api/motion.h"

#include <stdint.h>
#include <string.h>

#include "expr/symbol.h"
#include "lang/session/runs.h"
#include "lang/syntax/match.h"
#include "lang/syntax/statement.h"

/* --- begin and end -------------------------------------------------------------------- */

size_t
qdot_api_place(const qdot_motion *motion)
{
    const qdot_session *session = motion->system->session;
    size_t i = 0;

    while (i < session->runs->n && session->runs->at[i].run != motion->run.run)
        i++;
    return i;
}

void
qdot_motion_free(qdot_motion *motion)
{
    if (motion == NULL)
        return;
    if (!motion->named) {
        const size_t i = qdot_api_place(motion);

        if (i < motion->system->session->runs->n) {
            qdot_api_delete_undo_records(motion->system->session); /* as after qdot_system_run */
            qdot_runs_drop(motion->system->session, i);
        }
    }
    qdot_named_run_release(&motion->run);
    qdot_api_release(motion->system);
    qdot_arena_free(motion->arena);
    qdot_free(motion);
}

/* Copy the names of the coordinates into the motion: the pool that holds them may be freed before the motion is. */
static qdot_status
copy_names(qdot_motion *m)
{
    const qdot_run_report *r = qdot_run_get_report(m->run.run);

    m->arena = qdot_arena_new();
    if (m->arena == NULL)
        return QDOT_ENOMEM;
    m->coordinates = qdot_arena_take(m->arena, r->n * sizeof *m->coordinates);
    if (m->coordinates == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < r->n; i++) {
        const char *name = qdot_expr_symbol(m->system->session->pool, r->coordinates[i])->name;

        m->coordinates[i] = qdot_arena_strndup(m->arena, name, strlen(name));
        if (m->coordinates[i] == NULL)
            return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

/* Store a run of the session in the motion m, which then keeps the run alive. */
static qdot_status
motion_store_run(qdot_motion *m, qdot_system *system, const qdot_named_run *run, bool named)
{
    *m = (qdot_motion){.system = system, .run = *run, .named = named};
    ++*m->run.uses;
    system->uses++;
    return copy_names(m);
}

static qdot_status
read_run_statement(qdot_cursor *c, void *data)
{
    (void)data;
    return qdot_match_carry_out(c, qdot_statement_find("run"));
}

/* The run that the call added, behind those of before; NULL: it added none. `last`: the latest of
 * before, held so that no new run can have its place in memory. */
static const qdot_named_run *
find_added_run(const qdot_session *session, const qdot_named_run *last)
{
    const qdot_named_run *now =
        session->runs->n > 0 ? &session->runs->at[session->runs->n - 1] : NULL;

    return now != NULL && now->run != last->run ? now : NULL;
}

qdot_result
qdot_system_run(qdot_system *system, const char *text, qdot_motion **motion)
{
    const qdot_named_run *added = NULL;
    qdot_named_run last = {0};
    qdot_session *session;
    qdot_motion *m;
    qdot_status status;
    char name[32];

    if (motion != NULL)
        *motion = NULL;
    if (system == NULL)
        return QDOT_RESULT_INVALID;
    if (text == NULL || motion == NULL)
        return qdot_api_refuse(system, "run: the %s is NULL", text == NULL ? "text" : "motion");
    session = system->session;
    status = qdot_api_begin(system);
    m = status == QDOT_OK ? qdot_calloc(1, sizeof *m) : NULL;
    if (m == NULL)
        return qdot_api_end(system, QDOT_ENOMEM);
    if (session->runs->n > 0) {
        last = session->runs->at[session->runs->n - 1];
        ++*last.uses;
    }
    qdot_runs_next_name(session, name, sizeof name);
    status = qdot_api_read(system, "run", text, read_run_statement, NULL);
    added = find_added_run(session, &last);
    if (added == NULL) {
        qdot_free(m);
    } else if (motion_store_run(m, system, added, strcmp(added->name, name) != 0) == QDOT_OK) {
        *motion = m;
    } else {
        qdot_motion_free(m);
        status = QDOT_ENOMEM;
    }
    if (last.run != NULL)
        qdot_named_run_release(&last);
    qdot_api_delete_undo_records(session); /* they know the runs as they were before */
    return qdot_api_end(system, status);
}

/* Read the name of a run, "a", "f[2]", and find it. */
static qdot_status
read_run_name(qdot_cursor *c, void *data)
{
    const qdot_named_run **run = data;
    qdot_named_run *found;
    const char *name;

    QDOT_TRY(qdot_api_read_name(c, &name));
    QDOT_TRY(qdot_runs_find(c->session, name, &found));
    *run = found;
    return QDOT_OK;
}

/* The run of this name, of NULL the latest; NULL, with a failure, if there is none. */
static const qdot_named_run *
find_run(qdot_system *system, const char *name)
{
    const qdot_run_list *runs = system->session->runs;
    const qdot_named_run *found = NULL;

    if (runs->n == 0) {
        (void)qdot_fail(QDOT_ENAME, "motion: there is no run yet");
        return NULL;
    }
    if (name == NULL)
        return &runs->at[runs->n - 1];
    return qdot_api_read(system, "motion", name, read_run_name, &found) == QDOT_OK ? found : NULL;
}

qdot_result
qdot_system_motion(qdot_system *system, const char *name, qdot_motion **motion)
{
    const qdot_named_run *run;
    qdot_motion *m = NULL;
    qdot_status status;

    if (motion != NULL)
        *motion = NULL;
    if (system == NULL)
        return QDOT_RESULT_INVALID;
    if (motion == NULL)
        return qdot_api_refuse(system, "motion: the motion is NULL");
    status = qdot_api_begin(system);
    run = status == QDOT_OK ? find_run(system, name) : NULL;
    if (run != NULL)
        m = qdot_calloc(1, sizeof *m);
    if (m != NULL && motion_store_run(m, system, run, true) == QDOT_OK) {
        *motion = m;
        return qdot_api_end(system, QDOT_OK);
    }
    qdot_motion_free(m);
    if (run != NULL)
        (void)qdot_fail(QDOT_ENOMEM, "motion: out of memory");
    return qdot_api_end(system, qdot_last_error()->status);
}

/* --- a run as a whole ----------------------------------------------------------------- */

const qdot_system *
qdot_motion_system(const qdot_motion *motion)
{
    return motion != NULL ? motion->system : NULL;
}

static const qdot_run_report *
get_run_report(const qdot_motion *motion)
{
    return qdot_run_get_report(motion->run.run);
}

qdot_result
qdot_motion_summarize(const qdot_motion *motion, qdot_motion_summary *summary, size_t size)
{
    const qdot_run_report *r;
    qdot_motion_summary all;

    if (motion == NULL)
        return QDOT_RESULT_INVALID;
    if (summary == NULL || size == 0)
        return qdot_api_refuse(motion->system, "summarize: there is no summary");
    r = get_run_report(motion);
    all = (qdot_motion_summary){
        .start = r->t0,
        .end = r->t1,
        .tolerance = r->tol,
        .error = r->error,
        .horizon = r->horizon,
        .energy_drift = r->energy_drift,
        .constraint_drift = r->constraint_drift,
        .cpu = r->cpu,
        .steps = (size_t)r->steps,
        .rejected = (size_t)r->rejected,
        .evaluations = r->evals < SIZE_MAX ? (size_t)r->evals : SIZE_MAX,
        .method = r->method,
        .reason = r->reason,
        .doubt = r->doubt,
    };
    memcpy(summary, &all, size < sizeof all ? size : sizeof all);
    return qdot_api_accept(motion->system);
}

size_t
qdot_motion_coordinates(const qdot_motion *motion)
{
    return motion != NULL ? get_run_report(motion)->n : 0;
}

const char *
qdot_motion_coordinate(const qdot_motion *motion, size_t i)
{
    return i < qdot_motion_coordinates(motion) ? motion->coordinates[i] : NULL;
}

qdot_result
qdot_motion_end(const qdot_motion *motion, size_t n, double *q, double *v)
{
    const qdot_run_report *r;

    if (motion == NULL)
        return QDOT_RESULT_INVALID;
    r = get_run_report(motion);
    if (n != r->n)
        return qdot_api_refuse(motion->system, "end: there are %zu coordinates, not %zu", r->n, n);
    if (q != NULL)
        memcpy(q, r->q, n * sizeof *q);
    if (v != NULL)
        memcpy(v, r->v, n * sizeof *v);
    return qdot_api_accept(motion->system);
}

const double *
qdot_motion_steps(const qdot_motion *motion, size_t *n)
{
    size_t none;

    if (motion == NULL) {
        if (n != NULL)
            *n = 0;
        return NULL;
    }
    return qdot_run_times(motion->run.run, n != NULL ? n : &none);
}

size_t
qdot_motion_conserved(const qdot_motion *motion)
{
    return motion != NULL ? get_run_report(motion)->n_drifts : 0;
}

qdot_result
qdot_motion_drift(const qdot_motion *motion, size_t i, const char **name, double *start,
                  double *drift)
{
    const qdot_drift *d;

    if (motion == NULL)
        return QDOT_RESULT_INVALID;
    if (i >= get_run_report(motion)->n_drifts)
        return qdot_api_refuse(motion->system, "drift: there is no conserved quantity %zu", i);
    d = &get_run_report(motion)->drifts[i];
    if (name != NULL)
        *name = d->name;
    if (start != NULL)
        *start = d->start;
    if (drift != NULL)
        *drift = d->drift;
    return qdot_api_accept(motion->system);
}
