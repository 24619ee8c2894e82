/* lanes-code.h -- machine code for series in lanes: whatever is done order by order to groups
 * (num/batch.h), written once for an expansion.
 *
 * Every number of the code is a group, a vector of the processor: coefficient k of a row. What
 * an order is made of is said by a function that is called while the code is written: the
 * recurrences of the program (_steps), sums of products over orders (_dots), and single
 * operations on an accumulator. Low orders are written one after another, the others as a
 * loop of blocks of four, places being constants but for the order. Sums call one sequence of
 * multiplications at the place from which on it has as many as are wanted, whatever the rows.
 * The first order K of a block makes what is known by then of all its sums,
 *
 *     sum_{j=i+1..K-1} x_j y_{K+i-j},   i = 0 ... 3,
 *
 * terms K - 1, K - 2, ..., 1 from the (K-1)-th before its end on, for which coefficients are
 * loaded once: a row that has left the nearest cache is brought there once a block. Order K + i
 * adds the 2 i terms that hold coefficients from K on, the newest last, for which nothing then
 * waits. Results stay in registers while there is room, and are stored when they leave them or
 * the order ends: never, if others took their place by then or nothing reads them (_unread).
 * Rows that no sum reads have a place for order 0 and one for the order at hand only.
 *
 * With AVX-512 a group is one vector. With AVX2 it is two, and the same code, in their
 * encoding, is run for each half. A group may also be one double: a single run. Without either
 * there is no code: kernels run. The last bits of coefficients may be other ones than theirs.
 *
 * Tests  tests/series/test_lanes-code.c
 */
#ifndef QDOT_SERIES_LANES_CODE_H
#define QDOT_SERIES_LANES_CODE_H

#include "series/lanes.h"

typedef struct qdot_lanes_code qdot_lanes_code;
typedef struct qdot_lanes_writer qdot_lanes_writer;

/* A row (the coefficients of one intermediate result) of the series program, or a number of the caller. */
typedef uint32_t qdot_lanes_row;

/* The Taylor coefficient of one order of a row (an intermediate result of the program). */
typedef struct {
    qdot_lanes_row row;
    int order;
} qdot_lanes_at;

/* The two rows whose coefficients are multiplied in a sum of products. */
typedef struct {
    qdot_lanes_row x, y;
} qdot_lanes_pair;

/* A register that something is added to; QDOT_LANES_NOTHING: 0. It is taken until it is
 * stored; three may be so at a time. */
typedef int qdot_lanes_sum;
enum { QDOT_LANES_NOTHING = -1 };

/* What is written. Called twice, the same in both: the first time to learn which rows it
 * wants to all orders. */
typedef void qdot_lanes_write(qdot_lanes_writer *writer, void *user);
/* A function that writes the machine code of one order of the Taylor series. */
typedef void qdot_lanes_write_order(qdot_lanes_writer *writer, int k, void *user);
/* A function that gives a factor depending on the order k. */
typedef double qdot_lanes_by_order(int k);

/* Of the program whose coefficients are `at`, both borrowed; `numbers` further ones are the
 * caller's. *code NULL: the processor or the system has no way, or it would be too long. Errors:
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_lanes_code_new(const qdot_lanes_rows *at, size_t numbers,
                                                qdot_lanes_write *write, void *user,
                                                qdot_lanes_code **code);
/* Whether machine code can be generated on this processor. */
bool qdot_lanes_may_be_code(void);
void qdot_lanes_code_free(qdot_lanes_code *code);
void qdot_lanes_code_run(const qdot_lanes_code *code);

/* The size of the generated machine code in bytes. */
size_t qdot_lanes_code_size(const qdot_lanes_code *code);
/* The address of the caller's number i, which the caller fills before a run: one value for each lane. */
double *qdot_lanes_code_number(const qdot_lanes_code *code, size_t i);

/* --- writing code ------------------------------------------------------------------- */

qdot_lanes_at qdot_lanes_number(const qdot_lanes_writer *w, size_t i);
/* Declare that the coefficients of all orders of a row are read after the run of the code. */
void qdot_lanes_keep(qdot_lanes_writer *w, qdot_lanes_row row);
/* A constant operand with the same value in every lane. */
qdot_lanes_at qdot_lanes_scalar(qdot_lanes_writer *w, double value);

/* A constant operand f(k), which depends on the order k, with the same value in every lane. */
qdot_lanes_at qdot_lanes_scalar_of(qdot_lanes_writer *w, qdot_lanes_by_order *f, int k);

/* Orders from ... to, low ones each written for itself, the others four at a time, as a loop,
 * from order `loop` or a later one on. In there k stands for them all: k + 1 and k - 2 are orders
 * beside it. Sums of _dots are at most `late` orders below the steps'. */
void qdot_lanes_orders(qdot_lanes_writer *w, int from, int late, int loop, int to,
                       qdot_lanes_write_order *write, void *user);

/* Write code for order k = 1, 2, ... of all steps; lower orders, and order k of the inputs, must be known. */
void qdot_lanes_steps(qdot_lanes_writer *w, int k);
/* Stage k of a motion: every step at order k + its lead, newest coefficients of the unknowns being
 * 0; of what holds them rows of the equations alone are there then. */
void qdot_lanes_steps_without(qdot_lanes_writer *w, const qdot_motion *motion, int k);
/* Write code that completes order k once the unknowns are known, for the rows that later orders read. */
void qdot_lanes_steps_with(qdot_lanes_writer *w);
/* The caller's first numbers are what steps multiply by for the rate of a row, or (`twice`) the rate
 * of a rate, at an order that is so much above the stage's: (k + 1)/unit, (k + 1)(k + 2)/unit^2,
 * to be stored before every stage where it is wanted. */
enum { QDOT_LANES_LEADS = 3, QDOT_LANES_RATES = 2 * QDOT_LANES_LEADS };
qdot_lanes_at qdot_lanes_rate(const qdot_lanes_writer *w, bool twice, int lead);
bool qdot_lanes_wants_rate(const qdot_lanes_writer *w, bool twice, int lead);

/* The sum over pairs of sum_{j=1..k-1} x_j y_{k-j}. For the same sums in the same order
 * behind the steps of every order, k being theirs or always as many orders below. */
qdot_lanes_sum qdot_lanes_dots(qdot_lanes_writer *w, size_t pairs,
                               const qdot_lanes_pair *pair, int k);
/* Begin a sum in a register as a copy of the coefficient a. */
qdot_lanes_sum qdot_lanes_continue(qdot_lanes_writer *w, qdot_lanes_at a);
/* Begin a sum as the coefficient a, in the register that holds it if nothing else reads it (_unread). */
qdot_lanes_sum qdot_lanes_continue_last(qdot_lanes_writer *w, qdot_lanes_at a);
/* Add to a sum: sum +- a; _add_product: sum +- a b; _store: a = sum, which frees the register. */
void qdot_lanes_add(qdot_lanes_writer *w, qdot_lanes_sum *sum, bool minus,
                    qdot_lanes_at a);
void qdot_lanes_add_product(qdot_lanes_writer *w, qdot_lanes_sum *sum, bool minus,
                            qdot_lanes_at a, qdot_lanes_at b);
/* Change a sum to a - sum; qdot_lanes_scale: multiply it by a; _negate: change its sign. */
void qdot_lanes_take_from(qdot_lanes_writer *w, qdot_lanes_sum *sum, qdot_lanes_at a);
void qdot_lanes_scale(qdot_lanes_writer *w, qdot_lanes_sum *sum, qdot_lanes_at a);
void qdot_lanes_negate(qdot_lanes_writer *w, qdot_lanes_sum *sum);
/* Nothing reads what was stored there before something is stored there again, after the run
 * neither: it may stay out of memory. */
void qdot_lanes_unread(qdot_lanes_writer *w, qdot_lanes_at a);
void qdot_lanes_store(qdot_lanes_writer *w, qdot_lanes_sum sum, qdot_lanes_at to);

#endif
