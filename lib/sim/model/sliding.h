/* sliding.h -- the equations of a motion that slides along surfaces where the equations switch.
 *
 * On both sides of u = 0 the motion leads back to it: a block that dry friction holds (u = x'), a
 * control that switches without end. Filippov's motion stays on u = 0, by a mean of the forces on
 * both sides with an unknown share s of each,
 *
 *     M q'' - A^T lambda - sum_k B_k s_k = f0,     f = f0 + sum_k B_k s_k,   -1 <= s_k <= 1
 *     A q'' = gamma
 *     U_k q'' = -(what else there is of d u_k/dt, or of d^2 u_k/dt^2 if u holds no velocity) = g_k
 *
 * linear in q'', lambda and s, and solved here as expressions in q, q', t. For sign(x') the share is
 * the force of friction over its largest size. Where a share leaves -1 ... 1 the mode ends, to the
 * side with its sign: s - 1 and s + 1 are watched (sim/course/stage.c).
 *
 * A puck at rest (sim/model/puck.h) has a share for each component of its velocity.
 *
 * A contact that lasts (sim/model/contact.h) is held in the same way: u = 0 of its event, B the slopes of
 * u, s >= 0 the reaction.
 *
 * Source  Filippov, Differential Equations with Discontinuous Righthand Sides (1988), 2.4.
 * Tests   tests/script/contacts/sticking.lag, tests/sim/model/test_sliding.c
 */
#ifndef QDOT_SIM_SLIDING_H
#define QDOT_SIM_SLIDING_H

#include "mech/scene/scene.h"
#include "sim/model/equations.h"
#include "sim/model/switch.h"

/* Whether in this mode the motion slides along a surface, or a disc rests or creeps. */
bool qdot_sliding_is(const qdot_switches *switches, const int64_t *side);

/* Freeze p->M and p->f to the mode of the plan; where the motion slides find p->share, and put it
 * into f. Of few coordinates without constraints M q'' = f becomes q'' = M^-1 f, so that what is
 * held stays where it is without rounding. QDOT_EFAILED: the motion cannot slide there, with the
 * reason: a mass or a constraint switches there, f is not linear in the shares, or no force of the
 * switch acts on u. QDOT_ELIMIT: the elimination is too long. */
QDOT_MUST_CHECK qdot_status qdot_sliding_freeze(qdot_plan *p, qdot_scene *scene);

/* An expression that is read along a run, with parameter values: what switches on a surface along which
 * the run slid (p->read_side) is a mean over both sides by the symbol of the side, whose value is the
 * side or the share. Nil: the pool keeps the failure. */
qdot_expr qdot_plan_reading(const qdot_plan *plan, qdot_expr e);

/* The conditions that a mode keeps by its shares: u = 0 of each, and du/dt = 0 if u holds no velocity.
 * row by row, `order` 0 for rows of q, 1 for rows of q'. */
typedef struct {
    size_t rows;
    int *order;      /* [rows] what the condition restricts: 0: coordinates q; 1: velocities q' */
    size_t *surface; /* [rows] index of the surface on which the condition keeps the motion */
    qdot_tape *tape; /* from q, q', t: functions of the conditions [rows], then derivatives by q or q' [rows x n]; owned */
} qdot_sliding_rows;

/* Of a plan and a mode whose surfaces have the u [surfaces] frozen to it; a puck at rest has a row for
 * each component of w. Start from {0}. */
QDOT_MUST_CHECK qdot_status qdot_sliding_rows_make(const qdot_plan *p, const qdot_switches *switches,
                                                   const int64_t *side, const qdot_expr *u,
                                                   qdot_sliding_rows *rows);
void qdot_sliding_rows_clear(qdot_sliding_rows *rows);

/* The value of the row of that order of a surface at a state, and its slopes [n] (NULL: not asked for); 0
 * if there is none. Allocates. */
QDOT_MUST_CHECK qdot_status qdot_sliding_rows_value(const qdot_sliding_rows *rows, size_t n, double t,
                                                    const double *y, size_t surface, int order,
                                                    double *value, double *slopes);

/* Move y [2n] by the shortest way onto the rows; *moved the largest change of a component over max(1,
 * |component|), infinite if that fails. Allocates. */
QDOT_MUST_CHECK qdot_status qdot_sliding_rows_keep(const qdot_sliding_rows *rows, size_t n,
                                                   double t, double *y, double *moved);

#endif
