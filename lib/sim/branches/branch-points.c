/* branch-points.c -- makes, copies and removes the points of a branch. */
#include "sim/branches/branch-points.h"

#include <string.h>

#include "base/memory.h"

qdot_status
qdot_branch_add(const qdot_path *x, qdot_branch *branch, const double *y,
                qdot_stability stability, size_t mark)
{
    const size_t m = x->width;

    if (branch->n == branch->room) {
        const size_t room = branch->room == 0 ? 64 : 2 * branch->room;
        double *all = qdot_realloc(branch->y, room * m * sizeof *all);
        qdot_stability *verdicts;
        size_t *marks;

        branch->y = all ? all : branch->y;
        verdicts = qdot_realloc(branch->stability, room * sizeof *verdicts);
        branch->stability = verdicts ? verdicts : branch->stability;
        marks = qdot_realloc(branch->mark, room * sizeof *marks);
        branch->mark = marks ? marks : branch->mark;
        if (!all || !verdicts || !marks)
            return QDOT_ENOMEM;
        branch->room = room;
    }
    memcpy(branch->y + branch->n * m, y, m * sizeof *y);
    branch->stability[branch->n] = stability;
    branch->mark[branch->n++] = mark;
    return QDOT_OK;
}

void
qdot_branch_clear(qdot_branch *branch)
{
    qdot_free(branch->y);
    qdot_free(branch->stability);
    qdot_free(branch->mark);
    *branch = (qdot_branch){0};
}

qdot_status
qdot_branch_insert(const qdot_path *x, qdot_branch *branch, size_t at, const double *y, qdot_stability stability,
                   size_t mark)
{
    const size_t w = x->width;
    size_t behind;

    QDOT_TRY(qdot_branch_add(x, branch, y, stability, mark));
    behind = branch->n - 1 - at;
    memmove(branch->y + (at + 1) * w, branch->y + at * w, behind * w * sizeof *branch->y);
    memmove(branch->stability + at + 1, branch->stability + at, behind * sizeof *branch->stability);
    memmove(branch->mark + at + 1, branch->mark + at, behind * sizeof *branch->mark);
    memcpy(branch->y + at * w, y, w * sizeof *y);
    branch->stability[at] = stability;
    branch->mark[at] = mark;
    return QDOT_OK;
}
