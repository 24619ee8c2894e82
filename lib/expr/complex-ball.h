/* complex-ball.h -- a function f of one variable, an integrand as it stands in a node, in balls of complex numbers.
 *
 * On the real line f has its real value or none: sqrt(x) is indeterminate where x < 0 and so is all that holds it. In a
 * disc beside the line f is continued analytically; it is indeterminate where a branch cut, a pole, a kink or a step may
 * lie in the disc.
 *
 * An integral within f is integrated for each z; it must have finite ends.
 *
 * Tests   tests/expr/test_integral.c
 */
#ifndef QDOT_EXPR_COMPLEX_BALL_H
#define QDOT_EXPR_COMPLEX_BALL_H

#include "expr/id.h"
#include "expr/walk.h"
#include "num/arb.h"

typedef struct qdot_complex_ball {
    const qdot_pool *pool;
    qdot_expr f;
    qdot_walk walk;
    struct qdot_complex_ball *outer; /* of the integral in whose integrand this one stands; NULL: of none */
    struct qdot_complex_ball **inner; /* [walk.n] of the integrals in f, NULL for other nodes */
    acb_srcptr z; /* the variable, while f is evaluated */
    bool analytic;  /* what is evaluated now must be analytic, as at complex z: branch cuts, kinks and steps count */
    bool kinked;    /* f holds a function with kinks or steps */
    acb_ptr value;  /* [walk.n] the value of each node; of a condition 1, 0 or indeterminate */
} qdot_complex_ball;

/* Errors: QDOT_ENOMEM, QDOT_EINTR, after which _end must not be called; QDOT_ENOTBUILT: integrals too deep within each other. */
QDOT_MUST_CHECK qdot_status qdot_complex_ball_begin(qdot_complex_ball *b, const qdot_pool *pool, qdot_expr f);
void qdot_complex_ball_end(qdot_complex_ball *b);
/* y = f(z). analytic: indeterminate unless f is known to be analytic on z. */
void qdot_complex_ball_eval(qdot_complex_ball *b, acb_t y, const acb_t z, bool analytic, slong bits);

#endif
