/* quotient.h -- a quotient of polynomials in Laplace's s. */
#ifndef QDOT_LANG_QUOTIENT_H
#define QDOT_LANG_QUOTIENT_H

#include "base/memory.h"
#include "lang/session/parts.h"

/* The symbol s: the user's parameter of that name, else a formal one. */
qdot_expr qdot_quotient_laplace(qdot_session *session);
/* Whether the name, which nothing declares, is this s: in what is asked, once a linear motion has inputs. */
bool qdot_quotient_is_laplace(const qdot_session *session, const char *name);

/* e = top/bottom: the factors of e with negative whole powers make the denominator, the others the numerator. */
void qdot_quotient_split(qdot_pool *pool, qdot_expr e, qdot_expr *top, qdot_expr *bottom);

/* Coefficients in ascending powers; the last is not 0. */
typedef struct {
    qdot_vec(qdot_expr);
} qdot_coefficients;

typedef struct {
    qdot_coefficients top, bottom;
} qdot_quotient;

/* The polynomials of e, coprime. QDOT_ETYPE: e is no such quotient, or 0. Clear in any case. */
QDOT_MUST_CHECK qdot_status qdot_quotient_of(qdot_session *session, qdot_expr e, qdot_expr s, qdot_quotient *out);
void qdot_quotient_clear(qdot_quotient *q);

#endif
