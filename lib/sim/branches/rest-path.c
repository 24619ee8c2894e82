/* rest-path.c -- evaluates the equations of rest by a tape, and judges the stability of an equilibrium. */
#include "sim/branches/rest-path.h"

#include <math.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "tape/derivative.h"

/* A root counts as growing if its real part exceeds this fraction of the fastest rate. */
static const double grows = 1e-7;

static void
evaluate_equilibrium_equations(qdot_path *path, const double *y)
{
    qdot_rest_path *x = (qdot_rest_path *)path;

    qdot_derivative_eval(x->tape, y, 0, path->n + 1, path->F, path->J, x->work);
    if (x->energy != NULL && path->n > 0) {
        double energy;

        qdot_tape_eval(x->energy, y, &energy, x->work);
        path->F[0] = isfinite(energy) ? path->F[0] : NAN;
    }
}

/* Make the tape of the energy, if the energy depends on the unknowns and p alone. */
static qdot_status
make_energy_tape(qdot_rest_path *x)
{
    const qdot_equilibrium_curve *c = x->c;
    const qdot_expr e = c->bind(c->user, c->rest.energy), atoms = e == QDOT_NIL ? QDOT_NIL : qdot_expr_atoms(c->pool, e, true);
    const qdot_status status = qdot_pool_check(c->pool);

    if (status != QDOT_OK)
        return status == QDOT_EDOMAIN ? QDOT_OK : status;
    for (uint32_t i = 0; i < qdot_expr_count(c->pool, atoms); i++) {
        const qdot_expr one = qdot_expr_arg(c->pool, atoms, i);

        if (!qdot_expr_is_class(c->pool, one, QDOT_CONST) && qdot_expr_place(c->n + 1, c->unknown, one) == c->n + 1)
            return QDOT_OK;
    }
    return qdot_tape_new(c->pool, c->n + 1, c->unknown, 1, &e, &x->energy);
}

static qdot_status
judge_equilibrium(qdot_path *path, qdot_path_point *a)
{
    qdot_rest_path *x = (qdot_rest_path *)path;
    const qdot_linear_roots *r = &x->c->roots;
    double fast = 0;

    QDOT_TRY(qdot_equilibrium_curve_judge(x->c, a->y, &a->stability));
    for (size_t i = 0; i < r->n; i++)
        fast = fmax(fast, hypot(r->re[i], r->im[i]));
    a->growing = r->n == 0 ? -1 : 0;
    for (size_t i = 0; i < r->n; i++)
        a->growing += r->re[i] > grows * fast;
    return QDOT_OK;
}

static double
bound_of_unknown(const qdot_path *path, size_t i, bool upper, double p)
{
    return qdot_equilibrium_curve_end_of(((const qdot_rest_path *)path)->c, i, upper, p);
}

qdot_status
qdot_rest_path_begin(qdot_rest_path *x, qdot_equilibrium_curve *c, double least, double most)
{
    size_t work;

    *x = (qdot_rest_path){.c = c};
    QDOT_TRY(qdot_path_begin(&x->path, c->n));
    x->path.coordinates = c->coordinates;
    x->path.angle = c->angle;
    x->path.lo = c->lo;
    x->path.hi = c->hi;
    x->path.end = c->moving ? bound_of_unknown : NULL;
    x->path.least = least;
    x->path.most = most;
    x->path.at = evaluate_equilibrium_equations;
    x->path.judge = judge_equilibrium;
    x->path.upright = 1e-14;
    x->path.dips = true;
    QDOT_TRY(qdot_tape_new(c->pool, c->n + 1, c->unknown, c->n, c->F, &x->tape));
    QDOT_TRY(make_energy_tape(x));
    work = qdot_derivative_work(x->tape);
    if (x->energy != NULL && qdot_tape_work(x->energy) > work)
        work = qdot_tape_work(x->energy);
    x->work = qdot_malloc(work * sizeof *x->work);
    return x->work ? QDOT_OK : QDOT_ENOMEM;
}

void
qdot_rest_path_end(qdot_rest_path *x)
{
    qdot_path_end(&x->path);
    qdot_tape_free(x->tape);
    qdot_tape_free(x->energy);
    qdot_free(x->work);
    *x = (qdot_rest_path){0};
}
