/* integral-pieces.h -- a definite integral of what reads tables of data (num/samples.h), as a sum over pieces.
 *
 *     int_a^b f dx = sum over k of the integral of f from c_k to c_{k+1},   c_0 = a, c_1, ..., c_n = b
 *
 * where the c_k are the places at which a table is read at a knot, each place of reading being linear in x. In a piece the table is
 * its polynomial, with rational coefficients; where f is then a polynomial of degree 3 or less,
 *
 *     int f = h f(m) + h^3/24 f''(m),   h the length of the piece, m its middle,
 *
 * is exact. Other pieces stand as integrals.
 *
 * Tests  tests/script/data/integrals.sh
 */
#ifndef QDOT_EXPR_INTEGRAL_PIECES_H
#define QDOT_EXPR_INTEGRAL_PIECES_H

#include "expr/id.h"

/* The sum for the definite integral e, which holds no symbols; `number` gives the double of a constant. QDOT_ENOTBUILT: a place
 * of reading that is not linear in x; QDOT_EDOMAIN: there are no values; QDOT_ELIMIT: more than 20000 pieces; those of `number`. */
QDOT_MUST_CHECK qdot_status qdot_integral_in_pieces(qdot_pool *pool, qdot_expr e,
                                                    qdot_status (*number)(qdot_pool *pool, qdot_expr e, double *value),
                                                    qdot_expr *sum);

#endif
