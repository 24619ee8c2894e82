/* tensor.c -- arithmetic on scalars, vectors, matrices, lists and equations. */
#include "expr/tensor.h"

#include <inttypes.h>
#include <string.h>

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/pool.h"

static const char *
name_of_kind(const qdot_pool *pool, qdot_expr e)
{
    switch (NODE(pool, e)->kind) {
    case QDOT_REL: return NODE(pool, e)->op == QDOT_EQ ? "an equation" : "a comparison";
    case QDOT_LOGIC: return "a condition";
    case QDOT_VEC: return "a vector";
    case QDOT_MAT: return "a matrix";
    case QDOT_LIST: return "a list";
    default: return e == QDOT_TRUE || e == QDOT_FALSE ? "a condition" : "a number";
    }
}

/* A buffer for the components of a new value. */
typedef struct {
    qdot_expr few[32], *at;
} parts;

static bool
allocate_components(qdot_pool *pool, parts *p, size_t n)
{
    p->at = n > 32 ? qdot_malloc(n * sizeof *p->at) : p->few;
    if (p->at == NULL)
        qdot_pool_fail(pool);
    return p->at != NULL;
}

static void
free_components(parts *p)
{
    if (p->at != p->few)
        qdot_free(p->at);
}

static bool
is_tensor(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->kind == QDOT_VEC || NODE(pool, e)->kind == QDOT_MAT;
}

static bool
has_same_shape(const qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    const qdot_node *x = NODE(pool, a), *y = NODE(pool, b);

    return x->kind == y->kind && x->n == y->n && (x->kind != QDOT_MAT || x->op == y->op);
}

/* Apply f to every component of a, with the same component of b or with a scalar b. */
static qdot_expr
map_components(qdot_pool *pool, qdot_expr a, qdot_expr b,
               qdot_expr (*f)(qdot_pool *pool, qdot_expr x, qdot_expr y), bool pairwise)
{
    uint32_t n = NODE(pool, a)->n;
    parts p;
    qdot_expr result;

    if (!allocate_components(pool, &p, n))
        return QDOT_NIL;
    for (uint32_t i = 0; i < n; i++)
        p.at[i] = f(pool, ARGS(pool, a)[i], pairwise ? ARGS(pool, b)[i] : b);
    result = qdot_rebuild(pool, a, p.at);
    free_components(&p);
    return result;
}

static qdot_expr
report_different_shapes(qdot_pool *pool, const char *verb, qdot_expr a, qdot_expr b)
{
    const qdot_node *x = NODE(pool, a), *y = NODE(pool, b);

    if (x->kind == QDOT_VEC && y->kind == QDOT_VEC)
        return qdot_pool_refuse(pool, QDOT_ETYPE,
                                "cannot %s vectors of %u and %u components", verb, x->n,
                                y->n);
    if (x->kind == QDOT_LIST && y->kind == QDOT_LIST && x->n != y->n)
        return qdot_pool_refuse(pool, QDOT_ETYPE, "cannot %s lists of %u and %u members", verb, x->n, y->n);
    if (x->kind == QDOT_MAT && y->kind == QDOT_MAT)
        return qdot_pool_refuse(pool, QDOT_ETYPE, "cannot %s a %ux%u and a %ux%u matrix",
                                verb, x->n / x->op, x->op, y->n / y->op, y->op);
    return qdot_pool_refuse(pool, QDOT_ETYPE, "cannot %s %s and %s", verb,
                            name_of_kind(pool, a), name_of_kind(pool, b));
}

static bool
check_operands(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    return a != QDOT_NIL && b != QDOT_NIL && !qdot_pool_failed(pool);
}

static bool
is_equation(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->kind == QDOT_REL && NODE(pool, e)->op == QDOT_EQ;
}

static bool
is_list(const qdot_pool *pool, qdot_expr e)
{
    return NODE(pool, e)->kind == QDOT_LIST;
}

qdot_expr
qdot_value_add(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    if (!check_operands(pool, a, b))
        return QDOT_NIL;
    if (qdot_expr_is_scalar(pool, a) && qdot_expr_is_scalar(pool, b))
        return qdot_add(pool, a, b);
    if ((is_tensor(pool, a) || is_list(pool, a) || is_equation(pool, a)) && has_same_shape(pool, a, b) &&
        is_equation(pool, a) == is_equation(pool, b))
        return map_components(pool, a, b, qdot_value_add, true);
    if (is_equation(pool, a) && qdot_expr_is_scalar(pool, b))
        return map_components(pool, a, b, qdot_value_add, false);
    if (is_equation(pool, b) && qdot_expr_is_scalar(pool, a))
        return map_components(pool, b, a, qdot_value_add, false);
    return report_different_shapes(pool, "add", a, b);
}

qdot_expr
qdot_value_neg(qdot_pool *pool, qdot_expr a)
{
    return qdot_value_mul(pool, QDOT_MINUS_ONE, a);
}

qdot_expr
qdot_value_sub(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    if (!check_operands(pool, a, b))
        return QDOT_NIL;
    if (!qdot_expr_is_scalar(pool, a) && !qdot_expr_is_scalar(pool, b) &&
        !has_same_shape(pool, a, b))
        return report_different_shapes(pool, "subtract", a, b);
    return qdot_value_add(pool, a, qdot_value_neg(pool, b));
}

/* The product of matrices a (rows x inner) and b (inner x columns), whose entries are stored row by row. */
static qdot_expr
matrix_product(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    bool vector = NODE(pool, b)->kind == QDOT_VEC;
    uint32_t inner = NODE(pool, a)->op, rows = NODE(pool, a)->n / inner;
    uint32_t columns = vector ? 1 : NODE(pool, b)->op, deep = NODE(pool, b)->n / columns;
    parts p, terms;
    qdot_expr result = QDOT_NIL;

    if (inner != deep)
        return vector
                   ? qdot_pool_refuse(
                         pool, QDOT_ETYPE,
                         "cannot multiply a %ux%u matrix and a vector of %u components",
                         rows, inner, deep)
                   : report_different_shapes(pool, "multiply", a, b);
    if (!allocate_components(pool, &p, (size_t)rows * columns))
        return QDOT_NIL;
    if (allocate_components(pool, &terms, inner)) {
        for (uint32_t i = 0; i < rows; i++)
            for (uint32_t j = 0; j < columns; j++) {
                for (uint32_t k = 0; k < inner; k++)
                    terms.at[k] = qdot_mul(pool, ARGS(pool, a)[i * inner + k],
                                           ARGS(pool, b)[k * columns + j]);
                p.at[i * columns + j] = qdot_sum(pool, inner, terms.at);
            }
        result = !vector    ? qdot_factors_note(pool, qdot_matrix(pool, rows, columns, p.at), a, b)
                 : rows > 1 ? qdot_vector(pool, rows, p.at)
                            : p.at[0];
        free_components(&terms);
    }
    free_components(&p);
    return result;
}

qdot_expr
qdot_value_mul(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    if (!check_operands(pool, a, b))
        return QDOT_NIL;
    if (qdot_expr_is_scalar(pool, a) && qdot_expr_is_scalar(pool, b))
        return qdot_mul(pool, a, b);
    if (qdot_expr_is_scalar(pool, a) && (is_tensor(pool, b) || is_list(pool, b) || is_equation(pool, b)))
        return map_components(pool, b, a, qdot_value_mul, false);
    if (qdot_expr_is_scalar(pool, b) && (is_tensor(pool, a) || is_list(pool, a) || is_equation(pool, a)))
        return map_components(pool, a, b, qdot_value_mul, false);
    if (NODE(pool, a)->kind == QDOT_MAT && is_tensor(pool, b))
        return matrix_product(pool, a, b);
    if (NODE(pool, a)->kind == QDOT_VEC && NODE(pool, b)->kind == QDOT_VEC) {
        qdot_expr none = report_different_shapes(pool, "multiply", a, a);

        if (pool->error.status == QDOT_ETYPE) {
            strcpy(pool->error.message, "cannot multiply a vector and a vector");
            strcpy(pool->error.hint, "dot(u, v) or cross(u, v)");
        }
        return none;
    }
    return report_different_shapes(pool, "multiply", a, b);
}

qdot_expr
qdot_value_div(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    if (!check_operands(pool, a, b))
        return QDOT_NIL;
    if (!qdot_expr_is_scalar(pool, b))
        return qdot_pool_refuse(pool, QDOT_ETYPE, "cannot divide by %s",
                                name_of_kind(pool, b));
    return qdot_value_mul(pool, a, qdot_pow(pool, b, QDOT_MINUS_ONE));
}

qdot_expr
qdot_value_pow(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    int64_t n;
    qdot_expr result = QDOT_NIL;

    if (!check_operands(pool, a, b))
        return QDOT_NIL;
    if (qdot_expr_is_scalar(pool, a) && qdot_expr_is_scalar(pool, b))
        return qdot_pow(pool, a, b);
    if (NODE(pool, a)->kind != QDOT_MAT || !qdot_expr_to_int(pool, b, &n))
        return qdot_pool_refuse(pool, QDOT_ETYPE, "cannot raise %s to the power of %s",
                                name_of_kind(pool, a), name_of_kind(pool, b));
    if (n < -1000000 || n > 1000000)
        return qdot_pool_refuse(pool, QDOT_ELIMIT, "the power %" PRId64 " of a matrix", n);
    if (n < 0) {
        a = qdot_inverse(pool, a);
        n = -n;
    }
    if (a != QDOT_NIL) {
        uint32_t size = NODE(pool, a)->op;
        parts p;

        if (NODE(pool, a)->n != size * size)
            return qdot_pool_refuse(pool, QDOT_ETYPE,
                                    "a power of a matrix that is not square");
        if (!allocate_components(pool, &p, (size_t)size * size))
            return QDOT_NIL;
        for (uint32_t i = 0; i < size * size; i++)
            p.at[i] = i % (size + 1) == 0 ? QDOT_ONE : QDOT_ZERO;
        result = qdot_matrix(pool, size, size, p.at);
        free_components(&p);
    }
    for (; n > 0 && result != QDOT_NIL; n >>= 1) {
        if (n & 1)
            result = qdot_value_mul(pool, result, a);
        if (n > 1)
            a = qdot_value_mul(pool, a, a);
    }
    return result;
}

static qdot_expr
make_equation(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    return qdot_rel(pool, QDOT_EQ, a, b);
}

qdot_expr
qdot_value_equation(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    if (!check_operands(pool, a, b))
        return QDOT_NIL;
    if (qdot_expr_is_scalar(pool, a) && qdot_expr_is_scalar(pool, b))
        return make_equation(pool, a, b);
    if ((is_tensor(pool, a) || NODE(pool, a)->kind == QDOT_LIST) &&
        has_same_shape(pool, a, b))
        return map_components(pool, a, b,
                              NODE(pool, a)->kind == QDOT_LIST ? qdot_value_equation : make_equation,
                              true);
    return report_different_shapes(pool, "equate", a, b);
}

/* --- products of vectors ------------------------------------------------------------------- */

static bool
check_vectors(qdot_pool *pool, const char *what, qdot_expr a, qdot_expr b)
{
    if (!check_operands(pool, a, b))
        return false;
    if (NODE(pool, a)->kind == QDOT_VEC && NODE(pool, b)->kind == QDOT_VEC)
        return true;
    qdot_pool_refuse(pool, QDOT_ETYPE, "%s takes vectors, not %s", what,
                     name_of_kind(pool, NODE(pool, a)->kind == QDOT_VEC ? b : a));
    return false;
}

qdot_expr
qdot_dot(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    parts p;
    uint32_t n;
    qdot_expr result;

    /* in one dimension vectors are scalars */
    if (check_operands(pool, a, b) && qdot_expr_is_scalar(pool, a) && qdot_expr_is_scalar(pool, b))
        return qdot_mul(pool, a, b);
    if (!check_vectors(pool, "dot", a, b))
        return QDOT_NIL;
    n = NODE(pool, a)->n;
    if (n != NODE(pool, b)->n)
        return report_different_shapes(pool, "dot", a, b);
    if (!allocate_components(pool, &p, n))
        return QDOT_NIL;
    for (uint32_t i = 0; i < n; i++)
        p.at[i] = qdot_mul(pool, ARGS(pool, a)[i], ARGS(pool, b)[i]);
    result = qdot_sum(pool, n, p.at);
    free_components(&p);
    return result;
}

static qdot_expr
two_by_two_minor(qdot_pool *pool, qdot_expr a, qdot_expr b, uint32_t i, uint32_t j)
{
    return qdot_sub(pool, qdot_mul(pool, ARGS(pool, a)[i], ARGS(pool, b)[j]),
                    qdot_mul(pool, ARGS(pool, a)[j], ARGS(pool, b)[i]));
}

qdot_expr
qdot_cross(qdot_pool *pool, qdot_expr a, qdot_expr b)
{
    qdot_expr c[3];

    if (!check_vectors(pool, "cross", a, b))
        return QDOT_NIL;
    if (NODE(pool, a)->n != NODE(pool, b)->n || NODE(pool, a)->n > 3)
        return report_different_shapes(pool, "cross", a, b);
    if (NODE(pool, a)->n == 2)
        return two_by_two_minor(pool, a, b, 0, 1);
    for (uint32_t i = 0; i < 3; i++)
        c[i] = two_by_two_minor(pool, a, b, (i + 1) % 3, (i + 2) % 3);
    return qdot_vector(pool, 3, c);
}

qdot_expr
qdot_norm(qdot_pool *pool, qdot_expr a)
{
    if (a != QDOT_NIL && qdot_expr_is_scalar(pool, a))
        return qdot_fun1(pool, QDOT_ABS, a);
    return qdot_sqrt(pool, qdot_dot(pool, a, a));
}

/* --- functions of matrices -------------------------------------------------------------------- */

static bool
check_matrix(qdot_pool *pool, const char *what, qdot_expr a, bool square)
{
    if (a == QDOT_NIL || qdot_pool_failed(pool))
        return false;
    if (NODE(pool, a)->kind != QDOT_MAT) {
        qdot_pool_refuse(pool, QDOT_ETYPE, "%s takes a matrix, not %s", what,
                         name_of_kind(pool, a));
        return false;
    }
    if (square && NODE(pool, a)->n != (uint32_t)NODE(pool, a)->op * NODE(pool, a)->op) {
        qdot_pool_refuse(pool, QDOT_ETYPE, "%s takes a square matrix", what);
        return false;
    }
    return true;
}

qdot_expr
qdot_transpose(qdot_pool *pool, qdot_expr a)
{
    uint32_t rows, columns;
    parts p;
    qdot_expr result;

    if (!check_matrix(pool, "transpose", a, false))
        return QDOT_NIL;
    columns = NODE(pool, a)->op;
    rows = NODE(pool, a)->n / columns;
    if (!allocate_components(pool, &p, NODE(pool, a)->n))
        return QDOT_NIL;
    for (uint32_t i = 0; i < rows; i++)
        for (uint32_t j = 0; j < columns; j++)
            p.at[j * rows + i] = ARGS(pool, a)[i * columns + j];
    result = qdot_matrix(pool, columns, rows, p.at);
    free_components(&p);
    return qdot_factors_note(pool, result, a, QDOT_NIL);
}

qdot_expr
qdot_trace(qdot_pool *pool, qdot_expr a)
{
    qdot_expr sum = QDOT_ZERO;

    if (!check_matrix(pool, "trace", a, true))
        return QDOT_NIL;
    for (uint32_t i = 0, n = NODE(pool, a)->op; i < n; i++)
        sum = qdot_add(pool, sum, ARGS(pool, a)[i * (n + 1)]);
    return sum;
}

/* Determinant of the rows `first` .. n-1 in each set of columns, by expansion along the first
 * row; every minor once: n 2^n products. table [2^n] by set. */
static qdot_expr
determinant(qdot_pool *pool, uint32_t n, const qdot_expr *entry)
{
    qdot_expr *table = qdot_calloc((size_t)1 << n, sizeof *table), result;

    if (table == NULL)
        return qdot_pool_fail(pool);
    table[0] = QDOT_ONE;
    for (uint32_t set = 1; set < 1u << n && !qdot_pool_failed(pool); set++) {
        uint32_t row = n - (uint32_t)__builtin_popcount(set), place = 0;
        qdot_expr sum = QDOT_ZERO;

        for (uint32_t j = 0; j < n; j++) {
            qdot_expr term;

            if (!(set >> j & 1))
                continue;
            term = entry[row * n + j];
            if (term != QDOT_ZERO) {
                term = qdot_mul(pool, term, table[set & ~(1u << j)]);
                sum = qdot_add(pool, sum, place % 2 ? qdot_neg(pool, term) : term);
            }
            place++;
        }
        table[set] = sum;
    }
    result = qdot_pool_failed(pool) ? QDOT_NIL : table[(1u << n) - 1];
    qdot_free(table);
    return result;
}

enum { LARGEST = 12 };

static bool
check_matrix_size(qdot_pool *pool, const char *what, uint32_t n)
{
    if (n <= LARGEST)
        return true;
    qdot_pool_refuse(pool, QDOT_ELIMIT, "%s of a symbolic matrix larger than %dx%d", what,
                     LARGEST, LARGEST);
    return false;
}

qdot_expr
qdot_det(qdot_pool *pool, qdot_expr a)
{
    qdot_expr entry[LARGEST * LARGEST];
    uint32_t n;

    if (!check_matrix(pool, "det", a, true))
        return QDOT_NIL;
    n = NODE(pool, a)->op;
    if (!check_matrix_size(pool, "det", n))
        return QDOT_NIL;
    memcpy(entry, ARGS(pool, a), (size_t)n * n * sizeof *entry);
    return determinant(pool, n, entry);
}

/* (-1)^(i + j) times the minor without row i and column j. */
static qdot_expr
cofactor(qdot_pool *pool, uint32_t n, const qdot_expr *entry, uint32_t i, uint32_t j)
{
    qdot_expr minor[LARGEST * LARGEST], det;
    uint32_t k = 0;

    for (uint32_t r = 0; r < n; r++)
        for (uint32_t c = 0; c < n; c++)
            if (r != i && c != j)
                minor[k++] = entry[r * n + c];
    det = determinant(pool, n - 1, minor);
    return (i + j) % 2 ? qdot_neg(pool, det) : det;
}

qdot_expr
qdot_inverse(qdot_pool *pool, qdot_expr a)
{
    qdot_expr entry[LARGEST * LARGEST], inverse[LARGEST * LARGEST], det;
    uint32_t n;

    if (!check_matrix(pool, "inverse", a, true))
        return QDOT_NIL;
    n = NODE(pool, a)->op;
    if (!check_matrix_size(pool, "inverse", n))
        return QDOT_NIL;
    memcpy(entry, ARGS(pool, a), (size_t)n * n * sizeof *entry);
    det = determinant(pool, n, entry);
    if (det == QDOT_ZERO)
        return qdot_pool_refuse(pool, QDOT_ESINGULAR,
                                "the matrix has no inverse: its determinant is 0");
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < n; j++)
            inverse[j * n + i] = qdot_div(pool, cofactor(pool, n, entry, i, j), det);
    return qdot_matrix(pool, n, n, inverse);
}

/* --- entries of vectors and matrices ------------------------------------------------------------ */

qdot_expr
qdot_entry(qdot_pool *pool, qdot_expr a, int64_t i)
{
    const qdot_node *node;

    if (a == QDOT_NIL || qdot_pool_failed(pool))
        return QDOT_NIL;
    node = NODE(pool, a);
    if (node->kind == QDOT_MAT && node->n == node->op) /* a matrix with a single row */
        return qdot_entry2(pool, a, 1, i);
    if (node->kind == QDOT_MAT) {
        uint32_t columns = node->op;

        if (i < 1 || (uint64_t)i > node->n / columns)
            return qdot_pool_refuse(pool, QDOT_EDOMAIN, "row %" PRId64 " of a matrix of %u rows",
                                    i, node->n / columns);
        return columns > 1 ? qdot_vector(pool, columns, ARGS(pool, a) + (i - 1) * columns)
                           : ARGS(pool, a)[i - 1];
    }
    if (node->kind != QDOT_VEC && node->kind != QDOT_LIST)
        return qdot_pool_refuse(pool, QDOT_ETYPE, "%s has no entries",
                                name_of_kind(pool, a));
    if (i < 1 || (uint64_t)i > node->n)
        return qdot_pool_refuse(pool, QDOT_EDOMAIN,
                                "entry %" PRId64 " of %s of %u: they are counted from 1", i,
                                name_of_kind(pool, a), node->n);
    return ARGS(pool, a)[i - 1];
}

qdot_expr
qdot_entry2(qdot_pool *pool, qdot_expr a, int64_t i, int64_t j)
{
    uint32_t rows, columns;

    if (a == QDOT_NIL || qdot_pool_failed(pool))
        return QDOT_NIL;
    if (NODE(pool, a)->kind == QDOT_LIST || NODE(pool, a)->kind == QDOT_VEC)
        return qdot_entry(pool, qdot_entry(pool, a, i), j);
    if (!check_matrix(pool, "[i, j]", a, false))
        return QDOT_NIL;
    columns = NODE(pool, a)->op;
    rows = NODE(pool, a)->n / columns;
    if (i < 1 || j < 1 || (uint64_t)i > rows || (uint64_t)j > columns)
        return qdot_pool_refuse(
            pool, QDOT_EDOMAIN,
            "entry [%" PRId64 ", %" PRId64 "] of a %ux%u matrix: they are counted from 1", i, j, rows,
            columns);
    return ARGS(pool, a)[(i - 1) * columns + j - 1];
}

/* --- a function applied to every scalar ----------------------------------------------------------- */

qdot_expr
qdot_value_map(qdot_pool *pool, qdot_expr e,
               qdot_expr (*f)(qdot_pool *pool, qdot_expr scalar, void *user), void *user)
{
    /* values nest a few levels deep (a list of vectors of equations); a stack of frames replaces recursion */
    struct frame {
        qdot_expr e;
        uint32_t next;
        size_t base;
    };
    qdot_vec(struct frame) stack = {0};
    qdot_vec(qdot_expr) done = {0};
    qdot_expr result = QDOT_NIL;

    if (e == QDOT_NIL || qdot_pool_failed(pool))
        return QDOT_NIL;
    if (qdot_vec_push(&stack, ((struct frame){e, 0, 0})) != QDOT_OK)
        return qdot_pool_fail(pool);
    while (stack.n > 0 && !qdot_pool_failed(pool)) {
        struct frame *top = &stack.at[stack.n - 1];
        qdot_expr value;

        if (qdot_expr_is_scalar(pool, top->e)) {
            value = f(pool, top->e, user);
        } else if (top->next < NODE(pool, top->e)->n) {
            qdot_expr child = ARGS(pool, top->e)[top->next++];

            if (qdot_vec_push(&stack, ((struct frame){child, 0, done.n})) != QDOT_OK)
                qdot_pool_fail(pool);
            continue;
        } else {
            value = qdot_rebuild(pool, top->e, done.at + top->base);
            done.n = top->base;
        }
        stack.n--;
        if (value == QDOT_NIL || qdot_vec_push(&done, value) != QDOT_OK) {
            qdot_pool_fail(pool);
            break;
        }
    }
    if (!qdot_pool_failed(pool) && done.n == 1)
        result = done.at[0];
    qdot_free(stack.at);
    qdot_free(done.at);
    return result;
}
