/* run-report.c -- fills the report of a run. */
#include "sim/run/run-report.h"

#include <math.h>
#include <string.h>

#include "sim/form/derived.h"

/* Report the numbers of steps of each part that was integrated separately. */
static qdot_status
report_parts(qdot_run *run)
{
    const qdot_trajectory *tr = &run->course.tr;
    qdot_text *names = &run->part_names;
    const char *at;

    for (size_t k = 0; k < tr->n_tracks; k++) {
        const qdot_plan *part = run->plan->parts[k];
        const qdot_ode_stats *stats = &tr->tracks[k].result.stats;

        for (size_t i = 0; i < part->n; i++)
            qdot_text_format(names, "%s%s", i ? ", " : "", part->names[i]);
        qdot_text_char(names, '\0');
        QDOT_TRY(qdot_vec_push(&run->parts,
                               ((qdot_run_part){NULL, stats->steps, stats->rejected})));
    }
    QDOT_TRY(qdot_text_status(names));
    at = qdot_text_str(names);
    for (size_t k = 0; k < run->parts.n; k++, at += strlen(at) + 1)
        run->parts.at[k].coordinates = at;
    run->report.n_parts = run->parts.n;
    run->report.parts = run->parts.at;
    return QDOT_OK;
}

qdot_status
qdot_run_fill_report(qdot_run *run, double tol)
{
    qdot_run_report *r = &run->report;
    const qdot_ode_stats *stats = &run->course.tr.result.stats;
    const qdot_plan *p = run->plan;

    r->method = p->method->name;
    r->tol = tol;
    r->t0 = run->t0;
    r->t1 = run->course.tr.t[run->course.tr.count - 1];
    r->steps = stats->steps;
    r->rejected = stats->rejected;
    r->evals = stats->evaluations;
    r->jacobians = stats->jacobians;
    r->factorizations = stats->factorisations + run->factored;
    r->pieces = run->course.tr.pieces.n;
    r->modes = run->stage.modes.n;
    r->doubt = run->doubt;
    r->cpu = stats->cpu;
    r->work = run->meter.work;
    r->n = p->n;
    r->n_states = p->n_states;
    r->coordinates = p->inputs;
    r->q = run->course.tr.y + (run->course.tr.count - 1) * run->course.tr.n;
    r->v = r->q + p->n;
    r->operations = qdot_plan_operations(p, NULL);
    r->scales = run->stage.scales;
    r->energy_drift = run->drifts.energy ? run->drifts.at[0].drift : NAN;
    r->n_drifts = run->drifts.n;
    r->drifts = run->drifts.at;
    r->projections = stats->projections;
    qdot_multipliers_report(&run->multipliers, p, r);
    return report_parts(run);
}
