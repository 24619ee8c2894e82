/* taylor-code.h -- a Taylor program as machine code: an order without a call or a pointer,
 * rows at constant places. Internal to series/.
 *
 * What a product c = x y takes at order k, sum_{j=0..k} x_j y_{k-j}, is not summed up there.
 * When order m of x and y is known, all that is made of it and orders up to m is added to
 * what later orders are going to be, a whole vector at once, from order l on:
 *
 *     S <- (S moved on by one order) + x_m (y_l, ..., y_m) + y_m (x_l, ..., x_{m-1}),
 *
 * so that nothing is read backwards and no vector is ever added up: the first of S is what
 * order m + l begins with. Orders below l of one factor come with the newest of the other
 * and are added singly. l is 2 where the time from one order to the next counts, 1 where
 * the number of instructions does. Of orders 1 ... n the vectors have n/2 numbers, since the
 * sum of two orders is at most n. S and the vectors of rows stay in registers from order to
 * order, as many as there is room for. Orders with the same number of vectors at work are
 * one loop.
 *
 * A sum, a difference, a multiple or a product that one other step adds up and nobody else
 * reads has no row: its terms are terms of that step, by factors that are made once. What is
 * known last is added last; when it is known is guessed from the order before, written for
 * that alone.
 *
 * Unknowns (taylor-motion.h) are solved for at the end of every order, by the matrices
 * that are there when the code is run.
 *
 * Order 0 is a second function: sums, products, quotients and roots as they stand, a call for each
 * elementary function.
 *
 * It needs an x86-64, of any kind, and a system that lets a program run what it wrote. Where it
 * runs the last bits of coefficients are other ones than those of taylor-order.def.
 *
 * Source  van der Hoeven, J. Symbolic Comput. 34 (2002) 479, 4.1, for the order of the sum.
 * Tests   tests/series/test_taylor-code.c
 */
#ifndef QDOT_SERIES_TAYLOR_CODE_H
#define QDOT_SERIES_TAYLOR_CODE_H

#include "series/taylor-steps.h"

typedef struct qdot_taylor_code qdot_taylor_code;

/* Of orders 1 ... to of a program and its links, shared with others to orders up to `most` at least if
 * vectors are narrow: the loops of a lower order are the first of a higher one. *code NULL, and *why says it, where there is
 * none: the processor or the system has no way, or it would be too long. With `kept` none is
 * written: it is there (taylor-text.h) or *code is NULL, *why too. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_code_new(const qdot_taylor *t, int to, int most,
                                                 bool kept, qdot_taylor_code **code,
                                                 const char **why);
void qdot_taylor_code_free(qdot_taylor_code *code);

/* Set the unit of time for integrals (links); call this before the orders are computed. */
void qdot_taylor_code_unit(qdot_taylor_code *code, double unit);

/* Order 0 of the program it was made of and, if nothing is solved for, what is linked to it, by
 * the unit that is there. */
void qdot_taylor_code_begin(const qdot_taylor_code *code, qdot_taylor *t);
/* Compute all orders above 0; order 0 and the integrals that follow from it must be known. */
void qdot_taylor_code_run(const qdot_taylor_code *code, qdot_taylor *t);

int qdot_taylor_code_orders(const qdot_taylor_code *code);
/* The size of the machine code in bytes. */
size_t qdot_taylor_code_size(const qdot_taylor_code *code);

#endif
