/* relative.c -- simplifies in differences of angles. */
#include "normal/simplify/relative.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/function.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"
#include "normal/prove/decide.h"
#include "normal/simplify/simplify.h"

enum { MOST_ANGLES = 8, MOST_MULTIPLE = 6 };

/* The angles in their order, their differences, and the sines and cosines in e. */
typedef struct {
    size_t n;
    qdot_expr angle[MOST_ANGLES], difference[MOST_ANGLES];
    qdot_vec(qdot_expr) wave, expanded;
} angles;

static bool
is_wave(const qdot_pool *pool, qdot_expr e)
{
    const unsigned op = qdot_expr_node(pool, e)->op;

    return qdot_expr_kind(pool, e) == QDOT_FUN && (op == QDOT_SIN || op == QDOT_COS);
}

/* Insert the symbol into the angles unless it is there; false: they are too many. */
static bool
add_angle(angles *a, qdot_expr symbol)
{
    size_t k = 0;

    while (k < a->n && a->angle[k] < symbol) /* ids are in the order of declaration */
        k++;
    if (k < a->n && a->angle[k] == symbol)
        return true;
    if (a->n == MOST_ANGLES)
        return false;
    for (size_t i = a->n++; i > k; i--)
        a->angle[i] = a->angle[i - 1];
    a->angle[k] = symbol;
    return true;
}

/* Add the symbols in the argument of a sine or cosine; *fit becomes false if they are too many. */
static qdot_status
add_angles_of(const qdot_pool *pool, qdot_expr argument, angles *a, bool *fit)
{
    qdot_walk w;

    QDOT_TRY(qdot_walk_begin(pool, argument, &w));
    for (size_t i = 0; i < w.n; i++)
        if (qdot_expr_kind(pool, w.at[i]) == QDOT_SYM)
            *fit = *fit && add_angle(a, w.at[i]);
    qdot_walk_end(&w);
    return QDOT_OK;
}

/* Collect the sines and cosines in e and their angles; *fit: there are two angles or more, but not too many. */
static qdot_status
collect_angles(const qdot_pool *pool, qdot_expr e, angles *a, bool *fit)
{
    qdot_walk w;
    qdot_status status;

    QDOT_TRY(qdot_walk_begin(pool, e, &w));
    status = QDOT_OK;
    *fit = true;
    for (size_t i = 0; i < w.n && *fit && status == QDOT_OK; i++)
        if (is_wave(pool, w.at[i])) {
            status = qdot_vec_push(&a->wave, w.at[i]);
            if (status == QDOT_OK)
                status = add_angles_of(pool, qdot_expr_arg(pool, w.at[i], 0), a, fit);
        }
    qdot_walk_end(&w);
    *fit = *fit && a->n >= 2;
    return status;
}

/* multiple [n]: argument = sum multiple angle; false if they are no small integers. */
static bool
find_multiples(qdot_pool *pool, const angles *a, qdot_expr argument, int *multiple)
{
    qdot_expr rest = argument;

    for (size_t k = 0; k < a->n; k++) {
        const qdot_expr slope = qdot_diff(pool, argument, a->angle[k]);
        const fmpq *c = slope == QDOT_NIL ? NULL : qdot_expr_rational(pool, slope);

        if (c == NULL || !fmpz_is_one(fmpq_denref(c)) || !fmpz_fits_si(fmpq_numref(c)) ||
            llabs(fmpz_get_si(fmpq_numref(c))) > MOST_MULTIPLE)
            return false;
        multiple[k] = (int)fmpz_get_si(fmpq_numref(c));
        rest = qdot_sub(pool, rest, qdot_mul(pool, slope, a->angle[k]));
    }
    return rest == QDOT_ZERO;
}

/* Whether the sine or cosine changes when all angles grow alike: their multiples do not add up to 0, or are not known. */
static bool
turns_with_all(qdot_pool *pool, const angles *a, qdot_expr wave)
{
    int multiple[MOST_ANGLES], sum = 0;

    if (!find_multiples(pool, a, qdot_expr_arg(pool, wave, 0), multiple))
        return true;
    for (size_t k = 0; k < a->n; k++)
        sum += multiple[k];
    return sum != 0;
}

/* Whether a divisor in e holds a sine or cosine that changes when all angles grow alike, such as sin(a_n). This way puts 0
 * for the last angle a_n, so that the divisor could become 0. */
static bool
divides_by_turning_waves(qdot_pool *pool, qdot_expr e, const angles *a)
{
    qdot_walk w;
    bool divides = false;

    if (qdot_walk_begin(pool, e, &w) != QDOT_OK)
        return true;
    for (size_t i = 0; i < w.n && !divides; i++)
        for (uint32_t k = 1; qdot_expr_kind(pool, w.at[i]) == QDOT_PROD && k + 1 < qdot_expr_count(pool, w.at[i]); k += 2)
            for (size_t j = 0; qdot_expr_is_negative(pool, qdot_expr_arg(pool, w.at[i], k + 1)) && j < a->wave.n; j++)
                divides = divides || (qdot_expr_contains(pool, qdot_expr_arg(pool, w.at[i], k), a->wave.at[j]) &&
                                      turns_with_all(pool, a, a->wave.at[j]));
    qdot_walk_end(&w);
    return divides;
}

/* sin or cos of sum multiple[k] a_k as a polynomial in sines and cosines of the differences d_k, with 0 for the last angle:
 * then a_k = d_k + d_(k+1) + ..., and one difference after the other is added to the argument by the addition theorem. */
static qdot_expr
expand_wave(qdot_pool *pool, const angles *a, bool sine, const int *multiple)
{
    qdot_expr S = QDOT_ZERO, C = QDOT_ONE;
    int times = 0; /* d_k in the argument: multiple[0] + ... + multiple[k] */

    for (size_t k = 0; k + 1 < a->n; k++) {
        const qdot_expr c = qdot_fun1(pool, QDOT_COS, a->difference[k]);

        times += multiple[k];
        for (int i = 0; i < abs(times); i++) {
            const qdot_expr s = qdot_mul(pool, qdot_expr_int(pool, times < 0 ? -1 : 1), qdot_fun1(pool, QDOT_SIN, a->difference[k]));
            const qdot_expr next = qdot_add(pool, qdot_mul(pool, S, c), qdot_mul(pool, C, s));

            C = qdot_sub(pool, qdot_mul(pool, C, c), qdot_mul(pool, S, s));
            S = next;
        }
    }
    return sine ? S : C;
}

/* e with every sine and cosine expanded; nil where that cannot be done, or an angle is left. */
static qdot_expr
in_differences(qdot_pool *pool, qdot_expr e, angles *a)
{
    int multiple[MOST_ANGLES];
    char name[32];

    for (size_t k = 0; k + 1 < a->n; k++) {
        snprintf(name, sizeof name, "relative angle %zu", k);
        a->difference[k] = qdot_symbol_get(pool, QDOT_PARAM, name);
    }
    for (size_t i = 0; i < a->wave.n; i++) {
        const qdot_expr wave = a->wave.at[i];

        if (!find_multiples(pool, a, qdot_expr_arg(pool, wave, 0), multiple) ||
            qdot_vec_push(&a->expanded, expand_wave(pool, a, qdot_expr_node(pool, wave)->op == QDOT_SIN, multiple)) != QDOT_OK)
            return QDOT_NIL;
    }
    e = qdot_subs(pool, e, a->wave.n, a->wave.at, a->expanded.at);
    for (size_t k = 0; k < a->n && e != QDOT_NIL; k++)
        if (qdot_expr_contains(pool, e, a->angle[k]))
            return QDOT_NIL;
    return e;
}

/* e simplified in the differences of its angles, if that is proved to be equal; else nil. */
static qdot_expr
simplify_in_differences(qdot_pool *pool, qdot_expr e, angles *a, const qdot_facts *facts)
{
    qdot_expr back[MOST_ANGLES], shorter = in_differences(pool, e, a);
    qdot_decision decision;

    if (shorter == QDOT_NIL)
        return QDOT_NIL;
    shorter = qdot_simplify(pool, shorter, facts);
    for (size_t k = 0; k + 1 < a->n; k++)
        back[k] = qdot_sub(pool, a->angle[k], a->angle[k + 1]);
    shorter = shorter == QDOT_NIL ? shorter : qdot_subs(pool, shorter, a->n - 1, a->difference, back);
    if (shorter == QDOT_NIL || qdot_decide_equal(pool, e, shorter, facts, &decision) != QDOT_OK)
        return QDOT_NIL;
    return decision.verdict == QDOT_PROVED ? shorter : QDOT_NIL;
}

qdot_expr
qdot_simplify_relative(qdot_pool *pool, qdot_expr e, const qdot_facts *facts)
{
    angles a = {0};
    bool fit = false;
    qdot_expr shorter = QDOT_NIL;

    if (e != QDOT_NIL && collect_angles(pool, e, &a, &fit) == QDOT_OK && fit && !divides_by_turning_waves(pool, e, &a))
        shorter = simplify_in_differences(pool, e, &a, facts);
    qdot_free(a.wave.at);
    qdot_free(a.expanded.at);
    return shorter;
}
