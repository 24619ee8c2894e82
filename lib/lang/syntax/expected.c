/* expected.c -- the error message for a token that does not fit the usage text of its statement. */
#include "lang/syntax/expected.h"

#include <stdio.h>
#include <string.h>

#include "lang/syntax/holes.h"

/* The options of a run, for messages. */
#define RUN_OPTIONS "`tol`, `digits`, `method`, `with`, `constraints`"

typedef struct {
    const char *statement, *before, *what, *hint;
    bool name; /* the row of the table is used if a name stands at this place */
} expected_row;

static const expected_row rows[] = {
#define EXPECTED(statement, before, what, hint) {statement, before, what, hint, false},
#define EXPECTED_AT_NAME(statement, before, what, hint) {statement, before, what, hint, true},
#define REFUSED(statement, beside, word, status, message, hint)
#include "lang/syntax/expected.def"
};
#undef EXPECTED
#undef EXPECTED_AT_NAME
#undef REFUSED

static const struct {
    const char *statement, *beside, *word;
    qdot_status status;
    const char *message, *hint;
} refused[] = {
#define EXPECTED(statement, before, what, hint)
#define EXPECTED_AT_NAME(statement, before, what, hint)
#define REFUSED(statement, beside, word, status, message, hint)                          \
    {statement, beside, word, status, message, hint},
#include "lang/syntax/expected.def"
};
#undef EXPECTED
#undef EXPECTED_AT_NAME
#undef REFUSED

static bool
is_for_statement(const char *statement, const qdot_expected *list)
{
    return statement == NULL || strcmp(statement, list->usage->word) == 0;
}

/* Whether the words or signs of which `first` is the first come behind `before`, or behind the first word of it where
 * `next` (the first that is no option taken before) or `sign`, which is among them, is its second. next, sign may be
 * NULL. */
static bool
row_fits_context(const char *before, const qdot_usage_node *first, const qdot_usage_node *next,
                 const qdot_usage_node *sign)
{
    const size_t n = strlen(first->before);

    return strncmp(before, first->before, n) == 0 &&
           (before[n] == '\0' ||
            (before[n] == ' ' && ((next != NULL && strcmp(before + n + 1, next->text) == 0) ||
                                  (sign != NULL && strcmp(before + n + 1, sign->text) == 0))));
}

/* Add to the list all nodes of the usage automaton that may come next at `node`. */
static void
collect_expected(qdot_expected *list, int node, bool taken)
{
    const qdot_usage_node *at = &list->usage->node[node];

    if (at->kind == QDOT_USAGE_FORK) {
        collect_expected(list, at->next, taken);
        if (at->other >= 0)
            collect_expected(list, at->other, taken);
        return;
    }
    list->hole = list->hole || at->kind == QDOT_USAGE_HOLE;
    list->open = list->open || (at->kind == QDOT_USAGE_HOLE && !taken);
    list->given = list->given || (taken && at->kind == QDOT_USAGE_WORD &&
                                  qdot_token_is_word(list->token, at->text));
    for (int i = 0; i < list->n; i++)
        if (list->node[i] == node)
            return;
    if (list->n < QDOT_EXPECTED_NODES) {
        list->taken[list->n] = taken;
        list->node[list->n++] = node;
    }
}

void
qdot_expected_add(qdot_expected *list, int node, uint64_t taken)
{
    const qdot_usage_node *at = &list->usage->node[node];

    if (at->kind != QDOT_USAGE_FORK)
        collect_expected(list, node, false);
    else if ((taken & at->enters) != 0)
        collect_expected(list, at->next, true);
}

/* The first node of this kind in the order of the usage; open: only if its option may still come.
 * NULL: none. */
static const qdot_usage_node *
first_expected_of_kind(const qdot_expected *list, int kind, bool open)
{
    int first = -1;

    for (int i = 0; i < list->n; i++)
        if ((int)list->usage->node[list->node[i]].kind == kind && !(open && list->taken[i]) &&
            (first < 0 || list->node[i] < first))
            first = list->node[i];
    return first >= 0 ? &list->usage->node[first] : NULL;
}

/* Whether an earlier node of the list of expected words has the same word. */
static bool
is_listed_before(const qdot_expected *list, int node)
{
    for (int i = 0; i < list->n; i++)
        if (list->node[i] < node &&
            list->usage->node[list->node[i]].kind == QDOT_USAGE_WORD &&
            strcmp(list->usage->node[list->node[i]].text, list->usage->node[node].text) == 0)
            return true;
    return false;
}

/* List the expected words, `a`, `b` or `c`, in the order of the usage. */
static void
list_expected_words(const qdot_expected *list, char what[QDOT_EXPECTED_TEXT])
{
    const char *word[QDOT_EXPECTED_NODES];
    int n = 0;
    size_t length = 0;

    for (int node = 0; node < list->usage->n; node++)
        for (int i = 0; i < list->n; i++)
            if (list->node[i] == node && list->usage->node[node].kind == QDOT_USAGE_WORD &&
                !is_listed_before(list, node))
                word[n++] = list->usage->node[node].text;
    for (int i = 0; i < n && length < QDOT_EXPECTED_TEXT; i++)
        length += (size_t)snprintf(what + length, QDOT_EXPECTED_TEXT - length, "%s`%s`",
                                   i == 0 ? "" : i + 1 < n ? ", " : " or ", word[i]);
}

/* Write the text of a row. "`WORD` ..." at its end stands for the option WORD, those behind it in the usage after the same
 * word, and the end of the statement. */
static void
write_row(const qdot_expected *list, const char *text, const char *before, char what[QDOT_EXPECTED_TEXT])
{
    const char *gap = strstr(text, "` ..."), *word = gap;
    const size_t n = strlen(text) - (gap != NULL ? strlen(" ...") : 0);
    size_t length = (size_t)snprintf(what, QDOT_EXPECTED_TEXT, "%.*s", (int)n, text);
    bool behind = false;

    if (gap == NULL)
        return;
    while (word > text && word[-1] != '`')
        word--;
    for (int i = 0; i < list->usage->n && length < QDOT_EXPECTED_TEXT; i++) {
        const qdot_usage_node *node = &list->usage->node[i];

        if (node->kind != QDOT_USAGE_WORD || strcmp(node->before, before) != 0 || strcmp(node->text, list->usage->word) == 0)
            continue;
        if (behind)
            length += (size_t)snprintf(what + length, QDOT_EXPECTED_TEXT - length, ", `%s`", node->text);
        behind = behind || strncmp(node->text, word, (size_t)(gap - word)) == 0;
    }
    if (length < QDOT_EXPECTED_TEXT)
        snprintf(what + length, QDOT_EXPECTED_TEXT - length, " or the end of the statement");
}

/* The row of expected.def for expected words or signs that begin with `first`; NULL if none. */
static const expected_row *
find_row_of_expected(const qdot_expected *list, const qdot_usage_node *first, const qdot_usage_node *sign)
{
    const qdot_usage_node *next = first_expected_of_kind(list, QDOT_USAGE_WORD, true);

    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (is_for_statement(rows[i].statement, list) && row_fits_context(rows[i].before, first, next, sign) &&
            (!rows[i].name || list->token->kind == QDOT_TOKEN_NAME))
            return &rows[i];
    return NULL;
}

const char *
qdot_expected_words(const qdot_expected *list, char what[QDOT_EXPECTED_TEXT])
{
    const qdot_usage_node *word = first_expected_of_kind(list, QDOT_USAGE_WORD, false),
                          *sign = first_expected_of_kind(list, QDOT_USAGE_SIGN, false),
                          *hole = first_expected_of_kind(list, QDOT_USAGE_HOLE, false),
                          *end = first_expected_of_kind(list, QDOT_USAGE_END, false),
                          *first = word != NULL ? word : sign;
    const expected_row *row = first != NULL ? find_row_of_expected(list, first, sign) : NULL;

    if (sign != NULL && strcmp(sign->text, "=") == 0 && (word != NULL || end == NULL)) {
        snprintf(what, QDOT_EXPECTED_TEXT, "`=`");
        return NULL;
    }
    if (row != NULL) {
        write_row(list, row->what, first->before, what);
        return row->hint;
    }
    if (word != NULL)
        list_expected_words(list, what);
    else if (end != NULL)
        snprintf(what, QDOT_EXPECTED_TEXT, "the end of the statement");
    else if (sign != NULL)
        snprintf(what, QDOT_EXPECTED_TEXT, "`%s`", sign->text);
    else
        snprintf(what, QDOT_EXPECTED_TEXT, "%s",
                 hole != NULL ? qdot_hole_at(hole->hole)->expected : "the end of the statement");
    return NULL;
}

const char *
qdot_expected_clause(const char *statement, const char *word)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (rows[i].statement != NULL && strcmp(rows[i].statement, statement) == 0 &&
            strncmp(rows[i].before, "... ", 4) == 0 && strcmp(rows[i].before + 4, word) == 0)
            return rows[i].what;
    return NULL;
}

/* Give the hint of a table row, with the token or earlier text inserted for `%s` or `%n`. */
static void
give_hint_of_row(const char *hint, const qdot_token *token, const qdot_record *r)
{
    const char *gap = strchr(hint, '%');
    const qdot_filled *last = &r->parts.at[r->parts.n - 1];

    if (gap == NULL)
        (void)qdot_hint("%s", hint);
    else if (gap[1] == 's')
        (void)qdot_hint("%.*s%.100s%s", (int)(gap - hint), hint, token[1].text, gap + 2);
    else if (last->name != NULL)
        (void)qdot_hint("%.*s%.*s%s", (int)(gap - hint), hint,
                        (int)(last->primes[-1].start + last->primes[-1].length - last->name->start),
                        r->cursor.source->text + last->name->start, gap + 2);
}

bool
qdot_expected_refuses(const qdot_expected *list, const qdot_record *r)
{
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        const bool is = refused[i].word == NULL ? !list->open || r->parts.n == 1
                                                : qdot_token_is_word(list->token, refused[i].word) ||
                                                      qdot_token_is(list->token, refused[i].word);

        if (!is_for_statement(refused[i].statement, list) || !is ||
            (refused[i].beside != NULL && (!list->given || qdot_record_word(r, refused[i].beside) == NULL)))
            continue;
        (void)qdot_fail(refused[i].status, "%s", refused[i].message);
        if (refused[i].hint != NULL)
            give_hint_of_row(refused[i].hint, list->token, r);
        return true;
    }
    return false;
}
