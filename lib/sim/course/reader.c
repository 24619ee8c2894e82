/* reader.c -- reads a state, its accelerations if needed, and evaluates the tape. */
#include "sim/course/reader.h"

#include <string.h>

#include "ode/companion.h"

void
qdot_reader_clear(qdot_reader *r)
{
    qdot_trajectory_close(r->cursor);
    qdot_free(r->in);
    qdot_free(r->work);
}

qdot_status
qdot_reader_init(qdot_reader *r, const qdot_reading *of, const qdot_course *course)
{
    *r = (qdot_reader){.of = *of, .course = course};
    r->in = qdot_calloc(qdot_tape_inputs(of->tape), sizeof *r->in);
    r->work = qdot_calloc(qdot_tape_work(of->tape) + 1, sizeof *r->work);
    if (!r->in || !r->work)
        return QDOT_ENOMEM;
    return qdot_trajectory_open(&course->tr, qdot_course_systems(course), &r->cursor);
}

static qdot_status
read_accelerations(qdot_reader *r, double t)
{
    size_t mode = qdot_trajectory_mode_read(r->cursor);

    return qdot_bind_accelerations(qdot_course_systems(r->course) + mode, t, r->in,
                                   r->in + 2 * r->of.plan->n + 1);
}

qdot_status
qdot_reader_evaluate(qdot_reader *r, double t, double *out)
{
    r->in[2 * r->of.plan->n] = t;
    if (r->of.accelerations)
        QDOT_TRY(read_accelerations(r, t));
    qdot_tape_eval(r->of.tape, r->in, out, r->work);
    return QDOT_OK;
}

qdot_status
qdot_reader_at(qdot_reader *r, size_t piece, double t, double *out)
{
    QDOT_TRY(piece == SIZE_MAX
                 ? qdot_trajectory_read(r->cursor, t, r->in)
                 : qdot_trajectory_read_piece(r->cursor, piece, t, r->in));
    for (size_t i = 0; i < 2 * r->of.plan->n && r->moved > 0; i++)
        r->in[i] = qdot_companion_moved(r->in[i], i, (size_t)r->moved - 1, 1);
    return qdot_reader_evaluate(r, t, out);
}

qdot_status
qdot_reader_lower(const qdot_plan *p, size_t m, const qdot_expr *exprs, qdot_reading *of)
{
    qdot_expr *e = qdot_malloc((m + 1) * sizeof *e);
    qdot_status status = e ? QDOT_OK : QDOT_ENOMEM;

    *of = (qdot_reading){.plan = p, .m = m, .exprs = exprs};
    for (size_t j = 0; j < m && status == QDOT_OK; j++) {
        e[j] = qdot_plan_substitute(p, exprs[j]);
        status = qdot_pool_check(p->pool);
        if (status == QDOT_OK
            && qdot_expr_node(p->pool, e[j])->holds
                   & (QDOT_HAS_ACCELERATION | QDOT_HAS_MULTIPLIER))
            of->accelerations = true;
    }
    if (status == QDOT_OK)
        status = qdot_tape_new(p->pool, qdot_plan_inputs(p), p->inputs, m, e, &of->tape);
    qdot_free(e);
    return status;
}
