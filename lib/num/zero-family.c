/* zero-family.c -- decides whether a zero of F belongs to a continuous family, where the Jacobian J is singular. */
#include "num/zero-parts.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* A zero of a higher order than that, or where singular values of J are so small beside those on the way, is no
 * regular one. */
static const double of_first_order = 1.2, vanished = 1e-3;

/* How far beside a zero others are looked for, in units of the unknowns; the first alone beside one of a higher order,
 * of which F is small near by. */
static const double beside[] = {0.05, 5e-3, 5e-4};

/* The smallest distance from a zero at which F is tested for being non-zero. */
static const double nearest = 1e-8;

enum { CORRECTIONS = 6 };

typedef enum {
    OTHER, /* another zero was found, at least half as far away as the step */
    BACK,  /* Newton's corrections lead back to the zero from which the test started */
    LOST   /* Newton's corrections do not converge to a zero */
} beside_answer;

typedef struct {
    qdot_zero_search *s;
    size_t rank;        /* rank of the Jacobian J at the zero */
    bool first_order;
    double *u, *error;  /* [n] the zero, and its error bounds */
    double *ways, *way; /* [n x n] directions as columns, of which the last n - rank do not change F; [n] one direction */
    double *f;          /* [2m] function values F at the trial point, then their errors */
} family;

/* Start h units beside the zero along `way`, and make `corrections` corrections. J at the zero is
 * overwritten. */
static qdot_status
search_zero_beside(const family *x, double h, int corrections, beside_answer *answer)
{
    qdot_zero_search *s = x->s;
    const size_t n = s->p->n;
    double *u = s->r->u, along = 0;
    bool zero = false;

    *answer = LOST;
    for (size_t j = 0; j < n; j++)
        u[j] = qdot_zero_within(s->p, j, x->u[j] + h * x->way[j] * s->unit[j]);
    for (int k = 0; k <= corrections && !zero; k++) {
        QDOT_TRY(qdot_zero_evaluate(s));
        if (isnan(s->r->f[0]))
            return QDOT_OK;
        zero = qdot_zero_is_within_errors(s, s->r->f, s->r->f_error);
        if (zero || k == corrections || !qdot_zero_find_step(s))
            break;
        s->r->rank = x->rank > 0 && x->rank < s->r->rank ? x->rank : s->r->rank;
        s->mu = 0;
        (void)qdot_zero_take_step(s, s->r->f, s->step);
        for (size_t j = 0; j < n; j++)
            u[j] = qdot_zero_within(s->p, j, u[j] + s->step[j]);
    }
    for (size_t j = 0; j < n; j++)
        along += (u[j] - x->u[j]) / s->unit[j] * x->way[j];
    if (fabs(along) < h / 2)
        *answer = BACK;
    else if (zero)
        *answer = OTHER;
    return QDOT_OK;
}

/* Find the smallest distance along `way`, in its units, at which F is distinguishable from 0. */
static qdot_status
find_distance_without_zero(const family *x, double *open)
{
    beside_answer answer = BACK;

    for (*open = beside[0]; *open > nearest; *open /= 10) {
        QDOT_TRY(search_zero_beside(x, *open / 10, 0, &answer));
        if (answer == OTHER)
            break;
    }
    return QDOT_OK;
}

/* Test the k-th direction: OTHER if the zero belongs to a family along it; else *open: how far off F surely is not 0. */
static qdot_status
test_direction(const family *x, size_t k, beside_answer *answer, double *open)
{
    const size_t n = x->s->p->n, most = x->first_order ? sizeof beside / sizeof *beside : 1;
    double one;

    *answer = LOST;
    *open = 0;
    for (int side = 1; side >= -1; side -= 2) {
        for (size_t j = 0; j < n; j++)
            x->way[j] = side * x->ways[j * n + k];
        for (size_t i = 0; i < most; i++) {
            beside_answer this;

            QDOT_TRY(search_zero_beside(x, beside[i], CORRECTIONS, &this));
            if (this == OTHER)
                *answer = OTHER;
            if (this == OTHER)
                return QDOT_OK;
            if (this == BACK)
                *answer = BACK;
        }
        QDOT_TRY(find_distance_without_zero(x, &one));
        *open = fmax(*open, one);
    }
    return QDOT_OK;
}

static qdot_status
test_all_directions(const family *x)
{
    qdot_zero_search *s = x->s;
    const size_t n = s->p->n;
    size_t isolated = 0;

    for (size_t k = x->rank; k < n; k++) {
        beside_answer answer;
        double open;

        QDOT_TRY(test_direction(x, k, &answer, &open));
        isolated += answer == BACK;
        s->r->vague_rank = s->r->vague_rank || answer == LOST;
        for (size_t j = 0; j < n && answer == BACK; j++)
            x->error[j] = fmax(x->error[j], open * fabs(x->ways[j * n + k]) * s->unit[j]);
    }
    s->r->rank = x->rank + isolated;
    return QDOT_OK;
}

static void
restore_zero(const family *x, bool back)
{
    const size_t n = x->s->p->n, m = x->s->p->m;
    double *const there[] = {x->u, x->error, x->f, x->f + m};
    double *const here[] = {x->s->r->u, x->s->r->error, x->s->r->f, x->s->r->f_error};

    for (int i = 0; i < 4; i++)
        memcpy(back ? here[i] : there[i], back ? there[i] : here[i], (i < 2 ? n : m) * sizeof **here);
}

qdot_status
qdot_zero_verify_family(qdot_zero_search *s)
{
    const size_t n = s->p->n, m = s->p->m;
    family x = {.s = s};
    qdot_status status;

    if (s->r->answer != QDOT_ZERO_FOUND || !s->p->verify || s->r->rank == n)
        return QDOT_OK;
    x.u = qdot_calloc(n * n + 3 * n + 2 * m, sizeof *x.u);
    if (x.u == NULL)
        return QDOT_ENOMEM;
    x.error = x.u + n;
    x.way = x.error + n;
    x.f = x.way + n;
    x.ways = x.f + 2 * m;
    restore_zero(&x, false);
    status = qdot_zero_evaluate(s); /* evaluate again, since the Jacobian J may have been computed at another point */
    (void)qdot_zero_find_step(s);
    x.rank = s->r->rank;
    x.first_order = s->order < of_first_order &&
                    (x.rank == 0 || gsl_vector_get(s->singular, x.rank - 1) > vanished * s->strongest);
    for (size_t j = 0; j < n; j++)
        for (size_t k = 0; k < n; k++)
            x.ways[j * n + k] = gsl_matrix_get(s->V, j, k);
    if (status == QDOT_OK)
        status = test_all_directions(&x);
    restore_zero(&x, true);
    qdot_free(x.u);
    return status;
}
