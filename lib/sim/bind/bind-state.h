/* bind-state.h -- the fields of a bind (a plan ready to be integrated), shared by bind.c and bind-slopes.c. */
#ifndef QDOT_SIM_BIND_STATE_H
#define QDOT_SIM_BIND_STATE_H

#include <string.h>

#include "num/past.h"
#include "ode/system.h"
#include "sim/bind/pulses.h"
#include "sim/form/blocks.h"
#include "sim/form/guarded.h"
#include "sim/form/leading.h"
#include "sim/form/motion-series.h"
#include "sim/form/phase-space.h"
#include "sim/form/tree-series.h"
#include "sim/model/constrained.h"
#include "sim/model/momenta.h"
#include "tape/knots.h"

typedef struct qdot_bind qdot_bind;

struct qdot_bind {
    const qdot_plan *plan;
    qdot_tape *tape; /* copy of the plan's tape with slightly perturbed constants; NULL: use the plan's own tape */
    qdot_blocks blocks;
    qdot_constrained *held; /* solves for q'' and multipliers under constraints; NULL: no constraints */
    qdot_motion_series *direct; /* Taylor series of smooth equations without constraints; NULL: none */
    qdot_tree_series *tree;
    qdot_motion_series *tied;      /* Taylor series of equations with constraints; NULL: none */
    /* a faster Taylor series under constraints, replaced by `tied` at states that it is not for; NULL: none */
    qdot_guarded *guarded;
    const qdot_ode_series *series; /* callbacks of the Taylor series in use; NULL: no series */
    qdot_phase *phase;     /* converts to canonical momenta, for geometric methods that need them; else NULL */
    qdot_ode_bonds bonds;  /* callbacks of holonomic constraints, for geometric integration methods */
    qdot_leading *leading; /* the first Taylor coefficients in double-double precision; NULL: not requested */
    /* Of a plan without M: gives q'' at a state, apart from the series that is being read; made
     * when that is first asked for. */
    qdot_tree_series *elsewhere; /* along the tree; else: */
    qdot_motion_series *elsewhere_back; /* by sweeps back through the functions (sim/form/residual-adjoint.h) */
    bool shaken;
    double *in;         /* [3n + 1] inputs of the tape: q, q', t, q'' */
    double *out, *work; /* outputs and scratch of the tape */
    double *slopes; /* [outputs x (2n + 1)] derivatives of the tape by q, q', t; NULL: not needed */
    double *slopes_work;
    qdot_ode_mass_form mass_form; /* the equations as M y' = f for implicit methods */

    /* The reduced plan of a plan with ignorable coordinates; the reduced plan is the one that is integrated. */
    qdot_tape *reduced; /* copy of the reduced plan's tape with slightly perturbed constants; NULL: use its own tape */
    qdot_blocks reduced_blocks;
    qdot_momenta *momenta;

    /* For a plan whose equations decouple into parts: the bind and the equations of each part. */
    qdot_bind **parts;        /* [n_parts] the bind (equations ready for integration) of each decoupled part */
    qdot_ode_system *systems; /* [n_parts] the system of equations of each decoupled part */
    qdot_ode_part *listed;    /* [n_parts] the decoupled parts, as the integrator takes them */
    size_t *index;            /* [2n] component indices to which `listed` points */
    double *part_scales;      /* [2n] scales of the states of the parts, one part after another; NULL: all 1 */
    const double *scales;

    /* Of equations with delays: the history of the run that is integrated, borrowed, and callbacks of the series that read it. */
    qdot_past *history;
    qdot_ode_series remembering;
    qdot_knots knots;   /* the tables of data that the equations read at times, and their delays */
    double knot;        /* the knot of such a table that the step before this one was to end at the latest */
    qdot_pulses pulses; /* searches steps for forces shorter than a step, if the method has no series; made at first use */
};

/* The tape that computes M and f of M q'' = f. */
static inline const qdot_tape *
qdot_bind_equations(const qdot_bind *b)
{
    return b->tape ? b->tape : b->plan->tape;
}

/* Set the inputs of the tape to time t and state y [2n]. */
static inline void
qdot_bind_load(const qdot_bind *b, double t, const double *y)
{
    size_t n = b->plan->n;

    if (b->history)
        qdot_past_read(b->history);
    memcpy(b->in, y, 2 * n * sizeof *y);
    b->in[2 * n] = t;
}

/* Find the accelerations q'' at the loaded inputs, into a [n]. */
QDOT_MUST_CHECK qdot_status qdot_bind_accelerate(qdot_bind *b, double *a);

/* Evaluate the Jacobian of the system of differential equations (ode/system.h). */
qdot_status qdot_bind_jacobian(double t, const double *y, double *dfdy, double *dfdt,
                               void *user);

/* Allocate work space for Jacobians if the integration method, or that of its companion run, needs one. */
QDOT_MUST_CHECK qdot_status qdot_bind_make_slopes(qdot_bind *b);

#endif
