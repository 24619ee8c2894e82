/* flint.h -- FLINT, Arb and GMP abort where memory ends and do not look at Ctrl-C: here they return.
 *
 * A guarded computation runs on a thread of its own, with memory functions of our own under FLINT
 * and GMP. Where no memory is left, where it holds more than a bound, or where Ctrl-C was pressed,
 * it is left at once by longjmp, from within the library that asked, to the start of that thread.
 * Everything it allocated, there and by memory.h, is freed (base/scope.h), with all that FLINT and
 * MPFR keep for that thread, and the thread ends. What outlives it: nodes of the pool.
 *
 * So no object of FLINT may pass between a guarded computation and its caller, either way: only
 * expressions, numbers of C, and what memory.h allocated.
 *
 * Each thread that asks has one such thread, which waits for the next computation and keeps
 * FLINT's and Arb's caches warm, up to 64 MB; it ends with the thread that asked. FLINT and MPFR
 * must keep their caches per thread (configure looks). Not to be used in a child after fork().
 *
 * While a guarded computation runs, the memory functions are the process's: not for a program
 * whose other threads compute with GMP under memory functions of their own.
 *
 * Tests  tests/normal/test_flint.c
 */
#ifndef QDOT_NORMAL_FLINT_H
#define QDOT_NORMAL_FLINT_H

#include "expr/expr.h"

/* Most that one computation may hold, in bytes. */
#define QDOT_FLINT_MEMORY ((size_t)2 << 30)

/* Run work(user), guarded; inside another guarded computation simply run it. QDOT_OK: it ended, by
 * itself. QDOT_ENOMEM, QDOT_EINTR; QDOT_ELIMIT past the bound or where FLINT gave up: it was
 * left, *user holds what it held then, nothing in it that was allocated is there any more; the
 * pool has its budget of before. The failure is recorded as the thread's, not the pool's; so is
 * what work itself recorded. */
QDOT_MUST_CHECK qdot_status qdot_flint_run(qdot_pool *pool, void (*work)(void *user),
                                           void *user);

#endif
