/* slopes.h -- derivatives of numbers of a run by parameters and initial values.
 *
 * The run is made once more together with its variational equations (sim/study/variation.h), and kept
 * meanwhile under a name that nobody can write. A number of the run then has the slope
 *
 *     value(e, tau)        De + de/dt dtau/ds
 *     mean(e, A..B)        the mean of De
 *     max, min(e, A..B)    De where it is
 *     an event's time      -Dg/(dg/dt) there
 *
 * and an expression of such numbers and parameters that of the chain rule.
 *
 * Tests  tests/script/studies/sensitivity.sh, tests/bad/studies/sensitivity-*.lag
 */
#ifndef QDOT_LANG_SLOPES_H
#define QDOT_LANG_SLOPES_H

#include "lang/session/conditions.h"
#include "lang/syntax/record.h"
#include "sim/study/variation.h"

/* A variable by which derivatives are taken. */
typedef struct {
    const qdot_token *place;
    char *label;
    qdot_expr symbol; /* its symbol: a parameter, coordinate, velocity, momentum or speed */
} qdot_slope_name;

typedef qdot_vec(qdot_slope_name) qdot_slope_names;

typedef struct {
    qdot_session *session; /* the session; borrowed */
    qdot_slope_names names;
    qdot_conditions *conditions; /* conditions of the run; borrowed */
    qdot_run *run;               /* the run whose results are differentiated; borrowed */
    qdot_run_request request;
    qdot_variation_by *by;     /* [names] directions of differentiation */
    qdot_expr *values, *start; /* derivatives of parameter values [names x values] and of the start [names x 2n] */
    qdot_expr *settled;        /* [2n] start of the run, with positions and velocities that satisfy its constraints */
    double *scales; /* [2n] scales for the variational run, if the size of the state shows that 1 is unsuitable; else NULL */
    qdot_variation variation;
} qdot_slopes;

/* The temporary name under which the run with the variational equations is kept in the session. */
extern const char qdot_slopes_run[];

/* Find the parameter, q or q' that this part of the statement names; the caller frees its label. */
QDOT_MUST_CHECK qdot_status qdot_slope_name_find(qdot_record *r, const qdot_filled *part, qdot_slope_name *x);
/* Append x, with its label, to the list if `read` is QDOT_OK, else free it. QDOT_EINVAL: it is
 * there already. */
QDOT_MUST_CHECK qdot_status qdot_slope_names_take(qdot_cursor *c, qdot_slope_names *names,
                                                  const qdot_slope_name *x,
                                                  qdot_status read);
/* Set exact values [n] for the names, as `set` and `start` do; QDOT_EDOMAIN: a value lies outside its domain. */
QDOT_MUST_CHECK qdot_status qdot_slope_names_put(qdot_session *session, size_t n, const qdot_slope_name *names,
                                                 const qdot_expr *values);
/* Whether the k-th name is a parameter, not a coordinate or a velocity. */
bool qdot_slopes_is_parameter(const qdot_slopes *s, size_t k);
/* Read the names after the word `before` into slopes, which must be {0}. Free them in any case. */
QDOT_MUST_CHECK qdot_status qdot_slopes_find(qdot_record *r, const char *before, qdot_slopes *s);
/* Make the run with its slopes, of the run of that name (NULL: the latest), as far as the numbers in e,
 * measured from the first-th on, need it. Errors: those of qdot_variation_make and of the run; QDOT_EFAILED
 * where it does not end where the run is. */
QDOT_MUST_CHECK qdot_status qdot_slopes_make(qdot_slopes *s, const char *run, qdot_expr e,
                                             size_t first);
/* The slope by name k of e, an expression of numbers of that run and of parameters: of numbers measured
 * before the first-th nothing is known. QDOT_ENOTBUILT: of something in it there is no slope. */
QDOT_MUST_CHECK qdot_status qdot_slopes_of(qdot_slopes *s, qdot_expr e, size_t first,
                                           size_t k, qdot_expr *slope);
/* If something in *e moves, replace *e by its value at the latest run's end. QDOT_EINVAL: an event stopped the run. */
QDOT_MUST_CHECK qdot_status qdot_slopes_at_end(qdot_session *session, qdot_expr *e);
/* Evaluate an expression of coordinates and velocities at a time, as a number of the latest run. */
QDOT_MUST_CHECK qdot_status qdot_slopes_at_time(qdot_session *session, qdot_expr e, qdot_expr time,
                                                qdot_expr *number);
void qdot_slopes_free(qdot_slopes *s);

/* The values of a run's parameters [of->symbols.n] with p free, p as its own value; those that the session says
 * in terms of p follow it. QDOT_EUNSET: p has no value in the run. */
QDOT_MUST_CHECK qdot_status qdot_slopes_free_values(qdot_session *session, const qdot_conditions *of,
                                                    qdot_expr p, qdot_expr *values);

#endif
