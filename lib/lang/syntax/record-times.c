/* record-times.c -- finds the times at which a statement reads a run. */
#include "lang/syntax/record-times.h"

#include <math.h>

#include "lang/session/bind.h"

/* If the last argument of the call that the code makes, a time or the end of a range A..B, is farther from `start` than *t
 * it replaces *latest and *t. */
static void
record_time(const qdot_record *r, const qdot_compiled *program, uint32_t code, double start, qdot_expr *latest,
            double *t)
{
    qdot_cursor look = r->cursor;
    qdot_expr e = QDOT_NIL;
    double x;

    if (qdot_evaluate_part(&look, &program->code, program->code.list.at[code].last, code, &e) == QDOT_OK &&
        qdot_session_number(look.session, e, &x, NULL) == QDOT_OK && fabs(x - start) > fabs(*t - start)) {
        *t = x;
        *latest = e;
    }
}

qdot_expr
qdot_record_farthest_time(const qdot_record *r, const qdot_token *at, qdot_expr start)
{
    qdot_expr latest = QDOT_NIL;
    double from = 0, t;

    if (qdot_session_number(r->cursor.session, start, &from, NULL) != QDOT_OK)
        from = 0; /* ignore the failure here: whoever makes the run will report it */
    t = from;
    for (size_t i = 0; i < r->compiled.n; i++) {
        const qdot_compiled *program = &r->compiled.at[i];

        for (uint32_t k = 0; program->from >= at && k < program->code.list.n; k++) {
            const qdot_postfix *code = &program->code.list.at[k];

            if (code->last > 0 && qdot_postfix_reads_way(code))
                record_time(r, program, k, from, &latest, &t);
        }
    }
    return latest;
}
