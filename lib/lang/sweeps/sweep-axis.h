/* sweep-axis.h -- what a sweep runs over: parameters and initial values.
 *
 *     NAME = A..B step H       A, A + H, ... up to B
 *     NAME = A..B count N      N values, ends included
 *     NAME = [V1, V2, ...]
 *     NAME = normal(MEAN, DEVIATION)     all random ones together: `count N` members
 *     NAME = uniform(A, B)               `seed K`: 0 unless said
 *
 * Axes that are not random are combined, the last the fastest. Random numbers are those of the
 * Mersenne twister (GSL), drawn member by member, axis by axis.
 *
 * Tests  tests/script/sweeps/sweep.sh, tests/bad/sweeps/sweep-*.lag
 */
#ifndef QDOT_LANG_SWEEP_AXIS_H
#define QDOT_LANG_SWEEP_AXIS_H

#include "lang/syntax/record.h"

typedef enum { QDOT_AXIS_LADDER, QDOT_AXIS_LIST, QDOT_AXIS_NORMAL, QDOT_AXIS_UNIFORM } qdot_axis_kind;

typedef struct {
    const qdot_filled *place; /* the name of the swept parameter in the statement */
    char *label;
    qdot_expr symbol; /* the symbol varied: a parameter, coordinate or velocity */
    qdot_axis_kind kind;
    size_t n;             /* number of values; 0: random values */
    qdot_expr from, step; /* for LADDER: first value and increment */
    qdot_expr list;       /* for LIST: the values, as a LIST */
    double a, b;          /* NORMAL: mean and standard deviation; UNIFORM: the limits */
} qdot_sweep_axis;

typedef struct {
    qdot_vec(qdot_sweep_axis) at;
    size_t members;
    bool random;
    uint64_t seed;
    double *drawn; /* [members x axes] values of the random axes, for each run (member) of the sweep; NULL: none */
} qdot_sweep_axes;

/* The usage text of the axes of a sweep: its swept parameters and their values. */
#define QDOT_SWEEP_AXES "NAME = A..B [step H] [count N] [seed K], ..."
/* The axes among the parts [from, to), from {0}, with `count` and `seed`; draw what is random; free them in
 * any case. QDOT_ELIMIT: more than 10^7 members. */
QDOT_MUST_CHECK qdot_status qdot_sweep_axes_find(qdot_record *r, const qdot_filled *from,
                                                 const qdot_filled *to, qdot_sweep_axes *axes);
void qdot_sweep_axes_free(qdot_sweep_axes *axes);

/* The exact value of swept parameter i for a run (member) of the sweep. Nil: the pool failed. */
qdot_expr qdot_sweep_axes_value(qdot_session *session, const qdot_sweep_axes *axes, size_t member,
                                size_t i);

#endif
