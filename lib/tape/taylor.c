/* taylor.c -- from a tape to recurrences. */
#include "tape/taylor.h"

#include <math.h>
#include <string.h>

#include "tape/shake.h"
#include "tape/taylor-code.h"
#include "tape/taylor-steps.h"
#include "tape/x86.h"

/* --- building ----------------------------------------------------------------------- */

typedef uint32_t row; /* of coefficients, by number while the rows are not yet there */

#define NO_ROW UINT32_MAX

enum { LINE = 8 }; /* doubles of a line of the cache */

/* A step while rows are numbers. */
typedef struct {
    uint16_t op, zero;
    int sign;
    bool still; /* it has order 0 only */
    row to, second, third, d, x, y, z;
} draft;

typedef struct {
    const qdot_tape *tape;
    row *at; /* [tape->places] the row a place has now */
    qdot_vec(draft) drafts;
    size_t moving;                  /* inputs */
    qdot_vec(double) constants;     /* [rows] the number, NaN: computed, or an input */
    qdot_vec(bool) still;           /* [rows] it has order 0 only */
    qdot_vec(row) sincos, sinhcosh; /* [rows] sine of the pair made of a row; NO_ROW */
    double convolutions;
    draft nothing; /* written to after a failure */
    qdot_status status;
} builder;

static row
new_row(builder *b, double constant, bool still)
{
    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->constants, constant);
    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->still, still);
    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->sincos, NO_ROW);
    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->sinhcosh, NO_ROW);
    return b->status == QDOT_OK ? (row)(b->constants.n - 1) : 0;
}

static bool
is_constant(const builder *b, row r)
{
    return b->status == QDOT_OK && b->still.at[r];
}

static void
add(builder *b, draft d)
{
    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->drafts, d);
}

/* The step just emitted. */
static draft *
last(builder *b)
{
    return b->status == QDOT_OK ? b->drafts.at + b->drafts.n - 1 : &b->nothing;
}

static row
emit(builder *b, qdot_taylor_op op, int zero, row x, row y, row z)
{
    static const double cost[QDOT_T_COUNT] = {
        [QDOT_T_MUL] = 1,    [QDOT_T_SQUARE] = 0.5, [QDOT_T_MADD] = 1,
        [QDOT_T_MSUB] = 1,   [QDOT_T_NMADD] = 1,    [QDOT_T_DIV] = 1,
        [QDOT_T_SQRT] = 0.5, [QDOT_T_EXP] = 1,      [QDOT_T_POW] = 2,
        [QDOT_T_ALONG] = 1,
        [QDOT_T_RATIO] = 1,  [QDOT_T_SINCOS] = 2,   [QDOT_T_SINHCOSH] = 2,
        [QDOT_T_TANH] = 1.5, [QDOT_T_ATAN2] = 3};
    const bool still = is_constant(b, x) && is_constant(b, y) && is_constant(b, z);
    row to = new_row(b, NAN, still);

    b->convolutions += still ? 0 : cost[op];
    add(b, (draft){.op = (uint16_t)op,
                   .zero = (uint16_t)zero,
                   .sign = 1,
                   .still = still,
                   .to = to,
                   .second = NO_ROW,
                   .third = NO_ROW,
                   .d = NO_ROW,
                   .x = x,
                   .y = y,
                   .z = z});
    return to;
}

/* Work rows of the step just emitted. */
static void
with_d(builder *b)
{
    row d = new_row(b, NAN, last(b)->still);

    last(b)->d = d;
}

static void
with_second(builder *b)
{
    row second = new_row(b, NAN, last(b)->still);

    last(b)->second = second;
}

static void
with_third(builder *b)
{
    row third = new_row(b, NAN, last(b)->still);

    last(b)->third = third;
}

/* A constant times x, and z. */
static row
scaled(builder *b, qdot_op op, row constant, row x, row z)
{
    static const qdot_taylor_op scale[QDOT_OP_COUNT] = {[QDOT_OP_MUL] = QDOT_T_SCALE,
                                                        [QDOT_OP_MADD] = QDOT_T_SCALEADD,
                                                        [QDOT_OP_MSUB] = QDOT_T_SCALESUB,
                                                        [QDOT_OP_NMADD] =
                                                            QDOT_T_SCALEOFF};

    return emit(b, scale[op], op, constant, x, z);
}

static row
product(builder *b, qdot_op op, row x, row y, row z)
{
    static const qdot_taylor_op plain[QDOT_OP_COUNT] = {[QDOT_OP_MUL] = QDOT_T_MUL,
                                                        [QDOT_OP_MADD] = QDOT_T_MADD,
                                                        [QDOT_OP_MSUB] = QDOT_T_MSUB,
                                                        [QDOT_OP_NMADD] = QDOT_T_NMADD};
    row square;

    if (is_constant(b, x))
        return scaled(b, op, x, y, z);
    if (is_constant(b, y))
        return scaled(b, op, y, x, z);
    if (x != y) /* the newer factor first: rows follow each other as they are computed */
        return x > y ? emit(b, plain[op], op, x, y, z) : emit(b, plain[op], op, y, x, z);
    square = emit(b, QDOT_T_SQUARE, QDOT_OP_MUL, x, x, x);
    if (op == QDOT_OP_MADD)
        return emit(b, QDOT_T_ADD, QDOT_OP_ADD, square, z, z);
    if (op == QDOT_OP_MSUB)
        return emit(b, QDOT_T_SUB, QDOT_OP_SUB, square, z, z);
    if (op == QDOT_OP_NMADD)
        return emit(b, QDOT_T_SUB, QDOT_OP_SUB, z, square, square);
    return square;
}

/* Sine of the pair of x, *cosine beside it. */
static row
pair(builder *b, qdot_taylor_op op, row x, row *cosine)
{
    row *made;
    row to;

    if (b->status != QDOT_OK)
        return *cosine = 0;
    made = op == QDOT_T_SINCOS ? b->sincos.at + x : b->sinhcosh.at + x;
    if (*made != NO_ROW) {
        *cosine = *made + 1;
        return *made;
    }
    to = emit(b, op, op == QDOT_T_SINCOS ? QDOT_OP_SINCOS : QDOT_ZERO_SINHCOSH, x, x, x);
    with_second(b);
    with_d(b);
    *cosine = to + 1;
    if (b->status == QDOT_OK)
        (op == QDOT_T_SINCOS ? b->sincos.at : b->sinhcosh.at)[x] = to;
    return to;
}

static row
number(builder *b, double c)
{
    return new_row(b, c, true);
}

static row
sum(builder *b, qdot_op op, row x, row y)
{
    return emit(b, op == QDOT_OP_ADD ? QDOT_T_ADD : QDOT_T_SUB, op, x, y, y);
}

/* What the derivative of a function is divided by. */
static row
denominator(builder *b, qdot_op f, row x)
{
    row square, one;

    if (f == QDOT_OP_LOG)
        return x;
    square = product(b, QDOT_OP_MUL, x, x, x);
    one = number(b, 1);
    switch (f) {
    case QDOT_OP_ATAN: return sum(b, QDOT_OP_ADD, one, square);
    case QDOT_OP_ATANH: return sum(b, QDOT_OP_SUB, one, square);
    case QDOT_OP_ASINH: square = sum(b, QDOT_OP_ADD, one, square); break;
    case QDOT_OP_ACOSH: square = sum(b, QDOT_OP_SUB, square, one); break;
    default: square = sum(b, QDOT_OP_SUB, one, square);
    }
    return emit(b, QDOT_T_SQRT, QDOT_OP_SQRT, square, square, square);
}

static row
ratio(builder *b, qdot_op f, row x)
{
    row u = denominator(b, f, x), to = emit(b, QDOT_T_RATIO, f, x, u, u);

    last(b)->sign = f == QDOT_OP_ACOS ? -1 : 1;
    with_d(b);
    return to;
}

static row
power(builder *b, row x, row exponent)
{
    row to, l;

    if (is_constant(b, exponent)) {
        to = emit(b, QDOT_T_POW, QDOT_OP_POW, x, exponent, exponent);
        with_d(b);
        return to;
    }
    l = product(b, QDOT_OP_MUL, ratio(b, QDOT_OP_LOG, x), exponent, exponent);
    to = emit(b, QDOT_T_EXP, QDOT_ZERO_POWER, l, x, exponent);
    with_d(b);
    return to;
}

static row
arctangent(builder *b, row y, row x)
{
    row xx = product(b, QDOT_OP_MUL, x, x, x), u = product(b, QDOT_OP_MADD, y, y, xx);
    row to = emit(b, QDOT_T_ATAN2, QDOT_OP_ATAN2, y, x, u);

    with_second(b);
    with_third(b);
    with_d(b);
    return to;
}

/* The operations without a series. */
static bool
switches(uint32_t op)
{
    return op >= QDOT_OP_ABS;
}

static row
build_one(builder *b, const qdot_instruction *i, row *second)
{
    qdot_op op = (qdot_op)i->op;
    row x = b->at[i->x], to, other;
    row y = qdot_operations[op].operands > 1 ? b->at[i->y] : x;
    row z = qdot_operations[op].operands > 2 ? b->at[i->z] : y;

    switch (op) {
    case QDOT_OP_NEG: return emit(b, QDOT_T_NEG, op, x, x, x);
    case QDOT_OP_ADD:
    case QDOT_OP_SUB: return sum(b, op, x, y);
    case QDOT_OP_MUL:
    case QDOT_OP_MADD:
    case QDOT_OP_MSUB:
    case QDOT_OP_NMADD: return product(b, op, x, y, z);
    case QDOT_OP_DIV: return emit(b, QDOT_T_DIV, op, x, y, y);
    case QDOT_OP_SQRT: return emit(b, QDOT_T_SQRT, op, x, x, x);
    case QDOT_OP_POW: return power(b, x, y);
    case QDOT_OP_SINCOS: return pair(b, QDOT_T_SINCOS, x, second);
    case QDOT_OP_SIN: return pair(b, QDOT_T_SINCOS, x, &other);
    case QDOT_OP_COS: return pair(b, QDOT_T_SINCOS, x, &other), other;
    case QDOT_OP_SINH: return pair(b, QDOT_T_SINHCOSH, x, &other);
    case QDOT_OP_COSH: return pair(b, QDOT_T_SINHCOSH, x, &other), other;
    case QDOT_OP_ATAN2: return arctangent(b, x, y);
    case QDOT_OP_EXP:
        to = emit(b, QDOT_T_EXP, op, x, x, x);
        with_d(b);
        return to;
    case QDOT_OP_ERF:
    case QDOT_OP_ERFC:
        to = emit(b, QDOT_T_ALONG, op, x, y, y);
        with_d(b);
        return to;
    case QDOT_OP_TANH:
        to = emit(b, QDOT_T_TANH, op, x, x, x);
        with_second(b);
        with_d(b);
        return to;
    default: return ratio(b, op, x);
    }
}

const char *
qdot_taylor_hindrance(const qdot_tape *tape)
{
    for (size_t i = 0; i < tape->length; i++)
        if (switches(tape->code[i].op))
            return qdot_operations[tape->code[i].op].name;
    return NULL;
}

static qdot_status
build(builder *b)
{
    const qdot_tape *tape = b->tape;

    for (size_t i = 0; i < tape->inputs; i++)
        b->at[i] = new_row(b, NAN, i >= b->moving);
    for (size_t i = 0; i < tape->constants; i++)
        b->at[tape->inputs + i] = new_row(b, tape->constant[i], true);
    for (size_t i = 0; i < tape->length && b->status == QDOT_OK; i++) {
        const qdot_instruction *in = tape->code + i;
        row second = NO_ROW, to = build_one(b, in, &second);

        b->at[in->to] = to;
        if (in->op == QDOT_OP_SINCOS)
            b->at[in->y] = second;
    }
    add(b, (draft){.op = QDOT_T_END});
    return b->status;
}

static double *
place(const qdot_taylor *t, row r)
{
    return r == NO_ROW ? NULL : t->coefficients + (size_t)r * t->stride;
}

/* Rows get their places, steps their pointers. */
static qdot_status
settle(qdot_taylor *t, const builder *b, int most, size_t unknowns)
{
    const qdot_tape *tape = b->tape;
    size_t still = 0;

    /* an odd number of cache lines apart, so that rows do not share a few sets */
    t->stride = (((size_t)most + 2 + 7) / 8 | 1) * 8;
    t->per_row = ((uint64_t)1 << 32) / t->stride + 1;
    t->spare = b->constants.n;
    t->rows = t->spare + 2 * unknowns;
    t->inputs = tape->inputs;
    t->outputs = tape->outputs;
    t->length = b->drafts.n - 1;
    t->convolutions = b->convolutions;
    t->moving = b->moving;
    t->allocated = qdot_calloc(t->rows * t->stride + LINE, sizeof *t->coefficients);
    t->output = qdot_calloc(t->outputs + 1, sizeof *t->output);
    t->constant = qdot_calloc(t->outputs + 1, sizeof *t->constant);
    t->steps = qdot_calloc(b->drafts.n, sizeof *t->steps);
    if (!t->allocated || !t->output || !t->constant || !t->steps)
        return QDOT_ENOMEM;
    t->coefficients = t->allocated;
    while ((uintptr_t)(t->coefficients + 1) % (LINE * sizeof(double)) != 0)
        t->coefficients++;
    for (size_t r = 0; r < t->spare; r++)
        if (!isnan(b->constants.at[r]))
            t->coefficients[r * t->stride] = b->constants.at[r];
    for (size_t i = 0; i < b->drafts.n; i++)
        still += b->drafts.at[i].still;
    t->still = still;
    for (size_t i = 0, first = 0, then = still; i < b->drafts.n; i++) {
        const draft *d = b->drafts.at + i;
        qdot_taylor_step *step = t->steps + (d->still ? first++ : then++);

        *step = (qdot_taylor_step){.op = d->op,
                                         .zero = d->zero,
                                         .sign = d->sign,
                                         .to = place(t, d->to),
                                         .second = place(t, d->second),
                                         .third = place(t, d->third),
                                         .d = place(t, d->d),
                                         .x = place(t, d->x),
                                         .y = place(t, d->y),
                                         .z = place(t, d->z)};
    }
    for (size_t i = 0; i < t->outputs; i++) {
        row r = b->at[tape->output[i]];

        t->output[i] = place(t, r);
        t->constant[i] = is_constant(b, r);
    }
    t->drawn = qdot_calloc(tape->constants + 1, sizeof *t->drawn);
    if (!t->drawn)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < tape->constants; i++)
        if (tape->low[i] != 0) {
            double near = tape->constant[i], far = qdot_shake_double(near, tape->side[i]);

            t->drawn[t->n_drawn++] =
                (struct qdot_taylor_drawn){t->coefficients + (t->inputs + i) * t->stride,
                                           near, far, tape->low[i] / (far - near)};
        }
    t->kernels = qdot_series_kernels_get();
    return QDOT_OK;
}

static qdot_status
make(const qdot_tape *tape, int most, size_t moving, size_t unknowns,
     qdot_taylor **taylor)
{
    const char *hindrance = qdot_taylor_hindrance(tape);
    builder b = {.tape = tape, .moving = moving};
    qdot_taylor *t;
    qdot_status status;

    *taylor = NULL;
    if (most < 0 || most > QDOT_SERIES_MOST)
        return qdot_fail(QDOT_EINVAL, "an order of %d is out of range", most);
    if (hindrance)
        return qdot_fail(QDOT_ENOTBUILT,
                         "not built yet: Taylor series of equations that switch (%s)",
                         hindrance);
    t = qdot_calloc(1, sizeof *t);
    b.at = qdot_calloc(tape->places + 1, sizeof *b.at);
    status = t && b.at ? build(&b) : QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = settle(t, &b, most, unknowns);
    qdot_free(b.at);
    qdot_free(b.drafts.at);
    qdot_free(b.constants.at);
    qdot_free(b.still.at);
    qdot_free(b.sincos.at);
    qdot_free(b.sinhcosh.at);
    if (status != QDOT_OK) {
        qdot_taylor_free(t);
        return status;
    }
    *taylor = t;
    return QDOT_OK;
}

qdot_status
qdot_taylor_new(const qdot_tape *tape, int most, qdot_taylor **taylor)
{
    return make(tape, most, tape->inputs, 0, taylor);
}

qdot_status
qdot_taylor_new_moving(const qdot_tape *tape, bool shaken, int most, size_t moving,
                       size_t unknowns, qdot_taylor **taylor)
{
    qdot_tape *copy = NULL;
    qdot_status status;

    if (shaken)
        QDOT_TRY(qdot_tape_shake(tape, &copy));
    status = make(copy ? copy : tape, most, moving, unknowns, taylor);
    qdot_tape_free(copy);
    return status;
}

qdot_status
qdot_taylor_new_shaken(const qdot_tape *tape, bool shaken, int most, qdot_taylor **taylor)
{
    return qdot_taylor_new_moving(tape, shaken, most, tape->inputs, 0, taylor);
}

static void
free_block(qdot_taylor_block *b)
{
    qdot_free(b->f);
    qdot_free(b->a);
    qdot_free(b->couplings);
    qdot_free(b->matrices);
}

void
qdot_taylor_free(qdot_taylor *t)
{
    if (!t)
        return;
    qdot_taylor_changes_free(t);
    qdot_taylor_code_free(t->code);
    for (size_t b = 0; b < t->n_blocks; b++)
        free_block(t->blocks + b);
    qdot_free(t->blocks);
    qdot_free(t->allocated);
    qdot_free(t->output);
    qdot_free(t->constant);
    qdot_free(t->steps);
    qdot_free(t->drawn);
    qdot_free(t);
}

qdot_status
qdot_taylor_link(qdot_taylor *t, size_t i, size_t twice, const double *from)
{
    size_t capacity = t->length + t->n_links + 1;
    qdot_taylor_step *link;

    QDOT_TRY(qdot_grow(&t->steps, &capacity, capacity + 1, sizeof *t->steps));
    link = t->steps + t->length + t->n_links++;
    link[1] = link[0];
    *link = (qdot_taylor_step){
        .op = QDOT_T_LINK,
        .to = t->coefficients + i * t->stride,
        .second = twice != SIZE_MAX ? t->coefficients + twice * t->stride : NULL,
        .x = from};
    return QDOT_OK;
}

bool
qdot_taylor_may_be_code(void)
{
    return qdot_x86_is_here();
}

bool
qdot_taylor_is_code(const qdot_taylor *t, int to)
{
    return t->code && qdot_taylor_code_orders(t->code) == to;
}

qdot_status
qdot_taylor_prepare(qdot_taylor *t, int to)
{
    if (to < 1 || to > QDOT_SERIES_MOST)
        return qdot_fail(QDOT_EINVAL, "an order of %d is out of range", to);
    if (qdot_taylor_is_code(t, to))
        return QDOT_OK;
    qdot_taylor_drop_code(t);
    return qdot_taylor_code_new(t, to, false, &t->code, &t->no_code);
}

bool
qdot_taylor_take_kept(qdot_taylor *t, int to)
{
    const char *why;

    if (t->asked || t->code || to < 1 || to > QDOT_SERIES_MOST)
        return false;
    t->asked = true;
    return qdot_taylor_code_new(t, to, true, &t->code, &why) == QDOT_OK && t->code;
}

void
qdot_taylor_drop_code(qdot_taylor *t)
{
    qdot_taylor_code_free(t->code);
    t->code = NULL;
}

size_t
qdot_taylor_code_bytes(const qdot_taylor *t, const char **why)
{
    *why = t->code ? NULL : t->no_code;
    return t->code ? qdot_taylor_code_size(t->code) : 0;
}

double *
qdot_taylor_input(qdot_taylor *t, size_t i)
{
    return t->coefficients + i * t->stride;
}

size_t
qdot_taylor_stride(const qdot_taylor *t)
{
    return t->stride;
}

const double *
qdot_taylor_output(const qdot_taylor *t, size_t i)
{
    return t->output[i];
}

bool
qdot_taylor_is_constant(const qdot_taylor *t, size_t i)
{
    return t->constant[i];
}

double
qdot_taylor_convolutions(const qdot_taylor *t)
{
    return t->convolutions;
}

size_t
qdot_taylor_length(const qdot_taylor *t)
{
    return t->length - t->still;
}
