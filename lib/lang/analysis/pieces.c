/* pieces.c -- divides a source into statements and blocks. */
#include "lang/analysis/pieces.h"

#include "lang/syntax/outline.h"

qdot_status
qdot_pieces_of(const qdot_source *source, qdot_piece_list *pieces)
{
    const qdot_token *tokens = source->tokens.at;
    uint32_t *close, line = 0;
    size_t counted = 0;
    qdot_status status = qdot_outline_blocks(source, &close);

    for (size_t i = 0; i < source->tokens.n && status == QDOT_OK;) {
        const qdot_outline_kind kind = qdot_outline_at(&tokens[i]);
        const qdot_token *last = kind == QDOT_OUTLINE_BLOCK && close[i] > i ? &tokens[close[i]] : &tokens[i], *end;

        if (kind == QDOT_OUTLINE_END) {
            i++;
            continue;
        }
        end = qdot_outline_end(last);
        for (; counted < tokens[i].start; counted++)
            line += source->text[counted] == '\n';
        status = qdot_vec_push(
            pieces, ((qdot_piece){.at = {tokens[i].start, end[-1].start + end[-1].length},
                                  .first = i,
                                  .end = (size_t)(end - tokens),
                                  .line = line,
                                  .block = kind == QDOT_OUTLINE_BLOCK}));
        i = (size_t)(end - tokens);
    }
    qdot_free(close);
    return status;
}
