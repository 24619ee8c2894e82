/* scale.c -- the statement `scale`: the sizes of coordinates to which tolerances and errors are relative. */
#include "expr/symbol.h"
#include "lang/commands/pairs.h"
#include "lang/commands/set.h"
#include "lang/session/scales.h"

static qdot_status carry_out_scale(qdot_record *r);

QDOT_STATEMENT(scale) = {
    .word = "scale",
    .group = QDOT_NUMBERS,
    .usage = "scale Q = VALUE, t = VALUE, ...",
    .summary = "the typical size of a coordinate: tol and errors are relative to max(scale, |value|); "
               "a scale of t sets those of velocities; without, a run finds scales below 1e-3",
    .example = "scale x = 1e-10, t = 1e-16",
    .handler = carry_out_scale,
};

/* Read a pair such as q = 0.1, q' = 1 or t = 2 at `part`: the symbol, and its value. */
static qdot_status
read_scale(qdot_record *r, const qdot_filled *part, qdot_pairs *list)
{
    qdot_session *session = r->cursor.session;
    qdot_expr symbol = QDOT_T, value = QDOT_NIL;

    if (qdot_filled_is(part, "Q"))
        QDOT_TRY(qdot_record_coordinate(r, part, &symbol));
    if (symbol != QDOT_T && qdot_expr_symbol(session->pool, symbol)->order > 1) {
        qdot_record_blame(r, part);
        return qdot_fail(QDOT_EINVAL,
                         "a scale is that of a coordinate, a velocity or of t");
    }
    QDOT_TRY(qdot_set_find_constant(r, qdot_record_next(r, part, "VALUE"), symbol, &value));
    qdot_record_blame(r, part);
    QDOT_TRY(qdot_scales_check(session, symbol, value));
    return qdot_pairs_push(list, part->from, symbol, value);
}

static qdot_status
carry_out_scale(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    qdot_status status = QDOT_OK;
    qdot_pairs list = {0};

    for (size_t i = 1; i < r->parts.n && status == QDOT_OK; i++)
        if (qdot_filled_is(&r->parts.at[i], "Q") || qdot_filled_is(&r->parts.at[i], "t"))
            status = read_scale(r, &r->parts.at[i], &list);
    for (size_t i = 0; i < list.symbols.n && status == QDOT_OK; i++)
        status = qdot_scales_set(session, list.symbols.at[i], list.values.at[i]);
    qdot_pairs_free(&list);
    return status;
}
