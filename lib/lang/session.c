/* session.c -- a conversation begun, ended, reset; its texts and files. */
#include "lang/session.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "lang/answer.h"
#include "lang/carry.h"
#include "lang/function.h"
#include "lang/statement.h"
#include "lang/undo.h"

enum { FILE_LIMIT = 1 << 28, INCLUDE_LIMIT = 100 };

/* --- begin and end ------------------------------------------------------------------ */

qdot_session *
qdot_session_new(FILE *out, FILE *err)
{
    qdot_session *s = qdot_calloc(1, sizeof *s);

    if (s == NULL)
        return NULL;
    s->out = out;
    s->err = err;
    s->pool = qdot_pool_new();
    s->names = qdot_names_new();
    if (s->pool != NULL)
        s->scene = qdot_scene_new(s->pool);
    if (s->pool == NULL || s->names == NULL || s->scene == NULL) {
        qdot_session_free(s);
        return NULL;
    }
    return s;
}

void
qdot_named_run_release(qdot_named_run *run)
{
    if (--*run->uses > 0)
        return;
    qdot_free(run->name);
    qdot_free(run->text);
    qdot_run_free(run->run);
    qdot_free(run->uses);
}

void
qdot_session_free(qdot_session *session)
{
    if (session == NULL)
        return;
    qdot_undo_free(session->undo);
    for (size_t i = 0; i < session->runs.n; i++)
        qdot_named_run_release(&session->runs.at[i]);
    qdot_free(session->runs.at);
    qdot_free(session->partial_sums.at);
    qdot_free(session->history.at);
    qdot_free(session->history_over.at);
    qdot_free(session->measured.at);
    for (size_t i = 0; i < session->members.n; i++)
        qdot_free(session->members.at[i].run);
    qdot_free(session->members.at);
    qdot_free(session->set_symbols.at);
    qdot_free(session->set_values.at);
    qdot_free(session->start_symbols.at);
    qdot_free(session->start_values.at);
    for (size_t i = 0; i < session->told.n; i++)
        qdot_free(session->told.at[i]);
    qdot_free(session->told.at);
    for (size_t i = 0; i < session->including.n; i++)
        qdot_free(session->including.at[i]);
    qdot_free(session->including.at);
    if (session->scene != NULL)
        qdot_scene_free(session->scene);
    if (session->names != NULL)
        qdot_names_free(session->names);
    if (session->pool != NULL)
        qdot_pool_free(session->pool);
    qdot_free(session);
}

/* --- reset -------------------------------------------------------------------------- */

/* What goes with the scene. */
enum {
    SCENE = QDOT_HAS_COORD | QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION | QDOT_HAS_MOMENTUM |
            QDOT_HAS_MULTIPLIER | QDOT_HAS_DELTA | QDOT_HAS_DIFFERENTIAL
};

/* Whether a name outlives `reset scene`: parameters, and what holds no coordinate. */
static bool
is_kept(const qdot_pool *pool, const qdot_name *name)
{
    return name->kind != QDOT_NAME_COORD &&
           (qdot_expr_node(pool, name->value)->holds & SCENE) == 0;
}

/* A function goes with the names that its body mentions. */
static bool
is_function_kept(const qdot_session *session, const qdot_name *function)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(session->names, i)) != NULL; i++)
        if (!is_kept(session->pool, name) &&
            qdot_function_mentions(session->pool, function, name->name))
            return false;
    return true;
}

/* Carry what is kept of `old` over into `fresh`, which has a pool and names of its
 * own. */
static qdot_status
keep(const qdot_session *old, qdot_session *fresh)
{
    const qdot_name *name;

    for (size_t i = 0; (name = qdot_names_at(old->names, i)) != NULL; i++) {
        qdot_name copy = *name;

        if (!is_kept(old->pool, name) ||
            (name->kind == QDOT_NAME_FUNCTION && !is_function_kept(old, name)))
            continue;
        copy.value = qdot_carry(old->pool, fresh->pool, name->value);
        copy.formals = qdot_carry(old->pool, fresh->pool, name->formals);
        copy.over = QDOT_NIL; /* coordinates go with the scene */
        QDOT_TRY(qdot_pool_check(fresh->pool));
        if (name->kind == QDOT_NAME_UFUN)
            copy.ufun = qdot_expr_node(fresh->pool, copy.value)->op;
        QDOT_TRY(qdot_names_declare(fresh->names, &copy));
    }
    for (size_t i = 0; i < old->set_symbols.n; i++) {
        const qdot_node *symbol = qdot_expr_node(old->pool, old->set_symbols.at[i]);

        if (symbol->holds & QDOT_HAS_MOMENTUM)
            continue;
        if (symbol->kind == QDOT_UFUN &&
            qdot_names_find(fresh->names, qdot_ufun_get(old->pool, symbol->op)->name) ==
                NULL)
            continue;
        QDOT_TRY(qdot_vec_push(&fresh->set_symbols, qdot_carry(old->pool, fresh->pool,
                                                               old->set_symbols.at[i])));
        QDOT_TRY(qdot_vec_push(&fresh->set_values, qdot_carry(old->pool, fresh->pool,
                                                              old->set_values.at[i])));
    }
    for (size_t i = 0; i < old->scene->assumed.n; i++) {
        const qdot_assumption *said = &old->scene->assumed.at[i];

        if (!(qdot_expr_node(old->pool, said->relation)->holds & SCENE))
            QDOT_TRY(qdot_scene_assume(fresh->scene,
                                       qdot_carry(old->pool, fresh->pool, said->relation),
                                       said->turned));
    }
    for (size_t i = 0; i < old->measured.n; i++) {
        qdot_measured m = old->measured.at[i];

        m.symbol = qdot_carry(old->pool, fresh->pool, m.symbol);
        if (m.digits > 0)
            m.exact = qdot_carry(old->pool, fresh->pool, m.exact);
        QDOT_TRY(qdot_vec_push(&fresh->measured, m));
    }
    return qdot_pool_check(fresh->pool);
}

void
qdot_session_exchange(qdot_session *session, qdot_session *other)
{
    const qdot_session swap = *session;

    *session = *other;
    *other = swap;
#define STAYS(field)                                                                     \
    other->field = session->field;                                                       \
    session->field = swap.field;
    STAYS(out)
    STAYS(err)
    STAYS(style)
    STAYS(json)
    STAYS(timing)
    STAYS(interactive)
    STAYS(console)
    STAYS(console_json)
    STAYS(failed)
    STAYS(refuted)
    STAYS(figures)
    STAYS(quit)
    STAYS(undo)
#undef STAYS
    memcpy(&other->including, &session->including, sizeof session->including);
    memcpy(&session->including, &swap.including, sizeof session->including);
}

qdot_status
qdot_session_reset(qdot_session *session, bool everything)
{
    qdot_session *fresh;
    qdot_status status = QDOT_OK;

    if (session->loops > 0)
        return qdot_fail(QDOT_EINVAL, "`reset` has no place inside a loop");
    fresh = qdot_session_new(session->out, session->err);
    if (fresh == NULL)
        return QDOT_ENOMEM;
    if (!everything)
        status = keep(session, fresh);
    if (status != QDOT_OK) {
        qdot_session_free(fresh);
        return status;
    }
    qdot_session_exchange(session, fresh);
    qdot_undo_reset(session, fresh);
    return QDOT_OK;
}

/* --- texts and files ---------------------------------------------------------------- */

static int
exit_status(qdot_session *session, qdot_status status)
{
    session->failed = status != QDOT_OK;
    if (status != QDOT_OK)
        return status == QDOT_ESYNTAX ? 2 : 1;
    return session->refuted ? 1 : 0;
}

int
qdot_session_run_text(qdot_session *session, const char *name, const char *text,
                      size_t length)
{
    return exit_status(session, qdot_statement_run_text(session, name, text, length));
}

static qdot_status
read_stream(FILE *file, const char *path, qdot_text *text)
{
    char block[65536];
    size_t n;

    while ((n = fread(block, 1, sizeof block, file)) > 0) {
        qdot_text_add_n(text, block, n);
        if (text->n > FILE_LIMIT)
            return qdot_fail(QDOT_ELIMIT, "`%s` is larger than %d MB", path,
                             FILE_LIMIT >> 20);
    }
    if (ferror(file))
        return qdot_fail(QDOT_EIO, "`%s` cannot be read: %s", path, strerror(errno));
    return qdot_text_status(text);
}

static qdot_status
read_file(const char *path, qdot_text *text)
{
    bool standard = strcmp(path, "-") == 0;
    FILE *file = standard ? stdin : fopen(path, "rb");
    qdot_status status;
    struct stat info;

    if (file == NULL)
        return qdot_fail(QDOT_EIO, "`%s` cannot be opened: %s", path, strerror(errno));
    if (fstat(fileno(file), &info) == 0 && S_ISDIR(info.st_mode))
        status = qdot_fail(QDOT_EIO, "`%s` is a directory", path);
    else
        status = read_stream(file, path, text);
    if (!standard)
        fclose(file);
    return status;
}

/* Whether the file is being read already. */
static bool
is_open(const qdot_session *session, const char *path)
{
    struct stat info, other;

    if (stat(path, &info) != 0)
        return false;
    for (size_t i = 0; i < session->including.n; i++)
        if (stat(session->including.at[i], &other) == 0 && info.st_dev == other.st_dev &&
            info.st_ino == other.st_ino)
            return true;
    return false;
}

qdot_status
qdot_statement_run_file(qdot_session *session, const char *path, bool *opened)
{
    bool standard = strcmp(path, "-") == 0;
    qdot_text text = {0};
    qdot_status status;
    char *own;

    *opened = false;
    if (!standard && is_open(session, path))
        return qdot_fail(QDOT_EINVAL, "`%s` includes itself", path);
    if (session->including.n >= INCLUDE_LIMIT)
        return qdot_fail(QDOT_ELIMIT, "more than %d scripts include one another",
                         INCLUDE_LIMIT);
    if (session->including.n == 0)
        session->figures = 0;
    own = qdot_strdup(path);
    if (own == NULL)
        return QDOT_ENOMEM;
    status = qdot_vec_push(&session->including, own);
    if (status != QDOT_OK) {
        qdot_free(own);
        return status;
    }
    status = read_file(path, &text);
    if (status == QDOT_OK) {
        *opened = true;
        status = qdot_statement_run_text(session, standard ? "standard input" : path,
                                         qdot_text_str(&text), text.n);
    }
    qdot_text_clear(&text);
    qdot_free(session->including.at[--session->including.n]);
    return status;
}

int
qdot_session_run_file(qdot_session *session, const char *path)
{
    bool opened;
    qdot_status status = qdot_statement_run_file(session, path, &opened);

    if (status != QDOT_OK && !opened)
        qdot_answer_error(session, NULL, 0);
    return exit_status(session, status);
}

bool
qdot_session_incomplete(const char *text, size_t length)
{
    long open = 0;
    bool more = false; /* behind a trailing backslash */

    for (size_t i = 0; i < length; i++) {
        char c = text[i];

        if (c == '"') {
            for (i++; i < length && text[i] != '"' && text[i] != '\n'; i++)
                i += text[i] == '\\';
            more = false;
        } else if (c == '#') {
            while (i < length && text[i] != '\n')
                i++;
        } else if (c == '\\') {
            more = true;
        } else if (c != ' ' && c != '\t' && c != '\r' && c != '\n') {
            more = false;
            open += c == '(' || c == '[' || c == '{';
            open -= c == ')' || c == ']' || c == '}';
        }
    }
    return open > 0 || more;
}

/* --- completion --------------------------------------------------------------------- */

typedef struct {
    const char *prefix;
    qdot_vec(char *) words;
    qdot_status status;
} completion;

static void
offer(completion *c, const char *word)
{
    char *copy;

    if (c->status != QDOT_OK || strncmp(word, c->prefix, strlen(c->prefix)) != 0)
        return;
    copy = qdot_strdup(word);
    c->status = copy == NULL ? QDOT_ENOMEM : qdot_vec_push(&c->words, copy);
}

static int
by_spelling(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void
offer_labels(completion *c, const qdot_scene *scene)
{
    for (size_t i = 0; i < scene->particles.n; i++)
        offer(c, scene->particles.at[i].name);
    for (size_t i = 0; i < scene->bodies.n; i++)
        offer(c, scene->bodies.at[i].name);
    for (size_t i = 0; i < scene->springs.n; i++)
        if (scene->springs.at[i].name != NULL)
            offer(c, scene->springs.at[i].name);
    for (size_t i = 0; i < scene->dampers.n; i++)
        if (scene->dampers.at[i].name != NULL)
            offer(c, scene->dampers.at[i].name);
    for (size_t i = 0; i < scene->constraints.n; i++)
        if (scene->constraints.at[i].label != NULL)
            offer(c, scene->constraints.at[i].label);
#define OFFER(list)                                                                      \
    for (size_t i = 0; i < scene->list.n; i++)                                           \
        if (scene->list.at[i].name != NULL)                                              \
            offer(c, scene->list.at[i].name);
    OFFER(gravities)
    OFFER(potentials)
    OFFER(dissipations)
    OFFER(forces)
    OFFER(torques)
    OFFER(events)
#undef OFFER
}

qdot_status
qdot_session_complete(qdot_session *session, const char *prefix, char ***words, size_t *n)
{
    completion c = {.prefix = prefix};
    size_t kept = 0;

    for (size_t i = 0; qdot_statement_at(i) != NULL; i++)
        offer(&c, qdot_statement_at(i)->word);
    for (size_t i = 0; qdot_builtin_at(i) != NULL; i++)
        offer(&c, qdot_builtin_at(i)->name);
    for (size_t i = 0; qdot_quantity_at(i) != NULL; i++)
        offer(&c, qdot_quantity_at(i)->name);
    for (int i = 0; i < QDOT_FUNCTION_COUNT; i++)
        offer(&c, qdot_fun_name((qdot_fun_id)i));
    for (size_t i = 0; qdot_names_at(session->names, i) != NULL; i++)
        offer(&c, qdot_names_at(session->names, i)->name);
    offer_labels(&c, session->scene);
    for (size_t i = 0; i < session->runs.n; i++)
        offer(&c, session->runs.at[i].name);

    if (c.words.n > 0)
        qsort(c.words.at, c.words.n, sizeof *c.words.at, by_spelling);
    for (size_t i = 0; i < c.words.n; i++) {
        if (kept > 0 && strcmp(c.words.at[kept - 1], c.words.at[i]) == 0)
            qdot_free(c.words.at[i]);
        else
            c.words.at[kept++] = c.words.at[i];
    }
    *words = c.words.at;
    *n = kept;
    if (c.status != QDOT_OK) {
        while (kept > 0)
            qdot_free(c.words.at[--kept]);
        qdot_free(c.words.at);
        *words = NULL;
        *n = 0;
    }
    return c.status;
}

qdot_status
qdot_session_remember(qdot_session *session, qdot_expr value, qdot_expr over)
{
    QDOT_TRY(qdot_vec_push(&session->history, value));
    while (session->history_over.n < session->history.n)
        QDOT_TRY(qdot_vec_push(&session->history_over, QDOT_NIL));
    session->history_over.at[session->history.n - 1] = over;
    return QDOT_OK;
}

qdot_status
qdot_session_recall(const qdot_session *session, size_t n, qdot_expr *value, qdot_expr *over)
{
    const size_t count = session->history.n, at = n == 0 ? count : n;

    if (count == 0)
        return qdot_fail(QDOT_EINVAL, "there is no value yet for `%%`");
    if (n > count)
        return qdot_fail(QDOT_EINVAL, "there are only %zu values so far", count);
    *value = session->history.at[at - 1];
    *over = at <= session->history_over.n ? session->history_over.at[at - 1] : QDOT_NIL;
    return QDOT_OK;
}
