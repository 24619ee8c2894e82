/* table.h -- a data set: named columns; rows of numbers with their errors, of texts, of flags. (The qdot_table of qdot.h
 * is what a program gets of one.)
 *
 * A column says where its cells are: in an array of whoever has them (borrowed; with a stride, so that the entries of
 * a matrix row by row are columns too), or in rows that the table owns, to which cells are added. Nothing is copied to
 * be written.
 *
 * Who has a table says what stands in its columns, and how a person is to read a number of each. How a cell, a row, a
 * file looks is known to the writers alone: table/text.h, csv.h, json.h, html.h, hdf5.h.
 *
 * Tests  tests/table/test_table.c
 */
#ifndef QDOT_TABLE_TABLE_H
#define QDOT_TABLE_TABLE_H

#include <stddef.h>

#include "base/text.h"

typedef enum {
    QDOT_CELL_NUMBER,
    QDOT_CELL_TEXT,
    QDOT_CELL_FLAG /* a number that means 1 yes, 0 no, NaN undecided */
} qdot_cell_kind;

/* The format in which a number is shown to a human reader; data files have all digits of a double. */
typedef enum {
    QDOT_NUMBER_GENERAL,         /* `digits` significant digits */
    QDOT_NUMBER_FIXED,           /* `digits` digits after the decimal point */
    QDOT_NUMBER_SCIENTIFIC,      /* as 1.5e-07, with `digits` digits after the decimal point */
    QDOT_NUMBER_SCIENTIFIC_OR_0, /* as QDOT_NUMBER_SCIENTIFIC, but zero is written 0 */
    QDOT_NUMBER_MEASURED, /* only the digits that are certain according to the error; if none is certain, the cell is empty */
    QDOT_NUMBER_BOUND            /* one significant digit, rounded up */
} qdot_number_form;

/* The kinds of output in which a column of a table appears, as bits. */
enum {
    QDOT_IN_TERMINAL = 1, /* answers in the terminal, for a human reader */
    QDOT_IN_ANSWERS = 2,  /* answers as rows of JSON */
    QDOT_IN_TXT = 4,
    QDOT_IN_CSV = 8,
    QDOT_IN_FILES = 16, /* files .json, .html, .h5 */
    QDOT_IN_DATA = QDOT_IN_TXT | QDOT_IN_CSV | QDOT_IN_FILES
};

typedef struct {
    const char *name; /* name of the column, UTF-8 */
    const char *head; /* heading of the column for a human reader; NULL: the name */
    const char *unit; /* unit of its numbers, as "m/s"; NULL: none */
    unsigned in;      /* bits QDOT_IN_...: where the column appears; 0: everywhere */
    qdot_cell_kind kind;

    /* The number format used for a human reader. */
    qdot_number_form form;
    int digits;
    bool left;           /* aligned left; otherwise right */
    unsigned gap, width; /* number of blanks before the column (not before the first); least width */

    /* The number format used for programs. */
    int exact;         /* significant digits in CSV; 0: as many as a double has */
    bool blank;        /* in CSV a missing number is an empty cell; otherwise "nan" */
    bool measured;     /* rows of JSON include the errors of this column */
    const char *field; /* in rows of JSON: the field's name; NULL: an entry of `values` */

    /* The cells of the column: */
    const double *values, *errors; /* row k: index k * stride; errors NULL: none; error 0: exact, NaN: unknown */
    size_t stride;                 /* distance of two rows in the arrays `values` and `errors`; 0 means 1 */
    char *const *texts;            /* of row k: [k text_stride], NULL: there is none. Of numbers: their digits, where a
                                      double has too few */
    size_t text_stride;            /* distance of two rows in `texts`; 0 means 1 */
    const char *present, *absent; /* written for a cell with text, and for one without; NULL: the text, nothing */
} qdot_table_column;

/* A fact about the whole table: a text or a number with its name. */
typedef struct {
    const char *name, *text; /* name of the fact; text: its value, or NULL if the value is a number */
    double number;
} qdot_table_fact;

typedef struct {
    const char *name;  /* key of the rows in the JSON file; NULL: none */
    const char *title; /* title of an HTML page */
    size_t n, rows;
    qdot_table_column *columns; /* [n] the columns */
    const size_t *order;        /* [rows] index of each row in the arrays; NULL: row k is index k */
    size_t n_facts, n_parameters;
    const qdot_table_fact *facts, *parameters;
    struct {
        size_t n, room; /* number of cells that are used; number that are allocated */
        double *values, *errors;
        char **texts;
        bool failed;
    } own; /* cells that the table itself owns; all 0: the columns borrow their arrays */
} qdot_dataset;

/* --- tables that own their rows --------------------------------------------------------- */

/* Columns [n] are copied, their names borrowed; then cells are added from left to right, row after row. Clear the
 * table in any case. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_table_begin(qdot_dataset *t, size_t n, const qdot_table_column *columns);
void qdot_table_add_number(qdot_dataset *t, double value, double error);
/* Append a cell with a copy of the text; text NULL: a cell without text. */
void qdot_table_add_text(qdot_dataset *t, const char *text);
/* Append a cell with the contents of `text`, which is then cleared. */
void qdot_table_add_written(qdot_dataset *t, qdot_text *text);
/* The status of the table: QDOT_ENOMEM if some cell could not be appended. */
QDOT_MUST_CHECK qdot_status qdot_table_status(const qdot_dataset *t);
void qdot_table_clear(qdot_dataset *t);

/* --- reading cells ---------------------------------------------------------------------- */

typedef struct {
    double value, error; /* value and its error; NaN: no value, unknown error */
    const char *text;    /* text of the cell; NULL: no text */
} qdot_table_cell;

qdot_table_cell qdot_table_at(const qdot_dataset *t, size_t row, size_t column);

static inline bool
qdot_table_shows(const qdot_dataset *t, size_t column, unsigned where)
{
    return t->columns[column].in == 0 || (t->columns[column].in & where) != 0;
}

/* The table with the columns that stand there alone, cells and all else borrowed; free its columns with qdot_free.
 * QDOT_EINVAL: it has no column; QDOT_ENOMEM, also if cells could not be added. */
QDOT_MUST_CHECK qdot_status qdot_table_select(const qdot_dataset *t, unsigned where, qdot_dataset *out);

/* Append the heading of a column for a human reader, its name in a file; with its unit: "v [m/s]". */
void qdot_table_add_head(const qdot_dataset *t, size_t column, qdot_text *out);
void qdot_table_add_name(const qdot_dataset *t, size_t column, qdot_text *out);
/* Append a cell as text for reading, `none` if it has no number; digits 0: as many as the column states. */
void qdot_table_print_cell(const qdot_dataset *t, size_t row, size_t column, int digits, const char *none, qdot_text *out);

#endif
