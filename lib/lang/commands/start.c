/* start.c -- the statement `start`: gives the initial state. */
#include <math.h>

#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/commands/pairs.h"
#include "lang/commands/set.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/phase.h"
#include "lang/session/runs.h"
#include "lang/session/speeds.h"
#include "lang/session/start-kind.h"
#include "lang/session/unmade.h"
#include "lang/session/values.h"
#include "mech/scene/scene.h"

static qdot_status carry_out_start(qdot_record *r);

QDOT_STATEMENT(start) = {
    .word = "start",
    .group = QDOT_NUMBERS,
    .usage = "start Q = VALUE, Q' = VALUE, ... [exactly] | start RUN [exactly]",
    .summary = "the initial state, with velocities, momenta p[Q] or speeds; changes only what it names; what constraints "
               "determine of the rest is solved for, unless `exactly`",
    .example = "start theta = 2, theta' = 0",
    .handler = carry_out_start,
};

/* Give a notice if the run that is continued has events that set parameters: the next run has the old values. */
static qdot_status
give_notice_of_parameters(qdot_session *session, const char *name, const qdot_run_report *report)
{
    for (size_t i = report->n - report->n_states; i < report->n; i++) {
        const char *parameter =
            qdot_expr_symbol(session->pool, report->coordinates[i])->name;
        const qdot_name *known = qdot_names_find(session->names, parameter);
        double value;

        if (known == NULL || known->kind != QDOT_NAME_PARAM ||
            qdot_session_number(session, qdot_session_bind(session, known->value), &value,
                                NULL) != QDOT_OK ||
            fabs(value - report->q[i]) <= 1e-9 * fmax(1, fabs(value)))
            continue;
        QDOT_TRY(qdot_answer_notice(session,
                                    "%.100s ended with %.100s = %.12g, which an event set for "
                                    "that run; the next begins with %.12g again: set %.100s = "
                                    "... changes that",
                                    name, parameter, report->q[i], value, parameter));
    }
    return QDOT_OK;
}

/* Store the difference between the end of a run and of its companion runs, as the error of runs that start there. */
static qdot_status
store_start_errors(qdot_session *session, const qdot_named_run *named)
{
    const qdot_run_report *report = qdot_run_get_report(named->run);
    double *apart = qdot_calloc(4 * report->n + 1, sizeof *apart);
    bool known;
    qdot_status status = apart != NULL ? qdot_run_end_apart(named->run, apart, &known) : QDOT_ENOMEM;

    session->values->start_errors.n = 0;
    if (status == QDOT_OK && !known)
        status = qdot_answer_notice(session, "the start is taken as exact: errors of runs from it do not include "
                                    "that of %.100s",
                                    named->name);
    for (size_t i = 0; status == QDOT_OK && known && i < 2 * report->n; i++) {
        const bool velocity = i >= report->n;
        const qdot_expr z = qdot_symbol_jet(session->pool, report->coordinates[i % report->n], velocity);
        const qdot_expr value = qdot_session_value_started(session, z);

        if (value != QDOT_NIL)
            status = qdot_vec_push(&session->values->start_errors,
                                   ((qdot_start_error){z, value, {apart[i], apart[2 * report->n + i]}}));
    }
    qdot_free(apart);
    return status == QDOT_OK ? qdot_pool_check(session->pool) : status;
}

static qdot_status
start_at_end_of_run(qdot_record *r, const char *name)
{
    qdot_session *session = r->cursor.session;
    const qdot_run_report *report;
    qdot_named_run *run;

    r->cursor.error_at = r->start->start;
    QDOT_TRY(qdot_runs_find(session, name, &run));
    QDOT_TRY(qdot_session_refuse_unmade(session, "start RUN")); /* what the run was before its end would be forgotten */
    report = qdot_run_get_report(run->run);
    qdot_session_start_forget_speeds(session);
    for (size_t i = 0; i < report->n - report->n_states; i++) {
        qdot_expr q = report->coordinates[i], v = qdot_symbol_jet(session->pool, q, 1);
        qdot_expr q0, v0;

        if (report->exact != NULL) {
            q0 = report->exact[i];
            v0 = report->exact[report->n + i];
        } else {
            q0 = qdot_measured_rational(session->pool, report->q[i]);
            v0 = qdot_measured_rational(session->pool, report->v[i]);
        }
        QDOT_TRY(qdot_pool_check(session->pool));
        QDOT_TRY(qdot_session_start(session, q, q0));
        if (!qdot_phase_has(session))
            QDOT_TRY(qdot_session_start(session, v, v0));
    }
    session->values->start_exactly = qdot_record_word(r, "exactly") != NULL;
    QDOT_TRY(store_start_errors(session, run));
    return give_notice_of_parameters(session, run->name, report);
}

static qdot_status
find_start_symbol(qdot_record *r, const qdot_filled *part, qdot_expr *symbol)
{
    if (qdot_set_is_momentum(r->cursor.session, part))
        return qdot_set_find_jet(r, part, symbol);
    QDOT_TRY(qdot_set_find_speed(r, part, symbol));
    return *symbol != QDOT_NIL ? QDOT_OK : qdot_set_find_jet(r, part, symbol);
}

/* Read the pairs Q = VALUE, Q' = VALUE, p[Q] = VALUE, U = VALUE, ... into the list: of coordinates and speeds. */
static qdot_status
read_start_values(qdot_record *r, qdot_pairs *list)
{
    for (size_t i = 1; i < r->parts.n; i++) {
        const qdot_filled *part = &r->parts.at[i];
        qdot_expr jet = QDOT_NIL, value = QDOT_NIL;

        if (part->node->kind != QDOT_USAGE_HOLE || qdot_filled_is(part, "VALUE"))
            continue;
        QDOT_TRY(find_start_symbol(r, part, &jet));
        QDOT_TRY(qdot_set_find_constant(r, qdot_record_next(r, part, "VALUE"), jet, &value));
        QDOT_TRY(qdot_pairs_push(list, part->from, jet, value));
    }
    return QDOT_OK;
}

static bool
is_velocity(const qdot_session *session, qdot_expr symbol)
{
    const qdot_symbol *s = qdot_expr_symbol(session->pool, symbol);

    return s->class == QDOT_MOMENTUM || s->order == 1;
}

/* Whether the start gives every coordinate and every velocity, as after `start RUN`. */
static bool
is_whole_state(const qdot_session *session)
{
    const qdot_scene *scene = session->scene;

    for (size_t i = 0; i < 2 * scene->coordinates.n; i++)
        if (qdot_scene_state_of(scene, scene->coordinates.at[i / 2]) == NULL &&
            qdot_session_value_started(session, qdot_symbol_jet(session->pool, scene->coordinates.at[i / 2], i % 2)) == QDOT_NIL)
            return false;
    return true;
}

/* A momentum and the velocity of one coordinate are not both given. */
static qdot_status
refuse_momentum_and_velocity(qdot_record *r, const qdot_pairs *list)
{
    qdot_session *session = r->cursor.session;
    const size_t n = list->symbols.n;

    for (size_t i = 0; i < session->scene->coordinates.n; i++) {
        const qdot_expr q = session->scene->coordinates.at[i];
        const size_t p = qdot_expr_place(n, list->symbols.at, qdot_symbol_of(session->pool, QDOT_MOMENTUM, q));
        const size_t v = qdot_expr_place(n, list->symbols.at, qdot_symbol_jet(session->pool, q, 1));
        const char *name = qdot_expr_symbol(session->pool, q)->name;

        if (p == n || v == n)
            continue;
        r->cursor.error_at = list->places.at[p > v ? p : v]->start;
        return qdot_fail(QDOT_EINVAL, "%.100s' and p[%.100s] are both given: leave one out", name, name);
    }
    return qdot_pool_check(session->pool);
}

/* A start gives velocities or speeds; those of a whole state are turned into these. */
static qdot_status
keep_one_kind(qdot_record *r, const qdot_pairs *list)
{
    qdot_session *session = r->cursor.session;
    const bool turns = qdot_session_starts_by_velocities(session) && is_whole_state(session);
    bool velocities = !turns && qdot_session_starts_by_velocities(session), speeds = qdot_session_starts_by_speeds(session);

    for (size_t i = 0; i < list->symbols.n; i++) {
        const bool speed = qdot_session_is_speed(session, list->symbols.at[i]);

        velocities |= is_velocity(session, list->symbols.at[i]);
        speeds |= speed;
        if (!velocities || !speeds)
            continue;
        r->cursor.error_at = list->places.at[i]->start;
        (void)qdot_fail(QDOT_EINVAL, speed ? "the start gives velocities, and speeds determine all of them"
                                           : "the start gives speeds, which determine all velocities");
        return qdot_hint("`reset start`, then give either");
    }
    return turns && speeds ? qdot_session_start_by_speeds(session) : QDOT_OK;
}

/* Carry out `start NAME` if NAME is a run; it may also be q' or q[1], to be refused. */
static qdot_status
carry_out_start_name(qdot_record *r, const qdot_filled *part)
{
    qdot_expr jet;

    if (part->to == part->from + 1)
        return start_at_end_of_run(r, part->from->text);
    QDOT_TRY(qdot_set_find_jet(r, part, &jet));
    return qdot_record_expected(r, part->to, "`=`");
}

static qdot_status
carry_out_start(qdot_record *r)
{
    const qdot_filled *run = qdot_record_hole(r, NULL, "RUN");
    qdot_session *session = r->cursor.session;
    qdot_pairs list = {0};
    qdot_status status;

    if (run != NULL)
        return carry_out_start_name(r, run);
    status = read_start_values(r, &list);
    if (status == QDOT_OK)
        status = refuse_momentum_and_velocity(r, &list);
    for (size_t i = 0; i < list.symbols.n && status == QDOT_OK; i++) {
        if (!qdot_expr_is_coordinate(session->pool, list.symbols.at[i]))
            continue;
        r->cursor.error_at = list.places.at[i]->start;
        status = qdot_session_in_domain(session, list.symbols.at[i], list.values.at[i]);
    }
    if (status == QDOT_OK)
        status = keep_one_kind(r, &list);
    for (size_t i = 0; i < list.symbols.n && status == QDOT_OK; i++)
        status = qdot_session_start(session, list.symbols.at[i], list.values.at[i]);
    if (status == QDOT_OK)
        session->values->start_exactly = qdot_record_word(r, "exactly") != NULL;
    qdot_pairs_free(&list);
    return status;
}
