/* plot-loop.c -- the `for` loop of a panel of `plot`: for each pass of the loop, a curve of each expression. */
#include "lang/figures/plot-loop.h"

#include "expr/print-name.h"
#include "expr/print.h"
#include "lang/commands/loop-index.h"

const qdot_filled *
qdot_plot_find_word(const qdot_plot_said *said, const char *word)
{
    for (const qdot_filled *part = said->from; part < said->to; part++)
        if (part->node->kind == QDOT_USAGE_WORD && qdot_filled_is(part, word))
            return part;
    return NULL;
}

qdot_status
qdot_plot_indices(qdot_session *session, const qdot_loop *loop, qdot_text *label)
{
    for (size_t i = 0; loop != NULL && i < loop->indices.n; i++) {
        const char *name = loop->indices.at[i].name;

        qdot_text_format(label, ", %s = ", name);
        QDOT_TRY(qdot_print(session->pool, qdot_names_find(session->names, name)->value,
                            QDOT_PLAIN, label));
    }
    return QDOT_OK;
}

/* The part of the statement after the `for` clause that begins with the word `first`. */
static const qdot_filled *
end_of_for_clause(const qdot_plot_said *said, const qdot_filled *first)
{
    const qdot_filled *behind = first + 1;

    while (behind < said->to && behind->node->kind != QDOT_USAGE_WORD)
        behind++;
    return behind;
}

qdot_status
qdot_plot_loop_carry_out(const qdot_plot_said *said, const qdot_token *from, qdot_plot_pass pass, void *user)
{
    const qdot_filled *word = qdot_plot_find_word(said, "for");
    const qdot_filled *end = end_of_for_clause(said, word);
    qdot_status status;
    qdot_loop loop;
    bool more;

    QDOT_TRY(qdot_loop_index_check(said->record, word + 1, end, from, word->from, false));
    status = qdot_loop_begin(&loop, said->record, word + 1, end, &more);
    while (status == QDOT_OK && more) {
        status = pass(said, &loop, user);
        if (status == QDOT_OK)
            status = qdot_loop_next(&loop, &more);
    }
    qdot_loop_end(&loop);
    return status;
}
