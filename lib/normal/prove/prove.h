/* prove.h -- proofs that two scalars are equal: by the normal form alone, or with all
 * that is known of signs. Tests: tests/normal/test_decide.c */
#ifndef QDOT_NORMAL_PROVE_H
#define QDOT_NORMAL_PROVE_H

#include "normal/field/facts.h"

/* Whether left - right is zero by the normal form, constants and norms of roots
 * (zero.h), modulo the relations of facts (may be NULL). Errors: QDOT_ENOMEM, QDOT_EINTR,
 * the pool's. */
QDOT_MUST_CHECK qdot_status qdot_prove_equal(qdot_pool *pool, qdot_expr left,
                                             qdot_expr right, const qdot_facts *facts,
                                             bool *equal);

/* The same of prepared sides, with expressions that are known to be > 0; `sure`: on the whole of the
 * declared domain. */
QDOT_MUST_CHECK qdot_status qdot_prove_given(qdot_pool *pool, qdot_expr left,
                                             qdot_expr right, size_t n_positive,
                                             const qdot_expr *positive, bool sure,
                                             bool *equal);

/* The same after functions are written by others (rewrite.h), conditions and bounds are
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
