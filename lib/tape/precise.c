/* precise.c -- the recurrences in MPFR, a function a row of operation.def. */
#include "tape/precise.h"

#include <math.h>
#include <stdint.h>

#include "num/real.h"
#include "tape/code.h"
#include "tape/constant.h"
#include "tape/near.h"
#include "tape/taylor.h"

enum { MOST_OWN = 4 };

/* An instruction with the rows it reads and writes. */
typedef struct {
    uint32_t op;
    mpfr_t *x, *y, *z; /* operands; those that it has not are x */
    mpfr_t *to;
    mpfr_t *own[MOST_OWN]; /* further rows that it writes: the second result first */
    bool x_constant, y_constant;
} step;

struct qdot_precise {
    size_t stride, inputs, outputs, rows, length;
    qdot_reals numbers; /* [rows x stride], the inputs first */
    qdot_reals scratch; /* [SCRATCH] */
    mp_limb_t *work;    /* of a dot */
    mpfr_t *w;          /* scratch.at */
    step *steps;        /* [length] */
    const mpfr_t **output;
    bool *constant; /* [outputs] */
};

/* Orders that are looked at of arguments of exponentials: those beyond add little to a step that
 * goes no further than these say. */
enum { QDOT_PRECISE_NEAR = 200 };

enum { SCRATCH = 4 };

#define RN MPFR_RNDN

/* --- sums of products --------------------------------------------------------------- */

/* sum = sum_{j=from..k-below} a_j b_{k-j} */
static void
convolve(qdot_precise *p, mpfr_ptr sum, const mpfr_t *a, const mpfr_t *b, int k, int from,
         int below)
{
    int n = k - below - from + 1;

    if (n > 0)
        qdot_real_dot(sum, a + from, b + (k - from), (size_t)n, p->work);
    else
        mpfr_set_zero(sum, 1);
}

/* sum = sum_{j=from..k-from} a_j a_{k-j}; w[3] is used */
static void
square(qdot_precise *p, mpfr_ptr sum, const mpfr_t *a, int k, int from)
{
    int n = (k + 1) / 2 - from;

    mpfr_set_zero(sum, 1);
    if (n > 0)
        qdot_real_dot(sum, a + from, a + (k - from), (size_t)n, p->work);
    mpfr_mul_2ui(sum, sum, 1, RN);
    if (k % 2 == 0 && k / 2 >= from) {
        mpfr_sqr(p->w[3], a[k / 2], RN);
        mpfr_add(sum, sum, p->w[3], RN);
    }
}

/* d_k = k a_k */
static void
slope(mpfr_t *d, const mpfr_t *a, int k)
{
    mpfr_mul_ui(d[k], a[k], (unsigned long)k, RN);
}

/* --- rows ---------------------------------------------------------------------------- */

/* to_k = (x y)_k; w[3] is used */
static void
product(qdot_precise *p, const step *i, mpfr_ptr to, int k)
{
    if (i->x_constant || k == 0)
        mpfr_mul(to, i->x[0], i->y[k], RN);
    else if (i->y_constant)
        mpfr_mul(to, i->x[k], i->y[0], RN);
    else if (i->x == i->y)
        square(p, to, i->x, k, 0);
    else
        convolve(p, to, i->x, i->y, k, 0, 0);
}

/* l' = +-a'/u, d_k = k l_k; order 0 of l is there */
static void
ratio(qdot_precise *p, mpfr_t *l, mpfr_t *d, const mpfr_t *a, const mpfr_t *u, int sign,
      int k)
{
    if (k == 0)
        return;
    mpfr_mul_si(d[k], a[k], sign * k, RN);
    convolve(p, p->w[0], d, u, k, 1, 1);
    mpfr_sub(d[k], d[k], p->w[0], RN);
    mpfr_div(d[k], d[k], u[0], RN);
    mpfr_div_ui(l[k], d[k], (unsigned long)k, RN);
}

/* r = sqrt a; w[0] is used */
static void
root(qdot_precise *p, mpfr_t *r, const mpfr_t *a, int k)
{
    if (k == 0) {
        mpfr_sqrt(r[0], a[0], RN);
        return;
    }
    square(p, p->w[0], r, k, 1);
    mpfr_sub(p->w[0], a[k], p->w[0], RN);
    mpfr_div(p->w[0], p->w[0], r[0], RN);
    mpfr_div_2ui(r[k], p->w[0], 1, RN);
}

/* u = c + sign a^2, c a whole number */
static void
square_and(qdot_precise *p, mpfr_t *u, const mpfr_t *a, int c, int sign, int k)
{
    square(p, u[k], a, k, 0);
    if (sign < 0)
        mpfr_neg(u[k], u[k], RN);
    if (k == 0)
        mpfr_add_si(u[0], u[0], c, RN);
}

/* e with k e_k = sum d_j e_{k-j}, d_j = j a_j; order 0 is there */
static void
exponential(qdot_precise *p, mpfr_t *e, mpfr_t *d, const mpfr_t *a, int k)
{
    slope(d, a, k);
    convolve(p, e[k], d, e, k, 1, 0);
    mpfr_div_ui(e[k], e[k], (unsigned long)k, RN);
}

/* s' = a' c, c' = sign a' s; order 0 is there */
static void
pair(qdot_precise *p, mpfr_t *s, mpfr_t *c, mpfr_t *d, const mpfr_t *a, int sign, int k)
{
    slope(d, a, k);
    convolve(p, s[k], d, c, k, 1, 0);
    convolve(p, c[k], d, s, k, 1, 0);
    mpfr_div_ui(s[k], s[k], (unsigned long)k, RN);
    mpfr_div_si(c[k], c[k], (long)sign * k, RN);
}

static void
circular(qdot_precise *p, mpfr_t *s, mpfr_t *c, mpfr_t *d, const mpfr_t *a, int k)
{
    if (k == 0)
        mpfr_sin_cos(s[0], c[0], a[0], RN);
    else
        pair(p, s, c, d, a, -1, k);
}

static void
hyperbolic(qdot_precise *p, mpfr_t *s, mpfr_t *c, mpfr_t *d, const mpfr_t *a, int k)
{
    if (k == 0)
        mpfr_sinh_cosh(s[0], c[0], a[0], RN);
    else
        pair(p, s, c, d, a, 1, k);
}

/* --- a row of operation.def each ----------------------------------------------------- */

#define ROW(ID) static void order_##ID(qdot_precise *p, const step *i, int k)

ROW(NEG)
{
    (void)p;
    mpfr_neg(i->to[k], i->x[k], RN);
}

ROW(ADD)
{
    (void)p;
    mpfr_add(i->to[k], i->x[k], i->y[k], RN);
}

ROW(SUB)
{
    (void)p;
    mpfr_sub(i->to[k], i->x[k], i->y[k], RN);
}

ROW(MUL)
{
    product(p, i, i->to[k], k);
}

ROW(MADD)
{
    product(p, i, i->to[k], k);
    mpfr_add(i->to[k], i->to[k], i->z[k], RN);
}

ROW(MSUB)
{
    product(p, i, i->to[k], k);
    mpfr_sub(i->to[k], i->to[k], i->z[k], RN);
}

ROW(NMADD)
{
    product(p, i, i->to[k], k);
    mpfr_sub(i->to[k], i->z[k], i->to[k], RN);
}

ROW(DIV)
{
    if (i->y_constant || k == 0) {
        mpfr_div(i->to[k], i->x[k], i->y[0], RN);
        return;
    }
    convolve(p, p->w[0], i->y, i->to, k, 1, 0);
    mpfr_sub(p->w[0], i->x[k], p->w[0], RN);
    mpfr_div(i->to[k], p->w[0], i->y[0], RN);
}

ROW(SQRT)
{
    root(p, i->to, i->x, k);
}

/* x^y: a constant exponent has its own recurrence; else exp(y log x), own: d, log x, its
 * slopes, the product. */
ROW(POW)
{
    if (k == 0) {
        mpfr_pow(i->to[0], i->x[0], i->y[0], RN);
        if (!i->y_constant) {
            mpfr_log(i->own[1][0], i->x[0], RN);
            mpfr_mul(i->own[3][0], i->own[1][0], i->y[0], RN);
        }
        return;
    }
    if (!i->y_constant) {
        ratio(p, i->own[1], i->own[2], i->x, i->x, 1, k);
        convolve(p, i->own[3][k], i->own[1], i->y, k, 0, 0);
        exponential(p, i->to, i->own[0], i->own[3], k);
        return;
    }
    slope(i->own[0], i->x, k);
    convolve(p, p->w[0], i->own[0], i->to, k, 1, 0);
    convolve(p, p->w[1], i->x, i->to, k, 1, 0);
    mpfr_add_ui(p->w[2], i->y[0], 1, RN);
    mpfr_mul(p->w[0], p->w[0], p->w[2], RN);
    mpfr_div_ui(p->w[0], p->w[0], (unsigned long)k, RN);
    mpfr_sub(p->w[0], p->w[0], p->w[1], RN);
    mpfr_div(i->to[k], p->w[0], i->x[0], RN);
}

ROW(SINCOS)
{
    circular(p, i->to, i->own[0], i->own[1], i->x, k);
}

ROW(SIN)
{
    circular(p, i->to, i->own[0], i->own[1], i->x, k);
}

ROW(COS)
{
    circular(p, i->own[0], i->to, i->own[1], i->x, k);
}

ROW(SINH)
{
    hyperbolic(p, i->to, i->own[0], i->own[1], i->x, k);
}

ROW(COSH)
{
    hyperbolic(p, i->own[0], i->to, i->own[1], i->x, k);
}

ROW(TANH)
{
    if (k == 0)
        mpfr_tanh(i->to[0], i->x[0], RN);
    else {
        slope(i->own[1], i->x, k);
        convolve(p, i->to[k], i->own[1], i->own[0], k, 1, 0);
        mpfr_div_ui(i->to[k], i->to[k], (unsigned long)k, RN);
    }
    square_and(p, i->own[0], i->to, 1, -1, k);
}

ROW(EXP)
{
    if (k == 0)
        mpfr_exp(i->to[0], i->x[0], RN);
    else
        exponential(p, i->to, i->own[0], i->x, k);
}

ROW(LOG)
{
    if (k == 0)
        mpfr_log(i->to[0], i->x[0], RN);
    ratio(p, i->to, i->own[0], i->x, i->x, 1, k);
}

/* own: d; y is their slope */
#define ALONG(ID, function)                                                              \
    ROW(ID)                                                                              \
    {                                                                                    \
        if (k == 0) {                                                                    \
            function(i->to[0], i->x[0], RN);                                             \
            return;                                                                      \
        }                                                                                \
        slope(i->own[0], i->x, k);                                                       \
        convolve(p, i->to[k], i->own[0], i->y, k, 1, 0);                                 \
        mpfr_div_ui(i->to[k], i->to[k], (unsigned long)k, RN);                           \
    }

ALONG(ERF, mpfr_erf)
ALONG(ERFC, mpfr_erfc)

/* own: d, the square, its root */
#define INVERSE(ID, function, c, square_sign, rooted, sign)                              \
    ROW(ID)                                                                              \
    {                                                                                    \
        if (k == 0)                                                                      \
            function(i->to[0], i->x[0], RN);                                             \
        square_and(p, i->own[1], i->x, c, square_sign, k);                               \
        if (rooted)                                                                      \
            root(p, i->own[2], i->own[1], k);                                            \
        ratio(p, i->to, i->own[0], i->x, i->own[rooted ? 2 : 1], sign, k);               \
    }

INVERSE(ASIN, mpfr_asin, 1, -1, true, 1)
INVERSE(ACOS, mpfr_acos, 1, -1, true, -1)
INVERSE(ATAN, mpfr_atan, 1, 1, false, 1)
INVERSE(ASINH, mpfr_asinh, 1, 1, true, 1)
INVERSE(ACOSH, mpfr_acosh, -1, 1, true, 1)
INVERSE(ATANH, mpfr_atanh, 1, -1, false, 1)

/* x is the ordinate; own: d, x^2 + y^2, slopes of x and of y */
ROW(ATAN2)
{
    mpfr_t *d = i->own[0], *u = i->own[1];

    if (k == 0)
        mpfr_atan2(i->to[0], i->x[0], i->y[0], RN);
    square(p, p->w[0], i->y, k, 0);
    square(p, u[k], i->x, k, 0);
    mpfr_add(u[k], u[k], p->w[0], RN);
    if (k == 0)
        return;
    slope(i->own[2], i->x, k);
    slope(i->own[3], i->y, k);
    convolve(p, p->w[0], i->own[2], i->y, k, 1, 0);
    convolve(p, p->w[1], i->own[3], i->x, k, 1, 0);
    mpfr_sub(p->w[0], p->w[0], p->w[1], RN);
    convolve(p, p->w[1], d, u, k, 1, 1);
    mpfr_sub(p->w[0], p->w[0], p->w[1], RN);
    mpfr_div(d[k], p->w[0], u[0], RN);
    mpfr_div_ui(i->to[k], d[k], (unsigned long)k, RN);
}

/* What switches is there at order 0 alone. */
#define SWITCH(ID, statement)                                                            \
    ROW(ID)                                                                              \
    {                                                                                    \
        mpfr_ptr d = i->to[0];                                                           \
        mpfr_srcptr a = i->x[0], b = i->y[0], c = i->z[0];                               \
                                                                                         \
        (void)p, (void)k, (void)b, (void)c;                                              \
        statement;                                                                       \
    }

/* d = a - b floor(a/b) */
static void
modulo(mpfr_ptr d, mpfr_srcptr a, mpfr_srcptr b, mpfr_ptr w)
{
    mpfr_div(w, a, b, RN);
    mpfr_floor(w, w);
    mpfr_mul(w, w, b, RN);
    mpfr_sub(d, a, w, RN);
}

SWITCH(ABS, mpfr_abs(d, a, RN))
SWITCH(SIGN, mpfr_nan_p(a) ? (void)mpfr_set_nan(d) : (void)mpfr_set_si(d, mpfr_sgn(a), RN))
SWITCH(MIN, mpfr_set(d, mpfr_nan_p(a) || mpfr_less_p(a, b) ? a : b, RN))
SWITCH(MAX, mpfr_set(d, mpfr_nan_p(a) || mpfr_greater_p(a, b) ? a : b, RN))
SWITCH(MOD, modulo(d, a, b, p->w[0]))
SWITCH(FLOOR, mpfr_floor(d, a))
SWITCH(LT, mpfr_set_ui(d, mpfr_less_p(a, b) != 0, RN))
SWITCH(LE, mpfr_set_ui(d, mpfr_lessequal_p(a, b) != 0, RN))
SWITCH(EQ, mpfr_set_ui(d, mpfr_equal_p(a, b) != 0, RN))
SWITCH(AND, mpfr_set_ui(d, !mpfr_zero_p(a) && !mpfr_zero_p(b), RN))
SWITCH(OR, mpfr_set_ui(d, !mpfr_zero_p(a) || !mpfr_zero_p(b), RN))
SWITCH(NOT, mpfr_set_ui(d, mpfr_zero_p(a) != 0, RN))
SWITCH(SELECT, mpfr_set(d, !mpfr_zero_p(a) ? b : c, RN))

/* The rows. An operation of operation.def without its function does not compile. */
static const struct {
    void (*order)(qdot_precise *p, const step *i, int k);
} table[QDOT_OP_COUNT] = {
#define X(ID, name, operands, operations, calls, statement, slopes)                      \
    [QDOT_OP_##ID] = {order_##ID},
#include "tape/operation.def"
#undef X
};

/* Rows of its own beside the result. */
static const int own_rows[QDOT_OP_COUNT] = {
    [QDOT_OP_POW] = 4,   [QDOT_OP_SINCOS] = 2, [QDOT_OP_SIN] = 2,   [QDOT_OP_COS] = 2,
    [QDOT_OP_ASIN] = 3,  [QDOT_OP_ACOS] = 3,   [QDOT_OP_ATAN] = 2,  [QDOT_OP_ATAN2] = 4,
    [QDOT_OP_SINH] = 2,  [QDOT_OP_COSH] = 2,   [QDOT_OP_TANH] = 2,  [QDOT_OP_ASINH] = 3,
    [QDOT_OP_ACOSH] = 3, [QDOT_OP_ATANH] = 2,  [QDOT_OP_EXP] = 1,   [QDOT_OP_LOG] = 1,
    [QDOT_OP_ERF] = 1,   [QDOT_OP_ERFC] = 1,
};

void
qdot_precise_order(qdot_precise *p, int k)
{
    for (const step *i = p->steps, *end = i + p->length; i < end; i++)
        table[i->op].order(p, i, k);
}

/* How many times its argument an operation is the exponential of; 0: it is none. */
static double
times_argument(const step *i)
{
    switch (i->op) {
    case QDOT_OP_EXP:
    case QDOT_OP_SINH:
    case QDOT_OP_COSH: return 1;
    case QDOT_OP_TANH: return 2;
    default: return 0;
    }
}

double
qdot_precise_near(const qdot_precise *p, int k, double log2_h)
{
    const double digits = (double)mpfr_get_prec(p->w[0]) * M_LN2;
    double sizes[QDOT_PRECISE_NEAR + 1];

    if (k > QDOT_PRECISE_NEAR)
        k = QDOT_PRECISE_NEAR;
    for (const step *i = p->steps, *end = i + p->length; i < end; i++) {
        const double times = times_argument(i);

        if (!(times > 0) || i->x_constant)
            continue;
        for (int j = 1; j <= k; j++)
            sizes[j] = qdot_real_log2(i->x[j]);
        log2_h = qdot_near_log2(
            k, sizes, qdot_near_limit(k, times * mpfr_get_d(i->x[0], RN), digits) / times,
            log2_h);
    }
    return log2_h;
}

/* --- building ------------------------------------------------------------------------ */

/* While rows are numbers: which one a place of the tape has now, and whether it is
 * constant. */
typedef struct {
    uint32_t *at;
    bool *constant; /* [rows] */
} draft;

static size_t
count_rows(const qdot_tape *tape)
{
    size_t rows = tape->inputs + tape->constants;

    for (size_t i = 0; i < tape->length; i++)
        rows += 1 + (size_t)own_rows[tape->code[i].op];
    return rows;
}

static mpfr_t *
row(const qdot_precise *p, uint32_t r)
{
    return p->numbers.at + (size_t)r * p->stride;
}

static void
build_one(qdot_precise *p, draft *d, const qdot_instruction *in, step *s, uint32_t *next)
{
    const int operands = qdot_operations[in->op].operands;
    const uint32_t x = d->at[in->x], y = operands > 1 ? d->at[in->y] : x;
    const uint32_t z = operands > 2 ? d->at[in->z] : x;
    const uint32_t to = (*next)++;

    *s = (step){.op = in->op,
                .x = row(p, x),
                .y = row(p, y),
                .z = row(p, z),
                .to = row(p, to),
                .x_constant = d->constant[x],
                .y_constant = d->constant[y]};
    for (int k = 0; k < own_rows[in->op]; k++)
        s->own[k] = row(p, (*next)++);
    d->at[in->to] = to;
    if (in->op == QDOT_OP_SINCOS)
        d->at[in->y] = to + 1;
}

static qdot_status
build(qdot_precise *p, qdot_pool *pool, const qdot_tape *tape, draft *d)
{
    uint32_t next = (uint32_t)(tape->inputs + tape->constants);

    for (uint32_t r = 0; r < next; r++)
        d->at[r] = r;
    for (size_t i = 0; i < tape->constants; i++) {
        uint32_t r = (uint32_t)(tape->inputs + i);

        QDOT_TRY(qdot_constant_real(pool, tape->exact[i], row(p, r)[0]));
        d->constant[r] = true;
    }
    for (size_t i = 0; i < tape->length; i++)
        build_one(p, d, tape->code + i, p->steps + i, &next);
    for (size_t i = 0; i < tape->outputs; i++) {
        uint32_t r = d->at[tape->output[i]];

        p->output[i] = (const mpfr_t *)row(p, r);
        p->constant[i] = d->constant[r];
    }
    return QDOT_OK;
}

static qdot_status
make(qdot_precise *p, qdot_pool *pool, const qdot_tape *tape, int most, mpfr_prec_t bits)
{
    draft d = {0};
    qdot_status status;

    p->stride = (size_t)most + 1;
    p->inputs = tape->inputs;
    p->outputs = tape->outputs;
    p->length = tape->length;
    p->rows = count_rows(tape);
    QDOT_TRY(qdot_reals_init(&p->numbers, p->rows * p->stride, bits));
    QDOT_TRY(qdot_reals_init(&p->scratch, SCRATCH, bits));
    p->w = p->scratch.at;
    p->work = qdot_calloc(qdot_real_dot_work(bits), sizeof *p->work);
    p->steps = qdot_calloc(p->length + 1, sizeof *p->steps);
    p->output = qdot_calloc(p->outputs + 1, sizeof *p->output);
    p->constant = qdot_calloc(p->outputs + 1, sizeof *p->constant);
    d.at = qdot_calloc(tape->places + 1, sizeof *d.at);
    d.constant = qdot_calloc(p->rows + 1, sizeof *d.constant);
    if (p->work && p->steps && p->output && p->constant && d.at && d.constant)
        status = build(p, pool, tape, &d);
    else
        status = QDOT_ENOMEM;
    qdot_free(d.at);
    qdot_free(d.constant);
    return status;
}

qdot_status
qdot_precise_new(qdot_pool *pool, const qdot_tape *tape, int most, mpfr_prec_t bits,
                 qdot_precise **precise)
{
    const char *hindrance = most > 0 ? qdot_taylor_hindrance(tape) : NULL;
    qdot_precise *p;
    qdot_status status;

    *precise = NULL;
    if (hindrance)
        return qdot_fail(QDOT_ENOTBUILT,
                         "not built yet: Taylor series of equations that switch (%s)",
                         hindrance);
    p = qdot_calloc(1, sizeof *p);
    if (!p)
        return QDOT_ENOMEM;
    status = make(p, pool, tape, most, bits);
    if (status != QDOT_OK) {
        qdot_precise_free(p);
        return status;
    }
    *precise = p;
    return QDOT_OK;
}

void
qdot_precise_free(qdot_precise *p)
{
    if (!p)
        return;
    qdot_reals_clear(&p->numbers);
    qdot_reals_clear(&p->scratch);
    qdot_free(p->work);
    qdot_free(p->steps);
    qdot_free(p->output);
    qdot_free(p->constant);
    qdot_free(p);
}

mpfr_t *
qdot_precise_input(qdot_precise *p, size_t i)
{
    return p->numbers.at + i * p->stride;
}

size_t
qdot_precise_stride(const qdot_precise *p)
{
    return p->stride;
}

const mpfr_t *
qdot_precise_output(const qdot_precise *p, size_t i)
{
    return p->output[i];
}

bool
qdot_precise_is_constant(const qdot_precise *p, size_t i)
{
    return p->constant[i];
}
