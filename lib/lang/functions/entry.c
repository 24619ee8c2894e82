/* entry.c -- finds an entry of a value by its indices, and writes the name of a family member. */
#include "lang/functions/entry.h"

#include <inttypes.h>

#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/tensor.h"
#include "expr/value-kind.h"
#include "lang/session/bind.h"

qdot_status
qdot_entry_name(qdot_session *session, const char *name, uint32_t n,
                const qdot_expr *index, qdot_text *member)
{
    qdot_text_add(member, name);
    for (uint32_t i = 0; i < n; i++) {
        int64_t k;

        QDOT_TRY(qdot_session_integer(session, index[i], &k));
        qdot_text_format(member, "%c%" PRId64, i == 0 ? '[' : ',', k);
    }
    if (n > 0)
        qdot_text_char(member, ']');
    return qdot_text_status(member);
}

/* Find an index as a number from 1: an integer, or a coordinate if entries are indexed by coordinates. */
static qdot_status
index_as_number(qdot_session *s, qdot_expr over, qdot_expr index, int64_t *i)
{
    if (qdot_expr_is_coordinate(s->pool, index) || (index == QDOT_T && over != QDOT_NIL)) {
        for (uint32_t k = 0; over != QDOT_NIL && k < qdot_expr_count(s->pool, over); k++)
            if (qdot_expr_arg(s->pool, over, k) == index) {
                *i = (int64_t)k + 1;
                return QDOT_OK;
            }
        if (over != QDOT_NIL)
            return qdot_fail(QDOT_ETYPE, "`%.200s` is none of its coordinates", qdot_expr_symbol(s->pool, index)->name);
        (void)qdot_fail(QDOT_ETYPE, "entries are counted from 1: `%.200s` is no index", qdot_expr_symbol(s->pool, index)->name);
        return qdot_hint("as in [1]");
    }
    return qdot_session_integer(s, index, i);
}

qdot_status
qdot_entry_of(qdot_session *session, qdot_expr e, qdot_expr over, uint32_t n,
              const qdot_expr *index, qdot_expr *value)
{
    qdot_pool *pool = session->pool;
    int64_t i, j;

    *value = e;
    for (uint32_t k = 0; k < n;) {
        switch (qdot_expr_kind(pool, *value)) {
        case QDOT_MAT:
            if (k + 1 >= n) {
                qdot_fail(QDOT_ETYPE, "an entry of a matrix has two indices");
                return qdot_hint("as in [1, 2]: its row, then its column");
            }
            QDOT_TRY(index_as_number(session, over, index[k], &i));
            QDOT_TRY(index_as_number(session, over, index[k + 1], &j));
            *value = qdot_entry2(pool, *value, i, j);
            k += 2;
            break;
        case QDOT_VEC:
        case QDOT_LIST:
            QDOT_TRY(index_as_number(session, over, index[k], &i));
            *value = qdot_entry(pool, *value, i);
            k++;
            break;
        default:
            return qdot_fail(QDOT_ETYPE, "%s has no entries",
                             qdot_value_kind_words(pool, *value));
        }
        QDOT_TRY(qdot_value_kind_check(pool, *value));
    }
    return QDOT_OK;
}
