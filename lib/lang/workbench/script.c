/* script.c -- a source carried out, statement by statement.
 *
 * Blocks nest on an explicit stack of frames, one for each `{ ... } for` that runs. While
 * a statement with a trailing `for` runs, that word is an end to it: its token is an END
 * for the while.
 */
#include "lang/ask/ask.h"
#include "lang/workbench/script.h"

#include <inttypes.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/memory-failure.h"
#include "base/progress.h"
#include "expr/print.h"
#include "lang/answer/answer.h"
#include "lang/answer/sheet.h"
#include "lang/commands/definition-check.h"
#include "lang/commands/loop-index.h"
#include "lang/commands/loop.h"
#include "lang/declare/declare.h"
#include "lang/declare/session-remarks.h"
#include "lang/files/redirect.h"
#include "lang/functions/quantity.h"
#include "lang/functions/short-names.h"
#include "lang/language/foreign.h"
#include "lang/session/unmade.h"
#include "lang/session/evaluation.h"
#include "lang/session/held.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/session/typed.h"
#include "lang/session/units.h"
#include "lang/session/undo.h"
#include "lang/source/source.h"
#include "lang/syntax/form.h"
#include "lang/syntax/loop-clause.h"
#include "lang/syntax/match.h"
#include "lang/syntax/outline.h"
#include "lang/workbench/hint-check.h"
#include "lang/workbench/statement-count.h"
#include "lang/workbench/timing.h"

typedef struct {
    size_t body, close; /* indices of the first token in the block, and of its `}` */
    size_t resume;      /* the token after the block */
    qdot_record *clause; /* the parsed `for` clause of the block's loop; owned */
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
    bool naming; /* only the names of the statement are declared, before its loop */
    const qdot_look *look; /* statements are parsed only, and their expressions handed over; NULL: carried out */
    size_t error_at;
} engine;

/* --- carrying out a simple statement ------------------------------------------------ */

/* The statement whose word is most similar to the name; NULL if none is similar. */
static const qdot_statement *
find_nearest_statement(const qdot_session *session, const char *name)
{
    const char *words[128], *near;
    size_t n = 0;

    for (; n < 128 && qdot_statement_at(n) != NULL; n++)
        words[n] = qdot_statement_at(n)->word;
    near = qdot_names_nearest(session->names, name, n, words);
    return near != NULL ? qdot_statement_find(near) : NULL;
}

/* Report the unknown first word of a statement such as `partcle bob mass m`: a word followed by another name. */
static qdot_status
report_unknown_word(qdot_cursor *c)
{
    const char *word = c->at->text;
    const qdot_statement *near = find_nearest_statement(c->session, word);

    if (qdot_statement_find(word) != NULL) { /* the word is a known statement of one word */
        c->error_at = c->at[1].start;
        return qdot_fail(QDOT_ESYNTAX, "nothing follows `%s`, found `%s`", word, c->at[1].text);
    }
    c->error_at = c->at->start;
    (void)qdot_fail(QDOT_ESYNTAX, "no statement begins with `%s`", word);
    if (strcmp(word, qdot_loop_clause.word) == 0)
        return qdot_hint("it ends one: print k^2 for k = 1..3");
    return near != NULL
               ? qdot_hint("did you mean `%s`?", near->word)
               : qdot_hint("`help` lists the statements; a product is written with *");
}

/* The compiled usage of a statement's table row; NULL if out of memory. */
static const qdot_usage *
find_usage(engine *x, const qdot_statement *row)
{
    const bool displayed = row->displayed != NULL && qdot_write_displays(x->session);
    qdot_usage *usage;

    for (size_t i = 0; i < x->usages.n; i++)
        if (strcmp(x->usages.at[i]->word, row->word) == 0)
            return x->usages.at[i];
    usage = qdot_malloc(sizeof *usage);
    if (usage == NULL || !qdot_usage_compile(usage, row->word, displayed ? row->displayed : row->usage) ||
        qdot_vec_push(&x->usages, usage) != QDOT_OK) {
        qdot_free(usage);
        return NULL;
    }
    return usage;
}

/* Carry out the statement at the cursor, which is read as its usage text says. */
static qdot_status
carry_out_record(engine *x, qdot_cursor *c, const qdot_statement *row)
{
    const qdot_usage *usage = find_usage(x, row);
    qdot_record record;
    qdot_status status;

    if (usage == NULL)
        return QDOT_ENOMEM;
    status = qdot_match(c, row, usage, &record);
    if (status == QDOT_OK && x->look != NULL) {
        status = qdot_look_at_record(x->look, &record);
    } else if (status == QDOT_OK) {
        if (!x->naming)
            status = qdot_session_refuse_unmade(record.cursor.session, row->word);
        if (status == QDOT_OK)
            status = x->naming ? row->names(&record) : qdot_match_handle(row, &record);
    }
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
dispatch_statement(engine *x, qdot_cursor *c)
{
    const qdot_form form = qdot_statement_form(c->session, c->at);

    if (x->look != NULL && form != QDOT_FORM_WORD && form != QDOT_FORM_UNKNOWN)
        return qdot_look_at_wordless(x->look, c, form);
    if (form == QDOT_FORM_DEFINITION) {
        QDOT_TRY(qdot_declare_definition(c));
    } else if (form == QDOT_FORM_WORD) {
        QDOT_TRY(carry_out_row(x, c, qdot_statement_find(c->at->text)));
    } else if (form == QDOT_FORM_UNKNOWN) {
        return report_unknown_word(c);
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
reads_scene(const qdot_session *session, const qdot_token *first)
{
    const qdot_statement *row;

    if (qdot_statement_form(session, first) != QDOT_FORM_WORD)
        return true;
    row = qdot_statement_find(first->text);
    return qdot_statement_asks(row) || strcmp(row->word, "print") == 0 ||
           strcmp(row->word, "export") == 0;
}

/* Carry out a statement in one pass of a loop, with the parameters and coordinates that the loop sets. */
static qdot_status
dispatch_in_loop(engine *x, qdot_cursor *c)
{
    qdot_session *session = c->session;
    qdot_scene_saved kept = {0};
    qdot_status status = QDOT_OK;

    if (session->evaluation->held.n == 0 || !reads_scene(session, c->at))
        return dispatch_statement(x, c);
    status = qdot_held_check(session);
    if (status == QDOT_OK)
        status = qdot_held_scene_begin(session, &kept);
    if (status == QDOT_OK)
        status = dispatch_statement(x, c);
    qdot_held_scene_end(session, &kept);
    return status;
}

/* Find the `to FILE` that ends the statement; NULL if there is none or if the statement parses `to` itself. */
static const qdot_token *
find_output_file(const qdot_session *session, const qdot_token *first)
{
    const qdot_token *to = qdot_outline_file(first);
    const qdot_form form = to != NULL ? qdot_statement_form(session, first) : QDOT_FORM_DEFINITION;
    const bool word = form == QDOT_FORM_WORD || to == first + 1;

    return form == QDOT_FORM_DEFINITION ? NULL
                                        : qdot_redirect_find(word ? qdot_statement_row(first) : NULL, first, to);
}

/* Carry out a statement that ends before token `to`, and write its answers to the file named after `to`. */
static qdot_status
dispatch_with_output_file(engine *x, qdot_cursor *c, size_t to)
{
    qdot_redirect redirect;
    qdot_token_kind kind;
    qdot_status status;

    c->error_at = x->tokens[to + 1].start;
    if (x->look != NULL) {
        kind = qdot_outline_cut(&x->tokens[to]);
        status = dispatch_statement(x, c);
        qdot_outline_join(&x->tokens[to], kind);
        return status;
    }
    QDOT_TRY(qdot_redirect_begin(&redirect, x->session, x->tokens[to + 1].text));
    kind = qdot_outline_cut(&x->tokens[to]);
    status = dispatch_in_loop(x, c);
    qdot_outline_join(&x->tokens[to], kind);
    if (status == QDOT_OK)
        c->error_at = x->tokens[to + 1].start;
    return qdot_redirect_end(&redirect, status);
}

/* One notice for all forms of the answer that the work budget left unfinished. Where none is
 * shown, as by `check` or `run`, it does not matter. */
static qdot_status
give_notice_of_unfinished(qdot_session *session, const qdot_token *first)
{
    const qdot_statement *row = qdot_statement_row(first);

    if (!qdot_pool_unfinished_taken(session->pool) ||
        (row != NULL && !row->alone && strcmp(row->word, "print") != 0))
        return QDOT_OK;
    return qdot_answer_notice(session, "simplification stopped at its budget of work: there "
                                       "may be a shorter form");
}

static qdot_status
carry_out_statement(engine *x, size_t i)
{
    qdot_cursor c = {.session = x->session,
                     .source = x->source,
                     .at = &x->tokens[i],
                     .error_at = x->tokens[i].start};
    qdot_status status = qdot_interrupt_check();
    const qdot_token *to = status == QDOT_OK ? find_output_file(x->session, &x->tokens[i]) : NULL;

    (void)qdot_pool_unfinished_taken(x->session->pool); /* drop what a failed statement has noted */
    if (status == QDOT_OK)
        status = to == NULL ? dispatch_in_loop(x, &c) : dispatch_with_output_file(x, &c, (size_t)(to - x->tokens));
    qdot_progress_clear();
    if (status == QDOT_OK)
        status = qdot_sheet_flush(x->session);
    else
        qdot_sheet_forget(x->session);
    /* memory ran out in a part whose failure was not passed on: the answer may be incomplete */
    if (qdot_memory_ran_out() && status == QDOT_OK)
        status = qdot_fail(QDOT_ENOMEM, "out of memory: the answers may be incomplete");
    if (status == QDOT_OK)
        return give_notice_of_unfinished(x->session, &x->tokens[i]);
    x->error_at = c.error_at;
    if (qdot_pool_failed(
            x->session->pool)) { /* report the pool's failure as that of the statement */
        qdot_error error = *qdot_last_error();

        (void)!qdot_pool_check(x->session->pool);
        (void)qdot_fail_again(&error);
    }
    return status;
}

/* --- repetition by a trailing `for` ------------------------------------------------- */

/* Add to an error in which pass of a loop it occurred, unless it has another hint. */
static void
add_loop_values_to_error(const engine *x, const qdot_loop *loop)
{
    qdot_text text = {0};

    if (qdot_last_error()->hint[0] != '\0' || qdot_last_error()->status == QDOT_EINTR)
        return;
    for (size_t i = 0; i < loop->indices.n; i++) {
        const qdot_loop_index *index = &loop->indices.at[i];

        qdot_text_format(&text, "%s%s = ", i > 0 ? ", " : "", index->name);
        if (!index->listed)
            qdot_text_format(&text, "%" PRId64, index->at);
        else if (qdot_print(x->session->pool, index->values.at[index->next], QDOT_PLAIN,
                            &text) != QDOT_OK)
            break;
    }
    if (text.n > 0 && text.n < 100)
        (void)qdot_hint("in the pass with %s", qdot_text_str(&text));
    qdot_text_clear(&text);
}

/* Read the clause behind the word `for` at the cursor into the record, and check that its indices occur in the tokens
 * [from, to) that it repeats. Free the record in any case. */
static qdot_status
read_clause(engine *x, const qdot_cursor *c, const qdot_token *from, const qdot_token *to, bool block, qdot_record *clause)
{
    const qdot_usage *usage = find_usage(x, &qdot_loop_clause);
    qdot_status status;

    *clause = (qdot_record){0};
    if (usage == NULL)
        return QDOT_ENOMEM;
    status = qdot_loop_clause_read(c, usage, clause);
    if (status == QDOT_OK)
        status = qdot_loop_index_check(clause, clause->parts.at + 1, clause->parts.at + clause->parts.n, from, to, block);
    x->error_at = clause->cursor.error_at;
    return status;
}

/* Begin the loop over the values of the `for` clause that has been read. */
static qdot_status
begin_loop(engine *x, qdot_loop *loop, qdot_record *clause, bool *more)
{
    const qdot_status status =
        qdot_loop_begin(loop, clause, clause->parts.at + 1, clause->parts.at + clause->parts.n, more);

    x->error_at = status != QDOT_OK ? clause->cursor.error_at : x->error_at;
    return status;
}

/* Go through the passes of the loop with the statement at i, which ends before its word `for`. */
static qdot_status
go_through_passes(engine *x, size_t i, const qdot_token *word, qdot_record *clause)
{
    qdot_loop loop = {0};
    bool more = x->look != NULL;
    qdot_status status = x->look == NULL ? begin_loop(x, &loop, clause, &more) : QDOT_OK;

    while (status == QDOT_OK && more) {
        const qdot_token_kind kind = qdot_outline_cut(word);

        status = carry_out_statement(x, i);
        qdot_outline_join(word, kind);
        if (status != QDOT_OK) {
            add_loop_values_to_error(x, &loop);
            break;
        }
        more = false;
        if (x->look == NULL)
            status = qdot_loop_next(&loop, &more);
        x->error_at = status != QDOT_OK ? clause->cursor.error_at : x->error_at;
    }
    qdot_loop_end(&loop);
    return status;
}

/* Carry out the statement at i, which ends before its word `for`, once in each pass of its loop. */
static qdot_status
carry_out_for_loop(engine *x, size_t i, const qdot_token *word)
{
    const qdot_cursor c = {.session = x->session, .source = x->source, .at = word};
    const qdot_statement *row = qdot_statement_row(&x->tokens[i]);
    qdot_record clause;
    qdot_status status = read_clause(x, &c, &x->tokens[i], word, false, &clause);

    if (status == QDOT_OK && row != NULL && row->names != NULL && x->look == NULL) {
        x->naming = true;
        status = go_through_passes(x, i, word, &clause);
        x->naming = false;
    }
    if (status == QDOT_OK)
        status = go_through_passes(x, i, word, &clause);
    qdot_record_free(&clause);
    return status;
}

/* Whether an error's hint is empty or declares the name; a mistyped statement word is likelier. */
static bool
is_bare_or_declares(const char *hint)
{
    return hint[0] == '\0' || hint[0] == '`' || strncmp(hint, "define it", 9) == 0;
}

/* The row of the statement [i, end), if it fails in its first tokens and nothing says how it goes on:
 * then its example helps. */
static const qdot_statement *
find_row_with_example(const engine *x, size_t i, size_t end)
{
    const qdot_token *first = &x->tokens[i];
    const qdot_error *error = qdot_last_error();
    const qdot_statement *row = qdot_statement_row(first);
    bool broken_off;

    if (row == NULL || row->alone || error->status != QDOT_ESYNTAX || error->hint[0] != '\0' ||
        strncmp(error->message, "expected ", 9) != 0 || strchr(error->message, '"') != NULL ||
        strstr(error->message, "or the end of the statement") != NULL ||
        !qdot_outline_fails_early(first, &x->tokens[end], x->error_at, &broken_off) ||
        qdot_statement_is_name(x->session, first, row))
        return NULL;
    return broken_off || strncmp(error->message, "expected an expression", 22) != 0 ? row : NULL;
}

static size_t find_fault(qdot_session *session, const char *text, size_t length);

/* Add a hint after statement [i, end) failed, if the statement has the form of a known mistake. */
static qdot_status
add_hint_at_mistake(engine *x, size_t i, size_t end, qdot_status status)
{
    qdot_cursor c = {.session = x->session, .source = x->source, .error_at = x->error_at};
    const qdot_statement *example;

    if (x->error_at == QDOT_SCRIPT_REPORTED || x->session->evaluation->placed)
        return status;
    if (status == QDOT_ENAME && x->error_at == x->tokens[i].start &&
        is_bare_or_declares(qdot_last_error()->hint)) { /* a misspelt statement, as `runn 0..10` */
        const qdot_statement *near = find_nearest_statement(x->session, x->tokens[i].text);

        if (near != NULL && strcmp(near->word, x->tokens[i].text) == 0)
            (void)qdot_hint("as in %s", near->example);
        else if (near != NULL)
            (void)qdot_hint("did you mean `%s`?", near->word);
    }
    if (x->look == NULL)
        qdot_hint_check_in_place(x->session, find_fault, x->source, x->tokens + i, x->tokens + end, x->error_at);
    (void)qdot_foreign_hint(&c, x->tokens + i, x->tokens + end);
    x->error_at = c.error_at;
    example = find_row_with_example(x, i, end);
    if (example != NULL)
        (void)qdot_hint("as in %s", example->example);
    return status;
}

/* Give a notice if the statement [i, end), just carried out, has a form that users rarely mean. */
static qdot_status
warn_of_rarely_meant(engine *x, size_t i, size_t end)
{
    const qdot_cursor c = {.session = x->session, .source = x->source};
    qdot_text text = {0};
    const char *notice = qdot_foreign_notice(&c, x->tokens + i, x->tokens + end, &text);
    qdot_status status =
        notice != NULL ? qdot_answer_notice(x->session, "%s", notice) : QDOT_OK;

    qdot_text_clear(&text);
    return status;
}

/* Carry out the statement at i, not a block, for all values of its `for` loop; *next: the token after it. */
static qdot_status
carry_out_simple(engine *x, size_t i, size_t *next)
{
    const qdot_outline whole = qdot_outline_statement(x->session, &x->tokens[i]);
    clock_t since = clock();
    bool timed = x->session->output->timing && x->frames.n == 0;
    qdot_cursor c = {.session = x->session, .source = x->source, .at = &x->tokens[i]};
    qdot_status status;

    *next = (size_t)(whole.end - x->tokens);
    x->session->evaluation->placed = false;
    qdot_text_list_clear(&x->session->evaluation->told);
    status = qdot_definition_check(&c, whole.end);
    if (status != QDOT_OK) {
        x->error_at = c.error_at;
        return status;
    }
    status = whole.loop == NULL ? carry_out_statement(x, i) : carry_out_for_loop(x, i, whole.loop);
    if (status != QDOT_OK)
        return add_hint_at_mistake(x, i, *next, status);
    QDOT_TRY(warn_of_rarely_meant(x, i, *next));
    if (timed && x->session->output->timing)
        qdot_timing_report(x->session, since);
    return QDOT_OK;
}

/* --- blocks in braces --------------------------------------------------------------- */

static void
leave_block(frame *f)
{
    qdot_loop_end(&f->loop);
    qdot_record_free(f->clause);
    qdot_free(f->clause);
}

/* Enter the block `{...}` that opens at i, or step over it if its loop has no values. */
static qdot_status
enter_block(engine *x, size_t i, size_t *next)
{
    frame f = {.body = i + 1, .close = x->match[i]};
    const qdot_token *close = &x->tokens[f.close], *first = &x->tokens[f.body], *word = qdot_outline_block_loop(close);
    qdot_cursor c = {.session = x->session, .source = x->source, .at = word != NULL ? word : close + 1};
    qdot_status status;
    bool more = false;

    x->error_at = c.at->start;
    QDOT_TRY(qdot_interrupt_check());
    if (word == NULL) {
        (void)qdot_cursor_expected(&c, "`for` after the block");
        return qdot_statement_row(first) == NULL ? qdot_hint("a list is written [a, b], a vector (a, b)") : QDOT_ESYNTAX;
    }
    f.resume = (size_t)(qdot_outline_end(close) - x->tokens);
    f.clause = qdot_malloc(sizeof *f.clause);
    if (f.clause == NULL)
        return QDOT_ENOMEM;
    status = read_clause(x, &c, first, close, true, f.clause);
    if (status == QDOT_OK && x->look != NULL)
        more = true;
    else if (status == QDOT_OK)
        status = begin_loop(x, &f.loop, f.clause, &more);
    *next = more ? f.body : f.resume;
    if (status == QDOT_OK && more)
        status = qdot_vec_push(&x->frames, f);
    if (status != QDOT_OK || !more)
        leave_block(&f);
    return status;
}

/* At the `}` of the innermost block: begin the next pass of its loop, or leave the block. */
static qdot_status
begin_next_pass(engine *x, size_t *next)
{
    frame *top = &x->frames.at[x->frames.n - 1];
    bool more = false;
    qdot_status status = x->look == NULL ? qdot_loop_next(&top->loop, &more) : QDOT_OK;

    if (status != QDOT_OK)
        x->error_at = top->clause->cursor.error_at;
    *next = more ? top->body : top->resume;
    if (!more) {
        leave_block(top);
        x->frames.n--;
    }
    return status;
}

/* Carry out the statement or the beginning or end of a block at *i, and move *i past it. */
static qdot_status
carry_out_next(engine *x, size_t *i)
{
    if (x->frames.n > 0 && *i == x->frames.at[x->frames.n - 1].close)
        return begin_next_pass(x, i);
    switch (qdot_outline_at(&x->tokens[*i])) {
    case QDOT_OUTLINE_BLOCK: return enter_block(x, *i, i);
    case QDOT_OUTLINE_STATEMENT: return carry_out_simple(x, *i, i);
    default: ++*i; return QDOT_OK;
    }
}

/* Leave the blocks that a failure or `quit` has ended, which takes the values of their loops out of the session; the error is told
 * with these values. */
static void
leave_blocks(engine *x, qdot_status status)
{
    while (x->frames.n > 0) {
        if (status != QDOT_OK)
            add_loop_values_to_error(x, &x->frames.at[x->frames.n - 1].loop);
        leave_block(&x->frames.at[--x->frames.n]);
    }
}

/* Carry out the statement or block at *i to its end. */
static qdot_status
carry_out_statement_or_block(engine *x, size_t *i)
{
    const qdot_token *first = &x->tokens[*i], *last;
    size_t begun = x->look == NULL ? qdot_undo_begin(x->session) : 0;
    const size_t facts = x->session->units->facts.n;
    qdot_status status;

    qdot_typed_begin(x->session, x->source, first->start);
    do
        status = carry_out_next(x, i);
    while (status == QDOT_OK && x->frames.n > 0 && !x->session->outcome->quit);
    last = x->frames.n > 0     ? &x->tokens[x->frames.at[0].resume]
           : status == QDOT_OK ? &x->tokens[*i]
                               : qdot_outline_end(first);
    last -= last > first;
    leave_blocks(x, status); /* before the state is kept for undo, to which values of loops do not belong */
    if (status != QDOT_OK) /* what a failed statement said of dimensions is not kept */
        qdot_units_back_to(x->session, facts);
    if (x->look == NULL)
        qdot_undo_end(x->session, begun, x->source->text + first->start, last->start + last->length - first->start);
    if (status == QDOT_OK) /* after a failure, the statement ends only when its error has been printed */
        qdot_typed_end(x->session, x->source->text + first->start, last->start + last->length - first->start, status);
    return status;
}

static qdot_status
carry_out_all(engine *x)
{
    size_t i = 0;

    while (i < x->n && !x->session->outcome->quit) {
        if (qdot_outline_at(&x->tokens[i]) == QDOT_OUTLINE_END)
            i++;
        else
            QDOT_TRY(carry_out_statement_or_block(x, &i));
    }
    return QDOT_OK;
}

/* Report the error of a statement, or of a text that could not be split into statements; of a text that is only looked at, keep
 * the place. */
static void
report_error(engine *x)
{
    if (x->look == NULL)
        qdot_hint_check(x->session, find_fault);
    x->session->outcome->error_at = x->error_at;
    if (x->look != NULL)
        return;
    qdot_typed_begin(x->session, x->source, x->error_at);
    qdot_answer_error(x->session, x->source, x->error_at);
}

/* --- a whole script ----------------------------------------------------------------- */

/* Carry out a text, or look at it only. */
static qdot_status
go_through_text(qdot_session *session, const char *name, uint32_t before, const char *text, size_t length,
                const qdot_look *look)
{
    engine x = {.session = session, .look = look};
    qdot_status status = qdot_source_new(name, text, length, &x.source, &x.error_at);
    size_t outer = qdot_undo_text_begin(session);

    if (x.source != NULL)
        x.source->lines_before = before;
    session->typed->texts++;
    (void)qdot_memory_ran_out(); /* clears the flag of earlier failures, which were reported */
    if (status == QDOT_OK && look == NULL)
        status = qdot_session_remarks_keep(session, text, length);
    if (status == QDOT_OK) {
        x.tokens = x.source->tokens.at;
        x.n = x.source->tokens.n;
        status = qdot_outline_blocks(x.source, &x.match);
    }
    if (status == QDOT_OK)
        status = carry_out_all(&x);
    qdot_undo_text_end(session, outer);
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

qdot_status
qdot_script_carry_out(qdot_session *session, const char *name, uint32_t before, const char *text, size_t length)
{
    return go_through_text(session, name, before, text, length, NULL);
}

qdot_status
qdot_script_look_at(qdot_session *session, const char *name, uint32_t before, const char *text, size_t length,
                    const qdot_look *look)
{
    return go_through_text(session, name, before, text, length, look);
}

/* Parse the text. Returns where it fails, or SIZE_MAX: it does not. */
static size_t
find_fault(qdot_session *session, const char *text, size_t length)
{
    const qdot_look look = {NULL, NULL};
    const qdot_status status = go_through_text(session, "", 0, text, length, &look);

    return status == QDOT_OK ? SIZE_MAX : session->outcome->error_at;
}
