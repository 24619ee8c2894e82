/* taylor.c -- from a tape to recurrences, and their evaluation order by order. */
#include "tape/taylor.h"

#include <math.h>
#include <string.h>

#include "num/series.h"
#include "tape/code.h"

/* Recurrences: by order k > 0. */
typedef enum {
    T_END,
    T_NEG,
    T_ADD,
    T_SUB,
    T_SCALE,    /* c x */
    T_SCALEADD, /* c x + z */
    T_SCALESUB, /* c x - z */
    T_MUL,
    T_SQUARE,
    T_MADD,
    T_MSUB,
    T_NMADD,
    T_DIV,
    T_SQRT,
    T_SINCOS, /* to, second; d: j x_j */
    T_SINHCOSH,
    T_EXP,
    T_POW,   /* d: j x_j; z: the exponent, a constant */
    T_RATIO, /* l' = +-x'/y; d: j l_j; sign in `sign` */
    T_TANH,  /* second: 1 - to^2; d: j x_j */
    T_ATAN2, /* of x by y: y its second argument, z: x^2 + y^2; d, second, third: j l_j,
                j x_j, j y_j */
    T_COUNT
} recurrence;

/* Values of order 0 that operation.def does not have. */
enum { ZERO_SINHCOSH = QDOT_OP_COUNT, ZERO_POWER };

/* Rows of coefficients, by order; the last place of a row is what qdot_taylor_correct
 * adds to the newest coefficient. */
typedef struct {
    uint16_t op, zero; /* recurrence; how order 0 is computed */
    int sign;
    double *to, *second, *third, *d;
    const double *x, *y, *z;
    double c; /* a constant factor, or the inverse of what every order divides by */
} step;

struct qdot_taylor {
    const qdot_series_kernels *kernels;
    size_t stride, inputs, outputs, rows;
    double convolutions;
    double *coefficients;     /* [rows x stride], the inputs first */
    const double **output;    /* [outputs] rows */
    bool *constant;           /* [outputs] */
    step *steps;              /* [length], T_END behind them */
    size_t length;
    double inverse[QDOT_SERIES_MOST + 1]; /* 1/k */
};

/* --- building ----------------------------------------------------------------------- */

typedef uint32_t row; /* of coefficients, by number while the rows are not yet there */

#define NO_ROW UINT32_MAX

/* A step while rows are numbers. */
typedef struct {
    uint16_t op, zero;
    int sign;
    row to, second, third, d, x, y, z;
    double c;
} draft;

typedef struct {
    const qdot_tape *tape;
    row *at;                      /* [tape->places] the row a place has now */
    qdot_vec(draft) drafts;
    qdot_vec(double) constants;   /* [rows] the number, NaN: not constant */
    qdot_vec(row) sincos, sinhcosh; /* [rows] sine of the pair made of a row; NO_ROW */
    double convolutions;
    draft nothing; /* written to after a failure */
    qdot_status status;
} builder;

static row
new_row(builder *b, double constant)
{
    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->constants, constant);
    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->sincos, NO_ROW);
    if (b->status == QDOT_OK)
        b->status = qdot_vec_push(&b->sinhcosh, NO_ROW);
    return b->status == QDOT_OK ? (row)(b->constants.n - 1) : 0;
}

static bool
is_constant(const builder *b, row r)
{
    return b->status == QDOT_OK && !isnan(b->constants.at[r]);
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
emit(builder *b, recurrence op, int zero, row x, row y, row z)
{
    static const double cost[T_COUNT] = {
        [T_MUL] = 1,    [T_SQUARE] = 0.5,  [T_MADD] = 1, [T_MSUB] = 1, [T_NMADD] = 1,
        [T_DIV] = 1,    [T_SQRT] = 0.5,    [T_EXP] = 1,  [T_POW] = 2,  [T_RATIO] = 1,
        [T_SINCOS] = 2, [T_SINHCOSH] = 2,  [T_TANH] = 1.5, [T_ATAN2] = 3};
    row to = new_row(b, NAN);

    b->convolutions += cost[op];
    add(b, (draft){.op = (uint16_t)op, .zero = (uint16_t)zero, .sign = 1, .to = to,
                   .second = NO_ROW, .third = NO_ROW, .d = NO_ROW, .x = x, .y = y,
                   .z = z});
    return to;
}

/* Work rows of the step just emitted. */
static void
with_d(builder *b)
{
    row d = new_row(b, NAN);

    last(b)->d = d;
}

static void
with_second(builder *b)
{
    row second = new_row(b, NAN);

    last(b)->second = second;
}

static void
with_third(builder *b)
{
    row third = new_row(b, NAN);

    last(b)->third = third;
}

/* c x, c x + z, c x - z or z - c x. */
static row
scaled(builder *b, qdot_op op, row constant, row x, row z)
{
    double c = b->constants.at[constant];
    recurrence r = op == QDOT_OP_MUL ? T_SCALE : op == QDOT_OP_MSUB ? T_SCALESUB
                                                                    : T_SCALEADD;
    row to = emit(b, r, op, constant, x, z);
    draft *d = last(b);

    /* order 0 as the tape has it; then: */
    d->c = op == QDOT_OP_NMADD ? -c : c;
    return to;
}

static row
product(builder *b, qdot_op op, row x, row y, row z)
{
    static const recurrence plain[QDOT_OP_COUNT] = {[QDOT_OP_MUL] = T_MUL,
                                                    [QDOT_OP_MADD] = T_MADD,
                                                    [QDOT_OP_MSUB] = T_MSUB,
                                                    [QDOT_OP_NMADD] = T_NMADD};
    row square;

    if (is_constant(b, x))
        return scaled(b, op, x, y, z);
    if (is_constant(b, y))
        return scaled(b, op, y, x, z);
    if (x != y)
        return emit(b, plain[op], op, x, y, z);
    square = emit(b, T_SQUARE, QDOT_OP_MUL, x, x, x);
    if (op == QDOT_OP_MADD)
        return emit(b, T_ADD, QDOT_OP_ADD, square, z, z);
    if (op == QDOT_OP_MSUB)
        return emit(b, T_SUB, QDOT_OP_SUB, square, z, z);
    if (op == QDOT_OP_NMADD)
        return emit(b, T_SUB, QDOT_OP_SUB, z, square, square);
    return square;
}

/* Sine of the pair of x, *cosine beside it. */
static row
pair(builder *b, recurrence op, row x, row *cosine)
{
    row *made;
    row to;

    if (b->status != QDOT_OK)
        return *cosine = 0;
    made = op == T_SINCOS ? b->sincos.at + x : b->sinhcosh.at + x;
    if (*made != NO_ROW) {
        *cosine = *made + 1;
        return *made;
    }
    to = emit(b, op, op == T_SINCOS ? QDOT_OP_SINCOS : ZERO_SINHCOSH, x, x, x);
    with_second(b);
    with_d(b);
    *cosine = to + 1;
    if (b->status == QDOT_OK)
        (op == T_SINCOS ? b->sincos.at : b->sinhcosh.at)[x] = to;
    return to;
}

static row
number(builder *b, double c)
{
    return new_row(b, c);
}

static row
sum(builder *b, qdot_op op, row x, row y)
{
    return emit(b, op == QDOT_OP_ADD ? T_ADD : T_SUB, op, x, y, y);
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
    return emit(b, T_SQRT, QDOT_OP_SQRT, square, square, square);
}

static row
ratio(builder *b, qdot_op f, row x)
{
    row u = denominator(b, f, x), to = emit(b, T_RATIO, f, x, u, u);

    last(b)->sign = f == QDOT_OP_ACOS ? -1 : 1;
    with_d(b);
    return to;
}

static row
power(builder *b, row x, row exponent)
{
    row to, l;

    if (is_constant(b, exponent)) {
        to = emit(b, T_POW, QDOT_OP_POW, x, exponent, exponent);
        with_d(b);
        return to;
    }
    l = product(b, QDOT_OP_MUL, ratio(b, QDOT_OP_LOG, x), exponent, exponent);
    to = emit(b, T_EXP, ZERO_POWER, l, x, exponent);
    with_d(b);
    return to;
}

static row
arctangent(builder *b, row y, row x)
{
    row xx = product(b, QDOT_OP_MUL, x, x, x), u = product(b, QDOT_OP_MADD, y, y, xx);
    row to = emit(b, T_ATAN2, QDOT_OP_ATAN2, y, x, u);

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
    case QDOT_OP_NEG: return emit(b, T_NEG, op, x, x, x);
    case QDOT_OP_ADD:
    case QDOT_OP_SUB: return sum(b, op, x, y);
    case QDOT_OP_MUL:
    case QDOT_OP_MADD:
    case QDOT_OP_MSUB:
    case QDOT_OP_NMADD: return product(b, op, x, y, z);
    case QDOT_OP_DIV: return emit(b, T_DIV, op, x, y, y);
    case QDOT_OP_SQRT: return emit(b, T_SQRT, op, x, x, x);
    case QDOT_OP_POW: return power(b, x, y);
    case QDOT_OP_SINCOS: return pair(b, T_SINCOS, x, second);
    case QDOT_OP_SIN: return pair(b, T_SINCOS, x, &other);
    case QDOT_OP_COS: return pair(b, T_SINCOS, x, &other), other;
    case QDOT_OP_SINH: return pair(b, T_SINHCOSH, x, &other);
    case QDOT_OP_COSH: return pair(b, T_SINHCOSH, x, &other), other;
    case QDOT_OP_ATAN2: return arctangent(b, x, y);
    case QDOT_OP_EXP:
        to = emit(b, T_EXP, op, x, x, x);
        with_d(b);
        return to;
    case QDOT_OP_TANH:
        to = emit(b, T_TANH, op, x, x, x);
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
        b->at[i] = new_row(b, NAN);
    for (size_t i = 0; i < tape->constants; i++)
        b->at[tape->inputs + i] = new_row(b, tape->constant[i]);
    for (size_t i = 0; i < tape->length && b->status == QDOT_OK; i++) {
        const qdot_instruction *in = tape->code + i;
        row second = NO_ROW, to = build_one(b, in, &second);

        b->at[in->to] = to;
        if (in->op == QDOT_OP_SINCOS)
            b->at[in->y] = second;
    }
    add(b, (draft){.op = T_END});
    return b->status;
}

static double *
place(const qdot_taylor *t, row r)
{
    return r == NO_ROW ? NULL : t->coefficients + (size_t)r * t->stride;
}

/* Rows get their places, steps their pointers. */
static qdot_status
settle(qdot_taylor *t, const builder *b, int most)
{
    const qdot_tape *tape = b->tape;

    /* an odd number of cache lines apart, so that rows do not share a few sets */
    t->stride = (((size_t)most + 2 + 7) / 8 | 1) * 8;
    t->rows = b->constants.n;
    t->inputs = tape->inputs;
    t->outputs = tape->outputs;
    t->length = b->drafts.n - 1;
    t->convolutions = b->convolutions;
    t->coefficients = qdot_calloc(t->rows * t->stride + 1, sizeof *t->coefficients);
    t->output = qdot_calloc(t->outputs + 1, sizeof *t->output);
    t->constant = qdot_calloc(t->outputs + 1, sizeof *t->constant);
    t->steps = qdot_calloc(b->drafts.n, sizeof *t->steps);
    if (!t->coefficients || !t->output || !t->constant || !t->steps)
        return QDOT_ENOMEM;
    for (size_t r = 0; r < t->rows; r++)
        if (!isnan(b->constants.at[r]))
            t->coefficients[r * t->stride] = b->constants.at[r];
    for (size_t i = 0; i < b->drafts.n; i++) {
        const draft *d = b->drafts.at + i;

        t->steps[i] = (step){.op = d->op, .zero = d->zero, .sign = d->sign, .c = d->c,
                             .to = place(t, d->to), .second = place(t, d->second),
                             .third = place(t, d->third), .d = place(t, d->d),
                             .x = place(t, d->x), .y = place(t, d->y),
                             .z = place(t, d->z)};
    }
    for (size_t i = 0; i < t->outputs; i++) {
        row r = b->at[tape->output[i]];

        t->output[i] = place(t, r);
        t->constant[i] = is_constant(b, r);
    }
    for (int k = 1; k <= QDOT_SERIES_MOST; k++)
        t->inverse[k] = 1.0 / k;
    t->kernels = qdot_series_kernels_get();
    return QDOT_OK;
}

qdot_status
qdot_taylor_new(const qdot_tape *tape, int most, qdot_taylor **taylor)
{
    const char *hindrance = qdot_taylor_hindrance(tape);
    builder b = {.tape = tape};
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
        status = settle(t, &b, most);
    qdot_free(b.at);
    qdot_free(b.drafts.at);
    qdot_free(b.constants.at);
    qdot_free(b.sincos.at);
    qdot_free(b.sinhcosh.at);
    if (status != QDOT_OK) {
        qdot_taylor_free(t);
        return status;
    }
    *taylor = t;
    return QDOT_OK;
}

void
qdot_taylor_free(qdot_taylor *t)
{
    if (!t)
        return;
    qdot_free(t->coefficients);
    qdot_free(t->output);
    qdot_free(t->constant);
    qdot_free(t->steps);
    qdot_free(t);
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
    return t->length;
}

/* --- evaluation --------------------------------------------------------------------- */

static void
value_of_zero(step *i)
{
    double a = i->x[0], b = i->y[0], c = i->z[0], d = 0, e = 0;

    switch (i->zero) {
#define X(ID, name, operands, operations, calls, statement)                              \
    case QDOT_OP_##ID: statement; break;
#include "tape/operation.def"
#undef X
    case ZERO_SINHCOSH:
        d = sinh(a);
        e = cosh(a);
        break;
    case ZERO_POWER: d = pow(b, c); break;
    }
    i->to[0] = d;
    switch (i->op) {
    case T_SINCOS:
    case T_SINHCOSH: i->second[0] = e; break;
    case T_TANH: i->second[0] = (1 - d) * (1 + d); break;
    case T_DIV:
    case T_RATIO: i->c = 1 / b; break;
    case T_SQRT: i->c = 0.5 / d; break;
    case T_POW: i->c = 1 / a; break;
    case T_ATAN2: i->c = 1 / c; break;
    }
}

/* sum_{j=from..k-from} x_j x_{k-j} */
static inline double
square(const qdot_series_kernels *kernels, const double *x, int k, int from)
{
    int n = (k + 1) / 2 - from;
    double sum = 2 * kernels->dot[n](x + from, x + k - from);

    return k % 2 ? sum : sum + x[k / 2] * x[k / 2];
}

static void
arctangent_order(const qdot_series_kernels *kernels, const step *i, int k)
{
    qdot_series_dot *dot = kernels->dot[k];
    double numerator;

    i->second[k] = k * i->x[k];
    i->third[k] = k * i->y[k];
    numerator = dot(i->second + 1, i->y + k - 1) - dot(i->third + 1, i->x + k - 1);
    i->d[k] = (numerator - kernels->dot[k - 1](i->d + 1, i->z + k - 1)) * i->c;
}

void
qdot_taylor_order(qdot_taylor *t, int k)
{
    static const void *const row_of[T_COUNT] = {
        [T_END] = &&do_end,           [T_NEG] = &&do_neg,
        [T_ADD] = &&do_add,           [T_SUB] = &&do_sub,
        [T_SCALE] = &&do_scale,       [T_SCALEADD] = &&do_scaleadd,
        [T_SCALESUB] = &&do_scalesub, [T_MUL] = &&do_mul,
        [T_SQUARE] = &&do_square,     [T_MADD] = &&do_madd,
        [T_MSUB] = &&do_msub,         [T_NMADD] = &&do_nmadd,
        [T_DIV] = &&do_div,           [T_SQRT] = &&do_sqrt,
        [T_SINCOS] = &&do_sincos,     [T_SINHCOSH] = &&do_sinhcosh,
        [T_EXP] = &&do_exp,           [T_POW] = &&do_pow,
        [T_RATIO] = &&do_ratio,       [T_TANH] = &&do_tanh,
        [T_ATAN2] = &&do_atan2,
    };
    const qdot_series_kernels *const kernels = t->kernels;
    const step *i = t->steps;
    const double inverse = t->inverse[k];
    qdot_series_dot *below, *upto; /* k terms, k + 1 terms */
    qdot_series_two both;
    double u, v;

    if (k == 0) {
        for (step *s = t->steps; s->op != T_END; s++)
            value_of_zero(s);
        return;
    }
    below = kernels->dot[k];
    upto = kernels->dot[k + 1];
#define NEXT goto *row_of[(++i)->op]
    goto *row_of[i->op];
do_neg:
    i->to[k] = -i->x[k];
    NEXT;
do_add:
    i->to[k] = i->x[k] + i->y[k];
    NEXT;
do_sub:
    i->to[k] = i->x[k] - i->y[k];
    NEXT;
do_scale:
    i->to[k] = i->c * i->y[k];
    NEXT;
do_scaleadd:
    i->to[k] = i->c * i->y[k] + i->z[k];
    NEXT;
do_scalesub:
    i->to[k] = i->c * i->y[k] - i->z[k];
    NEXT;
do_mul:
    i->to[k] = upto(i->x, i->y + k);
    NEXT;
do_square:
    i->to[k] = square(kernels, i->x, k, 0);
    NEXT;
do_madd:
    i->to[k] = upto(i->x, i->y + k) + i->z[k];
    NEXT;
do_msub:
    i->to[k] = upto(i->x, i->y + k) - i->z[k];
    NEXT;
do_nmadd:
    i->to[k] = i->z[k] - upto(i->x, i->y + k);
    NEXT;
do_div:
    i->to[k] = (i->x[k] - below(i->y + 1, i->to + k - 1)) * i->c;
    NEXT;
do_sqrt:
    i->to[k] = (i->x[k] - square(kernels, i->to, k, 1)) * i->c;
    NEXT;
do_sincos:
    i->d[k] = k * i->x[k];
    both = kernels->pair[k](i->d + 1, i->second + k - 1, i->to + k - 1);
    i->to[k] = inverse * both.b;
    i->second[k] = -inverse * both.c;
    NEXT;
do_sinhcosh:
    i->d[k] = k * i->x[k];
    both = kernels->pair[k](i->d + 1, i->second + k - 1, i->to + k - 1);
    i->to[k] = inverse * both.b;
    i->second[k] = inverse * both.c;
    NEXT;
do_exp:
    i->d[k] = k * i->x[k];
    i->to[k] = inverse * below(i->d + 1, i->to + k - 1);
    NEXT;
do_pow:
    i->d[k] = k * i->x[k];
    u = below(i->d + 1, i->to + k - 1);
    v = below(i->x + 1, i->to + k - 1);
    i->to[k] = ((i->z[0] + 1) * inverse * u - v) * i->c;
    NEXT;
do_ratio:
    u = i->sign * k * i->x[k];
    i->d[k] = (u - kernels->dot[k - 1](i->d + 1, i->y + k - 1)) * i->c;
    i->to[k] = i->d[k] * inverse;
    NEXT;
do_tanh:
    i->d[k] = k * i->x[k];
    i->to[k] = inverse * below(i->d + 1, i->second + k - 1);
    i->second[k] = -square(kernels, i->to, k, 0);
    NEXT;
do_atan2:
    arctangent_order(kernels, i, k);
    i->to[k] = i->d[k] * inverse;
    NEXT;
do_end:
    return;
#undef NEXT
}

/* --- correction --------------------------------------------------------------------- */

/* What changes by d: coefficient k of a row, and its note of it. */
static inline void
change(const qdot_taylor *t, double *row, int k, double d)
{
    row[k] += d;
    row[t->stride - 1] = d;
}

void
qdot_taylor_correct(qdot_taylor *t, int k, size_t n, const double *newest)
{
    const size_t note = t->stride - 1;

    for (size_t i = 0; i < n; i++)
        change(t, t->coefficients + i * t->stride, k, newest[i]);
    for (const step *i = t->steps; i->op != T_END; i++) {
        const double x = i->x[note], y = i->y[note], z = i->z[note];
        double d = 0;

        switch (i->op) {
        case T_NEG: d = -x; break;
        case T_ADD: d = x + y; break;
        case T_SUB: d = x - y; break;
        case T_SCALE: d = i->c * y; break;
        case T_SCALEADD: d = i->c * y + z; break;
        case T_SCALESUB: d = i->c * y - z; break;
        case T_MUL: d = i->x[0] * y + i->y[0] * x; break;
        case T_SQUARE: d = 2 * i->x[0] * x; break;
        case T_MADD: d = i->x[0] * y + i->y[0] * x + z; break;
        case T_MSUB: d = i->x[0] * y + i->y[0] * x - z; break;
        case T_NMADD: d = z - i->x[0] * y - i->y[0] * x; break;
        case T_DIV: d = (x - i->to[0] * y) * i->c; break;
        case T_SQRT: d = x * i->c; break;
        case T_SINCOS:
            d = i->second[0] * x;
            change(t, i->second, k, -i->to[0] * x);
            change(t, i->d, k, k * x);
            break;
        case T_SINHCOSH:
            d = i->second[0] * x;
            change(t, i->second, k, i->to[0] * x);
            change(t, i->d, k, k * x);
            break;
        case T_EXP:
            d = i->to[0] * x;
            change(t, i->d, k, k * x);
            break;
        case T_POW:
            d = i->z[0] * i->to[0] * x * i->c;
            change(t, i->d, k, k * x);
            break;
        case T_RATIO:
            d = i->sign * x * i->c;
            change(t, i->d, k, k * d);
            break;
        case T_TANH:
            d = i->second[0] * x;
            change(t, i->second, k, -2 * i->to[0] * d);
            change(t, i->d, k, k * x);
            break;
        case T_ATAN2:
            d = (i->y[0] * x - i->x[0] * y) * i->c;
            change(t, i->second, k, k * x);
            change(t, i->third, k, k * y);
            change(t, i->d, k, k * d);
            break;
        }
        change(t, i->to, k, d);
    }
}
