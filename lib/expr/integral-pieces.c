/* integral-pieces.c -- splits an integral at the knots of the tables that its integrand reads. */
#include "expr/integral-pieces.h"

#include <float.h>
#include <math.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/elementary.h"
#include "expr/exact.h"
#include "expr/function-ball.h"
#include "expr/integral.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "num/samples.h"

enum { MOST_PIECES = 20000 };

/* One place of reading: the node lookup(u, handle), which finds the piece that holds u = a + b x. */
typedef struct {
    qdot_expr node;
    double a, b, handle;
} place;

typedef struct {
    qdot_pool *pool;
    qdot_expr f, x;
    qdot_status (*number)(qdot_pool *pool, qdot_expr e, double *value);
    qdot_vec(place) places;
    double middle; /* of the present piece */
} splitting;

/* The handle of a node lookup(u, handle); NaN: the node is none. */
static double
handle_of(const qdot_pool *pool, qdot_expr e)
{
    int64_t handle;

    return qdot_expr_is_function(pool, e, QDOT_LOOKUP) && qdot_expr_to_int(pool, qdot_expr_arg(pool, e, 1), &handle) ? (double)handle
                                                                                                                    : NAN;
}

static qdot_status
add_reading(splitting *s, qdot_expr node, double handle)
{
    qdot_pool *pool = s->pool;
    const qdot_expr u = qdot_expr_arg(pool, node, 0), zero = QDOT_ZERO, slope = qdot_diff(pool, u, s->x);
    place new = {.node = node, .handle = handle};

    QDOT_TRY(qdot_pool_check(pool));
    if (qdot_expr_node(pool, u)->holds & QDOT_HAS_BOUND)
        return qdot_fail(QDOT_ENOTBUILT, "not built yet: the number of an integral over an integral of data");
    if (qdot_expr_contains(pool, slope, s->x) || qdot_expr_find_function(pool, u, 1, (qdot_fun_id[]){QDOT_LOOKUP}, QDOT_NIL) != QDOT_NIL) {
        (void)qdot_fail(QDOT_ENOTBUILT, "not built yet: the number of an integral of data at a place that is not linear in the variable");
        return qdot_hint("another variable of integration, of which it is");
    }
    QDOT_TRY(s->number(pool, slope, &new.b));
    QDOT_TRY(s->number(pool, qdot_subs(pool, u, 1, &s->x, &zero), &new.a));
    return qdot_vec_push(&s->places, new);
}

static qdot_status
find_places(splitting *s)
{
    qdot_walk w;
    qdot_status status;

    QDOT_TRY(qdot_walk_begin(s->pool, s->f, &w));
    status = QDOT_OK;
    for (size_t i = 0; i < w.n && status == QDOT_OK; i++) {
        const double handle = handle_of(s->pool, w.at[i]);

        if (qdot_samples_finds(handle))
            status = add_reading(s, w.at[i], handle);
    }
    qdot_walk_end(&w);
    return status;
}

/* Fail if a table has no value at x. */
static qdot_status
check_values_at(const splitting *s, double x)
{
    for (size_t k = 0; k < s->places.n; k++)
        QDOT_TRY(qdot_lookup_check(s->places.at[k].handle, s->places.at[k].a + s->places.at[k].b * x));
    return QDOT_OK;
}

/* The first place above x, at most `end`, at which a table is read at a knot. */
static double
next_cut(const splitting *s, double x, double end)
{
    for (size_t k = 0; k < s->places.n; k++) {
        const place *p = &s->places.at[k];
        /* a rounding above x: x itself may be the knot, or a double beside it */
        const double from = x + 4 * DBL_EPSILON * (fabs(x) + (p->b != 0 ? fabs(p->a / p->b) : 0)) + DBL_MIN;
        double lo, hi, cut;

        qdot_samples_bounds(p->handle, p->a + p->b * from, &lo, &hi);
        cut = p->b == 0 ? INFINITY : ((p->b > 0 ? hi : lo) - p->a) / p->b;
        if (cut > x && cut < end)
            end = cut;
    }
    return end;
}

/* A node lookup(u, handle) in the present piece: what it finds there, as a number. */
static qdot_expr
lookup_in_piece(qdot_pool *pool, qdot_expr e, void *user)
{
    const splitting *s = user;
    const double handle = handle_of(pool, e);
    double u;

    if (isnan(handle))
        return e;
    for (size_t k = 0; k < s->places.n; k++)
        if (s->places.at[k].node == e)
            return qdot_expr_of_double(pool, qdot_samples_lookup(handle, s->places.at[k].a + s->places.at[k].b * s->middle));
    if (qdot_expr_rational(pool, qdot_expr_arg(pool, e, 0)) == NULL)
        return e;
    if (s->number(pool, qdot_expr_arg(pool, e, 0), &u) != QDOT_OK)
        return qdot_pool_fail(pool);
    return qdot_expr_of_double(pool, qdot_samples_lookup(handle, u));
}

/* The integral of f over a piece from a to b, in which it reads no table. */
static qdot_expr
integral_of_piece(splitting *s, qdot_expr f, qdot_expr a, qdot_expr b)
{
    qdot_pool *pool = s->pool;
    const qdot_expr second = qdot_diff(pool, qdot_diff(pool, f, s->x), s->x), h = qdot_sub(pool, b, a);
    const qdot_expr m = qdot_mul(pool, QDOT_HALF, qdot_add(pool, a, b));
    qdot_expr cube;

    if (second == QDOT_NIL || qdot_diff(pool, qdot_diff(pool, second, s->x), s->x) != QDOT_ZERO)
        return qdot_integral(pool, f, s->x, a, b);
    cube = qdot_div(pool, qdot_mul(pool, h, qdot_mul(pool, h, h)), qdot_expr_int(pool, 24));
    return qdot_add(pool, qdot_mul(pool, h, qdot_subs(pool, f, 1, &s->x, &m)),
                    qdot_mul(pool, cube, qdot_subs(pool, second, 1, &s->x, &m)));
}

/* Append the integrals of the pieces between the doubles lo < hi, which stand for a and b. */
static qdot_status
list_pieces(splitting *s, qdot_expr a, double lo, qdot_expr b, double hi, qdot_expr *sum)
{
    qdot_vec(qdot_expr) terms = {0};
    qdot_status status = QDOT_OK;

    for (double x = lo; x < hi && status == QDOT_OK;) {
        const double end = next_cut(s, x, hi);
        const qdot_expr from = x == lo ? a : qdot_expr_of_double(s->pool, x), to = end == hi ? b : qdot_expr_of_double(s->pool, end);

        s->middle = (x + end) / 2;
        status = terms.n == MOST_PIECES ? qdot_fail(QDOT_ELIMIT, "the integral goes over more than %d pieces of the data", MOST_PIECES)
                                        : qdot_vec_push(&terms, integral_of_piece(s, qdot_walk_replace(s->pool, s->f, QDOT_FUN, lookup_in_piece, s),
                                                                                  from, to));
        if (status == QDOT_OK)
            status = qdot_pool_check(s->pool);
        x = end;
    }
    *sum = qdot_sum(s->pool, (uint32_t)terms.n, terms.at);
    qdot_free(terms.at);
    return status != QDOT_OK ? status : qdot_pool_check(s->pool);
}

static qdot_status
split(splitting *s, qdot_expr e, qdot_expr *sum)
{
    const qdot_expr a = qdot_expr_arg(s->pool, e, 1), b = qdot_expr_arg(s->pool, e, 2);
    double lo, hi;

    QDOT_TRY(qdot_pool_check(s->pool));
    QDOT_TRY(find_places(s));
    QDOT_TRY(s->number(s->pool, a, &lo));
    QDOT_TRY(s->number(s->pool, b, &hi));
    QDOT_TRY(check_values_at(s, lo));
    QDOT_TRY(check_values_at(s, hi));
    if (lo <= hi)
        return list_pieces(s, a, lo, b, hi, sum);
    QDOT_TRY(list_pieces(s, b, hi, a, lo, sum));
    *sum = qdot_neg(s->pool, *sum);
    return qdot_pool_check(s->pool);
}

qdot_status
qdot_integral_in_pieces(qdot_pool *pool, qdot_expr e, qdot_status (*number)(qdot_pool *pool, qdot_expr e, double *value),
                        qdot_expr *sum)
{
    splitting s = {.pool = pool, .number = number, .x = qdot_symbol_get(pool, QDOT_FORMAL, "x of the integral")};
    qdot_status status;

    s.f = qdot_integral_open(pool, e, s.x);
    status = split(&s, e, sum);
    qdot_free(s.places.at);
    return status;
}
