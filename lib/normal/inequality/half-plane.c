/* half-plane.c -- finds on which side of the imaginary axis zeros of characteristic polynomials lie. */
#include "normal/inequality/half-plane.h"

#include <flint/fmpq_poly.h>
#include <flint/fmpz_poly_factor.h>
#include <flint/fmpz_poly_mat.h>

#include "base/memory.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/polynomial/flint.h"
#include "normal/refute/ball.h"

/* Precision in bits at first and at most; SURE bounds loops that are known to end; largest degree of p(s). */
enum { FIRST = 128, LAST = 2048, SURE = 1 << 16, MOST_DEGREE = 64 };

typedef struct {
    qdot_pool *pool;
    size_t n;
    const qdot_expr *of[3]; /* matrices H, G, M [n x n]: the coefficients of s^0, s^1, s^2 */
    bool even;
    qdot_half_plane found;
    qdot_status status;
} question;

/* --- rational coefficients ---------------------------------------------------------------- */

static bool
is_rational(const question *q)
{
    for (int k = 0; k < 3; k++)
        for (size_t i = 0; i < q->n * q->n; i++)
            if (qdot_expr_kind(q->pool, q->of[k][i]) != QDOT_NUM)
                return false;
    return true;
}

/* Find a multiple of det(M s^2 + G s + H), with integer coefficients. */
static void
find_integer_polynomial(const question *q, fmpz_poly_t p)
{
    slong n = (slong)q->n;
    fmpz_poly_mat_t A;
    fmpz_t scale, x;

    fmpz_poly_mat_init(A, n, n);
    fmpz_init_set_ui(scale, 1);
    fmpz_init(x);
    for (int k = 0; k < 3; k++)
        for (slong i = 0; i < n * n; i++)
            fmpz_lcm(scale, scale, fmpq_denref(qdot_expr_rational(q->pool, q->of[k][i])));
    for (int k = 0; k < 3; k++)
        for (slong i = 0; i < n * n; i++) {
            const fmpq *value = qdot_expr_rational(q->pool, q->of[k][i]);

            fmpz_divexact(x, scale, fmpq_denref(value));
            fmpz_mul(x, x, fmpq_numref(value));
            fmpz_poly_set_coeff_fmpz(fmpz_poly_mat_entry(A, i / n, i % n), k, x);
        }
    fmpz_poly_mat_det(p, A);
    fmpz_poly_primitive_part(p, p);
    fmpz_clear(scale);
    fmpz_clear(x);
    fmpz_poly_mat_clear(A);
}

/* Set r(s) to f(-s). */
static void
mirror_argument(fmpz_poly_t r, const fmpz_poly_t f)
{
    fmpz_poly_set(r, f);
    for (slong k = 1; k < fmpz_poly_length(r); k += 2)
        fmpz_neg(fmpz_poly_get_coeff_ptr(r, k), fmpz_poly_get_coeff_ptr(r, k));
}

typedef struct {
    bool right, left, axis, sure;
} sides;

/* Where the zeros of f lie, which has none twice: by their real parts, none of which is 0; or, with
 * `squares`, where +-sqrt of them lie. */
static sides
locate_zeros(const fmpz_poly_t f, bool squares)
{
    slong degree = fmpz_poly_degree(f);
    sides s = {.sure = degree <= 0};
    acb_ptr z;

    if (degree <= 0)
        return s;
    z = _acb_vec_init(degree);
    for (slong bits = FIRST; bits <= SURE && !s.sure; bits *= 2) {
        s = (sides){.sure = true};
        arb_fmpz_poly_complex_roots(z, f, 0, bits);
        for (slong i = 0; i < degree; i++) {
            arb_srcptr re = acb_realref(z + i);

            if (squares && !acb_is_real(z + i))
                s.left = s.right = true;
            else if (arb_contains_zero(re))
                s.sure = false;
            else if (squares && arb_is_negative(re))
                s.axis = true;
            else if (squares)
                s.left = s.right = true;
            else if (arb_is_positive(re))
                s.right = true;
            else
                s.left = true;
        }
    }
    _acb_vec_clear(z, degree);
    return s;
}

/* Update *found by where the zeros of f lie; f has no multiple zeros and is a factor of p `times` times. */
static void
add_zeros_of_factor(const fmpz_poly_t f, slong times, qdot_half_plane *found)
{
    fmpz_poly_t g, h, rest;
    sides off, on;
    bool zero;

    fmpz_poly_init(g);
    fmpz_poly_init(h);
    fmpz_poly_init(rest);
    mirror_argument(g, f);
    fmpz_poly_gcd(g, f, g);
    fmpz_poly_div(rest, f, g);
    zero = fmpz_is_zero(fmpz_poly_get_coeff_ptr(g, 0));
    for (slong k = zero; k < fmpz_poly_length(g); k += 2)
        fmpz_poly_set_coeff_fmpz(h, k / 2, fmpz_poly_get_coeff_ptr(g, k));
    off = locate_zeros(rest, false);
    on = locate_zeros(h, true);
    found->grows |= off.right || on.right;
    found->decays &= off.sure && on.sure && !off.right && !on.right && !on.axis && !zero;
    found->bounded &= off.sure && on.sure && !off.right && !on.right && !zero &&
                      (times == 1 || !on.axis);
    fmpz_poly_clear(g);
    fmpz_poly_clear(h);
    fmpz_poly_clear(rest);
}

static void
decide_exactly(question *q)
{
    fmpz_poly_t p;
    fmpz_poly_factor_t parts;

    fmpz_poly_init(p);
    fmpz_poly_factor_init(parts);
    find_integer_polynomial(q, p);
    if (fmpz_poly_degree(p) == 2 * (slong)q->n) { /* the degree is 2 n unless the mass matrix M is singular */
        q->found.decays = q->found.bounded = true;
        fmpz_poly_factor_squarefree(parts, p);
        for (slong i = 0; i < parts->num; i++)
            add_zeros_of_factor(parts->p + i, parts->exp[i], &q->found);
    }
    fmpz_poly_factor_clear(parts);
    fmpz_poly_clear(p);
}

/* --- other constant coefficients ---------------------------------------------------------- */

/* Enclose the entries of the matrix X [n x n] in balls (intervals around a midpoint). */
static bool
matrix_enclose(const qdot_ball *ball, const qdot_expr *X, arb_mat_t A)
{
    slong n = arb_mat_nrows(A);

    for (slong i = 0; i < n * n; i++) {
        arb_srcptr value = qdot_ball_get(ball, X[i]);

        if (value == NULL)
            return false;
        arb_set(arb_mat_entry(A, i / n, i % n), value);
    }
    return true;
}

/* Enclose the characteristic polynomial of M y'' + G y' + H y = 0 in balls; if `even` that of -M^-1 H. */
static bool
enclose_polynomial(const question *q, const qdot_ball *ball, bool even, arb_poly_t p, slong bits)
{
    slong n = (slong)q->n, all = even ? n : 2 * n;
    arb_mat_t M, X, A;
    bool fine;

    arb_mat_init(M, n, n);
    arb_mat_init(X, n, n);
    arb_mat_init(A, all, all);
    fine = matrix_enclose(ball, q->of[2], M);
    for (int k = 0; k < (even ? 1 : 2) && fine; k++) {
        fine = matrix_enclose(ball, q->of[k], X) && arb_mat_solve(X, M, X, bits);
        for (slong i = 0; i < n * n && fine; i++)
            arb_neg(arb_mat_entry(A, all - n + i / n, k * n + i % n),
                    arb_mat_entry(X, i / n, i % n));
    }
    for (slong i = 0; i < n && !even; i++)
        arb_one(arb_mat_entry(A, i, n + i));
    if (fine)
        arb_mat_charpoly(p, A, bits);
    arb_mat_clear(M);
    arb_mat_clear(X);
    arb_mat_clear(A);
    return fine;
}

/* Keep the even coefficients of p(s) = h(s^2): drop the odd ones, whose enclosures contain 0. */
static void
drop_odd_coefficients(arb_poly_t p)
{
    slong n = arb_poly_length(p) / 2;

    for (slong k = 0; k <= n; k++) {
        arb_t x;

        arb_init(x);
        arb_poly_get_coeff_arb(x, p, 2 * k);
        arb_poly_set_coeff_arb(p, k, x);
        arb_clear(x);
    }
    arb_poly_truncate(p, n + 1);
}

/* Whether a zero isolated in the ball z is real: since p is real, the conjugate would be a second zero. */
static bool
is_real_zero(acb_srcptr z)
{
    return arb_contains_zero(acb_imagref(z));
}

/* Decide from enclosures of the zeros of p; false if undecided, in which case more bits may help. */
static bool
decide_by_enclosures(arb_poly_t p, bool squares, slong bits, qdot_half_plane *found)
{
    slong degree = arb_poly_degree(p), alone;
    acb_poly_t c;
    acb_ptr z;
    bool off = true, on = true;

    if (degree <= 0)
        return false;
    acb_poly_init(c);
    acb_poly_set_arb_poly(c, p);
    z = _acb_vec_init(degree);
    alone = acb_poly_find_roots(z, c, NULL, 0, bits);
    for (slong i = 0; i < alone; i++) {
        arb_srcptr re = acb_realref(z + i);

        if (squares && !is_real_zero(z + i))
            found->grows = true;
        else if (arb_is_positive(re))
            found->grows = true;
        off &= !squares && arb_is_negative(re);
        on &= arb_is_negative(re) && (!squares || is_real_zero(z + i));
    }
    found->decays = alone == degree && off;
    found->bounded = alone == degree && on;
    _acb_vec_clear(z, degree);
    acb_poly_clear(c);
    return found->grows || found->decays || found->bounded;
}

static void
decide_with_balls(question *q)
{
    const size_t m = q->n * q->n;
    qdot_expr *all = qdot_malloc((3 * m + 1) * sizeof *all);
    bool done = false, undamped = true;
    qdot_ball ball;

    q->status = all == NULL ? QDOT_ENOMEM : QDOT_OK;
    for (int k = 0; k < 3 && all != NULL; k++)
        for (size_t i = 0; i < m; i++)
            all[(size_t)k * m + i] = q->of[k][i];
    for (size_t i = 0; i < m; i++)
        undamped &= q->of[1][i] == QDOT_ZERO;
    if (q->status == QDOT_OK)
        q->status = qdot_ball_begin(&ball, q->pool, 3 * m, all);
    for (slong bits = FIRST; bits <= LAST && !done && q->status == QDOT_OK; bits *= 2) {
        arb_poly_t p;

        arb_poly_init(p);
        qdot_ball_eval(&ball, bits, NULL, NULL);
        if (enclose_polynomial(q, &ball, undamped, p, bits)) {
            if (q->even && !undamped)
                drop_odd_coefficients(p);
            done = decide_by_enclosures(p, q->even || undamped, bits, &q->found);
        }
        arb_poly_clear(p);
    }
    if (q->status == QDOT_OK)
        qdot_ball_end(&ball);
    qdot_free(all);
}

static void
decide_half_plane(void *user)
{
    question *q = user;

    if (is_rational(q))
        decide_exactly(q);
    else
        decide_with_balls(q);
}

qdot_status
qdot_half_plane_of(qdot_pool *pool, size_t n, const qdot_expr *M, const qdot_expr *G,
                   const qdot_expr *H, bool even, qdot_half_plane *out)
{
    question q = {.pool = pool, .n = n, .of = {H, G, M}, .even = even};
    qdot_status status;

    *out = (qdot_half_plane){0};
    if (n == 0 || 2 * n > MOST_DEGREE)
        return QDOT_OK;
    status = qdot_flint_run(pool, decide_half_plane, &q);
    if (status == QDOT_OK)
        status = q.status;
    if (status == QDOT_OK)
        *out = q.found;
    return status;
}
