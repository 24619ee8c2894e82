/* analysis.c -- what is known of a text, and looking it up. */
#include "lang/analysis/analysis.h"

#include <stdlib.h>
#include <string.h>

#include "lang/session/output.h"
#include "lang/session/session.h"
#include "lang/source/source.h"

/* --- making and freeing --------------------------------------------------------------- */

static void
truncate_texts(qdot_text_list *list, size_t n)
{
    while (list->n > n)
        qdot_free(list->at[--list->n]);
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
qdot_analysis_truncate(qdot_analysis *a, size_t remarks, size_t unknown, size_t included)
{
    qdot_remark_truncate(&a->remarks, remarks);
    truncate_texts(&a->unknown, unknown);
    truncate_included(a, included);
}

qdot_status
qdot_analysis_begin(qdot_analysis *a)
{
    char *own = qdot_strdup(a->path);

    qdot_session_free(a->session);
    a->session = qdot_session_new(a->nowhere, a->nowhere);
    a->done = 0;
    qdot_analysis_truncate(a, 0, 0, 0);
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
    qdot_text_list_clear(&a->unknown);
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

bool
qdot_analysis_remark(const qdot_analysis *a, size_t i, qdot_remark *remark)
{
    size_t low = 0, high = a->done;

    if (i < a->torn.n) {
        *remark = a->torn.at[i];
        return true;
    }
    i -= a->torn.n;
    if (i >= a->remarks.n)
        return false;
    while (low < high) { /* the first piece behind which there are more than i */
        const size_t middle = (low + high) / 2;

        if (a->pieces.at[middle].behind.remarks <= i)
            low = middle + 1;
        else
            high = middle;
    }
    *remark = a->remarks.at[i];
    remark->at.from += a->pieces.at[low].at.from;
    remark->at.to += a->pieces.at[low].at.from;
    return true;
}

const qdot_piece *
qdot_analysis_piece(const qdot_analysis *a, size_t at)
{
    size_t low = 0, high = a->pieces.n;

    while (low < high) {
        const size_t middle = (low + high) / 2;

        if (a->pieces.at[middle].at.from <= at)
            low = middle + 1;
        else
            high = middle;
    }
    return low > 0 ? &a->pieces.at[low - 1] : NULL;
}

size_t
qdot_analysis_token(const qdot_source *source, size_t at)
{
    size_t low = 0, high = source->tokens.n;
    const qdot_token *t = source->tokens.at;

    while (low < high) {
        const size_t middle = (low + high) / 2;

        if (t[middle].start <= at)
            low = middle + 1;
        else
            high = middle;
    }
    while (low > 0 && t[low - 1].kind == QDOT_TOKEN_END)
        low--;
    if (low == 0 || t[low - 1].start > at || t[low - 1].start + t[low - 1].length < at)
        return SIZE_MAX;
    return low - 1;
}
