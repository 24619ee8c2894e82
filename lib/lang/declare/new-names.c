/* new-names.c -- reads the names that a statement declares, each with its domain. */
#include "lang/declare/new-names.h"

#include <string.h>

#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/unit.h"
#include "lang/commands/set.h"
#include "lang/declare/declare.h"
#include "lang/session/evaluation.h"
#include "lang/session/units.h"
#include "lang/syntax/holes.h"
#include "mech/scene/scene.h"

/* --- reading new names -------------------------------------------------------------- */

/* The kinds of symbols that the bounds of a domain may not contain. */
#define MOVING                                                                           \
    (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MOMENTUM |    \
     QDOT_HAS_MULTIPLIER | QDOT_HAS_DIFFERENTIAL | QDOT_HAS_DELTA | QDOT_HAS_TIME)

/* Store the bound: x < b sets the upper end of the domain, x > b the lower one. */
static qdot_status
store_bound(qdot_cursor *c, qdot_new_name *x, const qdot_bound *b)
{
    const qdot_pool *pool = c->session->pool;

    c->error_at = b->at->start;
    if (!qdot_expr_is_scalar(pool, b->value) || (qdot_expr_node(pool, b->value)->holds & MOVING))
        return qdot_fail(QDOT_ETYPE,
                         "a bound is a number or an expression of parameters");
    x->own = true;
    if (qdot_infinite(pool, b->value) == (b->upper ? 1 : -1)) /* 0 < r < infinity: no bound */
        return QDOT_OK;
    QDOT_TRY(qdot_infinity_refuse(pool, b->value));
    if ((b->upper ? x->hi : x->lo) != QDOT_NIL)
        return qdot_fail(QDOT_EINVAL, "`%s` has two %s bounds", x->name,
                         b->upper ? "upper" : "lower");
    *(b->upper ? &x->hi : &x->lo) = b->value;
    *(b->upper ? &x->hi_open : &x->lo_open) = b->strict;
    return QDOT_OK;
}

/* Read a name to be declared, at `part`, and the value that may follow it. */
static qdot_status
read_new_name(qdot_record *r, const qdot_filled *part, qdot_new_name *x)
{
    const qdot_filled *value = part + 2; /* the value is the part after `=` */
    qdot_session *session = r->cursor.session;
    qdot_bound bound;
    qdot_status status;
    bool more = true;

    *x = (qdot_new_name){.start = part->name};
    QDOT_TRY(qdot_record_name(r, part, &x->name));
    for (size_t k = 0; more; k++) {
        QDOT_TRY(qdot_record_bound(r, part, k, &bound, &more));
        if (more)
            QDOT_TRY(store_bound(&r->cursor, x, &bound));
    }
    if (value >= r->parts.at + r->parts.n || !qdot_filled_is(value, "VALUE"))
        return qdot_record_unit(r, part, NULL, &x->unit, &x->angle);
    QDOT_TRY(qdot_record_unit(r, part, value, &x->unit, &x->angle));
    session->evaluation->declares = false; /* read numbers as `set` does: results of runs keep their errors */
    status = qdot_record_scalar(r, value, &x->value);
    session->evaluation->declares = true;
    return status == QDOT_OK ? qdot_set_keep_measured(session, &x->value) : status;
}

/* Apply the sign after the last name of a list also to the bare names before it: `param m, L > 0`. */
static void
apply_sign_to_bare_names(qdot_new_names *list)
{
    const qdot_new_name *last = &list->at[list->n - 1];

    if (!last->own || (last->lo != QDOT_NIL && last->hi != QDOT_NIL))
        return;
    for (size_t i = list->n - 1; i-- > 0;) {
        qdot_new_name *x = &list->at[i];

        if (x->own || x->value != QDOT_NIL)
            continue;
        x->lo = last->lo;
        x->hi = last->hi;
        x->lo_open = last->lo_open;
        x->hi_open = last->hi_open;
        x->own = true;
    }
}

/* A unit after the last name of a list of parameters is also that of the bare names before it: `param m1, m2 > 0 [kg]`. */
static void
apply_unit_to_bare_names(qdot_new_names *list)
{
    const qdot_new_name *last = &list->at[list->n - 1];

    for (size_t i = list->n - 1; i-- > 0 && last->unit != QDOT_NIL && last->value == QDOT_NIL;) {
        qdot_new_name *x = &list->at[i];

        if (x->unit != QDOT_NIL || x->value != QDOT_NIL)
            break;
        x->unit = last->unit;
        x->angle = last->angle;
    }
}

/* The dimension of a declared name is that of its unit, its bounds and its value; a bare number is in SI units. */
static qdot_status
declare_dimension(qdot_cursor *c, const qdot_new_name *x, qdot_expr symbol)
{
    const qdot_expr same[] = {x->unit, x->lo, x->hi, x->value};
    qdot_session *session = c->session;

    if (!qdot_units_on(session))
        return QDOT_OK;
    c->error_at = x->start->start;
    for (size_t i = 0; i < sizeof same / sizeof *same; i++)
        if (same[i] != QDOT_NIL && !qdot_expr_is_constant(session->pool, same[i]))
            QDOT_TRY(qdot_units_join(session, symbol, same[i], "the name is %s, its bound or value %s"));
    if (x->unit != QDOT_NIL && qdot_expr_is_constant(session->pool, x->unit))
        QDOT_TRY(qdot_units_fix(session, symbol, qdot_dimension_none(), "the name is %s, its unit that of %s"));
    if (x->angle)
        QDOT_TRY(qdot_units_angle(session, symbol));
    return x->unit != QDOT_NIL && qdot_expr_in_si(session->pool, x->unit) != QDOT_ONE ? qdot_units_scaled(session, symbol)
                                                                                    : QDOT_OK;
}

/* Make a parameter known while the rest of its list is read: `param a = 2, b = a^2`. */
static qdot_status
make_name_known(qdot_session *session, const qdot_new_name *x, size_t *shown)
{
    qdot_expr symbol;

    if (qdot_names_find(session->names, x->name) != NULL)
        return QDOT_OK;
    symbol = qdot_symbol_get(session->pool, QDOT_PARAM, x->name);
    QDOT_TRY(qdot_pool_check(session->pool));
    QDOT_TRY(qdot_names_push(session->names, x->name, symbol));
    ++*shown;
    return QDOT_OK;
}

qdot_status
qdot_new_names_read(qdot_record *r, bool params, qdot_new_names *list)
{
    qdot_session *session = r->cursor.session;
    qdot_status status = QDOT_OK;
    size_t shown = 0;

    for (size_t i = 1; i < r->parts.n && status == QDOT_OK; i++) {
        const qdot_filled *part = &r->parts.at[i];
        qdot_new_name x;

        if (part->node->kind != QDOT_USAGE_HOLE || part->name == NULL)
            continue;
        status = read_new_name(r, part, &x);
        if (status == QDOT_OK)
            status = qdot_vec_push(list, x);
        if (status == QDOT_OK && params) {
            apply_sign_to_bare_names(list);
            apply_unit_to_bare_names(list);
        }
        if (status == QDOT_OK)
            r->cursor.error_at = x.start->start;
        if (status == QDOT_OK && params)
            status = make_name_known(session, &x, &shown);
    }
    while (shown-- > 0)
        qdot_names_pop(session->names);
    return status;
}

/* --- declaring the names ------------------------------------------------------------ */

static bool
has_same_domain(const qdot_symbol *s, const qdot_new_name *x)
{
    return s->lo == x->lo && s->hi == x->hi &&
           (x->lo == QDOT_NIL || s->lo_open == x->lo_open) &&
           (x->hi == QDOT_NIL || s->hi_open == x->hi_open);
}

/* `coord t`: t is the time as always, also a coordinate of line elements that hold dt; t' is its derivative by the
 * parameter of a geodesic. The scene does not move along it. */
static qdot_status
declare_time(qdot_cursor *c, const qdot_new_name *x, qdot_name *entry)
{
    if (x->own) {
        qdot_fail(QDOT_EINVAL, "the time has no domain");
        return qdot_hint("assume t > 0");
    }
    entry->value = QDOT_T;
    return qdot_declare_name(c, x->start, NULL, entry);
}

/* Declare one name; *fresh: it was not declared before. */
static qdot_status
declare_new_name(qdot_cursor *c, qdot_name_kind kind, const qdot_new_name *x, bool *fresh)
{
    qdot_session *session = c->session;
    const qdot_name *old = qdot_names_find(session->names, x->name);
    qdot_class class = kind == QDOT_NAME_PARAM ? QDOT_PARAM : QDOT_COORD;
    qdot_name entry = {.name = (char *)x->name, .kind = kind};

    *fresh = false;
    c->error_at = x->start->start;
    if (kind == QDOT_NAME_COORD && strcmp(x->name, "t") == 0)
        return declare_time(c, x, &entry);
    entry.value = qdot_symbol_get(session->pool, class, x->name);
    QDOT_TRY(qdot_pool_check(session->pool));
    if (old != NULL && old->kind == QDOT_NAME_PARAM && kind == QDOT_NAME_PARAM) {
        if (x->own && !has_same_domain(qdot_expr_symbol(session->pool, old->value), x))
            return qdot_fail(QDOT_ENAME, "`%s` was declared with another domain at %s:%u",
                             x->name, old->file, old->line);
    } else {
        QDOT_TRY(qdot_declare_name(c, x->start, NULL, &entry));
        *fresh = true;
        if (x->own)
            qdot_symbol_domain(session->pool, entry.value, x->lo, x->lo_open, x->hi,
                               x->hi_open);
        else
            qdot_symbol_domain(session->pool, entry.value, QDOT_NIL, false, QDOT_NIL,
                               false);
        QDOT_TRY(qdot_declare_meet_functions(session, x->name, entry.value));
    }
    QDOT_TRY(declare_dimension(c, x, entry.value));
    if (kind == QDOT_NAME_COORD)
        return qdot_scene_coordinate(session->scene, entry.value);
    return QDOT_OK;
}

qdot_status
qdot_new_names_declare(qdot_cursor *c, qdot_name_kind kind, const qdot_new_names *list)
{
    qdot_vec(const char *) fresh = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < list->n && status == QDOT_OK; i++) {
        bool is_fresh;

        status = declare_new_name(c, kind, &list->at[i], &is_fresh);
        if (is_fresh && qdot_vec_push(&fresh, list->at[i].name) != QDOT_OK)
            status = QDOT_ENOMEM;
    }
    if (status != QDOT_OK && kind == QDOT_NAME_PARAM)
        while (fresh.n > 0)
            qdot_names_remove(c->session->names, fresh.at[--fresh.n]);
    qdot_free(fresh.at);
    return status;
}
