/* elimination.h -- Gauss's elimination on rows of expressions, exact or by numbers. Internal to mech/linear.
 *
 * With `numbers` every entry is a rational number that stands for one of about 30 digits; what is smaller than `tiny`
 * times the largest entry of its row counts as 0.
 */
#ifndef QDOT_MECH_ELIMINATION_H
#define QDOT_MECH_ELIMINATION_H

#include "normal/field/facts.h"

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    bool numbers;
    size_t most; /* bound of the work, beyond which, or at a long constant, there is QDOT_ELIMIT; 0: no bound */
    size_t work; /* operations in the expressions simplified so far */
} qdot_elimination;

/* Rows in reduced echelon form: the leading 1 of row r is in column pivot[r], other rows have 0 there. */
typedef struct {
    size_t width, lead; /* length of a row; its first `lead` entries may lead */
    size_t rank;
    qdot_expr *row; /* [rank x width] */
    size_t *pivot;  /* [rank] */
} qdot_echelon;

/* e in its shortest form; nil past the bound of work. */
qdot_expr qdot_elimination_short(qdot_elimination *x, qdot_expr e);
bool qdot_elimination_is_zero(const qdot_elimination *x, qdot_expr e);
/* a - b c, shortened. */
qdot_expr qdot_elimination_minus(qdot_elimination *x, qdot_expr a, qdot_expr b, qdot_expr c);

QDOT_MUST_CHECK qdot_status qdot_echelon_begin(qdot_echelon *e, size_t rows, size_t lead, size_t width);
void qdot_echelon_end(qdot_echelon *e);
/* Add `row` [width], which is reduced in place; *independent: its first `lead` entries are not all 0 then, and it was
 * added, divided by row[pivot[rank - 1]]. */
QDOT_MUST_CHECK qdot_status qdot_echelon_add(qdot_elimination *x, qdot_echelon *e, qdot_expr *row, bool *independent);
/* Whether a row leads in column j. */
bool qdot_echelon_leads(const qdot_echelon *e, size_t j);
/* Solve for the leading entries, with zeros on the right: N [lead x (lead - rank)], by rows. Column a of N has the a-th
 * entry in which no row leads at 1, the others of these at 0. */
void qdot_echelon_null_space(qdot_pool *pool, const qdot_echelon *e, qdot_expr *N);

#endif
