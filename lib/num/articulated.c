/* articulated.c -- factors a mass matrix along a tree of bodies; solves with vectors along a path, else node by node. */
#include "num/articulated.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "num/kinds.h"

enum {
    most = QDOT_ARTICULATED_COMPONENTS,
    most_unknowns = QDOT_ARTICULATED_UNKNOWNS,
    pieces = 8
};

#define NONE QDOT_ARTICULATED_NONE

/* The elimination compiled for nodes of a tree with m components and c unknowns each. */
typedef struct {
    size_t m, c;
    void (*chain)(qdot_articulated *a);
    void (*path)(qdot_articulated *a, const qdot_articulated_equations *e);
} kernels;

/* For short paths in a plane. `eliminate` returns the least ratio of a pivot to its diagonal entry; NaN
 * or not positive if a pivot is not positive. */
typedef struct {
    double (*eliminate)(qdot_articulated *a, const double *const *S);
    void (*path)(const qdot_articulated *a, const qdot_articulated_equations *e);
} plane_kernels;

struct qdot_articulated {
    size_t nodes, m, c, slots;
    const plane_kernels *plane; /* kernels for a short path of bodies in a plane; NULL: not such a tree */
    const kernels *kernels; /* compiled elimination for nodes of this size; NULL: none */
    bool path;
    size_t *slot;     /* [nodes] index of each node's place (slot) in the arrays */
    uint32_t *parent; /* [nodes x m] for each component that component of the parent node to which it is relative */
    uint8_t *unknowns;
    double *weight, *below; /* [nodes x m x m] weight W of a node; the sum of W over the node and its descendants */
    double *passed;         /* [nodes x m x m] the articulated inertia I summed over a node's children; scratch */
    double *numbers;        /* one allocated block that holds the arrays below */
    double *there;          /* [slots] 1 in the slot of a node, else 0 */
    double *I_0, *I, *A, *Up, *Down; /* [m x m] each; products along a part of the path to its ends */
    double *B, *H;                   /* [m x c], [c x c] blocks of the elimination of one node */
    double *d, *Z, *x, *w; /* right-hand sides and solution of a solve: d, Z [m], x, w [c] */
    double *up, *down; /* [3 x m x m] in groups of 8: products of matrices over 1, 2 and 4 parts of the path */
    /* Used only for a path of bodies in a plane (articulated-plane.def): */
    double *W, *Below;    /* [4] entries of `weight` and `below`, by slots */
    double *t, *tn, *wt;  /* [2] vectors in the plane: link t of a node, link of the next node, w */
    double *own, *ratio;  /* [slots] the factors k, and the products w.t' */
};

#define SHAPES(X) X(1, 1) X(2, 1) X(3, 1) X(3, 2)

enum { shapes = 4 };

#define NAME(x) portable_##x
#define MA(a, b, c) QDOT_VECTOR_MA(portable_vector, a, b, c)
#include "num/articulated.def"
#undef NAME
#undef MA

#ifdef QDOT_X86_KINDS
#include <immintrin.h>

QDOT_KIND_AVX2
#define NAME(x) avx2_##x
#define MA(a, b, c) ((a) * (b) + (c))
#include "num/articulated.def"
#undef NAME
#undef MA
QDOT_KIND_END

QDOT_KIND_AVX512
#define NAME(x) avx512_##x
#define MA(a, b, c)                                                                      \
    ((avx512_vector)_mm512_fmadd_pd((__m512d)(a), (__m512d)(b), (__m512d)(c)))
#include "num/articulated.def"
#undef NAME
#undef MA
QDOT_KIND_END
#endif

/* The compiled elimination for nodes of this size; NULL if there is none. */
static const kernels *
find_kernels(size_t m, size_t c)
{
    const kernels *k = portable_kernels;

#ifdef QDOT_X86_KINDS
    if (qdot_kind_is_here(2))
        k = avx512_kernels;
    else if (qdot_kind_is_here(1))
        k = avx2_kernels;
#endif
    for (size_t i = 0; i < shapes; i++)
        if (k[i].m == m && k[i].c == c)
            return k + i;
    return NULL;
}

/* --- building the tables ------------------------------------------------------------ */

/* Whether each node has at most one parent, with a smaller number. */
static bool
is_tree(const qdot_articulated_tree *t)
{
    for (size_t n = 0; n < t->nodes; n++) {
        uint32_t parent = NONE;

        for (size_t i = 0; i < t->m; i++) {
            const uint32_t at = t->parent[n * t->m + i];

            if (at == NONE)
                continue;
            if (at / t->m >= n || (parent != NONE && at / t->m != parent))
                return false;
            parent = at / (uint32_t)t->m;
        }
        if (t->unknowns[n] > t->c)
            return false;
    }
    return true;
}

static bool
is_path_of_nodes(const qdot_articulated_tree *t)
{
    for (size_t e = 0; e < t->nodes * t->m; e++)
        if (t->parent[e] != (e < t->m ? NONE : (uint32_t)(e - t->m)))
            return false;
    return true;
}

/* Whether there is at most one node per lane, each with two components and one unknown. */
static bool
is_plane_path(const qdot_articulated_tree *t)
{
    bool everywhere = t->nodes <= pieces && t->m == 2 && t->c == 1;

    for (size_t n = 0; n < t->nodes; n++)
        everywhere = everywhere && t->unknowns[n] == 1;
    return everywhere;
}

/* Node n of a path: its piece, one of eight, and its index in it; the first pieces may have one
 * more. */
static size_t
slot_of_path_node(size_t n, size_t nodes)
{
    const size_t longest = (nodes + pieces - 1) / pieces;
    const size_t longer = nodes - pieces * (longest - 1);

    if (n < longer * longest)
        return n % longest * pieces + n / longest;
    n -= longer * longest;
    return n % (longest - 1) * pieces + longer + n / (longest - 1);
}

static const plane_kernels *
available_plane_kernels(void)
{
#ifdef QDOT_X86_KINDS
    if (qdot_kind_is_here(2))
        return &avx512_plane;
    if (qdot_kind_is_here(1))
        return &avx2_plane;
#endif
    return &portable_plane;
}

static double *
reserve_numbers(double **numbers, size_t n)
{
    double *at = *numbers;

    *numbers += n;
    return at;
}

/* Place the arrays for a path of bodies in a plane in the allocated numbers, from `at` on. */
static void
place_plane_arrays(qdot_articulated *a, double *at)
{
    a->W = reserve_numbers(&at, 4 * a->slots);
    a->Below = reserve_numbers(&at, 4 * a->slots);
    a->t = reserve_numbers(&at, 2 * a->slots);
    a->tn = reserve_numbers(&at, 2 * a->slots);
    a->wt = reserve_numbers(&at, 2 * a->slots);
    a->own = reserve_numbers(&at, a->slots);
    a->ratio = reserve_numbers(&at, a->slots);
    for (size_t n = 0; n < a->nodes; n++)
        for (size_t e = 0; e < 4; e++) {
            a->W[e * a->slots + a->slot[n]] = a->weight[n * 4 + e];
            a->Below[e * a->slots + a->slot[n]] = a->below[n * 4 + e];
        }
}

static qdot_status
allocate_numbers(qdot_articulated *a)
{
    const size_t m = a->m, c = a->c, square = m * m * a->slots;
    const size_t all =
        (1 + 5 * m * m + m * c + c * c + 3 * m + c) * a->slots + 6 * m * m * pieces +
        (a->plane ? 16 * a->slots : 0);
    double *at;

    a->numbers = qdot_calloc(all + pieces, sizeof *a->numbers);
    if (!a->numbers)
        return QDOT_ENOMEM;
    at = a->numbers;
    while ((uintptr_t)at % (pieces * sizeof *at) != 0)
        at++;
    a->there = reserve_numbers(&at, a->slots);
    a->I_0 = reserve_numbers(&at, square);
    a->I = reserve_numbers(&at, square);
    a->A = reserve_numbers(&at, square);
    a->Up = reserve_numbers(&at, square);
    a->Down = reserve_numbers(&at, square);
    a->B = reserve_numbers(&at, m * c * a->slots);
    a->H = reserve_numbers(&at, c * c * a->slots);
    a->d = reserve_numbers(&at, m * a->slots);
    a->Z = reserve_numbers(&at, m * a->slots);
    a->x = reserve_numbers(&at, m * a->slots);
    a->w = reserve_numbers(&at, c * a->slots);
    a->up = reserve_numbers(&at, 3 * m * m * pieces);
    a->down = reserve_numbers(&at, 3 * m * m * pieces);
    if (a->plane)
        place_plane_arrays(a, at);
    /* a slot without a node passes on unchanged what it receives */
    for (size_t i = 0; i < m; i++)
        for (size_t s = 0; s < a->slots; s++)
            a->A[(i * m + i) * a->slots + s] = 1;
    for (size_t n = 0; n < a->nodes; n++)
        a->there[a->slot[n]] = 1;
    return QDOT_OK;
}

/* Add the matrix `from` [m x m] of node n to that of its parent node, component by component. */
static void
add_to_parent(const qdot_articulated *a, size_t n, const double *from, double *to)
{
    const size_t m = a->m;
    const uint32_t *parent = a->parent + n * m;

    for (size_t i = 0; i < m; i++)
        for (size_t k = 0; k < m && parent[i] != NONE; k++)
            if (parent[k] != NONE)
                to[parent[i] * m + parent[k] % m] += from[i * m + k];
}

static qdot_status
allocate_arrays(qdot_articulated *a, const qdot_articulated_tree *t)
{
    const size_t entries = t->nodes * t->m, square = entries * t->m;

    a->slot = qdot_calloc(t->nodes, sizeof *a->slot);
    a->parent = qdot_calloc(entries, sizeof *a->parent);
    a->unknowns = qdot_calloc(t->nodes, sizeof *a->unknowns);
    a->weight = qdot_calloc(square, sizeof *a->weight);
    a->below = qdot_calloc(square, sizeof *a->below);
    a->passed = qdot_calloc(square, sizeof *a->passed);
    if (!a->slot || !a->parent || !a->unknowns || !a->weight || !a->below || !a->passed)
        return QDOT_ENOMEM;
    memcpy(a->parent, t->parent, entries * sizeof *a->parent);
    memcpy(a->unknowns, t->unknowns, t->nodes * sizeof *a->unknowns);
    memcpy(a->weight, t->weight, square * sizeof *a->weight);
    memcpy(a->below, t->weight, square * sizeof *a->below);
    for (size_t n = t->nodes; n-- > 0;)
        add_to_parent(a, n, a->below + n * t->m * t->m, a->below);
    for (size_t n = 0; n < t->nodes; n++)
        a->slot[n] = a->path ? slot_of_path_node(n, t->nodes) : n;
    return allocate_numbers(a);
}

qdot_status
qdot_articulated_new(const qdot_articulated_tree *t, qdot_articulated **articulated)
{
    qdot_articulated *a;
    qdot_status status;

    *articulated = NULL;
    if (t->nodes == 0 || t->m == 0 || t->m > most || t->c == 0 || t->c > most_unknowns ||
        !is_tree(t))
        return qdot_fail(QDOT_EINVAL, "there is no tree to eliminate along");
    a = qdot_calloc(1, sizeof *a);
    if (!a)
        return QDOT_ENOMEM;
    a->nodes = t->nodes;
    a->m = t->m;
    a->c = t->c;
    a->slots = (t->nodes + pieces - 1) / pieces * pieces;
    a->kernels = find_kernels(t->m, t->c);
    a->path = a->kernels && is_path_of_nodes(t);
    a->plane = a->path && is_plane_path(t) ? available_plane_kernels() : NULL;
    status = allocate_arrays(a, t);
    if (status != QDOT_OK) {
        qdot_articulated_free(a);
        return status;
    }
    *articulated = a;
    return QDOT_OK;
}

void
qdot_articulated_free(qdot_articulated *a)
{
    if (!a)
        return;
    qdot_free(a->slot);
    qdot_free(a->parent);
    qdot_free(a->unknowns);
    qdot_free(a->weight);
    qdot_free(a->below);
    qdot_free(a->passed);
    qdot_free(a->numbers);
    qdot_free(a);
}

size_t
qdot_articulated_slots(const qdot_articulated *a)
{
    return a->slots;
}

size_t
qdot_articulated_slot(const qdot_articulated *a, size_t node)
{
    return a->slot[node];
}

bool
qdot_articulated_is_path(const qdot_articulated *a)
{
    return a->path;
}

/* --- factorisation along the tree --------------------------------------------------- */

/* Intermediate results of the elimination of the present node. */
typedef struct {
    double S[most_unknowns * most]; /* [c x m] the block S of this node */
    double I[most * most], A[most * most], rest[most * most];
    double B[most * most_unknowns];
    double H[most_unknowns * most_unknowns];
} node;

/* H = D^-1, D = S^T I S, by its factors; the unknown whose pivot is not positive, or c.
 * `below` is I as if nothing were free, for what the diagonal of the full matrix is. */
INLINE size_t
invert(node *v, const size_t m, const size_t c, size_t unknowns, const double *below,
       const double *IS, double *lost)
{
    double L[most_unknowns][most_unknowns] = {{0}}, pivot[most_unknowns];

    for (size_t k = 0; k < c; k++)
        for (size_t l = 0; l < c; l++)
            v->H[k * c + l] = 0;
    for (size_t k = 0; k < unknowns; k++) {
        double diagonal = 0;

        for (size_t l = 0; l <= k; l++) {
            double D = 0;

            for (size_t i = 0; i < m; i++)
                D += v->S[l * m + i] * IS[k * m + i];
            for (size_t j = 0; j < l; j++)
                D -= L[k][j] * pivot[j] * L[l][j];
            if (l < k)
                L[k][l] = D / pivot[l];
            else
                pivot[k] = D;
        }
        for (size_t i = 0; i < m; i++)
            for (size_t j = 0; j < m; j++)
                diagonal += v->S[k * m + i] * below[i * m + j] * v->S[k * m + j];
        if (!(pivot[k] > 0 && pivot[k] < INFINITY))
            return k;
        if (pivot[k] < *lost * diagonal)
            *lost = pivot[k] / diagonal;
        L[k][k] = 1;
    }
    for (size_t e = 0; e < unknowns; e++) { /* for each column of the inverse */
        double x[most_unknowns] = {0};

        x[e] = 1;
        for (size_t k = e + 1; k < unknowns; k++)
            for (size_t l = e; l < k; l++)
                x[k] -= L[k][l] * x[l];
        for (size_t k = unknowns; k-- > 0;) {
            double z = x[k] / pivot[k];

            for (size_t l = k + 1; l < unknowns; l++)
                z -= L[l][k] * v->H[l * c + e];
            v->H[k * c + e] = z;
        }
    }
    return c;
}

/* Compute A, B, H of a node, and the inertia I that it passes to its parent; returns c, or the index of a bad pivot. */
INLINE size_t
eliminate(node *v, const size_t m, const size_t c, size_t unknowns, const double *below,
          double *lost)
{
    double IS[most_unknowns * most] = {0}, AI[most * most];
    size_t bad;

    for (size_t k = 0; k < c; k++)
        for (size_t i = 0; i < m; i++) {
            double s = 0;

            for (size_t j = 0; j < m; j++)
                s += v->I[i * m + j] * v->S[k * m + j];
            IS[k * m + i] = s;
        }
    bad = invert(v, m, c, unknowns, below, IS, lost);
    for (size_t i = 0; i < m; i++)
        for (size_t k = 0; k < c; k++) {
            double s = 0;

            for (size_t l = 0; l < c; l++)
                s += IS[l * m + i] * v->H[l * c + k];
            v->B[i * c + k] = s;
        }
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < m; j++) {
            double s = i == j;

            for (size_t k = 0; k < c; k++)
                s -= v->B[i * c + k] * v->S[k * m + j];
            v->A[i * m + j] = s;
        }
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < m; j++) {
            double s = 0;

            for (size_t k = 0; k < m; k++)
                s += v->A[i * m + k] * v->I[k * m + j];
            AI[i * m + j] = s;
        }
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j <= i; j++) {
            double s = 0;

            for (size_t k = 0; k < m; k++)
                s += AI[i * m + k] * v->A[j * m + k];
            v->rest[i * m + j] = v->rest[j * m + i] = s;
        }
    return bad;
}

INLINE void
put(double *to, size_t slots, size_t at, const double *from, const size_t n)
{
    for (size_t e = 0; e < n; e++)
        to[e * slots + at] = from[e];
}

/* Factor the matrix from the leaves of the tree to its roots. */
INLINE bool
factor_of(qdot_articulated *a, const size_t m, const size_t c, const double *const *S,
          double *lost, size_t *failed, size_t *unknown)
{
    const size_t square = m * m;
    node v;

    memset(a->passed, 0, a->nodes * square * sizeof *a->passed);
    for (size_t n = a->nodes; n-- > 0;) {
        const size_t at = a->slot[n], unknowns = a->unknowns[n];
        size_t bad;

        for (size_t e = 0; e < c * m; e++)
            v.S[e] = S[e][at];
        for (size_t e = 0; e < square; e++)
            v.I[e] = a->weight[n * square + e] + a->passed[n * square + e];
        bad = eliminate(&v, m, c, unknowns, a->below + n * square, lost);
        if (bad < unknowns) {
            *failed = n;
            *unknown = bad;
            return false;
        }
        put(a->I_0, a->slots, at, v.I, square);
        put(a->I, a->slots, at, v.rest, square);
        put(a->A, a->slots, at, v.A, square);
        put(a->B, a->slots, at, v.B, m * c);
        put(a->H, a->slots, at, v.H, c * c);
        if (a->path && n > 0)
            memcpy(a->passed + (n - 1) * square, v.rest, square * sizeof *v.rest);
        else if (!a->path)
            add_to_parent(a, n, v.rest, a->passed);
    }
    return true;
}

bool
qdot_articulated_factor(qdot_articulated *a, const double *const *S, double *lost,
                        size_t *failed, size_t *unknown)
{
    bool good;

    if (a->plane) {
        *lost = a->plane->eliminate(a, S);
        if (*lost > 0)
            return true;
        *failed = *unknown = 0; /* the loop below finds which node failed */
    }
    *lost = 1;
    if (a->m == 2 && a->c == 1)
        good = factor_of(a, 2, 1, S, lost, failed, unknown);
    else if (a->m == 3 && a->c == 2)
        good = factor_of(a, 3, 2, S, lost, failed, unknown);
    else
        good = factor_of(a, a->m, a->c, S, lost, failed, unknown);
    if (good && a->path && !a->plane)
        a->kernels->chain(a);
    return good && !a->plane;
}

/* --- solutions node by node --------------------------------------------------------- */

/* Pass the vector A Z + I d + B r from node n up to its parent. */
INLINE void
go_up(qdot_articulated *a, const size_t m, const size_t c, size_t n,
      const qdot_articulated_equations *e)
{
    const size_t slots = a->slots;
    double Z[most], x[most];

    for (size_t i = 0; i < m; i++) {
        x[i] = a->d[i * slots + n] = e->factor * e->d[i][n];
        Z[i] = a->Z[i * slots + n];
    }
    for (size_t i = 0; i < m; i++) {
        const uint32_t to = a->parent[n * m + i];
        double s = 0;

        if (to == NONE)
            continue;
        for (size_t k = 0; k < m; k++)
            s += a->I[(i * m + k) * slots + n] * x[k];
        for (size_t k = 0; k < c; k++)
            s += a->B[(i * c + k) * slots + n] * e->r[k][n];
        for (size_t k = 0; k < m; k++)
            s += a->A[(i * m + k) * slots + n] * Z[k];
        a->Z[to % m * slots + to / m] += s;
    }
}

/* Compute the unknowns q and x and F of node n from the x of its parent. */
INLINE void
go_down(qdot_articulated *a, const size_t m, const size_t c, size_t n,
        const qdot_articulated_equations *e)
{
    const size_t slots = a->slots;
    const double *const *S = e->S;
    double *const *q = e->q;
    double y[most], left[most_unknowns];

    for (size_t k = 0; k < c; k++) {
        left[k] = e->r[k][n];
        for (size_t i = 0; i < m; i++)
            left[k] -= S[k * m + i][n] * a->Z[i * slots + n];
    }
    for (size_t i = 0; i < m; i++) {
        const uint32_t from = a->parent[n * m + i];

        y[i] =
            a->d[i * slots + n] + (from == NONE ? 0 : a->x[from % m * slots + from / m]);
    }
    for (size_t k = 0; k < c; k++) {
        double s = 0;

        for (size_t l = 0; l < c; l++)
            s += a->H[(k * c + l) * slots + n] * left[l];
        for (size_t i = 0; i < m; i++)
            s -= a->B[(i * c + k) * slots + n] * y[i];
        q[k][n] = s;
    }
    for (size_t k = 0; k < c; k++)
        for (size_t i = 0; i < m; i++)
            y[i] += S[k * m + i][n] * q[k][n];
    for (size_t i = 0; i < m; i++) {
        double s = a->Z[i * slots + n];

        for (size_t k = 0; k < m; k++)
            s += a->I_0[(i * m + k) * slots + n] * y[k];
        a->x[i * slots + n] = y[i];
        e->F[i][n] = s;
    }
}

INLINE void
solve_nodes(qdot_articulated *a, const size_t m, const size_t c,
            const qdot_articulated_equations *e)
{
    memset(a->Z, 0, m * a->slots * sizeof *a->Z);
    for (size_t n = a->nodes; n-- > 0;)
        go_up(a, m, c, n, e);
    for (size_t n = 0; n < a->nodes; n++)
        go_down(a, m, c, n, e);
}

void
qdot_articulated_solve(qdot_articulated *a, const qdot_articulated_equations *e)
{
    if (a->plane)
        a->plane->path(a, e);
    else if (a->path)
        a->kernels->path(a, e);
    else if (a->m == 2 && a->c == 1)
        solve_nodes(a, 2, 1, e);
    else if (a->m == 3 && a->c == 2)
        solve_nodes(a, 3, 2, e);
    else
        solve_nodes(a, a->m, a->c, e);
}
