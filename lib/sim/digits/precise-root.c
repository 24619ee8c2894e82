/* precise-root.c -- finds a root of a function of the motion along a segment of a run with `digits`. */
#include "sim/digits/precise-formula.h"

#include <math.h>

#include "base/interrupt.h"
#include "sim/digits/precise.h"

#define RN MPFR_RNDN

enum { MOST_TRIES = 2000 };

qdot_status
qdot_precise_formula_evaluate(qdot_precise_side *s, const qdot_precise_formula *f, size_t mode, mpfr_srcptr t, const mpfr_t *y)
{
    return qdot_precise_evaluate(s, mode, s->guide->stage->modes.at[mode]->plan, f->program, f->accelerations,
                                 t, y);
}

qdot_status
qdot_precise_formula_at(qdot_precise_side *s, size_t segment, const qdot_precise_formula *f, mpfr_srcptr t,
         mpfr_ptr out)
{
    QDOT_TRY(qdot_precise_state_in(s, segment, t, s->course->y));
    QDOT_TRY(qdot_precise_formula_evaluate(s, f, s->segments.at[segment].mode, t,
                              (const mpfr_t *)s->course->y));
    mpfr_set(out, qdot_precise_output(f->program, 0)[0], RN);
    return mpfr_number_p(out) ? QDOT_OK : qdot_fail(QDOT_EDOMAIN, "it has no value there");
}

/* Set a bracket around t, from at[LO] to at[HI], within the segment of the run. */
static void
set_bracket(const qdot_precise_side *s, size_t segment, double t, double by)
{
    const qdot_precise_run *run = &s->segments.at[segment].run;
    mpfr_t *at = s->course->at;
    mpfr_srcptr first = qdot_precise_point(run, 0)[0];
    mpfr_srcptr last = qdot_precise_point(run, run->count - 1)[0];
    int way = mpfr_less_p(last, first) ? -1 : 1;

    mpfr_set_d(at[LO], t, RN);
    mpfr_set(at[HI], at[LO], RN);
    mpfr_set_d(at[W], way * by, RN);
    mpfr_sub(at[LO], at[LO], at[W], RN);
    mpfr_add(at[HI], at[HI], at[W], RN);
    if (way * mpfr_cmp(at[LO], first) < 0)
        mpfr_set(at[LO], first, RN);
    if (way * mpfr_cmp(at[HI], last) > 0)
        mpfr_set(at[HI], last, RN);
}

/* Whether f, whose sign differs at at[LO] and at[HI], changes its sign within 2^log2_by of at[X]. */
static qdot_status
has_sign_change_near(qdot_precise_side *s, size_t segment, const qdot_precise_formula *f, double log2_by, bool *is)
{
    mpfr_t *at = s->course->at;
    int sign[2];

    for (int side = 0; side < 2; side++) {
        const int end = side == 0 ? LO : HI, way = mpfr_cmp(at[HI], at[LO]) > 0 ? 2 * side - 1 : 1 - 2 * side;

        mpfr_set_d(at[W], way, RN);
        mpfr_mul_2si(at[W], at[W], (mpfr_exp_t)ceil(log2_by), RN);
        mpfr_add(at[W], at[W], at[X], RN);
        if (way * mpfr_cmp(at[W], at[end]) < 0)
            QDOT_TRY(qdot_precise_formula_at(s, segment, f, at[W], at[PROBE]));
        else
            mpfr_set(at[PROBE], at[end == LO ? F_LO : F_HI], RN);
        sign[side] = mpfr_sgn(at[PROBE]);
    }
    *is = sign[0] * sign[1] <= 0;
    return QDOT_OK;
}

/* The root of f between at[LO] and at[HI], into at[X]; *found: f changes its sign there. Where f is flat the steps of the
 * secant shrink long before the root: then the rest is bisected. */
static qdot_status
find_sign_change(qdot_precise_side *s, size_t segment, const qdot_precise_formula *f, bool *found)
{
    mpfr_t *at = s->course->at;
    const double t = mpfr_get_d(at[LO], RN);
    bool halves = false;
    int stayed = 0;
    double least;

    QDOT_TRY(qdot_precise_formula_at(s, segment, f, at[LO], at[F_LO]));
    QDOT_TRY(qdot_precise_formula_at(s, segment, f, at[HI], at[F_HI]));
    *found = mpfr_sgn(at[F_LO]) * mpfr_sgn(at[F_HI]) <= 0
             && (mpfr_sgn(at[F_LO]) || mpfr_sgn(at[F_HI]));
    if (!*found)
        return QDOT_OK;
    least = fmax(0, log2(fabs(t) + 1)) + 6 - (double)s->start.bits;
    mpfr_set(at[BEFORE], at[LO], RN);
    for (int tries = 0; tries < MOST_TRIES; tries++) {
        QDOT_TRY(qdot_interrupt_check());
        mpfr_sub(at[X], at[HI], at[LO], RN);
        if (halves || tries % 8 == 7) {
            mpfr_div_2ui(at[X], at[X], 1, RN);
        } else {
            mpfr_sub(at[W], at[F_HI], at[F_LO], RN);
            mpfr_mul(at[X], at[X], at[F_LO], RN);
            mpfr_div(at[X], at[X], at[W], RN);
            mpfr_neg(at[X], at[X], RN);
        }
        mpfr_add(at[X], at[X], at[LO], RN);
        QDOT_TRY(qdot_precise_formula_at(s, segment, f, at[X], at[F_X]));
        mpfr_sub(at[W], at[X], at[BEFORE], RN);
        if (mpfr_zero_p(at[F_X]))
            return QDOT_OK;
        if (qdot_real_log2(at[W]) <= least) {
            bool within = halves;

            if (!halves)
                QDOT_TRY(has_sign_change_near(s, segment, f, least, &within));
            if (within)
                return QDOT_OK;
            halves = true;
        }
        mpfr_set(at[BEFORE], at[X], RN);
        if (mpfr_sgn(at[F_X]) == mpfr_sgn(at[F_HI])) {
            mpfr_swap(at[HI], at[X]);
            mpfr_swap(at[F_HI], at[F_X]);
            if (stayed == 1)
                mpfr_div_2ui(at[F_LO], at[F_LO], 1, RN);
            stayed = 1;
        } else {
            mpfr_swap(at[LO], at[X]);
            mpfr_swap(at[F_LO], at[F_X]);
            if (stayed == -1)
                mpfr_div_2ui(at[F_HI], at[F_HI], 1, RN);
            stayed = -1;
        }
    }
    mpfr_set(at[X], at[LO], RN);
    return QDOT_OK;
}

/* Find how much rounding of the state at time at[X] changes f, into at[NOISE]. */
static qdot_status
find_rounding_effect(qdot_precise_side *s, size_t segment, const qdot_precise_formula *f)
{
    mpfr_t *at = s->course->at, *y = s->course->y;
    const size_t mode = s->segments.at[segment].mode;

    mpfr_set_zero(at[NOISE], 1);
    QDOT_TRY(qdot_precise_formula_at(s, segment, f, at[X], at[PROBE]));
    for (size_t k = 0; k < s->guide->tr.n; k++) {
        mpfr_set(at[W], y[k], RN);
        mpfr_nextabove(y[k]);
        QDOT_TRY(qdot_precise_formula_evaluate(s, f, mode, at[X], (const mpfr_t *)y));
        mpfr_set(y[k], at[W], RN);
        mpfr_sub(at[W], qdot_precise_output(f->program, 0)[0], at[PROBE], RN);
        mpfr_abs(at[W], at[W], RN);
        if (mpfr_number_p(at[W]))
            mpfr_add(at[NOISE], at[NOISE], at[W], RN);
    }
    return QDOT_OK;
}

qdot_status
qdot_precise_find_root(qdot_precise_side *s, size_t segment, const qdot_precise_formula *f, bool *found)
{
    enum { LEAST = 12 }; /* number of extra digits that suffices for a few roundings */
    mpfr_t *at = s->course->at;
    mpfr_exp_t by = LEAST - (mpfr_exp_t)s->start.bits;

    QDOT_TRY(find_sign_change(s, segment, f, found));
    if (!*found || s->domains)
        return QDOT_OK;
    QDOT_TRY(find_rounding_effect(s, segment, f));
    mpfr_set(at[BEFORE], at[X], RN);
    for (; by < 0; by++) {
        mpfr_set_ui_2exp(at[X], 1, by, RN);
        mpfr_add(at[X], at[X], at[BEFORE], RN);
        if (mpfr_cmpabs(at[X], at[BEFORE]) == 0)
            continue;
        QDOT_TRY(qdot_precise_formula_at(s, segment, f, at[X], at[PROBE]));
        if (mpfr_cmpabs(at[PROBE], at[NOISE]) > 0)
            break;
    }
    if (by == LEAST - (int64_t)s->start.bits)
        mpfr_set(at[X], at[BEFORE], RN);
    return QDOT_OK;
}

qdot_status
qdot_precise_locate(qdot_precise_side *s, size_t segment, const qdot_precise_formula *f, double t, double by,
       bool *found)
{
    set_bracket(s, segment, t, by);
    return qdot_precise_find_root(s, segment, f, found);
}
