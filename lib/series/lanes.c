/* lanes.c -- the series program of taylor.c with groups for numbers. */
#include "series/lanes.h"

#include <math.h>
#include <string.h>

#include "series/lanes-program.h"
#include "series/taylor.h"

/* As qdot_taylor_step. */
typedef struct {
    uint16_t op, zero;
    int sign;
    double *to, *second, *third, *d, *c;
    const double *x, *y, *z;
} lanes_step;

typedef struct {
    double *row;
    double near, far;
    int64_t limit; /* 2^53 times the chance of the far one, up */
} drawn;

typedef struct {
    void (*eval)(const qdot_tape *tape, const qdot_batch_kernels *kernels, double *work);
    void (*draw)(const drawn *constants, size_t n, const double *time);
    void (*value_of_zero)(const qdot_batch_kernels *kernels, const lanes_step *step);
    void (*order)(const qdot_batch_kernels *kernels, const lanes_step *steps, int k,
                  double inverse);
    void (*correct)(const lanes_step *steps, int k, size_t note);
    void (*renew)(double *row, int k, size_t note, const double *newest);
} lanes_kernels;

#define BATCH_BODY "series/lanes.def"
#include "num/batch-kinds.def"

static const lanes_kernels *const kinds[] = {
    &portable_lanes,
#ifdef QDOT_X86_KINDS
    &avx2_lanes,
    &avx512_lanes,
#endif
};

struct qdot_lanes {
    const qdot_batch_kernels *kernels;
    const lanes_kernels *kind;
    qdot_taylor *program; /* of one lane: rows and steps by numbers */
    size_t stride, inputs, outputs, length, still;
    void *memory;          /* what the coefficients stand in */
    double *coefficients;  /* [rows x stride groups], from a cache line on */
    double *inverses;      /* [length groups] behind them */
    lanes_step *steps;     /* [length], QDOT_T_END behind them */
    const double **output; /* [outputs] */
    bool *constant;        /* [outputs] */
    drawn *drawn;          /* [n_drawn] */
    size_t n_drawn;
    double inverse[QDOT_SERIES_MOST + 1]; /* 1/k */
};

static void
evaluate(const qdot_tape *tape, const qdot_batch_kernels *kernels, const double *in,
         double *out, double *work)
{
    size_t n = tape->inputs * QDOT_LANES;

    if (n)
        memcpy(work, in, n * sizeof *work);
    for (size_t i = 0; i < tape->constants; i++)
        for (size_t l = 0; l < QDOT_LANES; l++)
            work[n + i * QDOT_LANES + l] = tape->constant[i];
    kinds[qdot_batch_kind()]->eval(tape, kernels, work);
    for (size_t k = 0; k < tape->outputs; k++)
        memcpy(out + k * QDOT_LANES, work + tape->output[k] * QDOT_LANES,
               QDOT_LANES * sizeof *out);
}

void
qdot_lanes_eval(const qdot_tape *tape, const double *in, double *out, double *work)
{
    evaluate(tape, NULL, in, out, work);
}

void
qdot_lanes_eval_near(const qdot_tape *tape, const double *in, double *out, double *work)
{
    evaluate(tape, qdot_batch_kernels_get(), in, out, work);
}

void
qdot_lanes_free(qdot_lanes *t)
{
    if (!t)
        return;
    qdot_taylor_free(t->program);
    qdot_free(t->memory);
    qdot_free(t->steps);
    qdot_free(t->output);
    qdot_free(t->constant);
    qdot_free(t->drawn);
    qdot_free(t);
}

/* The place of a row of the single program. */
static double *
place(const qdot_lanes *t, const qdot_taylor *from, const double *row)
{
    return row ? t->coefficients +
                     (size_t)(row - from->coefficients) / from->stride * t->stride * QDOT_LANES
               : NULL;
}

static qdot_status
allocate(qdot_lanes *t, const qdot_taylor *from, int most)
{
    const size_t line = 64;

    /* and a note (correct); rows are to share no few sets of a cache */
    t->stride = ((size_t)most + 2) | 1;
    t->inputs = from->inputs;
    t->outputs = from->outputs;
    t->length = from->length;
    t->still = from->still;
    t->n_drawn = from->n_drawn;
    t->memory = qdot_calloc((from->rows * t->stride + t->length) * QDOT_LANES +
                                line / sizeof(double),
                            sizeof(double));
    t->steps = qdot_calloc(t->length + 1, sizeof *t->steps);
    t->output = qdot_calloc(t->outputs + 1, sizeof *t->output);
    t->constant = qdot_calloc(t->outputs + 1, sizeof *t->constant);
    t->drawn = qdot_calloc(t->n_drawn + 1, sizeof *t->drawn);
    if (!t->memory || !t->steps || !t->output || !t->constant || !t->drawn)
        return QDOT_ENOMEM;
    t->coefficients =
        (double *)(((uintptr_t)t->memory + line - 1) / line * line);
    t->inverses = t->coefficients + from->rows * t->stride * QDOT_LANES;
    return QDOT_OK;
}

static qdot_status
fill(qdot_lanes *t, const qdot_taylor *from, int most)
{
    QDOT_TRY(allocate(t, from, most));
    for (size_t r = from->inputs; r < from->rows; r++)
        for (size_t l = 0; l < QDOT_LANES; l++)
            t->coefficients[r * t->stride * QDOT_LANES + l] =
                from->coefficients[r * from->stride];
    for (size_t i = 0; i < t->length; i++) {
        const qdot_taylor_step *s = from->steps + i;

        t->steps[i] = (lanes_step){.op = s->op,
                                   .zero = s->zero,
                                   .sign = s->sign,
                                   .to = place(t, from, s->to),
                                   .second = place(t, from, s->second),
                                   .third = place(t, from, s->third),
                                   .d = place(t, from, s->d),
                                   .c = t->inverses + i * QDOT_LANES,
                                   .x = place(t, from, s->x),
                                   .y = place(t, from, s->y),
                                   .z = place(t, from, s->z)};
    }
    t->steps[t->length].op = QDOT_T_END;
    for (size_t i = 0; i < t->outputs; i++) {
        t->output[i] = place(t, from, from->output[i]);
        t->constant[i] = from->constant[i];
    }
    for (size_t i = 0; i < t->n_drawn; i++) {
        const struct qdot_taylor_drawn *d = from->drawn + i;

        t->drawn[i] = (drawn){place(t, from, d->row), d->near, d->far,
                              (int64_t)ceil(ldexp(d->chance, 53))};
    }
    for (int k = 1; k <= QDOT_SERIES_MOST; k++)
        t->inverse[k] = 1.0 / k;
    t->kernels = qdot_batch_kernels_get();
    t->kind = kinds[qdot_batch_kind()];
    return QDOT_OK;
}

qdot_status
qdot_lanes_new_moving(const qdot_tape *tape, int most, size_t moving, qdot_lanes **lanes)
{
    qdot_taylor *single;
    qdot_lanes *t;
    qdot_status status;

    *lanes = NULL;
    if (most < 0 || most > QDOT_SERIES_MOST)
        return qdot_fail(QDOT_EINVAL, "an order of %d is out of range", most);
    QDOT_TRY(qdot_taylor_new_moving(tape, false, 0, moving, 0, &single));
    t = qdot_calloc(1, sizeof *t);
    if (!t) {
        qdot_taylor_free(single);
        return QDOT_ENOMEM;
    }
    t->program = single;
    status = fill(t, single, most);
    if (status != QDOT_OK) {
        qdot_lanes_free(t);
        return status;
    }
    *lanes = t;
    return QDOT_OK;
}

qdot_status
qdot_lanes_new(const qdot_tape *tape, int most, qdot_lanes **lanes)
{
    return qdot_lanes_new_moving(tape, most, tape->inputs, lanes);
}

const qdot_taylor *
qdot_lanes_program(const qdot_lanes *t)
{
    return t->program;
}

double *
qdot_lanes_input(qdot_lanes *t, size_t i)
{
    return t->coefficients + i * t->stride * QDOT_LANES;
}

size_t
qdot_lanes_stride(const qdot_lanes *t)
{
    return t->stride;
}

const double *
qdot_lanes_output(const qdot_lanes *t, size_t i)
{
    return t->output[i];
}

bool
qdot_lanes_is_constant(const qdot_lanes *t, size_t i)
{
    return t->constant[i];
}

void
qdot_lanes_draw(qdot_lanes *t, const double *time)
{
    t->kind->draw(t->drawn, t->n_drawn, time);
}

void
qdot_lanes_order(qdot_lanes *t, int k)
{
    if (k == 0)
        for (const lanes_step *s = t->steps; s->op != QDOT_T_END; s++)
            t->kind->value_of_zero(t->kernels, s);
    else
        t->kind->order(t->kernels, t->steps + t->still, k, t->inverse[k]);
}

void
qdot_lanes_correct(qdot_lanes *t, int k, size_t n, const double *newest)
{
    for (size_t i = 0; i < n; i++)
        t->kind->renew(qdot_lanes_input(t, i), k, t->stride - 1, newest + i * QDOT_LANES);
    t->kind->correct(t->steps + t->still, k, t->stride - 1);
}
