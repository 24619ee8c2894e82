/* equilibrium-curve.c -- the equations of equilibrium, and of motion near it, with one free parameter. */
#include "mech/study/equilibrium-curve.h"

#include <math.h>

#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/generic.h"
#include "mech/dynamics/quantity.h"
#include "mech/scene/access.h"

/* --- what can be followed ---------------------------------------------------------------- */

static qdot_status
check_scene(qdot_equilibrium_curve *c)
{
    const qdot_scene *s = c->s;

    for (size_t k = 0; k < s->constraints.n; k++)
        if (s->constraints.at[k].kind != QDOT_HOLONOMIC)
            return qdot_fail(QDOT_ETYPE, "equilibria are followed under holonomic constraints; "
                                         "this scene has others");
    if ((qdot_mech_holds(s, c->rest.system.equations) & QDOT_HAS_TIME) != 0)
        return qdot_fail(QDOT_ETYPE, "the equations depend on time: there are no equilibria to "
                                     "follow");
    return QDOT_OK;
}

static qdot_status
check_number_of_equations(qdot_equilibrium_curve *c)
{
    const uint32_t equations = qdot_expr_count(c->pool, c->rest.system.equations);

    c->n = c->rest.system.unknowns.n;
    c->coordinates = c->rest.system.places;
    if (c->coordinates == 0)
        return qdot_fail(QDOT_EFAILED, "the equations of equilibrium contain no coordinate: %s",
                         equations == 0 ? "every place is an equilibrium"
                                        : "there is no equilibrium");
    if (equations != c->n)
        return qdot_fail(QDOT_EFAILED,
                         "the equilibria are no curves: %u equations for %zu unknowns", equations,
                         c->n);
    return QDOT_OK;
}

/* An error if the parameter has no influence: on the equations at rest, on the ends of domains, or on the motion near a
 * rest. */
static qdot_status
check_parameter_influence(const qdot_equilibrium_curve *c)
{
    bool some = c->moving;

    for (size_t i = 0; i < c->n; i++)
        some = some || qdot_expr_contains(c->pool, c->F[i], c->parameter);
    for (size_t i = 0; i < 3 * c->all * c->all; i++)
        some = some || qdot_expr_contains(c->pool, c->K[i], c->parameter);
    if (some)
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "%.100s has no influence on the equilibria",
                    qdot_expr_symbol(c->pool, c->parameter)->name);
    return qdot_hint("equilibria");
}

/* --- equations of rest and of motion ------------------------------------------------------- */

/* An end of the domain of a symbol; *v is unchanged if there is none. *moving: the end, if it
 * depends on the parameter. */
static qdot_status
curve_domain_end(const qdot_equilibrium_curve *c, const qdot_symbol *of, qdot_expr e, double *v, qdot_expr *moving)
{
    if (e == QDOT_NIL)
        return QDOT_OK;
    e = c->bind(c->user, e);
    QDOT_TRY(qdot_pool_check(c->pool));
    if (qdot_expr_contains(c->pool, e, c->parameter)) {
        qdot_expr zero = QDOT_ZERO;

        *moving = e;
        e = qdot_subs(c->pool, e, 1, &c->parameter, &zero); /* the bound e with the parameter set to 0 */
        if (e == QDOT_NIL)
            return qdot_pool_check(c->pool) == QDOT_EDOMAIN ? QDOT_OK : qdot_pool_check(c->pool);
        if ((qdot_expr_node(c->pool, e)->holds & ~(uint32_t)QDOT_HAS_FUN) == 0)
            return QDOT_OK;
    }
    if ((qdot_expr_node(c->pool, e)->holds & ~(uint32_t)QDOT_HAS_FUN) != 0)
        return qdot_fail(QDOT_EINVAL, "an end of the domain of %.100s has no value", of->name);
    return qdot_generic_evaluate(c->pool, 1, &e, NULL, v);
}

static qdot_status
allocate_curve(qdot_equilibrium_curve *c)
{
    const size_t n = c->n, all = c->s->coordinates.n + c->s->constraints.n;

    c->all = all;
    c->unknown = qdot_calloc(2 * n + 1, sizeof *c->unknown);
    c->angle = qdot_calloc(n + 1, sizeof *c->angle);
    c->lo = qdot_calloc(2 * n + 2, sizeof *c->lo);
    c->K = qdot_calloc(3 * all * all + 1, sizeof *c->K);
    c->roots.re = qdot_calloc(4 * all + 1, sizeof *c->roots.re);
    if (!c->unknown || !c->angle || !c->lo || !c->K || !c->roots.re)
        return QDOT_ENOMEM;
    c->end = qdot_calloc(2 * n + 2, sizeof *c->end);
    if (c->end == NULL)
        return QDOT_ENOMEM;
    c->F = c->unknown + n + 1;
    c->hi = c->lo + n + 1;
    c->Gamma = c->K + all * all;
    c->M = c->Gamma + all * all;
    c->roots.im = c->roots.re + 2 * all;
    return QDOT_OK;
}

static qdot_status
fill_equations(qdot_equilibrium_curve *c)
{
    for (size_t i = 0; i < c->n; i++) {
        c->unknown[i] = c->rest.system.unknowns.at[i];
        c->F[i] = c->bind(c->user, qdot_expr_arg(c->pool, c->rest.system.equations, (uint32_t)i));
    }
    c->unknown[c->n] = c->parameter;
    QDOT_TRY(qdot_pool_check(c->pool));
    for (size_t i = 0; i <= c->n; i++) {
        const qdot_symbol q = *qdot_expr_symbol(c->pool, c->unknown[i]);

        c->lo[i] = -INFINITY;
        c->hi[i] = INFINITY;
        QDOT_TRY(curve_domain_end(c, &q, q.lo, &c->lo[i], &c->end[2 * i]));
        QDOT_TRY(curve_domain_end(c, &q, q.hi, &c->hi[i], &c->end[2 * i + 1]));
        c->moving = c->moving || c->end[2 * i] != QDOT_NIL || c->end[2 * i + 1] != QDOT_NIL;
        if (i < c->coordinates && q.lo == QDOT_NIL && q.hi == QDOT_NIL && isinf(c->lo[i]) && isinf(c->hi[i]))
            c->angle[i] = qdot_is_angle(c->pool, c->rest.system.equations, c->unknown[i], &c->rest.facts);
    }
    return qdot_pool_check(c->pool);
}

double
qdot_equilibrium_curve_end_of(const qdot_equilibrium_curve *c, size_t i, bool upper, double p)
{
    const qdot_expr e = c->end[2 * i + upper];
    double value = NAN;

    if (e == QDOT_NIL)
        return upper ? c->hi[i] : c->lo[i];
    return qdot_generic_evaluate(c->pool, 1, &e, &(qdot_generic_point){1, &c->parameter, &p, 1}, &value) == QDOT_OK
               ? value
               : NAN;
}

/* The expression e at rest; coordinates that do not occur in the equations at rest are set to 0. */
static qdot_expr
value_at_rest(const qdot_equilibrium_curve *c, qdot_expr e)
{
    const qdot_scene *s = c->s;

    for (size_t i = 0; i < s->coordinates.n; i++) {
        const qdot_expr jets[3] = {qdot_mech_jet(c->s, i, 1), qdot_mech_jet(c->s, i, 2),
                                   s->coordinates.at[i]};
        const qdot_expr zero[3] = {QDOT_ZERO, QDOT_ZERO, QDOT_ZERO};
        size_t m = 3;

        for (size_t k = 0; k < c->coordinates; k++)
            if (c->unknown[k] == s->coordinates.at[i])
                m = 2;
        e = e == QDOT_NIL ? e : qdot_subs(c->pool, e, m, jets, zero);
    }
    return e;
}

/* Fill the matrices K, Gamma, M of the linearised motion, from which stability is judged. */
static qdot_status
fill_linear_motion(qdot_equilibrium_curve *c)
{
    const size_t n = c->s->coordinates.n, m = c->s->constraints.n, all = c->all;
    const qdot_expr *slopes = qdot_stability_slopes(c->judge->numbers);

    for (size_t i = 0; i < 3 * all * all; i++)
        c->K[i] = QDOT_ZERO;
    c->damped = true;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            const size_t to = i * all + j, from = i * n + j;

            c->M[to] = value_at_rest(c, slopes[from]);
            c->K[to] = value_at_rest(c, slopes[2 * n * n + from]);
            QDOT_TRY(qdot_pool_check(c->pool));
            c->Gamma[to] = value_at_rest(c, slopes[n * n + from]);
            if (c->Gamma[to] == QDOT_NIL) {
                c->damped = false;
                c->Gamma[to] = QDOT_ZERO;
                if (qdot_pool_check(c->pool) != QDOT_EDOMAIN)
                    return qdot_pool_check(c->pool);
            }
        }
        for (size_t k = 0; k < m; k++) {
            const qdot_expr a = value_at_rest(c, slopes[3 * n * n + k * n + i]);

            c->K[i * all + n + k] = c->K[(n + k) * all + i] = a;
        }
    }
    return qdot_pool_check(c->pool);
}

qdot_status
qdot_equilibrium_curve_begin(qdot_equilibrium_curve *c, qdot_scene *s, qdot_expr parameter,
                             qdot_binder bind, void *user)
{
    *c = (qdot_equilibrium_curve){
        .s = s, .pool = s->pool, .parameter = parameter, .bind = bind, .user = user};
    QDOT_TRY(qdot_rest_begin(&c->rest, s));
    QDOT_TRY(check_scene(c));
    QDOT_TRY(check_number_of_equations(c));
    QDOT_TRY(allocate_curve(c));
    QDOT_TRY(fill_equations(c));
    QDOT_TRY(qdot_judge_new(s, c->rest.system.equations, bind, user, &c->judge));
    c->judge->parameter = parameter;
    QDOT_TRY(qdot_stability_numbers_new(c->judge, &c->judge->numbers));
    QDOT_TRY(fill_linear_motion(c));
    return check_parameter_influence(c);
}

void
qdot_equilibrium_curve_end(qdot_equilibrium_curve *c)
{
    qdot_judge_free(c->judge);
    qdot_rest_end(&c->rest);
    qdot_free(c->unknown);
    qdot_free(c->angle);
    qdot_free(c->lo);
    qdot_free(c->end);
    qdot_free(c->K);
    qdot_free(c->roots.re);
    *c = (qdot_equilibrium_curve){0};
}

/* --- equilibria at a value of the parameter ----------------------------------------------- */

/* User data of a function that replaces all parameters by values, including the free one. */
typedef struct {
    qdot_equilibrium_curve *c;
    qdot_expr value;
} at_value;

static qdot_expr
insert_parameter_values(void *user, qdot_expr e)
{
    const at_value *v = user;

    e = v->c->bind(v->c->user, e);
    return e == QDOT_NIL ? e : qdot_subs(v->c->pool, e, 1, &v->c->parameter, &v->value);
}

/* Find the value of unknown i at the parameter value p; NaN if the equilibrium leaves it free or it is undefined there. */
static qdot_status
find_unknown_number(const qdot_equilibrium_curve *c, const qdot_equilibrium *e, at_value *value, size_t i,
                    double *y)
{
    *y = NAN;
    for (uint32_t k = 0; k < qdot_expr_count(c->pool, e->equations); k++) {
        const qdot_expr one = qdot_expr_arg(c->pool, e->equations, k);
        qdot_expr x;

        if (qdot_expr_arg(c->pool, one, 0) != c->unknown[i])
            continue;
        x = insert_parameter_values(value, qdot_expr_arg(c->pool, one, 1));
        if (x == QDOT_NIL) {
            const qdot_status status = qdot_pool_check(c->pool);

            return status == QDOT_EDOMAIN ? QDOT_OK : status;
        }
        if ((qdot_expr_node(c->pool, x)->holds & ~(uint32_t)QDOT_HAS_FUN) == 0)
            QDOT_TRY(qdot_generic_evaluate(c->pool, 1, &x, NULL, y));
    }
    return QDOT_OK;
}

qdot_status
qdot_equilibrium_curve_starts(qdot_equilibrium_curve *c, double p, double **at, size_t *count)
{
    at_value value = {c, qdot_expr_of_double(c->pool, p)};
    qdot_rest rest = c->rest;
    qdot_equilibria unused = {0};
    qdot_status status = qdot_pool_check(c->pool);

    *at = NULL;
    *count = 0;
    rest.system.unknowns.at = NULL; /* copy the list of unknowns, because the search appends its own unknowns to it */
    rest.system.unknowns.n = rest.system.unknowns.capacity = 0;
    for (size_t i = 0; i < c->rest.system.unknowns.n && status == QDOT_OK; i++)
        status = qdot_vec_push(&rest.system.unknowns, c->rest.system.unknowns.at[i]);
    if (c->moving) {
        rest.system.ends = insert_parameter_values;
        rest.system.ends_user = &value;
    }
    if (status == QDOT_OK)
        status = qdot_rest_find(&rest, insert_parameter_values, &value, &unused);
    if (status == QDOT_EDOMAIN) { /* the equations or the energy have no real value at this p: no equilibrium */
        rest.found.n = 0;
        status = QDOT_OK;
    }
    if (status == QDOT_OK) {
        *at = qdot_calloc((rest.found.n + 1) * (c->n + 1), sizeof **at);
        status = *at ? QDOT_OK : QDOT_ENOMEM;
    }
    for (size_t k = 0; k < rest.found.n && status == QDOT_OK; k++) {
        double *y = *at + *count * (c->n + 1);

        bool known = true;

        for (size_t i = 0; i < c->n && status == QDOT_OK; i++) {
            status = find_unknown_number(c, &rest.found.at[k], &value, i, &y[i]);
            known = known && isfinite(y[i]);
        }
        y[c->n] = p;
        *count += known;
    }
    if (status != QDOT_OK) {
        qdot_free(*at);
        *at = NULL;
    }
    qdot_rest_end(&rest);
    return status;
}

qdot_status
qdot_equilibrium_curve_judge(qdot_equilibrium_curve *c, const double *y, qdot_stability *verdict)
{
    const qdot_stability_place at = {c->n + 1, c->unknown, y};

    return qdot_stability_judge_at(c->judge, c->judge->numbers, &at, verdict, &c->roots);
}
