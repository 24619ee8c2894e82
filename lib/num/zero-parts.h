/* zero-parts.h -- the state of a search for a zero, shared by the files zero-*.c. */
#ifndef QDOT_NUM_ZERO_PARTS_H
#define QDOT_NUM_ZERO_PARTS_H

#include <gsl/gsl_linalg.h>

#include "num/zero.h"

typedef struct {
    const qdot_zero_problem *p;
    qdot_zero_result *r;
    double *slope;             /* [m x n] the derivatives J of F at r->u */
    double *u, *f, *error;     /* [n], [m], [m] the end point of a step; F at this point and its error */
    double *trial;             /* [n] scratch: a trial point */
    double *unit, *unit_f;     /* [n], [m] scale of each unknown and of each function */
    double *small;             /* [m] a function smaller than this may count as 0 */
    double mu, length; /* damping parameter of the step, and its length in units of the unknowns */
    double strongest;          /* largest singular value of J during the search */
    double damping;            /* how strongly |F| shortens steps; 0: only `reach` does */
    /* the search ended because |F| did not halve in the number of steps allowed for that */
    bool gave_up;
    double order;              /* estimated order of the zero, from the last steps */
    double *last_u, *last; /* [n] the point at which `order` was estimated last, and `whole` at that point */
    bool has_last;             /* whether last_u and last are set */
    double reach;              /* the longest step allowed where J is nearly singular */
    double *step, *whole;      /* [n] the step taken, and the full Newton step without damping (mu = 0) */
    double *from_error;        /* [n] the change of the step caused by the errors of F */
    gsl_matrix *U, *V;
    gsl_vector *singular, *work;
} qdot_zero_search;

/* --- steps of the search (zero-step.c) --- */

/* Evaluate the function F, its errors and its Jacobian J at r->u. */
QDOT_MUST_CHECK qdot_status qdot_zero_evaluate(qdot_zero_search *s);
/* The value u of the j-th unknown, moved to the nearer bound if it lies outside its bounds. */
double qdot_zero_within(const qdot_zero_problem *p, size_t j, double u);
/* The norm of the function values f, each measured in its own unit. */
double qdot_zero_norm(const qdot_zero_search *s, const double *f);
/* Choose units of the unknowns and of the functions from the Jacobian J at r->u. */
void qdot_zero_choose_units(qdot_zero_search *s);
/* Whether |F| fell, from r->f to f along the fraction `part` of the step, by at least half of what
 * J predicts. */
bool qdot_zero_is_predicted(const qdot_zero_search *s, const double *f, double part);
/* Compute the Newton step [n] for values f [m] with the present Jacobian; returns its length in units of the unknowns. */
double qdot_zero_take_step(const qdot_zero_search *s, const double *f, double *step);
/* Find the step, the errors of the unknowns and the rank of J. False: J is 0 to rounding, or not finite. */
bool qdot_zero_find_step(qdot_zero_search *s);
/* Whether all function values f [m] are 0 within their errors [m] and rounding. */
bool qdot_zero_is_within_errors(const qdot_zero_search *s, const double *f, const double *error);
/* Whether the Newton step is so small that errors of F and rounding can explain it. */
bool qdot_zero_step_is_nothing(const qdot_zero_search *s);
/* Whether F is 0 within its errors and rounding of u, which are small beside what F was at the guess, or beside what
 * it is made of: where the last bit of u moves F by as much as the guess was off, nothing is found. */
bool qdot_zero_is_zero(const qdot_zero_search *s);
/* Estimate the order (multiplicity) of the zero from the last two positions. */
void qdot_zero_estimate_order(qdot_zero_search *s);
/* Compute the errors of the unknowns; a zero with large errors is called vague. */
void qdot_zero_state_errors(qdot_zero_search *s);

/* --- zero-search.c, zero-between.c, zero-family.c --- */

/* Search by Newton's method from the guess; if that fails, from points around it. */
QDOT_MUST_CHECK qdot_status qdot_zero_descend(qdot_zero_search *s);
/* Find a zero of one function of one unknown between bounds. */
QDOT_MUST_CHECK qdot_status qdot_zero_find_between(qdot_zero_search *s);
/* Of a zero that J leaves open in some directions: are these directions of a family? Those of an isolated zero are
 * added to the rank. */
QDOT_MUST_CHECK qdot_status qdot_zero_verify_family(qdot_zero_search *s);

#endif
