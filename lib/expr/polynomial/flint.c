/* flint.c -- gives FLINT and GMP our memory functions; contains the only longjmp.
 *
 * The functions are given once for all threads, and taken back when no computation is under way. Where there are no threads
 * (QDOT_ONE_THREAD), a computation that was abandoned leaves FLINT's caches behind in the only thread there is, perhaps while
 * they were written. FLINT then frees them all (flint_cleanup), and what it still holds of that computation is freed after it.
 */
#include "expr/polynomial/flint.h"

#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdlib.h>

#include <flint/flint.h>
#include <gmp.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/scope.h"

/* If FLINT's caches in a thread exceed this many bytes, the thread is ended to free them. */
#define KEPT ((size_t)64 << 20)
/* Stack size: FLINT recurses over variables; unused address space costs nothing. */
#define STACK ((size_t)64 << 20)

/* State of a thread whose computation can be abandoned. */
static _Thread_local struct {
    bool on, leaving; /* leaving: abandoned, FLINT's caches are freed */
    qdot_status why;
    jmp_buf out;
    qdot_scope own;     /* blocks allocated through memory.h during this computation */
    qdot_scope library; /* what FLINT and GMP allocated since the thread began; without threads, since the computation began */
    size_t cached;      /* size of `library` at the start of the computation, in bytes */
} guard;

/* --- memory functions for FLINT and GMP -------------------------------------------------- */

static __attribute__((noreturn)) void
flint_leave(qdot_status why)
{
    guard.why = why;
    longjmp(guard.out, 1);
}

/* Abandon the computation if it was interrupted, or if `size` further bytes exceed its limit. */
static void
flint_check_budget(size_t size)
{
    size_t caches = guard.library.bytes < guard.cached ? guard.library.bytes : guard.cached;
    size_t held = guard.own.bytes + guard.library.bytes - caches;

    if (guard.leaving)
        return;
    if (qdot_interrupt_is_set())
        flint_leave(qdot_interrupt_check());
    if (size > QDOT_FLINT_MEMORY || held > QDOT_FLINT_MEMORY - size)
        flint_leave(qdot_fail(QDOT_ELIMIT, "more than %zu MB of memory",
                              QDOT_FLINT_MEMORY >> 20));
}

/* Return the allocated block; NULL abandons the computation, or aborts a thread without one. */
static void *
block_or_abandon(void *block)
{
    if (block != NULL)
        return block;
    if (guard.on)
        flint_leave(QDOT_ENOMEM);
    abort();
}

static void *
guarded_malloc(size_t size)
{
    void *block;

    if (!guard.on)
        return block_or_abandon(malloc(size));
    flint_check_budget(size);
    qdot_scope_now = &guard.library;
    block = qdot_malloc(size);
    qdot_scope_now = &guard.own;
    return block_or_abandon(block);
}

static void *
take_clear(size_t count, size_t size)
{
    void *block;

    if (!guard.on)
        return block_or_abandon(calloc(count, size));
    flint_check_budget(count * size);
    qdot_scope_now = &guard.library;
    block = qdot_calloc(count, size);
    qdot_scope_now = &guard.own;
    return block_or_abandon(block);
}

static void *
guarded_realloc(void *block, size_t size)
{
    if (!guard.on)
        return block_or_abandon(realloc(block, size));
    flint_check_budget(size);
    qdot_scope_now = &guard.library;
    block = qdot_realloc(block, size);
    qdot_scope_now = &guard.own;
    return block_or_abandon(block);
}

static void
give_back(void *block)
{
    if (!guard.on) {
        free(block);
        return;
    }
    qdot_scope_now = &guard.library;
    qdot_free(block);
    qdot_scope_now = &guard.own;
}

/* realloc for GMP, which also passes the old size. */
static void *
enlarge_limbs(void *block, size_t old, size_t size)
{
    (void)old;
    return guarded_realloc(block, size);
}

static void
give_back_limbs(void *block, size_t size)
{
    (void)size;
    give_back(block);
}

static __attribute__((noreturn)) void
gave_up(void)
{
    if (guard.on)
        flint_leave(qdot_fail(QDOT_ELIMIT, "FLINT gave up"));
    abort();
}

#if __FLINT_RELEASE >= 30000

static void *
take_aligned(size_t alignment, size_t size)
{
    void *block;

    if (!guard.on)
        return block_or_abandon(aligned_alloc(alignment, size));
    flint_check_budget(size);
    qdot_scope_now = &guard.library;
    block = qdot_malloc_aligned(alignment, size);
    qdot_scope_now = &guard.own;
    return block_or_abandon(block);
}

#endif

/* --- installing the memory functions ------------------------------------------------------- */

static struct {
    pthread_mutex_t lock;
    int users; /* computations running; the first installs our memory functions, the last restores the old ones */
    void *(*take)(size_t), *(*take_clear)(size_t, size_t), *(*enlarge)(void *, size_t);
    void (*give_back)(void *);
    void *(*take_aligned)(size_t, size_t);
    void (*give_back_aligned)(void *);
    void *(*limbs)(size_t), *(*enlarge_limbs)(void *, size_t, size_t);
    void (*give_back_limbs)(void *, size_t);
} before = {.lock = PTHREAD_MUTEX_INITIALIZER};

static void
install_memory_functions(void)
{
    pthread_mutex_lock(&before.lock);
    if (before.users++ == 0) {
#if __FLINT_RELEASE >= 30000
        __flint_get_all_memory_functions(&before.take, &before.take_clear, &before.enlarge,
                                         &before.give_back, &before.take_aligned,
                                         &before.give_back_aligned);
        __flint_set_all_memory_functions(guarded_malloc, take_clear, guarded_realloc, give_back, take_aligned,
                                         give_back);
#else
        __flint_get_memory_functions(&before.take, &before.take_clear, &before.enlarge,
                                     &before.give_back);
        __flint_set_memory_functions(guarded_malloc, take_clear, guarded_realloc, give_back);
#endif
        mp_get_memory_functions(&before.limbs, &before.enlarge_limbs,
                                &before.give_back_limbs);
        mp_set_memory_functions(guarded_malloc, enlarge_limbs, give_back_limbs);
        flint_set_abort(gave_up);
    }
    pthread_mutex_unlock(&before.lock);
}

static void
restore_memory_functions(void)
{
    pthread_mutex_lock(&before.lock);
    if (--before.users == 0) {
#if __FLINT_RELEASE >= 30000
        __flint_set_all_memory_functions(before.take, before.take_clear, before.enlarge,
                                         before.give_back, before.take_aligned,
                                         before.give_back_aligned);
#else
        __flint_set_memory_functions(before.take, before.take_clear, before.enlarge,
                                     before.give_back);
#endif
        mp_set_memory_functions(before.limbs, before.enlarge_limbs, before.give_back_limbs);
        flint_set_abort(abort);
    }
    pthread_mutex_unlock(&before.lock);
}

/* --- one computation --------------------------------------------------------------------- */

#ifdef QDOT_ONE_THREAD

/* Free FLINT's caches, whose blocks are then no longer recorded. */
static void
flint_free_caches(void)
{
    guard.leaving = true;
    flint_cleanup();
    guard.leaving = false;
}

#else

/* FLINT is not called: it may have been interrupted while it changed its state. Its thread ends. */
static void
flint_free_caches(void)
{
}

#endif

/* Carry out one computation. QDOT_OK: it was not abandoned. */
static qdot_status
run_computation(void (*work)(void *user), void *user)
{
    QDOT_TRY(qdot_scope_begin(&guard.own));
    guard.cached = guard.library.bytes;
    guard.why = QDOT_OK;
    guard.on = true;
    install_memory_functions();
    if (setjmp(guard.out) == 0) {
        work(user);
        guard.on = false;
        qdot_scope_end(&guard.own);
    } else {
        flint_free_caches();
        guard.on = false;
        qdot_scope_discard(&guard.own);
    }
    restore_memory_functions();
    return guard.why;
}

static pthread_once_t once = PTHREAD_ONCE_INIT;
static pthread_key_t key;

#ifdef QDOT_ONE_THREAD

/* --- in place -------------------------------------------------------------------------------- */

/* What FLINT has cached for a thread ends with the thread. */
static void
end_of_thread(void *any)
{
    (void)any;
    flint_cleanup();
}

static void
create_thread_key(void)
{
    (void)pthread_key_create(&key, end_of_thread);
}

static qdot_status
compute(void (*work)(void *user), void *user)
{
    qdot_status status;

    pthread_once(&once, create_thread_key);
    (void)pthread_setspecific(key, &guard);
    QDOT_TRY(qdot_scope_begin(&guard.library));
    status = run_computation(work, user);
    if (status != QDOT_OK) {
        qdot_scope_discard(&guard.library);
        return status;
    }
    if (guard.library.bytes > KEPT)
        flint_cleanup();
    qdot_scope_end(&guard.library);
    return QDOT_OK;
}

#else

/* --- the thread that computes ------------------------------------------------------------ */

/* A thread for computations. The lock is held while it computes, so that the caller waits for the end. */
typedef struct {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    enum { WAITING, ASKED, ENDING } state;
    void (*work)(void *user);
    void *user;
    qdot_interrupt *interrupt; /* flag of the system for which the caller computes */
    qdot_status status;
    qdot_error error; /* the last failure: first of the caller's thread, then of this one */
} worker;

/* This thread's worker. When the thread ends, the destructor of the key ends the worker and frees what FLINT has cached
 * for the thread itself. */
static _Thread_local worker *mine;

static void *
worker_main(void *user)
{
    worker *w = user;
    bool begun = qdot_scope_begin(&guard.library) == QDOT_OK;

    qdot_scope_now = NULL;
    pthread_mutex_lock(&w->lock);
    for (;;) {
        while (w->state == WAITING)
            pthread_cond_wait(&w->changed, &w->lock);
        if (w->state == ENDING)
            break;
        (void)qdot_fail_again(&w->error);
        qdot_interrupt_own = w->interrupt;
        w->status = begun ? run_computation(w->work, w->user) : qdot_fail(QDOT_ENOMEM, "out of memory");
        w->state = w->status == QDOT_OK && guard.library.bytes <= KEPT ? WAITING : ENDING;
        w->error = *qdot_last_error();
        pthread_cond_signal(&w->changed);
    }
    if (begun)
        qdot_scope_discard(&guard.library);
    pthread_mutex_unlock(&w->lock);
    return NULL;
}

static void
worker_stop(worker *w)
{
    pthread_mutex_lock(&w->lock);
    w->state = ENDING;
    pthread_cond_signal(&w->changed);
    pthread_mutex_unlock(&w->lock);
    pthread_join(w->thread, NULL);
    pthread_cond_destroy(&w->changed);
    pthread_mutex_destroy(&w->lock);
    qdot_free(w);
}

/* After fork: the child process has a copy of the worker's memory, but not its thread. */
static void
worker_forget(void)
{
    mine = NULL;
}

static void
end_worker_of_thread(void *place)
{
    worker **its = place;

    if (*its != NULL)
        worker_stop(*its);
    *its = NULL;
    flint_cleanup();
}

static void
create_thread_key(void)
{
    (void)pthread_key_create(&key, end_worker_of_thread);
    (void)pthread_atfork(NULL, NULL, worker_forget);
}

/* Start the thread that computes for the calling one; it blocks all signals. NULL: refused. */
static worker *
worker_start_thread(void)
{
    worker *w = qdot_calloc(1, sizeof *w);
    sigset_t all, old;
    pthread_attr_t attr;
    int refused;

    if (w == NULL)
        return NULL;
    pthread_once(&once, create_thread_key);
    pthread_mutex_init(&w->lock, NULL);
    pthread_cond_init(&w->changed, NULL);
    pthread_attr_init(&attr);
    pthread_attr_setstacksize(&attr, STACK);
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &old);
    refused = pthread_create(&w->thread, &attr, worker_main, w);
    pthread_sigmask(SIG_SETMASK, &old, NULL);
    pthread_attr_destroy(&attr);
    if (refused) {
        qdot_free(w);
        (void)qdot_fail(QDOT_ENOMEM, "the system refuses a thread for exact computations");
        return NULL;
    }
    (void)pthread_setspecific(key, &mine);
    return w;
}

static qdot_status
compute(void (*work)(void *user), void *user)
{
    qdot_status status;
    bool ended;

    if (mine == NULL)
        mine = worker_start_thread();
    if (mine == NULL)
        return QDOT_ENOMEM;
    pthread_mutex_lock(&mine->lock);
    mine->work = work;
    mine->user = user;
    mine->interrupt = qdot_interrupt_own;
    mine->error = *qdot_last_error();
    mine->state = ASKED;
    pthread_cond_signal(&mine->changed);
    while (mine->state == ASKED)
        pthread_cond_wait(&mine->changed, &mine->lock);
    ended = mine->state == ENDING;
    status = mine->status;
    (void)qdot_fail_again(&mine->error);
    pthread_mutex_unlock(&mine->lock);

    if (ended) {
        worker_stop(mine);
        mine = NULL;
    }
    return status;
}

#endif

static _Thread_local bool ready;

bool
qdot_flint_is_ready(void)
{
    return ready || guard.on;
}

qdot_status
qdot_flint_run(qdot_pool *pool, void (*work)(void *user), void *user)
{
    uint64_t budget;
    qdot_status status;

    if (guard.on) {
        work(user);
        return QDOT_OK;
    }
    budget = qdot_pool_budget(pool, UINT64_MAX);
    (void)qdot_pool_budget(pool, budget);
    ready = true;
    status = compute(work, user);
    if (status != QDOT_OK)
        (void)qdot_pool_budget(pool, budget);
    return status;
}
