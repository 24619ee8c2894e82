/* expansion.h -- a series program in doubles whose inputs are q, q' and t.
 *
 * The state at the point of expansion, by the unit of time, s = (t' - t)/unit:
 *
 *     q_0 = q,   q_1 = unit q',   v_0 = q',   t_0 = t,   t_1 = unit
 *
 * Tests  tests/sim/form/test_taylor.c
 */
#ifndef QDOT_SIM_EXPANSION_H
#define QDOT_SIM_EXPANSION_H

#include "ode/system.h"
#include "series/taylor.h"

typedef struct {
    qdot_taylor *taylor; /* the series program; owned by the object that contains this */
    size_t n, stride;    /* number of coordinates; distance of two rows of coefficients, in doubles */
    double *q, *v, *t;   /* Taylor coefficients of the inputs q, q', t */
} qdot_expansion;

/* The expansion of n coordinates by the series program `taylor`. */
static inline qdot_expansion
qdot_expansion_of(qdot_taylor *taylor, size_t n)
{
    return (qdot_expansion){.taylor = taylor,
                            .n = n,
                            .stride = qdot_taylor_stride(taylor),
                            .q = qdot_taylor_input(taylor, 0),
                            .v = qdot_taylor_input(taylor, n),
                            .t = qdot_taylor_input(taylor, 2 * n)};
}

/* Set the state y [2n] at time t; inexact constants are rounded at random (series/taylor.h). */
static inline void
qdot_expansion_begin(const qdot_expansion *e, double t, const double *y, double unit)
{
    double *q = e->q, *v = e->v;

    for (size_t i = 0; i < e->n; i++, q += e->stride, v += e->stride) {
        q[0] = y[i];
        q[1] = unit * y[e->n + i];
        v[0] = y[e->n + i];
    }
    e->t[0] = t;
    e->t[1] = unit;
    qdot_taylor_draw(e->taylor, t);
}

/* The machine code of a series program, as callbacks for an integrator; borrowed; costs are set to 0. */
qdot_ode_code qdot_expansion_code(qdot_taylor *taylor);

#endif
