/* mpi.h -- what parallel/ranks.c wants of MPI, loaded when a program has been started by mpirun.
 *
 * Bytes that are sent go on while others are; what has come is asked for, never waited for.
 *
 * Tests  tests/meta/ranks.test
 */
#ifndef QDOT_PARALLEL_MPI_H
#define QDOT_PARALLEL_MPI_H

#include "base/text.h"

/* Load OpenMPI and join the others. QDOT_ENOTBUILT: this program has no MPI; QDOT_EIO: it is not
 * there. The functions below are for after that. */
QDOT_MUST_CHECK qdot_status qdot_mpi_begin(size_t *count, size_t *mine);

/* All ranks call these two, and wait for each other. *x becomes the least of all; rank 0's bytes [n],
 * all bytes [count n] in the order of ranks. */
void qdot_mpi_least(int *x);
void qdot_mpi_gather(const void *bytes, size_t n, void *all);

/* Send copies of the bytes [n < 2 GB] to the ranks first ... end - 1. What cannot be sent is missed by
 * the receiver alone. */
void qdot_mpi_send(size_t first, size_t end, int what, const void *bytes, size_t n);
/* The number of messages that are still being sent. */
size_t qdot_mpi_sending(void);
/* Whether a message has arrived; its sender goes to *from, and its kind to *what. */
bool qdot_mpi_look(size_t *from, int *what);
/* Receive the message that qdot_mpi_look found, into `bytes`, which is emptied first. */
void qdot_mpi_take(size_t from, int what, qdot_text *bytes);

/* End MPI together with all ranks, each of which calls this; qdot_mpi_abort: end all ranks with an exit status. */
void qdot_mpi_finalize(void);
void qdot_mpi_abort(int status) __attribute__((noreturn));

#endif
