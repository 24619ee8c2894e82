/* constrained-start.c -- whether a run may start at a state. */
#include <math.h>
#include <string.h>

#include "num/row-space.h"
#include "sim/constrained-parts.h"

/* A start may break a constraint by the rounding of decimals as people type them. */
static const double start_tolerance = 1e-9;

/* How far beside a start its constraints are looked at, and what is left of a row there
 * that was dependent upon the others only at the start. */
static const double beside = 1e-3, independent = 1e-7;

enum { tries = 3, iterations = 12 };

/* --- a start at which constraints happen to be dependent ----------------------------- */

typedef struct {
    qdot_constrained *h;
    double t;
    double *y; /* [2n] a state beside the start */
    double *A; /* [m x n] holonomic rows, the others 0; or all */
    double *b, *x;
    qdot_row_space rows;
} place;

/* A at p->y, of holonomic rows or of all. */
static void
take_slopes(place *p, bool all)
{
    const size_t n = p->h->plan->n, m = p->h->c->m;
    qdot_constrained_level *l = p->h->at[QDOT_ACCELERATION];

    qdot_constrained_load(p->h, p->t, p->y);
    qdot_constrained_metric(p->h, l);
    memcpy(p->A, l->saddle.A, m * n * sizeof *p->A);
    for (size_t k = 0; k < m && !all; k++)
        if (p->h->c->rows[k].kind != QDOT_HOLONOMIC)
            memset(p->A + k * n, 0, n * sizeof *p->A);
}

/* A state beside y on the constraints; whether one was found. */
static bool
step_aside(place *p, const double *y, int which)
{
    const size_t n = p->h->plan->n, m = p->h->c->m;
    unsigned long seed = 12345 + (unsigned long)which;
    double length = 0, size = 1, most = INFINITY;

    memcpy(p->y, y, 2 * n * sizeof *y);
    take_slopes(p, false);
    qdot_row_space_factor(&p->rows, p->A, start_tolerance, false);
    for (size_t i = 0; i < n; i++) {
        seed = seed * 1103515245 + 12345;
        p->x[i] = (double)(seed >> 16 & 0x7fff) / 0x4000 - 1;
    }
    qdot_row_space_tangent(&p->rows, p->x);
    for (size_t i = 0; i < n; i++) {
        length = fmax(length, fabs(p->x[i]));
        size = fmax(size, fabs(y[i]));
    }
    for (size_t i = 0; i < n; i++)
        p->y[i] += length > 1e-6 ? beside * size * p->x[i] / length : 0;
    for (int k = 0; k < iterations; k++) {
        qdot_constrained_load(p->h, p->t, p->y);
        qdot_constrained_positions(p->h);
        most = 0;
        for (size_t r = 0; r < m; r++) {
            p->b[r] = -p->h->f[r];
            most = fmax(most, fabs(p->b[r]));
        }
        if (!(most > 1e-13 * size))
            break;
        take_slopes(p, false);
        qdot_row_space_factor(&p->rows, p->A, start_tolerance, false);
        qdot_row_space_shortest(&p->rows, p->b, p->x, NULL);
        for (size_t i = 0; i < n; i++)
            p->y[i] += p->x[i];
    }
    return most < 1e-10 * size;
}

/* The constraints of which `row` is a combination at the start, and itself. */
static qdot_status
refuse(place *p, const double *y, size_t row)
{
    const size_t n = p->h->plan->n, m = p->h->c->m;
    bool *in = qdot_calloc(m + 1, sizeof *in);
    double *part = qdot_calloc(m + 1, sizeof *part);
    qdot_text names = {0};
    size_t count = 1;

    if (in && part) {
        memcpy(p->y, y, 2 * n * sizeof *y);
        take_slopes(p, true);
        for (size_t k = 0; k < m; k++) {
            p->b[k] = 0;
            for (size_t i = 0; i < n && k != row; i++)
                p->b[k] += p->A[k * n + i] * p->A[row * n + i];
        }
        memset(p->A + row * n, 0, n * sizeof *p->A);
        qdot_row_space_factor(&p->rows, p->A, start_tolerance, false);
        qdot_row_space_shortest(&p->rows, p->b, p->x, part);
        in[row] = true;
        for (size_t k = 0; k < m; k++)
            if (k != row && fabs(part[k]) > QDOT_CONSTRAINED_PART) {
                in[k] = true;
                count++;
            }
        qdot_constrained_name(p->h->c, in, &names);
    }
    if (in && part && qdot_text_status(&names) == QDOT_OK)
        qdot_fail(QDOT_ESINGULAR,
                  count == 1 ? "at the start %.200s has no direction, as it has beside it: what "
                               "the motion is from there is not determined"
                             : "at the start %.200s depend on each other, as they do not "
                               "beside it: what the motion is from there is not determined",
                  qdot_text_str(&names));
    qdot_free(in);
    qdot_free(part);
    qdot_text_clear(&names);
    (void)qdot_hint("a start beside that place");
    return QDOT_ESINGULAR;
}

/* Rows that repeat others at the start must do so beside it, too: else the rank that is kept
 * is that of a moment. */
static qdot_status
check_place(qdot_constrained *h, double t, const double *y)
{
    const size_t n = h->plan->n, m = h->c->m;
    const qdot_saddle *s = &h->at[QDOT_ACCELERATION]->saddle;
    const size_t rank = s->rank, repeated = rank < m ? s->pivot[rank] : 0;
    place p = {.h = h, .t = t};
    qdot_status status;

    if (rank == m)
        return QDOT_OK;
    p.y = qdot_calloc(3 * n + m * n + m, sizeof *p.y);
    if (!p.y)
        return QDOT_ENOMEM;
    p.x = p.y + 2 * n;
    p.A = p.x + n;
    p.b = p.A + m * n;
    status = qdot_row_space_init(&p.rows, m, n);
    for (int k = 0; k < tries && status == QDOT_OK; k++) {
        if (!step_aside(&p, y, k))
            continue;
        take_slopes(&p, true);
        qdot_row_space_factor(&p.rows, p.A, independent, false);
        if (p.rows.rank > rank)
            status = refuse(&p, y, repeated);
    }
    if (status == QDOT_OK) { /* as it was, for what reads it next */
        memcpy(p.y, y, 2 * n * sizeof *y);
        take_slopes(&p, true);
        status = qdot_constrained_solve(h, t, y, h->a, NULL);
    }
    qdot_row_space_clear(&p.rows);
    qdot_free(p.y);
    return status;
}

/* --- the start ---------------------------------------------------------------------- */

static qdot_status
broken(const qdot_constrained *h, size_t row, double residual, const char *what)
{
    qdot_fail(QDOT_EINVAL, "the start breaks the constraint %s: %s is %.3g, not 0",
              h->c->rows[row].name, what, residual);
    return qdot_hint("start values that fulfil it");
}

qdot_status
qdot_constrained_start(qdot_constrained *h, double t, double *y, double *low)
{
    const size_t n = h->plan->n;
    qdot_constrained_level *l = h->at[QDOT_HOLONOMIC];
    double moved;

    qdot_constrained_load(h, t, y);
    qdot_constrained_residuals(h);
    for (size_t k = 0; k < h->c->m; k++)
        if (!(fabs(h->f[k]) <= start_tolerance))
            return broken(h, k, h->f[k], "left - right");
    for (size_t k = 0; k < h->c->m; k++)
        if (!(fabs(h->w[k]) <= start_tolerance))
            return broken(h, k, h->w[k],
                          h->c->rows[k].kind == QDOT_HOLONOMIC
                              ? "the time derivative of left - right"
                              : "left - right");
    /* the bounds, before anything is judged by them */
    if (l->m > 0) {
        QDOT_TRY(qdot_constrained_factor_metric(h, l));
        qdot_constrained_raise_bounds(l, y, h->f_bound);
    }
    l = h->at[QDOT_VELOCITY];
    if (l->m > 0) {
        QDOT_TRY(qdot_constrained_factor_metric(h, l));
        qdot_constrained_raise_bounds(l, y + n, h->w_bound);
    }
    QDOT_TRY(qdot_constrained_project(t, y, low, &moved, h));
    QDOT_TRY(qdot_constrained_solve(h, t, y, h->a, NULL));
    QDOT_TRY(check_place(h, t, y));
    return qdot_constrained_check_repeated(h, QDOT_EINVAL);
}
