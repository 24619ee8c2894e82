/* first-order-results.c -- what the elimination gave, as the symbols of a scene, their values and changes. */
#include "mech/linear/first-order.h"
#include "mech/linear/first-order-parts.h"

#include <math.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "mech/scene/scene.h"

/* Whether an acceleration is not 0; in numbers, beyond the rounding of a place that was found to 15 digits. */
static bool
is_moving(const qdot_first_order_job *j, qdot_expr acceleration)
{
    return !qdot_elimination_is_zero(&j->v.x, acceleration) &&
           (!j->v.x.numbers || fabs(fmpq_get_d(qdot_expr_rational(j->pool, acceleration))) > 1e-10);
}

/* The value of a symbol at the state; itself where it has none. */
static qdot_expr
value_of_symbol(const qdot_first_order_job *j, qdot_expr symbol)
{
    for (size_t i = 0; i < j->v.symbols.n; i++)
        if (j->v.symbols.at[i] == symbol)
            return j->v.values.at[i];
    return symbol;
}

/* The column of the results, (state, first-order unknowns, inputs), that column a of the changes is. */
static size_t
column_of_results(const qdot_first_order_job *j, size_t a)
{
    const size_t motion = j->y + j->z, m = j->s->inputs.n, s = j->s->states.n;

    return a < motion ? a : a < motion + m ? a + s : a - m;
}

/* Write the speeds and their rates: rows 3 n + c + inputs ... of the results. */
static qdot_status
write_speeds(qdot_first_order_job *j, qdot_first_order *out)
{
    const size_t m = j->speeds->n, columns = out->states + out->inputs, first = 3 * j->n + j->c + out->inputs;
    qdot_expr *value = qdot_first_order_new(2 * m);
    qdot_status status = value == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t k = 0; k < m && status == QDOT_OK; k++) {
        value[2 * k] = j->speeds->value[k];
        value[2 * k + 1] = qdot_scene_with_rates(j->s, qdot_ddt(j->pool, j->speeds->value[k]));
        status = qdot_pool_check(j->pool);
    }
    if (status == QDOT_OK)
        status = qdot_state_values_of(&j->v, 2 * m, value);
    for (size_t k = 0; k < 2 * m && status == QDOT_OK; k++) {
        qdot_expr *own = out->change + (first + k) * columns;

        out->symbol[first + k] = qdot_symbol_jet(j->pool, j->speeds->symbol[k / 2], k % 2);
        out->value[first + k] = value[k];
        if (k % 2 == 0)
            own[j->y + k / 2] = QDOT_ONE;
        for (size_t a = 0; a < j->y + j->z + j->inputs && k % 2 == 1; a++)
            own[column_of_results(j, a)] = j->rates[k / 2 * j->width + a];
    }
    qdot_free(value);
    return status == QDOT_OK ? qdot_pool_check(j->pool) : status;
}

/* Write the first-order unknowns and their rates, the last rows of the results. */
static qdot_status
write_first_order_unknowns(qdot_first_order_job *j, qdot_first_order *out)
{
    const qdot_scene *s = j->s;
    const size_t moving = 2 * j->n + j->inputs, columns = out->states + out->inputs, first = out->n - 2 * s->states.n;
    qdot_expr *slope = qdot_first_order_new(moving + 1);
    qdot_status status = slope == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t k = 0; k < s->states.n && status == QDOT_OK; k++) {
        const qdot_state *z = &s->states.at[k];
        qdot_expr *own = out->change + (first + 2 * k) * columns, *rate = own + columns;

        qdot_first_order_slopes(j, z->rate, slope);
        slope[moving] = z->rate;
        status = qdot_pool_check(j->pool);
        if (status == QDOT_OK)
            status = qdot_state_values_of(&j->v, moving + 1, slope);
        for (size_t a = 0; a < j->y + j->z + j->inputs && status == QDOT_OK; a++)
            rate[column_of_results(j, a)] = qdot_first_order_change(j, slope, a);
        out->symbol[first + 2 * k] = z->z;
        out->symbol[first + 2 * k + 1] = qdot_symbol_jet(j->pool, z->z, 1);
        out->value[first + 2 * k] = value_of_symbol(j, z->z);
        out->value[first + 2 * k + 1] = slope[moving];
        own[j->y + j->z + k] = QDOT_ONE;
        out->moves |= is_moving(j, slope[moving]);
    }
    qdot_free(slope);
    return status == QDOT_OK ? qdot_pool_check(j->pool) : status;
}

qdot_status
qdot_first_order_write(qdot_first_order_job *j, qdot_first_order *out)
{
    const size_t n = j->n, m = j->s->inputs.n, inner = j->y + j->z + j->inputs;
    size_t at = 0, speeds = j->speeds == NULL ? 0 : j->speeds->n, columns;

    out->states = j->y + j->z + j->s->states.n;
    out->inputs = m;
    columns = out->states + m;
    out->n = 3 * n + j->c + m + 2 * speeds + 2 * j->s->states.n;
    out->state = qdot_first_order_new(out->states);
    out->symbol = qdot_first_order_new(2 * out->n);
    out->change = qdot_first_order_new(out->n * columns);
    if (out->state == NULL || out->symbol == NULL || out->change == NULL)
        return QDOT_ENOMEM;
    out->value = out->symbol + out->n;
    for (int order = 0; order < 2; order++)
        for (size_t i = 0; i < n; i++)
            if (!qdot_echelon_leads(&j->level[order], i))
                out->state[at++] = qdot_first_order_jet(j, i, (uint32_t)order);
    for (size_t k = 0; k < speeds; k++)
        out->state[j->y + k] = j->speeds->symbol[k];
    for (size_t k = 0; k < j->s->states.n; k++)
        out->state[at++] = j->s->states.at[k].z;
    for (size_t i = 0; i < 3 * n + j->c + m; i++) {
        const qdot_expr *row = i < 3 * n ? j->change[i / n] + i % n * j->width
                               : i < 3 * n + j->c ? j->lambda + (i - 3 * n) * j->width : NULL;

        out->symbol[i] = i < 3 * n          ? qdot_first_order_jet(j, i % n, (uint32_t)(i / n))
                         : i < 3 * n + j->c ? j->s->constraints.at[i - 3 * n].multiplier
                                            : j->s->inputs.at[i - 3 * n - j->c];
        out->value[i] = value_of_symbol(j, out->symbol[i]);
        for (size_t a = 0; a < inner && row != NULL; a++)
            out->change[i * columns + column_of_results(j, a)] = row[a];
        if (row == NULL)
            out->change[i * columns + out->states + i - 3 * n - j->c] = QDOT_ONE;
        out->moves |= i >= 2 * n && i < 3 * n && is_moving(j, out->value[i]);
    }
    if (speeds > 0)
        QDOT_TRY(write_speeds(j, out));
    return write_first_order_unknowns(j, out);
}
