/* linearize.c -- the statement `linearize`: the motion near an equilibrium, another state or a time of a run, to first
 * order, as matrices with named states and inputs. */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/value-kind.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/ask/ask.h"
#include "lang/commands/warnings.h"
#include "lang/functions/linear.h"
#include "lang/session/history.h"
#include "lang/session/runs.h"
#include "lang/session/speeds.h"
#include "lang/syntax/record.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/scene.h"

static qdot_status carry_out_linearize(qdot_record *r);

QDOT_STATEMENT(linearize) = {
    .word = "linearize",
    .group = QDOT_ASKING,
    .usage = "linearize at EQUILIBRIUM | linearize along RUN at T",
    .summary = "x' = A x + B u near an equilibrium, a state or a time of a run; with outputs y = C x + D u",
    .example = "linearize at equilibria[1]",
    .nameable = true,
    .linear = true,
    .handler = carry_out_linearize,
};

typedef struct {
    qdot_vec(qdot_expr) symbols, values;
    qdot_vec(double) errors;
    bool measured;
} state;

static void
state_free(state *x)
{
    qdot_free(x->symbols.at);
    qdot_free(x->values.at);
    qdot_free(x->errors.at);
}

/* --- the state ------------------------------------------------------------------------------- */

static qdot_status
refuse_place(qdot_record *r, const qdot_filled *place)
{
    qdot_record_blame(r, place);
    (void)qdot_fail(QDOT_ETYPE, "the motion is made linear at a list of equations: of coordinates, velocities, inputs");
    return qdot_hint("linearize at equilibria[1]");
}

/* Whether a value of this symbol belongs to a state. */
static bool
belongs_to_state(const qdot_session *session, qdot_expr x)
{
    if (x == QDOT_T || qdot_expr_is_class(session->pool, x, QDOT_MULTIPLIER))
        return true;
    if (qdot_session_is_speed(session, x))
        return true;
    for (size_t i = 0; i < session->scene->inputs.n; i++)
        if (session->scene->inputs.at[i] == x)
            return true;
    for (size_t i = 0; i < session->scene->coordinates.n; i++)
        if (x == session->scene->coordinates.at[i] || x == qdot_symbol_jet(session->pool, session->scene->coordinates.at[i], 1))
            return true;
    return false;
}

static qdot_status
read_equations(qdot_record *r, const qdot_filled *place, state *x)
{
    qdot_session *session = r->cursor.session;
    qdot_pool *pool = session->pool;
    qdot_expr list;

    QDOT_TRY(qdot_record_value(r, place, &list));
    if (qdot_expr_kind(pool, list) == QDOT_REL)
        list = qdot_list(pool, 1, &list);
    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_kind(pool, list) != QDOT_LIST)
        return refuse_place(r, place);
    for (uint32_t i = 0; i < qdot_expr_count(pool, list); i++) {
        const qdot_expr one = qdot_expr_arg(pool, list, i);

        if (qdot_expr_kind(pool, one) != QDOT_REL)
            return refuse_place(r, place);
        if (qdot_expr_node(pool, one)->op != QDOT_EQ) /* the range of a band of equilibria */
            continue;
        if (!belongs_to_state(session, qdot_expr_arg(pool, one, 0)) ||
            !qdot_expr_is_scalar(pool, qdot_expr_arg(pool, one, 1)))
            return refuse_place(r, place);
        if (qdot_expr_place(x->symbols.n, x->symbols.at, qdot_expr_arg(pool, one, 0)) < x->symbols.n) {
            qdot_record_blame(r, place);
            return qdot_fail(QDOT_EINVAL, "`%.100s` has two values here",
                             qdot_expr_symbol(pool, qdot_expr_arg(pool, one, 0))->name);
        }
        QDOT_TRY(qdot_vec_push(&x->symbols, qdot_expr_arg(pool, one, 0)));
        QDOT_TRY(qdot_vec_push(&x->values, qdot_expr_arg(pool, one, 1)));
    }
    return QDOT_OK;
}

/* The symbols of a state: coordinates and velocities; and the inputs. */
static qdot_status
list_symbols(const qdot_session *session, state *x, qdot_runs_columns *columns)
{
    const qdot_scene *scene = session->scene;

    for (size_t i = 0; i < 2 * scene->coordinates.n; i++) {
        const qdot_expr jet = qdot_symbol_jet(session->pool, scene->coordinates.at[i / 2], i % 2);

        QDOT_TRY(qdot_vec_push(&x->symbols, jet));
        QDOT_TRY(qdot_vec_push(columns, jet));
    }
    for (size_t i = 0; i < scene->inputs.n; i++) { /* with the values that they had in the run */
        QDOT_TRY(qdot_vec_push(&x->symbols, scene->inputs.at[i]));
        QDOT_TRY(qdot_vec_push(columns, scene->inputs.at[i]));
    }
    return QDOT_OK;
}

/* The state of a run at a time, each value with its error. */
static qdot_status
read_run(qdot_record *r, state *x)
{
    qdot_session *session = r->cursor.session;
    qdot_runs_columns columns = {0};
    qdot_measured *m = qdot_calloc(2 * session->scene->coordinates.n + session->scene->inputs.n + 1, sizeof *m);
    const char *run;
    qdot_expr time;
    qdot_status status = m == NULL ? QDOT_ENOMEM : list_symbols(session, x, &columns);

    if (status == QDOT_OK)
        status = qdot_record_name(r, qdot_record_hole(r, "along", NULL), &run);
    if (status == QDOT_OK)
        status = qdot_record_scalar(r, qdot_record_hole(r, "at", "T"), &time);
    r->cursor.error_at = qdot_record_hole(r, "along", NULL)->from->start;
    if (status == QDOT_OK)
        status = qdot_runs_measure(session, run, &columns, time, m);
    for (size_t i = 0; i < columns.n && status == QDOT_OK; i++) {
        status = qdot_vec_push(&x->values, m[i].exact != QDOT_NIL ? m[i].exact
                                                                    : qdot_measured_rational(session->pool, m[i].value));
        if (status == QDOT_OK)
            status = qdot_vec_push(&x->errors, m[i].error);
    }
    if (status == QDOT_OK)
        status = qdot_vec_push(&x->symbols, QDOT_T);
    if (status == QDOT_OK)
        status = qdot_vec_push(&x->values, qdot_measured_as_rationals(session, time));
    if (status == QDOT_OK)
        status = qdot_vec_push(&x->errors, 0);
    x->measured = true;
    qdot_free(columns.at);
    qdot_free(m);
    return status;
}

/* A place gives velocities or speeds. */
static qdot_status
need_one_kind(qdot_record *r, const qdot_filled *place, const state *x)
{
    const qdot_session *session = r->cursor.session;
    bool velocities = false, speeds = false;

    for (size_t i = 0; i < x->symbols.n; i++) {
        velocities |= qdot_expr_symbol(session->pool, x->symbols.at[i])->order == 1;
        speeds |= qdot_session_is_speed(session, x->symbols.at[i]);
    }
    if (!velocities || !speeds)
        return QDOT_OK;
    qdot_record_blame(r, place);
    return qdot_fail(QDOT_EINVAL, "a state is given by speeds or by velocities");
}

/* Whether a value was found numerically: a number with an error, or a rational of many digits. */
static bool
is_numeric(qdot_session *session, const state *x)
{
    for (size_t i = 0; i < x->values.n; i++) {
        const fmpq *value = qdot_expr_rational(session->pool, x->values.at[i]);

        if (qdot_measured_occurs(session, x->values.at[i]) || (value != NULL && fmpz_bits(fmpq_denref(value)) > 32))
            return true;
    }
    return x->measured;
}

/* --- answers --------------------------------------------------------------------------------- */

static qdot_status
answer_part(qdot_session *session, const char *name, qdot_expr value)
{
    if (value == QDOT_NIL || (qdot_expr_kind(session->pool, value) == QDOT_LIST && qdot_expr_count(session->pool, value) == 0))
        return QDOT_OK;
    return qdot_measured_occurs(session, value) ? qdot_ask_answer(session, name, value, QDOT_NIL)
                                                : qdot_answer_expr(session, name, value);
}

static qdot_status
answer_linear_motion(qdot_session *session, const qdot_linear *linear)
{
    QDOT_TRY(answer_part(session, "linearize[states]", linear->states));
    QDOT_TRY(answer_part(session, "linearize[inputs]", linear->inputs));
    QDOT_TRY(answer_part(session, "linearize[outputs]", linear->outputs));
    QDOT_TRY(answer_part(session, "linearize[A]", linear->A));
    QDOT_TRY(answer_part(session, "linearize[B]", linear->B));
    QDOT_TRY(answer_part(session, "linearize[C]", linear->C));
    return answer_part(session, "linearize[D]", linear->D);
}

/* Inputs enter by their values only: of one that moves something the rates would enter too. */
static qdot_status
need_inputs_without_rates(const qdot_session *session)
{
    qdot_scene *scene = session->scene;

    for (size_t i = 0; i < scene->inputs.n; i++) {
        const qdot_expr input = scene->inputs.at[i];
        bool matters;

        QDOT_TRY(qdot_mech_rate_matters(scene, input, &matters));
        for (size_t k = 0; k < scene->constraints.n; k++)
            matters |= qdot_expr_contains(session->pool, scene->constraints.at[k].f, input);
        if (matters)
            return qdot_fail(QDOT_ENOTBUILT,
                             "not built yet: the linear motion where something moves with the input `%.100s`, whose "
                             "rates would be inputs too", qdot_expr_symbol(session->pool, input)->name);
    }
    return QDOT_OK;
}

/* An input on which nothing depends was a mistake. */
static qdot_status
need_inputs_used(qdot_session *session)
{
    for (size_t i = 0; i < session->scene->inputs.n; i++)
        if (!qdot_scene_contains(session->scene, session->scene->inputs.at[i])) {
            (void)qdot_fail(QDOT_EINVAL, "nothing in the scene depends on the input `%.100s`",
                            qdot_expr_symbol(session->pool, session->scene->inputs.at[i])->name);
            return qdot_hint("force %.50s on %.50s", qdot_expr_symbol(session->pool, session->scene->inputs.at[i])->name,
                             session->scene->coordinates.n > 0
                                 ? qdot_expr_symbol(session->pool, session->scene->coordinates.at[0])->name : "x");
        }
    return QDOT_OK;
}

static qdot_status
read_state(qdot_record *r, const qdot_filled *place, state *x)
{
    if (place == NULL)
        return read_run(r, x);
    QDOT_TRY(read_equations(r, place, x));
    QDOT_TRY(qdot_warnings_inputs(r->cursor.session, x->symbols.n, x->symbols.at));
    return need_one_kind(r, place, x);
}

static qdot_status
carry_out_linearize(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    const qdot_filled *place = qdot_record_hole(r, "at", "EQUILIBRIUM");
    state x = {0};
    bool moves = false;
    qdot_speeds speeds;
    qdot_status status;

    QDOT_TRY(qdot_session_speeds(session, &speeds));
    status = read_state(r, place, &x);
    if (status == QDOT_OK)
        r->cursor.error_at = r->start[-1].start; /* errors point at the word `linearize` */
    if (status == QDOT_OK)
        status = need_inputs_used(session);
    if (status == QDOT_OK)
        status = need_inputs_without_rates(session);
    if (status == QDOT_OK)
        status = qdot_linear_find(session, &(qdot_linear_place){.speeds = speeds.n > 0 ? &speeds : NULL,
                                                                .n = x.symbols.n,
                                                                .symbols = x.symbols.at,
                                                                .values = x.values.at,
                                                                .errors = x.measured ? x.errors.at : NULL,
                                                                .numbers = is_numeric(session, &x)}, &moves);
    state_free(&x);
    qdot_free((void *)speeds.symbol);
    QDOT_TRY(status);
    if (moves && place != NULL)
        QDOT_TRY(qdot_answer_notice(session, "this state is no equilibrium: the matrices are those of the deviation from "
                                             "the motion through it, at that moment"));
    if (session->history->linear.A != QDOT_NIL)
        QDOT_TRY(qdot_vec_push(&session->history->values, session->history->linear.A));
    return answer_linear_motion(session, &session->history->linear);
}
