/* typed.h -- which statement of what was typed is under way, and all that succeeded.
 *
 * Statements are counted over the session, from 1: those of scripts, options -e, the prompt. What a statement includes,
 * repeats or has in a block counts as that statement.
 *
 * Tests  tests/src/test_options.c, tests/script/files/history.sh
 */
#ifndef QDOT_LANG_TYPED_H
#define QDOT_LANG_TYPED_H

#include <stdint.h>

#include "base/text.h"
#include "lang/session/parts.h"

typedef struct qdot_typed {
    size_t texts;   /* number of nested texts being carried out */
    size_t number;  /* number of the present statement; 0: there was none yet */
    uint32_t line;  /* the line where the statement begins, for JSON */
    bool under_way;
    bool told;      /* for JSON: report the end of the statement with its status */
    bool refuted;   /* whether a check had been refuted before the statement */
    qdot_text all;  /* statements that succeeded, a line each or as many as they had */
} qdot_typed;

#endif
