/* cells.h -- is e >= 0 wherever conditions hold? Algebraic e, decided cell by cell.
 *
 * e and the conditions g > 0 (or g >= 0) are made of symbols and rational numbers by + - * /, roots and
 * absolute values. Polynomials whose zeros bound the regions where e and the g keep their signs - norms
 * over the roots, bases of even roots, denominators - are projected, one symbol after another, to
 * leading coefficients, discriminants and resultants. Over a region where none of these vanishes the
 * zeros above lie in separate sheets, so rational points between all real zeros, taken symbol by symbol,
 * meet every open cell. In each one point decides: balls, and where these hold zero the norm form.
 *
 * So e >= 0 is known on a dense part of the open set g > 0, and by continuity on its closure,
 * which is the whole set of the conditions g >= 0 if these are linear, or grow with a symbol of their own.
 * With several symbols other weak conditions are not used, but a point is a counterexample only where these
 * hold too; and there is no decision if the base of a root is neither linear nor known not to be negative
 * (x^2*(x - 1) has a root at 0 too, an isolated point). With one symbol such points and the zeros of e are
 * tested one by one, so e > 0 is decided too.
 *
 * Source  A. Strzebonski, "Solving systems of strict polynomial inequalities", J. Symbolic Computation
 *         29 (2000) 471; S. McCallum, "Solving polynomial strict inequalities using cylindrical
 *         algebraic decomposition", The Computer Journal 36 (1993) 432.
 * Tests   tests/normal/inequality/test_less.c
 */
#ifndef QDOT_NORMAL_CELLS_H
#define QDOT_NORMAL_CELLS_H

#include "expr/id.h"

typedef struct {
    qdot_expr gap; /* the condition is gap > 0, or gap >= 0 if `weak` is true */
    bool weak;
} qdot_cells_condition;

typedef enum {
    QDOT_CELLS_UNKNOWN,  /* not decided: too large, or outside of the class that can be treated */
    QDOT_CELLS_EMPTY,    /* the conditions are satisfied on no open set */
    QDOT_CELLS_POSITIVE, /* e > 0 wherever it is defined */
    QDOT_CELLS_NOT_NEGATIVE,
    QDOT_CELLS_NEGATIVE, /* e < 0 at the point *at */
    QDOT_CELLS_ZERO      /* one symbol only: e >= 0, and e = 0 at the point *at */
} qdot_cells;

/* *at: a LIST of equations symbol = rational. *work, about 20 ns each, is used up; past it nothing is
 * known. Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_cells_decide(qdot_pool *pool, qdot_expr e, size_t n,
                                              const qdot_cells_condition *condition,
                                              int64_t *work, qdot_cells *result,
                                              qdot_expr *at);

#endif
