/* linear-rows.c -- Fourier and Motzkin's elimination for systems of linear inequalities, in integers. */
#include "normal/inequality/linear-rows.h"

#include <flint/fmpq.h>
#include <flint/fmpz_vec.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "expr/build.h"
#include "expr/calculus.h"
#include "expr/exact.h"
#include "expr/node.h"
#include "expr/symbol.h"
#include "expr/walk.h"

enum { MOST_SYMBOLS = 12, MOST_ROWS = 160 };

/* The inequality c[0] x[0] + ... + c[width - 2] x[width - 2] + c[width - 1] > 0, or >= 0 if weak. */
typedef struct {
    fmpz *c; /* [width] coefficients of the inequality */
    bool weak;
} row;

typedef struct {
    slong width;
    qdot_vec(row) row;
    bool wrong;    /* contradiction: an inequality without symbols is false */
    bool too_much; /* too many rows, or out of memory */
} rows;

static void
rows_clear(rows *s)
{
    for (size_t i = 0; i < s->row.n; i++)
        _fmpz_vec_clear(s->row.at[i].c, s->width);
    qdot_free(s->row.at);
}

/* Add a row (inequality), owning it, divided by the common factor of its coefficients; not if it is there already. */
static void
rows_add(rows *s, fmpz *c, bool weak)
{
    const slong symbols = s->width - 1;
    bool keep = true;
    fmpz_t common;

    fmpz_init(common);
    _fmpz_vec_content(common, c, s->width);
    if (!fmpz_is_zero(common))
        _fmpz_vec_scalar_divexact_fmpz(c, c, s->width, common);
    fmpz_clear(common);
    if (_fmpz_vec_is_zero(c, symbols)) {
        const int sign = fmpz_sgn(c + symbols);

        s->wrong |= sign < 0 || (sign == 0 && !weak);
        keep = false;
    }
    for (size_t i = 0; i < s->row.n && keep; i++)
        if (_fmpz_vec_equal(s->row.at[i].c, c, s->width)) {
            s->row.at[i].weak &= weak;
            keep = false;
        }
    if (keep && (s->row.n >= MOST_ROWS || qdot_vec_push(&s->row, ((row){c, weak})) != QDOT_OK)) {
        s->too_much = true;
        keep = false;
    }
    if (!keep)
        _fmpz_vec_clear(c, s->width);
}

/* Add a copy of a row, that is, of an inequality. */
static void
rows_add_copy(rows *s, const fmpz *from, bool weak)
{
    fmpz *c = _fmpz_vec_init(s->width);

    _fmpz_vec_set(c, from, s->width);
    rows_add(s, c, weak);
}

/* Add the combination of two rows in which v drops out; v has a positive coefficient in `up`, a
 * negative one in `down`. */
static void
add_row_without_symbol(rows *s, const row *up, const row *down, slong v)
{
    fmpz *c = _fmpz_vec_init(s->width);
    fmpz_t factor;

    fmpz_init(factor);
    fmpz_neg(factor, down->c + v);
    _fmpz_vec_scalar_mul_fmpz(c, up->c, s->width, factor);
    _fmpz_vec_scalar_addmul_fmpz(c, down->c, s->width, up->c + v);
    fmpz_clear(factor);
    rows_add(s, c, up->weak && down->weak);
}

/* The symbol whose elimination makes the fewest rows (inequalities); -1: no row contains a symbol. */
static slong
rows_next_symbol(const rows *s)
{
    slong best = -1;
    size_t fewest = 0;

    for (slong v = 0; v < s->width - 1; v++) {
        size_t up = 0, down = 0;

        for (size_t i = 0; i < s->row.n; i++) {
            up += fmpz_sgn(s->row.at[i].c + v) > 0;
            down += fmpz_sgn(s->row.at[i].c + v) < 0;
        }
        if (up + down > 0 && (best < 0 || up * down < fewest)) {
            best = v;
            fewest = up * down;
        }
    }
    return best;
}

/* Eliminate the symbol v from all rows, that is, inequalities. */
static void
rows_eliminate(rows *s, slong v)
{
    rows from = *s;

    s->row.at = NULL;
    s->row.n = s->row.capacity = 0;
    for (size_t i = 0; i < from.row.n && !s->wrong && !s->too_much; i++) {
        const row *up = &from.row.at[i];
        const int sign = fmpz_sgn(up->c + v);

        if (sign == 0)
            rows_add_copy(s, up->c, up->weak);
        for (size_t j = 0; j < from.row.n && sign > 0 && !s->wrong && !s->too_much; j++)
            if (fmpz_sgn(from.row.at[j].c + v) < 0)
                add_row_without_symbol(s, up, &from.row.at[j], v);
    }
    rows_clear(&from);
}

/* --- expressions as rows ---------------------------------------------------------------- */

/* Find the coefficients q of the symbols in e, then the value of e with all symbols 0. False: e is not linear. */
static bool
find_linear_coefficients(qdot_pool *pool, qdot_expr e, uint32_t n, const qdot_expr *symbol, fmpq *q)
{
    qdot_expr zero[MOST_SYMBOLS];

    if (e == QDOT_NIL || (qdot_expr_node(pool, e)->holds & (QDOT_HAS_FUN | QDOT_HAS_UFUN)) != 0)
        return false;
    for (uint32_t v = 0; v <= n; v++) {
        const qdot_expr c = v < n ? qdot_diff(pool, e, symbol[v]) : qdot_subs(pool, e, n, symbol, zero);
        const fmpq *x = c == QDOT_NIL ? NULL : qdot_expr_rational(pool, c);

        if (x == NULL)
            return false;
        fmpq_set(q + v, x);
        if (v < n)
            zero[v] = QDOT_ZERO;
    }
    return true;
}

/* The row [width] for sign e > 0 (sign: 1 or -1) with integer coefficients; the caller clears it.
 * NULL: e is not linear. */
static fmpz *
linear_row(qdot_pool *pool, qdot_expr e, const qdot_expr *symbol, slong width, int sign)
{
    fmpq q[MOST_SYMBOLS + 1];
    fmpz *c = NULL;

    for (slong v = 0; v < width; v++)
        fmpq_init(q + v);
    if (find_linear_coefficients(pool, e, (uint32_t)width - 1, symbol, q)) {
        fmpz_t common;

        c = _fmpz_vec_init(width);
        fmpz_init_set_si(common, 1);
        for (slong v = 0; v < width; v++)
            fmpz_lcm(common, common, fmpq_denref(q + v));
        for (slong v = 0; v < width; v++) {
            fmpz_divexact(c + v, common, fmpq_denref(q + v));
            fmpz_mul(c + v, c + v, fmpq_numref(q + v));
            fmpz_mul_si(c + v, c + v, sign);
        }
        fmpz_clear(common);
    }
    for (slong v = 0; v < width; v++)
        fmpq_clear(q + v);
    return c;
}

/* --- deciding by elimination ------------------------------------------------------------- */

typedef enum { NOT_KNOWN, CONTRADICTION, POSSIBLE } rows_verdict;

/* Whether the given inequalities (rows) and, unless c is NULL, the row c contradict each other. */
static rows_verdict
rows_decide(const rows *given, const fmpz *c, bool weak)
{
    rows s = {.width = given->width, .wrong = given->wrong, .too_much = given->too_much};
    slong v;

    for (size_t i = 0; i < given->row.n; i++)
        rows_add_copy(&s, given->row.at[i].c, given->row.at[i].weak);
    if (c != NULL)
        rows_add_copy(&s, c, weak);
    while (!s.wrong && !s.too_much && !qdot_interrupt_is_set() && (v = rows_next_symbol(&s)) >= 0)
        rows_eliminate(&s, v);
    rows_clear(&s);
    return s.too_much || qdot_interrupt_is_set() ? NOT_KNOWN : s.wrong ? CONTRADICTION : POSSIBLE;
}

/* Find the sign of e under the conditions, by eliminating symbols from their rows together with the row of -e. */
static qdot_cells
decide_by_rows(const rows *given, const fmpz *minus_e)
{
    rows_verdict verdict = rows_decide(given, NULL, false);

    if (verdict != POSSIBLE)
        return verdict == CONTRADICTION ? QDOT_CELLS_EMPTY : QDOT_CELLS_UNKNOWN;
    verdict = rows_decide(given, minus_e, true);
    if (verdict != POSSIBLE)
        return verdict == CONTRADICTION ? QDOT_CELLS_POSITIVE : QDOT_CELLS_UNKNOWN;
    verdict = rows_decide(given, minus_e, false);
    if (verdict == NOT_KNOWN)
        return QDOT_CELLS_UNKNOWN;
    return verdict == CONTRADICTION ? QDOT_CELLS_NOT_NEGATIVE : QDOT_CELLS_NEGATIVE;
}

qdot_status
qdot_linear_decide(qdot_pool *pool, qdot_expr e, size_t n, const qdot_cells_condition *condition, qdot_cells *result)
{
    qdot_expr all = e, atoms, symbol[MOST_SYMBOLS];
    rows given = {0};
    fmpz *minus_e;
    bool linear;

    *result = QDOT_CELLS_UNKNOWN;
    for (size_t i = 0; i < n; i++)
        all = qdot_list(pool, 2, (qdot_expr[]){all, condition[i].gap});
    atoms = qdot_expr_atoms(pool, all, false);
    if (atoms == QDOT_NIL)
        return qdot_grave(qdot_pool_check(pool));
    if (qdot_expr_count(pool, atoms) > MOST_SYMBOLS)
        return QDOT_OK;
    for (; given.width < (slong)qdot_expr_count(pool, atoms); given.width++)
        symbol[given.width] = qdot_expr_arg(pool, atoms, (uint32_t)given.width);
    given.width++;
    minus_e = linear_row(pool, e, symbol, given.width, -1);
    linear = minus_e != NULL;
    for (size_t i = 0; i < n && linear; i++) {
        fmpz *c = linear_row(pool, condition[i].gap, symbol, given.width, 1);

        linear = c != NULL;
        if (linear)
            rows_add(&given, c, condition[i].weak);
    }
    if (linear)
        *result = decide_by_rows(&given, minus_e);
    if (minus_e != NULL)
        _fmpz_vec_clear(minus_e, given.width);
    rows_clear(&given);
    if (qdot_interrupt_is_set())
        return qdot_interrupt_check();
    return qdot_grave(qdot_pool_check(pool));
}
