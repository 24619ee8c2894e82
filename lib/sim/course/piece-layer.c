/* piece-layer.c -- checks that a layer about a branch point (sim/model/layer.h) may be passed. */
#include "sim/course/piece.h"

#include <float.h>
#include <math.h>

#include "ode/scale.h"

/* What may be left out at tolerances below this. */
static const double least_left_out = 16 * DBL_EPSILON;

static const qdot_surface *
surface(const qdot_piece *x, size_t i)
{
    return &x->c->stage->switches.surfaces.at[i];
}

/* Entering a layer: the force that it leaves out, into x->rim [n]. Leaving it: what has been left
 * out of velocities since, relative to its size. */
static qdot_status
pass_rim(qdot_piece *x, size_t i, bool leaves)
{
    qdot_course *c = x->c;
    const double began = c->tr.t[c->tr.pieces.at[c->tr.pieces.n - 1].first];
    const double time = fabs(x->start.t - began) / (1 + surface(x, i)->power);
    double *inside = qdot_malloc(2 * x->n * sizeof *inside), *beyond = inside + x->n,
           most = 0;
    qdot_status status = inside ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_piece_rates(x, leaves ? x->start.from : x->mode, inside);
    if (status == QDOT_OK)
        status = qdot_piece_rates(x, leaves ? x->mode : x->start.from, beyond);
    for (size_t k = 0; k < x->n && status == QDOT_OK; k++) {
        const double out = beyond[k] - inside[k];

        most = fmax(most, fabs(x->entered ? (x->rim[k] + out) / 2 : out)
                              / qdot_ode_size(c->stage->scales, k, x->start.y[k]));
        x->rim[k] = out;
    }
    qdot_free(inside);
    x->entered = !leaves;
    if (leaves)
        c->left_out += most * time;
    if (status == QDOT_OK && c->left_out > fmax(x->options->tol, least_left_out))
        qdot_piece_stop_at(x, i, 0, "a power of what passes 0 so slowly cannot be followed at", "");
    return status;
}

/* In the layer of surface i: whether the motion, by its velocities and accelerations now, is there
 * still when the run ends. */
static qdot_status
rests(qdot_piece *x, size_t i, bool *yes)
{
    const size_t n = x->n / 2;
    const double h = x->t1 - x->start.t;
    double *y = qdot_malloc(2 * x->n * sizeof *y), *rates = y + x->n;
    long *side = qdot_calloc(x->c->stage->switches.surfaces.n, sizeof *side);
    qdot_status status = y && side ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_piece_rates(x, x->mode, rates);
    for (size_t k = 0; k < n && status == QDOT_OK; k++) {
        y[k] = x->start.y[k] + h * (rates[k] + h / 2 * rates[n + k]);
        y[n + k] = x->start.y[n + k] + h * rates[n + k];
    }
    if (status == QDOT_OK)
        status = qdot_stage_sides(x->c->stage, x->t1, y, NULL, side);
    *yes = status == QDOT_OK && side[i] == 0;
    qdot_free(side);
    qdot_free(y);
    return status;
}

qdot_status
qdot_piece_check_layers(qdot_piece *x)
{
    const qdot_mode *old = x->c->stage->modes.at[x->start.from],
                    *now = qdot_piece_mode(x);
    const size_t surfaces = x->c->stage->switches.surfaces.n;

    for (size_t i = 0; i < surfaces && x->c->reason[0] == '\0'; i++) {
        bool stays = false;

        if (surface(x, i)->layer == 0)
            continue;
        if (x->start.jumped)
            x->entered = false;
        else if ((old->side[i] == 0) != (now->side[i] == 0))
            QDOT_TRY(pass_rim(x, i, old->side[i] == 0));
        /* from a power of less than 1 the motion may leave at any time */
        if (now->side[i] == 0 && surface(x, i)->power < 1)
            QDOT_TRY(rests(x, i, &stays));
        if (stays)
            qdot_piece_stop_at(x, i, 0, "nothing says when the motion, at rest, leaves", "");
    }
    return QDOT_OK;
}
