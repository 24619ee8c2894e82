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
    size_t number;  /* number of the present statement; 0: none yet */
    uint32_t line;  /* line where the statement begins, for JSON */
    bool under_way;
    bool told;      /* for JSON: the end of the statement must be reported */
    bool refuted;   /* an earlier check had been refuted before this statement */
    qdot_text all;  /* the text of all statements that succeeded, as typed */
} qdot_typed;

#endif
