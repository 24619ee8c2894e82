/* residual-sweeps.c -- computes one order of a residual along its tree, with a program's lanes
 * sorted by nodes. */
#include "sim/form/residual-sweeps.h"

#include <string.h>

#include "base/memory.h"
#include "series/taylor-wide.h"

enum {
    lanes = QDOT_WIDE_LANES,
    components = QDOT_ARTICULATED_COMPONENTS,
    unknowns = QDOT_ARTICULATED_UNKNOWNS
};

#define NONE UINT32_MAX

struct qdot_residual_sweeps {
    qdot_taylor_wide *places;
    qdot_articulated *system;
    size_t n, nodes, m, c, slots;
    size_t *lane; /* [n] vector lane of each coordinate: a node's k-th coordinate is in the slots from k on */
    size_t d[components]; /* first lane of the position differences d, for each component */
    size_t J[unknowns * components]; /* [c x m] first lane of each derivative J = dd/dq */
    size_t applied[unknowns];        /* first lane of the applied forces; SIZE_MAX: no applied forces */
    size_t forces;         /* number of doubles for one order of F, an odd multiple of 8 */
    double *allocated, *F; /* allocated block; forces F [orders x forces], m components for each slot */
    double *r, *q;         /* [c x slots] right-hand sides; accelerations */
};

/* --- sorting lanes by nodes --------------------------------------------------------- */

typedef struct {
    qdot_residual_sweeps *s;
    const qdot_residual *r;
    const qdot_residual_tree *tree;
    const qdot_taylor *t;
    size_t *at; /* [slots] index of the tree's node in each slot */
} builder;

/* Where the outputs [nodes x step] of the program at `from` lie by slots; *to SIZE_MAX:
 * there are none. */
static qdot_status
align_outputs(const builder *b, const uint32_t *from, size_t step, size_t *to)
{
    const qdot_residual_sweeps *s = b->s;
    bool some = false;

    for (size_t k = 0; k < s->slots; k++)
        b->at[k] = SIZE_MAX;
    for (size_t n = 0; n < s->nodes; n++) {
        const uint32_t output = from[n * step];

        if (output == NONE)
            continue;
        b->at[qdot_articulated_slot(s->system, n)] =
            qdot_taylor_wide_lane(s->places, qdot_taylor_output(b->t, output));
        some = true;
    }
    *to = SIZE_MAX;
    if (!some)
        return QDOT_OK;
    /* let applied forces that belong to no node use the remaining slots */
    for (size_t k = s->nodes; k < s->slots; k++)
        if (b->at[k - 1] != SIZE_MAX)
            b->at[k] = b->at[k - 1] + 1;
    return qdot_taylor_wide_align(s->places, s->slots, b->at, to);
}

/* Find, in the order of the tree, which program output is the applied force on each coordinate. */
static qdot_status
align_applied(const builder *b)
{
    const qdot_residual_tree *t = b->tree;
    uint32_t *output = qdot_calloc(t->nodes * t->c, sizeof *output);
    qdot_status status = output ? QDOT_OK : QDOT_ENOMEM;

    for (size_t e = 0; e < t->nodes * t->c && output; e++) {
        const uint32_t i = t->coordinate[e];

        output[e] =
            i == NONE || b->r->force[i] & QDOT_RESIDUAL_FORCES ? NONE : b->r->force[i];
    }
    for (size_t k = 0; k < t->c && status == QDOT_OK; k++)
        status = align_outputs(b, output + k, t->c, b->s->applied + k);
    qdot_free(output);
    return status;
}

static qdot_status
allocate_sweeps(qdot_residual_sweeps *s, size_t orders)
{
    const size_t eights = s->m * s->slots / lanes;
    const size_t few = s->c * s->slots;
    double *at;

    s->forces = (eights + (eights + 1) % 2) * lanes;
    s->allocated =
        qdot_calloc(orders * s->forces + 2 * few + lanes, sizeof *s->allocated);
    if (!s->allocated)
        return QDOT_ENOMEM;
    at = s->allocated;
    while ((uintptr_t)at % (lanes * sizeof *at) != 0)
        at++;
    s->F = at;
    s->r = at + orders * s->forces;
    s->q = s->r + few;
    return QDOT_OK;
}

static qdot_status
sweeps_build(builder *b)
{
    qdot_residual_sweeps *s = b->s;
    const qdot_residual_tree *t = b->tree;

    b->at = qdot_calloc(s->slots, sizeof *b->at);
    if (!b->at)
        return QDOT_ENOMEM;
    /* the functions are the first outputs of the program `places`, in their order */
    for (size_t i = 0; i < s->m; i++)
        QDOT_TRY(align_outputs(b, t->function + i, t->m, s->d + i));
    for (size_t e = 0; e < s->c * s->m; e++) {
        QDOT_TRY(align_outputs(b, t->slope + e, t->c * t->m, s->J + e));
        if (s->J[e] == SIZE_MAX) { /* a derivative that is 0 everywhere: use a row of zeros */
            for (size_t k = 0; k < s->slots; k++)
                b->at[k] = SIZE_MAX;
            QDOT_TRY(qdot_taylor_wide_align(s->places, s->slots, b->at, s->J + e));
        }
    }
    QDOT_TRY(align_applied(b));
    QDOT_TRY(allocate_sweeps(s, qdot_taylor_stride(b->t)));
    return qdot_taylor_wide_settle(s->places);
}

static qdot_status
make_sweeps(builder *b, const double *w, bool *made)
{
    qdot_residual_sweeps *s = b->s;
    const qdot_residual_tree *t = b->tree;

    *made = false;
    QDOT_TRY(qdot_residual_tree_system(t, b->r, w, &s->system));
    s->nodes = t->nodes;
    s->m = t->m;
    s->c = t->c;
    s->slots = qdot_articulated_slots(s->system);
    s->lane = qdot_calloc(s->n, sizeof *s->lane);
    if (!s->lane)
        return QDOT_ENOMEM;
    for (size_t e = 0; e < t->nodes * t->c; e++)
        if (t->coordinate[e] != NONE)
            s->lane[t->coordinate[e]] =
                e % t->c * s->slots + qdot_articulated_slot(s->system, e / t->c);
    QDOT_TRY(qdot_taylor_wide_new(b->t, s->n, s->lane, s->c * s->slots, &s->places));
    if (!s->places)
        return QDOT_OK;
    *made = true;
    return sweeps_build(b);
}

qdot_status
qdot_residual_sweeps_new(const qdot_residual *r, size_t n, const qdot_taylor *places,
                         const double *w, qdot_residual_sweeps **tree)
{
    qdot_residual_tree *found;
    builder b = {.r = r, .t = places};
    bool made = false;
    qdot_status status;

    *tree = NULL;
    QDOT_TRY(qdot_residual_tree_new(r, n, &found));
    if (!found)
        return QDOT_OK;
    b.tree = found;
    b.s = qdot_calloc(1, sizeof *b.s);
    if (b.s) {
        b.s->n = n;
        status = make_sweeps(&b, w, &made);
    } else {
        status = QDOT_ENOMEM;
    }
    qdot_free(b.at);
    qdot_residual_tree_free(found);
    if (status != QDOT_OK || !made) {
        qdot_residual_sweeps_free(b.s);
        return status;
    }
    *tree = b.s;
    return QDOT_OK;
}

void
qdot_residual_sweeps_free(qdot_residual_sweeps *s)
{
    if (!s)
        return;
    qdot_taylor_wide_free(s->places);
    qdot_articulated_free(s->system);
    qdot_free(s->lane);
    qdot_free(s->allocated);
    qdot_free(s);
}

/* --- computing one order ------------------------------------------------------------ */

/* Set pointers to[count] to the coefficients of order k in the lanes at[count]. */
static void
set_order_pointers(const qdot_residual_sweeps *s, int k, size_t count, const size_t *at,
                   const double **to)
{
    const double *now = qdot_taylor_wide_at(s->places, k);

    for (size_t i = 0; i < count; i++)
        to[i] = now + at[i];
}

bool
qdot_residual_sweeps_begin(qdot_residual_sweeps *s, const qdot_taylor *places,
                           const double *first, double *lost)
{
    const double *S[unknowns * components];
    size_t node, unknown;

    qdot_taylor_wide_begin(s->places, places);
    qdot_taylor_wide_order(s->places, 1);
    for (size_t i = 0; i < s->n; i++)
        s->q[s->lane[i]] = first[i];
    qdot_taylor_wide_correct(s->places, 1, s->q, 1);
    set_order_pointers(s, 0, s->c * s->m, s->J, S);
    return qdot_articulated_factor(s->system, S, lost, &node, &unknown);
}

/* Compute r: the applied force minus the convolution of slopes (orders 1 ... k) with forces (orders
 * k - 1 ... 0). */
static void
compute_right_side(qdot_residual_sweeps *s, int k, double scale, const double *more)
{
    const size_t width = qdot_taylor_wide_width(s->places);
    const double *J = qdot_taylor_wide_at(s->places, 1);
    const double *F = s->F + (size_t)(k > 0 ? k - 1 : 0) * s->forces;
    const double *now = qdot_taylor_wide_at(s->places, k);

    for (size_t u = 0; u < s->c; u++) {
        double *r = s->r + u * s->slots;
        const double *Q = s->applied[u] == SIZE_MAX ? NULL : now + s->applied[u];

        for (size_t at = 0; at < s->slots; at += lanes) {
            qdot_wide_pair pair[components];

            for (size_t i = 0; i < s->m; i++)
                pair[i] =
                    (qdot_wide_pair){J + s->J[u * s->m + i] + at, F + i * s->slots + at};
            qdot_taylor_wide_rest(s->places,
                                  &(qdot_wide_sum){s->m, pair, (size_t)k, width, s->forces},
                                  scale, Q ? Q + at : NULL, r + at);
        }
    }
    for (size_t i = 0; i < s->n && more; i++)
        s->r[s->lane[i]] += more[i];
}

void
qdot_residual_sweeps_order(qdot_residual_sweeps *s, int m, double scale,
                           const double *more)
{
    const int k = m - 2;
    const double factor = m * (m - 1);
    const double *S[unknowns * components], *d[components], *r[unknowns];
    double *found[unknowns], *F[components];

    compute_right_side(s, k, scale, more);
    qdot_taylor_wide_order(s->places, m);
    set_order_pointers(s, 0, s->c * s->m, s->J, S);
    set_order_pointers(s, m, s->m, s->d, d);
    for (size_t u = 0; u < s->c; u++) {
        r[u] = s->r + u * s->slots;
        found[u] = s->q + u * s->slots;
    }
    for (size_t i = 0; i < s->m; i++)
        F[i] = s->F + (size_t)k * s->forces + i * s->slots;
    qdot_articulated_solve(s->system,
                           &(qdot_articulated_equations){S, d, r, factor, found, F});
    qdot_taylor_wide_correct(s->places, m, s->q, factor);
}

void
qdot_residual_sweeps_rows(const qdot_residual_sweeps *s, int last, double per_unit,
                          double *q, double *v, size_t stride)
{
    qdot_taylor_wide_rows(s->places, last, per_unit, q, v, stride);
}

void
qdot_residual_sweeps_count(const qdot_residual_sweeps *s, double *convolutions,
                           double *products, double *begun)
{
    const double m = (double)s->m, c = (double)s->c, eights = (double)s->slots / lanes;

    *convolutions = qdot_taylor_wide_convolutions(s->places) + m * c * eights;
    *products = (6 * m * m + 4 * m * c + c * c) * eights + 6 * (m * m + m);
    if (!qdot_articulated_is_path(s->system))
        *products = (4 * m * m + 4 * m * c + c * c) * (double)s->nodes;
    *begun = 2 * (double)qdot_taylor_wide_groups(s->places) + 4 * c * eights;
}

size_t
qdot_residual_sweeps_nodes(const qdot_residual_sweeps *s)
{
    return s->nodes;
}

bool
qdot_residual_sweeps_is_path(const qdot_residual_sweeps *s)
{
    return qdot_articulated_is_path(s->system);
}
