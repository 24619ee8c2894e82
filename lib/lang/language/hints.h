/* hints.h -- hints for unknown names: the nearest name, our form of another system's function, or how it
 * is declared. */
#ifndef QDOT_LANG_HINTS_H
#define QDOT_LANG_HINTS_H

#include "lang/language/cursor.h"
#include "lang/source/token.h"

/* A name that looks like a derivative: its coordinate and its usual notation. */
typedef struct {
    char base[64];      /* name of the coordinate: theta in thetadot, v_theta */
    const char *primes; /* the usual notation of the derivative: one or two primes */
    bool family;        /* the coordinate is a member of a family, theta[k] */
} qdot_derivative_name;

/* Whether `name` is how others write the velocity or acceleration of a declared name. sure: thetadot, theta_ddot; else
 * spellings that name other things as well, v_theta, theta_d, of a coordinate. */
bool qdot_hints_derivative(const qdot_session *session, const char *name, bool sure, qdot_derivative_name *found);
/* Whether an unknown name is another system's name for one of our functions, as `Sin`. */
bool qdot_hints_is_foreign(const qdot_session *session, const char *name);
/* "unknown name `thta`", with the hint that fits: the nearest name, our form of another
 * system's, or a statement that declares it. member: the whole, "thta[2]", or NULL. QDOT_ENAME. */
qdot_status qdot_hints_unknown(qdot_cursor *c, const qdot_token *token,
                               const char *member);
/* As qdot_hints_unknown, at a place where only a coordinate is allowed. */
qdot_status qdot_hints_unknown_coordinate(qdot_cursor *c, const qdot_token *token, const char *member);
/* As qdot_hints_unknown, for the name of a called function. */
qdot_status qdot_hints_unknown_function(qdot_cursor *c, const qdot_token *token);
/* "there is no run `a`", in a.theta. QDOT_ENAME. */
qdot_status qdot_hints_unknown_run(const char *name);
/* Report that a function's name is not followed by brackets: `sqrt x`, `sin^2(x)`. QDOT_ESYNTAX. */
qdot_status qdot_hints_bare_function(qdot_cursor *c, const qdot_token *token);
/* The most similar of all known names; NULL if none is similar. Valid until names change. */
const char *qdot_hints_nearest(qdot_session *session, const char *name);

#endif
