/* tables.h -- the tables of data (num/samples.h) that the equations of a plan read, whichever form of them is integrated:
 * M q'' = f, what cyclic coordinates leave of it, d'Alembert's residual, constraints.
 *
 * Tests  tests/script/data/forms.sh
 */
#ifndef QDOT_SIM_TABLES_H
#define QDOT_SIM_TABLES_H

#include "sim/model/equations.h"
#include "tape/knots.h"

enum { QDOT_PLAN_TAPES = 7 };

/* The tapes from which the equations of a plan are evaluated; NULL: the plan has no such form. Inputs are q, q', t; of the last
 * one, of a reduced plan, kept momenta behind these. */
void qdot_plan_tapes(const qdot_plan *plan, const qdot_tape *tapes[QDOT_PLAN_TAPES]);

/* Whether there are any. */
bool qdot_tables_any(const qdot_plan *plan);
/* qdot_tape_check_digits of all tapes of the equations. */
QDOT_MUST_CHECK qdot_status qdot_tables_check_digits(const qdot_plan *plan);

/* Append those that are read at a + b t (tape/knots.h). Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_tables_knots(const qdot_plan *plan, qdot_knots *knots);

/* The function given by data whose table a handle is of; NULL if it is not known. */
const char *qdot_tables_name(const qdot_plan *plan, double handle);

/* QDOT_EDOMAIN if a table has no values at t0 or t1, which is known before a run where the place of reading is a + b t. */
QDOT_MUST_CHECK qdot_status qdot_tables_reach(const qdot_plan *plan, double t0, double t1);

/* QDOT_ENOTBUILT if the equation of a coordinate without mass, such as the rate of a first-order state, jumps where a table goes
 * to its next piece: its velocity would have to jump there. Taylor series go over the jumps of `steps`. Told from tables of
 * steps, and from the values of the equations y [2n], moved a little, on both sides of the first knots from t0 on. */
QDOT_MUST_CHECK qdot_status qdot_tables_refuse_jumps(const qdot_plan *plan, const double *y, double t0, double t1);

/* Whether one is read at or beyond its end at in [3n + 1]: q, q', t and, of a reduced plan, its kept momenta
 * (qdot_knots_ended). */
bool qdot_tables_ended(const qdot_plan *plan, const double *in, double *handle, double *at);

#endif
