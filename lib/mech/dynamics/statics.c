/* statics.c -- scenes without masses. */
#include "mech/dynamics/statics.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "mech/dynamics/virtual-work.h"
#include "mech/scene/access.h"
#include "mech/scene/constraint.h"
#include "normal/solve/linear.h"

bool
qdot_statics_applies(const qdot_scene *s)
{
    return s->particles.n == 0 && s->bodies.n == 0 && !qdot_mech_stated(s);
}

bool
qdot_statics_acts(const qdot_scene *s)
{
    return s->forces.n + s->torques.n + s->springs.n + s->potentials.n + s->constraints.n + s->dampers.n +
               s->dissipations.n > 0;
}

/* Fail unless there are as many constraints, all of positions, as coordinates. */
static bool
needs_determinate(qdot_scene *s, size_t k)
{
    const size_t n = s->coordinates.n, m = s->constraints.n;
    const char *name = s->constraints.at[k].name;

    for (size_t i = 0; i < m; i++)
        if (s->constraints.at[i].kind != QDOT_HOLONOMIC) {
            qdot_mech_fail(s, QDOT_EINVAL, "lambda[%.200s] has no value: constraint %.200s is not one of positions, and nothing "
                           "has mass", name, s->constraints.at[i].name);
            return false;
        }
    if (m > n) {
        qdot_fail(QDOT_EINVAL, "lambda[%.200s] is not determined: statically indeterminate, %zu constraints for %zu "
                  "coordinate%s", name, m, n, n == 1 ? "" : "s");
        qdot_hint("elastic bars are springs: spring between A, B stiffness k rest L");
        qdot_pool_fail(s->pool);
    } else if (m < n) {
        qdot_fail(QDOT_EINVAL, "lambda[%.200s] has a value at an equilibrium only: nothing has mass, and the constraints "
                  "leave freedom to move", name);
        qdot_hint("`equilibria` lists the multipliers too");
        qdot_pool_fail(s->pool);
    }
    return m == n;
}

/* The equations of equilibrium A lambda = b, solved part by part: those of one joint often hold two unknown forces, which
 * then are known at the next joint. */
typedef struct {
    qdot_scene *s;
    size_t n;
    qdot_expr *A, *b, *lambda;      /* [n*n], [n], [n]; lambda is nil while unknown */
    bool *used, *row, *column;      /* [n] equations that are used; the part at hand */
    bool *best_row, *best_column;   /* [n] the smallest part found */
} joints;

/* The number of unknown multipliers in equation i that are not in the part. */
static size_t
unknowns_outside(const joints *j, size_t i)
{
    size_t count = 0;

    for (size_t k = 0; k < j->n; k++)
        count += j->A[i * j->n + k] != QDOT_ZERO && j->lambda[k] == QDOT_NIL && !j->column[k];
    return count;
}

/* Take equation i into the part, with its unknowns; their number. */
static size_t
take_equation(joints *j, size_t i)
{
    size_t taken = 0;

    j->row[i] = true;
    for (size_t k = 0; k < j->n; k++)
        if (j->A[i * j->n + k] != QDOT_ZERO && j->lambda[k] == QDOT_NIL && !j->column[k]) {
            j->column[k] = true;
            taken++;
        }
    return taken;
}

/* A part that begins with equation i: the equation that brings fewest unknowns is added until they are as many. The
 * number of its equations; n + 1: there is none. */
static size_t
part_from(joints *j, size_t i)
{
    size_t rows = 1, columns;

    memset(j->row, 0, j->n * sizeof *j->row);
    memset(j->column, 0, j->n * sizeof *j->column);
    columns = take_equation(j, i);
    while (rows < columns) {
        size_t next = j->n, least = j->n + 1;

        for (size_t r = 0; r < j->n; r++)
            if (!j->used[r] && !j->row[r] && unknowns_outside(j, r) < least)
                least = unknowns_outside(j, next = r);
        if (next == j->n)
            return j->n + 1;
        columns += take_equation(j, next);
        rows++;
    }
    return rows == columns ? rows : j->n + 1;
}

/* Solve the part best_row, best_column of m equations; earlier multipliers stand in it as symbols and are put in at the end. */
static qdot_status
solve_part(joints *j, size_t m)
{
    qdot_scene *s = j->s;
    qdot_pool *pool = s->pool;
    const qdot_facts facts = qdot_scene_facts(s);
    qdot_expr *A = qdot_calloc(m * m + 2 * m + 2 * j->n, sizeof *A), *b = A + m * m, *x = b + m, *from = x + m;
    size_t row = 0, known = 0, at = 0;
    uint32_t pivot = 0;
    qdot_status status;

    if (A == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < j->n; k++)
        if (j->lambda[k] != QDOT_NIL) {
            from[known] = s->constraints.at[k].multiplier;
            from[j->n + known++] = j->lambda[k];
        }
    for (size_t i = 0; i < j->n; i++) {
        if (!j->best_row[i])
            continue;
        j->used[i] = true;
        b[row] = j->b[i];
        for (size_t k = 0; k < j->n; k++) {
            const qdot_expr entry = j->A[i * j->n + k];

            if (j->best_column[k])
                A[at++] = entry;
            else if (entry != QDOT_ZERO)
                b[row] = qdot_sub(pool, b[row], qdot_mul(pool, entry, s->constraints.at[k].multiplier));
        }
        row++;
    }
    status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = qdot_solve_linear(pool, (uint32_t)m, A, b, x, &pivot, &facts);
    for (size_t k = 0, to = 0; k < j->n && status == QDOT_OK; k++)
        if (j->best_column[k])
            j->lambda[k] = qdot_mech_tidy(s, qdot_subs(pool, x[to++], known, from, from + j->n));
    qdot_free(A);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* Solve part after part, a smallest one each time, until multiplier k is known. */
static qdot_status
solve_joints(joints *j, size_t k)
{
    while (j->lambda[k] == QDOT_NIL) {
        size_t least = j->n + 1;

        for (size_t i = 0; i < j->n; i++) {
            const size_t m = j->used[i] ? j->n + 1 : part_from(j, i);

            if (m >= least)
                continue;
            least = m;
            memcpy(j->best_row, j->row, j->n * sizeof *j->row);
            memcpy(j->best_column, j->column, j->n * sizeof *j->column);
        }
        if (least > j->n)
            return qdot_fail(QDOT_ESINGULAR, "constraints repeat each other");
        QDOT_TRY(solve_part(j, least));
    }
    return QDOT_OK;
}

qdot_expr
qdot_statics_multiplier(qdot_scene *s, size_t k)
{
    qdot_pool *pool = s->pool;
    const size_t n = s->coordinates.n;
    joints j = {.s = s, .n = n};
    qdot_expr value = QDOT_NIL;
    qdot_status status = QDOT_ENOMEM;

    if (!needs_determinate(s, k))
        return QDOT_NIL;
    j.A = qdot_calloc(n * n + 2 * n, sizeof *j.A);
    j.used = qdot_calloc(5 * n, sizeof *j.used);
    if (j.A != NULL && j.used != NULL) {
        j.b = j.A + n * n;
        j.lambda = j.b + n;
        j.row = j.used + n;
        j.column = j.row + n;
        j.best_row = j.column + n;
        j.best_column = j.best_row + n;
        for (size_t i = 0; i < n; i++) {
            j.b[i] = qdot_neg(pool, qdot_force_total(s, i, true, false));
            for (size_t c = 0; c < n; c++)
                j.A[i * n + c] = qdot_mech_tidy(s, qdot_constraint_slope(s, c, i));
        }
        status = qdot_pool_check(pool);
    }
    if (status == QDOT_OK)
        status = solve_joints(&j, k);
    if (status == QDOT_OK)
        value = j.lambda[k];
    else if (status == QDOT_ESINGULAR)
        qdot_mech_fail(s, QDOT_EINVAL, "lambda[%.200s] is not determined: constraints repeat each other",
                       s->constraints.at[k].name);
    else
        qdot_pool_fail(pool);
    qdot_free(j.A);
    qdot_free(j.used);
    return value;
}
