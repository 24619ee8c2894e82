/* find-size.c -- the scales of the residuals of `find`, and the cost allowed for its runs. */
#include <math.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/session/bind.h"
#include "lang/unknowns/find-parts.h"
#include "sim/study/sizes.h"

/* Find the sum of the magnitudes of the terms of the expression e. */
static qdot_status
size_of_terms(qdot_session *session, qdot_expr e, double *size)
{
    const bool sum = qdot_expr_kind(session->pool, e) == QDOT_SUM;
    const uint32_t n = sum ? qdot_expr_count(session->pool, e) : 1;

    *size = 0;
    for (uint32_t k = sum ? 1 : 0; k < n; k += 2) { /* a sum has its constant first, then pairs of term and coefficient */
        double one, factor = 1;

        QDOT_TRY(qdot_session_number(session, sum ? qdot_expr_arg(session->pool, e, k) : e, &one, NULL));
        if (sum)
            QDOT_TRY(qdot_session_number(session, qdot_expr_arg(session->pool, e, k + 1), &factor, NULL));
        *size += fabs(one * factor);
    }
    if (sum) {
        double constant;

        QDOT_TRY(qdot_session_number(session, qdot_expr_arg(session->pool, e, 0), &constant, NULL));
        *size += fabs(constant);
    }
    return QDOT_OK;
}

qdot_status
qdot_find_sizes(const qdot_find *f, qdot_run *run, const qdot_expr *e, double *size)
{
    qdot_session *session = f->c->session;
    const size_t n = session->scene->coordinates.n;

    for (size_t k = 0; k < f->conditions.n; k++) {
        if (!f->conditions.at[k].returns) {
            QDOT_TRY(size_of_terms(session, *e++, size++));
            continue;
        }
        for (size_t i = 0; i < 2 * n; i++, e++) {
            const qdot_expr jet = qdot_symbol_jet(session->pool, session->scene->coordinates.at[i % n], i >= n);

            QDOT_TRY(qdot_sizes_along(run, 1, &jet, size++));
        }
    }
    return QDOT_OK;
}

/* The cost allowed for a search: this many times that of its first run, but at least this many ns (ode/meter.h). */
static const double most_runs = 1500, least_budget = 4e9;
/* What an event or a switch costs beside the steps that the meter counts: that it is searched for, carried out and
 * kept, in the run and the second ones. Runs with bounces without number cost little else. */
static const double of_piece = 25000;

qdot_status
qdot_find_spend(qdot_find_budget *b, double length)
{
    const double next = b->first * fmax(1, length / b->length);

    if (b->first == 0 || b->spent + next <= fmax(most_runs * b->first, least_budget))
        return QDOT_OK;
    return qdot_fail(QDOT_EFAILED, "the runs of this search have cost too much, or would by one of length %.3g", length);
}

void
qdot_find_spent(qdot_find_budget *b, qdot_run *run, size_t runs)
{
    const qdot_run_report *report = qdot_run_get_report(run);
    const double work = report->work + report->estimate_work
                        + (report->pieces > 1 ? of_piece * (double)(report->pieces - 1) : 0);

    if (b->first == 0) {
        b->first = work;
        b->length = fabs(report->t1 - report->t0);
    }
    b->spent += (double)runs * work;
}
