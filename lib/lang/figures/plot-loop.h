/* plot-loop.h -- the `for` of a panel: a curve of each expression for each pass.
 *
 * Tests  tests/script/figures/plot-for.sh, tests/script/sweeps/loops-over-declared.lag
 */
#ifndef QDOT_LANG_PLOT_LOOP_H
#define QDOT_LANG_PLOT_LOOP_H

#include "base/text.h"
#include "lang/commands/loop.h"
#include "lang/syntax/record.h"

/* The parts [from, to) of the statement that describe one panel, after its word `plot`. */
typedef struct {
    qdot_record *record;
    const qdot_filled *from, *to;
} qdot_plot_said;

/* The part of this panel that is the word `word`; NULL if it does not occur. */
const qdot_filled *qdot_plot_find_word(const qdot_plot_said *said, const char *word);

/* Append the present values of the loop indices as text: ", l = 1". */
QDOT_MUST_CHECK qdot_status qdot_plot_indices(qdot_session *session, const qdot_loop *loop,
                                              qdot_text *label);

/* Carry out each pass of the clause `for` with the indices bound. Each of these must occur in what stands before the
 * clause, from `from` on: the word `plot` where each pass makes a run, which may read them in the scene. The place of an
 * error is in the record's cursor. */
typedef qdot_status (*qdot_plot_pass)(const qdot_plot_said *said, const qdot_loop *loop, void *user);
QDOT_MUST_CHECK qdot_status qdot_plot_loop_carry_out(const qdot_plot_said *said, const qdot_token *from,
                                                     qdot_plot_pass pass, void *user);

#endif
