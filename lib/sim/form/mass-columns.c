/* mass-columns.c -- evaluates the mass matrix by sweeps out to the functions and back, 32 columns at a time. */
#include "sim/form/mass-columns.h"

#include <string.h>

#include "base/memory.h"
#include "tape/rows.h"
#include "tape/shake.h"

enum { block = QDOT_TAPE_ROWS };

struct qdot_mass_columns {
    const qdot_residual *residual;
    size_t n;
    qdot_tape *along, *adjoint; /* shaken copies; NULL: those of the residual */
    double *weight;             /* [n_weights] */
    double *in, *x, *back, *column, *work; /* [block] rows: inputs and outputs of both tapes; their work space */
};

qdot_status
qdot_mass_columns_new(const qdot_residual *r, size_t n, bool shaken, qdot_mass_columns **columns)
{
    qdot_mass_columns *c = qdot_calloc(1, sizeof *c);
    const size_t along = qdot_tape_work(r->along), adjoint = qdot_tape_work(r->adjoint);
    qdot_status status = QDOT_OK;

    *columns = NULL;
    if (!c)
        return QDOT_ENOMEM;
    c->residual = r;
    c->n = n;
    c->weight = qdot_calloc(r->n_weights + 1, sizeof *c->weight);
    c->in = qdot_calloc(block * (2 * n + 1), sizeof *c->in);
    c->x = qdot_calloc(block * r->functions + 1, sizeof *c->x);
    c->back = qdot_calloc(block * (2 * n + 2 + r->functions), sizeof *c->back);
    c->column = qdot_calloc(block * n, sizeof *c->column);
    c->work = qdot_calloc(block * (along > adjoint ? along : adjoint) + 1, sizeof *c->work);
    if (!c->weight || !c->in || !c->x || !c->back || !c->column || !c->work)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK && shaken)
        status = qdot_tape_shake(r->along, &c->along);
    if (status == QDOT_OK && shaken)
        status = qdot_tape_shake(r->adjoint, &c->adjoint);
    if (status != QDOT_OK) {
        qdot_mass_columns_free(c);
        return status;
    }
    for (size_t w = 0; w < r->n_weights; w++)
        c->weight[w] = shaken ? qdot_shake_double(r->weights[w].w, r->weights[w].side) : r->weights[w].w;
    *columns = c;
    return QDOT_OK;
}

void
qdot_mass_columns_free(qdot_mass_columns *c)
{
    if (!c)
        return;
    qdot_tape_free(c->along);
    qdot_tape_free(c->adjoint);
    qdot_free(c->weight);
    qdot_free(c->in);
    qdot_free(c->x);
    qdot_free(c->back);
    qdot_free(c->column);
    qdot_free(c->work);
    qdot_free(c);
}

/* Columns first ... first + count - 1, into c->column, row by row. */
static void
evaluate_columns(qdot_mass_columns *c, double t, const double *y, size_t first, size_t count)
{
    const qdot_residual *r = c->residual;
    const size_t n = c->n, own = 2 * n + 1, inputs = own + r->functions + 1;

    for (size_t k = 0; k < count; k++) {
        double *in = c->in + k * own;

        memcpy(in, y, n * sizeof *in);
        memset(in + n, 0, n * sizeof *in);
        in[n + first + k] = 1;
        in[2 * n] = t;
    }
    qdot_tape_eval_rows(c->along ? c->along : r->along, count, c->in, c->x, c->work);
    for (size_t k = 0; k < count; k++) {
        double *back = c->back + k * inputs;

        memcpy(back, y, 2 * n * sizeof *back);
        back[2 * n] = t;
        qdot_residual_forces(r, c->weight, c->x + k * r->functions, back + own);
        back[inputs - 1] = 0; /* without the forces of V */
    }
    qdot_tape_eval_rows(c->adjoint ? c->adjoint : r->adjoint, count, c->back, c->column, c->work);
}

void
qdot_mass_columns_evaluate(qdot_mass_columns *c, double t, const double *y, double *M)
{
    const size_t n = c->n;

    for (size_t first = 0; first < n; first += block) {
        const size_t count = n - first < block ? n - first : block;

        evaluate_columns(c, t, y, first, count);
        for (size_t i = first; i < n; i++)
            for (size_t k = 0; k < count; k++)
                M[i * n + first + k] = c->column[k * n + i];
    }
}
