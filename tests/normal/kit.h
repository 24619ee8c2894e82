/* kit.h -- a pool of its own around every test. */
#ifndef QDOT_TESTS_NORMAL_KIT_H
#define QDOT_TESTS_NORMAL_KIT_H

#include "text.h"

static qdot_pool *pool;

static inline int
open_pool(void **state)
{
    (void)state;
    pool = qdot_pool_new();
    return pool == NULL;
}

static inline int
close_pool(void **state)
{
    (void)state;
    qdot_pool_free(pool);
    return 0;
}

#endif
