/* momentum-rows.c -- writes conserved momenta, randomly rounded, into rows; copies velocities from
 * their rows. */
#include "sim/form/momentum-rows.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* A momentum: its first double, the next one on the side of its second, and the chance of
 * that. */
struct qdot_momentum {
    double hi, lo, far, chance;
};

qdot_status
qdot_momentum_rows_init(qdot_momentum_rows *m, const qdot_plan *plan, qdot_expansion at,
                        bool shaken)
{
    const size_t kept = plan->n_kept,
                 first = kept > 0 ? qdot_tape_outputs(plan->tape) - kept : 0;

    *m = (qdot_momentum_rows){.plan = plan, .at = at, .shaken = shaken};
    m->drawn = qdot_calloc(kept + 1, sizeof *m->drawn);
    m->rates = qdot_calloc(kept + 1, sizeof *m->rates);
    if (!m->drawn || !m->rates)
        return QDOT_ENOMEM;
    for (size_t c = 0; c < kept; c++)
        m->rates[c] = qdot_taylor_output(at.taylor, first + c);
    return QDOT_OK;
}

void
qdot_momentum_rows_clear(qdot_momentum_rows *m)
{
    qdot_free(m->drawn);
    qdot_free(m->rates);
    *m = (qdot_momentum_rows){0};
}

void
qdot_momentum_rows_draw(qdot_momentum_rows *m, double t)
{
    const size_t n = m->plan->n;

    for (size_t c = 0; m->hi && c < m->plan->n_kept; c++) {
        qdot_momentum *p = m->drawn + c;
        double *to = m->at.t + (c + 1) * m->at.stride;

        *to = m->hi[c];
        if (m->shaken || m->lo[c] == 0)
            continue;
        if (p->hi != m->hi[c] || p->lo != m->lo[c]) {
            *p = (qdot_momentum){.hi = m->hi[c], .lo = m->lo[c]};
            p->far = nextafter(p->hi, p->lo > 0 ? INFINITY : -INFINITY);
            p->chance = p->lo / (p->far - p->hi);
        }
        if (qdot_taylor_chance(t, n + c) < p->chance)
            *to = p->far;
    }
}

void
qdot_momentum_rows_show(const qdot_momentum_rows *m, int p)
{
    for (size_t c = 0; c < m->plan->n_kept; c++) {
        double *v = m->at.v + m->plan->kept[c] * m->at.stride;

        memcpy(v, m->rates[c], (size_t)p * sizeof *v);
        v[p] = 0;
    }
}

qdot_status
qdot_momentum_rows_check(const qdot_momentum_rows *m)
{
    for (size_t c = 0; c < m->plan->n_kept; c++)
        if (!isfinite(m->rates[c][0]))
            return qdot_fail(QDOT_EDOMAIN, "the velocity of %s is undefined",
                             m->plan->names[m->plan->kept[c]]);
    return QDOT_OK;
}
