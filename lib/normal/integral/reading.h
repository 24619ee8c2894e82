/* reading.h -- an integrand as a rational function of x and of functions of x.
 *
 *     e = rest numerator / prod base^power
 *
 * The functions of x that occur - roots, exponentials, sines and cosines of base angles, logarithms ... - are the
 * generators of a field (field.h) that hold x; in numerator and bases each has a symbol in its place. The bases
 * are irreducible polynomials.
 */
#ifndef QDOT_INTEGRAL_READING_H
#define QDOT_INTEGRAL_READING_H

#include "normal/field/ratio.h"
#include "normal/integral/task.h"

enum { QDOT_READING_GENERATORS = 8, QDOT_READING_FACTORS = 12 };

typedef struct {
    int n; /* number of generators that hold x, x itself not counted */
    struct {
        qdot_gen_kind kind;
        qdot_expr expr;   /* the function of x */
        qdot_expr of;     /* its argument: the base of a root, the base angle of a sine, cosine or exponential */
        uint32_t order;   /* of a root */
        qdot_expr symbol; /* stands for it */
    } generator[QDOT_READING_GENERATORS];
    bool bare; /* x occurs outside of the generators */
    qdot_expr rest, numerator;
    int factors;
    struct {
        qdot_expr base;
        int64_t power;
    } factor[QDOT_READING_FACTORS];
} qdot_reading;

/* Read e; false: too large, or undefined. */
bool qdot_reading_make(qdot_integral_task *t, qdot_expr e, qdot_expr x, qdot_reading *reading);

/* Denominator as one expression. */
qdot_expr qdot_reading_denominator(qdot_integral_task *t, const qdot_reading *reading);

#endif
