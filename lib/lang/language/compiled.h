/* compiled.h -- an expression as it was parsed: kept, and evaluated as often as it is needed.
 *
 * It is postfix code over the tokens of its source, which must stay. What a name means is
 * looked up each time it is evaluated, so one serves every pass of a loop. The readers of
 * read.h parse and evaluate at once.
 *
 * c->error_at is the begin of the expression afterwards, or the place of the failure.
 */
#ifndef QDOT_LANG_COMPILED_H
#define QDOT_LANG_COMPILED_H

#include "lang/language/evaluator.h"
#include "lang/source/token.h"

typedef struct {
    const qdot_token *from, *to; /* its tokens [from, to) */
    qdot_postfix_list code;
} qdot_compiled;

/* Parse at the cursor and step over the expression; free the program in any case. */
QDOT_MUST_CHECK qdot_status qdot_compiled_parse(qdot_cursor *c, qdot_parse_extent extent,
                                               qdot_compiled *program);
void qdot_compiled_free(qdot_compiled *program);

/* Evaluate a parsed expression, as the readers of the same names in read.h do. */
QDOT_MUST_CHECK qdot_status qdot_compiled_value(qdot_cursor *c, const qdot_compiled *program,
                                               qdot_expr *value);
QDOT_MUST_CHECK qdot_status qdot_compiled_named(qdot_cursor *c, const qdot_compiled *program,
                                               qdot_expr *value, qdot_expr *over);
QDOT_MUST_CHECK qdot_status qdot_compiled_motion(qdot_cursor *c, const qdot_compiled *program,
                                                qdot_expr *value);
QDOT_MUST_CHECK qdot_status qdot_compiled_member(qdot_cursor *c, const qdot_compiled *program,
                                                qdot_expr *value, const char **run);
QDOT_MUST_CHECK qdot_status qdot_compiled_scalar(qdot_cursor *c, const qdot_compiled *program,
                                                qdot_expr *value);
QDOT_MUST_CHECK qdot_status qdot_compiled_point(qdot_cursor *c, const qdot_compiled *program,
                                               qdot_expr *value);
QDOT_MUST_CHECK qdot_status qdot_compiled_number(qdot_cursor *c, const qdot_compiled *program,
                                                double *value);
QDOT_MUST_CHECK qdot_status qdot_compiled_integer(qdot_cursor *c, const qdot_compiled *program,
                                                 long *value);

#endif
