/* watch.c -- polynomials of the functions, part by part, and their roots. */
#include "sim/watch.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "num/chebyshev.h"
#include "tape/shake.h"

enum { NODES = QDOT_CHEBYSHEV_MOST, LEAST = 16, DEEPEST = 60, MOST_PARTS = 4000 };

/* What is small beside the largest coefficient: for a fit, and for the value of a
 * function divided by the time since it was 0. */
static const double resolved = 0x1p-44, resolved_start = 1e-9;

struct qdot_watch {
    const qdot_plan *plan;
    qdot_tape *tape, *sizes; /* g; the sums of the sizes of their terms */
    size_t m, n; /* functions; coordinates */
    bool accelerations;
    double tol;
    size_t *coordinate; /* [m] SIZE_MAX: not a bound */
    double *bound;      /* [m] */
    double *in;         /* of the tape */
    double *dydt;       /* [2n] */
    double *work, *g;   /* [m] g */
    double *moved;      /* [m] scratch of noise */
    double *z;          /* [2n] likewise */
    double *noise;      /* [m] of g in this step; NaN: not asked for */
    double *final;      /* [m] g at its end */
    double length;      /* of the step */

    /* The step's start, and how far it has been looked at. */
    double t, *y; /* [2n] */
    struct state {
        int *sign;  /* [m] the last that was not 0; 0: none yet */
        bool *on;   /* [m] g is 0 here, and so is it behind: */
        double *g0; /* [m] g here */
    } start, now;
    int *first;  /* [m] */
    bool *slow;  /* [m] it leaves its zero slower than can be told at the start */
    bool *fresh; /* [m] nothing of `first` is known yet */
    bool *live;  /* [m] may have a root in this step */
    int nodes;   /* that did the last time */
    double *samples; /* [m x NODES] */
    double *ends;    /* [(DEEPEST + 2) x m] g at the ends of the parts that wait */
    qdot_vec(qdot_root) roots;
};

typedef struct {
    const qdot_watch_reader *reader;
    double direction;
} walk;

static int
sign_of(double x)
{
    return (x > 0) - (x < 0);
}

/* --- values ------------------------------------------------------------------------- */

/* g [m] at the state in w->in. */
static qdot_status
evaluate(qdot_watch *w, const qdot_watch_reader *reader, double t, double *g)
{
    w->in[2 * w->n] = t;
    if (w->accelerations && reader->held) {
        QDOT_TRY(qdot_constrained_solve(reader->held, t, w->in, w->in + 2 * w->n + 1,
                                 w->in + 3 * w->n + 1));
    } else if (w->accelerations) {
        QDOT_TRY(reader->system->rhs(t, w->in, w->dydt, reader->system->user));
        memcpy(w->in + 2 * w->n + 1, w->dydt + w->n, w->n * sizeof *w->in);
    }
    qdot_tape_eval(w->tape, w->in, g, w->work);
    for (size_t i = 0; i < w->m; i++)
        if (!isfinite(g[i]))
            return qdot_fail(QDOT_EDOMAIN, "an event is undefined at t = %.15g", t);
    return QDOT_OK;
}

static qdot_status
evaluate_at(qdot_watch *w, const qdot_watch_reader *reader, double t, double *g)
{
    QDOT_TRY(reader->read(t, w->in, reader->user));
    return evaluate(w, reader, t, g);
}

/* How far g_i moves where every number of the state does by the part `by` of itself. */
static qdot_status
noise_at(qdot_watch *w, const qdot_watch_reader *reader, double t, const double *y,
         double by, double least, size_t i, double *noise)
{
    double g;

    *noise = 0;
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    QDOT_TRY(evaluate(w, reader, t, w->moved));
    g = w->moved[i];
    for (size_t k = 0; k <= 2 * w->n; k++) {
        double at = k < 2 * w->n ? y[k] : t, to = at + by * copysign(fmax(least, fabs(at)), at);
        qdot_status status;

        if (to == at)
            continue;
        memcpy(w->in, y, 2 * w->n * sizeof *y);
        if (k < 2 * w->n)
            w->in[k] = to;
        status = evaluate(w, reader, k < 2 * w->n ? t : to, w->moved);
        if (status == QDOT_EDOMAIN || status == QDOT_ESINGULAR)
            continue;
        QDOT_TRY(status);
        *noise += fabs(w->moved[i] - g);
    }
    return QDOT_OK;
}

/* --- locating a root in doubles of t ------------------------------------------------- */

/* Whether g_i has gone over to `way` at t. */
static qdot_status
gone_over(qdot_watch *w, const walk *k, size_t i, int way, double t, bool *over,
          double *value)
{
    QDOT_TRY(evaluate_at(w, k->reader, t, w->g));
    *value = w->g[i];
    *over = w->g[i] == 0 || sign_of(w->g[i]) == way;
    return QDOT_OK;
}

/* Within lo .. hi, which differ in sign, near guess. */
static qdot_status
locate(qdot_watch *w, const walk *k, size_t i, int way, double lo, double hi,
       double guess, qdot_root *root)
{
    double step = 4 * (nextafter(fabs(guess), INFINITY) - fabs(guess)), value;
    double at_lo = 0, at_hi = 0;
    bool over;

    guess = k->direction > 0 ? fmin(fmax(guess, lo), hi) : fmax(fmin(guess, lo), hi);
    QDOT_TRY(gone_over(w, k, i, way, guess, &over, &value));
    for (bool back = over;; step *= 8) { /* outward from the guess */
        double t = guess + (back ? -1 : 1) * k->direction * step;

        if (back) {
            hi = guess;
            at_hi = value;
        } else {
            lo = guess;
            at_lo = value;
        }
        if (back ? k->direction * (t - lo) <= 0 : k->direction * (hi - t) <= 0)
            break;
        guess = t;
        QDOT_TRY(gone_over(w, k, i, way, guess, &over, &value));
        if (over != back) {
            if (over) {
                hi = guess;
                at_hi = value;
            } else {
                lo = guess;
                at_lo = value;
            }
            break;
        }
    }
    for (;;) {
        double middle = lo + 0.5 * (hi - lo);

        if (middle == lo || middle == hi)
            break;
        QDOT_TRY(gone_over(w, k, i, way, middle, &over, &value));
        if (over) {
            hi = middle;
            at_hi = value;
        } else {
            lo = middle;
            at_lo = value;
        }
    }
    *root = (qdot_root){i, hi, way, fmax(fabs(at_lo), fabs(at_hi))};
    return QDOT_OK;
}

/* --- one function on one part -------------------------------------------------------- */

typedef struct {
    double a, b; /* times */
    int n;
    double c[NODES];
    bool from_zero; /* it is (g - g(a)) (b - a)/(t - a) */
    double at_end;  /* g(b) */
} part;

/* How far rounding moves the nodes, of the length of the part. */
static double
blur(const part *p)
{
    return DBL_EPSILON * fmax(fabs(p->a), fabs(p->b)) / fabs(p->b - p->a);
}

/* Below which part of its size a function is not told from 0 where it leaves a zero. */
static double
least_slope(const part *p)
{
    return fmax(resolved_start, 64 * blur(p));
}

static double
time_at(const part *p, double x)
{
    return 0.5 * (p->a + p->b) + 0.5 * (p->b - p->a) * x;
}

static qdot_status
push_root(qdot_watch *w, qdot_root root)
{
    return qdot_vec_push(&w->roots, root);
}

/* Whether an extremum of value v at x is a root. */
static qdot_status
is_touch(qdot_watch *w, const walk *k, const part *p, size_t i, double x, double v,
         bool *touch)
{
    double size = qdot_chebyshev_size(p->n, p->c), noise = 0;
    double t = time_at(p, x);

    *touch = fabs(v) <= 0x1p-48 * size;
    if (*touch || p->from_zero || fabs(v) > 1e-3 * size)
        return QDOT_OK;
    QDOT_TRY(k->reader->read(t, w->z, k->reader->user));
    QDOT_TRY(noise_at(w, k->reader, t, w->z, fmax(w->tol, 0x1p-50), 0, i, &noise));
    *touch = fabs(v) <= noise;
    return QDOT_OK;
}

/* The root of the polynomial between x0 and x1, where it is monotone. */
static double
between(const part *p, double x0, double x1, int way)
{
    for (int k = 0; k < 60 && x1 - x0 > 1e-16; k++) {
        double x = 0.5 * (x0 + x1);

        if (sign_of(qdot_chebyshev_at(p->n, p->c, x)) == way)
            x1 = x;
        else
            x0 = x;
    }
    return x1;
}

/* The sign of a function behind its zero at the start of the part. */
static int
leaves_to(const part *p)
{
    double at_start = qdot_chebyshev_at(p->n, p->c, -1);

    if (fabs(at_start) > least_slope(p) * qdot_chebyshev_size(p->n, p->c))
        return sign_of(at_start);
    return sign_of(qdot_chebyshev_at(p->n, p->c, 1));
}

/* The zero at the start of the part: what became of it. */
static qdot_status
pass_start(qdot_watch *w, const part *p, size_t i, int sign)
{
    int before = w->now.sign[i];

    if (before != 0 && sign != 0)
        QDOT_TRY(push_root(w, (qdot_root){i, p->a, before == sign ? 0 : sign, 0}));
    w->now.sign[i] = sign != 0 ? sign : before;
    return QDOT_OK;
}

/* Whether the function is nothing but rounding on the part. */
static bool
vanishes(const qdot_watch *w, const part *p, size_t i)
{
    double size = qdot_chebyshev_size(p->n, p->c);

    return size == 0 || size <= (p->from_zero ? 1e5 : 16) * w->noise[i];
}

static qdot_status
roots_of(qdot_watch *w, const walk *k, const part *p, size_t i)
{
    double d[NODES], x[NODES + 2], from = p->a, x_from = -1;
    int n = 0, sign = w->now.sign[i];

    if (vanishes(w, p, i)) {
        w->now.on[i] = true;
        w->now.g0[i] = p->at_end;
        return QDOT_OK;
    }
    if (p->from_zero) {
        sign = leaves_to(p);
        QDOT_TRY(pass_start(w, p, i, sign));
    }
    if (qdot_chebyshev_sign(p->n, p->c) == 0) {
        qdot_chebyshev_derivative(p->n, p->c, d);
        n = qdot_chebyshev_crossings(p->n - 1, d, x);
    }
    x[n++] = 1;
    for (int e = 0; e < n; e++) {
        double v = qdot_chebyshev_at(p->n, p->c, x[e]);
        int there = e + 1 < n ? sign_of(v) : sign_of(p->at_end);
        double to = e + 1 < n ? time_at(p, x[e]) : p->b;
        bool touch = false;
        qdot_root root;

        if (e + 1 < n && there != 0)
            QDOT_TRY(is_touch(w, k, p, i, x[e], v, &touch));
        if (touch || (e + 1 < n && there == 0)) {
            if (sign != 0)
                QDOT_TRY(push_root(w, (qdot_root){i, to, 0, fabs(v)}));
            continue;
        }
        if (there != 0 && sign != 0 && there != sign) {
            double guess = time_at(p, between(p, x_from, x[e], there));

            QDOT_TRY(locate(w, k, i, there, from, to, guess, &root));
            QDOT_TRY(push_root(w, root));
        }
        sign = there != 0 ? there : sign;
        from = to;
        x_from = x[e];
    }
    w->now.sign[i] = sign;
    if (w->fresh[i]) {
        w->first[i] = p->from_zero ? leaves_to(p) : sign_of(w->now.g0[i]);
        w->slow[i] = p->from_zero
                     && fabs(qdot_chebyshev_at(p->n, p->c, -1))
                            <= least_slope(p) * qdot_chebyshev_size(p->n, p->c);
        w->fresh[i] = false;
    }
    w->now.on[i] = p->at_end == 0;
    w->now.g0[i] = p->at_end;
    return QDOT_OK;
}

/* --- parts of a step ----------------------------------------------------------------- */

typedef enum { GOOD, MORE_NODES, SPLIT, SPLIT_START } verdict;

/* Fit function i to the samples on a part. */
static verdict
fit(qdot_watch *w, part *p, size_t i, int nodes)
{
    const double *g = w->samples + i * NODES;
    double values[NODES], size;

    p->n = nodes;
    p->from_zero = w->now.on[i];
    for (int j = 0; j < nodes; j++) {
        values[j] = g[j];
        if (p->from_zero) {
            double t = time_at(p, qdot_chebyshev_node(nodes, j));

            values[j] = (g[j] - w->now.g0[i]) * ((p->b - p->a) / (t - p->a));
        }
    }
    qdot_chebyshev_fit(nodes, values, p->c);
    size = qdot_chebyshev_size(nodes, p->c);
    if (!vanishes(w, p, i)
        && qdot_chebyshev_tail(nodes, p->c)
               > fmax(((p->from_zero ? 1e-11 : resolved) + 8 * blur(p)) * size,
                      isnan(w->noise[i]) ? 0 : (p->from_zero ? 1e4 : 8) * w->noise[i]))
        return MORE_NODES;
    if (p->from_zero && !vanishes(w, p, i)
        && fabs(qdot_chebyshev_at(nodes, p->c, -1)) <= least_slope(p) * size)
        return SPLIT_START;
    return GOOD;
}

static qdot_status
sample(qdot_watch *w, const walk *k, const part *p, int nodes)
{
    for (int j = 0; j < nodes; j++) {
        QDOT_TRY(evaluate_at(w, k->reader, time_at(p, qdot_chebyshev_node(nodes, j)),
                             w->g));
        for (size_t i = 0; i < w->m; i++)
            w->samples[i * NODES + (size_t)j] = w->g[i];
    }
    return QDOT_OK;
}

/* What the part needs, of all functions that are looked at. */
static verdict
judge(qdot_watch *w, part *p, int nodes)
{
    verdict worst = GOOD;

    for (size_t i = 0; i < w->m; i++) {
        verdict v = w->live[i] ? fit(w, p, i, nodes) : GOOD;

        if (v == MORE_NODES && nodes == NODES)
            v = SPLIT;
        worst = v > worst ? v : worst;
    }
    return worst;
}

/* A part this short is taken as it is. */
static bool
is_short(const qdot_watch *w, const part *p)
{
    double t = fmax(fabs(p->a), fabs(p->b));

    return fabs(p->b - p->a) <= fmax(65536 * DBL_EPSILON * t, 0x1p-44 * w->length);
}

/* Where 64 nodes are not enough: rounding may be all there is. */
static qdot_status
find_noise(qdot_watch *w, const walk *k)
{
    memcpy(w->z, w->y, 2 * w->n * sizeof *w->z);
    for (size_t i = 0; i < w->m; i++)
        if (w->live[i] && isnan(w->noise[i])) {
            QDOT_TRY(noise_at(w, k->reader, w->t, w->z, 4 * DBL_EPSILON, 0, i,
                              &w->noise[i]));
            memcpy(w->in, w->z, 2 * w->n * sizeof *w->in);
            QDOT_TRY(evaluate(w, k->reader, w->t, w->g)); /* q'' too */
            qdot_tape_eval(w->sizes, w->in, w->moved, w->work);
            w->noise[i] += 4 * DBL_EPSILON * (w->moved[i] + fabs(w->final[i]));
        }
    return QDOT_OK;
}

static qdot_status
look_at_part(qdot_watch *w, const walk *k, part *p, const double *at_end, verdict *v)
{
    int nodes = w->nodes;

    for (;; nodes *= 2) {
        QDOT_TRY(sample(w, k, p, nodes));
        *v = judge(w, p, nodes);
        if (*v == SPLIT) {
            QDOT_TRY(find_noise(w, k));
            *v = judge(w, p, nodes);
        }
        if (*v != MORE_NODES || nodes == NODES)
            break;
    }
    if (*v != GOOD && !is_short(w, p))
        return QDOT_OK;
    *v = GOOD;
    w->nodes = nodes > LEAST ? nodes : LEAST;
    for (size_t i = 0; i < w->m; i++) {
        if (!w->live[i])
            continue;
        (void)fit(w, p, i, nodes);
        p->at_end = at_end[i];
        QDOT_TRY(roots_of(w, k, p, i));
    }
    return QDOT_OK;
}

/* The whole step, left to right; parts that wait stand on a stack of their ends. */
static qdot_status
look_at_step(qdot_watch *w, const walk *k, double t)
{
    double ends[DEEPEST + 2], from = w->t;
    int depth = 0, parts = 0;

    ends[0] = t;
    memcpy(w->ends, w->final, w->m * sizeof *w->ends);
    for (depth = 1; depth > 0;) {
        part p = {.a = from, .b = ends[depth - 1]};
        const double *at_end = w->ends + (size_t)(depth - 1) * w->m;
        double middle;
        verdict v;

        QDOT_TRY(qdot_interrupt_check());
        QDOT_TRY(look_at_part(w, k, &p, at_end, &v));
        if (v == GOOD) {
            from = p.b;
            depth--;
            continue;
        }
        middle = p.a + (p.b - p.a) * (v == SPLIT_START ? 0.0625 : 0.5);
        if (depth == DEEPEST || ++parts > MOST_PARTS)
            return qdot_fail(QDOT_EFAILED,
                             "an event cannot be resolved at t = %.15g", p.a);
        QDOT_TRY(evaluate_at(w, k->reader, middle, w->g));
        ends[depth] = middle;
        memcpy(w->ends + (size_t)depth * w->m, w->g, w->m * sizeof *w->g);
        depth++;
    }
    return QDOT_OK;
}

/* --- steps --------------------------------------------------------------------------- */

/* Whether a bound is far from the step. */
static bool
is_far(const qdot_watch *w, size_t i, double t, const double *y,
       const qdot_ode_series *series, int order, double unit)
{
    size_t c = w->coordinate[i];
    double distance = fabs(w->y[c] - w->bound[i]), reach = 0, s;

    if (!series)
        return fmin(distance, fabs(y[c] - w->bound[i]))
               > fabs(t - w->t) * fmax(fabs(w->y[w->n + c]), fabs(y[w->n + c]));
    s = fabs((t - w->t) / unit);
    for (int p = order; p > 0; p--)
        reach = (reach + fabs(series->x[c * series->stride + (size_t)p])) * s;
    return distance > reach;
}

static int
by_time(const qdot_root *a, const qdot_root *b, double direction)
{
    return a->t != b->t ? (direction * (a->t - b->t) > 0 ? 1 : -1)
                        : (a->function > b->function) - (a->function < b->function);
}

static void
sort_roots(qdot_watch *w, double direction)
{
    for (size_t i = 1; i < w->roots.n; i++) {
        qdot_root root = w->roots.at[i];
        size_t k = i;

        for (; k > 0 && by_time(&w->roots.at[k - 1], &root, direction) > 0; k--)
            w->roots.at[k] = w->roots.at[k - 1];
        w->roots.at[k] = root;
    }
}

static void
copy_state(const qdot_watch *w, struct state *to, const struct state *from)
{
    memcpy(to->sign, from->sign, w->m * sizeof *to->sign);
    memcpy(to->on, from->on, w->m * sizeof *to->on);
    memcpy(to->g0, from->g0, w->m * sizeof *to->g0);
}

/* The run ends on a zero: it is one. */
static qdot_status
end_on_zero(qdot_watch *w, double t)
{
    for (size_t i = 0; i < w->m; i++)
        if (w->now.g0[i] == 0 && w->now.sign[i] != 0 && w->live[i])
            QDOT_TRY(push_root(w, (qdot_root){i, t, -w->now.sign[i], 0}));
    return QDOT_OK;
}

qdot_status
qdot_watch_step(qdot_watch *w, const qdot_watch_reader *reader, double t,
                const double *y, bool last, const qdot_ode_series *series, int order,
                double unit, const qdot_root **roots, size_t *n)
{
    walk k = {reader, t < w->t ? -1 : 1};
    bool any = false;

    copy_state(w, &w->now, &w->start);
    w->roots.n = 0;
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    QDOT_TRY(evaluate(w, reader, t, w->final));
    w->length = fabs(t - w->t);
    for (size_t i = 0; i < w->m; i++) {
        w->live[i] = w->coordinate[i] == SIZE_MAX || w->start.on[i]
                     || sign_of(w->final[i]) != w->start.sign[i]
                     || !is_far(w, i, t, y, series, order, unit);
        any |= w->live[i];
        w->noise[i] = NAN;
        w->fresh[i] = true;
        w->first[i] = w->start.sign[i];
        w->slow[i] = false;
    }
    if (any)
        QDOT_TRY(look_at_step(w, &k, t));
    if (last)
        QDOT_TRY(end_on_zero(w, t));
    for (size_t i = 0; i < w->m; i++)
        if (!w->live[i]) {
            w->now.g0[i] = w->final[i];
            w->now.on[i] = false;
        }
    sort_roots(w, k.direction);
    *roots = w->roots.at;
    *n = w->roots.n;
    w->in[2 * w->n] = t;
    memcpy(w->in, y, 2 * w->n * sizeof *y); /* for _take */
    return QDOT_OK;
}

bool
qdot_watch_is_far(const qdot_watch *w, double t, const qdot_ode_series *series, int order,
                  double unit)
{
    for (size_t i = 0; i < w->m; i++)
        if (w->coordinate[i] == SIZE_MAX || w->start.on[i]
            || !is_far(w, i, t, NULL, series, order, unit))
            return false;
    return true;
}

void
qdot_watch_pass(qdot_watch *w, double t, const double *y)
{
    memcpy(w->y, y, 2 * w->n * sizeof *y);
    w->t = t;
    for (size_t i = 0; i < w->m; i++)
        w->start.g0[i] = y[w->coordinate[i]] - w->bound[i];
}

void
qdot_watch_take(qdot_watch *w)
{
    copy_state(w, &w->start, &w->now);
    memcpy(w->y, w->in, 2 * w->n * sizeof *w->y);
    w->t = w->in[2 * w->n];
}

qdot_status
qdot_watch_begin(qdot_watch *w, const qdot_watch_reader *reader, double t,
                 const double *y, double least, const int *before,
                 const double *residual, bool *on)
{
    memcpy(w->y, y, 2 * w->n * sizeof *y);
    w->t = t;
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    QDOT_TRY(evaluate(w, reader, t, w->start.g0));
    for (size_t i = 0; i < w->m; i++) {
        double g = w->start.g0[i], noise;

        QDOT_TRY(noise_at(w, reader, t, y, DBL_EPSILON, least, i, &noise));
        w->start.on[i] = fabs(g) <= 2 * noise;
        if (residual && residual[i] >= 0)
            w->start.on[i] = w->start.on[i] || fabs(g) <= 4 * residual[i];
        w->start.sign[i] = w->start.on[i] ? before[i] : sign_of(g);
        on[i] = w->start.on[i];
    }
    return QDOT_OK;
}

const int *
qdot_watch_first(const qdot_watch *w)
{
    return w->first;
}

const bool *
qdot_watch_slow(const qdot_watch *w)
{
    return w->slow;
}

const int *
qdot_watch_signs(const qdot_watch *w)
{
    return w->now.sign;
}

qdot_status
qdot_watch_look(qdot_watch *w, const qdot_watch_reader *reader, double t,
                const double *y, int *signs)
{
    memcpy(w->in, y, 2 * w->n * sizeof *y);
    QDOT_TRY(evaluate(w, reader, t, w->g));
    for (size_t i = 0; i < w->m; i++)
        signs[i] = sign_of(w->g[i]);
    return QDOT_OK;
}

/* --- building ------------------------------------------------------------------------ */

void
qdot_watch_is_bound(qdot_watch *w, size_t i, size_t coordinate, double bound)
{
    w->coordinate[i] = coordinate;
    w->bound[i] = bound;
}

void
qdot_watch_free(qdot_watch *w)
{
    if (!w)
        return;
    qdot_tape_free(w->tape);
    qdot_tape_free(w->sizes);
    qdot_free(w->coordinate);
    qdot_free(w->bound);
    qdot_free(w->in);
    qdot_free(w->roots.at);
    qdot_free(w->first);
    qdot_free(w->live);
    qdot_free(w);
}

/* Room for everything: numbers in one block, signs in another, flags in a third. */
static qdot_status
make_room(qdot_watch *w)
{
    size_t m = w->m, n = w->n, work = qdot_tape_work(w->tape);
    size_t inputs = qdot_tape_inputs(w->tape);

    if (qdot_tape_work(w->sizes) > work)
        work = qdot_tape_work(w->sizes);
    double *at = qdot_calloc(inputs + 2 * n + 2 * n + 2 * n + work + 6 * m + NODES * m
                                 + (DEEPEST + 2) * m + 1,
                             sizeof *at);
    int *signs = qdot_calloc(3 * m + 1, sizeof *signs);
    bool *flags = qdot_calloc(5 * m + 1, sizeof *flags);

    w->in = at;
    w->first = signs;
    w->live = flags;
    w->coordinate = qdot_malloc((m + 1) * sizeof *w->coordinate);
    w->bound = qdot_calloc(m + 1, sizeof *w->bound);
    if (!at || !signs || !flags || !w->coordinate || !w->bound)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < m; i++)
        w->coordinate[i] = SIZE_MAX;
    w->dydt = w->in + inputs;
    w->y = w->dydt + 2 * n;
    w->z = w->y + 2 * n;
    w->work = w->z + 2 * n;
    w->g = w->work + work;
    w->moved = w->g + m;
    w->noise = w->moved + m;
    w->final = w->noise + m;
    w->start.g0 = w->final + m;
    w->now.g0 = w->start.g0 + m;
    w->samples = w->now.g0 + m;
    w->ends = w->samples + NODES * m;
    w->start.sign = signs + m;
    w->now.sign = signs + 2 * m;
    w->fresh = flags + m;
    w->start.on = flags + 2 * m;
    w->now.on = flags + 3 * m;
    w->slow = flags + 4 * m;
    return QDOT_OK;
}

/* sum |c_k t_k| of a sum, |g| of anything else. */
static qdot_expr
size_of(qdot_pool *pool, qdot_expr g)
{
    qdot_expr size;

    if (qdot_expr_kind(pool, g) != QDOT_SUM)
        return qdot_fun1(pool, QDOT_ABS, g);
    size = qdot_fun1(pool, QDOT_ABS, qdot_expr_arg(pool, g, 0));
    for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, g); k += 2)
        size = qdot_add(pool, size,
                        qdot_fun1(pool, QDOT_ABS,
                                  qdot_mul(pool, qdot_expr_arg(pool, g, k),
                                           qdot_expr_arg(pool, g, k + 1))));
    return size;
}

static qdot_status
lower(qdot_watch *w, const qdot_expr *g, bool shaken)
{
    const qdot_plan *p = w->plan;
    qdot_expr *e = qdot_malloc((w->m + 1) * sizeof *e);
    qdot_tape *tape = NULL;
    qdot_status status = e ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < w->m && status == QDOT_OK; i++) {
        e[i] = qdot_plan_substitute(p, g[i]);
        status = qdot_pool_check(p->pool);
        if (status == QDOT_OK)
            w->accelerations |=
                (qdot_expr_node(p->pool, e[i])->holds
                 & (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER))
                != 0;
    }
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, qdot_plan_inputs(p), p->inputs, w->m, e, &tape);
    for (size_t i = 0; i < w->m && status == QDOT_OK; i++)
        e[i] = size_of(p->pool, e[i]);
    if (status == QDOT_OK)
        status = qdot_pool_check(p->pool);
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, qdot_plan_inputs(p), p->inputs, w->m, e,
                               &w->sizes);
    qdot_free(e);
    if (status == QDOT_OK && shaken) {
        status = qdot_tape_shake(tape, &w->tape);
        qdot_tape_free(tape);
    } else {
        w->tape = tape;
    }
    return status;
}

qdot_status
qdot_watch_new(const qdot_plan *plan, size_t m, const qdot_expr *g, bool shaken,
               double tol, qdot_watch **watch)
{
    qdot_watch *w = qdot_calloc(1, sizeof *w);
    qdot_status status;

    *watch = NULL;
    if (!w)
        return QDOT_ENOMEM;
    w->plan = plan;
    w->m = m;
    w->n = plan->n;
    w->tol = tol;
    w->nodes = LEAST;
    status = lower(w, g, shaken);
    if (status == QDOT_OK)
        status = make_room(w);
    if (status != QDOT_OK) {
        qdot_watch_free(w);
        return status;
    }
    *watch = w;
    return QDOT_OK;
}
