/* lanes-writer.c -- addresses of coefficients, register allocation, and sums in registers, for generated code. */
#include <string.h>

#include "series/lanes-writer.h"

/* --- places of coefficients --------------------------------------------------------- */

static bool
is_program_row(const qdot_lanes_writer *w, qdot_lanes_row row)
{
    return row < w->t->rows.n;
}

/* Whether a is the coefficient of the present (newest) order of a row of the program. */
static bool
is_newest_coefficient(const qdot_lanes_writer *w, qdot_lanes_at a)
{
    return a.order == w->k + w->t->rows.at[a.row].lead;
}

/* Whether a coefficient of a row is known to be 0 and never written, or is left out. */
static bool
coefficient_is_zero(const qdot_lanes_writer *w, qdot_lanes_at a)
{
    return is_program_row(w, a.row) && a.order > 0 &&
           (!w->rows[a.row].moving || (w->rows[a.row].absent && is_newest_coefficient(w, a)));
}

void
qdot_lanes_keep(qdot_lanes_writer *w, qdot_lanes_row row)
{
    w->rows[row].kept = true;
}

size_t
qdot_writer_groups(const qdot_lanes_writer *w)
{
    return w->numbers + QDOT_WRITER_RESTS * w->t->length +
           w->sums * (size_t)(w->block - 1);
}

static qdot_operand
operand_at_groups(const qdot_lanes_writer *w, qdot_asm_base base, size_t groups)
{
    return qdot_asm_at(base, (int32_t)groups * w->bytes);
}

/* The groups of all coefficients of the program, `groups` in number, at an order. */
static qdot_operand
operand_of_order(const qdot_lanes_writer *w, size_t groups, int order)
{
    const int any = w->any, half = any / 2;

    if (order > half + half / 2)
        return operand_at_groups(w, QDOT_ASM_ROWS_NOW, groups + (size_t)order - (size_t)any);
    if (order > half / 2) /* terms of a square reach only up to half of the order */
        return operand_at_groups(w, QDOT_ASM_ROWS_HALF, groups + (size_t)order - (size_t)half);
    return operand_at_groups(w, QDOT_ASM_ROWS, groups + (size_t)order);
}

qdot_operand
qdot_writer_place(qdot_lanes_writer *w, qdot_lanes_at a)
{
    int order;

    if (a.row >= QDOT_WRITER_TABLES) {
        const int32_t table = (int32_t)(a.row - QDOT_WRITER_TABLES) * QDOT_WRITER_TABLE;
        const bool any = a.order > QDOT_WRITER_ANY / 2;

        return qdot_asm_at(any ? QDOT_ASM_CONSTANTS_NOW : QDOT_ASM_CONSTANTS,
                           (int32_t)sizeof(double) *
                               (table + a.order - (any ? w->any : 0)));
    }
    if (a.row >= QDOT_WRITER_SCALARS)
        return qdot_asm_at(QDOT_ASM_CONSTANTS,
                           (int32_t)sizeof(double) *
                               (QDOT_WRITER_MOST_TABLES * QDOT_WRITER_TABLE +
                                (int32_t)(a.row - QDOT_WRITER_SCALARS)));
    if (a.row >= QDOT_WRITER_INVERSES)
        return operand_at_groups(w, QDOT_ASM_ROWS,
                                 w->t->rows.n * w->at.stride + a.row - QDOT_WRITER_INVERSES);
    if (a.row >= QDOT_WRITER_NUMBERS)
        return operand_at_groups(w, QDOT_ASM_WORK, a.row - QDOT_WRITER_NUMBERS);
    if (a.order > 0 && !is_newest_coefficient(w, a))
        w->rows[a.row].kept = true;
    order = a.order > 0 && !w->rows[a.row].kept ? 1 : a.order;
    return operand_of_order(w, a.row * w->at.stride, order);
}

qdot_lanes_at
qdot_lanes_number(const qdot_lanes_writer *w, size_t i)
{
    (void)w;
    return (qdot_lanes_at){QDOT_WRITER_NUMBERS + (qdot_lanes_row)i, 0};
}

qdot_lanes_at
qdot_lanes_rate(const qdot_lanes_writer *w, bool twice, int lead)
{
    return qdot_lanes_number(w, (size_t)(twice * QDOT_LANES_LEADS + lead));
}

bool
qdot_lanes_wants_rate(const qdot_lanes_writer *w, bool twice, int lead)
{
    return w->rates >> (twice * QDOT_LANES_LEADS + lead) & 1;
}

qdot_lanes_at
qdot_lanes_scalar(qdot_lanes_writer *w, double value)
{
    size_t i = w->scalars.n;

    while (i > 0 && memcmp(w->scalars.at + i - 1, &value, sizeof value) != 0)
        i--;
    if (i == 0 && w->status == QDOT_OK)
        w->status = qdot_vec_push(&w->scalars, value);
    return (qdot_lanes_at){
        QDOT_WRITER_SCALARS + (qdot_lanes_row)(i > 0 ? i - 1 : w->scalars.n - 1), 0};
}

qdot_lanes_at
qdot_lanes_scalar_of(qdot_lanes_writer *w, qdot_lanes_by_order *f, int k)
{
    size_t i = 0;

    while (i < w->tables.n && w->tables.at[i] != f)
        i++;
    if (i == w->tables.n && w->status == QDOT_OK)
        w->status = i < QDOT_WRITER_MOST_TABLES
                        ? qdot_vec_push(&w->tables, f)
                        : qdot_fail(QDOT_EINVAL, "too many tables by order");
    return (qdot_lanes_at){QDOT_WRITER_TABLES + (qdot_lanes_row)i, k};
}

/* --- allocation of registers -------------------------------------------------------- */

void
qdot_writer_emit(qdot_lanes_writer *w, qdot_asm_operation name, int reg, int first,
                 qdot_operand rm)
{
    if (!w->counting)
        qdot_asm_do(&w->m, name, w->at.group == 1 ? QDOT_ASM_ONE : QDOT_ASM_ALL, reg,
                    first, rm);
}

static void
store_if_newer(qdot_lanes_writer *w, int reg)
{
    if (w->reg[reg].ahead)
        qdot_writer_emit(w, QDOT_ASM_STORE, reg, 0, qdot_writer_place(w, w->reg[reg].at));
    w->reg[reg].ahead = false;
}

void
qdot_writer_settle(qdot_lanes_writer *w)
{
    for (int r = 0; r < w->registers; r++) {
        qdot_writer_register *reg = w->reg + r;

        if (reg->ahead && is_program_row(w, reg->at.row) && !w->rows[reg->at.row].kept)
            reg->holds = reg->ahead = false;
        store_if_newer(w, r);
    }
}

static void
release_register(qdot_lanes_writer *w, int reg)
{
    store_if_newer(w, reg);
    w->reg[reg].holds = false;
}

void
qdot_writer_leave(qdot_lanes_writer *w, int end)
{
    for (int r = 0; r < end; r++)
        release_register(w, r);
}

/* The least recently used register from `lowest` on that is not reserved; its content is stored if necessary. */
static int
free_least_used_register(qdot_lanes_writer *w, int lowest)
{
    const int reg = qdot_asm_fresh(&w->m, lowest, w->registers);

    release_register(w, reg);
    return reg;
}

/* The first register that an order may use: only the first order of a block calls code that uses
 * earlier ones. */
static int
first_usable_register(const qdot_lanes_writer *w)
{
    return w->phase > 0 ? 0 : w->first_free;
}

int
qdot_writer_take(qdot_lanes_writer *w)
{
    const int reg = free_least_used_register(w, first_usable_register(w));

    w->m.taken[reg] = true;
    return reg;
}

static int
find_register_with(const qdot_lanes_writer *w, qdot_lanes_at a)
{
    for (int r = 0; r < w->registers; r++)
        if (w->reg[r].holds && w->reg[r].at.row == a.row && w->reg[r].at.order == a.order)
            return r;
    return -1;
}

static void
load_from_memory(qdot_lanes_writer *w, int reg, qdot_lanes_at a)
{
    qdot_writer_emit(w, a.row >= QDOT_WRITER_SCALARS ? QDOT_ASM_SPREAD : QDOT_ASM_LOAD,
                     reg, 0, qdot_writer_place(w, a));
}

static int
load_into_register(qdot_lanes_writer *w, qdot_lanes_at a)
{
    int reg = find_register_with(w, a);

    if (reg >= 0) {
        qdot_asm_use(&w->m, reg);
        return reg;
    }
    reg = free_least_used_register(w, 0);
    load_from_memory(w, reg, a);
    w->reg[reg].holds = true;
    w->reg[reg].at = a;
    return reg;
}

/* The operand for coefficient `a` in an instruction: the register that holds it, or its address in memory. */
static qdot_operand
find_operand(qdot_lanes_writer *w, qdot_lanes_at a)
{
    if (a.row < QDOT_WRITER_SCALARS && find_register_with(w, a) < 0)
        return qdot_writer_place(w, a);
    return qdot_asm_in(load_into_register(w, a));
}

void
qdot_writer_clear(qdot_lanes_writer *w, int reg)
{
    if (!w->counting)
        qdot_asm_clear(&w->m, reg);
}

/* --- sums in registers -------------------------------------------------------------- */

qdot_lanes_sum
qdot_lanes_continue(qdot_lanes_writer *w, qdot_lanes_at a)
{
    const int held = find_register_with(w, a);
    int reg = held;

    if (held < first_usable_register(w) || w->reg[held].ahead) {
        if (held >= 0)
            qdot_asm_use(&w->m, held);
        reg = free_least_used_register(w, first_usable_register(w));
        if (held >= 0)
            qdot_writer_emit(w, QDOT_ASM_LOAD, reg, 0, qdot_asm_in(held));
        else
            load_from_memory(w, reg, a);
    }
    w->reg[reg].holds = false;
    w->m.taken[reg] = true;
    qdot_asm_use(&w->m, reg);
    return reg;
}

qdot_lanes_sum
qdot_lanes_continue_last(qdot_lanes_writer *w, qdot_lanes_at a)
{
    const int held = find_register_with(w, a);

    if (held >= 0)
        w->reg[held].ahead = false;
    return qdot_lanes_continue(w, a);
}

void
qdot_lanes_add(qdot_lanes_writer *w, qdot_lanes_sum *sum, bool minus, qdot_lanes_at a)
{
    qdot_operand rm;

    if (coefficient_is_zero(w, a))
        return;
    rm = find_operand(w, a);
    if (*sum == QDOT_LANES_NOTHING) {
        *sum = qdot_writer_take(w);
        if (!minus) {
            qdot_writer_emit(w, QDOT_ASM_LOAD, *sum, 0, rm);
            return;
        }
        qdot_writer_clear(w, *sum);
    }
    qdot_writer_emit(w, minus ? QDOT_ASM_SUB : QDOT_ASM_ADD, *sum, *sum, rm);
}

void
qdot_lanes_take_from(qdot_lanes_writer *w, qdot_lanes_sum *sum, qdot_lanes_at a)
{
    if (*sum == QDOT_LANES_NOTHING)
        qdot_lanes_add(w, sum, false, a);
    else if (coefficient_is_zero(w, a))
        qdot_lanes_negate(w, sum);
    else
        qdot_writer_emit(w, QDOT_ASM_SUB, *sum, load_into_register(w, a), qdot_asm_in(*sum));
}

void
qdot_lanes_add_product(qdot_lanes_writer *w, qdot_lanes_sum *sum, bool minus,
                       qdot_lanes_at a, qdot_lanes_at b)
{
    bool passing;
    int reg;
    qdot_operand rm;

    if (coefficient_is_zero(w, a) || coefficient_is_zero(w, b))
        return;
    if (find_register_with(w, a) < 0 && find_register_with(w, b) >= 0) {
        const qdot_lanes_at other = a;

        a = b;
        b = other;
    }
    passing = is_program_row(w, a.row) && !is_newest_coefficient(w, a) && find_register_with(w, a) < 0;
    reg = load_into_register(w, a);
    rm = find_operand(w, b);
    if (passing)
        w->m.used[reg] = 0;
    if (*sum == QDOT_LANES_NOTHING) {
        *sum = qdot_writer_take(w);
        if (!minus) {
            qdot_writer_emit(w, QDOT_ASM_MUL, *sum, reg, rm);
            return;
        }
        qdot_writer_clear(w, *sum);
    }
    qdot_writer_emit(w, minus ? QDOT_ASM_NMADD : QDOT_ASM_MADD, *sum, reg, rm);
}

void
qdot_lanes_scale(qdot_lanes_writer *w, qdot_lanes_sum *sum, qdot_lanes_at a)
{
    if (*sum == QDOT_LANES_NOTHING)
        return;
    if (coefficient_is_zero(w, a)) {
        w->m.taken[*sum] = false;
        *sum = QDOT_LANES_NOTHING;
        return;
    }
    qdot_writer_emit(w, QDOT_ASM_MUL, *sum, *sum, find_operand(w, a));
}

void
qdot_lanes_negate(qdot_lanes_writer *w, qdot_lanes_sum *sum)
{
    if (*sum == QDOT_LANES_NOTHING)
        return;
    qdot_writer_clear(w, w->moment);
    qdot_writer_emit(w, QDOT_ASM_SUB, *sum, w->moment, qdot_asm_in(*sum));
}

void
qdot_writer_join(qdot_lanes_writer *w, qdot_asm_operation op, qdot_lanes_sum *sum,
                 qdot_lanes_sum other)
{
    if (other == QDOT_LANES_NOTHING)
        return;
    w->m.taken[other] = false;
    if (*sum != QDOT_LANES_NOTHING) {
        qdot_writer_emit(w, op, *sum, *sum, qdot_asm_in(other));
    } else if (op != QDOT_ASM_MUL) {
        *sum = other;
        w->m.taken[other] = true;
        if (op == QDOT_ASM_SUB)
            qdot_lanes_negate(w, sum);
    }
}

void
qdot_lanes_unread(qdot_lanes_writer *w, qdot_lanes_at a)
{
    const int reg = find_register_with(w, a);

    if (reg < 0)
        return;
    w->reg[reg] = (qdot_writer_register){0};
    w->m.used[reg] = 0;
}

void
qdot_writer_put(qdot_lanes_writer *w, int reg, qdot_lanes_at to)
{
    qdot_lanes_unread(w, to);
    qdot_writer_emit(w, QDOT_ASM_STORE, reg, 0, qdot_writer_place(w, to));
}

void
qdot_lanes_store(qdot_lanes_writer *w, qdot_lanes_sum sum, qdot_lanes_at to)
{
    if (sum == QDOT_LANES_NOTHING) {
        sum = qdot_writer_take(w);
        qdot_writer_clear(w, sum);
    }
    qdot_lanes_unread(w, to);
    (void)qdot_writer_place(w, to); /* make sure that the coefficient has a place in memory */
    if (is_program_row(w, to.row))
        w->rows[to.row].absent = false;
    w->m.taken[sum] = false;
    w->reg[sum].holds = w->reg[sum].ahead = true;
    w->reg[sum].at = to;
    qdot_asm_use(&w->m, sum);
}
