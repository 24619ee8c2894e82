/* print-name.h -- symbols and numbers as text: the leaves of print.c. */
#ifndef QDOT_EXPR_PRINT_NAME_H
#define QDOT_EXPR_PRINT_NAME_H

#include "expr/print.h"

/* theta1' as theta1', θ̇₁, \dot{\theta}_{1}. */
void qdot_print_symbol(const qdot_pool *pool, qdot_expr e, qdot_style style, qdot_text *out);

/* p/q; raised: as unicode superscripts; bracket 1: a negative number in brackets, 2: a fraction
 * too. */
void qdot_print_number(const fmpq_t x, qdot_style style, bool raised, int bracket,
                       qdot_text *out);

#endif
