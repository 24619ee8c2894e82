/* eigenvalues.c -- the function eigenvalues(M): exact where a formula gives them, else enclosed in numbers; a complex one
 * is the list [re, im]. */
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/answer/answer.h"
#include "lang/functions/builtin.h"
#include "lang/functions/linear.h"
#include "lang/functions/solve-conditions.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/units.h"
#include "mech/scene/things.h"
#include "normal/inequality/less.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/eigenvalues.h"
#include "normal/solve/solve.h"
#include "num/eigenvalues.h"

typedef qdot_vec(qdot_expr) expressions;

/* --- in symbols ---------------------------------------------------------------------------- */

/* Give a notice of the condition under which eigenvalues are real or imaginary. */
static qdot_status
tell_condition(qdot_session *s, const char *what, qdot_expr condition)
{
    qdot_text text = {0};

    if (condition == QDOT_NIL)
        return QDOT_OK;
    qdot_text_format(&text, "these eigenvalues are %s where ", what);
    return qdot_answer_condition_text(s, qdot_solve_print_conditions(s->pool, "", condition, &text), &text);
}

/* Add each real root of f = 0 as often as its multiplicity; *condition: nil, or under which they are all real. */
static qdot_status
add_real_roots(qdot_session *s, qdot_expr f, qdot_expr x, bool *complete, qdot_expr *condition, expressions *values)
{
    qdot_pool *pool = s->pool;
    const qdot_facts facts = qdot_scene_facts(s->scene);
    qdot_solutions roots = {0};
    qdot_status status = qdot_solve(pool, f, x, &facts, &roots);

    for (size_t i = 0; i < roots.root.n && status == QDOT_OK; i++)
        for (qdot_expr p = f; p != QDOT_NIL && p != QDOT_ZERO && status == QDOT_OK; p = qdot_diff(pool, p, x)) {
            if (!qdot_is_zero(pool, qdot_subs(pool, p, 1, &x, &roots.root.at[i].value), &facts))
                break;
            status = qdot_vec_push(values, roots.root.at[i].value);
        }
    *condition = QDOT_NIL;
    for (size_t i = 0; i < roots.root.n && status == QDOT_OK; i++)
        *condition = roots.root.at[i].condition != QDOT_NIL ? roots.root.at[i].condition : *condition;
    *complete = roots.complete;
    qdot_solutions_clear(&roots);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* The degree of a polynomial in x, up to `most`. */
static uint32_t
degree_in(qdot_pool *pool, qdot_expr f, qdot_expr x, uint32_t most)
{
    uint32_t degree = 0;

    for (uint32_t k = 1; k <= most; k++)
        if (qdot_coefficient(pool, f, x, (int64_t)k) != QDOT_ZERO)
            degree = k;
    return degree;
}

static bool
is_proved_negative(qdot_session *s, qdot_expr e)
{
    const qdot_facts facts = qdot_scene_facts(s->scene);
    qdot_decision d;

    return qdot_decide_less(s->pool, e, QDOT_ZERO, false, &facts, &d) == QDOT_OK && d.verdict == QDOT_PROVED;
}

/* Add re - i im and re + i im to the eigenvalues. */
static qdot_status
add_pair(qdot_session *s, qdot_expr re, qdot_expr im, expressions *values)
{
    const qdot_facts facts = qdot_scene_facts(s->scene);

    re = qdot_simplify(s->pool, re, &facts);
    im = qdot_simplify(s->pool, im, &facts);
    for (int k = 0; k < 2; k++) {
        const qdot_expr parts[2] = {re, k == 0 ? qdot_neg(s->pool, im) : im};

        QDOT_TRY(qdot_vec_push(values, qdot_list(s->pool, 2, parts)));
    }
    return qdot_pool_check(s->pool);
}

/* Add the complex roots of a factor that is quadratic in x, or in x^2 without odd powers, where the signs in it are proved;
 * *all: no other roots are left. */
static qdot_status
add_complex_roots(qdot_session *s, qdot_expr f, qdot_expr x, uint32_t degree, bool *all, expressions *values)
{
    qdot_pool *pool = s->pool;
    const qdot_facts facts = qdot_scene_facts(s->scene);
    const qdot_expr a = qdot_coefficient(pool, f, x, 2), b = qdot_coefficient(pool, f, x, 1),
                    c = qdot_coefficient(pool, f, x, 0);
    qdot_expr square = qdot_symbol_get(pool, QDOT_FORMAL, "eigenvalue^2"), even = QDOT_ZERO;
    qdot_solutions roots = {0};
    qdot_status status;

    *all = false;
    if (degree == 2) {
        const qdot_expr D = qdot_simplify(
            pool, qdot_sub(pool, qdot_pow_int(pool, b, 2), qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 4), a, c})),
            &facts);
        const qdot_expr twice = qdot_mul(pool, qdot_expr_int(pool, 2), a);

        QDOT_TRY(qdot_pool_check(pool));
        *all = is_proved_negative(s, D);
        return !*all ? QDOT_OK
                     : add_pair(s, qdot_div(pool, qdot_neg(pool, b), twice),
                                qdot_div(pool, qdot_sqrt(pool, qdot_neg(pool, D)), twice), values);
    }
    for (uint32_t k = 0; k <= degree; k++) {
        const qdot_expr coefficient = qdot_coefficient(pool, f, x, (int64_t)k);

        if (k % 2 == 1 && coefficient != QDOT_ZERO)
            return QDOT_OK;
        even = qdot_add(pool, even, qdot_mul(pool, coefficient, qdot_pow_int(pool, square, (int64_t)k / 2)));
    }
    status = qdot_solve(pool, even, square, &facts, &roots);
    *all = status == QDOT_OK && roots.complete && 2 * roots.root.n == degree;
    for (size_t i = 0; i < roots.root.n && *all; i++)
        *all = is_proved_negative(s, roots.root.at[i].value);
    if (*all && status == QDOT_OK) /* the roots in x^2 are real under one condition */
        status = tell_condition(s, "imaginary", roots.root.n > 0 ? roots.root.at[0].condition : QDOT_NIL);
    for (size_t i = 0; i < roots.root.n && *all && status == QDOT_OK; i++)
        status = add_pair(s, QDOT_ZERO, qdot_sqrt(pool, qdot_neg(pool, roots.root.at[i].value)), values);
    qdot_solutions_clear(&roots);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* Every eigenvalue as an expression; *all: all were found. */
static qdot_status
find_exact(qdot_session *s, qdot_expr det, qdot_expr x, uint32_t n, bool *all, expressions *values)
{
    qdot_pool *pool = s->pool;
    qdot_expr product, condition;
    bool complete;

    QDOT_TRY(add_real_roots(s, det, x, &complete, &condition, values));
    *all = complete && values->n == n && condition == QDOT_NIL;
    if (*all)
        return QDOT_OK;
    values->n = 0;
    product = qdot_solve_product(pool, det);
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 1; i < (qdot_expr_kind(pool, product) == QDOT_PROD ? qdot_expr_count(pool, product) : 2); i += 2) {
        const bool whole = qdot_expr_kind(pool, product) != QDOT_PROD;
        const qdot_expr f = qdot_expand(pool, whole ? product : qdot_expr_arg(pool, product, i));
        int64_t power = 1;
        const size_t before = values->n;
        uint32_t degree;

        QDOT_TRY(qdot_pool_check(pool));
        degree = degree_in(pool, f, x, n);
        if (degree == 0)
            continue;
        if (!whole)
            (void)qdot_expr_to_int(pool, qdot_expr_arg(pool, product, i + 1), &power);
        QDOT_TRY(add_real_roots(s, f, x, &complete, &condition, values));
        if (values->n - before < degree || condition != QDOT_NIL) {
            const bool real = complete && values->n - before == degree;
            expressions complex = {0};
            qdot_status status = add_complex_roots(s, f, x, degree, &complete, &complex);

            if (status == QDOT_OK && complete)
                values->n = before;
            for (size_t k = 0; k < complex.n && status == QDOT_OK && complete; k++)
                status = qdot_vec_push(values, complex.at[k]);
            qdot_free(complex.at);
            QDOT_TRY(status);
            if (!complete && !real)
                return QDOT_OK;
            if (!complete)
                QDOT_TRY(tell_condition(s, "real", condition));
        }
        for (size_t from = before, to = values->n; power > 1; power--)
            for (size_t k = from; k < to; k++)
                QDOT_TRY(qdot_vec_push(values, values->at[k]));
    }
    *all = values->n == n;
    return QDOT_OK;
}

/* --- in numbers -------------------------------------------------------------------------------- */

static qdot_status
add_number(qdot_session *s, double re, double im, double error, expressions *values)
{
    const qdot_expr parts[2] = {qdot_measured_new(s, re, error), im != 0 ? qdot_measured_new(s, im, error) : QDOT_NIL};

    return qdot_vec_push(values, im != 0 ? qdot_list(s->pool, 2, parts) : parts[0]);
}

static qdot_status
find_numbers(qdot_session *s, uint32_t n, const qdot_expr *entries, expressions *values)
{
    double *re = qdot_calloc(3 * (size_t)n + 1, sizeof *re);
    qdot_status status = re == NULL ? QDOT_ENOMEM
                                    : qdot_eigenvalues_of_constants(s->pool, n, entries, re, re + n, re + 2 * (size_t)n);

    for (uint32_t k = 0; k < n && status == QDOT_OK; k++)
        status = add_number(s, re[k], re[n + k], re[2 * n + k], values);
    qdot_free(re);
    return status == QDOT_OK ? qdot_pool_check(s->pool) : status;
}

/* Rows and columns that are 0 beside their entry on the diagonal have that for an eigenvalue, and nothing else depends on
 * it: leave them out. *left, which [n]: the indices of the others. */
static qdot_status
deflate(qdot_session *s, uint32_t n, qdot_expr M, uint32_t *left, uint32_t *which, expressions *values)
{
    bool found = true;

    *left = n;
    for (uint32_t i = 0; i < n; i++)
        which[i] = i;
    while (found) {
        found = false;
        for (uint32_t i = 0; i < *left && !found; i++) {
            bool row = true, column = true;

            for (uint32_t k = 0; k < *left; k++) {
                row = row && (k == i || qdot_expr_arg(s->pool, M, which[i] * n + which[k]) == QDOT_ZERO);
                column = column && (k == i || qdot_expr_arg(s->pool, M, which[k] * n + which[i]) == QDOT_ZERO);
            }
            found = row || column;
            if (!found)
                continue;
            QDOT_TRY(qdot_vec_push(values, qdot_expr_arg(s->pool, M, which[i] * n + which[i])));
            for (uint32_t k = i; k + 1 < *left; k++)
                which[k] = which[k + 1];
            --*left;
        }
    }
    return QDOT_OK;
}

/* Of entries with errors: first those that stand alone, then ascending in the real part. */
static qdot_status
find_with_errors(qdot_session *s, uint32_t n, qdot_expr M, expressions *values)
{
    const size_t size = (size_t)n * n;
    double *A = qdot_calloc(2 * size + 3 * (size_t)n + 1, sizeof *A), *E = A + size, *re = E + size, *im = re + n, *error = im + n;
    uint32_t *which = qdot_calloc(n + 1, sizeof *which), m = n;
    qdot_status status = A == NULL || which == NULL ? QDOT_ENOMEM : deflate(s, n, M, &m, which, values);

    for (uint32_t i = 0; i < m * m && status == QDOT_OK; i++)
        status = qdot_session_number(s, qdot_expr_arg(s->pool, M, which[i / m] * n + which[i % m]), &A[i], &E[i]);
    if (status == QDOT_OK && m > 0)
        status = qdot_eigenvalues(m, A, E, re, im, error);
    for (uint32_t left = m; left > 0 && status == QDOT_OK; left--) {
        uint32_t k = 0;

        for (uint32_t i = 1; i < left; i++)
            if (re[i] < re[k] - 1e-9 || (re[i] <= re[k] + 1e-9 && im[i] < im[k]))
                k = i;
        status = add_number(s, re[k], im[k], error[k], values);
        for (uint32_t i = k; i + 1 < left; i++) {
            re[i] = re[i + 1];
            im[i] = im[i + 1];
            error[i] = error[i + 1];
        }
    }
    qdot_free(A);
    qdot_free(which);
    return status == QDOT_OK ? qdot_pool_check(s->pool) : status;
}

/* --- the function --------------------------------------------------------------------------------- */

qdot_status
qdot_call_eigenvalues(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    qdot_pool *pool = s->pool;
    const qdot_expr x = qdot_symbol_get(pool, QDOT_FORMAL, "eigenvalue");
    const bool measured = qdot_measured_occurs(s, args[0]);
    const qdot_expr M = qdot_measured_as_rationals(s, args[0]);
    expressions values = {0};
    qdot_expr *entries, det;
    bool all = false, constant = true;
    uint32_t size;
    qdot_status status;

    (void)n;
    if (qdot_expr_kind(pool, M) != QDOT_MAT)
        return qdot_fail(QDOT_ETYPE, "eigenvalues takes a matrix, not %s", qdot_value_kind_words(pool, M));
    size = qdot_expr_node(pool, M)->op;
    if (size * size != qdot_expr_count(pool, M))
        return qdot_fail(QDOT_ETYPE, "eigenvalues takes a square matrix");
    entries = qdot_malloc((size_t)size * size * sizeof *entries);
    if (entries == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < size * size; i++) {
        entries[i] = qdot_expr_arg(pool, M, i);
        constant = constant && qdot_expr_is_constant(pool, entries[i]);
        if (i % (size + 1) == 0)
            entries[i] = qdot_sub(pool, entries[i], x);
    }
    det = measured ? QDOT_ONE : qdot_det(pool, qdot_matrix(pool, size, size, entries));
    status = qdot_value_kind_check(pool, det);
    if (status == QDOT_OK && !measured)
        status = find_exact(s, det, x, size, &all, &values);
    if (status == QDOT_OK && measured && constant) {
        status = find_with_errors(s, size, args[0], &values);
    } else if (status == QDOT_OK && !all && constant) {
        values.n = 0;
        for (uint32_t i = 0; i < size * size; i++)
            entries[i] = qdot_expr_arg(pool, M, i);
        status = find_numbers(s, size, entries, &values);
    } else if (status == QDOT_OK && !all) {
        (void)qdot_fail(QDOT_EFAILED, "no formula is found for the eigenvalues");
        status = qdot_hint("eigenvalues(numeric(M)) with the values of `set`");
    }
    if (status == QDOT_OK)
        status = qdot_value_kind_give(pool, qdot_list(pool, size, values.at), value);
    if (status == QDOT_OK && args[0] == s->history->linear.A)
        status = qdot_units_give_rate(s, value);
    qdot_free(values.at);
    qdot_free(entries);
    return status;
}
