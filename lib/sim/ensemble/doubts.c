/* doubts.c -- decides whether an ensemble member must be repeated as a single run, by inspecting its steps. */
#include "sim/ensemble/doubts.h"

#include "base/memory.h"
#include "num/chebyshev.h"
#include "sim/model/constrained.h"

/* A member is run singly if less than this part of a constraint row is left, ten times what the
 * single run looks for. */
static const double left_of_row = 1e-2;

struct qdot_ensemble_doubts {
    const qdot_plan *plan;
    bool hides;             /* the equations may contain forces too short for a step to notice */
    qdot_pulses pulses;     /* search for short forces along the member's steps */
    qdot_constrained *held; /* constraints of the member; NULL: none */
};

static bool
plan_may_hide(const qdot_plan *plan)
{
    return plan->tape && qdot_disc_may_hide(plan->tape, QDOT_HIDES_EXPONENTIALS);
}

qdot_status
qdot_ensemble_doubts_new(const qdot_plan *plan, qdot_ensemble_doubts **doubts)
{
    qdot_ensemble_doubts *d;

    *doubts = NULL;
    if (!plan->constraints && !plan_may_hide(plan))
        return QDOT_OK;
    d = qdot_calloc(1, sizeof *d);
    if (!d)
        return QDOT_ENOMEM;
    d->plan = plan;
    d->hides = plan_may_hide(plan);
    *doubts = d;
    return QDOT_OK;
}

static void
clear_checks(qdot_ensemble_doubts *d)
{
    qdot_pulses_clear(&d->pulses);
    qdot_constrained_free(d->held);
    d->held = NULL;
}

void
qdot_ensemble_doubts_free(qdot_ensemble_doubts *d)
{
    if (!d)
        return;
    clear_checks(d);
    qdot_free(d);
}

qdot_status
qdot_ensemble_doubts_begin(qdot_ensemble_doubts *d)
{
    clear_checks(d);
    if (d->plan->constraints)
        QDOT_TRY(qdot_constrained_new(d->plan, false, &d->held));
    return d->hides ? qdot_pulses_init(&d->pulses, d->plan, d->plan->tape,
                                       QDOT_HIDES_EXPONENTIALS, QDOT_CHEBYSHEV_MOST)
                    : QDOT_OK;
}

qdot_status
qdot_ensemble_doubts_look(qdot_ensemble_doubts *d, qdot_pulses_step *step, bool *doubtful)
{
    size_t row;

    *doubtful = d->held
                && !(qdot_constrained_remains(d->held, step->a, step->from, &row) > left_of_row);
    if (!d->hides || *doubtful)
        return QDOT_OK;
    QDOT_TRY(qdot_pulses_look(&d->pulses, step));
    *doubtful = step->missed;
    return QDOT_OK;
}
