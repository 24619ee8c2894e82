/* set.c -- the statement `set`: values of parameters and functions; readers of values for other statements. */
#include "lang/commands/set.h"

#include <string.h>

#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/commands/loop-index.h"
#include "lang/commands/value-check.h"
#include "lang/language/read.h"
#include "lang/session/bind.h"
#include "lang/session/evaluation.h"
#include "lang/session/measured.h"
#include "lang/session/phase.h"
#include "lang/session/speeds.h"
#include "lang/session/start-kind.h"
#include "lang/session/units.h"
#include "lang/session/values.h"
#include "mech/scene/things.h"

static qdot_status set_values(qdot_record *r);

QDOT_STATEMENT(set) = {
    .word = "set",
    .group = QDOT_NUMBERS,
    .usage = "set NAME = VALUE, F(ARGUMENTS) = EXPR, ...",
    .summary = "values of parameters and of declared functions, for numbers",
    .example = "set m = 1, L = 1",
    .handler = set_values,
};

qdot_status
qdot_set_unknown(const qdot_session *session, const char *what, const char *name)
{
    const char *near = qdot_names_nearest(session->names, name, 0, NULL);

    (void)qdot_fail(QDOT_ENAME, "there is no %s `%s`", what, name);
    return near != NULL ? qdot_hint("did you mean `%s`?", near)
                        : qdot_hint("param %s declares it", name);
}

/* --- the statement `set` ------------------------------------------------------------ */

bool
qdot_set_is_momentum(const qdot_session *session, const qdot_filled *part)
{
    return qdot_filled_is_member(part, "p") && !qdot_names_is_family(session->names, "p");
}

/* Find the parameter of that name; `start` is the token at which an error is shown. */
static qdot_status
find_parameter(qdot_cursor *c, const qdot_token *start, const char *name, qdot_expr *symbol)
{
    const qdot_name *known = qdot_names_find(c->session->names, name);

    if (known != NULL && known->kind == QDOT_NAME_PARAM) {
        *symbol = known->value;
        return QDOT_OK;
    }
    c->error_at = start->start;
    if (known == NULL)
        return qdot_set_unknown(c->session, "parameter", name);
    (void)qdot_fail(QDOT_ENAME, "`%s` is not a parameter", name);
    return known->kind == QDOT_NAME_COORD  ? qdot_hint("start %s = ...", name)
           : known->kind == QDOT_NAME_UFUN ? qdot_hint("set %s(...) = ...", name)
           : known->kind == QDOT_NAME_SPEED
               ? qdot_hint("start %s = ... gives its value, which may hold a parameter", name)
                                           : qdot_hint("%s = ... names it anew", name);
}

/* Find the momentum symbol p[q] that a part of the statement names. */
static qdot_status
find_momentum(qdot_record *r, const qdot_filled *part, qdot_expr *symbol)
{
    qdot_pool *pool = r->cursor.session->pool;
    const qdot_token *index = r->compiled.at[part->first].from;
    const char *name;
    qdot_expr q;

    QDOT_TRY(qdot_record_bare_name(r, part, 0, &name));
    if (name == NULL)
        return qdot_record_expected(r, index, "a coordinate");
    QDOT_TRY(qdot_read_jet_of(&r->cursor, index, name, 0, &q));
    if (part->n > 1)
        return qdot_record_expected(r, r->compiled.at[part->first].to, "`]`");
    *symbol = qdot_symbol_of(pool, QDOT_MOMENTUM, q);
    return qdot_pool_check(pool);
}

qdot_status
qdot_set_find_parameter(qdot_record *r, const qdot_filled *part, qdot_expr *symbol)
{
    const char *name;

    if (qdot_set_is_momentum(r->cursor.session, part)) {
        QDOT_TRY(find_momentum(r, part, symbol));
    } else {
        QDOT_TRY(qdot_record_name(r, part, &name));
        QDOT_TRY(find_parameter(&r->cursor, part->from, name, symbol));
    }
    return qdot_record_no_prime(r, part, "`=`");
}

static const uint32_t motion = QDOT_HAS_COORD | QDOT_HAS_VELOCITY |
                               QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER |
                               QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA;

/* A value that depended on the motion behind the back of its arguments would be missing
 * from every derivative. */
static qdot_status
check_function_value(qdot_pool *pool, qdot_expr formals, qdot_expr body)
{
    uint32_t own = 0;

    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, formals); i++)
        own |= qdot_expr_node(pool, qdot_expr_arg(pool, formals, i))->holds;
    if (!(qdot_expr_node(pool, body)->holds & (motion | QDOT_HAS_TIME) & ~own))
        return QDOT_OK;
    (void)qdot_fail(QDOT_ETYPE,
                    "the value of a function may contain only its arguments and parameters");
    return qdot_hint("declare it with what it depends on, as in function f(x, t)");
}

/* Express a function's body in the declared arguments: x(s, t) as the symbol, s, t in place of the
 * names used. */
static qdot_status
rename_function_arguments(qdot_pool *pool, uint32_t id, qdot_expr formals, qdot_expr *symbol,
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

/* Read F(u, v) = BODY, the value of a declared function F. */
static qdot_status
set_read_function(qdot_record *r, const qdot_filled *part, qdot_expr *symbol, qdot_expr *body)
{
    qdot_session *session = r->cursor.session;
    const char *name = part->name->text;
    const qdot_name *known = qdot_names_find(session->names, name);
    qdot_formals f = {0};
    qdot_status status;

    qdot_record_blame(r, part);
    if (known == NULL || known->kind != QDOT_NAME_UFUN) {
        (void)qdot_fail(QDOT_ENAME, "`%s` is not an undefined function", name);
        return qdot_hint(
            "%s(...) = ... defines a function; `function` declares an undefined one", name);
    }
    if (known->body != NULL) {
        (void)qdot_fail(QDOT_EINVAL, "`%s` has its values from a table, since %s:%u", name, known->file, known->line);
        return qdot_hint("another name: `function f(x)`, then `set f(x) = ...`");
    }
    status = qdot_record_formals(r, part, &f);
    if (status == QDOT_OK && f.n != qdot_ufun_get(session->pool, known->ufun)->arity)
        status = qdot_fail(QDOT_ETYPE, "`%s` has %u arguments, not %zu", name,
                           qdot_ufun_get(session->pool, known->ufun)->arity, f.n);
    if (status == QDOT_OK)
        status = qdot_record_body(r, qdot_record_next(r, part, "EXPR"), &f, body);
    qdot_formals_leave(session, &f);
    QDOT_TRY(status);
    qdot_record_blame(r, part);
    QDOT_TRY(check_function_value(session->pool, f.list, *body));
    /* express the value, given in the function's arguments of this statement, in those of its declaration */
    return rename_function_arguments(session->pool, known->ufun, f.list, symbol, body);
}

qdot_status
qdot_set_keep_measured(qdot_session *session, qdot_expr *value)
{
    const bool measured = qdot_measured_occurs(session, *value);
    qdot_measured m = {0};

    if (measured && qdot_expr_is_scalar(session->pool, *value) &&
        qdot_session_number(session, *value, &m.value, &m.error) == QDOT_OK) {
        m.exact = qdot_measured_as_rationals(session, *value);
        if (qdot_measured_add(session, m) == QDOT_NIL)
            return qdot_pool_check(session->pool);
    }
    *value = qdot_measured_as_rationals(session, *value);
    return qdot_pool_check(session->pool);
}

/* Check that the value read at `start` depends on parameters only. */
static qdot_status
check_constant(qdot_cursor *c, const qdot_token *start, qdot_expr *value)
{
    QDOT_TRY(qdot_set_keep_measured(c->session, value));
    if (qdot_expr_node(c->session->pool, *value)->holds & (motion | QDOT_HAS_TIME)) {
        c->error_at = start->start;
        return qdot_fail(QDOT_ETYPE,
                         "a value may contain only parameters: no coordinate, no time");
    }
    return QDOT_OK;
}

qdot_status
qdot_set_check_dimension(qdot_record *r, const qdot_filled *part, qdot_expr symbol, qdot_expr value)
{
    qdot_session *session = r->cursor.session;
    qdot_text format = {0};
    qdot_status status;

    if (!qdot_units_on(session))
        return QDOT_OK;
    r->cursor.error_at = part->from->start;
    if (qdot_expr_is_constant(session->pool, value) && value != QDOT_ZERO && qdot_units_is_scaled(session, symbol)) {
        (void)qdot_fail(QDOT_EINVAL, "a number without a unit for %.100s, which was declared in one that is not SI",
                        qdot_expr_symbol(session->pool, symbol)->name);
        return qdot_hint("with its unit, as in 50 [cm], 30 [deg]");
    }
    if (qdot_expr_is_constant(session->pool, value))
        return QDOT_OK;
    qdot_text_format(&format, "%.100s is %%s, the value %%s", qdot_expr_symbol(session->pool, symbol)->name);
    status = qdot_text_status(&format);
    if (status == QDOT_OK)
        status = qdot_units_join(session, symbol, value, format.at);
    qdot_text_clear(&format);
    return status;
}

qdot_status
qdot_set_find_constant(qdot_record *r, const qdot_filled *part, qdot_expr symbol, qdot_expr *value)
{
    QDOT_TRY(qdot_record_scalar(r, part, value));
    QDOT_TRY(check_constant(&r->cursor, part->from, value));
    return qdot_set_check_dimension(r, part, symbol, *value);
}

/* Read the value of a parameter; that of an input may hold the time, coordinates and velocities. */
static qdot_status
set_read_value(qdot_record *r, const qdot_filled *part, qdot_expr symbol, qdot_expr *value)
{
    qdot_session *session = r->cursor.session;

    for (size_t i = 0; i < session->scene->inputs.n; i++)
        if (session->scene->inputs.at[i] == symbol) {
            QDOT_TRY(qdot_record_scalar(r, part, value));
            QDOT_TRY(qdot_set_keep_measured(session, value));
            if (!(qdot_expr_node(session->pool, *value)->holds & QDOT_HAS_ACCELERATION))
                return qdot_set_check_dimension(r, part, symbol, *value);
            qdot_record_blame(r, part);
            return qdot_fail(QDOT_ETYPE, "an input depends on t, coordinates and velocities, not on accelerations");
        }
    return qdot_set_find_constant(r, part, symbol, value);
}

/* Read NAME = VALUE, F(u, v) = EXPR, ... into the list. */
static qdot_status
set_read(qdot_record *r, qdot_pairs *list)
{
    for (size_t i = 1; i < r->parts.n; i++) {
        const qdot_filled *part = &r->parts.at[i];
        qdot_expr symbol = QDOT_NIL, value = QDOT_NIL;

        if (part->name == NULL)
            continue;
        if (qdot_filled_is(part, "NAME")) {
            QDOT_TRY(qdot_set_find_parameter(r, part, &symbol));
            QDOT_TRY(set_read_value(r, qdot_record_next(r, part, "VALUE"), symbol, &value));
        } else {
            QDOT_TRY(set_read_function(r, part, &symbol, &value));
        }
        QDOT_TRY(qdot_pairs_push(list, part->from, symbol, value));
    }
    return QDOT_OK;
}

static qdot_status
set_values(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_pairs list = {0};
    qdot_status status = set_read(r, &list);

    for (size_t i = 0; i < list.symbols.n && status == QDOT_OK; i++) {
        if (!qdot_expr_is_class(session->pool, list.symbols.at[i], QDOT_PARAM))
            continue;
        r->cursor.error_at = list.places.at[i]->start;
        status = qdot_session_in_domain(session, list.symbols.at[i], list.values.at[i]);
    }
    if (status == QDOT_OK)
        status = qdot_value_check(&r->cursor, &list);
    for (size_t i = 0; i < list.symbols.n && status == QDOT_OK; i++)
        qdot_session_set(session, list.symbols.at[i], list.values.at[i], &status);
    qdot_pairs_free(&list);
    return status;
}

/* --- coordinates and velocities ---------------------------------------------------- */

static qdot_status
check_is_position_or_velocity(qdot_cursor *c, const qdot_token *start, qdot_expr jet)
{
    if (qdot_expr_symbol(c->session->pool, jet)->order <= 1)
        return QDOT_OK;
    c->error_at = start->start;
    return qdot_fail(QDOT_EINVAL, "a start names coordinates and velocities");
}

/* Fail if q is a first-order state, which starts with its value alone. */
static qdot_status
refuse_rate_or_momentum(qdot_record *r, const qdot_filled *name, qdot_expr q, const char *why)
{
    const qdot_scene *scene = r->cursor.session->scene;

    if (qdot_scene_state_of(scene, q) == NULL)
        return QDOT_OK;
    qdot_record_blame(r, name);
    (void)qdot_fail(QDOT_EINVAL, "`%s` is a state: %s", qdot_expr_symbol(scene->pool, q)->name, why);
    return qdot_hint("%s = ... gives its value", qdot_expr_symbol(scene->pool, q)->name);
}

qdot_status
qdot_set_find_jet(qdot_record *r, const qdot_filled *name, qdot_expr *jet)
{
    const qdot_session *session = r->cursor.session;
    const qdot_scene *scene = session->scene;

    if (qdot_set_is_momentum(session, name)) {
        QDOT_TRY(find_momentum(r, name, jet));
        QDOT_TRY(refuse_rate_or_momentum(r, name, qdot_expr_symbol(scene->pool, *jet)->base, "it has no momentum"));
        if (qdot_phase_has(session))
            *jet = qdot_phase_space_coordinate(scene, qdot_expr_symbol(scene->pool, *jet)->base);
        QDOT_TRY(qdot_pool_check(scene->pool));
        return qdot_record_no_prime(r, name, "`=`");
    }
    QDOT_TRY(qdot_record_coordinate(r, name, jet));
    if (qdot_phase_has(session) && qdot_expr_symbol(scene->pool, *jet)->order == 1) {
        const char *q = qdot_expr_symbol(scene->pool, qdot_expr_symbol(scene->pool, *jet)->base)->name;

        qdot_record_blame(r, name);
        (void)qdot_fail(QDOT_EINVAL, "%s' follows from the momenta: this scene has an H, and no Lagrangian", q);
        return qdot_hint("p[%s] = ... gives the momentum", q);
    }
    if (qdot_expr_symbol(scene->pool, *jet)->order == 1)
        QDOT_TRY(refuse_rate_or_momentum(r, name, qdot_expr_symbol(scene->pool, *jet)->base, "its rate follows from its equation"));
    return check_is_position_or_velocity(&r->cursor, name->from, *jet);
}

bool
qdot_set_is_read(const qdot_record *r, const qdot_filled *part, qdot_expr symbol)
{
    const qdot_session *session = r->cursor.session;
    const char *name = qdot_expr_symbol(session->pool, symbol)->name;

    return qdot_expr_is_class(session->pool, symbol, QDOT_MOMENTUM) || qdot_session_is_speed(session, symbol) ||
           qdot_record_mentions_besides(r, part, name) || qdot_loop_index_is_read(session, symbol);
}

qdot_status
qdot_set_need_read(qdot_record *r, const qdot_filled *part, qdot_expr symbol)
{
    const char *name = qdot_expr_symbol(r->cursor.session->pool, symbol)->name;

    if (qdot_set_is_read(r, part, symbol))
        return QDOT_OK;
    qdot_record_blame(r, part);
    (void)qdot_fail(QDOT_EINVAL, "nothing in the run depends on %.100s", name);
    return qdot_hint("leave it out, or declare what depends on it");
}

qdot_status
qdot_set_find_speed(qdot_record *r, const qdot_filled *part, qdot_expr *speed)
{
    const qdot_name *known;
    const char *name;

    *speed = QDOT_NIL;
    QDOT_TRY(qdot_record_name(r, part, &name));
    known = qdot_names_find(r->cursor.session->names, name);
    if (known == NULL || known->kind != QDOT_NAME_SPEED)
        return QDOT_OK;
    *speed = known->value;
    return qdot_record_no_prime(r, part, "`=`");
}

qdot_status
qdot_set_find_symbol(qdot_record *r, const qdot_filled *part, qdot_expr *symbol)
{
    const qdot_session *session = r->cursor.session;
    const qdot_name *known;
    const char *name;

    if (qdot_set_is_momentum(session, part)) {
        QDOT_TRY(qdot_set_find_jet(r, part, symbol));
    } else {
        QDOT_TRY(qdot_set_find_speed(r, part, symbol));
        QDOT_TRY(qdot_record_name(r, part, &name));
        known = qdot_names_find(session->names, name);
        if (*symbol == QDOT_NIL && (known == NULL || known->kind != QDOT_NAME_COORD))
            return qdot_set_find_parameter(r, part, symbol);
        if (*symbol == QDOT_NIL)
            QDOT_TRY(qdot_set_find_jet(r, part, symbol));
    }
    qdot_record_blame(r, part);
    return qdot_session_goes_with_start(session, *symbol);
}
