/* memo.c -- a table, in the pool, of stored answers to questions about expressions. */
#include "expr/memo.h"

#include <string.h>

#include "base/scope.h"
#include "expr/pool.h"

enum { SLOTS = 4096 };

struct qdot_memo {
    qdot_expr question; /* the expression asked about; nil: this slot is free */
    uint32_t asked, stamp;
    _Alignas(max_align_t) unsigned char answer[QDOT_MEMO_BYTES];
};

static size_t
find_slot_of_question(qdot_expr question, uint32_t asked)
{
    return (question * 2654435761u ^ asked * 40503u) >> 7 & (SLOTS - 1);
}

bool
qdot_memo_find(const qdot_pool *pool, qdot_expr question, uint32_t asked, void *answer, size_t size)
{
    const qdot_memo *m = pool->memo == NULL ? NULL : &pool->memo[find_slot_of_question(question, asked)];

    if (m == NULL || question == QDOT_NIL || pool->budget != UINT64_MAX || m->question != question ||
        m->asked != asked || m->stamp != pool->domains)
        return false;
    memcpy(answer, m->answer, size);
    return true;
}

void
qdot_memo_keep(qdot_pool *pool, qdot_expr question, uint32_t asked, const void *answer, size_t size)
{
    qdot_memo *m;

    if (question == QDOT_NIL || pool->budget != UINT64_MAX)
        return;
    if (pool->memo == NULL) {
        /* do not record this memory in the present scope, because the pool outlives the scope */
        qdot_scope *scope = qdot_scope_pause();

        pool->memo = qdot_calloc(SLOTS, sizeof *pool->memo);
        qdot_scope_resume(scope);
    }
    if (pool->memo == NULL)
        return;
    m = &pool->memo[find_slot_of_question(question, asked)];
    *m = (qdot_memo){.question = question, .asked = asked, .stamp = pool->domains};
    memcpy(m->answer, answer, size);
}
