/* lanes-code-run.c -- the writer: places, registers, sums; and what it wrote, to be run. */
#include "series/lanes-code.h"

#include <string.h>

#include "series/lanes-writer.h"
#include "series/taylor-text.h"

enum {
    /* Longer code is not there when it is wanted. */
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
    bool halves; /* it is run for each half of a group */
    size_t group;
    double *coefficients; /* borrowed */
    double *scalars;
    double *allocated, *work;
};

/* --- loops -------------------------------------------------------------------------- */

/* Addresses of order k, or of those a step of the loop further. */
static void
aim(qdot_lanes_writer *w, bool further, int k)
{
    const struct {
        qdot_x86_base to, from;
        int bytes, part;
    } rows[] = {{QDOT_X86_R9, QDOT_X86_RDI, w->bytes, 1},
                {QDOT_X86_RBX, QDOT_X86_RSI, sizeof(double), 1},
                {QDOT_X86_RBP, QDOT_X86_RDI, w->bytes, 2}};
    const int32_t dot = (int32_t)qdot_writer_term(w, w->dot);
    const int32_t pair = (int32_t)qdot_writer_term(w, w->pair);
    const int32_t half = (int32_t)qdot_writer_term(w, w->half);

    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        qdot_x86_address(&w->x, rows[i].to, further ? rows[i].to : rows[i].from,
                         k / rows[i].part * rows[i].bytes);
    if (further) {
        qdot_x86_address(&w->x, QDOT_X86_R11, QDOT_X86_R11, -k * dot);
        qdot_x86_address(&w->x, QDOT_X86_R14, QDOT_X86_R14, -k * pair);
        qdot_x86_address(&w->x, QDOT_X86_R15, QDOT_X86_R15, -k / 2 * half);
    } else {
        qdot_x86_place(&w->x, QDOT_X86_R11, w->dot[k - 1]);
        qdot_x86_place(&w->x, QDOT_X86_R14, w->pair[k - 1]);
        qdot_x86_place(&w->x, QDOT_X86_R15, w->half[(k - 1) / 2]);
    }
}

/* An order of a block from `first` on, or of one so many blocks before it. */
static void
write_one(qdot_lanes_writer *w, int k, int from, int first, qdot_lanes_write_order *write,
          void *user)
{
    const int phase = (k - first) % w->block + (k < first ? w->block : 0);

    w->phase = phase % w->block;
    if (w->phase > k - from)
        w->phase = k - from;
    write(w, k, user);
}

/* From which order on no term of a block is of two of its coefficients. */
static int
least_of_loop(const qdot_lanes_writer *w, int late)
{
    for (size_t i = w->t->still; i < w->t->length; i++) {
        const int op = w->t->steps.at[i].op;

        if (op == QDOT_T_SQUARE || op == QDOT_T_SQRT || op == QDOT_T_TANH)
            return 2 * w->block + late;
    }
    return w->block + late;
}

void
qdot_lanes_orders(qdot_lanes_writer *w, int from, int late, int loop, int to,
                  qdot_lanes_write_order *write, void *user)
{
    const int least = least_of_loop(w, late) > loop ? least_of_loop(w, late) : loop;
    const int blocks = to >= least ? (to - least + 1) / w->block : 0;
    const int first = to + 1 - blocks * w->block;
    size_t start = 0;

    for (int k = from; k < first; k++)
        write_one(w, k, from, first, write, user);
    if (blocks == 0)
        return;
    qdot_writer_leave(w, w->registers);
    if (!w->counting) {
        aim(w, false, first);
        start = qdot_x86_repeat(&w->x, blocks);
    }
    w->any = QDOT_WRITER_ANY + first % w->block;
    for (int i = 0; i < w->block; i++)
        write_one(w, w->any + i, from, w->any, write, user);
    qdot_writer_leave(w, w->registers);
    if (!w->counting) {
        aim(w, true, w->block);
        qdot_x86_again(&w->x, start);
    }
}

/* --- all of it ---------------------------------------------------------------------- */

static void
find_rows(qdot_lanes_writer *w)
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
    }
}

/* The second time rows have their places; sums come first. */
static void
write_all(qdot_lanes_writer *w, bool counting, qdot_lanes_write *write, void *user,
          size_t *entry)
{
    static const qdot_x86_base restored[] = {QDOT_X86_RBX, QDOT_X86_RBP, QDOT_X86_R12, QDOT_X86_R13,
                                             QDOT_X86_R14, QDOT_X86_R15};
    const size_t n = sizeof restored / sizeof *restored;

    w->counting = counting;
    w->k = 0;
    w->clock = 0;
    w->any = QDOT_WRITER_ANY;
    w->phase = 0;
    if (w->ahead.n > 0)
        memset(w->ahead.at, 0, w->ahead.n * sizeof *w->ahead.at);
    memset(w->reg, 0, sizeof w->reg);
    if (!counting) {
        qdot_writer_terms(w, w->windows, 1, w->dot);
        qdot_writer_terms(w, w->windows, 2, w->pair);
        qdot_writer_terms(w, false, 1, w->half);
    }
    *entry = w->x.bytes.n;
    for (size_t i = 0; i < n; i++)
        qdot_x86_push(&w->x, restored[i]);
    write(w, user);
    qdot_writer_leave(w, w->registers);
    for (size_t i = n; i-- > 0;)
        qdot_x86_pop(&w->x, restored[i]);
    qdot_x86_return(&w->x);
    if (counting)
        w->x.bytes.n = 0;
}

static qdot_status
make_memory(qdot_lanes_code *c, const qdot_lanes_writer *w)
{
    const size_t tables = (size_t)QDOT_WRITER_MOST_TABLES * QDOT_WRITER_TABLE;

    c->coefficients = w->at.coefficients;
    c->group = w->at.group;
    c->halves = w->x.narrow && c->group > 1;
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

/* *code NULL if it cannot be. */
static qdot_status
make(qdot_lanes_writer *w, qdot_lanes_write *write, void *user, qdot_lanes_code **code)
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
        find_rows(w);
        write_all(w, true, write, user, &c->entry);
        write_all(w, false, write, user, &c->entry);
        status = w->status != QDOT_OK ? w->status : w->x.status;
    }
    if (status == QDOT_OK && w->x.bytes.n <= most_bytes) {
        runs = qdot_taylor_text_fill(c->text, w->x.bytes.at, w->x.bytes.n);
        status = make_memory(c, w);
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
    return qdot_x86_kind() > 0;
}

qdot_status
qdot_lanes_code_new(const qdot_lanes_rows *at, size_t numbers, qdot_lanes_write *write,
                    void *user, qdot_lanes_code **code)
{
    /* of one double by instructions that both kinds have */
    const size_t kind = at->group > 1 || qdot_x86_kind() == 0 ? qdot_x86_kind() : 1;
    qdot_lanes_writer w = {.x = qdot_x86_of(kind),
                           .at = *at,
                           .t = at->program,
                           .bytes = (int32_t)(at->group * sizeof(double)),
                           .numbers = numbers};
    qdot_status status;

    *code = NULL;
    if (kind == 0)
        return QDOT_OK;
    w.registers = qdot_x86_registers(&w.x);
    w.block = block;
    w.chains = chains;
    w.moment = w.chains;
    w.windows = kind > 1;
    w.first_free = w.moment + 1 + (w.windows ? 2 * w.block : 0);
    status = make(&w, write, user, code);
    qdot_free(w.rows);
    qdot_free(w.steps);
    qdot_free(w.scalars.at);
    qdot_free(w.tables.at);
    qdot_free(w.ahead.at);
    qdot_free(w.x.bytes.at);
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
