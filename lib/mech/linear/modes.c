/* modes.c -- normal modes about an equilibrium: exact where the characteristic polynomial
 * factors, else numbers. */
#include "mech/linear/modes.h"

#include <math.h>

#include <gsl/gsl_eigen.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/dynamics/generic.h"
#include "mech/dynamics/integrated.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/linear/linear-motion.h"
#include "normal/inequality/less.h"
#include "normal/prove/decide.h"
#include "normal/refute/ball.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/rationalize.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

enum { MOST_EXACT = 6 };

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    qdot_binder bind;
    void *user;
    qdot_linear_motion m;
    qdot_vec(qdot_expr) frequency, amplitude;
    bool numeric, unordered;
} job;

static bool
is_proved_zero(const job *j, qdot_expr e)
{
    return e == QDOT_ZERO || qdot_is_zero(j->pool, e, &j->facts);
}

static qdot_expr
insert_values(const job *j, qdot_expr e)
{
    return j->bind == NULL || e == QDOT_NIL ? e : j->bind(j->user, e);
}

/* Eliminate coordinates without mass, which follow the other coordinates as in statics. */
static qdot_status
eliminate_massless(job *j)
{
    size_t left;

    QDOT_TRY(qdot_linear_motion_condense(j->s, &j->facts, &j->m, &left));
    if (left == SIZE_MAX && j->m.n > 0)
        return QDOT_OK;
    (void)qdot_fail(QDOT_ESINGULAR, "nothing with mass moves with %.200s: it has no modes",
                    qdot_expr_symbol(j->pool, j->s->coordinates.at[left == SIZE_MAX ? 0 : left])->name);
    return qdot_hint("declare only the coordinates that the scene uses");
}

/* *yes: the argument of a sign in e, or the difference between both sides of an `if`'s condition, is proved to be 0 at
 * the place, so that e jumps there. */
static qdot_status
expression_jumps_at(const job *j, qdot_expr e, qdot_expr place, bool *yes)
{
    qdot_pool *pool = j->pool;
    qdot_status status = QDOT_OK;
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t i = 0; i < w.n && !*yes && status == QDOT_OK; i++) {
        uint32_t op = qdot_expr_kind(pool, w.at[i]) == QDOT_FUN ? qdot_expr_node(pool, w.at[i])->op : QDOT_ABS;
        qdot_expr u = op == QDOT_SIGN || op == QDOT_IF ? qdot_expr_arg(pool, w.at[i], 0) : QDOT_NIL;

        if (u == QDOT_NIL || (qdot_mech_holds(j->s, u) & (QDOT_HAS_COORD | QDOT_HAS_VELOCITY)) == 0)
            continue;
        if (op == QDOT_IF && qdot_expr_kind(pool, u) != QDOT_REL)
            continue;
        if (op == QDOT_IF)
            u = qdot_sub(pool, qdot_expr_arg(pool, u, 1), qdot_expr_arg(pool, u, 0));
        *yes = is_proved_zero(j, qdot_rest_value(j->s, place, u));
        status = qdot_pool_check(pool);
    }
    qdot_walk_end(&w);
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* Refuse points without linear motion: at a corner, between one-sided springs, or under dry friction. */
static qdot_status
check_smooth(const job *j, qdot_expr place)
{
    qdot_scene *s = j->s;
    bool jumps = false;

    for (size_t i = 0; i < s->coordinates.n && !jumps; i++) {
        const qdot_expr gap = qdot_motion_residual(s, i);

        QDOT_TRY(expression_jumps_at(j, qdot_mech_equation(s, s->coordinates.at[i]), place, &jumps));
        for (size_t k = 0; k < s->coordinates.n && !jumps; k++)
            QDOT_TRY(expression_jumps_at(j, qdot_diff(j->pool, gap, s->coordinates.at[k]), place, &jumps));
    }
    QDOT_TRY(qdot_pool_check(j->pool));
    return jumps ? qdot_fail(QDOT_ETYPE, "the forces or their slopes jump at the equilibrium: there is no linear motion "
                                         "about it, so it has no normal modes")
                 : QDOT_OK;
}

/* Whether |value|, that of e at the place, is no more than relative errors of 1e-6 in the coordinates of the place (of
 * 1e-6 where they are below 1) make of it, to first order. */
static bool
is_within_rounding_error(const job *j, qdot_expr e, qdot_expr place, double value)
{
    double sum = 0;

    for (size_t k = 0; k < j->s->coordinates.n; k++) {
        const qdot_expr q = j->s->coordinates.at[k];
        double slope = 0, at = 0;

        if (qdot_ball_double(j->pool, insert_values(j, qdot_rest_value(j->s, place, qdot_diff(j->pool, e, q))), NULL, NULL,
                             &slope) &&
            qdot_ball_double(j->pool, insert_values(j, qdot_rest_value(j->s, place, q)), NULL, NULL, &at))
            sum += fabs(slope) * fmax(1, fabs(at));
    }
    return fabs(value) <= 1e-6 * sum;
}

/* An error if an equation of motion is refuted at rest at the place, beyond rounding: it is no equilibrium.
 * Equations that hold a multiplier are passed over, because its value there need not be known. */
static qdot_status
check_is_equilibrium(const job *j, qdot_expr place)
{
    for (size_t i = 0; i < j->s->coordinates.n; i++) {
        const qdot_expr gap = qdot_motion_residual(j->s, i);
        qdot_expr there;
        qdot_decision decision;
        bool pulled = false;

        for (size_t k = 0; k < j->s->constraints.n; k++)
            pulled = pulled || qdot_expr_contains(j->pool, gap, j->s->constraints.at[k].multiplier);
        if (pulled)
            continue;
        there = insert_values(j, qdot_rest_value(j->s, place, gap));
        QDOT_TRY(qdot_pool_check(j->pool));
        QDOT_TRY(qdot_decide_equal(j->pool, there, QDOT_ZERO, &j->facts, &decision));
        if (decision.verdict != QDOT_REFUTED || is_within_rounding_error(j, gap, place, decision.left))
            continue;
        (void)qdot_fail(QDOT_EINVAL, "that is no equilibrium: the equation of %s does not hold at rest there",
                        qdot_expr_symbol(j->pool, j->s->coordinates.at[i])->name);
        return qdot_hint("modes at equilibria[1]");
    }
    return qdot_pool_check(j->pool);
}

static qdot_status
check_linear_motion(job *j)
{
    size_t n = j->m.n;

    if (n == 0)
        return qdot_fail(QDOT_EINVAL, "nothing can move there: there are no modes");
    for (size_t i = 0; i < n * n; i++)
        if (!is_proved_zero(j, j->m.Gamma[i]))
            return qdot_fail(QDOT_ETYPE,
                             "the motion about the equilibrium has damping or "
                             "gyroscopic terms: it has no normal modes");
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < i; k++)
            if (!is_proved_zero(j, qdot_sub(j->pool, j->m.H[i * n + k], j->m.H[k * n + i])))
                return qdot_fail(QDOT_ETYPE, "the forces have no potential: there are no "
                                             "normal modes");
    QDOT_TRY(qdot_pool_check(j->pool));
    return eliminate_massless(j);
}

/* Add the mode with frequency w and displacements x = N y, scaled so that the first non-zero component of x is 1. */
static qdot_status
add_mode(job *j, qdot_expr w, const qdot_expr *y)
{
    qdot_pool *pool = j->pool;
    size_t n = j->s->coordinates.n, m = j->m.n;
    qdot_expr first = QDOT_NIL;

    QDOT_TRY(qdot_vec_push(&j->frequency, w));
    for (size_t i = 0; i < n; i++) {
        qdot_expr x = QDOT_ZERO;

        for (size_t a = 0; a < m; a++)
            x = qdot_add(pool, x, qdot_mul(pool, j->m.N[i * m + a], y[a]));
        x = qdot_simplify(pool, x, &j->facts);
        QDOT_TRY(qdot_pool_check(pool));
        if (first == QDOT_NIL && !is_proved_zero(j, x))
            first = x;
        if (first != QDOT_NIL)
            x = qdot_rationalize(pool, qdot_div(pool, x, first), &j->facts);
        QDOT_TRY(qdot_pool_check(pool));
        QDOT_TRY(qdot_vec_push(&j->amplitude, x));
    }
    return QDOT_OK;
}

/* --- exact modes ---------------------------------------------------------------------- */

static qdot_status
reduce_to_echelon_form(const job *j, qdot_expr *A, size_t *pivot, size_t *rank)
{
    qdot_pool *pool = j->pool;
    size_t n = j->m.n;

    *rank = 0;
    for (size_t c = 0; c < n; c++) {
        size_t r = *rank;

        while (r < n && is_proved_zero(j, A[r * n + c]))
            r++;
        if (r == n)
            continue;
        for (size_t k = 0; k < n; k++) {
            qdot_expr keep = A[r * n + k];

            A[r * n + k] = A[*rank * n + k];
            A[*rank * n + k] = keep;
        }
        for (size_t k = n; k-- > 0;)
            if (k != c)
                A[*rank * n + k] = qdot_simplify(
                    pool, qdot_div(pool, A[*rank * n + k], A[*rank * n + c]), &j->facts);
        A[*rank * n + c] = QDOT_ONE;
        for (r = 0; r < n; r++) {
            qdot_expr by = A[r * n + c];

            for (size_t k = 0; r != *rank && by != QDOT_ZERO && k < n; k++)
                A[r * n + k] = qdot_simplify(
                    pool,
                    qdot_sub(pool, A[r * n + k], qdot_mul(pool, by, A[*rank * n + k])),
                    &j->facts);
        }
        QDOT_TRY(qdot_pool_check(pool));
        pivot[(*rank)++] = c;
    }
    return QDOT_OK;
}

static qdot_status
fail_because_unstable(void)
{
    return qdot_fail(QDOT_EDOMAIN,
                     "the equilibrium is not stable: there is no oscillation about it");
}

/* Add the modes for one root W = w^2: the null space of H - W M. */
static qdot_status
add_modes_of_root(job *j, qdot_expr W)
{
    qdot_pool *pool = j->pool;
    size_t n = j->m.n, rank = 0;
    qdot_expr *A = qdot_calloc(n * n + n, sizeof *A), *y = A + n * n;
    size_t *pivot = qdot_calloc(n, sizeof *pivot);
    qdot_expr w = qdot_sqrt(pool, W);
    qdot_status status = QDOT_OK;

    if (A == NULL || pivot == NULL)
        status = QDOT_ENOMEM;
    else if (qdot_positive(pool, W, &j->facts, 0, NULL) == QDOT_FALSE && !is_proved_zero(j, W))
        w = QDOT_NIL;
    if (w == QDOT_NIL && status == QDOT_OK && !qdot_pool_failed(pool))
        status = fail_because_unstable();
    for (size_t i = 0; i < n * n && status == QDOT_OK; i++)
        A[i] = qdot_simplify(
            pool, qdot_sub(pool, j->m.H[i], qdot_mul(pool, W, j->m.M[i])), &j->facts);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_EDOMAIN)
        status = fail_because_unstable();
    if (status == QDOT_OK)
        status = reduce_to_echelon_form(j, A, pivot, &rank);
    for (size_t c = 0; c < n && status == QDOT_OK; c++) {
        bool dependent = false;

        for (size_t r = 0; r < rank; r++)
            dependent |= pivot[r] == c;
        if (dependent)
            continue;
        for (size_t i = 0; i < n; i++)
            y[i] = i == c ? QDOT_ONE : QDOT_ZERO;
        for (size_t r = 0; r < rank; r++)
            y[pivot[r]] = qdot_neg(pool, A[r * n + c]);
        status = add_mode(j, qdot_simplify(pool, w, &j->facts), y);
    }
    qdot_free(A);
    qdot_free(pivot);
    return status;
}

/* Compare frequencies: *order is 1 if a <= b, -1 if a > b, by declared signs and assumptions; else 0. */
static qdot_status
frequency_order(const job *j, qdot_expr a, qdot_expr b, int *order)
{
    qdot_pool *pool = j->pool;
    qdot_expr d = qdot_sub(pool, qdot_mul(pool, b, b), qdot_mul(pool, a, a));
    qdot_decision decision;
    uint8_t sign;

    d = qdot_simplify(pool, d, &j->facts);
    QDOT_TRY(qdot_pool_check(pool));
    sign = qdot_expr_node(pool, d)->sign;
    *order = sign & QDOT_GE0 ? 1 : sign & QDOT_LE0 ? -1 : 0;
    for (int way = 1; way >= -1 && *order == 0; way -= 2) {
        QDOT_TRY(qdot_decide_less(pool, way > 0 ? QDOT_ZERO : d, way > 0 ? d : QDOT_ZERO,
                                  false, &j->facts, &decision));
        if (decision.verdict == QDOT_PROVED)
            *order = way;
    }
    return QDOT_OK;
}

/* The order of a and b at the parameter values; parameters without value get a generic one. */
static int
compare_numerically(const job *j, qdot_expr a, qdot_expr b)
{
    qdot_expr pair[2] = {a, b};
    double v[2];

    for (int k = 0; k < 2; k++)
        pair[k] = insert_values(j, pair[k]);
    if (pair[0] == QDOT_NIL || pair[1] == QDOT_NIL ||
        qdot_generic_evaluate(j->pool, 2, pair, NULL, v) != QDOT_OK)
        return 1;
    return v[0] > v[1] ? -1 : 1;
}

static void
exchange_modes(job *j, size_t a, size_t b)
{
    size_t width = j->s->coordinates.n;
    qdot_expr keep = j->frequency.at[a];

    j->frequency.at[a] = j->frequency.at[b];
    j->frequency.at[b] = keep;
    for (size_t i = 0; i < width; i++) {
        keep = j->amplitude.at[a * width + i];
        j->amplitude.at[a * width + i] = j->amplitude.at[b * width + i];
        j->amplitude.at[b * width + i] = keep;
    }
}

/* Sort the modes by ascending frequency. */
static qdot_status
frequencies_sort(job *j)
{
    for (size_t a = 1; a < j->frequency.n; a++)
        for (size_t b = a; b > 0; b--) {
            qdot_expr left = j->frequency.at[b - 1], right = j->frequency.at[b];
            int order = 1;

            if (left != right)
                QDOT_TRY(frequency_order(j, left, right, &order));
            if (order == 0) {
                j->unordered = true;
                order = compare_numerically(j, left, right);
            }
            if (order > 0)
                break;
            exchange_modes(j, b - 1, b);
        }
    return QDOT_OK;
}

/* The two roots of det(H - W M) = 0 as
 *
 *     2 a W = b -+ sqrt((M11 H22 - M22 H11)^2 + 4 (M11 H12 - M12 H11)(M22 H12 - M12 H22)),
 *     a = det M,   b = M11 H22 + M22 H11 - 2 M12 H12,
 *
 * whose root is mostly shorter than that of b^2 - 4 a det H; taken where W is. */
static void
solve_two_coordinates(job *j, qdot_root *roots)
{
    qdot_pool *pool = j->pool;
    const qdot_expr *M = j->m.M, *H = j->m.H;
    qdot_expr cross[4], b, root, W[2];
    static const int pick[3][4] = {{0, 3, 3, 0}, {0, 1, 1, 0}, {3, 1, 1, 3}};

    for (int i = 0; i < 3; i++) /* cross products of entries of M and H, such as M11 H22 - M22 H11 */
        cross[i] =
            qdot_simplify(pool,
                          qdot_sub(pool, qdot_mul(pool, M[pick[i][0]], H[pick[i][1]]),
                                   qdot_mul(pool, M[pick[i][2]], H[pick[i][3]])),
                          &j->facts);
    cross[3] = qdot_sub(pool, qdot_mul(pool, M[0], M[3]), qdot_mul(pool, M[1], M[1]));
    b = qdot_add(pool, qdot_mul(pool, M[0], H[3]), qdot_mul(pool, M[3], H[0]));
    b = qdot_sub(pool, b,
                 qdot_mul(pool, qdot_expr_int(pool, 2), qdot_mul(pool, M[1], H[1])));
    root = qdot_mul(pool, qdot_expr_int(pool, 4), qdot_mul(pool, cross[1], cross[2]));
    root = qdot_add(pool, qdot_pow_int(pool, cross[0], 2), root);
    root = qdot_sqrt(pool, qdot_simplify(pool, root, &j->facts));
    for (int i = 0; i < 2; i++) {
        W[i] = i == 0 ? qdot_sub(pool, b, root) : qdot_add(pool, b, root);
        W[i] = qdot_div(pool, W[i], qdot_mul(pool, qdot_expr_int(pool, 2), cross[3]));
        W[i] = qdot_simplify(pool, W[i], &j->facts);
    }
    if (qdot_pool_failed(pool))
        return;
    if (qdot_expr_size(pool, W[0]) + qdot_expr_size(pool, W[1]) <
        qdot_expr_size(pool, roots[0].value) + qdot_expr_size(pool, roots[1].value))
        for (int i = 0; i < 2; i++)
            roots[i].value = W[i];
}

/* Find the modes by exact formulas; *done: all n modes were found. */
static qdot_status
find_exact_modes(job *j, bool *done)
{
    qdot_pool *pool = j->pool;
    size_t n = j->m.n;
    qdot_expr W = qdot_symbol_get(pool, QDOT_FORMAL, "omega^2"), *A, e;
    qdot_solutions roots;
    qdot_status status;

    *done = false;
    if (n > MOST_EXACT)
        return QDOT_OK;
    A = qdot_calloc(n * n, sizeof *A);
    if (A == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n * n; i++)
        A[i] = qdot_sub(pool, j->m.H[i], qdot_mul(pool, W, j->m.M[i]));
    e = n == 1 ? A[0] : qdot_det(pool, qdot_matrix(pool, (uint32_t)n, (uint32_t)n, A));
    qdot_free(A);
    QDOT_TRY(qdot_pool_check(pool));
    status = qdot_solve(pool, e, W, &j->facts, &roots);
    if (status == QDOT_OK && n == 2 && roots.root.n == 2 && roots.complete)
        solve_two_coordinates(j, roots.root.at);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    for (size_t k = 0; k < roots.root.n && roots.complete && status == QDOT_OK; k++)
        status = add_modes_of_root(j, roots.root.at[k].value);
    *done = roots.complete && j->frequency.n == n;
    qdot_solutions_clear(&roots);
    if (status == QDOT_OK && *done)
        status = frequencies_sort(j);
    return status;
}

/* --- numerical modes ---------------------------------------------------------------------- */

/* Evaluate e [n] with parameter values; QDOT_EUNSET names a parameter without one. */
static qdot_status
evaluate_all(const job *j, size_t n, const qdot_expr *e, double *out)
{
    qdot_pool *pool = j->pool;
    qdot_expr list = qdot_list(pool, (uint32_t)n, e), atoms;
    qdot_expr *bound;
    qdot_status status;

    list = insert_values(j, list);
    QDOT_TRY(qdot_pool_check(pool));
    atoms = qdot_expr_atoms(pool, list, true);
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr x = qdot_expr_arg(pool, atoms, i);

        if (qdot_expr_is_class(pool, x, QDOT_CONST))
            continue;
        qdot_fail(QDOT_EUNSET,
                  "the modes cannot be found exactly; numbers need a value of `%.100s`",
                  qdot_expr_kind(pool, x) == QDOT_SYM
                      ? qdot_expr_symbol(pool, x)->name
                      : qdot_ufun_get(pool, qdot_expr_node(pool, x)->op)->name);
        return qdot_hint("set %.100s = ...", qdot_expr_kind(pool, x) == QDOT_SYM
                                                 ? qdot_expr_symbol(pool, x)->name
                                                 : "f(...)");
    }
    bound = qdot_malloc((n + 1) * sizeof *bound);
    if (bound == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        bound[i] = qdot_expr_arg(pool, list, (uint32_t)i);
    status = qdot_generic_evaluate(pool, n, bound, NULL, out);
    qdot_free(bound);
    return status;
}

/* Add a numerical mode: x = N y, scaled so that the first component that is not small is 1. */
static qdot_status
add_numeric_mode(job *j, double w, const double *N, const gsl_matrix *Y, size_t k)
{
    size_t n = j->s->coordinates.n, m = j->m.n;
    double *x = qdot_calloc(n, sizeof *x), most = 0, first = 0;
    qdot_status status = x == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        for (size_t a = 0; a < m; a++)
            x[i] += N[i * m + a] * gsl_matrix_get(Y, a, k);
        most = fmax(most, fabs(x[i]));
    }
    if (status == QDOT_OK)
        status = qdot_vec_push(&j->frequency, qdot_generic_decimal(j->pool, w));
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        double v;

        if (first == 0 && fabs(x[i]) > 1e-9 * most)
            first = x[i];
        v = fabs(x[i]) > 1e-12 * most && first != 0 ? x[i] / first : 0;
        status = qdot_vec_push(&j->amplitude, qdot_generic_decimal(j->pool, v));
    }
    qdot_free(x);
    return status == QDOT_OK ? qdot_pool_check(j->pool) : status;
}

static qdot_status
find_numeric_modes(job *j)
{
    size_t n = j->s->coordinates.n, m = j->m.n;
    double *v = qdot_calloc(3 * m * m + n * m + 1, sizeof *v);
    gsl_matrix *H = gsl_matrix_alloc(m, m), *M = gsl_matrix_alloc(m, m),
               *Y = gsl_matrix_alloc(m, m);
    gsl_vector *W = gsl_vector_alloc(m);
    gsl_eigen_gensymmv_workspace *work = gsl_eigen_gensymmv_alloc(m);
    gsl_error_handler_t *before = gsl_set_error_handler_off();
    qdot_status status =
        v == NULL || H == NULL || M == NULL || Y == NULL || W == NULL || work == NULL
            ? QDOT_ENOMEM
            : QDOT_OK;

    if (status == QDOT_OK) /* the arrays M, Gamma, H, N follow each other in memory */
        status = evaluate_all(j, 3 * m * m + n * m, j->m.M, v);
    for (size_t i = 0; i < m * m && status == QDOT_OK; i++) {
        M->data[i] = v[i];
        H->data[i] = v[2 * m * m + i];
    }
    if (status == QDOT_OK && gsl_eigen_gensymmv(H, M, W, Y, work) != GSL_SUCCESS)
        status =
            qdot_fail(QDOT_ESINGULAR, "the mass matrix is not positive definite there");
    if (status == QDOT_OK)
        gsl_eigen_gensymmv_sort(W, Y, GSL_EIGEN_SORT_VAL_ASC);
    for (size_t k = 0; k < m && status == QDOT_OK; k++) {
        double square = gsl_vector_get(W, k),
               scale = fmax(fabs(gsl_vector_get(W, 0)), fabs(gsl_vector_get(W, m - 1)));

        if (square < -1e-10 * scale)
            status = fail_because_unstable();
        else
            status = add_numeric_mode(j, sqrt(square > 1e-13 * scale ? square : 0),
                                      v + 3 * m * m, Y, k);
    }
    j->numeric = true;
    gsl_set_error_handler(before);
    gsl_matrix_free(H);
    gsl_matrix_free(M);
    gsl_matrix_free(Y);
    gsl_vector_free(W);
    if (work != NULL)
        gsl_eigen_gensymmv_free(work);
    qdot_free(v);
    return status;
}

/* --- modes, exact or numerical ------------------------------------------------------------- */

void
qdot_modes_clear(qdot_modes *m)
{
    qdot_free(m->frequency);
    qdot_free(m->amplitude);
    *m = (qdot_modes){0};
}

/* The linear motion about the place, to j->m: where the forces have values but no slopes, as -x^(1/2) at 0, there is
 * none. */
static qdot_status
modes_linearise(job *j, qdot_expr equations)
{
    qdot_status status = qdot_linear_motion_about(j->s, equations, QDOT_NIL, &j->m);

    for (size_t i = 0; i < j->s->coordinates.n && status == QDOT_EDOMAIN; i++) {
        (void)qdot_rest_value(j->s, equations, qdot_motion_residual(j->s, i));
        QDOT_TRY(qdot_pool_check(j->pool)); /* fails if the equations have no value at the equilibrium */
    }
    if (status != QDOT_EDOMAIN)
        return status;
    return qdot_fail(QDOT_ETYPE, "the forces have no slopes at the equilibrium: there is no linear motion about it, so "
                                 "it has no normal modes");
}

qdot_status
qdot_modes_about(qdot_scene *s, qdot_expr equations, bool numbers, qdot_binder bind,
                 void *user, qdot_modes *out)
{
    job j = {.s = s,
             .pool = s->pool,
             .facts = qdot_scene_facts(s),
             .bind = bind,
             .user = user};
    bool done = false, holonomic;
    qdot_status status;

    *out = (qdot_modes){0};
    QDOT_TRY(qdot_scene_need_no_states(s, "modes"));
    QDOT_TRY(qdot_mech_is_holonomic(s, &holonomic));
    if (!holonomic)
        return qdot_fail(QDOT_ETYPE, "normal modes need holonomic constraints");
    QDOT_TRY(modes_linearise(&j, equations));
    status = check_is_equilibrium(&j, equations);
    if (status == QDOT_OK)
        status = check_linear_motion(&j);
    if (status == QDOT_OK)
        status = check_smooth(&j, equations);
    if (status == QDOT_OK && !numbers)
        status = find_exact_modes(&j, &done);
    if (status == QDOT_OK && !done) {
        j.frequency.n = j.amplitude.n = 0;
        status = find_numeric_modes(&j);
    }
    qdot_linear_motion_clear(&j.m);
    out->n = j.frequency.n;
    out->frequency = j.frequency.at;
    out->amplitude = j.amplitude.at;
    out->numeric = j.numeric;
    out->unordered = j.unordered;
    if (status != QDOT_OK)
        qdot_modes_clear(out);
    return status;
}
