/* equal.h -- proofs that two scalars are equal by the normal form, constants and norms of roots
 * (zero.h). Tests: tests/normal/prove/test_decide.c */
#ifndef QDOT_NORMAL_EQUAL_H
#define QDOT_NORMAL_EQUAL_H

#include "base/memory.h"
#include "normal/field/facts.h"

/* A procedure that proves left = right: *equal. Errors: QDOT_ENOMEM, QDOT_EINTR, the pool's. */
typedef qdot_status (*qdot_prover)(qdot_pool *pool, qdot_expr left, qdot_expr right,
                                   const qdot_facts *facts, bool *equal);

/* Whether left - right is zero by the normal form, constants and norms of roots, modulo the
 * relations of facts (may be NULL). Errors: QDOT_ENOMEM, QDOT_EINTR, the pool's. */
QDOT_MUST_CHECK qdot_status qdot_prove_equal(qdot_pool *pool, qdot_expr left,
                                             qdot_expr right, const qdot_facts *facts,
                                             bool *equal);

/* The same of prepared sides, with expressions that are known to be > 0; `sure`: on the whole of the
 * declared domain. */
QDOT_MUST_CHECK qdot_status qdot_prove_given(qdot_pool *pool, qdot_expr left,
                                             qdot_expr right, size_t n_positive,
                                             const qdot_expr *positive, bool sure,
                                             bool *equal);

/* --- the steps of a proof, for prove.c --------------------------------------------------- */

/* e: left, right, then nr relations, then np positive expressions; `conditional`: some of these
 * come from conditions. */
typedef struct {
    qdot_pool *pool;
    size_t nr, np;
    bool conditional;
    qdot_expr *e;
} qdot_problem;

static inline size_t
qdot_problem_count(const qdot_problem *p)
{
    return 2 + p->nr + p->np;
}

/* Begin a proof; call qdot_problem_finish after every begin: it returns the status of the proof. */
QDOT_MUST_CHECK qdot_status qdot_problem_begin(qdot_problem *p, qdot_pool *pool, qdot_expr left,
                                               qdot_expr right, const qdot_facts *facts);
QDOT_MUST_CHECK qdot_status qdot_problem_finish(qdot_problem *p, qdot_status status);

/* Record bases of roots that are obviously positive, because after expansion that is hard to see. */
QDOT_MUST_CHECK qdot_status qdot_problem_note_positive(qdot_problem *p);

/* Prepare all expressions for a field; QDOT_EFAILED if one is undefined (a zero denominator). */
QDOT_MUST_CHECK qdot_status qdot_problem_prepare(qdot_problem *p);

/* Whether the difference is zero in a field of all of them. `signs`: with roots and
 * constants. */
QDOT_MUST_CHECK qdot_status qdot_problem_in_field(qdot_problem *p, bool signs, bool *zero);

#endif
