/* exponents.h -- Lyapunov exponents, by the variational equations (variation.h).
 *
 * The slopes y of 1, or of 2 (n - m), directions are integrated along with the motion, and made
 * orthonormal anew (y = Q R, Gram and Schmidt) whenever one has grown or shrunk by far, and at the ends
 * of windows of equal length. With R_ii of all that lie in a time,
 *
 *     lambda_i = sum ln R_ii / time
 *
 * over the run without its first tenth. The error has two parts: three times the standard error of the mean of
 * windows, gathered in blocks of 1, 2, 4 and 8, the largest of these; how far the second half is from
 * the first: of regular motion lambda falls as ln(t)/t; instead of the first, if more, four times what the longest episode above or below the mean
 * changes it by: chaotic motion that sticks to regular one has few of these, of any length. A run that has seen only one
 * kind of motion tells nothing of the other.
 *
 * Source  Benettin, Galgani, Giorgilli, Strelcyn, Meccanica 15 (1980) 9 and 21.
 * Tests   tests/sim/study/test_exponents.c, tests/script/studies/lyapunov.sh
 */
#ifndef QDOT_SIM_EXPONENTS_H
#define QDOT_SIM_EXPONENTS_H

#include "mech/scene/scene.h"
#include "sim/model/request.h"

enum { QDOT_EXPONENTS_WINDOWS = 100 };

typedef struct {
    bool spectrum; /* requested: compute all exponents; false: only the largest */

    size_t n; /* number of exponents */
    double *value,
        *error; /* [n] exponents in descending order; their errors, NaN where the run ended too soon */
    size_t windows;    /* number of completed windows */
    double *t;         /* [windows] time since the start at the end of each window */
    double *course; /* [windows x n] estimates of the exponents at the end of each window: sum of logarithms / t */
    double steps, cpu; /* steps of the integration; its CPU seconds */
    bool interrupted;
} qdot_exponents;

/* Find them along the run of the request. Clear *x in any case. Errors: those of qdot_variation_make, of
 * the run; QDOT_EFAILED where it ended too soon. */
QDOT_MUST_CHECK qdot_status qdot_exponents_find(qdot_scene *scene,
                                                const qdot_run_request *request,
                                                qdot_exponents *x);
void qdot_exponents_clear(qdot_exponents *x);

/* Find the mean of x [n] and its error, estimated from the means of blocks of values. */
void qdot_exponents_mean(size_t n, const double *x, double *mean, double *error);

#endif
