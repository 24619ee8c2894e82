/* save.c -- the statement `save`: writes a run, the rows of many runs, the session or the history to a file. */
#include <string.h>

#include "expr/symbol.h"
#include "lang/declare/scene-file.h"
#include "lang/files/digits-table.h"
#include "lang/runs/data-file.h"
#include "lang/files/grid.h"
#include "lang/files/row-file.h"
#include "lang/session/measured.h"

static qdot_status carry_out_save(qdot_record *r);

QDOT_STATEMENT(save) = {
    .word = "save",
    .group = QDOT_NUMBERS,
    .usage = "save [ROWS|RUN] to \"FILE.csv|.json|.txt|.html|.h5\" | save session to \"FILE.lag\" | "
             "save history to \"FILE.lag\"",
    .summary = "a run whole: t, q, q', multipliers; a table of rows; the scene with the style and the runs, as statements that "
               "make them anew; or all statements that were typed and succeeded",
    .example = "save a to \"run.csv\"",
    .handler = carry_out_save,
};

static qdot_status
append_symbol_operand(qdot_session *session, qdot_run *run, qdot_expr symbol, qdot_operands *list)
{
    qdot_operand o = {.session = session, .run = run};
    qdot_status status = qdot_pool_check(session->pool);

    if (status == QDOT_OK)
        status = qdot_vec_push(&o.columns, symbol);
    if (status == QDOT_OK) {
        o.label = qdot_strdup(qdot_expr_symbol(session->pool, symbol)->name);
        status = o.label == NULL ? QDOT_ENOMEM : qdot_vec_push(list, o);
    }
    if (status != QDOT_OK)
        qdot_operand_clear(&o);
    return status;
}

/* Append every coordinate, velocity and multiplier of the run as an operand. */
static qdot_status
append_whole_state(qdot_session *session, qdot_run *run, qdot_operands *list)
{
    const qdot_run_report *report = qdot_run_get_report(run);

    for (unsigned order = 0; order < 2; order++)
        for (size_t i = 0; i < report->n - (order > 0 ? report->n_states : 0); i++) {
            qdot_expr jet = qdot_symbol_jet(session->pool, report->coordinates[i], order);

            QDOT_TRY(append_symbol_operand(session, run, jet, list));
        }
    for (size_t k = 0; k < report->m; k++)
        QDOT_TRY(append_symbol_operand(session, run, report->multipliers[k], list));
    return QDOT_OK;
}

/* Save the steps of a run made with the option `digits`; the last row is the end of the run. */
static qdot_status
save_with_known_digits(qdot_session *session, const qdot_operands *list, qdot_run *run, size_t rows,
                       const double *times, const char *path)
{
    qdot_expr *at = qdot_calloc(rows + 1, sizeof *at);
    bool *beside = qdot_calloc(rows + 1, sizeof *beside); /* whether row k is the point just before or after an event */
    qdot_status status = at != NULL && beside != NULL ? QDOT_OK : QDOT_ENOMEM;

    for (size_t k = 0; k < rows && status == QDOT_OK; k++) {
        if (k + 1 < rows)
            at[k] = qdot_measured_rational(session->pool, times[k]);
        beside[k] = qdot_run_is_before_event(run, k) || (k > 0 && qdot_run_is_before_event(run, k - 1));
        status = qdot_pool_check(session->pool);
    }
    if (status == QDOT_OK)
        status = qdot_digits_table(session, list, run, rows, at, beside, path);
    qdot_free(at);
    qdot_free(beside);
    return status;
}

/* Fill the rows at events: of two rows with the same time the first has the state before the event. */
static qdot_status
fill_before_events(qdot_run *run, const qdot_operands *list, qdot_grid *g)
{
    for (size_t k = 0; k < g->table.rows; k++) {
        if (!qdot_run_is_before_event(run, k))
            continue;
        for (size_t i = 0; i < list->n; i++) /* one column for each expression */
            QDOT_TRY(qdot_run_point_values(run, 1, list->at[i].columns.at, k,
                                           g->values + (i + 1) * g->table.rows + k));
    }
    return QDOT_OK;
}

/* Write a run to the file named after `to`: t, q, q' and multipliers at each step. */
static qdot_status
save_run(qdot_record *r, qdot_run *run, const char *path)
{
    qdot_session *session = r->cursor.session;
    qdot_operands list = {0};
    qdot_grid g = {0};
    size_t rows;
    const double *times = qdot_run_times(run, &rows);
    qdot_status status = append_whole_state(session, run, &list);

    if (status == QDOT_OK && qdot_digits_table_of(&list) > 0) {
        status = save_with_known_digits(session, &list, run, rows, times, path);
        qdot_operands_free(&list);
        return status;
    }
    if (status == QDOT_OK)
        status = qdot_grid_fill(&g, &list, rows, times);
    if (status == QDOT_OK)
        status = fill_before_events(run, &list, &g);
    if (status == QDOT_OK)
        status = qdot_grid_write(session, &g, run, path);
    qdot_grid_free(&g);
    qdot_operands_free(&list);
    return status;
}

/* Whether `name` is `session` or `history` and means statements although a run is called that: the file is one of scenes. */
static bool
saves_statements(const char *name, const qdot_filled *file)
{
    return name != NULL && (strcmp(name, "session") == 0 || strcmp(name, "history") == 0) &&
           qdot_scene_file_is(qdot_record_text(file));
}

static qdot_status
carry_out_save(qdot_record *r)
{
    const qdot_filled *rows = qdot_record_hole(r, "save", "ROWS"), *of = qdot_record_hole(r, "save", "RUN"),
                      *file = qdot_record_hole(r, "to", NULL);
    const bool session = qdot_record_word(r, "session") != NULL, history = qdot_record_word(r, "history") != NULL;
    const char *name = NULL;
    qdot_named_run *named;

    if (rows != NULL)
        return qdot_row_file_answer(r, qdot_row_tables_find(r->cursor.session, rows->from->text));
    if (of != NULL)
        QDOT_TRY(qdot_record_name(r, of, &name));
    if (session || history || saves_statements(name, file))
        return qdot_scene_file_write(&r->cursor, file->from,
                                     session || (name != NULL && name[0] == 's') ? QDOT_FILE_SESSION : QDOT_FILE_HISTORY);
    qdot_record_blame(r, file);
    QDOT_TRY(qdot_data_file_check(qdot_record_text(file)));
    r->cursor.error_at = r->start->start;
    QDOT_TRY(qdot_runs_find(r->cursor.session, name, &named));
    return save_run(r, named->run, qdot_record_text(file));
}
