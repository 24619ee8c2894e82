/* complex-ball.c -- evaluates an integrand in balls of complex numbers, in one pass over its nodes. */
#include "expr/complex-ball.h"

#include "base/memory.h"
#include "expr/elementary.h"
#include "expr/elliptic-ball.h"
#include "expr/exact.h"
#include "expr/function-ball.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"

enum { INNER_EVALUATIONS = 600, DEEPEST = 3 };

/* One evaluation of an integrand, to so many bits. */
typedef struct {
    qdot_complex_ball *b;
    slong bits;
} evaluation;

static acb_ptr
value_of(const evaluation *v, qdot_expr e, uint32_t i)
{
    return v->b->value + qdot_walk_index(&v->b->walk, qdot_expr_arg(v->b->pool, e, i));
}

/* Whether z may lie on the real line at or below `most`. */
static bool
may_be_below(const acb_t z, int most)
{
    arb_t end;
    bool may;

    arb_init(end);
    arb_set_si(end, most);
    may = arb_contains_zero(acb_imagref(z)) && !arb_gt(acb_realref(z), end);
    arb_clear(end);
    return may;
}

/* Whether the part x of z may be beyond -1 and 1 while the other part is 0. */
static bool
may_be_outside_unit(const arb_t x, const arb_t other)
{
    arb_t one, size;
    bool may;

    arb_init(one);
    arb_init(size);
    arb_one(one);
    arb_abs(size, x);
    may = arb_contains_zero(other) && !arb_lt(size, one);
    arb_clear(one);
    arb_clear(size);
    return may;
}

/* --- powers ---------------------------------------------------------------------------------------- */

/* y = x^p for a real x that may touch 0 from above, p no integer. */
static void
real_root(arb_t y, const arb_t x, const fmpq *p, slong bits)
{
    arf_t hi;
    arb_t upper;

    if (arb_is_positive(x)) {
        arb_pow_fmpq(y, x, p, bits);
        return;
    }
    if (arb_is_negative(x) || fmpq_sgn(p) < 0 || !arb_is_finite(x)) {
        arb_indeterminate(y);
        return;
    }
    arf_init(hi);
    arb_init(upper);
    arb_get_ubound_arf(hi, x, bits);
    arb_set_arf(upper, hi);
    if (arf_sgn(hi) > 0)
        arb_pow_fmpq(upper, upper, p, bits); /* the values from 0 to there */
    arb_zero(y);
    arb_union(y, y, upper, bits);
    arf_clear(hi);
    arb_clear(upper);
}

static void
rational_power(const evaluation *v, acb_t y, const acb_t x, const fmpq *p)
{
    arb_t q;

    if (fmpz_is_one(fmpq_denref(p))) {
        acb_pow_fmpz(y, x, fmpq_numref(p), v->bits);
        return;
    }
    if (acb_is_real(x) && !v->b->analytic) {
        real_root(acb_realref(y), acb_realref(x), p, v->bits);
        arb_zero(acb_imagref(y));
        return;
    }
    if (may_be_below(x, 0)) {
        acb_indeterminate(y);
        return;
    }
    if (fmpz_equal_si(fmpq_denref(p), 2)) { /* more accurate than by the logarithm */
        acb_sqrt(y, x, v->bits);
        acb_pow_fmpz(y, y, fmpq_numref(p), v->bits);
        return;
    }
    arb_init(q);
    arb_set_fmpq(q, p, v->bits);
    acb_pow_arb(y, x, q, v->bits);
    arb_clear(q);
}

static void
general_power(const evaluation *v, acb_t y, const acb_t x, const acb_t p)
{
    if (may_be_below(x, 0))
        acb_indeterminate(y);
    else
        acb_pow(y, x, p, v->bits);
}

static void
complex_of_sum(const evaluation *v, acb_t y, qdot_expr e)
{
    acb_set(y, value_of(v, e, 0));
    for (uint32_t i = 1; i < qdot_expr_count(v->b->pool, e); i += 2)
        acb_addmul(y, value_of(v, e, i), value_of(v, e, i + 1), v->bits);
}

static void
complex_of_product(const evaluation *v, acb_t y, qdot_expr e)
{
    acb_t factor;

    acb_init(factor);
    acb_set(y, value_of(v, e, 0));
    for (uint32_t i = 1; i < qdot_expr_count(v->b->pool, e); i += 2) {
        const fmpq *p = qdot_expr_rational(v->b->pool, qdot_expr_arg(v->b->pool, e, i + 1));

        if (p != NULL)
            rational_power(v, factor, value_of(v, e, i), p);
        else
            general_power(v, factor, value_of(v, e, i), value_of(v, e, i + 1));
        acb_mul(y, y, factor, v->bits);
    }
    acb_clear(factor);
}

/* --- functions ---------------------------------------------------------------------------------------- */

/* A function of one complex argument that is analytic but for poles, where Arb's result is not finite. */
static bool
evaluate_meromorphic(const evaluation *v, acb_t y, qdot_fun_id f, const acb_t x)
{
    switch (f) {
    case QDOT_SIN: acb_sin(y, x, v->bits); break;
    case QDOT_COS: acb_cos(y, x, v->bits); break;
    case QDOT_TAN: acb_tan(y, x, v->bits); break;
    case QDOT_COT: acb_cot(y, x, v->bits); break;
    case QDOT_SEC: acb_cos(y, x, v->bits), acb_inv(y, y, v->bits); break;
    case QDOT_CSC: acb_sin(y, x, v->bits), acb_inv(y, y, v->bits); break;
    case QDOT_SINH: acb_sinh(y, x, v->bits); break;
    case QDOT_COSH: acb_cosh(y, x, v->bits); break;
    case QDOT_TANH: acb_tanh(y, x, v->bits); break;
    case QDOT_EXP: acb_exp(y, x, v->bits); break;
    case QDOT_ERF: acb_hypgeom_erf(y, x, v->bits); break;
    case QDOT_ERFC: acb_hypgeom_erfc(y, x, v->bits); break;
    default: return false;
    }
    return true;
}

/* A function with branch cuts; indeterminate where x may lie on one. */
static bool
evaluate_cut(const evaluation *v, acb_t y, qdot_fun_id f, const acb_t x)
{
    const bool beyond = may_be_outside_unit(acb_realref(x), acb_imagref(x)),
               above = may_be_outside_unit(acb_imagref(x), acb_realref(x));
    void (*value)(acb_t y, const acb_t x, slong bits);
    bool on_cut;

    switch (f) {
    case QDOT_LOG: value = acb_log, on_cut = may_be_below(x, 0); break;
    case QDOT_ACOSH: value = acb_acosh, on_cut = may_be_below(x, 1); break;
    case QDOT_ASIN: value = acb_asin, on_cut = beyond; break;
    case QDOT_ACOS: value = acb_acos, on_cut = beyond; break;
    case QDOT_ATANH: value = acb_atanh, on_cut = beyond; break;
    case QDOT_ATAN: value = acb_atan, on_cut = above; break;
    case QDOT_ASINH: value = acb_asinh, on_cut = above; break;
    default: return false;
    }
    if (on_cut)
        acb_indeterminate(y);
    else
        value(y, x, v->bits);
    return true;
}

/* A function with kinks or steps, continued from the real line where it has none. */
static bool
evaluate_kinked(const evaluation *v, acb_t y, qdot_fun_id f, qdot_expr e)
{
    acb_srcptr x = value_of(v, e, 0);
    const uint32_t n = qdot_expr_count(v->b->pool, e);

    switch (f) {
    case QDOT_ABS: acb_real_abs(y, x, v->b->analytic, v->bits); break;
    case QDOT_SIGN: acb_real_sgn(y, x, v->b->analytic, v->bits); break;
    case QDOT_FLOOR: acb_real_floor(y, x, v->b->analytic, v->bits); break;
    case QDOT_MIN:
    case QDOT_MAX:
        acb_set(y, x);
        for (uint32_t i = 1; i < n; i++)
            (f == QDOT_MIN ? acb_real_min : acb_real_max)(y, y, value_of(v, e, i), v->b->analytic, v->bits);
        break;
    case QDOT_MOD:
        acb_div(y, x, value_of(v, e, 1), v->bits);
        acb_real_floor(y, y, v->b->analytic, v->bits);
        acb_mul(y, y, value_of(v, e, 1), v->bits);
        acb_sub(y, x, y, v->bits);
        break;
    case QDOT_IF:
        if (!acb_is_finite(x))
            acb_indeterminate(y);
        else
            acb_set(y, value_of(v, e, acb_is_zero(x) ? 2 : 1));
        if (!acb_is_finite(x) && !v->b->analytic) /* either value */
            acb_union(y, value_of(v, e, 1), value_of(v, e, 2), v->bits);
        break;
    default: return false;
    }
    return true;
}

static bool
are_real(const evaluation *v, qdot_expr e)
{
    for (uint32_t i = 0; i < qdot_expr_count(v->b->pool, e); i++)
        if (!acb_is_real(value_of(v, e, i)))
            return false;
    return true;
}

/* Real functions of several arguments; indeterminate where the arguments are not real. */
static void
evaluate_real(const evaluation *v, acb_t y, qdot_fun_id f, qdot_expr e)
{
    const uint32_t n = qdot_expr_count(v->b->pool, e);
    const arb_struct *x[3] = {NULL, NULL, NULL};

    acb_indeterminate(y);
    if (v->b->analytic || !are_real(v, e) || n > 3)
        return;
    for (uint32_t i = 0; i < n; i++)
        x[i] = acb_realref(value_of(v, e, i));
    if (qdot_is_elliptic(f))
        qdot_elliptic_ball(acb_realref(y), f, n, x, v->bits);
    else if (f == QDOT_ATAN2)
        arb_atan2(acb_realref(y), x[0], x[1], v->bits);
    else
        return;
    arb_zero(acb_imagref(y));
}

/* A complete elliptic integral of one argument m, with its cut from 1 on. */
static bool
evaluate_complete(const evaluation *v, acb_t y, qdot_fun_id f, qdot_expr e)
{
    acb_srcptr m = value_of(v, e, 0);
    acb_t below;

    if ((f != QDOT_ELLIPTIC_K && f != QDOT_ELLIPTIC_E) || qdot_expr_count(v->b->pool, e) != 1)
        return false;
    acb_init(below);
    acb_sub_ui(below, m, 1, v->bits);
    acb_neg(below, below);
    if (may_be_below(below, 0))
        acb_indeterminate(y);
    else
        (f == QDOT_ELLIPTIC_K ? acb_elliptic_k : acb_elliptic_e)(y, m, v->bits);
    acb_clear(below);
    return true;
}

static void
complex_of_function(const evaluation *v, acb_t y, qdot_expr e)
{
    const qdot_fun_id f = (qdot_fun_id)qdot_expr_node(v->b->pool, e)->op;
    acb_srcptr x = value_of(v, e, 0);

    if (evaluate_kinked(v, y, f, e))
        return;
    if (qdot_fun_ball_of(f) != NULL && acb_is_real(x) && !v->b->analytic) {
        qdot_fun_ball_of(f)(acb_realref(y), acb_realref(x), v->bits);
        arb_zero(acb_imagref(y));
    } else if (!evaluate_meromorphic(v, y, f, x) && !evaluate_cut(v, y, f, x) &&
               !evaluate_complete(v, y, f, e)) {
        evaluate_real(v, y, f, e);
    }
}

/* --- conditions ------------------------------------------------------------------------------------------ */

/* 1, 0 or indeterminate: in a disc beside the real line it is what the real parts say on all of it. */
static void
complex_of_relation(const evaluation *v, acb_t y, qdot_expr e)
{
    const unsigned op = qdot_expr_node(v->b->pool, e)->op;
    arb_t d;

    arb_init(d);
    arb_sub(d, acb_realref(value_of(v, e, 0)), acb_realref(value_of(v, e, 1)), v->bits);
    acb_indeterminate(y);
    if (arb_is_positive(d))
        acb_zero(y);
    else if (arb_is_negative(d))
        acb_set_si(y, op != QDOT_EQ);
    else if (arb_is_zero(d) && !v->b->analytic)
        acb_set_si(y, op != QDOT_LT);
    arb_clear(d);
}

static void
complex_of_logic(const evaluation *v, acb_t y, qdot_expr e)
{
    const unsigned op = qdot_expr_node(v->b->pool, e)->op;
    bool all = true;

    if (op == QDOT_NOT) {
        acb_sub_si(y, value_of(v, e, 0), 1, v->bits);
        acb_neg(y, y);
        return;
    }
    acb_set_si(y, op == QDOT_AND);
    for (uint32_t i = 0; i < qdot_expr_count(v->b->pool, e); i++) {
        acb_srcptr x = value_of(v, e, i);

        all = all && acb_is_finite(x);
        if (acb_is_finite(x) && acb_is_zero(x) == (op == QDOT_AND)) {
            acb_set_si(y, op != QDOT_AND);
            return;
        }
    }
    if (!all)
        acb_indeterminate(y);
}

/* --- evaluation of all nodes -------------------------------------------------------------------------------- */

/* The number-th variable from within: 1 is that of f itself. */
static acb_srcptr
variable(const qdot_complex_ball *b, uint32_t number)
{
    while (b != NULL && number > 1) {
        b = b->outer;
        number--;
    }
    return b == NULL ? NULL : b->z;
}

static void
evaluate_symbol(const evaluation *v, acb_t y, qdot_expr e)
{
    const uint32_t number = qdot_bound_number(v->b->pool, e);

    if (number > 0 && variable(v->b, number) != NULL) {
        acb_set(y, variable(v->b, number));
    } else if (e == QDOT_PI) {
        acb_const_pi(y, v->bits);
    } else if (e == QDOT_TRUE || e == QDOT_FALSE) {
        acb_set_si(y, e == QDOT_TRUE);
    } else {
        acb_indeterminate(y);
    }
}

static int
inner_integrand(acb_ptr y, const acb_t z, void *user, slong order, slong bits)
{
    qdot_complex_ball *b = user;

    qdot_complex_ball_eval(b, y, z, order != 0 || b->outer->analytic, bits);
    return 0;
}

/* The integral e within f. It is analytic in the outer variable where its integrand is, on all of its path. */
static void
evaluate_inner(const evaluation *v, acb_t y, qdot_expr e, qdot_complex_ball *inner)
{
    acb_calc_integrate_opt_t options;
    mag_t tolerance;

    if (inner == NULL || !acb_is_finite(value_of(v, e, 1)) || !acb_is_finite(value_of(v, e, 2))) {
        acb_indeterminate(y);
        return;
    }
    mag_init(tolerance);
    mag_set_ui_2exp_si(tolerance, 1, -v->bits);
    acb_calc_integrate_opt_init(options);
    options->eval_limit = INNER_EVALUATIONS;
    acb_calc_integrate(y, inner_integrand, inner, value_of(v, e, 1), value_of(v, e, 2), v->bits, tolerance, options, v->bits);
    mag_clear(tolerance);
}

void
qdot_complex_ball_eval(qdot_complex_ball *b, acb_t y, const acb_t z, bool analytic, slong bits)
{
    const evaluation v = {b, bits};

    b->z = z;
    b->analytic = analytic || !acb_is_real(z);
    for (size_t i = 0; i < b->walk.n; i++) {
        const qdot_expr e = b->walk.at[i];
        acb_ptr x = b->value + i;

        if (qdot_walk_get(&b->walk, e) == 0) /* within the integrand of an inner integral */
            continue;
        switch (qdot_expr_kind(b->pool, e)) {
        case QDOT_NUM: acb_set_fmpq(x, qdot_expr_rational(b->pool, e), bits); break;
        case QDOT_SYM: evaluate_symbol(&v, x, e); break;
        case QDOT_SUM: complex_of_sum(&v, x, e); break;
        case QDOT_PROD: complex_of_product(&v, x, e); break;
        case QDOT_FUN: complex_of_function(&v, x, e); break;
        case QDOT_INTEGRAL: evaluate_inner(&v, x, e, b->inner[i]); break;
        case QDOT_REL: complex_of_relation(&v, x, e); break;
        case QDOT_LOGIC: complex_of_logic(&v, x, e); break;
        default: acb_indeterminate(x);
        }
    }
    acb_set(y, b->value + qdot_walk_index(&b->walk, b->f));
}

/* Prepare the integral of the i-th node, which stands in f. */
static qdot_status
begin_inner(qdot_complex_ball *b, size_t i)
{
    qdot_complex_ball *inner;
    qdot_status status;
    int depth = 1;

    for (const qdot_complex_ball *o = b; o != NULL; o = o->outer)
        depth++;
    if (depth > DEEPEST)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: the number of more than %d integrals within each other", DEEPEST);
    if (!qdot_integral_is_definite(b->pool, b->walk.at[i]))
        return QDOT_OK;
    inner = qdot_malloc(sizeof *inner);
    if (inner == NULL)
        return QDOT_ENOMEM;
    status = qdot_complex_ball_begin(inner, b->pool, qdot_expr_arg(b->pool, b->walk.at[i], 0));
    if (status != QDOT_OK) {
        qdot_free(inner);
        return status;
    }
    inner->outer = b;
    b->kinked = b->kinked || inner->kinked;
    b->inner[i] = inner;
    return QDOT_OK;
}

qdot_status
qdot_complex_ball_begin(qdot_complex_ball *b, const qdot_pool *pool, qdot_expr f)
{
    qdot_status status = QDOT_OK;

    *b = (qdot_complex_ball){.pool = pool, .f = f};
    QDOT_TRY(qdot_walk_begin(pool, f, &b->walk));
    b->value = qdot_calloc(b->walk.n + 1, sizeof *b->value);
    b->inner = qdot_calloc(b->walk.n + 1, sizeof *b->inner);
    if (b->value == NULL || b->inner == NULL) {
        qdot_walk_end(&b->walk);
        qdot_free(b->value);
        qdot_free(b->inner);
        return QDOT_ENOMEM;
    }
    for (size_t i = 0; i < b->walk.n; i++)
        acb_init(b->value + i);
    qdot_integral_mark_outside(pool, &b->walk, f);
    for (size_t i = 0; i < b->walk.n && status == QDOT_OK; i++) {
        const qdot_node *node = qdot_expr_node(pool, b->walk.at[i]);

        if (qdot_walk_get(&b->walk, b->walk.at[i]) == 0)
            continue;
        b->kinked = b->kinked || (node->kind == QDOT_FUN && node->op >= QDOT_ABS);
        if (node->kind == QDOT_INTEGRAL)
            status = begin_inner(b, i);
    }
    if (status != QDOT_OK)
        qdot_complex_ball_end(b);
    return status;
}

void
qdot_complex_ball_end(qdot_complex_ball *b)
{
    for (size_t i = 0; i < b->walk.n; i++) {
        acb_clear(b->value + i);
        if (b->inner[i] != NULL)
            qdot_complex_ball_end(b->inner[i]);
        qdot_free(b->inner[i]);
    }
    qdot_free(b->value);
    qdot_free(b->inner);
    qdot_walk_end(&b->walk);
}
