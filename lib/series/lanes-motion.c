/* lanes-motion.c -- writes machine code that expands the solution of equations of motion, one in each vector lane. */
#include "series/lanes-motion.h"

#include <math.h>

/* Numbers behind those of rates; then of each block the inverse and the factor; then unknowns that no
 * row holds. */
enum {
    UNIT = QDOT_LANES_RATES,
    UNIT_SQUARE,
    PER_UNIT,
    PER_UNIT_SQUARE,
    ONCE,
    TWICE,
    INVERSES
};

struct qdot_lanes_motion {
    const qdot_motion *motion;
    qdot_lanes_code *code;
    size_t *inverse; /* [blocks] index where the inverse of a block's matrix K begins; its Cholesky factor is n n further on */
    size_t unknown;  /* index of the first number of the unknowns */
    size_t group;
    int to, factored;
};

/* --- factors that depend on the order -------------------------------------------------- */

/* 1/(k + 1), 1/((k + 1)(k + 2)); and in low orders what these are beyond their doubles, for
 * which a division is exact but for the last bit (series/program.h). */
static double
inverse_of_order(int k)
{
    return 1.0 / (k + 1);
}

static double
inverse_of_two_orders(int k)
{
    return 1.0 / ((k + 1) * (k + 2));
}

static double
beyond(double inverse, int k, int divisor)
{
    return k <= QDOT_TAYLOR_EXACT ? fma(-inverse, divisor, 1) / divisor : 0;
}

static double
rounding_of_inverse_of_order(int k)
{
    return beyond(inverse_of_order(k), k, k + 1);
}

static double
rounding_of_inverse_of_two_orders(int k)
{
    return beyond(inverse_of_two_orders(k), k, (k + 1) * (k + 2));
}

static double
rate_factor(int k)
{
    return k + 1;
}

static double
second_rate_factor(int k)
{
    return (double)(k + 1) * (k + 2);
}

/* Write machine code for: coefficient `to` = number * f(k). */
static void
write_factor(qdot_lanes_writer *w, size_t number, qdot_lanes_by_order *f, int k,
             qdot_lanes_at to)
{
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    qdot_lanes_add_product(w, &sum, false, qdot_lanes_number(w, number),
                           qdot_lanes_scalar_of(w, f, k));
    qdot_lanes_store(w, sum, to);
}

/* --- writing one stage ----------------------------------------------------------------- */

static void
write_rate_factors(qdot_lanes_writer *w, int k)
{
    for (int lead = 0; lead < QDOT_LANES_LEADS; lead++) {
        if (qdot_lanes_wants_rate(w, false, lead))
            write_factor(w, PER_UNIT, rate_factor, k + lead, qdot_lanes_rate(w, false, lead));
        if (qdot_lanes_wants_rate(w, true, lead))
            write_factor(w, PER_UNIT_SQUARE, second_rate_factor, k + lead,
                         qdot_lanes_rate(w, true, lead));
    }
}

/* Where coefficient k of unknown i is stored: in its row, or in a number if it has no row. */
static qdot_lanes_at
place_of_unknown(const qdot_lanes_writer *w, const qdot_lanes_motion *c, size_t i, int k)
{
    const qdot_program_row row = c->motion->unknowns.at[c->motion->solved.at[i]].row;

    return row != QDOT_NO_ROW ? (qdot_lanes_at){row, k}
                              : qdot_lanes_number(w, c->unknown + i);
}

/* Write code that solves for the unknowns of a block by a Cholesky factor L with inverted diagonal: L L^T a = -E. */
static void
write_cholesky_solution(qdot_lanes_writer *w, const qdot_lanes_motion *c, size_t b, int k)
{
    const qdot_motion *m = c->motion;
    const size_t first = m->blocks.at[b], n = m->blocks.at[b + 1] - first;
    const size_t L = c->inverse[b] + n * n;

    for (size_t i = 0; i < n; i++) {
        qdot_lanes_sum y = QDOT_LANES_NOTHING;

        qdot_lanes_add(w, &y, true, (qdot_lanes_at){m->equations.at[first + i], k});
        for (size_t j = 0; j < i; j++)
            qdot_lanes_add_product(w, &y, true, place_of_unknown(w, c, first + j, k),
                                   qdot_lanes_number(w, L + i * n + j));
        qdot_lanes_scale(w, &y, qdot_lanes_number(w, L + i * n + i));
        qdot_lanes_store(w, y, place_of_unknown(w, c, first + i, k));
    }
    for (size_t i = n; i-- > 0;) {
        qdot_lanes_sum a = QDOT_LANES_NOTHING;

        qdot_lanes_add(w, &a, false, place_of_unknown(w, c, first + i, k));
        for (size_t j = i + 1; j < n; j++)
            qdot_lanes_add_product(w, &a, true, place_of_unknown(w, c, first + j, k),
                                   qdot_lanes_number(w, L + j * n + i));
        qdot_lanes_scale(w, &a, qdot_lanes_number(w, L + i * n + i));
        qdot_lanes_store(w, a, place_of_unknown(w, c, first + i, k));
    }
}

/* Write code for the unknowns -K^-1 E of block b at order k, where K is the matrix and E the residuals. */
static void
write_unknowns_of_block(qdot_lanes_writer *w, const qdot_lanes_motion *c, size_t b, int k)
{
    const qdot_motion *m = c->motion;
    const size_t first = m->blocks.at[b], n = m->blocks.at[b + 1] - first;

    if (k <= c->factored && n > 1) {
        write_cholesky_solution(w, c, b, k);
        return;
    }
    for (size_t i = 0; i < n; i++) {
        qdot_lanes_sum a = QDOT_LANES_NOTHING;

        for (size_t j = 0; j < n; j++)
            qdot_lanes_add_product(w, &a, false,
                                   (qdot_lanes_at){m->equations.at[first + j], k},
                                   qdot_lanes_number(w, c->inverse[b] + i * n + j));
        qdot_lanes_store(w, a, place_of_unknown(w, c, first + i, k));
    }
}

static void
write_integrated_coefficient(qdot_lanes_writer *w, const qdot_lanes_motion *c, int k, qdot_lanes_at a,
                             size_t unit, qdot_lanes_by_order *more, size_t factor, qdot_lanes_at to)
{
    qdot_lanes_sum sum = QDOT_LANES_NOTHING;

    /* correct the rounding of the inverse at low orders, as by a division (program.h); the orders in the loop are higher */
    if (c->to >= QDOT_TAYLOR_EXACT_FROM && k <= QDOT_TAYLOR_EXACT) {
        qdot_lanes_add_product(w, &sum, false, qdot_lanes_number(w, unit),
                               qdot_lanes_scalar_of(w, more, k));
        qdot_lanes_scale(w, &sum, a);
    }
    qdot_lanes_add_product(w, &sum, false, qdot_lanes_number(w, factor), a);
    qdot_lanes_store(w, sum, to);
}

/* Write code for coefficients k + 1 of the first and k + 2 of the second integral of an unknown (velocity, position). */
static void
write_integrated_unknown(qdot_lanes_writer *w, const qdot_lanes_motion *c,
                         const qdot_motion_unknown *u, qdot_lanes_at a, int k)
{
    if (u->twice != QDOT_NO_ROW)
        write_integrated_coefficient(w, c, k, a, UNIT_SQUARE, rounding_of_inverse_of_two_orders, TWICE,
                                     (qdot_lanes_at){u->twice, k + 2});
    if (u->once != QDOT_NO_ROW)
        write_integrated_coefficient(w, c, k, a, UNIT, rounding_of_inverse_of_order, ONCE,
                                     (qdot_lanes_at){u->once, k + 1});
}

/* Write code for stage m of the expansion: each step at order m plus its lead (how many orders it is ahead). */
static void
write_stage_code(qdot_lanes_writer *w, int m, void *user)
{
    const qdot_lanes_motion *c = user;
    const qdot_motion *motion = c->motion;
    const int k = m - motion->program.lead;

    write_rate_factors(w, k);
    qdot_lanes_steps_without(w, motion, k);
    write_factor(w, UNIT, inverse_of_order, k, qdot_lanes_number(w, ONCE));
    write_factor(w, UNIT_SQUARE, inverse_of_two_orders, k, qdot_lanes_number(w, TWICE));
    for (size_t b = 0; b + 1 < motion->blocks.n; b++)
        write_unknowns_of_block(w, c, b, k);
    for (size_t i = 0; i < motion->equations.n; i++)
        qdot_lanes_unread(w, (qdot_lanes_at){motion->equations.at[i], k});
    for (size_t i = 0, solved = 0; i < motion->unknowns.n; i++) {
        const qdot_motion_unknown *u = motion->unknowns.at + i;

        write_integrated_unknown(w, c, u,
                                 u->value != QDOT_NO_ROW ? (qdot_lanes_at){u->value, k}
                                                : place_of_unknown(w, c, solved++, k),
                        k);
    }
    for (size_t i = 0; i < motion->solved.n; i++)
        qdot_lanes_unread(w, qdot_lanes_number(w, c->unknown + i));
    qdot_lanes_steps_with(w);
}

static void
write_all_stages(qdot_lanes_writer *w, void *user)
{
    const qdot_lanes_motion *c = user;
    const int lead = c->motion->program.lead;
    const int exact = c->to >= QDOT_TAYLOR_EXACT_FROM ? QDOT_TAYLOR_EXACT : 0;
    const int loop = (c->factored > exact ? c->factored : exact) + 1;

    qdot_lanes_orders(w, 1 + lead, lead, loop + lead, c->to + lead, write_stage_code, user);
}

/* --- building and running the code ----------------------------------------------------- */

static qdot_status
make_motion_code(qdot_lanes_motion *c, const qdot_lanes_rows *rows, qdot_lanes_motion **code)
{
    const qdot_motion *m = c->motion;
    size_t numbers = INVERSES;

    c->inverse = qdot_calloc(m->blocks.n + 1, sizeof *c->inverse);
    if (!c->inverse)
        return QDOT_ENOMEM;
    for (size_t b = 0; b + 1 < m->blocks.n; b++) {
        const size_t n = m->blocks.at[b + 1] - m->blocks.at[b];

        if (n > QDOT_LANES_SOLVED)
            return QDOT_OK;
        c->inverse[b] = numbers;
        numbers += (c->factored > 0 ? 2 : 1) * n * n;
    }
    c->unknown = numbers;
    if (m->program.lead < QDOT_LANES_LEADS)
        QDOT_TRY(
            qdot_lanes_code_new(rows, numbers + m->solved.n, write_all_stages, c, &c->code));
    if (c->code)
        *code = c;
    return QDOT_OK;
}

qdot_status
qdot_lanes_motion_new(const qdot_lanes_rows *rows, const qdot_motion *motion, int to,
                      int factored, qdot_lanes_motion **code)
{
    qdot_lanes_motion *c = qdot_calloc(1, sizeof *c);
    qdot_status status;

    *code = NULL;
    if (!c)
        return QDOT_ENOMEM;
    *c = (qdot_lanes_motion){
        .motion = motion, .group = rows->group, .to = to, .factored = factored};
    status = make_motion_code(c, rows, code);
    if (!*code)
        qdot_lanes_motion_free(c);
    return status;
}

void
qdot_lanes_motion_free(qdot_lanes_motion *c)
{
    if (!c)
        return;
    qdot_lanes_code_free(c->code);
    qdot_free(c->inverse);
    qdot_free(c);
}

void
qdot_lanes_motion_set(qdot_lanes_motion *c, size_t b, const double *inverse,
                      size_t length, const double *L)
{
    const size_t n = c->motion->blocks.at[b + 1] - c->motion->blocks.at[b];
    double *minus = qdot_lanes_code_number(c->code, c->inverse[b]);

    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n * c->group; j++)
            *minus++ = -inverse[i * length * c->group + j];
    for (size_t i = 0; i < n && L; i++, minus += n * c->group)
        for (size_t j = 0; j <= i; j++)
            for (size_t l = 0; l < c->group; l++) {
                const double x = L[(i * n + j) * c->group + l];

                minus[j * c->group + l] = i == j ? 1 / x : x;
            }
}

void
qdot_lanes_motion_run(qdot_lanes_motion *c, const double *unit)
{
    double *number = qdot_lanes_code_number(c->code, 0);

    for (size_t l = 0; l < c->group; l++) {
        number[UNIT * c->group + l] = unit[l];
        number[UNIT_SQUARE * c->group + l] = unit[l] * unit[l];
        number[PER_UNIT * c->group + l] = 1 / unit[l];
        number[PER_UNIT_SQUARE * c->group + l] = 1 / (unit[l] * unit[l]);
    }
    qdot_lanes_code_run(c->code);
}

size_t
qdot_lanes_motion_size(const qdot_lanes_motion *c)
{
    return qdot_lanes_code_size(c->code);
}

int
qdot_lanes_motion_orders(const qdot_lanes_motion *c)
{
    return c->to;
}
