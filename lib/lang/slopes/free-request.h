/* free-request.h -- the request of a run with unknowns as symbols: what a response (sim/study/response.h) is of.
 *
 * Tests  tests/script/studies/fit.sh, find-orbit.lag
 */
#ifndef QDOT_LANG_FREE_REQUEST_H
#define QDOT_LANG_FREE_REQUEST_H

#include "lang/session/parts.h"
#include "sim/model/request.h"

/* From the request `had` of the session's present values: its values [n_values] and its start q, q' [2n], named [2n], in
 * the unknowns [k], parameters, coordinates, velocities or momenta; *free borrows all of them. */
QDOT_MUST_CHECK qdot_status qdot_free_request(qdot_session *session, size_t k, const qdot_expr *unknowns,
                                              const qdot_run_request *had, qdot_expr *values,
                                              qdot_expr *start, bool *named, qdot_run_request *free);

#endif
