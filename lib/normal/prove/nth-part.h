/* nth-part.h -- relations between functions of the n-th part of an inverse function and that
 * function.
 *
 *     T_n(cos h) = cos(n h),   sin h U_(n-1)(cos h) = sin(n h),   h = acos(u)/n and alike,
 *
 * by Chebyshev's T_n and U_n; for cosh and sinh T_n(cosh h), sinh h U_(n-1)(cosh h). The right
 * sides are functions of u alone (prepare.h), so both are polynomial relations. Halves are roots
 * and handled already.
 *
 * Source  Abramowitz & Stegun, Handbook of Mathematical Functions, 22.3.15-16.
 * Tests   tests/script/prove/identities-inverse.inc
 */
#ifndef QDOT_NORMAL_NTH_PART_H
#define QDOT_NORMAL_NTH_PART_H

#include "base/memory.h"
#include "expr/id.h"

typedef qdot_vec(qdot_expr) qdot_nth_parts;

/* Add the relations, each 0, for the functions in e[n]. Errors: QDOT_ENOMEM, QDOT_EINTR; the pool
 * may keep a failure. */
QDOT_MUST_CHECK qdot_status qdot_nth_part_relations(qdot_pool *pool, size_t n, const qdot_expr *e,
                                            qdot_nth_parts *relations);

#endif
