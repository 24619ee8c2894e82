/* flint.h -- runs computations with FLINT, Arb and GMP so that they can fail and be interrupted.
 *
 * By themselves these libraries abort if memory runs out, and ignore Ctrl-C. A guarded
 * computation runs on a thread of its own, with our memory functions under FLINT and GMP. If no
 * memory is left, if it holds more than a bound, or if Ctrl-C was pressed, it is left by longjmp,
 * from within the library, to the start of that thread. Everything that it allocated, there and
 * by memory.h, is freed (base/scope.h), with all that FLINT and MPFR keep for that thread, and
 * the thread ends. Only nodes of the pool remain.
 *
 * So no object of FLINT may pass between a guarded computation and its caller, either way: only
 * expressions, numbers of C, and what memory.h allocated.
 *
 * Each thread that asks has one such thread, which waits for the next computation and keeps
 * FLINT's and Arb's caches warm, up to 64 MB; it ends with the thread that asked. FLINT and MPFR
 * must keep their caches per thread (configure looks). Not to be used in a child after fork().
 *
 * Without threads (configure --disable-threads) it runs in the thread that asks. If it is left, FLINT frees all its caches,
 * and what remains of the computation is freed after that; the thread's own numbers stay. It has the stack that the thread has.
 *
 * While a guarded computation runs, the memory functions are the process's: not for a program
 * whose other threads compute with GMP under memory functions of their own.
 *
 * Tests  tests/normal/field/test_flint.c, tests/expr/polynomial/test_multiply.c
 */
#ifndef QDOT_EXPR_FLINT_H
#define QDOT_EXPR_FLINT_H

#include "expr/id.h"

/* The most memory that one computation may use, in bytes: 2 GB, of an address space of 32 bits 1 GB. */
#define QDOT_FLINT_MEMORY ((size_t)1 << (sizeof(size_t) > 4 ? 31 : 30))

/* Run work(user), guarded; inside another guarded computation simply run it. QDOT_OK: it
 * returned. QDOT_ENOMEM, QDOT_EINTR, QDOT_ELIMIT (past the bound, or FLINT gave up): it was left;
 * *user is as it was then, but everything allocated in it has been freed; the pool has its
 * previous budget. The failure, as one recorded by work itself, is the thread's last error, not
 * the pool's. */
QDOT_MUST_CHECK qdot_status qdot_flint_run(qdot_pool *pool, void (*work)(void *user),
                                           void *user);

/* Whether this thread has run a guarded computation, so that the libraries are loaded and the next one begins at once. */
bool qdot_flint_is_ready(void);

#endif
