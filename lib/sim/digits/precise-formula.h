/* precise-formula.h -- expressions along a run with `digits`, and their roots; for precise-course.c. */
#ifndef QDOT_SIM_PRECISE_FORMULA_H
#define QDOT_SIM_PRECISE_FORMULA_H

#include "sim/digits/precise-hold.h"
#include "sim/digits/precise-pair.h"

/* Value of formula.event if the formula is the time derivative of the event's function. */
#define QDOT_PRECISE_RATE (SIZE_MAX - 1)

/* An expression evaluated in MPFR (multiple precision). */
typedef struct {
    size_t mode, function; /* index of the mode and its watched function; SIZE_MAX: the `then` of an event */
    size_t event;
    bool accelerations;
    qdot_precise *program;
} qdot_precise_formula;

struct qdot_precise_course {
    qdot_vec(qdot_precise_formula) formulas;
    qdot_vec(qdot_precise_hold *) holds; /* [modes] projections, for modes with constraints and changes; else NULL */
    bool *set;                           /* [2n] which components of the state an event has set */
    size_t *segment_of; /* [pieces of the run in doubles] the segment of each piece */
    qdot_reals numbers; /* memory for t, y [2n], old state [2n], and the root search */
    mpfr_t *y, *old, *at;
};

enum { LO, HI, F_LO, F_HI, X, F_X, W, BEFORE, SPEED, SPEED_BEFORE, FLIGHT, BEGAN, PROBE, NOISE, NUMBERS };

/* Evaluate the formula at the state y of time t; the result is its output 0. */
QDOT_MUST_CHECK qdot_status qdot_precise_formula_evaluate(qdot_precise_side *s, const qdot_precise_formula *f, size_t mode,
                                                          mpfr_srcptr t, const mpfr_t *y);

/* Evaluate the formula f at time t of a segment into out; the state goes to s->course->y. */
QDOT_MUST_CHECK qdot_status qdot_precise_formula_at(qdot_precise_side *s, size_t segment, const qdot_precise_formula *f,
                                                    mpfr_srcptr t, mpfr_ptr out);

/* The root of f between at[LO] and at[HI], into at[X]; *found: f changes its sign there. Where a motion crosses it flatly,
 * rounding of the state, which the run and its companion may share, hides the root: the companion takes the end of that. */
QDOT_MUST_CHECK qdot_status qdot_precise_find_root(qdot_precise_side *s, size_t segment, const qdot_precise_formula *f,
                                                   bool *found);

/* Find the root of the formula f within `by` of t on a segment, into at[X]; *found: f changes its sign there. */
QDOT_MUST_CHECK qdot_status qdot_precise_locate(qdot_precise_side *s, size_t segment, const qdot_precise_formula *f, double t,
                                                double by, bool *found);

#endif
