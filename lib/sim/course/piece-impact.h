/* piece-impact.h -- contacts as impulses: for piece-contact.c.
 *
 * A contact lasts if its `then` is an impact on a smooth wall (sim/model/contact.h). Beside others that last its reaction
 * goes through these as well: bodies that push each other in a row. What one contact more does to q'' is then a sum of
 * impulses of all of them,
 *
 *     q''(with) - q''(without) = sum_k c_k i_k,     i_k the change of velocities that `then` of contact k makes
 *
 * so that is what is asked of it. Where nothing presses it this says nothing: then M i must be along the slopes of u.
 *
 * Tests  tests/script/contacts/bodies-in-a-row.lag
 */
#ifndef QDOT_SIM_PIECE_IMPACT_H
#define QDOT_SIM_PIECE_IMPACT_H

#include "sim/course/piece.h"

/* The reaction at the start of a piece of a contact that lasts in x->mode, which has the sides x->side: q'' less that of
 * the mode without it, d [n]; *size its length, 0 if it is their rounding. */
QDOT_MUST_CHECK qdot_status qdot_piece_reaction(qdot_piece *x, size_t surface, double *d, double *size);

/* Whether `then` of the event of a contact, which lasts in x->mode, is an impact on a smooth wall there; *share: the part
 * of the speed that it leaves. */
QDOT_MUST_CHECK qdot_status qdot_piece_is_smooth_wall(qdot_piece *x, size_t surface, double *share,
                                                      bool *yes);

#endif
