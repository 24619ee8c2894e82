/* series.c -- series(E, x = a, ..., n): reads its arguments, and stores the Taylor series for printing by degree. */
#include "lang/functions/builtin.h"

#include <inttypes.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/node.h"
#include "expr/value-kind.h"
#include "lang/functions/algebra.h"
#include "lang/session/bind.h"
#include "lang/session/history.h"
#include "lang/session/momenta.h"
#include "mech/scene/things.h"
#include "normal/calculus/series.h"

/* Read equations x = a as symbols and expansion points. */
static qdot_status
read_expansion_point(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_replacements *r)
{
    for (uint32_t i = 0; i < n; i++)
        QDOT_TRY(qdot_algebra_gather(s, "series", args[i], r));
    for (size_t i = 0; i < r->from.n; i++)
        if (qdot_expr_kind(s->pool, r->from.at[i]) != QDOT_SYM)
            return qdot_fail(QDOT_ETYPE, "a series is in symbols: series(e, x = a, n)");
    return QDOT_OK;
}

static qdot_status
expand_in_series(qdot_session *s, qdot_expr e, uint32_t n, const qdot_expr *args, int64_t most,
                 qdot_expr *value)
{
    const qdot_facts facts = qdot_scene_facts(s->scene);
    qdot_replacements r = {0};
    qdot_status status = read_expansion_point(s, n, args, &r);

    for (size_t i = 0; i < r.from.n && status == QDOT_OK; i++)
        e = qdot_momenta_for(s, e, r.from.at[i]);
    if (status == QDOT_OK) {
        status = qdot_series(s->pool, &facts, e, r.from.n, r.from.at, r.to.at, most, value);
        s->history->series_in = qdot_list(s->pool, (uint32_t)r.from.n, r.from.at);
    }
    qdot_algebra_drop(&r);
    return status;
}

/* Evaluate series(e, x = a, y = b, n); a list member by member. */
qdot_status
qdot_call_series(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    bool list = qdot_expr_kind(s->pool, args[0]) == QDOT_LIST;
    uint32_t count = list ? qdot_expr_count(s->pool, args[0]) : 1;
    qdot_expr *members;
    qdot_status status = QDOT_OK;
    int64_t most;

    QDOT_TRY(qdot_session_integer(s, args[n - 1], &most));
    if (most < 0 || most > 1000)
        return qdot_fail(QDOT_EDOMAIN, "a series goes up to degree 0 ... 1000, not %" PRId64,
                         most);
    members = qdot_malloc((count + 1) * sizeof *members);
    if (members == NULL)
        return QDOT_ENOMEM;
    for (uint32_t i = 0; i < count && status == QDOT_OK; i++)
        status = expand_in_series(s, list ? qdot_expr_arg(s->pool, args[0], i) : args[0], n - 2,
                                  args + 1, most, &members[i]);
    if (status == QDOT_OK)
        *value = list ? qdot_list(s->pool, count, members) : members[0];
    if (status == QDOT_OK)
        status = qdot_value_kind_check(s->pool, *value);
    if (status == QDOT_OK)
        s->history->series = *value;
    qdot_free(members);
    return status;
}
