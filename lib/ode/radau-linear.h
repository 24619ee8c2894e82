/* radau-linear.h -- slopes of a system, and the linear equations of a step by Radau IIA.
 *
 * The unknowns of a stage are its velocities and multipliers, m of them (system.h,
 * qdot_ode_mass_form); positions follow from these. In the eigenvectors of the basis the equations of all stages come apart into
 *
 *     (lambda_k/h M - Dv - h/lambda_k Dq) x = b,
 *
 * one real and up to three complex systems of m unknowns.
 *
 * Tests  tests/ode/test_radau.c
 */
#ifndef QDOT_ODE_RADAU_LINEAR_H
#define QDOT_ODE_RADAU_LINEAR_H

#include <stdbool.h>

#include "num/lu.h"
#include "ode/radau-basis.h"
#include "ode/system.h"

typedef struct {
    const qdot_ode_system *system; /* the system to be integrated; borrowed */
    size_t m, v, p; /* number of unknowns; of velocities, which come first among these; of positions, v or 0 */
    double *room;                  /* the allocated block that holds the arrays of doubles */
    double *dq, *dv, *mass;        /* [m x m] derivatives of f - M a by q and by v; mass matrix M */
    double *dt;                    /* [m] scratch */
    double *re[QDOT_RADAU_SPACES],
        *im[QDOT_RADAU_SPACES]; /* [m x m] LU factors for each eigenspace, real and imaginary parts; im[0] is NULL */
    qdot_lu_row *rows[QDOT_RADAU_SPACES];
    bool *pattern;   /* [m x m] which entries have ever been non-zero, or their transposes have */
    size_t *order;   /* [m] order of the unknowns that keeps the factors sparse */
    size_t *scratch; /* [m] scratch */
    double *put[2];  /* [m] a right-hand side in this order: real part, imaginary part */
    const qdot_radau_basis *basis; /* the Radau method for which the matrices are factored */
} qdot_radau_linear;

/* Allocate the arrays of l. Errors: QDOT_ENOMEM; clear l in any case. */
QDOT_MUST_CHECK qdot_status qdot_radau_linear_init(qdot_radau_linear *l,
                                                   const qdot_ode_system *system);
void qdot_radau_linear_clear(qdot_radau_linear *l);

/* r [m] = f - M a at (t, y), with multipliers z. Errors: those of f; QDOT_EDOMAIN if it is not
 * finite. */
QDOT_MUST_CHECK qdot_status qdot_radau_residual(const qdot_radau_linear *l, double t,
                                                const double *y, const double *a,
                                                const double *z, double *r);

/* Evaluate the derivatives of f - M a at (t, y, a), and the multipliers there. Same errors. */
QDOT_MUST_CHECK qdot_status qdot_radau_slopes(qdot_radau_linear *l, double t,
                                              const double *y, const double *a, double *z);

/* Factor the matrices of all eigenspaces for a step h. False if a matrix is singular. */
bool qdot_radau_factor(qdot_radau_linear *l, const qdot_radau_basis *basis, double h);

/* Solve with the factored matrix of eigenspace k; im is not read for k = 0. */
void qdot_radau_solve(const qdot_radau_linear *l, size_t k, double *re, double *im);

/* Estimate the rounding error of f - M a that is caused by rounding of y, a and z: b [m], of either sign. */
void qdot_radau_noise(const qdot_radau_linear *l, const double *y, const double *a,
                      const double *z, double *b);

/* Multiply vectors by the matrices: b = M v + Dq q; if q is NULL, without the second term. */
void qdot_radau_weigh(const qdot_radau_linear *l, const double *v, const double *q,
                      double *b);

#endif
