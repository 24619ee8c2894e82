/* undo.c -- records what statements change, so that it can be undone. */
#include "lang/session/undo.h"

#include <stdint.h>
#include <string.h>

#include "expr/symbol.h"
#include "lang/session/history.h"
#include "lang/session/output.h"
#include "lang/session/runs.h"
#include "lang/session/session.h"
#include "lang/session/undo-state.h"
#include "lang/session/units.h"
#include "lang/session/values.h"

enum { TEXT_LIMIT = 160 };
static const size_t most_bytes = (size_t)256 << 20; /* largest memory for all records, in bytes */

/* A change of one part of the state: its items [at, at + n[0]) became [at, at + n[1]). */
typedef struct {
    int part;
    size_t at, n[2];
    unsigned char *items[2];
} change;

/* The changes made by one statement; in pairs, [0] is the state before it and [1] the state after it. */
typedef struct {
    char *text;
    bool joined; /* this record is undone together with the one before it */
    uint64_t version[2]; /* version of the scene before and after */
    qdot_vec(change) changes;
    qdot_undo_single single[2];
    size_t history[2];   /* numbers of answers in the history before and after the statement */
    size_t bytes;        /* approximate memory of what is kept for this record only */
    qdot_session *other; /* for `reset`: the session that was exchanged with the present one */
    qdot_undo_state *there;        /* for `reset`: the qdot_undo_state of that session */
} record;

typedef qdot_vec(record) records;

struct qdot_undo {
    qdot_undo_state now; /* state after the latest statement */
    bool known;          /* whether `now` is up to date */
    records done, undone;
    size_t floor;     /* number of records made before the text that is being read, which that text cannot undo */
    bool moved;       /* the present statement is `undo` or `redo` */
    size_t under_way; /* number of nested statements in progress */
    size_t bytes;     /* total size of the records in `done` */
    uint64_t version; /* version of the scene after the previous statement */
};

/* Whether a part of the state belongs to the history of answers, which every answer changes. */
static bool
is_answers(int k)
{
    return k == QDOT_UNDO_HISTORY || k == QDOT_UNDO_HISTORY_OVER;
}

static bool
have_equal_singles(const qdot_undo_single *a, const qdot_undo_single *b)
{
    return a->lagrangian == b->lagrangian && a->hamiltonian == b->hamiltonian && a->higher_lagrangian == b->higher_lagrangian && a->style == b->style &&
           a->flat == b->flat &&
           a->timing == b->timing && a->start_exactly == b->start_exactly;
}

/* --- records of changes --------------------------------------------------------------- */

static void
clear_record(record *r)
{
    qdot_free(r->text);
    for (size_t i = 0; i < r->changes.n; i++)
        for (int side = 0; side < 2; side++) {
            const change *c = &r->changes.at[i];

            qdot_undo_count(c->part, c->items[side], c->n[side], false);
            qdot_free(c->items[side]);
        }
    qdot_free(r->changes.at);
    if (r->there != NULL)
        qdot_undo_clear(r->there);
    qdot_free(r->there);
    qdot_session_free(r->other);
}

static void
clear_records(records *list)
{
    while (list->n > 0)
        clear_record(&list->at[--list->n]);
}

/* Forget all records, so that nothing can be undone. */
static void
forget_all_records(qdot_undo *u)
{
    clear_records(&u->done);
    clear_records(&u->undone);
    u->bytes = 0;
    qdot_undo_clear(&u->now);
    u->known = false;
    u->floor = 0;
}

static void
free_undo(qdot_undo *u)
{
    if (u == NULL)
        return;
    forget_all_records(u);
    qdot_free(u->done.at);
    qdot_free(u->undone.at);
    qdot_free(u);
}

/* --- finding what a statement changed ------------------------------------------------- */

/* List the names of the session as an array. */
static qdot_status
list_names(qdot_session *s)
{
    qdot_undo *u = s->undo;
    const qdot_name *name;
    size_t settled = qdot_names_settled(s->names);

    if (settled > u->now.names.n || !u->known)
        settled = 0;
    u->now.names.n = settled;
    while ((name = qdot_names_at(s->names, u->now.names.n)) != NULL)
        QDOT_TRY(qdot_vec_push(&u->now.names, name));
    return QDOT_OK;
}

/* Compare one part of the session's state with its copy: store the difference in r and update the copy. */
static qdot_status
compare_part(qdot_session *s, int k, record *r)
{
    qdot_scene_part live = qdot_undo_part(s, &s->undo->now, k);
    qdot_undo_array *kept = &s->undo->now.part[k];
    const unsigned char *new = qdot_undo_items(&live), *old = kept->at;
    const size_t size = live.size, least = *live.n < kept->n ? *live.n : kept->n;
    size_t before = k == QDOT_UNDO_NAMES ? qdot_names_settled(s->names) : 0, behind = 0;
    change c = {.part = k};
    qdot_scene_part room = {&kept->at, &kept->n, &kept->capacity, size};
    qdot_status status;

    if (before > least)
        before = 0;
    while (before < least && memcmp(old + before * size, new + before * size, size) == 0)
        before++;
    if (before == *live.n && before == kept->n)
        return QDOT_OK;
    while (!is_answers(k) && behind < least - before &&
           memcmp(old + (kept->n - behind - 1) * size, new + (*live.n - behind - 1) * size,
                  size) == 0)
        behind++;
    c.at = before;
    c.n[0] = kept->n - before - behind;
    c.n[1] = *live.n - before - behind;
    QDOT_TRY(qdot_undo_make_room(&room, *live.n));
    QDOT_TRY(qdot_undo_copy(k, kept->at + before * size, c.n[0], size, &c.items[0]));
    status = qdot_undo_copy(k, new + before * size, c.n[1], size, &c.items[1]);
    if (status == QDOT_OK)
        status = qdot_vec_push(&r->changes, c);
    if (status != QDOT_OK) {
        for (int side = 0; side < 2; side++) {
            qdot_undo_count(k, c.items[side], c.items[side] != NULL ? c.n[side] : 0, false);
            qdot_free(c.items[side]);
        }
        return status;
    }
    qdot_undo_splice_kept(&s->undo->now, k, size, c.at, c.n[0], c.items[1], c.n[1]);
    return QDOT_OK;
}

/* Bring the copy of the session's state up to date; r: the difference from before. */
static qdot_status
update_copy_of_state(qdot_session *s, record *r)
{
    qdot_undo_state *now = &s->undo->now;

    QDOT_TRY(list_names(s));
    r->history[0] = now->part[QDOT_UNDO_HISTORY].n;
    r->single[0] = now->single;
    for (int k = 0; k < QDOT_UNDO_PARTS; k++)
        QDOT_TRY(compare_part(s, k, r));
    qdot_names_settle(s->names);
    r->history[1] = now->part[QDOT_UNDO_HISTORY].n;
    r->single[1] = now->single = qdot_undo_single_of(s);
    return QDOT_OK;
}

/* Whether a record contains no change but new answers in the history. */
static bool
has_only_answers(const record *r)
{
    for (size_t i = 0; i < r->changes.n; i++)
        if (!is_answers(r->changes.at[i].part))
            return false;
    return r->other == NULL && have_equal_singles(&r->single[0], &r->single[1]);
}

/* --- while statements run ------------------------------------------------------------- */

size_t
qdot_undo_text_begin(qdot_session *s)
{
    const size_t outer = s->undo != NULL ? s->undo->floor : 0;

    if (s->undo != NULL && s->undo->under_way > 0)
        s->undo->floor = s->undo->done.n;
    return outer;
}

void
qdot_undo_text_end(qdot_session *s, size_t outer)
{
    if (s->undo != NULL)
        s->undo->floor = outer < s->undo->done.n ? outer : s->undo->done.n;
}

/* Forget all records; the error of the present statement is kept as the last error. */
static void
forget_records_after_error(qdot_session *s, const qdot_error *error)
{
    forget_all_records(s->undo);
    (void)qdot_fail_again(error);
}

size_t
qdot_undo_begin(qdot_session *s)
{
    const qdot_error error = *qdot_last_error();
    record r = {0};

    if (s->undo == NULL)
        s->undo = qdot_calloc(1, sizeof *s->undo);
    s->undo_free = free_undo;
    if (s->undo == NULL) {
        (void)qdot_fail_again(&error);
        return 0;
    }
    s->undo->under_way++;
    s->undo->moved = false;
    s->undo->version = s->scene->version;
    if (s->undo->known) {
        /* a style set from outside does not count as a change by the statement */
        s->undo->now.single = qdot_undo_single_of(s);
    } else if (update_copy_of_state(s, &r) == QDOT_OK) {
        s->undo->known = true;
    } else {
        forget_records_after_error(s, &error);
    }
    clear_record(&r);
    return s->undo->done.n;
}

/* A statement's source text in one line, with `;` between the lines of a block. */
static char *
text_in_one_line(const char *text, size_t length)
{
    qdot_text line = {0};
    int open = 0; /* number of open brackets within a line */
    char *copy;

    for (size_t i = 0; i < length; i++) {
        bool blank = strchr(" \t\r\n", text[i]) != NULL;

        open += (text[i] == '(' || text[i] == '[') - (text[i] == ')' || text[i] == ']');
        if (text[i] == '\n' && open == 0 && line.n > 0 &&
            strchr("{;\\ ", line.at[line.n - 1]) == NULL)
            qdot_text_char(&line, ';');

        if (line.n >= TEXT_LIMIT && ((unsigned char)text[i] & 0xc0) != 0x80) {
            qdot_text_add(&line, " ...");
            break;
        }
        if (!blank)
            qdot_text_char(&line, text[i]);
        else if (line.n > 0 && line.at[line.n - 1] != ' ')
            qdot_text_char(&line, ' ');
    }
    copy = qdot_text_status(&line) == QDOT_OK ? qdot_strdup(qdot_text_str(&line)) : NULL;
    qdot_text_clear(&line);
    return copy;
}

/* Join the records made since index `begun` to one step of undo, described by `text`. */
static qdot_status
join_records(qdot_undo *u, size_t begun, const char *text, size_t length)
{
    char *line;

    if (u->done.n <= begun)
        return QDOT_OK;
    line = text_in_one_line(text, length);
    if (line == NULL)
        return QDOT_ENOMEM;
    qdot_free(u->done.at[begun].text);
    u->done.at[begun].text = line;
    for (size_t i = begun + 1; i < u->done.n; i++)
        u->done.at[i].joined = true;
    return QDOT_OK;
}

static size_t
memory_of_runs(const unsigned char *at, size_t n)
{
    size_t bytes = 0;

    for (size_t i = 0; i < n; i++) {
        qdot_named_run run;

        memcpy(&run, at + i * sizeof run, sizeof run);
        bytes += qdot_run_bytes(run.run);
    }
    return bytes;
}

static size_t
bytes_of_record(qdot_session *s, const record *r)
{
    size_t bytes = sizeof *r + TEXT_LIMIT;

    if (r->other != NULL)
        bytes += qdot_pool_bytes(r->other->pool) +
                 memory_of_runs(r->there->part[QDOT_UNDO_RUNS].at, r->there->part[QDOT_UNDO_RUNS].n);
    for (size_t i = 0; i < r->changes.n; i++) {
        const change *c = &r->changes.at[i];

        bytes += sizeof *c + (c->n[0] + c->n[1]) * qdot_undo_part(s, &s->undo->now, c->part).size;
        if (c->part == QDOT_UNDO_RUNS)
            bytes += memory_of_runs(c->items[0], c->n[0]);
    }
    return bytes;
}

static qdot_status
push_record(qdot_session *s, record *r)
{
    qdot_undo *u = s->undo;

    r->bytes = bytes_of_record(s, r);
    QDOT_TRY(qdot_vec_push(&u->done, *r));
    u->bytes += r->bytes;
    *r = (record){0};
    clear_records(&u->undone);
    return QDOT_OK;
}

/* Drop the oldest records until the rest fits into most_bytes. */
static void
drop_oldest_records(qdot_undo *u)
{
    size_t gone = 0;

    while (u->bytes > most_bytes || (gone > 0 && gone < u->done.n && u->done.at[gone].joined)) {
        u->bytes -= u->done.at[gone].bytes;
        clear_record(&u->done.at[gone++]);
    }
    if (gone == 0)
        return;
    u->done.n -= gone;
    memmove(u->done.at, u->done.at + gone, u->done.n * sizeof *u->done.at);
}

void
qdot_undo_end(qdot_session *s, size_t begun, const char *text, size_t length)
{
    const qdot_error error = *qdot_last_error();
    qdot_undo *u = s->undo;
    qdot_status status = QDOT_OK;
    record r = {0};

    if (u == NULL)
        return;
    u->under_way--;
    if (!u->known)
        return;
    r.version[0] = u->version;
    r.version[1] = s->scene->version;
    status = update_copy_of_state(s, &r);
    /* the scene's version changes if the same thing is declared again, but no array does */
    if (status == QDOT_OK &&
        (!has_only_answers(&r) || (!u->moved && r.version[0] != r.version[1])))
        status = push_record(s, &r);
    u->version = s->scene->version;
    if (status == QDOT_OK && !u->moved)
        status = join_records(u, begun, text, length);
    u->moved = false;
    clear_record(&r);
    if (status != QDOT_OK)
        forget_records_after_error(s, &error);
    else if (u->under_way == 0)
        drop_oldest_records(u);
}

void
qdot_undo_reset(qdot_session *s, qdot_session *other)
{
    const qdot_error error = *qdot_last_error();
    qdot_undo *u = s->undo;
    record r = {.other = other}, rest = {0};
    qdot_status status = QDOT_ENOMEM;

    if (u != NULL && u->known)
        r.there = qdot_malloc(sizeof *r.there);
    if (r.there != NULL) {
        *r.there = u->now;
        u->now = (qdot_undo_state){0};
        u->known = false;
        r.single[0] = r.there->single;
        status = update_copy_of_state(s, &rest);
        r.single[1] = u->now.single;
    }
    if (status == QDOT_OK) {
        u->known = true;
        u->version = s->scene->version;
        status = push_record(s, &r);
    }
    clear_record(&rest);
    clear_record(&r);
    if (status != QDOT_OK && u != NULL)
        forget_records_after_error(s, &error);
}

/* --- undo and redo -------------------------------------------------------------------- */

/* Hide the symbols of names that are removed, and show those of names that return. */
static void
hide_or_show_symbols(qdot_session *s, const change *c, int to)
{
    for (int step = 0; step < 2; step++) {
        int side = step == 0 ? !to : to;

        for (size_t i = 0; i < c->n[side]; i++) {
            const qdot_name *name;

            memcpy(&name, c->items[side] + i * sizeof name, sizeof name);
            if (name->kind == QDOT_NAME_UFUN && step == 1)
                (void)!qdot_ufun_redeclare(s->pool, name->ufun, name->formals);
            if (name->kind != QDOT_NAME_PARAM && name->kind != QDOT_NAME_COORD && name->kind != QDOT_NAME_SPEED)
                continue;
            if (step == 0)
                qdot_symbol_hide(s->pool, name->value);
            else
                qdot_symbol_show(s->pool, name->value);
        }
    }
}

/* Remove all answers after the first n from the history. */
static void
truncate_history(qdot_session *s, size_t n)
{
    qdot_undo_array *kept = s->undo->now.part;

    if (s->history->values.n > n)
        s->history->values.n = n;
    if (s->history->over.n > n)
        s->history->over.n = n;
    for (int k = QDOT_UNDO_HISTORY; k <= QDOT_UNDO_HISTORY_OVER; k++)
        if (kept[k].n > n)
            kept[k].n = n;
}

/* Exchange the session with the one before, or after, a `reset`. */
static void
exchange_sessions(qdot_session *s, record *r)
{
    const qdot_undo_state here = s->undo->now;

    qdot_session_exchange(s, r->other);
    s->undo->now = *r->there;
    *r->there = here;
    s->undo->now.single = qdot_undo_single_of(s);
}

/* Allocate memory, in the session and in the copy, for the items that the record will insert. */
static qdot_status
allocate_for_record(qdot_session *s, const record *r, int to)
{
    for (size_t i = 0; i < r->changes.n; i++) {
        const change *c = &r->changes.at[i];
        qdot_scene_part live = qdot_undo_part(s, &s->undo->now, c->part);
        qdot_undo_array *kept = &s->undo->now.part[c->part];
        qdot_scene_part copy = {&kept->at, &kept->n, &kept->capacity, live.size};

        QDOT_TRY(qdot_undo_make_room(&live, *live.n + c->n[to]));
        QDOT_TRY(qdot_undo_make_room(&copy, kept->n + c->n[to]));
    }
    return QDOT_OK;
}

/* Bring the session to the state before the statement of the record (to = 0), or after it (to = 1). */
static qdot_status
apply_record(qdot_session *s, record *r, int to)
{
    qdot_undo *u = s->undo;

    if (r->other != NULL) {
        exchange_sessions(s, r);
        return QDOT_OK;
    }
    QDOT_TRY(allocate_for_record(s, r, to));
    truncate_history(s, r->history[!to]);
    for (size_t i = 0; i < r->changes.n; i++) {
        const change *c = &r->changes.at[i];
        const qdot_scene_part live = qdot_undo_part(s, &s->undo->now, c->part);

        if (c->part == QDOT_UNDO_RUNS || c->part == QDOT_UNDO_TABLES) {
            qdot_undo_count(c->part, c->items[to], c->n[to], true);
            qdot_undo_count(c->part, c->items[!to], c->n[!to], false);
        }
        qdot_undo_splice(&live, c->at, c->n[!to], c->items[to], c->n[to]);
        qdot_undo_splice_kept(&u->now, c->part, live.size, c->at, c->n[!to], c->items[to], c->n[to]);
        if (c->part == QDOT_UNDO_NAMES) {
            hide_or_show_symbols(s, c, to);
            qdot_names_restore(s->names, u->now.names.n, u->now.names.at);
        }
    }
    qdot_units_back_to(s, s->units->facts.n);
    u->now.single = r->single[to];
    s->scene->lagrangian = u->now.single.lagrangian;
    s->scene->higher_lagrangian = u->now.single.higher_lagrangian;
    s->scene->hamiltonian = u->now.single.hamiltonian;
    s->history->series = u->now.single.series;
    s->history->series_in = u->now.single.series_in;
    s->history->steady_in = u->now.single.steady_in;
    s->history->modes_at = u->now.single.modes_at;
    s->history->modes_version = u->now.single.modes_version;
    s->history->linear = u->now.single.linear;
    s->output->style = u->now.single.style;
    s->output->flat = u->now.single.flat;
    s->output->timing = u->now.single.timing;
    s->values->start_exactly = u->now.single.start_exactly;
    s->scene->version = r->version[to];
    return QDOT_OK;
}

/* Undo or redo the latest record of the list `from` and move it to the list `into`. */
static qdot_status
apply_and_move(qdot_session *s, records *from, records *into, int to)
{
    QDOT_TRY(qdot_grow(&into->at, &into->capacity, into->n + 1, sizeof *into->at));
    QDOT_TRY(apply_record(s, &from->at[from->n - 1], to));
    s->undo->bytes += to == 0 ? -from->at[from->n - 1].bytes : from->at[from->n - 1].bytes;
    into->at[into->n++] = from->at[--from->n];
    return QDOT_OK;
}

/* --- counting and taking back statements ---------------------------------------------- */

size_t
qdot_undo_statements(const qdot_session *s, bool again)
{
    const qdot_undo *u = s->undo;
    const records *from = u == NULL ? NULL : again ? &u->undone : &u->done;
    const size_t least = u != NULL && !again ? u->floor : 0;
    size_t n = 0;

    for (size_t i = from != NULL ? from->n : 0; i > least; i--)
        n += !from->at[i - 1].joined;
    return n;
}

bool
qdot_undo_is_at_floor(const qdot_session *s)
{
    return s->undo != NULL && s->undo->floor > 0 && s->undo->floor == s->undo->done.n;
}

qdot_status
qdot_undo_step(qdot_session *s, bool again, const char **text)
{
    qdot_undo *u = s->undo;
    records *from = again ? &u->undone : &u->done, *into = again ? &u->done : &u->undone;
    qdot_status status = QDOT_OK;
    bool more = true;

    u->moved = true;
    *text = NULL;
    while (more && status == QDOT_OK) {
        const record *r = &from->at[from->n - 1];

        *text = r->joined ? *text : r->text;
        more = again ? from->n > 1 && from->at[from->n - 2].joined : r->joined;
        status = apply_and_move(s, from, into, again);
    }
    return status;
}
