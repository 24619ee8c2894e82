/* undo.c -- the statements `undo` and `redo`, which take statements back or repeat them. */
#include <inttypes.h>
#include <string.h>

#include "lang/answer/answer.h"
#include "lang/session/evaluation.h"
#include "lang/session/undo.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_undo(qdot_record *r);
static qdot_status carry_out_redo(qdot_record *r);

QDOT_STATEMENT(undo) = {
    .word = "undo",
    .group = QDOT_WORKBENCH,
    .usage = "undo [N]",
    .summary = "take back the last statement that changed the session, or the last N: declarations, "
               "definitions, values, runs, resets; a whole `for`, block or `include` is one",
    .example = "undo",
    .handler = carry_out_undo,
};

QDOT_STATEMENT(redo) = {
    .word = "redo",
    .group = QDOT_WORKBENCH,
    .usage = "redo [N]",
    .summary = "do again what `undo` took back, until another statement changes the session",
    .example = "redo",
    .handler = carry_out_redo,
};

static qdot_status
report_nothing_to_undo(const qdot_session *session, const char *word, size_t n, int64_t wanted)
{
    if (n > 0)
        (void)qdot_fail(QDOT_EINVAL, "%zu statement%s can be %s, not %" PRId64, n,
                        n == 1 ? "" : "s", word, wanted);
    else
        (void)qdot_fail(QDOT_EINVAL, "there is nothing to be %s", word);
    if (qdot_undo_is_at_floor(session))
        return qdot_hint("within an included script `undo` goes back to its beginning");
    return qdot_hint(strcmp(word, "undone") == 0
                         ? "a statement that only asks changes nothing; what takes more than "
                           "256 MB is not kept"
                         : "`redo` does again what `undo` took back, until another statement "
                           "changes the session");
}

/* Carry out `undo`, `undo N`, `redo` or `redo N`. */
static qdot_status
undo_or_redo(qdot_record *r, const char *name, const char *word, bool again)
{
    qdot_session *s = r->cursor.session;
    const qdot_filled *number = qdot_record_hole(r, NULL, "N");
    const size_t n = qdot_undo_statements(s, again);
    int64_t wanted = 1;

    if (number != NULL)
        QDOT_TRY(qdot_record_integer(r, number, &wanted));
    r->cursor.error_at = (number != NULL ? number->from : &r->start[-1])->start;
    if (s->evaluation->loops > 0)
        return qdot_fail(QDOT_EINVAL, "`%s` has no place inside a loop", name);
    if (wanted < 1 || (size_t)wanted > n)
        return wanted < 1 ? qdot_fail(QDOT_EINVAL, "how many statements? 1, 2, ...")
                          : report_nothing_to_undo(s, word, n, wanted);
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

static qdot_status
carry_out_undo(qdot_record *r)
{
    return undo_or_redo(r, "undo", "undone", false);
}

static qdot_status
carry_out_redo(qdot_record *r)
{
    return undo_or_redo(r, "redo", "done again", true);
}
