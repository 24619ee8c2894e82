/* continue-orbit.c -- follows branches of periodic orbits as a parameter varies, starting from the latest run that is one. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/interrupt.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "lang/answer/answer.h"
#include "lang/session/bind.h"
#include "lang/slopes/orbit-run.h"
#include "lang/slopes/slopes.h"
#include "lang/unknowns/continue-parts.h"
#include "mech/dynamics/quantity.h"
#include "sim/branches/orbit-continuation.h"

enum { NAME_ROOM = 120 };

/* periods whose relative difference is less than this are considered equal */
static const double same = 1e-9;

typedef struct {
    qdot_session *session;
    const qdot_continue_wish *w;
    qdot_orbit_of of;
    qdot_run_request request;
    const char *run;   /* name of the run, borrowed */
    qdot_expr *values; /* values of the run's parameters */
    double *z;         /* [2n] start state of the orbit */
    qdot_continuation found;
    char (*text)[NAME_ROOM]; /* [width] names of columns that are made here */
    const char **names;
    qdot_expr *quantities; /* [width] what these are; nil: plain numbers */
    size_t *columns;
} job;

/* --- the orbit to start from ------------------------------------------------------------------- */

static qdot_status
read_start_of_orbit(job *j, qdot_run *run)
{
    qdot_scene *s = j->session->scene;
    const size_t n = s->coordinates.n;
    const qdot_run_report *report = qdot_run_get_report(run);

    for (size_t i = 0; i < 2 * n; i++) {
        const qdot_expr e = qdot_symbol_jet(s->pool, s->coordinates.at[i % n], i >= n);

        QDOT_TRY(qdot_run_values(run, 1, &e, 1, &report->t0, &j->z[i], NULL));
        if (e == j->w->parameter)
            j->of.p = j->z[i];
    }
    j->of.T = report->t1 - report->t0;
    if (!(j->of.T > 0))
        return qdot_fail(QDOT_EINVAL, "the orbit's run goes back in time");
    return QDOT_OK;
}

/* Read the parameter values of the family; the continued parameter stays a symbol, its value is
 * stored separately. */
static qdot_status
read_parameter_values(job *j, const qdot_conditions *conditions)
{
    qdot_session *session = j->session;
    const qdot_expr p = j->w->parameter;

    if (j->of.family != QDOT_ORBIT_PARAMETER)
        return QDOT_OK;
    QDOT_TRY(qdot_slopes_free_values(session, conditions, p, j->values));
    j->request.values = j->values;
    return qdot_session_number(
        session,
        conditions->values.at[qdot_expr_place(conditions->symbols.n, conditions->symbols.at, p)],
        &j->of.p, NULL);
}

static qdot_status
find_first_orbit(job *j)
{
    qdot_session *session = j->session;
    const qdot_expr p = j->w->parameter;
    const size_t n = session->scene->coordinates.n;
    const qdot_run_report *report;
    qdot_named_run *orbit;

    QDOT_TRY(qdot_orbit_run_find(session, &orbit));
    report = qdot_run_get_report(orbit->run);
    j->run = orbit->name;
    j->values = qdot_calloc(orbit->conditions->symbols.n + 1, sizeof *j->values);
    j->z = qdot_calloc(2 * n + 1, sizeof *j->z);
    if (!j->values || !j->z)
        return QDOT_ENOMEM;
    j->request = qdot_conditions_request(orbit->conditions);
    j->request.method = report->method;
    j->of = (qdot_orbit_of){.scene = session->scene,
                            .request = &j->request,
                            .family = p == QDOT_NIL ? QDOT_ORBIT_ENERGY
                                      : qdot_expr_is_class(session->pool, p, QDOT_COORD)
                                          ? QDOT_ORBIT_START
                                          : QDOT_ORBIT_PARAMETER,
                            .parameter = p,
                            .z = j->z,
                            .least = j->w->least,
                            .most = j->w->most};
    QDOT_TRY(read_start_of_orbit(j, orbit->run));
    return read_parameter_values(j, orbit->conditions);
}

/* --- rows of the branches ------------------------------------------------------------------------ */

/* Whether the period of the orbits differs between points of the branches. */
static bool
does_period_vary(const job *j)
{
    const size_t T = 2 * j->session->scene->coordinates.n;

    for (size_t i = 0; i < j->found.branches.n; i++)
        for (size_t k = 0; k < j->found.branches.at[i].n; k++)
            if (fabs(j->found.branches.at[i].y[k * j->found.width + T] - j->of.T) > same * j->of.T)
                return true;
    return false;
}

/* Choose the columns: in words the largest value of each coordinate and the period; then start and
 * |multipliers|. */
static qdot_status
make_column_names(job *j, qdot_branches *b)
{
    qdot_scene *s = j->session->scene;
    const size_t n = s->coordinates.n, width = j->found.width, behind = j->found.n + 1;
    size_t k = 0;

    j->text = qdot_calloc(width, sizeof *j->text);
    j->names = qdot_calloc(width, sizeof *j->names);
    j->columns = qdot_calloc(width, sizeof *j->columns);
    j->quantities = qdot_calloc(width, sizeof *j->quantities);
    if (!j->text || !j->names || !j->columns || !j->quantities)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < width; i++) {
        j->names[i] = j->text[i];
        j->quantities[i] = QDOT_NIL;
    }
    for (size_t i = 0; i < 2 * n; i++)
        j->quantities[i] = qdot_symbol_jet(s->pool, s->coordinates.at[i % n], i >= n);
    for (size_t i = 0; i < n; i++)
        j->quantities[behind + i] = s->coordinates.at[i];
    j->quantities[2 * n] = QDOT_T;
    j->quantities[j->found.n] = j->w->parameter == QDOT_NIL ? qdot_mech_energy(s) : j->w->parameter;
    for (size_t i = 0; i < 2 * n; i++) /* names are written as text, since after Ctrl-C no symbol can be made */
        snprintf(j->text[i], NAME_ROOM, "%s%s", qdot_expr_symbol(s->pool, s->coordinates.at[i % n])->name,
                 i < n ? "" : "'");
    strcpy(j->text[2 * n], "T");
    snprintf(j->text[j->found.n], NAME_ROOM, "%s",
             j->w->parameter == QDOT_NIL ? "energy"
                                         : qdot_expr_symbol(s->pool, j->w->parameter)->name);
    for (size_t i = 0; i < n; i++)
        snprintf(j->text[behind + i], NAME_ROOM, "max(%.100s)",
                 qdot_expr_symbol(s->pool, s->coordinates.at[i])->name);
    for (size_t i = 0; behind + n + i < width; i++)
        snprintf(j->text[behind + n + i], NAME_ROOM, "abs(floquet[%zu])", i + 1);
    for (size_t i = 0; i < n; i++)
        j->columns[k++] = behind + i;
    j->columns[k++] = 2 * n;
    b->n_told = k;
    b->n_drawn = does_period_vary(j) ? k : k - 1;
    for (size_t i = 0; i < 2 * n; i++)
        if (strcmp(j->text[i], j->text[j->found.n]) != 0)
            j->columns[k++] = i;
    for (size_t i = behind + n; i < width; i++)
        j->columns[k++] = i;
    b->n_columns = k;
    b->names = j->names;
    b->columns = j->columns;
    b->of = j->quantities;
    return QDOT_OK;
}

/* After Ctrl-C: clear the interruption, so that the results so far can be printed. */
static qdot_status
clear_interruption(qdot_session *session)
{
    qdot_interrupt_clear();
    return qdot_pool_check(session->pool) == QDOT_ENOMEM ? QDOT_ENOMEM : QDOT_OK;
}

qdot_status
qdot_continue_orbit(qdot_session *session, const qdot_continue_wish *w)
{
    job j = {.session = session, .w = w};
    qdot_branches b = {.found = &j.found, .orbits = true};
    qdot_status status = find_first_orbit(&j);

    if (status == QDOT_OK)
        status = qdot_orbit_continuation_find(&j.of, &j.found);
    if (status == QDOT_OK && j.found.interrupted)
        status = clear_interruption(session);
    if (status == QDOT_OK && j.found.width > 0)
        status = make_column_names(&j, &b);
    if (status == QDOT_OK)
        status = qdot_answer_notice(session, "the orbit is that of %s", j.run);
    if (status == QDOT_OK && j.of.family == QDOT_ORBIT_PARAMETER && j.found.conserved)
        status = qdot_answer_notice(session, "the energy is conserved: along the branch it stays "
                                             "what it is in the run");
    for (size_t i = 0; i < j.found.bifurcations.n && status == QDOT_OK; i++) {
        const qdot_bifurcation *const one = &j.found.bifurcations.at[i];

        if (one->reason[0] != '\0')
            status = qdot_answer_notice(session, "orbits of twice the period from %s = %.7g are not followed: %s",
                                        b.names[j.found.n], one->y[j.found.n], one->reason);
    }
    status = qdot_continue_conclude(session, w, &b, status);
    qdot_continuation_clear(&j.found);
    qdot_free(j.text);
    qdot_free(j.names);
    qdot_free(j.quantities);
    qdot_free(j.columns);
    qdot_free(j.values);
    qdot_free(j.z);
    return status;
}
