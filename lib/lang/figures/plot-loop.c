/* plot-loop.c -- the `for` of a panel: a curve of each expression for each pass. */
#include "lang/figures/plot-loop.h"

#include "lang/commands/loop-index.h"
#include "lang/figures/figure-option.h"

const qdot_token *
qdot_plot_clause_end(const qdot_cursor *c)
{
    const qdot_token *end = qdot_cursor_find_word(c, NULL);
    int depth = 0;

    for (const qdot_token *t = c->at; t < end; t++) {
        depth += qdot_token_bracket(t);
        if (t > c->at && depth == 0 && qdot_figure_option_is(t) &&
            (t[-1].kind != QDOT_TOKEN_OPERATOR || qdot_token_bracket(t - 1) < 0))
            return t;
    }
    return end;
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

qdot_status
qdot_plot_loop_carry_out(qdot_cursor *c, const qdot_plot_loop *l)
{
    qdot_token *behind = (qdot_token *)l->behind; /* an end to the clause for the while */
    uint8_t kind = behind->kind;
    qdot_cursor clause = *c;
    qdot_status status;
    qdot_loop loop;
    bool more;

    clause.at = l->clause;
    behind->kind = QDOT_TOKEN_END;
    status = qdot_loop_index_check(&clause, l->from, l->to, false);
    if (status != QDOT_OK) {
        behind->kind = kind;
        c->error_at = clause.error_at;
        return status;
    }
    status = qdot_loop_begin(&loop, &clause, &more);
    if (status != QDOT_OK)
        c->error_at = loop.error_at;
    while (status == QDOT_OK && more) {
        behind->kind = kind;
        status = l->pass(c, &loop, l->user);
        behind->kind = QDOT_TOKEN_END;
        if (status == QDOT_OK) {
            status = qdot_loop_next(&loop, &more);
            if (status != QDOT_OK)
                c->error_at = loop.error_at;
        }
    }
    behind->kind = kind;
    qdot_loop_end(&loop);
    return status;
}
