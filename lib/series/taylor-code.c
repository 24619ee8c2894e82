/* taylor-code.c -- generates machine code for a series program: vectors of products, registers, loops. */
#include "series/taylor-code.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include "series/recurrence-operations.h"
#include "series/taylor-generator.h"
#include "series/taylor-text.h"

enum {
    /* in bytes; longer code would not be in the cache when needed, so that other functions are used */
    most_bytes = 1 << 18,
    /* With fewer sums an order takes as long as its newest coefficient to be ready, and the
     * way through the vectors is the longer one. With more it takes as long as its
     * instructions, which are a third fewer where the vectors have all but order 0. */
    few_sums = 5,
    /* registers for single numbers; fewer for few sums with AVX2, which then keeps their vectors in
     * registers */
    scalars = 10,
    few_scalars = 5
};

typedef void kernel(double *coefficients, qdot_taylor_step *steps, double *work);

struct qdot_taylor_code {
    qdot_taylor_text *text;
    double *allocated, *work; /* work space as allocated; the same memory from an aligned address on */
    int to;
    double unit;
    /* [order] low parts of the factors by which integrals multiply, for the unit of time 1 */
    double once_low[QDOT_CODE_EXACT + 1], twice_low[QDOT_CODE_EXACT + 1];
};

static int
minimum(int a, int b)
{
    return a < b ? a : b;
}

static int
maximum(int a, int b)
{
    return a > b ? a : b;
}

static qdot_taylor_loops
loop_layout(const qdot_generator *g)
{
    return (qdot_taylor_loops){g->lanes, g->lag, g->as_they_stand};
}

static int
vectors_of_numbers(const qdot_taylor_loops *l, int n)
{
    return (n + l->lanes - 1) / l->lanes;
}

/* The largest number of vectors of a sum in an expansion to order n. */
static int
most_vectors_of_sum(const qdot_taylor_loops *l, int n)
{
    return vectors_of_numbers(l, maximum(n / 2 + 1 - l->lag, 1));
}

/* What adding order m takes. Rows as they stand go on beyond half of the orders, where all
 * their lanes are known: what those beyond it make is of no order that is wanted. Narrow vectors go
 * on like that to the end: loops with fewer of them would take longer to be fetched, each for the
 * few orders that it is for, than the vectors that they save. */
static qdot_code_phase
phase_of_order(const qdot_taylor_loops *l, int n, int m)
{
    const int all = most_vectors_of_sum(l, n);
    int blocks;

    if (qdot_code_is_narrow(l->lanes))
        m = minimum(m, n / 2);
    if (m <= n / 2)
        return (qdot_code_phase){.blocks = vectors_of_numbers(l, m + 1 - l->lag),
                                 .inserted = (m - l->lag) / l->lanes};
    blocks = minimum(all, vectors_of_numbers(l, n - m + 2 - l->lag));
    return (qdot_code_phase){.blocks = blocks,
                             .inserted = l->as_they_stand && blocks == all ? blocks - 1 : -1};
}

static bool
is_same_phase(const qdot_code_phase *a, const qdot_code_phase *b)
{
    return a->blocks == b->blocks && a->inserted == b->inserted;
}

/* Find the phases (ranges of orders that share a loop) of an expansion to order n; at most QDOT_CODE_PHASES. */
static int
find_phases(const qdot_taylor_loops *l, int n, qdot_code_phase *phases)
{
    int count = 0;

    for (int m = l->lag; m <= n - l->lag; m++) {
        const qdot_code_phase p = phase_of_order(l, n, m);

        if (count == 0 || !is_same_phase(&p, phases + count - 1))
            phases[count++] = p;
        phases[count - 1].orders++;
    }
    return count;
}

/* Whether the code of either order differs by nothing but how often loops are run; that of narrow
 * vectors has all loops of lower orders. */
static bool
is_same_code(const qdot_taylor_loops *l, int n, int other)
{
    qdot_code_phase of[2][QDOT_CODE_PHASES];
    const int count = find_phases(l, n, of[0]);

    if (count == 0 || count != find_phases(l, other, of[1]) ||
        (n >= QDOT_TAYLOR_EXACT_FROM) != (other >= QDOT_TAYLOR_EXACT_FROM))
        return false;
    for (int i = 0; i < count; i++)
        if (!is_same_phase(of[0] + i, of[1] + i))
            return false;
    return true;
}

/* --- which rows and sums the code needs --------------------------------------------- */

static void
find_varying_rows(qdot_generator *g)
{
    const qdot_taylor *t = g->t;

    for (size_t i = 0; i < t->moving; i++)
        g->moving[i] = true;
    for (size_t i = t->still; i < t->length; i++) {
        const qdot_taylor_step *s = t->steps + i;
        const double *rows[] = {s->to, s->second, s->third, s->d};

        for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
            if (rows[k])
                g->moving[qdot_code_row(g, rows[k])] = true;
    }
}

static void
find_varying_unknowns(qdot_generator *g)
{
    const qdot_taylor *t = g->t;

    for (size_t k = 0; k < t->n_blocks; k++)
        for (size_t i = 0; i < t->blocks[k].n; i++) {
            g->moving[qdot_code_row(g, t->blocks[k].a[i])] = true;
            g->moving[qdot_code_row(g, t->blocks[k].r[i])] = true;
        }
}

_Static_assert((int)QDOT_CODE_EXACT >= (int)QDOT_TAYLOR_EXACT, "the first loop is exact");

static qdot_code_vector
vector_in_memory(void)
{
    qdot_code_vector v = {.at = 0};

    memset(v.reg, -1, sizeof v.reg);
    return v;
}

static qdot_status
make_vector_of_row(qdot_generator *g, uint32_t row)
{
    if (g->row_vector[row] != QDOT_CODE_NONE)
        return QDOT_OK;
    g->row_vector[row] = (uint32_t)g->rows.n;
    QDOT_TRY(qdot_vec_push(&g->row_of, row));
    return qdot_vec_push(&g->rows, vector_in_memory());
}

static qdot_status
add_sum(qdot_generator *g, uint32_t x, uint32_t y, bool further)
{
    const qdot_code_sum sum = {x, y, further, vector_in_memory()};

    QDOT_TRY(make_vector_of_row(g, x));
    QDOT_TRY(make_vector_of_row(g, y));
    return qdot_vec_push(&g->sums, sum);
}

/* Find the convolution sums of step i from its recurrence. */
static qdot_status
find_sums_of_step(qdot_generator *g, size_t i)
{
    const qdot_taylor_step *s = g->t->steps + i;
    uint32_t *sum = g->step_sums + 3 * i;

    for (const qdot_recurrence_operation *o = qdot_recurrence_operations(s->op);
         o->verb != QDOT_DO_END; o++) {
        uint32_t a, b;

        if (o->verb != QDOT_DO_SUM && o->verb != QDOT_DO_SQUARED)
            continue;
        a = qdot_code_row(g, qdot_code_named(s, o->a));
        b = qdot_code_row(g, qdot_code_named(s, o->b));
        if (g->moving[a] && g->moving[b]) {
            *sum = (uint32_t)g->sums.n;
            QDOT_TRY(add_sum(g, a, b, false));
        }
        sum++;
    }
    return QDOT_OK;
}

static qdot_status
find_all_sums(qdot_generator *g)
{
    const qdot_taylor *t = g->t;

    for (size_t i = t->still; i < t->length; i++)
        QDOT_TRY(find_sums_of_step(g, i));
    return QDOT_OK;
}

/* For each equation of the unknowns, make one convolution sum of all products M a in it. */
static qdot_status
find_sums_of_unknowns(qdot_generator *g)
{
    const qdot_taylor *t = g->t;

    for (size_t k = 0; k < t->n_blocks; k++) {
        const qdot_taylor_block *b = t->blocks + k;

        g->block_slots[k] = (uint32_t)(QDOT_CODE_SLOTS + g->n_slots);
        g->n_slots += 2 * b->n * b->n;
        for (size_t c = 0; c < b->n_couplings; c++) {
            const qdot_taylor_coupling *m = b->couplings + c;
            const bool further = c > 0 && m[-1].i == m->i;

            if (!further)
                g->unknown_sums[qdot_code_row(g, b->r[m->i])] = (uint32_t)g->sums.n;
            QDOT_TRY(add_sum(g, qdot_code_row(g, m->M), qdot_code_row(g, m->a), further));
        }
    }
    return QDOT_OK;
}

/* What suits the kind of processor and the number of sums. AVX2 has few registers and slides lanes
 * by two instructions: many sums stay in memory, where they are read one number further instead,
 * which takes as long as a number just written takes to leave the processor. */
static void
choose_layout(qdot_generator *g)
{
    const int lanes = qdot_asm_lanes(&g->m);
    const bool narrow = qdot_code_is_narrow(lanes), few = g->sums.n < few_sums;
    qdot_taylor_loops loops;

    g->lanes = lanes;
    g->lag = few && !narrow ? 2 : 1;
    g->reread = narrow && !few;
    g->first_scalar = qdot_asm_first_free(&g->m);
    g->behind_scalars = minimum(g->first_scalar + (narrow && few ? few_scalars : scalars),
                                qdot_asm_registers(&g->m));
    g->as_they_stand = qdot_code_rows_as_they_stand(g);
    loops = loop_layout(g);
    g->blocks = most_vectors_of_sum(&loops, g->n);
}

/* Registers from the last one down, first for what every order needs; places in memory for
 * all. Doubles of work space. */
static size_t
assign_registers_and_memory(qdot_generator *g)
{
    const int lowest = g->behind_scalars;
    size_t at = QDOT_CODE_SLOTS + (g->n_slots + 7) / 8 * 8;
    int reg = qdot_asm_registers(&g->m);

    for (int b = 0; b < g->blocks; b++) {
        for (size_t i = 0; i < g->sums.n && reg > lowest; i++)
            if (!g->sums.at[i].further)
                g->sums.at[i].v.reg[b] = --reg;
        for (size_t i = 0; !g->as_they_stand && i < g->rows.n && reg > lowest; i++)
            g->rows.at[i].reg[b] = --reg;
    }
    for (size_t i = 0; i < g->sums.n; i++) {
        if (g->sums.at[i].further) {
            g->sums.at[i].v = g->sums.at[i - 1].v;
            continue;
        }
        g->sums.at[i].v.at = at;
        at += (size_t)(g->lanes * g->blocks + QDOT_CODE_LANES); /* zeros follow the last number */
    }
    for (size_t i = 0; !g->as_they_stand && i < g->rows.n; i++) {
        g->rows.at[i].at = at;
        at += (size_t)(g->lanes * g->blocks);
    }
    return at;
}

/* --- writing the code --------------------------------------------------------------- */

/* Write the code for one order of all recurrences; their vectors must contain the orders before. */
static void
write_order(qdot_generator *g)
{
    const qdot_taylor *t = g->t;

    for (size_t i = t->still; i < t->length; i++)
        if (!g->folded[qdot_code_row(g, t->steps[i].to)])
            qdot_code_order(g, t->steps + i);
    for (size_t i = 0; i < t->n_blocks; i++)
        qdot_code_solve(g, i);
    for (size_t i = t->length; i < t->length + t->n_links; i++)
        qdot_code_order(g, t->steps + i);
}

void
qdot_code_forget(qdot_generator *g)
{
    for (int i = 0; i < QDOT_ASM_REGISTERS; i++)
        g->held[i] = QDOT_CODE_NONE;
}

/* Shift the table of times at which coefficients become known by `orders` orders. */
static void
shift_ready_times(qdot_generator *g, int orders)
{
    for (size_t row = 0; row < g->t->rows; row++) {
        int *ready = g->ready + 4 * row, old[4];

        memcpy(old, ready, sizeof old);
        for (int i = 0; i < 4; i++)
            ready[i] = old[(i + orders) & 3];
    }
}

static void
write_loop_body(qdot_generator *g, const qdot_code_phase *p)
{
    qdot_code_add_order(g, p, g->k - g->lag);
    write_order(g);
}

/* Orders k = m + lag for the m of a phase. What waits for what is known from an order to the
 * next: it is written twice, and the second stays. */
static void
write_phase(qdot_generator *g, const qdot_code_phase *p, int number)
{
    size_t from;

    qdot_code_begin_phase(g, p);
    shift_ready_times(g, number > 0 ? 1 : 2 * g->lag);
    g->k = QDOT_CODE_ANY;
    g->exact = g->n >= QDOT_TAYLOR_EXACT_FROM && p->inserted >= 0 &&
               p->inserted * g->lanes < QDOT_CODE_LANES;
    for (int i = 0; i < 2; i++) {
        from = g->m.bytes.n;
        qdot_code_forget(g);
        write_loop_body(g, p);
        shift_ready_times(g, 1);
        g->m.bytes.n = from;
    }
    qdot_code_forget(g);
    from = qdot_asm_repeat_as(&g->m, qdot_code_work(QDOT_CODE_COUNTS + (size_t)number));
    if (g->m.kind < 2) { /* lower orders need no more loops */
        qdot_asm_return_if_none(&g->m);
        from = g->m.bytes.n;
    }
    write_loop_body(g, p);
    qdot_asm_set(&g->m, QDOT_ASM_ROWS_NOW, QDOT_ASM_ROWS_NOW, 8);
    qdot_asm_set(&g->m, QDOT_ASM_WORK_NOW, QDOT_ASM_WORK_NOW, 8);
    qdot_code_next_lane(g, p);
    qdot_asm_again(&g->m, from);
}

static void
write_all_code(qdot_generator *g)
{
    const int singly = 2 * g->lag - 1;
    const qdot_taylor_loops loops = loop_layout(g);
    qdot_code_phase phases[QDOT_CODE_PHASES];
    int count;

    qdot_code_forget(g);
    g->exact = g->n >= QDOT_TAYLOR_EXACT_FROM;
    qdot_code_begin_vectors(g);
    for (g->k = 1; g->k <= minimum(g->n, singly); g->k++)
        write_order(g);
    qdot_asm_set(&g->m, QDOT_ASM_ROWS_NOW, QDOT_ASM_ROWS, 8 * (singly + 1));
    qdot_asm_set(&g->m, QDOT_ASM_WORK_NOW, QDOT_ASM_WORK, 8 * (singly + 1));
    count = find_phases(&loops, g->n, phases);
    for (int i = 0; i < count && g->m.bytes.n <= most_bytes; i++)
        write_phase(g, phases + i, i);
    qdot_asm_return(&g->m);
}

/* The rounding error of the double 1/n: the exact value minus the double. */
static double
rounding_of_inverse(int n)
{
    return fma(-1.0 / n, n, 1) / n;
}

static qdot_status
allocate_work_space(qdot_taylor_code *c)
{
    qdot_code_phase phases[QDOT_CODE_PHASES];
    const int count = find_phases(&c->text->loops, c->to, phases);

    c->allocated = qdot_calloc(c->text->doubles + QDOT_CODE_LANES, sizeof(double));
    if (!c->allocated)
        return QDOT_ENOMEM;
    c->work = c->allocated;
    while ((uintptr_t)c->work % (QDOT_CODE_LANES * sizeof(double)) != 0)
        c->work++;
    for (int k = 1; k < QDOT_CODE_TABLE; k++) {
        c->work[QDOT_CODE_INVERSES + k] = 1.0 / k;
        c->work[QDOT_CODE_PAIRS + k - 1] = 1.0 / (k * (k + 1));
        c->work[QDOT_CODE_ORDERS + k] = k;
    }
    for (int k = 0; k <= QDOT_CODE_EXACT; k++) {
        c->once_low[k] = rounding_of_inverse(k + 1);
        c->twice_low[k] = rounding_of_inverse((k + 1) * (k + 2));
    }
    c->work[QDOT_CODE_INVERSES] = -1;
    memset(c->work + QDOT_CODE_ONES, 0xff, sizeof *c->work);
    for (int i = 0; i < count; i++)
        memcpy(c->work + QDOT_CODE_COUNTS + i, &(uint32_t){(uint32_t)phases[i].orders},
               sizeof(uint32_t));
    return QDOT_OK;
}

/* Whether all rows that integrals (links) read belong to the program itself. */
static bool
links_stay_in_program(const qdot_taylor *t)
{
    const double *end = t->coefficients + t->rows * t->stride;

    for (size_t l = 0; l < t->n_links; l++) {
        const double *x = t->steps[t->length + l].x;

        if (x < t->coefficients || x >= end)
            return false;
    }
    return true;
}

static qdot_status
generate_code(qdot_generator *g, qdot_taylor_text *text, const char **why)
{
    const size_t rows = g->t->rows, length = g->t->length;

    g->moving = qdot_calloc(rows + 1, sizeof *g->moving);
    g->folded = qdot_calloc(rows + 1, sizeof *g->folded);
    g->maker = qdot_calloc(rows + 1, sizeof *g->maker);
    g->row_vector = qdot_calloc(rows + 1, sizeof *g->row_vector);
    g->ready = qdot_calloc(4 * rows + 1, sizeof *g->ready);
    g->where = qdot_calloc(4 * rows + 1, sizeof *g->where);
    g->step_sums = qdot_calloc(3 * length + 1, sizeof *g->step_sums);
    g->unknown_sums = qdot_calloc(rows + 1, sizeof *g->unknown_sums);
    g->block_slots = qdot_calloc(g->t->n_blocks + 1, sizeof *g->block_slots);
    if (!g->moving || !g->folded || !g->maker || !g->row_vector || !g->ready || !g->where
        || !g->step_sums || !g->unknown_sums || !g->block_slots)
        return QDOT_ENOMEM;
    memset(g->row_vector, 0xff, rows * sizeof *g->row_vector);
    memset(g->maker, 0xff, rows * sizeof *g->maker);
    memset(g->unknown_sums, 0xff, rows * sizeof *g->unknown_sums);
    memset(g->step_sums, 0xff, 3 * length * sizeof *g->step_sums);
    find_varying_rows(g);
    find_varying_unknowns(g);
    QDOT_TRY(find_all_sums(g));
    QDOT_TRY(find_sums_of_unknowns(g));
    choose_layout(g);
    QDOT_TRY(qdot_code_fold(g));
    text->doubles = assign_registers_and_memory(g);
    QDOT_TRY(qdot_grow(&g->m.bytes.at, &g->m.bytes.capacity, 16384, 1));
    write_all_code(g);
    text->begin = g->m.bytes.n;
    qdot_code_zero(g);
    text->loops = loop_layout(g);
    text->from = text->to = g->n;
    text->exact = g->n >= QDOT_TAYLOR_EXACT_FROM;
    while (text->from > 1 && (g->m.kind < 2 || is_same_code(&text->loops, g->n, text->from - 1)))
        text->from--;
    while (text->to < QDOT_SERIES_MOST && is_same_code(&text->loops, g->n, text->to + 1))
        text->to++;
    QDOT_TRY(g->m.status);
    if (g->m.bytes.n > most_bytes)
        *why = "machine code for them would be too long";
    else if (!qdot_taylor_text_fill(text, g->m.bytes.at, g->m.bytes.n))
        *why = "the system runs no code made at run time";
    return QDOT_OK;
}

static qdot_status
write_code_text(const qdot_taylor *t, int n, qdot_taylor_text *text, const char **why)
{
    qdot_generator g = {.m = {.kind = qdot_asm_kind()}, .t = t, .n = n};
    qdot_status status = generate_code(&g, text, why);

    text->blocks = g.block_slots;
    qdot_free(g.moving);
    qdot_free(g.folded);
    qdot_free(g.maker);
    qdot_free(g.compositions.at);
    qdot_free(g.row_vector);
    qdot_free(g.ready);
    qdot_free(g.where);
    qdot_free(g.step_sums);
    qdot_free(g.unknown_sums);
    qdot_free(g.rows.at);
    qdot_free(g.row_of.at);
    qdot_free(g.sums.at);
    qdot_free(g.m.bytes.at);
    return status;
}

/* One that is kept, or (but not if `kept`) is written now. A run and its companions want the same at
 * once: one writes, the others wait for it. */
static qdot_status
find_or_write_text(const qdot_taylor *t, qdot_taylor_orders orders, bool kept, qdot_taylor_text **text,
                   const char **why)
{
    static pthread_mutex_t writing = PTHREAD_MUTEX_INITIALIZER;
    qdot_status status;

    if (!kept)
        pthread_mutex_lock(&writing);
    status = qdot_taylor_text_take(t, orders, text);
    if (status == QDOT_OK && !(*text)->memory && !kept) {
        status = write_code_text(t, orders.most, *text, why);
        if (status == QDOT_OK && !*why)
            qdot_taylor_text_keep(*text);
    }
    if (!kept)
        pthread_mutex_unlock(&writing);
    return status;
}

qdot_status
qdot_taylor_code_new(const qdot_taylor *t, int to, int highest, bool kept,
                     qdot_taylor_code **code, const char **why)
{
    qdot_taylor_orders orders = {to, to};
    qdot_taylor_code *c;
    qdot_status status;

    *code = NULL;
    *why = NULL;
    if (!qdot_asm_is_here()) {
        *why = "machine code is for x86-64";
        return QDOT_OK;
    }
    if (!links_stay_in_program(t)) {
        *why = "what is linked is found elsewhere";
        return QDOT_OK;
    }
    c = qdot_calloc(1, sizeof *c);
    if (!c)
        return QDOT_ENOMEM;
    c->to = to;
    if (qdot_asm_kind() < 2)
        orders.most = minimum(maximum(to, highest), QDOT_SERIES_MOST);
    status = find_or_write_text(t, orders, kept, &c->text, why);
    if (status == QDOT_OK && *why && orders.most > to) { /* too long a code for orders up to `most`: try `to` */
        qdot_taylor_text_give(c->text);
        c->text = NULL;
        *why = NULL;
        orders.most = to;
        status = find_or_write_text(t, orders, kept, &c->text, why);
    }
    if (status == QDOT_OK && c->text->memory)
        status = allocate_work_space(c);
    if (status != QDOT_OK || !c->text->memory) {
        qdot_taylor_code_free(c);
        return status;
    }
    *code = c;
    return QDOT_OK;
}

void
qdot_taylor_code_free(qdot_taylor_code *c)
{
    if (!c)
        return;
    qdot_taylor_text_give(c->text);
    qdot_free(c->allocated);
    qdot_free(c);
}

/* --- running the code --------------------------------------------------------------- */

void
qdot_taylor_code_unit(qdot_taylor_code *c, double unit)
{
    double *w = c->work;

    if (unit == c->unit)
        return;
    c->unit = unit;
    for (size_t k = 0; k <= (size_t)c->to; k++) {
        w[QDOT_CODE_ONCE + k] = unit * w[QDOT_CODE_INVERSES + k + 1];
        w[QDOT_CODE_TWICE + k] = unit * unit * w[QDOT_CODE_PAIRS + k];
    }
    for (size_t k = 0; k <= QDOT_CODE_EXACT && c->to >= QDOT_TAYLOR_EXACT_FROM; k++) {
        w[QDOT_CODE_ONCE_LOW + k] = unit * c->once_low[k];
        w[QDOT_CODE_TWICE_LOW + k] = unit * unit * c->twice_low[k];
    }
}

void
qdot_taylor_code_begin(const qdot_taylor_code *c, qdot_taylor *t)
{
    const unsigned char *first = qdot_taylor_text_first(c->text) + c->text->begin;
    kernel *code;

    memcpy(&code, &first, sizeof code);
    code(t->coefficients, t->steps, c->work);
}

void
qdot_taylor_code_run(const qdot_taylor_code *c, qdot_taylor *t)
{
    const unsigned char *first = qdot_taylor_text_first(c->text);
    kernel *code;

    for (size_t k = 0; k < t->n_blocks; k++) {
        const qdot_taylor_block *b = t->blocks + k;

        memcpy(c->work + c->text->blocks[k], b->matrices, 2 * b->n * b->n * sizeof(double));
    }
    memcpy(&code, &first, sizeof code);
    code(t->coefficients, t->steps, c->work);
}

int
qdot_taylor_code_orders(const qdot_taylor_code *c)
{
    return c->to;
}

size_t
qdot_taylor_code_size(const qdot_taylor_code *c)
{
    return c->text->used;
}
