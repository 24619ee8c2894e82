/* remark.h -- what an analysis has to say of a stretch of text.
 *
 * Tests  tests/lang/analysis/test_analysis.c
 */
#ifndef QDOT_LANG_REMARK_H
#define QDOT_LANG_REMARK_H

#include "base/memory.h"

/* The bytes from ... to - 1 of a text. */
typedef struct {
    size_t from, to;
} qdot_stretch;

typedef enum { QDOT_REMARK_ERROR = 1, QDOT_REMARK_WARNING = 2, QDOT_REMARK_NOTICE = 3 } qdot_remark_level;

typedef struct {
    qdot_stretch at;
    qdot_remark_level level;
    char *message;
    char *hint; /* "" if there is none */
    char *fix;  /* what would stand in place of `at` to mend it; NULL: that is not known */
} qdot_remark;

typedef qdot_vec(qdot_remark) qdot_remark_list;

/* Append a remark, its texts copied. QDOT_ENOMEM. */
QDOT_MUST_CHECK qdot_status qdot_remark_add(qdot_remark_list *list, qdot_stretch at, qdot_remark_level level,
                                            const char *message, const char *hint);
/* Remove the remarks from number n on; free the list with n = 0. */
void qdot_remark_truncate(qdot_remark_list *list, size_t n);
void qdot_remark_clear(qdot_remark_list *list);

/* Find out from the hint of an error whether other text in place of `at`, which begins as [text + at.from], mends it: "did you mean
 * `x`?" and the like. */
QDOT_MUST_CHECK qdot_status qdot_remark_find_fix(qdot_remark *remark, const char *text);

#endif
