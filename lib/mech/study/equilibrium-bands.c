/* equilibrium-bands.c -- the intervals of one coordinate in which relations hold, between their zeros. */
#include "mech/study/equilibrium-bands.h"

#include <math.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "mech/dynamics/generic.h"
#include "mech/study/equilibrium-search.h"
#include "normal/refute/ball.h"
#include "normal/refute/constant.h"
#include "normal/simplify/positive.h"
#include "normal/simplify/simplify.h"
#include "normal/solve/conditions.h"
#include "normal/solve/solve.h"
#include "normal/solve/zeros.h"

enum { MOST_RELATIONS = 30, MOST_POINTS = 64, BUDGET = 20000 };

/* A zero of some of the functions g: exact, or nil if it is known only numerically. */
typedef struct {
    qdot_expr exact;
    double at;
    uint32_t zero_of; /* bits: which functions g are 0 there */
} point;

typedef struct {
    qdot_pool *pool;
    const qdot_facts *facts;
    qdot_expr u;
    qdot_expr g[MOST_RELATIONS]; /* functions that are positive where the relations hold */
    bool strict[MOST_RELATIONS];
    size_t relations;
    bool turn; /* u is an angle without declared domain: period 2 pi */
    point at[MOST_POINTS];
    size_t points;
} line;

typedef enum { NO, YES, UNKNOWN } answer;

static bool
depends_on_u_alone(const line *l, qdot_expr e)
{
    qdot_expr atoms = qdot_expr_atoms(l->pool, e, true);

    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(l->pool, atoms); i++) {
        qdot_expr x = qdot_expr_arg(l->pool, atoms, i);

        if (x != l->u && !qdot_expr_is_class(l->pool, x, QDOT_CONST))
            return false;
    }
    return atoms != QDOT_NIL;
}

/* --- zeros of the relations ------------------------------------------------------------- */

/* Add a zero of the relations `which`; false if it is too near another zero to be told from it. */
static bool
add_zero(line *l, qdot_expr exact, double at, uint32_t which)
{
    for (size_t i = 0; i < l->points; i++) {
        qdot_constant_sign sign = QDOT_CONSTANT_UNKNOWN;

        if (fabs(l->at[i].at - at) > 1e-9 * fmax(1, fabs(at)))
            continue;
        if (exact != QDOT_NIL && l->at[i].exact != QDOT_NIL &&
            qdot_constant_decide(l->pool, qdot_sub(l->pool, exact, l->at[i].exact), &sign) !=
                QDOT_OK)
            return false;
        if (sign != QDOT_CONSTANT_ZERO)
            return false;
        l->at[i].zero_of |= which;
        return true;
    }
    if (l->points == MOST_POINTS)
        return false;
    l->at[l->points++] = (point){exact, at, which};
    return true;
}

static bool
add_exact_zero(line *l, qdot_expr value, uint32_t which)
{
    double at;

    return qdot_expr_is_constant(l->pool, value) &&
           qdot_ball_double(l->pool, value, NULL, NULL, &at) && add_zero(l, value, at, which);
}

/* Add the zeros of g by formulas; *all: they are proved to be all. */
static qdot_status
add_exact_zeros(line *l, qdot_expr g, uint32_t which, bool *all)
{
    size_t had = l->points;
    const qdot_symbol *u = qdot_expr_symbol(l->pool, l->u);
    qdot_solutions found;
    qdot_status status = qdot_solve_inside(l->pool, g, l->u, QDOT_NIL, l->facts, &found);

    *all = status == QDOT_OK && found.complete && found.divisor.n == 0;
    for (size_t i = 0; i < found.root.n && *all; i++) {
        const qdot_root *root = &found.root.at[i];

        *all = root->condition == QDOT_NIL && root->period == QDOT_NIL &&
               root->members == QDOT_NIL && root->value != l->u &&
               add_exact_zero(l, root->value, which);
    }
    /* the formulas list the zeros of a periodic function within one period only, so that others may be missing */
    if (*all && !l->turn && found.root.n > 0 && (u->lo == QDOT_NIL || u->hi == QDOT_NIL))
        *all = !qdot_is_angle(l->pool, g, l->u, l->facts);
    qdot_solutions_clear(&found);
    if (!*all)
        l->points = had;
    return status == QDOT_EDOMAIN ? QDOT_OK : status;
}

/* Find the zeros of g numerically, by excluding intervals without one. */
static qdot_status
add_numeric_zeros(line *l, qdot_expr g, uint32_t which, bool *all)
{
    const qdot_symbol *u = qdot_expr_symbol(l->pool, l->u);
    qdot_zeros_range range = {.lo = u->lo, .hi = u->hi, .lo_open = u->lo_open, .hi_open = u->hi_open,
                              .turn = l->turn};
    qdot_zeros zeros;
    qdot_status status =
        qdot_zeros_find(l->pool, 1, &g, &l->u, &range, BUDGET, &zeros);

    *all = false;
    if (status == QDOT_ETYPE || status == QDOT_EDOMAIN)
        return QDOT_OK;
    QDOT_TRY(status);
    *all = zeros.complete;
    for (size_t i = 0; i < zeros.count && *all; i++)
        *all = qdot_rest_is_sharp(1, zeros.at + i, zeros.radius + i) &&
               add_zero(l, QDOT_NIL, zeros.at[i], which);
    qdot_zeros_clear(&zeros);
    return QDOT_OK;
}

static qdot_status
add_all_zeros(line *l, qdot_expr g, uint32_t which, bool *all)
{
    *all = true;
    if (!qdot_expr_contains(l->pool, g, l->u))
        return QDOT_OK;
    QDOT_TRY(add_exact_zeros(l, g, which, all));
    return *all ? QDOT_OK : add_numeric_zeros(l, g, which, all);
}

/* Where g may change its sign without a zero: at zeros of denominators. *known: it has no other such place
 * inside its domain. */
static qdot_status
find_sign_changes_at_poles(line *l, qdot_expr g, bool *known)
{
    qdot_pool *pool = l->pool;
    qdot_walk w;
    qdot_status status = QDOT_OK;

    QDOT_TRY(qdot_walk_begin(pool, g, &w));
    for (size_t i = 0; i < w.n && *known && status == QDOT_OK; i++) {
        qdot_expr node = w.at[i];
        qdot_kind kind = qdot_expr_kind(pool, node);

        if (!qdot_expr_contains(pool, node, l->u))
            continue;
        if (kind == QDOT_FUN) {
            uint32_t op = qdot_expr_node(pool, node)->op;

            *known = op == QDOT_SIN || op == QDOT_COS || op == QDOT_EXP || op == QDOT_SINH ||
                     op == QDOT_COSH || op == QDOT_TANH || op == QDOT_ATAN || op == QDOT_ASIN ||
                     op == QDOT_ACOS || op == QDOT_LOG || op == QDOT_ABS || op == QDOT_SIGN;
            if (op == QDOT_SIGN) /* sign(x) jumps at 0, where it has a value */
                status = add_all_zeros(l, qdot_expr_arg(pool, node, 0), 0, known);
            *known = *known || op == QDOT_MAX || op == QDOT_MIN || op == QDOT_IF;
        } else if (kind == QDOT_PROD) {
            for (uint32_t k = 1; k + 1 < qdot_expr_count(pool, node) && *known && status == QDOT_OK;
                 k += 2) {
                qdot_expr base = qdot_expr_arg(pool, node, k);
                const fmpq *exponent =
                    qdot_expr_rational(pool, qdot_expr_arg(pool, node, k + 1));

                if (!qdot_expr_contains(pool, qdot_expr_arg(pool, node, k + 1), l->u) &&
                    !qdot_expr_contains(pool, base, l->u))
                    continue;
                *known = exponent != NULL;
                if (*known && fmpq_sgn(exponent) < 0)
                    status = add_all_zeros(l, base, 0, known);
            }
        } else if (kind == QDOT_REL) { /* an if(...) jumps where the two sides of its condition are equal */
            status = add_all_zeros(l, qdot_sub(pool, qdot_expr_arg(pool, node, 1), qdot_expr_arg(pool, node, 0)), 0, known);
        } else {
            *known = kind == QDOT_SUM || kind == QDOT_SYM;
        }
    }
    qdot_walk_end(&w);
    return status;
}

/* --- intervals in which the relations hold ---------------------------------------------- */

/* Whether all relations hold at u = value; relations whose bits are set in `zero` are known to be 0 there. */
static qdot_status
decide_relations_at(const line *l, qdot_expr value, uint32_t zero, answer *out)
{
    *out = YES;
    for (size_t i = 0; i < l->relations && *out != NO; i++) {
        qdot_constant_sign sign = QDOT_CONSTANT_ZERO;

        if ((zero >> i & 1) == 0) {
            qdot_expr there = qdot_subs(l->pool, l->g[i], 1, &l->u, &value);
            qdot_status status = qdot_pool_check(l->pool);

            if (status == QDOT_EDOMAIN) {
                *out = NO;
                break;
            }
            QDOT_TRY(status);
            QDOT_TRY(qdot_constant_decide(l->pool, there, &sign));
        }
        if (sign == QDOT_CONSTANT_UNKNOWN)
            *out = UNKNOWN;
        else if (sign == QDOT_CONSTANT_NEGATIVE || (sign == QDOT_CONSTANT_ZERO && l->strict[i]))
            *out = NO;
    }
    return QDOT_OK;
}

static qdot_expr
add_full_turn(const line *l, qdot_expr value, bool turn)
{
    qdot_expr whole = qdot_mul(l->pool, qdot_expr_int(l->pool, 2), QDOT_PI);

    return turn && value != QDOT_NIL
               ? qdot_simplify(l->pool, qdot_add(l->pool, value, whole), l->facts)
               : value;
}

/* The value of the k-th point; if `turn` is true, increased by a full turn (2 pi). */
static qdot_expr
point_value(const line *l, size_t k, bool turn)
{
    const point *p = &l->at[k];

    return p->exact != QDOT_NIL ? add_full_turn(l, p->exact, turn)
                                : qdot_generic_decimal(l->pool, p->at + (turn ? 2 * M_PI : 0));
}

/* A number between point k and the one before it; also beyond the ends, or around the circle. */
static qdot_expr
number_between(const line *l, size_t k)
{
    size_t n = l->points;
    double lo, hi;

    if (n == 0)
        return QDOT_ZERO;
    lo = k > 0 ? l->at[k - 1].at : l->turn ? l->at[n - 1].at - 2 * M_PI : l->at[0].at - 2;
    hi = k < n ? l->at[k].at : l->turn ? l->at[0].at + 2 * M_PI : l->at[n - 1].at + 2;
    return qdot_generic_decimal(l->pool, lo + (hi - lo) / 2);
}

/* The pieces of the line in their order, 0 ... 2 points: gap, point, gap, ... The last gap of a circle is the
 * first. Intervals are the runs of pieces that hold. */
static qdot_status
collect_bands(const line *l, const bool *holds, qdot_bands *out)
{
    size_t pieces = 2 * l->points + (l->turn ? 0 : 1), first = 0;

    while (l->turn && first < pieces && holds[first])
        first++;
    out->whole = l->turn ? first == pieces : true;
    for (size_t k = 0; k < pieces && !l->turn; k++)
        out->whole = out->whole && holds[k];
    out->touched = out->whole && l->points > 0;
    if (out->whole)
        return QDOT_OK;
    for (size_t k = first; k < first + pieces; k++) {
        qdot_band band = {0};
        size_t from = k, to;

        if (!holds[k % pieces])
            continue;
        while (k + 1 < first + pieces && holds[(k + 1) % pieces])
            k++;
        to = k;
        band.lo_open = from % 2 == 0;
        band.hi_open = to % 2 == 0;
        /* even pieces are open gaps, odd pieces are points: a gap ends at the two neighbouring points */
        if (!band.lo_open || from > 0 || l->turn) {
            size_t piece = band.lo_open ? from - 1 : from, p = piece % pieces / 2;

            band.lo = point_value(l, p, piece >= pieces);
            band.numeric = l->at[p].exact == QDOT_NIL;
        }
        if (!band.hi_open || to + 1 < pieces || l->turn) {
            size_t piece = band.hi_open ? to + 1 : to, p = piece % pieces / 2;

            band.hi = point_value(l, p, piece >= pieces);
            band.numeric = band.numeric || l->at[p].exact == QDOT_NIL;
        }
        for (size_t i = from + 1; i < to; i++)
            out->touched = out->touched || i % 2 == 1;
        QDOT_TRY(qdot_vec_push(&out->at, band));
    }
    return qdot_pool_check(l->pool);
}

static void
sort_points(line *l)
{
    for (size_t a = 1; a < l->points; a++)
        for (size_t b = a; b > 0 && l->at[b].at < l->at[b - 1].at; b--) {
            point keep = l->at[b];

            l->at[b] = l->at[b - 1];
            l->at[b - 1] = keep;
        }
}

static qdot_status
find_bands_by_zeros(line *l, qdot_bands *out, bool *found)
{
    const qdot_symbol *u = qdot_expr_symbol(l->pool, l->u);
    size_t n = l->relations;
    bool holds[2 * MOST_POINTS + 1];

    *found = true;
    for (size_t i = 0; i < n && *found; i++) {
        QDOT_TRY(add_all_zeros(l, l->g[i], (uint32_t)1 << i, found));
        if (*found)
            QDOT_TRY(find_sign_changes_at_poles(l, l->g[i], found));
    }
    for (int side = 0; side < 2 && *found; side++) { /* the bounds of the domain count as relations, too */
        qdot_expr end = side == 0 ? u->lo : u->hi;

        if (end == QDOT_NIL)
            continue;
        l->strict[l->relations] = side == 0 ? u->lo_open : u->hi_open;
        l->g[l->relations] = side == 0 ? qdot_sub(l->pool, l->u, end)
                                       : qdot_sub(l->pool, end, l->u);
        *found = add_exact_zero(l, end, (uint32_t)1 << l->relations++);
    }
    QDOT_TRY(qdot_pool_check(l->pool));
    sort_points(l);
    for (size_t k = 0; k < 2 * l->points + 1 && *found; k++) {
        size_t p = k / 2;
        answer yes;

        QDOT_TRY(k % 2 == 0 ? decide_relations_at(l, number_between(l, p), 0, &yes)
                            : decide_relations_at(l, point_value(l, p, false), l->at[p].zero_of, &yes));
        holds[k] = yes == YES;
        *found = yes != UNKNOWN;
    }
    return *found ? collect_bands(l, holds, out) : QDOT_OK;
}

/* --- linear relations, with parameters -------------------------------------------------- */

/* Add the condition lo < hi; *out FALSE if it never holds. */
static qdot_status
add_order_condition(line *l, qdot_expr lo, qdot_expr hi, qdot_expr *out)
{
    if (lo == QDOT_NIL || hi == QDOT_NIL || *out == QDOT_FALSE)
        return QDOT_OK;
    *out = qdot_conditions_and(l->pool, *out,
                               qdot_condition(l->pool, qdot_sub(l->pool, hi, lo), true, l->facts));
    return qdot_pool_check(l->pool);
}

static qdot_status
find_bands_of_linear_relations(line *l, qdot_bands *out, bool *found)
{
    qdot_pool *pool = l->pool;
    const qdot_symbol *u = qdot_expr_symbol(pool, l->u);
    qdot_band band = {0};
    qdot_expr zero = QDOT_ZERO;

    *found = true;
    for (size_t i = 0; i < l->relations && *found; i++) {
        qdot_expr slope = qdot_diff(pool, l->g[i], l->u), end, *to;
        bool up;

        slope = qdot_simplify(pool, slope, l->facts);
        QDOT_TRY(qdot_pool_check(pool));
        *found = !qdot_expr_contains(pool, slope, l->u);
        if (!*found)
            break;
        up = qdot_positive(pool, slope, l->facts, 0, NULL) == QDOT_TRUE;
        *found = up || qdot_positive(pool, qdot_neg(pool, slope), l->facts, 0, NULL) == QDOT_TRUE;
        end = qdot_subs(pool, l->g[i], 1, &l->u, &zero);
        if (end == QDOT_NIL && qdot_pool_check(pool) == QDOT_EDOMAIN) { /* the relation has no value at u = 0, so it is not linear in u */
            *found = false;
            break;
        }
        end = qdot_simplify(pool, qdot_neg(pool, qdot_div(pool, end, slope)), l->facts);
        to = up ? &band.lo : &band.hi;
        *found = *found && *to == QDOT_NIL; /* give up at a second bound on the same side */
        *to = end;
        *(up ? &band.lo_open : &band.hi_open) = l->strict[i];
        QDOT_TRY(qdot_pool_check(pool));
    }
    if (!*found)
        return QDOT_OK;
    QDOT_TRY(add_order_condition(l, band.lo, band.hi, &out->also));
    QDOT_TRY(add_order_condition(l, u->lo, band.hi, &out->also));
    QDOT_TRY(add_order_condition(l, band.lo, u->hi, &out->also));
    return out->also == QDOT_FALSE ? QDOT_OK : qdot_vec_push(&out->at, band);
}

/* --- all intervals ---------------------------------------------------------------------- */

void
qdot_bands_clear(qdot_bands *b)
{
    qdot_free(b->at.at);
    *b = (qdot_bands){0};
}

qdot_status
qdot_bands_find(qdot_pool *pool, qdot_expr u, size_t n, const qdot_expr *relation,
                const qdot_facts *facts, qdot_bands *out, bool *found)
{
    const qdot_symbol *symbol = qdot_expr_symbol(pool, u);
    qdot_expr turn = qdot_mul(pool, qdot_expr_int(pool, 2), QDOT_PI);
    line l = {.pool = pool, .facts = facts, .u = u, .relations = n};
    bool alone = true;

    *out = (qdot_bands){0};
    *found = false;
    if (n == 0 || n + 2 > MOST_RELATIONS)
        return QDOT_OK;
    for (size_t i = 0; i < n; i++) {
        l.g[i] = qdot_positive_of(pool, relation[i]);
        l.strict[i] = qdot_expr_node(pool, relation[i])->op == QDOT_LT;
        QDOT_TRY(qdot_pool_check(pool));
        alone = alone && depends_on_u_alone(&l, l.g[i]);
    }
    if (!alone)
        return find_bands_of_linear_relations(&l, out, found);
    l.turn = symbol->lo == QDOT_NIL && symbol->hi == QDOT_NIL &&
             qdot_is_period(pool, qdot_list(pool, (uint32_t)n, l.g), u, turn, facts);
    QDOT_TRY(qdot_pool_check(pool));
    return find_bands_by_zeros(&l, out, found);
}
