/* kept.c -- caches the latest plans of a scene (how its runs are computed), newest first. */
#include "sim/plan/kept.h"

#include <string.h>

#include "ode/leading.h"

enum { MOST = 4 };

typedef struct {
    qdot_plan *plan;
    qdot_run_treatment treatment; /* treatment of constraints that was requested */
    double tol;
    qdot_expr *start; /* [2n + 1] start q0, v0, t0 of the request for which the plan was made */
} kept_plan;

typedef struct {
    uint64_t version; /* version of the scene for which the plans were made */
    size_t n;
    kept_plan at[MOST];
} kept_plans;

static void
release_plan(kept_plan *k)
{
    qdot_plan_free(k->plan);
    qdot_free(k->start);
    *k = (kept_plan){0};
}

static void
clear_cache(kept_plans *all)
{
    while (all->n > 0)
        release_plan(&all->at[--all->n]);
}

static void
free_cache(void *user)
{
    clear_cache(user);
    qdot_free(user);
}

static bool
has_same_start(const kept_plan *k, const qdot_run_request *r)
{
    const size_t n = k->plan->n;

    return memcmp(k->start, r->q0, n * sizeof *r->q0) == 0
           && memcmp(k->start + n, r->v0, n * sizeof *r->v0) == 0 && k->start[2 * n] == r->t0;
}

static bool
depends_on_start(const qdot_plan *p)
{
    bool by_start = p->by_start;

    for (size_t i = 0; i < p->n_parts; i++)
        by_start = by_start || p->parts[i]->by_start;
    return by_start;
}

static bool
fits_request(const kept_plan *k, const qdot_run_request *r)
{
    const qdot_plan *p = k->plan;
    const bool chosen = !r->method || strcmp(r->method, "auto") == 0;

    if (p->chosen != chosen || (!chosen && strcmp(r->method, p->method->name) != 0)
        || k->treatment != r->treatment || p->n_values != r->n_values
        || (r->tol <= QDOT_ODE_LEADING_TOL) != (k->tol <= QDOT_ODE_LEADING_TOL))
        return false;
    if (r->tol != k->tol && (p->constraints || depends_on_start(p)))
        return false;
    if (depends_on_start(p) && !has_same_start(k, r))
        return false;
    return r->n_values == 0
           || (memcmp(p->symbols, r->symbols, r->n_values * sizeof *r->symbols) == 0
               && memcmp(p->values, r->values, r->n_values * sizeof *r->values) == 0);
}

static bool
is_cacheable(const qdot_run_request *r)
{
    return r->digits == 0 && r->n_states == 0 && r->q0 && r->v0;
}

qdot_plan *
qdot_kept_find(const qdot_scene *scene, const qdot_run_request *r)
{
    kept_plans *all = scene->kept;

    if (!all || all->version != scene->version || !is_cacheable(r))
        return NULL;
    for (size_t i = 0; i < all->n; i++)
        if (fits_request(&all->at[i], r)) {
            all->at[i].plan->uses++;
            return all->at[i].plan;
        }
    return NULL;
}

void
qdot_kept_add(qdot_scene *scene, const qdot_run_request *r, qdot_plan *plan)
{
    const size_t n = plan->n;
    kept_plan k = {.plan = plan, .treatment = r->treatment, .tol = r->tol};
    kept_plans *all;

    if (!is_cacheable(r))
        return;
    if (!scene->kept) {
        scene->kept = qdot_calloc(1, sizeof *all);
        scene->kept_free = free_cache;
    }
    all = scene->kept;
    k.start = all ? qdot_calloc(2 * n + 1, sizeof *k.start) : NULL;
    if (!k.start)
        return;
    memcpy(k.start, r->q0, n * sizeof *r->q0);
    memcpy(k.start + n, r->v0, n * sizeof *r->v0);
    k.start[2 * n] = r->t0;
    if (all->version != scene->version)
        clear_cache(all);
    all->version = scene->version;
    if (all->n == MOST)
        release_plan(&all->at[--all->n]);
    memmove(all->at + 1, all->at, all->n * sizeof *all->at);
    all->at[0] = k;
    all->n++;
    plan->uses++;
}
