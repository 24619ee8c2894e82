/* products.h -- rewrites the products in an expression. */
#ifndef QDOT_NORMAL_PRODUCTS_H
#define QDOT_NORMAL_PRODUCTS_H

#include "expr/id.h"

/* The expression e with sin(a)^m cos(a)^-n as tan(a)^k ..., likewise cot and tanh; nil if the pool failed. */
qdot_expr qdot_products_tangents(qdot_pool *pool, qdot_expr e);

/* e with products such as (-a - b)*c as -(a + b)*c. */
qdot_expr qdot_products_signs(qdot_pool *pool, qdot_expr e);

/* sin(2 a) as 2 sin(a) cos(a), then common factors in front (common.c), a function to its least
 * power: 1/2*sin(2*a)*x + sin(a)*y = sin(a)*(cos(a)*x + y). The result may be longer than e. */
qdot_expr qdot_products_out(qdot_pool *pool, qdot_expr e);

/* Multiply fractions into sums wherever that is shorter: v^2/4 + x^2 for (v^2 + 4 x^2)/4. */
qdot_expr qdot_products_numbers(qdot_pool *pool, qdot_expr e);

#endif
