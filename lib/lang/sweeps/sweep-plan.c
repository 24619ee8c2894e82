/* sweep-plan.c -- `plan sweep`: the number of members, whether they run in lanes, an estimate of
 * time and memory. */
#include <inttypes.h>
#include <string.h>

#include "base/clock.h"
#include "lang/session/trial.h"
#include "lang/sweeps/sweep-lanes.h"
#include "lang/sweeps/sweep-parts.h"
#include "lang/sweeps/sweep-ranks.h"
#include "num/batch.h"
#include "parallel/ranks.h"
#include "parallel/workers.h"

/* The number of runs, spread over the sweep, that are made to estimate its cost: together in lanes, or singly. */
enum { BY_LANES = 32, ALONE = 4 };

typedef struct {
    size_t rows, alone, failed;
    double seconds; /* estimated seconds for one row */
} sample;

/* Make a few runs of the sweep to measure their cost. */
static qdot_status
measure_sample_runs(qdot_sweep *s, sample *m)
{
    const size_t members = s->members.axes.members, most = s->lanes != NULL ? BY_LANES : ALONE;
    size_t rows[BY_LANES], n = members < most ? members : most;
    const double begun = qdot_wall_now();

    for (size_t i = 0; i < n; i++)
        rows[i] = n > 1 ? i * (members - 1) / (n - 1) : 0;
    if (s->lanes != NULL)
        QDOT_TRY(qdot_sweep_lanes_run_rows(s->lanes, rows, n));
    *m = (sample){.rows = n};
    for (size_t i = 0; i < n; i++) {
        qdot_status status;
        const bool made = s->lanes != NULL && qdot_sweep_lanes_made(s->lanes, rows[i], &status);

        if (!made)
            status = qdot_sweep_fill_row(s, rows[i]);
        if (qdot_trial_all_fail(status))
            return status;
        m->alone += !made;
        m->failed += status != QDOT_OK;
    }
    m->seconds = (qdot_wall_now() - begun) / (double)n;
    return QDOT_OK;
}

static void
write_number_of_members(const qdot_sweep *s, qdot_text *text)
{
    const qdot_sweep_axes *axes = &s->members.axes;

    qdot_text_format(text, "members: %zu", axes->members);
    for (size_t i = 0; i < axes->at.n && !axes->random; i++)
        qdot_text_format(text, "%s%s %zu", i == 0 ? ": " : " x ", axes->at.at[i].label,
                         axes->at.at[i].n);
    if (axes->random)
        qdot_text_format(text, ", seed %" PRIu64, axes->seed);
    qdot_text_char(text, '\n');
}

static void
write_way_of_running(const qdot_sweep *s, const sample *m, const char *why, qdot_text *text)
{
    if (s->lanes == NULL)
        qdot_text_format(text, "each: alone: %s\n", why);
    else if (m->alone == 0)
        qdot_text_format(text, "each: by lanes, %d side by side\n", QDOT_LANES);
    else
        qdot_text_format(text,
                         "each: by lanes, %d side by side; of %zu looked at %zu have to be run "
                         "alone: near a bound, of small size, past their last digit\n",
                         QDOT_LANES, m->rows, m->alone);
}

/* Write an estimated duration with at most two digits. */
static void
write_duration(double x, qdot_text *text)
{
    if (x < 120)
        qdot_text_format(text, "%.2g s", x);
    else if (x < 7200)
        qdot_text_format(text, "%.2g min", x / 60);
    else
        qdot_text_format(text, "%.2g h", x / 3600);
}

/* In this process while the sweep is made (another writes to its copies of these): the row, what was drawn for it, whether it is done, by whom,
 * and the reason why it may have failed. */
static size_t
memory_of_member(const qdot_sweep *s)
{
    const size_t drawn = s->members.axes.random ? s->members.axes.at.n * sizeof(double) : 0;

    return qdot_row_table_row_bytes(s->table) + drawn + sizeof *s->done + sizeof(char)
           + (s->lanes != NULL ? QDOT_SWEEP_LANES_BYTES : 0);
}

qdot_status
qdot_sweep_tell_plan(qdot_sweep *s, qdot_text *text)
{
    const size_t members = s->members.axes.members, n = s->table->n;
    const size_t processors = qdot_workers_processors();
    const size_t workers = qdot_sweep_processes(s), ranks = qdot_ranks_count();
    const size_t useful = (workers < processors ? workers : processors) * ranks;
    qdot_text why = {0};
    sample m;
    qdot_status status;

    s->done = qdot_calloc(members + 1, sizeof *s->done);
    if (s->done == NULL)
        return QDOT_ENOMEM;
    QDOT_TRY(qdot_row_table_add_all(s->table, members));
    status = qdot_sweep_lanes_new(s, &s->lanes, &why);
    if (status == QDOT_OK)
        status = measure_sample_runs(s, &m);
    if (status == QDOT_OK) {
        write_number_of_members(s, text);
        write_way_of_running(s, &m, qdot_text_str(&why), text);
        qdot_text_format(text, "processes: %zu", workers);
        qdot_text_format(text, ranks > 1 ? " in each of %zu ranks\n" : "\n", ranks);
        qdot_text_format(text, "time: %.2g s a member, by %zu of them: about ", m.seconds,
                         m.rows);
        write_duration(m.seconds * (double)members / (double)(useful > 0 ? useful : 1), text);
        qdot_text_format(text, "\nmemory: %.2g MB for rows of %zu numbers with their errors",
                         (double)members * (double)memory_of_member(s) / 1e6, n);
        qdot_text_add(text, workers > 1 ? ", about as much again in each of the processes\n" : "\n");
        if (m.failed > 0)
            qdot_text_format(text, "failed: %zu of %zu\n", m.failed, m.rows);
        status = qdot_text_status(text);
    }
    qdot_sweep_lanes_free(s->lanes);
    s->lanes = NULL;
    qdot_text_clear(&why);
    return status;
}
