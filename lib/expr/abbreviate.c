/* abbreviate.c -- finds the parts that an expression repeats, and names them. */
#include "expr/abbreviate.h"

#include <stdio.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"

void
qdot_abbreviated_clear(qdot_abbreviated *a)
{
    qdot_free(a->symbols.at);
    qdot_free(a->parts.at);
    *a = (qdot_abbreviated){0};
}

static bool
may_be_abbreviated(const qdot_pool *pool, qdot_expr e)
{
    const qdot_kind kind = qdot_expr_kind(pool, e);

    return (kind == QDOT_SUM || kind == QDOT_PROD || kind == QDOT_FUN) &&
           qdot_expr_is_scalar(pool, e);
}

/* The number of places of each node, parents first; a part's children stand there once. named [w.n]:
 * which nodes are parts. */
static void
count_occurrences(const qdot_pool *pool, qdot_walk *w, qdot_expr root, bool *named)
{
    const uint64_t most = UINT32_MAX;

    qdot_walk_set(w, root, 1);
    for (size_t i = w->n; i-- > 0;) {
        const qdot_expr e = w->at[i];
        uint64_t places = qdot_walk_get(w, e), size;

        if (places > 1 && may_be_abbreviated(pool, e)) {
            size = qdot_expr_size(pool, e);
            named[i] = size >= 2 && (places - 1) * (size < most ? size : most) >=
                                        QDOT_ABBREVIATE_SAVED;
        }
        if (named[i])
            places = 1;
        for (uint32_t k = 0; k < qdot_expr_count(pool, e); k++) {
            const qdot_expr child = qdot_expr_arg(pool, e, k);
            const uint64_t sum = qdot_walk_get(w, child) + places;

            qdot_walk_set(w, child, sum < most ? sum : most);
        }
    }
}

/* The next symbol D1, D2, ... whose name is free. */
static qdot_expr
next_free_symbol(qdot_pool *pool, bool (*is_taken)(const char *name, void *user), void *user,
                 unsigned *number)
{
    char name[24];

    do
        snprintf(name, sizeof name, "D%u", ++*number);
    while (is_taken(name, user));
    return qdot_symbol_get(pool, QDOT_FORMAL, name);
}

qdot_status
qdot_abbreviate(qdot_pool *pool, qdot_expr e, bool (*is_taken)(const char *name, void *user),
                void *user, qdot_abbreviated *out)
{
    qdot_walk w;
    qdot_status status = QDOT_OK;
    unsigned number = 0;
    bool *named;

    *out = (qdot_abbreviated){.whole = e};
    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    named = qdot_calloc(w.n + 1, sizeof *named);
    if (named == NULL)
        status = QDOT_ENOMEM;
    else
        count_occurrences(pool, &w, e, named);
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++) {
        qdot_expr made = qdot_walk_rebuild(pool, &w, w.at[i]);

        if (named[i] && made != QDOT_NIL) {
            status = qdot_vec_push(&out->parts, made);
            made = next_free_symbol(pool, is_taken, user, &number);
            if (status == QDOT_OK)
                status = qdot_vec_push(&out->symbols, made);
        }
        qdot_walk_set(&w, w.at[i], made);
        out->whole = made;
        if (made == QDOT_NIL && status == QDOT_OK)
            status = qdot_pool_check(pool);
    }
    qdot_free(named);
    qdot_walk_end(&w);
    return status;
}
