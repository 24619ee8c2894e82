/* taylor-alike.c -- carries out the orders of a motion of like parts. */
#include "series/taylor-alike.h"

#include <math.h>
#include <string.h>

#include "num/kinds.h"
#include "series/near.h"
#include "series/taylor-motion.h"
#include "series/taylor-steps.h"
#include "series/taylor-wide.h"

enum {
    LINE = 8,
    BLOCK = 4 /* so many orders are begun at once */
};

/* The parts of one kind in chunks of sixteen. */
typedef struct {
    const qdot_alike_kind *kind;
    size_t chunks, width;  /* number of chunks; doubles of one order of a chunk */
    size_t numbers, partials, size; /* where the numbers and partial sums of a chunk begin; doubles of a chunk */
    double *allocated, *X; /* [chunks x size] */
    uint32_t *input;       /* [chunks x inputs x 16] which value is an input of a part */
    uint32_t *number;      /* [chunks x numbers x 16] which row of the program is a number of a part */
} bundle;

typedef struct {
    void (*parts)(const bundle *b, const double *fixed, double *newest, double *values, int k);
    void (*sums)(const qdot_alike *a, const double *factor, double *values);
} kernels;

struct qdot_taylor_alike {
    const qdot_motion *motion;
    const qdot_alike *of;
    qdot_taylor *taylor;
    const kernels *kernels;
    bundle *bundles; /* [kinds] */
    size_t values;   /* how many values there are */
    double *allocated, *value, *newest, *nought, *factor;
    double unit;
};

static inline double *
place(double *const *spaces, qdot_alike_place p)
{
    return spaces[p.space] + (size_t)p.at * QDOT_ALIKE_LANES;
}

/* Order 0 of a step for each part by itself. */
static void
value_of_lanes(const qdot_alike_step *s, const qdot_wide_rows *r)
{
    for (int l = 0; l < QDOT_ALIKE_LANES; l++)
        qdot_taylor_value(&(qdot_taylor_step){.op = s->op, .zero = s->zero, .sign = (signed char)s->sign,
                                              .to = r->to + l, .second = r->second + l, .third = r->third + l,
                                              .d = r->d + l, .x = r->x + l, .y = r->y + l, .z = r->z + l});
}

#define LANES 4
#define NAME(x) portable_##x
#define MA(a, b, c) QDOT_VECTOR_MA(portable_vector, a, b, c)
#define FUSED(a, b, c) QDOT_MA(a, b, c)
#include "series/taylor-alike.def"
#undef NAME
#undef MA
#undef FUSED

#ifdef QDOT_X86_KINDS
#include <immintrin.h>

#define FUSED(a, b, c) __builtin_fma(a, b, c)
QDOT_KIND_AVX2
#define NAME(x) avx2_##x
#define MA(a, b, c)                                                                      \
    ((avx2_vector)_mm256_fmadd_pd((__m256d)(a), (__m256d)(b), (__m256d)(c)))
#include "series/taylor-alike.def"
#undef NAME
#undef MA
#undef LANES
QDOT_KIND_END

QDOT_KIND_AVX512
#define LANES 8
#define NAME(x) avx512_##x
#define MA(a, b, c)                                                                      \
    ((avx512_vector)_mm512_fmadd_pd((__m512d)(a), (__m512d)(b), (__m512d)(c)))
#include "series/taylor-alike.def"
#undef NAME
#undef MA
#undef FUSED
QDOT_KIND_END
#endif
#undef LANES

static const kernels *
available_kernels(void)
{
#ifdef QDOT_X86_KINDS
    if (qdot_kind_is_here(2))
        return &avx512_kernels;
    if (qdot_kind_is_here(1))
        return &avx2_kernels;
#endif
    return &portable_kernels;
}

/* --- making bundles --------------------------------------------------------------------- */

static double *
aligned(double *p)
{
    while ((uintptr_t)p % (LINE * sizeof *p) != 0)
        p++;
    return p;
}

/* Rows [parts x n] by chunk, row, part; lanes without a part are those of the last one. */
static uint32_t *
arrange_by_chunks(const bundle *b, const qdot_program_row *rows, size_t n)
{
    uint32_t *by = qdot_calloc(b->chunks * n * QDOT_ALIKE_LANES + 1, sizeof *by);

    for (size_t i = 0; by && i < b->chunks * QDOT_ALIKE_LANES; i++) {
        const size_t part = i < b->kind->parts ? i : b->kind->parts - 1;

        for (size_t r = 0; r < n; r++)
            by[(i / QDOT_ALIKE_LANES * n + r) * QDOT_ALIKE_LANES + i % QDOT_ALIKE_LANES] = rows[part * n + r];
    }
    return by;
}

static qdot_status
make_bundle(bundle *b, const qdot_alike_kind *kind, size_t orders)
{
    b->kind = kind;
    b->chunks = (kind->parts + QDOT_ALIKE_LANES - 1) / QDOT_ALIKE_LANES;
    b->width = kind->orders * QDOT_ALIKE_LANES;
    b->numbers = orders * b->width;
    b->partials = b->numbers + kind->numbers * QDOT_ALIKE_LANES;
    b->size = b->partials + kind->partials * BLOCK * QDOT_ALIKE_LANES;
    b->size += b->size / LINE % 2 ? 0 : LINE; /* an odd number of cache lines, so that chunks use all sets of the cache */
    b->allocated = qdot_calloc(b->chunks * b->size + LINE, sizeof *b->allocated);
    b->input = arrange_by_chunks(b, kind->input_rows.at, kind->inputs);
    b->number = arrange_by_chunks(b, kind->number_rows.at, kind->numbers);
    if (!b->allocated || !b->input || !b->number)
        return QDOT_ENOMEM;
    b->X = aligned(b->allocated);
    return QDOT_OK;
}

static qdot_status
make_taylor_alike(qdot_taylor_alike *a)
{
    const qdot_alike *of = a->of;
    const size_t orders = qdot_taylor_stride(a->taylor);
    size_t widest = 0, newest = 0, before;

    a->bundles = qdot_calloc(of->kinds.n + 1, sizeof *a->bundles);
    if (!a->bundles)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < of->kinds.n; i++) {
        QDOT_TRY(make_bundle(a->bundles + i, of->kinds.at + i, orders));
        widest = a->bundles[i].width > widest ? a->bundles[i].width : widest;
        newest = of->kinds.at[i].newest > newest ? of->kinds.at[i].newest : newest;
    }
    /* rows of one order are addressed from before their beginning: by orders that they do not have */
    before = orders * widest;
    a->values = of->first_sum + of->sums.n;
    a->allocated = qdot_calloc(before + (newest + 1) * QDOT_ALIKE_LANES + a->values + of->terms.n + 4 * LINE,
                               sizeof *a->allocated);
    if (!a->allocated)
        return QDOT_ENOMEM;
    a->newest = aligned(a->allocated + before);
    a->nought = a->newest + newest * QDOT_ALIKE_LANES;
    a->value = a->nought + QDOT_ALIKE_LANES;
    a->factor = a->value + a->values;
    return QDOT_OK;
}

qdot_status
qdot_taylor_alike_new(const qdot_motion *motion, qdot_taylor *taylor, qdot_taylor_alike **alike)
{
    qdot_taylor_alike *a = qdot_calloc(1, sizeof *a);
    qdot_status status;

    *alike = NULL;
    if (!a)
        return QDOT_ENOMEM;
    a->motion = motion;
    a->of = motion->alike;
    a->taylor = taylor;
    a->kernels = available_kernels();
    status = make_taylor_alike(a);
    if (status != QDOT_OK) {
        qdot_taylor_alike_free(a);
        return status;
    }
    *alike = a;
    return QDOT_OK;
}

void
qdot_taylor_alike_free(qdot_taylor_alike *a)
{
    if (!a)
        return;
    for (size_t i = 0; a->bundles && i < a->of->kinds.n; i++) {
        qdot_free(a->bundles[i].allocated);
        qdot_free(a->bundles[i].input);
        qdot_free(a->bundles[i].number);
    }
    qdot_free(a->bundles);
    qdot_free(a->allocated);
    qdot_free(a);
}

/* --- an expansion ------------------------------------------------------------------------ */

static double *
row_of(const qdot_taylor_alike *a, qdot_program_row r)
{
    return qdot_taylor_place(a->taylor, r);
}

/* Take the numbers of parts and sums from their rows, of which some are drawn anew for each step. */
static void
take_numbers(qdot_taylor_alike *a)
{
    const qdot_alike *of = a->of;

    for (size_t i = 0; i < of->kinds.n; i++) {
        const bundle *b = a->bundles + i;
        const size_t n = b->kind->numbers * QDOT_ALIKE_LANES;

        for (size_t c = 0; c < b->chunks; c++) {
            double *X = b->X + c * b->size;

            for (size_t l = 0; l < n; l++)
                X[b->numbers + l] = *row_of(a, b->number[c * n + l]);
            for (size_t k = 0; k < b->kind->summed.n; k += 2)
                memcpy(X + b->kind->summed.at[k + 1].at * QDOT_ALIKE_LANES,
                       X + b->numbers + b->kind->summed.at[k].at * QDOT_ALIKE_LANES,
                       QDOT_ALIKE_LANES * sizeof *X);
        }
    }
    for (size_t t = 0; t < of->terms.n; t++) {
        const qdot_alike_term *term = of->terms.at + t;

        a->factor[t] = term->sign * (term->factor == QDOT_NO_ROW ? 1 : *row_of(a, term->factor));
    }
}

/* Coefficient k of a row that is an output or the integrand of an unknown. */
static double
coefficient_of_row(const qdot_taylor_alike *a, qdot_program_row r, int k)
{
    const uint32_t at = a->of->value[r];

    return at != UINT32_MAX ? a->value[at] : k == 0 ? *row_of(a, r) : 0;
}

static void
integrate_unknowns(const qdot_taylor_alike *a, int k)
{
    const qdot_motion *m = a->motion;

    for (size_t i = 0; i < m->unknowns.n; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + i;
        const double by = a->unit * coefficient_of_row(a, u->value, k) / (k + 1);

        if (u->once == QDOT_NO_ROW)
            continue;
        row_of(a, u->once)[k + 1] = by;
        if (u->twice == QDOT_NO_ROW)
            continue;
        row_of(a, u->twice)[k + 2] = a->unit * by / (k + 2);
        if (k == 0)
            row_of(a, u->twice)[1] = a->unit * row_of(a, u->once)[0];
    }
}

static void
take_order(qdot_taylor_alike *a, int k)
{
    const qdot_alike *of = a->of;
    const qdot_program *p = &a->motion->program;
    const size_t stride = qdot_taylor_stride(a->taylor);
    const double *input = row_of(a, 0) + k;

    for (size_t i = 0; i < p->moving; i++, input += stride)
        a->value[i] = *input;
    a->value[of->one] = k == 0;
    for (size_t i = 0; i < of->kinds.n; i++)
        a->kernels->parts(a->bundles + i, a->nought, a->newest, a->value, k);
    a->kernels->sums(of, a->factor, a->value);
    for (size_t i = 0; i < p->outputs.n; i++)
        row_of(a, p->outputs.at[i])[k] = coefficient_of_row(a, p->outputs.at[i], k);
    integrate_unknowns(a, k);
}

void
qdot_taylor_alike_begin(qdot_taylor_alike *a, double unit)
{
    a->unit = unit;
    for (size_t i = 0; i < a->taylor->still; i++)
        qdot_taylor_value(a->taylor->steps + i);
    take_numbers(a);
    take_order(a, 0);
}

void
qdot_taylor_alike_extend(qdot_taylor_alike *a, int from, int to)
{
    for (int k = from; k <= to; k++)
        take_order(a, k);
}

/* --- the length of a step ---------------------------------------------------------------- */

/* Set sum[l] to that of |x_k| s^k over k >= 1 for each part. */
static void
sums_of_sizes(const double *x, size_t width, int p, double s, double sum[QDOT_ALIKE_LANES])
{
    for (int l = 0; l < QDOT_ALIKE_LANES; l++)
        sum[l] = 0;
    for (int k = p; k >= 1; k--)
        for (int l = 0; l < QDOT_ALIKE_LANES; l++)
            sum[l] = (sum[l] + fabs(x[(size_t)k * width + (size_t)l])) * s;
}

static void
take_series_of_lane(const double *x, size_t width, int p, double *to)
{
    for (int k = 0; k <= p; k++)
        to[k] = x[(size_t)k * width];
}

/* Which operand a step divides by, or takes a power of; 0: none. */
static char
divisor_of(const qdot_alike_step *s)
{
    return s->op == QDOT_ALIKE_POWER ? 'x' : s->op < QDOT_T_COUNT ? qdot_recurrence_divisor(s->op) : 0;
}

static double
exponential_of(const qdot_alike_step *s)
{
    return s->op < QDOT_T_COUNT ? qdot_recurrence_exponential(s->op) : 0;
}

/* The step for a part whose divisor, or argument of an exponential, is b; `to` is the result of the step. */
static double
safe_step(const qdot_alike_step *step, int p, const double *b, const double *to, double s, double least)
{
    const double times = exponential_of(step);

    if (times > 0)
        return qdot_near_taken(s, qdot_near_argument(p, b, times, s), QDOT_NEAR_FINER * least);
    if (!qdot_near_may_fall(p, b, s) || (step->op == QDOT_T_DIV && !qdot_near_diverges(p, to, s)))
        return s;
    return qdot_near_taken(s, qdot_near_divisor(p, b, step->op == QDOT_T_SQRT, s), least);
}

static double
safe_step_for_chunk(const bundle *b, double *X, const qdot_alike_step *step, int p, double s, double least)
{
    const char which = divisor_of(step);
    const int name = which ? QDOT_OF_x + (which - 'x') : QDOT_OF_x;
    const double *x = X + step->row[name].at * QDOT_ALIKE_LANES;
    double sum[QDOT_ALIKE_LANES], of_x[QDOT_SERIES_MOST + 1], of_to[QDOT_SERIES_MOST + 1] = {0};

    if (step->row[name].space != QDOT_ALIKE_ORDERS) /* a number */
        return s;
    sums_of_sizes(x, b->width, p, s, sum);
    for (int l = 0; l < QDOT_ALIKE_LANES; l++) {
        if (which && !qdot_near_sizes_may_fall(fabs(x[l]), sum[l]))
            continue;
        take_series_of_lane(x + l, b->width, p, of_x);
        if (step->op == QDOT_T_DIV)
            take_series_of_lane(X + step->row[QDOT_OF_to].at * QDOT_ALIKE_LANES + l, b->width, p, of_to);
        s = safe_step(step, p, of_x, of_to, s, least);
    }
    return s;
}

double
qdot_taylor_alike_near(const qdot_taylor_alike *a, int p, double s, double least)
{
    for (const bundle *b = a->bundles; b < a->bundles + a->of->kinds.n; b++)
        for (const qdot_alike_step *step = b->kind->steps.at; step < b->kind->steps.at + b->kind->steps.n; step++) {
            if (!divisor_of(step) && exponential_of(step) == 0)
                continue;
            for (size_t c = 0; c < b->chunks; c++)
                s = safe_step_for_chunk(b, b->X + c * b->size, step, p, s, least);
        }
    return s;
}
