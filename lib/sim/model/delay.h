/* delay.h -- delayed coordinates x(t - tau) in the equations of a run.
 *
 * For a run x(u) is what the history of that run says (num/past.h): the polynomial of the step that was taken at u. So
 * the equations are those of a scene with a table of data, whose knots are the ends of all steps, a delay later.
 *
 * Tests  tests/script/data/delay.lag
 */
#ifndef QDOT_SIM_DELAY_H
#define QDOT_SIM_DELAY_H

#include "expr/id.h"
#include "tape/knots.h"

/* x(u), or x'(u), u being the coordinate itself, by the history of the run; nil: the pool keeps the failure. */
qdot_expr qdot_delay_value(qdot_pool *pool, qdot_expr coordinate, bool velocity);

/* e, of numbers of a run as above, with their values at the start of the run, where the history is that of before: x for
 * x(t - tau) and 0 for x'(t - tau). */
qdot_expr qdot_delay_at_start(qdot_pool *pool, qdot_expr e);

/* e, of numbers of a run as above, with x(t - tau) for what is read, as it is written. */
qdot_expr qdot_delay_written(qdot_pool *pool, qdot_expr e);

/* e with the histories of other unknowns in place of those of from [n]: to [n], as where several runs are read at once. */
qdot_expr qdot_delay_rename(qdot_pool *pool, qdot_expr e, size_t n, const qdot_expr *from, const qdot_expr *to);

/* e with `time` in place of t, where a run counts its times from another origin: x(t - tau) remains x a time tau ago. nil
 * stays nil. */
qdot_expr qdot_delay_replace_time(qdot_pool *pool, qdot_expr e, qdot_expr time);

/* Append to `knots` those of the histories that a tape with input `time` reads. QDOT_ENOTBUILT: at other times than a constant
 * time ago; QDOT_EINVAL: not before now. */
QDOT_MUST_CHECK qdot_status qdot_delay_find_knots(const qdot_tape *tape, size_t time, qdot_knots *knots);

/* Whether a tape reads histories. */
bool qdot_delay_reads(const qdot_tape *tape);

#endif
