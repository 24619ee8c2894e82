/* again.c -- the integration of a run, again and again, as peers are timed.
 *
 *     again < SCENE
 *
 * Of the last run of a text in qdot's language: the least time of the processor in seconds, as the run
 * itself counts it, of 200 integrations, of fewer if these take 0.1 s; 3 at least. Nothing lies between
 * them, as between those of stiff.c: in a script reports and companions do, and the code of a run of some
 * microseconds then comes into the caches anew, which takes longer than the run. An integration that
 * fails or ends at another state than the run is an error, as are those of `auto` that change their method.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lang/workbench/script.h"
#include "ode/trajectory.h"
#include "sim/course/course.h"
#include "sim/course/run-state.h"

enum { MOST_TRIES = 200, FEWEST = 3 };

static void
fail(const char *why)
{
    fprintf(stderr, "again: %s\n", why);
    exit(1);
}

static double
once(qdot_run *run, qdot_trajectory *tr)
{
    const qdot_trajectory *before = &run->course.tr;
    const qdot_ode_options options = {.tol = before->tol,
                                      .carry = run->start_low,
                                      .t0_low = run->t0_low,
                                      .t1_low = run->t1_low};
    const size_t row = tr->n * sizeof *tr->y;
    const qdot_status status =
        qdot_trajectory_run(tr, qdot_course_systems(&run->course), run->plan->method,
                            &options, run->t0, run->t1, run->start);

    if (status != QDOT_OK)
        fail(qdot_last_error()->message);
    if (tr->count != before->count ||
        memcmp(tr->y + (tr->count - 1) * tr->n, before->y + (tr->count - 1) * tr->n,
               row) != 0)
        fail("another state");
    return tr->result.stats.cpu;
}

int
main(void)
{
    static char text[1 << 16];
    const size_t length = fread(text, 1, sizeof text, stdin);
    qdot_session *session = qdot_session_new(stdout, stderr);
    double best = INFINITY, sum = 0;
    qdot_trajectory tr = {0};
    qdot_run *run;

    if (!session || qdot_script_run_text(session, "again", text, length) != 0 ||
        session->runs.n == 0)
        fail("no run");
    run = session->runs.at[session->runs.n - 1].run;
    for (int k = 0; k < MOST_TRIES && (k < FEWEST || sum < 0.1); k++) {
        const double took = once(run, &tr);

        best = fmin(best, took);
        sum += took;
    }
    printf("again %.4g\n", best);
    qdot_trajectory_clear(&tr);
    qdot_session_free(session);
    return 0;
}
