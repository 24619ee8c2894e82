/* precise.c -- evaluates a series program in MPFR numbers, to many digits. */
#include "series/precise.h"

#include <math.h>
#include <stdint.h>

#include "expr/constant.h"
#include "num/real.h"
#include "num/samples.h"
#include "series/near.h"

/* Number of temporaries: U1 and U2 of recurrence.def, and one for sums. */
enum { SCRATCH = 3 };

struct qdot_precise {
    const qdot_program *program;
    const qdot_motion *motion; /* the motion that is computed; NULL: the tape from which the program was made */
    qdot_program own;
    size_t stride;
    qdot_reals numbers; /* [rows x stride] Taylor coefficients, rows of inputs first */
    qdot_reals scratch; /* [SCRATCH] numbers for intermediate results */
    mp_limb_t *work;    /* work space for sums of products, in machine words */
    mpfr_t *w;          /* the scratch numbers once more: scratch.at */
    qdot_reals notes; /* [rows] for a motion: the change of the newest coefficient of each row; 0 between calls */
};

/* Orders that are looked at of arguments of exponentials: those beyond add little to a step that
 * goes no further than these say. */
enum { QDOT_PRECISE_NEAR = 200 };

#define RN MPFR_RNDN

static inline mpfr_t *
coefficients_of(const qdot_precise *p, qdot_program_row row)
{
    return p->numbers.at + (size_t)row * p->stride;
}

/* --- sums of products --------------------------------------------------------------- */

/* Set sum to the convolution sum of a_j b_{k-j} over j = from ... k - below. */
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

/* Set sum to the convolution sum of a_j a_{k-j} over j = from ... k - from; uses w[2]. */
static void
convolve_square(qdot_precise *p, mpfr_ptr sum, const mpfr_t *a, int k, int from)
{
    int n = (k + 1) / 2 - from;

    mpfr_set_zero(sum, 1);
    if (n > 0)
        qdot_real_dot(sum, a + from, a + (k - from), (size_t)n, p->work);
    mpfr_mul_2ui(sum, sum, 1, RN);
    if (k % 2 == 0 && k / 2 >= from) {
        mpfr_sqr(p->w[2], a[k / 2], RN);
        mpfr_add(sum, sum, p->w[2], RN);
    }
}

/* --- evaluation of order 0 ----------------------------------------------------------- */

/* Set d to the remainder a - b floor(a/b). */
static void
mpfr_modulo(mpfr_ptr d, mpfr_srcptr a, mpfr_srcptr b, mpfr_ptr w)
{
    mpfr_div(w, a, b, RN);
    mpfr_floor(w, w);
    mpfr_mul(w, w, b, RN);
    mpfr_sub(d, a, w, RN);
}

/* Set d = tanh(a) and slope to the derivative 1 - tanh(a)^2. */
static void
hyperbolic_tangent(mpfr_ptr d, mpfr_ptr slope, mpfr_srcptr a)
{
    mpfr_tanh(d, a, RN);
    mpfr_sqr(slope, d, RN);
    mpfr_ui_sub(slope, 1, slope, RN);
}

/* Set d to the softplus function log(1 + e^a). */
static void
mpfr_softplus(mpfr_ptr d, mpfr_srcptr a, mpfr_ptr w)
{
    const bool positive = mpfr_sgn(a) > 0;

    mpfr_set(w, a, RN);
    if (positive)
        mpfr_neg(w, w, RN);
    mpfr_exp(w, w, RN);
    mpfr_log1p(w, w, RN);
    if (positive)
        mpfr_add(d, a, w, RN);
    else
        mpfr_set(d, w, RN);
}

static void
evaluate_order_zero(qdot_precise *p, const qdot_program_step *i)
{
    mpfr_srcptr a = coefficients_of(p, i->x)[0], b = coefficients_of(p, i->y)[0], c = coefficients_of(p, i->z)[0];
    mpfr_ptr d = coefficients_of(p, i->to)[0], w = p->w[0];

    switch (i->zero) {
#define NOT_IN_PROGRAMS mpfr_set_nan(d)
#define other coefficients_of(p, i->second)[0]
#define X(ID, name, operands, operations, calls, statement, slopes, interval, disc, two, precise, ...) \
    case QDOT_OP_##ID: precise; break;
#include "tape/operation.def"
#undef X
    case QDOT_ZERO_POWER: mpfr_pow(d, b, c, RN); break;
    case QDOT_ZERO_SINHCOSH: mpfr_sinh_cosh(d, other, a, RN); break;
    case QDOT_ZERO_RATE: mpfr_set(d, coefficients_of(p, i->x)[1], RN); break;
    default: mpfr_set_nan(d);
#undef other
#undef NOT_IN_PROGRAMS
    }
}

/* --- evaluation of order k ----------------------------------------------------------- */

#define ROW(row) coefficients_of(precise, i->row)
#define U1 precise->w[0]
#define U2 precise->w[1]

static void
evaluate_step(qdot_precise *precise, const qdot_program_step *i, int k)
{
    switch (i->op) {
#define NEWEST(row) ROW(row)[k]
#define SUM(r, a, b, from, below) convolve(precise, r, ROW(a), ROW(b), k, from, below);
#define PAIR(r, s, a, b, c) SUM(r, a, b, 1, 0) SUM(s, a, c, 1, 0)
#define SQUARED(r, a, from) convolve_square(precise, r, ROW(a), k, from);
#include "series/precise.def"
    case QDOT_T_RATE: mpfr_mul_ui(ROW(to)[k], ROW(x)[k + 1], (uint64_t)k + 1, RN);
    }
}

/* Compute the coefficients of order k of all steps, each at order k plus the step's lead. */
void
qdot_precise_order(qdot_precise *p, int k)
{
    const qdot_program_step *i = p->program->steps.at + (k > -p->program->lead ? p->program->still : 0);

    for (; i->op != QDOT_T_END; i++)
        if (k + i->lead > 0)
            evaluate_step(p, i, k + i->lead);
        else if (k + i->lead == 0 || i->still)
            evaluate_order_zero(p, i);
}

/* --- unknowns: accelerations and multipliers ----------------------------------------- */

/* Coefficient k of a row; NULL if the row or this order of it does not exist. */
static mpfr_ptr
precise_at(const qdot_precise *p, qdot_program_row row, int k)
{
    return row != QDOT_NO_ROW && (size_t)k < p->stride ? coefficients_of(p, row)[k] : NULL;
}

/* Compute the coefficients of the integrals of an unknown (velocity, position) from its coefficient of order k. */
static void
precise_integrate(const qdot_precise *p, const qdot_motion_unknown *u, mpfr_srcptr a, int k)
{
    mpfr_ptr once = precise_at(p, u->once, k + 1), twice = precise_at(p, u->twice, k + 2);

    if (once)
        mpfr_div_ui(once, a, (uint64_t)k + 1, RN);
    if (once && twice)
        mpfr_div_ui(twice, once, (uint64_t)k + 2, RN);
}

static void
clear_unknown(const qdot_precise *p, const qdot_motion_unknown *u, int k)
{
    const mpfr_ptr newest[] = {precise_at(p, u->row, k), precise_at(p, u->once, k + 1), precise_at(p, u->twice, k + 2)};

    for (size_t i = 0; i < sizeof newest / sizeof *newest; i++)
        if (newest[i])
            mpfr_set_zero(newest[i], 1);
}

void
qdot_precise_stage(qdot_precise *p, int k)
{
    const qdot_motion *m = p->motion;

    for (size_t i = 0; i < m->solved.n && k >= 0; i++)
        clear_unknown(p, m->unknowns.at + m->solved.at[i], k);
    qdot_precise_order(p, k);
    for (size_t i = 0; i < m->unknowns.n && k >= 0; i++) {
        const qdot_motion_unknown *u = m->unknowns.at + i;

        if (u->value == QDOT_NO_ROW)
            continue;
        if (u->row != QDOT_NO_ROW)
            mpfr_set(coefficients_of(p, u->row)[k], coefficients_of(p, u->value)[k], RN);
        precise_integrate(p, u, coefficients_of(p, u->value)[k], k);
    }
}

/* Find the changes of the rows of a step from the changes of its operands; operands that were known already do not
 * change. */
static void
change_of_step(qdot_precise *precise, const qdot_program_step *i, int k)
{
    mpfr_t *note = precise->notes.at, *zero = note + precise->program->rows.n;
    mpfr_ptr note_x = i->newest & QDOT_X_NEWEST ? note[i->x] : *zero;
    mpfr_ptr note_y = i->newest & QDOT_Y_NEWEST ? note[i->y] : *zero;
    mpfr_ptr note_z = i->newest & QDOT_Z_NEWEST ? note[i->z] : *zero;

    switch (i->op) {
#define note_to note[i->to]
#define note_second note[i->second]
#define note_third note[i->third]
#define note_d note[i->d]
#define NEWEST(row) note_##row
#define SUM(r, a, b, from, below)                                                        \
    if ((below) > 0) {                                                                   \
        mpfr_set_zero(r, 1);                                                             \
    } else {                                                                             \
        mpfr_mul(precise->w[2], note_##a, ROW(b)[0], RN);                                \
        if ((from) == 0)                                                                 \
            mpfr_fma(precise->w[2], ROW(a)[0], note_##b, precise->w[2], RN);             \
        mpfr_set(r, precise->w[2], RN);                                                  \
    }
#define PAIR(r, s, a, b, c) SUM(r, a, b, 1, 0) SUM(s, a, c, 1, 0)
#define SQUARED(r, a, from)                                                              \
    mpfr_mul(r, ROW(a)[0], note_##a, RN);                                                \
    mpfr_mul_ui(r, r, (from) > 0 ? 0 : 2, RN);
#include "series/precise.def"
    case QDOT_T_RATE: mpfr_mul_ui(note_to, note_x, (uint64_t)k + 1, RN);
    }
}

#undef ROW
#undef U1
#undef U2

/* Add the change stored in p->notes to coefficient k of a row (the Taylor series of one intermediate result). */
static void
precise_apply_note(qdot_precise *p, qdot_program_row row, int k)
{
    mpfr_ptr x = precise_at(p, row, k);

    if (x)
        mpfr_add(x, x, p->notes.at[row], RN);
}

/* Record the changes of the rows of an unknown that changes by d at stage k. */
static void
record_change_of_unknown(qdot_precise *p, const qdot_motion_unknown *u, mpfr_srcptr d, int k)
{
    mpfr_t *note = p->notes.at;

    if (u->row != QDOT_NO_ROW)
        mpfr_set(note[u->row], d, RN);
    if (u->once != QDOT_NO_ROW)
        mpfr_div_ui(note[u->once], d, (uint64_t)k + 1, RN);
    if (u->twice != QDOT_NO_ROW)
        mpfr_div_ui(note[u->twice], note[u->once], (uint64_t)k + 2, RN);
}

/* Compute the changes of the rows of all steps, or (all false) only of steps that later orders read. */
static void
find_changes_of_steps(qdot_precise *p, int k, bool all)
{
    const qdot_program_step *i = p->program->steps.at + p->program->still;

    for (; i->op != QDOT_T_END; i++)
        if (i->kept || (all && i->newest))
            change_of_step(p, i, k + i->lead);
}

void
qdot_precise_change(qdot_precise *p, int k, const mpfr_t *by)
{
    const qdot_motion *m = p->motion;
    const qdot_program_step *i = p->program->steps.at + p->program->still;

    for (size_t j = 0; j < m->solved.n; j++) {
        const qdot_motion_unknown *u = m->unknowns.at + m->solved.at[j];

        record_change_of_unknown(p, u, by[j], k);
        precise_apply_note(p, u->row, k);
        precise_apply_note(p, u->once, k + 1);
        precise_apply_note(p, u->twice, k + 2);
    }
    find_changes_of_steps(p, k, false);
    for (; i->op != QDOT_T_END; i++)
        if (i->kept) {
            precise_apply_note(p, i->to, k + i->lead);
            precise_apply_note(p, i->second, k + i->lead);
            precise_apply_note(p, i->third, k + i->lead);
            precise_apply_note(p, i->d, k + i->lead);
        }
}

void
qdot_precise_column(qdot_precise *p, size_t first, size_t n, size_t j, mpfr_t *column)
{
    const qdot_motion *m = p->motion;

    for (size_t i = 0; i < m->solved.n; i++) {
        mpfr_set_ui(p->w[0], i == first + j, RN);
        record_change_of_unknown(p, m->unknowns.at + m->solved.at[i], p->w[0], 0);
    }
    find_changes_of_steps(p, 0, true);
    for (size_t i = 0; i < n; i++)
        mpfr_set(column[i * n], p->notes.at[m->equations.at[first + i]], RN);
}

/* Shorten a step so that the argument of an exponential, `times` u, changes by no more than the limit of near.h. */
static double
step_for_argument(const mpfr_t *u, int k, double times, double digits, double log2_h)
{
    double sizes[QDOT_PRECISE_NEAR + 1];
    const double limit = qdot_near_limit(k, times * mpfr_get_d(u[0], RN), digits) / times;

    for (int j = 1; j <= k; j++)
        sizes[j] = qdot_real_log2(u[j]);
    return qdot_near_log2(k, sizes, limit, log2_h);
}

/* Find the terms of a series at the end of the step 2^log2_h, relative to its first term. */
static void
terms_relative_to_first(const mpfr_t *x, int k, double log2_h, double *out)
{
    const double first = qdot_real_log2(x[0]);

    for (int j = 0; j <= k; j++)
        out[j] = mpfr_zero_p(x[j]) ? 0
                                   : mpfr_sgn(x[j]) * mpfr_sgn(x[0])
                                         * exp2(qdot_real_log2(x[j]) - first + j * log2_h);
}

static double
step_for_divisor(const qdot_precise *p, const qdot_program_step *i, int k, double log2_h)
{
    const char which = qdot_recurrence_divisor(i->op);
    const mpfr_t *x = coefficients_of(p, which == 'x' ? i->x : which == 'y' ? i->y : i->z);
    double terms[QDOT_PRECISE_NEAR + 1], most = INFINITY, part;

    if (mpfr_zero_p(x[0]))
        return log2_h;
    for (int j = 1; j <= k; j++) /* end of the search: an s at which one term is eight times the first */
        if (!mpfr_zero_p(x[j]))
            most = fmin(most, (3 + qdot_real_log2(x[0]) - qdot_real_log2(x[j])) / j);
    if (isinf(most))
        return log2_h;
    if (log2_h <= most) {
        terms_relative_to_first(x, k, log2_h, terms);
        if (!qdot_near_may_fall(k, terms, 1))
            return log2_h;
    }
    if (i->op == QDOT_T_DIV && !isinf(log2_h) && !mpfr_zero_p(coefficients_of(p, i->to)[0])) {
        terms_relative_to_first(coefficients_of(p, i->to), k, log2_h, terms);
        if (!qdot_near_diverges(k, terms, 1))
            return log2_h;
    }
    most = fmin(log2_h, most);
    terms_relative_to_first(x, k, most, terms);
    part = qdot_near_divisor(k, terms, i->op == QDOT_T_SQRT, 1);
    return part == 1 ? log2_h : most + log2(part);
}

double
qdot_precise_near(const qdot_precise *p, int k, double log2_h)
{
    const double digits = (double)mpfr_get_prec(p->w[0]) * M_LN2;

    if (k > QDOT_PRECISE_NEAR)
        k = QDOT_PRECISE_NEAR;
    for (const qdot_program_step *i = p->program->steps.at + p->program->still;
         i->op != QDOT_T_END; i++) {
        const double times = qdot_recurrence_exponential(i->op);

        if (times > 0)
            log2_h = step_for_argument(coefficients_of(p, i->x), k, times, digits, log2_h);
        else if (qdot_recurrence_divisor(i->op))
            log2_h = step_for_divisor(p, i, k, log2_h);
    }
    return log2_h;
}

/* --- making a program in MPFR -------------------------------------------------------- */

static qdot_status
precise_set_constants(qdot_precise *p, qdot_pool *pool)
{
    for (qdot_program_row r = 0; r < p->program->rows.n; r++) {
        const qdot_program_row_info *row = p->program->rows.at + r;

        if (row->source == QDOT_ROW_CONSTANT)
            QDOT_TRY(qdot_constant_real(pool, p->program->constants.at[row->at].exact,
                                        coefficients_of(p, r)[0]));
        else if (row->source == QDOT_ROW_WHOLE)
            mpfr_set_si(coefficients_of(p, r)[0], row->at, RN);
    }
    return QDOT_OK;
}

/* Allocate the rows of coefficients of a program that exists already. */
static qdot_status
allocate_rows(qdot_precise *p, qdot_pool *pool, int most, mpfr_prec_t bits)
{
    p->stride = (size_t)(most + p->program->lead) + 1;
    QDOT_TRY(qdot_reals_init(&p->numbers, p->program->rows.n * p->stride, bits));
    QDOT_TRY(qdot_reals_init(&p->scratch, SCRATCH, bits));
    if (p->motion)
        QDOT_TRY(qdot_reals_init(&p->notes, p->program->rows.n + 1, bits));
    p->w = p->scratch.at;
    p->work = qdot_calloc(qdot_real_dot_work(bits), sizeof *p->work);
    if (!p->work)
        return QDOT_ENOMEM;
    return precise_set_constants(p, pool);
}

static qdot_status
make_precise_program(qdot_pool *pool, const qdot_tape *tape, const qdot_motion *motion, int most,
                     mpfr_prec_t bits, qdot_precise **precise)
{
    qdot_precise *p = qdot_calloc(1, sizeof *p);
    qdot_status status = QDOT_OK;

    *precise = NULL;
    if (!p)
        return QDOT_ENOMEM;
    p->motion = motion;
    p->program = motion ? &motion->program : &p->own;
    if (!motion)
        status = qdot_program_init(tape, qdot_tape_inputs(tape), most == 0, &p->own);
    if (status == QDOT_OK)
        status = allocate_rows(p, pool, most, bits);
    if (status != QDOT_OK) {
        qdot_precise_free(p);
        return status;
    }
    *precise = p;
    return QDOT_OK;
}

qdot_status
qdot_precise_new(qdot_pool *pool, const qdot_tape *tape, int most, mpfr_prec_t bits,
                 qdot_precise **precise)
{
    return make_precise_program(pool, tape, NULL, most, bits, precise);
}

qdot_status
qdot_precise_of_motion(qdot_pool *pool, const qdot_motion *motion, int most,
                       mpfr_prec_t bits, qdot_precise **precise)
{
    return make_precise_program(pool, NULL, motion, most, bits, precise);
}

void
qdot_precise_free(qdot_precise *p)
{
    if (!p)
        return;
    qdot_program_clear(&p->own);
    qdot_reals_clear(&p->numbers);
    qdot_reals_clear(&p->scratch);
    qdot_reals_clear(&p->notes);
    qdot_free(p->work);
    qdot_free(p);
}

mpfr_t *
qdot_precise_input(qdot_precise *p, size_t i)
{
    return coefficients_of(p, (qdot_program_row)i);
}

size_t
qdot_precise_stride(const qdot_precise *p)
{
    return p->stride;
}

const mpfr_t *
qdot_precise_row(const qdot_precise *p, qdot_program_row row)
{
    return (const mpfr_t *)coefficients_of(p, row);
}

const mpfr_t *
qdot_precise_output(const qdot_precise *p, size_t i)
{
    return qdot_precise_row(p, p->program->outputs.at[i]);
}
