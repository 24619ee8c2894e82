/* process.c -- the number of this process among the ranks that mpirun started. */
#include "base/process.h"

#include <stdlib.h>
#include <string.h>

bool qdot_threads_are_taken = !QDOT_MAY_THREAD;

static struct {
    size_t rank, count;
} process = {.count = 1};

bool
qdot_ranks_are_there(void)
{
    return getenv("OMPI_COMM_WORLD_SIZE") != NULL || getenv("PMIX_RANK") != NULL;
}

bool
qdot_ranks_are_others(void)
{
    const char *rank = getenv("OMPI_COMM_WORLD_RANK");

    return rank != NULL && strcmp(rank, "0") != 0;
}

size_t
qdot_ranks_count(void)
{
    return process.count;
}

size_t
qdot_rank(void)
{
    return process.rank;
}

void
qdot_rank_set(size_t rank, size_t count)
{
    process.rank = rank;
    process.count = count;
}
