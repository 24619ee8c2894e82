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
    size_t texts;   /* being carried out, one within the other */
    size_t number;  /* of the statement; 0: there was none yet */
    uint32_t line;  /* where it begins, with JSON */
    bool under_way;
    bool told;      /* with JSON: say when it is done, with what status */
    bool refuted;   /* whether a check was, before it */
    qdot_text all;  /* statements that succeeded, a line each or as many as they had */
} qdot_typed;

#endif
