/* separation.c -- separates the equation of Hamilton and Jacobi, coordinate by coordinate. */
#include "mech/hamilton/separation.h"

#include <stdio.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/hamilton/hamilton.h"
#include "mech/hamilton/separation-split.h"
#include "normal/inequality/inequality.h"
#include "normal/integral/antiderivative.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

enum { MOST = 12 };

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    const qdot_constant_names *names;
    qdot_separation *out;
    unsigned constants; /* number of separation constants made so far */
} separating;

/* --- symbols for constants ------------------------------------------------------------------- */

static bool
name_is_free(const separating *x, const char *name)
{
    const qdot_expr atoms = qdot_expr_atoms(x->pool, x->out->H, true);

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(x->pool, atoms); i++) {
        const qdot_symbol *symbol = qdot_expr_symbol(x->pool, qdot_expr_arg(x->pool, atoms, i));

        if (symbol != NULL && strcmp(symbol->name, name) == 0)
            return false;
    }
    for (size_t i = 0; i < x->s->coordinates.n; i++)
        if (strcmp(qdot_expr_symbol(x->pool, x->s->coordinates.at[i])->name, name) == 0)
            return false;
    return x->names == NULL || x->names->is_free(x->names->user, name);
}

/* A parameter called E, or E1, E2 ..., of which the scene knows nothing. */
static qdot_expr
new_energy(const separating *x)
{
    char name[16] = "E";

    for (int i = 1; !name_is_free(x, name) && i < 100; i++)
        snprintf(name, sizeof name, "E%d", i);
    return qdot_symbol_get(x->pool, QDOT_PARAM, name);
}

/* The next separation constant: beta1, beta2 ..., or another letter where one of these is taken. */
static qdot_expr
new_constant(separating *x)
{
    static const char *const letters[] = {"beta", "gamma", "kappa", "nu"};
    char name[24];

    x->constants++;
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++) {
        snprintf(name, sizeof name, "%s%u", letters[i], x->constants);
        if (name_is_free(x, name))
            break;
    }
    return qdot_symbol_get(x->pool, QDOT_PARAM, name);
}

/* --- one equation for one coordinate ------------------------------------------------------------ */

/* Solve a relation of another than the second degree, by its two roots. */
static qdot_status
solve_other(separating *x, qdot_separated *one)
{
    qdot_solutions roots = {0};
    qdot_pool *pool = x->pool;
    qdot_status status = qdot_solve(pool, one->relation, one->p, &x->facts, &roots);

    if (status == QDOT_OK && roots.complete && roots.root.n == 2 && roots.root.at[0].period == QDOT_NIL && roots.root.at[1].period == QDOT_NIL) {
        const qdot_expr a = roots.root.at[0].value, b = roots.root.at[1].value, half = qdot_mul(pool, QDOT_HALF, qdot_sub(pool, a, b));

        one->shift = qdot_simplify(pool, qdot_mul(pool, QDOT_HALF, qdot_add(pool, a, b)), &x->facts);
        one->square = qdot_simplify(pool, qdot_mul(pool, half, half), &x->facts);
    } else if (status == QDOT_OK && roots.complete && roots.root.n == 1 && roots.root.at[0].period == QDOT_NIL) {
        one->shift = roots.root.at[0].value;
    }
    qdot_solutions_clear(&roots);
    return qdot_grave(status);
}

/* Solve the relation A2 p^2 + A1 p + A0 = 0 for p. */
static qdot_status
solve_momentum(separating *x, qdot_separated *one)
{
    qdot_pool *pool = x->pool;
    const qdot_expr p = one->p;
    qdot_expr A[3], at = one->relation, zero = QDOT_ZERO;
    qdot_decision d;

    for (int k = 0; k < 3; k++) { /* Taylor's coefficients */
        A[k] = qdot_subs(pool, at, 1, &p, &zero);
        if (k == 2)
            A[k] = qdot_mul(pool, QDOT_HALF, at);
        at = qdot_diff(pool, at, p);
        if (at == QDOT_NIL)
            return qdot_pool_check(pool);
    }
    at = qdot_simplify(pool, A[2], &x->facts);
    if (at == QDOT_NIL || qdot_expr_contains(pool, at, p)) {
        (void)qdot_grave(qdot_pool_check(pool));
        return solve_other(x, one);
    }
    /* |p| has a kink where the coefficients are taken */
    QDOT_TRY(qdot_decide_equal(pool, one->relation, qdot_add(pool, A[0], qdot_mul(pool, p, qdot_add(pool, A[1], qdot_mul(pool, at, p)))), &x->facts, &d));
    if (d.verdict == QDOT_REFUTED)
        return QDOT_OK;
    if (at == QDOT_ZERO) {
        one->shift = qdot_simplify(pool, qdot_neg(pool, qdot_div(pool, A[0], A[1])), &x->facts);
        return qdot_pool_check(pool);
    }
    one->shift = qdot_simplify(pool, qdot_div(pool, A[1], qdot_mul(pool, qdot_expr_int(pool, -2), at)), &x->facts);
    one->square = qdot_sub(pool, qdot_mul(pool, one->shift, one->shift), qdot_div(pool, A[0], at));
    one->square = qdot_simplify(pool, one->square, &x->facts);
    return qdot_pool_check(pool);
}

/* --- the factor mu --------------------------------------------------------------------------------- */

/* The coefficient of p^2 in F; 0 where it is not of second degree. */
static qdot_expr
coefficient_of_square(separating *x, qdot_expr F, qdot_expr p)
{
    const qdot_expr twice = qdot_simplify(x->pool, qdot_diff(x->pool, qdot_diff(x->pool, F, p), p), &x->facts);

    return twice == QDOT_NIL || qdot_expr_contains(x->pool, twice, p) ? QDOT_ZERO : qdot_mul(x->pool, QDOT_HALF, twice);
}

/* Split F = 0 times mu. */
static bool
try_factor(separating *x, const qdot_split *split, qdot_expr F, qdot_expr mu, qdot_expr *own, qdot_expr *other)
{
    if (mu == QDOT_NIL || mu == QDOT_ZERO)
        return false;
    if (mu != QDOT_ONE)
        F = qdot_simplify(x->pool, qdot_mul(x->pool, mu, F), &x->facts);
    return F != QDOT_NIL && qdot_split_sum(split, F, own, other);
}

/* Find mu F = own(q, p) + other. */
static bool
find_factor(separating *x, const qdot_split *split, qdot_expr F, qdot_expr *own, qdot_expr *other)
{
    qdot_pool *pool = x->pool;
    const qdot_expr g = coefficient_of_square(x, F, split->p);

    if (try_factor(x, split, F, QDOT_ONE, own, other))
        return true;
    for (size_t k = 0; k < split->n && g != QDOT_ZERO && !qdot_pool_failed(pool); k++) {
        const qdot_expr h = coefficient_of_square(x, F, split->op[k]);
        qdot_expr T;

        if (h == QDOT_ZERO)
            continue;
        T = qdot_split_factor(split, qdot_simplify(pool, qdot_div(pool, g, h), &x->facts));
        if (T != QDOT_NIL && try_factor(x, split, F, qdot_div(pool, T, g), own, other))
            return true;
    }
    return false;
}

/* --- the whole equation ---------------------------------------------------------------------------- */

/* Note beta > 0 if beta = B, and B >= 0 is proved. */
static void
note_sign(separating *x, qdot_expr B, qdot_expr beta)
{
    qdot_expr at = QDOT_NIL;
    bool proved = false;

    if (qdot_inequality(x->pool, B, false, &x->facts, &proved, &at) == QDOT_OK && proved)
        x->out->signs = qdot_conditions_and(x->pool, x->out->signs, qdot_rel(x->pool, QDOT_LT, QDOT_ZERO, beta));
}

/* Separate the coordinates of[group [n]] in F = 0; false: not all of them could be. */
static bool
separate_group(separating *x, size_t n, const size_t *group, qdot_expr F)
{
    qdot_expr oq[MOST], op[MOST];
    size_t moving[MOST], rest[MOST], m = 0;

    for (size_t i = 0; i < n; i++) {
        qdot_separated *one = &x->out->of[group[i]];

        one->cyclic = !qdot_expr_contains(x->pool, F, one->q) && one->q != QDOT_T;
        if (!one->cyclic)
            moving[m++] = group[i];
    }
    if (m == 1 || x->out->n == 1) /* that of a single cyclic coordinate tells its momentum */
        x->out->of[m == 1 ? moving[0] : 0].relation = F;
    if (m <= 1)
        return true;
    for (size_t i = 0; i < m && !qdot_pool_failed(x->pool); i++) {
        const qdot_separated one = x->out->of[moving[i]];
        qdot_split split = {x->pool, &x->facts, 0, one.q, one.p, oq, op};
        qdot_expr own, other, beta;

        for (size_t k = 0; k < m; k++)
            if (k != i) {
                rest[split.n] = moving[k];
                oq[split.n] = x->out->of[moving[k]].q;
                op[split.n++] = x->out->of[moving[k]].p;
            }
        if (!find_factor(x, &split, F, &own, &other)) {
            if (qdot_grave(qdot_pool_check(x->pool)) != QDOT_OK)
                return false;
            continue;
        }
        beta = new_constant(x);
        x->out->of[moving[i]].relation = qdot_add(x->pool, own, beta);
        x->out->of[rest[0]].constant = beta;
        note_sign(x, other, beta);
        return separate_group(x, m - 1, rest, qdot_sub(x->pool, other, beta));
    }
    return false;
}

/* S = sum P_i q_i + F with P_i' = -dH/dq_i, F' = -H(P, t) at q = 0, where dH/dq holds neither q nor p; nil: it does. */
static qdot_expr
linear_solution(separating *x)
{
    qdot_pool *pool = x->pool;
    qdot_expr S = QDOT_ZERO, rest = x->out->H, zero = QDOT_ZERO;

    for (size_t i = 0; i < x->s->coordinates.n; i++) {
        const qdot_separated *one = &x->out->of[i];
        qdot_expr slope = qdot_simplify(pool, qdot_diff(pool, x->out->H, one->q), &x->facts), P;

        for (size_t k = 0; k < x->s->coordinates.n; k++)
            if (slope == QDOT_NIL || qdot_expr_contains(pool, slope, x->out->of[k].q) || qdot_expr_contains(pool, slope, x->out->of[k].p))
                return QDOT_NIL;
        P = qdot_sub(pool, one->p, qdot_antiderivative_or_integral(pool, slope, QDOT_T, &x->facts));
        S = qdot_add(pool, S, qdot_mul(pool, P, one->q));
        rest = qdot_subs(pool, rest, 2, (qdot_expr[]){one->p, one->q}, (qdot_expr[]){P, zero});
    }
    rest = qdot_simplify(pool, rest, &x->facts);
    return qdot_sub(pool, S, qdot_antiderivative_or_integral(pool, rest, QDOT_T, &x->facts));
}

/* Levi-Civita's condition for all pairs: proved, refuted for one, or undecided. */
static qdot_status
decide_by_condition(separating *x)
{
    qdot_pool *pool = x->pool;
    const qdot_expr H = x->out->H;
    bool proved = true;

    x->out->verdict = QDOT_SEPARATION_UNKNOWN;
    for (size_t i = 0; i < x->out->n; i++)
        for (size_t k = i + 1; k < x->out->n; k++) {
            const qdot_separated *a = &x->out->of[i], *b = &x->out->of[k];
            const qdot_expr aq = qdot_diff(pool, H, a->q), ap = qdot_diff(pool, H, a->p), bq = qdot_diff(pool, H, b->q),
                            bp = qdot_diff(pool, H, b->p);
            const qdot_expr left = qdot_add(pool, qdot_product(pool, 3, (qdot_expr[]){aq, bq, qdot_diff(pool, ap, b->p)}),
                                            qdot_product(pool, 3, (qdot_expr[]){ap, bp, qdot_diff(pool, aq, b->q)}));
            const qdot_expr right = qdot_add(pool, qdot_product(pool, 3, (qdot_expr[]){aq, bp, qdot_diff(pool, ap, b->q)}),
                                             qdot_product(pool, 3, (qdot_expr[]){ap, bq, qdot_diff(pool, aq, b->p)}));
            qdot_decision d;

            QDOT_TRY(qdot_pool_check(pool));
            QDOT_TRY(qdot_decide_equal(pool, left, right, &x->facts, &d));
            if (d.verdict == QDOT_REFUTED) {
                x->out->verdict = QDOT_SEPARATES_NOT;
                return QDOT_OK;
            }
            proved &= d.verdict == QDOT_PROVED;
        }
    if (proved)
        x->out->verdict = QDOT_SEPARATION_NOT_FOUND;
    return QDOT_OK;
}

/* Refuse a scene that is not described by H in free coordinates. */
static qdot_status
require_free_coordinates(qdot_scene *s)
{
    qdot_force_source source;

    if (s->coordinates.n == 0) {
        (void)qdot_fail(QDOT_EINVAL, "the scene has no coordinate");
        return qdot_hint("declare it: coord x");
    }
    if (s->coordinates.n >= MOST)
        return qdot_fail(QDOT_ELIMIT, "more than %d coordinates are not separated", MOST - 1);
    if (s->constraints.n > 0) {
        (void)qdot_fail(QDOT_EINVAL, "the equation of Hamilton and Jacobi is that of free coordinates, and the scene has constraints");
        return qdot_hint("choose coordinates that fulfil them, such as an angle for a rod");
    }
    if (s->states.n > 0)
        return qdot_fail(QDOT_EINVAL, "the scene has states, which have no momenta");
    for (size_t k = 0; qdot_mech_source_at(s, k, &source); k++)
        if (!source.conservative)
            return qdot_fail(QDOT_EINVAL, "the motion does not follow from H alone: a %s acts", source.kind);
    return QDOT_OK;
}

qdot_status
qdot_separation_find(qdot_scene *s, qdot_expr energy, const qdot_constant_names *names, qdot_separation *out)
{
    separating x = {.s = s, .pool = s->pool, .facts = qdot_scene_facts(s), .names = names, .out = out};
    size_t group[MOST];
    qdot_expr F;

    *out = (qdot_separation){0};
    QDOT_TRY(require_free_coordinates(s));
    out->H = qdot_hamilton_hamiltonian(s);
    QDOT_TRY(qdot_pool_check(s->pool));
    out->of = qdot_calloc(s->coordinates.n + 1, sizeof *out->of);
    if (out->of == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < s->coordinates.n; i++)
        out->of[out->n++] = (qdot_separated){.q = s->coordinates.at[i], .p = qdot_symbol_of(s->pool, QDOT_MOMENTUM, s->coordinates.at[i])};
    if (qdot_expr_contains(s->pool, out->H, QDOT_T)) {
        out->of[out->n++] = (qdot_separated){.q = QDOT_T, .p = qdot_symbol_get(s->pool, QDOT_FORMAL, "dS/dt")};
        F = qdot_add(s->pool, out->H, out->of[out->n - 1].p);
    } else {
        out->energy = energy != QDOT_NIL ? energy : new_energy(&x);
        F = qdot_sub(s->pool, out->H, out->energy);
    }
    for (size_t i = 0; i < out->n; i++)
        group[i] = i;
    if (separate_group(&x, out->n, group, F)) {
        for (size_t i = 0; i < out->n; i++)
            if (out->of[i].relation != QDOT_NIL)
                QDOT_TRY(solve_momentum(&x, &out->of[i]));
        out->verdict = QDOT_SEPARATES;
        return qdot_pool_check(s->pool);
    }
    QDOT_TRY(qdot_pool_check(s->pool));
    for (size_t i = 0; i < out->n; i++)
        out->of[i].relation = out->of[i].constant = QDOT_NIL;
    if (out->energy != QDOT_NIL)
        return decide_by_condition(&x);
    out->verdict = QDOT_SEPARATION_UNKNOWN;
    out->S = linear_solution(&x);
    return qdot_pool_check(s->pool);
}

void
qdot_separation_clear(qdot_separation *x)
{
    qdot_free(x->of);
    *x = (qdot_separation){0};
}
