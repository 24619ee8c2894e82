/* normal-form.h -- the normal form of a field as an expression. */
#ifndef QDOT_NORMAL_NORMAL_FORM_H
#define QDOT_NORMAL_NORMAL_FORM_H

#include "normal/field/facts.h"

/* The exact normal form as an expression: numerator over denominator, coprime, expanded. */
qdot_expr qdot_normal(qdot_pool *pool, qdot_expr e, const qdot_facts *facts);

#endif
