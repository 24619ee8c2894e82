/* printed.c -- remembers the formula nodes of expressions, so that repeated parts are shared. */
#include "expr/printed.h"

#include "base/memory.h"

enum { SLOTS = 4096, MOST = 1 << 17 };

struct slot {
    qdot_expr e; /* the expression; nil: this slot is free */
    uint32_t how;
    qdot_formula_id id;
};

struct qdot_printed {
    struct slot *slot;         /* [SLOTS] hash table, 48 kB; NULL: nothing was stored yet */
    const qdot_formula *of;    /* the formula that the stored nodes belong to, if it still has this stamp */
    uint32_t stamp;
    qdot_formula own;
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
    qdot_formula_clear(&printed->own);
    qdot_free(printed->slot);
    qdot_free(printed);
}

void
qdot_printed_forget(qdot_printed *printed)
{
    qdot_formula_empty(&printed->own);
    printed->of = NULL;
    for (size_t i = 0; printed->slot != NULL && i < SLOTS; i++)
        printed->slot[i].e = QDOT_NIL;
}

qdot_formula *
qdot_printed_formula(qdot_printed *printed)
{
    if (printed->own.nodes.n > MOST || printed->own.text.n > MOST)
        qdot_printed_forget(printed);
    return &printed->own;
}

void
qdot_printed_begin(qdot_printed *printed, qdot_formula *formula)
{
    if (printed->of == formula && printed->stamp == formula->stamp)
        return;
    for (size_t i = 0; printed->slot != NULL && i < SLOTS; i++)
        printed->slot[i].e = QDOT_NIL;
    printed->of = formula;
    formula->stamp = ++printed->stamp;
}

static size_t
find_slot_of_expression(qdot_expr e, uint32_t how)
{
    return (e * 2654435761u ^ how * 40503u) >> 7 & (SLOTS - 1);
}

qdot_formula_id
qdot_printed_find(const qdot_printed *printed, qdot_expr e, uint32_t how)
{
    const struct slot *s = printed->slot == NULL ? NULL : &printed->slot[find_slot_of_expression(e, how)];

    return s == NULL || s->e != e || s->how != how ? 0 : s->id;
}

qdot_status
qdot_printed_keep(qdot_printed *p, qdot_expr e, uint32_t how, qdot_formula_id id)
{
    if (p->slot == NULL)
        p->slot = qdot_calloc(SLOTS, sizeof *p->slot);
    if (p->slot == NULL)
        return QDOT_ENOMEM;
    p->slot[find_slot_of_expression(e, how)] = (struct slot){e, how, id};
    return QDOT_OK;
}
