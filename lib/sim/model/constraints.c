/* constraints.c -- compiles f, its time derivatives and its gradient for every constraint f = 0. */
#include "sim/model/constraints.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/walk.h"
#include "mech/dynamics/integrated.h"
#include "sim/model/massless.h"
#include "sim/model/rates.h"
#include "sim/model/switch.h"
#include "tape/rounding.h"

typedef qdot_vec(qdot_expr) expressions;

typedef struct {
    const qdot_plan *plan;
    qdot_constraints *c;
    expressions positions, velocities, slopes, gamma, masses, metric, scale;
} builder;

void
qdot_constraints_free(qdot_constraints *c)
{
    if (!c)
        return;
    for (size_t k = 0; c->rows && k < c->m; k++)
        qdot_free(c->rows[k].name);
    qdot_free(c->rows);
    qdot_free(c->masses);
    qdot_free(c->slopes);
    qdot_free(c->sign);
    qdot_free(c->A);
    qdot_free(c->gamma);
    qdot_tape_free(c->positions);
    qdot_tape_free(c->scale);
    qdot_tape_free(c->velocities);
    qdot_tape_free(c->metric);
    qdot_tape_free(c->equations);
    qdot_tape_free(c->series);
    qdot_motion_clear(&c->motion);
    qdot_free(c);
}

/* --- equations of one constraint ---------------------------------------------------- */

/* Coordinate i, its velocity or acceleration: the variable that a constraint of the given kind restricts. */
static qdot_expr
restricted_variable(const qdot_plan *p, size_t i, qdot_constraint_kind kind)
{
    static const size_t block[] = {[QDOT_HOLONOMIC] = 0, [QDOT_VELOCITY] = 1};

    if (kind == QDOT_ACCELERATION)
        return p->inputs[2 * p->n + 1 + i];
    return p->inputs[block[kind] * p->n + i];
}

static qdot_status
add_gradient(builder *b, size_t k)
{
    const qdot_plan *p = b->plan;
    const qdot_constraints_row *row = b->c->rows + k;
    qdot_expr atoms = qdot_expr_atoms(p->pool, row->f, false);
    size_t capacity = b->c->n_slopes;

    QDOT_TRY(qdot_pool_check(p->pool));
    for (size_t i = 0; i < p->n - p->n_states; i++) {
        qdot_expr x = restricted_variable(p, i, row->kind), slope;
        bool there = false;

        for (uint32_t a = 0; a < qdot_expr_count(p->pool, atoms) && !there; a++)
            there = qdot_expr_arg(p->pool, atoms, a) == x;
        if (!there)
            continue;
        slope = qdot_diff(p->pool, row->f, x);
        QDOT_TRY(qdot_pool_check(p->pool));
        if (slope == QDOT_ZERO)
            continue;
        QDOT_TRY(qdot_grow(&b->c->slopes, &capacity, b->c->n_slopes + 1,
                           sizeof *b->c->slopes));
        b->c->slopes[b->c->n_slopes++] =
            (qdot_constraints_entry){(uint32_t)k, (uint32_t)i};
        QDOT_TRY(qdot_vec_push(&b->slopes, slope));
    }
    return QDOT_OK;
}

/* In e, replace by 0 the time derivatives of parameters that events set. */
static qdot_expr
without_parameter_rates(const qdot_plan *p, qdot_expr e)
{
    for (size_t i = p->n - p->n_states; i < p->n && e != QDOT_NIL; i++) {
        const qdot_expr zero = QDOT_ZERO;

        e = qdot_subs(p->pool, e, 1, &p->inputs[p->n + i], &zero);
    }
    return e;
}

/* Add the residuals of constraint k, and gamma = -(its last time derivative at q'' = 0). */
static qdot_status
add_derivatives(builder *b, size_t k)
{
    const qdot_plan *p = b->plan;
    const qdot_constraints_row *row = b->c->rows + k;
    qdot_expr f = row->f, rest, *zeros;

    if (row->kind == QDOT_HOLONOMIC) {
        QDOT_TRY(qdot_vec_push(&b->positions, f));
        f = without_parameter_rates(p, qdot_ddt(p->pool, f));
    }
    if (row->kind != QDOT_ACCELERATION) {
        QDOT_TRY(qdot_pool_check(p->pool));
        QDOT_TRY(qdot_vec_push(&b->velocities, f));
        f = without_parameter_rates(p, qdot_ddt(p->pool, f));
    }
    QDOT_TRY(qdot_pool_check(p->pool));
    zeros = qdot_calloc(p->n, sizeof *zeros);
    if (!zeros)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < p->n; i++)
        zeros[i] = QDOT_ZERO;
    rest = qdot_subs(p->pool, f, p->n, p->inputs + 2 * p->n + 1, zeros);
    qdot_free(zeros);
    if (row->kind == QDOT_HOLONOMIC) {
        qdot_expr shared;

        QDOT_TRY(qdot_rates_second(p->pool, row->f, &shared));
        if (shared != QDOT_NIL)
            rest = without_parameter_rates(p, shared);
    }
    rest = qdot_neg(p->pool, rest);
    QDOT_TRY(qdot_pool_check(p->pool));
    return qdot_vec_push(&b->gamma, rest);
}

static qdot_status
read_constraints(builder *b, qdot_scene *scene)
{
    const qdot_plan *p = b->plan;
    qdot_constraints *c = b->c;

    c->rows = qdot_calloc(scene->constraints.n + p->n_massless, sizeof *c->rows);
    if (!c->rows)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < scene->constraints.n; k++) {
        const qdot_constraint *from = scene->constraints.at + k;
        qdot_constraints_row *row = c->rows + k;
        qdot_expr mu;

        c->m++;
        row->name = qdot_strdup(from->name);
        row->kind = from->kind;
        row->multiplier = from->multiplier;
        c->count[row->kind]++;
        row->f = qdot_plan_substitute(p, qdot_integrated_rate(scene, k, &mu));
        if (!row->name)
            return QDOT_ENOMEM;
        QDOT_TRY(qdot_pool_check(p->pool));
        if (p->mode)
            QDOT_TRY(qdot_switches_freeze(p->mode, p->side, p->share, 1, &row->f, &row->f));
        QDOT_TRY(add_gradient(b, k));
        QDOT_TRY(add_derivatives(b, k));
        QDOT_TRY(qdot_vec_push(&b->scale, qdot_plan_substitute(p, mu)));
    }
    return QDOT_OK;
}

/* Add the equations of massless coordinates as constraints. */
static qdot_status
add_massless_equations(builder *b)
{
    const qdot_plan *p = b->plan;
    qdot_constraints *c = b->c;

    for (size_t i = 0; i < p->n && p->massless; i++) {
        const size_t k = c->m;
        qdot_constraints_row *row = c->rows + k;
        qdot_text name = {0};

        if (!p->massless[i])
            continue;
        c->m++;
        qdot_text_format(&name, "equation of %s", p->names[i]);
        row->name = qdot_strdup(qdot_text_str(&name));
        qdot_text_clear(&name);
        row->kind = qdot_massless_kind(p, i);
        row->multiplier = QDOT_NIL;
        c->count[row->kind]++;
        row->f = p->f[i];
        if (!row->name)
            return QDOT_ENOMEM;
        QDOT_TRY(add_gradient(b, k));
        QDOT_TRY(add_derivatives(b, k));
    }
    return QDOT_OK;
}

/* Give massless coordinates so little mass in the metric that a projection moves only them onto
 * their equations. */
static qdot_status
list_mass_entries(builder *b)
{
    const qdot_plan *p = b->plan;
    const qdot_expr light = qdot_expr_ratio(p->pool, 1, INT64_C(1) << 60);
    size_t capacity = 0;

    for (size_t i = 0; i < p->n; i++)
        for (size_t j = 0; j <= i; j++) {
            const qdot_expr entry = p->M[i * p->n + j];
            const bool massless = i == j && p->massless && p->massless[i];

            if (entry == QDOT_ZERO && !massless)
                continue;
            QDOT_TRY(qdot_grow(&b->c->masses, &capacity, b->c->n_masses + 1,
                               sizeof *b->c->masses));
            b->c->masses[b->c->n_masses++] =
                (qdot_constraints_entry){(uint32_t)i, (uint32_t)j};
            QDOT_TRY(qdot_vec_push(&b->masses, entry));
            QDOT_TRY(qdot_vec_push(&b->metric, massless ? light : entry));
        }
    return QDOT_OK;
}

/* --- lowering to tapes -------------------------------------------------------------- */

static qdot_status
append_all(expressions *to, size_t n, const qdot_expr *from)
{
    for (size_t i = 0; i < n; i++)
        QDOT_TRY(qdot_vec_push(to, from[i]));
    return QDOT_OK;
}

static qdot_status
make_tape(const qdot_plan *p, const expressions *out, qdot_tape **tape)
{
    return qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, out->n, out->at, tape);
}

static qdot_status
make_acceleration_tape(builder *b)
{
    const qdot_plan *p = b->plan;
    expressions out = {0};
    qdot_status status = append_all(&out, b->metric.n, b->metric.at);

    if (status == QDOT_OK)
        status = append_all(&out, b->slopes.n, b->slopes.at);
    if (status == QDOT_OK)
        status = make_tape(p, &out, &b->c->metric);
    out.n = 0;
    if (status == QDOT_OK)
        status = append_all(&out, p->n, p->f);
    if (status == QDOT_OK)
        status = append_all(&out, b->masses.n, b->masses.at);
    if (status == QDOT_OK)
        status = append_all(&out, b->slopes.n, b->slopes.at);
    if (status == QDOT_OK)
        status = append_all(&out, b->gamma.n, b->gamma.at);
    if (status == QDOT_OK)
        status = make_tape(p, &out, &b->c->equations);
    if (status == QDOT_OK)
        status = qdot_rounding_show(b->c->equations);
    qdot_free(out.at);
    return status;
}

/* A slope that is an earlier one of its row, negated, is that one: where both are
 * multiplied by the row's multiplier it is done once. */
static qdot_status
find_signs_of_gradients(builder *b)
{
    qdot_constraints *c = b->c;

    c->sign = qdot_calloc(c->n_slopes + 1, sizeof *c->sign);
    if (!c->sign)
        return QDOT_ENOMEM;
    for (size_t s = 0; s < c->n_slopes; s++) {
        const qdot_expr negated = qdot_neg(b->plan->pool, b->slopes.at[s]);

        c->sign[s] = 1;
        for (size_t i = s; i-- > 0 && c->slopes[i].row == c->slopes[s].row;)
            if (b->slopes.at[i] == negated && c->sign[i] > 0)
                c->sign[s] = -1;
        if (c->sign[s] < 0)
            b->slopes.at[s] = negated;
    }
    return qdot_pool_check(b->plan->pool);
}

/* Compile the tape from which Taylor series are made; call after find_signs_of_gradients. */
static qdot_status
make_series_tape(builder *b)
{
    expressions out = {0};
    qdot_status status = append_all(&out, b->plan->n, b->plan->f);

    if (status == QDOT_OK)
        status = append_all(&out, b->masses.n, b->masses.at);
    if (status == QDOT_OK)
        status = append_all(&out, b->slopes.n, b->slopes.at);
    for (size_t k = 0; k < b->c->m && status == QDOT_OK; k++)
        status = qdot_vec_push(&out, b->c->rows[k].kind == QDOT_ACCELERATION
                                         ? b->gamma.at[k]
                                         : b->c->rows[k].f);
    if (status == QDOT_OK)
        status = make_tape(b->plan, &out, &b->c->series);
    qdot_free(out.at);
    return status;
}

/* Keep A and gamma as expressions, for symbolic elimination and other forms of the equations. */
static qdot_status
keep_expressions(builder *b)
{
    qdot_constraints *c = b->c;

    c->A = qdot_calloc(c->n_slopes + 1, sizeof *c->A);
    c->gamma = qdot_calloc(c->m, sizeof *c->gamma);
    if (!c->A || !c->gamma)
        return QDOT_ENOMEM;
    if (c->n_slopes > 0)
        memcpy(c->A, b->slopes.at, c->n_slopes * sizeof *c->A);
    memcpy(c->gamma, b->gamma.at, c->m * sizeof *c->gamma);
    return QDOT_OK;
}

static qdot_status
constraints_build(builder *b, qdot_scene *scene)
{
    QDOT_TRY(read_constraints(b, scene));
    QDOT_TRY(add_massless_equations(b));
    QDOT_TRY(keep_expressions(b));
    QDOT_TRY(list_mass_entries(b));
    QDOT_TRY(make_tape(b->plan, &b->positions, &b->c->positions));
    QDOT_TRY(make_tape(b->plan, &b->velocities, &b->c->velocities));
    if (b->plan->rescaled)
        QDOT_TRY(make_tape(b->plan, &b->scale, &b->c->scale));
    QDOT_TRY(make_acceleration_tape(b));
    QDOT_TRY(find_signs_of_gradients(b)); /* must be last: it negates gradients, which only make_series_tape expects */
    return make_series_tape(b);
}

qdot_status
qdot_constraints_new(qdot_scene *scene, const qdot_plan *plan,
                     qdot_constraints **constraints)
{
    builder b = {.plan = plan};
    qdot_status status;

    *constraints = NULL;
    if (scene->constraints.n + plan->n_massless == 0)
        return QDOT_OK;
    b.c = qdot_calloc(1, sizeof *b.c);
    status = b.c ? constraints_build(&b, scene) : QDOT_ENOMEM;
    qdot_free(b.positions.at);
    qdot_free(b.velocities.at);
    qdot_free(b.slopes.at);
    qdot_free(b.gamma.at);
    qdot_free(b.masses.at);
    qdot_free(b.scale.at);
    qdot_free(b.metric.at);
    if (status != QDOT_OK) {
        qdot_constraints_free(b.c);
        return status;
    }
    *constraints = b.c;
    return QDOT_OK;
}
