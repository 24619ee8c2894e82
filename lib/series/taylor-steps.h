/* taylor-steps.h -- a Taylor program from inside: its steps and rows. Internal to series/.
 * */
#ifndef QDOT_SERIES_TAYLOR_STEPS_H
#define QDOT_SERIES_TAYLOR_STEPS_H

#include "num/series.h"
#include "series/motion.h"

typedef struct qdot_taylor qdot_taylor; /* defined below; the public interface is in taylor.h */

/* A step (operation) with the rows of coefficients that it reads and writes. */
typedef struct {
    uint16_t op, zero; /* its recurrence; how its order 0 is computed, as in qdot_program_step */
    signed char sign, lead;
    unsigned char newest;
    bool kept;
    double *to, *second, *third, *d;
    const double *x, *y, *z;
    double
        c; /* inverse of the step's divisor; for RATE 1/unit, for LINK the unit of time itself */
} qdot_taylor_step;

/* A constant between two doubles, which is rounded at random to one of them. */
struct qdot_taylor_drawn {
    double *row;
    double near, far, chance; /* the two neighbouring doubles; the probability that `far` is taken */
};

/* Unknowns that explicit equations determine at every order (taylor-motion.h). */
typedef struct {
    uint32_t i; /* the product of matrix entry M and unknown a is a part of equation i */
    const double *M, *a;
} qdot_taylor_coupling;

typedef struct {
    size_t n;
    int solved; /* up to this order the Cholesky factor is used, for higher orders the inverse matrix */
    const double **f; /* [n] right-hand sides f; NULL: this equation is not explicit */
    double **a;       /* [n] the rows of the unknowns */
    double **r;       /* [n] scratch: f minus those products M a that are already known */
    qdot_taylor_coupling *couplings; /* [n_couplings] the non-zero products of the equations, ordered by equation i */
    size_t n_couplings;
    double *matrices; /* [n x n] Cholesky factor L of M_0 (order 0 of the matrix), then [n x n] M_0^-1 */
} qdot_taylor_block;

/* An unknown that is solved for: rows of it and of its integrals; NULL: there is none, or a link computes it. */
struct qdot_taylor_unknown {
    double *row, *once, *twice;
    const double *right; /* known part of its equation: f if explicit, else E or the row of which E is a time derivative */
    int rates;           /* how many time derivatives lead from the row `right` to E */
    bool is_explicit;
};

/* A row of an unknown, or of its integral, whose newest coefficient is read by steps. */
struct qdot_taylor_newest {
    double *row, *change; /* the coefficients of the row; the change of the newest one, if steps read it */
    int lead;
};

/* A function that computes coefficient k of a step's rows, for one k known at compile time. */
typedef void qdot_taylor_function(qdot_taylor_step *step, const qdot_series_kernels *kernels);

struct qdot_taylor {
    const qdot_motion *motion; /* the motion that is computed, borrowed; NULL: only a tape */
    double unit;               /* the unit of time of the present step */
    const qdot_series_kernels *kernels;
    /* [order][recurrence] the functions that compute one coefficient */
    qdot_taylor_function *const (*functions)[QDOT_T_COUNT];
    size_t stride, inputs, outputs, rows;
    size_t moving; /* how many of the inputs vary in time; these come first */
    size_t spare;  /* index of the first row that is free for unknowns and their integrals */
    double convolutions;
    double *allocated;
    double *coefficients; /* [rows x stride] coefficients, inputs first; order 1 of each row is at the start of a cache line */
    uint64_t per_row; /* 2^32/stride rounded up, by which the index of a row is found without a division */
    const double **output;    /* [outputs] the row of coefficients of each output */
    bool *constant;           /* [outputs] whether the output is constant */
    qdot_taylor_step *steps; /* [length + n_links] the steps of the program, then integrals (links), then QDOT_T_END */
    size_t length, n_links;
    size_t still; /* number of leading steps whose rows are constant: these have only order 0 */
    qdot_taylor_block *blocks; /* [n_blocks] blocks of coupled explicit equations */
    size_t n_blocks;
    const double **negated; /* [rows] for entries of K: the row whose negative this row is, or NULL */
    struct qdot_taylor_products *products; /* products for the blocks of equations (taylor-products.h); NULL: none */
    struct qdot_taylor_drawn *drawn; /* [n_drawn] constants rounded at random */
    size_t n_drawn;
    struct qdot_taylor_unknown *unknowns; /* [solved] the unknowns of the motion */
    struct qdot_taylor_newest *newest; /* [n_newest] rows whose newest coefficients change when the unknowns are found */
    size_t n_newest;
    struct qdot_taylor_changes *changes; /* used by taylor-correct.c; NULL: no corrections were requested */
    struct qdot_taylor_code *code; /* machine code (taylor-code.c); NULL: not used */
    const char *no_code;           /* why there is no machine code; NULL: none was requested */
    bool asked;                    /* it has been tried to find machine code of an earlier run */
    bool refused;                  /* machine code must not be generated */
};

/* Allocate rows for `most` orders, with `spare` further rows, and `more` doubles behind all rows. */
QDOT_MUST_CHECK qdot_status qdot_taylor_settle(qdot_taylor *t, const qdot_program *p,
                                               int most, size_t spare, size_t more,
                                               bool shaken);
/* Make the blocks of coupled explicit equations of the motion. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_solve_motion(qdot_taylor *t, int solved);
/* Find the unknowns of the motion; `linked`: their integrals are computed as links. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_find_unknowns(qdot_taylor *t, bool linked);
/* Equations that are rates of a row become that row; steps go which only write explicit equations, such
 * rates, or an entry of K that is another one negated. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_shorten(qdot_taylor *t);
/* Find the rows of unknowns whose newest coefficients are read by steps. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_taylor_find_newest(qdot_taylor *t);
static inline double *
qdot_taylor_place(const qdot_taylor *t, qdot_program_row r)
{
    return r == QDOT_NO_ROW ? NULL : t->coefficients + (size_t)r * t->stride;
}

/* Compute the coefficients of order 0 of the rows that a step writes. */
void qdot_taylor_value(qdot_taylor_step *step);

static inline uint32_t
qdot_taylor_row(const qdot_taylor *t, const double *row)
{
    return (uint32_t)((uint64_t)(row - t->coefficients) * t->per_row >> 32);
}

void qdot_taylor_changes_free(qdot_taylor *t);
/* Record that order k is being computed, after which factors of changes must be computed again. */
void qdot_taylor_changes_stale(qdot_taylor *t, int k);
/* Compute those coefficients of integrals (links) that follow from order k of the integrands. */
void qdot_taylor_order_links(qdot_taylor *t, int k);
/* Compute all steps of a motion at stage k, each at order k plus its lead. */
void qdot_taylor_order_leading(qdot_taylor *t, int k);
/* Choose the functions that compute the orders of steps on this processor. */
void qdot_taylor_find_functions(qdot_taylor *t);
/* The steps of a motion that are kept are to follow changes. Where by how much the newest coefficient
 * of a row changes is to be put; then what those steps make of all that. */
QDOT_MUST_CHECK qdot_status qdot_taylor_follow_motion(qdot_taylor *t);
double *qdot_taylor_change_of(const qdot_taylor *t, const double *row);
void qdot_taylor_follow(qdot_taylor *t, int k);

#endif
