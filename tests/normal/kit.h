/* kit.h -- a pool of its own around every test; expressions of it in text. */
#ifndef QDOT_TESTS_NORMAL_KIT_H
#define QDOT_TESTS_NORMAL_KIT_H

#include "normal/text.h"

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

/* The text of e, which the next call overwrites. */
static inline const char *
shown(qdot_expr e)
{
    static qdot_text out;

    qdot_text_clear(&out);
    if (e == QDOT_NIL)
        return "nil";
    if (qdot_print(pool, e, QDOT_PLAIN, &out) != QDOT_OK)
        abort();
    return qdot_text_str(&out);
}

#endif
