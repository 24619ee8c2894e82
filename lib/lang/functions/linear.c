/* linear.c -- the linear motion of a scene near a state. */
#include "lang/functions/linear.h"

#include <math.h>

#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/phase.h"
#include "mech/linear/first-order.h"
#include "mech/linear/state-values.h"
#include "normal/simplify/simplify.h"

static qdot_expr
insert_values_of_session(void *session, qdot_expr e)
{
    return qdot_session_bind(session, qdot_measured_as_rationals(session, e));
}

/* Linearise with value k displaced by its error; k past the end: none. */
static qdot_status
linearise_displaced(qdot_session *session, const qdot_linear_place *place, bool numbers, size_t k, qdot_first_order *out)
{
    qdot_pool *pool = session->pool;
    qdot_first_order_request request = {.numbers = numbers, .bind = insert_values_of_session, .user = session,
                                        .speeds = place->speeds};
    qdot_expr *equations = qdot_calloc(place->n + 1, sizeof *equations);
    qdot_status status = equations == NULL ? QDOT_ENOMEM : QDOT_OK;

    for (size_t i = 0; i < place->n && status == QDOT_OK; i++)
        equations[i] = qdot_rel(pool, QDOT_EQ, place->symbols[i],
                                i != k ? place->values[i]
                                       : qdot_add(pool, place->values[i], qdot_expr_of_double(pool, place->errors[i])));
    if (status == QDOT_OK) {
        request.place = qdot_list(pool, (uint32_t)place->n, equations);
        status = qdot_pool_check(pool);
    }
    if (status == QDOT_OK)
        status = qdot_first_order_about(session->scene, &request, out);
    qdot_free(equations);
    return status;
}

/* Add to error [m] how far the changes of x are moved by the errors of the values. */
static qdot_status
find_errors(qdot_session *session, const qdot_linear_place *place, const qdot_first_order *x, size_t m, double *error)
{
    for (size_t k = 0; k < place->n; k++) {
        qdot_first_order y = {0};
        qdot_status status = QDOT_OK;

        if (place->errors[k] == 0)
            continue;
        if (isnan(place->errors[k]))
            for (size_t i = 0; i < m; i++)
                error[i] = NAN;
        else
            status = linearise_displaced(session, place, true, k, &y);
        for (size_t i = 0; i < m && y.change != NULL; i++)
            error[i] += fabs(fmpq_get_d(qdot_expr_rational(session->pool, y.change[i])) -
                             fmpq_get_d(qdot_expr_rational(session->pool, x->change[i])));
        qdot_first_order_clear(&y);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

/* A number as it is kept: a short rational is exact; another one is a double with its error. */
static qdot_expr
number_with_error(qdot_session *session, qdot_expr e, double error)
{
    const fmpq *x = qdot_expr_rational(session->pool, e);
    double value;

    if (error == 0 && fmpz_bits(fmpq_numref(x)) <= 64 && fmpz_bits(fmpq_denref(x)) <= 64)
        return e;
    value = fmpq_get_d(x);
    return qdot_measured_new(session, value, error + 2.3e-16 * fabs(value));
}

static qdot_status
give_numbers(qdot_session *session, const qdot_linear_place *place, qdot_first_order *x)
{
    const size_t m = x->n * (x->states + x->inputs);
    double *error = qdot_calloc(m + 1, sizeof *error);
    qdot_status status = error == NULL ? QDOT_ENOMEM : QDOT_OK;

    if (status == QDOT_OK && place->errors != NULL)
        status = find_errors(session, place, x, m, error);
    for (size_t i = 0; i < m && status == QDOT_OK; i++)
        x->change[i] = number_with_error(session, x->change[i], error[i]);
    qdot_free(error);
    return status == QDOT_OK ? qdot_pool_check(session->pool) : status;
}

/* The row of a symbol in the changes; NULL: it does not move. */
static const qdot_expr *
row_of_symbol(const qdot_first_order *x, qdot_expr symbol)
{
    for (size_t i = 0; i < x->n; i++)
        if (x->symbol[i] == symbol)
            return x->change + i * (x->states + x->inputs);
    return NULL;
}

/* Write A and B: the rate of a coordinate is its velocity, that of a velocity its acceleration. */
static qdot_status
write_matrices(qdot_session *session, const qdot_first_order *x, qdot_linear *out)
{
    qdot_pool *pool = session->pool;
    const size_t n = x->states, m = x->inputs;
    qdot_expr *A = qdot_calloc(n * (n + m) + 1, sizeof *A), *B = A == NULL ? NULL : A + n * n;

    if (A == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        const qdot_expr *row = row_of_symbol(x, qdot_symbol_jet(pool, x->state[i], 1));

        for (size_t k = 0; k < n + m; k++)
            *(k < n ? &A[i * n + k] : &B[i * m + k - n]) = row[k];
    }
    out->A = n > 0 ? qdot_matrix(pool, (uint32_t)n, (uint32_t)n, A) : QDOT_NIL;
    out->B = n > 0 && m > 0 ? qdot_matrix(pool, (uint32_t)n, (uint32_t)m, B) : QDOT_NIL;
    out->states = qdot_list(pool, (uint32_t)n, x->state);
    out->inputs = qdot_list(pool, (uint32_t)m, session->scene->inputs.at);
    out->symbols = qdot_list(pool, (uint32_t)x->n, x->symbol);
    out->values = qdot_list(pool, (uint32_t)x->n, x->value);
    out->change = qdot_list(pool, (uint32_t)(x->n * (n + m)), x->change);
    qdot_free(A);
    return qdot_pool_check(pool);
}

/* The slopes of e along all that moves, at the state; slope [n]. */
static qdot_status
find_slopes(qdot_session *session, const qdot_linear *linear, qdot_expr e, uint32_t n, qdot_expr *slope)
{
    qdot_pool *pool = session->pool;
    qdot_state_values v;
    qdot_status status = QDOT_OK;

    qdot_state_values_begin(&v, session->scene, linear->numbers != 0, insert_values_of_session, session);
    for (uint32_t i = 0; i < n && status == QDOT_OK; i++)
        status = qdot_state_values_put(&v, qdot_expr_arg(pool, linear->symbols, i), qdot_expr_arg(pool, linear->values, i));
    for (uint32_t i = 0; i < n; i++)
        slope[i] = qdot_diff(pool, e, qdot_expr_arg(pool, linear->symbols, i));
    if (status == QDOT_OK)
        status = qdot_state_values_of(&v, n, slope);
    qdot_state_values_end(&v);
    return status;
}

qdot_status
qdot_linear_row(qdot_session *session, const qdot_linear *linear, qdot_expr e, qdot_expr *row)
{
    qdot_pool *pool = session->pool;
    const qdot_facts facts = qdot_scene_facts(session->scene);
    const uint32_t n = qdot_expr_count(pool, linear->symbols), columns = n == 0 ? 0 : qdot_expr_count(pool, linear->change) / n;
    qdot_expr *slope = qdot_calloc((size_t)n + 1, sizeof *slope);
    qdot_status status = slope == NULL ? QDOT_ENOMEM : find_slopes(session, linear, e, n, slope);

    for (uint32_t k = 0; k < columns && status == QDOT_OK; k++) {
        row[k] = QDOT_ZERO;
        for (uint32_t i = 0; i < n; i++)
            if (slope[i] != QDOT_ZERO)
                row[k] = qdot_add(pool, row[k], qdot_mul(pool, slope[i], qdot_expr_arg(pool, linear->change, i * columns + k)));
        row[k] = qdot_simplify(pool, row[k], &facts);
    }
    qdot_free(slope);
    return status == QDOT_OK ? qdot_pool_check(pool) : status;
}

/* C and D: the slopes of the outputs. */
static qdot_status
write_output_matrices(qdot_session *session, qdot_linear *out)
{
    const qdot_scene *scene = session->scene;
    qdot_pool *pool = session->pool;
    const size_t p = scene->outputs.n, n = qdot_expr_count(pool, out->states), m = qdot_expr_count(pool, out->inputs);
    qdot_expr *rows = qdot_calloc(2 * p * (n + m) + 1, sizeof *rows), *C, *D;
    qdot_status status = rows == NULL ? QDOT_ENOMEM : QDOT_OK;

    if (status != QDOT_OK)
        return status;
    C = rows + p * (n + m);
    D = C + p * n;
    for (size_t i = 0; i < p && status == QDOT_OK; i++) {
        status = qdot_linear_row(session, out, scene->outputs.at[i], rows + i * (n + m));
        for (size_t k = 0; k < n + m && status == QDOT_OK; k++)
            *(k < n ? &C[i * n + k] : &D[i * m + k - n]) = rows[i * (n + m) + k];
    }
    if (status == QDOT_OK && p > 0) {
        out->outputs = qdot_list(pool, (uint32_t)p, scene->outputs.at);
        out->C = n > 0 ? qdot_matrix(pool, (uint32_t)p, (uint32_t)n, C) : QDOT_NIL;
        out->D = m > 0 ? qdot_matrix(pool, (uint32_t)p, (uint32_t)m, D) : QDOT_NIL;
        status = qdot_pool_check(pool);
    }
    qdot_free(rows);
    return status;
}

qdot_status
qdot_linear_find(qdot_session *session, const qdot_linear_place *place, bool *moves)
{
    qdot_linear found = {.numbers = place->numbers};
    qdot_first_order x = {0};
    qdot_status status = QDOT_ELIMIT;

    if (!place->numbers)
        status = linearise_displaced(session, place, false, place->n, &x);
    if (status == QDOT_ELIMIT) {
        found.numbers = 1;
        status = linearise_displaced(session, place, true, place->n, &x);
        if (status == QDOT_OK)
            status = give_numbers(session, place, &x);
    }
    if (status == QDOT_OK)
        status = write_matrices(session, &x, &found);
    *moves = x.moves;
    qdot_first_order_clear(&x);
    if (status == QDOT_OK)
        status = write_output_matrices(session, &found);
    found.version = qdot_phase_version(session);
    if (status == QDOT_OK)
        session->history->linear = found;
    return status;
}

qdot_status
qdot_linear_latest(qdot_session *session, const qdot_linear **linear)
{
    *linear = &session->history->linear;
    if ((*linear)->states == QDOT_NIL)
        (void)qdot_fail(QDOT_EINVAL, "there is no linear motion yet");
    else if ((*linear)->version != qdot_phase_version(session))
        (void)qdot_fail(QDOT_EINVAL, "the scene has changed since the latest `linearize`");
    else
        return QDOT_OK;
    return qdot_hint("linearize at equilibria[1]");
}
