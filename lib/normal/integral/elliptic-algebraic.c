/* elliptic-algebraic.c -- reads c/sqrt(P), finds the zeros of P and chooses the form of its elliptic integral. */
#include "normal/integral/elliptic-algebraic.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "normal/field/normal-form.h"
#include "normal/inequality/less.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr x, front; /* front/sqrt(c[degree] x^degree + ... + c[0]) */
    int degree;
    qdot_expr c[5];
    qdot_expr root[4]; /* [n] real zeros, descending */
    size_t n;
} radical;

static bool
is_positive(const radical *r, qdot_expr e)
{
    qdot_decision d = {.verdict = QDOT_UNDECIDED};

    if (e == QDOT_NIL)
        return false;
    if ((qdot_expr_sign(r->pool, e) & QDOT_POS) == QDOT_POS)
        return true;
    return qdot_decide_less(r->pool, QDOT_ZERO, e, true, r->facts, &d) == QDOT_OK && d.verdict == QDOT_PROVED;
}

static bool
is_less(const radical *r, qdot_expr a, qdot_expr b)
{
    return is_positive(r, qdot_sub(r->pool, b, a));
}

/* Read e = front/sqrt(P). */
static bool
read_radical(radical *r, qdot_expr e)
{
    qdot_pool *pool = r->pool;
    const bool product = qdot_expr_kind(pool, e) == QDOT_PROD;
    qdot_expr P = QDOT_ONE, rest;

    r->front = product ? qdot_expr_arg(pool, e, 0) : QDOT_ONE;
    for (uint32_t i = 1; product && i < qdot_expr_count(pool, e); i += 2) {
        const qdot_expr b = qdot_expr_arg(pool, e, i), p = qdot_expr_arg(pool, e, i + 1);

        if (!qdot_expr_contains(pool, b, r->x) && !qdot_expr_contains(pool, p, r->x))
            r->front = qdot_mul(pool, r->front, qdot_pow(pool, b, p));
        else if (p == qdot_neg(pool, QDOT_HALF))
            P = qdot_mul(pool, P, b);
        else
            return false;
    }
    if (!qdot_expr_contains(pool, P, r->x))
        return false;
    P = rest = qdot_expand(pool, P);
    for (int k = 0; k <= 4; k++) {
        r->c[k] = qdot_coefficient(pool, P, r->x, k);
        if (r->c[k] == QDOT_NIL || qdot_expr_contains(pool, r->c[k], r->x)) {
            (void)!qdot_pool_check(pool);
            return false;
        }
        r->degree = r->c[k] != QDOT_ZERO ? k : r->degree;
        rest = qdot_sub(pool, rest, qdot_mul(pool, r->c[k], qdot_pow_int(pool, r->x, k)));
    }
    return r->degree >= 3 && qdot_normal(pool, rest, NULL) == QDOT_ZERO;
}

/* Find the real zeros; false: they or their order are not known. */
static bool
find_real_zeros(radical *r)
{
    qdot_pool *pool = r->pool;
    qdot_solutions s = {0};
    qdot_expr P = QDOT_ZERO;
    bool known;

    for (int k = 0; k <= r->degree; k++)
        P = qdot_add(pool, P, qdot_mul(pool, r->c[k], qdot_pow_int(pool, r->x, k)));
    known = qdot_solve(pool, P, r->x, r->facts, &s) == QDOT_OK && s.complete && !s.single && s.root.n <= 4;
    r->n = 0;
    for (size_t i = 0; i < s.root.n && known; i++) {
        size_t k = r->n++;

        known = s.root.at[i].period == QDOT_NIL && s.root.at[i].condition == QDOT_NIL;
        for (; known && k > 0 && is_less(r, r->root[k - 1], s.root.at[i].value); k--)
            r->root[k] = r->root[k - 1];
        r->root[k] = s.root.at[i].value;
    }
    qdot_solutions_clear(&s);
    for (size_t i = 1; i < r->n && known; i++)
        known = is_less(r, r->root[i], r->root[i - 1]);
    return known;
}

static qdot_expr
elliptic_F(qdot_pool *pool, qdot_expr phi, qdot_expr m)
{
    return qdot_fun(pool, QDOT_ELLIPTIC_F, 2, (qdot_expr[]){phi, qdot_normal(pool, m, NULL)});
}

/* asin(sqrt(over/under)) */
static qdot_expr
arc_of_ratio(qdot_pool *pool, qdot_expr over, qdot_expr under)
{
    return qdot_fun1(pool, QDOT_ASIN, qdot_sqrt(pool, qdot_div(pool, over, under)));
}

/* --- cubics and quartics with real zeros ------------------------------------------------------ */

/* r - s; 1 for a zero s = d that is minus infinity (nil), for ratios in which it cancels. */
static qdot_expr
gap(qdot_pool *pool, qdot_expr r, qdot_expr s)
{
    return s == QDOT_NIL ? QDOT_ONE : qdot_sub(pool, r, s);
}

static qdot_expr
integral_over_real_zeros(const radical *r)
{
    qdot_pool *pool = r->pool;
    const qdot_expr x = r->x, a = r->root[0], b = r->root[1], c = r->root[2], d = r->degree == 4 ? r->root[3] : QDOT_NIL;
    const qdot_expr ac = qdot_sub(pool, a, c), bd = gap(pool, b, d), lead = r->c[r->degree];
    const bool up = is_positive(r, lead);
    qdot_expr m = qdot_div(pool, qdot_mul(pool, qdot_sub(pool, b, c), gap(pool, a, d)), qdot_mul(pool, ac, bd)), phi, scale;

    if (!up && !is_positive(r, qdot_neg(pool, lead)))
        return QDOT_NIL;
    if (up && is_less(r, a, x))
        phi = arc_of_ratio(pool, qdot_mul(pool, bd, qdot_sub(pool, x, a)), qdot_mul(pool, gap(pool, a, d), qdot_sub(pool, x, b)));
    else if (up && is_less(r, c, x) && is_less(r, x, b))
        phi = arc_of_ratio(pool, qdot_mul(pool, bd, qdot_sub(pool, x, c)),
                           qdot_mul(pool, qdot_sub(pool, b, c), gap(pool, x, d)));
    else if (!up && is_less(r, b, x) && is_less(r, x, a))
        phi = arc_of_ratio(pool, qdot_mul(pool, ac, qdot_sub(pool, x, b)),
                           qdot_mul(pool, qdot_sub(pool, a, b), qdot_sub(pool, x, c)));
    else if (!up && d != QDOT_NIL && is_less(r, d, x) && is_less(r, x, c))
        phi = arc_of_ratio(pool, qdot_mul(pool, ac, qdot_sub(pool, x, d)),
                           qdot_mul(pool, qdot_sub(pool, c, d), qdot_sub(pool, a, x)));
    else
        return QDOT_NIL;
    m = up ? m : qdot_sub(pool, QDOT_ONE, m);
    scale = qdot_sqrt(pool, qdot_product(pool, 3, (qdot_expr[]){up ? lead : qdot_neg(pool, lead), ac, bd}));
    return qdot_div(pool, qdot_mul(pool, qdot_expr_int(pool, 2), elliptic_F(pool, phi, m)), scale);
}

/* A cubic with one real zero. */
static qdot_expr
integral_over_one_zero(const radical *r)
{
    qdot_pool *pool = r->pool;
    const bool up = is_positive(r, r->c[3]);
    const qdot_expr side = up ? QDOT_ONE : QDOT_MINUS_ONE, lead = qdot_mul(pool, side, r->c[3]);
    const qdot_expr x = qdot_mul(pool, side, r->x), zero = qdot_mul(pool, side, r->root[0]);
    /* x^2 + s x + t = P/(lead (x - zero)) */
    const qdot_expr s = qdot_add(pool, qdot_mul(pool, side, qdot_div(pool, r->c[2], r->c[3])), zero),
                    t = qdot_add(pool, qdot_div(pool, r->c[1], r->c[3]), qdot_mul(pool, s, zero));
    const qdot_expr p = qdot_mul(pool, qdot_neg(pool, QDOT_HALF), s);
    const qdot_expr square = qdot_simplify(
        pool, qdot_add(pool, qdot_mul(pool, zero, zero), qdot_add(pool, qdot_mul(pool, s, zero), t)), r->facts);
    qdot_expr A, phi;

    if (!is_positive(r, lead) || !is_positive(r, qdot_sub(pool, t, qdot_mul(pool, p, p))))
        return QDOT_NIL;
    A = qdot_sqrt(pool, square);
    phi = qdot_fun1(pool, QDOT_ACOS, qdot_div(pool, qdot_sub(pool, qdot_add(pool, A, zero), x),
                                              qdot_add(pool, qdot_sub(pool, A, zero), x)));
    phi = elliptic_F(pool, phi, qdot_div(pool, qdot_add(pool, A, qdot_sub(pool, p, zero)), qdot_mul(pool, qdot_expr_int(pool, 2), A)));
    return qdot_mul(pool, side, qdot_div(pool, phi, qdot_sqrt(pool, qdot_mul(pool, lead, A))));
}

/* --- even quartics ------------------------------------------------------------------------------ */

/* No real zeros of A w^2 + B w + C. */
static qdot_expr
integral_over_no_zero(const radical *r)
{
    qdot_pool *pool = r->pool;
    const qdot_expr A = r->c[4], two = qdot_expr_int(pool, 2);
    qdot_expr square, h, m;

    if (!is_positive(r, A))
        return QDOT_NIL;
    square = qdot_simplify(pool, qdot_sqrt(pool, qdot_div(pool, r->c[0], A)), r->facts);
    h = qdot_sqrt(pool, square);
    m = qdot_sub(pool, QDOT_HALF, qdot_div(pool, r->c[2], qdot_product(pool, 3, (qdot_expr[]){qdot_expr_int(pool, 4), A, square})));
    return qdot_div(pool, elliptic_F(pool, qdot_mul(pool, two, qdot_fun1(pool, QDOT_ATAN, qdot_div(pool, r->x, h))), m),
                    qdot_product(pool, 3, (qdot_expr[]){two, h, qdot_sqrt(pool, A)}));
}

static qdot_expr
integral_over_squares(const radical *r)
{
    qdot_pool *pool = r->pool;
    const qdot_expr A = r->c[4], B = r->c[2], C = r->c[0], x = r->x, two_A = qdot_mul(pool, qdot_expr_int(pool, 2), A);
    const qdot_expr D = qdot_sub(pool, qdot_mul(pool, B, B), qdot_mul(pool, qdot_expr_int(pool, 4), qdot_mul(pool, A, C)));
    qdot_expr s, u, v;

    if (is_positive(r, qdot_neg(pool, D)))
        return integral_over_no_zero(r);
    if (!is_positive(r, D))
        return QDOT_NIL;
    s = qdot_sqrt(pool, D);
    u = qdot_simplify(pool, qdot_neg(pool, qdot_div(pool, qdot_add(pool, B, s), two_A)), r->facts);
    v = qdot_simplify(pool, qdot_div(pool, qdot_sub(pool, s, B), two_A), r->facts);
    if (is_less(r, v, u)) {
        const qdot_expr other = u;

        u = v;
        v = other;
    }
    if (is_positive(r, A) && is_less(r, v, QDOT_ZERO))
        return qdot_div(pool,
                        elliptic_F(pool, qdot_fun1(pool, QDOT_ATAN, qdot_div(pool, x, qdot_sqrt(pool, qdot_neg(pool, v)))),
                                   qdot_sub(pool, QDOT_ONE, qdot_div(pool, v, u))),
                        qdot_sqrt(pool, qdot_neg(pool, qdot_mul(pool, A, u))));
    if (is_less(r, A, QDOT_ZERO) && is_less(r, u, QDOT_ZERO) && is_positive(r, v))
        return qdot_div(pool, elliptic_F(pool, qdot_fun1(pool, QDOT_ASIN, qdot_div(pool, x, qdot_sqrt(pool, v))), qdot_div(pool, v, u)),
                        qdot_sqrt(pool, qdot_mul(pool, A, u)));
    if (is_positive(r, A) && is_positive(r, u) && is_positive(r, qdot_sub(pool, u, qdot_mul(pool, x, x))))
        return qdot_div(pool, elliptic_F(pool, qdot_fun1(pool, QDOT_ASIN, qdot_div(pool, x, qdot_sqrt(pool, u))), qdot_div(pool, u, v)),
                        qdot_sqrt(pool, qdot_mul(pool, A, v)));
    return QDOT_NIL;
}

/* --- the choice --------------------------------------------------------------------------------- */

static qdot_expr
find_form_of_radical(radical *r)
{
    qdot_expr F = QDOT_NIL;

    if (r->degree == 4 && r->c[3] == QDOT_ZERO && r->c[1] == QDOT_ZERO)
        F = integral_over_squares(r);
    if (F != QDOT_NIL || qdot_pool_failed(r->pool) || !find_real_zeros(r))
        return F;
    if ((int)r->n == r->degree)
        return integral_over_real_zeros(r);
    return r->degree == 3 && r->n == 1 ? integral_over_one_zero(r) : QDOT_NIL;
}

qdot_expr
qdot_elliptic_algebraic(qdot_pool *pool, qdot_expr e, qdot_expr x, const qdot_facts *facts)
{
    radical r = {.pool = pool, .facts = facts, .x = x};
    qdot_decision decision = {.verdict = QDOT_UNDECIDED};
    qdot_expr F;
    qdot_status status;

    if (e == QDOT_NIL || qdot_pool_failed(pool) || !read_radical(&r, e))
        return QDOT_NIL;
    F = find_form_of_radical(&r);
    F = F == QDOT_NIL ? F : qdot_mul(pool, r.front, F);
    status = qdot_pool_check(pool);
    if (status == QDOT_OK && F != QDOT_NIL)
        status = qdot_decide_equal(pool, qdot_diff(pool, F, x), e, facts, &decision);
    if (qdot_grave(status) != QDOT_OK)
        return qdot_pool_fail(pool);
    return status == QDOT_OK && decision.verdict == QDOT_PROVED ? F : QDOT_NIL;
}
