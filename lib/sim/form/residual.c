/* residual.c -- the functions of d'Alembert's residual as a tree, with derivatives, weights and tapes. */
#include "sim/form/residual.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "series/program.h"
#include "series/taylor.h"
#include "sim/form/blocks.h"
#include "tape/keymap.h"
#include "tape/rounding.h"

/* Among how many earlier functions the parent of a function is searched: at first, and at most. */
enum { near = 8, looked_at = 64 };

typedef struct {
    const qdot_plan *plan;
    qdot_residual *r;
    qdot_vec(qdot_expr) functions, outputs, forces;
    qdot_keymap place; /* maps each term of the sum recorded last to its position in that sum */
    bool slopes; /* derivatives of the differences are wanted */
    qdot_vec(qdot_expr) terms; /* the terms of a difference of two positions */
} builder;

void
qdot_residual_free(qdot_residual *r)
{
    if (!r)
        return;
    qdot_free(r->difference);
    qdot_free(r->applied);
    qdot_free(r->parent);
    qdot_free(r->weights);
    qdot_free(r->slopes);
    qdot_free(r->force);
    qdot_tape_free(r->places);
    qdot_tape_free(r->forces);
    qdot_tape_free(r->masses);
    qdot_tape_free(r->energy);
    qdot_tape_free(r->adjoint);
    qdot_tape_free(r->along);
    qdot_motion_clear(&r->motion);
    qdot_program_clear(&r->of_places);
    qdot_program_clear(&r->of_forces);
    qdot_free(r->absent);
    qdot_free(r);
}

/* Find the index of function e in the list of functions; a new function is appended. */
static qdot_status
find_or_add_function(builder *b, qdot_expr e, uint32_t *f)
{
    for (size_t i = b->functions.n; i-- > 0;)
        if (b->functions.at[i] == e) {
            *f = (uint32_t)i;
            return QDOT_OK;
        }
    *f = (uint32_t)b->functions.n;
    return qdot_vec_push(&b->functions, e);
}

/* Add a term of d'Alembert's principle: functions x, y, and the weight w of their product. */
static qdot_status
add_term(builder *b, qdot_expr x, qdot_expr y, qdot_expr w)
{
    qdot_residual_weight *weight = b->r->weights + b->r->n_weights++;
    int side;

    QDOT_TRY(find_or_add_function(b, x, &weight->from));
    QDOT_TRY(find_or_add_function(b, y, &weight->to));
    weight->exact = w;
    QDOT_TRY(qdot_constant_split(b->plan->pool, w, &weight->w, &side, &weight->low));
    weight->side = (signed char)side;
    return QDOT_OK;
}

/* Insert the parameter values into all terms at once, so that shared subexpressions are substituted once. */
static qdot_status
add_terms(builder *b, const qdot_dalembert_term *terms, size_t n)
{
    qdot_pool *pool = b->plan->pool;
    qdot_expr *all = qdot_calloc(3 * n, sizeof *all), list;
    qdot_status status;

    if (!all)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        all[3 * i] = terms[i].x;
        all[3 * i + 1] = terms[i].y;
        all[3 * i + 2] = terms[i].w;
    }
    list = qdot_plan_substitute(b->plan, qdot_list(pool, (uint32_t)(3 * n), all));
    qdot_free(all);
    status = qdot_pool_check(pool);
    for (uint32_t i = 0; i < n && status == QDOT_OK; i++)
        status =
            add_term(b, qdot_expr_arg(pool, list, 3 * i),
                     qdot_expr_arg(pool, list, 3 * i + 1), qdot_expr_arg(pool, list, 3 * i + 2));
    return status;
}

static uint32_t
terms_of(const qdot_pool *pool, qdot_expr e)
{
    return qdot_expr_kind(pool, e) == QDOT_SUM ? qdot_expr_count(pool, e) / 2 : 1;
}

static qdot_expr
term_at(const qdot_pool *pool, qdot_expr e, uint32_t i)
{
    return qdot_expr_arg(pool, e, 2 * i + 1);
}

static qdot_expr
factor_at(const qdot_pool *pool, qdot_expr e, uint32_t i)
{
    return qdot_expr_arg(pool, e, 2 * i + 2);
}

/* Record the position of each term of the sum e. */
static qdot_status
record_term_positions(builder *b, qdot_expr e)
{
    const uint32_t n = terms_of(b->plan->pool, e);

    qdot_keymap_clear(&b->place);
    for (uint32_t i = 0; i < n; i++)
        QDOT_TRY(qdot_keymap_set(&b->place, term_at(b->plan->pool, e, i), 0, 0, 0, i));
    return QDOT_OK;
}

static uint32_t
position_of_term(const builder *b, qdot_expr term)
{
    return qdot_keymap_get(&b->place, term, 0, 0, 0);
}

/* Terms that the difference of two sums has at least, but for those that differ by a factor; the
 * places of those of e are noted. More than `most`: some number beyond it. */
static size_t
least_different_terms(const builder *b, qdot_expr e, qdot_expr g, size_t most)
{
    const qdot_pool *pool = b->plan->pool;
    const uint32_t n = terms_of(pool, e), m = terms_of(pool, g);
    size_t apart = n > m ? n - m : 0; /* the number of different terms if all terms of g are also terms of e */

    if (qdot_expr_kind(pool, g) != QDOT_SUM)
        return n - 1;
    for (uint32_t k = 0, common = 0; k < m && apart <= most; k++) {
        const uint32_t i = position_of_term(b, term_at(pool, g, k));

        common += i != QDOT_KEYMAP_NONE && factor_at(pool, e, i) == factor_at(pool, g, k);
        apart = n + m > 2 * (common + (m - 1 - k)) ? n + m - 2 * (common + (m - 1 - k)) : 0;
    }
    return apart;
}

static qdot_status
append_term(builder *b, qdot_expr term, qdot_expr factor)
{
    return qdot_vec_push(&b->terms, qdot_mul(b->plan->pool, factor, term));
}

/* Find the difference *d = e - g of two sums in canonical order, from the terms that they do not share. */
static qdot_status
find_difference(builder *b, qdot_expr e, qdot_expr g, qdot_expr *d)
{
    qdot_pool *pool = b->plan->pool;
    const uint32_t n = terms_of(pool, e), m = terms_of(pool, g);
    uint32_t i = 0;

    if (qdot_expr_kind(pool, g) != QDOT_SUM) {
        *d = qdot_sub(pool, e, g);
        return qdot_pool_check(pool);
    }
    b->terms.n = 0;
    QDOT_TRY(append_term(b, qdot_sub(pool, qdot_expr_arg(pool, e, 0), qdot_expr_arg(pool, g, 0)),
                         QDOT_ONE));
    for (uint32_t k = 0; k < m; k++) {
        const qdot_expr term = term_at(pool, g, k);
        qdot_expr factor = qdot_neg(pool, factor_at(pool, g, k));
        const uint32_t at = position_of_term(b, term);

        for (; at != QDOT_KEYMAP_NONE && i < at; i++)
            QDOT_TRY(append_term(b, term_at(pool, e, i), factor_at(pool, e, i)));
        if (at != QDOT_KEYMAP_NONE)
            factor = qdot_add(pool, factor_at(pool, e, i++), factor);
        if (factor != QDOT_ZERO)
            QDOT_TRY(append_term(b, term, factor));
    }
    for (; i < n; i++)
        QDOT_TRY(append_term(b, term_at(pool, e, i), factor_at(pool, e, i)));
    *d = qdot_sum(pool, b->terms.n, b->terms.at);
    return qdot_pool_check(pool);
}

/* The parent that leaves the fewest terms, of those the shortest; far ones are looked at where
 * no near one leaves a single term. */
static qdot_status
choose_parent(builder *b, size_t f)
{
    qdot_pool *pool = b->plan->pool;
    qdot_expr e = b->functions.at[f], best = e;
    uint64_t shortest = qdot_expr_size(pool, e);
    size_t fewest = terms_of(pool, e);
    const size_t first = f > looked_at ? f - looked_at : 0;

    b->r->parent[f] = UINT32_MAX;
    if (qdot_expr_kind(pool, e) == QDOT_SUM)
        QDOT_TRY(record_term_positions(b, e));
    for (size_t i = f; i-- > first && qdot_expr_kind(pool, e) == QDOT_SUM;) {
        qdot_expr d;
        size_t terms;

        if (i + near < f && fewest == 1)
            break;
        if (least_different_terms(b, e, b->functions.at[i], fewest) > fewest)
            continue;
        QDOT_TRY(find_difference(b, e, b->functions.at[i], &d));
        terms = terms_of(pool, d);
        if (terms > fewest || (terms == fewest && qdot_expr_size(pool, d) >= shortest))
            continue;
        fewest = terms;
        shortest = qdot_expr_size(pool, d);
        best = d;
        b->r->parent[f] = (uint32_t)i;
    }
    b->r->difference[f] = best;
    return QDOT_OK;
}

static qdot_status
add_function_derivatives(builder *b, size_t f)
{
    const qdot_plan *p = b->plan;
    size_t capacity = b->r->n_slopes;
    qdot_expr atoms = qdot_expr_atoms(p->pool, b->r->difference[f], false);

    QDOT_TRY(qdot_pool_check(p->pool));
    for (size_t i = 0; i < p->n; i++) {
        qdot_expr slope;
        bool there = false;

        for (uint32_t k = 0; k < qdot_expr_count(p->pool, atoms) && !there; k++)
            there = qdot_expr_arg(p->pool, atoms, k) == p->inputs[i];
        if (!there)
            continue;
        slope = qdot_diff(p->pool, b->r->difference[f], p->inputs[i]);
        QDOT_TRY(qdot_pool_check(p->pool));
        if (slope == QDOT_ZERO)
            continue;
        QDOT_TRY(qdot_grow(&b->r->slopes, &capacity, b->r->n_slopes + 1,
                           sizeof *b->r->slopes));
        b->r->slopes[b->r->n_slopes++] =
            (qdot_residual_slope){(uint32_t)f, (uint32_t)i, (uint32_t)b->outputs.n};
        QDOT_TRY(qdot_vec_push(&b->outputs, slope));
    }
    return QDOT_OK;
}

static qdot_status
add_applied_forces(builder *b, qdot_expr Q)
{
    const qdot_plan *p = b->plan;

    Q = qdot_plan_substitute(p, Q);
    QDOT_TRY(qdot_pool_check(p->pool));
    for (size_t i = 0; i < p->n; i++) {
        qdot_expr e = b->r->applied[i] = qdot_expr_arg(p->pool, Q, (uint32_t)i);

        if (e == QDOT_ZERO) {
            b->r->force[i] = UINT32_MAX;
        } else if (qdot_expr_node(p->pool, e)->holds & QDOT_HAS_VELOCITY) {
            b->r->force[i] = QDOT_RESIDUAL_FORCES | (uint32_t)b->forces.n;
            QDOT_TRY(qdot_vec_push(&b->forces, e));
        } else {
            b->r->force[i] = (uint32_t)b->outputs.n;
            QDOT_TRY(qdot_vec_push(&b->outputs, e));
        }
    }
    return QDOT_OK;
}

static qdot_status
make_mass_tape_of_plan(builder *b)
{
    const qdot_plan *p = b->plan;
    qdot_vec(qdot_expr) out = {0};
    qdot_status status = QDOT_OK;

    if (!p->M)
        return QDOT_OK;
    for (size_t k = 0; k < p->structure.blocks; k++) {
        const qdot_plan_block *block = p->blocks + k;

        if (block->constant)
            continue;
        for (size_t i = 0; i < block->n; i++)
            for (size_t j = 0; j <= i && status == QDOT_OK; j++)
                status =
                    qdot_vec_push(&out, p->M[block->index[i] * p->n + block->index[j]]);
    }
    if (status == QDOT_OK)
        status =
            qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, out.n, out.at, &b->r->masses);
    qdot_free(out.at);
    return status;
}

static qdot_status
residual_build(builder *b, const qdot_dalembert_term *terms, size_t n, qdot_expr Q)
{
    const qdot_plan *p = b->plan;
    qdot_residual *r = b->r;

    r->weights = qdot_calloc(n, sizeof *r->weights);
    r->applied = qdot_calloc(p->n, sizeof *r->applied);
    r->force = qdot_calloc(p->n, sizeof *r->force);
    if (!r->weights || !r->applied || !r->force)
        return QDOT_ENOMEM;
    QDOT_TRY(add_terms(b, terms, n));
    r->functions = b->functions.n;
    r->parent = qdot_calloc(r->functions, sizeof *r->parent);
    r->difference = qdot_calloc(r->functions, sizeof *r->difference);
    if (!r->parent || !r->difference)
        return QDOT_ENOMEM;
    for (size_t f = 0; f < r->functions; f++)
        QDOT_TRY(choose_parent(b, f));
    for (size_t f = 0; f < r->functions; f++)
        QDOT_TRY(qdot_vec_push(&b->outputs, b->r->difference[f]));
    for (size_t f = 0; f < r->functions && b->slopes; f++)
        QDOT_TRY(add_function_derivatives(b, f));
    QDOT_TRY(add_applied_forces(b, Q));
    QDOT_TRY(qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, b->outputs.n, b->outputs.at,
                           &r->places));
    QDOT_TRY(qdot_rounding_show(r->places));
    if (b->forces.n > 0) {
        QDOT_TRY(qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, b->forces.n,
                               b->forces.at, &r->forces));
        QDOT_TRY(qdot_rounding_show(r->forces));
    }
    return make_mass_tape_of_plan(b);
}

qdot_status
qdot_residual_of_terms(const qdot_plan *plan, size_t n, const qdot_dalembert_term *terms, qdot_expr Q, bool slopes,
                       qdot_residual **residual)
{
    builder b = {.plan = plan, .slopes = slopes};
    qdot_status status;

    *residual = NULL;
    b.r = qdot_calloc(1, sizeof *b.r);
    status = b.r ? residual_build(&b, terms, n, Q) : QDOT_ENOMEM;
    qdot_free(b.functions.at);
    qdot_keymap_clear(&b.place);
    qdot_free(b.terms.at);
    qdot_free(b.outputs.at);
    qdot_free(b.forces.at);
    if (status == QDOT_OK && (qdot_program_hindrance(b.r->places) ||
                              (b.r->forces && qdot_program_hindrance(b.r->forces)))) {
        qdot_residual_free(b.r);
        return QDOT_OK;
    }
    if (status != QDOT_OK) {
        qdot_residual_free(b.r);
        return status;
    }
    *residual = b.r;
    return QDOT_OK;
}

qdot_status
qdot_residual_new(qdot_scene *scene, const qdot_plan *plan, qdot_residual **residual)
{
    qdot_dalembert_term *terms;
    qdot_expr Q;
    size_t n;
    qdot_status status = QDOT_OK;

    *residual = NULL;
    QDOT_TRY(qdot_mech_dalembert(scene, &terms, &n, &Q));
    if (n > 0)
        status = qdot_residual_of_terms(plan, n, terms, Q, true, residual);
    qdot_free(terms);
    return status;
}

qdot_status
qdot_residual_programs(qdot_residual *r)
{
    if (r->of_places.rows.n > 0)
        return QDOT_OK;
    QDOT_TRY(qdot_program_init(r->places, qdot_tape_inputs(r->places), false, &r->of_places));
    return r->forces ? qdot_program_init(r->forces, qdot_tape_inputs(r->forces), false,
                                         &r->of_forces)
                     : QDOT_OK;
}

/* --- evaluation of the tapes ----------------------------------------------------------- */

void
qdot_residual_forces(const qdot_residual *r, const double *weight, double *x, double *F)
{
    for (size_t f = 0; f < r->functions; f++) {
        if (r->parent[f] != UINT32_MAX)
            x[f] += x[r->parent[f]];
        F[f] = 0;
    }
    for (size_t w = 0; w < r->n_weights; w++)
        F[r->weights[w].to] += weight[w] * x[r->weights[w].from];
    for (size_t f = r->functions; f-- > 0;)
        if (r->parent[f] != UINT32_MAX)
            F[r->parent[f]] += F[f];
}

void
qdot_residual_masses(const qdot_residual *r, size_t n, const double *weight,
                     const double *const *slope, double *x, double *F, double *M)
{
    for (size_t i = 0; i < n; i++) {
        memset(x, 0, r->functions * sizeof *x);
        for (size_t j = 0; j < r->n_slopes; j++)
            if (r->slopes[j].coordinate == i)
                x[r->slopes[j].function] = slope[j][0];
        qdot_residual_forces(r, weight, x, F);
        for (size_t j = 0; j < r->n_slopes; j++)
            M[r->slopes[j].coordinate * n + i] += slope[j][0] * F[r->slopes[j].function];
    }
}
