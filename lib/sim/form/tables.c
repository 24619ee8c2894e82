/* tables.c -- asks each tape that a plan's equations are evaluated from for the tables of data it reads. */
#include "sim/form/tables.h"

#include "sim/form/residual.h"
#include "sim/model/constraints.h"

enum { TAPES = 6 };

/* The tapes of a plan; NULL: the plan has no such form. Inputs are q, q', t; of the last one kept momenta behind these. */
static void
tapes_of_plan(const qdot_plan *p, const qdot_tape *tapes[TAPES])
{
    tapes[0] = p->tape;
    tapes[1] = p->residual ? p->residual->places : NULL;
    tapes[2] = p->residual ? p->residual->forces : NULL;
    tapes[3] = p->constraints ? p->constraints->positions : NULL;
    tapes[4] = p->constraints ? p->constraints->velocities : NULL;
    tapes[5] = p->reduced ? p->reduced->tape : NULL;
}

bool
qdot_tables_any(const qdot_plan *plan)
{
    const qdot_tape *tapes[TAPES];

    tapes_of_plan(plan, tapes);
    for (size_t k = 0; k < TAPES; k++)
        if (tapes[k] && qdot_knots_any(tapes[k]))
            return true;
    return false;
}

qdot_status
qdot_tables_knots(const qdot_plan *plan, qdot_knots *knots)
{
    const qdot_tape *tapes[TAPES];

    tapes_of_plan(plan, tapes);
    for (size_t k = 0; k < TAPES; k++)
        if (tapes[k])
            QDOT_TRY(qdot_knots_find(tapes[k], 2 * plan->n, knots));
    return QDOT_OK;
}

bool
qdot_tables_ended(const qdot_plan *plan, const double *in, double *handle, double *at)
{
    const qdot_tape *tapes[TAPES];

    tapes_of_plan(plan, tapes);
    for (size_t k = 0; k < TAPES - 1; k++) /* what a reduced plan reads the whole one reads */
        if (tapes[k] && qdot_knots_ended(tapes[k], in, handle, at))
            return true;
    return false;
}
