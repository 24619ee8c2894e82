/* lanes-writer.c -- places of coefficients, registers, operations on an accumulator. */
#include <string.h>

#include "series/lanes-writer.h"

/* --- places ------------------------------------------------------------------------- */

static bool
is_row(const qdot_lanes_writer *w, qdot_lanes_row row)
{
    return row < w->t->rows.n;
}

/* The order at hand of a row of the program. */
static bool
is_newest(const qdot_lanes_writer *w, qdot_lanes_at a)
{
    return a.order == w->k + w->t->rows.at[a.row].lead;
}

/* A coefficient of a row is 0 and nothing writes it, or left out. */
static bool
vanishes(const qdot_lanes_writer *w, qdot_lanes_at a)
{
    return is_row(w, a.row) && a.order > 0 &&
           (!w->rows[a.row].moving || (w->rows[a.row].absent && is_newest(w, a)));
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

static qdot_x86_rm
groups_from(const qdot_lanes_writer *w, qdot_x86_base base, size_t groups)
{
    return qdot_x86_at(base, (int32_t)groups * w->bytes);
}

/* `groups` of the program's coefficients, at an order. */
static qdot_x86_rm
of_order(const qdot_lanes_writer *w, size_t groups, int order)
{
    const int any = w->any, half = any / 2;

    if (order > half + half / 2)
        return groups_from(w, QDOT_X86_R9, groups + (size_t)order - (size_t)any);
    if (order > half / 2) /* squares */
        return groups_from(w, QDOT_X86_RBP, groups + (size_t)order - (size_t)half);
    return groups_from(w, QDOT_X86_RDI, groups + (size_t)order);
}

qdot_x86_rm
qdot_writer_place(qdot_lanes_writer *w, qdot_lanes_at a)
{
    int order;

    if (a.row >= QDOT_WRITER_TABLES) {
        const int32_t table = (int32_t)(a.row - QDOT_WRITER_TABLES) * QDOT_WRITER_TABLE;
        const bool any = a.order > QDOT_WRITER_ANY / 2;

        return qdot_x86_at(any ? QDOT_X86_RBX : QDOT_X86_RSI,
                           (int32_t)sizeof(double) *
                               (table + a.order - (any ? w->any : 0)));
    }
    if (a.row >= QDOT_WRITER_SCALARS)
        return qdot_x86_at(QDOT_X86_RSI,
                           (int32_t)sizeof(double) *
                               (QDOT_WRITER_MOST_TABLES * QDOT_WRITER_TABLE +
                                (int32_t)(a.row - QDOT_WRITER_SCALARS)));
    if (a.row >= QDOT_WRITER_INVERSES)
        return groups_from(w, QDOT_X86_RDI,
                           w->t->rows.n * w->at.stride + a.row - QDOT_WRITER_INVERSES);
    if (a.row >= QDOT_WRITER_NUMBERS)
        return groups_from(w, QDOT_X86_RDX, a.row - QDOT_WRITER_NUMBERS);
    if (a.order > 0 && !is_newest(w, a))
        w->rows[a.row].kept = true;
    order = a.order > 0 && !w->rows[a.row].kept ? 1 : a.order;
    return of_order(w, a.row * w->at.stride, order);
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

/* --- registers ---------------------------------------------------------------------- */

/* That of one double. */
static qdot_x86_name
of_one(qdot_x86_name name, qdot_x86_rm rm)
{
    switch (name) {
    case QDOT_X86_LOAD_ALL: return rm.memory ? QDOT_X86_LOAD : name;
    case QDOT_X86_SPREAD: return QDOT_X86_LOAD;
    case QDOT_X86_STORE_ALL: return QDOT_X86_STORE;
    case QDOT_X86_ADD_ALL: return QDOT_X86_ADD;
    case QDOT_X86_SUB_ALL: return QDOT_X86_SUB;
    case QDOT_X86_MUL_ALL: return QDOT_X86_MUL;
    case QDOT_X86_MADD_ALL: return QDOT_X86_MADD;
    case QDOT_X86_NMADD_ALL: return QDOT_X86_NMADD;
    default: return name;
    }
}

void
qdot_writer_emit(qdot_lanes_writer *w, qdot_x86_name name, int reg, int first,
                 qdot_x86_rm rm)
{
    if (!w->counting)
        qdot_x86_emit(&w->x, w->at.group == 1 ? of_one(name, rm) : name, reg, first, rm);
}

static void
use(qdot_lanes_writer *w, int reg)
{
    w->reg[reg].used = ++w->clock;
}

static void
settle(qdot_lanes_writer *w, int reg)
{
    if (w->reg[reg].ahead)
        qdot_writer_emit(w, QDOT_X86_STORE_ALL, reg, 0,
                         qdot_writer_place(w, w->reg[reg].at));
    w->reg[reg].ahead = false;
}

void
qdot_writer_settle(qdot_lanes_writer *w)
{
    for (int r = 0; r < w->registers; r++) {
        qdot_writer_register *reg = w->reg + r;

        if (reg->ahead && is_row(w, reg->at.row) && !w->rows[reg->at.row].kept)
            reg->holds = reg->ahead = false;
        settle(w, r);
    }
}

static void
leave(qdot_lanes_writer *w, int reg)
{
    settle(w, reg);
    w->reg[reg].holds = false;
}

void
qdot_writer_leave(qdot_lanes_writer *w, int end)
{
    for (int r = 0; r < end; r++)
        leave(w, r);
}

/* The least recently used from `lowest` on that is not taken. */
static int
fresh(qdot_lanes_writer *w, int lowest)
{
    int best = -1;

    for (int r = lowest; r < w->registers; r++)
        if (r != w->moment && !w->reg[r].taken &&
            (best < 0 || w->reg[r].used < w->reg[best].used))
            best = r;
    leave(w, best);
    use(w, best);
    return best;
}

/* Sequences of terms are called by the first order of a block alone. */
static int
first_taken(const qdot_lanes_writer *w)
{
    return w->phase > 0 ? 0 : w->first_free;
}

int
qdot_writer_take(qdot_lanes_writer *w)
{
    const int reg = fresh(w, first_taken(w));

    w->reg[reg].taken = true;
    return reg;
}

static int
holder(const qdot_lanes_writer *w, qdot_lanes_at a)
{
    for (int r = 0; r < w->registers; r++)
        if (w->reg[r].holds && w->reg[r].at.row == a.row && w->reg[r].at.order == a.order)
            return r;
    return -1;
}

static void
fetch(qdot_lanes_writer *w, int reg, qdot_lanes_at a)
{
    qdot_writer_emit(w,
                     a.row >= QDOT_WRITER_SCALARS ? QDOT_X86_SPREAD : QDOT_X86_LOAD_ALL,
                     reg, 0, qdot_writer_place(w, a));
}

static int
load(qdot_lanes_writer *w, qdot_lanes_at a)
{
    int reg = holder(w, a);

    if (reg >= 0) {
        use(w, reg);
        return reg;
    }
    reg = fresh(w, 0);
    fetch(w, reg, a);
    w->reg[reg].holds = true;
    w->reg[reg].at = a;
    return reg;
}

/* A register that holds it, or its place. */
static qdot_x86_rm
operand(qdot_lanes_writer *w, qdot_lanes_at a)
{
    if (a.row < QDOT_WRITER_SCALARS && holder(w, a) < 0)
        return qdot_writer_place(w, a);
    return qdot_x86_reg(load(w, a));
}

/* 0, whatever the width: of one with itself, which takes no time. */
void
qdot_writer_clear(qdot_lanes_writer *w, int reg)
{
    const bool narrow = w->x.narrow;

    w->x.narrow = narrow || reg < 16;
    qdot_writer_emit(w, QDOT_X86_XOR_ALL, reg, reg, qdot_x86_reg(reg));
    w->x.narrow = narrow;
}

/* --- sums --------------------------------------------------------------------------- */

qdot_lanes_sum
qdot_lanes_continue(qdot_lanes_writer *w, qdot_lanes_at a)
{
    const int held = holder(w, a);
    int reg = held;

    if (held < first_taken(w) || w->reg[held].ahead) {
        if (held >= 0)
            use(w, held);
        reg = fresh(w, first_taken(w));
        if (held >= 0)
            qdot_writer_emit(w, QDOT_X86_LOAD_ALL, reg, 0, qdot_x86_reg(held));
        else
            fetch(w, reg, a);
    }
    w->reg[reg].holds = false;
    w->reg[reg].taken = true;
    use(w, reg);
    return reg;
}

qdot_lanes_sum
qdot_lanes_continue_last(qdot_lanes_writer *w, qdot_lanes_at a)
{
    const int held = holder(w, a);

    if (held >= 0)
        w->reg[held].ahead = false;
    return qdot_lanes_continue(w, a);
}

void
qdot_lanes_add(qdot_lanes_writer *w, qdot_lanes_sum *sum, bool minus, qdot_lanes_at a)
{
    qdot_x86_rm rm;

    if (vanishes(w, a))
        return;
    rm = operand(w, a);
    if (*sum == QDOT_LANES_NOTHING) {
        *sum = qdot_writer_take(w);
        if (!minus) {
            qdot_writer_emit(w, QDOT_X86_LOAD_ALL, *sum, 0, rm);
            return;
        }
        qdot_writer_clear(w, *sum);
    }
    qdot_writer_emit(w, minus ? QDOT_X86_SUB_ALL : QDOT_X86_ADD_ALL, *sum, *sum, rm);
}

void
qdot_lanes_take_from(qdot_lanes_writer *w, qdot_lanes_sum *sum, qdot_lanes_at a)
{
    if (*sum == QDOT_LANES_NOTHING)
        qdot_lanes_add(w, sum, false, a);
    else if (vanishes(w, a))
        qdot_lanes_negate(w, sum);
    else
        qdot_writer_emit(w, QDOT_X86_SUB_ALL, *sum, load(w, a), qdot_x86_reg(*sum));
}

void
qdot_lanes_add_product(qdot_lanes_writer *w, qdot_lanes_sum *sum, bool minus,
                       qdot_lanes_at a, qdot_lanes_at b)
{
    bool passing;
    int reg;
    qdot_x86_rm rm;

    if (vanishes(w, a) || vanishes(w, b))
        return;
    if (holder(w, a) < 0 && holder(w, b) >= 0) {
        const qdot_lanes_at other = a;

        a = b;
        b = other;
    }
    passing = is_row(w, a.row) && !is_newest(w, a) && holder(w, a) < 0;
    reg = load(w, a);
    rm = operand(w, b);
    if (passing)
        w->reg[reg].used = 0;
    if (*sum == QDOT_LANES_NOTHING) {
        *sum = qdot_writer_take(w);
        if (!minus) {
            qdot_writer_emit(w, QDOT_X86_MUL_ALL, *sum, reg, rm);
            return;
        }
        qdot_writer_clear(w, *sum);
    }
    qdot_writer_emit(w, minus ? QDOT_X86_NMADD_ALL : QDOT_X86_MADD_ALL, *sum, reg, rm);
}

void
qdot_lanes_scale(qdot_lanes_writer *w, qdot_lanes_sum *sum, qdot_lanes_at a)
{
    if (*sum == QDOT_LANES_NOTHING)
        return;
    if (vanishes(w, a)) {
        w->reg[*sum].taken = false;
        *sum = QDOT_LANES_NOTHING;
        return;
    }
    qdot_writer_emit(w, QDOT_X86_MUL_ALL, *sum, *sum, operand(w, a));
}

void
qdot_lanes_negate(qdot_lanes_writer *w, qdot_lanes_sum *sum)
{
    if (*sum == QDOT_LANES_NOTHING)
        return;
    qdot_writer_clear(w, w->moment);
    qdot_writer_emit(w, QDOT_X86_SUB_ALL, *sum, w->moment, qdot_x86_reg(*sum));
}

void
qdot_writer_join(qdot_lanes_writer *w, qdot_x86_name op, qdot_lanes_sum *sum,
                 qdot_lanes_sum other)
{
    if (other == QDOT_LANES_NOTHING)
        return;
    w->reg[other].taken = false;
    if (*sum != QDOT_LANES_NOTHING) {
        qdot_writer_emit(w, op, *sum, *sum, qdot_x86_reg(other));
    } else if (op != QDOT_X86_MUL_ALL) {
        *sum = other;
        w->reg[other].taken = true;
        if (op == QDOT_X86_SUB_ALL)
            qdot_lanes_negate(w, sum);
    }
}

void
qdot_lanes_unread(qdot_lanes_writer *w, qdot_lanes_at a)
{
    const int reg = holder(w, a);

    if (reg >= 0)
        w->reg[reg] = (qdot_writer_register){.taken = w->reg[reg].taken};
}

void
qdot_writer_put(qdot_lanes_writer *w, int reg, qdot_lanes_at to)
{
    qdot_lanes_unread(w, to);
    qdot_writer_emit(w, QDOT_X86_STORE_ALL, reg, 0, qdot_writer_place(w, to));
}

void
qdot_lanes_store(qdot_lanes_writer *w, qdot_lanes_sum sum, qdot_lanes_at to)
{
    if (sum == QDOT_LANES_NOTHING) {
        sum = qdot_writer_take(w);
        qdot_writer_clear(w, sum);
    }
    qdot_lanes_unread(w, to);
    (void)qdot_writer_place(w, to); /* that it is there */
    if (is_row(w, to.row))
        w->rows[to.row].absent = false;
    w->reg[sum].taken = false;
    w->reg[sum].holds = w->reg[sum].ahead = true;
    w->reg[sum].at = to;
    use(w, sum);
}
