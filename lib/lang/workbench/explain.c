/* explain.c -- finds the word at a place of a text, and what the language and the session know of it. */
#include "lang/workbench/explain.h"

#include <inttypes.h>
#include <string.h>

#include "expr/function.h"
#include "expr/node.h"
#include "lang/answer/expression.h"
#include "lang/answer/write.h"
#include "lang/ask/declared.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quantity.h"
#include "lang/language/read.h"
#include "lang/session/names.h"
#include "lang/session/units.h"
#include "lang/source/source.h"
#include "lang/syntax/form.h"
#include "lang/syntax/statement.h"
#include "lang/workbench/highlight.h"
#include "lang/workbench/topics.h"
#include "mech/scene/scene.h"
#include "ode/method.h"

/* The word that is explained, within the tokens of its source. */
typedef struct {
    qdot_session *session;
    const qdot_source *source;
    qdot_style style;
    const qdot_token *first, *word; /* first token of the statement; the word */
    bool in_brackets;
    qdot_explained *out;
} place;

/* --- the word at a byte ------------------------------------------------------------------ */

/* Whether the token is a name or sign that holds the byte, or a name that ends there. */
static bool
holds_byte(const qdot_token *t, size_t at)
{
    if (t->kind != QDOT_TOKEN_NAME && t->kind != QDOT_TOKEN_OPERATOR)
        return false;
    return t->start <= at && (at < t->start + t->length || (t->kind == QDOT_TOKEN_NAME && at == t->start + t->length));
}

/* Find the token at the byte; false: there is none that can be explained. */
static bool
find_word(const qdot_token *tokens, size_t n, size_t at, place *p)
{
    int depth = 0;

    p->first = tokens;
    for (size_t i = 0; i < n; i++) {
        const qdot_token *t = tokens + i;

        if (holds_byte(t, at) && (t->kind == QDOT_TOKEN_NAME || i + 1 == n || !holds_byte(t + 1, at))) {
            p->word = t;
            p->in_brackets = depth > 0;
            return true;
        }
        if (t->kind == QDOT_TOKEN_END || qdot_token_is(t, "{")) {
            p->first = t + 1;
            depth = 0;
        } else {
            depth += qdot_token_bracket(t);
        }
    }
    return false;
}

/* The word with its index takes the place of the word. */
static void
take_index(place *p, const qdot_token *end)
{
    for (const qdot_token *t = p->word + 1; t < end; t++)
        qdot_text_format(&p->out->word, "%s%s", t->text, qdot_token_is(t, ",") ? " " : "");
    p->out->to = end[-1].start + end[-1].length;
}

/* --- words of the language ------------------------------------------------------------- */

static void
add_help(qdot_explained *x, qdot_explained_kind kind, const char *usage, const char *sentence, const char *example)
{
    x->kind = kind;
    qdot_text_add(&x->usage, usage);
    qdot_text_add(&x->sentence, sentence);
    if (example != NULL)
        qdot_text_add(&x->example, example);
}

static const qdot_topic *
find_topic(const char *word)
{
    const qdot_topic *topic;

    for (size_t i = 0; (topic = qdot_topic_at(i)) != NULL; i++)
        if (strcmp(topic->word, word) == 0)
            return topic;
    return NULL;
}

/* Explain the word of a statement, or of an option: by what help has of it, else by its statement. */
static void
explain_statement_word(place *p)
{
    const char *word = p->word->text;
    const qdot_statement *row = qdot_statement_find(p->first->text);
    const qdot_topic *topic = find_topic(word);

    if (p->word == p->first && row != NULL)
        add_help(p->out, QDOT_EXPLAINED_STATEMENT, row->usage, row->summary, row->example);
    else if (topic != NULL)
        add_help(p->out, QDOT_EXPLAINED_OPTION, topic->usage, topic->summary, topic->example);
    else if (row != NULL)
        add_help(p->out, QDOT_EXPLAINED_OPTION, row->usage, row->summary, row->example);
}

/* Explain a word of the language that is no word of this statement; false: it is none. */
static bool
explain_language(const char *word, qdot_explained *x)
{
    const qdot_quantity *quantity = qdot_quantity_find(word);
    const qdot_builtin *builtin = qdot_builtin_find(word);
    const qdot_topic *topic = find_topic(word);
    const qdot_ode_method *method = qdot_ode_method_find(word);
    const qdot_statement *row = qdot_statement_find(word);

    if (quantity != NULL)
        add_help(x, QDOT_EXPLAINED_QUANTITY, quantity->usage, quantity->summary, quantity->example);
    else if (builtin != NULL)
        add_help(x, QDOT_EXPLAINED_FUNCTION, builtin->usage, builtin->summary, builtin->example);
    else if (topic != NULL)
        add_help(x, QDOT_EXPLAINED_TOPIC, topic->usage, topic->summary, topic->example);
    else if (method != NULL)
        add_help(x, QDOT_EXPLAINED_TOPIC, word, method->fits, NULL);
    else if (row != NULL)
        add_help(x, QDOT_EXPLAINED_STATEMENT, row->usage, row->summary, row->example);
    return x->kind != QDOT_EXPLAINED_NOTHING;
}

/* --- names of the session ---------------------------------------------------------------- */

/* What a name of this kind is, in words. */
static const char *
name_kind_in_words(const qdot_session *session, const qdot_name *name)
{
    switch (name->kind) {
    case QDOT_NAME_PARAM: return "a parameter";
    case QDOT_NAME_COORD:
        return qdot_scene_state_of(session->scene, name->value) != NULL ? "a first-order state" : "a coordinate";
    case QDOT_NAME_UFUN: return "an undefined function";
    case QDOT_NAME_SPEED: return "a speed";
    case QDOT_NAME_FUNCTION: return "a function of yours";
    case QDOT_NAME_INDEX: return "an index";
    default: return "a name of yours";
    }
}

static qdot_status
explain_name(place *p, const qdot_name *name)
{
    qdot_explained *x = p->out;

    x->kind = QDOT_EXPLAINED_NAME;
    x->file = name->file;
    x->line = name->line;
    x->column = name->column;
    if (name->kind == QDOT_NAME_VALUE)
        x->value = name->value;
    else if (name->kind == QDOT_NAME_SPEED)
        x->value = qdot_expr_arg(p->session->pool, name->formals, 0);
    qdot_text_add(&x->sentence, name_kind_in_words(p->session, name));
    if (name->kind != QDOT_NAME_FUNCTION && qdot_units_on(p->session)) {
        qdot_units_words(p->session, name->value, &x->dimension);
        qdot_units_in_brackets(p->session, name->value, &x->dimension);
    }
    return qdot_declared_print(p->session, name, &x->usage);
}

/* Explain a name that is declared, with its index if that is; *found: whether it is. */
static qdot_status
explain_declared(place *p, bool *found)
{
    const char *word = p->word->text;
    const qdot_token *end = qdot_token_behind_index(p->word);
    const qdot_name *name = NULL;

    if (end > p->word + 1) {
        qdot_text whole = {0};

        for (const qdot_token *t = p->word; t < end; t++)
            qdot_text_add(&whole, t->text);
        name = whole.failed ? NULL : qdot_names_find(p->session->names, qdot_text_str(&whole));
        p->out->word.failed |= whole.failed;
        qdot_text_clear(&whole);
        if (name != NULL)
            take_index(p, end);
    }
    if (name == NULL)
        name = qdot_names_find(p->session->names, word);
    if (name == NULL)
        name = qdot_names_first_member(p->session->names, word);
    *found = true;
    if (name != NULL)
        return explain_name(p, name);
    if (qdot_scene_has_label(p->session->scene, word)) {
        p->out->kind = QDOT_EXPLAINED_LABEL;
        return qdot_declared_label(p->session, word, &p->out->usage);
    }
    if (qdot_declared_run(p->session, word, &p->out->usage)) {
        p->out->kind = QDOT_EXPLAINED_RUN;
        qdot_text_add(&p->out->sentence, "a run");
        return QDOT_OK;
    }
    *found = false;
    return QDOT_OK;
}

/* --- formulas ------------------------------------------------------------------------------ */

/* Whether the formula of the quantity follows by differentiation alone, in a scene of a size such that it comes at once. */
static bool
is_derived_at_once(const qdot_session *session, const char *word)
{
    static const char *const words[] = {"T", "kinetic", "V", "potential_energy", "L", "lagrange_function", "ds2", "speed2",
                                        "momentum", "angular_momentum", "p", "momenta", "Q", "eom", "mass_matrix"};

    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(words[i], word) == 0)
            return session->scene->coordinates.n <= QDOT_EXPLAINED_COORDINATES;
    return false;
}

/* Evaluate the word of the explanation; nil, without a failure, if it has no value, as in an empty scene. */
static qdot_status
find_value(qdot_session *session, qdot_explained *x)
{
    const char *word = qdot_text_str(&x->word);
    qdot_cursor c = {.session = session};
    qdot_source *source;
    qdot_status status = qdot_source_new("explain", word, strlen(word), &source, &c.error_at);
    qdot_expr value = QDOT_NIL;

    if (status == QDOT_OK) {
        c.source = source;
        c.at = source->tokens.at;
        status = qdot_read_value(&c, &value);
    }
    if (status == QDOT_OK)
        status = qdot_pool_check(session->pool);
    else if (qdot_pool_failed(session->pool))
        (void)!qdot_pool_check(session->pool);
    if (status == QDOT_OK)
        x->value = value;
    qdot_source_free(source);
    return qdot_grave(status);
}

/* Add the formula of a quantity, with the index that follows it; then that of whatever has a value. */
static qdot_status
add_formula(place *p)
{
    qdot_explained *x = p->out;

    if (x->kind == QDOT_EXPLAINED_QUANTITY && is_derived_at_once(p->session, p->word->text)) {
        take_index(p, qdot_token_behind_index(p->word));
        QDOT_TRY(qdot_text_status(&x->word));
        QDOT_TRY(find_value(p->session, x));
    }
    if (x->value == QDOT_NIL)
        return QDOT_OK;
    if (qdot_units_on(p->session) && x->dimension.n == 0) {
        qdot_units_words(p->session, x->value, &x->dimension);
        qdot_units_in_brackets(p->session, x->value, &x->dimension);
    }
    return qdot_grave(qdot_expression_print(p->session, x->value, p->style, &x->formula));
}

/* --- explaining ---------------------------------------------------------------------------- */

static qdot_status
explain_word(place *p)
{
    bool declared = false, word = false;

    qdot_text_add(&p->out->word, p->word->text);
    p->out->from = p->word->start;
    p->out->to = p->word->start + p->word->length;
    if (p->word->kind == QDOT_TOKEN_NAME)
        QDOT_TRY(qdot_highlight_is_word(p->session, p->source, p->first, p->word, p->in_brackets, &word));
    if (word && (p->word != p->first || qdot_quantity_find(p->word->text) == NULL)) { /* `forces` is explained as a value */
        explain_statement_word(p);
        return QDOT_OK;
    }
    if (p->word->kind == QDOT_TOKEN_NAME)
        QDOT_TRY(explain_declared(p, &declared));
    if (!declared && !explain_language(p->word->text, p->out))
        return QDOT_OK;
    return add_formula(p);
}

qdot_status
qdot_explain(qdot_session *session, const char *text, size_t length, size_t cursor, qdot_style style,
             qdot_explained *out)
{
    place p = {.session = session, .style = style, .out = out};
    size_t from = 0;

    out->value = QDOT_NIL;
    while (from <= cursor && from < length) {
        qdot_source *source;
        size_t at = 0;
        qdot_status status = qdot_source_new("explain", text + from, length - from, &source, &at);
        bool found, failed = status != QDOT_OK;

        if (source == NULL)
            return status;
        /* the lexer ends a list of tokens with END, except one on which it failed */
        status = failed ? qdot_vec_push(&source->tokens, ((qdot_token){.text = "", .start = (uint32_t)at})) : QDOT_OK;
        found = status == QDOT_OK && find_word(source->tokens.at, source->tokens.n, cursor - from, &p);
        p.source = source;
        if (found)
            status = explain_word(&p);
        qdot_source_free(source);
        QDOT_TRY(status);
        if (found) {
            out->from += from;
            out->to += from;
        }
        if (found || !failed || from + at >= length)
            break;
        from += at + 1;
    }
    if (out->word.failed || out->usage.failed || out->sentence.failed || out->example.failed || out->formula.failed ||
        out->dimension.failed)
        return qdot_fail(QDOT_ENOMEM, "out of memory");
    return QDOT_OK;
}

void
qdot_explained_clear(qdot_explained *x)
{
    qdot_text_clear(&x->word);
    qdot_text_clear(&x->usage);
    qdot_text_clear(&x->sentence);
    qdot_text_clear(&x->example);
    qdot_text_clear(&x->formula);
    qdot_text_clear(&x->dimension);
    *x = (qdot_explained){0};
}

/* --- as text and as JSON --------------------------------------------------------------------- */

const char *
qdot_explained_kind_word(qdot_explained_kind kind)
{
    static const char *const words[] = {
        [QDOT_EXPLAINED_NOTHING] = "",          [QDOT_EXPLAINED_STATEMENT] = "statement",
        [QDOT_EXPLAINED_OPTION] = "option",     [QDOT_EXPLAINED_QUANTITY] = "quantity",
        [QDOT_EXPLAINED_FUNCTION] = "function", [QDOT_EXPLAINED_NAME] = "name",
        [QDOT_EXPLAINED_LABEL] = "label",       [QDOT_EXPLAINED_RUN] = "run",
        [QDOT_EXPLAINED_TOPIC] = "topic"};

    return words[kind];
}

void
qdot_explained_print(const qdot_explained *x, qdot_text *out)
{
    if (x->kind == QDOT_EXPLAINED_NOTHING)
        return;
    qdot_text_format(out, "%s\n", qdot_text_str(&x->usage));
    if (x->sentence.n > 0)
        qdot_text_format(out, "    %s\n", qdot_text_str(&x->sentence));
    if (x->example.n > 0 && strcmp(x->example.at, qdot_text_str(&x->usage)) != 0)
        qdot_text_format(out, "    example: %s\n", x->example.at);
    if (x->formula.n > 0)
        qdot_text_format(out, "    %s: %s\n", qdot_text_str(&x->word), x->formula.at);
    if (x->dimension.n > 0)
        qdot_text_format(out, "    %s\n", x->dimension.at);
    if (x->file != NULL)
        qdot_text_format(out, "    declared at %s:%" PRIu32 ":%" PRIu32 "\n", x->file, x->line, x->column);
}

static void
add_field(qdot_text *out, const char *before, const qdot_text *text)
{
    if (text->n > 0)
        qdot_write_field(out, before, text->at);
}

void
qdot_explained_json(const qdot_explained *x, qdot_text *out)
{
    qdot_write_field(out, "{\"word\":", qdot_text_str(&x->word));
    qdot_text_format(out, ",\"from\":%zu,\"to\":%zu,\"kind\":\"%s\"", x->from, x->to, qdot_explained_kind_word(x->kind));
    add_field(out, ",\"usage\":", &x->usage);
    add_field(out, ",\"text\":", &x->sentence);
    add_field(out, ",\"formula\":", &x->formula);
    add_field(out, ",\"dimension\":", &x->dimension);
    add_field(out, ",\"example\":", &x->example);
    if (x->file != NULL) {
        qdot_write_field(out, ",\"file\":", x->file);
        qdot_text_format(out, ",\"line\":%" PRIu32 ",\"column\":%" PRIu32, x->line, x->column);
    }
    qdot_text_char(out, '}');
}
