/* alike.h -- the parts of a motion that are alike: pairs of bodies that attract each other, springs of a net.
 *
 * The accelerations of a motion that are given by rows are mostly sums,
 *
 *     a_i = sum_p c_ip f_p(q, q', t),
 *
 * of what many parts contribute, each a few steps that read nothing but inputs and their own rows. Steps
 * that only add up what parts make, linearly, are `sums`; of the others those that read each other's
 * rows are a part. Parts with the same steps are of one kind, whatever inputs and numbers they have: an
 * executor carries out a step of eight of them by vectors (taylor-alike.h). Steps of a part are ordered by
 * depth, then by what they read and who reads them (colours refined to a fixed number of rounds), so
 * that parts are found alike in whatever order the tape has their steps.
 *
 * Rows of a part are kept for all orders only if a sum of products of orders reads them, or the length of
 * a step does (near.h).
 *
 * Source  Weisfeiler & Leman, Nauchno-Tekh. Inform. 2(9) (1968) 12, for the colours.
 * Tests   tests/series/test_taylor-alike.c
 */
#ifndef QDOT_SERIES_ALIKE_H
#define QDOT_SERIES_ALIKE_H

#include "series/recurrence-operations.h"

/* Where a row of a part is: among those of all orders, among those of the order at hand, among its numbers;
 * NOUGHT: a number as read at orders above 0. */
typedef enum {
    QDOT_ALIKE_ORDERS,
    QDOT_ALIKE_NEWEST,
    QDOT_ALIKE_NUMBER,
    QDOT_ALIKE_NOUGHT,
    QDOT_ALIKE_SPACES
} qdot_alike_space;

typedef struct {
    qdot_alike_space space;
    uint32_t at;
} qdot_alike_place;

/* Steps that several steps of a program have become, beside the recurrences: the first only has order 0; then
 *
 *     to = sum_i x_i^2,   to_i = x_i y,   to = c x^e by  k x_0 to_k = sum_{j=1..k} (j (e + 1) - k) x_j to_{k-j}. */
enum { QDOT_ALIKE_VALUE = QDOT_T_COUNT, QDOT_ALIKE_SQUARES, QDOT_ALIKE_PRODUCTS, QDOT_ALIKE_POWER, QDOT_ALIKE_MOST = 3 };

/* A step of every part of a kind. A row that it does not have is its `to`. */
typedef struct {
    uint16_t op, zero;
    int sign;
    bool second, third, d; /* whether it has these rows */
    qdot_alike_place row[QDOT_OF_ROWS]; /* by their names in recurrence.def, as read at orders above 0 */
    qdot_alike_place first[3];          /* x, y, z as read at order 0 */
    size_t n;                           /* number of rows x_i; those of products and squares: */
    qdot_alike_place to[QDOT_ALIKE_MOST], x[QDOT_ALIKE_MOST];
    double exponent;
    uint32_t partial; /* the first of its partial sums: of each x_i y, of the squares, of the power */
} qdot_alike_step;

/* A row of a part that others read: its parts' coefficients are values number `at` onwards. */
typedef struct {
    qdot_alike_place place;
    uint32_t at;
} qdot_alike_result;

typedef struct {
    size_t parts;
    qdot_vec(qdot_alike_step) steps;
    size_t orders, newest, numbers, inputs; /* how many rows a part has in each space, and inputs */
    size_t partials;                        /* how many sums over orders are made for several orders at once */
    qdot_vec(qdot_alike_place) input;       /* [inputs] where an input of a part is */
    qdot_vec(qdot_program_row) input_rows;  /* [parts x inputs] the inputs */
    qdot_vec(qdot_program_row) number_rows; /* [parts x numbers] rows of the program that have the numbers */
    qdot_vec(qdot_alike_place) summed;      /* pairs: a number that sums of products read, and its row of all orders */
    qdot_vec(qdot_alike_result) results;
    double convolutions; /* of a part */
} qdot_alike_kind;

/* A term of a sum: sign times the number in row `factor` (QDOT_NO_ROW: 1) times value `from`. */
typedef struct {
    uint32_t from;
    qdot_program_row factor;
    int sign;
} qdot_alike_term;

/* The values of an order are: inputs, the number 1, results of kinds (each [parts, rounded up to QDOT_ALIKE_LANES]), sums. */
typedef struct qdot_alike {
    qdot_vec(qdot_alike_kind) kinds;
    qdot_vec(qdot_alike_term) terms;
    qdot_vec(uint32_t) sums; /* [sums + 1] first term of each sum, in an order in which they can be computed */
    uint32_t one, first_sum; /* the values that are the number 1 and the first sum */
    uint32_t *value;         /* [rows] the value that has a row, of inputs, results and sums; UINT32_MAX: none */
    double vectors; /* convolutions of whole vectors of eight lanes */
} qdot_alike;

/* Parts come in groups of so many. */
enum { QDOT_ALIKE_LANES = 16 };

void qdot_alike_free(qdot_alike *alike);
void qdot_alike_kind_clear(qdot_alike_kind *kind);

/* Which rows of a recurrence, by name, are summed over orders or bound the length of a step; those of which order 0
 * alone is read. */
void qdot_alike_reading(int op, unsigned *summed, unsigned *first);

#endif
