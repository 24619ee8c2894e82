/* test_flint.c -- memory that ends and Ctrl-C inside FLINT: a status, no abort, nothing lost. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>
#include <inttypes.h>

#include <flint/fmpz_mpoly.h>
#include <flint/fmpz_vec.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/scope.h"
#include "expr/polynomial/flint.h"
#include "normal/prove/decide.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/rationalize.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/solve.h"

#include "sanitized.h"
#include "normal/text.h"

/* --- the scope -------------------------------------------------------------------------- */

static void
a_scope_gives_back_what_was_allocated(void **state)
{
    qdot_scope s;
    char *before = qdot_malloc(10), *after;
    void *blocks[5000];

    (void)state;
    assert_int_equal(qdot_scope_begin(&s), QDOT_OK);
    for (int i = 0; i < 5000; i++)
        blocks[i] = qdot_malloc(16 + i % 7);
    for (int i = 0; i < 5000; i += 3)
        qdot_free(blocks[i]);
    for (int i = 1; i < 5000; i += 3)
        blocks[i] = qdot_realloc(blocks[i], 100);
    for (int i = 1; i < 5000; i++)
        assert_int_equal(qdot_scope_has(blocks[i]), i % 3 != 0);
    before = qdot_realloc(before, 100000); /* from before: it stays outside */
    assert_false(qdot_scope_has(before));
    assert_int_equal(s.n, 5000 - 1667);
    qdot_scope_discard(&s);
    before[99999] = 1;
    qdot_free(before);

    assert_int_equal(qdot_scope_begin(&s), QDOT_OK);
    after = qdot_malloc(10);
    qdot_scope_end(&s);
    after[9] = 1; /* it stays */
    qdot_free(after);
}

/* --- guarded ---------------------------------------------------------------------------- */

static const char *const values[] = {
    "(x + y)^7*(x - y)^3 - x*(x + y)^9",
    "sin(x)^4*cos(y)^2 + sin(x)^4*sin(y)^2 + 2*sin(x)^2*cos(x)^2 + cos(x)^4",
    "(12345678901234567890*x + 98765432109876543210)^5/(x + 8)",
    "sqrt(x^2 + 2*x*y + y^2 + 1)*(a + b)/(a^2 - b^2)",
    "1/(x^3 - y^3) + 1/(x^3 + y^3)",
    "m*L^2*(cos(x)*cos(y) + sin(x)*sin(y))*x'*y' + exp(x + log(a))",
};

static const struct {
    const char *left, *right;
} sides[] = {
    {"sqrt(5 + 2*sqrt(6))", "sqrt(2) + sqrt(3)"},
    {"sin(x + y)*sin(x - y)", "sin(x)^2 - sin(y)^2"},
    {"atanh(x)", "1/2*log((1 + x)/(1 - x))"},
    {"exp(x)*exp(-y)", "exp(x - y) + 10^(-40)"},
    {"acos(x)", "pi/2 - asin(x)"},
};

/* Of x: their zeros, factors, signs, denominators without roots. */
static const char *const equations[] = {
    "a*sin(x)*cos(x) - b*sin(x)",
    "(x^2 - 3*x + 1)*(x^2 + 123456789012345678901*x - a^2)",
    "1/(sqrt(a) + sqrt(b)) + x/(sqrt(2) - 12345678901234567890)",
};

/* Run `work` on one after another, the n-th allocation failing, or Ctrl-C pressed there, until it
 * passes; between failures the same pool. The pool is usable afterwards. */
static void
at_every_allocation(void (*harm)(int64_t n), qdot_status wanted,
                    qdot_status (*work)(qdot_pool *pool, size_t i), size_t i,
                    qdot_pool *pool)
{
    qdot_status status;
    int64_t n = 0, failures = 0;

    for (;; n += 1 + n / 40) {
        harm(n);
        status = work(pool, i);
        harm(-1);
        if (!qdot_interrupt_flag && status == QDOT_OK)
            break;
        qdot_interrupt_clear();
        if (status == QDOT_OK) /* heard no more */
            continue;
        failures++;
        assert_int_equal(status, wanted);
    }
    assert_true(failures > 10);
    assert_null(qdot_scope_now);
}

static void
every_allocation_may_fail(qdot_status (*work)(qdot_pool *pool, size_t i), size_t i,
                          qdot_pool *pool)
{
    at_every_allocation(qdot_memory_fail_at, QDOT_ENOMEM, work, i, pool);
}

static qdot_status
simplify_one(qdot_pool *pool, size_t i)
{
    static qdot_expr of[sizeof values / sizeof *values];

    if (pool == NULL) /* begin anew */
        return memset(of, 0, sizeof of) == NULL;
    if (of[i] == QDOT_NIL) {
        qdot_memory_fail_at(-1);
        of[i] = text_read(pool, values[i]);
        return qdot_fail(QDOT_ENOMEM, "not yet");
    }
    (void)qdot_simplify(pool, of[i], NULL);
    return qdot_pool_check(pool);
}

static qdot_status
decide_one(qdot_pool *pool, size_t i)
{
    static qdot_expr of[sizeof sides / sizeof *sides][2];
    qdot_decision d;

    if (pool == NULL)
        return memset(of, 0, sizeof of) == NULL;
    if (of[i][0] == QDOT_NIL) {
        qdot_memory_fail_at(-1);
        of[i][0] = text_read(pool, sides[i].left);
        of[i][1] = text_read(pool, sides[i].right);
        return qdot_fail(QDOT_ENOMEM, "not yet");
    }
    return qdot_decide_equal(pool, of[i][0], of[i][1], NULL, &d);
}

enum { KINDS = 5 };

static qdot_expr unknown, equation_of[sizeof equations / sizeof *equations];

static void
read_equations(qdot_pool *pool)
{
    unknown = text_read(pool, "x");
    for (size_t i = 0; i < sizeof equations / sizeof *equations; i++)
        equation_of[i] = text_read(pool, equations[i]);
}

/* Equation i / KINDS by one of the ways. */
static qdot_status
solve_one(qdot_pool *pool, size_t i)
{
    qdot_expr e = equation_of[i / KINDS];
    qdot_solutions found;
    qdot_status status;

    switch (i % KINDS) {
    case 0:
        status = qdot_solve_inside(pool, e, unknown, QDOT_NIL, NULL, &found);
        qdot_solutions_clear(&found);
        return status;
    case 1: (void)qdot_solve_factors(pool, e); break;
    case 2: (void)qdot_solve_product(pool, e); break;
    case 3: (void)qdot_positive(pool, e, NULL, 0, NULL); break;
    default: (void)qdot_rationalize(pool, e, NULL);
    }
    return qdot_pool_check(pool);
}

static void
memory_that_ends_is_a_status(void **state)
{
    qdot_pool *pool = qdot_pool_new();

    (void)state;
    (void)simplify_one(NULL, 0);
    (void)decide_one(NULL, 0);
    read_equations(pool);
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        every_allocation_may_fail(simplify_one, i, pool);
    for (size_t i = 0; i < sizeof sides / sizeof *sides; i++)
        every_allocation_may_fail(decide_one, i, pool);
    for (size_t i = 0; i < KINDS * sizeof equations / sizeof *equations; i++)
        every_allocation_may_fail(solve_one, i, pool);
    qdot_pool_free(pool);
}

static void
ctrl_c_is_heard_at_every_allocation(void **state)
{
    qdot_pool *pool = qdot_pool_new();

    (void)state;
    read_equations(pool);
    for (size_t i = 0; i < KINDS * sizeof equations / sizeof *equations; i++)
        at_every_allocation(qdot_memory_press_at, QDOT_EINTR, solve_one, i, pool);
    qdot_pool_free(pool);
}

/* What is simplified after failures is what is simplified without. */
static void
a_pool_is_usable_after_failures(void **state)
{
    qdot_pool *pool = qdot_pool_new(), *fresh = qdot_pool_new();

    (void)state;
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        qdot_expr e = text_read(pool, values[i]);
        char *failed, *clean;

        for (int64_t n = 1; n < 3000; n = 2 * n + 1) {
            qdot_memory_fail_at(n);
            (void)qdot_simplify(pool, e, NULL);
            qdot_memory_fail_at(-1);
            (void)!qdot_pool_check(pool);
        }
        failed = text_write(pool, qdot_simplify(pool, e, NULL));
        clean =
            text_write(fresh, qdot_simplify(fresh, text_read(fresh, values[i]), NULL));
        assert_string_equal(failed, clean);
        free(failed);
        free(clean);
    }
    qdot_pool_free(pool);
    qdot_pool_free(fresh);
}

/* --- Ctrl-C within one call of FLINT ----------------------------------------------------- */

struct product {
    bool interrupted, ended;
    slong n;
    qdot_interrupt *own; /* the flag of a system that is set; NULL: that of the process */
};

/* (1 + x + y + z + w)^n (1 + x + 2 y + 3 z + 4 w)^n: many seconds in one call. */
static void
multiply(void *user)
{
    static const char *variables[] = {"x", "y", "z", "w"};
    struct product *p = user;
    fmpz_mpoly_ctx_t ctx;
    fmpz_mpoly_t a, b;

    fmpz_mpoly_ctx_init(ctx, 4, ORD_LEX);
    fmpz_mpoly_init(a, ctx);
    fmpz_mpoly_init(b, ctx);
    (void)!fmpz_mpoly_set_str_pretty(a, "1+x+y+z+w", variables, ctx);
    (void)!fmpz_mpoly_set_str_pretty(b, "1+x+2*y+3*z+4*w", variables, ctx);
    (void)!fmpz_mpoly_pow_ui(a, a, (ulong)p->n, ctx);
    (void)!fmpz_mpoly_pow_ui(b, b, (ulong)p->n, ctx);
    if (p->own != NULL)
        qdot_interrupt_ask(p->own); /* as another thread would */
    else if (p->interrupted)
        qdot_interrupt_set(); /* as a signal would, any time from now on */
    fmpz_mpoly_mul(a, a, b, ctx);
    p->ended = true;
    fmpz_mpoly_clear(a, ctx);
    fmpz_mpoly_clear(b, ctx);
    fmpz_mpoly_ctx_clear(ctx);
}

static void
ctrl_c_leaves_flint(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    struct product p = {true, false, 24, NULL};

    (void)state;
    for (int i = 0; i < 3; i++) {
        assert_int_equal(qdot_flint_run(pool, multiply, &p), QDOT_EINTR);
        qdot_interrupt_clear();
        assert_false(p.ended);
        assert_int_equal(qdot_last_error()->status, QDOT_EINTR);
    }
    p = (struct product){false, false, 3, NULL};
    assert_int_equal(qdot_flint_run(pool, multiply, &p), QDOT_OK);
    assert_true(p.ended);
    qdot_pool_free(pool);
}

/* The flag of a system is that of the thread which computes for it. */
static void
the_flag_of_a_system_leaves_flint(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_interrupt own = {0}, other = {0};
    struct product p = {true, false, 24, &own}, small = {true, false, 3, &other};

    (void)state;
    qdot_interrupt_begin(&own);
    qdot_interrupt_begin(&other);
    qdot_interrupt_own = &own;
    assert_int_equal(qdot_flint_run(pool, multiply, &p), QDOT_EINTR);
    qdot_interrupt_clear();
    assert_int_equal(qdot_interrupt_check(), QDOT_OK);
    assert_int_equal(qdot_flint_run(pool, multiply, &small), QDOT_OK); /* asks for another */
    qdot_interrupt_own = &other;
    assert_int_equal(qdot_interrupt_check(), QDOT_EINTR);
    qdot_interrupt_own = NULL;
    assert_int_equal(qdot_interrupt_check(), QDOT_OK);
    qdot_pool_free(pool);
}

/* --- what is left behind ------------------------------------------------------------------- */

enum { MANY = 20000, TIMES = 40 };

struct hoard {
    qdot_pool *pool;
    unsigned seed;
    bool leave;
    qdot_expr kept[2];
};

/* Many large integers at once, numbers of the pool among them; then it ends or is left. */
static void
hoard(void *user)
{
    struct hoard *h = user;
    fmpz *x = _fmpz_vec_init(MANY);
    fmpq_t number;

    for (slong i = 0; i < MANY; i++) {
        fmpz_set_ui(x + i, h->seed + (ulong)i);
        fmpz_pow_ui(x + i, x + i, 5 + (ulong)i % 40);
    }
    fmpq_init(number);
    fmpz_set_ui(fmpq_numref(number), h->seed);
    fmpz_pow_ui(fmpq_numref(number), fmpq_numref(number), 30);
    h->kept[0] = qdot_expr_fmpq(h->pool, number);
    fmpz_one(fmpq_denref(number));
    fmpz_mul_2exp(fmpq_denref(number), fmpq_denref(number), 900 + h->seed % 2);
    fmpq_canonicalise(number);
    h->kept[1] = qdot_expr_fmpq(h->pool, number);
    if (h->leave)
        qdot_interrupt_set();
    for (slong i = 0; i < MANY; i++)
        fmpz_mul(x + i, x + i, x + MANY - 1 - i);
    fmpq_clear(number);
    _fmpz_vec_clear(x, MANY);
}

/* Bytes of this process that are in memory. */
static double
resident(void)
{
    FILE *file = fopen("/proc/self/statm", "r");
    int64_t all, here;

    if (file == NULL || fscanf(file, "%" SCNd64 " %" SCNd64, &all, &here) != 2)
        here = -1;
    if (file != NULL)
        fclose(file);
    return (double)here * (double)sysconf(_SC_PAGESIZE);
}

/* Whether a computation ends or is left, the next finds FLINT as new: the numbers of the pool are
 * what they were, whichever thread made them. */
static void
numbers_outlive_what_made_them(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    struct hoard h = {.pool = pool};
    qdot_expr thirty = qdot_expr_int(pool, 30);

    (void)state;
    for (int i = 0; i < 12; i++) {
        h.seed += 1000003;
        h.leave = i % 4 != 3;
        assert_int_equal(qdot_flint_run(pool, hoard, &h),
                         h.leave ? QDOT_EINTR : QDOT_OK);
        qdot_interrupt_clear();
        assert_int_equal(qdot_pool_check(pool), QDOT_OK);
        assert_int_not_equal(h.kept[0], QDOT_NIL);
    }
    /* raised again, they are found */
    for (h.seed = 1000003; h.seed <= 12 * 1000003; h.seed += 1000003) {
        qdot_expr n = qdot_expr_int(pool, (int64_t)h.seed);
        size_t count = qdot_pool_count(pool);
        qdot_expr power = qdot_pow(pool, n, thirty);

        assert_int_not_equal(power, QDOT_NIL);
        assert_int_equal(qdot_pool_count(pool), count);
        assert_true(fmpz_fdiv_ui(fmpq_numref(qdot_expr_rational(pool, power)), h.seed) == 0);
    }
    qdot_pool_free(pool);
}

/* Numbers that the thread which asks holds meanwhile are as before, whether the computation ends or is left. */
static void
numbers_of_the_asking_thread_stay(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    struct hoard h = {.pool = pool, .seed = 11};
    fmpz *x = _fmpz_vec_init(MANY);
    fmpz_t wanted;

    (void)state;
    fmpz_init(wanted);
    for (int round = 0; round < 6; round++) {
        for (slong i = 0; i < MANY; i++) {
            fmpz_set_ui(x + i, 3 + (ulong)round);
            fmpz_pow_ui(x + i, x + i, 60 + (ulong)i % 50);
        }
        h.leave = round % 3 != 1;
        assert_int_equal(qdot_flint_run(pool, hoard, &h), h.leave ? QDOT_EINTR : QDOT_OK);
        qdot_interrupt_clear();
        for (slong i = 0; i < MANY; i++) {
            fmpz_set_ui(wanted, 3 + (ulong)round);
            fmpz_pow_ui(wanted, wanted, 60 + (ulong)i % 50);
            assert_true(fmpz_equal(x + i, wanted));
        }
        if (round % 2) { /* the numbers of the next round have new memory */
            _fmpz_vec_clear(x, MANY);
            x = _fmpz_vec_init(MANY);
        }
    }
    fmpz_clear(wanted);
    _fmpz_vec_clear(x, MANY);
    qdot_pool_free(pool);
}

/* What was left forty times takes no more memory than what was left once, but for a tenth. */
static void
nothing_is_left_behind(void **state)
{
    struct hoard h = {.leave = true, .seed = 7};
    double before = resident(), once, often;

    (void)state;
#ifdef SANITIZED /* it keeps what is freed for a while, and looks for leaks itself */
    before = -1;
#endif
    if (getenv("EMULATOR") && *getenv("EMULATOR")) /* whose memory it would be */
        before = -1;
    if (before < 0) /* or no /proc here */
        skip();
    h.pool = qdot_pool_new();
    for (int i = 0; i < 2; i++) {
        assert_int_equal(qdot_flint_run(h.pool, hoard, &h), QDOT_EINTR);
        qdot_interrupt_clear();
    }
    once = resident();
    for (int i = 0; i < TIMES; i++) {
        assert_int_equal(qdot_flint_run(h.pool, hoard, &h), QDOT_EINTR);
        qdot_interrupt_clear();
    }
    often = resident();
    print_message("# %d times left: %+.0f kB\n", TIMES, (often - once) / 1024);
    assert_true(often - once < 0.1 * TIMES * MANY * 20 * sizeof(ulong));
    qdot_pool_free(h.pool);
}

/* A failure that the computation recorded is that of the thread which asked. */
static void
fail_inside(void *user)
{
    (void)user;
    (void)qdot_fail(QDOT_EDOMAIN, "from inside");
    (void)qdot_hint("look there");
}

static void
do_nothing(void *user)
{
    *(int *)user = 1;
}

static void
failures_pass_over(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    int done = 0;

    (void)state;
    assert_int_equal(qdot_flint_run(pool, fail_inside, NULL), QDOT_OK);
    assert_string_equal(qdot_last_error()->message, "from inside");
    assert_string_equal(qdot_last_error()->hint, "look there");
    (void)qdot_fail(QDOT_EIO, "from before");
    assert_int_equal(qdot_flint_run(pool, do_nothing, &done), QDOT_OK);
    assert_int_equal(done, 1);
    assert_string_equal(qdot_last_error()->message, "from before");
    qdot_pool_free(pool);
}

/* --- threads that ask ---------------------------------------------------------------------- */

static void *
ask_often(void *user)
{
    qdot_pool *pool = qdot_pool_new();
    qdot_expr *answer = user;

    for (int i = 0; i < 20; i++) {
        struct hoard h = {.pool = pool, .seed = 1 + (unsigned)i};

        if (qdot_flint_run(pool, hoard, &h) != QDOT_OK)
            *answer = QDOT_ONE;
    }
    qdot_pool_free(pool);
    return NULL;
}

static void
threads_ask_at_the_same_time(void **state)
{
    pthread_t thread[3];
    qdot_expr failed[3] = {QDOT_NIL, QDOT_NIL, QDOT_NIL};

    (void)state;
    for (int i = 0; i < 3; i++)
        assert_int_equal(pthread_create(thread + i, NULL, ask_often, failed + i), 0);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(pthread_join(thread[i], NULL), 0);
        assert_int_equal(failed[i], QDOT_NIL);
    }
}

static void
say_done(void *user)
{
    *(bool *)user = true;
}

/* Numbers of a thread's own, after a computation that ends or is left. */
static void *
ask_and_compute(void *user)
{
    struct hoard h = {.pool = qdot_pool_new(), .leave = *(bool *)user, .seed = 3};
    fmpz *x = _fmpz_vec_init(MANY);

    if (qdot_flint_run(h.pool, hoard, &h) != QDOT_OK)
        qdot_interrupt_clear();
    for (slong i = 0; i < MANY; i++) {
        fmpz_set_ui(x + i, 3);
        fmpz_pow_ui(x + i, x + i, 100);
    }
    _fmpz_vec_clear(x, MANY);
    qdot_pool_free(h.pool);
    return NULL;
}

static void
one_thread(bool leave)
{
    pthread_t thread;

    assert_int_equal(pthread_create(&thread, NULL, ask_and_compute, &leave), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
}

/* What FLINT keeps of a thread ends with the thread. LeakSanitizer sees it too. */
static void
a_thread_leaves_nothing_behind(void **state)
{
    const int threads = 40;
    double once, often;

    (void)state;
    for (int i = 0; i < 4; i++)
        one_thread(i % 2 == 0);
    once = resident();
    for (int i = 0; i < threads; i++)
        one_thread(i % 2 == 0);
    often = resident();
    print_message("# %d threads: %+.0f kB\n", threads, (often - once) / 1024);
#ifndef SANITIZED /* it keeps what is freed for a while */
    if (getenv("EMULATOR") == NULL || *getenv("EMULATOR") == '\0')
        assert_true(often - once < 0.1 * threads * MANY * sizeof(__mpz_struct));
#endif
}

/* A copy of the process has none of its threads: it begins its own. */
static void
a_copy_of_the_process_asks(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    bool done = false;
    int how = 0;
    pid_t copy;

    (void)state;
    assert_int_equal(qdot_flint_run(pool, say_done, &done), QDOT_OK);
    copy = fork();
    if (copy == 0) {
        alarm(60); /* it would wait for ever */
        done = false;
        _exit(qdot_flint_run(pool, say_done, &done) == QDOT_OK && done ? 0 : 1);
    }
    assert_int_equal(waitpid(copy, &how, 0), copy);
    assert_int_equal(how, 0);
    qdot_pool_free(pool);
}

/* --- the bound ---------------------------------------------------------------------------- */

static void
take_much(void *user)
{
    void *block = flint_malloc(QDOT_FLINT_MEMORY + 64);

    *(bool *)user = true;
    flint_free(block);
}

static void
the_bound_of_memory_is_a_limit(void **state)
{
    qdot_pool *pool = qdot_pool_new();
    bool taken = false;

    (void)state;
    assert_int_equal(qdot_flint_run(pool, take_much, &taken), QDOT_ELIMIT);
    assert_false(taken);
    qdot_pool_free(pool);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scope_gives_back_what_was_allocated),
        cmocka_unit_test(memory_that_ends_is_a_status),
        cmocka_unit_test(ctrl_c_is_heard_at_every_allocation),
        cmocka_unit_test(a_pool_is_usable_after_failures),
        cmocka_unit_test(ctrl_c_leaves_flint),
        cmocka_unit_test(the_flag_of_a_system_leaves_flint),
        cmocka_unit_test(numbers_outlive_what_made_them),
        cmocka_unit_test(numbers_of_the_asking_thread_stay),
        cmocka_unit_test(nothing_is_left_behind),
        cmocka_unit_test(failures_pass_over),
        cmocka_unit_test(threads_ask_at_the_same_time),
        cmocka_unit_test(a_thread_leaves_nothing_behind),
        cmocka_unit_test(a_copy_of_the_process_asks),
        cmocka_unit_test(the_bound_of_memory_is_a_limit),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);

    flint_cleanup();
    return failed;
}
