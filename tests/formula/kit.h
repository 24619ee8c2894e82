/* kit.h -- a formula around every test, and its nodes in few letters. */
#ifndef QDOT_TESTS_FORMULA_KIT_H
#define QDOT_TESTS_FORMULA_KIT_H

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <string.h>

#include "formula/formula.h"

static qdot_formula f;

static inline int
formula_close(void **state)
{
    (void)state;
    qdot_formula_clear(&f);
    return 0;
}

#define TEST(t) cmocka_unit_test_teardown(t, formula_close)

/* The children of a parent, up to a 0. */
static inline qdot_formula_id
node(qdot_formula_kind kind, unsigned what, unsigned flags, ...)
{
    const qdot_formula_id id = qdot_formula_new(&f, kind, what, flags);
    va_list children;

    va_start(children, flags);
    for (qdot_formula_id c; (c = va_arg(children, qdot_formula_id)) != 0;)
        qdot_formula_append(&f, id, c);
    va_end(children);
    return id;
}

static inline qdot_formula_id
text(qdot_formula_role role, const char *text)
{
    return qdot_formula_add_text(&f, 0, role, text, strlen(text));
}

static inline qdot_formula_id
sign(qdot_formula_sign sign)
{
    return qdot_formula_new(&f, QDOT_FORMULA_SIGN, sign, 0);
}

static inline qdot_formula_id
counted(qdot_formula_id id, uint32_t n)
{
    qdot_formula_count(&f, id, n);
    return id;
}

#define END ((qdot_formula_id)0)
#define NAME(x) text(QDOT_TEXT_NAME, x)
#define NUMBER(x) text(QDOT_TEXT_NUMBER, x)
#define FUNCTION(x) text(QDOT_TEXT_FUNCTION, x)
#define SPAN(...) node(QDOT_FORMULA_SPAN, 0, 0, __VA_ARGS__, END)
#define ROW(...) node(QDOT_FORMULA_ROW, 0, 0, __VA_ARGS__, END)
#define OVER(a, b) node(QDOT_FORMULA_FRACTION, 0, 0, a, b, END)
#define ROOT(...) node(QDOT_FORMULA_ROOT, 0, 0, __VA_ARGS__, END)
#define POWER(a, b) node(QDOT_FORMULA_POWER, 0, 0, a, b, END)
#define INDEX(a, b) node(QDOT_FORMULA_INDEX, 0, 0, a, b, END)
#define DOTS(n, a) counted(node(QDOT_FORMULA_ACCENT, 0, 0, a, END), n)
#define PRIMES(n, a) counted(node(QDOT_FORMULA_PRIMES, 0, 0, a, END), n)
#define ROUND(...) node(QDOT_FORMULA_BRACKET, QDOT_BRACKET_ROUND, 0, __VA_ARGS__, END)
#define SQUARE(...) node(QDOT_FORMULA_BRACKET, QDOT_BRACKET_SQUARE, 0, __VA_ARGS__, END)
#define BARS(...) node(QDOT_FORMULA_BRACKET, QDOT_BRACKET_BARS, 0, __VA_ARGS__, END)
#define FIXED(...) node(QDOT_FORMULA_BRACKET, QDOT_BRACKET_ROUND, QDOT_FORMULA_FIXED, __VA_ARGS__, END)
#define TABLE(across, ...) counted(node(QDOT_FORMULA_TABLE, 0, 0, __VA_ARGS__, END), across)
#define CASES(...) node(QDOT_FORMULA_CASES, 0, 0, __VA_ARGS__, END)
#define APPLY(a, b) node(QDOT_FORMULA_APPLY, 0, 0, a, b, END)

#endif
