/* first-order.c -- the motion near a state, to first order, with inputs. */
#include "mech/linear/first-order.h"
#include "mech/linear/first-order-parts.h"

#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"

qdot_expr
qdot_first_order_jet(const qdot_first_order_job *j, size_t i, uint32_t order)
{
    return qdot_mech_jet(j->s, j->own[i], order);
}

/* Input k: those of the scene, then its first-order unknowns, on which the motion depends in the same way. */
static qdot_expr
first_order_input(const qdot_first_order_job *j, size_t k)
{
    const size_t m = j->s->inputs.n;

    return k < m ? j->s->inputs.at[k] : j->s->states.at[k - m].z;
}

/* The force along coordinate i, with the rates of first-order unknowns in place of their velocities. */
static qdot_expr
force_along(const qdot_first_order_job *j, qdot_expr f, size_t i)
{
    return qdot_scene_with_rates(j->s, qdot_expr_arg(j->pool, f, (uint32_t)j->own[i]));
}

static qdot_expr
mass_entry(const qdot_first_order_job *j, qdot_expr M, size_t i, size_t k)
{
    return qdot_expr_arg(j->pool, M, (uint32_t)(j->own[i] * j->s->coordinates.n + j->own[k]));
}

qdot_expr *
qdot_first_order_new(size_t n)
{
    qdot_expr *e = qdot_calloc(n + 1, sizeof *e);

    for (size_t i = 0; i < n && e != NULL; i++)
        e[i] = QDOT_ZERO;
    return e;
}

/* --- the state ---------------------------------------------------------------------- */

/* The values of q and q' from the equations of the request; velocities that are not named are 0. */
static qdot_status
put_state(qdot_first_order_job *j, qdot_expr place)
{
    qdot_pool *pool = j->pool;

    for (uint32_t i = 0; i < qdot_expr_count(pool, place); i++) {
        const qdot_expr one = qdot_expr_arg(pool, place, i), symbol = qdot_expr_arg(pool, one, 0);

        if (!qdot_expr_is_class(pool, symbol, QDOT_MULTIPLIER))
            QDOT_TRY(qdot_state_values_put(&j->v, symbol, qdot_expr_arg(pool, one, 1)));
    }
    if (j->speeds != NULL)
        QDOT_TRY(qdot_first_order_put_velocities(j));
    for (size_t i = 0; i < j->n; i++)
        QDOT_TRY(qdot_state_values_put(&j->v, qdot_first_order_jet(j, i, 1), QDOT_ZERO));
    for (size_t i = 0; i < j->s->inputs.n; i++)
        QDOT_TRY(qdot_state_values_put(&j->v, j->s->inputs.at[i], QDOT_ZERO));
    return qdot_pool_check(pool);
}

/* --- constraints -------------------------------------------------------------------- */

/* Constraint k on the level of jets of that order: differentiated until its highest derivative is of the order. */
static qdot_expr
constraint_on_level(const qdot_first_order_job *j, size_t k, int order)
{
    qdot_expr f = j->s->constraints.at[k].f;

    for (int i = j->s->constraints.at[k].kind; i < order; i++)
        f = qdot_ddt(j->pool, f);
    return f;
}

/* Fail because the state does not fulfil constraint k, or its time derivative, off by `left`. In symbols that may depend on
 * the parameters: then numbers must tell. */
static qdot_status
report_unmet(const qdot_first_order_job *j, size_t k, int order, qdot_expr left)
{
    const qdot_constraint *c = &j->s->constraints.at[k];

    if (!j->v.x.numbers && (qdot_expr_sign(j->pool, left) & QDOT_NE0) == 0)
        return qdot_fail(QDOT_ELIMIT, "constraint %.100s holds there for some values only", c->name);
    return qdot_fail(QDOT_EINVAL, "the state does not fulfil constraint %.100s%s", c->name,
                     order > (int)c->kind ? " with these velocities" : "");
}

/* A row of constraint k on a level: its slopes, and what it is without the jets of the level. */
static qdot_status
constraint_row(qdot_first_order_job *j, size_t k, int order, qdot_expr *row)
{
    const size_t n = j->n;
    const qdot_expr f = constraint_on_level(j, k, order);
    const qdot_expr rest = order == 2 ? qdot_mech_at_rest(j->s, f) : f;

    for (int o = order, at = 0; o >= 0; o--, at++)
        for (size_t i = 0; i < n; i++)
            row[(size_t)at * n + i] = o < 2 && order == 2 && !j->accelerated
                                          ? QDOT_ZERO
                                          : qdot_diff(j->pool, f, qdot_first_order_jet(j, i, (uint32_t)o));
    row[(size_t)(order + 1) * n] = rest;
    return qdot_state_values_of(&j->v, (size_t)(order + 1) * n + 1, row);
}

/* Whether what a repeated constraint leaves, `row` over the jets below the level, changes with the motion. */
static bool
repetition_moves(qdot_first_order_job *j, int order, const qdot_expr *row)
{
    const size_t n = j->n;

    for (size_t a = 0; a < j->width; a++) {
        qdot_expr sum = a + 1 == j->width && order == 2 ? row[(size_t)(order + 1) * n] : QDOT_ZERO;

        for (int o = order - 1, at = 1; o >= 0; o--, at++)
            for (size_t i = 0; i < n; i++)
                sum = qdot_add(j->pool, sum,
                               qdot_mul(j->pool, row[(size_t)at * n + i], j->change[o][i * j->width + a]));
        sum = qdot_elimination_short(&j->v.x, sum);
        if (sum != QDOT_NIL && !qdot_elimination_is_zero(&j->v.x, sum) &&
            (!j->v.x.numbers || fabs(fmpq_get_d(qdot_expr_rational(j->pool, sum))) > 1e-8))
            return true;
    }
    return false;
}

/* Write the changes of the jets of a level: of independent ones the column given by *first and counted up, of dependent
 * ones what the rows of the level make of the others. */
static qdot_status
write_changes(qdot_first_order_job *j, int order, size_t *first)
{
    const qdot_echelon *e = &j->level[order];
    const size_t n = j->n, width = j->width;
    qdot_expr *change = j->change[order];

    for (size_t i = 0; i < n && first != NULL; i++)
        if (!qdot_echelon_leads(e, i))
            change[i * width + (*first)++] = QDOT_ONE;
    for (size_t r = 0; r < e->rank; r++) {
        const qdot_expr *row = e->row + r * e->width;
        qdot_expr *own = change + e->pivot[r] * width;

        for (size_t a = 0; a < width; a++) {
            qdot_expr sum = a + 1 == width && order == 2 ? qdot_neg(j->pool, row[(size_t)(order + 1) * n]) : QDOT_ZERO;

            for (size_t i = 0; i < n; i++)
                if (i != e->pivot[r])
                    sum = qdot_sub(j->pool, sum, qdot_mul(j->pool, row[i], change[i * width + a]));
            for (int o = order - 1, at = 1; o >= 0; o--, at++)
                for (size_t i = 0; i < n; i++)
                    sum = qdot_sub(j->pool, sum,
                                   qdot_mul(j->pool, row[(size_t)at * n + i], j->change[o][i * width + a]));
            own[a] = qdot_elimination_short(&j->v.x, sum);
        }
    }
    return qdot_pool_check(j->pool);
}

/* Bring the constraints that act on a level into echelon form; a repeated one must hold along the others. */
static qdot_status
reduce_level(qdot_first_order_job *j, int order)
{
    const size_t n = j->n, width = (size_t)(order + 1) * n + 1;
    qdot_expr *row = qdot_first_order_new(width);
    qdot_status status = row == NULL ? QDOT_ENOMEM : qdot_echelon_begin(&j->level[order], j->c, n, width);

    for (size_t i = 0; i < j->c && status == QDOT_OK; i++) {
        const size_t k = j->order[i];
        bool independent = true;

        if ((int)j->s->constraints.at[k].kind > order)
            continue;
        status = constraint_row(j, k, order, row);
        if (status == QDOT_OK && order < 2) {
            const qdot_expr left = row[width - 1];

            if (!qdot_elimination_is_zero(&j->v.x, left) &&
                (!j->v.x.numbers || fabs(fmpq_get_d(qdot_expr_rational(j->pool, left))) > 1e-6))
                status = report_unmet(j, k, order, left);
            row[width - 1] = QDOT_ZERO;
        }
        if (status == QDOT_OK)
            status = qdot_echelon_add(&j->v.x, &j->level[order], row, &independent);
        if (status == QDOT_OK && !independent && (order < 2 || j->accelerated) && repetition_moves(j, order, row))
            status = qdot_fail(QDOT_ESINGULAR,
                               "constraint %.100s is singular there: its slopes are those of other constraints, but it is "
                               "none of them",
                               j->s->constraints.at[k].name);
        j->kept[k] = independent;
    }
    qdot_free(row);
    return status == QDOT_OK ? qdot_pool_check(j->pool) : status;
}

/* --- equations of motion ------------------------------------------------------------- */

/* The sum of X[i] change[i] over the n coordinates, of columns a. */
qdot_expr
qdot_first_order_along(const qdot_first_order_job *j, const qdot_expr *X, const qdot_expr *change, size_t a)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < j->n; i++)
        if (X[i] != QDOT_ZERO && change[i * j->width + a] != QDOT_ZERO)
            sum = qdot_add(j->pool, sum, qdot_mul(j->pool, X[i], change[i * j->width + a]));
    return sum;
}

void
qdot_first_order_slopes(const qdot_first_order_job *j, qdot_expr e, qdot_expr *slope)
{
    const size_t n = j->n;

    for (size_t k = 0; k < 2 * n + j->inputs; k++)
        slope[k] = qdot_diff(j->pool, e, k < 2 * n ? qdot_first_order_jet(j, k % n, k < n ? 0 : 1)
                                                   : first_order_input(j, k - 2 * n));
}

qdot_expr
qdot_first_order_change(qdot_first_order_job *j, const qdot_expr *slope, size_t a)
{
    const size_t state = j->y + j->z;
    qdot_expr sum = qdot_add(j->pool, qdot_first_order_along(j, slope, j->change[0], a), qdot_first_order_along(j, slope + j->n, j->change[1], a));

    if (a >= state)
        sum = qdot_add(j->pool, sum, slope[2 * j->n + a - state]);
    return qdot_elimination_short(&j->v.x, sum);
}

qdot_status
qdot_first_order_solve(qdot_first_order_job *j, size_t n, const qdot_expr *A, size_t columns, qdot_expr *X)
{
    qdot_echelon e;
    qdot_expr *row = qdot_first_order_new(n + columns);
    qdot_status status = row == NULL ? QDOT_ENOMEM : qdot_echelon_begin(&e, n, n, n + columns);

    if (row == NULL)
        return status;
    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        bool independent;

        for (size_t k = 0; k < n; k++)
            row[k] = A[i * n + k];
        for (size_t k = 0; k < columns; k++)
            row[n + k] = X[i * columns + k];
        status = qdot_echelon_add(&j->v.x, &e, row, &independent);
        if (status == QDOT_OK && !independent)
            status = QDOT_ESINGULAR;
    }
    for (size_t r = 0; r < n && status == QDOT_OK; r++)
        for (size_t k = 0; k < columns; k++)
            X[e.pivot[r] * columns + k] = e.row[r * e.width + n + k];
    qdot_echelon_end(&e);
    qdot_free(row);
    return status;
}

/* From the changes of q'' without its independent part, and F [n x width], the changes of all other terms of
 * M q'' - f - G^T lambda: the independent accelerations, into the changes of q''. */
static qdot_status
solve_accelerations(qdot_first_order_job *j, const qdot_expr *F, size_t from, size_t to)
{
    const qdot_echelon *e = &j->level[2];
    const size_t n = j->n, m = n - e->rank, columns = to - from, width = j->width;
    qdot_expr *N = qdot_first_order_new(n * m), *MN = qdot_first_order_new(n * m), *A = qdot_first_order_new(m * m),
              *X = qdot_first_order_new(m * columns);
    qdot_status status = N == NULL || MN == NULL || A == NULL || X == NULL ? QDOT_ENOMEM : QDOT_OK;

    if (status == QDOT_OK)
        qdot_echelon_null_space(j->pool, e, N); /* Na: a column for each independent acceleration */
    for (size_t i = 0; i < n * m && status == QDOT_OK; i++) {
        qdot_expr sum = QDOT_ZERO;

        for (size_t k = 0; k < n; k++)
            sum = qdot_add(j->pool, sum, qdot_mul(j->pool, j->M[i / m * n + k], N[k * m + i % m]));
        MN[i] = qdot_elimination_short(&j->v.x, sum);
    }
    for (size_t i = 0; i < m && status == QDOT_OK; i++) {
        for (size_t k = 0; k < m; k++) {
            qdot_expr sum = QDOT_ZERO;

            for (size_t h = 0; h < n; h++)
                sum = qdot_add(j->pool, sum, qdot_mul(j->pool, N[h * m + i], MN[h * m + k]));
            A[i * m + k] = qdot_elimination_short(&j->v.x, sum);
        }
        for (size_t k = 0; k < columns; k++) {
            qdot_expr sum = QDOT_ZERO;

            for (size_t h = 0; h < n; h++)
                sum = qdot_sub(j->pool, sum,
                               qdot_mul(j->pool, N[h * m + i],
                                        qdot_add(j->pool, F[h * width + from + k],
                                                 qdot_first_order_along(j, j->M + h * n, j->change[2], from + k))));
            X[i * columns + k] = qdot_elimination_short(&j->v.x, sum);
        }
        status = qdot_pool_check(j->pool);
    }
    if (status == QDOT_OK && m > 0)
        status = qdot_first_order_solve(j, m, A, columns, X);
    if (status == QDOT_ESINGULAR)
        status = qdot_fail(QDOT_ESINGULAR, "the mass matrix is singular there: something moves without mass");
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        for (size_t k = 0; k < columns; k++) {
            qdot_expr *own = &j->change[2][i * width + from + k], sum = *own;

            for (size_t b = 0; b < m; b++)
                sum = qdot_add(j->pool, sum, qdot_mul(j->pool, N[i * m + b], X[b * columns + k]));
            *own = qdot_elimination_short(&j->v.x, sum);
        }
    qdot_free(N);
    qdot_free(MN);
    qdot_free(A);
    qdot_free(X);
    return status == QDOT_OK ? qdot_pool_check(j->pool) : status;
}

/* The multipliers of the constraints that are kept, from G^T lambda = M dq'' + F; G [c x n]. */
static qdot_status
solve_multipliers(qdot_first_order_job *j, const qdot_expr *G, const qdot_expr *F, size_t from, size_t to)
{
    const qdot_echelon *e = &j->level[2];
    const size_t n = j->n, r = e->rank, columns = to - from;
    qdot_expr *A = qdot_first_order_new(r * r), *X = qdot_first_order_new(r * columns);
    size_t *which = qdot_calloc(r + 1, sizeof *which), at = 0;
    qdot_status status = A == NULL || X == NULL || which == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < j->c && status == QDOT_OK; i++)
        if (j->kept[j->order[i]])
            which[at++] = j->order[i];
    for (size_t i = 0; i < r && status == QDOT_OK; i++) {
        const size_t row = e->pivot[i];

        for (size_t k = 0; k < r; k++)
            A[i * r + k] = G[which[k] * n + row];
        for (size_t k = 0; k < columns; k++)
            X[i * columns + k] = qdot_elimination_short(
                &j->v.x, qdot_add(j->pool, F[row * j->width + from + k],
                                  qdot_first_order_along(j, j->M + row * n, j->change[2], from + k)));
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(j->pool);
    if (status == QDOT_OK && r > 0)
        status = qdot_first_order_solve(j, r, A, columns, X);
    for (size_t k = 0; k < r && status == QDOT_OK; k++)
        for (size_t a = 0; a < columns; a++)
            j->lambda[which[k] * j->width + from + a] = X[k * columns + a];
    qdot_free(A);
    qdot_free(X);
    qdot_free(which);
    return status == QDOT_ESINGULAR ? qdot_fail(status, "the constraints are singular there") : status;
}

/* The slope of constraint k that multiplies its multiplier in the equation of coordinate i. */
static qdot_expr
multiplied_slope(const qdot_first_order_job *j, size_t k, size_t i)
{
    const qdot_constraint *c = &j->s->constraints.at[k];

    return qdot_diff(j->pool, c->f, qdot_first_order_jet(j, i, (uint32_t)c->kind));
}

/* M q'' - f - G^T lambda of coordinate i, with symbols for q'' and lambda. */
static qdot_expr
residual_of_motion(const qdot_first_order_job *j, qdot_expr M, qdot_expr f, size_t i)
{
    qdot_pool *pool = j->pool;
    qdot_expr sum = qdot_neg(pool, force_along(j, f, i));

    for (size_t k = 0; k < j->n; k++)
        sum = qdot_add(pool, sum, qdot_mul(pool, mass_entry(j, M, i, k),
                                           qdot_first_order_jet(j, k, 2)));
    for (size_t k = 0; k < j->c; k++)
        sum = qdot_sub(pool, sum, qdot_mul(pool, multiplied_slope(j, k, i), j->s->constraints.at[k].multiplier));
    return sum;
}

/* q'' and lambda at the state: the last column. They become values. */
static qdot_status
find_accelerations_at_state(qdot_first_order_job *j, qdot_expr f, const qdot_expr *G)
{
    const size_t last = j->width - 1;
    qdot_expr *F = qdot_first_order_new(j->n * j->width), *f0 = qdot_first_order_new(j->n);
    qdot_status status = F == NULL || f0 == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < j->n && status == QDOT_OK; i++)
        f0[i] = qdot_neg(j->pool, force_along(j, f, i));
    if (status == QDOT_OK)
        status = qdot_state_values_of(&j->v, j->n, f0);
    for (size_t i = 0; i < j->n && status == QDOT_OK; i++)
        F[i * j->width + last] = f0[i];
    if (status == QDOT_OK)
        status = solve_accelerations(j, F, last, j->width);
    if (status == QDOT_OK)
        status = solve_multipliers(j, G, F, last, j->width);
    for (size_t i = 0; i < j->n && status == QDOT_OK; i++)
        status = qdot_state_values_put(&j->v, qdot_first_order_jet(j, i, 2), j->change[2][i * j->width + last]);
    for (size_t k = 0; k < j->c && status == QDOT_OK; k++)
        status = qdot_state_values_put(&j->v, j->s->constraints.at[k].multiplier, j->lambda[k * j->width + last]);
    qdot_free(F);
    qdot_free(f0);
    return status;
}

/* The changes of q'' and lambda with state and inputs. */
static qdot_status
find_changes(qdot_first_order_job *j, qdot_expr M, qdot_expr f, const qdot_expr *G)
{
    const size_t n = j->n, moving = 2 * n + j->inputs, last = j->y + j->z + j->inputs;
    qdot_expr *slope = qdot_first_order_new(n * moving), *F = qdot_first_order_new(n * j->width);
    qdot_status status = slope == NULL || F == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < n && status == QDOT_OK; i++) {
        const qdot_expr residual = residual_of_motion(j, M, f, i);

        qdot_first_order_slopes(j, residual, slope + i * moving);
        status = qdot_pool_check(j->pool);
    }
    if (status == QDOT_OK)
        status = qdot_state_values_of(&j->v, n * moving, slope);
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        for (size_t a = 0; a < last; a++)
            F[i * j->width + a] = qdot_first_order_change(j, slope + i * moving, a);
    if (status == QDOT_OK)
        status = qdot_pool_check(j->pool);
    if (status == QDOT_OK)
        status = solve_accelerations(j, F, 0, last);
    if (status == QDOT_OK)
        status = solve_multipliers(j, G, F, 0, last);
    qdot_free(slope);
    qdot_free(F);
    return status;
}

/* --- all of it ------------------------------------------------------------------------- */

/* The level of accelerations anew, as q'' at the state is known now. */
static qdot_status
reduce_accelerations_again(qdot_first_order_job *j)
{
    j->accelerated = true;
    if (j->c == 0)
        return QDOT_OK;
    qdot_echelon_end(&j->level[2]);
    for (size_t i = 0; i < j->n * j->width; i++)
        j->change[2][i] = QDOT_ZERO;
    QDOT_TRY(reduce_level(j, 2));
    return write_changes(j, 2, NULL);
}

/* The independent jets: positions and velocities. */
static qdot_status
reduce_constraints(qdot_first_order_job *j)
{
    size_t first = 0;

    for (int order = 0; order < 3; order++) {
        QDOT_TRY(reduce_level(j, order));
        QDOT_TRY(write_changes(j, order, order < 2 ? &first : NULL));
        if (order == 0)
            j->y = first;
        if (order == 1)
            j->z = first - j->y;
    }
    return QDOT_OK;
}

static qdot_status
linearise(qdot_first_order_job *j)
{
    const size_t n = j->n;
    const qdot_expr M = qdot_released(j->pool, qdot_mech_numeric_mass(j->s)), f = qdot_released(j->pool, qdot_mech_numeric_forcing(j->s));
    qdot_expr *G = qdot_first_order_new(j->c * n);
    qdot_status status = G == NULL ? QDOT_ENOMEM : qdot_pool_check(j->pool);

    if (status == QDOT_OK && (qdot_mech_holds(j->s, f) & QDOT_HAS_MULTIPLIER) != 0)
        status = qdot_fail(QDOT_ETYPE, "not built yet: the linear motion with forces that depend on multipliers");
    if (status == QDOT_OK)
        status = reduce_constraints(j);
    if (status == QDOT_OK) {
        j->lambda = qdot_first_order_new(j->c * j->width);
        for (size_t i = 0; i < n * n; i++)
            j->M[i] = mass_entry(j, M, i / n, i % n);
        for (size_t i = 0; i < j->c * n; i++)
            G[i] = multiplied_slope(j, i / n, i % n);
        status = j->lambda == NULL ? QDOT_ENOMEM : qdot_state_values_of(&j->v, n * n, j->M);
    }
    if (status == QDOT_OK)
        status = qdot_state_values_of(&j->v, j->c * n, G);
    if (status == QDOT_OK)
        status = find_accelerations_at_state(j, f, G);
    if (status == QDOT_OK)
        status = reduce_accelerations_again(j);
    if (status == QDOT_OK)
        status = find_changes(j, M, f, G);
    if (status == QDOT_OK && j->speeds != NULL)
        status = qdot_first_order_turn_to_speeds(j);
    qdot_free(G);
    return status;
}

void
qdot_first_order_clear(qdot_first_order *x)
{
    qdot_free(x->state);
    qdot_free(x->symbol);
    qdot_free(x->change);
    *x = (qdot_first_order){0};
}

qdot_status
qdot_first_order_about(qdot_scene *s, const qdot_first_order_request *request, qdot_first_order *out)
{
    qdot_first_order_job j = {.s = s, .pool = s->pool, .c = s->constraints.n, .inputs = s->inputs.n + s->states.n,
             .speeds = request->speeds,
             .own = qdot_calloc(s->coordinates.n + 1, sizeof *j.own)};
    qdot_status status;
    size_t at = 0;

    *out = (qdot_first_order){0};
    if (j.own == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < s->coordinates.n; i++)
        if (qdot_scene_state_of(s, s->coordinates.at[i]) == NULL)
            j.own[j.n++] = i;
    j.width = 2 * j.n + j.inputs + 1;
    j.order = qdot_calloc(j.c + 1, sizeof *j.order);
    j.kept = qdot_calloc(j.c + 1, sizeof *j.kept);
    j.M = qdot_first_order_new(j.n * j.n);
    for (int i = 0; i < 3; i++)
        j.change[i] = qdot_first_order_new(j.n * j.width);
    qdot_state_values_begin(&j.v, s, request->numbers, request->bind, request->user);
    status = j.order == NULL || j.kept == NULL || j.M == NULL || j.change[0] == NULL || j.change[1] == NULL ||
                     j.change[2] == NULL
                 ? QDOT_ENOMEM
                 : put_state(&j, request->place);
    for (int kind = QDOT_HOLONOMIC; kind <= QDOT_ACCELERATION && status == QDOT_OK; kind++)
        for (size_t k = 0; k < j.c; k++)
            if ((int)s->constraints.at[k].kind == kind)
                j.order[at++] = k;
    if (status == QDOT_OK)
        status = linearise(&j);
    if (status == QDOT_OK)
        status = qdot_first_order_write(&j, out);
    for (int i = 0; i < 3; i++) {
        qdot_echelon_end(&j.level[i]);
        qdot_free(j.change[i]);
    }
    qdot_state_values_end(&j.v);
    qdot_free(j.own);
    qdot_free(j.order);
    qdot_free(j.kept);
    qdot_free(j.M);
    qdot_free(j.lambda);
    qdot_free(j.rates);
    if (status != QDOT_OK)
        qdot_first_order_clear(out);
    return status;
}
