/* script.c -- a source carried out, statement by statement.
 *
 * Blocks nest on an explicit stack of frames, one for each `{ ... } for` that runs. While
 * a statement with a trailing `for` runs, that word is an end to it: its token is an END
 * for the while.
 */
#include "lang/ask/ask.h"
#include "lang/workbench/script.h"

#include <string.h>
#include <time.h>

#include "base/interrupt.h"
#include "base/memory-failure.h"
#include "base/progress.h"
#include "expr/print.h"
#include "lang/answer/answer.h"
#include "lang/answer/sheet.h"
#include "lang/commands/definition-check.h"
#include "lang/commands/loop-index.h"
#include "lang/commands/loop.h"
#include "lang/commands/statement-form.h"
#include "lang/declare/session-remarks.h"
#include "lang/files/redirect.h"
#include "lang/functions/quantity.h"
#include "lang/functions/short-names.h"
#include "lang/language/foreign.h"
#include "lang/session/evaluation.h"
#include "lang/session/held.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/session/typed.h"
#include "lang/session/undo.h"
#include "lang/source/source.h"
#include "lang/syntax/match.h"
#include "lang/workbench/statement-count.h"

enum { FEW = 5 }; /* number of tokens quoted from the start of a statement */

typedef struct {
    size_t body, close; /* indices of the first token in the block, and of its `}` */
    size_t resume;      /* the token after the block */
    qdot_loop loop;
} frame;

typedef struct {
    qdot_session *session;
    qdot_source *source;
    qdot_token *tokens;
    size_t n;
    uint32_t *match; /* for each `{` the index of its `}`; NULL: no blocks in the source */
    qdot_vec(frame) frames;
    qdot_vec(qdot_usage *) usages; /* compiled usages of the statements met so far */
    size_t error_at;
} engine;

/* --- carrying out a simple statement ------------------------------------------------ */

/* The statement whose word is spelled most similarly; NULL if none is near. */
static const qdot_statement *
nearest_statement(const qdot_session *session, const char *name)
{
    const char *words[128], *near;
    size_t n = 0;

    for (; n < 128 && qdot_statement_at(n) != NULL; n++)
        words[n] = qdot_statement_at(n)->word;
    near = qdot_names_nearest(session->names, name, n, words);
    return near != NULL ? qdot_statement_find(near) : NULL;
}

/* Report the unknown first word of `partcle bob mass m`: a word that another name follows. */
static qdot_status
unknown_word(qdot_cursor *c)
{
    const qdot_statement *near = nearest_statement(c->session, c->at->text);

    if (qdot_statement_find(c->at->text) != NULL) { /* a statement of one word */
        c->error_at = c->at[1].start;
        return qdot_fail(QDOT_ESYNTAX, "nothing follows `%s`, found `%s`", c->at->text,
                         c->at[1].text);
    }
    c->error_at = c->at->start;
    (void)qdot_fail(QDOT_ESYNTAX, "no statement begins with `%s`", c->at->text);
    if (qdot_token_is_word(c->at, "for"))
        return qdot_hint("it ends one: print k^2 for k = 1..3");
    return near != NULL
               ? qdot_hint("did you mean `%s`?", near->word)
               : qdot_hint("`help` lists the statements; a product is written with *");
}

static bool
is_unknown_word(const qdot_session *session, const qdot_token *name)
{
    return name->kind == QDOT_TOKEN_NAME && name[1].kind == QDOT_TOKEN_NAME &&
           !qdot_token_is_word(name + 1, "and") && !qdot_token_is_word(name + 1, "or") &&
           !qdot_token_is_word(name, "not") && !qdot_cursor_knows(session, name->text);
}

/* The compiled usage of the row; NULL if out of memory. */
static const qdot_usage *
find_usage(engine *x, const qdot_statement *row)
{
    qdot_usage *usage;

    for (size_t i = 0; i < x->usages.n; i++)
        if (strcmp(x->usages.at[i]->word, row->word) == 0)
            return x->usages.at[i];
    usage = qdot_malloc(sizeof *usage);
    if (usage == NULL || !qdot_usage_compile(usage, row->word, row->usage, NULL) ||
        qdot_vec_push(&x->usages, usage) != QDOT_OK) {
        qdot_free(usage);
        return NULL;
    }
    return usage;
}

/* Carry out the statement at the cursor, read by its usage. */
static qdot_status
carry_out_record(engine *x, qdot_cursor *c, const qdot_statement *row)
{
    const qdot_usage *usage = find_usage(x, row);
    qdot_record record;
    qdot_status status;

    if (usage == NULL)
        return QDOT_ENOMEM;
    status = qdot_match(c, row, usage, &record);
    if (status == QDOT_OK)
        status = row->handler(&record);
    c->at = record.cursor.at;
    c->error_at = record.cursor.error_at;
    qdot_record_free(&record);
    return status;
}

static qdot_status
carry_out_row(engine *x, qdot_cursor *c, const qdot_statement *row)
{
    qdot_status status;

    c->session->evaluation->declares = qdot_statement_declares(row);
    qdot_short_names_forget(c->session);
    status = carry_out_record(x, c, row);
    if (c->session->evaluation->declares)
        status = qdot_short_names_tell(c->session, status);
    c->session->evaluation->declares = false;
    return status;
}

static qdot_status
dispatch(engine *x, qdot_cursor *c)
{
    const qdot_form form = qdot_statement_form(c->session, c->at);

    if (form == QDOT_FORM_DEFINITION) {
        QDOT_TRY(qdot_declare_definition(c));
    } else if (form == QDOT_FORM_WORD) {
        const qdot_statement *row = qdot_statement_find(c->at->text);

        if (!qdot_statement_is_built(row)) {
            c->error_at = c->at->start;
            return qdot_fail(QDOT_ENOTBUILT, "not built yet: %s", row->word);
        }
        QDOT_TRY(carry_out_row(x, c, row));
    } else if (is_unknown_word(c->session, c->at)) {
        return unknown_word(c);
    } else if (form == QDOT_FORM_COMPARISON) {
        QDOT_TRY(qdot_check(c));
    } else {
        QDOT_TRY(qdot_ask_expression(c));
    }
    QDOT_TRY(qdot_pool_check(c->session->pool));
    return qdot_cursor_expect_end(c);
}

/* Whether the statement asks of the scene: then parameters that a loop holds are put into it. Runs
 * have them as values of their own. */
static bool
asks(const qdot_session *session, const qdot_token *first)
{
    const qdot_statement *row;

    if (qdot_statement_form(session, first) != QDOT_FORM_WORD)
        return true;
    row = qdot_statement_find(first->text);
    return qdot_statement_asks(row) || strcmp(row->word, "print") == 0 ||
           strcmp(row->word, "export") == 0;
}

/* Carry out one iteration of a loop, with the parameters and coordinates that it sets. */
static qdot_status
dispatch_held(engine *x, qdot_cursor *c)
{
    qdot_session *session = c->session;
    qdot_scene_saved kept = {0};
    qdot_status status = QDOT_OK;

    if (session->evaluation->held.n == 0 || !asks(session, c->at))
        return dispatch(x, c);
    status = qdot_held_check(session);
    if (status == QDOT_OK)
        status = qdot_held_scene_begin(session, &kept);
    if (status == QDOT_OK)
        status = dispatch(x, c);
    qdot_held_scene_end(session, &kept);
    return status;
}

/* Find the `to FILE` that ends the statement; none if the statement parses `to` itself. */
static const qdot_token *
find_to(const qdot_session *session, const qdot_token *first)
{
    const qdot_form form = qdot_statement_form(session, first);
    const qdot_statement *row =
        first->kind == QDOT_TOKEN_NAME ? qdot_statement_find(first->text) : NULL;

    if (form == QDOT_FORM_DEFINITION)
        return NULL;
    if (form != QDOT_FORM_WORD && !qdot_token_is_word(first + 1, "to"))
        row = NULL;
    return qdot_redirect_find(row, first);
}

/* Carry out a statement that ends before `to`, with its answers going to the file. */
static qdot_status
dispatch_to(engine *x, qdot_cursor *c, size_t to)
{
    qdot_redirect redirect;
    qdot_status status;

    c->error_at = x->tokens[to + 1].start;
    QDOT_TRY(qdot_redirect_begin(&redirect, x->session, x->tokens[to + 1].text));
    x->tokens[to].kind = QDOT_TOKEN_END;
    status = dispatch_held(x, c);
    x->tokens[to].kind = QDOT_TOKEN_NAME;
    if (status == QDOT_OK)
        c->error_at = x->tokens[to + 1].start;
    return qdot_redirect_end(&redirect, status);
}

/* One notice for all forms of the answer that the work budget left unfinished. Where none is
 * shown, as by `check` or `run`, it does not matter. */
static qdot_status
tell_unfinished(qdot_session *session, const qdot_token *first)
{
    const qdot_statement *row =
        first->kind == QDOT_TOKEN_NAME ? qdot_statement_find(first->text) : NULL;

    if (!qdot_pool_unfinished_taken(session->pool) ||
        (row != NULL && !row->alone && strcmp(row->word, "print") != 0))
        return QDOT_OK;
    return qdot_answer_notice(session, "simplification stopped at its budget of work: there "
                                       "may be a shorter form");
}

static qdot_status
statement(engine *x, size_t i)
{
    qdot_cursor c = {.session = x->session,
                     .source = x->source,
                     .at = &x->tokens[i],
                     .error_at = x->tokens[i].start};
    qdot_status status = qdot_interrupt_check();
    const qdot_token *to = status == QDOT_OK ? find_to(x->session, &x->tokens[i]) : NULL;

    (void)qdot_pool_unfinished_taken(x->session->pool); /* notes of a statement that failed are dropped */
    if (status == QDOT_OK)
        status = to == NULL ? dispatch_held(x, &c) : dispatch_to(x, &c, (size_t)(to - x->tokens));
    qdot_progress_clear();
    if (status == QDOT_OK)
        status = qdot_sheet_flush(x->session);
    else
        qdot_sheet_forget(x->session);
    /* memory ran out in a part whose failure was not passed on: the answer may be incomplete */
    if (qdot_memory_ran_out() && status == QDOT_OK)
        status = qdot_fail(QDOT_ENOMEM, "out of memory: the answers may be incomplete");
    if (status == QDOT_OK)
        return tell_unfinished(x->session, &x->tokens[i]);
    x->error_at = c.error_at;
    if (qdot_pool_failed(
            x->session->pool)) { /* report this failure as that of the statement */
        qdot_error error = *qdot_last_error();

        (void)!qdot_pool_check(x->session->pool);
        (void)qdot_fail_again(&error);
    }
    return status;
}

/* --- repetition by a trailing `for` ------------------------------------------------- */

/* Whether the statement `plot` draws a curve for each value of the index: it is a parameter or
 * coordinate, of which the run is made once more. */
static bool
is_of_plot(const engine *x, size_t i, const qdot_token *index)
{
    const qdot_name *known = qdot_names_find(x->session->names, index->text);

    return qdot_token_is_word(&x->tokens[i], "plot") && known != NULL &&
           (known->kind == QDOT_NAME_PARAM || known->kind == QDOT_NAME_COORD);
}

/* The top-level `for NAME =` of the statement at i, or its END. plot keeps the one
 * that goes with `vs NAME =`, or with a declared NAME. */
static size_t
statement_end(const engine *x, size_t i)
{
    bool own = false;
    long depth = 0;

    for (size_t k = i;; k++) {
        const qdot_token *token = &x->tokens[k];

        if (token->kind == QDOT_TOKEN_END)
            return k;
        depth += qdot_token_bracket(token);
        if (depth != 0 || k == i)
            continue;
        if (qdot_token_is_word(token, "vs") && token[1].kind == QDOT_TOKEN_NAME &&
            qdot_token_is(token + 2, "=") && qdot_token_is_word(&x->tokens[i], "plot"))
            own = true;
        if (!own && qdot_token_is_word(token, "for") && token[1].kind == QDOT_TOKEN_NAME &&
            !is_of_plot(x, i, &token[1]) &&
            (qdot_token_is(token + 2, "=") || token[2].kind == QDOT_TOKEN_NAME ||
             token[2].kind == QDOT_TOKEN_END))
            return k;
    }
}

/* The index of the first END token at or after i. */
static size_t
find_end(const engine *x, size_t i)
{
    while (x->tokens[i].kind != QDOT_TOKEN_END)
        i++;
    return i;
}

/* Add to the error in which iteration it occurred, unless there is another hint. */
static void
tell_pass(const engine *x, const qdot_loop *loop)
{
    qdot_text text = {0};

    if (qdot_last_error()->hint[0] != '\0' || qdot_last_error()->status == QDOT_EINTR)
        return;
    for (size_t i = 0; i < loop->indices.n; i++) {
        const qdot_loop_index *index = &loop->indices.at[i];

        qdot_text_format(&text, "%s%s = ", i > 0 ? ", " : "", index->name);
        if (!index->listed)
            qdot_text_format(&text, "%ld", index->at);
        else if (qdot_print(x->session->pool, index->values.at[index->next], QDOT_PLAIN,
                            &text) != QDOT_OK)
            break;
    }
    if (text.n > 0 && text.n < 100)
        (void)qdot_hint("in the pass with %s", qdot_text_str(&text));
    qdot_text_clear(&text);
}

static qdot_status
repeat(engine *x, size_t i, size_t word)
{
    qdot_cursor c = {
        .session = x->session, .source = x->source, .at = &x->tokens[word + 1]};
    qdot_loop loop;
    qdot_status status;
    bool more;

    status = qdot_loop_index_check(&c, &x->tokens[i], &x->tokens[word], NULL, false);
    if (status != QDOT_OK) {
        x->error_at = c.error_at;
        return status;
    }
    status = qdot_loop_begin(&loop, &c, NULL, &more);
    while (status == QDOT_OK && more) {
        x->tokens[word].kind = QDOT_TOKEN_END;
        status = statement(x, i);
        x->tokens[word].kind = QDOT_TOKEN_NAME;
        if (status != QDOT_OK) {
            tell_pass(x, &loop);
            qdot_loop_end(&loop);
            return status;
        }
        status = qdot_loop_next(&loop, &more);
    }
    if (status != QDOT_OK)
        x->error_at = loop.error_at;
    qdot_loop_end(&loop);
    return status;
}

static void
tell_time(const engine *x, clock_t since)
{
    qdot_text text = {0};
    double s = (double)(clock() - since) / CLOCKS_PER_SEC;

    qdot_text_add(&text, "cpu ");
    qdot_text_double(&text, s * 1e3, 3);
    qdot_text_format(&text, " ms; %zu nodes in ", qdot_pool_count(x->session->pool));
    qdot_text_double(&text, (double)qdot_pool_bytes(x->session->pool) / 1e6, 3);
    qdot_text_add(&text, " MB");
    (void)!qdot_answer_text(x->session, "timing", qdot_text_str(&text));
    qdot_text_clear(&text);
}

/* Whether there is no hint, or one that declares the name; a mistyped statement word is likelier. */
static bool
is_bare_or_declares(const char *hint)
{
    return hint[0] == '\0' || hint[0] == '`' || strncmp(hint, "define it", 9) == 0;
}

/* The row of the statement [i, end), if it fails in its first tokens and nothing says how it goes on:
 * then its example helps. */
static const qdot_statement *
row_with_example(const engine *x, size_t i, size_t end)
{
    const qdot_token *first = &x->tokens[i];
    const qdot_error *error = qdot_last_error();
    const qdot_statement *row =
        first->kind == QDOT_TOKEN_NAME ? qdot_statement_find(first->text) : NULL;
    const size_t few = end - i > FEW ? FEW : end - i;
    const qdot_token *last = &x->tokens[end - 1];
    const bool broken_off = x->error_at >= last->start + last->length;

    if (row == NULL || row->alone || error->status != QDOT_ESYNTAX || error->hint[0] != '\0' ||
        strncmp(error->message, "expected ", 9) != 0 || strchr(error->message, '"') != NULL ||
        strstr(error->message, "or the end of the statement") != NULL ||
        (broken_off ? end - i > FEW : x->error_at > first[few - 1].start) ||
        qdot_statement_is_name(x->session, first, row))
        return NULL;
    return broken_off || strncmp(error->message, "expected an expression", 22) != 0 ? row : NULL;
}

/* Add a hint after statement [i, end) failed, if the statement has the form of a known mistake. */
static qdot_status
hint_known_mistake(engine *x, size_t i, size_t end, qdot_status status)
{
    qdot_cursor c = {.session = x->session, .source = x->source, .error_at = x->error_at};
    const qdot_statement *example;

    if (x->error_at == QDOT_SCRIPT_REPORTED || x->session->evaluation->placed)
        return status;
    if (status == QDOT_ENAME && x->error_at == x->tokens[i].start &&
        is_bare_or_declares(qdot_last_error()->hint)) { /* a misspelt statement, as `runn 0..10` */
        const qdot_statement *near = nearest_statement(x->session, x->tokens[i].text);

        if (near != NULL && strcmp(near->word, x->tokens[i].text) == 0)
            (void)qdot_hint("as in %s", near->example);
        else if (near != NULL)
            (void)qdot_hint("did you mean `%s`?", near->word);
    }
    (void)qdot_foreign_hint(&c, x->tokens + i, x->tokens + end);
    x->error_at = c.error_at;
    example = row_with_example(x, i, end);
    if (example != NULL)
        (void)qdot_hint("as in %s", example->example);
    return status;
}

/* Give a notice if the form of statement [i, end), just carried out, is rarely what users mean. */
static qdot_status
tell_seldom_meant(engine *x, size_t i, size_t end)
{
    const qdot_cursor c = {.session = x->session, .source = x->source};
    qdot_text text = {0};
    const char *notice = qdot_foreign_notice(&c, x->tokens + i, x->tokens + end, &text);
    qdot_status status =
        notice != NULL ? qdot_answer_notice(x->session, "%s", notice) : QDOT_OK;

    qdot_text_clear(&text);
    return status;
}

/* Carry out the simple statement at i, for all values of its `for`; *next: the token after it. */
static qdot_status
carry_out_simple(engine *x, size_t i, size_t *next)
{
    size_t end = statement_end(x, i);
    clock_t since = clock();
    bool timed = x->session->output->timing && x->frames.n == 0;
    qdot_cursor c = {.session = x->session, .source = x->source, .at = &x->tokens[i]};
    qdot_status status;

    *next = find_end(x, end);
    x->session->evaluation->placed = false;
    qdot_text_list_clear(&x->session->evaluation->told);
    status = qdot_definition_check(&c, &x->tokens[*next]);
    if (status != QDOT_OK) {
        x->error_at = c.error_at;
        return status;
    }
    status = x->tokens[end].kind == QDOT_TOKEN_END ? statement(x, i) : repeat(x, i, end);
    if (status != QDOT_OK)
        return hint_known_mistake(x, i, *next, status);
    QDOT_TRY(tell_seldom_meant(x, i, *next));
    if (timed && x->session->output->timing)
        tell_time(x, since);
    return QDOT_OK;
}

/* --- blocks in braces --------------------------------------------------------------- */

/* Find the `}` that belongs to every `{`. */
static qdot_status
match_blocks(engine *x)
{
    qdot_vec(uint32_t) open = {0};
    qdot_status status = QDOT_OK;

    for (size_t i = 0; i < x->n && status == QDOT_OK; i++) {
        if (qdot_token_is(&x->tokens[i], "{")) {
            if (x->match == NULL)
                x->match = qdot_calloc(x->n, sizeof *x->match);
            status = x->match != NULL ? qdot_vec_push(&open, (uint32_t)i) : QDOT_ENOMEM;
        } else if (qdot_token_is(&x->tokens[i], "}") && open.n > 0) {
            x->match[open.at[--open.n]] = (uint32_t)i;
        }
    }
    qdot_free(open.at);
    return status;
}

/* Enter the block that opens at i, or step over it if its loop has no values. */
static qdot_status
enter_block(engine *x, size_t i, size_t *next)
{
    frame f = {.body = i + 1, .close = x->match[i]};
    qdot_cursor c = {
        .session = x->session, .source = x->source, .at = &x->tokens[f.close + 1]};
    qdot_status status;
    bool more;

    x->error_at = c.at->start;
    QDOT_TRY(qdot_interrupt_check());
    if (!qdot_cursor_accept_word(&c, "for")) {
        const qdot_token *first = &x->tokens[f.body];

        (void)qdot_cursor_expected(&c, "`for` after the block");
        if (first->kind != QDOT_TOKEN_NAME || qdot_statement_find(first->text) == NULL)
            return qdot_hint("a list is written [a, b], a vector (a, b)");
        return QDOT_ESYNTAX;
    }
    f.resume = find_end(x, f.close + 1);
    status = qdot_loop_index_check(&c, &x->tokens[f.body], &x->tokens[f.close], NULL, true);
    if (status != QDOT_OK) {
        x->error_at = c.error_at;
        return status;
    }
    status = qdot_loop_begin(&f.loop, &c, NULL, &more);
    if (status != QDOT_OK) {
        x->error_at = f.loop.error_at;
        return status;
    }
    *next = more ? f.body : f.resume;
    if (!more)
        return QDOT_OK;
    status = qdot_vec_push(&x->frames, f);
    if (status != QDOT_OK)
        qdot_loop_end(&f.loop);
    return status;
}

/* At the `}` of the innermost block: start its next iteration, or leave it. */
static qdot_status
round_again(engine *x, size_t *next)
{
    frame *top = &x->frames.at[x->frames.n - 1];
    bool more = false;
    qdot_status status = qdot_loop_next(&top->loop, &more);

    if (status != QDOT_OK)
        x->error_at = top->loop.error_at;
    *next = more ? top->body : top->resume;
    if (!more) {
        qdot_loop_end(&top->loop);
        x->frames.n--;
    }
    return status;
}

/* Carry out the statement or the beginning or end of a block at *i, and move *i past it. */
static qdot_status
advance(engine *x, size_t *i)
{
    if (x->frames.n > 0 && *i == x->frames.at[x->frames.n - 1].close)
        return round_again(x, i);
    if (qdot_token_is(&x->tokens[*i], "{"))
        return enter_block(x, *i, i);
    if (x->tokens[*i].kind != QDOT_TOKEN_END)
        return carry_out_simple(x, *i, i);
    ++*i;
    return QDOT_OK;
}

/* Carry out the statement or block at *i to its end. */
static qdot_status
carry_out_whole(engine *x, size_t *i)
{
    const qdot_token *first = &x->tokens[*i], *last;
    size_t begun = qdot_undo_begin(x->session);
    qdot_status status;

    qdot_typed_begin(x->session, x->source, first->start);
    do
        status = advance(x, i);
    while (status == QDOT_OK && x->frames.n > 0 && !x->session->outcome->quit);
    last = &x->tokens[x->frames.n > 0         ? x->frames.at[0].resume
                      : status == QDOT_OK     ? *i
                                              : find_end(x, (size_t)(first - x->tokens))];
    last -= last > first;
    qdot_undo_end(x->session, begun, x->source->text + first->start,
                  last->start + last->length - first->start);
    if (status == QDOT_OK) /* after a failure it ends after its error has been printed */
        qdot_typed_end(x->session, x->source->text + first->start, last->start + last->length - first->start, status);
    return status;
}

static qdot_status
carry_out(engine *x)
{
    size_t i = 0;

    while (i < x->n && !x->session->outcome->quit) {
        if (x->tokens[i].kind == QDOT_TOKEN_END)
            i++;
        else
            QDOT_TRY(carry_out_whole(x, &i));
    }
    return QDOT_OK;
}

/* Report the error of a statement, or of a text that could not be split into statements. */
static void
report_error(engine *x)
{
    qdot_typed_begin(x->session, x->source, x->error_at);
    qdot_answer_error(x->session, x->source, x->error_at);
}

/* --- a whole script ----------------------------------------------------------------- */

qdot_status
qdot_script_carry_out(qdot_session *session, const char *name, uint32_t before, const char *text, size_t length)
{
    engine x = {.session = session};
    qdot_status status = qdot_source_new(name, text, length, &x.source, &x.error_at);
    size_t outer = qdot_undo_text_begin(session);

    if (x.source != NULL)
        x.source->lines_before = before;
    session->typed->texts++;
    (void)qdot_memory_ran_out(); /* clears the flag of earlier failures, which were reported */
    if (status == QDOT_OK)
        status = qdot_session_remarks_keep(session, text, length);
    if (status == QDOT_OK) {
        x.tokens = x.source->tokens.at;
        x.n = x.source->tokens.n;
        status = match_blocks(&x);
    }
    if (status == QDOT_OK)
        status = carry_out(&x);
    qdot_undo_text_end(session, outer);
    while (x.frames.n > 0) {
        if (status != QDOT_OK)
            tell_pass(&x, &x.frames.at[x.frames.n - 1].loop);
        qdot_loop_end(&x.frames.at[--x.frames.n].loop);
    }
    if (status != QDOT_OK && x.error_at != QDOT_SCRIPT_REPORTED)
        report_error(&x);
    if (status != QDOT_OK)
        qdot_typed_end(session, "", 0, status);
    session->typed->texts--;
    if (status == QDOT_EINTR)
        qdot_interrupt_clear();
    for (size_t i = 0; i < x.usages.n; i++)
        qdot_free(x.usages.at[i]);
    qdot_free(x.usages.at);
    qdot_free(x.frames.at);
    qdot_free(x.match);
    qdot_source_free(x.source);
    return status;
}
