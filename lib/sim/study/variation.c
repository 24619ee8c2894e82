/* variation.c -- solves the equations of motion symbolically for q'', and differentiates the solution. */
#include "sim/study/variation.h"

#include <stdio.h>
#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/integrated.h"
#include "sim/model/quotient.h"
#include "sim/model/substitute.h"

void
qdot_variation_clear(qdot_variation *v)
{
    qdot_scene_free(v->scene);
    qdot_free(v->y);
    qdot_free(v->a);
    qdot_free(v->start);
    qdot_free(v->named);
    qdot_free(v->scales);
    qdot_free(v->G);
    qdot_free(v->massless);
    qdot_free(v->of_positions);
    *v = (qdot_variation){0};
}

/* --- scenes that cannot be varied ------------------------------------------------------ */

/* Whether the condition that decides a jump of this function depends on the motion or on the
 * parameter (may be nil). */
static bool
jumps_with_motion_or_parameter(const qdot_pool *pool, qdot_expr e, qdot_expr parameter)
{
    const uint32_t moving = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION;
    uint32_t n = qdot_expr_count(pool, e);

    switch (qdot_expr_node(pool, e)->op) {
    case QDOT_IF: n = 1; break;
    case QDOT_SIGN:
    case QDOT_FLOOR:
    case QDOT_MOD: break;
    default: return false;
    }
    for (uint32_t i = 0; i < n; i++) {
        const qdot_expr x = qdot_expr_arg(pool, e, i);

        if (qdot_expr_node(pool, x)->holds & moving ||
            (parameter != QDOT_NIL && qdot_expr_contains(pool, x, parameter)))
            return true;
    }
    return false;
}

/* Refuse equations with functions that jump at a value that depends on the motion or on a parameter. */
static qdot_status
refuse_jumping_functions(const qdot_pool *pool, qdot_expr e, qdot_expr parameter)
{
    qdot_expr found = QDOT_NIL;
    qdot_text text = {0};
    qdot_walk w;
    qdot_status status;

    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    for (size_t i = 0; i < w.n && found == QDOT_NIL; i++)
        if (qdot_expr_kind(pool, w.at[i]) == QDOT_FUN && jumps_with_motion_or_parameter(pool, w.at[i], parameter))
            found = w.at[i];
    qdot_walk_end(&w);
    if (found == QDOT_NIL)
        return QDOT_OK;
    status = qdot_print((qdot_pool *)pool, found, QDOT_PLAIN, &text);
    if (status == QDOT_OK)
        status =
            qdot_fail(QDOT_ENOTBUILT,
                      "not built yet: slopes through jumps of the equations, of %.100s",
                      qdot_text_str(&text));
    qdot_text_clear(&text);
    return status;
}

static qdot_status
refuse_unsuitable_scene(const qdot_scene *s)
{
    if (s->eliminated.n > 0)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: slopes beside constraints and an H from which no Lagrangian follows");
    for (size_t i = 0; i < s->events.n; i++) {
        const qdot_event *e = &s->events.at[i];

        for (size_t j = 0; j < e->targets.n; j++)
            if (qdot_expr_is_class(s->pool, e->targets.at[j], QDOT_PARAM))
                return qdot_fail(
                    QDOT_ENOTBUILT,
                    "not built yet: slopes where the event %.100s sets a parameter",
                    e->name);
        if (e->targets.n > 0 && s->constraints.n > 0)
            return qdot_fail(
                QDOT_ENOTBUILT,
                "not built yet: slopes through the event %.100s of a scene with "
                "constraints",
                e->name);
    }
    return QDOT_OK;
}

/* Derive M and f as a LIST and check them; `values`: the parameter values of a direction or of the request. */
static qdot_status
check_equations(const qdot_variation *v, qdot_expr whole, const qdot_expr *values,
                qdot_expr parameter)
{
    const qdot_run_request *r = v->request;
    qdot_pool *pool = v->of->pool;
    const qdot_expr e = qdot_substitute(pool, whole, r->n_values, r->symbols, values);

    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_node(pool, e)->holds & QDOT_HAS_MULTIPLIER)
        return qdot_fail(QDOT_ENOTBUILT,
                         "not built yet: slopes of friction by multipliers");
    return refuse_jumping_functions(pool, e, parameter);
}

/* --- elimination by the factors of M ---------------------------------------------------- */

/* M = L D L^T, B = M^-1 A^T, S = A B = L D L^T; entries held. Coordinates without mass, whose rows and columns of M are 0,
 * stand in it with mass 1 and have their q'' from the rates of their equations, behind those of the constraints in F and
 * A: W x_w = z_w - A x, with W the part of A by themselves. */
typedef struct {
    qdot_variation *v;
    qdot_pool *pool;
    size_t n, m;
    bool held; /* equations of constraints and massless coordinates are kept in the scene */
    qdot_expr whole;      /* M and f before parameter values are inserted */
    qdot_expr *M, *f;     /* [n x n], [n] M and f with parameter values */
    size_t w;             /* number of massless coordinates; their indices are in v */
    qdot_expr *F, *A; /* second time derivatives of constraints [m + w]; their gradients [(m + w) x n] */
    qdot_expr *rate;      /* [w] time derivatives of the massless equations that contain q'', with parameters as symbols */
    qdot_expr *W;         /* [w x w] the matrix W of the massless coordinates' equations, as LU factors */
    qdot_expr *L, *B, *S; /* factors of M [n x n], B [m x n], factors of S [m x m] */
    qdot_expr *x, *z;     /* [n], [m + w] scratch */
} elimination;

static qdot_status
factor_ldl(qdot_pool *pool, size_t n, qdot_expr *L, size_t *pivot)
{
    for (size_t k = 0; k < n; k++) {
        const qdot_expr d = L[k * n + k];

        *pivot = k;
        if (d == QDOT_ZERO)
            return QDOT_ESINGULAR;
        for (size_t i = k + 1; i < n; i++)
            for (size_t j = k + 1; j <= i; j++)
                if (L[i * n + k] != QDOT_ZERO && L[j * n + k] != QDOT_ZERO)
                    L[i * n + j] = qdot_hold(
                        pool,
                        qdot_sub(pool, L[i * n + j],
                                 qdot_mul(pool, qdot_quotient(pool, L[i * n + k], d),
                                          L[j * n + k])));
        for (size_t i = k + 1; i < n; i++)
            L[i * n + k] = qdot_hold(pool, qdot_quotient(pool, L[i * n + k], d));
    }
    return qdot_pool_check(pool);
}

static void
solve_ldl(qdot_pool *pool, size_t n, const qdot_expr *L, qdot_expr *b)
{
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < i; k++)
            b[i] = qdot_sub(pool, b[i], qdot_mul(pool, L[i * n + k], b[k]));
        b[i] = qdot_hold(pool, b[i]);
    }
    for (size_t k = n; k-- > 0;) {
        b[k] = qdot_quotient(pool, b[k], L[k * n + k]);
        for (size_t i = k + 1; i < n; i++)
            b[k] = qdot_sub(pool, b[k], qdot_mul(pool, L[i * n + k], b[i]));
        b[k] = qdot_hold(pool, b[k]);
    }
}

static bool
is_massless(const elimination *e, size_t i)
{
    for (size_t c = 0; c < e->w; c++)
        if (e->v->massless[c] == i)
            return true;
    return false;
}

/* Solve for the massless components of x [n], given its other components and z [m + w]. */
static void
solve_massless(const elimination *e, qdot_expr *x, qdot_expr *z)
{
    qdot_pool *pool = e->pool;
    const size_t w = e->w, m = e->m;

    for (size_t c = 0; c < w; c++) {
        qdot_expr *own = z + m + c;

        for (size_t i = 0; i < e->n; i++)
            if (!is_massless(e, i))
                *own = qdot_sub(pool, *own, qdot_mul(pool, e->A[(m + c) * e->n + i], x[i]));
        for (size_t k = 0; k < c; k++)
            *own = qdot_sub(pool, *own, qdot_mul(pool, e->W[c * w + k], z[m + k]));
        *own = qdot_hold(pool, *own);
    }
    for (size_t c = w; c-- > 0;) {
        for (size_t k = c + 1; k < w; k++)
            z[m + c] = qdot_sub(pool, z[m + c], qdot_mul(pool, e->W[c * w + k], z[m + k]));
        z[m + c] = qdot_hold(pool, qdot_quotient(pool, z[m + c], e->W[c * w + c]));
    }
    for (size_t c = 0; c < w; c++)
        x[e->v->massless[c]] = z[m + c];
}

/* Solve M x - A^T z = r, A x = g; in: x [n] holds r, z [m] holds g; out: the solution. */
static void
solve_with_constraints(const elimination *e, qdot_expr *x, qdot_expr *z)
{
    qdot_pool *pool = e->pool;

    for (size_t c = 0; c < e->w; c++)
        x[e->v->massless[c]] = QDOT_ZERO;
    solve_ldl(pool, e->n, e->L, x);
    if (e->m == 0) {
        solve_massless(e, x, z);
        return;
    }
    for (size_t c = 0; c < e->m; c++) {
        for (size_t i = 0; i < e->n; i++)
            z[c] = qdot_sub(pool, z[c], qdot_mul(pool, e->A[c * e->n + i], x[i]));
        z[c] = qdot_hold(pool, z[c]);
    }
    solve_ldl(pool, e->m, e->S, z);
    for (size_t i = 0; i < e->n; i++) {
        for (size_t c = 0; c < e->m; c++)
            x[i] = qdot_add(pool, x[i], qdot_mul(pool, e->B[c * e->n + i], z[c]));
        x[i] = qdot_hold(pool, x[i]);
    }
    solve_massless(e, x, z);
}

/* --- coordinates without mass ------------------------------------------------------------- */

/* Whether constraints of the scene contain coordinate i. */
static bool
is_constrained(const elimination *e, size_t i)
{
    const qdot_scene *s = e->v->of;

    for (size_t c = 0; c < s->constraints.n; c++)
        for (uint32_t order = 0; order < 3; order++)
            if (qdot_expr_contains(e->pool, s->constraints.at[c].f, qdot_variation_jet(e->v, i, order)))
                return true;
    return false;
}

/* Whether g contains the given time derivative of any massless coordinate. */
static bool
contains_massless_derivative(const elimination *e, qdot_expr g, uint32_t order)
{
    for (size_t c = 0; c < e->w; c++)
        if (qdot_expr_contains(e->pool, g, qdot_variation_jet(e->v, e->v->massless[c], order)))
            return true;
    return false;
}

static void
swap_expressions(qdot_expr *a, qdot_expr *b)
{
    const qdot_expr c = *a;

    *a = *b;
    *b = c;
}

/* Exchange two equations of massless coordinates. */
static void
swap_massless_equations(elimination *e, size_t c, size_t d)
{
    const bool of_positions = e->v->of_positions[c];

    e->v->of_positions[c] = e->v->of_positions[d];
    e->v->of_positions[d] = of_positions;
    swap_expressions(&e->v->G[c], &e->v->G[d]);
    swap_expressions(&e->rate[c], &e->rate[d]);
    swap_expressions(&e->F[e->m + c], &e->F[e->m + d]);
    for (size_t i = 0; i < e->n; i++)
        swap_expressions(&e->A[(e->m + c) * e->n + i], &e->A[(e->m + d) * e->n + i]);
    for (size_t k = 0; k < e->w; k++)
        swap_expressions(&e->W[c * e->w + k], &e->W[d * e->w + k]);
}

/* W = L U. In phase space (L = p q' - H) the equation of q determines p': equations are exchanged so that each stands where
 * the coordinate does that it determines. *pivot: one that none determines. */
static qdot_status
factor_massless(elimination *e, size_t *pivot)
{
    qdot_pool *pool = e->pool;
    const size_t w = e->w;

    for (size_t c = 0; c < w; c++)
        for (size_t k = 0; k < w; k++)
            e->W[c * w + k] = qdot_hold(pool, e->A[(e->m + c) * e->n + e->v->massless[k]]);
    for (size_t k = 0; k < w; k++) {
        size_t row = k;

        *pivot = e->v->massless[k];
        while (row < w && e->W[row * w + k] == QDOT_ZERO)
            row++;
        if (row == w)
            return QDOT_ESINGULAR;
        if (row != k)
            swap_massless_equations(e, row, k);
        for (size_t i = k + 1; i < w; i++) {
            e->W[i * w + k] = qdot_hold(pool, qdot_quotient(pool, e->W[i * w + k], e->W[k * w + k]));
            for (size_t j = k + 1; j < w; j++)
                e->W[i * w + j] = qdot_hold(
                    pool, qdot_sub(pool, e->W[i * w + j], qdot_mul(pool, e->W[i * w + k], e->W[k * w + j])));
        }
    }
    return qdot_pool_check(pool);
}

/* Find the massless coordinates, and give them the mass 1 in the factor L. */
static void
find_massless(elimination *e)
{
    const size_t n = e->n;

    for (size_t i = 0; i < n; i++) {
        bool mass = is_constrained(e, i);

        for (size_t j = 0; j < n; j++)
            mass = mass || e->M[i * n + j] != QDOT_ZERO;
        if (mass)
            continue;
        e->v->massless[e->w] = i;
        e->v->G[e->w++] = qdot_expr_arg(e->pool, qdot_expr_arg(e->pool, e->whole, 1), (uint32_t)i);
        e->L[i * n + i] = QDOT_ONE;
    }
}

/* Differentiate the equations of massless coordinates by t until they contain q''. */
static qdot_status
differentiate_massless_equations(elimination *e, size_t *pivot)
{
    qdot_variation *v = e->v;

    for (size_t c = 0; c < e->w; c++) {
        const qdot_expr G = qdot_variation_with_numbers(v, v->G[c]);

        v->of_positions[c] = G != QDOT_NIL && !contains_massless_derivative(e, G, 1);
        e->rate[c] = qdot_ddt(e->pool, v->G[c]);
        if (v->of_positions[c])
            e->rate[c] = qdot_ddt(e->pool, e->rate[c]);
        e->F[e->m + c] = qdot_variation_with_numbers(v, e->rate[c]);
        for (size_t i = 0; i < e->n; i++)
            e->A[(e->m + c) * e->n + i] =
                qdot_diff(e->pool, e->F[e->m + c], qdot_variation_jet(v, i, 2));
        QDOT_TRY(qdot_pool_check(e->pool));
    }
    return factor_massless(e, pivot);
}

/* Differentiate constraint c by t until it contains q''. */
static qdot_expr
second_derivative(const elimination *e, size_t c)
{
    const qdot_constraint *of = &e->v->of->constraints.at[c];
    qdot_expr mu, f = qdot_integrated_rate(e->v->of, c, &mu);

    for (int order = of->kind; order < QDOT_ACCELERATION; order++)
        f = qdot_ddt(e->pool, f);
    return f;
}

static qdot_status
fail_singular(const elimination *e, size_t pivot, bool constraint)
{
    const qdot_scene *s = e->v->of;

    if (constraint)
        return qdot_fail(QDOT_ESINGULAR,
                         "constraint %.100s is redundant: there are no derivatives",
                         s->constraints.at[pivot].name);
    return qdot_fail(QDOT_ESINGULAR,
                     "%.100s'' is not determined: the mass matrix is singular",
                     qdot_expr_symbol(s->pool, s->coordinates.at[pivot])->name);
}

static qdot_status
fail_undetermined(const elimination *e, size_t pivot)
{
    const char *name = qdot_expr_symbol(e->pool, e->v->of->coordinates.at[pivot])->name;

    return qdot_fail(QDOT_ESINGULAR,
                     "the equations of coordinates without mass do not determine all of their velocities: "
                     "%.100s' is left over",
                     name);
}

/* Derive M, f and the constraints, and factor the matrices of the equations. */
static qdot_status
derive_and_factor(elimination *e)
{
    qdot_variation *v = e->v;
    qdot_scene *s = v->of;
    qdot_pool *pool = e->pool;
    const size_t n = e->n, m = e->m;
    const qdot_expr M = qdot_mech_numeric_mass(s), f = qdot_mech_numeric_forcing(s);
    size_t pivot = 0;
    qdot_status status;

    QDOT_TRY(qdot_pool_check(pool));
    e->whole = qdot_list(pool, 2, (qdot_expr[]){M, f});
    QDOT_TRY(check_equations(v, e->whole, v->request->values, QDOT_NIL));
    for (size_t k = 0; k < v->k; k++)
        if (v->by[k].parameter != QDOT_NIL)
            QDOT_TRY(check_equations(v, e->whole, v->by[k].values, v->by[k].parameter));
    for (size_t i = 0; i < n * n; i++)
        e->M[i] = e->L[i] =
            qdot_variation_with_numbers(v, qdot_expr_arg(pool, M, (uint32_t)i));
    for (size_t i = 0; i < n; i++)
        e->f[i] = qdot_variation_with_numbers(v, qdot_expr_arg(pool, f, (uint32_t)i));
    QDOT_TRY(qdot_pool_check(pool));
    find_massless(e);
    status = factor_ldl(pool, n, e->L, &pivot);
    if (status == QDOT_ESINGULAR)
        return fail_singular(e, pivot, false);
    if (status == QDOT_OK)
        status = differentiate_massless_equations(e, &pivot);
    if (status == QDOT_ESINGULAR)
        return fail_undetermined(e, pivot);
    for (size_t c = 0; c < m && status == QDOT_OK; c++) {
        e->F[c] = qdot_variation_with_numbers(v, second_derivative(e, c));
        for (size_t i = 0; i < n; i++)
            e->A[c * n + i] = e->B[c * n + i] =
                qdot_diff(pool, e->F[c], qdot_variation_jet(v, i, 2));
        status = qdot_pool_check(pool);
        solve_ldl(pool, n, e->L, e->B + c * n);
    }
    for (size_t c = 0; c < m && status == QDOT_OK; c++)
        for (size_t d = 0; d < m; d++) {
            qdot_expr sum = QDOT_ZERO;

            for (size_t i = 0; i < n; i++)
                sum =
                    qdot_add(pool, sum, qdot_mul(pool, e->A[c * n + i], e->B[d * n + i]));
            e->S[c * m + d] = qdot_hold(pool, sum);
        }
    if (status == QDOT_OK && m > 0)
        status = factor_ldl(pool, m, e->S, &pivot);
    return status == QDOT_ESINGULAR ? fail_singular(e, pivot, true) : status;
}

/* Solve symbolically for q'' and lambda, by the factors of the matrices. */
static qdot_status
solve_motion(const elimination *e)
{
    qdot_variation *v = e->v;

    memcpy(v->a, e->f, e->n * sizeof *v->a);
    for (size_t c = 0; c < e->m + e->w; c++) {
        qdot_expr rest = e->F[c];

        for (size_t i = 0; i < e->n; i++) {
            const qdot_expr from = qdot_variation_jet(v, i, 2), to = QDOT_ZERO;

            rest = rest == QDOT_NIL ? rest : qdot_subs(e->pool, rest, 1, &from, &to);
        }
        e->z[c] = qdot_neg(e->pool, rest);
    }
    solve_with_constraints(e, v->a, e->z);
    memcpy(v->lambda, e->z, e->m * sizeof *v->lambda);
    return qdot_pool_check(e->pool);
}

/* --- derivatives of the equations -------------------------------------------------------- */

/* Find, into e->x and e->z, right-hand sides of the derivatives by z, a coordinate or a velocity. */
static void
derivatives_by_state(const elimination *e, qdot_expr z)
{
    qdot_pool *pool = e->pool;
    const qdot_variation *v = e->v;
    const size_t n = e->n;

    for (size_t i = 0; i < n; i++) {
        e->x[i] = qdot_diff(pool, e->f[i], z);
        for (size_t j = 0; j < n; j++)
            e->x[i] =
                qdot_sub(pool, e->x[i],
                         qdot_mul(pool, qdot_diff(pool, e->M[i * n + j], z), v->a[j]));
        for (size_t c = 0; c < e->m; c++)
            e->x[i] = qdot_add(
                pool, e->x[i],
                qdot_mul(pool, qdot_diff(pool, e->A[c * n + i], z), v->lambda[c]));
        e->x[i] = qdot_hold(pool, e->x[i]);
    }
    for (size_t c = 0; c < e->m + e->w; c++)
        e->z[c] = qdot_hold(pool, qdot_neg(pool, qdot_variation_with_motion(
                                                     v, qdot_diff(pool, e->F[c], z))));
}

/* Add to x and z the derivatives of the equations by the parameter of direction k. */
static void
add_derivatives_by_parameter(const elimination *e, size_t k, qdot_expr *x, qdot_expr *z)
{
    const qdot_variation *v = e->v;
    qdot_pool *pool = e->pool;
    const qdot_expr M = qdot_expr_arg(pool, e->whole, 0),
                    f = qdot_expr_arg(pool, e->whole, 1);
    const size_t n = e->n;

    for (size_t i = 0; i < n; i++) {
        x[i] = qdot_add(
            pool, x[i],
            qdot_variation_by_parameter(v, qdot_expr_arg(pool, f, (uint32_t)i), k));
        for (size_t j = 0; j < n; j++)
            x[i] = qdot_sub(
                pool, x[i],
                qdot_mul(pool,
                         qdot_variation_by_parameter(
                             v, qdot_expr_arg(pool, M, (uint32_t)(i * n + j)), k),
                         v->a[j]));
    }
    for (size_t c = 0; c < e->w; c++)
        z[e->m + c] = qdot_sub(pool, z[e->m + c],
                               qdot_variation_with_motion(v, qdot_variation_by_parameter(v, e->rate[c], k)));
    for (size_t c = 0; c < e->m; c++) {
        const qdot_expr F = second_derivative(e, c);

        z[c] =
            qdot_sub(pool, z[c],
                     qdot_variation_with_motion(v, qdot_variation_by_parameter(v, F, k)));
        for (size_t i = 0; i < n; i++)
            x[i] = qdot_add(
                pool, x[i],
                qdot_mul(pool,
                         qdot_variation_by_parameter(
                             v, qdot_diff(pool, F, qdot_variation_jet(v, i, 2)), k),
                         v->lambda[c]));
    }
}

/* Find y'' = d2/dt2 (dq/ds) for all directions of differentiation, b [k x n]. */
static qdot_status
solve_for_derivatives(const elimination *e, qdot_expr *b)
{
    const qdot_variation *v = e->v;
    qdot_pool *pool = e->pool;
    const size_t n = e->n, m = e->m + e->w;
    qdot_expr *mu = qdot_calloc(v->k * m + 1, sizeof *mu);

    if (!mu)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < v->k * n; i++)
        b[i] = QDOT_ZERO;
    for (size_t i = 0; i < v->k * m; i++)
        mu[i] = QDOT_ZERO;
    for (uint32_t order = 0; order < 2; order++)
        for (size_t j = 0; j < n && !qdot_pool_failed(pool); j++) {
            derivatives_by_state(e, qdot_variation_jet(v, j, order));
            for (size_t k = 0; k < v->k; k++) {
                const qdot_expr y = qdot_variation_slope_jet(v, k, j, order);

                for (size_t i = 0; i < n; i++)
                    b[k * n + i] =
                        qdot_add(pool, b[k * n + i], qdot_mul(pool, e->x[i], y));
                for (size_t c = 0; c < m; c++)
                    mu[k * m + c] =
                        qdot_add(pool, mu[k * m + c], qdot_mul(pool, e->z[c], y));
            }
        }
    for (size_t k = 0; k < v->k && !qdot_pool_failed(pool); k++) {
        if (v->by[k].parameter != QDOT_NIL)
            add_derivatives_by_parameter(e, k, b + k * n, mu + k * m);
        solve_with_constraints(e, b + k * n, mu + k * m);
    }
    qdot_free(mu);
    return qdot_pool_check(pool);
}

/* --- the whole variation ----------------------------------------------------------------- */

static qdot_status
name_derivative_coordinates(qdot_variation *v)
{
    for (size_t k = 0; k < v->k; k++)
        for (size_t i = 0; i < v->n; i++) {
            char name[200];

            snprintf(name, sizeof name, "d(%.80s)/d(%.80s)",
                     qdot_expr_symbol(v->of->pool, qdot_variation_jet(v, i, 0))->name,
                     v->by[k].name);
            v->y[k * v->n + i] = qdot_symbol_get(v->of->pool, QDOT_COORD, name);
        }
    return qdot_pool_check(v->of->pool);
}

static qdot_status
make_variation(elimination *e, qdot_expr *b)
{
    QDOT_TRY(name_derivative_coordinates(e->v));
    QDOT_TRY(refuse_unsuitable_scene(e->v->of));
    QDOT_TRY(derive_and_factor(e));
    QDOT_TRY(solve_motion(e));
    QDOT_TRY(solve_for_derivatives(e, b));
    e->v->n_massless = e->w;
    e->v->w = e->held ? e->w : 0;
    return qdot_variation_write(e->v, b);
}

qdot_status
qdot_variation_make(qdot_scene *scene, const qdot_run_request *request, size_t k,
                    const qdot_variation_by *by, bool held, qdot_variation *v)
{
    const size_t n = scene->coordinates.n, m = scene->constraints.n;
    elimination e = {.v = v, .pool = scene->pool, .n = n, .m = m, .held = held};
    qdot_expr *work = qdot_calloc(4 * n * n + 6 * n + 2 * m * n + m * m + 2 * m + k * n + 1, sizeof *work);
    qdot_status status = QDOT_ENOMEM;

    *v = (qdot_variation){
        .of = scene, .request = request, .n = n, .m = held ? m : 0, .k = k, .by = by};
    v->y = qdot_calloc(k * n + 1, sizeof *v->y);
    v->a = qdot_calloc(n + m + 1, sizeof *v->a);
    v->start = qdot_calloc(2 * (k + 1) * n + 1, sizeof *v->start);
    v->named = qdot_calloc(2 * (k + 1) * n + 1, sizeof *v->named);
    v->G = qdot_calloc(n + 1, sizeof *v->G);
    v->massless = qdot_calloc(n + 1, sizeof *v->massless);
    v->of_positions = qdot_calloc(n + 1, sizeof *v->of_positions);
    if (work && v->y && v->a && v->start && v->named && v->G && v->massless && v->of_positions) {
        v->lambda = v->a + n;
        e.M = work;
        e.L = e.M + n * n;
        e.f = e.L + n * n;
        e.x = e.f + n;
        e.F = e.x + n;
        e.z = e.F + m + n;
        e.A = e.z + m + n;
        e.B = e.A + (m + n) * n;
        e.S = e.B + m * n;
        e.rate = e.S + m * m;
        e.W = e.rate + n;
        status = make_variation(&e, e.W + n * n);
    }
    qdot_free(work);
    return status;
}
