/* sample-solve.c -- a relation solved for one atom: in closed form, or at each point by itself.
 *
 * At a point the other atoms have values, and f(x) = 0 is left. Where f is of opposite sign at two
 * places, by balls that hold no zero, and has values on all of the interval between, it has a zero
 * there: the interval is the value, as a ball.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/factor.h"
#include "normal/field/prepare.h"
#include "normal/refute/sample.h"

#define WORK 4000000

/* --- solutions in closed form ------------------------------------------------------ */

/* The sign in front of a square root: 1 or -1, chosen at each point. */
static qdot_expr
sign_of_square_root(qdot_pool *pool, size_t i)
{
    char name[32];

    snprintf(name, sizeof name, "(sign %zu)", i);
    return qdot_symbol_get(pool, QDOT_FORMAL, name);
}

bool
qdot_sample_is_sign(const qdot_pool *pool, qdot_expr e)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, e);

    return s != NULL && strncmp(s->name, "(sign ", 6) == 0;
}

/* How much it is preferred to solve a relation for this symbol or undefined function; 0: never. */
static int
preference_to_solve(const qdot_pool *pool, const qdot_gen *gen)
{
    const qdot_symbol *symbol = qdot_expr_symbol(pool, gen->expr);
    int plain;

    if (gen->kind != QDOT_GEN_PLAIN || qdot_sample_is_sign(pool, gen->expr))
        return 0;
    if (qdot_expr_kind(pool, gen->expr) == QDOT_UFUN)
        return 5;
    if (symbol == NULL)
        return 0;
    plain = symbol->lo == QDOT_NIL && symbol->hi == QDOT_NIL && symbol->sign == 0;
    switch (symbol->class) {
    case QDOT_MULTIPLIER: return 9;
    case QDOT_COORD: return 3 + plain + (symbol->order < 2 ? 2 * (int)symbol->order : 4);
    case QDOT_CONST: return 0;
    case QDOT_PARAM: return 1 + plain;
    default: return 2 + plain;
    }
}

/* Whether the variable v occurs inside another variable (a function or root) that p contains. */
static bool
occurs_inside_another(qdot_field *f, const fmpz_mpoly_t p, slong v)
{
    for (slong w = 0; w < f->n; w++)
        if (w != v && fmpz_mpoly_degree_si(p, w, f->ctx) > 0 &&
            qdot_expr_contains(f->pool, f->gen[w].expr, f->gen[v].expr))
            return true;
    return false;
}

static qdot_expr
coefficient_of(qdot_field *f, const qdot_groups *g, slong v, ulong k)
{
    for (slong i = 0; i < g->n; i++)
        if (g->key[i * f->n + v] == k)
            return qdot_field_expr(f, g->poly + i);
    return QDOT_ZERO;
}

static qdot_expr
solve_for_variable(qdot_field *f, const fmpz_mpoly_t p, slong v, slong degree, qdot_expr either)
{
    qdot_pool *pool = f->pool;
    bool *by = qdot_calloc((size_t)f->n + 1, sizeof *by);
    qdot_groups groups;
    qdot_expr a, b, c, x = QDOT_NIL;

    if (by == NULL)
        return qdot_pool_fail(pool);
    by[v] = true;
    if (qdot_factor_group(f, &groups, p, by) == QDOT_OK) {
        c = coefficient_of(f, &groups, v, 0);
        b = coefficient_of(f, &groups, v, 1);
        a = coefficient_of(f, &groups, v, 2);
        if (degree == 1) {
            x = qdot_neg(pool, qdot_div(pool, c, b));
        } else {
            qdot_expr d =
                qdot_sub(pool, qdot_pow_int(pool, b, 2),
                         qdot_mul(pool, qdot_expr_int(pool, 4), qdot_mul(pool, a, c)));

            x = qdot_mul(pool, either, qdot_sqrt(pool, d));
            x = qdot_div(pool, qdot_sub(pool, x, b),
                         qdot_mul(pool, qdot_expr_int(pool, 2), a));
        }
    }
    qdot_factor_ungroup(f, &groups);
    qdot_free(by);
    return x;
}

/* Whether a function in e may jump although its arguments are defined. */
static bool
may_jump(const qdot_pool *pool, qdot_expr e)
{
    bool may = true;
    qdot_walk w;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return may;
    may = false;
    for (size_t i = 0; i < w.n; i++) {
        uint32_t op = qdot_expr_node(pool, w.at[i])->op;

        may |= qdot_expr_kind(pool, w.at[i]) == QDOT_FUN &&
               (op == QDOT_FLOOR || op == QDOT_MOD || op == QDOT_ATAN2);
    }
    qdot_walk_end(&w);
    return may;
}

/* The symbol for which a relation is solved numerically at each point, as it may occur inside functions. */
static qdot_expr
symbol_for_numerical_solution(qdot_pool *pool, qdot_expr relation, size_t n,
                              const qdot_sample_solution *solved)
{
    qdot_expr atoms, best = QDOT_NIL;
    int fit = 0;

    if (may_jump(pool, relation))
        return QDOT_NIL;
    atoms = qdot_expr_atoms(pool, relation, false);
    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++) {
        qdot_gen gen = {.kind = QDOT_GEN_PLAIN, .expr = qdot_expr_arg(pool, atoms, i)};
        int here = qdot_expr_kind(pool, gen.expr) == QDOT_SYM &&
                           !qdot_sample_is_solved(n, solved, gen.expr)
                       ? preference_to_solve(pool, &gen)
                       : 0;

        if (here > fit) {
            fit = here;
            best = gen.expr;
        }
    }
    return best;
}

bool
qdot_sample_solve(qdot_pool *pool, qdot_expr relation, size_t number, size_t n,
                  const qdot_sample_solution *solved, qdot_sample_solution *out)
{
    qdot_expr e = qdot_prepare(pool, relation);
    slong best = -1, best_degree = 0;
    int fit = 0;
    const qdot_ratio *r;
    qdot_field f;

    *out = (qdot_sample_solution){0};
    qdot_field_begin(&f, pool, 1, &e, WORK);
    r = qdot_field_value(&f, e);
    if (r == NULL || fmpz_mpoly_is_zero(r->n, f.ctx)) {
        bool zero = r != NULL;

        qdot_field_end(&f);
        return zero;
    }
    for (slong v = 0; v < f.n; v++) {
        slong degree = fmpz_mpoly_degree_si(r->n, v, f.ctx);
        int here = degree == 0 || degree > 2
                       ? 0
                       : preference_to_solve(pool, &f.gen[v]) * (degree == 1 ? 2 : 1);

        if (here > fit && !qdot_sample_is_solved(n, solved, f.gen[v].expr) &&
            !occurs_inside_another(&f, r->n, v)) {
            fit = here;
            best = v;
            best_degree = degree;
        }
    }
    if (best >= 0) {
        out->atom = f.gen[best].expr;
        out->solution = solve_for_variable(&f, r->n, best, best_degree, sign_of_square_root(pool, number));
    }
    qdot_field_end(&f);
    if (best >= 0 && out->solution == QDOT_NIL && qdot_pool_check(pool) != QDOT_OK)
        return false;
    if (best >= 0)
        return out->solution != QDOT_NIL;
    *out = (qdot_sample_solution){symbol_for_numerical_solution(pool, relation, n, solved), relation, true};
    return out->atom != QDOT_NIL;
}

/* --- roots at a point -------------------------------------------------------------- */

enum { PLACES = 24, HALVINGS = 60, SECANTS = 24, LEAST = 64 };

/* The budget, in evaluated nodes, for all zeros of a sample; a node counts more at higher precision. */
#define ROOT_WORK 1000000

/* Evaluate the relation at a->value; its sign, 0 where that is not sure. f: its value, if there is
 * one. */
static int
sign_at_present_value(qdot_sample *s, qdot_sample_atom *a, slong prec, arf_t f)
{
    arb_srcptr value;

    s->root_work += (int64_t)a->relation->walk.n * (1 + prec / 512);
    if (s->root_work > ROOT_WORK)
        return 0;
    a->ready = true;
    qdot_ball_eval(a->relation, prec, qdot_sample_value, s);
    value = qdot_ball_get(a->relation, a->solution);
    if (value == NULL)
        return 0;
    arf_set(f, arb_midref(value));
    return arb_is_positive(value) ? 1 : arb_is_negative(value) ? -1 : 0;
}

static int
sign_at_value(qdot_sample *s, qdot_sample_atom *a, const arf_t x, slong prec, arf_t f)
{
    arb_set_arf(a->value, x);
    return sign_at_present_value(s, a, prec, f);
}

/* Bracket a zero between left < right, where signs differ, by bisection while the signs are certain. */
static bool
bracket_zero(qdot_sample *s, qdot_sample_atom *a, arf_t left, arf_t right)
{
    double lo, hi;
    int before = 0, sign;
    arf_t x, f;

    qdot_sample_range(s, a->atom, &lo, &hi);
    arf_init(x);
    arf_init(f);
    for (int i = 0; i <= PLACES; i++) {
        arf_set_d(x, lo + (hi - lo) * ((double)i + 0.37) / (PLACES + 0.9));
        sign = sign_at_value(s, a, x, LEAST, f);
        if (sign * before < 0) {
            arf_set(right, x);
            break;
        }
        before = sign;
        arf_set(left, x);
    }
    sign = arf_cmp(left, right) < 0 && before != 0;
    for (int i = 0; i < HALVINGS && sign != 0; i++) {
        arf_add(x, left, right, LEAST, ARF_RND_NEAR);
        arf_mul_2exp_si(x, x, -1);
        sign = sign_at_value(s, a, x, LEAST, f);
        if (sign != 0)
            arf_set(sign == before ? left : right, x);
    }
    arf_clear(x);
    arf_clear(f);
    return arf_cmp(left, right) < 0 && before != 0;
}

/* Whether a zero certainly lies within 2^-bits of x; then a->value becomes that ball. */
static bool
ball_contains_zero(qdot_sample *s, qdot_sample_atom *a, const arf_t x, slong bits, slong prec)
{
    bool holds = false;
    arf_t end, r, f;
    int left;

    arf_init(end);
    arf_init(r);
    arf_init(f);
    arf_set_si_2exp_si(r, 1, -bits);
    arf_sub(end, x, r, ARF_PREC_EXACT, ARF_RND_DOWN);
    left = sign_at_value(s, a, end, prec, f);
    arf_add(end, x, r, ARF_PREC_EXACT, ARF_RND_DOWN);
    if (left * sign_at_value(s, a, end, prec, f) < 0) {
        arb_set_arf(a->value, x);
        mag_set_ui_2exp_si(arb_radref(a->value), 1, -bits);
        (void)sign_at_present_value(s, a, prec, f); /* evaluate again inside the ball, which stays in a->value */
        holds = s->root_work <= ROOT_WORK && qdot_ball_get(a->relation, a->solution) != NULL;
    }
    arf_clear(end);
    arf_clear(r);
    arf_clear(f);
    return holds;
}

/* Find a zero between left and right by the secant method, as precisely as `prec` bits allow. */
static bool
find_zero_by_secants(qdot_sample *s, qdot_sample_atom *a, const arf_t left, const arf_t right, slong prec)
{
    slong bits = prec - 16;
    arf_t x, y, fx, fy, step;
    bool found = false;

    arf_init(x), arf_init(y), arf_init(fx), arf_init(fy), arf_init(step);
    arf_set(x, left);
    arf_set(y, right);
    (void)sign_at_value(s, a, x, prec, fx);
    for (int i = 0; i < SECANTS; i++) {
        (void)sign_at_value(s, a, y, prec, fy);
        arf_sub(step, y, x, prec, ARF_RND_NEAR);
        arf_mul(step, step, fy, prec, ARF_RND_NEAR);
        arf_sub(fx, fy, fx, prec, ARF_RND_NEAR);
        arf_set(x, y);
        if (arf_is_zero(fx) || arf_is_zero(fy) || arf_is_special(fx))
            break;
        arf_div(step, step, fx, prec, ARF_RND_NEAR);
        arf_sub(y, y, step, prec, ARF_RND_NEAR);
        arf_set(fx, fy);
        if (arf_cmpabs_2exp_si(step, -prec) < 0)
            break;
    }
    for (; bits > 8 && !found && arf_is_finite(y) && s->root_work <= ROOT_WORK; bits -= bits / 4)
        found = ball_contains_zero(s, a, y, bits, prec);
    arf_clear(x), arf_clear(y), arf_clear(fx), arf_clear(fy), arf_clear(step);
    return found;
}

bool
qdot_sample_root(qdot_sample *s, qdot_sample_atom *a, slong prec)
{
    arf_t left, right;
    bool found;

    if (a->relation == NULL) {
        a->relation = qdot_malloc(sizeof *a->relation);
        if (a->relation == NULL ||
            qdot_ball_begin(a->relation, s->pool, 1, &a->solution) != QDOT_OK) {
            qdot_free(a->relation);
            a->relation = NULL;
            return false;
        }
    }
    arf_init(left);
    arf_init(right);
    found = bracket_zero(s, a, left, right) && find_zero_by_secants(s, a, left, right, prec);
    arf_clear(left);
    arf_clear(right);
    a->ready = found;
    return found;
}
