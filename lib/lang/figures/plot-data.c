/* plot-data.c -- columns of a file as points beside the curves of a panel.
 *
 *     plot theta, "data.csv" : t, theta, phi
 *
 * The first column is the abscissa. Where the file names its columns by what the statement or the session knows they
 * are found by these names, else by their order.
 */
#include <string.h>

#include "lang/figures/plot-parts.h"
#include "lang/language/token-text.h"
#include "lang/session/session.h"
#include "table/csv-read.h"

/* A column of a data file, as the statement `plot` names it. */
typedef struct {
    const qdot_filled *part;
    char *label;
    size_t at; /* the index of the column in the file */
    bool skipped;
} data_column;

typedef struct {
    qdot_record *record;
    const qdot_filled *file;
    qdot_csv csv;
    qdot_vec(data_column) columns;
} data_file;

static const char data_hole[] = "\"DATA\"";

static bool
is_data_file(const qdot_filled *part)
{
    return part->node->kind == QDOT_USAGE_HOLE && qdot_filled_is(part, data_hole);
}

const qdot_filled *
qdot_plot_data_find(const qdot_plot_said *said)
{
    const qdot_filled *part = said->from;

    while (part < said->to && !is_data_file(part))
        part++;
    return part;
}

/* --- the columns of the statement -------------------------------------------------------- */

static qdot_status
add_column(data_file *d, const qdot_filled *part)
{
    data_column column = {.part = part, .skipped = qdot_filled_is_word(part, "skip")};
    qdot_text text = {0};
    qdot_status status;

    qdot_token_text(d->record->cursor.session, part->from, part->to, &text);
    status = qdot_text_status(&text);
    column.label = text.at;
    if (status == QDOT_OK)
        status = qdot_vec_push(&d->columns, column);
    if (status != QDOT_OK)
        qdot_text_clear(&text);
    return status;
}

/* Collect the column parts of the statement up to the next file or the options; *next: the part after them. */
static qdot_status
collect_columns(const qdot_plot_said *said, data_file *d, const qdot_filled **next)
{
    const qdot_filled *part = d->file + 1;
    size_t drawn = 0;

    for (; part < said->to && part->node->kind != QDOT_USAGE_WORD && !is_data_file(part); part++)
        if (part->node->kind == QDOT_USAGE_HOLE)
            QDOT_TRY(add_column(d, part));
    *next = part;
    if (part < said->to && qdot_filled_is(part, "vs") && !qdot_filled_is(part + 1, "NAME")) {
        qdot_record_blame(said->record, part);
        (void)qdot_fail(QDOT_EINVAL, "columns of a file have no `vs`: the first is the abscissa");
        return qdot_hint("plot \"data.csv\" : x, y");
    }
    for (size_t i = 1; i < d->columns.n; i++)
        drawn += !d->columns.at[i].skipped;
    if (drawn == 0 || d->columns.at[0].skipped)
        return qdot_record_expected(said->record, part[-1].to, "the abscissa and what was measured: `t, theta`");
    return QDOT_OK;
}

/* --- the columns of the file ------------------------------------------------------------- */

/* The index of the column with this name in the file; csv->columns if there is none. */
static size_t
find_column_by_name(const qdot_csv *csv, const char *label)
{
    size_t i = 0;

    while (i < csv->columns && strcmp(csv->names.at[i].word, label) != 0)
        i++;
    return i;
}

/* Whether the data file names its columns, by names that the statement uses or the session knows. */
static bool
has_named_columns(const data_file *d)
{
    const qdot_names *names = d->record->cursor.session->names;

    if (d->csv.names.n != d->csv.columns)
        return false;
    for (size_t i = 0; i < d->csv.columns; i++)
        if (qdot_names_find(names, d->csv.names.at[i].word) != NULL || strcmp(d->csv.names.at[i].word, "t") == 0)
            return true;
    for (size_t i = 0; i < d->columns.n; i++)
        if (find_column_by_name(&d->csv, d->columns.at[i].label) < d->csv.columns)
            return true;
    return false;
}

/* Add a hint to the present error: the names of the columns of the file. */
static qdot_status
add_hint_of_columns(const qdot_csv *csv)
{
    qdot_text list = {0};
    const qdot_status status = qdot_last_error()->status;

    if (csv->names.n != csv->columns)
        return qdot_hint("a name for each column of the file; `skip` stands for one that is not drawn");
    for (size_t i = 0; i < csv->columns; i++)
        qdot_text_format(&list, "%s%.40s", i > 0 ? ", " : "", csv->names.at[i].word);
    (void)qdot_hint("its columns are %.400s", qdot_text_str(&list));
    qdot_text_clear(&list);
    return status;
}

/* Find the index of each column in the data file, by its name or by order. */
static qdot_status
find_column_indices(data_file *d)
{
    const bool named = has_named_columns(d);
    const size_t n = d->columns.n, most = d->csv.columns;

    if (!named && n != most) {
        qdot_record_blame(d->record, d->columns.at[n > most ? most : n - 1].part);
        (void)qdot_fail(QDOT_EINVAL, "`%.200s` has %zu column%s, %zu are named", qdot_record_text(d->file), most,
                        most == 1 ? "" : "s", n);
        return add_hint_of_columns(&d->csv);
    }
    for (size_t i = 0; i < n; i++) {
        data_column *column = &d->columns.at[i];

        column->at = named ? find_column_by_name(&d->csv, column->label) : i;
        if (column->at < most || column->skipped)
            continue;
        qdot_record_blame(d->record, column->part);
        (void)qdot_fail(QDOT_ENAME, "`%.200s` has no column `%.40s`", qdot_record_text(d->file), column->label);
        return add_hint_of_columns(&d->csv);
    }
    return QDOT_OK;
}

static qdot_status
read_data_file(data_file *d)
{
    qdot_record_blame(d->record, d->file);
    return qdot_session_read_csv(d->record->cursor.session, qdot_record_text(d->file), &d->csv);
}

/* --- the curves -------------------------------------------------------------------------- */

/* The two columns of a curve: abscissa and ordinate. */
typedef struct {
    const qdot_csv *csv;
    size_t at[2];
} pair;

static qdot_status
read_curve_values(void *user, size_t n, const double *s, double *values)
{
    const pair *p = user;

    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < 2; i++)
            values[i * n + k] = p->csv->at[(size_t)s[k] * p->csv->columns + p->at[i]];
    return QDOT_OK;
}

/* Make the points of a curve: a column of the file over its first column. */
static qdot_status
make_trace_of_column(const data_file *d, const data_column *column, qdot_trace *points)
{
    pair p = {&d->csv, {d->columns.at[0].at, column->at}};
    const qdot_trace_source source = {.axes = 2, .values = read_curve_values, .user = &p};
    double *rows = qdot_calloc(d->csv.rows + 1, sizeof *rows);
    qdot_status status;

    if (rows == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < d->csv.rows; k++)
        rows[k] = (double)k;
    status = qdot_trace_begin(&source, d->csv.rows, rows, points);
    qdot_free(rows);
    return status;
}

/* What a column is called in the key: by its file where curves of the scene or of other files stand beside it, and by
 * its name too where the file has several. */
static void
append_column_label(const data_file *d, const data_column *column, bool beside, qdot_text *label)
{
    const char *path = qdot_record_text(d->file), *slash = strrchr(path, '/');
    size_t drawn = 0;

    for (size_t i = 1; i < d->columns.n; i++)
        drawn += !d->columns.at[i].skipped;
    if (beside)
        qdot_text_add(label, slash != NULL ? slash + 1 : path);
    if (!beside || drawn > 1)
        qdot_text_format(label, "%s%s", beside ? ": " : "", column->label);
}

static qdot_status
add_curves_of_file(const data_file *d, bool beside, qdot_plot_panel *p)
{
    for (size_t i = 1; i < d->columns.n; i++) {
        const data_column *column = &d->columns.at[i];
        qdot_plot_curve *curve;
        qdot_text label = {0};
        qdot_status status;

        if (column->skipped)
            continue;
        append_column_label(d, column, beside, &label);
        status = qdot_text_status(&label);
        if (status == QDOT_OK)
            status = qdot_plot_curve_add(p, qdot_text_str(&label), column->label, &curve);
        qdot_text_clear(&label);
        QDOT_TRY(status);
        curve->data = true;
        curve->literal = beside;
        QDOT_TRY(make_trace_of_column(d, column, &curve->points));
    }
    return QDOT_OK;
}

/* Label the abscissa of a panel, if it shows only data, by the name of their first column. */
static qdot_status
label_abscissa(const data_file *d, qdot_plot_panel *p)
{
    if (p->curves.n > 0 || p->variable != NULL)
        return QDOT_OK;
    p->variable = qdot_strdup(d->columns.at[0].label);
    return p->variable != NULL ? QDOT_OK : QDOT_ENOMEM;
}

static void
free_data_file(data_file *d)
{
    for (size_t i = 0; i < d->columns.n; i++)
        qdot_free(d->columns.at[i].label);
    qdot_free(d->columns.at);
    qdot_csv_clear(&d->csv);
}

qdot_status
qdot_plot_data_add(const qdot_plot_said *said, qdot_plot_panel *p)
{
    const qdot_filled *part = qdot_plot_data_find(said);
    qdot_status status = QDOT_OK;
    bool beside = p->curves.n > 0;

    if (part < said->to && p->operands.n > 0 && p->operands.at[0].columns.n == 3 && p->operands.at[0].vector) {
        qdot_record_blame(said->record, part);
        return qdot_fail(QDOT_ETYPE, "a path in space has no data beside it: a file has two columns for a curve");
    }
    while (status == QDOT_OK && part < said->to && is_data_file(part)) {
        data_file d = {.record = said->record, .file = part};

        status = collect_columns(said, &d, &part);
        beside = beside || (part < said->to && is_data_file(part));
        if (status == QDOT_OK)
            status = read_data_file(&d);
        if (status == QDOT_OK)
            status = find_column_indices(&d);
        if (status == QDOT_OK)
            status = label_abscissa(&d, p);
        if (status == QDOT_OK)
            status = add_curves_of_file(&d, beside, p);
        free_data_file(&d);
    }
    return status;
}
