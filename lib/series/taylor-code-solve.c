/* taylor-code-solve.c -- writes machine code that solves M_0 a_k = f_k - sum_{j=1..k} M_j a_{k-j}
 * for unknowns. */
#include "series/taylor-code-sum.h"

/* Where entry (i, j) of a block's Cholesky factor L is stored; from i = n on, entry (i - n, j) of the inverse M_0^-1. */
static qdot_operand
place_of_factor_entry(const qdot_generator *g, size_t block, size_t i, size_t j)
{
    return qdot_code_work(g->block_slots[block] + i * g->t->blocks[block].n + j);
}

static qdot_operand
place_of_inverse_entry(const qdot_generator *g, size_t block, size_t i, size_t j)
{
    return place_of_factor_entry(g, block, g->t->blocks[block].n + i, j);
}

/* Make room for `more` terms of a sum: if there is none, add up the present ones in a register first. */
static void
sum_make_room(qdot_generator *g, sum *s, int more)
{
    if (s->n + more <= QDOT_CODE_TERMS)
        return;
    s->v = total(g, s);
    s->n = 0;
}

/* Terms of products M a of row i that the vectors do not have: `late`, those with order k of
 * M, which are known after the others. */
static void
add_products_with_unknowns(qdot_generator *g, const qdot_taylor_block *b, size_t i, bool late, sum *s)
{
    for (size_t c = 0; c < b->n_couplings; c++) {
        const qdot_taylor_coupling *m = b->couplings + c;

        if (m->i != i)
            continue;
        sum_make_room(g, s, 2);
        if (late)
            sum_add_scaled(g, s, true, code_at(g, m->a, 0), m->M, g->k);
        else
            lately(g, s, true, code_at(g, m->M, 1), m->a, code_at(g, m->a, 1), m->M);
    }
}

static void
write_right_hand_side(qdot_generator *g, const qdot_taylor_block *b, size_t i)
{
    sum s = {.v = {.reg = -1}};

    add_past_of(g, &s, true, NULL, g->unknown_sums[qdot_code_row(g, b->r[i])]);
    add_products_with_unknowns(g, b, i, false, &s);
    add_products_with_unknowns(g, b, i, true, &s);
    sum_make_room(g, &s, 1);
    sum_add_row(g, &s, false, b->f[i]);
    finish_sum(g, &s, b->r[i]);
}

/* The sum over entry i of the diagonal: the rounding of its inverse would be that of every
 * order. */
static void
divide_by_diagonal(qdot_generator *g, size_t block, size_t i, sum *s)
{
    s->v = total(g, s);
    s->n = 0;
    scale_by(g, QDOT_ASM_DIV, &s->v, place_of_factor_entry(g, block, i, i));
}

/* Write the code that solves for a block of unknowns by the Cholesky factor: r becomes L^-1 r, then a = L^-T r. */
static void
write_solution_by_factor(qdot_generator *g, size_t block)
{
    const qdot_taylor_block *b = g->t->blocks + block;

    for (size_t i = 0; i < b->n; i++) {
        sum s = {.v = {.reg = -1}};

        sum_add_row(g, &s, false, b->r[i]);
        for (size_t j = 0; j < i; j++) {
            sum_make_room(g, &s, 1);
            sum_add_scaled(g, &s, true, place_of_factor_entry(g, block, i, j), b->r[j], g->k);
        }
        divide_by_diagonal(g, block, i, &s);
        finish_sum(g, &s, b->r[i]);
    }
    for (size_t i = b->n; i-- > 0;) {
        sum s = {.v = {.reg = -1}};

        sum_add_row(g, &s, false, b->r[i]);
        for (size_t j = i + 1; j < b->n; j++) {
            sum_make_room(g, &s, 1);
            sum_add_scaled(g, &s, true, place_of_factor_entry(g, block, j, i), b->a[j], g->k);
        }
        divide_by_diagonal(g, block, i, &s);
        finish_sum(g, &s, b->a[i]);
    }
}

static void
write_solution_by_inverse(qdot_generator *g, size_t block)
{
    const qdot_taylor_block *b = g->t->blocks + block;

    for (size_t i = 0; i < b->n; i++) {
        sum s = {.v = {.reg = -1}};

        for (size_t j = 0; j < b->n; j++) {
            sum_make_room(g, &s, 1);
            sum_add_scaled(g, &s, false, place_of_inverse_entry(g, block, i, j), b->r[j], g->k);
        }
        finish_sum(g, &s, b->a[i]);
    }
}

void
qdot_code_solve(qdot_generator *g, size_t block)
{
    const qdot_taylor_block *b = g->t->blocks + block;

    for (size_t i = 0; i < b->n; i++)
        write_right_hand_side(g, b, i);
    if (g->k <= b->solved)
        write_solution_by_factor(g, block);
    else
        write_solution_by_inverse(g, block);
}
