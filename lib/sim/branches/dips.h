/* dips.h -- whether a test function comes near 0 between points of a curve without changing its sign.
 *
 * Two bifurcations between neighbouring points leave no trace in signs: the determinant (two crossings,
 * three curves through one point) or the tangent's part along p (two folds) only dips. Of four
 * neighbours z, a, b, c with one sign a dip is
 *
 *     min(|f_a|, |f_b|) < 1/2 min(|f_z|, |f_c|);
 *
 * the way from z on is then gone again by shorter steps, until signs change, the dip is smooth in
 * the steps, or all that is left of f is rounding.
 *
 * Tests  tests/sim/branches/test_continuation.c
 */
#ifndef QDOT_SIM_DIPS_H
#define QDOT_SIM_DIPS_H

#include "sim/branches/path.h"

enum { QDOT_DIPS_KEPT = 3 };

typedef struct {
    size_t n;                              /* number of points stored, oldest first */
    qdot_path_point at[QDOT_DIPS_KEPT];
    double gone[QDOT_DIPS_KEPT];           /* arclength along the curve up to each stored point */
    size_t count[QDOT_DIPS_KEPT];          /* number of points of the branch up to each stored point */
    double most[2];                        /* largest magnitude of each of the two test functions so far */
    double careful, until, calm; /* largest step up to arclength `until`; no search for dips up to `calm` */
} qdot_dips;

typedef enum {
    QDOT_DIPS_NONE,
    QDOT_DIPS_AGAIN, /* repeat from the point at[0] with steps of at most `careful` */
    QDOT_DIPS_ZERO   /* the test function vanishes within rounding next to the point at[*place] */
} qdot_dips_answer;

QDOT_MUST_CHECK qdot_status qdot_dips_begin(const qdot_path *x, qdot_dips *d);
void qdot_dips_end(qdot_dips *d);
/* Forget the points before a bifurcation, across which the test functions are not smooth. */
void qdot_dips_forget(qdot_dips *d);
/* Add the point b, which lies at arclength `gone`; `count`: the number of the branch's points including b. */
void qdot_dips_add(const qdot_path *x, qdot_dips *d, const qdot_path_point *b, double gone,
                   size_t count);
/* Look for a dip of a test function; call before b is added. The answer ZERO refers to the determinant only. */
qdot_dips_answer qdot_dips_look(const qdot_path *x, qdot_dips *d, const qdot_path_point *b,
                                double gone, size_t *place);

#endif
