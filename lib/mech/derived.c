/* derived.c -- the cache of a scene and what every chapter uses. */
#include "mech/derived.h"

#include <stdio.h>

#include "expr/calculus.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "normal/simplify.h"

enum {
    TIDY_LIMIT = 400,  /* operations of a part; beyond, it is left as it is */
    WHOLE_LIMIT = 100, /* of a sum of simplified parts */
    PATTERNS = 64,
    PATTERN_ATOMS = 16
};

static void
derived_clear(qdot_derived *d)
{
    qdot_kinematics_clear(&d->kinematics);
    qdot_free(d->square_spring);
    qdot_free(d->square_damper);
    qdot_free(d->M);
    qdot_free(d->b);
    qdot_free(d->slopes.at);
    qdot_free(d->momentum);
    qdot_free(d->force);
    qdot_free(d->rest);
    qdot_free(d->left);
    qdot_free(d->equation);
    qdot_free(d->accel);
    qdot_free(d->independent);
    qdot_free(d->patterns.at);
}

void
qdot_derived_free(qdot_derived *d)
{
    if (!d)
        return;
    derived_clear(d);
    qdot_free(d->relations.at);
    qdot_free(d);
}

qdot_derived *
qdot_derived_get(qdot_scene *s)
{
    qdot_derived *d = s->derived;

    if (d->version != s->version) {
        derived_clear(d);
        *d = (qdot_derived){.relations.at = d->relations.at,
                            .relations.n = d->relations.n,
                            .relations.capacity = d->relations.capacity};
        d->version = s->version;
        d->n = s->coordinates.n;
    }
    return d;
}

bool
qdot_derived_array(qdot_scene *s, qdot_expr **array, size_t n)
{
    if (*array)
        return true;
    *array = qdot_calloc(n ? n : 1, sizeof **array);
    if (*array)
        return true;
    qdot_pool_fail(s->pool);
    return false;
}

bool
qdot_derived_index(qdot_scene *s, qdot_expr q, size_t *i)
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

/* A stand-in that tells of its symbol what simplification may ask: class and sign. Nil where
 * there is more to know (a domain). */
static qdot_expr
stand_in(qdot_scene *s, qdot_expr atom, uint32_t k)
{
    const qdot_symbol *x = qdot_expr_symbol(s->pool, atom);
    bool positive, bounded;
    qdot_expr e;
    char name[48];

    if (!x || x->class == QDOT_CONST)
        return x ? atom : QDOT_NIL;
    positive = x->sign == QDOT_POS;
    bounded = x->lo != QDOT_NIL || x->hi != QDOT_NIL;
    if (bounded && !(positive && x->lo == QDOT_ZERO && x->hi == QDOT_NIL))
        return QDOT_NIL;
    if (x->sign && !positive)
        return QDOT_NIL;
    snprintf(name, sizeof name, "alike[%d,%d,%u]", (int)x->class, positive, k);
    e = qdot_symbol_get(s->pool, QDOT_FORMAL, name);
    if (e != QDOT_NIL && positive && qdot_expr_symbol(s->pool, e)->lo == QDOT_NIL)
        qdot_symbol_domain(s->pool, e, QDOT_ZERO, true, QDOT_NIL, false);
    return e;
}

/* e with stand-ins for its atoms; nil where it has none. */
static qdot_expr
pattern_of(qdot_scene *s, qdot_expr e, qdot_expr *atoms)
{
    qdot_pool *pool = s->pool;
    qdot_expr from[PATTERN_ATOMS], to[PATTERN_ATOMS];
    uint32_t n;

    if (s->derived->relations.n || s->conditions.n ||
        qdot_mech_holds(s, e) & QDOT_HAS_UFUN)
        return QDOT_NIL;
    *atoms = qdot_expr_atoms(pool, e, false);
    n = *atoms == QDOT_NIL ? 0 : qdot_expr_count(pool, *atoms);
    if (n == 0 || n > PATTERN_ATOMS)
        return QDOT_NIL;
    for (uint32_t k = 0; k < n; k++) {
        from[k] = qdot_expr_arg(pool, *atoms, k);
        to[k] = stand_in(s, from[k], k);
        if (to[k] == QDOT_NIL)
            return QDOT_NIL;
    }
    return qdot_subs(pool, e, n, from, to);
}

qdot_expr
qdot_mech_alike(qdot_scene *s, qdot_expr e)
{
    qdot_pool *pool = s->pool;
    qdot_derived *d = s->derived;
    qdot_expr atoms = QDOT_NIL, pattern;
    qdot_pattern new;

    if (e == QDOT_NIL || qdot_expr_kind(pool, e) < QDOT_SUM ||
        qdot_expr_kind(pool, e) > QDOT_PROD || qdot_simplify_is_done(pool, e))
        return qdot_mech_tidy(s, e);
    pattern = pattern_of(s, e, &atoms);
    if (pattern == QDOT_NIL)
        return qdot_mech_tidy(s, e);
    for (size_t i = 0; i < d->patterns.n; i++) {
        qdot_expr from[PATTERN_ATOMS], to[PATTERN_ATOMS];
        uint32_t n = qdot_expr_count(pool, atoms);

        if (d->patterns.at[i].pattern != pattern ||
            qdot_expr_count(pool, d->patterns.at[i].atoms) != n)
            continue;
        for (uint32_t k = 0; k < n; k++) {
            from[k] = qdot_expr_arg(pool, d->patterns.at[i].atoms, k);
            to[k] = qdot_expr_arg(pool, atoms, k);
        }
        return qdot_subs(pool, d->patterns.at[i].simple, n, from, to);
    }
    new = (qdot_pattern){pattern, atoms, qdot_mech_tidy(s, e)};
    if (new.simple != QDOT_NIL &&
        d->patterns.n < PATTERNS && qdot_vec_push(&d->patterns, new) != QDOT_OK)
        return qdot_pool_fail(pool);
    return new.simple;
}

qdot_expr
qdot_mech_jet(qdot_scene *s, size_t i, uint32_t order)
{
    return qdot_symbol_jet(s->pool, s->coordinates.at[i], order);
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
    qdot_fail(QDOT_EINVAL, "the scene states its Lagrangian: %s is not known apart",
              what);
    qdot_hint("L and energy are; or declare particles instead of `lagrangian`");
    qdot_pool_fail(s->pool);
    return false;
}
