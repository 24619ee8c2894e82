/* request.h -- makes the request of a run from the session's present values and start. */
#ifndef QDOT_LANG_REQUEST_H
#define QDOT_LANG_REQUEST_H

#include "lang/commands/pairs.h"
#include "lang/session/parts.h"
#include "sim/model/request.h"

/* The request of a run, with the arrays to which it points. */
typedef struct {
    qdot_pairs values;
    qdot_vec(qdot_expr) q0, v0;
    qdot_vec(bool) q_named, v_named;
    double *scales, *apart;
    bool momenta_in_numbers; /* the velocities that follow from momenta were found as doubles */
    qdot_run_request request;
} qdot_request;

/* Fill the request of a run with the session's values of parameters and its start. */
QDOT_MUST_CHECK qdot_status qdot_request_fill(qdot_session *session, qdot_request *o);
/* Set the time limits of the request, which must be constants with the session's values. */
QDOT_MUST_CHECK qdot_status qdot_request_limits(qdot_session *session, qdot_expr from,
                                                qdot_expr to, qdot_request *o);
/* If the start gives momenta p[q], the velocities that follow from them at its place and time; a momentum whose
 * velocity is not named either is 0 then. Called by _limits. QDOT_ESINGULAR, QDOT_EDOMAIN: they do not follow. */
QDOT_MUST_CHECK qdot_status qdot_request_momenta(qdot_session *session, qdot_request *o);
/* A start of which momenta are given: its places q0 [n] and time t0, and the velocities v0 [n] with whether each is named.
 * The unknowns [k], parameters, coordinates, velocities and momenta, keep their symbols. */
typedef struct {
    const qdot_expr *q0;
    qdot_expr *v0;
    bool *v_named;
    qdot_expr t0;
    size_t k;
    const qdot_expr *unknowns;
} qdot_start_by_momenta;

/* Fill in the velocities that follow. *in_numbers: as doubles, which no start with unknowns allows. Errors as above. */
QDOT_MUST_CHECK qdot_status qdot_start_by_momenta_solve(qdot_session *session, const qdot_start_by_momenta *o, bool *in_numbers);
/* If the start gives speeds, the velocities that follow from them and the constraints at its place and time. Called by
 * _limits. QDOT_EINVAL: they do not follow, or the place breaks a constraint. */
QDOT_MUST_CHECK qdot_status qdot_request_speeds(qdot_session *session, qdot_request *o);
/* Set values, start and limits for a statement that integrates by itself; give a notice if there was no `start`. */
QDOT_MUST_CHECK qdot_status qdot_request_between(qdot_session *session, qdot_expr from,
                                                 qdot_expr to, qdot_request *o);
void qdot_request_free(qdot_request *o);

/* Fail with QDOT_ESINGULAR if a mass or moment of inertia is negative with these values; the message says which. */
QDOT_MUST_CHECK qdot_status qdot_request_masses(qdot_session *session, const qdot_request *o);
/* The status of what was done with the request. Where the mass matrix was singular and a mass or
 * moment of inertia is negative, the error says so: which, and the value of its parameter. Tests:
 * tests/bad/runs/mass-negative*.lag. */
QDOT_MUST_CHECK qdot_status qdot_request_explain(qdot_session *session, const qdot_request *o,
                                                 qdot_status status);

#endif
