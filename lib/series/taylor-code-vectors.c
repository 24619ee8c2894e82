/* taylor-code-vectors.c -- products of lower orders as code: what an order adds to vectors. */
#include "series/taylor-generator.h"

enum {
    /* So many do not fit into registers by far. */
    many_vectors = 40,
    temporary = 0,
    spread_first = 2,
    newest_lane = 1, /* masks */
    older_lanes = 2,
    all_but_last = 3,
    known_lanes = 4 /* older and newest */
};

/* Parts of adding an order: what is there before rows have it, and after. */
typedef enum { BEFORE, AFTER } part;

/* With a lag of 1 the coefficients of a row are its vector, from order 1 on, as they stand: in
 * long programs, for a vector read soon after one of its numbers was written waits for that to
 * leave the processor (8 to 30 % of shorter ones). */
bool
qdot_code_rows_as_they_stand(const qdot_generator *g)
{
    return g->lag == 1 && g->sums.n + g->rows.n > many_vectors;
}

static qdot_x86_rm
block_at(const qdot_code_vector *v, int b)
{
    return v->reg[b] >= 0 ? qdot_x86_reg(v->reg[b])
                          : qdot_code_work(v->at + (size_t)(QDOT_CODE_LANES * b));
}

/* Coefficient m of a row beside those below it. */
static void
insert(qdot_generator *g, const qdot_code_vector *v, uint32_t row, int m, int b)
{
    const int reg = v->reg[b] >= 0 ? v->reg[b] : temporary;

    if (v->reg[b] < 0)
        qdot_x86_emit(&g->x, QDOT_X86_LOAD_ALL, reg, 0, block_at(v, b));
    g->x.mask = newest_lane;
    qdot_x86_emit(&g->x, QDOT_X86_SPREAD, reg, 0, qdot_code_coefficient(g, row, m));
    g->x.mask = 0;
    if (v->reg[b] < 0)
        qdot_x86_emit(&g->x, QDOT_X86_STORE_ALL, reg, 0, block_at(v, b));
}

/* The register with coefficient m of a row in every lane. */
static int
spread(qdot_generator *g, uint32_t row, int m)
{
    const int mask = g->x.mask;
    int i;

    for (i = 0; i < 2; i++)
        if (g->spread[i] == row)
            return spread_first + i;
    i = g->next_spread;
    g->next_spread = 1 - i;
    g->spread[i] = row;
    g->x.mask = 0;
    qdot_x86_emit(&g->x, QDOT_X86_SPREAD, spread_first + i, 0,
                  qdot_code_coefficient(g, row, m));
    g->x.mask = mask;
    return spread_first + i;
}

/* to += coefficient m of a row times block b of another. */
static void
multiply(qdot_generator *g, int to, uint32_t row, int m, uint32_t other, int b)
{
    const qdot_code_vector *v = &g->rows.at[g->row_vector[other]];

    if (qdot_code_rows_as_they_stand(g)) {
        qdot_x86_emit(&g->x, QDOT_X86_MADD_ALL, to, spread(g, row, m),
                      qdot_code_coefficient(g, other, 1 + QDOT_CODE_LANES * b));
    } else if (v->reg[b] >= 0) {
        qdot_x86_rm one = qdot_code_coefficient(g, row, m);

        one.spread = true;
        qdot_x86_emit(&g->x, QDOT_X86_MADD_ALL, to, v->reg[b], one);
    } else {
        qdot_x86_emit(&g->x, QDOT_X86_MADD_ALL, to, spread(g, row, m), block_at(v, b));
    }
}

/* Block b of a sum, of `blocks`, moved on by one order, into `to`. */
static void
move_on(qdot_generator *g, const qdot_code_vector *v, int b, int blocks, int to)
{
    if (b + 1 < blocks) {
        int high = v->reg[b + 1];

        if (high < 0)
            qdot_x86_emit(&g->x, QDOT_X86_LOAD_ALL, high = temporary + 1, 0,
                          block_at(v, b + 1));
        qdot_x86_align(&g->x, to, high, block_at(v, b), 1);
        return;
    }
    if (v->reg[b] < 0)
        qdot_x86_emit(&g->x, QDOT_X86_LOAD_ALL, to, 0, block_at(v, b));
    g->x.mask = all_but_last;
    g->x.zeroing = true;
    qdot_x86_align(&g->x, to, to, qdot_x86_reg(to), 1);
    g->x.mask = 0;
    g->x.zeroing = false;
}

/* Whether rows have order m by the time that block b of a sum is added to at all. */
static bool
all_after(const qdot_generator *g, const qdot_code_vector *v, int b)
{
    return v->reg[b] < 0 || qdot_code_rows_as_they_stand(g);
}

/* What is made of order m and those from `lag` up to it, in a phase. What is known last is
 * multiplied last; where the other row has not got order m yet that is no part of the first
 * product. */
static void
add_order(qdot_generator *g, const qdot_code_phase *p, const qdot_code_sum *s, int m, part now)
{
    const qdot_code_vector *v = &s->v;
    const bool x_last = *qdot_code_ready(g, s->x, m) >= *qdot_code_ready(g, s->y, m);
    const uint32_t last = x_last ? s->x : s->y, other = x_last ? s->y : s->x;

    for (int b = 0; b < p->blocks; b++) {
        const int to = v->reg[b] >= 0 ? v->reg[b] : temporary;
        const bool entered = b == p->inserted, whole = !entered || all_after(g, v, b);

        if (whole && now == (entered ? BEFORE : AFTER))
            continue;
        if (!s->further && (whole || now == BEFORE))
            move_on(g, v, b, p->blocks, to);
        else if (v->reg[b] < 0)
            qdot_x86_emit(&g->x, QDOT_X86_LOAD_ALL, to, 0, block_at(v, b));
        if (whole || now == BEFORE) {
            if (entered && whole)
                g->x.mask = older_lanes;
            multiply(g, to, other, m, last, b);
            g->x.mask = 0;
        }
        if (whole || now == AFTER) {
            if (entered && qdot_code_rows_as_they_stand(g))
                g->x.mask = known_lanes;
            multiply(g, to, last, m, other, b);
            g->x.mask = 0;
        }
        if (v->reg[b] < 0)
            qdot_x86_emit(&g->x, QDOT_X86_STORE_ALL, to, 0, block_at(v, b));
    }
}

void
qdot_code_add_order(qdot_generator *g, const qdot_code_phase *p, int m)
{
    g->spread[0] = g->spread[1] = QDOT_CODE_NONE;
    for (size_t i = 0; i < g->sums.n; i++)
        add_order(g, p, g->sums.at + i, m, BEFORE);
    for (size_t i = 0; p->inserted >= 0 && !qdot_code_rows_as_they_stand(g) && i < g->rows.n;
         i++)
        insert(g, g->rows.at + i, g->row_of.at[i], m, p->inserted);
    for (size_t i = 0; p->inserted >= 0 && i < g->sums.n; i++)
        add_order(g, p, g->sums.at + i, m, AFTER);
}

/* Block b of a vector becomes 0. */
static void
clear(qdot_generator *g, const qdot_code_vector *v, int b)
{
    const int reg = v->reg[b] >= 0 ? v->reg[b] : temporary;

    qdot_x86_emit(&g->x, QDOT_X86_XOR_ALL, reg, reg, qdot_x86_reg(reg));
    if (v->reg[b] < 0)
        qdot_x86_emit(&g->x, QDOT_X86_STORE_ALL, reg, 0, block_at(v, b));
}

void
qdot_code_begin_vectors(qdot_generator *g)
{
    qdot_x86_set_mask(&g->x, all_but_last, 0x7f);
}

void
qdot_code_begin_phase(qdot_generator *g, const qdot_code_phase *p, const qdot_code_phase *before)
{
    if (p->blocks > before->blocks)
        for (size_t i = 0; i < g->sums.n; i++)
            clear(g, &g->sums.at[i].v, p->blocks - 1);
    if (p->inserted < 0)
        return;
    for (size_t i = 0; !qdot_code_rows_as_they_stand(g) && i < g->rows.n; i++)
        clear(g, g->rows.at + i, p->inserted);
    qdot_x86_set_mask(&g->x, newest_lane, 1);
    qdot_x86_set_mask(&g->x, older_lanes, 0);
    qdot_x86_set_mask(&g->x, known_lanes, 1);
}

void
qdot_code_next_lane(qdot_generator *g, const qdot_code_phase *p)
{
    if (p->inserted < 0)
        return;
    qdot_x86_join_masks(&g->x, older_lanes, newest_lane);
    qdot_x86_raise_mask(&g->x, newest_lane);
    qdot_x86_join_masks(&g->x, known_lanes, newest_lane);
}
