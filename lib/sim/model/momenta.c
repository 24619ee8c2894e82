/* momenta.c -- entering a solution in twice the precision of a double; velocities from the
 * tape. */
#include "sim/model/momenta.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "series/precise.h"

/* The precision of momenta in MPFR, in bits: two doubles, plus the digits that their terms may cancel. */
enum { bits = 256 };

struct qdot_momenta {
    const qdot_plan *plan;
    qdot_momenta_tape equations;
    qdot_precise *precise;
    qdot_ode_following following;
    size_t *index;   /* [n_kept] indices of the velocities in a state */
    double *hi, *lo; /* [n_kept] conserved momenta, kept as hi + lo */
    bool entered;
    double t, *y; /* time and state [2n] from which the conserved momenta were computed */
};

static qdot_status
compute_momenta_of_start(double t, const double *y, const double *carry, void *user)
{
    qdot_momenta *m = user;
    const size_t n = 2 * m->plan->n;

    if (m->entered && t == m->t && memcmp(y, m->y, n * sizeof *y) == 0)
        return QDOT_OK;
    m->entered = false;
    for (size_t i = 0; i < n; i++) {
        mpfr_t *x = qdot_precise_input(m->precise, i);

        mpfr_set_d(*x, y[i], MPFR_RNDN);
        if (carry)
            mpfr_add_d(*x, *x, carry[i], MPFR_RNDN);
    }
    mpfr_set_d(*qdot_precise_input(m->precise, n), t, MPFR_RNDN);
    qdot_precise_order(m->precise, 0);
    for (size_t k = 0; k < m->plan->n_kept; k++) {
        mpfr_srcptr p = *qdot_precise_output(m->precise, k);

        m->hi[k] = mpfr_get_d(p, MPFR_RNDN);
        if (!isfinite(m->hi[k]))
            return qdot_fail(QDOT_EDOMAIN, "the momentum of %s is undefined",
                             m->plan->names[m->plan->kept[k]]);
    }
    /* compute the low part last: outputs may share registers with inputs */
    for (size_t k = 0; k < m->plan->n_kept; k++) {
        mpfr_t rest;

        mpfr_init2(rest, bits);
        mpfr_sub_d(rest, *qdot_precise_output(m->precise, k), m->hi[k], MPFR_RNDN);
        m->lo[k] = mpfr_get_d(rest, MPFR_RNDN);
        mpfr_clear(rest);
    }
    mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); /* release MPFR's cache, as this thread may end with the run */
    m->t = t;
    memcpy(m->y, y, n * sizeof *y);
    m->entered = true;
    return QDOT_OK;
}

qdot_status
qdot_momenta_tape_init(qdot_momenta_tape *e, const qdot_plan *reduced, const qdot_tape *tape)
{
    *e = (qdot_momenta_tape){.plan = reduced, .tape = tape};
    e->in = qdot_calloc(qdot_tape_inputs(tape) + 1, sizeof *e->in);
    e->out = qdot_calloc(qdot_tape_outputs(tape) + 1, sizeof *e->out);
    e->work = qdot_calloc(qdot_tape_work(tape) + 1, sizeof *e->work);
    return e->in && e->out && e->work ? QDOT_OK : QDOT_ENOMEM;
}

void
qdot_momenta_tape_clear(qdot_momenta_tape *e)
{
    qdot_free(e->in);
    qdot_free(e->out);
    qdot_free(e->work);
}

const double *
qdot_momenta_rates(qdot_momenta_tape *e, double t, const double *y, const double *p)
{
    const size_t n = 2 * e->plan->n;

    memcpy(e->in, y, n * sizeof *y);
    e->in[n] = t;
    memcpy(e->in + n + 1, p, e->plan->n_kept * sizeof *p);
    qdot_tape_eval(e->tape, e->in, e->out, e->work);
    return e->out + qdot_tape_outputs(e->tape) - e->plan->n_kept;
}

static qdot_status
compute_velocities(double t, double *y, void *user)
{
    qdot_momenta *m = user;
    const qdot_plan *p = m->plan;
    const double *rates = qdot_momenta_rates(&m->equations, t, y, m->hi);

    for (size_t k = 0; k < p->n_kept; k++) {
        if (!isfinite(rates[k]))
            return qdot_fail(QDOT_EDOMAIN, "the velocity of %s is undefined",
                             p->names[p->kept[k]]);
        y[m->index[k]] = rates[k];
    }
    return QDOT_OK;
}

static qdot_status
make_conversion(qdot_momenta *m, const qdot_tape *tape)
{
    const qdot_plan *p = m->plan;

    QDOT_TRY(qdot_momenta_tape_init(&m->equations, p, tape));
    QDOT_TRY(qdot_precise_new(p->pool, p->momenta, 0, bits, &m->precise));
    m->index = qdot_calloc(p->n_kept, sizeof *m->index);
    m->hi = qdot_calloc(2 * p->n_kept, sizeof *m->hi);
    m->y = qdot_calloc(2 * p->n, sizeof *m->y);
    if (!m->index || !m->hi || !m->y)
        return QDOT_ENOMEM;
    m->lo = m->hi + p->n_kept;
    for (size_t k = 0; k < p->n_kept; k++)
        m->index[k] = p->n + p->kept[k];
    m->following = (qdot_ode_following){.n = p->n_kept,
                                        .index = m->index,
                                        .enter = compute_momenta_of_start,
                                        .derive = compute_velocities,
                                        .user = m};
    return QDOT_OK;
}

qdot_status
qdot_momenta_new(const qdot_plan *reduced, const qdot_tape *tape, qdot_momenta **momenta)
{
    qdot_momenta *m = qdot_calloc(1, sizeof *m);
    qdot_status status;

    *momenta = NULL;
    if (!m)
        return QDOT_ENOMEM;
    m->plan = reduced;
    status = make_conversion(m, tape);
    if (status != QDOT_OK) {
        qdot_momenta_free(m);
        return status;
    }
    *momenta = m;
    return QDOT_OK;
}

void
qdot_momenta_free(qdot_momenta *m)
{
    if (!m)
        return;
    qdot_precise_free(m->precise);
    qdot_free(m->index);
    qdot_free(m->hi);
    qdot_free(m->y);
    qdot_momenta_tape_clear(&m->equations);
    qdot_free(m);
}

const qdot_ode_following *
qdot_momenta_following(const qdot_momenta *m)
{
    return &m->following;
}

const double *
qdot_momenta_hi(const qdot_momenta *m)
{
    return m->hi;
}

const double *
qdot_momenta_lo(const qdot_momenta *m)
{
    return m->lo;
}
