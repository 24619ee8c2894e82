/* follow.c -- what a text says is kept while the text changes. */
#include "lang/analysis/follow.h"

#include <string.h>

#include "lang/analysis/pieces.h"
#include "lang/analysis/torn.h"
#include "lang/analysis/treat.h"
#include "lang/session/undo.h"
#include "lang/source/source.h"

/* Memory of expressions in bytes beyond which the session is made anew rather than taken back. */
static const size_t most_bytes = (size_t)64 << 20;

static bool
pieces_are_equal(const qdot_piece *a, const char *text, const qdot_piece *b, const char *other)
{
    const size_t n = a->at.to - a->at.from;

    return a->line == b->line && n == b->at.to - b->at.from && memcmp(text + a->at.from, other + b->at.from, n) == 0;
}

/* Take the session back to what it was behind the first n pieces. false: it cannot be. */
static bool
go_back(qdot_analysis *a, size_t n)
{
    const qdot_piece_state state = n > 0 ? a->pieces.at[n - 1].behind : (qdot_piece_state){0};
    const char *text;

    if (qdot_pool_bytes(a->session->pool) > most_bytes || qdot_undo_statements(a->session, false) < state.undo)
        return false;
    while (qdot_undo_statements(a->session, false) > state.undo)
        if (qdot_undo_step(a->session, false, &text) != QDOT_OK)
            return false;
    while (a->session->told->n > state.told)
        qdot_free(a->session->told->at[--a->session->told->n]);
    qdot_analysis_truncate(a, &state);
    a->done = n;
    return true;
}

/* How many pieces at the beginning of both lists are the same, have been analysed, and read no other script. */
static size_t
count_kept(const qdot_analysis *a, const qdot_source *source, const qdot_piece_list *pieces)
{
    size_t n = 0, most = a->done < pieces->n ? a->done : pieces->n;

    while (n < most && pieces_are_equal(&a->pieces.at[n], a->source->text, &pieces->at[n], source->text) &&
           a->pieces.at[n].behind.included == 0)
        n++;
    return n;
}

qdot_status
qdot_follow_text(qdot_analysis *a, const char *text, size_t length)
{
    qdot_source *source = NULL;
    qdot_piece_list pieces = {0};
    qdot_remark_list torn = {0};
    char *own = qdot_malloc(length + 1);
    qdot_status status = qdot_torn_source(a->path, text, length, &source, &torn);
    size_t kept;

    if (status == QDOT_OK && own == NULL)
        status = QDOT_ENOMEM;
    if (status == QDOT_OK)
        status = qdot_pieces_of(source, &pieces);
    if (status != QDOT_OK) {
        qdot_free(own);
        qdot_free(pieces.at);
        qdot_remark_clear(&torn);
        qdot_source_free(source);
        return status;
    }
    memcpy(own, text, length);
    own[length] = '\0';
    kept = count_kept(a, source, &pieces);
    if (kept < a->done && !go_back(a, kept)) {
        status = qdot_analysis_begin(a);
        kept = 0;
    }
    for (size_t i = 0; i < kept; i++)
        pieces.at[i].behind = a->pieces.at[i].behind;
    qdot_free(a->text);
    a->text = own;
    a->length = length;
    qdot_source_free(a->source);
    a->source = source;
    qdot_free(a->pieces.at);
    a->pieces.at = pieces.at;
    a->pieces.n = pieces.n;
    a->pieces.capacity = pieces.capacity;
    qdot_remark_clear(&a->torn);
    a->torn = torn;
    return status;
}

qdot_status
qdot_follow_files(qdot_analysis *a)
{
    size_t kept = 0;

    while (kept < a->done && !a->pieces.at[kept].behind.reads)
        kept++;
    return kept == a->done || go_back(a, kept) ? QDOT_OK : qdot_analysis_begin(a);
}

qdot_status
qdot_follow_on(qdot_analysis *a, bool *done)
{
    qdot_status status;

    *done = false;
    while (a->done < a->pieces.n) {
        if (a->host.waits != NULL && a->host.waits(a->host.data))
            return QDOT_OK;
        status = qdot_treat_piece(a, a->done);
        if (status == QDOT_EINTR)
            return go_back(a, a->done) ? QDOT_OK : qdot_analysis_begin(a);
        QDOT_TRY(status);
        a->done++;
    }
    *done = true;
    return QDOT_OK;
}
