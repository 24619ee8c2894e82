/* flint.h -- FLINT, Arb and GMP abort where memory ends and do not look at Ctrl-C: here they return.
 *
 * A guarded computation runs with memory functions of our own under FLINT and GMP. Where no memory
 * is left, where it holds more than a bound, or where Ctrl-C was pressed, it is left at once by
 * longjmp, from within the library that asked, and everything that it allocated, there and by
 * memory.h, is given back (base/scope.h). What outlives it: nodes of the pool.
 *
 * FLINT keeps spare integers in a list of its own. It is as it was before when a computation is
 * left: an integer that was in use is spare again, but those that the pool has.
 *
 * The memory functions are the process's: not for a program whose other threads compute with
 * GMP under memory functions of their own.
 *
 * Tests  tests/normal/test_flint.c
 */
#ifndef QDOT_NORMAL_FLINT_H
#define QDOT_NORMAL_FLINT_H

#include <flint/fmpz.h>

#include "expr/expr.h"

/* Most that one computation may hold, in bytes. */
#define QDOT_FLINT_MEMORY ((size_t)2 << 30)

/* Run work(user), guarded; inside another guarded computation simply run it. QDOT_OK: it ended, by
 * itself. QDOT_ENOMEM, QDOT_EINTR; QDOT_ELIMIT past the bound or where FLINT gave up: it was
 * left, *user holds what it held then, nothing in it that was allocated is there any more; the
 * pool has its budget of before. The failure is recorded as the thread's, not the pool's. */
QDOT_MUST_CHECK qdot_status qdot_flint_run(qdot_pool *pool, void (*work)(void *user),
                                           void *user);

/* FLINT's list of spare integers, of this thread: (*at)[0 .. *n), room for *room. FLINT's own;
 * for flint.c alone. In a file of its own, so that a program which loads FLINT when it is first
 * called (src/late.c) can tell in its place. */
typedef struct {
    __mpz_struct ***at;
    ulong *n, *room;
} qdot_flint_spare;
void qdot_flint_list(qdot_flint_spare *list);

#endif
