/* zeros-task.h -- the question and the state of the search for all zeros. Internal to zeros*.c. */
#ifndef QDOT_NORMAL_ZEROS_TASK_H
#define QDOT_NORMAL_ZEROS_TASK_H

#include "normal/solve/zeros-parts.h"

enum { QDOT_ZEROS_SYSTEMS = 64 };

/* A zero, and the index of the system of equations in which it was found. */
typedef struct {
    qdot_zero_place place;
    size_t system;
} qdot_zeros_member;

typedef struct {
    qdot_pool *pool;
    size_t n;
    const qdot_expr *F, *x;
    const qdot_zeros_range *range;
    qdot_interval bounds[QDOT_ZEROS_MOST_UNKNOWNS]; /* [n] bounds of the search, rounded outward to doubles */
    qdot_interval lo[QDOT_ZEROS_MOST_UNKNOWNS],
        hi[QDOT_ZEROS_MOST_UNKNOWNS]; /* [n] lo, hi: enclosures of the exact ends of the search */
    qdot_expr ends[QDOT_ZEROS_MOST_UNKNOWNS];                  /* [n] a LIST of the exact ends */
    qdot_expr f[QDOT_ZEROS_SYSTEMS][QDOT_ZEROS_MOST_UNKNOWNS]; /* systems of equations whose zeros together are those of F */
    size_t systems;
    qdot_vec(qdot_enclosure *) held; /* with one unknown: where these are positive every point is a zero */
    qdot_vec(qdot_zeros_member) found;
    qdot_vec(qdot_zero_box) doubt;
    uint64_t budget, spent, evaluations;
    bool exhausted, beyond;
    bool single, nowhere; /* a power in F may be real at isolated points only; F may be undefined elsewhere */
} qdot_zeros_task;

/* Defined in zeros-places.c: */
/* Find exact values, value [n], of a zero of f [n] within its error radius; *found: this succeeded. */
QDOT_MUST_CHECK qdot_status qdot_zeros_exact_place(const qdot_zeros_task *t,
                                                   const qdot_expr *f,
                                                   const qdot_zero_place *p,
                                                   qdot_expr *value, bool *found);
/* A zero p of the system: into the list, unless it is outside, known, or F is not defined there. `again`: it
 * may have been found before in the same system. */
QDOT_MUST_CHECK qdot_status qdot_zeros_add(qdot_zeros_task *t, size_t system,
                                           qdot_zero_place p, bool again);

#endif
