/* failing.h -- trajectories where memory fails. */
#ifndef QDOT_TESTS_ODE_FAILING_H
#define QDOT_TESTS_ODE_FAILING_H

#include "base/memory.h"
#include "ode/trajectory.h"
#include "ode/problems.h"

/* Each allocation of a run and of a question to it fails once. */
static inline void
failed_allocations_are_told(const qdot_ode_method *method)
{
    for (int64_t k = 0;; k++) {
        qdot_trajectory tr = {0};
        double y[2];
        qdot_status status;

        qdot_memory_fail_at(k);
        status = qdot_trajectory_run(&tr, &pendulum.system, method, NULL, 0, 3, pendulum.y0);
        if (status == QDOT_OK)
            status = qdot_trajectory_at(&tr, &pendulum.system, 1.5, y);
        qdot_memory_fail_at(-1);
        qdot_trajectory_clear(&tr);
        if (status == QDOT_OK)
            break;
        assert_int_equal(status, QDOT_ENOMEM);
        assert_true(k < 1000);
    }
}

#endif
