/* angle-basis.c -- each angle's values at sample points make a column; finds columns that
 * depend on earlier ones. */
#include "normal/prove/angle-basis.h"

#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/equal.h"
#include "normal/refute/sample.h"

enum { MOST = 12, POINTS = MOST + 3, TRIES = 120, LARGEST = 64 };

/* Angles at sample points: column 0 is pi, then the angles; `base` is orthonormalised by Gram-Schmidt. */
struct basis {
    qdot_pool *pool;
    size_t n, points;
    qdot_expr column[MOST + 1];
    double value[MOST + 1][POINTS];
    double base[MOST + 1][POINTS]; /* orthonormal vectors from the independent columns */
    double share[MOST + 1][MOST + 1]; /* coefficients: column j = sum_i share[j][i] base[i] + remainder */
    double length[MOST + 1]; /* length of the remainder of a column; 0: the column is dependent */
};

static bool
is_angle(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_is_function_that(pool, e, QDOT_FUN_ARC) ||
           qdot_expr_is_function_that(pool, e, QDOT_FUN_AREA) ||
           qdot_expr_is_function(pool, e, QDOT_LOG);
}

/* Collect the angles as columns, simpler ones first. */
static qdot_status
basis_gather(struct basis *b, size_t n, const qdot_expr *e)
{
    qdot_walk w;

    b->column[b->n++] = QDOT_PI;
    QDOT_TRY(qdot_walk_begin_n(b->pool, n, e, &w));
    for (size_t i = 0; i < w.n; i++) {
        size_t k = b->n;

        if (!is_angle(b->pool, w.at[i]))
            continue;
        if (b->n > MOST) {
            b->n = 0;
            break;
        }
        for (; k > 1 && qdot_expr_size(b->pool, b->column[k - 1]) >
                            qdot_expr_size(b->pool, w.at[i]);
             k--)
            b->column[k] = b->column[k - 1];
        b->column[k] = w.at[i];
        b->n++;
    }
    qdot_walk_end(&w);
    return QDOT_OK;
}

static qdot_status
basis_evaluate(struct basis *b, const qdot_facts *facts)
{
    qdot_expr list = qdot_list(b->pool, (uint32_t)b->n, b->column);
    qdot_sample s;

    if (list == QDOT_NIL)
        return QDOT_OK;
    QDOT_TRY(qdot_sample_begin(&s, b->pool, 1, &list, facts));
    for (int k = 0; k < TRIES && s.possible && b->points < b->n + 2; k++) {
        bool all = true;

        qdot_sample_point(&s, k);
        if (!qdot_sample_values(&s, 128))
            continue;
        for (size_t j = 0; j < b->n && all; j++) {
            arb_srcptr v = qdot_ball_get(&s.ball, b->column[j]);

            all = v != NULL;
            if (all)
                b->value[j][b->points] = arf_get_d(arb_midref(v), ARF_RND_NEAR);
        }
        b->points += all;
    }
    qdot_sample_end(&s);
    return QDOT_OK;
}

static double
dot(const struct basis *b, const double *x, const double *y)
{
    double sum = 0;

    for (size_t i = 0; i < b->points; i++)
        sum += x[i] * y[i];
    return sum;
}

/* Find the component of column j orthogonal to the earlier columns; done twice because of rounding errors. */
static void
basis_project(struct basis *b, size_t j)
{
    double *rest = b->base[j], before = sqrt(dot(b, b->value[j], b->value[j]));

    for (size_t i = 0; i < b->points; i++)
        rest[i] = b->value[j][i];
    for (int again = 0; again < 2; again++)
        for (size_t k = 0; k < j; k++) {
            double c = b->length[k] == 0 ? 0 : dot(b, rest, b->base[k]);

            b->share[j][k] += c;
            for (size_t i = 0; i < b->points; i++)
                rest[i] -= c * b->base[k][i];
        }
    b->length[j] = sqrt(dot(b, rest, rest));
    if (b->length[j] < 1e-11 * (before + 1))
        b->length[j] = 0;
    for (size_t i = 0; i < b->points && b->length[j] > 0; i++)
        rest[i] /= b->length[j];
}

/* Find a fraction n/d with a small denominator close to x; false if there is none. */
static bool
small_fraction(double x, int64_t *n, int64_t *d)
{
    for (*d = 1; *d <= 24; (*d)++) {
        double near = nearbyint(x * (double)*d);

        *n = (int64_t)near;
        if (fabs(near) <= LARGEST && fabs(x * (double)*d - near) < 1e-7)
            return true;
    }
    return false;
}

/* Guess the linearly dependent column j as a combination of earlier ones; nil if a coefficient is no small fraction. */
static qdot_expr
guess_combination(struct basis *b, size_t j)
{
    qdot_expr sum = QDOT_ZERO;
    double share[MOST + 1];
    int64_t n, d;

    for (size_t k = 0; k < j; k++)
        share[k] = b->share[j][k];
    for (size_t k = j; k-- > 0;) {
        double c;

        if (b->length[k] == 0)
            continue;
        c = share[k] / b->length[k];
        for (size_t i = 0; i < k; i++)
            share[i] -= c * b->share[k][i];
        if (!small_fraction(c, &n, &d))
            return QDOT_NIL;
        sum = qdot_add(b->pool, sum,
                       qdot_mul(b->pool, qdot_expr_ratio(b->pool, n, d), b->column[k]));
    }
    return sum;
}

/* Guess a constant column j as c B + q pi with one earlier constant B and fractions c, q; nil if none fits. */
static qdot_expr
guess_constant(struct basis *b, size_t j)
{
    qdot_pool *pool = b->pool;
    int64_t n, d;

    for (size_t k = 1; k < j; k++)
        for (int64_t up = -4; up <= 4 && qdot_expr_is_constant(pool, b->column[k]); up++)
            for (int64_t down = 1; down <= 4 && up != 0; down++) {
                double c = (double)up / (double)down;
                double q = (b->value[j][0] - c * b->value[k][0]) / M_PI;

                if (small_fraction(q, &n, &d) && d <= 4 &&
                    fabs(q - (double)n / (double)d) < 1e-12)
                    return qdot_add(pool,
                                    qdot_mul(pool, qdot_expr_ratio(pool, up, down),
                                             b->column[k]),
                                    qdot_mul(pool, qdot_expr_ratio(pool, n, d), QDOT_PI));
            }
    return QDOT_NIL;
}

qdot_status
qdot_angle_basis(qdot_pool *pool, size_t n, qdot_expr *e, const qdot_facts *facts,
                 bool *changed)
{
    struct basis b = {.pool = pool};
    qdot_expr from[MOST], to[MOST];
    size_t count = 0;

    *changed = false;
    QDOT_TRY(basis_gather(&b, n, e));
    if (b.n < 2)
        return QDOT_OK;
    QDOT_TRY(basis_evaluate(&b, facts));
    if (b.points < b.n + 2)
        return QDOT_OK;
    for (size_t j = 0; j < b.n; j++) {
        bool equal = false;
        qdot_expr sum;

        basis_project(&b, j);
        if (b.length[j] > 0)
            continue;
        sum = guess_combination(&b, j);
        if (sum == QDOT_NIL && qdot_expr_is_constant(pool, b.column[j]))
            sum = guess_constant(&b, j);
        if (sum == QDOT_NIL || sum == b.column[j])
            continue;
        QDOT_TRY(qdot_prove_equal(pool, b.column[j], sum, facts, &equal));
        if (equal) {
            from[count] = b.column[j];
            to[count++] = sum;
        }
    }
    for (size_t i = 0; i < n && count > 0; i++)
        e[i] = qdot_subs(pool, e[i], count, from, to);
    *changed = count > 0;
    return QDOT_OK;
}
