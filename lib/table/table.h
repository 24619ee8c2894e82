/* table.h -- a table as data: named columns; rows of numbers with their errors, of texts, of flags.
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
    QDOT_CELL_FLAG /* a number: 1 yes, 0 no, NaN undecided */
} qdot_cell_kind;

/* The form in which a number is shown to people; data files have all digits of a double. */
typedef enum {
    QDOT_NUMBER_GENERAL,         /* `digits` significant ones */
    QDOT_NUMBER_FIXED,           /* `digits` behind the point */
    QDOT_NUMBER_SCIENTIFIC,      /* 1.5e-07, `digits` behind the point */
    QDOT_NUMBER_SCIENTIFIC_OR_0, /* the same, but 0 is 0 */
    QDOT_NUMBER_MEASURED,        /* those that its error leaves; where that leaves none there is no number */
    QDOT_NUMBER_BOUND            /* one, rounded up */
} qdot_number_form;

/* The kinds of output in which a column appears. */
enum {
    QDOT_IN_TERMINAL = 1, /* in answers that people read */
    QDOT_IN_ANSWERS = 2,  /* in rows of JSON as answers */
    QDOT_IN_TXT = 4,
    QDOT_IN_CSV = 8,
    QDOT_IN_FILES = 16, /* .json, .html, .h5 */
    QDOT_IN_DATA = QDOT_IN_TXT | QDOT_IN_CSV | QDOT_IN_FILES
};

typedef struct {
    const char *name; /* UTF-8 */
    const char *head; /* as people read it; NULL: the name */
    unsigned in;      /* QDOT_IN_...; 0: everywhere */
    qdot_cell_kind kind;

    /* The format used for people. */
    qdot_number_form form;
    int digits;
    bool left;           /* aligned; else right */
    unsigned gap, width; /* blanks before it, but for the first; the least width */

    /* The format used for programs. */
    int exact;         /* significant digits in CSV; 0: those of a double */
    bool blank;        /* in CSV nothing stands where there is no number; else nan */
    bool measured;     /* rows of JSON have its errors */
    const char *field; /* in rows of JSON: the field that it is; NULL: one of `values` */

    /* The cells of the column: */
    const double *values, *errors; /* of row k: [k stride]; errors NULL: none are known; else 0: exact, NaN: unknown */
    size_t stride;                 /* 0: 1 */
    char *const *texts;            /* of row k: [k text_stride], NULL: there is none. Of numbers: their digits, where a
                                      double has too few */
    size_t text_stride;            /* 0: 1 */
    const char *present, *absent;  /* what stands for any text, for none; NULL: the text itself, nothing */
} qdot_table_column;

/* A fact about the whole table: a text or a number with its name. */
typedef struct {
    const char *name, *text; /* text NULL: the number */
    double number;
} qdot_table_fact;

typedef struct {
    const char *name;  /* of its rows in JSON; NULL: they have none */
    const char *title; /* of a page */
    size_t n, rows;
    qdot_table_column *columns; /* [n] */
    const size_t *order;        /* [rows] which of the arrays' rows these are; NULL: all as they stand */
    size_t n_facts, n_parameters;
    const qdot_table_fact *facts, *parameters;
    struct {
        size_t n, room; /* cells */
        double *values, *errors;
        char **texts;
        bool failed;
    } own; /* rows of its own; zero: its columns borrow theirs */
} qdot_table;

/* --- tables that own their rows --------------------------------------------------------- */

/* Columns [n] are copied, their names borrowed; then cells are added from left to right, row after row. Clear the
 * table in any case. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_table_begin(qdot_table *t, size_t n, const qdot_table_column *columns);
void qdot_table_add_number(qdot_table *t, double value, double error);
/* Add a cell with a copy of the text; NULL: none. */
void qdot_table_add_text(qdot_table *t, const char *text);
/* Add a cell with the contents of `text`, which is then cleared. */
void qdot_table_add_written(qdot_table *t, qdot_text *text);
/* The status of the table: QDOT_ENOMEM if a cell could not be added. */
QDOT_MUST_CHECK qdot_status qdot_table_status(const qdot_table *t);
void qdot_table_clear(qdot_table *t);

/* --- reading cells ---------------------------------------------------------------------- */

typedef struct {
    double value, error; /* NaN: there is none, is unknown */
    const char *text;    /* NULL: none */
} qdot_table_cell;

qdot_table_cell qdot_table_at(const qdot_table *t, size_t row, size_t column);

static inline bool
qdot_table_shows(const qdot_table *t, size_t column, unsigned where)
{
    return t->columns[column].in == 0 || (t->columns[column].in & where) != 0;
}

/* The table with the columns that stand there alone, cells and all else borrowed; free its columns with qdot_free.
 * QDOT_EINVAL: it has no column; QDOT_ENOMEM, also if cells could not be added. */
QDOT_MUST_CHECK qdot_status qdot_table_select(const qdot_table *t, unsigned where, qdot_table *out);

/* The heading of a column for people. */
const char *qdot_table_head(const qdot_table *t, size_t column);
/* Append a cell for people, `none` if it has no number; digits: of all numbers, 0: as its column says. */
void qdot_table_print_cell(const qdot_table *t, size_t row, size_t column, int digits, const char *none, qdot_text *out);

#endif
