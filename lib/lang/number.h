/* number.h -- what statements about numbers share: runs by name, requests for them. */
#ifndef QDOT_LANG_NUMBER_H
#define QDOT_LANG_NUMBER_H

#include "lang/read.h"

/* --- start.c: values read, and a request filled with them --------------------------- */

typedef struct {
    qdot_vec(qdot_expr) symbols, values;
    qdot_vec(const qdot_token *) places; /* where each was named; NULL: nowhere */
} qdot_number_pairs;

void qdot_number_free_pairs(qdot_number_pairs *p);
QDOT_MUST_CHECK qdot_status qdot_number_push_pair(qdot_number_pairs *p,
                                                  const qdot_token *place,
                                                  qdot_expr symbol, qdot_expr value);

/* The left side of `NAME = VALUE`: a parameter, or p[NAME]; q or q' of `start`; `=
 * VALUE`, an expression of parameters. */
QDOT_MUST_CHECK qdot_status qdot_number_read_parameter(qdot_cursor *c, qdot_expr *symbol);
QDOT_MUST_CHECK qdot_status qdot_number_read_jet(qdot_cursor *c, qdot_expr *jet);
QDOT_MUST_CHECK qdot_status qdot_number_read_constant(qdot_cursor *c, qdot_expr *value);
/* QDOT_ENAME: there is no `what` of this name; a hint at the one that may have been meant. */
QDOT_MUST_CHECK qdot_status qdot_number_unknown(const qdot_session *session, const char *what,
                                                const char *name);

/* From now on a run starts with this value of q or q'. */
QDOT_MUST_CHECK qdot_status qdot_number_set_start(qdot_session *session, qdot_expr jet,
                                                  qdot_expr value);

/* e with the numbers of runs in it as the rationals that they are. */
qdot_expr qdot_number_without_measured(qdot_session *session, qdot_expr e);

/* A request and what it borrows. */
typedef struct {
    qdot_number_pairs values;
    qdot_vec(qdot_expr) q0, v0;
    qdot_vec(bool) q_named, v_named;
    qdot_run_request request;
} qdot_number_order;

/* Fill in the values and the start of the moment. */
QDOT_MUST_CHECK qdot_status qdot_number_fill_order(qdot_session *session,
                                                   qdot_number_order *o);
void qdot_number_free_order(qdot_number_order *o);

/* --- event.c ------------------------------------------------------------------------- */

/* Whether the scene, or the run (NULL: the latest), has an event of that name. */
bool qdot_event_is(const qdot_session *session, const char *run, const char *name);

/* The time of its k-th occurrence, from 1; k = 0: a list of all. */
QDOT_MUST_CHECK qdot_status qdot_event_time(qdot_session *session, const char *run,
                                            const char *name, long k, qdot_expr *value);

/* --- number.c: runs ----------------------------------------------------------------- */

/* The run of that name, the latest for NULL. QDOT_ENAME where there is none. */
QDOT_MUST_CHECK qdot_status qdot_number_find_run(qdot_session *session, const char *name,
                                                 qdot_named_run **run);
/* One expression, of one run alone, at a time, in doubles or with the digits of the run. */
QDOT_MUST_CHECK qdot_status qdot_number_measure(qdot_session *session, const char *run,
                                                qdot_expr e, qdot_expr time,
                                                qdot_measured *m);
/* One expression at times [k], each with what the exact one is beyond it (lows NULL: 0), along
 * whatever runs it names, else along `run` (NULL: the latest). */
QDOT_MUST_CHECK qdot_status qdot_number_along(qdot_session *session, const char *run,
                                              qdot_expr e, size_t k, const double *times,
                                              const double *lows, double *values,
                                              double *errors);

/* A number of a run, from now on a symbol. */
qdot_expr qdot_number_measured(qdot_session *session, double value, double error);
qdot_expr qdot_number_measured_as(qdot_session *session, qdot_measured m);

/* --- range.c: max, min, mean, drift over a range ------------------------------------- */

bool qdot_number_is_range(const char *word);
/* Of each expression [n] along the run (NULL: the latest) between range [2], NULL: all of
 * it. A list where there are several. */
QDOT_MUST_CHECK qdot_status qdot_number_range(qdot_session *session, const char *run,
                                              const char *word, uint32_t n,
                                              const qdot_expr *args,
                                              const qdot_expr *range, qdot_expr *value);

/* --- member.c: several runs in one expression ---------------------------------------- */

/* e along the run, as a symbol (of a vector or list: of its members) "a.x". */
qdot_expr qdot_member_of(qdot_session *session, const char *run, qdot_expr e);
/* QDOT_ENAME where there is no run of that name. */
qdot_status qdot_member_check(const qdot_session *session, const char *run);
/* Whether such symbols occur. */
bool qdot_member_any(const qdot_session *session, qdot_expr e);
/* Of an expression along one run only: the symbols replaced again and *run that run;
 * else *mixed. */
QDOT_MUST_CHECK qdot_status qdot_member_resolve(qdot_session *session, const char **run,
                                                qdot_expr *e, bool *mixed);
/* A mixed one at such times [k]: values [k], errors [k] (NULL: not wanted). What is along no
 * run named is along `run` (NULL: the latest). */
QDOT_MUST_CHECK qdot_status qdot_member_values(qdot_session *session, const char *run,
                                               qdot_expr e, size_t k, const double *times,
                                               const double *lows, double *values,
                                               double *errors);
/* A mixed one whose runs all have digits, at a time: *value has its symbols replaced by numbers of
 * their runs. Nil where a run has no digits. */
QDOT_MUST_CHECK qdot_status qdot_member_exactly(qdot_session *session, const char *run,
                                                qdot_expr e, qdot_expr time,
                                                qdot_expr *value);
/* from and to narrowed to what all its runs cover. */
QDOT_MUST_CHECK qdot_status qdot_member_span(qdot_session *session, qdot_expr e,
                                             double *from, double *to);

/* A double as the exact rational it is. */
qdot_expr qdot_number_exact(qdot_pool *pool, double x);

/* Components of vectors and lists side by side: append to columns; *n of them. */
typedef qdot_vec(qdot_expr) qdot_number_columns;
QDOT_MUST_CHECK qdot_status qdot_number_flatten(qdot_session *session, qdot_expr e,
                                                qdot_number_columns *columns);

#endif
