/* precise-pair.c -- reads points and states of a run in MPFR, and constants of its plan. */
#include "sim/digits/precise-pair.h"

#include <float.h>
#include <math.h>

#include "expr/constant.h"

qdot_status
qdot_precise_constant(const qdot_plan *plan, qdot_expr e, mpfr_ptr x)
{
    e = qdot_plan_substitute(plan, e);
    QDOT_TRY(qdot_pool_check(plan->pool));
    return qdot_constant_real(plan->pool, e, x);
}

mpfr_t *
qdot_precise_first(const qdot_precise_side *s)
{
    return qdot_precise_point(&s->segments.at[0].run, 0);
}

mpfr_t *
qdot_precise_last(const qdot_precise_side *s)
{
    const qdot_precise_run *run = &s->segments.at[s->segments.n - 1].run;

    return qdot_precise_point(run, run->count - 1);
}

size_t
qdot_precise_segment_at(const qdot_precise_side *s, mpfr_srcptr t)
{
    size_t low = 0, high = s->segments.n;
    int way = mpfr_less_p(qdot_precise_last(s)[0], qdot_precise_first(s)[0]) ? -1 : 1;

    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;

        if (way * mpfr_cmp(t, qdot_precise_point(&s->segments.at[middle].run, 0)[0]) >= 0)
            low = middle;
        else
            high = middle;
    }
    return low;
}

qdot_status
qdot_precise_state_in(qdot_precise_side *s, size_t segment, mpfr_srcptr t, mpfr_t *y)
{
    const qdot_precise_segment *at = &s->segments.at[segment];

    if (segment != s->near_segment)
        s->near = SIZE_MAX;
    s->near_segment = segment;
    return qdot_precise_at(&at->run, qdot_precise_bind_system(s->binds[at->mode]), t,
                           &s->near, y);
}

qdot_status
qdot_precise_state(qdot_precise_side *s, mpfr_srcptr t, mpfr_t *y)
{
    return qdot_precise_state_in(s, qdot_precise_segment_at(s, t), t, y);
}

qdot_status
qdot_precise_evaluate(qdot_precise_side *s, size_t mode, const qdot_plan *plan,
                      qdot_precise *program, bool accelerations, mpfr_srcptr t,
                      const mpfr_t *y)
{
    qdot_precise_bind *bind = s->binds[mode];
    const qdot_precise_system *system = qdot_precise_bind_system(bind);
    const size_t n = plan->n;

    for (size_t i = 0; i < 2 * n; i++)
        mpfr_set(qdot_precise_input(program, i)[0], y[i], MPFR_RNDN);
    mpfr_set(qdot_precise_input(program, 2 * n)[0], t, MPFR_RNDN);
    if (accelerations) {
        s->near = SIZE_MAX;
        QDOT_TRY(system->begin(t, y, system->user));
        for (size_t i = 0; i < n; i++)
            mpfr_set(qdot_precise_input(program, 2 * n + 1 + i)[0],
                     qdot_precise_bind_acceleration(bind, i), MPFR_RNDN);
        for (size_t k = 0; k < plan->m; k++)
            qdot_precise_bind_multiplier(bind, k,
                                         qdot_precise_input(program, 3 * n + 1 + k)[0]);
    }
    qdot_precise_order(program, 0);
    return QDOT_OK;
}

double
qdot_precise_power(double x)
{
    mpfr_t power; /* computed by MPFR, as the C libraries' results differ */
    double r;

    if (isnan(x))
        return NAN;
    mpfr_init2(power, DBL_MANT_DIG);
    mpfr_set_d(power, x, MPFR_RNDN);
    mpfr_exp10(power, power, MPFR_RNDN);
    r = mpfr_get_d(power, MPFR_RNDN);
    mpfr_clear(power);
    return fmax(r, DBL_MIN);
}
