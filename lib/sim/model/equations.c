/* equations.c -- finds the blocks of the mass matrix M, and compiles the equations block by block. */
#include "sim/model/equations.h"

#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "sim/model/quotient.h"
#include "sim/model/substitute.h"
#include "tape/rounding.h"

size_t
qdot_plan_inputs(const qdot_plan *p)
{
    return 3 * p->n + 1 + p->m + p->n_sides;
}

bool
qdot_plan_needs_jacobian(const qdot_plan *p)
{
    return p->method->needs_jacobian
           || qdot_ode_method_find(p->method->partner)->needs_jacobian;
}

qdot_expr
qdot_plan_substitute(const qdot_plan *p, qdot_expr e)
{
    e = qdot_substitute(p->pool, e, p->n_values, p->symbols, p->values);
    if (p->rescaled && e != QDOT_NIL && (qdot_expr_node(p->pool, e)->holds & QDOT_HAS_MULTIPLIER))
        e = qdot_subs(p->pool, e, p->m, p->multipliers, p->scaled);
    return e;
}

qdot_status
qdot_plan_number(const qdot_plan *p, qdot_expr e, double *value, int *side, double *low)
{
    e = qdot_plan_substitute(p, e);
    QDOT_TRY(qdot_pool_check(p->pool));
    return qdot_constant_split(p->pool, e, value, side, low);
}

qdot_status
qdot_plan_of_part(const qdot_plan *of, size_t n, size_t more, qdot_plan **plan)
{
    qdot_plan *r = qdot_calloc(1, sizeof *r);

    *plan = r;
    if (!r)
        return QDOT_ENOMEM;
    r->pool = of->pool;
    r->n = n;
    r->method = of->method;
    r->chosen = of->chosen;
    r->indefinite = of->indefinite;
    r->smooth = of->smooth;
    r->leading = of->leading;
    r->inputs = qdot_calloc(3 * n + 1 + more, sizeof *r->inputs);
    r->names = qdot_calloc(n, sizeof *r->names);
    r->M = qdot_calloc(n * n, sizeof *r->M);
    r->f = qdot_calloc(n, sizeof *r->f);
    return r->inputs && r->names && r->M && r->f ? QDOT_OK : QDOT_ENOMEM;
}

/* --- blocks of the mass matrix ------------------------------------------------------ */

/* Find the blocks of M (coordinates that it couples) among the coordinates index [n]. */
static qdot_status
find_blocks(qdot_plan *p, size_t n, const size_t *index)
{
    bool *pattern = qdot_calloc(n * n + 1, sizeof *pattern);
    qdot_status status;

    if (!pattern)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n * n; i++)
        pattern[i] = p->M[index[i / n] * p->n + index[i % n]] != QDOT_ZERO;
    status = qdot_structure_find(pattern, n, &p->structure);
    for (size_t i = 0; status == QDOT_OK && i < n; i++) {
        bool some = false;

        for (size_t j = 0; j < n; j++)
            some |= pattern[i * n + j];
        if (!some)
            status = qdot_fail(QDOT_ESINGULAR,
                               "the mass matrix is singular: no mass moves with %s",
                               p->names[index[i]]);
    }
    qdot_free(pattern);
    for (size_t i = 0; status == QDOT_OK && i < n; i++)
        p->structure.index[i] = index[p->structure.index[i]];
    return status;
}

static qdot_expr
mass_matrix_entry(const qdot_plan *p, const qdot_plan_block *b, size_t i, size_t j)
{
    return p->M[b->index[i] * p->n + b->index[j]];
}

static qdot_status
fill_block(qdot_plan *p, qdot_plan_block *b)
{
    size_t n = b->n;

    b->constant = n > 1;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++)
            b->constant = b->constant && qdot_expr_is_constant(p->pool, mass_matrix_entry(p, b, i, j));
    if (!b->constant)
        return QDOT_OK;
    b->M = qdot_calloc(n * n, sizeof *b->M);
    b->side = qdot_calloc(n * n, sizeof *b->side);
    if (!b->M || !b->side)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) {
            int side;

            QDOT_TRY(qdot_constant_round(p->pool, mass_matrix_entry(p, b, i, j), &b->M[i * n + j],
                                         &side));
            b->side[i * n + j] = (signed char)side;
        }
    return QDOT_OK;
}

qdot_status
qdot_plan_structure(qdot_plan *p, const bool *in)
{
    size_t *index = qdot_calloc(p->n, sizeof *index), n = 0;
    qdot_status status = index ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; index && i < p->n; i++)
        if (!in || in[i])
            index[n++] = i;
    if (status == QDOT_OK)
        status = find_blocks(p, n, index);
    qdot_free(index);
    QDOT_TRY(status);
    p->blocks = qdot_calloc(p->structure.blocks + 1, sizeof *p->blocks);
    if (!p->blocks)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < p->structure.blocks; k++) {
        qdot_plan_block *b = p->blocks + k;

        b->index = p->structure.index + p->structure.start[k];
        b->n = p->structure.start[k + 1] - p->structure.start[k];
        QDOT_TRY(fill_block(p, b));
    }
    return QDOT_OK;
}

/* --- lowering to tapes -------------------------------------------------------------- */

typedef qdot_vec(qdot_expr) expressions;

static qdot_status
append_masses(const qdot_plan *p, const qdot_plan_block *b, expressions *out)
{
    for (size_t i = 0; i < b->n; i++)
        for (size_t j = 0; j <= i; j++)
            QDOT_TRY(qdot_vec_push(out, mass_matrix_entry(p, b, i, j)));
    return QDOT_OK;
}

static qdot_status
append_blocks(const qdot_plan *p, expressions *out)
{
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < p->structure.blocks && status == QDOT_OK; k++) {
        const qdot_plan_block *b = p->blocks + k;

        if (b->n == 1) {
            status = qdot_vec_push(
                out, qdot_quotient(p->pool, p->f[b->index[0]], mass_matrix_entry(p, b, 0, 0)));
            continue;
        }
        for (size_t i = 0; i < b->n && status == QDOT_OK; i++)
            status = qdot_vec_push(out, p->f[b->index[i]]);
        if (!b->constant && status == QDOT_OK)
            status = append_masses(p, b, out);
    }
    return status;
}

qdot_status
qdot_plan_lower(qdot_plan *p, size_t inputs, size_t more, const qdot_expr *others)
{
    expressions out = {0};
    qdot_status status = append_blocks(p, &out);

    for (size_t i = 0; i < more && status == QDOT_OK; i++)
        status = qdot_vec_push(&out, others[i]);
    if (status == QDOT_OK)
        status = qdot_pool_check(p->pool);
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, inputs, p->inputs, out.n, out.at, &p->tape);
    if (status == QDOT_OK)
        status = qdot_rounding_show(p->tape);
    qdot_free(out.at);
    return status;
}

qdot_status
qdot_plan_lower_for_series(qdot_plan *p)
{
    expressions out = {0};
    qdot_tape *tape = NULL;
    qdot_status status = append_blocks(p, &out);

    if (status == QDOT_OK)
        status = qdot_pool_check(p->pool);
    if (status == QDOT_OK)
        status = qdot_tape_new_for_series(p->pool, 2 * p->n + 1, p->inputs, out.n, out.at, &tape);
    qdot_free(out.at);
    if (status != QDOT_OK)
        return status;
    qdot_tape_free(p->tape);
    p->tape = tape;
    return qdot_rounding_show(p->tape);
}
