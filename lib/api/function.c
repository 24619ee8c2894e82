/* function.c -- expressions compiled for many values of their variables. */
#include <math.h>
#include <string.h>

#include "api/system.h"
#include "base/memory.h"
#include "expr/calculus.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/language/read.h"
#include "lang/session/bind.h"
#include "lang/session/measured.h"
#include "lang/session/member.h"
#include "lang/session/momenta.h"
#include "tape/rows.h"

struct qdot_function {
    qdot_system *system; /* its tables of data are read; this counts as one use of it */
    qdot_tape *tape;
};

typedef qdot_vec(qdot_expr) expressions;

/* --- variables --------------------------------------------------------------------------- */

/* Read one variable: a name, a velocity, t, or the momentum p[q]. */
static qdot_status
read_variable(qdot_cursor *c, qdot_expr *symbol)
{
    const size_t start = c->at->start;
    const bool momentum = qdot_cursor_is_word(c, "p") && qdot_token_is(c->at + 1, "[");
    qdot_pool *pool = c->session->pool;

    c->at += momentum ? 2 : 0;
    QDOT_TRY(qdot_read_scalar(c, symbol));
    c->error_at = start;
    if (qdot_expr_kind(pool, *symbol) != QDOT_SYM || qdot_measured_occurs(c->session, *symbol) ||
        qdot_member_any(c->session, *symbol)) {
        (void)qdot_fail(QDOT_ETYPE, "this is no variable");
        return qdot_hint("coordinates, velocities theta', parameters, momenta p[theta] and t are");
    }
    if (!momentum)
        return QDOT_OK;
    *symbol = qdot_symbol_of(pool, QDOT_MOMENTUM, *symbol);
    return qdot_cursor_expect_op(c, "]");
}

static qdot_status
read_variables(qdot_cursor *c, void *data)
{
    expressions *variables = data;

    while (!qdot_cursor_is_end(c)) {
        const size_t start = c->at->start;
        qdot_expr symbol;

        QDOT_TRY(read_variable(c, &symbol));
        for (size_t i = 0; i < variables->n; i++)
            if (variables->at[i] == symbol) {
                c->error_at = start;
                return qdot_fail(QDOT_EINVAL, "this variable is given twice");
            }
        QDOT_TRY(qdot_vec_push(variables, symbol));
        if (!qdot_cursor_accept_op(c, ","))
            return QDOT_OK;
    }
    return QDOT_OK;
}

/* --- expressions --------------------------------------------------------------------------- */

typedef struct {
    expressions variables, inputs; /* the variables; what stands for them on the tape */
    qdot_tape *tape;
} compilation;

/* Append the scalars of which a value is made: the components of vectors, entries of matrices, members of lists. */
static qdot_status
flatten(qdot_session *session, qdot_expr value, expressions *scalars)
{
    const qdot_kind kind = qdot_expr_kind(session->pool, value);

    if (kind != QDOT_LIST && kind != QDOT_VEC && kind != QDOT_MAT) {
        if (!qdot_expr_is_scalar(session->pool, value))
            return qdot_fail(QDOT_ETYPE, "only numbers can be computed for many values, not equations");
        return qdot_vec_push(scalars, value);
    }
    for (uint32_t i = 0; i < qdot_expr_count(session->pool, value); i++)
        QDOT_TRY(flatten(session, qdot_expr_arg(session->pool, value, i), scalars));
    return QDOT_OK;
}

/* A variable that has a value in the session, which does not count here, is another symbol on the tape. */
static qdot_status
choose_inputs(qdot_session *session, compilation *x)
{
    for (size_t i = 0; i < x->variables.n; i++) {
        const qdot_expr v = x->variables.at[i];
        qdot_expr input = v;
        char name[40];

        snprintf(name, sizeof name, "input#%zu", i);
        if (qdot_expr_is_class(session->pool, v, QDOT_PARAM) || qdot_expr_is_class(session->pool, v, QDOT_MOMENTUM))
            input = qdot_symbol_get(session->pool, QDOT_FORMAL, name);
        QDOT_TRY(qdot_vec_push(&x->inputs, input));
    }
    return qdot_pool_check(session->pool);
}

/* Whether one of the variables is a momentum: then momenta in the expressions are variables, else those that velocities give. */
static bool
has_momentum(const qdot_session *session, const expressions *variables)
{
    for (size_t i = 0; i < variables->n; i++)
        if (qdot_expr_is_class(session->pool, variables->at[i], QDOT_MOMENTUM))
            return true;
    return false;
}

static qdot_status
lower(qdot_session *session, compilation *x, expressions *scalars)
{
    qdot_pool *pool = session->pool;
    const bool momentum = has_momentum(session, &x->variables);
    qdot_status status;

    QDOT_TRY(choose_inputs(session, x));
    for (size_t i = 0; i < scalars->n; i++) {
        qdot_expr e = scalars->at[i];

        QDOT_TRY(qdot_member_refuse(session, e));
        e = qdot_measured_as_rationals(session, e);
        e = momentum ? e : qdot_momenta_to_velocities(session, e);
        e = qdot_subs(pool, e, x->variables.n, x->variables.at, x->inputs.at);
        scalars->at[i] = qdot_session_bind(session, e);
        QDOT_TRY(qdot_pool_check(pool));
    }
    status = qdot_tape_new(pool, x->inputs.n, x->inputs.at, scalars->n, scalars->at, &x->tape);
    if (status == QDOT_EUNSET)
        return qdot_hint("make it one of the variables; a parameter may get a value by `set`, too");
    return status;
}

static qdot_status
read_expressions(qdot_cursor *c, void *data)
{
    const size_t start = c->at->start;
    expressions scalars = {0};
    qdot_status status = QDOT_OK;
    qdot_expr value;

    do {
        status = qdot_read_value(c, &value);
        if (status == QDOT_OK) {
            c->error_at = start;
            status = flatten(c->session, value, &scalars);
        }
    } while (status == QDOT_OK && qdot_cursor_accept_op(c, ","));
    if (status == QDOT_OK)
        status = qdot_cursor_expect_end(c);
    if (status == QDOT_OK) {
        c->error_at = start;
        status = lower(c->session, data, &scalars);
    }
    qdot_free(scalars.at);
    return status;
}

/* --- functions ----------------------------------------------------------------------------- */

qdot_result
qdot_system_compile(qdot_system *system, const char *text, const char *variables, qdot_function **function)
{
    compilation x = {0};
    qdot_function *f = NULL;
    qdot_status status;

    if (function != NULL)
        *function = NULL;
    if (system == NULL)
        return QDOT_RESULT_INVALID;
    if (text == NULL || variables == NULL || function == NULL)
        return qdot_api_refuse(system, "compile: the %s NULL",
                               text == NULL        ? "expressions are"
                               : variables == NULL ? "variables are"
                                                   : "function is");
    status = qdot_api_begin(system);
    if (status == QDOT_OK)
        status = qdot_api_read(system, "variables", variables, read_variables, &x.variables);
    if (status == QDOT_OK)
        status = qdot_api_read(system, "compile", text, read_expressions, &x);
    if (status == QDOT_OK) {
        f = qdot_malloc(sizeof *f);
        status = f != NULL ? QDOT_OK : qdot_fail(QDOT_ENOMEM, "out of memory");
    }
    if (f != NULL) {
        *f = (qdot_function){system, x.tape};
        system->uses++;
        *function = f;
    } else {
        qdot_tape_free(x.tape);
    }
    qdot_free(x.variables.at);
    qdot_free(x.inputs.at);
    return qdot_api_end(system, status);
}

void
qdot_function_free(qdot_function *function)
{
    if (function == NULL)
        return;
    qdot_tape_free(function->tape);
    qdot_api_release(function->system);
    qdot_free(function);
}

size_t
qdot_function_inputs(const qdot_function *function)
{
    return function != NULL ? qdot_tape_inputs(function->tape) : 0;
}

size_t
qdot_function_outputs(const qdot_function *function)
{
    return function != NULL ? qdot_tape_outputs(function->tape) : 0;
}

qdot_result
qdot_function_values(const qdot_function *function, size_t n, const double *inputs, double *outputs)
{
    const qdot_tape *tape;
    double *work;

    if (function == NULL)
        return QDOT_RESULT_INVALID;
    tape = function->tape;
    if (n > 0 && (outputs == NULL || (inputs == NULL && qdot_tape_inputs(tape) > 0)))
        return QDOT_RESULT_INVALID;
    if (n == 0 || qdot_tape_outputs(tape) == 0)
        return QDOT_RESULT_OK;
    work = qdot_malloc((qdot_tape_work(tape) + 1) * QDOT_TAPE_ROWS * sizeof *work);
    if (work == NULL)
        return QDOT_RESULT_NO_MEMORY;
    qdot_tape_eval_rows(tape, n, inputs, outputs, work);
    qdot_free(work);
    for (size_t i = 0; i < n * qdot_tape_outputs(tape); i++)
        if (!isfinite(outputs[i]))
            outputs[i] = NAN;
    return QDOT_RESULT_OK;
}
