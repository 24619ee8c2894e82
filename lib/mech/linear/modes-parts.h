/* modes-parts.h -- what the files about normal modes share. Internal to mech/linear. */
#ifndef QDOT_MECH_MODES_PARTS_H
#define QDOT_MECH_MODES_PARTS_H

#include "base/memory.h"
#include "mech/linear/linear-motion.h"

enum { QDOT_MODES_MOST_EXACT = 6 }; /* a characteristic polynomial of up to this degree is solved */

typedef struct {
    qdot_scene *s;
    qdot_pool *pool;
    qdot_facts facts;
    qdot_binder bind;
    void *user;
    qdot_linear_motion m;
    bool bound_by_velocities; /* some constraint is not holonomic: H need not be symmetric */
    bool symmetric;  /* H is symmetric: modes of different frequencies are orthogonal in M */
    bool gyroscopic; /* Gamma is not 0, and antisymmetric */
    qdot_vec(qdot_expr) frequency, amplitude;
    bool numeric, unordered;
} qdot_modes_job;

/* A part of the unknowns y that moves on its own: y = B z with a motion M z'' + H z = 0 of z [n]. */
typedef struct {
    size_t n, whole;
    int *B; /* [whole x n] 0, 1 or -1 */
} qdot_modes_part;

typedef qdot_status qdot_modes_each(void *user, const qdot_modes_part *part, bool *go_on);
typedef qdot_status qdot_modes_of_set(void *user, size_t n, const size_t *which, bool *done);

bool qdot_modes_is_zero(const qdot_modes_job *j, qdot_expr e);
/* e with the values of the session; nil stays nil. */
qdot_expr qdot_modes_bound(const qdot_modes_job *j, qdot_expr e);
/* Fail because a root of the characteristic polynomial is not the square of a real frequency. */
QDOT_MUST_CHECK qdot_status qdot_modes_fail_unstable(void);
/* w = sqrt(square), shortened; an error where the square is proved to be negative. */
QDOT_MUST_CHECK qdot_status qdot_modes_frequency(const qdot_modes_job *j, qdot_expr square, qdot_expr *w);
/* Add the mode of frequency w and displacements x = N y, scaled so that the first component of x that is not 0 is 1. */
QDOT_MUST_CHECK qdot_status qdot_modes_add(qdot_modes_job *j, qdot_expr w, const qdot_expr *y);
/* As qdot_modes_add, neither scaled nor shortened. */
QDOT_MUST_CHECK qdot_status qdot_modes_add_as_it_is(qdot_modes_job *j, qdot_expr w, const qdot_expr *y);
/* As qdot_modes_add for x = N (re + i im), divided by its first component. */
QDOT_MUST_CHECK qdot_status qdot_modes_add_complex(qdot_modes_job *j, qdot_expr w, const qdot_expr *re, const qdot_expr *im);
/* As that in numbers: x = N (re + i im), N [coordinates x n]. */
QDOT_MUST_CHECK qdot_status qdot_modes_add_numbers(qdot_modes_job *j, double w, const double *N, const double *re,
                                                   const double *im);
/* A basis z [count x n] of the null space of A [n x n], a vector in each row; A is overwritten, z has room for n vectors. */
QDOT_MUST_CHECK qdot_status qdot_modes_null_space(const qdot_modes_job *j, size_t n, qdot_expr *A, qdot_expr *z, size_t *count);

/* Call `find` for each set of unknowns that M and H [n x n] do not couple with others, while *done. */
QDOT_MUST_CHECK qdot_status qdot_modes_for_sets(size_t n, const qdot_expr *M, const qdot_expr *H, qdot_modes_of_set *find,
                                                void *user, bool *done);
/* Call `each` for the parts into which symmetries of M and H split the unknowns `which` [n]: vectors even or odd under
 * permutations with signs that leave M and H as they are. In M the vectors of different parts are orthogonal. */
QDOT_MUST_CHECK qdot_status qdot_modes_split(const qdot_modes_job *j, size_t n, const size_t *which, const qdot_expr *M,
                                             const qdot_expr *H, qdot_modes_each *each, void *user);

/* Exact modes; *done: all were found. */
QDOT_MUST_CHECK qdot_status qdot_modes_exact(qdot_modes_job *j, bool *done);
/* Modes in numbers, with the values of the session. */
QDOT_MUST_CHECK qdot_status qdot_modes_in_numbers(qdot_modes_job *j);
/* modes-chain.c: the modes of a uniform chain or ring among `which` [n] of the unknowns; *done: it is one. */
QDOT_MUST_CHECK qdot_status qdot_modes_of_chain(qdot_modes_job *j, size_t n, const size_t *which, bool *done);

/* modes-gyroscopic.c: modes with complex amplitudes, exact (*done: they are all found) or in numbers. */
QDOT_MUST_CHECK qdot_status qdot_modes_gyroscopic(qdot_modes_job *j, bool *done);
QDOT_MUST_CHECK qdot_status qdot_modes_gyroscopic_numbers(qdot_modes_job *j, const double *M, const double *Gamma,
                                                          const double *H, const double *N);

#endif
