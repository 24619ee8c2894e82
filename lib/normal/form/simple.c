/* simple.c -- what is as simple as it can be, or becomes so by one rule, seen at a glance: of the
 * sums that mechanics brings most are of two angles, and need no field. */
#include "normal/form/simple.h"

#include "expr/build.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"

enum { MOST_COLLECTED = 16 };

/* Whether e is a sum a + b + c of parameters. */
static bool
is_plain_sum(const qdot_pool *pool, qdot_expr e)
{
    uint32_t n = qdot_expr_count(pool, e);

    if (qdot_expr_kind(pool, e) != QDOT_SUM || qdot_expr_arg(pool, e, 0) != QDOT_ZERO)
        return false;
    for (uint32_t i = 1; i < n; i += 2)
        if (!qdot_expr_is_class(pool, qdot_expr_arg(pool, e, i), QDOT_PARAM) ||
            qdot_expr_arg(pool, e, i + 1) != QDOT_ONE)
            return false;
    return true;
}

/* Whether e is f(x) with a symbol x. */
static bool
is_plain_function(const qdot_pool *pool, qdot_expr e)
{
    qdot_kind kind = qdot_expr_kind(pool, e);

    return (kind == QDOT_FUN || kind == QDOT_UFUN) && qdot_expr_count(pool, e) <= 2 &&
           qdot_expr_kind(pool, qdot_expr_arg(pool, e, 0)) == QDOT_SYM;
}

/* Whether e is a product of powers of symbols; if all exponents are positive also with one function
 * and one sum, as nothing cancels. */
static bool
is_simple_product(const qdot_pool *pool, qdot_expr e)
{
    int functions = 0, sums = 0;
    bool below = false;
    int64_t k;

    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        qdot_expr b = qdot_expr_arg(pool, e, i);

        if (!qdot_expr_to_int(pool, qdot_expr_arg(pool, e, i + 1), &k))
            return false;
        below |= k < 0;
        if (qdot_expr_kind(pool, b) == QDOT_SYM)
            continue;
        functions += is_plain_function(pool, b);
        sums += is_plain_sum(pool, b);
        if (k != 1 || (!is_plain_function(pool, b) && !is_plain_sum(pool, b)))
            return false;
    }
    return functions <= 1 && sums <= 1 && (functions + sums == 0 || !below);
}

/* --- distances ---------------------------------------------------------------------------- */

/* The symbols of the components of a distance, each of which stands in one alone. */
typedef struct {
    qdot_expr symbol[MOST_COLLECTED];
    uint32_t n;
} component_symbols;

static bool
take_symbol(const qdot_pool *pool, component_symbols *s, qdot_expr symbol)
{
    if (qdot_expr_kind(pool, symbol) != QDOT_SYM || s->n == MOST_COLLECTED)
        return false;
    for (uint32_t i = 0; i < s->n; i++)
        if (s->symbol[i] == symbol)
            return false;
    s->symbol[s->n++] = symbol;
    return true;
}

/* Whether e is u^2 with a symbol u, or a sum u of symbols with factors 1 and -1. */
static bool
is_squared_component(const qdot_pool *pool, qdot_expr e, component_symbols *s)
{
    qdot_expr u;
    int64_t k;

    if (qdot_expr_kind(pool, e) != QDOT_PROD || qdot_expr_count(pool, e) != 3 ||
        qdot_expr_arg(pool, e, 0) != QDOT_ONE || !qdot_expr_to_int(pool, qdot_expr_arg(pool, e, 2), &k) || k != 2)
        return false;
    u = qdot_expr_arg(pool, e, 1);
    if (qdot_expr_kind(pool, u) != QDOT_SUM)
        return take_symbol(pool, s, u);
    if (qdot_expr_arg(pool, u, 0) != QDOT_ZERO)
        return false;
    for (uint32_t i = 1; i < qdot_expr_count(pool, u); i += 2)
        if ((qdot_expr_arg(pool, u, i + 1) != QDOT_ONE && qdot_expr_arg(pool, u, i + 1) != QDOT_MINUS_ONE) ||
            !take_symbol(pool, s, qdot_expr_arg(pool, u, i)))
            return false;
    return true;
}

/* Whether e is sqrt(u^2 + v^2 + ...) of such components, two or more: nothing in it cancels. */
static bool
is_distance(const qdot_pool *pool, qdot_expr e)
{
    component_symbols s = {.n = 0};
    qdot_expr sum;

    if (qdot_expr_kind(pool, e) != QDOT_PROD || qdot_expr_count(pool, e) != 3 ||
        qdot_expr_arg(pool, e, 0) != QDOT_ONE || qdot_expr_arg(pool, e, 2) != QDOT_HALF)
        return false;
    sum = qdot_expr_arg(pool, e, 1);
    if (qdot_expr_kind(pool, sum) != QDOT_SUM || qdot_expr_arg(pool, sum, 0) != QDOT_ZERO ||
        qdot_expr_count(pool, sum) < 5)
        return false;
    for (uint32_t i = 1; i < qdot_expr_count(pool, sum); i += 2)
        if (qdot_expr_arg(pool, sum, i + 1) != QDOT_ONE || !is_squared_component(pool, qdot_expr_arg(pool, sum, i), &s))
            return false;
    return true;
}

/* --- sums collected in velocities -------------------------------------------------------- */

#define FAST (QDOT_HAS_VELOCITY | QDOT_HAS_ACCELERATION)

/* Whether e is the sine or cosine of a coordinate or of the difference of two. */
static bool
is_angle_function(const qdot_pool *pool, qdot_expr e)
{
    unsigned op = qdot_expr_node(pool, e)->op;
    qdot_expr a;

    if (qdot_expr_kind(pool, e) != QDOT_FUN || (op != QDOT_SIN && op != QDOT_COS))
        return false;
    a = qdot_expr_arg(pool, e, 0);
    if (qdot_expr_kind(pool, a) != QDOT_SUM)
        return qdot_expr_is_coordinate(pool, a);
    return qdot_expr_count(pool, a) == 5 && qdot_expr_arg(pool, a, 0) == QDOT_ZERO &&
           qdot_expr_is_coordinate(pool, qdot_expr_arg(pool, a, 1)) &&
           qdot_expr_is_coordinate(pool, qdot_expr_arg(pool, a, 3)) &&
           qdot_expr_arg(pool, a, 2) ==
               (qdot_expr_arg(pool, a, 4) == QDOT_ONE ? QDOT_MINUS_ONE : QDOT_ONE);
}

/* A term c w f(angle) of symbols, one sum of parameters at most, and one velocity or acceleration w, to
 * whatever power: *fast. */
static bool
read_collected_term(const qdot_pool *pool, qdot_expr t, qdot_expr *fast, qdot_expr *power)
{
    int functions = 0, sums = 0, moving = 0;
    int64_t k;

    if (qdot_expr_kind(pool, t) != QDOT_PROD)
        return false;
    for (uint32_t i = 1; i < qdot_expr_count(pool, t); i += 2) {
        qdot_expr b = qdot_expr_arg(pool, t, i);

        if (!qdot_expr_to_int(pool, qdot_expr_arg(pool, t, i + 1), &k) || k < 1)
            return false;
        if (qdot_expr_node(pool, b)->holds & FAST) {
            *fast = b;
            *power = qdot_expr_arg(pool, t, i + 1);
            moving++;
        } else if (is_plain_sum(pool, b)) {
            sums++;
        } else if (is_angle_function(pool, b)) {
            functions += (int)k;
        } else if (!qdot_expr_is_class(pool, b, QDOT_PARAM)) {
            return false;
        }
    }
    return moving == 1 && qdot_expr_kind(pool, *fast) == QDOT_SYM && sums <= 1 &&
           functions <= 1;
}

bool
qdot_simple_is_collected(const qdot_pool *pool, qdot_expr e)
{
    qdot_expr fast[2 * MOST_COLLECTED];
    uint32_t n = qdot_expr_count(pool, e) / 2;

    if (qdot_expr_kind(pool, e) != QDOT_SUM || qdot_expr_arg(pool, e, 0) != QDOT_ZERO ||
        n < 2 || n > MOST_COLLECTED)
        return false;
    for (uint32_t i = 0; i < n; i++) {
        if (!read_collected_term(pool, qdot_expr_arg(pool, e, 1 + 2 * i), &fast[2 * i],
                                 &fast[2 * i + 1]))
            return false;
        for (uint32_t j = 0; j < i; j++)
            if (fast[2 * i] == fast[2 * j] && fast[2 * i + 1] == fast[2 * j + 1])
                return false;
    }
    return true;
}

bool
qdot_simple_is_done(const qdot_pool *pool, qdot_expr e)
{
    switch (qdot_expr_kind(pool, e)) {
    case QDOT_NUM:
    case QDOT_SYM: return true;
    case QDOT_INTEGRAL: return false;
    case QDOT_FUN:
    case QDOT_UFUN: return is_plain_function(pool, e);
    case QDOT_PROD: return is_simple_product(pool, e) || is_distance(pool, e);
    default: return is_plain_sum(pool, e);
    }
}

/* --- sums of two angles --------------------------------------------------------------------- */

/* A product of powers of symbols and of two sines and cosines of coordinates. */
typedef struct {
    qdot_expr angle[2]; /* the arguments of the two functions, in the order of the product; equal for a square */
    bool sine[2];
    uint32_t at[2]; /* positions of the two functions in the product */
} two_angles;

static bool
read_two_angle_term(const qdot_pool *pool, qdot_expr e, two_angles *t)
{
    uint32_t found = 0;
    int64_t k;

    if (qdot_expr_kind(pool, e) != QDOT_PROD)
        return false;
    for (uint32_t i = 1; i < qdot_expr_count(pool, e); i += 2) {
        qdot_expr b = qdot_expr_arg(pool, e, i);
        const qdot_node *node = qdot_expr_node(pool, b);

        if (!qdot_expr_to_int(pool, qdot_expr_arg(pool, e, i + 1), &k))
            return false;
        if (node->kind == QDOT_SYM)
            continue;
        if (node->kind != QDOT_FUN || (node->op != QDOT_SIN && node->op != QDOT_COS) ||
            !qdot_expr_is_coordinate(pool, qdot_expr_arg(pool, b, 0)) || k < 1 ||
            found + k > 2)
            return false;
        for (; k > 0; k--, found++) {
            t->angle[found] = qdot_expr_arg(pool, b, 0);
            t->sine[found] = node->op == QDOT_SIN;
            t->at[found] = i;
        }
    }
    return found == 2;
}

/* The common powers of symbols in two terms, *product; false if the terms contain different ones. */
static bool
common_powers(qdot_pool *pool, qdot_expr term, const two_angles *t, qdot_expr other,
              const two_angles *u, qdot_expr *product)
{
    uint32_t i = 1, j = 1, n = qdot_expr_count(pool, term),
             m = qdot_expr_count(pool, other);

    *product = QDOT_ONE;
    for (;;) {
        qdot_expr b, x;

        while (i < n && (i == t->at[0] || i == t->at[1]))
            i += 2;
        while (j < m && (j == u->at[0] || j == u->at[1]))
            j += 2;
        if (i >= n || j >= m)
            return i >= n && j >= m;
        b = qdot_expr_arg(pool, term, i);
        x = qdot_expr_arg(pool, term, i + 1);
        if (b != qdot_expr_arg(pool, other, j) || x != qdot_expr_arg(pool, other, j + 1))
            return false;
        *product = qdot_mul(pool, *product, qdot_pow(pool, b, x));
        i += 2;
        j += 2;
    }
}

/* Rewrite sums such as P cos(a) cos(b) + P sin(a) sin(b) as P cos(a - b); nil if e is not such a sum. */
static qdot_expr
contract_angle_sum(qdot_pool *pool, qdot_expr e)
{
    qdot_expr term[2], c[2], front, turn;
    two_angles t, u;
    bool same, swapped;

    if (qdot_expr_kind(pool, e) != QDOT_SUM || qdot_expr_count(pool, e) != 5 ||
        qdot_expr_arg(pool, e, 0) != QDOT_ZERO)
        return QDOT_NIL;
    for (uint32_t i = 0; i < 2; i++) {
        term[i] = qdot_expr_arg(pool, e, 1 + 2 * i);
        c[i] = qdot_expr_arg(pool, e, 2 + 2 * i);
    }
    if (!read_two_angle_term(pool, term[0], &t) || !read_two_angle_term(pool, term[1], &u))
        return QDOT_NIL;
    swapped = u.angle[0] != t.angle[0];
    if (u.angle[swapped] != t.angle[0] || u.angle[!swapped] != t.angle[1] ||
        u.sine[swapped] == t.sine[0] || u.sine[!swapped] == t.sine[1])
        return QDOT_NIL;
    same = c[0] == c[1];
    if (!same && c[1] != qdot_neg(pool, c[0]))
        return QDOT_NIL;
    if (t.angle[0] == t.angle[1] && (!same || t.sine[0] != t.sine[1]))
        return QDOT_NIL; /* leave sin a cos a to the code that treats double angles */
    if (!common_powers(pool, term[0], &t, term[1], &u, &front))
        return QDOT_NIL;
    if (t.angle[0] == t.angle[1])
        return qdot_mul(pool, c[0], front);
    if (t.sine[0] == t.sine[1]) { /* the sum is cos a cos b +- sin a sin b */
        turn = same ? qdot_sub(pool, t.angle[0], t.angle[1])
                    : qdot_add(pool, t.angle[0], t.angle[1]);
        turn = qdot_fun1(pool, QDOT_COS, turn);
        front = qdot_mul(pool, c[t.sine[0]], front);
    } else { /* the sum is sin a cos b +- cos a sin b */
        turn = same ? qdot_add(pool, t.angle[0], t.angle[1])
                    : qdot_sub(pool, t.angle[!t.sine[0]], t.angle[t.sine[0]]);
        turn = qdot_fun1(pool, QDOT_SIN, turn);
        front = qdot_mul(pool, c[0], front);
    }
    return qdot_mul(pool, front, turn);
}

qdot_expr
qdot_simple_seen(qdot_pool *pool, qdot_expr e)
{
    return qdot_simple_is_done(pool, e) ? e : contract_angle_sum(pool, e);
}
