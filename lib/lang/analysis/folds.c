/* folds.c -- what can be folded of a script. */
#include <string.h>

#include "lang/analysis/layout.h"

static bool
has_lines(const qdot_analysis *a, qdot_stretch at)
{
    return memchr(a->text + at.from, '\n', at.to - at.from) != NULL;
}

/* The blocks within a piece, by their braces. */
static qdot_status
add_braces(const qdot_analysis *a, const qdot_piece *piece, qdot_fold_list *folds)
{
    const qdot_token *tokens = a->source->tokens.at;
    qdot_vec(size_t) open = {0};
    qdot_status status = QDOT_OK;

    for (size_t k = piece->first; k < piece->end && status == QDOT_OK; k++) {
        if (qdot_token_is(&tokens[k], "{")) {
            status = qdot_vec_push(&open, k);
        } else if (qdot_token_is(&tokens[k], "}") && open.n > 0) {
            const qdot_fold fold = {.at = {tokens[open.at[--open.n]].start, tokens[k].start}};

            if (has_lines(a, fold.at))
                status = qdot_vec_push(folds, fold);
        }
    }
    qdot_free(open.at);
    return status;
}

/* Runs of lines that are comments. */
static qdot_status
add_comments(const qdot_analysis *a, qdot_fold_list *folds)
{
    qdot_fold fold = {.comment = true};
    size_t lines = 0;

    for (size_t i = 0; i <= a->length;) {
        const char *line = a->text + i, *end = memchr(line, '\n', a->length - i);
        const size_t n = end != NULL ? (size_t)(end - line) : a->length - i;

        if (line[strspn(line, " \t")] == '#') {
            fold.at = lines++ == 0 ? (qdot_stretch){i, i + n} : (qdot_stretch){fold.at.from, i + n};
        } else {
            if (lines > 1)
                QDOT_TRY(qdot_vec_push(folds, fold));
            lines = 0;
        }
        i += n + 1;
    }
    return lines > 1 ? qdot_vec_push(folds, fold) : QDOT_OK;
}

qdot_status
qdot_layout_folds(const qdot_analysis *a, qdot_fold_list *folds)
{
    for (size_t i = 0; i < a->pieces.n; i++) {
        const qdot_piece *piece = &a->pieces.at[i];

        if (piece->block)
            QDOT_TRY(add_braces(a, piece, folds));
        else if (has_lines(a, piece->at))
            QDOT_TRY(qdot_vec_push(folds, ((qdot_fold){.at = piece->at})));
    }
    return add_comments(a, folds);
}
