/* polynomials.h -- a set of polynomials of one field, found by value in a hash table. */
#ifndef QDOT_NORMAL_POLYNOMIALS_H
#define QDOT_NORMAL_POLYNOMIALS_H

#include "normal/field/field.h"

/* Start with `qdot_polynomials t = {0};`. */
typedef struct {
    fmpz_mpoly_struct *at; /* [n] the polynomials */
    uint64_t *hash;        /* [n] their hash values */
    uint32_t *place; /* [places] open hash table; an entry is the index in `at` + 1, 0: free */
    size_t n, places, at_capacity, hash_capacity;
} qdot_polynomials;

/* The index of p in the set; -1 if it is not there. */
slong qdot_polynomials_find(qdot_field *f, const qdot_polynomials *t, const fmpz_mpoly_t p);
/* Add p, which must not be in the set, at index t->n. Errors: QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_polynomials_add(qdot_field *f, qdot_polynomials *t,
                                                 const fmpz_mpoly_t p);
void qdot_polynomials_clear(qdot_field *f, qdot_polynomials *t);

#endif
