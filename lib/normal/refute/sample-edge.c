/* sample-edge.c -- sample points at which two sides of an equation may differ although they agree nearby. */
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "normal/refute/sample.h"

/* The rational x of a constant x or x pi; *turn tells that it is x pi. */
static bool
read_number_or_multiple_of_pi(const qdot_pool *pool, qdot_expr e, fmpq_t x, bool *turn)
{
    const fmpq *c = qdot_expr_rational(pool, e);

    *turn = c == NULL;
    if (e == QDOT_PI) {
        fmpq_one(x);
        return true;
    }
    if (*turn && qdot_expr_kind(pool, e) == QDOT_PROD && qdot_expr_count(pool, e) == 3 &&
        qdot_expr_arg(pool, e, 1) == QDOT_PI && qdot_expr_arg(pool, e, 2) == QDOT_ONE)
        c = qdot_expr_rational(pool, qdot_expr_arg(pool, e, 0));
    if (c != NULL)
        fmpq_set(x, c);
    return c != NULL;
}

/* Set x to the i-th special value of a symbol, such as a bound of its domain; false if there is none. */
static bool
special_value(const qdot_pool *pool, qdot_sample_atom *a, int i, fmpq_t x)
{
    static const struct {
        slong n;
        ulong d;
        bool turn;
    } edges[] = {{0, 1, false}, {1, 1, false},  {-1, 1, false}, {1, 2, true},
                 {1, 1, true},  {-1, 2, true}, {-1, 1, true},  {1, 4, true}};
    const int plain = sizeof edges / sizeof *edges;
    const qdot_symbol *symbol = qdot_expr_symbol(pool, a->atom);

    if (i < plain) {
        fmpq_set_si(x, edges[i].n, edges[i].d);
        a->turn = edges[i].turn;
        return true;
    }
    if (symbol == NULL)
        return false;
    a->edge = true;
    return i == plain ? symbol->lo != QDOT_NIL && !symbol->lo_open &&
                            read_number_or_multiple_of_pi(pool, symbol->lo, x, &a->turn)
                      : symbol->hi != QDOT_NIL && !symbol->hi_open &&
                            read_number_or_multiple_of_pi(pool, symbol->hi, x, &a->turn);
}

enum { EDGES = 10 };

bool
qdot_sample_edge(qdot_sample *s, int k)
{
    size_t free = 0, i, j;
    qdot_sample_atom *a, *b;

    qdot_sample_point(s, k);
    while (free < s->n && s->atom[free].solution == QDOT_NIL)
        free++;
    i = (size_t)k / (EDGES + 2 * free);
    j = (size_t)k % (EDGES + 2 * free);
    if (free == 0 || i >= free)
        return false;
    a = &s->atom[i];
    if (qdot_sample_is_sign(s->pool, a->atom))
        return true;
    if (j < EDGES) {
        fmpq_t x;

        fmpq_init(x);
        if (special_value(s->pool, a, (int)j, x))
            fmpq_set(&a->x, x);
        else
            a->turn = a->edge = false;
        fmpq_clear(x);
    } else {
        b = &s->atom[(j - EDGES) / 2];
        fmpq_set(&a->x, &b->x);
        a->turn = b->turn;
        if (j % 2 != 0)
            fmpq_neg(&a->x, &a->x);
    }
    qdot_sample_set(a, 64);
    return true;
}
