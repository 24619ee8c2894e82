/* value.c -- sums, products, roots, and functions of multiple angles as quotients. */
#include "normal/field/value.h"

#include <stdlib.h>

#include <flint/fmpz_factor.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "num/integer.h"

static void
value_of_generator(qdot_field *f, qdot_ratio *r, qdot_expr e)
{
    slong v = qdot_field_var(f, e);

    if (v < 0) {
        f->state = QDOT_FIELD_FAILED;
        f->status = qdot_fail(QDOT_EFAILED, "a generator of a field was not found");
        return;
    }
    fmpz_mpoly_gen(r->n, v, f->ctx);
}

/* --- values of sums ---------------------------------------------------------------- */

/* Add p[n] pairwise, at the cost n log n; the sum is p[0]. */
static void
polynomials_add_up(qdot_field *f, slong n, fmpz_mpoly_struct *p)
{
    for (slong step = 1; step < n; step *= 2)
        for (slong i = 0; i + step < n; i += 2 * step)
            if (qdot_field_charge(f,
                                  fmpz_mpoly_length(p + i, f->ctx) +
                                      fmpz_mpoly_length(p + i + step, f->ctx),
                                  1))
                fmpz_mpoly_add(p + i, p + i, p + i + step, f->ctx);
}

static bool
is_over_integer(qdot_field *f, const qdot_ratio *r, fmpz_t d)
{
    if (!fmpz_mpoly_is_fmpz(r->d, f->ctx))
        return false;
    fmpz_mpoly_get_fmpz(d, r->d, f->ctx);
    return true;
}

static const qdot_ratio *
node_value(qdot_field *f, qdot_expr e)
{
    uint32_t i;

    return qdot_map_get(&f->nodes, e, &i) ? &f->value[i] : NULL;
}

/* Add the terms with constant denominators over one common denominator. */
static qdot_status
add_constant_denominator_terms(qdot_field *f, qdot_ratio *r, qdot_expr e)
{
    qdot_pool *pool = f->pool;
    const qdot_expr *args = qdot_expr_args(pool, e);
    uint32_t n = qdot_expr_count(pool, e), count = 0;
    fmpz_mpoly_struct *p = qdot_malloc((n / 2 + 1) * sizeof *p);
    const fmpq *c0 = qdot_expr_rational(pool, args[0]);
    fmpz_t d, all, k;

    if (p == NULL)
        return QDOT_ENOMEM;
    fmpz_init(d);
    fmpz_init(k);
    fmpz_init_set(all, fmpq_denref(c0));
    for (uint32_t i = 1; i < n; i += 2)
        if (is_over_integer(f, node_value(f, args[i]), d)) {
            fmpz_mul(d, d, fmpq_denref(qdot_expr_rational(pool, args[i + 1])));
            fmpz_lcm(all, all, d);
        }
    fmpz_mpoly_init(p, f->ctx);
    fmpz_divexact(k, all, fmpq_denref(c0));
    fmpz_mul(k, k, fmpq_numref(c0));
    fmpz_mpoly_set_fmpz(p, k, f->ctx);
    count = 1;
    for (uint32_t i = 1; i < n; i += 2) {
        const fmpq *c = qdot_expr_rational(pool, args[i + 1]);

        if (!is_over_integer(f, node_value(f, args[i]), d))
            continue;
        fmpz_mul(d, d, fmpq_denref(c));
        fmpz_divexact(k, all, d);
        fmpz_mul(k, k, fmpq_numref(c));
        fmpz_mpoly_init(p + count, f->ctx);
        fmpz_mpoly_scalar_mul_fmpz(p + count, node_value(f, args[i])->n, k, f->ctx);
        count++;
    }
    polynomials_add_up(f, count, p);
    fmpz_mpoly_swap(r->n, p, f->ctx);
    fmpz_mpoly_set_fmpz(r->d, all, f->ctx);
    for (uint32_t i = 0; i < count; i++)
        fmpz_mpoly_clear(p + i, f->ctx);
    fmpz_clear(d);
    fmpz_clear(k);
    fmpz_clear(all);
    qdot_free(p);
    return QDOT_OK;
}

static qdot_status
value_of_sum(qdot_field *f, qdot_ratio *r, qdot_expr e)
{
    const qdot_expr *args = qdot_expr_args(f->pool, e);
    uint32_t n = qdot_expr_count(f->pool, e);
    qdot_ratio term;
    fmpz_t d;

    QDOT_TRY(add_constant_denominator_terms(f, r, e));
    fmpz_init(d);
    qdot_ratio_init(f, &term);
    for (uint32_t i = 1; i < n && qdot_field_goes(f); i += 2)
        if (!is_over_integer(f, node_value(f, args[i]), d)) {
            qdot_ratio_set(f, &term, node_value(f, args[i]));
            qdot_ratio_scale(f, &term, qdot_expr_rational(f->pool, args[i + 1]));
            qdot_ratio_add(f, r, r, &term);
        }
    qdot_ratio_clear(f, &term);
    fmpz_clear(d);
    return QDOT_OK;
}

/* --- values of products and powers ------------------------------------------------- */

/* r = g^k, g the root at v; a negative power is made free of roots below the line by
 * the rule. */
static void
power_of_root(qdot_field *f, qdot_ratio *r, slong v, int64_t k)
{
    qdot_ratio base, lift;
    qdot_rule *rule = qdot_field_rule(f, v);
    const int64_t q = f->gen[v].order, up = k < 0 ? (-k + q - 1) / q : 0;

    qdot_ratio_init(f, &base);
    qdot_ratio_init(f, &lift);
    fmpz_mpoly_gen(base.n, v, f->ctx);
    if (rule == NULL || up == 0) {
        qdot_ratio_pow(f, r, &base, k);
    } else {
        /* use g^k = g^(k + up q) / b^up, where b = g^q by the rule */
        fmpz_mpoly_pow_ui(lift.n, base.n, (ulong)q, f->ctx);
        fmpz_mpoly_sub(lift.n, lift.n, rule->poly, f->ctx);
        qdot_ratio_pow(f, &lift, &lift, -up);
        if (k + up * q == 0) {
            qdot_ratio_set(f, r, &lift);
        } else {
            qdot_ratio_pow(f, &base, &base, k + up * q);
            qdot_ratio_mul(f, r, &base, &lift);
        }
    }
    qdot_ratio_clear(f, &base);
    qdot_ratio_clear(f, &lift);
}

static slong
find_root_generator(qdot_field *f, qdot_expr base)
{
    for (slong v = 0; v < f->n && (size_t)v < f->n_rules; v++)
        if (f->gen[v].kind == QDOT_GEN_ROOT && f->gen[v].of == base)
            return v;
    return -1;
}

/* Set r = base^(p/q); an integer base is split into primes. */
static void
fractional_power(qdot_field *f, qdot_ratio *r, qdot_expr base, const fmpq *x)
{
    slong v = find_root_generator(f, base), p, q;
    qdot_ratio one;
    fmpz_factor_t factors;
    fmpz_t n;

    if (fmpz_bits(fmpq_numref(x)) > 20) {
        f->state = QDOT_FIELD_OVER;
        return;
    }
    p = fmpz_get_si(fmpq_numref(x));
    q = fmpz_get_si(fmpq_denref(x));
    if (v >= 0) {
        power_of_root(f, r, v, (int64_t)p * f->gen[v].order / q);
        return;
    }
    fmpz_init(n);
    fmpz_set(n, fmpq_numref(qdot_expr_rational(f->pool, base)));
    fmpz_factor_init(factors);
    fmpz_factor(factors, n);
    fmpz_mpoly_one(r->n, f->ctx);
    for (slong i = 0; i < factors->num; i++) {
        qdot_ratio_init(f, &one);
        v = find_root_generator(f, qdot_expr_fmpz(f->pool, factors->p + i));
        power_of_root(f, &one, v,
                      (int64_t)p * (int64_t)factors->exp[i] * f->gen[v].order / q);
        qdot_ratio_mul(f, r, r, &one);
        qdot_ratio_clear(f, &one);
    }
    fmpz_factor_clear(factors);
    fmpz_clear(n);
}

static void
value_of_power(qdot_field *f, qdot_ratio *r, qdot_expr base, qdot_expr exponent)
{
    const fmpq *x = qdot_expr_rational(f->pool, exponent);

    if (x == NULL || fmpz_cmp_ui(fmpq_denref(x), 10000) > 0)
        value_of_generator(f, r, qdot_pow(f->pool, base, exponent));
    else if (!fmpz_is_one(fmpq_denref(x)))
        fractional_power(f, r, base, x);
    else if (!qdot_integer_fits(fmpq_numref(x)))
        f->state = QDOT_FIELD_OVER;
    else
        qdot_ratio_pow(f, r, node_value(f, base), qdot_integer_get(fmpq_numref(x)));
}

static void
value_of_product(qdot_field *f, qdot_ratio *r, qdot_expr e)
{
    uint32_t n = qdot_expr_count(f->pool, e);
    qdot_ratio factor;

    fmpz_mpoly_one(r->n, f->ctx);
    qdot_ratio_scale(f, r, qdot_expr_rational(f->pool, qdot_expr_arg(f->pool, e, 0)));
    for (uint32_t i = 1; i < n && qdot_field_goes(f); i += 2) {
        qdot_ratio_init(f, &factor);
        value_of_power(f, &factor, qdot_expr_arg(f->pool, e, i), qdot_expr_arg(f->pool, e, i + 1));
        qdot_ratio_mul(f, r, r, &factor);
        qdot_ratio_clear(f, &factor);
    }
}

/* --- functions of angles ----------------------------------------------------------- */

/* Set c = T_n(x), s = y U_{n-1}(x), n >= 0: cos(n b) and sin(n b), or the hyperbolic functions. */
static void
find_multiple_angle(qdot_field *f, fmpz_mpoly_t s, fmpz_mpoly_t c, slong vs, slong vc, slong n)
{
    fmpz_mpoly_t x, before_s, before_c, next;

    fmpz_mpoly_init(x, f->ctx);
    fmpz_mpoly_init(before_s, f->ctx);
    fmpz_mpoly_init(before_c, f->ctx);
    fmpz_mpoly_init(next, f->ctx);
    fmpz_mpoly_gen(x, vc, f->ctx);
    fmpz_mpoly_one(before_c, f->ctx);
    fmpz_mpoly_gen(s, vs, f->ctx);
    fmpz_mpoly_gen(c, vc, f->ctx);
    if (n == 0) {
        fmpz_mpoly_zero(s, f->ctx);
        fmpz_mpoly_one(c, f->ctx);
    }
    fmpz_mpoly_scalar_mul_si(x, x, 2, f->ctx);
    for (slong k = 1; k < n && qdot_field_charge(f, k, 2); k++) {
        fmpz_mpoly_mul(next, x, s, f->ctx);
        fmpz_mpoly_sub(next, next, before_s, f->ctx);
        fmpz_mpoly_swap(before_s, s, f->ctx);
        fmpz_mpoly_swap(s, next, f->ctx);
        fmpz_mpoly_mul(next, x, c, f->ctx);
        fmpz_mpoly_sub(next, next, before_c, f->ctx);
        fmpz_mpoly_swap(before_c, c, f->ctx);
        fmpz_mpoly_swap(c, next, f->ctx);
    }
    fmpz_mpoly_clear(x, f->ctx);
    fmpz_mpoly_clear(before_s, f->ctx);
    fmpz_mpoly_clear(before_c, f->ctx);
    fmpz_mpoly_clear(next, f->ctx);
}

/* (s, c) <- (s c1 + c s1, c c1 + sign s s1): of the sum of two angles, sign -1 for circular, 1 for
 * hyperbolic ones. */
static void
add_angles(qdot_field *f, fmpz_mpoly_t s, fmpz_mpoly_t c, const fmpz_mpoly_t s1,
           const fmpz_mpoly_t c1, int sign)
{
    fmpz_mpoly_t a, b;

    fmpz_mpoly_init(a, f->ctx);
    fmpz_mpoly_init(b, f->ctx);
    qdot_field_mul(f, a, s, c1);
    qdot_field_mul(f, b, c, s1);
    fmpz_mpoly_add(a, a, b, f->ctx);
    qdot_field_mul(f, b, s, s1);
    qdot_field_mul(f, c, c, c1);
    if (sign < 0)
        fmpz_mpoly_sub(c, c, b, f->ctx);
    else
        fmpz_mpoly_add(c, c, b, f->ctx);
    fmpz_mpoly_swap(s, a, f->ctx);
    fmpz_mpoly_clear(a, f->ctx);
    fmpz_mpoly_clear(b, f->ctx);
}

/* (s, c) of an angle <- those of the angle + n base; `sign` is -1 for circular, 1 for
 * hyperbolic. */
static void
angle_turn(qdot_field *f, fmpz_mpoly_t s, fmpz_mpoly_t c, slong vs, slong n, int sign)
{
    fmpz_mpoly_t s1, c1;

    fmpz_mpoly_init(s1, f->ctx);
    fmpz_mpoly_init(c1, f->ctx);
    find_multiple_angle(f, s1, c1, vs, (slong)f->gen[vs].pair, n < 0 ? -n : n);
    if (n < 0)
        fmpz_mpoly_neg(s1, s1, f->ctx);
    add_angles(f, s, c, s1, c1, sign);
    fmpz_mpoly_clear(s1, f->ctx);
    fmpz_mpoly_clear(c1, f->ctx);
}

/* 4 cos(k pi/12) = a + b sqrt 2 + c sqrt 3 + d sqrt 6, k = 0 .. 6. */
static const signed char twelfth[7][4] = {{4, 0, 0, 0}, {0, 1, 0, 1}, {0, 0, 2, 0},
                                          {0, 2, 0, 0}, {2, 0, 0, 0}, {0, -1, 0, 1},
                                          {0, 0, 0, 0}};

/* Set p = 4 cos(k pi/12). */
static void
four_cos(qdot_field *f, fmpz_mpoly_t p, slong k)
{
    const signed char *row;
    bool minus = false;
    fmpz_mpoly_t root[3];

    k = ((k % 24) + 24) % 24;
    if (k > 12)
        k = 24 - k;
    if (k > 6) {
        k = 12 - k;
        minus = true;
    }
    row = twelfth[k];
    fmpz_mpoly_set_si(p, row[0], f->ctx);
    for (int i = 0; i < 3; i++)
        fmpz_mpoly_init(root[i], f->ctx);
    for (int i = 0; i < 2; i++)
        if (row[1 + i] != 0 || row[3] != 0) {
            slong v = find_root_generator(f, qdot_expr_int(f->pool, i + 2));

            /* here the order is a multiple of 2 */
            fmpz_mpoly_gen(root[i], v, f->ctx);
            fmpz_mpoly_pow_ui(root[i], root[i], f->gen[v].order / 2, f->ctx);
        }
    fmpz_mpoly_mul(root[2], root[0], root[1], f->ctx);
    for (int i = 0; i < 3; i++) {
        fmpz_mpoly_scalar_mul_si(root[i], root[i], row[1 + i], f->ctx);
        fmpz_mpoly_add(p, p, root[i], f->ctx);
        fmpz_mpoly_clear(root[i], f->ctx);
    }
    if (minus)
        fmpz_mpoly_neg(p, p, f->ctx);
}

/* Add the multiple of pi that an angle contains to its sine s and cosine c, which get the denominator 4. */
static void
add_pi_offset(qdot_field *f, fmpz_mpoly_t s, fmpz_mpoly_t c, const fmpq_t pi)
{
    fmpz_mpoly_t s1, c1;
    slong k;
    fmpz_t n;

    fmpz_init(n);
    fmpz_mul_si(n, fmpq_numref(pi), 12 / fmpz_get_si(fmpq_denref(pi)));
    k = (slong)fmpz_fdiv_ui(n, 24);
    fmpz_clear(n);
    fmpz_mpoly_init(s1, f->ctx);
    fmpz_mpoly_init(c1, f->ctx);
    four_cos(f, c1, k);
    four_cos(f, s1, 6 - k);
    add_angles(f, s, c, s1, c1, -1);
    fmpz_mpoly_clear(s1, f->ctx);
    fmpz_mpoly_clear(c1, f->ctx);
}

static const qdot_lattice_row *
lattice_row_of(const qdot_lattice *l, qdot_expr arg)
{
    uint32_t i;

    return qdot_lattice_find(l, arg, &i) ? &l->row[i] : NULL;
}

static slong
find_generator_of_angle(const qdot_field *f, qdot_expr base, qdot_gen_kind kind)
{
    for (slong v = 0; v < f->n; v++)
        if (f->gen[v].kind == kind && f->gen[v].of == base)
            return v;
    return -1;
}

/* Find sin and cos (or sinh and cosh) of an argument. */
static void
sine_cosine(qdot_field *f, qdot_ratio *s, qdot_ratio *c, qdot_expr arg, bool circular)
{
    const qdot_lattice *l = circular ? &f->circular : &f->hyperbolic;
    const qdot_lattice_row *row = lattice_row_of(l, arg);

    fmpz_mpoly_zero(s->n, f->ctx);
    fmpz_mpoly_one(c->n, f->ctx);
    for (size_t j = 0; j < l->n_bases; j++)
        if (row->at[j] != 0)
            angle_turn(f, s->n, c->n,
                       find_generator_of_angle(f, l->base[j], circular ? QDOT_GEN_SIN : QDOT_GEN_SINH),
                       row->at[j], circular ? -1 : 1);
    if (circular && !fmpq_is_zero(&row->pi)) {
        add_pi_offset(f, s->n, c->n, &row->pi);
        fmpz_mpoly_set_si(s->d, 4, f->ctx);
        fmpz_mpoly_set_si(c->d, 4, f->ctx);
        qdot_ratio_cancel(f, s);
        qdot_ratio_cancel(f, c);
    }
}

static void
value_of_exponential(qdot_field *f, qdot_ratio *r, qdot_expr arg)
{
    const qdot_lattice_row *row = lattice_row_of(&f->exponential, arg);
    qdot_ratio factor;

    fmpz_mpoly_one(r->n, f->ctx);
    for (size_t j = 0; j < f->exponential.n_bases; j++) {
        if (row->at[j] == 0)
            continue;
        qdot_ratio_init(f, &factor);
        fmpz_mpoly_gen(factor.n, find_generator_of_angle(f, f->exponential.base[j], QDOT_GEN_EXP),
                       f->ctx);
        qdot_ratio_pow(f, &factor, &factor, row->at[j]);
        qdot_ratio_mul(f, r, r, &factor);
        qdot_ratio_clear(f, &factor);
    }
}

/* Express sinh and cosh by the exponential E: sinh = (E - 1/E)/2, cosh = (E + 1/E)/2. */
static void
write_hyperbolic_by_exponential(qdot_field *f, qdot_ratio *s, qdot_ratio *c, qdot_expr arg)
{
    qdot_ratio e, inverse;
    fmpq_t half;

    fmpq_init(half);
    fmpq_set_si(half, 1, 2);
    qdot_ratio_init(f, &e);
    qdot_ratio_init(f, &inverse);
    value_of_exponential(f, &e, arg);
    qdot_ratio_pow(f, &inverse, &e, -1);
    qdot_ratio_sub(f, s, &e, &inverse);
    qdot_ratio_add(f, c, &e, &inverse);
    qdot_ratio_scale(f, s, half);
    qdot_ratio_scale(f, c, half);
    qdot_ratio_clear(f, &e);
    qdot_ratio_clear(f, &inverse);
    fmpq_clear(half);
}

static void
value_of_function(qdot_field *f, qdot_ratio *r, qdot_expr e)
{
    uint32_t op = qdot_expr_node(f->pool, e)->op;
    qdot_expr arg = qdot_expr_arg(f->pool, e, 0);
    bool hyperbolic = op == QDOT_SINH || op == QDOT_COSH || op == QDOT_TANH;
    qdot_ratio s, c, one;

    if (op == QDOT_EXP) {
        value_of_exponential(f, r, arg);
        return;
    }
    if (!hyperbolic && op != QDOT_SIN && op != QDOT_COS && op != QDOT_TAN &&
        op != QDOT_SEC && op != QDOT_CSC && op != QDOT_COT) {
        value_of_generator(f, r, e);
        return;
    }
    qdot_ratio_init(f, &s);
    qdot_ratio_init(f, &c);
    qdot_ratio_init(f, &one);
    fmpz_mpoly_one(one.n, f->ctx);
    if (hyperbolic && f->exponential.n_rows > 0)
        write_hyperbolic_by_exponential(f, &s, &c, arg);
    else
        sine_cosine(f, &s, &c, arg, !hyperbolic);
    if (op == QDOT_SIN || op == QDOT_SINH)
        qdot_ratio_set(f, r, &s);
    else if (op == QDOT_COS || op == QDOT_COSH)
        qdot_ratio_set(f, r, &c);
    else if (op == QDOT_SEC || op == QDOT_CSC)
        qdot_ratio_div(f, r, &one, op == QDOT_SEC ? &c : &s);
    else
        qdot_ratio_div(f, r, op == QDOT_COT ? &c : &s, op == QDOT_COT ? &s : &c);
    qdot_ratio_clear(f, &s);
    qdot_ratio_clear(f, &c);
    qdot_ratio_clear(f, &one);
}

/* --- values of all nodes ----------------------------------------------------------- */

/* Complete the rule of every root and absolute value whose base is e; none if the base contains 1/e. */
static void
complete_rules(qdot_field *f, qdot_expr e, const qdot_ratio *value)
{
    for (size_t i = 0; i < f->n_rules; i++) {
        qdot_rule *rule = &f->rule[i];
        const qdot_gen *gen = &f->gen[rule->var];
        fmpz_mpoly_t b;

        if (rule->power != 0 || gen->of != e || !fmpz_mpoly_is_one(value->d, f->ctx))
            continue;
        rule->power = gen->kind == QDOT_GEN_ABS ? 2 : (slong)gen->order;
        fmpz_mpoly_init(b, f->ctx);
        if (gen->kind == QDOT_GEN_ABS)
            qdot_field_mul(f, b, value->n, value->n);
        else
            fmpz_mpoly_set(b, value->n, f->ctx);
        fmpz_mpoly_gen(rule->poly, rule->var, f->ctx);
        fmpz_mpoly_pow_ui(rule->poly, rule->poly, (ulong)rule->power, f->ctx);
        fmpz_mpoly_sub(rule->poly, rule->poly, b, f->ctx);
        fmpz_mpoly_clear(b, f->ctx);
    }
}

static bool
has_open_rules(const qdot_field *f)
{
    return f->n_rules > 0 &&
           (f->gen[0].kind == QDOT_GEN_ROOT || f->gen[0].kind == QDOT_GEN_ABS);
}

qdot_status
qdot_value_all(qdot_field *f)
{
    f->value = qdot_malloc((f->n_nodes + 1) * sizeof *f->value);
    if (f->value == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < f->n_nodes; i++)
        qdot_ratio_init(f, &f->value[i]);
    for (size_t i = 0; i < f->n_nodes && qdot_field_goes(f); i++) {
        qdot_expr e = f->node[i];
        qdot_ratio *r = &f->value[i];

        switch (qdot_expr_kind(f->pool, e)) {
        case QDOT_NUM:
            fmpz_mpoly_set_fmpz(r->n, fmpq_numref(qdot_expr_rational(f->pool, e)),
                                f->ctx);
            fmpz_mpoly_set_fmpz(r->d, fmpq_denref(qdot_expr_rational(f->pool, e)),
                                f->ctx);
            break;
        case QDOT_SUM: QDOT_TRY(value_of_sum(f, r, e)); break;
        case QDOT_PROD: value_of_product(f, r, e); break;
        case QDOT_FUN: value_of_function(f, r, e); break;
        default: value_of_generator(f, r, e);
        }
        if (has_open_rules(f))
            complete_rules(f, e, r);
        if (qdot_pool_failed(f->pool))
            return qdot_pool_check(f->pool);
    }
    return QDOT_OK;
}
