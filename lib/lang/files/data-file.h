/* data-file.h -- columns of numbers in a file, with what is known of their run. */
#ifndef QDOT_LANG_DATA_FILE_H
#define QDOT_LANG_DATA_FILE_H

#include "lang/session/runs.h"
#include "show/data.h"

/* Whether columns can be written to a file of that ending: QDOT_EINVAL names those that can. */
QDOT_MUST_CHECK qdot_status qdot_data_file_check(const char *path);

/* Write columns [n] of `rows` numbers, by the ending: .csv and .txt the numbers alone; .json, .html,
 * .h5 also program, run, method, tolerance, error and the values of the parameters. run: the one they
 * are of, NULL: of several, of none. Answers `wrote PATH`. Errors: as qdot_data_file_check, those
 * of writing. */
QDOT_MUST_CHECK qdot_status qdot_data_file_write(qdot_session *session, qdot_run *run, size_t n,
                                                 const qdot_column *columns, size_t rows,
                                                 const char *path);
/* The same of columns that are texts where texts[j] [rows] is not NULL; .csv, .json, .html, .h5 only. */
QDOT_MUST_CHECK qdot_status qdot_data_file_write_texts(qdot_session *session, qdot_run *run,
                                                       qdot_data *data, const char *path);

#endif
