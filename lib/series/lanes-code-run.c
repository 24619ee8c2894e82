/* lanes-code-run.c -- makes and runs machine code for Taylor series in vector lanes: memory, addresses, passes. */
#include "series/lanes-code.h"

#include <string.h>

#include "series/lanes-writer.h"
#include "series/recurrence-operations.h"
#include "series/taylor-text.h"

enum {
    /* in bytes; longer code would no longer be in the cache when it is needed */
    most_bytes = 1 << 19,
    /* Orders of a block, and registers of sums that a sequence of terms makes: those of one
     * product or of two, each in chains that do not wait for each other. Behind them one for
     * a moment, windows of coefficients (lanes-sums.c), and those that are always free; all but
     * that for a moment hold what was loaded, and in orders that call no sequence results. */
    block = 4,
    chains = 8
};

typedef void kernel(double *coefficients, const double *scalars, double *work);

struct qdot_lanes_code {
    qdot_taylor_text *text;
    size_t entry;
    bool halves; /* whether the code runs twice, once for each half of a group of lanes */
    size_t group;
    double *coefficients; /* the Taylor coefficients on which the code works; borrowed */
    double *scalars;
    double *allocated, *work;
};

/* --- loops over orders -------------------------------------------------------------- */

/* Write code that sets the address registers for order k, or (further) for the next pass of the loop over orders. */
static void
write_address_update(qdot_lanes_writer *w, bool further, int k)
{
    const struct {
        qdot_asm_base now, from;
        int bytes, orders;
    } rows[] = {{QDOT_ASM_ROWS_NOW, QDOT_ASM_ROWS, w->bytes, 1},
                {QDOT_ASM_CONSTANTS_NOW, QDOT_ASM_CONSTANTS, sizeof(double), 1},
                {QDOT_ASM_ROWS_HALF, QDOT_ASM_ROWS, w->bytes, 2}};
    const struct {
        qdot_asm_base now;
        const size_t *terms;
        int orders;
    } sums[] = {{QDOT_ASM_TERMS, w->dot, 1},
                {QDOT_ASM_TERMS_OF_PAIRS, w->pair, 1},
                {QDOT_ASM_TERMS_OF_SQUARES, w->half, 2}};

    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        qdot_asm_set(&w->m, rows[i].now, further ? rows[i].now : rows[i].from,
                     k / rows[i].orders * rows[i].bytes);
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++)
        if (further)
            qdot_asm_set(&w->m, sums[i].now, sums[i].now,
                         -k / sums[i].orders *
                             (int32_t)qdot_writer_term(w, sums[i].terms));
        else
            qdot_asm_set_code(&w->m, sums[i].now,
                              sums[i].terms[(k - 1) / sums[i].orders]);
}

/* Write one order of a block, from `first` on, or the same order of a block so many blocks earlier. */
static void
write_code_of_order(qdot_lanes_writer *w, int k, int from, int first, qdot_lanes_write_order *write,
                    void *user)
{
    const int phase = (k - first) % w->block + (k < first ? w->block : 0);

    w->phase = phase % w->block;
    if (w->phase > k - from)
        w->phase = k - from;
    write(w, k, user);
}

/* The order from which on no product in a block of orders has both of its coefficients in that block. */
static int
least_order_of_loop(const qdot_lanes_writer *w, int late)
{
    for (size_t i = w->t->still; i < w->t->length; i++)
        if (qdot_recurrence_find(w->t->steps.at[i].op, QDOT_DO_SQUARED))
            return 2 * w->block + late;
    return w->block + late;
}

void
qdot_lanes_orders(qdot_lanes_writer *w, int from, int late, int loop, int to,
                  qdot_lanes_write_order *write, void *user)
{
    const int least = least_order_of_loop(w, late) > loop ? least_order_of_loop(w, late) : loop;
    const int blocks = to >= least ? (to - least + 1) / w->block : 0;
    const int first = to + 1 - blocks * w->block;
    size_t start = 0;

    for (int k = from; k < first; k++)
        write_code_of_order(w, k, from, first, write, user);
    if (blocks == 0)
        return;
    qdot_writer_leave(w, w->registers);
    if (!w->counting) {
        write_address_update(w, false, first);
        start = qdot_asm_repeat(&w->m, blocks);
    }
    w->any = QDOT_WRITER_ANY + first % w->block;
    for (int i = 0; i < w->block; i++)
        write_code_of_order(w, w->any + i, from, w->any, write, user);
    qdot_writer_leave(w, w->registers);
    if (!w->counting) {
        write_address_update(w, true, w->block);
        qdot_asm_again(&w->m, start);
    }
}

/* --- writing all code --------------------------------------------------------------- */

static void
choose_rows_to_keep(qdot_lanes_writer *w)
{
    const qdot_program *t = w->t;

    for (size_t i = 0; i < t->rows.n; i++)
        w->rows[i] = (qdot_writer_row){.moving = i < t->moving ||
                                                 t->rows.at[i].source == QDOT_ROW_UNKNOWN,
                                       .kept = i < t->moving,
                                       .step = SIZE_MAX};
    for (size_t i = t->still; i < t->length; i++) {
        const qdot_program_step *s = t->steps.at + i;
        const qdot_program_row rows[] = {s->to, s->second, s->third, s->d};

        for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
            if (rows[r] != QDOT_NO_ROW)
                w->rows[rows[r]].moving = true;
        /* keep these rows, because the step length depends on their coefficients (near.h) */
        if (qdot_recurrence_exponential(s->op) > 0 || qdot_recurrence_divisor(s->op))
            for (size_t r = 0; r < 4; r++)
                w->rows[(qdot_program_row[]){s->x, s->y, s->z, s->to}[r]].kept = true;
    }
}

/* Write all of the code. In the second pass it is known where rows are stored; the code for sums comes first. */
static void
write_complete_code(qdot_lanes_writer *w, bool counting, qdot_lanes_write *write, void *user,
                    size_t *entry)
{
    w->counting = counting;
    w->k = 0;
    w->any = QDOT_WRITER_ANY;
    w->phase = 0;
    if (w->ahead.n > 0)
        memset(w->ahead.at, 0, w->ahead.n * sizeof *w->ahead.at);
    memset(w->reg, 0, sizeof w->reg);
    memset(w->m.used, 0, sizeof w->m.used);
    memset(w->m.taken, 0, sizeof w->m.taken);
    w->m.taken[w->moment] = true;
    if (!counting) {
        qdot_writer_terms(w, w->windows, 1, w->dot);
        qdot_writer_terms(w, w->windows, 2, w->pair);
        qdot_writer_terms(w, false, 1, w->half);
    }
    *entry = w->m.bytes.n;
    qdot_asm_save(&w->m);
    write(w, user);
    qdot_writer_leave(w, w->registers);
    qdot_asm_restore(&w->m);
    qdot_asm_return(&w->m);
    if (counting)
        w->m.bytes.n = 0;
}

static qdot_status
allocate_memory(qdot_lanes_code *c, const qdot_lanes_writer *w)
{
    const size_t tables = (size_t)QDOT_WRITER_MOST_TABLES * QDOT_WRITER_TABLE;

    c->coefficients = w->at.coefficients;
    c->group = w->at.group;
    c->halves = c->group > (size_t)qdot_asm_lanes(&w->m);
    c->scalars = qdot_calloc(tables + w->scalars.n, sizeof *c->scalars);
    c->allocated =
        qdot_calloc((qdot_writer_groups(w) + 1) * c->group, sizeof *c->allocated);
    if (!c->scalars || !c->allocated)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < w->tables.n; i++)
        for (int k = 1; k < QDOT_WRITER_TABLE; k++)
            c->scalars[i * QDOT_WRITER_TABLE + (size_t)k] = w->tables.at[i](k);
    if (w->scalars.n > 0)
        memcpy(c->scalars + tables, w->scalars.at, w->scalars.n * sizeof *c->scalars);
    c->work = c->allocated;
    while ((uintptr_t)c->work % (size_t)w->bytes != 0)
        c->work++;
    return QDOT_OK;
}

/* Generate the machine code; *code is NULL if the code would be too long, or the system does not let it be run. */
static qdot_status
build_code(qdot_lanes_writer *w, qdot_lanes_write *write, void *user, qdot_lanes_code **code)
{
    qdot_lanes_code *c = qdot_calloc(1, sizeof *c);
    qdot_status status = QDOT_ENOMEM;
    bool runs = false;

    w->rows = qdot_calloc(w->t->rows.n + 1, sizeof *w->rows);
    w->steps = qdot_calloc(w->t->length + 1, sizeof *w->steps);
    if (c)
        c->text = qdot_calloc(1, sizeof *c->text);
    if (c && c->text && w->rows && w->steps) {
        atomic_init(&c->text->users, 1);
        choose_rows_to_keep(w);
        write_complete_code(w, true, write, user, &c->entry);
        write_complete_code(w, false, write, user, &c->entry);
        status = w->status != QDOT_OK ? w->status : w->m.status;
    }
    if (status == QDOT_OK && w->m.bytes.n <= most_bytes) {
        runs = qdot_taylor_text_fill(c->text, w->m.bytes.at, w->m.bytes.n);
        status = allocate_memory(c, w);
    }
    if (status == QDOT_OK && runs) {
        *code = c;
        return QDOT_OK;
    }
    qdot_lanes_code_free(c);
    return status;
}

bool
qdot_lanes_may_be_code(void)
{
    return qdot_asm_kind() > 0;
}

qdot_status
qdot_lanes_code_new(const qdot_lanes_rows *at, size_t numbers, qdot_lanes_write *write,
                    void *user, qdot_lanes_code **code)
{
    /* code for single doubles uses only instructions that both kinds of processor have */
    const size_t kind = at->group > 1 || qdot_asm_kind() == 0 ? qdot_asm_kind() : 1;
    qdot_lanes_writer w = {.m = {.kind = kind},
                           .at = *at,
                           .t = at->program,
                           .bytes = (int32_t)(at->group * sizeof(double)),
                           .numbers = numbers};
    qdot_status status;

    *code = NULL;
    if (kind == 0)
        return QDOT_OK;
    w.registers = qdot_asm_registers(&w.m);
    w.block = block;
    w.chains = chains;
    w.moment = w.chains;
    w.windows = w.registers == QDOT_ASM_REGISTERS;
    w.first_free = w.moment + 1 + (w.windows ? 2 * w.block : 0);
    status = build_code(&w, write, user, code);
    qdot_free(w.rows);
    qdot_free(w.steps);
    qdot_free(w.scalars.at);
    qdot_free(w.tables.at);
    qdot_free(w.ahead.at);
    qdot_free(w.m.bytes.at);
    return status;
}

void
qdot_lanes_code_free(qdot_lanes_code *c)
{
    if (!c)
        return;
    qdot_taylor_text_give(c->text);
    qdot_free(c->scalars);
    qdot_free(c->allocated);
    qdot_free(c);
}

void
qdot_lanes_code_run(const qdot_lanes_code *c)
{
    const unsigned char *first = qdot_taylor_text_first(c->text) + c->entry;
    kernel *code;

    memcpy(&code, &first, sizeof code);
    code(c->coefficients, c->scalars, c->work);
    if (c->halves)
        code(c->coefficients + c->group / 2, c->scalars, c->work + c->group / 2);
}

double *
qdot_lanes_code_number(const qdot_lanes_code *c, size_t i)
{
    return c->work + i * c->group;
}

size_t
qdot_lanes_code_size(const qdot_lanes_code *c)
{
    return c->text->used;
}
