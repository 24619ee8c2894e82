/* fit-parts.h -- the parts of `fit`: its data, its model, what it answers.
 *
 *     fit m, theta' to "data.csv" : t, theta, sigma
 *
 * makes chi2 = sum ((e_j(t_i; u) - y_ij)/sigma_ij)^2 least over the unknowns u (num/least-squares.h), the e_j and
 * their slopes along one run of the variational equations for each u (sim/study/response.h).
 *
 * Tests  tests/script/studies/fit.sh, tests/bad/studies/fit.sh, tests/sim/study/test_response.c
 */
#ifndef QDOT_LANG_FIT_PARTS_H
#define QDOT_LANG_FIT_PARTS_H

#include "lang/runs/run-options.h"
#include "lang/slopes/slopes.h"
#include "lang/session/row-tables.h"
#include "num/least-squares.h"
#include "table/csv-read.h"

/* The kinds of columns of the file: time, value, standard error, or skipped. */
typedef enum { QDOT_FIT_TIME, QDOT_FIT_VALUE, QDOT_FIT_SIGMA, QDOT_FIT_SKIP } qdot_fit_kind;

typedef struct {
    qdot_fit_kind kind;
    const qdot_token *place;
    char *label;
    qdot_expr e; /* expression of the model for the measured quantity in this column; of the time: what it makes of the
                  * column, an expression of t */
    size_t at;   /* index of this column in the file */
    double sigma; /* standard error of the measured quantity; 0: given by a column, or unknown */
    bool weighted; /* the next column contains the standard errors of this one */
} qdot_fit_column;

typedef struct {
    qdot_session *session;
    qdot_slopes unknowns; /* only the names of the unknowns are used */
    const qdot_token *path_at;
    const char *path; /* name of the data file as typed */
    qdot_vec(qdot_fit_column) columns;
    size_t m;       /* number of measured quantities among the columns */
    bool weighted;  /* standard errors of the data are known */
    qdot_expr from; /* start time of the model's run */
    double tol;
    const char *method, *name; /* integration method; name of the table of residuals */
    const qdot_token *method_at;

    /* The fields from here on hold the data, sorted by time. */
    size_t rows;
    double *t, *y, *sigma; /* [rows] times; [rows x m] data and their standard errors */

    /* The fields from here on hold the results of the fit. */
    qdot_request order;       /* request of the run at the guesses */
    qdot_expr *exprs;         /* [m] expressions of the measured quantities */
    double *guess, *u;        /* [k] guesses, fitted values of the unknowns */
    qdot_least_squares found; /* result of the least-squares problem, residuals divided by sigma */
    size_t freedom;           /* degrees of freedom: number of data minus number of unknowns */
    double *error;            /* [k] standard errors of the unknowns; NaN: unknown */
    double *numerical;        /* [k] error bounds of u from the errors of the run; NaN: unknown */
    double *fitted;           /* [rows x m] values of the model, from an ordinary run at u */
} qdot_fit;

/* Read the file into t, y, sigma. Errors: those of qdot_csv_read, and at a place in the file; which
 * token: c->error_at. */
QDOT_MUST_CHECK qdot_status qdot_fit_read_data(qdot_cursor *c, qdot_fit *f);

/* Find u and all that is known of it. QDOT_EFAILED: it does not converge, or the data do not determine an
 * unknown. */
QDOT_MUST_CHECK qdot_status qdot_fit_find(qdot_fit *f);

/* Set the session's parameters to the fitted values u, rounded to 1/1000 of their standard errors. */
QDOT_MUST_CHECK qdot_status qdot_fit_set(qdot_fit *f);

/* Answer with the fitted values; store the residuals as a table of the session. */
QDOT_MUST_CHECK qdot_status qdot_fit_tell(qdot_fit *f);

#endif
