/* rotation.c -- proves that matrices are rotations, by the matrices that they were made of or by their entries. */
#include "mech/scene/rotation.h"

#include "base/memory.h"
#include "expr/build.h"
#include "expr/factors.h"
#include "expr/memo.h"
#include "expr/node.h"
#include "expr/tensor.h"
#include "mech/scene/constraint.h"
#include "normal/prove/decide.h"

static qdot_status
is_equal_everywhere(qdot_pool *pool, qdot_expr e, qdot_expr value, bool *is)
{
    qdot_decision seen = {.verdict = QDOT_UNDECIDED};
    qdot_status status = *is ? qdot_decide_equal(pool, e, value, NULL, &seen) : QDOT_OK;

    *is = seen.verdict == QDOT_PROVED;
    return status;
}

/* *proved: the entries of R are those of a rotation in the declared domains, whatever the scene's constraints. */
static qdot_status
prove_entries(qdot_pool *pool, qdot_expr R, bool *proved)
{
    const qdot_expr RtR = qdot_value_mul(pool, qdot_transpose(pool, R), R);
    const qdot_expr det = qdot_det(pool, R);

    *proved = true;
    QDOT_TRY(qdot_pool_check(pool));
    for (uint32_t i = 0; i < 3; i++)
        for (uint32_t j = i; j < 3; j++)
            QDOT_TRY(is_equal_everywhere(pool, qdot_expr_arg(pool, RtR, 3 * i + j), i == j ? QDOT_ONE : QDOT_ZERO,
                                         proved));
    return is_equal_everywhere(pool, det, QDOT_ONE, proved);
}

/* *proved for a matrix that was made of no others; the answer is kept. */
static qdot_status
prove_factor(qdot_pool *pool, qdot_expr R, bool *proved)
{
    if (qdot_memo_find(pool, R, QDOT_MEMO_ROTATION, proved, sizeof *proved))
        return QDOT_OK;
    QDOT_TRY(prove_entries(pool, R, proved));
    qdot_memo_keep(pool, R, QDOT_MEMO_ROTATION, proved, sizeof *proved);
    return QDOT_OK;
}

typedef qdot_vec(qdot_expr) matrices;

static qdot_status
add_matrix(matrices *list, qdot_expr matrix)
{
    for (size_t i = list->n; i-- > 0;)
        if (list->at[i] == matrix)
            return QDOT_OK;
    return qdot_vec_push(list, matrix);
}

/* *proved: R was made of rotations. Matrices that were made of others are looked into from the newest to the oldest;
 * `made` has those found. */
static qdot_status
prove_product(qdot_pool *pool, qdot_expr R, bool *proved)
{
    matrices made = {0};
    qdot_expr parts[2];
    qdot_status status = QDOT_OK;

    *proved = qdot_factors_of(pool, R, &parts[0], &parts[1]);
    if (*proved)
        status = add_matrix(&made, R);
    for (size_t i = 0; i < made.n && *proved && status == QDOT_OK; i++) {
        (void)qdot_factors_of(pool, made.at[i], &parts[0], &parts[1]);
        for (int k = 0; k < 2 && parts[k] != QDOT_NIL && *proved && status == QDOT_OK; k++) {
            bool known = false;
            qdot_expr a, b;

            if (qdot_memo_find(pool, parts[k], QDOT_MEMO_ROTATION, &known, sizeof known) && known)
                continue;
            if (qdot_factors_of(pool, parts[k], &a, &b))
                status = add_matrix(&made, parts[k]);
            else
                status = prove_factor(pool, parts[k], proved);
        }
    }
    for (size_t i = 0; i < made.n && *proved && status == QDOT_OK; i++)
        qdot_memo_keep(pool, made.at[i], QDOT_MEMO_ROTATION, proved, sizeof *proved);
    qdot_free(made.at);
    return status;
}

/* R^T R = 1 and det R = 1 by the entries of R. */
static qdot_status
check_entries(qdot_scene *s, qdot_expr R)
{
    qdot_pool *pool = s->pool;
    qdot_expr RtR = qdot_value_mul(pool, qdot_transpose(pool, R), R);
    qdot_expr *relations = NULL;
    qdot_facts facts;
    qdot_status status = qdot_constraint_facts(s, &relations, &facts);

    for (uint32_t i = 0; i < 3 && status == QDOT_OK; i++)
        for (uint32_t j = i; j < 3 && status == QDOT_OK; j++) {
            qdot_decision seen;

            status = qdot_decide_equal(pool, qdot_expr_arg(pool, RtR, 3 * i + j),
                                       i == j ? QDOT_ONE : QDOT_ZERO, &facts, &seen);
            if (status == QDOT_OK && seen.verdict == QDOT_REFUTED)
                status = qdot_fail(QDOT_EDOMAIN,
                                   "not a rotation: columns %u and %u are not %s", i + 1,
                                   j + 1, i == j ? "of length 1" : "at right angles");
        }
    if (status == QDOT_OK) {
        qdot_expr det = qdot_det(pool, R);
        qdot_decision seen;

        status = qdot_pool_check(pool);
        if (status == QDOT_OK)
            status = qdot_decide_equal(pool, det, QDOT_MINUS_ONE, &facts, &seen);
        if (status == QDOT_OK && seen.verdict == QDOT_PROVED)
            status = qdot_fail(QDOT_EDOMAIN, "not a rotation: a reflection");
    }
    qdot_free(relations);
    return status;
}

qdot_status
qdot_rotation_check(qdot_scene *s, qdot_expr R)
{
    bool proved = false;

    QDOT_TRY(qdot_pool_check(s->pool));
    QDOT_TRY(prove_product(s->pool, R, &proved));
    return proved ? QDOT_OK : check_entries(s, R);
}
