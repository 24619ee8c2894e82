/* start.c -- set, start: the values and the initial state, and the request for a run
 * with them. */
#include "lang/commands/number.h"

#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/commands/declare.h"
#include "lang/commands/statement.h"
#include "lang/commands/values.h"

qdot_status
qdot_number_unknown(const qdot_session *session, const char *what, const char *name)
{
    const char *near = qdot_names_nearest(session->names, name, 0, NULL);

    (void)qdot_fail(QDOT_ENAME, "there is no %s `%s`", what, name);
    return near != NULL ? qdot_hint("did you mean `%s`?", near)
                        : qdot_hint("param %s declares it", name);
}

/* --- set ---------------------------------------------------------------------------- */

/* p[NAME] with NAME a coordinate: the independent momentum. */
static qdot_status
read_momentum(qdot_cursor *c, qdot_expr *symbol)
{
    qdot_expr q;

    c->at++;
    QDOT_TRY(qdot_cursor_expect_op(c, "["));
    QDOT_TRY(qdot_read_coordinate(c, &q));
    QDOT_TRY(qdot_cursor_expect_op(c, "]"));
    *symbol = qdot_symbol_of(c->session->pool, QDOT_MOMENTUM, q);
    return qdot_pool_check(c->session->pool);
}

/* The left side of `NAME = VALUE`: a parameter or a momentum. */
qdot_status
qdot_number_read_parameter(qdot_cursor *c, qdot_expr *symbol)
{
    const qdot_token *start = c->at;
    const qdot_name *known;
    const char *name;

    if (qdot_cursor_is_word(c, "p") && c->at[1].glued &&
        c->at[1].kind == QDOT_TOKEN_OPERATOR && strcmp(c->at[1].text, "[") == 0 &&
        !qdot_names_is_family(c->session->names, "p"))
        return read_momentum(c, symbol);
    QDOT_TRY(qdot_read_name(c, &name));
    known = qdot_names_find(c->session->names, name);
    if (known != NULL && known->kind == QDOT_NAME_PARAM) {
        *symbol = known->value;
        return QDOT_OK;
    }
    c->error_at = start->start;
    if (known == NULL)
        return qdot_number_unknown(c->session, "parameter", name);
    (void)qdot_fail(QDOT_ENAME, "`%s` is not a parameter", name);
    return known->kind == QDOT_NAME_COORD  ? qdot_hint("start %s = ...", name)
           : known->kind == QDOT_NAME_UFUN ? qdot_hint("set %s(...) = ...", name)
                                           : qdot_hint("%s = ... names it anew", name);
}

static const uint32_t motion = QDOT_HAS_COORD | QDOT_HAS_VELOCITY |
                               QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER |
                               QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA;

/* A value that depended on the motion behind the back of its arguments would be missing
 * from every derivative. */
static qdot_status
check_body(qdot_pool *pool, qdot_expr formals, qdot_expr body)
{
    uint32_t own = 0;

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, formals); i++)
        own |= qdot_expr_node(pool, qdot_expr_arg(pool, formals, i))->holds;
    if (!(qdot_expr_node(pool, body)->holds & (motion | QDOT_HAS_TIME) & ~own))
        return QDOT_OK;
    (void)qdot_fail(QDOT_ETYPE,
                    "the value of a function holds its arguments and parameters only");
    return qdot_hint("declare it with what it depends on, as in function f(x, t)");
}

/* x(s, t) as the symbol; the body with s, t in place of the names it was given with. */
static qdot_status
in_declared_arguments(qdot_pool *pool, uint32_t id, qdot_expr formals, qdot_expr *symbol,
                      qdot_expr *body)
{
    uint32_t n = qdot_ufun_get(pool, id)->arity;
    qdot_expr *from = qdot_calloc(2 * (size_t)n, sizeof *from), *to;

    if (from == NULL)
        return QDOT_ENOMEM;
    to = from + n;
    for (uint32_t i = 0; i < n; i++) {
        from[i] = qdot_expr_arg(pool, formals, i);
        to[i] = qdot_expr_arg(pool, qdot_ufun_get(pool, id)->formals, i);
    }
    *symbol = qdot_ufun_apply(pool, id, to, NULL);
    *body = qdot_subs(pool, *body, n, from, to);
    qdot_free(from);
    return qdot_pool_check(pool);
}

/* NAME(u, v) = BODY of a declared function. */
static qdot_status
read_function(qdot_cursor *c, qdot_expr *symbol, qdot_expr *body)
{
    qdot_pool *pool = c->session->pool;
    const qdot_token *start = c->at, **names = NULL;
    const qdot_name *known = qdot_names_find(c->session->names, start->text);
    qdot_expr formals = QDOT_NIL;
    qdot_status status;
    uint32_t id;
    size_t n = 0;

    c->error_at = start->start;
    if (known == NULL || known->kind != QDOT_NAME_UFUN) {
        (void)qdot_fail(QDOT_ENAME, "`%s` is not an undefined function", start->text);
        return qdot_hint(
            "%s(...) = ... defines a function; `function` declares an undefined one",
            start->text);
    }
    id = known->ufun;
    c->at++;
    status = qdot_declare_read_formals(c, &formals, &names, &n);
    if (status == QDOT_OK && n != qdot_ufun_get(pool, id)->arity) {
        c->error_at = start->start;
        status = qdot_fail(QDOT_ETYPE, "`%s` has %u arguments, not %zu", start->text,
                           qdot_ufun_get(pool, id)->arity, n);
    }
    if (status == QDOT_OK)
        status = qdot_cursor_expect_op(c, "=");
    if (status == QDOT_OK)
        status = qdot_declare_read_body(c, formals, n, names, body);
    if (status == QDOT_OK) {
        c->error_at = start->start;
        status = check_body(pool, formals, *body);
    }
    if (status == QDOT_OK) /* said in the arguments of its declaration */
        status = in_declared_arguments(pool, id, formals, symbol, body);
    qdot_free(names);
    return status;
}

void
qdot_number_free_pairs(qdot_number_pairs *p)
{
    qdot_free(p->symbols.at);
    qdot_free(p->values.at);
    qdot_free(p->places.at);
}

qdot_status
qdot_number_push_pair(qdot_number_pairs *p, const qdot_token *place, qdot_expr symbol,
                      qdot_expr value)
{
    QDOT_TRY(qdot_vec_push(&p->symbols, symbol));
    QDOT_TRY(qdot_vec_push(&p->values, value));
    return qdot_vec_push(&p->places, place);
}

/* A number of a run becomes the rational that it is. */
qdot_expr
qdot_number_without_measured(qdot_session *session, qdot_expr e)
{
    for (size_t i = 0; i < session->measured.n && e != QDOT_NIL; i++) {
        qdot_expr from = session->measured.at[i].symbol, to;

        if (!(qdot_expr_node(session->pool, e)->holds & QDOT_HAS_FORMAL))
            return e;
        if (!qdot_expr_contains(session->pool, e, from))
            continue;
        to = session->measured.at[i].digits > 0
                 ? session->measured.at[i].exact
                 : qdot_number_exact(session->pool, session->measured.at[i].value);
        e = qdot_subs(session->pool, e, 1, &from, &to);
    }
    return e;
}

/* `= VALUE`, an expression of parameters. */
qdot_status
qdot_number_read_constant(qdot_cursor *c, qdot_expr *value)
{
    const qdot_token *start;

    QDOT_TRY(qdot_cursor_expect_op(c, "="));
    start = c->at;
    QDOT_TRY(qdot_read_scalar(c, value));
    *value = qdot_number_without_measured(c->session, *value);
    QDOT_TRY(qdot_pool_check(c->session->pool));
    if (qdot_expr_node(c->session->pool, *value)->holds & (motion | QDOT_HAS_TIME)) {
        c->error_at = start->start;
        return qdot_fail(QDOT_ETYPE,
                         "a value holds parameters only: no coordinate, no time");
    }
    return QDOT_OK;
}

qdot_status
qdot_number_set(qdot_cursor *c)
{
    qdot_session *session = c->session;
    qdot_status status = QDOT_OK;
    qdot_number_pairs list = {0};

    do {
        const qdot_token *start = c->at;
        bool function = c->at->kind == QDOT_TOKEN_NAME &&
                        c->at[1].kind == QDOT_TOKEN_OPERATOR &&
                        strcmp(c->at[1].text, "(") == 0;
        qdot_expr symbol = QDOT_NIL, value = QDOT_NIL;

        status = function ? read_function(c, &symbol, &value)
                          : qdot_number_read_parameter(c, &symbol);
        if (status == QDOT_OK && !function)
            status = qdot_number_read_constant(c, &value);
        if (status == QDOT_OK)
            status = qdot_number_push_pair(&list, start, symbol, value);
    } while (status == QDOT_OK && qdot_cursor_accept_op(c, ","));
    if (status == QDOT_OK)
        status = qdot_cursor_expect_end(c);
    for (size_t i = 0; i < list.symbols.n && status == QDOT_OK; i++) {
        if (!qdot_expr_is_class(session->pool, list.symbols.at[i], QDOT_PARAM))
            continue;
        c->error_at = list.places.at[i]->start;
        status = qdot_declare_in_domain(session, list.symbols.at[i], list.values.at[i]);
    }
    if (status == QDOT_OK)
        status = qdot_values_check(c, &list);
    for (size_t i = 0; i < list.symbols.n && status == QDOT_OK; i++)
        qdot_declare_value(session, list.symbols.at[i], list.values.at[i], &status);
    qdot_number_free_pairs(&list);
    return status;
}

/* --- start -------------------------------------------------------------------------- */

qdot_status
qdot_number_set_start(qdot_session *session, qdot_expr jet, qdot_expr value)
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

/* What events set is for the rest of their run: told where a run goes on from its end. */
static qdot_status
tell_parameters(qdot_session *session, const char *name, const qdot_run_report *report)
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

static qdot_status
start_from_run(qdot_cursor *c)
{
    qdot_session *session = c->session;
    const qdot_token *start = c->at;
    const qdot_run_report *report;
    qdot_named_run *run;
    const char *name;
    bool exactly;

    QDOT_TRY(qdot_read_name(c, &name));
    exactly = qdot_cursor_accept_word(c, "exactly");
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start->start;
    QDOT_TRY(qdot_number_find_run(session, name, &run));
    report = qdot_run_get_report(run->run);
    for (size_t i = 0; i < report->n - report->n_states; i++) {
        qdot_expr q = report->coordinates[i], v = qdot_symbol_jet(session->pool, q, 1);
        qdot_expr q0, v0;

        if (report->exact != NULL) {
            q0 = report->exact[i];
            v0 = report->exact[report->n + i];
        } else {
            q0 = qdot_number_exact(session->pool, report->q[i]);
            v0 = qdot_number_exact(session->pool, report->v[i]);
        }
        QDOT_TRY(qdot_pool_check(session->pool));
        QDOT_TRY(qdot_number_set_start(session, q, q0));
        QDOT_TRY(qdot_number_set_start(session, v, v0));
    }
    session->start_exactly = exactly;
    return tell_parameters(session, run->name, report);
}

/* q or q' on the left of `start` */
qdot_status
qdot_number_read_jet(qdot_cursor *c, qdot_expr *jet)
{
    const qdot_token *start = c->at;

    QDOT_TRY(qdot_read_coordinate(c, jet));
    if (qdot_expr_symbol(c->session->pool, *jet)->order > 1) {
        c->error_at = start->start;
        return qdot_fail(QDOT_EINVAL, "a start names coordinates and velocities");
    }
    return QDOT_OK;
}

static bool
is_run_name(const qdot_cursor *c)
{
    const qdot_token *next = c->at + 1;

    if (c->at->kind != QDOT_TOKEN_NAME)
        return false;
    if (next->kind == QDOT_TOKEN_NAME && strcmp(next->text, "exactly") == 0)
        next++;
    return next->kind == QDOT_TOKEN_END;
}

qdot_status
qdot_number_start(qdot_cursor *c)
{
    qdot_session *session = c->session;
    qdot_status status = QDOT_OK;
    qdot_number_pairs list = {0};
    bool exactly = false;

    if (is_run_name(c))
        return start_from_run(c);
    do {
        const qdot_token *start = c->at;
        qdot_expr jet = QDOT_NIL, value = QDOT_NIL;

        status = qdot_number_read_jet(c, &jet);
        if (status == QDOT_OK)
            status = qdot_number_read_constant(c, &value);
        if (status == QDOT_OK)
            status = qdot_number_push_pair(&list, start, jet, value);
    } while (status == QDOT_OK && qdot_cursor_accept_op(c, ","));
    if (status == QDOT_OK)
        exactly = qdot_cursor_accept_word(c, "exactly");
    if (status == QDOT_OK)
        status = qdot_cursor_expect_end(c);
    for (size_t i = 0; i < list.symbols.n && status == QDOT_OK; i++) {
        if (!qdot_expr_is_coordinate(session->pool, list.symbols.at[i]))
            continue;
        c->error_at = list.places.at[i]->start;
        status = qdot_declare_in_domain(session, list.symbols.at[i], list.values.at[i]);
    }
    for (size_t i = 0; i < list.symbols.n && status == QDOT_OK; i++)
        status = qdot_number_set_start(session, list.symbols.at[i], list.values.at[i]);
    if (status == QDOT_OK)
        session->start_exactly = exactly;
    qdot_number_free_pairs(&list);
    return status;
}

/* --- requests ----------------------------------------------------------------------- */

void
qdot_number_free_order(qdot_number_order *o)
{
    qdot_number_free_pairs(&o->values);
    qdot_free(o->q0.at);
    qdot_free(o->v0.at);
    qdot_free(o->q_named.at);
    qdot_free(o->v_named.at);
}

static qdot_expr
start_value(const qdot_session *session, qdot_expr jet, bool *named)
{
    for (size_t i = 0; i < session->start_symbols.n; i++)
        if (session->start_symbols.at[i] == jet) {
            *named = true;
            return session->start_values.at[i];
        }
    *named = false;
    return QDOT_ZERO;
}

static qdot_status
order_start(qdot_session *session, qdot_number_order *o)
{
    const qdot_scene *scene = session->scene;

    for (size_t i = 0; i < scene->coordinates.n; i++) {
        qdot_expr q = scene->coordinates.at[i], v = qdot_symbol_jet(session->pool, q, 1);
        bool named, v_named;
        qdot_expr q0 = qdot_session_bind(session, start_value(session, q, &named));
        qdot_expr v0 = qdot_session_bind(session, start_value(session, v, &v_named));
        qdot_status status;

        QDOT_TRY(qdot_pool_check(session->pool));
        /* what constraints may solve for is looked at when they have */
        status = named || scene->constraints.n == 0
                     ? qdot_declare_in_domain(session, q, q0)
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

/* Whether an event sets it, in a run. */
static bool
is_set_by_event(const qdot_scene *scene, qdot_expr symbol)
{
    for (size_t i = 0; i < scene->events.n; i++)
        for (size_t k = 0; k < scene->events.at[i].targets.n; k++)
            if (scene->events.at[i].targets.at[k] == symbol)
                return true;
    return false;
}

/* Values that hold parameters which events set, with these in them: they follow. */
static qdot_status
follow_events(qdot_session *session, qdot_number_order *o)
{
    const size_t n = session->set_symbols.n;
    const qdot_expr *symbols = session->set_symbols.at;
    qdot_expr *const at = session->set_values.at;
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

/* The values and the start of the moment. */
qdot_status
qdot_number_fill_order(qdot_session *session, qdot_number_order *o)
{
    if (session->scene->coordinates.n == 0) {
        (void)qdot_fail(QDOT_EINVAL,
                        "there is nothing to integrate: no coordinate is declared");
        return qdot_hint("coord theta");
    }
    for (size_t i = 0; i < session->set_symbols.n; i++) {
        qdot_expr symbol = session->set_symbols.at[i];
        qdot_expr value = qdot_session_bind(session, session->set_values.at[i]);

        QDOT_TRY(qdot_pool_check(session->pool));
        if (qdot_expr_is_class(session->pool, symbol, QDOT_PARAM))
            QDOT_TRY(qdot_declare_in_domain(session, symbol, value));
        QDOT_TRY(qdot_number_push_pair(&o->values, NULL, symbol, value));
    }
    QDOT_TRY(follow_events(session, o));
    QDOT_TRY(qdot_values_check_assumed(session));
    QDOT_TRY(order_start(session, o));
    o->request.n_values = o->values.symbols.n;
    o->request.symbols = o->values.symbols.at;
    o->request.values = o->values.values.at;
    o->request.q0 = o->q0.at;
    o->request.v0 = o->v0.at;
    o->request.q_named = o->q_named.at;
    o->request.v_named = o->v_named.at;
    o->request.exactly = session->start_exactly;
    return QDOT_OK;
}
