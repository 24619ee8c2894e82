/* taylor-wide.c -- groups equal steps of a program into vectors, and chooses functions for them. */
#include "series/taylor-wide.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/kinds.h"
#include "series/taylor-steps.h"

/* The average number of steps per group from which computing them as vectors is worthwhile. */
static const double least_alike = 2.5;

#define NO_LANE SIZE_MAX

/* Pseudo-operations that copy operands side by side; COPIED_ONCE: for rows that have only order 0. */
enum { COPIED = QDOT_T_COUNT, COPIED_ONCE };

typedef struct {
    int op, sign;
    size_t lanes;                  /* number of steps in the group, rounded up to full vectors */
    size_t to, second, third, d, x, y, z; /* first lane of each row of the group; a row that the group lacks: `to` */
    size_t count;                  /* how many lanes are copied from `from` */
    size_t *from;
} group;

/* Functions for coefficients stored by order, and for each order by lane, compiled for a kind of processor. */
typedef struct {
    void (*order)(const qdot_taylor_wide *w, int k);
    void (*correct)(const qdot_taylor_wide *w, int k, const double *newest,
                    double divisor);
    void (*rest)(const qdot_wide_sum *sum, double scale, const double *from, double *out);
    void (*rows)(const double *X, size_t width, int last, double per_unit,
                 double *const *q, double *const *v);
} kernels;

struct qdot_taylor_wide {
    const kernels *kernels;
    size_t n;         /* number of inputs whose newest coefficients are corrected */
    size_t corrected; /* number of lanes that hold the corrected inputs */
    size_t inputs;    /* number of lanes of all inputs, rounded up to full vectors */
    size_t width, rows, stride;
    int orders;
    const double *coefficients; /* the coefficients of the program, read only for rows that are constant numbers */
    size_t *lane;               /* [rows] the lane of each row */
    size_t *input;              /* [inputs] the index of the input that each lane holds; NO_LANE: none */
    size_t constant;            /* the first lane whose row is constant in time */
    size_t changing;            /* index after the last lane whose row is constant in time */
    qdot_vec(group) groups;
    double *allocated, *X, *N; /* memory; X [orders x width] coefficients; N [width] newest coefficients */
    double convolutions;
};

static inline void
group_copy(const group *g, double *at)
{
    for (size_t i = 0; i < g->count; i++)
        at[g->to + i] = at[g->from[i]];
}

#define LANES 4
#define NAME(x) portable_##x
#define MA(a, b, c) QDOT_VECTOR_MA(portable_vector, a, b, c)
#include "series/taylor-wide.def"
#undef NAME
#undef MA

#ifdef QDOT_X86_KINDS
#include <immintrin.h>

QDOT_KIND_AVX2
#define NAME(x) avx2_##x
#define MA(a, b, c)                                                                      \
    ((avx2_vector)_mm256_fmadd_pd((__m256d)(a), (__m256d)(b), (__m256d)(c)))
#include "series/taylor-wide.def"
#undef NAME
#undef MA
#undef LANES
QDOT_KIND_END

QDOT_KIND_AVX512
#define LANES 8
#define NAME(x) avx512_##x
#define MA(a, b, c)                                                                      \
    ((avx512_vector)_mm512_fmadd_pd((__m512d)(a), (__m512d)(b), (__m512d)(c)))
#include "series/taylor-wide.def"
#undef NAME
#undef MA
QDOT_KIND_END
#endif
#undef LANES

static const kernels *
available_kernels(void)
{
#ifdef QDOT_X86_KINDS
    if (qdot_kind_is_here(2))
        return &avx512_kernels;
    if (qdot_kind_is_here(1))
        return &avx2_kernels;
#endif
    return &portable_kernels;
}

/* --- making groups of steps ---------------------------------------------------------- */

/* A step of the program, and the keys by which it is grouped with others. */
typedef struct {
    const qdot_taylor_step *step;
    size_t level, x, y, z; /* depth of the step in the program; lanes of its operands x, y, z */
    size_t first;          /* the first of the operands x, y, z that varies in time */
} member;

typedef struct {
    qdot_taylor_wide *w;
    const qdot_taylor *t;
    const size_t *inputs; /* the inputs in the order of lanes; NULL: in their own order */
    size_t *level;        /* [rows] depth of each row in the program */
    member *members;
    size_t n_members, deepest;
    size_t *lanes; /* scratch for lane numbers */
} builder;

static size_t
index_of_row_in_program(const qdot_taylor_wide *w, const double *row)
{
    return (size_t)(row - w->coefficients) / w->stride;
}

static size_t
full(size_t n)
{
    return (n + QDOT_WIDE_LANES - 1) / QDOT_WIDE_LANES * QDOT_WIDE_LANES;
}

static size_t
reserve_lanes(qdot_taylor_wide *w, size_t n)
{
    const size_t at = w->width;

    w->width += full(n);
    return at;
}

/* Whether the row in a lane has coefficients of orders above 0. */
static bool
lane_changes(const qdot_taylor_wide *w, size_t lane)
{
    return lane < w->constant || lane >= w->changing;
}

qdot_status
qdot_taylor_wide_align(qdot_taylor_wide *w, size_t count, const size_t *lanes, size_t *at)
{
    group g = {.op = COPIED_ONCE, .count = count, .lanes = full(count)};
    bool aligned = lanes[0] % QDOT_WIDE_LANES == 0;

    for (size_t i = 1; i < count; i++)
        aligned = aligned && lanes[i] == lanes[0] + i;
    *at = lanes[0];
    if (aligned)
        return QDOT_OK;
    g.from = qdot_calloc(count, sizeof *g.from);
    if (!g.from)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < count; i++) {
        g.from[i] = lanes[i] == NO_LANE ? w->constant : lanes[i];
        if (lane_changes(w, g.from[i]))
            g.op = COPIED;
    }
    *at = g.to = reserve_lanes(w, count);
    if (qdot_vec_push(&w->groups, g) != QDOT_OK) {
        qdot_free(g.from);
        return QDOT_ENOMEM;
    }
    return QDOT_OK;
}

/* Assign the lanes of level 0: first the inputs, then rows that are constant in time. */
static void
assign_first_lanes(builder *b)
{
    qdot_taylor_wide *w = b->w;
    const qdot_taylor *t = b->t;
    size_t at;

    for (size_t r = 0; r < w->rows; r++) {
        w->lane[r] = r >= w->n ? NO_LANE : b->inputs ? b->inputs[r] : r;
        b->level[r] = 0;
    }
    w->width = w->inputs = full(w->corrected);
    for (size_t l = 0; l < w->inputs; l++)
        w->input[l] = NO_LANE;
    for (size_t r = 0; r < w->n; r++)
        w->input[w->lane[r]] = r;
    at = reserve_lanes(w, t->inputs - w->n);
    for (size_t r = w->n; r < t->inputs; r++)
        w->lane[r] = at++;
    w->constant = reserve_lanes(w, 1);
    for (size_t i = t->still; i < t->length; i++) {
        const qdot_taylor_step *s = t->steps + i;

        w->lane[index_of_row_in_program(w, s->to)] = 0; /* only marks the row as computed here; its lane is assigned below */
        if (s->second)
            w->lane[index_of_row_in_program(w, s->second)] = 0;
        if (s->third)
            w->lane[index_of_row_in_program(w, s->third)] = 0;
        if (s->d)
            w->lane[index_of_row_in_program(w, s->d)] = 0;
    }
    at = w->width;
    for (size_t r = t->inputs; r < w->rows; r++)
        if (w->lane[r] == NO_LANE)
            w->lane[r] = at++;
    w->width = w->changing = full(at);
}

/* List the steps whose rows are not constant, with their levels (depths in the program). */
static void
list_steps(builder *b)
{
    const qdot_taylor *t = b->t;

    for (size_t i = t->still; i < t->length; i++) {
        const qdot_taylor_step *s = t->steps + i;
        const size_t x = b->level[index_of_row_in_program(b->w, s->x)], y = b->level[index_of_row_in_program(b->w, s->y)];
        const size_t z = b->level[index_of_row_in_program(b->w, s->z)];
        size_t level = (x > y ? x : y) > z ? (x > y ? x : y) : z;

        b->members[b->n_members++] = (member){.step = s, .level = ++level};
        b->level[index_of_row_in_program(b->w, s->to)] = level;
        if (s->second)
            b->level[index_of_row_in_program(b->w, s->second)] = level;
        if (s->third)
            b->level[index_of_row_in_program(b->w, s->third)] = level;
        b->deepest = level > b->deepest ? level : b->deepest;
    }
}

static int
compare_by_operands(const void *left, const void *right)
{
    const member *a = left, *b = right;

    if (a->first != b->first)
        return a->first < b->first ? -1 : 1;
    if (a->x != b->x)
        return a->x < b->x ? -1 : 1;
    if (a->y != b->y)
        return a->y < b->y ? -1 : 1;
    return a->z < b->z ? -1 : a->z > b->z;
}

static qdot_status
align_operand(builder *b, const member *m, size_t n, size_t offset, size_t *at)
{
    for (size_t i = 0; i < n; i++)
        memcpy(b->lanes + i, (const char *)(m + i) + offset, sizeof *b->lanes);
    return qdot_taylor_wide_align(b->w, n, b->lanes, at);
}

/* Add a group of n equal steps, which are computed together as vectors. */
static qdot_status
add_group(builder *b, member *m, size_t n)
{
    qdot_taylor_wide *w = b->w;
    group g = {.op = m->step->op, .sign = m->step->sign, .lanes = full(n)};
    const double vectors = (double)(g.lanes / QDOT_WIDE_LANES);

    for (size_t i = 0; i < n; i++) {
        m[i].x = w->lane[index_of_row_in_program(w, m[i].step->x)];
        m[i].y = w->lane[index_of_row_in_program(w, m[i].step->y)];
        m[i].z = w->lane[index_of_row_in_program(w, m[i].step->z)];
        m[i].first = lane_changes(w, m[i].x) ? m[i].x : lane_changes(w, m[i].y) ? m[i].y : m[i].z;
    }
    qsort(m, n, sizeof *m, compare_by_operands);
    QDOT_TRY(align_operand(b, m, n, offsetof(member, x), &g.x));
    QDOT_TRY(align_operand(b, m, n, offsetof(member, y), &g.y));
    QDOT_TRY(align_operand(b, m, n, offsetof(member, z), &g.z));
    g.to = reserve_lanes(w, n);
    g.second = m->step->second ? reserve_lanes(w, n) : g.to;
    g.third = m->step->third ? reserve_lanes(w, n) : g.to;
    g.d = m->step->d ? reserve_lanes(w, n) : g.to;
    for (size_t i = 0; i < n; i++) {
        w->lane[index_of_row_in_program(w, m[i].step->to)] = g.to + i;
        if (m->step->second)
            w->lane[index_of_row_in_program(w, m[i].step->second)] = g.second + i;
        if (m->step->third)
            w->lane[index_of_row_in_program(w, m[i].step->third)] = g.third + i;
        if (m->step->d)
            w->lane[index_of_row_in_program(w, m[i].step->d)] = g.d + i;
    }
    w->convolutions += ceil(qdot_recurrence_cost(g.op)) * vectors; /* here a square costs as much as a product */
    return qdot_vec_push(&w->groups, g);
}

static qdot_status
add_all_groups(builder *b)
{
    member *now = qdot_calloc(b->n_members + 1, sizeof *now);
    qdot_status status = now ? QDOT_OK : QDOT_ENOMEM;

    for (size_t level = 1; level <= b->deepest && status == QDOT_OK; level++)
        for (int kind = 0; kind < 2 * QDOT_T_COUNT && status == QDOT_OK; kind++) {
            const int op = kind / 2, sign = kind % 2 ? -1 : 1;
            size_t n = 0;

            for (size_t i = 0; i < b->n_members; i++) {
                const qdot_taylor_step *s = b->members[i].step;

                if (b->members[i].level == level && s->op == op && s->sign == sign)
                    now[n++] = b->members[i];
            }
            if (n > 0)
                status = add_group(b, now, n);
        }
    qdot_free(now);
    return status;
}

static qdot_status
build_groups(builder *b, bool *built)
{
    const size_t rows = b->w->rows;

    b->level = qdot_calloc(rows + 1, sizeof *b->level);
    b->lanes = qdot_calloc(rows + 1, sizeof *b->lanes);
    b->members = qdot_calloc(b->t->length + 1, sizeof *b->members);
    b->w->lane = qdot_calloc(rows + 1, sizeof *b->w->lane);
    b->w->input = qdot_calloc(full(b->w->corrected) + 1, sizeof *b->w->input);
    if (!b->level || !b->lanes || !b->members || !b->w->lane || !b->w->input)
        return QDOT_ENOMEM;
    assign_first_lanes(b);
    list_steps(b);
    QDOT_TRY(add_all_groups(b));
    *built = (double)b->n_members >= least_alike * (double)b->w->groups.n;
    return QDOT_OK;
}

qdot_status
qdot_taylor_wide_new(const qdot_taylor *t, size_t n, const size_t *lane, size_t lanes,
                     qdot_taylor_wide **wide)
{
    qdot_taylor_wide *w = qdot_calloc(1, sizeof *w);
    builder b = {.w = w, .t = t, .inputs = lane};
    bool built = false;
    qdot_status status;

    *wide = NULL;
    if (!w)
        return QDOT_ENOMEM;
    w->kernels = available_kernels();
    w->n = n;
    w->corrected = lane ? lanes : n;
    w->rows = t->rows;
    w->stride = t->stride;
    w->orders = (int)t->stride;
    w->coefficients = t->coefficients;
    status = build_groups(&b, &built);
    qdot_free(b.level);
    qdot_free(b.lanes);
    qdot_free(b.members);
    if (status != QDOT_OK || !built) {
        qdot_taylor_wide_free(w);
        return status;
    }
    *wide = w;
    return QDOT_OK;
}

void
qdot_taylor_wide_free(qdot_taylor_wide *w)
{
    if (!w)
        return;
    for (size_t i = 0; i < w->groups.n; i++)
        qdot_free(w->groups.at[i].from);
    qdot_free(w->groups.at);
    qdot_free(w->lane);
    qdot_free(w->input);
    qdot_free(w->allocated);
    qdot_free(w);
}

/* --- evaluating groups of steps ------------------------------------------------------ */

size_t
qdot_taylor_wide_width(const qdot_taylor_wide *w)
{
    return w->width;
}

double *
qdot_taylor_wide_at(const qdot_taylor_wide *w, int k)
{
    return w->X + (size_t)k * w->width;
}

size_t
qdot_taylor_wide_lane(const qdot_taylor_wide *w, const double *row)
{
    return w->lane[index_of_row_in_program(w, row)];
}

qdot_status
qdot_taylor_wide_settle(qdot_taylor_wide *w)
{
    size_t n;

    /* an even number of cache lines between orders would map them to the same sets of the cache */
    w->width += w->width % (2 * QDOT_WIDE_LANES) ? 0 : QDOT_WIDE_LANES;
    n = ((size_t)w->orders + 1) * w->width;
    w->allocated = qdot_calloc(n + QDOT_WIDE_LANES, sizeof(double));
    if (!w->allocated)
        return QDOT_ENOMEM;
    w->X = w->allocated;
    while ((uintptr_t)w->X % (QDOT_WIDE_LANES * sizeof(double)) != 0)
        w->X++;
    w->N = w->X + (size_t)w->orders * w->width;
    return QDOT_OK;
}

void
qdot_taylor_wide_begin(qdot_taylor_wide *w, const qdot_taylor *t)
{
    for (size_t r = 0; r < w->rows; r++)
        w->X[w->lane[r]] = t->coefficients[r * w->stride];
    w->X[w->constant] = 0;
    for (size_t r = w->n; r < t->inputs; r++)
        w->X[w->width + w->lane[r]] = t->coefficients[r * w->stride + 1];
    for (const group *g = w->groups.at; g < w->groups.at + w->groups.n; g++)
        if (g->op >= COPIED)
            group_copy(g, w->X);
}

void
qdot_taylor_wide_order(qdot_taylor_wide *w, int k)
{
    memset(w->X + (size_t)k * w->width, 0, w->inputs * sizeof *w->X);
    w->kernels->order(w, k);
}

void
qdot_taylor_wide_correct(qdot_taylor_wide *w, int k, const double *newest, double divisor)
{
    if (w->corrected < w->inputs) { /* the lanes after those of the corrected inputs stay 0 */
        memcpy(w->N, newest, w->corrected * sizeof *newest);
        memset(w->N + w->corrected, 0, (w->inputs - w->corrected) * sizeof *newest);
        newest = w->N;
    }
    w->kernels->correct(w, k, newest, divisor);
}

void
qdot_taylor_wide_rows(const qdot_taylor_wide *w, int last, double per_unit, double *q,
                      double *v, size_t stride)
{
    double nowhere[QDOT_SERIES_MOST + 2 * QDOT_WIDE_LANES];

    for (size_t i = 0; i < w->n && last == 2; i++) {
        q[i * stride + 2] = w->X[2 * w->width + w->lane[i]];
        v[i * stride + 1] = 2 * per_unit * q[i * stride + 2];
    }
    for (size_t at = 0; last > 2 && at < w->inputs; at += QDOT_WIDE_LANES) {
        double *to_q[QDOT_WIDE_LANES], *to_v[QDOT_WIDE_LANES];

        for (size_t l = 0; l < QDOT_WIDE_LANES; l++) {
            const size_t i = w->input[at + l];

            to_q[l] = i == NO_LANE ? nowhere : q + i * stride;
            to_v[l] = i == NO_LANE ? nowhere : v + i * stride;
        }
        w->kernels->rows(w->X + at, w->width, last, per_unit, to_q, to_v);
    }
}

void
qdot_taylor_wide_rest(const qdot_taylor_wide *w, const qdot_wide_sum *sum, double scale,
                      const double *from, double *out)
{
    w->kernels->rest(sum, scale, from, out);
}

double
qdot_taylor_wide_convolutions(const qdot_taylor_wide *w)
{
    return w->convolutions;
}

size_t
qdot_taylor_wide_groups(const qdot_taylor_wide *w)
{
    return w->groups.n;
}
