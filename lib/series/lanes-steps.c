/* lanes-steps.c -- writes one order of a recurrence as machine code, without and then with the
 * newest coefficients. */
#include "series/lanes-writer.h"
#include "series/recurrence-operations.h"

/* A step (operation) of the series program at the present order, while machine code for it is written. */
typedef struct {
    qdot_lanes_writer *w;
    const qdot_program_step *s;
    size_t i; /* index of this step in the program */
    int k;
} step;

static qdot_lanes_at
coefficient_at(qdot_program_row row, int order)
{
    return (qdot_lanes_at){row, order};
}

static double
inverse_of_order_number(int k)
{
    return 1.0 / k;
}

static double
negative_inverse_of_order(int k)
{
    return -1.0 / k;
}

static double
order_as_factor(int k)
{
    return k;
}

/* Store a sum as the coefficient of a row; while unknowns are not known, an empty sum marks this as absent. */
static void
store_coefficient(const step *s, qdot_lanes_sum sum, qdot_program_row to)
{
    qdot_lanes_writer *w = s->w;

    if (w->without && sum == QDOT_LANES_NOTHING)
        w->rows[to].absent = true;
    else
        qdot_lanes_store(w, sum, coefficient_at(to, s->k));
}

/* Add or subtract the coefficient of the present order of a term, a row or its rate with a sign. */
static void
add_term(const step *s, qdot_lanes_sum *sum, bool minus, qdot_writer_addend t)
{
    minus ^= t.minus;
    if (t.rates == 0)
        qdot_lanes_add(s->w, sum, minus, coefficient_at(t.row, s->k));
    else {
        s->w->rates |= 1U << ((t.rates > 1) * QDOT_LANES_LEADS + s->s->lead);
        qdot_lanes_add_product(s->w, sum, minus,
                               qdot_lanes_rate(s->w, t.rates > 1, s->s->lead),
                               coefficient_at(t.row, s->k + t.rates));
    }
}

static void
add_coefficient(const step *s, qdot_lanes_sum *sum, bool minus, qdot_program_row row)
{
    add_term(s, sum, minus, qdot_writer_expand(s->w, row));
}

/* Write machine code for the time derivative of a row x: coefficient of `to` from x', divided by the unit of time. */
static void
write_rate_of_row(const step *s)
{
    qdot_writer_addend t = qdot_writer_expand(s->w, s->s->x);
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    t.rates++;
    add_term(s, &sum, false, t);
    store_coefficient(s, sum, s->s->to);
}

/* Complete a sum of products by +-x_0 y_k, the product with the newest coefficient of y. */
static void
add_newest_product(const step *s, qdot_lanes_sum *sum, bool minus, qdot_program_row x,
                   qdot_program_row y)
{
    qdot_lanes_add_product(s->w, sum, minus, coefficient_at(x, 0), coefficient_at(y, s->k));
}

/* --- what needs no coefficient of order k ------------------------------------------- */

static qdot_program_row
row_of_operand(const step *s, unsigned name)
{
    return qdot_program_step_row(s->s, name);
}

/* Write the sums of products of lower orders: sums[0] belongs to temporary U1 or a row, sums[1] to U2. */
static void
write_lower_order_sums(const step *s, qdot_lanes_sum *sums)
{
    const qdot_recurrence_operation *o = qdot_recurrence_operations(s->s->op);
    qdot_lanes_pair pairs[QDOT_WRITER_RESTS][QDOT_WRITER_PAIRS];
    size_t n[QDOT_WRITER_RESTS] = {0};

    sums[0] = sums[1] = QDOT_LANES_NOTHING;
    for (; o->verb != QDOT_DO_END; o++) {
        const int i = o->r == QDOT_OF_U2;

        if (o->verb == QDOT_DO_SQUARED) {
            sums[i] = qdot_writer_square(s->w, row_of_operand(s, o->a), s->k);
        } else if (o->verb == QDOT_DO_SUM && o->paired) {
            qdot_writer_pair(s->w, row_of_operand(s, o->a), row_of_operand(s, o->b), row_of_operand(s, o[1].b), s->k,
                             sums);
            o++;
        } else if (o->verb == QDOT_DO_SUM) {
            pairs[i][n[i]++] = (qdot_lanes_pair){row_of_operand(s, o->a), row_of_operand(s, o->b)};
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

/* Whether the result of the step is needed only while the unknowns of its order are not known yet. */
static bool
is_needed_before_unknowns(const qdot_lanes_writer *w, const qdot_program_step *s)
{
    return s->newest && !s->kept && !w->rows[s->to].equation;
}

/* Whether no later step of the program reads the row. */
static bool
is_last_reader(const step *s, qdot_program_row row)
{
    const qdot_program_step *const steps = s->w->t->steps.at;
    bool passes = false;

    for (size_t i = s->w->t->still; i < s->i && !passes; i++)
        passes = steps[i].to == row && is_needed_before_unknowns(s->w, steps + i);
    for (size_t i = s->i + 1; i < s->w->t->length && passes; i++)
        passes = steps[i].x != row && steps[i].y != row && steps[i].z != row;
    return passes;
}

/* Write a chain of products that are added to each other; x is the factor computed later (program.c). */
static void
write_chain_of_products(const step *s, qdot_lanes_sum sum)
{
    const qdot_program_step *last = s->s;

    for (const qdot_program_step *p = s->s; p; p = qdot_writer_within(s->w, p))
        last = p;
    if (last->op != QDOT_T_MUL)
        add_coefficient(s, &sum, last->op == QDOT_T_MSUB, last->z);
    for (const qdot_program_step *p = s->s; p; p = qdot_writer_within(s->w, p))
        add_newest_product(s, &sum, false, p->x, p->y);
    for (const qdot_program_step *p = s->s; p; p = qdot_writer_within(s->w, p))
        add_newest_product(s, &sum, false, p->y, p->x);
    store_coefficient(s, sum, s->s->to);
}

/* A value while code is written (temporary U1, U2 or a row): a sum in a register, with a sign. */
typedef struct {
    qdot_lanes_sum sum;
    bool minus;
} number;

static const number nothing = {.sum = QDOT_LANES_NOTHING};

/* Add to the value v, or subtract from it, coefficient k of a row, or temporary U1 or U2, which is then used up. */
static void
add_to_value(const step *s, number *v, bool minus, unsigned name, number *u)
{
    number *other;

    minus ^= v->minus;
    if (name < QDOT_OF_U1) {
        add_coefficient(s, &v->sum, minus, row_of_operand(s, name));
        return;
    }
    other = u + (name - QDOT_OF_U1);
    qdot_writer_join(s->w, minus ^ other->minus ? QDOT_ASM_SUB : QDOT_ASM_ADD, &v->sum,
                     other->sum);
    *other = nothing;
}

/* A value that starts as the operand `name`; for temporaries U1, U2 the sum is moved out of u. */
static number
value_of_operand(const step *s, unsigned name, number *u)
{
    number v = nothing;

    if (name < QDOT_OF_U1) {
        add_to_value(s, &v, false, name, u);
    } else {
        v = u[name - QDOT_OF_U1];
        u[name - QDOT_OF_U1] = nothing;
    }
    return v;
}

static bool
operand_is_folded(const step *s, unsigned name)
{
    return qdot_writer_expand(s->w, row_of_operand(s, name)).row != row_of_operand(s, name);
}

/* Take the summand q of an operation out of u; if operand y is not computed, take z instead of q. */
static number
take_summand(const step *s, const qdot_recurrence_operation *o, number *u)
{
    const qdot_lanes_at z = coefficient_at(s->s->z, s->k);

    if (s->s->op == QDOT_T_SCALEADD && s->w->rows[s->s->y].absent && is_last_reader(s, z.row))
        return (number){.sum = qdot_lanes_continue_last(s->w, z)};
    return value_of_operand(s, o->q, u);
}

/* Multiply the value p by 1 + b_0, where b_0 is the coefficient of order 0 of row b. */
static void
multiply_by_one_plus(const step *s, number *p, qdot_lanes_at b)
{
    qdot_lanes_sum more = QDOT_LANES_NOTHING;

    qdot_lanes_add(s->w, &more, false, b);
    qdot_lanes_add(s->w, &more, false, qdot_lanes_scalar(s->w, 1));
    qdot_writer_join(s->w, QDOT_ASM_MUL, &p->sum, more);
}

/* Form the value q +- p b_0 of an operation of a recurrence. */
static number
add_scaled_value(const step *s, const qdot_recurrence_operation *o, number *u)
{
    const bool minus = o->verb == QDOT_DO_MINUS_TIMES;
    const qdot_program_row b = row_of_operand(s, o->b);
    number v = o->verb == QDOT_DO_TIMES ? nothing : take_summand(s, o, u);

    if (o->p < QDOT_OF_U1) {
        add_newest_product(s, &v.sum, minus ^ v.minus, b, row_of_operand(s, o->p));
    } else if (o->verb == QDOT_DO_PLUS_TIMES && o->p == o->q) {
        multiply_by_one_plus(s, &v, coefficient_at(b, 0));
    } else {
        qdot_lanes_scale(s->w, &u[o->p - QDOT_OF_U1].sum, coefficient_at(b, 0));
        add_to_value(s, &v, minus, o->p, u);
    }
    return v;
}

/* Form the value that one operation of a recurrence computes. */
static number
value_of_operation(const step *s, const qdot_recurrence_operation *o, number *u)
{
    const qdot_program_row a = row_of_operand(s, o->a), b = row_of_operand(s, o->b);
    number v;

    switch (o->verb) {
    case QDOT_DO_SUM:
    case QDOT_DO_SQUARED:
        v = value_of_operand(s, o->r == QDOT_OF_U2 ? QDOT_OF_U2 : QDOT_OF_U1, u);
        if (o->from == 0)
            add_newest_product(s, &v.sum, false, a, b);
        if (o->below == 0)
            add_newest_product(s, &v.sum, false, b, a);
        return v;
    case QDOT_DO_TIMES:
    case QDOT_DO_PLUS_TIMES:
    case QDOT_DO_MINUS_TIMES: return add_scaled_value(s, o, u);
    case QDOT_DO_SUB:
        if (o->q >= QDOT_OF_U1 && o->p < QDOT_OF_U1 && !operand_is_folded(s, o->p)) {
            v = value_of_operand(s, o->q, u);
            qdot_lanes_take_from(s->w, &v.sum, coefficient_at(row_of_operand(s, o->p), s->k));
            return v;
        }
        break;
    case QDOT_DO_NEG:
        if (o->p >= QDOT_OF_U1)
            break;
        v = nothing;
        add_to_value(s, &v, true, o->p, u);
        return v;
    default: break;
    }
    v = value_of_operand(s, o->p, u);
    switch (o->verb) {
    case QDOT_DO_ADD: add_to_value(s, &v, false, o->q, u); break;
    case QDOT_DO_SUB: add_to_value(s, &v, true, o->q, u); break;
    case QDOT_DO_NEG: v.minus ^= true; break;
    case QDOT_DO_SIGNED: v.minus ^= s->s->sign < 0; break;
    case QDOT_DO_ORDERS:
        qdot_lanes_scale(s->w, &v.sum, qdot_lanes_scalar_of(s->w, order_as_factor, s->k));
        break;
    case QDOT_DO_PER_ORDER:
        qdot_lanes_scale(s->w, &v.sum,
                         qdot_lanes_scalar_of(s->w, v.minus ? negative_inverse_of_order : inverse_of_order_number, s->k));
        v.minus = false;
        break;
    /* the case QDOT_DO_OVER: divide by the step's divisor, by multiplying with its inverse */
    default: qdot_lanes_scale(s->w, &v.sum, qdot_writer_inverse(s->i));
    }
    return v;
}

static void
write_newest_part(const step *s, const qdot_lanes_sum *sums)
{
    number u[] = {{.sum = sums[0]}, {.sum = sums[1]}};

    if (s->s->op == QDOT_T_RATE) {
        write_rate_of_row(s);
        return;
    }
    if (qdot_writer_within(s->w, s->s)) {
        write_chain_of_products(s, sums[0]);
        return;
    }
    for (const qdot_recurrence_operation *o = qdot_recurrence_operations(s->s->op);
         o->verb != QDOT_DO_END; o++) {
        number v = value_of_operation(s, o, u);

        if (o->r >= QDOT_OF_U1) {
            u[o->r - QDOT_OF_U1] = v;
            continue;
        }
        if (v.minus)
            qdot_lanes_negate(s->w, &v.sum);
        store_coefficient(s, v.sum, row_of_operand(s, o->r));
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

        write_lower_order_sums(&s, sums);
        write_newest_part(&s, sums);
    }
}

/* --- steps of a motion, computed again once unknowns are known ------------------------ */

/* Whether a sine or hyperbolic sine lacks only the newest coefficient of its argument to be complete. */
static bool
lacks_only_argument(const step *s)
{
    return (s->s->op == QDOT_T_SINCOS || s->s->op == QDOT_T_SINHCOSH) &&
           s->s->newest & QDOT_X_NEWEST && s->w->rows[s->s->x].absent;
}

/* Write order k of the series j x_j that sines and exponentials need: to_k = k x_k. */
static void
write_times_order(const step *s, qdot_program_row x, qdot_program_row to)
{
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    qdot_lanes_add_product(s->w, &sum, false, qdot_lanes_scalar_of(s->w, order_as_factor, s->k),
                           coefficient_at(x, s->k));
    store_coefficient(s, sum, to);
}

static void
complete_sine_by_argument(const step *s)
{
    const qdot_program_row to[] = {s->s->to, s->s->second};

    write_times_order(s, s->s->x, s->s->d);
    for (int i = 0; i < 2; i++) {
        qdot_lanes_sum sum = QDOT_LANES_NOTHING;

        if (qdot_writer_is_kept(s->w, s->i, i))
            sum = qdot_lanes_continue(s->w, coefficient_at(to[i], s->k));
        add_newest_product(s, &sum, i == 1 && s->s->op == QDOT_T_SINCOS, to[1 - i], s->s->x);
        store_coefficient(s, sum, to[i]);
    }
}

static void
mark_unknown_absent(qdot_lanes_writer *w, const qdot_motion_unknown *u)
{
    const qdot_program_row rows[] = {u->row, u->once, u->twice};

    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
        if (rows[r] != QDOT_NO_ROW)
            w->rows[rows[r]].absent = true;
}

static void
write_without_unknowns(const step *s)
{
    qdot_writer_step *info = s->w->steps + s->i;
    qdot_lanes_sum sums[QDOT_WRITER_RESTS];

    write_lower_order_sums(s, sums);
    info->lacks = lacks_only_argument(s);
    for (int r = 0; r < QDOT_WRITER_RESTS && s->s->kept; r++)
        qdot_writer_keep(s->w, s->i, r, sums[r], !info->lacks);
    write_newest_part(s, sums);
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
        mark_unknown_absent(w, m->unknowns.at + m->solved.at[i]);
    w->without = true;
    for (size_t i = w->t->still; i < w->t->length; i++) {
        const step s = {w, w->t->steps.at + i, i, k + w->t->steps.at[i].lead};

        if (!w->steps[i].folded && !(s.s->newest && w->steps[i].idle))
            write_without_unknowns(&s);
    }
    w->without = false;
    for (size_t i = w->t->still; i < w->t->length; i++) {
        const qdot_program_step *s = w->t->steps.at + i;

        if (s->newest && !w->steps[i].lacks && !w->rows[s->to].equation)
            qdot_lanes_unread(w, coefficient_at(s->to, k + s->lead));
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
            complete_sine_by_argument(&s);
            continue;
        }
        if (w->steps[i].idle)
            write_lower_order_sums(&s, sums);
        for (int r = 0; r < QDOT_WRITER_RESTS && !w->steps[i].idle; r++)
            sums[r] = qdot_writer_kept(w, i, r);
        write_newest_part(&s, sums);
    }
}
