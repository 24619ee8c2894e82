/* undo.c -- the statements `undo` and `redo`. */
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/commands/statement.h"
#include "lang/language/read.h"
#include "lang/session/undo.h"

static qdot_status
undo_refuse(const qdot_cursor *c, const char *word, size_t n, long wanted)
{
    if (n > 0)
        (void)qdot_fail(QDOT_EINVAL, "%zu statement%s can be %s, not %ld", n,
                        n == 1 ? "" : "s", word, wanted);
    else
        (void)qdot_fail(QDOT_EINVAL, "there is nothing to be %s", word);
    if (qdot_undo_is_at_floor(c->session))
        return qdot_hint("within an included script `undo` goes back to its beginning");
    return qdot_hint(strcmp(word, "undone") == 0
                         ? "a statement that only asks changes nothing; what takes more than "
                           "256 MB is not kept"
                         : "`redo` does again what `undo` took back, until another statement "
                           "changes the session");
}

/* `undo`, `undo N`, `redo`, `redo N` behind the word. */
static qdot_status
undo_step(qdot_cursor *c, const char *name, const char *word, bool again)
{
    qdot_session *s = c->session;
    const qdot_token *start = c->at > c->source->tokens.at ? c->at - 1 : c->at;
    const size_t n = qdot_undo_statements(s, again);
    long wanted = 1;

    if (!qdot_cursor_is_end(c)) {
        start = c->at;
        QDOT_TRY(qdot_read_integer(c, &wanted));
    }
    QDOT_TRY(qdot_cursor_expect_end(c));
    c->error_at = start->start;
    if (s->loops > 0)
        return qdot_fail(QDOT_EINVAL, "`%s` has no place inside a loop", name);
    if (wanted < 1 || (size_t)wanted > n)
        return wanted < 1 ? qdot_fail(QDOT_EINVAL, "how many statements? 1, 2, ...")
                          : undo_refuse(c, word, n, wanted);
    for (; wanted > 0; wanted--) {
        qdot_text line = {0};
        const char *text;
        qdot_status status;

        QDOT_TRY(qdot_undo_step(s, again, &text));
        qdot_text_format(&line, "%s: %s", word, text);
        status = qdot_answer_written(s, name, QDOT_OK, &line);
        QDOT_TRY(status);
    }
    return QDOT_OK;
}

qdot_status
qdot_undo_back(qdot_cursor *c)
{
    return undo_step(c, "undo", "undone", false);
}

qdot_status
qdot_undo_again(qdot_cursor *c)
{
    return undo_step(c, "redo", "done again", true);
}
