/* equations.h -- the data of a plan: the equations of motion with parameter values.
 *
 *     M(q, t) q'' = f(q, q', t)
 *
 * M couples the coordinates in blocks:
 *
 *     a block of one     q'' = f/M, divided symbolically: nothing to solve
 *     a constant block   M factored once
 *     any other          M evaluated and factored at every state
 *
 * Everything the tapes read is laid out as q [n], q' [n], t, q'' [n].
 *
 * Tests  tests/sim/run/test_run.c
 */
#ifndef QDOT_SIM_EQUATIONS_H
#define QDOT_SIM_EQUATIONS_H

#include "num/structure.h"
#include "ode/method.h"
#include "ode/system.h"
#include "series/motion.h"
#include "sim/model/request.h"
#include "tape/tape.h"

typedef struct {
    size_t n;            /* number of coordinates in the block */
    const size_t *index; /* [n] indices of the coordinates; borrowed from plan->structure */
    bool constant;       /* n > 1, and the block of M is constant */
    double *M;           /* [n x n] lower triangle of a constant block; else NULL */
    signed char *side;   /* [n x n] sign of (exact entry - double) (tape/shake.h) */
} qdot_plan_block;

typedef struct qdot_residual qdot_residual; /* defined in sim/form/residual.h */
typedef struct qdot_canonical qdot_canonical; /* defined in sim/form/canonical.h */
typedef struct qdot_phase_space qdot_phase_space; /* defined in sim/form/phase-space.h */
typedef struct qdot_constraints qdot_constraints; /* defined in sim/model/constraints.h */
struct qdot_switches;                       /* defined in sim/model/switch.h */

/* The form of the equations from which Taylor series are computed. */
typedef enum {
    QDOT_FORM_NONE,        /* no series: the equations switch */
    QDOT_FORM_EXPLICIT,    /* M q'' = f, expanded by the program plan->motion */
    QDOT_FORM_RESIDUAL,    /* d'Alembert's residual, expanded by the program of plan->residual */
    QDOT_FORM_TREE,        /* d'Alembert's residual along its tree (sim/form/tree-series.h) */
    QDOT_FORM_CONSTRAINED, /* constraint equations expanded as series together with q'' */
    QDOT_FORM_ELIMINATED,  /* equations without multipliers: plan->eliminated */
    QDOT_FORM_BORDERED /* q'' and multipliers from one linear system, as machine code: plan->bordered */
} qdot_form;

/* All decisions about how a run is computed: made in sim/plan, then constant, and read everywhere else. */
typedef struct qdot_plan qdot_plan;
struct qdot_plan {
    unsigned uses;   /* number of users besides the first (sim/plan/kept.h) */
    qdot_pool *pool; /* pool of the expressions; borrowed */
    size_t n;        /* number of coordinates */
    size_t m; /* number of constraints of the scene; each component of a vector counts */
    size_t n_states; /* the last coordinates: parameters that events set
                        (sim/model/parameter-states.h) */
    size_t n_sides;  /* number of switching surfaces and of symbols of sliding discs (sim/model/puck.h) */
    qdot_expr *inputs; /* [3n + 1 + m + n_sides] q, q', t, q'', lambda of m constraints, the symbols of
                          the sides (sim/model/switch.h), of which only what is read along a run
                          may hold some */
    /* [m] the scene's lambda of each constraint, and what it is of those among the inputs: mu times
     * it where a run keeps mu f in place of f (mech/dynamics/integrated.h). */
    qdot_expr *multipliers, *scaled;
    bool rescaled;     /* some multiplier differs from its `scaled` form */
    char **names;      /* [n] names of the coordinates; owned */
    qdot_expr *M;      /* [n x n] mass matrix; M, f and tape are NULL if only the tree is used */
    qdot_expr *f;      /* [n] right-hand sides f of M q'' = f (sim/plan/tree-alone.h) */
    bool *massless; /* [n] coordinates without mass, whose equations stand among the constraints
                       behind those of the scene (sim/model/massless.h); NULL: there are none */
    size_t n_massless;
    bool indefinite;   /* M may be indefinite, as for a stated Lagrangian: factor as LDL^T */
    qdot_structure structure;
    qdot_plan_block *blocks; /* [structure.blocks] blocks of M */
    const qdot_ode_method *method;
    bool chosen; /* the method was chosen by the plan, not by the user */
    /* For a geometric method (sim/plan/geometric.h): if `halves`, q' may replace the momenta; else
     * phase_space computes them. */
    bool halves;
    qdot_phase_space *phase_space;

    /* NULL without constraints. With them there are no blocks, and `tape` is that of the
     * index-1 equations. */
    qdot_constraints *constraints;
    qdot_run_treatment treatment;
    qdot_plan *eliminated; /* plan of equations without multipliers (sim/form/eliminated.h); NULL: none */
    qdot_tape *bordered; /* `tape` as one linear system for machine code (sim/form/bordered.h); NULL: none */

    /* Parameter values given in the request, for expressions that are read later; owned copies. */
    size_t n_values;
    qdot_expr *symbols, *values;

    /* From q, q', t. Block by block: one coordinate, q''; a constant block, f; else f
     * and the lower triangle of M by rows. */
    qdot_tape *tape;

    /* M q'' = f as a program (sim/form/motion-of-equations.h), if it is smooth; with constraints
     * that of `bordered`. */
    qdot_motion *motion;

    bool delayed; /* the equations read the history of the run (sim/model/delay.h) */
    bool leading; /* compute the first Taylor coefficients in double-double precision (sim/form/leading.h) */
    bool smooth; /* the equations have Taylor series, for the method of the run or of its companion run */
    /* The equations as d'Alembert's residual if that form is taken, else NULL; convolutions an order
     * of either form, 0 if not counted. */
    qdot_residual *residual;
    double convolutions_derived, convolutions_residual;
    qdot_canonical *canonical; /* with `digits`: Hamilton's equations if these are shorter; or
                                  NULL */
    /* For the residual: nodes of the tree along which M is eliminated, 0: M is factored; whether
     * they are one path. */
    size_t tree_nodes;
    bool tree_is_path;

    /* The form that is integrated, where parts and a reduced plan do not say otherwise: what its
     * expansions cost, and a step at a middling tolerance (sim/plan/cost.h). */
    qdot_form form;
    qdot_ode_cost expansions;
    double cost;

    /* Plans of decoupled groups of coordinates, two or more, for a run in which nothing watches
     * the steps (sim/plan/parts.h). */
    qdot_plan **parts; /* [n_parts] a plan for each decoupled group of coordinates */
    size_t n_parts;
    size_t *place; /* [n] in the plan of a decoupled part: index of each coordinate in the whole scene */

    /* The equations that are integrated instead of these, if cyclic coordinates leave shorter
     * ones (sim/plan/routh.h); else NULL. */
    qdot_plan *reduced;
    /* In a reduced plan: coordinates whose momenta are kept, in the order in which they are
     * solved for; the momenta are the inputs after t. Their rates are the last outputs of the
     * tape; the blocks are those of the other coordinates. */
    size_t n_kept;
    size_t *kept;      /* [n_kept] indices of the coordinates whose momenta are kept constant */
    bool subtracts;    /* velocities from kept momenta are sums whose terms may cancel */
    bool by_start;     /* whether there is a reduced plan depends on the start state and the tolerance */
    qdot_tape *momenta; /* from q, q', t: the conserved momenta that are kept [n_kept] */

    /* The mode (sides of all switches) for which the plan is being made; NULL later. */
    const struct qdot_switches *mode;
    const int64_t *side;
    /* [surfaces] of that mode: the shares of the surfaces along which the motion slides, functions
     * of q, q', t; NULL: there are none (sim/model/sliding.h). Kept with the plan. */
    qdot_expr *share;
    /* Of the first plan of a run: the switches and, [surfaces], QDOT_SIDE_SLIDES for surfaces along which
     * it slid; NULL: none (qdot_plan_reading). Borrowed and owned. */
    const struct qdot_switches *read_switches;
    int64_t *read_side;
};

/* Make an empty plan for n coordinates of another plan, with the same method, and room for inputs
 * [3n + 1 + more], names [n], M [n x n] and f [n]. QDOT_ENOMEM: *plan is a part of it, or NULL.
 *  */
QDOT_MUST_CHECK qdot_status qdot_plan_of_part(const qdot_plan *of, size_t n, size_t more,
                                              qdot_plan **plan);

/* Whether the method of the run, or that of its companion run, needs a Jacobian. */
bool qdot_plan_needs_jacobian(const qdot_plan *plan);

/* For rooms that fill a plan of their own: find the blocks of M [n x n] over the coordinates
 * marked in `in` [n]; then lower p->f and p->M by these blocks, followed by the outputs others
 * [more], from p->inputs [inputs]. */
QDOT_MUST_CHECK qdot_status qdot_plan_structure(qdot_plan *plan, const bool *in);
QDOT_MUST_CHECK qdot_status qdot_plan_lower(qdot_plan *plan, size_t inputs, size_t more,
                                            const qdot_expr *others);

/* Compile p->tape anew, in the form used for series in vector lanes (qdot_tape_new_for_series). */
QDOT_MUST_CHECK qdot_status qdot_plan_lower_for_series(qdot_plan *plan);

/* The number of inputs of the plan's tapes: 3n + 1 + m + n_sides. */
size_t qdot_plan_inputs(const qdot_plan *plan);

/* The value of the constant e with parameter values (expr/constant.h): the nearest double, the
 * sign of the exact value less it, and the difference. */
QDOT_MUST_CHECK qdot_status qdot_plan_number(const qdot_plan *plan, qdot_expr e,
                                             double *value, int *side, double *low);

/* e with parameter values inserted, and multipliers replaced by those among the inputs. Nil: the
 * pool keeps the failure. */
qdot_expr qdot_plan_substitute(const qdot_plan *plan, qdot_expr e);

#endif
