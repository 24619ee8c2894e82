/* prove.h -- proofs that two scalars are equal, with all that is known of signs and domains. Tests:
 * tests/normal/prove/test_decide.c */
#ifndef QDOT_NORMAL_PROVE_H
#define QDOT_NORMAL_PROVE_H

#include "normal/field/facts.h"

/* Whether left = right (equal.h) after functions are written by others (rewrite.h), conditions and bounds are
 * put into the symbols (domain.h), and equal arguments are made one (unify.h). */
QDOT_MUST_CHECK qdot_status qdot_prove_harder(qdot_pool *pool, qdot_expr left,
                                              qdot_expr right, const qdot_facts *facts,
                                              bool *equal);

/* The same with what holds wherever both sides have values (defined.h). *empty, where not NULL: the
 * conditions leave no point, and *equal is true of that. */
QDOT_MUST_CHECK qdot_status qdot_prove_defined(qdot_pool *pool, qdot_expr left,
                                               qdot_expr right, const qdot_facts *facts,
                                               bool *equal, bool *empty);

#endif
