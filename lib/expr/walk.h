/* walk.h -- passes over an expression: loops over its nodes, children first.
 *
 *     qdot_walk w;
 *     QDOT_TRY(qdot_walk_begin(pool, e, &w));
 *     for (size_t i = 0; i < w.n; i++)
 *         ... w.at[i] ...  children stand before their parents; qdot_walk_get(&w, child)
 *         qdot_walk_set(&w, w.at[i], value);
 *     qdot_walk_end(&w);
 *
 * Each reachable node once, so the work is that of the DAG, not of the tree.
 */
#ifndef QDOT_EXPR_WALK_H
#define QDOT_EXPR_WALK_H

#include "expr/id.h"

enum { QDOT_WALK_FEW = 32 };

/* The list of all subexpressions of an expression. Must not be copied: with few nodes it points into itself. */
typedef struct qdot_walk {
    const qdot_pool *pool;
    qdot_expr *at;   /* [n] nodes, ascending by id or by height, children before parents; owned */
    size_t n;
    uint32_t *slot;  /* open hash table from node id to index + 1; owned */
    uint32_t mask;
    uint64_t *value; /* [n] a 64-bit value for each node, 0 at first; owned */
    qdot_expr few[QDOT_WALK_FEW];
    uint32_t few_slot[2 * QDOT_WALK_FEW];
    uint64_t few_value[QDOT_WALK_FEW];
} qdot_walk;

/* Walk over all nodes reachable from e (nil: none). Errors: QDOT_ENOMEM, QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_walk_begin(const qdot_pool *pool, qdot_expr e, qdot_walk *w);
/* Begin a walk over the nodes reachable from several roots. */
QDOT_MUST_CHECK qdot_status qdot_walk_begin_n(const qdot_pool *pool, size_t n,
                                              const qdot_expr *roots, qdot_walk *w);
/* The same, nodes by their heights, those of one height in the order in which they are reached
 * from the roots. This order does not depend on when nodes were made, and neighbours in it rarely
 * depend on each other. */
QDOT_MUST_CHECK qdot_status qdot_walk_begin_by_height(const qdot_pool *pool, size_t n,
                                                      const qdot_expr *roots, qdot_walk *w);
void qdot_walk_end(qdot_walk *w);

/* The index of a node in the walk; SIZE_MAX if it is not reachable. */
size_t qdot_walk_index(const qdot_walk *w, qdot_expr e);
uint64_t qdot_walk_get(const qdot_walk *w, qdot_expr e); /* e must be reachable from the roots */
void qdot_walk_set(qdot_walk *w, qdot_expr e, uint64_t value);

/* Rebuild e from the leaves: `leaf` is called for every node first and returns its replacement,
 * or nil to rebuild it from the replaced children. */
qdot_expr qdot_walk_map(qdot_pool *pool, qdot_expr e,
                        qdot_expr (*leaf)(qdot_pool *pool, qdot_expr node, void *user),
                        void *user);

/* Rebuild e from the leaves: every node of a kind, with replaced children, is replaced by f of
 * it. Nil: f returned nil, or the pool failed; e itself if there is no memory for the walk. */
qdot_expr qdot_walk_replace(qdot_pool *pool, qdot_expr e, qdot_kind kind,
                            qdot_expr (*f)(qdot_pool *pool, qdot_expr node, void *user),
                            void *user);

/* A node of the walk rebuilt with the values of its children as args; itself if these are
 * unchanged. Nil: the pool keeps the failure. */
qdot_expr qdot_walk_rebuild(qdot_pool *pool, const qdot_walk *w, qdot_expr e);

/* The index of e in list [n]; n if it is not there. */
size_t qdot_expr_place(size_t n, const qdot_expr *list, qdot_expr e);

/* Whether x (any node) occurs in e; in nil nothing does. */
bool qdot_expr_contains(const qdot_pool *pool, qdot_expr e, qdot_expr x);
/* Whether one of x [n] occurs in e; whether x occurs in one of e [n]. */
bool qdot_expr_contains_any(const qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *x);
bool qdot_expr_is_in_any(const qdot_pool *pool, qdot_expr x, size_t n, const qdot_expr *e);
/* Whether a function of one of x [n], such as sign(x), occurs in e. Also false: no memory for the walk. */
bool qdot_expr_has_function_of(const qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *x);

/* The bases of all powers in F [n] whose exponents contain one of the x [m], as a LIST. Nil: the pool failed. */
qdot_expr qdot_expr_bases_of_powers(qdot_pool *pool, size_t n, const qdot_expr *F, size_t m, const qdot_expr *x);

/* The symbols (and, if asked, applications of undefined functions) that occur in e, in the
 * order of qdot_expr_compare, as a LIST. */
qdot_expr qdot_expr_atoms(qdot_pool *pool, qdot_expr e, bool ufuns);

/* Operations in e as a tree, saturating at UINT64_MAX: n - 1 for a sum or product of n, 1 for a
 * power, a division, a sign, a function. */
uint64_t qdot_expr_size(const qdot_pool *pool, qdot_expr e);

#endif
