/* fuzz-roundtrip.c -- an expression, and its simplified form, is printed in plain and in unicode
 * style and read again: the same expression. The simplified form must not be refuted as the other's
 * equal.
 */
#include "expr/node.h"
#include "expr/print.h"
#include "expr/symbol.h"
#include "fuzz.h"
#include "lang/session/history.h"
#include "lang/session/session.h"

#include "expr/walk.h"
#include "lang/session/measured.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

enum { LARGEST = 2000 };

static const char scene[] = "param m, g, L, a > 0, b, c, k[1], w > 1\n"
                            "coord x, y, r > 0, 0 < theta < pi, q[1], phi\n"
                            "function f(x), h(x, y), n(t)\n";

static void
complain(const char *what, const char *first, const char *second)
{
    fprintf(stderr, "%s\n  %s\n  %s\n", what, first, second);
    abort();
}

static bool
interrupted(void)
{
    return fuzz_pressed != 0;
}

/* The value of a text that is one expression; nil if it is something else. */
static qdot_expr
value_of(qdot_session *session, const char *text, size_t length)
{
    size_t before = session->history->values.n;

    if (qdot_script_run_text(session, "fuzz", text, length) != 0 ||
        session->history->values.n != before + 1)
        return QDOT_NIL;
    return session->history->values.at[before];
}

static void
read_again_in(qdot_session *session, const char *what, qdot_style style, qdot_expr e)
{
    qdot_text text = {0}, other = {0};
    qdot_expr again;

    if (qdot_print(session->pool, e, style, &text) == QDOT_OK) {
        again = value_of(session, text.at, strlen(text.at));
        if (again != e && !interrupted()) {
            if (again == QDOT_NIL ||
                qdot_print(session->pool, again, QDOT_PLAIN, &other) != QDOT_OK)
                complain(what, text.at, qdot_last_error()->message);
            complain(what, text.at, other.at);
        }
    }
    qdot_text_clear(&text);
    qdot_text_clear(&other);
}

static void
read_again(qdot_session *session, const char *what, qdot_expr e)
{
    read_again_in(session, what, QDOT_PLAIN, e);
    read_again_in(session, what, QDOT_UNICODE, e);
}

static void
compare(qdot_session *session, qdot_expr e, qdot_expr simple)
{
    qdot_decision d;
    qdot_text text = {0}, other = {0};

    if (!qdot_expr_is_scalar(session->pool, e) ||
        qdot_decide_equal(session->pool, e, simple, NULL, &d) != QDOT_OK ||
        d.verdict != QDOT_REFUTED || interrupted())
        return;
    if (qdot_print(session->pool, e, QDOT_PLAIN, &text) == QDOT_OK &&
        qdot_print(session->pool, simple, QDOT_PLAIN, &other) == QDOT_OK)
        complain("simplify changes a value", text.at, other.at);
    abort();
}

/* No relation is in it: one between numbers is decided when it is read. No text, which is not read
 * back, and no number with an error, as `N(2)` is: it stands as a symbol of the session's own. */
static bool
is_plain_value(qdot_session *session, qdot_expr e)
{
    const qdot_pool *pool = session->pool;
    qdot_walk w;
    bool plain = qdot_walk_begin(pool, e, &w) == QDOT_OK && !qdot_measured_occurs(session, e);

    for (size_t i = 0; plain && i < w.n; i++)
        plain = qdot_expr_kind(pool, w.at[i]) != QDOT_REL &&
                !qdot_expr_is_class(pool, w.at[i], QDOT_WORDS) &&
                qdot_expr_kind(pool, w.at[i]) != QDOT_LOGIC;
    qdot_walk_end(&w);
    return plain && qdot_expr_size(pool, e) < LARGEST;
}

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    qdot_session *session;
    qdot_expr e, simple;

    /* one statement, no declaration */
    if (memchr(data, '\n', size) != NULL || memchr(data, ';', size) != NULL ||
        memchr(data, '=', size) != NULL || memchr(data, '%', size) != NULL)
        return -1;
    fuzz_ready();
    session = qdot_session_new(fuzz_nowhere, fuzz_nowhere);
    if (session == NULL ||
        qdot_script_run_text(session, "scene", scene, sizeof scene - 1) != 0)
        abort();
    fuzz_begin(data, size);
    e = value_of(session, (const char *)data, size);
    if (e != QDOT_NIL && is_plain_value(session, e)) {
        read_again(session, "not read back", e);
        simple = qdot_simplify(session->pool, e, NULL);
        if (qdot_pool_check(session->pool) == QDOT_OK && simple != QDOT_NIL &&
            !interrupted()) {
            read_again(session, "not read back, simplified", simple);
            compare(session, e, simple);
        }
    }
    qdot_session_free(session);
    fuzz_end();
    return 0;
}
