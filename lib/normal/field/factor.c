/* factor.c -- FLINT's factorisation within a budget; terms grouped by some variables; c^2
 * written as 1 - s^2. */
#include "normal/field/factor.h"

#include <string.h>

#include <flint/fmpz_mpoly_factor.h>

#include "base/memory.h"

/* What is factored by FLINT; the last row where a person asked for factors (qdot_field.patient). */
static const struct {
    slong terms, variables, degree;
} limits[] = {{80, 14, 16}, {2000, 14, 100}};

static bool
is_small_enough(qdot_field *f, const fmpz_mpoly_t p)
{
    const slong most = limits[f->patient].degree, variables = limits[f->patient].variables;
    slong used = 0, length = fmpz_mpoly_length(p, f->ctx), total = 0;
    slong *degree;

    if (length > limits[f->patient].terms || !qdot_field_charge(f, 8 * length, length))
        return false;
    degree = qdot_malloc(((size_t)f->n + 1) * sizeof *degree);
    if (degree == NULL)
        return false;
    fmpz_mpoly_degrees_si(degree, p, f->ctx);
    for (slong v = 0; v < f->n; v++) {
        used += degree[v] > 0;
        total += degree[v];
        if (degree[v] > most)
            used = variables + 1;
    }
    qdot_free(degree);
    return used <= variables && total <= 3 * most;
}

static qdot_status
factors_reserve(qdot_field *f, qdot_factors *out, slong n)
{
    out->poly = qdot_malloc(((size_t)n + 2) * sizeof *out->poly);
    out->exp = qdot_malloc(((size_t)n + 2) * sizeof *out->exp);
    if (out->poly == NULL || out->exp == NULL)
        return QDOT_ENOMEM;
    for (; out->n < n; out->n++) {
        fmpz_mpoly_init(out->poly + out->n, f->ctx);
        out->exp[out->n] = 1;
    }
    return QDOT_OK;
}

/* Split off the integer content of p and the variables (generators) that divide p, then append the remaining factor. */
static qdot_status
split_off_monomials(qdot_field *f, qdot_factors *out, const fmpz_mpoly_t p)
{
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * sizeof *exp);
    qdot_status status = QDOT_ENOMEM;
    fmpz_mpoly_t content, rest;
    slong n = 0;

    fmpz_mpoly_init(content, f->ctx);
    fmpz_mpoly_init(rest, f->ctx);
    fmpz_mpoly_term_content(content, p, f->ctx);
    fmpz_mpoly_divides(rest, p, content, f->ctx);
    if (exp != NULL) {
        fmpz_mpoly_get_term_exp_ui(exp, content, 0, f->ctx);
        for (slong v = 0; v < f->n; v++)
            n += exp[v] > 0;
        status = factors_reserve(f, out, n + (fmpz_mpoly_is_fmpz(rest, f->ctx) ? 0 : 1));
    }
    if (status == QDOT_OK) {
        n = 0;
        for (slong v = 0; v < f->n; v++)
            if (exp[v] > 0) {
                fmpz_mpoly_gen(out->poly + n, v, f->ctx);
                out->exp[n++] = (slong)exp[v];
            }
        fmpz_mpoly_get_term_coeff_fmpz(out->content, content, 0, f->ctx);
        if (fmpz_sgn(fmpz_mpoly_leadcoeff(rest)) < 0) {
            fmpz_mpoly_neg(rest, rest, f->ctx);
            fmpz_neg(out->content, out->content);
        }
        if (!fmpz_mpoly_is_fmpz(rest, f->ctx))
            fmpz_mpoly_swap(out->poly + n, rest, f->ctx);
    }
    fmpz_mpoly_clear(content, f->ctx);
    fmpz_mpoly_clear(rest, f->ctx);
    qdot_free(exp);
    return status;
}

/* --- factors that are found at once ------------------------------------------------ */

/* Whether p, not divisible by a generator, is irreducible because some generator stands
 * in one term only, with degree 1: c M v + R with no common factor of M and R. */
static bool
has_lone_generator(qdot_field *f, const fmpz_mpoly_t p)
{
    slong length = fmpz_mpoly_length(p, f->ctx);
    ulong *exp = qdot_calloc(3 * (size_t)f->n + 1, sizeof *exp);
    ulong *count = exp + f->n, *most = count + f->n;
    bool found = false;

    if (exp == NULL)
        return false;
    for (slong i = 0; i < length; i++) {
        fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
        for (slong v = 0; v < f->n; v++) {
            count[v] += exp[v] > 0;
            most[v] = exp[v] > most[v] ? exp[v] : most[v];
        }
    }
    for (slong v = 0; v < f->n; v++)
        found |= count[v] == 1 && most[v] == 1;
    qdot_free(exp);
    return found;
}

/* The greatest common divisor of all exponents of p. */
static ulong
common_power(qdot_field *f, const fmpz_mpoly_t p)
{
    slong length = fmpz_mpoly_length(p, f->ctx);
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * sizeof *exp), g = 0;

    if (exp == NULL)
        return 0;
    for (slong i = 0; i < length; i++) {
        fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
        for (slong v = 0; v < f->n; v++)
            for (ulong b = exp[v]; b != 0;) {
                ulong rest = g % b;

                g = b;
                b = rest;
            }
    }
    qdot_free(exp);
    return g;
}

/* The square root of a term with even exponents; false if its coefficient is no square. */
static bool
square_root_of_term(qdot_field *f, fmpz_mpoly_t root, const fmpz_mpoly_t p, slong i)
{
    ulong *exp = qdot_malloc(((size_t)f->n + 1) * sizeof *exp);
    bool square;
    fmpz_t c;

    if (exp == NULL)
        return false;
    fmpz_init(c);
    fmpz_mpoly_get_term_coeff_fmpz(c, p, i, f->ctx);
    fmpz_abs(c, c);
    square = fmpz_is_square(c);
    fmpz_sqrt(c, c);
    fmpz_mpoly_get_term_exp_ui(exp, p, i, f->ctx);
    for (slong v = 0; v < f->n; v++)
        exp[v] /= 2;
    fmpz_mpoly_push_term_fmpz_ui(root, c, exp, f->ctx);
    fmpz_clear(c);
    qdot_free(exp);
    return square;
}

/* Binomials a M + b N, coprime: irreducible if the exponents have no common divisor; if
 * that is 2, only a difference of squares comes apart. *split: it did, into u and v. */
static bool
factor_binomial(qdot_field *f, const fmpz_mpoly_t p, fmpz_mpoly_t u, fmpz_mpoly_t v,
                bool *split)
{
    ulong power = common_power(f, p);
    fmpz_mpoly_t a, b;

    *split = false;
    if (power == 1)
        return true;
    if (power != 2)
        return false;
    fmpz_mpoly_init(a, f->ctx);
    fmpz_mpoly_init(b, f->ctx);
    *split = fmpz_sgn(p->coeffs + 0) * fmpz_sgn(p->coeffs + 1) < 0 &&
             square_root_of_term(f, a, p, 0) && square_root_of_term(f, b, p, 1);
    if (*split) {
        fmpz_mpoly_add(u, a, b, f->ctx);
        fmpz_mpoly_sub(v, a, b, f->ctx);
    }
    fmpz_mpoly_clear(a, f->ctx);
    fmpz_mpoly_clear(b, f->ctx);
    return true;
}

/* Finish `out` (its monomials and the rest) without FLINT's factorisation, where that
 * shows. */
static qdot_status
factor_without_flint(qdot_field *f, qdot_factors *out, bool *done)
{
    fmpz_mpoly_struct *rest = out->poly + out->n - 1;
    fmpz_mpoly_t u, v;
    bool split = false;

    *done = true;
    if (fmpz_mpoly_length(rest, f->ctx) <= 1 || has_lone_generator(f, rest))
        return QDOT_OK;
    fmpz_mpoly_init(u, f->ctx);
    fmpz_mpoly_init(v, f->ctx);
    *done =
        fmpz_mpoly_length(rest, f->ctx) == 2 && factor_binomial(f, rest, u, v, &split);
    if (*done && split) {
        fmpz_mpoly_swap(rest, u, f->ctx);
        fmpz_mpoly_init(out->poly + out->n, f->ctx);
        fmpz_mpoly_swap(out->poly + out->n, v, f->ctx);
        out->exp[out->n++] = 1;
    }
    fmpz_mpoly_clear(u, f->ctx);
    fmpz_mpoly_clear(v, f->ctx);
    return QDOT_OK;
}

static qdot_status
factors_begin(qdot_factors *out)
{
    *out = (qdot_factors){.complete = true};
    fmpz_init(out->content);
    fmpz_one(out->content);
    return QDOT_OK;
}

qdot_status
qdot_factor(qdot_field *f, qdot_factors *out, const fmpz_mpoly_t p)
{
    fmpz_mpoly_factor_t all;
    qdot_status status = QDOT_OK;
    bool done;

    QDOT_TRY(factors_begin(out));
    QDOT_TRY(split_off_monomials(f, out, p));
    if (out->n == 0)
        return QDOT_OK;
    QDOT_TRY(factor_without_flint(f, out, &done));
    if (done)
        return QDOT_OK;
    if (!is_small_enough(f, p)) {
        out->complete = false;
        return QDOT_OK;
    }
    qdot_factor_clear(f, out);
    QDOT_TRY(factors_begin(out));
    fmpz_mpoly_factor_init(all, f->ctx);
    done = fmpz_mpoly_factor(all, p, f->ctx) && fmpz_is_one(all->constant_den);
    if (done) {
        fmpz_mpoly_factor_sort(all, f->ctx);
        status = factors_reserve(f, out, all->num);
        fmpz_set(out->content, all->constant);
        for (slong i = 0; i < all->num && status == QDOT_OK; i++) {
            fmpz_mpoly_swap(out->poly + i, all->poly + i, f->ctx);
            out->exp[i] = fmpz_get_si(all->exp + i);
            if (fmpz_sgn(fmpz_mpoly_leadcoeff(out->poly + i)) < 0) {
                fmpz_mpoly_neg(out->poly + i, out->poly + i, f->ctx);
                if (out->exp[i] % 2 != 0)
                    fmpz_neg(out->content, out->content);
            }
        }
    }
    fmpz_mpoly_factor_clear(all, f->ctx);
    if (done)
        return status;
    out->complete = false;
    return split_off_monomials(f, out, p);
}

bool
qdot_factor_join(qdot_field *f, qdot_factors *factors)
{
    fmpz_mpoly_t product;
    bool any = false;

    fmpz_mpoly_init(product, f->ctx);
    for (slong i = 0; i < factors->n; i++)
        for (slong j = i + 1; j < factors->n && qdot_field_goes(f); j++) {
            slong a = fmpz_mpoly_length(factors->poly + i, f->ctx),
                  b = fmpz_mpoly_length(factors->poly + j, f->ctx);

            if (factors->exp[i] != factors->exp[j] || a < 2 || b < 2 ||
                !qdot_field_charge(f, a, b))
                continue;
            fmpz_mpoly_mul(product, factors->poly + i, factors->poly + j, f->ctx);
            if (fmpz_mpoly_length(product, f->ctx) > (a > b ? a : b))
                continue;
            fmpz_mpoly_swap(factors->poly + i, product, f->ctx);
            factors->n--;
            fmpz_mpoly_swap(factors->poly + j, factors->poly + factors->n, f->ctx);
            factors->exp[j] = factors->exp[factors->n];
            fmpz_mpoly_clear(factors->poly + factors->n, f->ctx);
            factors->complete = false;
            any = true;
            j = i; /* the joined factor may also combine with an earlier one, so that the search restarts */
        }
    fmpz_mpoly_clear(product, f->ctx);
    return any;
}

void
qdot_factor_clear(qdot_field *f, qdot_factors *out)
{
    for (slong i = 0; i < out->n; i++)
        fmpz_mpoly_clear(out->poly + i, f->ctx);
    fmpz_clear(out->content);
    qdot_free(out->poly);
    qdot_free(out->exp);
}

/* --- grouping terms by powers of variables ----------------------------------------- */

/* The positions of groups by their keys, as a hash table: open addressing, -1: free. */
typedef struct {
    slong *at;
    size_t size; /* a power of 2, at least twice the number of groups */
} index_of;

static size_t
group_find_slot(const index_of *index, const qdot_groups *out, slong gens, const ulong *key)
{
    uint64_t hash = 0xcbf29ce484222325u;

    for (slong v = 0; v < gens; v++)
        hash = (hash ^ key[v]) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
    for (size_t k = hash & (index->size - 1);; k = (k + 1) & (index->size - 1))
        if (index->at[k] < 0 || gens == 0 ||
            memcmp(out->key + index->at[k] * gens, key, (size_t)gens * sizeof *key) == 0)
            return k;
}

/* Make room for one more entry in the hash table. */
static qdot_status
enlarge_index(index_of *index, const qdot_groups *out, slong gens)
{
    if (index->size >= 2 * ((size_t)out->n + 1))
        return QDOT_OK;
    qdot_free(index->at);
    index->size = index->size ? 2 * index->size : 16;
    index->at = qdot_malloc(index->size * sizeof *index->at);
    if (index->at == NULL)
        return QDOT_ENOMEM;
    for (size_t k = 0; k < index->size; k++)
        index->at[k] = -1;
    for (slong i = 0; i < out->n; i++)
        index->at[group_find_slot(index, out, gens, out->key + i * gens)] = i;
    return QDOT_OK;
}

qdot_status
qdot_factor_group(qdot_field *f, qdot_groups *out, const fmpz_mpoly_t p, const bool *by)
{
    slong gens = f->n, length = fmpz_mpoly_length(p, f->ctx);
    ulong *rest = qdot_malloc(((size_t)gens + 1) * 2 * sizeof *rest), *key = rest + gens;
    size_t keys = 0, polys = 0;
    index_of index = {0};
    qdot_status status = rest == NULL ? QDOT_ENOMEM : QDOT_OK;
    fmpz_t c;

    *out = (qdot_groups){0};
    fmpz_init(c);
    for (slong i = 0; i < length && status == QDOT_OK; i++) {
        slong at;
        size_t slot;

        fmpz_mpoly_get_term_exp_ui(rest, p, i, f->ctx);
        fmpz_mpoly_get_term_coeff_fmpz(c, p, i, f->ctx);
        for (slong v = 0; v < gens; v++) {
            key[v] = by[v] ? rest[v] : 0;
            rest[v] = by[v] ? 0 : rest[v];
        }
        status = enlarge_index(&index, out, gens);
        if (status != QDOT_OK)
            break;
        slot = group_find_slot(&index, out, gens, key);
        at = index.at[slot];
        if (at < 0) {
            status =
                qdot_grow(&out->key, &keys, (size_t)((out->n + 1) * gens), sizeof *key);
            if (status == QDOT_OK)
                status =
                    qdot_grow(&out->poly, &polys, (size_t)out->n + 1, sizeof *out->poly);
            if (status != QDOT_OK)
                break;
            at = index.at[slot] = out->n++;
            if (gens > 0)
                memcpy(out->key + at * gens, key, (size_t)gens * sizeof *key);
            fmpz_mpoly_init(out->poly + at, f->ctx);
        }
        /* keep the terms of a group in the order that they have in p */
        fmpz_mpoly_push_term_fmpz_ui(out->poly + at, c, rest, f->ctx);
    }
    fmpz_clear(c);
    qdot_free(index.at);
    qdot_free(rest);
    return status;
}

void
qdot_factor_ungroup(qdot_field *f, qdot_groups *out)
{
    for (slong i = 0; i < out->n; i++)
        fmpz_mpoly_clear(out->poly + i, f->ctx);
    qdot_free(out->poly);
    qdot_free(out->key);
    *out = (qdot_groups){0};
}

qdot_status
qdot_factor_flip(qdot_field *f, fmpz_mpoly_t r, const fmpz_mpoly_t p, slong c)
{
    bool *by = qdot_calloc((size_t)f->n + 1, sizeof *by);
    slong s = (slong)f->gen[c].pair;
    fmpz_mpoly_t square, power, x;
    qdot_groups groups;
    qdot_status status;

    if (by == NULL)
        return QDOT_ENOMEM;
    by[c] = true;
    status = qdot_factor_group(f, &groups, p, by);
    fmpz_mpoly_init(square, f->ctx);
    fmpz_mpoly_init(power, f->ctx);
    fmpz_mpoly_init(x, f->ctx);
    fmpz_mpoly_gen(square, s, f->ctx);
    fmpz_mpoly_mul(square, square, square, f->ctx);
    if (f->gen[c].kind == QDOT_GEN_COS)
        fmpz_mpoly_neg(square, square, f->ctx);
    fmpz_mpoly_add_si(square, square, 1, f->ctx);
    fmpz_mpoly_zero(r, f->ctx);
    for (slong i = 0; i < groups.n && status == QDOT_OK; i++) {
        ulong k = groups.key[i * f->n + c];

        if (!qdot_field_charge(f, fmpz_mpoly_length(groups.poly + i, f->ctx),
                               (slong)k + 1))
            break;
        if (k / 2 > 0) {
            fmpz_mpoly_pow_ui(power, square, k / 2, f->ctx);
            fmpz_mpoly_mul(groups.poly + i, groups.poly + i, power, f->ctx);
        }
        if (k % 2 != 0) {
            fmpz_mpoly_gen(x, c, f->ctx);
            fmpz_mpoly_mul(groups.poly + i, groups.poly + i, x, f->ctx);
        }
        fmpz_mpoly_add(r, r, groups.poly + i, f->ctx);
    }
    fmpz_mpoly_clear(square, f->ctx);
    fmpz_mpoly_clear(power, f->ctx);
    fmpz_mpoly_clear(x, f->ctx);
    qdot_factor_ungroup(f, &groups);
    qdot_free(by);
    return status;
}
