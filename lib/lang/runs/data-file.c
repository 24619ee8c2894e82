/* data-file.c -- writes a table to a file in the form of its ending, with facts about its run. */
#include "lang/runs/data-file.h"

#include <math.h>
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/session/names.h"
#include "table/csv.h"
#include "table/hdf5.h"
#include "table/html.h"
#include "table/json.h"
#include "table/text.h"

enum { TEXT_DIGITS = 12 };

typedef enum { CSV, TEXT, JSON, HTML, HDF5, NONE } type;

static type
file_type_of(const char *path)
{
    static const char *const endings[] = {
        [CSV] = ".csv", [TEXT] = ".txt", [JSON] = ".json", [HTML] = ".html", [HDF5] = ".h5"};
    const char *dot = strrchr(path, '.');

    for (size_t i = 0; dot != NULL && i < NONE; i++)
        if (strcmp(dot, endings[i]) == 0)
            return (type)i;
    return NONE;
}

bool
qdot_data_file_is(const char *path)
{
    return file_type_of(path) != NONE;
}

qdot_status
qdot_data_file_check(const char *path)
{
    if (qdot_data_file_is(path))
        return QDOT_OK;
    (void)qdot_fail(QDOT_EINVAL, "`%.200s`: the name of a file of numbers ends in .csv, .json, "
                                 ".txt, .html or .h5", path);
    return qdot_hint("as in \"run.csv\"");
}

/* --- facts about the run ------------------------------------------------------------------ */

typedef qdot_vec(qdot_table_fact) facts;

static qdot_status
add_text_fact(facts *to, const char *name, const char *text)
{
    return text == NULL ? QDOT_OK : qdot_vec_push(to, ((qdot_table_fact){name, text, 0}));
}

static qdot_status
add_number_fact(facts *to, const char *name, double x)
{
    return isnan(x) ? QDOT_OK : qdot_vec_push(to, ((qdot_table_fact){name, NULL, x}));
}

static qdot_status
add_run_facts(const qdot_session *session, const qdot_run *run, facts *to)
{
    static const char *const ends[] = {
        [QDOT_RUN_DONE] = "done", [QDOT_RUN_STOPPED] = "stopped", [QDOT_RUN_FAILED] = "failed"};
    const qdot_run_report *r = qdot_run_get_report(run);

    for (size_t i = 0; i < session->runs->n; i++)
        if (session->runs->at[i].run == run) {
            QDOT_TRY(add_text_fact(to, "run", session->runs->at[i].name));
            QDOT_TRY(add_text_fact(to, "statement", session->runs->at[i].text));
        }
    QDOT_TRY(add_text_fact(to, "method", r->method));
    QDOT_TRY(add_number_fact(to, "tol", r->digits > 0 ? NAN : r->tol));
    QDOT_TRY(add_number_fact(to, "digits", r->digits > 0 ? r->digits : NAN));
    QDOT_TRY(add_number_fact(to, "t0", r->t0));
    QDOT_TRY(add_number_fact(to, "t1", r->t1));
    QDOT_TRY(add_text_fact(to, "status", ends[r->status]));
    QDOT_TRY(add_text_fact(to, "reason", r->reason));
    QDOT_TRY(add_number_fact(to, "error", r->error));
    QDOT_TRY(add_number_fact(to, "energy drift", r->energy_drift));
    return add_number_fact(to, "constraint drift", r->m > 0 ? r->constraint_drift : NAN);
}

/* Add the values that the parameters had at the beginning of the run. */
static qdot_status
add_parameter_facts(const qdot_session *session, qdot_run *run, facts *to)
{
    const double t0 = qdot_run_get_report(run)->t0;
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(session->names, i)) != NULL; i++) {
        qdot_status status;
        double x;

        if (name->kind != QDOT_NAME_PARAM)
            continue;
        status = qdot_run_values(run, 1, &name->value, 1, &t0, &x, NULL);
        QDOT_TRY(qdot_grave(status));
        if (status == QDOT_OK) /* a parameter without a value is skipped */
            QDOT_TRY(add_number_fact(to, name->name, x));
    }
    return QDOT_OK;
}

/* --- writing the file --------------------------------------------------------------------- */

static qdot_status
write_facts(qdot_session *session, qdot_run *run, type type, qdot_dataset *table, const char *path)
{
    facts known = {0}, parameters = {0};
    qdot_status status = add_text_fact(&known, "program", PACKAGE_STRING);

    if (status == QDOT_OK && run != NULL)
        status = add_run_facts(session, run, &known);
    if (status == QDOT_OK && run != NULL)
        status = add_parameter_facts(session, run, &parameters);
    table->n_facts = known.n;
    table->facts = known.at;
    if (run != NULL) { /* without a run the parameters are those that the caller added */
        table->n_parameters = parameters.n;
        table->parameters = parameters.at;
    }
    if (status == QDOT_OK)
        status = type == JSON   ? qdot_table_json(table, path)
                 : type == HTML ? qdot_table_html(table, path)
                                : qdot_table_hdf5(table, path);
    qdot_free(known.at);
    qdot_free(parameters.at);
    return status;
}

static const char *
title_from_path(const char *path)
{
    const char *base = strrchr(path, '/');

    return base == NULL ? path : base + 1;
}

static qdot_status
write_text(qdot_session *session, const qdot_dataset *table, const char *path)
{
    static const qdot_table_text_options options = {QDOT_IN_TXT, TEXT_DIGITS, ""};
    qdot_text text = {0};
    qdot_status status = qdot_table_text(table, &options, &text);

    if (status == QDOT_OK)
        status = qdot_answer_in_file(session, path, &text);
    qdot_text_clear(&text);
    return status;
}

qdot_status
qdot_data_file_write(qdot_session *session, qdot_run *run, qdot_dataset *table, const char *path)
{
    const type type = file_type_of(path);

    QDOT_TRY(qdot_data_file_check(path));
    table->title = title_from_path(path);
    if (type == TEXT)
        return write_text(session, table, path);
    QDOT_TRY(type == CSV ? qdot_table_csv(table, path) : write_facts(session, run, type, table, path));
    return qdot_answer_file(session, path);
}
