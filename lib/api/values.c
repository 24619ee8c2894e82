/* values.c -- calls that return numbers along a run: values, extrema, means, times of events. */
#include "api/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "lang/language/outdated.h"
#include "lang/language/read.h"
#include "lang/session/member.h"
#include "lang/session/runs.h"

_Static_assert((int)QDOT_OVER_MAX == (int)QDOT_RANGE_MAX, "range");
_Static_assert((int)QDOT_OVER_MIN == (int)QDOT_RANGE_MIN, "range");
_Static_assert((int)QDOT_OVER_MEAN == (int)QDOT_RANGE_MEAN, "range");
_Static_assert((int)QDOT_OVER_DRIFT == (int)QDOT_RANGE_DRIFT, "range");

/* Fail unless the session still has this run: expressions of the run can only be read in its session. */
static qdot_status
check_session_has_run(const qdot_motion *motion)
{
    if (qdot_api_place(motion) < motion->system->session->runs->n)
        return QDOT_OK;
    return qdot_fail(QDOT_ENAME, "the run `%s` is no longer in the system", motion->run.name);
}

/* Read the expression in the text into columns of values, one column for each of its k components. */
static qdot_status
read_value_columns(qdot_cursor *c, const char *run, size_t k, qdot_runs_columns *columns)
{
    const qdot_token *from = c->at;
    const size_t start = from->start;
    qdot_expr value;

    QDOT_TRY(qdot_read_value(c, &value));
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start;
    QDOT_TRY(qdot_outdated_notice(c->session, run, from, c->at));
    QDOT_TRY(qdot_runs_flatten(c->session, value, columns));
    for (size_t i = 0; i < columns->n; i++)
        if (qdot_member_any(c->session, columns->at[i]))
            return qdot_fail(QDOT_EINVAL, "an expression along this run names no run");
    if (columns->n != k)
        return qdot_fail(QDOT_ETYPE, "the expression has %zu components, not %zu", columns->n, k);
    return QDOT_OK;
}

/* --- values at given times ------------------------------------------------------------ */

typedef struct {
    qdot_motion *motion;
    size_t n, k;
    const double *times;
    double *values, *errors;
} samples;

/* Whether times nowhere turn back, so that each interval of the integration is read once. NaN: whatever is
 * done with them will be refused. */
static bool
are_in_order(size_t n, const double *times)
{
    bool rising = true, falling = true;

    for (size_t i = 1; i < n; i++) {
        rising = rising && !(times[i] < times[i - 1]);
        falling = falling && !(times[i] > times[i - 1]);
        if (isnan(times[i]))
            return true;
    }
    return rising || falling || isnan(times[0]);
}

/* A time, and its index among those of the caller. */
typedef struct {
    double t;
    size_t i;
} timed;

static int
compare_times(const void *a, const void *b)
{
    const timed *x = a, *y = b;

    return x->t != y->t ? (x->t > y->t) - (x->t < y->t) : (x->i > y->i) - (x->i < y->i);
}

/* Evaluate the columns in the order of time, with memory from the arena. */
static qdot_status
evaluate_sorted(const samples *s, const qdot_expr *columns, qdot_arena *arena)
{
    const size_t cells = s->n * s->k;
    timed *order = qdot_arena_take(arena, s->n * sizeof *order);
    double *times = qdot_arena_take(arena, s->n * sizeof *times);
    double *values = qdot_arena_take(arena, cells * sizeof *values);
    double *errors = s->errors != NULL ? qdot_arena_take(arena, cells * sizeof *errors) : NULL;

    if (order == NULL || times == NULL || values == NULL || (s->errors != NULL && errors == NULL))
        return QDOT_ENOMEM;
    for (size_t i = 0; i < s->n; i++)
        order[i] = (timed){s->times[i], i};
    qsort(order, s->n, sizeof *order, compare_times);
    for (size_t i = 0; i < s->n; i++)
        times[i] = order[i].t;
    QDOT_TRY(qdot_run_values(s->motion->run.run, s->k, columns, s->n, times, values, errors));
    for (size_t i = 0; i < s->n; i++) {
        memcpy(s->values + order[i].i * s->k, values + i * s->k, s->k * sizeof *values);
        if (errors != NULL)
            memcpy(s->errors + order[i].i * s->k, errors + i * s->k, s->k * sizeof *errors);
    }
    return QDOT_OK;
}

static qdot_status
evaluate(const samples *s, const qdot_expr *columns)
{
    qdot_arena *arena;
    qdot_status status;

    if (are_in_order(s->n, s->times))
        return qdot_run_values(s->motion->run.run, s->k, columns, s->n, s->times, s->values, s->errors);
    arena = qdot_arena_new();
    status = arena != NULL ? evaluate_sorted(s, columns, arena) : QDOT_ENOMEM;
    qdot_arena_free(arena);
    return status == QDOT_ENOMEM ? qdot_fail(QDOT_ENOMEM, "out of memory") : status;
}

static qdot_status
read_and_evaluate(qdot_cursor *c, void *data)
{
    const samples *s = data;
    qdot_runs_columns columns = {0};
    qdot_status status = read_value_columns(c, s->motion->run.name, s->k, &columns);

    if (status == QDOT_OK && s->n > 0)
        status = evaluate(s, columns.at);
    qdot_free(columns.at);
    return status;
}

qdot_result
qdot_motion_values(qdot_motion *motion, const char *expression, size_t n, const double *times,
                   size_t k, double *values, double *errors)
{
    samples s = {motion, n, k, times, values, errors};
    qdot_status status;

    if (motion == NULL)
        return QDOT_RESULT_INVALID;
    if (expression == NULL || (n > 0 && (times == NULL || values == NULL)))
        return qdot_api_refuse(motion->system, "values: the %s NULL",
                               expression == NULL ? "expression is"
                               : times == NULL    ? "times are"
                                                  : "values are");
    status = qdot_api_begin(motion->system);
    if (status == QDOT_OK)
        status = check_session_has_run(motion);
    if (status == QDOT_OK)
        status = qdot_api_read(motion->system, "values", expression, read_and_evaluate, &s);
    return qdot_api_end(motion->system, status);
}

/* --- over a range --------------------------------------------------------------------- */

typedef struct {
    qdot_motion *motion;
    qdot_range_kind kind;
    double from, to, value, error;
} stretch;

static qdot_status
read_range_expression(qdot_cursor *c, void *data)
{
    stretch *s = data;
    qdot_runs_columns columns = {0};
    qdot_status status = read_value_columns(c, s->motion->run.name, 1, &columns);

    if (status == QDOT_OK)
        status = qdot_run_range(s->motion->run.run, s->kind, columns.at[0], s->from, s->to,
                                &s->value, &s->error);
    qdot_free(columns.at);
    return status;
}

qdot_result
qdot_motion_over(qdot_motion *motion, qdot_over what, const char *expression, double from,
                 double to, double *value, double *error)
{
    stretch s = {.motion = motion, .kind = (qdot_range_kind)what, .from = from, .to = to};
    qdot_status status;

    if (motion == NULL)
        return QDOT_RESULT_INVALID;
    if (expression == NULL || value == NULL || (unsigned)what > QDOT_OVER_DRIFT)
        return qdot_api_refuse(motion->system, "over: %s",
                               expression == NULL ? "the expression is NULL"
                               : value == NULL    ? "the value is NULL"
                                                  : "there is no such quantity");
    status = qdot_api_begin(motion->system);
    if (status == QDOT_OK)
        status = check_session_has_run(motion);
    if (status == QDOT_OK)
        status = qdot_api_read(motion->system, "over", expression, read_range_expression, &s);
    *value = s.value;
    if (error != NULL)
        *error = s.error;
    return qdot_api_end(motion->system, status);
}

/* --- times of events ------------------------------------------------------------------ */

/* Begin a call that returns the occurrences of an event in the run; *n is their number. */
static const qdot_run_occurrence *
begin_occurrences_call(qdot_motion *motion, size_t *n, qdot_status *status)
{
    const qdot_run_occurrence *list = NULL;

    *n = 0;
    *status = qdot_api_begin(motion->system);
    if (*status == QDOT_OK)
        *status = check_session_has_run(motion);
    if (*status == QDOT_OK)
        *status = qdot_run_occurrences(motion->run.run, &list, n);
    return list;
}

qdot_result
qdot_motion_events(qdot_motion *motion, size_t *n)
{
    qdot_status status;

    if (motion == NULL)
        return QDOT_RESULT_INVALID;
    if (n == NULL)
        return qdot_api_refuse(motion->system, "events: the number is NULL");
    (void)begin_occurrences_call(motion, n, &status);
    return qdot_api_end(motion->system, status);
}

qdot_result
qdot_motion_event(qdot_motion *motion, size_t i, const char **name, double *t, double *error,
                  int *way)
{
    const qdot_run_occurrence *list;
    qdot_status status;
    size_t n;

    if (motion == NULL)
        return QDOT_RESULT_INVALID;
    list = begin_occurrences_call(motion, &n, &status);
    if (status == QDOT_OK && i >= n)
        status = qdot_fail(QDOT_EINVAL, "event: there is no event %zu", i);
    if (status == QDOT_OK && name != NULL)
        *name = list[i].event;
    if (status == QDOT_OK && t != NULL)
        *t = list[i].t;
    if (status == QDOT_OK && error != NULL)
        *error = list[i].error;
    if (status == QDOT_OK && way != NULL)
        *way = list[i].way;
    return qdot_api_end(motion->system, status);
}
