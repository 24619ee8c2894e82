/* first-order-speeds.c -- speeds as the state of the motion near a state, in place of independent velocities. */
#include "mech/linear/first-order-parts.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "mech/scene/scene.h"

/* --- velocities at the state --------------------------------------------------------- */

/* Solve the equations of the velocities, A q' = b with the values of the state, and put q'. */
static qdot_status
solve_velocities(qdot_first_order_job *j, qdot_expr *A)
{
    const size_t N = j->s->coordinates.n;
    qdot_expr *b = A + N * N;
    qdot_status status;

    QDOT_TRY(qdot_speeds_rows(j->s, j->speeds, A, b));
    QDOT_TRY(qdot_state_values_of(&j->v, N * N + N, A));
    status = qdot_first_order_solve(j, N, A, 1, b);
    if (status == QDOT_ESINGULAR)
        return qdot_fail(QDOT_ESINGULAR, "the speeds do not determine the velocities there");
    for (size_t i = 0; i < j->n && status == QDOT_OK; i++)
        status = qdot_state_values_put(&j->v, qdot_first_order_jet(j, i, 1), b[j->own[i]]);
    return status;
}

qdot_status
qdot_first_order_put_velocities(qdot_first_order_job *j)
{
    const size_t N = j->s->coordinates.n;
    qdot_expr *A = NULL;
    bool given = false;
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < j->speeds->n; k++)
        given = given || qdot_expr_place(j->v.symbols.n, j->v.symbols.at, j->speeds->symbol[k]) < j->v.symbols.n;
    if (!given)
        return QDOT_OK;
    for (size_t k = 0; k < j->speeds->n && status == QDOT_OK; k++)
        status = qdot_state_values_put(&j->v, j->speeds->symbol[k], QDOT_ZERO);
    if (status == QDOT_OK) {
        A = qdot_first_order_new(N * N + N);
        status = A == NULL ? QDOT_ENOMEM : solve_velocities(j, A);
    }
    qdot_free(A);
    return status;
}

/* --- speeds as states ---------------------------------------------------------------- */

/* How e, of q, q' and with q'' of q'', changes: row [width]. */
static qdot_status
find_change(qdot_first_order_job *j, qdot_expr e, qdot_expr *row)
{
    const size_t n = j->n, moving = 2 * n + j->inputs;
    qdot_expr *slope = qdot_first_order_new(moving + n);
    qdot_status status = slope == NULL ? QDOT_ENOMEM : QDOT_OK;

    if (status == QDOT_OK) {
        qdot_first_order_slopes(j, e, slope);
        for (size_t i = 0; i < n; i++)
            slope[moving + i] = qdot_diff(j->pool, e, qdot_first_order_jet(j, i, 2));
        status = qdot_pool_check(j->pool);
    }
    if (status == QDOT_OK)
        status = qdot_state_values_of(&j->v, moving + n, slope);
    for (size_t a = 0; a < j->y + j->z + j->inputs && status == QDOT_OK; a++)
        row[a] = qdot_elimination_short(&j->v.x, qdot_add(j->pool, qdot_first_order_change(j, slope, a),
                                                          qdot_first_order_along(j, slope + moving, j->change[2], a)));
    qdot_free(slope);
    return status == QDOT_OK ? qdot_pool_check(j->pool) : status;
}

/* The independent velocities z from du = S z + P (others): z = S^-1 (du - P others), z [m x last], where du has the columns
 * that were those of z; z holds the rows of du. */
static qdot_status
solve_for_velocities(qdot_first_order_job *j, size_t last, qdot_expr *z)
{
    const size_t m = j->z;
    qdot_expr *S = qdot_first_order_new(m * m);
    qdot_status status = S == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < m && status == QDOT_OK; i++)
        for (size_t a = 0; a < last; a++) {
            const bool own = a >= j->y && a < j->y + m;

            if (own)
                S[i * m + a - j->y] = z[i * last + a];
            z[i * last + a] = own ? (a - j->y == i ? QDOT_ONE : QDOT_ZERO) : qdot_neg(j->pool, z[i * last + a]);
        }
    if (status == QDOT_OK)
        status = qdot_first_order_solve(j, m, S, last, z);
    if (status == QDOT_ESINGULAR)
        status = qdot_fail(QDOT_ESINGULAR, "the speeds do not determine the velocities there");
    qdot_free(S);
    return status;
}

/* Write rows, each [width], over the new columns. */
static qdot_status
change_columns(qdot_first_order_job *j, size_t last, const qdot_expr *z, size_t rows, qdot_expr *row)
{
    const size_t m = j->z;
    qdot_expr *old = qdot_first_order_new(m);

    if (old == NULL)
        return QDOT_ENOMEM;
    for (size_t r = 0; r < rows; r++, row += j->width) {
        for (size_t k = 0; k < m; k++) {
            old[k] = row[j->y + k];
            row[j->y + k] = QDOT_ZERO;
        }
        for (size_t a = 0; a < last; a++) {
            qdot_expr sum = row[a];

            for (size_t k = 0; k < m; k++)
                if (old[k] != QDOT_ZERO && z[k * last + a] != QDOT_ZERO)
                    sum = qdot_add(j->pool, sum, qdot_mul(j->pool, old[k], z[k * last + a]));
            row[a] = qdot_elimination_short(&j->v.x, sum);
        }
    }
    qdot_free(old);
    return qdot_pool_check(j->pool);
}

/* The rows of du and, behind them, of du' = d(dE/dt), over the columns so far. */
static qdot_status
find_changes_of_speeds(qdot_first_order_job *j, size_t last, qdot_expr *z)
{
    qdot_expr *row = qdot_first_order_new(j->width);
    qdot_status status = row == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t k = 0; k < j->z && status == QDOT_OK; k++) {
        const qdot_expr E = j->speeds->value[k];

        for (size_t i = 0; i < j->s->inputs.n && status == QDOT_OK; i++)
            if (qdot_expr_contains(j->pool, E, j->s->inputs.at[i]))
                status = qdot_fail(QDOT_ENOTBUILT, "not built yet: the linear motion in a speed that holds the input %.100s",
                                   qdot_expr_symbol(j->pool, j->s->inputs.at[i])->name);
        if (status == QDOT_OK)
            status = find_change(j, E, row);
        for (size_t a = 0; a < last && status == QDOT_OK; a++)
            z[k * last + a] = row[a];
        if (status == QDOT_OK)
            status = find_change(j, qdot_scene_with_rates(j->s, qdot_ddt(j->pool, E)), j->rates + k * j->width);
    }
    qdot_free(row);
    return status;
}

qdot_status
qdot_first_order_turn_to_speeds(qdot_first_order_job *j)
{
    const size_t last = j->y + j->z + j->inputs;
    qdot_expr *z;
    qdot_status status;

    if (j->speeds->n != j->z)
        return qdot_fail(QDOT_EINVAL, "the speeds are %zu, and %zu velocities are independent there", j->speeds->n, j->z);
    z = qdot_first_order_new(j->z * last);
    j->rates = qdot_first_order_new(j->z * j->width);
    status = z == NULL || j->rates == NULL ? QDOT_ENOMEM : find_changes_of_speeds(j, last, z);
    if (status == QDOT_OK)
        status = solve_for_velocities(j, last, z);
    for (int order = 0; order < 3 && status == QDOT_OK; order++)
        status = change_columns(j, last, z, j->n, j->change[order]);
    if (status == QDOT_OK)
        status = change_columns(j, last, z, j->c, j->lambda);
    if (status == QDOT_OK)
        status = change_columns(j, last, z, j->z, j->rates);
    qdot_free(z);
    return status;
}
