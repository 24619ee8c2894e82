/* plot-loop.h -- the `for` of a panel: a curve of each expression for each pass.
 *
 * Tests  tests/script/figures/plot-for.sh, tests/script/sweeps/loops-over-declared.lag
 */
#ifndef QDOT_LANG_PLOT_LOOP_H
#define QDOT_LANG_PLOT_LOOP_H

#include "lang/commands/loop.h"

/* The end of the clause at the cursor: the first option after something complete, or the end of the
 * statement. */
const qdot_token *qdot_plot_clause_end(const qdot_cursor *c);

/* The present values of the loop indices as text: ", l = 1". */
QDOT_MUST_CHECK qdot_status qdot_plot_indices(qdot_session *session, const qdot_loop *loop,
                                              qdot_text *label);

/* What is repeated: the tokens [from, to) are looked through for the indices; `clause`, behind `for`,
 * ends at `behind`. */
typedef struct {
    const qdot_token *from, *to, *clause, *behind;
    qdot_status (*pass)(qdot_cursor *c, const qdot_loop *loop, void *user);
    void *user;
} qdot_plot_loop;
/* Repeat the body with each set of index values. The position of an error is in c->error_at. */
QDOT_MUST_CHECK qdot_status qdot_plot_loop_carry_out(qdot_cursor *c, const qdot_plot_loop *l);

#endif
