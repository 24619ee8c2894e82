/* analysed.h -- a text and what its analysis says, for tests. */
#ifndef TESTS_LANG_ANALYSED_H
#define TESTS_LANG_ANALYSED_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "lang/analysis/follow.h"

static inline int
begin(void **state)
{
    *state = qdot_analysis_new("/nowhere/script.lag", false, NULL);
    return *state == NULL;
}

static inline int
end(void **state)
{
    qdot_analysis_free(*state);
    return 0;
}

/* Analyse another text to its end. */
static inline void
analyse(qdot_analysis *a, const char *text)
{
    bool done;

    assert_int_equal(qdot_follow_text(a, text, strlen(text)), QDOT_OK);
    assert_int_equal(qdot_follow_on(a, &done), QDOT_OK);
    assert_true(done);
}

/* All remarks, a line each: "6-7 error: message | hint". */
static inline void
has_remarks(const qdot_analysis *a, const char *expected)
{
    static const char *const levels[] = {"", "error", "warning", "notice"};
    qdot_text text = {0};
    qdot_remark r;

    for (size_t i = 0; qdot_analysis_remark(a, i, &r); i++)
        qdot_text_format(&text, "%zu-%zu %s: %s%s%s\n", r.at.from, r.at.to, levels[r.level], r.message, r.hint[0] != '\0' ? " | " : "",
                         r.hint);
    assert_string_equal(qdot_text_str(&text), expected);
    qdot_text_clear(&text);
}

#endif
