/* linear-motion.c -- the equations of motion near an equilibrium, to first order. */
#include "mech/linear/linear-motion.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/integrated.h"
#include "mech/dynamics/quantity.h"
#include "mech/linear/elimination.h"
#include "mech/scene/access.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solutions.h"

/* --- expressions at an equilibrium; linearisation ------------------------------------- */

qdot_status
qdot_rest_facts(qdot_scene *s, qdot_expr exists, qdot_facts *facts, qdot_expr **own)
{
    uint32_t n = exists == QDOT_NIL ? 0 : qdot_expr_count(s->pool, exists);

    *facts = qdot_scene_facts(s);
    *own = qdot_malloc((facts->n_conditions + n + 1) * sizeof **own);
    if (*own == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < facts->n_conditions; i++)
        (*own)[i] = facts->conditions[i];
    for (uint32_t i = 0; i < n; i++)
        (*own)[facts->n_conditions + i] = qdot_expr_arg(s->pool, exists, i);
    facts->conditions = *own;
    facts->n_conditions += n;
    return QDOT_OK;
}

/* Replacements and facts by which an expression is evaluated at rest at an equilibrium. */
typedef struct {
    qdot_scene *s;
    qdot_facts facts;
    qdot_expr *own; /* [conditions] the array in which the conditions of `facts` are stored; owned */
    size_t n;
    qdot_expr *from, *to;
    bool family; /* the equations hold integers that number the members of a family */
} place;

static qdot_status
place_begin(place *p, qdot_scene *s, qdot_expr equations, qdot_expr exists)
{
    size_t n = s->coordinates.n, m = qdot_expr_count(s->pool, equations);

    *p = (place){.s = s, .n = 2 * n + m};
    QDOT_TRY(qdot_rest_facts(s, exists, &p->facts, &p->own));
    p->from = qdot_calloc(2 * p->n + 1, sizeof *p->from);
    if (p->from == NULL)
        return QDOT_ENOMEM;
    p->to = p->from + p->n;
    for (size_t i = 0; i < n; i++) {
        p->from[i] = qdot_mech_jet(s, i, 1);
        p->from[n + i] = qdot_mech_jet(s, i, 2);
        p->to[i] = p->to[n + i] = QDOT_ZERO;
    }
    for (size_t i = 0; i < m; i++) {
        qdot_expr one = qdot_expr_arg(s->pool, equations, (uint32_t)i);

        p->from[2 * n + i] = qdot_expr_arg(s->pool, one, 0);
        p->to[2 * n + i] = qdot_expr_arg(s->pool, one, 1);
    }
    p->family = qdot_solve_integers(s->pool, equations) > 0;
    return qdot_pool_check(s->pool);
}

static void
place_end(place *p)
{
    qdot_free(p->from);
    qdot_free(p->own);
}

/* The value of e at the equilibrium; for a family, whole turns are dropped from the arguments of
 * circular functions. */
static qdot_expr
substituted_value(const place *p, qdot_expr e)
{
    qdot_pool *pool = p->s->pool;

    e = qdot_subs(pool, e, p->n, p->from, p->to);
    return p->family && e != QDOT_NIL ? qdot_solve_without_turns(pool, e) : e;
}

static qdot_expr
simplified_value_at_rest(const place *p, qdot_expr e)
{
    return qdot_simplify(p->s->pool, substituted_value(p, e), &p->facts);
}

qdot_expr
qdot_motion_residual(qdot_scene *s, size_t i)
{
    const qdot_expr equation = qdot_mech_equation(s, s->coordinates.at[i]);

    return equation == QDOT_NIL ? QDOT_NIL
                                : qdot_sub(s->pool, qdot_expr_arg(s->pool, equation, 0),
                                           qdot_expr_arg(s->pool, equation, 1));
}

qdot_expr
qdot_rest_value(qdot_scene *s, qdot_expr equations, qdot_expr e)
{
    place p = {0};
    qdot_status status = place_begin(&p, s, equations, QDOT_NIL);

    e = status == QDOT_OK ? substituted_value(&p, e) : qdot_pool_fail(s->pool);
    place_end(&p);
    return e;
}

/* Bring the gradients of the holonomic constraints into echelon form; out->pivot: the divisors of the rows. */
static qdot_status
reduce_gradients(const place *p, qdot_echelon *e, qdot_linear_motion *out)
{
    const size_t n = p->s->coordinates.n, c = p->s->constraints.n;
    qdot_elimination x = {.pool = p->s->pool, .facts = &p->facts};
    qdot_expr *row = qdot_calloc(n + 1, sizeof *row);
    qdot_status status = row == NULL ? QDOT_ENOMEM : qdot_echelon_begin(e, c, n, n);

    for (size_t k = 0; k < c && status == QDOT_OK; k++) {
        bool independent;

        for (size_t i = 0; i < n; i++)
            row[i] = simplified_value_at_rest(p, qdot_integrated_slope(p->s, k, i));
        status = qdot_echelon_add(&x, e, row, &independent);
        if (status == QDOT_OK && independent)
            out->pivot[out->rank++] = row[e->pivot[e->rank - 1]];
    }
    qdot_free(row);
    return status;
}

/* The bilinear form v.X w with X [n*n]; v and w are columns of N [n*m]. */
static qdot_expr
bilinear_form(const place *p, const qdot_expr *X, const qdot_expr *v, const qdot_expr *w, size_t m)
{
    size_t n = p->s->coordinates.n;
    qdot_expr sum = QDOT_ZERO;

    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            if (v[i * m] != QDOT_ZERO && w[j * m] != QDOT_ZERO && X[i * n + j] != QDOT_ZERO)
                sum = qdot_add(
                    p->s->pool, sum,
                    qdot_product(p->s->pool, 3,
                                 (qdot_expr[]){v[i * m], X[i * n + j], w[j * m]}));
    return qdot_simplify(p->s->pool, sum, &p->facts);
}

/* Project X [n*n] onto the tangent space: N^T X N, with N [n*m]. */
static qdot_status
project_on_tangents(const place *p, const qdot_expr *X, const qdot_expr *N, size_t m, qdot_expr *out)
{
    for (size_t a = 0; a < m; a++)
        for (size_t b = 0; b < m; b++)
            out[a * m + b] = bilinear_form(p, X, N + a, N + b, m);
    return qdot_pool_check(p->s->pool);
}

/* *slope = d(left)/dx at the place, x the derivative of that order of coordinate j; out->exact,
 * out->damped. */
static qdot_status
derivative_at_rest(const place *p, qdot_expr left, size_t j, uint32_t order, qdot_expr *slope,
                   qdot_linear_motion *out)
{
    const uint32_t motion =
        QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_TIME;
    qdot_scene *s = p->s;
    qdot_expr e = qdot_diff(s->pool, left, qdot_mech_jet(s, j, order));
    qdot_status status;

    out->exact = out->exact && e != QDOT_NIL && (qdot_mech_holds(s, e) & motion) == 0;
    *slope = simplified_value_at_rest(p, e);
    status = qdot_pool_check(s->pool);
    if (status != QDOT_EDOMAIN || order != 1) /* derivative by a velocity undefined, as of sqrt(v^2) v at 0 */
        return status;
    out->damped = false;
    *slope = QDOT_ZERO;
    return QDOT_OK;
}

/* Linearise the motion: mass M, damping Gamma, stiffness H of all coordinates; sets out->exact and out->damped. */
static qdot_status
linearise(const place *p, qdot_expr *X, qdot_linear_motion *out)
{
    qdot_scene *s = p->s;
    size_t n = s->coordinates.n;

    out->exact = s->constraints.n == 0;
    out->damped = true;
    for (size_t i = 0; i < n; i++) {
        const qdot_expr left = qdot_motion_residual(s, i);

        QDOT_TRY(qdot_pool_check(s->pool));
        for (uint32_t order = 0; order < 3; order++)
            for (size_t j = 0; j < n; j++)
                QDOT_TRY(derivative_at_rest(p, left, j, order, &X[(2 - order) * n * n + i * n + j], out));
    }
    return qdot_pool_check(s->pool);
}

/* Subtract `by` times column z from column j of M, Gamma and H, X [3 * n * n]. */
static qdot_status
subtract_column(const place *p, qdot_expr *X, size_t j, qdot_expr by, size_t z)
{
    const size_t n = p->s->coordinates.n;

    for (size_t i = 0; i < 3 * n; i++)
        X[i * n + j] = qdot_simplify(
            p->s->pool, qdot_sub(p->s->pool, X[i * n + j], qdot_mul(p->s->pool, by, X[i * n + z])), &p->facts);
    return qdot_pool_check(p->s->pool);
}

/* Make the equations of states those of second order that linear-motion.h describes. */
static qdot_status
raise_states(const place *p, qdot_expr *X)
{
    const size_t n = p->s->coordinates.n;
    qdot_expr *M = X, *Gamma = X + n * n, *H = X + 2 * n * n;

    for (size_t z = 0; z < n; z++) {
        if (!qdot_scene_state_of(p->s, p->s->coordinates.at[z]))
            continue;
        for (size_t j = 0; j < n; j++)
            if (j != z && Gamma[z * n + j] != QDOT_ZERO)
                QDOT_TRY(subtract_column(p, X, j, Gamma[z * n + j], z));
        for (size_t j = 0; j < n; j++) {
            M[z * n + j] = Gamma[z * n + j];
            Gamma[z * n + j] = qdot_add(p->s->pool, Gamma[z * n + j], H[z * n + j]);
        }
    }
    return qdot_pool_check(p->s->pool);
}

void
qdot_linear_motion_clear(qdot_linear_motion *m)
{
    qdot_free(m->M);
    qdot_free(m->which);
    qdot_free(m->pivot);
    *m = (qdot_linear_motion){0};
}

/* Write the motion in the tangent space of the constraints, which is the null space of their gradients. */
static qdot_status
reduce_to_tangents(const place *p, const qdot_expr *X, const qdot_echelon *gradients, qdot_linear_motion *out)
{
    const size_t n = p->s->coordinates.n, m = n - gradients->rank;

    for (size_t j = 0; j < n; j++)
        if (!qdot_echelon_leads(gradients, j))
            out->which[out->n++] = j;
    out->M = qdot_calloc(3 * m * m + n * m + 1, sizeof *out->M);
    if (out->M == NULL)
        return QDOT_ENOMEM;
    out->Gamma = out->M + m * m;
    out->H = out->Gamma + m * m;
    out->N = out->H + m * m;
    qdot_echelon_null_space(p->s->pool, gradients, out->N);
    for (int k = 0; k < 3; k++)
        QDOT_TRY(project_on_tangents(p, X + (size_t)k * n * n, out->N, m, out->M + (size_t)k * m * m));
    return QDOT_OK;
}

qdot_status
qdot_linear_motion_about(qdot_scene *s, qdot_expr equations, qdot_expr exists,
                         qdot_linear_motion *out)
{
    size_t n = s->coordinates.n;
    qdot_expr *X = qdot_calloc(3 * n * n + 1, sizeof *X);
    qdot_status status = X == NULL ? QDOT_ENOMEM : QDOT_OK;
    place p = {0};
    qdot_echelon gradients = {0};

    *out = (qdot_linear_motion){
        .which = qdot_calloc(n + 1, sizeof *out->which),
        .pivot = qdot_calloc(s->constraints.n + 1, sizeof *out->pivot)};
    if (out->which == NULL || out->pivot == NULL)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = place_begin(&p, s, equations, exists);
    if (status == QDOT_OK)
        status = linearise(&p, X, out);
    if (status == QDOT_OK)
        status = raise_states(&p, X);
    if (status == QDOT_OK)
        status = reduce_gradients(&p, &gradients, out);
    if (status == QDOT_OK)
        status = reduce_to_tangents(&p, X, &gradients, out);
    qdot_echelon_end(&gradients);
    qdot_free(X);
    place_end(&p);
    if (status != QDOT_OK)
        qdot_linear_motion_clear(out);
    return status;
}

/* --- coordinates without mass ---------------------------------------------------------- */

static bool
coordinate_has_mass(const qdot_linear_motion *m, size_t a, qdot_pool *pool, const qdot_facts *facts)
{
    for (size_t b = 0; b < m->n; b++)
        if (!qdot_is_zero(pool, m->M[a * m->n + b], facts) || !qdot_is_zero(pool, m->M[b * m->n + a], facts))
            return true;
    return false;
}

/* Copy X [rows * n] without column a (and row a if `square`) to the address `to`; returns the address after the copy. */
static qdot_expr *
copy_without(const qdot_expr *X, size_t rows, size_t n, size_t a, bool square, qdot_expr *to)
{
    for (size_t i = 0; i < rows; i++)
        for (size_t b = 0; b < n; b++)
            if (b != a && !(square && i == a))
                *to++ = X[i * n + b];
    return to;
}

/* Eliminate a coordinate without mass, y_a = -sum_b H_ab y_b / H_aa, from the unknowns. */
static qdot_status
eliminate_unknown(qdot_scene *s, const qdot_facts *facts, size_t a, qdot_linear_motion *m)
{
    qdot_pool *pool = s->pool;
    const size_t n = m->n, q = s->coordinates.n;
    qdot_expr *room = qdot_calloc(3 * n * n + q * n + 1, sizeof *room), *to = room;

    if (room == NULL)
        return QDOT_ENOMEM;
    for (size_t b = 0; b < n; b++) {
        const qdot_expr by = qdot_div(pool, m->H[a * n + b], m->H[a * n + a]);

        if (b == a || by == QDOT_ZERO)
            continue;
        for (size_t i = 0; i < n; i++)
            if (i != a)
                m->H[i * n + b] = qdot_simplify(
                    pool, qdot_sub(pool, m->H[i * n + b], qdot_mul(pool, by, m->H[i * n + a])), facts);
        for (size_t i = 0; i < q; i++)
            m->N[i * n + b] = qdot_simplify(
                pool, qdot_sub(pool, m->N[i * n + b], qdot_mul(pool, by, m->N[i * n + a])), facts);
    }
    to = copy_without(m->M, n, n, a, true, to);
    to = copy_without(m->Gamma, n, n, a, true, to);
    to = copy_without(m->H, n, n, a, true, to);
    (void)copy_without(m->N, q, n, a, false, to);
    qdot_free(m->M);
    m->n--;
    m->M = room;
    m->Gamma = m->M + m->n * m->n;
    m->H = m->Gamma + m->n * m->n;
    m->N = m->H + m->n * m->n;
    for (size_t b = a; b < m->n; b++)
        m->which[b] = m->which[b + 1];
    return qdot_pool_check(pool);
}

qdot_status
qdot_linear_motion_condense(qdot_scene *s, const qdot_facts *facts, qdot_linear_motion *m, size_t *left)
{
    bool found = true;

    while (found) {
        found = false;
        *left = SIZE_MAX;
        for (size_t a = 0; a < m->n && !found; a++) {
            if (coordinate_has_mass(m, a, s->pool, facts))
                continue;
            *left = *left == SIZE_MAX ? m->which[a] : *left;
            found = !qdot_is_zero(s->pool, m->H[a * m->n + a], facts);
            QDOT_TRY(qdot_pool_check(s->pool));
            if (found)
                QDOT_TRY(eliminate_unknown(s, facts, a, m));
        }
    }
    return qdot_pool_check(s->pool);
}
