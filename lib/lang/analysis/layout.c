/* layout.c -- the spaces and indentation of a script. */
#include "lang/analysis/layout.h"

#include <string.h>

#include "lang/source/source.h"

enum { INDENT = 4 };

/* --- the space between two tokens ----------------------------------------------------- */

typedef enum { AS_TYPED, TIGHT, ONE } gap;

static bool
is_sign_among(const qdot_token *k, const char *const *signs)
{
    for (; *signs != NULL; signs++)
        if (qdot_token_is(k, *signs))
            return true;
    return false;
}

/* Whether the token ends an operand, so that a sign behind it joins two. A name may be a word, as in `potential -k*x`. */
static bool
ends_operand(const qdot_token *k)
{
    static const char *const closers[] = {")", "]", "'", NULL};

    return k->kind == QDOT_TOKEN_NUMBER || k->kind == QDOT_TOKEN_STRING || is_sign_among(k, closers);
}

/* The space between the tokens k and k + 1 of one line. blank: there is one now; other: there is one on the other side of the
 * sign that one of them is; index: within brackets that follow a name directly. */
static gap
gap_between(const qdot_token *k, bool blank, bool index)
{
    static const char *const openers[] = {"(", "[", NULL}, *const closers[] = {")", "]", ",", ";", NULL};
    static const char *const relations[] = {"=", "==", "<", "<=", ">", ">=", "~", NULL};
    static const char *const signs[] = {"+", "-", NULL}, *const products[] = {"*", "/", "^", "**", NULL};
    const qdot_token *next = k + 1;

    if (is_sign_among(k, openers) || is_sign_among(next, closers))
        return TIGHT;
    if (qdot_token_is(k, ",") || qdot_token_is(k, ";"))
        return index ? (blank ? ONE : TIGHT) : ONE;
    if (qdot_token_is(k, "{") || qdot_token_is(next, "}"))
        return ONE;
    if (is_sign_among(k, relations) || is_sign_among(next, relations))
        return index && !blank ? AS_TYPED : ONE;
    if (qdot_token_is(k, "..") || qdot_token_is(next, ".."))
        return TIGHT;
    if (qdot_token_is(next, ":"))
        return blank ? AS_TYPED : TIGHT;
    if (is_sign_among(k, products) || is_sign_among(next, products) || is_sign_among(k, signs) || is_sign_among(next, signs))
        return AS_TYPED;
    return blank ? ONE : TIGHT;
}

/* A sign between operands has a blank on both sides or on none: *before, *behind whether there are blanks. */
static void
even_out(const qdot_token *sign, bool *before, bool *behind)
{
    static const char *const signs[] = {"+", "-", NULL}, *const products[] = {"*", "/", "^", "**", NULL};

    if (is_sign_among(sign, products)) {
        if (*before != *behind)
            *before = *behind = false;
    } else if (is_sign_among(sign, signs) && *before != *behind) {
        /* `a- b` is a difference; `a -b` may be two operands */
        if (ends_operand(sign - 1) || *behind)
            *before = *behind = ends_operand(sign - 1) || sign[-1].kind == QDOT_TOKEN_NAME ? true : *behind;
    }
}

/* --- lines ---------------------------------------------------------------------------- */

/* The state while the tokens are gone through. */
typedef struct {
    const char *text;
    const qdot_source *source;
    qdot_edit_list *edits;
    size_t depth;      /* of braces */
    qdot_vec(uint8_t) brackets; /* open ones: 1 if an index */
} layout;

static qdot_status
put(layout *l, size_t from, size_t to, const char *text)
{
    qdot_edit edit = {.at = {from, to}};

    if (strlen(text) == to - from && memcmp(l->text + from, text, to - from) == 0)
        return QDOT_OK;
    edit.text = qdot_strdup(text);
    if (edit.text == NULL)
        return QDOT_ENOMEM;
    if (qdot_vec_push(l->edits, edit) == QDOT_OK)
        return QDOT_OK;
    qdot_free(edit.text);
    return QDOT_ENOMEM;
}

/* The bytes of blanks at the beginning of a text. */
static size_t
blanks_at(const char *text)
{
    return strspn(text, " \t");
}

/* Lay out what stands between two tokens of which at least one end of a line does: blanks at the ends of lines go, each line is
 * indented by `indent`, or as far as it was if `least` and it was further. */
static qdot_status
lay_out_lines(layout *l, size_t from, size_t to, size_t indent, bool least)
{
    qdot_text spaces = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = from; i < to && status == QDOT_OK;) {
        const char *end = memchr(l->text + i, '\n', to - i);
        size_t last = end != NULL ? (size_t)(end - l->text) : to, blank, typed = 0;
        bool carriage;

        if (end == NULL)
            break;
        carriage = last > i && l->text[last - 1] == '\r';
        last -= carriage;
        for (blank = last; blank > i && strchr(" \t", l->text[blank - 1]) != NULL;)
            blank--;
        status = put(l, blank, last, "");
        i = last + carriage + 1;
        blank = blanks_at(l->text + i);
        for (size_t k = 0; k < blank; k++)
            typed += l->text[i + k] == '\t' ? 8 - typed % 8 : 1;
        if (i + blank > to || l->text[i + blank] == '\n' || l->text[i + blank] == '\r' || l->text[i + blank] == '\0')
            continue; /* a blank line: its blanks end it */
        qdot_text_truncate(&spaces, 0);
        for (size_t k = 0; k < (least && typed > indent ? typed : indent); k++)
            qdot_text_char(&spaces, ' ');
        if (status == QDOT_OK)
            status = qdot_text_status(&spaces);
        if (status == QDOT_OK)
            status = put(l, i, i + blank, qdot_text_str(&spaces));
        i += blank;
    }
    qdot_text_clear(&spaces);
    return status;
}

/* Whether the bytes hold nothing but blanks. */
static bool
is_blank(const char *text, size_t from, size_t to)
{
    for (; from < to; from++)
        if (text[from] != ' ' && text[from] != '\t')
            return false;
    return true;
}

/* --- statements ----------------------------------------------------------------------- */

/* Lay out the space between the tokens k and k + 1 of a statement. */
static qdot_status
lay_out_gap(layout *l, const qdot_token *first, const qdot_token *k)
{
    const size_t from = k->start + k->length, to = k[1].start;
    bool before, behind, index;

    if (to < from) /* tokens that one character stands for */
        return QDOT_OK;
    if (memchr(l->text + from, '\n', to - from) != NULL)
        return lay_out_lines(l, from, to, (l->depth + 1) * INDENT, true);
    if (!is_blank(l->text, from, to) || k->shown)
        return QDOT_OK;
    index = l->brackets.n > 0 && l->brackets.at[l->brackets.n - 1] == 1;
    behind = from < to;
    if (k > first && !k->shown) { /* k is a sign: the other side is before it */
        before = !k->glued;
        even_out(k, &before, &behind);
    }
    if (k[2].kind != QDOT_TOKEN_END && k[1].kind == QDOT_TOKEN_OPERATOR && memchr(l->text + k[1].start, '\n', k[2].start - k[1].start) == NULL) {
        bool other = !k[2].glued;

        before = behind;
        even_out(k + 1, &before, &other);
        behind = before;
    }
    switch (gap_between(k, behind, index)) {
    case TIGHT: behind = false; break;
    case ONE: behind = true; break;
    default: break;
    }
    return put(l, from, to, behind ? " " : "");
}

/* Lay out the statement, or `}` with its loop, that begins at `first`. *end: its END. */
static qdot_status
lay_out_statement(layout *l, const qdot_token *first, const qdot_token **end)
{
    qdot_status status = QDOT_OK;
    const qdot_token *k = first;

    l->brackets.n = 0;
    for (; k->kind != QDOT_TOKEN_END && status == QDOT_OK; k++) {
        const int turn = qdot_token_bracket(k);

        if (turn > 0)
            status = qdot_vec_push(&l->brackets, (uint8_t)(qdot_token_is(k, "[") && k->glued && k > first));
        else if (turn < 0 && l->brackets.n > 0)
            l->brackets.n--;
        if (status == QDOT_OK && k[1].kind != QDOT_TOKEN_END)
            status = lay_out_gap(l, first, k);
    }
    *end = k;
    return status;
}

/* Lay out what is between two statements: [from, to) holds ends of lines, `;`, comments. */
static qdot_status
lay_out_between(layout *l, size_t from, size_t to, size_t depth)
{
    const char *sign = l->text + from + blanks_at(l->text + from);

    if (*sign == ';' && (size_t)(sign - l->text) < to) { /* a; b */
        const size_t at = (size_t)(sign - l->text), behind = at + 1 + blanks_at(sign + 1);

        QDOT_TRY(put(l, from, at, ""));
        if (behind >= to && to < l->source->length)
            return put(l, at + 1, to, " ");
        from = at + 1;
    }
    return lay_out_lines(l, from, to, depth * INDENT, false);
}

/* Go through the statements and what is between them. */
static qdot_status
lay_out_all(layout *l)
{
    const qdot_token *k = l->source->tokens.at, *last = k + l->source->tokens.n;
    size_t from = strncmp(l->text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    bool beginning = true;

    while (k < last) {
        size_t depth;

        if (k->kind == QDOT_TOKEN_END && k + 1 < last) {
            k++;
            continue;
        }
        if (k->kind == QDOT_TOKEN_END)
            break;
        l->depth -= qdot_token_is(k, "}") && l->depth > 0;
        depth = l->depth;
        if (beginning) /* the first line has no end of a line before it */
            QDOT_TRY(is_blank(l->text, from, k->start) ? put(l, from, k->start, "") : lay_out_lines(l, from, k->start, 0, false));
        else if (memchr(l->text + from, '\n', k->start - from) != NULL || memchr(l->text + from, ';', k->start - from) != NULL)
            QDOT_TRY(lay_out_between(l, from, k->start, depth));
        else if (is_blank(l->text, from, k->start)) /* `{ a` or `a }` in one line */
            QDOT_TRY(put(l, from, k->start, " "));
        beginning = false;
        if (qdot_token_is(k, "{")) {
            l->depth++;
            from = k->start + k->length;
            k++;
            continue;
        }
        QDOT_TRY(lay_out_statement(l, k, &k));
        from = k[-1].start + k[-1].length;
    }
    if (beginning)
        return QDOT_OK;
    QDOT_TRY(lay_out_lines(l, from, l->source->length, 0, false));
    return QDOT_OK;
}

/* Whether the texts have the same tokens; blanks count where they decide how tokens are read. */
static bool
are_equal(const qdot_source *a, const qdot_source *b)
{
    static const char *const bound[] = {"(", "[", "{", "'", ".", NULL};

    if (a->tokens.n != b->tokens.n)
        return false;
    for (size_t i = 0; i < a->tokens.n; i++) {
        const qdot_token *x = &a->tokens.at[i], *y = &b->tokens.at[i];

        if (x->kind != y->kind || strcmp(x->text, y->text) != 0 || x->shown != y->shown ||
            ((x->shown || is_sign_among(x, bound) || (i > 0 && is_sign_among(x - 1, bound) && !qdot_token_is(x - 1, "(") &&
                                                  !qdot_token_is(x - 1, "[") && !qdot_token_is(x - 1, "{"))) &&
             x->glued != y->glued))
            return false;
    }
    return true;
}

/* The text with the edits; the caller's. */
static char *
apply(const qdot_analysis *a, const qdot_edit_list *edits, size_t *length)
{
    qdot_text text = {0};
    size_t from = 0;
    char *whole;

    for (size_t i = 0; i < edits->n; i++) {
        qdot_text_add_n(&text, a->text + from, edits->at[i].at.from - from);
        qdot_text_add(&text, edits->at[i].text);
        from = edits->at[i].at.to;
    }
    qdot_text_add_n(&text, a->text + from, a->length - from);
    *length = text.n;
    whole = text.failed ? NULL : qdot_strndup(qdot_text_str(&text), text.n);
    qdot_text_clear(&text);
    return whole;
}

/* Take the edits back if the text would not have the same tokens. */
static qdot_status
verify(const qdot_analysis *a, qdot_edit_list *edits)
{
    qdot_source *source = NULL;
    size_t length, at;
    char *text = apply(a, edits, &length);
    qdot_status status = text != NULL ? qdot_source_new("", text, length, &source, &at) : QDOT_ENOMEM;

    if (status != QDOT_ENOMEM && (status != QDOT_OK || !are_equal(a->source, source)))
        qdot_layout_clear(edits);
    qdot_free(text);
    qdot_source_free(source);
    return status == QDOT_ENOMEM ? status : QDOT_OK;
}

qdot_status
qdot_layout_edits(const qdot_analysis *a, qdot_edit_list *edits)
{
    layout l = {.text = a->text, .source = a->source, .edits = edits};
    qdot_status status;

    if (a->torn.n > 0 || a->source == NULL)
        return QDOT_OK;
    status = lay_out_all(&l);
    qdot_free(l.brackets.at);
    return status == QDOT_OK ? verify(a, edits) : status;
}

void
qdot_layout_clear(qdot_edit_list *edits)
{
    for (size_t i = 0; i < edits->n; i++)
        qdot_free(edits->at[i].text);
    qdot_free(edits->at);
    *edits = (qdot_edit_list){0};
}
