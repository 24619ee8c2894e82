/* freedom.c -- how many constraints are independent: the rank of their Jacobian
 *
 *     rows df/dq (holonomic), df/dq' (velocity), df/dq'' (acceleration)
 *
 * at a generic point where all constraints hold, with their derivatives up to the highest kind
 * among them: x y = 1 leaves x' y + x y' no rate but 0. Such points are found by damped Newton
 * steps from random configurations with random parameters, and the largest rank seen
 * counts. Where none is found (undefined functions of coordinates, assumed relations,
 * constraints that contradict each other) rows are eliminated symbolically, entries that
 * the constraints prove zero counting as zero.
 *
 * A row that repeats others may still say more than they do: x = t and x' = y make y = 1. With
 * F, W, G the equations of positions, velocities and accelerations, derivatives among them, such
 * conditions are counted at those points by
 *
 *     rank d(F,W)/d(q,q') - rank dF/dq - rank dW/dq',   likewise F, W, G with q''.
 */
#include "mech/dynamics/freedom.h"

#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/generic.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"
#include "mech/scene/cache.h"
#include "mech/scene/constraint.h"
#include "normal/prove/decide.h"

/* Constraints that seem redundant may only be so on one branch of their configurations: more
 * points are looked at then. */
enum { TRIALS = 12, MORE_TRIALS = 60, STEPS = 200 };

/* Equations f [c], the constraints first, and their slopes by z = (q, q', q''), m = 3n of them, those
 * that are not 0 row by row: as expressions and numbers. */
typedef struct {
    size_t n, c, m; /* numbers of coordinates, of equations, of variables 3n */
    size_t constraints; /* number of constraints, which are the first of the equations; their time derivatives follow */
    qdot_constraint_kind *kind; /* [c] kind of each equation: for positions, velocities or accelerations */
    size_t *of; /* [c] index of the constraint that each equation comes from */
    size_t slopes;                         /* number of derivatives of equations by variables that are not identically 0 */
    size_t *first; /* [c + 1] the derivatives of equation i have the indices first[i] ... first[i + 1] - 1 */
    size_t *column;                        /* [slopes] index in z of the variable of each derivative */
    qdot_expr *e; /* [c + slopes] expressions: the equations f, then their derivatives */
    qdot_expr *z;                          /* [m] the variables (q, q', q'') */
    double *value;                         /* [c + slopes] numerical values of e */
    double *at, *step, *gram, *rhs, *rows; /* scratch: z and its step [m], Gram matrix [c*c], right side [c], rows */
    double off;                            /* the largest |f| at the point z */
} problem;

static void
free_problem(problem *p)
{
    qdot_free(p->kind);
    qdot_free(p->of);
    qdot_free(p->first);
    qdot_free(p->column);
    qdot_free(p->e);
    qdot_free(p->z);
    qdot_free(p->value);
}

/* The derivatives that the constraints of lower kinds have at the levels of the others, behind the
 * constraints in `e`, which has room for three of each; their number, the kind of each, and which
 * constraint it is of. */
static size_t
add_derivatives(qdot_scene *s, qdot_expr *e, qdot_constraint_kind *kind, size_t *of)
{
    size_t c = s->constraints.n, n = c;
    qdot_constraint_kind highest = QDOT_HOLONOMIC;

    for (size_t k = 0; k < c; k++) {
        e[k] = s->constraints.at[k].f;
        kind[k] = s->constraints.at[k].kind;
        of[k] = k;
        highest = kind[k] > highest ? kind[k] : highest;
    }
    for (size_t k = 0; k < n; k++)
        if (kind[k] < highest) {
            kind[n] = kind[k] + 1;
            of[n] = of[k];
            e[n++] = qdot_ddt(s->pool, e[k]);
        }
    return n - c;
}

/* Add the partial derivatives of equation k by the variables that occur in it. */
static qdot_status
add_derivatives_of_equation(qdot_scene *s, problem *p, size_t k, qdot_constraint_kind kind, size_t *capacity,
                            size_t *columns)
{
    qdot_expr atoms = qdot_expr_atoms(s->pool, p->e[k], false);

    QDOT_TRY(qdot_pool_check(s->pool));
    p->first[k] = p->slopes;
    for (size_t i = 0; i < p->n * ((size_t)kind + 1); i++) {
        bool there = false;
        qdot_expr slope;

        for (uint32_t a = 0; a < qdot_expr_count(s->pool, atoms) && !there; a++)
            there = qdot_expr_arg(s->pool, atoms, a) == p->z[i];
        slope = there ? qdot_diff(s->pool, p->e[k], p->z[i]) : QDOT_ZERO;
        if (slope == QDOT_ZERO)
            continue;
        QDOT_TRY(qdot_grow(&p->e, capacity, p->c + p->slopes + 1, sizeof *p->e));
        QDOT_TRY(qdot_grow(&p->column, columns, p->slopes + 1, sizeof *p->column));
        p->e[p->c + p->slopes] = slope;
        p->column[p->slopes++] = i;
    }
    return qdot_pool_check(s->pool);
}

static qdot_status
fill_problem(qdot_scene *s, problem *p, size_t c, const qdot_expr *f,
             const qdot_constraint_kind *kind)
{
    size_t n = s->coordinates.n, m = 3 * n, capacity = 0, columns = 0;

    *p = (problem){.n = n, .c = c, .m = m, .constraints = s->constraints.n};
    QDOT_TRY(qdot_grow(&p->e, &capacity, c + 1, sizeof *p->e));
    p->z = qdot_calloc(m + 1, sizeof *p->z);
    p->first = qdot_calloc(c + 1, sizeof *p->first);
    if (!p->z || !p->first)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < m; i++)
        p->z[i] = qdot_mech_jet(s, i % n, (uint32_t)(i / n));
    for (size_t k = 0; k < c; k++)
        p->e[k] = f[k];
    for (size_t k = 0; k < c; k++)
        QDOT_TRY(add_derivatives_of_equation(s, p, k, kind[k], &capacity, &columns));
    p->first[c] = p->slopes;
    p->value = qdot_calloc(c + p->slopes + 2 * m + c * c + c + c * n + 1, sizeof *p->value);
    if (!p->value)
        return QDOT_ENOMEM;
    p->at = p->value + c + p->slopes;
    p->step = p->at + m;
    p->gram = p->step + m;
    p->rhs = p->gram + c * c;
    p->rows = p->rhs + c;
    return QDOT_OK;
}

static qdot_status
make_problem(qdot_scene *s, problem *p)
{
    size_t c = s->constraints.n;
    qdot_expr *f = qdot_calloc(3 * c + 1, sizeof *f);
    qdot_constraint_kind *kind = qdot_calloc(3 * c + 1, sizeof *kind);
    size_t *of = qdot_calloc(3 * c + 1, sizeof *of);
    qdot_status status = f && kind && of ? QDOT_OK : QDOT_ENOMEM;

    *p = (problem){0};
    if (status == QDOT_OK)
        status = fill_problem(s, p, c + add_derivatives(s, f, kind, of), f, kind);
    p->kind = kind;
    p->of = of;
    if (status != QDOT_OK)
        free_problem(p);
    qdot_free(f);
    return status;
}

static qdot_status
evaluate_constraints(qdot_scene *s, problem *p, uint64_t seed, double *size)
{
    *size = 0;
    QDOT_TRY(qdot_generic_evaluate(s->pool, p->c + p->slopes, p->e,
                                   &(qdot_generic_point){p->m, p->z, p->at, seed}, p->value));
    for (size_t k = 0; k < p->c; k++)
        *size = isfinite(p->value[k]) ? fmax(*size, fabs(p->value[k])) : INFINITY;
    for (size_t k = p->c; k < p->c + p->slopes; k++)
        if (!isfinite(p->value[k]))
            *size = INFINITY;
    return QDOT_OK;
}

/* Compute the lower triangle of the Gram matrix A A^T; returns its trace. `row` [m] is work space, left at 0. */
static double
fill_gram(problem *p, double *row)
{
    const double *A = p->value + p->c;
    double trace = 0;

    memset(row, 0, p->m * sizeof *row);
    for (size_t i = 0; i < p->c; i++) {
        for (size_t k = p->first[i]; k < p->first[i + 1]; k++)
            row[p->column[k]] = A[k];
        for (size_t j = 0; j <= i; j++) {
            double dot = 0;

            for (size_t k = p->first[j]; k < p->first[j + 1]; k++)
                dot += A[k] * row[p->column[k]];
            p->gram[i * p->c + j] = dot;
            trace += i == j ? dot : 0;
        }
        for (size_t k = p->first[i]; k < p->first[i + 1]; k++)
            row[p->column[k]] = 0;
    }
    return trace;
}

/* Find the damped Newton step A^T (A A^T + mu 1)^-1 f, by Cholesky's method. */
static void
find_damped_newton_step(problem *p, double mu)
{
    const double *A = p->value + p->c;
    size_t c = p->c;
    double *G = p->gram, *y = p->rhs, trace = fill_gram(p, p->step);

    for (size_t i = 0; i < c; i++)
        G[i * c + i] += (mu + 1e-13) * (trace + 1e-30);
    for (size_t i = 0; i < c; i++) {
        for (size_t j = 0; j <= i; j++) {
            double v = G[i * c + j];

            for (size_t k = 0; k < j; k++)
                v -= G[i * c + k] * G[j * c + k];
            G[i * c + j] = i == j ? sqrt(fmax(v, 1e-300)) : v / G[j * c + j];
        }
        y[i] = p->value[i];
        for (size_t k = 0; k < i; k++)
            y[i] -= G[i * c + k] * y[k];
        y[i] /= G[i * c + i];
    }
    for (size_t i = c; i-- > 0;) {
        for (size_t k = i + 1; k < c; k++)
            y[i] -= G[k * c + i] * y[k];
        y[i] /= G[i * c + i];
    }
    for (size_t i = 0; i < c; i++) /* the array of the step is still 0 here */
        for (size_t k = p->first[i]; k < p->first[i + 1]; k++)
            p->step[p->column[k]] += A[k] * y[i];
}

/* Bring p->at where all constraints hold; *found whether it did, p->off how well. Where rows are
 * dependent all along, Newton's method takes a part of the way at a time, and the place is
 * as far off as the root of that: it goes on for what it can. */
static qdot_status
find_point_on_constraints(qdot_scene *s, problem *p, uint64_t seed, bool *found)
{
    double size, mu = 1e-3;

    *found = false;
    for (size_t i = 0; i < p->m; i++)
        p->at[i] = qdot_generic_value(s->pool, p->z[i], seed + 77);
    QDOT_TRY(evaluate_constraints(s, p, seed, &size));
    for (int k = 0; k < STEPS && isfinite(size); k++) {
        double before = size, scale = 1;

        QDOT_TRY(qdot_interrupt_check());
        p->off = size;
        if (size < 1e-15) {
            *found = true;
            return QDOT_OK;
        }
        find_damped_newton_step(p, size < 1e-3 ? 0 : mu);
        for (int half = 0; half < 12; half++, scale /= 2) {
            for (size_t i = 0; i < p->m; i++)
                p->at[i] -= scale * p->step[i];
            QDOT_TRY(evaluate_constraints(s, p, seed, &size));
            if (size < before)
                break;
            for (size_t i = 0; i < p->m; i++)
                p->at[i] += scale * p->step[i];
        }
        if (!(size < before))
            QDOT_TRY(evaluate_constraints(s, p, seed, &size));
        if (!(size < before) || (size < 1e-10 && size > before / 2)) {
            p->off = size; /* the error that remains is due to rounding or damping */
            *found = size < 1e-10;
            return QDOT_OK;
        }
        mu = fmax(mu * 0.3, 1e-12);
    }
    p->off = size;
    *found = size < 1e-12;
    return QDOT_OK;
}

/* Whether row k, by what stands at `low` and the `width` variables from there on, leaves something
 * beside the `found` rows by Gram-Schmidt, twice: more than the place is off. Then it is one more of
 * them. */
static bool
add_independent_row(const problem *p, size_t k, size_t low, size_t width, double *rows, size_t found)
{
    const double nothing = fmax(1e-6, 100 * sqrt(p->off));
    double *row = rows + found * width, norm = 0, left = 0;

    memset(row, 0, width * sizeof *row);
    for (size_t i = p->first[k]; i < p->first[k + 1]; i++)
        if (p->column[i] >= low && p->column[i] < low + width) {
            row[p->column[i] - low] = p->value[p->c + i];
            norm = fmax(norm, fabs(p->value[p->c + i]));
        }
    if (!(norm > 1e-6))
        return false;
    for (size_t i = 0; i < width; i++)
        row[i] /= norm;
    for (int twice = 0; twice < 2; twice++)
        for (size_t j = 0; j < found; j++) {
            const double *other = rows + j * width;
            double dot = 0;

            for (size_t i = 0; i < width; i++)
                dot += row[i] * other[i];
            for (size_t i = 0; i < width; i++)
                row[i] -= dot * other[i];
        }
    for (size_t i = 0; i < width; i++)
        left += row[i] * row[i];
    left = sqrt(left);
    if (left < nothing)
        return false;
    for (size_t i = 0; i < width; i++)
        row[i] /= left;
    return true;
}

/* Find which rows of the Jacobian of the constraints are independent of the rows before; returns their number. */
static size_t
find_independent_rows(qdot_scene *s, problem *p, bool *independent)
{
    size_t found = 0;

    for (size_t k = 0; k < p->constraints; k++) {
        const size_t low = p->n * (size_t)s->constraints.at[k].kind;

        independent[k] = found < p->n && add_independent_row(p, k, low, p->n, p->rows, found);
        found += independent[k];
    }
    return found;
}

/* --- hidden conditions, which dependent rows leave ------------------------------------- */

/* A selection of the constraints: the independent ones, and dependent ones up to `last`. */
typedef struct {
    const problem *p;
    const bool *independent;
    size_t last;
    double *rows; /* [c x m] scratch for elimination */
} selection;

/* The rank, at the point found, of their equations of kinds `least` to `most` by q (order 0) to the
 * order `most`, without the orders below `lowest`. */
static size_t
rank_of_equations(const selection *of, int least, int most, int lowest)
{
    const problem *p = of->p;
    const size_t low = p->n * (size_t)lowest, width = p->n * ((size_t)most + 1) - low;
    size_t found = 0;

    for (size_t k = 0; k < p->c; k++) {
        if ((p->of[k] > of->last && !of->independent[p->of[k]]) || (int)p->kind[k] < least
            || (int)p->kind[k] > most)
            continue;
        found += add_independent_row(p, k, low, width, of->rows, found);
    }
    return found;
}

/* The number of hidden conditions that follow from the selected constraints. */
static size_t
count_hidden_conditions(const selection *of)
{
    size_t count = 0;

    for (int kind = QDOT_VELOCITY; kind <= QDOT_ACCELERATION; kind++)
        count += rank_of_equations(of, 0, kind, 0) - rank_of_equations(of, 0, kind - 1, 0)
                 - rank_of_equations(of, kind, kind, kind);
    return count;
}

/* Find the dependent constraints that imply a further (hidden) condition. */
static qdot_status
find_hidden_conditions(const problem *p, const bool *independent, bool *hidden)
{
    selection of = {.p = p, .independent = independent};
    size_t before = 0;

    of.rows = qdot_calloc(p->c * p->m + 1, sizeof *of.rows);
    if (!of.rows)
        return QDOT_ENOMEM;
    memset(hidden, 0, p->constraints * sizeof *hidden);
    for (size_t k = 0; k < p->constraints; k++) {
        size_t now;

        if (independent[k])
            continue;
        of.last = k;
        now = count_hidden_conditions(&of);
        hidden[k] = now > before;
        before = now;
    }
    qdot_free(of.rows);
    return QDOT_OK;
}

/* Whether constraints can be evaluated at random points, which undefined functions of moving arguments prevent. */
static bool
can_evaluate_at_points(qdot_scene *s, const problem *p)
{
    if (s->relations.n)
        return false;
    for (size_t k = 0; k < p->c; k++) {
        qdot_expr atoms;

        if (!(qdot_mech_holds(s, p->e[k]) & QDOT_HAS_UFUN))
            continue;
        atoms = qdot_expr_atoms(s->pool, p->e[k], true);
        if (atoms == QDOT_NIL)
            return false;
        for (uint32_t i = 0; i < qdot_expr_count(s->pool, atoms); i++) {
            qdot_expr f = qdot_expr_arg(s->pool, atoms, i);

            if (qdot_expr_kind(s->pool, f) == QDOT_UFUN &&
                qdot_mech_holds(s, f) &
                    (QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION))
                return false;
        }
    }
    return true;
}

/* Find, at random points, which constraints are independent; in the second half of [2c]: which imply a condition. */
static qdot_status
find_independence_by_points(qdot_scene *s, problem *p, bool *independent, bool *known)
{
    size_t c = p->constraints, most = 0, hits = 0, full = c < p->n ? c : p->n;
    size_t trials = TRIALS;
    bool *seen = qdot_calloc(c, sizeof *seen), found;
    qdot_status status = seen ? QDOT_OK : QDOT_ENOMEM;

    for (uint64_t seed = 1; status == QDOT_OK && seed <= trials && most < full; seed++) {
        size_t r;

        status = find_point_on_constraints(s, p, seed, &found);
        if (status != QDOT_OK || !found)
            continue;
        trials = MORE_TRIALS;
        r = find_independent_rows(s, p, seen);
        if (hits++ == 0 || r > most) {
            most = r;
            memcpy(independent, seen, c * sizeof *seen);
            if (r < c)
                status = find_hidden_conditions(p, independent, independent + c);
        }
    }
    *known = hits > 0;
    qdot_free(seen);
    return status;
}

static qdot_status
find_independence_by_elimination(qdot_scene *s, bool *independent)
{
    qdot_pool *pool = s->pool;
    size_t n = s->coordinates.n, c = s->constraints.n, found = 0;
    qdot_expr *rows = qdot_calloc(c * n + 1, sizeof *rows), *relations = NULL;
    size_t *pivot = qdot_calloc(c + 1, sizeof *pivot);
    qdot_facts facts;
    qdot_status status = rows && pivot ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_constraint_facts(s, &relations, &facts);
    for (size_t k = 0; k < c && status == QDOT_OK; k++) {
        qdot_expr *row = rows + found * n;

        for (size_t i = 0; i < n; i++)
            row[i] = qdot_constraint_slope(s, k, i);
        for (size_t j = 0; j < found; j++) {
            const qdot_expr *above = rows + j * n;
            qdot_expr head = row[pivot[j]];

            if (head == QDOT_ZERO)
                continue;
            for (size_t i = 0; i < n; i++)
                row[i] = i == pivot[j]
                             ? QDOT_ZERO
                             : qdot_sub(pool, qdot_mul(pool, above[pivot[j]], row[i]),
                                        qdot_mul(pool, head, above[i]));
        }
        independent[k] = false;
        for (size_t i = 0; i < n && !independent[k]; i++) {
            if (row[i] == QDOT_NIL || row[i] == QDOT_ZERO)
                continue;
            if (qdot_is_zero(pool, row[i], &facts)) {
                row[i] = QDOT_ZERO;
                continue;
            }
            independent[k] = true;
            pivot[found] = i;
        }
        found += independent[k];
        status = qdot_pool_check(pool);
    }
    qdot_free(rows);
    qdot_free(pivot);
    qdot_free(relations);
    return status;
}

bool
qdot_freedom_independent(qdot_scene *s)
{
    qdot_derived *d = qdot_derived_get(s);
    bool *independent, known = false;
    problem p;
    qdot_status status;

    if (d->independent)
        return true;
    independent = qdot_calloc(2 * s->constraints.n + 1, sizeof *independent);
    status = independent ? QDOT_OK : QDOT_ENOMEM;
    if (status == QDOT_OK && s->constraints.n && s->coordinates.n) {
        status = make_problem(s, &p);
        if (status == QDOT_OK) {
            if (can_evaluate_at_points(s, &p))
                status = find_independence_by_points(s, &p, independent, &known);
            d->unmet = can_evaluate_at_points(s, &p) && !known;
            free_problem(&p);
            if (status == QDOT_OK)
                status = qdot_pool_check(s->pool);
        }
        if (status == QDOT_OK && !known)
            status = find_independence_by_elimination(s, independent);
    }
    if (status != QDOT_OK) {
        qdot_free(independent);
        qdot_pool_fail(s->pool);
        return false;
    }
    d->independent = independent;
    d->hidden = independent + s->constraints.n;
    return true;
}

/* Every component of every particle a coordinate of its own: n = N D - C in so many
 * words. */
static bool
has_cartesian_coordinates(const qdot_scene *s)
{
    size_t seen = 0;

    if (s->bodies.n || !s->particles.n)
        return false;
    for (size_t i = 0; i < s->particles.n; i++) {
        qdot_expr r = s->particles.at[i].position;

        for (uint32_t d = 0; d < qdot_mech_dimension(s->pool, r); d++, seen++) {
            qdot_expr x = qdot_mech_component(s->pool, r, d);

            if (!qdot_expr_is_coordinate(s->pool, x))
                return false;
            for (size_t k = 0; k < i; k++)
                if (qdot_expr_contains(s->pool, s->particles.at[k].position, x))
                    return false;
            for (uint32_t k = 0; k < d; k++)
                if (qdot_mech_component(s->pool, r, k) == x)
                    return false;
        }
    }
    return seen == s->coordinates.n - s->states.n;
}

qdot_status
qdot_mech_dof(qdot_scene *s, qdot_dof *dof)
{
    QDOT_TRY(qdot_pool_check(s->pool));
    if (!qdot_freedom_independent(s)) {
        qdot_status status = qdot_pool_check(s->pool);

        return status == QDOT_OK ? QDOT_EFAILED : status;
    }
    *dof = (qdot_dof){.coordinates = s->coordinates.n - s->states.n,
                      .states = s->states.n,
                      .constraints = s->constraints.n,
                      .is_independent = s->derived->independent,
                      .is_hidden = s->derived->hidden,
                      .unmet = s->derived->unmet,
                      .cartesian = has_cartesian_coordinates(s),
                      .particles = s->particles.n,
                      .dimension = qdot_scene_dimension(s)};
    for (size_t k = 0; k < s->constraints.n; k++)
        dof->independent += s->derived->independent[k];
    dof->freedom = dof->coordinates - dof->independent;
    return QDOT_OK;
}
