/* phase-symbols.c -- p[q] as a momentum, and as a coordinate of phase space. */
#include "mech/hamilton/phase-symbols.h"

#include <string.h>

#include "expr/calculus.h"
#include "expr/symbol.h"

bool
qdot_phase_space_needed(const qdot_scene *s)
{
    return s->hamiltonian != QDOT_NIL && s->lagrangian == QDOT_NIL;
}

qdot_expr
qdot_phase_space_coordinate(const qdot_scene *s, qdot_expr q)
{
    const qdot_expr p = qdot_symbol_of(s->pool, QDOT_MOMENTUM, q);

    return p == QDOT_NIL ? p : qdot_symbol_get(s->pool, QDOT_COORD, qdot_expr_symbol(s->pool, p)->name);
}

qdot_expr
qdot_phase_space_momentum(const qdot_scene *s, qdot_expr coordinate)
{
    const qdot_symbol *symbol = qdot_expr_symbol(s->pool, coordinate);

    if (symbol == NULL || symbol->class != QDOT_COORD || strncmp(symbol->name, "p[", 2) != 0)
        return QDOT_NIL;
    for (size_t i = 0; i < s->coordinates.n; i++)
        if (coordinate == qdot_phase_space_coordinate(s, s->coordinates.at[i]))
            return qdot_symbol_of(s->pool, QDOT_MOMENTUM, s->coordinates.at[i]);
    return QDOT_NIL;
}

/* e with the symbols p[q], p[q]' replaced by the coordinates of phase space and their rates (inward), or these by those. */
static qdot_expr
exchange_momenta(const qdot_scene *s, qdot_expr e, bool inward)
{
    qdot_pool *pool = s->pool;

    for (size_t i = 0; i < s->coordinates.n && e != QDOT_NIL; i++) {
        const qdot_expr q = s->coordinates.at[i], p = qdot_symbol_of(pool, QDOT_MOMENTUM, q), P = qdot_phase_space_coordinate(s, q);
        const qdot_expr momentum[] = {p, qdot_symbol_jet(pool, p, 1)}, coordinate[] = {P, qdot_symbol_jet(pool, P, 1)};

        e = qdot_subs(pool, e, 2, inward ? momentum : coordinate, inward ? coordinate : momentum);
    }
    return e;
}

qdot_expr
qdot_phase_space_inward(const qdot_scene *s, qdot_expr e)
{
    return exchange_momenta(s, e, true);
}

qdot_expr
qdot_phase_space_outward(const qdot_scene *s, qdot_expr e)
{
    return exchange_momenta(s, e, false);
}
