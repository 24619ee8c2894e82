/* unit.h -- the base units of measurement as symbols: positive, independent of each other, of the value 1.
 *
 *     0.5 [m] is 1/2 [m],   3 [N] is 3 [kg] [m] [s]^-2
 *
 * So an expression with units is exact, homogeneous, and its number is that in SI units. They print as they are typed.
 *
 * Tests  tests/expr/test_unit.c
 */
#ifndef QDOT_EXPR_UNIT_H
#define QDOT_EXPR_UNIT_H

#include "expr/id.h"
#include "expr/node.h"

enum { QDOT_UNIT_SYMBOLS = 7 }; /* m, kg, s, A, K, mol, cd */

/* The symbol of a base unit. */
qdot_expr qdot_unit_symbol(qdot_pool *pool, int base);
/* Which base unit the symbol e is; -1: it is none. */
int qdot_unit_symbol_base(const qdot_pool *pool, qdot_expr e);
bool qdot_expr_has_units(qdot_pool *pool, qdot_expr e);
/* e in SI units, as an expression without units. */
qdot_expr qdot_expr_in_si(qdot_pool *pool, qdot_expr e);

#endif
