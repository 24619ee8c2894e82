/* integrable.c -- evaluates dw on the directions that the constraints leave; finds integrating
 * factors. */
#include "mech/dynamics/integrable.h"

#include <string.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/scene/access.h"
#include "normal/simplify/simplify.h"
#include "normal/integral/antiderivative.h"

/* Differential forms over x = (q, t), in rows of n + 1 coefficients. */
typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    size_t n;      /* number of variables: coordinates and t */
    qdot_expr *x;  /* [n] the variables: coordinates, then t */
    size_t m;      /* number of differential forms */
    qdot_expr *a;  /* [m x n] coefficients of the forms */
    size_t *of;    /* [m] the constraint from which each form comes */
    bool *in;      /* [m] whether the form is still in the system that is tested for integrability */
    qdot_expr *B;  /* [m x n] the system in reduced row echelon form */
    size_t *pivot; /* [m] pivot column of each row */
    size_t rank;
    qdot_facts facts; /* facts of the scene, with those of its holonomic constraints */
    qdot_expr *relations;
} forms;

static void
free_forms(forms *f)
{
    qdot_free(f->x);
    qdot_free(f->a);
    qdot_free(f->of);
    qdot_free(f->in);
    qdot_free(f->B);
    qdot_free(f->pivot);
    qdot_free(f->relations);
}

/* Find the differential form of constraint k; *linear: whether the constraint is linear in the velocities. */
static qdot_status
find_form(const forms *f, size_t k, qdot_expr *a, bool *linear)
{
    const qdot_constraint *c = &f->s->constraints.at[k];
    qdot_expr rest = c->f;

    *linear = c->kind != QDOT_ACCELERATION;
    if (c->kind == QDOT_ACCELERATION)
        return QDOT_OK;
    for (size_t i = 0; i < f->n; i++) {
        qdot_expr v = i + 1 < f->n ? qdot_mech_jet(f->s, i, 1) : QDOT_T;

        if (c->kind == QDOT_HOLONOMIC) {
            a[i] = qdot_diff(f->pool, c->f, f->x[i]);
        } else if (i + 1 < f->n) {
            a[i] = qdot_mech_tidy(f->s, qdot_diff(f->pool, c->f, v));
            *linear &= !(qdot_mech_holds(f->s, a[i]) & QDOT_HAS_VELOCITY);
            rest = qdot_sub(f->pool, rest, qdot_mul(f->pool, a[i], v));
        } else {
            a[i] = qdot_mech_tidy(f->s, rest);
            *linear &= !(qdot_mech_holds(f->s, a[i]) & QDOT_HAS_VELOCITY);
        }
    }
    return qdot_pool_check(f->pool);
}

static qdot_status
make_forms(forms *f, qdot_scene *s)
{
    size_t c = s->constraints.n, known;

    *f = (forms){.s = s, .pool = s->pool, .n = s->coordinates.n + 1};
    f->facts = qdot_scene_facts(s);
    known = f->facts.n_relations;
    f->x = qdot_calloc(f->n, sizeof *f->x);
    f->a = qdot_calloc(c * f->n + 1, sizeof *f->a);
    f->B = qdot_calloc(c * f->n + 1, sizeof *f->B);
    f->of = qdot_calloc(c + 1, sizeof *f->of);
    f->in = qdot_calloc(c + 1, sizeof *f->in);
    f->pivot = qdot_calloc(c + 1, sizeof *f->pivot);
    f->relations = qdot_calloc(known + c + 1, sizeof *f->relations);
    if (!f->x || !f->a || !f->B || !f->of || !f->in || !f->pivot || !f->relations)
        return QDOT_ENOMEM;
    if (known > 0)
        memcpy(f->relations, f->facts.relations, known * sizeof *f->relations);
    for (size_t i = 0; i + 1 < f->n; i++)
        f->x[i] = s->coordinates.at[i];
    f->x[f->n - 1] = QDOT_T;
    for (size_t k = 0; k < c; k++) {
        bool linear;

        if (s->constraints.at[k].kind == QDOT_HOLONOMIC)
            f->relations[known++] = s->constraints.at[k].f;
        QDOT_TRY(find_form(f, k, f->a + f->m * f->n, &linear));
        if (linear)
            f->of[f->m++] = k;
    }
    f->facts.n_relations = known;
    f->facts.relations = f->relations;
    return QDOT_OK;
}

/* --- eliminating the forms of the system -------------------------------------------- */

/* Choose the pivot of a row: a number if possible, otherwise a short entry. */
static qdot_status
choose_pivot(const forms *f, qdot_expr *row, size_t *pivot)
{
    uint64_t least = UINT64_MAX;

    *pivot = f->n;
    for (size_t i = 0; i < f->n; i++) {
        uint64_t size = qdot_expr_size(f->pool, row[i]) + 1;

        if (row[i] == QDOT_ZERO)
            continue;
        if (qdot_expr_kind(f->pool, row[i]) != QDOT_NUM &&
            qdot_is_zero(f->pool, row[i], &f->facts)) {
            row[i] = QDOT_ZERO;
            continue;
        }
        if (qdot_expr_kind(f->pool, row[i]) == QDOT_NUM)
            size = 0;
        if (size < least) {
            least = size;
            *pivot = i;
        }
    }
    return qdot_pool_check(f->pool);
}

/* Subtract row[pivot] times `by`, whose pivot entry is 1, from `row`, so that the entry there becomes 0. */
static void
eliminate_from_row(const forms *f, qdot_expr *row, const qdot_expr *by, size_t pivot)
{
    qdot_expr head = row[pivot];

    if (head == QDOT_ZERO)
        return;
    for (size_t i = 0; i < f->n; i++) {
        if (by[i] == QDOT_ZERO)
            continue;
        row[i] = i == pivot ? QDOT_ZERO
                            : qdot_mech_tidy(f->s, qdot_sub(f->pool, row[i],
                                                            qdot_mul(f->pool, head,
                                                                     by[i])));
    }
}

/* Bring the system of forms to reduced row echelon form B: dx_pivot = - sum of B_j dx_j over the others. */
static qdot_status
reduce_system(forms *f)
{
    f->rank = 0;
    for (size_t k = 0; k < f->m; k++) {
        qdot_expr *row = f->B + f->rank * f->n, head;
        size_t p;

        if (!f->in[k])
            continue;
        memcpy(row, f->a + k * f->n, f->n * sizeof *row);
        for (size_t r = 0; r < f->rank; r++)
            eliminate_from_row(f, row, f->B + r * f->n, f->pivot[r]);
        QDOT_TRY(qdot_pool_check(f->pool));
        QDOT_TRY(choose_pivot(f, row, &p));
        if (p == f->n)
            continue;
        head = row[p];
        for (size_t i = 0; i < f->n; i++)
            row[i] = row[i] == QDOT_ZERO
                         ? QDOT_ZERO
                         : qdot_mech_tidy(f->s, qdot_div(f->pool, row[i], head));
        row[p] = QDOT_ONE;
        for (size_t r = 0; r < f->rank; r++)
            eliminate_from_row(f, f->B + r * f->n, row, p);
        f->pivot[f->rank++] = p;
        QDOT_TRY(qdot_pool_check(f->pool));
    }
    return QDOT_OK;
}

static bool
is_pivot_column(const forms *f, size_t i)
{
    for (size_t r = 0; r < f->rank; r++)
        if (f->pivot[r] == i)
            return true;
    return false;
}

/* The component of the exterior derivative dw for dx_i, dx_j, where w is the form with index k. */
static qdot_expr
exterior_derivative(const forms *f, size_t k, size_t i, size_t j)
{
    const qdot_expr *a = f->a + k * f->n;

    return i == j ? QDOT_ZERO
                  : qdot_sub(f->pool, qdot_diff(f->pool, a[j], f->x[i]),
                             qdot_diff(f->pool, a[i], f->x[j]));
}

/* The component of dw for two of the vectors u_i = x_i - sum_r B_ri x_pivot(r), on which the system's forms vanish. */
static qdot_expr
exterior_derivative_on_system(const forms *f, size_t k, size_t i, size_t j)
{
    qdot_pool *pool = f->pool;
    qdot_expr sum = exterior_derivative(f, k, i, j);

    for (size_t r = 0; r < f->rank; r++) {
        qdot_expr bi = f->B[r * f->n + i], bj = f->B[r * f->n + j];

        sum = qdot_sub(pool, sum, qdot_mul(pool, bj, exterior_derivative(f, k, i, f->pivot[r])));
        sum = qdot_sub(pool, sum, qdot_mul(pool, bi, exterior_derivative(f, k, f->pivot[r], j)));
        for (size_t p = 0; p < f->rank; p++)
            sum = qdot_add(pool, sum,
                           qdot_mul(pool, qdot_mul(pool, bi, f->B[p * f->n + j]),
                                    exterior_derivative(f, k, f->pivot[r], f->pivot[p])));
    }
    return qdot_mech_tidy(f->s, sum);
}

/* Whether dw of form k vanishes on what the system leaves: the first component that does
 * not, else one that is undecided, else proved. */
static qdot_status
decide_whether_curl_vanishes(const forms *f, size_t k, qdot_integrability *result)
{
    result->decision = (qdot_decision){.verdict = QDOT_PROVED};
    for (size_t i = 0; i < f->n; i++)
        for (size_t j = i + 1; j < f->n; j++) {
            qdot_decision one;
            qdot_expr c;

            if (is_pivot_column(f, i) || is_pivot_column(f, j))
                continue;
            c = exterior_derivative_on_system(f, k, i, j);
            QDOT_TRY(qdot_pool_check(f->pool));
            if (c == QDOT_ZERO)
                continue;
            QDOT_TRY(qdot_decide_equal(f->pool, c, QDOT_ZERO, &f->facts, &one));
            if (one.verdict == QDOT_PROVED)
                continue;
            result->decision = one;
            result->component = c;
            result->along[0] = f->x[i];
            result->along[1] = f->x[j];
            if (one.verdict == QDOT_REFUTED)
                return QDOT_OK;
        }
    return QDOT_OK;
}

/* --- integrals of constraints ------------------------------------------------------- */

static bool
is_closed_form(const forms *f, const qdot_expr *a, const bool *held)
{
    for (size_t i = 0; i < f->n; i++)
        for (size_t j = i + 1; j < f->n; j++) {
            qdot_expr c;

            if (held[i] || held[j])
                continue;
            c = qdot_sub(f->pool, qdot_diff(f->pool, a[j], f->x[i]),
                         qdot_diff(f->pool, a[i], f->x[j]));
            if (c != QDOT_ZERO && !qdot_is_zero(f->pool, c, &f->facts))
                return false;
        }
    return !qdot_pool_failed(f->pool);
}

/* The integral F with dF = mu w, if mu w is closed and can be integrated, for the form w of index k; else nil. */
static qdot_expr
integrate_with_factor(const forms *f, size_t k, qdot_expr mu, const bool *held)
{
    qdot_expr *a = qdot_calloc(2 * f->n, sizeof *a), *x, F = QDOT_NIL;
    size_t n = 0;

    if (!a)
        return qdot_pool_fail(f->pool);
    x = a + f->n;
    for (size_t i = 0; i < f->n; i++)
        a[i] = qdot_mech_tidy(f->s, qdot_mul(f->pool, mu, f->a[k * f->n + i]));
    if (!qdot_pool_failed(f->pool) && is_closed_form(f, a, held)) {
        for (size_t i = 0; i < f->n; i++)
            if (!held[i]) {
                x[n] = f->x[i];
                a[n++] = a[i];
            }
        F = qdot_potential_of(f->pool, n, x, a, &f->facts);
    }
    qdot_free(a);
    return F;
}

/* exp(int h'(z) dz), h' = -dw(z, x_j)/a_j the same for every j and a function of z alone;
 * nil otherwise. */
static qdot_expr
find_integrating_factor(const forms *f, size_t k, size_t z, const bool *held)
{
    const qdot_expr *a = f->a + k * f->n;
    qdot_pool *pool = f->pool;
    qdot_expr slope = QDOT_NIL, h;

    for (size_t j = 0; j < f->n && slope == QDOT_NIL; j++)
        if (j != z && !held[j] && a[j] != QDOT_ZERO)
            slope = qdot_mech_tidy(f->s, qdot_neg(pool, qdot_div(pool, exterior_derivative(f, k, z, j),
                                                                 a[j])));
    if (slope == QDOT_NIL || slope == QDOT_ZERO)
        return QDOT_NIL;
    for (size_t i = 0; i < f->n; i++)
        if (i != z && qdot_expr_contains(pool, slope, f->x[i]))
            return QDOT_NIL;
    h = qdot_antiderivative(pool, slope, f->x[z], &f->facts);
    return h == QDOT_NIL ? h
                         : qdot_simplify(pool, qdot_fun1(pool, QDOT_EXP, h), &f->facts);
}

static void
find_integral(const forms *f, size_t k, const bool *held, qdot_integrability *result)
{
    const qdot_expr *a = f->a + k * f->n;
    qdot_expr mu = QDOT_ONE, F = integrate_with_factor(f, k, mu, held);

    for (size_t i = 0; i < f->n && F == QDOT_NIL && !qdot_pool_failed(f->pool); i++) {
        if (held[i] || a[i] == QDOT_ZERO || qdot_expr_kind(f->pool, a[i]) == QDOT_NUM)
            continue;
        mu = qdot_div(f->pool, QDOT_ONE, a[i]);
        F = integrate_with_factor(f, k, mu, held);
    }
    for (size_t i = 0; i < f->n && F == QDOT_NIL && !qdot_pool_failed(f->pool); i++) {
        mu = held[i] ? QDOT_NIL : find_integrating_factor(f, k, i, held);
        F = mu == QDOT_NIL ? QDOT_NIL : integrate_with_factor(f, k, mu, held);
    }
    if (F != QDOT_NIL && qdot_expr_is_negative(f->pool, F)) {
        F = qdot_neg(f->pool, F);
        mu = qdot_neg(f->pool, mu);
    }
    result->integral = F;
    result->factor = F == QDOT_NIL ? QDOT_NIL : mu;
}

/* Find coordinates that are constant because another form of the system is a dz = 0. */
static void
find_constant_coordinates(const forms *f, size_t k, bool *held)
{
    for (size_t j = 0; j < f->m; j++) {
        size_t count = 0, which = 0;

        for (size_t i = 0; i < f->n; i++)
            if (f->a[j * f->n + i] != QDOT_ZERO) {
                count++;
                which = i;
            }
        if (j != k && f->in[j] && count == 1 && which + 1 < f->n)
            held[which] = true;
    }
}

/* --- whether the constraints are integrable ----------------------------------------- */

static qdot_status
decide_for_one_form(forms *f, size_t k, qdot_integrability *result)
{
    memset(f->in, 0, f->m * sizeof *f->in);
    f->in[k] = true;
    QDOT_TRY(reduce_system(f));
    QDOT_TRY(decide_whether_curl_vanishes(f, k, result));
    result->alone = result->decision.verdict == QDOT_PROVED;
    return QDOT_OK;
}

/* Leave out the forms whose dw does not vanish until all do. A round that leaves out one form
 * gives the next derived system exactly, since no combination with it vanishes either: what
 * fails there is surely not integrable. Of two or more left out a combination might stay. */
static qdot_status
decide_for_system(forms *f, size_t k, qdot_integrability *result)
{
    bool changed = true, surely = true;

    for (size_t j = 0; j < f->m; j++)
        f->in[j] = true;
    while (changed && f->in[k]) {
        qdot_integrability one = {0};
        size_t out = 0;

        changed = false;
        QDOT_TRY(reduce_system(f));
        QDOT_TRY(decide_whether_curl_vanishes(f, k, result));
        if (result->decision.verdict != QDOT_PROVED)
            break;
        for (size_t j = 0; j < f->m; j++) {
            if (!f->in[j] || j == k)
                continue;
            QDOT_TRY(decide_whether_curl_vanishes(f, j, &one));
            if (one.decision.verdict != QDOT_PROVED) {
                f->in[j] = false;
                changed = true;
                surely = surely && ++out == 1 && one.decision.verdict == QDOT_REFUTED;
            }
        }
    }
    if (!surely && result->decision.verdict == QDOT_REFUTED)
        result->decision = (qdot_decision){.verdict = QDOT_UNDECIDED};
    return QDOT_OK;
}

static qdot_status
decide_integrability(forms *f, size_t k, bool alone, qdot_integrability *result)
{
    bool *held, jump;
    qdot_status status;

    /* if f jumps, an integral would be constant only between the jumps */
    QDOT_TRY(qdot_jumps(f->pool, f->s->constraints.at[f->of[k]].f, UINT32_MAX, &jump));
    if (jump) {
        result->decision = (qdot_decision){.verdict = QDOT_UNDECIDED};
        return QDOT_OK;
    }
    held = qdot_calloc(f->n, sizeof *held);
    status = held ? decide_for_one_form(f, k, result) : QDOT_ENOMEM;
    if (status == QDOT_OK && !result->alone && !alone && f->m > 1) {
        status = decide_for_system(f, k, result);
        if (status == QDOT_OK && result->decision.verdict == QDOT_PROVED)
            find_constant_coordinates(f, k, held);
    }
    if (status == QDOT_OK && result->decision.verdict == QDOT_PROVED) {
        result->component = QDOT_NIL;
        find_integral(f, k, held, result);
        if (!result->alone)
            result->factor = QDOT_NIL;
        status = qdot_pool_check(f->pool);
    }
    qdot_free(held);
    return status;
}

qdot_status
qdot_mech_integrable(qdot_scene *s, size_t k, bool alone, qdot_integrability *result)
{
    const qdot_constraint *c = &s->constraints.at[k];
    qdot_status status;
    size_t row = 0;
    forms f;

    *result = (qdot_integrability){.component = QDOT_NIL, .integral = QDOT_NIL};
    QDOT_TRY(qdot_pool_check(s->pool));
    if (c->kind != QDOT_VELOCITY)
        return qdot_fail(QDOT_EINVAL,
                         c->kind == QDOT_HOLONOMIC
                             ? "constraint %s holds no velocities: it is holonomic as it "
                               "stands"
                             : "constraint %s holds accelerations: the question is of "
                               "velocity constraints",
                         c->name);
    status = make_forms(&f, s);
    while (status == QDOT_OK && row < f.m && f.of[row] != k)
        row++;
    if (status == QDOT_OK && row == f.m)
        status = qdot_fail(QDOT_EINVAL,
                           "constraint %s is not linear in the velocities: the question "
                           "is of those that are",
                           c->name);
    if (status == QDOT_OK)
        status = decide_integrability(&f, row, alone, result);
    free_forms(&f);
    return status;
}

/* Whether all velocity constraints of the scene are among the forms, and none depends on time. */
static qdot_status
are_all_time_independent(const forms *f, bool *yes)
{
    const qdot_scene *s = f->s;
    size_t row = 0;

    *yes = true;
    for (size_t k = 0; k < s->constraints.n && *yes; k++) {
        const qdot_constraint *c = &s->constraints.at[k];
        bool jump;

        if (c->kind == QDOT_HOLONOMIC)
            continue;
        while (row < f->m && f->of[row] < k)
            row++;
        *yes = row < f->m && f->of[row] == k && f->a[row * f->n + f->n - 1] == QDOT_ZERO &&
               (qdot_mech_holds(s, c->f) & QDOT_HAS_TIME) == 0;
        if (!*yes)
            break;
        QDOT_TRY(qdot_jumps(f->pool, c->f, UINT32_MAX, &jump));
        *yes = !jump;
    }
    return QDOT_OK;
}

static qdot_status
decide_for_all_forms(forms *f, bool *yes)
{
    QDOT_TRY(are_all_time_independent(f, yes));
    if (!*yes)
        return QDOT_OK;
    for (size_t j = 0; j < f->m; j++)
        f->in[j] = true;
    QDOT_TRY(reduce_system(f));
    for (size_t j = 0; j < f->m && *yes; j++) {
        qdot_integrability one = {0};

        if (f->s->constraints.at[f->of[j]].kind == QDOT_HOLONOMIC)
            continue;
        QDOT_TRY(decide_whether_curl_vanishes(f, j, &one));
        *yes = one.decision.verdict == QDOT_PROVED;
    }
    return QDOT_OK;
}

qdot_status
qdot_mech_integrable_all(qdot_scene *s, bool *yes)
{
    qdot_status status = QDOT_OK;
    bool some = false;
    forms f;

    *yes = true;
    QDOT_TRY(qdot_pool_check(s->pool));
    for (size_t k = 0; k < s->constraints.n && *yes; k++) {
        *yes = s->constraints.at[k].kind != QDOT_ACCELERATION;
        some = some || s->constraints.at[k].kind == QDOT_VELOCITY;
    }
    if (!*yes || !some)
        return QDOT_OK;
    status = make_forms(&f, s);
    if (status == QDOT_OK)
        status = decide_for_all_forms(&f, yes);
    free_forms(&f);
    return status;
}
