/* parts.c -- finds groups of coordinates that are decoupled: their equations share no variable. */
#include "sim/plan/parts.h"

#include <string.h>

#include "expr/node.h"
#include "expr/walk.h"
#include "sim/form/derived.h"
#include "sim/plan/form.h"
#include "sim/plan/routh.h"

/* Parts cannot use d'Alembert's form. If that form of the whole is cheaper than all parts by this
 * factor, the scene is not divided. */
static const double worth = 2;

/* Unite the groups of coordinates i and j; group [n] is the first coordinate of each coordinate's group. */
static void
unite_groups(size_t *group, size_t n, size_t i, size_t j)
{
    const size_t low = group[i] < group[j] ? group[i] : group[j];
    const size_t high = group[i] < group[j] ? group[j] : group[i];

    for (size_t k = 0; k < n; k++)
        if (group[k] == high)
            group[k] = low;
}

/* Merge the group of coordinate i with those of all coordinates that occur in e. */
static qdot_status
unite_with_coordinates_in(const qdot_plan *p, size_t *group, size_t i, qdot_expr e)
{
    qdot_expr atoms = qdot_expr_atoms(p->pool, e, false);

    QDOT_TRY(qdot_pool_check(p->pool));
    for (size_t j = 0; j < p->n; j++)
        for (uint32_t k = 0; k < qdot_expr_count(p->pool, atoms); k++) {
            qdot_expr x = qdot_expr_arg(p->pool, atoms, k);

            if (x == p->inputs[j] || x == p->inputs[p->n + j])
                unite_groups(group, p->n, i, j);
        }
    return QDOT_OK;
}

/* Find the groups of coupled coordinates; *groups: their number. */
static qdot_status
find_groups(const qdot_plan *p, size_t *group, size_t *groups)
{
    const size_t n = p->n;

    for (size_t i = 0; i < n; i++)
        group[i] = i;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            if (p->M[i * n + j] != QDOT_ZERO)
                unite_groups(group, n, i, j);
    *groups = 1;
    for (size_t i = 1; i < n; i++)
        *groups += group[i] == i;
    /* test M first: in most scenes it already couples all coordinates */
    for (size_t i = 0; i < n && *groups > 1; i++) {
        QDOT_TRY(unite_with_coordinates_in(p, group, i, p->f[i]));
        for (size_t j = 0; j <= i; j++)
            if (p->M[i * n + j] != QDOT_ZERO)
                QDOT_TRY(unite_with_coordinates_in(p, group, i, p->M[i * n + j]));
        *groups = 1;
        for (size_t k = 1; k < n; k++)
            *groups += group[k] == k;
    }
    return QDOT_OK;
}

/* Fill the plan r with the equations of the n coordinates `index` of the plan p. */
static qdot_status
fill_part(const qdot_plan *p, size_t n, const size_t *index, qdot_plan *r)
{
    r->place = qdot_calloc(n, sizeof *r->place);
    r->symbols = qdot_calloc(p->n_values + 1, sizeof *r->symbols);
    r->values = qdot_calloc(p->n_values + 1, sizeof *r->values);
    if (!r->place || !r->symbols || !r->values)
        return QDOT_ENOMEM;
    memcpy(r->symbols, p->symbols, p->n_values * sizeof *r->symbols);
    memcpy(r->values, p->values, p->n_values * sizeof *r->values);
    r->n_values = p->n_values;
    r->inputs[2 * n] = QDOT_T;
    for (size_t i = 0; i < n; i++) {
        r->place[i] = index[i];
        r->inputs[i] = p->inputs[index[i]];
        r->inputs[n + i] = p->inputs[p->n + index[i]];
        r->inputs[2 * n + 1 + i] = p->inputs[2 * p->n + 1 + index[i]];
        r->f[i] = p->f[index[i]];
        for (size_t j = 0; j < n; j++)
            r->M[i * n + j] = p->M[index[i] * p->n + index[j]];
        r->names[i] = qdot_strdup(p->names[index[i]]);
        if (!r->names[i])
            return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

static qdot_status
finish_part(qdot_plan *r, qdot_scene *scene, const qdot_run_request *request)
{
    QDOT_TRY(qdot_plan_structure(r, NULL));
    QDOT_TRY(qdot_plan_lower(r, 2 * r->n + 1, 0, NULL));
    if (r->smooth)
        QDOT_TRY(qdot_plan_measure(r));
    return qdot_routh_reduce(r, scene, request);
}

static qdot_status
make_part(qdot_plan *p, qdot_scene *scene, const qdot_run_request *request,
          const size_t *group, size_t first)
{
    size_t *index = qdot_calloc(p->n, sizeof *index), n = 0;
    qdot_plan *r = NULL;
    qdot_status status = QDOT_ENOMEM;

    for (size_t i = first; index && i < p->n; i++)
        if (group[i] == first)
            index[n++] = i;
    if (index)
        status = qdot_plan_of_part(p, n, 0, &r);
    if (r)
        p->parts[p->n_parts++] = r;
    if (status == QDOT_OK)
        status = fill_part(p, n, index, r);
    qdot_free(index);
    return status == QDOT_OK ? finish_part(r, scene, request) : status;
}

/* The computing cost of one step of every decoupled part together. */
static double
cost_of_parts(const qdot_plan *p)
{
    double sum = 0;

    for (size_t k = 0; k < p->n_parts; k++)
        sum += p->parts[k]->reduced ? p->parts[k]->reduced->cost : p->parts[k]->cost;
    return sum;
}

qdot_status
qdot_parts_find(qdot_plan *p, qdot_scene *scene, const qdot_run_request *request)
{
    size_t *group = qdot_calloc(p->n, sizeof *group), groups = 0;
    qdot_status status = group ? find_groups(p, group, &groups) : QDOT_ENOMEM;

    if (status == QDOT_OK && groups > 1) {
        p->parts = qdot_calloc(groups, sizeof *p->parts);
        if (!p->parts)
            status = QDOT_ENOMEM;
        for (size_t i = 0; i < p->n && status == QDOT_OK; i++)
            if (group[i] == i)
                status = make_part(p, scene, request, group, i);
    }
    qdot_free(group);
    if (status == QDOT_OK && p->residual && !p->reduced && cost_of_parts(p) > worth * p->cost) {
        for (size_t k = 0; k < p->n_parts; k++)
            qdot_plan_free(p->parts[k]);
        p->n_parts = 0;
    }
    return status;
}
