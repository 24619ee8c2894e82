/* piece-layer.c -- checks that a layer about a branch point (sim/model/layer.h) may be passed. */
#include "sim/course/piece.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* What may be left out at tolerances below this. */
static const double least_left_out = 16 * DBL_EPSILON;

static const qdot_surface *
surface(const qdot_piece *x, size_t i)
{
    return &x->c->stage->switches.surfaces.at[i];
}

static void
say(qdot_piece *x, size_t i, const char *what)
{
    qdot_text text = {0};

    if (qdot_stage_describe(x->c->stage, i, 0, &text) != QDOT_OK)
        qdot_text_truncate(&text, 0);
    snprintf(x->c->reason, sizeof x->c->reason, "stopped at t = %.15g: %s %.200s",
             x->start.t, what, text.n > 0 ? qdot_text_str(&text) : "a surface");
    qdot_text_clear(&text);
    qdot_piece_stop(x, true);
}

/* The rates at the start of the piece in a mode, of the whole state. */
static qdot_status
rates_in(const qdot_piece *x, size_t mode, double *rates)
{
    const qdot_ode_system *system = x->c->systems.at + mode;

    return system->rhs(x->start.t, x->start.y, rates, system->user);
}

/* Entering a layer: the force that it leaves out, into x->rim [n]. Leaving it: what has been left
 * out of velocities since, relative to max(1, |value|). */
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
        status = rates_in(x, leaves ? x->start.from : x->mode, inside);
    if (status == QDOT_OK)
        status = rates_in(x, leaves ? x->mode : x->start.from, beyond);
    for (size_t k = 0; k < x->n && status == QDOT_OK; k++) {
        const double out = beyond[k] - inside[k];

        most = fmax(most, fabs(x->entered ? (x->rim[k] + out) / 2 : out) /
                              fmax(1, fabs(x->start.y[k])));
        x->rim[k] = out;
    }
    qdot_free(inside);
    x->entered = !leaves;
    if (leaves)
        c->left_out += most * time;
    if (status == QDOT_OK && c->left_out > fmax(x->options->tol, least_left_out))
        say(x, i, "a power of what passes 0 so slowly cannot be followed at");
    return status;
}

/* In the layer of surface i: whether the motion, by its velocities and accelerations now, is there
 * still when the run ends. */
static qdot_status
rests(qdot_piece *x, size_t i, bool *yes)
{
    const qdot_ode_system *system = x->c->systems.at + x->mode;
    const size_t n = x->n / 2;
    const double h = x->t1 - x->start.t;
    double *y = qdot_malloc(2 * x->n * sizeof *y), *rates = y + x->n;
    long *side = qdot_calloc(x->c->stage->switches.surfaces.n, sizeof *side);
    qdot_status status = y && side ? QDOT_OK : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = system->rhs(x->start.t, x->start.y, rates, system->user);
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
            say(x, i, "nothing says when the motion, at rest, leaves");
    }
    return QDOT_OK;
}
