/* data.h -- columns of numbers as files for other programs, with what is known of them.
 *
 *     JSON   {"program":"qdot 0.1.0","method":"taylor",...,"parameters":{"m":1},
 *             "columns":["t","theta"],"rows":[[0,1.25],...]}     numbers with 17 digits
 *     HTML   a page with one table, the facts above it
 *     HDF5   a data set of doubles for each column, named by its label (/ as U+2215); the facts are
 *            attributes of the root, the parameters those of the group "parameters"
 *
 * Columns of texts, numbers of many digits, are strings in JSON, and data sets of texts of one
 * length in HDF5. Numbers that are not finite are null in JSON, words in HTML. Paths and errors as in sink.h.
 *
 * Tests  tests/show/test_data.c, tests/script/files/data-files.sh
 */
#ifndef QDOT_SHOW_DATA_H
#define QDOT_SHOW_DATA_H

#include "show/show.h"

/* What is known of the columns as a whole: a text or a number by its name. */
typedef struct {
    const char *name, *text; /* text NULL: the number */
    double number;
} qdot_data_fact;

typedef struct {
    const char *title;
    size_t columns, rows;
    const qdot_column *column; /* [columns] */
    char *const *const *texts; /* [columns] of [rows], in place of numbers; NULL, one NULL: numbers */
    size_t n_facts, n_parameters;
    const qdot_data_fact *facts, *parameters;
} qdot_data;

static inline bool
qdot_data_has_texts(const qdot_data *data, size_t column)
{
    return data->texts != NULL && data->texts[column] != NULL;
}

QDOT_MUST_CHECK qdot_status qdot_data_json(const qdot_data *data, const char *path);
/* Numbers with `digits` significant digits. */
QDOT_MUST_CHECK qdot_status qdot_data_html(const qdot_data *data, int digits, const char *path);
/* Written without the library of HDF5; version 1.8 and later read it. */
QDOT_MUST_CHECK qdot_status qdot_data_hdf5(const qdot_data *data, const char *path);

#endif
