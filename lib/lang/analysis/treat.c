/* treat.c -- one statement after the other: carried out, or parsed, and what is to be said of it. */
#include "lang/analysis/treat.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "lang/analysis/meaning.h"
#include "lang/analysis/pieces.h"
#include "lang/analysis/torn.h"
#include "lang/session/outcome.h"
#include "lang/session/output.h"
#include "lang/session/session.h"
#include "lang/session/undo.h"
#include "lang/syntax/definition.h"
#include "lang/syntax/outline.h"
#include "lang/workbench/script.h"
#include "mech/scene/scene.h"
#include "table/csv-read.h"

/* Steps of work, which are checks for an interrupt: for what declares, for one question, for all questions of a text. */
enum { DECLARING = 20000, ASKING = 2000, ALL_ASKING = 40000 };
enum { FILE_LIMIT = 1 << 24, DEEPEST = 20, MOST = 3000 /* statements of a document that are looked at */ };

/* What is done with a statement. */
typedef enum {
    CARRIED,  /* it declares something, and is carried out */
    ASKED,    /* it asks something: it is carried out, but nothing is lost if it cannot be */
    LOOKED_AT /* it is parsed only */
} way;

/* A text that is gone through: that of the document, or of a script that it includes. */
typedef struct {
    qdot_analysis *a;
    const char *name;
    const qdot_source *source;
    size_t piece;     /* the piece of the document that it belongs to */
    unsigned depth;   /* of scripts that include each other */
    bool included;
    qdot_piece_state state;
} passage;

/* --- what is to be said --------------------------------------------------------------- */

/* The stretch of the token at byte `at`; if none is there, of nothing. */
static qdot_stretch
stretch_at(const qdot_source *source, size_t at)
{
    const size_t k = qdot_analysis_token(source, at);
    const qdot_token *token = k != SIZE_MAX ? &source->tokens.at[k] : NULL;

    if (token == NULL || token->start + token->length <= at)
        return (qdot_stretch){at, at};
    return (qdot_stretch){at, token->start + token->length};
}

/* Append a remark on the present statement of the passage; of an included script it stands at the statement that includes it. */
static qdot_status
say(passage *p, const qdot_piece *piece, qdot_stretch at, qdot_remark_level level, const char *message, const char *hint)
{
    qdot_analysis *a = p->a;
    const size_t origin = a->pieces.at[p->piece].at.from;
    qdot_text text = {0};
    qdot_status status;
    uint32_t line, column;

    if (!p->included) {
        QDOT_TRY(qdot_remark_add(&a->remarks, (qdot_stretch){at.from - origin, at.to - origin}, level, message, hint));
        if (level != QDOT_REMARK_ERROR)
            return QDOT_OK;
        /* the place is counted from the piece, the text from its beginning */
        return qdot_remark_find_fix(&a->remarks.at[a->remarks.n - 1], p->source->text + origin);
    }
    if (level != QDOT_REMARK_ERROR)
        return QDOT_OK;
    (void)piece;
    qdot_source_locate(p->source, at.from, &line, &column);
    qdot_text_format(&text, "%s:%u:%u: %s", p->name, line, column, message);
    status = qdot_text_status(&text);
    if (status == QDOT_OK)
        status = qdot_remark_add(&a->remarks, (qdot_stretch){0, a->pieces.at[p->piece].at.to - origin}, level,
                                 qdot_text_str(&text), hint);
    qdot_text_clear(&text);
    return status;
}

/* The failure of a statement as a remark. */
static qdot_status
say_error(passage *p, const qdot_piece *piece)
{
    const qdot_error error = *qdot_last_error();
    const size_t at = piece->at.from + p->a->session->outcome->error_at;

    if ((error.status == QDOT_EUNSET && p->state.loose) || error.status == QDOT_EINTR)
        return QDOT_OK;
    return say(p, piece, stretch_at(p->source, at <= p->source->length ? at : piece->at.from), QDOT_REMARK_ERROR, error.message,
               error.hint);
}

/* The notices of a statement, a line each, as remarks. */
static qdot_status
say_notices(passage *p, const qdot_piece *piece, const char *notices)
{
    static const char begin[] = "notice: ";
    qdot_status status = QDOT_OK;

    for (const char *line = notices; line != NULL && *line != '\0' && status == QDOT_OK;) {
        const char *end = strchr(line, '\n');
        const size_t n = end != NULL ? (size_t)(end - line) : strlen(line);

        if (n >= sizeof begin && strncmp(line, begin, sizeof begin - 1) == 0) {
            char *message = qdot_strndup(line + sizeof begin - 1, n - (sizeof begin - 1));

            status = message == NULL ? QDOT_ENOMEM
                                     : say(p, piece, stretch_at(p->source, piece->at.from), QDOT_REMARK_NOTICE, message, "");
            qdot_free(message);
        }
        line = end != NULL ? end + 1 : NULL;
    }
    return status;
}

/* --- carrying out --------------------------------------------------------------------- */

/* The text of a piece as it is carried out or parsed; the caller's. */
static char *
text_of(const passage *p, const qdot_piece *piece)
{
    return qdot_strndup(p->source->text + piece->at.from, piece->at.to - piece->at.from);
}

/* Whether the statement failed at a name whose meaning is not known here. */
static bool
is_at_unknown(const passage *p, const qdot_piece *piece)
{
    const size_t k = qdot_analysis_token(p->source, piece->at.from + p->a->session->outcome->error_at);

    return qdot_last_error()->status == QDOT_ENAME && k != SIZE_MAX && qdot_meaning_is_unknown(p->a, p->source->tokens.at[k].text);
}

/* Parse the piece, and tell its failure. */
static qdot_status
look_at(passage *p, const qdot_piece *piece)
{
    qdot_session *session = p->a->session;
    qdot_meaning meaning = {.a = p->a,
                            .from = &p->source->tokens.at[piece->first],
                            .to = &p->source->tokens.at[piece->end],
                            .uncertain = p->state.uncertain};
    const qdot_look look = {qdot_meaning_expression, &meaning};
    char *text = text_of(p, piece);
    qdot_status status;

    if (text == NULL)
        return QDOT_ENOMEM;
    session->output->out = session->output->err = session->output->console = p->a->nowhere;
    status = qdot_script_look_at(session, p->name, piece->line, text, piece->at.to - piece->at.from, &look);
    qdot_free(text);
    if (status == QDOT_OK || status == QDOT_ENOMEM || p->state.uncertain || is_at_unknown(p, piece))
        return status == QDOT_ENOMEM ? status : QDOT_OK;
    return say_error(p, piece);
}

/* Carry out the text of a piece with a budget of steps; *used: how many it took. Its failure is the returned status, and
 * is not told yet. asks: it only asks, and what is to be known of its answer is no matter here. */
static qdot_status
carry_out(passage *p, const qdot_piece *piece, const char *text, bool asks, int budget, int *used)
{
    qdot_session *session = p->a->session;
    char *notices = NULL, *answers = NULL;
    size_t n, m;
    FILE *console = open_memstream(&notices, &n), *out = open_memstream(&answers, &m);
    qdot_status status = console != NULL && out != NULL ? QDOT_OK : QDOT_ENOMEM, said = QDOT_OK;
    qdot_error error = {0};

    session->output->console = console;
    session->output->out = out;
    session->output->err = p->a->nowhere;
    session->outcome->refuted = false;
    if (status == QDOT_OK) {
        qdot_interrupt_set_at(budget);
        status = qdot_script_carry_out(session, p->name, piece->line, text, strlen(text));
        *used = budget - qdot_interrupt_checks_left();
        qdot_interrupt_set_at(-1);
        error = *qdot_last_error();
        /* a failure that follows from an interruption may have another name */
        if (qdot_interrupt_is_set() && (status != QDOT_OK || *used <= budget))
            status = QDOT_EINTR;
        qdot_interrupt_clear();
    }
    session->output->out = session->output->err = session->output->console = p->a->nowhere;
    if (console != NULL)
        (void)fclose(console);
    if (out != NULL)
        (void)fclose(out);
    if (status == QDOT_OK && !asks)
        said = say_notices(p, piece, notices);
    if (said == QDOT_OK && status == QDOT_OK && session->outcome->refuted && !p->state.loose) {
        answers[strcspn(answers, "\n")] = '\0';
        said = say(p, piece, piece->at, QDOT_REMARK_WARNING, answers, "");
    }
    session->outcome->quit = session->outcome->failed = session->outcome->refuted = false;
    free(notices);
    free(answers);
    QDOT_TRY(said);
    return status == QDOT_OK || status == QDOT_EINTR ? status : qdot_fail_again(&error);
}

/* --- what to do with a statement ------------------------------------------------------ */

static bool
is_word_among(const qdot_token *token, const char *const *words)
{
    for (; *words != NULL; words++)
        if (qdot_token_is_word(token, *words))
            return true;
    return false;
}

static way
choose_way(const passage *p, const qdot_token *first, const qdot_token *end)
{
    static const char *const values[] = {"set", "start", "scale", NULL};
    const qdot_form form = qdot_statement_form(p->a->session, first);
    const qdot_statement *row = form == QDOT_FORM_WORD ? qdot_statement_row(first) : NULL;

    if (p->state.uncertain || qdot_meaning_depends(p->a, first, end))
        return LOOKED_AT;
    if (qdot_token_is_word(first, "start") && first + 2 == end && p->a->unknown.n > p->a->forgotten) /* at the end of a run */
        return LOOKED_AT;
    if (p->state.loose && qdot_token_is_word(first, "start")) /* it may follow another start that is not known */
        return LOOKED_AT;
    if (form == QDOT_FORM_DEFINITION || form == QDOT_FORM_UNKNOWN)
        return CARRIED;
    if (row == NULL || qdot_statement_asks(row) || strcmp(row->word, "print") == 0)
        return p->a->quick || p->state.partial || p->state.work >= ALL_ASKING ? LOOKED_AT : ASKED;
    return qdot_statement_declares(row) || is_word_among(first, values) ? CARRIED : LOOKED_AT;
}

/* Make the names unknown that a definition that was not carried out would have defined, a run `as NAME` is called, or
 * that occur in a declaration. */
static qdot_status
note_unknown(passage *p, const qdot_token *first, const qdot_token *end, bool carried)
{
    static const char *const values[] = {"set", "start", "find", "fit", "continue", NULL}, *const files[] = {"include", "data", NULL};
    const qdot_form form = qdot_statement_form(p->a->session, first);
    const qdot_statement *row = form == QDOT_FORM_WORD ? qdot_statement_row(first) : NULL;
    bool removed = false;

    if (form == QDOT_FORM_DEFINITION && !carried)
        QDOT_TRY(qdot_meaning_add_unknown(p->a, first->text, false));
    for (const qdot_token *k = first; k + 1 < end; k++)
        if (qdot_token_is_word(k, "as") && k[1].kind == QDOT_TOKEN_NAME && row != NULL && !carried)
            QDOT_TRY(qdot_meaning_add_unknown(p->a, k[1].text, true));
    if (qdot_token_is_word(first, "remove") && !carried && first + 2 == end && !qdot_scene_has_label(p->a->session->scene, first[1].text))
        QDOT_TRY(qdot_meaning_remove_label(p->a, first[1].text, &removed));
    if (removed)
        return QDOT_OK;
    if (is_word_among(first, values) && !carried)
        p->state.loose = true;
    if (carried && row != NULL && strcmp(row->word, "reset") == 0 && first + 1 == end) { /* `reset scene` keeps numbers */
        p->a->forgotten = p->a->unknown.n;
        p->state.partial = p->state.loose = false;
    }
    if (is_word_among(first, files))
        p->state.reads = true;
    if (qdot_token_is_word(first, "linearize") && !carried)
        p->state.partial = true;
    if (row != NULL && !carried &&
        (strcmp(row->word, "undo") == 0 || strcmp(row->word, "redo") == 0 || strcmp(row->word, "quit") == 0))
        p->state.uncertain = true;
    if (row == NULL || !qdot_statement_declares(row) || carried)
        return QDOT_OK;
    p->state.partial = true;
    for (const qdot_token *k = first + 1; k < end; k++)
        if (k->kind == QDOT_TOKEN_NAME && !qdot_cursor_knows(p->a->session, k->text))
            QDOT_TRY(qdot_meaning_add_unknown(p->a, k->text, false));
    return QDOT_OK;
}

/* --- one piece ------------------------------------------------------------------------ */

/* Call `each` for each statement in the tokens of a piece. */
static qdot_status
for_statements(passage *p, const qdot_piece *piece, qdot_status (*each)(passage *, const qdot_token *, const qdot_token *, void *),
               void *data)
{
    const qdot_token *tokens = p->source->tokens.at;

    for (const qdot_token *k = tokens + piece->first; k < tokens + piece->end;) {
        if (k->kind == QDOT_TOKEN_END || qdot_token_is(k, "{")) {
            k++;
        } else if (qdot_token_is(k, "}")) {
            k = qdot_outline_end(k);
        } else {
            const qdot_token *end = qdot_outline_end(k);

            QDOT_TRY(each(p, k, end, data));
            k = end;
        }
    }
    return QDOT_OK;
}

/* How a piece is gone about. */
typedef struct {
    char *text; /* what is carried out */
    size_t origin;
    bool block;
    bool declares, asks, leaves; /* statements are carried out, ask only; others are parsed only */
    bool failed;                 /* they were not, after all */
    qdot_vec(uint8_t) ways;      /* of each statement */
    size_t next;                 /* for note_statement: which is next */
} plan;

/* Blank what is not to be carried out: the statement, or that its answer is written to a file. */
static qdot_status
plan_statement(passage *p, const qdot_token *first, const qdot_token *end, void *data)
{
    plan *work = data;
    const way w = choose_way(p, first, end);
    const qdot_token *to = qdot_outline_file(first);
    const size_t last = end[-1].start + end[-1].length;

    QDOT_TRY(qdot_vec_push(&work->ways, (uint8_t)w));
    work->declares = work->declares || w == CARRIED;
    work->asks = work->asks || w == ASKED;
    work->leaves = work->leaves || w == LOOKED_AT;
    if (w == LOOKED_AT)
        memset(work->text + (first->start - work->origin), ' ', last - first->start);
    else if (to != NULL && (w == ASKED || qdot_statement_form(p->a->session, first) != QDOT_FORM_DEFINITION))
        memset(work->text + (to->start - work->origin), ' ', last - to->start);
    /* in a block the statements behind it depend on it */
    return w == LOOKED_AT && work->block ? note_unknown(p, first, end, false) : QDOT_OK;
}

static qdot_status
note_statement(passage *p, const qdot_token *first, const qdot_token *end, void *data)
{
    plan *work = data;

    return note_unknown(p, first, end, !work->failed && work->ways.at[work->next++] != LOOKED_AT);
}

static qdot_status go_through_script(passage *from, const qdot_piece *piece);

static qdot_status
treat(passage *p, const qdot_piece *piece)
{
    const qdot_token *first = &p->source->tokens.at[piece->first];
    plan work = {.text = text_of(p, piece), .origin = piece->at.from, .block = piece->block};
    int used = 0;
    qdot_status status;

    if (work.text == NULL)
        return QDOT_ENOMEM;
    status = for_statements(p, piece, plan_statement, &work);
    if (status == QDOT_OK && (work.declares || work.asks)) {
        const int budget = work.declares ? DECLARING : ASKING;

        status = carry_out(p, piece, work.text, !work.declares, budget, &used);
        if (!work.declares)
            p->state.work += used;
        work.failed = status != QDOT_OK;
        if (status == QDOT_EINTR && used <= budget) { /* not for its budget: it has to wait */
            qdot_free(work.text);
            qdot_free(work.ways.at);
            return status;
        }
        if (status == QDOT_EINTR)
            work.leaves = true;
        if (status != QDOT_OK && status != QDOT_ENOMEM && status != QDOT_EINTR) {
            status = say_error(p, piece);
            work.leaves = false;
        } else if (status == QDOT_EINTR) {
            status = QDOT_OK;
        }
    }
    qdot_free(work.text);
    if (status == QDOT_OK && work.leaves)
        status = look_at(p, piece);
    if (status == QDOT_OK)
        status = for_statements(p, piece, note_statement, &work);
    qdot_free(work.ways.at);
    if (status == QDOT_OK && qdot_token_is_word(first, "include") && first[1].kind == QDOT_TOKEN_STRING && !p->state.uncertain)
        status = go_through_script(p, piece);
    return status;
}

/* --- scripts that are included -------------------------------------------------------- */

static qdot_status
read_script(const qdot_analysis *a, const char *name, const char *path, qdot_text *text)
{
    FILE *file;
    qdot_status status;

    if (a->host.read != NULL && a->host.read(a->host.data, path, text))
        return qdot_text_status(text);
    file = fopen(path, "rb");
    if (file == NULL)
        return qdot_fail(QDOT_EIO, "`%.300s` cannot be opened: %s", name, strerror(errno));
    status = qdot_text_read(text, file, path, FILE_LIMIT);
    fclose(file);
    return status;
}

/* Whether a statement before `end` writes the file, which is there then when the script is run. */
static bool
is_written_before(const qdot_source *source, const qdot_token *end)
{
    for (const qdot_token *k = source->tokens.at + 1; k < end - 1; k++)
        if (k->kind == QDOT_TOKEN_STRING && strcmp(k->text, end->text) == 0 && qdot_token_is_word(k - 1, "to"))
            return true;
    return false;
}

/* Go through the statements of a script that has been read. */
static qdot_status
go_through_pieces(passage *p)
{
    qdot_piece_list pieces = {0};
    qdot_status status = qdot_pieces_of(p->source, &pieces);

    for (size_t i = 0; i < pieces.n && status == QDOT_OK; i++)
        status = treat(p, &pieces.at[i]);
    qdot_free(pieces.at);
    return status;
}

/* Read the script at the path, called `name` where it is included, and go through it as the passage p, whose source it becomes. */
static qdot_status
go_through_file(passage *p, const qdot_piece *at, const char *name, const char *path)
{
    qdot_analysis *a = p->a;
    qdot_remark_list torn = {0};
    qdot_included included = {.path = qdot_strdup(path), .piece = p->piece};
    qdot_text text = {0};
    qdot_status status = included.path != NULL ? read_script(a, name, path, &text) : QDOT_ENOMEM;

    if (status == QDOT_OK)
        status = qdot_torn_source(path, qdot_text_str(&text), text.n, &included.source, &torn);
    if (status == QDOT_OK)
        status = qdot_vec_push(&a->included, included);
    qdot_text_clear(&text);
    if (status != QDOT_OK) {
        qdot_remark_clear(&torn);
        qdot_free(included.path);
        qdot_source_free(included.source);
        return status;
    }
    p->source = included.source;
    p->name = included.path;
    for (size_t i = 0; i < torn.n && status == QDOT_OK; i++)
        status = say(p, at, torn.at[i].at, QDOT_REMARK_ERROR, torn.at[i].message, torn.at[i].hint);
    qdot_remark_clear(&torn);
    return status == QDOT_OK ? go_through_pieces(p) : status;
}

static qdot_status
go_through_script(passage *from, const qdot_piece *piece)
{
    qdot_analysis *a = from->a;
    const qdot_token *name = &from->source->tokens.at[piece->first + 1];
    passage p = {.a = a, .piece = from->piece, .depth = from->depth + 1, .included = true, .state = from->state};
    qdot_text path = {0};
    char *own = NULL;
    qdot_status status;

    qdot_session_path(a->session, name->text, &path);
    status = qdot_text_status(&path);
    for (size_t i = 0; i < a->session->including->n && status == QDOT_OK; i++)
        if (strcmp(a->session->including->at[i], qdot_text_str(&path)) == 0)
            status = qdot_fail(QDOT_EINVAL, "`%.300s` includes itself", name->text);
    if (status == QDOT_OK && p.depth > DEEPEST)
        status = qdot_fail(QDOT_ELIMIT, "more than %d scripts include one another", DEEPEST);
    own = status == QDOT_OK ? qdot_strdup(qdot_text_str(&path)) : NULL;
    if (status == QDOT_OK)
        status = own != NULL ? qdot_vec_push(a->session->including, own) : QDOT_ENOMEM;
    if (status == QDOT_OK) {
        status = go_through_file(&p, piece, name->text, own);
        a->session->including->n--;
        from->state = p.state;
    }
    qdot_free(own);
    qdot_text_clear(&path);
    if (status == QDOT_OK || status == QDOT_ENOMEM)
        return status;
    a->session->outcome->error_at = name->start - piece->at.from;
    from->state.partial = from->state.uncertain = true; /* who knows what it declares */
    if (status == QDOT_EIO && is_written_before(from->source, name))
        return QDOT_OK;
    return say_error(from, piece);
}

/* --- the document --------------------------------------------------------------------- */

qdot_status
qdot_treat_piece(qdot_analysis *a, size_t i)
{
    const char *slash = strrchr(a->path, '/');
    passage p = {.a = a, .name = slash != NULL ? slash + 1 : a->path, .source = a->source, .piece = i};
    qdot_piece *piece = &a->pieces.at[i];

    if (i > 0)
        p.state = a->pieces.at[i - 1].behind;
    if (i < MOST)
        QDOT_TRY(treat(&p, piece));
    p.state.remarks = a->remarks.n;
    p.state.undo = qdot_undo_statements(a->session, false);
    p.state.told = a->session->told->n;
    p.state.unknown = a->unknown.n;
    p.state.forgotten = a->forgotten;
    p.state.included = a->included.n;
    piece->behind = p.state;
    return QDOT_OK;
}
