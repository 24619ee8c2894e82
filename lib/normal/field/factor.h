/* factor.h -- factors of polynomials in a field, grouping of terms, the other
 * trigonometric form. */
#ifndef QDOT_NORMAL_FACTOR_H
#define QDOT_NORMAL_FACTOR_H

#include "normal/field/field.h"

/* content * prod poly[i]^exp[i]; every poly primitive, its leading coefficient
 * positive. */
typedef struct {
    fmpz_t content;
    fmpz_mpoly_struct *poly;
    slong *exp;
    slong n;
    bool complete; /* every factor poly[i] is irreducible */
} qdot_factors;

/* Factor p, not zero; if that exceeds the bounds only integers and generators are split off. */
QDOT_MUST_CHECK qdot_status qdot_factor(qdot_field *f, qdot_factors *out,
                                        const fmpz_mpoly_t p);
/* Multiply factors with equal exponents if the product has no more terms than one of them:
 * (x - 1)*(x + 1) as x^2 - 1. Returns whether there were any. */
bool qdot_factor_join(qdot_field *f, qdot_factors *factors);
void qdot_factor_clear(qdot_field *f, qdot_factors *out);

/* Terms of a polynomial grouped by their exponents in some variables. */
typedef struct {
    ulong *key;              /* [n x gens] exponents in the chosen variables, 0 for the others */
    fmpz_mpoly_struct *poly; /* [n] coefficient of each group, without the chosen variables */
    slong n;
} qdot_groups;

/* Group the terms by their exponents in the variables by[gens]; groups are in the order of leading terms. */
QDOT_MUST_CHECK qdot_status qdot_factor_group(qdot_field *f, qdot_groups *out,
                                              const fmpz_mpoly_t p, const bool *by);
void qdot_factor_ungroup(qdot_field *f, qdot_groups *out);

/* Set r to p with c^2 replaced by 1 - s^2 (C^2 by 1 + S^2); c: the variable of a cosine. */
QDOT_MUST_CHECK qdot_status qdot_factor_flip(qdot_field *f, fmpz_mpoly_t r,
                                             const fmpz_mpoly_t p, slong c);
#endif
