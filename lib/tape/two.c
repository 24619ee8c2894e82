/* two.c -- a tape's recurrences in sums of two doubles: its rows, and their building. */
#include "tape/two.h"

#include <stdint.h>

#include "num/kinds.h"
#include "tape/code.h"
#include "tape/taylor.h"

enum { MOST_OWN = 4 };

/* An instruction with the rows it reads and writes. */
typedef struct {
    uint32_t op;
    const qdot_two *x, *y, *z; /* operands; those that it has not are x */
    qdot_two *to;
    qdot_two *own[MOST_OWN]; /* further rows that it writes: the second result first */
    bool x_constant, y_constant;
    uint32_t x_row, y_row, z_row, to_row; /* their numbers */
} step;

typedef void order_function(const step *i, int k, const qdot_two_functions *f);

struct qdot_tape_two {
    size_t stride, inputs, outputs, length;
    qdot_two *numbers; /* [rows x stride], the inputs first */
    step *steps;       /* [length] those of numbers alone first */
    size_t still;      /* how many these are */
    const qdot_two **output;
    bool *constant; /* [outputs] */
    double *note;   /* [rows] by how much the newest coefficient changes */
    const qdot_two_functions *functions;
    order_function *const *orders;
};

/* --- evaluation --------------------------------------------------------------------- */

static inline qdot_two
truth(double x)
{
    return (qdot_two){x, 0};
}

static inline bool
is_less(qdot_two a, qdot_two b)
{
    return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

static inline qdot_two
whole_part(qdot_two a)
{
    const double hi = floor(a.hi);

    return hi == a.hi ? qdot_two_of(hi, floor(a.lo)) : (qdot_two){hi, 0};
}

#define NAME(x) portable_##x
#include "tape/two.def"
#undef NAME

#ifdef QDOT_X86_KINDS
QDOT_KIND_AVX2
#define NAME(x) fma_##x
#include "tape/two.def"
#undef NAME
QDOT_KIND_END
#endif

static order_function *const *
orders_here(void)
{
#ifdef QDOT_X86_KINDS
    if (qdot_kind_is_here(1))
        return fma_orders;
#endif
    return portable_orders;
}

void
qdot_tape_two_order(qdot_tape_two *t, int k)
{
    const step *i = t->steps + (k > 0 ? t->still : 0);

    for (const step *end = t->steps + t->length; i < end; i++)
        t->orders[i->op](i, k, t->functions);
}

/* --- correction ---------------------------------------------------------------------- */

/* Slopes of a step at order 0, by operation.def: of its results for those of its operands. */
static void
slopes_of(const step *i, double da, double db, double dc, double *first, double *second)
{
    const double a = i->x[0].hi, b = i->y[0].hi, c = i->z[0].hi, d = i->to[0].hi;
    const double e = i->op == QDOT_OP_SINCOS ? i->own[0][0].hi : 0, none = 0;
    double dd = 0, de = 0;

    (void)a, (void)b, (void)c, (void)d, (void)e, (void)none, (void)db, (void)dc;
    switch (i->op) {
#define X(ID, name, operands, operations, calls, statement, slopes)                      \
    case QDOT_OP_##ID: slopes; break;
#include "tape/operation.def"
#undef X
    }
    *first = dd;
    *second = de;
}

static inline void
change(qdot_two *row, int k, double by)
{
    row[k] = qdot_two_add_double(row[k], by);
}

/* Rows of its own, at order k: operands change by da and db, the result by dd. */
static void
correct_own(const step *i, int k, double da, double db, double dd)
{
    const double a = i->x[0].hi, b = i->y[0].hi, d = i->to[0].hi;
    const double square = i->op == QDOT_OP_ASIN || i->op == QDOT_OP_ACOS
                                  || i->op == QDOT_OP_ATANH
                              ? -2 * a * da
                              : 2 * a * da;
    qdot_two *const *own = i->own;
    double product;

    switch (i->op) {
    case QDOT_OP_SINCOS: change(own[1], k, k * da); break;
    case QDOT_OP_SIN:
        change(own[0], k, -d * da);
        change(own[1], k, k * da);
        break;
    case QDOT_OP_COS:
    case QDOT_OP_SINH:
    case QDOT_OP_COSH:
        change(own[0], k, d * da);
        change(own[1], k, k * da);
        break;
    case QDOT_OP_TANH:
        change(own[0], k, -2 * d * dd);
        change(own[1], k, k * da);
        break;
    case QDOT_OP_EXP:
    case QDOT_OP_ERF:
    case QDOT_OP_ERFC: change(own[0], k, k * da); break;
    case QDOT_OP_ASIN:
    case QDOT_OP_ACOS:
    case QDOT_OP_ASINH:
    case QDOT_OP_ACOSH: change(own[2], k, 0.5 * square / own[2][0].hi); /* fall through */
    case QDOT_OP_ATAN:
    case QDOT_OP_ATANH: change(own[1], k, square); /* fall through */
    case QDOT_OP_LOG: change(own[0], k, k * dd); break;
    case QDOT_OP_ATAN2:
        change(own[0], k, k * dd);
        change(own[1], k, 2 * (a * da + b * db));
        change(own[2], k, k * da);
        change(own[3], k, k * db);
        break;
    case QDOT_OP_POW:
        if (i->y_constant) {
            change(own[0], k, k * da);
            break;
        }
        product = b * da / a + own[1][0].hi * db;
        change(own[0], k, k * product);
        change(own[1], k, da / a);
        change(own[2], k, k * da / a);
        change(own[3], k, product);
        break;
    }
}

void
qdot_tape_two_correct(qdot_tape_two *t, int k, size_t n, const double *by)
{
    for (size_t i = 0; i < n; i++) {
        t->note[i] = by[i];
        change(t->numbers + i * t->stride, k, by[i]);
    }
    for (const step *i = t->steps + t->still, *end = t->steps + t->length; i < end; i++) {
        const double da = t->note[i->x_row], db = t->note[i->y_row];
        double *to = t->note + i->to_row, second;

        slopes_of(i, da, db, t->note[i->z_row], to, &second);
        change(i->to, k, *to);
        if (i->op == QDOT_OP_SINCOS) { /* its second result is the row behind */
            to[1] = second;
            change(i->own[0], k, second);
        }
        correct_own(i, k, da, db, *to);
    }
}

/* --- building ------------------------------------------------------------------------ */

/* Rows of its own beside the result. */
static const unsigned char own_rows[QDOT_OP_COUNT] = {
    [QDOT_OP_POW] = 4,   [QDOT_OP_SINCOS] = 2, [QDOT_OP_SIN] = 2,   [QDOT_OP_COS] = 2,
    [QDOT_OP_ASIN] = 3,  [QDOT_OP_ACOS] = 3,   [QDOT_OP_ATAN] = 2,  [QDOT_OP_ATAN2] = 4,
    [QDOT_OP_SINH] = 2,  [QDOT_OP_COSH] = 2,   [QDOT_OP_TANH] = 2,  [QDOT_OP_ASINH] = 3,
    [QDOT_OP_ACOSH] = 3, [QDOT_OP_ATANH] = 2,  [QDOT_OP_EXP] = 1,   [QDOT_OP_LOG] = 1,
    [QDOT_OP_ERF] = 1,   [QDOT_OP_ERFC] = 1,
};

/* While rows are numbers: which one a place of the tape has now, and whether it is
 * constant. */
typedef struct {
    uint32_t *at;   /* [places] */
    bool *constant; /* [rows] */
    step *moving;   /* [length] steps that are not of numbers alone */
    size_t n_moving;
} draft;

static size_t
count_rows(const qdot_tape *tape)
{
    size_t rows = tape->inputs + tape->constants;

    for (size_t i = 0; i < tape->length; i++)
        rows += 1 + (size_t)own_rows[tape->code[i].op];
    return rows;
}

static qdot_two *
row(const qdot_tape_two *t, uint32_t r)
{
    return t->numbers + (size_t)r * t->stride;
}

static void
build_one(qdot_tape_two *t, draft *d, const qdot_instruction *in, uint32_t *next)
{
    const int operands = qdot_operations[in->op].operands;
    const uint32_t x = d->at[in->x], y = operands > 1 ? d->at[in->y] : x;
    const uint32_t z = operands > 2 ? d->at[in->z] : x;
    const uint32_t to = (*next)++;
    const bool still = d->constant[x] && d->constant[y] && d->constant[z];
    step *s = still ? t->steps + t->still++ : d->moving + d->n_moving++;

    *s = (step){.op = in->op,
                .x = row(t, x),
                .y = row(t, y),
                .z = row(t, z),
                .to = row(t, to),
                .x_constant = d->constant[x],
                .y_constant = d->constant[y],
                .x_row = x,
                .y_row = y,
                .z_row = z,
                .to_row = to};
    d->constant[to] = still;
    for (int k = 0; k < own_rows[in->op]; k++) {
        d->constant[*next] = still;
        s->own[k] = row(t, (*next)++);
    }
    d->at[in->to] = to;
    if (in->op == QDOT_OP_SINCOS)
        d->at[in->y] = to + 1;
}

static void
build(qdot_tape_two *t, const qdot_tape *tape, size_t moving, draft *d)
{
    uint32_t next = (uint32_t)(tape->inputs + tape->constants);

    for (uint32_t r = 0; r < next; r++) {
        d->at[r] = r;
        d->constant[r] = r >= moving;
    }
    for (size_t i = 0; i < tape->constants; i++)
        row(t, (uint32_t)(tape->inputs + i))[0] =
            (qdot_two){tape->constant[i], tape->low[i]};
    for (size_t i = 0; i < tape->length; i++)
        build_one(t, d, tape->code + i, &next);
    for (size_t i = 0; i < d->n_moving; i++)
        t->steps[t->still + i] = d->moving[i];
    for (size_t i = 0; i < tape->outputs; i++) {
        const uint32_t r = d->at[tape->output[i]];

        t->output[i] = row(t, r);
        t->constant[i] = d->constant[r];
    }
}

static qdot_status
make(qdot_tape_two *t, const qdot_tape *tape, int most, size_t moving)
{
    const size_t rows = count_rows(tape);
    draft d = {0};
    qdot_status status = QDOT_ENOMEM;

    t->stride = (size_t)most + 1;
    t->inputs = tape->inputs;
    t->outputs = tape->outputs;
    t->length = tape->length;
    t->functions = qdot_two_functions_get();
    t->orders = orders_here();
    t->numbers = qdot_calloc(rows * t->stride + 1, sizeof *t->numbers);
    t->steps = qdot_calloc(t->length + 1, sizeof *t->steps);
    t->note = qdot_calloc(rows + 1, sizeof *t->note);
    t->output = qdot_calloc(t->outputs + 1, sizeof *t->output);
    t->constant = qdot_calloc(t->outputs + 1, sizeof *t->constant);
    d.at = qdot_calloc(tape->places + 1, sizeof *d.at);
    d.constant = qdot_calloc(rows + 1, sizeof *d.constant);
    d.moving = qdot_calloc(t->length + 1, sizeof *d.moving);
    if (t->numbers && t->note && t->steps && t->output && t->constant && d.at && d.constant
        && d.moving) {
        build(t, tape, moving, &d);
        status = QDOT_OK;
    }
    qdot_free(d.at);
    qdot_free(d.constant);
    qdot_free(d.moving);
    return status;
}

qdot_status
qdot_tape_two_new(const qdot_tape *tape, int most, size_t moving, qdot_tape_two **two)
{
    const char *hindrance = most > 0 ? qdot_taylor_hindrance(tape) : NULL;
    qdot_tape_two *t;
    qdot_status status;

    *two = NULL;
    if (hindrance)
        return qdot_fail(QDOT_ENOTBUILT,
                         "not built yet: Taylor series of equations that switch (%s)",
                         hindrance);
    t = qdot_calloc(1, sizeof *t);
    if (!t)
        return QDOT_ENOMEM;
    status = make(t, tape, most, moving);
    if (status != QDOT_OK) {
        qdot_tape_two_free(t);
        return status;
    }
    *two = t;
    return QDOT_OK;
}

void
qdot_tape_two_free(qdot_tape_two *t)
{
    if (!t)
        return;
    qdot_free(t->numbers);
    qdot_free(t->note);
    qdot_free(t->steps);
    qdot_free(t->output);
    qdot_free(t->constant);
    qdot_free(t);
}

qdot_two *
qdot_tape_two_input(qdot_tape_two *t, size_t i)
{
    return t->numbers + i * t->stride;
}

size_t
qdot_tape_two_stride(const qdot_tape_two *t)
{
    return t->stride;
}

const qdot_two *
qdot_tape_two_output(const qdot_tape_two *t, size_t i)
{
    return t->output[i];
}

bool
qdot_tape_two_is_constant(const qdot_tape_two *t, size_t i)
{
    return t->constant[i];
}
