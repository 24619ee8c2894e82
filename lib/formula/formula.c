/* formula.c -- the nodes of a formula, and the lists of their children. */
#include "formula/formula.h"

#include <ctype.h>
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

qdot_status
qdot_formula_find_parts(const qdot_formula *f, qdot_formula_id id, qdot_formula_parts *parts)
{
    parts->todo.n = 0;
    QDOT_TRY(qdot_vec_push(&parts->todo, id));
    for (bool first = true; parts->todo.n > 0; first = false) {
        const qdot_formula_id top = parts->todo.at[--parts->todo.n];
        const qdot_formula_node *node = qdot_formula_at(f, top);
        size_t from = parts->todo.n;

        if (!first && (node->kind != QDOT_FORMULA_SPAN || (node->flags & QDOT_FORMULA_LABEL))) {
            QDOT_TRY(qdot_vec_push(&parts->part, top));
            continue;
        }
        for (qdot_formula_id c = 0; (c = qdot_formula_child(f, top, c)) != 0;)
            QDOT_TRY(qdot_vec_push(&parts->todo, c));
        /* reverse the order on the stack, so that the first child is taken first */
        for (size_t to = parts->todo.n; from + 1 < to; from++) {
            const qdot_formula_id c = parts->todo.at[--to];

            parts->todo.at[to] = parts->todo.at[from];
            parts->todo.at[from] = c;
        }
    }
    return QDOT_OK;
}

void
qdot_formula_parts_clear(qdot_formula_parts *parts)
{
    qdot_free(parts->part.at);
    qdot_free(parts->todo.at);
    *parts = (qdot_formula_parts){0};
}

qdot_formula_duty
qdot_formula_sign_duty(const qdot_formula_node *node)
{
    static const uint8_t duties[] = {
#define QDOT_SIGN(name, plain, unicode, latex, mathml, duty) QDOT_DUTY_##duty,
#include "formula/sign.def"
#undef QDOT_SIGN
    };

    return node->kind == QDOT_FORMULA_SIGN ? (qdot_formula_duty)duties[node->what] : QDOT_DUTY_NONE;
}

/* The change of nesting by a LaTeX bracket at this byte: braces, \left ... \right, \begin ... \end. */
static int
latex_bracket_depth_change(const char *at, size_t n)
{
    static const struct {
        const char *begins;
        int depth;
    } brackets[] = {{"{", 1}, {"}", -1}, {"\\left", 1}, {"\\right", -1}, {"\\begin", 1}, {"\\end", -1}};

    for (size_t i = 0; i < sizeof brackets / sizeof *brackets; i++) {
        const size_t length = strlen(brackets[i].begins);

        if (length <= n && memcmp(at, brackets[i].begins, length) == 0)
            return brackets[i].depth;
    }
    return 0;
}

/* The length of a sign at this byte that joins terms or the sides of an equation; 0: there is none. */
static size_t
length_of_latex_sign(const char *at, size_t n, qdot_formula_sign *sign)
{
    static const struct {
        const char *text;
        qdot_formula_sign sign;
    } rows[] = {
#define QDOT_SIGN(name, plain, unicode, latex, mathml, duty)                                                           \
    {QDOT_DUTY_##duty == QDOT_DUTY_RELATION || QDOT_DUTY_##duty == QDOT_DUTY_TERMS ? latex : NULL, QDOT_SIGN_##name},
#include "formula/sign.def"
#undef QDOT_SIGN
    };

    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const size_t length = rows[i].text != NULL ? strlen(rows[i].text) : 0;

        if (length > 0 && length <= n && memcmp(at, rows[i].text, length) == 0) {
            *sign = rows[i].sign;
            return length;
        }
    }
    return 0;
}

void
qdot_formula_add_latex(qdot_formula *f, qdot_formula_id parent, const char *text, size_t n)
{
    size_t from = 0;
    int depth = 0;

    for (size_t i = 0; i < n; i++) {
        qdot_formula_sign sign;
        size_t length = 0;

        depth += latex_bracket_depth_change(text + i, n - i);
        if (depth == 0)
            length = length_of_latex_sign(text + i, n - i, &sign);
        if (length > 0) {
            if (i > from)
                qdot_formula_add_text(f, parent, QDOT_TEXT_WORDS, text + from, i - from);
            qdot_formula_add_sign(f, parent, sign);
            from = i + length;
            i = from - 1;
        } else if (text[i] == '\\' && i + 1 < n && !isalpha((unsigned char)text[i + 1])) {
            i++; /* an escaped character, as \{, is no bracket */
        }
    }
    if (n > from)
        qdot_formula_add_text(f, parent, QDOT_TEXT_WORDS, text + from, n - from);
}
