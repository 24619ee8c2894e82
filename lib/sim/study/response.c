/* response.c -- derivatives of a run's results by unknowns u: makes and runs the scene of variational equations. */
#include "sim/study/response.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/progress.h"
#include "expr/calculus.h"
#include "expr/constant.h"
#include "expr/exact.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "sim/course/course.h"
#include "sim/course/reader.h"
#include "sim/model/massless.h"
#include "sim/model/parameter-states.h"
#include "sim/model/substitute.h"
#include "sim/study/method-run.h"
#include "sim/study/tangents.h"
#include "sim/study/variation.h"

struct qdot_response {
    qdot_response_of of;
    qdot_pool *pool;
    size_t n, n_parameters; /* number of coordinates; of parameters among the unknowns */
    qdot_expr *parameters;  /* [n_parameters] their symbols */
    size_t *place;          /* [n_parameters] index of each parameter among the unknowns */
    qdot_tape *start; /* from u: start q, q' [2n], then its derivatives by each unknown [k x 2n] */
    double *starts, *work;  /* [(1 + k) 2n] values of `start`; its scratch */
    double t0;              /* start time of the request */
    double *in;             /* [n_parameters] values of the parameters */
    qdot_tangents tangents;
    bool once, made;        /* the variational scene does not change with u; the scene has been made */

    /* Fields of the scene with derivatives; with the constraints, for numerical values: */
    /* [k] the unknowns as symbols; [(1 + k) x n_values] the values of the request with all, and with one of them
     * free */
    qdot_expr *u, *values;
    qdot_expr *first, *settled; /* [2 half] start of the first run; [2n] the same on the constraints */
    qdot_run_request request; /* request on which the variation is based */
    qdot_variation_by *by;    /* [k] the directions of differentiation, one for each unknown */
    qdot_expr *slopes;        /* [k x 2n] derivatives of the start by the unknowns */
    qdot_variation variation;
    qdot_parameter_states states;
    qdot_run_request run_request;
    qdot_method_run run;
    qdot_course course;
    double steps; /* number of steps of all runs so far */
    qdot_expr *exprs; /* [m (1 + k)] each requested expression, then its derivatives by the unknowns */
    qdot_reading reading;
    double *y, *out; /* [2 (1 + k) n + 2 n_parameters] a state; [m (1 + k)] values of `exprs` */
};

/* --- allocating and freeing -------------------------------------------------------------- */

/* Free the variational scene (coordinates and their derivatives) and everything that belongs to it. */
static void
free_variational_scene(qdot_response *r)
{
    qdot_tape_free(r->reading.tape);
    r->reading = (qdot_reading){0};
    qdot_course_clear(&r->course);
    qdot_method_run_clear(&r->run);
    r->run = (qdot_method_run){0};
    qdot_parameter_states_clear(&r->states);
    qdot_variation_clear(&r->variation);
    r->steps = 0;
    r->made = false;
}

void
qdot_response_free(qdot_response *r)
{
    if (!r)
        return;
    free_variational_scene(r);
    qdot_tangents_end(&r->tangents);
    qdot_tape_free(r->start);
    qdot_free(r->parameters);
    qdot_free(r->place);
    qdot_free(r->starts);
    qdot_free(r->u);
    qdot_free(r->by);
    qdot_free(r->exprs);
    qdot_free(r->y);
    qdot_free(r);
}

static qdot_status
response_allocate(qdot_response *r)
{
    const size_t n = r->n, k = r->of.k, all = (1 + k) * n;

    r->parameters = qdot_calloc(k + 1, sizeof *r->parameters);
    r->place = qdot_calloc(k + 1, sizeof *r->place);
    r->u = qdot_calloc(k + (1 + k) * r->of.request->n_values + 2 * (all + k) + 2 * all + 1,
                       sizeof *r->u);
    r->by = qdot_calloc(k + 1, sizeof *r->by);
    r->exprs = qdot_calloc(r->of.m * (1 + k) + 1, sizeof *r->exprs);
    r->y = qdot_calloc(2 * all + 2 * k + r->of.m * (1 + k) + k + 1, sizeof *r->y);
    if (!r->parameters || !r->place || !r->u || !r->by || !r->exprs || !r->y)
        return QDOT_ENOMEM;
    r->values = r->u + k;
    r->first = r->values + (1 + k) * r->of.request->n_values;
    r->settled = r->first + 2 * (all + k);
    r->slopes = r->settled + 2 * n;
    r->out = r->y + 2 * all + 2 * k;
    r->in = r->out + r->of.m * (1 + k);
    return QDOT_OK;
}

/* --- start values as functions of the unknowns --------------------------------------------- */

/* Compile q, q' at the start, and their derivatives by the unknowns u, as functions of u. */
static qdot_status
make_start_tape(qdot_response *r)
{
    const size_t n = r->n, k = r->of.k;
    qdot_expr *all = qdot_calloc((1 + k) * 2 * n + 1, sizeof *all);
    qdot_status status = all ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < 2 * n && all; i++) {
        all[i] = i < n ? r->of.request->q0[i] : r->of.request->v0[i - n];
        for (size_t j = 0; j < k; j++)
            all[(1 + j) * 2 * n + i] = qdot_diff(r->pool, all[i], r->of.unknowns[j]);
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(r->pool);
    if (status == QDOT_OK)
        status = qdot_tape_new(r->pool, k, r->of.unknowns, (1 + k) * 2 * n, all, &r->start);
    if (status == QDOT_OK) {
        r->starts = qdot_calloc((1 + k) * 2 * n + qdot_tape_work(r->start) + 1, sizeof *r->starts);
        status = r->starts ? QDOT_OK : QDOT_ENOMEM;
        r->work = r->starts + (1 + k) * 2 * n;
    }
    qdot_free(all);
    return status;
}

/* If constraints restrict the whole start, project it and the derivatives onto them. */
static qdot_status
project_start_and_derivatives(qdot_response *r, const double *u, double t)
{
    const size_t z = 2 * r->n;

    for (size_t i = 0; i < r->n_parameters; i++)
        r->in[i] = u[r->place[i]];
    QDOT_TRY(qdot_tangents_settle(&r->tangents, t, r->in, r->starts));
    for (size_t k = 0, i = 0; k < r->of.k; k++) {
        const bool parameter = i < r->n_parameters && r->place[i] == k;

        qdot_tangents_project(&r->tangents, parameter ? i : SIZE_MAX, r->starts + (1 + k) * z);
        i += parameter;
    }
    return QDOT_OK;
}

/* Fill the start y of the variational scene: q, its derivatives, parameters; then the velocities of
 * all these. */
static void
write_start(qdot_response *r, const double *u)
{
    const size_t n = r->n, all = (1 + r->of.k) * n, half = all + r->n_parameters;

    for (size_t j = 0; j <= r->of.k; j++)
        for (size_t i = 0; i < n; i++) {
            r->y[j * n + i] = r->starts[j * 2 * n + i];
            r->y[half + j * n + i] = r->starts[j * 2 * n + n + i];
        }
    for (size_t i = 0; i < r->n_parameters; i++) {
        r->y[all + i] = u[r->place[i]];
        r->y[half + all + i] = 0;
    }
}

/* --- the scene for all u ---------------------------------------------------------------------- */

/* The scale given in the request for unknown k, if that is a coordinate or velocity; otherwise 0. */
static double
scale_of_unknown(const qdot_response *r, size_t k)
{
    const qdot_scene *scene = r->of.scene;

    for (size_t i = 0; i < 2 * r->n && r->of.request->scales; i++)
        if (r->of.unknowns[k] == qdot_symbol_jet(r->pool, scene->coordinates.at[i % r->n], i >= r->n))
            return r->of.request->scales[i];
    return 0;
}

/* In the parameter values of every direction, leave the unknown parameters as free symbols. */
static void
free_unknown_parameters(qdot_response *r)
{
    r->request = *r->of.request;
    for (size_t k = 0, i = 0; k < r->of.k; k++) {
        const bool parameter = i < r->n_parameters && r->place[i] == k;

        r->by[k] =
            (qdot_variation_by){.name = r->of.names[k],
                                .parameter = parameter ? r->of.unknowns[k] : QDOT_NIL,
                                .values = parameter ? r->of.request->values : NULL,
                                .scale = scale_of_unknown(r, k),
                                .start = r->tangents.tape == NULL ? r->slopes + k * 2 * r->n : NULL};
        i += parameter;
    }
    for (size_t i = 0; i < r->of.k * 2 * r->n; i++)
        r->slopes[i] = QDOT_ZERO; /* placeholders: the start of each run provides the numbers */
}

/* Make the request of the runs: parameters among the unknowns become coordinates; the start is that
 * of the first u. */
static qdot_status
make_unknowns_symbols(qdot_response *r, const double *u)
{
    const qdot_run_request request = qdot_variation_request(&r->variation);
    const size_t half = (1 + r->of.k) * r->n + r->n_parameters;

    QDOT_TRY(qdot_parameter_states_open(&r->states, r->variation.scene, &request,
                                        r->n_parameters, r->parameters));
    write_start(r, u);
    for (size_t i = 0; i < 2 * half; i++)
        r->first[i] = qdot_expr_of_double(r->pool, r->y[i]);
    r->run_request = r->states.request;
    r->run_request.q0 = r->first;
    r->run_request.v0 = r->first + half;
    r->run_request.q_named = r->run_request.v_named = NULL;
    return qdot_pool_check(r->pool);
}

/* --- the scene for one u ---------------------------------------------------------------------- */

/* Find the parameter values of the request, with numbers for all unknowns but that with index `free`. */
static void
insert_numbers_except(qdot_response *r, size_t free, qdot_expr *values)
{
    const qdot_run_request *of = r->of.request;

    for (size_t i = 0; i < of->n_values; i++) {
        values[i] = of->values[i];
        for (size_t k = 0; k < r->of.k; k++)
            if (k != free && values[i] != QDOT_NIL)
                values[i] = qdot_subs(r->pool, values[i], 1, &r->of.unknowns[k], &r->u[k]);
    }
}

/* Insert the values u of the unknowns into the request and into the directions of differentiation. */
static qdot_status
insert_numbers(qdot_response *r, const double *u)
{
    const size_t n = r->n, n_values = r->of.request->n_values;

    for (size_t k = 0; k < r->of.k; k++)
        r->u[k] = qdot_expr_of_double(r->pool, u[k]);
    insert_numbers_except(r, SIZE_MAX, r->values);
    for (size_t k = 0; k < r->of.k; k++) {
        qdot_expr *own = r->values + (1 + k) * n_values;

        insert_numbers_except(r, k, own);
        r->by[k] = (qdot_variation_by){.name = r->of.names[k],
                                       .parameter = QDOT_NIL,
                                       .start = r->slopes + k * 2 * n,
                                       .scale = scale_of_unknown(r, k)};
        for (size_t i = 0; i < 2 * n; i++)
            r->slopes[k * 2 * n + i] =
                qdot_expr_of_double(r->pool, r->starts[(1 + k) * 2 * n + i]);
    }
    for (size_t i = 0; i < r->n_parameters; i++) {
        r->by[r->place[i]].parameter = r->parameters[i];
        r->by[r->place[i]].values = r->values + (1 + r->place[i]) * n_values;
    }
    for (size_t i = 0; i < 2 * n; i++)
        r->first[i] = qdot_expr_of_double(r->pool, r->starts[i]);
    r->request = *r->of.request;
    r->request.values = r->values;
    r->request.q0 = r->first;
    r->request.v0 = r->first + n;
    QDOT_TRY(qdot_pool_check(r->pool));
    QDOT_TRY(qdot_method_run_settled(r->of.scene, &r->request, r->settled));
    r->request.q0 = r->settled;
    r->request.v0 = r->settled + n;
    return QDOT_OK;
}

/* --- making the scene --------------------------------------------------------------------------- */

static qdot_status
make_expression_tape(qdot_response *r)
{
    const size_t m = r->of.m, k = r->of.k;

    for (size_t j = 0; j < m; j++) {
        qdot_expr *own = r->exprs + j * (1 + k);

        own[0] = qdot_variation_with_numbers(&r->variation, r->of.exprs[j]);
        for (size_t i = 0; i < k; i++)
            own[1 + i] = qdot_variation_of(&r->variation, r->of.exprs[j], i);
    }
    QDOT_TRY(qdot_pool_check(r->pool));
    return qdot_reader_lower(r->run.plan, m * (1 + k), r->exprs, &r->reading);
}

static qdot_status
make_variational_scene(qdot_response *r, const double *u)
{
    if (r->once)
        free_unknown_parameters(r);
    else
        QDOT_TRY(insert_numbers(r, u));
    QDOT_TRY(qdot_variation_make(r->of.scene, &r->request, r->of.k, r->by, !r->once, &r->variation));
    if (r->once)
        QDOT_TRY(make_unknowns_symbols(r, u));
    else
        r->run_request = qdot_variation_request(&r->variation);
    QDOT_TRY(qdot_method_run_init(&r->run, r->variation.scene, &r->run_request,
                                  r->run_request.method, r->run_request.tol));
    if (!r->once)
        QDOT_TRY(qdot_variation_check_state(&r->variation, r->run.start));
    r->course = (qdot_course){.stage = &r->run.stage};
    QDOT_TRY(make_expression_tape(r));
    r->made = true;
    return QDOT_OK;
}

/* --- runs of the scene ------------------------------------------------------------------------ */

/* Discard the last run, but keep the systems of equations of its modes. */
static void
clear_last_run(qdot_course *c)
{
    qdot_trajectory_clear(&c->tr);
    c->tr = (qdot_trajectory){0};
    c->occurrences.n = c->ends.n = 0;
    c->left_out = c->passed_over = 0;
    c->looked = 0;
    c->failed = false;
    c->reason[0] = '\0';
}

static qdot_status
integrate_response(qdot_response *r, double t0, double t1)
{
    const qdot_ode_options options = {.tol = r->run_request.tol, .past = r->steps};

    clear_last_run(&r->course);
    qdot_progress_begin(t0, t1, "run with slopes");
    QDOT_TRY(qdot_course_run(&r->course, r->run.plan->method, &options, t0, t1,
                             r->once ? r->y : r->run.start));
    r->steps += (double)r->course.tr.result.stats.steps;
    if (r->course.reason[0] != '\0')
        return qdot_fail(QDOT_EFAILED, "the run ended: %.300s", r->course.reason);
    return QDOT_OK;
}

static qdot_status
fail_value_undefined(const qdot_response *r, size_t j, double t)
{
    qdot_text text = {0};
    qdot_status status = qdot_print(r->pool, r->of.exprs[j], QDOT_PLAIN, &text);

    if (status == QDOT_OK)
        status = qdot_fail(QDOT_EDOMAIN, "%.200s or a slope of it is undefined at t = %.15g",
                           qdot_text_str(&text), t);
    qdot_text_clear(&text);
    return status;
}

qdot_status
qdot_response_read(qdot_response *r, size_t n_times, const double *times, double *values,
                   double *slopes)
{
    const size_t m = r->of.m, k = r->of.k;
    qdot_reader reader = {0};
    qdot_status status = qdot_reader_init(&reader, &r->reading, &r->course);

    for (size_t i = 0; i < n_times && status == QDOT_OK; i++) {
        status = qdot_reader_at(&reader, SIZE_MAX, times[i], r->out);
        for (size_t j = 0; j < m && status == QDOT_OK; j++) {
            const double *own = r->out + j * (1 + k);

            for (size_t l = 0; l <= k && status == QDOT_OK; l++)
                if (!isfinite(own[l]))
                    status = fail_value_undefined(r, j, times[i]);
            values[i * m + j] = own[0];
            if (slopes != NULL)
                memcpy(slopes + (i * m + j) * k, own + 1, k * sizeof *slopes);
        }
    }
    qdot_reader_clear(&reader);
    return status;
}

/* Make the parts of the response that do not exist yet, and the start state for u and t. */
static qdot_status
response_prepare(qdot_response *r, const double *u, double t)
{
    qdot_tape_eval(r->start, u, r->starts, r->work);
    for (size_t i = 0; i < (1 + r->of.k) * 2 * r->n; i++)
        if (!isfinite(r->starts[i]))
            return qdot_fail(QDOT_EDOMAIN, "the start is undefined");
    if (r->once)
        QDOT_TRY(project_start_and_derivatives(r, u, t));
    if (!r->made || !r->once) {
        free_variational_scene(r);
        QDOT_TRY(make_variational_scene(r, u));
    }
    if (r->once)
        write_start(r, u);
    return QDOT_OK;
}

qdot_status
qdot_response_run(qdot_response *r, const double *u, double t0, double t1)
{
    QDOT_TRY(response_prepare(r, u, t0));
    return integrate_response(r, t0, t1);
}

qdot_status
qdot_response_at(qdot_response *r, const double *u, double *values, double *slopes)
{
    QDOT_TRY(response_prepare(r, u, r->t0));
    if (r->of.n_times > 0)
        QDOT_TRY(integrate_response(r, r->run.t0, r->run.t1));
    return qdot_response_read(r, r->of.n_times, r->of.times, values, slopes);
}

const qdot_variation *
qdot_response_variation(const qdot_response *r)
{
    return &r->variation;
}

qdot_status
qdot_response_tangents(qdot_response *r, const double *u, double t, size_t *count, double *basis)
{
    qdot_tape_eval(r->start, u, r->starts, r->work);
    QDOT_TRY(project_start_and_derivatives(r, u, t));
    *count = qdot_tangents_basis(&r->tangents, basis);
    return QDOT_OK;
}

/* --- making a response ------------------------------------------------------------------------ */

qdot_status
qdot_response_new(const qdot_response_of *of, qdot_response **out)
{
    qdot_response *r = qdot_calloc(1, sizeof *r);
    qdot_massless massless = {0};
    qdot_status status;

    *out = r;
    if (!r)
        return QDOT_ENOMEM;
    r->of = *of;
    r->pool = of->scene->pool;
    r->n = of->scene->coordinates.n;
    status = qdot_massless_of_scene(of->scene, of->request, &massless);
    r->once = of->scene->constraints.n + massless.n == 0 || of->whole;
    qdot_massless_clear(&massless);
    if (status == QDOT_OK)
        status = response_allocate(r);
    for (size_t k = 0; k < of->k && status == QDOT_OK; k++)
        if (!qdot_expr_is_class(r->pool, of->unknowns[k], QDOT_COORD)) {
            r->parameters[r->n_parameters] = of->unknowns[k];
            r->place[r->n_parameters++] = k;
        }
    if (status == QDOT_OK)
        status = make_start_tape(r);
    if (status == QDOT_OK)
        status = qdot_constant_double(r->pool, of->request->t0, &r->t0);
    if (status == QDOT_OK && r->once)
        status = qdot_tangents_begin(&r->tangents, of->scene, of->request, r->n_parameters, r->parameters);
    return status;
}
