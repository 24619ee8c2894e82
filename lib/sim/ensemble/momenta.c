/* momenta.c -- finds momenta from velocities by a double-double tape, velocities from momenta by the equations. */
#include "sim/ensemble/momenta.h"

#include <math.h>

#include "base/memory.h"
#include "sim/model/momenta.h"
#include "series/two.h"

struct qdot_ensemble_momenta {
    const qdot_plan *plan;
    qdot_tape_two *momenta;
    qdot_momenta_tape equations;
};

static qdot_status
make_conversion(qdot_ensemble_momenta *x)
{
    const qdot_plan *p = x->plan;

    QDOT_TRY(qdot_tape_two_new(p->momenta, 0, 2 * p->n + 1, &x->momenta));
    return qdot_momenta_tape_init(&x->equations, p, p->tape);
}

qdot_status
qdot_ensemble_momenta_new(const qdot_plan *reduced, qdot_ensemble_momenta **out)
{
    qdot_ensemble_momenta *x = qdot_calloc(1, sizeof *x);
    qdot_status status;

    *out = NULL;
    if (!x)
        return QDOT_ENOMEM;
    x->plan = reduced;
    status = make_conversion(x);
    if (status != QDOT_OK) {
        qdot_ensemble_momenta_free(x);
        return status;
    }
    *out = x;
    return QDOT_OK;
}

void
qdot_ensemble_momenta_free(qdot_ensemble_momenta *x)
{
    if (!x)
        return;
    qdot_tape_two_free(x->momenta);
    qdot_momenta_tape_clear(&x->equations);
    qdot_free(x);
}

bool
qdot_ensemble_momenta_enter(qdot_ensemble_momenta *x, double t, const double *y,
                            double *p)
{
    const size_t n = 2 * x->plan->n;
    bool finite = true;

    for (size_t i = 0; i <= n; i++)
        *qdot_tape_two_input(x->momenta, i) = (qdot_two){i < n ? y[i] : t, 0};
    qdot_tape_two_order(x->momenta, 0);
    for (size_t k = 0; k < x->plan->n_kept; k++) {
        p[k] = qdot_tape_two_output(x->momenta, k)->hi;
        finite = finite && isfinite(p[k]);
    }
    return finite;
}

void
qdot_ensemble_momenta_derive(qdot_ensemble_momenta *x, double t, const double *p,
                             double *y)
{
    const qdot_plan *r = x->plan;
    const double *rates = qdot_momenta_rates(&x->equations, t, y, p);

    for (size_t k = 0; k < r->n_kept; k++)
        y[r->n + r->kept[k]] = rates[k];
}
