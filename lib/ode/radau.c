/* radau.c -- the method radau: Newton's iteration for Radau IIA, error estimate, number of stages. */
#include "ode/radau.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "ode/radau-linear.h"
#include "ode/scale.h"

enum { MOST = QDOT_RADAU_MOST, SPACES = QDOT_RADAU_SPACES };

/* What Newton's iteration may leave, in tolerances; never below so many roundings. What it leaves is alike in
 * all steps, and adds up, so while it converges it goes on to fewer of them; not with multipliers, where a
 * run and its companions were left with an error in common that was larger than what they stated. */
static const double newton = 1e-3, newton_roundings = 10, few_roundings = 0.5;

/* Rates of the iteration: below `reuse` slopes are kept for the next step; below `fast`, above
 * `slow` the number of stages changes, after so many steps. */
static const double reuse = 1e-3, reuse_dear = 0.1, fast = 2e-3, slow = 0.8;
enum { steady = 10, dear = 2 };

/* The error bounds the steps where it is beyond this part of a tolerance; then this rate will do. Below
 * the last one, steps grow at once whatever their stages. */
static const double bounds = 0.02, fair = 0.1, lasts = 2e-3;

/* A step so many times longer than the one before begins at its velocities: the polynomial of that step
 * magnifies rounding and what is left of a transient. */
static const double far = 5;

/* Forces and accelerations agree within this part of the forces; and what is missing makes less than so many
 * tolerances of velocity within the step, is less than so many roundings, or falls to such a part by a change. */
static const double agree = 0.1, harmless = 0.1, agree_roundings = 1000, fell_by = 0.5;

/* Velocities that changes of multipliers make within h count by this: those of the step keep the
 * constraints, whatever these are. */
static const double by_multipliers = 0.05;

/* The factors by which a step is shortened after its iteration failed. */
static const double shorter = 0.6, half = 0.5;

/* The slowest convergence rate to go on with; a multiple of rounding errors of f; an error that lets steps grow. */
static const double stagnates = 0.3, several = 6, grows = 0.03;

typedef struct {
    qdot_radau_linear linear;
    size_t n, p, v; /* numbers of components: y = (q [p], v [v]) */
    size_t m, w; /* m unknowns of the linear equations (v, z); w components of a stage (q, v, z) */
    size_t kind;     /* index of the method in radau-basis.h: 3, 5 or 7 stages */
    bool kept;       /* whether the matrices stay the same along the run */
    double *room;    /* the allocated block that holds the arrays below */
    double *Z;       /* [MOST x w] stages minus (y, z) at the start of the step */
    double *z;       /* [m] multipliers at the start of the step; those of the stages are relative to these */
    double *a;       /* [MOST x m] accelerations of the stages */
    double *R, *R_before; /* [MOST x m] residuals of the equations at the stages; those of the previous iteration */
    double *re, *im; /* [m] right-hand side of a linear system, real and imaginary part */
    double *forces; /* [m] sum of magnitudes of the terms of each force, where the derivatives were evaluated */
    double *weight;  /* [w] weight of each component in error norms, 1/(tol max(scale_i, |y_i|)) */
    double *before;  /* [MOST x w] stages of the last accepted step */
    const qdot_radau_basis *before_basis; /* the Radau method of the stages `before`; NULL: there are none */
    double before_h, h;
    bool slopes, fresh;             /* whether the Jacobian has been evaluated; whether that was at the present y */
    double factored;                /* step length for which the matrices are factored; 0: none */
    double rate, rate_before, left; /* Newton's iteration: mean and last convergence rate, remaining error by last change */
    double fall; /* factor by which the last iteration reduced the residual of the forces */
    int iterations, since; /* iterations of this step; steps since the number of stages changed */
    double ratio;                   /* error ratio (error divided by tolerance) of the last accepted step */
    double fell; /* error ratio of the last step divided by that before, for equal lengths; 0: unknown */
    double most; /* step length not to be exceeded for `cautious` more steps, because the iteration failed */
    int cautious;
    bool rejected;
} radau;

/* --- allocating and choosing stages --------------------------------------------------- */

static void
free_radau(qdot_ode_stepper *s)
{
    radau *r = s->own;

    if (!r)
        return;
    qdot_radau_linear_clear(&r->linear);
    qdot_free(r->room);
    qdot_free(r);
    s->own = NULL;
}

static qdot_status
allocate_radau(qdot_ode_stepper *s)
{
    radau *r = s->own = qdot_calloc(1, sizeof *r);

    if (!r)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_radau_linear_init(&r->linear, s->system));
    r->n = s->system->n;
    r->m = r->linear.m;
    r->v = r->linear.v;
    r->p = r->linear.p;
    r->w = r->p + r->m;
    r->kind = s->tol > 1e-8 ? 1 : 2;
    return qdot_calloc_parts(&r->room, 10,
                             (const qdot_part[]){{&r->Z, MOST * r->w},
                                                 {&r->z, r->m}, /* larger than needed: m exceeds the number of multipliers */
                                                 {&r->a, MOST * r->m},
                                                 {&r->R, MOST * r->m},
                                                 {&r->R_before, MOST * r->m},
                                                 {&r->re, r->m},
                                                 {&r->im, r->m},
                                                 {&r->forces, r->m},
                                                 {&r->weight, r->w},
                                                 {&r->before, MOST * r->w}});
}

static void
start_without_history(qdot_ode_stepper *s)
{
    radau *r = s->own;

    r->before_basis = NULL;
    r->slopes = r->fresh = false;
    r->factored = 0;
    r->rate = r->left = r->fall = 1;
    r->since = 0;
    r->ratio = r->fell = 0;
    r->cautious = 0;
    r->rejected = false;
}

void
qdot_radau_keep_stages(qdot_ode_stepper *s, size_t stages)
{
    radau *r = s->own;

    r->kind = (stages - 3) / 2;
    r->kept = true;
}

/* The larger of a and b; b if a is a NaN. */
static inline double
larger(double a, double b)
{
    return a > b ? a : b;
}

/* --- Newton's iteration for the stages -------------------------------------------------- */

/* The sum over the stages j of w_j x_j for 3, 5 or 7 stages, whose values are `stride` apart in x. */
static inline double
sum_over_stages(size_t stages, const double *w, const double *x, size_t stride)
{
    double sum = w[0] * x[0] + w[1] * x[stride] + w[2] * x[2 * stride];

    if (stages > 3)
        sum = sum + w[3] * x[3 * stride] + w[4] * x[4 * stride];
    if (stages > 5)
        sum = sum + w[5] * x[5 * stride] + w[6] * x[6 * stride];
    return sum;
}

/* Compute the positions of the stages, minus q at the start, from their velocities. */
static void
find_stage_positions(const qdot_ode_stepper *s, const qdot_radau_basis *b, double h)
{
    radau *r = s->own;

    for (size_t i = 0; i < b->stages; i++)
        for (size_t l = 0; l < r->p; l++) {
            const double sum = sum_over_stages(b->stages, b->a[i], r->Z + r->p + l, r->w);

            r->Z[i * r->w + l] =
                h * (b->c[i] * s->y[r->p + l] + (sum + b->c[i] * s->carry[r->p + l]));
        }
}

/* Whether the step is not much longer than the previous one; false if there is none. */
static bool
is_near_last_length(const radau *r)
{
    return r->before_basis && fabs(r->h) <= far * fabs(r->before_h);
}

/* Predict the stages by the polynomial of the last step; by y if there is none or the new step is much longer. */
static void
predict_stages(const qdot_ode_stepper *s, const qdot_radau_basis *b, double h)
{
    radau *r = s->own;
    const qdot_radau_basis *old = is_near_last_length(r) ? r->before_basis : NULL;
    double w[MOST];

    if (!old)
        memset(r->Z, 0, b->stages * r->w * sizeof *r->Z);
    for (size_t i = 0; i < b->stages && old; i++) {
        qdot_radau_interpolate(old, 1 + b->c[i] * h / r->before_h, w);
        w[old->stages - 1] -= 1; /* subtract the value of the polynomial at the end of the old step */
        for (size_t l = r->p; l < r->w; l++)
            r->Z[i * r->w + l] = sum_over_stages(old->stages, w, r->before + l, r->w);
    }
    find_stage_positions(s, b, h);
}

/* Compute the accelerations of the stages: a_i = 1/h sum_j (A^-1)_ij Z_j. */
static void
find_accelerations(radau *r, const qdot_radau_basis *b, double h)
{
    for (size_t i = 0; i < b->stages; i++)
        for (size_t l = 0; l < r->v; l++)
            r->a[i * r->m + l] =
                sum_over_stages(b->stages, b->inverse[i], r->Z + r->p + l, r->w) / h;
}

static qdot_status
find_residuals(qdot_ode_stepper *s, const qdot_radau_basis *b, double t, double h)
{
    radau *r = s->own;

    find_accelerations(r, b, h);
    for (size_t i = 0; i < b->stages; i++) {
        const double *Z = r->Z + i * r->w;

        for (size_t l = 0; l < r->n; l++)
            s->trial[l] = s->y[l] + (s->carry[l] + Z[l]);
        for (size_t l = r->v; l < r->m; l++)
            r->re[l - r->v] = r->z[l - r->v] + Z[r->p + l];
        s->evaluations++;
        QDOT_TRY(qdot_radau_residual(&r->linear, t + b->c[i] * h, s->trial,
                                     r->a + i * r->m, r->re, r->R + i * r->m));
    }
    return QDOT_OK;
}

/* Solve for the change of the velocities that the residuals of the stages require; it replaces `a`. */
static void
solve_for_change(radau *r, const qdot_radau_basis *b)
{
    const size_t m = r->m;

    for (size_t i = 0; i < b->stages; i++)
        memset(r->a + i * m, 0, m * sizeof *r->a);
    for (size_t k = 0; k < b->spaces; k++) {
        for (size_t l = 0; l < m; l++) {
            r->re[l] = sum_over_stages(b->stages, b->left_re[k], r->R + l, m);
            r->im[l] = k ? sum_over_stages(b->stages, b->left_im[k], r->R + l, m) : 0;
        }
        qdot_radau_solve(&r->linear, k, r->re, r->im);
        for (size_t i = 0; i < b->stages; i++)
            for (size_t l = 0; l < m; l++)
                r->a[i * m + l] +=
                    b->right_re[k][i] * r->re[l] - (k ? b->right_im[k][i] * r->im[l] : 0);
    }
}

/* Add the change of velocities, in `a`, to the stages. Returns its size in units of the tolerance. */
static double
apply_change(radau *r, const qdot_radau_basis *b, double h)
{
    double size = 0;

    for (size_t i = 0; i < b->stages; i++) {
        double *Z = r->Z + i * r->w;

        for (size_t l = 0; l < r->p; l++) {
            const double by = h * sum_over_stages(b->stages, b->a[i], r->a + l, r->m);

            Z[l] += by;
            size = larger(fabs(by) * r->weight[l], size);
        }
        for (size_t l = 0; l < r->m; l++) {
            const double by = r->a[i * r->m + l];

            Z[r->p + l] += by;
            size = larger(fabs(by) * r->weight[r->p + l], size);
            if (!isfinite(by))
                return INFINITY;
        }
    }
    return size;
}

/* The change of a stage that rounding errors of f cause, in units of the tolerance. */
static double
change_by_rounding(const qdot_ode_stepper *s, double h)
{
    radau *r = s->own;
    const double part = h / r->linear.basis->lambda_re[0];
    double noise = 0;

    qdot_radau_noise(&r->linear, s->y, s->dydt + r->p, r->z, r->re);
    qdot_radau_solve(&r->linear, 0, r->re, NULL);
    for (size_t l = 0; l < r->v; l++) {
        noise = fmax(noise, fabs(r->re[l]) * r->weight[r->p + l]);
        if (r->p)
            noise = fmax(noise, fabs(part * r->re[l]) * r->weight[l]);
    }
    return several * noise;
}

/* Whether velocity j has no mass, so that the other velocities determine it at every moment. */
static bool
is_massless_velocity(const qdot_radau_linear *l, size_t j)
{
    for (size_t i = 0; i < l->m; i++)
        if (l->mass[i * l->m + j] != 0)
            return false;
    return true;
}

/* What follows at every moment counts by what it does within h: such velocities by positions,
 * multipliers by velocities (they are no results of a step, but the iteration goes on while they are
 * wrong). */
static void
set_algebraic_weights(radau *r, double h)
{
    const qdot_radau_linear *l = &r->linear;

    for (size_t j = 0; j < r->p; j++)
        if (is_massless_velocity(l, j))
            r->weight[r->p + j] = fmin(r->weight[r->p + j], fabs(h) * r->weight[j]);
    for (size_t k = r->v; k < r->m; k++) {
        double most = 0;

        for (size_t i = 0; i < r->v; i++) {
            const double mass = fabs(l->mass[i * r->m + i]);

            if (mass > 0)
                most = fmax(most, fabs(l->dv[i * r->m + k]) / mass * r->weight[r->p + i]);
        }
        r->weight[r->p + k] = by_multipliers * fabs(h) * most;
    }
}

/* The sum of the magnitudes of the terms of f - M a, row l, stage i; forces as where the
 * derivatives were taken. */
static double
sum_of_term_magnitudes(const radau *r, size_t i, size_t l)
{
    const double *mass = r->linear.mass + l * r->m, *dv = r->linear.dv + l * r->m;
    double sum = r->forces[l];

    for (size_t j = 0; j < r->v; j++)
        sum += fabs(mass[j] * r->a[i * r->m + j]);
    for (size_t j = r->v; j < r->m; j++)
        sum += fabs(dv[j] * (r->z[j - r->v] + r->Z[i * r->w + r->p + j]));
    return sum;
}

/* Whether forces and accelerations agree in all stages, as far as forces are known by now. A change may be
 * small because the slopes at the beginning of the step are large, as where dry friction holds, and those
 * of a stage are not, where it slides: what is missing there does not fall by such a change. What a much
 * shorter step left says nothing then. */
static bool
forces_agree(radau *r, const qdot_radau_basis *b)
{
    const bool first = r->iterations == 1;
    const double left = first && !is_near_last_length(r) ? 1 : r->left;
    double worst = 0;

    for (size_t i = 0; i < b->stages; i++)
        for (size_t l = 0; l < r->v; l++) {
            const double missing = fabs(r->R[i * r->m + l]), before = fabs(r->R_before[i * r->m + l]);
            const double matters = harmless * fabs(r->linear.mass[l * r->m + l] / r->h) / r->weight[r->p + l];
            const double fall = first ? r->fall : missing / fmax(before, DBL_MIN);

            if (left * missing > agree * r->forces[l] && left * missing > agree * sum_of_term_magnitudes(r, i, l))
                return false;
            if (missing > matters && (first ? fall * missing > matters : fall > fell_by)
                && missing > agree_roundings * DBL_EPSILON * sum_of_term_magnitudes(r, i, l))
                return false;
            if (!first && before > matters)
                worst = fmax(worst, fall);
        }
    if (worst > 0)
        r->fall = worst;
    return true;
}

/* The power x^(3/4). */
static inline double
power_three_quarters(double x)
{
    return sqrt(x * sqrt(x));
}

/* Iterate to find the stages and their accelerations `a`; *converged tells whether that succeeded. */
static qdot_status
iterate_stages(qdot_ode_stepper *s, const qdot_radau_basis *b, double t, double h,
               bool *converged)
{
    radau *r = s->own;
    const int most = 7 + (int)(b->stages - 3) * 5 / 2;
    const int judged = r->m > r->v ? 3 : 2; /* the first iteration says little about the error of multipliers */
    const double enough = fmax(newton_roundings * DBL_EPSILON / s->tol, newton);
    const double wanted =
        r->m > r->v ? enough : fmax(few_roundings * DBL_EPSILON / s->tol, newton);
    double before = 0;

    *converged = false;
    set_algebraic_weights(r, h);
    predict_stages(s, b, h);
    r->left = power_three_quarters(fmax(r->left, DBL_EPSILON));
    r->fall = is_near_last_length(r) ? power_three_quarters(fmax(r->fall, DBL_EPSILON)) : 1;
    for (r->iterations = 1; r->iterations <= most; r->iterations++) {
        double size, *R = r->R_before;

        r->R_before = r->R;
        r->R = R;
        QDOT_TRY(find_residuals(s, b, t, h));
        solve_for_change(r, b);
        size = apply_change(r, b, h);
        if (!isfinite(size))
            return QDOT_OK;
        if (r->iterations >= judged) {
            const double rate = size / before;

            r->rate = r->iterations == judged ? rate : sqrt(rate * r->rate_before);
            r->rate_before = rate;
            if (size > enough && rate > stagnates && size <= change_by_rounding(s, h)) {
                *converged = true; /* as far as rounding allows */
                find_accelerations(r, b, h);
                return QDOT_OK;
            }
            if (r->rate >= 0.99 && size > enough)
                return QDOT_OK;
            r->left = r->rate < 0.99 ? r->rate / (1 - r->rate) : 1;
            if (size * r->left * pow(fmin(r->rate, 0.99), most - 1 - r->iterations) >
                enough)
                return QDOT_OK;
        }
        before = fmax(size, DBL_MIN);
        if (r->left * size > enough
            || (r->left * size > wanted && r->rate < stagnates && r->iterations < most))
            continue;
        find_accelerations(r, b, h);
        if (forces_agree(r, b)) {
            *converged = true;
            return QDOT_OK;
        }
    }
    return QDOT_OK;
}

/* --- error estimate of a step ---------------------------------------------------------- */

/* The filtered defect at the beginning of the step, f there being `slope` [n] and the state
 * y + by, into s->error; returns its size in tolerances. */
static double
estimate(qdot_ode_stepper *s, const qdot_radau_basis *b, double h, const double *slope)
{
    radau *r = s->own;
    const double part = h / b->lambda_re[0];
    double *q = s->error, *v = q + r->p, size = 0;

    for (size_t l = 0; l < r->n; l++) {
        double sum = slope[l];

        for (size_t i = 0; i < b->stages; i++)
            sum -= b->first[i] * (l < r->p ? s->y[r->p + l] + r->Z[i * r->w + r->p + l]
                                           : r->a[i * r->m + l - r->p]);
        s->error[l] = part * sum;
    }
    for (size_t l = 0; l < r->v; l++)
        v[l] /= part;
    qdot_radau_weigh(&r->linear, v, r->p ? q : NULL, r->re);
    qdot_radau_solve(&r->linear, 0, r->re, NULL);
    for (size_t l = 0; l < r->v; l++)
        v[l] = r->re[l];
    for (size_t l = 0; l < r->p; l++)
        q[l] += part * v[l];
    for (size_t l = 0; l < r->n; l++) {
        const double here = fabs(s->error[l]) * r->weight[l];

        if (!(here <= size))
            size = here;
    }
    return isfinite(size) ? size : INFINITY;
}

/* What rounding of f makes of an estimate that matters is no error of the step, which would get
 * shorter for it and no better. */
static void
ignore_rounding_noise(qdot_ode_stepper *s, double h, double *ratio)
{
    double noise;

    if (*ratio <= grows || !isfinite(*ratio))
        return;
    noise = change_by_rounding(s, h);
    if (!(noise > grows))
        return;
    *ratio = fmax(*ratio - noise, grows);
    s->raised = fmax(s->raised, noise * s->tol);
}

/* Where a motion is stiff and off its slow course the defect is large, and the error is not: once
 * more with f at the state that the estimate leads to. */
static qdot_status
judge_step(qdot_ode_stepper *s, const qdot_radau_basis *b, double t, double h, double *ratio)
{
    radau *r = s->own;

    *ratio = estimate(s, b, h, s->dydt);
    ignore_rounding_noise(s, h, ratio);
    if (*ratio <= 1 || !isfinite(*ratio) || (r->before_basis && !r->rejected))
        return QDOT_OK;
    for (size_t l = 0; l < r->n; l++)
        s->trial[l] = s->y[l] + s->error[l];
    if (qdot_ode_stepper_rhs(s, t, s->trial, s->trial_dydt) != QDOT_OK)
        return QDOT_OK;
    *ratio = estimate(s, b, h, s->trial_dydt);
    ignore_rounding_noise(s, h, ratio);
    return QDOT_OK;
}

/* --- choosing steps and stages --------------------------------------------------------- */

static qdot_status
prepare_matrices(qdot_ode_stepper *s, const qdot_radau_basis *b, double t, double h, bool *regular)
{
    radau *r = s->own;

    if (!r->slopes) {
        s->jacobians++;
        QDOT_TRY(qdot_radau_slopes(&r->linear, t, s->y, s->dydt + r->p,
                                   r->before_basis ? r->re : r->z));
        qdot_radau_noise(&r->linear, s->y, s->dydt + r->p, r->z, r->forces);
        for (size_t l = 0; l < r->m; l++)
            r->forces[l] = fabs(r->forces[l]) / DBL_EPSILON;
        r->slopes = r->fresh = true;
        r->factored = 0;
    }
    *regular = true;
    if (r->factored == h && r->linear.basis == b)
        return QDOT_OK;
    s->factorisations++;
    *regular = qdot_radau_factor(&r->linear, b, h);
    r->factored = *regular ? h : 0;
    return QDOT_OK;
}

/* By how much the error of steps of one length falls from step to step, as a transient dies out: of the
 * last two such factors the lesser one. 1: it does not, or is not known. */
static double
decay_of_error(radau *r, const qdot_radau_basis *b, double h, double ratio)
{
    const double grown = h / r->before_h, before = r->fell;
    double fell = r->ratio / ratio;

    if (r->before_basis != b || r->rejected) {
        r->fell = 0;
        return 1;
    }
    for (size_t i = 0; i < b->stages + 1; i++)
        fell *= grown;
    r->fell = fell;
    return fmax(1, fmin(before, fell));
}

static qdot_status
radau_step(qdot_ode_stepper *s, double t, double h, double *ratio)
{
    radau *r = s->own;
    const qdot_radau_basis *b = qdot_radau_basis_get(r->kind);
    bool converged = false, regular;

    for (size_t l = 0; l < r->n; l++)
        r->weight[l] = 1 / (s->tol * qdot_ode_size(s->system->scales, l, s->y[l]));
    r->h = h;
    while (!converged) {
        QDOT_TRY(prepare_matrices(s, b, t, h, &regular));
        if (regular)
            QDOT_TRY(iterate_stages(s, b, t, h, &converged));
        if (converged || r->fresh)
            break;
        r->slopes = false;
    }
    *ratio = INFINITY;
    if (converged)
        QDOT_TRY(judge_step(s, b, t, h, ratio));
    else
        r->most = shorter * fabs(h), r->cautious = steady;
    if (!converged && regular && r->rate < 1) /* the step control aims at a tenth of the tolerance (adaptive-steps.c) */
        *ratio = fmax(1.01, 0.1 * pow(0.9 / half, (double)b->stages + 1));
    if (!converged && !r->kept && r->kind > 0 && r->ratio <= bounds && r->since >= steady)
        r->kind--, r->since = 0;
    if (*ratio <= 1) {
        const double fell = decay_of_error(r, b, h, *ratio);

        r->ratio = *ratio;
        *ratio /= r->rate < fast && *ratio < bounds ? fell : 1;
    }
    r->rejected = !(*ratio <= 1);
    if (!r->rejected && r->cautious > 0) /* the step control aims at a tenth of the tolerance (adaptive-steps.c) */
        *ratio = fmin(
            1, fmax(*ratio, 0.1 * pow(0.9 * fabs(h) / r->most, (double)b->stages + 1)));
    memcpy(s->z, r->Z + (b->stages - 1) * r->w, r->n * sizeof *s->z);
    for (size_t l = 0; l < r->n; l++)
        s->trial[l] = s->y[l] + (s->carry[l] + s->z[l]);
    return QDOT_OK;
}

/* More stages where the iteration converges fast, or the error bounds the steps and it converges;
 * fewer where it hardly does, and the error would allow longer steps. */
static void
choose_number_of_stages(const qdot_ode_stepper *s)
{
    radau *r = s->own;
    const size_t old = r->kind;
    const bool bound = s->tol < 1e-4 && r->ratio > bounds;

    r->cautious -= r->cautious > 0;
    if (r->kept || ++r->since < steady)
        return;
    if (r->rate < (bound ? fair : fast) && r->ratio > lasts && r->kind + 1 < QDOT_RADAU_KINDS)
        r->kind++;
    else if (r->rate > slow && r->iterations > 2 && r->kind > 0 && !bound)
        r->kind--;
    if (r->kind != old)
        r->since = 0;
}

static void
step_accepted(qdot_ode_stepper *s)
{
    radau *r = s->own;
    double *Z = r->before;

    r->before = r->Z;
    r->Z = Z;
    r->before_basis = r->linear.basis;
    for (size_t l = r->n; l < r->w; l++)
        r->z[l - r->n] += r->before[(r->before_basis->stages - 1) * r->w + l];
    r->before_h = r->h;
    r->fresh = false;
    if (r->rate > (r->m > dear * r->before_basis->stages ? reuse_dear : reuse))
        r->slopes = false;
    choose_number_of_stages(s);
}

static double
power_of_step_in_error(const qdot_ode_stepper *s)
{
    const radau *r = s->own;

    return (double)qdot_radau_basis_get(r->kind)->stages + 1;
}

static size_t
other_number_of_stages(qdot_ode_stepper *s)
{
    radau *r = s->own;

    r->kind = (r->kind + 1) % QDOT_RADAU_KINDS;
    return QDOT_RADAU_KINDS;
}

/* Write rows of F by which states inside the step are interpolated: the stages, then their number. */
static qdot_status
write_interpolation_rows(qdot_ode_stepper *s, double t, double h, double *F)
{
    const radau *r = s->own;
    const size_t stages = r->linear.basis->stages;

    (void)t;
    (void)h;
    for (size_t i = 0; i < stages; i++)
        memcpy(F + i * r->n, r->Z + i * r->w, r->n * sizeof *F);
    F[MOST * r->n] = (double)((stages - 3) / 2);
    return QDOT_OK;
}

static void
interpolate_state(size_t n, const double *F, const double *y0, double x, double *y)
{
    const qdot_radau_basis *b = qdot_radau_basis_get((size_t)F[MOST * n]);
    double w[MOST];

    qdot_radau_interpolate(b, x, w);
    for (size_t i = 0; i < n; i++) {
        double sum = 0;

        for (size_t j = 0; j < b->stages; j++)
            sum += w[j] * F[j * n + i];
        y[i] = y0[i] + sum;
    }
}

const qdot_ode_kernel qdot_radau = {.powers = MOST + 1,
                                    .step = radau_step,
                                    .dense = write_interpolation_rows,
                                    .at = interpolate_state,
                                    .open = allocate_radau,
                                    .close = free_radau,
                                    .restart = start_without_history,
                                    .accepted = step_accepted,
                                    .power = power_of_step_in_error,
                                    .another = other_number_of_stages,
                                    .keeps_step = true,
                                    .forward = true};
