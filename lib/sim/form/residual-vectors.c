/* residual-vectors.c -- slopes put into vectors, and an order of the residual by them. */
#include "sim/form/residual-vectors.h"

#include <string.h>

#include "base/memory.h"
#include "series/taylor-wide.h"

enum { lanes = QDOT_WIDE_LANES };

/* Eight coordinates, a slope of each. */
typedef struct {
    size_t slope; /* the first lane */
    qdot_wide_columns columns;
    uint32_t *column_lanes;
    double *weights;
} slopes;

struct qdot_residual_vectors {
    qdot_taylor_wide *places;
    size_t n, blocks; /* coordinates, and eights of them */
    size_t *first;    /* [blocks + 1] of the vectors of a block */
    slopes *vectors;
    size_t n_vectors, orders;
    size_t *applied;       /* [n] lanes; SIZE_MAX: none */
    qdot_wide_pair *pairs; /* [n_vectors] */
    double *allocated, *F; /* [orders x n_vectors x 8] */
    double *sums;          /* [blocks x 8] */
};

/* --- building ----------------------------------------------------------------------- */

/* What is needed of a residual. */
typedef struct {
    qdot_residual_vectors *w;
    const qdot_residual *r;
    const qdot_taylor *t;
    const double *W;
    size_t rows;
} builder;

/* Slope number `rank` of a coordinate; NULL: it has fewer. */
static const qdot_residual_slope *
slope_of(const qdot_residual *r, size_t coordinate, size_t rank)
{
    for (size_t j = 0; j < r->n_slopes; j++)
        if (r->slopes[j].coordinate == coordinate && rank-- == 0)
            return r->slopes + j;
    return NULL;
}

/* The rows of W of these functions (NULL: none), without columns that are 0. */
static qdot_status
fill_columns(const builder *b, const qdot_residual_slope *const *of, slopes *v)
{
    const size_t functions = b->r->functions;

    v->column_lanes = qdot_calloc(functions, sizeof *v->column_lanes);
    v->weights = qdot_calloc(lanes * functions, sizeof *v->weights);
    if (!v->column_lanes || !v->weights)
        return QDOT_ENOMEM;
    for (size_t f = 0; f < functions; f++) {
        double *to = v->weights + lanes * v->columns.n;
        bool some = false;

        for (size_t l = 0; l < lanes; l++) {
            to[l] = of[l] ? b->W[f * b->rows + of[l]->function] : 0;
            some = some || to[l] != 0;
        }
        if (some)
            v->column_lanes[v->columns.n++] = (uint32_t)qdot_taylor_wide_lane(
                b->w->places, qdot_taylor_output(b->t, f));
    }
    v->columns.lane = v->column_lanes;
    v->columns.weight = v->weights;
    return QDOT_OK;
}

static qdot_status
add_vector(const builder *b, size_t block, size_t rank, bool *some)
{
    qdot_residual_vectors *w = b->w;
    const qdot_residual_slope *of[lanes] = {0};
    size_t at[lanes];
    slopes *v = w->vectors + w->n_vectors;

    *some = false;
    for (size_t l = 0; l < lanes; l++) {
        const size_t i = block * lanes + l;

        of[l] = i < w->n ? slope_of(b->r, i, rank) : NULL;
        at[l] = SIZE_MAX;
        if (of[l])
            at[l] =
                qdot_taylor_wide_lane(w->places, qdot_taylor_output(b->t, of[l]->output));
        *some = *some || of[l];
    }
    if (!*some)
        return QDOT_OK;
    w->n_vectors++;
    /* what lies beyond the coordinates may stand beside them: no row of W takes it */
    for (size_t l = 1; l < lanes; l++)
        if (!of[l] && at[l - 1] != SIZE_MAX && block * lanes + l >= w->n)
            at[l] = at[l - 1] + 1;
    QDOT_TRY(qdot_taylor_wide_align(w->places, lanes, at, &v->slope));
    return fill_columns(b, of, v);
}

static qdot_status
build(const builder *b)
{
    qdot_residual_vectors *w = b->w;
    const qdot_residual *r = b->r;
    size_t doubles;

    w->blocks = (w->n + lanes - 1) / lanes;
    w->first = qdot_calloc(w->blocks + 1, sizeof *w->first);
    w->vectors = qdot_calloc(r->n_slopes + 1, sizeof *w->vectors);
    w->applied = qdot_calloc(w->n, sizeof *w->applied);
    w->pairs = qdot_calloc(r->n_slopes + 1, sizeof *w->pairs);
    w->sums = qdot_calloc(lanes * w->blocks, sizeof *w->sums);
    if (!w->first || !w->vectors || !w->applied || !w->pairs || !w->sums)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < w->blocks; k++) {
        bool some = true;

        for (size_t rank = 0; some; rank++)
            QDOT_TRY(add_vector(b, k, rank, &some));
        w->first[k + 1] = w->n_vectors;
    }
    for (size_t i = 0; i < w->n; i++)
        w->applied[i] =
            r->force[i] & QDOT_RESIDUAL_FORCES
                ? SIZE_MAX
                : qdot_taylor_wide_lane(w->places, qdot_taylor_output(b->t, r->force[i]));
    w->orders = qdot_taylor_stride(b->t);
    doubles = w->orders * w->n_vectors * lanes;
    w->allocated = qdot_calloc(doubles + lanes, sizeof *w->allocated);
    if (!w->allocated)
        return QDOT_ENOMEM;
    w->F = w->allocated;
    while ((uintptr_t)w->F % (lanes * sizeof(double)) != 0)
        w->F++;
    return qdot_taylor_wide_settle(w->places);
}

qdot_status
qdot_residual_vectors_new(const qdot_residual *r, size_t n, const qdot_taylor *places,
                          const double *W, size_t rows, qdot_residual_vectors **wide)
{
    qdot_residual_vectors *w = qdot_calloc(1, sizeof *w);
    const builder b = {w, r, places, W, rows};
    qdot_status status;

    *wide = NULL;
    if (!w)
        return QDOT_ENOMEM;
    w->n = n;
    status = qdot_taylor_wide_new(places, n, NULL, 0, &w->places);
    if (status == QDOT_OK && w->places)
        status = build(&b);
    if (status != QDOT_OK || !w->places) {
        qdot_residual_vectors_free(w);
        return status;
    }
    *wide = w;
    return QDOT_OK;
}

void
qdot_residual_vectors_free(qdot_residual_vectors *w)
{
    if (!w)
        return;
    for (size_t v = 0; w->vectors && v < w->n_vectors; v++) {
        qdot_free(w->vectors[v].column_lanes);
        qdot_free(w->vectors[v].weights);
    }
    qdot_taylor_wide_free(w->places);
    qdot_free(w->first);
    qdot_free(w->vectors);
    qdot_free(w->applied);
    qdot_free(w->pairs);
    qdot_free(w->allocated);
    qdot_free(w->sums);
    qdot_free(w);
}

/* --- an order ----------------------------------------------------------------------- */

void
qdot_residual_vectors_begin(qdot_residual_vectors *w, const qdot_taylor *places,
                            const double *first)
{
    qdot_taylor_wide_begin(w->places, places);
    qdot_taylor_wide_order(w->places, 1);
    qdot_taylor_wide_correct(w->places, 1, first, 1);
}

/* F of order m - 2 from coefficients m of the differences. */
static void
forces(const qdot_residual_vectors *w, int m)
{
    const double *at = qdot_taylor_wide_at(w->places, m);
    double *F = w->F + (size_t)(m - 2) * w->n_vectors * lanes;

    for (size_t v = 0; v < w->n_vectors; v++)
        qdot_taylor_wide_multiply(w->places, &w->vectors[v].columns, at, m * (m - 1),
                                  F + v * lanes);
}

/* Slopes of order j times forces of order k - j, j from `from` on, block by block. */
static void
dots(const qdot_residual_vectors *w, int from, int n, int k, double *out)
{
    const size_t width = qdot_taylor_wide_width(w->places), forces = w->n_vectors * lanes;
    const double *J = qdot_taylor_wide_at(w->places, from);
    const double *F = w->F + (size_t)(k - from) * forces;

    for (size_t v = 0; v < w->n_vectors; v++)
        w->pairs[v] = (qdot_wide_pair){J + w->vectors[v].slope, F + v * lanes};
    for (size_t b = 0; b < w->blocks; b++) {
        const qdot_wide_sum sum = {w->first[b + 1] - w->first[b], w->pairs + w->first[b],
                                   (size_t)n, width, forces};

        qdot_taylor_wide_dots(w->places, &sum, out + b * lanes);
    }
}

void
qdot_residual_vectors_residual(qdot_residual_vectors *w, int m, double scale, double *R)
{
    const int k = m - 2;
    const double *applied = qdot_taylor_wide_at(w->places, k);

    if (k > 0)
        dots(w, 1, k, k, w->sums);
    qdot_taylor_wide_order(w->places, m);
    forces(w, m);
    dots(w, 0, 1, k, R);
    for (size_t i = 0; i < w->n; i++) {
        const double Q = w->applied[i] != SIZE_MAX ? scale * applied[w->applied[i]] : 0;

        R[i] = Q - (k > 0 ? R[i] + w->sums[i] : R[i]);
    }
}

void
qdot_residual_vectors_correct(qdot_residual_vectors *w, int m, const double *newest)
{
    qdot_taylor_wide_correct(w->places, m, newest, 1);
    forces(w, m);
}

void
qdot_residual_vectors_count(const qdot_residual_vectors *w, double *convolutions,
                            double *products, double *begun)
{
    *convolutions = qdot_taylor_wide_convolutions(w->places) + (double)w->n_vectors;
    *products = 0;
    for (size_t v = 0; v < w->n_vectors; v++)
        *products += 2 * (double)w->vectors[v].columns.n;
    *begun = 2 * (double)qdot_taylor_wide_groups(w->places) + 4 * (double)w->n_vectors;
}
