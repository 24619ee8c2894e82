/* constrained-project.c -- states brought back onto the constraints: Newton's method, first on
 * positions, then on velocities. It is called at every step. */
#include "sim/model/constrained.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "sim/model/constrained-parts.h"

/* Smaller components count as this large when rounding is estimated: near 0 the estimate would vanish. */
static const double least_size = 0x1p-10;

/* If a step is predicted to leave less than this fraction of a bound, the residual is not
 * evaluated. */
static const double sure = 0x1p-6;

enum { most_iterations = 6 };

typedef qdot_constrained_level level;

/* Raise the bounds to at least the rounding error of the residuals due to x (q or q'); A must be known. */
void
qdot_constrained_raise_bounds(const level *l, const double *x, double *bound)
{
    for (size_t k = 0; k < l->m; k++) {
        const double now =
            DBL_EPSILON * qdot_saddle_row_size(&l->saddle, k, x, least_size);

        if (!(now <= bound[l->row[k]]))
            bound[l->row[k]] = now;
    }
}

/* Evaluate and factor the matrices M and A of a level at the loaded state. */
qdot_status
qdot_constrained_factor_metric(qdot_constrained *h, level *l)
{
    qdot_constrained_metric(h, l);
    l->filled = true;
    l->moves = l->few && qdot_least_move_factor(&l->move, l->saddle.A, l->saddle.M,
                                                h->plan->n + 1);
    if (l->moves)
        return QDOT_OK;
    QDOT_TRY(qdot_constrained_look_first(h, l));
    return qdot_constrained_factor_rows(h->plan, &l->saddle, l->row);
}

/* One of the two levels: what is moved, q or q', its carry or NULL, and where it is loaded;
 * the tape of its residuals, their bounds. */
typedef struct {
    level *l;
    const qdot_tape *tape;
    double *x, *carry, *loaded;
    double *bound;
} part;

/* The factor by which a step of Newton's method reduces the residual, with M and A of a nearby
 * state, as far as it is known. */
typedef struct {
    bool factored;
    double rate; /* factor by which a Newton step reduces the residual; INFINITY: not known */
} convergence;

/* Add the effect of the low part of the state on the residuals, by A, if A has been evaluated. */
static void
add_effect_of_low_part(const part *p)
{
    for (size_t k = 0; p->carry && p->l->filled && k < p->l->m; k++)
        p->l->residual[k] += qdot_saddle_row(&p->l->saddle, k, p->carry);
}

/* The largest ratio of a residual to its bound; INFINITY if there are no bounds yet, or if it is
 * not finite. */
static double
largest_residual_ratio(const part *p)
{
    double most = 0;

    for (size_t k = 0; k < p->l->m; k++) {
        const double f = fabs(p->l->residual[k]), b = p->bound[p->l->row[k]];

        if (f <= b)
            continue;
        if (!(b > 0 && f < INFINITY))
            return INFINITY;
        most = f > most * b ? f / b : most;
    }
    return most;
}

/* Evaluate the residuals at the loaded state; returns the largest ratio of a residual to its bound. */
static double
part_look(qdot_constrained *h, const part *p)
{
    qdot_tape_eval(p->tape, h->in, p->l->residual, h->work);
    add_effect_of_low_part(p);
    return largest_residual_ratio(p);
}

/* Add x to hi + lo in double-double arithmetic (a copy of qdot_sum_advance, because headers collide). */
static inline void
add_to_double_double(double *hi, double *lo, double x)
{
    double a = *hi, b = *lo + x, s = a + b, bb = s - a;

    *lo = (a - (s - bb)) + (b - bb);
    *hi = s;
}

/* Make one Newton step of the projection, and load the state that it reaches. */
static void
make_projection_step(const part *p, size_t n, double *moved)
{
    level *l = p->l;
    double *change = l->saddle.x, most = *moved;

    for (size_t k = 0; k < l->m; k++)
        change[n + k] = -l->residual[k];
    if (l->moves) {
        qdot_least_move_solve(&l->move, change + n, change);
    } else {
        memset(change, 0, n * sizeof *change);
        qdot_saddle_solve(&l->saddle);
    }
    for (size_t i = 0; i < n; i++) {
        const double size = fabs(p->x[i]), by = fabs(change[i]);

        if (!(by <= most * (size > 1 ? size : 1)))
            most = by / (size > 1 ? size : 1);
        if (p->carry)
            add_to_double_double(&p->x[i], &p->carry[i], change[i]);
        else
            p->x[i] += change[i];
        p->loaded[i] = p->x[i];
    }
    *moved = most;
}

/* The level's noise: how much the residuals of the loaded state change where every input does by about
 * one rounding of max(1, |x|), in a few directions. Writes h->out. */
static void
measure_residual_rounding(qdot_constrained *h, const part *p)
{
    static const double far = 0x1p-30;
    const size_t inputs = 2 * h->plan->n + 1, m = p->l->m;
    double *kept = h->in + inputs, *noise = p->l->noise;
    uint64_t seed = 12345;

    memcpy(kept, h->in, inputs * sizeof *kept);
    memset(noise, 0, m * sizeof *noise);
    for (int k = 0; k < 4; k++) {
        for (size_t i = 0; i < inputs; i++) {
            seed = seed * 1103515245 + 12345;
            h->in[i] = kept[i] + (seed >> 16 & 1 ? far : -far) * fmax(1, fabs(kept[i]));
        }
        qdot_tape_eval(p->tape, h->in, h->out, h->work);
        for (size_t r = 0; r < m; r++) {
            const double change = fabs(h->out[r] - p->l->residual[r]);

            noise[r] = fmax(noise[r], 4 * DBL_EPSILON / far * change);
        }
    }
    memcpy(h->in, kept, inputs * sizeof *kept);
}

/* Whether the residuals are within the effect of rounding of max(1, |x|): if x is 0 so are the
 * bounds, and cannot be met. Nothing is moved for a redundant row: it also has what
 * rounding makes of the slopes of all rows, of which it is a combination. */
static bool
is_correction_rounding(qdot_constrained *h, const part *p)
{
    const qdot_saddle *s = &p->l->saddle;
    const size_t m = p->l->m;
    const bool redundant = !p->l->moves && s->rank < m;
    double noise = 0; /* rounding error of all residuals together, in the scales of the linear system */

    if (redundant)
        measure_residual_rounding(h, p);
    for (size_t k = 0; redundant && k < m; k++)
        noise += s->e[k] * p->l->noise[k];
    for (size_t j = 0; j < m; j++) {
        const size_t k = redundant ? s->pivot[j] : j;
        double bound = DBL_EPSILON * qdot_saddle_row_size(s, k, p->x, 1);

        if (redundant && j >= s->rank)
            bound = fmax(bound, noise / s->e[k]);
        if (!(fabs(p->l->residual[k]) <= bound))
            return false;
    }
    return true;
}

/* M and A stay those of the state at which they were factored (`c`: whether they are); the nearer
 * that state, the faster Newton's method converges. The residual after the last step is predicted
 * from the steps before, not evaluated. */
static qdot_status
iterate_projection(qdot_constrained *h, const part *p, convergence *c, double *moved)
{
    double before = INFINITY;
    bool bounded = false;

    for (int k = 0; k <= most_iterations; k++) {
        double now = part_look(h, p);

        if (bounded)
            c->rate = now / before;
        if (now <= 1)
            return QDOT_OK;
        /* a residual that no longer shrinks consists of rounding errors: stop */
        if (bounded && !(now < 0.5 * before) && now < 1e4)
            return QDOT_OK;
        if (k == most_iterations || isnan(now) || (k > 2 && !(now < before)))
            break;
        if (!bounded) {
            const bool filled = p->l->filled;

            if (!c->factored)
                QDOT_TRY(qdot_constrained_factor_metric(h, p->l));
            c->factored = bounded = true;
            qdot_constrained_raise_bounds(p->l, p->x, p->bound);
            if (!filled)
                add_effect_of_low_part(p);
            now = largest_residual_ratio(p);
            if (now <= 1)
                return QDOT_OK;
        }
        before = now;
        make_projection_step(p, h->plan->n, moved);
        if (c->rate * now <= sure)
            return QDOT_OK;
    }
    return bounded && is_correction_rounding(h, p)
               ? QDOT_OK
               : qdot_fail(QDOT_EDOMAIN, "the constraints cannot be held");
}

qdot_status
qdot_constrained_check_accelerations(qdot_constrained *h, double t, const double *y)
{
    const qdot_saddle *s = &h->at[QDOT_ACCELERATION]->saddle;

    if (h->at[QDOT_ACCELERATION]->m == h->at[QDOT_VELOCITY]->m || s->rank == s->m)
        return QDOT_OK;
    QDOT_TRY(qdot_constrained_solve(h, t, y, h->a, NULL));
    return qdot_constrained_check_repeated(h, QDOT_EDOMAIN);
}

qdot_status
qdot_constrained_project(double t, double *y, double *carry, double *moved, void *user)
{
    qdot_constrained *h = user;
    const size_t n = h->plan->n;
    const part q = {h->at[QDOT_HOLONOMIC],
                    qdot_constrained_tape(h->positions, h->c->positions),
                    y,
                    carry,
                    h->in,
                    h->f_bound};
    const part v = {h->at[QDOT_VELOCITY],
                    qdot_constrained_tape(h->velocities, h->c->velocities),
                    y + n,
                    carry ? carry + n : NULL,
                    h->in + n,
                    h->w_bound};
    convergence c = {.rate = INFINITY};

    *moved = 0;
    if (h->plan->treatment != QDOT_RUN_PROJECT)
        return QDOT_OK;
    qdot_constrained_load(h, t, y);
    if (q.l->m > 0)
        QDOT_TRY(iterate_projection(h, &q, &c, moved));
    if (v.l != q.l)
        c = (convergence){.rate = INFINITY};
    return v.l->m > 0 ? iterate_projection(h, &v, &c, moved) : QDOT_OK;
}
