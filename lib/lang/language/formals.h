/* formals.h -- formal arguments of functions. */
#ifndef QDOT_LANG_FORMALS_H
#define QDOT_LANG_FORMALS_H

#include "lang/language/cursor.h"
#include "lang/source/token.h"

/* Read `(a, b, c)`: the tokens [*n] of the names, owned by the caller. */
QDOT_MUST_CHECK qdot_status qdot_formals_read_names(qdot_cursor *c,
                                                    const qdot_token ***names, size_t *n);
/* Arguments of a function while they hide outer names. */
typedef struct {
    qdot_expr list; /* a LIST of the FORMAL symbols */
    const qdot_token **names; /* [n] tokens of the argument names, owned */
    size_t n, entered;
} qdot_formals;

/* Let the names mean these symbols (t the time); _leave undoes that and frees them. */
QDOT_MUST_CHECK qdot_status qdot_formals_enter(qdot_session *session, qdot_formals *f);
void qdot_formals_leave(qdot_session *session, qdot_formals *f);

/* `(u, v)`: a LIST of FORMAL symbols, and the tokens [*n] of their names, owned by the
 * caller. */
QDOT_MUST_CHECK qdot_status qdot_formals_read(qdot_cursor *c, qdot_expr *formals,
                                              const qdot_token ***names, size_t *n);

#endif
