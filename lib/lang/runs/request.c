/* request.c -- makes the request of a run from the session's present parameter values and start. */
#include "lang/runs/request.h"

#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/commands/value-check.h"
#include "lang/commands/warnings.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/scales.h"
#include "lang/session/values.h"
#include "mech/dynamics/multiplier-forces.h"
#include "mech/dynamics/quantity.h"

void
qdot_request_free(qdot_request *o)
{
    qdot_pairs_free(&o->values);
    qdot_free(o->q0.at);
    qdot_free(o->v0.at);
    qdot_free(o->q_named.at);
    qdot_free(o->v_named.at);
    qdot_free(o->scales);
    qdot_free(o->apart);
}

/* The value with which q or q' starts; *named: it was given, and constraints may not change it. */
static qdot_expr
get_start_value(const qdot_session *session, qdot_expr jet, bool *named)
{
    const qdot_values *values = session->values;
    const qdot_expr value = qdot_session_value_started(session, jet);

    *named = value != QDOT_NIL && qdot_expr_place(values->start_open.n, values->start_open.at, jet) == values->start_open.n;
    return value == QDOT_NIL ? QDOT_ZERO : value;
}

static qdot_status
arrange_start_values(qdot_session *session, qdot_request *o)
{
    const qdot_scene *scene = session->scene;

    for (size_t i = 0; i < scene->coordinates.n; i++) {
        qdot_expr q = scene->coordinates.at[i], v = qdot_symbol_jet(session->pool, q, 1);
        bool named, v_named;
        qdot_expr q0 = qdot_session_bind(session, get_start_value(session, q, &named));
        qdot_expr v0 = qdot_session_bind(session, get_start_value(session, v, &v_named));
        qdot_status status;

        QDOT_TRY(qdot_pool_check(session->pool));
        /* starting values that constraints determine are checked later, when the constraints are solved */
        status = named || scene->constraints.n + scene->eliminated.n == 0
                     ? qdot_session_in_domain(session, q, q0)
                     : QDOT_OK;
        if (status != QDOT_OK)
            return named ? status
                         : qdot_hint("start %s = ...: what was never named starts at 0",
                                     qdot_expr_symbol(session->pool, q)->name);
        QDOT_TRY(qdot_vec_push(&o->q_named, named));
        QDOT_TRY(qdot_vec_push(&o->v_named, v_named));
        QDOT_TRY(qdot_vec_push(&o->q0, q0));
        QDOT_TRY(qdot_vec_push(&o->v0, v0));
    }
    return QDOT_OK;
}

/* How far the companions of this run begin from its start: as far as those of the run of `start RUN` ended from its end, in
 * the values that are still those of that end. */
static qdot_status
set_start_errors(const qdot_session *session, qdot_request *o)
{
    const size_t n = session->scene->coordinates.n;
    bool any = false;

    if (session->values->start_errors.n == 0)
        return QDOT_OK;
    o->apart = qdot_calloc(4 * n + 1, sizeof *o->apart);
    if (o->apart == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < session->values->start_errors.n; k++) {
        const qdot_start_error *e = &session->values->start_errors.at[k];

        if (qdot_session_value_started(session, e->symbol) != e->value)
            continue;
        for (size_t i = 0; i < 2 * n; i++)
            if (qdot_symbol_jet(session->pool, session->scene->coordinates.at[i % n], i >= n) == e->symbol) {
                o->apart[i] = e->apart[0];
                o->apart[2 * n + i] = e->apart[1];
                any = any || e->apart[0] != 0 || e->apart[1] != 0;
            }
    }
    o->request.apart = any ? o->apart : NULL;
    return qdot_pool_check(session->pool);
}

/* Whether an event of the scene sets the symbol. */
static bool
is_set_by_event(const qdot_scene *scene, qdot_expr symbol)
{
    for (size_t i = 0; i < scene->events.n; i++)
        for (size_t k = 0; k < scene->events.at[i].targets.n; k++)
            if (scene->events.at[i].targets.at[k] == symbol)
                return true;
    return false;
}

/* Let values that depend on parameters set by events keep their symbols, so that they change with these. */
static qdot_status
keep_event_parameters(qdot_session *session, qdot_request *o)
{
    const size_t n = session->values->set_symbols.n;
    const qdot_expr *symbols = session->values->set_symbols.at;
    qdot_expr *const at = session->values->set_values.at;
    qdot_expr *kept = qdot_malloc((n + 1) * sizeof *kept);
    bool some = false;

    if (kept == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        kept[i] = at[i];
        if (is_set_by_event(session->scene, symbols[i])) {
            at[i] = symbols[i];
            some = true;
        }
    }
    for (size_t i = 0; i < n && some; i++)
        if (at[i] != symbols[i])
            o->values.values.at[i] = qdot_session_bind(session, at[i]);
    for (size_t i = 0; i < n; i++)
        at[i] = kept[i];
    qdot_free(kept);
    return qdot_pool_check(session->pool);
}

/* Fill the request of a run with the session's present values of parameters and start. */
/* The value of an input may vary where only it, not its rate, enters the equations of motion. */
static qdot_status
check_varying_inputs(qdot_session *session)
{
    const uint32_t varying = QDOT_HAS_TIME | QDOT_HAS_COORD | QDOT_HAS_VELOCITY;
    bool matters;

    for (size_t i = 0; i < session->scene->inputs.n; i++) {
        const qdot_expr symbol = session->scene->inputs.at[i], value = qdot_session_bind(session, symbol);

        QDOT_TRY(qdot_pool_check(session->pool));
        if (!(qdot_expr_node(session->pool, value)->holds & varying))
            continue;
        QDOT_TRY(qdot_mech_rate_matters(session->scene, symbol, &matters));
        if (matters) {
            const char *name = qdot_expr_symbol(session->pool, symbol)->name;

            qdot_fail(QDOT_ENOTBUILT, "not built yet: a mass or damper that moves with the input `%.100s`, whose value varies",
                      name);
            return qdot_hint("write its value in place of `%.100s`", name);
        }
    }
    return QDOT_OK;
}

qdot_status
qdot_request_fill(qdot_session *session, qdot_request *o)
{
    if (session->scene->coordinates.n == 0) {
        (void)qdot_fail(QDOT_EINVAL,
                        "there is nothing to integrate: no coordinate is declared");
        return qdot_hint("coord theta");
    }
    for (size_t i = 0; i < session->values->set_symbols.n; i++) {
        qdot_expr symbol = session->values->set_symbols.at[i];
        qdot_expr value = qdot_session_bind(session, session->values->set_values.at[i]);

        QDOT_TRY(qdot_pool_check(session->pool));
        if (qdot_expr_is_class(session->pool, symbol, QDOT_PARAM))
            QDOT_TRY(qdot_session_in_domain(session, symbol, value));
        QDOT_TRY(qdot_pairs_push(&o->values, NULL, symbol, value));
    }
    for (size_t i = 0; i < session->scene->inputs.n; i++) { /* an input without a value is 0 */
        const qdot_expr symbol = session->scene->inputs.at[i];

        if (qdot_session_bind(session, symbol) == symbol)
            QDOT_TRY(qdot_pairs_push(&o->values, NULL, symbol, QDOT_ZERO));
    }
    QDOT_TRY(check_varying_inputs(session));
    QDOT_TRY(keep_event_parameters(session, o));
    QDOT_TRY(qdot_value_check_assumed(session));
    QDOT_TRY(arrange_start_values(session, o));
    QDOT_TRY(set_start_errors(session, o));
    QDOT_TRY(qdot_scales_of_run(session, &o->scales));
    o->request.n_values = o->values.symbols.n;
    o->request.symbols = o->values.symbols.at;
    o->request.values = o->values.values.at;
    o->request.q0 = o->q0.at;
    o->request.v0 = o->v0.at;
    o->request.q_named = o->q_named.at;
    o->request.v_named = o->v_named.at;
    o->request.scales = o->scales;
    o->request.exactly = session->values->start_exactly;
    return QDOT_OK;
}

qdot_status
qdot_request_limits(qdot_session *session, qdot_expr from, qdot_expr to, qdot_request *o)
{
    o->request.said[0] = qdot_measured_as_rationals(session, from);
    o->request.said[1] = qdot_measured_as_rationals(session, to);
    o->request.t0 = qdot_session_bind(session, o->request.said[0]);
    o->request.t1 = qdot_session_bind(session, o->request.said[1]);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_request_speeds(session, o));
    return qdot_request_momenta(session, o);
}

qdot_status
qdot_request_between(qdot_session *session, qdot_expr from, qdot_expr to, qdot_request *o)
{
    QDOT_TRY(qdot_request_fill(session, o));
    QDOT_TRY(qdot_request_limits(session, from, to, o));
    return qdot_warnings_start(session);
}

/* --- why it failed -------------------------------------------------------------------- */

/* Fail because a mass is negative, with a message such as "the mass of p is negative: m - 2 = -1". */
static qdot_status
report_negative_mass(qdot_session *session, const char *what, const char *name, qdot_expr e,
                     double value)
{
    qdot_text text = {0};
    qdot_status status = qdot_print(session->pool, e, QDOT_PLAIN, &text);

    if (status == QDOT_OK)
        status = qdot_text_status(&text);
    if (status == QDOT_OK && qdot_expr_kind(session->pool, e) == QDOT_NUM)
        status = qdot_fail(
            QDOT_ESINGULAR,
            "the mass matrix is not positive definite: the %s of %.100s is negative: "
            "%.10g",
            what, name, value);
    else if (status == QDOT_OK)
        status = qdot_fail(
            QDOT_ESINGULAR,
            "the mass matrix is not positive definite: the %s of %.100s is negative: "
            "%.200s = %.10g",
            what, name, text.at, value);
    if (status == QDOT_ESINGULAR && qdot_expr_is_class(session->pool, e, QDOT_PARAM))
        status = qdot_hint("set %.100s = %.10g", text.at, -value);
    qdot_text_clear(&text);
    return status;
}

/* Fail with QDOT_ESINGULAR if the mass, or a moment of inertia of the body, is negative with these values. */
static qdot_status
check_not_negative(qdot_session *session, const qdot_request *o, const char *what,
                   const char *name, qdot_expr e)
{
    qdot_pool *pool = session->pool;
    const bool scalar = qdot_expr_is_scalar(pool, e);
    const uint32_t n = scalar ? 1 : qdot_expr_kind(pool, e) == QDOT_MAT ? 3 : 0;

    for (uint32_t i = 0; i < n; i++) {
        const qdot_expr one =
            scalar ? e : qdot_expr_arg(pool, e, 4 * i); /* diagonal entry i of a 3 x 3 matrix */
        const qdot_expr bound = qdot_subs(pool, one, o->request.n_values,
                                          o->request.symbols, o->request.values);
        double value;

        QDOT_TRY(qdot_pool_check(pool));
        if (qdot_expr_kind(pool, bound) != QDOT_NUM)
            continue;
        QDOT_TRY(qdot_session_number(session, bound, &value, NULL));
        if (value < 0)
            return report_negative_mass(session, what, name, one, value);
    }
    return QDOT_OK;
}

qdot_status
qdot_request_masses(qdot_session *session, const qdot_request *o)
{
    const qdot_scene *scene = session->scene;

    for (size_t i = 0; i < scene->particles.n; i++)
        QDOT_TRY(check_not_negative(session, o, "mass", scene->particles.at[i].name,
                                    scene->particles.at[i].mass));
    for (size_t i = 0; i < scene->bodies.n; i++) {
        const qdot_body *body = &scene->bodies.at[i];

        QDOT_TRY(check_not_negative(session, o, "mass", body->name, body->mass));
        QDOT_TRY(
            check_not_negative(session, o, "moment of inertia", body->name, body->inertia));
    }
    return QDOT_OK;
}

qdot_status
qdot_request_explain(qdot_session *session, const qdot_request *o, qdot_status status)
{
    const qdot_error error = *qdot_last_error();

    if ((status == QDOT_EDOMAIN || status == QDOT_EFAILED) && error.hint[0] == '\0'
        && strstr(error.message, "root of a negative number") != NULL && qdot_multipliers_are_bound(session->scene))
        return qdot_hint("friction holds a multiplier: where the motion would determine no value of it, or two "
                         "(Painlev\u00e9's paradox), that force is undefined");
    if (status != QDOT_ESINGULAR)
        return status;
    QDOT_TRY(qdot_request_masses(session, o));
    return qdot_fail_again(&error);
}
