/* linear.h -- the linear motion of a scene near a state: found, kept as the latest, and read by linearize[A], transfer. */
#ifndef QDOT_LANG_LINEAR_H
#define QDOT_LANG_LINEAR_H

#include "lang/session/history.h"

/* Where and how the motion is made linear. */
typedef struct {
    const struct qdot_speeds *speeds; /* states in place of velocities; NULL: there are none */
    size_t n;
    const qdot_expr *symbols; /* [n] t, q, q' or speeds, inputs that have a value */
    const qdot_expr *values;  /* [n] these values */
    const double *errors;     /* [n] their errors; NULL: the values are exact */
    bool numbers;             /* not in symbols */
} qdot_linear_place;

/* Find it and keep it. In symbols where these stay short, else in numbers with the values of `set`. */
QDOT_MUST_CHECK qdot_status qdot_linear_find(qdot_session *session, const qdot_linear_place *place, bool *moves);
/* The latest linear motion; QDOT_EINVAL if there is none or the scene has changed since. */
QDOT_MUST_CHECK qdot_status qdot_linear_latest(qdot_session *session, const qdot_linear **linear);
/* The slopes of e along states and inputs of the latest one, row [states + inputs]. */
QDOT_MUST_CHECK qdot_status qdot_linear_row(qdot_session *session, const qdot_linear *linear, qdot_expr e, qdot_expr *row);

#endif
