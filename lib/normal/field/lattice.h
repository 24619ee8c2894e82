/* lattice.h -- base angles: arguments as integer combinations of as few angles as possible.
 *
 * An argument is a linear combination over Q of angle monomials (theta, omega*t, 1 ...)
 * plus a rational multiple of pi. When the directions of the arguments are independent
 * each is a base of its own, divided by the common denominator of its multiples (theta1
 * - theta2 alone is one base; theta and theta/2 have the base theta/2); else each
 * monomial is a base.
 */
#ifndef QDOT_NORMAL_LATTICE_H
#define QDOT_NORMAL_LATTICE_H

#include <flint/fmpq.h>

#include "base/status.h"
#include "expr/id.h"
#include "normal/field/map.h"

typedef struct {
    uint32_t mono;
    fmpq c;
} qdot_lattice_term;

typedef struct {
    qdot_expr arg;
    fmpq pi;                 /* rational multiple of pi in `arg`, if its denominator divides 12 */
    qdot_lattice_term *term; /* [n] the other terms of `arg` */
    size_t n, capacity;
    slong *at; /* [n_bases] integer coordinates: arg = pi + sum of at[i] base[i] */
} qdot_lattice_row;

/* Start with `qdot_lattice l = {0};`. */
typedef struct {
    qdot_lattice_row *row;
    size_t n_rows, rows_capacity;
    qdot_expr *mono;
    size_t n_monos, monos_capacity;
    qdot_expr *base; /* [n_bases] the base angles */
    size_t n_bases;
    qdot_map rows, monos; /* indices of rows (arguments) and monomials by expression, used if there are many */
} qdot_lattice;

/* Add an argument (a sum of terms; twice is once). `offsets`: split multiples of pi off.
 * *row: its number. Errors: QDOT_ENOMEM, the pool's. */
QDOT_MUST_CHECK qdot_status qdot_lattice_add(qdot_lattice *l, qdot_pool *pool,
                                             qdot_expr arg, bool offsets, uint32_t *row);
/* Find the index of an argument that was added before. False: it was not added. */
bool qdot_lattice_find(const qdot_lattice *l, qdot_expr arg, uint32_t *row);
/* Find the bases and all coordinates. QDOT_ELIMIT: a coordinate beyond +-200. */
QDOT_MUST_CHECK qdot_status qdot_lattice_solve(qdot_lattice *l, qdot_pool *pool);
void qdot_lattice_clear(qdot_lattice *l);

#endif
