/* momenta.h -- expressions in momenta p[q] and in velocities q', one turned into the other.
 *
 * A definition keeps p[x] as the symbol. Where an expression of momenta meets one of velocities, the
 * momenta become p = dL/dq', or the velocities what they are in momenta; so both sides of
 * `check E1 == energy`, the columns of a table, and diff(E1, x') are in one kind of variables.
 * Where the scene has no Lagrangian, momenta are symbols like others and nothing is changed.
 *
 * Tests  tests/script/derive/momenta-in-names.lag
 */
#ifndef QDOT_LANG_MOMENTA_H
#define QDOT_LANG_MOMENTA_H

#include "lang/session/parts.h"

/* The expression e with every momentum p[q] replaced by dL/dq', and every speed by what it is in velocities. Nil, here and below: the pool keeps the failure. */
qdot_expr qdot_momenta_to_velocities(qdot_session *session, qdot_expr e);

/* Where momenta and velocities meet: e in velocities; of a scene that states H alone, where these follow from the momenta, in momenta. */
qdot_expr qdot_momenta_unify(qdot_session *session, qdot_expr e);

/* e in the variables of `symbol`: in momenta for p[x]; in velocities if p[q] and q' of one coordinate q
 * stand in e and `symbol`, as p[x] for x'; else as it is: Routh's function keeps p[phi] for theta'. */
qdot_expr qdot_momenta_for(qdot_session *session, qdot_expr e, qdot_expr symbol);

/* Whether p[q] and q', or q'', of one coordinate stand in e [n], or p[q] is a function of places: dL/dq' without velocities
 * (a Lagrangian linear in q'). */
bool qdot_momenta_meet(const qdot_session *session, uint32_t n, const qdot_expr *e);

#endif
