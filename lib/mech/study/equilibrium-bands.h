/* equilibrium-bands.h -- conditions on one free coordinate, as intervals of it. Internal to mech/.
 *
 * Under dry friction rests fill regions {q : c_1(q) >= 0 and c_2(q) >= 0 ...}, which is how a solved branch states
 * them. If the c depend on one coordinate u alone, the region is a finite union of intervals: their ends are
 * zeros of the c, and between two neighbouring zeros each c keeps its sign. If the c are linear in u with
 * slopes of known sign, it is one interval, whose ends may hold parameters.
 *
 * Tests  tests/mech/study/test_equilibrium-bands.c
 */
#ifndef QDOT_MECH_EQUILIBRIUM_BANDS_H
#define QDOT_MECH_EQUILIBRIUM_BANDS_H

#include "mech/scene/things.h"
#include "mech/linear/rest.h"
#include "normal/field/facts.h"

/* An interval lo <= u <= hi of a coordinate; a nil end means that there is no end. */
typedef struct {
    qdot_expr lo, hi;
    bool lo_open, hi_open;
    bool numeric; /* true if an end is known only as a decimal number of 12 digits */
} qdot_band;

typedef struct {
    qdot_vec(qdot_band) at;
    qdot_expr also; /* conditions on parameters under which the intervals are not empty; nil: none */
    bool whole;     /* the relations hold on all of u's domain; then `at` is empty */
    bool touched;   /* a relation holds with equality at a point inside an interval */
} qdot_bands;

/* The set of u inside its declared domain at which all relations [n] hold, each a < b or a <= b. *found is false
 * where it cannot be told. *out is cleared by the caller. turn: the relations repeat after 2 pi and u has no domain. */
QDOT_MUST_CHECK qdot_status qdot_bands_find(qdot_pool *pool, qdot_expr u, size_t n,
                                            const qdot_expr *relation, const qdot_facts *facts,
                                            qdot_bands *out, bool *found);
void qdot_bands_clear(qdot_bands *b);

#endif
