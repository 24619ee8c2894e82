/* frequency-response.c -- the function frequency_response(G, w): a quotient of polynomials in s at s = i w, as the list of its
 * real and imaginary part. */
#include "expr/build.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/value-kind.h"
#include "lang/functions/builtin.h"
#include "lang/functions/quotient.h"
#include "mech/scene/things.h"
#include "normal/simplify/simplify.h"

/* The real (part 0) or imaginary part (1) of a polynomial at i w. */
static qdot_expr
part_of_polynomial(qdot_pool *pool, const qdot_coefficients *c, qdot_expr w, size_t part)
{
    qdot_expr sum = QDOT_ZERO;

    for (size_t k = part; k < c->n; k += 2) {
        const qdot_expr term = qdot_mul(pool, c->at[k], qdot_pow_int(pool, w, (int64_t)k));

        sum = k / 2 % 2 == 0 ? qdot_add(pool, sum, term) : qdot_sub(pool, sum, term);
    }
    return sum;
}

/* (a + i b)/(c + i d). */
static qdot_expr
quotient_of_complex(qdot_pool *pool, qdot_expr a, qdot_expr b, qdot_expr c, qdot_expr d, const qdot_facts *facts)
{
    const qdot_expr square = qdot_add(pool, qdot_mul(pool, c, c), qdot_mul(pool, d, d)),
                    re = qdot_add(pool, qdot_mul(pool, a, c), qdot_mul(pool, b, d)),
                    im = qdot_sub(pool, qdot_mul(pool, b, c), qdot_mul(pool, a, d));
    const qdot_expr parts[2] = {qdot_simplify(pool, qdot_div(pool, re, square), facts),
                                qdot_simplify(pool, qdot_div(pool, im, square), facts)};

    return qdot_list(pool, 2, parts);
}

qdot_status
qdot_call_frequency_response(qdot_session *s, uint32_t n, const qdot_expr *args, qdot_expr *value)
{
    const qdot_facts facts = qdot_scene_facts(s->scene);
    qdot_quotient G = {0};
    qdot_status status;

    (void)n;
    if (!qdot_expr_is_scalar(s->pool, args[0]) || !qdot_expr_is_scalar(s->pool, args[1])) {
        (void)qdot_fail(QDOT_ETYPE, "frequency_response(G, w) takes a quotient of polynomials in s and a frequency");
        return qdot_hint("frequency_response(transfer(F, x), 2)");
    }
    status = qdot_quotient_of(s, args[0], qdot_quotient_laplace(s), &G);
    if (status == QDOT_OK)
        status = qdot_value_kind_give(s->pool,
                                      quotient_of_complex(s->pool, part_of_polynomial(s->pool, &G.top, args[1], 0),
                                                          part_of_polynomial(s->pool, &G.top, args[1], 1),
                                                          part_of_polynomial(s->pool, &G.bottom, args[1], 0),
                                                          part_of_polynomial(s->pool, &G.bottom, args[1], 1), &facts),
                                      value);
    qdot_quotient_clear(&G);
    return status;
}
