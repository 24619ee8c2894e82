/* sliding.c -- q'', multipliers and shares solved for together; states brought back to u = 0. */
#include "sim/model/sliding.h"

#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "expr/walk.h"
#include "normal/solve/linear.h"
#include "sim/model/switch.h"

/* Up to so many coordinates q'' = M^-1 f is integrated. */
enum { MOST_SOLVED = 3 };

bool
qdot_sliding_is(size_t surfaces, const long *side)
{
    for (size_t i = 0; i < surfaces && side; i++)
        if (side[i] == QDOT_SIDE_SLIDES)
            return true;
    return false;
}

/* The system while it is filled: q'', then multipliers, then shares. */
typedef struct {
    qdot_plan *p;
    const qdot_scene *scene;
    size_t n, m, k, size;
    size_t *surface; /* [k] */
    qdot_expr *A, *b, *x;
} sliding;

static qdot_expr
share_symbol(const sliding *s, size_t j)
{
    return s->p->mode->surfaces.at[s->surface[j]].side;
}

static bool
holds_share(const sliding *s, qdot_expr e)
{
    for (size_t j = 0; j < s->k; j++)
        if (qdot_expr_contains(s->p->pool, e, share_symbol(s, j)))
            return true;
    return false;
}

static qdot_status
cannot(const char *why)
{
    return qdot_fail(QDOT_EFAILED, "%s", why);
}

/* df/dt along the motion; parameters that events set have no rate. */
static qdot_expr
rate(const qdot_plan *p, qdot_expr f)
{
    const qdot_expr zero = QDOT_ZERO;

    f = qdot_ddt(p->pool, f);
    for (size_t i = p->n - p->n_states; i < p->n && f != QDOT_NIL; i++)
        f = qdot_subs(p->pool, f, 1, &p->inputs[p->n + i], &zero);
    return f;
}

static bool
holds(const qdot_plan *p, qdot_expr e, uint32_t what)
{
    return e != QDOT_NIL && (qdot_expr_node(p->pool, e)->holds & what) != 0;
}

/* Row r of the system: f, differentiated `times`, is 0. */
static qdot_status
fill_row(sliding *s, size_t r, qdot_expr f, int times)
{
    const qdot_plan *p = s->p;
    qdot_expr *zeros = qdot_calloc(p->n, sizeof *zeros);

    if (!zeros)
        return QDOT_ENOMEM;
    for (; times > 0; times--)
        f = rate(p, f);
    for (size_t i = 0; i < s->n && f != QDOT_NIL; i++) {
        zeros[i] = QDOT_ZERO;
        if (i < s->n - p->n_states)
            s->A[r * s->size + i] = qdot_diff(p->pool, f, p->inputs[2 * p->n + 1 + i]);
    }
    if (f != QDOT_NIL)
        f = qdot_subs(p->pool, f, p->n, p->inputs + 2 * p->n + 1, zeros);
    qdot_free(zeros);
    if (f != QDOT_NIL)
        s->b[r] = qdot_neg(p->pool, f);
    return qdot_pool_check(p->pool);
}

/* M q'' - sum B s = f0. */
static qdot_status
fill_forces(sliding *s)
{
    const qdot_plan *p = s->p;
    qdot_expr *symbols = qdot_calloc(2 * s->k, sizeof *symbols), *zeros = symbols + s->k;
    qdot_status status = symbols ? QDOT_OK : QDOT_ENOMEM;

    for (size_t j = 0; j < s->k && symbols; j++) {
        symbols[j] = share_symbol(s, j);
        zeros[j] = QDOT_ZERO;
    }
    for (size_t i = 0; i < s->n && status == QDOT_OK; i++) {
        for (size_t j = 0; j < s->n && status == QDOT_OK; j++) {
            s->A[i * s->size + j] = p->M[i * s->n + j];
            if (holds_share(s, p->M[i * s->n + j]))
                status = cannot("a mass switches there");
        }
        for (size_t j = 0; j < s->k && status == QDOT_OK; j++) {
            qdot_expr B = qdot_diff(p->pool, p->f[i], symbols[j]);

            status = qdot_pool_check(p->pool);
            if (status == QDOT_OK && holds_share(s, B))
                status = cannot("forces hold products of what switches there");
            s->A[i * s->size + s->n + s->m + j] = qdot_neg(p->pool, B);
        }
        s->b[i] = qdot_subs(p->pool, p->f[i], s->k, symbols, zeros);
    }
    qdot_free(symbols);
    return status == QDOT_OK ? qdot_pool_check(p->pool) : status;
}

static qdot_status
fill_constraints(sliding *s)
{
    const qdot_plan *p = s->p;

    for (size_t c = 0; c < s->m; c++) {
        const qdot_constraint *from = s->scene->constraints.at + c;
        const size_t r = s->n + c;
        qdot_expr f = qdot_plan_substitute(p, from->f);

        QDOT_TRY(qdot_pool_check(p->pool));
        QDOT_TRY(qdot_switches_freeze(p->mode, p->side, p->share, 1, &f, &f));
        if (holds_share(s, f))
            return cannot("a constraint switches there");
        QDOT_TRY(fill_row(s, r, f, QDOT_ACCELERATION - (int)from->kind));
        for (size_t i = 0; i < s->n; i++)
            s->A[i * s->size + r] = qdot_neg(p->pool, s->A[r * s->size + i]);
    }
    return qdot_pool_check(p->pool);
}

/* u of surface i, frozen to the mode. */
static qdot_status
held(const qdot_plan *p, size_t i, qdot_expr *u)
{
    QDOT_TRY(qdot_switches_freeze(p->mode, p->side, p->share, 1, &p->mode->surfaces.at[i].u, u));
    if (p->mode->surfaces.at[i].steps || holds(p, *u, QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER)
        || !holds(p, *u, QDOT_HAS_VELOCITY | QDOT_HAS_COORD))
        return cannot("no motion can be held there");
    return QDOT_OK;
}

static qdot_status
fill(sliding *s)
{
    QDOT_TRY(fill_forces(s));
    QDOT_TRY(fill_constraints(s));
    for (size_t j = 0; j < s->k; j++) {
        const qdot_surface *x = &s->p->mode->surfaces.at[s->surface[j]];
        const size_t r = s->n + s->m + j;
        qdot_expr u;

        QDOT_TRY(held(s->p, s->surface[j], &u));
        if (holds_share(s, u))
            return cannot("one switch is inside another");
        QDOT_TRY(fill_row(s, r, u, holds(s->p, u, QDOT_HAS_VELOCITY) ? 1 : 2));
        for (size_t i = 0; i < s->n && x->contact; i++) { /* its reaction */
            const qdot_expr slope = s->A[r * s->size + i];

            s->A[i * s->size + r] =
                x->reaction > 0 ? qdot_neg(s->p->pool, slope) : slope;
        }
    }
    return QDOT_OK;
}

/* The shares found, put into f; or q'' itself. */
static qdot_status
put_in(sliding *s)
{
    qdot_plan *p = s->p;
    qdot_expr *symbols = qdot_calloc(s->k, sizeof *symbols);

    if (!symbols)
        return QDOT_ENOMEM;
    for (size_t j = 0; j < s->k; j++) {
        symbols[j] = share_symbol(s, j);
        p->share[s->surface[j]] = s->x[s->n + s->m + j];
    }
    for (size_t i = 0; i < s->n; i++) {
        if (s->m == 0 && s->n <= MOST_SOLVED) {
            p->f[i] = s->x[i];
            for (size_t j = 0; j < s->n; j++)
                p->M[i * s->n + j] = i == j ? QDOT_ONE : QDOT_ZERO;
        } else {
            p->f[i] = qdot_subs(p->pool, p->f[i], s->k, symbols, s->x + s->n + s->m);
        }
    }
    qdot_free(symbols);
    return qdot_pool_check(p->pool);
}

static qdot_status
solve(sliding *s)
{
    qdot_facts facts = qdot_scene_facts(s->scene);
    uint32_t pivot = 0;
    qdot_status status;

    for (size_t i = 0; i < s->size * s->size; i++)
        s->A[i] = QDOT_ZERO;
    QDOT_TRY(fill(s));
    status = qdot_solve_linear(s->p->pool, (uint32_t)s->size, s->A, s->b, s->x, &pivot, &facts);
    if (status == QDOT_ESINGULAR)
        return cannot("the forces that switch there do not determine the motion along it");
    QDOT_TRY(status);
    return put_in(s);
}

qdot_status
qdot_sliding_freeze(qdot_plan *p, const qdot_scene *scene)
{
    const size_t surfaces = p->mode->surfaces.n, n = p->n;
    sliding s = {.p = p, .scene = scene, .n = n, .m = scene->constraints.n};
    qdot_status status = QDOT_OK;

    if (qdot_sliding_is(surfaces, p->side)) {
        p->share = qdot_calloc(surfaces, sizeof *p->share);
        s.surface = qdot_calloc(surfaces, sizeof *s.surface);
        status = p->share && s.surface ? QDOT_OK : QDOT_ENOMEM;
    }
    for (size_t i = 0; i < surfaces && p->share && s.surface; i++) {
        p->share[i] = p->mode->surfaces.at[i].side;
        if (p->side[i] == QDOT_SIDE_SLIDES)
            s.surface[s.k++] = i;
    }
    if (status == QDOT_OK)
        status = qdot_switches_freeze(p->mode, p->side, p->share, n * n, p->M, p->M);
    if (status == QDOT_OK)
        status = qdot_switches_freeze(p->mode, p->side, p->share, n, p->f, p->f);
    if (status == QDOT_OK && s.k > 0) {
        s.size = n + s.m + s.k;
        s.A = qdot_calloc(s.size * (s.size + 2), sizeof *s.A);
        s.b = s.A + s.size * s.size;
        s.x = s.b + s.size;
        status = s.A ? solve(&s) : QDOT_ENOMEM;
    }
    qdot_free(s.A);
    qdot_free(s.surface);
    return status;
}

qdot_expr
qdot_plan_reading(const qdot_plan *p, qdot_expr e)
{
    const qdot_switches *s = p->read_switches;
    qdot_expr *share;

    e = qdot_plan_substitute(p, e);
    if (!p->read_side || e == QDOT_NIL)
        return e;
    share = qdot_calloc(s->surfaces.n, sizeof *share);
    if (!share)
        return qdot_pool_fail(p->pool);
    for (size_t i = 0; i < s->surfaces.n; i++)
        share[i] = s->surfaces.at[i].side;
    if (qdot_switches_freeze(s, p->read_side, share, 1, &e, &e) != QDOT_OK)
        e = qdot_pool_fail(p->pool);
    qdot_free(share);
    return e;
}
