/* reading.h -- what the tests of lang/'s reader share: a session with a few names, and
 * texts read in it.
 */
#ifndef TESTS_LANG_READING_H
#define TESTS_LANG_READING_H

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "lang/language/read.h"
#include "lang/session/names.h"
#include "lang/session/session.h"
#include "lang/source/source.h"
#include "lang/workbench/script.h"
#include "mech/scene/scene.h"

typedef struct {
    qdot_session *session;
    qdot_text text;    /* the last value, printed plain */
    qdot_text message; /* the last error's message */
    qdot_text hint;
    size_t at; /* its byte */
    qdot_status status;
} reading;

static inline void
declare(reading *r, qdot_name_kind kind, const char *name, qdot_expr value)
{
    qdot_name entry = {.name = (char *)name,
                       .kind = kind,
                       .value = value,
                       .file = (char *)"test.lag",
                       .line = 7};

    assert_int_equal(qdot_names_declare(r->session->names, &entry), QDOT_OK);
}

static inline void
declare_param(reading *r, const char *name)
{
    declare(r, QDOT_NAME_PARAM, name,
            qdot_symbol_get(r->session->pool, QDOT_PARAM, name));
}

static inline void
declare_coord(reading *r, const char *name)
{
    qdot_expr q = qdot_symbol_get(r->session->pool, QDOT_COORD, name);

    declare(r, QDOT_NAME_COORD, name, q);
    assert_int_equal(qdot_scene_coordinate(r->session->scene, q), QDOT_OK);
}

/* An undefined function of parameters or coordinates already declared. */
static inline void
declare_ufun(reading *r, const char *name, uint32_t n, const qdot_expr *formals)
{
    qdot_name entry = {.name = (char *)name, .kind = QDOT_NAME_UFUN};

    assert_int_equal(qdot_ufun_declare(r->session->pool, name, n, formals, &entry.ufun),
                     QDOT_OK);
    entry.value = qdot_ufun_apply(r->session->pool, entry.ufun, formals, NULL);
    assert_int_equal(qdot_names_declare(r->session->names, &entry), QDOT_OK);
}

/* params m, g, s; coordinates theta, q[1], q[2]; functions x(s), y(s, t). */
static inline void
reading_open(reading *r)
{
    qdot_expr formals[2];

    *r = (reading){.session = qdot_session_new(stdout, stderr)};
    assert_non_null(r->session);
    declare_param(r, "m");
    declare_param(r, "g");
    declare_param(r, "s");
    declare_coord(r, "theta");
    declare_coord(r, "q[1]");
    declare_coord(r, "q[2]");
    formals[0] = qdot_symbol_get(r->session->pool, QDOT_PARAM, "s");
    formals[1] = QDOT_T;
    declare_ufun(r, "x", 1, formals);
    declare_ufun(r, "y", 2, formals);
}

static inline void
reading_close(reading *r)
{
    qdot_text_clear(&r->text);
    qdot_text_clear(&r->message);
    qdot_text_clear(&r->hint);
    qdot_session_free(r->session);
}

/* Read a whole text as one value; keep what came out. */
static inline qdot_status
reading_value(reading *r, const char *text, qdot_expr *value)
{
    qdot_source *source;

    r->status = qdot_source_new("test.lag", text, strlen(text), &source, &r->at);
    if (r->status == QDOT_OK) {
        qdot_cursor c = {
            .session = r->session, .source = source, .at = source->tokens.at};

        r->status = qdot_read_value(&c, value);
        if (r->status == QDOT_OK)
            r->status = qdot_cursor_expect_end(&c);
        r->at = c.error_at;
    }
    qdot_source_free(source);
    qdot_text_truncate(&r->message, 0);
    qdot_text_truncate(&r->hint, 0);
    qdot_text_add(&r->message, r->status == QDOT_OK ? "" : qdot_last_error()->message);
    qdot_text_add(&r->hint, r->status == QDOT_OK ? "" : qdot_last_error()->hint);
    return r->status;
}

/* The value of a text, printed plain. */
static inline const char *
reading_plain(reading *r, const char *text)
{
    qdot_expr value = QDOT_NIL;

    if (reading_value(r, text, &value) != QDOT_OK)
        fail_msg("%.60s: %s (at %zu)", text, qdot_text_str(&r->message), r->at);
    qdot_text_truncate(&r->text, 0);
    assert_int_equal(qdot_print(r->session->pool, value, QDOT_PLAIN, &r->text), QDOT_OK);
    return qdot_text_str(&r->text);
}

/* Two texts of one value: the same node. */
static inline void
assert_same(reading *r, const char *a, const char *b)
{
    qdot_expr left = QDOT_NIL, right = QDOT_NIL;

    if (reading_value(r, a, &left) != QDOT_OK || reading_value(r, b, &right) != QDOT_OK)
        fail_msg("%s or %s: %s", a, b, qdot_text_str(&r->message));
    if (left != right) {
        reading_plain(r, a);
        fail_msg("%s is %s, not %s", a, qdot_text_str(&r->text), b);
    }
}

/* The text fails with this status, at this byte, with parts of message and hint. */
static inline void
assert_fails(reading *r, const char *text, qdot_status status, size_t at,
             const char *message, const char *hint)
{
    qdot_expr value;

    if (reading_value(r, text, &value) == QDOT_OK)
        fail_msg("%s: no error", text);
    if (r->status != status || r->at != at ||
        strstr(qdot_text_str(&r->message), message) == NULL ||
        strstr(qdot_text_str(&r->hint), hint) == NULL)
        fail_msg("%s: status %d at %zu: %s / %s; expected %d at %zu: %s / %s", text,
                 r->status, r->at, qdot_text_str(&r->message), qdot_text_str(&r->hint),
                 status, at, message, hint);
}

#endif
