/* error-time.h -- the figure of `race` and `workprecision`, error at the end against CPU time, and of
 * `longtime`, error of the energy against time: both in powers of ten, a curve for each name. */
#ifndef QDOT_LANG_ERROR_TIME_H
#define QDOT_LANG_ERROR_TIME_H

#include "lang/figures/figure-option.h"
#include "lang/language/cursor.h"
#include "sim/study/left-out.h"
#include "table/table.h"

typedef struct {
    const char *name; /* name of the method; points with one name must follow each other */
    double time, error;
} qdot_error_point;

typedef struct {
    const char *title;
    const char *abscissa, *ordinate; /* axis labels */
    const qdot_text *note;
    const char *none; /* the error message if no point can be drawn */
    size_t n;
    const qdot_error_point *points; /* [n] points; those without error or time are skipped */
    const qdot_figure_choice *figure;
    const qdot_panel_choice *panel;
} qdot_error_time;

/* Read the options of the statement; its file may hold a figure or numbers. Errors: QDOT_EINVAL. */
QDOT_MUST_CHECK qdot_status qdot_error_time_options(qdot_record *r, qdot_figure_choice *figure,
                                                    qdot_panel_choice *panel);
/* Read the tolerance after `tol`, 1e-16 to 1; 0 if not given. */
QDOT_MUST_CHECK qdot_status qdot_error_time_tolerance(qdot_record *r, double *tol);

/* The answer of `workprecision` or `longtime`: methods left out, a table and a figure, or a file. */
typedef struct {
    const char *name; /* name of the answer */
    const void *study; /* the result of the study, given to the functions below */
    const qdot_methods_left_out *left_out;
    bool interrupted;
    qdot_status (*table)(const void *study, qdot_dataset *t); /* fills an empty table with the rows to be shown */
    void (*words)(const void *study, qdot_text *out);       /* writes the text below the table */
    qdot_status (*data)(const void *study, qdot_dataset *t);  /* fill the table for a .csv file */
    qdot_status (*rows)(qdot_session *session, const void *study); /* writes the rows as JSON */
    qdot_error_time figure; /* the figure; n, points and note are filled in by `points` */
    size_t most_points;
    size_t (*points)(const void *study, qdot_error_point *points); /* writes the points and returns their number */
    void (*note)(const void *study, qdot_text *out);
} qdot_error_study;
QDOT_MUST_CHECK qdot_status qdot_error_time_tell(qdot_session *session, const qdot_error_study *of);

/* Write the answer to the file named in the statement, or show it. QDOT_EFAILED: nothing can be drawn. */
QDOT_MUST_CHECK qdot_status qdot_error_time_show(qdot_session *session,
                                                 const qdot_error_time *of);

#endif
