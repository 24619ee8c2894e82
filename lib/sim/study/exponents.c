/* exponents.c -- Lyapunov exponents: integrates tangent vectors, orthonormalises them, averages
 * their growth by windows. */
#include "sim/study/exponents.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/progress.h"
#include "expr/exact.h"
#include "ode/integrate.h"
#include "sim/course/course.h"
#include "sim/model/massless.h"
#include "sim/study/method-run.h"
#include "sim/study/variation.h"

/* Directions are made orthonormal where one, without its parts along those before it, has grown or shrunk
 * so much. */
static const double most_growth = 1e4;

/* A limit of work so large that it is never reached. */
static const uint64_t no_bound = UINT64_MAX / 2;

typedef struct {
    qdot_exponents *x;
    const qdot_variation *v;
    const qdot_run_request *request;
    qdot_method_run m;
    size_t n, k, all; /* number of coordinates of the scene; of tangent vectors; of coordinates of both together */
    double *y, *look;      /* [2 all] the state with tangent vectors; scratch for check_tangent_lengths */
    double t, *sum, *size; /* time; [k] sums of logarithms of growth; [k] lengths of the tangent vectors */
    double *growth;        /* [windows x k] logarithm of growth in each time window */
    bool alone;            /* the scene alone, not the tangent vectors, decides where steps end */
    bool stopped;
    char reason[400]; /* why the integration ended early */
} pursuit;

void
qdot_exponents_clear(qdot_exponents *x)
{
    qdot_free(x->value);
    qdot_free(x->t);
    *x = (qdot_exponents){.spectrum = x->spectrum};
}

/* --- tangent vectors ----------------------------------------------------------------------- */

/* The address of component i < 2n of tangent vector k in the state y. */
static double *
tangent_component(const pursuit *p, double *y, size_t k, size_t i)
{
    return y + (i < p->n ? 0 : p->all) + (k + 1) * p->n + i % p->n;
}

static double
product_of_tangents(const pursuit *p, double *y, size_t k, size_t l)
{
    double sum = 0;

    for (size_t i = 0; i < 2 * p->n; i++)
        sum += *tangent_component(p, y, k, i) * *tangent_component(p, y, l, i);
    return sum;
}

/* y = Q R, Q in place of y, R_kk into `size` [k]. Each is done twice, as once leaves what has
 * cancelled. */
static void
orthonormalise_tangents(const pursuit *p, double *y, double *size)
{
    for (size_t k = 0; k < p->k; k++) {
        for (int twice = 0; twice < 2; twice++)
            for (size_t l = 0; l < k; l++) {
                const double part = product_of_tangents(p, y, k, l);

                for (size_t i = 0; i < 2 * p->n; i++)
                    *tangent_component(p, y, k, i) -= part * *tangent_component(p, y, l, i);
            }
        size[k] = sqrt(product_of_tangents(p, y, k, k));
        for (size_t i = 0; i < 2 * p->n; i++)
            *tangent_component(p, y, k, i) /= size[k];
    }
}

/* Make the tangent vectors orthonormal, and add the logarithms of their growth, ln R_kk, to the sums. */
static qdot_status
add_growth(pursuit *p)
{
    orthonormalise_tangents(p, p->y, p->size);
    for (size_t k = 0; k < p->k; k++) {
        if (!(p->size[k] > 0) || !isfinite(p->size[k]))
            return qdot_fail(QDOT_EFAILED, "a direction has no length at t = %.9g", p->t);
        p->sum[k] += log(p->size[k]);
    }
    return QDOT_OK;
}

/* Stop the integration if a tangent vector, orthogonalised to those before it, has a length far from 1. */
static qdot_status
check_tangent_lengths(double t, const double *y, bool *stop, void *user)
{
    pursuit *p = user;

    (void)t;
    memcpy(p->look, y, 2 * p->all * sizeof *y);
    orthonormalise_tangents(p, p->look, p->size);
    for (size_t k = 0; k < p->k; k++)
        if (!(p->size[k] < most_growth) || !(p->size[k] * most_growth > 1))
            *stop = true;
    return QDOT_OK;
}

/* --- integration through the windows --------------------------------------------------------- */

/* Put the tangent vectors back onto the constraints: when they are made orthonormal, a short one is multiplied by a large
 * number, and its distance from the constraints with it. */
static qdot_status
project_tangents(pursuit *p, const qdot_ode_system *system)
{
    double moved;

    if (!system->project)
        return QDOT_OK;
    memset(p->look, 0, 2 * p->all * sizeof *p->look);
    QDOT_TRY(system->project(p->t, p->y, p->look, &moved, system->user));
    for (size_t i = 0; i < 2 * p->all; i++)
        p->y[i] += p->look[i];
    return QDOT_OK;
}

/* Integrate to the time `end`, or until a tangent vector has grown too long. */
static qdot_status
integrate_until(pursuit *p, double end)
{
    const qdot_ode_system system = qdot_bind_system(p->m.bind);
    const qdot_ode_options options = {
        .tol = p->request->tol, .accepted = check_tangent_lengths, .user = p, .max_steps = no_bound};
    qdot_ode_result result;
    qdot_status status;

    QDOT_TRY(project_tangents(p, &system));
    status = qdot_ode_integrate(&system, p->m.plan->method, &options, p->t, end, p->y, &result);
    p->t = result.t;
    p->x->steps += (double)result.stats.steps;
    p->x->cpu += result.stats.cpu;
    return status;
}

/* Integrate to `end` in pieces, as events, switches or domains may divide the motion. */
static qdot_status
integrate_in_pieces(pursuit *p, double end)
{
    qdot_pool *pool = p->v->of->pool;
    qdot_run_request request = qdot_variation_request(p->v);
    qdot_method_run m = {0};
    qdot_course course = {.stage = &m.stage};
    const qdot_ode_options options = {
        .tol = p->request->tol, .accepted = check_tangent_lengths, .user = p, .max_steps = no_bound};
    qdot_expr *start = qdot_calloc(2 * p->all + 1, sizeof *start);
    qdot_status status = start ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < 2 * p->all && start; i++)
        start[i] = qdot_expr_of_double(pool, p->y[i]);
    request.q0 = start;
    request.v0 = start + p->all;
    request.q_named = request.v_named = NULL;
    request.t0 = qdot_expr_of_double(pool, p->t);
    request.t1 = qdot_expr_of_double(pool, end);
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status =
            qdot_method_run_init(&m, p->v->scene, &request, request.method, request.tol);
    if (status == QDOT_OK)
        status = qdot_course_run(&course, m.plan->method, &options, p->t, end, m.start);
    if (status == QDOT_OK) {
        const qdot_trajectory *tr = &course.tr;

        memcpy(p->y, tr->y + (tr->count - 1) * tr->n, 2 * p->all * sizeof *p->y);
        p->t = tr->t[tr->count - 1];
        p->x->steps += (double)tr->result.stats.steps;
        p->x->cpu += tr->result.stats.cpu;
        p->stopped = course.reason[0] != '\0';
        memcpy(p->reason, course.reason, sizeof p->reason);
    }
    qdot_course_clear(&course);
    qdot_method_run_clear(&m);
    qdot_free(start);
    return status;
}

/* Integrate through one time window, up to the time `end`. */
static qdot_status
integrate_window(pursuit *p, double end)
{
    while (p->t != end && !p->stopped) {
        QDOT_TRY(p->alone ? integrate_until(p, end) : integrate_in_pieces(p, end));
        QDOT_TRY(add_growth(p));
    }
    return QDOT_OK;
}

static qdot_status
follow_all_windows(pursuit *p)
{
    qdot_exponents *x = p->x;
    const double t0 = p->m.t0, t1 = p->m.t1;

    for (size_t w = 0; w < QDOT_EXPONENTS_WINDOWS; w++) {
        const double end =
            w + 1 == QDOT_EXPONENTS_WINDOWS
                ? t1
                : t0 + (t1 - t0) * (double)(w + 1) / QDOT_EXPONENTS_WINDOWS;
        const double before = w > 0 ? x->t[w - 1] : 0;
        qdot_status status = integrate_window(p, end);

        if (status == QDOT_EINTR && w > 0) {
            x->interrupted = true;
            return QDOT_OK;
        }
        QDOT_TRY(status);
        if (p->stopped)
            return QDOT_OK;
        x->t[w] = fabs(end - t0);
        for (size_t k = 0; k < p->k; k++) {
            p->growth[w * p->k + k] = p->sum[k] / (x->t[w] - before);
            x->course[w * p->k + k] =
                ((w > 0 ? x->course[(w - 1) * p->k + k] * before : 0) + p->sum[k]) /
                x->t[w];
            p->sum[k] = 0;
        }
        x->windows++;
    }
    return QDOT_OK;
}

/* --- means and errors ----------------------------------------------------------------------- */

/* The standard error of the mean of x [n], estimated from means of blocks of `size` values. */
static double
error_of_blocks(size_t n, const double *x, size_t size)
{
    const size_t blocks = n / size;
    double mean = 0, square = 0;

    for (size_t i = 0; i < blocks * size; i++)
        mean += x[i] / (double)(blocks * size);
    for (size_t b = 0; b < blocks; b++) {
        double block = 0;

        for (size_t i = 0; i < size; i++)
            block += x[b * size + i] / (double)size;
        square += (block - mean) * (block - mean);
    }
    return sqrt(square / (double)(blocks - 1) / (double)blocks);
}

/* How far the mean of x [n] would be from `mean` without its longest episode, the windows on one side of that: a motion
 * that sticks has as few as one. */
static double
shift_of_mean_by_episode(size_t n, const double *x, double mean)
{
    double most = 0;

    for (size_t i = 0, end; i < n; i = end) {
        double sum = 0;

        for (end = i; end < n && (x[end] > mean) == (x[i] > mean); end++)
            sum += x[end] - mean;
        most = fmax(most, fabs(sum) / (double)n);
    }
    return most;
}

void
qdot_exponents_mean(size_t n, const double *x, double *mean, double *error)
{
    double half[2] = {0, 0}, most = 0;

    *mean = 0;
    *error = NAN;
    for (size_t i = 0; i < n; i++) {
        *mean += x[i] / (double)n;
        if (i < n / 2 || i >= n - n / 2)
            half[i >= n / 2] += x[i] / (double)(n / 2);
    }
    if (n < 20)
        return;
    for (size_t size = 1; size <= 8 && n / size >= 8; size *= 2)
        most = fmax(most, error_of_blocks(n, x, size));
    *error = fmax(3 * most, 4 * shift_of_mean_by_episode(n, x, *mean)) + fabs(half[1] - half[0]);
}

/* Sort the Lyapunov exponents in descending order. */
static void
sort_exponents(qdot_exponents *x)
{
    for (size_t i = 1; i < x->n; i++)
        for (size_t j = i; j > 0 && x->value[j] > x->value[j - 1]; j--) {
            const double value = x->value[j], error = x->error[j];

            x->value[j] = x->value[j - 1];
            x->error[j] = x->error[j - 1];
            x->value[j - 1] = value;
            x->error[j - 1] = error;
            for (size_t w = 0; w < x->windows; w++) {
                const double of = x->course[w * x->n + j];

                x->course[w * x->n + j] = x->course[w * x->n + j - 1];
                x->course[w * x->n + j - 1] = of;
            }
        }
}

static qdot_status
compute_exponents(pursuit *p)
{
    qdot_exponents *x = p->x;
    const size_t first = x->windows / 10, n = x->windows - first;
    double *of = qdot_malloc((n + 1) * sizeof *of);

    if (!of)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < x->n; k++) {
        for (size_t w = 0; w < n; w++)
            of[w] = p->growth[(first + w) * x->n + k];
        qdot_exponents_mean(n, of, x->value + k, x->error + k);
    }
    qdot_free(of);
    sort_exponents(x);
    if (p->stopped)
        return qdot_fail(QDOT_EFAILED, "the run ended: %.300s", p->reason);
    return QDOT_OK;
}

/* --- the whole computation ---------------------------------------------------------------- */

static qdot_status
pursuit_allocate(pursuit *p)
{
    qdot_exponents *x = p->x;
    const size_t w = QDOT_EXPONENTS_WINDOWS;

    x->n = p->k;
    x->value = qdot_calloc(2 * p->k + 1, sizeof *x->value);
    x->t = qdot_calloc(w * (p->k + 1), sizeof *x->t);
    p->y = qdot_calloc(4 * p->all + 2 * p->k + w * p->k + 1, sizeof *p->y);
    if (!x->value || !x->t || !p->y)
        return QDOT_ENOMEM;
    x->error = x->value + p->k;
    x->course = x->t + w;
    p->look = p->y + 2 * p->all;
    p->sum = p->look + 2 * p->all;
    p->size = p->sum + p->k;
    p->growth = p->size + p->k;
    return QDOT_OK;
}

static qdot_status
compute_with_scene(pursuit *p)
{
    const qdot_run_request request = qdot_variation_request(p->v);

    QDOT_TRY(pursuit_allocate(p));
    QDOT_TRY(
        qdot_method_run_init(&p->m, p->v->scene, &request, request.method, request.tol));
    if (p->m.t0 == p->m.t1)
        return qdot_fail(QDOT_EINVAL, "the run has no length");
    p->alone = !p->m.pieces && p->m.stage.domains.n == 0;
    memcpy(p->y, p->m.start, 2 * p->all * sizeof *p->y);
    p->t = p->m.t0;
    QDOT_TRY(add_growth(p));
    memset(p->sum, 0, p->k * sizeof *p->sum);
    qdot_progress_begin(p->m.t0, p->m.t1, "lyapunov");
    QDOT_TRY(follow_all_windows(p));
    return compute_exponents(p);
}

/* The number of independent directions allowed by the constraints and by massless coordinates' equations. */
static size_t
count_directions(const qdot_scene *s, size_t determined)
{
    size_t n = 2 * s->coordinates.n - determined;

    for (size_t c = 0; c < s->constraints.n; c++)
        n -= s->constraints.at[c].kind == QDOT_HOLONOMIC  ? 2
             : s->constraints.at[c].kind == QDOT_VELOCITY ? 1
                                                          : 0;
    return n;
}

static qdot_status
count_determined_values(qdot_scene *scene, const qdot_run_request *request, size_t *determined)
{
    qdot_massless massless = {0};
    const qdot_status status = qdot_massless_of_scene(scene, request, &massless);

    *determined = qdot_massless_determines(&massless);
    qdot_massless_clear(&massless);
    return status;
}

qdot_status
qdot_exponents_find(qdot_scene *scene, const qdot_run_request *asked, qdot_exponents *x)
{
    const size_t n = scene->coordinates.n;
    qdot_run_request request = *asked;
    qdot_variation v = {0};
    size_t determined;
    QDOT_TRY(count_determined_values(scene, asked, &determined));
    const size_t k = x->spectrum ? count_directions(scene, determined) : 1;
    qdot_variation_by *by = qdot_calloc(k + 1, sizeof *by);
    char(*names)[24] = qdot_calloc(k + 1, sizeof *names);
    qdot_expr *start = qdot_calloc(2 * n + 1, sizeof *start);
    qdot_status status = by && names && start ? QDOT_OK : QDOT_ENOMEM;

    request.digits = 0;
    if (status == QDOT_OK && scene->constraints.n + determined > 0) {
        status = qdot_method_run_settled(scene, &request, start);
        request.q0 = start;
        request.v0 = start + n;
        request.q_named = request.v_named = NULL;
    }
    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        snprintf(names[i], sizeof names[i], "s%zu", i + 1);
        by[i] = (qdot_variation_by){.name = names[i]};
    }
    if (status == QDOT_OK)
        status = qdot_variation_make(scene, &request, k, by, true, &v);
    if (status == QDOT_OK) {
        pursuit p = {
            .x = x, .v = &v, .request = &request, .n = n, .k = k, .all = (k + 1) * n};

        status = compute_with_scene(&p);
        qdot_method_run_clear(&p.m);
        qdot_free(p.y);
    }
    qdot_variation_clear(&v);
    qdot_free(by);
    qdot_free(names);
    qdot_free(start);
    return status;
}
