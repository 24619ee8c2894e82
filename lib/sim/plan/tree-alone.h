/* tree-alone.h -- plans of long chains and trees, for which M and f are never derived.
 *
 * Eliminated along its tree, d'Alembert's residual reads neither M nor f
 * (sim/form/residual-sweeps.h), and of N links these are N^2 expressions. From some size on the residual is therefore made first,
 * and M q'' = f is left underived where what its coefficients must cost at least is more than the
 * tree's do: each pair of coordinates of which one's node hangs on the other's is an entry of M,
 * two convolutions an order.
 *
 * Where bodies turn in space it is the residual by sweeps back (sim/form/residual-adjoint.h), from 12 coordinates on.
 *
 * Left out are scenes where something else reads M or f: constraints, switches, methods that take
 * evaluations or Jacobians, first orders in two doubles, cyclic coordinates that are worth an
 * elimination (sim/plan/routh.h), coordinates that fall into groups.
 *
 * Of such a plan M, f, tape are NULL, and `residual` has no masses.
 *
 * Tests  tests/sim/plan/test_tree-alone.c
 */
#ifndef QDOT_SIM_TREE_ALONE_H
#define QDOT_SIM_TREE_ALONE_H

#include "sim/model/equations.h"

/* The plan, complete but for its equations, becomes one: p->residual is there then, else it is as
 * it was. Errors: those of deriving. */
QDOT_MUST_CHECK qdot_status qdot_tree_alone_find(qdot_plan *p, qdot_scene *scene,
                                                 const qdot_run_request *request);

#endif
