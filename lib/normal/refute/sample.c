/* sample.c -- chooses points that satisfy relations and conditions, to refute claims at them. */
#include "normal/refute/sample.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "normal/field/factor.h"
#include "normal/field/prepare.h"
#include "num/integer.h"

#define SIMPLE 24 /* number of points at first that have small numbers */
#define FAR 96    /* index of the first point that may have large coordinates */

/* --- preparing samples ------------------------------------------------------------- */

static uint32_t
derivative_order(const qdot_pool *pool, qdot_expr ufun)
{
    uint32_t n = qdot_expr_count(pool, ufun) / 2, all = 0;
    int64_t k;

    for (uint32_t i = 0; i < n; i++)
        if (qdot_expr_to_int(pool, qdot_expr_arg(pool, ufun, n + i), &k))
            all += (uint32_t)k;
    return all;
}

/* A relation between undefined functions has consequences for their higher derivatives,
 * which are not at hand unless given: with derivatives above `most` there are no sure
 * points. */
static bool
has_higher_derivatives(const qdot_pool *pool, qdot_expr atoms, qdot_expr relations,
                       uint32_t most)
{
    uint32_t n = qdot_expr_count(pool, atoms), m = qdot_expr_count(pool, relations);
    bool any = false;

    for (uint32_t i = 0; i < m; i++) {
        qdot_expr a = qdot_expr_arg(pool, relations, i);

        if (qdot_expr_kind(pool, a) == QDOT_UFUN) {
            any = true;
            if (derivative_order(pool, a) > most)
                most = derivative_order(pool, a);
        }
    }
    for (uint32_t i = 0; any && i < n; i++) {
        qdot_expr a = qdot_expr_arg(pool, atoms, i);

        if (qdot_expr_kind(pool, a) == QDOT_UFUN && derivative_order(pool, a) > most)
            return true;
    }
    return false;
}

static void
append_atom(qdot_sample *s, qdot_expr atom, qdot_expr solution, bool implicit)
{
    qdot_sample_atom *a = &s->atom[s->n++];

    *a = (qdot_sample_atom){.atom = atom, .solution = solution, .implicit = implicit};
    fmpq_init(&a->x);
    arb_init(a->value);
}

/* The solved atoms, each after those that its solution holds; where two are solved for each other
 * there are no points. */
static void
append_solved_atoms(qdot_sample *s, size_t n, qdot_sample_solution *solved)
{
    for (size_t left = n, before = n + 1; left > 0 && left < before;) {
        before = left;
        for (size_t k = n; k-- > 0;) {
            bool waits = solved[k].atom == QDOT_NIL;

            for (size_t j = 0; j < n && !waits; j++)
                waits = j != k && solved[j].atom != QDOT_NIL &&
                        qdot_expr_contains(s->pool, solved[k].solution, solved[j].atom);
            if (waits)
                continue;
            append_atom(s, solved[k].atom, solved[k].solution, solved[k].implicit);
            solved[k].atom = QDOT_NIL;
            left--;
        }
    }
    for (size_t k = 0; k < n; k++)
        s->possible &= solved[k].atom == QDOT_NIL;
}

static qdot_expr
list_bounds(qdot_pool *pool, qdot_expr atoms)
{
    qdot_expr all = qdot_list(pool, 0, NULL), two[2];

    for (uint32_t i = 0; i < qdot_expr_count(pool, atoms); i++) {
        const qdot_symbol *symbol = qdot_expr_symbol(pool, qdot_expr_arg(pool, atoms, i));
        qdot_expr lo = symbol == NULL ? QDOT_NIL : symbol->lo;
        qdot_expr hi = symbol == NULL ? QDOT_NIL : symbol->hi;

        two[0] = all;
        if (lo != QDOT_NIL) {
            two[1] = lo;
            two[0] = all = qdot_list(pool, 2, two);
        }
        if (hi != QDOT_NIL) {
            two[1] = hi;
            all = qdot_list(pool, 2, two);
        }
    }
    return all;
}

/* 1 for symbols (atoms) whose bounds contain other symbols: these get their values last. */
static int
bound_rank(const qdot_pool *pool, qdot_expr atom)
{
    const qdot_symbol *s = qdot_expr_symbol(pool, atom);

    if (s == NULL || (s->lo == QDOT_NIL && s->hi == QDOT_NIL))
        return 0;
    if ((s->lo == QDOT_NIL || qdot_expr_kind(pool, s->lo) == QDOT_NUM) &&
        (s->hi == QDOT_NIL || qdot_expr_kind(pool, s->hi) == QDOT_NUM))
        return 0;
    return 1;
}

/* Record the bound of x that a condition 0 < c x + rest with a number c gives: x > -rest/c, or < if c < 0. */
static qdot_status
record_bound_of_condition(qdot_sample *s, qdot_expr condition)
{
    qdot_pool *pool = s->pool;
    qdot_expr gap, atoms;

    if (qdot_expr_kind(pool, condition) != QDOT_REL ||
        qdot_expr_node(pool, condition)->op == QDOT_EQ)
        return QDOT_OK;
    gap = qdot_sub(pool, qdot_expr_arg(pool, condition, 1),
                   qdot_expr_arg(pool, condition, 0));
    atoms = qdot_expr_atoms(pool, gap, false);
    for (uint32_t i = 0; atoms != QDOT_NIL && i < qdot_expr_count(pool, atoms); i++) {
        qdot_expr x = qdot_expr_arg(pool, atoms, i), c = qdot_diff(pool, gap, x), rest;

        if (c == QDOT_NIL || qdot_expr_kind(pool, c) != QDOT_NUM || c == QDOT_ZERO)
            continue;
        rest = qdot_sub(pool, gap, qdot_mul(pool, c, x));
        rest = qdot_neg(pool, qdot_div(pool, rest, c));
        if (rest == QDOT_NIL || qdot_expr_contains(pool, rest, x))
            continue;
        QDOT_TRY(
            qdot_grow(&s->bound, &s->bounds_capacity, s->n_bounds + 1, sizeof *s->bound));
        s->bound[s->n_bounds++] = (qdot_sample_bound){
            .atom = x, .bound = rest, .below = fmpq_sgn(qdot_expr_rational(pool, c)) < 0};
    }
    return qdot_pool_failed(pool) ? qdot_pool_check(pool) : QDOT_OK;
}

/* Each relation solved with what those before it have been solved for put in; `put` [nr] becomes the
 * solutions, *n of them. */
static void
solve_relations(qdot_sample *s, qdot_sample_solution *solved, qdot_expr *put, size_t *n)
{
    const size_t nr = s->facts->n_relations;

    *n = 0;
    for (size_t k = 0; k < nr; k++)
        put[k] = s->facts->relations[k];
    for (size_t k = 0; k < nr && s->possible; k++) {
        qdot_sample_solution *x = &solved[*n];

        s->possible = qdot_sample_solve(s->pool, put[k], k, *n, solved, x);
        if (!s->possible || x->atom == QDOT_NIL)
            continue;
        for (size_t j = k + 1; j < nr && !x->implicit; j++)
            put[j] = qdot_subs(s->pool, put[j], 1, &x->atom, &x->solution);
        ++*n;
    }
    for (size_t k = 0; k < *n; k++)
        put[k] = solved[k].solution;
}

/* Add the symbols that are chosen freely, those with bounds that contain others last, then the solved ones. */
static void
append_atoms(qdot_sample *s, qdot_expr atoms, size_t n, qdot_sample_solution *solved)
{
    for (int rank = 0; rank < 2; rank++)
        for (uint32_t i = 0; i < qdot_expr_count(s->pool, atoms); i++) {
            qdot_expr a = qdot_expr_arg(s->pool, atoms, i);

            if (!qdot_sample_is_solved(n, solved, a) && bound_rank(s->pool, a) == rank)
                append_atom(s, a, QDOT_NIL, false);
        }
    append_solved_atoms(s, n, solved);
}

static qdot_status
sample_gather(qdot_sample *s, size_t n, const qdot_expr *e)
{
    static const qdot_facts nothing = {0};
    const qdot_facts *facts = s->facts == NULL ? &nothing : s->facts;
    size_t nr = facts->n_relations, n_solved;
    qdot_sample_solution *solved =
        qdot_calloc(nr + 1, sizeof *solved + sizeof(qdot_expr));
    qdot_expr *put = (qdot_expr *)(solved + nr + 1), parts[6], atoms, of_relations;
    qdot_pool *pool = s->pool;
    qdot_status status = QDOT_OK;

    if (solved == NULL)
        return QDOT_ENOMEM;
    s->facts = facts;
    solve_relations(s, solved, put, &n_solved);
    parts[0] = qdot_list(pool, (uint32_t)n, e);
    parts[1] = qdot_list(pool, (uint32_t)nr, facts->relations);
    parts[2] = qdot_list(pool, (uint32_t)facts->n_conditions, facts->conditions);
    parts[3] = qdot_list(pool, (uint32_t)n_solved, put);
    of_relations = qdot_expr_atoms(pool, parts[1], true);
    s->list = qdot_list(pool, 4, parts);
    for (int round = 0; round < 3; round++) { /* repeat, because bounds may contain symbols that have bounds */
        parts[4] = qdot_expr_atoms(pool, s->list, true);
        if (parts[4] == QDOT_NIL)
            break;
        parts[5] = list_bounds(pool, parts[4]);
        s->list = qdot_list(pool, 6, parts);
    }
    atoms = qdot_expr_atoms(pool, s->list, true);
    if (atoms == QDOT_NIL) {
        status = qdot_pool_check(pool);
    } else {
        if (has_higher_derivatives(pool, atoms, of_relations, facts->free_derivatives))
            s->possible = false;
        s->atom = qdot_malloc((qdot_expr_count(pool, atoms) + 1) * sizeof *s->atom);
        if (s->atom == NULL)
            status = QDOT_ENOMEM;
        else
            append_atoms(s, atoms, n_solved, solved);
    }
    qdot_free(solved);
    return status;
}

qdot_status
qdot_sample_begin(qdot_sample *s, qdot_pool *pool, size_t n, const qdot_expr *e,
                  const qdot_facts *facts)
{
    qdot_status status;

    *s = (qdot_sample){.pool = pool, .facts = facts, .possible = true};
    status = sample_gather(s, n, e);
    for (size_t i = 0; status == QDOT_OK && i < s->facts->n_conditions; i++)
        status = record_bound_of_condition(s, s->facts->conditions[i]);
    if (status == QDOT_OK)
        status = qdot_ball_begin(&s->ball, pool, 1, &s->list);
    if (status != QDOT_OK) {
        qdot_free(s->atom);
        qdot_free(s->bound);
        s->atom = NULL;
        s->bound = NULL;
    }
    return status;
}

void
qdot_sample_end(qdot_sample *s)
{
    for (size_t i = 0; i < s->n; i++) {
        fmpq_clear(&s->atom[i].x);
        arb_clear(s->atom[i].value);
        if (s->atom[i].relation != NULL)
            qdot_ball_end(s->atom[i].relation);
        qdot_free(s->atom[i].relation);
    }
    qdot_free(s->atom);
    qdot_free(s->bound);
    qdot_ball_end(&s->ball);
}

/* --- drawing points ---------------------------------------------------------------- */

static uint32_t
draw_random(qdot_sample *s, uint32_t below)
{
    s->seed ^= s->seed << 13;
    s->seed ^= s->seed >> 7;
    s->seed ^= s->seed << 17;
    return (uint32_t)((s->seed >> 33) % below);
}

bool
qdot_sample_value(void *user, qdot_expr atom, arb_t value, slong prec)
{
    qdot_sample *s = user;

    (void)prec;
    for (size_t i = 0; i < s->n; i++)
        if (s->atom[i].atom == atom) {
            if (s->atom[i].ready)
                arb_set(value, s->atom[i].value);
            return s->atom[i].ready;
        }
    return false;
}

/* A rational with a small denominator strictly between lo and hi, about so far from the
 * one to the other. */
static void
find_rational_between(fmpq_t x, double lo, double hi, double where, double about)
{
    double at = lo + (hi - lo) * where, margin = (hi - lo) * 1e-3;

    for (int64_t d = 1; d <= 4096; d = d < 16 ? d + 1 : d * 2) {
        double n = nearbyint(at * (double)d);

        if (n / (double)d > lo + margin && n / (double)d < hi - margin &&
            fabs(n / (double)d - at) < (hi - lo) * about && fabs(n) < 1e15) {
            qdot_rational_set_integers(x, (int64_t)n, (uint64_t)d);
            return;
        }
    }
    if (fabs(at) < 1e12) {
        qdot_rational_set_integers(x, (int64_t)nearbyint(at * 1048576), 1048576);
    } else if (isfinite(at)) { /* the doubles have a spacing above 1/2^20 here: take an integer */
        fmpz_set_d(fmpq_numref(x), at);
        fmpz_one(fmpq_denref(x));
    }
}

/* Half widths of the ranges tried in turn: functions with narrow domains need small arguments. */
static const double reach[] = {3, 1, 7, 0.5, 20, 2, 0.9, 0.1};

/* Find the range in which a symbol is drawn, narrowed by conditions in which all other symbols have values. */
static void
narrow_range(qdot_sample *s, qdot_expr atom, double size, double *lo, double *hi)
{
    double above = -HUGE_VAL, below = HUGE_VAL, x;

    for (size_t i = 0; i < s->n_bounds; i++) {
        if (s->bound[i].atom != atom ||
            !qdot_ball_double(s->pool, s->bound[i].bound, qdot_sample_value, s, &x))
            continue;
        if (s->bound[i].below)
            below = fmin(below, x);
        else
            above = fmax(above, x);
    }
    if (above > -HUGE_VAL && (above > *lo || below < HUGE_VAL)) {
        *lo = above;
        if (below < HUGE_VAL)
            *hi = below;
        else if (*hi <= above)
            *hi = above + size;
    } else if (below < *hi) {
        *hi = below;
        if (*lo >= below)
            *lo = below - 2 * size;
    }
}

void
qdot_sample_set(qdot_sample_atom *a, slong prec)
{
    if (a->turn) {
        arb_const_pi(a->value, prec);
        arb_mul_fmpz(a->value, a->value, fmpq_numref(&a->x), prec);
        arb_div_fmpz(a->value, a->value, fmpq_denref(&a->x), prec);
    } else {
        arb_set_fmpq(a->value, &a->x, prec);
    }
    a->ready = true;
}

void
qdot_sample_range(qdot_sample *s, qdot_expr atom, double *from, double *to)
{
    const qdot_symbol *symbol = qdot_expr_symbol(s->pool, atom);
    const int k = s->k;
    double size = reach[(size_t)k % (sizeof reach / sizeof *reach)], lo = -size,
           hi = size, x;
    uint8_t sign = qdot_expr_node(s->pool, atom)->sign;

    if (k >= FAR && k % 3 == 0) { /* large values, for expressions that are defined only there */
        size *= 1000;
        lo = -size;
        hi = size;
    }
    if (symbol != NULL) {
        qdot_expr elo = symbol->lo, ehi = symbol->hi;
        bool has_lo = qdot_ball_double(s->pool, elo, qdot_sample_value, s, &x);

        if (has_lo)
            lo = x;
        if (qdot_ball_double(s->pool, ehi, qdot_sample_value, s, &x)) {
            hi = x;
            if (!has_lo)
                lo = hi - 2 * size;
        } else if (has_lo) {
            hi = lo + size;
        }
        narrow_range(s, atom, size, &lo, &hi);
    }
    if ((sign & QDOT_GE0) && lo < 0)
        lo = 0;
    if ((sign & QDOT_LE0) && hi > 0)
        hi = 0;
    *from = lo;
    *to = hi;
}

static void
choose_value(qdot_sample *s, qdot_sample_atom *a)
{
    double where = (1 + draw_random(s, 61)) / 63.0, lo, hi;
    double about = s->k < SIMPLE ? 0.1 : 0.01; /* first integers, then other rationals */

    if (qdot_sample_is_sign(s->pool, a->atom)) {
        fmpq_set_si(&a->x, draw_random(s, 2) == 0 ? 1 : -1, 1);
        qdot_sample_set(a, 64);
        return;
    }
    qdot_sample_range(s, a->atom, &lo, &hi);
    find_rational_between(&a->x, lo, hi, where, about);
    if (fmpq_is_zero(&a->x))
        find_rational_between(&a->x, lo, hi, where * 0.9 + 0.01, about);
    qdot_sample_set(a, 64);
}

void
qdot_sample_point(qdot_sample *s, int k)
{
    s->k = k;
    s->seed = 0x9e3779b97f4a7c15u * (uint64_t)(k + 1);
    for (int i = 0; i < 8; i++)
        draw_random(s, 2);
    for (size_t i = 0; i < s->n; i++)
        s->atom[i].ready = s->atom[i].turn = s->atom[i].edge = false;
    for (size_t i = 0; i < s->n; i++)
        if (s->atom[i].solution == QDOT_NIL)
            choose_value(s, &s->atom[i]);
}

/* Whether the value of a symbol at the sample point certainly lies in its domain. */
static bool
is_in_domain(qdot_sample *s, const qdot_sample_atom *a)
{
    const qdot_symbol *symbol = qdot_expr_symbol(s->pool, a->atom);
    uint8_t sign = qdot_expr_node(s->pool, a->atom)->sign;

    if (((sign & QDOT_GE0) && !arb_is_nonnegative(a->value)) ||
        ((sign & QDOT_LE0) && !arb_is_nonpositive(a->value)) ||
        ((sign & QDOT_NE0) && arb_contains_zero(a->value)))
        return false;
    if (symbol == NULL || a->edge)
        return true;
    if (symbol->lo != QDOT_NIL) {
        arb_srcptr lo = qdot_ball_get(&s->ball, symbol->lo);

        if (lo == NULL || !arb_gt(a->value, lo))
            return false;
    }
    if (symbol->hi != QDOT_NIL) {
        arb_srcptr hi = qdot_ball_get(&s->ball, symbol->hi);

        if (hi == NULL || !arb_lt(a->value, hi))
            return false;
    }
    return true;
}

/* Whether two occurrences of the same undefined function may have equal arguments at the point. */
static bool
arguments_may_coincide(const qdot_sample *s)
{
    const qdot_pool *pool = s->pool;

    for (size_t i = 0; i < s->n; i++) {
        qdot_expr a = s->atom[i].atom;

        if (qdot_expr_kind(pool, a) != QDOT_UFUN)
            continue;
        for (size_t j = 0; j < i; j++) {
            qdot_expr b = s->atom[j].atom;
            uint32_t n = qdot_expr_count(pool, a) / 2;
            bool same = true, meet = true;

            if (qdot_expr_kind(pool, b) != QDOT_UFUN ||
                qdot_expr_node(pool, a)->op != qdot_expr_node(pool, b)->op)
                continue;
            for (uint32_t k = 0; k < n; k++) {
                qdot_expr x = qdot_expr_arg(pool, a, k), y = qdot_expr_arg(pool, b, k);
                arb_srcptr u = qdot_ball_get(&s->ball, x), v = qdot_ball_get(&s->ball, y);

                same &= x == y;
                meet &= x == y || u == NULL || v == NULL || arb_overlaps(u, v);
            }
            if (meet && !same)
                return true;
        }
    }
    return false;
}

bool
qdot_sample_values(qdot_sample *s, slong prec)
{
    for (size_t i = 0; i < s->n; i++) {
        qdot_sample_atom *a = &s->atom[i];
        arb_srcptr value;

        if (a->solution == QDOT_NIL) {
            qdot_sample_set(a, prec);
            continue;
        }
        a->ready = false;
        if (a->implicit) {
            if (!qdot_sample_root(s, a, prec))
                return false;
            continue;
        }
        qdot_ball_eval(&s->ball, prec, qdot_sample_value, s);
        value = qdot_ball_get(&s->ball, a->solution);
        if (value == NULL)
            return false;
        arb_set(a->value, value);
        a->ready = true;
    }
    qdot_ball_eval(&s->ball, prec, qdot_sample_value, s);
    for (size_t i = 0; i < s->n; i++)
        if (!is_in_domain(s, &s->atom[i]))
            return false;
    for (size_t i = 0; i < s->facts->n_conditions; i++)
        if (qdot_ball_truth(&s->ball, s->facts->conditions[i]) != 1)
            return false;
    return true;
}

bool
qdot_sample_eval(qdot_sample *s, slong prec)
{
    return qdot_sample_values(s, prec) && !arguments_may_coincide(s);
}

qdot_expr
qdot_sample_list(qdot_sample *s)
{
    qdot_expr *rows = qdot_malloc((s->n + 1) * sizeof *rows), list;
    uint32_t n = 0;

    if (rows == NULL)
        return qdot_pool_fail(s->pool);
    for (size_t i = 0; i < s->n; i++) {
        qdot_expr x;

        if (qdot_sample_is_sign(s->pool, s->atom[i].atom))
            continue;
        if (s->atom[i].solution == QDOT_NIL) {
            x = qdot_expr_fmpq(s->pool, &s->atom[i].x);
            if (s->atom[i].turn)
                x = qdot_mul(s->pool, x, QDOT_PI);
        } else { /* the value of a solved symbol is as a rule irrational: give a decimal number for printing */
            fmpq_t rounded;

            fmpq_init(rounded);
            arf_get_fmpq(rounded, arb_midref(s->atom[i].value));
            find_rational_between(rounded, arf_get_d(arb_midref(s->atom[i].value), ARF_RND_NEAR) - 1e-6,
                                  arf_get_d(arb_midref(s->atom[i].value), ARF_RND_NEAR) + 1e-6, 0.5,
                                  0.1);
            x = qdot_expr_fmpq(s->pool, rounded);
            fmpq_clear(rounded);
        }
        rows[n++] = qdot_rel(s->pool, QDOT_EQ, s->atom[i].atom, x);
    }
    list = qdot_list(s->pool, n, rows);
    qdot_free(rows);
    return list;
}
