/* ball.h -- expressions in ball arithmetic (Arb): enclosures, never rounded.
 */
#ifndef QDOT_NORMAL_BALL_H
#define QDOT_NORMAL_BALL_H

#include "expr/id.h"
#include "expr/walk.h"
#include "num/arb.h"
#include "num/interval.h"

/* A list of expressions that is prepared once and evaluated in balls at many points. */
typedef struct {
    qdot_pool *pool;
    qdot_walk walk;
    arb_ptr value; /* [walk.n] enclosure of each node's value */
    uint8_t
        *known; /* [walk.n] 0 unknown; scalars: 1 finite; relations: 1 true, 2 false */
} qdot_ball;

/* Begin; errors: QDOT_ENOMEM, QDOT_EINTR, after which _end must not be called. */
QDOT_MUST_CHECK qdot_status qdot_ball_begin(qdot_ball *b, qdot_pool *pool, size_t n,
                                            const qdot_expr *e);
void qdot_ball_end(qdot_ball *b);

/* Evaluate all with prec bits. `of` gives the value of a symbol or of an application of
 * an undefined function; false: it has none. NULL: none has. */
void qdot_ball_eval(qdot_ball *b, slong prec,
                    bool (*of)(void *user, qdot_expr atom, arb_t value, slong prec),
                    void *user);

/* The enclosure of the value of one of the expressions; NULL if it is undefined or not known. */
arb_srcptr qdot_ball_get(const qdot_ball *b, qdot_expr e);
/* The midpoint of the enclosure of a single expression; false if it has none. `of` as in qdot_ball_eval. */
bool qdot_ball_double(qdot_pool *pool, qdot_expr e,
                      bool (*of)(void *user, qdot_expr atom, arb_t value, slong prec),
                      void *user, double *x);

/* An interval that contains the value of a constant; the whole line if it has none or contains a symbol. */
qdot_interval qdot_ball_bounds(qdot_pool *pool, qdot_expr e);
/* The declared domain of a symbol as an interval, infinite where no end is declared or the end depends on a symbol. */
qdot_interval qdot_ball_domain(qdot_pool *pool, qdot_expr symbol);

/* The truth of a relation or logical expression: 1 true, 2 false, 0 not known. */
int qdot_ball_truth(const qdot_ball *b, qdot_expr e);

#endif
