/* undone.c -- inverts an event: solves the equations of its `then` for the values before it. */
#include "sim/model/undone.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/field/normal-form.h"
#include "normal/solve/linear.h"
#include "sim/model/substitute.h"

/* The unknowns: symbols for the values that an event's targets had before the event. */
typedef struct {
    qdot_pool *pool;
    size_t n;
    const qdot_expr *targets;
    qdot_expr *unknown; /* [n] symbols for the values before the event */
    qdot_expr *after;   /* [n] values after the event, in terms of `unknown` */
    qdot_expr *before;  /* [n] the solution: values before the event; nil: not found yet */
    qdot_expr f;        /* the event's function in terms of the unknowns; it was 0 before the event */
    bool forgot;        /* f = 0 was used to determine one of the unknowns */
    qdot_expr image;    /* an expression that is 0 at every state after the event */
} undoing;

static bool
undone_holds_unknown(const undoing *x, qdot_expr e)
{
    for (size_t i = 0; i < x->n; i++)
        if (x->before[i] == QDOT_NIL && qdot_expr_contains(x->pool, e, x->unknown[i]))
            return true;
    return false;
}

/* Write a linear equation as row [m] of coefficients of the unknowns `of` [m] and a rest; returns
 * whether it is linear. */
static bool
is_linear_system(const undoing *x, qdot_expr e, size_t m, const size_t *of, qdot_expr *row, qdot_expr *rest)
{
    qdot_pool *pool = x->pool;
    qdot_expr sum = QDOT_ZERO;

    *rest = e;
    for (size_t j = 0; j < m; j++) {
        const qdot_expr z = x->unknown[of[j]], zero = QDOT_ZERO;

        row[j] = qdot_normal(pool, qdot_diff(pool, e, z), NULL);
        if (row[j] == QDOT_NIL || undone_holds_unknown(x, row[j]))
            return false;
        *rest = qdot_substitute(pool, *rest, 1, &z, &zero);
        sum = qdot_add(pool, sum, qdot_mul(pool, row[j], z));
    }
    return *rest != QDOT_NIL && !undone_holds_unknown(x, *rest)
           && qdot_normal(pool, qdot_sub(pool, qdot_sub(pool, e, *rest), sum), NULL) == QDOT_ZERO;
}

/* Insert the values before the event that are known already into the other equations. */
static void
insert_known_values(undoing *x)
{
    for (size_t k = 0; k < x->n; k++) {
        if (x->before[k] == QDOT_NIL)
            continue;
        for (size_t i = 0; i < x->n; i++)
            x->after[i] = qdot_substitute(x->pool, x->after[i], 1, &x->unknown[k], &x->before[k]);
        x->f = qdot_substitute(x->pool, x->f, 1, &x->unknown[k], &x->before[k]);
        if (x->image != QDOT_NIL)
            x->image = qdot_substitute(x->pool, x->image, 1, &x->unknown[k], &x->before[k]);
    }
}

/* Solve the m equations with indices `of` for the unknowns of the same indices; *found: unique linear solution. */
static qdot_status
solve_for_values_before(undoing *x, size_t m, const size_t *of, bool *found)
{
    qdot_expr *A = qdot_calloc(m * m + 2 * m + 1, sizeof *A), *b = A + m * m, *out = b + m;
    uint32_t pivot;
    qdot_status status;

    *found = false;
    if (!A)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < m; i++) {
        qdot_expr rest;

        if (!is_linear_system(x, x->after[of[i]], m, of, A + i * m, &rest)) {
            qdot_free(A);
            return qdot_grave(qdot_pool_check(x->pool));
        }
        b[i] = qdot_sub(x->pool, x->targets[of[i]], rest);
    }
    status = qdot_solve_linear(x->pool, (uint32_t)m, A, b, out, &pivot, NULL);
    *found = status == QDOT_OK;
    for (size_t i = 0; i < m && *found; i++)
        x->before[of[i]] = out[i];
    qdot_free(A);
    return qdot_grave(status);
}

/* List the targets whose values before the event are still unknown but occur in the equations;
 * returns their number. */
static size_t
list_unknown_values(const undoing *x, size_t *open)
{
    size_t m = 0;

    for (size_t i = 0; i < x->n; i++)
        if (x->before[i] == QDOT_NIL)
            open[m++] = i;
    return m;
}

/* Find a value that no equation of `then` contains from the event's own equation f = 0, if it is
 * linear in that value. */
static qdot_status
find_lost_value(undoing *x)
{
    for (size_t k = 0; k < x->n && !x->forgot; k++) {
        const bool read = x->before[k] != QDOT_NIL || !qdot_expr_contains(x->pool, x->f, x->unknown[k]) ||
                          qdot_expr_is_in_any(x->pool, x->unknown[k], x->n, x->after);
        qdot_expr slope, rest, value;

        if (read || !is_linear_system(x, x->f, 1, &k, &slope, &rest) || slope == QDOT_ZERO)
            continue;
        value = qdot_normal(x->pool, qdot_neg(x->pool, qdot_div(x->pool, rest, slope)), NULL);
        QDOT_TRY(qdot_pool_check(x->pool));
        x->forgot = true;
        if (qdot_normal(x->pool, qdot_sub(x->pool, value, x->after[k]), NULL) == QDOT_ZERO) {
            /* y was 0 already when the event set it to 0: its value before the event is that after */
            x->before[k] = x->targets[k];
        } else {
            x->before[k] = value;
            x->image = qdot_sub(x->pool, x->targets[k], x->after[k]);
        }
        insert_known_values(x);
    }
    return qdot_pool_check(x->pool);
}

static qdot_status
find_values_before(undoing *x, size_t *open, qdot_undone *out)
{
    bool found = true;
    size_t m;

    QDOT_TRY(find_lost_value(x));
    while ((m = list_unknown_values(x, open)) > 0 && found) {
        QDOT_TRY(solve_for_values_before(x, m, open, &found));
        for (size_t i = 0; i < m && !found; i++)
            QDOT_TRY(solve_for_values_before(x, 1, open + i, &found));
        if (found)
            insert_known_values(x);
    }
    if (m > 0)
        out->why = "its `then` has no inverse";
    out->function = x->image != QDOT_NIL ? x->image : x->f;
    if (undone_holds_unknown(x, out->function))
        out->function = QDOT_NIL;
    memcpy(out->values, x->before, x->n * sizeof *out->values);
    return qdot_pool_check(x->pool);
}

/* Write the event's function f and its new values in terms of the unknown values before the event. */
static qdot_status
begin_inversion(undoing *x, qdot_expr f, const qdot_expr *values)
{
    char name[32];

    for (size_t i = 0; i < x->n; i++) {
        snprintf(name, sizeof name, "before %zu", i + 1);
        x->unknown[i] = qdot_symbol_get(x->pool, QDOT_FORMAL, name);
    }
    QDOT_TRY(qdot_pool_check(x->pool));
    for (size_t i = 0; i < x->n; i++)
        x->after[i] = qdot_substitute(x->pool, values[i], x->n, x->targets, x->unknown);
    x->f = qdot_substitute(x->pool, f, x->n, x->targets, x->unknown);
    return qdot_pool_check(x->pool);
}

qdot_status
qdot_undone_find(qdot_pool *pool, qdot_expr f, size_t n, const qdot_expr *targets, const qdot_expr *values,
                 qdot_undone *out)
{
    undoing x = {.pool = pool, .n = n, .targets = targets};
    size_t *open = qdot_calloc(n + 1, sizeof *open);
    qdot_status status;

    *out = (qdot_undone){.function = f};
    out->values = qdot_calloc(n + 1, sizeof *out->values);
    x.unknown = qdot_calloc(3 * n + 1, sizeof *x.unknown);
    status = open && out->values && x.unknown ? QDOT_OK : QDOT_ENOMEM;
    if (status == QDOT_OK) {
        x.after = x.unknown + n;
        x.before = x.after + n;
        status = begin_inversion(&x, f, values);
    }
    for (size_t i = 0; i < n && status == QDOT_OK; i++)
        if (qdot_expr_node(pool, values[i])->holds & (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER))
            out->why = "its `then` reads accelerations";
    if (status == QDOT_OK && out->why)
        out->function = undone_holds_unknown(&x, x.f) ? QDOT_NIL : f;
    else if (status == QDOT_OK)
        status = find_values_before(&x, open, out);
    qdot_free(open);
    qdot_free(x.unknown);
    if (status != QDOT_OK)
        qdot_undone_clear(out);
    return status;
}

void
qdot_undone_clear(qdot_undone *undone)
{
    qdot_free(undone->values);
    *undone = (qdot_undone){0};
}
