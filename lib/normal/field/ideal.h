/* ideal.h -- relations between generators: a small Groebner basis within a budget.
 *
 * Membership is a proof whatever the order: p = sum q_i b_i, every b_i zero where the
 * relations hold. Factors known not to vanish are taken out of relations (saturation).
 */
#ifndef QDOT_NORMAL_IDEAL_H
#define QDOT_NORMAL_IDEAL_H

#include "normal/field/field.h"

/* Start with `qdot_ideal i = {0};`. */
typedef struct {
    fmpz_mpoly_struct **poly; /* [n] the polynomials of the Groebner basis */
    size_t n, capacity;
    bool generic; /* no relation contains parameters only */
} qdot_ideal;

/* Make the ideal of relation[n] (numerators of their values in f) and of f's rules. */
QDOT_MUST_CHECK qdot_status qdot_ideal_make(qdot_ideal *ideal, qdot_field *f, size_t n,
                                            const qdot_expr *relation);
void qdot_ideal_clear(qdot_ideal *ideal, qdot_field *f);

/* s p = remainder + element of the ideal, s a positive integer; nothing if there are no
 * relations. */
void qdot_ideal_reduce(const qdot_ideal *ideal, qdot_field *f, fmpz_t s, fmpz_mpoly_t p);

/* Reduce *r modulo relation[n], each the numerator of its value in f; unchanged if that would
 * make its denominator 0 or fails. Errors: those of qdot_ideal_make. */
qdot_status qdot_ideal_reduce_ratio(qdot_field *f, qdot_ratio *r, size_t n,
                                    const qdot_expr *relation);

#endif
