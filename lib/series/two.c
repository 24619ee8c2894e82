/* two.c -- evaluates a program for Taylor series in numbers that are sums of two doubles. */
#include "series/two.h"

#include <stdint.h>
#include <string.h>

#include "num/kinds.h"
#include "num/samples.h"

struct qdot_tape_two {
    const qdot_program *program;
    const qdot_motion *motion; /* the motion that is computed; NULL: the tape from which the program was made */
    qdot_program own;
    double unit;
    qdot_two inverse[QDOT_TWO_MOST + 3]; /* table of the numbers 1/k by index k */
    size_t stride;
    qdot_two *numbers; /* [rows x stride] coefficients of all rows, those of inputs first */
    double *note;      /* [rows] the change of the newest coefficient of each row, recorded for later */
    const qdot_two_functions *functions;
    const qdot_two_kernels *kernels;
    void (*order)(const qdot_tape_two *t, const qdot_program_step *i, int k);
};

static inline qdot_two *
two_place(const qdot_tape_two *t, qdot_program_row row)
{
    return t->numbers + (size_t)row * t->stride;
}

/* --- evaluation of order 0 ---------------------------------------------------------- */

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
two_whole_part(qdot_two a)
{
    const double hi = floor(a.hi);

    return hi == a.hi ? qdot_two_of(hi, floor(a.lo)) : (qdot_two){hi, 0};
}

/* The hyperbolic tangent tanh(a); *slope: its derivative 1 - tanh(a)^2. */
static qdot_two
hyperbolic_tangent(const qdot_two_functions *f, qdot_two a, qdot_two *slope)
{
    const qdot_two d = f->tanh(a);

    *slope = qdot_two_add_double(qdot_two_neg(qdot_two_mul(d, d)), 1);
    return d;
}

/* The softplus function log(1 + e^a). */
static qdot_two
two_softplus(const qdot_two_functions *f, qdot_two a)
{
    const bool positive = a.hi > 0;
    const qdot_two below = f->exp(positive ? qdot_two_neg(a) : a);
    const qdot_two rest = f->log(qdot_two_add_double(below, 1));

    return positive ? qdot_two_add(a, rest) : rest;
}

static void
evaluate_order_zero(const qdot_tape_two *t, const qdot_program_step *i)
{
    const qdot_two_functions *f = t->functions;
    const qdot_two a = two_place(t, i->x)[0], b = two_place(t, i->y)[0], c = two_place(t, i->z)[0];
    qdot_two d;

    switch (i->zero) {
#define NOT_IN_PROGRAMS d = truth(NAN)
#define other two_place(t, i->second)
#define X(ID, name, operands, operations, calls, statement, slopes, interval, disc, two, ...) \
    case QDOT_OP_##ID: two; break;
#include "tape/operation.def"
#undef X
    case QDOT_ZERO_POWER: d = f->pow(b, c); break;
    case QDOT_ZERO_SINHCOSH: f->sinhcosh(a, &d, other); break;
    case QDOT_ZERO_RATE: d = qdot_two_scale(two_place(t, i->x)[1], 1 / t->unit); break;
    default: d = truth(NAN);
#undef other
#undef NOT_IN_PROGRAMS
    }
    two_place(t, i->to)[0] = d;
}

/* --- evaluation of order k ---------------------------------------------------------- */

#define NAME(x) portable_##x
#include "series/two.def"
#undef NAME

#ifdef QDOT_X86_KINDS
QDOT_KIND_AVX2
#define NAME(x) fma_##x
#include "series/two.def"
#undef NAME
QDOT_KIND_END
#endif

void
qdot_tape_two_order(qdot_tape_two *t, int k)
{
    const qdot_program_step *first = t->program->steps.at;
    const qdot_program_step *i = first + (k > -t->program->lead ? t->program->still : 0);

    for (; i->op != QDOT_T_END; i++)
        if (k + i->lead > 0)
            t->order(t, i, k + i->lead);
        else if (k + i->lead == 0 || i->still)
            evaluate_order_zero(t, i);
}

/* --- unknowns: accelerations and multipliers ----------------------------------------- */

/* Compute coefficient k + 1 of a row from coefficient k of its time derivative. */
static qdot_two
integral(const qdot_tape_two *t, qdot_two rate, int k)
{
    return t->kernels->mul(rate, qdot_two_scale(t->inverse[k + 1], t->unit));
}

/* Store coefficient k of an unknown, and the coefficients of its integrals that follow from it. */
static void
store_unknown(const qdot_tape_two *t, const qdot_motion_unknown *u, qdot_two a, int k)
{
    qdot_two once;

    if (u->row != QDOT_NO_ROW)
        two_place(t, u->row)[k] = a;
    if (u->once == QDOT_NO_ROW)
        return;
    two_place(t, u->once)[k + 1] = once = integral(t, a, k);
    if (u->twice != QDOT_NO_ROW && (size_t)k + 2 < t->stride)
        two_place(t, u->twice)[k + 2] = integral(t, once, k + 1);
}

void
qdot_tape_two_stage(qdot_tape_two *t, int k, const double *guess)
{
    const qdot_motion *m = t->motion;

    for (size_t i = 0; i < m->solved.n && k >= 0; i++)
        store_unknown(t, m->unknowns.at + m->solved.at[i], (qdot_two){guess[i], 0}, k);
    qdot_tape_two_order(t, k);
    for (size_t i = 0; i < m->unknowns.n && k >= 0; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + i;

        if (u->value != QDOT_NO_ROW)
            store_unknown(t, u, two_place(t, u->value)[k], k);
    }
}

/* Add the change recorded for a row to its coefficient of the given order. */
static void
apply_recorded_change(qdot_tape_two *t, qdot_program_row row, int order)
{
    if (row != QDOT_NO_ROW && (size_t)order < t->stride)
        two_place(t, row)[order] = qdot_two_add_double(two_place(t, row)[order], t->note[row]);
}

static void
change_unknown(qdot_tape_two *t, const qdot_motion_unknown *u, double d, int k)
{
    if (u->row != QDOT_NO_ROW)
        t->note[u->row] = d;
    if (u->once != QDOT_NO_ROW)
        t->note[u->once] = d *= t->unit / (k + 1);
    if (u->twice != QDOT_NO_ROW)
        t->note[u->twice] = d * t->unit / (k + 2);
    apply_recorded_change(t, u->row, k);
    apply_recorded_change(t, u->once, k + 1);
    apply_recorded_change(t, u->twice, k + 2);
}

/* Find the changes of the rows that a step writes from the changes of its operands. */
static void
record_changes_of_step(const qdot_tape_two *t, const qdot_program_step *i, int k)
{
    double *note = t->note, U1, U2;
    const double note_x = i->newest & QDOT_X_NEWEST ? note[i->x] : 0;
    const double note_y = i->newest & QDOT_Y_NEWEST ? note[i->y] : 0;
    const double note_z = i->newest & QDOT_Z_NEWEST ? note[i->z] : 0;

    if (i->op == QDOT_T_RATE) {
        note[i->to] = (k + 1) / t->unit * note_x;
        return;
    }
#define note_to note[i->to]
#define note_second note[i->second]
#define note_third note[i->third]
#define note_d note[i->d]
#define NOTE(row) note_##row
#define ZERO(row) two_place(t, i->row)[0].hi
#define OVER_ZERO(p, row) (p) / ZERO(row)
#define OVER_TWICE_ZERO(p, row) 0.5 * (p) / ZERO(row)
#define FUSED(a, b, c) (a) * (b) + (c)
#define NOTHING 0
#include "series/linear.def"
}

void
qdot_tape_two_change(qdot_tape_two *t, int k, const double *by)
{
    const qdot_program_step *i = t->program->steps.at + t->program->still;

    for (size_t u = 0; u < t->motion->solved.n; u++)
        change_unknown(t, t->motion->unknowns.at + t->motion->solved.at[u], by[u], k);
    for (; i->op != QDOT_T_END; i++)
        if (i->newest) {
            record_changes_of_step(t, i, k + i->lead);
            apply_recorded_change(t, i->to, k + i->lead);
            apply_recorded_change(t, i->second, k + i->lead);
            apply_recorded_change(t, i->third, k + i->lead);
            apply_recorded_change(t, i->d, k + i->lead);
        }
}

/* --- making a program in two doubles ------------------------------------------------- */

static void
set_constants(qdot_tape_two *t)
{
    for (qdot_program_row r = 0; r < t->program->rows.n; r++) {
        const qdot_program_row_info *row = t->program->rows.at + r;
        const qdot_program_constant *c = t->program->constants.at + row->at;

        if (row->source == QDOT_ROW_CONSTANT)
            two_place(t, r)[0] = (qdot_two){c->value, c->low};
        else if (row->source == QDOT_ROW_WHOLE)
            two_place(t, r)[0] = (qdot_two){row->at, 0};
    }
}

/* Allocate the rows of a program that exists already. */
static qdot_status
allocate_coefficients(qdot_tape_two *t, int most)
{
    t->stride = (size_t)most + 1;
    t->functions = qdot_two_functions_get();
    t->kernels = qdot_two_kernels_get();
    t->order = portable_order;
#ifdef QDOT_X86_KINDS
    if (qdot_kind_is_here(1))
        t->order = fma_order;
#endif
    for (int k = 1; k < QDOT_TWO_MOST + 3; k++)
        t->inverse[k] = qdot_two_div_double((qdot_two){1, 0}, k);
    t->numbers = qdot_calloc(t->program->rows.n * t->stride + 1, sizeof *t->numbers);
    t->note = qdot_calloc(t->program->rows.n + 1, sizeof *t->note);
    if (!t->numbers || !t->note)
        return QDOT_ENOMEM;
    set_constants(t);
    return QDOT_OK;
}

static qdot_status
make_two_program(const qdot_tape *tape, const qdot_motion *motion, int most, size_t moving,
                 qdot_tape_two **two)
{
    qdot_tape_two *t = qdot_calloc(1, sizeof *t);
    qdot_status status = QDOT_OK;

    *two = NULL;
    if (!t)
        return QDOT_ENOMEM;
    t->motion = motion;
    t->program = motion ? &motion->program : &t->own;
    t->unit = 1;
    if (!motion)
        status = qdot_program_init(tape, moving, most == 0, &t->own);
    if (status == QDOT_OK)
        status = allocate_coefficients(t, most);
    if (status != QDOT_OK) {
        qdot_tape_two_free(t);
        return status;
    }
    *two = t;
    return QDOT_OK;
}

qdot_status
qdot_tape_two_new(const qdot_tape *tape, int most, size_t moving, qdot_tape_two **two)
{
    return make_two_program(tape, NULL, most, moving, two);
}

qdot_status
qdot_tape_two_of_motion(const qdot_motion *motion, qdot_tape_two **two)
{
    return make_two_program(NULL, motion, QDOT_TWO_MOST + 1, 0, two);
}

double
qdot_tape_two_rounding(const qdot_tape_two *t)
{
    for (const qdot_program_step *i = t->program->steps.at; i->op != QDOT_T_END; i++)
        if (i->zero > QDOT_OP_SQRT && i->zero < QDOT_OP_ABS)
            return 0x1p-66;
    return 0x1p-98;
}

/* On which side of its switch a step is, as in abs or a comparison; 0: on the border between two sides. */
static int64_t
side_of_switch(const qdot_tape_two *t, const qdot_program_step *i)
{
    const qdot_two a = two_place(t, i->x)[0], b = two_place(t, i->y)[0];
    qdot_two u;

    switch (i->zero) {
    case QDOT_OP_ABS:
    case QDOT_OP_SIGN: u = a; break;
    case QDOT_OP_MIN:
    case QDOT_OP_MAX:
    case QDOT_OP_LT:
    case QDOT_OP_LE:
    case QDOT_OP_EQ: u = qdot_two_sub(a, b); break;
    case QDOT_OP_MOD:
    case QDOT_OP_FLOOR: {
        const qdot_two q = i->zero == QDOT_OP_MOD ? qdot_two_div(a, b) : a, whole = two_whole_part(q);

        if (!(fabs(whole.hi) < 0x1p62))
            return 0;
        return qdot_two_sub(q, whole).hi == 0 ? 0 : 2 * (int64_t)whole.hi + 1;
    }
    default: return 1;
    }
    return (u.hi > 0) - (u.hi < 0);
}

uint64_t
qdot_tape_two_sides(const qdot_tape_two *t)
{
    uint64_t sides = 1;

    for (const qdot_program_step *i = t->program->steps.at; i->op != QDOT_T_END; i++) {
        const int64_t side = side_of_switch(t, i);

        if (side == 0)
            return 0;
        sides = (sides ^ (uint64_t)side) * 0x100000001b3u; /* combine the sides by the FNV-1a hash (Fowler, Noll, Vo) */
    }
    return sides | 1;
}

void
qdot_tape_two_free(qdot_tape_two *t)
{
    if (!t)
        return;
    qdot_program_clear(&t->own);
    qdot_free(t->numbers);
    qdot_free(t->note);
    qdot_free(t);
}

void
qdot_tape_two_set_unit(qdot_tape_two *t, double unit)
{
    t->unit = unit;
}

qdot_two *
qdot_tape_two_input(qdot_tape_two *t, size_t i)
{
    return two_place(t, (qdot_program_row)i);
}

size_t
qdot_tape_two_stride(const qdot_tape_two *t)
{
    return t->stride;
}

const qdot_two *
qdot_tape_two_row(const qdot_tape_two *t, qdot_program_row row)
{
    return two_place(t, row);
}

const qdot_two *
qdot_tape_two_output(const qdot_tape_two *t, size_t i)
{
    return two_place(t, t->program->outputs.at[i]);
}
