/* flint.c -- the one file that knows how FLINT and GMP allocate, and the only longjmp. */
#include "normal/flint.h"

#include <setjmp.h>
#include <stdlib.h>
#include <unistd.h>

#include <flint/flint.h>
#include <flint/fmpz.h>
#include <gmp.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/scope.h"

/* FLINT makes integers a block at a time: one allocation of BLOCK_PAGES pages and one to align,
 * one for its list, then two limbs for each integer. These belong to FLINT, not to us, and must
 * not be left half done. */
enum { BLOCK_PAGES = 16 };
#define LIMBS (2 * sizeof(mp_limb_t))

static _Thread_local struct {
    bool on, draining;
    long block;     /* integers of the block that FLINT makes, whose limbs are still to come */
    bool list;      /* its list, too */
    qdot_status why;
    jmp_buf out, drained;
    qdot_scope scope;
    void **made; /* the blocks made in it */
    size_t n_made;
} guard;

static _Noreturn void
leave(qdot_status why)
{
    guard.why = why;
    longjmp(guard.draining ? guard.drained : guard.out, 1);
}

static size_t
page(void)
{
    return (size_t)sysconf(_SC_PAGESIZE);
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
    if (!guard.on)
        return;
    if (guard.draining)
        leave(QDOT_ENOMEM);
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
    if (guard.on)
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
    look(size);
    guard.block = 0;
    if (guard.on && size == (BLOCK_PAGES + 1) * page()) {
        void *block = malloc(size);
        void **made = realloc(guard.made, (guard.n_made + 1) * sizeof *made);

        guard.made = made != NULL ? made : guard.made;
        if (block == NULL || made == NULL) {
            free(block);
            leave(qdot_fail(QDOT_ENOMEM, "out of memory (%zu bytes wanted)", size));
        }
        guard.made[guard.n_made++] = block;
        guard.block = integers_in_block();
        guard.list = true;
        return block;
    }
    return given(qdot_malloc(size));
}

static void *
take_clear(size_t count, size_t size)
{
    look(count * size);
    guard.block = 0;
    return given(qdot_calloc(count, size));
}

static void *
enlarge(void *block, size_t size)
{
    bool own = guard.on && ((guard.block > 0 && guard.list) ||
                            (block != NULL && !qdot_scope_has(block)));

    if (own) { /* FLINT's list of integers */
        guard.list = false;
        return for_good(realloc(block, size));
    }
    look(size);
    guard.block = 0;
    return given(qdot_realloc(block, size));
}

static void
give_back(void *block)
{
    guard.block = 0;
    qdot_free(block);
}

/* GMP's three. */

static void *
limbs(size_t size)
{
    if (guard.on && guard.block > 0 && size == LIMBS) {
        void *block = for_good(malloc(size));

        guard.block--;
        (void)qdot_scope_note(block, size);
        return block;
    }
    look(size);
    guard.block = 0;
    return given(qdot_malloc(size));
}

static void *
limbs_enlarge(void *block, size_t old, size_t size)
{
    void *bigger;

    (void)old;
    look(size);
    guard.block = 0;
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
    give_back(block);
}

static FLINT_NORETURN void
gave_up(void)
{
    if (guard.on)
        leave(qdot_fail(QDOT_ELIMIT, "FLINT gave up"));
    abort();
}

/* --- in and out ------------------------------------------------------------------------- */

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
    mp_get_memory_functions(&before.limbs, &before.limbs_enlarge, &before.limbs_give_back);
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

static void
forget_blocks(void)
{
    free(guard.made);
    guard.made = NULL;
    guard.n_made = 0;
}

/* The spare integers, taken from FLINT's list until it asks for memory to make more; their limbs
 * are theirs. NULL: no memory. */
static __mpz_struct **
spare(size_t *n)
{
    static _Thread_local __mpz_struct **list;
    static _Thread_local size_t count, room;

    list = NULL;
    count = room = 0;
    guard.draining = true;
    if (setjmp(guard.drained) == 0)
        for (;;) {
            if (count == room) {
                __mpz_struct **more = realloc(list, (2 * room + 4096) * sizeof *list);

                if (more == NULL) {
                    free(list);
                    list = NULL;
                    break;
                }
                list = more;
                room = 2 * room + 4096;
            }
            list[count] = _fmpz_new_mpz();
            qdot_scope_release(list[count]->_mp_d);
            count++;
        }
    guard.draining = false;
    *n = count;
    return list;
}

/* Blocks of integers made since it began are given back, if no number of the pool is in them: the
 * spare ones without those in such a block. */
static size_t
without_new_blocks(__mpz_struct **list, size_t n)
{
    size_t size = (BLOCK_PAGES + 1) * page(), left = 0;

    if (guard.scope.outlived)
        return n;
    for (size_t i = 0; i < n; i++) {
        size_t b = 0;

        while (b < guard.n_made && ((char *)list[i] < (char *)guard.made[b] ||
                                    (char *)list[i] >= (char *)guard.made[b] + size))
            b++;
        if (b < guard.n_made)
            mpz_clear(list[i]);
        else
            list[left++] = list[i];
    }
    for (size_t b = 0; b < guard.n_made; b++)
        free(guard.made[b]);
    return left;
}

/* Back into FLINT's list. That flint_cleanup has cleared integers of its block does not retire it:
 * others of it are in use, and would keep it for ever. */
static void
make_spare(__mpz_struct *x)
{
    fmpz_block_header_s *header = (void *)((uintptr_t)x & ~(uintptr_t)(page() - 1));

    ((fmpz_block_header_s *)header->address)->count = 0;
    _fmpz_clear_mpz(PTR_TO_COEFF(x));
}

/* All that the computation left: FLINT's caches first, then the blocks. */
static void
clean_up(void)
{
    qdot_status why = guard.why;
    size_t n;
    __mpz_struct **list = spare(&n);

    if (list != NULL) {
        flint_cleanup();
        n = without_new_blocks(list, n);
    }
    guard.on = false;
    uninstall();
    if (list == NULL) { /* not even that: what is lost is lost */
        qdot_scope_end(&guard.scope);
    } else {
        qdot_scope_discard(&guard.scope);
        for (size_t i = 0; i < n; i++)
            make_spare(list[i]);
        free(list);
    }
    forget_blocks();
    guard.why = why;
}

qdot_status
qdot_flint_run(qdot_pool *pool, void (*work)(void *user), void *user)
{
    uint64_t budget;

    if (guard.on) {
        work(user);
        return QDOT_OK;
    }
    QDOT_TRY(qdot_scope_begin(&guard.scope));
    budget = qdot_pool_budget(pool, UINT64_MAX);
    (void)qdot_pool_budget(pool, budget);
    guard.block = 0;
    guard.on = true;
    install();
    if (setjmp(guard.out) == 0) {
        work(user);
        guard.on = false;
        uninstall();
        qdot_scope_end(&guard.scope);
        forget_blocks();
        return QDOT_OK;
    }
    clean_up();
    (void)qdot_pool_budget(pool, budget);
    return guard.why;
}
