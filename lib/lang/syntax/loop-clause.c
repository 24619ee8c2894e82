/* loop-clause.c -- reads the clause `for NAME = A..B, ...` by a usage text of its own. */
#include "lang/syntax/loop-clause.h"

#include "lang/syntax/match.h"
#include "lang/syntax/outline.h"

const qdot_statement qdot_loop_clause = {.word = "for", .usage = "for NAME = A..B, ..."};

/* Give a hint how the values of an index are written, if there is no other hint. */
static qdot_status
suggest_values(qdot_status status)
{
    return status == QDOT_ESYNTAX && qdot_last_error()->hint[0] == '\0'
               ? qdot_hint("as in for k = 1..3, or for k = [1, 2, 5]")
               : status;
}

bool
qdot_loop_clause_is_list(const qdot_filled *values)
{
    return qdot_token_is(values->from, "[");
}

qdot_status
qdot_loop_clause_need_range(qdot_record *r, const qdot_filled *values)
{
    return suggest_values(qdot_record_expected(r, values->to, "a range `a..b`"));
}

qdot_status
qdot_loop_clause_read(const qdot_cursor *c, const qdot_usage *usage, qdot_record *record)
{
    const qdot_status status = qdot_match(c, &qdot_loop_clause, usage, record);
    const qdot_filled *last = record->parts.n > 0 ? &record->parts.at[record->parts.n - 1] : NULL;

    if (status == QDOT_ESYNTAX && last != NULL && qdot_outline_file(last->to) == last->to)
        return qdot_hint("`to` stands before `for`: T to \"T.tex\" for m = [1, 2]");
    /* the failure is behind the name of an index or in its values */
    return status != QDOT_OK && last != NULL && (record->parts.n % 4 == 2 || qdot_filled_is(last, "=")) &&
                   !qdot_token_is(last->to, "[")
               ? suggest_values(status)
               : status;
}
