/* taylor-code-vectors.c -- machine code that adds the products of a new order to vectors of sums. */
#include "series/taylor-generator.h"

enum {
    /* if sums and rows need more vectors than this, most of them are kept in memory */
    many_vectors = 40,
    temporary = 0,
    spare = 1,
    spread_first = 2,
    own_spreads = 2
};

/* The two parts of adding an order to sums: before the vectors of the rows contain this order, and after. */
typedef enum { BEFORE, AFTER } part;

/* The coefficients of a row, from order `lag` on, are its vector as they stand: by AVX2, whose
 * registers are few, and in long programs with a lag of 1. A vector read soon after one of its
 * numbers was written waits for that to leave the processor (8 to 30 % of shorter programs with
 * AVX-512). */
bool
qdot_code_rows_as_they_stand(const qdot_generator *g)
{
    return qdot_code_is_narrow(g->lanes) ||
           (g->lag == 1 && g->sums.n + g->rows.n > many_vectors);
}

static qdot_operand
operand_of_vector_part(const qdot_generator *g, const qdot_code_vector *v, int b)
{
    return v->reg[b] >= 0 ? qdot_asm_in(v->reg[b])
                          : qdot_code_work(v->at + (size_t)(g->lanes * b));
}

/* Insert coefficient m of a row into its vector, beside the coefficients of lower orders. */
static void
insert_coefficient(qdot_generator *g, const qdot_code_vector *v, uint32_t row, int m, int b)
{
    const int reg = v->reg[b] >= 0 ? v->reg[b] : temporary;

    if (v->reg[b] < 0)
        do_all(g, QDOT_ASM_LOAD, reg, 0, operand_of_vector_part(g, v, b));
    qdot_asm_insert(&g->m, reg, qdot_code_coefficient(g, row, m));
    if (v->reg[b] < 0)
        do_all(g, QDOT_ASM_STORE, reg, 0, operand_of_vector_part(g, v, b));
}

/* None holds anything. Narrow vectors wait for what is loaded: while they are at work the registers
 * of single numbers, none of which is held by then, are for this, too. */
static void
forget_spread_coefficients(qdot_generator *g)
{
    g->spreads = own_spreads;
    if (qdot_code_is_narrow(g->lanes))
        g->spreads += g->behind_scalars - g->first_scalar;
    for (int i = 0; i < g->spreads; i++)
        g->spread[i] = QDOT_CODE_NONE;
}

/* The register that holds coefficient m of a row in every lane. */
static int
spread_coefficient(qdot_generator *g, uint32_t row, int m)
{
    int i = 0, reg;

    while (i < g->spreads && g->spread[i] != row)
        i++;
    if (i == g->spreads)
        i = g->next_spread;
    reg = i < own_spreads ? spread_first + i : g->first_scalar + i - own_spreads;
    if (g->spread[i] == row)
        return reg;
    g->next_spread = (i + 1) % g->spreads;
    g->spread[i] = row;
    do_all(g, QDOT_ASM_SPREAD, reg, 0, qdot_code_coefficient(g, row, m));
    return reg;
}

/* Add coefficient m of a row times part b of another row's vector to a register, in the given lanes. */
static void
add_multiple(qdot_generator *g, int to, uint32_t row, int m, uint32_t other, int b,
             qdot_asm_lane_set lanes)
{
    const qdot_code_vector *v = &g->rows.at[g->row_vector[other]];

    if (v->reg[b] >= 0) {
        qdot_operand one = qdot_code_coefficient(g, row, m);

        one.spread = true;
        do_all(g, QDOT_ASM_MADD, to, v->reg[b], one);
    } else {
        const int one = spread_coefficient(g, row, m);

        qdot_asm_add_product(&g->m, to, one,
                             g->as_they_stand
                                 ? qdot_code_coefficient(g, other, g->lag + g->lanes * b)
                                 : operand_of_vector_part(g, v, b),
                             lanes, spare);
    }
}

/* Shift part b of a sum, of `blocks` vectors, by one order, into register `to`. */
static void
shift_by_one_order(qdot_generator *g, const qdot_code_vector *v, int b, int blocks, int to)
{
    const bool last = b + 1 == blocks;
    const qdot_operand high = last ? (qdot_operand){0} : operand_of_vector_part(g, v, b + 1);

    if (g->reread)
        do_all(g, QDOT_ASM_LOAD, to, 0,
               qdot_code_work(v->at + (size_t)(g->lanes * b + 1)));
    else
        qdot_asm_slide(&g->m, to, operand_of_vector_part(g, v, b), last ? NULL : &high, spare);
}

/* Whether the rows' vectors contain order m before anything is added to part b of a sum. */
static bool
adds_only_after_insertion(const qdot_generator *g, const qdot_code_vector *v, int b)
{
    return v->reg[b] < 0 || g->as_they_stand;
}

/* What is made of order m and those from `lag` up to it, in a phase. What is known last is
 * multiplied last; where the other row has not got order m yet that is no part of the first
 * product. */
static void
add_order_to_sum(qdot_generator *g, const qdot_code_phase *p, const qdot_code_sum *s, int m, part now)
{
    const qdot_code_vector *v = &s->v;
    const bool x_last = *qdot_code_ready(g, s->x, m) >= *qdot_code_ready(g, s->y, m);
    const uint32_t last = x_last ? s->x : s->y, other = x_last ? s->y : s->x;

    for (int b = 0; b < p->blocks; b++) {
        const int to = v->reg[b] >= 0 ? v->reg[b] : temporary;
        const bool entered = b == p->inserted, whole = !entered || adds_only_after_insertion(g, v, b);

        if (whole && now == (entered ? BEFORE : AFTER))
            continue;
        if (!s->further && (whole || now == BEFORE))
            shift_by_one_order(g, v, b, p->blocks, to);
        else if (v->reg[b] < 0)
            do_all(g, QDOT_ASM_LOAD, to, 0, operand_of_vector_part(g, v, b));
        if (whole || now == BEFORE)
            add_multiple(g, to, other, m, last, b,
                         entered && whole ? QDOT_ASM_OLDER_LANES : QDOT_ASM_ALL_LANES);
        if (whole || now == AFTER)
            add_multiple(g, to, last, m, other, b,
                         entered && g->as_they_stand ? QDOT_ASM_KNOWN_LANES
                                                 : QDOT_ASM_ALL_LANES);
        if (v->reg[b] < 0)
            do_all(g, QDOT_ASM_STORE, to, 0, operand_of_vector_part(g, v, b));
    }
}

void
qdot_code_add_order(qdot_generator *g, const qdot_code_phase *p, int m)
{
    forget_spread_coefficients(g);
    for (size_t i = 0; i < g->sums.n; i++)
        add_order_to_sum(g, p, g->sums.at + i, m, BEFORE);
    for (size_t i = 0; p->inserted >= 0 && !g->as_they_stand && i < g->rows.n; i++)
        insert_coefficient(g, g->rows.at + i, g->row_of.at[i], m, p->inserted);
    for (size_t i = 0; p->inserted >= 0 && i < g->sums.n; i++)
        add_order_to_sum(g, p, g->sums.at + i, m, AFTER);
}

/* Write code that sets a vector to 0. */
static void
clear_vector(qdot_generator *g, const qdot_code_vector *v)
{
    for (int b = 0; b < g->blocks; b++) {
        const int reg = v->reg[b] >= 0 ? v->reg[b] : temporary;

        qdot_asm_clear(&g->m, reg);
        if (v->reg[b] < 0)
            do_all(g, QDOT_ASM_STORE, reg, 0, operand_of_vector_part(g, v, b));
    }
}

void
qdot_code_begin_vectors(qdot_generator *g)
{
    for (size_t i = 0; i < g->sums.n; i++)
        if (!g->sums.at[i].further)
            clear_vector(g, &g->sums.at[i].v);
    for (size_t i = 0; !g->as_they_stand && i < g->rows.n; i++)
        clear_vector(g, g->rows.at + i);
    qdot_asm_begin_lanes(&g->m);
}

void
qdot_code_begin_phase(qdot_generator *g, const qdot_code_phase *p)
{
    if (p->inserted >= 0)
        qdot_asm_first_lane(&g->m, qdot_code_work(QDOT_CODE_ONES));
}

void
qdot_code_next_lane(qdot_generator *g, const qdot_code_phase *p)
{
    if (p->inserted >= 0)
        qdot_asm_next_lane(&g->m);
}
