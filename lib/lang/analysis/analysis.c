/* analysis.c -- what is known of a text, and looking it up. */
#include "lang/analysis/analysis.h"

#include <stdlib.h>
#include <string.h>

#include "lang/session/output.h"
#include "lang/session/session.h"
#include "lang/source/source.h"

/* --- making and freeing --------------------------------------------------------------- */

static void
truncate_unknown(qdot_analysis *a, size_t n)
{
    while (a->unknown.n > n)
        qdot_free(a->unknown.at[--a->unknown.n].name);
}

static void
truncate_included(qdot_analysis *a, size_t n)
{
    while (a->included.n > n) {
        qdot_free(a->included.at[--a->included.n].path);
        qdot_source_free(a->included.at[a->included.n].source);
    }
}

void
qdot_analysis_truncate(qdot_analysis *a, const qdot_piece_state *state)
{
    qdot_remark_truncate(&a->remarks, state->remarks);
    truncate_unknown(a, state->unknown);
    a->forgotten = state->forgotten;
    truncate_included(a, state->included);
}

qdot_status
qdot_analysis_begin(qdot_analysis *a)
{
    char *own = qdot_strdup(a->path);

    qdot_session_free(a->session);
    a->session = qdot_session_new(a->nowhere, a->nowhere);
    a->done = 0;
    qdot_analysis_truncate(a, &(qdot_piece_state){0});
    if (a->session == NULL || own == NULL || qdot_vec_push(a->session->including, own) != QDOT_OK) {
        qdot_free(own);
        return QDOT_ENOMEM;
    }
    a->session->output->console = a->nowhere;
    return QDOT_OK;
}

qdot_analysis *
qdot_analysis_new(const char *path, bool quick, const qdot_analysis_host *host)
{
    qdot_analysis *a = qdot_calloc(1, sizeof *a);

    if (a == NULL)
        return NULL;
    a->path = qdot_strdup(path);
    a->text = qdot_strdup("");
    a->nowhere = fopen("/dev/null", "w");
    a->quick = quick;
    if (host != NULL)
        a->host = *host;
    if (a->path == NULL || a->text == NULL || a->nowhere == NULL || qdot_analysis_begin(a) != QDOT_OK) {
        qdot_analysis_free(a);
        return NULL;
    }
    return a;
}

void
qdot_analysis_free(qdot_analysis *a)
{
    if (a == NULL)
        return;
    qdot_session_free(a->session);
    qdot_remark_clear(&a->remarks);
    qdot_remark_clear(&a->torn);
    truncate_unknown(a, 0);
    qdot_free(a->unknown.at);
    truncate_included(a, 0);
    qdot_free(a->included.at);
    qdot_free(a->pieces.at);
    qdot_source_free(a->source);
    qdot_free(a->text);
    qdot_free(a->path);
    if (a->nowhere != NULL)
        (void)fclose(a->nowhere);
    qdot_free(a);
}

/* --- asking --------------------------------------------------------------------------- */

/* How many entries of a list have a number up to `bound`; the numbers of its n entries ascend. */
static size_t
count_up_to(const void *list, size_t n, size_t bound, size_t (*number)(const void *list, size_t i))
{
    size_t low = 0, high = n;

    while (low < high) {
        const size_t middle = (low + high) / 2;

        if (number(list, middle) <= bound)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static size_t
remarks_up_to(const void *pieces, size_t i)
{
    return ((const qdot_piece *)pieces)[i].behind.remarks;
}

static size_t
beginning_of_piece(const void *pieces, size_t i)
{
    return ((const qdot_piece *)pieces)[i].at.from;
}

static size_t
beginning_of_token(const void *tokens, size_t i)
{
    return ((const qdot_token *)tokens)[i].start;
}

bool
qdot_analysis_remark(const qdot_analysis *a, size_t i, qdot_remark *remark)
{
    size_t piece;

    if (i < a->torn.n) {
        *remark = a->torn.at[i];
        return true;
    }
    i -= a->torn.n;
    if (i >= a->remarks.n)
        return false;
    /* the first piece behind which there are more than i */
    piece = count_up_to(a->pieces.at, a->done, i, remarks_up_to);
    *remark = a->remarks.at[i];
    remark->at.from += a->pieces.at[piece].at.from;
    remark->at.to += a->pieces.at[piece].at.from;
    return true;
}

const qdot_piece *
qdot_analysis_piece(const qdot_analysis *a, size_t at)
{
    const size_t n = count_up_to(a->pieces.at, a->pieces.n, at, beginning_of_piece);

    return n > 0 ? &a->pieces.at[n - 1] : NULL;
}

size_t
qdot_analysis_token(const qdot_source *source, size_t at)
{
    const qdot_token *t = source->tokens.at;
    size_t n = count_up_to(t, source->tokens.n, at, beginning_of_token);

    while (n > 0 && t[n - 1].kind == QDOT_TOKEN_END)
        n--;
    if (n == 0 || t[n - 1].start > at || t[n - 1].start + t[n - 1].length < at)
        return SIZE_MAX;
    return n - 1;
}
