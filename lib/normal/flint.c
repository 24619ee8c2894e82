/* flint.c -- the one file that knows how FLINT and GMP allocate, and the only longjmp. */
#include "normal/flint.h"

#include <setjmp.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <flint/flint.h>
#include <flint/fmpz.h>
#include <gmp.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/scope.h"

/* FLINT makes integers a block at a time: one allocation of BLOCK_PAGES pages and one to align,
 * then two limbs for each integer, entered in its list of spare ones, a stack that no header of
 * FLINT declares. Block and list belong to FLINT, not to us, and must not be left half done. */
enum { BLOCK_PAGES = 16 };
#define LIMBS (2 * sizeof(mp_limb_t))

static _Thread_local qdot_flint_spare list; /* where that is, of this thread */
#define mpz_free_arr (*list.at)
#define mpz_free_num (*list.n)
#define mpz_free_alloc (*list.room)

static _Thread_local struct {
    bool on, leaving;
    long
        to_come; /* integers of the block that FLINT makes, whose limbs are still to come */
    void *block; /* that block */
    /* the limbs given back last: GMP may hold them in an integer while it asks for larger ones */
    void *gone;
    qdot_status why;
    jmp_buf out;
    qdot_scope scope;
    __mpz_struct **spare; /* the spare integers when it began */
    size_t n_spare;
    void **made; /* the blocks made in it */
    size_t n_made;
} guard;

static _Noreturn void
leave(qdot_status why)
{
    guard.why = why;
    longjmp(guard.out, 1);
}

static size_t
page(void)
{
    static size_t size;

    if (size == 0)
        size = (size_t)sysconf(_SC_PAGESIZE);
    return size;
}

static long
integers_in_block(void)
{
    size_t header = (sizeof(fmpz_block_header_s) - 1) / sizeof(__mpz_struct) + 1;

    return BLOCK_PAGES * (long)(page() / sizeof(__mpz_struct) - header);
}

/* Before anything of `size` bytes is asked for: a reason to leave. */
static void
look(size_t size)
{
    if (!guard.on || guard.leaving)
        return;
    if (qdot_interrupt_flag)
        leave(qdot_interrupt_check());
    if (size > QDOT_FLINT_MEMORY || guard.scope.bytes > QDOT_FLINT_MEMORY - size)
        leave(qdot_fail(QDOT_ELIMIT, "more than %zu MB of memory",
                        QDOT_FLINT_MEMORY >> 20));
}

/* What was asked for; none: away. Outside a guarded computation, in a thread of its own, there
 * is nowhere to go. */
static void *
given(void *block)
{
    if (block != NULL)
        return block;
    if (guard.on && !guard.leaving)
        leave(QDOT_ENOMEM);
    abort();
}

/* What belongs to FLINT itself, and cannot be done without. */
static void *
for_good(void *block)
{
    if (block == NULL)
        abort();
    return block;
}

static void *
take(size_t size)
{
    void *block;

    look(size);
    guard.to_come = 0;
    if (!guard.on || mpz_free_num != 0 || size != (BLOCK_PAGES + 1) * page())
        return given(qdot_malloc(size));
    block = realloc(guard.made, (guard.n_made + 1) * sizeof *guard.made);
    if (block == NULL)
        leave(qdot_fail(QDOT_ENOMEM, "out of memory (%zu bytes wanted)", size));
    guard.made = block;
    guard.block = given(qdot_malloc(size));
    guard.to_come = integers_in_block();
    return guard.block;
}

static void *
take_clear(size_t count, size_t size)
{
    look(count * size);
    guard.to_come = 0;
    return given(qdot_calloc(count, size));
}

static void *
enlarge(void *block, size_t size)
{
    if (guard.on && (block == mpz_free_arr || guard.leaving)) {
        (void)qdot_scope_release(block);
        return for_good(realloc(block, size));
    }
    look(size);
    guard.to_come = 0;
    return given(qdot_realloc(block, size));
}

/* What FLINT gives back when it is cleaned up goes with the rest: where it came from is still
 * looked at. */
static void
give_back(void *block)
{
    guard.to_come = 0;
    if (!guard.leaving)
        qdot_free(block);
    else if (block != NULL && !qdot_scope_has(block))
        (void)qdot_scope_note(block, 0);
}

/* GMP's three. */

static void *
limbs(size_t size)
{
    if (guard.on && guard.to_come > 0 && size == LIMBS) {
        void *block = for_good(malloc(size));

        if (--guard.to_come == 0) { /* it is complete, and FLINT's */
            (void)qdot_scope_release(guard.block);
            guard.made[guard.n_made++] = guard.block;
        }
        (void)qdot_scope_note(block, size);
        return block;
    }
    look(size);
    guard.to_come = 0;
    return given(qdot_malloc(size));
}

static void *
limbs_enlarge(void *block, size_t old, size_t size)
{
    void *bigger;

    look(size);
    guard.to_come = 0;
    if (guard.leaving && size <= old)
        return block;
    if (!guard.on || qdot_scope_has(block))
        return given(qdot_realloc(block, size));
    /* of a spare integer: it is ours from now on, until it is spare again */
    bigger = qdot_realloc(block, size);
    if (bigger != NULL && !qdot_scope_note(bigger, size))
        bigger = for_good(NULL);
    return given(bigger);
}

static void
limbs_give_back(void *block, size_t size)
{
    (void)size;
    if (!guard.leaving)
        guard.gone = block;
    give_back(block);
}

static FLINT_NORETURN void
gave_up(void)
{
    if (guard.on)
        leave(qdot_fail(QDOT_ELIMIT, "FLINT gave up"));
    abort();
}

/* --- the functions in their places --------------------------------------------------------- */

static struct {
    void *(*take)(size_t), *(*clear)(size_t, size_t), *(*enlarge)(void *, size_t);
    void (*give_back)(void *);
    void *(*limbs)(size_t), *(*limbs_enlarge)(void *, size_t, size_t);
    void (*limbs_give_back)(void *, size_t);
} before;

static void
install(void)
{
    __flint_get_memory_functions(&before.take, &before.clear, &before.enlarge,
                                 &before.give_back);
    mp_get_memory_functions(&before.limbs, &before.limbs_enlarge,
                            &before.limbs_give_back);
    __flint_set_memory_functions(take, take_clear, enlarge, give_back);
    mp_set_memory_functions(limbs, limbs_enlarge, limbs_give_back);
    flint_set_abort(gave_up);
}

static void
uninstall(void)
{
    __flint_set_memory_functions(before.take, before.clear, before.enlarge,
                                 before.give_back);
    mp_set_memory_functions(before.limbs, before.limbs_enlarge, before.limbs_give_back);
    flint_set_abort(abort);
}

/* --- the integers of what was left ------------------------------------------------------- */

/* The header of the block that x is in: FLINT's count of integers that it will not use again. */
static int *
retired(const __mpz_struct *x)
{
    const fmpz_block_header_s *first = (void *)((uintptr_t)x & ~(uintptr_t)(page() - 1));

    return &((fmpz_block_header_s *)first->address)->count;
}

/* A mark that can be taken off again. */
static void
flip(__mpz_struct *x)
{
    x->_mp_alloc = ~x->_mp_alloc;
}

enum { DOOMED = -1, LASTING = -2 };

/* Blocks made since it began are given back, but those with a number of the pool in them; spare
 * integers in them are no more. */
static void
doom_new_blocks(void)
{
    ulong left = 0;

    for (size_t i = 0; i < guard.scope.outlived.n; i++)
        *retired(guard.scope.outlived.at[i]) = LASTING;
    for (size_t b = 0; b < guard.n_made; b++)
        if (((fmpz_block_header_s *)guard.made[b])->count != LASTING)
            ((fmpz_block_header_s *)guard.made[b])->count = DOOMED;
    for (ulong i = 0; i < mpz_free_num; i++)
        if (*retired(mpz_free_arr[i]) != DOOMED)
            mpz_free_arr[left++] = mpz_free_arr[i];
    mpz_free_num = left;
}

/* An integer that was spare when it began, or was made since: if nobody has it, it is spare again.
 * GMP may have been about to enlarge it: its limbs may be gone, their number wrong. That some
 * integers of its block are retired does not retire it: others of it are in use, and would keep
 * the block for ever. */
static void
take_back(__mpz_struct *x)
{
    fmpz_block_header_s *first = (void *)((uintptr_t)x & ~(uintptr_t)(page() - 1));
    bool own = x->_mp_d != guard.gone && !qdot_scope_has(x->_mp_d);
    mp_limb_t *fresh;

    if (qdot_scope_has(first->address) || x->_mp_alloc < 0)
        return;
    fresh = realloc(own ? x->_mp_d : NULL, LIMBS);
    if (fresh == NULL) /* lost */
        return;
    *x = (__mpz_struct){._mp_d = fresh, ._mp_alloc = LIMBS / sizeof *fresh};
    *retired(x) = 0;
    _fmpz_clear_mpz(PTR_TO_COEFF(x));
    flip(x);
}

static void
take_back_block(char *block)
{
    uintptr_t mask = ~(uintptr_t)(page() - 1);
    char *at = (char *)(((uintptr_t)block & mask) + page());
    size_t header = (sizeof(fmpz_block_header_s) - 1) / sizeof(__mpz_struct) + 1;

    for (size_t i = 0; i < BLOCK_PAGES; i++, at += page())
        for (size_t k = header; k < page() / sizeof(__mpz_struct); k++)
            take_back((__mpz_struct *)(void *)at + k);
}

/* Every integer is FLINT's spare one again that was in use by what was left, and not by the pool. */
static void
take_back_integers(void)
{
    doom_new_blocks();
    for (ulong i = 0; i < mpz_free_num; i++) {
        (void)qdot_scope_release(mpz_free_arr[i]->_mp_d);
        flip(mpz_free_arr[i]);
    }
    for (size_t i = 0; i < guard.scope.outlived.n; i++)
        flip(guard.scope.outlived.at[i]);
    for (size_t i = 0; i < guard.n_spare; i++)
        take_back(guard.spare[i]);
    for (size_t b = 0; b < guard.n_made; b++)
        if (((fmpz_block_header_s *)guard.made[b])->count != DOOMED)
            take_back_block(guard.made[b]);
        else if (!qdot_scope_has(guard.made[b]))
            (void)qdot_scope_note(guard.made[b], 0); /* away with the rest */
    for (ulong i = 0; i < mpz_free_num; i++)
        flip(mpz_free_arr[i]);
    for (size_t i = 0; i < guard.scope.outlived.n; i++) {
        flip(guard.scope.outlived.at[i]);
        *retired(guard.scope.outlived.at[i]) = 0;
    }
}

/* Numbers of the pool are not known: nothing is taken back but what is spare. */
static void
keep_spare(void)
{
    for (ulong i = 0; i < mpz_free_num; i++)
        (void)qdot_scope_release(mpz_free_arr[i]->_mp_d);
}

/* --- in and out --------------------------------------------------------------------------- */

/* FLINT's caches, and MPFR's, hold what is given back; its list stays out of this. */
static void
empty_caches(void)
{
    __mpz_struct **spare = mpz_free_arr;
    ulong n = mpz_free_num, alloc = mpz_free_alloc;

    mpz_free_arr = NULL;
    mpz_free_num = mpz_free_alloc = 0;
    guard.leaving = true;
    flint_cleanup();
    guard.leaving = false;
    mpz_free_arr = spare;
    mpz_free_num = n;
    mpz_free_alloc = alloc;
}

static void
forget(void)
{
    free(guard.made);
    free(guard.spare);
    guard.made = NULL;
    guard.n_made = 0;
    guard.spare = NULL;
    guard.n_spare = 0;
}

/* All that the computation left. */
static void
clean_up(void)
{
    qdot_status why = guard.why;

    empty_caches();
    guard.on = false;
    uninstall();
    if (guard.scope.outlived.missing)
        keep_spare();
    else
        take_back_integers();
    qdot_scope_discard(&guard.scope);
    forget();
    guard.why = why;
}

/* The spare integers as they are now. */
static qdot_status
note_spare(void)
{
    if (list.at == NULL)
        qdot_flint_list(&list);
    if (mpz_free_arr == NULL) { /* our functions are to know it when they see it */
        mpz_free_arr = qdot_malloc(64 * sizeof *mpz_free_arr);
        mpz_free_alloc = mpz_free_arr != NULL ? 64 : 0;
    }
    guard.spare = qdot_malloc(mpz_free_num * sizeof *guard.spare);
    if (mpz_free_arr == NULL || guard.spare == NULL) {
        forget();
        return QDOT_ENOMEM;
    }
    guard.n_spare = mpz_free_num;
    if (mpz_free_num > 0)
        memcpy(guard.spare, mpz_free_arr, mpz_free_num * sizeof *guard.spare);
    return QDOT_OK;
}

qdot_status
qdot_flint_run(qdot_pool *pool, void (*work)(void *user), void *user)
{
    uint64_t budget;

    if (guard.on) {
        work(user);
        return QDOT_OK;
    }
    QDOT_TRY(note_spare());
    if (qdot_scope_begin(&guard.scope) != QDOT_OK) {
        forget();
        return QDOT_ENOMEM;
    }
    budget = qdot_pool_budget(pool, UINT64_MAX);
    (void)qdot_pool_budget(pool, budget);
    guard.to_come = 0;
    guard.gone = NULL;
    guard.on = true;
    install();
    if (setjmp(guard.out) == 0) {
        work(user);
        guard.on = false;
        uninstall();
        qdot_scope_end(&guard.scope);
        forget();
        return QDOT_OK;
    }
    clean_up();
    (void)qdot_pool_budget(pool, budget);
    return guard.why;
}
