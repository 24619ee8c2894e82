/* ensemble.c -- a scene lowered with some parameters left open; members and companions. */
#include "sim/study/ensemble.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include "base/memory.h"
#include "ode/companion.h"
#include "sim/form/members.h"
#include "sim/form/shifted-lanes.h"
#include "sim/model/quotient.h"
#include "sim/model/substitute.h"
#include "sim/plan/plan.h"
#include "sim/study/ensemble-momenta.h"
#include "tape/constant.h"
#include "tape/shake.h"

/* A system in lanes: one of the two. */
typedef struct {
    qdot_members *direct;
    qdot_shifted_lanes *shifted;
} form;

struct qdot_ensemble {
    qdot_members_model model;
    qdot_tape *shaken;
    /* Of d'Alembert's residual where that is shorter, or the one with reduced equations, whose
     * structure and tape are the model's then. NULL: neither. */
    qdot_plan *plan;
    const qdot_plan *reduced;
    qdot_ensemble_momenta *momenta; /* of these */
    form members, companions; /* companions: made when first asked for */
    double t0, t1, t1_low, tol;
    int t1_side;
    int order;
};

static void
form_free(form *f)
{
    qdot_members_free(f->direct);
    qdot_shifted_lanes_free(f->shifted);
}

static bool
is_residual(const qdot_ensemble *e)
{
    return e->plan && !e->reduced;
}

static qdot_status
form_new(form *f, const qdot_ensemble *e, bool shaken, int order)
{
    if (is_residual(e))
        return qdot_shifted_lanes_new(e->plan, shaken, order, &f->shifted);
    return qdot_members_new(&e->model, shaken ? e->shaken : e->model.tape, order,
                            &f->direct);
}

static void
model_clear(qdot_members_model *model)
{
    qdot_tape_free(model->tape);
    qdot_structure_clear(&model->structure);
}

void
qdot_ensemble_free(qdot_ensemble *e)
{
    if (!e)
        return;
    form_free(&e->members);
    form_free(&e->companions);
    qdot_ensemble_momenta_free(e->momenta);
    if (!e->reduced)
        model_clear(&e->model);
    qdot_plan_free(e->plan);
    qdot_tape_free(e->shaken);
    qdot_free(e);
}

/* --- the scene ---------------------------------------------------------------------- */

typedef struct {
    qdot_scene *scene;
    const qdot_run_request *request;
    size_t n;
    qdot_expr *inputs, *M, *f; /* [2n + 1 + varied], [n x n], [n] */
} builder;

static qdot_status
check(const qdot_scene *scene, const qdot_run_request *request, size_t n_varied,
      const qdot_expr *varied)
{
    const qdot_event *acting = qdot_scene_acting_event(scene);

    if (scene->coordinates.n == 0)
        return qdot_fail(QDOT_EINVAL, "the scene has no coordinates");
    if (scene->constraints.n > 0)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: ensembles with constraints");
    if (acting)
        return qdot_fail(QDOT_ENOTBUILT,
                         "not built yet: ensembles with the event %.100s, which %s",
                         acting->name, acting->stop ? "stops a run" : "changes it");
    if (request->method && strcmp(request->method, "auto") != 0 &&
        strcmp(request->method, "taylor") != 0)
        return qdot_fail(QDOT_EINVAL, "an ensemble runs by taylor, not by %.50s",
                         request->method);
    if (request->q0 || request->v0)
        return qdot_fail(QDOT_EINVAL, "the members of an ensemble bring their own starts");
    for (size_t i = 0; i < n_varied; i++)
        for (size_t k = 0; k < request->n_values; k++)
            if (request->symbols[k] == varied[i])
                return qdot_fail(QDOT_EINVAL, "%s is given to all members and to each",
                                 qdot_expr_symbol(scene->pool, varied[i])->name);
    return QDOT_OK;
}

static qdot_status
derive(builder *b)
{
    qdot_pool *pool = b->scene->pool;
    const qdot_run_request *r = b->request;
    size_t n = b->n;
    qdot_expr M = qdot_mech_numeric_mass(b->scene);
    qdot_expr f = qdot_mech_numeric_forcing(b->scene);

    if (M != QDOT_NIL && f != QDOT_NIL) {
        M = qdot_substitute(pool, M, r->n_values, r->symbols, r->values);
        f = qdot_substitute(pool, f, r->n_values, r->symbols, r->values);
    }
    QDOT_TRY(qdot_pool_check(pool));
    for (size_t i = 0; i < n; i++) {
        qdot_expr q = b->scene->coordinates.at[i];

        b->inputs[i] = q;
        b->inputs[n + i] = qdot_symbol_jet(pool, q, 1);
        b->f[i] = qdot_expr_arg(pool, f, (uint32_t)i);
        for (size_t j = 0; j < n; j++)
            b->M[i * n + j] = qdot_expr_arg(pool, M, (uint32_t)(i * n + j));
    }
    b->inputs[2 * n] = QDOT_T;
    return qdot_pool_check(pool);
}

static qdot_status
find_structure(const builder *b, qdot_structure *structure)
{
    bool *pattern = qdot_calloc(b->n * b->n, sizeof *pattern);
    qdot_status status = pattern ? QDOT_OK : QDOT_ENOMEM;

    for (size_t i = 0; i < b->n && status == QDOT_OK; i++) {
        bool some = false;

        for (size_t j = 0; j < b->n; j++)
            some |= pattern[i * b->n + j] = b->M[i * b->n + j] != QDOT_ZERO;
        if (!some)
            status = qdot_fail(QDOT_ESINGULAR,
                               "the mass matrix is singular: no mass moves with %s",
                               qdot_expr_symbol(b->scene->pool, b->inputs[i])->name);
    }
    if (status == QDOT_OK)
        status = qdot_structure_find(pattern, b->n, structure);
    qdot_free(pattern);
    return status;
}

static bool
is_indefinite(const qdot_scene *scene)
{
    for (size_t i = 0; i < scene->potentials.n; i++)
        if (qdot_expr_node(scene->pool, scene->potentials.at[i].e)->holds &
            QDOT_HAS_VELOCITY)
            return true;
    return scene->lagrangian != QDOT_NIL;
}

static qdot_status
lower(const builder *b, qdot_members_model *model)
{
    const qdot_structure *s = &model->structure;
    qdot_pool *pool = b->scene->pool;
    qdot_vec(qdot_expr) out = {0};
    qdot_status status = QDOT_OK;

    for (size_t k = 0; k < s->blocks && status == QDOT_OK; k++) {
        const size_t *index = s->index + s->start[k];
        size_t n = s->start[k + 1] - s->start[k];

        if (n == 1) {
            status = qdot_vec_push(
                &out, qdot_quotient(pool, b->f[*index], b->M[*index * (b->n + 1)]));
            continue;
        }
        if (is_indefinite(b->scene))
            status = qdot_fail(QDOT_ENOTBUILT,
                               "not built yet: ensembles of a stated Lagrangian whose "
                               "coordinates couple");
        for (size_t i = 0; i < n && status == QDOT_OK; i++)
            status = qdot_vec_push(&out, b->f[index[i]]);
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j <= i && status == QDOT_OK; j++)
                status = qdot_vec_push(&out, b->M[index[i] * b->n + index[j]]);
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(pool);
    if (status == QDOT_OK)
        status = qdot_tape_new_for_series(pool, 2 * b->n + 1 + model->varied, b->inputs,
                                          out.n, out.at, &model->tape);
    qdot_free(out.at);
    return status;
}

/* Equations with momenta kept that lanes can do: no numbers for an M, and none whose velocities
 * may cancel, of which a plan without a start does not know. */
static bool
may_be_reduced(const qdot_plan *r)
{
    if (!r || !r->smooth || r->subtracts)
        return false;
    for (size_t b = 0; b < r->structure.blocks; b++)
        if (r->blocks[b].n > 1 && (r->blocks[b].constant || r->indefinite))
            return false;
    return true;
}

static qdot_status
reduce(qdot_ensemble *e)
{
    const qdot_plan *r = e->plan->reduced;

    model_clear(&e->model);
    e->reduced = r;
    e->model.structure = r->structure;
    e->model.tape = r->tape;
    e->model.n_kept = r->n_kept;
    e->model.kept = r->kept;
    return qdot_ensemble_momenta_new(r, &e->momenta);
}

/* The residual form, where a single run takes it too; likewise momenta that are kept. */
static qdot_status
plan_other_forms(qdot_ensemble *e, const builder *b)
{
    qdot_run_request request = *b->request;

    if (e->model.varied > 0)
        return QDOT_OK;
    request.method = "taylor";
    QDOT_TRY(qdot_plan_new(b->scene, &request, &e->plan));
    if (qdot_shifted_lanes_applies(e->plan))
        return QDOT_OK;
    if (may_be_reduced(e->plan->reduced))
        return reduce(e);
    qdot_plan_free(e->plan);
    e->plan = NULL;
    return QDOT_OK;
}

static qdot_status
make(qdot_ensemble *e, builder *b, size_t n_varied, const qdot_expr *varied)
{
    const qdot_run_request *r = b->request;
    qdot_pool *pool = b->scene->pool;
    double low;
    int side;

    e->model.n = b->n;
    e->model.varied = n_varied;
    e->tol = r->tol;
    QDOT_TRY(qdot_constant_split(pool, r->t0, &e->t0, &side, &low));
    QDOT_TRY(qdot_constant_split(pool, r->t1, &e->t1, &e->t1_side, &e->t1_low));
    b->inputs = qdot_calloc(2 * b->n + 1 + n_varied, sizeof *b->inputs);
    b->M = qdot_calloc(b->n * b->n, sizeof *b->M);
    b->f = qdot_calloc(b->n, sizeof *b->f);
    if (!b->inputs || !b->M || !b->f)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < n_varied; i++)
        b->inputs[2 * b->n + 1 + i] = varied[i];
    QDOT_TRY(derive(b));
    QDOT_TRY(find_structure(b, &e->model.structure));
    QDOT_TRY(lower(b, &e->model));
    QDOT_TRY(plan_other_forms(e, b));
    if (is_residual(e))
        QDOT_TRY(qdot_shifted_lanes_order(e->plan, e->tol, &e->order));
    else
        QDOT_TRY(qdot_members_order(&e->model, e->tol, &e->order));
    return form_new(&e->members, e, false, e->order);
}

qdot_status
qdot_ensemble_new(qdot_scene *scene, const qdot_run_request *request, size_t n_varied,
                  const qdot_expr *varied, qdot_ensemble **ensemble)
{
    builder b = {.scene = scene, .request = request, .n = scene->coordinates.n};
    qdot_ensemble *e;
    qdot_status status;

    *ensemble = NULL;
    QDOT_TRY(check(scene, request, n_varied, varied));
    e = qdot_calloc(1, sizeof *e);
    if (!e)
        return QDOT_ENOMEM;
    status = make(e, &b, n_varied, varied);
    qdot_free(b.inputs);
    qdot_free(b.M);
    qdot_free(b.f);
    if (status != QDOT_OK) {
        qdot_ensemble_free(e);
        return status;
    }
    *ensemble = e;
    return QDOT_OK;
}

/* --- runs --------------------------------------------------------------------------- */

/* One pass over all members, the runs themselves or their companions. */
typedef struct {
    form system;
    qdot_batch_run run;
    double *memory, *parameters;
    double *t1;       /* [members] as run.t1 */
    double *momenta;  /* [n_kept] */
    double *replaced; /* [members x n_kept] velocities that momenta stand in place of */
    qdot_status status;
    qdot_error error; /* of a pass on another thread */
} pass;

static void
pass_clear(pass *p)
{
    qdot_free(p->memory);
    qdot_free(p->run.results);
}

/* From {.run.order, .run.tol}. */
static qdot_status
pass_init(pass *p, const qdot_ensemble *e, size_t members, double t1, const double *y,
          const double *parameters)
{
    size_t ys = members * 2 * e->model.n, ps = members * e->model.varied;
    size_t kept = (members + 1) * e->model.n_kept;
    double *t0, *t1s;

    p->memory = qdot_calloc(2 * members + ys + ps + kept + 1, sizeof *p->memory);
    p->run.results = qdot_calloc(members + 1, sizeof *p->run.results);
    if (!p->memory || !p->run.results)
        return QDOT_ENOMEM;
    t0 = p->memory;
    t1s = p->t1 = t0 + members;
    p->run.y = t1s + members;
    p->parameters = p->run.y + ys;
    p->momenta = p->parameters + ps;
    p->replaced = p->momenta + e->model.n_kept;
    for (size_t m = 0; m < members; m++) {
        t0[m] = e->t0;
        t1s[m] = t1;
    }
    if (ys)
        memcpy(p->run.y, y, ys * sizeof *y);
    if (ps)
        memcpy(p->parameters, parameters, ps * sizeof *parameters);
    p->run.members = members;
    p->run.t0 = t0;
    p->run.t1 = t1s;
    return QDOT_OK;
}

static void *
pass_run(void *user)
{
    pass *p = user;
    qdot_ode_batch system = p->system.direct
                                ? qdot_members_system(p->system.direct)
                                : qdot_shifted_lanes_system(p->system.shifted);

    if (p->system.direct)
        qdot_members_set(p->system.direct, p->parameters);
    p->status = qdot_ode_batch_run(&system, &p->run);
    if (p->status != QDOT_OK)
        p->error = *qdot_last_error();
    return NULL;
}

static void
move(double *x, size_t n)
{
    for (size_t i = 0; i < n; i++)
        x[i] = qdot_companion_moved(x[i], i, 0, 1);
}

static qdot_status
make_companions(qdot_ensemble *e, int order)
{
    if (e->companions.direct || e->companions.shifted)
        return QDOT_OK;
    if (!is_residual(e) && !e->shaken)
        QDOT_TRY(qdot_tape_shake(e->model.tape, &e->shaken));
    return form_new(&e->companions, e, true, order);
}

/* Velocities that follow from momenta that are kept give way to these. A member without them
 * goes no way. */
static void
enter(const qdot_ensemble *e, pass *p)
{
    const size_t n = e->model.n, kept = e->model.n_kept;

    for (size_t m = 0; e->reduced && m < p->run.members; m++) {
        double *y = p->run.y + m * 2 * n;
        const bool finite = qdot_ensemble_momenta_enter(e->momenta, e->t0, y, p->momenta);

        if (!finite)
            p->t1[m] = e->t0;
        for (size_t c = 0; c < kept; c++) {
            double *v = y + n + e->model.kept[c];

            p->replaced[m * kept + c] = *v;
            if (finite)
                *v = p->momenta[c];
        }
    }
}

/* And back. */
static void
come_back(const qdot_ensemble *e, pass *p)
{
    const size_t n = e->model.n, kept = e->model.n_kept;

    for (size_t m = 0; e->reduced && m < p->run.members; m++) {
        qdot_batch_result *r = p->run.results + m;
        double *y = p->run.y + m * 2 * n;

        for (size_t c = 0; c < kept; c++) {
            double *v = y + n + e->model.kept[c];

            p->momenta[c] = *v;
            *v = p->replaced[m * kept + c];
        }
        if (r->steps > 0)
            qdot_ensemble_momenta_derive(e->momenta, r->t, p->momenta, y);
        else if (p->t1[m] == e->t0 && e->t1 != e->t0)
            r->outcome = QDOT_BATCH_UNDEFINED;
    }
}

static qdot_status
run_both(qdot_ensemble *e, pass *runs, pass *companions)
{
    pthread_t thread;
    bool threaded = pthread_create(&thread, NULL, pass_run, companions) == 0;

    pass_run(runs);
    if (threaded)
        pthread_join(thread, NULL);
    else if (runs->status == QDOT_OK)
        pass_run(companions);
    (void)e;
    if (runs->status == QDOT_OK && companions->status != QDOT_OK)
        return qdot_fail(companions->status, "%s", companions->error.message);
    return runs->status;
}

static void
report(const qdot_ensemble *e, const pass *runs, const pass *companions, double *y,
       qdot_ensemble_result *results)
{
    static const char *const reasons[] = {
        [QDOT_BATCH_DONE] = NULL,
        [QDOT_BATCH_UNDEFINED] = "an acceleration is undefined at the start",
        [QDOT_BATCH_STUCK] = "no step is small enough: a singularity",
        [QDOT_BATCH_LIMIT] = "too many steps",
    };
    size_t n = 2 * e->model.n;

    for (size_t m = 0; m < runs->run.members; m++) {
        const qdot_batch_result *r = runs->run.results + m;
        const double *mine = runs->run.y + m * n;
        bool known = companions && r->outcome == QDOT_BATCH_DONE &&
                     companions->run.results[m].outcome == QDOT_BATCH_DONE;
        double error = known ? 0x1p-53 : NAN;

        for (size_t i = 0; i < n && known; i++)
            error = fmax(error, qdot_companion_bound(
                                    fabs(mine[i] - companions->run.y[m * n + i]), 0) /
                                    fmax(1, fabs(mine[i])));
        memcpy(y + m * n, mine, n * sizeof *y);
        results[m] = (qdot_ensemble_result){
            .status = r->outcome == QDOT_BATCH_DONE ? QDOT_RUN_DONE : QDOT_RUN_FAILED,
            .reason = reasons[r->outcome],
            .t = r->t,
            .steps = r->steps,
            .rejected = r->rejected,
            .error = error};
    }
}

qdot_status
qdot_ensemble_run(qdot_ensemble *e, size_t members, double *y, const double *parameters,
                  bool errors, qdot_ensemble_result *results)
{
    const qdot_ode_method *taylor = qdot_ode_method_find("taylor");
    int more = e->order + QDOT_COMPANION_ORDERS;
    pass runs = {.system = e->members, .run = {.order = e->order, .tol = e->tol}};
    pass companions = {
        .run = {.order = more,
                .tol = fmax(taylor->companion_ratio * e->tol, taylor->companion_tol)}};
    qdot_status status = pass_init(&runs, e, members, e->t1, y, parameters);

    runs.run.t1_low = e->t1_low;
    if (status == QDOT_OK && errors)
        status = make_companions(e, more);
    if (status == QDOT_OK && errors)
        status = pass_init(&companions, e, members, qdot_shake_double(e->t1, e->t1_side), y,
                           parameters);
    if (status == QDOT_OK && errors) {
        companions.system = e->companions;
        move(companions.run.y, members * 2 * e->model.n);
        move(companions.parameters, members * e->model.varied);
        enter(e, &companions);
    }
    if (status == QDOT_OK)
        enter(e, &runs);
    if (status == QDOT_OK && errors) {
        status = run_both(e, &runs, &companions);
    } else if (status == QDOT_OK) {
        pass_run(&runs);
        status = runs.status;
    }
    if (status == QDOT_OK && errors)
        come_back(e, &companions);
    if (status == QDOT_OK) {
        come_back(e, &runs);
        report(e, &runs, errors ? &companions : NULL, y, results);
    }
    pass_clear(&runs);
    pass_clear(&companions);
    return status;
}
