/* member.h -- `a.x`, a value along run a, within a larger expression, which may combine several runs. */
#ifndef QDOT_LANG_MEMBER_H
#define QDOT_LANG_MEMBER_H

#include "base/memory.h"
#include "expr/symbol.h"
#include "lang/session/parts.h"

/* A value a.EXPR along run a within an expression, where a FORMAL symbol represents it. */
typedef struct {
    qdot_expr symbol, value;
    char *run;
} qdot_member;

typedef struct qdot_member_list {
    qdot_vec(qdot_member);
} qdot_member_list;

/* Classes of symbols that, without the name of a run, are read along the latest run. */
#define QDOT_MEMBER_MOTION                                                               \
    (QDOT_HAS_TIME | QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION |        \
     QDOT_HAS_MULTIPLIER)

/* The symbol "a.x" for the expression x along the run a; for a vector or list, one symbol for each component. */
qdot_expr qdot_member_of(qdot_session *session, const char *run, qdot_expr e);
/* The run and expression for which a symbol of `a.(expr)` stands; NULL if it is an ordinary symbol. */
const qdot_member *qdot_member_find(const qdot_session *session, qdot_expr symbol);
/* Whether e contains symbols for values along runs, such as a.x. */
bool qdot_member_any(const qdot_session *session, qdot_expr e);
/* Fail with QDOT_EINVAL if e contains symbols for values along runs, where these are not allowed. */
QDOT_MUST_CHECK qdot_status qdot_member_refuse(const qdot_session *session, qdot_expr e);
/* Where all such symbols of *e are along one run: *run is that run, *e has what they stand for in
 * their place. Else *mixed. */
QDOT_MUST_CHECK qdot_status qdot_member_resolve(qdot_session *session, const char **run,
                                                qdot_expr *e, bool *mixed);
/* Times along a run, and the arrays for the values there. */
typedef struct {
    size_t n;
    const double *times, *lows; /* [n] times; exact times minus these, NULL: 0 */
    double *values, *errors; /* [n] values and their errors at these times; errors NULL: not requested */
} qdot_samples;
/* Evaluate an expression of several runs at times; parts that name no run belong to `run` (NULL: the latest). */
QDOT_MUST_CHECK qdot_status qdot_member_values(qdot_session *session, const char *run,
                                               qdot_expr e, const qdot_samples *at);
/* An expression of several runs at a time: *value has numbers of these runs in the place of its
 * symbols; nil where a run has no digits. */
QDOT_MUST_CHECK qdot_status qdot_member_exactly(qdot_session *session, const char *run,
                                                qdot_expr e, qdot_expr time,
                                                qdot_expr *value);
/* Restrict the time range [from, to] to the times that all runs in e cover. */
QDOT_MUST_CHECK qdot_status qdot_member_span(qdot_session *session, qdot_expr e,
                                             double *from, double *to);

#endif
