/* names.c -- where the names of a script are declared, and where they stand. */
#include "lang/analysis/names.h"

#include <string.h>

#include "lang/analysis/meaning.h"
#include "lang/analysis/pieces.h"
#include "lang/language/enclosing.h"
#include "lang/session/names.h"
#include "lang/source/source.h"
#include "lang/syntax/form.h"
#include "lang/syntax/outline.h"
#include "lang/workbench/highlight.h"
#include "mech/scene/scene.h"

/* What the search of a source has at hand. */
typedef struct {
    const qdot_analysis *a;
    const qdot_source *source;
    const uint8_t *kinds; /* what each byte is (workbench/highlight) */
    const qdot_piece *piece;
    size_t number; /* of the piece */
    qdot_vec(const qdot_token *) bound; /* names that the piece binds: arguments, indices */
    bool integrates; /* the piece may bind variables of integrals and limits */
    qdot_occurrence_list *list;
} search;

static bool
is_word(const search *s, const qdot_token *k)
{
    return k->kind == QDOT_TOKEN_NAME && s->kinds[k->start] == QDOT_HIGHLIGHT_WORD;
}

static bool
is_name(const search *s, const qdot_token *k)
{
    return k->kind == QDOT_TOKEN_NAME && s->kinds[k->start] != QDOT_HIGHLIGHT_WORD;
}

/* --- what a statement declares -------------------------------------------------------- */

/* The name that the item [from, to) of a list of new names declares, as x in `a < x < b`, m in `m > 0 = 1`; NULL: none. */
static const qdot_token *
declared_in_item(const search *s, const qdot_token *from, const qdot_token *to)
{
    const qdot_token *first = NULL, *last = NULL;
    int signs = 0;

    for (const qdot_token *k = from; k < to && !qdot_token_is(k, "=") && !qdot_token_is(k, "["); k++) {
        if (qdot_token_is(k, "<") || qdot_token_is(k, "<="))
            signs++;
        else if (is_name(s, k) && signs < 2)
            last = k;
        if (first == NULL && is_name(s, k))
            first = k;
    }
    return signs == 2 ? last : first;
}

/* Whether the statement of the row declares a list of names. */
static bool
declares_list(const qdot_statement *row, qdot_role *role)
{
    static const struct {
        const char *word;
        qdot_role role;
    } rows[] = {{"param", QDOT_ROLE_PARAMETER}, {"input", QDOT_ROLE_PARAMETER},   {"coord", QDOT_ROLE_COORDINATE},
                {"state", QDOT_ROLE_COORDINATE}, {"speed", QDOT_ROLE_COORDINATE}, {"function", QDOT_ROLE_FUNCTION}};

    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (strcmp(row->word, rows[i].word) == 0) {
            *role = rows[i].role;
            return true;
        }
    return false;
}

/* The label that the statement [first, end) gives; NULL: none. */
static const qdot_token *
label_of(const search *s, const qdot_token *first, const qdot_token *end)
{
    const qdot_token *label = first + (qdot_token_is_word(first, "joint") ? 2 : 1); /* behind the kind of the joint */
    bool thing = qdot_token_is_word(first, "particle") || qdot_token_is_word(first, "body");
    const qdot_token *behind;

    if (label >= end || !is_name(s, label))
        return NULL;
    behind = qdot_token_behind_index(label);
    thing = thing || (behind < end && qdot_token_is_word(behind, "between"));
    return thing || (behind < end && qdot_token_is(behind, ":")) ? label : NULL;
}

/* Whether the name at k is one of the coordinates that the joint [first, end) names: `angle a, b`, `length s`. */
static bool
is_coordinate_of_joint(const search *s, const qdot_token *first, const qdot_token *k)
{
    const qdot_token *word = k;
    int depth = 0;

    while (word > first && !(depth == 0 && is_word(s, word)))
        depth -= qdot_token_bracket(word--);
    return word > first && (qdot_token_is_word(word, "angle") || qdot_token_is_word(word, "length")) &&
           (k == word + 1 || qdot_token_is(k - 1, ","));
}

/* Whether the name at k is declared by the statement [first, end). */
static bool
is_declared_at(const search *s, const qdot_token *first, const qdot_token *end, const qdot_token *k, qdot_role *role)
{
    const qdot_form form = qdot_statement_form(s->a->session, first);
    const qdot_statement *row = form == QDOT_FORM_WORD ? qdot_statement_row(first) : NULL;
    const qdot_token *from = first + 1;
    int depth = 0;

    if (row == NULL) {
        const bool call = k + 1 < end && qdot_token_is(k + 1, "(");

        *role = call ? QDOT_ROLE_FUNCTION : QDOT_ROLE_VALUE;
        return k == first && form == QDOT_FORM_DEFINITION;
    }
    if (k > first + 1 && qdot_token_is_word(k - 1, "as") && is_word(s, k - 1)) {
        *role = QDOT_ROLE_RUN;
        return true;
    }
    if (k == first + 1 && qdot_token_is_word(first, "data")) {
        *role = QDOT_ROLE_FUNCTION;
        return true;
    }
    if (qdot_token_is_word(first, "joint") && is_coordinate_of_joint(s, first, k)) {
        *role = QDOT_ROLE_COORDINATE;
        return true;
    }
    if (!declares_list(row, role)) {
        *role = QDOT_ROLE_LABEL;
        return qdot_statement_declares(row) && k == label_of(s, first, end);
    }
    for (const qdot_token *i = first + 1; i <= end; i++) {
        const bool over = i == end || (depth == 0 && (qdot_token_is(i, ",") || (is_word(s, i) && qdot_token_is_word(i, "for"))));

        if (over && k >= from && k < i)
            return k == declared_in_item(s, from, i);
        if (i == end || (over && !qdot_token_is(i, ",")))
            break;
        depth += qdot_token_bracket(i);
        from = over ? i + 1 : from;
    }
    return false;
}

/* --- places --------------------------------------------------------------------------- */

/* List the names that the piece binds. */
static qdot_status
list_bound(search *s)
{
    const qdot_token *from = s->source->tokens.at + s->piece->first, *to = s->source->tokens.at + s->piece->end;

    s->bound.n = 0;
    s->integrates = false;
    for (const qdot_token *k = from; k < to; k++) {
        s->integrates = s->integrates || qdot_token_is_word(k, "integral") || qdot_token_is_word(k, "limit");
        if (qdot_meaning_binds(from, to, k) != QDOT_BOUND_NOT)
            QDOT_TRY(qdot_vec_push(&s->bound, k));
    }
    return QDOT_OK;
}

/* Whether the name at k is an argument or index; *weak: it may also be a parameter or coordinate. */
static bool
is_local(const search *s, const qdot_token *k, bool *weak)
{
    const qdot_token *from = s->source->tokens.at + s->piece->first, *to = s->source->tokens.at + s->piece->end;

    *weak = s->integrates && qdot_enclosing_binds(&(qdot_cursor){.source = s->source}, k);
    for (size_t i = 0; i < s->bound.n; i++)
        if (strcmp(s->bound.at[i]->text, k->text) == 0) {
            *weak = qdot_meaning_binds(from, to, s->bound.at[i]) != QDOT_BOUND_ARGUMENT;
            if (!*weak)
                return true;
        }
    return *weak;
}

static qdot_status
add_occurrence(search *s, const qdot_token *first, const qdot_token *end, const qdot_token *k)
{
    qdot_occurrence o = {.name = k->text, .at = {k->start, k->start + k->length}, .piece = s->number};

    o.declares = is_declared_at(s, first, end, k, &o.role);
    if (!o.declares)
        o.role = is_local(s, k, &o.weak) ? QDOT_ROLE_LOCAL : QDOT_ROLE_UNKNOWN;
    return qdot_vec_push(s->list, o);
}

/* Whether a unit begins at the token, `[` after a blank behind an operand: 3 [m], x [s]. */
static bool
is_unit(const search *s, const qdot_token *k)
{
    const qdot_token *before = k - 1, *behind;

    if (!qdot_token_is(k, "[") || k->glued)
        return false;
    behind = qdot_token_behind_bracket(k);
    for (const qdot_token *i = k; i < behind; i++)
        if (qdot_token_is(i, "=") || qdot_token_is(i, ",")) /* a list of values, as behind `at` */
            return false;
    return behind > k && (before->kind == QDOT_TOKEN_NUMBER || is_name(s, before) || qdot_token_is(before, ")") ||
                          qdot_token_is(before, "]") || qdot_token_is(before, "'"));
}

static qdot_status
add_statement(search *s, const qdot_token *first, const qdot_token *end)
{
    for (const qdot_token *k = first; k < end; k++) {
        if (k > first && is_unit(s, k))
            k = qdot_token_behind_bracket(k) - 1;
        else if (is_name(s, k))
            QDOT_TRY(add_occurrence(s, first, end, k));
    }
    return QDOT_OK;
}

static qdot_status
add_names_of_piece(search *s)
{
    const qdot_token *tokens = s->source->tokens.at, *end = tokens + s->piece->end;

    QDOT_TRY(list_bound(s));
    for (const qdot_token *k = tokens + s->piece->first; k < end;) {
        if (k->kind == QDOT_TOKEN_END || qdot_token_is(k, "{") || qdot_token_is(k, "}")) {
            k++;
        } else {
            QDOT_TRY(add_statement(s, k, qdot_outline_end(k)));
            k = qdot_outline_end(k);
        }
    }
    return QDOT_OK;
}

/* Order by name, in a table of lists: what is declared is found in one step. */
typedef struct {
    const qdot_occurrence_list *list;
    qdot_vec(size_t) first; /* [buckets], 1 + index of an occurrence that declares; 0: none */
    qdot_vec(size_t) next;
} declared;

static size_t
bucket_of(const declared *d, const char *name)
{
    size_t h = 5381;

    while (*name != '\0')
        h = h * 33 + (unsigned char)*name++;
    return h & (d->first.n - 1);
}

static const qdot_occurrence *
find_declared(const declared *d, const char *name)
{
    for (size_t i = d->first.at[bucket_of(d, name)]; i > 0; i = d->next.at[i - 1])
        if (strcmp(d->list->at[i - 1].name, name) == 0)
            return &d->list->at[i - 1];
    return NULL;
}

static qdot_status
list_declared(declared *d, const qdot_occurrence_list *list)
{
    d->list = list;
    while (d->first.n < 1024)
        QDOT_TRY(qdot_vec_push(&d->first, (size_t)0));
    for (size_t i = 0; i < list->n; i++) {
        QDOT_TRY(qdot_vec_push(&d->next, (size_t)0));
        if (!list->at[i].declares || find_declared(d, list->at[i].name) != NULL)
            continue;
        d->next.at[i] = d->first.at[bucket_of(d, list->at[i].name)];
        d->first.at[bucket_of(d, list->at[i].name)] = i + 1;
    }
    return QDOT_OK;
}

/* The role of a name that other scripts declare. */
static qdot_role
role_in_session(const qdot_session *session, const char *name)
{
    const qdot_name *known = qdot_names_find(session->names, name);

    if (known == NULL)
        known = qdot_names_first_member(session->names, name);
    if (known == NULL)
        return qdot_scene_has_label(session->scene, name) ? QDOT_ROLE_LABEL : QDOT_ROLE_UNKNOWN;
    return known->kind == QDOT_NAME_PARAM                                       ? QDOT_ROLE_PARAMETER
           : known->kind == QDOT_NAME_COORD || known->kind == QDOT_NAME_SPEED   ? QDOT_ROLE_COORDINATE
           : known->kind == QDOT_NAME_UFUN || known->kind == QDOT_NAME_FUNCTION ? QDOT_ROLE_FUNCTION
                                                                                : QDOT_ROLE_VALUE;
}

/* The bytes with which the text of a differential begins, before the name of its coordinate: d, delta, δ. */
static size_t
length_of_prefix(const char *text, const char *name, size_t *spelled)
{
    *spelled = strncmp(name, "delta", 5) == 0 ? 5 : name[0] == 'd' ? 1 : 0;
    return strncmp(text, name, *spelled) == 0 ? *spelled : *spelled == 5 && strncmp(text, "\xCE\xB4", 2) == 0 ? 2 : 0;
}

/* Give the places that declare nothing the role of what is declared with their name. */
static void
find_roles(search *s, const declared *d)
{
    for (size_t i = 0; i < s->list->n; i++) {
        qdot_occurrence *o = &s->list->at[i];
        const qdot_occurrence *found;
        size_t spelled;
        const size_t prefix = length_of_prefix(s->source->text + o->at.from, o->name, &spelled);

        qdot_role role;

        if (o->declares || (o->role == QDOT_ROLE_LOCAL && !o->weak))
            continue;
        found = find_declared(d, o->name);
        role = found != NULL ? found->role : role_in_session(s->a->session, o->name);
        if (o->weak && (role == QDOT_ROLE_UNKNOWN || role == QDOT_ROLE_LABEL || role == QDOT_ROLE_RUN))
            continue;
        o->role = role;
        if (o->role != QDOT_ROLE_UNKNOWN || prefix == 0)
            continue;
        found = find_declared(d, o->name + spelled);
        if (found != NULL && found->role == QDOT_ROLE_COORDINATE) {
            o->name += spelled;
            o->at.from += prefix;
            o->role = QDOT_ROLE_COORDINATE;
        }
    }
}

qdot_status
qdot_names_of_source(const qdot_analysis *a, const qdot_source *source, qdot_occurrence_list *list)
{
    qdot_piece_list pieces = {0};
    uint8_t *kinds = qdot_malloc(source->length + 1);
    search s = {.a = a, .source = source, .kinds = kinds, .list = list};
    declared d = {0};
    qdot_status status = kinds != NULL ? qdot_pieces_of(source, &pieces) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_highlight_text(a->session, source->text, source->length, kinds);
    for (size_t i = 0; i < pieces.n && status == QDOT_OK; i++) {
        s.piece = &pieces.at[i];
        s.number = i;
        status = add_names_of_piece(&s);
    }
    if (status == QDOT_OK)
        status = list_declared(&d, list);
    if (status == QDOT_OK)
        find_roles(&s, &d);
    qdot_free(s.bound.at);
    qdot_free(d.first.at);
    qdot_free(d.next.at);
    qdot_free(pieces.at);
    qdot_free(kinds);
    return status;
}

const qdot_occurrence *
qdot_names_at_byte(const qdot_occurrence_list *list, size_t at)
{
    for (size_t i = 0; i < list->n; i++)
        if (list->at[i].at.from <= at && at <= list->at[i].at.to)
            return &list->at[i];
    return NULL;
}

bool
qdot_names_are_same(const qdot_occurrence *a, const qdot_occurrence *b)
{
    if (a->role == QDOT_ROLE_UNKNOWN || b->role == QDOT_ROLE_UNKNOWN || strcmp(a->name, b->name) != 0)
        return false;
    return (a->role == QDOT_ROLE_LOCAL) == (b->role == QDOT_ROLE_LOCAL) && (a->role != QDOT_ROLE_LOCAL || a->piece == b->piece);
}
