/* steady-linear.c -- the stability of a steady motion by the roots of its linear motion. */
#include "mech/study/steady-parts.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/walk.h"
#include "mech/scene/scene.h"
#include "normal/inequality/half-plane.h"
#include "normal/inequality/less.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solutions.h"

/* of the matrix; of the polynomial, unless its coefficients are constants; most operations in a condition */
enum { MOST_SIZE = 8, MOST_DEGREE = 4, LONGEST = 400 };

/* e with the values of the motion, a LIST of equations. */
static qdot_expr
value_in_motion(const qdot_reduced *r, qdot_expr values, const qdot_facts *facts, qdot_expr e)
{
    e = qdot_reduced_resting(r, e);
    for (uint32_t i = 0; i < qdot_expr_count(r->pool, values) && e != QDOT_NIL; i++) {
        const qdot_expr equation = qdot_expr_arg(r->pool, values, i), symbol = qdot_expr_arg(r->pool, equation, 0),
                        value = qdot_expr_arg(r->pool, equation, 1);

        e = qdot_subs(r->pool, e, 1, &symbol, &value);
    }
    if (e != QDOT_NIL && qdot_solve_integers(r->pool, values) > 0)
        e = qdot_solve_without_turns(r->pool, e);
    return e == QDOT_NIL ? e : qdot_simplify(r->pool, e, facts);
}

/* The rows of the linear motion: rates of resting coordinates and first-order unknowns, then R; their symbols, then u. */
static size_t
list_rows(const qdot_reduced *r, qdot_expr *row, qdot_expr *symbol)
{
    size_t k = 0;

    for (size_t i = 0; i < r->n; i++)
        if (r->rests[i]) {
            symbol[k] = r->q[i];
            row[k++] = qdot_neg(r->pool, qdot_reduced_velocity(r, i));
        }
    for (size_t i = 0; i < r->states; i++) {
        symbol[k] = r->s->states.at[i].z;
        row[k++] = qdot_neg(r->pool, r->g[i]);
    }
    for (size_t a = 0; a < r->m; a++) {
        symbol[k + a] = r->u[a];
        row[k + a] = r->R[a];
    }
    return k;
}

/* p(s) [size + 1 coefficients]; *size is 0 where the matrix is too large. */
static qdot_status
characteristic_polynomial(const qdot_reduced *r, qdot_expr values, const qdot_facts *facts, qdot_expr *p, size_t *size)
{
    const qdot_expr s = qdot_symbol_get(r->pool, QDOT_FORMAL, "s#steady");
    qdot_expr row[MOST_SIZE], symbol[MOST_SIZE], A[MOST_SIZE * MOST_SIZE], det;
    size_t k;

    *size = r->m + r->states;
    for (size_t i = 0; i < r->n; i++)
        *size += r->rests[i];
    if (*size > MOST_SIZE) {
        *size = 0;
        return QDOT_OK;
    }
    k = list_rows(r, row, symbol);
    for (size_t i = 0; i < *size; i++)
        for (size_t j = 0; j < *size; j++) {
            qdot_expr *to = &A[i * *size + j], slope = QDOT_ZERO;

            if (i >= k && j >= k)
                slope = value_in_motion(r, values, facts, r->M[(i - k) * r->m + j - k]);
            else if (i == j)
                slope = QDOT_ONE;
            *to = qdot_add(r->pool, value_in_motion(r, values, facts, qdot_diff(r->pool, row[i], symbol[j])),
                           qdot_mul(r->pool, s, slope));
        }
    det = qdot_expand(r->pool, qdot_det(r->pool, qdot_matrix(r->pool, (uint32_t)*size, (uint32_t)*size, A)));
    QDOT_TRY(qdot_pool_check(r->pool));
    for (size_t i = 0; i <= *size; i++)
        p[i] = qdot_simplify(r->pool, qdot_coefficient(r->pool, det, s, (int64_t)i), facts);
    return qdot_pool_check(r->pool);
}

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr known[2 * MOST_SIZE], when; /* what is positive under the conditions so far */
    size_t n;
    bool open, never; /* some sign is not known; something is proved to be negative */
} signs;

/* Ask that e is positive: a condition is added. */
static qdot_status
ask_positive(signs *x, qdot_expr e)
{
    qdot_expr answer;
    qdot_decision d;

    e = qdot_simplify(x->pool, e, x->facts);
    QDOT_TRY(qdot_pool_check(x->pool));
    if (qdot_expr_size(x->pool, e) > LONGEST) {
        x->open = true;
        return QDOT_OK;
    }
    answer = qdot_positive(x->pool, e, x->facts, x->n, x->known);
    QDOT_TRY(qdot_pool_check(x->pool));
    if (qdot_expr_size(x->pool, answer) > LONGEST) {
        x->open = true;
        return QDOT_OK;
    }
    if (answer == QDOT_FALSE) {
        QDOT_TRY(qdot_decide_less(x->pool, e, QDOT_ZERO, true, x->facts, &d));
        x->never = x->never || d.verdict == QDOT_PROVED;
        x->open = true;
        return QDOT_OK;
    }
    x->known[x->n++] = e;
    if (answer != QDOT_TRUE)
        x->when = qdot_conditions_and(x->pool, x->when, answer);
    return QDOT_OK;
}

/* a [d + 1], a[d] = 1: the conditions of Hurwitz up to degree 4. */
static qdot_status
ask_hurwitz(signs *x, size_t d, const qdot_expr *a)
{
    qdot_pool *pool = x->pool;

    for (size_t i = d; i-- > 0;)
        QDOT_TRY(ask_positive(x, a[i]));
    if (d == 3)
        return ask_positive(x, qdot_sub(pool, qdot_mul(pool, a[2], a[1]), a[0]));
    if (d == 4)
        return ask_positive(x, qdot_sub(pool, qdot_product(pool, 3, (qdot_expr[]){a[3], a[2], a[1]}),
                                        qdot_add(pool, qdot_mul(pool, a[1], a[1]), qdot_product(pool, 3, (qdot_expr[]){a[3], a[3], a[0]}))));
    return QDOT_OK;
}

/* Of even powers alone: all squares of roots are negative and different. */
static qdot_status
ask_imaginary(signs *x, size_t d, const qdot_expr *a)
{
    qdot_pool *pool = x->pool;

    for (size_t i = d; i > 0; i -= 2)
        QDOT_TRY(ask_positive(x, a[i - 2]));
    if (d == 4)
        return ask_positive(x, qdot_sub(pool, qdot_mul(pool, a[2], a[2]), qdot_mul(pool, qdot_expr_int(pool, 4), a[0])));
    return QDOT_OK;
}

/* By constants a [d + 1]: the half plane of the roots of the companion matrix. */
static qdot_status
judge_constants(qdot_pool *pool, size_t d, const qdot_expr *a, qdot_equilibrium *one)
{
    qdot_expr M[MOST_SIZE * MOST_SIZE], G[MOST_SIZE * MOST_SIZE], H[MOST_SIZE * MOST_SIZE];
    qdot_half_plane side;

    for (size_t i = 0; i < d * d; i++) {
        const size_t row = i / d, column = i % d;

        M[i] = QDOT_ZERO;
        G[i] = row == column ? QDOT_ONE : QDOT_ZERO;
        H[i] = row + 1 == d ? a[column] : column == row + 1 ? QDOT_MINUS_ONE : QDOT_ZERO;
    }
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_half_plane_of(pool, d, M, G, H, false, &side));
    one->stability = side.grows     ? QDOT_UNSTABLE
                     : side.decays  ? QDOT_STABLE
                     : side.bounded ? QDOT_STABLE_TO_FIRST_ORDER
                                    : QDOT_STABILITY_UNDECIDED;
    return QDOT_OK;
}

/* The verdict by the roots of a polynomial a [d + 1], a[d] = 1, a[0] != 0, beside those that the family makes 0. */
static qdot_status
judge_polynomial(const qdot_reduced *r, const qdot_facts *facts, size_t d, const qdot_expr *a, qdot_equilibrium *one)
{
    signs x = {.pool = r->pool, .facts = facts, .when = QDOT_NIL};
    bool even = d % 2 == 0, constant = true;

    for (size_t i = 0; i < d; i++) {
        even = even && (i % 2 == 0 || a[i] == QDOT_ZERO);
        constant = constant && qdot_expr_is_constant(r->pool, a[i]);
    }
    if (constant && d > 0)
        return judge_constants(r->pool, d, a, one);
    if (d > MOST_DEGREE)
        return QDOT_OK;
    QDOT_TRY(even && d > 0 ? ask_imaginary(&x, d, a) : ask_hurwitz(&x, d, a));
    one->stability = x.never ? QDOT_UNSTABLE : x.open ? QDOT_STABILITY_UNDECIDED
                     : even && d > 0 ? QDOT_STABLE_TO_FIRST_ORDER : QDOT_STABLE;
    one->stable_when = x.never || x.open ? QDOT_NIL : x.when;
    return QDOT_OK;
}

qdot_status
qdot_reduced_judge(const qdot_reduced *r, qdot_expr values, size_t free, size_t regular, qdot_equilibrium *one)
{
    qdot_expr p[MOST_SIZE + 1], room[QDOT_CONDITIONS_MOST];
    const qdot_facts facts = qdot_facts_and(r->pool, &r->facts, one->exists, room);
    size_t size, zeros = 0;

    one->stability = QDOT_STABILITY_UNDECIDED;
    one->stable_when = QDOT_NIL;
    QDOT_TRY(characteristic_polynomial(r, values, &facts, p, &size));
    if (size == 0)
        return QDOT_OK;
    while (zeros < size && p[zeros] == QDOT_ZERO)
        zeros++;
    for (size_t i = zeros; i < size; i++)
        p[i] = qdot_simplify(r->pool, qdot_div(r->pool, p[i], p[size]), &facts);
    p[size] = QDOT_ONE;
    QDOT_TRY(qdot_pool_check(r->pool));
    QDOT_TRY(judge_polynomial(r, &facts, size - zeros, p + zeros, one));
    if (zeros != free + r->bound && zeros != regular + r->bound && one->stability != QDOT_UNSTABLE) {
        one->stability = QDOT_STABILITY_UNDECIDED;
        one->stable_when = QDOT_NIL;
    }
    return QDOT_OK;
}
