/* modes-symmetry.c -- splits M y'' + H y = 0 into parts by couplings and by symmetries.
 *
 * A permutation of the unknowns with signs, S y_i = s_i y_p(i), that leaves M and H as they are and is its own inverse
 * maps modes to modes; M and H do not couple vectors that are even (S y = y) with odd ones (S y = -y). Permutations
 * that commute split further. So modes of one frequency that fall into different parts are orthogonal in M and
 * chosen by the symmetry: of three equal masses on a ring (1, 1, -2) and (1, -1, 0).
 *
 * Permutations are found by trial, unknown by unknown, on M and H whose entries are numbered such that equal ones have
 * equal numbers and opposite ones opposite numbers. Those that keep the last unknown come first. */
#include "mech/linear/modes-parts.h"

#include <math.h>

#include "expr/build.h"
#include "mech/dynamics/generic.h"
#include "normal/prove/decide.h"

enum {
    MOST_UNKNOWNS = 64,
    MOST_TRIALS = 5000,
    MOST_FOUND = 32,
    MOST_GENERATORS = 6,
    MOST_ELEMENTS = 1 << MOST_GENERATORS,
};

/* S e_i = sign[i] e_image[i] */
typedef struct {
    size_t image[MOST_UNKNOWNS];
    int sign[MOST_UNKNOWNS];
} permutation;

typedef struct {
    const qdot_modes_job *j;
    size_t n;
    int *M, *H; /* [n x n] numbers of the entries */
    size_t kinds;
    qdot_expr *kind; /* [kinds] an entry of each number, from 1 on */
    double *value;   /* [kinds] at a generic point */
    permutation try;
    size_t trials, found_n;
    permutation found[MOST_FOUND];
    size_t elements, generators;
    permutation group[MOST_ELEMENTS];
} search;

/* --- numbers of entries ------------------------------------------------------------------- */

static int
number_of_entry(search *x, qdot_expr e)
{
    qdot_pool *pool = x->j->pool;
    double v = 0;

    if (e == QDOT_ZERO)
        return 0;
    for (size_t k = 0; k < x->kinds; k++)
        if (x->kind[k] == e)
            return (int)k + 1;
    if (qdot_generic_evaluate(pool, 1, &e, NULL, &v) != QDOT_OK)
        v = NAN;
    for (size_t k = 0; k < x->kinds; k++)
        for (int sign = 1; sign >= -1; sign -= 2)
            if (fabs(v - sign * x->value[k]) <= 1e-9 * fabs(v) &&
                qdot_modes_is_zero(x->j, sign > 0 ? qdot_sub(pool, e, x->kind[k]) : qdot_add(pool, e, x->kind[k])))
                return sign * ((int)k + 1);
    x->kind[x->kinds] = e;
    x->value[x->kinds++] = v;
    return (int)x->kinds;
}

static qdot_status
number_entries(search *x, const size_t *which, const qdot_expr *M, const qdot_expr *H)
{
    const size_t n = x->n;

    x->M = qdot_calloc(2 * n * n + 1, sizeof *x->M);
    x->kind = qdot_calloc(2 * n * n + 1, sizeof *x->kind);
    x->value = qdot_calloc(2 * n * n + 1, sizeof *x->value);
    if (x->M == NULL || x->kind == NULL || x->value == NULL)
        return QDOT_ENOMEM;
    x->H = x->M + n * n;
    for (size_t i = 0; i < n * n; i++) {
        const size_t at = which[i / n] * x->j->m.n + which[i % n];

        x->M[i] = number_of_entry(x, M[at]);
        x->H[i] = number_of_entry(x, H[at]);
    }
    return qdot_pool_check(x->j->pool);
}

/* --- permutations ------------------------------------------------------------------------- */

/* Whether M and H stay as they are between unknown i and all that have an image. */
static bool
image_is_consistent(const search *x, size_t i)
{
    const size_t n = x->n, *image = x->try.image;
    const int *sign = x->try.sign;

    for (size_t a = 0; a < n; a++)
        if (sign[a] != 0 && (x->M[image[i] * n + image[a]] != sign[i] * sign[a] * x->M[i * n + a] ||
                             x->H[image[i] * n + image[a]] != sign[i] * sign[a] * x->H[i * n + a]))
            return false;
    return true;
}

static void
keep_permutation(search *x)
{
    bool identity = true;

    for (size_t i = 0; i < x->n && identity; i++)
        identity = x->try.image[i] == i && x->try.sign[i] == x->try.sign[0];
    if (!identity)
        x->found[x->found_n++] = x->try;
}

static void find_permutations(search *x, size_t assigned);

static void
try_image(search *x, size_t i, size_t image, int sign, size_t assigned)
{
    permutation *p = &x->try;

    x->trials++;
    p->image[i] = image;
    p->image[image] = i;
    p->sign[i] = p->sign[image] = sign;
    if (image_is_consistent(x, i) && image_is_consistent(x, image))
        find_permutations(x, assigned + 1);
    p->sign[i] = p->sign[image] = 0;
}

/* Give the next unknown without an image all that are possible: the last unknown first, which keeps its place first;
 * others change it first. */
static void
find_permutations(search *x, size_t assigned)
{
    const size_t n = x->n;
    size_t i = assigned == 0 ? n - 1 : 0;

    while (i < n && x->try.sign[i] != 0)
        i++;
    if (i == n) {
        keep_permutation(x);
        return;
    }
    if (assigned == 0)
        try_image(x, i, i, 1, assigned);
    for (size_t k = assigned == 0 ? 0 : i + 1; k < n; k++)
        for (int sign = 1; sign >= -1; sign -= 2)
            if (k != i && x->try.sign[k] == 0 && x->trials < MOST_TRIALS && x->found_n < MOST_FOUND)
                try_image(x, i, k, sign, assigned);
    for (int sign = assigned == 0 ? -1 : 1; sign >= -1; sign -= 2)
        if (x->trials < MOST_TRIALS && x->found_n < MOST_FOUND)
            try_image(x, i, i, sign, assigned);
}

/* a after b */
static void
multiply_permutations(size_t n, const permutation *a, const permutation *b, permutation *out)
{
    for (size_t i = 0; i < n; i++) {
        out->image[i] = a->image[b->image[i]];
        out->sign[i] = b->sign[i] * a->sign[b->image[i]];
    }
}

static bool
permutations_are_equal(size_t n, const permutation *a, const permutation *b, int sign)
{
    for (size_t i = 0; i < n; i++)
        if (a->image[i] != b->image[i] || a->sign[i] != sign * b->sign[i])
            return false;
    return true;
}

/* Extend the group by S if S commutes with its elements, and neither S nor -S is one. */
static void
extend_group(search *x, const permutation *S)
{
    if (x->generators == MOST_GENERATORS)
        return;
    for (size_t k = 0; k < x->elements; k++) {
        permutation left, right;

        multiply_permutations(x->n, S, &x->group[k], &left);
        multiply_permutations(x->n, &x->group[k], S, &right);
        if (!permutations_are_equal(x->n, &left, &right, 1) || permutations_are_equal(x->n, S, &x->group[k], 1) ||
            permutations_are_equal(x->n, S, &x->group[k], -1))
            return;
    }
    for (size_t k = 0; k < x->elements; k++)
        multiply_permutations(x->n, S, &x->group[k], &x->group[x->elements + k]);
    x->elements *= 2;
    x->generators++;
}

/* The group of commuting symmetries: element g is the product of the generators whose bits are set in g. */
static void
find_group(search *x)
{
    x->elements = 1;
    for (size_t i = 0; i < x->n; i++) {
        x->group[0].image[i] = i;
        x->group[0].sign[i] = 1;
    }
    find_permutations(x, 0);
    for (size_t k = 0; k < x->found_n; k++)
        extend_group(x, &x->found[k]);
}

/* --- parts -------------------------------------------------------------------------------- */

static int
parity(size_t bits)
{
    int sign = 1;

    for (; bits != 0; bits &= bits - 1)
        sign = -sign;
    return sign;
}

/* v [n] = the sum of chi(g) g e_i over the group, where the bits of chi tell under which generators it is odd, divided so
 * that v_i is 1. Whether it is not 0, and i the first unknown in it. */
static bool
character_vector(const search *x, size_t chi, size_t i, int *v)
{
    for (size_t k = 0; k < x->n; k++)
        v[k] = 0;
    for (size_t g = 0; g < x->elements; g++) {
        if (x->group[g].image[i] < i)
            return false;
        v[x->group[g].image[i]] += parity(chi & g) * x->group[g].sign[i];
    }
    for (size_t k = x->n; k-- > i && v[i] != 0;)
        v[k] /= v[i];
    return v[i] != 0;
}

/* Call `each` for the part of the vectors of one character. */
static qdot_status
split_by_character(const search *x, size_t chi, const size_t *which, qdot_modes_each *each, void *user, bool *go_on)
{
    const size_t whole = x->j->m.n;
    qdot_modes_part part = {.whole = whole, .B = qdot_calloc(whole * x->n + 1, sizeof *part.B)};
    int v[MOST_UNKNOWNS];
    qdot_status status;

    if (part.B == NULL)
        return QDOT_ENOMEM;
    for (size_t i = 0; i < x->n; i++)
        part.n += character_vector(x, chi, i, v);
    for (size_t i = 0, at = 0; i < x->n; i++) {
        if (!character_vector(x, chi, i, v))
            continue;
        for (size_t k = 0; k < x->n; k++)
            part.B[which[k] * part.n + at] = v[k];
        at++;
    }
    status = part.n == 0 ? QDOT_OK : each(user, &part, go_on);
    qdot_free(part.B);
    return status;
}

/* Call `each` for the unknowns `which` [n] as they are. */
static qdot_status
pass_whole(size_t n, const size_t *which, size_t whole, qdot_modes_each *each, void *user)
{
    qdot_modes_part part = {.n = n, .whole = whole, .B = qdot_calloc(whole * n + 1, sizeof *part.B)};
    qdot_status status = part.B == NULL ? QDOT_ENOMEM : QDOT_OK;
    bool go_on = true;

    for (size_t k = 0; k < n && status == QDOT_OK; k++)
        part.B[which[k] * n + k] = 1;
    if (status == QDOT_OK)
        status = each(user, &part, &go_on);
    qdot_free(part.B);
    return status;
}

qdot_status
qdot_modes_split(const qdot_modes_job *j, size_t n, const size_t *which, const qdot_expr *M, const qdot_expr *H,
                 qdot_modes_each *each, void *user)
{
    search *x;
    qdot_status status;
    bool go_on = true;

    if (!j->symmetric || n == 1 || n > MOST_UNKNOWNS)
        return pass_whole(n, which, j->m.n, each, user);
    x = qdot_calloc(1, sizeof *x);
    if (x == NULL)
        return QDOT_ENOMEM;
    x->j = j;
    x->n = n;
    status = number_entries(x, which, M, H);
    if (status == QDOT_OK)
        find_group(x);
    for (size_t chi = 0; status == QDOT_OK && chi < x->elements && go_on; chi++)
        status = split_by_character(x, chi, which, each, user, &go_on);
    qdot_free(x->M);
    qdot_free(x->kind);
    qdot_free(x->value);
    qdot_free(x);
    return status;
}

/* Number the sets of unknowns that M and H do not couple: set [n]; returns their number. */
static size_t
number_sets(size_t n, const qdot_expr *M, const qdot_expr *H, size_t *set)
{
    size_t count = 0;

    for (size_t i = 0; i < n; i++)
        set[i] = i;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < n; k++) {
            const size_t from = set[i] > set[k] ? set[i] : set[k], to = set[i] > set[k] ? set[k] : set[i];

            if (M[i * n + k] == QDOT_ZERO && H[i * n + k] == QDOT_ZERO)
                continue;
            for (size_t a = 0; a < n; a++)
                set[a] = set[a] == from ? to : set[a];
        }
    for (size_t i = 0; i < n; i++) { /* a set has the number of its first unknown: count them instead */
        if (set[i] != i)
            continue;
        for (size_t a = i; a < n; a++)
            set[a] = set[a] == i ? count : set[a];
        count++;
    }
    return count;
}

qdot_status
qdot_modes_for_sets(size_t n, const qdot_expr *M, const qdot_expr *H, qdot_modes_of_set *find, void *user, bool *done)
{
    size_t *set = qdot_calloc(2 * n + 1, sizeof *set), *which = set + n, count;
    qdot_status status = QDOT_OK;

    if (set == NULL)
        return QDOT_ENOMEM;
    count = number_sets(n, M, H, set);
    *done = true;
    for (size_t c = 0; c < count && status == QDOT_OK && *done; c++) {
        size_t members = 0;

        for (size_t i = 0; i < n; i++)
            if (set[i] == c)
                which[members++] = i;
        status = find(user, members, which, done);
    }
    qdot_free(set);
    return status;
}
