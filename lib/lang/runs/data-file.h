/* data-file.h -- writes a table to a file, with the facts of its run. */
#ifndef QDOT_LANG_DATA_FILE_H
#define QDOT_LANG_DATA_FILE_H

#include "lang/session/runs.h"
#include "table/table.h"

/* Whether the ending of the path is that of a file of numbers. */
bool qdot_data_file_is(const char *path);
/* Whether columns can be written to a file of that ending: QDOT_EINVAL names those that can. */
QDOT_MUST_CHECK qdot_status qdot_data_file_check(const char *path);

/* Write a table by the ending of the path: .csv and .txt the columns alone; .json, .html, .h5 also program, run, method,
 * tolerance, error and the values of the parameters. run: the one they are of; NULL: of several, of none, and the
 * parameters are those of the table. Answers `wrote PATH`. Errors: as qdot_data_file_check, those of writing. */
QDOT_MUST_CHECK qdot_status qdot_data_file_write(qdot_session *session, qdot_run *run, qdot_dataset *table,
                                                 const char *path);

#endif
