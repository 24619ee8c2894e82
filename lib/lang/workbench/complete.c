/* complete.c -- lists completions of the word at a position of a text. */
#include "lang/workbench/complete.h"

#include <stdlib.h>
#include <string.h>

#include "base/utf8.h"
#include "expr/function.h"
#include "lang/files/redirect.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/session/labels.h"
#include "lang/session/names.h"
#include "lang/session/row-tables.h"
#include "lang/session/runs.h"
#include "lang/source/letters.h"
#include "lang/source/source.h"
#include "lang/syntax/form.h"
#include "lang/syntax/match.h"
#include "ode/method.h"
#include "show/figure.h"

typedef struct {
    qdot_session *session;
    const char *prefix;
    qdot_vec(char *) words;
    qdot_status status;
} completion;

/* --- words of one kind ---------------------------------------------------------------- */

/* Kinds of words to offer, as bits. */
enum {
    COORDINATES = 1 << 0,
    PARAMETERS = 1 << 1,
    FUNCTIONS = 1 << 2, /* undefined functions declared by the user */
    DEFINED = 1 << 3,   /* expressions and functions defined by the user */
    BUILTINS = 1 << 4, /* functions of the language, once a letter is typed: they are many */
    QUANTITIES = 1 << 5,
    CONSTANTS = 1 << 6, /* the constants pi, t */
    PARTICLES = 1 << 7,
    BODIES = 1 << 8,
    CONSTRAINTS = 1 << 9,
    TIES = 1 << 10, /* labels of springs and dampers, which connect two points */
    APPLIED =
        1 << 11, /* labels of gravities, potentials, dissipations, forces, torques */
    EVENTS = 1 << 12,
    RUNS = 1 << 13,
    METHODS = 1 << 14,
    STATEMENTS = 1 << 15,
    KINDS = 1 << 16, /* words for kinds of things that the statement `remove` accepts */
    TABLES = 1 << 17, /* tables of rows */
    COLOURS = 1 << 18, /* colours of curves */
    RESTS = 1 << 19,   /* the lists of places of rest and of steady motions */
    NAMES = COORDINATES | PARAMETERS | FUNCTIONS | DEFINED,
    LABELS = PARTICLES | BODIES | CONSTRAINTS | TIES | APPLIED | EVENTS,
    EXPRESSION =
        NAMES | BUILTINS | QUANTITIES | CONSTANTS | PARTICLES | BODIES | EVENTS | RUNS,
    CONSTANT = PARAMETERS | FUNCTIONS | DEFINED | BUILTINS | CONSTANTS | EVENTS,
    NOTHING = 0
};

enum { FINAL_SIGMA = 0x3C2 };

static void
offer_word_of_length(completion *c, const char *word, size_t n)
{
    const size_t typed = strlen(c->prefix);
    char *copy;

    if (c->status != QDOT_OK || n < typed || strncmp(word, c->prefix, typed) != 0)
        return;
    copy = qdot_malloc(n + 1);
    if (copy == NULL) {
        c->status = QDOT_ENOMEM;
        return;
    }
    memcpy(copy, word, n);
    copy[n] = '\0';
    c->status = qdot_vec_push(&c->words, copy);
    if (c->status != QDOT_OK)
        qdot_free(copy);
}

static void
offer_word(completion *c, const char *word)
{
    if (word != NULL)
        offer_word_of_length(c, word, strlen(word));
}

/* Offer a family of names, such as x[1], x[2], once, by its name and the opening bracket. */
static void
offer_member(completion *c, const char *name)
{
    const char *bracket = strchr(name, '[');

    if (bracket == NULL)
        offer_word(c, name);
    else if (c->words.n == 0 || strncmp(c->words.at[c->words.n - 1], name,
                                        (size_t)(bracket + 1 - name)) != 0)
        offer_word_of_length(c, name, (size_t)(bracket + 1 - name));
}

static void
offer_names(completion *c, unsigned kinds)
{
    static const unsigned bits[] = {
        [QDOT_NAME_PARAM] = PARAMETERS, [QDOT_NAME_COORD] = COORDINATES,
        [QDOT_NAME_UFUN] = FUNCTIONS,   [QDOT_NAME_VALUE] = DEFINED,
        [QDOT_NAME_FUNCTION] = DEFINED, [QDOT_NAME_INDEX] = 0,
        [QDOT_NAME_ARGUMENT] = 0};
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(c->session->names, i)) != NULL; i++)
        if ((bits[name->kind] & kinds) != 0)
            offer_member(c, name->name);
}

static void
offer_labels(completion *c, unsigned kinds)
{
    const qdot_scene *scene = c->session->scene;

#define OFFER(bit, list, field)                                                          \
    for (size_t i = 0; (kinds & (bit)) != 0 && i < scene->list.n; i++)                   \
        if (scene->list.at[i].field != NULL)                                             \
            offer_member(c, scene->list.at[i].field);
    OFFER(PARTICLES, particles, name)
    OFFER(BODIES, bodies, name)
    OFFER(CONSTRAINTS, constraints, label)
    OFFER(TIES, springs, name)
    OFFER(TIES, dampers, name)
    OFFER(APPLIED, gravities, name)
    OFFER(APPLIED, potentials, name)
    OFFER(APPLIED, dissipations, name)
    OFFER(APPLIED, forces, name)
    OFFER(APPLIED, torques, name)
    OFFER(EVENTS, events, name)
#undef OFFER
}

/* Offer the words of the language's own tables: statements, quantities, functions. */
static void
offer_language_words(completion *c, unsigned kinds)
{
    static const char *const removable[] = {"gravity", "potential",   "spring", "damper",
                                            "force",   "dissipation", "torque"};

    if (c->prefix[0] == '\0')
        kinds &= ~(unsigned)BUILTINS;
    for (size_t i = 0; (kinds & BUILTINS) != 0 && qdot_builtin_at(i) != NULL; i++)
        offer_word(c, qdot_builtin_at(i)->name);
    for (int i = 0; (kinds & BUILTINS) != 0 && i < QDOT_FUNCTION_COUNT; i++)
        offer_word(c, qdot_fun_name((qdot_fun_id)i));
    for (size_t i = 0; (kinds & QUANTITIES) != 0 && qdot_quantity_at(i) != NULL; i++)
        offer_word(c, qdot_quantity_at(i)->name);
    for (size_t i = 0; (kinds & STATEMENTS) != 0 && qdot_statement_at(i) != NULL; i++)
        offer_word(c, qdot_statement_at(i)->word);
    for (size_t i = 0; (kinds & METHODS) != 0 && qdot_ode_method_at(i) != NULL; i++)
        offer_word(c, qdot_ode_method_at(i)->name);
    if ((kinds & METHODS) != 0)
        offer_word(c, "auto");
    for (size_t i = 0; (kinds & COLOURS) != 0 && qdot_figure_colour_name(i) != NULL; i++)
        offer_word(c, qdot_figure_colour_name(i));
    for (size_t i = 0; (kinds & KINDS) != 0 && i < sizeof removable / sizeof *removable;
         i++)
        offer_word(c, removable[i]);
    if ((kinds & RESTS) != 0) {
        offer_word(c, "equilibria");
        offer_word(c, "steady");
    }
    if ((kinds & CONSTANTS) != 0) {
        offer_word(c, "pi");
        offer_word(c, "t");
    }
}

static void
offer_words_of_kinds(completion *c, unsigned kinds)
{
    offer_language_words(c, kinds);
    offer_names(c, kinds);
    offer_labels(c, kinds);
    for (size_t i = 0; (kinds & RUNS) != 0 && i < c->session->runs->n; i++)
        offer_word(c, c->session->runs->at[i].name);
    for (size_t i = 0; (kinds & TABLES) != 0 && i < c->session->tables->n; i++)
        offer_word(c, c->session->tables->at[i]->name);
}

/* --- completion within brackets -------------------------------------------------------- */

/* Offer the indices of the members of a family, up to a comma; false if the family has no members. */
static bool
offer_indices(completion *c, const char *family)
{
    const size_t n = strlen(family);
    const qdot_name *name;
    bool found = false;

    for (size_t i = 0; (name = qdot_names_at(c->session->names, i)) != NULL; i++)
        if (qdot_is_member_of(name->name, family)) {
            offer_word_of_length(c, name->name + n + 1, strcspn(name->name + n + 1, ",]"));
            found = true;
        }
    return found;
}

/* Offer the values that may be an index after `NAME[` or `NAME(...)[`. */
static void
offer_values_of_index(completion *c, const qdot_token *first, const qdot_token *open)
{
    const qdot_token *name = open - 1;
    const qdot_quantity *quantity;
    const qdot_builtin *builtin;
    int depth = 0;

    if (open == first || !open->glued) { /* the bracket opens a matrix or list, not an index */
        offer_words_of_kinds(c, EXPRESSION);
        return;
    }
    if (qdot_token_is(name, ")") || qdot_token_is(name, "]")) {
        do {
            depth -= qdot_token_bracket(name);
            name--;
        } while (depth > 0 && name > first);
        builtin = name->kind == QDOT_TOKEN_NAME ? qdot_builtin_find(name->text) : NULL;
        if (builtin != NULL && builtin->over != NULL)
            offer_words_of_kinds(c, COORDINATES);
        return;
    }
    if (name->kind != QDOT_TOKEN_NAME || offer_indices(c, name->text))
        return;
    quantity = qdot_quantity_find(name->text);
    if (strcmp(name->text, "lambda") == 0)
        offer_words_of_kinds(c, CONSTRAINTS);
    else if (strcmp(name->text, "p") == 0 || strcmp(name->text, "delta") == 0 ||
             strcmp(name->text, "modes") == 0 ||
             (quantity != NULL && quantity->symbol != NULL) ||
             (quantity != NULL && quantity->over_coordinates && quantity->most > 0))
        offer_words_of_kinds(c, COORDINATES);
}

/* Offer labels after `NAME(` if the function NAME takes a label. */
static void
offer_labels_as_argument(completion *c, const qdot_token *first, const qdot_token *open,
                         const qdot_token *end)
{
    const qdot_builtin *builtin =
        open > first && open[-1].kind == QDOT_TOKEN_NAME && open->glued
            ? qdot_builtin_find(open[-1].text)
            : NULL;

    offer_words_of_kinds(c, builtin != NULL && (builtin->flags & QDOT_BUILTIN_LABEL) != 0 &&
                           end == open + 1
                       ? BODIES | PARTICLES
                       : EXPRESSION);
}

/* --- completion within a statement ----------------------------------------------------- */

/* The kinds of words that fit each placeholder ("hole") of the usage texts. */
#define HOLE(statement, before, text, class, expected, kinds) kinds,
static const unsigned hole_kinds[] = {
#include "lang/syntax/holes.def"
};
#undef HOLE

/* Offer the words that may come next according to the usage of the statement; if there are none, `=`. */
static void
offer_next(completion *c, const qdot_next *next, bool operand)
{
    unsigned kinds = next->inside && !operand ? EXPRESSION : NOTHING;
    const size_t before = c->words.n;
    bool equal = false;

    for (int i = 0; i < next->n; i++) {
        const qdot_usage_node *node = next->at[i].node;

        if (node->kind == QDOT_USAGE_WORD)
            offer_word(c, node->text);
        else if (node->kind == QDOT_USAGE_HOLE)
            kinds |= hole_kinds[node->hole];
        else if (node->kind == QDOT_USAGE_SIGN)
            equal = equal || strcmp(node->text, "=") == 0;
    }
    offer_words_of_kinds(c, kinds);
    if (equal && kinds == 0 && c->words.n == before)
        offer_word(c, "=");
}

/* Whether an operand ends with the token. */
static bool
token_ends_operand(const qdot_token *token)
{
    if (token->kind == QDOT_TOKEN_NAME)
        return !qdot_is_connective(token->text);
    return token->kind != QDOT_TOKEN_OPERATOR || strchr(")]}'%", token->text[0]) != NULL;
}

/* Offer what may come behind the tokens from `first` to the end, read by a usage; row NULL: of an expression. word: the
 * first token is that of the row. */
static void
offer_by_usage(completion *c, const qdot_source *source, const qdot_token *first, const qdot_token *end, const qdot_statement *row,
               bool word)
{
    const qdot_cursor at = {.session = c->session, .source = source, .at = first};
    qdot_record record;
    qdot_next next = {.ordered = c->prefix[0] == '\0'}; /* what is typed may be any of them */
    qdot_usage u;
    qdot_status status;

    if (!qdot_usage_compile_with_end(&u, row != NULL ? row->word : "", row != NULL ? row->usage : "EXPR", qdot_redirect_answers(row)))
        return;
    status = qdot_match_begun(&at, row, &u, word, &next, &record);
    qdot_record_free(&record);
    if (status == QDOT_OK)
        offer_next(c, &next, token_ends_operand(end - 1));
    else
        c->status = status;
}

/* Offer words after the tokens [first, end) of a statement, of which no bracket is open. */
static void
offer_in_statement(completion *c, const qdot_source *source, const qdot_token *first, const qdot_token *end)
{
    const qdot_statement *row = first < end ? qdot_statement_row(first) : NULL;

    if (first == end) {
        offer_words_of_kinds(c, STATEMENTS | (c->prefix[0] != '\0' ? EXPRESSION : 0));
        return;
    }
    if (row != NULL)
        offer_by_usage(c, source, first, end, row, true);
    if (row != NULL && !row->alone && !(end > first + 1 && qdot_token_is(first + 1, "=")))
        return;
    if (qdot_statement_form(c->session, first) == QDOT_FORM_COMPARISON)
        offer_by_usage(c, source, first, end, qdot_statement_find("check"), false);
    else
        offer_by_usage(c, source, first, end, NULL, false);
}

/* Whether a blank is needed between the token and a word. */
static bool
needs_blank_after(const qdot_token *token)
{
    return token->kind != QDOT_TOKEN_END &&
           (token->kind != QDOT_TOKEN_OPERATOR || strchr(")]'%", token->text[0]) != NULL);
}

/* Offer words after the tokens [first, end); `open` is an unclosed bracket among them, NULL: there is none. */
static void
offer_after_tokens(completion *c, const qdot_source *source, const qdot_token *first, const qdot_token *open,
                   const qdot_token *end)
{
    if (end > first && qdot_token_is(end - 1, ".") && end[-1].glued)
        offer_words_of_kinds(c, EXPRESSION); /* a name after `a.`: an expression along run a */
    else if (open == NULL)
        offer_in_statement(c, source, first, end);
    else if (qdot_token_is(open, "["))
        offer_values_of_index(c, first, open);
    else
        offer_labels_as_argument(c, first, open, end);
}

/* Find the statement that contains the last of the first n tokens, and its innermost open bracket, and offer words there. */
static void
offer_at_end_of_tokens(completion *c, const qdot_source *source, size_t n)
{
    const qdot_token *end = source->tokens.at + n, *first = source->tokens.at, *open = NULL;
    int64_t depth = 0;

    for (const qdot_token *k = first; k < end; k++)
        if (k->kind == QDOT_TOKEN_END || qdot_token_is(k, "{"))
            first = k + 1;
    for (const qdot_token *k = end; k > first && open == NULL;) {
        depth += qdot_token_bracket(--k);
        if (depth > 0)
            open = k;
    }
    offer_after_tokens(c, source, first, open, end);
}

/* --- completion of a text -------------------------------------------------------------- */

static int
compare_spelling(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Return the words, sorted and without repetition. */
static qdot_status
return_sorted_words(completion *c, char ***words, size_t *n)
{
    size_t kept = 0;

    if (c->words.n > 0)
        qsort(c->words.at, c->words.n, sizeof *c->words.at, compare_spelling);
    for (size_t i = 0; i < c->words.n; i++) {
        if (kept > 0 && strcmp(c->words.at[kept - 1], c->words.at[i]) == 0)
            qdot_free(c->words.at[i]);
        else
            c->words.at[kept++] = c->words.at[i];
    }
    if (c->status != QDOT_OK) {
        while (kept > 0)
            qdot_free(c->words.at[--kept]);
        qdot_free(c->words.at);
        c->words.at = NULL;
    }
    *words = c->words.at;
    *n = kept;
    return c->status;
}

/* The spelled name of a prefix that holds Greek letters or lowered digits, θ₁ as theta1; false: it holds
 * none. */
static bool
spell_prefix_in_ascii(const char *prefix, qdot_text *out)
{
    bool any = false;

    for (size_t i = 0, bytes; prefix[i] != '\0'; i += bytes) {
        const uint32_t code = qdot_utf8_decode(prefix + i, &bytes);
        const char *name = code == 0 ? NULL : qdot_letters_greek(code);
        const int digit = code < 0x80 ? -1 : qdot_letters_subscript(code);

        any = any || name != NULL || digit >= 0;
        bytes = bytes > 0 ? bytes : 1;
        if (name != NULL)
            qdot_text_add(out, name);
        else if (digit >= 0)
            qdot_text_char(out, (char)('0' + digit));
        else
            qdot_text_add_n(out, prefix + i, bytes);
    }
    return any;
}

/* Let each offered word begin as the prefix was typed, instead of with its ASCII spelling of length `spelled`. */
static void
restore_typed_prefix(completion *c, size_t spelled, const char *typed)
{
    for (size_t i = 0; i < c->words.n && c->status == QDOT_OK; i++) {
        qdot_text word = {0};

        qdot_text_add(&word, typed);
        qdot_text_add(&word, c->words.at[i] + spelled);
        c->status = qdot_text_status(&word);
        if (c->status == QDOT_OK) {
            qdot_free(c->words.at[i]);
            c->words.at[i] = word.at;
        } else {
            qdot_text_clear(&word);
        }
    }
}

qdot_status
qdot_complete(qdot_session *session, const char *before, size_t length,
              const char *prefix, char ***words, size_t *n)
{
    qdot_text spelled = {0};
    const bool greek = spell_prefix_in_ascii(prefix, &spelled);
    completion c = {.session = session, .prefix = qdot_text_str(&spelled)};
    qdot_source *source;
    size_t at;

    /* an open bracket is an error, but all tokens are available */
    c.status = qdot_text_status(&spelled);
    source = NULL;
    if (c.status == QDOT_OK)
        c.status = qdot_source_new("completion", before, length, &source, &at);
    if (source != NULL) {
        size_t tokens = source->tokens.n;

        if (c.status == QDOT_OK &&
            !(length > 0 && strchr(";\n{}", before[length - 1]) != NULL))
            tokens--; /* do not count the token END that closes the text */
        /* the lexer ends a list of tokens with END, except one on which it failed */
        c.status = qdot_vec_push(&source->tokens, ((qdot_token){.text = "", .start = (uint32_t)length}));
        if (c.status != QDOT_OK)
            ;
        else if (tokens == 0 || !needs_blank_after(source->tokens.at + tokens - 1) ||
            source->tokens.at[tokens - 1].start + source->tokens.at[tokens - 1].length <
                length)
            offer_at_end_of_tokens(&c, source, tokens);
        qdot_source_free(source);
    }
    if (greek)
        restore_typed_prefix(&c, spelled.n, prefix);
    qdot_text_clear(&spelled);
    return return_sorted_words(&c, words, n);
}

qdot_status
qdot_complete_greek(const char *prefix, bool letter, char ***words, size_t *n)
{
    completion c = {.prefix = "\\"};
    char word[32] = "";
    uint32_t only = 0;

    for (uint32_t code = 0x391; code <= 0x3C9; code++) {
        const char *name = code == FINAL_SIGMA ? NULL : qdot_letters_greek(code);

        if (name == NULL || strncmp(name, prefix, strlen(prefix)) != 0)
            continue;
        only = c.words.n == 0 ? code : 0;
        snprintf(word, sizeof word, "\\%s", name);
        offer_word(&c, word);
    }
    if (only != 0 && c.status == QDOT_OK) {
        /* the two bytes of UTF-8 for a code point below U+0800 */
        const char sign[] = {(char)(0xC0 | only >> 6), (char)(0x80 | (only & 0x3F)),
                             '\0'};

        strcpy(c.words.at[0], letter ? sign : word + 1);
    }
    return return_sorted_words(&c, words, n);
}

/* --- completions at a place of a text ----------------------------------------------------- */

qdot_place
qdot_complete_place(const char *text, size_t length)
{
    qdot_place place = QDOT_PLACE_PLAIN;

    for (size_t i = 0; i < length; i++) {
        if (place == QDOT_PLACE_COMMENT)
            place = text[i] == '\n' ? QDOT_PLACE_PLAIN : QDOT_PLACE_COMMENT;
        else if (text[i] == '"')
            place = place == QDOT_PLACE_QUOTED ? QDOT_PLACE_PLAIN : QDOT_PLACE_QUOTED;
        else if (text[i] == '#' && place == QDOT_PLACE_PLAIN)
            place = QDOT_PLACE_COMMENT;
        else if (text[i] == '\\' && place == QDOT_PLACE_QUOTED && i + 1 < length)
            i++;
    }
    return place;
}

qdot_status
qdot_complete_at(qdot_session *session, const char *text, size_t cursor, size_t *start, char ***words, size_t *n)
{
    qdot_text prefix = {0};
    qdot_status status;

    *words = NULL;
    *n = 0;
    *start = cursor;
    while (*start > 0 && strchr(QDOT_COMPLETE_BREAKS, text[*start - 1]) == NULL)
        --*start;
    if (qdot_complete_place(text, *start) != QDOT_PLACE_PLAIN)
        return QDOT_OK;
    qdot_text_add_n(&prefix, text + *start, cursor - *start);
    status = qdot_text_status(&prefix);
    if (status == QDOT_OK && qdot_text_str(&prefix)[0] == '\\')
        status = qdot_complete_greek(qdot_text_str(&prefix) + 1, true, words, n);
    else if (status == QDOT_OK)
        status = qdot_complete(session, text, *start, qdot_text_str(&prefix), words, n);
    qdot_text_clear(&prefix);
    return status;
}
