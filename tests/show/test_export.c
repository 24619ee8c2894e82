/* test_export.c -- operations of a tape as text of every language. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/symbol.h"
#include "show/export-language.h"
#include "show/export.h"

static const qdot_export_language *const languages[] = {
#define LANGUAGE(word, title, ending, language) &qdot_export_##language,
#include "show/export-languages.def"
};

/* + - * / and what is made of them are written by export-code.c. */
static bool
is_arithmetic(int op) /* or, as what reads a table, no operation that is written */
{
    return op <= QDOT_OP_NMADD || op == QDOT_OP_SINCOS || op == QDOT_OP_LOOKUP;
}

static void
every_operation_has_a_text(void **state)
{
    (void)state;
    for (size_t l = 0; l < sizeof languages / sizeof *languages; l++)
        for (int op = 0; op < QDOT_OP_COUNT; op++)
            if ((languages[l]->operation[op] == NULL) != is_arithmetic(op))
                fail_msg("language %zu, operation %s", l, qdot_operations[op].name);
}

static qdot_expr
call(qdot_pool *pool, qdot_fun_id f, qdot_expr x)
{
    return qdot_fun(pool, f, 1, &x);
}

static qdot_tape *
tape_of(qdot_pool *pool, qdot_expr x, qdot_expr e)
{
    qdot_tape *tape;

    assert_int_equal(qdot_tape_new(pool, 1, &x, 1, &e, &tape), QDOT_OK);
    return tape;
}

/* What a function of x is in C. */
static void
is_in_c(qdot_pool *pool, qdot_expr x, qdot_expr e, const char *expected)
{
    const char *const words[] = {"x"}, *const sources[] = {NULL};
    const qdot_export_frame frame = {.language = &qdot_export_c,
                                     .words = words,
                                     .sources = sources,
                                     .indent = "",
                                     .temporary = "w"};
    qdot_export_function f = {.blocks = 1};
    qdot_text out = {0};
    qdot_tape *tape = tape_of(pool, x, e);

    f.tape = tape;
    assert_int_equal(qdot_export_code(&frame, &f, &out), QDOT_OK);
    assert_string_equal(qdot_text_str(&out), expected);
    qdot_text_clear(&out);
    qdot_tape_free(tape);
}

static void
values_used_once_stand_within_others(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr x = qdot_symbol_get(pool, QDOT_PARAM, "x"), sine = call(pool, QDOT_SIN, x);

    (void)state;
    is_in_c(pool, x, qdot_add(pool, sine, QDOT_MINUS_ONE), "return sin(x) - 1.0;\n");
    is_in_c(pool, x, qdot_mul(pool, QDOT_HALF, sine), "return sin(x)*0.5;\n");
    is_in_c(pool, x, call(pool, QDOT_EXP, qdot_pow(pool, sine, qdot_expr_int(pool, 2))),
            "const double w1 = sin(x);\nreturn exp(w1*w1);\n");
    is_in_c(pool, x, QDOT_PI, "return 3.141592653589793;\n");
    qdot_pool_free(pool);
}

static void
failing_memory_is_told(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr x = qdot_symbol_get(pool, QDOT_PARAM, "x");
    qdot_tape *tape = tape_of(pool, x, call(pool, QDOT_SIN, call(pool, QDOT_SIN, x)));
    const qdot_export_name name = {"x", 2.5};
    const qdot_export_expression e = {.file = "f",
                                      .origin = "sin(sin(x))",
                                      .k = 1,
                                      .arguments = &name,
                                      .value = {.tape = tape, .blocks = 1}};

    (void)state;
    for (int64_t n = 0;; n++) {
        qdot_text out = {0};
        qdot_status status;

        qdot_memory_fail_at(n);
        status = qdot_export_expression_write(&e, &qdot_export_python, &out);
        qdot_memory_fail_at(-1);
        qdot_text_clear(&out);
        if (status == QDOT_OK) {
            assert_true(n > 5);
            break;
        }
        assert_int_equal(status, QDOT_ENOMEM);
    }
    qdot_tape_free(tape);
    qdot_pool_free(pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_operation_has_a_text),
        cmocka_unit_test(values_used_once_stand_within_others),
        cmocka_unit_test(failing_memory_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
