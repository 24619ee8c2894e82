/* foreign.c -- recognises the syntax of other systems and of beginners, and suggests the line to type. */
#include "lang/language/foreign.h"

#include <stdio.h>
#include <string.h>

#include "lang/language/foreign-words.h"
#include "lang/language/pattern.h"
#include "lang/session/units.h"

enum { LONGEST = 400 }; /* longest statement, in tokens, that is compared with the patterns */
enum { DEEPEST = 32, LONGEST_WORD = 32 }; /* of calls in a suggested line: brackets within each other, bytes of a name */
#define LETTERS "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"

typedef enum { WHOLE, BEGIN, PART } extent;

typedef struct {
    extent extent;
    bool say; /* the hint is printed as it is, without the word "write" before it */
    const char *pattern, *message, *line;
} form;

#define FORM(extent, pattern, message, line) {extent, false, pattern, message, line},
#define SAY(extent, pattern, message, hint) {extent, true, pattern, message, hint},
#define NOTE(pattern, notice)
static const form forms[] = {
#include "lang/language/foreign.def"
};
#undef FORM
#undef SAY
#undef NOTE

#define FORM(extent, pattern, message, line)
#define SAY(extent, pattern, message, hint)
#define NOTE(pattern, notice) {pattern, notice},
static const struct {
    const char *pattern, *notice;
} notes[] = {
#include "lang/language/foreign.def"
};
#undef NOTE

/* Whether what matched holds the byte `at`, or ends where it is. A single word must be the error
 * itself, as an unknown name, unless it begins the statement. */
static bool
match_contains_position(const qdot_pattern_match *m, extent extent, size_t at)
{
    if (extent == PART && m->to == m->from + 1)
        return at == m->from->start && strncmp(qdot_last_error()->message, "unknown ", 8) == 0;
    return m->to > m->from && at >= m->from->start &&
           at <= m->to[-1].start + m->to[-1].length;
}

/* Find where the pattern matches in the statement so that it contains the position of the error. */
static bool
find_matching_pattern(const qdot_cursor *c, const form *f, const qdot_token *from, const qdot_token *to,
                      qdot_pattern_match *m)
{
    if (f->extent != PART)
        return qdot_pattern_matches(c->session, f->pattern, from, to, f->extent == WHOLE,
                                    m) &&
               (f->extent == WHOLE || match_contains_position(m, f->extent, c->error_at));
    for (const qdot_token *k = from; k < to && k->start <= c->error_at; k++)
        if ((k == from || !qdot_token_is(k - 1, ".")) && qdot_pattern_matches(c->session, f->pattern, k, to, false, m) &&
            match_contains_position(m, f->extent, c->error_at))
            return true;
    return false;
}

/* Whether only a single unknown letter matched: it is often a mistyped declared letter, or a constant that an answer has, so
 * the usual hint is kept. */
static bool
is_doubtful_match(const qdot_pattern_match *m)
{
    const char *hint = qdot_last_error()->hint;

    return m->to == m->from + 1 && m->from->length == 1 &&
           (strstr(hint, "did you mean") != NULL || (strncmp(hint, "`param ", 7) == 0 && qdot_ends_in(hint, "` declares it")));
}

/* Whether the suggested line is the same as the typed one. */
static bool
is_suggestion_as_typed(const qdot_cursor *c, const qdot_pattern_match *m, const qdot_text *line)
{
    const qdot_token *last = m->to - 1;

    return line->n == last->start + last->length - m->from->start &&
           strncmp(qdot_text_str(line), c->source->text + m->from->start, line->n) == 0;
}

/* Whether the error is an unknown name that the suggested line has too, so that it would fail as well: as an operand of a form
 * with an error of its own, or anywhere in a line of the same statement. */
static bool
suggestion_has_unknown_name(const qdot_cursor *c, const form *f, const qdot_pattern_match *m, const char *line)
{
    const size_t n = strlen(m->from->text);
    bool operand = false;
    const qdot_token *t = m->from;

    if (strncmp(qdot_last_error()->message, "unknown name ", 13) != 0 || line[0] == '#')
        return false;
    while (t < m->to && t->start != c->error_at)
        t++;
    if (t == m->to || t->kind != QDOT_TOKEN_NAME || !qdot_has_word(line, t->text))
        return false;
    for (size_t i = 0; i < m->n; i++)
        operand = operand || (strchr("ne", m->held[i].kind) != NULL && t >= m->held[i].from && t < m->held[i].to);
    return f->message != NULL ? operand : t > m->from && strncmp(line, m->from->text, n) == 0 && line[n] == ' ';
}

/* Append the line with calls as other systems write them, `Sin[x]`, as ours, `sin(x)`. */
static void
add_translated_calls(const qdot_session *session, const char *line, qdot_text *out)
{
    char closers[DEEPEST], name[LONGEST_WORD];
    size_t depth = 0;

    while (*line != '\0') {
        const size_t n = strspn(line, LETTERS "0123456789_");
        const char *ours = NULL;

        if (n > 0) {
            snprintf(name, sizeof name, "%.*s", (int)n, line);
            if (n < sizeof name && (line[n] == '[' || line[n] == '(') && depth < DEEPEST && !qdot_cursor_knows(session, name))
                ours = qdot_foreign_word(name);
            qdot_text_add(out, ours != NULL ? ours : "");
            qdot_text_add_n(out, line, ours != NULL ? 0 : n);
            line += n;
            if (ours == NULL)
                continue;
            qdot_text_char(out, '(');
            closers[depth++] = ')';
            line++;
            continue;
        }
        if (strchr("([{", *line) != NULL && depth < DEEPEST) {
            closers[depth++] = *line == '(' ? ')' : *line == '[' ? ']' : '}';
            qdot_text_char(out, *line++);
        } else if (strchr(")]}", *line) != NULL && depth > 0) {
            qdot_text_char(out, closers[--depth]);
            line++;
        } else {
            qdot_text_char(out, *line++);
        }
    }
}

/* Replace the error by the message of the pattern; false if the pattern has no better line to suggest. */
static bool
report_by_pattern(qdot_cursor *c, const form *f, const qdot_pattern_match *m)
{
    const qdot_error error = *qdot_last_error();
    qdot_text message = {0}, line = {0}, written = {0};
    bool fits;

    if (f->message != NULL)
        qdot_pattern_write(c, f->message, m, &message);
    else if (strcmp(error.message, "a `*` is missing") == 0)
        qdot_text_add(&message, "this is no form of the language");
    else
        qdot_text_add(&message, error.message);
    qdot_pattern_write(c, f->line, m, &written);
    if (f->say)
        qdot_text_add(&line, qdot_text_str(&written));
    else
        add_translated_calls(c->session, qdot_text_str(&written), &line);
    line.failed = line.failed || written.failed;
    qdot_text_clear(&written);
    fits = line.n < sizeof error.hint - 8 && !line.failed && !message.failed &&
           !is_suggestion_as_typed(c, m, &line) && !suggestion_has_unknown_name(c, f, m, qdot_text_str(&line));
    if (fits) {
        (void)qdot_fail(error.status, "%s", qdot_text_str(&message));
        (void)qdot_hint("%s%s", f->say ? "" : "write ", qdot_text_str(&line));
        if (f->message != NULL || m->place != m->from)
            c->error_at = m->place->start;
    }
    qdot_text_clear(&message);
    qdot_text_clear(&line);
    return fits;
}

/* Whether a matched name is really a word of the suggested line, as `between` in `spring between a, b`. */
static bool
is_suggested_word(const form *f, const qdot_pattern_match *m)
{
    for (size_t i = 0; i < m->n && !f->say; i++) {
        const qdot_token *name = m->held[i].from;

        if (strchr("nue", m->held[i].kind) != NULL && m->held[i].to == name + 1 &&
            name->kind == QDOT_TOKEN_NAME && name->length > 1 && qdot_has_word(f->line, name->text))
            return true;
    }
    return false;
}

qdot_status
qdot_foreign_hint(qdot_cursor *c, const qdot_token *from, const qdot_token *to)
{
    const qdot_status status = qdot_last_error()->status;
    qdot_pattern_match m;

    if (status != QDOT_ESYNTAX && status != QDOT_ENAME && status != QDOT_ETYPE &&
        status != QDOT_EINVAL && status != QDOT_EUNSET)
        return status;
    if (qdot_units_take_disagreement(c->session))
        return status;
    if (to - from > LONGEST)
        to = from + LONGEST;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (find_matching_pattern(c, &forms[i], from, to, &m) && !is_doubtful_match(&m) && !is_suggested_word(&forms[i], &m) &&
            report_by_pattern(c, &forms[i], &m))
            break;
    return status;
}

const char *
qdot_foreign_notice(const qdot_cursor *c, const qdot_token *from, const qdot_token *to,
                    qdot_text *text)
{
    qdot_pattern_match m;

    for (size_t i = 0; i < sizeof notes / sizeof *notes && to - from <= LONGEST; i++)
        if (qdot_pattern_matches(c->session, notes[i].pattern, from, to, true, &m)) {
            qdot_pattern_write(c, notes[i].notice, &m, text);
            return qdot_text_str(text);
        }
    return NULL;
}
