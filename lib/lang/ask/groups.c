/* groups.c -- the statement `groups`: dimensionless groups of the parameters (Buckingham's theorem). */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "lang/answer/answer.h"
#include "lang/answer/write.h"
#include "lang/ask/ask.h"
#include "lang/session/history.h"
#include "lang/session/names.h"
#include "lang/session/units.h"
#include "lang/syntax/record.h"

static qdot_status carry_out_groups(qdot_record *r);

QDOT_STATEMENT(groups) = {
    .word = "groups",
    .group = QDOT_ASKING,
    .usage = "groups [EXPR, ...]",
    .summary = "a basis of the products of powers without dimension, of the parameters or of what is named; each other "
               "such product is one of these",
    .example = "groups",
    .nameable = true,
    .handler = carry_out_groups,
};

typedef qdot_vec(qdot_expr) quantities;

/* What the statement names; without, all parameters. */
static qdot_status
read_quantities(qdot_record *r, quantities *x)
{
    qdot_session *session = r->cursor.session;
    const qdot_name *name;
    qdot_expr value;

    for (size_t i = 1; i < r->parts.n; i++) {
        if (r->parts.at[i].node->kind != QDOT_USAGE_HOLE)
            continue;
        QDOT_TRY(qdot_record_scalar(r, &r->parts.at[i], &value));
        QDOT_TRY(qdot_vec_push(x, value));
    }
    for (size_t i = 0; r->parts.n <= 1 && (name = qdot_names_at(session->names, i)) != NULL; i++)
        if (name->kind == QDOT_NAME_PARAM)
            QDOT_TRY(qdot_vec_push(x, name->value));
    return QDOT_OK;
}

/* Notice which dimensions are not determined. */
static qdot_status
give_notice_of_free(qdot_session *session, const quantities *x)
{
    qdot_dimension is;

    for (size_t i = 0; i < x->n; i++)
        if (qdot_units_of(session, x->at[i], &is) == QDOT_DIMENSION_FREE)
            QDOT_TRY(qdot_answer_notice_of(session, "the dimension of %s is not determined: it counts as one of its own",
                                           x->at[i]));
    return QDOT_OK;
}

static qdot_status
answer_groups(qdot_session *session, const quantities *x)
{
    qdot_pool *pool = session->pool;
    qdot_vec(qdot_expr) groups = {0};
    qdot_expr list;
    int32_t *power = NULL;
    size_t count;
    qdot_status status = qdot_units_groups(session, x->n, x->at, &count, &power);

    for (size_t k = 0; k < count && status == QDOT_OK; k++) {
        qdot_expr product = QDOT_ONE;

        for (size_t i = 0; i < x->n; i++)
            product = qdot_mul(pool, product, qdot_pow(pool, x->at[i], qdot_expr_int(pool, power[k * x->n + i])));
        status = qdot_vec_push(&groups, product);
    }
    qdot_free(power);
    list = status == QDOT_OK ? qdot_list(pool, (uint32_t)groups.n, groups.at) : QDOT_NIL;
    qdot_free(groups.at);
    QDOT_TRY(status);
    QDOT_TRY(qdot_pool_check(pool));
    QDOT_TRY(qdot_session_remember(session, list, QDOT_NIL));
    return count == 0 ? qdot_answer_text(session, "groups", "there is none: no product of powers of these is without dimension")
                      : qdot_ask_list(session, "groups", list, QDOT_NIL);
}

static qdot_status
carry_out_groups(qdot_record *r)
{
    qdot_session *session = r->cursor.session;
    quantities x = {0};
    qdot_status status = read_quantities(r, &x);

    if (status == QDOT_OK && !qdot_units_on(session)) {
        r->cursor.error_at = r->start->start;
        (void)qdot_fail(QDOT_EINVAL, "no unit has been written");
        status = qdot_hint("declare units, as in `param m > 0 [kg], l > 0 [m], g [m/s^2]`");
    }
    if (status == QDOT_OK)
        status = give_notice_of_free(session, &x);
    if (status == QDOT_OK)
        status = answer_groups(session, &x);
    qdot_free(x.at);
    return status;
}
