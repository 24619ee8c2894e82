/* legendre.c -- Legendre's transform, block by block of the second derivatives. */
#include "mech/hamilton/legendre.h"

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/squares.h"
#include "mech/scene/access.h"
#include "normal/form/common.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/linear.h"

/* e where all x are 0 but those of bent blocks. */
static qdot_expr
at_zero(const qdot_legendre *l, qdot_expr e)
{
    for (uint32_t i = 0; i < l->n; i++)
        if (!l->bent[i])
            e = qdot_subs(l->pool, e, 1, &l->x[i], (qdot_expr[]){QDOT_ZERO});
    return e;
}

static bool
holds_variable(const qdot_legendre *l, qdot_expr e)
{
    return qdot_expr_contains_any(l->pool, e, l->n, l->x);
}

/* The sum of those terms of e that hold an x of the block `of`, and none of other blocks. */
static qdot_expr
terms_of_block(const qdot_legendre *l, qdot_expr e, size_t of)
{
    const bool several = e != QDOT_NIL && qdot_expr_kind(l->pool, e) == QDOT_SUM;
    const uint32_t n = several ? qdot_expr_count(l->pool, e) : 2;
    qdot_expr sum = QDOT_ZERO;

    for (uint32_t i = 1; i < n && e != QDOT_NIL; i += 2) {
        const qdot_expr term = several ? qdot_expr_arg(l->pool, e, i) : e;
        bool own = false, other = false;

        for (uint32_t k = 0; k < l->n; k++)
            if (qdot_expr_contains(l->pool, term, l->x[k])) {
                own |= l->block[k] == of;
                other |= l->block[k] != of;
            }
        if (own && !other)
            sum = qdot_add(l->pool, sum,
                           several ? qdot_mul(l->pool, qdot_expr_arg(l->pool, e, i + 1), term) : term);
    }
    return sum;
}

/* Whether dF/dx_i is A x and what holds no x of the block, as the second derivatives say where nothing jumps. */
static bool
is_slope_linear(const qdot_legendre *l, uint32_t i)
{
    qdot_expr rest = qdot_diff(l->pool, l->F, l->x[i]);

    if (!qdot_expr_has_function_of(l->pool, rest, l->n, l->x)) /* the derivative of sign(x) is 0, though it is no constant */
        return true;
    for (uint32_t j = 0; j < l->n; j++)
        rest = qdot_sub(l->pool, rest, qdot_mul(l->pool, l->A[i * l->n + j], l->x[j]));
    rest = qdot_simplify(l->pool, rest, &l->facts);
    for (uint32_t j = 0; j < l->n; j++)
        if (rest == QDOT_NIL || (l->block[j] == l->block[i] && qdot_expr_contains(l->pool, rest, l->x[j])))
            return false;
    return true;
}

/* Find A, its blocks, and those in which F is not quadratic. */
static void
find_hessian_blocks(qdot_legendre *l)
{
    for (uint32_t i = 0; i < l->n; i++) {
        const qdot_expr slope = qdot_diff(l->pool, l->F, l->x[i]);

        for (uint32_t j = 0; j < l->n; j++)
            l->A[i * l->n + j] = qdot_simplify(l->pool, qdot_diff(l->pool, slope, l->x[j]), &l->facts);
    }
    qdot_squares_blocks(l->n, l->A, l->block);
    for (uint32_t i = 0; i < l->n; i++)
        for (uint32_t j = 0; j < l->n; j++)
            if (l->block[i] == l->block[j] && holds_variable(l, l->A[i * l->n + j]))
                for (uint32_t k = 0; k < l->n; k++)
                    l->bent[k] |= l->block[k] == l->block[i];
    for (uint32_t i = 0; i < l->n; i++)
        if (!l->bent[i] && !is_slope_linear(l, i))
            for (uint32_t k = 0; k < l->n; k++)
                l->bent[k] |= l->block[k] == l->block[i];
}

/* --- errors ------------------------------------------------------------------------------ */

static const char *
coordinate_name(const qdot_legendre *l, uint32_t i)
{
    return qdot_expr_symbol(l->pool, l->q[i])->name;
}

static void
report_singular(const qdot_legendre *l, uint32_t i)
{
    if (l->of == QDOT_COORD)
        qdot_mech_fail(l->s, QDOT_ESINGULAR,
                       "the momenta do not determine the velocity of %s: the mass matrix is singular",
                       coordinate_name(l, i));
    else
        qdot_mech_fail(l->s, QDOT_ESINGULAR, "the velocities do not determine p[%s]: H is not regular in the momenta",
                       coordinate_name(l, i));
}

/* F is homogeneous of first degree in all x, F(x) = x_i F(x/x_i) for x_i > 0: what is 0 there is y_i + g, with g the transform
 * of F at x_i = 1 in the other variables. *parameter is that x_i; nil: no g was found. */
static qdot_expr
find_primary_constraint(const qdot_legendre *l, qdot_expr F, qdot_expr *parameter)
{
    qdot_expr *others = qdot_calloc(l->n + 1, sizeof *others), bound = QDOT_NIL, one = QDOT_ONE;

    if (others == NULL)
        return qdot_pool_fail(l->pool);
    for (uint32_t i = 0; i < l->n && bound == QDOT_NIL; i++) {
        uint32_t m = 0;

        for (uint32_t j = 0; j < l->n; j++)
            if (j != i)
                others[m++] = l->q[j];
        *parameter = l->x[i];
        bound = qdot_add(l->pool, l->y[i],
                         qdot_legendre_of(l->s, l->of, qdot_subs(l->pool, F, 1, &l->x[i], &one), m, others));
        if (qdot_pool_check(l->pool) != QDOT_OK)
            bound = QDOT_NIL;
    }
    qdot_free(others);
    return bound;
}

/* The names of v [n] in the block of the variable `first`, as "p[x], p[y]". Returns their number. */
static uint32_t
add_names(const qdot_legendre *l, const qdot_expr *v, uint32_t first, qdot_text *text)
{
    uint32_t n = 0;

    for (uint32_t i = first; i < l->n; i++)
        if (l->block[i] == first) {
            qdot_text_add(text, n++ > 0 ? ", " : "");
            if (qdot_print(l->pool, v[i], QDOT_PLAIN, text) != QDOT_OK)
                text->failed = true;
        }
    return n;
}

/* y does not determine the x of the block of the variable `first`; bound: what is 0 then, nil: it was not found. */
static void
report_undetermined(const qdot_legendre *l, uint32_t first, qdot_legendre_degree degree, qdot_expr bound)
{
    const bool of_velocities = l->of == QDOT_COORD;
    const char *F = of_velocities ? "L" : "H", *y = of_velocities ? "momenta" : "velocities";
    qdot_expr parameter = QDOT_NIL, lower = QDOT_NIL;
    qdot_text text = {0}, names = {0};
    const uint32_t m = add_names(l, l->x, first, &names);

    if (m == l->n && degree == QDOT_LEGENDRE_FIRST) {
        lower = qdot_legendre_lower(l->pool, l->F, l->n, l->x, &l->facts);
        if (bound == QDOT_NIL && of_velocities)
            bound = find_primary_constraint(l, qdot_sub(l->pool, l->F, lower), &parameter);
    }
    if (degree != QDOT_LEGENDRE_FIRST)
        qdot_text_format(&text, "the %s do not determine %s: %s is not regular in %s", y, qdot_text_str(&names), F,
                         of_velocities ? "the velocities" : "the momenta");
    else if (lower == QDOT_ZERO)
        qdot_text_format(&text, "%s is homogeneous of first degree in the %s: sum p q' - %s is 0", F, of_velocities ? "velocities" : "momenta", F);
    else
        qdot_text_format(&text, "the %s do not determine %s: beside terms without %s %s is homogeneous of first degree in %s",
                         y, qdot_text_str(&names), m > 1 ? "these" : "it", F, m > 1 ? "them" : "it");
    if (bound != QDOT_NIL) {
        if (parameter != QDOT_NIL)
            qdot_text_format(&text, ", and where %s > 0", qdot_expr_symbol(l->pool, parameter)->name);
        else
            qdot_text_add(&text, ", and");
        qdot_text_format(&text, " the %s obey ", y);
        if (qdot_print(l->pool, bound, QDOT_PLAIN, &text) != QDOT_OK)
            text.failed = true;
        qdot_text_add(&text, " = 0");
    }
    if (qdot_text_status(&text) != QDOT_OK || qdot_text_status(&names) != QDOT_OK)
        qdot_pool_fail(l->pool);
    else
        qdot_mech_fail(l->s, QDOT_ESINGULAR, "%s", qdot_text_str(&text));
    qdot_text_clear(&text);
    qdot_text_clear(&names);
}

static void
report_no_formula(const qdot_legendre *l, uint32_t i)
{
    if (l->of == QDOT_COORD)
        qdot_mech_fail(l->s, QDOT_EDOMAIN,
                       "the momentum of %s is not linear in the velocities, and no formula was found for these",
                       coordinate_name(l, i));
    else
        qdot_mech_fail(l->s, QDOT_EDOMAIN, "%s' is not linear in the momenta, and no formula was found for these",
                       coordinate_name(l, i));
}

/* --- solving y = dF/dx -------------------------------------------------------------------- */

/* Solve the blocks in which F is quadratic, as one linear system. */
static bool
solve_linear_blocks(qdot_legendre *l)
{
    const uint32_t n = l->n;
    qdot_expr *A = qdot_calloc((size_t)n * n + 2 * n + 1, sizeof *A), *b, *x;
    uint32_t *which = qdot_calloc(n + 1, sizeof *which), m = 0, pivot = 0;
    qdot_status status = A == NULL || which == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (uint32_t i = 0; status == QDOT_OK && i < n; i++)
        if (!l->bent[i])
            which[m++] = i;
    if (status == QDOT_OK && m > 0) {
        b = A + (size_t)m * m;
        x = b + m;
        for (uint32_t i = 0; i < m; i++) {
            qdot_expr slope = qdot_diff(l->pool, l->F, l->x[which[i]]);

            slope = at_zero(l, slope);
            if (m < n && holds_variable(l, slope)) /* what varies with the bent blocks cancels */
                slope = qdot_simplify(l->pool, slope, &l->facts);
            b[i] = l->rest[which[i]] = qdot_sub(l->pool, l->y[which[i]], slope);
            for (uint32_t j = 0; j < m; j++)
                A[i * m + j] = l->A[which[i] * n + which[j]];
        }
        status = qdot_pool_check(l->pool);
        if (status == QDOT_OK)
            status = qdot_solve_linear(l->pool, m, A, b, x, &pivot, &l->facts);
        for (uint32_t i = 0; i < m && status == QDOT_OK; i++)
            l->solved[which[i]] = x[i];
        pivot = which[pivot];
    }
    qdot_free(A);
    qdot_free(which);
    if (status == QDOT_ESINGULAR)
        report_singular(l, pivot);
    else if (status != QDOT_OK)
        qdot_pool_fail(l->pool);
    return status == QDOT_OK;
}

/* Whether an x of the block stands in e. */
static bool
is_held(const qdot_legendre *l, qdot_expr e, uint32_t block)
{
    for (uint32_t i = block; i < l->n; i++)
        if (l->block[i] == block && e != QDOT_NIL && qdot_expr_contains(l->pool, e, l->x[i]))
            return true;
    return false;
}

/* Solve the block of the variable `first`, in which F is not quadratic. Its terms leave l->F_left for l->G_bent; if they
 * cannot be told from those of other blocks, F at the solution stays in l->F_left. */
static bool
solve_bent_block(qdot_legendre *l, uint32_t first)
{
    qdot_pool *pool = l->pool;
    qdot_expr *x = qdot_calloc(3 * (size_t)l->n, sizeof *x), *y = x + l->n, *solved = y + l->n, bound = QDOT_NIL,
              there = QDOT_NIL, sum = QDOT_ZERO, own = terms_of_block(l, l->F_left, first), others = qdot_sub(pool, l->F_left, own);
    uint32_t m = 0;
    bool apart;
    qdot_legendre_degree degree = QDOT_LEGENDRE_REGULAR;
    qdot_status status = x == NULL ? QDOT_ENOMEM : QDOT_OK;

    if (is_held(l, others, first)) { /* a product may hold a sum of terms of several blocks */
        l->F_left = qdot_expand(pool, l->F_left);
        own = terms_of_block(l, l->F_left, first);
        others = qdot_sub(pool, l->F_left, own);
    }
    apart = !is_held(l, others, first);
    for (uint32_t i = first; i < l->n && status == QDOT_OK; i++)
        if (l->block[i] == first) {
            x[m] = l->x[i];
            y[m++] = l->y[i];
        }
    if (status == QDOT_OK)
        status = qdot_legendre_bent(pool, apart ? own : l->F_left, m, x, y, &l->facts, solved, &degree, &bound, &there);
    for (uint32_t i = first, k = 0; i < l->n && there != QDOT_NIL && status == QDOT_OK; i++)
        if (l->block[i] == first) {
            l->solved[i] = solved[k++];
            sum = qdot_add(pool, sum, qdot_mul(pool, l->solved[i], l->y[i]));
        }
    qdot_free(x);
    if (apart) {
        l->F_left = others;
        sum = qdot_simplify(pool, qdot_sub(pool, sum, there), &l->facts);
    } else {
        l->F_left = there;
        l->mixed = true;
    }
    l->G_bent = qdot_add(pool, l->G_bent, sum);
    if (status != QDOT_OK)
        qdot_pool_fail(pool);
    else if (degree != QDOT_LEGENDRE_REGULAR)
        report_undetermined(l, first, degree, bound);
    else if (there == QDOT_NIL)
        report_no_formula(l, first);
    return there != QDOT_NIL && status == QDOT_OK;
}

bool
qdot_legendre_begin(qdot_legendre *l, qdot_scene *s, qdot_class of, qdot_expr F, uint32_t n, const qdot_expr *q)
{
    qdot_pool *pool = s->pool;

    *l = (qdot_legendre){.s = s, .pool = pool, .facts = qdot_scene_facts(s), .of = of, .n = n, .F = F, .F_left = F, .G_bent = QDOT_ZERO};
    l->q = qdot_calloc((size_t)n * n + 5 * n + 1, sizeof *l->q);
    l->block = qdot_calloc(n + 1, sizeof *l->block);
    l->bent = qdot_calloc(n + 1, sizeof *l->bent);
    if (l->q == NULL || l->block == NULL || l->bent == NULL) {
        qdot_pool_fail(pool);
        return false;
    }
    l->x = l->q + n;
    l->y = l->x + n;
    l->rest = l->y + n;
    l->solved = l->rest + n;
    l->A = l->solved + n;
    for (uint32_t i = 0; i < n; i++) {
        const qdot_expr velocity = qdot_symbol_jet(pool, q[i], 1), p = qdot_symbol_of(pool, QDOT_MOMENTUM, q[i]);

        l->q[i] = q[i];
        l->x[i] = of == QDOT_COORD ? velocity : p;
        l->y[i] = of == QDOT_COORD ? p : velocity;
    }
    find_hessian_blocks(l);
    if (qdot_pool_failed(pool) || !solve_linear_blocks(l))
        return false;
    for (uint32_t i = 0; i < n; i++)
        if (l->bent[i] && l->block[i] == i && !solve_bent_block(l, i))
            return false;
    return !qdot_pool_failed(pool);
}

void
qdot_legendre_end(qdot_legendre *l)
{
    qdot_free(l->q);
    qdot_free(l->block);
    qdot_free(l->bent);
    *l = (qdot_legendre){0};
}

/* --- the transform ------------------------------------------------------------------------ */

/* Add 1/2 (y - b).A^-1 (y - b) for one block of A, whose rows are which [m]; written as squares or by the inverse. */
static qdot_status
add_quadratic_block(qdot_legendre *l, qdot_squares *q, size_t m, const size_t *which)
{
    qdot_pool *pool = l->pool;
    qdot_expr inverse[9], v[3], sum = QDOT_ZERO;
    bool done = false;

    if (m == 1)
        return qdot_squares_add(
            q, qdot_div(pool, QDOT_ONE, l->A[which[0] * l->n + which[0]]),
            l->rest[which[0]]);
    for (size_t i = 0; i < m && m <= 3; i++) {
        v[i] = l->rest[which[i]];
        for (size_t k = 0; k < m; k++)
            inverse[i * m + k] = qdot_simplify(
                pool, qdot_diff(pool, l->solved[which[i]], l->y[which[k]]), &l->facts);
    }
    QDOT_TRY(qdot_pool_check(pool));
    if (m <= 3 && qdot_squares_worth(l->s, m, inverse))
        QDOT_TRY(qdot_squares_complete(q, m, inverse, v, &done));
    if (done)
        return QDOT_OK;
    for (size_t i = 0; i < m; i++)
        sum = qdot_add(pool, sum, qdot_mul(pool, l->rest[which[i]], l->solved[which[i]]));
    sum = qdot_simplify(pool, qdot_mul(pool, QDOT_HALF, sum), &l->facts);
    if (sum != QDOT_NIL && qdot_expr_kind(pool, sum) == QDOT_PROD)
        sum = qdot_common_out(pool, sum);
    q->rest = qdot_add(pool, q->rest, sum);
    return qdot_pool_check(pool);
}

/* The part of G that is not quadratic: that of the bent blocks, less F elsewhere at x = 0. */
static qdot_expr
rest_of_transform(qdot_legendre *l)
{
    qdot_pool *pool = l->pool;
    const bool stated = l->of == QDOT_MOMENTUM || l->s->lagrangian != QDOT_NIL;
    const qdot_expr F = at_zero(l, l->F_left);
    const qdot_expr apart = l->mixed ? qdot_legendre_terms_without(l->pool, l->F, l->n, l->x) : F;

    if (l->mixed)
        return qdot_sub(pool, qdot_simplify(pool, qdot_sub(pool, l->G_bent, qdot_sub(pool, F, apart)), &l->facts), apart);
    /* T - V is in simplified form already */
    return qdot_sub(pool, l->G_bent, stated ? qdot_simplify(pool, F, &l->facts) : F);
}

/* F is of second degree in the x of a block that is not bent: with b the slopes at x = 0
 *
 *     sum x y - F = 1/2 (y - b).A^-1 (y - b) - F at x = 0
 *
 * without terms that cancel. */
static qdot_expr
legendre_transform(qdot_legendre *l)
{
    qdot_pool *pool = l->pool;
    qdot_expr sum = QDOT_NIL;
    size_t *which = qdot_calloc((size_t)l->n + 1, sizeof *which);
    qdot_status status = which == NULL ? QDOT_ENOMEM : QDOT_OK;
    qdot_squares q;

    qdot_squares_begin(&q, l->s);
    for (size_t i = 0; i < l->n && status == QDOT_OK; i++) {
        size_t m = 0;

        for (size_t k = i; k < l->n && l->block[i] == i && !l->bent[i]; k++)
            if (l->block[k] == i)
                which[m++] = k;
        if (m > 0)
            status = add_quadratic_block(l, &q, m, which);
    }
    if (status == QDOT_OK)
        sum = qdot_common_out(pool, qdot_squares_sum(&q));
    qdot_squares_clear(&q);
    qdot_free(which);
    if (status != QDOT_OK)
        return qdot_pool_fail(pool);
    return qdot_add(pool, sum, rest_of_transform(l));
}

qdot_expr
qdot_legendre_of(qdot_scene *s, qdot_class of, qdot_expr F, uint32_t n, const qdot_expr *q)
{
    qdot_legendre l;
    const qdot_expr G = qdot_legendre_begin(&l, s, of, F, n, q) ? legendre_transform(&l) : QDOT_NIL;

    qdot_legendre_end(&l);
    return G;
}
