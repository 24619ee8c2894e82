/* plot-loop.h -- the `for` of a panel: a curve of each expression for each pass.
 *
 * Tests  tests/script/figures/plot-for.sh, tests/script/sweeps/loops-over-declared.lag
 */
#ifndef QDOT_LANG_PLOT_LOOP_H
#define QDOT_LANG_PLOT_LOOP_H

#include "lang/commands/loop.h"

/* Where the clause at the cursor ends: at the first option behind something complete, or the end. */
const qdot_token *qdot_plot_clause_end(const qdot_cursor *c);

/* ", l = 1": what the indices stand at. */
QDOT_MUST_CHECK qdot_status qdot_plot_indices(qdot_session *session, const qdot_loop *loop,
                                              qdot_text *label);

/* What is repeated: the tokens [from, to) are looked through for the indices; `clause`, behind `for`,
 * ends at `behind`. */
typedef struct {
    const qdot_token *from, *to, *clause, *behind;
    qdot_status (*pass)(qdot_cursor *c, const qdot_loop *loop, void *user);
    void *user;
} qdot_plot_loop;
/* Carry out each pass with the indices bound. The place of an error is in c->error_at. */
QDOT_MUST_CHECK qdot_status qdot_plot_loop_carry_out(qdot_cursor *c, const qdot_plot_loop *l);

#endif
