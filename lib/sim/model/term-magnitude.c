/* term-magnitude.c -- the sizes of terms, and their values along a course. */
#include "sim/model/term-magnitude.h"

#include <math.h>

#include "base/interrupt.h"
#include "sim/course/reader.h"

qdot_expr
qdot_size_of(qdot_pool *pool, qdot_expr e)
{
    qdot_expr size;

    if (qdot_expr_kind(pool, e) != QDOT_SUM)
        return qdot_fun1(pool, QDOT_ABS, e);
    size = qdot_fun1(pool, QDOT_ABS, qdot_expr_arg(pool, e, 0));
    for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, e); k += 2)
        size = qdot_add(pool, size,
                        qdot_fun1(pool, QDOT_ABS,
                                  qdot_mul(pool, qdot_expr_arg(pool, e, k),
                                           qdot_expr_arg(pool, e, k + 1))));
    return size;
}

qdot_status
qdot_size_along(const qdot_plan *plan, const qdot_course *course, size_t m,
                const qdot_expr *exprs, size_t k, const double *times, double *sizes)
{
    qdot_expr *e = qdot_malloc((m + 1) * sizeof *e);
    qdot_reader r = {0};
    qdot_tape *tape = NULL;
    bool accelerations;
    qdot_status status = e ? QDOT_OK : QDOT_ENOMEM;

    for (size_t j = 0; j < m && status == QDOT_OK; j++)
        e[j] = qdot_size_of(plan->pool, exprs[j]);
    if (status == QDOT_OK)
        status = qdot_pool_check(plan->pool);
    if (status == QDOT_OK)
        status = qdot_reader_lower(plan, m, e, &tape, &accelerations);
    if (status == QDOT_OK)
        status = qdot_reader_init(&r, plan, tape, course, accelerations);
    for (size_t i = 0; i < k && status == QDOT_OK; i++) {
        status = qdot_interrupt_check();
        if (status == QDOT_OK)
            status = qdot_reader_at(&r, SIZE_MAX, times[i], sizes + i * m);
    }
    qdot_reader_clear(&r);
    qdot_tape_free(tape);
    qdot_free(e);
    return status;
}
