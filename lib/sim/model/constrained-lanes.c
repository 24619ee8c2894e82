/* constrained-lanes.c -- projects states onto the constraints in vector lanes: positions, then velocities. */
#include "sim/model/constrained-lanes.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "series/lanes.h"
#include "tape/shake.h"

/* Components smaller than this count as this large when rounding of residuals is estimated. */
static const double least_size = 0x1p-10;

enum { L = QDOT_LANES, most_iterations = 6, LEVELS = 2 };

/* The constraints on positions, or those on velocities, that a projection satisfies. */
typedef struct {
    const qdot_tape *tape; /* tape whose outputs are the residuals of these rows */
    size_t m;
    size_t *place; /* [all constraints] index among the constraints of this kind; SIZE_MAX: another kind */
} level;

struct qdot_constrained_lanes {
    const qdot_constraints *c;
    size_t n, numbers; /* number of coordinates; of parameters, which follow the coordinates in the state */
    const qdot_batch_kernels *kernels;
    qdot_tape *copies[3]; /* copies of the tapes with slightly perturbed constants; NULL: use the original tapes */
    const qdot_tape *metric;
    level levels[LEVELS];
    double *in;              /* inputs of the tapes: q, parameters, q', rates of parameters, t */
    double *M, *A, *work;    /* outputs of the tape `metric`, M and A; its scratch */
    double *K, *x; /* factored matrix [(n + m) x (n + m)]; right-hand side, then solution [n + m] */
    double *residual, *size; /* [m] residuals, and the sizes by which they are judged: sum_i |A_ki| max(|x_i|, least) */
};

void
qdot_constrained_lanes_free(qdot_constrained_lanes *h)
{
    if (!h)
        return;
    for (size_t i = 0; i < sizeof h->copies / sizeof *h->copies; i++)
        qdot_tape_free(h->copies[i]);
    for (size_t i = 0; i < LEVELS; i++)
        qdot_free(h->levels[i].place);
    qdot_free(h->in);
    qdot_free(h);
}

/* --- making the projection ----------------------------------------------------------- */

static qdot_status
make_constraints_of_kind(qdot_constrained_lanes *h, level *l, const qdot_tape *tape, qdot_constraint_kind kind)
{
    l->tape = tape;
    l->place = qdot_calloc(h->c->m, sizeof *l->place);
    if (!l->place)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < h->c->m; k++)
        l->place[k] = h->c->rows[k].kind <= kind ? l->m++ : SIZE_MAX;
    return QDOT_OK;
}

static qdot_status
make_projection(qdot_constrained_lanes *h, bool shaken)
{
    const qdot_constraints *c = h->c;
    const qdot_tape *tapes[] = {c->positions, c->velocities, c->metric};
    const size_t n = h->n, size = n + c->m, inputs = 2 * (n + h->numbers) + 1;
    size_t work = 0;

    for (size_t i = 0; i < sizeof tapes / sizeof *tapes; i++) {
        if (shaken)
            QDOT_TRY(qdot_tape_shake(tapes[i], &h->copies[i]));
        if (shaken)
            tapes[i] = h->copies[i];
        if (qdot_tape_work(tapes[i]) > work)
            work = qdot_tape_work(tapes[i]);
    }
    QDOT_TRY(make_constraints_of_kind(h, &h->levels[0], tapes[0], QDOT_HOLONOMIC));
    QDOT_TRY(make_constraints_of_kind(h, &h->levels[1], tapes[1], QDOT_VELOCITY));
    h->metric = tapes[2];
    h->in = qdot_calloc((inputs + c->n_masses + c->n_slopes + work + size * (size + 1) +
                         2 * c->m) * L + 1, sizeof *h->in);
    if (!h->in)
        return QDOT_ENOMEM;
    h->M = h->in + inputs * L;
    h->A = h->M + c->n_masses * L;
    h->work = h->A + c->n_slopes * L;
    h->K = h->work + work * L;
    h->x = h->K + size * size * L;
    h->residual = h->x + size * L;
    h->size = h->residual + c->m * L;
    return QDOT_OK;
}

qdot_status
qdot_constrained_lanes_new(const qdot_plan *plan, bool shaken, qdot_constrained_lanes **lanes)
{
    qdot_constrained_lanes *h = qdot_calloc(1, sizeof *h);
    qdot_status status;

    *lanes = NULL;
    if (!h)
        return QDOT_ENOMEM;
    h->c = plan->constraints;
    h->numbers = plan->n_states;
    h->n = plan->n - h->numbers;
    h->kernels = qdot_batch_kernels_get();
    status = make_projection(h, shaken);
    if (status != QDOT_OK) {
        qdot_constrained_lanes_free(h);
        return status;
    }
    *lanes = h;
    return QDOT_OK;
}

/* --- one level: positions, or velocities --------------------------------------------- */

/* The variables that a projection moves (q or q'), their low parts, and their position in the tapes' inputs. */
typedef struct {
    const level *l;
    double *x, *carry, *loaded; /* [n] the variables, their low parts, their addresses in the inputs */
    bool open[L];               /* lanes whose projection has not converged yet */
    double before[L];
} newton;

static void
factor_projection_matrix(qdot_constrained_lanes *h, const level *l)
{
    const qdot_constraints *c = h->c;
    const size_t size = h->n + l->m;

    memset(h->K, 0, size * size * L * sizeof *h->K);
    for (size_t k = 0; k < c->n_masses; k++)
        if (c->masses[k].row < h->n)
            memcpy(h->K + (c->masses[k].row * size + c->masses[k].column) * L, h->M + k * L,
                   L * sizeof *h->K);
    for (size_t k = 0; k < c->n_slopes; k++) {
        const size_t row = l->place[c->slopes[k].row];

        if (row != SIZE_MAX)
            memcpy(h->K + ((h->n + row) * size + c->slopes[k].column) * L, h->A + k * L,
                   L * sizeof *h->K);
    }
    h->kernels->factor(size, h->n, h->K);
}

/* Find the rounding error of the residuals due to that of x; components below `least` count as `least`. */
static void
find_residual_rounding(qdot_constrained_lanes *h, const newton *p, double least)
{
    const qdot_constraints *c = h->c;

    memset(h->size, 0, p->l->m * L * sizeof *h->size);
    for (size_t k = 0; k < c->n_slopes; k++) {
        const size_t row = p->l->place[c->slopes[k].row];
        const double *x = p->x + c->slopes[k].column * L;

        for (size_t l = 0; l < L && row != SIZE_MAX; l++)
            h->size[row * L + l] +=
                fabs(h->A[k * L + l]) * (fabs(x[l]) > least ? fabs(x[l]) : least);
    }
}

static void
residuals_look(qdot_constrained_lanes *h, const newton *p)
{
    const qdot_constraints *c = h->c;

    qdot_lanes_eval_near(p->l->tape, h->in, h->residual, h->work);
    for (size_t k = 0; k < c->n_slopes; k++) {
        const size_t row = p->l->place[c->slopes[k].row];
        const double *carry = p->carry + c->slopes[k].column * L;

        for (size_t l = 0; l < L && row != SIZE_MAX; l++)
            h->residual[row * L + l] += h->A[k * L + l] * carry[l];
    }
}

/* The largest ratio, in one lane, of a residual to its rounding error; at least 1. */
static double
largest_residual_ratio(const qdot_constrained_lanes *h, const newton *p, size_t lane)
{
    double most = 1;

    for (size_t k = 0; k < p->l->m; k++) {
        const double f = fabs(h->residual[k * L + lane]);
        const double bound = DBL_EPSILON * h->size[k * L + lane];

        if (!(f < INFINITY))
            return NAN;
        if (f > most * bound)
            most = f / bound;
    }
    return most;
}

/* Decide by the residuals of iteration k which lanes are done and which fail. Returns whether a
 * lane goes on. */
static bool
check_convergence(qdot_constrained_lanes *h, newton *p, int k, double *moved)
{
    bool some = false, failed[L] = {false}, any_failed = false;

    for (size_t l = 0; l < L; l++) {
        const double now = p->open[l] ? largest_residual_ratio(h, p, l) : 0;

        if (!p->open[l])
            continue;
        /* a residual that no longer shrinks consists of rounding errors: stop */
        if (now <= 1 || (k > 0 && !(now < 0.5 * p->before[l]) && now < 1e4))
            p->open[l] = false;
        else if (k == most_iterations || isnan(now) || (k > 2 && !(now < p->before[l])))
            p->open[l] = !(failed[l] = any_failed = true);
        p->before[l] = now;
        some |= p->open[l];
    }
    if (!any_failed)
        return some;
    find_residual_rounding(h, p, 1);
    for (size_t l = 0; l < L; l++)
        if (failed[l] && !(largest_residual_ratio(h, p, l) <= 1))
            moved[l] = NAN;
    find_residual_rounding(h, p, least_size);
    return some;
}

/* Add x to the double-double number hi + lo (num/sum.h). */
static inline void
add_to_double_double(double *hi, double *lo, double x)
{
    const double a = *hi, b = *lo + x, s = a + b, bb = s - a;

    *lo = (a - (s - bb)) + (b - bb);
    *hi = s;
}

static void
make_newton_step(qdot_constrained_lanes *h, newton *p, double *moved)
{
    const size_t n = h->n, m = p->l->m;

    memset(h->x, 0, n * L * sizeof *h->x);
    for (size_t i = 0; i < m * L; i++)
        h->x[n * L + i] = -h->residual[i];
    h->kernels->solve(n + m, n, h->K, h->x);
    for (size_t i = 0; i < n * L; i++) {
        const double size = fabs(p->x[i]) > 1 ? fabs(p->x[i]) : 1;
        const size_t l = i % L;

        if (!p->open[l])
            continue;
        if (!(fabs(h->x[i]) <= moved[l] * size))
            moved[l] = fabs(h->x[i]) / size;
        add_to_double_double(&p->x[i], &p->carry[i], h->x[i]);
        p->loaded[i] = p->x[i];
    }
}

/* Project by Newton's method in vector lanes onto the rows of one level. *factored: K is factored
 * for these rows. */
static void
iterate_until_on_constraints(qdot_constrained_lanes *h, newton *p, bool *factored, double *moved)
{
    for (size_t l = 0; l < L; l++) {
        p->open[l] = !isnan(moved[l]);
        p->before[l] = INFINITY;
    }
    find_residual_rounding(h, p, least_size);
    for (int k = 0; k <= most_iterations; k++) {
        residuals_look(h, p);
        if (!check_convergence(h, p, k, moved))
            return;
        if (!*factored)
            factor_projection_matrix(h, p->l);
        *factored = true;
        make_newton_step(h, p, moved);
    }
}

void
qdot_constrained_lanes_project(qdot_constrained_lanes *h, const double *t, double *y,
                               double *carry, double *moved)
{
    const size_t n = h->n, all = n + h->numbers;
    bool factored = false;

    memcpy(h->in, y, n * L * sizeof *y);
    memcpy(h->in + n * L, y + 2 * n * L, h->numbers * L * sizeof *y);
    memcpy(h->in + all * L, y + n * L, n * L * sizeof *y);
    memcpy(h->in + 2 * all * L, t, L * sizeof *t);
    memset(moved, 0, L * sizeof *moved);
    qdot_lanes_eval_near(h->metric, h->in, h->M, h->work);
    for (size_t k = 0; k < LEVELS; k++) {
        newton p = {.l = h->levels + k,
                    .x = y + k * n * L,
                    .carry = carry + k * n * L,
                    .loaded = h->in + k * all * L};

        if (p.l->m == 0)
            continue;
        if (k > 0 && p.l->m != h->levels[0].m)
            factored = false;
        iterate_until_on_constraints(h, &p, &factored, moved);
    }
}
