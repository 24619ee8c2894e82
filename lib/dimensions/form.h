/* form.h -- affine forms of unknown dimensions, and their elimination. Inside of this room.
 *
 *     f = constant + sum of x_i * dim(unknown i)
 */
#ifndef QDOT_DIMENSIONS_FORM_H
#define QDOT_DIMENSIONS_FORM_H

#include "base/memory.h"
#include "units/dimension.h"

typedef struct {
    uint32_t unknown;
    qdot_exponent x;
} qdot_form_term;

typedef struct qdot_form {
    qdot_dimension constant;
    bool any;   /* the dimension of 0: every one */
    bool none;  /* no scalar: it has no dimension */
    uint32_t n;
    qdot_form_term at[]; /* [n] ascending by their unknowns */
} qdot_form;

/* Forms, which live as long as their owner; for each unknown that was eliminated the form that it equals. */
typedef struct {
    qdot_vec(qdot_form *) all;
    qdot_vec(const qdot_form *) row; /* of unknown i; NULL: it is free */
    size_t rank;
} qdot_forms;

void qdot_forms_clear(qdot_forms *f);
/* A further unknown: its number. */
QDOT_MUST_CHECK qdot_status qdot_forms_unknown(qdot_forms *f, uint32_t *unknown);

/* Each is NULL without memory, or where an exponent grew too large. */
const qdot_form *qdot_form_constant(qdot_forms *f, qdot_dimension constant);
const qdot_form *qdot_form_any(qdot_forms *f);
const qdot_form *qdot_form_none(qdot_forms *f);
const qdot_form *qdot_form_unknown(qdot_forms *f, uint32_t unknown);
const qdot_form *qdot_form_addmul(qdot_forms *f, const qdot_form *a, const qdot_form *b, qdot_exponent x);
/* a without eliminated unknowns. */
const qdot_form *qdot_form_reduce(qdot_forms *f, const qdot_form *a);

/* a = b. *agree: false where that contradicts; then nothing changes. */
QDOT_MUST_CHECK qdot_status qdot_forms_join(qdot_forms *f, const qdot_form *a, const qdot_form *b, bool *agree);

#endif
