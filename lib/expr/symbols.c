/* symbols.c -- symbols: by their names, those that belong to a coordinate, what was declared of them. */
#include "expr/pool.h"

#include <string.h>

#include "base/text.h"

qdot_expr
qdot_symbol_get(qdot_pool *pool, qdot_class class, const char *name)
{
    return qdot_pool_make_symbol(pool, &(qdot_symbol){.class = class, .name = name});
}

void
qdot_symbol_hide(qdot_pool *pool, qdot_expr x)
{
    pool->symbols.at[NODE(pool, x)->at].hidden = true;
}

void
qdot_symbol_show(qdot_pool *pool, qdot_expr x)
{
    qdot_symbol *s = &pool->symbols.at[NODE(pool, x)->at];
    uint32_t hash;
    qdot_expr other;

    s->hidden = true;
    other = qdot_pool_find_symbol(pool, s, &hash);
    if (other != QDOT_NIL)
        qdot_symbol_hide(pool, other);
    s->hidden = false;
}

static bool
has_symbol(const qdot_pool *pool, qdot_class class, const char *name)
{
    uint32_t hash;

    return qdot_pool_find_symbol(pool, &(qdot_symbol){.class = class, .name = name}, &hash) != QDOT_NIL;
}

bool
qdot_symbol_is_declared(const qdot_pool *pool, const char *name)
{
    return has_symbol(pool, QDOT_PARAM, name) || has_symbol(pool, QDOT_COORD, name) ||
           has_symbol(pool, QDOT_MULTIPLIER, name);
}

bool
qdot_symbol_is_known(const qdot_pool *pool, const char *name)
{
    return qdot_symbol_is_declared(pool, name) || has_symbol(pool, QDOT_FORMAL, name);
}

/* Make a symbol that belongs to a coordinate: its name is the coordinate's name between `before` and `after`. */
static qdot_expr
make_coordinate_symbol(qdot_pool *pool, qdot_class class, qdot_expr coordinate, uint32_t order,
                       const char *before, const char *after)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, coordinate);
    qdot_symbol wanted = {
        .class = class, .base = coordinate, .order = order, .rank = s->rank};
    qdot_text name = {0};
    uint32_t hash;
    qdot_expr e = qdot_pool_find_symbol(pool, &wanted, &hash);

    if (e != QDOT_NIL)
        return qdot_pool_make_symbol(pool, &wanted);
    qdot_text_add(&name, before);
    qdot_text_add(&name, s->name);
    qdot_text_add(&name, after);
    for (uint32_t i = 0; i < order; i++)
        qdot_text_char(&name, '\'');
    if (qdot_text_status(&name) != QDOT_OK) {
        qdot_text_clear(&name);
        return qdot_pool_fail(pool);
    }
    wanted.name = qdot_text_str(&name);
    e = qdot_pool_make_symbol(pool, &wanted);
    qdot_text_clear(&name);
    return e;
}

/* t has derivatives too: as a coordinate of a line element, by the parameter of a curve. */
qdot_expr
qdot_symbol_jet(qdot_pool *pool, qdot_expr coordinate, uint32_t order)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, coordinate);

    if (coordinate == QDOT_NIL)
        return QDOT_NIL;
    if (s == NULL || (s->class != QDOT_COORD && s->class != QDOT_MOMENTUM && s->class != QDOT_TIME))
        return qdot_pool_refuse(pool, QDOT_ETYPE, "only a coordinate has a velocity");
    order += s->order;
    if (s->class == QDOT_MOMENTUM)
        return make_coordinate_symbol(pool, QDOT_MOMENTUM, s->base, order, "p[", "]");
    if (s->order > 0)
        coordinate = s->base;
    return order == 0 ? coordinate
                      : make_coordinate_symbol(pool, QDOT_COORD, coordinate, order, "", "");
}

/* Whether the LIST holds coordinates and t only, at least one. */
static bool
is_list_of_coordinates(const qdot_pool *pool, qdot_expr list)
{
    for (uint32_t i = 0; i < NODE(pool, list)->n; i++)
        if (ARGS(pool, list)[i] != QDOT_T && !qdot_expr_is_coordinate(pool, ARGS(pool, list)[i]))
            return false;
    return NODE(pool, list)->n > 0;
}

/* The product wedge(dr, dphi) of the differentials of a LIST of coordinates. */
static qdot_expr
make_wedge_symbol(qdot_pool *pool, qdot_expr list)
{
    qdot_symbol wanted = {.class = QDOT_DIFFERENTIAL, .base = list};
    qdot_text name = {0};
    qdot_expr e;

    if (!is_list_of_coordinates(pool, list))
        return qdot_pool_refuse(pool, QDOT_ETYPE, "a list of coordinates is needed here");
    wanted.rank = qdot_expr_symbol(pool, ARGS(pool, list)[0])->rank;
    for (uint32_t i = 0; i < NODE(pool, list)->n; i++)
        qdot_text_format(&name, i == 0 ? "wedge(d%s" : ", d%s", qdot_expr_symbol(pool, ARGS(pool, list)[i])->name);
    qdot_text_char(&name, ')');
    wanted.name = qdot_text_str(&name);
    e = qdot_text_status(&name) == QDOT_OK ? qdot_pool_make_symbol(pool, &wanted) : qdot_pool_fail(pool);
    qdot_text_clear(&name);
    return e;
}

qdot_expr
qdot_symbol_of(qdot_pool *pool, qdot_class class, qdot_expr coordinate)
{
    bool known = qdot_expr_is_coordinate(pool, coordinate) ||
                 (coordinate == QDOT_T && class == QDOT_DIFFERENTIAL) ||
                 (class == QDOT_MOMENTUM && qdot_expr_is_class(pool, coordinate, QDOT_COORD));

    if (coordinate == QDOT_NIL)
        return QDOT_NIL;
    if (class == QDOT_DIFFERENTIAL && NODE(pool, coordinate)->kind == QDOT_LIST)
        return make_wedge_symbol(pool, coordinate);
    if (!known)
        return qdot_pool_refuse(pool, QDOT_ETYPE, "a coordinate is needed here");
    if (class == QDOT_DIFFERENTIAL)
        return make_coordinate_symbol(pool, class, coordinate, 0, "d", "");
    return make_coordinate_symbol(pool, class, coordinate, 0,
                                  class == QDOT_MOMENTUM ? "p[" : "delta[", "]");
}

void
qdot_symbol_domain(qdot_pool *pool, qdot_expr x, qdot_expr lo, bool lo_open, qdot_expr hi,
                   bool hi_open)
{
    qdot_symbol *s;
    uint8_t sign = 0;

    if (x == QDOT_NIL || NODE(pool, x)->kind != QDOT_SYM)
        return;
    s = &pool->symbols.at[NODE(pool, x)->at];
    pool->domains += s->lo != lo || s->hi != hi || s->lo_open != lo_open || s->hi_open != hi_open;
    s->lo = lo;
    s->hi = hi;
    s->lo_open = lo_open;
    s->hi_open = hi_open;
    if (lo != QDOT_NIL && (NODE(pool, lo)->sign & QDOT_GE0))
        sign |= QDOT_GE0 | (lo_open || (NODE(pool, lo)->sign & QDOT_NE0) ? QDOT_NE0 : 0);
    if (hi != QDOT_NIL && (NODE(pool, hi)->sign & QDOT_LE0))
        sign |= QDOT_LE0 | (hi_open || (NODE(pool, hi)->sign & QDOT_NE0) ? QDOT_NE0 : 0);
    s->sign = sign;
    NODE(pool, x)->sign = sign;
}

const qdot_symbol *
qdot_expr_symbol(const qdot_pool *pool, qdot_expr e)
{
    return e != QDOT_NIL && NODE(pool, e)->kind == QDOT_SYM
               ? &pool->symbols.at[NODE(pool, e)->at]
               : NULL;
}

bool
qdot_expr_is_class(const qdot_pool *pool, qdot_expr e, qdot_class class)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, e);

    return s != NULL && s->class == class;
}

bool
qdot_expr_is_constant(const qdot_pool *pool, qdot_expr e)
{
    return (qdot_expr_node(pool, e)->holds & ~(QDOT_HAS_FUN | 1u << QDOT_CONST)) == 0;
}

bool
qdot_expr_is_coordinate(const qdot_pool *pool, qdot_expr e)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, e);

    return s != NULL && s->class == QDOT_COORD && s->order == 0;
}
