/* formals.h -- formal arguments of functions. */
#ifndef QDOT_LANG_FORMALS_H
#define QDOT_LANG_FORMALS_H

#include "lang/language/cursor.h"
#include "lang/source/token.h"

/* Read a list of argument names, `(a, b, c)`: [*n] tokens, owned by the caller. */
QDOT_MUST_CHECK qdot_status qdot_formals_read_names(qdot_cursor *c,
                                                    const qdot_token ***names, size_t *n);
/* The arguments of a function while they hide outer meanings of their names. */
typedef struct {
    qdot_expr list; /* a LIST of the FORMAL symbols */
    const qdot_token **names; /* [n] tokens of the argument names, owned */
    size_t n, entered;
} qdot_formals;

/* _enter: let the argument names mean these symbols (t: the time); _leave: end that, and free the names. */
QDOT_MUST_CHECK qdot_status qdot_formals_enter(qdot_session *session, qdot_formals *f);
void qdot_formals_leave(qdot_session *session, qdot_formals *f);

/* `(u, v)`: a LIST of FORMAL symbols, and the tokens [*n] of their names, owned by the
 * caller. */
QDOT_MUST_CHECK qdot_status qdot_formals_read(qdot_cursor *c, qdot_expr *formals,
                                              const qdot_token ***names, size_t *n);

#endif
