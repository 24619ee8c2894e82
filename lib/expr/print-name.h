/* print-name.h -- output styles, and printing of single names and numbers. */
#ifndef QDOT_EXPR_PRINT_NAME_H
#define QDOT_EXPR_PRINT_NAME_H

#include <flint/fmpq.h>

#include "base/text.h"
#include "expr/id.h"

/* The output styles; described in print.h. */
typedef enum { QDOT_PLAIN, QDOT_UNICODE, QDOT_LATEX, QDOT_MATHML } qdot_style;

/* Append a name (a label, a family member) in that style: theta1 becomes θ₁. */
void qdot_print_name(const qdot_pool *pool, const char *name, qdot_style style, qdot_text *out);

/* Whether e is a symbol that stands for a number of a run, such as `0.25#3`: what is behind # keeps it apart from
 * others of the same digits, and is not printed. */
bool qdot_symbol_is_number(const qdot_pool *pool, qdot_expr e);

#endif
