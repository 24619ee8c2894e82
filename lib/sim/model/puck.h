/* puck.h -- a puck that comes to rest: forces along the direction w/|w| of velocities.
 *
 *     -mu N v/|v|,   |v| = sqrt(x'^2 + y'^2)   or   sqrt(r'^2 + r^2 phi'^2), sqrt((x' + W y)^2 + ...)
 *
 * |w|^2 is of second degree in q', with its least value, 0, where the velocities q'_j of a few
 * coordinates have certain values ("rest"). With d_j = q'_j less that value,
 *
 *     |w|^2 = sum d_i G_ij d_j,      f = f0 + C/|w|,      C = sum B_j d_j + smaller terms
 *
 * so near rest the force is f0 + sum B_j e_j with the direction e = d/|w|, e G e = 1. At d = 0 it is
 * held by f0 + sum B_j s_j, where the shares s_j follow from d' = 0 (sim/model/sliding.h), as long as
 * s G s <= 1: the cone of friction. Rest is thus of k conditions at once, where a surface along which
 * the motion slides is of one.
 *
 * Velocities that constraints with constant coefficients tie to others, as on a plane, are replaced by
 * these.
 *
 * A puck is at rest where |w| is below a `radius`: so small that it would take the puck a few doubles
 * of t to stop, or as small as errors are by tol. It goes on from where it comes to rest then, by its
 * accelerations at the radius.
 *
 * Where the cone is left, s G s = 1 + c t, the motion begins as t^2 and its direction follows s within
 * a time |w|/acceleration: it is as stiff as can be. So it begins as a mode of its own, in which the
 * direction is that of s ("creeps"), until |s| = 1 + QDOT_PUCK_CREEP. If |s| exceeds 1 by more at once,
 * as after a jump, the puck starts in the direction e of its acceleration: d = radius e.
 *
 * Tests  tests/script/contacts/puck.lag, tests/sim/model/test_puck.c
 */
#ifndef QDOT_SIM_PUCK_H
#define QDOT_SIM_PUCK_H

#include "mech/scene/scene.h"
#include "sim/model/equations.h"
#include "sim/model/switch.h"

/* The binary exponent of the largest s G s - 1 at which a disc still creeps (s: friction ratios, G: metric). */
enum { QDOT_PUCK_CREEP_EXPONENT = -12 };

/* Append the pucks in M q'' = f of the switches, and their surfaces. Errors: those of the pool,
 * QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_pucks_find(const qdot_scene *scene,
                                            const qdot_run_request *request,
                                            qdot_switches *switches);

/* The sliding disc to which a surface belongs; NULL if it belongs to none. */
static inline const qdot_puck *
qdot_puck_of(const qdot_switches *s, size_t surface)
{
    const size_t k = s->surfaces.at[surface].puck;

    return k > 0 ? &s->pucks.at[k - 1] : NULL;
}

/* Whether a disc with this side rests or creeps, so that its friction is found from the equations. */
static inline bool
qdot_puck_is_held(int64_t side)
{
    return side == QDOT_SIDE_SLIDES || side == QDOT_SIDE_CREEPS;
}

/* e [n] near rest, in place: f0 + sum B_j s_j with the symbols of the shares. QDOT_EFAILED with the
 * reason if it is not of that form. */
QDOT_MUST_CHECK qdot_status qdot_puck_hold(qdot_pool *pool, const qdot_puck *puck,
                                           const qdot_facts *facts, size_t n,
                                           qdot_expr *e);

/* The square sum_ij s_i G_ij s_j of a disc's friction ratios s [k], G being the disc's metric. */
qdot_expr qdot_puck_square(qdot_pool *pool, const qdot_puck *puck,
                           const qdot_expr *share);

/* square^(-1/2) where a puck creeps, as a polynomial that is exact to doubles there: a root would become
 * an absolute value if the square is one. */
qdot_expr qdot_puck_inverse_root(qdot_pool *pool, qdot_expr square);

/* e for reading along a run in which the puck rests at times, in place: by the symbols of its shares and
 * of 1/|w|, for any function of w/|w|. QDOT_EFAILED if it has no value at rest. */
QDOT_MUST_CHECK qdot_status qdot_puck_reading(qdot_pool *pool, const qdot_puck *puck,
                                              qdot_expr *e);

#endif
