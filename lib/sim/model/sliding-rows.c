/* sliding-rows.c -- moves states back onto the surfaces along which the motion slides. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "sim/model/puck.h"
#include "sim/model/sliding.h"
#include "sim/model/switch.h"

/* Most passes of Kaczmarz's method over the conditions; one suffices if linear ones share no coordinate. */
enum { MOST_SWEEPS = 100 };

void
qdot_sliding_rows_clear(qdot_sliding_rows *rows)
{
    qdot_free(rows->order);
    qdot_free(rows->surface);
    qdot_tape_free(rows->tape);
    *rows = (qdot_sliding_rows){0};
}

/* Append a condition to out [rows x (1 + n)]: the value of its function, and its derivatives. */
static void
append_condition(const qdot_plan *p, qdot_sliding_rows *rows, int order, qdot_expr h, qdot_expr *values,
                 qdot_expr *slopes)
{
    const size_t r = rows->rows++;

    rows->order[r] = order;
    values[r] = h;
    for (size_t i = 0; i < p->n; i++)
        slopes[r * p->n + i] = i < p->n - p->n_states
                                   ? qdot_diff(p->pool, h, p->inputs[(size_t)order * p->n + i])
                                   : QDOT_ZERO;
}

qdot_status
qdot_sliding_rows_make(const qdot_plan *p, const qdot_switches *s, const int64_t *side,
                       const qdot_expr *u, qdot_sliding_rows *rows)
{
    const size_t surfaces = s->surfaces.n, most = 2 * surfaces + s->n_puck_symbols;
    qdot_expr *out = qdot_calloc(most * (1 + p->n) + 1, sizeof *out);
    qdot_status status;

    rows->order = qdot_calloc(most + 1, sizeof *rows->order);
    rows->surface = qdot_calloc(most + 2, sizeof *rows->surface);
    if (!out || !rows->order || !rows->surface) {
        qdot_free(out);
        return QDOT_ENOMEM;
    }
    for (size_t i = 0; i < surfaces; i++) {
        const bool velocity =
            u[i] != QDOT_NIL && (qdot_expr_node(p->pool, u[i])->holds & QDOT_HAS_VELOCITY) != 0;

        const qdot_puck *puck = qdot_puck_of(s, i);

        if (side[i] != QDOT_SIDE_SLIDES)
            continue;
        for (size_t c = 0; puck && c < puck->k; c++) {
            rows->surface[rows->rows] = i;
            append_condition(p, rows, 1, puck->rest[c], out, out + most);
        }
        if (puck)
            continue;
        rows->surface[rows->rows] = i;
        rows->surface[rows->rows + 1] = i;
        append_condition(p, rows, velocity, u[i], out, out + most);
        if (!velocity)
            append_condition(p, rows, 1, qdot_ddt(p->pool, u[i]), out, out + most);
    }
    memmove(out + rows->rows, out + most, rows->rows * p->n * sizeof *out);
    status = qdot_pool_check(p->pool);
    if (status == QDOT_OK && rows->rows > 0)
        status = qdot_tape_new(p->pool, 2 * p->n + 1, p->inputs, rows->rows * (1 + p->n), out,
                               &rows->tape);
    qdot_free(out);
    return status;
}

qdot_status
qdot_sliding_rows_value(const qdot_sliding_rows *rows, size_t n, double t, const double *y,
                        size_t surface, int order, double *value, double *slopes)
{
    const size_t outputs = rows->rows * (1 + n);
    double *in = qdot_calloc(2 * n + 1 + outputs + qdot_tape_work(rows->tape) + 1, sizeof *in);
    double *out = in + 2 * n + 1;

    *value = 0;
    if (slopes)
        memset(slopes, 0, n * sizeof *slopes);
    if (!in)
        return QDOT_ENOMEM;
    memcpy(in, y, 2 * n * sizeof *y);
    in[2 * n] = t;
    qdot_tape_eval(rows->tape, in, out, out + outputs);
    for (size_t r = 0; r < rows->rows; r++) {
        if (rows->surface[r] != surface || rows->order[r] != order)
            continue;
        *value = out[r];
        if (slopes)
            memcpy(slopes, out + rows->rows + r * n, n * sizeof *slopes);
    }
    qdot_free(in);
    return QDOT_OK;
}

/* Move y along the gradient of row r towards the zero of the row, by one Newton step. Returns
 * whether y changed. */
static bool
correct_by_condition(const qdot_sliding_rows *rows, size_t n, size_t r, const double *out, double *y)
{
    const double *slope = out + rows->rows + r * n;
    double *x = y + (size_t)rows->order[r] * n, square = 0;
    bool moves = false;

    for (size_t i = 0; i < n; i++)
        square += slope[i] * slope[i];
    for (size_t i = 0; i < n && out[r] != 0; i++) {
        const double before = x[i];

        x[i] -= out[r] / square * slope[i];
        if (fabs(x[i]) < DBL_MIN) /* flush subnormal numbers to 0: repeated corrections would lose their digits */
            x[i] = 0;
        moves = moves || x[i] != before;
    }
    return moves;
}

qdot_status
qdot_sliding_rows_keep(const qdot_sliding_rows *rows, size_t n, double t, double *y,
                       double *moved)
{
    const size_t outputs = rows->rows * (1 + n);
    bool moves = true;
    double *in, *out;

    *moved = 0;
    if (rows->rows == 0)
        return QDOT_OK;
    in = qdot_calloc(2 * n + 1 + outputs + qdot_tape_work(rows->tape) + 1, sizeof *in);
    if (!in)
        return QDOT_ENOMEM;
    out = in + 2 * n + 1;
    memcpy(in, y, 2 * n * sizeof *y);
    in[2 * n] = t;
    for (size_t sweep = 0; sweep < MOST_SWEEPS && moves; sweep++) {
        moves = false;
        for (size_t r = 0; r < rows->rows; r++) {
            qdot_tape_eval(rows->tape, in, out, out + outputs);
            moves = correct_by_condition(rows, n, r, out, in) || moves;
        }
    }
    for (size_t i = 0; i < 2 * n; i++) {
        const double by = fabs(in[i] - y[i]) / fmax(1, fabs(y[i]));

        *moved = by <= *moved ? *moved : isfinite(by) ? by : INFINITY;
        y[i] = isfinite(in[i]) ? in[i] : y[i];
    }
    qdot_free(in);
    return QDOT_OK;
}
