/* guarded.c -- callbacks that go to one of two series. */
#include "sim/form/guarded.h"

static qdot_status
prepare(int p, void *user)
{
    qdot_guarded *g = user;

    g->p = p;
    if (g->other->prepare)
        QDOT_TRY(g->other->prepare(p, g->other->user));
    return g->own->prepare ? g->own->prepare(p, g->own->user) : QDOT_OK;
}

/* The first state is looked at in any case: where it is not for `own` no code is written. */
static qdot_status
begin(double t, const double *y, double unit, void *user)
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
    g->now = ready && status == QDOT_OK && (!g->fits || g->fits(g->form)) ? g->own : g->other;
    g->series.x = g->now->x;
    g->series.stride = g->now->stride;
    return g->now == g->own ? QDOT_OK : g->other->begin(t, y, unit, g->other->user);
}

static qdot_status
extend(int p, void *user)
{
    const qdot_guarded *g = user;

    return g->now->extend(p, g->now->user);
}

static double
noise(void *user)
{
    const qdot_guarded *g = user;

    return g->now->noise ? g->now->noise(g->now->user) : 0;
}

static double
ahead(void *user)
{
    const qdot_guarded *g = user;

    return g->now->ahead ? g->now->ahead(g->now->user) : 0;
}

static double
near(int p, double s, void *user)
{
    const qdot_guarded *g = user;

    return g->now->near ? g->now->near(p, s, g->now->user) : s;
}

void
qdot_guarded_init(qdot_guarded *g, const qdot_ode_series *own, const qdot_ode_series *other,
                  bool as_code)
{
    *g = (qdot_guarded){.own = own, .other = other, .now = own, .as_code = as_code};
    g->series = (qdot_ode_series){.most = own->most < other->most ? own->most : other->most,
                                  .x = own->x,
                                  .stride = own->stride,
                                  .checked = own->checked,
                                  .prepare = prepare,
                                  .code = own->code,
                                  .begin = begin,
                                  .extend = extend,
                                  .noise = other->noise ? noise : NULL,
                                  .ahead = other->ahead ? ahead : NULL,
                                  .near = own->near || other->near ? near : NULL,
                                  .user = g};
}
