/* printed.c -- texts of subexpressions that were printed. */
#include "expr/printed.h"

#include "base/memory.h"

enum { SLOTS = 4096, SHORTEST = 4, LONGEST = 4096, MOST = 1 << 20 };

struct slot {
    qdot_expr e; /* nil: free */
    uint32_t how, at, n;
};

struct qdot_printed {
    struct slot *slot; /* [SLOTS], 64 kB; NULL: nothing was kept yet */
    qdot_text text;
};

qdot_printed *
qdot_printed_new(void)
{
    return qdot_calloc(1, sizeof(qdot_printed));
}

void
qdot_printed_free(qdot_printed *printed)
{
    if (printed == NULL)
        return;
    qdot_text_clear(&printed->text);
    qdot_free(printed->slot);
    qdot_free(printed);
}

void
qdot_printed_forget(qdot_printed *printed)
{
    qdot_text_truncate(&printed->text, 0);
    for (size_t i = 0; printed->slot != NULL && i < SLOTS; i++)
        printed->slot[i].e = QDOT_NIL;
}

static size_t
printed_slot(qdot_expr e, uint32_t how)
{
    return (e * 2654435761u ^ how * 40503u) >> 7 & (SLOTS - 1);
}

bool
qdot_printed_copy(const qdot_printed *printed, qdot_expr e, uint32_t how, qdot_text *out)
{
    const struct slot *s = printed->slot == NULL ? NULL : &printed->slot[printed_slot(e, how)];

    if (s == NULL || s->e != e || s->how != how)
        return false;
    qdot_text_add_n(out, printed->text.at + s->at, s->n);
    return true;
}

qdot_status
qdot_printed_keep(qdot_printed *p, qdot_expr e, uint32_t how, const qdot_text *out, size_t from)
{
    size_t n = out->n - from;

    QDOT_TRY(qdot_text_status(out));
    if (n < SHORTEST || n > LONGEST)
        return QDOT_OK;
    if (p->slot == NULL)
        p->slot = qdot_calloc(SLOTS, sizeof *p->slot);
    if (p->slot == NULL)
        return QDOT_ENOMEM;
    if (p->text.n + n > MOST)
        qdot_printed_forget(p);
    qdot_text_add_n(&p->text, out->at + from, n);
    if (qdot_text_status(&p->text) != QDOT_OK) {
        p->text.failed = false; /* what it holds is as it was */
        return QDOT_ENOMEM;
    }
    p->slot[printed_slot(e, how)] = (struct slot){e, how, (uint32_t)(p->text.n - n), (uint32_t)n};
    return QDOT_OK;
}
