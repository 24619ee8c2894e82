/* access.c -- helper functions by which all files of mech read a scene. */
#include "mech/scene/access.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "normal/simplify/simplify.h"

enum {
    TIDY_LIMIT = 400,  /* a part of an expression with more operations than this is not simplified */
    WHOLE_LIMIT = 100  /* a sum of simplified parts with more operations than this is not simplified again */
};

bool
qdot_mech_index(qdot_scene *s, qdot_expr q, size_t *i)
{
    const qdot_symbol *symbol;

    for (*i = 0; *i < s->coordinates.n; ++*i)
        if (s->coordinates.at[*i] == q)
            return true;
    if (q == QDOT_NIL)
        return false;
    symbol = qdot_expr_symbol(s->pool, q);
    if (symbol)
        qdot_mech_fail(s, QDOT_ENAME, "%s is not a coordinate of the scene",
                       symbol->name);
    else
        qdot_mech_fail(s, QDOT_ETYPE, "a coordinate belongs here");
    return false;
}

uint32_t
qdot_mech_holds(const qdot_scene *s, qdot_expr e)
{
    return e == QDOT_NIL ? 0 : qdot_expr_node(s->pool, e)->holds;
}

uint32_t
qdot_mech_dimension(const qdot_pool *pool, qdot_expr r)
{
    if (r == QDOT_NIL)
        return 0;
    if (qdot_expr_is_scalar(pool, r))
        return 1;
    return qdot_expr_kind(pool, r) == QDOT_VEC ? qdot_expr_count(pool, r) : 0;
}

qdot_expr
qdot_mech_component(const qdot_pool *pool, qdot_expr r, uint32_t d)
{
    return qdot_expr_is_scalar(pool, r) ? r : qdot_expr_arg(pool, r, d);
}

qdot_expr
qdot_mech_dot(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    if (a == QDOT_NIL || b == QDOT_NIL)
        return QDOT_NIL;
    if (qdot_expr_is_scalar(pool, a) && qdot_expr_is_scalar(pool, b))
        return qdot_mul(pool, a, b);
    return qdot_dot(pool, a, b);
}

qdot_expr
qdot_mech_tidy(qdot_scene *s, qdot_expr e)
{
    qdot_facts facts = qdot_scene_facts(s);

    if (e == QDOT_NIL || qdot_expr_size(s->pool, e) > TIDY_LIMIT)
        return e;
    return qdot_simplify(s->pool, e, &facts);
}

qdot_expr
qdot_mech_tidy_whole(qdot_scene *s, qdot_expr e)
{
    if (e == QDOT_NIL || qdot_expr_size(s->pool, e) > WHOLE_LIMIT)
        return e;
    return qdot_mech_tidy(s, e);
}

qdot_expr
qdot_mech_jet(qdot_scene *s, size_t i, uint32_t order)
{
    return qdot_symbol_jet(s->pool, s->coordinates.at[i], order);
}

qdot_expr
qdot_mech_each(qdot_scene *s, size_t n, qdot_expr (*of)(qdot_scene *s, qdot_expr q))
{
    qdot_expr *members = qdot_calloc(n + 1, sizeof *members), list;

    if (!members)
        return qdot_pool_fail(s->pool);
    for (size_t i = 0; i < n; i++)
        members[i] = of(s, s->coordinates.at[i]);
    list = qdot_list(s->pool, (uint32_t)n, members);
    qdot_free(members);
    return list;
}

qdot_expr
qdot_mech_at_rest(qdot_scene *s, qdot_expr e)
{
    size_t n = s->coordinates.n;
    qdot_expr *from;

    if (e == QDOT_NIL || !(qdot_mech_holds(s, e) & QDOT_HAS_ACCELERATION))
        return e;
    from = qdot_calloc(2 * n + 1, sizeof *from);
    if (!from)
        return qdot_pool_fail(s->pool);
    for (size_t i = 0; i < n; i++) {
        from[i] = qdot_mech_jet(s, i, 2);
        from[n + i] = QDOT_ZERO;
    }
    e = qdot_subs(s->pool, e, n, from, from + n);
    qdot_free(from);
    return e;
}

bool
qdot_mech_stated(const qdot_scene *s)
{
    return s->lagrangian != QDOT_NIL;
}

bool
qdot_mech_needs_particles(qdot_scene *s, const char *what)
{
    if (!qdot_mech_stated(s))
        return true;
    qdot_fail(QDOT_EINVAL, "the scene states its %s: %s is not known apart",
              s->hamiltonian != QDOT_NIL ? "Hamiltonian" : "Lagrangian", what);
    qdot_hint("L and energy are; or declare particles instead of `%s`",
              s->hamiltonian != QDOT_NIL ? "hamiltonian" : "lagrangian");
    qdot_pool_fail(s->pool);
    return false;
}
