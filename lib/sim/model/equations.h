/* equations.h -- the equations of motion with numbers in place: what a plan holds.
 *
 *     M(q, t) q'' = f(q, q', t)
 *
 * with the values of parameters in place. The coordinates fall into blocks that M
 * couples:
 *
 *     a block of one     q'' = f/M, divided symbolically: nothing to solve
 *     a constant block   M factored once
 *     any other          M evaluated and factored at every state
 *
 * Everything the tapes read is laid out as q [n], q' [n], t, q'' [n].
 *
 * Tests  tests/sim/test_run.c
 */
#ifndef QDOT_SIM_EQUATIONS_H
#define QDOT_SIM_EQUATIONS_H

#include "num/structure.h"
#include "ode/method.h"
#include "sim/model/request.h"
#include "tape/tape.h"

typedef struct {
    size_t n;            /* coordinates of it */
    const size_t *index; /* [n] which; borrowed from plan->structure */
    bool constant;       /* more than one, and M has only numbers there */
    double *M;           /* [n x n] constant: these numbers, lower triangle; else NULL */
    signed char *side;   /* [n x n] where the exact ones lie beside them (tape/shake.h) */
} qdot_plan_block;

typedef struct qdot_residual qdot_residual; /* sim/form/residual.h */
typedef struct qdot_canonical qdot_canonical; /* sim/form/canonical.h */
typedef struct qdot_constraints qdot_constraints; /* sim/model/constraints.h */
struct qdot_switches;                       /* sim/model/switch.h */

typedef struct qdot_plan qdot_plan;
struct qdot_plan {
    unsigned uses;   /* beside the first (sim/plan/kept.h) */
    qdot_pool *pool; /* borrowed */
    size_t n;        /* coordinates */
    size_t m;        /* constraints, one a component */
    size_t n_states; /* the last of them: parameters that events set (sim/model/parameter-states.h) */
    qdot_expr *inputs; /* [3n + 1 + m] q, q', t, q'', lambda of m constraints */
    char **names;      /* [n] of the coordinates; owned */
    qdot_expr *M;      /* [n x n] NULL, as f and tape, where only the tree is read */
    qdot_expr *f;      /* [n]                                   (sim/plan/tree-alone.h) */
    bool indefinite;   /* a stated Lagrangian, a potential with velocities: LDL^T */
    qdot_structure structure;
    qdot_plan_block *blocks; /* [structure.blocks] */
    const qdot_ode_method *method;
    bool chosen; /* the method was left to the plan */

    /* NULL without constraints. With them there are no blocks, and `tape` is that of the
     * index-1 equations. */
    qdot_constraints *constraints;
    qdot_run_treatment treatment;
    qdot_plan *eliminated; /* their q'' without multipliers (sim/form/eliminated.h); or NULL */
    qdot_tape *bordered; /* or as `tape`, for machine code (sim/form/bordered.h); or NULL */

    /* Values of the request, for expressions asked for later; owned copies. */
    size_t n_values;
    qdot_expr *symbols, *values;

    /* From q, q', t. Block by block: one coordinate, q''; a constant block, f; else f
     * and the lower triangle of M by rows. */
    qdot_tape *tape;

    bool leading; /* first orders in two doubles are wanted (sim/form/leading.h) */
    bool smooth; /* the equations have Taylor series: for the method or its companion */
    /* Of those: the equations as d'Alembert's residual where that is
     * cheaper, else NULL; convolutions an order of either form, 0 where it was not
     * looked at. */
    qdot_residual *residual;
    double convolutions_derived, convolutions_residual;
    qdot_canonical *canonical; /* of `digits`: Hamilton's equations where these are shorter; or NULL */
    /* Of that residual: nodes of the tree that M is eliminated along, 0: it is factored;
     * whether they are one path. */
    size_t tree_nodes;
    bool tree_is_path;
    double cost; /* of steps by the form taken: qdot_plan_cost */
    double cost_of_kernels; /* of the derived form without machine code */

    /* The same by groups of coordinates that know nothing of each other, two or more, for a
     * run whose steps nobody looks at (sim/plan/parts.h). */
    qdot_plan **parts; /* [n_parts] */
    size_t n_parts;
    size_t *place; /* of a part alone: [n] where its coordinates are in the scene */

    /* The equations that are integrated in place of these, where cyclic coordinates leave
     * shorter ones (sim/plan/routh.h); else NULL. */
    qdot_plan *reduced;
    /* Of such equations alone: coordinates whose momenta are kept, the first to be solved
     * for first; the inputs behind t are these. Their rates stand behind the tape's other
     * outputs, blocks are those of the other coordinates. */
    size_t n_kept;
    size_t *kept;      /* [n_kept] */
    bool subtracts;    /* velocities of these are sums, whose terms may cancel */
    bool by_start;     /* whether there is a reduced one depends on the start and the tolerance */
    qdot_tape *momenta; /* from q, q', t: [n_kept] */

    /* While it is made: the mode that its equations are frozen to; else NULL. */
    const struct qdot_switches *mode;
    const long *side;
};

/* A plan for n coordinates of another's equations, to be filled: integrated as that is, with
 * room for inputs [3n + 1 + more], names [n], M [n x n] and f [n]. QDOT_ENOMEM: what there is
 * of it, or NULL, is *plan's. */
QDOT_MUST_CHECK qdot_status qdot_plan_of_part(const qdot_plan *of, size_t n, size_t more,
                                              qdot_plan **plan);

/* Whether the method of the run, or that of its companion, asks for a Jacobian. */
bool qdot_plan_needs_jacobian(const qdot_plan *plan);

/* For another part of sim that makes a plan of its own: the blocks of M [n x n] over the
 * coordinates that `in` [n] has; then the tape of p->f and p->M by them, with `more` outputs
 * behind, from p->inputs [inputs]. */
QDOT_MUST_CHECK qdot_status qdot_plan_structure(qdot_plan *plan, const bool *in);
QDOT_MUST_CHECK qdot_status qdot_plan_lower(qdot_plan *plan, size_t inputs, size_t more,
                                            const qdot_expr *others);

/* p->tape again, as series in lanes want it (qdot_tape_new_for_series). */
QDOT_MUST_CHECK qdot_status qdot_plan_lower_for_series(qdot_plan *plan);

/* How many inputs there are: 3n + 1 + m. */
size_t qdot_plan_inputs(const qdot_plan *plan);

/* The number that e is with the values in place (tape/constant.h): the double, the side on which
 * it lies beside it, what it is beyond. */
QDOT_MUST_CHECK qdot_status qdot_plan_number(const qdot_plan *plan, qdot_expr e,
                                             double *value, int *side, double *low);

/* e with the values in place. Nil: the pool keeps the failure. */
qdot_expr qdot_plan_substitute(const qdot_plan *plan, qdot_expr e);

#endif
