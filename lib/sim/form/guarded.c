/* guarded.c -- chooses between a fast Taylor series for independent constraints and a safe one for others. */
#include "sim/form/guarded.h"

#include "base/memory.h"
#include "sim/form/motion-series.h"
#include "sim/model/constraints.h"

/* The elimination without pivoting is used if the squared sine between constraint gradients exceeds this. */
static const double least_sine = 0.1;

struct qdot_guarded {
    qdot_motion_series *fast;
    const qdot_ode_series *own, *other, *now; /* the fast series; the safer one; the one that was begun last */
    size_t n, m;
    bool as_code; /* the fast series `own` is faster only as machine code */
    int p;        /* order: `other` is used until `own` has machine code for this order */
    bool looked;  /* `own` has measured the constraints' independence at the first state */
    qdot_ode_series series;
};

/* Whether the constraints are independent: compares the pivots of the eliminated multipliers, then diagonal
 * entries, the last outputs. */
static bool
are_constraints_independent(const qdot_guarded *g)
{
    for (size_t k = 0; k < g->m; k++) {
        const double pivot = qdot_motion_series_output(g->fast, g->n + k)[0];
        const double diagonal = qdot_motion_series_output(g->fast, g->n + g->m + k)[0];

        if (!(pivot > least_sine * diagonal))
            return false;
    }
    return true;
}

static qdot_status
prepare_code(int p, void *user)
{
    qdot_guarded *g = user;

    g->p = p;
    if (g->other->prepare)
        QDOT_TRY(g->other->prepare(p, g->other->user));
    return g->own->prepare ? g->own->prepare(p, g->own->user) : QDOT_OK;
}

/* Begin with a test of the first state; where the fast series may not be used, no machine code is written. */
static qdot_status
begin_chosen_series(double t, const double *y, double unit, void *user)
{
    qdot_guarded *g = user;
    const qdot_ode_code *code = &g->own->code;
    const bool ready = !g->as_code || code->there(g->p, code->user);
    qdot_status status = QDOT_EDOMAIN;

    if (ready || !g->looked)
        status = g->own->begin(t, y, unit, g->own->user);
    if (status != QDOT_OK && status != QDOT_EDOMAIN)
        return status;
    g->looked = true;
    g->now = ready && status == QDOT_OK && (g->as_code || are_constraints_independent(g)) ? g->own : g->other;
    g->series.x = g->now->x;
    g->series.stride = g->now->stride;
    return g->now == g->own ? QDOT_OK : g->other->begin(t, y, unit, g->other->user);
}

static qdot_status
extend_chosen_series(int p, void *user)
{
    const qdot_guarded *g = user;

    return g->now->extend(p, g->now->user);
}

static double
noise_of_chosen_series(void *user)
{
    const qdot_guarded *g = user;

    return g->now->noise ? g->now->noise(g->now->user) : 0;
}

static double
look_ahead_in_chosen_series(void *user)
{
    const qdot_guarded *g = user;

    return g->now->ahead ? g->now->ahead(g->now->user) : 0;
}

static double
step_of_chosen_series(int p, double s, double least, void *user)
{
    const qdot_guarded *g = user;

    return g->now->near ? g->now->near(p, s, least, g->now->user) : s;
}

static void
make_callbacks(qdot_guarded *g, const qdot_ode_cost *cost)
{
    const qdot_ode_series *own = g->own, *other = g->other;

    g->series = (qdot_ode_series){.most = own->most < other->most ? own->most : other->most,
                                  .x = own->x,
                                  .stride = own->stride,
                                  .checked = own->checked,
                                  .cost = *cost,
                                  .prepare = prepare_code,
                                  .code = own->code,
                                  .begin = begin_chosen_series,
                                  .extend = extend_chosen_series,
                                  .noise = other->noise ? noise_of_chosen_series : NULL,
                                  .ahead = other->ahead ? look_ahead_in_chosen_series : NULL,
                                  .near = own->near || other->near ? step_of_chosen_series : NULL,
                                  .user = g};
}

qdot_status
qdot_guarded_new(const qdot_plan *plan, const qdot_plan *fast, bool shaken,
                 const qdot_ode_series *other, qdot_guarded **guarded)
{
    qdot_guarded *g = qdot_calloc(1, sizeof *g);
    qdot_status status;

    *guarded = NULL;
    if (!g)
        return QDOT_ENOMEM;
    status = qdot_motion_series_new(fast, shaken, &g->fast);
    if (status != QDOT_OK) {
        qdot_guarded_free(g);
        return status;
    }
    g->own = g->now = qdot_motion_series_get(g->fast);
    g->other = other;
    g->as_code = fast == plan;
    g->n = plan->n;
    g->m = plan->constraints->m;
    make_callbacks(g, &plan->expansions);
    *guarded = g;
    return QDOT_OK;
}

void
qdot_guarded_free(qdot_guarded *g)
{
    if (!g)
        return;
    qdot_motion_series_free(g->fast);
    qdot_free(g);
}

const qdot_ode_series *
qdot_guarded_series(const qdot_guarded *g)
{
    return &g->series;
}

size_t
qdot_guarded_code(const qdot_guarded *g, const char **why)
{
    return qdot_motion_series_code(g->fast, why);
}
