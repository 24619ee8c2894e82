/* lanes.c -- evaluates a series program for several solutions at once, one in each lane of a vector. */
#include "series/lanes.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "num/samples.h"
#include "tape/code.h"
#include "tape/shake.h"

/* A qdot_program_step with pointers to its rows; c: the inverse of the coefficient by which every order divides,
 * for RATE of the unit of time. */
typedef struct {
    uint16_t op, zero;
    int sign, lead;
    unsigned char newest;
    bool still, kept;
    double *to, *second, *third, *d, *c;
    const double *x, *y, *z;
} lanes_step;

typedef struct {
    double *row;
    double near, far;
    int64_t limit; /* 2^53 times the probability of choosing `far`, rounded up */
} drawn;

typedef struct {
    void (*eval)(const qdot_tape *tape, const qdot_batch_kernels *kernels, double *work);
    void (*draw)(const drawn *constants, size_t n, const double *time);
    void (*value_of_zero)(const qdot_batch_kernels *kernels, const lanes_step *step);
    void (*order)(const qdot_batch_kernels *kernels, const lanes_step *steps, size_t n, int k,
                  const double *inverse);
    void (*correct)(const lanes_step *steps, int k, size_t note);
    void (*renew)(double *row, int k, size_t note, const double *newest);
    void (*integrate)(const double *unit, double inverse, const double *x, double *to);
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
    const qdot_motion *motion; /* the motion that is computed; NULL: only a program */
    const qdot_program *program;
    double unit[QDOT_LANES], per_unit[QDOT_LANES]; /* [lanes] unit of time of a motion in each lane, and its inverse */
    bool has_rates, has_kept; /* some step takes a time derivative; some row keeps the coefficients of all orders */
    size_t stride;
    void *memory;          /* the allocated block that contains the coefficients, before alignment */
    double *coefficients;  /* [rows x stride groups] coefficients, aligned to a cache line */
    /* [length groups] of each step, behind the coefficients: by which all its orders are multiplied in place of a
     * division */
    double *inverses;
    lanes_step *steps;     /* [length + 1] the steps of the program, then QDOT_T_END */
    drawn *drawn; /* [n_drawn] constants that are rounded at random to a neighbouring double */
    size_t n_drawn;
    double inverse[QDOT_SERIES_MOST + 1]; /* table of the numbers 1/k by index k */
};

static void
evaluate_tape_in_lanes(const qdot_tape *tape, const qdot_batch_kernels *kernels, const double *in,
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
    evaluate_tape_in_lanes(tape, NULL, in, out, work);
}

void
qdot_lanes_eval_near(const qdot_tape *tape, const double *in, double *out, double *work)
{
    evaluate_tape_in_lanes(tape, qdot_batch_kernels_get(), in, out, work);
}

void
qdot_lanes_free(qdot_lanes *t)
{
    if (!t)
        return;
    qdot_free(t->memory);
    qdot_free(t->steps);
    qdot_free(t->drawn);
    qdot_free(t);
}

static double *
address_of_row(const qdot_lanes *t, qdot_program_row row)
{
    return row == QDOT_NO_ROW ? NULL : t->coefficients + (size_t)row * t->stride * QDOT_LANES;
}

/* Allocate the rows of coefficients for orders up to `most`. */
static qdot_status
lanes_allocate(qdot_lanes *t, int most)
{
    const qdot_program *p = t->program;
    const size_t line = 64;

    /* one more order for recorded changes; an odd stride spreads rows over all sets of the cache */
    t->stride = ((size_t)most + 2) | 1;
    t->memory = qdot_calloc((p->rows.n * t->stride + p->length) * QDOT_LANES +
                                line / sizeof(double),
                            sizeof(double));
    t->steps = qdot_calloc(p->steps.n, sizeof *t->steps);
    t->drawn = qdot_calloc(p->constants.n + 1, sizeof *t->drawn);
    if (!t->memory || !t->steps || !t->drawn)
        return QDOT_ENOMEM;
    t->coefficients =
        (double *)(((uintptr_t)t->memory + line - 1) / line * line);
    t->inverses = t->coefficients + p->rows.n * t->stride * QDOT_LANES;
    return QDOT_OK;
}

/* Set a constant in all lanes: to its other neighbouring double if `shaken`, otherwise at random to
 * one of the two. */
static void
set_constant(qdot_lanes *t, double *row, const qdot_program_constant *c, bool shaken)
{
    const double far = qdot_shake_double(c->value, c->side);

    for (size_t l = 0; l < QDOT_LANES; l++)
        row[l] = shaken ? far : c->value;
    if (c->low != 0 && !shaken)
        t->drawn[t->n_drawn++] = (drawn){row, c->value, far,
                                         (int64_t)ceil(ldexp(c->low / (far - c->value), 53))};
}

static void
lanes_set_constants(qdot_lanes *t, bool shaken)
{
    const qdot_program *p = t->program;

    for (qdot_program_row r = 0; r < p->rows.n; r++) {
        const qdot_program_row_info *row = p->rows.at + r;

        if (row->source == QDOT_ROW_CONSTANT)
            set_constant(t, address_of_row(t, r), p->constants.at + row->at, shaken);
        for (size_t l = 0; l < QDOT_LANES && row->source == QDOT_ROW_WHOLE; l++)
            address_of_row(t, r)[l] = row->at;
    }
}

static void
copy_steps(qdot_lanes *t)
{
    for (size_t i = 0; i < t->program->steps.n; i++) {
        const qdot_program_step *s = t->program->steps.at + i;

        t->has_rates |= s->op == QDOT_T_RATE;
        t->has_kept |= s->kept;
        t->steps[i] = (lanes_step){
            .op = s->op,
            .zero = s->zero,
            .sign = s->sign,
            .lead = s->lead,
            .newest = t->motion ? s->newest : UCHAR_MAX,
            .still = s->still,
            .kept = s->kept || !t->motion,
            .to = address_of_row(t, s->to),
            .second = address_of_row(t, s->second),
            .third = address_of_row(t, s->third),
            .d = address_of_row(t, s->d),
            .c = s->op == QDOT_T_RATE ? t->per_unit : t->inverses + i * QDOT_LANES,
            .x = address_of_row(t, s->x),
            .y = address_of_row(t, s->y),
            .z = address_of_row(t, s->z)};
    }
}

/* Allocate and fill everything that depends only on the program. */
static qdot_status
lanes_fill(qdot_lanes *t, bool shaken, int most)
{
    QDOT_TRY(lanes_allocate(t, most));
    lanes_set_constants(t, shaken);
    copy_steps(t);
    for (int k = 1; k <= QDOT_SERIES_MOST; k++)
        t->inverse[k] = 1.0 / k;
    t->kernels = qdot_batch_kernels_get();
    t->kind = kinds[qdot_batch_kind()];
    return QDOT_OK;
}

/* Make the coefficient arrays of all lanes for a program, or for the program of a motion. */
static qdot_status
lanes_make(const qdot_program *program, const qdot_motion *motion, bool shaken, int most,
           qdot_lanes **lanes)
{
    qdot_lanes *t;
    qdot_status status;

    *lanes = NULL;
    if (most < 0 || most > QDOT_SERIES_MOST)
        return qdot_fail(QDOT_EINVAL, "an order of %d is out of range", most);
    t = qdot_calloc(1, sizeof *t);
    if (!t)
        return QDOT_ENOMEM;
    t->program = program;
    t->motion = motion;
    status = lanes_fill(t, shaken, most);
    if (status != QDOT_OK) {
        qdot_lanes_free(t);
        return status;
    }
    *lanes = t;
    return QDOT_OK;
}

qdot_status
qdot_lanes_of_program(const qdot_program *program, bool shaken, int most, qdot_lanes **lanes)
{
    return lanes_make(program, NULL, shaken, most, lanes);
}

qdot_status
qdot_lanes_of_motion(const qdot_motion *motion, bool shaken, int most, qdot_lanes **lanes)
{
    return lanes_make(&motion->program, motion, shaken, most + 1, lanes);
}

const qdot_program *
qdot_lanes_program(const qdot_lanes *t)
{
    return t->program;
}

qdot_lanes_rows
qdot_lanes_get_rows(qdot_lanes *t)
{
    return (qdot_lanes_rows){t->program, t->coefficients, t->stride, QDOT_LANES};
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
    return address_of_row(t, t->program->outputs.at[i]);
}

const double *
qdot_lanes_series(const qdot_lanes *t, qdot_program_row row)
{
    return address_of_row(t, row);
}

bool
qdot_lanes_is_constant(const qdot_lanes *t, size_t i)
{
    return t->program->rows.at[t->program->outputs.at[i]].still;
}

void
qdot_lanes_draw(qdot_lanes *t, const double *time)
{
    t->kind->draw(t->drawn, t->n_drawn, time);
}

/* Carry out the steps of the program from index `from` on, each at order k plus its lead. */
static void
carry_out_steps(qdot_lanes *t, int k, size_t from)
{
    for (size_t i = from; i < t->program->length; i++) {
        const lanes_step *s = t->steps + i;

        if (k + s->lead > 0)
            t->kind->order(t->kernels, s, 1, k, t->inverse);
        else if (k + s->lead == 0 || s->still)
            t->kind->value_of_zero(t->kernels, s);
    }
}

void
qdot_lanes_order(qdot_lanes *t, int k)
{
    const qdot_program *p = t->program;

    if (k <= 0)
        carry_out_steps(t, k, k > -p->lead ? p->still : 0);
    else
        t->kind->order(t->kernels, t->steps + p->still, p->length - p->still, k, t->inverse);
}

void
qdot_lanes_correct(qdot_lanes *t, int k, size_t n, const double *newest)
{
    for (size_t i = 0; i < n; i++)
        t->kind->renew(qdot_lanes_input(t, i), k, t->stride - 1, newest + i * QDOT_LANES);
    t->kind->correct(t->steps + t->program->still, k, t->stride - 1);
}

/* --- unknowns: accelerations and multipliers ---------------------------------------- */

void
qdot_lanes_set_unit(qdot_lanes *t, const double *unit)
{
    memcpy(t->unit, unit, sizeof t->unit);
    for (size_t l = 0; l < QDOT_LANES && t->has_rates; l++)
        t->per_unit[l] = 1 / unit[l];
}

/* Store order k of an unknown, and the coefficients of its integrals (velocity, position) that follow. */
static void
store_unknown(const qdot_lanes *t, const qdot_motion_unknown *u, const double *a, int k)
{
    double *row = address_of_row(t, u->row), *once = address_of_row(t, u->once), *twice = address_of_row(t, u->twice);

    if (row)
        memcpy(row + k * QDOT_LANES, a, QDOT_LANES * sizeof *a);
    if (once)
        t->kind->integrate(t->unit, t->inverse[k + 1], a, once + (k + 1) * QDOT_LANES);
    if (twice)
        t->kind->integrate(t->unit, t->inverse[k + 2], once + (k + 1) * QDOT_LANES,
                           twice + (k + 2) * QDOT_LANES);
}

static void
clear_coefficient(const qdot_lanes *t, qdot_program_row row, int k)
{
    if (row != QDOT_NO_ROW)
        memset(address_of_row(t, row) + k * QDOT_LANES, 0, QDOT_LANES * sizeof(double));
}

void
qdot_lanes_stage(qdot_lanes *t, int k)
{
    const qdot_motion *m = t->motion;

    for (size_t i = 0; i < m->solved.n && k >= 0; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + m->solved.at[i];

        clear_coefficient(t, u->row, k);
        clear_coefficient(t, u->once, k + 1);
        clear_coefficient(t, u->twice, k + 2);
    }
    qdot_lanes_order(t, k);
    for (size_t i = 0; i < m->unknowns.n && k >= 0; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + i;

        if (u->value != QDOT_NO_ROW)
            store_unknown(t, u, address_of_row(t, u->value) + k * QDOT_LANES, k);
    }
}

static void
change_unknown(const qdot_lanes *t, const qdot_motion_unknown *u, const double *by, int k)
{
    double *row = address_of_row(t, u->row), *once = address_of_row(t, u->once), *twice = address_of_row(t, u->twice);
    double by_once[QDOT_LANES], by_twice[QDOT_LANES];
    const size_t note = t->stride - 1;

    if (row)
        t->kind->renew(row, k, note, by);
    if (!once)
        return;
    t->kind->integrate(t->unit, t->inverse[k + 1], by, by_once);
    t->kind->renew(once, k + 1, note, by_once);
    if (!twice)
        return;
    t->kind->integrate(t->unit, t->inverse[k + 2], by_once, by_twice);
    t->kind->renew(twice, k + 2, note, by_twice);
}

void
qdot_lanes_change(qdot_lanes *t, int k, const double *by)
{
    const qdot_motion *m = t->motion;

    for (size_t i = 0; i < m->solved.n; i++)
        change_unknown(t, m->unknowns.at + m->solved.at[i], by + i * QDOT_LANES, k);
    if (t->has_kept)
        t->kind->correct(t->steps + t->program->still, k, t->stride - 1);
}
