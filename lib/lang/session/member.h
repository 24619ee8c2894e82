/* member.h -- `a.x` inside a larger expression: values along several runs at once. */
#ifndef QDOT_LANG_MEMBER_H
#define QDOT_LANG_MEMBER_H

#include "expr/symbol.h"
#include "lang/session/session.h"

/* What a symbol that stands alone reads along the latest run. */
#define QDOT_MEMBER_MOTION                                                               \
    (QDOT_HAS_TIME | QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION |        \
     QDOT_HAS_MULTIPLIER)

/* e along the run, as a symbol (of a vector or list: of its members) "a.x". */
qdot_expr qdot_member_of(qdot_session *session, const char *run, qdot_expr e);
/* What such a symbol stands for; NULL: it is none. */
const qdot_member *qdot_member_find(const qdot_session *session, qdot_expr symbol);
/* Whether such symbols occur. */
bool qdot_member_any(const qdot_session *session, qdot_expr e);
/* QDOT_EINVAL where such symbols occur: nothing is read along a run here. */
QDOT_MUST_CHECK qdot_status qdot_member_refuse(const qdot_session *session, qdot_expr e);
/* Where all such symbols of *e are along one run: *run is that run, *e has what they stand for in
 * their place. Else *mixed. */
QDOT_MUST_CHECK qdot_status qdot_member_resolve(qdot_session *session, const char **run,
                                                qdot_expr *e, bool *mixed);
/* Times along a run, what is wanted there, and where it goes. */
typedef struct {
    size_t n;
    const double *times, *lows; /* [n]; lows: what the exact times are beyond these, NULL: 0 */
    double *values, *errors;    /* [n]; errors NULL: not wanted */
} qdot_samples;
/* Values of an expression of several runs; what names none is along `run` (NULL: the latest). */
QDOT_MUST_CHECK qdot_status qdot_member_values(qdot_session *session, const char *run,
                                               qdot_expr e, const qdot_samples *at);
/* An expression of several runs at a time: *value has numbers of these runs in the place of its
 * symbols; nil where a run has no digits. */
QDOT_MUST_CHECK qdot_status qdot_member_exactly(qdot_session *session, const char *run,
                                                qdot_expr e, qdot_expr time,
                                                qdot_expr *value);
/* Narrow [from, to] to the times that all runs in e cover. */
QDOT_MUST_CHECK qdot_status qdot_member_span(qdot_session *session, qdot_expr e,
                                             double *from, double *to);

#endif
