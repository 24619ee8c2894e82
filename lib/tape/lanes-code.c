/* lanes-code.c -- the writer: places, registers, sums; and what it wrote, to be run. */
#include "tape/lanes-code.h"

#include <string.h>

#include "num/kinds.h"
#include "tape/lanes-writer.h"
#include "tape/taylor-text.h"

enum {
    /* Longer code is not there when it is wanted. */
    most_bytes = 1 << 19,
    /* Registers of sums that a sequence of terms makes: two orders of one product or of two,
     * each in chains that do not wait for each other. Behind them those for a moment, and
     * those for coefficients. */
    chains = 8,
    chains_narrow = 4,
    moments = 5
};

typedef void kernel(double *coefficients, const double *scalars, double *work);

struct qdot_lanes_code {
    qdot_taylor_text *text;
    size_t entry;
    bool narrow;
    double *coefficients; /* borrowed */
    double *scalars;
    double *allocated, *work;
    size_t before_rows, stride; /* groups */
};

/* --- loops -------------------------------------------------------------------------- */

static void
forget(qdot_lanes_writer *w)
{
    for (int r = 0; r < QDOT_WRITER_REGISTERS; r++)
        w->reg[r].holds = false;
}

/* Addresses of order k, or of those a step of the loop further. */
static void
aim(qdot_lanes_writer *w, bool further, int k)
{
    static const struct {
        qdot_x86_base to, from;
        int bytes;
    } rows[] = {{QDOT_X86_R9, QDOT_X86_RDI, QDOT_WRITER_GROUP},
                {QDOT_X86_R10, QDOT_X86_RDX, QDOT_WRITER_GROUP},
                {QDOT_X86_RBX, QDOT_X86_RSI, sizeof(double)},
                {QDOT_X86_RBP, QDOT_X86_RDI, QDOT_WRITER_GROUP / 2}};
    const int32_t dot = (int32_t)(w->dot[2] - w->dot[3]);
    const int32_t pair = (int32_t)(w->pair[2] - w->pair[3]);

    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        qdot_x86_address(&w->x, rows[i].to, further ? rows[i].to : rows[i].from,
                         k * rows[i].bytes);
    if (further) {
        qdot_x86_address(&w->x, QDOT_X86_R11, QDOT_X86_R11, -k * dot);
        qdot_x86_address(&w->x, QDOT_X86_R14, QDOT_X86_R14, -k * pair);
        qdot_x86_address(&w->x, QDOT_X86_R15, QDOT_X86_R15, -k / 2 * dot);
    } else {
        qdot_x86_place(&w->x, QDOT_X86_R11, w->dot[k - 1]);
        qdot_x86_place(&w->x, QDOT_X86_R14, w->pair[k - 1]);
        qdot_x86_place(&w->x, QDOT_X86_R15, w->dot[k / 2 - 1]);
    }
}

void
qdot_lanes_orders(qdot_lanes_writer *w, int from, int loop, int to,
                  qdot_lanes_write_order *write, void *user)
{
    size_t start = 0;
    int k = from;

    for (; k <= to && k < loop; k++)
        write(w, k, user);
    if (k > to)
        return;
    forget(w);
    if (!w->counting) {
        aim(w, false, k);
        start = qdot_x86_repeat(&w->x, (to - k + 2) / 2);
    }
    for (int odd = 0; odd < 2; odd++)
        write(w, QDOT_WRITER_ANY + odd, user);
    if (!w->counting) {
        aim(w, true, 2);
        qdot_x86_again(&w->x, start);
    }
    forget(w);
}

/* --- all of it ---------------------------------------------------------------------- */

static void
find_moving(qdot_lanes_writer *w)
{
    const qdot_taylor *t = w->t;

    for (size_t i = 0; i < qdot_writer_rows(w); i++)
        w->moving[i] = i < t->moving || i >= t->rows;
    for (size_t i = 0; i < t->moving; i++)
        w->kept[i] = true;
    for (size_t i = t->still; i < t->length; i++) {
        const double *const rows[] = {t->steps[i].to, t->steps[i].second,
                                      t->steps[i].third, t->steps[i].d};

        for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
            if (rows[r])
                w->moving[qdot_writer_row(w, rows[r])] = true;
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
    if (w->ahead.n > 0)
        memset(w->ahead.at, 0, w->ahead.n * sizeof *w->ahead.at);
    memset(w->reg, 0, sizeof w->reg);
    if (!counting) {
        qdot_writer_terms(w, 1, w->dot);
        qdot_writer_terms(w, 2, w->pair);
    }
    *entry = w->x.bytes.n;
    for (size_t i = 0; i < n; i++)
        qdot_x86_push(&w->x, restored[i]);
    write(w, user);
    for (size_t i = n; i-- > 0;)
        qdot_x86_pop(&w->x, restored[i]);
    qdot_x86_return(&w->x);
    if (counting)
        w->x.bytes.n = 0;
}

static qdot_status
make_memory(qdot_lanes_code *c, const qdot_lanes_writer *w)
{
    const size_t groups = qdot_writer_groups(w) + w->further * w->stride;
    const size_t tables = (size_t)QDOT_WRITER_MOST_TABLES * QDOT_WRITER_TABLE;

    c->coefficients = qdot_lanes_input(w->lanes, 0);
    c->narrow = w->x.narrow;
    c->before_rows = qdot_writer_groups(w);
    c->stride = w->stride;
    c->scalars = qdot_calloc(tables + w->scalars.n, sizeof *c->scalars);
    c->allocated = qdot_calloc((groups + 1) * QDOT_LANES, sizeof *c->allocated);
    if (!c->scalars || !c->allocated)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < w->tables.n; i++)
        for (int k = 1; k < QDOT_WRITER_TABLE; k++)
            c->scalars[i * QDOT_WRITER_TABLE + (size_t)k] = w->tables.at[i](k);
    if (w->scalars.n > 0)
        memcpy(c->scalars + tables, w->scalars.at, w->scalars.n * sizeof *c->scalars);
    c->work = c->allocated;
    while ((uintptr_t)c->work % QDOT_WRITER_GROUP != 0)
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

    w->moving = qdot_calloc(qdot_writer_rows(w) + 1, sizeof *w->moving);
    w->kept = qdot_calloc(qdot_writer_rows(w) + 1, sizeof *w->kept);
    w->rests = qdot_calloc(QDOT_WRITER_RESTS * w->t->length + 1, sizeof *w->rests);
    if (c)
        c->text = qdot_calloc(1, sizeof *c->text);
    if (c && c->text && w->moving && w->kept && w->rests) {
        atomic_init(&c->text->users, 1);
        find_moving(w);
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
    return qdot_batch_kind() > 0;
}

qdot_status
qdot_lanes_code_new(qdot_lanes *lanes, size_t rows, size_t numbers,
                    qdot_lanes_write *write, void *user, qdot_lanes_code **code)
{
    const size_t kind = qdot_batch_kind();
    qdot_lanes_writer w = {.lanes = lanes,
                           .t = qdot_lanes_program(lanes),
                           .stride = qdot_lanes_stride(lanes),
                           .further = rows,
                           .numbers = numbers,
                           .registers = kind > 1 ? QDOT_WRITER_REGISTERS : 16};
    qdot_status status;

    *code = NULL;
    if (kind == 0)
        return QDOT_OK;
    w.x.narrow = kind == 1;
    w.chains = kind > 1 ? chains : chains_narrow;
    w.moment = w.chains;
    w.first_free = w.moment + moments;
    status = make(&w, write, user, code);
    qdot_free(w.moving);
    qdot_free(w.kept);
    qdot_free(w.rests);
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
    if (c->narrow)
        code(c->coefficients + QDOT_LANES / 2, c->scalars, c->work + QDOT_LANES / 2);
}

size_t
qdot_lanes_code_bytes(const qdot_lanes_code *c)
{
    return c->text->used;
}

double *
qdot_lanes_code_number(const qdot_lanes_code *c, size_t i)
{
    return c->work + i * QDOT_LANES;
}

double *
qdot_lanes_code_row(const qdot_lanes_code *c, size_t i)
{
    return c->work + (c->before_rows + i * c->stride) * QDOT_LANES;
}
