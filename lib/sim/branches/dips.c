/* dips.c -- keeps the latest points of a curve and finds zeros that test functions touch without
 * changing sign. */
#include "sim/branches/dips.h"

#include <math.h>

/* Of the largest value of f: below, more would be rounding (of the tangent: twice over, since steps are as
 * long as its square root). The shortest careful step. */
static const double rounding[2] = {1e-13, 1e-11}, shortest = 1e-9;

qdot_status
qdot_dips_begin(const qdot_path *x, qdot_dips *d)
{
    *d = (qdot_dips){.careful = INFINITY};
    for (int k = 0; k < QDOT_DIPS_KEPT; k++)
        QDOT_TRY(qdot_path_point_begin(x, &d->at[k]));
    return QDOT_OK;
}

void
qdot_dips_end(qdot_dips *d)
{
    for (int k = 0; k < QDOT_DIPS_KEPT; k++)
        qdot_path_point_end(&d->at[k]);
}

void
qdot_dips_forget(qdot_dips *d)
{
    d->n = 0;
}

/* A test function at a point: the determinant (0), or the tangent's scaled component along p (1). */
static double
test_function(const qdot_path *x, const qdot_path_point *a, int which)
{
    return which == 0 ? a->det : a->t[x->n] * sqrt(x->weight[x->n]);
}

void
qdot_dips_add(const qdot_path *x, qdot_dips *d, const qdot_path_point *b, double gone, size_t count)
{
    size_t last;

    if (d->n == QDOT_DIPS_KEPT) {
        const qdot_path_point first = d->at[0];

        for (int k = 1; k < QDOT_DIPS_KEPT; k++) {
            d->at[k - 1] = d->at[k];
            d->gone[k - 1] = d->gone[k];
            d->count[k - 1] = d->count[k];
        }
        d->at[QDOT_DIPS_KEPT - 1] = first; /* reuse the memory of the oldest point */
        d->n--;
    }
    last = d->n++;
    qdot_path_point_copy(x, b, &d->at[last]);
    d->gone[last] = gone;
    d->count[last] = count;
    for (int which = 0; which < 2; which++)
        d->most[which] = fmax(d->most[which], fabs(test_function(x, b, which)));
    if (gone > d->until)
        d->careful = INFINITY;
}

/* Whether f dips between z = at[0] and c; *left: the smaller of |f_z|, |f_c|; *place: which of a, b is
 * nearer to 0. */
static bool
has_dip(const qdot_path *x, const qdot_dips *d, const qdot_path_point *c, int which, double *left,
        size_t *place)
{
    const double z = test_function(x, &d->at[0], which), a = test_function(x, &d->at[1], which),
                 b = test_function(x, &d->at[2], which), e = test_function(x, c, which);

    *left = fmin(fabs(z), fabs(e));
    *place = fabs(a) < fabs(b) ? 1 : 2;
    return z * a >= 0 && z * b >= 0 && z * e > 0 && fmin(fabs(a), fabs(b)) < *left / 2;
}

qdot_dips_answer
qdot_dips_look(const qdot_path *x, qdot_dips *d, const qdot_path_point *b, double gone, size_t *place)
{
    if (d->n < QDOT_DIPS_KEPT || d->at[0].y == NULL || gone <= d->calm)
        return QDOT_DIPS_NONE;
    for (int which = 0; which < 2; which++) {
        const double step = (gone - d->gone[0]) / 3;
        double left;

        if (!has_dip(x, d, b, which, &left, place))
            continue;
        if (step > 4 * shortest && left > rounding[which] * d->most[which]) {
            d->careful = step / 4;
            d->until = gone;
            return QDOT_DIPS_AGAIN;
        }
        d->calm = gone + 3 * step;
        if (which == 0)
            return QDOT_DIPS_ZERO;
    }
    return QDOT_DIPS_NONE;
}
