/* lanes-steps.c -- the recurrences in lanes as code: an order of a step, in two parts. */
#include "series/lanes-writer.h"

/* What a step is made of, by rows. */
typedef struct {
    qdot_lanes_writer *w;
    const qdot_program_step *s;
    size_t i; /* its number */
    int k;
} step;

static qdot_lanes_at
at(qdot_program_row row, int order)
{
    return (qdot_lanes_at){row, order};
}

static double
inverse(int k)
{
    return 1.0 / k;
}

static double
minus_inverse(int k)
{
    return -1.0 / k;
}

static double
itself(int k)
{
    return k;
}

static qdot_lanes_at
inverse_of_order(const step *s)
{
    return qdot_lanes_scalar_of(s->w, inverse, s->k);
}

/* While inputs are left out a coefficient may be absent for it. */
static void
store(const step *s, qdot_lanes_sum sum, qdot_program_row to)
{
    qdot_lanes_writer *w = s->w;

    if (w->without && sum == QDOT_LANES_NOTHING)
        w->rows[to].absent = true;
    else
        qdot_lanes_store(w, sum, at(to, s->k));
}

/* sum +- what a term has at this order */
static void
add_term(const step *s, qdot_lanes_sum *sum, bool minus, qdot_writer_addend t)
{
    minus ^= t.minus;
    if (t.rates == 0)
        qdot_lanes_add(s->w, sum, minus, at(t.row, s->k));
    else {
        s->w->rates |= 1U << ((t.rates > 1) * QDOT_LANES_LEADS + s->s->lead);
        qdot_lanes_add_product(s->w, sum, minus,
                               qdot_lanes_rate(s->w, t.rates > 1, s->s->lead),
                               at(t.row, s->k + t.rates));
    }
}

static void
add_row(const step *s, qdot_lanes_sum *sum, bool minus, qdot_program_row row)
{
    add_term(s, sum, minus, qdot_writer_expand(s->w, row));
}

/* to = x'/unit */
static void
rate(const step *s)
{
    qdot_writer_addend t = qdot_writer_expand(s->w, s->s->x);
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    t.rates++;
    add_term(s, &sum, false, t);
    store(s, sum, s->s->to);
}

/* sum + +-x_0 y_k */
static void
with_newest(const step *s, qdot_lanes_sum *sum, bool minus, qdot_program_row x,
            qdot_program_row y)
{
    qdot_lanes_add_product(s->w, sum, minus, at(x, 0), at(y, s->k));
}

/* --- what needs no coefficient k ---------------------------------------------------- */

static qdot_lanes_sum
dot(const step *s, qdot_program_row x, qdot_program_row y)
{
    const qdot_lanes_pair pair = {x, y};

    return qdot_lanes_dots(s->w, 1, &pair, s->k);
}

static qdot_lanes_sum
square(const step *s, qdot_program_row x)
{
    return qdot_writer_square(s->w, x, s->k);
}

/* sums[0] of x and y, [1] of x and z */
static void
pair(const step *s, qdot_program_row x, qdot_program_row y, qdot_program_row z,
     qdot_lanes_sum *sums)
{
    qdot_writer_pair(s->w, x, y,
                     z, s->k, sums);
}

static void
before(const step *s, qdot_lanes_sum *sums)
{
    const qdot_program_step *i = s->s;

    sums[0] = sums[1] = QDOT_LANES_NOTHING;
    switch (i->op) {
    case QDOT_T_MUL:
    case QDOT_T_MADD:
    case QDOT_T_MSUB:
    case QDOT_T_NMADD: {
        qdot_lanes_pair pairs[QDOT_WRITER_PAIRS];
        size_t n = 0;

        for (const qdot_program_step *p = i; p; p = qdot_writer_within(s->w, p))
            pairs[n++] = (qdot_lanes_pair){p->x, p->y};
        sums[0] = qdot_lanes_dots(s->w, n, pairs, s->k);
        break;
    }
    case QDOT_T_SQUARE: sums[0] = square(s, i->x); break;
    case QDOT_T_DIV: sums[0] = dot(s, i->y, i->to); break;
    case QDOT_T_SQRT: sums[0] = square(s, i->to); break;
    case QDOT_T_SINCOS:
    case QDOT_T_SINHCOSH: pair(s, i->d, i->second, i->to, sums); break;
    case QDOT_T_EXP: sums[0] = dot(s, i->d, i->to); break;
    case QDOT_T_ALONG: sums[0] = dot(s, i->d, i->y); break;
    case QDOT_T_POW: pair(s, i->to, i->d, i->x, sums); break;
    case QDOT_T_RATIO: sums[0] = dot(s, i->d, i->y); break;
    case QDOT_T_TANH:
        sums[0] = dot(s, i->d, i->second);
        sums[1] = square(s, i->to);
        break;
    case QDOT_T_ATAN2: {
        const qdot_lanes_pair less[] = {
            {i->third, i->x},
            {i->d, i->z}};

        sums[0] = dot(s, i->second, i->y);
        sums[1] = qdot_lanes_dots(s->w, 2, less, s->k);
        break;
    }
    default: break;
    }
}

/* --- with coefficient k of the operands --------------------------------------------- */

/* What an order makes of a row only while unknowns are left out. */
static bool
is_passing(const qdot_lanes_writer *w, const qdot_program_step *s)
{
    return s->newest && !s->kept && !w->rows[s->to].equation;
}

/* Nothing reads the row, of a step before this one, any more. */
static bool
is_last_reader(const step *s, qdot_program_row row)
{
    const qdot_program_step *const steps = s->w->t->steps.at;
    bool passes = false;

    for (size_t i = s->w->t->still; i < s->i && !passes; i++)
        passes = steps[i].to == row && is_passing(s->w, steps + i);
    for (size_t i = s->i + 1; i < s->w->t->length && passes; i++)
        passes = steps[i].x != row && steps[i].y != row && steps[i].z != row;
    return passes;
}

static void
linear(const step *s)
{
    const qdot_program_step *i = s->s;
    qdot_lanes_writer *w = s->w;
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    switch (i->op) {
    case QDOT_T_NEG: add_row(s, &sum, true, i->x); break;
    case QDOT_T_ADD:
    case QDOT_T_SUB:
        add_row(s, &sum, false, i->x);
        add_row(s, &sum, i->op == QDOT_T_SUB, i->y);
        break;
    default:
        if (i->op == QDOT_T_SCALEADD && w->rows[i->y].absent && is_last_reader(s, i->z))
            sum = qdot_lanes_continue_last(w, at(i->z, s->k));
        else if (i->op != QDOT_T_SCALE)
            add_row(s, &sum, i->op == QDOT_T_SCALESUB, i->z);
        with_newest(s, &sum, i->op == QDOT_T_SCALEOFF, i->x, i->y);
    }
    store(s, sum, i->to);
}

/* x is the newer factor (taylor.c). */
static void
product(const step *s, qdot_lanes_sum sum)
{
    const qdot_program_step *last = s->s;
    const bool minus = s->s->op == QDOT_T_NMADD;

    for (const qdot_program_step *p = s->s; p; p = qdot_writer_within(s->w, p))
        last = p;
    if (minus)
        qdot_lanes_negate(s->w, &sum);
    if (last->op != QDOT_T_MUL)
        add_row(s, &sum, last->op == QDOT_T_MSUB, last->z);
    for (const qdot_program_step *p = s->s; p; p = qdot_writer_within(s->w, p))
        with_newest(s, &sum, minus, p->x, p->y);
    for (const qdot_program_step *p = s->s; p; p = qdot_writer_within(s->w, p))
        with_newest(s, &sum, minus, p->y, p->x);
    store(s, sum, s->s->to);
}

/* +-(sum + 2 x_0 x_k) */
static void
finish_square(const step *s, qdot_lanes_sum sum, bool minus, qdot_program_row x,
              qdot_program_row to)
{
    if (minus)
        qdot_lanes_negate(s->w, &sum);
    with_newest(s, &sum, minus, x, x);
    with_newest(s, &sum, minus, x, x);
    store(s, sum, to);
}

/* (x_k - sum - y_k c_0) times the inverse; a root has no y. */
static void
quotient(const step *s, qdot_lanes_sum sum)
{
    const qdot_program_step *i = s->s;

    qdot_lanes_take_from(s->w, &sum, at(i->x, s->k));
    if (i->op == QDOT_T_DIV)
        with_newest(s, &sum, true, i->to, i->y);
    qdot_lanes_scale(s->w, &sum, qdot_writer_inverse(s->i));
    store(s, sum, i->to);
}

/* to_k = k x_k */
static void
weighted(const step *s, qdot_program_row x, qdot_program_row to)
{
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    qdot_lanes_add_product(s->w, &sum, false, qdot_lanes_scalar_of(s->w, itself, s->k),
                           at(x, s->k));
    store(s, sum, to);
}

/* y of y' = +-x' u */
static void
integrated(const step *s, qdot_lanes_sum sum, bool minus, qdot_program_row u,
           qdot_program_row to)
{
    qdot_lanes_scale(s->w, &sum,
                     qdot_lanes_scalar_of(s->w, minus ? minus_inverse : inverse, s->k));
    with_newest(s, &sum, minus, u, s->s->x);
    store(s, sum, to);
}

/* ((r + 1)/k sum d p - sum x p + r p_0 x_k)/x_0, the sums without their ends */
static void
power(const step *s, qdot_lanes_sum *sums)
{
    const qdot_program_step *i = s->s;
    qdot_lanes_sum sum = sums[0], more = QDOT_LANES_NOTHING, end = QDOT_LANES_NOTHING;

    weighted(s, i->x, i->d);
    qdot_lanes_scale(s->w, &sum, inverse_of_order(s));
    qdot_lanes_add(s->w, &more, false, at(i->z, 0));
    qdot_lanes_add(s->w, &more, false, qdot_lanes_scalar(s->w, 1));
    qdot_writer_join(s->w, QDOT_ASM_MUL, &sum, more);
    qdot_writer_join(s->w, QDOT_ASM_SUB, &sum, sums[1]);
    qdot_lanes_add_product(s->w, &end, false, at(i->z, 0), at(i->to, 0));
    qdot_lanes_scale(s->w, &end, at(i->x, s->k));
    qdot_writer_join(s->w, QDOT_ASM_ADD, &sum, end);
    qdot_lanes_scale(s->w, &sum, qdot_writer_inverse(s->i));
    store(s, sum, i->to);
}

/* d, then to = d/k */
static void
finish_weighted(const step *s, qdot_lanes_sum sum)
{
    qdot_lanes_sum to = QDOT_LANES_NOTHING;

    qdot_lanes_scale(s->w, &sum, qdot_writer_inverse(s->i));
    store(s, sum, s->s->d);
    qdot_lanes_add_product(s->w, &to, false, inverse_of_order(s), at(s->s->d, s->k));
    store(s, to, s->s->to);
}

static void
ratio(const step *s, qdot_lanes_sum sum)
{
    qdot_lanes_negate(s->w, &sum);
    qdot_lanes_add_product(s->w, &sum, s->s->sign < 0,
                           qdot_lanes_scalar_of(s->w, itself, s->k),
                           at(s->s->x, s->k));
    finish_weighted(s, sum);
}

static void
arctangent(const step *s, qdot_lanes_sum *sums)
{
    const qdot_program_step *i = s->s;
    qdot_lanes_sum sum = sums[0];

    qdot_writer_join(s->w, QDOT_ASM_SUB, &sum, sums[1]);
    weighted(s, i->x, i->second);
    weighted(s, i->y, i->third);
    with_newest(s, &sum, false, i->y, i->second);
    with_newest(s, &sum, true, i->x, i->third);
    finish_weighted(s, sum);
}

static void
after(const step *s, qdot_lanes_sum *sums)
{
    const qdot_program_step *i = s->s;

    switch (i->op) {
    case QDOT_T_MUL:
    case QDOT_T_MADD:
    case QDOT_T_MSUB:
    case QDOT_T_NMADD: product(s, sums[0]); break;
    case QDOT_T_SQUARE: finish_square(s, sums[0], false, i->x, i->to); break;
    case QDOT_T_DIV:
    case QDOT_T_SQRT: quotient(s, sums[0]); break;
    case QDOT_T_SINCOS:
    case QDOT_T_SINHCOSH:
        weighted(s, i->x, i->d);
        integrated(s, sums[0], false, i->second, i->to);
        integrated(s, sums[1], i->op == QDOT_T_SINCOS, i->to, i->second);
        break;
    case QDOT_T_EXP:
        weighted(s, i->x, i->d);
        integrated(s, sums[0], false, i->to, i->to);
        break;
    case QDOT_T_ALONG:
        weighted(s, i->x, i->d);
        integrated(s, sums[0], false, i->y, i->to);
        break;
    case QDOT_T_POW: power(s, sums); break;
    case QDOT_T_RATIO: ratio(s, sums[0]); break;
    case QDOT_T_TANH:
        weighted(s, i->x, i->d);
        integrated(s, sums[0], false, i->second, i->to);
        finish_square(s, sums[1], true, i->to, i->second);
        break;
    case QDOT_T_ATAN2: arctangent(s, sums); break;
    case QDOT_T_RATE: rate(s); break;
    default: linear(s); break;
    }
}

/* --- all of them -------------------------------------------------------------------- */

void
qdot_lanes_steps(qdot_lanes_writer *w, int k)
{
    qdot_writer_begin(w, k);
    for (size_t i = w->t->still; i < w->t->length; i++) {
        const step s = {w, w->t->steps.at + i, i, k};
        qdot_lanes_sum sums[QDOT_WRITER_RESTS];

        before(&s, sums);
        after(&s, sums);
    }
}

/* --- of a motion, twice --------------------------------------------------------------- */

/* Nothing but x, which was left out, is newest in it: that is all there is to add. */
static bool
lacks_argument(const step *s)
{
    return (s->s->op == QDOT_T_SINCOS || s->s->op == QDOT_T_SINHCOSH) &&
           s->s->newest & QDOT_X_NEWEST && s->w->rows[s->s->x].absent;
}

static void
add_argument(const step *s)
{
    const qdot_program_row to[] = {s->s->to, s->s->second};

    weighted(s, s->s->x, s->s->d);
    for (int i = 0; i < 2; i++) {
        qdot_lanes_sum sum = QDOT_LANES_NOTHING;

        if (qdot_writer_is_kept(s->w, s->i, i))
            sum = qdot_lanes_continue(s->w, at(to[i], s->k));
        with_newest(s, &sum, i == 1 && s->s->op == QDOT_T_SINCOS, to[1 - i], s->s->x);
        store(s, sum, to[i]);
    }
}

static void
leave_out(qdot_lanes_writer *w, const qdot_motion_unknown *u)
{
    const qdot_program_row rows[] = {u->row, u->once, u->twice};

    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
        if (rows[r] != QDOT_NO_ROW)
            w->rows[rows[r]].absent = true;
}

static void
write_without(const step *s)
{
    qdot_writer_step *info = s->w->steps + s->i;
    qdot_lanes_sum sums[QDOT_WRITER_RESTS];

    before(s, sums);
    info->lacks = lacks_argument(s);
    for (int r = 0; r < QDOT_WRITER_RESTS && s->s->kept; r++)
        qdot_writer_keep(s->w, s->i, r, sums[r], !info->lacks);
    after(s, sums);
}

void
qdot_lanes_steps_without(qdot_lanes_writer *w, const qdot_motion *m, int k)
{
    qdot_writer_begin(w, k);
    if (w->motion != m)
        qdot_writer_fold(w, m);
    for (size_t r = 0; r < w->t->rows.n; r++)
        w->rows[r].absent = false;
    for (size_t i = 0; i < m->solved.n; i++)
        leave_out(w, m->unknowns.at + m->solved.at[i]);
    w->without = true;
    for (size_t i = w->t->still; i < w->t->length; i++) {
        const step s = {w, w->t->steps.at + i, i, k + w->t->steps.at[i].lead};

        if (!w->steps[i].folded && !(s.s->newest && w->steps[i].idle))
            write_without(&s);
    }
    w->without = false;
    for (size_t i = w->t->still; i < w->t->length; i++) {
        const qdot_program_step *s = w->t->steps.at + i;

        if (s->newest && !w->steps[i].lacks && !w->rows[s->to].equation)
            qdot_lanes_unread(w, at(s->to, k + s->lead));
    }
}

void
qdot_lanes_steps_with(qdot_lanes_writer *w)
{
    for (size_t r = 0; r < w->t->rows.n; r++)
        w->rows[r].absent = false;
    for (size_t i = w->t->still; i < w->t->length; i++) {
        const step s = {w, w->t->steps.at + i, i, w->k + w->t->steps.at[i].lead};
        qdot_lanes_sum sums[QDOT_WRITER_RESTS];

        if (w->steps[i].folded || !s.s->newest || !s.s->kept)
            continue;
        if (w->steps[i].lacks) {
            add_argument(&s);
            continue;
        }
        if (w->steps[i].idle)
            before(&s, sums);
        for (int r = 0; r < QDOT_WRITER_RESTS && !w->steps[i].idle; r++)
            sums[r] = qdot_writer_kept(w, i, r);
        after(&s, sums);
    }
}
