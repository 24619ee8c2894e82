/* unit.c -- the base units of measurement as symbols. */
#include "expr/unit.h"

#include <string.h>

#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"

static const char *const names[QDOT_UNIT_SYMBOLS] = {"[m]", "[kg]", "[s]", "[A]", "[K]", "[mol]", "[cd]"};

qdot_expr
qdot_unit_symbol(qdot_pool *pool, int base)
{
    const qdot_expr e = qdot_symbol_get(pool, QDOT_PARAM, names[base]);

    if (e != QDOT_NIL && qdot_expr_symbol(pool, e)->lo == QDOT_NIL)
        qdot_symbol_domain(pool, e, QDOT_ZERO, true, QDOT_NIL, false);
    return e;
}

int
qdot_unit_symbol_base(const qdot_pool *pool, qdot_expr e)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, e);

    for (int i = 0; s != NULL && s->class == QDOT_PARAM && s->name[0] == '[' && i < QDOT_UNIT_SYMBOLS; i++)
        if (strcmp(s->name, names[i]) == 0)
            return i;
    return -1;
}

bool
qdot_expr_has_units(qdot_pool *pool, qdot_expr e)
{
    const qdot_expr atoms = e == QDOT_NIL ? QDOT_NIL : qdot_expr_atoms(pool, e, false);

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++)
        if (qdot_unit_symbol_base(pool, qdot_expr_arg(pool, atoms, i)) >= 0)
            return true;
    return false;
}

qdot_expr
qdot_expr_in_si(qdot_pool *pool, qdot_expr e)
{
    qdot_expr from[QDOT_UNIT_SYMBOLS], to[QDOT_UNIT_SYMBOLS];

    if (!qdot_expr_has_units(pool, e))
        return e;
    for (int i = 0; i < QDOT_UNIT_SYMBOLS; i++) {
        from[i] = qdot_unit_symbol(pool, i);
        to[i] = QDOT_ONE;
    }
    return qdot_subs(pool, e, QDOT_UNIT_SYMBOLS, from, to);
}
