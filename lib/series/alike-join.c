/* alike-join.c -- joins steps of like parts that read the same rows: x^2 + y^2 + z^2, three products with one factor,
 * 1/r^3 of r^2. */
#include <string.h>

#include "series/alike-parts.h"

#define NONE SIZE_MAX

/* A row of the kind is its place: those of all orders, then those of one order. */
typedef struct {
    qdot_alike_kind *kind;
    size_t rows;
    size_t *writer; /* [rows] the step that writes it; NONE: an input */
    size_t *reads;  /* [rows] how many steps read it; a result is read once more */
    bool *removed;  /* [steps] */
} joiner;

static size_t
index_of_row(const joiner *j, qdot_alike_place p)
{
    return p.space == QDOT_ALIKE_ORDERS   ? p.at
           : p.space == QDOT_ALIKE_NEWEST ? j->kind->orders + p.at
                                          : NONE;
}

static bool
is_same_row(qdot_alike_place a, qdot_alike_place b)
{
    return a.space == b.space && a.at == b.at;
}

/* The step that writes a row; NULL: it is an input or a number. */
static qdot_alike_step *
writer_of(const joiner *j, qdot_alike_place p)
{
    const size_t row = index_of_row(j, p);

    return row != NONE && j->writer[row] != NONE ? j->kind->steps.at + j->writer[row] : NULL;
}

static size_t
reads_of(const joiner *j, qdot_alike_place p)
{
    const size_t row = index_of_row(j, p);

    return row == NONE ? 0 : j->reads[row];
}

/* How many operands a step reads, by its value at order 0. */
static int
operands_of(const qdot_alike_step *s)
{
    switch (s->op) {
    case QDOT_T_NEG:
    case QDOT_T_SQUARE:
    case QDOT_T_SQRT: return 1;
    case QDOT_T_ADD:
    case QDOT_T_SUB:
    case QDOT_T_MUL:
    case QDOT_T_SCALE:
    case QDOT_T_DIV: return 2;
    default: return 3;
    }
}

static void
find_writers_and_reads(joiner *j)
{
    const qdot_alike_kind *k = j->kind;

    for (size_t i = 0; i < k->steps.n; i++) {
        const qdot_alike_step *s = k->steps.at + i;

        for (int name = QDOT_OF_to; name <= QDOT_OF_d; name++)
            if (index_of_row(j, s->row[name]) != NONE)
                j->writer[index_of_row(j, s->row[name])] = i;
        for (int o = 0; o < operands_of(s); o++)
            if (index_of_row(j, s->row[QDOT_OF_x + o]) != NONE)
                j->reads[index_of_row(j, s->row[QDOT_OF_x + o])]++;
    }
    for (size_t i = 0; i < k->results.n; i++)
        j->reads[index_of_row(j, k->results.at[i].place)]++;
}

/* --- powers ------------------------------------------------------------------------------ */

/* What is known of a row: c base^e, made by some steps beside the base. */
typedef struct {
    bool is_power;
    qdot_alike_place base;
    double e;
    int steps;
} power;

static power
power_of(const joiner *j, const power *known, qdot_alike_place p)
{
    const size_t row = index_of_row(j, p);

    if (row == NONE)
        return (power){0};
    return known[row].is_power ? known[row] : (power){true, p, 1, 0};
}

/* The power that a step makes of powers; a square or product of rows that are no powers is none. */
static power
power_made(const joiner *j, const power *known, const qdot_alike_step *s)
{
    const power x = power_of(j, known, s->row[QDOT_OF_x]), y = power_of(j, known, s->row[QDOT_OF_y]);

    switch (s->op) {
    case QDOT_T_SQRT: return (power){x.is_power, x.base, 0.5 * x.e, x.steps + 1};
    case QDOT_T_SQUARE: return (power){x.steps > 0, x.base, 2 * x.e, x.steps + 1};
    case QDOT_T_SCALE: return (power){y.steps > 0, y.base, y.e, y.steps + 1};
    case QDOT_T_DIV:
        if (s->first[0].space == QDOT_ALIKE_NUMBER)
            return (power){y.is_power, y.base, -y.e, y.steps + 1};
        return (power){0};
    case QDOT_T_MUL:
        if (x.steps > 0 && y.steps > 0 && is_same_row(x.base, y.base))
            return (power){true, x.base, x.e + y.e, x.steps + y.steps + 1};
        return (power){0};
    default: return (power){0};
    }
}

/* Powers that only powers read are left with order 0; of the others those made by several steps have one
 * recurrence. */
static void
join_powers(joiner *j, power *known, size_t *of_powers)
{
    qdot_alike_kind *k = j->kind;

    for (size_t i = 0; i < k->steps.n; i++) {
        const qdot_alike_step *s = k->steps.at + i;
        const power p = power_made(j, known, s);

        if (!p.is_power || s->second || s->third)
            continue;
        known[index_of_row(j, s->row[QDOT_OF_to])] = p;
        for (int o = 0; o < operands_of(s); o++)
            if (index_of_row(j, s->row[QDOT_OF_x + o]) != NONE)
                of_powers[index_of_row(j, s->row[QDOT_OF_x + o])]++;
    }
    for (size_t i = 0; i < k->steps.n; i++) {
        qdot_alike_step *s = k->steps.at + i;
        const size_t row = index_of_row(j, s->row[QDOT_OF_to]);

        if (!known[row].is_power)
            continue;
        if (of_powers[row] == j->reads[row])
            s->op = QDOT_ALIKE_VALUE;
        else if (known[row].steps > 1) {
            s->op = QDOT_ALIKE_POWER;
            s->row[QDOT_OF_x] = known[row].base;
            s->exponent = known[row].e;
        }
    }
}

/* --- squares and products ---------------------------------------------------------------- */

/* The step that writes a row if it is a square or a sum of squares that one step alone reads. */
static qdot_alike_step *
squares_in(const joiner *j, qdot_alike_place p)
{
    qdot_alike_step *s = writer_of(j, p);

    return s && (s->op == QDOT_T_SQUARE || s->op == QDOT_ALIKE_SQUARES) && reads_of(j, p) == 1 ? s : NULL;
}

static void
take_squares(joiner *j, qdot_alike_step *to, const qdot_alike_step *from)
{
    if (from->op == QDOT_T_SQUARE)
        to->x[to->n++] = from->row[QDOT_OF_x];
    for (size_t i = 0; from->op == QDOT_ALIKE_SQUARES && i < from->n; i++)
        to->x[to->n++] = from->x[i];
    j->removed[from - j->kind->steps.at] = true;
}

static size_t
number_of_squares(const qdot_alike_step *s)
{
    return s->op == QDOT_T_SQUARE ? 1 : s->n;
}

static void
join_squares(joiner *j)
{
    for (qdot_alike_step *s = j->kind->steps.at; s < j->kind->steps.at + j->kind->steps.n; s++) {
        const qdot_alike_step *x, *y;

        if (s->op != QDOT_T_ADD)
            continue;
        x = squares_in(j, s->row[QDOT_OF_x]);
        y = squares_in(j, s->row[QDOT_OF_y]);
        if (!x || !y || x == y || number_of_squares(x) + number_of_squares(y) > QDOT_ALIKE_MOST)
            continue;
        take_squares(j, s, x);
        take_squares(j, s, y);
        s->op = QDOT_ALIKE_SQUARES;
    }
}

static bool
is_written_before(const joiner *j, qdot_alike_place p, size_t step)
{
    const size_t row = index_of_row(j, p);

    return row == NONE || j->writer[row] == NONE || j->writer[row] < step;
}

/* Products y x_i of one row y with others that are there by the first of them. */
static void
join_products_with(joiner *j, size_t first, qdot_alike_place y)
{
    qdot_alike_kind *k = j->kind;
    qdot_alike_step *s = k->steps.at + first;
    const bool is_x = is_same_row(s->row[QDOT_OF_x], y);
    qdot_alike_step joined = *s;

    joined.op = QDOT_ALIKE_PRODUCTS;
    joined.n = 1;
    joined.to[0] = s->row[QDOT_OF_to];
    joined.x[0] = s->row[is_x ? QDOT_OF_y : QDOT_OF_x];
    joined.row[QDOT_OF_y] = y;
    for (size_t i = first + 1; i < k->steps.n && joined.n < QDOT_ALIKE_MOST; i++) {
        const qdot_alike_step *o = k->steps.at + i;
        const bool by_x = is_same_row(o->row[QDOT_OF_x], y);
        const qdot_alike_place x = o->row[by_x ? QDOT_OF_y : QDOT_OF_x];

        if (j->removed[i] || o->op != QDOT_T_MUL || !(by_x || is_same_row(o->row[QDOT_OF_y], y)) ||
            !is_written_before(j, x, first))
            continue;
        joined.to[joined.n] = o->row[QDOT_OF_to];
        joined.x[joined.n++] = x;
        j->removed[i] = true;
        j->writer[index_of_row(j, o->row[QDOT_OF_to])] = first;
    }
    if (joined.n > 1)
        *s = joined;
}

static void
join_products(joiner *j)
{
    for (size_t i = 0; i < j->kind->steps.n; i++)
        for (int name = QDOT_OF_x; name <= QDOT_OF_y; name++)
            if (!j->removed[i] && j->kind->steps.at[i].op == QDOT_T_MUL)
                join_products_with(j, i, j->kind->steps.at[i].row[name]);
}

/* --- rows that are needed to all orders -------------------------------------------------- */

/* Mark the rows of a step that sums over orders read, or the length of a step. */
static void
mark_summed(const joiner *j, const qdot_alike_step *s, bool *summed)
{
    unsigned names = 0, first;

    if (s->op < QDOT_T_COUNT)
        qdot_alike_reading(s->op, &names, &first);
    if (s->op == QDOT_ALIKE_POWER)
        names = 1u << QDOT_OF_x | 1u << QDOT_OF_to;
    if (s->op == QDOT_ALIKE_PRODUCTS)
        names = 1u << QDOT_OF_y;
    for (int name = 0; name < QDOT_OF_ROWS; name++)
        if (names >> name & 1 && index_of_row(j, s->row[name]) != NONE)
            summed[index_of_row(j, s->row[name])] = true;
    for (size_t i = 0; i < s->n; i++)
        if (index_of_row(j, s->x[i]) != NONE)
            summed[index_of_row(j, s->x[i])] = true;
}

static void
move_row(const joiner *j, const qdot_alike_place *to, qdot_alike_place *p)
{
    if (index_of_row(j, *p) != NONE)
        *p = to[index_of_row(j, *p)];
}

static void
move_rows_of_step(const joiner *j, const qdot_alike_place *to, qdot_alike_step *s)
{
    for (int name = 0; name < QDOT_OF_ROWS; name++)
        move_row(j, to, s->row + name);
    for (int i = 0; i < 3; i++)
        move_row(j, to, s->first + i);
    for (size_t i = 0; i < s->n; i++) {
        move_row(j, to, s->to + i);
        move_row(j, to, s->x + i);
    }
}

static double
convolutions_of(const qdot_alike_step *s)
{
    switch (s->op) {
    case QDOT_ALIKE_VALUE: return 0;
    case QDOT_ALIKE_SQUARES: return 0.5 * (double)s->n;
    case QDOT_ALIKE_PRODUCTS: return (double)s->n;
    case QDOT_ALIKE_POWER: return 1;
    default: return qdot_recurrence_cost(s->op);
    }
}

static size_t
partial_sums_of(const qdot_alike_step *s)
{
    return s->op == QDOT_ALIKE_PRODUCTS ? s->n : s->op == QDOT_ALIKE_SQUARES || s->op == QDOT_ALIKE_POWER;
}

/* Remove steps, and give rows that no sum reads a place for one order. */
static void
place_rows_anew(joiner *j, bool *summed, qdot_alike_place *to)
{
    qdot_alike_kind *k = j->kind;
    size_t n = 0;
    uint32_t orders = 0, newest = 0;

    for (size_t i = 0; i < k->steps.n; i++)
        if (!j->removed[i])
            k->steps.at[n++] = k->steps.at[i];
    k->steps.n = n;
    for (size_t i = 0; i < n; i++)
        mark_summed(j, k->steps.at + i, summed);
    for (size_t i = 1; i < k->summed.n; i += 2)
        summed[index_of_row(j, k->summed.at[i])] = true;
    for (size_t r = 0; r < j->rows; r++)
        to[r] = summed[r] ? (qdot_alike_place){QDOT_ALIKE_ORDERS, orders++} : (qdot_alike_place){QDOT_ALIKE_NEWEST, newest++};
    for (size_t i = 0; i < n; i++)
        move_rows_of_step(j, to, k->steps.at + i);
    for (size_t i = 0; i < k->input.n; i++)
        move_row(j, to, k->input.at + i);
    for (size_t i = 0; i < k->results.n; i++)
        move_row(j, to, &k->results.at[i].place);
    for (size_t i = 1; i < k->summed.n; i += 2)
        move_row(j, to, k->summed.at + i);
    k->orders = orders;
    k->newest = newest;
    k->convolutions = 0;
    for (size_t i = 0; i < n; i++) {
        k->convolutions += convolutions_of(k->steps.at + i);
        k->steps.at[i].partial = (uint32_t)k->partials;
        k->partials += partial_sums_of(k->steps.at + i);
    }
}

qdot_status
qdot_alike_join(qdot_alike_kind *k)
{
    joiner j = {.kind = k, .rows = k->orders + k->newest};
    power *known = qdot_calloc(j.rows + 1, sizeof *known);
    size_t *of_powers = qdot_calloc(j.rows + 1, sizeof *of_powers);
    bool *summed = qdot_calloc(j.rows + 1, sizeof *summed);
    qdot_alike_place *to = qdot_calloc(j.rows + 1, sizeof *to);
    qdot_status status = QDOT_ENOMEM;

    j.writer = qdot_malloc((j.rows + 1) * sizeof *j.writer);
    j.reads = qdot_calloc(j.rows + 1, sizeof *j.reads);
    j.removed = qdot_calloc(k->steps.n + 1, sizeof *j.removed);
    if (known && of_powers && summed && to && j.writer && j.reads && j.removed) {
        memset(j.writer, 0xff, (j.rows + 1) * sizeof *j.writer);
        find_writers_and_reads(&j);
        join_powers(&j, known, of_powers);
        join_squares(&j);
        join_products(&j);
        place_rows_anew(&j, summed, to);
        status = QDOT_OK;
    }
    qdot_free(known);
    qdot_free(of_powers);
    qdot_free(summed);
    qdot_free(to);
    qdot_free(j.writer);
    qdot_free(j.reads);
    qdot_free(j.removed);
    return status;
}
