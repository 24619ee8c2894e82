/* csv-read.h -- columns of numbers from a text file: measured data.
 *
 * A line holds one row; its numbers stand between commas, semicolons, or blanks and tabs: the first row
 * decides which. Lines may end in LF, CRLF or CR. Blank lines, `#` and `%` up to the end of a line, a byte order mark and
 * lines of words before the first row (its names, its units) are passed over; the names are kept. Numbers have a decimal point, in quotes or not.
 *
 * Whatever else stands there is an error that begins with its place, FILE:LINE:COLUMN (both from 1, columns in
 * characters), as data.csv:7:12: `x` is not a number.
 *
 * Tests  tests/table/test_csv-read.c, tests/script/studies/fit.sh, tests/bad/studies/fit.sh
 */
#ifndef QDOT_TABLE_CSV_READ_H
#define QDOT_TABLE_CSV_READ_H

#include <stddef.h>

#include "base/memory.h"
#include "base/text.h"

typedef struct {
    size_t line, column; /* position of a number in the file */
} qdot_csv_place;

/* A word in the first line of words of the file, such as a column's name. */
typedef struct {
    char *word;
    qdot_csv_place place;
} qdot_csv_name;

typedef struct {
    bool gaps; /* set before reading: an empty cell or a word for a missing number, as nan, is NaN and no error */
    size_t columns, rows;
    double *at;             /* [rows x columns] the numbers, all finite but for gaps */
    qdot_csv_place *places; /* [rows x columns] where each number stands in the file */
    qdot_vec(qdot_csv_name) names;
} qdot_csv;

/* Read the file. Start from {0}; clear it in any case. QDOT_EIO: it cannot be read;
 * QDOT_EINVAL: what stands in it is no table of numbers; QDOT_ELIMIT: it is larger than 256 MB. */
QDOT_MUST_CHECK qdot_status qdot_csv_read(const char *path, qdot_csv *csv);
/* Read CSV from a text [length]; error messages call it `name`. */
QDOT_MUST_CHECK qdot_status qdot_csv_read_text(const char *name, const char *text,
                                               size_t length, qdot_csv *csv);
void qdot_csv_clear(qdot_csv *csv);

/* Of a file that names all its columns, the index of the only one with this name; csv->columns: none or several have it. */
size_t qdot_csv_find(const qdot_csv *csv, const char *name);

/* Fail with the position of a number: "NAME:LINE:COLUMN: MESSAGE". */
qdot_status qdot_csv_fail(const char *name, const qdot_csv_place *place, const char *format, ...)
    QDOT_PRINTF(3, 4);

#endif
