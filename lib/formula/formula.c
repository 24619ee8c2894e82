/* formula.c -- nodes of a formula and their lists of children. */
#include "formula/formula.h"

#include <string.h>

void
qdot_formula_clear(qdot_formula *f)
{
    qdot_free(f->nodes.at);
    qdot_text_clear(&f->text);
    *f = (qdot_formula){0};
}

void
qdot_formula_empty(qdot_formula *f)
{
    f->nodes.n = 0;
    qdot_text_truncate(&f->text, 0);
    f->text.failed = f->failed = false;
    f->stamp = 0;
}

qdot_status
qdot_formula_status(const qdot_formula *f)
{
    return f->failed ? QDOT_ENOMEM : qdot_text_status(&f->text);
}

qdot_formula_id
qdot_formula_new(qdot_formula *f, qdot_formula_kind kind, unsigned what, unsigned flags)
{
    const qdot_formula_node nil = {0}, node = {.kind = (uint8_t)kind, .what = (uint8_t)what, .flags = (uint8_t)flags};

    if (f->failed || (f->nodes.n == 0 && qdot_vec_push(&f->nodes, nil) != QDOT_OK) || f->nodes.n >= UINT32_MAX ||
        qdot_vec_push(&f->nodes, node) != QDOT_OK) {
        f->failed = true;
        return 0;
    }
    return (qdot_formula_id)(f->nodes.n - 1);
}

void
qdot_formula_append(qdot_formula *f, qdot_formula_id parent, qdot_formula_id child)
{
    qdot_formula_node *p, *c;

    if (parent == 0 || child == 0)
        return;
    p = f->nodes.at + parent;
    c = f->nodes.at + child;
    if (p->child == 0) {
        c->next = child;
    } else {
        c->next = f->nodes.at[p->child].next;
        f->nodes.at[p->child].next = child;
    }
    p->child = child;
}

qdot_formula_id
qdot_formula_add(qdot_formula *f, qdot_formula_id parent, qdot_formula_kind kind, unsigned what, unsigned flags)
{
    const qdot_formula_id child = qdot_formula_new(f, kind, what, flags);

    qdot_formula_append(f, parent, child);
    return child;
}

qdot_formula_id
qdot_formula_add_sign(qdot_formula *f, qdot_formula_id parent, qdot_formula_sign sign)
{
    return qdot_formula_add(f, parent, QDOT_FORMULA_SIGN, sign, 0);
}

qdot_formula_id
qdot_formula_add_tail(qdot_formula *f, qdot_formula_id parent, qdot_formula_role role, size_t from)
{
    const qdot_formula_id id = qdot_formula_add(f, parent, QDOT_FORMULA_TEXT, role, 0);

    if (f->text.failed || f->text.n > UINT32_MAX)
        f->failed = true;
    if (id != 0 && !f->failed) {
        f->nodes.at[id].child = (uint32_t)from;
        f->nodes.at[id].n = (uint32_t)(f->text.n - from);
    }
    return id;
}

qdot_formula_id
qdot_formula_add_text(qdot_formula *f, qdot_formula_id parent, qdot_formula_role role, const char *text, size_t n)
{
    const size_t from = f->text.n;

    qdot_text_add_n(&f->text, text, n);
    return qdot_formula_add_tail(f, parent, role, from);
}

void
qdot_formula_count(qdot_formula *f, qdot_formula_id id, uint32_t n)
{
    if (id != 0)
        f->nodes.at[id].n = n;
}

void
qdot_formula_share(qdot_formula *f, qdot_formula_id to, qdot_formula_id of)
{
    qdot_formula_id next;

    if (to == 0 || of == 0)
        return;
    next = f->nodes.at[to].next;
    f->nodes.at[to] = f->nodes.at[of];
    f->nodes.at[to].next = next;
}

void
qdot_formula_unwrap(qdot_formula *f, qdot_formula_id id)
{
    const uint32_t child = id != 0 ? f->nodes.at[id].child : 0;

    if (child != 0 && f->nodes.at[id].kind == QDOT_FORMULA_SPAN && f->nodes.at[child].next == child &&
        f->nodes.at[child].kind != QDOT_FORMULA_SPAN)
        qdot_formula_share(f, id, child);
}
