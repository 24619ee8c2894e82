/* walk.c -- lists all subexpressions of an expression in topological order, for passes over them. */
#include "expr/walk.h"

#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/pool.h"

static uint32_t
hash_id(uint32_t e)
{
    return e * 2654435761u;
}

static size_t
find_slot_of_node(const qdot_walk *w, qdot_expr e)
{
    uint32_t i = hash_id(e) & w->mask;

    while (w->slot[i] != 0 && w->at[w->slot[i] - 1] != e)
        i = (i + 1) & w->mask;
    return i;
}

static qdot_status
enlarge_node_table(qdot_walk *w)
{
    uint32_t size = (w->mask + 1) * 2;
    uint32_t *slot = qdot_calloc(size, sizeof *slot);

    if (slot == NULL)
        return QDOT_ENOMEM;
    if (w->slot != w->few_slot)
        qdot_free(w->slot);
    w->slot = slot;
    w->mask = size - 1;
    for (size_t k = 0; k < w->n; k++)
        slot[find_slot_of_node(w, w->at[k])] = (uint32_t)k + 1;
    return QDOT_OK;
}

/* Sort ids ascending: groups of 8 by insertion (the ids come nearly in order), then by merging; scratch [n]. */
static void
sort_ids(qdot_expr *at, size_t n, qdot_expr *scratch)
{
    qdot_expr *from = at, *to = scratch;

    for (size_t i = 0; i < n; i += 8)
        for (size_t k = i + 1; k < n && k < i + 8; k++) {
            qdot_expr e = at[k];
            size_t j = k;

            for (; j > i && at[j - 1] > e; j--)
                at[j] = at[j - 1];
            at[j] = e;
        }
    for (size_t width = 8; width < n; width *= 2) {
        qdot_expr *swap = from;

        for (size_t a = 0; a < n; a += 2 * width) {
            size_t b = a + width < n ? a + width : n,
                   c = a + 2 * width < n ? a + 2 * width : n;
            size_t i = a, k = b;

            for (size_t m = a; m < c; m++)
                to[m] = k == c || (i < b && from[i] < from[k]) ? from[i++] : from[k++];
        }
        from = to;
        to = swap;
    }
    if (from != at)
        memcpy(at, from, n * sizeof *at);
}

static qdot_status
add_node(qdot_walk *w, size_t *capacity, qdot_expr e)
{
    size_t place = find_slot_of_node(w, e);

    if (w->slot[place] != 0)
        return QDOT_OK;
    if (w->n == QDOT_WALK_FEW && w->at == w->few) {
        w->at = NULL;
        *capacity = 0;
        QDOT_TRY(qdot_grow(&w->at, capacity, 4 * QDOT_WALK_FEW, sizeof *w->at));
        memcpy(w->at, w->few, sizeof w->few);
    }
    QDOT_TRY(qdot_grow(&w->at, capacity, w->n + 1, sizeof *w->at));
    w->at[w->n++] = e;
    w->slot[place] = (uint32_t)w->n;
    return w->n * 2 > w->mask ? enlarge_node_table(w) : QDOT_OK;
}

/* Enter all nodes of the walk into its hash table. */
static void
fill_hash_table(qdot_walk *w)
{
    memset(w->slot, 0, (w->mask + 1) * sizeof *w->slot);
    for (size_t k = 0; k < w->n; k++) { /* each node occurs only once in w->at, so it is not in the table yet */
        uint32_t i = hash_id(w->at[k]) & w->mask;

        while (w->slot[i] != 0)
            i = (i + 1) & w->mask;
        w->slot[i] = (uint32_t)k + 1;
    }
}

static qdot_status
begin_walk_from_roots(const qdot_pool *pool, size_t n, const qdot_expr *roots, uint32_t holds,
                      uint32_t touches, qdot_walk *w)
{
    size_t capacity = QDOT_WALK_FEW;
    qdot_status status = QDOT_OK;

    w->pool = pool;
    w->n = 0;
    w->at = w->few;
    w->slot = w->few_slot;
    w->mask = 2 * QDOT_WALK_FEW - 1;
    w->value = NULL;
    memset(w->few_slot, 0, sizeof w->few_slot);
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        if (roots[i] != QDOT_NIL)
            status = add_node(w, &capacity, roots[i]);
    /* w->at is both queue and result: nodes after `next` have not been expanded yet */
    for (size_t next = 0; status == QDOT_OK && next < w->n; next++) {
        const qdot_expr *children = ARGS(pool, w->at[next]);
        uint32_t count = NODE(pool, w->at[next])->n;

        for (uint32_t i = 0; i < count && status == QDOT_OK; i++)
            if (holds == UINT32_MAX || WHERE(pool, children[i], holds, touches))
                status = add_node(w, &capacity, children[i]);
        if (status == QDOT_OK && qdot_interrupt_is_set())
            status = qdot_interrupt_check();
    }
    if (w->n <= QDOT_WALK_FEW)
        w->value = w->few_value;
    else if (status == QDOT_OK &&
             (w->value = qdot_malloc(w->n * sizeof *w->value)) == NULL)
        status = QDOT_ENOMEM;
    if (status != QDOT_OK) {
        qdot_walk_end(w);
        return status;
    }
    if (w->n == 0)
        return QDOT_OK;
    if (w->n > 1) {
        for (size_t i = 0, k = w->n - 1; i < k; i++, k--) { /* reverse the list, in which parents came first */
            qdot_expr e = w->at[i];

            w->at[i] = w->at[k];
            w->at[k] = e;
        }
        sort_ids(w->at, w->n, (qdot_expr *)w->value);
        fill_hash_table(w);
    }
    memset(w->value, 0, w->n * sizeof *w->value);
    return QDOT_OK;
}

qdot_status
qdot_walk_begin_n(const qdot_pool *pool, size_t n, const qdot_expr *roots, qdot_walk *w)
{
    return begin_walk_from_roots(pool, n, roots, UINT32_MAX, 0, w);
}

qdot_status
qdot_walk_begin(const qdot_pool *pool, qdot_expr e, qdot_walk *w)
{
    return begin_walk_from_roots(pool, 1, &e, UINT32_MAX, 0, w);
}

qdot_status
qdot_walk_begin_where(const qdot_pool *pool, qdot_expr e, uint32_t holds,
                      uint32_t touches, qdot_walk *w)
{
    return begin_walk_from_roots(pool, 1, &e, holds, touches, w);
}

/* A node of a walk and its position in the new order of the nodes. */
typedef struct {
    qdot_expr e;
    size_t place;
} met;

/* List all nodes in the order in which they are met from the roots, parents first. Overwrites their values. */
static void
list_reachable(qdot_walk *w, size_t n, const qdot_expr *roots, met *m)
{
    size_t known = 0;

    memset(w->value, 0, w->n * sizeof *w->value);
    for (size_t next = 0, root = 0; root < n || next < known;) {
        const bool at_root = root < n;
        const qdot_expr *e = at_root ? roots + root++ : ARGS(w->pool, m[next].e);
        const uint32_t count = at_root ? *e != QDOT_NIL : NODE(w->pool, m[next++].e)->n;

        for (uint32_t i = 0; i < count; i++)
            if (!qdot_walk_get(w, e[i])) {
                qdot_walk_set(w, e[i], 1);
                m[known++].e = e[i];
            }
    }
}

/* Store the height of every node of the expression tree (0 if it has no children) as its value; returns the largest. */
static size_t
compute_heights(qdot_walk *w)
{
    uint64_t most = 0;

    for (size_t k = 0; k < w->n; k++) {
        const qdot_expr *children = ARGS(w->pool, w->at[k]);
        uint64_t height = 0;

        for (uint32_t i = 0; i < NODE(w->pool, w->at[k])->n; i++) {
            const uint64_t child = qdot_walk_get(w, children[i]);

            height = child >= height ? child + 1 : height;
        }
        w->value[k] = height;
        most = height > most ? height : most;
    }
    return (size_t)most;
}

qdot_status
qdot_walk_begin_by_height(const qdot_pool *pool, size_t n, const qdot_expr *roots,
                          qdot_walk *w)
{
    met *m;
    size_t *first; /* [heights] position of the first node of each height */
    size_t most;

    QDOT_TRY(begin_walk_from_roots(pool, n, roots, UINT32_MAX, 0, w));
    if (w->n == 0)
        return QDOT_OK;
    m = qdot_malloc(w->n * sizeof *m);
    first = qdot_calloc(w->n + 1, sizeof *first);
    if (m == NULL || first == NULL) {
        qdot_free(m);
        qdot_free(first);
        qdot_walk_end(w);
        return QDOT_ENOMEM;
    }
    list_reachable(w, n, roots, m);
    most = compute_heights(w);
    for (size_t k = 0; k < w->n; k++)
        first[w->value[k] + 1]++;
    for (size_t height = 0; height < most; height++)
        first[height + 1] += first[height];
    for (size_t k = 0; k < w->n; k++)
        m[k].place = first[qdot_walk_get(w, m[k].e)]++;
    for (size_t k = 0; k < w->n; k++)
        w->at[m[k].place] = m[k].e;
    fill_hash_table(w);
    memset(w->value, 0, w->n * sizeof *w->value);
    qdot_free(m);
    qdot_free(first);
    return QDOT_OK;
}

void
qdot_walk_end(qdot_walk *w)
{
    if (w->at != w->few)
        qdot_free(w->at);
    if (w->slot != w->few_slot)
        qdot_free(w->slot);
    if (w->value != w->few_value)
        qdot_free(w->value);
    w->at = NULL;
    w->slot = NULL;
    w->value = NULL;
    w->n = 0;
}

size_t
qdot_walk_index(const qdot_walk *w, qdot_expr e)
{
    uint32_t slot = w->slot[find_slot_of_node(w, e)];

    return slot == 0 ? SIZE_MAX : slot - 1;
}

uint64_t
qdot_walk_get(const qdot_walk *w, qdot_expr e)
{
    return w->value[qdot_walk_index(w, e)];
}

void
qdot_walk_set(qdot_walk *w, qdot_expr e, uint64_t value)
{
    w->value[qdot_walk_index(w, e)] = value;
}

qdot_expr
qdot_walk_rebuild(qdot_pool *pool, const qdot_walk *w, qdot_expr e)
{
    uint32_t n = qdot_expr_count(pool, e);
    qdot_expr few[32], *args = n > 32 ? qdot_malloc(n * sizeof *args) : few;
    bool changed = false;

    if (args == NULL)
        return qdot_pool_fail(pool);
    for (uint32_t i = 0; i < n; i++) {
        qdot_expr old = qdot_expr_arg(pool, e, i);

        args[i] = (qdot_expr)qdot_walk_get(w, old);
        changed |= args[i] != old;
    }
    if (changed)
        e = qdot_rebuild(pool, e, args);
    if (args != few)
        qdot_free(args);
    return e;
}

qdot_expr
qdot_walk_map_where(qdot_pool *pool, qdot_expr e, uint32_t holds, uint32_t touches,
                    qdot_expr (*leaf)(qdot_pool *pool, qdot_expr node, void *user),
                    void *user)
{
    qdot_walk w;
    qdot_vec(qdot_expr) args = {0};
    qdot_expr few[32], *own = few, result = QDOT_NIL;

    if (e == QDOT_NIL || FAILED(pool))
        return QDOT_NIL;
    if (qdot_walk_begin_where(pool, e, holds, touches, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n; i++) {
        qdot_expr node = w.at[i], to = leaf(pool, node, user);
        uint32_t n = NODE(pool, node)->n;

        if (to == QDOT_NIL && !FAILED(pool)) {
            to = node;
            if (n > 32) {
                if (qdot_grow(&args.at, &args.capacity, n, sizeof *args.at) != QDOT_OK) {
                    qdot_pool_fail(pool);
                    break;
                }
                own = args.at;
            }
            for (uint32_t k = 0; k < n; k++) {
                own[k] = ARGS(pool, node)[k];
                if (holds == UINT32_MAX || WHERE(pool, own[k], holds, touches))
                    own[k] = (qdot_expr)qdot_walk_get(&w, own[k]);
            }
            if (n > 0)
                to = qdot_rebuild(pool, node, own);
        }
        if (to == QDOT_NIL)
            break;
        w.value[i] = to;
        result = to;
    }
    if (FAILED(pool))
        result = QDOT_NIL;
    qdot_free(args.at);
    qdot_walk_end(&w);
    return result;
}

qdot_expr
qdot_walk_map(qdot_pool *pool, qdot_expr e,
              qdot_expr (*leaf)(qdot_pool *pool, qdot_expr node, void *user), void *user)
{
    return qdot_walk_map_where(pool, e, UINT32_MAX, 0, leaf, user);
}

qdot_expr
qdot_walk_replace(qdot_pool *pool, qdot_expr e, qdot_kind kind,
                  qdot_expr (*f)(qdot_pool *pool, qdot_expr node, void *user), void *user)
{
    qdot_expr result = e;
    qdot_walk w;

    if (e == QDOT_NIL || qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return e;
    for (size_t i = 0; i < w.n && result != QDOT_NIL; i++) {
        result = qdot_walk_rebuild(pool, &w, w.at[i]);
        if (result != QDOT_NIL && qdot_expr_kind(pool, result) == kind)
            result = f(pool, result, user);
        qdot_walk_set(&w, w.at[i], result);
    }
    qdot_walk_end(&w);
    return result;
}

size_t
qdot_expr_place(size_t n, const qdot_expr *list, qdot_expr e)
{
    size_t i = 0;

    while (i < n && list[i] != e)
        i++;
    return i;
}

bool
qdot_expr_contains(const qdot_pool *pool, qdot_expr e, qdot_expr x)
{
    qdot_walk w;
    bool found;

    if (e == QDOT_NIL || x == QDOT_NIL || x > e ||
        (NODE(pool, e)->touches & NODE(pool, x)->touches) != NODE(pool, x)->touches)
        return false;
    if (qdot_walk_begin_where(pool, e, NODE(pool, x)->touches == 0 ? UINT32_MAX : 0,
                              NODE(pool, x)->touches, &w) != QDOT_OK)
        return false;
    found = qdot_walk_index(&w, x) != SIZE_MAX;
    qdot_walk_end(&w);
    return found;
}

bool
qdot_expr_contains_any(const qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *x)
{
    for (size_t j = 0; j < n; j++)
        if (qdot_expr_contains(pool, e, x[j]))
            return true;
    return false;
}

bool
qdot_expr_has_function_of(const qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *x)
{
    qdot_walk w;
    bool found = false;

    if (e == QDOT_NIL || qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return false;
    for (size_t i = 0; i < w.n && !found; i++)
        found = qdot_expr_kind(pool, w.at[i]) == QDOT_FUN && qdot_expr_contains_any(pool, w.at[i], n, x);
    qdot_walk_end(&w);
    return found;
}

bool
qdot_expr_is_in_any(const qdot_pool *pool, qdot_expr x, size_t n, const qdot_expr *e)
{
    for (size_t i = 0; i < n; i++)
        if (qdot_expr_contains(pool, e[i], x))
            return true;
    return false;
}

qdot_expr
qdot_expr_bases_of_powers(qdot_pool *pool, size_t n, const qdot_expr *F, size_t m, const qdot_expr *x)
{
    qdot_walk w;
    qdot_vec(qdot_expr) found = {0};
    qdot_expr list;

    if (qdot_walk_begin_n(pool, n, F, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n; i++) {
        const uint32_t count = qdot_expr_kind(pool, w.at[i]) == QDOT_PROD ? qdot_expr_count(pool, w.at[i]) : 0;

        for (uint32_t k = 1; k + 1 < count; k += 2)
            if (qdot_expr_contains_any(pool, qdot_expr_arg(pool, w.at[i], k + 1), m, x) &&
                qdot_vec_push(&found, qdot_expr_arg(pool, w.at[i], k)) != QDOT_OK)
                qdot_pool_fail(pool);
    }
    qdot_walk_end(&w);
    list = qdot_list(pool, (uint32_t)found.n, found.at);
    qdot_free(found.at);
    return list;
}

static int
compare_exprs(const void *a, const void *b, void *pool)
{
    return qdot_expr_compare(pool, *(const qdot_expr *)a, *(const qdot_expr *)b);
}

qdot_expr
qdot_expr_atoms(qdot_pool *pool, qdot_expr e, bool ufuns)
{
    qdot_walk w;
    qdot_vec(qdot_expr) found = {0};
    qdot_expr list;

    if (e == QDOT_NIL)
        return QDOT_NIL;
    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return qdot_pool_fail(pool);
    for (size_t i = 0; i < w.n; i++) {
        const qdot_node *node = NODE(pool, w.at[i]);

        if ((node->kind == QDOT_SYM && (node->holds & ~(uint32_t)(QDOT_HAS_BOUND | QDOT_HAS_INFINITY)) != 0) ||
            (ufuns && node->kind == QDOT_UFUN))
            if (qdot_vec_push(&found, w.at[i]) != QDOT_OK)
                qdot_pool_fail(pool);
    }
    qdot_walk_end(&w);
    if (found.n > 0)
        qsort_r(found.at, found.n, sizeof *found.at, compare_exprs, pool);
    list = qdot_list(pool, (uint32_t)found.n, found.at);
    qdot_free(found.at);
    return list;
}
