/* lanes-steps.c -- writes one order of a recurrence as machine code, without and then with the
 * newest coefficients. */
#include "series/lanes-writer.h"
#include "series/recurrence-operations.h"

/* A step of the program at the present order, while its code is written. */
typedef struct {
    qdot_lanes_writer *w;
    const qdot_program_step *s;
    size_t i; /* index of the step */
    int k;
} step;

static qdot_lanes_at
row_at(qdot_program_row row, int order)
{
    return (qdot_lanes_at){row, order};
}

static double
inverse_of_order(int k)
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

/* Store a coefficient; without the inputs' newest coefficients it may be absent. */
static void
store(const step *s, qdot_lanes_sum sum, qdot_program_row to)
{
    qdot_lanes_writer *w = s->w;

    if (w->without && sum == QDOT_LANES_NOTHING)
        w->rows[to].absent = true;
    else
        qdot_lanes_store(w, sum, row_at(to, s->k));
}

/* Add or subtract the present coefficient of a term. */
static void
step_add_term(const step *s, qdot_lanes_sum *sum, bool minus, qdot_writer_addend t)
{
    minus ^= t.minus;
    if (t.rates == 0)
        qdot_lanes_add(s->w, sum, minus, row_at(t.row, s->k));
    else {
        s->w->rates |= 1U << ((t.rates > 1) * QDOT_LANES_LEADS + s->s->lead);
        qdot_lanes_add_product(s->w, sum, minus,
                               qdot_lanes_rate(s->w, t.rates > 1, s->s->lead),
                               row_at(t.row, s->k + t.rates));
    }
}

static void
step_add_row(const step *s, qdot_lanes_sum *sum, bool minus, qdot_program_row row)
{
    step_add_term(s, sum, minus, qdot_writer_expand(s->w, row));
}

/* Write code for the rate of a position: to = x'/unit. */
static void
step_write_rate(const step *s)
{
    qdot_writer_addend t = qdot_writer_expand(s->w, s->s->x);
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    t.rates++;
    step_add_term(s, &sum, false, t);
    store(s, sum, s->s->to);
}

/* Complete a sum by +-x_0 y_k, the product with the newest coefficient. */
static void
with_newest(const step *s, qdot_lanes_sum *sum, bool minus, qdot_program_row x,
            qdot_program_row y)
{
    qdot_lanes_add_product(s->w, sum, minus, row_at(x, 0), row_at(y, s->k));
}

/* --- what needs no coefficient of order k ------------------------------------------- */

static qdot_program_row
step_row_of(const step *s, unsigned name)
{
    return qdot_program_step_row(s->s, name);
}

/* Sum the products of lower orders: sums[0] goes into U1 or a row, sums[1] into U2. */
static void
sum_lower_orders(const step *s, qdot_lanes_sum *sums)
{
    const qdot_recurrence_operation *o = qdot_recurrence_operations(s->s->op);
    qdot_lanes_pair pairs[QDOT_WRITER_RESTS][QDOT_WRITER_PAIRS];
    size_t n[QDOT_WRITER_RESTS] = {0};

    sums[0] = sums[1] = QDOT_LANES_NOTHING;
    for (; o->verb != QDOT_DO_END; o++) {
        const int i = o->r == QDOT_OF_U2;

        if (o->verb == QDOT_DO_SQUARED) {
            sums[i] = qdot_writer_square(s->w, step_row_of(s, o->a), s->k);
        } else if (o->verb == QDOT_DO_SUM && o->paired) {
            qdot_writer_pair(s->w, step_row_of(s, o->a), step_row_of(s, o->b), step_row_of(s, o[1].b), s->k,
                             sums);
            o++;
        } else if (o->verb == QDOT_DO_SUM) {
            pairs[i][n[i]++] = (qdot_lanes_pair){step_row_of(s, o->a), step_row_of(s, o->b)};
        }
    }
    for (const qdot_program_step *p = qdot_writer_within(s->w, s->s); p;
         p = qdot_writer_within(s->w, p))
        pairs[0][n[0]++] = (qdot_lanes_pair){p->x, p->y};
    for (int i = 0; i < QDOT_WRITER_RESTS; i++)
        if (n[i] > 0)
            sums[i] = qdot_lanes_dots(s->w, n[i], pairs[i], s->k);
}

/* --- what needs coefficient k of the operands --------------------------------------- */

/* Whether the step must only be computed while unknowns are still unknown. */
static bool
is_passing(const qdot_lanes_writer *w, const qdot_program_step *s)
{
    return s->newest && !s->kept && !w->rows[s->to].equation;
}

/* Whether no later step reads the row. */
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

/* Add a chain of products, each added to the next; x is the newer factor (program.c). */
static void
products(const step *s, qdot_lanes_sum sum)
{
    const qdot_program_step *last = s->s;

    for (const qdot_program_step *p = s->s; p; p = qdot_writer_within(s->w, p))
        last = p;
    if (last->op != QDOT_T_MUL)
        step_add_row(s, &sum, last->op == QDOT_T_MSUB, last->z);
    for (const qdot_program_step *p = s->s; p; p = qdot_writer_within(s->w, p))
        with_newest(s, &sum, false, p->x, p->y);
    for (const qdot_program_step *p = s->s; p; p = qdot_writer_within(s->w, p))
        with_newest(s, &sum, false, p->y, p->x);
    store(s, sum, s->s->to);
}

/* The number U1, U2 or the value of a row: +- a sum. */
typedef struct {
    qdot_lanes_sum sum;
    bool minus;
} number;

static const number nothing = {.sum = QDOT_LANES_NOTHING};

/* Add or subtract coefficient k of a row, or U1 or U2, which is then used up, to the number v. */
static void
step_add_number(const step *s, number *v, bool minus, unsigned name, number *u)
{
    number *other;

    minus ^= v->minus;
    if (name < QDOT_OF_U1) {
        step_add_row(s, &v->sum, minus, step_row_of(s, name));
        return;
    }
    other = u + (name - QDOT_OF_U1);
    qdot_writer_join(s->w, minus ^ other->minus ? QDOT_ASM_SUB : QDOT_ASM_ADD, &v->sum,
                     other->sum);
    *other = nothing;
}

/* A number that starts as operand `name`; for U1, U2 the sum is moved out of u. */
static number
step_number_of(const step *s, unsigned name, number *u)
{
    number v = nothing;

    if (name < QDOT_OF_U1) {
        step_add_number(s, &v, false, name, u);
    } else {
        v = u[name - QDOT_OF_U1];
        u[name - QDOT_OF_U1] = nothing;
    }
    return v;
}

static bool
is_folded(const step *s, unsigned name)
{
    return qdot_writer_expand(s->w, step_row_of(s, name)).row != step_row_of(s, name);
}

/* Take the sum q of an operation out of u; if y is not computed, q is left out and z is taken. */
static number
take_sum(const step *s, const qdot_recurrence_operation *o, number *u)
{
    const qdot_lanes_at z = row_at(s->s->z, s->k);

    if (s->s->op == QDOT_T_SCALEADD && s->w->rows[s->s->y].absent && is_last_reader(s, z.row))
        return (number){.sum = qdot_lanes_continue_last(s->w, z)};
    return step_number_of(s, o->q, u);
}

/* Multiply the number p by 1 + b_0. */
static void
times_more(const step *s, number *p, qdot_lanes_at b)
{
    qdot_lanes_sum more = QDOT_LANES_NOTHING;

    qdot_lanes_add(s->w, &more, false, b);
    qdot_lanes_add(s->w, &more, false, qdot_lanes_scalar(s->w, 1));
    qdot_writer_join(s->w, QDOT_ASM_MUL, &p->sum, more);
}

/* The number q +- p b_0. */
static number
with_product(const step *s, const qdot_recurrence_operation *o, number *u)
{
    const bool minus = o->verb == QDOT_DO_MINUS_TIMES;
    const qdot_program_row b = step_row_of(s, o->b);
    number v = o->verb == QDOT_DO_TIMES ? nothing : take_sum(s, o, u);

    if (o->p < QDOT_OF_U1) {
        with_newest(s, &v.sum, minus ^ v.minus, b, step_row_of(s, o->p));
    } else if (o->verb == QDOT_DO_PLUS_TIMES && o->p == o->q) {
        times_more(s, &v, row_at(b, 0));
    } else {
        qdot_lanes_scale(s->w, &u[o->p - QDOT_OF_U1].sum, row_at(b, 0));
        step_add_number(s, &v, minus, o->p, u);
    }
    return v;
}

/* The number computed by one operation of a recurrence. */
static number
step_result(const step *s, const qdot_recurrence_operation *o, number *u)
{
    const qdot_program_row a = step_row_of(s, o->a), b = step_row_of(s, o->b);
    number v;

    switch (o->verb) {
    case QDOT_DO_SUM:
    case QDOT_DO_SQUARED:
        v = step_number_of(s, o->r == QDOT_OF_U2 ? QDOT_OF_U2 : QDOT_OF_U1, u);
        if (o->from == 0)
            with_newest(s, &v.sum, false, a, b);
        if (o->below == 0)
            with_newest(s, &v.sum, false, b, a);
        return v;
    case QDOT_DO_TIMES:
    case QDOT_DO_PLUS_TIMES:
    case QDOT_DO_MINUS_TIMES: return with_product(s, o, u);
    case QDOT_DO_SUB:
        if (o->q >= QDOT_OF_U1 && o->p < QDOT_OF_U1 && !is_folded(s, o->p)) {
            v = step_number_of(s, o->q, u);
            qdot_lanes_take_from(s->w, &v.sum, row_at(step_row_of(s, o->p), s->k));
            return v;
        }
        break;
    case QDOT_DO_NEG:
        if (o->p >= QDOT_OF_U1)
            break;
        v = nothing;
        step_add_number(s, &v, true, o->p, u);
        return v;
    default: break;
    }
    v = step_number_of(s, o->p, u);
    switch (o->verb) {
    case QDOT_DO_ADD: step_add_number(s, &v, false, o->q, u); break;
    case QDOT_DO_SUB: step_add_number(s, &v, true, o->q, u); break;
    case QDOT_DO_NEG: v.minus ^= true; break;
    case QDOT_DO_SIGNED: v.minus ^= s->s->sign < 0; break;
    case QDOT_DO_ORDERS:
        qdot_lanes_scale(s->w, &v.sum, qdot_lanes_scalar_of(s->w, itself, s->k));
        break;
    case QDOT_DO_PER_ORDER:
        qdot_lanes_scale(s->w, &v.sum,
                         qdot_lanes_scalar_of(s->w, v.minus ? minus_inverse : inverse_of_order, s->k));
        v.minus = false;
        break;
    /* the case QDOT_DO_OVER: multiply by the inverse of the step's divisor */
    default: qdot_lanes_scale(s->w, &v.sum, qdot_writer_inverse(s->i));
    }
    return v;
}

static void
after(const step *s, const qdot_lanes_sum *sums)
{
    number u[] = {{.sum = sums[0]}, {.sum = sums[1]}};

    if (s->s->op == QDOT_T_RATE) {
        step_write_rate(s);
        return;
    }
    if (qdot_writer_within(s->w, s->s)) {
        products(s, sums[0]);
        return;
    }
    for (const qdot_recurrence_operation *o = qdot_recurrence_operations(s->s->op);
         o->verb != QDOT_DO_END; o++) {
        number v = step_result(s, o, u);

        if (o->r >= QDOT_OF_U1) {
            u[o->r - QDOT_OF_U1] = v;
            continue;
        }
        if (v.minus)
            qdot_lanes_negate(s->w, &v.sum);
        store(s, v.sum, step_row_of(s, o->r));
    }
}

/* --- all steps of an order ---------------------------------------------------------- */

void
qdot_lanes_steps(qdot_lanes_writer *w, int k)
{
    qdot_writer_begin(w, k);
    for (size_t i = w->t->still; i < w->t->length; i++) {
        const step s = {w, w->t->steps.at + i, i, k};
        qdot_lanes_sum sums[QDOT_WRITER_RESTS];

        sum_lower_orders(&s, sums);
        after(&s, sums);
    }
}

/* --- steps of a motion, computed again once unknowns are known ------------------------ */

/* Whether a sine or hyperbolic sine lacks only the newest coefficient of its argument. */
static bool
lacks_argument(const step *s)
{
    return (s->s->op == QDOT_T_SINCOS || s->s->op == QDOT_T_SINHCOSH) &&
           s->s->newest & QDOT_X_NEWEST && s->w->rows[s->s->x].absent;
}

/* Write order k of the product j x_j: to_k = k x_k. */
static void
step_multiply_by_order(const step *s, qdot_program_row x, qdot_program_row to)
{
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    qdot_lanes_add_product(s->w, &sum, false, qdot_lanes_scalar_of(s->w, itself, s->k),
                           row_at(x, s->k));
    store(s, sum, to);
}

static void
add_argument(const step *s)
{
    const qdot_program_row to[] = {s->s->to, s->s->second};

    step_multiply_by_order(s, s->s->x, s->s->d);
    for (int i = 0; i < 2; i++) {
        qdot_lanes_sum sum = QDOT_LANES_NOTHING;

        if (qdot_writer_is_kept(s->w, s->i, i))
            sum = qdot_lanes_continue(s->w, row_at(to[i], s->k));
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

    sum_lower_orders(s, sums);
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
            qdot_lanes_unread(w, row_at(s->to, k + s->lead));
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
            sum_lower_orders(&s, sums);
        for (int r = 0; r < QDOT_WRITER_RESTS && !w->steps[i].idle; r++)
            sums[r] = qdot_writer_kept(w, i, r);
        after(&s, sums);
    }
}
