/* test_less.c -- inequalities: proved, refuted with a point, and never wrong.
 *
 * QDOT_TEST_PAIRS says how many random ones (1000), QDOT_TEST_SEED where they begin (1), QDOT_TEST_SHOW that
 * what stays undecided though no point speaks against it be shown.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>
#include <inttypes.h>

#include "expr/print.h"

#include "normal/inequality/less.h"
#include "normal/inequality/real-zeros.h"
#include "normal/number.h"
#include "normal/pairs.h"

enum { POINTS = 60, LARGEST = 120 };

static int64_t
setting(const char *name, int64_t otherwise)
{
    const char *text = getenv(name);

    return text == NULL ? otherwise : atol(text);
}

/* A small polynomial in two or three of the symbols. */
static qdot_expr
polynomial(pairs *g)
{
    qdot_expr sum = num(g, (int64_t)pairs_random(g, 7) - 2, 1 + pairs_random(g, 3));
    unsigned terms = 1 + pairs_random(g, 4), symbols = 1 + pairs_random(g, 2);
    qdot_expr x[3] = {g->any[pairs_random(g, 4)], g->positive[pairs_random(g, 3)],
                      pairs_random(g, 2) == 0 ? g->within : g->beyond};

    for (unsigned i = 0; i < terms; i++) {
        qdot_expr term = num(g, (int64_t)pairs_random(g, 9) - 4, 1 + pairs_random(g, 2));

        for (unsigned k = 0; k <= symbols; k++)
            term = mul(g, term, power(g, x[k], pairs_random(g, 3)));
        sum = add(g, sum, term);
    }
    return sum;
}

/* What is often positive, or nearly. */
static qdot_expr
random_gap(pairs *g)
{
    qdot_expr u = polynomial(g), v = polynomial(g), n = num(g, 1 + pairs_random(g, 4), 2);
    qdot_expr x = g->any[pairs_random(g, 4)], both[2] = {u, v};
    qdot_pool *p = g->pool;

    switch (pairs_random(g, 20)) {
    case 0: return add(g, power(g, u, 2), v);
    case 1: return sub(g, fun(g, QDOT_ABS, u), v);
    case 2:
        return sub(g, add(g, fun(g, QDOT_ABS, u), fun(g, QDOT_ABS, v)),
                   fun(g, QDOT_ABS, add(g, u, v)));
    case 3: return sub(g, qdot_sqrt(p, add(g, power(g, u, 2), n)), v);
    case 4: return sub(g, qdot_sqrt(p, u), v);
    case 5: return sub(g, qdot_fun(p, QDOT_MAX, 2, both), u);
    case 6: return sub(g, n, mul(g, fun(g, QDOT_SIN, x), fun(g, QDOT_COS, x)));
    case 7: return add(g, n, mul(g, g->within, fun(g, QDOT_COS, x)));
    case 8: return sub(g, fun(g, QDOT_EXP, x), u);
    case 9: return sub(g, fun(g, QDOT_COSH, x), n);
    case 10: return sub(g, quo(g, u, add(g, power(g, v, 2), n)), n);
    case 11: return add(g, power(g, sub(g, u, v), 2), mul(g, n, u));
    case 12: return sub(g, u, fun(g, QDOT_FLOOR, u));
    case 13: return sub(g, fun(g, QDOT_ATAN, u), n);
    case 14:
        return qdot_fun(p, QDOT_IF, 3,
                        (qdot_expr[]){qdot_rel(p, QDOT_LT, QDOT_ZERO, u), u, v});
    case 15:
        return sub(g, fun(g, QDOT_SIN, g->positive[3]),
                   mul(g, n, num(g, (int64_t)pairs_random(g, 3) - 1, 1)));
    case 16:
        return sub(g, add(g, power(g, u, 2), power(g, v, 2)),
                   mul(g, num(g, 1 + pairs_random(g, 3), 1), mul(g, u, v)));
    case 17: return sub(g, n, fun(g, QDOT_TANH, x));
    case 18: return sub(g, x, fun(g, QDOT_SIN, x));
    default: return u;
    }
}

/* Whether e < 0 at one of many points: never a matter of rounding. */
static bool
speaks_against(pairs *g, qdot_expr e)
{
    bool against = false;
    mpfr_t l, r;

    if (e == QDOT_NIL) { /* undefined once something is put in */
        (void)!qdot_pool_check(g->pool);
        return false;
    }

    mpfr_inits2(300, l, r, (mpfr_ptr)0);
    for (unsigned k = 0; k < POINTS && !against; k++)
        if (number_pair(g->pool, e, QDOT_ZERO, k, l, r)) {
            against = mpfr_sgn(l) < 0 && mpfr_get_exp(l) > -200;
        }
    mpfr_clears(l, r, (mpfr_ptr)0);
    return against;
}

/* Whether the point refutes: put in, what is left is a number below 0 (or 0, strict). */
static bool
point_refutes(pairs *g, qdot_expr e, qdot_expr at, bool strict)
{
    bool good = false;
    mpfr_t l, r;

    for (uint32_t i = 0; i < qdot_expr_count(g->pool, at); i++) {
        qdot_expr row = qdot_expr_arg(g->pool, at, i);
        qdot_expr x = qdot_expr_arg(g->pool, row, 0), v = qdot_expr_arg(g->pool, row, 1);

        e = qdot_subs(g->pool, e, 1, &x, &v);
    }
    if (e == QDOT_NIL)
        return false;
    mpfr_inits2(300, l, r, (mpfr_ptr)0);
    if (number_pair(g->pool, e, QDOT_ZERO, 0, l, r))
        good = mpfr_sgn(l) < 0 || (strict && (mpfr_zero_p(l) || mpfr_get_exp(l) < -200));
    mpfr_clears(l, r, (mpfr_ptr)0);
    return good;
}

static void
tell(const qdot_pool *pool, const char *what, int64_t seed, qdot_expr e, bool strict)
{
    qdot_text t = {0};

    if (qdot_print(pool, e, QDOT_PLAIN, &t) == QDOT_OK)
        fprintf(stderr, "# %s, %" PRId64 ": check 0 %s %s\n", what, seed,
                strict ? "<" : "<=", t.at);
    qdot_text_clear(&t);
}

static void
random_inequalities_are_never_wrong(void **state)
{
    int64_t wanted = setting("QDOT_TEST_PAIRS", 1000), from = setting("QDOT_TEST_SEED", 1);
    int64_t proved = 0, refuted = 0, open = 0, wrong = 0;

    (void)state;
    for (int64_t i = 0; i < wanted; i++) {
        bool strict, against;
        qdot_decision d;
        qdot_expr e, c;
        qdot_facts facts = {0};
        pairs g;

        assert_true(pairs_begin(&g, (uint64_t)(from + i)));
        strict = pairs_random(&g, 2) == 0;
        e = random_gap(&g);
        if (qdot_pool_check(g.pool) == QDOT_OK && e != QDOT_NIL &&
            qdot_expr_size(g.pool, e) <= LARGEST) {
            if (pairs_random(&g, 4) == 0) { /* x > 0, told by putting in what is */
                c = qdot_rel(g.pool, QDOT_LT, QDOT_ZERO, g.any[0]);
                facts.n_conditions = 1;
                facts.conditions = &c;
            }
            assert_int_equal(qdot_decide_less(g.pool, QDOT_ZERO, e, strict, &facts, &d),
                             QDOT_OK);
            if (facts.n_conditions > 0) {
                qdot_expr to = fun(&g, QDOT_EXP, g.any[0]);

                against = speaks_against(&g, qdot_subs(g.pool, e, 1, &g.any[0], &to));
            } else {
                against = speaks_against(&g, e);
            }
            proved += d.verdict == QDOT_PROVED;
            refuted += d.verdict == QDOT_REFUTED;
            open += d.verdict == QDOT_UNDECIDED;
            if ((d.verdict == QDOT_PROVED && against) ||
                (d.verdict == QDOT_REFUTED && !point_refutes(&g, e, d.at, strict))) {
                wrong++;
                tell(g.pool,
                     d.verdict == QDOT_PROVED ? "proved, though false" : "no such point",
                     from + i, e, strict);
            }
            if (d.verdict == QDOT_UNDECIDED && !against && setting("QDOT_TEST_SHOW", 0))
                tell(g.pool, "undecided", from + i, e, strict);
        }
        qdot_pool_free(g.pool);
    }
    fprintf(stderr,
            "# %" PRId64 " inequalities: proved %" PRId64 ", refuted %" PRId64 ", undecided %" PRId64 "; %" PRId64 " wrong\n",
            wanted, proved, refuted, open, wrong);
    assert_int_equal(wrong, 0);
    assert_true(proved > wanted / 10 && refuted > wanted / 5 && open < wanted / 5);
}

/* --- conditions ------------------------------------------------------------------------------------ */

enum { SYMBOLS = 3 };

/* A polynomial of few small terms in x [SYMBOLS]. */
static qdot_expr
small_polynomial(pairs *g, const qdot_expr *x)
{
    qdot_expr sum = num(g, (int64_t)pairs_random(g, 3) - 1, 1);

    for (unsigned terms = 1 + pairs_random(g, 3); terms > 0; terms--) {
        qdot_expr term = num(g, pairs_random(g, 2) == 0 ? 1 : -1 - (int64_t)pairs_random(g, 2), 1);

        for (unsigned k = 0; k < SYMBOLS; k++)
            term = mul(g, term, power(g, x[k], pairs_random(g, 4) == 0 ? 2 : pairs_random(g, 2)));
        sum = add(g, sum, term);
    }
    return sum;
}

/* The sign of a polynomial where the symbols x have values v. */
static int
sign_at(pairs *g, qdot_expr e, const qdot_expr *x, const qdot_expr *v)
{
    const fmpq *q = qdot_expr_rational(g->pool, qdot_subs(g->pool, e, SYMBOLS, x, v));

    assert_non_null(q);
    return fmpq_sgn(q);
}

/* Whether 0 < e, or 0 <= e, is false at one of many points at which 0 < c, or 0 <= c. */
static bool
is_false_somewhere(pairs *g, qdot_expr e, bool strict, qdot_expr c, bool weak, const qdot_expr *x)
{
    static const int64_t halves[] = {-4, -3, -2, -1, 0, 1, 2, 3, 4};
    const size_t n = sizeof halves / sizeof *halves;
    bool found = false;

    for (size_t i = 0; i < n * n * 4 && !found; i++) { /* the last symbol is positive */
        qdot_expr v[SYMBOLS] = {num(g, halves[i % n], 2), num(g, halves[i / n % n], 2), num(g, 1 + (int64_t)(i / n / n), 2)};

        if (sign_at(g, c, x, v) >= (weak ? 0 : 1))
            found = sign_at(g, e, x, v) < (strict ? 1 : 0);
    }
    return found;
}

/* Whether the point, a list of equations, has values for all symbols, fulfils the condition and refutes. */
static bool
is_counterexample(pairs *g, qdot_expr e, bool strict, qdot_expr c, bool weak, const qdot_expr *x, qdot_expr at)
{
    qdot_expr v[SYMBOLS];

    for (unsigned k = 0; k < SYMBOLS; k++) {
        v[k] = k == SYMBOLS - 1 ? QDOT_ONE : QDOT_ZERO; /* of a symbol that does not matter */
        for (uint32_t i = 0; i < qdot_expr_count(g->pool, at); i++)
            if (qdot_expr_arg(g->pool, qdot_expr_arg(g->pool, at, i), 0) == x[k])
                v[k] = qdot_expr_arg(g->pool, qdot_expr_arg(g->pool, at, i), 1);
    }
    return sign_at(g, c, x, v) >= (weak ? 0 : 1) && sign_at(g, e, x, v) < (strict ? 1 : 0);
}

/* Polynomials under one polynomial condition that is not linear, weak ones too: proofs hold at many points, and points that
 * refute fulfil the condition. */
static void
conditions_are_kept(void **state)
{
    const int64_t wanted = setting("QDOT_TEST_PAIRS", 1000), from = setting("QDOT_TEST_SEED", 1);
    int64_t proved = 0, refuted = 0, wrong = 0;

    (void)state;
    for (int64_t i = 0; i < wanted; i++) {
        qdot_facts facts = {0};
        bool strict, weak;
        qdot_expr e, c, condition;
        qdot_decision d;
        pairs g;

        assert_true(pairs_begin(&g, (uint64_t)(from + i)));
        {
            const qdot_expr x[SYMBOLS] = {g.any[4], g.any[5], g.positive[1]};

            strict = pairs_random(&g, 2) == 0;
            weak = pairs_random(&g, 3) > 0;
            c = small_polynomial(&g, x);
            e = pairs_random(&g, 3) == 0 ? mul(&g, x[2], add(&g, c, power(&g, x[0], 2))) : small_polynomial(&g, x);
            condition = qdot_rel(g.pool, weak ? QDOT_LE : QDOT_LT, QDOT_ZERO, c);
            facts.n_conditions = qdot_expr_kind(g.pool, condition) == QDOT_REL;
            facts.conditions = &condition;
            if (facts.n_conditions == 1) {
                assert_int_equal(qdot_decide_less(g.pool, QDOT_ZERO, e, strict, &facts, &d), QDOT_OK);
                proved += d.verdict == QDOT_PROVED;
                refuted += d.verdict == QDOT_REFUTED;
                if ((d.verdict == QDOT_PROVED && is_false_somewhere(&g, e, strict, c, weak, x)) ||
                    (d.verdict == QDOT_REFUTED && !is_counterexample(&g, e, strict, c, weak, x, d.at))) {
                    wrong++;
                    tell(g.pool, d.verdict == QDOT_PROVED ? "proved, though false" : "no such point", from + i, e, strict);
                    tell(g.pool, "when", from + i, c, !weak);
                }
            }
        }
        qdot_pool_free(g.pool);
    }
    fprintf(stderr, "# %" PRId64 " under a condition: proved %" PRId64 ", refuted %" PRId64 "; %" PRId64 " wrong\n", wanted, proved, refuted, wrong);
    assert_int_equal(wrong, 0);
    assert_true(proved > wanted / 10 && refuted > wanted / 5);
}

/* A polynomial without double zeros: random coefficients, or factors c x - d with zeros that are close or equal to 0. */
static void
random_polynomial(fmpz_poly_t p, flint_rand_t random)
{
    fmpz_poly_t q, g;

    fmpz_poly_init(q);
    fmpz_poly_init(g);
    fmpz_poly_randtest_not_zero(p, random, 1 + (slong)n_randint(random, 9), 1 + n_randint(random, 40));
    for (slong n = (slong)n_randint(random, 8); n > 0; n--) {
        const slong c = (slong)n_randint(random, 5) - 2;

        fmpz_poly_set_coeff_si(q, 0, -c);
        fmpz_poly_set_coeff_si(q, 1, 1);
        fmpz_poly_scalar_mul_2exp(q, q, n_randint(random, 40));
        fmpz_sub_ui(q->coeffs, q->coeffs, n_randint(random, 2));
        fmpz_poly_mul(p, p, q);
    }
    fmpz_poly_derivative(q, p);
    fmpz_poly_gcd(g, p, q);
    if (!fmpz_poly_is_zero(q))
        fmpz_poly_div(p, p, g);
    fmpz_poly_clear(q);
    fmpz_poly_clear(g);
}

/* Counted a second way, by Sturm's sequence; each ball holds a change of sign or a zero, and there are fractions between. */
static void
real_zeros_are_all(void **state)
{
    flint_rand_t random;
    fmpz_poly_t p;
    fmpq_t x, y;

    (void)state;
    flint_randinit(random);
    fmpz_poly_init(p);
    fmpq_init(x);
    fmpq_init(y);
    for (int i = 0; i < 2000; i++) {
        slong bits = i % 2 == 0 ? 24 : 96, n;
        arb_ptr zero;

        random_polynomial(p, random);
        n = qdot_real_zeros(p, bits, &zero);
        assert_int_equal(n, fmpz_poly_num_real_roots(p));
        for (slong k = 0; k <= n && n > 0; k++) {
            qdot_between_zeros(x, k > 0 ? zero + k - 1 : NULL, k < n ? zero + k : NULL);
            fmpz_poly_evaluate_fmpq(y, p, x);
            assert_int_not_equal(fmpq_sgn(y), 0);
            assert_true(k == 0 || arb_rel_accuracy_bits(zero + k - 1) >= bits - 2);
            if (k > 0) {
                arb_t value;

                arb_init(value);
                arb_fmpz_poly_evaluate_arb(value, p, zero + k - 1, 4096);
                assert_true(arb_contains_zero(value));
                arb_set_fmpq(value, x, 4096);
                assert_true(arb_lt(zero + k - 1, value));
                arb_clear(value);
            }
        }
        if (zero != NULL)
            _arb_vec_clear(zero, fmpz_poly_degree(p));
    }
    fmpq_clear(x);
    fmpq_clear(y);
    fmpz_poly_clear(p);
    flint_randclear(random);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(real_zeros_are_all),
        cmocka_unit_test(random_inequalities_are_never_wrong),
        cmocka_unit_test(conditions_are_kept)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
