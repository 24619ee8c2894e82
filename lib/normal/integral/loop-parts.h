/* loop-parts.h -- what the files of the loop integral share. */
#ifndef QDOT_INTEGRAL_LOOP_PARTS_H
#define QDOT_INTEGRAL_LOOP_PARTS_H

#include "normal/integral/polynomial.h"
#include "normal/integral/reading.h"

typedef struct {
    qdot_integral_task t;
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr f, x, lo, hi; /* lo nil: a full turn of x */
    qdot_expr value;        /* what was found */
} qdot_loop_task;

/* The integrand over a variable u in place of x: sqrt(f) dx = sqrt(f (dx/du)^2) du, and f (dx/du)^2 = Q H^2 with polynomials
 * in u, Q square-free, H = over/(base[0]^power[0] ... base[n-1]^power[n-1]). */
typedef struct {
    qdot_poly Q, over;
    int n;
    qdot_poly base[QDOT_READING_FACTORS];
    int64_t power[QDOT_READING_FACTORS];
} qdot_loop_square;

/* The sign of e, proved: 1 or -1; 0: not known. */
int qdot_loop_sign(qdot_loop_task *l, qdot_expr e);

/* The loop of sqrt(Q) |H| between the zeros of Q, of degree 2 (loop-residues.c); nil: not found. */
qdot_expr qdot_loop_residues(qdot_loop_task *l, const qdot_loop_square *s);
/* The loop of sqrt(Q) times a constant, Q of degree 4 and even; `both`: between -b and b (loop-elliptic.c). */
qdot_expr qdot_loop_biquadratic(qdot_loop_task *l, const qdot_loop_square *s, bool both);
/* The loop, or turn, of the root of what was read, if that is c + b cos(kx + ...) or with the sine. */
qdot_expr qdot_loop_pendulum(qdot_loop_task *l, const qdot_reading *r);

#endif
