/* two.c -- functions of numbers that are sums of two doubles, for each kind of processor. */
#include "num/two.h"

#include <stdbool.h>
#include <pthread.h>

#include <mpfr.h>

#include "num/kinds.h"

enum { QUARTER = 512, POWERS = 64 }; /* table sizes: steps of an angle up to pi/2, steps of a power of two up to 2 */

/* For larger arguments three doubles of the table step are not enough to reduce the angle. */
static const double most_angle = 0x1p40;

/* the table steps pi/(2 QUARTER) and log(2)/POWERS, in three doubles each */
static double angle_step[3], power_step[3];
static qdot_two sines[QUARTER + 1], powers[POWERS];

static const qdot_two two_over_root_pi = {0x1.20dd750429b6dp+0, 0x1.1ae3a914fed8p-56};
static const qdot_two sixth = {0x1.5555555555555p-3, 0x1.5555555555555p-57};
static const qdot_two sixth_of_a_fourth = {0x1.5555555555555p-5, 0x1.5555555555555p-59};

static qdot_two
two_of_mpfr(mpfr_ptr x)
{
    qdot_two r = {mpfr_get_d(x, MPFR_RNDN), 0};

    mpfr_sub_d(x, x, r.hi, MPFR_RNDN);
    r.lo = mpfr_get_d(x, MPFR_RNDN);
    return r;
}

/* Split x into three doubles; x is overwritten. */
static void
split_in_three(mpfr_ptr x, double *part)
{
    for (int i = 0; i < 3; i++) {
        part[i] = mpfr_get_d(x, MPFR_RNDN);
        mpfr_sub_d(x, x, part[i], MPFR_RNDN);
    }
}

static void
fill_tables(void)
{
    mpfr_t step, x, s, c, s1, c1;

    mpfr_inits2(256, step, x, s, c, s1, c1, (mpfr_ptr)0);
    mpfr_const_pi(step, MPFR_RNDN);
    mpfr_div_ui(step, step, 2 * QUARTER, MPFR_RNDN);
    mpfr_sin_cos(s1, c1, step, MPFR_RNDN);
    mpfr_set_zero(s, 1);
    mpfr_set_ui(c, 1, MPFR_RNDN);
    for (unsigned i = 0; i < QUARTER; i++) { /* compute the sine and cosine of the next angle */
        mpfr_set(x, s, MPFR_RNDN);
        sines[i] = two_of_mpfr(x);
        mpfr_fmma(x, s, c1, c, s1, MPFR_RNDN);
        mpfr_fmms(c, c, c1, s, s1, MPFR_RNDN);
        mpfr_swap(s, x);
    }
    sines[QUARTER] = (qdot_two){1, 0};
    split_in_three(step, angle_step);
    for (unsigned i = 0; i < POWERS; i++) {
        mpfr_set_d(x, (double)i / POWERS, MPFR_RNDN);
        mpfr_exp2(x, x, MPFR_RNDN);
        powers[i] = two_of_mpfr(x);
    }
    mpfr_const_log2(step, MPFR_RNDN);
    mpfr_div_ui(step, step, POWERS, MPFR_RNDN);
    split_in_three(step, power_step);
    mpfr_clears(step, x, s, c, s1, c1, (mpfr_ptr)0);
    mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE);
}

static pthread_once_t once = PTHREAD_ONCE_INIT;

/* Evaluate sine and cosine by MPFR, for angles too large for `reduce`. */
static void
sincos_beyond(qdot_two x, qdot_two *sine, qdot_two *cosine)
{
    mpfr_t s, c;

    if (!isfinite(x.hi)) {
        *sine = *cosine = (qdot_two){NAN, NAN};
        return;
    }
    mpfr_inits2(256, s, c, (mpfr_ptr)0);
    mpfr_set_d(s, x.hi, MPFR_RNDN);
    mpfr_add_d(s, s, x.lo, MPFR_RNDN);
    mpfr_sin_cos(s, c, s, MPFR_RNDN);
    *sine = two_of_mpfr(s);
    *cosine = two_of_mpfr(c);
    mpfr_clears(s, c, (mpfr_ptr)0);
}

#define NAME(x) portable_##x
#include "num/two.def"
#undef NAME

#ifdef QDOT_X86_KINDS
QDOT_KIND_AVX2
#define NAME(x) fma_##x
#include "num/two.def"
#undef NAME
QDOT_KIND_END
#endif

const qdot_two_functions *
qdot_two_functions_at(size_t i)
{
    pthread_once(&once, fill_tables);
    if (i == 0)
        return &portable_functions;
#ifdef QDOT_X86_KINDS
    if (i == 1 && qdot_kind_is_here(1))
        return &fma_functions;
#endif
    return NULL;
}

const qdot_two_functions *
qdot_two_functions_get(void)
{
    const qdot_two_functions *best = qdot_two_functions_at(1);

    return best ? best : qdot_two_functions_at(0);
}

const qdot_two_kernels *
qdot_two_kernels_at(size_t i)
{
    if (i == 0)
        return &portable_kernels;
#ifdef QDOT_X86_KINDS
    if (i == 1 && qdot_kind_is_here(1))
        return &fma_kernels;
#endif
    return NULL;
}

const qdot_two_kernels *
qdot_two_kernels_get(void)
{
    const qdot_two_kernels *best = qdot_two_kernels_at(1);

    return best ? best : qdot_two_kernels_at(0);
}
