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
    const qdot_token *from, *to; /* the tokens from ... to - 1 are those of the expression */
    bool is_period;              /* for a condition: the expression is the time T of `returns after T` */
    qdot_postfix_list code;
} qdot_compiled;

/* Parse an expression at the cursor, and step over it; the caller frees the program in any case. */
QDOT_MUST_CHECK qdot_status qdot_compiled_parse(qdot_cursor *c, qdot_parse_extent extent,
                                               qdot_compiled *program);
void qdot_compiled_free(qdot_compiled *program);

/* The next name in the program from code *k on, and step over it; NULL: there is none further. k begins at 0. */
const char *qdot_compiled_next_name(const qdot_compiled *program, uint32_t *k);
/* Whether the whole program is a list [a, b, ...], or a matrix. */
bool qdot_compiled_is_list(const qdot_compiled *program);
/* If the whole program is NAME[K] with a number K: the name, and *k = K; else NULL. */
const char *qdot_compiled_member_of(const qdot_compiled *program, int64_t *k);
/* Whether this instruction calls value, max, min, mean or drift, which read a run at intermediate times. */
bool qdot_postfix_reads_way(const qdot_postfix *code);
/* Whether any instruction of the program reads a run at intermediate times. */
bool qdot_compiled_reads_way(const qdot_compiled *program);

/* Evaluate a parsed expression in the way of the function of the same name in read.h. */
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
                                                 int64_t *value);

#endif
