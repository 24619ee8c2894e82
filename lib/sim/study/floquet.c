/* floquet.c -- slopes around a periodic orbit, the eigenvalues of what they end as, the verdict. */
#include "sim/study/floquet.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <gsl/gsl_linalg.h>

#include "base/memory.h"
#include "expr/calculus.h"
#include "num/eigenvalues.h"
#include "ode/scale.h"
#include "sim/model/substitute.h"
#include "sim/study/variation.h"
#include "tape/constant.h"

/* Change by the first rates over the time of a run, beside max(scale, |value|), that is none. */
static const double resting = 1e-9;

/* How far accelerations may differ after a period, beside their largest value; times where it is asked. */
static const double same = 1e-7;
enum { ASKED = 8 };

/* How far from 1, beside its error, a multiplier may be found that is 1. */
static const double near_one = 1e-2;

typedef struct {
    qdot_scene *scene;
    qdot_run *run;
    qdot_run_request request;
    size_t n, k;   /* coordinates; directions */
    double *basis; /* [k x 2n] orthonormal directions on the constraints at the start */
    double *z;     /* [2n] the start */
    qdot_expr *exact;      /* [2n] the same; then [k x 2n] the basis */
    qdot_variation_by *by; /* [k] */
    char (*names)[24];     /* [k] */
    qdot_variation v;
    qdot_run *varied;
} orbit;

void
qdot_floquet_clear(qdot_floquet *x)
{
    qdot_free(x->re);
    *x = (qdot_floquet){0};
}

static qdot_expr
jet(const qdot_scene *s, size_t i)
{
    const size_t n = s->coordinates.n;

    return qdot_symbol_jet(s->pool, s->coordinates.at[i % n], i >= n);
}

/* What differences of the i-th of q, then q', count beside. */
static double
size_of(const qdot_run_report *report, size_t n, size_t i, double value)
{
    return qdot_ode_size(report->scales, i < n ? i : report->n + i - n, value);
}

qdot_status
qdot_floquet_rests(qdot_scene *scene, qdot_run *run, bool *rests)
{
    const size_t n = scene->coordinates.n;
    const qdot_run_report *report = qdot_run_get_report(run);
    const double T = report->t1 - report->t0;

    *rests = true;
    for (size_t i = 0; i < 2 * n; i++) {
        const qdot_expr e[2] = {
            jet(scene, i), qdot_symbol_jet(scene->pool, scene->coordinates.at[i % n], i < n ? 1 : 2)};
        double value[2];

        QDOT_TRY(qdot_run_values(run, 2, e, 1, &report->t0, value, NULL));
        if (fabs(value[1] * T) > resting * size_of(report, n, i, value[0]))
            *rests = false;
    }
    return QDOT_OK;
}

qdot_status
qdot_floquet_return(qdot_scene *scene, qdot_run *run, double *off, qdot_expr *where)
{
    const qdot_run_report *report = qdot_run_get_report(run);
    const double t[2] = {report->t0, report->t1};

    *off = 0;
    for (size_t i = 0; i < 2 * scene->coordinates.n; i++) {
        const qdot_expr e = jet(scene, i);
        double value[2], one;

        QDOT_TRY(qdot_run_values(run, 1, &e, 2, t, value, NULL));
        one = fabs(value[1] - value[0]) / size_of(report, scene->coordinates.n, i, value[0]);
        if (one > *off || isnan(one)) {
            *off = one;
            *where = e;
        }
    }
    return QDOT_OK;
}

/* --- directions ------------------------------------------------------------------------------ */

/* The value of e, with the numbers of the request, at the start. */
static qdot_status
at_start(const orbit *o, qdot_expr e, double *value)
{
    qdot_pool *pool = o->scene->pool;
    const qdot_expr t = QDOT_T;

    e = qdot_substitute(pool, e, o->request.n_values, o->request.symbols,
                        o->request.values);
    for (size_t i = 0; i < 2 * o->n && e != QDOT_NIL; i++) {
        const qdot_expr z = jet(o->scene, i);

        e = qdot_subs(pool, e, 1, &z, &o->exact[i]);
    }
    e = e == QDOT_NIL ? e : qdot_subs(pool, e, 1, &t, &o->request.t0);
    QDOT_TRY(qdot_pool_check(pool));
    return qdot_tape_constant(pool, e, value);
}

/* Rows of conditions on dz: f and its rate of holonomic constraints, f of those of velocities. */
static qdot_status
fill_conditions(const orbit *o, gsl_matrix *A, size_t *rows)
{
    qdot_pool *pool = o->scene->pool;

    *rows = 0;
    for (size_t c = 0; c < o->scene->constraints.n; c++) {
        const qdot_constraint *of = &o->scene->constraints.at[c];
        const size_t orders = of->kind == QDOT_HOLONOMIC  ? 2
                              : of->kind == QDOT_VELOCITY ? 1
                                                          : 0;
        qdot_expr f = of->f;

        for (size_t r = 0; r < orders; r++, f = qdot_ddt(pool, f), ++*rows)
            for (size_t i = 0; i < 2 * o->n; i++) {
                double value;

                QDOT_TRY(at_start(o, qdot_diff(pool, f, jet(o->scene, i)), &value));
                gsl_matrix_set(A, *rows, i, value);
            }
    }
    return qdot_pool_check(pool);
}

/* The basis: what A maps to 0. */
static qdot_status
find_tangents(orbit *o)
{
    const size_t z = 2 * o->n;
    gsl_matrix *A = gsl_matrix_calloc(z + 2 * o->scene->constraints.n, z),
               *V = gsl_matrix_alloc(z, z);
    gsl_vector *S = gsl_vector_alloc(z), *work = gsl_vector_alloc(z);
    size_t rows = 0, rank = 0;
    qdot_status status = A && V && S && work ? fill_conditions(o, A, &rows) : QDOT_ENOMEM;

    if (status == QDOT_OK && gsl_linalg_SV_decomp(A, V, S, work) != 0)
        status = qdot_fail(QDOT_EFAILED, "the constraints have no tangents at the start");
    for (size_t i = 0; i < z && status == QDOT_OK; i++)
        rank += gsl_vector_get(S, i) > 1e-9 * gsl_vector_get(S, 0);
    o->k = z - rank;
    for (size_t k = 0; k < o->k && status == QDOT_OK; k++)
        for (size_t i = 0; i < z; i++)
            o->basis[k * z + i] = gsl_matrix_get(V, i, rank + k);
    gsl_matrix_free(A);
    gsl_matrix_free(V);
    gsl_vector_free(S);
    gsl_vector_free(work);
    return status;
}

/* The start, and directions there: of each coordinate and velocity, or the tangents. */
static qdot_status
find_directions(orbit *o)
{
    const size_t z = 2 * o->n;
    const double t0 = qdot_run_get_report(o->run)->t0;

    for (size_t i = 0; i < z; i++) {
        const qdot_expr e = jet(o->scene, i);

        QDOT_TRY(qdot_run_values(o->run, 1, &e, 1, &t0, &o->z[i], NULL));
        o->exact[i] = o->scene->constraints.n == 0
                          ? (i < o->n ? o->request.q0 : o->request.v0)[i % o->n]
                          : qdot_expr_of_double(o->scene->pool, o->z[i]);
    }
    o->request.q0 = o->exact;
    o->request.v0 = o->exact + o->n;
    o->request.q_named = o->request.v_named = NULL;
    o->k = z;
    for (size_t i = 0; i < z; i++)
        o->basis[i * z + i] = 1;
    if (o->scene->constraints.n > 0)
        QDOT_TRY(find_tangents(o));
    for (size_t k = 0; k < o->k; k++) {
        qdot_expr *start = o->exact + (k + 1) * z;

        for (size_t i = 0; i < z; i++)
            start[i] = qdot_expr_of_double(o->scene->pool, o->basis[k * z + i]);
        snprintf(o->names[k], sizeof o->names[k], "s%zu", k + 1);
        o->by[k] = (qdot_variation_by){.name = o->names[k], .start = start};
    }
    return qdot_pool_check(o->scene->pool);
}

/* --- the equations ----------------------------------------------------------------------------- */

static bool
has_time(const orbit *o, qdot_expr e)
{
    return (qdot_expr_node(o->scene->pool, e)->holds & QDOT_HAS_TIME) != 0;
}

/* Whether accelerations change with time, or what events do. */
static bool
holds_time(const orbit *o)
{
    for (size_t i = 0; i < o->n; i++)
        if (has_time(o, o->v.a[i]))
            return true;
    for (size_t k = 0; k < o->scene->events.n; k++) {
        const qdot_event *e = &o->scene->events.at[k];

        for (size_t i = 0; i < e->targets.n; i++)
            if (has_time(o, e->left) || has_time(o, e->right) || has_time(o, e->values.at[i]))
                return true;
    }
    return false;
}

/* e with all coordinates and velocities moved a little, so that nothing is 0 by the symmetry of an orbit. */
static qdot_expr
moved(const orbit *o, qdot_expr e)
{
    qdot_pool *pool = o->scene->pool;

    for (size_t i = 0; i < 2 * o->n && e != QDOT_NIL; i++) {
        const qdot_expr z = jet(o->scene, i),
                        by = qdot_div(pool, qdot_expr_int(pool, (long)i + 3),
                                      qdot_expr_int(pool, 256)),
                        to = qdot_add(pool, z, by);

        e = qdot_subs(pool, e, 1, &z, &to);
    }
    return e;
}

/* e of the same state is the same after a period. */
static qdot_status
check_same(orbit *o, qdot_expr of)
{
    qdot_pool *pool = o->scene->pool;
    const qdot_run_report *report = qdot_run_get_report(o->run);
    const double T = report->t1 - report->t0;
    const qdot_expr t = QDOT_T, later = qdot_add(pool, t, qdot_expr_of_double(pool, T)),
                    now = moved(o, of), after = qdot_subs(pool, now, 1, &t, &later),
                    e[2] = {now, qdot_sub(pool, after, now)};
    double most = 0, off = 0;

    QDOT_TRY(qdot_pool_check(pool));
    for (size_t k = 0; k < ASKED && after != now; k++) {
        const double at = report->t0 + T * (double)k / (ASKED + 0.385);
        double value[2];

        QDOT_TRY(qdot_run_values(o->varied, 2, e, 1, &at, value, NULL));
        most = fmax(most, fabs(value[0]));
        off = isnan(value[1]) ? INFINITY : fmax(off, fabs(value[1]));
    }
    if (!(off <= same * most))
        return qdot_fail(QDOT_EINVAL,
                         "the equations do not have the period %.10g: they change with time", T);
    return QDOT_OK;
}

/* Accelerations, and what events do, have the period. An event either way is where its square is 0. */
static qdot_status
check_period(orbit *o)
{
    qdot_pool *pool = o->scene->pool;

    for (size_t i = 0; i < o->n; i++)
        QDOT_TRY(check_same(o, o->v.a[i]));
    for (size_t k = 0; k < o->scene->events.n; k++) {
        const qdot_event *e = &o->scene->events.at[k];
        qdot_expr g = qdot_sub(pool, e->left, e->right);

        if (e->targets.n == 0)
            continue;
        g = e->way == 0 ? qdot_mul(pool, g, g) : g;
        QDOT_TRY(check_same(o, qdot_variation_with_numbers(&o->v, g)));
        for (size_t i = 0; i < e->targets.n; i++)
            QDOT_TRY(check_same(o, qdot_variation_with_numbers(&o->v, e->values.at[i])));
    }
    return QDOT_OK;
}

bool
qdot_floquet_is_lagrangian(const qdot_scene *s)
{
    for (size_t c = 0; c < s->constraints.n; c++)
        if (s->constraints.at[c].kind != QDOT_HOLONOMIC)
            return false;
    for (size_t e = 0; e < s->events.n; e++)
        if (s->events.at[e].targets.n > 0)
            return false;
    return s->dampers.n + s->dissipations.n + s->forces.n + s->torques.n == 0;
}

/* --- multipliers ----------------------------------------------------------------------------- */

/* What the directions have become, by the directions: B and its errors E [k x k]. */
static qdot_status
fill_monodromy(orbit *o, double *B, double *E)
{
    const size_t z = 2 * o->n, k = o->k;
    const double t1 = qdot_run_get_report(o->varied)->t1;

    for (size_t j = 0; j < k; j++)
        for (size_t i = 0; i < z; i++) {
            const qdot_expr y = qdot_variation_slope_jet(&o->v, j, i % o->n, i >= o->n);
            double value, error;

            QDOT_TRY(qdot_run_values(o->varied, 1, &y, 1, &t1, &value, &error));
            for (size_t l = 0; l < k; l++) {
                B[l * k + j] += o->basis[l * z + i] * value;
                E[l * k + j] += fabs(o->basis[l * z + i]) * error;
            }
        }
    return QDOT_OK;
}

/* The multipliers nearest to 1 are 1. */
static void
state_trivial(qdot_floquet *x, size_t count)
{
    for (x->trivial = 0; x->trivial < count && x->trivial < x->n; x->trivial++) {
        size_t best = x->n;
        double least = INFINITY;

        for (size_t k = 0; k < x->n; k++) {
            const double off = hypot(x->re[k] - 1, x->im[k]);

            if (x->error[k] != 0 && off < least) {
                least = off;
                best = k;
            }
        }
        if (best == x->n || least > fmax(near_one, 2 * x->error[best]))
            return; /* none is: all stay as they were found */
        x->re[best] = 1;
        x->im[best] = x->error[best] = 0;
    }
}

/* Whether the k-th is farther from all others than they may be off. */
static bool
is_apart(const qdot_floquet *x, size_t k)
{
    for (size_t j = 0; j < x->n; j++)
        if (j != k && !(hypot(x->re[j] - x->re[k], x->im[j] - x->im[k]) >
                        2 * (x->error[j] + x->error[k])))
            return false;
    return true;
}

static void
judge(qdot_floquet *x)
{
    bool stable = true, inside = x->trivial == 0;

    x->verdict = QDOT_FLOQUET_UNDECIDED;
    for (size_t k = 0; k < x->n; k++)
        inside = inside && hypot(x->re[k], x->im[k]) + x->error[k] < 1;
    x->asymptotic = x->asymptotic || inside; /* exp(c*t)*(T - V) damps too */
    for (size_t k = 0; k < x->n; k++) {
        const double size = hypot(x->re[k], x->im[k]), error = x->error[k];

        if (error == 0)
            continue; /* 1 whatever the orbit */
        if (size - error > 1) {
            x->verdict = QDOT_FLOQUET_UNSTABLE;
            return;
        }
        stable =
            stable && (x->asymptotic ? size + error < 1
                                     : fabs(size - 1) <= 2 * error && is_apart(x, k));
    }
    if (stable)
        x->verdict = QDOT_FLOQUET_STABLE;
}

qdot_status
qdot_floquet_of(size_t K, size_t k, const double *B, const double *E, size_t trivial, bool asymptotic,
                qdot_floquet *x)
{
    x->n = k;
    x->asymptotic = asymptotic;
    x->re = qdot_calloc(3 * k + 1, sizeof *x->re);
    if (x->re == NULL)
        return QDOT_ENOMEM;
    x->im = x->re + k;
    x->error = x->im + k;
    QDOT_TRY(qdot_eigenvalues_of_product(K, k, B, E, x->re, x->im, x->error));
    state_trivial(x, trivial);
    qdot_eigenvalues_arrange(k, x->re, x->im, x->error);
    judge(x);
    return QDOT_OK;
}

static qdot_status
find_multipliers(orbit *o, qdot_floquet *x)
{
    const size_t k = o->k;
    const bool driven = holds_time(o), free = qdot_floquet_is_lagrangian(o->scene);
    double *B = qdot_calloc(2 * k * k + 1, sizeof *B);
    bool rests = false;
    qdot_status status = B ? fill_monodromy(o, B, B + k * k) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_floquet_rests(o->scene, o->run, &rests);
    if (status == QDOT_OK)
        status = qdot_floquet_of(1, k, B, B + k * k, driven || rests ? 0 : free ? 2 : 1, !free, x);
    qdot_free(B);
    return status;
}

/* --- all ----------------------------------------------------------------------------------------- */

static qdot_status
follow(orbit *o, qdot_floquet *x)
{
    qdot_run_request request;
    const qdot_run_report *report;

    QDOT_TRY(find_directions(o));
    QDOT_TRY(qdot_variation_make(o->scene, &o->request, o->k, o->by, &o->v));
    request = qdot_variation_request(&o->v);
    QDOT_TRY(qdot_run_new(o->v.scene, &request, &o->varied));
    report = qdot_run_get_report(o->varied);
    if (report->status != QDOT_RUN_DONE)
        return qdot_fail(QDOT_EFAILED, "the run with slopes ended early: %.300s",
                         report->reason != NULL ? report->reason : "at an event");
    QDOT_TRY(check_period(o));
    return find_multipliers(o, x);
}

qdot_status
qdot_floquet_find(qdot_scene *scene, qdot_run *run, const qdot_run_request *request,
                  qdot_floquet *x)
{
    const size_t n = scene->coordinates.n, z = 2 * n;
    orbit o = {.scene = scene, .run = run, .request = *request, .n = n};
    qdot_status status = QDOT_ENOMEM;

    o.basis = qdot_calloc(z * z + z + 1, sizeof *o.basis);
    o.exact = qdot_calloc(z * (z + 1) + 1, sizeof *o.exact);
    o.by = qdot_calloc(z + 1, sizeof *o.by);
    o.names = qdot_calloc(z + 1, sizeof *o.names);
    if (o.basis && o.exact && o.by && o.names) {
        o.z = o.basis + z * z;
        status = follow(&o, x);
    }
    qdot_run_free(o.varied);
    qdot_variation_clear(&o.v);
    qdot_free(o.basis);
    qdot_free(o.exact);
    qdot_free(o.by);
    qdot_free(o.names);
    return status;
}
