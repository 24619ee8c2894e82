/* cells.c -- projects polynomials symbol by symbol, then lifts rational sample points. */
#include "normal/inequality/cells.h"

#include <stdlib.h>

#include <flint/fmpz_mpoly_factor.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "normal/field/factor.h"
#include "normal/field/prepare.h"
#include "normal/inequality/cells-closure.h"
#include "normal/inequality/real-zeros.h"
#include "normal/refute/ball.h"
#include "normal/refute/constant.h"

enum { MOST_SYMBOLS = 4, MOST_TERMS = 300, MOST_DEGREE = 40, MOST_CONDITIONS = 16, MOST_BITS = 2048 };
enum { MOST_POLYNOMIALS = 30 /* a level */ };
#define WORK 4000000

typedef qdot_vec(fmpz_mpoly_struct) polynomials;

typedef struct {
    qdot_pool *pool;
    qdot_field f;
    qdot_expr *all; /* [1 + n_conditions + n_bases] e, then right - left of conditions, then arguments of even roots */
    size_t n_conditions, n_bases;
    qdot_expr unused[MOST_CONDITIONS]; /* right - left of conditions that only a counterexample must satisfy */
    size_t n_unused;
    bool weak[MOST_CONDITIONS];
    slong symbol[MOST_SYMBOLS]; /* variables of the field for the symbols; the last is eliminated first */
    slong n;
    polynomials level[MOST_SYMBOLS];
    polynomials zero; /* factors of the norm of e, whose zeros include those of e */
    fmpq x[MOST_SYMBOLS];
    slong chosen; /* number of symbols whose value x has been chosen */
    arb_t root;   /* with a single symbol: an algebraic number used in place of x[0] */
    bool at_root;
    qdot_ball ball;
    int64_t *work; /* the remaining budget of operations */
    bool too_much, any, inside, touches;
    bool denied; /* e < 0 at a point where an unused condition fails or is undecided */
    qdot_expr point;
} cells;

/* --- cost, levels and lists of polynomials --------------------------------------------- */

static bool
charge_work(cells *c, int64_t work)
{
    *c->work -= work;
    c->too_much |= *c->work < 0 || qdot_interrupt_is_set();
    return !c->too_much;
}

/* Before a resultant (of a polynomial with itself: its discriminant): Bezout's bound of its degree, and
 * so of its terms, times what each of them takes. */
static bool
charge_resultant(cells *c, const fmpz_mpoly_t p, const fmpz_mpoly_t q, slong v)
{
    const int64_t least = 1000;
    slong degree = fmpz_mpoly_total_degree_si(p, c->f.ctx) * fmpz_mpoly_total_degree_si(q, c->f.ctx);
    slong sides = fmpz_mpoly_degree_si(p, v, c->f.ctx) + fmpz_mpoly_degree_si(q, v, c->f.ctx);
    int64_t terms = 1;

    for (slong k = 1; k < c->n && terms < *c->work; k++)
        terms *= 1 + degree / k;
    return charge_work(c, least + terms * sides * sides);
}

static bool
is_small_enough(const cells *c, const fmpz_mpoly_t p)
{
    return fmpz_mpoly_length(p, c->f.ctx) <= MOST_TERMS &&
           fmpz_mpoly_total_degree_fits_si(p, c->f.ctx) &&
           fmpz_mpoly_total_degree_si(p, c->f.ctx) <= MOST_DEGREE &&
           llabs(fmpz_mpoly_max_bits(p)) < MOST_BITS;
}

/* The index of the last symbol in the polynomial p, its level; -1 if p is constant. */
static slong
level_of(const cells *c, const fmpz_mpoly_t p)
{
    for (slong k = c->n - 1; k >= 0; k--)
        if (fmpz_mpoly_degree_si(p, c->symbol[k], c->f.ctx) > 0)
            return k;
    return -1;
}

static bool
list_has_polynomial(const cells *c, const polynomials *list, const fmpz_mpoly_t p)
{
    for (size_t i = 0; i < list->n; i++)
        if (fmpz_mpoly_equal(list->at + i, p, c->f.ctx))
            return true;
    return false;
}

static void
append_polynomial(cells *c, polynomials *list, const fmpz_mpoly_t p)
{
    fmpz_mpoly_struct copy;

    if (list_has_polynomial(c, list, p))
        return;
    fmpz_mpoly_init(&copy, c->f.ctx);
    fmpz_mpoly_set(&copy, p, c->f.ctx);
    if (list->n >= MOST_POLYNOMIALS || qdot_vec_push(list, copy) != QDOT_OK) {
        fmpz_mpoly_clear(&copy, c->f.ctx);
        c->too_much = true;
    }
}

/* Add the irreducible factors of p to the polynomials of their levels (last symbols), and to the list `also`. */
static void
level_add_factors(cells *c, const fmpz_mpoly_t p, polynomials *also)
{
    fmpz_mpoly_factor_t factors;
    fmpz_mpoly_t q;

    if (fmpz_mpoly_is_fmpz(p, c->f.ctx) || c->too_much)
        return;
    if (!is_small_enough(c, p) || !charge_work(c, 100 * fmpz_mpoly_length(p, c->f.ctx) *
                                            fmpz_mpoly_total_degree_si(p, c->f.ctx))) {
        c->too_much = true;
        return;
    }
    fmpz_mpoly_factor_init(factors, c->f.ctx);
    fmpz_mpoly_init(q, c->f.ctx);
    if (!fmpz_mpoly_factor(factors, p, c->f.ctx))
        c->too_much = true;
    for (slong i = 0; i < fmpz_mpoly_factor_length(factors, c->f.ctx) && !c->too_much;
         i++) {
        slong k;

        fmpz_mpoly_factor_get_base(q, factors, i, c->f.ctx);
        if (fmpz_sgn(q->coeffs) < 0)
            fmpz_mpoly_neg(q, q, c->f.ctx);
        k = level_of(c, q);
        if (k < 0)
            continue;
        append_polynomial(c, &c->level[k], q);
        if (also != NULL)
            append_polynomial(c, also, q);
    }
    fmpz_mpoly_clear(q, c->f.ctx);
    fmpz_mpoly_factor_clear(factors, c->f.ctx);
}

/* Replace p by its norm over roots and absolute values: a polynomial in the symbols that is 0 wherever p is. */
static void
replace_by_norm(cells *c, fmpz_mpoly_t p)
{
    qdot_field *f = &c->f;

    for (size_t i = 0; i < f->n_rules && !c->too_much; i++) {
        const qdot_rule *r = &f->rule[i]; /* replace outer roots first */

        if (fmpz_mpoly_degree_si(p, r->var, f->ctx) == 0)
            continue;
        if (!is_small_enough(c, p) || !is_small_enough(c, r->poly) || r->power > 8 ||
            !charge_resultant(c, p, r->poly, r->var) ||
            !fmpz_mpoly_resultant(p, p, r->poly, r->var, f->ctx))
            c->too_much = true;
    }
}

/* Add the polynomials whose zeros bound the regions in which an expression has one sign. */
static void
add_expression(cells *c, qdot_expr e, bool zeros)
{
    const qdot_ratio *r = qdot_field_value(&c->f, e);
    fmpz_mpoly_t p;

    if (r == NULL) {
        c->too_much = true;
        return;
    }
    fmpz_mpoly_init(p, c->f.ctx);
    for (int i = 0; i < 2 && !c->too_much; i++) {
        fmpz_mpoly_set(p, i == 0 ? r->n : r->d, c->f.ctx);
        replace_by_norm(c, p);
        if (fmpz_mpoly_is_zero(p, c->f.ctx) && i == 0)
            c->too_much |= !fmpz_mpoly_is_zero(r->n, c->f.ctx);
        else if (!c->too_much)
            level_add_factors(c, p, zeros && i == 0 ? &c->zero : NULL);
    }
    fmpz_mpoly_clear(p, c->f.ctx);
}

/* Add leading coefficients, discriminants and resultants of the polynomials of level k. */
static void
level_project(cells *c, slong k)
{
    polynomials *l = &c->level[k];
    slong v = c->symbol[k];
    fmpz_mpoly_t p;

    fmpz_mpoly_init(p, c->f.ctx);
    for (size_t i = 0; i < l->n && !c->too_much; i++) {
        fmpz_mpoly_univar_t u;

        fmpz_mpoly_univar_init(u, c->f.ctx);
        fmpz_mpoly_to_univar(u, l->at + i, v, c->f.ctx);
        fmpz_mpoly_univar_get_term_coeff(p, u, 0, c->f.ctx);
        fmpz_mpoly_univar_clear(u, c->f.ctx);
        level_add_factors(c, p, NULL);
        if (fmpz_mpoly_degree_si(l->at + i, v, c->f.ctx) > 1 && !c->too_much &&
            charge_resultant(c, l->at + i, l->at + i, v)) {
            if (!fmpz_mpoly_discriminant(p, l->at + i, v, c->f.ctx))
                c->too_much = true;
            else
                level_add_factors(c, p, NULL);
        }
        for (size_t j = 0; j < i && !c->too_much; j++) {
            if (!charge_resultant(c, l->at + i, l->at + j, v) ||
                !fmpz_mpoly_resultant(p, l->at + i, l->at + j, v, c->f.ctx))
                c->too_much = true;
            else
                level_add_factors(c, p, NULL);
        }
    }
    fmpz_mpoly_clear(p, c->f.ctx);
}

/* --- testing a point -------------------------------------------------------------------- */

static bool
symbol_value(void *user, qdot_expr atom, arb_t value, slong prec)
{
    const cells *c = user;

    for (slong k = 0; k < c->chosen; k++)
        if (c->f.gen[c->symbol[k]].expr == atom) {
            if (c->at_root)
                arb_set(value, c->root);
            else
                arb_set_fmpq(value, &c->x[k], prec);
            return true;
        }
    return false;
}

/* The exact sign of e at the chosen values of the symbols. */
static qdot_constant_sign
sign_at_point(cells *c, qdot_expr e)
{
    qdot_constant_sign sign = QDOT_CONSTANT_UNKNOWN;

    for (slong k = 0; k < c->n; k++) {
        qdot_expr x = c->f.gen[c->symbol[k]].expr, v = qdot_expr_fmpq(c->pool, &c->x[k]);

        e = qdot_subs(c->pool, e, 1, &x, &v);
    }
    if (e == QDOT_NIL || qdot_constant_decide(c->pool, e, &sign) != QDOT_OK)
        c->too_much = true;
    return c->too_much ? QDOT_CONSTANT_UNKNOWN : sign;
}

static bool
is_zero_at_point(cells *c, qdot_expr e)
{
    return sign_at_point(c, e) == QDOT_CONSTANT_ZERO;
}

/* Whether the weak conditions that were left out of the search hold at the chosen point. */
static bool
unused_conditions_hold(cells *c)
{
    bool hold = true;

    for (size_t i = 0; i < c->n_unused && hold; i++) {
        const qdot_constant_sign sign = sign_at_point(c, c->unused[i]);

        hold = sign == QDOT_CONSTANT_POSITIVE || sign == QDOT_CONSTANT_ZERO;
    }
    return hold;
}

/* The sign of an expression at the point where it was last evaluated in ball arithmetic; 2 if not known. */
static int
sign_of_enclosure(const cells *c, qdot_expr e)
{
    arb_srcptr v = qdot_ball_get(&c->ball, e);

    if (v == NULL || (arb_contains_zero(v) && !arb_is_zero(v)))
        return 2;
    return arb_sgn_nonzero(v);
}

typedef enum { OUTSIDE, INSIDE, UNCLEAR } place;

/* Whether all conditions hold and all roots are real at the values of the symbols chosen so far. */
static place
check_conditions_at_point(const cells *c)
{
    place p = INSIDE;

    for (size_t i = 1; i < 1 + c->n_conditions + c->n_bases; i++) {
        int s = sign_of_enclosure(c, c->all[i]);

        if (s < 0 || (s == 0 && !(i <= c->n_conditions && c->weak[i - 1])))
            return OUTSIDE;
        if (s == 2)
            p = UNCLEAR;
    }
    return p;
}

static void
store_point(cells *c)
{
    qdot_expr row[MOST_SYMBOLS];

    for (slong k = 0; k < c->n; k++)
        row[k] = qdot_rel(c->pool, QDOT_EQ, c->f.gen[c->symbol[k]].expr,
                          qdot_expr_fmpq(c->pool, &c->x[k]));
    c->point = qdot_list(c->pool, (uint32_t)c->n, row);
}

/* Test the sign of e at the point, now that all symbols have values; false ends the search. */
static bool
test_point(cells *c)
{
    place p = UNCLEAR;
    int s = 2;

    for (slong prec = 64; prec <= MOST_BITS && (p == UNCLEAR || (p == INSIDE && s == 2));
         prec *= 2) {
        if (!charge_work(c, prec / 4 * (int64_t)c->ball.walk.n))
            return false;
        qdot_ball_eval(&c->ball, prec, symbol_value, c);
        p = check_conditions_at_point(c);
        s = sign_of_enclosure(c, c->all[0]);
    }
    c->inside = p == INSIDE;
    if (p == OUTSIDE)
        return true;
    if (p == UNCLEAR || (s == 2 && !is_zero_at_point(c, c->all[0]))) {
        c->too_much = true;
        return false;
    }
    c->any = true;
    if (s >= 0)
        return true;
    if (!unused_conditions_hold(c)) { /* not a counterexample: an unused condition fails here */
        c->denied = true;
        return true;
    }
    store_point(c);
    return false;
}

/* --- sample points of a level ------------------------------------------------------------- */

/* Set r to the polynomial p in the symbol of level k, with the values of the symbols chosen before inserted. */
static void
insert_chosen_values(const cells *c, fmpz_poly_t r, const fmpz_mpoly_struct *p, slong k)
{
    qdot_polynomial_over(r, p, k, c->symbol, c->x, c->f.ctx);
}

/* The precision of isolated zeros in bits: high for one symbol, as expressions are evaluated also at zeros. */
static slong
bits_needed(const cells *c)
{
    return c->n == 1 ? 96 : 24;
}

/* Find the zeros of the polynomials of level k (last symbol k) for the values of the symbols chosen before. */
static slong
find_zeros_of_level(cells *c, slong k, arb_ptr *zeros, slong *room)
{
    fmpz_poly_t p, product, g;
    slong n;

    fmpz_poly_init(p);
    fmpz_poly_init(product);
    fmpz_poly_init(g);
    fmpz_poly_one(product);
    for (size_t i = 0; i < c->level[k].n; i++) {
        insert_chosen_values(c, p, c->level[k].at + i, k);
        if (fmpz_poly_degree(p) > 0)
            fmpz_poly_mul(product, product, p);
    }
    fmpz_poly_derivative(p, product);
    fmpz_poly_gcd(g, product, p);
    fmpz_poly_div(product, product, g);
    *room = fmpz_poly_degree(product);
    *zeros = NULL;
    n = charge_work(c, 20 * (1 + *room) * (1 + *room) * (1 + fmpz_poly_max_limbs(product)))
            ? qdot_real_zeros(product, bits_needed(c), zeros)
            : -1;
    fmpz_poly_clear(p);
    fmpz_poly_clear(product);
    fmpz_poly_clear(g);
    return n;
}

/* Whether e is 0 wherever p is, as p divides the numerator of e. */
static bool
vanishes_with(cells *c, qdot_expr e, const fmpz_mpoly_struct *p)
{
    const qdot_ratio *r = qdot_field_value(&c->f, e);
    bool divides;
    fmpz_mpoly_t q;

    fmpz_mpoly_init(q, c->f.ctx);
    divides = r != NULL && fmpz_mpoly_divides(q, r->n, p, c->f.ctx);
    fmpz_mpoly_clear(q, c->f.ctx);
    return divides;
}

/* For a single symbol: whether the conditions certainly fail at its value `root`, a zero of `factor`. */
static bool
is_outside(cells *c, arb_srcptr root, const fmpz_mpoly_struct *factor)
{
    bool outside = false;

    c->chosen = 1;
    c->at_root = true;
    arb_set(c->root, root);
    qdot_ball_eval(&c->ball, 256, symbol_value, c);
    for (size_t i = 1; i < 1 + c->n_conditions + c->n_bases; i++)
        outside |= sign_of_enclosure(c, c->all[i]) < 0 ||
                   (i <= c->n_conditions && !c->weak[i - 1] && factor != NULL &&
                    vanishes_with(c, c->all[i], factor));
    c->at_root = false;
    return outside;
}

/* For a single symbol: the polynomial that is 0 at `root`; NULL if not known. */
static const fmpz_mpoly_struct *
polynomial_with_zero(cells *c, arb_srcptr root)
{
    const fmpz_mpoly_struct *found = NULL;
    int n = 0;
    fmpz_poly_t p;
    arb_t v;

    fmpz_poly_init(p);
    arb_init(v);
    for (size_t i = 0; i < c->level[0].n; i++) {
        insert_chosen_values(c, p, c->level[0].at + i, 0);
        arb_fmpz_poly_evaluate_arb(v, p, root, 256);
        if (arb_contains_zero(v)) {
            found = c->level[0].at + i;
            n++;
        }
    }
    fmpz_poly_clear(p);
    arb_clear(v);
    return n == 1 ? found : NULL;
}

/* Choose values for the symbols from level k on (recursion is bounded by MOST_SYMBOLS). False ends
 * the search. */
static bool
choose_values_from(cells *c, slong k)
{
    slong room, n;
    arb_ptr zero;
    bool go = true, before = true;

    if (k == c->n)
        return test_point(c);
    n = find_zeros_of_level(c, k, &zero, &room);
    c->too_much |= n < 0;
    for (slong i = 0; i <= n && go && !c->too_much; i++) {
        qdot_between_zeros(&c->x[k], i > 0 ? zero + i - 1 : NULL,
                           i < n ? zero + i : NULL);
        c->chosen = k + 1;
        if (!charge_work(c, 20 * (int64_t)c->ball.walk.n))
            break;
        if (k + 1 < c->n) { /* skip this value of the symbol if a condition already fails */
            qdot_ball_eval(&c->ball, 64, symbol_value, c);
            if (check_conditions_at_point(c) == OUTSIDE)
                continue;
        }
        go = choose_values_from(c, k + 1);
        /* an isolated value whose neighbourhood is excluded on both sides */
        if (c->n == 1 && go && i > 0 && !before && !c->inside)
            c->too_much |= !is_outside(c, zero + i - 1, polynomial_with_zero(c, zero + i - 1));
        before = c->inside;
    }
    if (zero != NULL)
        _arb_vec_clear(zero, room);
    return go && !c->too_much;
}

/* --- zeros of e, if it has one symbol ------------------------------------------------------ */

/* Whether `root`, a zero of a factor of the norm of e, lies in the domain and may be a zero of e. */
static bool
may_be_zero(cells *c, arb_srcptr root, const fmpz_mpoly_t factor)
{
    return !is_outside(c, root, factor) && sign_of_enclosure(c, c->all[0]) != 1;
}

/* Find whether e has a zero, given that e >= 0 is known. */
static void
search_zeros_of_e(cells *c)
{
    fmpz_poly_t p;

    fmpz_poly_init(p);
    c->chosen = 1;
    for (size_t i = 0; i < c->zero.n && !c->touches && !c->too_much; i++) {
        slong n, room;
        arb_ptr zero;

        insert_chosen_values(c, p, c->zero.at + i, 0);
        room = fmpz_poly_degree(p);
        n = qdot_real_zeros(p, bits_needed(c), &zero);
        c->touches |= n < 0;
        for (slong k = 0; k < n && !c->touches; k++) {
            c->touches = may_be_zero(c, zero + k, c->zero.at + i);
            if (c->touches && room == 1) { /* a rational point */
                fmpz_poly_get_coeff_fmpz(fmpq_numref(&c->x[0]), p, 0);
                fmpz_poly_get_coeff_fmpz(fmpq_denref(&c->x[0]), p, 1);
                fmpq_neg(&c->x[0], &c->x[0]);
                fmpq_canonicalise(&c->x[0]);
                qdot_ball_eval(&c->ball, 128, symbol_value, c);
                if (is_zero_at_point(c, c->all[0]) && check_conditions_at_point(c) == INSIDE)
                    store_point(c);
            }
        }
        if (zero != NULL)
            _arb_vec_clear(zero, room);
    }
    fmpz_poly_clear(p);
}

/* --- the search for a counterexample ------------------------------------------------------- */

/* Choose the order of the symbols: those of low degree are projected first. */
static bool
choose_symbols(cells *c)
{
    qdot_field *f = &c->f;

    for (slong v = 0; v < f->n; v++) {
        qdot_gen_kind kind = f->gen[v].kind;
        qdot_expr e = f->gen[v].expr;

        if (kind == QDOT_GEN_ROOT || kind == QDOT_GEN_ABS)
            continue;
        if (kind != QDOT_GEN_PLAIN || qdot_expr_kind(c->pool, e) != QDOT_SYM ||
            qdot_expr_is_class(c->pool, e, QDOT_CONST) || c->n == MOST_SYMBOLS)
            return false;
        c->symbol[c->n++] = v;
    }
    return c->n > 0;
}

static void
order_symbols(cells *c)
{
    slong degree[MOST_SYMBOLS];

    for (slong k = 0; k < c->n; k++) {
        const qdot_ratio *r = qdot_field_value(&c->f, c->all[0]);

        degree[k] = r == NULL ? 0 : fmpz_mpoly_degree_si(r->n, c->symbol[k], c->f.ctx);
        for (slong i = k; i > 0 && degree[i - 1] < degree[i]; i--) {
            slong d = degree[i], v = c->symbol[i];

            degree[i] = degree[i - 1];
            degree[i - 1] = d;
            c->symbol[i] = c->symbol[i - 1];
            c->symbol[i - 1] = v;
        }
    }
}

/* Append conditions that bases of roots are not negative. */
static bool
append_root_bases(cells *c)
{
    qdot_field *f = &c->f;
    size_t n = 1 + c->n_conditions;

    for (slong v = 0; v < f->n; v++) {
        qdot_expr of = f->gen[v].of, *more;

        if (f->gen[v].kind != QDOT_GEN_ROOT || qdot_expr_is_constant(c->pool, of))
            continue;
        if (c->n > 1 && !(qdot_expr_node(c->pool, of)->sign & QDOT_GE0) && !qdot_gap_is_linear(&c->f, of))
            return false; /* give up, since points where the argument is 0 might be isolated */
        more = qdot_realloc(c->all, (n + 1) * sizeof *more);
        if (more == NULL)
            return false;
        c->all = more;
        c->all[n++] = of;
    }
    c->n_bases = n - 1 - c->n_conditions;
    return true;
}

/* Leave out weak conditions whose solutions are not all limits of interior points. */
static void
choose_conditions(cells *c)
{
    qdot_expr weak[MOST_CONDITIONS];
    size_t kept = 0, n = 0;

    for (size_t i = 0; i < c->n_conditions; i++)
        if (c->weak[i])
            weak[n++] = c->all[1 + i];
    for (size_t i = 0; i < c->n_conditions; i++) {
        const qdot_expr gap = c->all[1 + i];

        if (c->n > 1 && c->weak[i] && !qdot_gap_is_linear(&c->f, gap) && !qdot_gap_grows_alone(&c->f, gap, n, weak)) {
            c->unused[c->n_unused++] = gap;
            continue;
        }
        c->weak[kept] = c->weak[i];
        c->all[1 + kept++] = gap;
    }
    c->n_conditions = kept;
}

static void
cells_search(cells *c, qdot_cells *result)
{
    bool through;

    if (!qdot_field_goes(&c->f) || !qdot_field_is_algebraic(&c->f) || !choose_symbols(c))
        return;
    choose_conditions(c);
    if (!append_root_bases(c) ||
        qdot_ball_begin(&c->ball, c->pool, 1 + c->n_conditions + c->n_bases, c->all) != QDOT_OK)
        return;
    order_symbols(c);
    for (size_t i = 0; i < 1 + c->n_conditions + c->n_bases; i++)
        add_expression(c, c->all[i], i == 0);
    for (slong k = c->n - 1; k > 0 && !c->too_much; k--)
        level_project(c, k);
    through = !c->too_much && choose_values_from(c, 0);
    if (!c->too_much && !through && c->point != QDOT_NIL)
        *result = QDOT_CELLS_NEGATIVE;
    else if (through && !c->too_much && !c->denied)
        *result = c->any ? QDOT_CELLS_NOT_NEGATIVE : QDOT_CELLS_EMPTY;
    if (*result == QDOT_CELLS_NOT_NEGATIVE && c->n == 1) {
        search_zeros_of_e(c);
        if (!c->touches && !c->too_much)
            *result = QDOT_CELLS_POSITIVE;
        else if (c->point != QDOT_NIL)
            *result = QDOT_CELLS_ZERO;
    }
    qdot_ball_end(&c->ball);
}

qdot_status
qdot_cells_decide(qdot_pool *pool, qdot_expr e, size_t n,
                  const qdot_cells_condition *condition, int64_t *work,
                  qdot_cells *result, qdot_expr *at)
{
    cells c = {.pool = pool, .n_conditions = n, .work = work};

    *result = QDOT_CELLS_UNKNOWN;
    *at = QDOT_NIL;
    if (n > MOST_CONDITIONS || *work < 0)
        return QDOT_OK;
    c.all = qdot_malloc((n + 1) * sizeof *c.all);
    if (c.all == NULL)
        return QDOT_ENOMEM;
    c.all[0] = qdot_prepare(pool, e);
    for (size_t i = 0; i < n; i++) {
        c.all[1 + i] = qdot_prepare(pool, condition[i].gap);
        c.weak[i] = condition[i].weak;
    }
    for (int k = 0; k < MOST_SYMBOLS; k++)
        fmpq_init(&c.x[k]);
    arb_init(c.root);
    qdot_field_begin(&c.f, pool, n + 1, c.all, WORK);
    cells_search(&c, result);
    *at = c.point;
    for (int k = 0; k < MOST_SYMBOLS; k++) {
        for (size_t i = 0; i < c.level[k].n; i++)
            fmpz_mpoly_clear(c.level[k].at + i, c.f.ctx);
        qdot_free(c.level[k].at);
        fmpq_clear(&c.x[k]);
    }
    for (size_t i = 0; i < c.zero.n; i++)
        fmpz_mpoly_clear(c.zero.at + i, c.f.ctx);
    qdot_free(c.zero.at);
    arb_clear(c.root);
    qdot_field_end(&c.f);
    qdot_free(c.all);
    if (qdot_interrupt_is_set())
        return qdot_interrupt_check();
    return QDOT_OK;
}
