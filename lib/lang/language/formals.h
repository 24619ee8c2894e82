/* formals.h -- formal arguments of functions. */
#ifndef QDOT_LANG_FORMALS_H
#define QDOT_LANG_FORMALS_H

#include "lang/language/cursor.h"

/* `(a, b, c)`: the tokens [*n] of the names, owned by the caller. */
QDOT_MUST_CHECK qdot_status qdot_formals_read_names(qdot_cursor *c,
                                                    const qdot_token ***names, size_t *n);
/* `(u, v)`: a LIST of FORMAL symbols, and the tokens [*n] of their names, owned by the
 * caller. */
QDOT_MUST_CHECK qdot_status qdot_formals_read(qdot_cursor *c, qdot_expr *formals,
                                              const qdot_token ***names, size_t *n);
/* An expression in which these names mean these values. */
QDOT_MUST_CHECK qdot_status qdot_formals_read_body(qdot_cursor *c, qdot_expr formals,
                                                   size_t n,
                                                   const qdot_token *const *names,
                                                   qdot_expr *body);

#endif
