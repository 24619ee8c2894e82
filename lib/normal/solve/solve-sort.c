/* solve-sort.c -- sorts solutions by their values. */
#include "base/memory.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "normal/refute/sample.h"
#include "normal/solve/solve.h"

qdot_status
qdot_solve_sort(qdot_pool *pool, size_t n, qdot_root *roots)
{
    double *v = qdot_calloc(n + 1, sizeof *v);
    qdot_status status = v == NULL ? QDOT_ENOMEM : QDOT_OK;
    bool constant = true;

    for (size_t i = 0; i < n && constant && status == QDOT_OK; i++) {
        qdot_expr e = roots[i].value;
        qdot_sample sample;
        arb_srcptr ball;

        constant = (qdot_expr_node(pool, e)->holds & ~(uint32_t)QDOT_HAS_FUN) == 0;
        if (!constant ||
            (status = qdot_sample_begin(&sample, pool, 1, &e, NULL)) != QDOT_OK)
            break;
        qdot_sample_point(&sample, 0);
        constant = qdot_sample_eval(&sample, 96) &&
                   (ball = qdot_ball_get(&sample.ball, e)) != NULL;
        if (constant)
            v[i] = arf_get_d(arb_midref(ball), ARF_RND_NEAR);
        qdot_sample_end(&sample);
    }
    for (size_t a = 1; constant && status == QDOT_OK && a < n; a++)
        for (size_t b = a; b > 0 && v[b - 1] > v[b]; b--) {
            qdot_root keep = roots[b];
            double w = v[b];

            roots[b] = roots[b - 1];
            roots[b - 1] = keep;
            v[b] = v[b - 1];
            v[b - 1] = w;
        }
    qdot_free(v);
    return status;
}
